#include "coupling/study/search/threshold.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

static const double TYPICAL = 1500.0;   /* of thresholds [m/s] */
static const double COARSE_WIDTH = 0.2; /* of the coarse bracket over its middle [1] */
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

typedef struct {
    const threshold_plan *plan;
    const threshold_source *source;
    threshold_result *out;
    double cells; /* of the stage */
    int reserved; /* scenes of the budget that are still to be asked beyond the bracket */
} search;

/* Two ends of a bracket: lo on the lower side, hi on the upper one. */
typedef struct {
    threshold_sample lo, hi;
    bool has_lo, has_hi;
} bracket;

bool study_threshold_is_upper(const threshold_sample *s)
{
    return s->class == DAMAGE_GOUGE || (s->class == DAMAGE_UNDECIDED && s->excess >= 0.0);
}

static double on_grid(const search *s, double v)
{
    const threshold_plan *p = s->plan;
    const double lowest = ceil(p->low / p->step - 1e-9), highest = floor(p->high / p->step + 1e-9);
    return p->step * fmin(fmax(round(v / p->step), lowest), highest);
}

static int budget_left(const search *s)
{
    const int most = s->plan->max_scenes < THRESHOLD_MAX_SAMPLES ? s->plan->max_scenes : THRESHOLD_MAX_SAMPLES;
    return most - s->out->samples - s->reserved;
}

static const threshold_sample *known(const search *s, double v)
{
    const threshold_result *r = s->out;
    for (int i = 0; i < r->samples; i++)
        if (r->sample[i].velocity == v && r->sample[i].cells_per_radius == s->cells) return &r->sample[i];
    return NULL;
}

static status ask(search *s, double v, threshold_sample *out)
{
    threshold_result *r = s->out;
    if (known(s, v)) {
        *out = *known(s, v);
        return status_ok();
    }
    TRY(s->source->run(s->source->user, v, s->cells, out));
    out->velocity = v;
    out->cells_per_radius = s->cells;
    CHECK(isfinite(out->excess), STATUS_NUMERICAL, "the impact at %g m/s has no severity: its crater was not measured",
          v);
    r->sample[r->samples++] = *out;
    return status_ok();
}

/* The bracket takes a value where that narrows or moves it. */
static void take(bracket *b, const threshold_sample *a)
{
    if (study_threshold_is_upper(a)) {
        b->hi = *a;
        b->has_hi = true;
    } else {
        b->lo = *a;
        b->has_lo = true;
    }
}

static status probe(search *s, double v, bracket *b)
{
    threshold_sample a;
    TRY(ask(s, on_grid(s, v), &a));
    take(b, &a);
    return status_ok();
}

/* Two at a time; one where they are the same on the grid, or the budget is short.  If the slower gouges the faster says
 * nothing of the bracket: the lowest change of side counts, and check_monotone sees the rest. */
static status probe_two(search *s, double first, double second, bracket *b)
{
    const double v[2] = { on_grid(s, fmin(first, second)), on_grid(s, fmax(first, second)) };
    threshold_sample a[2];
    if (v[0] == v[1] || budget_left(s) < 2) return probe(s, first, b);
    if (s->source->together && !known(s, v[0]) && !known(s, v[1])) s->source->together(s->source->user, v[1], s->cells);
    for (int i = 0; i < 2; i++) TRY(ask(s, v[i], &a[i]));
    take(b, &a[0]);
    if (!study_threshold_is_upper(&a[0])) take(b, &a[1]);
    return status_ok();
}

/* ---- within a bracket ---- */

static double width(const bracket *b)
{
    return b->hi.velocity - b->lo.velocity;
}

static double middle(const bracket *b)
{
    return 0.5 * (b->lo.velocity + b->hi.velocity);
}

/* Where the severity crosses its limit, by the two ends; the middle where a class contradicts the severity's sign. */
static double root(const bracket *b)
{
    const double below = -b->lo.excess, above = b->hi.excess;
    if (below <= 0.0 || above < 0.0) return middle(b);
    return b->lo.velocity + width(b) * below / (below + above);
}

