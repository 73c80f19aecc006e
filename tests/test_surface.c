/* SPDX-License-Identifier: BSD-3-Clause */
/* Threshold surfaces of known functions: bands hold the truth, few scenes, halving the wanted interval. */
#include "coupling/study/search/surface.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "random_common.h"
#include "status_common.h"

/* ---- made-up grains ---- */

typedef struct {
    double base, slope; /* v_th = base (r / 0.5 mm)^-slope [m/s, 1] */
    double knee;        /* below this radius nothing gouges [m] */
    double shift;       /* of the coarse cells [m/s] */
    double noise;       /* of the severity, in units of 150 m/s [1] */
    double steep;       /* severity = tanh of this many times its distance over 150 m/s, 0: linear */
    double doubt;       /* |severity| below which the class is undecided */
    int calls, fail_at;
} grains;

static double truth(const grains *g, double radius)
{
    return radius < g->knee ? 1e5 : g->base * pow(radius / 0.5e-3, -g->slope);
}

static status outcome(grains *g, double radius, double v, double cells, threshold_sample *out)
{
    CHECK(++g->calls != g->fail_at, STATUS_STOPPED, "stopped");
    uint64_t seed = (uint64_t)(1e3 * v) + (uint64_t)(1e9 * radius) + (uint64_t)cells;
    random_between(&seed, 0.0, 1.0);
    double far = (v - truth(g, radius) - (cells < 2.5 ? g->shift : 0.0)) / 150.0;
    far += g->noise * (2.0 * random_between(&seed, 0.0, 1.0) - 1.0);
    const double excess = g->steep > 0.0 ? tanh(g->steep * far) : far;
    const damage_class class = excess >= 0.0 ? DAMAGE_GOUGE : DAMAGE_SCRATCH;
    *out = (threshold_sample){ v, cells, excess, fabs(excess) < g->doubt ? DAMAGE_UNDECIDED : class };
    return status_ok();
}

/* A barrel of 3 m with v = 2100 sqrt(x / 3 m). */
static double place_of(const void *user, double v)
{
    (void)user;
    return fmin(3.0 * (v / 2100.0) * (v / 2100.0), 3.0);
}

static surface_plan plan_of(int sizes, double interval)
{
    surface_plan p = { .search = { .low = 1000.0,
                                   .high = 2000.0,
                                   .step = study_threshold_step(interval),
                                   .interval = interval,
                                   .coarse = 2.0,
                                   .fine = 3.0,
                                   .max_scenes = 200,
                                   .place = place_of,
                                   .place_interval = 3.0 * interval },
                       .sizes = sizes,
                       .reference = sizes / 2 };
    for (int k = 0; k < sizes; k++) {
        p.size[k] = 1e-4 * pow(10.0, 0.1 * k);
        p.weight[k] = 1.0 / (1.0 + k);
    }
    return p;
}

static status search_told(grains *g, const surface_plan *p, surface_search *s)
{
    surface_wanted wanted[THRESHOLD_TOGETHER];
    TRY(study_surface_begin(p, s));
    while (study_surface_ask(s, wanted) > 0) {
        surface_sample answer = { .radius = wanted[0].radius };
        TRY(outcome(g, wanted[0].radius, wanted[0].velocity, wanted[0].cells_per_radius, &answer.is));
        TRY(study_surface_tell(s, &answer));
    }
    return status_ok();
}

static surface_result search(grains *g, const surface_plan *p)
{
    surface_search s;
    g->calls = 0;
    OK(search_told(g, p, &s));
    assert_true(s.over);
    const surface_result r = s.result;
    assert_int_equal(r.samples, g->calls); /* none asked for twice */
    assert_true(r.samples <= p->search.max_scenes);
    for (int i = 0; i < r.samples; i++)
        for (int j = 0; j < i; j++)
            assert_false(r.sample[i].radius == r.sample[j].radius &&
                         r.sample[i].is.velocity == r.sample[j].is.velocity &&
                         r.sample[i].is.cells_per_radius == r.sample[j].is.cells_per_radius);
    return r;
}

/* ---- thresholds that fall with size ---- */

static void check_bands(const grains *g, const surface_plan *p, const surface_result *r, bool all)
{
    double weight = 0.0, width = 0.0;
    for (int k = 0; k < r->sizes; k++) {
        const surface_size *s = &r->size[k];
        const double v = truth(g, s->radius), low = s->interval[0], high = s->interval[1];
        if (!isnan(low)) assert_true(low <= v);
        if (!isnan(high)) assert_true(v <= high);
        if (!isnan(low) && !isnan(high)) assert_true(low <= s->velocity && s->velocity <= high);
        if (k > 0 && !isnan(s->velocity))
            assert_true(s->velocity <= r->size[k - 1].velocity || isnan(r->size[k - 1].velocity));
        /* as wide as the range of the search where an end is not known */
        const double shift = fabs(r->reference.shift);
        const double band_low = isnan(low) ? 1000.0 - p->search.step : low + shift;
        const double band_high = isnan(high) ? 2000.0 + p->search.step : high - shift;
        weight += p->weight[k];
        width += p->weight[k] * fmax(band_high - band_low - 1.5 * p->search.step, 0.0) / (0.5 * (band_low + band_high));
    }
    if (all && weight > 0.0) assert_true(width / weight <= p->search.interval * 1.05);
}

