/* SPDX-License-Identifier: BSD-3-Clause */
#include "circuit/rails/inductance.h"

#include "base/constants.h"
#include "circuit/rails/filaments.h"
#include "circuit/rails/perimeter.h"

#include <complex.h>
#include <math.h>
#include <stdlib.h>

/* Thinner skins than the section's largest side over this are taken as a surface impedance on the perfect conductor. */
static const double THIN_SKIN = 1000.0;

/* L' = [A + B ln F1] ln F2 uH/m */
double circuit_inductance_kerrisk(double h, double w, double s)
{
    const double F1 = 1.0 + 3.397143 * (w / h) - 0.06603002 * (w / h) * (s / h);
    const double F2 = 1.007719 + 2.743651 * (s / h) + 0.02209308 * (w / h) + 0.2637392 * (s / h) * (w / h);
    return 1e-6 * (0.4406411 - 0.07771617 * log(F1)) * log(F2);
}

status circuit_inductance_limit(const circuit_rail_section *s, double *L)
{
    double skin = 0.0;
    TRY(circuit_section_check(s));
    return circuit_perimeter_solve(s, L, &skin);
}

/* Of the better conductor of the two. */
static double skin_depth(const circuit_rail_section *s, double f)
{
    const double rho = s->cladding > 0.0 ? fmin(s->resistivity, s->cladding_resistivity) : s->resistivity;
    return sqrt(rho / (PI * MU0 * f));
}

static double largest_side(const circuit_rail_section *s)
{
    return fmax(s->height, s->thickness);
}

/* Below the frequency whose skin depth is 100 sections nothing changes by 1e-7: that is direct current. */
static double at_least_slow(const circuit_rail_section *s, double f)
{
    const double ratio = skin_depth(s, 1.0) / (100.0 * largest_side(s));
    return fmax(f, ratio * ratio);
}

static status response(const circuit_rail_section *s, const filaments *cells, double f_top, circuit_impedance *out)
{
    double *L = NULL;
    status st = circuit_filaments_inductance(s, cells, &L);
    if (st.code == STATUS_OK) st = circuit_impedance_create(cells->n, L, cells->R, 2.0 * PI * f_top, out);
    free(L);
    return st;
}

static status mesh(const circuit_rail_section *s, double f_top, double fineness, filaments *cells)
{
    TRY(circuit_section_check(s));
    CHECK(f_top > 0.0 && isfinite(f_top), STATUS_BAD_INPUT, "frequency %g Hz: must be positive and finite", f_top);
    return circuit_filaments_create(s, skin_depth(s, f_top), fineness, cells);
}

status circuit_inductance_response(const circuit_rail_section *s, double f_top, double fineness, circuit_impedance *out)
{
    filaments cells = { 0 };
    *out = (circuit_impedance){ 0 };
    status st = mesh(s, f_top, fineness, &cells);
    if (st.code == STATUS_OK) st = response(s, &cells, f_top, out);
    circuit_filaments_free(&cells);
    return st;
}

status circuit_inductance_at(const circuit_rail_section *s, double f, double fineness, double *L, double *R)
{
    TRY(circuit_section_check(s));
    CHECK(f >= 0.0 && isfinite(f), STATUS_BAD_INPUT, "frequency %g Hz: must be 0 or positive and finite", f);
    f = at_least_slow(s, f);
    if (skin_depth(s, f) <
        largest_side(s) / THIN_SKIN) { /* surface impedance on the perfect conductor's current (C-9) */
        TRY(circuit_perimeter_solve(s, L, R));
        *R *= sqrt(f);
        *L += *R / (2.0 * PI * f);
        return status_ok();
    }
    circuit_impedance z;
    const status st = circuit_inductance_response(s, f, fineness, &z);
    if (st.code == STATUS_OK) {
        const double complex Z = circuit_impedance_at(&z, _Complex_I * 2.0 * PI * f);
        *L = cimag(Z) / (2.0 * PI * f);
        *R = creal(Z);
    }
    circuit_impedance_free(&z);
    return st;
}

/* ---- along the surface ---- */

void circuit_inductance_surface_free(inductance_surface *p)
{
    free(p->place);
    *p = (inductance_surface){ 0 };
}

/* A cell, and its corners on the surface. */
typedef struct {
    int cell, from, to;
} surface_cell;

static surface_cell surface_cell_of(const filaments *c, int k)
{
    if (k < c->ny) return (surface_cell){ c->ny - 1 - k, 0, 3 };
    if (k < c->ny + c->nx) return (surface_cell){ (k - c->ny) * c->ny, 3, 2 };
    return (surface_cell){ (c->nx - 1) * c->ny + k - c->ny - c->nx, 2, 1 };
}

static void surface_fill(const circuit_rail_section *s, const filaments *c, const double complex *share,
                         inductance_surface *out)
{
    double place = 0.0;
    for (int k = 0; k < 2 * c->ny + c->nx; k++) {
        const surface_cell at = surface_cell_of(c, k);
        const filament *f = &c->cell[at.cell];
        const circuit_section_point a = f->corner[at.from], b = f->corner[at.to];
        const double length = hypot(b.x - a.x, b.y - a.y), J = 0.5 * cabs(share[at.cell]) / f->area;
        place += length;
        if (length <= 0.0) continue; /* a round rail has no side */
        out->place[out->n] = place - 0.5 * length;
        out->current[out->n] = J;
        out->heating[out->n++] = c->R[at.cell] / circuit_section_weight(s) * f->area * J * J;
    }
}

status circuit_inductance_surface_at(const circuit_rail_section *s, double f, double fineness, inductance_surface *out)
{
    filaments cells = { 0 };
    circuit_impedance z = { 0 };
    double complex *share = NULL;
    *out = (inductance_surface){ 0 };
    TRY(circuit_section_check(s));
    f = at_least_slow(s, f);
    status st = mesh(s, f, fineness, &cells);
    if (st.code == STATUS_OK) st = response(s, &cells, f, &z);
    if (st.code == STATUS_OK) {
        const size_t rim = (size_t)(2 * cells.ny + cells.nx);
        share = malloc((size_t)cells.n * sizeof *share);
        out->place = malloc(3 * rim * sizeof *out->place);
        if (!share || !out->place) {
            st = base_status_error(STATUS_MEMORY, "out of memory for %d rail filaments", cells.n);
        } else {
            out->current = out->place + rim;
            out->heating = out->current + rim;
            st = circuit_impedance_currents(&z, _Complex_I * 2.0 * PI * f, share);
        }
    }
    if (st.code == STATUS_OK) surface_fill(s, &cells, share, out);
    free(share);
    circuit_impedance_free(&z);
    circuit_filaments_free(&cells);
    return st;
}
