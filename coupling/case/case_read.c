/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/case/case_bodies.h"
#include "coupling/case/case_place.h"
#include "coupling/case/case_reader.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

/* ---- one value ---- */

static bool is_word(const char *text, const char *const *words)
{
    for (int k = 0; words[k]; k++)
        if (strcasecmp(text, words[k]) == 0) return true;
    return false;
}

static void wrong(case_reader *r, const tree_node *node, const char *path, const char *reason)
{
    case_errors_add(r->errors, node, "%s = " CASE_ECHO ": %s", path, CASE_ECHO_OF(node->text), reason);
}

/* " (1 mm .. 1 km)"; "": any value will do, or the value is no number. */
static const char *range_text(const case_reader *r, const base_param *p, const char *user_unit,
                              char out[LIMITS_SIZE + 3])
{
    char limits[LIMITS_SIZE];
    const bool number = p->kind != BASE_PARAM_FLAG && p->kind != BASE_PARAM_CHOICE && p->kind != BASE_PARAM_TEXT;
    out[0] = '\0';
    if (!number || (isinf(p->min) && isinf(p->max))) return out;
    host_quantity_limits(r->u, p->min, p->max, p->unit, user_unit, limits);
    snprintf(out, LIMITS_SIZE + 3, " (%s)", limits);
    return out;
}

/* What is no number of this unit, with the range that one must lie in. */
static void no_number(case_reader *r, const base_param *p, const tree_node *node, const char *path, const char *reason)
{
    char range[LIMITS_SIZE + 3];
    case_errors_add(r->errors, node, "%s = " CASE_ECHO ": %s%s", path, CASE_ECHO_OF(node->text), reason,
                    range_text(r, p, strcmp(p->unit, "rad") == 0 ? "deg" : "", range));
}

static void out_of_range(case_reader *r, const base_param *p, const tree_node *node, const char *path,
                         const char *user_unit, double value)
{
    char range[LIMITS_SIZE + 3];
    const bool kelvin = strcmp(p->unit, "K") == 0; /* what is positive may be below zero, in degC */
    const char *must = p->min > 0.0 && value <= 0.0 && !kelvin ? "must be positive" : "must lie within the range";
    case_errors_add(r->errors, node, "%s = " CASE_ECHO ": %s%s", path, CASE_ECHO_OF(node->text), must,
                    range_text(r, p, user_unit, range));
}

static const double UNIT_ROUNDING = 1e-14; /* quantities keep 15 digits when their unit changes [1] */

/* A limit given in another unit, 90 deg for pi/2, may miss it by rounding. */
static double on_limit(double value, const base_param *p)
{
    if (isfinite(p->max) && fabs(value - p->max) <= UNIT_ROUNDING * fabs(p->max)) return p->max;
    if (isfinite(p->min) && fabs(value - p->min) <= UNIT_ROUNDING * fabs(p->min)) return p->min;
    return value;
}

static void read_number(case_reader *r, const base_param *p, const tree_node *node, double *member, const char *path)
{
    char user_unit[UNIT_SIZE];
    double value;
    if (isnan(p->fallback) && strcmp(node->text, "none") == 0) {
        *member = NAN;
        return;
    }
    if (isinf(p->max) && strcmp(node->text, "never") == 0) {
        *member = INFINITY;
        return;
    }
    const status s = host_quantity_read(r->u, node->text, p->unit, &value, user_unit);
    if (s.code != STATUS_OK) {
        no_number(r, p, node, path, s.text);
        return;
    }
    value = on_limit(value, p);
    if (value < p->min || value > p->max)
        out_of_range(r, p, node, path, user_unit, value);
    else
        *member = value;
}

static void read_integer(case_reader *r, const base_param *p, const tree_node *node, int *member, const char *path)
{
    char *end = NULL;
    const double value = strtod(node->text, &end); /* 1e3 is one too */
    const bool plain = node->text[strspn(node->text, "+-.0123456789eE")] == '\0';
    if (end == node->text || *end != '\0' || !plain || value != floor(value))
        no_number(r, p, node, path, "must be a whole number");
    else if (value < p->min || value > p->max)
        out_of_range(r, p, node, path, "", value);
    else
        *member = (int)value;
}

