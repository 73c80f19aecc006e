/* SPDX-License-Identifier: BSD-3-Clause */
/* Life of a launcher's rail: the heat of a passage against closed answers, what a passage takes, shots that differ, and
 * the program on the default shot. */
#include "base/constants.h"
#include "program_common.h"

#define CASE CASES "/rail_life"

static bool near(double got, double want, double within)
{
    return fabs(got - want) <= within * fabs(want);
}

/* ---- heat ---- */

static const life_heat_metal copper = { .conductivity = 400.0, .heat_capacity = 3.45e6, .resistivity = 1.7e-8 };

/* J m^-2 in the metal after `time`: trapezes. */
static double heat_in(const life_heat *h, double time)
{
    const double deep = 12.0 * sqrt(h->conducts * time);
    double sum = 0.5 * life_heat_rise(h, 0.0, time);
    for (int k = 1; k < 2000; k++) sum += life_heat_rise(h, deep * k / 2000, time);
    return copper.heat_capacity * sum * deep / 2000;
}

/* The contact's heat is all in the metal, then and later; the face has (C-7) when the contact leaves it and (C-17) one
 * dwell later; no film, no flux that warms the face beyond it. */
static void test_contact_heat(void **state)
{
    (void)state;
    const double dwell = 15e-6, q = 2e9, alone = 2.0 * q * sqrt(dwell / (PI * 400.0 * 3.45e6));
    const life_heat h = life_heat_of(&copper, dwell, q, 0.0, 1e5);
    assert_true(near(h.rise, alone, 1e-12) && near(life_heat_rise(&h, 0.0, dwell), alone, 1e-12));
    assert_true(near(life_heat_rise(&h, 0.0, 2.0 * dwell), alone * (sqrt(2.0) - 1.0), 1e-12));
    assert_true(near(heat_in(&h, 0.4 * dwell), 0.4 * q * dwell, 1e-4));
    assert_true(near(heat_in(&h, 3.0 * dwell), q * dwell, 1e-4));
    assert_true(life_heat_rise(&h, 0.0, 0.0) == 0.0 && life_heat_rise(&h, 0.0, -dwell) == 0.0);
    const life_heat capped = life_heat_of(&copper, dwell, q, 0.0, 0.3 * alone);
    assert_true(near(life_heat_rise(&capped, 1e-5, dwell), 0.3 * life_heat_rise(&h, 1e-5, dwell), 1e-12));
    assert_true(life_heat_of(&copper, dwell, q, 0.0, -5.0).rise == 0.0); /* the film is colder than the rail */
}

/* d T / dt = mu0 K^2 / (pi rho c) exp(-z^2 / (2 D t)) / t from the dwell on: Simpson's rule in ln t. */
static void test_current_heat(void **state)
{
    (void)state;
    const double dwell = 15e-6, K = 1.5e7, D = 1.7e-8 / MU0, J = MU0 * K * K / (PI * 3.45e6);
    const life_heat h = life_heat_of(&copper, dwell, 0.0, K, 1e5);
    assert_true(near(life_heat_rise(&h, 0.0, 2.0 * dwell), J * log(2.0), 1e-12)); /* (C-17) */
    assert_true(life_heat_rise(&h, 0.0, dwell) == 0.0);
    for (double z = 2e-4; z < 3e-3; z *= 2.0) {
        const int n = 400;
        const double end = 40.0 * dwell, step = log(end / dwell) / n;
        double sum = 0.0;
        for (int k = 0; k <= n; k++) {
            const double t = dwell * exp(step * k), f = exp(-z * z / (2.0 * D * t));
            sum += (k == 0 || k == n ? 1.0 : k % 2 ? 4.0 : 2.0) * step / 3.0 * f;
        }
        assert_true(near(life_heat_rise(&h, z, end), J * sum, 1e-6));
    }
    assert_true(life_heat_rise(&h, 0.1, 2.0 * dwell) == 0.0); /* out of its reach */
    /* the current's rise grows for ever; that of a flux at its face is over when the contact leaves, deeper it comes
     * later */
    const life_heat q = life_heat_of(&copper, dwell, 2e9, 0.0, 1e5);
    assert_true(near(life_heat_largest_rise(&h, 1e-3, 50.0 * dwell), life_heat_rise(&h, 1e-3, 50.0 * dwell), 1e-12));
    assert_true(near(life_heat_largest_rise(&q, 0.0, 50.0 * dwell), q.rise, 1e-12));
    const double deep = 1.5 * sqrt(q.conducts * dwell), most = life_heat_largest_rise(&q, deep, 50.0 * dwell);
    assert_true(most > 1.02 * life_heat_rise(&q, deep, dwell) && most > 1.02 * life_heat_rise(&q, deep, 3.0 * dwell));
}

