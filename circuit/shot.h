/* SPDX-License-Identifier: BSD-3-Clause */
/* The shot: from the charged bank to the armature leaving the muzzle, as one circuit with a moving part.
 *
 * circuit_shot_create copies the configuration; circuit_shot_advance integrates until a time and calls the sinks;
 * everything else reads. SI units throughout.  No files, no printing.  Equations by tag: docs/theory/circuit.md.
 * To add a parameter: a member in its struct and one line in its table (circuit/shot_params.c); reader, manual and
 * checks follow.  Laws that tests/test_circuit_shot.c checks for every shot it makes:
 *   all energy now + all heat and work so far = energy at the start           (ledger.energy_error, default < 1e-6)
 *   every switching and every site is a located instant, none is stepped over; the number of switchings is bounded. */
#ifndef BREECH_CIRCUIT_SHOT_H
#define BREECH_CIRCUIT_SHOT_H

#include "base/param.h"
#include "base/status.h"
#include "circuit/rails/rails_heat.h"
#include "circuit/rails/section.h"
#include "circuit/supply/supply.h"

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef enum {
    CIRCUIT_SHOT_RAILS_CONSTANT,
    CIRCUIT_SHOT_RAILS_SKIN,
    CIRCUIT_SHOT_RAILS_DIFFUSING
} circuit_shot_rail_level;
extern const char *const circuit_shot_rail_level_names[]; /* "constant", .., NULL */

/* Equal rails (circuit/rails/section.h).  constant: the gradients are given; skin: those of the section at one
 * frequency; diffusing: every slice of rail has its own history since the armature exposed it (circuit/rails/rails.h).
 */
typedef struct {
    int level;                      /* circuit_shot_rail_level */
    double height;                  /* across the bore, along the contact line of the armature [m] */
    double thickness;               /* [m] */
    double separation;              /* between the facing surfaces, at their middles [m] */
    int count;                      /* 2 or 4 */
    double face_crown, back_crown;  /* sagittas of the faces' arcs [m] */
    double cladding;                /* thickness of a layer on the bore face [m] */
    double cladding_resistivity;    /* [ohm m] */
    double resistivity;             /* at 293.15 K [ohm m] */
    double resistivity_coefficient; /* [1/K] */
    double initial_temperature;     /* before the shot [K] */
    double inductance_gradient;     /* level constant [H/m] */
    double resistance_gradient;     /* level constant, both rails together [ohm/m] */
    double frequency;               /* level skin [Hz]; NAN = from the pulse, equation (C-6) */
    double density;                 /* [kg/m^3] */
    double specific_heat;           /* [J/kg/K] */
    double thermal_conductivity;    /* [W/m/K] */
    double youngs_modulus;          /* [Pa] */
    double backing_stiffness;       /* of the bed, force per length and deflection; NAN = not asked for [Pa] */
    double ladder_error;            /* level diffusing: largest error of the ladder over its band [1] */
    double ladder_frequency;        /* level diffusing: top of that band [Hz]; NAN = equation (C-13) */
    double fineness;                /* filaments over the skin depth [1] */
    int slices;                     /* of the barrel, with a temperature and resistance of their own; 0 = none */
    double heat_capacity;           /* of the metal [J/m^3/K] */
} circuit_shot_rails;

typedef struct {
    double length;            /* breech (x = 0) to muzzle [m] */
    double start;             /* current path's position at t = 0 [m] */
    double muzzle_resistance; /* of the shunt or arc that takes the current after exit [ohm] */
    double muzzle_voltage;    /* arc's constant part, 0 for a shunt [V] */
    double shunt_resistance;  /* of a shunt across the muzzle from the start [ohm]; NAN = none */
    double shunt_inductance;  /* its own [H] */
} circuit_shot_barrel;

typedef enum { CIRCUIT_SHOT_FRICTION_SPEED, CIRCUIT_SHOT_FRICTION_FILM } circuit_shot_friction_law;
extern const char *const circuit_shot_friction_law_names[]; /* "speed", "film", NULL */

/* Friction.  speed: (C-4), a coefficient that falls with speed.  film: friction_dry until the face has melted (event
 * CIRCUIT_SHOT_MELTED), then the shear of the melt (circuit/armature/film.h), never more than friction_dry; what melts
 * then is also what wears, and nothing before. At rest the face is solid. */
