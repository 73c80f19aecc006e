/* SPDX-License-Identifier: BSD-3-Clause */
/* Treatments and their comparison, on scenes that cost nothing. */
#include "base/constants.h"
#include "coupling/case/case.h"
#include "coupling/case/treatment.h"
#include "coupling/gouge/growth.h"
#include "coupling/host/outdir.h"
#include "coupling/study/compare.h"
#include "coupling/study/sampling/shifts.h"
#include "coupling/study/study.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "full_common.h"
#include "status_common.h"

static int scenes;
static double growth_most = INFINITY; /* it levels out [e-folds] */
static double growth_rises = 1.0;     /* with velocity; -1: it falls, whatever the class */
static double growth_dies = 1.0;      /* how much steeper it is below zero */
static double growth_jumps = 0.0; /* so far from the threshold it is three e-folds further off zero [m/s]; 0: never */
static double grid_noise = 0.0;   /* of the growth, by a cell's shift along x [e-folds] */

static double by_thickness = 0.0; /* of each layer [m/s/m] */
static double by_size = 0.0;      /* of the grain, by the logarithm of its radius, off the threshold [m/s] */
static double tear_drops = 0.0;   /* [m/s]; 0: shapes are not made up */
static double lengthens = 0.0;    /* a short crater, by so much of its width with each m/s; 0: not made up [s/m] */

/* Severity of a made-up scene: a line in velocity; a harder, colder or layered rail, a steeper lead face and a grid
 * that is shifted gouge later. */
static double made_up_threshold(const case_impact *of)
{
    double v = 1400.0 + 100.0 * (of->rail.yield_scale - 1.5) - 0.5 * (of->rail.temperature - 293.0);
    v += 80.0 * (of->armature.yield_scale - 1.0);
    v += 10.0 * (of->armature.lead_angle * 180.0 / PI - 30.0);
    v += 400.0 * of->scene.grid_shift[0];
    v -= by_size * log(of->particle.radius / 0.3e-3);
    for (int i = 0; i < of->rail.layers.n; i++) {
        const case_layer *layer = &of->rail.layers.item[i];
        v += 80.0 * layer->yield_scale + (strcmp(layer->material, "steel_4340") == 0 ? 200.0 : 0.0);
        v += by_thickness * layer->thickness;
    }
    return v;
}

static status fake_scene(const impact_job *job, const scene_host *host, impact *out)
{
    (void)host;
    memset(out, 0, sizeof *out);
    scenes++;
    const case_impact *of = &job->of;
    const double v = of->scene.velocity, r = of->particle.radius;
    const double excess = (v - made_up_threshold(of) - (of->scene.cells_per_radius < 2.5 ? 20.0 : 0.0)) / 150.0;
    scene_result *hit = &out->result;
    hit->severity = excess + of->scene.limit_severity;
    hit->groove_growth =
        growth_rises * fmin(excess < 0.0 ? growth_dies * excess : excess, growth_most) / gouge_growth_folds(1.0, r, v);
    const bool far = growth_jumps > 0.0 && fabs(150.0 * excess) > growth_jumps;
    hit->groove_growth +=
        ((far ? copysign(3.0, excess) : 0.0) + grid_noise * of->scene.grid_shift[0]) / gouge_growth_folds(1.0, r, v);
    /* a groove must have grown for a while before its crater is a gouge */
    hit->class = excess >= (case_impact_is_gauged(of) ? 0.0 : 0.4) ? DAMAGE_GOUGE : DAMAGE_SCRATCH;
    if (tear_drops > 0.0 && case_impact_is_gauged(of)) { /* tear-drops so far above the threshold, on every grid */
        const double from = made_up_threshold(of) - 400.0 * of->scene.grid_shift[0] + tear_drops;
        hit->length_over_width = 4.0 * exp((from - v) / 300.0);
        if (v < from) hit->class = DAMAGE_SCRATCH;
    }
    if (lengthens > 0.0 && case_impact_is_gauged(of)) hit->length_over_width = 1.0 + lengthens * (v - 500.0);
    hit->crater_class = case_impact_is_gauged(of) ? DAMAGE_UNDECIDED : hit->class;
    hit->crater_volume = 10.0 * r * r * r;
    hit->crater_depth = 0.2 * r;
    hit->crater_length = 6.0 * r;
    hit->crater_width = 2.0 * r;
    hit->bodies = of->rail.layers.n + 3;
    bool loose = false; /* its bond gave way, or that of a layer below */
    for (int i = 0; i < of->rail.layers.n; i++) {
        loose = loose || !isnan(of->rail.layers.item[i].bond_strength);
        hit->layers_failed_volume += 1e-3 * r * r * r;
        if (loose) hit->layers_carried_volume += 9.0 * r * r * r;
    }
    const bool hard = strcmp(of->particle.material, "steel_4340") == 0;
    out->impulse = hard ? 0.2 : 0.02;
    return status_ok();
}

static breech_case *read(const char *text, unsigned needs)
{
    const char *const dirs[] = { BREECH_TESTS "/../cases/materials" };
    const case_options how = { dirs, 1, needs };
    const case_text from = { text, strlen(text), "test/case.yaml", NULL, 0 };
    breech_case *c = NULL;
    char *errors = NULL;
    const status s = case_read_memory(&from, &how, &c, &errors);
    if (s.code != STATUS_OK) fail_msg("%s", errors ? errors : s.text);
    return c;
}

/* What a case file says wrong; the caller frees. */
static char *errors_of(const char *text, unsigned needs)
{
    const char *const dirs[] = { BREECH_TESTS "/../cases/materials" };
    const case_options how = { dirs, 1, needs };
    const case_text from = { text, strlen(text), "test/case.yaml", NULL, 0 };
    breech_case *c = NULL;
    char *errors = NULL;
    assert_int_equal(case_read_memory(&from, &how, &c, &errors).code, STATUS_BAD_INPUT);
    assert_non_null(errors);
    return errors;
}

#define HEAD                                                                                                           \
    "name: test\n"                                                                                                     \
    "bank: {count: 15, capacitance: 3.594 mF, charge: 10.55 kV, inductance: 12.56 uH, resistance: 4.1 mohm,\n"         \
    "  crowbar_drop: 1.48 V, crowbar_resistance: 0.43 mohm}\n"                                                         \
    "rail: {level: constant, height: 25 mm, thickness: 20 mm, separation: 25 mm, resistivity: 1.72e-8 ohm m,\n"        \
    "  inductance_gradient: 0.42 uH/m, resistance_gradient: 0.1 mohm/m, material: ofhc_copper, yield_scale: 1.5,\n"    \
    "  specific_heat: 385 J/kg/K, thermal_conductivity: 391 W/m/K}\n"                                                  \
    "barrel: {length: 3 m, start: 0.1 m}\n"                                                                            \
    "armature: {mass: 0.18 kg, contact_length: 16 mm, contact_width: 25 mm, preload: 5 kN, spreading: 3e-8 N/A^2, "    \
    "friction_dry: 0.3, friction_melted: 0.05,\n"                                                                      \
    "  material: al7075_t651, lead_angle: 30 deg, length: 20 mm, leg_thickness: 5 mm, head_thickness: 10 mm,\n"        \
    "  chamfer_height: 2 mm}\n"                                                                                        \
    "particle: {radius: 0.5 mm}\n"                                                                                     \
    "scene: {friction: 0.05, coarse_cell: 2 mm, growth: 1.3, contact_pressure: 75 MPa}\n"                              \
    "study: {coarse_cells_per_radius: 2, fine_cells_per_radius: 3, max_scenes: 40, sampled: 10000, resolution_above: " \
    "0,\n"                                                                                                             \
    "  sensitivities: no, feedback: no, scratch: no}\n"                                                                \
    "output: {snapshots: 0, report: no}\n"
#define GRAINS "populations:\n  - {density: 3 1/m, radius_median: 0.3 mm, radius_spread: 0.3}\n"

enum { ALL = CASE_FOR_ONSET | CASE_FOR_COMPARE };

/* ---- treatments ---- */

/* Each kind with values of its own; a kind without a line here fails the test. */
static const char *const example[TREATMENT_KINDS] = {
    [TREATMENT_coating] =
        "coating: [{material: steel_4340, thickness: 0.2 mm}, {material: ofhc_copper, thickness: 0.1 mm}]",
    [TREATMENT_hardening] = "hardening: {depth: 0.4 mm, factor: 2}",
    [TREATMENT_rail_metal] = "rail_metal: {material: steel_4340}",
    [TREATMENT_polish] = "polish: {size: 0.6, number: 0.5}",
    [TREATMENT_lead_angle] = "lead_angle: {angle: 45 deg}",
    [TREATMENT_preheat] = "preheat: {temperature: 400 K}",
    [TREATMENT_friction] = "friction: {factor: 0.5}",
    [TREATMENT_armature_metal] = "armature_metal: {material: steel_4340}",
};

static const char *example_of(int kind)
{
    if (!example[kind])
        fail_msg("treatment `%s` has no example in tests/test_compare.c", case_treatment_kinds[kind].name);
    return example[kind] ? example[kind] : "";
}

static char *used_text(const breech_case *c)
{
    char *text = NULL;
    size_t size = 0;
    FILE *f = open_memstream(&text, &size);
    assert_non_null(f);
    OK(case_write_used(c, f));
    fclose(f);
    return text;
}

/* All that a treatment may change, as text: what scenes are made of, and the grains. */
static char *onset_text(const case_onset *c)
{
    char *text = NULL;
    size_t size = 0;
    FILE *f = open_memstream(&text, &size);
    assert_non_null(f);
    OK(case_impact_write(&c->impact, f));
    for (int i = 0; i < c->sites.n; i++)
        fprintf(f, "%g %g %s\n", c->sites.item[i].radius, c->sites.item[i].height, c->sites.item[i].material);
    for (int i = 0; i < c->populations.n; i++)
        fprintf(f, "%g %g %s\n", c->populations.item[i].density, c->populations.item[i].radius_median,
                c->populations.item[i].material);
    fclose(f);
    return text;
}

static status possible(const breech_case *c)
{
    const case_inputs in = case_inputs_of(c);
    return study_possible(&in, ALL, NULL);
}

static void test_every_kind(void **state)
{
    (void)state;
    if (!heavy_tests()) skip();
    for (int k = 0; k < TREATMENT_KINDS; k++) {
        char text[4000];
        case_onset treated, same;
        assert_int_equal(strncmp(example_of(k), case_treatment_kinds[k].name, strlen(case_treatment_kinds[k].name)), 0);
        snprintf(text, sizeof text, HEAD GRAINS "sites: [{position: 1 m}]\ntreatments:\n  - name: tried\n    %s\n",
                 example_of(k));
        breech_case *c = read(text, ALL);
        const case_treatment *t = &c->treatments.item[0];
        for (int j = 0; j < TREATMENT_KINDS; j++) assert_int_equal(case_treatment_given(t, j), j == k);
        const case_onset given = case_inputs_of(c).onset;
        char *before = onset_text(&given), *used = used_text(c);
        OK(case_treat(&given, NULL, &same));
        OK(case_treat(&given, t, &treated));
        char *untouched = onset_text(&same), *after = onset_text(&treated);
        assert_string_equal(before, untouched);
        assert_string_not_equal(before, after);
        char *still = used_text(c); /* the case itself is left alone */
        assert_string_equal(used, still);
        breech_case *back = read(used, ALL); /* used.yaml says the same treatment */
        assert_true(case_treatment_given(&back->treatments.item[0], k));
        char *again = used_text(back);
        assert_string_equal(used, again);
        OK(possible(c)); /* its scenes can be made */
        case_free(back);
        free(before), free(used), free(untouched), free(after), free(still), free(again);
        case_treated_free(&treated);
        case_treated_free(&same);
        case_free(c);
    }
}

static void test_what_they_do(void **state)
{
    (void)state;
    char text[6000];
    int n = snprintf(text, sizeof text, HEAD GRAINS "sites: [{position: 1 m, material: steel_4340}]\ntreatments:\n");
    for (int k = 0; k < TREATMENT_KINDS; k++)
        n += snprintf(text + n, sizeof text - (size_t)n, "  - name: t%d\n    %s\n", k, example_of(k));
    breech_case *c = read(text, ALL);
    case_onset given = case_inputs_of(c).onset;
    case_onset treated;
    assert_true(isnan(given.impact.rail.cold_work)); /* the material's */
    given.impact.rail.cold_work = 0.2;
    OK(case_treat(&given, &c->treatments.item[TREATMENT_coating], &treated));
    assert_int_equal(treated.impact.rail.layers.n, 2);
    assert_string_equal(treated.impact.rail.layers.item[1].material, "ofhc_copper"); /* the last is on top */
    case_treated_free(&treated);
    OK(case_treat(&given, &c->treatments.item[TREATMENT_hardening], &treated));
    assert_int_equal(treated.impact.rail.layers.n, 1);
    assert_true(treated.impact.rail.layers.item[0].yield_scale == 3.0 &&
                isnan(treated.impact.rail.layers.item[0].bond_strength) &&
                treated.impact.rail.layers.item[0].cold_work == 0.2);
    case_treated_free(&treated);
    OK(case_treat(&given, &c->treatments.item[TREATMENT_rail_metal], &treated));
    assert_string_equal(treated.populations.item[0].material, "steel_4340"); /* was the rail's */
    assert_true(treated.impact.rail.yield_scale == 1.0 && isnan(treated.impact.rail.cold_work));
    case_treated_free(&treated);
    OK(case_treat(&given, &c->treatments.item[TREATMENT_polish], &treated));
    assert_true(fabs(treated.populations.item[0].radius_median - 0.18e-3) < 1e-12);
    assert_true(fabs(treated.populations.item[0].density - 1.5) < 1e-12);
    assert_true(fabs(treated.sites.item[0].radius - 0.3e-3) < 1e-12 &&
                fabs(treated.sites.item[0].height - 0.3e-3) < 1e-12);
    case_treated_free(&treated);
    OK(case_treat(&given, &c->treatments.item[TREATMENT_friction], &treated));
    assert_true(treated.launcher.armature.friction_dry == 0.15 && treated.launcher.armature.friction_melted == 0.025);
    assert_true(treated.impact.scene.friction == 0.025); /* half of all three */
    case_treated_free(&treated);
    given.launcher.armature.friction_law = CIRCUIT_SHOT_FRICTION_FILM; /* reads the melt's viscosity instead */
    OK(case_treat(&given, &c->treatments.item[TREATMENT_friction], &treated));
    assert_true(treated.launcher.armature.friction_dry == 0.15 && treated.launcher.armature.friction_melted == 0.05);
    assert_true(treated.launcher.armature.film_viscosity == 0.5 * given.launcher.armature.film_viscosity);
    case_treated_free(&treated);
    case_free(c);
}

