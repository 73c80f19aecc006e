/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/output/expect.h"

#include "coupling/host/outdir.h"
#include "coupling/host/units.h"
#include "coupling/host/yaml_tree.h"

#include <cJSON.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
    const char *path; /* of the list */
    const units *u;
    const cJSON *summary;
} comparison;

/* "expected.yaml" for case.yaml, "NAME_expected.yaml" for NAME.yaml, in the case's folder. */
static void list_path(const char *case_file, char path[OUTDIR_PATH_SIZE])
{
    const char *slash = strrchr(case_file, '/'), *name = slash ? slash + 1 : case_file, *dot = strrchr(name, '.');
    const int folder = (int)(name - case_file), stem = dot ? (int)(dot - name) : (int)strlen(name);
    const bool plain = stem == 4 && strncmp(name, "case", 4) == 0;
    snprintf(path, OUTDIR_PATH_SIZE, "%.*s%.*s%sexpected.yaml", folder, case_file, plain ? 0 : stem, name,
             plain ? "" : "_");
}

/* ---- numbers with units ---- */

/* The SI units of the numbers of summaries and cases; the first that the text's unit can be converted to is its own.
 * tests/test_output_expect.c looks for the unit of each. */
static const char *const si_units[] = {
    "1",   "m",     "s",      "kg",  "m/s",    "Pa",     "J",      "K",       "N",      "N s",     "m^2",   "m^3",
    "A",   "V",     "W",      "ohm", "H/m",    "1/s",    "Hz",     "m/s^2",   "A^2 s",  "ohm/m",   "1/m",   "rad",
    "1/K", "J/kg",  "rad/s",  "N/m", "H",      "F",      "1/m^2",  "ohm/m^3", "ohm m",  "Pa s",    "m^2/s", "V s",
    "mol", "mol/s", "kg m^2", "J s", "kg/m^3", "kg/mol", "kg/m^2", "W/m/K",   "J/kg/K", "J/m^3/K", "1/Pa",  "kg/s",
};

bool output_number_in_si(const units *u, const char *text, double *value, const char **unit)
{
    char own[UNIT_SIZE];
    for (size_t i = 0; i < sizeof si_units / sizeof si_units[0]; i++)
        if (host_quantity_read(u, text, si_units[i], value, own).code == STATUS_OK) {
            *unit = si_units[i];
            return true;
        }
    return false;
}

/* unit: of the entry's numbers before this one, NULL where none says it.  0 and what is infinite need none, and a band
 * that is a part of the value (5 %) has none. */
static status read_number(const comparison *c, const tree_node *entry, const char *key, double *value,
                          const char **unit)
{
    const tree_node *node = host_tree_find(entry, key);
    const char *own;
    *value = NAN;
    if (!node) return status_ok();
    CHECK(node->kind == TREE_TEXT && output_number_in_si(c->u, node->text, value, &own), STATUS_BAD_INPUT,
          "%.200s:%d:%d: %s = %.60s: must be a number with a unit", c->path, node->line, node->column, key,
          node->kind == TREE_TEXT ? node->text : "a list");
    const bool part = strcmp(key, "within") == 0 && strchr(node->text, '%');
    if (*value == 0.0 || isinf(*value) || part) return status_ok();
    CHECK(!*unit || strcmp(*unit, own) == 0, STATUS_BAD_INPUT,
          "%.200s:%d:%d: %s = %.60s: must be in a unit of %s, as the number before it", c->path, node->line,
          node->column, key, node->text, *unit);
    *unit = own;
    return status_ok();
}

/* ---- the way to a number of the summary ---- */

/* What an entry of a list is called: its `name`, of a ranking its `surface`. */
static const char *name_of(const cJSON *entry)
{
    const char *name = cJSON_GetStringValue(cJSON_GetObjectItemCaseSensitive(entry, "name"));
    return name ? name : cJSON_GetStringValue(cJSON_GetObjectItemCaseSensitive(entry, "surface"));
}

