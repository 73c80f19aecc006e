/* SPDX-License-Identifier: BSD-3-Clause */
/* Materials: the impedance match against tabulated and closed answers, what a study needs, derived constants. */
#include "mpm/material.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "near_common.h"

#ifndef BREECH_TESTS
#define BREECH_TESTS "tests"
#endif

static mpm_material blank(const char *name)
{
    mpm_material m;
    base_params_default(mpm_material_params, &m);
    snprintf(m.name, sizeof m.name, "%s", name);
    return m;
}

static mpm_material with_hugoniot(const char *name, double density, double sound_speed, double slope)
{
    mpm_material m = blank(name);
    m.density = density;
    m.sound_speed = sound_speed;
    m.hugoniot_slope = slope;
    return m;
}

/* The equations of state that the table names: Steinberg, UCRL-MA-106439. */
static mpm_material by_name(const char *name)
{
    if (strcmp(name, "al7075_t651") == 0) return with_hugoniot(name, 2804.0, 5200.0, 1.36);
    assert_string_equal(name, "ofhc_copper");
    return with_hugoniot(name, 8930.0, 3940.0, 1.489);
}

/* Tolerance: half a unit of the table's last digit, 0.005 GPa and 0.5 m/s. */
static void test_table(void **state)
{
    (void)state;
    FILE *f = fopen(BREECH_TESTS "/data/impedance_match.csv", "r");
    assert_non_null(f);
    char line[300];
    int rows = 0;
    while (fgets(line, sizeof line, f)) {
        char flyer_name[40], target_name[40];
        double v, p_table, u_table, p, u;
        if (sscanf(line, "%39[^,],%39[^,],%lf,%lf,%lf", flyer_name, target_name, &v, &p_table, &u_table) != 5) continue;
        const mpm_material flyer = by_name(flyer_name), target = by_name(target_name);
        assert_int_equal(mpm_impedance_match(&flyer, &target, v, &p, &u).code, STATUS_OK);
        if (fabs(p / 1e9 - p_table) > 0.005 + 1e-9 || fabs(u - u_table) > 0.5 + 1e-9)
            fail_msg("%s on %s at %g m/s: %.4f GPa, %.2f m/s; table %.2f, %.0f", flyer_name, target_name, v, p / 1e9, u,
                     p_table, u_table);
        rows++;
    }
    fclose(f);
    assert_int_equal(rows, 7);
}

/* A projectile on water: 1 % of the published device's table, which is rounded to three digits. */
static void test_on_water(void **state)
{
    (void)state;
    const double speed[] = { 100, 500, 1000, 1933 };
    const double want[2][4] = { { 148e6, 1000e6, 2560e6, 6680e6 }, { 159e6, 1117e6, 2980e6, 8200e6 } };
    const mpm_material water = with_hugoniot("water", 1000, 1480, 1.92);
    const mpm_material metal[] = { by_name("al7075_t651"), with_hugoniot("steel", 7850, 4570, 1.5) };
    for (int k = 0; k < 2; k++)
        for (int i = 0; i < 4; i++) {
            double p, u;
            assert_int_equal(mpm_impedance_match(&metal[k], &water, speed[i], &p, &u).code, STATUS_OK);
            print_message("%s on water at %g m/s: %.4g MPa (%.4g)\n", metal[k].name, speed[i], 1e-6 * p,
                          1e-6 * want[k][i]);
            assert_near(p / want[k][i], 1, 0.01);
        }
}

/* Both Hugoniots give the same p at the same interface velocity, for any pair; a material on itself takes half the
 * speed; swapping the pair swaps the velocities.  Tolerance: rounding of a few operations. */
static void test_laws(void **state)
{
    (void)state;
    const mpm_material list[] = {
        with_hugoniot("light", 1850.0, 8000.0, 1.12),   with_hugoniot("aluminium", 2804.0, 5200.0, 1.36),
        with_hugoniot("copper", 8930.0, 3940.0, 1.489), with_hugoniot("tungsten", 19220.0, 4030.0, 1.237),
        with_hugoniot("linear", 5000.0, 3000.0, 0.0),
    };
    const int n = sizeof list / sizeof list[0];
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++)
            for (double v = 0.0; v <= 5000.0; v += 250.0) {
                double p, u, p_back, u_back;
                assert_int_equal(mpm_impedance_match(&list[i], &list[j], v, &p, &u).code, STATUS_OK);
                assert_int_equal(mpm_impedance_match(&list[j], &list[i], v, &p_back, &u_back).code, STATUS_OK);
                const double w = v - u;
                const double p_flyer = list[i].density * (list[i].sound_speed + list[i].hugoniot_slope * w) * w;
                assert_near(p, p_flyer, 1e-11 * p + 1e-9);
                assert_near(p, p_back, 1e-11 * p + 1e-9);
                assert_near(u + u_back, v, 1e-11 * v);
                if (i == j) assert_near(u, 0.5 * v, 1e-12 * v);
            }
}

