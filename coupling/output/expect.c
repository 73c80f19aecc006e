/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/output/expect.h"

#include "coupling/host/outdir.h"
#include "coupling/host/units.h"
#include "coupling/host/yaml_tree.h"
#include "mpm/read/probe.h"

#include <cJSON.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
    const char *path; /* of the list */
    const units *u;
    const cJSON *summary;
    summary_tables tables; /* of it */
} comparison;

/* A place in the summary, come to by a path. */
typedef struct {
    const cJSON *at;         /* NULL: there is none */
    const summary_key *keys; /* of the object that it is; NULL: it is none, or nobody knows them */
    const summary_key *key;  /* of what it is a value of, or a part of that; NULL: nobody knows */
    const cJSON *owner;      /* the object with that key */
    const char *name;        /* of the last step */
} summary_place;

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
    "1",       "m",         "s",      "kg",     "m/s",    "Pa",    "J",      "K",       "N",      "N s",
    "m^2",     "m^3",       "A",      "V",      "W",      "ohm",   "H/m",    "1/s",     "Hz",     "m/s^2",
    "A^2 s",   "ohm/m",     "1/m",    "rad",    "1/K",    "J/kg",  "rad/s",  "N/m",     "H",      "F",
    "1/m^2",   "ohm/m^3",   "ohm m",  "Pa s",   "m^2/s",  "V s",   "mol",    "mol/s",   "kg m^2", "J s",
    "V s/rad", "N m s/rad", "kg/m^3", "kg/mol", "kg/m^2", "W/m/K", "J/kg/K", "J/m^3/K", "1/Pa",   "kg/s",
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

/* Without a unit: 0, and what is infinite. */
static bool needs_none(double value, const char *unit)
{
    return isinf(value) || (value == 0.0 && strcmp(unit, "1") == 0);
}

/* What 0 of a number's unit is in SI: 273.15 of degC. */
static double zero_of(const comparison *c, const char *text)
{
    char *unit, zero[UNIT_SIZE + 2];
    const char *own;
    double value;
    strtod(text, &unit);
    snprintf(zero, sizeof zero, "0%s", unit);
    return output_number_in_si(c->u, zero, &value, &own) ? value : 0.0;
}

/* due: the unit that the summary has it in, "" where nobody knows; then unit is that of the entry's numbers before this
 * one, NULL where none says it.  A band that is a part of the value (5 %) has none. */
