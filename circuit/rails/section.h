/* SPDX-License-Identifier: BSD-3-Clause */
/* Cross-section of a set of equal rails, and its symmetry.
 *
 * The bore is at x = 0; the first rail lies at x > 0, symmetric about y = 0, its bore face at x = s/2 + (arc), its back
 * at x = s/2 + w - (arc).  Crowned faces are circular arcs that recede by the crown at y = +-h/2; with both crowns h/2
 * and w = h the rail is round, with one it is D-shaped.  Two rails: the second at x < 0 carries the current back.  Four
 * rails: one at each of +-x carries half the current, one at each of +-y half of it back.  What is solved is the
 * quarter of one rail's neighbourhood, y > 0, and its images. */
#ifndef BREECH_CIRCUIT_SECTION_H
#define BREECH_CIRCUIT_SECTION_H

#include "base/status.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
    double height, thickness;    /* h across the bore; w, both at the middle [m] */
    double separation;           /* s of facing bore faces at the middle [m] */
    double face_crown;           /* [m]; 0 = flat */
    double back_crown;           /* [m] */
    double cladding;             /* thickness of the layer on the bore face, along x [m]; 0 = none */
    double resistivity;          /* [ohm m] */
    double cladding_resistivity; /* [ohm m] */
    int rails;                   /* 2 or 4 */
} circuit_rail_section;

typedef struct {
    double x, y; /* [m] */
} circuit_section_point;

base_status
circuit_section_check(const circuit_rail_section *s); /* BASE_STATUS_BAD_INPUT names the key, its value and range */

double circuit_section_face(const circuit_rail_section *s, double y); /* x of the bore face at |y| <= h/2 [m] */
double circuit_section_back(const circuit_rail_section *s, double y);
double circuit_section_metal_area(const circuit_rail_section *s); /* of one rail [m^2] */
double circuit_section_resistance(const circuit_rail_section *s); /* of all as one loop, to direct current [ohm/m] */

/* Lines y[0] = h/2 > y[1] > .. > y[n] = 0 across a face: rows grow from `first` [m] by `growth`, and span no more than
 * `step` radians of the more curved face's arc.  Returns n; `y` must hold n + 1 <= CIRCUIT_SECTION_MAX_ROWS + 1.  More
 * than that: 0. */
enum { CIRCUIT_SECTION_MAX_ROWS = 400 };
int circuit_section_rows(const circuit_rail_section *s, double first, double growth, double step, double *y);

int circuit_section_images(const circuit_rail_section *s); /* 4 or 8; number 0 is the point itself */
circuit_section_point circuit_section_image(circuit_section_point p, int image); /* isometries */
double circuit_section_image_sign(const circuit_rail_section *s, int image);     /* of the current there */

/* Z' [ohm/m] of the whole = this over the current that the solved half of a rail carries at 1 V/m between its two ends
 * and the field's potential (C-8) [1]. */
double circuit_section_weight(const circuit_rail_section *s);

#ifdef __cplusplus
}
#endif

#endif
