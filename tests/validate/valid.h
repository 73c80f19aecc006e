/* SPDX-License-Identifier: BSD-3-Clause */
/* Validations V1 .. V13 (the list is in docs/validation/solver.md): small scenes with closed answers, each run at
 * several cell sizes.  breech-validate prints them as curves, error against cell size and against run time;
 * tests/test_valid.c holds the coarse ones to limits, the rest too with BREECH_FULL=1.
 *
 * To add one: a function of type `valid_case.run` in a file here and a line in valid.c's table.  Every run keeps
 * momentum and mass to rounding (V11): valid_finish books it, the test looks. */
#ifndef BREECH_TESTS_VALID_H
#define BREECH_TESTS_VALID_H

#include "mpm/memory/store.h"
#include "mpm_scenes.h"

enum { VALID_FIGURES = 4, VALID_LEVELS = 5 };

/* What may be compared: members of mpm_scene that a validation takes from outside. */
typedef struct {
    mpm_basis_kind basis;
    mpm_transfer_kind transfer;
    double courant;
} valid_scheme;
extern const valid_scheme valid_default;

typedef struct {
    double figure[VALID_FIGURES]; /* named by the case; the first is the error of its curve */
    double momentum, mass;        /* ledger: momentum_error; (mass + ejected) / mass at start - 1 */
    double energy;                /* ledger: energy_error, 0 where the case drives its points from outside */
    double particle_steps;
} valid_result;

typedef struct {
    const char *name, *doc;
    const char *figure[VALID_FIGURES]; /* NULL: not used */
    double cells[VALID_LEVELS];        /* resolutions, cells of `per`; 0 ends the list */
    const char *per;
    int quick; /* levels that run in seconds */
    /* Largest allowed figures at the last quick level, and at the last of all; HUGE_VAL: none. */
    double limit_quick[VALID_FIGURES], limit_full[VALID_FIGURES];
    double order; /* least slope of figure 0 between the first and the last level; 0: not asked for */
    void (*run)(double cells, const valid_scheme *scheme, valid_result *out);
} valid_case;

extern const valid_case valid_table[];
extern const int valid_cases;

/* valid_default's members into a scene that mpm_scene_default has made. */
void valid_apply(const valid_scheme *scheme, mpm_scene *s);

/* Adds the books of a run; frees the solver. */
void valid_finish(mpm *m, valid_result *out);

/* Every material point, to be changed from outside; in no stated order. */
typedef void valid_visit(void *user, block *q, int lane);
void valid_each(mpm *m, valid_visit *visit, void *user);

/* Opens the books anew, after the points have been changed from outside. */
void valid_reopen(mpm *m);

/* An elastic metal-like solid, linear up to the third order in the volume change and deaf to heat: E [Pa], nu, rho. */
mpm_material valid_solid(double youngs, double poisson, double density);

/* Processor time of this process [s] */
double valid_clock(void);

/* ---- the runs, one file each ---- */
void valid_cube(double cells, const valid_scheme *scheme, valid_result *out);
void valid_vortex(double cells, const valid_scheme *scheme, valid_result *out);
void valid_vortex_far(double cells, const valid_scheme *scheme, valid_result *out);
void valid_bar(double cells, const valid_scheme *scheme, valid_result *out);
void valid_hugoniot(double cells, const valid_scheme *scheme, valid_result *out);
void valid_carried(double cells, const valid_scheme *scheme, valid_result *out);
void valid_sod(double cells, const valid_scheme *scheme, valid_result *out);
void valid_noh(double cells, const valid_scheme *scheme, valid_result *out);
void valid_disks(double cells, const valid_scheme *scheme, valid_result *out);
void valid_block(double cells, const valid_scheme *scheme, valid_result *out);
void valid_tilted(double cells, const valid_scheme *scheme, valid_result *out);
void valid_fast(double cells, const valid_scheme *scheme, valid_result *out);
void valid_rolling(double cells, const valid_scheme *scheme, valid_result *out);
void valid_hertz(double cells, const valid_scheme *scheme, valid_result *out);
void valid_taylor(double cells, const valid_scheme *scheme, valid_result *out);
void valid_oblique(double cells, const valid_scheme *scheme, valid_result *out);
void valid_tension(double cells, const valid_scheme *scheme, valid_result *out);
void valid_slide(double cells, const valid_scheme *scheme, valid_result *out);

#endif
