/* Summaries for people: the closing tables, and the manual's list of keys. */
#include "coupling/host/table.h"
#include "coupling/output/summary_keys.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static void value_text(const summary_key *k, const void *from, char *out, size_t size)
{
    cJSON *value = output_summary_value_json(k, from);
    char *json = value ? cJSON_PrintUnformatted(value) : NULL;
    if (cJSON_IsNumber(value))
        snprintf(out, size, "%.6g", value->valuedouble);
    else if (cJSON_IsString(value))
        snprintf(out, size, "%s", value->valuestring);
    else if (!value || cJSON_IsNull(value))
        snprintf(out, size, "-");
    else
        snprintf(out, size, "%s", json ? json : "-");
    free(json);
    cJSON_Delete(value);
}

/* Short values only: lists are printed by the functions below, reasons by the caller. */
static void print_keys_table(const summary_key *keys, const void *from, FILE *out)
{
    table *t;
    if (!from || host_table_create("result|value|unit", &t).code != STATUS_OK) return;
    for (const summary_key *k = keys; k->name; k++) {
        char value[400];
        if (k->kind == KEY_LIST || k->kind == KEY_ARRAY || k->kind == KEY_BY_BODY || strcmp(k->name, "reason") == 0)
            continue;
        value_text(k, from, value, sizeof value);
        for (char *c = value; *c; c++)
            if (*c == '|') *c = '/';
        host_table_row(t, "%s|%.90s|%s", k->name, value, strcmp(k->unit, "1") == 0 ? "" : k->unit);
    }
    host_table_print(t, out);
    host_table_free(t);
}

/* A blank line, the table, and its end. */
static void close_table(table *t, FILE *out)
{
    fputc('\n', out);
    host_table_print(t, out);
    host_table_free(t);
}

/* x in units of `unit`, "-" where there is none. */
static const char *cell(double x, double unit, const char *format, char text[24])
{
    if (isfinite(x))
        snprintf(text, 24, format, x / unit);
    else
        snprintf(text, 24, "-");
    return text;
}

static void print_sites(const onset_result *o, FILE *out)
{
    table *t;
    if (o->n_sites == 0 ||
        host_table_create("site|x [m]|v [m/s]|I [kA]|p [GPa]|p/H|outcome|scene", &t).code != STATUS_OK)
        return;
    for (int i = 0; i < o->n_sites; i++) {
        const onset_site *s = &o->site[i];
        char x[24], v[24], current[24], p[24], h[24];
        host_table_row(t, "%d|%s|%s|%s|%s|%s|%s|%s", i + 1, cell(s->position, 1.0, "%.3f", x),
                       cell(s->velocity, 1.0, "%.0f", v), cell(s->current, 1e3, "%.0f", current),
                       cell(s->impact_pressure, 1e9, "%.2f", p), cell(s->screen, 1.0, "%.1f", h),
                       output_site_outcome_names[s->outcome], s->scene);
    }
    close_table(t, out);
}

static void print_scenes(const onset_result *o, FILE *out)
{
    table *t;
    const char *titles = "scene|v [m/s]|r [mm]|cells/r|severity|growth [1/us]|widening|depth [mm]|class|time [s]";
    if (o->n_scenes == 0 || host_table_create(titles, &t).code != STATUS_OK) return;
    for (int i = 0; i < o->n_scenes; i++) {
        const onset_scene *s = &o->scene[i];
        char v[24], r[24], c[24], severity[24], growth[24], widening[24], d[24], w[24];
        host_table_row(t, "%s|%s|%s|%s|%s|%s|%s|%s|%s|%s", s->name, cell(s->velocity, 1.0, "%.0f", v),
                       cell(s->radius, 1e-3, "%.3g", r), cell(s->cells_per_radius, 1.0, "%.3g", c),
                       cell(s->gauged ? NAN : s->result.severity, 1.0, "%.3f", severity),
                       cell(s->result.groove_growth, 1e6, "%.3f", growth),
                       cell(s->gauged ? NAN : s->result.widening, 1.0, "%.2f", widening),
                       cell(s->gauged ? NAN : s->result.crater_depth, 1e-3, "%.3f", d),
                       gouge_class_names[s->result.class],
                       s->reused ? "reused" : cell(s->result.wall_seconds, 1.0, "%.1f", w));
    }
    close_table(t, out);
}

static void print_shots(const onset_result *o, FILE *out)
{
    table *t;
    const char *titles = "shot|rail +[K]|muzzle [m/s]|v_th [m/s]|gouges|gouged [mm3]|onset [m]";
    if (o->n_shots < 2 || host_table_create(titles, &t).code != STATUS_OK) return;
    for (int i = 0; i < o->n_shots; i++) {
        const onset_shot *s = &o->shot[i];
        char rise[24], muzzle[24], v[24], n[24], volume[24], x[24];
        host_table_row(t, "%d|%s|%s|%s|%s|%s|%s", s->shot, cell(s->rail_rise, 1.0, "%.0f", rise),
                       cell(s->muzzle_velocity, 1.0, "%.0f", muzzle), cell(s->threshold_velocity, 1.0, "%.0f", v),
                       cell(s->expected_gouges, 1.0, "%.3g", n), cell(s->expected_gouged_volume, 1e-9, "%.3g", volume),
                       cell(s->onset_position, 1.0, "%.3f", x));
    }
    close_table(t, out);
}

