/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/life/contact.h"

#include "base/constants.h"

#include <complex.h>
#include <math.h>
#include <string.h>

static const double ON_FACE = 1e-12; /* of a: a point on the face is taken this deep */

typedef double complex cplx;

/* ---- loads ---- */

/* a + i b without the arithmetic of infinities and signed zeros that a + I * b has; clang 14 has no CMPLX. */
static cplx complex_of(double re, double im)
{
    const double parts[2] = { re, im };
    cplx z;
    memcpy(&z, parts, sizeof z);
    return z;
}

static status add(contact_load *l, contact_piece p)
{
    CHECK(l->n < CONTACT_MAX_PIECES, STATUS_BAD_INPUT, "life.points: %d points at most", CONTACT_MAX_PIECES);
    l->piece[l->n++] = p;
    return status_ok();
}

static double friction_of(const case_life *c)
{
    return c->state == LIFE_FRICTIONLESS ? 0.0 : c->friction;
}

static status add_hertz(const case_life *c, contact_load *l)
{
    const double a = l->half_length, q0 = friction_of(c) * l->peak;
    TRY(add(l, (contact_piece){ true, -a, a, { l->peak, 0.0 }, { q0, 0.0 } }));
    if (c->state != LIFE_STICK_SLIP) return status_ok();
    const double stick = a * sqrt(1.0 - c->traction_share);
    return add(l, (contact_piece){ true, -a, -a + 2.0 * stick, { 0.0, 0.0 }, { -q0 * stick / a, 0.0 } });
}

static status add_points(const case_life *c, contact_load *l)
{
    const double mu = friction_of(c);
    for (int k = 0; k + 1 < c->points.n; k++) {
        const case_life_point *one = &c->points.item[k], *two = one + 1;
        const double p[2] = { l->peak * one->pressure, l->peak * two->pressure };
        const double q[2] = { isnan(one->traction) ? mu * p[0] : l->peak * one->traction,
                              isnan(two->traction) ? mu * p[1] : l->peak * two->traction };
        TRY(add(l, (contact_piece){
                       false, l->half_length * one->at, l->half_length * two->at, { p[0], p[1] }, { q[0], q[1] } }));
    }
    return status_ok();
}

status life_contact_load(const case_life *c, contact_load *out)
{
    *out = (contact_load){ .half_length = c->half_length, .peak = case_life_peak(c) };
    if (c->profile == LIFE_HERTZ) return add_hertz(c, out);
    if (c->profile == LIFE_POINTS) return add_points(c, out);
    const double p = out->peak, q = friction_of(c) * p;
    return add(out, (contact_piece){ false, -out->half_length, out->half_length, { p, p }, { q, q } });
}

contact_load life_contact_armature(double half_length, double rounding, double pressure, double friction)
{
    const double a = half_length, p = pressure / (1.0 - 0.5 * rounding), q = friction * p, flat = a * (1.0 - rounding);
    contact_load l = { .n = rounding < 1.0 ? 3 : 2, .half_length = a, .peak = p };
    l.piece[0] = (contact_piece){ false, -a, -flat, { 0.0, p }, { 0.0, q } };
    l.piece[l.n - 1] = (contact_piece){ false, flat, a, { p, 0.0 }, { q, 0.0 } };
    if (l.n == 3) l.piece[1] = (contact_piece){ false, -flat, flat, { p, p }, { q, q } };
    return l;
}

/* A piece's value at x by its values at the ends or in the middle. */
static double value_at(const contact_piece *k, const double value[2], double x)
{
    if (x < k->from || x > k->to) return 0.0;
    const double half = 0.5 * (k->to - k->from), off = (x - 0.5 * (k->from + k->to)) / half;
    if (k->ellipse) return value[0] * sqrt(fmax(0.0, 1.0 - off * off));
    return 0.5 * (value[0] * (1.0 - off) + value[1] * (1.0 + off));
}

double life_contact_pressure(const contact_load *l, double x)
{
    double sum = 0.0;
    for (int k = 0; k < l->n; k++) sum += value_at(&l->piece[k], l->piece[k].pressure, x);
    return sum;
}

