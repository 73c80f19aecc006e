/* SPDX-License-Identifier: BSD-3-Clause */
/* A scene's window, its cells and what lies in them, as a user gives them: what cannot be is refused at the key that is
 * wrong, with its line and column. */
#include "program_common.h"

/* Lines 1 to 4; the caller's follow. */
static const char head[] = "name: w\n"
                           "output: {snapshots: 0, report: no}\n"
                           "scene:\n"
                           "  end_time: 0.2 us\n";
static const char bodies[] =
    "  bodies:\n"
    "    - {name: plate, material: ofhc_copper, shape: {box: {lo: 0 -5 -5 mm, hi: 4 5 5 mm}}}\n"
    "    - {name: ball, material: ofhc_copper, shape: {sphere: {center: -3 0 0 mm, radius: 2 mm}}, velocity: 1 0 0 "
    "km/s}\n";

static void write_scene(const char *lines)
{
    fresh_folder("w");
    FILE *f = fopen("w/case.yaml", "w");
    assert_non_null(f);
    fprintf(f, "%s%s%s", head, lines, bodies);
    fclose(f);
}

/* The place of a key in the case: "5:9" */
static void assert_refused_at(const char *lines, const char *place, const char *says)
{
    char wanted[300];
    write_scene(lines);
    assert_int_equal(run("check w"), 2);
    snprintf(wanted, sizeof wanted, "w/case.yaml:%s: %s", place, says);
    if (contains("err.txt", wanted)) return;
    char *said = NULL;
    OK(host_file_read("err.txt", &said, NULL));
    fail_msg("%s\nwanted: %s\nsaid:   %s", lines, wanted, said);
}

static void test_windows(void **state)
{
    (void)state;
    assert_refused_at("  cell: 0.5 mm\n  window:\n    x: {lo: 6 mm, hi: -8 mm}\n", "7:13",
                      "scene.window.x.lo = 0.006 m: must lie below");
    assert_refused_at("  cell: 0.5 mm\n  window:\n    x: {lo: -6 mm, hi: -5.9 mm}\n", "7:13",
                      "scene.window.x.lo = -0.006 m, scene.window.x.hi = -0.0059 m: the window is shorter than a cell");
    assert_refused_at("  cell: 0.5 mm\n  window:\n    x: {lo: 0.1 mm, hi: 8 mm}\n", "10:7",
                      "scene.bodies[1]: ball lies at x = -0.005 .. -0.001 m, out of the window");
    assert_refused_at("  cell: 0.5 mm\n  window:\n    x: {fine_lo: 3 mm, fine_hi: 2 mm}\n", "7:18",
                      "scene.window.x.fine_lo = 0.003 m");
    write_scene("  cell: 0.5 mm\n  window:\n    x: {lo: -6 mm, hi: 8 mm}\n    y: {lo: 0 mm, hi: 0.5 mm}\n");
    assert_int_equal(run("check w"), 0); /* one cell */
}

static void test_cells(void **state)
{
    (void)state;
    assert_refused_at(
        "  cell: 60 mm\n  window: {x: {lo: -6 mm, hi: 8 mm}, y: {lo: -6 mm, hi: 6 mm}, z: {lo: -6 mm, hi: 6 mm}}\n",
        "5:9", "scene.cell = 0.06 m: the window");
    assert_refused_at("  cell: 5 nm\n", "5:9", "scene.window.x.cell, of all axes scene.cell = 5e-09 m: too small");
    assert_refused_at("  cell: 0.5 mm\n  window:\n    y: {cell: 5 nm}\n", "7:15", "scene.window.y.cell, of all axes");
    assert_refused_at("  cell: 0.5 mm\n  coarse_cell: 0.1 mm\n", "6:16",
                      "scene.window.x.coarse_cell, of all axes scene.coarse_cell = 0.0001 m: the largest cells");
    assert_refused_at("  cell: 0.5 mm\n  window:\n    z: {coarse_cell: 0.1 mm}\n", "7:22",
                      "scene.window.z.coarse_cell, of all axes");
    assert_refused_at("  levels: 6\n  cell: 0.5 mm\n", "5:11", "scene.levels = 6: the largest cells, 0.016 m");
    assert_refused_at("  basis: bspline\n  levels: 2\n  cell: 0.5 mm\n", "6:11", "scene.levels = 2: several need");
}

