/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/study/feedback.h"

#include "coupling/study/sampling/gouge_law.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- the shot with what the gouges take ---- */

/* What gouges of this volume in all take at v; nothing where no scene left a crater. */
static site_jump taken_by(const onset_answer *a, const grain_family *f, double v, double volume)
{
    gouge_mark mark;
    const bool known = study_gouge_mark_at(f, &a->grains.c->impact, v, &mark) && mark.volume > 0.0;
    const double share = known ? volume / mark.volume : 0.0;
    return (site_jump){ share * mark.impulse, share * mark.metal };
}

static int list_jumps(const onset_answer *a, site_jump *jump)
{
    int taken = 0;
    for (int i = 0; i < a->result.n_sites; i++) {
        if (a->site[i].outcome != SITE_GOUGE) continue;
        const grain_family *f = &a->grains.family[study_family_of_site(&a->grains, i)];
        if (isnan(a->site[i].gouged_volume)) continue;
        jump[i] = taken_by(a, f, a->site[i].velocity, a->site[i].gouged_volume);
        taken++;
    }
    return taken;
}

/* What the grains of all populations in a piece of the barrel are expected to take, each population by its own family;
 * nothing where no crater of that was computed. */
static site_jump strewn_jump(const onset_answer *a, int piece, double v)
{
    const mc_result *drawn = &a->drawn;
    site_jump all = { 0.0, 0.0 };
    for (int k = 0; k < drawn->populations; k++) {
        const mc_strewn *of = &drawn->strewn[k * MC_PIECES + piece]; /* the first shot on the first surface */
        const int family = a->grains.of_population[k];
        if (family < 0 || !(of->volume > 0.0)) continue;
        const site_jump one = taken_by(a, &a->grains.family[family], v, of->volume);
        all.impulse += one.impulse;
        all.mass_loss += one.mass_loss;
    }
    return all;
}

/* What populations are expected to take, piece by piece, as sites behind those of the list: in the middle of what of a
 * piece the armature passes. */
static int strewn_jumps(const onset_answer *a, case_site *site, site_jump *jump)
{
    const double piece = a->grains.c->launcher.barrel.length / MC_PIECES, start = a->grains.c->launcher.barrel.start;
    int n = 0;
    for (int p = 0; p < MC_PIECES; p++) {
        const double x = 0.5 * (fmax(piece * p, start) + piece * (p + 1));
        if (!(x > start)) continue;
        const site_jump taken = strewn_jump(a, p, gouge_trace_velocity(&a->flown, x));
        if (!(taken.impulse > 0.0 || taken.mass_loss > 0.0)) continue;
        site[n] = (case_site){ .position = x };
        jump[n++] = taken;
    }
    return n;
}

static status fly_with(session *s, const onset_answer *a, const case_sites *sites, const site_jump *jump,
                       double *muzzle)
{
    case_flight flight = case_flight_of(a->grains.c);
    shot_outcome again;
    shot_record record;
    flight.site = sites->item;
    flight.n_sites = sites->n;
    const status done = gouge_session_shot(s, &flight, jump, false, &again, &record);
    *muzzle = record.is.muzzle_velocity;
    gouge_shot_outcome_free(&again);
    return done;
}

status study_feedback_shot(session *s, onset_answer *a)
{
    const int n = a->result.n_sites;
    if (!a->grains.c->study.feedback) return status_ok();
    site_jump *jump = calloc((size_t)n + MC_PIECES, sizeof *jump);
    case_site *site = calloc((size_t)n + MC_PIECES, sizeof *site);
    status done = jump && site ? status_ok() : base_status_error(STATUS_MEMORY, "no memory for %d sites", n);
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