double life_contact_traction(const contact_load *l, double x)
{
    double sum = 0.0;
    for (int k = 0; k < l->n; k++) sum += value_at(&l->piece[k], l->piece[k].traction, x);
    return sum;
}

void life_contact_forces(const contact_load *l, double *normal, double *tangential)
{
    *normal = *tangential = 0.0;
    for (int k = 0; k < l->n; k++) {
        const contact_piece *p = &l->piece[k];
        const double length = p->to - p->from;
        *normal += length * (p->ellipse ? 0.25 * PI * p->pressure[0] : 0.5 * (p->pressure[0] + p->pressure[1]));
        *tangential += length * (p->ellipse ? 0.25 * PI * p->traction[0] : 0.5 * (p->traction[0] + p->traction[1]));
    }
}

/* ---- potentials ---- */

/* f(w) = 1 / (2 pi i) int v(s) / (s - w) ds of a profile v, its derivative, its integral over w. */
typedef struct {
    cplx f, slope, integral;
} potential;

/* v = sqrt(1 - s^2 / b^2) about its middle:  f = (sqrt(w^2 - b^2) - w) / (2 i b). */
static potential ellipse(cplx w, double b)
{
    const cplx root = csqrt(w - b) * csqrt(w + b), over = 1.0 / complex_of(0.0, 2.0 * b);
    return (potential){ over * (root - w), over * (w / root - 1.0),
                        over * 0.5 * (w * root - b * b * clog(w + root) - w * w) };
}

/* v = value + slope s between s1 and s2:  2 pi i f = slope (s2 - s1) + (value + slope w) log((s2 - w) / (s1 - w)). */
static potential straight(cplx w, double s1, double s2, double value, double slope)
{
    const cplx over = 1.0 / complex_of(0.0, 2.0 * PI), t1 = s1 - w, t2 = s2 - w, l1 = clog(t1), l2 = clog(t2);
    const cplx v = value + slope * w;
    const cplx i1 = -(value + slope * s1) * (t1 * l1 - t1) + slope * t1 * t1 * (0.5 * l1 - 0.25);
    const cplx i2 = -(value + slope * s2) * (t2 * l2 - t2) + slope * t2 * t2 * (0.5 * l2 - 0.25);
    return (potential){ over * (slope * (s2 - s1) + v * (l2 - l1)),
                        over * (slope * (l2 - l1) + v * (1.0 / t1 - 1.0 / t2)),
                        over * (slope * (s2 - s1) * w + i2 - i1) };
}

static potential scaled(potential p, double by)
{
    return (potential){ by * p.f, by * p.slope, by * p.integral };
}

/* Of one piece: potentials P of the pressure and Q of the traction. */
static void piece_potentials(const contact_piece *k, cplx w, potential *P, potential *Q)
{
    const double middle = 0.5 * (k->from + k->to), half = 0.5 * (k->to - k->from);
    if (k->ellipse) {
        const potential unit = ellipse(w - middle, half);
        *P = scaled(unit, k->pressure[0]);
        *Q = scaled(unit, k->traction[0]);
        return;
    }
    const double p = 0.5 * (k->pressure[1] - k->pressure[0]) / half, q = 0.5 * (k->traction[1] - k->traction[0]) / half;
    *P = straight(w, k->from, k->to, k->pressure[0] - p * k->from, p);
    *Q = straight(w, k->from, k->to, k->traction[0] - q * k->from, q);
}

/* F = -(P - i Q) and H = -(P + i Q) of the whole load. */
static void potentials(const contact_load *l, double x, double z, potential *F, potential *H)
{
    const cplx w = complex_of(x, fmax(z, ON_FACE * l->half_length)), i = complex_of(0.0, 1.0);
    *F = *H = (potential){ 0.0, 0.0, 0.0 };
    for (int k = 0; k < l->n; k++) {
        potential P, Q;
        piece_potentials(&l->piece[k], w, &P, &Q);
        F->f -= P.f - i * Q.f, F->slope -= P.slope - i * Q.slope, F->integral -= P.integral - i * Q.integral;
        H->f -= P.f + i * Q.f, H->slope -= P.slope + i * Q.slope, H->integral -= P.integral + i * Q.integral;
    }
}