/* A surface with several kinds: the hardened skin is of the rail's new metal, whatever the order in the file. */
static void test_new_metal_is_hardened(void **state)
{
    (void)state;
    case_onset treated;
    breech_case *c = read(HEAD GRAINS "treatments:\n  - name: both\n    hardening: {depth: 0.4 mm, factor: 2}\n"
                                      "    rail_metal: {material: steel_4340, yield_scale: 1.5}\n",
                          ALL);
    const case_onset given = case_inputs_of(c).onset;
    OK(case_treat(&given, &c->treatments.item[0], &treated));
    assert_int_equal(treated.impact.rail.layers.n, 1);
    assert_string_equal(treated.impact.rail.layers.item[0].material, "steel_4340");
    assert_true(treated.impact.rail.layers.item[0].yield_scale == 3.0);
    case_treated_free(&treated);
    case_free(c);
}

/* Grains of the armature's metal (debris) are of the new one, wherever the case has them; others stay. */
static void test_debris_of_a_new_armature(void **state)
{
    (void)state;
    case_onset treated;
    breech_case *c = read(
        HEAD "populations:\n  - {density: 3 1/m, radius_median: 0.3 mm, radius_spread: 0.3, material: al7075_t651}\n"
             "sites: [{position: 1 m, material: al7075_t651}, {position: 2 m}]\n"
             "treatments:\n  - {name: steel, armature_metal: {material: steel_4340}}\n",
        ALL);
    case_onset given = case_inputs_of(c).onset;
    assert_string_equal(given.impact.armature.material, "al7075_t651");
    snprintf(given.impact.particle.material, sizeof given.impact.particle.material, "al7075_t651");
    OK(case_treat(&given, &c->treatments.item[0], &treated));
    assert_string_equal(treated.populations.item[0].material, "steel_4340");
    assert_string_equal(treated.sites.item[0].material, "steel_4340");
    assert_string_equal(treated.sites.item[1].material, given.impact.rail.material);
    assert_string_equal(treated.impact.particle.material, "steel_4340");
    case_treated_free(&treated);
    case_free(c);
}

/* Each grain is exchanged once, by what it was: where the new rail is of the old armature's metal, too, and where rail,
 * armature and grain were of one metal, with the part that is exchanged. */
static void test_both_metals_are_new(void **state)
{
    (void)state;
    static const struct {
        const char *armature, *now, *rails, *debris; /* the armature's metal, a surface, and what its grains become */
    } cases[] = {
        { "al7075_t651", "rail_metal: {material: al7075_t651}, armature_metal: {material: steel_4340}", "al7075_t651",
          "steel_4340" },
        { "ofhc_copper", "rail_metal: {material: steel_4340}, armature_metal: {material: al7075_t651}", "steel_4340",
          "steel_4340" },
        { "ofhc_copper", "armature_metal: {material: steel_4340}", "steel_4340", "steel_4340" },
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        case_onset treated;
        char text[1500];
        snprintf(text, sizeof text,
                 HEAD "sites: [{position: 1 m, material: ofhc_copper}, {position: 2 m, material: %s}]\n"
                      "treatments:\n  - {name: both, %s}\n",
                 cases[i].armature, cases[i].now);
        breech_case *c = read(text, ALL);
        case_onset given = case_inputs_of(c).onset;
        snprintf(given.impact.rail.material, sizeof given.impact.rail.material, "ofhc_copper");
        snprintf(given.impact.armature.material, sizeof given.impact.armature.material, "%s", cases[i].armature);
        OK(case_treat(&given, &c->treatments.item[0], &treated));
        assert_string_equal(treated.sites.item[0].material, cases[i].rails);
        assert_string_equal(treated.sites.item[1].material, cases[i].debris);
        case_treated_free(&treated);
        case_free(c);
    }
}

static void test_refusals(void **state)
{
    (void)state;
    static const struct {
        const char *text, *says;
    } wrong[] = {
        { GRAINS, "treatments` is missing" },
        { GRAINS "treatments: [{name: a, polish: {size: 2}}]\n", "treatments[0].polish.size = 2" },
        { GRAINS "treatments: [{name: a, hardening: {depth: 1 mm}}]\n", "treatments[0].hardening.factor is missing" },
        { GRAINS "treatments: [{name: a, coting: {depth: 1 mm}}]\n", "did you mean `coating`" },
        { GRAINS "treatments: [{name: a, coating: [{material: unobtainium, thickness: 1 mm}]}]\n", "unobtainium" },
        { GRAINS "treatments: [{name: a, rail_metal: {material: cucrzr}}]\n", "lacks" },
        { "treatments: [{name: a}]\n", "needs it, or `populations`" },
        { "populations: [{preset: dust}]\ntreatments: [{name: a}]\n", "must be one of none, machining, debris, sand" },
        { "populations: [{density: 1 1/m}]\ntreatments: [{name: a}]\n", "radius_median is missing" },
        { "populations: [{preset: dust}, {density: 1, radius_median: 1 mm}]\ntreatments: [{name: a}]\n",
          "[1].radius_spread is missing" },
        { "populations: [{preset: sand, from: 2 m, to: 1 m}]\ntreatments: [{name: a}]\n", "must lie before" },
        { "populations: [{preset: sand, to: 5 m}]\ntreatments: [{name: a}]\n", "barrel.length = 3 m" },
        { "populations: [{preset: sand, sizes: [{radius: 2 mm, share: 1}, {radius: 1 mm, share: 1}]}]\ntreatments: "
          "[{name: a}]\n",
          "sizes must rise" },
    };
    for (size_t k = 0; k < sizeof wrong / sizeof wrong[0]; k++) {
        char text[4000];
        snprintf(text, sizeof text, HEAD "%s", wrong[k].text);
        char *errors = errors_of(text, ALL);
        if (!strstr(errors, wrong[k].says)) fail_msg("`%s` is not in:\n%s", wrong[k].says, errors);
        /* what is given, but could not be read, is not missing too */
        if (strstr(errors, "density is missing")) fail_msg("told twice:\n%s", errors);
        free(errors);
    }
}

/* What is set on the command line: no armature metal is there to keep, and no wear rate is a metre's. */
static void test_refused_sets(void **state)
{
    (void)state;
    static const char *const set[] = { "study.deposit_kept=0.5",
                                       "rail.layers=[{material: ofhc_copper, thickness: 1 mm, wear_rate: 1 m2/N}]" };
    static const char *const told[] = { "study.deposit_kept = 0.5: the armature leaves no metal",
                                        "wear_rate = 1 m2/N" };
    for (int k = 0; k < 2; k++) {
        const char *const dirs[] = { BREECH_TESTS "/../cases/materials" };
        const case_options how = { dirs, 1, CASE_FOR_ONSET };
        const case_text from = { HEAD GRAINS, strlen(HEAD GRAINS), "test/case.yaml", &set[k], 1 };
        breech_case *none = NULL;
        char *errors = NULL;
        assert_int_equal(case_read_memory(&from, &how, &none, &errors).code, STATUS_BAD_INPUT);
        if (!errors || !strstr(errors, told[k])) fail_msg("`%s` is not in:\n%s", told[k], errors ? errors : "nothing");
        free(errors);
    }
}

/* Cases that read well and cannot be compared. */
static void test_impossible(void **state)
{
    (void)state;
    breech_case *c = read(HEAD GRAINS "treatments: [{name: flat, lead_angle: {angle: 2 deg}}]\n", ALL);
    const status s = possible(c);
    assert_int_equal(s.code, STATUS_BAD_INPUT);
    assert_non_null(strstr(s.text, "treatment `flat`"));
    case_free(c);
    /* a film without viscosity; no friction at all may be had by the other law */
    c = read(HEAD GRAINS "treatments: [{name: smooth, friction: {factor: 0}}]\n", ALL);
    OK(possible(c));
    case_inputs film = case_inputs_of(c);
    film.onset.launcher.armature.friction_law = CIRCUIT_SHOT_FRICTION_FILM;
    film.onset.launcher.armature.wear_fraction = 0.03;
    const status none = study_possible(&film, ALL, NULL);
    assert_int_equal(none.code, STATUS_BAD_INPUT);
    assert_non_null(strstr(none.text, "treatment `smooth`: armature.film_viscosity = 0 Pa s"));
    case_free(c);
    /* more tabulated sizes than are searched for; the smallest of these are too small to count */
    for (int n = 27; n < 29; n++) {
        char text[4000] = HEAD "populations:\n  - {density: 3 1/m, sizes: [{radius: 97 um, share: 1}";
        for (int k = 1; k < n; k++)
            snprintf(text + strlen(text), sizeof text - strlen(text), ", {radius: %d um, share: 1}", 97 + k);
        strcat(text, "]}\ntreatments: [{name: a, polish: {size: 0.999}}]\n");
        c = read(text, ALL);
        const status many = possible(c);
        assert_int_equal(many.code, n == 27 ? STATUS_OK : STATUS_BAD_INPUT);
        if (n > 27) assert_non_null(strstr(many.text, "populations[0].sizes: 25 of a share"));
        case_free(c);
    }
    /* a layer of its own field needs a cell; welded it is a film */
    for (int welded = 0; welded < 2; welded++) {
        char text[4000];
        snprintf(text, sizeof text,
                 HEAD GRAINS "treatments: [{name: thin, coating: [{material: steel_4340, thickness: 20 um%s}]}]\n",
                 welded ? "" : ", bond_strength: 100 MPa");
        c = read(text, ALL);
        const status thin = possible(c);
        assert_int_equal(thin.code, welded ? STATUS_OK : STATUS_BAD_INPUT);
        if (!welded) assert_non_null(strstr(thin.text, "at least one cell across"));
        case_free(c);
    }
}

/* Every preset fills what is not given and makes scenes; what is given stays. */
#define TREATED "treatments: [{name: a, polish: {size: 0.5}}]\n"

static void test_presets(void **state)
{
    (void)state;
    static const char *const names[] = {
#define POPULATION(name, ...) #name,
#include "coupling/case/population.def"
#undef POPULATION
    };
    static const char page[] = BREECH_TESTS "/../docs/theory/onset.md";
    char *table = NULL, row[200];
    OK(host_file_read(page, &table, NULL));
    for (size_t k = 0; k < sizeof names / sizeof *names; k++) {
        char text[4000];
        snprintf(text, sizeof text, HEAD "populations: [{preset: %s, from: 1 m}]\n" TREATED, names[k]);
        breech_case *c = read(text, ALL);
        const case_population *p = &c->populations.item[0];
        assert_true(p->density > 0.0 && p->radius_median > 0.0 && p->radius_spread > 0.0 && p->aspect > 0.0);
        assert_true(p->from == 1.0 && p->to == 3.0);
        assert_non_null(case_material(&c->materials, p->material));
        OK(possible(c));
        snprintf(row, sizeof row, "\n| `%s` | %g, %g mm, %g |", names[k], p->density, 1e3 * p->radius_median,
                 p->radius_spread);
        if (!strstr(table, row)) fail_msg("%s lacks a line that begins%s", page, row);
        case_free(c);
    }
    free(table);
    breech_case *c = read(HEAD "populations: [{preset: debris, density: 7 1/m, bond_strength: none}]\n" TREATED, ALL);
    assert_true(c->populations.item[0].density == 7.0 && isnan(c->populations.item[0].bond_strength));
    assert_string_equal(c->populations.item[0].material, "al7075_t651");
    case_free(c);
}

/* ---- the comparison ---- */

static const char FIVE[] = HEAD GRAINS "treatments:\n"
                                       "  - {name: hardened, hardening: {depth: 0.4 mm, factor: 2}}\n"
                                       "  - {name: coated, coating: [{material: steel_4340, thickness: 0.4 mm}]}\n"
                                       "  - {name: warm, preheat: {temperature: 500 K}}\n"
                                       "  - {name: polished, polish: {size: 0.7}}\n"
                                       "  - {name: the same}\n";

static FILE *progress_lines; /* NULL: nobody reads them */

/* A session in a directory of its own, over what is there, whose scenes are made up. */
static void open_anew(const case_inputs *in, const char *dir, session *s)
{
    const session_options options = { .command = "onset",
                                      .dir = dir,
                                      .store = "",
                                      .how = { .force = true },
                                      .threads = 1,
                                      .progress_to = progress_lines ? progress_lines : stderr,
                                      .quiet = !progress_lines };
    OK(run_session_open(in, &options, s));
    s->run_scene = fake_scene;
}

static char warned[4000]; /* by the last study */

static status run_compare(breech_case *c, const char *dir, compare_answer *out)
{
    session s;
    const case_inputs in = case_inputs_of(c);
    open_anew(&in, dir, &s);
    scenes = 0;
    const status done = study_compare_run(&s, &in.onset, &in.treatments, in.given.life ? &in.life : NULL, out);
    snprintf(warned, sizeof warned, "%s", s.warnings ? s.warnings : "");
    OK(run_session_close(&s, done.code == STATUS_OK));
    return done;
}

static const compare_entry *entry_of(const compare_answer *a, const char *surface)
{
    for (int i = 0; i < a->result.n; i++)
        if (strcmp(a->result.ranking[i].surface, surface) == 0) return &a->result.ranking[i];
    fail_msg("no surface `%s`", surface);
    return NULL;
}

static int rank_of(const compare_answer *a, const char *surface)
{
    return (int)(entry_of(a, surface) - a->result.ranking);
}

