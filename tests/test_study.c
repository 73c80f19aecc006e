/* SPDX-License-Identifier: BSD-3-Clause */
/* The search for a threshold on functions that are known, and the whole study on scenes that cost nothing. */
#include "coupling/case/case.h"
#include "coupling/gouge/growth.h"
#include "coupling/study/onset.h"
#include "coupling/study/search/uncertain.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "near_common.h"
#include "random_common.h"
#include "status_common.h"

/* ---- functions to search ---- */

typedef struct {
    double (*f)(double u); /* rises through 0 at u = 0 */
    double zero, scale;    /* u = (v - zero) / scale [m/s] */
    double shift;          /* of the zero at the coarse resolution, 2 cells a radius [m/s] */
    double noise;          /* amplitude */
    uint64_t salt;         /* of the noise */
    double doubt;          /* |excess| below which the class is undecided */
    double dip_at;         /* a stretch of 60 m/s that does not gouge, NaN: none [m/s] */
    int calls, fail_at;    /* 0: never fails */
    int pairs;             /* questions of two scenes */
    double asked[THRESHOLD_MAX_SAMPLES][2];
} function;

static status value_of(function *f, double v, double cells, threshold_sample *out)
{
    for (int i = 0; i < f->calls; i++)
        if (f->asked[i][0] == v && f->asked[i][1] == cells) fail_msg("%g m/s at %g cells asked for twice", v, cells);
    f->asked[f->calls][0] = v;
    f->asked[f->calls++][1] = cells;
    CHECK(f->calls != f->fail_at, STATUS_STOPPED, "stopped");
    uint64_t seed = (uint64_t)(1000.0 * v) + (uint64_t)cells + f->salt;
    random_between(&seed, 0.0, 1.0);
    const double zero = f->zero + (cells < 2.5 ? f->shift : 0.0);
    double excess = f->f((v - zero) / f->scale) + f->noise * (2.0 * random_between(&seed, 0.0, 1.0) - 1.0);
    if (fabs(v - f->dip_at) < 30.0) excess = -1.0;
    const damage_class side = excess >= 0.0 ? DAMAGE_GOUGE : DAMAGE_SCRATCH;
    *out = (threshold_sample){ v, cells, excess, fabs(excess) < f->doubt ? DAMAGE_UNDECIDED : side };
    return status_ok();
}

static double line(double u)
{
    return u;
}

static double step(double u)
{
    return u < 0.0 ? -1.5 : 20.0;
}

static double knee(double u) /* a floor below, as the severity without a crater */
{
    return fmax(-1.5, u > 0.0 ? 8.0 * u : 3.0 * u);
}

static double cube(double u)
{
    return u * u * u;
}

static double saturated(double u)
{
    return tanh(5.0 * u);
}

static double (*const functions[])(double) = { line, step, knee, cube, saturated };
enum { FUNCTIONS = sizeof functions / sizeof functions[0] };

static threshold_plan usual(void)
{
    return (threshold_plan){ .low = 1000.0,
                             .high = 2000.0,
                             .step = study_threshold_step(0.05),
                             .interval = 0.05,
                             .coarse = 2.0,
                             .fine = 3.0,
                             .max_scenes = 30 };
}

static function plain(double (*f)(double), double zero)
{
    return (function){ .f = f, .zero = zero, .scale = 200.0, .dip_at = NAN };
}

/* A question's scenes are told from its last to its first where `backwards`. */
static status search_told(function *f, const threshold_plan *plan, bool backwards, threshold_search *s)
{
    threshold_wanted wanted[THRESHOLD_TOGETHER];
    int n;
    TRY(study_threshold_begin(plan, s));
    while ((n = study_threshold_ask(s, wanted)) > 0) {
        f->pairs += n == 2;
        for (int i = 0; i < n; i++) {
            const threshold_wanted *w = &wanted[backwards ? n - 1 - i : i];
            threshold_sample answer;
            TRY(value_of(f, w->velocity, w->cells_per_radius, &answer));
            TRY(study_threshold_tell(s, &answer));
        }
    }
    return status_ok();
}

static threshold_result search(function *f, const threshold_plan *plan)
{
    threshold_search s;
    OK(search_told(f, plan, false, &s));
    const threshold_result r = s.result;
    for (int i = 0; i < r.samples; i++) {
        const double k = r.sample[i].velocity / plan->step;
        assert_true(fabs(k - round(k)) < 1e-9);
        assert_true(r.sample[i].velocity >= plan->low && r.sample[i].velocity <= plan->high);
    }
    assert_int_equal(r.samples, f->calls);
    assert_true(r.samples <= plan->max_scenes);
    return r;
}

/* ---- what holds for any function with one change of side ---- */

static void test_found(void **state)
{
    (void)state;
    uint64_t seed = 7;
    const threshold_plan plan = usual();
    double most = 0, sum = 0;
    int n = 0, pairs = 0;
    for (int k = 0; k < FUNCTIONS; k++)
        for (int i = 0; i < 400; i++) {
            function f = plain(functions[k], 1030.0 + 940.0 * random_between(&seed, 0.0, 1.0));
            f.shift = 120.0 * (2.0 * random_between(&seed, 0.0, 1.0) - 1.0);
            if (f.zero + f.shift < 1030.0 || f.zero + f.shift > 1970.0) f.shift = 0.0;
            const threshold_result r = search(&f, &plan);
            assert_int_equal(r.outcome, THRESHOLD_FOUND);
            assert_true(r.bracket[0] <= f.zero && f.zero <= r.bracket[1]);
            assert_true(r.interval[0] <= r.bracket[0] && r.bracket[1] <= r.interval[1]);
            assert_true(r.bracket[0] <= r.velocity && r.velocity <= r.bracket[1]);
            assert_true(r.monotone);
            /* as narrow as asked for, or two steps of the grid */
            assert_true(r.bracket[1] - r.bracket[0] <= fmax(0.05 * f.zero * 1.05, 2.0 * plan.step));
            assert_true(fabs((r.interval[1] - r.bracket[1]) - fabs(r.shift)) < 1e-9);
            most = fmax(most, r.samples);
            sum += r.samples;
            pairs += f.pairs;
            n++;
        }
    print_message("scenes: %.2f on average, %.0f at most, of %d searches\n", sum / n, most, n);
    assert_true(most <= 16.0);   /* 5 steps of halving coarse, 4 doublings and 4 halvings fine, and the first three */
    assert_true(sum / n <= 7.5); /* 8.1 when most were asked in pairs */
    assert_true(pairs >= n);     /* the first two are wanted whatever either says */
}

/* The root: a line is met exactly by the secant. */
static void test_line_exact(void **state)
{
    (void)state;
    const threshold_plan plan = usual();
    for (double zero = 1040.0; zero < 1960.0; zero += 7.3) {
        function f = plain(line, zero);
        const threshold_result r = search(&f, &plan);
        assert_true(fabs(r.velocity - zero) < 1e-9); /* rounding */
        assert_true(fabs(r.shift) < 1e-9);
    }
}

static void test_shift_shown(void **state)
{
    (void)state;
    const threshold_plan plan = usual();
    for (double shift = -150.0; shift <= 150.0; shift += 10.0) {
        function f = plain(line, 1507.0);
        f.shift = shift;
        const threshold_result r = search(&f, &plan);
        assert_true(fabs(r.shift + shift) < 1e-9); /* from coarse to fine; the secant of a line is exact */
    }
}

static void test_one_stage(void **state)
{
    (void)state;
    threshold_plan plan = usual();
    plan.coarse = plan.fine = 3.0;
    for (int k = 0; k < FUNCTIONS; k++) {
        function f = plain(functions[k], 1411.0);
        const threshold_result r = search(&f, &plan);
        assert_int_equal(r.outcome, THRESHOLD_FOUND);
        assert_true(isnan(r.shift) && r.interval[0] == r.bracket[0] && r.interval[1] == r.bracket[1]);
        assert_true(r.bracket[0] <= f.zero && f.zero <= r.bracket[1]);
        assert_true(r.bracket[1] - r.bracket[0] <= 0.05 * 1411.0 * 1.05);
    }
}

/* The interval allows for the resolution: a share of the threshold, or the shift where that is more. */
static void test_allowance(void **state)
{
    (void)state;
    threshold_plan plan = usual();
    plan.resolution = 0.1;
    for (double shift = -200.0; shift <= 200.0; shift += 50.0) {
        function f = plain(line, 1411.0);
        f.shift = shift;
        const threshold_result r = search(&f, &plan);
        assert_true(fabs(r.allowance[0] - fmax(141.1, fabs(shift))) < 1e-6);
        assert_true(fabs(r.bracket[0] - r.interval[0] - r.allowance[0]) < 1e-9);
        assert_true(fabs(r.interval[1] - r.bracket[1] - r.allowance[1]) < 1e-9);
    }
}

