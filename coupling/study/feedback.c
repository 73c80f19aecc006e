#include "coupling/study/feedback.h"

#include "coupling/study/gouge_law.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- the shot with what the gouges take ---- */

enum { PIECES = 20 }; /* of the barrel, for gouges of populations */

/* What gouges of this volume in all take at v; nothing where no scene left a crater. */
static site_jump taken_by(const onset_answer *a, const grain_family *f, double v, double volume)
{
    gouge_mark mark;
    const bool known = gouge_mark_at(f, a->grains.c->scene.limit_severity, v, &mark) && mark.volume > 0.0;
    const double share = known ? volume / mark.volume : 0.0;
    return (site_jump){ share * mark.impulse, share * mark.metal };
}

static int list_jumps(const onset_answer *a, site_jump *jump)
{
    int taken = 0;
    for (int i = 0; i < a->result.n_sites; i++) {
        if (a->site[i].outcome != SITE_GOUGE) continue;
        const grain_family *f = &a->grains.family[a->grains.of_site[i]];
        if (isnan(a->site[i].gouged_volume)) continue;
        jump[i] = taken_by(a, f, a->site[i].velocity, a->site[i].gouged_volume);
        taken++;
    }
    return taken;
}

static double velocity_at(const shot_outcome *flown, double x)
{
    int k = 0;
    while (k + 1 < flown->n_trace && flown->trace[k].x < x) k++;
    return flown->n_trace > 0 ? flown->trace[k].v : 0.0;
}

/* The first family of a population that can gouge; NULL if there is none. */
static const grain_family *strewn_family(const grain_families *g)
{
    for (int k = 0; k < g->c->populations.n; k++)
        if (g->of_population[k] >= 0) return &g->family[g->of_population[k]];
    return NULL;
}

/* What populations are expected to take, piece by piece, as sites behind those of the list. */
static int strewn_jumps(const onset_answer *a, case_site *site, site_jump *jump)
{
    const grain_family *f = strewn_family(&a->grains);
    const mc_shot *drawn = &a->drawn.of[0];
    const double length = a->grains.c->barrel.length;
    int n = 0;
    for (int p = 0; f && p < PIECES; p++) {
        double gouges = 0.0;
        for (int k = 0; k < MC_BINS / PIECES; k++) gouges += drawn->strewn[p * (MC_BINS / PIECES) + k];
        const double x = length * (p + 0.5) / PIECES;
        if (!(gouges > 0.0)) continue;
        site[n] = (case_site){ .position = x, .radius = f->plan.size[f->plan.reference] };
        jump[n++] = taken_by(a, f, velocity_at(&a->flown, x), gouges * drawn->volume / drawn->gouges);
    }
    return n;
}

static status fly_with(session *s, const onset_answer *a, const case_sites *sites, const site_jump *jump,
                       double *muzzle)
{
    breech_case c = *a->grains.c; /* borrows all but the sites */
    shot_outcome again;
    shot_record record;
    c.sites = *sites;
    const status done = session_shot(s, &c, jump, false, &again, &record);
    *muzzle = record.is.muzzle_velocity;
    shot_outcome_free(&again);
    return done;
}

status feedback_shot(session *s, onset_answer *a)
{
    const int n = a->result.n_sites;
    if (!a->grains.c->study.feedback) return status_ok();
    site_jump *jump = calloc((size_t)n + PIECES, sizeof *jump);
    case_site *site = calloc((size_t)n + PIECES, sizeof *site);
    status done = jump && site ? status_ok() : status_error(STATUS_MEMORY, "no memory for %d sites", n);
    if (done.code == STATUS_OK) {
        for (int i = 0; i < n; i++) site[i] = a->grains.c->sites.item[i];
        const int listed = list_jumps(a, jump), strewn = strewn_jumps(a, site + n, jump + n);
        const case_sites all = { n + strewn, site };
        if (listed + strewn > 0) done = fly_with(s, a, &all, jump, &a->result.muzzle_velocity_feedback);
    }
    free(jump);
    free(site);
    return done;
}

/* ---- sensitivities ---- */

static const double CHANGE = 0.05; /* relative */

typedef struct {
    const char *input;
    void (*change)(breech_case *c, double factor); /* of a copy that owns its supplies; NULL: the grains' size */
} changed_input;

/* What a kind of supply is charged to; a given current is not charged. */
typedef struct {
    size_t size, charge; /* of the kind's struct; offset of the double in it */
} supply_charge;

static const supply_charge charges[SUPPLY_KINDS] = {
    [SUPPLY_capacitor] = { sizeof(shot_module), offsetof(shot_module, charge) },
    [SUPPLY_inductor] = { sizeof(supply_inductor), offsetof(supply_inductor, current) },
    [SUPPLY_homopolar] = { sizeof(supply_homopolar), offsetof(supply_homopolar, speed) },
    [SUPPLY_alternator] = { sizeof(supply_alternator), offsetof(supply_alternator, speed) },
};

