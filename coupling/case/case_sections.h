/* SPDX-License-Identifier: BSD-3-Clause */
/* The sections of a case file as structs, in SI units: what every room may know of a case.
 *
 * Every key stands once, in a param table (this folder's case_schema.c; circuit/ and mpm/ for their own sections).
 * To add a key: a member below and one line in its table.  To add a section: a struct, a table, one line in the schema.
 * A section that the file leaves out holds the table's defaults, required numbers NAN; `needs` says which must be
 * there.  Numbers that are OPTIONAL and not given hold NAN. */
#ifndef BREECH_COUPLING_CASE_SECTIONS_H
#define BREECH_COUPLING_CASE_SECTIONS_H

#include "base/param.h"
#include "circuit/firing.h"
#include "circuit/shot.h"
#include "mpm/scene.h"

#include <stdbool.h>
#include <stddef.h>

enum { CASE_PATH_SIZE = 512 };

/* What a command does with the case (a sum): sections and material constants it needs must be there. */
enum {
    CASE_FOR_SHOT = 1, /* a supply, rails, barrel, armature */
    CASE_FOR_SCENE =
        2, /* rail, projectile, particle, scene; scene.velocity, particle.radius; the materials for a scene */
    CASE_FOR_ONSET =
        4, /* the shot, the scene but for its velocity, sites or populations; materials for screen and scene */
    CASE_FOR_INDUCTANCE = 8, /* rails */
    CASE_FOR_COMPARE = 16,   /* with CASE_FOR_ONSET: treatments */
    CASE_FOR_BODIES = 32,    /* takes the place of CASE_FOR_SCENE where `scene` has bodies of its own */
    CASE_FOR_SWEEP = 64,     /* sweep, and what it runs needs */
    CASE_FOR_STRIKE = 128,   /* strike, a scene with bodies; the shot, where the projectile's speed is its */
    CASE_FOR_LIFE = 256,     /* life; its material's constants of elasticity and fatigue */
    CASE_FOR_VESSEL = 512,   /* vessel; its film's constants of strength and failure */
    CASE_FOR_TARGETS = 1024  /* with CASE_FOR_STRIKE: targets */
};

/* A layer of the rail's surface, the first in the list at the bottom. */
typedef struct {
    char material[BASE_PARAM_TEXT_SIZE];
    double thickness;     /* [m] */
    double bond_strength; /* to what lies below [Pa]; NAN: welded for good */
    double yield_scale;   /* factor on the yield stress [1] */
    double cold_work;     /* plastic strain it has had; NAN: its material's [1] */
    double wear_rate;     /* volume that sliding wears off over force and way; NAN: it is not worn [m^3/N/m] */
} case_layer;

typedef struct {
    int n;
    case_layer *item; /* n, owned by the case */
} case_layers;

/* The rail as the scene sees it. */
typedef struct {
    char material[BASE_PARAM_TEXT_SIZE];
    double temperature; /* ahead of the armature [K] */
    double yield_scale; /* hardening: factor on the yield stress, and on the hardness in the screen [1] */
    double cold_work;   /* plastic strain it has had; NAN: its material's [1] */
    case_layers layers;
} case_rail;

#define CASE_ROOM_TEMPERATURE 293.0 /* of what is not said to be warmer [K] */

/* The armature's body in the scene: half a U, one leg on one rail; a head alone where that is all its length. */
typedef struct {
    char material[BASE_PARAM_TEXT_SIZE];
    double lead_angle;     /* between the lead face and the rail's surface [rad] */
    double length;         /* along the rail [m] */
    double leg_thickness;  /* normal to the rail [m] */
    double head_thickness; /* along the rail [m] */
    double half_bore;      /* from the rail's surface to the middle of the bore [m] */
    double width;          /* full width across the rail [m] */
    double chamfer_height; /* of the lead face, normal to the rail [m] */
    double temperature;    /* NAN: its lead face's in a study, else CASE_ROOM_TEMPERATURE [K] */
    double yield_scale;    /* factor on its flow stress, and on the hardness in the screen [1] */
} case_projectile;

