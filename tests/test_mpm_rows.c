/* SPDX-License-Identifier: BSD-3-Clause */
/* Rows of points by a face, an end, a load, a film, a cavity and a seam carry what a plane wave of sound leaves there,
 * wherever the planes of the grid lie.  Every point by the face is looked at, never a mean: a node just beyond a face
 * holds next to no mass, and if it flies, one row carries nothing and the next one twice the stress while their mean
 * stays right.
 *
 * Bars of one cell across between mirrors, elastic, with waves so weak that the answer is linear:
 *   sigma = rho c u,   u the change of velocity                                                          (1)
 * Each state is read behind its front and before anything comes back from another end. */
#include "mpm_scenes.h"

static const double H = 0.1e-3; /* a cell [m] */
static const double SHIFTS[] = { 0, 0.1, 0.25, 0.5, 0.75, 0.9 };
enum { N_SHIFTS = sizeof SHIFTS / sizeof SHIFTS[0] };

/* What a row may differ by from (1).  GIMP stays within 0.6 %, which is what a front leaves behind it.  A B-spline has
 * a part of its cell beyond a mirror, which makes 1.9 %. */
static const double GIMP = 0.01, SPLINE = 0.03;

/* A grid of the six, with so many points an axis and that basis. */
typedef struct {
    int shift, points;
    mpm_basis_kind basis;
} grid_kind;

/* The first are GIMP with two points, then with three, then the B-spline with two. */
enum { GIMP_KINDS = 2 * N_SHIFTS, KINDS = 3 * N_SHIFTS };

static grid_kind kind_of(int i)
{
    return (grid_kind){ i % N_SHIFTS, i / N_SHIFTS == 1 ? 3 : 2,
                        i / N_SHIFTS == 2 ? MPM_BASIS_BSPLINE : MPM_BASIS_GIMP };
}

/* Of every kind what its rows differ by at most [1]; below 0: not tried. */
typedef struct {
    double worst[KINDS];
} table;

static table no_table(void)
{
    table t;
    for (int i = 0; i < KINDS; i++) t.worst[i] = -1;
    return t;
}

/* Prints all before it says which fails. */
static void check_table(const char *what, const table *t, double gimp, double spline)
{
    for (int i = 0; i < KINDS; i++) {
        const grid_kind g = kind_of(i);
        if (g.shift == 0 && t->worst[i + 1] >= 0)
            print_message("%-30s %d points, %-8s", what, g.points, mpm_basis_names[g.basis]);
        if (t->worst[i] >= 0) print_message("%7.2f", 100 * t->worst[i]);
        if (g.shift == N_SHIFTS - 1 && t->worst[i] >= 0) print_message(" %%\n");
    }
    for (int i = 0; i < KINDS; i++) {
        const grid_kind g = kind_of(i);
        const double limit = g.basis == MPM_BASIS_GIMP ? gimp : spline;
        if (!(t->worst[i] <= limit))
            fail_msg("%s, shift %g, %d points, %s: %.3g %%, must be within %.3g %%", what, SHIFTS[g.shift], g.points,
                     mpm_basis_names[g.basis], 100 * t->worst[i], 100 * limit);
    }
}

static void bar(mpm_scene *s, double lo, double hi, const grid_kind *g)
{
    scene_bar(s, lo, hi, H, 1);
    s->grid_shift[0] = SHIFTS[g->shift];
    s->particles_per_axis = g->points, s->basis = g->basis;
    s->contact = mpm_contact_of(mpm_contact_find("frictionless"));
}

static mpm_body *piece(mpm_scene *s, double lo, double hi, int group, double velocity, const mpm_material *m)
{
    mpm_body *b = scene_box(s, lo, -1, -1, hi, 1, 1, m);
    b->group = group, b->velocity[0] = velocity;
    return b;
}

static double impedance(const mpm_material *m)
{
    return m->density * mpm_material_longitudinal_speed(m);
}

/* Time in which sound goes this way. */
static double sound_time(const mpm_material *m, double way)
{
    return way / mpm_material_longitudinal_speed(m);
}