static void test_heat_strain(void **state)
{
    (void)state;
    double strain[3];
    life_heat_strain(300.0, 17e-6, 0.34, strain);
    assert_true(near(strain[0], -5.1e-3, 1e-12) && near(strain[1], 5.1e-3 * 0.68 / 0.66, 1e-12) && strain[2] == 0.0);
}

/* ---- the load ---- */

static void test_load(void **state)
{
    (void)state;
    for (double rounding = 0.1; rounding < 1.01; rounding += 0.3) {
        const contact_load l = life_contact_armature(8e-3, rounding, 50e6, 0.2);
        double normal, tangential;
        life_contact_forces(&l, &normal, &tangential);
        assert_true(near(normal, 50e6 * 16e-3, 1e-12) && near(tangential, 0.2 * normal, 1e-12));
        assert_true(fabs(life_contact_pressure(&l, -8e-3)) < 1e-6 && fabs(life_contact_traction(&l, 8e-3)) < 1e-6);
        assert_true(near(life_contact_pressure(&l, 1e-9), l.peak, 1e-6));
        assert_true(near(life_contact_pressure(&l, 8e-3 * (1.0 - 0.5 * rounding)), 0.5 * l.peak, 1e-9));
    }
}

/* ---- a passage ---- */

static life_rail rail_of(fatigue_measure measure)
{
    return (life_rail){ .youngs = 124e9,
                        .poisson = 0.34,
                        .density = 8960.0,
                        .expansion = 17e-6,
                        .law = { 9.0, 2.0, 0.0 },
                        .fan = mpm_fatigue_fan_even(4),
                        .measure = measure,
                        .limit = 0.5,
                        .half_length = 8e-3,
                        .rounding = 0.5 };
}

static double range_of(const life_rail *r, const double *rate, int depth, int direction)
{
    return pow(rate[depth * r->fan.n + direction] / r->law.A, 1.0 / r->law.m);
}

typedef struct {
    double of[LIFE_CAUSES][LIFE_DEPTHS * 4];
} rates;

static void passed(const life_rail *r, const life_passage *p, rates *out)
{
    double *const of[LIFE_CAUSES] = { out->of[0], out->of[1], out->of[2] };
    life_along_passage(r, p, of);
}

/* Without friction the stress along the face under a pressure p is -K p, whatever the profile; the table of K is in
 * test_life.  0.25, 0.5 and 0.8 of the speed of Rayleigh waves. */
static void test_moving_load(void **state)
{
    (void)state;
    const life_rail r = rail_of(FATIGUE_BOND);
    const double cR = life_contact_rayleigh(r.youngs, r.poisson, r.density), nu = r.poisson;
    static const double share[] = { 1e-6, 0.25, 0.5, 0.8 };
    rates of;
    for (int k = 0; k < 4; k++) {
        const double v = share[k] * cR;
        const contact_speed speed = life_contact_speed(r.youngs, nu, r.density, v);
        const double K = k == 0 ? 1.0 : life_contact_factor(&speed), p = 60e6 / 0.75;
        const life_passage passage = { v, 60e6, 0.0, life_heat_of(&copper, 16e-3 / v, 0.0, 0.0, 0.0), 32e-3 / v };
        passed(&r, &passage, &of);
        const double want = (1.0 + nu) / r.youngs * p * ((1.0 - nu) * K - nu);
        assert_true(near(range_of(&r, of.of[LIFE_BY_CONTACT], 0, 0), want, 1e-6));
        assert_memory_equal(of.of[LIFE_BY_BOTH], of.of[LIFE_BY_CONTACT], sizeof of.of[0]);
        assert_true(of.of[LIFE_BY_HEAT][0] == 0.0);
    }
}

