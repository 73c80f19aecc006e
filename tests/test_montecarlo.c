/* SPDX-License-Identifier: BSD-3-Clause */
/* Random shots over surfaces that are known: closed answers of a Poisson process. */
#include "base/constants.h"
#include "coupling/study/sampling/population.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "rail_common.h"
#include "status_common.h"

static mc_result run(const mc_surface *surface, int n, int histories, int shots)
{
    mc_result out;
    const mc_plan plan = {
        .histories = histories, .shots = shots, .seed = 7, .length = LENGTH, .n = n, .surface = surface
    };
    OK(study_mc_run(&plan, &out));
    return out;
}

/* Standard error of a mean of `histories` Poisson numbers, times four. */
static double four_sigma(double mean, int histories)
{
    return 4.0 * sqrt(mean / histories);
}

/* ---- populations ---- */

static void test_sizes(void **state)
{
    (void)state;
    case_population p = { .density = 10.0, .radius_median = 2e-4, .radius_spread = 0.5, .to = 3.0 };
    population_sizes s;
    double sum = 0.0;
    assert_true(fabs(study_population_share_from(&p, 2e-4) - 0.5) < 1e-12);
    assert_true(fabs(study_population_quantile(&p, 0.5) - 2e-4) < 1e-12);
    assert_true(fabs(study_population_share_from(&p, study_population_quantile(&p, 0.9)) - 0.1) < 1e-9);
    OK(study_population_sizes(&p, 1e-4, &s));
    assert_true(s.n > 4);
    for (int k = 0; k < s.n; k++) {
        const double place = 10.0 * log10(s.size[k]);
        assert_true(fabs(place - round(place)) < 1e-6 && s.size[k] > 0.99e-4 && s.number[k] > 0.0);
        sum += s.number[k];
    }
    assert_true(fabs(sum - 30.0 * study_population_share_from(&p, 1e-4)) < 1e-9); /* none is lost above the smallest */
    case_size table[] = { { 5e-5, 5.0 }, { 2e-4, 3.0 }, { 4e-4, 2.0 } };
    p.sizes = (case_sizes){ 3, table };
    OK(study_population_sizes(&p, 1e-4, &s));
    assert_true(s.n == 2 && s.size[0] == 2e-4);
    assert_true(fabs(s.number[0] - 9.0) < 1e-12 && fabs(s.number[1] - 6.0) < 1e-12);
    assert_true(fabs(study_population_share_from(&p, 2e-4) - 0.5) < 1e-12 &&
                study_population_quantile(&p, 0.9) == 4e-4);
}

/* As many tabulated sizes as there is room for are all taken; of one more none is left out in silence. */
static void test_many_sizes(void **state)
{
    (void)state;
    enum { MOST = POPULATION_MAX_SIZES, SMALL = 3 };
    case_size table[MOST + SMALL + 1];
    for (int k = 0; k < MOST + SMALL + 1; k++) table[k] = (case_size){ 1e-5 * (k + 1), 1.0 };
    case_population p = { .density = 10.0, .to = 3.0, .sizes = { MOST + SMALL, table } };
    population_sizes s;
    OK(study_population_sizes(&p, table[SMALL].radius, &s)); /* the small ones do not count */
    assert_true(s.n == MOST && s.size[MOST - 1] == table[MOST + SMALL - 1].radius);
    p.sizes.n++;
    const status told = study_population_sizes(&p, table[SMALL].radius, &s);
    assert_int_equal(told.code, STATUS_BAD_INPUT);
    assert_non_null(strstr(told.text, "sizes: 25 of a share and at least study.smallest_radius"));
    table[MOST + SMALL].share = 0.0;
    OK(study_population_sizes(&p, table[SMALL].radius, &s));
}

/* ---- one surface ---- */