/* Who waits reads the bracket of the search under way, each surface's own. */
static void test_progress(void **state)
{
    (void)state;
    breech_case *c = read(HEAD GRAINS "treatments:\n  - {name: hard, hardening: {depth: 0.4 mm, factor: 2}}\n", ALL);
    compare_answer a;
    char line[400], name[100];
    int brackets = 0;
    progress_lines = tmpfile();
    OK(run_compare(c, "progress", &a));
    rewind(progress_lines);
    while (fgets(line, sizeof line, progress_lines)) {
        double low, high, v = NAN;
        const char *said = strstr(line, "; gouges begin in ");
        assert_null(strstr(line, "nan"));
        if (!said) continue;
        assert_int_equal(sscanf(said, "; gouges begin in %lf .. %lf m/s", &low, &high), 2);
        assert_true(low < high && sscanf(line, "%99s", name) == 1 && sscanf(strstr(name, "-v"), "-v%lf", &v) == 1);
        assert_true(v <= low + 0.5 || v >= high - 0.5); /* what was computed lies at an end, or beyond */
        brackets++;
    }
    fclose(progress_lines);
    progress_lines = NULL;
    assert_true(brackets >= 4);
    study_compare_answer_free(&a);
    case_free(c);
}

/* A skin a hundred times as hard as the rail: under grains lower than it is deep the screen skips everything, and no
 * scene shows that it helps.  As a film of a micrometre it has scenes. */
static void test_screened_surface(void **state)
{
    (void)state;
    static const char *const skins[] = { "1 mm", "1 um" };
    for (int k = 0; k < 2; k++) {
        char text[4000];
        snprintf(text, sizeof text, HEAD GRAINS "treatments:\n  - {name: skin, hardening: {depth: %s, factor: 60}}\n",
                 skins[k]);
        breech_case *c = read(text, ALL);
        compare_answer a;
        OK(run_compare(c, "screened", &a));
        const compare_entry *skin = entry_of(&a, "skin");
        assert_true((skin->scenes == 0) == (k == 0));
        if (k == 0) {
            assert_true(rank_of(&a, "skin") == 0 && isnan(skin->gouges) && isnan(skin->better_than_next));
            assert_true(isnan(a.result.ranking[1].worse_than_best) && isfinite(a.result.ranking[1].gouges));
            assert_non_null(strstr(a.result.verdict, "with grains that no scene was run for, fewest gouges: skin"));
            assert_true(!skin->significant && a.result.ranking[1].tied == 1); /* by the screen's word alone */
            assert_true(skin->probability_gouge > 0.0099 && skin->probability_gouge <= 0.01); /* times a grain's */
        }
        study_compare_answer_free(&a);
        case_free(c);
    }
    /* eight times as hard, which the screen skips but does not call quiet: last, whatever the others do */
    breech_case *c = read(HEAD GRAINS "treatments:\n  - {name: skin, hardening: {depth: 1 mm, factor: 8}}\n", ALL);
    c->study.screen_low = 8.0;
    compare_answer a;
    OK(run_compare(c, "screened", &a));
    const compare_entry *skin = entry_of(&a, "skin");
    assert_true(skin->scenes == 0 && skin->probability_gouge >= 0.05 && isnan(skin->gouges));
    assert_int_equal(rank_of(&a, "skin"), 1);
    assert_true(entry_of(&a, "untreated")->gouges > 0.0);
    study_compare_answer_free(&a);
    case_free(c);
}

/* Polished so far that no grain is large enough for a scene: none is drawn that gouges, which is no proof. */
static void test_polished_to_nothing(void **state)
{
    (void)state;
    breech_case *c = read(HEAD "populations: [{density: 3 1/m, radius_median: 0.5 mm, radius_spread: 0}]\n"
                               "treatments: [{name: polished, polish: {size: 0.15}}]\n",
                          ALL);
    compare_answer a;
    OK(run_compare(c, "polished", &a));
    const compare_entry *best = &a.result.ranking[0];
    assert_string_equal(best->surface, "polished");
    assert_true(best->scenes == 0 && isnan(best->gouges) && isnan(best->better_than_next));
    assert_true(isnan(best->probability_gouge));
    assert_true(!best->significant && a.result.ranking[1].tied == 1);
    assert_non_null(strstr(warned, "taken not to gouge, which nothing shows"));
    study_compare_answer_free(&a);
    case_free(c);
}

/* Two surfaces on which every grain gouges: one that does so from the lowest velocity of the search on is the worse. */
static void test_gouges_from_the_lowest(void **state)
{
    (void)state;
    breech_case *c = read(HEAD "sites: [{position: 2.5 m}]\n"
                               "treatments: [{name: warm, preheat: {temperature: 1100 K}}]\n",
                          ALL);
    c->study.velocity_low = 1200.0;
    compare_answer a;
    OK(run_compare(c, "lowest", &a));
    const compare_entry *warm = entry_of(&a, "warm");
    assert_true(isnan(warm->threshold_velocity) && isnan(warm->threshold_interval[0]));
    assert_true(warm->gouges == 1.0 && entry_of(&a, "untreated")->gouges == 1.0);
    assert_int_equal(rank_of(&a, "warm"), 1);
    assert_int_equal(warm->tied, 1);
    study_compare_answer_free(&a);
    case_free(c);
}

static void test_ranking(void **state)
{
    (void)state;
    breech_case *c = read(FIVE, ALL);
    compare_answer a;
    OK(run_compare(c, "compare", &a));
    assert_int_equal(a.result.n, 6);
    assert_int_equal(a.result.scenes_run, scenes);
    int own = 0; /* every scene is one surface's */
    for (int i = 0; i < a.result.n; i++) own += a.result.ranking[i].scenes;
    assert_int_equal(own, scenes);
    print_message("%d scenes for six surfaces\n", scenes);
    /* coated 1400 + 80 + 200, hardened 1400 + 240, warm 1400 - 103 */
    assert_int_equal(rank_of(&a, "coated"), 0);
    assert_int_equal(rank_of(&a, "hardened"), 1);
    assert_int_equal(rank_of(&a, "warm"), 5);
    assert_true(fabs(entry_of(&a, "coated")->threshold_velocity - 1680.0) < 25.0);
    assert_true(fabs(entry_of(&a, "hardened")->threshold_velocity - 1640.0) < 25.0);
    const compare_entry *plain = entry_of(&a, "untreated"), *same = entry_of(&a, "the same"),
                        *polished = entry_of(&a, "polished");
    assert_true(polished->gouges < plain->gouges && polished->gouged_volume < plain->gouged_volume);
    /* no treatment: the same scenes, none computed twice, and no difference to tell */
    assert_int_equal(same->scenes, 0);
    assert_int_equal(same->tied, plain->tied);
    assert_true(same->threshold_velocity == plain->threshold_velocity);
    double last = 0.0;
    for (int i = 0; i < 6; i++) {
        const compare_entry *e = &a.result.ranking[i];
        assert_true(e->gouges >= last);
        last = e->gouges;
        assert_true(e->gouges_interval[0] <= e->gouges && e->gouges <= e->gouges_interval[1]);
        assert_true(e->threshold_interval[0] <= e->threshold_velocity &&
                    e->threshold_velocity <= e->threshold_interval[1]);
        if (i < 5) assert_true(e->better_than_next >= 0.0 && e->significant == (e->better_than_next >= 0.95));
        /* tied with the best of a group: told neither from it, nor alike to the best of a group before */
        assert_true(a.result.ranking[e->tied - 1].tied == e->tied && e->tied <= i + 1);
        assert_true(isnan(e->worse_than_best) == (i == 0));
        if (i > 0) assert_int_equal(e->tied == 1, e->worse_than_best < 0.95);
    }
    assert_true(a.result.ranking[1].worse_than_best == a.result.ranking[0].better_than_next);
    assert_string_equal(plain->layer, "none");
    assert_string_equal(entry_of(&a, "coated")->layer, "intact"); /* craters of 0.06 mm */
    assert_true(entry_of(&a, "coated")->layer_failed > 0.0);
    study_compare_answer_free(&a);
    case_free(c);
}

/* Life beside grains: the ranking by gouges is what it is without, and every surface has its life.  A rail that is
 * flown warm lasts longer; a hardened skin as long as none, and shares its rank by life.  Of a metal with a limit of
 * fatigue they all last for good. */
static void test_life_beside_grains(void **state)
{
    (void)state;
    static const char text[] = HEAD GRAINS "treatments:\n  - {name: hardened, hardening: {depth: 0.4 mm, factor: 2}}\n"
                                           "  - {name: warm, preheat: {temperature: 400 K}}\n%s";
#define LIFE(limit)                                                                                \
    "materials:\n  - {name: tired, density: 8960 kg/m3, youngs_modulus: 124 GPa, poisson: 0.34, "  \
    "melting_temperature: 1356 K,\n     expansion: 17e-6 1/K, fatigue_A: 9.14, fatigue_m: 2.237, " \
    "fatigue_A_spread: 1.1" limit "}\nlife: {load: armature, material: tired, places: 3}\n"
    static const char *const life[] = { "", LIFE(""), LIFE(", fatigue_limit: 0.1") };
    compare_answer of[3];
    for (int k = 0; k < 3; k++) {
        char whole[4000];
        snprintf(whole, sizeof whole, text, life[k]);
        breech_case *c = read(whole, k ? ALL | CASE_FOR_LIFE : ALL);
        OK(run_compare(c, "life", &of[k]));
        case_free(c);
    }
    for (int i = 0; i < 3; i++) {
        const compare_entry *without = &of[0].result.ranking[i], *with = &of[1].result.ranking[i];
        assert_string_equal(without->surface, with->surface);
        assert_true(without->gouges == with->gouges && without->threshold_velocity == with->threshold_velocity);
        assert_true(isnan(without->life) && without->life_rank == 0);
        assert_true(with->life > 0.0 && with->life_quantiles[0] < with->life && with->life < with->life_quantiles[2]);
        const compare_entry *endless = &of[2].result.ranking[i];
        /* faster than Rayleigh waves from somewhere on, where no life is known: nobody knows that it lasts */
        assert_true(!endless->lasts && isnan(endless->life) && endless->life_rank == 1 && !with->lasts);
    }
    const compare_entry *plain = entry_of(&of[1], "untreated"), *hard = entry_of(&of[1], "hardened"),
                        *warm = entry_of(&of[1], "warm");
    assert_true(warm->life > plain->life && warm->life_rank == 1);
    assert_true(hard->life == plain->life && hard->life_rank == 2 && plain->life_rank == 2);
    for (int k = 0; k < 3; k++) study_compare_answer_free(&of[k]);
}

/* What the closing lines say of the longest life. */
static void test_longest_life(void **state)
{
    (void)state;
    static const struct {
        compare_entry of[2];
        const char *says; /* NULL: no such line */
    } all[] = {
        { { { .surface = "a", .life = 1e4, .life_rank = 1 }, { .surface = "b", .life = 2e4, .life_rank = 1 } },
          "\nlongest life: b, a crack after 2e+04 shots; others cannot be told apart from it\n" },
        { { { .surface = "a", .life = 1e4, .life_rank = 2 }, { .surface = "b", .life = 2e4, .life_rank = 1 } },
          "\nlongest life: b, a crack after 2e+04 shots\n" },
        { { { .surface = "a", .life = NAN, .lasts = true, .life_rank = 1 },
            { .surface = "b", .life = 1e4, .life_rank = 2 } },
          "\nlongest life: a, which lasts for good\n" },
        { { { .surface = "a", .life = NAN, .lasts = true, .life_rank = 1 },
            { .surface = "b", .life = NAN, .lasts = true, .life_rank = 1 } },
          "\nlongest life: a, which lasts for good; others cannot be told apart from it\n" },
        { { { .surface = "a", .life = NAN, .life_rank = 1 }, { .surface = "b", .life = NAN, .life_rank = 1 } }, NULL },
        { { { .surface = "a", .life = NAN }, { .surface = "b", .life = NAN } }, NULL },
    };
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
        const compare_result r = { .n = 2, .ranking = all[i].of, .verdict = "the verdict" };
        char *text = NULL;
        size_t size = 0;
        FILE *out = open_memstream(&text, &size);
        assert_non_null(out);
        study_compare_print(&r, out);
        fclose(out);
        if (all[i].says ? !strstr(text, all[i].says) : strstr(text, "longest life") != NULL) fail_msg("%s", text);
        free(text);
    }
}

/* Each surface is as good as its neighbour, within what is known; the last is worse than the best all the same. */
static void test_no_chain_of_ties(void **state)
{
    (void)state;
    breech_case *c = read(HEAD GRAINS "treatments:\n"
                                      "  - {name: 31 deg, lead_angle: {angle: 31 deg}}\n"
                                      "  - {name: 32 deg, lead_angle: {angle: 32 deg}}\n"
                                      "  - {name: 33 deg, lead_angle: {angle: 33 deg}}\n"
                                      "  - {name: 34 deg, lead_angle: {angle: 34 deg}}\n"
                                      "  - {name: 35 deg, lead_angle: {angle: 35 deg}}\n",
                          ALL);
    compare_answer a;
    c->study.sampled = 100000; /* a hundred a world, whose chance then hardly counts */
    OK(run_compare(c, "chain", &a));
    const compare_entry *e = a.result.ranking;
    for (int i = 0; i < 5; i++) assert_true(!e[i].significant);
    assert_true(e[1].tied == 1 && e[5].tied > 1 && e[5].worse_than_best >= 0.95);
    assert_null(strstr(a.result.verdict, e[5].surface));
    study_compare_answer_free(&a);
    case_free(c);
}

/* Warnings of a comparison name the surface, not the prefix of its scenes. */
static void test_warnings_name_the_surface(void **state)
{
    (void)state;
    breech_case *c = read(HEAD GRAINS "treatments:\n"
                                      "  - {name: warm, preheat: {temperature: 350 K}}\n"
                                      "  - {name: thin coat, coating: [{material: steel_4340, thickness: 0.02 mm}]}\n",
                          ALL);
    compare_answer a;
    c->study.velocity_low = 500.0; /* so that every surface's search ends without a gouge */
    c->study.velocity_high = 900.0;
    OK(run_compare(c, "named", &a));
    assert_non_null(strstr(warned, "\nthin coat: rail.layers[0]: 20 um of steel_4340 has"));
    assert_non_null(strstr(warned, "\nwarm: the armature reaches"));
    assert_non_null(strstr(warned, "untreated: the armature reaches"));
    assert_null(strstr(warned, "t1-"));
    assert_null(strstr(warned, "t2-"));
    study_compare_answer_free(&a);
    case_free(c);
}

