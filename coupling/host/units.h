/* SPDX-License-Identifier: BSD-3-Clause */
/* Quantities as the user writes them: "3.594 mF" -> 3.594e-3 in the unit a parameter is held in.
 *
 * The only file that knows udunits2.  Beside udunits2's own names there is `deg` for angles; a parameter of unit "1"
 * takes bare numbers, %, and ppm; every other parameter needs its unit.  Units with an origin of their own
 * ("seconds since ...") and logarithmic ones are refused, and so is anything that does not look like a unit. */
#ifndef BREECH_COUPLING_UNITS_H
#define BREECH_COUPLING_UNITS_H

#include "base/status.h"

#include <stddef.h>

enum { UNIT_SIZE = 48, LIMITS_SIZE = 160 };

typedef struct units units; /* the unit system; remembers how units are converted, so of one thread alone */

/* Reads the unit database, which takes milliseconds, unless it is open already: then it is shared until the last one
 * closes it.  Who reads many cases keeps it open all the while. */
status host_units_open(units **out);
void host_units_close(units *u); /* NULL allowed */

/* The number in `text` [as written], in `unit`.  user_unit: the unit as written, "" for none.
 * STATUS_BAD_INPUT's text is the reason alone: "needs a unit, such as `5 mF`". */
status host_quantity_read(const units *u, const char *text, const char *unit, double *value, char user_unit[UNIT_SIZE]);

/* "1 pF .. 1 kF": a range held in `unit`, in the family of the unit the user wrote. */
void host_quantity_limits(const units *u, double min, double max, const char *unit, const char *user_unit,
                          char out[LIMITS_SIZE]);

/* A value held in `unit` with an SI prefix where the unit takes one: "12.56 uH", "1500 m/s", "0.3". */
void host_quantity_text(double value, const char *unit, char *out, size_t size);

#endif