/* What a site does not say itself; the grain of `breech scene`. */
typedef struct {
    double radius; /* [m], NAN: not given */
    double height; /* [m], resolved to the radius when not given */
    char shape[BASE_PARAM_TEXT_SIZE];
    char material[BASE_PARAM_TEXT_SIZE]; /* resolved to the rail's when not given */
    double bond_strength;                /* to the rail [Pa]; NAN: welded for good */
} case_particle;

/* A grain on the rail; all but the position resolved from `particle` where not given. */
typedef struct {
    double position; /* along the barrel, from the breech [m] */
    double radius;   /* [m] */
    double height;   /* [m] */
    char shape[BASE_PARAM_TEXT_SIZE];
    char material[BASE_PARAM_TEXT_SIZE];
    double bond_strength; /* [Pa]; NAN: welded for good */
} case_site;

typedef struct {
    int n;
    case_site *item; /* n, owned by the case, in the file's order */
} case_sites;

/* A size of a tabulated population. */
typedef struct {
    double radius; /* [m] */
    double share;  /* of the grains; need not add up to 1 [1] */
} case_size;

typedef struct {
    int n;
    case_size *item; /* n, owned by the case */
} case_sizes;

/* Grains strewn at random: a Poisson process along the barrel, sizes log-normal or tabulated.  What a preset says is
 * resolved where not given. */
typedef struct {
    int preset;           /* population_preset */
    double density;       /* grains on a metre of the rail [1/m] */
    double radius_median; /* [m]; NAN with `sizes` */
    double radius_spread; /* standard deviation of ln radius [1] */
    double aspect;        /* height over radius [1] */
    double from, to;      /* stretch of the barrel they lie on; NAN: its ends [m] */
    char shape[BASE_PARAM_TEXT_SIZE];
    char material[BASE_PARAM_TEXT_SIZE]; /* resolved to the rail's when not given */
    double bond_strength;                /* [Pa]; NAN: welded for good */
    bool renewed;                        /* strewn anew before every shot; no: what one shot passed is gone */
    case_sizes sizes;
} case_population;

typedef struct {
    int n;
    case_population *item; /* n, owned by the case */
} case_populations;

/* Where grains come from; what each assumes stands in its line of population.def. */
typedef enum {
    POPULATION_NONE,
#define POPULATION(name, ...) POPULATION_##name,
#include "coupling/case/population.def"
#undef POPULATION
    POPULATION_PRESETS
} population_preset;

/* The settings of one kind of treatment; what they mean says its table, treatment_<kind>.c. */
enum { TREATMENT_VALUES = 3 };
typedef struct {
    double value[TREATMENT_VALUES];
    char material[BASE_PARAM_TEXT_SIZE];
    case_layers layers;
} treatment_settings;

enum {
#define TREATMENT(name, doc) TREATMENT_##name,
#include "coupling/case/treatment.def"
#undef TREATMENT
    TREATMENT_KINDS
};

/* A rail surface to compare: all that is changed on the case (treatment.h). */
typedef struct {
    char name[BASE_PARAM_TEXT_SIZE];
    treatment_settings kind[TREATMENT_KINDS];
} case_treatment;

typedef struct {
    int n;
    case_treatment *item; /* n, owned by the case */
} case_treatments;

