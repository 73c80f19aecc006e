/* SPDX-License-Identifier: BSD-3-Clause */
/* What a projectile does to its target: its flight, how the class is decided, what a case is refused for, and small
 * scenes that are known to rebound, to stop and to pierce. */
#include "base/constants.h"
#include "coupling/scene/scene_fill.h"
#include "coupling/strike/outcome.h"
#include "coupling/strike/recht_ipson.h"
#include "full_common.h"
#include "program_common.h"

/* ---- flight ---- */

/* against its own equation, m v' = - rho Cd A v^2 / 2, by the fourth-order Runge-Kutta method in 2000 steps,
 * whose error is below rounding here. */
static void test_flight(void **state)
{
    (void)state;
    const case_strike s = { .distance = 40.0, .drag_coefficient = 0.95, .drag_area = 7.854e-5, .air_density = 1.225 };
    const double mass = 4.11e-3, v0 = 1900.0, k = 0.5 * 1.225 * 0.95 * 7.854e-5 / mass;
    double x = 0.0, v = v0, t = 0.0;
    const strike_flight f = strike_fly(&s, mass, v0);
    const int steps = 2000;
    for (const double h = f.time / steps; t < f.time - 0.5 * h; t += h) {
        const double a1 = -k * v * v, v1 = v + 0.5 * h * a1, a2 = -k * v1 * v1, v2 = v + 0.5 * h * a2,
                     a3 = -k * v2 * v2, v3 = v + h * a3, a4 = -k * v3 * v3;
        x += h * (v + 2.0 * v1 + 2.0 * v2 + v3) / 6.0;
        v += h * (a1 + 2.0 * a2 + 2.0 * a3 + a4) / 6.0;
    }
    assert_true(fabs(x / s.distance - 1.0) < 1e-9);
    assert_true(fabs(v / f.velocity - 1.0) < 1e-9);
    assert_true(f.velocity < 0.7 * v0);
    const case_strike vacuum = { .distance = 40.0, .drag_coefficient = 0.0, .drag_area = 1.0, .air_density = 1.225 };
    assert_true(strike_fly(&vacuum, mass, v0).velocity == v0 && strike_fly(&vacuum, mass, v0).time == 40.0 / v0);
    const case_strike near = { .distance = 0.0, .drag_coefficient = NAN, .drag_area = NAN, .air_density = 1.225 };
    assert_true(strike_fly(&near, mass, v0).velocity == v0 && strike_fly(&near, mass, v0).time == 0.0);
}

static void test_package(void **state)
{
    (void)state;
    const case_strike s = { .projectile = "ball", .discarded_mass = 0.24 };
    OK(strike_package_check(&s, 0.010, 0.25));
    OK(strike_package_check(&s, 0.012, 0.25)); /* 1 % of the package */
    const status heavy = strike_package_check(&s, 0.30, 0.25), missing = strike_package_check(&s, 0.004, 0.25);
    assert_int_equal(heavy.code, STATUS_BAD_INPUT);
    assert_non_null(strstr(heavy.text, "300 g"));
    assert_non_null(strstr(heavy.text, "250 g"));
    assert_int_equal(missing.code, STATUS_BAD_INPUT);
    assert_non_null(strstr(missing.text, "4 g"));
    assert_non_null(strstr(missing.text, "would be 246 g"));
}

/* ---- the class ---- */

static void test_class(void **state)
{
    (void)state;
    const strike_state through = { .arrival = 1000.0,
                                   .mass = 4e-3,
                                   .speed = 600.0,
                                   .rest_speed = 5.0,
                                   .change = 20.0,
                                   .ahead = 3e-6,
                                   .touched = true };
    strike_state s = through;
    assert_int_equal(strike_class_of(&s), STRIKE_PIERCED);
    s.rest_speed = NAN; /* nothing of the target is left at rest */
    assert_int_equal(strike_class_of(&s), STRIKE_PIERCED);
    s = through, s.ahead = 5e-6; /* a thousandth of its mass is in the way */
    assert_int_equal(strike_class_of(&s), STRIKE_UNFINISHED);
    s = through, s.change = 70.0; /* something is slowing it down */
    assert_int_equal(strike_class_of(&s), STRIKE_UNFINISHED);
    s = through, s.touched = false;
    assert_int_equal(strike_class_of(&s), STRIKE_UNFINISHED);
    s = through, s.speed = NAN;
    assert_int_equal(strike_class_of(&s), STRIKE_UNFINISHED);
    s = through, s.speed = 24.0, s.change = 1.0; /* 19 m/s over what is left: no motion */
    assert_int_equal(strike_class_of(&s), STRIKE_STOPPED);
    s.speed = -14.0;
    assert_int_equal(strike_class_of(&s), STRIKE_STOPPED);
    s.speed = -16.0;
    assert_int_equal(strike_class_of(&s), STRIKE_REBOUND);
    s.change = 21.0; /* it is being thrown back */
    assert_int_equal(strike_class_of(&s), STRIKE_UNFINISHED);
    s.change = 1.0, s.plate = true, s.least_hole = 1e-6;
    assert_int_equal(strike_class_of(&s), STRIKE_BULGED);
    s.hole = 1e-6;
    assert_int_equal(strike_class_of(&s), STRIKE_TORN);
    s = through, s.plate = true, s.hole = 1e-4;
    assert_int_equal(strike_class_of(&s), STRIKE_PIERCED);
    s.piston = true, s.least_hole = 1e-6; /* water goes nowhere: the plate alone decides */
    assert_int_equal(strike_class_of(&s), STRIKE_TORN);
    s.hole = 0.0, s.swelling = 0.05;
    assert_int_equal(strike_class_of(&s), STRIKE_BULGED);
    s.swelling = 0.2;
    assert_int_equal(strike_class_of(&s), STRIKE_UNFINISHED);
}

