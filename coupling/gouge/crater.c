/* SPDX-License-Identifier: BSD-3-Clause */
/* Measures and class of the crater. */
#include "coupling/gouge/crater.h"

#include "coupling/gouge/crater_parts.h"

#include <assert.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static const double SMOOTH_TO = 1.5; /* (M-20): full weight from this multiple of d_m */

/* ---- measures ---- */

/* (M-20) w(d): 0 up to d_m, 1 from 1.5 d_m, 3 t^2 - 2 t^3 between. */
static double weight(double d, double d_m)
{
    const double t = fmin(fmax((d / d_m - 1.0) / (SMOOTH_TO - 1.0), 0.0), 1.0);
    return t * t * (3.0 - 2.0 * t);
}

/* Mean width over lo .. hi along x, rows weighted by their overlap with it. */
static double mean_width(const crater *c, const crater_outline *o, double lo, double hi)
{
    double sum = 0.0, length = 0.0;
    for (int i = o->first; i <= o->last; i++) {
        const double x = c->x0 + c->dx * i;
        const double overlap = fmin(x + 0.5 * c->dx, hi) - fmax(x - 0.5 * c->dx, lo);
        if (overlap <= 0.0) continue;
        sum += overlap * fmax(o->row[i].hi - o->row[i].lo, 0.0);
        length += overlap;
    }
    return length > 0.0 ? sum / length : 0.0;
}

/* Highest cell of x >= from within `margin` of the crater [m above the surface, >= 0]; *x where. */
static double highest(const crater *c, const crater_outline *o, double margin, double from, double *x)
{
    double height = 0.0;
    for (int i = 0; i < c->nx; i++) {
        const double at_x = c->x0 + c->dx * i;
        if (at_x < fmax(from, o->x_lo - margin) || at_x > o->x_hi + margin) continue;
        for (int j = 0; j < c->nz; j++) {
            const double z = c->z0 + c->dz * j, h = -c->depth_map[(size_t)i * (size_t)c->nz + (size_t)j];
            if (z < o->z_lo - margin || z > o->z_hi + margin || h <= height) continue;
            height = h;
            *x = at_x;
        }
    }
    return height;
}

/* (M-20) */
static double volume_of(const crater *c)
{
    double volume = 0.0;
    for (int j = 0; j < c->nz; j++)
        for (int i = 0; i < c->nx; i++) {
            const double d = c->depth_map[(size_t)i * (size_t)c->nz + (size_t)j];
            volume += d * weight(d, c->measuring_depth);
        }
    return volume * c->dx * c->dz;
}

static void measure_outline(const crater_spec *spec, const crater_outline *o, crater *c)
{
    c->length = o->x_hi - o->x_lo;
    c->truncated = o->first == 0 || o->last == c->nx - 1;
    for (int i = o->first; i <= o->last; i++) {
        const crater_section *s = &o->row[i];
        if (s->hi < s->lo) continue;
        c->width = fmax(c->width, s->hi - s->lo);
        c->truncated = c->truncated || s->first == 0 || s->last == c->nz - 1;
        if (s->deepest <= c->depth) continue;
        c->depth = s->deepest;
        c->deepest_x = c->x0 + c->dx * i;
    }
    const double upstream = mean_width(c, o, o->x_lo, o->x_lo + c->length / 3.0);
    const double downstream = mean_width(c, o, o->x_hi - c->length / 3.0, o->x_hi);
    c->widening = downstream / fmax(upstream, 0.5 * c->dz); /* a point upstream is no narrower than half a cell */
    c->rim_height = highest(c, o, fmax(c->width, 4.0 * spec->particle_radius), -INFINITY, &c->rim_x);
}

/* How far V leans downstream: 6 <x - x_middle>/length over d w(d), 0 for a constant section, 1 for a wedge that begins
 * at a point, negative for one that dies out. */
static double lean_of(const crater_outline *o, const crater *c)
{
    double moment = 0.0, sum = 0.0;
    for (int i = o->first; i <= o->last; i++)
        for (int j = 0; j < c->nz; j++) {
            const double d = c->depth_map[(size_t)i * (size_t)c->nz + (size_t)j];
            sum += d * weight(d, c->measuring_depth);
            moment += d * weight(d, c->measuring_depth) * (c->x0 + c->dx * i - 0.5 * (o->x_lo + o->x_hi));
        }
    return sum > 0.0 ? 6.0 * moment / (sum * c->length) : 0.0;
}

