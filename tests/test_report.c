/* SPDX-License-Identifier: BSD-3-Clause */
/* What the pages of the report are made of: numbers with the digits that are known, charts whose points lie where their
 * values say, reliefs whose levels have their area, tables that show every column. */
#include "coupling/report/report_chart.h"
#include "coupling/report/report_relief.h"
#include "coupling/report/report_svg.h"
#include "coupling/report/report_table.h"
#include "coupling/report/report_value.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "text_common.h"

/* ---- numbers ---- */

static void test_known_digits(void **state)
{
    (void)state;
    static const struct {
        double x, lo, hi;
        const char *text;
    } cases[] = { { 953.7367, 788.869, 1155.99, "950 (790 to 1160)" },
                  { 534.66, 341.4, 860.8, "530 (340 to 860)" },
                  { 690.5, 580.9, 769.1, "690 (580 to 770)" },
                  { 0.69562, 0.52917, 0.948, "0.70 (0.53 to 0.95)" },
                  { 1673.2, 1200.0, 1942.3, "1670 (1200 to 1940)" },
                  { 5.095, 4.0, 6.0, "5.1 (4.0 to 6.0)" },
                  { 920.36, 783.07, 1514.86, "920 (780 to 1510)" }, /* by the nearer end */
                  { NAN, 1440.0, NAN, "above 1440" },
                  { NAN, NAN, 500.0, "below 500" },
                  { NAN, 790.0, 1160.0, "790 to 1160" },
                  { 953.7367, 788.869, NAN, "954 (from 789)" },
                  { 953.7367, NAN, NAN, "954" },
                  { NAN, NAN, NAN, "&ndash;" },
                  { 1500.0, 1500.0, 1500.0, "1500" } };
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        char text[REPORT_VALUE_SIZE];
        report_value_interval(cases[k].x, cases[k].lo, cases[k].hi, text);
        assert_string_equal(text, cases[k].text);
    }
}

static void test_plain_digits(void **state)
{
    (void)state;
    static const struct {
        double x;
        const char *text;
    } cases[] = { { 0.0, "0" },
                  { -0.0, "0" },
                  { 14.0, "14" },
                  { 1933.0236, "1930" },
                  { 0.4996, "0.5" },
                  { 0.37953, "0.38" },
                  { -7.6038, "-7.6" },
                  { 99.96, "100" },
                  { 61691972.5, "6.17&times;10<sup>7</sup>" },
                  { 9.9999e-16, "1&times;10<sup>-15</sup>" },
                  { INFINITY, "&ndash;" } };
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        char text[REPORT_VALUE_SIZE];
        report_value_plain(cases[k].x, text);
        assert_string_equal(text, cases[k].text);
    }
}

/* ---- charts ---- */

/* The value that stands in `text` after `before`. */
static double number_after(const char *text, const char *before)
{
    const char *at = strstr(text, before);
    if (!at) fail_msg("no `%s` in %.300s", before, text);
    return atof(at + strlen(before));
}

/* Two points and the ticks tell the scale: a third lies where it says, in megapascals. */
static void test_chart_places_points(void **state)
{
    (void)state;
    const double x[] = { 0.0, 1e-3, 4e-3 }, y[] = { 0.0, 1e6, 3e6 };
    report_chart *c = report_chart_create((report_axis){ .label = "time", .unit = "s", .from_zero = true },
                                          (report_axis){ .label = "pressure", .unit = "Pa", .from_zero = true });
    report_chart_dots(c, "wall <a>", "#123456", x, y, 3);
    char *svg = report_chart_svg(c, "a & b");
    assert_non_null(svg);
    assert_non_null(strstr(svg, "time [ms]"));
    assert_non_null(strstr(svg, "pressure [MPa]"));
    assert_non_null(strstr(svg, "wall &lt;a&gt;"));
    assert_non_null(strstr(svg, "<title>a &amp; b</title>"));
    double cx[3], cy[3];
    const char *at = svg;
    for (int k = 0; k < 3; k++) {
        at = strstr(at, "r=\"4.5\"") ? strstr(at, "<circle cx") : NULL;
        if (k == 0) at = strstr(at + 1, "<circle cx"); /* the first is the legend's */
        cx[k] = number_after(at, "cx=\"");
        cy[k] = number_after(at, "cy=\"");
        at++;
    }
    /* coordinates have a tenth of a unit */
    assert_true(fabs((cx[1] - cx[0]) / (cx[2] - cx[0]) - 0.25) < 2e-3);
    assert_true(fabs((cy[0] - cy[1]) / (cy[0] - cy[2]) - 1.0 / 3.0) < 2e-3);
    assert_true(cx[2] > cx[0] && cy[2] < cy[0]);
    free(svg);
}

