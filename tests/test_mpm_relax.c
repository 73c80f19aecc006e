/* SPDX-License-Identifier: BSD-3-Clause */
/* (M-7): what heat has made of a point's pressure beyond that of its element, the box between nodes.  Expected values
 * are computed here point by point, from places and domains alone.  Tolerance 1e-13: rounding. */
#include "mpm_scenes.h"

#include "mpm/law/relax_lanes.h"

static const double H = 1e-3; /* a cell [m] */

/* A block of 4 x 4 x 4 cells, on or beside the planes of the grid, and a second body welded on, or not. */
static mpm *blocks(const mpm_material *m, double shift, bool welded)
{
    SCENE_LOCAL(s);
    mpm_scene_default(&s);
    for (int k = 0; k < 3; k++) {
        s.axis[k] = scene_axis(-4 * H, 8 * H, H, MPM_BOUNDARY_FREE, MPM_BOUNDARY_FREE);
        s.grid_shift[k] = shift;
    }
    scene_box(&s, 0, 0, 0, 4 * H, 4 * H, 4 * H, m)->group = 0;
    if (welded) scene_box(&s, 4 * H, 0, 0, 6 * H, 4 * H, 4 * H, m)->group = 0;
    return scene_make(&s, 1);
}

#define EACH_POINT(solver, n, l)                                                             \
    for (int b_ = 0; b_ < (solver)->bricks_used; b_++)                                       \
        for (int c_ = 0; c_ < BRICK_CELLS; c_++)                                             \
            for (int n = (solver)->bricks[b_].head[c_]; n >= 0; n = (solver)->links[n].next) \
                for (int l = 0; l < LANES; l++)                                              \
                    if ((solver)->links[n].mask >> l & 1)

/* Point l of block n gets the density rho0 d, and the energy of a solid or of a melt. */
static void set_point(mpm *solver, int n, int l, double d, double heat)
{
    const law *k = &solver->laws[solver->links[n].body];
    const law_form f = law_form_of(k, k->kernel);
    block *q = &solver->blocks[n];
    const double mu = d - 1, e = reference_energy(k, f, vd_set(mu))[0] + heat;
    q->rho[0][l] = k->rho0 * d, q->e[0][l] = e;
    q->p[0][l] = pressure(k, f, vd_set(mu), vd_set(k->rho0 * d), vd_set(e), vd_set(0))[0];
    q->T[0][l] = temperature(k, vd_set(e), reference_energy(k, f, vd_set(mu)), vd_set(0))[0];
}

static double bulk_modulus(const law *k, double rho, double p)
{
    return rho * wave_speed_square(k, law_form_of(k, k->kernel), vd_set(1 / rho), vd_set(p), vd_set(0))[0];
}

static void relax_bricks(mpm *solver, relax_pass pass, int nth, double time)
{
    for (int i = 0; i < solver->bricks_used; i++) solver->kernel->relax(solver, &solver->bricks[i], pass, nth, time);
}

static void relax_once(mpm *solver, double time)
{
    relax_bricks(solver, RELAX_LOOK, 0, time);
    for (int nth = 0; nth < solver->most_bodies; nth++)
        for (relax_pass pass = RELAX_SUMS; pass <= RELAX_POINTS; pass++) relax_bricks(solver, pass, nth, time);
}

/* Elements of a body by number from the window's first, 16 each way. */
enum { SIDE = 16 };
typedef struct {
    double room, push, loss; /* parts of V/K, V p/K and V/K times what is lost */
} element_sums;

static int element_at(double x, double shift)
{
    return (int)floor(x / H - shift) + SIDE / 2;
}

/* What part of a point's domain lies in each of up to eight elements: `at`, `part`; how many. */
static int parts_of(const block *q, int l, double shift, int at[8], double part[8])
{
    int first[3], n = 0;
    double after[3];
    for (int k = 0; k < 3; k++) {
        const double x = q->x[k][l], half = q->half[k][l];
        first[k] = element_at(x - half + 1e-9 * H, shift);
        after[k] = fmax((x + half) - H * (first[k] + 1 - SIDE / 2 + shift), 0) / (2 * half);
    }
    for (int o = 0; o < 8; o++) {
        double p = 1;
        for (int k = 0; k < 3; k++) p *= o >> k & 1 ? after[k] : 1 - after[k];
        part[n] = p, at[n] = first[0] + (o & 1) + SIDE * (first[1] + (o >> 1 & 1) + SIDE * (first[2] + (o >> 2)));
        if (p > 1e-9) n++;
    }
    return n;
}

