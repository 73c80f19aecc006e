/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/study/check.h"

#include "coupling/case/treatment.h"
#include "coupling/gouge/impact_scene.h"
#include "coupling/host/machine.h"
#include "coupling/host/progress.h"
#include "coupling/scene/scene_fill.h"
#include "coupling/scene/scene_possible.h"
#include "coupling/strike/arrival.h"
#include "coupling/study/sampling/population.h"
#include "coupling/study/search/family.h"
#include "coupling/study/study.h"

#include <math.h>
#include <string.h>

/* ---- can its scenes be made? ---- */

/* A scene's grid and its materials, as far as they show without its points; and can it be held in memory? */
static status needs_of(const mpm_scene *s, mpm_needs *needs, size_t *largest)
{
    TRY(mpm_estimate(s, needs));
    if (largest && needs->bytes > *largest) *largest = needs->bytes;
    const double has = host_memory("");
    CHECK((double)needs->bytes <= has, STATUS_BAD_INPUT,
          "its %.3g million points need %.1f GB, this machine or its control group has %.1f GB: take larger cells",
          1e-6 * (double)needs->particles, 1e-9 * (double)needs->bytes, 1e-9 * has);
    return status_ok();
}

/* Can its scene be built? */
static status impact_possible(const case_impact *c, size_t *largest)
{
    gouge_scene scene;
    mpm_needs needs;
    TRY(gouge_scene_bodies(c, &scene));
    const status fits = needs_of(&scene.scene, &needs, largest);
    gouge_scene_free(&scene);
    CHECK(fits.code == STATUS_OK, fits.code, "scene of %g mm at %g m/s with %g cells a radius: %.350s",
          1e3 * c->particle.radius, c->scene.velocity, c->scene.cells_per_radius, fits.text);
    return status_ok();
}

/* A search's scene with this grain at this velocity. */
static case_impact scene_at(const case_onset *c, const case_site *grain, double velocity, double cells_per_radius)
{
    const case_impact probe = study_family_probe(c);
    const site_state state = { .grain = *grain,
                               .velocity = velocity,
                               .contact_pressure = probe.scene.contact_pressure,
                               .lead_face_temperature = NAN };
    return gouge_impact_at(&probe, &state, cells_per_radius);
}

static case_impact slowest(const case_onset *c, const case_site *grain, double cells_per_radius)
{
    return scene_at(c, grain, c->study.velocity_low, cells_per_radius);
}

/* A search's scenes at both resolutions with a grain of this size. */
static status grain_possible(const case_onset *c, const case_site *grain, size_t *largest)
{
    const case_impact coarse = slowest(c, grain, c->study.coarse_cells_per_radius),
                      fine = slowest(c, grain, c->study.fine_cells_per_radius);
    TRY(impact_possible(&coarse, largest));
    return fine.scene.cells_per_radius == coarse.scene.cells_per_radius ? status_ok() : impact_possible(&fine, largest);
}

static bool same(double a, double b)
{
    return a == b || (isnan(a) && isnan(b));
}

/* Is there a site before this one with the same grain?  Then its scenes are the same but for their velocities. */
static bool has_grain_before(const case_sites *sites, int i)
{
    const case_site *b = &sites->item[i];
    for (int k = 0; k < i; k++) {
        const case_site *a = &sites->item[k];
        if (same(a->radius, b->radius) && same(a->height, b->height) && same(a->bond_strength, b->bond_strength) &&
            strcmp(a->shape, b->shape) == 0 && strcmp(a->material, b->material) == 0)
            return true;
    }
    return false;
}

/* A grain of a population, of this size. */
static case_site grain_of(const case_population *p, double radius)
{
    case_site grain = { .radius = radius, .height = p->aspect * radius, .bond_strength = p->bond_strength };
    memcpy(grain.shape, p->shape, sizeof grain.shape);
    memcpy(grain.material, p->material, sizeof grain.material);
    return grain;
}

static status grains_possible(const case_onset *c, size_t *largest)
{
    for (int i = 0; i < c->sites.n; i++)
        if (!has_grain_before(&c->sites, i)) TRY(grain_possible(c, &c->sites.item[i], largest));
    for (int i = 0; i < c->populations.n; i++) {
        const case_population *p = &c->populations.item[i];
        population_sizes sizes;
        status s = study_population_sizes(p, c->study.smallest_radius, &sizes);
        CHECK(s.code == STATUS_OK, s.code, "populations[%d].%.380s", i, s.text);
        const int n = sizes.n;
        for (int k = 0; k<n; k += n> 1 ? n - 1 : 1) { /* the smallest and the largest */
            const case_site grain = grain_of(p, sizes.size[k]);
            s = grain_possible(c, &grain, largest);
            CHECK(s.code == STATUS_OK, s.code, "populations[%d], its %s grains, of %.3g mm: %.380s", i,
                  k == 0 ? "smallest" : "largest", 1e3 * sizes.size[k], s.text);
        }
    }
    return status_ok();
}