/* ---- fields ---- */

void life_contact_stress(const contact_load *l, double x, double z, double stress[3])
{
    potential F, H;
    potentials(l, x, z, &F, &H);
    const cplx normal = conj(F.f) + H.f - complex_of(0.0, 2.0 * fmax(z, ON_FACE * l->half_length)) * F.slope;
    stress[1] = creal(normal);
    stress[0] = 4.0 * creal(F.f) - stress[1];
    stress[2] = cimag(normal);
}

void life_contact_strain(const double stress[3], double youngs, double poisson, double strain[3])
{
    const double f = (1.0 + poisson) / youngs;
    strain[0] = f * ((1.0 - poisson) * stress[0] - poisson * stress[1]);
    strain[1] = f * ((1.0 - poisson) * stress[1] - poisson * stress[0]);
    strain[2] = 2.0 * f * stress[2];
}

void life_contact_displacement(const contact_load *l, double x, double z, double youngs, double poisson,
                               double displacement[2])
{
    potential F, H;
    potentials(l, x, z, &F, &H);
    const cplx twice = (3.0 - 4.0 * poisson) * F.integral - complex_of(0.0, 2.0 * z) * conj(F.f) - conj(H.integral);
    displacement[0] = creal(twice) * (1.0 + poisson) / youngs;
    displacement[1] = cimag(twice) * (1.0 + poisson) / youngs;
}

/* ---- a load that runs ---- */

contact_speed life_contact_speed(double youngs, double poisson, double density, double speed)
{
    const double shear = 0.5 * youngs / (1.0 + poisson), c2 = shear / density;
    const double c1 = 2.0 * c2 * (1.0 - poisson) / (1.0 - 2.0 * poisson); /* both squared */
    contact_speed s = { sqrt(1.0 - speed * speed / c1), sqrt(1.0 - speed * speed / c2), 0.0, shear };
    s.rayleigh = (1.0 + s.a2 * s.a2) * (1.0 + s.a2 * s.a2) - 4.0 * s.a1 * s.a2;
    return s;
}

/* R is below zero from rest to the waves' speed, above zero from there to the shear waves'. */
double life_contact_rayleigh(double youngs, double poisson, double density)
{
    const double shear = sqrt(0.5 * youngs / ((1.0 + poisson) * density));
    double low = 0.5 * shear, high = shear;
    while (high - low > 1e-12 * shear) {
        const double middle = 0.5 * (low + high);
        if (life_contact_speed(youngs, poisson, density, middle).rayleigh < 0.0)
            low = middle;
        else
            high = middle;
    }
    return 0.5 * (low + high);
}

double life_contact_factor(const contact_speed *s)
{
    const double b = 1.0 + s->a2 * s->a2;
    return ((1.0 + 2.0 * s->a1 * s->a1 - s->a2 * s->a2) * b - 4.0 * s->a1 * s->a2) / -s->rayleigh;
}

/* Sums of P and Q over all pieces. */
static void transforms(const contact_load *l, double x, double z, cplx *P, cplx *Q)
{
    const cplx w = complex_of(x, fmax(z, ON_FACE * l->half_length));
    *P = *Q = 0.0;
    for (int k = 0; k < l->n; k++) {
        potential p, q;
        piece_potentials(&l->piece[k], w, &p, &q);
        *P += p.f, *Q += q.f;
    }
}

void life_contact_moving(const contact_load *l, const contact_speed *s, double x, double z, double strain[3])
{
    const double b = 1.0 + s->a2 * s->a2, over = 2.0 / (s->shear * s->rayleigh);
    const cplx i = complex_of(0.0, 1.0);
    cplx P, Q;
    transforms(l, x, s->a1 * z, &P, &Q);
    const cplx A = over * (b * P - 2.0 * s->a2 * i * Q);
    transforms(l, x, s->a2 * z, &P, &Q);
    const cplx B = over * (b * i * Q - 2.0 * s->a1 * P);
    strain[0] = creal(A) + s->a2 * creal(B);
    strain[1] = -s->a1 * s->a1 * creal(A) - s->a2 * creal(B);
    strain[2] = -2.0 * s->a1 * cimag(A) - b * cimag(B);
}