static void test_chart_without_values_is_none(void **state)
{
    (void)state;
    const double nothing[] = { NAN, NAN }, negative[] = { -1.0, 2.0 };
    report_chart *c =
        report_chart_create((report_axis){ .label = "x", .unit = "" }, (report_axis){ .label = "y", .unit = "" });
    report_chart_line(c, "", "#000", nothing, negative, 2);
    report_chart_band(c, "", "#000", 'x', 1.0, 2.0);
    assert_null(report_chart_svg(c, "none"));
    c = report_chart_create((report_axis){ .label = "x", .unit = "" }, (report_axis){ .label = "y", .unit = "" });
    report_chart_line(c, "", "#000", negative, nothing, 2);
    assert_null(report_chart_svg(c, "none"));
}

/* Thousands of points on a smooth curve need few: each left out lies within a third of a unit of what is drawn. */
static void test_lines_are_small(void **state)
{
    (void)state;
    enum { N = 4000 };
    static double x[N], y[N];
    char *text = NULL;
    size_t size;
    for (int i = 0; i < N; i++) {
        x[i] = 400.0 * i / N;
        y[i] = 100.0 + 80.0 * sin(0.05 * x[i]);
    }
    FILE *out = open_memstream(&text, &size);
    report_svg_line(out, x, y, N, "#000", 1.0, false);
    fclose(out);
    const int points = text_count(text, "L") + 1;
    assert_true(points > 20 && points < 200);
    const char *at = strchr(text, 'M') + 1;
    double a[2], b[2];
    assert_int_equal(sscanf(at, "%lf %lf", &a[0], &a[1]), 2);
    for (int i = 0; (at = strchr(at, 'L')); a[0] = b[0], a[1] = b[1]) {
        assert_int_equal(sscanf(++at, "%lf %lf", &b[0], &b[1]), 2);
        for (; i < N && x[i] <= b[0]; i++) {
            const double on = a[1] + (b[1] - a[1]) * (x[i] - a[0]) / (b[0] - a[0]);
            assert_true(fabs(on - y[i]) < 1.5); /* the slope is at most 4: a third of a unit across */
        }
    }
    free(text);
}

/* ---- reliefs ---- */

/* Sum over closed outlines, whichever way round they go. */
static double path_area(const char *path)
{
    double area = 0.0, first[2] = { 0.0, 0.0 }, last[2] = { 0.0, 0.0 }, p[2];
    for (const char *end = strchr(path, '"'); path < end; path++) {
        if (*path == 'M' || *path == 'L') {
            assert_int_equal(sscanf(path + 1, "%lf %lf", &p[0], &p[1]), 2);
            if (*path == 'M')
                memcpy(first, p, sizeof first);
            else
                area += 0.5 * (last[0] * p[1] - last[1] * p[0]);
            memcpy(last, p, sizeof last);
        } else if (*path == 'Z') {
            area += 0.5 * (last[0] * first[1] - last[1] * first[0]);
        }
    }
    return fabs(area);
}