/* No bracket is made narrower than what the resolution leaves open, or than a tenth where that is more. */
static void test_open_resolution(void **state)
{
    (void)state;
    threshold_plan plan = usual();
    plan.coarse = plan.fine;
    static const double open[] = { 0.0, 0.1, 0.4 }, narrow[] = { 0.05, 0.1, 0.1 };
    int asked[3] = { 0 };
    for (int k = 0; k < 3; k++) {
        plan.resolution = open[k];
        for (double zero = 1110.0; zero < 1900.0; zero += 7.0) {
            function f = plain(line, zero);
            const threshold_result r = search(&f, &plan);
            asked[k] += r.samples;
            assert_true(r.bracket[1] - r.bracket[0] <= fmax(1.5 * plan.step, narrow[k] * 1.1 * zero));
        }
    }
    print_message("%d scenes, %d where the resolution leaves 10 %% open\n", asked[0], asked[1]);
    assert_true(asked[1] < 0.95 * asked[0] && asked[2] == asked[1]);
}

/* Does the function turn back?  Of each resolution's search some scene lies far out on both sides, its own or one that
 * asks for that. */
static void test_beyond(void **state)
{
    (void)state;
    static const double FAR = 0.15;
    threshold_plan plan = usual();
    int spared = 0;
    for (int stages = 1; stages <= 2; stages++) {
        plan.coarse = stages == 1 ? plan.fine : 2.0;
        for (double zero = 1110.0; zero < 1900.0; zero += 7.0) {
            function f = plain(line, zero);
            const threshold_result r = search(&f, &plan);
            const double low = plan.low + FAR * zero, high = plan.high - FAR * zero;
            double lowest = INFINITY, highest = -INFINITY;
            for (int i = 0; i < r.samples; i++) {
                if (r.sample[i].cells_per_radius != plan.coarse) continue;
                lowest = fmin(lowest, r.sample[i].velocity), highest = fmax(highest, r.sample[i].velocity);
            }
            if (r.bracket[0] > low + 2.0 * plan.step) assert_true(lowest <= r.bracket[0] - 0.07 * zero);
            if (r.bracket[1] < high - 2.0 * plan.step) assert_true(highest >= r.bracket[1] + 0.07 * zero);
            spared += lowest == plan.low + 250.0 || highest == plan.high - 250.0; /* the search's first two */
        }
    }
    assert_true(spared > 0);
}

/* What the first of two searches asks for below its bracket, to see whether the function turns back, is what the
 * second, whose threshold is lower, asks for on its way: it costs nothing more. */
static void test_beyond_is_shared(void **state)
{
    (void)state;
    threshold_plan plan = usual();
    plan.low = 500.0, plan.coarse = plan.fine;
    for (double first = 950.0; first < 1500.0; first += 7.0) {
        function high = plain(line, first), low = plain(line, 550.0);
        const threshold_result above = search(&high, &plan), below = search(&low, &plan);
        double lowest = INFINITY;
        bool shared = false;
        for (int i = 0; i < above.samples; i++) lowest = fmin(lowest, above.sample[i].velocity);
        for (int i = 0; i < below.samples; i++) shared = shared || below.sample[i].velocity == lowest;
        assert_true(shared);
    }
}

static void test_ends(void **state)
{
    (void)state;
    threshold_plan plan = usual();
    for (int k = 0; k < 2 * FUNCTIONS; k++) {
        plan.resolution = k < FUNCTIONS ? 0.0 : 0.1; /* what finer cells may change holds for one side too */
        function low = plain(functions[k % FUNCTIONS], 700.0), high = plain(functions[k % FUNCTIONS], 2600.0);
        threshold_result r = search(&low, &plan);
        assert_int_equal(r.outcome, THRESHOLD_BELOW);
        assert_true(isnan(r.velocity) && isnan(r.interval[0]) && r.interval[1] == 1000.0 * (1.0 + plan.resolution));
        r = search(&high, &plan);
        assert_int_equal(r.outcome, THRESHOLD_ABOVE);
        assert_true(isnan(r.velocity) && isnan(r.interval[1]) && r.interval[0] == 2000.0 * (1.0 - plan.resolution));
        assert_true(low.calls <= 4 && high.calls <= 4); /* the middle and doubling steps of a quarter */
    }
}

/* Fine cells far off the coarse ones: the steps grow. */
static void test_far_shift(void **state)
{
    (void)state;
    const threshold_plan plan = usual();
    int asked = 0, n = 0;
    for (double shift = 200.0; shift <= 450.0; shift += 10.0, n++) {
        function f = plain(line, 1500.0 - 0.5 * shift);
        f.shift = shift;
        asked += search(&f, &plan).samples;
    }
    print_message("%d scenes\n", asked);
    assert_true(asked < 10 * n);
}

/* A range that neither begins nor ends on the grid of velocities: every search comes to an end, on the right side. */
static void test_range_off_the_grid(void **state)
{
    (void)state;
    threshold_plan plan = usual();
    plan.low = 500.0, plan.step = 13.0;
    for (double zero = 495.0; zero < 2010.0; zero += 4.7) {
        function f = plain(line, zero);
        const threshold_result r = search(&f, &plan);
        if (zero <= 507.0) assert_int_equal(r.outcome, THRESHOLD_BELOW);
        if (zero > 1989.0) assert_int_equal(r.outcome, THRESHOLD_ABOVE);
        if (zero > 507.0 && zero <= 1989.0) assert_true(r.bracket[0] <= zero && zero <= r.bracket[1]);
    }
}

/* ---- functions that are not so kind ---- */

/* Whatever the noise makes of the samples, the interval holds every velocity where their side is in doubt. */
static void test_noise(void **state)
{
    (void)state;
    uint64_t seed = 3;
    const threshold_plan plan = usual();
    int warned = 0, open = 0;
    for (int i = 0; i < 2000; i++) {
        function f = plain(line, 1200.0 + 600.0 * random_between(&seed, 0.0, 1.0));
        f.scale = 400.0;
        f.noise = 0.9; /* 360 m/s on the slope below */
        f.salt = (uint64_t)i << 32;
        const threshold_result r = search(&f, &plan);
        warned += !r.monotone;
        for (int a = 0; a < r.samples; a++) {
            const threshold_sample *s = &r.sample[a];
            if (r.outcome != THRESHOLD_FOUND || s->cells_per_radius != plan.fine) continue;
            if (s->excess >= 0.0) assert_false(s->velocity < r.interval[0]);
            if (s->excess < 0.0) assert_false(s->velocity > r.interval[1]);
        }
        if (r.outcome == THRESHOLD_FOUND) { /* 0.9 of noise on a slope of 1/400 moves the sign by 360 m/s at most */
            assert_false(r.interval[0] > f.zero + 360.0 || r.interval[1] < f.zero - 360.0);
            open += isnan(r.interval[0]) || isnan(r.interval[1]);
        }
        if (isnan(r.interval[0]) || isnan(r.interval[1])) assert_true(r.outcome != THRESHOLD_FOUND || !r.monotone);
        assert_true(r.monotone == (r.warning[0] == '\0'));
    }
    print_message("%d of 2000 noisy searches met a violation, %d are open at an end\n", warned, open);
    assert_true(warned > open && open > 0); /* or the check was never tried */
}

/* A dip above the threshold: where the search meets it, it must say so. */
static void test_dip(void **state)
{
    (void)state;
    const threshold_plan plan = usual();
    int met = 0;
    for (double at = 1300.0; at < 1950.0; at += 11.0) {
        function f = plain(line, 1210.0);
        f.dip_at = at;
        const threshold_result r = search(&f, &plan);
        double upper = INFINITY, lower = -INFINITY;
        for (int stage = 0; stage < 2; stage++, upper = INFINITY, lower = -INFINITY) {
            for (int a = 0; a < r.samples; a++) {
                const threshold_sample *s = &r.sample[a];
                if (s->cells_per_radius != (stage ? plan.fine : plan.coarse)) continue;
                if (s->excess >= 0.0) upper = fmin(upper, s->velocity);
                if (s->excess < 0.0) lower = fmax(lower, s->velocity);
            }
            if (lower < upper || r.outcome != THRESHOLD_FOUND) continue;
            met++;
            assert_false(r.monotone);
            assert_true(r.warning[0] != '\0');
            assert_false(r.interval[0] > upper || r.interval[1] < lower);
        }
    }
    print_message("the dip was met %d times\n", met);
    assert_true(met > 0);
}

/* Undecided scenes beside the crossing do not end the interval. */
static void test_undecided(void **state)
{
    (void)state;
    const threshold_plan plan = usual();
    for (double zero = 1250.0; zero < 1750.0; zero += 13.0) {
        function f = plain(line, zero);
        f.doubt = 0.2; /* 40 m/s either side */
        const threshold_result r = search(&f, &plan);
        assert_int_equal(r.outcome, THRESHOLD_FOUND);
        for (int a = 0; a < r.samples; a++) {
            const threshold_sample *s = &r.sample[a];
            if (s->cells_per_radius != plan.fine || s->class != DAMAGE_UNDECIDED) continue;
            for (int b = 0; b < r.samples; b++) { /* a decided one beyond it: then the interval reaches that one */
                const threshold_sample *d = &r.sample[b];
                if (d->cells_per_radius != plan.fine || d->class == DAMAGE_UNDECIDED) continue;
                if (d->velocity > s->velocity && s->velocity == r.bracket[1]) assert_true(r.interval[1] > r.bracket[1]);
                if (d->velocity < s->velocity && s->velocity == r.bracket[0]) assert_true(r.interval[0] < r.bracket[0]);
            }
        }
    }
}