static void print_ranking(const compare_result *c, FILE *out)
{
    table *t;
    const char *titles = "rank|surface|v_th [m/s]|from|to|x [m]|gouges|from|to|gouged [mm3]|better|layer";
    if (!c || host_table_create(titles, &t).code != STATUS_OK) return;
    for (int i = 0; i < c->n; i++) {
        const compare_entry *e = &c->ranking[i];
        char v[24], lo[24], hi[24], x[24], volume[24], n[24], few[24], many[24], better[24];
        host_table_row(t, "%d|%s|%s|%s|%s|%s|%s|%s|%s|%s|%s|%s", e->tied ? e->tied : i + 1, e->surface,
                       cell(e->threshold_velocity, 1.0, "%.0f", v), cell(e->threshold_interval[0], 1.0, "%.0f", lo),
                       cell(e->threshold_interval[1], 1.0, "%.0f", hi), cell(e->threshold_position, 1.0, "%.3f", x),
                       cell(e->gouges, 1.0, "%.3g", n), cell(e->gouges_interval[0], 1.0, "%.3g", few),
                       cell(e->gouges_interval[1], 1.0, "%.3g", many), cell(e->gouged_volume, 1e-9, "%.3g", volume),
                       cell(e->better_than_next, 0.01, "%.0f %%", better), e->layer);
    }
    host_table_print(t, out);
    host_table_free(t);
}

static void print_inductance(const inductance_result *r, FILE *out)
{
    table *t;
    if (!r || host_table_create("f [Hz]|L' [uH/m]|R' [mohm/m]", &t).code != STATUS_OK) return;
    for (int i = 0; i < r->n; i++)
        host_table_row(t, "%.4g|%.4f|%.5g", r->frequency[i], 1e6 * r->L_gradient[i], 1e3 * r->R_gradient[i]);
    host_table_print(t, out);
    host_table_free(t);
}

void output_summary_print(const run_summary *s, FILE *out)
{
    if (s->kind == RUN_ONSET || s->kind == RUN_COMPARE) {
        print_keys_table(output_summary_shot_keys, s->shot, out);
        fputc('\n', out);
    }
    if (s->kind != RUN_COMPARE)
        print_keys_table(output_summary_keys_of_kind[s->kind], output_summary_object_of_kind(s), out);
    if (s->kind == RUN_ONSET && s->onset) {
        print_sites(s->onset, out);
        print_scenes(s->onset, out);
        print_shots(s->onset, out);
        if (s->onset->reason[0])
            fprintf(out, "\n%s: %s\n", output_onset_verdict_names[s->onset->verdict], s->onset->reason);
    }
    if (s->kind == RUN_SCENE && s->scene && s->scene->reason[0])
        fprintf(out, "\n%s: %s\n", gouge_class_names[s->scene->class], s->scene->reason);
    if (s->kind == RUN_COMPARE) print_ranking(s->compare, out);
    if (s->kind == RUN_INDUCTANCE) print_inductance(s->inductance, out);
    if (s->error) fprintf(out, "\n%s: %s\n", output_run_status_names[s->status], s->error);
}

static void print_key_list(const char *title, const summary_key *keys, FILE *out)
{
    fprintf(out, "\n### %s\n\n| key | unit | what |\n|---|---|---|\n", title);
    for (const summary_key *k = keys; k->name; k++) {
        char size[16] = "";
        if (k->kind == KEY_NUMBER && k->n > 1) snprintf(size, sizeof size, " [%d]", k->n);
        if (k->kind == KEY_LIST || k->kind == KEY_ARRAY) snprintf(size, sizeof size, " [...]");
        fprintf(out, "| `%s`%s | %s | %s |\n", k->name, size, k->unit, k->doc);
    }
}

void output_summary_print_keys(FILE *out)
{
    fputs("### all\n\n| key | what |\n|---|---|\n", out);
    fputs("| `kind` | shot, scene, onset, compare, inductance |\n| `case` | its name |\n| `version` | of Breech |\n"
          "| `instruction_set` | of the scenes |\n| `status` | done, stopped, failed |\n| `error` | null when there is "
          "none |\n| `warnings` | a text each |\n",
          out);
    for (int k = 0; k < RUN_KINDS; k++) print_key_list(output_run_kind_names[k], output_summary_keys_of_kind[k], out);
    print_key_list("onset: an entry of `sites`", output_summary_site_keys, out);
    print_key_list("onset: an entry of `scenes`, with all keys of `scene`", output_summary_study_scene_keys, out);
    print_key_list("onset: an entry of `surface`", output_summary_surface_keys, out);
    print_key_list("onset: an entry of `skips`", output_summary_skip_keys, out);
    print_key_list("onset: an entry of `sensitivities`", output_summary_sensitivity_keys, out);
    print_key_list("onset: an entry of `shots`", output_summary_repeated_keys, out);
    print_key_list("compare: an entry of `ranking`", output_summary_compare_entry_keys, out);
}