static void test_bands(void **state)
{
    (void)state;
    static const double slopes[] = { 0.0, 0.05, 0.2, 0.5 };
    uint64_t seed = 11;
    for (size_t s = 0; s < sizeof slopes / sizeof slopes[0]; s++) {
        int scenes = 0, reference = 0, most = 0, n = 0;
        for (int i = 0; i < 200; i++) {
            const surface_plan p = plan_of(4 + i % 9, 0.05);
            grains g = { .base = 1100.0 + 700.0 * random_between(&seed, 0.0, 1.0), .slope = slopes[s] };
            g.shift = 100.0 * (2.0 * random_between(&seed, 0.0, 1.0) - 1.0);
            const double at_reference = truth(&g, p.size[p.reference]);
            if (at_reference < 1150.0 || at_reference > 1850.0) continue;
            const surface_result r = search(&g, &p);
            assert_true(r.monotone && r.warning[0] == '\0');
            check_bands(&g, &p, &r, true);
            scenes += r.samples;
            reference += r.reference.samples;
            most = r.samples > most ? r.samples : most;
            n++;
        }
        print_message("slope %.2f: %.1f scenes, %.1f of them at the reference, %d at most\n", slopes[s],
                      (double)scenes / n, (double)reference / n, most);
        if (slopes[s] == 0.0)
            assert_true((double)(scenes - reference) / n <=
                        5.0); /* four, and now and then one for an asymmetric bracket */
    }
}

/* What scenes that are there say of all sizes; a size's interval ends where its own scenes decide, as the reference's
 * does; one that reaches below 0 is cut where it is read, its band is not. */
static void test_known(void **state)
{
    (void)state;
    surface_plan p = plan_of(4, 0.05);
    p.search.coarse = p.search.fine, p.search.scatter = 0.2;
    const double reference = p.size[p.reference], small = p.size[p.reference - 1];
    const surface_sample known[] = {
        { small, { 1500.0, 3.0, -0.1, DAMAGE_UNDECIDED } }, { reference, { 1410.0, 3.0, -1.0, DAMAGE_SCRATCH } },
        { small, { 1425.0, 3.0, -1.0, DAMAGE_SCRATCH } },   { small, { 1520.0, 3.0, 0.1, DAMAGE_UNDECIDED } },
        { reference, { 1490.0, 3.0, 1.0, DAMAGE_GOUGE } },  { small, { 1600.0, 3.0, 1.0, DAMAGE_GOUGE } }
    };
    surface_search s;
    OK(study_surface_conclude(&p, known, 6, &s));
    surface_wanted wanted[THRESHOLD_TOGETHER];
    assert_true(study_surface_ask(&s, wanted) == 0 && s.result.samples == 6);
    const surface_size at = study_surface_at(&s.result, small);
    assert_true(s.result.reference.bracket[0] == 1410.0 && fabs(at.velocity - 1510.0) < 1e-9);
    assert_true(fabs(at.interval[0] - (1500.0 - 75.0 / 9.0)) < 1e-9);
    assert_true(fabs(at.interval[1] - (1520.0 + 80.0 / 9.0)) < 1e-9);
    for (int k = 0; k < s.result.sizes; k++) s.result.size[k].interval[0] = -100.0;
    s.result.reference.allowance[0] = 1600.0;
    double ends[2];
    study_surface_band(&s.result, small, ends);
    assert_true(study_surface_at(&s.result, small).interval[0] == 0.0 && ends[0] == 1500.0);
}

/* The fine stage of a search of its own at every size would take more. */
static void test_fewer_than_one_by_one(void **state)
{
    (void)state;
    int together = 0, alone = 0;
    for (double slope = 0.0; slope < 0.45; slope += 0.1) {
        grains g = { .base = 1400.0, .slope = slope, .shift = 30.0 };
        const surface_plan p = plan_of(11, 0.05);
        together += search(&g, &p).samples;
        for (int k = 0; k < p.sizes; k++) {
            surface_plan one = plan_of(1, 0.05);
            one.size[0] = p.size[k];
            one.reference = 0;
            alone += search(&g, &one).samples;
        }
    }
    print_message("eleven sizes together %d scenes, each alone %d\n", together, alone);
    assert_true(2 * together < alone);
}