static void read_flag(case_reader *r, const tree_node *node, bool *member, const char *path)
{
    static const char *const yes[] = { "true", "yes", "on", NULL }, *const no[] = { "false", "no", "off", NULL };
    if (is_word(node->text, yes))
        *member = true;
    else if (is_word(node->text, no))
        *member = false;
    else
        wrong(r, node, path, "must be yes or no");
}

static const char *choice_name(const void *choices, int i)
{
    return ((const char *const *)choices)[i];
}

static void read_choice(case_reader *r, const base_param *p, const tree_node *node, int *member, const char *path)
{
    char known[200] = "";
    for (int k = 0; p->choices[k]; k++) {
        if (strcmp(node->text, p->choices[k]) == 0) {
            *member = k;
            return;
        }
        const size_t used = strlen(known);
        snprintf(known + used, sizeof known - used, "%s%s", k > 0 ? ", " : "", p->choices[k]);
    }
    const char *near = host_nearest_name(node->text, choice_name, p->choices);
    case_errors_add(r->errors, node, "%s = " CASE_ECHO ": must be one of %s%s%s%s", path, CASE_ECHO_OF(node->text),
                    known, near ? "; did you mean `" : "", near ? near : "", near ? "`?" : "");
}

void case_note_material(case_reader *r, const char *name, const tree_node *where, const char *path)
{
    const size_t n = (size_t)r->n_use;
    if ((n & (n - 1)) == 0) { /* grow at powers of two */
        material_use *more = realloc(r->use, (n == 0 ? 1 : 2 * n) * sizeof *more);
        if (!more) {
            r->out_of_memory = true;
            return;
        }
        r->use = more;
    }
    material_use *use = &r->use[r->n_use++];
    snprintf(use->name, sizeof use->name, "%s", name);
    snprintf(use->key, sizeof use->key, "%s", path);
    use->where = where;
}

/* `material`, `film_material`, .. */
static bool names_material(const char *key)
{
    const size_t n = strlen(key), whole = strlen("material");
    return n >= whole && strcmp(key + n - whole, "material") == 0;
}

static void read_text(case_reader *r, const base_param *p, const tree_node *node, char *member, const char *path)
{
    const size_t size = base_param_text_size(p);
    if (strlen(node->text) >= size) {
        case_errors_add(r->errors, node, "%s = %.*s...: longer than %zu bytes", path, CASE_SHOWN, node->text, size - 1);
        return;
    }
    if (!p->fallback_text && node->text[0] == '\0') {
        case_errors_add(r->errors, node, "%s is empty: %s", path, p->doc);
        return;
    }
    snprintf(member, size, "%s", node->text);
    if (names_material(p->key) && node->text[0] != '\0') case_note_material(r, node->text, node, path);
}

/* "0 -50 50 mm": three numbers and the unit of all. */
static void read_vector_text(case_reader *r, const base_param *p, const tree_node *node, double *member,
                             const char *path)
{
    const char *number[3];
    int n = 0, length[3];
    char *end = node->text;
    for (; n < 3; n++) {
        number[n] = end + strspn(end, " \t");
        strtod(number[n], &end);
        if (end <= number[n]) break;
        length[n] = (int)(end - number[n]);
    }
    if (n < 3) {
        const bool bare = strcmp(p->unit, "1") == 0, length_unit = strcmp(p->unit, "m") == 0;
        char reason[UNIT_SIZE + 80];
        snprintf(reason, sizeof reason, "must be three numbers%s, `0 -50 50%s%s`, or [x, y, z]",
                 bare ? "" : " and their unit", bare ? "" : " ",
                 bare          ? ""
                 : length_unit ? "mm"
                               : p->unit);
        wrong(r, node, path, reason);
        return;
    }
    for (int k = 0; k < 3; k++) {
        char text[TREE_MAX_TEXT + 50];
        tree_node one = *node;
        snprintf(text, sizeof text, "%.*s%s", length[k], number[k], end); /* an error shows it as it is written */
        one.text = text;
        read_number(r, p, &one, &member[k], path);
    }
}

