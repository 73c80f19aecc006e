/* SPDX-License-Identifier: BSD-3-Clause */
/* Rails as perfect conductors: the surface current on the outline, by panels of constant current graded to the corners.
 */
#ifndef BREECH_CIRCUIT_PERIMETER_H
#define BREECH_CIRCUIT_PERIMETER_H

#include "circuit/rails/section.h"

/* L of the whole [H/m], and R over sqrt(frequency) that a thin skin has in the metals' own surface impedance (C-9)
 * [ohm/m/Hz^1/2]. */
status circuit_perimeter_solve(const circuit_rail_section *s, double *L, double *skin);

/* Mean surface current of a rail, weighted with itself, over the whole current by the rail's height; the metals
 * count for nothing in it.  To 1 % that of a skin of 1/100 of the section, 4 % where rails nearly touch; in less than
 * 1 ms [1]. */
status circuit_perimeter_sheet(const circuit_rail_section *s, double *sheet);

#endif