/* With the scatter known the interval ends where a line leaves it, not at the decided scene beyond. */
static void test_scatter(void **state)
{
    (void)state;
    threshold_plan plan = usual();
    plan.scatter = 0.2, plan.coarse = plan.fine;
    int inside = 0, open = 0;
    for (double zero = 1250.0; zero < 1750.0; zero += 13.0) {
        function f = plain(line, zero);
        f.doubt = plan.scatter;
        const threshold_result r = search(&f, &plan);
        const double end[2] = { zero - 40.0, zero + 40.0 };
        for (int e = 0; e < 2; e++) {
            const bool decided = fabs(r.bracket[e] - zero) >= 40.0;
            if (decided) assert_true(r.interval[e] == r.bracket[e]);
            if (decided) continue;
            bool known = false; /* or it has no decided scene there, and says so */
            double furthest = r.bracket[e];
            for (int i = 0; i < r.samples; i++) {
                const threshold_sample *s = &r.sample[i];
                if (study_threshold_is_upper(s) != (e == 1)) continue;
                known = known || s->class != DAMAGE_UNDECIDED;
                furthest = e ? fmax(furthest, s->velocity) : fmin(furthest, s->velocity);
            }
            assert_true(fabs(r.interval[e] - (known ? end[e] : furthest)) < 1e-9);
            if (!known) assert_non_null(strstr(r.warning, e ? "at the fastest that" : "at the slowest that"));
            *(known ? &inside : &open) += 1;
        }
    }
    assert_true(inside > 10 && open > 0);
    static const threshold_sample known[] = { { 1000.0, 3.0, -0.1, DAMAGE_UNDECIDED },
                                              { 1100.0, 3.0, -0.1, DAMAGE_UNDECIDED },
                                              { 1150.0, 3.0, 1.0, DAMAGE_GOUGE } };
    threshold_search s; /* of several that do not decide the furthest */
    OK(study_threshold_conclude(&plan, known, 3, &s));
    assert_true(s.result.bracket[0] == 1100.0 && s.result.interval[0] == 1000.0 - s.result.allowance[0]);
}

/* Where one side alone was seen, the interval begins at a decided scene too, or has no end. */
static void test_one_side_undecided(void **state)
{
    (void)state;
    threshold_plan plan = usual();
    plan.scatter = 0.2, plan.coarse = plan.fine;
    function f = plain(line, 2010.0); /* at 2000 m/s an excess of -0.05 */
    f.doubt = plan.scatter;
    const threshold_result r = search(&f, &plan);
    assert_int_equal(r.outcome, THRESHOLD_ABOVE);
    assert_true(fabs(r.interval[0] - 1970.0) < 1e-9 && isnan(r.interval[1])); /* where the line leaves the scatter */
    f = plain(line, 2010.0);
    f.doubt = 10.0;
    const threshold_result open = search(&f, &plan);
    assert_true(open.outcome == THRESHOLD_ABOVE && isnan(open.interval[0]) && open.bracket[0] == 2000.0);
    f = plain(line, 2010.0);
    plan.max_scenes = 2; /* says that it was short of scenes */
    const threshold_result few = search(&f, &plan);
    assert_true(few.outcome == THRESHOLD_UNKNOWN && strstr(few.warning, "study.max_scenes spent before a scene above"));
}

/* Scenes that are there, whatever order: the lowest change of side. */
static void test_concluded(void **state)
{
    (void)state;
    threshold_plan plan = usual();
    plan.coarse = plan.fine;
    static const threshold_sample known[] = { { 1950.0, 3.0, 1.0, DAMAGE_GOUGE },
                                              { 875.0, 3.0, -1.0, DAMAGE_SCRATCH },
                                              { 2000.0, 3.0, 1.5, DAMAGE_GOUGE },
                                              { 1625.0, 3.0, -0.5, DAMAGE_SCRATCH },
                                              { 1975.0, 3.0, -0.2, DAMAGE_SCRATCH } }; /* turns back */
    threshold_search s;
    OK(study_threshold_conclude(&plan, known, 5, &s));
    threshold_wanted wanted[THRESHOLD_TOGETHER];
    assert_int_equal(study_threshold_ask(&s, wanted), 0);
    assert_true(s.result.outcome == THRESHOLD_FOUND && s.result.samples == 5 && !s.result.monotone);
    assert_true(s.result.bracket[0] == 1625.0 && s.result.bracket[1] == 1950.0);
    OK(study_threshold_conclude(&plan, known, 1, &s));
    assert_true(isnan(s.result.velocity) && s.result.bracket[1] == 1950.0 && isnan(s.result.bracket[0]));
}

/* What is known of a threshold beside scenes that turn back ends where a scene of its own side was computed beyond all
 * of the other: not where a slow one gouges and the fastest of all does not. */
static void test_turns_back_at_an_end(void **state)
{
    (void)state;
    threshold_plan plan = usual();
    plan.coarse = plan.fine;
    static const threshold_sample known[] = { { 800.0, 3.0, -1.0, DAMAGE_SCRATCH },
                                              { 1450.0, 3.0, -0.5, DAMAGE_SCRATCH },
                                              { 1600.0, 3.0, 1.0, DAMAGE_GOUGE },
                                              { 1800.0, 3.0, -0.5, DAMAGE_SCRATCH },
                                              { 1900.0, 3.0, 1.0, DAMAGE_GOUGE } };
    threshold_search s;
    const threshold_result *r = &s.result;
    OK(study_threshold_conclude(&plan, known, 5, &s));
    assert_true(!r->monotone && r->interval[0] == 1450.0 - r->allowance[0]);
    assert_true(r->interval[1] == 1800.0 + r->allowance[1]);
    OK(study_threshold_conclude(&plan, known, 4, &s));
    assert_true(r->outcome == THRESHOLD_FOUND && isnan(r->interval[1]) && strstr(r->warning, "the interval is open"));
    assert_true(r->interval[0] == 1450.0 - r->allowance[0]);
    OK(study_threshold_conclude(&plan, known + 2, 2, &s)); /* the slowest gouges, the fastest does not */
    assert_true(isnan(r->interval[0]) && isnan(r->interval[1]) && !r->monotone && r->warning[0] != '\0');
    OK(study_threshold_conclude(&plan, known + 2, 3, &s));
    assert_true(isnan(r->interval[0]) && r->interval[1] == 1800.0 + r->allowance[1] && !r->monotone);
}

static void test_budget(void **state)
{
    (void)state;
    for (int scenes = 1; scenes <= 12; scenes++)
        for (double zero = 1030.0; zero < 1970.0; zero += 17.0) {
            threshold_plan plan = usual();
            plan.max_scenes = scenes;
            function f = plain(cube, zero);
            f.shift = 60.0;
            const threshold_result r = search(&f, &plan);
            /* what it claims holds at the resolution it claims it for */
            const double truth = r.warning[0] ? zero + f.shift : zero;
            if (r.outcome == THRESHOLD_FOUND) assert_true(r.bracket[0] <= truth && truth <= r.bracket[1]);
            if (scenes == 1) assert_int_equal(r.outcome, THRESHOLD_UNKNOWN);
        }
}

/* Short of scenes, it does not claim what its fine scenes have refuted. */
static void test_driven(void **state)
{
    (void)state;
    int moved[2] = { 0, 0 };
    for (int scenes = 4; scenes <= 12; scenes++)
        for (double shift = -400.0; shift <= 400.0; shift += 100.0) {
            threshold_plan plan = usual();
            plan.max_scenes = scenes;
            function f = plain(line, 1500.0);
            f.shift = shift;
            const threshold_result r = search(&f, &plan);
            if (r.outcome != THRESHOLD_FOUND) continue;
            for (int i = 0; i < r.samples; i++) {
                const threshold_sample *a = &r.sample[i];
                if (a->cells_per_radius != plan.fine) continue;
                assert_true(study_threshold_is_upper(a) ? r.velocity <= a->velocity : r.velocity >= a->velocity);
            }
            assert_false(r.interval[0] > r.velocity || r.velocity > r.interval[1]);
            if (!strstr(r.warning, "moved to")) continue;
            assert_true(isnan(r.interval[r.shift > 0.0]) && !isnan(r.interval[r.shift <= 0.0]));
            moved[shift < 0.0]++;
        }
    assert_true(moved[0] > 0 && moved[1] > 0);
}

