/* SPDX-License-Identifier: BSD-3-Clause */
/* summary.json: every key of the design is there for every kind of run and every end of it, and says what it was given.
 */
#include "output_common.h"

#include "coupling/gouge/watch.h"
#include "coupling/host/outdir.h"
#include "coupling/output/history.h"
#include "coupling/scene/scene_probe.h"

#include <cJSON.h>

#include "manual_common.h"

/* The design's list, typed here once more on purpose: a key renamed in the table must make this test fail. */
static const char *const all_keys[] = { "case", "version", "instruction_set", "status", "error", "warnings", NULL };
static const char *const kind_keys[STUDIES][32] = {
    [STUDY_shot] = { "peak_current", "muzzle_velocity", "muzzle_time", "muzzle_energy", "efficiency", "action",
                     "peak_acceleration", "exit_current", "energy_error", "end_time", "end_position", "end_velocity",
                     "time_ran_out", "steps", "wall_seconds" },
    [STUDY_scene] = { "class",
                      "severity",
                      "crater_length",
                      "crater_width",
                      "crater_depth",
                      "crater_volume",
                      "rim_height",
                      "widening",
                      "max_pressure",
                      "peak_pressure",
                      "peak_force",
                      "peak_temperature",
                      "peak_mises_armature",
                      "peak_mises_rail",
                      "momentum_error",
                      "energy_error",
                      "failed_volume",
                      "particles",
                      "steps",
                      "particle_steps",
                      "particle_steps_dense",
                      "wall_seconds",
                      "threads" },
    [STUDY_onset] = { "verdict", "probability_gouge", "threshold_velocity", "threshold_interval", "onset_position",
                      "onset_interval", "scenes_run", "scenes_skipped", "sites", "wall_seconds" },
    [STUDY_strike] = { "impact_velocity", "class", "residual_velocity", "energy_absorbed", "peak_force", "impulse",
                       "deflection", "failed_volume", "debris_mass", "limit_velocity", "limit_interval", "arrivals",
                       "bodies", "probes", "energy_error", "wall_seconds" },
    [STUDY_life] = { "life", "life_first", "life_position", "life_depth", "life_angle", "wall_seconds" },
    [STUDY_vessel] = { "burst", "rupture_time", "rupture_swelling", "rupture_pressure", "vent_time", "wall_seconds" },
    [STUDY_compare] = { "ranking" },
    [STUDY_sweep] = { "of", "resolution", "units", "sweep", "wall_seconds" },
    [STUDY_inductance] = { "L_gradient", "R_gradient", "frequency", "L_gradient_high_frequency" },
};

/* Everything that a run of the kind may have. */
typedef struct {
    example_results from;
    run_summary summary;
} example;

static void fill(example *e, int kind)
{
    example_fill(&e->from);
    e->summary = study_summary(study_list[kind], &e->from.answer[kind]);
    e->summary.case_name = "a \"case\"";
    e->summary.instruction_set = "x86-64-v3";
    e->summary.status = RUN_DONE;
    e->summary.warnings = "first\nsecond\n";
}

static cJSON *parsed(const run_summary *s)
{
    char *text = output_summary_text(s);
    assert_non_null(text);
    cJSON *root = cJSON_Parse(text);
    assert_non_null(root);
    free(text);
    return root;
}

static void has_keys(const cJSON *object, const char *const *keys)
{
    for (; *keys; keys++)
        if (!cJSON_HasObjectItem(object, *keys)) fail_msg("key %s is missing", *keys);
}

static double number_of(const cJSON *object, const char *key)
{
    const cJSON *value = cJSON_GetObjectItemCaseSensitive(object, key);
    assert_true(cJSON_IsNumber(value));
    return value->valuedouble;
}

