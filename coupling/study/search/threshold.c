/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/study/search/threshold.h"

#include <assert.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

static const double TYPICAL = 1500.0;   /* of thresholds [m/s] */
static const double COARSE_WIDTH = 0.2; /* of the coarse bracket over its middle [1] */
static const double ENOUGH = 0.1;       /* of a bracket over its middle, however much cells leave open [1] */
static const double BEYOND_GAP =
    0.15;                  /* of the threshold: a narrower stretch beside the bracket is not looked at [1] */
enum { FINE_RESERVE = 6 }; /* scenes left for the fine stage, one beyond included */

double study_threshold_step(double interval)
{
    static const double nice[] = { 5.0, 2.5, 1.0 };
    const double wanted = 0.5 * interval * TYPICAL, decade = pow(10.0, floor(log10(wanted)));
    for (int i = 0; i < 2; i++)
        if (nice[i] * decade <= wanted * (1.0 + 1e-12)) return nice[i] * decade;
    return nice[2] * decade;
}

/* ---- asking ---- */

bool study_threshold_is_upper(const threshold_sample *s)
{
    return s->class == DAMAGE_GOUGE || (s->class == DAMAGE_UNDECIDED && s->excess >= 0.0);
}

static double on_grid(const threshold_search *s, double v)
{
    const threshold_plan *p = s->plan;
    const double lowest = ceil(p->low / p->step - 1e-9), highest = floor(p->high / p->step + 1e-9);
    return p->step * fmin(fmax(round(v / p->step), lowest), highest);
}

static int budget_left(const threshold_search *s)
{
    const int most = s->plan->max_scenes < THRESHOLD_MAX_SAMPLES ? s->plan->max_scenes : THRESHOLD_MAX_SAMPLES;
    if (s->stopped) return 0;
    return most - s->result.samples - s->reserved;
}

static const threshold_sample *known(const threshold_search *s, double v)
{
    const threshold_result *r = &s->result;
    for (int i = 0; i < r->samples; i++)
        if (r->sample[i].velocity == v && r->sample[i].cells_per_radius == s->cells) return &r->sample[i];
    return NULL;
}

/* One scene of the question, answered already if the search has it. */
static void need(threshold_search *s, double v)
{
    const threshold_sample *seen = known(s, v), open = { .velocity = v, .cells_per_radius = s->cells };
    s->asked[s->n_asked] = seen ? *seen : open;
    s->told[s->n_asked++] = seen != NULL;
}

static void need_one(threshold_search *s, double v)
{
    need(s, on_grid(s, v));
}

/* Two at a time; one where they are the same on the grid, or the budget is short. */
static void need_two(threshold_search *s, double first, double second)
{
    const double v[2] = { on_grid(s, fmin(first, second)), on_grid(s, fmax(first, second)) };
    if (v[0] == v[1] || budget_left(s) < 2) {
        need_one(s, first);
        return;
    }
    need(s, v[0]);
    need(s, v[1]);
}

/* The bracket takes a value where that narrows or moves it. */
static void take(threshold_bracket *b, const threshold_sample *a)
{
    if (study_threshold_is_upper(a)) {
        b->hi = *a;
        b->has_hi = true;
    } else {
        b->lo = *a;
        b->has_lo = true;
    }
}

/* If the slower of two gouges the faster says nothing of the bracket: the lowest change of side counts, and
 * check_monotone sees the rest. */
static void take_all(threshold_bracket *b, const threshold_sample *answer, int n)
{
    take(b, &answer[0]);
    if (n == 2 && !study_threshold_is_upper(&answer[0])) take(b, &answer[1]);
}

/* ---- within a bracket ---- */

static double width(const threshold_bracket *b)
{
    return b->hi.velocity - b->lo.velocity;
}

static double middle(const threshold_bracket *b)
{
    return 0.5 * (b->lo.velocity + b->hi.velocity);
}

/* Where the severity crosses its limit, by the two ends; the middle where a class contradicts the severity's sign. */
static double root(const threshold_bracket *b)
{
    const double below = -b->lo.excess, above = b->hi.excess;
    if (below <= 0.0 || above < 0.0) return middle(b);
    return b->lo.velocity + width(b) * below / (below + above);
}