static void test_match_refuses(void **state)
{
    (void)state;
    const mpm_material good = by_name("ofhc_copper");
    mpm_material bad = good;
    snprintf(bad.name, sizeof bad.name, "unobtainium");
    bad.hugoniot_slope = NAN;
    double p, u;
    const status missing = mpm_impedance_match(&good, &bad, 1000.0, &p, &u);
    assert_int_equal(missing.code, STATUS_BAD_INPUT);
    assert_non_null(strstr(missing.text, "unobtainium"));
    assert_int_equal(mpm_impedance_match(&good, &good, -1.0, &p, &u).code, STATUS_BAD_INPUT);
    assert_int_equal(mpm_impedance_match(&good, &good, NAN, &p, &u).code, STATUS_BAD_INPUT);
}

/* OFHC copper with everything a scene needs. */
static mpm_material copper(void)
{
    mpm_material m = by_name("ofhc_copper");
    m.density = 8960.0, m.youngs_modulus = 124e9, m.poisson = 0.34, m.specific_heat = 383.0;
    m.reference_temperature = 293.0, m.melting_temperature = 1356.0;
    m.yield_A = 90e6, m.hardening_B = 292e6, m.hardening_n = 0.31, m.rate_C = 0.025, m.softening_m = 1.09,
    m.rate_0 = 1.0;
    m.gruneisen = 2.02;
    return m;
}

static void test_needs(void **state)
{
    (void)state;
    mpm_material m = copper();
    assert_int_equal(mpm_material_check(&m, MPM_MATERIAL_FOR_SCENE).code, STATUS_OK);
    assert_int_equal(mpm_material_check(&m, 0).code, STATUS_OK);
    const status damage = mpm_material_check(&m, MPM_MATERIAL_FOR_SCENE | MPM_MATERIAL_FOR_DAMAGE);
    assert_int_equal(damage.code, STATUS_BAD_INPUT);
    const char *const all[] = { "ofhc_copper", "damage_D1", "damage_D2", "damage_D3", "damage_D4", "damage_D5" };
    for (int i = 0; i < 6; i++) assert_non_null(strstr(damage.text, all[i]));
    assert_null(strstr(damage.text, "yield_A"));
    assert_non_null(strstr(mpm_material_check(&m, MPM_MATERIAL_FOR_SCREEN).text, "hardness"));
    assert_non_null(strstr(mpm_material_check(&m, MPM_MATERIAL_FOR_MELTING).text, "latent_heat"));
    assert_non_null(strstr(mpm_material_check(&m, MPM_MATERIAL_FOR_CIRCUIT).text, "resistivity"));
    m.poisson = 0.7;
    assert_non_null(strstr(mpm_material_check(&m, MPM_MATERIAL_FOR_SCENE).text, "poisson"));
    m = copper();
    m.melting_temperature = 290.0;
    assert_non_null(strstr(mpm_material_check(&m, MPM_MATERIAL_FOR_SCENE).text, "melting_temperature"));
}

/* ---- what the laws ask for ---- */

/* A line of the three tables of laws: a law, then what it says of constants. */
typedef struct {
    const char *law, *key;
    size_t offset;
    double fallback;
} law_line;

#define OWN(member, unit, fallback, least, largest, text) { NULL, #member, offsetof(mpm_material, member), fallback },
#define OTHER(member) { NULL, #member, offsetof(mpm_material, member), REQUIRED },

static const law_line law_lines[3][200] = {
    {
#define STRENGTH(name, shear, text) { .law = #name },
#define CONSTANT OWN
#define NEEDS OTHER
#include "mpm/law/strength.def"
    },
    {
#define EOS(name, text) { .law = #name },
#define CONSTANT OWN
#define NEEDS OTHER
#include "mpm/law/eos.def"
    },
    {
#define FAILURE(name, text) { .law = #name },
#define CONSTANT OWN
#define NEEDS OTHER
#include "mpm/law/failure.def"
    },
};

static double *constant_of(mpm_material *m, size_t offset)
{
    return (double *)(void *)((char *)m + offset);
}

static bool names(const char *text, const char *key)
{
    const size_t n = strlen(key);
    for (const char *at = text; (at = strstr(at, key)); at += n)
        if (at[-1] == ' ' && (at[n] == ',' || at[n] == '\0')) return true;
    return false;
}

/* Each constant that a law requires, taken away alone from a material that has everything, is refused by name where the
 * material has that law, and no other is: those it can do without, and those of the laws that it has not chosen. */