static status treatments_possible(const case_onset *c, const case_treatments *all, bool shoots, size_t *largest)
{
    for (int i = 0; i < all->n; i++) {
        case_onset treated;
        status s = case_treat(c, &all->item[i], &treated);
        const bool made = s.code == STATUS_OK; /* its error names the treatment already */
        if (made && case_treated_alike(c, &treated))
            s = base_status_error(STATUS_BAD_INPUT, "changes nothing of the rail as it is: give it another value, or "
                                                    "leave it out");
        if (s.code == STATUS_OK && shoots) s = circuit_shot_check(&treated.launcher);
        if (s.code == STATUS_OK) s = grains_possible(&treated, largest);
        case_treated_free(&treated);
        CHECK(s.code == STATUS_OK, s.code, "%s%s%s%.400s", made ? "treatment `" : "", made ? all->item[i].name : "",
              made ? "`: " : "", s.text);
    }
    return status_ok();
}

status study_prepare(case_inputs *in)
{
    if (!in->given.bodies) return status_ok();
    return in->given.strike ? strike_fill(in) : scene_fill(&in->bodies.scene);
}

status study_possible(const case_inputs *in, unsigned needs, size_t *largest)
{
    mpm_needs bodies;
    if (in->given.bodies) {
        TRY(needs_of(&in->bodies.scene, &bodies, largest));
        CHECK(bodies.empty < 0, STATUS_BAD_INPUT,
              "scene.bodies[%d].shape: nothing of %s is left: not one point, of cells as large as these", bodies.empty,
              in->bodies.scene.body[bodies.empty].name);
        if ((needs & (CASE_FOR_SCENE | CASE_FOR_STRIKE)) == CASE_FOR_SCENE) TRY(scene_possible(&in->bodies.scene));
    }
    const case_onset *c = &in->onset;
    circuit_rail_section section;
    const bool shoots = needs & (CASE_FOR_SHOT | CASE_FOR_ONSET);
    if (needs & CASE_FOR_INDUCTANCE) TRY(circuit_rails_section(&c->launcher.rails, &section));
    if (shoots) TRY(circuit_rails_check(&c->launcher.rails));
    if (shoots) TRY(circuit_shot_check(&c->launcher));
    if ((needs & CASE_FOR_SCENE) && !in->given.bodies) TRY(impact_possible(&c->impact, largest));
    if (needs & CASE_FOR_ONSET) TRY(grains_possible(c, largest));
    return needs & CASE_FOR_COMPARE ? treatments_possible(c, &in->treatments, shoots, largest) : status_ok();
}

/* ---- what would they take? ---- */

enum { TRIAL_POINTS = 300000, TRIAL_WARM = 2, TRIAL_LEAST = 5 /* steps */ };
static const double TRIAL_SECONDS = 0.4;

typedef struct {
    int threads;
    double rate; /* measured: of a point and step [s]; NAN: not yet */
} pace;

typedef struct {
    int steps;
    double since;    /* wall clock behind the warm steps [s] */
    uint64_t before; /* point-steps then */
} trial;

/* Those that points at rest did not take count too, as they do in mpm_needs.work. */
static uint64_t counted_steps(const mpm *m)
{
    const mpm_report now = mpm_glance(m);
    return now.particle_steps + now.particle_steps_asleep;
}

static bool trial_goes_on(void *user, const mpm *m)
{
    trial *t = user;
    if (++t->steps == TRIAL_WARM) {
        t->since = host_wall_clock();
        t->before = counted_steps(m);
    }
    return t->steps < TRIAL_LEAST || host_wall_clock() - t->since < TRIAL_SECONDS;
}

/* Runs the scene's first steps.  One that cannot be made or fails there tells nothing: its run will say why. */
static void try_scene(const mpm_scene *s, double last, pace *p)
{
    trial t = { .steps = 0 };
    mpm *m = NULL;
    if (mpm_create(s, p->threads, &m).code != STATUS_OK) return;
    const status done = mpm_advance(m, last, &(mpm_sink){ trial_goes_on, &t });
    const uint64_t taken = t.steps < TRIAL_LEAST ? 0 : counted_steps(m) - t.before;
    if ((done.code == STATUS_OK || done.code == STATUS_STOPPED) && taken > 0)
        p->rate = (host_wall_clock() - t.since) / (double)taken;
    mpm_free(m);
}

static status estimate_scene(const mpm_scene *s, double last, pace *p, scene_estimate *out)
{
    TRY(needs_of(s, &out->needs, NULL));
    if (isnan(p->rate) && out->needs.particles <= TRIAL_POINTS) try_scene(s, last, p);
    out->steps = last / out->needs.dt;
    out->searched = false;
    return status_ok();
}