/* Both by check and by the run; neither fails. */
static void assert_warned(const char *lines, const char *says, bool warned)
{
    write_scene(lines);
    assert_int_equal(run("check w"), 0);
    if (contains("out.txt", says) != warned) fail_msg("check: %s\n%s`%s`", lines, warned ? "no " : "", says);
    assert_int_equal(run("scene w -o w/out --quiet --no-store --threads 1"), 0);
    if (contains("err.txt", says) != warned) fail_msg("scene: %s\n%s`%s`", lines, warned ? "no " : "", says);
}

static void test_few_cells(void **state)
{
    (void)state;
    assert_warned("  cell: 1.5 mm\n", "warning: body ball: 2.7 cells of 1.5 mm across it along x, 4 mm", true);
    assert_warned("  cell: 1.3 mm\n", " across it", false);
    /* the plate as a layer of the window; the ball is halved by a mirror, which does not make it thinner */
    assert_warned("  cell: 1.3 mm\n  window: {y: {lo: 0 mm, hi: 5 mm}, z: {lo: -5 mm, hi: 5 mm}}\n"
                  "  boundary: {y: [symmetry, free], z: [symmetry, symmetry]}\n",
                  " across it", false);
    /* cells have grown there */
    assert_warned("  cell: 0.5 mm\n  coarse_cell: 4 mm\n  growth: 2\n  window: {x: {lo: -5 mm, hi: 30 mm, fine_lo: 20 "
                  "mm, fine_hi: 22 mm}}\n",
                  "warning: body ball: 1 cells of 4 mm across it along x", true);
    assert_int_equal(run("check " SHOT " --set scene.cells_per_radius=1.2"), 0);
    assert_true(contains("out.txt", "warning: particle: 2.4 cells across it"));
    /* a crater measured at less than a quarter of a cell of 167 um, and at more */
    assert_int_equal(run("check " SHOT " --set scene.measuring_depth='40 um'"), 0);
    assert_true(contains("out.txt", "warning: scene.measuring_depth = 40 um: less than a quarter of a cell of 167 um"));
    assert_int_equal(run("check " SHOT " --set scene.measuring_depth='43 um'"), 0);
    assert_false(contains("out.txt", "scene.measuring_depth = "));
    /* a film whose cells would take a ninth level, and one that leaves them room */
#define FILM                                                                                                \
    " --set rail.layers='[{material: steel_4340, thickness: 20 um}]' --set particle.radius='0.1 mm' --set " \
    "scene.cells_per_layer=4"
    assert_int_equal(run("check " SHOT FILM), 0);
    assert_true(contains(
        "out.txt", "warning: rail.layers[0]: 0.6 cells across 20 um of steel_4340, not 4 (scene.cells_per_layer)"));
    assert_int_equal(run("check " SHOT FILM " --set scene.coarse_cell='1 mm'"), 0);
    assert_false(contains("out.txt", "not 4 (scene.cells_per_layer)"));
#undef FILM
}