static void every_key_for_every_kind(void **state)
{
    (void)state;
    for (int kind = 0; kind < STUDIES; kind++) {
        example e;
        fill(&e, kind);
        cJSON *root = parsed(&e.summary);
        has_keys(root, all_keys);
        has_keys(root, kind_keys[kind]);
        assert_string_equal(cJSON_GetStringValue(cJSON_GetObjectItem(root, "status")), "done");
        assert_true(cJSON_IsNull(cJSON_GetObjectItem(root, "error")));
        assert_int_equal(cJSON_GetArraySize(cJSON_GetObjectItem(root, "warnings")), 2);
        cJSON_Delete(root);
    }
}

static void every_key_on_failure_too(void **state)
{
    (void)state;
    for (int kind = 0; kind < STUDIES; kind++) {
        run_summary s = study_summary(study_list[kind], &(study_answer){ .result = NULL });
        s.status = RUN_FAILED;
        s.error = "it \"broke\"\nat 1 us";
        cJSON *root = parsed(&s);
        has_keys(root, all_keys);
        has_keys(root, kind_keys[kind]);
        assert_string_equal(cJSON_GetStringValue(cJSON_GetObjectItem(root, "error")), s.error);
        for (const char *const *key = kind_keys[kind]; *key; key++)
            assert_true(cJSON_IsNull(cJSON_GetObjectItem(root, *key)));
        cJSON_Delete(root);
    }
}

/* JSON texts hold 17 digits: what is read back is the same double. */
static void numbers_come_back_exactly(void **state)
{
    (void)state;
    example e;
    fill(&e, STUDY_shot);
    e.from.shot.is.peak_current = 1.0 / 3.0 * 1e6;
    cJSON *root = parsed(&e.summary);
    assert_true(number_of(root, "peak_current") == e.from.shot.is.peak_current);
    assert_true(number_of(root, "steps") == 1234.0);
    assert_string_equal(cJSON_GetStringValue(cJSON_GetObjectItem(root, "case")), "a \"case\"");
    cJSON_Delete(root);

    fill(&e, STUDY_scene);
    root = parsed(&e.summary);
    assert_true(number_of(root, "severity") == 0.4);
    assert_string_equal(cJSON_GetStringValue(cJSON_GetObjectItem(root, "class")), "gouge");
    assert_true(number_of(cJSON_GetObjectItem(root, "failed_volume"), "armature") == 2e-9);
    assert_true(cJSON_GetArrayItem(cJSON_GetObjectItem(root, "peak_force"), 1)->valuedouble == -9e3);
    cJSON_Delete(root);
}

static void what_is_not_there_is_null(void **state)
{
    (void)state;
    example e;
    fill(&e, STUDY_onset);
    e.from.study.result.verdict = VERDICT_NO_GOUGING;
    e.from.study.result.onset_position = NAN;
    e.from.study.result.onset_interval[0] = e.from.study.result.onset_interval[1] = NAN;
    e.from.study.result.threshold_interval[1] = INFINITY;
    cJSON *root = parsed(&e.summary);
    assert_true(cJSON_IsNull(cJSON_GetObjectItem(root, "onset_position")));
    assert_true(cJSON_IsNull(cJSON_GetObjectItem(root, "onset_interval")));
    const cJSON *interval = cJSON_GetObjectItem(root, "threshold_interval");
    assert_int_equal(cJSON_GetArraySize(interval), 2);
    assert_true(cJSON_IsNull(cJSON_GetArrayItem(interval, 1)));
    assert_string_equal(cJSON_GetStringValue(cJSON_GetObjectItem(root, "verdict")), "no_gouging");
    cJSON_Delete(root);
}

static void onset_carries_shot_sites_and_scenes(void **state)
{
    (void)state;
    example e;
    fill(&e, STUDY_onset);
    cJSON *root = parsed(&e.summary);
    has_keys(cJSON_GetObjectItem(root, "shot"), kind_keys[STUDY_shot]);
    const cJSON *sites = cJSON_GetObjectItem(root, "sites"), *scenes = cJSON_GetObjectItem(root, "scenes");
    assert_int_equal(cJSON_GetArraySize(sites), EXAMPLE_SITES);
    assert_int_equal(cJSON_GetArraySize(scenes), EXAMPLE_SCENES);
    for (int i = 0; i < EXAMPLE_SITES; i++)
        assert_string_equal(cJSON_GetStringValue(cJSON_GetObjectItem(cJSON_GetArrayItem(sites, i), "outcome")),
                            study_site_outcome_names[i]);
    assert_true(cJSON_IsNull(cJSON_GetObjectItem(cJSON_GetArrayItem(sites, 0), "velocity")));
    has_keys(cJSON_GetArrayItem(scenes, 2), kind_keys[STUDY_scene]);
    assert_true(number_of(cJSON_GetArrayItem(scenes, 2), "velocity") == 1500.0);
    cJSON_Delete(root);
}