static void read_vector(case_reader *r, const base_param *p, const tree_node *node, double *member, const char *path)
{
    char entry[CASE_KEY_SIZE];
    if (node->kind == TREE_TEXT) {
        read_vector_text(r, p, node, member, path);
        return;
    }
    if (node->kind != TREE_LIST || node->n != 3) {
        case_errors_add(r->errors, node, "%s: must be three values, [x, y, z] or \"x y z unit\", in %s", path, p->unit);
        return;
    }
    for (int k = 0; k < 3; k++) {
        snprintf(entry, sizeof entry, "%s[%d]", path, k);
        if (node->item[k]->kind == TREE_TEXT)
            read_number(r, p, node->item[k], &member[k], entry);
        else
            case_errors_add(r->errors, node->item[k], "%s: must be one value", entry);
    }
}

static void read_points(case_reader *r, const base_param *p, const tree_node *node, double *member, const char *path)
{
    char entry[CASE_KEY_SIZE];
    if (node->kind != TREE_LIST || node->n < 1 || node->n > p->room) {
        case_errors_add(r->errors, node, "%s: must be a list of 1 .. %d pairs, [[a, b], ...], in %s", path, p->room,
                        p->unit);
        return;
    }
    for (int i = 0; i < node->n; i++) {
        const tree_node *pair = node->item[i];
        snprintf(entry, sizeof entry, "%s[%d]", path, i);
        if (pair->kind != TREE_LIST || pair->n != 2 || pair->item[0]->kind != TREE_TEXT ||
            pair->item[1]->kind != TREE_TEXT) {
            case_errors_add(r->errors, pair, "%s: must be two values, [a, b], in %s", entry, p->unit);
            continue;
        }
        for (int k = 0; k < 2; k++) read_number(r, p, pair->item[k], &member[2 * i + k], entry);
    }
}

void case_value_read(case_reader *r, const base_param *p, const tree_node *node, void *member, const char *path)
{
    if (p->kind == BASE_PARAM_VECTOR) {
        read_vector(r, p, node, member, path);
        return;
    }
    if (p->kind == BASE_PARAM_POINTS) {
        read_points(r, p, node, member, path);
        return;
    }
    if (node->kind != TREE_TEXT) {
        char range[LIMITS_SIZE + 3];
        case_errors_add(r->errors, node, "%s: must be one value, not a %s%s", path,
                        node->kind == TREE_MAP ? "section" : "list", range_text(r, p, "", range));
        return;
    }
    if (host_tree_is_empty(node)) {
        char unit[UNIT_SIZE + 3];
        case_errors_add(r->errors, node, "%s has no value%s: %s", path, case_unit_text(p, unit), p->doc);
        return;
    }
    switch (p->kind) {
    case BASE_PARAM_NUMBER: read_number(r, p, node, member, path); break;
    case BASE_PARAM_INTEGER: read_integer(r, p, node, member, path); break;
    case BASE_PARAM_FLAG: read_flag(r, node, member, path); break;
    case BASE_PARAM_CHOICE: read_choice(r, p, node, member, path); break;
    case BASE_PARAM_TEXT: read_text(r, p, node, member, path); break;
    case BASE_PARAM_VECTOR:
    case BASE_PARAM_POINTS: break;
    }
}

/* ---- keys ---- */

static bool is_root(const case_section *section)
{
    return section->table == case_root.table;
}

/* Of the case as a whole `base` too, which no table has: its file's tree is read over that of its base. */
static const char *known_key(const void *user, int i)
{
    if (is_root(user) && i-- == 0) return "base";
    for (const case_section *part = user; part; part = part->also) {
        for (const base_param *p = part->table; p->key; p++)
            if (i-- == 0) return p->key;
        for (const case_section *s = part->children; s && s->key; s++)
            if (i-- == 0) return s->key;
    }
    return NULL;
}

static bool has_key(const case_section *section, const char *key)
{
    for (int i = 0; known_key(section, i); i++)
        if (strcmp(known_key(section, i), key) == 0) return true;
    return false;
}

