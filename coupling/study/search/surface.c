/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/study/search/surface.h"

#include <assert.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

/* Expected slope -d ln v_th / d ln r: sets which scene comes next (Wu et al. 2017, from 0.5 to 0.1 mm: small). */
static const double TREND = 0.1;
static const double SECANT_TRUST = 0.5; /* width in which a secant's root is expected, over the band's [1] */
static const double FAR =
    3.0; /* how far beyond a band's known end its unknown one is expected, in the chance's scale [1] */

/* ---- bands ---- */

/* What the samples of one resolution say of a size: none gouges up to `low`, all from `high` on. */
typedef struct {
    double low, high; /* [m/s]; a step outside the grid while not known */
    bool low_known, high_known;
    const surface_sample *at_low, *at_high;     /* samples that stand at the ends */
    const threshold_sample *own_low, *own_high; /* the same where they are of this very size, NULL: another's */
} band;

static double grid_low(const surface_plan *p)
{
    return p->search.step * ceil(p->search.low / p->search.step - 1e-9);
}

static double grid_high(const surface_plan *p)
{
    return p->search.step * floor(p->search.high / p->search.step + 1e-9);
}

/* One sample into a band: its own always, another size's where it does not contradict the band's own ends. */
static void take(band *b, const surface_sample *a, double radius)
{
    const bool upper = study_threshold_is_upper(&a->is), own = a->radius == radius;
    const double v = a->is.velocity;
    if (upper && (own || (a->radius < radius && !(b->own_low && v <= b->low))) && v < b->high)
        b->high = v, b->high_known = true, b->at_high = a, b->own_high = own ? &a->is : NULL;
    if (!upper && (own || (a->radius > radius && !(b->own_high && v >= b->high))) && v > b->low)
        b->low = v, b->low_known = true, b->at_low = a, b->own_low = own ? &a->is : NULL;
}

static band band_of(const surface_search *s, double radius)
{
    const surface_plan *p = s->plan;
    band b = { .low = grid_low(p) - p->search.step, .high = grid_high(p) + p->search.step };
    for (int own = 1; own >= 0; own--) /* its own samples first */
        for (int i = 0; i < s->result.samples; i++) {
            const surface_sample *a = &s->result.sample[i];
            if (a->is.cells_per_radius == s->result.reference.cells && (a->radius == radius) == own)
                take(&b, a, radius);
        }
    return b;
}

static double place(const surface_plan *p, double v)
{
    return p->search.place ? p->search.place(p->search.place_user, v) : 0.0;
}

/* Widths of a band, each over the wanted one [1]. */
static double velocity_width(const surface_plan *p, const band *b)
{
    return (b->high - b->low) / (0.5 * (b->high + b->low) * p->search.interval);
}

static double place_width(const surface_plan *p, const band *b)
{
    return p->search.place ? (place(p, b->high) - place(p, b->low)) / p->search.place_interval : 0.0;
}

/* Where the armature never has the velocities of the band, a scene tells nothing. */
static bool is_beyond(const surface_plan *p, const band *b)
{
    return p->search.place && !(place(p, b->high) > place(p, b->low));
}

static bool is_open(const surface_plan *p, int k, const band *b)
{
    const double least = fmax(1.5 * p->search.step, p->search.resolution * 0.5 * (b->high + b->low));
    if (k == p->reference || !(p->weight[k] > 0.0) || b->high - b->low < least) return false;
    return !is_beyond(p, b) && (velocity_width(p, b) > 1.0 || place_width(p, b) > 1.0);
}

/* ---- which scene next ---- */

/* Both wanted intervals as one measure that rises with v [1]. */
static double measure(const surface_plan *p, double v)
{
    const double along = p->search.place ? place(p, v) / p->search.place_interval : 0.0;
    return along + log(v) / p->search.interval;
}

/* Where the severity crosses its limit between two scenes of this size; else the band's middle. */
static double crossing(const band *b)
{
    const threshold_sample *lo = b->own_low, *hi = b->own_high;
    if (!lo || !hi || !(lo->excess < 0.0) || !(hi->excess >= 0.0)) return 0.5 * (b->low + b->high);
    return b->low - (b->high - b->low) * lo->excess / (hi->excess - lo->excess);
}

