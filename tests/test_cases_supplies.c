/* SPDX-License-Identifier: BSD-3-Clause */
/* The cases of every supply: read as they are, run, energy closed, in the report's table too; the published pulse of
 * one unit. */
#include "coupling/case/case.h"
#include "coupling/case/profile_file.h"
#include "coupling/gouge/site_state.h"
#include "coupling/host/outdir.h"
#include "coupling/output/history.h"
#include "coupling/study/study.h"
#include "tests/circuit_common.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

#include "status_common.h"

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

/* Each kind of supply is in one of them: a new kind has a case of its own in cases/. */
static const char *const names[] = { "inductive_store", "homopolar", "alternator", "current_profile", "distributed" };

static void cases_run(void **state)
{
    (void)state;
    bool kinds[CIRCUIT_SUPPLY_KINDS] = { false };
    for (size_t k = 0; k < sizeof names / sizeof *names; k++) {
        breech_case *c = case_of(names[k]);
        const circuit_shot_config config = case_inputs_of(c).onset.launcher;
        shot_notes notes;
        circuit_shot *s = NULL;
        const circuit_shot_sink sink = notes_sink(&notes);
        assert_int_equal(circuit_shot_create(&config, &s).code, STATUS_OK);
        assert_int_equal(circuit_shot_advance(s, INFINITY, &sink).code, STATUS_OK);
        print_message("%-16s %.0f m/s, energy error %.1e\n", names[k], circuit_shot_result(s).muzzle_velocity,
                      notes.worst_error);
        assert_int_equal(notes.count[CIRCUIT_SHOT_MUZZLE], 1);
        assert_true(notes.worst_error < 1e-6); /* README's bound at the default tolerances */
        for (int i = 0; i < CIRCUIT_SUPPLY_KINDS; i++) kinds[i] = kinds[i] || config.supplies[i].n > 0;
        circuit_shot_free(s);
        case_free(c);
    }
    for (int i = 0; i < CIRCUIT_SUPPLY_KINDS; i++)
        if (!kinds[i])
            fail_msg("no case has `%s`: add one to cases/, and its name to those of tests/test_cases_supplies.c",
                     circuit_supply_sections[i]);
}

/* ---- the report's table ---- */

typedef struct {
    history *h;
    int series;
} recorder;

static bool record(void *user, const circuit_shot *s, const circuit_shot_state *state)
{
    (void)s;
    const recorder *r = user;
    double row[HISTORY_MAX_COLUMNS];
    output_history_shot_row(state, row);
    assert_int_equal(output_history_append(r->h, r->series, row).code, STATUS_OK);
    return true;
}

/* The text of a cell of the row, from 0. */
static const char *cell_of(const char *row, int k)
{
    for (int i = 0; i <= k; i++) row = strchr(strstr(row, "<td") + 1, '>') + 1;
    return row;
}

/* The table's rows are summed as a reader would; the two that no column of the history belongs to are its sums [kJ]. */
static void sum_table(const char *page, double sum[2], double *brought, double stated[2])
{
    const char *row = strstr(page, "Where the energy went"), *end = row ? strstr(row, "</table>") : NULL;
    assert_non_null(end);
    sum[0] = sum[1] = *brought = 0.0;
    int totals = 0;
    for (; (row = strstr(row, "<tr><td")) && row < end; row++) {
        const double a = atof(cell_of(row, 1)), b = atof(cell_of(row, 2));
        if (cell_of(row, 3)[0] == '<') {
            assert_true(totals < 2);
            stated[totals++] = b;
        } else {
            if (totals == 0) sum[0] += a, sum[1] += b;
            if (totals == 1) *brought += b - a;
        }
    }
    assert_int_equal(totals, 2);
}

/* What is in the table at the end is what was at the start and what was brought in, whatever the supply: no place of
 * energy is left out of it. */
