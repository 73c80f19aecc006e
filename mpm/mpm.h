/* SPDX-License-Identifier: BSD-3-Clause */
/* The material-point solver: a scene in, its state at a later time out.
 *
 * A step is one of the coarsest level; finer ones make two, four, .. in it (substeps.c), and after it all are in step.
 * mpm_create copies the scene; mpm_advance steps until a time; everything else reads.  No files, no printing.
 * One binary and one instruction set give the same bits on any number of threads and across save and restore. */
#ifndef BREECH_MPM_MPM_H
#define BREECH_MPM_MPM_H

#include "mpm/scene.h"

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct mpm mpm; /* owns all its memory */

/* Every joule and newton second.  Model as computed (a half model is a half). */
typedef struct {
    double mass;              /* now in the window [kg] */
    double momentum[3];       /* now [kg m/s] */
    double kinetic, internal; /* now [J]; internal = work of stress + heat */
    double
        work_ahead; /* held by `internal`, but still to be taken from `kinetic`: the stress work of half a step [J] */
    double heat_friction, heat_transfer, heat_viscous; /* booked so far; all three are part of `internal` [J] */
    double work_boundary, work_external; /* done on the model so far: boundaries; tractions, body forces and gas [J] */
    double impulse_boundary[3], impulse_external[3];          /* [N s] */
    double ejected_mass, ejected_momentum[3], ejected_energy; /* left the window or was eroded so far [kg, kg m/s, J] */
    double energy_start, momentum_start[3], kinetic_start, mass_start; /* [J, kg m/s, J, kg] */
    double
        energy_error; /* (energy now - work_ahead + ejected - work - energy at start) / kinetic energy at start [1] */
    double momentum_error; /* norm of the momentum left over / (mass x largest initial speed) [1] */
} mpm_ledger;

typedef struct {
    double time, dt; /* dt: of a step of the coarsest level [s] */
    uint64_t steps, particle_steps, particle_steps_dense;
    uint64_t particle_steps_asleep; /* that points at rest did not take */
    size_t particles;
    uint64_t clamps_pressure, clamps_compression; /* counted, never silent */
    uint64_t splits, merges, ejected, eroded;     /* ejected holds the eroded points too */
    double eroded_mass;                           /* dust taken out so far [kg] */
    double peak_pressure, peak_temperature;       /* any intact point, any time so far [Pa, K] */
    double failed_volume;                         /* of all bodies, now [m3] */
} mpm_report;

/* Of one body, so far. */
typedef struct {
    double peak_pressure, peak_mises;         /* any point; pressure: any intact one [Pa] */
    double peak_pressure_999, peak_mises_999; /* peak over time of the 99.9th percentile by mass; pressure: that intact
                                                 points make of it [Pa] */
    double peak_plastic_strain;               /* any point [1] */
} mpm_body_report;

/* What mpm_read can fill; one double or three or six a point, in a fixed order that any restart keeps. */
#define PARTICLE_FIELDS(FIELD)                                                  \
    FIELD(position, 3, "m", "position")                                         \
    FIELD(velocity, 3, "m/s", "velocity")                                       \
    FIELD(stress, 6, "Pa", "Cauchy stress xx yy zz xy yz xz, tension positive") \
    FIELD(pressure, 1, "Pa", "pressure with viscosity")                         \
    FIELD(mises, 1, "Pa", "von Mises stress")                                   \
    FIELD(plastic_strain, 1, "1", "equivalent plastic strain")                  \
    FIELD(damage, 1, "1", "Johnson-Cook damage, failed at 1")                   \
    FIELD(temperature, 1, "K", "temperature")                                   \
    FIELD(density, 1, "kg/m^3", "density")                                      \
    FIELD(energy, 1, "J/kg", "specific internal energy")                        \
    FIELD(mass, 1, "kg", "mass")                                                \
    FIELD(size, 3, "m", "half lengths of the domain")                           \
    FIELD(body, 1, "1", "index of the body")                                    \
    FIELD(start, 3, "m", "position at the start")

typedef enum {
#define MPM_FIELD_ENUM(name, width, unit, doc) MPM_##name,
    PARTICLE_FIELDS(MPM_FIELD_ENUM)
#undef MPM_FIELD_ENUM
        MPM_FIELD_COUNT
} mpm_field;

typedef struct {
    const char *name;
    int width;
    const char *unit, *doc;
} mpm_field_info;
extern const mpm_field_info mpm_field_table[MPM_FIELD_COUNT];

/* Called after every step; return false to stop (mpm_advance then returns BASE_STATUS_STOPPED after a whole step). */
typedef struct {
    bool (*step)(void *user, const mpm *m);
    void *user; /* borrowed */
} mpm_sink;

/* ---- what a scene can be refused for ---- */

/* The scene itself, and its lists. */
typedef enum {
    MPM_PART_SCENE,
    MPM_PART_BODY,
    MPM_PART_PAIR,
    MPM_PART_REFINE,
    MPM_PART_PROBE,
    MPM_PART_CAVITY,
    MPM_PARTS
} mpm_part;
int mpm_part_entries(const mpm_scene *s, mpm_part part); /* of MPM_PART_SCENE 1 */

/* What an error is about: an entry of a list, and the key of it that is at fault, as a case file has it, or that says
 * most of it; NULL: the text names it, or there is none. */
typedef struct {
    mpm_part part;
    int entry; /* 0 the first */
    const char *key;
} mpm_refused;
extern const mpm_refused mpm_not_refused;

/* One entry, which needs neither the window nor what comes behind it in its list; then all of them.  mpm_create makes
 * these checks first.  BASE_STATUS_BAD_INPUT names the value and what it must be; then *at says where. */
