/* SPDX-License-Identifier: BSD-3-Clause */
/* Random scenes through the whole hand-off: case text -> case -> scene -> solver -> crater -> class.
 *
 *   breech-stress [--targets] [--scenes N] [--first K] [--seed S] [--courant C] [--verbose]
 *
 * Scene i of a seed is always the same, so `--first i --scenes 1` repeats a single one.  Every scene must end with a
 * class or be refused with a text; a scene that ends is judged by what no physics may break, at every tenth step:
 * nothing that is not finite, energy, momentum and mass to rounding, no motion out of nothing.  The worst ten are
 * printed; exit 1 when one fails.
 *
 * Materials are those of cases/materials; speeds 0.1 .. 5 km/s, grain radii 0.05 .. 2 mm, lead angles 5 .. 90 degrees,
 * Courant numbers 0.1 .. 0.6 (some more, to be refused), 1 .. 1.5 cells a radius, temperatures up to melting; with
 * layers as thin as a twentieth of a cell, loose, bonded and welded grains, fragments that fly through the scene, and
 * armature, grains and fragments that leave the window; on one to three nested grids.
 *
 * --targets: strikes at random targets instead (targets.c). */
#include "stress.h"
#include "base/constants.h"
#include "coupling/gouge/impact.h"
#include "mpm/mpm.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { WORST = 10, LOOK_EVERY = 10 };

static const double ENERGY_LIMIT = 1e-9; /* of the kinetic energy at the start: rounding, 1e-12 was measured */
/* Bodies that start unstressed can gain no motion but by work from outside; where the scheme is not stable they do, out
 * of their heat, though the books close. */
static const double GAIN_LIMIT = 0.02;      /* of the kinetic energy at the start */
static const double MOMENTUM_LIMIT = 1e-10; /* of mass times the fastest body's speed: what the product promises */
static const double MASS_LIMIT = 1e-12;     /* rounding */

void stress_add(recipe *r, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    r->length += (size_t)vsnprintf(r->text + r->length, sizeof r->text - r->length, format, args);
    va_end(args);
    if (r->length >= sizeof r->text) {
        fprintf(stderr, "stress: a case longer than %d\n", (int)sizeof r->text);
        exit(1);
    }
}

static double temperature(chance *c, double melting)
{
    return one_in(c, 2) ? 293 : uniform(c, 77, fmin(melting, 2000));
}

static int add_rail(recipe *r, chance *c, const stock *s)
{
    const int rail = any_material(r, c, s);
    stress_add(r, "rail:\n  material: %s\n  temperature: %.6g K\n  yield_scale: %.6g\n", s->names[rail],
               temperature(c, s->melting[rail]), log_uniform(c, 0.5, 3));
    const int layers = one_in(c, 2) ? 0 : 1 + below(c, 2);
    if (layers > 0) stress_add(r, "  layers:\n");
    for (int i = 0; i < layers; i++) {
        stress_add(r, "    - {material: %s, thickness: %.6g m, yield_scale: %.6g", s->names[any_material(r, c, s)],
                   r->radius * log_uniform(c, 0.05, 1.5), log_uniform(c, 0.5, 3));
        if (one_in(c, 4)) stress_add(r, ", bond_strength: %.6g Pa", log_uniform(c, 1e6, 1e10));
        stress_add(r, "}\n");
    }
    return rail;
}

static int add_projectile(recipe *r, chance *c, const stock *s)
{
    const int armature = any_material(r, c, s);
    const double a = r->radius;
    const double leg = a * uniform(c, 1.5, 3), lead = uniform(c, 5, 90), chamfer = leg * uniform(c, 0, 0.9);
    stress_add(
        r,
        "armature:\n  material: %s\n  lead_angle: %.6g deg\n  length: %.6g m\n  leg_thickness: %.6g m\n"
        "  head_thickness: %.6g m\n  half_bore: %.6g m\n  width: %.6g m\n  chamfer_height: %.6g m\n  temperature: %.6g "
        "K\n",
        s->names[armature], lead, a * uniform(c, 4, 9) + chamfer / tan(lead * PI / 180), leg, a * uniform(c, 1.5, 3),
        a * uniform(c, 9, 11) + r->wider, a * uniform(c, 4, 9), chamfer, temperature(c, s->melting[armature]));
    return armature;
}

