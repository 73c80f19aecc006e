/* SPDX-License-Identifier: BSD-3-Clause */
/* The armature's contact: how its current crowds (circuit/armature/contact.h), the film it slides on
 * (circuit/armature/film.h), the current's way to its lead face (circuit/armature/lead_face.h), all in a shot. */
#include "base/constants.h"
#include "circuit/armature/contact.h"
#include "circuit/armature/film.h"
#include "circuit/armature/lead_face.h"
#include "tests/circuit_common.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "near_common.h"
#include "status_common.h"

static shot_notes notes;

static void assert_refused(const circuit_shot_config *c, const char *key)
{
    circuit_shot *s = NULL;
    const status st = circuit_shot_create(c, &s);
    assert_int_equal(st.code, STATUS_BAD_INPUT);
    if (!strstr(st.text, key)) fail_msg("%s does not name %s", st.text, key);
}

/* Temperatures and fractions that cannot be together. */
static void refusals(void **state)
{
    (void)state;
    circuit_shot_module m = unit_200kJ(1, 0.0);
    circuit_shot_config c = plain_barrel();
    c.supplies[CIRCUIT_SUPPLY_capacitor] = (circuit_supply_list){ 1, &m };
    circuit_shot_armature *a = &c.armature;
    double *const asks[] = { &a->leg_area, &a->throat_area, &a->wear_fraction };
    a->wear_fraction = 0.6;
    a->heat_share = 0.5;
    assert_refused(&c, "armature.wear_fraction");
    a->wear_fraction = 0.5;
    OK(circuit_shot_check(&c));
    a->wear_fraction = 0.0;
    a->initial_temperature = a->melting_temperature + 50.0;
    OK(circuit_shot_check(&c)); /* nothing asks how far melting is */
    for (int k = 0; k < 3; k++) {
        const double none = *asks[k];
        *asks[k] = 1e-4;
        assert_refused(&c, "armature.initial_temperature");
        *asks[k] = none;
    }
}

/* ---- crowding ---- */

/* dJ/dx = sqrt(1/pi) int_0^x J(s)/sqrt(x - s) ds in lengths of d: J straight in every cell, the kernel's integral over
 * the cell exact. */
static double evenness_by_cells(double z)
{
    enum { CELLS = 2000 };
    static double J[CELLS + 1];
    const double h = z / CELLS;
    double slope = 0.0, sum = 0.0;
    J[0] = 1.0;
    for (int n = 1; n <= CELLS; n++) {
        J[n] = J[n - 1] + h * slope;
        for (int pass = 0; pass < 4; pass++) { /* trapeze in dJ/dx: implicit */
            double E = 0.0;
            for (int k = 0; k < n; k++) { /* int (a + b s)/sqrt(x - s) ds over the cell, u = x - s */
                const double u1 = (n - k) * h, u0 = u1 - h, b = (J[k + 1] - J[k]) / h;
                const double at_x = J[k] + b * u1; /* the line carried on to s = x */
                E += 2.0 * at_x * (sqrt(u1) - sqrt(u0)) - b * (pow(u1, 1.5) - pow(u0, 1.5)) * 2.0 / 3.0;
            }
            const double end = E / sqrt(PI);
            J[n] = J[n - 1] + 0.5 * h * (slope + end);
            if (pass == 3) slope = end;
        }
        sum += 0.5 * h * (J[n] + J[n - 1]);
    }
    return sum / (z * J[CELLS]);
}

static void current_crowds(void **state)
{
    (void)state;
    assert_near(circuit_contact_evenness(0.0), 1.0, 0.0);
    for (double z = 1e-3, last = 1.0; z < 100.0; z *= 1.3) {
        const double now = circuit_contact_evenness(z);
        assert_true(now < last && now * z < 1.0 + 1e-9 && (z < 5.0 || now * z > 0.99));
        last = now;
    }
    assert_near(25.0 * circuit_contact_evenness(24.9999999), 1.0, 1e-8); /* where the series ends */
    for (double z = 0.4; z < 8.0; z *= 2.5) assert_near(circuit_contact_evenness(z), evenness_by_cells(z), 2e-4);
}

