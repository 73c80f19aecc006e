/* Parallel filaments in one quarter of a pair of rails carrying +I and -I: y = 0 mirrors the current, x = 0 mirrors and
 * reverses it.  The vector potential of filament j at i, averaged over both sections (Galerkin), is
 *   A_i = - mu0/(2 pi) sum_j I_j <ln r_ij>                                                               (C-8) [Wb/m] */
#ifndef BREECH_CIRCUIT_FILAMENTS_H
#define BREECH_CIRCUIT_FILAMENTS_H

#include "base/status.h"

typedef struct {
    double x, y, a, b; /* centre and full sizes along x and y [m] */
} filament;

typedef struct {
    int n;
    filament *cell;
    double *R; /* [ohm/m] */
} filaments;

/* Section h, w, s [m] of resistivity [ohm m], cells graded from a fraction of `depth` [m] at the surface. */
status filaments_of_rectangle(const double section[3], double resistivity, double depth, filaments *out);
void filaments_free(filaments *f);

/* n x n inductances of one quarter's filaments, images included [H/m]; the caller frees *L. */
status filaments_inductance(const filaments *f, double **L);

/* Cell sizes over `length`, growing from `first` by `growth` at most away from one end, or from both (ends = 2).  Returns
 * their number; `size` must hold them. */
int filaments_graded(double length, double first, double growth, int ends, double *size);

#endif