/* The section of the case, other than `not_this`, that has this very key; of a scene with bodies too. */
static const char *home_of(const char *key, const case_section *not_this)
{
    for (const case_section *s = case_root.children; s->key; s++)
        if (s != not_this && has_key(s, key)) return s->key;
    for (const case_section *s = case_bodies_manual; s->key; s++) {
        const char *dot = strchr(s->key, '.'); /* scene.bodies: a list, itself a key of the scene */
        if (dot && strcmp(dot + 1, key) == 0) return "scene";
        if (has_key(s, key)) return dot ? s->key : "scene with bodies";
    }
    return NULL;
}

static void unknown_key(case_reader *r, const case_section *section, const tree_node *key, const char *path)
{
    if (is_root(section) && strcmp(key->text, "base") == 0) {
        case_errors_add(r->errors, key, "base is a line of the case's file: --set cannot change what it builds on");
        return;
    }
    const bool listed = r->errors->n < CASE_MAX_ERRORS; /* beyond the list there is no need to look for names */
    const char *near = listed ? host_nearest_name(key->text, known_key, section) : NULL;
    const char *home = near || !listed ? NULL : home_of(key->text, section);
    const char *in = path[0] ? " in " : "";
    if (near) {
        case_errors_add(r->errors, key, "unknown key `%.*s`%s%s; did you mean `%s`?", CASE_SHOWN, key->text, in, path,
                        near);
        return;
    }
    if (home) {
        case_errors_add(r->errors, key, "unknown key `%.*s`%s%s; `%s` has one", CASE_SHOWN, key->text, in, path, home);
        return;
    }
    char known[400] = "";
    for (int i = 0; known_key(section, i); i++) {
        const size_t used = strlen(known);
        snprintf(known + used, sizeof known - used, "%s%s", i > 0 ? ", " : "", known_key(section, i));
    }
    case_errors_add(r->errors, key, "unknown key `%.*s`%s%s; known are %s", CASE_SHOWN, key->text, in, path, known);
}

static void join(char out[CASE_KEY_SIZE], const char *path, const char *key)
{
    snprintf(out, CASE_KEY_SIZE, "%s%s%s", path, path[0] ? "." : "", key);
}

static void missing_key(case_reader *r, const base_param *p, const tree_node *where, const char *path)
{
    char key[CASE_KEY_SIZE], unit[UNIT_SIZE + 3];
    join(key, path, p->key);
    case_errors_add(r->errors, where, "%s is missing%s: %s", key, case_unit_text(p, unit), p->doc);
}

static const base_param *param_of(const case_section *section, const char *key)
{
    for (const base_param *p = section->table; p->key; p++)
        if (strcmp(p->key, key) == 0) return p;
    return NULL;
}

static const case_section *child_of(const case_section *section, const char *key)
{
    for (const case_section *s = section->children; s && s->key; s++)
        if (strcmp(s->key, key) == 0) return s;
    return NULL;
}

/* The part of a section that has this key, of a value or of a section inside; NULL: none has. */
static const case_section *part_of(const case_section *section, const char *key)
{
    while (section && !param_of(section, key) && !child_of(section, key)) section = section->also;
    return section;
}

/* Was the key given, but mistyped?  Then that is the error, not its absence. */
static bool is_mistyped(const case_reader *r, const case_section *section, const tree_node *map, const char *key)
{
    if (r->errors->n >= CASE_MAX_ERRORS) return true;
    for (int k = 0; map->kind == TREE_MAP && k < map->n; k++) {
        const char *given = map->key[k]->text;
        if (part_of(section, given)) continue;
        const char *near = host_nearest_name(given, known_key, section);
        if (near && strcmp(near, key) == 0) return true;
    }
    return false;
}

/* ---- sections ---- */

/* An entry of a list of words: [a, b] stands for [{value: a}, {value: b}]. */
static bool is_bare_value(const case_section *section, const tree_node *node)
{
    return section->list && node->kind == TREE_TEXT && section->table->key && strcmp(section->table->key, "value") == 0;
}

/* Does a list of values stand for this key of an entry? */
static bool is_spread(const case_section *section, const tree_node *value, const base_param *p)
{
    return section->spread && value->kind == TREE_LIST && p && p->kind != BASE_PARAM_VECTOR &&
           p->kind != BASE_PARAM_POINTS;
}

const tree_node *case_entry_node(const tree_node *list, int k)
{
    if (!list) return NULL;
    if (list->kind != TREE_LIST) return k == 0 ? list : NULL;
    return k < list->n ? list->item[k] : NULL;
}

