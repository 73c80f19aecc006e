/* SPDX-License-Identifier: BSD-3-Clause */
/* Every law of strength.def, eos.def and failure.def, with every material of cases/materials that has what it needs:
 * the laws that all must satisfy.  A law that no material can be given is an error here.  The kernel's own code is
 * compiled in, for the compiler's default instruction set.
 *
 * Tolerances: 1e-9 between the two forms of one formula (vector functions are good to 4 units in the last place, powers
 * lose some digits); 1e-6 where one has a rational approximation, or a difference stands for a derivative. */
#define BREECH_ISA law_test
#include "coupling/case/material_file.h"
#include "mpm_scenes.h"

#include "mpm/kernel/g2p.c"

#define MATERIALS BREECH_TESTS "/../cases/materials"

typedef struct {
    mpm_material *item;
    int n;
} shelf;

static int open_shelf(void **state)
{
    static const char *const dirs[] = { MATERIALS };
    static shelf s;
    char **names;
    int n;
    assert_ok(case_material_names(MATERIALS, &names, &n));
    s.item = calloc((size_t)n, sizeof *s.item);
    assert_non_null(s.item);
    for (s.n = 0; s.n < n; s.n++) {
        material_sheet sheet;
        char *errors = NULL;
        assert_ok(case_material_sheet_open(names[s.n], dirs, 1, &sheet, &errors));
        s.item[s.n] = sheet.material;
        case_material_sheet_free(&sheet);
    }
    case_material_names_free(names, n);
    *state = &s;
    return 0;
}

static int close_shelf(void **state)
{
    free(((shelf *)*state)->item);
    return 0;
}

/* The caller's own law: hardening that ends (Voce), rate and temperature. */
static const double own_yield = 250e6;

static double own_flow(const void *user, const mpm_strength_point *at)
{
    const double yield = *(const double *)user;
    return yield * (2 - exp(-5 * at->strain)) * (1 + 0.01 * at->log_rate) * (1 - 0.9 * at->T_star);
}

static law law_at(const mpm_material *m, double temperature, double scale)
{
    mpm_scene s;
    mpm_scene_default(&s);
    const bool damage = mpm_material_check(m, MPM_MATERIAL_FOR_DAMAGE).code == STATUS_OK;
    const mpm_body b = {
        .material = m, .temperature = temperature, .yield_scale = scale, .cold_work = NAN, .damage = damage
    };
    law k;
    assert_ok(mpm_law_make(&b, &s, &k));
    return k;
}

static law_form form(const law *k)
{
    return law_form_of(k, k->kernel);
}

typedef void material_test(const mpm_material *m);

/* Each material with each law of a table that it has the constants for. */
static void for_every(const shelf *s, size_t kind, const char *const *name, int laws, unsigned needs,
                      material_test *test)
{
    for (int chosen = 0; chosen < laws; chosen++) {
        int met = 0;
        for (int i = 0; i < s->n; i++) {
            mpm_material m = s->item[i];
            m.own_strength = (mpm_own_strength){ own_flow, &own_yield };
            *(int *)(void *)((char *)&m + kind) = chosen;
            if (mpm_material_check(&m, needs).code != STATUS_OK) continue;
            test(&m);
            met++;
        }
        if (!met) fail_msg("no material of cases/materials has the constants of `%s`: add them to one", name[chosen]);
    }
}

/* ---- strength ---- */

static double flow_at(const law *k, double strain, double rate, double T)
{
    const double log_rate = log(fmax(rate * k->inv_rate0, 1));
    const flow_state at = { .strain = vd_set(strain),
                            .log_rate = vd_set(log_rate),
                            .T = vd_set(T),
                            .T_star = homologous(k, vd_set(T)),
                            .rho = vd_set(k->rho0) };
    return flow_stress(k, form(k), &at)[0];
}

