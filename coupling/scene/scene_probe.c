/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/scene/scene_probe.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const summary_key scene_probe_keys[] = {
    SUMMARY_TEXT(scene_probe_result, "name", name, "of the probe"),
    SUMMARY_TEXT(scene_probe_result, "kind", kind, "of the probe"),
    SUMMARY_TEXT(scene_probe_result, "quantity", quantity,
                 "that the next keys are about, the size of a vector; empty: a map"),
    SUMMARY_TEXT(scene_probe_result, "unit", unit, "its unit"),
    SUMMARY_NUMBER(scene_probe_result, "peak", peak, "", "largest value, as computed"),
    SUMMARY_NUMBER(scene_probe_result, "time_of_peak", peak_time, "s", "when"),
    SUMMARY_NUMBER(scene_probe_result, "least", least, "", "smallest value"),
    SUMMARY_NUMBER(scene_probe_result, "arrival", arrival, "s",
                   "when it had first changed by a tenth of its largest change; null: never"),
    SUMMARY_VECTOR(scene_probe_result, "impulse", impulse, 3, "",
                   "integral over time, of each component of a vector; null beside that of one number"),
    SUMMARY_BY_NAME(scene_probe_result, "last", last, column, columns, "", "all columns at the end"),
    SUMMARY_BY_NAME(scene_probe_result, "mean", mean, column, columns, "", "all columns, mean over the time"),
    SUMMARY_END,
};

/* ---- the series ---- */

static const double SAMPLES = 1000.0; /* of a scene's time, of what is not read after every step */

typedef struct {
    int series;
    double last;        /* time of its last row, -1: it has none [s] */
    double *row, *read; /* a row of the series; the probe as it is read; owned */
} record;

struct scene_probes {
    history *history;
    const char *name;
    const mpm_scene *scene;
    record *record; /* [scene->probes] */
};

static bool is_map(const mpm_probe *p)
{
    return mpm_probe_rows(p) > 1;
}

static status read_column(const scene_probes *p, const char *probe, const char *column, double **values, size_t *n)
{
    char path[200];
    size_t dims[H5_MAX_RANK];
    snprintf(path, sizeof path, "probes/%s/%s", probe, column);
    TRY(output_history_read(p->history, p->name, path, values, dims));
    *n = dims[0];
    return status_ok();
}

static status open_series(const scene_probes *p, const mpm_probe *probe, int *series)
{
    char path[280];
    history_column column[1 + SCENE_PROBE_COLUMNS] = { { "time", "s", "time" } };
    int width[1 + SCENE_PROBE_COLUMNS] = { 1 }, n = mpm_probe_columns(probe);
    CHECK(n <= SCENE_PROBE_COLUMNS, STATUS_BAD_INPUT, "probe `%s`: %d columns, at most %d", probe->name, n,
          SCENE_PROBE_COLUMNS);
    for (int c = 0; c < n; c++) {
        const mpm_column *k = &probe->kind->columns[c];
        column[1 + c] = (history_column){ k->name, k->unit, k->doc };
        width[1 + c] = mpm_probe_rows(probe);
    }
    snprintf(path, sizeof path, "/scene/%.95s/probes/%s", p->name, probe->name);
    return output_history_arrays(p->history, path, column, width, n + 1, series);
}

/* Rows later than the time reached are written anew. */
static status open_record(const scene_probes *p, const mpm_probe *probe, double reached, record *r)
{
    const size_t values = (size_t)mpm_probe_rows(probe) * (size_t)mpm_probe_columns(probe);
    double *time;
    size_t n;
    r->row = calloc(1 + values, sizeof *r->row);
    r->read = calloc(values, sizeof *r->read);
    CHECK(r->row && r->read, STATUS_MEMORY, "probe `%s`: no memory for %zu values", probe->name, values);
    TRY(open_series(p, probe, &r->series));
    TRY(output_history_rewind(p->history, r->series, reached < 0.0 ? -1.0 : reached * (1.0 + 1e-9)));
    TRY(read_column(p, probe->name, "time", &time, &n));
    r->last = n > 0 ? time[n - 1] : -1.0;
    free(time);
    return status_ok();
}

status scene_probes_open(history *h, const char *name, const mpm_scene *scene, double reached, scene_probes **out)
{
    scene_probes *p = *out = calloc(1, sizeof *p);
    CHECK(p, STATUS_MEMORY, "no memory for %d probes", scene->probes);
    *p = (scene_probes){ .history = h, .name = name, .scene = scene };
    p->record = calloc((size_t)scene->probes + 1, sizeof *p->record);
    CHECK(p->record, STATUS_MEMORY, "no memory for %d probes", scene->probes);
    for (int i = 0; i < scene->probes; i++) TRY(open_record(p, &scene->probe[i], reached, &p->record[i]));
    return status_ok();
}

static status append(const scene_probes *p, const mpm *m, double now, const mpm_probe *probe, record *r)
{
    const int rows = mpm_probe_rows(probe), columns = mpm_probe_columns(probe);
    double *value = r->row;
    TRY(mpm_probe_read(m, probe, r->read));
    *value++ = r->last = now;
    for (int c = 0; c < columns; c++)
        for (int i = 0; i < rows; i++) *value++ = r->read[i * columns + c];
    return output_history_append(p->history, r->series, r->row);
}

status scene_probes_step(scene_probes *p, const mpm *m)
{
    const double now = mpm_glance(m).time, interval = p->scene->end_time / SAMPLES;
    for (int i = 0; i < p->scene->probes; i++) {
        const mpm_probe *probe = &p->scene->probe[i];
        record *r = &p->record[i];
        if (now > r->last && !is_map(probe) && (probe->kind->of_step || now - r->last >= interval))
            TRY(append(p, m, now, probe, r));
    }
    return status_ok();
}

