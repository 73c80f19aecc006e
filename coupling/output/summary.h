/* summary.json: the machine's face of every run, written at its end whatever the end was.
 *
 * One table a kind of run says every key once (name, unit, where it stands): writing, the closing table, the manual's
 * key list and the tests use it.  SI units; NaN and what a run did not reach become null, so every key is always there.
 * The keys of the run's own kind stand at the top level beside those of `all`; the shot of an onset or a comparison
 * stands under "shot".  To add a key: a member in the struct, one line in its table.  Keys are only ever added. */
#ifndef BREECH_COUPLING_SUMMARY_H
#define BREECH_COUPLING_SUMMARY_H

#include "base/status.h"
#include "circuit/firing.h"
#include "circuit/shot.h"
#include "coupling/gouge/crater.h"
#include "mpm/mpm.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

enum { SUMMARY_NAME_SIZE = 96 };

/* The shot, and what it took. */
typedef struct {
    shot_summary is;
    shot_limits limits;
    double rail_rise,
        rail_rise_position; /* largest that the shot leaves in its rails, even over the section; where [K, m] */
    double wall_seconds;    /* [s] */
    firing_result firing;   /* of the search for firing times, all zero where there was none */
    int n_fire_at;
    const double *fire_at; /* of the bank's groups, as found [s]; n_fire_at, borrowed */
} shot_record;

/* One scene, full model: forces and volumes with the mirror half. */
typedef struct {
    damage_class class;
    char reason[200];
    double severity, widening; /* [1] */
    double groove_growth;      /* of the plastic power in a groove that is followed, NaN if it was not gauged [1/s] */
    double crater_length, crater_width, crater_depth, rim_height; /* [m] */
    double crater_volume;                                         /* [m3] */
    double peak_pressure;                                         /* of any particle [Pa] */
    double peak_force[3];                                         /* on the rail [N] */
    double peak_temperature;                                      /* [K] */
    double peak_mises_armature, peak_mises_rail;                  /* [Pa] */
    double peak_mises_armature_999, peak_mises_rail_999;          /* 99.9th percentiles by mass [Pa] */
    double peak_pressure_armature_999, peak_pressure_rail_999;    /* [Pa] */
    bool crater_truncated; /* the crater reaches the edge of its map: length and volume are lower bounds */
    double momentum_error, energy_error; /* [1] */
    int bodies;
    char body[MPM_MAX_BODIES][PARAM_TEXT_SIZE];
    double failed_volume[MPM_MAX_BODIES];  /* [m3] */
    double carried_volume[MPM_MAX_BODIES]; /* sound and faster than half the armature's speed at the end [m3] */
    double layers_failed_volume, layers_carried_volume; /* the same, of the rail's layers together [m3] */
    double end_time;                                    /* [s] */
    uint64_t particles, steps, particle_steps, particle_steps_dense;
    uint64_t clamps_pressure, clamps_compression;
    double eroded_mass;  /* [kg] */
    double wall_seconds; /* [s] */
    int threads;
} scene_result;

/* One scene of a study. */
typedef struct {
    char name[SUMMARY_NAME_SIZE]; /* its folder under scenes/ and its group under /scene */
    double velocity;              /* [m/s] */
    double radius, height;        /* of the grain [m] */
    char shape[PARAM_TEXT_SIZE], material[PARAM_TEXT_SIZE], surface[SUMMARY_NAME_SIZE];
    double contact_pressure; /* [Pa] */
    double temperature;      /* of the rail [K] */
    double cells_per_radius; /* [1] */
    bool gauged; /* over once its groove's growth was known: the class is by that, the crater as far as it was */
    bool reused; /* taken from the store, not computed by this run */
    scene_result result;
} onset_scene;

typedef enum {
    SITE_NOT_REACHED, /* the armature never came there */
    SITE_SKIPPED,     /* the screen says it cannot gouge */
    SITE_NONE,        /* as damage_class: from a scene of its own or from the threshold */
    SITE_SCRATCH,
    SITE_GOUGE,
    SITE_UNDECIDED
} site_outcome;
extern const char *const output_site_outcome_names[]; /* "not_reached", "skipped", "none", ..., NULL */

