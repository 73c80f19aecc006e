/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/output/summary.h"

#include "coupling/host/outdir.h"
#include "coupling/host/table.h"
#include "coupling/host/units.h"
#include "coupling/host/utf8.h"
#include "coupling/host/version.h"

#include <cJSON.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

const char *const output_run_status_names[] = { "done", "stopped", "failed", NULL };

/* ---- JSON ---- */

static cJSON *number_json(double value)
{
    return isfinite(value) ? cJSON_CreateNumber(value) : cJSON_CreateNull();
}

/* A text that was cut to its room may end inside a character, and a path may hold any bytes: JSON takes neither. */
static cJSON *text_json(const char *text)
{
    cJSON *json = cJSON_CreateString(text);
    if (json) host_utf8_repair(json->valuestring);
    return json;
}

static cJSON *vector_json(const double *value, int n)
{
    cJSON *list = cJSON_CreateArray();
    for (int i = 0; i < n; i++) cJSON_AddItemToArray(list, number_json(value[i]));
    return list;
}

/* A vector that does not exist (an interval where there is none) is null as a whole. */
static cJSON *vector_or_null(const double *value, int n)
{
    bool any = false;
    for (int i = 0; i < n; i++) any = any || isfinite(value[i]);
    return any ? vector_json(value, n) : cJSON_CreateNull();
}

static int count_of(const summary_key *k, const char *base)
{
    return *(const int *)(const void *)(base + k->n_offset);
}

static cJSON *by_name_json(const summary_key *k, const char *base)
{
    cJSON *object = cJSON_CreateObject();
    const double *value = (const double *)(const void *)(base + k->offset);
    for (int i = 0; i < count_of(k, base); i++)
        cJSON_AddItemToObject(object, base + k->names_offset + (size_t)i * k->item_size, number_json(value[i]));
    return object;
}

static cJSON *pairs_json(const summary_key *k, const char *base)
{
    cJSON *object = cJSON_CreateObject();
    const summary_pair *pair = *(const summary_pair *const *)(const void *)(base + k->offset);
    for (int i = 0; i < count_of(k, base); i++)
        cJSON_AddItemToObject(object, pair[i].name,
                              pair[i].text ? text_json(pair[i].text) : number_json(pair[i].value));
    return object;
}

static void add_keys(cJSON *object, const summary_key *keys, const void *from);

static cJSON *list_json(const summary_key *k, const char *base)
{
    const char *items = *(const char *const *)(const void *)(base + k->offset);
    cJSON *list = cJSON_CreateArray();
    for (int i = 0; i < count_of(k, base); i++) {
        cJSON *object = cJSON_CreateObject();
        add_keys(object, k->item, items + (size_t)i * k->item_size);
        cJSON_AddItemToArray(list, object);
    }
    return list;
}

static cJSON *map_json(const summary_key *k, const char *base)
{
    const char *items = *(const char *const *)(const void *)(base + k->offset);
    cJSON *map = cJSON_CreateObject();
    for (int i = 0; i < count_of(k, base); i++) {
        const char *item = items + (size_t)i * k->item_size;
        cJSON *object = cJSON_CreateObject();
        add_keys(object, k->item + 1, item);
        cJSON_AddItemToObject(map, item + k->item->offset, object);
    }
    return map;
}

/* A key's value of the struct it belongs to; the caller frees. */
static cJSON *value_json(const summary_key *k, const void *from)
{
    const char *base = from;
    const void *member = base + k->offset;
    switch (k->kind) {
    case KEY_NUMBER: return k->n == 1 ? number_json(*(const double *)member) : vector_or_null(member, k->n);
    case KEY_COUNT: return cJSON_CreateNumber((double)*(const uint64_t *)member);
    case KEY_INTEGER: return cJSON_CreateNumber(*(const int *)member);
    case KEY_FLAG: return cJSON_CreateBool(*(const bool *)member);
    case KEY_TEXT: return text_json(member);
    case KEY_NAME: return cJSON_CreateString(k->names[*(const int *)member]);
    case KEY_BY_NAME: return by_name_json(k, base);
    case KEY_PAIRS: return pairs_json(k, base);
    case KEY_LIST: return list_json(k, base);
    case KEY_MAP: return map_json(k, base);
    case KEY_ARRAY: return vector_json(*(const double *const *)member, count_of(k, base));
    case KEY_PART: break;
    }
    return NULL;
}

