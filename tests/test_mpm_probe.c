/* SPDX-License-Identifier: BSD-3-Clause */
/* Probes against closed answers, one test a kind at least: test_table fails for a kind without.  Same bits on any
 * number of threads. */
#include "mpm_scenes.h"

#include "mpm/memory/store.h"
#include "mpm/read/probe.h"

enum { MOST = 4096 };

static mpm_probe probe(const char *kind, int body)
{
    const mpm_probe_kind *k = mpm_probe_kind_find(kind);
    if (!k) fail_msg("no kind of probe `%s`", kind);
    mpm_probe p = mpm_probe_make(k, kind);
    p.body = body;
    return p;
}

static void set(mpm_probe *p, const char *name, double x, double y, double z)
{
    double *v = mpm_probe_value(p, name);
    assert_non_null(v);
    v[0] = x, v[1] = y, v[2] = z;
}

static void look(const mpm *m, const mpm_probe *p, double *out)
{
    assert_ok(mpm_probe_check(p, m->scene.bodies));
    assert_in_range(mpm_probe_rows(p) * mpm_probe_columns(p), 1, MOST);
    assert_ok(mpm_probe_read(m, p, out));
}

/* ---- every point of a solver, to be given what a probe should find ---- */

typedef void setter(block *q, int lane);

static void each_point(mpm *m, setter *give)
{
    for (int i = 0; i < m->bricks_used; i++)
        for (int c = 0; c < BRICK_CELLS; c++)
            for (int q = m->bricks[i].head[c]; q >= 0; q = m->links[q].next)
                for (int l = 0; l < LANES; l++)
                    if (m->blocks[q].mass[0][l] > 0) give(&m->blocks[q], l);
}

/* Two copper cubes of 2 mm that touch at x = 0, on cells of 0.25 mm; bodies 0 and 1. */
static mpm *cubes(const mpm_material *m)
{
    SCENE_LOCAL(s);
    mpm_scene_default(&s);
    for (int k = 0; k < 3; k++) s.axis[k] = scene_axis(-3e-3, 3e-3, 0.25e-3, MPM_BOUNDARY_FREE, MPM_BOUNDARY_FREE);
    scene_box(&s, -2e-3, -1e-3, -1e-3, 0, 1e-3, 1e-3, m);
    scene_box(&s, 0, -1e-3, -1e-3, 2e-3, 1e-3, 1e-3, m)->group = 1;
    return scene_make(&s, 1);
}

/* ---- pressure, face ---- */

static const double P0 = 1e9, DPDY = 2e11; /* [Pa, Pa/m] */

static void hydrostatic(block *q, int l)
{
    q->p[0][l] = P0 + DPDY * q->x[1][l];
    q->s[0][l] = 1e8, q->s[1][l] = 2e8, q->s[2][l] = -3e8;
}

/* A pressure that rises along y.  In a box whose faces lie between points, the mean is that of its middle, to rounding;
 * elsewhere within the change over a quarter of a point's height. */
static void test_pressure(void **state)
{
    (void)state;
    const mpm_material m = scene_copper();
    mpm *solver = cubes(&m);
    double out[6];
    each_point(solver, hydrostatic);
    mpm_probe at = probe("pressure", -1), box = probe("face", -1);
    set(&at, "at", 0, 0.5e-3, 0);
    look(solver, &at, out);
    assert_near(out[0] / (P0 + DPDY * 0.5e-3), 1, 1e-12);
    assert_near(out[1] - out[2], -1e8, 1);
    assert_near(out[3] + out[0], -3e8, 1);
    assert_near(out[4], 0.25e-3 * 0.25e-3 * 0.25e-3, 1e-22); /* a cell of the grid */
    assert_near(out[5] / m.density, 1, 1e-12);
    set(&at, "at", 0, 0.53e-3, 0);
    look(solver, &at, out);
    assert_near(out[0], P0 + DPDY * 0.53e-3, DPDY * 0.25 * 0.125e-3);
    *mpm_probe_value(&at, "reach") = 0.1e-3;
    look(solver, &at, out);
    assert_near(out[4], 8e-12, 1e-21);

    set(&box, "lo", -0.25e-3, -0.5e-3, -5), set(&box, "hi", 0.5e-3, 0, 5);
    look(solver, &box, out);
    assert_near(out[0] / (P0 - DPDY * 0.25e-3), 1, 1e-12);
    assert_near(out[4], 0.75e-3 * 0.5e-3 * 2e-3, 1e-20);
    box.body = 1; /* the part beyond x = 0 */
    look(solver, &box, out);
    assert_near(out[4], 0.5e-3 * 0.5e-3 * 2e-3, 1e-20);
    set(&box, "lo", 2.1e-3, -1, -1), set(&box, "hi", 2.2e-3, 1, 1); /* nothing there */
    look(solver, &box, out);
    assert_true(out[4] == 0 && isnan(out[0]) && isnan(out[3]));
    mpm_free(solver);
}

