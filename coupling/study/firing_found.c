/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/study/firing_found.h"

#include <stdlib.h>

static const double PEAK_CLOSE = 0.01; /* over the wished peak, as far as its weight in the search lets it [1] */

status study_firing_find(session *s, const circuit_firing_wish *wish, case_flight *flight, firing_found *out)
{
    circuit_supply_list *bank = &flight->launcher.supplies[CIRCUIT_SUPPLY_capacitor];
    const size_t n = (size_t)bank->n;
    const double since = host_wall_clock();
    out->modules = malloc((n + 1) * sizeof *out->modules);
    out->fire_at = malloc((n + 1) * sizeof *out->fire_at);
    CHECK(out->modules && out->fire_at, STATUS_MEMORY, "no memory for %zu groups", n);
    host_progress_task(&s->progress, "search for firing times", 0.0, 0);
    TRY(circuit_firing_optimise(&flight->launcher, wish, s->stop, out->modules, &out->is));
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