static void test_errors(void **state)
{
    (void)state;
    threshold_search s;
    threshold_plan plan = usual();
    for (int at = 1; at <= 4; at++) {
        function f = plain(line, 1400.0);
        f.fail_at = at;
        assert_int_equal(search_told(&f, &plan, false, &s).code, STATUS_STOPPED);
        assert_int_equal(s.result.samples,
                         at == 2 ? 0 : at - 1); /* what was reached is there; half a question is not */
    }
    function f = plain(line, NAN);
    assert_int_equal(search_told(&f, &plan, false, &s).code, STATUS_NUMERICAL);
    threshold_wanted wanted[THRESHOLD_TOGETHER];
    assert_int_equal(study_threshold_ask(&s, wanted), 2); /* it is where it was */
    plan.high = plan.low + 1.0;
    assert_int_equal(study_threshold_begin(&plan, &s).code, STATUS_BAD_INPUT);
    assert_int_equal(study_threshold_ask(&s, wanted), 0);
    assert_true(study_threshold_step(0.05) == 25.0 && study_threshold_step(0.03) == 10.0 &&
                study_threshold_step(0.1) == 50.0);
}

/* ---- the continuation ---- */

/* The same answer whichever of a question's scenes comes first, scene for scene. */
static void test_any_order(void **state)
{
    (void)state;
    const threshold_plan plan = usual();
    for (double zero = 1040.0; zero < 1900.0; zero += 7.3) {
        function f[2] = { plain(cube, zero), plain(cube, zero) };
        threshold_search s[2];
        for (int backwards = 0; backwards < 2; backwards++) {
            f[backwards].shift = 70.0;
            OK(search_told(&f[backwards], &plan, backwards, &s[backwards]));
        }
        assert_true(f[0].asked[0][0] == f[1].asked[1][0] && f[0].asked[1][0] == f[1].asked[0][0]); /* it was tried */
        assert_int_equal(s[0].result.samples, s[1].result.samples);
        for (int i = 0; i < s[0].result.samples; i++)
            assert_true(s[0].result.sample[i].velocity == s[1].result.sample[i].velocity);
        assert_true(s[0].result.velocity == s[1].result.velocity);
    }
}

/* A copy goes on by itself: what it is told the real search never hears. */
static void test_copy(void **state)
{
    (void)state;
    const threshold_plan plan = usual();
    function real = plain(line, 1400.0), guessed = plain(line, 1700.0);
    threshold_search s, copy;
    threshold_wanted wanted[THRESHOLD_TOGETHER];
    OK(study_threshold_begin(&plan, &s));
    for (int n; (n = study_threshold_ask(&s, wanted)) > 0;) {
        threshold_wanted asked[THRESHOLD_TOGETHER];
        threshold_sample answer;
        copy = s;
        while (study_threshold_ask(&copy, asked) > 0) {
            guessed.calls = 0;
            OK(value_of(&guessed, asked[0].velocity, asked[0].cells_per_radius, &answer));
            OK(study_threshold_tell(&copy, &answer));
        }
        assert_int_equal(study_threshold_ask(&s, asked), n);
        OK(value_of(&real, wanted[0].velocity, wanted[0].cells_per_radius, &answer));
        OK(study_threshold_tell(&s, &answer));
    }
    function alone = plain(line, 1400.0);
    const threshold_result r = search(&alone, &plan);
    assert_true(s.result.velocity == r.velocity && s.result.samples == r.samples);
}

/* ---- the study: the real shot, scenes that cost nothing ---- */

/* Severity and growth of a made-up scene: rise with the velocity, earlier for larger grains; the coarse cells see it 40
 * m/s later. */
typedef struct {
    int scenes, stop_after; /* of this process; 0: never */
    int whole_scratches;    /* the next so many whole scenes leave craters too long for a gouge */
    int whole_leans;        /* the next so many leave craters that lean the other way */
    double base;            /* threshold of a 0.5 mm grain [m/s] */
    double tear_drop;       /* velocity at which its groove is four times as long as wide; 0: shapes are not made up */
} fake;
static fake counter = { 0, 0, 0, 0, 1430.0, 0.0 }; /* the runner has no place for it */

static double made_up_threshold(double radius)
{
    return counter.base - 4e5 * (radius - 0.5e-3);
}

static status fake_scene(const impact_job *job, const scene_host *host, impact *out)
{
    memset(out, 0, sizeof *out);
    CHECK(counter.stop_after == 0 || counter.scenes < counter.stop_after, STATUS_STOPPED, "stopped");
    assert_non_null(host->dir);
    const bool gauged = case_impact_is_gauged(&job->of); /* then severity says nothing, else growth */
    assert_true((job->of.snapshots == 0) == gauged);     /* those of whole scenes are the case's */
    counter.scenes++;
    const double v = job->of.scene.velocity, r = job->of.particle.radius, cells = job->of.scene.cells_per_radius;
    const double excess = (v - made_up_threshold(r) - (cells < 2.5 ? 40.0 : 0.0)) / 150.0;
    out->result.severity = gauged ? -9.0 : excess + job->of.scene.limit_severity;
    out->result.groove_growth = gauged ? excess / gouge_growth_folds(1.0, r, v) : NAN;
    out->result.widening = 2.0;
    out->result.class = excess >= 0.0 ? DAMAGE_GOUGE : DAMAGE_SCRATCH;
    if (gauged && counter.tear_drop > 0.0) {
        out->result.length_over_width = 4.0 * exp((counter.tear_drop - v) / 400.0);
        if (v < counter.tear_drop) out->result.class = DAMAGE_SCRATCH;
    }
    out->result.crater_class =
        gauged ? DAMAGE_UNDECIDED : out->result.class; /* of a half-made crater it says nothing */
    if (!gauged && counter.whole_scratches > 0) {
        counter.whole_scratches--;
        out->result.length_over_width = 4.1;
    }
    if (!gauged && counter.whole_leans > 0) {
        counter.whole_leans--;
        out->result.crater_class = DAMAGE_SCRATCH;
    }
    out->result.crater_volume = (gauged ? 0.3e-9 : 1e-9) * v; /* as far as it was */
    out->impulse = 0.02;
    out->mass_loss = 1e-6;
    return status_ok();
}

static breech_case *changed_case(const char *const *sets)
{
    const char *const dirs[] = { BREECH_TESTS "/../cases/materials" };
    const case_options how = { dirs, 1, CASE_FOR_ONSET };
    /* what the made-up scenes and the numbers below count on, whatever the case says */
    const char *all[40] = {
        "study.coarse_cells_per_radius=2",
        "study.fine_cells_per_radius=3",
        "study.crater_cells_per_radius=none",
        "study.scratch=no",
        "study.threshold_ensemble=0",
        "study.max_scenes=14",
        "study.velocity_interval=5 %",
        "study.velocity_low=1 km/s",
        "study.velocity_high=2 km/s",
        "rail.level=skin",
        "study.position_interval=1",
        "study.sensitivities=no",
        "study.resolution_error=0",
        "study.resolution_above=0",
        "study.interval_parts=[]",
        "sites[0].position=0.60 m",
        "sites[1].position=0.75 m",
        "sites[2].position=0.90 m",
        "sites[3].position=1.05 m",
        "sites[4].position=1.20 m",
        "sites[5].position=1.35 m",
        "sites[6].position=1.50 m",
        "sites[7].position=1.65 m",
        "sites[8].position=1.85 m",
        "sites[9].position=2.10 m",
        "sites[10].position=2.40 m",
        "sites[11].position=2.70 m",
    };
    breech_case *c = NULL;
    char *errors = NULL;
    int n = 0;
    while (all[n]) n++;
    for (int k = 0; sets && sets[k]; k++) all[n++] = sets[k];
    const status s = case_read(BREECH_TESTS "/../cases/default_shot", all, n, &how, &c, &errors);
    if (s.code != STATUS_OK) fail_msg("%s", errors ? errors : s.text);
    return c;
}

static char warned[2000]; /* by the last one */

static status study(const breech_case *c, const char *dir, outdir_options how, onset_answer *out)
{
    static case_onset given; /* the answer borrows it */
    session s;
    const session_options options = {
        .command = "onset", .dir = dir, .store = "", .how = how, .threads = 1, .progress_to = stderr, .quiet = true
    };
    const case_inputs in = case_inputs_of(c);
    OK(run_session_open(&in, &options, &s));
    s.run_scene = fake_scene;
    counter.scenes = 0;
    given = in.onset;
    const status done = study_onset_run(&s, &given, out);
    snprintf(warned, sizeof warned, "%s", s.warnings ? s.warnings : "");
    OK(run_session_close(&s, done.code == STATUS_OK));
    return done;
}

#define FORCE         \
    (outdir_options)  \
    {                 \
        .force = true \
    }

static double first_position_at(const onset_answer *a, double v)
{
    for (int i = 0; i < a->result.n_sites; i++)
        if (a->site[i].velocity >= v) return a->site[i].position;
    return NAN;
}