/* The keys that a run prints for people and the manual's list come from the same table. */
static void manual_lists_every_key(void **state)
{
    (void)state;
    char *text = NULL;
    size_t bytes;
    FILE *out = open_memstream(&text, &bytes);
    study_print_keys(out);
    fclose(out);
    for (int kind = 0; kind < STUDIES; kind++)
        for (const char *const *key = kind_keys[kind]; *key; key++) {
            char quoted[64];
            snprintf(quoted, sizeof quoted, "`%s`", *key);
            assert_non_null(strstr(text, quoted));
        }
    free(text);
}

/* docs/reference/output.md holds what the tables print: a key added or renamed must be seen there. */
static void manual_is_up_to_date(void **state)
{
    (void)state;
    static const char page[] = BREECH_TESTS "/../docs/reference/output.md";
    char *text = NULL, *columns = NULL;
    size_t bytes;
    FILE *out = open_memstream(&text, &bytes);
    study_print_keys(out);
    fclose(out);
    out = open_memstream(&columns, &bytes);
    output_history_print_all_columns(out);
    gouge_watch_print_columns(out);
    scene_probe_print_columns(out);
    study_vessel_print_columns(out);
    fclose(out);
    manual_holds(page, "<!-- made from the tables: study_print_keys -->", "\n## history.h5\n", text);
    manual_holds(page, "<!-- made from the tables: history_print_columns, scene_probe_print_columns -->",
                 "\n## Snapshots\n", columns);
    free(columns);
    free(text);
}

static void closing_table_shows_the_result(void **state)
{
    (void)state;
    char *text = NULL;
    size_t bytes;
    example e;
    fill(&e, STUDY_onset);
    FILE *out = open_memstream(&text, &bytes);
    output_summary_print(&e.summary, out);
    fclose(out);
    assert_non_null(strstr(text, "threshold_velocity"));
    assert_non_null(strstr(text, "1480"));
    assert_non_null(strstr(text, "v1650"));
    assert_non_null(strstr(text, "not_reached"));
    free(text);
}

/* What people are shown: rounded, with a prefix, without what is not known or was not asked for; a verdict; at most
 * 100 columns. */
static void closing_tables_are_readable(void **state)
{
    (void)state;
    for (int k = 0; k < STUDIES; k++) {
        char *text = NULL, *rest = NULL;
        size_t bytes;
        example e;
        fill(&e, k);
        FILE *out = open_memstream(&text, &bytes);
        output_summary_print(&e.summary, out);
        fclose(out);
        assert_null(strstr(text, "nan"));
        assert_null(strstr(text, "charge_scale"));
        if (k == STUDY_shot) assert_non_null(strstr(text, "leaves the muzzle at "));
        if (k == STUDY_shot) assert_non_null(strstr(text, " kA "));
        if (k == STUDY_scene) assert_non_null(strstr(text, "tension was cut off, as they are"));
        if (k == STUDY_compare)
            assert_non_null(strstr(text, "\nfewest gouges: hardened; untreated cannot be told from it"));
        if (k == STUDY_compare) assert_non_null(strstr(text, "\nhardened: 0 gouges a shot"));
        for (char *line = strtok_r(text, "\n", &rest); line; line = strtok_r(NULL, "\n", &rest))
            if (strncmp(line, "result ", 7) != 0 && strlen(line) > 100 && !strchr(line, ':'))
                fail_msg("%s: %zu columns: %s", study_list[k]->name, strlen(line), line);
        free(text);
    }
}