static void add_particle(recipe *r, chance *c, const stock *s)
{
    static const char *const shapes[] = { "hemisphere", "cone", "ridge", "sphere", "cylinder", "wedge" };
    stress_add(r, "particle:\n  shape: %s\n  radius: %.6g m\n  height: %.6g m\n", shapes[below(c, 6)], r->radius,
               r->radius * uniform(c, 0.3, 1.5));
    if (one_in(c, 2)) stress_add(r, "  material: %s\n", s->names[any_material(r, c, s)]);
    if (one_in(c, 3)) stress_add(r, "  bond_strength: %.6g Pa\n", one_in(c, 3) ? 0 : log_uniform(c, 1e7, 1e10));
}

static void add_scene(recipe *r, chance *c)
{
    const double a = r->radius, cells = uniform(c, 1, 1.5), coarse = a * (one_in(c, 20) ? 0.5 : uniform(c, 1.02, 2.5));
    stress_add(r, "scene:\n  velocity: %.8g m/s\n  courant: %.4g\n  cells_per_radius: %.4g\n  coarse_cell: %.6g m\n",
               r->velocity, r->courant, cells, coarse);
    stress_add(r, "  friction: %.4g\n  growth: %.4g\n  contact_pressure: %.6g Pa\n",
               one_in(c, 4) ? 0 : uniform(c, 0, 1), uniform(c, 1.05, 1.3), one_in(c, 2) ? 0 : log_uniform(c, 1e6, 1e9));
    stress_add(r, "  rail_ahead: %.6g m\n  rail_behind: %.6g m\n  rail_depth: %.6g m\n",
               a * uniform(c, 7, 12) + r->wider, a * uniform(c, 6, 9) + r->wider, a * uniform(c, 7, 9) + r->wider);
    stress_add(r, "  refine_tolerance: %.4g\n", log_uniform(c, 0.01, 0.5));
    /* no longer than MAX_STEPS of a metal whose waves run at 6 km/s */
    const double crossing = 12 * a / r->velocity;
    stress_add(r, "  end_time: %.6g s\n", fmin(crossing, MAX_STEPS * r->courant * a / cells / (6000 + r->velocity)));
    if (one_in(c, 5))
        stress_add(r, "  basis: bspline\n"); /* one grid only */
    else
        stress_add(r, "  levels: %d\n", r->levels);
    if (one_in(c, 8)) stress_add(r, "  transfer: pic\n");
    if (one_in(c, 6)) stress_add(r, "  heat_by_plastic_work: yes\n");
    if (r->group == WITHOUT_DAMAGE) stress_add(r, "  damage: no\n");
    if (one_in(c, 6)) stress_add(r, "  half_model: no\n");
    if (one_in(c, 6)) stress_add(r, "  particles_per_axis: 3\n");
    if (one_in(c, 6)) stress_add(r, "  shear_limit: %.6g Pa\n", log_uniform(c, 1e6, 1e9));
    stress_add(r, "output:\n  snapshots: 0\n");
}

static void write_recipe(recipe *r, chance *c, const stock *s, double courant)
{
    chance levels = { ~c->state }; /* beside the others, which it leaves as they were without levels */
    r->length = 0;
    r->radius = log_uniform(c, 0.05e-3, 2e-3);
    r->levels = 1 + below(&levels, 3);
    r->wider = 3 * ((1 << (r->levels - 1)) - 1) * r->radius; /* three of the largest cells, and one cell a radius */
    r->velocity = log_uniform(c, 100, 5000);
    r->courant = uniform(c, 0.1, one_in(c, 10) ? 0.8 : 0.6); /* more than 0.6 is refused */
    if (courant > 0) r->courant = courant;
    r->group = one_in(c, 25) ? ANY : one_in(c, 3) ? WITHOUT_DAMAGE : WITH_DAMAGE;
    stress_add(r, "name: stress\n");
    const int rail = add_rail(r, c, s), armature = add_projectile(r, c, s);
    add_particle(r, c, s);
    add_scene(r, c);
    snprintf(r->summary, sizeof r->summary, "%.0f m/s, r %.3f mm, C %.2f, %d levels, %s on %s", r->velocity,
             1e3 * r->radius, r->courant, r->levels, s->names[armature], s->names[rail]);
}

