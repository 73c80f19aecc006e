/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/life/crack.h"

#include "base/constants.h"
#include "mpm/rest.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double KEPT = 1e-3;     /* of the stiffness of a direction that opens: no point comes loose */
static const double RESIDUAL = 1e-6; /* of the load: far below the error of the cells */
static const double TURNS = 1e-5;    /* of the peak's strain: within that a cut neither opens nor closes */
enum { MOST_ITERATIONS = 2000, MOST_TURNS = 12, SAMPLES = 32 };

typedef struct {
    const life_crack_how *c;
    life_crack *out;
    int nx, nz;
    double h, left;       /* cell; the first node's x [m] */
    double unit;          /* strain of the peak pressure, p0 / E [1] */
    double bond, rest[2]; /* b; what of lambda and of G is beside [Pa] */
    rest_elastic solid;   /* intact */
    mpm_rest *body;
    fatigue_points points;
    double *lost;        /* cells: index with which the rest was last reduced */
    unsigned char *open; /* cells x (directions + 1): a cut that opens; last: the cell is in tension as a whole */
    /* On the face, at 2 nx + 1 places: node, middle of a cell, node, ... */
    double *pressure, *traction; /* [Pa] */
    double *along;               /* strain along the face: what the closed field has more than the grid */
} crack;

static int point_of(const crack *k, int i, int j)
{
    return k->c->how.cycle == LIFE_PASSAGE ? j : j * k->nx + i;
}

static unsigned char *open_of(const crack *k, int i, int j)
{
    return k->open + ((size_t)j * (size_t)k->nx + (size_t)i) * (size_t)(k->points.fan.n + 1);
}

static double middle(const crack *k, int i)
{
    return k->left + (i + 0.5) * k->h;
}

/* ---- elasticity ---- */

static void subtract(rest_elastic *c, double by, double xx, double zz, double xz)
{
    c->xx -= by * xx * xx, c->zz -= by * zz * zz, c->shear -= by * xz * xz;
    c->xx_zz -= by * xx * zz, c->xx_shear -= by * xx * xz, c->zz_shear -= by * zz * xz;
}

/* (L-6) of a cell, with the cuts that open in it. */
static rest_elastic elastic_of(const crack *k, int i, int j)
{
    const fatigue_fan *fan = &k->points.fan;
    const unsigned char *open = open_of(k, i, j);
    rest_elastic c = k->solid;
    for (int d = 0; d < fan->n; d++) {
        const double x = fan->cosine[d], z = fan->sine[d];
        if (open[d]) subtract(&c, (1.0 - KEPT) * 8.0 * k->bond * fan->stiffness[d], x * x, z * z, x * z);
    }
    if (!open[fan->n]) return c;
    const double lost = (1.0 - KEPT) * k->points.index[point_of(k, i, j)];
    subtract(&c, lost * k->rest[0], 1.0, 1.0, 0.0);
    c.xx -= 2.0 * lost * k->rest[1], c.zz -= 2.0 * lost * k->rest[1], c.shear -= lost * k->rest[1];
    return c;
}

/* ---- strain ---- */

/* Along the face, by the grid alone, at one of its places. */
static double along_face(const crack *k, int place)
{
    const int cell = place / 2;
    if (place % 2) return mpm_rest_face_strain(k->body, cell);
    return 0.5 * (mpm_rest_face_strain(k->body, cell - 1) + mpm_rest_face_strain(k->body, cell));
}

/* Of a cell at a place of the face, its middle or an end.  The strain along the face is the grid's, with what the grid
 * missed in the intact rail; the others are what pressure and traction leave. */
static void face_strain(const crack *k, int cell, int place, double strain[3])
{
    const rest_elastic c = elastic_of(k, cell, 0);
    strain[0] = along_face(k, place) + k->along[place];
    const double zz = -k->pressure[place] - c.xx_zz * strain[0], xz = -k->traction[place] - c.xx_shear * strain[0];
    const double determinant = c.zz * c.shear - c.zz_shear * c.zz_shear;
    strain[1] = (c.shear * zz - c.zz_shear * xz) / determinant;
    strain[2] = (c.zz * xz - c.zz_shear * zz) / determinant;
}

/* Strains of a cell: in its middle; on the face, where they change most from cell to cell, at its ends too. */
static void take_cell(const crack *k, int i, int j, fatigue_extremes *of)
{
    const life_first_how *how = &k->c->how;
    const fatigue_fan *fan = &k->points.fan;
    double strain[3];
    if (j > 0) {
        mpm_rest_strain(k->body, i, j, strain);
        mpm_fatigue_take(fan, how->measure, how->poisson, strain, of);
        return;
    }
    for (int place = i > 0 ? 2 * i : 1; place <= 2 * i + 2 && place < 2 * k->nx; place++) {
        face_strain(k, i, place, strain);
        mpm_fatigue_take(fan, how->measure, how->poisson, strain, of);
    }
}