/* ---- force: a plate on a plate ---- */

/* Copper on copper without strength, 1000 m/s, one-dimensional: behind both shocks p = rho0 (c0 + s u) u, u = v/2
 * (Rankine and Hugoniot).  What one body does to the other is that pressure times the area.  2 %: what is left of
 * the ringing behind the shock with a viscosity five times the usual; near the contact both bodies are hotter. */
static void test_force(void **state)
{
    (void)state;
    const mpm_material m = scene_hydro();
    const double h = 0.1e-3, u = 500, want = m.density * (m.sound_speed + m.hugoniot_slope * u) * u;
    const double area = 4 * h * 4 * h;
    SCENE_LOCAL(s);
    scene_bar(&s, -12e-3, 12e-3, h, 4);
    s.viscosity_linear = 1;
    scene_box(&s, -8e-3, -1, -1, 0, 1, 1, &m)->velocity[0] = 2 * u;
    scene_box(&s, 0, -1, -1, 8e-3, 1, 1, &m)->group = 1;
    mpm *solver = scene_make(&s, 1);
    assert_ok(mpm_advance(solver, 0.9e-6, NULL));
    double push[3], pull[3], p[6], mean[3] = { 0 };
    mpm_probe on = probe("force", 1), by = probe("force", 0), face = probe("face", -1);
    for (int i = 0; i < 20; i++) { /* of some steps: points that cross cells make it tremble */
        scene_steps(solver, 1);
        look(solver, &on, push), look(solver, &by, pull);
        for (int k = 0; k < 3; k++) {
            mean[k] += push[k] / 20;
            assert_near(push[k] + pull[k], 0, 1e-9 * want * area);
        }
    }
    const double x = u * mpm_glance(solver).time;
    set(&face, "lo", x + 0.5e-3, 0, 0), set(&face, "hi", x + 2e-3, 4 * h, 4 * h);
    look(solver, &face, p);
    print_message("plateau %.4g GPa, want %.4g; force over area %.4g\n", 1e-9 * p[0], 1e-9 * want,
                  1e-9 * mean[0] / area);
    assert_near(p[0] / want, 1, 0.02);
    assert_near(mean[0] / (want * area), 1, 0.02);
    assert_near(mean[1], 0, 1e-6 * want * area);
    mpm_free(solver);
}

/* ---- motion, energy ---- */

/* A strut that flies and turns; a box at rest beside it does not count.  1 %: what velocity gradients hold is that of
 * mass on the nodes, M w h^2 / 3 more, and the surface. */