static void table_closes(const char *name)
{
    static const char folder[] = "table", summary[] = "{\"kind\": \"shot\", \"status\": \"done\", \"case\": \"a\"}";
    recorder r;
    circuit_shot *s = NULL;
    char *page = NULL;
    double sum[2], brought, stated[2];
    breech_case *c = case_of(name);
    const circuit_shot_config config = case_inputs_of(c).onset.launcher;
    assert_int_equal(system("rm -rf table && mkdir table"), 0);
    assert_int_equal(output_history_open("table/history.h5", false, &r.h).code, STATUS_OK);
    assert_int_equal(output_history_shot(r.h, &r.series).code, STATUS_OK);
    assert_int_equal(circuit_shot_create(&config, &s).code, STATUS_OK);
    assert_int_equal(circuit_shot_advance(s, INFINITY, &(circuit_shot_sink){ .sample = record, .user = &r }).code,
                     STATUS_OK);
    assert_int_equal(output_history_close(r.h).code, STATUS_OK);
    assert_int_equal(host_file_write("table/summary.json", summary, sizeof summary - 1).code, STATUS_OK);
    assert_int_equal(report_write(folder, study_report_kind).code, STATUS_OK);
    assert_int_equal(host_file_read("table/report.html", &page, NULL).code, STATUS_OK);
    sum_table(page, sum, &brought, stated);
    print_message("%-16s %.3f kJ at the start, %.3f brought in, %.3f in the table\n", name, sum[0], brought, sum[1]);
    /* 20 rows, each rounded to half of the fifth digit of the sum, and 1e-6 of the energy */
    const double rounding = 20 * 0.5 * pow(10.0, floor(log10(stated[0])) - 4.0) + 1e-6 * (sum[0] + brought);
    assert_true(sum[1] > 1.0);
    assert_true(fabs(sum[1] - sum[0] - brought) < rounding);
    assert_true(fabs(stated[0] - sum[1]) < rounding && fabs(stated[1] - sum[0] - brought) < rounding);
    free(page);
    circuit_shot_free(s);
    case_free(c);
}

static void tables_close(void **state)
{
    (void)state;
    for (size_t k = 0; k < sizeof names / sizeof *names; k++) table_closes(names[k]);
}

/* 0.6 % of peak everywhere: the fitted values' own distance is 0.55 %. */
static void published_pulse(void **state)
{
    (void)state;
    breech_case *c = case_of("pulse_unit_200kJ");
    const circuit_shot_config config = case_inputs_of(c).onset.launcher;
    circuit_shot *s = NULL;
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
                                             { "0,0\n1e-3,5\n1e-3,0\n", "bad.csv:3: 0.001 s comes after" },
                                             { "0,0\n1e-3,nan\n2e-3,0\n", "bad.csv:2" },
                                             { "t,i,v\n0,0,1\n1e-3,5,1\n2e-3,0,1\n", "bad.csv:2" },
                                             { "t [ms], i [kA]\n0,0\n1,5\n2,0\n", "column 1 in ms" },
                                             { "t [s], i [kA]\n0,0\n1,5\n2,0\n", "column 2 in kA" },
                                             { "time,current\n0,0\n1e-3,5\n2e-3,1\n",
                                               "the last within 5 % of the peak" } };
    for (size_t k = 0; k < sizeof tables / sizeof *tables; k++) {
        FILE *f = fopen("bad.csv", "w");
        assert_non_null(f);
        fputs(tables[k][0], f);
        fclose(f);
        const char text[] =
            "name: t\ncurrent_profiles: {file: bad.csv}\nrail: {height: 25 mm, thickness: 20 mm, separation: "
            "25 mm}\nbarrel: {length: 1 m}\narmature: {mass: 1 kg}\n";
        const case_text in = { text, sizeof text - 1, "t.yaml", NULL, 0 };
        char *errors = NULL;
        breech_case *c = NULL;
        circuit_shot *s = NULL;
        const status read = case_read_memory(&in, &(case_options){ .needs = CASE_FOR_SHOT }, &c, &errors);
        if (read.code == STATUS_OK) {
            const circuit_shot_config config = case_inputs_of(c).onset.launcher;
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

/* The byte-order mark that a spreadsheet writes first is no part of the table. */
static void marked_table(void **state)
{
    (void)state;
    static const char table[] = "\xEF\xBB\xBF"
                                "0,0\n1e-3,5\n2e-3,0\n";
    circuit_supply_point *points = NULL;
    int n = 0;
    OK(host_file_write("marked.csv", table, sizeof table - 1));
    OK(case_profile_read("marked.csv", &points, &n));
    assert_int_equal(n, 3);
    assert_true(points[1].time == 1e-3 && points[1].current == 5.0);
    free(points);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cases_run),  cmocka_unit_test(tables_close), cmocka_unit_test(published_pulse),
        cmocka_unit_test(bad_tables), cmocka_unit_test(marked_table),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
