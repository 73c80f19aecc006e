/* SPDX-License-Identifier: BSD-3-Clause */
/* Expectations beside a case, compared with a summary: what holds, what fails, what is refused. */
#include "coupling/output/expect.h"

#include "coupling/case/case_schema.h"
#include "coupling/host/outdir.h"
#include "coupling/host/units.h"
#include "coupling/study/study.h"
#include "mpm/read/probe.h"
#include "tests/program_common.h"

#include <math.h>
#include <string.h>

static const char SUMMARY[] =
    "{\"crater_depth\": 0.00055, \"energy_error\": -2e-7, \"class\": \"gouge\", \"none\": null,"
    " \"numbers\": {\"failed_volume.rail\": {\"mean\": 2e-9}},"
    " \"probes\": {\"push\": {\"peak\": 4.85e10}}, \"peak_temperature\": 380,"
    " \"scenes\": [{\"name\": \"a\", \"v\": 1500}, {\"name\": \"b\", \"v\": 1600}],"
    " \"ranking\": [{\"surface\": \"as it is\", \"v\": 700}, {\"surface\": \"warm rail\", \"v\": 640}]}";

static const char *summary = SUMMARY; /* that is compared with */

static status compare(const char *list, expectations *e)
{
    assert_int_equal(host_folder_make("run").code, STATUS_OK);
    assert_int_equal(host_file_write("run/summary.json", summary, strlen(summary)).code, STATUS_OK);
    assert_int_equal(host_file_write("expected.yaml", list, strlen(list)).code, STATUS_OK);
    return output_expect("case.yaml", "run", study_tables, e);
}

/* One expectation: does it hold? */
static bool holds(const char *entry)
{
    expectations e;
    char list[300];
    snprintf(list, sizeof list, "- {%s}\n", entry);
    const status s = compare(list, &e);
    if (s.code != STATUS_OK) fail_msg("%s", s.text);
    assert_int_equal(e.n, 1);
    const bool all = e.held == 1;
    assert_true(all == e.item[0].holds);
    output_expect_free(&e);
    return all;
}

static void refused(const char *entry, const char *said)
{
    expectations e;
    char list[300];
    snprintf(list, sizeof list, "- {%s}\n", entry);
    const status s = compare(list, &e);
    assert_int_equal(s.code, STATUS_BAD_INPUT);
    if (!strstr(s.text, said) || !strstr(s.text, "expected.yaml:1:")) fail_msg("%s", s.text);
    output_expect_free(&e);
}

static void test_numbers(void **state)
{
    (void)state;
    assert_true(holds("key: crater_depth, value: 0.56 mm, within: 3 %"));
    assert_false(holds("key: crater_depth, value: 0.56 mm, within: 1 %"));
    assert_true(holds("key: crater_depth, value: 0.5 mm, within: 51 um"));
    assert_false(holds("key: crater_depth, value: 0.5 mm, within: 49 um"));
    assert_true(holds("key: energy_error, at_least: -1e-6, at_most: 1e-6"));
    assert_false(holds("key: energy_error, at_least: 0"));
    assert_false(holds("key: energy_error, at_most: -1e-6"));
    assert_true(holds("key: probes.push.peak, value: 48.48 GPa, within: 0.5 %"));
    assert_true(holds("key: 'scenes[1].v', value: 1.6 km/s, within: 0 m/s"));
    assert_true(holds("key: 'scenes[a].v', value: 1.5 km/s, within: 0 m/s"));
    assert_true(holds("key: 'ranking[warm rail].v', value: 640 m/s, within: 0 m/s"));
    assert_false(holds("key: 'scenes[4294967297].v', value: 1.6 km/s, within: 0 m/s"));  /* 1 to 32 bits */
    assert_false(holds("key: 'scenes[-4294967295].v', value: 1.6 km/s, within: 0 m/s")); /* and so is this */
    assert_true(holds("key: 'numbers[failed_volume.rail].mean', value: 2 mm^3, within: 0 m^3"));
    assert_false(holds("key: 'scenes[c].v', value: 1.5 km/s, within: 1 km/s"));
    assert_true(holds("key: peak_temperature, value: 100 degC, within: 10 degC")); /* a band is a difference */
    assert_false(holds("key: peak_temperature, value: 100 degC, within: 1 degC"));
    assert_true(holds("key: peak_temperature, value: 370 K, within: 11 degC"));
    assert_true(holds("key: peak_temperature, value: 379.5 K, within: 1 degF"));
}

static void test_words(void **state)
{
    (void)state;
    assert_true(holds("key: class, is: gouge"));
    assert_false(holds("key: class, is: scratch"));
    assert_true(holds("key: none, is: none"));
    assert_false(holds("key: missing, is: none"));
    assert_false(holds("key: missing, value: 1, within: 1"));
    assert_false(holds("key: class, value: 1, within: 1"));
}

