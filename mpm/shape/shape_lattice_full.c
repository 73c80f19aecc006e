/* SPDX-License-Identifier: BSD-3-Clause */
/* Full lattice: rhombic dodecahedra that fill space, the net of fluorite: 32 struts of sqrt(3)/4 cells.  Nodes of 4
 * struts, and of 8. */
#include "mpm/shape/shape_lattice.h"

static const lattice_strut struts[] = { { { 0.25, 0.25, 0.25 }, { 0.0, 0.5, 0.5 } },
                                        { { 0.25, 0.25, 0.25 }, { 0.5, 0.0, 0.5 } },
                                        { { 0.25, 0.25, 0.25 }, { 0.5, 0.5, 0.0 } },
                                        { { 0.25, 0.25, 0.25 }, { 0.0, 0.0, 0.0 } } };

LATTICE(full, "lattice of rhombic dodecahedra that fill space: 32 struts a cell");