/* Friction drags the rail along with the load, +x: metal behind the trailing edge is stretched, so that without a sign
 * and by tension a passage takes more life than without friction, and heat, which compresses along the face, takes
 * some of that away. */
static void test_signs(void **state)
{
    (void)state;
    const life_rail r = rail_of(FATIGUE_TENSION);
    const double v = 500.0, dwell = 16e-3 / v;
    life_passage p = { v, 60e6, 0.0, life_heat_of(&copper, dwell, 0.0, 0.0, 0.0), 4.0 * dwell };
    rates smooth, rough, warm;
    passed(&r, &p, &smooth);
    p.friction = 0.3;
    passed(&r, &p, &rough);
    assert_true(range_of(&r, rough.of[0], 0, 0) > range_of(&r, smooth.of[0], 0, 0) + 1e-4);
    p.heat = life_heat_of(&copper, dwell, 3e8, 0.0, 1e5);
    passed(&r, &p, &warm);
    assert_true(range_of(&r, warm.of[LIFE_BY_HEAT], 0, 0) == 0.0); /* compressed along the face, stretched across */
    assert_true(near(range_of(&r, warm.of[LIFE_BY_HEAT], 0, 2), 17e-6 * p.heat.rise * 0.68 / 0.66, 1e-9));
    /* where the drag stretches most the contact has been and has left its heat; ahead of it nothing is warm */
    assert_true(range_of(&r, warm.of[0], 0, 0) < 0.5 * range_of(&r, rough.of[0], 0, 0));
}

/* The range of heat alone: of the face expansion times rise; deeper less, but more than the contact's where the current
 * reaches. */
static void test_heat_alone(void **state)
{
    (void)state;
    const life_rail r = rail_of(FATIGUE_BOND);
    const double dwell = 16e-6;
    const life_passage p = { 1000.0, 1.0, 0.0, life_heat_of(&copper, dwell, 2e10, 0.0, 300.0), 10.0 * dwell };
    rates of;
    passed(&r, &p, &of);
    assert_true(near(range_of(&r, of.of[LIFE_BY_HEAT], 0, 0), 17e-6 * 300.0, 1e-12));
    assert_true(near(range_of(&r, of.of[LIFE_BY_BOTH], 0, 0), 17e-6 * 300.0, 1e-6));
    for (int j = 1; j < LIFE_DEPTHS; j++)
        assert_true(range_of(&r, of.of[LIFE_BY_HEAT], j, 0) <= range_of(&r, of.of[LIFE_BY_HEAT], j - 1, 0));
    assert_true(life_along_depth(&r, 0) == 0.0 && near(life_along_depth(&r, LIFE_DEPTHS - 1), 12e-3, 1e-12));
}

/* ---- shots ---- */