static void test_motion(void **state)
{
    (void)state;
    const mpm_material m = scene_copper();
    const double r = 0.5e-3, length = 2e-3, h = r / 8, w[3] = { 2e4, 0, 1e4 };
    const double strut[] = { -1e-3, 0.2e-3, 0.1e-3, 1e-3, 0.2e-3, 0.1e-3, r };
    SCENE_LOCAL(s);
    mpm_scene_default(&s);
    for (int k = 0; k < 3; k++) s.axis[k] = scene_axis(-1.5e-3, 2.5e-3, h, MPM_BOUNDARY_FREE, MPM_BOUNDARY_FREE);
    mpm_body *b = scene_body(&s, "strut", strut, 7, &m);
    b->velocity[0] = 100, b->velocity[2] = -30;
    for (int k = 0; k < 3; k++) b->spin[k] = w[k];
    scene_box(&s, -1e-3, 1.2e-3, -1e-3, 1e-3, 1.4e-3, 1e-3, &m);
    mpm *solver = scene_make(&s, 1);
    double out[10], e[3], all[3];
    mpm_probe motion = probe("motion", 0), energy = probe("energy", 0), total = probe("energy", -1);
    look(solver, &motion, out);
    const double mass = m.density * SCENE_PI * r * r * length;
    const double across = mass * (3 * r * r + length * length) / 12, along = 0.5 * mass * r * r;
    assert_near(out[0] / mass, 1, 1e-2);
    for (int k = 0; k < 3; k++) {
        assert_near(out[1 + k], 0.5 * (strut[k] + strut[3 + k]), 1e-3 * r);
        assert_near(out[4 + k], s.body[0].velocity[k], 1e-9);
        assert_near(out[7 + k], (k == 0 ? along : across) * w[k], 1e-2 * across * 1e4);
    }
    look(solver, &energy, e);
    const double turning = 0.5 * (along * w[0] * w[0] + across * w[2] * w[2]);
    assert_near(e[0] / (0.5 * mass * 10900 + turning), 1, 1e-2);
    look(solver, &total, all);
    const mpm_ledger l = mpm_balance(solver);
    assert_near(all[0] / l.kinetic, 1, 1e-12);
    assert_near(all[1] - l.internal, 0, 1e-12 * l.kinetic);
    assert_true(e[2] == 0);
    mpm_free(solver);
}

static void broken(block *q, int l)
{
    q->damage[0][l] = q->x[1][l] > 0 ? 1 : 0.99;
}

static void test_failed(void **state)
{
    (void)state;
    const mpm_material m = scene_copper();
    mpm *solver = cubes(&m);
    double out[3];
    mpm_probe energy = probe("energy", 1);
    each_point(solver, broken);
    look(solver, &energy, out);
    assert_near(out[2], 4e-9, 1e-18);
    mpm_free(solver);
}

/* ---- plastic ---- */

static int sheared; /* which pair of axes: xy, xz, yz */

static void shear(block *q, int l)
{
    static const int row[3] = { 1, 2, 5 }, column[3] = { 3, 6, 7 };
    for (int i = 0; i < 9; i++) q->L[i][l] = 0;
    for (int i = 0; i < 6; i++) q->s[i][l] = 0;
    q->flow[0][l] = q->x[0][l] < 0 ? 1e8 : 1e12; /* body 1 does not yield */
    q->s[3 + sheared][l] = 1e8;
    q->L[row[sheared]][l] = 3e4, q->L[column[sheared]][l] = 1e4;
}

/* s_ij (L_ij + L_ji) V, for each pair. */
static void test_plastic(void **state)
{
    (void)state;
    const mpm_material m = scene_copper();
    mpm *solver = cubes(&m);
    double out;
    mpm_probe plastic = probe("plastic", 0);
    for (sheared = 0; sheared < 3; sheared++) {
        each_point(solver, shear);
        plastic.body = 0;
        look(solver, &plastic, &out);
        assert_near(out / (1e8 * 4e4 * 8e-9), 1, 1e-12);
        plastic.body = 1;
        look(solver, &plastic, &out);
        assert_true(out == 0);
    }
    mpm_free(solver);
}

/* Slices of 0.5 mm that begin in the middle of points of 0.125 mm: such a point belongs to two, half to each.  Across
 * z, 1.5 mm are read, the outer third of them apart; body 1 has volume, but takes no power. */