static void spread_by_speed_and_current(void **state)
{
    (void)state;
    const double area = 0.0165 * 0.025, rho = 1.72e-8, v = 1000.0, I = 9e5;
    circuit_sliding_contact c = { .length = 0.0165, .interface = 15.0 * area, .resistivity = rho };
    const double r = c.interface / I, d = cbrt(r * r / (4e-7 * PI * rho * v));
    assert_near(d, 0.01298, 1e-5); /* by hand: r 6.875e-9 ohm m^2 */
    assert_near(circuit_contact_spread(&c, v, I), 0.0165 * circuit_contact_evenness(0.0165 / d), 1e-9);
    assert_near(circuit_contact_spread(&c, v, -I), circuit_contact_spread(&c, v, I), 0.0);
    assert_near(circuit_contact_spread(&c, 0.0, I), 0.0165, 0.0);
    assert_true(circuit_contact_spread(&c, 2.0 * v, I) < circuit_contact_spread(&c, v, I));
    assert_near(circuit_contact_spread(&c, 1e12, I), d * 1e-3, 1e-9); /* d falls as the cube root of v */
    c.interface = 0.0;
    assert_near(circuit_contact_spread(&c, v, I), 0.0165, 0.0);
}

/* ---- film ---- */

static melt_film aluminium(void)
{
    return (melt_film){ .viscosity = 1.3e-3,
                        .density = 2804.0,
                        .melting = 2804.0 * (848.0 * 457.0 + 390e3),
                        .length = 0.0165,
                        .share = 0.01 };
}

/* (C-20), and both limits of (C-21), over six decades of speed and whatever the current heats. */
static void film_balances_its_heat(void **state)
{
    (void)state;
    const melt_film f = aluminium();
    for (double v = 0.01; v < 1e4; v *= 2.0) {
        double last = 0.0;
        for (int k = 0; k < 4; k++) {
            const double q[] = { 0.0, 1e7, 3e9, 3e10 }, P = 6e7;
            const melt_flow m = circuit_melt_film_at(&f, v, P, q[k]);
            assert_near(m.recession * f.melting / (f.share * (m.shear * v + q[k])), 1.0, 1e-11);
            assert_true(m.recession > last); /* more heat, more melt */
            assert_true(m.thickness < 2.0 * m.recession * f.length / v);
            last = m.recession;
        }
        const melt_flow loose = circuit_melt_film_at(&f, v, 0.0, 1e9);
        assert_near(loose.thickness * v / (2.0 * loose.recession * f.length), 1.0, 1e-12);
    }
    const melt_flow slow = circuit_melt_film_at(&f, 1e-3, 6e7, 3e9), still = circuit_melt_film_at(&f, 0.0, 6e7, 3e9);
    assert_true(slow.shear < 10.0); /* Pa: a film at rest holds nothing */
    assert_near(still.shear, 0.0, 0.0);
    assert_near(still.recession, 0.01 * 3e9 / f.melting, 1e-15);
}

/* The film along x by small pieces: flux w x, thickness h, the pressure from the front of the full film on; its mean
 * must be P, the shear on the rail's side (Couette, pressure, streaks) tau.  Laminar: a melt without mass. */