/* How narrow a bracket is to be: over its middle, and in metres [1, m]. */
typedef struct {
    double velocity, place;
} widths;

/* Never where it is narrower than what the resolution leaves open; of that ENOUGH counts, since a bracket's width is in
 * the interval whole, and what cells leave open is one of several squares (uncertain.h). */
static bool too_wide(const threshold_search *s, widths wanted, double lo, double hi)
{
    const threshold_plan *p = s->plan;
    if (hi - lo < 1.5 * p->step || hi - lo <= fmin(p->resolution, ENOUGH) * 0.5 * (lo + hi)) return false;
    return hi - lo > wanted.velocity * 0.5 * (lo + hi) ||
           (p->place && p->place(p->place_user, hi) - p->place(p->place_user, lo) > wanted.place);
}

/* The velocity of the grid furthest from one end of a bracket towards the other that leaves no more than the wanted
 * width. */
static double reach(const threshold_search *s, widths wanted, double end, double other)
{
    const double step = end < other ? s->plan->step : -s->plan->step;
    double v = end;
    while (fabs(other - v) > 0.5 * s->plan->step && !too_wide(s, wanted, fmin(end, v + step), fmax(end, v + step)))
        v += step;
    return v;
}

/* Where one scene is enough, there.  Else the secant's root, but where an end is within reach of it, at the end's
 * reach: then the likelier side is narrow enough. */
static double next_within(const threshold_search *s, widths wanted, const threshold_bracket *b)
{
    const double up = reach(s, wanted, b->lo.velocity, b->hi.velocity);
    const double down = reach(s, wanted, b->hi.velocity, b->lo.velocity);
    return fmin(fmax(root(b), fmin(up, down)), fmax(up, down));
}

static bool complete(const threshold_bracket *b)
{
    return b->has_lo && b->has_hi;
}

/* Has a scene of this resolution been asked so far outside of the bracket, above or below? */
static bool has_looked(const threshold_search *s, const threshold_bracket *b, bool above, double far)
{
    for (int i = 0; i < s->result.samples; i++) {
        const threshold_sample *a = &s->result.sample[i];
        if (a->cells_per_radius != s->cells) continue;
        if (above ? a->velocity >= b->hi.velocity + far : a->velocity <= b->lo.velocity - far) return true;
    }
    return false;
}

/* The lower of the first two scenes of a search [m/s]. */
static double lower_start(const threshold_plan *p)
{
    return p->low + 0.25 * (p->high - p->low);
}

/* Where a search for a lower threshold widens to (ask_further_out), at `most` or below: its scenes are then known.
 * Half way from the bracket to the end of the range, where that search would come to the end. */
static double beyond_below(const threshold_search *s, double most)
{
    const threshold_plan *p = s->plan;
    const double first = on_grid(s, lower_start(p)), stride = COARSE_WIDTH * first, lowest = on_grid(s, p->low);
    double at = first;
    while (at > most && at > lowest) at = on_grid(s, at - fmax(stride, first - at));
    return at > lowest && at <= most ? at : 0.5 * (s->coarse.lo.velocity + p->low);
}

/* The search itself never looks beyond its bracket, so it cannot see a function that turns back: one coarse scene on
 * each side looks there, unless one of the search's lies far enough out: above half way to the end of the range, below
 * where a search for a lower threshold would look.  Planned when the coarse bracket is known, asked for last. */
static void plan_beyond(threshold_search *s, int reserve)
{
    const threshold_plan *p = s->plan;
    const threshold_bracket *b = &s->coarse;
    const double gap[2] = { b->lo.velocity - p->low, p->high - b->hi.velocity }, far = BEYOND_GAP * middle(b);
    const double at[2] = { beyond_below(s, b->lo.velocity - far), 0.5 * (b->hi.velocity + p->high) };
    for (int above = 0; above < 2; above++) {
        if (gap[above] < far || has_looked(s, b, above, far) || budget_left(s) < reserve + s->n_beyond) continue;
        s->beyond[s->n_beyond++] = on_grid(s, at[above]);
    }
    s->reserved = s->n_beyond;
}

/* ---- the answer ---- */