typedef struct {
    double mass;            /* [kg] */
    double velocity;        /* at t = 0 [m/s] */
    double resistance;      /* [ohm] */
    double contact_voltage; /* from rail to rail, both contacts on the way together [V] */
    int friction_law;       /* circuit_shot_friction_law */
    double friction_dry;    /* mu0 [1] */
    double friction_melted; /* mu1 [1] */
    double friction_speed;  /* speed over which mu falls from mu0 to mu1, equation (C-4) [m/s] */
    double film_viscosity;  /* of the melt, friction_law film [Pa s] */
    bool velocity_skin;     /* the current crowds to the trailing edge of the contact, circuit/armature/contact.h */
    double preload;         /* contact force per rail face at I = 0 [N] */
    double spreading;       /* k in N = preload + k I^2, per rail face, I the whole current [N/A^2] */
    double bore_area;       /* drag; NAN = separation x height [m^2] */
    double gas_pressure;    /* ahead of the armature; 0 with density 0 is vacuum [Pa] */
    double gas_density;     /* [kg/m^3] */
    double gas_gamma;       /* ratio of specific heats [1] */
    double wear_fraction;   /* share of the contact's heat that melts metal off, 0 = no wear, at most heat_share [1] */
    double specific_heat;   /* [J/kg/K] */
    double melting_temperature;     /* [K] */
    double latent_heat;             /* [J/kg] */
    double initial_temperature;     /* before the shot [K] */
    double density;                 /* [kg/m^3] */
    double thermal_conductivity;    /* [W/m/K] */
    double contact_length;          /* along the rail, one face [m] */
    double contact_width;           /* across the rail, one face; NAN = the rail's height [m] */
    double heat_share;              /* of the contact's heat that enters the armature [1] */
    double resistivity;             /* at 293.15 K [ohm m] */
    double resistivity_coefficient; /* [1/K] */
    double leg_area, throat_area;   /* the current's cross-section in one leg, in the throat; NAN = not given [m^2] */
    double wear_thickness;          /* that wear may take; NAN = not asked for [m] */
} circuit_shot_armature;

typedef struct {
    double rtol;     /* relative tolerance of the integration [1] */
    double atol;     /* absolute tolerance, as a share of each quantity's scale [1] */
    double max_time; /* circuit_shot_advance never goes further [s] */
} circuit_shot_options;

/* Keys, units, defaults, ranges and texts; the case reader is made from them. */
extern const base_param circuit_shot_rails_params[];
extern const base_param circuit_shot_barrel_params[];
extern const base_param circuit_shot_armature_params[];
extern const base_param circuit_shot_options_params[];

typedef struct {
    circuit_supply_list supplies[CIRCUIT_SUPPLY_KINDS]; /* by kind: groups are numbered in this order */
    circuit_shot_rails rails;
    /* Of these rails, from circuit_rails_ladder: for many shots with one section.  NULL = fitted by
     * circuit_shot_create in about 0.1 s.  Borrowed until it returns. */
    const circuit_ladder *fitted;
    circuit_shot_barrel barrel;
    circuit_shot_armature armature;
    circuit_shot_options options;
    const double
        *sites; /* positions, any order, each in (start, length) [m]; borrowed until circuit_shot_create returns */
    int n_sites;
} circuit_shot_config;

/* Where the energy is and went [J]: a member for every line of circuit/ledger.def. */
typedef struct {
#define STORED(member, column, text) double member;
#define SPENT(member, column, text) double member;
#define GIVEN(place, member, column, text) double member;
#include "circuit/ledger.def"
    double start;          /* supplies and motion at t = 0 [J] */
    double momentum_jumps; /* impulse taken by circuit_shot_jump [N s] */
    double mass_jumps;     /* mass taken by circuit_shot_jump [kg] */
    double energy_error;   /* (stored + spent - start - given)/(start + given); 0 where those are 0 [1] */
} circuit_shot_ledger;

typedef enum { CIRCUIT_SHOT_HELD, CIRCUIT_SHOT_MOVING, CIRCUIT_SHOT_LEFT } circuit_shot_phase;

/* Everything at one instant.  After the exit x, v, the armature's temperatures, its film and contact_spread stay at
 * their exit values. */