/* Small grains never gouge: no scene beyond what the barrel reaches. */
static void test_knee(void **state)
{
    (void)state;
    grains g = { .base = 1500.0, .slope = 0.1, .knee = 2e-4 };
    const surface_plan p = plan_of(9, 0.05);
    const surface_result r = search(&g, &p);
    check_bands(&g, &p, &r, false); /* the sizes that never gouge count in the mean width too */
    assert_true(isnan(r.size[0].velocity) && isnan(r.size[0].interval[1]) && r.size[0].interval[0] >= 1975.0);
    assert_true(isfinite(r.size[8].velocity));
}

static void test_slow_barrel(void **state)
{
    (void)state;
    grains g = { .base = 1500.0, .slope = 0.6 };
    surface_plan p = plan_of(9, 0.05);
    const surface_result fast = search(&g, &p);
    p.search.place = NULL;
    const surface_result any = search(&g, &p);
    for (int i = 0; i < fast.samples; i++) /* nothing is asked where it makes no difference along the barrel */
        if (i >= fast.reference.samples) assert_true(fast.sample[i].is.velocity < 2100.0);
    assert_true(any.samples > 0);
}

/* ---- what is not so kind ---- */

static void test_rises_with_size(void **state)
{
    (void)state;
    int said = 0;
    for (double slope = -0.1; slope > -0.6; slope -= 0.1) {
        grains g = { .base = 1300.0, .slope = slope };
        const surface_plan p = plan_of(9, 0.05);
        const surface_result r = search(&g, &p);
        said += !r.monotone;
        assert_true(r.monotone == (r.warning[0] == '\0'));
        /* the ends are right all the same, by scenes of their own */
        for (int k = 0; k < 9; k += 8) {
            if (!isnan(r.size[k].interval[0])) assert_true(r.size[k].interval[0] <= truth(&g, p.size[k]));
            if (!isnan(r.size[k].interval[1])) assert_true(r.size[k].interval[1] >= truth(&g, p.size[k]));
        }
    }
    assert_true(said == 5);
}

/* Has the search a decided scene that bounds this size from below, or above?  The reference has its own alone. */
static bool is_bounded(const surface_result *r, double radius, bool is_reference, bool above)
{
    for (int i = 0; i < r->samples; i++) {
        const surface_sample *a = &r->sample[i];
        const bool bounds = is_reference ? a->radius == radius : above ? a->radius <= radius : a->radius >= radius;
        if (bounds && a->is.class == (above ? DAMAGE_GOUGE : DAMAGE_SCRATCH)) return true;
    }
    return false;
}

/* An undecided scene ends no size's interval, its own or another's: each end lies outside of the doubt, where a scene
 * bounds it that decides. */
static void test_undecided(void **state)
{
    (void)state;
    static const double slopes[] = { 0.0, 0.1 };
    int inferred = 0;
    for (int i = 0; i < 100; i++) {
        surface_plan p = plan_of(4 + i % 9, 0.05);
        p.search.coarse = p.search.fine;
        p.search.scatter = i % 2 ? 0.3 : 0.0;
        grains g = { .base = 1250.0 + 5.0 * i, .slope = slopes[i / 2 % 2], .doubt = 0.3 };
        const surface_result r = search(&g, &p);
        for (int k = 0; k < r.sizes; k++) {
            const surface_size *s = &r.size[k];
            const double v = truth(&g, s->radius), doubt = 150.0 * g.doubt - 1e-9;
            if (is_bounded(&r, s->radius, k == p.reference, false)) assert_true(!(s->interval[0] > v - doubt));
            if (is_bounded(&r, s->radius, k == p.reference, true)) assert_true(!(s->interval[1] < v + doubt));
            inferred += k != p.reference && !isnan(s->interval[0]) && !isnan(s->interval[1]);
        }
    }
    assert_true(inferred > 100);
}

/* A size whose own undecided scenes turn back has an interval as far as where its scenes decide, no less. */
static void test_turns_back(void **state)
{
    (void)state;
    surface_plan p = plan_of(2, 0.05);
    p.search.coarse = p.search.fine;
    const double r = p.size[0], reference = p.size[p.reference];
    const surface_sample list[] = {
        { reference, { 1500.0, 3.0, 1.0, DAMAGE_GOUGE } }, { reference, { 1200.0, 3.0, -1.0, DAMAGE_SCRATCH } },
        { r, { 1200.0, 3.0, -1.0, DAMAGE_SCRATCH } },      { r, { 1300.0, 3.0, 0.1, DAMAGE_UNDECIDED } },
        { r, { 1325.0, 3.0, -0.1, DAMAGE_UNDECIDED } },    { r, { 1700.0, 3.0, 1.0, DAMAGE_GOUGE } },
    };
    surface_search s;
    OK(study_surface_conclude(&p, list, 6, &s));
    const surface_result *of = &s.result;
    assert_false(of->monotone);
    assert_true(of->size[0].interval[0] == 1200.0 - of->reference.allowance[0]);
    assert_true(of->size[0].interval[1] == 1700.0 + of->reference.allowance[1]);
}