/* Threshold 1400 m/s at x = 2 m for every size: gouges a Poisson process of density x share over the last metre. */
static void test_closed(void **state)
{
    (void)state;
    rail r;
    make_rail(&r, 2.0, 2e-4, 0.5, 1400.0, 0.0, 0.0);
    const double share = study_population_share_from(&r.population, 1e-4), mean = 2.0 * share;
    const mc_surface one = as_new(&r, 0, 1.0);
    mc_result out = run(&one, 1, 100000, 1);
    const mc_shot *s = &out.of[0];
    print_message("%d histories in %.2f s\n", out.histories, out.seconds);
    assert_true(fabs(s->gouges - mean) < four_sigma(mean, out.histories));
    assert_true(fabs(s->probability - (1.0 - exp(-mean))) < 4.0 * sqrt(0.25 / out.histories));
    for (int k = 0; k < MC_BINS; k += 50) {
        const double x = LENGTH * (k + 1) / MC_BINS, want = 1.0 - exp(-2.0 * share * fmax(x - 2.0, 0.0));
        assert_true(fabs(s->before[k] - want) < 4.0 * sqrt(0.25 / out.histories) + 1e-3);
    }
    /* median: 1 - exp(-2 share (x - 2)) = 1/2; 95 % is never reached */
    assert_true(fabs(s->first[1] - (2.0 + log(2.0) / (2.0 * share))) < 0.01);
    assert_true(isnan(s->first[2]) == (1.0 - exp(-mean) < 0.95));
    /* volume: r^3 above the smallest times the mark, linear in velocity from 18 at 1400 to 30 at 2000 and 30 beyond */
    const double third = pow(2e-4, 3.0) * exp(4.5 * 0.25); /* mean r^3 of the whole log-normal */
    const double z = log(0.5) / 0.5, above = 0.5 * erfc((z - 3.0 * 0.5) / sqrt(2.0));
    const double mark = (600.0 * 24.0 + 100.0 * 30.0) / 700.0;
    assert_true(fabs(s->volume / (2.0 * third * above * mark) - 1.0) < 0.03);
    assert_true(fabs(study_mc_expected(&r.grains, LENGTH) - mean) < 2e-3 * mean); /* quadrature in 1024 places */
    study_mc_free(&out);
    free(r.family);
}

/* The threshold falls with size: the mean is that of the quadrature; the band opens the interval. */
static void test_band(void **state)
{
    (void)state;
    rail r;
    make_rail(&r, 20.0, 1.5e-4, 0.7, 1500.0, 0.2, 60.0);
    const mc_surface one = as_new(&r, 0, 1.0);
    mc_result out = run(&one, 1, 200 * MC_WORLDS, 1);
    const double mean = study_mc_expected(&r.grains, LENGTH);
    const mc_shot *s = &out.of[0];
    assert_true(mean > 1.0);
    assert_true(fabs(s->gouges / mean - 1.0) < 0.03); /* the worlds' band moves the mean by 20 % */
    assert_true(s->gouges_interval[0] < 0.95 * mean && s->gouges_interval[1] > 1.05 * mean);
    /* without a band the worlds differ by chance alone: 200 histories of some 15 gouges */
    for (int k = 0; k < 9; k++)
        r.family->surface.size[k].interval[0] = r.family->surface.size[k].interval[1] =
            r.family->surface.size[k].velocity;
    mc_result sharp = run(&one, 1, 200 * MC_WORLDS, 1);
    const double chance = 1.645 * sqrt(mean / 200.0);
    assert_true(sharp.of[0].gouges_interval[1] - mean < 2.0 * chance);
    assert_true(sharp.of[0].gouges_interval[1] - sharp.of[0].gouges_interval[0] <
                0.5 * (s->gouges_interval[1] - s->gouges_interval[0]));
    study_mc_free(&out);
    study_mc_free(&sharp);
    free(r.family);
    /* the cells allow 40 m/s below and 300 above: thresholds of 1500 + (300 - 40)/4 m/s on average */
    make_rail(&r, 20.0, 1.5e-4, 0.7, 1500.0, 0.0, 0.0);
    surface_result *of = &r.family->surface;
    of->reference.allowance[0] = 40.0, of->reference.allowance[1] = 300.0;
    for (int k = 0; k < 9; k++) of->size[k].interval[0] -= 40.0, of->size[k].interval[1] += 300.0;
    out = run(&one, 1, 40000, 1);
    const double start = LENGTH * 1565.0 / MUZZLE, share = study_population_share_from(&r.population, 1e-4);
    assert_true(fabs(out.of[0].gouges / (20.0 * share * (LENGTH - start)) - 1.0) < 0.06);
    assert_true(out.of[0].gouges < 0.95 * 20.0 * share * LENGTH * (1.0 - 1500.0 / MUZZLE));
    study_mc_free(&out);
    free(r.family);
}