static void film_by_pieces(double v, double P, double q, bool streaks)
{
    enum { N = 20000 };
    melt_film f = aluminium();
    f.density = 1e-12;
    const melt_flow m = circuit_melt_film_at(&f, v, P, q);
    const double l = f.length, w = m.recession, h = m.thickness, eta = f.viscosity;
    const double full = streaks ? v * h / w - l : 0.0;                 /* where the full film and its pressure begin */
    const double in_front = streaks ? 0.0 : 0.5 * v * h - 0.5 * w * l; /* flux at x = 0, negative: out in front */
    const double dx = (l - full) / N;
    double p = 0.0, mean = 0.0, shear = full * full * eta * w / (h * h); /* the streaks': int eta v/h 2 w x/(v h) dx */
    assert_true(streaks == (v * h > w * l) && full < l);
    for (int k = 0; k < N; k++) {
        const double x = full + (k + 0.5) * dx;
        const double slope = 12.0 * eta * (0.5 * v * h - in_front - w * x) / (h * h * h);
        mean += (p + 0.5 * slope * dx) * dx;
        p += slope * dx;
        shear += (eta * v / h + 0.5 * h * slope) * dx;
    }
    assert_near(p, 0.0, 1e-3 * P); /* and out at the trailing edge at no pressure */
    assert_near(mean / l, P, 1e-3 * P);
    assert_near(shear / l, m.shear, 1e-3 * m.shear);
}

static void film_bears_and_shears(void **state)
{
    (void)state;
    film_by_pieces(1000.0, 6e7, 3e10, true);
    film_by_pieces(2500.0, 1e6, 1e9, true);
    film_by_pieces(300.0, 6e7, 0.0, true);
    film_by_pieces(1.0, 6e7, 3e9, false);
    film_by_pieces(20.0, 2e8, 3e10, false);
}

/* ---- in a shot ---- */

typedef struct {
    circuit_shot_state melted, last;
    double dry, least_spread;
} contact_notes;

static bool note_melting(void *user, circuit_shot *s, const circuit_shot_event *e)
{
    contact_notes *n = user;
    note_event(&notes, s, e);
    if (e->kind == CIRCUIT_SHOT_MELTED) n->melted = e->state;
    return true;
}

static bool note_contact(void *user, const circuit_shot *s, const circuit_shot_state *st)
{
    contact_notes *n = user;
    note_sample(&notes, s, st);
    if (st->phase == CIRCUIT_SHOT_MOVING && notes.count[CIRCUIT_SHOT_MELTED] == 0) n->dry = st->friction_coefficient;
    if (st->phase == CIRCUIT_SHOT_MOVING) n->last = *st;
    n->least_spread = fmin(n->least_spread, st->contact_spread);
    return true;
}

static circuit_shot_module bank; /* of the shots below */

static circuit_shot_config launcher(void)
{
    circuit_shot_config c = plain_barrel();
    bank = unit_200kJ(10, 0.0);
    c.supplies[CIRCUIT_SUPPLY_capacitor] = (circuit_supply_list){ 1, &bank };
    c.barrel.length = 2.0;
    c.armature.wear_fraction = 0.01;
    c.armature.wear_thickness = 1e-3;
    return c;
}

static circuit_shot *watched(const circuit_shot_config *c, contact_notes *n)
{
    circuit_shot *s = NULL;
    (void)notes_sink(&notes);
    *n = (contact_notes){ .least_spread = INFINITY };
    const circuit_shot_sink sink = { note_melting, note_contact, n };
    OK(circuit_shot_create(c, &s));
    OK(circuit_shot_advance(s, INFINITY, &sink));
    assert_int_equal(notes.count[CIRCUIT_SHOT_MUZZLE], 1);
    assert_true(notes.worst_error < 1e-6);
    return s;
}

/* (C-7) by hand, from the state just after the face melted: what friction was before, and both heats so far. */
static double rise_at_melting(const circuit_shot_armature *a, const circuit_shot_state *e, double area)
{
    const double crowding = a->contact_length / e->contact_spread;
    const double q =
        a->friction_dry * e->contact_force * e->v / area + crowding * a->contact_voltage * e->current / (2.0 * area);
    const double E = (e->ledger.friction + crowding * e->ledger.contact_heat) / (2.0 * area);
    return a->heat_share * 2.0 * sqrt(q * E / PI) / sqrt(a->thermal_conductivity * a->density * a->specific_heat);
}