/* A layer whose bond gives way is told from one that stays; a crater deeper than a layer dents it, and has worn it
 * through where a tenth of the layer goes too. */
static void test_what_layers_suffer(void **state)
{
    (void)state;
    breech_case *c = read(HEAD GRAINS "treatments:\n"
                                      "  - {name: thin, coating: [{material: steel_4340, thickness: 0.02 mm}]}\n"
                                      "  - {name: thin and loose, coating: [{material: steel_4340, thickness: 0.02 mm, "
                                      "bond_strength: 100 MPa}]}\n"
                                      "  - {name: loose, coating: [{material: steel_4340, thickness: 0.3 mm, "
                                      "bond_strength: 100 MPa}]}\n",
                          ALL);
    compare_answer a;
    OK(run_compare(c, "layers", &a));
    assert_string_equal(entry_of(&a, "thin")->layer, "dented");
    assert_string_equal(entry_of(&a, "thin and loose")->layer, "worn through");
    assert_string_equal(entry_of(&a, "loose")->layer, "sheared off");
    study_compare_answer_free(&a);
    c->study.fine_cells_per_radius =
        c->study.coarse_cells_per_radius; /* whole scenes have the search's resolution too */
    OK(run_compare(c, "one", &a));
    const compare_entry *loose = entry_of(&a, "loose");
    assert_true(loose->layer_velocity > 0.0 && loose->layer_velocity < loose->threshold_velocity);
    study_compare_answer_free(&a);
    case_free(c);
}

/* Another seed draws other grains: the order and what is significant stay. */
static void test_seed(void **state)
{
    (void)state;
    breech_case *c = read(FIVE, ALL);
    compare_answer a, b;
    OK(run_compare(c, "seed", &a));
    c->study.seed = 99;
    OK(run_compare(c, "seed", &b));
    for (int i = 0; i < 6; i++) {
        const compare_entry *x = &a.result.ranking[i], *y = entry_of(&b, x->surface);
        assert_true(x->gouges == 0.0 || fabs(y->gouges / x->gouges - 1.0) < 0.1);
        if (x->significant && y->significant)
            assert_true(rank_of(&b, a.result.ranking[i + 1].surface) > rank_of(&b, x->surface));
    }
    assert_int_equal(rank_of(&b, "coated"), rank_of(&a, "coated"));
    assert_int_equal(rank_of(&b, "warm"), rank_of(&a, "warm"));
    study_compare_answer_free(&a);
    study_compare_answer_free(&b);
    case_free(c);
}

/* ---- one surface, with a population ---- */

/* What the gouges of these populations take off the muzzle velocity of an armature that begins with v [m/s]. */
static double taken_off(const char *populations, double v)
{
    char text[4000];
    snprintf(text, sizeof text, HEAD "%s", populations);
    breech_case *c = read(text, CASE_FOR_ONSET);
    c->study.feedback = true;
    c->armature.velocity = v;
    onset_answer a;
    session s;
    const case_inputs in = case_inputs_of(c);
    open_anew(&in, "populations", &s);
    OK(study_onset_run(&s, &in.onset, &a));
    OK(run_session_close(&s, true));
    const double off = a.shot.is.muzzle_velocity - a.result.muzzle_velocity_feedback;
    study_onset_answer_free(&a);
    case_free(c);
    return off;
}

/* Each population takes by its own gouges, whichever stands first: copper grains a tenth of what steel ones take.  The
 * draws differ, 10000 histories of some gouges each, so by a few per cent. */
static void test_feedback_of_populations(void **state)
{
    (void)state;
#define SOFT "  - {density: 3 1/m, radius_median: 0.3 mm, radius_spread: 0.1}\n"
#define HARD "  - {density: 3 1/m, radius_median: 0.3 mm, radius_spread: 0.1, material: steel_4340}\n"
    const double soft = taken_off("populations:\n" SOFT, 0.0), hard = taken_off("populations:\n" HARD, 0.0);
    const double both = taken_off("populations:\n" SOFT HARD, 0.0), other = taken_off("populations:\n" HARD SOFT, 0.0);
    print_message("off the muzzle velocity: soft %.3f, hard %.3f, both %.3f or %.3f m/s\n", soft, hard, both, other);
    assert_true(soft > 0.0 && fabs(hard / soft / 10.0 - 1.0) < 0.05);
    assert_true(fabs(both / (soft + hard) - 1.0) < 0.05 && fabs(other / (soft + hard) - 1.0) < 0.05);
    /* injected, it gouges from its start on, which lies beyond the middle of the barrel's first piece */
    assert_true(taken_off("populations:\n" SOFT, 2000.0) > soft);
}

static void test_population_onset(void **state)
{
    (void)state;
    breech_case *c = read(HEAD GRAINS "sites: [{position: 1 m}, {position: 2.9 m}]\n", CASE_FOR_ONSET);
    c->study.feedback = c->study.sensitivities = true;
    c->study.shots = 3;
    onset_answer a;
    session s;
    const case_inputs in = case_inputs_of(c);
    open_anew(&in, "population", &s);
    scenes = 0;
    OK(study_onset_run(&s, &in.onset, &a));
    const double expected = study_mc_expected(&a.grains, 3.0); /* looks into the session's scenes */
    OK(run_session_close(&s, true));
    const onset_result *r = &a.result;
    assert_true(r->threshold_interval[0] <= 1400.0 && 1400.0 <= r->threshold_interval[1]);
    assert_true(r->threshold_position_interval[0] <= r->threshold_position &&
                r->threshold_position <= r->threshold_position_interval[1]);
    assert_true(fabs(r->expected_gouges / expected - 1.0) < 0.05);
    int fast = 0;
    for (int i = 0; i < 2; i++) fast += a.site[i].velocity >= a.site[i].threshold_interval[1];
    assert_true(fast > 0 && r->gouges == fast);
    assert_true(r->probability_gouge == 1.0 && r->verdict == VERDICT_GOUGES);
    assert_true(r->onset_interval[0] < r->onset_position && r->onset_position < r->onset_interval[1]);
    assert_true(r->muzzle_velocity_feedback < a.shot.is.muzzle_velocity);
    assert_true(r->muzzle_velocity_feedback >
                a.shot.is.muzzle_velocity - 0.02 / 0.18 * (r->expected_gouges + 1.0) * 3.0);
    /* more charge: faster, earlier, more gouges; more mass and friction: less; larger grains: as many (flat threshold)
     */
    assert_int_equal(r->n_sensitivities, 4);
    const onset_sensitivity *charge = &r->sensitivities[0], *mass = &r->sensitivities[1];
    assert_true(charge->muzzle_velocity > a.shot.is.muzzle_velocity && charge->expected_gouges > r->expected_gouges);
    assert_true(charge->threshold_position < r->threshold_position);
    assert_true(mass->muzzle_velocity < a.shot.is.muzzle_velocity && mass->expected_gouges < r->expected_gouges);
    assert_true(mass->threshold_position > r->threshold_position);
    assert_true(r->sensitivities[2].expected_gouges <= r->expected_gouges);
    assert_string_equal(mass->input, "armature.mass");
    assert_string_equal(r->sensitivities[2].input, "armature.friction_dry, armature.friction_melted");
    /* skips: the second site, and what monotony gives */
    int skipped = 0;
    for (int k = 0; k < r->n_skips; k++) skipped += r->skip[k].scenes;
    assert_true(r->n_skips > 0 && skipped == r->scenes_skipped);
    assert_int_equal(r->scenes_run, scenes);
    assert_int_equal(r->n_shots, 3);
    assert_true(r->n_along > 0 && r->probability_along[r->n_along - 1] == 1.0);
    study_onset_answer_free(&a);
    case_free(c);
}

static onset_answer studied(breech_case *c, const char *dir, status want)
{
    static case_onset given; /* the answer borrows it */
    onset_answer a;
    session s;
    const case_inputs in = case_inputs_of(c);
    open_anew(&in, dir, &s);
    given = in.onset;
    const status done = study_onset_run(&s, &given, &a);
    assert_int_equal(done.code, want.code);
    if (want.code != STATUS_OK && !strstr(done.text, want.text)) fail_msg("%s", done.text);
    snprintf(warned, sizeof warned, "%s", s.warnings ? s.warnings : "");
    OK(run_session_close(&s, true));
    return a;
}

/* Where larger grains gouge earlier, the sensitivity to their size says the threshold of the larger one. */
static void test_larger_grains(void **state)
{
    (void)state;
    static const double MEDIAN = 0.3e-3;
    breech_case *c = read(HEAD GRAINS, CASE_FOR_ONSET);
    c->study.sensitivities = true;
    by_size = 400.0;
    onset_answer a = studied(c, "larger", status_ok());
    by_size = 0.0;
    const onset_result *r = &a.result;
    const onset_sensitivity *size = &r->sensitivities[3];
    assert_string_equal(size->input, "grain size");
    assert_true(r->threshold_velocity == study_surface_at(&a.grains.family[0].surface, MEDIAN).velocity);
    assert_true(size->threshold_velocity == study_surface_at(&a.grains.family[0].surface, 1.05 * MEDIAN).velocity);
    assert_true(r->threshold_velocity - size->threshold_velocity > 10.0); /* 400 m/s ln(1.05) = 19.5, where bands end */
    assert_true(size->threshold_position < r->threshold_position && size->expected_gouges > r->expected_gouges);
    study_onset_answer_free(&a);
    case_free(c);
}

static int scenes_begin(const onset_scene *scene, int n, const char *prefix)
{
    int found = 0;
    for (int i = 0; i < n; i++) found += strncmp(scene[i].name, prefix, strlen(prefix)) == 0;
    return found;
}

static int scenes_named(const onset_answer *a, const char *prefix)
{
    return scenes_begin(a->result.scene, a->result.n_scenes, prefix);
}

/* ---- inputs that are not well known ---- */

/* The made-up threshold rises by 150 m/s where the rail is twice as strong (yield_scale 3 for 1.5), by 80 where the
 * armature is; friction does nothing. */
static void test_uncertain_inputs(void **state)
{
    (void)state;
    static const double INPUTS = 170.0; /* both together [m/s] */
    breech_case *c = read(HEAD GRAINS, CASE_FOR_ONSET);
    c->study.velocity_low = 500.0;
    c->study.velocity_high = 3000.0;
    c->study.velocity_interval = 0.02;
    onset_answer a = studied(c, "certain", status_ok());
    const onset_result sure = a.result;
    study_onset_answer_free(&a);
    c->study.sensitivities = true;
    c->study.strength_error = 1.0; /* 150 m/s */
    c->study.armature_error = 1.0; /* 80 m/s */
    c->study.friction_error = 0.5;
    c->study.shots = 2; /* on the warm rail too */
    a = studied(c, "uncertain", status_ok());
    const onset_result *r = &a.result;
    assert_true(r->threshold_velocity == sure.threshold_velocity);
    const double resolution = 0.1 * sure.threshold_velocity, both = hypot(resolution, INPUTS);
    for (int e = 0; e < 2; e++)
        assert_true(fabs(fabs(r->threshold_interval[e] - sure.threshold_interval[e]) - (both - resolution)) < 6.0);
    assert_true(r->threshold_interval[0] < sure.threshold_interval[0] &&
                r->threshold_interval[1] > sure.threshold_interval[1]);
    assert_true(fabs(a.grains.family[0].surface.reference.allowance[1] - both) <
                6.0); /* the random shots draw from it */
    const threshold_result *warm = &a.rail.changed[MC_WARMTH].grains.family[0].surface.reference;
    assert_true(fabs(warm->allowance[1] - hypot(0.1 * warm->velocity, INPUTS)) < 6.0);
    const case_study *near = &a.uncertain.of[0].c->study;
    const double threshold = a.grains.family[0].surface.reference.velocity;
    assert_true(fabs(near->velocity_low / threshold - 0.6) < 1e-9);
    assert_true(fabs(near->velocity_high / threshold - 1.6) < 1e-9);
    assert_int_equal(r->n_sensitivities, 7);
    const onset_sensitivity *strength = &r->sensitivities[4], *armature = &r->sensitivities[5],
                            *friction = &r->sensitivities[6];
    assert_string_equal(strength->input, "rail.yield_scale");
    assert_true(fabs(strength->threshold_velocity - r->threshold_velocity - 150.0) < 12.0);
    assert_true(strength->threshold_position > r->threshold_position && strength->expected_gouges < r->expected_gouges);
    assert_true(fabs(armature->threshold_velocity - r->threshold_velocity - 80.0) < 12.0);
    assert_true(fabs(friction->threshold_velocity - r->threshold_velocity) < 12.0);
    assert_true(scenes_named(&a, "strength-") > 0 && scenes_named(&a, "friction-") > 0);
    for (int i = 0; i < r->n_scenes; i++) /* near the threshold, and no whole craters */
        if (strncmp(r->scene[i].name, "strength-", 9) == 0 || strncmp(r->scene[i].name, "friction-", 9) == 0)
            assert_true(r->scene[i].gauged && r->scene[i].velocity > 0.55 * r->threshold_velocity &&
                        r->scene[i].velocity < 1.65 * r->threshold_velocity);
    study_onset_answer_free(&a);
    case_free(c);
}

/* Grains that gouge in every scene of a search that the armature never comes up to: nobody knows whether they gouge in
 * the shot, so half of the draws do. */
static void test_slower_than_the_search(void **state)
{
    (void)state;
    breech_case *c = read(HEAD GRAINS "treatments: [{name: the same}]\n", ALL);
    c->study.velocity_low = 1600.0, c->study.velocity_high = 2400.0;
    c->armature.mass = 1.0;
    compare_answer a;
    OK(run_compare(c, "slower", &a));
    const compare_entry *plain = entry_of(&a, "untreated");
    print_message("%s; %.3g gouges\n", a.result.verdict, plain->gouges);
    assert_true(plain->probability_gouge > 0.3 && plain->probability_gouge < 0.7);
    assert_true(plain->gouges > 0.0 && plain->gouges_interval[0] == 0.0);
    assert_null(strstr(a.result.verdict, "none"));
    study_compare_answer_free(&a);
    onset_answer one = studied(c, "slower_one", status_ok());
    print_message("%s\n", one.result.reason);
    assert_int_equal(one.result.verdict, VERDICT_UNDECIDED);
    assert_null(strstr(one.result.reason, "no scene of the search decides"));
    study_onset_answer_free(&one);
    case_free(c);
}

