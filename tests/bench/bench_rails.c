/* SPDX-License-Identifier: BSD-3-Clause */
/* Rail levels on the default shot: what each makes of muzzle velocity, time, peak current and of the place where the
 * armature passes a speed; then what the laws of its contact make of it.  The circuit of cases/default_shot. */
#include "circuit/shot_model.h"
#include "tests/circuit_common.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SPEEDS = 9 };
static const double speeds[SPEEDS] = { 800, 1000, 1200, 1231, 1402, 1569, 1600, 1800, 1900 };

typedef struct {
    double x[SPEEDS], I[SPEEDS], p[SPEEDS];
    circuit_shot_state last;
} passage;

static void must(status s)
{
    if (s.code == STATUS_OK) return;
    fprintf(stderr, "%s\n", s.text);
    exit(1);
}

static bool note(void *user, const circuit_shot *s, const circuit_shot_state *now)
{
    passage *p = user;
    (void)s;
    for (int k = 0; k < SPEEDS; k++) {
        if (!(p->last.v < speeds[k] && now->v >= speeds[k])) continue;
        const double f = (speeds[k] - p->last.v) / (now->v - p->last.v);
        p->x[k] = p->last.x + f * (now->x - p->last.x);
        p->I[k] = p->last.current + f * (now->current - p->last.current);
        p->p[k] = p->last.contact_pressure + f * (now->contact_pressure - p->last.contact_pressure);
    }
    p->last = *now;
    return true;
}

static circuit_shot *shoot(const circuit_shot_config *c, const circuit_shot_sink *sink)
{
    circuit_shot *s = NULL;
    must(circuit_shot_create(c, &s));
    must(circuit_shot_advance(s, INFINITY, sink));
    return s;
}

static void row(const char *name, const circuit_shot_config *c)
{
    passage p;
    memset(&p, 0, sizeof p);
    circuit_shot *s = shoot(c, &(circuit_shot_sink){ NULL, note, &p });
    const circuit_shot_summary r = circuit_shot_result(s);
    const circuit_shot_ledger l = circuit_shot_now(s).ledger;
    printf("%-28s %8.1f %8.2f %7.3f %7.1f %6.4f %9.1f", name, 1e-3 * r.peak_current, r.muzzle_velocity,
           1e3 * r.muzzle_time, 1e-3 * r.exit_current, r.efficiency, 1e-3 * l.rails_heat);
    for (int k = 0; k < SPEEDS; k++) printf(" %6.3f", p.x[k]);
    printf("  %llu steps\n", (unsigned long long)r.steps);
    if (strcmp(name, "diffusing") == 0) {
        for (int k = 0; k < SPEEDS; k++)
            printf("   %.0f m/s: x %.3f m, %.0f kA, %.1f MPa\n", speeds[k], p.x[k], 1e-3 * p.I[k], 1e-6 * p.p[k]);
    }
    circuit_shot_free(s);
}

/* What a slice holds at birth and what pushes there (C-12), over speed: of all rungs together, by their inductances. */
static void births(const circuit_shot_config *c)
{
    circuit_rails_load r;
    must(circuit_shot_rails_fit(c, &r));
    printf("%-10s share at birth, share of force, 2 F/I^2 [uH/m], heat under the contact over motion\n", "v [m/s]");
    static const double at[] = { 0.0, 0.1, 0.3, 1.0, 3.0, 10.0, 30.0, 100.0, 300.0, 1000.0, 2000.0, 3000.0 };
    for (size_t i = 0; i < sizeof at / sizeof *at; i++) {
        const double v = at[i];
        double all = 0.0, born = 0.0, pushes = 0.0, heat = 0.0;
        for (int k = 0; k < r.ladder.n; k++) {
            const double L = r.ladder.L[k], theta = v * L / (r.ladder.R[k] * r.contact.length);
            const double a = circuit_rails_share_at_birth(theta), f = circuit_rails_share_of_force(theta);
            all += L;
            born += L * a;
            pushes += L * f;
            heat += L * (a * (2.0 - a) - f);
        }
        const double L = circuit_rails_force_gradient(&r, v, 1.0);
        printf("%-10.4g %7.4f %7.4f %8.4f %8.4f\n", v, born / all, pushes / all, 1e6 * L, heat / L);
    }
}

/* The state before the muzzle. */
static bool note_moving(void *user, const circuit_shot *s, const circuit_shot_state *now)
{
    (void)s;
    if (now->phase == CIRCUIT_SHOT_MOVING) *(circuit_shot_state *)user = *now;
    return true;
}