/* How far the threshold of size k is expected to lie from the reference's [m/s]. */
static double scale_of(const surface_plan *p, int k)
{
    const double far = fabs(log(p->size[k] / p->size[p->reference]));
    return p->search.step + TREND * far * 0.5 * (p->search.low + p->search.high);
}

/* That a grain of size k gouges at v, for what is expected beyond the band's ends. */
static double chance(const surface_plan *p, int k, const band *b, double v)
{
    if (b->high_known && !b->low_known) return exp(-(b->high - v) / scale_of(p, k));
    if (b->low_known && !b->high_known) return 1.0 - exp(-(v - b->low) / scale_of(p, k));
    if (!b->own_low || !b->own_high) return (v - b->low) / (b->high - b->low);
    const double off = (v - crossing(b)) / (SECANT_TRUST * (b->high - b->low));
    return fmin(fmax(0.5 + off, 0.0), 1.0);
}

static double expected_low(const surface_plan *p, int k, const band *b)
{
    return b->high_known && !b->low_known ? fmax(b->low, b->high - FAR * scale_of(p, k)) : b->low;
}

static double expected_high(const surface_plan *p, int k, const band *b)
{
    return b->low_known && !b->high_known ? fmin(b->high, b->low + FAR * scale_of(p, k)) : b->high;
}

/* Weighted measure that the bands lose if size k is asked at v, expected. */
static double gain(const surface_search *s, const band *bands, int k, double v)
{
    const surface_plan *p = s->plan;
    const double yes = chance(p, k, &bands[k], v), here = measure(p, v);
    double sum = 0.0;
    for (int j = 0; j < p->sizes; j++) {
        if (!is_open(p, j, &bands[j])) continue;
        const double low = measure(p, expected_low(p, j, &bands[j])), high = measure(p, expected_high(p, j, &bands[j]));
        if (j >= k && here < high) sum += yes * p->weight[j] * (high - fmax(here, low));
        if (j <= k && here > low) sum += (1.0 - yes) * p->weight[j] * (fmin(here, high) - low);
    }
    return sum;
}

static bool best_scene(const surface_search *s, const band *bands, int *size, double *velocity)
{
    const surface_plan *p = s->plan;
    double best = 0.0;
    for (int k = 0; k < p->sizes; k++) {
        if (!is_open(p, k, &bands[k])) continue;
        for (double v = bands[k].low + p->search.step; v < bands[k].high - 0.5 * p->search.step; v += p->search.step) {
            const double worth = gain(s, bands, k, v);
            if (worth <= best * (1.0 + 1e-9)) continue; /* of equals the first: the same on every machine */
            best = worth;
            *size = k;
            *velocity = p->search.step * round(v / p->search.step);
        }
    }
    return best > 0.0;
}

/* Weighted means of the widths over the wanted ones. */
static bool narrow_enough(const surface_plan *p, const band *bands)
{
    double weight = 0.0, v = 0.0, x = 0.0;
    for (int k = 0; k < p->sizes; k++) {
        if (is_beyond(p, &bands[k])) continue;
        weight += p->weight[k];
        v += p->weight[k] * velocity_width(p, &bands[k]);
        x += p->weight[k] * place_width(p, &bands[k]);
    }
    return v <= weight && x <= weight;
}

/* First of all: is the threshold the same from end to end?  The largest size just below the reference's threshold, the
 * smallest just above. */
static bool flat_to_check(const surface_search *s, const band *bands, int *size, double *velocity)
{
    const surface_plan *p = s->plan;
    const band *reference = &bands[p->reference];
    const int ends[2] = { p->sizes - 1, 0 };
    for (int e = 0; e < 2; e++) {
        const band *b = &bands[ends[e]];
        const bool unknown = e ? !b->high_known && reference->high_known : !b->low_known && reference->low_known;
        if (!unknown || ends[e] == p->reference || is_beyond(p, b) || !(p->weight[ends[e]] > 0.0)) continue;
        bool asked = false;
        for (int i = 0; i < s->result.samples; i++) asked = asked || s->result.sample[i].radius == p->size[ends[e]];
        if (asked) continue;
        *size = ends[e];
        *velocity = e ? reference->high : reference->low;
        return true;
    }
    return false;
}