typedef struct {
    double t, x, v, a;              /* [s, m, m/s, m/s^2] */
    double current;                 /* of the rails behind the armature [A] */
    double shunt_current;           /* of the muzzle shunt: the armature carries the rest [A] */
    double breech_voltage;          /* [V] */
    double muzzle_voltage;          /* between the rails ahead of the armature, then across the shunt [V] */
    double force;                   /* electromagnetic, equation (C-2) [N] */
    double friction;                /* all faces, one a rail [N] */
    double drag;                    /* gas [N] */
    double friction_coefficient;    /* mu(v) [1] */
    double contact_force;           /* per rail face [N] */
    double contact_pressure;        /* contact_force over contact_length x contact_width [Pa] */
    double action;                  /* integral of I^2 dt [A^2 s] */
    double mass;                    /* of the armature now [kg] */
    double rail_temperature;        /* just ahead of the armature: as before the shot [K] */
    double armature_temperature;    /* of the contact face, estimate (C-7), at most melting [K] */
    double lead_face_temperature;   /* of the lead face, to which the current diffuses, (C-28); NAN: throat_area
                                       is not given [K] */
    double film_temperature;        /* of the melt on it, estimate (C-16) [K] */
    double film_thickness;          /* of that melt, one face [m] */
    double contact_spread;          /* length of the contact over which the current enters, (C-22) [m] */
    double rail_behind_temperature; /* rail surface one contact length behind, estimate (C-17) [K] */
    double rail_flux;               /* of the contact's heat into one rail's face [W/m^2] */
    double rail_sheet;              /* current on a metre of that face's height, just exposed [A/m] */
    circuit_shot_phase phase;
    circuit_shot_ledger ledger;
} circuit_shot_state;

typedef enum {
    CIRCUIT_SHOT_FIRED,    /* group `index` conducts (numbered from 0 in the order of the kinds) */
    CIRCUIT_SHOT_WAITING,  /* group `index` was fired but its voltage is below the breech's: conducts once it is not */
    CIRCUIT_SHOT_CROWBAR,  /* diode of group `index` conducts */
    CIRCUIT_SHOT_BLOCKED,  /* thyristor of group `index` blocks for good */
    CIRCUIT_SHOT_RELEASED, /* the armature starts to move */
    CIRCUIT_SHOT_STOPPED,  /* the armature came to rest inside the barrel */
    CIRCUIT_SHOT_SITE,     /* site `index` (in the order given) is passed */
    CIRCUIT_SHOT_MUZZLE,   /* the armature leaves */
    CIRCUIT_SHOT_COMMUTATED, /* opening switch of group `index`: its current has gone over into the rails */
    CIRCUIT_SHOT_RECHARGED,  /* diode of group `index` blocks again, its current having reversed */
    CIRCUIT_SHOT_MELTED,     /* the armature's face has melted: it slides on a film (friction_law film) */
    CIRCUIT_SHOT_EVENT_COUNT
} circuit_shot_event_kind;

typedef struct {
    circuit_shot_event_kind kind;
    int index;                /* of the group or site, else -1 */
    circuit_shot_state state; /* just after the event; at a site at barrel.length, just before the exit */
} circuit_shot_event;

typedef struct circuit_shot circuit_shot; /* owns all its memory */

/* Sinks; both may be NULL.  Return false to stop: circuit_shot_advance then returns BASE_STATUS_STOPPED and may be
 * called again.  From `event` at a CIRCUIT_SHOT_SITE, circuit_shot_jump may be called; anything else that changes the
 * shot may not. */
typedef struct {
    bool (*event)(void *user, circuit_shot *s, const circuit_shot_event *e);
    bool (*sample)(void *user, const circuit_shot *s,
                   const circuit_shot_state *state); /* first call, every accepted step */
    void *user;                                      /* borrowed */
} circuit_shot_sink;

/* The keys of summary.json (docs/reference/output.md).  NAN where the armature has not left. */
typedef struct {
    double peak_current;      /* [A] */
    double muzzle_velocity;   /* [m/s] */
    double muzzle_time;       /* [s] */
    double muzzle_energy;     /* kinetic, at exit [J] */
    double efficiency;        /* muzzle_energy over the energy at the start and supplied since [1] */
    double action;            /* until exit, or so far [A^2 s] */
    double peak_acceleration; /* [m/s^2] */
    double exit_current;      /* [A] */
    double energy_error;      /* over the energy at the start [1] */
    uint64_t steps;           /* accepted steps and located instants */
    bool worn_away;           /* nothing is left of the armature: advancing failed */
    double end_time;          /* as far as the shot was followed [s] */
    double end_position;      /* of the armature then; after its exit the muzzle [m] */
    double end_velocity;      /* then; after its exit the one it left with [m/s] */
    bool time_ran_out; /* max_time came while the armature moved in the barrel, or stood under a current still rising */
} circuit_shot_summary;