typedef struct {
    double position;                                  /* along the barrel [m] */
    double radius;                                    /* [m] */
    double time, velocity, current;                   /* at arrival [s, m/s, A]; NaN: not reached */
    double contact_pressure;                          /* [Pa] */
    double impact_pressure;                           /* impedance match [Pa] */
    double screen;                                    /* impact pressure over the hardness of the harder partner [1] */
    double threshold_velocity, threshold_interval[2]; /* for its grain [m/s]; NaN: not looked for */
    double gouged_volume;                             /* [m3]; NaN: unknown */
    site_outcome outcome;
    char scene[SUMMARY_NAME_SIZE]; /* the scene that decided, "" if none */
} onset_site;

/* The threshold at one size of one family of grains. */
typedef struct {
    int family; /* from 1 */
    char shape[PARAM_TEXT_SIZE], material[PARAM_TEXT_SIZE];
    double radius;                /* [m] */
    double grains;                /* it stands for */
    double threshold_velocity;    /* [m/s] */
    double threshold_interval[2]; /* [m/s] */
    int scenes;                   /* of this size; 0: bounded by other sizes */
} onset_size;

/* Scenes that were not needed. */
typedef struct {
    char rests_on[120];
    int scenes;
} onset_skip;

/* What a change of one input does, all else as it was. */
typedef struct {
    char input[40];
    double change;             /* of the input, relative [1] */
    double muzzle_velocity;    /* [m/s] */
    double threshold_velocity; /* [m/s] */
    double threshold_position; /* [m] */
    double expected_gouges;    /* [1] */
} onset_sensitivity;

/* One of several shots on the same rail. */
typedef struct {
    int shot;                                                          /* from 1 */
    double probability_gouge, expected_gouges, expected_gouged_volume; /* [1, 1, m3] */
    double onset_position, onset_interval[2];                          /* median, 5 .. 95 % [m] */
    double muzzle_velocity;                                            /* [m/s] */
    double rail_rise; /* left by the shots before, where the armature is fast enough to be looked at: the largest [K] */
    double threshold_velocity; /* as the study's, where the rail is that warm [m/s] */
} onset_shot;

typedef enum { VERDICT_GOUGES, VERDICT_NO_GOUGING, VERDICT_UNDECIDED } onset_verdict;
extern const char *const output_onset_verdict_names[]; /* "gouges", "no_gouging", "undecided", NULL */

typedef struct {
    onset_verdict verdict;
    char reason[300];                                                  /* of the verdict, in words */
    double probability_gouge;                                          /* [1] */
    double threshold_velocity;                                         /* at the median size for a population [m/s] */
    double threshold_interval[2];                                      /* [m/s] */
    double onset_position;                                             /* along the barrel [m] */
    double onset_interval[2];                                          /* [m] */
    double threshold_position, threshold_position_interval[2];         /* where the threshold velocity is passed [m] */
    double muzzle_velocity_feedback;                                   /* with what the gouges take [m/s] */
    int gouges;                                                        /* sites of the list that gouge */
    double expected_gouges, expected_gouges_interval[2];               /* a shot, sites and populations [1] */
    double expected_gouged_volume, expected_gouged_volume_interval[2]; /* [m3] */
    int histories;                                                     /* of the Monte Carlo */
    double monte_carlo_seconds;                                        /* [s] */
    int n_along;
    const double *along, *probability_along; /* n_along: P(gouge before x) at x [m, 1], borrowed */
    int n_surface, n_skips, n_sensitivities, n_shots;
    const onset_size *surface;              /* borrowed */
    const onset_skip *skip;                 /* borrowed */
    const onset_sensitivity *sensitivities; /* borrowed */
    const onset_shot *shot;                 /* borrowed */
    int scenes_run, scenes_skipped, scenes_reused;
    int n_sites, n_scenes;
    const onset_site *site;   /* n_sites, borrowed */
    const onset_scene *scene; /* n_scenes, borrowed */
    double wall_seconds;      /* [s] */
} onset_result;

