/* SPDX-License-Identifier: BSD-3-Clause */
/* report.html: made from the files of the directory alone, whole whatever is missing, with no link to the network. */
#include "coupling/gouge/crater_history.h"
#include "coupling/host/version.h"
#include "output_common.h"

#include "coupling/host/outdir.h"
#include "coupling/output/history.h"
#include "coupling/report/report.h"

#include <cJSON.h>

enum { SAMPLES = 4000, MAP_X = 120, MAP_Z = 40 };

static void write_shot(history *h)
{
    int series;
    double row[HISTORY_MAX_COLUMNS];
    OK(output_history_shot(h, &series));
    for (int i = 0; i < SAMPLES; i++) {
        shot_state s;
        memset(&s, 0, sizeof s);
        s.t = 5e-3 * i / SAMPLES;
        s.current = 1.2e6 * sin(600.0 * s.t) * exp(-200.0 * s.t);
        s.v = 2100.0 * (1.0 - exp(-s.t / 1.5e-3));
        s.x = 2100.0 * (s.t - 1.5e-3 * (1.0 - exp(-s.t / 1.5e-3)));
        s.force = 0.25e-6 * s.current * s.current;
        s.ledger.kinetic = 0.1 * s.v * s.v;
        output_history_shot_row(&s, row);
        OK(output_history_append(h, series, row));
    }
}

/* A tear-drop with a rim. */
static void write_crater(history *h, const char *scene, double growth)
{
    static double map[MAP_X * MAP_Z];
    for (int i = 0; i < MAP_X; i++)
        for (int k = 0; k < MAP_Z; k++) {
            const double along = (double)i / MAP_X, z = (k - 0.5 * (MAP_Z - 1)) / (0.5 * MAP_Z);
            const double half = 0.25 + growth * along,
                         inside = along > 0.15 && along < 0.8 ? 1.0 - z * z / (half * half) : -1.0;
            map[i * MAP_Z + k] = inside > 0.0 ? 0.4e-3 * inside : -0.2e-3 * exp(6.0 * inside);
        }
    const crater c = { .class = DAMAGE_GOUGE,
                       .reason = "widening <1.5> & so on",
                       .nx = MAP_X,
                       .nz = MAP_Z,
                       .x0 = -1e-3,
                       .dx = 0.1e-3,
                       .z0 = -1.95e-3,
                       .dz = 0.1e-3,
                       .depth_map = map };
    OK(gouge_crater_record(&c, h, scene));
}

static void write_run(const char *dir, int kind)
{
    static example_results e;
    char path[200];
    fresh_folder(dir);
    example_fill(&e);
    run_summary s = study_summary(study_list[kind], &e.answer[kind]);
    s.case_name = "case <1> & \"two\"";
    s.instruction_set = "x86-64-v3";
    s.warnings = "copper <weak>\nclamped 3 times";
    OK(output_summary_write(dir, &s));
    snprintf(path, sizeof path, "%s/used.yaml", dir);
    OK(host_file_write(path, "name: a <b>\n", 12));
    if (kind == STUDY_inductance) return;
    history *h;
    snprintf(path, sizeof path, "%s/history.h5", dir);
    OK(output_history_open(path, false, &h));
    if (kind != STUDY_scene) write_shot(h);
    if (kind == STUDY_onset)
        for (int i = 0; i < EXAMPLE_SCENES; i++) write_crater(h, e.study.scene[i].name, 0.2 * i);
    if (kind == STUDY_scene) write_crater(h, "scene", 0.5);
    OK(output_history_close(h));
}

static char *page_of(const char *dir)
{
    char path[200], *text;
    OK(report_write(dir, study_report_part));
    snprintf(path, sizeof path, "%s/report.html", dir);
    OK(host_file_read(path, &text, NULL));
    assert_int_equal(files_in(dir, ".part"), 0);
    return text;
}

static int count(const char *text, const char *what)
{
    int n = 0;
    for (; (text = strstr(text, what)); text++) n++;
    return n;
}

static bool has_gnuplot(void)
{
    return system("gnuplot --version > /dev/null 2>&1") == 0;
}