static void change_charge(breech_case *c, double factor)
{
    for (int k = 0; k < SUPPLY_KINDS; k++)
        for (int i = 0; charges[k].size && i < c->supplies[k].n; i++) {
            char *group = (char *)c->supplies[k].item + (size_t)i * charges[k].size;
            *(double *)(void *)(group + charges[k].charge) *= factor;
        }
}

static void change_mass(breech_case *c, double factor)
{
    c->armature.mass *= factor;
}

static void change_friction(breech_case *c, double factor)
{
    c->armature.friction_dry *= factor;
    c->armature.friction_melted *= factor;
    c->armature.film_viscosity *= factor;
}

static const changed_input inputs[] = {
    { "charge of the supplies", change_charge },
    { "armature.mass", change_mass },
    { "armature.friction", change_friction },
    { "grain size", NULL },
};
enum { INPUTS = sizeof inputs / sizeof inputs[0], SURFACES = INPUTS + 1 };

static status own_supplies(const breech_case *from, breech_case *c)
{
    for (int k = 0; k < SUPPLY_KINDS; k++)
        if (charges[k].size) c->supplies[k].item = NULL;
    for (int k = 0; k < SUPPLY_KINDS; k++) {
        const size_t bytes = (size_t)from->supplies[k].n * charges[k].size;
        if (bytes == 0) continue;
        c->supplies[k].item = malloc(bytes);
        CHECK(c->supplies[k].item, STATUS_MEMORY, "no memory for the supplies");
        memcpy(c->supplies[k].item, from->supplies[k].item, bytes);
    }
    return status_ok();
}

/* The shot with one input changed; of grain size the shot as it was. */
static status fly_changed(session *s, const onset_answer *a, const changed_input *input, shot_outcome *flown,
                          shot_record *record)
{
    breech_case c = *a->grains.c;
    *record = a->shot;
    if (!input->change) return status_ok();
    const status done = own_supplies(a->grains.c, &c);
    if (done.code == STATUS_OK) input->change(&c, 1.0 + CHANGE);
    const status shot_done = done.code == STATUS_OK ? session_shot(s, &c, NULL, false, flown, record) : done;
    for (int k = 0; k < SUPPLY_KINDS; k++)
        if (charges[k].size) free(c.supplies[k].item);
    return shot_done;
}

static void conclude(const onset_answer *a, const shot_outcome *flown, const shot_record *record,
                     const mc_result *drawn, int k)
{
    onset_sensitivity *out = &a->sensitivity[k];
    trace_point at;
    const double v = a->result.threshold_velocity;
    snprintf(out->input, sizeof out->input, "%s", inputs[k].input);
    out->change = CHANGE;
    out->muzzle_velocity = record->is.muzzle_velocity;
    out->threshold_position = v > 0.0 && trace_at_velocity(flown, v, &at) ? at.x : NAN;
    /* of both the mean over the same random numbers: what differs is the input's doing */
    out->expected_gouges = a->result.expected_gouges + (drawn->of[k + 1].gouges - drawn->of[0].gouges);
}

static status draw_all(onset_answer *a, const grain_families *changed, mc_result *drawn)
{
    const breech_case *c = a->grains.c;
    mc_surface surface[SURFACES];
    surface[0] = (mc_surface){ .grains = &a->grains, .size_factor = 1.0 };
    for (int k = 0; k < INPUTS; k++)
        surface[k + 1] = (mc_surface){ .grains = &changed[k], .size_factor = inputs[k].change ? 1.0 : 1.0 + CHANGE };
    const mc_plan plan = { .histories = c->study.sampled / 10 + 1,
                           .shots = 1,
                           .seed = c->study.seed,
                           .length = c->barrel.length,
                           .n = SURFACES,
                           .surface = surface };
    return mc_run(&plan, drawn);
}

status sensitivities_run(session *s, onset_answer *a)
{
    shot_outcome flown[INPUTS] = { { .site = NULL } };
    shot_record record[INPUTS];
    grain_families changed[INPUTS]; /* the same families in another shot */
    mc_result drawn = { .of = NULL };
    status done = status_ok();
    if (!a->grains.c->study.sensitivities || a->grains.n == 0) return done;
    a->sensitivity = calloc(INPUTS, sizeof *a->sensitivity);
    CHECK(a->sensitivity, STATUS_MEMORY, "no memory for the sensitivities");
    for (int k = 0; k < INPUTS && done.code == STATUS_OK; k++) {
        done = fly_changed(s, a, &inputs[k], &flown[k], &record[k]);
        changed[k] = a->grains;
        changed[k].flown = inputs[k].change ? &flown[k] : &a->flown;
    }
    if (done.code == STATUS_OK) done = draw_all(a, changed, &drawn);
    for (int k = 0; k < INPUTS && done.code == STATUS_OK; k++) conclude(a, changed[k].flown, &record[k], &drawn, k);
    if (done.code == STATUS_OK) {
        a->result.sensitivities = a->sensitivity;
        a->result.n_sensitivities = INPUTS;
    }
    for (int k = 0; k < INPUTS; k++) shot_outcome_free(&flown[k]);
    mc_free(&drawn);
    return done;
}