/* Where the line between two scenes has this excess; the first where it does not cross it in between. */
static double crossing(const threshold_sample *a, const threshold_sample *b, double excess)
{
    const double share = (excess - a->excess) / (b->excess - a->excess);
    return share > 0.0 && share <= 1.0 ? a->velocity + share * (b->velocity - a->velocity) : a->velocity;
}

/* The next scene of the same cells and of the same side, away from the bracket; NULL: none. */
static const threshold_sample *further_out(const threshold_sample *list, int n, const threshold_sample *from)
{
    const bool upper = study_threshold_is_upper(from);
    const threshold_sample *next = NULL;
    for (int i = 0; i < n; i++) {
        const threshold_sample *a = &list[i];
        const double way = upper ? a->velocity - from->velocity : from->velocity - a->velocity;
        if (a->cells_per_radius != from->cells_per_radius || study_threshold_is_upper(a) != upper || !(way > 0.0))
            continue;
        if (!next || way < fabs(next->velocity - from->velocity)) next = a;
    }
    return next;
}

double study_threshold_decided_end(const threshold_plan *p, const threshold_sample *list, int n,
                                   const threshold_sample *end)
{
    const threshold_sample *decided = end, *undecided = end;
    const double scatter = study_threshold_is_upper(end) ? p->scatter : -p->scatter;
    while (decided && decided->class == DAMAGE_UNDECIDED) {
        undecided = decided;
        decided = further_out(list, n, decided);
    }
    if (!decided) return NAN;
    return decided != end && scatter != 0.0 ? crossing(decided, undecided, scatter) : decided->velocity;
}

double study_threshold_furthest_end(const threshold_sample *list, int n, const threshold_sample *end)
{
    const threshold_sample *furthest = end;
    for (; end; end = further_out(list, n, end)) furthest = end;
    return furthest->velocity;
}

static double decided_end(const threshold_search *s, const threshold_sample *end)
{
    return study_threshold_decided_end(s->plan, s->result.sample, s->result.samples, end);
}

static void warn(threshold_result *r, const char *format, ...)
{
    const size_t used = strlen(r->warning);
    va_list args;
    va_start(args, format);
    if (used + 2 < sizeof r->warning) {
        if (used) strcat(r->warning, "; ");
        vsnprintf(r->warning + strlen(r->warning), sizeof r->warning - strlen(r->warning), format, args);
    }
    va_end(args);
}

/* Where a fast scene lies below the limit and a slow one above it the interval spans both; if no scene beyond the fast
 * one, of whatever cells, lies above the limit, its upper end is not known. */
static void check_monotone(threshold_result *r, double cells)
{
    double fast = -INFINITY, slow = INFINITY, fastest_upper = -INFINITY;
    for (int i = 0; i < r->samples; i++) {
        const threshold_sample *a = &r->sample[i];
        const bool upper = study_threshold_is_upper(a), counts = a->cells_per_radius == cells;
        if (upper) fastest_upper = fmax(fastest_upper, a->velocity);
        if (counts && upper) slow = fmin(slow, a->velocity);
        if (counts && !upper) fast = fmax(fast, a->velocity);
    }
    r->monotone = r->monotone && fast < slow;
    if (fast < slow) return;
    if (!isnan(r->interval[0])) r->interval[0] = fmin(r->interval[0], slow);
    if (!isnan(r->interval[1])) r->interval[1] = fastest_upper > fast ? fmax(r->interval[1], fast) : NAN;
    warn(r,
         "gouging turns back (%g cells a radius): above its limit at %g m/s, below it at %g m/s; %s "
         "(is it the place of the grid? study.threshold_ensemble: 5 tells its scatter, more cells lessen it)",
         cells, slow, fast,
         isnan(r->interval[1]) ? "no faster one is above it, so the interval is open" : "the interval spans both");
}

static void check_turns(threshold_search *s)
{
    check_monotone(&s->result, s->plan->coarse);
    if (s->cells != s->plan->coarse) check_monotone(&s->result, s->cells);
}

/* The interval of a threshold near v reaches further by what finer cells may change, by `least` at least. */
static void allow(threshold_result *r, const threshold_plan *p, double v, double least)
{
    for (int side = 0; side < 2; side++) {
        const double share = side ? fmax(p->above, p->resolution) : p->resolution;
        r->allowance[side] = r->of_cells[side] = fmax(share * v, least);
        r->interval[side] += side ? r->allowance[1] : -r->allowance[0];
    }
}