/* Grains of one size are all there, or none: a size that is just the smallest counts. */
static void test_one_size(void **state)
{
    (void)state;
    static const struct {
        double median, factor;
        bool all;
    } of[] = { { 1e-4, 1.0, true },
               { 1.001e-4, 1.0, true },
               { 0.999e-4, 1.0, false },
               { 0.96e-4, 1.05, true },
               { 1.01e-4, 0.95, false } };
    const double mean = 10.0 * LENGTH * (1.0 - 1400.0 / MUZZLE);
    for (size_t i = 0; i < sizeof of / sizeof *of; i++) {
        rail r;
        make_rail(&r, 10.0, of[i].median, 0.0, 1400.0, 0.0, 0.0);
        const mc_surface one = as_new(&r, 0, of[i].factor);
        mc_result out = run(&one, 1, 20000, 1);
        const double want = of[i].all ? mean : 0.0;
        assert_true(fabs(out.of[0].gouges - want) <= four_sigma(want, out.histories));
        const bool as_they_are = of[i].median >= r.c.study.smallest_radius; /* the quadrature has no factor */
        assert_true(fabs(study_mc_expected(&r.grains, LENGTH) - (as_they_are ? mean : 0.0)) <= 2e-3 * mean);
        study_mc_free(&out);
        free(r.family);
    }
}

static void test_table_and_sites(void **state)
{
    (void)state;
    rail r;
    make_rail(&r, 5.0, NAN, NAN, 1400.0, 0.0, 0.0);
    case_size table[] = { { 5e-5, 3.0 }, { 2e-4, 1.0 }, { 4e-4, 1.0 } };
    r.population.sizes = (case_sizes){ 3, table };
    const double at[3] = { 1.0, 2.1, 2.8 };
    for (int i = 0; i < 3; i++) r.site[i] = (case_site){ .position = at[i], .radius = 3e-4 };
    r.c.sites = (case_sites){ 3, r.site };
    const mc_surface one = as_new(&r, 0, 1.0);
    mc_result out = run(&one, 1, 50000, 1);
    const double strewn = 5.0 * 0.4; /* two of five are large enough, on the last metre */
    assert_true(fabs(out.of[0].gouges - 2.0 - strewn) < four_sigma(strewn, out.histories)); /* two sites always */
    assert_true(out.of[0].probability == 1.0);
    assert_true(fabs(study_mc_expected(&r.grains, LENGTH) - 2.0 - strewn) < 0.01);
    double sum = 0.0, volume = 0.0;
    for (int k = 0; k < MC_PIECES; k++) sum += out.strewn[k].gouges, volume += out.strewn[k].volume;
    assert_true(fabs(sum - strewn) < four_sigma(strewn, out.histories)); /* those of the list are not among them */
    study_mc_free(&out);
    r.c.sites.n = 0;
    out = run(&one, 1, 50000, 1); /* the same draws */
    assert_true(fabs(volume / out.of[0].volume - 1.0) < 1e-9);
    study_mc_free(&out);
    free(r.family);
}

static void test_beyond(void **state)
{
    (void)state;
    rail r;
    make_rail(&r, 20.0, 2e-4, 0.5, 1400.0, 0.0, 0.0);
    for (int k = 0; k < 9; k++) { /* above what the search looked at, which the shot is only over the last 0.14 m: as
                                   * likely as not */
        r.family->surface.size[k].velocity = r.family->surface.size[k].interval[1] = NAN;
        r.family->surface.size[k].interval[0] = 2000.0;
    }
    const mc_surface one = as_new(&r, 0, 1.0);
    mc_result out = run(&one, 1, 20 * MC_WORLDS, 1); /* some 60 gouges a world: its chance is 13 % */
    const double there = 20.0 * LENGTH * (1.0 - 2000.0 / MUZZLE);
    assert_true(fabs(out.of[0].gouges / there - 0.5) < 0.1);
    assert_true(out.of[0].gouges_interval[0] == 0.0 && fabs(out.of[0].gouges_interval[1] / there - 1.0) < 0.3);
    assert_true(fabs(out.of[0].probability / (0.5 * (1.0 - exp(-there))) - 1.0) < 0.2);
    study_mc_free(&out);
    for (int k = 0; k < 9; k++) r.family->surface.size[k].interval[0] = 1.01 * MUZZLE; /* never so fast */
    out = run(&one, 1, 1000, 1);
    assert_true(out.of[0].gouges == 0.0 && out.of[0].probability == 0.0 && isnan(out.of[0].first[0]));
    study_mc_free(&out);
    /* gouges without a crater: their number is known, their volume is not */
    free(r.family);
    make_rail(&r, 20.0, 2e-4, 0.5, 1400.0, 0.0, 0.0);
    r.family->n_scenes = 0;
    out = run(&one, 1, 1000, 2);
    for (int k = 0; k < 2; k++)
        assert_true(out.of[k].gouges > 10.0 && isnan(out.of[k].volume) && isnan(out.of[k].volume_interval[1]));
    study_mc_free(&out);
    free(r.family);
}