/* Pressure of what heat a point has had since the start. */
static double warm_of(const law *k, const block *q, int l)
{
    const law_form f = law_form_of(k, k->kernel);
    const vd mu = vd_set(q->rho[0][l] / k->rho0 - 1), rho = vd_set(q->rho[0][l]);
    const double start = k->e_start - reference_energy(k, f, vd_set(k->rho_start / k->rho0 - 1))[0];
    const double cold = pressure(k, f, mu, rho, reference_energy(k, f, mu) + start, vd_set(0))[0];
    return fmax(q->p[0][l] - cold, 0);
}

/* What it loses in an element of mean pressure P: what its heat makes of what lies beyond, and all beyond 0.1 K. */
static double loss_of(const law *k, const block *q, int l, double P)
{
    const double x = q->p[0][l] - P, bound = RELAX_BOUND * bulk_modulus(k, q->rho[0][l], q->p[0][l]);
    if (x < 0) return fmin(x + bound, 0);
    return fmax(fmin(x, warm_of(k, q, l)), x - bound);
}

static element_sums *elements_of(const mpm *solver, int body, double shift)
{
    element_sums *e = calloc(SIDE * SIDE * SIDE, sizeof *e);
    const law *k = &solver->laws[body];
    for (int pass = 0; pass < 2; pass++) EACH_POINT(solver, n, l)
        {
            if (solver->links[n].body != body) continue;
            int at[8];
            double part[8];
            const block *q = &solver->blocks[n];
            const double room = q->mass[0][l] / q->rho[0][l] / bulk_modulus(k, q->rho[0][l], q->p[0][l]);
            for (int i = parts_of(q, l, shift, at, part) - 1; i >= 0; i--) {
                element_sums *in = &e[at[i]];
                if (pass == 0)
                    in->room += part[i] * room, in->push += part[i] * room * q->p[0][l];
                else
                    in->loss += part[i] * room * loss_of(k, q, l, in->push / in->room);
            }
        }
    return e;
}

/* Every point's volume and energy change by (M-7), pressure and temperature follow, and the sums of both stay. */
static void test_relaxes(void **state)
{
    (void)state;
    const mpm_material m = scene_copper();
    static const double shifts[] = { 0, 0.25, 0.6 };
    for (int i = 0; i < 3; i++)
        for (int welded = 0; welded < 2; welded++) {
            mpm *solver = blocks(&m, shifts[i], welded), *was = blocks(&m, shifts[i], welded);
            EACH_POINT(solver, n, l)
            {
                const double d = scene_random(0.98, 1.05), heat = scene_random(0, 5e4);
                set_point(solver, n, l, d, heat), set_point(was, n, l, d, heat);
            }
            const double time = 2 * H / solver->laws[0].sound, share = 1 - exp(-2 * RELAX_RATE);
            relax_once(solver, time);
            double volume = 0, energy = 0, before_volume = 0, before_energy = 0;
            for (int body = 0; body <= welded; body++) {
                const law *k = &solver->laws[body];
                const law_form f = law_form_of(k, k->kernel);
                element_sums *e = elements_of(was, body, shifts[i]);
                EACH_POINT(solver, n, l)
                {
                    if (solver->links[n].body != body) continue;
                    const block *q = &solver->blocks[n], *p = &was->blocks[n];
                    const double mass = p->mass[0][l], V = mass / p->rho[0][l];
                    int at[8];
                    double part[8], dV = 0, dE = 0;
                    for (int j = parts_of(p, l, shifts[i], at, part) - 1; j >= 0; j--) {
                        const element_sums *in = &e[at[j]];
                        const double P = in->push / in->room, lost = loss_of(k, p, l, P) - in->loss / in->room;
                        const double d = share * part[j] * lost * V / bulk_modulus(k, p->rho[0][l], p->p[0][l]);
                        dV += d, dE -= P * d;
                    }
                    assert_near((mass / q->rho[0][l] - V - dV) / V, 0, 1e-13);
                    assert_near((mass * (q->e[0][l] - p->e[0][l]) - dE) / (mass * 1e5), 0, 1e-12);
                    const vd mu = vd_set(q->rho[0][l] / k->rho0 - 1), en = vd_set(q->e[0][l]);
                    assert_near(q->p[0][l], pressure(k, f, mu, vd_set(q->rho[0][l]), en, vd_set(0))[0], 1e-13 * k->K0);
                    assert_near(q->T[0][l], temperature(k, en, reference_energy(k, f, mu), vd_set(0))[0], 1e-9);
                    volume += mass / q->rho[0][l], before_volume += V;
                    energy += mass * q->e[0][l], before_energy += mass * p->e[0][l];
                }
                free(e);
            }
            assert_near(volume / before_volume, 1, 1e-13);
            assert_near(energy / before_energy, 1, 1e-12);
            mpm_free(solver), mpm_free(was);
        }
}

