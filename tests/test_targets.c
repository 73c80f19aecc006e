/* SPDX-License-Identifier: BSD-3-Clause */
/* breech compare over targets: each the same as a strike of its own, ranked by what it does to the projectile. */
#include "coupling/study/target_compare.h"

#include "program_common.h"

/* ---- the order ---- */

static target_entry entry(strike_class class, double residual, double lo, double hi)
{
    return (target_entry){ .is = { .class = class, .impact_velocity = 1000.0, .residual_velocity = residual },
                           .limit = 0.5 * (lo + hi),
                           .limit_interval = { lo, hi } };
}

/* What holds comes first, then what leaves less velocity; what differs by less than a hundredth of the arrival's is
 * tied with the best of its group, never with the next alone.  What is not decided comes last, tied with the best. */
static void test_by_arrival(void **state)
{
    (void)state;
    target_entry e[] = { entry(STRIKE_UNFINISHED, 100.0, NAN, NAN), entry(STRIKE_PIERCED, 516.0, NAN, NAN),
                         entry(STRIKE_PIERCED, 508.0, NAN, NAN),    entry(STRIKE_TORN, 0.0, NAN, NAN),
                         entry(STRIKE_PIERCED, 500.0, NAN, NAN),    entry(STRIKE_REBOUND, -30.0, NAN, NAN),
                         entry(STRIKE_BULGED, 1.0, NAN, NAN) };
    target_ranking r = { .n = 7, .ranking = e };
    static const double left[] = { -30.0, 1.0, 0.0, 500.0, 508.0, 516.0, 100.0 };
    static const int tied[] = { 1, 1, 3, 4, 4, 6, 1 };
    study_targets_rank(&r);
    for (int k = 0; k < 7; k++) {
        assert_true(e[k].is.residual_velocity == left[k]);
        assert_int_equal(e[k].tied, tied[k]);
    }
}

/* Brackets that overlap are tied; beyond the range of the search one end is known. */
static void test_by_limit(void **state)
{
    (void)state;
    target_entry e[] = { entry(STRIKE_PIERCED, 0.0, 300.0, 350.0), entry(STRIKE_PIERCED, 0.0, NAN, 200.0),
                         entry(STRIKE_PIERCED, 0.0, 340.0, 400.0), entry(STRIKE_PIERCED, 0.0, 900.0, NAN) };
    target_ranking r = { .n = 4, .by_limit = 1, .ranking = e };
    static const int tied[] = { 1, 2, 2, 4 };
    study_targets_rank(&r);
    assert_true(e[0].limit_interval[0] == 900.0 && e[1].limit_interval[0] == 340.0 && e[3].limit_interval[1] == 200.0);
    for (int k = 0; k < 4; k++) assert_int_equal(e[k].tied, tied[k]);
}

/* The interval where all is well, where one class is missing, where nothing slow is decided, and where the limit turns
 * back: then it spans all of it, to the fastest that is held where nothing faster pierces. */
static void test_limit_ends(void **state)
{
    (void)state;
    enum { H = STRIKE_BULGED, O = STRIKE_UNFINISHED, P = STRIKE_PIERCED, MOST = 5 };
    static const struct {
        int class[MOST];
        double lo, hi;
        bool turns_back;
    } cases[] = {
        { { H, H, O, P, P }, 200.0, 400.0, false }, /* at 100, 200 .. 500 m/s */
        { { H, H, H, H, H }, 500.0, NAN, false },   { { P, P, P, P, P }, NAN, 100.0, false },
        { { O, O, P, O, O }, NAN, 300.0, false },   { { O, O, O, O, O }, NAN, NAN, false },
        { { H, P, H, P, P }, 100.0, 400.0, true },  { { O, P, H, P, P }, NAN, 400.0, true },
        { { H, P, P, P, H }, 100.0, 500.0, true },
    };
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
        strike_arrival arrival[MOST];
        for (int i = 0; i < MOST; i++)
            arrival[i].is = (strike_outcome){ .class = cases[c].class[i], .impact_velocity = 100.0 * (i + 1) };
        strike_limit l = { .arrivals = MOST, .arrival = arrival };
        const double want[2] = { cases[c].lo, cases[c].hi };
        assert_true(study_strike_limit_ends(&l, STRIKE_PIERCED) == !cases[c].turns_back);
        for (int k = 0; k < 2; k++) assert_true(isnan(want[k]) ? isnan(l.interval[k]) : l.interval[k] == want[k]);
        assert_true(isnan(want[0] + want[1]) ? isnan(l.velocity) : l.velocity == 0.5 * (want[0] + want[1]));
    }
}

/* ---- the command ---- */