/* A threshold that the raised input moves out of the study's range is found all the same; where the study's own lies
 * outside, the part is what is known of it, and where both do there is none. */
static void test_uncertain_inputs_beyond_the_range(void **state)
{
    (void)state;
    static const struct {
        double high, part[2]; /* bounds of what the strength's part may be [m/s] */
    } of[] = { { 1450.0, { 130.0, 170.0 } }, { 1350.0, { NAN, NAN } } };
    for (size_t i = 0; i < sizeof of / sizeof *of; i++) {
        breech_case *c = read(HEAD GRAINS, CASE_FOR_ONSET);
        c->study.velocity_low = 500.0, c->study.velocity_high = of[i].high, c->study.velocity_interval = 0.02;
        c->study.strength_error = 1.0; /* 150 m/s */
        onset_answer a = studied(c, "beyond_range", status_ok());
        const double moved = fabs(study_uncertain_moved(&a.uncertain, 0, &a.grains.family[0], JUDGE_OF_GOUGE));
        print_message("to %g m/s the strength moves the threshold by %g m/s\n", of[i].high, moved);
        if (isnan(of[i].part[0]))
            assert_true(isnan(moved));
        else
            assert_true(moved > of[i].part[0] && moved < of[i].part[1]);
        study_onset_answer_free(&a);
        case_free(c);
    }
}

/* Uncertain inputs widen the interval of every surface that is compared, by searches of its own.  A hardened skin is of
 * the rail's metal, and as uncertain: its 80 m/s for a yield_scale of 1 rise by 240 where 3 become 6. */
static void test_uncertain_surfaces(void **state)
{
    (void)state;
    breech_case *c = read(HEAD GRAINS "treatments:\n  - {name: hard, hardening: {depth: 0.4 mm, factor: 2}}\n", ALL);
    compare_answer sure, unsure;
    int named[2] = { 0, 0 };
    OK(run_compare(c, "sure", &sure));
    c->study.strength_error = 1.0; /* 150 m/s */
    OK(run_compare(c, "unsure", &unsure));
    for (int i = 0; i < 2; i++) {
        const char *surface = i ? "hard" : "untreated";
        const compare_entry *a = entry_of(&sure, surface), *b = entry_of(&unsure, surface);
        const double moved = i ? 390.0 : 150.0, resolution = 0.1 * a->threshold_velocity,
                     wider = hypot(resolution, moved) - resolution;
        assert_true(a->threshold_velocity == b->threshold_velocity);
        assert_true(fabs(a->threshold_interval[0] - b->threshold_interval[0] - wider) < 0.5 * wider);
        assert_true(fabs(b->threshold_interval[1] - a->threshold_interval[1] - wider) < 0.5 * wider);
        assert_true(b->n_parts == ONSET_PARTS && fabs(b->part[3].threshold_above - moved) < 0.1 * moved);
        assert_true(isnan(a->part[3].threshold_above));
    }
    for (int i = 0; i < unsure.result.n_scenes; i++) {
        named[0] += strncmp(unsure.result.scene[i].name, "strength-", 9) == 0;
        named[1] += strncmp(unsure.result.scene[i].name, "t1-strength-", 12) == 0;
    }
    assert_true(named[0] > 0 && named[1] > 0);
    study_compare_answer_free(&sure);
    study_compare_answer_free(&unsure);
    case_free(c);
}

/* By how much the made-up threshold of further grids lies above that of the case's own, in the mean and scattered. */
static shift_spread made_up_spread(int grids)
{
    const double none[3] = { 0.0 };
    double moved[8], shift[3];
    for (int i = 0; i < grids; i++) {
        study_shift_of(i, none, shift);
        moved[i] = 400.0 * shift[0];
    }
    return study_shift_spread(moved, grids);
}

/* Asked for, the scatter with the grid moves the threshold of every surface to the mean over the grids and widens its
 * interval, by scenes of its own; the ends of an interval are passed around the place of its threshold. */
static void test_scatter_of_surfaces(void **state)
{
    (void)state;
    breech_case *c = read(HEAD GRAINS "treatments:\n  - {name: hard, hardening: {depth: 0.4 mm, factor: 2}}\n", ALL);
    compare_answer one, many;
    int shifted[2] = { 0, 0 };
    c->study.sampled = 100000;
    OK(run_compare(c, "one-grid", &one));
    assert_true(one.result.ranking[1].tied == 2 && strstr(warned, "thresholds are of one grid each"));
    case_interval_part place = { "place of the grid", 0.4, 0.0, false };
    c->study.interval_parts = (case_interval_parts){ 1, &place };
    for (int k = 0; k < 3; k++) { /* an error of all alike leaves them apart, as a small one of each does */
        static const char *const names[] = { "stated", "stated-own", "stated-small" };
        compare_answer stated;
        place.own = k > 0;
        place.threshold = k == 2 ? 0.01 : 0.4;
        OK(run_compare(c, names[k], &stated));
        assert_int_equal(stated.result.ranking[1].tied, k == 1 ? 1 : 2);
        assert_int_equal(strstr(warned, "of one grid") == NULL, place.own);
        study_compare_answer_free(&stated);
    }
    c->study.interval_parts = (case_interval_parts){ 0, NULL };
    c->study.threshold_ensemble = 3;
    OK(run_compare(c, "grids", &many));
    assert_null(strstr(warned, "of one grid"));
    for (int i = 0; i < 2; i++) {
        const compare_entry *a = entry_of(&one, i ? "hard" : "untreated"),
                            *b = entry_of(&many, i ? "hard" : "untreated");
        const double *x = b->threshold_position_interval;
        const double more = made_up_spread(3).mean;
        assert_true(more > 50.0 && fabs(b->threshold_velocity - a->threshold_velocity - more) < 1e-6);
        assert_true(isnan(a->threshold_deviation) && b->threshold_deviation > 50.0);
        assert_true(b->threshold_interval[0] < a->threshold_interval[0] + more - 5.0);
        assert_true(b->threshold_interval[1] > a->threshold_interval[1] + more + 5.0);
        assert_true(x[0] < b->threshold_position);
        assert_true(isnan(x[1]) || x[1] > b->threshold_position);
    }
    for (int i = 0; i < many.result.n_scenes; i++) {
        const char *name = many.result.scene[i].name;
        if (strstr(name, "-growth-e")) shifted[strncmp(name, "t1-", 3) == 0]++;
    }
    assert_true(shifted[0] == 2 && shifted[1] == 2);
    study_compare_answer_free(&one);
    study_compare_answer_free(&many);
    case_free(c);
}

/* One sentence says which surface is best; none is called free of gouges while another of its rank gouges. */
static void test_verdict(void **state)
{
    (void)state;
    static const struct {
        double gouges[3], threshold[3];
        int tied[3];
        const char *says;
    } all[] = {
        { { 0, 0, 2 }, { NAN, NAN, 1500 }, { 1, 1, 1 }, "fewest gouges: a; none of the others can be told from it" },
        { { 0, 0, 0 }, { NAN, NAN, NAN }, { 1, 1, 1 }, "none of the 3 surfaces gouges in this shot" },
        { { 1, 2, 3 }, { 1700, 1600, 1500 }, { 1, 2, 2 }, "best is a" },
        { { 1, 2, 3 }, { 1700, 1600, 1500 }, { 1, 1, 3 }, "fewest gouges: a; b cannot be told from it" },
        { { 1, 2, 3 }, { 1700, 1600, 1500 }, { 1, 2, 1 }, "fewest gouges: a; c cannot be told from it" },
    };
    for (size_t k = 0; k < sizeof all / sizeof *all; k++) {
        compare_entry e[3] = { { .surface = "a" }, { .surface = "b" }, { .surface = "c" } };
        compare_result r = { .n = 3, .ranking = e };
        for (int i = 0; i < 3; i++) {
            e[i].gouges = all[k].gouges[i], e[i].threshold_velocity = all[k].threshold[i];
            e[i].tied = all[k].tied[i];
        }
        study_compare_conclude(&r);
        assert_string_equal(r.verdict, all[k].says);
    }
}

/* A close search of one resolution. */
static breech_case *close_search(const char *text)
{
    breech_case *c = read(text, CASE_FOR_ONSET);
    c->study.velocity_low = 500.0;
    c->study.velocity_high = 3000.0;
    c->study.velocity_interval = 0.02;
    c->study.coarse_cells_per_radius = c->study.fine_cells_per_radius;
    return c;
}

/* The made-up threshold moves by 400 m/s with a cell's shift along x; growth by an e-fold in 150 m/s. */
static void test_scatter(void **state)
{
    (void)state;
    enum { GRIDS = 5 };
    breech_case *c = close_search(HEAD GRAINS "sites: [{position: 2.9 m}]\n");
    growth_most = 3.0; /* far from the threshold, where the search of one resolution has been */
    onset_answer sure = studied(c, "still", status_ok());
    assert_true(isnan(sure.result.growth_deviation) && isnan(sure.result.threshold_deviation));
    c->study.threshold_ensemble = GRIDS;
    c->study.shots = 2; /* on the warm rail too */
    onset_answer a = studied(c, "shifted", status_ok());
    const double want = made_up_spread(GRIDS).deviation, more = made_up_spread(GRIDS).mean;
    const onset_result *r = &a.result;
    assert_true(want > 100.0);
    assert_true(fabs(r->threshold_velocity - sure.result.threshold_velocity - more) < 1e-6);
    assert_true(fabs(r->growth_deviation - want / 150.0) < 1e-9 && fabs(r->threshold_deviation - want) < 1e-6);
    const double resolution = 0.1 * sure.result.threshold_velocity, both = hypot(resolution, want);
    for (int e = 0; e < 2; e++)
        assert_true(fabs(r->threshold_interval[e] - sure.result.threshold_interval[e] - more -
                         (e ? 1 : -1) * (both - resolution)) < 6.0);
    const threshold_result *warm = &a.rail.changed[MC_WARMTH].grains.family[0].surface.reference;
    assert_true(fabs(warm->allowance[1] - hypot(0.1 * (warm->velocity - more), want)) < 6.0);
    int shifted = 0;
    for (int i = 0; i < r->n_scenes; i++) shifted += strstr(r->scene[i].name, "-growth-e") != NULL;
    assert_int_equal(shifted, GRIDS - 1);
    study_onset_answer_free(&a);
    growth_most = INFINITY;
    c->study.shots = 1;
    c->study.resolution_above = 0.5;
    a = studied(c, "above", status_ok());
    c->study.resolution_above = 0.0;
    const double own = sure.result.threshold_velocity, end = sure.result.threshold_interval[1] - 0.1 * own + more;
    assert_true(fabs(a.result.threshold_interval[1] - end - hypot(0.5 * own, want)) < 6.0);
    assert_true(fabs(a.result.threshold_interval[0] - sure.result.threshold_interval[0] - more + both - resolution) <
                6.0);
    study_onset_answer_free(&sure);
    study_onset_answer_free(&a);
    growth_rises = -1.0; /* no slope: no deviation, and the interval reaches to where a scene decides, here nowhere */
    a = studied(c, "falling", status_ok());
    char warned_falling[sizeof warned];
    memcpy(warned_falling, warned, sizeof warned);
    c->study.threshold_ensemble = 0;
    sure = studied(c, "falling-still", status_ok());
    growth_rises = 1.0;
    assert_true(fabs(a.result.growth_deviation - want / 150.0) < 1e-9 && isnan(a.result.threshold_deviation));
    const double v = a.result.threshold_velocity, reach = fmax(3000.0 - v, v - 500.0);
    for (int e = 0; e < 2; e++) {
        const double wider = fabs(a.result.threshold_interval[e] - sure.result.threshold_interval[e]);
        assert_true(a.result.threshold_interval[e] == 0.0 || fabs(wider - (hypot(0.1 * v, reach) - 0.1 * v)) < 6.0);
        assert_true(wider > 300.0);
    }
    assert_non_null(strstr(warned_falling, "the interval is wider by"));
    study_onset_answer_free(&sure);
    study_onset_answer_free(&a);
    /* level above the threshold, dead below: there a scene decides on any grid, so only the range above is open */
    growth_most = 0.3, growth_dies = 1000.0;
    c->study.velocity_interval = 0.1; /* no scene on the slope between the two */
    c->study.velocity_high = 1600.0;
    c->study.threshold_ensemble = GRIDS;
    a = studied(c, "level", status_ok());
    growth_most = INFINITY, growth_dies = 1.0;
    r = &a.result;
    assert_true(isnan(r->threshold_deviation) && r->growth_deviation > 0.3);
    const double wider = hypot(0.1 * r->threshold_velocity, 1600.0 - r->threshold_velocity);
    assert_true(fabs(1350.0 - r->threshold_interval[0] - wider) < 20.0); /* the bracket begins there */
    study_onset_answer_free(&a);
    case_free(c);
}

/* Where the search sees one side alone, its scenes on other grids say how far that is sure: the made-up threshold lies
 * above the case's own on every further grid, by 328 m/s at most. */