static void set_point(crack *k, int point, const fatigue_extremes *of)
{
    const fatigue_measure measure = k->c->how.measure;
    for (int d = 0; d < k->points.fan.n; d++)
        mpm_fatigue_set_range(&k->points, point, d, mpm_fatigue_range(measure, of->least[d], of->largest[d]));
}

/* A pulse takes a cell from no load to its strain and back, a passage from end to end of its row. */
static void set_ranges(crack *k)
{
    const bool passage = k->c->how.cycle == LIFE_PASSAGE;
#pragma omp parallel for schedule(static) num_threads(k->c->threads)
    for (int j = 0; j < k->nz; j++) {
        fatigue_extremes of = { { 0.0 }, { 0.0 } };
        for (int i = 0; i < k->nx; i++) {
            if (!passage) of = (fatigue_extremes){ { 0.0 }, { 0.0 } };
            take_cell(k, i, j, &of);
            if (!passage) set_point(k, j * k->nx + i, &of);
        }
        if (passage) set_point(k, j, &of);
    }
}

/* ---- equilibrium ---- */

static bool turns(unsigned char *open, double strain, double tolerance)
{
    if (fabs(strain) <= tolerance || *open == (strain > 0.0)) return false;
    *open = strain > 0.0;
    return true;
}

/* Opens and closes the cuts of a cell by its strain; did one turn? */
static bool turn_cell(crack *k, int i, int j)
{
    const fatigue_fan *fan = &k->points.fan;
    const size_t point = (size_t)point_of(k, i, j);
    unsigned char *open = open_of(k, i, j);
    double strain[3];
    bool turned = false;
    if (k->points.index[point] == 0.0) return false;
    mpm_rest_strain(k->body, i, j, strain);
    for (int d = 0; d < fan->n; d++)
        if (k->points.is_cut[point * (size_t)fan->n + (size_t)d])
            turned |= turns(&open[d], mpm_fatigue_strain(fan, d, FATIGUE_BOND, 0.0, strain), TURNS * k->unit);
    if (k->rest[0] + k->rest[1] == 0.0) return turned;
    double *lost = &k->lost[(size_t)j * (size_t)k->nx + (size_t)i];
    turned |= turns(&open[fan->n], strain[0] + strain[1], TURNS * k->unit);
    turned |= open[fan->n] && *lost != k->points.index[point];
    *lost = k->points.index[point];
    return turned;
}

static status turn_cells(crack *k, int *turned)
{
    *turned = 0;
    for (int j = 0; j < k->nz; j++)
        for (int i = 0; i < k->nx; i++) {
            if (!turn_cell(k, i, j)) continue;
            const rest_elastic c = elastic_of(k, i, j);
            TRY(mpm_rest_change(k->body, i, j, &c));
            ++*turned;
        }
    return status_ok();
}

static status solve(crack *k)
{
    k->out->solves++;
    return mpm_rest_solve(k->body, RESIDUAL, MOST_ITERATIONS, &k->out->iterations);
}

/* The strain with all cuts that open open and all others closed.  Where no cut turns the last strain holds. */
static status settle(crack *k, bool *changed)
{
    int turned = 0;
    *changed = false;
    for (int n = 0; n < MOST_TURNS; n++) {
        TRY(turn_cells(k, &turned));
        if (turned == 0) return status_ok();
        TRY(solve(k));
        *changed = true;
    }
    k->out->unsettled++;
    return status_ok();
}

/* ---- the intact rail ---- */

/* Displacements of the half space at all nodes, forces on those of the face. */
static void load_body(crack *k)
{
    const contact_load *l = k->c->load;
    double *u = mpm_rest_displacement(k->body), *force = mpm_rest_forces(k->body);
#pragma omp parallel for schedule(static) num_threads(k->c->threads)
    for (int j = 0; j <= k->nz; j++)
        for (int i = 0; i <= k->nx; i++)
            life_contact_displacement(l, k->left + i * k->h, j * k->h, k->c->how.youngs, k->c->how.poisson,
                                      u + 2 * ((size_t)j * (size_t)(k->nx + 1) + (size_t)i));
    for (int i = 0; i < k->nx; i++) {
        for (int s = 0; s < SAMPLES; s++) {
            const double t = (s + 0.5) / SAMPLES, x = k->left + (i + t) * k->h, part = k->h / SAMPLES;
            const double p = life_contact_pressure(l, x), q = life_contact_traction(l, x);
            force[2 * i] += part * (1.0 - t) * q, force[2 * i + 2] += part * t * q;
            force[2 * i + 1] += part * (1.0 - t) * p, force[2 * i + 3] += part * t * p;
        }
    }
    for (int s = 0; s <= 2 * k->nx; s++) {
        const double x = k->left + 0.5 * s * k->h;
        k->pressure[s] = life_contact_pressure(l, x);
        k->traction[s] = life_contact_traction(l, x);
    }
}

