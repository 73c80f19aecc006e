/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/study/sampling/gouge_law.h"

#include "coupling/study/layer_wear.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Place of x in a table of n steps: index and share of the step. */
static int step_of(double x, double first, double per, int n, double *f)
{
    const double at = fmin(fmax((x - first) * per, 0.0), n - 1e-9);
    const int i = (int)at;
    *f = at - i;
    return i;
}

/* ---- thresholds ---- */

const gouge_law_draw study_gouge_law_middle = { .in_band = 0.5 };

/* A band without what may move it.  Where one side alone was seen it is open: below a velocity that is known to gouge,
 * above one that is known not to. */
static void band_at(const grain_family *f, double radius, double *low, double *high)
{
    double band[2];
    study_surface_band(&f->surface, radius, band);
    *low = isnan(band[0]) ? -INFINITY : band[0];
    *high = isnan(band[1]) ? INFINITY : band[1];
    if (isfinite(*low) && *high < *low) *low = *high = 0.5 * (*low + *high);
}

static void tabulate_thresholds(const grain_family *f, gouge_law *out)
{
    const surface_result *s = &f->surface;
    const double first = log(s->size[0].radius), last = log(s->size[s->sizes - 1].radius);
    const double *all = s->reference.allowance;
    out->own = fmin(s->reference.own, fmin(all[0], all[1]));
    for (int side = 0; side < 2; side++) out->alike[side] = sqrt(all[side] * all[side] - out->own * out->own);
    out->ln_first = first;
    out->per_ln = last > first ? LAW_SIZES / (last - first) : 0.0;
    for (int i = 0; i <= LAW_SIZES; i++) {
        const double ln_r = out->per_ln > 0.0 ? first + i / out->per_ln : first;
        band_at(f, exp(ln_r), &out->low[i], &out->high[i]);
    }
}

double study_gouge_law_threshold(const gouge_law *l, double ln_radius, gouge_law_draw draw)
{
    double f;
    const double moved = draw.alike * l->alike[draw.alike > 0.0] + draw.own * l->own;
    const int i = step_of(ln_radius, l->ln_first, l->per_ln, LAW_SIZES, &f);
    if (l->low[i] == INFINITY || l->low[i + 1] == INFINITY) return INFINITY; /* no scene: never */
    const double low = l->low[i] + f * (l->low[i + 1] - l->low[i]),
                 high = l->high[i] + f * (l->high[i + 1] - l->high[i]);
    const bool below = isfinite(low), above = isfinite(high);
    if (below && above) return low + draw.in_band * (high - low) + moved;
    if (draw.in_band < 0.5) return below ? low + moved : 0.0;
    return above ? high + moved : INFINITY;
}

double study_gouge_law_lowest(const gouge_law *l)
{
    double lowest = INFINITY;
    for (int i = 0; i <= LAW_SIZES; i++) lowest = fmin(lowest, l->low[i]);
    return lowest - l->alike[0] - l->own;
}

/* ---- marks ---- */

typedef struct {
    double v;
    gouge_mark is;
} marked;

static int by_velocity(const void *a, const void *b)
{
    const double x = ((const marked *)a)->v, y = ((const marked *)b)->v;
    return (x > y) - (x < y);
}

static double worth(double value)
{
    return isfinite(value) ? value : 0.0;
}

/* An undecided scene takes the side of its severity, as in the search. */
static bool gouges(const scene_result *r, double limit_severity)
{
    return r->crater_class == DAMAGE_GOUGE || (r->crater_class == DAMAGE_UNDECIDED && r->severity >= limit_severity);
}

/* Scenes whose craters count: whole ones, at the resolution of the thresholds where those were found by craters. */
static bool counts(const grain_family *f, const family_scene *a, const case_impact *of)
{
    if (f->by_growth) return a->whole;
    return a->cells == f->surface.reference.cells && gouges(&a->record->entry.result, of->scene.limit_severity);
}

/* Share of the layers over its crater that is gone. */
static double layers_gone(const family_scene *a, const case_impact *of)
{
    const double thickness = case_layers_thickness(&of->rail.layers);
    const layer_wear wear = study_layer_wear_of(&a->record->entry.result, thickness, a->radius);
    return wear.failed + wear.carried;
}

