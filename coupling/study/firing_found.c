/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/study/firing_found.h"

#include <stdlib.h>
#include <string.h>

static const double PEAK_CLOSE = 0.01; /* over the wished peak, as far as its weight in the search lets it [1] */

typedef struct {
    session *session;
    char note[SUMMARY_NAME_SIZE];
} trial_keeper;

static status keep(void *user, const circuit_firing_trial *trial)
{
    const trial_keeper *k = user;
    return run_session_note_add(k->session, k->note, trial, sizeof *trial);
}

/* Goes on from the trials that are noted.  The search has a copy of them: the note grows. */
static status search(session *s, const circuit_firing_wish *wish, const char *prefix, const circuit_shot_config *c,
                     firing_found *out)
{
    trial_keeper keeper = { .session = s };
    snprintf(keeper.note, sizeof keeper.note, "%.80strials", prefix);
    const session_note *note = run_session_note(s, keeper.note);
    const size_t bytes = note ? note->bytes : 0;
    circuit_firing_trial *known = malloc(bytes + 1);
    CHECK(known, STATUS_MEMORY, "no memory for the trials of a search");
    if (bytes > 0) memcpy(known, note->data, bytes);
    const circuit_firing_host host = {
        .stop = s->stop, .n_known = (int)(bytes / sizeof *known), .known = known, .keep = keep, .user = &keeper
    };
    const status done = circuit_firing_resume(c, wish, &host, out->modules, &out->is);
    free(known);
    return done;
}

status study_firing_find(session *s, const circuit_firing_wish *wish, const char *prefix, case_flight *flight,
                         firing_found *out)
{
    circuit_supply_list *bank = &flight->launcher.supplies[CIRCUIT_SUPPLY_capacitor];
    const size_t n = (size_t)bank->n;
    const double since = host_wall_clock();
    out->modules = malloc((n + 1) * sizeof *out->modules);
    out->fire_at = malloc((n + 1) * sizeof *out->fire_at);
    CHECK(out->modules && out->fire_at, STATUS_MEMORY, "no memory for %zu groups", n);
    host_progress_task(&s->progress, "search for firing times", 0.0, 0);
    TRY(search(s, wish, prefix, &flight->launcher, out));
    host_timing_add(&s->timing, "firing times", host_wall_clock() - since);
    out->n = bank->n;
    for (int k = 0; k < out->n; k++) out->fire_at[k] = out->modules[k].fire_at;
    bank->item = out->modules;
    return status_ok();
}

void study_firing_free(firing_found *f)
{
    free(f->modules);
    free(f->fire_at);
}

void study_firing_record(session *s, const circuit_firing_wish *wish, const firing_found *f, shot_record *record)
{
    const double peak = record->is.peak_current;
    record->firing = f->is;
    record->n_fire_at = f->n;
    record->fire_at = f->fire_at;
    if (peak > (1.0 + PEAK_CLOSE) * wish->peak_current) /* NAN: no peak was wished */
        run_session_warn(
            s,
            "optimise.peak_current = %.4g kA: with what was found in %d trials the peak is %.4g kA, %.3g %% "
            "above it; let it search longer (optimise.evaluations), from other firing times, or charge less",
            1e-3 * wish->peak_current, f->is.evaluations, 1e-3 * peak, 100.0 * (peak / wish->peak_current - 1.0));
}
