#include "circuit/filaments.h"

#include <math.h>
#include <stdlib.h>

static const double PI = 3.14159265358979323846;
static const double MU0 = 1.25663706212e-6; /* [H/m] CODATA 2018 */

enum { MAX_CELLS = 128 }; /* along one side */

/* d^4 G/dX^2 dY^2 = 1/2 ln(X^2 + Y^2) + 25/12 */
static double antiderivative(double X, double Y)
{
    const double x = fabs(X), y = fabs(Y), r2 = x * x + y * y;
    if (r2 == 0.0) return 0.0;
    const double x2 = x * x, y2 = y * y;
    const double log_part = (6.0 * x2 * y2 - x2 * x2 - y2 * y2) / 24.0 * log(r2);
    const double atan_part = (x2 * x * y * atan2(y, x) + x * y * y2 * atan2(x, y)) / 3.0;
    return 0.5 * (log_part + atan_part);
}

/* Mean of ln r between two rectangles whose centres lie dx, dy apart; exact when near, to (size/r)^4 when far. */
static double mean_log(const filament *p, const filament *q, double dx, double dy)
{
    const double r2 = dx * dx + dy * dy, size = fmax(fmax(p->a, p->b), fmax(q->a, q->b));
    if (r2 > 144.0 * size * size) {
        const double spread = p->a * p->a + q->a * q->a - p->b * p->b - q->b * q->b;
        return 0.5 * log(r2) + spread * (dy * dy - dx * dx) / (24.0 * r2 * r2);
    }
    const double X[4] = { 0.5 * (p->a + q->a), 0.5 * (p->a - q->a), -0.5 * (p->a - q->a), -0.5 * (p->a + q->a) };
    const double Y[4] = { 0.5 * (p->b + q->b), 0.5 * (p->b - q->b), -0.5 * (p->b - q->b), -0.5 * (p->b + q->b) };
    const double sign[4] = { 1.0, -1.0, -1.0, 1.0 };
    double sum = 0.0;
    for (int i = 0; i < 4; i++) {
        for (int j = 0; j < 4; j++) sum += sign[i] * sign[j] * antiderivative((dx + X[i]) / size, (dy + Y[j]) / size);
    }
    const double size4 = size * size * size * size;
    return sum * size4 / (p->a * p->b * q->a * q->b) - 25.0 / 12.0 + log(size);
}

int filaments_graded(double length, double first, double growth, int ends, double *size)
{
    const double span = length / ends;
    int n = 0;
    double sum = 0.0, d = first;
    while (sum < span) {
        size[n++] = d;
        sum += d;
        d *= growth;
    }
    for (int k = 0; k < n; k++) size[k] *= span / sum;
    if (ends == 2) {
        for (int k = 0; k < n; k++) size[2 * n - 1 - k] = size[k];
    }
    return ends * n;
}

/* Inverse of the first cell over the skin depth; growth from cell to cell. */
static const double CELLS_A_DEPTH = 6.0, GROWTH = 1.25;

void filaments_free(filaments *f)
{
    free(f->cell);
    free(f->R);
    *f = (filaments){ 0 };
}

static status filaments_take(int n, filaments *out)
{
    *out = (filaments){ .n = n };
    out->cell = malloc((size_t)n * sizeof *out->cell);
    out->R = malloc((size_t)n * sizeof *out->R);
    CHECK(out->cell && out->R, STATUS_MEMORY, "out of memory for %d rail filaments", n);
    return status_ok();
}

status filaments_of_rectangle(const double section[3], double resistivity, double depth, filaments *out)
{
    const double h = section[0], w = section[1], first = depth / CELLS_A_DEPTH;
    double dx[MAX_CELLS], dy[MAX_CELLS];
    const int nx = filaments_graded(w, fmin(first, w / 40.0), GROWTH, 2, dx);
    const int ny = filaments_graded(0.5 * h, fmin(first, h / 40.0), GROWTH, 1, dy);
    TRY(filaments_take(nx * ny, out));
    double x = 0.5 * section[2];
    int n = 0;
    for (int i = 0; i < nx; x += dx[i++]) {
        double y = 0.5 * h; /* finest at the edge, coarse at y = 0 */
        for (int j = 0; j < ny; y -= dy[j++], n++) {
            out->cell[n] = (filament){ x + 0.5 * dx[i], y - 0.5 * dy[j], dx[i], dy[j] };
            out->R[n] = resistivity / (dx[i] * dy[j]);
        }
    }
    return status_ok();
}

static double potential(const filament *p, const filament *q)
{
    return -MU0 / (2.0 * PI) *
           (mean_log(p, q, p->x - q->x, p->y - q->y) + mean_log(p, q, p->x - q->x, p->y + q->y) -
            mean_log(p, q, p->x + q->x, p->y - q->y) - mean_log(p, q, p->x + q->x, p->y + q->y));
}

status filaments_inductance(const filaments *f, double **L)
{
    const size_t n = (size_t)f->n;
    *L = malloc(n * n * sizeof **L);
    CHECK(*L, STATUS_MEMORY, "out of memory for the inductances of %d rail filaments", f->n);
    for (size_t i = 0; i < n; i++) {
        for (size_t j = 0; j <= i; j++) (*L)[i * n + j] = (*L)[j * n + i] = potential(&f->cell[i], &f->cell[j]);
    }
    return status_ok();
}
