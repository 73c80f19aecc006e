/* SPDX-License-Identifier: BSD-3-Clause */
/* Empty definitions of those macros of the three .def files that the includer has not defined.  Without an include
 * guard: it is included several times. */
#ifndef CONSTANT
#define CONSTANT(member, unit, fallback, least, largest, text)
#endif
#ifndef NEEDS
#define NEEDS(member)
#endif