static void test_one_side_on_other_grids(void **state)
{
    (void)state;
    breech_case *c = close_search(HEAD "sites: [{position: 2.9 m}]\n");
    onset_answer own = studied(c, "side-own", status_ok());
    const double threshold = own.result.threshold_velocity;
    study_onset_answer_free(&own);
    c->study.velocity_low = threshold + 50.0, c->study.velocity_high = threshold + 1000.0;
    own = studied(c, "side-one", status_ok());
    assert_true(own.result.verdict == VERDICT_GOUGES && own.result.probability_gouge == 1.0);
    assert_true(isnan(own.result.threshold_velocity) && own.result.threshold_interval[1] < 1.2 * (threshold + 75.0));
    assert_true(isnan(own.result.threshold_interval[0]));
    assert_non_null(strstr(own.result.reason, "at or below"));
    const double near = own.result.threshold_interval[1];
    study_onset_answer_free(&own);
    c->study.threshold_ensemble = 3;
    c->study.shots = 2; /* on the warm rail the same end counts */
    onset_answer many = studied(c, "side-many", status_ok());
    c->study.shots = 1;
    const threshold_result *t = &many.grains.family[0].surface.reference;
    const double against = many.grains.family[0].scatter.against;
    assert_true(against > threshold + 50.0 && against < threshold + 330.0);
    assert_true(many.result.threshold_interval[1] > near + 100.0 && t->interval[1] > threshold + 330.0);
    assert_true(t->interval[1] > 1.1 * against + 1.0); /* 10 % beyond the last scene that all agree on */
    assert_true(fabs(t->allowance[1] / (t->interval[1] - t->allowance[1]) - 0.1) < 1e-9);
    const threshold_result *warm = &many.rail.changed[MC_WARMTH].grains.family[0].surface.reference;
    assert_true(warm->outcome == THRESHOLD_BELOW && warm->interval[1] == t->interval[1]);
    assert_non_null(strstr(many.result.reason, "but on a shifted one the scene at"));
    study_onset_answer_free(&many);
    /* below it the further grids leave no gouge either, and nothing changes */
    c->study.velocity_low = 500.0, c->study.velocity_high = threshold - 50.0;
    many = studied(c, "side-below", status_ok());
    assert_true(many.grains.family[0].scatter.against == 0.0);
    c->study.threshold_ensemble = 0;
    own = studied(c, "side-below-one", status_ok());
    assert_true(many.result.verdict == own.result.verdict);
    assert_true(many.result.threshold_interval[0] == own.result.threshold_interval[0]);
    assert_true(many.result.n_scenes == 3 * own.result.n_scenes);
    study_onset_answer_free(&own);
    study_onset_answer_free(&many);
    case_free(c);
}

/* An interval is its bracket and the root of the sum of squares of its other parts, and every part is listed. */
static void assert_parts(const onset_result *r, double own_grid, bool scattered, double strength)
{
    const onset_part *p = r->part;
    assert_true(r->n_parts >= ONSET_PARTS);
    assert_true(fabs(p[1].threshold_below - 0.1 * own_grid) < 1e-6);
    assert_true(scattered ? p[2].threshold_above == r->threshold_deviation : isnan(p[2].threshold_above));
    assert_string_equal(p[3].part, "rail.yield_scale");
    assert_true(strength > 0.0 ? fabs(p[3].threshold_below - strength) < 0.1 * strength : isnan(p[3].threshold_below));
    assert_true(isnan(p[4].threshold_below) && isnan(p[5].threshold_above));
    double squares[2] = { 0.0 };
    for (int i = 1; i < r->n_parts; i++) {
        if (isfinite(p[i].threshold_below)) squares[0] += p[i].threshold_below * p[i].threshold_below;
        if (isfinite(p[i].threshold_above)) squares[1] += p[i].threshold_above * p[i].threshold_above;
    }
    assert_true(fabs(r->threshold_velocity - p[0].threshold_below - sqrt(squares[0]) - r->threshold_interval[0]) <
                1e-6);
    assert_true(fabs(r->threshold_velocity + p[0].threshold_above + sqrt(squares[1]) - r->threshold_interval[1]) <
                1e-6);
}

static void test_parts_of_an_interval(void **state)
{
    (void)state;
    breech_case *c = close_search(HEAD "sites: [{position: 2.9 m}]\n");
    onset_answer bare = studied(c, "parts-bare", status_ok());
    c->study.threshold_ensemble = 3;
    c->study.strength_error = 1.0; /* 150 m/s */
    onset_answer full = studied(c, "parts-full", status_ok());
    const double own = bare.result.threshold_velocity;
    assert_parts(&bare.result, own, false, 0.0);
    assert_parts(&full.result, own, true, 150.0);
    assert_true(fabs(full.result.threshold_velocity - own - made_up_spread(3).mean) < 1e-6);
    study_onset_answer_free(&bare);
    study_onset_answer_free(&full);
    case_free(c);
}

/* What the case states widens the intervals of threshold and scratch, of the untreated rail and of a warm one, without
 * a scene, and is listed by its name. */
static void test_stated_parts(void **state)
{
    (void)state;
    breech_case *c = close_search(HEAD GRAINS "sites: [{position: 2.9 m}]\n");
    c->study.scratch = true;
    c->study.shots = 2; /* on the warm rail too */
    onset_answer bare = studied(c, "stated-none", status_ok());
    c->study.interval_parts = (case_interval_parts){ 2, calloc(2, sizeof(case_interval_part)) };
    assert_non_null(c->study.interval_parts.item);
    c->study.interval_parts.item[0] = (case_interval_part){ "rail's strength to 10 %", 0.07, 0.2, false };
    c->study.interval_parts.item[1] = (case_interval_part){ "its temper", 0.05, 0.0, true };
    onset_answer full = studied(c, "stated", status_ok());
    const onset_result *r = &full.result, *of = &bare.result;
    const double v = of->threshold_velocity, wide = v * sqrt(0.1 * 0.1 + 0.07 * 0.07 + 0.05 * 0.05);
    assert_int_equal(r->n_scenes, of->n_scenes);
    assert_true(r->threshold_velocity == v && r->scratch_velocity == of->scratch_velocity);
    for (int e = 0; e < 2; e++)
        assert_true(fabs(fabs(r->threshold_interval[e] - of->threshold_interval[e]) - (wide - 0.1 * v)) < 1e-6);
    assert_int_equal(r->n_parts, ONSET_PARTS + 2);
    assert_parts(r, v, false, 0.0);
    assert_string_equal(r->part[ONSET_PARTS].part, "rail's strength to 10 %");
    assert_true(fabs(r->part[ONSET_PARTS].threshold_below - 0.07 * v) < 1e-6);
    assert_true(fabs(r->part[ONSET_PARTS].scratch_above - 0.2 * r->scratch_velocity) < 1e-6);
    assert_true(fabs(r->part[ONSET_PARTS + 1].threshold_above - 0.05 * v) < 1e-6);
    const threshold_result *warm = &full.rail.changed[MC_WARMTH].grains.family[0].surface.reference;
    assert_true(fabs(warm->allowance[0] - warm->velocity * wide / v) < 1e-6); /* the random shots draw from it */
    assert_true(fabs(warm->own - 0.05 * warm->velocity) < 1e-6);
    study_onset_answer_free(&bare);
    study_onset_answer_free(&full);
    case_free(c);
}

/* Growth hardly rises with velocity near its zero, and scatters with the grid for another reason: that slope alone
 * would make 1700 m/s of it.  Scenes further off decide on any grid, so the threshold's deviation is no more than their
 * distance. */
static void test_scatter_of_a_small_slope(void **state)
{
    (void)state;
    breech_case *c = close_search(HEAD "sites: [{position: 2.9 m}]\n");
    c->study.velocity_low = 1000.0;
    growth_rises = 0.1, growth_jumps = 450.0, grid_noise = 4.0;
    onset_answer still = studied(c, "creeps-still", status_ok());
    c->study.threshold_ensemble = 5;
    onset_answer a = studied(c, "creeps", status_ok());
    growth_rises = 1.0, growth_jumps = 0.0, grid_noise = 0.0;
    const onset_result *r = &a.result;
    const double v = r->threshold_velocity, cells = 0.1 * v,
                 wider = r->threshold_interval[1] - still.result.threshold_interval[1],
                 reach = r->part[2].threshold_above;
    print_message("excess %.2f, slope alone %.0f, reach %.0f m/s\n", r->growth_deviation, r->growth_deviation * 1500.0,
                  reach);
    assert_true(r->growth_deviation * 1500.0 > 1500.0 && r->growth_deviation * 1500.0 < 2000.0);
    assert_true(isnan(r->threshold_deviation) && reach < 1200.0);
    assert_true(fabs(wider - (hypot(cells, reach) - cells)) < 6.0);
    study_onset_answer_free(&still);
    study_onset_answer_free(&a);
    case_free(c);
}

/* Grooves grow from a velocity on that moves with the grid, and are tear-drops from one on that does not, 100 m/s above
 * that of the case's own grid: on each grid the later of the two is where it gouges. */
static void test_scatter_of_two(void **state)
{
    (void)state;
    enum { GRIDS = 5 };
    breech_case *c = close_search(HEAD "sites: [{position: 2.9 m}]\n");
    c->study.threshold_ensemble = GRIDS;
    c->study.scratch = true;
    tear_drops = 100.0;
    onset_answer a = studied(c, "two", status_ok());
    tear_drops = 0.0;
    const double none[3] = { 0.0 };
    double grows[GRIDS], gouges[GRIDS], shift[3];
    int later = 0;
    for (int i = 0; i < GRIDS; i++) {
        study_shift_of(i, none, shift);
        grows[i] = 400.0 * shift[0];
        gouges[i] = fmax(grows[i], 100.0);
        later += grows[i] > 100.0;
    }
    assert_true(later > 0 && later < GRIDS);
    const onset_result *r = &a.result;
    print_message("gouge %.0f +- %.1f, scratch %.0f +- %.1f m/s\n", r->threshold_velocity, r->threshold_deviation,
                  r->scratch_velocity, r->scratch_deviation);
    const double apart = study_shift_spread(gouges, GRIDS).mean - study_shift_spread(grows, GRIDS).mean;
    assert_true(fabs(r->threshold_velocity - r->scratch_velocity - apart) < 1.0);
    assert_true(fabs(r->scratch_deviation - study_shift_spread(grows, GRIDS).deviation) < 1e-6);
    assert_true(fabs(r->threshold_deviation - study_shift_spread(gouges, GRIDS).deviation) < 1e-6);
    study_onset_answer_free(&a);
    case_free(c);
}

/* Grooves die twenty times as steeply as they grow.  A grid whose groove dies at the case's scratch velocity has a
 * scene at the gouge's too, where it grows: its zero lies between, on the line through both. */
static void test_scatter_of_dying(void **state)
{
    (void)state;
    enum { GRIDS = 3 };
    breech_case *c = close_search(HEAD "sites: [{position: 2.9 m}]\n");
    c->study.threshold_ensemble = GRIDS;
    c->study.scratch = true;
    tear_drops = 300.0;
    const double growth_dies_now = growth_dies = 20.0;
    onset_answer a = studied(c, "dying", status_ok());
    tear_drops = 0.0;
    growth_dies = 1.0;
    const onset_result *r = &a.result;
    const double none[3] = { 0.0 };
    double velocity[2] = { NAN, NAN }, zero[GRIDS], shift[3]; /* of the scenes on further grids: scratch, gouge */
    for (int i = 0; i < r->n_scenes; i++)
        if (strstr(r->scene[i].name, "-growth-e2")) {
            velocity[0] = fmin(r->scene[i].velocity, velocity[0]); /* NAN gives way */
            velocity[1] = fmax(r->scene[i].velocity, velocity[1]);
        }
    int died = 0;
    for (int i = 0; i < GRIDS; i++) {
        study_shift_of(i, none, shift);
        const double true_zero = 1400.0 + 400.0 * shift[0]; /* made_up_threshold */
        double g[2];
        for (int k = 0; k < 2; k++)
            g[k] = (velocity[k] - true_zero) * (velocity[k] < true_zero ? growth_dies_now : 1.0);
        died += g[0] < 0.0 && i > 0;
        zero[i] = g[0] * g[1] < 0.0 ? velocity[0] - g[0] * (velocity[1] - velocity[0]) / (g[1] - g[0]) : true_zero;
    }
    print_message("scratch %.0f +- %.1f m/s, by hand %.1f\n", r->scratch_velocity, r->scratch_deviation,
                  study_shift_spread(zero, GRIDS).deviation);
    assert_true(died > 0);
    /* a grid that grows at both scenes is placed by the search's slope, not a straight line's here */
    assert_true(fabs(r->scratch_deviation / study_shift_spread(zero, GRIDS).deviation - 1.0) < 0.06);
    assert_true(r->scratch_interval[0] > 0.0);
    study_onset_answer_free(&a);
    case_free(c);
}

/* Grooves die four times as steeply as they grow, and the search's slope knows only how they grow: a grid whose groove
 * dies at both scenes is placed the later, the further its scene lies below.  So by the grids the scratch's threshold
 * lies above the gouge's; but what gouges grows. */
static void test_scatter_keeps_order(void **state)
{
    (void)state;
    breech_case *c = close_search(HEAD "sites: [{position: 2.9 m}]\n");
    c->study.threshold_ensemble = 4;
    c->study.scratch = true;
    tear_drops = 120.0, growth_dies = 4.0;
    onset_answer a = studied(c, "order", status_ok());
    tear_drops = 0.0, growth_dies = 1.0;
    const onset_result *r = &a.result;
    const grain_family *f = &a.grains.family[0];
    print_message("gouge %.0f +- %.1f, scratch %.0f +- %.1f m/s\n", r->threshold_velocity, r->threshold_deviation,
                  r->scratch_velocity, r->scratch_deviation);
    const threshold_result *gouge = &f->surface.reference, *scratch = &f->scratches.reference;
    assert_true(scratch->velocity - scratch->more + f->scratch_scatter.more > gouge->velocity + 0.5);
    assert_true(scratch->velocity - scratch->more < gouge->velocity - gouge->more);
    assert_true(r->scratch_velocity == r->threshold_velocity);
    assert_true(f->scratch_scatter.threshold > f->scatter.threshold); /* its interval would end later */
    assert_true(fabs(r->scratch_interval[1] - r->threshold_interval[1]) < 1e-9);
    study_onset_answer_free(&a);
    case_free(c);
}

/* Craters as short as tear-drops at any velocity, and longer with it: each grid gouges from where its grooves grow. */
static void test_scatter_of_short(void **state)
{
    (void)state;
    breech_case *c = close_search(HEAD "sites: [{position: 2.9 m}]\n");
    c->study.threshold_ensemble = 3;
    c->study.scratch = true;
    lengthens = 1e-3;
    onset_answer a = studied(c, "short", status_ok());
    lengthens = 0.0;
    const onset_result *r = &a.result;
    assert_true(r->threshold_deviation > 50.0);
    assert_true(fabs(r->threshold_deviation - r->scratch_deviation) < 1e-6);
    assert_true(fabs(r->threshold_velocity - r->scratch_velocity) < 1.0);
    study_onset_answer_free(&a);
    case_free(c);
}