static void check_strength(const mpm_material *m)
{
    const law k = law_at(m, m->reference_temperature, 1), hard = law_at(m, m->reference_temperature, 1.5);
    const bool fluid = k.shear == MPM_SHEAR_NONE;
    const double top = fluid ? 1e3 : k.T_m;
    for (double T = k.T_r; T < 0.999 * top; T += 0.04 * (top - k.T_r))
        for (double rate = 1; rate < 1e8; rate *= 100) {
            double before = 0;
            for (double strain = 0; strain < 4; strain = 1.5 * strain + 0.01) {
                const double flow = flow_at(&k, strain, rate, T), slow = flow_at(&k, strain, rate / 10, T);
                const double bound = k.least_flow * (1 - (T - k.T_r) * k.inv_T_range);
                assert_true(fluid ? flow == 0 : flow > 0 && isfinite(flow));
                assert_true(flow >= before * (1 - 1e-9));
                assert_true(flow >= slow * (1 - 1e-6)); /* the error function's 1.5e-7 of an s0 that is 15 s_inf */
                assert_true(flow >= 0.99 * bound);
                if (!fluid) assert_near(flow_at(&hard, strain, rate, T) / flow, 1.5, 1e-9);
                before = flow;
            }
        }
    assert_near(flow_at(&k, 0.1, 1e4, 1e6), 0, 0); /* molten */
    assert_near(k.flow_start, flow_at(&k, 0, 1, k.T_r), 1e-6 * k.flow_start);
    assert_true(fluid ? k.G == 0 : k.G > 0);
    if (k.shear == MPM_SHEAR_VARIES)
        assert_near(shear_modulus(&k, vd_set(0), vd_set(k.rho0), vd_set(k.T_r))[0], k.G, 1e-9 * k.G);
}

/* A caller's function that is (M-1) gives what the law of the table gives; without a function there is no law. */
static double own_johnson_cook(const void *user, const mpm_strength_point *at)
{
    const mpm_material *m = user;
    return (m->yield_A + m->hardening_B * pow(at->strain, m->hardening_n)) * (1 + m->rate_C * at->log_rate) *
           (1 - pow(at->T_star, m->softening_m));
}

static void test_own_strength(void **state)
{
    (void)state;
    mpm_material m = scene_copper(), own = m;
    own.strength = MPM_STRENGTH_own;
    own.own_strength = (mpm_own_strength){ own_johnson_cook, &m };
    const law a = law_at(&m, 300, 1.3), b = law_at(&own, 300, 1.3);
    for (double T = 293; T < 1500; T += 100)
        for (double strain = 0.01; strain < 3; strain *= 2)
            assert_near(flow_at(&b, strain, 1e4, T), flow_at(&a, strain, 1e4, T), 1e-9 * a.flow_start);
    assert_near(b.flow_start, a.flow_start, 1e-9 * a.flow_start);
    assert_near(b.G, a.G, 0);
    own.own_strength.flow = NULL;
    mpm_scene s;
    law k;
    mpm_scene_default(&s);
    const mpm_body body = { .material = &own, .temperature = 300, .yield_scale = 1, .cold_work = NAN };
    assert_int_equal(mpm_law_make(&body, &s, &k).code, STATUS_BAD_INPUT);
}

/* Longitudinal sound at rest: of a law whose shear varies by its own constants. */
static void check_sound(const mpm_material *m)
{
    const law k = law_at(m, m->reference_temperature, 1);
    const double sg = m->sg_G0 * (1 - m->sg_B * (m->reference_temperature - 300));
    const double G = m->strength == MPM_STRENGTH_steinberg_guinan ? sg : k.shear == MPM_SHEAR_NONE ? 0 : k.G;
    if (m->strength == MPM_STRENGTH_steinberg_guinan || k.shear != MPM_SHEAR_VARIES)
        assert_near(k.rho0 * k.sound * k.sound / (k.K0 + 4.0 / 3.0 * G), 1, 1e-12);
    assert_true(k.shear == MPM_SHEAR_NONE || k.sound > 1.001 * sqrt(k.K0 / k.rho0));
}