static void test_refused(void **state)
{
    (void)state;
    refused("key: crater_depth", "give a value");
    refused("value: 1, within: 1", "`key` is missing");
    refused("key: crater_depth, value: 1 mm", "belong together");
    refused("key: crater_depth, value: 1 furlongs_of_beer, within: 1", "must be a number with a unit");
    refused("key: class, is: gouge, at_least: 1", "`is` and `at_least` exclude each other");
    refused("key: crater_depth, value: 0.5 mm, within: -10 %", "within = -10 %: must not be negative");
    refused("key: crater_depth, valeu: 1 mm, within: 1 mm", "unknown key `valeu`");
}

/* A number in this unit is taken as it is. */
static void unit_is_known(const units *u, const char *name, const char *unit)
{
    char text[60];
    const char *found;
    double value = NAN;
    if (!unit[0]) return;
    snprintf(text, sizeof text, "1.5 %s", unit);
    if (!output_number_in_si(u, text, &value, &found) || value != 1.5) fail_msg("%s: %s", name, text);
}

static void units_of_keys(const units *u, const summary_key *keys)
{
    for (const summary_key *k = keys; k && k->name; k++) {
        unit_is_known(u, k->name, k->unit);
        units_of_keys(u, k->item);
    }
}

static void units_of_sections(const units *u, const case_section *sections)
{
    for (const case_section *s = sections; s; s = s->also) {
        for (const base_param *p = s->table; p && p->key; p++)
            if (p->kind == BASE_PARAM_NUMBER) unit_is_known(u, p->key, p->unit);
        for (const case_section *child = s->children; child && child->key; child++) units_of_sections(u, child);
    }
}

/* Every number of a summary may be expected, every key of a case varied, in the unit that its table says. */
static void test_units(void **state)
{
    (void)state;
    units *u;
    OK(host_units_open(&u));
    const study *const others[] = { &study_ensemble, &study_bodies, &study_rail_life, &study_compare_life,
                                    &study_compare_targets };
    for (int k = 0; k < STUDIES; k++) units_of_keys(u, study_list[k]->keys);
    for (size_t k = 0; k < sizeof others / sizeof *others; k++) units_of_keys(u, others[k]->keys);
    for (int i = 0; mpm_probe_kind_at(i); i++)
        for (const mpm_column *c = mpm_probe_kind_at(i)->columns; c->name; c++) unit_is_known(u, c->name, c->unit);
    units_of_sections(u, &case_root);
    host_units_close(u);
}

/* A band without the value's unit is that many metres wide, and everything holds. */
static void test_units_agree(void **state)
{
    (void)state;
    refused("key: crater_depth, value: 0.5 mm, within: 0.1", "within = 0.1: must be in a unit of m");
    refused("key: crater_depth, value: 0.5, within: 0.1 mm", "within = 0.1 mm: must be in a unit of 1");
    refused("key: crater_depth, at_least: 0.5 mm, at_most: 1 ms", "at_most = 1 ms: must be in a unit of m");
    refused("key: probes.push.peak, value: 48 GPa, within: 1 %, at_least: 40",
            "at_least = 40: must be in a unit of Pa");
    refused("key: crater_depth, value: 5 %, within: 0.1 mm", "within = 0.1 mm: must be in a unit of 1");
    assert_true(holds("key: crater_depth, at_least: 0, at_most: 1 mm"));
    assert_true(holds("key: crater_depth, at_least: 0.5 mm, at_most: .inf"));
    assert_false(holds("key: crater_depth, value: 0.5 mm, within: 0"));
    assert_true(holds("key: crater_depth, value: 0.5 mm, within: 20 %, at_least: 540 um"));
}

/* The unit is the summary's, which its kind's tables, its probes and a sweep say: one of the same kind is converted,
 * one of another is refused however right its number is. */