/* The ends of the range of sizes are taken on nobody's word: their bands end at scenes of their own. */
static bool end_to_check(const surface_plan *p, const band *bands, int *size, double *velocity)
{
    const int ends[2] = { p->sizes - 1, 0 };
    for (int e = 0; e < 2; e++) {
        const band *b = &bands[ends[e]];
        const bool borrowed = e ? b->low_known && !b->own_low : b->high_known && !b->own_high;
        const double v = e ? b->low : b->high;
        const bool tells = !p->search.place || place(p, v) > place(p, v - p->search.step);
        if (ends[e] == p->reference || !borrowed || !tells) continue;
        *size = ends[e];
        *velocity = v;
        return true;
    }
    return false;
}

static void all_bands(const surface_search *s, band *bands)
{
    for (int k = 0; k < s->plan->sizes; k++) bands[k] = band_of(s, s->plan->size[k]);
}

/* ---- the answer ---- */

/* A grain that gouges at v where a larger one does not: said once. */
static void check_sizes(surface_result *r)
{
    for (int i = 0; i < r->samples; i++)
        for (int j = 0; j < r->samples; j++) {
            const surface_sample *small = &r->sample[i], *large = &r->sample[j];
            if (small->is.cells_per_radius != r->reference.cells || large->is.cells_per_radius != r->reference.cells ||
                !(small->radius < large->radius) || small->is.velocity > large->is.velocity ||
                !study_threshold_is_upper(&small->is) || study_threshold_is_upper(&large->is))
                continue;
            r->monotone = false;
            if (!r->warning[0])
                snprintf(
                    r->warning, sizeof r->warning,
                    "the threshold does not fall with size: a grain of %g mm gouges at %g m/s, one of %g mm does not "
                    "at %g m/s",
                    1e3 * small->radius, small->is.velocity, 1e3 * large->radius, large->is.velocity);
            return;
        }
}

/* Samples that bound a size on the side of one of them: above, of grains no larger; below, of none smaller. */
static int bounding(const surface_search *s, double radius, const surface_sample *like, bool own, threshold_sample *out)
{
    const bool upper = study_threshold_is_upper(&like->is);
    int n = 0;
    for (int i = 0; i < s->result.samples; i++) {
        const surface_sample *a = &s->result.sample[i];
        const bool tells = own ? a->radius == radius : upper ? a->radius <= radius : a->radius >= radius;
        if (tells) out[n++] = a->is;
    }
    return n;
}

/* From the end of a size's band to where its own scenes decide; where none of them does, or another size's stands
 * there, to the next one that decides of any size that bounds it; where none does, to the furthest of them.  Growth of
 * several sizes lies on no line, so the scatter tells nothing between them. */
static double decided_end(const surface_search *s, double radius, const surface_sample *end)
{
    threshold_sample list[THRESHOLD_MAX_SAMPLES];
    threshold_plan alone = s->plan->search;
    double decided = NAN;
    if (end->radius == radius)
        decided = study_threshold_decided_end(&alone, list, bounding(s, radius, end, true, list), &end->is);
    if (!isnan(decided)) return decided;
    alone.scatter = 0.0;
    const int n = bounding(s, radius, end, false, list);
    decided = study_threshold_decided_end(&alone, list, n, &end->is);
    return isnan(decided) ? study_threshold_furthest_end(list, n, &end->is) : decided;
}