/* Where the slower of the two whole craters of a study with one size of grain stands. */
static double crater_between(const onset_answer *a)
{
    const threshold_result *t = &a->grains.family[0].surface.reference;
    const double fastest = fmin(25.0 * floor(a->site[a->result.n_sites - 1].velocity / 25.0), 2000.0);
    const double middle = 0.5 * (t->interval[1] + fastest);
    double best = NAN;
    if (t->interval[1] >= fastest) return t->bracket[1];
    for (int i = 0; i < a->result.n_scenes; i++) {
        const onset_scene *s = &a->scene[i];
        const bool gouges = s->gauged && s->cells_per_radius == t->cells && s->result.class == DAMAGE_GOUGE;
        if (!gouges || fabs(s->velocity - middle) > (fastest - t->interval[1]) / 3.0) continue;
        if (isnan(best) || fabs(s->velocity - middle) < fabs(best - middle)) best = s->velocity;
    }
    return isnan(best) ? 25.0 * ceil(middle / 25.0) : best;
}

/* Judged by growth, a study runs two whole scenes more where something gouges, at fine cells; and so they do gouge. */
static void check_scenes(const onset_answer *a, bool by_growth)
{
    const onset_result *r = &a->result;
    double slowest = INFINITY, fastest = 0.0;
    int whole = 0;
    for (int i = 0; i < r->n_scenes; i++) {
        const onset_scene *s = &a->scene[i];
        assert_true((strstr(s->name, "-growth") != NULL) == s->gauged);
        if (s->gauged) continue;
        whole++;
        slowest = fmin(slowest, s->velocity);
        fastest = fmax(fastest, s->velocity);
        if (by_growth) assert_true(s->cells_per_radius == 3.0 && s->result.class == DAMAGE_GOUGE);
    }
    assert_int_equal(whole, by_growth ? 2 : r->n_scenes);
    assert_int_equal(r->n_scenes, a->grains.family[0].surface.samples + (by_growth ? 2 : 0));
    if (!by_growth) return;
    assert_true(slowest == crater_between(a));
    assert_true(fastest == 25.0 * floor(fmin(a->site[r->n_sites - 1].velocity, 2000.0) / 25.0));
    for (int i = 0; i < r->n_sites; i++) { /* the made-up volume is 1e-9 v */
        const double at = fmin(fmax(a->site[i].velocity, slowest), fastest);
        if (a->site[i].outcome == SITE_GOUGE) assert_true(fabs(a->site[i].gouged_volume - 1e-9 * at) < 1e-15);
    }
}

static void check_onset(const char *const *sets, bool by_growth, double threshold, bool site_inside)
{
    breech_case *c = changed_case(sets);
    onset_answer a;
    int undecided = 0;
    counter.base = threshold;
    OK(study(c, "onset", FORCE, &a));
    const onset_result *r = &a.result;
    assert_int_equal(r->verdict, VERDICT_GOUGES);
    assert_int_equal(a.grains.n, 1);
    assert_int_equal(r->scenes_run, counter.scenes);
    assert_int_equal(r->scenes_skipped, c->sites.n - 1);
    assert_true(r->threshold_interval[0] <= threshold && threshold <= r->threshold_interval[1]);
    assert_true(fabs(r->threshold_velocity - threshold) < 1e-6); /* the made-up severity is a line */
    assert_true(r->onset_position == first_position_at(&a, r->threshold_velocity));
    assert_true(r->onset_interval[0] == first_position_at(&a, r->threshold_interval[0]));
    assert_true(r->onset_interval[1] == first_position_at(&a, r->threshold_interval[1]));
    assert_true(r->probability_gouge == 1.0);
    for (int i = 0; i < r->n_sites; i++) {
        const onset_site *s = &a.site[i];
        const site_outcome want = s->velocity >= r->threshold_interval[1]  ? SITE_GOUGE
                                  : s->velocity > r->threshold_interval[0] ? SITE_UNDECIDED
                                                                           : SITE_SCRATCH;
        assert_int_equal(s->outcome, want);
        undecided += want == SITE_UNDECIDED && s->velocity > r->threshold_velocity;
        assert_true(isnan(s->gouged_volume) == (want != SITE_GOUGE));
        assert_true(s->scene[0] != '\0');
    }
    assert_true((undecided > 0) == site_inside);
    check_scenes(&a, by_growth);
    /* x(v) falls between the sites around it */
    assert_true(r->threshold_position <= r->onset_position && r->threshold_position > r->onset_position - 0.3);
    /* feedback: every gouge takes 0.02 N s of 0.25 kg, 0.08 m/s at once, of which the later pushing keeps
     * v_site/v_muzzle */
    const double loss = a.shot.is.muzzle_velocity - a.result.muzzle_velocity_feedback;
    assert_true(a.result.gouges > 0 && loss > 0.5 * 0.08 * a.result.gouges && loss < 0.08 * a.result.gouges);
    study_onset_answer_free(&a);
    case_free(c);
    counter.base = 1430.0;
}

static void test_onset(void **state)
{
    (void)state;
    /* scene.stop_when_gauged is for a scene by itself; a groove that is not followed has no growth */
    const char *const sets[][3] = { { "study.judge=growth" },
                                    { "study.judge=growth", "scene.stop_when_gauged=yes" },
                                    { "study.judge=growth", "scene.follow=no" },
                                    { "study.judge=severity" },
                                    { "study.judge=severity", "scene.stop_when_gauged=yes" } };
    for (int k = 0; k < 5; k++) {
        check_onset(sets[k], k < 2, 1430.0, false);
        check_onset(sets[k], k < 2, 1405.0,
                    true); /* a site at 1416 m/s lies between the threshold and the interval's end */
    }
}

/* Whole scenes of a study at the threshold `base`: how many, at which velocities and of which size. */
typedef struct {
    int n;
    double slowest, fastest, radius;
} whole_scenes;

static whole_scenes whole_at(const char *const *sets, double base, onset_answer *a)
{
    whole_scenes w = { 0, INFINITY, 0.0, NAN };
    breech_case *c = changed_case(sets);
    counter.base = base;
    OK(study(c, "craters", FORCE, a));
    counter.base = 1430.0;
    for (int i = 0; i < a->result.n_scenes; i++) {
        const onset_scene *s = &a->scene[i];
        if (s->gauged) continue;
        assert_int_equal(s->result.class, DAMAGE_GOUGE);
        w.n++;
        w.slowest = fmin(w.slowest, s->velocity);
        w.fastest = fmax(w.fastest, s->velocity);
        w.radius = s->radius;
    }
    for (int i = 0; i < a->result.n_sites; i++)
        assert_true(isnan(a->site[i].gouged_volume) == (a->site[i].outcome != SITE_GOUGE));
    case_free(c);
    return w;
}

/* Wherever the threshold lies, what gouges has a crater that gouges. */
static void test_craters(void **state)
{
    (void)state;
    const char *const slow[] = { "armature.mass=0.3 kg", NULL };
    const char *const finer[] = { "armature.mass=0.3 kg", "study.crater_cells_per_radius=4", NULL };
    const char *const large[] = { "sites[11].radius=1 mm", "sites[11].height=1 mm", "particle.height=0.5 mm",
                                  "study.max_scenes=30", NULL };
    onset_answer a;
    whole_scenes w = whole_at(NULL, 990.0, &a); /* below the range in fine cells, inside it in coarse ones */
    assert_int_equal(a.grains.family[0].surface.reference.outcome, THRESHOLD_BELOW);
    assert_true(w.n == 2 && w.slowest == crater_between(&a) && w.slowest > 1000.0 && w.fastest == 2000.0);
    study_onset_answer_free(&a);
    w = whole_at((const char *const[]){ "study.fine_cells_per_radius=2", NULL }, 1430.0, &a);
    for (int i = 0; i < a.result.n_sites;
         i++) /* a site's scene is one that decided, at the whole ones' resolution too */
        assert_true(w.n == 2 && strstr(a.site[i].scene, "-growth") != NULL);
    study_onset_answer_free(&a);
    w = whole_at(slow, 1500.0, &a);
    const double fastest = a.site[a.result.n_sites - 1].velocity;
    assert_true(w.n == 2 && w.slowest == crater_between(&a));
    study_onset_answer_free(&a);
    w = whole_at(finer, 1500.0, &a); /* cells of their own: the search is the same, and sites show its scenes */
    assert_true(w.n == 2 && w.slowest == crater_between(&a));
    for (int i = 0; i < a.result.n_scenes; i++) assert_true((a.scene[i].cells_per_radius == 4.0) == !a.scene[i].gauged);
    study_onset_answer_free(&a);
    w = whole_at((const char *const[]){ "study.resolution_error=0.1", "study.coarse_cells_per_radius=3", NULL }, 1390.0,
                 &a);
    assert_true(w.n == 2 && w.slowest == 1750.0); /* the search's second; goes on from where that ended */
    study_onset_answer_free(&a);
    w = whole_at(slow, 0.5 * (25.0 * floor(fastest / 25.0) + fastest), &a); /* passed, but not by a step of the grid */
    assert_true(fastest < 1950.0 && w.n == 1 && fabs(w.slowest - fastest) < 25.0);
    study_onset_answer_free(&a);
    w = whole_at((const char *const[]){ "armature.mass=0.3 kg", "study.craters=1", NULL }, 1500.0, &a);
    assert_true(w.n == 1 && w.slowest == crater_between(&a) && w.slowest < fastest - 100.0);
    study_onset_answer_free(&a);
    w = whole_at(slow, fastest + 200.0, &a);
    assert_true(w.n == 0 && a.result.gouges == 0);
    study_onset_answer_free(&a);
    w = whole_at(large, 2150.0, &a); /* only the one that is larger than the reference gouges */
    assert_int_equal(a.grains.n, 1);
    assert_int_equal(a.result.gouges, 1);
    assert_true(w.n > 0 && w.radius == 1e-3);
    study_onset_answer_free(&a);
}