/* Where the section that carries the current is given, a scene's armature is as warm as its lead face is where the shot
 * has the scene's velocity, in steps of 5 K; a temperature that is given is taken everywhere. */
static void test_warm_lead_face(void **state)
{
    (void)state;
    breech_case *c = close_search(HEAD "sites: [{position: 0.9 m}, {position: 2.9 m}]\n");
    c->armature.throat_area = 3.5e-4, c->projectile.temperature = NAN;
    onset_answer a = studied(c, "lead-face", status_ok());
    const onset_result *r = &a.result;
    double coldest = INFINITY, warmest = 0.0;
    for (int i = 0; i < r->n_scenes; i++) {
        const onset_scene *e = &r->scene[i];
        trace_point at;
        gouge_trace_at_velocity(&a.flown, e->velocity, &at);
        assert_true(fabs(e->lead_face_temperature - at.lead_face_temperature) <= 2.5);
        assert_true(fmod(e->lead_face_temperature, 5.0) == 0.0);
        coldest = fmin(coldest, e->lead_face_temperature), warmest = fmax(warmest, e->lead_face_temperature);
    }
    print_message("%g .. %g K\n", coldest, warmest);
    assert_true(r->n_scenes > 4 && coldest > 294.0 && warmest > coldest + 20.0);
    assert_true(r->site[0].lead_face_temperature > 293.15 &&
                r->site[1].lead_face_temperature > r->site[0].lead_face_temperature);
    study_onset_answer_free(&a);
    c->armature.throat_area = 1e-4; /* it melts */
    a = studied(c, "lead-face-molten", status_ok());
    const double melts = case_material(&c->materials, c->projectile.material)->melting_temperature;
    for (int i = 0; i < r->n_scenes; i++)
        assert_true(r->scene[i].lead_face_temperature < melts && r->scene[i].lead_face_temperature >= melts - 5.0);
    study_onset_answer_free(&a);
    c->armature.throat_area = NAN;
    a = studied(c, "lead-face-unknown", status_ok());
    for (int i = 0; i < r->n_scenes; i++) assert_true(r->scene[i].lead_face_temperature == 293.0);
    study_onset_answer_free(&a);
    c->projectile.temperature = 310.0;
    a = studied(c, "lead-face-given", status_ok());
    for (int i = 0; i < r->n_scenes; i++) assert_true(r->scene[i].lead_face_temperature == 310.0);
    study_onset_answer_free(&a);
    case_free(c);
}

/* Of grains too small for a scene nothing is known: neither that they gouge nor a sharp no. */
static void test_too_small(void **state)
{
    (void)state;
    breech_case *c =
        read(HEAD "populations:\n  - {density: 3 1/m, sizes: [{radius: 30 um, share: 1}]}\n", CASE_FOR_ONSET);
    onset_answer a = studied(c, "too-small", status_ok());
    assert_int_equal(a.result.scenes_run, 0);
    assert_int_equal(a.result.verdict, VERDICT_UNDECIDED);
    assert_true(isnan(a.result.probability_gouge) && isnan(a.result.expected_gouges));
    assert_non_null(strstr(a.result.reason, "study.smallest_radius = 100 um"));
    assert_null(strstr(a.result.reason, "gouges a shot"));
    study_onset_answer_free(&a);
    case_free(c);
}

/* No whole craters: numbers of gouges as with them, volumes and what the gouges take unknown. */
static void test_no_craters(void **state)
{
    (void)state;
    breech_case *c = read(HEAD GRAINS "sites: [{position: 2.9 m}]\n", CASE_FOR_ONSET);
    c->study.feedback = true;
    onset_answer with = studied(c, "craters", status_ok());
    c->study.craters = 0;
    onset_answer without = studied(c, "no-craters", status_ok());
    const onset_result *a = &with.result, *b = &without.result;
    assert_true(a->expected_gouges == b->expected_gouges && a->threshold_velocity == b->threshold_velocity);
    assert_true(a->expected_gouged_volume > 0.0 && isnan(b->expected_gouged_volume));
    assert_true(isfinite(a->muzzle_velocity_feedback) && isnan(b->muzzle_velocity_feedback));
    assert_int_equal(b->scenes_run, a->scenes_run - 2);
    study_onset_answer_free(&with);
    study_onset_answer_free(&without);
    case_free(c);
}

/* A search that ends below the armature's speed without a gouge says so; one that finds the threshold does not.  Below
 * two cells a radius not even the order of surfaces counts. */
static void test_range(void **state)
{
    (void)state;
    breech_case *c = read(HEAD GRAINS, CASE_FOR_ONSET);
    onset_answer a = studied(c, "range", status_ok());
    assert_null(strstr(warned, "study.velocity_high"));
    assert_null(strstr(warned, "order of surfaces"));
    study_onset_answer_free(&a);
    c->study.velocity_low = 500.0;
    c->study.velocity_high = 1200.0;
    c->study.coarse_cells_per_radius = c->study.fine_cells_per_radius = 1.5;
    a = studied(c, "short", status_ok());
    assert_non_null(strstr(warned, "the search ended at study.velocity_high = 1200 m/s without a gouge"));
    assert_non_null(strstr(warned, "order of surfaces"));
    study_onset_answer_free(&a);
    c->study.velocity_high = 4000.0; /* above what the armature reaches: no threshold up to there says all */
    c->scene.grid_shift[0] = 10.0;
    a = studied(c, "beyond", status_ok());
    assert_true(isnan(a.result.threshold_velocity) && a.result.threshold_interval[0] > 3000.0);
    assert_null(strstr(warned, "the search ended at"));
    study_onset_answer_free(&a);
    case_free(c);
}

/* The closing line gives one grain's threshold at any speed; where the sites' verdict seems to contradict it, the line
 * says the speed and the interval that the verdict rests on. */
static void test_closing_line_of_sites(void **state)
{
    (void)state;
    static const struct {
        const char *sites;
        onset_verdict verdict;
        const char *says; /* NULL: nothing more */
    } all[] = { { "[{position: 0.2 m}]", VERDICT_NO_GOUGING, "lies below its grain's interval" },
                { "[{position: 0.2 m}, {position: 0.29 m}]", VERDICT_UNDECIDED, "lies inside its grain's interval" },
                { "[{position: 2.9 m}]", VERDICT_GOUGES, NULL } };
    for (size_t k = 0; k < sizeof all / sizeof *all; k++) {
        char text[4000], interval[60];
        snprintf(text, sizeof text, HEAD "sites: %s\n", all[k].sites);
        breech_case *c = read(text, CASE_FOR_ONSET);
        onset_answer a = studied(c, "closing", status_ok());
        const onset_site *last = &a.result.site[a.result.n_sites - 1];
        snprintf(interval, sizeof interval, "passed at %.0f m/s", last->velocity);
        assert_int_equal(a.result.verdict, all[k].verdict);
        assert_true((strstr(a.result.reason, "the verdict is the sites'") != NULL) == (all[k].says != NULL));
        if (all[k].says && (!strstr(a.result.reason, all[k].says) || !strstr(a.result.reason, interval)))
            fail_msg("%s", a.result.reason);
        snprintf(interval, sizeof interval, "interval, %.0f .. %.0f m/s", last->threshold_interval[0],
                 last->threshold_interval[1]);
        if (all[k].says) assert_non_null(strstr(a.result.reason, interval));
        print_message("%s\n", a.result.reason);
        study_onset_answer_free(&a);
        case_free(c);
    }
}

/* ---- shot after shot ---- */

/* The rail gets warmer from shot to shot, and this made-up one gouges 0.5 m/s earlier for every kelvin. */
static void test_shots_warm_the_rail(void **state)
{
    (void)state;
    breech_case *c = read(HEAD "populations:\n  - {preset: debris, radius_median: 0.3 mm}\n", CASE_FOR_ONSET);
    c->rails.level = CIRCUIT_SHOT_RAILS_DIFFUSING;
    c->study.velocity_interval = 0.02;
    c->study.shots = 4;
    onset_answer a = studied(c, "warm", status_ok());
    const onset_shot *each = a.result.shot;
    assert_true(each[0].rail_rise == 0.0 && each[0].threshold_velocity == a.result.threshold_velocity);
    for (int k = 1; k < 4; k++) {
        assert_true(each[k].rail_rise > each[k - 1].rail_rise + 10.0);
        assert_true(each[k].muzzle_velocity < each[k - 1].muzzle_velocity); /* resistance */
        assert_true(fabs(each[k].threshold_velocity - (each[0].threshold_velocity - 0.5 * each[k].rail_rise)) < 12.0);
        assert_true(each[k].onset_position < each[k - 1].onset_position);
        assert_true(each[k].expected_gouges > each[k - 1].expected_gouges);
    }
    assert_true(fabs(each[1].rail_rise * 3.0 / each[3].rail_rise - 1.0) <
                0.2); /* as much again each time, and a bit more */
    assert_true(scenes_named(&a, "warm-") > 0);
    const onset_shot first = each[0];
    study_onset_answer_free(&a);
    c->study.heat_kept = 0.0; /* all of it gone: as the first, and not a scene more */
    a = studied(c, "cooled", status_ok());
    each = a.result.shot;
    assert_int_equal(scenes_named(&a, "warm-"), 0);
    assert_true(each[3].rail_rise == 0.0 && each[3].threshold_velocity == first.threshold_velocity);
    assert_true(each[3].muzzle_velocity == first.muzzle_velocity);
    assert_true(fabs(each[0].expected_gouges / first.expected_gouges - 1.0) < 0.02); /* other random numbers */
    study_onset_answer_free(&a);
    c->rails.level = CIRCUIT_SHOT_RAILS_CONSTANT; /* cheap flights */
    c->study.heat_kept = 0.5;                     /* it settles at as much as one shot leaves */
    c->study.shots = 12;
    a = studied(c, "settled", status_ok());
    each = a.result.shot;
    assert_true(each[11].rail_rise < 1.02 * each[9].rail_rise && each[1].rail_rise < 0.6 * each[11].rail_rise);
    study_onset_answer_free(&a);
    c->study.heat_kept = 1.0;
    c->study.shots = 500;
    a = studied(c, "melted", base_status_error(STATUS_BAD_INPUT, "ofhc_copper melts at 1356 K; lower study.shots"));
    study_onset_answer_free(&a);
    for (int i = 0; i < c->materials.n; i++) c->materials.item[i].melting_temperature = NAN; /* nothing says when */
    c->study.shots = 2;
    a = studied(c, "never-melts", status_ok());
    assert_true(a.result.shot[1].rail_rise > 10.0 && a.result.shot[1].threshold_velocity < first.threshold_velocity);
    study_onset_answer_free(&a);
    case_free(c);
}

/* Gouges 0.1 mm deep: a layer of 0.05 mm whose bond gives way is gone, one that stays is dented, and one of 0.2 mm is
 * not reached through. */
static void test_shots_strip_the_rail(void **state)
{
    (void)state;
    static const case_layer all[] = { { .thickness = 0.05e-3, .yield_scale = 1.0, .bond_strength = 1e8 },
                                      { .thickness = 0.05e-3, .yield_scale = 1.0, .bond_strength = NAN },
                                      { .thickness = 0.2e-3, .yield_scale = 1.0, .bond_strength = 1e8 } };
    for (int k = 0; k < 3; k++) {
        breech_case *c = read(HEAD "sites: [{position: 2 m}]\n", CASE_FOR_ONSET);
        case_layer layer = all[k];
        snprintf(layer.material, sizeof layer.material, "ofhc_copper");
        const case_layers none = c->rail.layers;
        c->rail.layers = (case_layers){ 1, &layer };
        c->study.shots = 2;
        c->study.heat_kept = 0.0;
        onset_answer a = studied(c, "stripped", status_ok());
        assert_int_equal(scenes_named(&a, "bare-") > 0, k == 0);
        for (int i = 0; i < a.result.n_scenes; i++) {
            const bool bare = strncmp(a.result.scene[i].name, "bare-", 5) == 0;
            assert_int_equal(a.result.scene[i].result.bodies, bare ? 3 : 4);
        }
        study_onset_answer_free(&a);
        c->rail.layers = none;
        case_free(c);
    }
}

/* Four shots past debris on a rail that wears: 40 um of copper, the caller's `layer`, which the case borrows. */
static breech_case *wearing_case(case_layer *layer)
{
    breech_case *c = read(HEAD "populations:\n  - {preset: debris, radius_median: 0.3 mm}\n", CASE_FOR_ONSET);
    *layer = (case_layer){ .thickness = 40e-6, .yield_scale = 1.0, .bond_strength = NAN, .wear_rate = 1.5e-12 };
    snprintf(layer->material, sizeof layer->material, "ofhc_copper");
    assert_int_equal(c->rail.layers.n, 0);
    c->rail.layers = (case_layers){ 1, layer };
    c->study.velocity_interval = 0.02;
    c->study.shots = 4;
    return c;
}

/* A layer of 40 um that every shot wears: by as much each time, as (O-6) says of the shot's force, and the threshold
 * goes with the thickness that is left. */