/* How narrow a bracket is to be: over its middle, and in metres [1, m]. */
typedef struct {
    double velocity, place;
} widths;

/* Never where it is narrower than what the resolution leaves open. */
static bool too_wide(const search *s, widths wanted, double lo, double hi)
{
    const threshold_plan *p = s->plan;
    if (hi - lo < 1.5 * p->step || hi - lo <= p->resolution * 0.5 * (lo + hi)) return false;
    return hi - lo > wanted.velocity * 0.5 * (lo + hi) ||
           (p->place && p->place(p->place_user, hi) - p->place(p->place_user, lo) > wanted.place);
}

/* The velocity of the grid furthest from one end of a bracket towards the other that leaves no more than the wanted
 * width. */
static double reach(const search *s, widths wanted, double end, double other)
{
    const double step = end < other ? s->plan->step : -s->plan->step;
    double v = end;
    while (fabs(other - v) > 0.5 * s->plan->step && !too_wide(s, wanted, fmin(end, v + step), fmax(end, v + step)))
        v += step;
    return v;
}

/* Where one scene is enough, there.  Else the secant's root, but where an end is within reach of it, at the end's
 * reach: then the likelier side is narrow enough. */
static double next_within(const search *s, widths wanted, const bracket *b)
{
    const double up = reach(s, wanted, b->lo.velocity, b->hi.velocity);
    const double down = reach(s, wanted, b->hi.velocity, b->lo.velocity);
    return fmin(fmax(root(b), fmin(up, down)), fmax(up, down));
}

static status narrow(search *s, widths wanted, bracket *b)
{
    while (too_wide(s, wanted, b->lo.velocity, b->hi.velocity) && budget_left(s) > 0)
        TRY(probe(s, next_within(s, wanted, b), b));
    return status_ok();
}

/* ---- the stages ---- */

static bool complete(const bracket *b)
{
    return b->has_lo && b->has_hi;
}

/* Away from the side that is known, a step and then as far again as it has come, to a change of side or the end of the
 * range. */
static status widen(search *s, double step, bracket *b)
{
    double gone = 0.0;
    while (!complete(b) && budget_left(s) > 0) {
        const double from = b->has_hi ? b->hi.velocity : b->lo.velocity, away = fmax(step, gone);
        const double to = on_grid(s, b->has_hi ? from - away : from + away);
        if (to == from) return status_ok();
        TRY(probe(s, to, b));
        gone += fabs(to - from);
    }
    return status_ok();
}

static status coarse_stage(search *s, widths wanted, bracket *b)
{
    const threshold_plan *p = s->plan;
    const double quarter = 0.25 * (p->high - p->low);
    s->cells = p->coarse;
    TRY(probe_two(s, p->low + quarter, p->high - quarter, b));
    TRY(widen(s, COARSE_WIDTH * (b->has_hi ? b->hi.velocity : b->lo.velocity), b));
    return complete(b) ? narrow(s, wanted, b) : status_ok();
}

/* The search itself never looks beyond its bracket, so it cannot see a function that turns back: one coarse scene on
 * each side, half way to the end of the range, looks there, unless one of the search's lies far enough out.  Planned
 * when the coarse bracket is known, asked for last. */
typedef struct {
    int n;
    double at[2]; /* [m/s] */
} beyond;

/* Has a scene of this resolution been asked so far outside of the bracket, above or below? */
static bool has_looked(const search *s, const bracket *b, bool above, double far)
{
    for (int i = 0; i < s->out->samples; i++) {
        const threshold_sample *a = &s->out->sample[i];
        if (a->cells_per_radius != s->cells) continue;
        if (above ? a->velocity >= b->hi.velocity + far : a->velocity <= b->lo.velocity - far) return true;
    }
    return false;
}