static void stress_of(const rest_elastic *c, const double e[3], double stress[3])
{
    stress[0] = c->xx * e[0] + c->xx_zz * e[1];
    stress[1] = c->xx_zz * e[0] + c->zz * e[1];
    stress[2] = c->shear * e[2];
}

/* How far the grid is off the closed field of the half space: on the face, whose edges no cell resolves. */
static void compare_face(crack *k)
{
    const contact_load *l = k->c->load;
    double most = 0.0, off = 0.0;
    for (int s = 1; s < 2 * k->nx; s++) {
        const double x = k->left + 0.5 * s * k->h;
        double stress[3], strain[3];
        life_contact_stress(l, x, 0.0, stress);
        life_contact_strain(stress, k->c->how.youngs, k->c->how.poisson, strain);
        k->along[s] = strain[0] - along_face(k, s);
        most = fmax(most, fabs(strain[0]));
        if (s % 2) off = fmax(off, fabs(k->along[s]));
    }
    k->out->face_error = off / most;
}

/* The same of the stress in the body near the patch, from a tenth of a half length down. */
static void compare_body(crack *k)
{
    const contact_load *l = k->c->load;
    const double near = 2.0 * l->half_length, from = 0.1 * l->half_length;
    double sum = 0.0;
    long n = 0;
    for (int j = 1; j < k->nz; j++)
        for (int i = 0; i < k->nx; i++) {
            const double x = middle(k, i), z = (j + 0.5) * k->h;
            double want[3], got[3], strain[3];
            if (fabs(x) > near || z > near || z < from) continue;
            life_contact_stress(l, x, z, want);
            mpm_rest_strain(k->body, i, j, strain);
            stress_of(&k->solid, strain, got);
            for (int q = 0; q < 3; q++, n++) sum += (got[q] - want[q]) * (got[q] - want[q]);
        }
    k->out->field_error = n > 0 ? sqrt(sum / (double)n) / l->peak : NAN;
}

static double life_alone(const crack *k)
{
    double least = INFINITY;
    for (int p = 0; p < k->points.points; p++) least = fmin(least, mpm_fatigue_alone(&k->points, p, k->c->limit));
    return least;
}

/* ---- cuts ---- */

/* Mean of axes: of their doubled angles. */
static double mean_angle(const crack *k, int point)
{
    const fatigue_fan *fan = &k->points.fan;
    double c = 0.0, s = 0.0;
    for (int d = 0; d < fan->n; d++) {
        if (!k->points.is_cut[(size_t)point * (size_t)fan->n + (size_t)d]) continue;
        c += fan->share[d] * cos(2.0 * fan->angle[d]), s += fan->share[d] * sin(2.0 * fan->angle[d]);
    }
    return fmod(0.5 * atan2(s, c) + PI, PI);
}

/* The first of the points that the last jump took to the limit: its cuts are looked through in their order. */
static void look_for_crack(crack *k, int before)
{
    const fatigue_points *f = &k->points;
    double first = INFINITY;
    int where = -1;
    for (int c = before; c < f->n_cuts; c++) {
        const int point = f->cut[c].point;
        double index = f->index[point]; /* less what was cut later */
        for (int b = c + 1; b < f->n_cuts; b++)
            if (f->cut[b].point == point) index -= f->fan.share[f->cut[b].direction];
        if (index < k->c->limit - 1e-9 || f->cut[c].cycles >= first) continue;
        first = f->cut[c].cycles, where = point;
    }
    if (where < 0) return;
    const bool passage = k->c->how.cycle == LIFE_PASSAGE;
    const int j = passage ? where : where / k->nx;
    k->out->life = first;
    k->out->depth = j == 0 ? 0.0 : (j + 0.5) * k->h;
    k->out->position = passage ? NAN : middle(k, where % k->nx);
    k->out->angle = mean_angle(k, where);
}