/* from == NULL: every key, null. */
static void add_keys(cJSON *object, const summary_key *keys, const void *from)
{
    for (const summary_key *k = keys; k->name; k++)
        if (k->kind == KEY_PART)
            add_keys(object, k->item, from ? (const char *)from + k->offset : NULL);
        else
            cJSON_AddItemToObject(object, k->name, from ? value_json(k, from) : cJSON_CreateNull());
}

static cJSON *warnings_json(const char *warnings)
{
    cJSON *list = cJSON_CreateArray();
    for (const char *line = warnings ? warnings : ""; *line;) {
        const size_t n = strcspn(line, "\n");
        char text[1000];
        snprintf(text, sizeof text, "%.*s", (int)(n < sizeof text ? n : sizeof text - 1), line);
        if (n) cJSON_AddItemToArray(list, text_json(text));
        line += n + (line[n] == '\n');
    }
    return list;
}

static void add_common(cJSON *root, const run_summary *s)
{
    cJSON_AddStringToObject(root, "kind", s->kind);
    cJSON_AddItemToObject(root, "case", text_json(s->case_name ? s->case_name : ""));
    cJSON_AddStringToObject(root, "version", host_version());
    cJSON_AddStringToObject(root, "instruction_set", s->instruction_set ? s->instruction_set : "");
    cJSON_AddStringToObject(root, "status", output_run_status_names[s->status]);
    cJSON_AddItemToObject(root, "error", s->error ? text_json(s->error) : cJSON_CreateNull());
    cJSON_AddItemToObject(root, "warnings", warnings_json(s->warnings));
}

/* cJSON writes 15 digits where they are nearly right; numbers here are the shortest text that is exactly right. */
static void make_exact(cJSON *node)
{
    for (cJSON *item = node ? node->child : NULL, *next; item; item = next) {
        char text[32];
        next = item->next;
        make_exact(item);
        if (!cJSON_IsNumber(item)) continue;
        for (int digits = 15; digits <= 17; digits++) {
            snprintf(text, sizeof text, "%.*g", digits, item->valuedouble);
            if (strtod(text, NULL) == item->valuedouble) break;
        }
        cJSON *exact = cJSON_CreateRaw(text);
        if (!exact) continue;
        if (item->string) exact->string = strdup(item->string);
        cJSON_ReplaceItemViaPointer(node, item, exact);
    }
}

char *output_summary_text(const run_summary *s)
{
    cJSON *root = cJSON_CreateObject();
    if (!root) return NULL;
    add_common(root, s);
    add_keys(root, s->result.keys, s->result.of);
    if (s->shot.keys) {
        cJSON *shot_json = cJSON_CreateObject();
        add_keys(shot_json, s->shot.keys, s->shot.of);
        cJSON_AddItemToObject(root, "shot", shot_json);
    }
    make_exact(root);
    char *text = cJSON_Print(root);
    cJSON_Delete(root);
    return text;
}

status output_summary_write(const char *dir, const run_summary *s)
{
    char path[OUTDIR_PATH_SIZE];
    const int n = snprintf(path, sizeof path, "%s/%s", dir, OUTDIR_SUMMARY);
    CHECK(n > 0 && (size_t)n < sizeof path, STATUS_IO, "%.300s: path too long", dir);
    char *text = output_summary_text(s);
    CHECK(text, STATUS_MEMORY, "no memory for the summary");
    file_writer w;
    status result = host_file_begin(&w, path);
    if (result.code == STATUS_OK) {
        fprintf(w.stream, "%s\n", text);
        result = host_file_end(&w, true);
    }
    free(text);
    return result;
}

/* ---- objects by themselves ---- */

char *output_object_text(const summary_object *o)
{
    cJSON *object = cJSON_CreateObject();
    add_keys(object, o->keys, o->of);
    make_exact(object);
    char *text = cJSON_PrintUnformatted(object);
    cJSON_Delete(object);
    return text;
}