static beyond plan_beyond(const search *s, const bracket *b, int reserve)
{
    const threshold_plan *p = s->plan;
    const double at[2] = { 0.5 * (b->lo.velocity + p->low), 0.5 * (b->hi.velocity + p->high) };
    const double gap[2] = { b->lo.velocity - p->low, p->high - b->hi.velocity }, far = BEYOND_GAP * middle(b);
    beyond r = { .n = 0 };
    for (int above = 0; above < 2; above++) {
        if (gap[above] < far || has_looked(s, b, above, far) || budget_left(s) < reserve + r.n) continue;
        r.at[r.n++] = on_grid(s, at[above]);
    }
    return r;
}

static status look_beyond(search *s, const beyond *far)
{
    bracket seen = { .has_lo = false };
    s->cells = s->plan->coarse;
    s->reserved = 0;
    if (far->n == 1) return probe(s, far->at[0], &seen);
    return far->n == 2 ? probe_two(s, far->at[0], far->at[1], &seen) : status_ok();
}

static status fine_stage(search *s, double expected, widths wanted, bracket *b)
{
    const threshold_plan *p = s->plan;
    const double half = fmax(p->step, 0.5 * p->interval * expected);
    s->cells = p->fine;
    TRY(probe(s, expected - half, b));
    TRY(widen(s, 2.0 * half, b));
    return complete(b) ? narrow(s, wanted, b) : status_ok();
}

/* ---- the answer ---- */

/* Where the line between two scenes has this excess; the first where it does not cross it in between. */
static double crossing(const threshold_sample *a, const threshold_sample *b, double excess)
{
    const double share = (excess - a->excess) / (b->excess - a->excess);
    return share > 0.0 && share <= 1.0 ? a->velocity + share * (b->velocity - a->velocity) : a->velocity;
}

/* The next scene of the stage and of the same side, away from the bracket; NULL: none. */
static const threshold_sample *further_out(const search *s, const threshold_sample *from)
{
    const bool upper = study_threshold_is_upper(from);
    const threshold_sample *next = NULL;
    for (int i = 0; i < s->out->samples; i++) {
        const threshold_sample *a = &s->out->sample[i];
        const double way = upper ? a->velocity - from->velocity : from->velocity - a->velocity;
        if (a->cells_per_radius != s->cells || study_threshold_is_upper(a) != upper || !(way > 0.0)) continue;
        if (!next || way < fabs(next->velocity - from->velocity)) next = a;
    }
    return next;
}

/* From an end of the bracket outwards to the first decided scene of its side; where the scatter of the excess is known,
 * only to where the line from the last undecided one leaves it. */