/* Dry until the face melts, at a located instant and where its temperature says; then the film's own shear; wear begins
 * there. */
static void melting_changes_friction(void **state)
{
    (void)state;
    contact_notes n;
    circuit_shot_config c = launcher();
    c.armature.contact_voltage = 1.0;
    circuit_shot *by_speed = watched(&c, &n);
    assert_int_equal(notes.count[CIRCUIT_SHOT_MELTED], 0);
    c.armature.friction_law = CIRCUIT_SHOT_FRICTION_FILM;
    circuit_shot *s = watched(&c, &n);
    const circuit_shot_armature *a = &c.armature;
    const double area = a->contact_length * c.rails.height;
    const melt_film f = {
        .viscosity = a->film_viscosity,
        .density = a->density,
        .melting = a->density * (a->specific_heat * (a->melting_temperature - a->initial_temperature) + a->latent_heat),
        .length = a->contact_length,
        .share = a->wear_fraction
    };
    const circuit_shot_state *e = &n.last;
    const double P = e->contact_force / area;
    const melt_flow m = circuit_melt_film_at(&f, e->v, P, a->contact_voltage * e->current / (2.0 * area));
    print_message("melts at x = %.4f m, %.0f m/s; at the muzzle mu %.4f, film %.2f um; %.1f m/s, by speed alone %.1f\n",
                  n.melted.x, n.melted.v, e->friction_coefficient, 1e6 * e->film_thickness,
                  circuit_shot_result(s).muzzle_velocity, circuit_shot_result(by_speed).muzzle_velocity);
    assert_int_equal(notes.count[CIRCUIT_SHOT_MELTED], 1);
    assert_near(n.dry, a->friction_dry, 0.0);
    assert_near(n.melted.mass, a->mass, 0.0); /* nothing has worn off yet */
    assert_near(n.melted.x, circuit_shot_limits_of(s).melt_position, 0.0);
    assert_true(n.melted.x > c.barrel.start && n.melted.x < c.barrel.length);
    assert_true(n.melted.friction_coefficient < a->friction_dry);
    assert_near(e->friction_coefficient, m.shear / P, 1e-9);
    assert_near(e->film_thickness, m.thickness, 1e-9 * m.thickness);
    assert_true(e->mass < a->mass && e->film_temperature > a->melting_temperature);
    circuit_shot_free(by_speed);
    circuit_shot_free(s);
    c.armature.velocity_skin = true; /* a trailing edge that is hotter melts sooner */
    contact_notes sooner;
    circuit_shot_free(watched(&c, &sooner));
    assert_true(sooner.melted.x < n.melted.x);
    const double rise = a->melting_temperature - a->initial_temperature;
    assert_near(rise_at_melting(a, &n.melted, area), rise, 1e-4 * rise);
    assert_near(rise_at_melting(a, &sooner.melted, area), rise, 1e-4 * rise);
    c.armature.velocity_skin = false;
    c.armature.wear_fraction = 0.0;
    assert_refused(&c, "armature.wear_fraction");
}

/* Off changes nothing; on, the trailing edge is hotter and more worn, the energy still closes, and the muzzle velocity
 * lies between those of the whole contact and of the least length over which the current enters. */