/* ---- cases ---- */

/* An elastic steel ball in front of a plate of `metal`, so many millimetres thick; a quarter of them. */
#define BODIES(metal, thick)                                                                                       \
    "  bodies:\n"                                                                                                  \
    "    - {name: plate, material: " metal ", damage: " thick " -5 -5 mm, hi: 2 5 5 mm}}}\n"                       \
    "    - {name: ball, material: hard, shape: {sphere: {center: -1.05 0 0 mm, radius: 1 mm}}, velocity: 100 0 0 " \
    "m/s}\n"                                                                                                       \
    "  contacts: [{between: [plate, ball], law: coulomb, friction: 0.1, normal_of: ball}]\n"                       \
    "  window: {x: {lo: -4 mm, hi: 8 mm}, y: {lo: 0 mm, hi: 5 mm}, z: {lo: 0 mm, hi: 5 mm}}\n"                     \
    "  boundary: {y: [symmetry, absorbing], z: [symmetry, absorbing]}\n"
#define HARD                                                                                                       \
    "materials:\n"                                                                                                 \
    "  - {name: hard, density: 7850 kg/m3, youngs_modulus: 210 GPa, poisson: 0.3, specific_heat: 460 J/(kg K),\n"  \
    "     reference_temperature: 293 K, melting_temperature: 1790 K, yield_A: 10 GPa, hardening_B: 0 Pa,\n"        \
    "     hardening_n: 1, rate_C: 0, softening_m: 1, rate_0: 1 1/s, sound_speed: 4570 m/s, hugoniot_slope: 1.5,\n" \
    "     gruneisen: 1.7}\n"
#define HEAD(strike, end)                                                                         \
    "name: t\n" HARD "strike: {projectile: ball" strike "}\noutput: {snapshots: 0, report: no}\n" \
    "scene:\n  end_time: " end "\n  cell: 0.25 mm\n  coarse_cell: 0.5 mm\n"
#define PLATE "yes, shape: {box: {lo: 0"   /* 2 mm */
#define SHEET "yes, shape: {box: {lo: 1.5" /* 0.5 mm */

static void write_case(const char *folder, const char *text)
{
    char path[200];
    fresh_folder(folder);
    snprintf(path, sizeof path, "%s/case.yaml", folder);
    OK(host_file_write(path, text, strlen(text)));
}

static cJSON *struck(const char *folder, const char *text, const char *more)
{
    char command[600];
    write_case(folder, text);
    snprintf(command, sizeof command, "strike %s -o %s/out --quiet --threads 1 %s", folder, folder, more);
    if (run(command) != 0) {
        char *errors;
        OK(host_file_read("err.txt", &errors, NULL));
        fail_msg("breech %s: %s", command, errors);
    }
    char out[100];
    snprintf(out, sizeof out, "%.80s/out", folder);
    return summary_of(out);
}

/* The scene of a strike: the case's, with the projectile at its speed, and three probes more. */
static void test_scene(void **state)
{
    (void)state;
    const char *const dirs[] = { BREECH_TESTS "/../cases/materials" };
    const case_options how = { dirs, 1, CASE_FOR_STRIKE };
    const char *bytes = HEAD(", plate: plate, travel: 8 mm", "1 us") BODIES("ofhc_copper", PLATE);
    const case_text text = { bytes, strlen(bytes), "case.yaml", NULL, 0 };
    case_inputs *in = NULL;
    char *errors = NULL;
    if (case_inputs_read_memory(&text, &how, &in, &errors).code != STATUS_OK) fail_msg("%s", errors);
    OK(scene_fill(&in->bodies.scene));
    strike_projectile p;
    OK(strike_projectile_of(in, &p));
    assert_true(p.body == 1 && p.plate == 0 && p.parts == 4.0 && p.n[0] == 1.0 && p.speed == 100.0);
    assert_true(fabs(p.half_width - 1e-3) < 1e-12 && p.from[1] == 0.0 && p.from[2] == 0.0);
    for (int fast = 0; fast < 2; fast++) {
        const double v = fast ? 1000.0 : 50.0;
        case_bodies b;
        OK(strike_scene(in, &p, v, &b));
        mpm_scene *s = &b.scene;
        assert_true(s->probes == 3 && s->body[1].velocity[0] == v && s->body[0].velocity[0] == 0.0);
        assert_true(fabs(s->end_time * v - 8e-3) < 1e-12);
        assert_true(*mpm_probe_value(&s->probe[1], "reach") == 0.5 * p.half_width);
        assert_true(*mpm_probe_value(&s->probe[1], "slower") == (fast ? 100.0 : 20.0)); /* a plate that swings */
        assert_true(mpm_probe_value(&s->probe[2], "along")[0] == -1.0);
        mpm_scene_free(s);
    }
    assert_true(in->bodies.scene.probes == 0 && in->bodies.scene.body[1].velocity[0] == 100.0); /* as it was */
    case_inputs_free(in);
}

static case_inputs *inputs_of(const char *bytes)
{
    const char *const dirs[] = { BREECH_TESTS "/../cases/materials" };
    const case_options how = { dirs, 1, CASE_FOR_STRIKE };
    const case_text text = { bytes, strlen(bytes), "case.yaml", NULL, 0 };
    case_inputs *in = NULL;
    char *errors = NULL;
    if (case_inputs_read_memory(&text, &how, &in, &errors).code != STATUS_OK) fail_msg("%s", errors);
    return in;
}