/* Spheres that fly about: they hit the armature, or leave by the free side and the ends.  The armature stays the last
 * body, so that it keeps the points they share. */
static status add_fragments(gouge_scene *g, chance *c, const recipe *r)
{
    mpm_scene *s = &g->scene;
    const int wanted = one_in(c, 3) ? 1 + below(c, 2) : 0;
    for (int i = 0; i < wanted; i++) {
        mpm_body *last;
        mpm_solid *ball;
        TRY(mpm_scene_add_body(s, &last));
        TRY(mpm_scene_add_solid(s, "sphere", -1, -1, &ball));
        mpm_body *b = &s->body[g->armature++];
        const int next = b->group + 1;
        *last = *b; /* the last one, which wins points */
        b->solid = s->solids - 1;
        snprintf(b->name, sizeof b->name, "particle");
        b->group = next;
        double *middle = mpm_solid_value(ball, "center"), a = r->radius;
        *mpm_solid_value(ball, "radius") = a * uniform(c, 0.5, 1);
        middle[0] = uniform(c, 2 * a, 5 * a);
        middle[1] = uniform(c, 1.2 * a, 4 * a);
        middle[2] = uniform(c, 0, 3 * a);
        for (int k = 0; k < 3; k++) b->velocity[k] = uniform(c, -1, 1) * r->velocity, b->body_force[k] = 0;
    }
    return status_ok();
}

/* ---- running and judging ---- */

static void look(outcome *o, const mpm *m)
{
    const mpm_ledger l = mpm_balance(m);
    const double energy = fabs(l.energy_error), mass = fabs((l.mass + l.ejected_mass) / l.mass_start - 1);
    const double start = l.kinetic_start + o->driven; /* of a piston: not in the scene, its work from outside is */
    const double gain = (l.kinetic - l.work_boundary - l.work_external - l.kinetic_start) / start;
    /* NaN must win */
    if (!(energy <= o->energy)) o->energy = energy;
    if (!(l.momentum_error <= o->momentum)) o->momentum = l.momentum_error;
    if (!(mass <= o->mass)) o->mass = mass;
    if (!(gain <= o->gain)) o->gain = gain;
    o->steps = mpm_state(m).steps;
}

/* The checkpoint's hook, called after every step because the case asks for no time between two. */
static status on_save(void *user, const char *scene, const scene_now *now)
{
    (void)scene;
    outcome *o = user;
    if (o->looks++ % LOOK_EVERY == 0) look(o, now->m);
    return status_ok();
}

static void judge(outcome *o)
{
    o->verdict = ENDED;
    if (!(o->energy < ENERGY_LIMIT) || !(o->momentum < MOMENTUM_LIMIT) || !(o->mass < MASS_LIMIT)) {
        o->verdict = FAILED;
        o->why = base_status_error(STATUS_NUMERICAL, "books do not close");
    } else if (!(o->gain < GAIN_LIMIT)) {
        o->verdict = FAILED;
        o->why = base_status_error(STATUS_NUMERICAL, "motion out of nothing");
    }
}

static void take_status(outcome *o, const status *s)
{
    const bool input = s->code == STATUS_BAD_INPUT && s->text[0];
    o->verdict = input ? REFUSED : FAILED;
    o->why = *s;
}