static void one_sided(threshold_search *s, const threshold_bracket *b)
{
    threshold_result *r = &s->result;
    const double grid_low = on_grid(s, s->plan->low), grid_high = on_grid(s, s->plan->high);
    r->outcome = THRESHOLD_UNKNOWN;
    if (b->has_hi) r->bracket[1] = b->hi.velocity, r->interval[1] = decided_end(s, &b->hi);
    if (b->has_lo) r->bracket[0] = b->lo.velocity, r->interval[0] = decided_end(s, &b->lo);
    check_turns(s);
    allow(r, s->plan, b->has_hi ? b->hi.velocity : b->has_lo ? b->lo.velocity : 0.0, 0.0);
    if (b->has_hi && b->hi.velocity == grid_low) r->outcome = THRESHOLD_BELOW;
    if (b->has_lo && b->lo.velocity == grid_high) r->outcome = THRESHOLD_ABOVE;
    if (r->outcome != THRESHOLD_UNKNOWN) return;
    warn(r, "study.max_scenes spent before a scene %s the threshold was seen", b->has_hi ? "below" : "above");
}

static void conclude(threshold_search *s, const threshold_bracket *b)
{
    threshold_result *r = &s->result;
    if (!complete(b)) {
        one_sided(s, b);
        return;
    }
    r->outcome = THRESHOLD_FOUND;
    r->velocity = root(b);
    r->bracket[0] = b->lo.velocity;
    r->bracket[1] = b->hi.velocity;
    for (int side = 0; side < 2; side++) {
        const threshold_sample *end = side ? &b->hi : &b->lo;
        r->interval[side] = decided_end(s, end);
        if (!isnan(r->interval[side])) continue;
        r->interval[side] = study_threshold_furthest_end(r->sample, r->samples, end);
        warn(r, "no scene %s %g m/s decides: the interval ends at the %s that was computed", side ? "from" : "up to",
             r->bracket[side], side ? "fastest" : "slowest");
    }
    check_turns(s);
    allow(r, s->plan, r->velocity, isnan(r->shift) ? 0.0 : fabs(r->shift));
}

static status check_plan(const threshold_plan *p)
{
    CHECK(p->low > 0.0 && p->high > p->low && p->step > 0.0 && p->interval > 0.0, STATUS_BAD_INPUT,
          "threshold: the range %g .. %g m/s in steps of %g m/s to an interval of %g is empty", p->low, p->high,
          p->step, p->interval);
    CHECK(floor(p->high / p->step + 1e-9) > ceil(p->low / p->step - 1e-9), STATUS_BAD_INPUT,
          "threshold: study.velocity_low = %g m/s and velocity_high = %g m/s hold fewer than two velocities %g m/s "
          "apart: "
          "widen them or lower study.velocity_interval",
          p->low, p->high, p->step);
    CHECK(p->max_scenes >= 1, STATUS_BAD_INPUT, "study.max_scenes = %d: at least 1", p->max_scenes);
    return status_ok();
}

/* How far the fine scenes of one side have driven the root off the coarse one, at least; NaN: not at all. */
static double driven(const threshold_bracket *coarse, const threshold_bracket *fine)
{
    const double from = root(coarse);
    if (fine->has_hi && fine->hi.velocity < from) return fine->hi.velocity - from;
    if (fine->has_lo && fine->lo.velocity > from) return fine->lo.velocity - from;
    return NAN;
}

/* The coarse pass's answer, where the fine one was short of scenes: as far off as that has seen, and open on the side
 * to which it has driven the root. */
static void conclude_short(threshold_search *s)
{
    const threshold_plan *p = s->plan;
    threshold_result *r = &s->result;
    r->shift = driven(&s->coarse, &s->refined);
    conclude(s, &s->coarse);
    if (!isnan(r->shift)) r->interval[r->shift > 0.0] = NAN;
    warn(r, "study.max_scenes spent before %g cells a radius had a bracket: the threshold is that of %g cells", p->fine,
         p->coarse);
    if (isnan(r->shift)) return;
    r->velocity += r->shift;
    warn(r, "moved to %g m/s, where %g cells %s", r->velocity, p->fine,
         r->shift < 0.0 ? "still gouge" : "do not gouge yet");
}

