/* SPDX-License-Identifier: BSD-3-Clause */
/* used.yaml and the manual's key list, from the same tables as the reader. */
#include "coupling/case/case_bodies.h"
#include "coupling/case/case_plain.h"

#include "mpm/law/contact.h"
#include "mpm/read/probe.h"

#include <math.h>
#include <string.h>

static void write_section(FILE *file, const breech_case *c, const case_section *section, const void *parent,
                          int indent);

/* Was this part of a section given?  What is left out is not written: its required keys have no value. */
static bool is_given(const breech_case *c, const case_section *part)
{
    return part->given == NO_FLAG || *(const bool *)((const char *)c + part->given);
}

/* The keys of one part; `first` stands before the first of them ("- " in a list). */
static void write_keys(FILE *file, const breech_case *c, const case_section *part, const void *object, int indent,
                       bool in_list)
{
    bool first = in_list;
    for (const base_param *p = part->table; p->key; p++) {
        const void *member = (const char *)object + p->offset;
        if (!case_value_is_set(p, member) || (part->has && !part->has(object, p->key))) continue;
        fprintf(file, "%*s%s%s: ", first ? indent - 2 : indent, "", first ? "- " : "", p->key);
        case_value_write(p, member, file);
        fputc('\n', file);
        first = false;
    }
    for (const case_section *s = part->children; s && s->key; s++) write_section(file, c, s, object, indent);
}

/* A section inside another, not given: its first key must be given, and is not. */
static bool is_absent(const case_section *section, const void *object)
{
    const base_param *first = section->table;
    const bool required = first->kind == BASE_PARAM_TEXT ? !first->fallback_text : isinf(first->fallback);
    return section->given == NO_FLAG && required && !case_value_is_set(first, (const char *)object + first->offset);
}

static void write_section(FILE *file, const breech_case *c, const case_section *section, const void *parent, int indent)
{
    if (!section->list && is_absent(section, (const char *)parent + section->offset)) return;
    const case_list list = section->list ? case_list_get(parent, section) : (case_list){ 0, NULL };
    if (section->list && list.n == 0) return;
    fprintf(file, "%*s%s:\n", indent, "", section->key);
    for (int k = 0; k < list.n; k++)
        write_keys(file, c, section, (const char *)list.item + (size_t)k * section->size, indent + 4, true);
    for (const case_section *part = section; part && !section->list; part = part->also)
        if (is_given(c, part)) write_keys(file, c, part, (const char *)parent + part->offset, indent + 2, false);
}

status case_write_used(const breech_case *c, FILE *file)
{
    const case_section head = { .key = "", .table = case_root.table, .given = NO_FLAG };
    fputs("# The case as it was run: every value resolved, in SI units.\n", file);
    write_keys(file, c, &head, c, 0, false);
    for (const case_section *s = case_root.children; s->key; s++)
        if (is_given(c, s) || (s->also && is_given(c, s->also))) write_section(file, c, s, c, 0);
    if (c->given.bodies) case_bodies_write(&c->bodies, file);
    CHECK(!ferror(file), STATUS_IO, "used.yaml cannot be written");
    return status_ok();
}

status case_write_scene(const breech_case *c, const mpm_scene *s, FILE *file)
{
    breech_case one = *c; /* borrows all */
    memset(&one.given, 0, sizeof one.given);
    one.given.bodies = one.given.output = true;
    one.bodies = (case_bodies){ .scene = *s, .overlap = OVERLAP_LATER };
    return case_write_used(&one, file);
}

/* ---- the manual ---- */

static void print_default(FILE *file, const base_param *p)
{
    char text[64];
    if (p->kind == BASE_PARAM_TEXT) {
        fputs(!p->fallback_text ? "required" : p->fallback_text[0] ? p->fallback_text : "-", file);
        return;
    }
    if (isinf(p->fallback) || isnan(p->fallback)) {
        fputs(isinf(p->fallback) ? "required" : "-", file);
        return;
    }
    if (p->kind == BASE_PARAM_FLAG) fputs(p->fallback != 0.0 ? "yes" : "no", file);
    if (p->kind == BASE_PARAM_CHOICE) fputs(p->choices[(int)p->fallback], file);
    if (p->kind == BASE_PARAM_INTEGER) fprintf(file, "%d", (int)p->fallback);
    if (p->kind != BASE_PARAM_NUMBER && p->kind != BASE_PARAM_VECTOR) return;
    host_quantity_text(p->fallback, p->unit, text, sizeof text);
    fputs(text, file);
}