/* A cone of 1 mm depth and 4 mm radius on a grid of 0.1 mm: the area in which it is deeper than d is a disc of radius
 * 4 (1 - d); the levels are 0.1, 0.3, ... deep. */
static void test_levels_have_their_area(void **state)
{
    (void)state;
    enum { N = 101 };
    static double height[N * N];
    for (int i = 0; i < N; i++)
        for (int j = 0; j < N; j++) height[i * N + j] = -1e-3 * fmax(0.0, 1.0 - hypot(i - 50.0, j - 50.0) / 40.0);
    const report_relief cone = { .height = height,
                                 .nx = N,
                                 .ny = N,
                                 .dx = 1e-4,
                                 .dy = 1e-4,
                                 .colour_range = 1e-3,
                                 .unit = 1e-3,
                                 .legend = "height [mm]",
                                 .above = "" };
    char *svg = report_relief_map(&cone, "cone");
    assert_non_null(svg);
    assert_non_null(strstr(svg, ">2 mm</text>")); /* the scale of lengths */
    const double unit = 424.0 / 10.0;             /* of the picture, a millimetre */
    const char *at = svg;
    for (int level = 0; level < 5; level++) {
        at = strstr(at, "<path fill=");
        if (!at) fail_msg("only %d levels", level);
        const double radius = 4.0 * (1.0 - 0.1 * (2 * level + 1));
        const double area = path_area(strstr(at, " d=\"") + 4) / (unit * unit);
        /* chords of cells of 0.1 mm, coordinates of a tenth of 1/42 mm */
        assert_true(fabs(area / (acos(-1.0) * radius * radius) - 1.0) < 0.02);
        at++;
    }
    free(svg);
}

/* Two points that touch at a corner stay two: around each the area above a level is a square on its corner, whose
 * diagonals are 2 (1 - level) cells. */
static void test_points_that_touch_at_a_corner(void **state)
{
    (void)state;
    enum { N = 4 };
    static double height[N * N];
    height[1 * N + 1] = height[2 * N + 2] = 1e-3;
    const report_relief two = { .height = height,
                                .nx = N,
                                .ny = N,
                                .dx = 1e-3,
                                .dy = 1e-3,
                                .colour_range = 1e-3,
                                .unit = 1e-3,
                                .legend = "",
                                .above = "" };
    char *svg = report_relief_map(&two, "two");
    assert_non_null(svg);
    const double unit = 424.0 / 3.0; /* of the picture, a cell */
    const char *at = svg;
    for (int level = 0; level < 5; level++, at++) {
        at = strstr(at, "<path fill=");
        if (!at) fail_msg("only %d levels", level);
        const double half = 1.0 - 0.1 * (2 * level + 1);
        const double area = path_area(strstr(at, " d=\"") + 4) / (unit * unit);
        assert_true(fabs(area / (4.0 * half * half) - 1.0) < 0.02); /* coordinates of a tenth of a unit */
    }
    free(svg);
}

/* Cropped it holds what is deeper than the limit, and the places stay what they were. */
static void test_crop_keeps_what_counts(void **state)
{
    (void)state;
    enum { NX = 60, NY = 40 };
    static double height[NX * NY];
    height[30 * NY + 22] = -1.0;
    height[40 * NY + 18] = 0.5;
    height[2 * NY + 2] = 0.01;
    report_relief s = { .height = height, .nx = NX, .ny = NY, .x0 = -1.0, .dx = 0.1, .y0 = 0.0, .dy = 0.1 };
    double *part = report_relief_crop(&s, 0.1);
    assert_non_null(part);
    assert_true(s.nx < 25 && s.ny < 20);
    const size_t i = (size_t)lround((2.0 - s.x0) / 0.1), j = (size_t)lround((2.2 - s.y0) / 0.1);
    assert_true(part[i * s.ny + j] == -1.0);
    free(part);
}

