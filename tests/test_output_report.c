/* SPDX-License-Identifier: BSD-3-Clause */
/* report.html: made from the files of the directory alone, whole whatever is missing, with no link to the network. */
#include "coupling/gouge/crater_history.h"
#include "coupling/host/version.h"
#include "output_common.h"
#include "text_common.h"

#include "coupling/host/outdir.h"
#include "coupling/output/history.h"
#include "coupling/output/snapshot.h"
#include "coupling/report/report.h"

#include <cJSON.h>

enum { SAMPLES = 4000, MAP_X = 120, MAP_Z = 40 };

static void write_shot(history *h)
{
    int series;
    double row[HISTORY_MAX_COLUMNS];
    OK(output_history_shot(h, &series));
    for (int i = 0; i < SAMPLES; i++) {
        circuit_shot_state s;
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
    const scene_result r = { .class = DAMAGE_GOUGE,
                             .reason = "widening <1.5> & so on",
                             .crater_class = DAMAGE_SCRATCH,
                             .crater_reason = "severity -2" };
    const crater c = { .nx = MAP_X,
                       .nz = MAP_Z,
                       .x0 = -1e-3,
                       .dx = 0.1e-3,
                       .z0 = -1.95e-3,
                       .dz = 0.1e-3,
                       .rim_height = 0.15e-3,
                       .depth_map = map };
    OK(gouge_crater_record(&c, &r, h, scene));
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
    OK(report_write(dir, study_report_kind));
    snprintf(path, sizeof path, "%s/report.html", dir);
    OK(host_file_read(path, &text, NULL));
    assert_int_equal(files_in(dir, ".part"), 0);
    return text;
}

/* ---- what every page keeps to ---- */

/* Every element that opens is closed, in order. */
static void is_well_formed(const char *text)
{
    enum { DEEP = 40, NAME = 24 };
    char open[DEEP][NAME];
    int n = 0;
    for (const char *at = text; (at = strchr(at, '<')); at++) {
        char name[NAME] = "";
        const char *end = strchr(at, '>');
        assert_non_null(end);
        const bool closes = at[1] == '/';
        if (at[1] == '!' || sscanf(at + 1 + closes, "%23[a-zA-Z0-9]", name) != 1) continue;
        if (strcmp(name, "meta") == 0 || end[-1] == '/') continue;
        if (closes) {
            if (n == 0 || strcmp(open[n - 1], name) != 0)
                fail_msg("</%s> closes <%s>: %.200s", name, n ? open[n - 1] : "", at);
            n--;
        } else {
            assert_true(n < DEEP);
            strcpy(open[n++], name);
        }
    }
    assert_int_equal(n, 0);
}

/* Digits of the number at `at` that count: from the first that is not 0 on. */
static int digits_of(const char *at, const char **end)
{
    int n = 0, zeros = 0;
    bool point = false;
    for (; (*at >= '0' && *at <= '9') || (*at == '.' && !point); at++) {
        if (*at == '.') {
            point = true;
        } else if (*at == '0' && !point) {
            zeros += n > 0; /* at the end of a whole number they do not count */
        } else if (n > 0 || *at != '0') {
            n += 1 + zeros;
            zeros = 0;
        }
    }
    *end = at;
    return n;
}

/* No number in a table, a card or a sentence has more than five digits; those of energies that are to be added up have
 * five, all others three or what their interval says. */
static void shows_no_more_digits_than_known(const char *text)
{
    bool drawing = false, listing = false;
    for (const char *at = text; *at; at++) {
        if (*at == '<') {
            if (strncmp(at, "<svg", 4) == 0 || strncmp(at, "<pre", 4) == 0 || strncmp(at, "<style", 6) == 0)
                drawing = true;
            if (strncmp(at, "</svg", 5) == 0 || strncmp(at, "</pre", 5) == 0 || strncmp(at, "</style", 7) == 0)
                drawing = false;
            if (strncmp(at, "<h2>Versions", 12) == 0) listing = true;
            at = strchr(at, '>');
            continue;
        }
        if (drawing || listing || *at < '0' || *at > '9') continue;
        const char *end;
        const int digits = digits_of(at, &end);
        if (digits > 5) fail_msg("%d digits: %.60s", digits, at);
        at = end - 1;
    }
}

/* Every row of a table has all the titles, and a screen that is too narrow shows them with the numbers. */
static void tables_are_whole(const char *text)
{
    for (const char *at = text; (at = strstr(at, "<table")); at++) {
        const char *head = strstr(at, "</thead>"), *end = strstr(at, "</table>");
        int titles = 0;
        for (const char *th = at; (th = strstr(th + 1, "<th")) && th < head;) titles += strncmp(th, "<thead", 6) != 0;
        for (const char *row = head; (row = strstr(row, "<tr>")) && row < end; row++) {
            int cells = 0;
            const char *last = strstr(row, "</tr>");
            for (const char *td = row; (td = strstr(td + 1, "<td")) && td < last;) cells++;
            if (cells != titles) fail_msg("%d cells, %d titles: %.200s", cells, titles, row);
        }
    }
    assert_int_equal(text_count(text, "<td"),
                     text_count(text, "<td data-title=") + text_count(text, "<td class=\"text\" data-title="));
    assert_int_equal(text_count(text, "overflow-x"), 0); /* nothing has to be scrolled sideways */
    assert_non_null(strstr(text, "content:attr(data-title)"));
    assert_non_null(strstr(text, "@media print"));
}

/* No script, no address but the name spaces that SVG is written in, every text escaped. */
static void is_self_contained(const char *text)
{
    const int names =
        text_count(text, "\"http://www.w3.org/2000/svg\"") + text_count(text, "\"http://www.w3.org/1999/xlink\"");
    assert_int_equal(text_count(text, "http:"), names);
    assert_int_equal(text_count(text, "https:"), 0);
    assert_int_equal(text_count(text, "<script"), 0);
    assert_int_equal(text_count(text, "src="), 0);
    assert_int_equal(text_count(text, "<b>\n"), 0);
    assert_int_equal(text_count(text, "</html>"), 1);
    is_well_formed(text);
    shows_no_more_digits_than_known(text);
    tables_are_whole(text);
}

/* What the page of each kind says first, in study.def's order. */
static const char *first_words(int kind)
{
    static const struct {
        const char *kind, *says;
    } all[] = { { "shot", "The armature leaves the muzzle with" },
                { "scene", "Damage class: <b>" },
                { "onset", "This rail gouges: from 1480 (1450 to 1510)&nbsp;m/s" },
                { "compare", "Fewest gouges: hardened; untreated cannot be told from it" },
                { "inductance", "A metre of these rails has" },
                { "strike", "The target is pierced: the projectile goes on with 1500&nbsp;m/s, of 1930&nbsp;m/s" },
                { "life", "A crack is there after 18000 loads" },
                { "vessel", "The film bursts after" },
                { "sweep", "2 runs of <code>breech scene</code>" } };
    for (size_t k = 0; k < sizeof all / sizeof *all; k++)
        if (strcmp(all[k].kind, study_list[kind]->name) == 0) return all[k].says;
    fail_msg("study `%s`: tests/test_output_report.c wants to know what its page says first (study.report)",
             study_list[kind]->name);
    return NULL;
}

static void page_for_every_kind(void **state)
{
    (void)state;
    for (int kind = 0; kind < STUDIES; kind++) {
        write_run("report", kind);
        char *text = page_of("report");
        is_self_contained(text);
        const char *head = strstr(text, "class=\"verdict\""), *says = head ? strstr(head, first_words(kind)) : NULL;
        if (!says || says > strstr(head, "</p>"))
            fail_msg("%s: %.300s", study_list[kind]->name, head ? head : "its page has no head (report of the study)");
        assert_non_null(strstr(text, "case &lt;1&gt; &amp; &quot;two&quot;"));
        assert_non_null(strstr(text, "copper &lt;weak&gt;"));
        assert_non_null(strstr(text, "name: a &lt;b&gt;"));
        assert_non_null(strstr(text, host_version()));
        free(text);
    }
}

/* The last number on the time axis of a chart of the shot [ms]. */
static double last_tick(const char *svg)
{
    double last = NAN;
    const char *end = strstr(svg, ">time [");
    for (const char *at = svg; (at = strstr(at, "text-anchor=\"middle\">")) && strchr(at, '>') < end; at++)
        last = atof(strchr(at, '>') + 1);
    return last;
}

static void onset_page_shows_everything(void **state)
{
    (void)state;
    write_run("report", STUDY_onset);
    char *text = page_of("report"), *svg;
    assert_non_null(strstr(text, "How sure is that?"));
    assert_non_null(strstr(text, "What can be done about it?"));
    assert_non_null(strstr(text, "A place's interval ends where the armature passes the ends of the speed's"));
    assert_non_null(strstr(text, "v1650"));
    assert_non_null(strstr(text, "By its shape alone: scratch; severity -2.")); /* where growth says gouge */
    assert_non_null(strstr(text, "energy_kinetic"));
    assert_int_equal(text_count(text, "<svg"), files_in("report", ".svg"));
    /* a map, a view aside and a profile a crater; the barrel as a strip and a curve; the threshold; the shot: current,
     * velocity, position, force, energy, where the example has values */
    assert_int_equal(text_count(text, "<svg"), 3 * EXAMPLE_SCENES + 3 + 5);
    assert_int_equal(text_count(text, "class=\"missing\""), 0);
    /* the history goes on for 5 ms, the armature leaves after 4.1 ms */
    OK(host_file_read("report/plot-shot-current.svg", &svg, NULL));
    assert_true(last_tick(svg) > 3.0 && last_tick(svg) < 4.5);
    free(svg);
    free(text);
}

/* The map's colours reach as high as the map; where that is not the rim of the summary, the page says why. */
static void a_rim_that_is_not_the_highest_is_explained(void **state)
{
    (void)state;
    write_run("report", STUDY_scene);
    char *text = page_of("report");
    assert_int_equal(text_count(text, " mm high. The rim (rim_height, 0.15 mm) is the highest within"), 1);
    free(text);
}

/* ---- what a study adds to the summary, as the study writes it ---- */

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

/* What a designer is told to keep below is the interval's end, by this case's grains and cells; below three cells a
 * radius in the search nothing of it is said, however fine the cells of whole craters are. */
static void advice_is_no_surer_than_the_interval(void **state)
{
    (void)state;
    static const struct {
        const char *cells, *gauged, *of_craters;
        bool advises;
    } of[] = { { "2.9", "false", "2.9", false },
               { "3", "false", "3", true },
               { "2.9", "true", "6", false },
               { "3", "true", "6", true } };
    for (size_t i = 0; i < sizeof of / sizeof *of; i++) {
        const int k = of[i].advises;
        char scenes[200];
        snprintf(scenes, sizeof scenes,
                 "[{\"name\":\"v1\",\"cells_per_radius\":%s,\"gauged\":%s},"
                 "{\"name\":\"v2\",\"cells_per_radius\":%s,\"gauged\":false}]",
                 of[i].cells, of[i].gauged, of[i].of_craters);
        const char *const more[][2] = { { "scenes", scenes },
                                        { "threshold_interval", "[1450,1510]" },
                                        { "threshold_position_interval", "[1.9,2.1]" } };
        write_run("advice", STUDY_onset);
        add_to_summary("advice", more, 3);
        char *text = page_of("advice");
        assert_int_equal(text_count(text, "By the grains and the cells of this case"), 2 * k);
        assert_int_equal(text_count(text, "m/s, the lower end of the interval, is not expected to gouge"), k);
        assert_int_equal(text_count(text, "the early end of the interval"), k);
        assert_int_equal(text_count(text, "does not gouge on such grains"), 0);
        free(text);
    }
}

/* ---- a scene of bodies, cut ---- */

enum { PLATE_X = 6, ACROSS = 20, PLATE = PLATE_X * ACROSS * 4, BALL = 4 * 4 * 4 };

/* Points of 1 mm: a plate of 6 x 20 x 4 and a cube of 4 that flies along x, 4 mm before it; later it has gone through
 * and the plate has failed behind it.  The cut in z = 2 mm lies between points. */
static void read_field(bool later, mpm_field field, float *out)
{
    memset(out, 0, (PLATE + BALL) * (size_t)mpm_field_table[field].width * sizeof *out);
    for (int i = 0; i < PLATE + BALL; i++) {
        const bool ball = i >= PLATE;
        const int k = ball ? i - PLATE : i, n = ball ? 4 : ACROSS;
        const double x[3] = { k / (4 * n) + (ball ? (later ? 10.5 : -7.5) : 0.5), k / 4 % n + (ball ? 8.5 : 0.5),
                              k % 4 + 0.5 };
        for (int q = 0; field == MPM_position && q < 3; q++) out[3 * i + q] = (float)(1e-3 * x[q]);
        for (int q = 0; field == MPM_size && q < 3; q++) out[3 * i + q] = (float)0.5e-3;
        if (field == MPM_velocity && ball) out[3 * i] = 1000.0F;
        if (field == MPM_body) out[i] = ball;
        if (field == MPM_damage) out[i] = later && !ball && x[1] > 8.0 && x[1] < 12.0;
    }
}

static void read_bodies(const void *source, float *const out[MPM_FIELD_COUNT])
{
    for (int f = 0; f < MPM_FIELD_COUNT; f++) read_field(*(const bool *)source, (mpm_field)f, out[f]);
}

/* Strips of one body in a picture: their area, in the square of its width. */
static double strips_area(const char *svg, const char *start)
{
    const char *path = strstr(svg, start), *end = path ? strstr(path, "/>") : NULL;
    double area = 0.0, wide, high;
    for (; path && (path = strchr(path, 'h')) && path < end; path++)
        if (sscanf(path, "h%lfv-%lfh", &wide, &high) == 2)
            area += wide * (high - 0.4); /* each reaches 0.4 into the next */
    return area / (424.0 * 424.0);
}

static void bodies_are_cut_before_and_after(void **state)
{
    (void)state;
    snapshots *s;
    char *text, *svg;
    write_run("report", STUDY_strike);
    OK(host_folder_make("report/scenes/scene"));
    OK(output_snapshots_open("report/scenes/scene", -1.0, &s));
    for (int later = 0; later < 2; later++) {
        const bool then = later;
        OK(output_snapshots_write_source(s, &(snapshot_source){ 1e-5 * later, PLATE + BALL, read_bodies, &then }));
    }
    output_snapshots_close(s);
    static const char *const bodies[][2] = {
        { "bodies", "{\"plate\":{\"mass\":1,\"velocity\":[0,0,0]},\"ball\":{\"mass\":1,\"velocity\":[9,0,0]}}" }
    };
    for (int k = 0; k < 2; k++) { /* with the section of bodies too, which of a scene has the cut */
        text = page_of("report");
        assert_int_equal(text_count(text, ">Cut through the middle</h2>"), 1);
        assert_int_equal(text_count(text, ">Bodies at the end</h2>"), k);
        free(text);
        add_to_summary("report", bodies, 1);
    }
    /* 22 mm wide, from the cube before to the cube after.  At its edges alone a body is filled beyond its points, by a
     * fifth of half a domain, 0.1 mm, and by up to a square of the raster, 0.1 mm. */
    OK(host_file_read("report/plot-before.svg", &svg, NULL));
    const double all = 22.0 * 22.0, plate = strips_area(svg, "fill=\"#1f5fa8\" d"),
                 cube = strips_area(svg, "fill=\"#c0392b\" d");
    assert_true(fabs(plate * all / (6.0 * 20.0) - 1.0) < 0.08 && fabs(cube * all / 16.0 - 1.0) < 0.15);
    free(svg);
    OK(host_file_read("report/plot-after.svg", &svg, NULL));
    const double failed = strips_area(svg, "fill=\"#1f5fa8\" fill-opacity");
    assert_true(fabs(failed * all / (6.0 * 4.0) - 1.0) < 0.15);
    free(svg);
}

/* ---- a population's study and a comparison ---- */

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
                           "\"expected_gouges\":3.5},{\"input\":\"mass\",\"change\":0.05,\"threshold_position\":null,"
                           "\"expected_gouges\":null}]" },
        { "shots", "[{\"shot\":1,\"probability_gouge\":0.5,\"expected_gouges\":1,\"expected_gouged_volume\":1e-9,"
                   "\"layer_worn\":6.56e-6,\"deposit\":1.28e-5,\"onset_position\":2.0,\"onset_interval\":[1.5,2.5]}]" },
    };
    write_run(dir, STUDY_onset);
    add_to_summary(dir, more, sizeof more / sizeof *more);
}

