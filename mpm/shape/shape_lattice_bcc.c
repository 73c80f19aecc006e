/* SPDX-License-Identifier: BSD-3-Clause */
/* Body-centred cubic lattice: a cell's middle joined to its corners: 8 struts of sqrt(3)/2 cells.  Nodes of 8
 * struts. */
#include "mpm/shape/shape_lattice.h"

static const lattice_strut struts[] = { { { 0.0, 0.0, 0.0 }, { 0.5, 0.5, 0.5 } } };

LATTICE(bcc, "body-centred cubic lattice: 8 struts a cell, from its middle to its corners");