/* Painted from the far strips to the near ones, the walls last; heights drawn larger where they are small. */
static void test_aside(void **state)
{
    (void)state;
    enum { N = 40 };
    static double height[N * N];
    for (int i = 0; i < N; i++)
        for (int j = 0; j < N; j++)
            height[i * N + j] = -1e-4 * exp(-0.01 * ((i - 20) * (i - 20) + (j - 20) * (j - 20)));
    const report_relief pit = { .height = height,
                                .nx = N,
                                .ny = N,
                                .dx = 1e-4,
                                .dy = 1e-4,
                                .colour_range = 1e-4,
                                .unit = 1e-3,
                                .legend = "",
                                .above = "" };
    double up = 0.0;
    char *svg = report_relief_aside(&pit, "pit", &up);
    assert_non_null(svg);
    assert_true(up == 5.0); /* a sixth of 3.9 mm over 0.1 mm is 6.5 */
    assert_true(strlen(svg) < 100000);
    assert_int_equal(text_count(svg, "color=\"#b9b3a6\""), 1);
    assert_true(strstr(svg, "color=\"#b9b3a6\"") > strstr(svg, "color=\"#"));
    assert_non_null(strstr(svg, "mm</text>"));
    free(svg);
}

/* Powers of ten on a logarithmic axis are short. */
static void test_powers_of_ten(void **state)
{
    (void)state;
    static const struct {
        double tick, step;
        const char *text;
    } want[] = { { 1e7, 0.0, "10\u2077" },        { 2e-4, 0.0, "2\u00b710\u207b\u2074" },
                 { 1e12, 0.0, "10\u00b9\u00b2" }, { 1000.0, 0.0, "1000" },
                 { 0.01, 0.0, "0.01" },           { 20000.0, 5000.0, "20000" },
                 { 0.25, 0.05, "0.25" } };
    for (size_t i = 0; i < sizeof want / sizeof *want; i++) {
        char text[32];
        report_scale_label(want[i].tick, want[i].step, text);
        assert_string_equal(text, want[i].text);
    }
}

/* ---- tables ---- */

static void test_every_cell_has_its_title(void **state)
{
    (void)state;
    char *text = NULL;
    size_t size;
    report_table t;
    FILE *out = open_memstream(&text, &size);
    report_table_begin(&t, out);
    report_table_text_title(&t, "the.long_name");
    for (int k = 0; k < 12; k++) report_table_title(&t, "number", "m/s");
    for (int row = 0; row < 3; row++) {
        report_table_row(&t);
        report_table_text(&t, "<x>");
        for (int k = 0; k < 13; k++) report_table_number(&t, 1234.567, 1.0); /* one too many is left out */
    }
    report_table_end(&t);
    fclose(out);
    assert_int_equal(text_count(text, "<table class=\"many\">"), 1);
    assert_int_equal(text_count(text, "<th"), 13 + 1); /* and thead */
    assert_int_equal(text_count(text, "<td"), 3 * 13);
    assert_int_equal(text_count(text, "data-title=\"number [m/s]\">1230</td>"), 3 * 12);
    assert_int_equal(text_count(text, "&lt;x&gt;"), 3);
    assert_int_equal(text_count(text, ">the.&#8203;long_&#8203;name</th>"), 1); /* may go on in the next line */
    assert_int_equal(text_count(text, "data-title=\"the.&#8203;long_&#8203;name\""), 3);
    free(text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_known_digits),
        cmocka_unit_test(test_plain_digits),
        cmocka_unit_test(test_powers_of_ten),
        cmocka_unit_test(test_chart_places_points),
        cmocka_unit_test(test_chart_without_values_is_none),
        cmocka_unit_test(test_lines_are_small),
        cmocka_unit_test(test_levels_have_their_area),
        cmocka_unit_test(test_crop_keeps_what_counts),
        cmocka_unit_test(test_aside),
        cmocka_unit_test(test_points_that_touch_at_a_corner),
        cmocka_unit_test(test_every_cell_has_its_title),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