/* No script, no address but the name spaces that SVG is written in, every text escaped. */
static void is_self_contained(const char *text)
{
    const int names = count(text, "\"http://www.w3.org/2000/svg\"") + count(text, "\"http://www.w3.org/1999/xlink\"");
    assert_int_equal(count(text, "http:"), names);
    assert_int_equal(count(text, "https:"), 0);
    assert_int_equal(count(text, "<script"), 0);
    assert_int_equal(count(text, "src="), 0);
    assert_int_equal(count(text, "<b>\n"), 0);
    assert_int_equal(count(text, "</html>"), 1);
}

static void page_for_every_kind(void **state)
{
    (void)state;
    for (int kind = 0; kind < STUDIES; kind++) {
        write_run("report", kind);
        char *text = page_of("report");
        is_self_contained(text);
        assert_non_null(strstr(text, "case &lt;1&gt; &amp; &quot;two&quot;"));
        assert_non_null(strstr(text, "copper &lt;weak&gt;"));
        assert_non_null(strstr(text, "name: a &lt;b&gt;"));
        assert_non_null(strstr(text, host_version()));
        free(text);
    }
}

static void onset_page_shows_everything(void **state)
{
    (void)state;
    write_run("report", STUDY_onset);
    char *text = page_of("report");
    assert_non_null(strstr(text, "Gouging begins 2.5"));
    assert_non_null(strstr(text, "v1650"));
    assert_non_null(strstr(text, "energy_kinetic"));
    const int maps = EXAMPLE_SCENES, curves = has_gnuplot() ? 1 + 2 + EXAMPLE_SCENES : 0;
    assert_int_equal(count(text, "<svg"), maps + curves);
    assert_int_equal(files_in("report", ".svg"), maps + curves);
    assert_int_equal(count(text, "class=\"missing\""), has_gnuplot() ? 0 : 1);
    free(text);
}

/* ---- what a population's study and a comparison add, put into the summary as they write it ---- */

static void add_to_summary(const char *dir, const char *const (*more)[2], int n)
{
    char path[200], *text;
    snprintf(path, sizeof path, "%s/summary.json", dir);
    OK(host_file_read(path, &text, NULL));
    cJSON *root = cJSON_Parse(text);
    free(text);
    for (int i = 0; i < n; i++) {
        cJSON_DeleteItemFromObjectCaseSensitive(root, more[i][0]);
        cJSON *value = cJSON_Parse(more[i][1]);
        assert_non_null(value);
        cJSON_AddItemToObject(root, more[i][0], value);
    }
    text = cJSON_Print(root);
    OK(host_file_write(path, text, strlen(text)));
    free(text);
    cJSON_Delete(root);
}

static void write_study(const char *dir)
{
    static const char *const more[][2] = {
        { "surface", "[{\"family\":1,\"shape\":\"hemisphere\",\"material\":\"sand <x>\",\"radius\":1e-4,\"grains\":2.5,"
                     "\"threshold_velocity\":1900,\"threshold_interval\":[1850,null],\"scenes\":1},"
                     "{\"family\":1,\"shape\":\"hemisphere\",\"material\":\"sand\",\"radius\":2e-4,\"grains\":1,"
                     "\"threshold_velocity\":1700,\"threshold_interval\":[1650,1750],\"scenes\":2},"
                     "{\"family\":1,\"shape\":\"hemisphere\",\"material\":\"sand\",\"radius\":4e-4,\"grains\":1,"
                     "\"threshold_velocity\":null,\"threshold_interval\":null,\"scenes\":0}]" },
        { "skips", "[{\"rests_on\":\"the screen\",\"scenes\":4}]" },
        { "sensitivities", "[{\"input\":\"charge\",\"change\":0.05,\"muzzle_velocity\":2200,\"threshold_position\":1.2,"
                           "\"expected_gouges\":3.5}]" },
        { "shots", "[{\"shot\":1,\"probability_gouge\":0.5,\"expected_gouges\":1,\"expected_gouged_volume\":1e-9,"
                   "\"onset_position\":2.0,\"onset_interval\":[1.5,2.5]}]" },
    };
    write_run(dir, STUDY_onset);
    add_to_summary(dir, more, sizeof more / sizeof *more);
}