/* A ball of 2 mm, a plate of `thick`, without window and end_time: travel 8 mm. */
#define OPEN(thick, more)                                                                                          \
    "name: t\n" HARD "strike: {projectile: ball, plate: plate, travel: 8 mm}\nscene:\n  cell: 0.25 mm\n" more      \
    "  coarse_cell: 0.5 mm\n  bodies:\n"                                                                           \
    "    - {name: plate, material: ofhc_copper, shape: {box: {lo: 0 -5 -5 mm, hi: " thick " 5 5 mm}}}\n"           \
    "    - {name: ball, material: hard, shape: {sphere: {center: -1.05 0 0 mm, radius: 1 mm}}, velocity: 100 0 0 " \
    "m/s}\n"

/* What the case leaves open follows from the travel and the plate: the window holds the ball's way and a coarse cell
 * more, the fine zone the plate if it is no thicker than two balls, the time is that of the travel. */
static void test_room(void **state)
{
    (void)state;
    case_inputs *in = inputs_of(OPEN("3", ""));
    OK(strike_fill(in));
    const mpm_axis *x = &in->bodies.scene.axis[0];
    assert_true(fabs(x->hi - (8e-3 - 0.05e-3 + 0.5e-3)) < 1e-12);
    assert_true(x->fine_lo <= -2e-3 && x->fine_hi >= 3e-3 && x->fine_hi < 3.5e-3);
    assert_true(fabs(in->bodies.scene.end_time - 8e-5) < 1e-15);
    case_inputs_free(in);
    in = inputs_of(OPEN("5", "  window: {x: {hi: 6 mm}}\n  end_time: 1 us\n"));
    OK(strike_fill(in));
    assert_true(in->bodies.scene.axis[0].hi == 6e-3 && in->bodies.scene.axis[0].fine_hi < 2e-3);
    assert_true(in->bodies.scene.end_time == 1e-6);
    case_inputs_free(in);
}

/* What contact gave the ball is the momentum that it has lost: no other force acts on it.  1e-9: rounding of some
 * hundred steps. */
static void assert_momentum(const cJSON *s)
{
    const cJSON *ball = cJSON_GetObjectItemCaseSensitive(cJSON_GetObjectItemCaseSensitive(s, "bodies"), "ball");
    const double v = cJSON_GetArrayItem(cJSON_GetObjectItemCaseSensitive(ball, "velocity"), 0)->valuedouble;
    const double lost = number(s, "projectile_mass") * (number(s, "impact_velocity") - v);
    assert_true(fabs(number(s, "impulse") / lost - 1.0) < 1e-9);
    assert_true(fabs(number(s, "residual_velocity") - v) < 1e-5 * number(s, "impact_velocity")); /* some of it melted */
    assert_true(number(s, "energy_absorbed") < number(s, "energy_arrival"));
    assert_true(number(s, "peak_force") > 0.0 && fabs(number(s, "energy_error")) < 1e-9);
}

/* What is said of a strike is of the whole, what is said of its bodies and probes of the quarter that is computed. */
static void assert_quarter(const cJSON *s)
{
    const cJSON *bodies = cJSON_GetObjectItemCaseSensitive(s, "bodies"),
                *force =
                    cJSON_GetObjectItemCaseSensitive(cJSON_GetObjectItemCaseSensitive(s, "probes"), "projectile_force");
    const double impulse = cJSON_GetArrayItem(cJSON_GetObjectItemCaseSensitive(force, "impulse"), 0)->valuedouble;
    const cJSON *ball = cJSON_GetObjectItemCaseSensitive(bodies, "ball"),
                *plate = cJSON_GetObjectItemCaseSensitive(bodies, "plate");
    assert_true(fabs(4.0 * number(ball, "mass") / number(s, "projectile_mass") - 1.0) < 1e-9);
    assert_true(fabs(4.0 * fabs(impulse) / number(s, "impulse") - 1.0) < 1e-9);
    assert_true(number(s, "failed_volume") > 0.0);
    assert_true(fabs(4.0 * number(plate, "failed_volume") / number(s, "failed_volume") - 1.0) < 1e-9);
}

/* The ball of the quarter weighs what a whole one does: to 0.1 %, what points of a quarter of a millimetre miss at its
 * surface. */
static void test_classes(void **state)
{
    (void)state;
    const double whole = 7850.0 * 4.0 / 3.0 * PI * 1e-9;
    cJSON *rebound = struck("rebound", HEAD("", "4 us") BODIES("hard", "no, shape: {box: {lo: 0"), "");
    assert_text(rebound, "class", "rebound");
    assert_text(rebound, "kind", "strike");
    assert_true(number(rebound, "impact_velocity") == 100.0); /* its own in the scene */
    assert_true(isnan(number(rebound, "muzzle_velocity")) && isnan(number(rebound, "hole_diameter")));
    assert_true(fabs(number(rebound, "projectile_mass") / whole - 1.0) < 1e-3);
    assert_true(number(rebound, "residual_velocity") < -20.0 && number(rebound, "failed_volume") == 0.0);
    assert_momentum(rebound);

    cJSON *bulged =
        struck("bulged", HEAD(", plate: plate, velocity: 150 m/s", "12 us") BODIES("ofhc_copper", PLATE), "");
    assert_text(bulged, "class", "bulged");
    assert_true(number(bulged, "hole_diameter") == 0.0 && number(bulged, "deflection") > 1e-4);
    assert_true(number(bulged, "residual_velocity") < 5.0);
    assert_momentum(bulged);
    cJSON *pierced = struck(
        "pierced", HEAD(", plate: plate, velocity: 1.5 km/s, travel: 8 mm", "1 us") BODIES("ofhc_copper", SHEET), "");
    assert_text(pierced, "class", "pierced");
    assert_true(fabs(number(pierced, "end_time") / (8e-3 / 1500.0) - 1.0) < 0.01); /* of strike.travel */
    assert_true(number(pierced, "hole_diameter") > 1.8e-3 && number(pierced, "hole_diameter") < 6e-3);
    assert_true(number(pierced, "residual_velocity") > 750.0 && number(pierced, "debris_mass") > 0.0);
    assert_momentum(pierced);
    assert_quarter(pierced);
    cJSON_Delete(rebound), cJSON_Delete(bulged), cJSON_Delete(pierced);
}