/* How a scene is built and run.  Extents that are NAN are chosen by the hand-off from the grain's radius. */
typedef struct {
    double velocity;                /* of `breech scene`; onset takes the shot's [m/s] */
    double contact_pressure;        /* NAN: the shot's, or zero in `breech scene` [Pa] */
    double friction;                /* Coulomb coefficient between armature, grain and rail [1] */
    double shear_limit;             /* upper limit of the friction stress [Pa], NAN: none */
    double cells_per_radius;        /* fine cell = radius / this [1] */
    double cells_per_layer;         /* across each layer of the rail where it flows; 0: no more than the grain's [1] */
    double coarse_cell;             /* largest cell [m] */
    double refine_tolerance;        /* share of the velocity that plastic flow may change across a cell [1] */
    double growth;                  /* ratio of neighbouring cells outside the fine zone [1] */
    bool follow;                    /* the groove's growth past the grain is gauged */
    bool cells_grow;                /* with a groove that is followed, past its second gauge */
    double rail_ahead, rail_behind; /* ends of the rail modelled, from the grain's middle [m] */
    double rail_depth;              /* [m] */
    double rail_width;              /* full; NAN: the projectile's [m] */
    double end_time;                /* NAN: from the lengths and the velocity [s] */
    bool stop_when_settled;         /* stop once the crater no longer changes */
    bool stop_when_gauged;          /* stop once the groove's growth, and with it the class, is known */
    int levels;                     /* from here on as in mpm_scene (MPM_METHOD_PARAMS): 0: as coarse_cell allows */
    double grid_shift[3];           /* [finest cells] */
    double courant;                 /* of c + |v| [1] */
    double viscosity_linear, viscosity_quadratic; /* (M-5) [1] */
    int particles_per_axis;
    mpm_transfer_kind transfer;
    mpm_basis_kind basis;
    bool heat_by_plastic_work;      /* (M-4); to here */
    bool damage;                    /* Johnson-Cook damage in all bodies */
    bool half_model;                /* only z >= 0, mirrored */
    double measuring_depth;         /* from which a crater counts; NAN: crater.h's [m] */
    double limit_widening;          /* of a crater that is a gouge by its shape [1] */
    double limit_severity;          /* the same [1] */
    double limit_length_over_width; /* at its second gauge: a gouge is not longer [1] */
    double growth_scatter;          /* e-folds between the gauges within which growth decides nothing [1] */
} case_scene;

/* What becomes of bodies that overlap. */
typedef enum { OVERLAP_REFUSED, OVERLAP_LATER } case_overlap;

/* A scene whose bodies stand in the case itself (case_bodies.h). */
typedef struct {
    mpm_scene scene; /* owned; its materials are the case's.  Window and cells that are left out are NAN: scene_fill */
    int overlap;     /* case_overlap */
} case_bodies;

/* A projectile's arrival at its target, the other bodies of the scene. */
typedef struct {
    char projectile[BASE_PARAM_TEXT_SIZE]; /* body of scene.bodies; those of its group fly with it */
    char plate[BASE_PARAM_TEXT_SIZE];      /* body of the target whose holes are looked for; "": none */
    double velocity;                       /* at arrival; NAN: the shot's, or what the body has in the scene [m/s] */
    double distance;                       /* from the muzzle to the target [m] */
    double drag_coefficient;               /* NAN: not given [1] */
    double drag_area;                      /* NAN: not given [m2] */
    double air_density;                    /* [kg/m3] */
    double discarded_mass;                 /* of the package, stays behind at the muzzle [kg] */
    double travel;                         /* its way in the scene, at its arrival velocity; NAN: scene.end_time [m] */
    double filter;                         /* over which forces are averaged [s] */
    bool limit;                            /* the limit velocity is looked for, in the range of `study` */
} case_strike;

/* A load that comes again and again, and the life of the rail under it (coupling/life). */
typedef enum { LIFE_WHEEL, LIFE_ARMATURE } life_load;
typedef enum { LIFE_HERTZ, LIFE_UNIFORM, LIFE_POINTS } life_profile;
typedef enum { LIFE_FRICTIONLESS, LIFE_STICK_SLIP, LIFE_FULL_SLIP } life_state;
typedef enum { LIFE_PULSE, LIFE_PASSAGE } life_cycle;
typedef enum { LIFE_EVEN, LIFE_LATTICE } life_fan;
typedef enum { LIFE_UNTIL_FIRST, LIFE_UNTIL_CRACK } life_until;

/* A point of a tabulated load; straight lines between. */
typedef struct {
    double at;       /* over half_length [1] */
    double pressure; /* over the peak pressure [1] */
    double traction; /* the same; NAN: friction times the pressure [1] */
} case_life_point;

typedef struct {
    int n;
    case_life_point *item; /* n, owned by the case */
} case_life_points;