static status read_number(const comparison *c, const tree_node *entry, const char *key, const char *due, double *value,
                          const char **unit)
{
    const tree_node *node = host_tree_find(entry, key);
    const char *own;
    char written[UNIT_SIZE];
    *value = NAN;
    if (!node) return status_ok();
    CHECK(node->kind == TREE_TEXT && output_number_in_si(c->u, node->text, value, &own), STATUS_BAD_INPUT,
          "%.200s:%d:%d: %s = %.60s: must be a number with a unit", c->path, node->line, node->column, key,
          node->kind == TREE_TEXT ? node->text : "a list");
    const bool band = strcmp(key, "within") == 0;
    const double zero = band ? zero_of(c, node->text) : 0.0; /* a difference, of degrees too */
    *value -= zero;
    if ((band && strchr(node->text, '%')) || needs_none(*value, own)) return status_ok();
    if (due[0]) {
        CHECK(host_quantity_read(c->u, node->text, due, value, written).code == STATUS_OK, STATUS_BAD_INPUT,
              "%.200s:%d:%d: %s = %.60s: must be in a unit of %s, as the summary's number", c->path, node->line,
              node->column, key, node->text, due);
        *value -= zero;
        return status_ok();
    }
    if (*value == 0.0) return status_ok();
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

static const summary_key *key_in(const summary_key *keys, const char *name)
{
    for (const summary_key *k = keys; k && k->name; k++) {
        const summary_key *found = k->kind == KEY_PART ? key_in(k->item, name) : strcmp(k->name, name) == 0 ? k : NULL;
        if (found) return found;
    }
    return NULL;
}

/* What the tables say of it, one name further; before `at` has gone there. */
static void step(const comparison *c, summary_place *p, const char *name)
{
    const summary_key *k = p->key;
    p->name = name;
    if (p->keys) {
        p->key = key_in(p->keys, name);
        p->owner = p->at;
        p->keys = !p->key && p->at == c->summary && strcmp(name, "shot") == 0 ? c->tables.shot : NULL;
    } else if (k && (k->kind == KEY_LIST || k->kind == KEY_MAP)) {
        p->keys = k->item + (k->kind == KEY_MAP);
        p->key = NULL;
    }
}

static summary_place place_of(const comparison *c, const char *path, char word[EXPECT_TEXT_SIZE])
{
    summary_place p = { .at = c->summary, .keys = c->tables.result };
    while (p.at && *path) {
        const bool inside = *path == '[';
        const size_t length = strcspn(path + inside, inside ? "]" : ".[]");
        snprintf(word, EXPECT_TEXT_SIZE, "%.*s", (int)length, path + inside);
        step(c, &p, word);
        p.at = inside ? entry_of(p.at, word, length) : cJSON_GetObjectItemCaseSensitive(p.at, word);
        path += length + inside;
        path += inside && *path == ']';
        path += *path == '.';
    }
    return p;
}

static const char *column_unit(const char *probe_kind, const char *name)
{
    const mpm_probe_kind *kind = probe_kind ? mpm_probe_kind_find(probe_kind) : NULL;
    for (const mpm_column *column = kind ? kind->columns : NULL; column && column->name; column++)
        if (strcmp(column->name, name) == 0) return column->unit;
    return "";
}

static const char *text_of(const cJSON *object, const char *name)
{
    const char *text = cJSON_GetStringValue(cJSON_GetObjectItemCaseSensitive(object, name));
    return text ? text : "";
}

/* Of the number there; "" where nobody knows. */
static void unit_at(const comparison *c, const summary_place *p, char unit[SUMMARY_NAME_SIZE])
{
    const summary_key *k = p->key;
    unit[0] = '\0';
    if (!k) return;
    const char *own = text_of(p->owner, "unit"), *integral = output_unit_over_time(own), *found = "";
    const bool over_time = !k->unit[0] && own[0] && k->kind == KEY_NUMBER && k->n > 1;
    if (k->unit[0])
        found = k->unit;
    else if (k->kind == KEY_COUNT || k->kind == KEY_INTEGER)
        found = "1";
    else if (k->kind == KEY_NUMBER)
        found = over_time && integral ? integral : own;
    else if (k->kind == KEY_BY_NAME)
        found = column_unit(text_of(p->owner, "kind"), p->name);
    else if (k->kind == KEY_PAIRS && strcmp(k->name, "errors") != 0) /* inputs and outputs of a sweep */
        found = text_of(cJSON_GetObjectItemCaseSensitive(c->summary, "units"), p->name);
    snprintf(unit, SUMMARY_NAME_SIZE, "%s%s", found, over_time && !integral ? " s" : "");
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

static status compare_number(const comparison *c, const tree_node *entry, const cJSON *found, const char *due,
                             expectation *e)
{
    double value, least, most, within = NAN;
    const char *unit = NULL;
    const tree_node *band = host_tree_find(entry, "within");
    TRY(read_number(c, entry, "value", due, &value, &unit));
    TRY(read_number(c, entry, "within", due, &within, &unit));
    TRY(read_number(c, entry, "at_least", due, &least, &unit));
    TRY(read_number(c, entry, "at_most", due, &most, &unit));
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
    char word[EXPECT_TEXT_SIZE], due[SUMMARY_NAME_SIZE];
    const summary_place found = place_of(c, key->text, word);
    unit_at(c, &found, due);
    return is ? compare_text(is, found.at, e) : compare_number(c, entry, found.at, due, e);
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

static status compare_list(const char *path, const char *bytes, size_t length, const cJSON *summary,
                           summary_tables tables, expectations *out)
{
    tree_node *list = NULL;
    units *u = NULL;
    int line = 0, column = 0;
    const status parsed = host_tree_parse(bytes, length, &list, &line, &column);
    CHECK(parsed.code == STATUS_OK, parsed.code, "%.200s:%d:%d: %.250s", path, line, column, parsed.text);
    status s = host_units_open(&u);
    if (s.code == STATUS_OK) s = compare_all(&(comparison){ path, u, summary, tables }, list, out);
    host_units_close(u);
    host_tree_free(list);
    return s;
}

status output_expect(const char *case_file, const char *dir, summary_tables (*tables_of)(const char *kind),
                     expectations *out)
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
        s = summary ? compare_list(path, bytes, length, summary, tables_of(text_of(summary, "kind")), out)
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