static void print_range(FILE *file, const base_param *p)
{
    char limits[LIMITS_SIZE];
    switch (p->kind) {
    case BASE_PARAM_TEXT: fputs("text", file); break;
    case BASE_PARAM_FLAG: fputs("yes, no", file); break;
    case BASE_PARAM_CHOICE:
        for (int k = 0; p->choices[k]; k++) fprintf(file, "%s%s", k > 0 ? ", " : "", p->choices[k]);
        break;
    case BASE_PARAM_NUMBER:
    case BASE_PARAM_INTEGER:
    case BASE_PARAM_VECTOR:
    case BASE_PARAM_POINTS:
        host_quantity_limits(NULL, p->min, p->max, p->unit, "", limits);
        fprintf(file, "%s%s", limits,
                p->kind == BASE_PARAM_VECTOR   ? ", three of them"
                : p->kind == BASE_PARAM_POINTS ? ", in pairs"
                                               : "");
        break;
    }
}

/* Markdown takes | for the end of a cell and < for a tag. */
static void print_cell(FILE *file, const char *text)
{
    for (; *text; text++) {
        if (*text == '|' || *text == '<') fputc('\\', file);
        fputc(*text, file);
    }
}

static void print_table(FILE *file, const base_param *table)
{
    fputs("\n| key | unit | default | range | meaning |\n|---|---|---|---|---|\n", file);
    for (const base_param *p = table; p->key; p++) {
        const bool number =
            p->kind == BASE_PARAM_NUMBER || p->kind == BASE_PARAM_VECTOR || p->kind == BASE_PARAM_POINTS;
        fprintf(file, "| `%s` | %s | ", p->key, number && strcmp(p->unit, "1") != 0 ? p->unit : "");
        print_default(file, p);
        fputs(" | ", file);
        print_range(file, p);
        fputs(" | ", file);
        print_cell(file, p->doc);
        fputs(" |\n", file);
    }
}

static void print_section(FILE *file, const case_section *section, const char *parent)
{
    if (section->key[0]) fprintf(file, "\n## `%s%s%s`\n", parent, parent[0] ? "." : "", section->key);
    for (const case_section *part = section; part; part = part->also) {
        if (part->key[0]) fprintf(file, "\n%s\n", part->doc);
        if (part->table->key) print_table(file, part->table);
    }
    for (const case_section *part = section; part; part = part->also)
        for (const case_section *s = part->children; s && s->key; s++) print_section(file, s, section->key);
}

void case_print_keys(FILE *file)
{
    char key[BASE_PARAM_TEXT_SIZE];
    print_section(file, &case_root, "");
    for (const case_section *s = case_bodies_manual; s->key; s++) print_section(file, s, "");
    for (int i = 0; mpm_solid_kind_at(i); i++) {
        const mpm_solid_kind *k = mpm_solid_kind_at(i);
        snprintf(key, sizeof key, "shape: %s", k->name);
        print_section(file, &(case_section){ .key = key, .doc = k->doc, .table = k->params }, "");
    }
    for (int i = 0; i < MPM_BOUNDARIES; i++) {
        static const base_param none[] = { PARAMS_END };
        snprintf(key, sizeof key, "boundary: %s", mpm_boundary_names[i]);
        print_section(file, &(case_section){ .key = key, .doc = mpm_boundary_docs[i], .table = none }, "");
    }
    for (int i = 0; mpm_contact_at(i); i++) {
        const mpm_contact_law *law = mpm_contact_at(i);
        snprintf(key, sizeof key, "contact: %s", law->name);
        print_section(file, &(case_section){ .key = key, .doc = law->doc, .table = law->params }, "");
    }
    for (int i = 0; mpm_refine_kind_at(i); i++) {
        const mpm_refine_kind *k = mpm_refine_kind_at(i);
        snprintf(key, sizeof key, "refine: %s", k->name);
        print_section(file, &(case_section){ .key = key, .doc = k->doc, .table = k->params }, "");
    }
    for (int i = 0; mpm_probe_kind_at(i); i++) {
        const mpm_probe_kind *k = mpm_probe_kind_at(i);
        snprintf(key, sizeof key, "probe: %s", k->name);
        print_section(file, &(case_section){ .key = key, .doc = k->doc, .table = k->params }, "");
    }
}
