/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/case/material_role.h"

#include "coupling/host/file_text.h"
#include "coupling/host/table.h"

#include <stdlib.h>
#include <string.h>

enum { LACK_SIZE = 28 /* of the table's last column */, TEXT_SIZE = sizeof((status){ .code = STATUS_OK }.text) };

enum { IN_SCENES = MPM_MATERIAL_FOR_SCENE, FAILING = IN_SCENES | MPM_MATERIAL_FOR_DAMAGE };

enum { ROLE_SHOT, ROLE_ONSET, ROLE_FAILS, ROLE_BODY, ROLE_LIFE, ROLES };
static const material_role roles[ROLES] = {
    [ROLE_SHOT] = { "shot", "the circuit's rail or armature", MPM_MATERIAL_FOR_CIRCUIT, 0, NULL },
    [ROLE_ONSET] = { "onset", "rail or armature where gouging is looked for", FAILING | MPM_MATERIAL_FOR_SCREEN,
                     MPM_MATERIAL_FOR_DAMAGE, "scene.damage: no" },
    [ROLE_FAILS] = { "fails", "a grain or a layer there; a body with damage: yes", FAILING, MPM_MATERIAL_FOR_DAMAGE,
                     NULL },
    [ROLE_BODY] = { "body", "a body of any scene, projectile or target", IN_SCENES, 0, NULL },
    [ROLE_LIFE] = { "life", "the rail of `breech life`", MPM_MATERIAL_FOR_FATIGUE, 0, NULL },
};

unsigned case_material_needs(bool damage, bool meets)
{
    const material_role *role = &roles[meets ? ROLE_ONSET : ROLE_FAILS];
    return damage ? role->needs : role->needs & ~role->without;
}

/* "", or what the material lacks for this part, as a run that refuses it says. */
static void list_lacks(const mpm_material *m, const material_role *role, char out[TEXT_SIZE])
{
    const status s = mpm_material_check(m, role->needs);
    const char *list = strstr(s.text, "needs: ");
    snprintf(out, TEXT_SIZE, "%s", s.code == STATUS_OK ? "" : list ? list + 7 : s.text);
}

/* ---- laws of strength ---- */

/* The name of a law as files have it, then its own constants, and so on. */
typedef struct {
    const char *law, *key; /* one of the two */
} law_row;

static const law_row strength_rows[] = {
#define STRENGTH(name, shear, text) { .law = #name },
#define CONSTANT(member, unit, fallback, least, largest, text) { .key = #member },
#include "mpm/law/strength.def"
    { .law = "" }
};

/* The row of the law of this number; its constants follow. */
static const law_row *law_find(int kind)
{
    const law_row *row = strength_rows;
    for (; !row->law || (row->law[0] && kind-- > 0); row++) continue;
    return row;
}

static const material_constant *constant_find(const material_sheet *sheet, const char *key)
{
    for (int i = 0; i < sheet->n; i++)
        if (strcmp(sheet->constant[i].constant->key, key) == 0) return &sheet->constant[i];
    return NULL;
}

/* "mts"; "-": it is a fluid, or its file has no constant of a law. */
static const char *strength_name(const material_sheet *sheet)
{
    const law_row *law = law_find(sheet->material.strength);
    if (mpm_material_shear(&sheet->material) == MPM_SHEAR_NONE) return "- (fluid)";
    for (const law_row *row = law + 1; row->key; row++)
        if (constant_find(sheet, row->key)) return law->law;
    return "-";
}

/* Where the constants of its law of strength come from, each source once. */
static void print_law_sources(const material_sheet *sheet, FILE *out)
{
    const law_row *first = law_find(sheet->material.strength) + 1;
    for (const law_row *row = first; row->key; row++) {
        const material_constant *k = constant_find(sheet, row->key);
        bool told = !k;
        for (const law_row *before = first; before < row && !told; before++) {
            const material_constant *b = constant_find(sheet, before->key);
            told = b && strcmp(b->source, k->source) == 0;
        }
        if (!told) fprintf(out, "    source: %s\n", k->source);
    }
}

