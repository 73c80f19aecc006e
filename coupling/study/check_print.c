/* SPDX-License-Identifier: BSD-3-Clause */
/* What `breech check` prints: the commands that the case is ready for, each scene's size and time, the searches'. */
#include "coupling/study/check.h"

#include "coupling/host/machine.h"
#include "coupling/host/table.h"
#include "coupling/study/scene_doubts.h"
#include "coupling/study/search/family.h"
#include "coupling/study/study.h"

#include <math.h>

unsigned study_check_needs(const case_inputs *in)
{
    const case_given *g = &in->given;
    /* a charge that is to be found for the velocity of an arrival: `breech shot` knows none */
    const bool arrival =
        g->strike && g->optimise && in->optimise.goal == CIRCUIT_FIRING_VELOCITY && isnan(in->optimise.muzzle_velocity);
    unsigned needs = 0;
    for (int k = 0; k < CIRCUIT_SUPPLY_KINDS; k++)
        if (g->supplies[k] && !arrival) needs |= CASE_FOR_SHOT;
    if (g->sites || g->populations) needs |= CASE_FOR_ONSET;
    if (g->treatments) needs |= CASE_FOR_COMPARE;
    if (g->projectile && g->scene && (!isnan(in->onset.impact.scene.velocity) || !(needs & CASE_FOR_ONSET)))
        needs |= CASE_FOR_SCENE;
    if (g->bodies) needs |= CASE_FOR_SCENE;
    if (g->strike) needs |= CASE_FOR_STRIKE;
    if (g->targets) needs |= CASE_FOR_TARGETS;
    if (g->life) needs |= CASE_FOR_LIFE;
    if (g->vessel) needs |= CASE_FOR_VESSEL;
    if (g->rails) needs |= CASE_FOR_INDUCTANCE;
    if (g->sweep) needs |= CASE_FOR_SWEEP;
    return needs;
}

/* What the random shots draw at most: grains too slow to gouge are not drawn. */
static void print_random(const case_onset *c, FILE *out)
{
    double grains = 0.0;
    for (int k = 0; k < c->populations.n; k++) {
        const case_population *p = &c->populations.item[k];
        grains += p->density * (p->to - p->from) * (p->renewed ? c->study.shots : 1);
    }
    char time[40];
    grains *= c->study.sampled;
    host_duration_text(grains * CHECK_SECONDS_A_GRAIN, time, sizeof time);
    if (grains > 0.0)
        fprintf(out, "random shots: %d histories, at most %.2g grains, %s\n", c->study.sampled, grains, time);
}

/* A line of its own with the time of so many scenes, or "". */
static const char *search_time(const scene_estimate *e, int n, int scenes, char text[100])
{
    const double seconds = study_check_search_time(e, n, scenes);
    char time[40];
    text[0] = '\0';
    if (isnan(seconds)) return text;
    host_duration_text(seconds, time, sizeof time);
    snprintf(text, 100, "\n  likely some %s for so many scenes, one after the other", time);
    return text;
}

/* The commands whose needs are all among those that were checked. */
static void print_ready(const case_inputs *in, unsigned needs, FILE *out)
{
    int n = 0;
    fputs("ready for: ", out);
    for (int i = 0; i < STUDIES; i++)
        if ((study_for(study_list[i], in)->needs & ~needs) == 0)
            fprintf(out, "%s%s", n++ ? ", " : "breech ", study_list[i]->name);
    fputs(n ? "\n" : "no command yet; breech --help COMMAND says what each needs\n", out);
}

/* What scenes side by side take together, where a command that the case is ready for would have several. */
static void print_together(const check_machine *on, const case_inputs *in, unsigned needs, FILE *out)
{
    bool many = false;
    for (int i = 0; i < STUDIES; i++) {
        const study *y = study_for(study_list[i], in);
        many |= y->many_scenes && (y->needs & ~needs) == 0;
    }
    const int asked = on->processes, n = asked < on->fit ? asked : on->fit;
    if (!many || n < 1 || asked < 2) return;
    fprintf(
        out,
        "memory: %d scene%s side by side take %.2f GB, twice that where each has put one off for another; there are "
        "%.1f GB\n",
        n, n == 1 ? "" : "s", 1e-9 * n * (double)on->largest, 1e-9 * host_memory(""));
    if (n < asked) fprintf(out, "warning: for %d processes there is no memory: %d compute scenes\n", asked, n);
}

static status print_estimates(const scene_estimate *e, int n, FILE *out)
{
    table *t;
    if (n == 0) return status_ok();
    TRY(host_table_create("scene|points|memory [GB]|steps|time, at least|likely", &t));
    for (int i = 0; i < n; i++) {
        const mpm_needs *at = &e[i].needs;
        char time[40], likely[40] = "-";
        host_duration_text(e[i].seconds, time, sizeof time);
        if (!isnan(e[i].likely)) host_duration_text(e[i].likely, likely, sizeof likely);
        host_table_row(t, "%s|%zu|%.2f|%.0f|%s|%s", e[i].what, at->particles, 1e-9 * (double)at->bytes, e[i].steps,
                       time, likely);
    }
    host_table_print(t, out);
    host_table_free(t);
    return status_ok();
}

/* How many scenes the searches take at most, and how long that is. */
static void print_searches(const case_inputs *in, const scene_estimate *e, int n, FILE *out)
{
    const case_onset *c = &in->onset;
    char whole[80] = "", text[100];
    const int craters = c->study.judge == JUDGE_GROWTH ? c->study.craters * study_family_kinds(c) : 0;
    if (craters > 0) snprintf(whole, sizeof whole, ", of which %d are kept for whole craters (study.craters)", craters);
    if (c->study.ensemble > 0) fprintf(out, "scene: on %d grids, each as above\n", c->study.ensemble);
    if (c->sites.n > 0 || c->populations.n > 0)
        fprintf(out, "onset: %d site%s, %d population%s, at most %d scenes%s%s\n", c->sites.n,
                c->sites.n == 1 ? "" : "s", c->populations.n, c->populations.n == 1 ? "" : "s", c->study.max_scenes,
                whole, search_time(e, n, c->study.max_scenes, text));
    if (in->treatments.n > 0 && c->sites.n + c->populations.n > 0)
        fprintf(out, "compare: %d surfaces, at most %d scenes each%s%s\n", in->treatments.n + 1, c->study.max_scenes,
                whole, search_time(e, n, (in->treatments.n + 1) * c->study.max_scenes, text));
    print_random(c, out);
}

status study_check_print(const case_inputs *in, const check_machine *on, unsigned needs, FILE *out)
{
    scene_estimate e[CHECK_MAX_ESTIMATES];
    int n = 0;
    double rate;
    TRY(study_check(in, on->threads, e, &n, &rate));
    fprintf(out, "%s: %s\n", in->path, in->title[0] ? in->title : in->name);
    print_ready(in, needs, out);
    fputs(in->warnings, out);
    study_check_thin_layers(in, out);
    study_scene_doubts_print(in, out);
    TRY(print_estimates(e, n, out));
    if (n > 0) study_check_assumptions(in, on->threads, rate, out);
    print_together(on, in, needs, out);
    study_check_searches(in, out);
    print_searches(in, e, n, out);
    return status_ok();
}