/* Largest difference of the pressure along x from `want`, of any point between two places. */
static double worst_row(const mpm *m, double lo, double hi, double want)
{
    double *x = scene_read(m, MPM_position), *s = scene_read(m, MPM_stress), worst = 0;
    int n = 0;
    for (size_t i = 0; i < mpm_points(m); i++)
        if (x[3 * i] > lo && x[3 * i] < hi) worst = fmax(worst, fabs(-s[6 * i] - want)), n++;
    free(x), free(s);
    assert_true(n >= 8);
    return worst;
}

/* The same of the velocity. */
static double worst_velocity(const mpm *m, double lo, double hi, double want)
{
    double *x = scene_read(m, MPM_position), *v = scene_read(m, MPM_velocity), worst = 0;
    for (size_t i = 0; i < mpm_points(m); i++)
        if (x[3 * i] > lo && x[3 * i] < hi) worst = fmax(worst, fabs(v[3 * i] - want));
    free(x), free(v);
    return worst;
}

static mpm *made_and_run(const mpm_scene *s, double until)
{
    mpm *m = scene_make(s, 1);
    assert_ok(mpm_advance(m, until, NULL));
    return m;
}

/* ---- faces ---- */

/* A wave that a flying half sends meets a free face: no stress is left there, and the face moves with twice u. */
static void test_free_face(void **state)
{
    (void)state;
    const mpm_material m = scene_elastic();
    const double u = 1, left = 3e-3, right = 1.5e-3, deep = right - 8 * H;
    table stress = no_table(), velocity = no_table();
    for (int i = 0; i < KINDS; i++) {
        const grid_kind g = kind_of(i);
        SCENE_LOCAL(s);
        bar(&s, -left, right + 5 * H, &g);
        piece(&s, -left, 0, 0, 2 * u, &m);
        piece(&s, 0, right, 0, 0, &m);
        mpm *solver = made_and_run(&s, sound_time(&m, right + 2.2e-3));
        stress.worst[i] = worst_row(solver, deep, right + H, 0) / (impedance(&m) * u);
        velocity.worst[i] = worst_velocity(solver, deep, right + H, 2 * u) / (2 * u);
        mpm_free(solver);
    }
    check_table("free face, stress", &stress, GIMP, SPLINE);
    check_table("free face, velocity", &velocity, GIMP, SPLINE);
}

/* ---- ends ---- */

/* A body that flies with `velocity` and begins `gap` away from the lower end of kind `end`, which has `wall`.  It has
 * touched the end while sound goes 2.4 mm at least. */
static double by_end(mpm_boundary_kind end, const grid_kind *g, double gap, double velocity, double wall)
{
    const mpm_material m = scene_elastic();
    const double want = (end == MPM_BOUNDARY_ABSORBING ? 0.5 : 1) * impedance(&m) * (wall - velocity);
    const double way = 2.4e-3, length = gap > 0 ? 4e-3 : 3e-3, touch = gap > 0 ? gap / -velocity : 0;
    SCENE_LOCAL(s);
    bar(&s, 0, gap + length + 5 * H, g);
    s.axis[0].boundary[0] = end, s.axis[0].boundary_velocity[0][0] = wall;
    piece(&s, gap, gap + length, 0, velocity, &m);
    mpm *solver = made_and_run(&s, touch + sound_time(&m, way));
    const double worst = worst_row(solver, 0, 8 * H, want) / fabs(want);
    mpm_free(solver);
    return worst;
}

/* It begins at the end that holds it, or that moves away with it: a prescribed end stays where it is, so a body that it
 * pushes leaves it, here by a thousandth of a cell.  With the B-spline only a mirror reaches (1). */