status scene_probes_piece(scene_probes *p, const mpm *m)
{
    const double now = mpm_glance(m).time;
    for (int i = 0; i < p->scene->probes; i++)
        if (now > p->record[i].last) TRY(append(p, m, now, &p->scene->probe[i], &p->record[i]));
    return status_ok();
}

void scene_probes_free(scene_probes *p)
{
    if (!p) return;
    for (int i = 0; p->record && i < p->scene->probes; i++) free(p->record[i].row), free(p->record[i].read);
    free(p->record);
    free(p);
}

/* ---- what they came to ---- */

/* value: [n] of each of the kind's main columns. */
static double quantity(double *const value[3], int mains, size_t i)
{
    if (mains == 1) return value[0][i];
    return sqrt(value[0][i] * value[0][i] + value[1][i] * value[1][i] + value[2][i] * value[2][i]);
}

static void sum_up(const double *t, double *const value[3], int mains, size_t n, scene_probe_result *out)
{
    double first = NAN, change = 0.0;
    for (size_t i = 0; i < n; i++) {
        const double q = quantity(value, mains, i);
        if (isnan(q)) continue;
        if (isnan(first)) first = q;
        if (!(q <= out->peak)) out->peak = q, out->peak_time = t[i];
        out->least = fmin(out->least, q);
        change = fmax(change, fabs(q - first));
    }
    for (size_t i = 0; i < n && change > 0.0 && isnan(out->arrival); i++)
        if (fabs(quantity(value, mains, i) - first) >= 0.1 * change) out->arrival = t[i];
    for (int k = 0; k < mains; k++) {
        out->impulse[k] = 0.0;
        for (size_t i = 1; i < n; i++)
            if (!isnan(value[k][i])) out->impulse[k] += value[k][i] * (t[i] - t[i - 1]);
    }
}

/* While there was something to read, each value for the time up to it. */
static double mean_over_time(const double *t, const double *value, size_t n)
{
    double sum = 0.0, time = 0.0;
    for (size_t i = 1; i < n; i++) {
        if (isnan(value[i])) continue;
        sum += value[i] * (t[i] - t[i - 1]);
        time += t[i] - t[i - 1];
    }
    return time > 0.0 ? sum / time : NAN;
}

static status sum_up_series(const scene_probes *p, const mpm_probe *probe, scene_probe_result *out)
{
    const mpm_probe_kind *kind = probe->kind;
    double *t = NULL, *value[3] = { NULL };
    size_t n = 0, m = 0;
    status done = read_column(p, probe->name, "time", &t, &n);
    for (int k = 0; k < kind->mains && done.code == STATUS_OK; k++)
        done = read_column(p, probe->name, kind->columns[kind->main + k].name, &value[k], &m);
    if (done.code == STATUS_OK && m == n) sum_up(t, value, kind->mains, n, out);
    for (int c = 0; c < out->columns && done.code == STATUS_OK; c++) {
        double *all;
        done = read_column(p, probe->name, kind->columns[c].name, &all, &m);
        if (done.code == STATUS_OK && m > 0) out->last[c] = all[m - 1];
        if (done.code == STATUS_OK && m == n) out->mean[c] = mean_over_time(t, all, n);
        if (done.code == STATUS_OK) free(all);
    }
    free(t);
    for (int k = 0; k < 3; k++) free(value[k]);
    return done;
}

/* "force" of force_x, force_y, force_z */
static void name_quantity(const mpm_probe_kind *kind, scene_probe_result *out)
{
    if (kind->mains == 0) return;
    const char *column = kind->columns[kind->main].name;
    const size_t length = strlen(column), cut = kind->mains == 3 && length > 2 ? length - 2 : length;
    snprintf(out->quantity, sizeof out->quantity, "%.*s", (int)cut, column);
    snprintf(out->unit, sizeof out->unit, "%s", kind->columns[kind->main].unit);
}

static status result_of(const scene_probes *p, const mpm_probe *probe, scene_probe_result *out)
{
    *out = (scene_probe_result){ .peak = NAN, .peak_time = NAN, .least = NAN, .arrival = NAN };
    for (int k = 0; k < 3; k++) out->impulse[k] = NAN;
    snprintf(out->name, sizeof out->name, "%s", probe->name);
    snprintf(out->kind, sizeof out->kind, "%s", probe->kind->name);
    name_quantity(probe->kind, out);
    if (is_map(probe)) return status_ok();
    out->columns = mpm_probe_columns(probe);
    for (int c = 0; c < out->columns; c++) {
        snprintf(out->column[c], sizeof out->column[c], "%s", probe->kind->columns[c].name);
        out->last[c] = out->mean[c] = NAN;
    }
    return sum_up_series(p, probe, out);
}

status scene_probes_end(scene_probes *p, scene_probe_result *out)
{
    for (int i = 0; i < p->scene->probes; i++) {
        TRY(result_of(p, &p->scene->probe[i], &out[i]));
        TRY(output_history_end(p->history, p->record[i].series));
    }
    return status_ok();
}

/* ---- the manual ---- */

void scene_probe_print_columns(FILE *out)
{
    for (int i = 0; mpm_probe_kind_at(i); i++) {
        const mpm_probe_kind *k = mpm_probe_kind_at(i);
        fprintf(out, "\n### probe: %s\n\n%s\n\n| column | units | what |\n|---|---|---|\n", k->name, k->doc);
        for (const mpm_column *c = k->columns; c->name; c++)
            fprintf(out, "| `%s` | %s | %s |\n", c->name, c->unit, c->doc);
    }
}
