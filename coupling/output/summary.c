#include "coupling/host/version.h"
#include "coupling/output/summary_keys.h"

#include "coupling/host/outdir.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

const char *const output_site_outcome_names[] = { "not_reached", "skipped",   "none", "scratch",
                                                  "gouge",       "undecided", NULL };
const char *const output_onset_verdict_names[] = { "gouges", "no_gouging", "undecided", NULL };
const char *const output_run_kind_names[] = { "shot", "scene", "onset", "compare", "inductance", NULL };
const char *const output_run_status_names[] = { "done", "stopped", "failed", NULL };

/* ---- JSON ---- */

static cJSON *number_json(double value)
{
    return isfinite(value) ? cJSON_CreateNumber(value) : cJSON_CreateNull();
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

static cJSON *by_body_json(const scene_result *r, const double *value)
{
    cJSON *object = cJSON_CreateObject();
    for (int b = 0; b < r->bodies && b < MPM_MAX_BODIES; b++)
        cJSON_AddItemToObject(object, r->body[b], number_json(value[b]));
    return object;
}

static void add_keys(cJSON *object, const summary_key *keys, const void *from);

static const scene_result *result_of(const void *scene)
{
    return &((const onset_scene *)scene)->result;
}

static cJSON *list_json(const summary_key *k, const char *base)
{
    const int n = *(const int *)(base + k->n_offset);
    const char *items = *(const char *const *)(base + k->offset);
    cJSON *list = cJSON_CreateArray();
    for (int i = 0; i < n; i++) {
        const char *item = items + (size_t)i * k->item_size;
        cJSON *object = cJSON_CreateObject();
        add_keys(object, k->item, item);
        if (k->item == output_summary_study_scene_keys) add_keys(object, output_summary_scene_keys, result_of(item));
        cJSON_AddItemToArray(list, object);
    }
    return list;
}

cJSON *output_summary_value_json(const summary_key *k, const void *from)
{
    const char *base = from;
    const void *member = base + k->offset;
    switch (k->kind) {
    case KEY_NUMBER: return k->n == 1 ? number_json(*(const double *)member) : vector_or_null(member, k->n);
    case KEY_COUNT: return cJSON_CreateNumber((double)*(const uint64_t *)member);
    case KEY_INTEGER: return cJSON_CreateNumber(*(const int *)member);
    case KEY_FLAG: return cJSON_CreateBool(*(const bool *)member);
    case KEY_TEXT: return cJSON_CreateString(member);
    case KEY_NAME: return cJSON_CreateString(k->names[*(const int *)member]);
    case KEY_BY_BODY: return by_body_json(from, (const double *)member);
    case KEY_LIST: return list_json(k, base);
    case KEY_ARRAY:
        return vector_json(*(const double *const *)member, *(const int *)(const void *)(base + k->n_offset));
    }
    return NULL;
}

/* from == NULL: every key, null. */
static void add_keys(cJSON *object, const summary_key *keys, const void *from)
{
    for (const summary_key *k = keys; k->name; k++)
        cJSON_AddItemToObject(object, k->name, from ? output_summary_value_json(k, from) : cJSON_CreateNull());
}

static cJSON *warnings_json(const char *warnings)
{
    cJSON *list = cJSON_CreateArray();
    for (const char *line = warnings ? warnings : ""; *line;) {
        const size_t n = strcspn(line, "\n");
        char text[1000];
        snprintf(text, sizeof text, "%.*s", (int)(n < sizeof text ? n : sizeof text - 1), line);
        if (n) cJSON_AddItemToArray(list, cJSON_CreateString(text));
        line += n + (line[n] == '\n');
    }
    return list;
}

static void add_common(cJSON *root, const run_summary *s)
{
    cJSON_AddStringToObject(root, "kind", output_run_kind_names[s->kind]);
    cJSON_AddStringToObject(root, "case", s->case_name ? s->case_name : "");
    cJSON_AddStringToObject(root, "version", host_version());
    cJSON_AddStringToObject(root, "instruction_set", s->instruction_set ? s->instruction_set : "");
    cJSON_AddStringToObject(root, "status", output_run_status_names[s->status]);
    if (s->error)
        cJSON_AddStringToObject(root, "error", s->error);
    else
        cJSON_AddNullToObject(root, "error");
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
    add_keys(root, output_summary_keys_of_kind[s->kind], output_summary_object_of_kind(s));
    if (s->kind == RUN_ONSET || s->kind == RUN_COMPARE) {
        cJSON *shot_json = cJSON_CreateObject();
        add_keys(shot_json, output_summary_shot_keys, s->shot);
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

void output_summary_status(const char *dir, char *out, size_t size)
{
    out[0] = '\0';
    char path[OUTDIR_PATH_SIZE], *text;
    const int n = snprintf(path, sizeof path, "%s/%s", dir, OUTDIR_SUMMARY);
    if (n < 0 || (size_t)n >= sizeof path || host_file_read(path, &text, NULL).code != STATUS_OK) return;
    cJSON *root = cJSON_Parse(text);
    const char *word = cJSON_GetStringValue(cJSON_GetObjectItemCaseSensitive(root, "status"));
    if (word) snprintf(out, size, "%s", word);
    cJSON_Delete(root);
    free(text);
}

/* ---- one scene as text, and back ---- */

char *output_summary_scene_text(const onset_scene *s)
{
    cJSON *object = cJSON_CreateObject();
    add_keys(object, output_summary_study_scene_keys, s);
    add_keys(object, output_summary_scene_keys, result_of(s));
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

static bool read_by_body(const cJSON *object, scene_result *r, double *out)
{
    const cJSON *value;
    r->bodies = 0;
    cJSON_ArrayForEach(value, object)
    {
        if (r->bodies == MPM_MAX_BODIES) return false;
        snprintf(r->body[r->bodies], sizeof r->body[0], "%s", value->string);
        out[r->bodies++] = number_of(value);
    }
    return cJSON_IsObject(object);
}

/* The kinds a scene's result has; value_json the other way round. */
static bool read_value(const summary_key *k, const cJSON *value, scene_result *r)
{
    void *member = (char *)r + k->offset;
    double *number = member;
    switch (k->kind) {
    case KEY_NUMBER:
        for (int i = 0; i < k->n; i++) number[i] = number_of(k->n == 1 ? value : cJSON_GetArrayItem(value, i));
        return value != NULL;
    case KEY_COUNT: *(uint64_t *)member = (uint64_t)cJSON_GetNumberValue(value); return cJSON_IsNumber(value);
    case KEY_INTEGER: *(int *)member = (int)cJSON_GetNumberValue(value); return cJSON_IsNumber(value);
    case KEY_FLAG: *(bool *)member = cJSON_IsTrue(value); return cJSON_IsBool(value);
    case KEY_TEXT: /* the only one of a result is its reason */
        snprintf(member, sizeof r->reason, "%s", cJSON_IsString(value) ? value->valuestring : "");
        return cJSON_IsString(value);
    case KEY_NAME: *(int *)member = name_index(k->names, cJSON_GetStringValue(value)); return *(int *)member >= 0;
    case KEY_BY_BODY: return read_by_body(value, r, member);
    case KEY_LIST:
    case KEY_ARRAY: break;
    }
    return false;
}

status output_summary_scene_result(const char *text, scene_result *out)
{
    memset(out, 0, sizeof *out);
    cJSON *root = cJSON_Parse(text);
    const char *missing = NULL;
    for (const summary_key *k = output_summary_scene_keys; k->name && !missing; k++)
        if (!read_value(k, cJSON_GetObjectItemCaseSensitive(root, k->name), out)) missing = k->name;
    cJSON_Delete(root);
    CHECK(!missing, STATUS_IO, "the result of a scene has no `%s`", missing);
    return status_ok();
}