/* What was open before the shot is no hole of it: a bore along the flight, the corners of the box about a disc. */
static void test_hole(void **state)
{
    (void)state;
    static const char *const shapes[] = {
        "{minus: [{box: {lo: 0 -5 -5 mm, hi: 2 5 5 mm}}, {box: {lo: -1 -0.6 -0.6 mm, hi: 3 0.6 0.6 mm}}]}",
        "{strut: {from: 0 0 0 mm, to: 2 0 0 mm, radius: 2.5 mm}}"
    };
    for (int k = 0; k < 2; k++) {
        char set[400];
        snprintf(set, sizeof set, "--set scene.bodies[0].shape='%s'", shapes[k]);
        cJSON *s = struck("open", HEAD(", plate: plate", "7 us") BODIES("hard", "no, shape: {box: {lo: 0"), set);
        assert_true(number(s, "hole_diameter") == 0.0);
        assert_string_not_equal(cJSON_GetObjectItemCaseSensitive(s, "class")->valuestring, "torn");
        cJSON_Delete(s);
    }
}

/* A scene that ends while the ball is still in the plate says so: pierced, but nothing is open yet. */
static void test_not_yet_all(void **state)
{
    (void)state;
    const char *text = HEAD(", plate: plate, velocity: 1.5 km/s", "2.2 us") BODIES("ofhc_copper", SHEET);
    cJSON *s = struck("early", text, "");
    assert_text(s, "class", "pierced");
    assert_true(contains("early/out/summary.json", "pierced, but the plate has no hole that counts: "));
    cJSON_Delete(s);
}

/* A ball that flies out of the window is judged while nearly all of it is there, at the velocity that it has then; one
 * that erodes loses mass and is judged at the end. */
static void test_losses(void **state)
{
    (void)state;
    const char *text = HEAD(", plate: plate, velocity: 1.5 km/s, travel: 8 mm", "1 us") BODIES("ofhc_copper", SHEET);
    cJSON *s = struck("losses", text, "--set 'scene.window.x={lo: -4 mm, hi: 4 mm}'");
    assert_text(s, "class", "pierced");
    assert_true(cJSON_IsTrue(cJSON_GetObjectItemCaseSensitive(s, "gone")));
    assert_true(number(s, "left_share") > 0.999 && number(s, "judged_time") < 0.9 * number(s, "end_time"));
    assert_true(fabs(number(s, "lost_mass") / number(s, "projectile_mass") - 1.0) < 1e-9);
    const double v = number(s, "residual_velocity") / 1500.0;
    assert_true(v > 0.5 && fabs(number(s, "energy_share") - (1.0 - v * v)) < 0.01);
    assert_true(contains("losses/out/summary.json", "left the window before the scene's end"));
    cJSON_Delete(s);
    s = struck("losses", text,
               "--set scene.bodies[1].material=al6061_t6 --set scene.bodies[1].damage=yes "
               "--set strike.velocity='5 km/s'");
    assert_true(number(s, "eroded_mass") > 0.0 && number(s, "left_share") == 0.0);
    assert_true(number(s, "lost_mass") < 4.0 * (1.0 + 1e-9) * number(s, "eroded_mass")); /* a quarter is computed */
    assert_true(number(s, "lost_mass") > 0.01 * number(s, "projectile_mass"));
    assert_true(number(s, "judged_time") == number(s, "end_time"));
    assert_false(contains("losses/out/summary.json", "left the window"));
    cJSON_Delete(s);
}

/* The half model and the quarter of it are the same whole: every answer, to the rounding that grows in 200 steps. */
static void test_parts(void **state)
{
    (void)state;
    static const char *const keys[] = { "projectile_mass", "residual_velocity", "energy_arrival", "energy_absorbed",
                                        "peak_force",      "impulse",           "deflection" };
    const char *text = HEAD(", velocity: 200 m/s", "1.5 us") BODIES("ofhc_copper", PLATE);
    cJSON *quarter = struck("quarter", text, "");
    cJSON *half = struck(
        "half", text, "--set scene.window.y='{lo: -5 mm, hi: 5 mm}' --set 'scene.boundary.y=[absorbing, absorbing]'");
    for (size_t i = 0; i < sizeof keys / sizeof *keys; i++)
        if (!(fabs(number(half, keys[i]) / number(quarter, keys[i]) - 1.0) < 1e-6))
            fail_msg("%s: %.12g and %.12g", keys[i], number(half, keys[i]), number(quarter, keys[i]));
    cJSON_Delete(quarter), cJSON_Delete(half);
}

/* ---- the limit velocity ---- */