static int name_index(const char *const *names, const char *name)
{
    for (int i = 0; name && names[i]; i++)
        if (strcmp(names[i], name) == 0) return i;
    return -1;
}

static double number_of(const cJSON *value)
{
    return cJSON_IsNumber(value) ? value->valuedouble : NAN;
}

/* Names and values by the object's own order; as many as the struct has room for by its key. */
static bool read_by_name(const summary_key *k, const cJSON *object, char *base)
{
    const cJSON *value;
    double *number = (double *)(void *)(base + k->offset);
    int n = 0;
    cJSON_ArrayForEach(value, object)
    {
        if (n == k->n) return false;
        snprintf(base + k->names_offset + (size_t)n * k->item_size, k->item_size, "%s", value->string);
        number[n++] = number_of(value);
    }
    *(int *)(void *)(base + k->n_offset) = n;
    return cJSON_IsObject(object);
}

static bool read_keys(const summary_key *keys, const cJSON *object, void *out, const char **missing);

/* Objects of a list, or of a map by their names, into an array of their own. */
static bool read_items(const summary_key *k, const cJSON *list, char *base)
{
    const cJSON *value;
    const size_t n = (size_t)cJSON_GetArraySize(list);
    const char *missing = NULL;
    char *item = calloc(n + 1, k->item_size);
    *(void **)(void *)(base + k->offset) = item;
    *(int *)(void *)(base + k->n_offset) = item ? (int)n : 0;
    if (!item) return false;
    cJSON_ArrayForEach(value, list)
    {
        const summary_key *name = k->item;
        const bool map = k->kind == KEY_MAP;
        if (map) snprintf(item + name->offset, (size_t)name->n, "%s", value->string);
        if (!read_keys(name + map, value, item, &missing)) return false;
        item += k->item_size;
    }
    return k->kind == KEY_MAP ? cJSON_IsObject(list) : cJSON_IsArray(list);
}

/* value_json the other way round. */
static bool read_value(const summary_key *k, const cJSON *value, void *to)
{
    void *member = (char *)to + k->offset;
    double *number = member;
    switch (k->kind) {
    case KEY_NUMBER:
        for (int i = 0; i < k->n; i++) number[i] = number_of(k->n == 1 ? value : cJSON_GetArrayItem(value, i));
        return value != NULL;
    case KEY_COUNT: *(uint64_t *)member = (uint64_t)cJSON_GetNumberValue(value); return cJSON_IsNumber(value);
    case KEY_INTEGER: *(int *)member = (int)cJSON_GetNumberValue(value); return cJSON_IsNumber(value);
    case KEY_FLAG: *(bool *)member = cJSON_IsTrue(value); return cJSON_IsBool(value);
    case KEY_TEXT:
        snprintf(member, (size_t)k->n, "%s", cJSON_IsString(value) ? value->valuestring : "");
        return cJSON_IsString(value);
    case KEY_NAME: *(int *)member = name_index(k->names, cJSON_GetStringValue(value)); return *(int *)member >= 0;
    case KEY_BY_NAME: return read_by_name(k, value, to);
    case KEY_LIST:
    case KEY_MAP: return read_items(k, value, to);
    case KEY_PAIRS:
    case KEY_ARRAY:
    case KEY_PART: break;
    }
    return false;
}

/* *missing: the first key that is not there, or is of another kind. */
static bool read_keys(const summary_key *keys, const cJSON *object, void *out, const char **missing)
{
    for (const summary_key *k = keys; k->name && !*missing; k++)
        if (!read_value(k, cJSON_GetObjectItemCaseSensitive(object, k->name), out)) *missing = k->name;
    return !*missing;
}

status output_object_read(const char *text, const summary_key *keys, void *out)
{
    cJSON *root = cJSON_Parse(text);
    const char *missing = NULL;
    read_keys(keys, root, out, &missing);
    cJSON_Delete(root);
    CHECK(!missing, STATUS_IO, "the result of a scene has no `%s`", missing);
    return status_ok();
}

/* ---- numbers by their paths ---- */