static void current_crowds_in_a_shot(void **state)
{
    (void)state;
    contact_notes n;
    circuit_shot_config c = launcher();
    c.rails.level = CIRCUIT_SHOT_RAILS_DIFFUSING;
    circuit_ladder l;
    OK(circuit_rails_ladder(&c.rails, 5e4, &l));
    c.fitted = &l;
    circuit_shot *even = watched(&c, &n);
    assert_near(n.least_spread, c.armature.contact_length, 0.0);
    const double before = circuit_shot_result(even).muzzle_velocity;
    c.armature.velocity_skin = true;
    circuit_shot *s = watched(&c, &n);
    const double v = circuit_shot_result(s).muzzle_velocity, worn = circuit_shot_limits_of(s).wear_share;
    print_message(
        "%.2f m/s instead of %.2f; the current enters over %.1f mm and more; wear %.3f instead of %.3f of the leg\n", v,
        before, 1e3 * n.least_spread, worn, circuit_shot_limits_of(even).wear_share);
    assert_true(n.least_spread < 0.8 * c.armature.contact_length);
    assert_true(worn > 1.1 * circuit_shot_limits_of(even).wear_share);
    assert_true(worn < c.armature.contact_length / n.least_spread * circuit_shot_limits_of(even).wear_share);
    circuit_shot_free(even);
    circuit_shot_free(s);

    c.armature.velocity_skin = false;
    c.armature.contact_length = n.least_spread;
    c.armature.contact_width = 0.025;
    circuit_shot *shorter = watched(&c, &n);
    assert_true(circuit_shot_result(shorter).muzzle_velocity < v && v < before);
    circuit_shot_free(shorter);
    c.armature.velocity_skin = true;
    c.armature.contact_voltage = 0.0;
    assert_refused(&c, "armature.contact_voltage");
}

/* The faces of four rails, each with half of the current, do what those of two rails do that are twice as wide, pressed
 * twice as hard and with twice the leg: bit for bit, for all factors are two. */
static void four_faces(void **state)
{
    (void)state;
    for (int law = 0; law < 2; law++) {
        contact_notes n[2];
        circuit_shot_limits l[2];
        circuit_shot_state end[2];
        for (int k = 0; k < 2; k++) {
            circuit_shot_config c = launcher();
            circuit_shot_armature *a = &c.armature;
            const double wider = k ? 1.0 : 2.0;
            c.rails.count = k ? 4 : 2;
            c.rails.height = 0.02;
            a->contact_width = 0.02 * wider;
            a->preload *= wider;
            a->spreading *= wider;
            a->leg_area = 1e-4 * wider;
            a->bore_area = 6e-4;
            a->velocity_skin = true;
            a->friction_law = law ? CIRCUIT_SHOT_FRICTION_FILM : CIRCUIT_SHOT_FRICTION_SPEED;
            circuit_shot *s = watched(&c, &n[k]);
            l[k] = circuit_shot_limits_of(s), end[k] = circuit_shot_now(s);
            circuit_shot_free(s);
        }
        const circuit_shot_state *two = &n[0].last, *four = &n[1].last;
        assert_true(end[0].v == end[1].v && end[0].mass == end[1].mass && n[0].least_spread == n[1].least_spread);
        assert_true(end[0].ledger.friction == end[1].ledger.friction && end[0].armature_temperature > 400.0);
        assert_true(end[0].armature_temperature == end[1].armature_temperature);
        assert_true(two->friction == four->friction && two->contact_pressure == four->contact_pressure);
        assert_true(two->film_thickness == four->film_thickness && two->rail_flux == four->rail_flux);
        assert_true(l[0].contact_ratio == l[1].contact_ratio && l[0].leg_action == l[1].leg_action);
        assert_true(l[0].wear_share == l[1].wear_share && l[0].wear_share > 0.0);
    }
}

/* A contact without crowding, asked for its wear along the way, agrees with its mass: the trapezes are good. */
static void wear_by_trapezes(void **state)
{
    (void)state;
    contact_notes n;
    circuit_shot_config c = launcher();
    circuit_shot *by_mass = watched(&c, &n);
    c.armature.velocity_skin = true;
    c.rails.resistivity = 1e-10; /* d is long: even */
    circuit_shot *s = watched(&c, &n);
    assert_true(n.least_spread > 0.9 * c.armature.contact_length);
    assert_near(circuit_shot_limits_of(s).wear_share / circuit_shot_limits_of(by_mass).wear_share,
                c.armature.contact_length / n.least_spread, 0.05);
    circuit_shot_free(by_mass);
    circuit_shot_free(s);
}