static surface_size answer_of(surface_search *s, int k)
{
    const surface_plan *p = s->plan;
    surface_result *r = &s->result;
    band b = band_of(s, p->size[k]);
    surface_size a = { .radius = p->size[k], .weight = p->weight[k], .velocity = NAN, .interval = { NAN, NAN } };
    const double *allowance = r->reference.allowance;
    for (int i = 0; i < r->samples; i++) a.scenes += r->sample[i].radius == a.radius;
    if (b.low_known) a.interval[0] = decided_end(s, a.radius, b.at_low) - allowance[0];
    if (b.high_known) a.interval[1] = decided_end(s, a.radius, b.at_high) + allowance[1];
    if (b.low_known && b.high_known) {
        a.velocity = crossing(&b);
        if (b.low >= b.high) {
            r->monotone = false; /* its own scenes turn back */
            a.interval[0] = fmin(a.interval[0], b.high - allowance[0]);
            a.interval[1] = fmax(a.interval[1], b.low + allowance[1]);
        }
    }
    if (k == p->reference) {
        a.velocity = r->reference.velocity;
        memcpy(a.interval, r->reference.interval, sizeof a.interval);
    }
    return a;
}

/* Secants of neighbouring sizes may cross by less than their bands: towards larger sizes the threshold stays or falls,
 * going out from the reference. */
static void make_monotone(surface_result *r, int reference)
{
    for (int k = reference + 1; k < r->sizes; k++)
        if (r->size[k].velocity > r->size[k - 1].velocity) r->size[k].velocity = r->size[k - 1].velocity;
    for (int k = reference - 1; k >= 0; k--)
        if (r->size[k].velocity < r->size[k + 1].velocity) r->size[k].velocity = r->size[k + 1].velocity;
}

static void conclude(surface_search *s)
{
    surface_result *r = &s->result;
    r->sizes = s->plan->sizes;
    check_sizes(r);
    for (int k = 0; k < r->sizes; k++) {
        r->size[k] = answer_of(s, k);
        r->inferred += r->size[k].scenes == 0;
    }
    if (r->monotone) make_monotone(r, s->plan->reference);
    s->over = true;
}

static status check_plan(const surface_plan *p)
{
    CHECK(p->sizes >= 1 && p->sizes <= SURFACE_MAX_SIZES && p->reference >= 0 && p->reference < p->sizes,
          STATUS_BAD_INPUT, "threshold surface: %d sizes, a study takes 1 .. %d in a family of grains", p->sizes,
          SURFACE_MAX_SIZES);
    for (int k = 1; k < p->sizes; k++)
        CHECK(p->size[k] > p->size[k - 1], STATUS_BAD_INPUT, "threshold surface: sizes must rise, %g m follows %g m",
              p->size[k], p->size[k - 1]);
    return status_ok();
}

/* ---- the search ---- */

/* The next scene of the sizes beside the reference; none: the search is over. */
static void ask_sizes(surface_search *s)
{
    band bands[SURFACE_MAX_SIZES];
    const surface_plan *p = s->plan;
    const int most = p->search.max_scenes < THRESHOLD_MAX_SAMPLES ? p->search.max_scenes : THRESHOLD_MAX_SAMPLES;
    int k = p->reference;
    double v = 0.0;
    all_bands(s, bands);
    const bool next = s->result.samples < most &&
                      (flat_to_check(s, bands, &k, &v) || (!narrow_enough(p, bands) && best_scene(s, bands, &k, &v)) ||
                       end_to_check(p, bands, &k, &v));
    if (next)
        s->next = (surface_wanted){ p->size[k], v, s->result.reference.cells };
    else
        conclude(s);
}

static bool at_reference(const surface_search *s)
{
    return s->reference.stage != THRESHOLD_OVER;
}

static void take_answer_of_reference(surface_search *s)
{
    surface_result *r = &s->result;
    r->reference = s->reference.result;
    memcpy(r->warning, r->reference.warning, sizeof r->warning);
    r->monotone = r->reference.monotone;
}

/* What the reference search has taken up, in its order. */
static void take_reference(surface_search *s)
{
    surface_result *r = &s->result;
    while (r->samples < s->reference.result.samples) {
        r->sample[r->samples] =
            (surface_sample){ s->plan->size[s->plan->reference], s->reference.result.sample[r->samples] };
        r->samples++;
    }
}