static status estimate(const case_impact *c, const char *what, pace *p, scene_estimate *out)
{
    gouge_scene scene;
    snprintf(out->what, sizeof out->what, "%s, %g m/s, %g cells a radius", what, c->scene.velocity,
             c->scene.cells_per_radius);
    TRY(gouge_scene_bodies(c, &scene));
    const status made = estimate_scene(&scene.scene, gouge_last_time(&scene), p, out);
    gouge_scene_free(&scene);
    return made;
}

/* The slowest and finest scene of a search on a treated rail. */
static status estimate_treated(const case_onset *c, const case_treatment *t, const case_site *grain, pace *p,
                               scene_estimate *out)
{
    case_onset treated;
    status s = case_treat(c, t, &treated);
    if (s.code == STATUS_OK) {
        const case_impact one = slowest(&treated, grain, treated.study.fine_cells_per_radius);
        s = estimate(&one, t->name, p, out);
    }
    case_treated_free(&treated);
    return s;
}

/* Is there a scene of armature over grain of the case's own? */
static bool has_scene(const case_inputs *in)
{
    const case_impact *own = &in->onset.impact;
    return in->onset.has_body && !isnan(own->scene.velocity) && !isnan(own->particle.radius);
}

/* Both ends of the search's range with this grain, the slow one with coarse cells too where they differ. */
static status estimate_search(const case_onset *c, const case_site *grain, pace *p, scene_estimate *out, int *n)
{
    const case_study *y = &c->study;
    const struct {
        double velocity, cells;
    } of[] = { { y->velocity_low, y->coarse_cells_per_radius },
               { y->velocity_low, y->fine_cells_per_radius },
               { y->velocity_high, y->fine_cells_per_radius } };
    for (int k = 0; k < 3; k++) {
        if (k == 0 && !(of[0].cells < of[1].cells)) continue;
        const case_impact one = scene_at(c, grain, of[k].velocity, of[k].cells);
        TRY(estimate(&one, "onset", p, &out[*n]));
        out[(*n)++].searched = k > 0;
    }
    return status_ok();
}

static status estimate_all(const case_inputs *in, pace *pace_of, scene_estimate out[CHECK_MAX_ESTIMATES], int *n)
{
    const case_onset *c = &in->onset;
    if (in->given.bodies) {
        snprintf(out[*n].what, sizeof out->what, "scene, %d bodies", in->bodies.scene.bodies);
        TRY(estimate_scene(&in->bodies.scene, in->bodies.scene.end_time, pace_of, &out[(*n)++]));
    }
    if (has_scene(in)) TRY(estimate(&c->impact, "scene", pace_of, &out[(*n)++]));
    if (!c->has_body || (c->sites.n == 0 && c->populations.n == 0)) return status_ok();
    const case_population *p = c->populations.item;
    const case_site grain = c->sites.n > 0 ? c->sites.item[0] : grain_of(p, study_population_quantile(p, 0.5));
    TRY(estimate_search(c, &grain, pace_of, out, n));
    for (int k = 0; k < in->treatments.n && *n < CHECK_MAX_ESTIMATES; k++)
        TRY(estimate_treated(c, &in->treatments.item[k], &grain, pace_of, &out[(*n)++]));
    return status_ok();
}

/* Without a trial memory bandwidth and the serial rest are left out: a lower bound on many threads. */
static double pace_rate(const pace *p)
{
    return isnan(p->rate) ? CHECK_SECONDS_A_STEP / p->threads : p->rate;
}

status study_check(const case_inputs *in, int threads, scene_estimate out[CHECK_MAX_ESTIMATES], int *n, double *rate)
{
    pace p = { threads, NAN };
    *n = 0;
    const status s = estimate_all(in, &p, out, n);
    for (int i = 0; i < *n; i++) { /* those before the trial too */
        const double work = out[i].steps * out[i].needs.work;
        out[i].seconds = work * pace_rate(&p);
        out[i].likely = CHECK_GROWTH * work * p.rate;
    }
    *rate = p.rate;
    return s;
}

double study_check_search_time(const scene_estimate *e, int n, int scenes)
{
    double sum = 0.0;
    int ends = 0;
    for (int i = 0; i < n; i++)
        if (e[i].searched) sum += e[i].likely, ends++;
    return ends > 0 ? scenes * sum / ends : NAN;
}

