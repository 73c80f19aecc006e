/* SPDX-License-Identifier: BSD-3-Clause */
/* Contact laws: the impulse that two groups of bodies exchange at a node where they touch.
 *
 * To add one: write mpm/law/contact_<name>.h and one line in contact.def, which has the rules. */
#ifndef BREECH_MPM_CONTACT_H
#define BREECH_MPM_CONTACT_H

#include "base/param.h"
#include "mpm/scene.h"

#include <math.h>

/* No limit on a stress: above any material's strength.  A number, since a minimum with NAN raises a floating-point
 * exception [Pa]. */
#define CONTACT_NO_LIMIT 1e30

/* Two groups a and b at a node where their surfaces touch. */
typedef struct {
    double n[3];     /* unit normal from a to b */
    double area;     /* of the surface that belongs to the node [m2] */
    double shear;    /* strength in shear of the weaker side there [Pa] */
    double reduced;  /* m_a m_b / (m_a + m_b) [kg] */
    double apart[3]; /* v_b - v_a, forces of the step included [m/s] */
    double gap;      /* between the faces along n at the start of the step, below 0 where they overlap [m] */
    double width;    /* of the cell along n [m] */
    double dt;       /* of the step [s] */
} contact_touch;

/* Along n, v_b - v_a and what closes the gap in the step: below 0 where the faces meet.  A gap of two hundredths of a
 * cell counts as closed; the depths that it is found from agree to that on a face that is turned in the grid [m/s]. */
static inline double contact_closing(const contact_touch *t)
{
    static const double CLOSED = 0.02;
    const double vn = t->apart[0] * t->n[0] + t->apart[1] * t->n[1] + t->apart[2] * t->n[2];
    return vn + fmax(t->gap - CLOSED * t->width, 0) / t->dt;
}

struct mpm_contact_law {
    const char *name, *doc;
    const base_param *params; /* of an mpm_contact: what its values mean */
};

/* Places of the values of each law in mpm_contact.value: COULOMB_FRICTION, .. */
#define CONTACT_BEGIN(name, text) enum {
#define CONTACT_VALUE(place, key, unit, fallback, least, largest, text) place,
#define CONTACT_END(name) \
    CONTACT_VALUES_##name \
    }                     \
    ;
#include "mpm/law/contact.def"

/* Places of the laws in their table. */
enum {
#define CONTACT_BEGIN(name, text) CONTACT_##name,
#include "mpm/law/contact.def"
    CONTACT_LAWS
};

/* Law by name, NULL if there is none.  mpm_contact_at(i) walks the table, NULL at its end. */
const mpm_contact_law *mpm_contact_find(const char *name);
const mpm_contact_law *mpm_contact_at(int i);
int mpm_contact_index(const mpm_contact_law *law);

mpm_contact mpm_contact_of(const mpm_contact_law *law); /* with the law's default values */
status mpm_contact_check(const mpm_contact *c);         /* STATUS_BAD_INPUT names the value and its range */

#endif