static void write_comparison(const char *dir)
{
    static const char *const more[][2] = {
        { "verdict", "\"best is hard \\\"skin\\\"\"" },
        { "ranking",
          "[{\"surface\":\"hard "
          "\\\"skin\\\"\",\"scene_prefix\":\"t1-\",\"gouges\":1.5,\"gouges_interval\":[1,2.25],\"better_than_next\":0."
          "97,"
          "\"significant\":true,\"tied\":1,\"threshold_velocity\":1800,\"threshold_interval\":[1750,1850],"
          "\"layer_worn\":4.59e-5,\"deposit\":8.94e-5,"
          "\"onset_position\":2.2,\"gouged_volume\":1e-9,\"layer\":\"none\",\"scenes\":3},"
          "{\"surface\":\"<as "
          "delivered>\",\"scene_prefix\":\"\",\"gouges\":4,\"gouges_interval\":[3,5],\"better_than_next\":null,"
          "\"significant\":false,\"tied\":2,\"threshold_velocity\":1500,\"threshold_interval\":[1450,1550],"
          "\"onset_position\":1.2,\"gouged_volume\":2e-9,\"layer\":\"none\",\"scenes\":5}]" },
        { "scenes",
          "[{\"name\":\"t1-v1700\",\"velocity\":1700,\"class\":\"gouge\",\"gauged\":true,\"groove_growth\":1e5},"
          "{\"name\":\"v1500\",\"velocity\":1500,\"class\":\"gouge\",\"gauged\":true,\"groove_growth\":1e5},"
          "{\"name\":\"v1400\",\"velocity\":1400,\"class\":\"scratch\",\"gauged\":true,\"groove_growth\":-1e5}]" },
    };
    write_run(dir, STUDY_compare);
    add_to_summary(dir, more, 3);
}