static void write_comparison(const char *dir)
{
    static const char *const more[][2] = {
        { "ranking",
          "[{\"surface\":\"hard \\\"skin\\\"\",\"gouges\":1.5,\"gouges_interval\":[1,2.25],\"better_than_next\":0.97,"
          "\"significant\":true,\"tied\":1,\"threshold_velocity\":1800,\"threshold_interval\":[1750,1850],"
          "\"onset_position\":2.2,\"gouged_volume\":1e-9,\"layer\":\"none\",\"scenes\":3},"
          "{\"surface\":\"<as delivered>\",\"gouges\":4,\"gouges_interval\":[3,5],\"better_than_next\":null,"
          "\"significant\":false,\"tied\":2,\"threshold_velocity\":1500,\"threshold_interval\":[1450,1550],"
          "\"onset_position\":1.2,\"gouged_volume\":2e-9,\"layer\":\"none\",\"scenes\":5}]" },
    };
    write_run(dir, STUDY_compare);
    add_to_summary(dir, more, 1);
}

static const char *const study_sections[] = { "Along the barrel",
                                              "The threshold",
                                              "Scenes that were not needed",
                                              "What moves the answer",
                                              "Shot after shot on the same rail",
                                              "Craters",
                                              "The shot",
                                              "Where the energy went",
                                              "Warnings",
                                              "Inputs",
                                              "Versions",
                                              NULL };
static const char *const comparison_sections[] = {
    "Surfaces, best first", "The shot", "Warnings", "Inputs", "Versions", NULL
};

static void has_sections(const char *text, const char *const *titles)
{
    for (int i = 0; titles[i]; i++) {
        char heading[100];
        snprintf(heading, sizeof heading, "<h2>%s</h2>", titles[i]);
        if (count(text, heading) != 1) fail_msg("the page has %d sections `%s`", count(text, heading), titles[i]);
    }
}

static void study_pages_have_their_sections(void **state)
{
    (void)state;
    write_study("report");
    char *text = page_of("report");
    is_self_contained(text);
    has_sections(text, study_sections);
    assert_non_null(strstr(text, "sand &lt;x&gt;"));
    assert_non_null(strstr(text, "1650 to 1750"));
    assert_int_equal(host_file_exists("report/plot-surface.svg"), has_gnuplot());
    free(text);
    write_comparison("report");
    text = page_of("report");
    is_self_contained(text);
    has_sections(text, comparison_sections);
    assert_non_null(strstr(text, "1 to 2.25"));
    assert_int_equal(host_file_exists("report/plot-ranking.svg"), has_gnuplot());
    assert_int_equal(count(text, "class=\"missing\""), has_gnuplot() ? 0 : 1);
    free(text);
}

/* ---- a real browser ---- */

#define BROWSER                                                                      \
    "chromium --headless --no-sandbox --disable-gpu --allow-file-access-from-files " \
    "--user-data-dir=\"$PWD/browser\" --virtual-time-budget=4000 --enable-logging=stderr --v=0 "

/* A frame of a phone's width around the page; its title says how wide the page wants to be. */
static void write_frame(const char *path, int width)
{
    char text[600];
    const int n = snprintf(text, sizeof text,
                           "<iframe id=\"f\" src=\"report/report.html\" width=\"%d\" height=\"800\" "
                           "style=\"border:0\"></iframe><script>onload=function(){var d=document.getElementById('f')"
                           ".contentDocument;document.title='wide '+d.documentElement.scrollWidth+' of "
                           "'+d.documentElement.clientWidth+', plots '"
                           "+d.querySelectorAll('svg').length}</script>",
                           width);
    OK(host_file_write(path, text, (size_t)n));
}

static char *browser_says(const char *arguments)
{
    char command[600], *text;
    snprintf(command, sizeof command, "rm -rf browser; timeout 120 " BROWSER "%s >dom.html 2>console.txt", arguments);
    assert_int_equal(system(command), 0);
    OK(host_file_read("console.txt", &text, NULL));
    if (strstr(text, "CONSOLE")) fail_msg("the console: %s", strstr(text, "CONSOLE"));
    free(text);
    OK(host_file_read("dom.html", &text, NULL));
    return text;
}