/* What gives comes back; with one residual velocity 4 % too high the largest deviation lies below that. */
static void test_recht_ipson(void **state)
{
    (void)state;
    const double v[] = { 450.0, 500.0, 700.0, 1200.0 };
    double r[4];
    for (int i = 0; i < 4; i++) r[i] = 0.83 * sqrt(v[i] * v[i] - 400.0 * 400.0);
    strike_fit f = strike_recht_ipson(4, v, r);
    assert_true(fabs(f.factor - 0.83) < 1e-9 && fabs(f.limit - 400.0) < 1e-6 && f.error < 1e-9);
    f = strike_recht_ipson(2, v, r);
    assert_true(fabs(f.factor - 0.83) < 1e-9 && isnan(f.error));
    r[2] *= 1.04;
    f = strike_recht_ipson(4, v, r);
    assert_true(f.error > 0.01 && f.error < 0.04 && fabs(f.limit - 400.0) < 20.0);
    assert_true(isnan(strike_recht_ipson(1, v, r).factor));
    const double falling[] = { 300.0, 200.0 };
    assert_true(isnan(strike_recht_ipson(2, v, falling).factor));
}

/* A thin sheet is pierced by a fast ball and holds a slow one: the search brackets the change to the wanted width, its
 * arrivals stand in the summary, and both sides of the bracket are what they are said to be. */
static void test_limit(void **state)
{
    (void)state;
    if (!heavy_tests()) skip();
    const char *text = "study: {velocity_low: 200 m/s, velocity_high: 900 m/s, velocity_interval: 0.25}\n" HEAD(
        ", velocity: 1 km/s, travel: 14 mm, limit: yes", "1 us") BODIES("ofhc_copper", SHEET);
    cJSON *s = struck("limit", text, "--set output.report=yes");
    const cJSON *bracket = cJSON_GetObjectItemCaseSensitive(s, "limit_interval"), *a;
    const double lo = cJSON_GetArrayItem(bracket, 0)->valuedouble, hi = cJSON_GetArrayItem(bracket, 1)->valuedouble;
    const double limit = number(s, "limit_velocity");
    double last = 0.0;
    int n = 0;
    assert_true(lo < limit && limit < hi && lo >= 200.0 && hi <= 900.0);
    cJSON_ArrayForEach(a, cJSON_GetObjectItemCaseSensitive(s, "arrivals"))
    {
        const double v = number(a, "impact_velocity");
        const bool pierced = strcmp(cJSON_GetObjectItemCaseSensitive(a, "class")->valuestring, "pierced") == 0;
        assert_true(v > last);
        if (v <= lo) assert_false(pierced);
        if (v >= hi) assert_true(pierced);
        last = v, n++;
    }
    assert_true(last == 1000.0 && n >= 4);
    assert_true(number(s, "recht_ipson_factor") > 0.5 && number(s, "recht_ipson_factor") < 1.0);
    assert_text(s, "class", "pierced");
    assert_true(contains("limit/out/report.html", "<h2>The limit velocity</h2>"));
    assert_true(contains("limit/out/report.html", "<span>deflection *</span>"));
    assert_true(contains("limit/out/report.html", "does not settle as cells become smaller"));
    assert_true(contains("limit/out/report.html", "beside one mirror half of the whole, beside two a quarter"));
    cJSON_Delete(s);
    /* in half the time nothing slow has come to rest */
    assert_int_equal(
        run("strike limit -o limit/c --quiet --threads 1 --set strike.travel='6 mm' --set study.max_scenes=3"), 0);
    s = summary_of("limit/c");
    bracket = cJSON_GetObjectItemCaseSensitive(s, "limit_interval");
    assert_true(cJSON_IsNull(cJSON_GetArrayItem(bracket, 0)) && cJSON_IsNumber(cJSON_GetArrayItem(bracket, 1)));
    assert_true(isnan(number(s, "limit_velocity")));
    cJSON_Delete(s);
    /* one between those that are stopped and those that pierce has not: the limit is the middle of the decided */
    assert_int_equal(run("strike limit -o limit/d --quiet --threads 1 --set strike.travel='12 mm'"), 0);
    s = summary_of("limit/d");
    bracket = cJSON_GetObjectItemCaseSensitive(s, "limit_interval");
    assert_true(number(s, "limit_velocity") ==
                0.5 * (cJSON_GetArrayItem(bracket, 0)->valuedouble + cJSON_GetArrayItem(bracket, 1)->valuedouble));
    assert_true(contains("limit/d/summary.json", "m/s 1 is not decided; a longer scene (strike.travel)"));
    cJSON_Delete(s);
    /* the strike's own arrival is one of them: where it pierces between the two ends it is the upper one */
    const double faster = floor(0.2 * lo + 0.8 * hi);
    char own[200];
    snprintf(own, sizeof own,
             "strike limit -o limit/e --quiet --threads 1 --store limit/out/store --set "
             "strike.velocity='%.0f m/s'",
             faster);
    assert_int_equal(run(own), 0);
    s = summary_of("limit/e");
    bracket = cJSON_GetObjectItemCaseSensitive(s, "limit_interval");
    assert_true(cJSON_GetArrayItem(bracket, 0)->valuedouble == lo);
    assert_true(cJSON_GetArrayItem(bracket, 1)->valuedouble == faster);
    cJSON_Delete(s);
    assert_int_equal(run("strike limit -o limit/b --quiet --set study.velocity_low='890 m/s'"), 2);
    assert_true(contains("err.txt", "hold fewer than two velocities"));
}

/* ---- from the shot ---- */

#define PROFILE                                                                                 \
    "current_profiles: [{points: [{time: 0 s, current: 0 A}, {time: 0.5 ms, current: 300 kA}, " \
    "{time: 3 ms, current: 300 kA}, {time: 3.1 ms, current: 0 A}]}]\n"