/* How near the armature and the rails have come to their limits; NAN where the configuration does not ask, or nothing
 * was reached.  Above 1 (contact_ratio: below 1) the contact is expected to go over into an arc: transition. */
typedef struct {
    double contact_ratio;       /* least contact force over 1 gram-force per ampere of its face, in motion [1] */
    double leg_action;          /* action over that which melts the leg, (C-18) [1] */
    double throat_action;       /* the throat alike [1] */
    double wear_share;          /* thickness worn off, where it is most, over leg_thickness [1] */
    double melt_position;       /* where the face melted first, friction_law film [m] */
    double contact_position;    /* where contact_ratio first falls below 1 [m] */
    double transition_position; /* where the first of the four passes its limit [m] */
    double critical_velocity;   /* of bending waves in the rail on its bed, (C-19) [m/s] */
    double critical_position;   /* where the armature first exceeds it [m] */
} circuit_shot_limits;

/* What a single value cannot say: BASE_STATUS_BAD_INPUT names the parameter, its value, unit and range.  The rails:
 * circuit_rails_check. */
base_status circuit_shot_check(const circuit_shot_config *config);
/* As circuit_shot_check, and the rails.  Caller frees *out with circuit_shot_free. */
base_status circuit_shot_create(const circuit_shot_config *config, circuit_shot **out);
void circuit_shot_free(circuit_shot *s); /* NULL allowed */

/* Integrates until t = until, or max_time, or until nothing can happen any more (circuit_shot_done), whichever comes
 * first. sink may be NULL.  BASE_STATUS_NUMERICAL says at which time and what to try. */
base_status circuit_shot_advance(circuit_shot *s, double until, const circuit_shot_sink *sink);

/* Rest or exit, no current, nothing left to fire. */
bool circuit_shot_done(const circuit_shot *s);

circuit_shot_state circuit_shot_now(const circuit_shot *s);
circuit_shot_summary circuit_shot_result(const circuit_shot *s);
circuit_shot_limits circuit_shot_limits_of(const circuit_shot *s); /* until exit, or so far */

/* What the shot has left in its rails so far: rise of temperature once the heat has evened out over their section, by
 * pieces of the barrel.  Current's heat, and the rails' share of the contact's (1 - armature.heat_share). [K] */
enum { CIRCUIT_SHOT_PIECES = CIRCUIT_RAILS_PIECES };
void circuit_shot_rail_rise(const circuit_shot *s, double rise[CIRCUIT_SHOT_PIECES]);

double circuit_shot_module_current(const circuit_shot *s, int group); /* one unit of the group [A] */
double circuit_shot_module_voltage(const circuit_shot *s, int group); /* of its capacitor, switch or machine [V] */
int circuit_shot_module_count(const circuit_shot *s);                 /* groups */

/* A gouge: takes `impulse` [N s] (against the motion) and `mass_loss` [kg] (leaving at the armature's speed) at the
 * present instant; booked in the ledger.  An impulse larger than the momentum stops the armature.
 * BASE_STATUS_BAD_INPUT for negative values or more mass than there is, and for an armature that does not move: at a
 * site at barrel.length it has left, at one that it stopped at before it is held (circuit_shot_now tells the phase). */
base_status circuit_shot_jump(circuit_shot *s, double impulse, double mass_loss);

/* L' [H/m] and R' [ohm/m] of the pair at frequency f [Hz], by the level: constant returns what was given; skin and
 * diffusing solve the section (circuit/rails/inductance.h).  f = 0 is direct current, INFINITY the perfect conductor
 * (R' is then INFINITY). */
base_status circuit_rails_impedance(const circuit_shot_rails *rails, double f, double *inductance, double *resistance);

/* The cross-section at the temperature before the shot. */
base_status circuit_rails_section(const circuit_shot_rails *rails, circuit_rail_section *out);
/* What a shot needs of its rails: the numbers of level constant, else the section. */
base_status circuit_rails_check(const circuit_shot_rails *rails);

/* The ladder that stands for the rails: at level diffusing fitted up to f_top [Hz], else L', R' at f_top and no rungs.
 */
base_status circuit_rails_ladder(const circuit_shot_rails *rails, double f_top, circuit_ladder *out);

/* The frequency that level skin takes when none is given, equation (C-6), by the supplies that fire before
 * options.max_time [Hz]; NAN if none does. */
double circuit_shot_effective_frequency(const circuit_shot_config *c);

#ifdef __cplusplus
}
#endif

#endif
