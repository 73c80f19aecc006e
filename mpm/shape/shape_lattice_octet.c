/* SPDX-License-Identifier: BSD-3-Clause */
/* Octet lattice: corners and middles of faces of a cell, each joined to its twelve nearest: 24 struts of sqrt(1/2)
 * cells a cell, those on faces shared.  Nodes of 12 struts. */
#include "mpm/shape/shape_lattice.h"

static const lattice_strut struts[] = {
    { { 0.0, 0.0, 0.0 }, { 0.0, 0.5, 0.5 } }, { { 0.0, 0.0, 0.0 }, { 0.5, 0.0, 0.5 } },
    { { 0.0, 0.0, 0.0 }, { 0.5, 0.5, 0.0 } }, { { 0.0, 0.5, 0.5 }, { 0.5, 0.0, 0.5 } },
    { { 0.0, 0.5, 0.5 }, { 0.5, 0.5, 0.0 } }, { { 0.5, 0.0, 0.5 }, { 0.5, 0.5, 0.0 } }
};

LATTICE(octet, "octet lattice: corners and middles of faces, each joined to its twelve nearest: 24 struts a cell");