int case_entry_values(const case_section *section, const tree_node *entry)
{
    for (int k = 0; entry->kind == TREE_MAP && k < entry->n; k++)
        if (is_spread(section, entry->item[k], param_of(section, entry->key[k]->text))) return entry->item[k]->n;
    return 1;
}

/* All lists of an entry must have as many values as the first. */
static void check_spread(case_reader *r, const case_section *section, const tree_node *entry, const char *path)
{
    const int n = case_entry_values(section, entry);
    for (int k = 0; entry->kind == TREE_MAP && k < entry->n; k++) {
        const tree_node *value = entry->item[k];
        const char *key = entry->key[k]->text;
        if (!is_spread(section, value, param_of(section, key)) || (value->n == n && n > 0)) continue;
        case_errors_add(r->errors, value, "%s.%s: %d values where %d are wanted: an entry's lists are of one length",
                        path, key, value->n, n > 0 ? n : 1);
    }
}

/* The value of one key: that of place `pick` where a list of values is given. */
static void read_key(case_reader *r, const case_section *section, const base_param *p, const tree_node *node,
                     void *member, const char *path, int pick)
{
    char entry[CASE_KEY_SIZE + 16];
    if (!is_spread(section, node, p)) {
        case_value_read(r, p, node, member, path);
        return;
    }
    if (pick >= node->n) return; /* an error of its own */
    snprintf(entry, sizeof entry, "%s[%d]", path, pick);
    case_value_read(r, p, node->item[pick], member, entry);
}

/* Does the map (NULL: no) hold a key of this part? */
static bool has_part(const case_section *part, const tree_node *map)
{
    for (int k = 0; map && map->kind == TREE_MAP && k < map->n; k++)
        if (param_of(part, map->key[k]->text) || child_of(part, map->key[k]->text)) return true;
    return false;
}

/* Defaults of one part, the sections inside it, and whether it is given. */
static void read_part(case_reader *r, const case_section *section, const case_section *part, const tree_node *map,
                      void *object, const char *path)
{
    char inner[CASE_KEY_SIZE];
    void *own = case_part_object(section, part, object);
    base_params_default(part->table, own);
    for (const case_section *s = part->children; s && s->key; s++) {
        join(inner, path, s->key);
        case_section_read(r, s, map ? host_tree_find(map, s->key) : NULL, own, inner);
    }
    if (part->given != NO_FLAG)
        *(bool *)((char *)r->out + part->given) = section->also ? has_part(part, map) : map != NULL;
}

/* Does the map hold one of the numbers that this part must have, or any key of a part that must have none?  An
 * armature's metal alone, which the circuit takes too, asks for no body in a scene. */
static bool asks_for(const case_section *part, const tree_node *map)
{
    bool numbers = false;
    for (const base_param *p = part->table; p->key; p++) {
        if (p->kind == BASE_PARAM_TEXT || !case_value_is_required(p)) continue;
        if (map && host_tree_find(map, p->key)) return true;
        numbers = true;
    }
    return !numbers && has_part(part, map);
}

static void check_required(case_reader *r, const case_section *section, const tree_node *map, const char *path)
{
    for (const case_section *part = section; part; part = part->also) {
        if (section->also && !asks_for(part, map) && !(part->needed_for & r->options->needs)) continue;
        for (const base_param *p = part->table; p->key; p++)
            if (case_value_is_required(p) && !host_tree_find(map, p->key) && !is_mistyped(r, section, map, p->key))
                missing_key(r, p, map, path);
    }
}