typedef struct {
    char material[BASE_PARAM_TEXT_SIZE]; /* of the rail */
    int load;                            /* life_load */
    int places;                          /* along the barrel, of an armature's load */
    double rounding;                     /* of its pressure: rises over this share of the half length at each end [1] */
    bool heat;                           /* of its passage counts */
    double probe_depth;                  /* whose warmth is asked for; NAN: none [m] */
    int profile;                         /* life_profile */
    double wheel_load;                   /* P on the whole ellipse; NAN: `pressure` is given [N] */
    double pressure;                     /* largest; NAN: of wheel_load [Pa] */
    double half_length, half_width;      /* of the patch, along and across the rail; half_width NAN: not given [m] */
    int state;                           /* life_state */
    double friction;                     /* [1] */
    double traction_share;               /* Q / (mu P') of stick-slip [1] */
    int cycle;                           /* life_cycle */
    double speed;                        /* of a passage; 0: slow against waves [m/s] */
    int measure;                         /* fatigue_measure */
    int fan;                             /* life_fan */
    int directions;                      /* of an even fan */
    int until;                           /* life_until */
    double limit_index;                  /* share of a point's directions whose loss is a crack [1] */
    double batch;                        /* cuts within this share of the cycles are one step [1] */
    int max_cuts;                        /* 0: the intact rail on the grid, no cut */
    int cells_per_half_length;           /* of the grid */
    double grid_half_width, grid_depth;  /* of the grid [half lengths] */
    case_life_points points;             /* of LIFE_POINTS */
} case_life;

/* Gas in liquid inside a shell that swells and bursts (coupling/vessel). */
typedef enum { VESSEL_CYLINDER, VESSEL_SPHERE } vessel_shape;

typedef struct {
    double radius; /* at the start [m] */
} case_bubble;

typedef struct {
    int n;
    case_bubble *item; /* n, owned by the case */
} case_bubbles;

typedef struct {
    int shape;                     /* vessel_shape */
    double radius, film_thickness; /* outer radius, at the start [m] */
    char film_material[BASE_PARAM_TEXT_SIZE];
    char liquid_material[BASE_PARAM_TEXT_SIZE];
    int layers;                                     /* of the film */
    double ambient, temperature;                    /* [Pa, K] */
    double critical_temperature, critical_pressure; /* of the gas; NAN: it is ideal [K, Pa] */
    double growth;                                  /* Jakob number Ja of (G-4) [1] */
    double diffusivity;                             /* of heat in the liquid [m2/s] */
    double hole, discharge;                         /* diameter, coefficient of the orifice [m, 1] */
    double molar_mass, gas_gamma;                   /* of the gas that leaves [kg/mol, 1] */
    double surface_tension;                         /* [N/m] */
    double end_time;                                /* [s] */
    case_bubbles bubbles;
} case_vessel;

/* What a study takes for the onset of gouging: the groove's growth, or the crater's severity. */
typedef enum { JUDGE_GROWTH, JUDGE_SEVERITY } study_judge;

/* What else a threshold's interval has to hold, known from elsewhere: a share of the velocity on either side. */
typedef struct {
    char part[BASE_PARAM_TEXT_SIZE]; /* what it is, in words */
    double threshold, scratch;       /* of the threshold, of the scratch velocity [1] */
    bool own;                        /* each surface of a comparison has its own error of it, not all the same */
} case_interval_part;

typedef struct {
    int n;
    case_interval_part *item; /* n, owned by the case */
} case_interval_parts;

/* The search for where gouging begins. */
typedef struct {
    double velocity_interval;           /* wanted width of the threshold's interval over its middle [1] */
    double position_interval;           /* wanted width of the threshold position's, over the barrel's length [1] */
    double velocity_low, velocity_high; /* where the search may look [m/s] */
    int judge;                          /* study_judge */
    int max_scenes;
    int ensemble; /* grids, each shifted by another part of a cell, on which `breech scene` computes; 0: its own */
    int threshold_ensemble; /* the same of the scene nearest a threshold; 0: its own, and its scatter is not known */
    int craters;            /* whole scenes of a family of grains that gouges, judged by growth: 0 .. 2 */
    bool scratch;           /* the scratch velocity is looked for too, judged by growth */
    double screen_low;      /* impact pressure over hardness below which no scene is needed [1] */
    double coarse_cells_per_radius, fine_cells_per_radius; /* [1] */
    double crater_cells_per_radius;                        /* of whole craters; NAN: those of the search [1] */
    double resolution_error;                               /* share that finer cells may move a threshold by [1] */
    double resolution_above;                               /* the same upwards, judged by growth [1] */
    double strength_error, armature_error;                 /* of rail's and armature's yield_scale, relative [1] */
    double friction_error;                                 /* of scene.friction, relative [1] */
    case_interval_parts interval_parts;
    bool feedback;          /* a gouge's impulse and mass loss go back into the shot */
    bool sensitivities;     /* the shot again with changed inputs */
    int shots;              /* fired one after the other on the same rail */
    double heat_kept;       /* in the rails from shot to shot [1] */
    double deposit_kept;    /* of the armature's metal on the rail, from shot to shot; NAN: none is carried on [1] */
    int sampled;            /* histories of the Monte Carlo */
    int seed;               /* of its random numbers */
    double smallest_radius; /* grains of a population below it are taken not to gouge [m] */
} case_study;