/* Four directions, two of which make a crack.  Three shots of one kind, then another kind for good. */
static void test_shots(void **state)
{
    (void)state;
    const life_rail r = rail_of(FATIGUE_BOND);
    static double weak[LIFE_DEPTHS * 4], strong[LIFE_DEPTHS * 4];
    static const int flight[] = { 0, 0, 0, 1 };
    const double *const of[] = { weak, strong };
    const life_shots shots = { 4, flight, of };
    const int at = 7 * 4; /* at the eighth depth alone */
    for (int k = 0; k < 4; k++) weak[at + k] = 0.1, strong[at + k] = 0.0;
    strong[at + 1] = 0.2, strong[at + 3] = 0.05;
    life_place is = life_along_place(&r, &shots, 1.0);
    assert_true(near(is.first, 3.0 + 0.7 / 0.2, 1e-12) && near(is.life, 3.0 + 0.7 / 0.05, 1e-12));
    assert_int_equal(is.depth_number, 7);
    assert_true(is.depth == life_along_depth(&r, 7) && is.angle == r.fan.angle[1]);
    assert_true(near(is.spent, 0.35, 1e-12)); /* of the second best: 3 x 0.1 + 0.05 */
    is = life_along_place(&r, &shots, 5.0);   /* cracks within the shots: 0.5 each */
    assert_true(near(is.life, 2.0, 1e-12) && near(is.spent, 1.75, 1e-12));
    is = life_along_place(&r, &shots, 0.0);
    assert_true(isinf(is.life) && isinf(is.first) && is.spent == 0.0 && isnan(is.depth));
}

/* ---- the program ---- */

#define SMALL " --set life.places=3 --set output.report=no --set rail.level=skin --set options.rtol=1e-4 "
#define FEW SMALL "--quiet --threads 1 "

static void refused(const char *what, const char *words)
{
    char command[600];
    snprintf(command, sizeof command, "life -o bad --quiet %s", what);
    assert_refused(command, "bad", words);
}

static void test_refused(void **state)
{
    (void)state;
    assert_int_equal(system("rm -rf bad"), 0);
    refused(CASE " --set life.material=ofhc_copper_half_hard", "fatigue_A");
    refused(CASE " --set life.material=rail_steel_ma2020", "lacks its thermal expansion");
    refused(CASE " --set life.friction=0.3", "life.friction is that of load: wheel");
    refused(CASES "/rail_fatigue --set life.load=armature", "section `barrel` is missing");
    refused(CASE " --set armature.contact_length='3 m'", "must be shorter than the barrel");
    refused(CASE " --set barrel.length='0.11 m'", "must be shorter than the armature's way");
    refused(CASE " --set study.shots=20", "melts at 1356 K");
    assert_int_equal(run("check " CASE " --set study.shots=20"), 2); /* by the same test */
    assert_true(contains("err.txt", "--set study.shots=20: study.shots: shot "));
    assert_int_equal(run("check " CASE " --set study.shots=20 --set study.heat_kept=0.5"), 0);
}

static const cJSON *place_of(const cJSON *s, int k)
{
    const cJSON *list = cJSON_GetObjectItemCaseSensitive(s, "life_along");
    assert_true(cJSON_IsArray(list));
    return cJSON_GetArrayItem(list, k);
}

static double element(const cJSON *s, const char *key, int k)
{
    const cJSON *item = cJSON_GetArrayItem(cJSON_GetObjectItemCaseSensitive(s, key), k);
    return cJSON_IsNumber(item) ? item->valuedouble : NAN;
}

/* Quantiles are those of a log-normal A; the muzzle is the last place; heat rules, and its range is at least that of
 * the film's warmth. */
static void test_program(void **state)
{
    (void)state;
    fresh_folder("rail");
    assert_int_equal(run("life " CASE " -o rail/out --quiet --threads 1 --set life.places=3 --set "
                         "life.probe_depth='0 mm'"),
                     0);
    cJSON *s = summary_of("rail/out");
    const cJSON *muzzle = place_of(s, 2), *fired = cJSON_GetObjectItemCaseSensitive(s, "shot");
    const double life = number(s, "life"), spread = exp(1.6448536269514722 * 1.1);
    assert_text(s, "kind", "rail_life");
    assert_text(s, "life_cause", "heat");
    assert_true(near(element(s, "life_quantiles", 0), life / spread, 1e-9));
    assert_true(near(element(s, "life_quantiles", 1), life, 1e-12));
    assert_true(near(element(s, "life_quantiles", 2), life * spread, 1e-9));
    assert_true(near(number(muzzle, "velocity"), number(fired, "muzzle_velocity"), 1e-3));
    assert_true(number(muzzle, "position") == 3.0 && number(muzzle, "rise") < number(muzzle, "flux_rise"));
    assert_true(number(s, "life_range") >= 17e-6 * number(muzzle, "rise") && number(s, "life_depth") == 0.0);
    assert_true(number(s, "life_without_heat") > 10.0 * life && number(s, "without_heat_depth") > 1e-3);
    assert_true(near(number(muzzle, "probe_rise"), number(muzzle, "rise"), 1e-12)); /* that of the face */
    assert_true(contains("rail/out/report.html", "by the heat of the passage"));
    cJSON_Delete(s);
}