/* ---- the lead face ---- */

enum { FINE_CELLS = 60 };

/* As circuit_lead_face, by small explicit steps of another grid. */
typedef struct {
    circuit_lead_face_metal metal;
    double length, t, field[FINE_CELLS + 1], temperature[FINE_CELLS];
} lead_face_by_steps;

static lead_face_by_steps steps_start(const circuit_lead_face_metal *metal, double length)
{
    lead_face_by_steps f = { .metal = *metal, .length = length };
    for (int i = 0; i < FINE_CELLS; i++) f.temperature[i] = metal->start;
    return f;
}

static void advance_by_steps(lead_face_by_steps *f, double t, double sheet)
{
    const circuit_lead_face_metal *m = &f->metal;
    const double dx = f->length / FINE_CELLS, from = f->field[0], since = f->t;
    const double largest = m->resistivity * (1.0 + m->coefficient * (m->melting - m->start)) / MU0;
    const int steps = (int)ceil((t - since) / (0.4 * dx * dx / largest));
    const double h = (t - since) / steps;
    for (int n = 1; n <= steps; n++) {
        double E[FINE_CELLS];
        f->field[0] = from + (sheet - from) * n / steps;
        for (int i = 0; i < FINE_CELLS; i++) {
            const double rho = m->resistivity * (1.0 + m->coefficient * (f->temperature[i] - m->start));
            const double J = (f->field[i] - f->field[i + 1]) / dx;
            E[i] = rho * J;
            f->temperature[i] = fmin(f->temperature[i] + h * E[i] * J / m->heat_capacity, m->melting);
        }
        for (int i = 1; i < FINE_CELLS; i++) f->field[i] += h * (E[i - 1] - E[i]) / (MU0 * dx);
    }
    f->t = t;
}

static const circuit_lead_face_metal lab_metal = {
    .resistivity = 5.15e-8, .coefficient = 2e-3, .heat_capacity = 2.4e6, .start = 300.0, .melting = 750.0
};

/* A pulse that rises within a fifth of the time mu0 l^2/rho_0 and falls again. */
static void current_comes_to_the_lead_face(void **state)
{
    (void)state;
    const double l = 16.5e-3, time = MU0 * l * l / lab_metal.resistivity;
    circuit_lead_face f = circuit_lead_face_start(&lab_metal, l);
    lead_face_by_steps by = steps_start(&lab_metal, l);
    const double *last = &f.temperature[CIRCUIT_LEAD_FACE_CELLS - 1], *last_by = &by.temperature[FINE_CELLS - 1];
    assert_true(*last == 300.0);
    for (int k = 1; k <= 1000; k++) {
        const double t = 1e-3 * k * time, sheet = 25e6 * fmin(5.0 * t / time, 1.04 - 0.2 * t / time);
        circuit_lead_face_advance(&f, t, sheet);
        advance_by_steps(&by, t, sheet);
        if (k == 50) assert_true(*last < 300.01); /* it has hardly begun to come through */
        if (k % 200 == 0) print_message("%d: %.1f K, by steps %.1f K\n", k, *last, *last_by);
        if (k % 200 == 0) assert_near(*last, *last_by, 0.02 * (*last_by - 300.0) + 0.1);
        assert_true(f.temperature[0] <= 750.0 && *last <= f.temperature[0]);
    }
    assert_true(f.temperature[0] == 750.0 && *last > 400.0 && *last < 740.0);
    const circuit_lead_face before = f;
    circuit_lead_face_advance(&f, f.t, 2.0 * f.field[0]); /* no time, nothing happens */
    assert_memory_equal(&f, &before, sizeof f);
}