const char *output_unit_over_time(const char *unit)
{
    static const struct {
        const char *unit, *over_time;
    } known[] = { { "N", "N s" }, { "Pa", "Pa s" }, { "m/s", "m" }, { "W", "J" } };
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++)
        if (strcmp(unit, known[i].unit) == 0) return known[i].over_time;
    return NULL;
}

typedef struct {
    output_number_visitor *visit;
    void *user;
} visitor;

/* The text of the key that is called `unit`, "" where there is none. */
static const char *own_unit(const summary_key *keys, const char *base)
{
    for (const summary_key *k = keys; k->name; k++)
        if (k->kind == KEY_TEXT && strcmp(k->name, "unit") == 0) return base + k->offset;
    return "";
}

/* A number, or each component of a vector.  base: NULL where there are no values, as in all that follow. */
static void visit_number(const summary_key *k, const char *base, const char *own, const char *path, const visitor *v)
{
    const double *value = base ? (const double *)(const void *)(base + k->offset) : NULL;
    const bool over_time = !k->unit[0] && own[0] && k->n > 1;
    const char *integral = over_time ? output_unit_over_time(own) : NULL;
    char unit[SUMMARY_NAME_SIZE], part[SUMMARY_PATH_SIZE];
    snprintf(unit, sizeof unit, "%s%s",
             integral     ? integral
             : k->unit[0] ? k->unit
                          : own,
             over_time && !integral ? " s" : "");
    for (int i = 0; i < k->n; i++) {
        snprintf(part, sizeof part, "%.220s[%d]", path, i);
        v->visit(v->user, &(output_number){ k->n == 1 ? path : part, unit, value ? value[i] : NAN, false });
    }
}

static void visit_count(const summary_key *k, const char *base, const char *path, const visitor *v)
{
    const void *member = base ? base + k->offset : NULL;
    const double value = !member                ? NAN
                         : k->kind == KEY_COUNT ? (double)*(const uint64_t *)member
                                                : *(const int *)member;
    v->visit(v->user, &(output_number){ path, k->unit, value, true });
}

static void visit_by_name(const summary_key *k, const char *base, const char *path, const visitor *v)
{
    const double *value = base ? (const double *)(const void *)(base + k->offset) : NULL;
    char part[SUMMARY_PATH_SIZE];
    for (int i = 0; i < (base ? count_of(k, base) : 1); i++) {
        snprintf(part, sizeof part, "%.150s.%.80s", path,
                 base ? base + k->names_offset + (size_t)i * k->item_size : "*");
        v->visit(v->user, &(output_number){ part, k->unit, value ? value[i] : NAN, false });
    }
}

static void visit_numbers(const summary_key *keys, const char *base, const char *before, const visitor *v);

static void visit_map(const summary_key *k, const char *base, const char *path, const visitor *v)
{
    const char *items = base ? *(const char *const *)(const void *)(base + k->offset) : NULL;
    char inner[SUMMARY_PATH_SIZE];
    for (int i = 0; i < (base ? count_of(k, base) : 1); i++) {
        const char *item = base ? items + (size_t)i * k->item_size : NULL;
        snprintf(inner, sizeof inner, "%.100s.%.100s.", path, item ? item + k->item->offset : "*");
        visit_numbers(k->item + 1, item, inner, v);
    }
}

static void visit_numbers(const summary_key *keys, const char *base, const char *before, const visitor *v)
{
    const char *own = base ? own_unit(keys, base) : "";
    for (const summary_key *k = keys; k->name; k++) {
        char path[SUMMARY_PATH_SIZE];
        snprintf(path, sizeof path, "%.120s%.100s", before, k->name);
        if (k->kind == KEY_NUMBER) visit_number(k, base, own, path, v);
        if (k->kind == KEY_COUNT || k->kind == KEY_INTEGER) visit_count(k, base, path, v);
        if (k->kind == KEY_BY_NAME) visit_by_name(k, base, path, v);
        if (k->kind == KEY_PART) visit_numbers(k->item, base ? base + k->offset : NULL, before, v);
        if (k->kind == KEY_MAP) visit_map(k, base, path, v);
    }
}

void output_numbers_visit(const summary_object *o, output_number_visitor *visit, void *user)
{
    visit_numbers(o->keys, o->of, "", &(visitor){ visit, user });
}