/* ---- the table ---- */

/* "yes", "(yes)": where the case says `unless`; "-". */
static const char *good(const mpm_material *m, const material_role *role)
{
    if (mpm_material_check(m, role->needs).code == STATUS_OK) return "yes";
    const bool some = role->unless && mpm_material_check(m, role->needs & ~role->without).code == STATUS_OK;
    return some ? "(yes)" : "-";
}

/* The first constants that any role but life lacks, and how many more; a fluid is a body alone. */
static void shortened(const mpm_material *m, char out[LACK_SIZE + 24])
{
    char all[TEXT_SIZE];
    material_role every = { .needs = roles[ROLE_BODY].needs };
    for (int i = 0; i < ROLES && mpm_material_shear(m) != MPM_SHEAR_NONE; i++)
        if (i != ROLE_LIFE) every.needs |= roles[i].needs;
    list_lacks(m, &every, all);
    int more = 0;
    out[0] = '\0';
    for (char *rest = all, *key; (key = strtok_r(rest, ",", &rest));) {
        while (*key == ' ') key++;
        const size_t used = strlen(out);
        if (more || (used && used + strlen(key) > LACK_SIZE - 8))
            more++;
        else
            snprintf(out + used, LACK_SIZE - used, "%s%s", used ? ", " : "", key);
    }
    const size_t used = strlen(out);
    if (more) snprintf(out + used, 24, ", +%d", more);
}

/* A line of the table: `first`, a cell of each role, `last`. */
static status put_row(table *t, const char *first, const mpm_material *m, const char *last)
{
    char cells[12 * ROLES] = "";
    for (int i = 0; i < ROLES; i++) {
        const size_t used = strlen(cells);
        snprintf(cells + used, sizeof cells - used, TABLE_NEXT "%s", m ? good(m, &roles[i]) : "");
    }
    return host_table_row(t, "%s%s|%s", first, cells, last);
}

/* All materials: the table, and below it what a file says of when to take its own. */
typedef struct {
    table *t;
    FILE *advice;
} listing;

static status add_row(listing *l, const char *name, const char *const *dirs, int n_dirs)
{
    material_sheet sheet;
    char *errors = NULL, first[60], last[80];
    const status s = case_material_sheet_open(name, dirs, n_dirs, &sheet, &errors);
    free(errors);
    if (s.code == STATUS_BAD_INPUT) {
        snprintf(first, sizeof first, "%.24s" TABLE_NEXT, name);
        snprintf(last, sizeof last, "its file has errors: breech materials %.24s", name);
        return put_row(l->t, first, NULL, last);
    }
    TRY(s);
    snprintf(first, sizeof first, "%.24s" TABLE_NEXT "%.24s", name, strength_name(&sheet));
    shortened(&sheet.material, last);
    const status added = put_row(l->t, first, &sheet.material, last);
    if (sheet.take_for[0]) fprintf(l->advice, "  %-22s %s\n", name, sheet.take_for);
    case_material_sheet_free(&sheet);
    return added;
}

static bool hidden(const material_places *at, int d, const char *name)
{
    char path[MATERIAL_PATH_SIZE + BASE_PARAM_TEXT_SIZE + 8];
    for (int k = 0; k < d; k++) {
        snprintf(path, sizeof path, "%s/%s.yaml", at->dir[k], name);
        if (host_file_exists(path)) return true;
    }
    return false;
}

static status add_folder(listing *l, const material_places *at, int d)
{
    char **names;
    int n;
    TRY(case_material_names(at->dir[d], &names, &n));
    status s = status_ok();
    for (int i = 0; i < n && s.code == STATUS_OK; i++)
        if (!hidden(at, d, names[i]))
            s = add_row(l, names[i], &at->dir[d], at->n - d); /* its base may lie in a later one */
    case_material_names_free(names, n);
    return s;
}