void study_check_assumptions(const case_inputs *in, int threads, double rate, FILE *out)
{
    fprintf(out, "at least: %.0f ns a point and step on %d thread%s%s, points and steps as at the start\n",
            1e9 * (isnan(rate) ? CHECK_SECONDS_A_STEP / threads : rate), threads, threads == 1 ? "" : "s",
            isnan(rate) ? ", assumed" : ", as just measured");
    if (!isnan(rate))
        fprintf(out, "likely: %.1f times that, for contact, heat and small cells that come later\n", CHECK_GROWTH);
    fputs("not counted: shorter steps where it gets hot or fast, an end before its time where nothing changes any more",
          out);
    if (in->given.bodies && in->bodies.scene.refines > 0) fputs(", cells that scene.refine makes small later", out);
    if (in->onset.impact.scene.cells_per_layer > 0.0 && (in->onset.impact.rail.layers.n > 0 || in->treatments.n > 0))
        fputs(", a layer's own cells where it flows (scene.cells_per_layer), which may cost most of all", out);
    if (in->given.bodies && in->bodies.scene.probes > 0) fputs(", probes", out);
    if (in->output.snapshots > 0) fprintf(out, ", %d snapshots", in->output.snapshots);
    fputc('\n', out);
}

enum { LEAST_OF_BRACKET = 2 }; /* scenes: one on either side */

void study_check_searches(const case_inputs *in, FILE *out)
{
    const case_onset *c = &in->onset;
    const int most = c->study.max_scenes;
    if (in->given.strike && in->strike.limit && most < LEAST_OF_BRACKET)
        fprintf(out, "warning: study.max_scenes = %d: a limit velocity lies between two arrivals at least\n", most);
    if (!c->has_body || (c->sites.n == 0 && c->populations.n == 0)) return;
    const case_impact probe = study_family_probe(c);
    const int kinds = study_family_kinds(c), craters = case_impact_is_gauged(&probe) ? c->study.craters * kinds : 0;
    const int left = most - craters;
    if (left < LEAST_OF_BRACKET * kinds)
        fprintf(out,
                "warning: study.max_scenes = %d: less %d for whole craters it leaves %d to the searches of %d kinds of "
                "grain, each of which needs %d at least, one on either side of the threshold\n",
                most, craters, left > 0 ? left : 0, kinds, LEAST_OF_BRACKET);
}

/* What cells of its own do for a thin layer. */
static void print_remedy(const case_scene *of, double fine, double thickness, FILE *out)
{
    static const double CELLS = 2.0; /* across a layer, the fewest that bend */
    static const double COST = 0.1;  /* of them over a scene's, unhalved; each halving doubles steps and both lengths */
    case_scene with = *of;
    with.cells_per_layer = CELLS;
    const int halvings = gouge_layer_halvings(&with, fine, thickness);
    if (halvings > 0)
        fprintf(out, "; scene.cells_per_layer = %g gives it cells of its own, for some %.2g times the time", CELLS,
                1.0 + COST * exp2(3.0 * halvings));
    fputc('\n', out);
}

/* The layers of a rail under grains of this radius. */
static void print_thin_layers(const case_onset *c, const char *surface, double radius, FILE *out)
{
    const double fine = radius / c->study.fine_cells_per_radius;
    for (int i = 0; i < c->impact.rail.layers.n; i++) {
        const case_layer *layer = &c->impact.rail.layers.item[i];
        const double across = gouge_cells_across(&c->impact.scene, fine, layer->thickness);
        if (across >= GOUGE_RESOLVED_LAYER) continue;
        fprintf(
            out,
            "warning: %s%s%g um of %s has %.2g cells across: with less than two what it does inside is not resolved "
            "(docs/theory/onset.md#thin-layers)",
            surface, surface[0] ? ": " : "", 1e6 * layer->thickness, layer->material, across);
        print_remedy(&c->impact.scene, fine, layer->thickness, out);
    }
}

void study_check_thin_layers(const case_inputs *in, FILE *out)
{
    const case_onset *c = &in->onset;
    if (!c->has_body || (c->sites.n == 0 && c->populations.n == 0)) return;
    const case_population *p = c->populations.item;
    const double radius = c->sites.n > 0 ? c->sites.item[0].radius : study_population_quantile(p, 0.5);
    print_thin_layers(c, "", radius, out);
    for (int k = 0; k < in->treatments.n; k++) {
        case_onset treated;
        if (case_treat(c, &in->treatments.item[k], &treated).code == STATUS_OK)
            print_thin_layers(&treated, in->treatments.item[k].name, radius, out);
        case_treated_free(&treated);
    }
}

status study_print_scene(const case_inputs *in, FILE *out)
{
    gouge_scene scene;
    const case_impact *own = &in->onset.impact;
    if (in->given.bodies) return case_inputs_write(in, out);
    CHECK(has_scene(in), STATUS_BAD_INPUT,
          "the case has no scene of its own: give scene.velocity and particle.radius, or a scene with bodies");
    TRY(gouge_scene_bodies(own, &scene));
    const status written = case_inputs_write_scene(in, &scene.scene, out);
    gouge_scene_free(&scene);
    return written;
}