/* Entry of a list by its number or by its name; of an object by its name, which may have dots. */
static const cJSON *entry_of(const cJSON *list, const char *which, size_t length)
{
    char word[EXPECT_TEXT_SIZE], *end;
    snprintf(word, sizeof word, "%.*s", (int)length, which);
    if (cJSON_IsObject(list)) return cJSON_GetObjectItemCaseSensitive(list, word);
    const long number = strtol(word, &end, 10);
    if (*end == '\0' && end != word)
        return number >= 0 && number < cJSON_GetArraySize(list) ? cJSON_GetArrayItem(list, (int)number) : NULL;
    const cJSON *item;
    cJSON_ArrayForEach(item, list)
    {
        const char *name = name_of(item);
        if (name && strcmp(name, word) == 0) return item;
    }
    return NULL;
}

static const cJSON *summary_at(const cJSON *root, const char *path)
{
    const cJSON *at = root;
    while (at && *path) {
        const size_t length = strcspn(path, ".[]");
        char key[EXPECT_TEXT_SIZE];
        if (*path == '[') {
            const size_t inside = strcspn(path + 1, "]");
            at = entry_of(at, path + 1, inside);
            path += 1 + inside + (path[1 + inside] == ']');
        } else {
            snprintf(key, sizeof key, "%.*s", (int)length, path);
            at = cJSON_GetObjectItemCaseSensitive(at, key);
            path += length;
        }
        if (*path == '.') path++;
    }
    return at;
}

/* ---- one expectation ---- */

static status no_such_key(const comparison *c, const tree_node *key)
{
    static const char *const known[] = { "key", "value", "within", "at_least", "at_most", "is", "source" };
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++)
        if (strcmp(known[i], key->text) == 0) return status_ok();
    return base_status_error(STATUS_BAD_INPUT,
                             "%.200s:%d:%d: unknown key `%.60s`: key, value, within, at_least, at_most, is, source",
                             c->path, key->line, key->column, key->text);
}

static status compare_text(const tree_node *is, const cJSON *found, expectation *e)
{
    const char *text = cJSON_IsString(found) ? found->valuestring
                       : cJSON_IsBool(found) ? (cJSON_IsTrue(found) ? "yes" : "no")
                       : cJSON_IsNull(found) ? "none"
                                             : "";
    snprintf(e->wanted, sizeof e->wanted, "%.100s", is->text);
    if (found) snprintf(e->found, sizeof e->found, "%.100s", text);
    e->holds = found && strcmp(text, is->text) == 0;
    return status_ok();
}

static status compare_number(const comparison *c, const tree_node *entry, const cJSON *found, expectation *e)
{
    double value, least, most, within = NAN;
    const char *unit = NULL;
    const tree_node *band = host_tree_find(entry, "within");
    TRY(read_number(c, entry, "value", &value, &unit));
    TRY(read_number(c, entry, "within", &within, &unit));
    TRY(read_number(c, entry, "at_least", &least, &unit));
    TRY(read_number(c, entry, "at_most", &most, &unit));
    CHECK(!isnan(value) || !isnan(least) || !isnan(most), STATUS_BAD_INPUT,
          "%.200s:%d:%d: give a value, at_least, at_most or is", c->path, entry->line, entry->column);
    CHECK(isnan(value) == isnan(within), STATUS_BAD_INPUT, "%.200s:%d:%d: `value` and `within` belong together",
          c->path, entry->line, entry->column);
    CHECK(!(within < 0.0), STATUS_BAD_INPUT, "%.200s:%d:%d: within = %.60s: must not be negative", c->path, band->line,
          band->column, band->text);
    if (band && strchr(band->text, '%')) within *= fabs(value);
    const bool there = cJSON_IsNumber(found);
    const double is = there ? found->valuedouble : NAN;
    int used = 0;
    if (!isnan(value)) used = snprintf(e->wanted, sizeof e->wanted, "%.6g +- %.3g", value, within);
    if (!isnan(least)) used += snprintf(e->wanted + used, sizeof e->wanted - (size_t)used, " >= %.6g", least);
    if (!isnan(most)) snprintf(e->wanted + used, sizeof e->wanted - (size_t)used, " <= %.6g", most);
    if (there) snprintf(e->found, sizeof e->found, "%.6g", is);
    e->deviation = value != 0 ? is / value - 1 : NAN;
    e->holds = there && (isnan(value) || fabs(is - value) <= within) && !(is < least) && !(is > most);
    return status_ok();
}