static bool has_two_passes(const threshold_search *s)
{
    return s->plan->fine != s->plan->coarse && complete(&s->coarse);
}

static void conclude_all(threshold_search *s)
{
    const bool two = has_two_passes(s), found = complete(&s->refined);
    const bool short_of_scenes = two && !found && budget_left(s) <= 0;
    if (found) s->result.shift = root(&s->refined) - root(&s->coarse);
    s->cells = two && !short_of_scenes ? s->plan->fine : s->plan->coarse;
    s->result.cells = s->cells;
    if (short_of_scenes)
        conclude_short(s);
    else
        conclude(s, two ? &s->refined : &s->coarse);
    s->stage = THRESHOLD_OVER;
}

/* ---- the search, stage by stage ---- */

static threshold_bracket *bracket_of(threshold_search *s)
{
    return s->fine ? &s->refined : &s->coarse;
}

/* Half of the wanted interval around the coarse root [m/s]. */
static double half_interval(const threshold_search *s)
{
    return fmax(s->plan->step, 0.5 * s->plan->interval * root(&s->coarse));
}

/* Coarse: a quarter of the range from both its ends.  Fine: half the wanted interval below the coarse root. */
static void ask_first(threshold_search *s)
{
    const threshold_plan *p = s->plan;
    s->cells = s->fine ? p->fine : p->coarse;
    if (s->fine)
        need_one(s, root(&s->coarse) - half_interval(s));
    else
        need_two(s, lower_start(p), p->high - 0.25 * (p->high - p->low));
}

static void begin_widening(threshold_search *s)
{
    const threshold_bracket *b = bracket_of(s);
    s->stride = s->fine ? 2.0 * half_interval(s) : COARSE_WIDTH * (b->has_hi ? b->hi.velocity : b->lo.velocity);
    s->gone = 0.0;
    s->stage = THRESHOLD_WIDEN;
}

/* Away from the side that is known, a stride and then as far again as it has come, to a change of side or the end of
 * the range.  Nothing is asked once that is reached. */
static void ask_further_out(threshold_search *s)
{
    const threshold_bracket *b = bracket_of(s);
    if (complete(b) || budget_left(s) <= 0) return;
    const double from = b->has_hi ? b->hi.velocity : b->lo.velocity, away = fmax(s->stride, s->gone);
    const double to = on_grid(s, b->has_hi ? from - away : from + away);
    if (to == from) return;
    need_one(s, to);
    s->gone += fabs(to - from);
}

/* To the wanted widths; where a second pass follows, the first need not be as narrow. */
static void ask_within(threshold_search *s)
{
    const threshold_plan *p = s->plan;
    const threshold_bracket *b = bracket_of(s);
    const widths rough = { fmax(COARSE_WIDTH, p->interval), INFINITY }, last = { p->interval, p->place_interval };
    const widths wanted = s->fine || p->fine == p->coarse ? last : rough;
    if (complete(b) && too_wide(s, wanted, b->lo.velocity, b->hi.velocity) && budget_left(s) > 0)
        need_one(s, next_within(s, wanted, b));
}

/* After the coarse pass comes the fine one, after the last the scenes beyond the bracket. */
static void end_pass(threshold_search *s)
{
    const bool two = has_two_passes(s);
    if (!s->fine && complete(&s->coarse)) plan_beyond(s, two ? FINE_RESERVE : 1);
    s->stage = THRESHOLD_BEYOND;
    if (s->fine || !two || budget_left(s) <= 0) return;
    s->fine = true;
    s->stage = THRESHOLD_START;
}

static void ask_beyond(threshold_search *s)
{
    s->cells = s->plan->coarse;
    s->reserved = 0;
    if (s->n_beyond == 1) need_one(s, s->beyond[0]);
    if (s->n_beyond == 2) need_two(s, s->beyond[0], s->beyond[1]);
}