static void test_profile(void **state)
{
    (void)state;
    enum { N = 12 };
    const mpm_material m = scene_copper();
    const mpm_slices slices = {
        .along = 0, .across = 2, .n = N, .lo = -3.0625e-3, .width = 0.5e-3, .half = 0.75e-3, .sides = 2.0 / 3
    };
    mpm *solver = cubes(&m);
    sheared = 0, each_point(solver, shear);
    for (int body = 0; body < 2; body++) {
        const bool counts[2] = { body == 0, body == 1 };
        mpm_plastic_sum one[2 * N], three[2 * N];
        assert_ok(mpm_plastic_profile(solver, counts, &slices, one));
        for (int i = 0; i < N; i++)
            for (int part = 0; part < 2; part++) {
                const double from = fmax(slices.lo + i * slices.width, body == 0 ? -2e-3 : 0),
                             to = fmin(slices.lo + (i + 1) * slices.width, body == 0 ? 0 : 2e-3),
                             volume = fmax(to - from, 0) * 2e-3 * (part == 0 ? 1e-3 : 0.5e-3);
                assert_near(one[2 * i + part].volume, volume, 1e-12 * 8e-9);
                assert_near(one[2 * i + part].power, body == 0 ? 1e8 * 4e4 * volume : 0, 1e-12 * 1e8 * 4e4 * 8e-9);
            }
        mpm_slices beside = slices; /* what ends less than a slice before the first, or begins behind the last */
        beside.lo = body == 0 ? 0.1e-3 : -0.1e-3 - N * beside.width;
        assert_ok(mpm_plastic_profile(solver, counts, &beside, three));
        for (int i = 0; i < 2 * N; i++) assert_true(three[i].power == 0 && three[i].volume == 0);
        mpm_set_threads(solver, 3);
        assert_ok(mpm_plastic_profile(solver, counts, &slices, three));
        assert_memory_equal(one, three, sizeof one);
    }
    mpm_free(solver);
}

/* ---- surface ---- */

/* A wedge of slope 1/2 across x on a floor that is another body: its flanks from above, its base from below, gaps
 * beside it.  A point's domain steps by half its length on the slope and a point that is cut has a shorter one: within
 * a point's height. */
static void test_surface(void **state)
{
    (void)state;
    const mpm_material m = scene_copper();
    const double wedge[] = { 0.1e-3, 0, 0, 1e-3, 0.5e-3, 1e-3 }, h = 0.1e-3;
    SCENE_LOCAL(s);
    mpm_scene_default(&s);
    for (int k = 0; k < 3; k++) s.axis[k] = scene_axis(-1.5e-3, 1.5e-3, h, MPM_BOUNDARY_FREE, MPM_BOUNDARY_FREE);
    scene_box(&s, -1.5e-3, -0.5e-3, -1.5e-3, 1.5e-3, 0, 1.5e-3, &m);
    scene_body(&s, "wedge", wedge, 6, &m);
    mpm *solver = scene_make(&s, 1);
    static double out[3 * MOST];
    mpm_probe map = probe("surface", 1);
    set(&map, "lo", -1.5e-3, -1e-3, -1.5e-3), set(&map, "hi", 1.5e-3, 1e-3, 1.5e-3), set(&map, "along", 0, 1, 0);
    *mpm_probe_value(&map, "cell") = 0.1001e-3;
    int gaps = 0, seen = 0;
    for (int below = 0; below < 2; below++) {
        if (below) set(&map, "along", 0, -1, 0);
        look(solver, &map, out);
        assert_int_equal(mpm_probe_rows(&map), 30 * 30);
        for (int i = 0; i < 900; i++) {
            const double *row = out + 3 * i, height = 0.5 * (1e-3 - fabs(row[0] - 0.1e-3));
            assert_near(row[2], -1.5e-3 + (i / 30 + 0.5) * 0.1e-3, 1e-15); /* z varies slowest */
            assert_near(row[0], -1.5e-3 + (i % 30 + 0.5) * 0.1e-3, 1e-15);
            const bool out_of_it = height < 0 || fabs(row[2]) > 1e-3;
            if (out_of_it) assert_true(isnan(row[1]));
            if (out_of_it || height < h) {
                gaps++;
                continue;
            }
            assert_near(row[1], below ? 0 : height, 0.5 * h);
            seen++;
        }
    }
    assert_true(gaps > 500 && seen > 500);
    map.body = -1; /* the floor too, from above: no gap */
    set(&map, "along", 0, 1, 0);
    look(solver, &map, out);
    for (int i = 0; i < 900; i++)
        assert_near(out[3 * i + 1], fmax(0, 0.5 * (1e-3 - fabs(out[3 * i] - 0.1e-3)) * (fabs(out[3 * i + 2]) < 1e-3)),
                    0.5 * h);
    each_point(solver, broken); /* what has failed is no surface */
    look(solver, &map, out);
    for (int i = 0; i < 900; i++) assert_near(out[3 * i + 1], 0, 1e-9);
    mpm_free(solver);
}