/* Below what the search looked at, where every scene gouged, it is as likely as not; where the armature has stopped
 * nothing gouges. */
static void test_below(void **state)
{
    (void)state;
    rail r;
    make_rail(&r, 20.0, 2e-4, 0.5, 1400.0, 0.0, 0.0);
    for (int k = 0; k < 9; k++) {
        r.family->surface.size[k].velocity = r.family->surface.size[k].interval[0] = NAN;
        r.family->surface.size[k].interval[1] = 1400.0;
    }
    mc_surface one = as_new(&r, 0, 1.0);
    mc_result out = run(&one, 1, 20 * MC_WORLDS, 1);
    const double all = 20.0 * study_population_share_from(&r.population, 1e-4) * LENGTH,
                 sure = all * (1.0 - 1400.0 / MUZZLE);
    assert_true(fabs(out.of[0].gouges / (0.5 * (all + sure)) - 1.0) < 0.1);
    assert_true(fabs(out.of[0].gouges_interval[0] / sure - 1.0) < 0.2);
    assert_true(fabs(out.of[0].gouges_interval[1] / all - 1.0) < 0.2);
    study_mc_free(&out);
    mc_along stops = { .v = { 0 } };
    for (int k = 0; k <= MC_PLACES / 2; k++) stops.v[k] = 500.0;
    one.along = &stops;
    out = run(&one, 1, 20 * MC_WORLDS, 1);
    assert_true(out.of[0].gouges > 0.0 && out.of[0].before[MC_BINS / 2] == out.of[0].probability);
    double beyond = 0.0;
    for (int k = MC_PIECES / 2 + 1; k < MC_PIECES; k++) beyond += out.strewn[k].gouges;
    assert_true(beyond == 0.0);
    study_mc_free(&out);
    free(r.family);
}

/* ---- several surfaces ---- */

/* Two surfaces alike meet the same grains: no difference at all.  A better one is never worse in any world. */
static void test_common_numbers(void **state)
{
    (void)state;
    rail a, b;
    make_rail(&a, 5.0, 2e-4, 0.5, 1400.0, 0.1, 0.0);
    make_rail(&b, 5.0, 2e-4, 0.5, 1430.0, 0.1, 0.0);
    const mc_surface three[] = { as_new(&a, 0, 1.0), as_new(&a, 1, 1.0), as_new(&b, 2, 1.0) };
    mc_result out = run(three, 3, 20000, 1);
    assert_true(out.of[0].gouges == out.of[1].gouges && out.of[0].volume == out.of[1].volume);
    assert_true(out.of[2].gouges < out.of[0].gouges);
    for (int w = 0; w < MC_WORLDS; w++) assert_true(out.world_gouges[2 * MC_WORLDS + w] <= out.world_gouges[w]);
    study_mc_free(&out);
    /* half the grains, half the gouges; larger grains, more */
    b.population.density = 2.5;
    for (int k = 0; k < 9; k++) b.family->surface.size[k] = a.family->surface.size[k];
    const mc_surface kept[] = { as_new(&a, 0, 1.0), as_new(&b, 0, 1.0), as_new(&a, 0, 1.3) };
    out = run(kept, 3, 20000, 1);
    assert_true(fabs(out.of[1].gouges / out.of[0].gouges - 0.5) < 0.02);
    assert_true(out.of[2].gouges > out.of[0].gouges && out.of[2].volume > 1.5 * out.of[0].volume);
    study_mc_free(&out);
    free(a.family);
    free(b.family);
}

/* One grain whose threshold lies anywhere in 1400 .. 1600 m/s, passed with 1530: 0.65 of the shots gouge, to a world.
 * Independent draws of as many worlds would know it to 0.015, a standard deviation. */
static void test_worlds_are_spread(void **state)
{
    (void)state;
    rail r;
    make_rail(&r, 0.0, 1.5e-4, 0.7, 1500.0, 0.0, 0.0);
    r.site[0] = (case_site){ .position = LENGTH * 1530.0 / MUZZLE, .radius = 1.5e-4 };
    r.c.sites = (case_sites){ 1, r.site };
    surface_result *of = &r.family->surface;
    of->reference.allowance[0] = of->reference.allowance[1] = 100.0;
    for (int k = 0; k < 9; k++) of->size[k].interval[0] -= 100.0, of->size[k].interval[1] += 100.0;
    const mc_surface one = as_new(&r, 0, 1.0);
    mc_result out = run(&one, 1, 1000, 1);
    assert_true(fabs(out.of[0].probability - 0.65) <= 1.0 / MC_WORLDS);
    study_mc_free(&out);
    free(r.family);
}

