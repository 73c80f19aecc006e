/* The cases of every supply: read as they are, run, energy closed; the published pulse of one unit. */
#include "coupling/gouge/site_state.h"
#include "tests/circuit_common.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

#define CASES BREECH_TESTS "/../cases/"

static breech_case *case_of(const char *name)
{
    char path[400], *errors = NULL;
    breech_case *c = NULL;
    snprintf(path, sizeof path, CASES "%s", name);
    const status st = case_read(path, NULL, 0, &(case_options){ .needs = CASE_FOR_SHOT }, &c, &errors);
    if (st.code != STATUS_OK) fail_msg("%s", errors ? errors : st.text);
    free(errors);
    return c;
}

static void cases_run(void **state)
{
    (void)state;
    static const char *const names[] = { "inductive_store", "homopolar", "alternator", "current_profile",
                                         "distributed" };
    bool kinds[SUPPLY_KINDS] = { false };
    for (size_t k = 0; k < sizeof names / sizeof *names; k++) {
        breech_case *c = case_of(names[k]);
        const shot_config config = gouge_shot_config(c, NULL);
        shot_notes notes;
        shot *s = NULL;
        const shot_sink sink = notes_sink(&notes);
        assert_int_equal(circuit_shot_create(&config, &s).code, STATUS_OK);
        assert_int_equal(circuit_shot_advance(s, INFINITY, &sink).code, STATUS_OK);
        print_message("%-16s %.0f m/s, energy error %.1e\n", names[k], circuit_shot_result(s).muzzle_velocity,
                      notes.worst_error);
        assert_int_equal(notes.count[SHOT_MUZZLE], 1);
        assert_true(notes.worst_error < 1e-6); /* ARCHITECTURE's bound at the default tolerances */
        for (int i = 0; i < SUPPLY_KINDS; i++) kinds[i] = kinds[i] || config.supplies[i].n > 0;
        circuit_shot_free(s);
        case_free(c);
    }
    for (int i = 0; i < SUPPLY_KINDS; i++) assert_true(kinds[i]); /* a case a kind */
}

/* 0.6 % of peak everywhere: the fitted values' own distance is 0.55 %. */
static void published_pulse(void **state)
{
    (void)state;
    breech_case *c = case_of("pulse_unit_200kJ");
    const shot_config config = gouge_shot_config(c, NULL);
    shot *s = NULL;
    assert_int_equal(circuit_shot_create(&config, &s).code, STATUS_OK);
    int rows;
    const double misfit = pulse_misfit(s, CASES "pulse_unit_200kJ/pulse_unit_200kJ.csv", &rows);
    print_message("worst difference %.3f %% of peak over %d rows\n", 100.0 * misfit, rows);
    assert_int_equal(rows, 54);
    assert_true(misfit < 0.006);
    circuit_shot_free(s);
    case_free(c);
}

/* What is wrong with a table is said with its file and line, or its point. */
static void bad_tables(void **state)
{
    (void)state;
    static const char *const tables[][2] = { { "0,0\n1e-3,x\n", "bad.csv:2" },
                                             { "0,0\n1e-3,5\n1e-3,0\n", "times must ascend" },
                                             { "time,current\n0,0\n1e-3,5\n2e-3,1\n", "the last 0 A" } };
    for (size_t k = 0; k < sizeof tables / sizeof *tables; k++) {
        FILE *f = fopen("bad.csv", "w");
        assert_non_null(f);
        fputs(tables[k][0], f);
        fclose(f);
        const char text[] =
            "name: t\ncurrent_profiles: {file: bad.csv}\nrails: {height: 25 mm, thickness: 20 mm, separation: "
            "25 mm}\nbarrel: {length: 1 m}\narmature: {mass: 1 kg}\n";
        const case_text in = { text, sizeof text - 1, "t.yaml", NULL, 0 };
        char *errors = NULL;
        breech_case *c = NULL;
        shot *s = NULL;
        const status read = case_read_memory(&in, &(case_options){ .needs = CASE_FOR_SHOT }, &c, &errors);
        if (read.code == STATUS_OK) {
            const shot_config config = gouge_shot_config(c, NULL);
            const status made = circuit_shot_create(&config, &s);
            assert_int_equal(made.code, STATUS_BAD_INPUT);
            assert_non_null(strstr(made.text, tables[k][1]));
        } else {
            assert_non_null(strstr(errors, tables[k][1]));
        }
        free(errors);
        case_free(c);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cases_run),
        cmocka_unit_test(published_pulse),
        cmocka_unit_test(bad_tables),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