static const char *const study_sections[] = { "Along the barrel",
                                              "The scenes that decide",
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
static const char *const comparison_sections[] = { "Where each surface gives way",
                                                   "Surfaces, best first",
                                                   "The scenes that decide",
                                                   "The shot",
                                                   "Warnings",
                                                   "Inputs",
                                                   "Versions",
                                                   NULL };

static void has_sections(const char *text, const char *const *titles)
{
    for (int i = 0; titles[i]; i++) {
        char heading[100];
        snprintf(heading, sizeof heading, ">%s</h2>", titles[i]);
        if (text_count(text, heading) != 1)
            fail_msg("the page has %d sections `%s`", text_count(text, heading), titles[i]);
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
    assert_non_null(strstr(text, "1700 (1650 to 1750)"));
    assert_non_null(strstr(text, "+5 % charge: "));
    assert_true(strstr(text, "layers worn by") && strstr(text, "armature metal on it"));
    assert_null(strstr(text, "+5 % mass: ")); /* where nothing gouges there is no place to move */
    assert_true(host_file_exists("report/plot-surface.svg"));
    free(text);
    write_comparison("report");
    text = page_of("report");
    is_self_contained(text);
    has_sections(text, comparison_sections);
    assert_non_null(strstr(text, "Best is hard &quot;skin&quot;."));
    assert_true(strstr(text, "layers worn by") && strstr(text, "armature metal on it"));
    assert_non_null(strstr(text, "gouges from 1800 (1750 to 1850)&nbsp;m/s on, 1.5 (1.0 to 2.3)&nbsp;gouges a shot"));
    /* beside the shot's velocities, one row a surface; then the scenes of each in a chart of its own */
    char *svg;
    OK(host_file_read("report/plot-ranking.svg", &svg, NULL));
    assert_int_equal(text_count(svg, "<rect"), 2);
    assert_int_equal(text_count(svg, "muzzle</text>"), 1);
    free(svg);
    assert_true(host_file_exists("report/plot-threshold-1.svg"));
    assert_true(host_file_exists("report/plot-threshold-2.svg"));
    OK(host_file_read("report/plot-threshold-1.svg", &svg, NULL));
    assert_int_equal(text_count(svg, "r=\"4.5\""), 1);
    free(svg);
    assert_int_equal(text_count(text, "class=\"missing\""), 0);
    free(text);
}

/* Grains of populations have no place of their own: the barrel is drawn all the same, and how probable a gouge is. */
static void populations_have_a_barrel_too(void **state)
{
    (void)state;
    static const char *const more[][2] = { { "sites", "[]" },
                                           { "along", "[0,1.5,3]" },
                                           { "probability_along", "[0,0.25,0.75]" } };
    write_run("report", STUDY_onset);
    add_to_summary("report", more, 3);
    char *text = page_of("report");
    is_self_contained(text);
    assert_int_equal(text_count(text, ">Along the barrel</h2>"), 1);
    assert_true(host_file_exists("report/plot-barrel.svg") && host_file_exists("report/plot-probability.svg"));
    assert_null(strstr(text, "p/H"));
    free(text);
}

/* ---- a real browser ---- */

#define BROWSER                                                                      \
    "chromium --headless --no-sandbox --disable-gpu --allow-file-access-from-files " \
    "--user-data-dir=\"$PWD/browser\" --virtual-time-budget=4000 --enable-logging=stderr --v=0 "

/* A frame of a screen's width around the page; its title says how wide the page wants to be, and what sticks out. */
static void write_frame(const char *path, int width)
{
    char text[900];
    const int n = snprintf(
        text, sizeof text,
        "<iframe id=\"f\" src=\"report/report.html\" width=\"%d\" height=\"800\" style=\"border:0\"></iframe><script>"
        "onload=function(){var d=document.getElementById('f').contentDocument,w=d.documentElement.clientWidth,o=0;"
        "d.querySelectorAll('td,th,figure,p,h1,h2,li,.card').forEach(function(e){"
        "var r=e.getBoundingClientRect();o+=r.right>w+1||(e.tagName!='TH'&&r.width==0)});"
        "document.title='wide '+d.documentElement.scrollWidth+' of '+w+', plots '"
        "+d.querySelectorAll('svg').length+', outside '+o}</script>",
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
    static const int widths[] = { 360, 390, 800, 1200 };
    char *text = browser_says("--dump-dom \"file://$PWD/report/report.html\"");
    has_sections(text, sections);
    const int drawn = text_count(text, "<svg");
    free(text);
    for (size_t k = 0; k < sizeof widths / sizeof *widths; k++) {
        int wide = 0, room = -1, plots = -1, outside = -1;
        write_frame("frame.html", widths[k]);
        text = browser_says("--dump-dom \"file://$PWD/frame.html\"");
        const char *title = strstr(text, "wide ");
        if (!title || sscanf(title, "wide %d of %d, plots %d, outside %d", &wide, &room, &plots, &outside) != 4)
            fail_msg("no answer: %.300s", text);
        free(text);
        assert_true(room > 300 && wide <= room); /* nothing sticks out, no cell is hidden */
        assert_int_equal(outside, 0);
        assert_int_equal(plots, drawn);
    }
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
    assert_null(strstr(text, "This rail gouges"));
    assert_null(strstr(text, "Along the barrel"));
    free(text);
}

static void what_is_no_run_is_refused(void **state)
{
    (void)state;
    fresh_folder("report");
    const status s = report_write("report", study_report_kind);
    assert_int_equal(s.code, STATUS_BAD_INPUT);
    assert_non_null(strstr(s.text, "summary.json"));
    OK(host_file_write("report/summary.json", "{ \"kind\": [", 11));
    assert_int_equal(report_write("report", study_report_kind).code, STATUS_BAD_INPUT);
    static const char *const wrong[][2] = { { "{}", "summary.json: is no summary of a run: its `kind` is missing" },
                                            { "[1, 2]", "its `kind` is missing" },
                                            { "{\"kind\": 5}", "its `kind` is missing" },
                                            { "{\"kind\": \"shoot\"}", "its `kind` shoot is unknown" } };
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        OK(host_file_write("report/summary.json", wrong[i][0], strlen(wrong[i][0])));
        const status none = report_write("report", study_report_kind);
        assert_int_equal(none.code, STATUS_BAD_INPUT);
        if (!strstr(none.text, wrong[i][1])) fail_msg("%s: %s", wrong[i][0], none.text);
        assert_false(host_file_exists("report/report.html"));
    }
    OK(host_file_write("report/summary.json", "{\"kind\": \"shot\"}", 16));
    OK(host_file_write("report/history.h5", "damaged", 7));
    assert_int_equal(report_write("report", study_report_kind).code, STATUS_IO);
    assert_false(host_file_exists("report/report.html"));
    assert_int_equal(report_write("report/nowhere", study_report_kind).code, STATUS_BAD_INPUT);
}

/* Summaries changed by hand: runs without inputs, a unit with a tag in it. */
static void a_changed_summary_is_shown(void **state)
{
    (void)state;
    static const char *const sweeps[] = {
        "[null, {\"inputs\": {\"a\": 1}, \"outputs\": {\"x\": 2}}]",
        "[{\"inputs\": {\"a\": 1}, \"outputs\": {\"x\": 2}}, null, {\"outputs\": {\"x\": 3}}]",
        "[{\"outputs\": {\"x\": 2}, \"errors\": {\"x\": 2}}, {\"inputs\": [1, 2]}]",
        "[{\"inputs\": [1], \"outputs\": [2]}]",
    };
    char text[500], *page = NULL;
    fresh_folder("report");
    for (size_t i = 0; i < sizeof sweeps / sizeof *sweeps; i++) {
        snprintf(text, sizeof text,
                 "{\"kind\": \"sweep\", \"status\": \"done\", \"of\": \"scene\", \"resolution\": \"a\", \"sweep\": %s}",
                 sweeps[i]);
        OK(host_file_write("report/summary.json", text, strlen(text)));
        OK(report_write("report", study_report_kind));
    }
    static const char probe[] = "{\"kind\": \"bodies\", \"status\": \"done\", \"probes\": {\"p\": {\"kind\": \"box\", "
                                "\"quantity\": \"mass\", \"unit\": \"<script>\", \"peak\": 1.5}}}";
    OK(host_file_write("report/summary.json", probe, strlen(probe)));
    OK(report_write("report", study_report_kind));
    OK(host_file_read("report/report.html", &page, NULL));
    assert_non_null(strstr(page, "&lt;script&gt;"));
    assert_null(strstr(page, "<script>"));
    free(page);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bodies_are_cut_before_and_after),
        cmocka_unit_test(page_for_every_kind),
        cmocka_unit_test(onset_page_shows_everything),
        cmocka_unit_test(advice_is_no_surer_than_the_interval),
        cmocka_unit_test(same_files_same_page),
        cmocka_unit_test(study_pages_have_their_sections),
        cmocka_unit_test(populations_have_a_barrel_too),
        cmocka_unit_test(a_browser_reads_it),
        cmocka_unit_test(a_rim_that_is_not_the_highest_is_explained),
        cmocka_unit_test(failed_run_has_a_page_too),
        cmocka_unit_test(what_is_no_run_is_refused),
        cmocka_unit_test(a_changed_summary_is_shown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