/* Of a resistivity that does not change, long after: the current at the lead face lags behind one that falls evenly,
 * J l = K - l^2 mu0/(6 rho) dK/dt, here dK/dt = -0.2 of 0.64. */
static void lead_face_lags(void **state)
{
    (void)state;
    circuit_lead_face_metal even = lab_metal;
    even.coefficient = 0.0;
    const double l = 16.5e-3, time = MU0 * l * l / even.resistivity;
    circuit_lead_face f = circuit_lead_face_start(&even, l);
    for (int k = 1; k <= 2000; k++)
        circuit_lead_face_advance(&f, 1e-3 * k * time, 1e6 * fmin(5e-3 * k, 1.04 - 2e-4 * k));
    const double J = f.field[CIRCUIT_LEAD_FACE_CELLS - 1] * CIRCUIT_LEAD_FACE_CELLS; /* times l */
    assert_near(J / f.field[0], 1.0 + 0.2 / 0.64 / 6.0, 1e-3);
}

typedef struct {
    lead_face_by_steps by;
    double width, last;
} lead_face_notes;

static bool follow_lead_face(void *user, const circuit_shot *s, const circuit_shot_state *st)
{
    (void)s;
    lead_face_notes *n = user;
    if (st->phase != CIRCUIT_SHOT_LEFT && st->t > n->by.t) advance_by_steps(&n->by, st->t, st->current / n->width);
    if (st->phase != CIRCUIT_SHOT_LEFT) n->last = st->lead_face_temperature;
    return true;
}

/* In a shot: none without a throat; melting is the most. */
static void lead_face_warms_up(void **state)
{
    (void)state;
    circuit_shot_module m = unit_200kJ(8, 0.0);
    circuit_shot_config c = plain_barrel();
    c.supplies[CIRCUIT_SUPPLY_capacitor] = (circuit_supply_list){ 1, &m };
    c.armature.initial_temperature = 320.0;
    const double warm = 1.0 + 2e-3 * (320.0 - 293.15);
    const circuit_lead_face_metal metal = { 5.15e-8 * warm, 2e-3 / warm, 2804.0 * 848.0, 320.0, 750.0 };
    double last[3];
    for (int k = 0; k < 3; k++) {
        c.armature.throat_area = (const double[]){ NAN, 4e-4, 1e-5 }[k];
        lead_face_notes n = { .by = steps_start(&metal, c.armature.throat_area / c.rails.height),
                              .width = c.rails.height };
        if (k != 1) n.by.t = INFINITY;
        const circuit_shot_sink sink = { NULL, follow_lead_face, &n };
        circuit_shot *s = NULL;
        OK(circuit_shot_create(&c, &s));
        OK(circuit_shot_advance(s, INFINITY, &sink));
        last[k] = n.last;
        if (k == 1) {
            const double by = n.by.temperature[FINE_CELLS - 1];
            print_message("lead face at exit %.1f K, by steps %.1f K\n", n.last, by);
            assert_near(n.last, by, 0.02 * (by - 320.0));
        }
        circuit_shot_free(s);
    }
    assert_true(isnan(last[0]) && last[1] > 420.0 && last[1] < 740.0 && last[2] == 750.0);
    c.armature.initial_temperature = 200.0, c.armature.resistivity_coefficient = 0.1;
    assert_refused(&c, "armature.resistivity_coefficient");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(refusals),
        cmocka_unit_test(current_crowds),
        cmocka_unit_test(spread_by_speed_and_current),
        cmocka_unit_test(film_balances_its_heat),
        cmocka_unit_test(film_bears_and_shears),
        cmocka_unit_test(melting_changes_friction),
        cmocka_unit_test(current_crowds_in_a_shot),
        cmocka_unit_test(wear_by_trapezes),
        cmocka_unit_test(four_faces),
        cmocka_unit_test(current_comes_to_the_lead_face),
        cmocka_unit_test(lead_face_lags),
        cmocka_unit_test(lead_face_warms_up),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