static void save_maps(crack *k)
{
    const fatigue_points *f = &k->points;
    for (int j = 0; j < k->nz; j++)
        for (int i = 0; i < k->nx; i++) {
            const size_t cell = (size_t)i * (size_t)k->nz + (size_t)j, point = (size_t)point_of(k, i, j);
            double least = 1.0;
            for (int d = 0; d < f->fan.n; d++) least = fmin(least, f->life[point * (size_t)f->fan.n + (size_t)d]);
            k->out->least_life[cell] = least;
            k->out->index[cell] = f->index[point];
        }
}

static status cut_until_crack(crack *k)
{
    const life_crack_how *c = k->c;
    while (isnan(k->out->life) && k->points.n_cuts < c->most_cuts) {
        const int before = k->points.n_cuts;
        bool changed = false;
        CHECK(!c->stop || !c->stop(), STATUS_STOPPED, "stopped after %d cuts", before);
        TRY(mpm_fatigue_jump(&k->points, c->batch));
        look_for_crack(k, before);
        if (isnan(k->out->life)) TRY(settle(k, &changed));
        if (changed) set_ranges(k);
        double most = 0.0;
        for (int p = 0; p < k->points.points; p++) most = fmax(most, k->points.index[p]);
        if (c->step) c->step(c->user, fmin(1.0, most / c->limit));
    }
    k->out->cuts = k->points.n_cuts;
    return status_ok();
}

/* ---- the whole ---- */

static void set_elasticity(crack *k)
{
    const double E = k->c->how.youngs, nu = k->c->how.poisson;
    const double lambda = E * nu / ((1.0 + nu) * (1.0 - 2.0 * nu)), shear = 0.5 * E / (1.0 + nu);
    k->solid = mpm_rest_isotropic(E, nu);
    k->bond = fmin(lambda, shear);
    k->rest[0] = lambda - k->bond > 1e-9 * shear ? lambda - k->bond : 0.0;
    k->rest[1] = shear - k->bond > 1e-9 * shear ? shear - k->bond : 0.0;
}

/* Cells in a length, a multiple of eight, which makes four grids of the multigrid. */
static int cells_in(double half_lengths, int cells)
{
    return 8 * (int)ceil(half_lengths * cells / 8.0 - 1e-9);
}

static status make(crack *k)
{
    const life_crack_how *c = k->c;
    k->nx = cells_in(2.0 * c->wide, c->cells), k->nz = cells_in(c->deep, c->cells);
    k->h = c->load->half_length / c->cells, k->left = -0.5 * k->nx * k->h;
    k->unit = c->load->peak / c->how.youngs;
    set_elasticity(k);
    const size_t cells = (size_t)k->nx * (size_t)k->nz, places = 2 * (size_t)k->nx + 1;
    k->open = calloc(cells, (size_t)c->fan.n + 1);
    k->lost = calloc(cells, sizeof *k->lost);
    k->pressure = calloc(3 * places, sizeof *k->pressure);
    life_crack *o = k->out;
    o->nx = k->nx, o->nz = k->nz, o->cell = k->h;
    o->least_life = calloc(2 * cells, sizeof *o->least_life);
    CHECK(k->open && k->lost && k->pressure && o->least_life, STATUS_MEMORY, "no memory for a grid of %d x %d cells",
          k->nx, k->nz);
    o->index = o->least_life + cells;
    k->traction = k->pressure + places, k->along = k->traction + places;
    TRY(mpm_rest_create(k->nx, k->nz, k->h, &k->solid, c->threads, &k->body));
    return mpm_fatigue_create(c->how.cycle == LIFE_PASSAGE ? k->nz : k->nx * k->nz, &c->fan, &c->law, &k->points);
}

static status find(crack *k)
{
    TRY(make(k));
    load_body(k);
    TRY(solve(k));
    compare_face(k);
    compare_body(k);
    set_ranges(k);
    k->out->first = mpm_fatigue_wait(&k->points);
    k->out->alone = life_alone(k);
    const status done = cut_until_crack(k);
    save_maps(k);
    return done;
}

life_crack life_crack_none(void)
{
    return (life_crack){ .life = NAN,
                         .position = NAN,
                         .depth = NAN,
                         .angle = NAN,
                         .first = NAN,
                         .alone = NAN,
                         .field_error = NAN,
                         .face_error = NAN };
}

status life_crack_find(const life_crack_how *c, life_crack *out)
{
    *out = life_crack_none();
    crack k = { .c = c, .out = out };
    const status done = find(&k);
    mpm_rest_free(k.body);
    mpm_fatigue_free(&k.points);
    free(k.open);
    free(k.lost);
    free(k.pressure);
    return done;
}

void life_crack_free(life_crack *c)
{
    free(c->least_life);
    c->least_life = c->index = NULL;
}