/* What errs alike on all surfaces leaves two that are alike the same in every world; what each has for itself does not,
 * and moves none of them in the mean. */
static void test_own_error(void **state)
{
    (void)state;
    rail r;
    make_rail(&r, 20.0, 1.5e-4, 0.7, 1500.0, 0.0, 0.0);
    surface_result *of = &r.family->surface;
    of->reference.allowance[0] = of->reference.allowance[1] = 100.0;
    for (int k = 0; k < 9; k++) of->size[k].interval[0] -= 100.0, of->size[k].interval[1] += 100.0;
    const mc_surface three[] = { as_new(&r, 0, 1.0), as_new(&r, 1, 1.0), as_new(&r, 1, 1.0) };
    mc_result alike = run(three, 3, 100 * MC_WORLDS, 1);
    of->reference.own = 80.0;
    mc_result own = run(three, 3, 100 * MC_WORLDS, 1);
    double square[2] = { 0.0, 0.0 };
    for (int w = 0; w < MC_WORLDS; w++) {
        assert_true(alike.world_gouges[w] == alike.world_gouges[MC_WORLDS + w]);
        const double apart = own.world_gouges[w] - own.world_gouges[MC_WORLDS + w];
        square[0] += apart * apart / MC_WORLDS;
        square[1] += pow(own.world_gouges[w] - own.of[0].gouges, 2.0) / MC_WORLDS;
        assert_true(own.world_gouges[MC_WORLDS + w] == own.world_gouges[2 * MC_WORLDS + w]); /* the same draws */
    }
    /* of a variance of 100^2/3 a share of 0.8^2 is each one's: twice that between two of them */
    assert_true(fabs(square[0] / square[1] / (2.0 * 0.64) - 1.0) < 0.25);
    assert_true(fabs(own.of[0].gouges / alike.of[0].gouges - 1.0) < 0.05);
    study_mc_free(&alike);
    study_mc_free(&own);
    free(r.family);
}

/* Same seed, same bits; another seed, another draw of the same mean. */
static void test_seed(void **state)
{
    (void)state;
    rail r;
    make_rail(&r, 5.0, 2e-4, 0.5, 1400.0, 0.1, 30.0);
    const mc_surface one = as_new(&r, 0, 1.0);
    mc_result a = run(&one, 1, 2000, 1), b = run(&one, 1, 2000, 1);
    assert_memory_equal(a.of, b.of, sizeof *a.of);
    mc_result c;
    const mc_plan plan = { .histories = 2000, .shots = 1, .seed = 8, .length = LENGTH, .n = 1, .surface = &one };
    OK(study_mc_run(&plan, &c));
    assert_true(a.of[0].gouges != c.of[0].gouges);
    study_mc_free(&a);
    study_mc_free(&b);
    study_mc_free(&c);
    free(r.family);
}

static int asked;

static bool stop_soon(void)
{
    return ++asked >= 3;
}

/* Hours of grains end where that is asked for, some ten thousand grains on. */
static void test_stop(void **state)
{
    (void)state;
    rail r;
    make_rail(&r, 1e6, 2e-4, 0.5, 1400.0, 0.1, 30.0);
    const mc_surface one = as_new(&r, 0, 1.0);
    const mc_plan plan = {
        .histories = 100000, .shots = 1, .seed = 7, .length = LENGTH, .n = 1, .surface = &one, .stop = stop_soon
    };
    mc_result out;
    asked = 0;
    assert_int_equal(study_mc_run(&plan, &out).code, STATUS_STOPPED);
    assert_int_equal(asked, 3);
    study_mc_free(&out);
    free(r.family);
}

/* ---- several shots ---- */

/* One grain of 1 mm at 2.1 m gouges and leaves a rim of half its size 8 radii on: it gouges the second shot there, its
 * rim of 0.25 mm the third, 0.125 mm the fourth; then it is below the smallest. */