/* Moves of the case move the answer the right way (Wu et al. 2017). */
static void test_moves(void **state)
{
    (void)state;
    const char *const small[] = { "particle.radius=0.2 mm", NULL };
    const char *const weak[] = { "bank[0].charge=4 kV", "bank[0].count=1", "armature.mass=1 kg", NULL };
    onset_answer base, a;
    breech_case *c = changed_case(NULL);
    OK(study(c, "moves", FORCE, &base));
    case_free(c);
    c = changed_case(small);
    OK(study(c, "moves", FORCE, &a));
    assert_true(a.result.threshold_velocity > base.result.threshold_velocity);
    assert_true(a.result.onset_position > base.result.onset_position);
    study_onset_answer_free(&a);
    case_free(c);
    c = changed_case(weak);
    OK(study(c, "moves", FORCE, &a));
    assert_int_equal(a.result.verdict, VERDICT_NO_GOUGING);
    assert_true(isnan(a.result.onset_position) && isnan(a.result.onset_interval[1]));
    assert_true(a.result.probability_gouge == 0.01); /* too slow for a scene: the screen alone says no */
    assert_int_equal(a.result.gouges, 0);
    assert_true(isnan(a.result.muzzle_velocity_feedback));
    study_onset_answer_free(&a);
    study_onset_answer_free(&base);
    case_free(c);
}

static void test_screened(void **state)
{
    (void)state;
    const char *const sets[] = { "study.screen_low=100", NULL };
    breech_case *c = changed_case(sets);
    onset_answer a;
    OK(study(c, "screened", FORCE, &a));
    assert_int_equal(counter.scenes, 0);
    /* a screen set higher than what it was calibrated with decides nothing: the fastest site has a ratio of 14 */
    assert_int_equal(a.result.verdict, VERDICT_UNDECIDED);
    assert_true(a.result.probability_gouge > 0.95 && a.result.onset_interval[0] == a.site[0].position);
    assert_true(isnan(a.result.expected_gouges) && isnan(a.result.expected_gouges_interval[1]));
    assert_true(a.result.n_along == 0); /* grains that are not drawn have no place either */
    assert_non_null(strstr(a.result.reason, "no scene was run"));
    assert_int_equal(a.result.scenes_skipped, c->sites.n);
    for (int i = 0; i < a.result.n_sites; i++) assert_int_equal(a.site[i].outcome, SITE_SKIPPED);
    study_onset_answer_free(&a);
    case_free(c);
    /* a slow shot does not gouge, but the screen alone is no proof */
    c = changed_case((const char *const[]){ "bank[0].charge=2 kV", "bank[0].count=1", "armature.mass=1 kg",
                                            "sites[0].position=0.11 m", NULL });
    OK(study(c, "screened", FORCE, &a));
    assert_int_equal(counter.scenes, 0);
    assert_int_equal(a.result.verdict, VERDICT_NO_GOUGING);
    assert_true(a.result.probability_gouge == 0.01);
    assert_true(isnan(a.result.expected_gouges)); /* nothing is drawn */
    study_onset_answer_free(&a);
    case_free(c);
}

/* Of families without a site that gouges the one with the lowest threshold speaks, in whatever order they come. */
static void test_leading_grain(void **state)
{
    (void)state;
    static const double velocity[][2] = { { NAN, 1500.0 }, { 1500.0, NAN }, { 1600.0, 1500.0 } };
    for (size_t i = 0; i < sizeof velocity / sizeof *velocity; i++) {
        static grain_family family[2];
        static case_onset none; /* neither sites nor populations */
        onset_answer a = { .grains = { .c = &none, .n = 2, .family = family } };
        double radius;
        for (int k = 0; k < 2; k++) {
            family[k].surface.sizes = 1;
            family[k].surface.size[0] = (surface_size){ .radius = 1e-3 * (k + 1), .velocity = velocity[i][k] };
        }
        const grain_family *f = study_onset_leading_grain(&a, &radius);
        assert_true(f->surface.size[0].velocity == 1500.0 && radius == f->surface.size[0].radius);
    }
}

/* A film or a hardened skin of a micrometre, 29 GPa hard, must not keep grains of half a millimetre from being looked
 * at; of grains alike one that is too slow has the threshold of the others. */
static void test_hard_film(void **state)
{
    (void)state;
    breech_case *c = changed_case((const char *const[]){ "sites[0].position=0.2 m", NULL });
    case_layer film = {
        .thickness = 1e-6, .material = "ofhc_copper_half_hard", .yield_scale = 40.0, .bond_strength = NAN
    };
    const case_layers none = c->rail.layers;
    onset_answer a;
    c->rail.layers = (case_layers){ 1, &film };
    OK(study(c, "film", FORCE, &a));
    assert_true(counter.scenes > 0);
    assert_int_equal(a.result.verdict, VERDICT_GOUGES);
    assert_true(a.result.probability_gouge == 1.0);
    assert_int_equal(a.result.n_null_models, 3); /* the armature is harder than the rail with its film */
    assert_true(fabs(a.result.null_model[0].threshold_velocity - 1325.0) < 0.1);
    assert_true(first_position_at(&a, 1325.0) > a.result.null_model[0].threshold_position);
    assert_int_equal(a.site[0].outcome, SITE_SKIPPED);
    assert_int_equal(a.grains.unbacked, 0);
    c->rail.layers = none;
    study_onset_answer_free(&a);
    case_free(c);
}

/* The screen's number counts for the grains that a population is likely to leave, and for none where it has none. */
static void test_screened_population(void **state)
{
    (void)state;
    static const char *const density[] = { "0 1/m", "1e-6 1/m", "100 1/m" };
    for (int k = 0; k < 3; k++) {
        char population[200];
        snprintf(population, sizeof population,
                 "populations=[{density: %s, radius_median: 0.2 mm, radius_spread: 0.3}]", density[k]);
        breech_case *c = changed_case((const char *const[]){ "sites=[]", population, "study.screen_low=1000", NULL });
        onset_answer a;
        OK(study(c, "screened", FORCE, &a));
        assert_int_equal(counter.scenes, 0);
        assert_int_equal(a.grains.unbacked, k > 0);
        assert_true(k == 2 ? a.grains.screen_probability > 0.5 : a.grains.screen_probability < 1e-5);
        assert_int_equal(a.result.verdict, k == 2 ? VERDICT_UNDECIDED : VERDICT_NO_GOUGING);
        study_onset_answer_free(&a);
        case_free(c);
    }
}

/* Of grains alike some are too slow for scenes by a screen that was set too high: what the others' scenes say counts
 * for them too. */
static void test_screened_with_others(void **state)
{
    (void)state;
    int gouges[2], skipped = 0;
    double onset[2], expected[2];
    for (int k = 0; k < 2; k++) {
        breech_case *c = changed_case((const char *const[]){ k ? "study.screen_low=13" : "study.screen_low=3", NULL });
        onset_answer a;
        OK(study(c, "others", FORCE, &a));
        gouges[k] = a.result.gouges, onset[k] = a.result.onset_position, expected[k] = a.result.expected_gouges;
        for (int i = 0; k && i < a.result.n_sites; i++) skipped += a.grains.of_site[i] < 0;
        study_onset_answer_free(&a);
        case_free(c);
    }
    print_message("%d of the sites without scenes, %d gouge\n", skipped, gouges[1]);
    assert_true(skipped > 0 && gouges[0] > 1);
    assert_true(gouges[1] == gouges[0] && onset[1] == onset[0] && expected[1] == expected[0]);
}

/* Grooves grow from 1430 m/s on and are tear-drops from 1650 m/s on: both velocities are found, the second search takes
 * the scenes of the first, and the sites between the two are scratches. */