static void run_case(const breech_case *c, const recipe *r, chance *luck, outcome *o)
{
    gouge_job job;
    impact hit;
    case_impact one = case_inputs_of(c).onset.impact;
    one.checkpoint_interval = 0;
    status s = gouge_job_make(&one, &job);
    if (s.code == STATUS_OK) {
        job.name = job.task = "stress";
        const scene_host host = { .threads = 1, .save = on_save, .user = o };
        s = add_fragments(&job.scene, luck, r);
        if (s.code == STATUS_OK) s = gouge_job_run(&job, &host, &hit);
        gouge_job_free(&job);
    }
    if (s.code != STATUS_OK) {
        take_status(o, &s);
        return;
    }
    const scene_result *e = &hit.result;
    if (!(fabs(e->energy_error) <= o->energy)) o->energy = fabs(e->energy_error);
    if (!(e->momentum_error <= o->momentum)) o->momentum = e->momentum_error;
    snprintf(o->class, sizeof o->class, "%s", run_damage_names[e->class]);
    judge(o);
}

typedef struct {
    int scenes, first;
    uint64_t seed;
    double courant; /* of every gouge scene; 0: each its own */
    bool verbose, targets;
} options;

static void run_target(const breech_case *c, outcome *o)
{
    const scene_host host = { .threads = 1, .save = on_save, .user = o };
    const status s = stress_target_run(c, &host, o);
    if (s.code != STATUS_OK)
        take_status(o, &s);
    else
        judge(o);
}

static outcome run_one(const stock *s, const options *of, int index)
{
    chance luck = { of->seed ^ ((uint64_t)index << 20) };
    recipe r;
    outcome o = { .index = index, .gain = -1 };
    if (of->targets)
        stress_target_write(&r, &luck, s);
    else
        write_recipe(&r, &luck, s, of->courant);
    if (of->verbose) printf("---- scene %d\n%s", index, r.text);
    snprintf(o.summary, sizeof o.summary, "%s", r.summary);
    const case_options how = { s->at.dir, s->at.n, of->targets ? CASE_FOR_STRIKE : CASE_FOR_SCENE };
    const case_text text = { .bytes = r.text, .length = r.length, .path = "stress.yaml" };
    breech_case *c = NULL;
    char *errors = NULL;
    struct timespec from, to;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &from);
    const status read = case_read_memory(&text, &how, &c, &errors);
    if (read.code == STATUS_OK && of->targets)
        run_target(c, &o);
    else if (read.code == STATUS_OK)
        run_case(c, &r, &luck, &o);
    else
        take_status(&o, &read);
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &to);
    o.seconds = (double)(to.tv_sec - from.tv_sec) + 1e-9 * (double)(to.tv_nsec - from.tv_nsec);
    case_free(c);
    free(errors);
    return o;
}

/* ---- the whole ---- */

/* Worst first: failed ones, then by what they gained. */
static int worse(const void *a, const void *b)
{
    const outcome *x = a, *y = b;
    const double ex = isfinite(x->gain) ? x->gain : HUGE_VAL, ey = isfinite(y->gain) ? y->gain : HUGE_VAL;
    if ((x->verdict == FAILED) != (y->verdict == FAILED)) return x->verdict == FAILED ? -1 : 1;
    return (ex < ey) - (ex > ey);
}

static void print_outcome(const outcome *o)
{
    static const char *const names[] = { "ended", "refused", "FAILED" };
    printf("%5d  %-7s %-9s energy %8.1e, gain %8.1e, momentum %7.1e, mass %7.1e, %4llu steps, %5.1f s: %s%s%s\n",
           o->index, names[o->verdict], o->class, o->energy, o->gain, o->momentum, o->mass,
           (unsigned long long)o->steps, o->seconds, o->summary, o->why.text[0] ? ": " : "", o->why.text);
    fflush(stdout);
}

static int report(outcome *all, int n)
{
    int count[3] = { 0, 0, 0 };
    double seconds = 0;
    for (int i = 0; i < n; i++) count[all[i].verdict]++, seconds += all[i].seconds;
    qsort(all, (size_t)n, sizeof *all, worse);
    printf("\n%d scenes: %d ended with a class, %d refused, %d failed; %.0f s of processor time.  The worst:\n", n,
           count[ENDED], count[REFUSED], count[FAILED], seconds);
    for (int i = 0; i < n && (i < WORST || all[i].verdict == FAILED); i++) print_outcome(&all[i]);
    return count[FAILED] > 0;
}

