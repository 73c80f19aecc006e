/* SPDX-License-Identifier: BSD-3-Clause */
/* Random strikes: a ball, a rod or a block on plates, on a lattice between two sheets, or, by a piston, through water
 * onto a clamped plate.  Whole, half and quarter models, on one to three levels, sides free or absorbing; materials and
 * judgement are those of stress.c. */
#include "stress.h"

#include "coupling/strike/outcome.h"

#include <stdio.h>
#include <string.h>

typedef enum { PLATES, LATTICE, WATER, TARGETS } target;

typedef struct {
    double a;     /* half the projectile's width [m] */
    double cell;  /* [m] */
    double thick; /* of the target [m] */
    double wide;  /* from its middle to its sides [m] */
    int mirrors;  /* 0 .. 2 */
} sizes;

static const char *damage_of(const recipe *r)
{
    return r->group == WITHOUT_DAMAGE ? "no" : "yes";
}

static void add_box(recipe *r, const char *name, const char *metal, double lo, double hi, double wide)
{
    stress_add(r,
               "    - {name: %s, material: %s, damage: %s, shape: {box: {lo: %.8g %.8g %.8g m, hi: %.8g %.8g %.8g m}}",
               name, metal, damage_of(r), lo, -wide, -wide, hi, wide, wide);
}

/* One to three plates one behind the other, each its own metal, welded or only touching. */
static void add_plates(recipe *r, chance *c, const stock *s, sizes *of)
{
    const int n = 1 + below(c, 3);
    const bool welded = one_in(c, 2);
    double from = 0;
    for (int i = 0; i < n; i++) {
        char name[16];
        const double to = from + of->cell * uniform(c, 2, 6);
        snprintf(name, sizeof name, i == n - 1 ? "plate" : "layer%d", i);
        add_box(r, name, s->names[any_material(r, c, s)], from, to, of->wide);
        stress_add(r, ", yield_scale: %.4g%s}\n", log_uniform(c, 0.5, 2), welded ? ", group: target" : "");
        from = to;
    }
    of->thick = from;
}

/* Struts of two to four cells between two sheets, of one metal. */
static void add_lattice(recipe *r, chance *c, const stock *s, sizes *of)
{
    static const char *const nets[] = { "open", "full", "bcc", "octet" };
    const char *metal = s->names[any_material(r, c, s)];
    const double sheet = of->cell * uniform(c, 1, 2), radius = of->cell * uniform(c, 1, 2),
                 size = radius * uniform(c, 6, 9);
    const double core = size * (1 + below(c, 2));
    of->thick = core + 2 * sheet;
    add_box(r, "front", metal, 0, sheet, of->wide);
    stress_add(r, ", group: target}\n");
    stress_add(r,
               "    - {name: core, material: %s, damage: %s, group: target, shape: {lattice_%s: {lo: %.8g %.8g %.8g m, "
               "hi: %.8g %.8g %.8g m, cell: %.8g m, radius: %.8g m}}}\n",
               metal, damage_of(r), nets[below(c, 4)], sheet, -of->wide, -of->wide, sheet + core, of->wide, of->wide,
               size, radius);
    add_box(r, "plate", metal, sheet + core, of->thick, of->wide);
    stress_add(r, ", group: target}\n");
}

static void add_projectile(recipe *r, chance *c, const stock *s, const sizes *of)
{
    const double a = of->a, gap = of->cell * uniform(c, 0.5, 1.5), length = a * uniform(c, 1, 4);
    stress_add(r, "    - {name: ball, material: %s, damage: %s, temperature: %.5g K, velocity: %.8g 0 0 m/s, shape: ",
               s->names[any_material(r, c, s)], damage_of(r), one_in(c, 2) ? 293.0 : uniform(c, 100, 600), r->velocity);
    switch (below(c, 3)) {
    case 0: stress_add(r, "{sphere: {center: %.8g 0 0 m, radius: %.8g m}}}\n", -a - gap, a); break;
    case 1:
        stress_add(r, "{strut: {from: %.8g 0 0 m, to: %.8g 0 0 m, radius: %.8g m}}}\n", -length - a - gap, -a - gap, a);
        break;
    default: stress_add(r, "{box: {lo: %.8g %.8g %.8g m, hi: %.8g %.8g %.8g m}}}\n", -length - gap, -a, -a, -gap, a, a);
    }
}