static void test_rims(void **state)
{
    (void)state;
    rail r;
    make_rail(&r, 1e-9, 2e-4, 0.5, 1400.0, 0.0, 0.0);
    r.site[0] = (case_site){ .position = 2.1, .radius = 1e-3 };
    r.c.sites = (case_sites){ 1, r.site };
    const mc_surface one = as_new(&r, 0, 1.0);
    mc_result out = run(&one, 1, 200, 6);
    double x = 2.1, radius = 1e-3;
    for (int k = 0; k < 6; k++) {
        const mc_shot *s = &out.of[k];
        assert_true(fabs(s->gouges - (k < 4 ? 1.0 : 0.0)) < 1e-9);
        if (k < 4) assert_true(fabs(s->first[1] - x) < LENGTH / MC_BINS);
        if (k < 4)
            assert_true(fabs(s->volume / (pow(radius, 3.0) * (10.0 + 20.0 * (x * 700.0 - 1000.0) / 1000.0)) - 1.0) <
                        0.01);
        x += 8.0 * radius;
        radius *= 0.5;
    }
    study_mc_free(&out);
    /* grains of the milling are gone after the first shot, debris comes again */
    for (int renewed = 0; renewed < 2; renewed++) {
        free(r.family);
        make_rail(&r, 5.0, 2e-4, 0.3, 1400.0, 0.0, 0.0);
        r.population.renewed = renewed;
        for (int k = 0; k < 2; k++) r.record[k].entry.result.rim_height = 0.0;
        out = run(&one, 1, 20000, 2);
        if (renewed) assert_true(fabs(out.of[1].gouges / out.of[0].gouges - 1.0) < 0.03);
        if (!renewed) assert_true(out.of[1].gouges == 0.0);
        study_mc_free(&out);
    }
    free(r.family);
}

/* However many gouges a shot makes, the next one meets all their rims: where nothing else is left, as many again. */
static void test_many_rims(void **state)
{
    (void)state;
    rail r;
    make_rail(&r, 1000.0, 3e-4, 0.1, 1400.0, 0.0, 0.0);
    r.population.renewed = false;
    const mc_surface one = as_new(&r, 0, 1.0);
    mc_result out = run(&one, 1, 1000, 2);
    assert_true(fabs(out.of[0].gouges / 1000.0 - 1.0) < 0.01);
    assert_true(fabs(out.of[1].gouges / out.of[0].gouges - 1.0) < 0.01); /* 2.4 mm on of the last metre */
    study_mc_free(&out);
    free(r.family);
}

/* Grains half as high as wide: a rim of 0.4 mm is a grain of 0.8 mm radius to the second shot. */
static void test_rims_keep_their_height(void **state)
{
    (void)state;
    rail r;
    make_rail(&r, 1e-9, 2e-4, 0.5, 1400.0, 0.0, 0.0);
    r.family->aspect = 0.5;
    for (int k = 0; k < 2; k++) {
        r.record[k].entry.result.rim_height = 0.2e-3; /* 0.4 of the radius */
        r.record[k].entry.result.crater_volume = 10.0 * 0.125e-9;
    }
    r.site[0] = (case_site){ .position = 2.1, .radius = 1e-3, .height = 0.5e-3 };
    r.c.sites = (case_sites){ 1, r.site };
    const mc_surface one = as_new(&r, 0, 1.0);
    mc_result out = run(&one, 1, 200, 2);
    assert_true(fabs(out.of[0].volume / 10e-9 - 1.0) < 1e-3);
    assert_true(fabs(out.of[1].volume / (10e-9 * pow(0.8, 3.0)) - 1.0) < 1e-3); /* sums of 200 */
    study_mc_free(&out);
    free(r.family);
}

/* ---- what shots leave for the next ---- */

static mc_along *along_of(const rail *r, int shots)
{
    mc_along *a = calloc((size_t)shots, sizeof *a);
    for (int k = 0; k < shots; k++) study_mc_velocities(&r->flown, LENGTH, a[k].v);
    return a;
}