/* ---- the class ---- */

static void classify(const crater_spec *spec, double rim_downstream, crater *c)
{
    const bool wide = c->widening >= spec->limit_widening, severe = c->severity >= spec->limit_severity;
    const bool rim = rim_downstream > c->measuring_depth;
    if (!severe && !(wide && rim))
        c->class = DAMAGE_SCRATCH;
    else
        c->class = wide && severe && rim ? DAMAGE_GOUGE : DAMAGE_UNDECIDED;
    snprintf(c->reason, sizeof c->reason,
             "widening %.2f %s %.2f, severity %.2f %s %.2f, rim downstream %.3f mm %s %.3f mm%s", c->widening,
             wide ? ">=" : "<", spec->limit_widening, c->severity, severe ? ">=" : "<", spec->limit_severity,
             1e3 * rim_downstream, rim ? ">" : "<=", 1e3 * c->measuring_depth,
             c->truncated ? "; the crater reaches the edge of the map" : "");
}

static void measure(const crater_spec *spec, const crater_outline *o, crater *c)
{
    c->volume = volume_of(c);
    c->severity = -spec->particle_area * spec->particle_height / spec->particle_volume; /* (M-21) of no crater */
    if (o->first < 0) {
        c->class = DAMAGE_NONE;
        snprintf(c->reason, sizeof c->reason, "no depth above the measuring depth of %.3f mm",
                 1e3 * c->measuring_depth);
        return;
    }
    measure_outline(spec, o, c);
    c->lean = lean_of(o, c);
    c->severity += c->lean * c->volume / spec->particle_volume; /* (M-21) */
    const double margin = fmax(c->width, 4.0 * spec->particle_radius);
    double x;
    classify(spec, highest(c, o, margin, 0.5 * (o->x_lo + o->x_hi), &x), c);
}

static status check_spec(const crater_spec *s)
{
    CHECK(s->cell > 0.0 && s->x_hi > s->x_lo && s->z_hi > 0.0 && isfinite(s->x_hi - s->x_lo) && isfinite(s->z_hi) &&
              isfinite(s->surface),
          STATUS_BAD_INPUT, "crater: the region x %g .. %g m, z up to %g m in cells of %g m is empty", s->x_lo, s->x_hi,
          s->z_hi, s->cell);
    CHECK(s->particle_radius > 0.0 && s->particle_height > 0.0 && s->particle_volume > 0.0 && s->particle_area > 0.0,
          STATUS_BAD_INPUT,
          "crater: the grain's radius %g m, height %g m, volume %g m3 and area %g m2 must be positive",
          s->particle_radius, s->particle_height, s->particle_volume, s->particle_area);
    CHECK(isfinite(s->limit_widening) && isfinite(s->limit_severity), STATUS_BAD_INPUT,
          "crater: limit_widening = %g and limit_severity = %g must be numbers", s->limit_widening, s->limit_severity);
    return status_ok();
}

status gouge_crater_measure(const crater_points *points, const crater_spec *spec, crater *out)
{
    assert(points && spec && out);
    *out = (crater){ .class = DAMAGE_NONE };
    TRY(check_spec(spec));
    out->measuring_depth = gouge_crater_measuring_depth(spec);
    crater_outline o = { .row = NULL };
    status done = gouge_crater_map(points, spec, out);
    if (done.code == STATUS_OK) done = gouge_crater_trace(out, &o);
    if (done.code == STATUS_OK)
        measure(spec, &o, out);
    else
        gouge_crater_free(out);
    free(o.row);
    return done;
}

void gouge_crater_free(crater *c)
{
    if (!c) return;
    free(c->depth_map);
    c->depth_map = NULL;
}

double gouge_crater_measuring_depth(const crater_spec *spec)
{
    return spec->measuring_depth > 0.0 ? spec->measuring_depth : fmax(spec->particle_radius / 6.0, 0.5 * spec->cell);
}

double gouge_crater_length_over_width(const crater *c)
{
    return c->width > 0.0 ? c->length / c->width : NAN;
}