static void test_strength(void **state)
{
    const char *const names[] = {
#define STRENGTH(name, shear, text) #name,
#include "mpm/law/strength.def"
    };
    for_every(*state, offsetof(mpm_material, strength), names, sizeof names / sizeof names[0], MPM_MATERIAL_FOR_SCENE,
              check_strength);
    for_every(*state, offsetof(mpm_material, strength), names, sizeof names / sizeof names[0], MPM_MATERIAL_FOR_SCENE,
              check_sound);
}

/* ---- equation of state ---- */

static double p_at(const law *k, double mu, double e, double half)
{
    return pressure(k, form(k), vd_set(mu), vd_set(k->rho0 * (1 + mu)), vd_set(e), vd_set(half))[0];
}

/*   K/rho = dp/drho + p/rho^2 dp/de, the derivative along the isentrope, by central differences */
static double wave_by_difference(const law *k, double mu, double e)
{
    const double d = 1e-6, scale = k->K0 * k->volume0, rho = k->rho0 * (1 + mu), p = p_at(k, mu, e, 0);
    const double by_rho = (p_at(k, mu + d, e, 0) - p_at(k, mu - d, e, 0)) / (2 * d * k->rho0);
    const double by_e = (p_at(k, mu, e + d * scale, 0) - p_at(k, mu, e - d * scale, 0)) / (2 * d * scale);
    return by_rho + p / (rho * rho) * by_e;
}

/* Along the isentrope from rest to mu_end, by the midpoint rule: temperature by the law and by dT/T = g drho/rho, where
 * rho g = dp/de. */
static void check_isentrope(const law *k, double mu_end)
{
    enum { STEPS = 4000 };
    const double d = mu_end / STEPS, scale = 1e-3 * k->K0 * k->volume0;
    double e = 0, ln_T = 0;
    for (int i = 0; i < STEPS; i++) {
        double at_e = e, step_e = 0, step_T = 0;
        for (int half = 0; half < 2; half++) {
            const double mu = (i + 0.5 * half) * d, rho = k->rho0 * (1 + mu);
            at_e = e + 0.5 * half * step_e;
            step_e = d * k->rho0 * p_at(k, mu, at_e, 0) / (rho * rho);
            step_T = d * k->rho0 / (rho * rho) * (p_at(k, mu, at_e + scale, 0) - p_at(k, mu, at_e, 0)) / scale;
        }
        e += step_e, ln_T += step_T;
    }
    const vd reference = reference_energy(k, form(k), vd_set(mu_end));
    const double T = temperature(k, vd_set(e), reference, vd_set(0))[0], want = k->T_r * exp(ln_T);
    assert_near(T, want, 1 + 1e-3 * want); /* the polynomials of (M-3) fit to a few tenths of a kelvin */
}

static void check_eos(const mpm_material *m)
{
    const law k = law_at(m, m->reference_temperature, 1);
    const double scale = k.K0 * k.volume0;
    assert_near(p_at(&k, 0, 0, 0), 0, 0);
    assert_near(k.rho_start / k.rho0, 1, 0);
    assert_near(k.e_start, 0, 0);
    for (double mu = -0.04; mu < 0.301; mu += 0.02)
        for (double e = -0.01 * scale; e < 0.11 * scale; e += 0.02 * scale) {
            const double half = 1e-3 * k.volume0, p = p_at(&k, mu, e, half);
            assert_near(p_at(&k, mu, e - half * p, 0), p, 1e-9 * k.K0);
        }
    for (double mu = 0; mu < 0.11; mu += 0.05) {
        const vd volume = vd_set(k.volume0 / (1 + mu)), p = vd_set(p_at(&k, mu, 0, 0));
        const double c2 = wave_speed_square(&k, form(&k), volume, p, vd_set(0))[0],
                     want = wave_by_difference(&k, mu, 0);
        assert_near(c2 / want, 1, mu == 0 ? 1e-5 : 0.05); /* (M-3) takes dK/dp = 4 s - 1, that of rest, where p bends */
        assert_near(wave_speed_square(&k, form(&k), volume, p, vd_set(1e3))[0] - c2, 1e3, 1e-9 * c2);
    }
    check_isentrope(&k, 0.3);
    check_isentrope(&k, -0.04);
}

