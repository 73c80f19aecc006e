/* report.html: made from the files of the directory alone, whole whatever is missing, with no link to the network. */
#include "output_common.h"

#include "coupling/io/history.h"
#include "coupling/io/outdir.h"
#include "coupling/io/report.h"

enum { SAMPLES = 4000, MAP_X = 120, MAP_Z = 40 };

static void write_shot(history *h)
{
    int series;
    double row[HISTORY_MAX_COLUMNS];
    OK(history_shot(h, &series));
    for (int i = 0; i < SAMPLES; i++) {
        shot_state s;
        memset(&s, 0, sizeof s);
        s.t = 5e-3 * i / SAMPLES;
        s.current = 1.2e6 * sin(600.0 * s.t) * exp(-200.0 * s.t);
        s.v = 2100.0 * (1.0 - exp(-s.t / 1.5e-3));
        s.x = 2100.0 * (s.t - 1.5e-3 * (1.0 - exp(-s.t / 1.5e-3)));
        s.force = 0.25e-6 * s.current * s.current;
        s.ledger.kinetic = 0.1 * s.v * s.v;
        history_shot_row(&s, row);
        OK(history_append(h, series, row));
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
    OK(history_crater(h, scene, &c));
}

static void write_run(const char *dir, run_kind kind)
{
    fresh_folder(dir);
    char path[200];
    static example_study study;
    static shot_record fired;
    static scene_result scene;
    example_onset(&study);
    fired = example_shot();
    scene = example_scene(0.4);
    static const double frequency[] = { 10.0, 1e3, 1e5 }, gradient[] = { 0.6e-6, 0.55e-6, 0.5e-6 };
    static const compare_entry entries[] = { { .surface = "hardened",
                                               .threshold_velocity = 1700.0,
                                               .threshold_interval = { 1650.0, 1750.0 },
                                               .onset_position = NAN,
                                               .gouged_volume = 0.0 } };
    static const compare_result compare = { .n = 1, .ranking = entries };
    static const inductance_result inductance = { .n = 3,
                                                  .frequency = frequency,
                                                  .L_gradient = gradient,
                                                  .R_gradient = gradient,
                                                  .L_gradient_high_frequency = 0.49e-6,
                                                  .n_perimeter = 3,
                                                  .perimeter = frequency,
                                                  .perimeter_current = gradient,
                                                  .perimeter_heat = gradient };
    const run_summary s = { .kind = kind,
                            .case_name = "case <1> & \"two\"",
                            .instruction_set = "x86-64-v3",
                            .warnings = "copper <weak>\nclamped 3 times",
                            .shot = &fired,
                            .scene = &scene,
                            .onset = &study.result,
                            .compare = &compare,
                            .inductance = &inductance };
    OK(summary_write(dir, &s));
    snprintf(path, sizeof path, "%s/used.yaml", dir);
    OK(file_write(path, "name: a <b>\n", 12));
    if (kind == RUN_INDUCTANCE) return;
    history *h;
    snprintf(path, sizeof path, "%s/history.h5", dir);
    OK(history_open(path, false, &h));
    if (kind != RUN_SCENE) write_shot(h);
    if (kind == RUN_ONSET)
        for (int i = 0; i < EXAMPLE_SCENES; i++) write_crater(h, study.scene[i].name, 0.2 * i);
    if (kind == RUN_SCENE) write_crater(h, "scene", 0.5);
    OK(history_close(h));
}

static char *page_of(const char *dir)
{
    char path[200], *text;
    OK(report_write(dir));
    snprintf(path, sizeof path, "%s/report.html", dir);
    OK(file_read(path, &text, NULL));
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
    for (int kind = 0; kind < RUN_KINDS; kind++) {
        write_run("report", (run_kind)kind);
        char *text = page_of("report");
        is_self_contained(text);
        assert_non_null(strstr(text, "case &lt;1&gt; &amp; &quot;two&quot;"));
        assert_non_null(strstr(text, "copper &lt;weak&gt;"));
        assert_non_null(strstr(text, "name: a &lt;b&gt;"));
        assert_non_null(strstr(text, breech_version()));
        free(text);
    }
}

static void onset_page_shows_everything(void **state)
{
    (void)state;
    write_run("report", RUN_ONSET);
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

/* Written again it is the same page: nothing but the directory's files goes into it. */
static void same_files_same_page(void **state)
{
    (void)state;
    write_run("report", RUN_ONSET);
    char *first = page_of("report"), *second = page_of("report");
    assert_string_equal(first, second);
    free(first);
    free(second);
}

static void without_gnuplot_it_says_so(void **state)
{
    (void)state;
    write_run("report", RUN_ONSET);
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
    OK(summary_write("report",
                     &(run_summary){ .kind = RUN_ONSET, .case_name = "x", .status = RUN_FAILED, .error = "it broke" }));
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
    const status s = report_write("report");
    assert_int_equal(s.code, STATUS_BAD_INPUT);
    assert_non_null(strstr(s.text, "summary.json"));
    OK(file_write("report/summary.json", "{ \"kind\": [", 11));
    assert_int_equal(report_write("report").code, STATUS_BAD_INPUT);
    OK(file_write("report/summary.json", "{}", 2));
    OK(file_write("report/history.h5", "damaged", 7));
    assert_int_equal(report_write("report").code, STATUS_IO);
    assert_false(file_exists("report/report.html"));
    assert_int_equal(report_write("report/nowhere").code, STATUS_BAD_INPUT);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(page_for_every_kind),       cmocka_unit_test(onset_page_shows_everything),
        cmocka_unit_test(same_files_same_page),      cmocka_unit_test(without_gnuplot_it_says_so),
        cmocka_unit_test(failed_run_has_a_page_too), cmocka_unit_test(what_is_no_run_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