/* ---- passage ---- */

static void fly(block *q, int l)
{
    const bool ball = q->x[0][l]<0, beside = q->x[2][l]> 0, far = q->x[0][l] > 1e-3;
    q->v[0][l] = ball ? 300 : beside ? 0 : far ? 140 : 160; /* slower and faster than half of it */
    q->v[1][l] = ball || !beside ? 0 : 60;
    q->damage[0][l] = !ball && far && q->x[1][l] > 0 ? 1 : 0;
    q->start[0][l] = q->x[0][l] - (far ? 0.3e-3 : 0.1e-3);
}

/* Body 0 goes along x through body 1, whose quarters are all that metal may be: intact or failed, slower or faster.
 * Points of 0.125 mm lie within the reach as a whole or not at all, so that the masses are exact. */
static void test_passage(void **state)
{
    (void)state;
    const mpm_material m = scene_copper();
    mpm *solver = cubes(&m);
    double out[8];
    const double kg = m.density * 1e-9; /* of a cubic millimetre */
    each_point(solver, fly);
    mpm_probe p = probe("passage", 0);
    set(&p, "along", 0.5, 0, 0), set(&p, "from", -5e-3, 0, 0);
    *mpm_probe_value(&p, "reach") = 2e-3, *mpm_probe_value(&p, "slower") = 50;
    look(solver, &p, out);
    assert_near(out[0], -1e-3, 1e-12); /* its middle */
    assert_near(out[1], 300, 1e-9);
    assert_near(out[2] / 4, kg, 1e-9 * kg);      /* beside: 4 less 1 that failed; far: 2 less 1 that failed */
    assert_true(isnan(out[3]) && isnan(out[4])); /* nothing is slower than 50 m/s */
    assert_near(out[5] / 8, kg, 1e-9 * kg);
    assert_near(out[6] / 8, kg, 1e-9 * kg);
    assert_near(out[7], 3.0625e-3, 1e-12); /* of its foremost points to the window's end */

    *mpm_probe_value(&p, "slower") = 100; /* what lies beside is */
    look(solver, &p, out);
    assert_near(out[3], 0, 1e-9);
    assert_near(out[4], 0.3e-3, 1e-12);
    assert_near(out[5] / 4, kg, 1e-9 * kg);
    *mpm_probe_value(&p, "reach") =
        0.15e-3; /* four points about the line, which is not that of the other body's middle */
    set(&p, "from", 0, -0.5e-3, -0.5e-3);
    look(solver, &p, out);
    assert_near(out[2], 0.25 * 0.25 * kg, 1e-9 * kg); /* far, z below 0: all of it intact */

    set(&p, "along", -1, 0, 0); /* backwards there is nothing, and all is slower than what flies away */
    look(solver, &p, out);
    assert_near(out[1], -300, 1e-9);
    assert_true(out[2] == 0);
    mpm_free(solver);
}

/* ---- the table ---- */

static void stretched(block *q, int l)
{
    q->rho[0][l] = q->x[0][l] < 0 ? 500 : 999.5;
}

/* Two cubes of 2 mm: water at half of its density has twice the volume, half of it void; water that is 0.05 % thin, and
 * metal, have none. */