/* What `breech sweep` runs (study/study_sweep.c): another study with other values of some keys. */
enum { CASE_SWEEP_KEYS = 8 };

enum { CASE_VALUE_SIZE = 256 }; /* of a value as text, a shape say */
typedef struct {
    char value[CASE_VALUE_SIZE]; /* as written */
} case_word;

typedef struct {
    int n;
    case_word *item; /* n, owned by the case */
} case_words;

typedef struct {
    char key[BASE_PARAM_TEXT_SIZE]; /* path.to.key, as --set has it */
    case_words values;
} case_varied;

typedef struct {
    int n;
    case_varied *item; /* n, owned by the case */
} case_varied_list;

typedef struct {
    char of[BASE_PARAM_TEXT_SIZE]; /* the study that is run */
    bool together;                 /* the lists go on together; else all combinations */
    case_varied_list vary;
    case_words read; /* keys of its summary */
} case_sweep;

/* A key of the case with another value. */
typedef struct {
    char key[BASE_PARAM_TEXT_SIZE]; /* path.to.key, as --set has it */
    char value[CASE_VALUE_SIZE];    /* as written */
} case_change;

typedef struct {
    int n;
    case_change *item; /* n, owned by the case */
} case_changes;

/* A target to compare with that of the case: all that is changed for it. */
typedef struct {
    char name[BASE_PARAM_TEXT_SIZE];
    case_changes change;
} case_target;

typedef struct {
    int n;
    case_target *item; /* n, owned by the case */
} case_targets;

typedef struct {
    int snapshots;              /* of one scene, evenly over its time, 1: of its end; 0 = none */
    double history_interval;    /* least time between two samples of the shot's history [s]; NAN: every step */
    double checkpoint_interval; /* wall time between two checkpoints [s] */
    bool report;                /* write report.html */
} case_output;

/* The groups of one kind of supply (circuit/supply/supply.h). */
typedef struct {
    int n;
    void *item; /* n structs of the kind, owned by the case */
} case_supplies;

typedef struct {
    int n;
    mpm_material *item; /* n, owned by the case */
} case_materials;

/* Sections given in the file (or by --set). */
typedef struct {
    bool supplies[CIRCUIT_SUPPLY_KINDS];
    bool rails, barrel, armature, options, optimise, rail, projectile, particle, sites, populations, treatments, scene,
        study, sweep, strike, targets, life, vessel, output;
    bool bodies; /* scene.bodies: then `scene` is not given */
} case_given;

/* ---- reading and looking up ---- */

typedef struct {
    const char *const
        *material_dirs; /* looked through in order, after the case's own `materials` and its folder; borrowed */
    int n_material_dirs;
    unsigned needs; /* sum of CASE_FOR_... */
} case_options;

/* A case file in memory; all borrowed. */
typedef struct {
    const char *bytes;
    size_t length;
    const char *path;        /* names it in the messages; materials are looked for in its folder */
    const char *const *sets; /* as in case_read */
    int n_sets;
} case_text;

/* The material of that name; a case has all that it names.  NULL: it is not among them.  Borrowed from the list. */
const mpm_material *case_material(const case_materials *list, const char *name);

double case_layers_thickness(const case_layers *layers); /* of all together [m] */
/* A layer more, at place `at` from below. */
status case_layers_add(case_layers *layers, int at, const case_layer *layer);

#endif