static void add_sides(recipe *r, chance *c, const sizes *of)
{
    const char *side = one_in(c, 2) ? "free" : "absorbing";
    static const char axes[] = "yz";
    stress_add(r, "  window: {");
    if (one_in(c, 4)) stress_add(r, "x: {hi: %.8g m}, ", of->thick + of->a); /* it flies out */
    for (int k = 0; k < 2; k++)
        stress_add(r, "%c: {lo: %.8g m, hi: %.8g m}%s", axes[k], k < of->mirrors ? 0 : -of->wide - 2 * of->cell,
                   of->wide + 2 * of->cell, k ? "}\n" : ", ");
    stress_add(r, "  boundary: {");
    for (int k = 0; k < 2; k++)
        stress_add(r, "%c: [%s, %s]%s", axes[k], k < of->mirrors ? "symmetry" : side, side, k ? "}\n" : ", ");
}

static void add_contact(recipe *r, chance *c)
{
    stress_add(r, "  contacts:\n    - {default: frictionless}\n");
    if (one_in(c, 2))
        stress_add(r, "    - {between: [plate, ball], law: coulomb, friction: %.4g, normal_of: ball}\n",
                   uniform(c, 0, 1));
}

static void write_solid(recipe *r, chance *c, const stock *s, target kind)
{
    sizes of = { .a = log_uniform(c, 0.1e-3, 5e-3), .mirrors = below(c, 3) };
    of.cell = of.a / uniform(c, 2, of.mirrors == 2 ? 4 : 3);
    of.wide = of.a * uniform(c, 2.5, 4);
    r->velocity = log_uniform(c, 20, 3000);
    r->courant = uniform(c, 0.1, 0.6);
    r->levels = 1 + below(c, 3);
    stress_add(r, "name: target\nstrike: {projectile: ball, plate: plate, travel: %.8g m}\nscene:\n",
               fmin(12 * of.a, r->velocity * MAX_STEPS * r->courant * of.cell / (6000 + r->velocity)));
    stress_add(r, "  cell: %.8g m\n  coarse_cell: %.8g m\n  levels: %d\n  courant: %.4g\n  bodies:\n", of.cell,
               of.cell * (1 << (r->levels - 1)), r->levels, r->courant);
    if (kind == PLATES)
        add_plates(r, c, s, &of);
    else
        add_lattice(r, c, s, &of);
    add_projectile(r, c, s, &of);
    add_contact(r, c);
    add_sides(r, c, &of);
    snprintf(r->summary, sizeof r->summary, "%s, %.0f m/s, a %.3f mm, C %.2f, %d levels, %d mirrors",
             kind == PLATES ? "plates" : "lattice", r->velocity, 1e3 * of.a, r->courant, r->levels, of.mirrors);
}

