/* A scene's bodies as material points: each body has a lattice of its own, aligned with its faces, as fine as the grid
 * is at the place; later bodies take the points they claim from earlier ones. */
#include "mpm/build.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
    int n;
    double *edge; /* n + 1 lattice planes [m], owned */
} ladder;

/* Planes from lo to hi, spaced like the grid over `per_cell`, then scaled to end on hi. */
static status ladder_make(const axis *a, double lo, double hi, int per_cell, ladder *out)
{
    int n = 0;
    for (double x = lo; x < hi * (1 + 1e-12) - 1e-12 && n < 1000000; n++)
        x += axis_spacing(a, x + 1e-9 * (hi - lo)) / per_cell;
    out->edge = malloc(((size_t)n + 2) * sizeof(double));
    CHECK(out->edge, STATUS_MEMORY, "no memory for a lattice of %d planes", n);
    double x = lo;
    int k = 0;
    out->edge[0] = lo;
    while (x < hi - 1e-6 * axis_spacing(a, x)) {
        x += axis_spacing(a, x + 1e-9 * (hi - lo)) / per_cell;
        out->edge[++k] = x;
        if (k > n) break;
    }
    /* the last plane lies at or beyond hi: drop it if the one before is nearer */
    if (k > 1 && hi - out->edge[k - 1] < out->edge[k] - hi) k--;
    const double scale = (hi - lo) / (out->edge[k] - lo);
    for (int i = 1; i <= k; i++) out->edge[i] = lo + scale * (out->edge[i] - lo);
    out->n = k;
    return status_ok();
}

static bool inside(const mpm_body *b, const double x[3])
{
    return b->shape->inside(&b->shape_value, x) > 0 && !(b->cut && b->cut->inside(&b->cut_value, x) > 0);
}

static bool claimed_later(const mpm_scene *s, int body, const double x[3])
{
    for (int i = body + 1; i < s->bodies; i++)
        if (inside(&s->body[i], x)) return true;
    return false;
}

/* Does the face of the body that the traction acts on lie between this point and the next lattice place? */
static double loaded_area(const mpm_body *b, const double x[3], const double size[3])
{
    if (b->traction[0] == 0 && b->traction[1] == 0 && b->traction[2] == 0) return 0;
    const int k = b->traction_face / 2;
    double next[3] = { x[0], x[1], x[2] };
    next[k] += b->traction_face % 2 ? size[k] : -size[k];
    return inside(b, next) ? 0 : size[(k + 1) % 3] * size[(k + 2) % 3];
}

static void fill_point(const mpm_body *b, const law *k, const double x[3], const double size[3], build_point *p)
{
    memset(p, 0, sizeof *p);
    for (int i = 0; i < 3; i++) {
        p->x[i] = x[i];
        p->half[i] = 0.5 * size[i];
        p->v[i] = b->velocity[i];
    }
    p->mass = k->rho_start * size[0] * size[1] * size[2];
    p->area = loaded_area(b, x, size);
}

static status walk(const mpm_scene *s, int body, const law *k, const ladder l[3], const build_sink *sink)
{
    const mpm_body *b = &s->body[body];
    for (int iz = 0; iz < l[2].n; iz++)
        for (int iy = 0; iy < l[1].n; iy++)
            for (int ix = 0; ix < l[0].n; ix++) {
                const int at[3] = { ix, iy, iz };
                double x[3], size[3];
                for (int q = 0; q < 3; q++) {
                    size[q] = l[q].edge[at[q] + 1] - l[q].edge[at[q]];
                    x[q] = l[q].edge[at[q]] + 0.5 * size[q];
                }
                if (!inside(b, x) || claimed_later(s, body, x)) continue;
                build_point p;
                fill_point(b, k, x, size, &p);
                TRY(sink->point(sink->user, body, &p));
            }
    return status_ok();
}

const double build_everywhere[2] = { -INFINITY, INFINITY };

status build_body(const mpm_scene *s, int body, const law *k, const axis axes[3], const double x[2],
                  const build_sink *sink)
{
    const mpm_body *b = &s->body[body];
    double lo[3], hi[3];
    b->shape->bounds(&b->shape_value, lo, hi);
    lo[0] = fmax(lo[0], x[0]), hi[0] = fmin(hi[0], x[1]);
    ladder l[3] = { { 0 } };
    status r = status_ok();
    for (int q = 0; q < 3 && r.code == STATUS_OK; q++) {
        lo[q] = fmax(lo[q], axes[q].node[1]);
        hi[q] = fmin(hi[q], axes[q].node[axes[q].last]);
        if (hi[q] <= lo[q])
            r = status_error(STATUS_BAD_INPUT, "body `%s` lies outside the window along axis %d", b->name, q);
        else
            r = ladder_make(&axes[q], lo[q], hi[q], s->particles_per_axis, &l[q]);
    }
    if (r.code == STATUS_OK) r = walk(s, body, k, l, sink);
    for (int q = 0; q < 3; q++) free(l[q].edge);
    return r;
}