static void test_beside_an_end(void **state)
{
    (void)state;
    table mirror = no_table(), fixed = no_table(), pulled = no_table(), pushed = no_table(), left = no_table();
    for (int i = 0; i < KINDS; i++) {
        const grid_kind g = kind_of(i);
        mirror.worst[i] = by_end(MPM_BOUNDARY_SYMMETRY, &g, 0, -1, 0);
        if (i >= GIMP_KINDS) continue;
        fixed.worst[i] = by_end(MPM_BOUNDARY_FIXED, &g, 0, -1, 0);
        if (g.points > 2) continue;
        pulled.worst[i] = by_end(MPM_BOUNDARY_PRESCRIBED, &g, 0, 0, -1);
        pushed.worst[i] = by_end(MPM_BOUNDARY_PRESCRIBED, &g, 0, 0, 0.1);
        left.worst[i] = by_end(MPM_BOUNDARY_ABSORBING, &g, 0, 0.2, 0);
    }
    check_table("on a mirror", &mirror, GIMP, SPLINE);
    check_table("on a fixed end", &fixed, GIMP, 0);
    check_table("pulled by a prescribed end", &pulled, GIMP, 0);
    check_table("pushed by a prescribed end", &pushed, GIMP, 0);
    check_table("leaves an absorbing end", &left, GIMP, 0);
}

/* It comes to the end.  A gap of two hundredths of a cell counts as closed, so the first cell is that much less full
 * and carries 2 % more. */
static void test_comes_to_an_end(void **state)
{
    (void)state;
    table mirror = no_table(), fixed = no_table();
    for (int i = 0; i < GIMP_KINDS; i++) {
        const grid_kind g = kind_of(i);
        mirror.worst[i] = by_end(MPM_BOUNDARY_SYMMETRY, &g, 0.1 * H, -6, 0);
        if (g.points == 2) fixed.worst[i] = by_end(MPM_BOUNDARY_FIXED, &g, 0.1 * H, -6, 0);
    }
    check_table("comes to a mirror", &mirror, 0.03, 0);
    check_table("comes to a fixed end", &fixed, 0.03, 0);
}

/* Under an even pressure from the start nothing moves between ends that hold it up: to rounding with GIMP. */
static void test_rests_under_pressure(void **state)
{
    (void)state;
    static const double P = 1e8, ROUNDING = 1e-9;
    static const mpm_boundary_kind ENDS[] = { MPM_BOUNDARY_SYMMETRY, MPM_BOUNDARY_FIXED, MPM_BOUNDARY_ABSORBING };
    static const char *const WHAT[] = { "rests between mirrors", "rests between fixed ends",
                                        "rests between absorbing ends" };
    const mpm_material m = scene_elastic();
    for (int e = 0; e < 3; e++) {
        table rest = no_table();
        for (int i = 0; i < (e > 0 ? GIMP_KINDS : KINDS); i++) {
            const grid_kind g = kind_of(i);
            SCENE_LOCAL(s);
            bar(&s, 0, 15 * H, &g);
            s.axis[0].boundary[0] = s.axis[0].boundary[1] = ENDS[e];
            piece(&s, 0, 15 * H, 0, 0, &m)->pressure = P;
            mpm *solver = made_and_run(&s, sound_time(&m, 6e-3));
            rest.worst[i] = worst_row(solver, 0, 1, P) / P;
            mpm_free(solver);
        }
        check_table(WHAT[e], &rest, ROUNDING, SPLINE);
    }
}

/* ---- loads ---- */

/* A pressure acts at once on the lower face of a body, and its wave has not yet come to the other side: a traction on a
 * solid, or a wave that enters water, which goes on moving its face. */
static double by_load(const grid_kind *g, double pressure, bool wave)
{
    const mpm_material m = wave ? scene_water() : scene_elastic();
    const double way = 2.4e-3;
    SCENE_LOCAL(s);
    bar(&s, -5 * H, 3e-3, g);
    mpm_body *b = piece(&s, 0, 3e-3, 0, 0, &m);
    b->traction_face = 0; /* -x */
    if (wave)
        b->wave_pressure = pressure;
    else
        b->traction[0] = pressure;
    mpm *solver = made_and_run(&s, way / (wave ? WATER_C0 : mpm_material_longitudinal_speed(&m)));
    const double worst = worst_row(solver, -H, 8 * H, pressure) / fabs(pressure);
    mpm_free(solver);
    return worst;
}