static void test_cavitation(void **state)
{
    (void)state;
    mpm_material m = scene_copper();
    m.strength = MPM_STRENGTH_none, m.density = 1000, m.cavitation_pressure = 0;
    mpm *solver = cubes(&m);
    each_point(solver, stretched);
    const mpm_probe all = probe("cavitation", -1), right = probe("cavitation", 1);
    double out[2];
    look(solver, &all, out);
    assert_near(out[0], 16e-9, 1e-18);
    assert_near(out[1], 8e-9, 1e-18);
    look(solver, &right, out);
    assert_near(out[0], 0, 0);
    mpm_free(solver);
    m = scene_copper();
    solver = cubes(&m);
    each_point(solver, stretched);
    look(solver, &all, out);
    assert_near(out[0], 0, 0);
    mpm_free(solver);
}

static void test_table(void **state)
{
    (void)state;
    static const char *const tested[] = { "pressure", "face",    "force",      "motion", "energy", "plastic",
                                          "surface",  "passage", "cavitation", "cavity" /* test_mpm_cavity.c */ };
    int n = 0;
    for (const mpm_probe_kind *k; (k = mpm_probe_kind_at(n)); n++) {
        assert_ptr_equal(mpm_probe_kind_find(k->name), k);
        assert_true(k->doc && k->doc[0] && k->read && k->params && k->columns && k->columns[0].name);
        mpm_probe p = mpm_probe_make(k, "p");
        for (const base_param *q = k->params; q->key; q++) {
            const size_t doubles = q->kind == BASE_PARAM_VECTOR ? 3 : 1;
            assert_true(q->kind == BASE_PARAM_NUMBER || q->kind == BASE_PARAM_VECTOR);
            assert_true(q->offset / sizeof(double) + doubles <= MPM_PROBE_VALUES);
            assert_ptr_equal((char *)mpm_probe_value(&p, q->key), (char *)p.value + q->offset);
        }
        for (const mpm_column *c = k->columns; c->name; c++) assert_true(c->unit && c->unit[0] && c->doc && c->doc[0]);
        const int columns = mpm_probe_columns(&p);
        assert_true(k->mains == 0 || k->mains == 1 || k->mains == 3);
        assert_true((k->mains == 0) == (k->rows != NULL)); /* a map has none */
        assert_true(k->main >= 0 && k->main + k->mains <= columns);
        for (int i = 1; i < k->mains; i++) assert_string_equal(k->columns[k->main + i].unit, k->columns[k->main].unit);
        bool found = false;
        for (size_t i = 0; i < sizeof tested / sizeof tested[0]; i++) found = found || strcmp(tested[i], k->name) == 0;
        if (!found) fail_msg("%s has no closed answer in tests/test_mpm_probe.c", k->name);
    }
    assert_int_equal(n, sizeof tested / sizeof tested[0]);
    assert_null(mpm_probe_kind_at(-1));
    assert_null(mpm_probe_kind_find("oracle"));
}

/* A scene has its probes: by kind, copied, refused where they are wrong or two have one name. */
static void test_scene(void **state)
{
    (void)state;
    const mpm_material m = scene_copper();
    SCENE_LOCAL(s);
    mpm_scene_default(&s);
    for (int k = 0; k < 3; k++) s.axis[k] = scene_axis(-3e-3, 3e-3, 1e-3, MPM_BOUNDARY_FREE, MPM_BOUNDARY_FREE);
    scene_box(&s, -2e-3, -1e-3, -1e-3, 0, 1e-3, 1e-3, &m);
    mpm_probe *p;
    for (int i = 0; i < 3; i++) assert_ok(mpm_scene_add_probe(&s, "force", i == 0 ? "a" : i == 1 ? "b" : "c", &p));
    assert_int_equal(mpm_scene_add_probe(&s, "oracle", "d", &p).code, STATUS_BAD_INPUT);
    mpm *solver = NULL;
    status made = mpm_create(&s, 1, &solver);
    assert_non_null(strstr(made.text, "body -1"));
    for (int i = 0; i < 3; i++) s.probe[i].body = 0;
    solver = scene_make(&s, 1);
    assert_int_equal(mpm_scene_of(solver)->probes, 3);
    assert_string_equal(mpm_scene_of(solver)->probe[2].name, "c");
    assert_true(mpm_scene_of(solver)->probe != s.probe);
    mpm_free(solver);
    strcpy(s.probe[2].name, "a");
    made = mpm_create(&s, 1, &solver);
    assert_non_null(strstr(made.text, "two probes"));
}