static void test_two_speeds(void **state)
{
    (void)state;
    int scenes[3]; /* of gouge alone, of scratch alone, of both */
    onset_answer a;
    for (int which = 0; which < 3; which++) {
        breech_case *c = changed_case((const char *const[]){ which == 2 ? "study.scratch=yes" : "study.scratch=no",
                                                             "study.max_scenes=30", "study.craters=0",
                                                             "study.coarse_cells_per_radius=3", NULL });
        counter.tear_drop = which == 1 ? 0.0 : 1650.0;
        OK(study(c, "speeds", FORCE, &a));
        counter.tear_drop = 0.0;
        scenes[which] = a.result.scenes_run;
        if (which < 2) {
            assert_true(isnan(a.result.scratch_velocity) && isnan(a.site[0].scratch_velocity));
            study_onset_answer_free(&a);
        }
        case_free(c);
    }
    const onset_result *r = &a.result;
    print_message("%d scenes for the gouge, %d for the scratch, %d for both\n", scenes[0], scenes[1], scenes[2]);
    assert_true(scenes[2] < scenes[0] + scenes[1] - 1);
    assert_true(fabs(r->threshold_velocity - 1650.0) < 40.0 && fabs(r->scratch_velocity - 1430.0) < 40.0);
    assert_true(r->scratch_interval[0] <= 1430.0 && r->scratch_interval[1] >= 1430.0);
    assert_true(r->scratch_interval[1] < r->threshold_interval[0]);
    assert_true(r->scratch_position < r->threshold_position);
    assert_true(r->surface[0].scratch_velocity == r->scratch_velocity);
    assert_non_null(strstr(r->reason, "grooves grow from"));
    int scratches = 0;
    for (int i = 0; i < r->n_sites; i++) {
        const double v = a.site[i].velocity;
        const site_outcome is = a.site[i].outcome;
        if (is == SITE_SKIPPED) continue;
        if (v >= r->threshold_interval[1]) assert_int_equal(is, SITE_GOUGE);
        if (v <= r->threshold_interval[0]) assert_int_equal(is, v >= r->scratch_velocity ? SITE_SCRATCH : SITE_NONE);
        scratches += is == SITE_SCRATCH;
    }
    assert_true(scratches > 0);
    study_onset_answer_free(&a);
}

/* A study without and with what finer cells may raise a threshold by. */
static void study_above(const char *share, const char *more, onset_answer of[2])
{
    for (int k = 0; k < 2; k++) {
        breech_case *c =
            changed_case((const char *const[]){ k ? share : "study.resolution_above=0", more, "study.scratch=yes",
                                                "study.max_scenes=30", "study.coarse_cells_per_radius=3", NULL });
        OK(study(c, "above", FORCE, &of[k]));
        case_free(c);
    }
}

/* By what finer cells may raise a threshold its interval reaches further up, and the scratch's with it; nothing else of
 * the search changes, not the scenes of its whole craters either. */
static void test_finer_cells(void **state)
{
    (void)state;
    onset_answer of[2];
    counter.tear_drop = 1500.0;
    study_above("study.resolution_above=0.3", "study.resolution_error=0.05", of);
    counter.tear_drop = 0.0;
    const onset_result *with = &of[1].result, *without = &of[0].result;
    const double v = with->threshold_velocity, wider = 0.25 * v;
    assert_int_equal(with->n_scenes, without->n_scenes);
    for (int i = 0; i < with->n_scenes; i++) assert_string_equal(of[0].scene[i].name, of[1].scene[i].name);
    assert_true(v == without->threshold_velocity && with->threshold_interval[0] == without->threshold_interval[0]);
    assert_true(with->scratch_velocity == without->scratch_velocity &&
                with->scratch_interval[0] == without->scratch_interval[0]);
    assert_true(fabs(with->threshold_interval[1] - without->threshold_interval[1] - wider) < 1e-6);
    assert_true(without->scratch_interval[1] < without->threshold_interval[1]);
    assert_true(with->scratch_interval[1] == with->threshold_interval[1]);
    assert_true(fabs(of[1].part[1].threshold_below - 0.05 * v) < 1e-6 &&
                fabs(of[1].part[1].threshold_above - 0.3 * v) < 1e-6);
    for (int e = 0; e < 2; e++) study_onset_answer_free(&of[e]);
}

/* A grain that comes faster than the threshold, within its interval, gouges with more than a half; one from below the
 * search on counts as above it, as far as finer cells may raise that. */
static void test_within_a_long_interval(void **state)
{
    (void)state;
    for (int below = 0; below < 2; below++) {
        onset_answer of[2];
        counter.base = below ? 700.0 : 1430.0;
        study_above("study.resolution_above=3", "study.craters=0", of);
        const onset_result *r = &of[1].result;
        const surface_size *t = &of[1].grains.family[0].surface.size[0];
        const double fastest = of[1].site[r->n_sites - 1].velocity, at = t->velocity, end = t->interval[1];
        assert_int_equal(of[0].result.verdict, VERDICT_GOUGES);
        assert_int_equal(r->verdict, VERDICT_UNDECIDED);
        assert_true(end > 1.5 * fastest);
        assert_true(isnan(at) == (below == 1));
        assert_true(r->onset_position == of[0].result.onset_position); /* of the first that is as fast as a gouge */
        if (!below) assert_true(fabs(r->probability_gouge - (0.5 + 0.5 * (fastest - at) / (end - at))) < 1e-9);
        for (int k = 0; k < 2; k++) study_onset_answer_free(&of[k]);
    }
    counter.base = 1430.0;
}

/* A threshold with its interval, of whose ends the cells make `cells`; one size beside the reference. */
static surface_result surface_of(double velocity, double lo, double hi, double cells, double bracket_above)
{
    const threshold_result r = { .velocity = velocity,
                                 .interval = { lo, hi },
                                 .bracket = { lo, bracket_above },
                                 .of_cells = { cells, cells },
                                 .allowance = { cells, cells } };
    return (surface_result){ .reference = r, .sizes = 1, .size = { { .velocity = velocity, .interval = { lo, hi } } } };
}

/* What gouges grows: neither a scratch's threshold nor its upper end lies above the gouge's; where no groove was seen
 * to grow, it ends with that.  Other sizes move along, and no allowance falls below zero. */
static void test_order_is_kept(void **state)
{
    (void)state;
    static const struct {
        double scratch[4], seen; /* velocity, interval, share of cells; upper end of the bracket */
        double becomes[3], allowance;
    } to[] = {
        { { 800, 700, 950, 50 }, 850, { 800, 700, 950 }, 50 },    /* as it should be */
        { { 950, 850, 1050, 50 }, 1000, { 900, 800, 1000 }, 50 }, /* above the gouge's 900 */
        { { 800, 700, 1200, 250 }, 850, { 800, 700, 1000 }, 50 }, /* ends above the gouge's 1000 */
        { { 800, 700, 1200, 50 }, 850, { 800, 700, 1000 }, 0 },   /* by more than its cells had made of it */
        { { 800, 700, 900, 50 }, NAN, { 800, 700, 1000 }, 150 },  /* never seen to grow */
        { { 850, 830, 950, 50 }, 900, { 850, 800, 950 }, 50 },    /* begins above the gouge's 800 */
    };
    case_onset c = { .study = { .interval_parts = { 0 } } };
    for (size_t i = 0; i < sizeof to / sizeof *to; i++) {
        grain_family f = { .scratch = true, .surface = surface_of(900, 800, 1000, 50, 950) };
        f.scratches = surface_of(to[i].scratch[0], to[i].scratch[1], to[i].scratch[2], to[i].scratch[3], to[i].seen);
        grain_families all = { .c = &c, .n = 1, .family = &f };
        const uncertain_inputs none = { .n = 0 };
        study_uncertain_widen(&none, &all, &all);
        const threshold_result *r = &f.scratches.reference;
        const surface_size *size = &f.scratches.size[0];
        assert_near(r->velocity, to[i].becomes[0], 1e-9);
        for (int side = 0; side < 2; side++) {
            assert_near(r->interval[side], to[i].becomes[1 + side], 1e-9);
            assert_near(size->interval[side], to[i].becomes[1 + side], 1e-9);
        }
        assert_near(size->velocity, to[i].becomes[0], 1e-9);
        assert_near(r->allowance[1], to[i].allowance, 1e-9);
        assert_near(f.surface.reference.interval[1], 1000, 0);
    }
    /* a size of its own */
    grain_family f = { .scratch = true,
                       .surface = surface_of(900, 800, 1000, 50, 950),
                       .scratches = surface_of(800, 700, 950, 50, 850) };
    f.surface.sizes = f.scratches.sizes = 2;
    f.surface.size[1] = (surface_size){ .velocity = 700, .interval = { 600, 800 } };
    f.scratches.size[1] = (surface_size){ .velocity = 750, .interval = { 650, 850 } };
    grain_families all = { .c = &c, .n = 1, .family = &f };
    const uncertain_inputs none = { .n = 0 };
    study_uncertain_widen(&none, &all, &all);
    const surface_size *size = &f.scratches.size[1];
    assert_true(size->velocity == 700 && size->interval[0] == 600 && size->interval[1] == 800);
    assert_near(f.scratches.size[0].velocity, 800, 1e-9);
}

/* study.max_scenes is never passed, whichever search it runs out in; the scratch velocity then is what the scenes of
 * the gouge's search say, or not known. */