static void contact_row(const char *name, const circuit_shot_config *c)
{
    circuit_shot_state e;
    memset(&e, 0, sizeof e);
    circuit_shot *s = shoot(c, &(circuit_shot_sink){ NULL, note_moving, &e });
    const circuit_shot_summary r = circuit_shot_result(s);
    const circuit_shot_limits l = circuit_shot_limits_of(s);
    printf("%-34s %8.2f %8.2f %9.4f %8.2f %7.1f %7.3f %8.4f %6.0f %7.2f\n", name, r.muzzle_velocity,
           1e-3 * e.ledger.friction, e.friction_coefficient, 1e6 * e.film_thickness, 1e3 * e.contact_spread,
           1e3 * l.wear_share * c->armature.wear_thickness, l.melt_position, e.film_temperature,
           1e3 * (c->armature.mass - e.mass));
    circuit_shot_free(s);
}

/* What the armature's contact does to the default shot: the two laws of friction, the velocity skin effect. */
static void contacts(circuit_shot_config c, bool tiny)
{
    const double wear[] = { 0.01, 0.03, 0.1, 0.3 }, volts[] = { 30.0, 10.0, 3.0 };
    char name[60];
    c.rails.level = CIRCUIT_SHOT_RAILS_DIFFUSING;
    c.armature.wear_thickness = 1e-3;
    printf("%-34s exit[m/s] lost[kJ] mu film[um] spread[mm] worn[mm] melts at x[m] T[K] mass lost[g]\n", "contact");
    for (int film = 0; film < 2; film++) {
        c.armature.friction_law = film;
        for (int k = 0; k < (tiny ? 1 : 4); k++) {
            snprintf(name, sizeof name, "friction %s, wear fraction %g", circuit_shot_friction_law_names[film],
                     wear[k]);
            c.armature.wear_fraction = wear[k];
            contact_row(name, &c);
        }
    }
    c.armature.wear_fraction = 0.03;
    for (int k = 0; k < (tiny ? 1 : 3); k++) {
        c.armature.contact_voltage = volts[k];
        for (int skin = 0; skin < 2; skin++) {
            snprintf(name, sizeof name, "film, %g V, velocity skin %s", volts[k], skin ? "yes" : "no");
            c.armature.velocity_skin = skin;
            contact_row(name, &c);
        }
    }
}

int main(int argc, char **argv)
{
    const bool tiny = argc > 1 && strcmp(argv[1], "--tiny") == 0;
    circuit_shot_module modules[DEFAULT_SHOT_GROUPS];
    circuit_shot_config c = default_shot(modules);
    if (tiny) c.options.rtol = 1e-4;
    printf("%-28s peak[kA] exit[m/s] t[ms] I[kA]  effic. heat[kJ], then x [m] at", "rails");
    for (int k = 0; k < SPEEDS; k++) printf(" %.0f", speeds[k]);
    printf(" m/s\n");
    row("diffusing", &c);
    for (int slices = 1; !tiny && slices <= 8; slices *= 2) {
        char name[40];
        snprintf(name, sizeof name, "diffusing, %d warm slices", slices);
        c.rails.slices = slices;
        row(name, &c);
    }
    c.rails.slices = 0;
    c.rails.level = CIRCUIT_SHOT_RAILS_SKIN;
    row("skin, pulse's frequency", &c);
    for (double f = 300; !tiny && f < 2e4; f *= 3.0) {
        char name[40];
        snprintf(name, sizeof name, "skin, %.0f Hz", f);
        c.rails.frequency = f;
        row(name, &c);
    }
    c.rails.level = CIRCUIT_SHOT_RAILS_CONSTANT;
    circuit_ladder l;
    circuit_shot_rails rails = c.rails;
    rails.level = CIRCUIT_SHOT_RAILS_DIFFUSING;
    must(circuit_rails_ladder(&rails, 5e4, &l));
    c.rails.inductance_gradient = l.L_inf;
    c.rails.resistance_gradient = l.R_dc;
    row("constant, L_inf and R_dc", &c);
    c.rails.level = CIRCUIT_SHOT_RAILS_DIFFUSING;
    for (double error = 0.1; !tiny && error > 5e-5; error *= 0.1) {
        char name[40];
        snprintf(name, sizeof name, "diffusing, ladder %g", error);
        c.rails.ladder_error = error;
        row(name, &c);
    }
    c.rails.ladder_error = 1e-2;
    c.rails.ladder_frequency = 5e4;
    for (double length = 1e-4; !tiny && length < 2.0; length *= 10.0) {
        char name[40];
        snprintf(name, sizeof name, "diffusing, contact %g m", length);
        c.armature.contact_length = length;
        row(name, &c);
    }
    c.rails.ladder_frequency = NAN;
    c.armature.contact_length = 16.5e-3;
    births(&c);
    contacts(c, tiny);
    return 0;
}