static void test_shots_wear_layers(void **state)
{
    (void)state;
    case_layer layer;
    breech_case *c = wearing_case(&layer);
    const case_layers none = { 0, NULL };
    c->study.heat_kept = 0.0;
    by_thickness = 5e6; /* 200 m/s for the whole layer */
    onset_answer a = studied(c, "worn", status_ok());
    const onset_shot *each = a.result.shot;
    double force = 0.0; /* the largest from velocity_low on */
    for (int i = 0; i < a.flown.n_trace; i++)
        if (a.flown.trace[i].v >= c->study.velocity_low)
            force = fmax(force, a.flown.trace[i].pressure * c->armature.contact_length * c->armature.contact_width);
    assert_true(each[0].layer_worn == 0.0 && each[0].threshold_velocity == a.result.threshold_velocity);
    for (int k = 1; k < 4; k++) {
        const double worn = k * layer.wear_rate * force / c->armature.contact_width;
        print_message("shot %d finds %.3g um worn, by hand %.3g\n", k + 1, 1e6 * each[k].layer_worn, 1e6 * worn);
        assert_true(worn > k * 2e-6 && worn < 39e-6);
        assert_true(fabs(each[k].layer_worn / worn - 1.0) < 1e-3); /* places of 3 mm */
        assert_true(fabs(each[k].threshold_velocity - (each[0].threshold_velocity - by_thickness * worn)) < 15.0);
        assert_true(each[k].expected_gouges > each[k - 1].expected_gouges);
    }
    assert_true(isnan(each[1].deposit));
    assert_true(scenes_named(&a, "worn-") > 0 && scenes_named(&a, "plated-") == 0);
    assert_true(a.rail.changed[MC_WEAR].layers.n == 1);
    assert_true(fabs(a.rail.changed[MC_WEAR].layers.item[0].thickness - (40e-6 - each[3].layer_worn)) < 1e-12);
    assert_null(strstr(warned, "wear_rate"));
    study_onset_answer_free(&a);
    layer.wear_rate = 1e-9; /* gone with the first shot: the rail itself, which nothing wears */
    a = studied(c, "worn-through", status_ok());
    assert_true(fabs(a.result.shot[3].layer_worn - 40e-6) < 1e-12 && a.rail.changed[MC_WEAR].layers.n == 0);
    assert_true(fabs(a.result.shot[1].threshold_velocity - 1400.0) < 20.0);
    study_onset_answer_free(&a);
    layer.wear_rate = NAN; /* nothing is known: nothing is worn, and that is said */
    a = studied(c, "unworn", status_ok());
    each = a.result.shot;
    assert_true(isnan(each[3].layer_worn) && each[3].threshold_velocity == each[0].threshold_velocity);
    assert_int_equal(scenes_named(&a, "worn-"), 0);
    assert_non_null(strstr(warned, "a layer of ofhc_copper has no wear_rate"));
    study_onset_answer_free(&a);
    by_thickness = 0.0;
    c->rail.layers = none;
    case_free(c);
}

/* The armature's metal adds up from shot to shot, study.deposit_kept of it each time; the scenes know it once it is a
 * cell thick. */
static void test_shots_plate_the_rail(void **state)
{
    (void)state;
    breech_case *c = read(HEAD "populations:\n  - {preset: debris, radius_median: 0.3 mm}\n", CASE_FOR_ONSET);
    c->study.velocity_interval = 0.02;
    c->study.shots = 4;
    c->study.heat_kept = 0.0;
    c->study.deposit_kept = 0.5;
    c->armature.contact_voltage = 30.0;
    c->armature.wear_fraction = 0.05;
    by_thickness = 5e6;
    onset_answer thin = studied(c, "thin-metal", status_ok());
    const onset_shot *each = thin.result.shot;
    const double first = each[1].deposit;
    print_message("%.3g um of metal after one shot\n", 1e6 * first);
    assert_true(each[0].deposit == 0.0 && first > 1e-6 && first < 100e-6 && isnan(each[1].layer_worn));
    for (int k = 2; k < 4; k++) assert_true(fabs(each[k].deposit / (0.5 * each[k - 1].deposit + first) - 1.0) < 1e-9);
    assert_int_equal(scenes_named(&thin, "plated-"), 0);
    assert_non_null(strstr(warned, "is thinner than a cell of"));
    assert_true(each[3].threshold_velocity == each[0].threshold_velocity);
    const surface_plan *plan = &thin.grains.family[0].plan;
    c->study.fine_cells_per_radius = plan->size[plan->reference] / (0.9 * each[3].deposit);
    study_onset_answer_free(&thin);
    onset_answer thick = studied(c, "thick-metal", status_ok());
    each = thick.result.shot;
    assert_true(each[1].deposit == first && scenes_named(&thick, "plated-") > 0);
    assert_null(strstr(warned, "thinner than a cell"));
    const case_layers *layers = &thick.rail.changed[MC_METAL].layers;
    assert_true(layers->n == 1 && layers->item[0].thickness == each[3].deposit && isnan(layers->item[0].bond_strength));
    assert_string_equal(layers->item[0].material, "al7075_t651");
    const double added = 80.0 + by_thickness * each[3].deposit; /* this made-up rail with its metal */
    for (int k = 1; k < 4; k++)
        assert_true(fabs(each[k].threshold_velocity - each[0].threshold_velocity -
                         added * each[k].deposit / each[3].deposit) < 25.0);
    study_onset_answer_free(&thick);
    by_thickness = 5e7; /* plated it gouges nowhere in the search: the nearer one of both rails says */
    c->study.deposit_kept = 1.0;
    onset_answer never = studied(c, "plated-never", status_ok());
    each = never.result.shot;
    assert_true(each[1].threshold_velocity == each[0].threshold_velocity && isfinite(each[0].threshold_velocity));
    assert_true(isnan(each[2].threshold_velocity) && isnan(each[3].threshold_velocity));
    print_message("gouges %.3g, %.3g of shots 2 and 4\n", each[1].expected_gouges, each[3].expected_gouges);
    assert_true(each[3].expected_gouges < 0.97 * each[1].expected_gouges); /* fast places keep less than half */
    study_onset_answer_free(&never);
    c->study.deposit_kept = 0.0; /* wiped off */
    onset_answer clean = studied(c, "wiped", status_ok());
    assert_true(clean.result.shot[3].deposit == 0.0 && scenes_named(&clean, "plated-") == 0);
    study_onset_answer_free(&clean);
    by_thickness = 0.0;
    case_free(c);
}

/* A rail that is both warmer and worn: the two factors on its threshold are multiplied, as in the random shots. */
static void test_changes_of_a_shot_multiply(void **state)
{
    (void)state;
    case_layer layer;
    breech_case *c = wearing_case(&layer);
    const case_layers none = { 0, NULL };
    c->study.velocity_low = 400.0;
    by_thickness = 1.2e7;
    onset_answer a = studied(c, "both", status_ok());
    const double cold = a.result.threshold_velocity;
    double radius;
    const grain_family *f = study_onset_leading_grain(&a, &radius);
    for (int k = 1; k < 4; k++) {
        double product = cold, sum = cold;
        for (int i = MC_WARMTH; i <= MC_WEAR; i++) {
            const changed_rail *rail = &a.rail.changed[i];
            const double there = study_surface_at(&study_family_alike(&rail->grains, f)->surface, radius).velocity,
                         share = a.rail.shot[k].most[i] / rail->most;
            assert_true(there < cold - 50.0);
            product *= 1.0 + share * (there / cold - 1.0), sum += share * (there - cold);
        }
        assert_true(fabs(a.result.shot[k].threshold_velocity / product - 1.0) < 1e-12); /* rounding */
        assert_true(product - sum > 1.0);
    }
    study_onset_answer_free(&a);
    by_thickness = 0.0;
    c->rail.layers = none;
    case_free(c);
}

static int compared_named(const compare_answer *a, const char *prefix)
{
    return scenes_begin(a->result.scene, a->result.n_scenes, prefix);
}

/* The wear of `loose` [um] as the closing table shows it before the last shot; NAN: it does not. */
static double shown_wear(const compare_result *r)
{
    char line[200], name[50] = "";
    double worn = NAN;
    FILE *shown = tmpfile();
    assert_non_null(shown);
    study_compare_print(r, shown);
    rewind(shown);
    while (fgets(line, sizeof line, shown) && strncmp(line, "before the last shot", 20) != 0) continue;
    while (fgets(line, sizeof line, shown) && sscanf(line, "%49s %lf", name, &worn) > 0 && strcmp(name, "loose") != 0)
        continue;
    fclose(shown);
    return strcmp(name, "loose") == 0 ? worn : NAN;
}

/* Each surface as alone, by other random numbers. */
static void assert_as_alone(const breech_case *c, const compare_answer *a)
{
    for (int i = 0; i < a->n; i++) {
        onset_answer alone;
        session s;
        const case_inputs in = case_inputs_of(c);
        open_anew(&in, "six-alone", &s);
        OK(study_onset_run(&s, &a->treated[i], &alone));
        OK(run_session_close(&s, true));
        double sum = 0.0;
        for (int n = 0; n < 6; n++) sum += alone.result.shot[n].expected_gouges;
        assert_true(fabs(sum / 6.0 / a->mean[i].gouges - 1.0) < 0.006);
        const double last = alone.result.shot[5].expected_gouges;
        assert_true(fabs(last / a->drawn.of[6 * i + 5].gouges - 1.0) < 0.006);
        study_onset_answer_free(&alone);
    }
}

/* Surfaces compared over several shots: each keeps its own heat and loses its own layers, and what ranks is the mean of
 * all shots, which of the untreated rail is that of breech onset. */
static void test_shots_compared(void **state)
{
    (void)state;
    if (!heavy_tests()) skip();
    breech_case *c = read(HEAD "populations:\n  - {preset: debris, radius_median: 0.3 mm}\n"
                               "treatments:\n"
                               "  - {name: loose, coating: [{material: steel_4340, thickness: 0.05 mm, "
                               "bond_strength: 100 MPa, wear_rate: 1e-14 m^3/N/m}]}\n"
                               "  - {name: greased, friction: {factor: 0.8}}\n",
                          ALL);
    c->rails.level = CIRCUIT_SHOT_RAILS_DIFFUSING;
    compare_answer a;
    OK(run_compare(c, "one-shot", &a));
    assert_int_equal(a.result.shots, 1);
    for (int i = 0; i < a.result.n; i++) assert_true(a.entry[i].gouges == a.entry[i].last_gouges);
    assert_true(compared_named(&a, "warm-") == 0 && a.answer[1].rail.bare.grains.n == 0);
    const double loose_once = entry_of(&a, "loose")->gouges, plain_once = entry_of(&a, "untreated")->gouges;
    study_compare_answer_free(&a);
    c->study.shots = 6;
    OK(run_compare(c, "six-shots", &a));
    assert_int_equal(a.result.shots, 6);
    const compare_entry plain = *entry_of(&a, "untreated"), loose = *entry_of(&a, "loose");
    assert_true(compared_named(&a, "warm-") > 0 && compared_named(&a, "t1-warm-") > 0);
    /* a layer of 0.05 mm is gone: then its rail is the untreated one, whose scenes serve */
    assert_true(a.answer[1].rail.bare.grains.n > 0 && a.answer[0].rail.bare.grains.n == 0 &&
                compared_named(&a, "t1-bare-") == 0);
    /* what sliding wears off its layer, too little for a search of its own; no other surface has a rate */
    assert_true(loose.layer_worn > 1e-7 && loose.layer_worn < 1e-6 && compared_named(&a, "t1-worn-") == 0);
    assert_true(isnan(plain.layer_worn) && isnan(loose.deposit));
    assert_true(fabs(shown_wear(&a.result) / (1e6 * loose.layer_worn) - 1.0) < 5e-3); /* three digits */
    assert_true(plain.last_gouges > 1.005 * plain_once && plain.gouges > plain_once);
    assert_true(loose.last_gouges > 1.01 * loose_once && loose.gouges > loose_once);
    assert_true(plain.gouges_interval[0] <= plain.gouges && plain.gouges <= plain.gouges_interval[1]);
    for (int i = 1; i < a.result.n; i++) assert_true(a.entry[i - 1].gouges <= a.entry[i].gouges);
    assert_as_alone(c, &a);
    study_compare_answer_free(&a);
    c->study.shots = 500;
    const status melts = run_compare(c, "melts", &a);
    assert_int_equal(melts.code, STATUS_BAD_INPUT);
    assert_non_null(strstr(melts.text, "lower study.shots"));
    study_compare_answer_free(&a);
    case_free(c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_shots_compared),
        cmocka_unit_test(test_every_kind),
        cmocka_unit_test(test_what_they_do),
        cmocka_unit_test(test_new_metal_is_hardened),
        cmocka_unit_test(test_debris_of_a_new_armature),
        cmocka_unit_test(test_both_metals_are_new),
        cmocka_unit_test(test_refusals),
        cmocka_unit_test(test_refused_sets),
        cmocka_unit_test(test_impossible),
        cmocka_unit_test(test_presets),
        cmocka_unit_test(test_gouges_from_the_lowest),
        cmocka_unit_test(test_slower_than_the_search),
        cmocka_unit_test(test_ranking),
        cmocka_unit_test(test_life_beside_grains),
        cmocka_unit_test(test_longest_life),
        cmocka_unit_test(test_no_chain_of_ties),
        cmocka_unit_test(test_progress),
        cmocka_unit_test(test_screened_surface),
        cmocka_unit_test(test_polished_to_nothing),
        cmocka_unit_test(test_warnings_name_the_surface),
        cmocka_unit_test(test_what_layers_suffer),
        cmocka_unit_test(test_seed),
        cmocka_unit_test(test_population_onset),
        cmocka_unit_test(test_larger_grains),
        cmocka_unit_test(test_feedback_of_populations),
        cmocka_unit_test(test_too_small),
        cmocka_unit_test(test_no_craters),
        cmocka_unit_test(test_uncertain_inputs),
        cmocka_unit_test(test_uncertain_inputs_beyond_the_range),
        cmocka_unit_test(test_uncertain_surfaces),
        cmocka_unit_test(test_scatter_of_surfaces),
        cmocka_unit_test(test_verdict),
        cmocka_unit_test(test_scatter),
        cmocka_unit_test(test_one_side_on_other_grids),
        cmocka_unit_test(test_parts_of_an_interval),
        cmocka_unit_test(test_stated_parts),
        cmocka_unit_test(test_scatter_of_a_small_slope),
        cmocka_unit_test(test_scatter_of_two),
        cmocka_unit_test(test_scatter_of_dying),
        cmocka_unit_test(test_scatter_of_short),
        cmocka_unit_test(test_scatter_keeps_order),
        cmocka_unit_test(test_warm_lead_face),
        cmocka_unit_test(test_range),
        cmocka_unit_test(test_closing_line_of_sites),
        cmocka_unit_test(test_shots_warm_the_rail),
        cmocka_unit_test(test_shots_strip_the_rail),
        cmocka_unit_test(test_shots_wear_layers),
        cmocka_unit_test(test_shots_plate_the_rail),
        cmocka_unit_test(test_changes_of_a_shot_multiply),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