/* ---- one number ---- */

typedef struct {
    const char *path;
    char *unit;
    double value;
    bool met;
} wanted_number;

/* Is the text of the pattern's form, where `*` stands for one letter or more? */
static bool matches(const char *pattern, const char *text)
{
    for (; *pattern && *pattern != '*'; pattern++, text++)
        if (*pattern != *text) return false;
    if (!*pattern) return !*text;
    for (; *text; text++)
        if (matches(pattern + 1, text + 1)) return true;
    return false;
}

static void find_form(void *user, const output_number *number)
{
    wanted_number *w = user;
    w->met = w->met || matches(number->path, w->path);
}

bool output_number_exists(const summary_key *keys, const char *path)
{
    wanted_number w = { .path = path };
    output_numbers_visit(&(summary_object){ keys, NULL }, find_form, &w);
    return w.met;
}

/* The first of its path. */
static void find_number(void *user, const output_number *number)
{
    wanted_number *w = user;
    if (w->met || strcmp(number->path, w->path) != 0) return;
    w->met = true;
    w->value = number->value;
    if (w->unit) snprintf(w->unit, SUMMARY_NAME_SIZE, "%s", number->unit);
}

double output_number_of(const summary_object *o, const char *path, char unit[SUMMARY_NAME_SIZE])
{
    wanted_number w = { path, unit, NAN, false };
    output_numbers_visit(o, find_number, &w);
    return isfinite(w.value) ? w.value : NAN;
}

/* ---- for people ---- */

/* Numbers in one unit, with the prefix of the largest: 967.1 and kA, 1066 .. 1759 and m/s, in two cells. */
static void numbers_text(const double *x, int n, const char *unit, char *out, size_t size)
{
    const bool none = strcmp(unit, "1") == 0 || unit[0] == '\0';
    double largest = 0.0;
    char text[60];
    for (int i = 0; i < n; i++)
        if (isfinite(x[i])) largest = fmax(largest, fabs(x[i]));
    host_quantity_text(largest, none ? "1" : unit, text, sizeof text);
    const char *in = none ? "" : strchr(text, ' ') + 1;
    double scale = largest > 0.0 && !none ? strtod(text, NULL) / largest : 1.0;
    if (strcmp(in, "m3") == 0) {
        in = "mm3";
        scale = 1e9;
    }
    size_t used = 0;
    for (int i = 0; i < n && used < size; i++) {
        const char *between = i == 0 ? "" : n == 2 ? " .. " : ", ";
        used += (size_t)(isfinite(x[i]) ? snprintf(out + used, size - used, "%s%.4g", between, scale * x[i])
                                        : snprintf(out + used, size - used, "%s?", between));
    }
    if (used < size) snprintf(out + used, size - used, TABLE_NEXT "%s", in);
}

/* Value and unit, in two cells; false where there is nothing to show. */
static bool shown_text(const summary_key *k, const void *from, char *out, size_t size)
{
    cJSON *value = value_json(k, from);
    double x[8];
    const int n = cJSON_IsArray(value) ? cJSON_GetArraySize(value) : 1;
    bool known = false;
    for (int i = 0; i < n && i < 8; i++) {
        x[i] = number_of(cJSON_IsArray(value) ? cJSON_GetArrayItem(value, i) : value);
        known = known || isfinite(x[i]);
    }
    if (cJSON_IsString(value)) snprintf(out, size, "%.*s" TABLE_NEXT, (int)size - 2, value->valuestring);
    if (cJSON_IsString(value) || cJSON_IsBool(value)) known = !cJSON_IsString(value) || value->valuestring[0];
    if (cJSON_IsBool(value)) snprintf(out, size, "%s" TABLE_NEXT, cJSON_IsTrue(value) ? "yes" : "no");
    if (k->kind == KEY_COUNT || k->kind == KEY_INTEGER)
        snprintf(out, size, "%.0f" TABLE_NEXT, x[0]);
    else if (k->kind == KEY_NUMBER && n <= 8)
        numbers_text(x, n, k->unit, out, size);
    cJSON_Delete(value);
    return known;
}