base_status mpm_check_entry(const mpm_scene *s, mpm_part part, int entry, const char **key);
base_status mpm_check(const mpm_scene *s, mpm_refused *at);
/* And what shows only when the scene is made: voids of cavities, for which its points are made and freed; does the wave
 * of a piston arrive? */
base_status mpm_check_made(const mpm_scene *s, int threads, mpm_refused *at);
double mpm_courant_limit(mpm_transfer_kind transfer); /* largest mpm_scene.courant [1] */

base_status mpm_create(const mpm_scene *scene, int threads, mpm **out);
void mpm_free(mpm *m); /* NULL allowed */
/* Between steps: in mpm_sink too.  Changes no bit of what comes out; 0: as many as OpenMP gives. */
void mpm_set_threads(mpm *m, int threads);
/* Between steps too.  From their next look on rules of refinement ask for no finer level than this one, which must be
 * one of the scene's; 0, the finest, until it is called.  Part of a checkpoint. */
void mpm_set_finest(mpm *m, int level);

/* Steps until time >= until [s].  BASE_STATUS_NUMERICAL names the point, the time and what to try. */
base_status mpm_advance(mpm *m, double until, const mpm_sink *sink);

mpm_ledger mpm_balance(const mpm *m);
mpm_report mpm_state(const mpm *m);

/* Wall time since mpm_create by phase of the step [s];
 * `rest` holds the ledger, percentiles, sorting and looks at refinement. */
typedef enum { MPM_PHASE_P2G, MPM_PHASE_NODES, MPM_PHASE_G2P, MPM_PHASE_MOVERS, MPM_PHASE_REST, MPM_PHASES } mpm_phase;
double mpm_phase_seconds(const mpm *m, mpm_phase phase);

mpm_report mpm_glance(const mpm *m); /* as mpm_state but failed_volume, zero, which takes a walk over all points */
mpm_body_report mpm_body_state(const mpm *m, int body);
void mpm_failed_volumes(const mpm *m, double *volume); /* of each body, now [m3]; a walk over all points */
/* [3] on a group from all others; borrowed: mean of the last step; largest |component| so far, smoothed over 0.2 us
 * [N]. */
const double *mpm_contact_force(const mpm *m, int group);
const double *mpm_peak_contact_force(const mpm *m, int group);
const mpm_scene *mpm_scene_of(const mpm *m); /* borrowed */
size_t mpm_points(const mpm *m);
/* out: mpm_points() x width doubles, owned by the caller. */
void mpm_read(const mpm *m, mpm_field field, double *out);
/* All fields in one walk over the points, rounded to float32: out[field] takes mpm_points() x width values. */
void mpm_read_all(const mpm *m, float *const out[MPM_FIELD_COUNT]);

/* Slices of equal width along an axis, each in two parts: its middle, and its sides beyond a part of the half width
 * across.  What lies beyond the half width is in none. */
typedef struct {
    int along, across;   /* axes: 0 x, 1 y, 2 z */
    int n;               /* slices */
    double lo, width;    /* where the first begins; of each [m] */
    double middle, half; /* across: the middle, the half width [m] */
    double sides;        /* the sides begin at this part of the half width [1] */
} mpm_slices;

typedef struct {
    double power, volume; /* [W, m3] */
} mpm_plastic_sum;

/* Plastic power (as of the probe `plastic`) and volume of bodies, slice by slice; a point belongs evenly to all slices
 * that its domain covers.  counts: of each body, is it read?  sums: 2 n, of each slice its middle and its sides; the
 * caller's. */
base_status mpm_plastic_profile(const mpm *m, const bool *counts, const mpm_slices *slices, mpm_plastic_sum *sums);

/* Checkpoint: a flat image of everything, order included.  *image is malloc'ed, the caller frees it. */
base_status mpm_save(const mpm *m, void **image, size_t *bytes);
/* Into a solver made by mpm_create from the same scene; refuses an image of another scene, version or instruction set.
 */
base_status mpm_restore(mpm *m, const void *image, size_t bytes);

/* What a scene will take at its start, without building it: with small cells in the zone and near bodies that have a
 * rule `around`.  What flows or is shocked adds cells while it runs.  Of a body of more than ten thousand points
 * they are counted in a sample, within a percent or two. */
typedef struct {
    size_t particles;
    double work;  /* point-steps in a step of the finest level: coarser levels make fewer [1] */
    size_t bytes; /* MPM_BYTES and MPM_BYTES_A_PARTICLE each */
    double dt;    /* first step of the finest level [s] */
    int empty;    /* the first body that has no point, -1: none */
} mpm_needs;

/* Blocks five eighths full, a quarter in reserve, sums of their bricks;
 * measured, docs/theory/scene-solver.md, Memory.  A body's bins for percentiles. */
enum { MPM_BYTES = 20000000, MPM_BYTES_A_PARTICLE = 1600, MPM_BYTES_A_BODY = 50000 };
base_status mpm_estimate(const mpm_scene *scene, mpm_needs *needs);

/* The one that scenes run in which name none: the best of the machine, or what was chosen for the process, before any
 * scene and by one thread ("" or NULL: the best again).  Results of two sets differ by rounding.  BASE_STATUS_BAD_INPUT
 * says which sets run on this machine. */
const char *mpm_instruction_set(void); /* "x86-64-v4", "x86-64-v3", "portable" */
base_status mpm_instruction_set_choose(const char *name);

#ifndef BREECH_INSIDE
#undef PARTICLE_FIELDS
#endif

#ifdef __cplusplus
}
#endif

#endif
