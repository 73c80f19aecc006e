/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/study/study.h"

#include <string.h>

const study *const study_list[STUDIES] = {
#define STUDY(name) &study_##name,
#include "coupling/study/study.def"
#undef STUDY
};

const study *study_for(const study *y, const case_inputs *in)
{
    for (const study *other = y->instead; other; other = other->instead)
        if (other->takes(in)) return other;
    return y;
}

const study *study_find(const char *name)
{
    for (int k = 0; k < STUDIES; k++)
        for (const study *y = study_list[k]; y; y = y->instead)
            if (strcmp(y->name, name) == 0) return y;
    return NULL;
}

const char *study_command(const study *y)
{
    for (int k = 0; k < STUDIES; k++)
        for (const study *other = study_list[k]; other; other = other->instead)
            if (other == y) return study_list[k]->name;
    return y->name;
}

status study_possible_all(const study_case *of, unsigned needs)
{
    TRY(study_possible(of->in, needs, of->largest));
    for (int k = 0; k < STUDIES; k++) {
        const study *y = study_for(study_list[k], of->in);
        if (y->possible && (needs & y->needs) == y->needs) TRY(y->possible(of));
    }
    return status_ok();
}

report_kind study_report_kind(const char *name)
{
    const study *y = study_find(name);
    return y ? (report_kind){ y->report, study_command(y) } : (report_kind){ .command = NULL };
}

summary_tables study_tables(const char *name)
{
    const study *y = study_find(name);
    return (summary_tables){ y ? y->keys : NULL, y && y->shows_shot ? run_shot_keys : NULL };
}

run_summary study_summary(const study *y, const study_answer *a)
{
    run_summary s = { .kind = y->name, .result = { y->keys, a->result }, .print = y->print };
    if (y->shows_shot) s.shot = (summary_object){ run_shot_keys, a->shot };
    return s;
}

/* ---- for the manual ---- */

/* Was the table of this list's entries printed by an earlier study? */
static bool printed_before(int study_number, const summary_key *item)
{
    for (int k = 0; k < study_number; k++)
        for (const summary_key *key = study_list[k]->keys; key->name; key++)
            if (key->kind == KEY_LIST && key->item == item) return true;
    return false;
}

/* A table of keys, with what its parts are in the title. */
static void print_table(const summary_key *keys, const char *what, FILE *out)
{
    char title[120];
    int n = snprintf(title, sizeof title, "%s", what);
    for (const summary_key *part = keys; part->name; part++)
        if (part->kind == KEY_PART)
            n += snprintf(title + n, sizeof title - (size_t)n, ", with all keys of `%s`", part->name);
    output_keys_manual(title, keys, out);
}

static void print_entries(const study *y, int study_number, FILE *out)
{
    for (const summary_key *key = y->keys; key->name; key++) {
        char what[90];
        if ((key->kind != KEY_LIST && key->kind != KEY_MAP) || printed_before(study_number, key->item)) continue;
        snprintf(what, sizeof what, "%.30s: an entry of `%.40s`", y->name, key->name);
        print_table(key->item, what, out);
    }
}

void study_print_keys(FILE *out)
{
    fputs("### all\n\n| key | what |\n|---|---|\n| `kind` |", out);
    for (int k = 0; k < STUDIES; k++)
        for (const study *y = study_list[k]; y; y = y->instead)
            fprintf(out, "%s %s", k || y != study_list[k] ? "," : "", y->name);
    fputs(" |\n| `case` | its name |\n| `version` | of Breech |\n| `instruction_set` | of the scenes |\n"
          "| `status` | done, stopped, failed |\n| `error` | null when there is none |\n| `warnings` | a text each |\n",
          out);
    for (int k = 0; k < STUDIES; k++)
        for (const study *y = study_list[k]; y; y = y->instead) print_table(y->keys, y->name, out);
    for (int k = 0; k < STUDIES; k++)
        for (const study *y = study_list[k]; y; y = y->instead) print_entries(y, k, out);
}