/* Thresholds of 1400 m/s on the cold rail (x = 2 m), 1200 on the warm one; volumes double there. */
static void test_warm(void **state)
{
    (void)state;
    rail cold, warm;
    make_rail(&cold, 20.0, 2e-4, 0.5, 1400.0, 0.0, 0.0);
    make_rail(&warm, 20.0, 2e-4, 0.5, 1200.0, 0.0, 0.0);
    for (int k = 0; k < 2; k++) {
        cold.record[k].entry.result.rim_height = warm.record[k].entry.result.rim_height = 0.0;
        cold.record[k].entry.result.crater_volume = 10.0 * 0.125e-9;
        warm.record[k].entry.result.crater_volume = 20.0 * 0.125e-9;
    }
    mc_along *along = along_of(&cold, 4);
    for (int k = 0; k <= MC_PLACES; k++) {
        along[1].left[MC_WARMTH][k] = 50.0;
        along[2].left[MC_WARMTH][k] = k < MC_PLACES / 2 ? 0.0 : 100.0; /* the muzzle's half alone */
        along[3].v[k] = 0.8 * along[3].v[k];                           /* cold, but slower: 1400 m/s at 2.5 m */
    }
    mc_surface one = as_new(&cold, 0, 1.0);
    one.along = along;
    one.changed[MC_WARMTH] = (mc_changed){ &warm.grains, 100.0 };
    const double start[4] = { 2.0, 3.0 * 1300.0 / MUZZLE, 3.0 * 1200.0 / MUZZLE, 2.5 },
                 volume[4] = { 10.0, 15.0, 20.0, 10.0 };
    mc_result out = run(&one, 1, 20000, 4);
    const double mean = 20.0 * study_population_share_from(&cold.population, 1e-4),
                 each = out.of[0].volume / out.of[0].gouges;
    for (int k = 0; k < 4; k++) {
        assert_true(fabs(out.of[k].gouges - mean * (3.0 - start[k])) < four_sigma(mean, out.histories));
        assert_true(fabs(out.of[k].volume / out.of[k].gouges / each - volume[k] / volume[0]) < 0.05);
    }
    study_mc_free(&out);
    for (int k = 0; k < 9;
         k++) { /* the cold rail never gouges, or too late: then the nearer of the two counts, or both */
        cold.family->surface.size[k].velocity = cold.family->surface.size[k].interval[1] = NAN;
        cold.family->surface.size[k].interval[0] = 1.01 * MUZZLE;
    }
    for (int k = 0; k <= MC_PLACES; k++) along[1].left[MC_WARMTH][k] = k < MC_PLACES / 2 ? 40.0 : 60.0;
    cold.family->n_scenes = 0;
    out = run(&one, 1, 20000, 2);
    assert_true(out.of[0].gouges == 0.0);
    const double between = 3.0 * (0.4 * 1.01 + 0.6 * 1200.0 / MUZZLE);
    assert_true(fabs(out.of[1].gouges / (mean * (3.0 - 0.5 * (start[2] + between))) - 1.0) < 0.08);
    assert_true(fabs(out.of[1].volume / out.of[1].gouges / each - 2.0) < 0.05);
    study_mc_free(&out);
    free(along);
    free(cold.family);
    free(warm.family);
}

/* Three ways in which a rail may be another one: thresholds 1400 m/s as new, 1200 where it is warm, 1600 where it is
 * worn, 1225 where metal lies on it.  Their factors are multiplied, also
 * below all three, their volumes added. */
static void test_changes_together(void **state)
{
    (void)state;
    static const double threshold[MC_CHANGES] = { 1200.0, 1600.0, 1225.0 }, most[MC_CHANGES] = { 100.0, 2e-5, 5e-5 };
    rail fresh, other[MC_CHANGES];
    make_rail(&fresh, 20.0, 2e-4, 0.5, 1400.0, 0.0, 0.0);
    mc_surface one = as_new(&fresh, 0, 1.0);
    for (int k = 0; k < MC_CHANGES; k++) {
        make_rail(&other[k], 20.0, 2e-4, 0.5, threshold[k], 0.0, 0.0);
        for (int i = 0; i < 2; i++) {
            fresh.record[i].entry.result.rim_height = other[k].record[i].entry.result.rim_height = 0.0;
            fresh.record[i].entry.result.crater_volume = 10.0 * 0.125e-9;
            other[k].record[i].entry.result.crater_volume = (12.0 + 4.0 * k) * 0.125e-9; /* +2, +6, +10 */
        }
        one.changed[k] = (mc_changed){ &other[k].grains, most[k] };
    }
    mc_along *along = along_of(&fresh, 5);
    for (int i = 0; i <= MC_PLACES; i++) {
        along[1].left[MC_WEAR][i] = 1e-5;  /* half */
        along[2].left[MC_METAL][i] = 1e-4; /* more than was searched for counts as that */
        along[3].left[MC_WARMTH][i] = 50.0;
        along[3].left[MC_WEAR][i] = 2e-5;
        along[4].left[MC_WARMTH][i] = along[4].left[MC_METAL][i] = 1e3;
    }
    one.along = along;
    const double passed[5] = { 1400.0, 1500.0, 1225.0, 1300.0 * 1600.0 / 1400.0, 1050.0 },
                 volume[5] = { 10.0, 13.0, 20.0, 17.0, 22.0 };
    mc_result out = run(&one, 1, 20000, 5);
    const double mean = 20.0 * study_population_share_from(&fresh.population, 1e-4),
                 each = out.of[0].volume / out.of[0].gouges;
    for (int k = 0; k < 5; k++) {
        assert_true(fabs(out.of[k].gouges - mean * (3.0 - 3.0 * passed[k] / MUZZLE)) < four_sigma(mean, out.histories));
        assert_true(fabs(out.of[k].volume / out.of[k].gouges / each - volume[k] / volume[0]) < 0.08); /* r^3 of few */
    }
    study_mc_free(&out);
    free(along);
    free(fresh.family);
    for (int k = 0; k < MC_CHANGES; k++) free(other[k].family);
}