status study_surface_begin(const surface_plan *plan, surface_search *out)
{
    memset(out, 0, sizeof *out);
    out->plan = plan;
    out->result.monotone = true;
    out->over = true;
    out->reference.stage = THRESHOLD_OVER;
    TRY(check_plan(plan));
    TRY(study_threshold_begin(&plan->search, &out->reference));
    out->over = false;
    return status_ok();
}

int study_surface_ask(const surface_search *s, surface_wanted out[THRESHOLD_TOGETHER])
{
    if (s->over) return 0;
    if (!at_reference(s)) {
        out[0] = s->next;
        return 1;
    }
    threshold_wanted wanted[THRESHOLD_TOGETHER];
    const int n = study_threshold_ask(&s->reference, wanted);
    for (int i = 0; i < n; i++)
        out[i] = (surface_wanted){ s->plan->size[s->plan->reference], wanted[i].velocity, wanted[i].cells_per_radius };
    return n;
}

status study_surface_tell(surface_search *s, const surface_sample *answer)
{
    surface_result *r = &s->result;
    CHECK(isfinite(answer->is.excess), STATUS_NUMERICAL,
          "the impact of a grain of %g m at %g m/s has no severity: its crater was not measured", answer->radius,
          answer->is.velocity);
    if (at_reference(s)) {
        TRY(study_threshold_tell(&s->reference, &answer->is));
        take_reference(s);
        if (at_reference(s)) return status_ok();
        take_answer_of_reference(s);
        ask_sizes(s);
        return status_ok();
    }
    assert(!s->over && answer->radius == s->next.radius && answer->is.velocity == s->next.velocity);
    r->sample[r->samples++] = *answer;
    ask_sizes(s);
    return status_ok();
}

static surface_size size_at(const surface_result *s, double radius)
{
    const surface_size *first = &s->size[0], *last = &s->size[s->sizes - 1];
    if (radius <= first->radius) return *first;
    if (radius >= last->radius) return *last;
    const surface_size *b = first + 1;
    while (b->radius < radius) b++;
    if (b->radius == radius) return *b;
    const surface_size *a = b - 1;
    const double f = log(radius / a->radius) / log(b->radius / a->radius);
    surface_size at = { .radius = radius };
    at.velocity = a->velocity + f * (b->velocity - a->velocity);
    for (int e = 0; e < 2; e++) at.interval[e] = a->interval[e] + f * (b->interval[e] - a->interval[e]);
    return at;
}

status study_surface_conclude(const surface_plan *plan, const surface_sample *list, int n, surface_search *out)
{
    TRY(study_surface_begin(plan, out));
    surface_result *r = &out->result;
    threshold_sample reference[THRESHOLD_MAX_SAMPLES];
    int own = 0;
    for (int i = 0; i < n && own < THRESHOLD_MAX_SAMPLES; i++)
        if (list[i].radius == plan->size[plan->reference]) reference[own++] = list[i].is;
    TRY(study_threshold_conclude(&plan->search, reference, own, &out->reference));
    take_reference(out);
    take_answer_of_reference(out);
    for (int i = 0; i < n && r->samples < THRESHOLD_MAX_SAMPLES; i++)
        if (list[i].radius != plan->size[plan->reference]) r->sample[r->samples++] = list[i];
    conclude(out);
    return status_ok();
}

void study_surface_band(const surface_result *s, double radius, double ends[2])
{
    const surface_size at = size_at(s, radius);
    ends[0] = at.interval[0] + s->reference.allowance[0];
    ends[1] = at.interval[1] - s->reference.allowance[1];
}

double study_surface_end_in_cells(const surface_result *s, const surface_size *of)
{
    return of->interval[1] - (s->reference.allowance[1] - s->reference.allowance[0]);
}

surface_size study_surface_at(const surface_result *s, double radius)
{
    surface_size at = size_at(s, radius);
    if (at.interval[0] < 0.0) at.interval[0] = 0.0;
    return at;
}