static void test_eos(void **state)
{
    const char *const names[] = {
#define EOS(name, text) #name,
#include "mpm/law/eos.def"
    };
    for_every(*state, offsetof(mpm_material, eos), names, sizeof names / sizeof names[0], MPM_MATERIAL_FOR_SCENE,
              check_eos);
}

/* A body that starts warm has no pressure and the temperature it was given: the two forms of pressure and of reference
 * energy agree. */
static void check_warm(const mpm_material *m)
{
    for (int i = 0; i < 3; i++) {
        const double T = m->reference_temperature * (1 + 0.8 * i);
        if (T >= m->melting_temperature) continue;
        const law k = law_at(m, T, 1);
        const double mu = k.rho_start / k.rho0 - 1;
        if (k.eos.kind == MPM_EOS_mie_gruneisen && mu <= k.mu_least) continue; /* beyond its range */
        assert_near(p_at(&k, mu, k.e_start, 0), 0, 2e-9 * k.K0);
        assert_near(temperature(&k, vd_set(k.e_start), reference_energy(&k, form(&k), vd_set(mu)), vd_set(0))[0], T,
                    1e-6 * T);
    }
}

static void test_warm(void **state)
{
    const char *const names[] = {
#define EOS(name, text) #name,
#include "mpm/law/eos.def"
    };
    for_every(*state, offsetof(mpm_material, eos), names, sizeof names / sizeof names[0], MPM_MATERIAL_FOR_SCENE,
              check_warm);
}

static law gas_in(const mpm_material *m, double surroundings, double temperature, double pressure)
{
    mpm_scene s;
    mpm_scene_default(&s);
    s.surroundings = surroundings;
    const mpm_body b = { .material = m, .temperature = temperature, .pressure = pressure, .yield_scale = 1 };
    law k;
    assert_ok(mpm_law_make(&b, &s, &k));
    return k;
}

/* The same gas with pressures that count from elsewhere, e from rest with the work of that difference:
 *   p' = p + A,   e' = e + A (1/rho0 - 1/rho),   A = P0 - Pa;   c and T are the same.
 * A body that begins at a pressure of its own has that and its temperature, whatever surrounds it. */
static void check_surroundings(const mpm_material *m)
{
    if (m->eos != MPM_EOS_stiffened_gas) return;
    const double A = m->gas_pressure, T = m->reference_temperature;
    const law rest = gas_in(m, NAN, T, NAN), same = gas_in(m, A, T, NAN), empty = gas_in(m, 0, T, NAN);
    const double scale = rest.K0 * rest.volume0;
    assert_near(empty.p_start, A, 0);
    assert_near(empty.rho_start / m->density, 1, 1e-12);
    for (double mu = -0.8; mu < 2; mu += 0.1) {
        const double e = 0.1 * mu * scale, work = A * rest.volume0 * mu / (1 + mu);
        const double p = p_at(&rest, mu, e, 0), p_empty = p_at(&empty, mu, e + work, 0);
        assert_near(p_at(&same, mu, e, 0), p, 1e-12 * rest.K0);
        assert_near(p_empty, p + A, 1e-9 * rest.K0);
        const vd volume = vd_set(rest.volume0 / (1 + mu)), none = vd_set(0);
        assert_near(wave_speed_square(&empty, form(&empty), volume, vd_set(p_empty), none)[0] /
                        wave_speed_square(&rest, form(&rest), volume, vd_set(p), none)[0],
                    1, 1e-9);
        const vd ref[2] = { reference_energy(&rest, form(&rest), vd_set(mu)),
                            reference_energy(&empty, form(&empty), vd_set(mu)) };
        assert_near(temperature(&empty, vd_set(e + work), ref[1], none)[0] /
                        temperature(&rest, vd_set(e), ref[0], none)[0],
                    1, 1e-6);
    }
    const law thin = gas_in(m, 0, 0.8 * T, 0.1 * A);
    const double mu = thin.rho_start / thin.rho0 - 1;
    assert_near(p_at(&thin, mu, thin.e_start, 0), 0.1 * A, 2e-9 * thin.K0);
    assert_near(
        temperature(&thin, vd_set(thin.e_start), reference_energy(&thin, form(&thin), vd_set(mu)), vd_set(0))[0],
        0.8 * T, 1e-5 * T);
    if (m->gas_stiffness <= 0) assert_near(thin.rho_start / m->density, 0.125, 0.02 * 0.125); /* P = rho R T */
    assert_near(thin.p_start, 0.1 * A, 0);
}