/* The grain of test_rims on a layer: its gouge is 0.6 mm deep.  Rims on the bare rail meet that one's threshold; a
 * layer is gone where the gouge is deeper and a tenth of the layer over the crater failed or was carried off. */
static void test_bare(void **state)
{
    (void)state;
    static const struct {
        double thickness, failed, carried; /* [m, 1, 1] */
        bool through;
    } all[] = { { 0.5e-3, 0.2, 0.0, true },
                { 0.5e-3, 0.06, 0.06, true },
                { 0.5e-3, 0.08, 0.0, false },
                { 0.7e-3, 0.2, 0.0, false } };
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
        const bool through = all[i].through;
        rail covered, bare;
        case_layer layer = { .thickness = all[i].thickness };
        const double over_crater = layer.thickness * 0.25 * PI * 4e-3 * 1e-3;
        make_rail(&covered, 1e-9, 2e-4, 0.5, 1400.0, 0.0, 0.0);
        make_rail(&bare, 1e-9, 2e-4, 0.5, 1900.0, 0.0, 0.0);
        covered.site[0] = (case_site){ .position = 2.1, .radius = 1e-3 };
        covered.c.sites = (case_sites){ 1, covered.site };
        covered.c.impact.rail.layers = (case_layers){ 1, &layer };
        for (int k = 0; k < 2; k++) {
            scene_result *hit = &covered.record[k].entry.result; /* of a grain half as large; 4 mm long, 1 mm wide */
            hit->crater_depth = 0.3e-3;
            hit->crater_width = 1e-3;
            hit->layers_failed_volume = all[i].failed * over_crater;
            hit->layers_carried_volume = all[i].carried * over_crater;
        }
        mc_surface one = as_new(&covered, 0, 1.0);
        one.bare = &bare.grains;
        mc_result out = run(&one, 1, 200, 2);
        assert_true(fabs(out.of[0].gouges - 1.0) < 1e-9);
        assert_true(fabs(out.of[1].gouges - (through ? 0.0 : 1.0)) < 1e-9);
        study_mc_free(&out);
        mc_along *along = along_of(&covered, 2); /* sliding has thinned the layer to 0.3 mm: then it is through */
        for (int k = 0; k <= MC_PLACES; k++)
            along[0].left[MC_WEAR][k] = along[1].left[MC_WEAR][k] = layer.thickness - 0.3e-3;
        one.along = along;
        const bool thin = all[i].failed + all[i].carried >= 0.1;
        out = run(&one, 1, 200, 2);
        assert_true(fabs(out.of[1].gouges - (thin ? 0.0 : 1.0)) < 1e-9);
        study_mc_free(&out);
        one.along = NULL;
        free(along);
        bare.grains.n = 0; /* none of its kind is fast enough there: never */
        out = run(&one, 1, 200, 2);
        assert_true(fabs(out.of[1].gouges - (through ? 0.0 : 1.0)) < 1e-9);
        study_mc_free(&out);
        free(covered.family);
        free(bare.family);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_sizes),
        cmocka_unit_test(test_many_sizes),
        cmocka_unit_test(test_closed),
        cmocka_unit_test(test_band),
        cmocka_unit_test(test_one_size),
        cmocka_unit_test(test_beyond),
        cmocka_unit_test(test_below),
        cmocka_unit_test(test_common_numbers),
        cmocka_unit_test(test_worlds_are_spread),
        cmocka_unit_test(test_own_error),
        cmocka_unit_test(test_seed),
        cmocka_unit_test(test_rims),
        cmocka_unit_test(test_many_rims),
        cmocka_unit_test(test_rims_keep_their_height),
        cmocka_unit_test(test_table_and_sites),
        cmocka_unit_test(test_warm),
        cmocka_unit_test(test_bare),
        cmocka_unit_test(test_changes_together),
        cmocka_unit_test(test_stop),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