#define TARGETS                                                                                                        \
    "base: " CASES "/sphere_plate\nname: t\nstrike: {velocity: 1 km/s, travel: 12 mm}\n"                               \
    "scene: {cell: 0.8 mm, coarse_cell: 1.6 mm, levels: 2}\noutput: {snapshots: 0}\n"                                  \
    "targets:\n  - name: thin\n    change: [{key: \"scene.bodies[0].shape\", value: \"{box: {lo: 2 -12 -12 mm, hi: 3 " \
    "12 12 mm}}\"}]\n"                                                                                                 \
    "  - name: light\n    change: [{key: \"scene.bodies[0].material\", value: al6061_t6}]\n"

static const cJSON *target(const cJSON *s, const char *name)
{
    const cJSON *e;
    cJSON_ArrayForEach(e, cJSON_GetObjectItemCaseSensitive(s, "ranking"))
    {
        if (strcmp(cJSON_GetObjectItemCaseSensitive(e, "target")->valuestring, name) == 0) return e;
    }
    fail_msg("no target %s", name);
    return NULL;
}

static void write_targets(const char *folder)
{
    char path[200];
    fresh_folder(folder);
    snprintf(path, sizeof path, "%s/case.yaml", folder);
    OK(host_file_write(path, TARGETS, strlen(TARGETS)));
}

/* Each target is, to the last bit, a strike of its own; the mass is that of the shape; the report names the best. */
static void test_as_strikes_of_their_own(void **state)
{
    (void)state;
    static const char *const own[] = { "name=t", "scene.bodies[0].shape={box: {lo: 2 -12 -12 mm, hi: 3 12 12 mm}}",
                                       "scene.bodies[0].material=al6061_t6" };
    static const char *const name[] = { "given", "thin", "light" };
    static const char *const same[] = { "residual_velocity", "energy_absorbed", "peak_force", "target_mass",
                                        "failed_volume" };
    write_targets("t");
    assert_int_equal(run("compare t -o t/all --quiet"), 0);
    cJSON *all = summary_of("t/all");
    assert_text(all, "kind", "compare_targets");
    assert_text(all, "ranked_by", "residual_velocity");
    for (int k = 0; k < 3; k++) {
        char arguments[400];
        snprintf(arguments, sizeof arguments,
                 "strike t -o t/one --force --quiet --set output.report=no --set targets=[] --set '%s'", own[k]);
        assert_int_equal(run(arguments), 0);
        cJSON *one = summary_of("t/one");
        for (size_t i = 0; i < sizeof same / sizeof same[0]; i++)
            assert_true(number(one, same[i]) == number(target(all, name[k]), same[i]));
        cJSON_Delete(one);
    }
    assert_true(fabs(number(target(all, "given"), "target_mass") / (7830.0 * 24e-3 * 24e-3 * 3e-3) - 1.0) < 0.01);
    assert_true(number(target(all, "given"), "tied") == 1.0);
    assert_true(number(target(all, "thin"), "tied") >= 2.0);
    assert_true(contains("t/all/report.html", "The best target is <b>given</b>"));
    assert_true(contains("t/all/report.html", "<h2>Targets</h2>"));
    cJSON_Delete(all);
}

static void refused(const char *set, const char *words)
{
    char arguments[700];
    snprintf(arguments, sizeof arguments, "compare bad -o bad/out --quiet --set %s", set);
    assert_refused(arguments, "bad/out", words);
}

/* All errors are told before anything runs, with the name of the target and the place of the change. */
static void test_refused(void **state)
{
    (void)state;
    write_targets("bad");
    refused("'targets[0].name=given'", "the target of the case as it is has this name");
    refused("'targets[0].name=light'", "targets[1].name = light: two have this name");
    refused("'targets[0].change=[]'", "targets[0].change is empty: thin");
    refused(
        "'targets[1].change[0].value=unobtainium'",
        "--set targets[1].change[0].value=unobtainium: targets[1].change[0].value: light: scene.bodies[0].material");
    refused("'targets[0].change[0].value=\"{box: {lo: -2 -12 -12 mm, hi: 3 12 12 mm}}\"'",
            "targets[0].change[0].value: thin: ");
    refused("strike.projectile=none", "strike");
    refused("'targets[0].change[0].key=scene.bodies[0].materal'",
            "--set targets[0].change[0].key=scene.bodies[0].materal: targets[0].change[0].key: thin: unknown key `m");
    refused("'targets[0].change[0].key=scene.bodies[7].material'",
            "bad/case.yaml:8:52: targets[0].change[0].value: thin: ");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_by_arrival), cmocka_unit_test(test_by_limit),
        cmocka_unit_test(test_limit_ends), cmocka_unit_test(test_as_strikes_of_their_own),
        cmocka_unit_test(test_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