static status compare_one(const comparison *c, const tree_node *entry, expectation *e)
{
    *e = (expectation){ .found = "missing", .deviation = NAN };
    CHECK(entry->kind == TREE_MAP, STATUS_BAD_INPUT, "%.200s:%d:%d: an entry is {key: .., value: .., within: ..}",
          c->path, entry->line, entry->column);
    for (int i = 0; i < entry->n; i++) TRY(no_such_key(c, entry->key[i]));
    const tree_node *key = host_tree_find(entry, "key"), *is = host_tree_find(entry, "is"),
                    *source = host_tree_find(entry, "source");
    CHECK(key && key->kind == TREE_TEXT && key->text[0] && strlen(key->text) < sizeof e->key, STATUS_BAD_INPUT,
          "%.200s:%d:%d: `key` is missing: the name of a number in summary.json", c->path, entry->line, entry->column);
    CHECK(!is || is->kind == TREE_TEXT, STATUS_BAD_INPUT, "%.200s:%d:%d: `is` must be a word", c->path, entry->line,
          entry->column);
    static const char *const of_numbers[] = { "value", "within", "at_least", "at_most" };
    for (size_t i = 0; is && i < sizeof of_numbers / sizeof of_numbers[0]; i++)
        CHECK(!host_tree_find(entry, of_numbers[i]), STATUS_BAD_INPUT, "%.200s:%d:%d: `is` and `%s` exclude each other",
              c->path, is->line, is->column, of_numbers[i]);
    snprintf(e->key, sizeof e->key, "%s", key->text);
    if (source && source->kind == TREE_TEXT) snprintf(e->source, sizeof e->source, "%.100s", source->text);
    const cJSON *found = summary_at(c->summary, key->text);
    return is ? compare_text(is, found, e) : compare_number(c, entry, found, e);
}

/* ---- all of them ---- */

static status compare_all(const comparison *c, const tree_node *list, expectations *out)
{
    CHECK(list->kind == TREE_LIST && list->n > 0, STATUS_BAD_INPUT, "%.200s:1:1: must be a list of expectations",
          c->path);
    out->item = calloc((size_t)list->n, sizeof *out->item);
    CHECK(out->item, STATUS_MEMORY, "no memory for %d expectations", list->n);
    for (int i = 0; i < list->n; i++) {
        TRY(compare_one(c, list->item[i], &out->item[i]));
        out->n++;
        out->held += out->item[i].holds;
    }
    return status_ok();
}

static status compare_list(const char *path, const char *bytes, size_t length, const cJSON *summary, expectations *out)
{
    tree_node *list = NULL;
    units *u = NULL;
    int line = 0, column = 0;
    const status parsed = host_tree_parse(bytes, length, &list, &line, &column);
    CHECK(parsed.code == STATUS_OK, parsed.code, "%.200s:%d:%d: %.250s", path, line, column, parsed.text);
    status s = host_units_open(&u);
    if (s.code == STATUS_OK) s = compare_all(&(comparison){ path, u, summary }, list, out);
    host_units_close(u);
    host_tree_free(list);
    return s;
}

status output_expect(const char *case_file, const char *dir, expectations *out)
{
    char path[OUTDIR_PATH_SIZE], results[OUTDIR_PATH_SIZE], *bytes = NULL, *json = NULL;
    size_t length = 0;
    *out = (expectations){ 0, 0, NULL };
    list_path(case_file, path);
    const int used = snprintf(results, sizeof results, "%s/%s", dir, OUTDIR_SUMMARY);
    CHECK(used < (int)sizeof results, STATUS_BAD_INPUT, "--expect %.60s...: a path has at most %zu bytes", dir,
          sizeof results - 1);
    TRY(host_file_text(path, TREE_MAX_BYTES, &bytes, &length));
    status s = host_file_read(results, &json, NULL);
    if (s.code == STATUS_OK) {
        cJSON *summary = cJSON_Parse(json);
        s = summary ? compare_list(path, bytes, length, summary, out)
                    : base_status_error(STATUS_BAD_INPUT, "%.400s: this is no summary of a run", results);
        cJSON_Delete(summary);
    }
    free(json);
    free(bytes);
    return s;
}

void output_expect_free(expectations *e)
{
    free(e->item);
    *e = (expectations){ 0, 0, NULL };
}