/* A piston behind a tube of water sends a wave onto a plate that is clamped between the tube and a ring: a quarter. */
static void write_water(recipe *r, chance *c, const stock *s)
{
    const double bore = log_uniform(c, 2e-3, 30e-3), cell = bore / uniform(c, 6, 10), column = bore * uniform(c, 1, 2);
    const double plate = cell * uniform(c, 2, 4), back = column + plate, wall = bore + 2.5 * cell,
                 end = back + 6 * cell;
    const double mass = log_uniform(c, 10, 300);
    const char *held = s->names[any_material(r, c, s)];
    r->velocity = log_uniform(c, 5, 200);
    r->courant = uniform(c, 0.1, 0.6);
    stress_add(
        r,
        "name: target\nmaterials:\n  - {name: sea, strength: none, density: 1000 kg/m3, specific_heat: 4186 J/(kg K), "
        "reference_temperature: 293 K, sound_speed: 1480 m/s, hugoniot_slope: 1.92, gruneisen: %.3g, "
        "cavitation_pressure: %.6g Pa, viscosity_linear: %.3g, viscosity_quadratic: 2}\n",
        uniform(c, 0, 0.5), one_in(c, 2) ? 0 : -log_uniform(c, 1e4, 1e7), uniform(c, 0.03, 0.3));
    stress_add(r, "strike: {projectile: water, plate: plate, velocity: %.8g m/s}\nscene:\n", r->velocity);
    stress_add(r, "  end_time: %.8g s\n  cell: %.8g m\n  courant: %.4g\n  bodies:\n",
               fmin(4 * bore / 1480, MAX_STEPS * r->courant * cell / 6500), cell, r->courant);
    stress_add(
        r,
        "    - {name: fixture, material: %s, held: yes, shape: {minus: [{box: {lo: %.8g 0 0 m, hi: %.8g %.8g %.8g m}}, "
        "{strut: {from: %.8g 0 0 m, to: %.8g 0 0 m, radius: %.8g m}}, {box: {lo: %.8g %.8g %.8g m, hi: %.8g %.8g %.8g "
        "m}}]}}\n",
        held, -2 * cell, back + 3 * cell, wall, wall, -3 * bore - 4 * cell, end + 3 * bore, bore, column, -cell, -cell,
        back, 2 * wall, 2 * wall);
    stress_add(r,
               "    - {name: plate, material: %s, damage: %s, shape: {box: {lo: %.8g 0 0 m, hi: %.8g %.8g %.8g m}}}\n",
               s->names[any_material(r, c, s)], damage_of(r), column, back, wall, wall);
    stress_add(
        r,
        "    - {name: water, material: sea, piston_mass: %.6g kg/m2, piston_velocity: %.8g m/s, tube_length: %.6g "
        "m, shape: {turn: {axis: 0 0 1, angle: -90 deg, of: {cylinder: {center: 0 0 0 m, radius: %.8g m, height: %.8g "
        "m}}}}}\n",
        mass, r->velocity, bore * log_uniform(c, 1, 30), bore, column);
    stress_add(r,
               "  contacts:\n    - {default: frictionless}\n    - {between: [plate, fixture], law: coulomb, "
               "bond_strength: %.4g Pa, normal_of: fixture}\n",
               one_in(c, 3) ? log_uniform(c, 1e6, 1e9) : 1e12);
    stress_add(
        r,
        "  window: {x: {lo: %.8g m, hi: %.8g m, fine_lo: %.8g m, fine_hi: %.8g m}, y: {lo: 0 m, hi: %.8g m}, z: {lo: 0 "
        "m, hi: %.8g m}}\n  boundary: {y: [symmetry, free], z: [symmetry, free]}\n",
        -3 * cell, end, -3 * cell, end, wall + cell, wall + cell);
    snprintf(r->summary, sizeof r->summary, "water, %.0f m/s, bore %.2f mm, %.0f kg/m2, C %.2f", r->velocity,
             1e3 * bore, mass, r->courant);
}

void stress_target_write(recipe *r, chance *c, const stock *s)
{
    r->length = 0;
    r->levels = 1;
    r->group = one_in(c, 3) ? WITHOUT_DAMAGE : WITH_DAMAGE;
    const target kind = (target)below(c, TARGETS);
    if (kind == WATER)
        write_water(r, c, s);
    else
        write_solid(r, c, s, kind);
    stress_add(r, "output: {snapshots: 0, report: no}\n");
}

static status run_struck(const case_inputs *in, const strike_projectile *p, const case_bodies *b, double velocity,
                         const scene_host *host, outcome *o)
{
    const scene_job job = { .name = "stress", .task = "stress", .scene = &b->scene, .force_on = p->group };
    scene_bodies_result result;
    strike_outcome is;
    scene_host with = *host;
    TRY(output_history_open(NULL, false, &with.history));
    status done = scene_bodies_run(&job, &with, &result);
    if (done.code == STATUS_OK)
        done = strike_outcome_read(with.history, "stress", p, b, in->strike.filter, velocity, &result, &is);
    if (done.code == STATUS_OK) {
        if (!(fabs(result.energy_error) <= o->energy)) o->energy = fabs(result.energy_error);
        if (!(result.momentum_error <= o->momentum)) o->momentum = result.momentum_error;
        snprintf(o->class, sizeof o->class, "%s", strike_class_names[is.class]);
    }
    scene_bodies_free(&result);
    const status closed = output_history_close(with.history);
    return done.code == STATUS_OK ? closed : done;
}

status stress_target_run(const breech_case *of, const scene_host *host, outcome *o)
{
    case_inputs in = case_inputs_of(of);
    strike_projectile p;
    case_bodies b;
    TRY(strike_fill(&in));
    TRY(strike_projectile_of(&in, &p));
    const double velocity = isnan(in.strike.velocity) ? p.speed : in.strike.velocity;
    if (p.piston) o->driven = 0.5 * p.mass / p.parts * velocity * velocity;
    TRY(strike_scene(&in, &p, velocity, &b));
    const status done = run_struck(&in, &p, &b, velocity, host, o);
    mpm_scene_free(&b.scene);
    TRY(done);
    /* soft matter, whose waves are slow: judged nothing */
    CHECK(o->looks > 0, STATUS_BAD_INPUT, "over within one step");
    return status_ok();
}
