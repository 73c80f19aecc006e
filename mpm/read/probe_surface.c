/* SPDX-License-Identifier: BSD-3-Clause */
/* Surface: how far a body's intact material reaches along an axis, over a grid of the two others.
 *
 * Seen from `along`, the highest domain over the middle of each column, within the box.  A row is a point of the
 * surface, its coordinate along the axis NAN over a gap; the axis after `along` varies slowest (y: z, then x).  Columns
 * narrower than a cell of the grid show gaps between points. */
#include "mpm/read/probe_kinds.h"

#include <stdlib.h>

typedef struct {
    double lo[3], hi[3], along[3], cell;
} surface;

static const base_param params[] = {
    PROBE_POINT(surface, lo, "corner of the box at the lower ends"),
    PROBE_POINT(surface, hi, "corner of the box at the upper ends"),
    PARAM_VEC3(surface, along, "1", REQUIRED, -1, 1, "where it is seen from: an axis, such as [0, 1, 0]"),
    PARAM_DOUBLE(surface, cell, "m", REQUIRED, 1e-9, PROBE_FARTHEST, "width of a column, at most"), PARAMS_END
};

static const mpm_column columns[] = { { "x", "m", "of a point of the surface" },
                                      { "y", "m", "the same along y" },
                                      { "z", "m", "the same along z" },
                                      { NULL, NULL, NULL } };

enum { MOST_ROWS = 1 << 20 };

typedef struct {
    const surface *v;
    int axis, across[2], n[2]; /* of the columns along the two others */
    double sign, width[2];
} view;

static double columns_over(double length, double cell)
{
    return ceil(length / cell * (1 - 1e-9));
}

static view view_of(const mpm_probe *p)
{
    const surface *v = PROBE_VALUES(surface, p);
    view w = { .v = v, .axis = v->along[0] != 0 ? 0 : v->along[1] != 0 ? 1 : 2 };
    w.sign = v->along[w.axis];
    for (int q = 0; q < 2; q++) {
        const int k = w.across[q] = (w.axis + 1 + q) % 3;
        w.n[q] = (int)columns_over(v->hi[k] - v->lo[k], v->cell);
        w.width[q] = (v->hi[k] - v->lo[k]) / w.n[q];
    }
    return w;
}

static int rows(const mpm_probe *p)
{
    const view w = view_of(p);
    return w.n[0] * w.n[1];
}

static status check(const mpm_probe *p, const char *name)
{
    const surface *v = PROBE_VALUES(surface, p);
    double n = 1;
    TRY(mpm_probe_check_axis(v->along, name));
    for (int k = 0; k < 3; k++) {
        CHECK(v->lo[k] < v->hi[k], STATUS_BAD_INPUT, "%s: hi along %c, %g m, must lie above lo, %g m", name, "xyz"[k],
              v -> hi[k], v -> lo[k]);
        if (v->along[k] == 0) n *= columns_over(v->hi[k] - v->lo[k], v->cell);
    }
    CHECK(n <= MOST_ROWS, STATUS_BAD_INPUT, "%s.cell = %g m makes %.3g columns, at most %d", name, v->cell, n,
          MOST_ROWS);
    return status_ok();
}

typedef struct {
    const view *w;
    int body;
    double *top; /* [rows] sign times the coordinate, -INFINITY: a gap */
} map;

/* Columns whose middle lies in the domain along one of the axes across. */
static void covered(const view *w, int q, const block *b, int l, int ends[2])
{
    const int k = w->across[q];
    const double from = b->x[k][l] - b->half[k][l] - w->v->lo[k], to = b->x[k][l] + b->half[k][l] - w->v->lo[k];
    ends[0] = (int)fmax(ceil(from / w->width[q] - 0.5), 0);
    ends[1] = (int)fmin(floor(to / w->width[q] - 0.5), w->n[q] - 1);
}

static void add_lane(const map *s, const block *b, int l)
{
    const view *w = s->w;
    const double middle = b->x[w->axis][l], top = w->sign * middle + b->half[w->axis][l];
    int u[2], v[2];
    if (middle < w->v->lo[w->axis] || middle > w->v->hi[w->axis]) return;
    covered(w, 0, b, l, u);
    covered(w, 1, b, l, v);
    for (int i = u[0]; i <= u[1]; i++)
        for (int j = v[0]; j <= v[1]; j++) s->top[i * w->n[1] + j] = fmax(s->top[i * w->n[1] + j], top);
}

static void add_block(void *user, const mpm *m, const brick *b, int index)
{
    (void)b;
    const map *s = user;
    const block *q = &m->blocks[index];
    if (!visit_wants(m, index, s->body)) return;
    for (int l = 0; l < LANES; l++)
        if (q->mass[0][l] > 0 && q->damage[0][l] < 1) add_lane(s, q, l);
}

static void write_rows(const view *w, const double *top, double *out)
{
    for (int i = 0; i < w->n[0]; i++)
        for (int j = 0; j < w->n[1]; j++, out += 3) {
            const double height = top[i * w->n[1] + j];
            out[w->axis] = isinf(height) ? NAN : w->sign * height;
            out[w->across[0]] = w->v->lo[w->across[0]] + (i + 0.5) * w->width[0];
            out[w->across[1]] = w->v->lo[w->across[1]] + (j + 0.5) * w->width[1];
        }
}

static status read(const mpm *m, const mpm_probe *p, double *out)
{
    const view w = view_of(p);
    const size_t n = (size_t)(w.n[0] * w.n[1]);
    double *tops = malloc(SHARES * n * sizeof *tops);
    CHECK(tops, STATUS_MEMORY, "probe `%s`: no memory for %zu columns", p->name, n);
    for (size_t i = 0; i < SHARES * n; i++) tops[i] = -INFINITY;
    map share[SHARES];
    for (int i = 0; i < SHARES; i++) share[i] = (map){ &w, p->body, tops + (size_t)i * n };
    mpm_visit_shares(m, add_block, share, sizeof *share);
    for (size_t i = n; i < SHARES * n; i++) tops[i % n] = fmax(tops[i % n], tops[i]);
    write_rows(&w, tops, out);
    free(tops);
    return status_ok();
}

const mpm_probe_kind mpm_probe_surface = { .name = "surface",
                                           .doc = "map of a body's surface seen along an axis",
                                           .params = params,
                                           .columns = columns,
                                           .rows = rows,
                                           .check = check,
                                           .read = read };