static void test_unit_of_the_summary(void **state)
{
    (void)state;
    summary =
        "{\"kind\": \"bodies\", \"peak_pressure\": 5e9, \"steps\": 30, \"energy_error\": 0.02,"
        " \"bodies\": {\"ball.1\": {\"velocity\": [3, 0, 0], \"failed_volume\": 2e-9}},"
        " \"probes\": {\"push\": {\"kind\": \"force\", \"unit\": \"N\", \"peak\": 40, \"impulse\": [7, 0, 0],"
        " \"last\": {\"force_x\": 6}}, \"warm\": {\"kind\": \"pressure\", \"unit\": \"K\", \"impulse\": [5, 0, 0]}}}";
    assert_true(holds("key: peak_pressure, value: 5 GPa, within: 0.1 %"));
    assert_true(holds("key: peak_pressure, value: 50 kbar, within: 1 MPa, at_least: 0, at_most: .inf"));
    refused("key: peak_pressure, value: 5e9 m, within: 1 m", "value = 5e9 m: must be in a unit of Pa");
    refused("key: peak_pressure, value: 5e9, within: 1 %", "value = 5e9: must be in a unit of Pa");
    refused("key: peak_pressure, value: 5 GPa, within: 1 s", "within = 1 s: must be in a unit of Pa");
    refused("key: peak_pressure, at_most: 0 s", "at_most = 0 s: must be in a unit of Pa");
    assert_true(holds("key: steps, value: 30, within: 0"));
    refused("key: steps, value: 30 m, within: 0", "must be in a unit of 1");
    assert_true(holds("key: energy_error, at_most: 2 %"));
    refused("key: energy_error, at_most: 2 m", "must be in a unit of 1");
    assert_true(holds("key: 'bodies[ball.1].velocity[0]', value: 0.003 km/s, within: 0 m/s"));
    refused("key: 'bodies[ball.1].velocity[0]', value: 3 m, within: 0", "must be in a unit of m/s");
    assert_true(holds("key: 'bodies[ball.1].failed_volume', value: 2 mm3, within: 0"));
    assert_true(holds("key: probes.push.peak, at_least: 0.04 kN"));
    refused("key: probes.push.peak, at_least: 40 J", "must be in a unit of N");
    assert_true(holds("key: 'probes.push.impulse[0]', value: 7000 mN s, within: 0"));
    refused("key: 'probes.push.impulse[0]', value: 7 N, within: 0", "must be in a unit of N s");
    refused("key: 'probes.warm.impulse[0]', value: 5 K, within: 0", "must be in a unit of K s");
    assert_true(holds("key: probes.push.last.force_x, value: 6 N, within: 0"));
    refused("key: probes.push.last.force_x, value: 6 m, within: 0", "must be in a unit of N");
    summary = "{\"kind\": \"onset\", \"shot\": {\"muzzle_velocity\": 1900}, \"scenes\": [{\"name\": \"a\", "
              "\"velocity\": 8}]}";
    assert_true(holds("key: shot.muzzle_velocity, value: 1.9 km/s, within: 0"));
    refused("key: shot.muzzle_velocity, value: 1900 m, within: 0", "must be in a unit of m/s");
    refused("key: 'scenes[a].velocity', value: 8 m, within: 0", "must be in a unit of m/s");
    summary =
        "{\"kind\": \"sweep\", \"units\": {\"bank.charge\": \"V\"}, \"sweep\": [{\"inputs\": {\"bank.charge\": 9}}]}";
    assert_true(holds("key: 'sweep[0].inputs[bank.charge]', value: 9 V, within: 0"));
    refused("key: 'sweep[0].inputs[bank.charge]', value: 9 A, within: 0", "must be in a unit of V");
    summary = SUMMARY;
}

/* NAME.yaml has its list in NAME_expected.yaml; without one there is nothing to compare. */
static void test_names(void **state)
{
    (void)state;
    expectations e;
    const char list[] = "- {key: class, is: gouge}\n";
    remove("coarse_expected.yaml"); /* of an earlier run of this test */
    assert_int_equal(output_expect("coarse.yaml", "run", study_tables, &e).code, STATUS_BAD_INPUT);
    output_expect_free(&e);
    assert_int_equal(host_file_write("coarse_expected.yaml", list, strlen(list)).code, STATUS_OK);
    assert_int_equal(output_expect("coarse.yaml", "run", study_tables, &e).code, STATUS_OK);
    assert_int_equal(e.held, 1);
    output_expect_free(&e);
}

/* The program's table takes what a list may hold: a long text, and one with the bar that parts a table's cells. */
static void test_table(void **state)
{
    (void)state;
    expectations e;
    char list[400];
    snprintf(list, sizeof list, "- {key: class, is: gouge}\n- {key: '%0110d', is: none}\n- {key: class, is: 'a|b'}\n",
             0);
    assert_int_equal(host_file_write("case.yaml", "name: one\n", 10).code, STATUS_OK);
    assert_int_equal(compare(list, &e).code, STATUS_OK);
    output_expect_free(&e);
    assert_int_equal(run("check case.yaml --expect run"), 1);
    assert_true(contains("out.txt", "1 of 3 expectations hold"));
    assert_true(contains("out.txt", "  a|b\n") && contains("out.txt", "0000...  none\n"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_numbers),     cmocka_unit_test(test_words),
        cmocka_unit_test(test_refused),     cmocka_unit_test(test_names),
        cmocka_unit_test(test_table),       cmocka_unit_test(test_units),
        cmocka_unit_test(test_units_agree), cmocka_unit_test(test_unit_of_the_summary)
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