static bool is_short(const summary_key *k)
{
    return k->kind <= KEY_NAME && strcmp(k->name, "reason") != 0;
}

/* Does the key stand for nothing, since what it belongs to was not asked for? */
static bool is_idle(const summary_object *o, const summary_key *k)
{
    return k->only_with && output_number_of(o, k->only_with, NULL) == 0.0;
}

enum { SHOWN_WIDTH = 100, LEAST_MEANING = 24 /* columns, else none */, VALUE_SIZE = 200 };

static bool is_shown(const summary_object *o, const summary_key *k, char value[VALUE_SIZE])
{
    return is_short(k) && !is_idle(o, k) && shown_text(k, o->of, value, VALUE_SIZE);
}

/* Columns that the table leaves for what its keys mean. */
static int room_for_meaning(const summary_object *o)
{
    int name = (int)strlen("result"), number = (int)strlen("value"), unit = (int)strlen("unit");
    char value[VALUE_SIZE];
    for (const summary_key *k = o->keys; k->name; k++) {
        if (!is_shown(o, k, value)) continue;
        const int digits = (int)strcspn(value, TABLE_NEXT);
        name = (int)fmax(name, strlen(k->name));
        number = (int)fmax(number, digits);
        unit = (int)fmax(unit, strlen(value + digits + 1));
    }
    return SHOWN_WIDTH - (name + 2 + number + 2 + unit + 2);
}

/* The key's row, with its doc to the first semicolon; rows below it go on with that. */
static void add_with_meaning(table *t, const summary_key *k, const char *value, int room)
{
    const char *at = k->doc, *end = k->doc + strcspn(k->doc, ";|");
    bool first = true;
    while (first || at < end) {
        int n = (int)(end - at);
        if (n > room)
            for (n = room; n > 0 && at[n] != ' '; n--) continue;
        if (n == 0) n = room; /* a word wider than that */
        host_table_row(t, "%s|%s|%.*s", first ? k->name : "", first ? value : TABLE_NEXT,
                       n < end - at ? n : (int)(end - at), at);
        at += n;
        while (at < end && *at == ' ') at++;
        first = false;
    }
}

void output_keys_print(const summary_object *o, FILE *out)
{
    table *t;
    const int room = o->of ? room_for_meaning(o) : 0;
    const bool explained = room >= LEAST_MEANING;
    if (!o->of || host_table_create(explained ? "result|value|unit|meaning" : "result|value|unit", &t).code) return;
    for (const summary_key *k = o->keys; k->name; k++) {
        char value[VALUE_SIZE];
        if (!is_shown(o, k, value)) continue;
        if (explained)
            add_with_meaning(t, k, value, room);
        else
            host_table_row(t, "%s|%s", k->name, value);
    }
    host_table_print(t, out);
    host_table_free(t);
}

const char *output_cell(double x, double unit, const char *format, char text[24])
{
    if (isfinite(x))
        snprintf(text, 24, format, x / unit);
    else
        snprintf(text, 24, "-");
    return text;
}

void output_summary_print(const run_summary *s, FILE *out)
{
    if (s->shot.keys) {
        output_keys_print(&s->shot, out);
        fputc('\n', out);
    }
    if (!s->print)
        output_keys_print(&s->result, out);
    else if (s->result.of)
        s->print(s->result.of, out);
    if (s->error) fprintf(out, "\n%s: %s\n", output_run_status_names[s->status], s->error);
}

void output_keys_manual(const char *title, const summary_key *keys, FILE *out)
{
    fprintf(out, "\n### %s\n\n| key | unit | what |\n|---|---|---|\n", title);
    for (const summary_key *k = keys; k->name; k++) {
        char size[16] = "";
        if (k->kind == KEY_PART) continue;
        if (k->kind == KEY_NUMBER && k->n > 1) snprintf(size, sizeof size, " [%d]", k->n);
        if (k->kind == KEY_MAP) snprintf(size, sizeof size, " {...}");
        if (k->kind == KEY_LIST || k->kind == KEY_ARRAY) snprintf(size, sizeof size, " [...]");
        fprintf(out, "| `%s`%s | %s | %s |\n", k->name, size, k->unit, k->doc);
    }
}