/* Beyond the range of the equation of state, and where a fluid cavitates, nothing can start. */
static void test_start(void **state)
{
    (void)state;
    const mpm_material copper = scene_copper(), water = scene_water();
    const struct {
        const mpm_material *m;
        double T, p;
        const char *says; /* NULL: it starts */
    } of[] = { { &copper, 293, 2e11, NULL },
               { &copper, 293, 3e11, "e+11 Pa, not 3e+11 Pa" },
               { &copper, 293, -6e10, "not -6e+10 Pa" },
               { &copper, 6e4, 0, "body `it`: at 60000 K its equation of state has pressures of" },
               { &water, 293, 1e9, NULL },
               { &water, 293, -1e5, "cavitates at 0 Pa" } };
    mpm_scene s;
    mpm_scene_default(&s);
    for (size_t i = 0; i < sizeof of / sizeof *of; i++) {
        const mpm_body b = {
            .name = "it", .material = of[i].m, .temperature = of[i].T, .pressure = of[i].p, .yield_scale = 1
        };
        law k;
        const status is = mpm_law_make(&b, &s, &k);
        if ((is.code == STATUS_OK) != !of[i].says || (of[i].says && !strstr(is.text, of[i].says)))
            fail_msg("%g K, %g Pa: `%s`", of[i].T, of[i].p, is.text);
    }
}

static void test_surroundings(void **state)
{
    const char *const names[] = {
#define EOS(name, text) #name,
#include "mpm/law/eos.def"
    };
    for_every(*state, offsetof(mpm_material, eos), names, sizeof names / sizeof names[0], MPM_MATERIAL_FOR_SCENE,
              check_surroundings);
}

/* ---- failure ---- */

static void check_failure(const mpm_material *m)
{
    const law k = law_at(m, m->reference_temperature, 1);
    const vd zero = vd_set(0);
    for (double triaxiality = -3; triaxiality < 3.1; triaxiality += 0.5)
        for (double rate = 1; rate < 1e7; rate *= 1e3) {
            failure_state s = { zero, zero, vd_set(triaxiality), vd_set(rate * rate), vd_set(log(rate)), vd_set(0.3) };
            assert_near(damage_growth(&k, &s)[0], 0, 0); /* nothing flows */
            double d = 0;
            for (double strain = 0.01; strain < 50; strain += 0.01) {
                s.plastic = vd_set(0.01), s.strain = vd_set(strain);
                const double growth = damage_growth(&k, &s)[0];
                assert_true(growth >= 0 && growth <= 1);
                d += growth;
            }
            assert_true(k.failure.kind == MPM_FAILURE_johnson_cook ? d >= 0 && isfinite(d) : d == 0);
        }
    assert_true(k.spall > 0 && k.softening >= 0 && k.softening <= 1);
}

static void test_failure(void **state)
{
    const char *const names[] = {
#define FAILURE(name, text) #name,
#include "mpm/law/failure.def"
    };
    for_every(*state, offsetof(mpm_material, failure), names, sizeof names / sizeof names[0],
              MPM_MATERIAL_FOR_SCENE | MPM_MATERIAL_FOR_DAMAGE, check_failure);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_strength), cmocka_unit_test(test_own_strength), cmocka_unit_test(test_eos),
        cmocka_unit_test(test_warm),     cmocka_unit_test(test_surroundings), cmocka_unit_test(test_start),
        cmocka_unit_test(test_failure),
    };
    return cmocka_run_group_tests(tests, open_shelf, close_shelf);
}