static void browser_shows(const char *const *sections)
{
    char *text = browser_says("--dump-dom \"file://$PWD/report/report.html\"");
    int wide = 0, room = -1, plots = -1;
    has_sections(text, sections);
    const int drawn = count(text, "<svg");
    free(text);
    write_frame("phone.html", 360);
    text = browser_says("--dump-dom \"file://$PWD/phone.html\"");
    const char *title = strstr(text, "wide ");
    if (!title || sscanf(title, "wide %d of %d, plots %d", &wide, &room, &plots) != 3)
        fail_msg("no answer: %.300s", text);
    free(text);
    assert_true(room > 300 && wide <= room); /* nothing sticks out; wide tables scroll by themselves */
    assert_int_equal(plots, drawn);
    free(browser_says("--print-to-pdf=report.pdf \"file://$PWD/report/report.html\""));
    assert_true(host_file_exists("report.pdf"));
}

static void a_browser_reads_it(void **state)
{
    (void)state;
    if (!full_tests()) skip();
    if (system("command -v chromium > /dev/null") != 0) {
        print_message("chromium is not installed\n");
        skip();
    }
    write_study("report");
    free(page_of("report"));
    browser_shows(study_sections);
    write_comparison("report");
    free(page_of("report"));
    browser_shows(comparison_sections);
}

/* Written again it is the same page: nothing but the directory's files goes into it. */
static void same_files_same_page(void **state)
{
    (void)state;
    write_run("report", STUDY_onset);
    char *first = page_of("report"), *second = page_of("report");
    assert_string_equal(first, second);
    free(first);
    free(second);
}

static void without_gnuplot_it_says_so(void **state)
{
    (void)state;
    write_run("report", STUDY_onset);
    char *kept = strdup(getenv("PATH"));
    setenv("PATH", "/nowhere", 1);
    char *text = page_of("report");
    setenv("PATH", kept, 1);
    free(kept);
    assert_non_null(strstr(text, "gnuplot is not installed"));
    assert_int_equal(count(text, "<svg"), EXAMPLE_SCENES); /* the maps need none */
    free(text);
}

static void failed_run_has_a_page_too(void **state)
{
    (void)state;
    fresh_folder("report");
    run_summary failed = study_summary(&study_onset, &(study_answer){ .result = NULL });
    failed.case_name = "x";
    failed.status = RUN_FAILED;
    failed.error = "it broke";
    OK(output_summary_write("report", &failed));
    char *text = page_of("report");
    assert_non_null(strstr(text, "it broke"));
    assert_non_null(strstr(text, "history.h5 is not there"));
    assert_null(strstr(text, "Gouging begins"));
    free(text);
}

static void what_is_no_run_is_refused(void **state)
{
    (void)state;
    fresh_folder("report");
    const status s = report_write("report", study_report_part);
    assert_int_equal(s.code, STATUS_BAD_INPUT);
    assert_non_null(strstr(s.text, "summary.json"));
    OK(host_file_write("report/summary.json", "{ \"kind\": [", 11));
    assert_int_equal(report_write("report", study_report_part).code, STATUS_BAD_INPUT);
    OK(host_file_write("report/summary.json", "{}", 2));
    OK(host_file_write("report/history.h5", "damaged", 7));
    assert_int_equal(report_write("report", study_report_part).code, STATUS_IO);
    assert_false(host_file_exists("report/report.html"));
    assert_int_equal(report_write("report/nowhere", study_report_part).code, STATUS_BAD_INPUT);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(page_for_every_kind),       cmocka_unit_test(onset_page_shows_everything),
        cmocka_unit_test(same_files_same_page),      cmocka_unit_test(study_pages_have_their_sections),
        cmocka_unit_test(a_browser_reads_it),        cmocka_unit_test(without_gnuplot_it_says_so),
        cmocka_unit_test(failed_run_has_a_page_too), cmocka_unit_test(what_is_no_run_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
