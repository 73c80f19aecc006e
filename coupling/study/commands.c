#include "coupling/study/commands.h"

#include "coupling/case/treatment.h"
#include "coupling/run/scenes.h"
#include "coupling/study/sampling/population.h"

#include <complex.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

void study_command_free(command_result *r)
{
    study_onset_answer_free(&r->onset);
    study_compare_answer_free(&r->compare);
    free(r->fire_at);
    r->fire_at = NULL;
    free(r->gradients);
    r->gradients = NULL;
    circuit_inductance_surface_free(&r->surface);
}

/* ---- shot ---- */

static status shoot(session *s, const breech_case *c, command_result *out)
{
    shot_outcome o;
    const status done = run_session_shot(s, c, NULL, true, &o, &out->shot);
    gouge_shot_outcome_free(&o);
    if (done.code == STATUS_OK) out->summary.shot = &out->shot;
    return done;
}

/* Shoots the case with the firing times found for it. */
static status shoot_optimised(session *s, command_result *out, shot_module *modules)
{
    const breech_case *given = s->c;
    const int n = given->supplies[SUPPLY_capacitor].n;
    const shot_config config = gouge_shot_config(given, NULL);
    const double since = host_wall_clock();
    firing_result found;
    host_progress_task(&s->progress, "search for firing times", 0.0, 0);
    TRY(circuit_firing_optimise(&config, &given->optimise, s->stop, modules, &found));
    host_timing_add(&s->timing, "firing times", host_wall_clock() - since);
    breech_case tuned = *given;
    tuned.supplies[SUPPLY_capacitor].item = modules;
    const status done = shoot(s, &tuned, out);
    out->shot.firing = found;
    out->shot.n_fire_at = n;
    out->shot.fire_at = out->fire_at;
    for (int k = 0; k < n; k++) out->fire_at[k] = modules[k].fire_at;
    return done;
}

status study_command_shot(session *s, command_result *out)
{
    if (!s->c->given.optimise) return shoot(s, s->c, out);
    const size_t n = (size_t)s->c->supplies[SUPPLY_capacitor].n;
    shot_module *modules = malloc((n + 1) * sizeof *modules);
    out->fire_at = malloc((n + 1) * sizeof *out->fire_at);
    const status done = modules && out->fire_at ? shoot_optimised(s, out, modules)
                                                : base_status_error(STATUS_MEMORY, "no memory for %zu groups", n);
    free(modules);
    return done;
}

status study_command_scene(session *s, command_result *out)
{
    const breech_case *c = s->c;
    const scene_query query = { .c = c,
                                .state = gouge_state_of_case(c),
                                .cells_per_radius = c->scene.cells_per_radius,
                                .name = "scene",
                                .anew = true };
    const scene_record *done;
    TRY(run_scenes_all(s, &query, 1, &done));
    run_scenes_warn_of(s, &done->entry);
    out->scene = done->entry.result;
    out->summary.scene = &out->scene;
    return status_ok();
}

status study_command_onset(session *s, command_result *out)
{
    const status done = study_onset_run(s, &out->onset);
    out->summary.onset = &out->onset.result;
    if (out->onset.shot.is.steps > 0) out->summary.shot = &out->onset.shot;
    return done;
}

status study_command_compare(session *s, command_result *out)
{
    const status done = study_compare_run(s, &out->compare);
    out->summary.compare = &out->compare.result;
    if (out->compare.n > 0 && out->compare.answer[0].shot.is.steps > 0)
        out->summary.shot = &out->compare.answer[0].shot;
    return done;
}

/* ---- inductance ---- */

static const double frequencies[] = { 1, 2, 5, 10, 20, 50, 100, 200, 500, 1e3, 2e3, 5e3, 1e4, 2e4, 5e4, 1e5 };
enum { FREQUENCIES = sizeof frequencies / sizeof frequencies[0] };