/* Slow waves: the muzzle's speed is beyond them.  Warmer rails shot after shot, each with a flight of its own.  Without
 * heat no rise counts, and A's spread is not asked for. */
static void test_options(void **state)
{
    (void)state;
    fresh_folder("more");
    assert_int_equal(run("life " CASE " -o more/soft" FEW "--set 'materials[0].youngs_modulus=70 GPa'"), 0);
    cJSON *s = summary_of("more/soft");
    assert_text(place_of(s, 2), "cause", "faster than Rayleigh waves");
    assert_true(isnan(number(place_of(s, 2), "life")) && number(s, "life") > 0.0);
    assert_true(number(s, "rayleigh_position") > 1.0 && number(s, "rayleigh_speed") < 1650.0);
    cJSON_Delete(s);
    assert_true(contains("more/soft/summary.json", "faster than Rayleigh waves in copper_assumed"));
    assert_false(contains("more/soft/summary.json", "would flow away"));
    assert_int_equal(run("life " CASE " -o more/softer" FEW "--set 'materials[0].hardness=10 MPa'"), 0);
    assert_true(contains("more/softer/summary.json", "more than copper_assumed carries, 0.01 GPa (its hardness)"));
    assert_int_equal(run("life " CASE " -o more/shots" FEW "--set study.shots=2 --set life.heat=no --set "
                         "materials[0].fatigue_A_spread=none"),
                     0);
    s = summary_of("more/shots");
    assert_true(number(s, "flights") == 2.0 && number(s, "shots") == 2.0);
    assert_true(number(place_of(s, 1), "life") > 0.0 && isnan(element(s, "life_quantiles", 1)));
    assert_true(number(place_of(s, 1), "life") != number(place_of(s, 1), "without_heat")); /* that of like shots */
    assert_true(near(number(place_of(s, 1), "life"), number(place_of(s, 1), "without_heat"), 0.1));
    assert_true(isnan(number(s, "probability_cracked")));
    cJSON_Delete(s);
    static const struct {
        const char *set;
        double want;
    } known[] = { { "materials[0].fatigue_limit=0.1", 0.0 }, /* lasts for good */
                  { "materials[0].fatigue_A_spread=0 --set study.shots=2", 0.0 } };
    for (int k = 0; k < 2; k++) {
        char line[400];
        snprintf(line, sizeof line, "life " CASE " -o more/known%d" FEW "--set %s", k, known[k].set);
        assert_int_equal(run(line), 0);
        s = summary_of(k ? "more/known1" : "more/known0");
        assert_true(number(s, "probability_cracked") == known[k].want);
        cJSON_Delete(s);
    }
}

/* An armature that nothing moves says nothing of the rail's life. */
static void test_never_moved(void **state)
{
    (void)state;
    fresh_folder("still");
    assert_int_equal(run("life " CASE " -o still/out" FEW "--set 'bank.charge=10 V'"), 0);
    cJSON *s = summary_of("still/out");
    assert_string_equal(cJSON_GetStringValue(cJSON_GetObjectItem(s, "life_cause")), "not reached");
    assert_true(cJSON_IsNull(cJSON_GetObjectItem(s, "life")));
    cJSON_Delete(s);
    assert_true(contains("still/out/summary.json", "no place along the barrel is passed by a moving armature"));
}