/* The family's gouges in order of velocity. */
static int collect(const grain_family *f, const case_impact *of, marked *out)
{
    int n = 0;
    for (int i = 0; i < f->n_scenes; i++) {
        const family_scene *a = &f->scene[i];
        const scene_result *r = &a->record->entry.result;
        const double r3 = pow(a->radius, 3.0);
        if (!counts(f, a, of)) continue;
        out[n].v = a->velocity;
        out[n++].is = (gouge_mark){ .volume = worth(r->crater_volume) / r3,
                                    .rim = worth(r->rim_height) / a->radius,
                                    .along = worth(r->crater_length) / a->radius,
                                    .depth = worth(r->crater_depth) / a->radius,
                                    .layers_gone = worth(layers_gone(a, of)),
                                    .impulse = a->record->impulse / r3,
                                    .metal = a->record->mass_loss / r3 };
    }
    qsort(out, (size_t)n, sizeof *out, by_velocity);
    return n;
}

static double towards(double is, double from, double to, double f)
{
    return is + f * (to - from);
}

gouge_mark study_gouge_mark_towards(const gouge_mark *is, const gouge_mark *from, const gouge_mark *to, double f)
{
#define TOWARDS(member) .member = towards(is->member, from->member, to->member, f)
    return (gouge_mark){ TOWARDS(volume),      TOWARDS(rim),     TOWARDS(along), TOWARDS(depth),
                         TOWARDS(layers_gone), TOWARDS(impulse), TOWARDS(metal) };
#undef TOWARDS
}

static gouge_mark between(const gouge_mark *a, const gouge_mark *b, double f)
{
    return study_gouge_mark_towards(a, a, b, f);
}

static gouge_mark mark_at(const marked *m, int n, double v)
{
    if (n == 0) return (gouge_mark){ .volume = NAN }; /* not known */
    int k = 0;
    while (k + 1 < n && m[k + 1].v < v) k++;
    if (k + 1 == n || v <= m[k].v || m[k + 1].v <= m[k].v) return m[k].is;
    return between(&m[k].is, &m[k + 1].is, (v - m[k].v) / (m[k + 1].v - m[k].v));
}

bool study_gouge_mark_at(const grain_family *f, const case_impact *of, double velocity, gouge_mark *out)
{
    marked m[THRESHOLD_MAX_SAMPLES];
    const int n = collect(f, of, m);
    *out = mark_at(m, n, velocity);
    return n > 0;
}

static void tabulate_marks(const grain_family *f, const case_impact *of, gouge_law *out)
{
    marked m[THRESHOLD_MAX_SAMPLES];
    const int n = collect(f, of, m);
    const double first = n ? m[0].v : 1.0, last = n ? m[n - 1].v : 1.0;
    out->marked = n > 0;
    out->v_first = first;
    out->per_v = last > first ? LAW_VELOCITIES / (last - first) : 0.0;
    for (int i = 0; i <= LAW_VELOCITIES; i++)
        out->mark[i] = mark_at(m, n, out->per_v > 0.0 ? first + i / out->per_v : first);
}

gouge_mark study_gouge_law_mark(const gouge_law *l, double velocity)
{
    double f;
    const int i = step_of(velocity, l->v_first, l->per_v, LAW_VELOCITIES, &f);
    return between(&l->mark[i], &l->mark[i + 1], f);
}

double study_gouge_law_depth(const grain_family *f, const case_impact *of)
{
    double depth = 0.0;
    for (int i = 0; i < f->n_scenes; i++)
        if (counts(f, &f->scene[i], of)) depth = fmax(depth, worth(f->scene[i].record->entry.result.crater_depth));
    return depth;
}

bool study_gouge_law_bares(const grain_family *f, const case_impact *of)
{
    const double thickness = case_layers_thickness(&of->rail.layers);
    for (int i = 0; i < f->n_scenes; i++) {
        const family_scene *a = &f->scene[i];
        if (!counts(f, a, of)) continue;
        const double depth = a->record->entry.result.crater_depth;
        if (study_layer_wear_is_through(layers_gone(a, of), depth, thickness)) return true;
    }
    return false;
}

void study_gouge_law_none(gouge_law *out)
{
    *out = (gouge_law){ .v_first = 1.0 };
    for (int i = 0; i <= LAW_SIZES; i++) out->low[i] = out->high[i] = INFINITY;
}

void study_gouge_law_make(const grain_family *f, const case_impact *of, gouge_law *out)
{
    tabulate_thresholds(f, out);
    tabulate_marks(f, of, out);
}