#define BANK                                                                                                   \
    "bank: {count: 3, capacitance: 3.594 mF, charge: 5 kV, inductance: 12.56 uH, resistance: 4.1 mohm, "       \
    "crowbar_drop: 1.48 V, crowbar_resistance: 0.43 mohm, cable_inductance: 1 uH, cable_resistance: 1 mohm}\n" \
    "optimise: {goal: velocity}\n"
#define LAUNCHER                                                                                                   \
    "rail: {height: 25 mm, thickness: 20 mm, separation: 25 mm, level: constant, inductance_gradient: 0.45 uH/m, " \
    "resistance_gradient: 0.1 mohm/m}\n"                                                                           \
    "barrel: {length: 1 m, start: 0.1 m}\n"                                                                        \
    "armature: {mass: 32.883 g, preload: 0 N, friction_dry: 0, friction_melted: 0, contact_length: 16 mm, "        \
    "contact_width: 25 mm}\n"

/* A ball of 32.9 mg from a package of 32.9 g flies ten metres: the summary has the shot, the muzzle velocity is its,
 * and makes the arrival velocity of it. */
static void test_from_shot(void **state)
{
    (void)state;
    const double mass = 7850.0 * 4.0 / 3.0 * PI * 1e-9, area = PI * 1e-6;
    const char *text = PROFILE LAUNCHER HEAD(", distance: 10 m, drag_coefficient: 1, drag_area: 3.14159265 mm2, "
                                             "discarded_mass: 32.85 g",
                                             "0.5 us") BODIES("ofhc_copper", PLATE);
    cJSON *s = struck("shot", text, "");
    const cJSON *launched = cJSON_GetObjectItemCaseSensitive(s, "shot");
    const double muzzle = number(s, "muzzle_velocity");
    assert_true(muzzle > 300.0 && muzzle == number(launched, "muzzle_velocity"));
    const double k = 0.5 * 1.225 * area / mass;
    assert_true(fabs(number(s, "impact_velocity") / (muzzle * exp(-10.0 * k)) - 1.0) < 1e-3);
    assert_true(number(s, "flight_time") > 10.0 / muzzle);
    assert_text(s, "class", "unfinished"); /* half a microsecond */
    assert_true(exists("shot/out/history.h5"));
    cJSON_Delete(s);
    assert_int_equal(run("strike shot -o shot/b --quiet --set strike.discarded_mass='0 g'"), 2);
    assert_true(contains("err.txt", "0.03288 g") && contains("err.txt", "weighs 32.88 g"));
    assert_int_equal(run("strike shot -o shot/b --quiet --set armature.mass='30 mg'"), 2);
    assert_true(contains("err.txt", "weighs 0.03288 g, the package that the shot launches 0.03 g"));
    assert_int_equal(run("strike shot -o shot/b --quiet --set strike.drag_area=none"), 2);
    assert_true(contains("err.txt", "strike.drag_area is missing"));
    assert_false(exists("shot/b"));
}

/* The shipped case, on cells of twice the size: the ball leaves with the velocity of `breech shot`, of which
 * makes the arrival velocity, and goes through.  A larger ball is refused with its mass and the package's. */
static void test_shipped(void **state)
{
    (void)state;
#define SHOT_TARGET BREECH_TESTS "/../cases/shot_target"
    fresh_folder("shipped");
    assert_int_equal(run("shot " SHOT_TARGET " -o shipped/shot --quiet --set output.report=no"), 0);
    assert_int_equal(run("strike " SHOT_TARGET " -o shipped/strike --quiet --threads 1 --set output.report=no "
                         "--set 'scene.cell=1 mm' --set 'scene.coarse_cell=2 mm'"),
                     0);
    cJSON *shot = summary_of("shipped/shot"), *s = summary_of("shipped/strike");
    const double mass = 18167.0 * 4.0 / 3.0 * PI * 64e-9, k = 0.5 * 1.225 * 0.95 * 50.27e-6 / mass;
    const double muzzle = number(shot, "muzzle_velocity");
    assert_true(muzzle > 1900.0 && number(s, "muzzle_velocity") == muzzle);
    assert_true(fabs(number(s, "impact_velocity") / (muzzle * exp(-20.0 * k)) - 1.0) < 1e-4);
    assert_text(s, "class", "pierced");
    assert_true(number(s, "residual_velocity") > 1000.0 && number(s, "residual_velocity") < 1350.0);
    cJSON_Delete(shot), cJSON_Delete(s);
    assert_int_equal(run("strike " SHOT_TARGET
                         " -o shipped/b --quiet --set 'scene.bodies[1].shape={sphere: {center: -6 0 0 "
                         "mm, radius: 5 mm}}'"),
                     2);
    assert_true(contains("err.txt", "9.513 g") && contains("err.txt", "weighs 250 g"));
}

/* With `optimise`, goal velocity, the bank's charge is found: for an arrival with strike.velocity, and for one with the
 * limit velocity that the search brings out (its scenes are those of test_limit). */