typedef struct {
    char surface[SUMMARY_NAME_SIZE];
    double threshold_velocity, threshold_interval[2]; /* [m/s] */
    double onset_position;                            /* [m] */
    double gouged_volume;                             /* [m3] */
    double gouged_volume_interval[2];                 /* [m3] */
    double threshold_position;                        /* [m] */
    double gouges, gouges_interval[2];                /* a shot, expected [1] */
    double probability_gouge;                         /* [1] */
    double better_than_next; /* share of what may be true in which it gouges less than the next one [1] */
    bool significant;        /* that share is at least 0.95; of the last: the former one's */
    int tied;                /* surfaces from the same `tied` on cannot be told apart; from 1 */
    int scenes;              /* its own, those shared with surfaces before it not counted */
    char layer[24];          /* what its layers suffer: "none", "intact", "spalled", "sheared off", "worn through" */
    double layer_failed;     /* share of the layers under the crater that failed [1] */
    double layer_velocity;   /* of the scene that says so [m/s] */
} compare_entry;

typedef struct {
    int n;
    const compare_entry *ranking; /* n, best first, borrowed */
    int n_scenes;
    const onset_scene *scene; /* n_scenes, borrowed */
    int scenes_run, scenes_skipped, scenes_reused;
    int histories;
    double wall_seconds; /* [s] */
} compare_result;

typedef struct {
    int n;
    const double *frequency;          /* n [Hz], borrowed */
    const double *L_gradient;         /* n [H/m], borrowed */
    const double *R_gradient;         /* n [ohm/m], borrowed */
    double L_gradient_high_frequency; /* [H/m] */
    double L_gradient_direct_current; /* [H/m] */
    double R_gradient_direct_current; /* [ohm/m] */
    double L_gradient_kerrisk;        /* [H/m]; NAN where the formula does not apply */
    double kerrisk_error;             /* over L_gradient_high_frequency [1] */
    double perimeter_frequency;       /* [Hz] */
    int n_perimeter;
    const double *perimeter; /* n_perimeter [m], from the middle of the bore face to that of the back, borrowed */
    const double *perimeter_current; /* n_perimeter [A/m^2 per A], borrowed */
    const double *perimeter_heat;    /* n_perimeter [W/m^3 per A^2], borrowed */
} inductance_result;

typedef enum { RUN_SHOT, RUN_SCENE, RUN_ONSET, RUN_COMPARE, RUN_INDUCTANCE, RUN_KINDS } run_kind;
extern const char *const output_run_kind_names[]; /* "shot", ..., NULL */

typedef enum { RUN_DONE, RUN_STOPPED, RUN_FAILED } run_status;
extern const char *const output_run_status_names[]; /* "done", "stopped", "failed", NULL */

/* Everything a summary says; members that are NULL were not reached.  All borrowed. */
typedef struct {
    run_kind kind;
    const char *case_name;
    const char *instruction_set;
    run_status status;
    const char *error;    /* NULL when there is none */
    const char *warnings; /* a line each, NULL or "" when there are none */
    const shot_record *shot;
    const scene_result *scene;
    const onset_result *onset;
    const compare_result *compare;
    const inductance_result *inductance;
} run_summary;

/* DIR/summary.json, at once or not at all. */
status output_summary_write(const char *dir, const run_summary *s);
/* Its text, malloc'ed, the caller frees it; NULL when out of memory. */
char *output_summary_text(const run_summary *s);
/* One scene as a line of JSON, the keys of an entry of `scenes`, and its result back from it; numbers survive exactly.
 * The text is malloc'ed, the caller frees it; NULL when out of memory.  STATUS_IO: not such a text, or keys are
 * missing. */
char *output_summary_scene_text(const onset_scene *s);
status output_summary_scene_result(const char *text, scene_result *out);
/* "done", "stopped", "failed" of the summary.json in dir; "" when there is none or it cannot be read. */
void output_summary_status(const char *dir, char *out, size_t size);

/* The closing table for people. */
void output_summary_print(const run_summary *s, FILE *out);
/* The manual's key list, in markdown. */
void output_summary_print_keys(FILE *out);

#endif