static void check_needs(int table, int kind, const law_line *line)
{
    mpm_material full = blank("full");
    for (const base_param *p = mpm_material_params; p->key; p++)
        if (p->kind == BASE_PARAM_NUMBER) *constant_of(&full, p->offset) = 0.5 * (p->min + p->max);
    full.melting_temperature = 4e3, full.reference_temperature = 300;
    *(table == 0 ? &full.strength : table == 1 ? &full.eos : &full.failure) = kind;
    const unsigned needs = table == 2 ? MPM_MATERIAL_FOR_DAMAGE : MPM_MATERIAL_FOR_SCENE;
    if (mpm_material_check(&full, needs).code != STATUS_OK) fail_msg("%s", mpm_material_check(&full, needs).text);
    for (const law_line *own = line + 1; own->key; own++) {
        mpm_material less = full;
        *constant_of(&less, own->offset) = NAN;
        const status s = mpm_material_check(&less, needs);
        assert_int_equal(s.code, isinf(own->fallback) ? STATUS_BAD_INPUT : STATUS_OK);
        if (s.code != STATUS_OK && !names(s.text, own->key)) fail_msg("%s is not in: %s", own->key, s.text);
        if (isfinite(own->fallback)) {
            const mpm_material m = mpm_material_complete(&less);
            assert_near(*constant_of((mpm_material *)&m, own->offset), own->fallback, 0.0);
        }
    }
    mpm_material other = full;
    for (const law_line *q = law_lines[table]; q->law || q->key; q++) { /* what only others of its table ask for */
        bool own = false;
        for (const law_line *r = line + 1; r->key; r++) own = own || (q->key && r->offset == q->offset);
        if (q->key && !own && q->offset >= offsetof(mpm_material, resistivity_slope))
            *constant_of(&other, q->offset) = NAN;
    }
    assert_int_equal(mpm_material_check(&other, needs).code, STATUS_OK);
}

static void test_laws_ask(void **state)
{
    (void)state;
    int laws = 0;
    for (int table = 0; table < 3; table++) {
        int kind = 0;
        for (const law_line *line = law_lines[table]; line->law || line->key; line++)
            if (line->law) check_needs(table, kind++, line), laws++;
    }
    assert_true(laws >= 5);
}

/* A material of which nothing is known: the whole list of what it lacks fits the message. */
static void test_every_constant(void **state)
{
    (void)state;
    const unsigned every = MPM_MATERIAL_FOR_SCENE | MPM_MATERIAL_FOR_DAMAGE | MPM_MATERIAL_FOR_SCREEN |
                           MPM_MATERIAL_FOR_MELTING | MPM_MATERIAL_FOR_CIRCUIT;
    const char *const always[] = {
        "density",     "specific_heat", "reference_temperature", "melting_temperature", "latent_heat", "hardness",
        "resistivity", "sound_speed",   "hugoniot_slope",        "gruneisen",           "damage_D1",   "damage_D5",
        "rate_0"
    };
    const char *const johnson_cook[] = { "yield_A", "hardening_B", "hardening_n", "rate_C", "softening_m" };
    const char *const ptw[] = { "ptw_theta", "ptw_p", "ptw_kappa", "ptw_alpha", "molar_mass" };
    for (int other = 0; other < 2; other++) {
        mpm_material none = blank("empty");
        none.strength = other ? MPM_STRENGTH_ptw : MPM_STRENGTH_johnson_cook;
        const status bad = mpm_material_check(&none, every);
        assert_int_equal(bad.code, STATUS_BAD_INPUT);
        for (size_t i = 0; i < sizeof always / sizeof always[0]; i++) assert_true(names(bad.text, always[i]));
        for (int i = 0; i < 5; i++) {
            assert_int_equal(names(bad.text, johnson_cook[i]), !other);
            assert_int_equal(names(bad.text, ptw[i]), other);
        }
        assert_false(names(bad.text, "ptw_cold_work") || names(bad.text, "conductivity"));
    }
}

/* OFHC copper by hand: K = 8960 x 3940^2 = 139.09 GPa, G = 124 / 2.68 = 46.269 GPa; 1e-4: the digits written here. */
static void test_derived(void **state)
{
    (void)state;
    const mpm_material m = copper();
    assert_near(mpm_material_bulk_modulus(&m), 139.0915e9, 1e-4 * 139e9);
    assert_near(mpm_material_shear_modulus(&m), 46.2687e9, 1e-4 * 46e9);
    assert_near(mpm_material_longitudinal_speed(&m), 4733.5, 1e-4 * 4733.5);
    assert_near(mpm_material_shear_speed(&m), 2272.4, 1e-4 * 2272.4);
    const mpm_material none = blank("empty");
    assert_true(isnan(mpm_material_shear_modulus(&none)) && isnan(mpm_material_bulk_modulus(&none)));
}

/* Every row of the table is well formed: a range, a text, a unit, and a member of its own. */
static void test_param_table(void **state)
{
    (void)state;
    size_t rows = 0;
    for (const base_param *p = mpm_material_params; p->key; p++, rows++) {
        assert_true(p->doc && p->unit && p->key[0]);
        if (p->kind == BASE_PARAM_NUMBER) assert_true(p->min < p->max);
        for (const base_param *q = mpm_material_params; q != p; q++)
            assert_true(q->offset != p->offset && strcmp(q->key, p->key) != 0);
    }
    assert_int_equal(rows,
                     4 + (offsetof(mpm_material, own_strength) - offsetof(mpm_material, density)) / sizeof(double));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_table),          cmocka_unit_test(test_on_water), cmocka_unit_test(test_laws),
        cmocka_unit_test(test_match_refuses),  cmocka_unit_test(test_needs),    cmocka_unit_test(test_derived),
        cmocka_unit_test(test_every_constant), cmocka_unit_test(test_laws_ask), cmocka_unit_test(test_param_table),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