static void refused(const mpm_probe *p, const char *word)
{
    const status s = mpm_probe_check(p, 2);
    if (s.code != STATUS_BAD_INPUT || !strstr(s.text, word)) fail_msg("`%s`: %s", word, s.text);
}

static void test_refused(void **state)
{
    (void)state;
    mpm_probe p = probe("force", -1);
    refused(&p, "body -1");
    p.body = 2;
    refused(&p, "body 2");
    p = probe("pressure", 0);
    refused(&p, "pressure.at is required");
    p = probe("face", 0);
    set(&p, "lo", 0, 0, 0), set(&p, "hi", 1, 0, 1);
    refused(&p, "along y");
    p = probe("surface", 0);
    set(&p, "lo", 0, 0, 0), set(&p, "hi", 1, 1, 1), set(&p, "along", 0, 1, 0.5);
    *mpm_probe_value(&p, "cell") = 1;
    refused(&p, "must be an axis");
    set(&p, "along", 0, 1, 0), *mpm_probe_value(&p, "cell") = 1e-4;
    refused(&p, "columns");
    p = probe("passage", 0);
    set(&p, "along", 0, 0, 0), set(&p, "from", 0, 0, 0);
    *mpm_probe_value(&p, "reach") = *mpm_probe_value(&p, "slower") = 1;
    refused(&p, "must be a direction");
}

/* All kinds of all bodies on one thread and on three, after some steps of a gouge. */
static void test_threads(void **state)
{
    (void)state;
    static double out[2][3 * MOST];
    GOUGE_LOCAL(g);
    scene_gouge(&g, 0.3e-3, 1500);
    mpm *solver = scene_make(&g.scene, 2);
    scene_steps(solver, 20);
    for (int i = 0; mpm_probe_kind_at(i); i++)
        for (int body = 0; body < g.scene.bodies; body++) {
            mpm_probe p = probe(mpm_probe_kind_at(i)->name, body);
            double *at = mpm_probe_value(&p, "at"), *lo = mpm_probe_value(&p, "lo"), *hi = mpm_probe_value(&p, "hi");
            if (at) set(&p, "at", 0, 0.1e-3, 0.1e-3);
            if (lo && hi) set(&p, "lo", -2e-3, -1e-3, 0), set(&p, "hi", 2e-3, 2e-3, 2e-3);
            if (mpm_probe_value(&p, "along")) set(&p, "along", 0, 1, 0);
            if (mpm_probe_value(&p, "cell")) *mpm_probe_value(&p, "cell") = 0.1e-3;
            if (mpm_probe_value(&p, "from")) set(&p, "from", 0, 0, 0);
            if (mpm_probe_value(&p, "slower"))
                *mpm_probe_value(&p, "slower") = 200, *mpm_probe_value(&p, "reach") = 1e-3;
            const size_t bytes = (size_t)(mpm_probe_rows(&p) * mpm_probe_columns(&p)) * sizeof(double);
            for (int k = 0; k < 2; k++) {
                mpm_set_threads(solver, 1 + 2 * k);
                look(solver, &p, out[k]);
            }
            assert_memory_equal(out[0], out[1], bytes);
        }
    mpm_free(solver);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_table),   cmocka_unit_test(test_scene),      cmocka_unit_test(test_pressure),
        cmocka_unit_test(test_force),   cmocka_unit_test(test_motion),     cmocka_unit_test(test_failed),
        cmocka_unit_test(test_plastic), cmocka_unit_test(test_profile),    cmocka_unit_test(test_surface),
        cmocka_unit_test(test_passage), cmocka_unit_test(test_passage),    cmocka_unit_test(test_refused),
        cmocka_unit_test(test_threads), cmocka_unit_test(test_cavitation),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