/* used.yaml has the keys of its load alone, whatever the command; read back it is the same case. */
static void test_used(void **state)
{
    (void)state;
    fresh_folder("used");
    assert_int_equal(run("life " CASE " -o used/one" FEW), 0);
    assert_int_equal(run("life used/one/used.yaml -o used/two --quiet --threads 1"), 0);
    cJSON *one = summary_of("used/one"), *two = summary_of("used/two");
    assert_true(number(one, "life") == number(two, "life") && number(one, "life") > 0.0);
    cJSON_Delete(one), cJSON_Delete(two);
    assert_int_equal(system("tail -n +2 used/one/used.yaml >1.txt && tail -n +2 used/two/used.yaml | cmp - 1.txt"), 0);
    assert_int_equal(run("shot " CASE " -o used/shot --quiet --threads 1 --set rail.level=skin"), 0);
    assert_int_equal(run("check used/shot/used.yaml"), 0);
}

/* The last was stopped before its second shot. */
static void test_same_bits(void **state)
{
    (void)state;
    fresh_folder("bits");
    cJSON *s = same_on_threads("life " CASE SMALL "--set study.shots=2", "bits/shots");
    assert_true(number(s, "life") > 0.0 && number(s, "flights") == 2.0);
    cJSON_Delete(s);
}

/* ---- surfaces ---- */

#define TREATED                                                                                               \
    " --set 'treatments=[{name: plated, coating: [{material: copper_assumed, thickness: 0.5 mm}]}, "          \
    "{name: warm, preheat: {temperature: 450 K}}, {name: steel, coating: [{material: steel_4340, thickness: " \
    "0.5 mm}]}]' "

/* A warm rail is warmed less by the film and lasts longer; a layer of the metal that the case's life is of is the rail
 * as it is, tied; a metal without constants is not judged and comes last. */
static void test_surfaces(void **state)
{
    (void)state;
    fresh_folder("surfaces");
    assert_int_equal(run("compare " CASE " -o surfaces/out" FEW TREATED), 0);
    cJSON *s = summary_of("surfaces/out");
    assert_text(s, "kind", "compare_life");
    const cJSON *list = cJSON_GetObjectItemCaseSensitive(s, "ranking");
    static const char *const order[] = { "warm", "untreated", "plated", "steel" };
    static const double tied[] = { 1.0, 2.0, 2.0, 4.0 };
    assert_int_equal(cJSON_GetArraySize(list), 4);
    for (int k = 0; k < 4; k++) {
        assert_text(cJSON_GetArrayItem(list, k), "surface", order[k]);
        assert_true(number(cJSON_GetArrayItem(list, k), "tied") == tied[k]);
    }
    const cJSON *warm = cJSON_GetArrayItem(list, 0), *plain = cJSON_GetArrayItem(list, 1);
    assert_true(number(warm, "better_than_next") == 1.0 && number(plain, "better_than_next") == 0.5);
    assert_true(number(warm, "life") > 1.5 * number(plain, "life"));
    assert_true(isnan(number(cJSON_GetArrayItem(list, 3), "life")));
    assert_non_null(
        strstr(cJSON_GetObjectItemCaseSensitive(cJSON_GetArrayItem(list, 3), "lacks")->valuestring, "fatigue_A"));
    cJSON_Delete(s);
    assert_int_equal(run("compare " CASE " -o surfaces/none" FEW), 2); /* no treatments */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_contact_heat), cmocka_unit_test(test_current_heat), cmocka_unit_test(test_heat_strain),
        cmocka_unit_test(test_load),         cmocka_unit_test(test_moving_load),  cmocka_unit_test(test_signs),
        cmocka_unit_test(test_heat_alone),   cmocka_unit_test(test_shots),        cmocka_unit_test(test_refused),
        cmocka_unit_test(test_program),      cmocka_unit_test(test_options),      cmocka_unit_test(test_same_bits),
        cmocka_unit_test(test_surfaces),     cmocka_unit_test(test_never_moved),  cmocka_unit_test(test_used),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