static status fill_listing(listing *l, const material_places *at, int listed)
{
    char titles[200] = "material|strength";
    for (int i = 0; i < ROLES; i++) {
        const size_t used = strlen(titles);
        snprintf(titles + used, sizeof titles - used, "|%s", roles[i].name);
    }
    strcat(titles, "|lacks");
    TRY(host_table_create(titles, &l->t));
    for (int d = 0; d < listed; d++) TRY(add_folder(l, at, d));
    return status_ok();
}

static void print_listing(const listing *l, const char *advice, const material_places *at, int listed, FILE *out)
{
    host_table_print(l->t, out);
    fputc('\n', out);
    for (int i = 0; i < ROLES; i++) {
        fprintf(out, "%-6s %s", roles[i].name, roles[i].doc);
        fprintf(out, roles[i].unless ? "; (yes): with %s\n" : "%s\n", roles[i].unless ? roles[i].unless : "");
    }
    fputs("lacks  constants for parts that it cannot have; +4: four more\n"
          "breech materials NAME: all that is known of one, the source of each constant, and what it lacks\n",
          out);
    if (advice[0]) fprintf(out, "\nof several for one metal (more in docs/guide/own-launcher.md):\n%s\n", advice);
    for (int d = 0; d < listed; d++) fprintf(out, "%s%s\n", d == 0 ? "from " : "     ", at->dir[d]);
}

status case_materials_print(const material_places *at, int listed, FILE *out)
{
    char *advice = NULL;
    size_t length = 0;
    listing l = { .advice = open_memstream(&advice, &length) };
    CHECK(l.advice, STATUS_MEMORY, "no memory for the list of materials");
    status s = fill_listing(&l, at, listed);
    if (fclose(l.advice) != 0 && s.code == STATUS_OK)
        s = base_status_error(STATUS_MEMORY, "no memory for the list of materials");
    if (s.code == STATUS_OK) print_listing(&l, advice, at, listed, out);
    host_table_free(l.t);
    free(advice);
    return s;
}

/* ---- one material ---- */

static void print_roles(const mpm_material *m, FILE *out)
{
    for (int i = 0; i < ROLES; i++) {
        const material_role *role = &roles[i];
        char lacks[TEXT_SIZE];
        list_lacks(m, role, lacks);
        const char *answer = good(m, role);
        fprintf(out, "  %-6s %-5s  %s", role->name, strcmp(answer, "-") == 0 ? "no" : answer, role->doc);
        if (strcmp(answer, "(yes)") == 0) fprintf(out, "; with %s", role->unless);
        if (lacks[0]) fprintf(out, "; lacks %s", lacks);
        fputc('\n', out);
    }
}

void case_material_print(const material_sheet *sheet, FILE *out)
{
    const mpm_material *m = &sheet->material;
    fprintf(out, "%s: %s\n%s\n", m->name, sheet->title, sheet->path);
    if (sheet->take_for[0]) fprintf(out, "take it for %s\n", sheet->take_for);
    if (sheet->base[0]) fprintf(out, "changes %s\n", sheet->base);
    fprintf(out, "  strength: %s\n", mpm_material_strength_text(m->strength));
    print_law_sources(sheet, out);
    fprintf(out, "  eos: %s\n  failure: %s\n\ngood for:\n", mpm_material_eos_text(m->eos),
            mpm_material_failure_text(m->failure));
    print_roles(m, out);
    fputs("\nconstants:\n", out);
    for (int i = 0; i < sheet->n; i++) {
        const material_constant *k = &sheet->constant[i];
        const double value = *(const double *)(const void *)((const char *)m + k->constant->offset);
        char text[60];
        host_quantity_text(value, k->constant->unit, text, sizeof text);
        fprintf(out, "  %-22s %-16s %s%s\n", k->constant->key, text, k->weak ? "[weak] " : "", k->source);
        if (k->note) fprintf(out, "  %-22s %-16s (%s)\n", "", "", k->note);
    }
}