/* A text cut inside a character, and bytes that are none, do not make the file unreadable. */
static void texts_are_valid(void **state)
{
    (void)state;
    example e;
    fill(&e, STUDY_scene);
    e.summary.error = "\xc3\xa4 \xe2\x82\xac \xf0\x9f\x98\x80 \xff \xc3| \xe2\x82";
    e.summary.warnings = "a\xc3\nb\n";
    cJSON *s = parsed(&e.summary);
    assert_string_equal(cJSON_GetStringValue(cJSON_GetObjectItem(s, "error")),
                        "\xc3\xa4 \xe2\x82\xac \xf0\x9f\x98\x80 ? ?| ??");
    assert_string_equal(cJSON_GetStringValue(cJSON_GetArrayItem(cJSON_GetObjectItem(s, "warnings"), 0)), "a?");
    cJSON_Delete(s);
    /* what only looks like UTF-8: half a pair, a letter in more bytes than it needs, one past the last */
    const char *const others[][2] = { { "\xed\xa0\x80", "???" },
                                      { "\xe0\x80\xaf", "???" },
                                      { "\xf0\x80\x80\xaf", "????" },
                                      { "\xf4\x90\x80\x80", "????" } };
    for (size_t i = 0; i < sizeof others / sizeof *others; i++) {
        e.summary.error = e.summary.case_name = others[i][0];
        s = parsed(&e.summary);
        assert_string_equal(cJSON_GetStringValue(cJSON_GetObjectItem(s, "error")), others[i][1]);
        assert_string_equal(cJSON_GetStringValue(cJSON_GetObjectItem(s, "case")), others[i][1]);
        cJSON_Delete(s);
    }
}

/* The closing table shows a description up to its semicolon: one that names some of a word's values before it names all
 * of them there, or the table would explain `bulged` by "rebound, stopped, pierced". */
static void words_are_explained_whole(const summary_key *keys)
{
    for (const summary_key *k = keys; k->name; k++) {
        int named = 0, shown = 0, all = 0;
        if (k->item) words_are_explained_whole(k->item);
        for (; k->kind == KEY_NAME && k->names[all]; all++) {
            const char *at = strstr(k->doc, k->names[all]);
            named += at != NULL, shown += at && at < k->doc + strcspn(k->doc, ";");
        }
        if (named > 0 && shown != all) fail_msg("%s: %s", k->name, k->doc);
    }
}

static void closing_tables_explain_every_word(void **state)
{
    (void)state;
    for (int kind = 0; kind < STUDIES; kind++) words_are_explained_whole(study_list[kind]->keys);
}

static void file_and_its_status(void **state)
{
    (void)state;
    char word[16];
    const char *dir = fresh_folder("summary");
    host_outdir_status(dir, word, sizeof word);
    assert_string_equal(word, "");
    for (int status_of = 0; status_of < 3; status_of++) {
        example e;
        fill(&e, STUDY_scene);
        e.summary.status = (run_status)status_of;
        OK(output_summary_write(dir, &e.summary));
        host_outdir_status(dir, word, sizeof word);
        assert_string_equal(word, output_run_status_names[status_of]);
        assert_int_equal(files_in(dir, ""), 1);
    }
    OK(host_file_write("summary/summary.json", "{ \"status\": ", 12));
    host_outdir_status(dir, word, sizeof word);
    assert_string_equal(word, "");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_key_for_every_kind),
        cmocka_unit_test(every_key_on_failure_too),
        cmocka_unit_test(numbers_come_back_exactly),
        cmocka_unit_test(what_is_not_there_is_null),
        cmocka_unit_test(texts_are_valid),
        cmocka_unit_test(onset_carries_shot_sites_and_scenes),
        cmocka_unit_test(manual_lists_every_key),
        cmocka_unit_test(manual_is_up_to_date),
        cmocka_unit_test(closing_table_shows_the_result),
        cmocka_unit_test(closing_tables_are_readable),
        cmocka_unit_test(closing_tables_explain_every_word),
        cmocka_unit_test(file_and_its_status),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