static void test_charge(void **state)
{
    (void)state;
    const char *text = BANK LAUNCHER HEAD(", velocity: 200 m/s, distance: 10 m, drag_coefficient: 1, drag_area: "
                                          "3.14159265 mm2, discarded_mass: 32.85 g",
                                          "0.5 us") BODIES("ofhc_copper", PLATE);
    cJSON *s = struck("charge", text, "");
    assert_true(fabs(number(s, "impact_velocity") / 200.0 - 1.0) < 3e-5); /* the search's closeness, shots' rtol */
    assert_true(number(s, "muzzle_velocity") > 210.0 && number(s, "charge_scale") > 0.0);
    const double scale = number(s, "charge_scale"), stored = 0.5 * 3 * 3.594e-3 * 25e6 * scale * scale;
    assert_true(fabs(number(s, "stored_energy") / stored - 1.0) < 1e-9);
    cJSON_Delete(s);
    assert_int_equal(run("strike charge -o charge/b --quiet --set strike.velocity=none"), 2);
    assert_true(contains("err.txt", "optimise.muzzle_velocity is missing"));

    const char *limit =
        "study: {velocity_low: 200 m/s, velocity_high: 900 m/s, velocity_interval: 0.25}\n" BANK LAUNCHER HEAD(
            ", travel: 14 mm, limit: yes, discarded_mass: 32.85 g", "1 us") BODIES("ofhc_copper", SHEET);
    s = struck("aimed", limit, "--store limit/out/store");
    assert_true(number(s, "limit_velocity") > 200.0);
    assert_true(fabs(number(s, "impact_velocity") / number(s, "limit_velocity") - 1.0) < 3e-5);
    cJSON_Delete(s);
}

/* ---- refused ---- */

static void refused(const char *set, const char *words)
{
    char command[600];
    snprintf(command, sizeof command, "strike bad -o bad/out --quiet --set %s", set);
    assert_refused(command, "bad/out", words);
}

/* A piston behind water, a plate of two cells clamped over a square bore: a quarter. */
#define WATER                                                                                                      \
    "name: water\nmaterials:\n"                                                                                    \
    "  - {name: sea, strength: none, density: 1000 kg/m3, specific_heat: 4186 J/(kg K), reference_temperature: "   \
    "293 K,\n     sound_speed: 1480 m/s, hugoniot_slope: 1.92, gruneisen: 0.11, cavitation_pressure: 0 Pa}\n"      \
    "strike: {projectile: column, plate: plate, velocity: 20 m/s}\n"                                               \
    "scene:\n  end_time: 40 us\n  cell: 1 mm\n  bodies:\n"                                                         \
    "    - {name: wall, material: ofhc_copper, held: yes, shape: {minus: [{box: {lo: -2 0 0 mm, hi: 16 8 8 mm}}, " \
    "{box: {lo: -3 -1 -1 mm, hi: 17 6 6 mm}}, {box: {lo: 10 -1 -1 mm, hi: 12 9 9 mm}}]}}\n"                        \
    "    - {name: plate, material: ofhc_copper, damage: yes, shape: {box: {lo: 10 0 0 mm, hi: 12 8 8 mm}}}\n"      \
    "    - {name: column, material: sea, piston_mass: 74 kg/m2, piston_velocity: 10 m/s, tube_length: 50 mm,\n"    \
    "       shape: {box: {lo: 0 0 0 mm, hi: 10 6 6 mm}}}\n"                                                        \
    "  contacts:\n    - {default: frictionless}\n"                                                                 \
    "    - {between: [plate, wall], law: coulomb, bond_strength: 1 TPa}\n"                                         \
    "  window: {x: {lo: -3 mm, hi: 18 mm, fine_lo: -3 mm, fine_hi: 18 mm}, y: {lo: 0 mm, hi: 8 mm}, z: {lo: 0 "    \
    "mm, hi: 8 mm}}\n"                                                                                             \
    "  boundary: {y: [symmetry, free], z: [symmetry, free]}\noutput: {snapshots: 0, report: no}\n"

/* The bore is 12 x 12 mm: the piston weighs 74 kg/m2 on it.  No force on the plate is above twice that of the wave, the
 * wave has given no more impulse than the piston had, and the water has cavitated behind the plate. */
static void test_water(void **state)
{
    (void)state;
    cJSON *s = struck("water", WATER, "");
    const double area = 144e-6, mass = 74.0 * area, first = 1000.0 * (1480.0 + 1.92 * 20.0) * 20.0;
    assert_true(number(s, "impact_velocity") == 20.0);
    assert_true(fabs(number(s, "projectile_mass") / mass - 1.0) < 0.01);
    assert_true(fabs(number(s, "energy_arrival") / (200.0 * mass) - 1.0) < 0.01);
    assert_true(number(s, "peak_force") > 0.5 * first * area && number(s, "peak_force") < 2.1 * first * area);
    assert_true(number(s, "impulse") > 0.2 * mass * 20.0 && number(s, "impulse") < 2.0 * mass * 20.0);
    assert_true(number(s, "deflection") > 1e-5 && number(s, "hole_diameter") == 0.0);
    assert_true(number(s, "cavitated_volume") > 0.0 && number(s, "cavitated_volume") < area * 10e-3 * 1.5);
    assert_true(number(s, "energy_absorbed") > 0.0 && number(s, "energy_absorbed") < number(s, "energy_arrival"));
    print_message("water: %s, %.3g N, %.3g N s, %.3g mm, %.3g mm3 cavitated\n",
                  cJSON_GetObjectItemCaseSensitive(s, "class")->valuestring, number(s, "peak_force"),
                  number(s, "impulse"), 1e3 * number(s, "deflection"), 1e9 * number(s, "cavitated_volume"));
    cJSON_Delete(s);
    assert_int_equal(
        run("strike water -o water/thin --quiet --set 'scene.window.x={lo: -3 mm, hi: 18 mm, fine_lo: -3 mm, "
            "fine_hi: 18 mm, cell: 1.1 mm}'"),
        2);
    assert_true(contains("err.txt", "1.8 cells of 0.0011 m there: water leaks through fewer than two"));
}