/* A traction that presses, and one that pulls; a wave. */
static void test_loads(void **state)
{
    (void)state;
    table pressed = no_table(), pulled = no_table(), wave = no_table();
    for (int i = 0; i < GIMP_KINDS; i++) {
        const grid_kind g = kind_of(i);
        pressed.worst[i] = by_load(&g, 1e7, false);
        pulled.worst[i] = by_load(&g, -1e7, false);
        wave.worst[i] = by_load(&g, 1e5, true);
    }
    check_table("pressed by a traction", &pressed, GIMP, 0);
    check_table("pulled by a traction", &pulled, GIMP, 0);
    check_table("a wave enters water", &wave, GIMP, 0);
}

/* A traction presses a body against an absorbing end: nothing comes back from there, and the end holds against it.  The
 * loaded face lies beside the planes: on one of them rounding leaves the node beyond it some mass in the first step. */
static void test_pressed_on_an_absorbing_end(void **state)
{
    (void)state;
    static const double P = 1e7;
    const mpm_material m = scene_elastic();
    table end = no_table();
    for (int i = 0; i < GIMP_KINDS; i++) {
        const grid_kind g = kind_of(i);
        SCENE_LOCAL(s);
        bar(&s, 0, 25 * H, &g);
        s.axis[0].boundary[0] = MPM_BOUNDARY_ABSORBING;
        mpm_body *b = piece(&s, 0, 20.05 * H, 0, 0, &m);
        b->traction[0] = -P, b->traction_face = 1; /* +x */
        mpm *solver = made_and_run(&s, sound_time(&m, 60 * H));
        end.worst[i] = worst_row(solver, 0, 25 * H, P) / P;
        mpm_free(solver);
    }
    check_table("pressed on an absorbing end", &end, GIMP, 0);
}

/* ---- films ---- */

/* A block flies at a film of `cells` on a base.  The film is welded to the base, or a group of its own. */
static double with_film(const grid_kind *g, int cells, bool welded)
{
    const mpm_material m = scene_elastic();
    const double u = 1, base = 2e-3, film = cells * H, block = 2e-3, want = impedance(&m) * u;
    SCENE_LOCAL(s);
    bar(&s, -base, film + block + 5 * H, g);
    piece(&s, -base, 0, 0, 0, &m);
    piece(&s, 0, film, welded ? 0 : 1, 0, &m);
    piece(&s, film, film + block, welded ? 1 : 2, -2 * u, &m);
    mpm *solver = made_and_run(&s, sound_time(&m, 2.5e-3));
    const double worst = worst_row(solver, -8 * H, film + 8 * H, want) / want;
    mpm_free(solver);
    return worst;
}

/* Not one of its own that is thinner than two cells, and not with faces on planes of the grid: a front that comes to
 * such a face may leave a difference in its first cell. */
static void test_films(void **state)
{
    (void)state;
    for (int cells = 1; cells <= 3; cells++) {
        table welded = no_table(), own = no_table();
        for (int i = 0; i < GIMP_KINDS; i++) {
            const grid_kind g = kind_of(i);
            if (SHIFTS[g.shift] == 0 || (g.points > 2 && cells != 2)) continue;
            welded.worst[i] = with_film(&g, cells, true);
            if (cells >= 2) own.worst[i] = with_film(&g, cells, false);
        }
        print_message("%d cells:\n", cells);
        check_table("welded film", &welded, GIMP, 0);
        check_table("film of its own", &own, GIMP, 0);
    }
}

/* ---- cavities ---- */

/* Gas of 10 MPa that is there at once between two blocks, whose faces move by some thousandths of a cell.  Not with a
 * face on a plane of the grid: there rounding leaves the node beyond it some mass in the first step. */
