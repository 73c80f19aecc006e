/* SPDX-License-Identifier: BSD-3-Clause */
/* Open lattice: one rhombic dodecahedron a cell, joined to its neighbours at the middles of the cell's faces: 24 struts
 * of sqrt(3)/4 cells.  Nodes of 3 struts, and of 8. */
#include "mpm/shape/shape_lattice.h"

static const lattice_strut struts[] = { { { 0.25, 0.25, 0.25 }, { 0.0, 0.5, 0.5 } },
                                        { { 0.25, 0.25, 0.25 }, { 0.5, 0.0, 0.5 } },
                                        { { 0.25, 0.25, 0.25 }, { 0.5, 0.5, 0.0 } } };

LATTICE(open, "lattice of rhombic dodecahedra, one a cell, joined at the middles of its faces: 24 struts a cell");