static void test_max_scenes(void **state)
{
    (void)state;
    char most[32];
    counter.tear_drop = 1650.0;
    for (int scenes = 3; scenes <= 6; scenes += 3) {
        snprintf(most, sizeof most, "study.max_scenes=%d", scenes);
        breech_case *c = changed_case((const char *const[]){ "study.scratch=yes", most, NULL });
        onset_answer a;
        OK(study(c, "most", FORCE, &a));
        if (counter.scenes > scenes) fail_msg("%d scenes run of %d", counter.scenes, scenes);
        assert_int_equal(a.result.scenes_run, counter.scenes);
        assert_true(a.grains.family[0].scratches.samples > 0);
        if (scenes == 3) /* nothing left: the second says what the first's scenes do, all of them */
            assert_int_equal(a.grains.family[0].scratches.samples, a.grains.family[0].surface.samples);
        if (!isnan(a.result.scratch_velocity))
            assert_true(a.result.scratch_interval[0] <= 1430.0 && a.result.scratch_interval[1] >= 1430.0);
        /* what gouges grows */
        assert_true(isnan(a.result.threshold_interval[1]) || a.result.scratch_interval[1] >= 1430.0);
        study_onset_answer_free(&a);
        case_free(c);
    }
    counter.tear_drop = 0.0;
}

/* Where growth says that grains gouge for sure but their whole scenes are scratches, nothing is decided. */
static void test_contradicted(void **state)
{
    (void)state;
    breech_case *c = changed_case(NULL);
    onset_answer a;
    for (int scratches = 0; scratches <= 2; scratches++) {
        counter.whole_scratches = scratches;
        OK(study(c, "contradicted", FORCE, &a));
        const bool contradicted = scratches == 2; /* both of them: one gouge is enough */
        assert_int_equal(a.result.verdict, contradicted ? VERDICT_UNDECIDED : VERDICT_GOUGES);
        assert_true(contradicted ? isnan(a.result.probability_gouge) : a.result.probability_gouge == 1.0);
        assert_true((a.result.gouges == 0) == contradicted);
        assert_true((strstr(a.result.reason, "whole scenes contradict: scratch at") != NULL) == contradicted);
        assert_int_equal(a.site[a.result.n_sites - 1].outcome, contradicted ? SITE_UNDECIDED : SITE_GOUGE);
        assert_true(!isnan(a.result.threshold_velocity));
        assert_null(strstr(warned, "crater_class"));
        study_onset_answer_free(&a);
    }
    for (int leans = 1; leans <= 2; leans++) { /* the shape alone decides nothing, but is told */
        counter.whole_leans = leans;
        OK(study(c, "contradicted", FORCE, &a));
        assert_int_equal(a.result.verdict, VERDICT_GOUGES);
        assert_true((strstr(warned, "by the shape of their whole craters alone (crater_class): scratch at") != NULL) ==
                    (leans == 2));
        study_onset_answer_free(&a);
    }
    case_free(c);
}

static void test_two_kinds(void **state)
{
    (void)state;
    const char *const sets[] = { "sites[3].radius=0.7 mm", "sites[3].height=0.5 mm", "study.max_scenes=30", NULL };
    breech_case *c = changed_case(sets);
    onset_answer a;
    OK(study(c, "kinds", FORCE, &a));
    assert_int_equal(a.grains.n, 2);
    assert_true(fabs(a.site[3].threshold_velocity - made_up_threshold(0.7e-3)) < 1e-6);
    assert_true(fabs(a.site[0].threshold_velocity - made_up_threshold(0.5e-3)) < 1e-6);
    assert_true(strncmp(a.site[3].scene, a.site[0].scene, 3) != 0);
    study_onset_answer_free(&a);
    case_free(c);
}

/* Stopped after any number of scenes and resumed, the study gives the same and computes no scene twice. */
static void test_resume(void **state)
{
    (void)state;
    breech_case *c = changed_case(NULL);
    onset_answer whole, part;
    OK(study(c, "whole", FORCE, &whole));
    const int scenes = counter.scenes;
    for (int k = 1; k < scenes; k += 2) {
        counter.stop_after = k;
        assert_int_equal(study(c, "part", FORCE, &part).code, STATUS_STOPPED);
        assert_int_equal(part.result.n_scenes, k);
        study_onset_answer_free(&part);
        counter.stop_after = 0;
        OK(study(c, "part", (outdir_options){ .resume = true }, &part));
        assert_int_equal(counter.scenes, scenes - k);
        assert_int_equal(part.result.n_scenes, scenes);
        assert_true(memcmp(&part.result.threshold_velocity, &whole.result.threshold_velocity, sizeof(double)) == 0);
        assert_true(memcmp(part.scene, whole.scene, (size_t)scenes * sizeof *part.scene) == 0);
        assert_true(part.result.muzzle_velocity_feedback == whole.result.muzzle_velocity_feedback);
        assert_string_equal(part.result.reason, whole.result.reason);
        study_onset_answer_free(&part);
    }
    study_onset_answer_free(&whole);
    case_free(c);
}

/* A checkpoint of another case is refused. */
static void test_other_case(void **state)
{
    (void)state;
    const char *const sets[] = { "scene.friction=0.21", NULL };
    breech_case *c = changed_case(NULL), *other = changed_case(sets);
    onset_answer a;
    session s;
    counter.stop_after = 2;
    assert_int_equal(study(c, "other", FORCE, &a).code, STATUS_STOPPED);
    counter.stop_after = 0;
    study_onset_answer_free(&a);
    const session_options options = { .command = "onset",
                                      .dir = "other",
                                      .how = { .resume = true },
                                      .threads = 1,
                                      .progress_to = stderr,
                                      .quiet = true };
    const case_inputs in = case_inputs_of(other);
    assert_int_not_equal(run_session_open(&in, &options, &s).code, STATUS_OK);
    run_session_close(&s, false);
    case_free(c);
    case_free(other);
}

/* A scene of a search has the class of its growth, one judged by severity that of its crater alone. */
static void test_sample(void **state)
{
    (void)state;
    case_onset *c = calloc(1, sizeof *c);
    assert_non_null(c);
    c->impact.scene.limit_length_over_width = 4.0, c->impact.scene.growth_scatter = 0.2;
    onset_scene e = { .velocity = 1000.0, .radius = 0.5e-3, .cells_per_radius = 3.0, .gauged = true };
    e.result.class = DAMAGE_SCRATCH, e.result.crater_class = DAMAGE_GOUGE, e.result.severity = 7.0;
    e.result.groove_growth = 1e5, e.result.length_over_width = 8.0;
    threshold_sample is = study_family_sample(c, JUDGE_OF_GOUGE, &e);
    assert_true(is.class == DAMAGE_SCRATCH && fabs(is.excess - log(0.5)) < 1e-12); /* a furrow */
    is = study_family_sample(c, JUDGE_OF_SCRATCH, &e);
    assert_true(is.class == DAMAGE_GOUGE && fabs(is.excess - 0.6) < 1e-9); /* that grows */
    e.gauged = false;
    is = study_family_sample(c, JUDGE_OF_GOUGE, &e);
    assert_true(is.class == DAMAGE_GOUGE && is.excess == 7.0);
    free(c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_found),
        cmocka_unit_test(test_line_exact),
        cmocka_unit_test(test_shift_shown),
        cmocka_unit_test(test_allowance),
        cmocka_unit_test(test_open_resolution),
        cmocka_unit_test(test_beyond),
        cmocka_unit_test(test_beyond_is_shared),
        cmocka_unit_test(test_one_stage),
        cmocka_unit_test(test_ends),
        cmocka_unit_test(test_far_shift),
        cmocka_unit_test(test_range_off_the_grid),
        cmocka_unit_test(test_noise),
        cmocka_unit_test(test_dip),
        cmocka_unit_test(test_undecided),
        cmocka_unit_test(test_scatter),
        cmocka_unit_test(test_one_side_undecided),
        cmocka_unit_test(test_concluded),
        cmocka_unit_test(test_turns_back_at_an_end),
        cmocka_unit_test(test_budget),
        cmocka_unit_test(test_driven),
        cmocka_unit_test(test_errors),
        cmocka_unit_test(test_any_order),
        cmocka_unit_test(test_copy),
        cmocka_unit_test(test_onset),
        cmocka_unit_test(test_sample),
        cmocka_unit_test(test_moves),
        cmocka_unit_test(test_screened),
        cmocka_unit_test(test_leading_grain),
        cmocka_unit_test(test_screened_population),
        cmocka_unit_test(test_hard_film),
        cmocka_unit_test(test_screened_with_others),
        cmocka_unit_test(test_contradicted),
        cmocka_unit_test(test_two_speeds),
        cmocka_unit_test(test_finer_cells),
        cmocka_unit_test(test_within_a_long_interval),
        cmocka_unit_test(test_order_is_kept),
        cmocka_unit_test(test_max_scenes),
        cmocka_unit_test(test_two_kinds),
        cmocka_unit_test(test_resume),
        cmocka_unit_test(test_other_case),
        cmocka_unit_test(test_craters),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