static void test_budget(void **state)
{
    (void)state;
    for (int most = 1; most < 30; most++) {
        grains g = { .base = 1400.0, .slope = 0.3, .shift = 20.0 };
        surface_plan p = plan_of(9, 0.03);
        p.search.max_scenes = most;
        const surface_result r = search(&g, &p);
        if (r.reference.outcome != THRESHOLD_FOUND || r.reference.warning[0]) continue;
        for (int k = 0; k < r.sizes; k++) {
            if (!isnan(r.size[k].interval[0])) assert_true(r.size[k].interval[0] <= truth(&g, r.size[k].radius));
            if (!isnan(r.size[k].interval[1])) assert_true(r.size[k].interval[1] >= truth(&g, r.size[k].radius));
        }
    }
}

static void test_errors(void **state)
{
    (void)state;
    surface_search s;
    surface_plan p = plan_of(5, 0.05);
    grains g = { .base = 1400.0, .slope = 0.2 };
    const int all = search(&g, &p).samples;
    for (int at = 1; at <= all; at++) {
        g = (grains){ .base = 1400.0, .slope = 0.2, .fail_at = at };
        assert_int_equal(search_told(&g, &p, &s).code, STATUS_STOPPED);
    }
    p.size[1] = p.size[0];
    assert_int_equal(study_surface_begin(&p, &s).code, STATUS_BAD_INPUT);
}

static void test_at(void **state)
{
    (void)state;
    surface_result r = { .sizes = 3 };
    for (int k = 0; k < 3; k++)
        r.size[k] = (surface_size){ .radius = 1e-4 * pow(10.0, k),
                                    .velocity = 1800.0 - 200.0 * k,
                                    .interval = { 1700.0 - 200.0 * k, NAN } };
    assert_true(study_surface_at(&r, 1e-5).velocity == 1800.0 && study_surface_at(&r, 1.0).velocity == 1400.0);
    assert_true(study_surface_at(&r, 1e-3).velocity == 1600.0);
    assert_true(fabs(study_surface_at(&r, sqrt(1e-7)).velocity - 1700.0) < 1e-9); /* half way in ln r */
    assert_true(fabs(study_surface_at(&r, sqrt(1e-7)).interval[0] - 1600.0) < 1e-9);
    assert_true(isnan(study_surface_at(&r, sqrt(1e-7)).interval[1]));
}

/* ---- halving the wanted interval ---- */

static void test_halving(void **state)
{
    (void)state;
    uint64_t seed = 5;
    int within[2] = { 0, 0 }, n[2] = { 0, 0 };
    for (int i = 0; i < 1500; i++) {
        const surface_plan wide = plan_of(7, 0.06);
        surface_plan narrow = plan_of(7, 0.03);
        grains g = { .base = 1150.0 + 650.0 * random_between(&seed, 0.0, 1.0),
                     .slope = 0.3 * random_between(&seed, 0.0, 1.0),
                     .shift = 120.0 * (2.0 * random_between(&seed, 0.0, 1.0) - 1.0),
                     .noise = 0.3 * random_between(&seed, 0.0, 1.0),
                     .steep = i % 3 ? 0.0 : 3.0 * random_between(&seed, 0.0, 1.0) };
        const surface_result a = search(&g, &wide), b = search(&g, &narrow);
        for (int k = 0; k < 7; k++) {
            const bool reference = k == wide.reference;
            const double va = a.size[k].velocity, vb = b.size[k].velocity;
            if (isnan(va) || isnan(vb)) continue;
            n[reference]++;
            within[reference] += fabs(va - vb) < 0.06 * va;
        }
    }
    print_message("halved: %d of %d reference sizes, %d of %d other sizes within the former interval\n", within[1],
                  n[1], within[0], n[0]);
    assert_true(n[0] > 1000 && n[1] > 500);
    assert_true(within[1] >= 0.9 * n[1] && within[0] >= 0.9 * n[0]); /* 9 of 10, as the study is judged by */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_bands),
        cmocka_unit_test(test_known),
        cmocka_unit_test(test_fewer_than_one_by_one),
        cmocka_unit_test(test_knee),
        cmocka_unit_test(test_slow_barrel),
        cmocka_unit_test(test_rises_with_size),
        cmocka_unit_test(test_undecided),
        cmocka_unit_test(test_turns_back),
        cmocka_unit_test(test_budget),
        cmocka_unit_test(test_errors),
        cmocka_unit_test(test_at),
        cmocka_unit_test(test_halving),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