/* All frequencies from one solution, the perfect conductor from another. */
static status gradients_fill(const shot_rails *rails, command_result *out)
{
    static const double TURN = 6.28318530717958648;
    inductance_result *r = &out->inductance;
    rail_section section;
    impedance z;
    TRY(circuit_rails_section(rails, &section));
    status done = circuit_inductance_response(&section, frequencies[FREQUENCIES - 1], rails->fineness, &z);
    for (int i = 0; i < FREQUENCIES && done.code == STATUS_OK; i++) {
        const double complex Z = circuit_impedance_at(&z, _Complex_I * TURN * frequencies[i]);
        out->gradients[i] = cimag(Z) / (TURN * frequencies[i]);
        out->gradients[FREQUENCIES + i] = creal(Z);
    }
    circuit_impedance_free(&z);
    TRY(done);
    TRY(circuit_inductance_at(&section, 0.0, rails->fineness, &r->L_gradient_direct_current,
                              &r->R_gradient_direct_current));
    TRY(circuit_inductance_limit(&section, &r->L_gradient_high_frequency));
    const bool flat = section.rails == 2 && section.face_crown == 0.0 && section.back_crown == 0.0;
    r->L_gradient_kerrisk =
        flat ? circuit_inductance_kerrisk(section.height, section.thickness, section.separation) : NAN;
    r->kerrisk_error = r->L_gradient_kerrisk / r->L_gradient_high_frequency - 1.0;
    return circuit_inductance_surface_at(&section, r->perimeter_frequency, rails->fineness, &out->surface);
}

/* The surface at rails.frequency; else at what the pulse says, at 1 kHz without supplies. */
static double surface_frequency(const breech_case *c)
{
    if (!isnan(c->rails.frequency)) return c->rails.frequency;
    supply_list supplies[SUPPLY_KINDS];
    for (int k = 0; k < SUPPLY_KINDS; k++) supplies[k] = (supply_list){ c->supplies[k].n, c->supplies[k].item };
    const double f = circuit_shot_effective_frequency(supplies);
    return isnan(f) ? 1000.0 : f;
}

status study_command_inductance(session *s, command_result *out)
{
    const double since = host_wall_clock();
    inductance_result *r = &out->inductance;
    out->gradients = malloc(2 * FREQUENCIES * sizeof *out->gradients);
    CHECK(out->gradients, STATUS_MEMORY, "no memory for %d frequencies", FREQUENCIES);
    host_progress_task(&s->progress, "inductance gradients", 0.0, 0);
    *r = (inductance_result){ .n = FREQUENCIES,
                              .frequency = frequencies,
                              .L_gradient = out->gradients,
                              .R_gradient = out->gradients + FREQUENCIES,
                              .perimeter_frequency = surface_frequency(s->c) };
    TRY(gradients_fill(&s->c->rails, out));
    r->n_perimeter = out->surface.n;
    r->perimeter = out->surface.place;
    r->perimeter_current = out->surface.current;
    r->perimeter_heat = out->surface.heating;
    out->summary.inductance = r;
    host_timing_add(&s->timing, "inductance", host_wall_clock() - since);
    return status_ok();
}

/* ---- check ---- */

/* A search's scenes at both resolutions with a grain of this size. */
static status grain_possible(const breech_case *c, const case_site *grain)
{
    gouge_scene scene;
    breech_case probe;
    site_state state = gouge_state_of_case(c);
    study_family_probe(c, &probe);
    state.velocity = c->study.velocity_low;
    state.grain = *grain;
    TRY(gouge_scene_bodies(&probe, &state, c->study.coarse_cells_per_radius, &scene));
    return gouge_scene_bodies(&probe, &state, c->study.fine_cells_per_radius, &scene);
}