static double decided_end(const search *s, const threshold_sample *end)
{
    const threshold_sample *decided = end, *undecided = end;
    const double scatter = study_threshold_is_upper(end) ? s->plan->scatter : -s->plan->scatter;
    while (decided && decided->class == DAMAGE_UNDECIDED) {
        undecided = decided;
        decided = further_out(s, decided);
    }
    if (!decided) return end->velocity;
    return decided != end && scatter != 0.0 ? crossing(decided, undecided, scatter) : decided->velocity;
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

static void check_monotone(threshold_result *r, double cells)
{
    double highest_lower = -INFINITY, lowest_upper = INFINITY;
    for (int i = 0; i < r->samples; i++) {
        const threshold_sample *a = &r->sample[i];
        if (a->cells_per_radius != cells) continue;
        if (study_threshold_is_upper(a))
            lowest_upper = fmin(lowest_upper, a->velocity);
        else
            highest_lower = fmax(highest_lower, a->velocity);
    }
    r->monotone = r->monotone && highest_lower < lowest_upper;
    if (highest_lower < lowest_upper) return;
    warn(r,
         "gouging turns back (%g cells a radius): above its limit at %g m/s, below it at %g m/s; the interval spans "
         "both",
         cells, lowest_upper, highest_lower);
    r->interval[0] = fmin(r->interval[0], lowest_upper);
    r->interval[1] = fmax(r->interval[1], highest_lower);
}

static void one_sided(const search *s, const bracket *b, threshold_result *r)
{
    const double grid_low = on_grid(s, s->plan->low), grid_high = on_grid(s, s->plan->high);
    r->outcome = THRESHOLD_UNKNOWN;
    if (b->has_hi) r->bracket[1] = b->hi.velocity;
    if (b->has_lo) r->bracket[0] = b->lo.velocity;
    r->allowance = s->plan->resolution * (b->has_hi ? b->hi.velocity : b->has_lo ? b->lo.velocity : 0.0);
    r->interval[0] = r->bracket[0] - r->allowance;
    r->interval[1] = r->bracket[1] + r->allowance;
    if (b->has_hi && b->hi.velocity == grid_low) r->outcome = THRESHOLD_BELOW;
    if (b->has_lo && b->lo.velocity == grid_high) r->outcome = THRESHOLD_ABOVE;
}

static void conclude(const search *s, const bracket *b, threshold_result *r)
{
    if (!complete(b)) {
        one_sided(s, b, r);
        return;
    }
    r->outcome = THRESHOLD_FOUND;
    r->velocity = root(b);
    r->bracket[0] = b->lo.velocity;
    r->bracket[1] = b->hi.velocity;
    r->interval[0] = decided_end(s, &b->lo);
    r->interval[1] = decided_end(s, &b->hi);
    check_monotone(r, s->plan->coarse);
    if (s->cells != s->plan->coarse) check_monotone(r, s->cells);
    r->allowance = fmax(s->plan->resolution * r->velocity, isnan(r->shift) ? 0.0 : fabs(r->shift));
    r->interval[0] -= r->allowance;
    r->interval[1] += r->allowance;
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
static double driven(const bracket *coarse, const bracket *fine)
{
    const double from = root(coarse);
    if (fine->has_hi && fine->hi.velocity < from) return fine->hi.velocity - from;
    if (fine->has_lo && fine->lo.velocity > from) return fine->lo.velocity - from;
    return NAN;
}

/* The coarse stage's answer, where the fine one was short of scenes: as far off as that has seen. */
static void conclude_short(const search *s, const bracket *coarse, const bracket *fine, threshold_result *out)
{
    const threshold_plan *p = s->plan;
    out->shift = driven(coarse, fine);
    conclude(s, coarse, out);
    warn(out, "study.max_scenes = %d spent before %g cells a radius had a bracket: the threshold is that of %g cells",
         p->max_scenes, p->fine, p->coarse);
    if (isnan(out->shift)) return;
    out->velocity += out->shift;
    warn(out, "moved to %g m/s, where %g cells %s", out->velocity, p->fine,
         out->shift < 0.0 ? "still gouge" : "do not gouge yet");
}

status study_threshold_search(const threshold_plan *plan, const threshold_source *source, threshold_result *out)
{
    memset(out, 0, sizeof *out);
    out->velocity = out->shift = NAN;
    out->interval[0] = out->interval[1] = out->bracket[0] = out->bracket[1] = NAN;
    out->monotone = true;
    TRY(check_plan(plan));
    search s = { .plan = plan, .source = source, .out = out };
    bracket coarse = { .has_lo = false }, fine = { .has_lo = false };
    const widths wanted = { plan->interval, plan->place_interval },
                 rough = { fmax(COARSE_WIDTH, plan->interval), INFINITY };
    TRY(coarse_stage(&s, plan->fine != plan->coarse ? rough : wanted, &coarse));
    const bool two_stages = plan->fine != plan->coarse && complete(&coarse);
    const beyond far = complete(&coarse) ? plan_beyond(&s, &coarse, two_stages ? FINE_RESERVE : 1) : (beyond){ .n = 0 };
    s.reserved = far.n;
    if (two_stages && budget_left(&s) > 0) TRY(fine_stage(&s, root(&coarse), wanted, &fine));
    TRY(look_beyond(&s, &far));
    const bool short_of_scenes = two_stages && !complete(&fine) && budget_left(&s) <= 0;
    if (complete(&fine)) out->shift = root(&fine) - root(&coarse);
    s.cells = two_stages && !short_of_scenes ? plan->fine : plan->coarse;
    out->cells = s.cells;
    if (short_of_scenes)
        conclude_short(&s, &coarse, &fine, out);
    else
        conclude(&s, two_stages ? &fine : &coarse, out);
    return status_ok();
}