/* Cut away whole, claimed whole by a later body, of parts that lie apart: refused by its name. */
static void test_empty(void **state)
{
    (void)state;
#define BOX(lo, hi) "{box: {lo: " #lo " " #lo " " #lo " mm, hi: " #hi " " #hi " " #hi " mm}}"
    static const char *const shapes[][2] = {
        { "{minus: [" BOX(0, 3) ", " BOX(-1, 4) "]}", "scene.bodies[0].shape: nothing of none is left" },
        { BOX(6, 7), "scene.bodies[0].shape: nothing of none is left" },
        { "{intersect: [" BOX(0, 1) ", " BOX(2, 3) "]}", "scene.bodies[0].shape: none is empty" },
    };
    for (int i = 0; i < 3; i++) {
        fresh_folder("w");
        FILE *f = fopen("w/case.yaml", "w");
        assert_non_null(f);
        fprintf(f,
                "%s  cell: 0.5 mm\n  overlap: later\n  bodies:\n"
                "    - {name: none, material: ofhc_copper, shape: %s}\n"
                "    - {name: rest, material: ofhc_copper, shape: " BOX(5, 9) "}\n",
                head, shapes[i][0]);
        fclose(f);
        assert_int_equal(run("check w"), 2);
        if (!contains("err.txt", shapes[i][1])) fail_msg("not said: %s", shapes[i][1]);
        assert_int_equal(run("scene w -o w/out --quiet --no-store"), 2);
    }
#undef BOX
}

/* A ball that the window halves without a mirror; held by one, or at rest, it is no fault. */
static void test_cut(void **state)
{
    (void)state;
    const char *says = "warning: body ball reaches 2 mm beyond scene.window.z.lo, a free end";
#define HALF(ends) "  cell: 1 mm\n  window: {z: {lo: 0 mm, hi: 5 mm}}\n" ends
    assert_warned(HALF(""), says, true);
    assert_warned(HALF("  boundary: {z: [symmetry, free]}\n"), "a free end", false);
    write_scene(HALF(""));
    assert_int_equal(run("check w --set 'scene.bodies[1].velocity=0 0 0 m/s'"), 0);
    assert_false(contains("out.txt", "a free end"));
#undef HALF
}

static void test_probes(void **state)
{
    (void)state;
    write_scene("  cell: 1 mm\n  probes: [{name: push, force_on: ball}]\n");
    assert_int_equal(run("check w"), 0);
    assert_false(contains("out.txt", "probe push"));
    assert_int_equal(run("check w --set 'scene.bodies[0].group=t' --set 'scene.bodies[1].group=t'"), 0);
    assert_true(contains("out.txt", "warning: probe push: the force is that on the whole group of ball: with plate"));
    assert_refused_at("  cell: 1 mm\n  probes:\n    - {name: a, force: ball}\n"
                      "    - {name: g, pressure: {at: 200 0 0 mm}}\n",
                      "8:32", "scene.probes[1].pressure.at: g lies at x = ");
    assert_refused_at("  cell: 1 mm\n  probes: [{name: f, face: {lo: 0 90 0 mm, hi: 1 91 1 mm}}]\n", "6:33",
                      "scene.probes[0].face.lo: f lies at y = ");
    assert_refused_at("  cell: 1 mm\n  probes: [{name: g, cavity: {number: 0}}]\n", "6:39",
                      "scene.probes[0].cavity.number = 0: the scene has 0 cavities");
    assert_refused_at("  cell: 1 mm\n  probes: [{name: g, cavity: {number: 1.7}}]\n", "6:30",
                      "scene.probes[0].cavity.number = 1.7: a cavity has a whole number");
    assert_warned("  cell: 1 mm\n  probes: [{name: g, pressure: {at: -3 3.5 0 mm}}]\n",
                  "warning: probe g: nothing is where it reads at the start", true);
    assert_warned("  cell: 1 mm\n  probes: [{name: g, pressure: {at: -3 0 0 mm, body: plate}}]\n",
                  "warning: probe g: nothing of plate is where it reads at the start", true);
    assert_warned("  cell: 1 mm\n  probes: [{name: g, pressure: {at: -3 0 0 mm}}, {name: a, force: ball}]\n",
                  "where it reads", false);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_windows), cmocka_unit_test(test_cells),  cmocka_unit_test(test_few_cells),
        cmocka_unit_test(test_cut),     cmocka_unit_test(test_probes), cmocka_unit_test(test_empty),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