/* Cold points whose pressures lie within the bound are left alone.  Heated ones come to one pressure an element. */
static void test_ends_even(void **state)
{
    (void)state;
    const mpm_material m = scene_copper();
    mpm *solver = blocks(&m, 0, false), *was = blocks(&m, 0, false);
    EACH_POINT(solver, n, l)
    {
        const double d = scene_random(1, 1.02);
        set_point(solver, n, l, d, 0), set_point(was, n, l, d, 0);
    }
    relax_once(solver, H / solver->laws[0].sound);
    EACH_POINT(solver, n, l) assert_true(solver->blocks[n].rho[0][l] == was->blocks[n].rho[0][l]);
    mpm_free(was);
    EACH_POINT(solver, n, l) set_point(solver, n, l, scene_random(1, 1.001), scene_random(2e4, 4e4));
    for (int i = 0; i < 1000; i++) relax_once(solver, H / solver->laws[0].sound);
    element_sums *e = elements_of(solver, 0, 0);
    EACH_POINT(solver, n, l)
    {
        int at[8];
        double part[8];
        assert_int_equal(parts_of(&solver->blocks[n], l, 0, at, part), 1);
        assert_near(solver->blocks[n].p[0][l], e[at[0]].push / e[at[0]].room, 1e-6 * m.youngs_modulus);
    }
    free(e);
    mpm_free(solver);
}

/* Dust without pressure is left to the last bit, and so are its neighbours for its sake; points of some hundred
 * gigapascals beside soft ones change their volumes by RELAX_MOST at most. */
static void test_dust(void **state)
{
    (void)state;
    const mpm_material m = scene_copper();
    mpm *solver = blocks(&m, 0.25, false), *was = blocks(&m, 0.25, false);
    int i = 0;
    EACH_POINT(solver, n, l)
    {
        const bool dust = i % 16 == 0, dense = i % 32 != 1;
        i++;
        for (int k = 0; k < 2; k++) {
            mpm *s = k ? was : solver;
            set_point(s, n, l, dust ? 0.3 : dense ? 1.9 : 1.001, dense ? 4e6 : 0);
            if (dust) s->blocks[n].damage[0][l] = 1, s->blocks[n].p[0][l] = 0;
        }
    }
    relax_once(solver, 10 * H / solver->laws[0].sound);
    double most = 0;
    EACH_POINT(solver, n, l)
    {
        const block *q = &solver->blocks[n], *p = &was->blocks[n];
        if (p->damage[0][l] == 1) assert_true(q->rho[0][l] == p->rho[0][l] && q->e[0][l] == p->e[0][l]);
        most = fmax(most, fabs(p->rho[0][l] / q->rho[0][l] - 1));
    }
    print_message("largest change of a volume: %.3f\n", most);
    assert_true(most > 0.02 && most <= RELAX_MOST); /* 0.75 without that bound */
    mpm_free(solver), mpm_free(was);
}

/* In the solver's own steps: one point of a block in motion has half as much again of density.  It comes down as fast
 * as sound crosses some elements, and the books close. */
static void test_in_steps(void **state)
{
    (void)state;
    const mpm_material m = scene_hydro();
    SCENE_LOCAL(s);
    mpm_scene_default(&s);
    for (int k = 0; k < 3; k++) s.axis[k] = scene_axis(0, 10e-3, 0.5e-3, MPM_BOUNDARY_FREE, MPM_BOUNDARY_FREE);
    scene_box(&s, 2e-3, 2e-3, 2e-3, 8e-3, 8e-3, 8e-3, &m)->velocity[0] = 100;
    mpm *solver = scene_make(&s, 1);
    int n = -1, l = 0;
    for (int i = 0; n < 0 && i < solver->bricks_used; i++)
        if (solver->bricks[i].particles == (int)(BRICK_CELLS * 8)) n = solver->bricks[i].head[21];
    assert_true(n >= 0 && solver->blocks[n].mass[0][l] > 0);
    solver->blocks[n].rho[0][l] *= 1.5;
    const mpm_ledger before = mpm_balance(solver);
    scene_steps(solver, 80);
    const mpm_ledger after = mpm_balance(solver);
    double *density = scene_read(solver, MPM_density), densest = 0;
    for (size_t i = 0; i < mpm_points(solver); i++) densest = fmax(densest, density[i]);
    free(density);
    print_message("densest point after 80 steps: %.3f of the density at rest\n", densest / m.density);
    assert_true(densest < 1.3 * m.density);
    const double gain = after.kinetic + after.internal - after.work_ahead - before.kinetic - before.internal;
    assert_near(gain / before.kinetic, 0, 1e-11); /* rounding */
    mpm_free(solver);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_in_steps),
        cmocka_unit_test(test_relaxes),
        cmocka_unit_test(test_ends_even),
        cmocka_unit_test(test_dust),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
