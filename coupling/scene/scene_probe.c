#include "coupling/scene/scene_probe.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

const summary_key scene_probe_keys[] = {
    SUMMARY_TEXT(scene_probe_result, "name", name, "of the probe"),
    SUMMARY_NUMBER(scene_probe_result, "peak", is.peak, "N", "largest size of the force, as computed"),
    SUMMARY_NUMBER(scene_probe_result, "time_of_peak", is.peak_time, "s", "when"),
    SUMMARY_NUMBER(scene_probe_result, "arrival", is.arrival, "s", "when it was first not zero; null: never"),
    SUMMARY_VECTOR(scene_probe_result, "impulse", is.impulse, 3, "N s", "so far"),
    SUMMARY_END,
};

typedef struct {
    char text[PARAM_TEXT_SIZE + 10];
} column_name;

static status open_named(history *h, const char *group, const scene_probes *probes, history_column *column,
                         column_name *name, int *series)
{
    int c = 0;
    column[c++] = (history_column){ "time", "s", "time" };
    for (int i = 0; i < probes->n; i++)
        for (int k = 0; k < 3; k++, c++) {
            snprintf(name[c].text, sizeof name[c].text, "%s/force_%c", probes->item[i].name, "xyz"[k]);
            column[c] = (history_column){ name[c].text, "N", "by contact, mean over a step, as computed" };
        }
    return output_history_series(h, group, column, c, series);
}

status scene_probe_series(history *h, const char *scene, const scene_probes *probes, double reached, int *series)
{
    char group[200];
    const size_t columns = 1 + 3 * (size_t)probes->n;
    snprintf(group, sizeof group, "/scene/%.150s/probes", scene);
    history_column *column = calloc(columns, sizeof *column);
    column_name *name = calloc(columns, sizeof *name);
    const status done = column && name ? open_named(h, group, probes, column, name, series)
                                       : base_status_error(STATUS_MEMORY, "no memory for %d probes", probes->n);
    free(column);
    free(name);
    TRY(done);
    return output_history_rewind(h, *series, reached);
}

void scene_probe_step(const scene_probes *probes, double since, const mpm_report *now, scene_probe_state *state,
                      double *row)
{
    *row++ = now->time;
    for (int i = 0; i < probes->n; i++) {
        scene_probe_state *s = &state[i];
        const double *f = now->contact_force[probes->item[i].group];
        const double size = sqrt(f[0] * f[0] + f[1] * f[1] + f[2] * f[2]);
        if (size > s->peak) s->peak = size, s->peak_time = now->time;
        if (size > 0.0 && isnan(s->arrival)) s->arrival = now->time;
        for (int k = 0; k < 3; k++) {
            s->impulse[k] += f[k] * (now->time - since);
            *row++ = f[k];
        }
    }
}
