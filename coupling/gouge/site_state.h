/* SPDX-License-Identifier: BSD-3-Clause */
/* From the shot to the sites: the armature's state on its arrival at every grain of the case.
 *
 * The shot is run once, the sites its located roots (no step passes over one); what it was along the way is kept as a
 * trace, so that a velocity becomes a place.  Gouges can be handed back as jumps at their sites. */
#ifndef BREECH_COUPLING_SITE_STATE_H
#define BREECH_COUPLING_SITE_STATE_H

#include "circuit/shot.h"
#include "coupling/case/case_plain.h"
#include "coupling/host/progress.h"
#include "coupling/output/history.h"

/* What an impact scene is made from. */
typedef struct {
    case_site grain;
    bool reached;                 /* the armature comes there; if not, all below is NaN */
    double time;                  /* of arrival [s] */
    double velocity;              /* [m/s] */
    double current;               /* [A] */
    double contact_pressure;      /* contact force of one face over the face, gouge_face_area [Pa] */
    double lead_face_temperature; /* NAN: no armature.throat_area [K] */
} site_state;

/* The shot at one accepted step. */
typedef struct {
    double t, x, v;               /* [s, m, m/s] */
    double contact_pressure;      /* on gouge_face_area [Pa] */
    double lead_face_temperature; /* [K] */
    double pressure;              /* on contact_length x contact_width, as the circuit has it [Pa] */
    double friction;              /* coefficient [1] */
    double rail_flux;             /* of the contact's heat into one rail's face [W/m^2] */
    double rail_sheet;            /* current on a metre of that face's height [A/m] */
    double film_rise;             /* of the armature's face, with its film, over the rail ahead [K] */
    double melted;                /* mass that all faces have lost to melting so far [kg] */
} trace_point;

/* What a gouge takes from the armature at its site. */
typedef struct {
    double impulse;   /* against the motion [N s] */
    double mass_loss; /* [kg] */
} site_jump;

typedef struct {
    circuit_shot_summary summary;
    circuit_shot_limits limits;
    double rail_rise[CIRCUIT_SHOT_PIECES]; /* that the shot leaves, along the barrel [K] */
    int n_sites;
    site_state *site; /* in the case's order, owned */
    int n_trace, trace_room;
    trace_point *trace; /* owned */
} shot_outcome;

/* How a shot is run; members that are NULL are not wanted. */
typedef struct {
    history *history;      /* takes /shot, /shot/modules, /shot/events */
    progress *progress;    /* measured by the way in the barrel */
    const site_jump *jump; /* one a site of the case, taken when it is passed */
    bool (*stop)(void);    /* true: stop after the step, STATUS_STOPPED */
} shot_plan;

/* One shot, past the flight's sites where there are any.  *out needs gouge_shot_outcome_free even on error.
 * STATUS_NUMERICAL, STATUS_BAD_INPUT as circuit_shot_create and circuit_shot_advance. */
status gouge_shot_run(const case_flight *f, const shot_plan *plan, shot_outcome *out);
void gouge_shot_outcome_free(shot_outcome *o); /* NULL allowed */

/* The two ways to ask a shot where it is how fast, both linear between two steps; nobody else reads the trace.
 * false: the armature never has that velocity, or is never at that place; *at is then the end of the trace. */
bool gouge_trace_at_velocity(const shot_outcome *o, double v, trace_point *at); /* the first instant */
bool gouge_trace_at_place(const shot_outcome *o, double x, trace_point *at);
/* One number of these: x(v) [m], NaN if it never has v; v(x) [m/s], 0 if it is never at x. */
double gouge_trace_place(const shot_outcome *o, double v);
double gouge_trace_velocity(const shot_outcome *o, double x);
double gouge_trace_fastest(const shot_outcome *o); /* [m/s] */

/* Nominal contact face of one leg: its length without the lead face, times its width [m2]. */
double gouge_face_area(const case_projectile *p);

#endif