static status grains_possible(const breech_case *c)
{
    for (int i = 0; i < c->sites.n; i++) TRY(grain_possible(c, &c->sites.item[i]));
    for (int i = 0; i < c->populations.n; i++) {
        const case_population *p = &c->populations.item[i];
        double size[SURFACE_MAX_SIZES], number[SURFACE_MAX_SIZES];
        const int n = study_population_sizes(p, c->study.smallest_radius, SURFACE_MAX_SIZES, size, number);
        for (int k = 0; k<n; k += n> 1 ? n - 1 : 1) { /* the smallest and the largest */
            case_site grain = { .radius = size[k], .height = p->aspect * size[k], .bond_strength = p->bond_strength };
            memcpy(grain.shape, p->shape, sizeof grain.shape);
            memcpy(grain.material, p->material, sizeof grain.material);
            TRY(grain_possible(c, &grain));
        }
    }
    return status_ok();
}

static status treatments_possible(const breech_case *c)
{
    for (int i = 0; i < c->treatments.n; i++) {
        breech_case treated;
        status s = case_treat(c, &c->treatments.item[i], &treated);
        const bool made = s.code == STATUS_OK; /* its error names the treatment already */
        if (made) s = grains_possible(&treated);
        case_treated_free(&treated);
        CHECK(s.code == STATUS_OK, s.code, "%s%s%s%.400s", made ? "treatment `" : "",
              made ? c->treatments.item[i].name : "", made ? "`: " : "", s.text);
    }
    return status_ok();
}

status study_command_possible(const breech_case *c, unsigned needs)
{
    gouge_scene scene;
    rail_section section;
    const shot_config circuit = gouge_shot_config(c, NULL);
    const site_state state = gouge_state_of_case(c);
    if ((needs & CASE_FOR_INDUCTANCE) ||
        ((needs & (CASE_FOR_SHOT | CASE_FOR_ONSET)) && c->rails.level != SHOT_RAILS_CONSTANT))
        TRY(circuit_rails_section(&c->rails, &section));
    if (needs & (CASE_FOR_SHOT | CASE_FOR_ONSET)) TRY(circuit_shot_check(&circuit));
    if (needs & CASE_FOR_SCENE) TRY(gouge_scene_bodies(c, &state, c->scene.cells_per_radius, &scene));
    if (needs & CASE_FOR_ONSET) TRY(grains_possible(c));
    return needs & CASE_FOR_COMPARE ? treatments_possible(c) : status_ok();
}

/* Two levels of thread: memory bandwidth and the serial rest are left out, so this is a lower bound on many threads. */
static status estimate(const breech_case *c, const site_state *state, double cells, int threads, scene_estimate *out)
{
    gouge_scene scene;
    TRY(gouge_scene_bodies(c, state, cells, &scene));
    TRY(mpm_estimate(&scene.scene, &out->needs));
    out->steps = gouge_last_time(&scene) / out->needs.dt;
    for (int i = 0; i < 2; i++) out->seconds[i] = out->steps * out->needs.work[i] * CHECK_SECONDS_A_STEP / threads;
    return status_ok();
}

status study_command_check(const breech_case *c, int threads, scene_estimate out[CHECK_MAX_ESTIMATES], int *n)
{
    *n = 0;
    if (c->given.projectile && !isnan(c->scene.velocity) && !isnan(c->particle.radius)) {
        const site_state state = gouge_state_of_case(c);
        snprintf(out[*n].what, sizeof out->what, "scene, %g m/s, %g cells a radius", state.velocity,
                 c->scene.cells_per_radius);
        TRY(estimate(c, &state, c->scene.cells_per_radius, threads, &out[(*n)++]));
    }
    if (!c->given.projectile || c->sites.n == 0) return status_ok();
    const double cells[] = { c->study.coarse_cells_per_radius, c->study.fine_cells_per_radius };
    breech_case probe;
    study_family_probe(c, &probe);
    for (int k = 0; k < (cells[0] < cells[1] ? 2 : 1); k++) {
        site_state state = gouge_state_of_case(c);
        state.grain = c->sites.item[0];
        state.velocity = c->study.velocity_low;
        snprintf(out[*n].what, sizeof out->what, "onset, %g m/s, %g cells a radius", state.velocity, cells[k]);
        TRY(estimate(&probe, &state, cells[k], threads, &out[(*n)++]));
    }
    return status_ok();
}