/* Into which groups a material goes; its melting temperature, 900 K where that is not known and the scene is refused
 * anyway. */
static void take_material(stock *s, int i)
{
    material_sheet sheet;
    char *errors = NULL;
    s->melting[i] = 900;
    s->group[ANY][s->count[ANY]++] = i;
    if (case_material_sheet_open(s->names[i], s->at.dir, s->at.n, &sheet, &errors).code == STATUS_OK) {
        const mpm_material *m = &sheet.material;
        if (m->melting_temperature > 0) s->melting[i] = m->melting_temperature;
        const bool scene = mpm_material_check(m, MPM_MATERIAL_FOR_SCENE).code == STATUS_OK;
        if (scene) s->group[WITHOUT_DAMAGE][s->count[WITHOUT_DAMAGE]++] = i;
        if (scene && mpm_material_check(m, MPM_MATERIAL_FOR_DAMAGE).code == STATUS_OK)
            s->group[WITH_DAMAGE][s->count[WITH_DAMAGE]++] = i;
        case_material_sheet_free(&sheet);
    }
    free(errors);
}

static bool open_stock(stock *s)
{
    memset(s, 0, sizeof *s);
    if (case_material_places_find(&s->at).code != STATUS_OK) return false;
    if (s->at.n == 0 || case_material_names(s->at.dir[0], &s->names, &s->n).code != STATUS_OK || s->n == 0)
        return false;
    s->melting = calloc((size_t)s->n, sizeof *s->melting);
    for (int g = 0; g < GROUPS; g++) s->group[g] = calloc((size_t)s->n, sizeof *s->group[g]);
    if (!s->melting || !s->group[0] || !s->group[1] || !s->group[2]) return false;
    for (int i = 0; i < s->n; i++) take_material(s, i);
    return s->count[WITH_DAMAGE] > 0 && s->count[WITHOUT_DAMAGE] > 0;
}

static void close_stock(stock *s)
{
    free(s->melting);
    for (int g = 0; g < GROUPS; g++) free(s->group[g]);
    case_material_names_free(s->names, s->n);
}

static options read_options(int argc, char **argv)
{
    options o = { .scenes = 500, .first = 0, .seed = 20170, .verbose = false };
    for (int i = 1; i < argc; i++) {
        const bool more = i + 1 < argc;
        if (strcmp(argv[i], "--scenes") == 0 && more)
            o.scenes = atoi(argv[++i]);
        else if (strcmp(argv[i], "--first") == 0 && more)
            o.first = atoi(argv[++i]);
        else if (strcmp(argv[i], "--seed") == 0 && more)
            o.seed = strtoull(argv[++i], NULL, 10);
        else if (strcmp(argv[i], "--courant") == 0 && more)
            o.courant = strtod(argv[++i], NULL);
        else if (strcmp(argv[i], "--verbose") == 0)
            o.verbose = true;
        else if (strcmp(argv[i], "--targets") == 0)
            o.targets = true;
        else
            o.scenes = 0;
    }
    if (o.scenes < 1) {
        fprintf(stderr,
                "usage: breech-stress [--targets] [--scenes N] [--first K] [--seed S] [--courant C] [--verbose]\n");
        exit(2);
    }
    return o;
}

int main(int argc, char **argv)
{
    const options o = read_options(argc, argv);
    stock s;
    outcome *all = calloc((size_t)o.scenes, sizeof *all);
    if (!open_stock(&s) || !all) {
        fprintf(stderr, "stress: no memory, or no materials found; set BREECH_MATERIALS\n");
        return 1;
    }
    for (int i = 0; i < o.scenes; i++) {
        all[i] = run_one(&s, &o, o.first + i);
        print_outcome(&all[i]);
    }
    const int failed = report(all, o.scenes);
    free(all);
    close_stock(&s);
    return failed;
}