/* One mapping (NULL: nothing given) into one struct, or those of its parts; pick: which value of several. */
static void read_map(case_reader *r, const case_section *section, const tree_node *map, void *object, const char *path,
                     int pick)
{
    for (const case_section *part = section; part; part = part->also) read_part(r, section, part, map, object, path);
    if (!map) return;
    if (is_bare_value(section, map)) {
        case_value_read(r, section->table, map, (char *)object + section->table->offset, path);
        return;
    }
    if (map->kind != TREE_MAP && !host_tree_is_empty(map)) {
        case_errors_add(r->errors, map, "%s must be a section: key and value, one a line", path[0] ? path : "the case");
        return;
    }
    for (int k = 0; map->kind == TREE_MAP && k < map->n; k++) {
        char inner[CASE_KEY_SIZE];
        const case_section *part = part_of(section, map->key[k]->text);
        const base_param *p = part ? param_of(part, map->key[k]->text) : NULL;
        if (!part) unknown_key(r, section, map->key[k], path);
        if (!p) continue;
        join(inner, path, p->key);
        read_key(r, section, p, map->item[k], (char *)case_part_object(section, part, object) + p->offset, inner, pick);
    }
    check_required(r, section, map, path);
}

/* The entries, in the order of the file; one with lists of values stands for several. */
static void read_list(case_reader *r, const case_section *section, const tree_node *node, void *parent,
                      const char *path)
{
    const bool lone = node && node->kind != TREE_LIST;
    case_list list = { 0, NULL };
    case_list_put(parent, section, list);
    if (!node || (lone && host_tree_is_empty(node))) return;
    const int nodes = lone ? 1 : node->n;
    long n = 0;
    for (int k = 0; k < nodes; k++) n += case_entry_values(section, lone ? node : node->item[k]);
    if (n > CASE_MAX_ENTRIES) {
        case_errors_add(r->errors, node, "%s has %ld entries: at most %d", path, n, CASE_MAX_ENTRIES);
        return;
    }
    list.item = calloc((size_t)n + 1, section->size);
    if (!list.item) {
        r->out_of_memory = true;
        return;
    }
    list.n = (int)n;
    case_list_put(parent, section, list);
    char *object = list.item;
    for (int k = 0; k < nodes; k++) {
        char entry[CASE_KEY_SIZE];
        const tree_node *from = lone ? node : node->item[k];
        if (lone)
            snprintf(entry, sizeof entry, "%s", path);
        else
            snprintf(entry, sizeof entry, "%s[%d]", path, k);
        check_spread(r, section, from, entry);
        for (int pick = 0; pick < case_entry_values(section, from); pick++, object += section->size)
            read_map(r, section, from, object, entry, pick);
    }
}

void case_section_read(case_reader *r, const case_section *section, const tree_node *node, void *parent,
                       const char *path)
{
    if (section->unless && host_tree_find(node, section->unless)) node = NULL;
    if (section->list) {
        if (section->given != NO_FLAG) *(bool *)((char *)r->out + section->given) = node != NULL;
        read_list(r, section, node, parent, path);
    } else {
        read_map(r, section, node, (char *)parent + section->offset, path, 0);
    }
}

const case_section *case_section_find(const char *key)
{
    return child_of(&case_root, key);
}

static void free_children(const case_section *section, void *object)
{
    for (const case_section *part = section; part; part = part->also)
        for (const case_section *s = part->children; s && s->key; s++)
            case_section_free(s, case_part_object(section, part, object));
}

void case_section_free(const case_section *section, void *parent)
{
    if (!section->list) {
        free_children(section, (char *)parent + section->offset);
        return;
    }
    const case_list list = case_list_get(parent, section);
    for (int k = 0; k < list.n; k++) free_children(section, (char *)list.item + (size_t)k * section->size);
    free(list.item);
    case_list_put(parent, section, (case_list){ 0, NULL });
}

void case_warn(case_reader *r, const char *line)
{
    const size_t old = strlen(r->out->warnings), more = strlen(line);
    if (more == 0) return;
    char *all = realloc(r->out->warnings, old + more + 2);
    if (!all) {
        r->out_of_memory = true;
        return;
    }
    snprintf(all + old, more + 2, "%s\n", line);
    r->out->warnings = all;
}

void case_warn_at(case_reader *r, const tree_node *node, const char *text)
{
    char place[CASE_PATH_SIZE + 40], line[CASE_PATH_SIZE + 440];
    if (node->set >= 0)
        snprintf(place, sizeof place, CASE_SET_PLACE, r->errors->sets[node->set]);
    else
        snprintf(place, sizeof place, "%s:%d:%d: ", r->file[node->file], node->line, node->column);
    snprintf(line, sizeof line, "%s%s", place, text);
    case_warn(r, line);
}