static void test_cavity(void **state)
{
    (void)state;
    static const double P = 1e7;
    const mpm_material m = scene_elastic();
    const double gap = 5 * H, block = 2e-3;
    table faces = no_table();
    for (int i = 0; i < KINDS; i++) {
        const grid_kind g = kind_of(i);
        if (SHIFTS[g.shift] == 0) continue;
        SCENE_LOCAL(s);
        bar(&s, -block, gap + block, &g);
        for (int end = 0; end < 2; end++) s.axis[0].boundary[end] = MPM_BOUNDARY_ABSORBING;
        piece(&s, -block, 0, 0, 0, &m);
        piece(&s, gap, gap + block, 1, 0, &m);
        mpm_cavity *c;
        assert_ok(mpm_scene_add_cavity(&s, "gas", &c));
        c->place[0] = 0.5 * gap, c->place[1] = c->place[2] = 0.5 * H;
        c->pressure = P, c->temperature = 3000;
        mpm *solver = made_and_run(&s, sound_time(&m, block));
        const double p = mpm_cavity_of(solver, 0)->pressure;
        assert_near(p / P, 1, 0.01);
        faces.worst[i] =
            fmax(worst_row(solver, -6 * H, 0.5 * gap, p), worst_row(solver, 0.5 * gap, gap + 6 * H, p)) / p;
        mpm_free(solver);
    }
    check_table("by a cavity", &faces, GIMP, SPLINE);
}

/* ---- seams ---- */

/* A bar with fine cells from 2 to 3 mm of `length`: of two levels, or graded on one. */
static void seams(mpm_scene *s, double length, int levels, const grid_kind *g, const mpm_material *m)
{
    bar(s, 0, length, g);
    s->axis[0] = scene_graded(s->axis[0], 2e-3, 3e-3, levels > 1 ? 2 * H : 4 * H, 1.3);
    for (int k = 1; k < 3 && levels > 1; k++)
        s->axis[k] =
            scene_graded(scene_axis(0, 4 * H, H, MPM_BOUNDARY_SYMMETRY, MPM_BOUNDARY_SYMMETRY), 0, 4 * H, 2 * H, 1.3);
    s->levels = levels;
    piece(s, 0, length, 0, 0, m);
}

/* An even pressure stays what it is, to rounding; a wave that has crossed leaves up to 1 % in the rows by a seam. */
static void test_seams(void **state)
{
    (void)state;
    static const double P = 1e8, U = 0.1, ROUNDING = 1e-9, CROSSED = 0.02;
    const mpm_material m = scene_elastic();
    for (int levels = 1; levels <= 2; levels++) {
        table rest = no_table(), wave = no_table();
        for (int i = 0; i < N_SHIFTS; i++) {
            const grid_kind g = kind_of(i);
            SCENE_LOCAL(s);
            seams(&s, 5e-3, levels, &g, &m);
            s.axis[0].boundary[0] = s.axis[0].boundary[1] = MPM_BOUNDARY_SYMMETRY;
            s.body[0].pressure = P;
            mpm *solver = made_and_run(&s, sound_time(&m, 2e-3));
            rest.worst[i] = worst_row(solver, 0, 1, P) / P;
            mpm_free(solver);
            seams(&s, 7e-3, levels, &g, &m);
            s.axis[0].boundary[0] = MPM_BOUNDARY_PRESCRIBED, s.axis[0].boundary_velocity[0][0] = U;
            solver = made_and_run(&s, sound_time(&m, 6.5e-3));
            wave.worst[i] = worst_row(solver, 1e-3, 4e-3, impedance(&m) * U) / (impedance(&m) * U);
            mpm_free(solver);
        }
        check_table(levels > 1 ? "seams of levels, at rest" : "graded cells, at rest", &rest, ROUNDING, 0);
        check_table(levels > 1 ? "seams of levels, after a wave" : "graded cells, after a wave", &wave, CROSSED, 0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_free_face),
        cmocka_unit_test(test_beside_an_end),
        cmocka_unit_test(test_comes_to_an_end),
        cmocka_unit_test(test_rests_under_pressure),
        cmocka_unit_test(test_films),
        cmocka_unit_test(test_cavity),
        cmocka_unit_test(test_seams),
        cmocka_unit_test(test_loads),
        cmocka_unit_test(test_pressed_on_an_absorbing_end),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