/* Water pierces nothing: the limit lies between arrivals that hold the plate and those that tear it, and both ends of
 * the bracket are what they are said to be.  Up to 100 m/s none tears. */
static void test_water_limit(void **state)
{
    (void)state;
    if (!heavy_tests()) skip();
    const char *search = "--set strike.limit=yes --set study.velocity_low='20 m/s' --set study.velocity_high='400 m/s' "
                         "--set study.velocity_interval=0.2 --set study.max_scenes=8 --set scene.end_time='60 us'";
    cJSON *s = struck("water_limit", WATER, search);
    const cJSON *bracket = cJSON_GetObjectItemCaseSensitive(s, "limit_interval"), *a;
    assert_true(cJSON_IsNumber(cJSON_GetArrayItem(bracket, 0)) && cJSON_IsNumber(cJSON_GetArrayItem(bracket, 1)));
    const double lo = cJSON_GetArrayItem(bracket, 0)->valuedouble, hi = cJSON_GetArrayItem(bracket, 1)->valuedouble;
    bool holds = false, tears = false;
    assert_true(lo < number(s, "limit_velocity") && number(s, "limit_velocity") < hi && lo >= 20.0 && hi <= 400.0);
    cJSON_ArrayForEach(a, cJSON_GetObjectItemCaseSensitive(s, "arrivals"))
    {
        const char *class = cJSON_GetObjectItemCaseSensitive(a, "class")->valuestring;
        const double v = number(a, "impact_velocity");
        print_message("water at %g m/s: %s\n", v, class);
        if (v <= lo) assert_string_not_equal(class, "torn");
        if (v >= hi) assert_string_equal(class, "torn");
        holds = holds || (v == lo && strcmp(class, "bulged") == 0);
        tears = tears || v == hi;
    }
    assert_true(holds && tears);
    assert_true(cJSON_IsNull(cJSON_GetObjectItemCaseSensitive(s, "recht_ipson_factor")));
    cJSON_Delete(s);
    assert_int_equal(run("strike water_limit -o water_limit/low --quiet --threads 1 --set strike.limit=yes --set "
                         "study.velocity_low='10 m/s' --set study.velocity_high='60 m/s' --set study.max_scenes=6"),
                     0);
    assert_true(contains("water_limit/low/summary.json", "nothing up to there tears the plate"));
}

static void test_refused(void **state)
{
    (void)state;
    write_case("bad", HEAD("", "1 us") BODIES("ofhc_copper", PLATE));
    refused("strike.projectile=bal", "did you mean `ball`");
    refused("strike.plate=ball", "that is the projectile");
    refused("strike.plate=disk", "unknown body `disk` in strike");
    refused("strike.distance='3 m'", "strike.drag_coefficient is missing");
    refused("'scene.bodies[1].velocity=0 0 0 m/s'", "strike.velocity is missing");
    refused("'scene.bodies[1].velocity=100 100 0 m/s'", "flies into the mirror plane at scene.window.y.lo");
    refused("'scene.bodies[1].velocity=100 100 0 m/s' --set strike.plate=plate --set 'scene.window.y={lo: -5 mm, hi: 5 "
            "mm}' --set 'scene.boundary.y=[absorbing, absorbing]'",
            "turn the plate instead (shape: {turn: {axis: 0 0 1, angle: 30 deg, of: ..}}), or leave out strike.plate");
    refused("scene.end_time=none", "scene.end_time is missing");
    refused("'scene.bodies[1].held=yes' --set 'scene.bodies[1].velocity=0 0 0 m/s' --set strike.velocity='100 m/s'",
            "scene.bodies[1].velocity: body `ball` is held"); /* so it cannot fly */
    refused("'scene.window.x={lo: -1.9 mm, hi: 8 mm}'", "reaches 0.00015 m out of the window at scene.window.x.lo");
    refused("'scene.window.x={lo: -4 mm, hi: -0.01 mm}'", "plate lies at x = 0 .. 0.002 m, out of the window");
    refused("'scene.bodies[1].shape={sphere: {center: -0.5 0 0 mm, radius: 1 mm}}'", "ball overlaps plate");
    refused("'scene.probes=[{name: projectile_way, energy: ball}]'", "adds a probe of that name");
    refused("'scene.bodies[1].group=one' --set 'scene.bodies[0].group=one' --set scene.contacts=[]",
            "there is no target");
    assert_int_equal(run("strike bad -o bad/grids --quiet --set study.ensemble=3"), 2);
    assert_true(contains("err.txt", "a strike is computed on one grid"));
    assert_int_equal(run("strike " SHOT " -o bad/out --quiet"), 2);
    assert_true(contains("err.txt", "section `strike` is missing: `breech strike` needs it"));
    assert_int_equal(run("strike " SHOT " -o bad/out --quiet --set strike.projectile=ball"), 2);
    assert_true(contains("err.txt", "scene.bodies is missing: `breech strike` needs"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_flight),      cmocka_unit_test(test_package),   cmocka_unit_test(test_class),
        cmocka_unit_test(test_scene),       cmocka_unit_test(test_classes),   cmocka_unit_test(test_hole),
        cmocka_unit_test(test_not_yet_all), cmocka_unit_test(test_parts),     cmocka_unit_test(test_recht_ipson),
        cmocka_unit_test(test_limit),       cmocka_unit_test(test_from_shot), cmocka_unit_test(test_shipped),
        cmocka_unit_test(test_charge),      cmocka_unit_test(test_refused),   cmocka_unit_test(test_water),
        cmocka_unit_test(test_losses),      cmocka_unit_test(test_room),      cmocka_unit_test(test_water_limit),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