/* The next question, or the next stage where this one has none left. */
static void ask_next(threshold_search *s)
{
    switch (s->stage) {
    case THRESHOLD_START: ask_first(s); break;
    case THRESHOLD_WIDEN:
        ask_further_out(s);
        if (s->n_asked == 0) s->stage = THRESHOLD_NARROW;
        break;
    case THRESHOLD_NARROW:
        ask_within(s);
        if (s->n_asked == 0) end_pass(s);
        break;
    case THRESHOLD_BEYOND:
        ask_beyond(s);
        if (s->n_asked == 0) conclude_all(s);
        break;
    case THRESHOLD_OVER: break;
    }
}

/* The whole question is answered: its scenes in the order in which they were asked for, and what they say. */
static void take_answers(threshold_search *s)
{
    threshold_result *r = &s->result;
    for (int i = 0; i < s->n_asked; i++)
        if (!known(s, s->asked[i].velocity)) r->sample[r->samples++] = s->asked[i];
    if (s->stage != THRESHOLD_BEYOND) take_all(bracket_of(s), s->asked, s->n_asked);
    s->n_asked = 0;
    if (s->stage == THRESHOLD_START) begin_widening(s);
    if (s->stage == THRESHOLD_BEYOND) conclude_all(s);
}

static bool all_told(const threshold_search *s)
{
    for (int i = 0; i < s->n_asked; i++)
        if (!s->told[i]) return false;
    return true;
}

/* To the next question that is open, or to the end. */
static void go_on(threshold_search *s)
{
    while (s->stage != THRESHOLD_OVER && all_told(s)) {
        if (s->n_asked > 0) take_answers(s);
        if (s->n_asked == 0) ask_next(s);
    }
}

status study_threshold_begin(const threshold_plan *plan, threshold_search *out)
{
    memset(out, 0, sizeof *out);
    threshold_result *r = &out->result;
    r->velocity = r->shift = NAN;
    r->interval[0] = r->interval[1] = r->bracket[0] = r->bracket[1] = NAN;
    r->monotone = true;
    out->plan = plan;
    out->stage = THRESHOLD_OVER;
    TRY(check_plan(plan));
    out->stage = THRESHOLD_START;
    go_on(out);
    return status_ok();
}

int study_threshold_ask(const threshold_search *s, threshold_wanted out[THRESHOLD_TOGETHER])
{
    int n = 0;
    for (int i = 0; i < s->n_asked; i++)
        if (!s->told[i]) out[n++] = (threshold_wanted){ s->asked[i].velocity, s->asked[i].cells_per_radius };
    return n;
}

status study_threshold_tell(threshold_search *s, const threshold_sample *answer)
{
    int i = 0;
    while (i < s->n_asked && (s->told[i] || s->asked[i].velocity != answer->velocity)) i++;
    assert(i < s->n_asked && s->cells == answer->cells_per_radius);
    CHECK(isfinite(answer->excess), STATUS_NUMERICAL,
          "the impact at %g m/s has no severity: its crater was not measured", answer->velocity);
    s->asked[i] = *answer;
    s->told[i] = true;
    go_on(s);
    return status_ok();
}

/* The lowest change of side of all scenes of these cells. */
static threshold_bracket bracket_in(const threshold_result *r, double cells)
{
    threshold_bracket b = { .has_lo = false };
    for (int side = 1; side >= 0; side--) /* the upper one first */
        for (int i = 0; i < r->samples; i++) {
            const threshold_sample *a = &r->sample[i];
            if (a->cells_per_radius != cells || study_threshold_is_upper(a) != side) continue;
            if (side ? !b.has_hi || a->velocity < b.hi.velocity
                     : (!b.has_hi || a->velocity < b.hi.velocity) && (!b.has_lo || a->velocity > b.lo.velocity))
                take(&b, a);
        }
    return b;
}

status study_threshold_conclude(const threshold_plan *plan, const threshold_sample *list, int n, threshold_search *out)
{
    TRY(study_threshold_begin(plan, out));
    threshold_result *r = &out->result;
    for (int i = 0; i < n && r->samples < THRESHOLD_MAX_SAMPLES; i++) r->sample[r->samples++] = list[i];
    out->coarse = bracket_in(r, plan->coarse);
    if (plan->fine != plan->coarse) out->refined = bracket_in(r, plan->fine);
    out->stopped = true;
    out->n_asked = 0;
    conclude_all(out);
    return status_ok();
}
