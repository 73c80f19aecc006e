/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/host/yaml_tree.h"
#include "coupling/host/words.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>
#include <yaml.h>

/* One reading: the parser, the event at hand, where an error was found. */
typedef struct {
    yaml_parser_t parser;
    yaml_event_t event;
    bool has_event;
    int nodes, set;
    int line, column;
    const char *bytes; /* borrowed */
    size_t length;
} reading;

void host_tree_free(tree_node *node)
{
    if (!node) return;
    for (int k = 0; k < node->n; k++) {
        if (node->key) host_tree_free(node->key[k]);
        host_tree_free(node->item[k]);
    }
    free(node->key);
    free(node->item);
    free(node->text);
    free(node);
}

/* Place of `key` in a map; -1 if it is not there. */
static int place_of(const tree_node *map, const char *key)
{
    for (int k = 0; k < map->n; k++)
        if (strcmp(map->key[k]->text, key) == 0) return k;
    return -1;
}

const tree_node *host_tree_find(const tree_node *map, const char *key)
{
    const int k = map && map->kind == TREE_MAP ? place_of(map, key) : -1;
    return k < 0 ? NULL : map->item[k];
}

bool host_tree_is_empty(const tree_node *node)
{
    return node->kind == TREE_TEXT && !node->quoted && (node->text[0] == '\0' || strcmp(node->text, "~") == 0);
}

static tree_node *node_new(tree_kind kind, int line, int column, int set)
{
    tree_node *node = calloc(1, sizeof *node);
    if (node) *node = (tree_node){ .kind = kind, .line = line, .column = column, .set = set };
    return node;
}

static status node_text(const char *text, size_t length, int line, int column, int set, tree_node **out)
{
    *out = NULL;
    CHECK(length <= TREE_MAX_TEXT, STATUS_BAD_INPUT, "a value of %zu bytes: at most %d", length, TREE_MAX_TEXT);
    for (size_t k = 0; k < length; k++)
        CHECK((unsigned char)text[k] >= 32 && text[k] != 127, STATUS_BAD_INPUT,
              "a control character or line break inside a value");
    tree_node *node = node_new(TREE_TEXT, line, column, set);
    CHECK(node, STATUS_MEMORY, "out of memory while reading a case");
    node->text = malloc(length + 1);
    if (!node->text) {
        host_tree_free(node);
        return base_status_error(STATUS_MEMORY, "out of memory while reading a case");
    }
    memcpy(node->text, text, length);
    node->text[length] = '\0';
    *out = node;
    return status_ok();
}

/* Takes `key` (NULL in a list) and `item` over, also on error. */
static status node_append(tree_node *parent, tree_node *key, tree_node *item)
{
    const size_t n = (size_t)parent->n;
    status result = status_ok();
    if ((n & (n - 1)) == 0) { /* grow at powers of two */
        const size_t wanted = n == 0 ? 1 : 2 * n;
        tree_node **items = realloc(parent->item, wanted * sizeof *items);
        if (items) parent->item = items;
        tree_node **keys = key ? realloc(parent->key, wanted * sizeof *keys) : NULL;
        if (keys) parent->key = keys;
        if (!items || (key && !keys)) result = base_status_error(STATUS_MEMORY, "out of memory while reading a case");
    }
    if (result.code != STATUS_OK) {
        host_tree_free(key);
        host_tree_free(item);
        return result;
    }
    if (key) parent->key[n] = key;
    parent->item[n] = item;
    parent->n++;
    return result;
}

/* ---- from libyaml's events ---- */

static void mark(reading *r, yaml_mark_t at)
{
    r->line = (int)at.line + 1;
    r->column = (int)at.column + 1;
}

/* The reader of bytes tells no place but an offset. */
static void mark_offset(reading *r, size_t offset)
{
    r->line = r->column = 1;
    for (size_t k = 0; k < offset && k < r->length; k++) {
        r->column = r->bytes[k] == '\n' ? 1 : r->column + 1;
        r->line += r->bytes[k] == '\n';
    }
}

/* What a beginner has done where libyaml says this; "" where it is clear or not known. */
static const char *hint_of(const reading *r, const yaml_parser_t *p)
{
    static const char bracket[] = ": a bracket is not closed, or a text with brackets or commas in it lacks its quotes";
    static const struct {
        const char *problem, *hint;
    } of[] = {
        { "did not find expected key", ": this line does not begin below the others of its section" },
        { "did not find expected '-' indicator", ": entries of a list begin with `- `, one below the other" },
        { "mapping values are not allowed", ": it begins further right than the others of its section, the line above "
                                            "lacks its `:`, or a text with `: ` in it its quotes" },
        { "could not find expected ':'", ": a line above is no `key: value`" },
        { "did not find expected ',' or", bracket },
    };
    const size_t at = p->problem_mark.index;
    if (at < r->length && r->bytes[at] == '\t') return ": a tab; lines are indented with blanks alone";
    for (size_t k = 0; k < sizeof of / sizeof *of; k++)
        if (p->problem && strncmp(p->problem, of[k].problem, strlen(of[k].problem)) == 0) return of[k].hint;
    return "";
}

static status next_event(reading *r)
{
    if (r->has_event) yaml_event_delete(&r->event);
    r->has_event = false;
    if (!yaml_parser_parse(&r->parser, &r->event)) {
        const yaml_parser_t *p = &r->parser;
        CHECK(p->error != YAML_MEMORY_ERROR, STATUS_MEMORY, "out of memory while reading a case");
        mark(r, p->problem_mark);
        if (p->error == YAML_READER_ERROR) mark_offset(r, p->problem_offset);
        return base_status_error(STATUS_BAD_INPUT, "not valid YAML: %s%s%s%s",
                                 p->problem ? p->problem : "cannot be read", p->context ? " " : "",
                                 p->context ? p->context : "", hint_of(r, p));
    }
    r->has_event = true;
    mark(r, r->event.start_mark);
    return status_ok();
}

static status no_decoration(const void *anchor, const void *tag)
{
    CHECK(!anchor, STATUS_BAD_INPUT, "anchors (&name) are not used in case files: write the value again");
    CHECK(!tag, STATUS_BAD_INPUT, "tags (!name) are not used in case files");
    return status_ok();
}

static status read_node(reading *r, int depth, tree_node **out);

static status read_scalar(reading *r, tree_node **out)
{
    const yaml_event_t *e = &r->event;
    TRY(no_decoration(e->data.scalar.anchor, e->data.scalar.tag));
    TRY(node_text((const char *)e->data.scalar.value, e->data.scalar.length, r->line, r->column, r->set, out));
    (*out)->quoted = e->data.scalar.style != YAML_PLAIN_SCALAR_STYLE;
    return status_ok();
}

static status read_key(reading *r, const tree_node *map, tree_node **out)
{
    *out = NULL;
    CHECK(r->event.type == YAML_SCALAR_EVENT, STATUS_BAD_INPUT, "a key must be a plain word");
    CHECK(map->n < TREE_MAX_KEYS, STATUS_BAD_INPUT, "more than %d keys in one section", TREE_MAX_KEYS);
    tree_node *key = NULL;
    TRY(read_scalar(r, &key));
    *out = key;
    for (int k = 0; k < map->n; k++)
        CHECK(strcmp(map->key[k]->text, key->text) != 0, STATUS_BAD_INPUT,
              "key `%.60s` stands twice in one section; first in line %d", key->text, map->key[k]->line);
    return status_ok();
}

static status read_entries(reading *r, tree_node *node, yaml_event_type_t end, int depth)
{
    for (;;) {
        tree_node *key = NULL, *item = NULL;
        TRY(next_event(r));
        if (r->event.type == end) return status_ok();
        status s = status_ok();
        if (node->kind == TREE_MAP) {
            s = read_key(r, node, &key);
            if (s.code == STATUS_OK) s = next_event(r);
        }
        if (s.code == STATUS_OK) s = read_node(r, depth + 1, &item);
        if (s.code != STATUS_OK) {
            host_tree_free(key);
            return s;
        }
        TRY(node_append(node, key, item));
    }
}

/* The node that begins with the event at hand. */
static status read_node(reading *r, int depth, tree_node **out)
{
    const yaml_event_t *e = &r->event;
    *out = NULL;
    CHECK(depth <= TREE_MAX_DEPTH, STATUS_BAD_INPUT, "sections nested more than %d deep", TREE_MAX_DEPTH);
    CHECK(++r->nodes <= TREE_MAX_NODES, STATUS_BAD_INPUT, "more than %d values", TREE_MAX_NODES);
    CHECK(e->type != YAML_ALIAS_EVENT, STATUS_BAD_INPUT,
          "aliases (*name) are not used in case files: write the value again");
    if (e->type == YAML_SCALAR_EVENT) return read_scalar(r, out);

    const bool is_map = e->type == YAML_MAPPING_START_EVENT;
    CHECK(is_map || e->type == YAML_SEQUENCE_START_EVENT, STATUS_BAD_INPUT, "a value is missing");
    if (is_map)
        TRY(no_decoration(e->data.mapping_start.anchor, e->data.mapping_start.tag));
    else
        TRY(no_decoration(e->data.sequence_start.anchor, e->data.sequence_start.tag));
    tree_node *node = node_new(is_map ? TREE_MAP : TREE_LIST, r->line, r->column, r->set);
    CHECK(node, STATUS_MEMORY, "out of memory while reading a case");
    const status s = read_entries(r, node, is_map ? YAML_MAPPING_END_EVENT : YAML_SEQUENCE_END_EVENT, depth);
    if (s.code != STATUS_OK)
        host_tree_free(node);
    else
        *out = node;
    return s;
}

static status read_document(reading *r, tree_node **out)
{
    TRY(next_event(r)); /* stream start */
    TRY(next_event(r));
    CHECK(r->event.type == YAML_DOCUMENT_START_EVENT, STATUS_BAD_INPUT, "the file is empty");
    TRY(next_event(r));
    TRY(read_node(r, 0, out));
    TRY(next_event(r)); /* document end */
    TRY(next_event(r));
    CHECK(r->event.type == YAML_STREAM_END_EVENT, STATUS_BAD_INPUT, "a second document (---): one file, one case");
    return status_ok();
}

static status parse(const char *bytes, size_t length, int set, tree_node **out, int *line, int *column)
{
    *out = NULL;
    *line = *column = 1;
    CHECK(length <= TREE_MAX_BYTES, STATUS_BAD_INPUT, "the file is longer than %d bytes", TREE_MAX_BYTES);
    reading r = { .set = set, .line = 1, .column = 1, .bytes = bytes, .length = length };
    CHECK(yaml_parser_initialize(&r.parser), STATUS_MEMORY, "out of memory while reading a case");
    yaml_parser_set_encoding(&r.parser, YAML_UTF8_ENCODING);
    yaml_parser_set_input_string(&r.parser, (const unsigned char *)bytes, length);
    const status s = read_document(&r, out);
    if (r.has_event) yaml_event_delete(&r.event);
    yaml_parser_delete(&r.parser);
    *line = r.line;
    *column = r.column;
    if (s.code != STATUS_OK) {
        host_tree_free(*out);
        *out = NULL;
    }
    return s;
}

status host_tree_parse(const char *bytes, size_t length, tree_node **out, int *line, int *column)
{
    return parse(bytes, length, -1, out, line, column);
}

void host_tree_number(tree_node *root, int file)
{
    root->file = file;
    for (int k = 0; k < root->n; k++) {
        if (root->key) root->key[k]->file = file;
        host_tree_number(root->item[k], file);
    }
}

/* ---- one tree over another ---- */

tree_node *host_tree_take(tree_node *map, const char *key)
{
    const int k = map->kind == TREE_MAP ? place_of(map, key) : -1;
    if (k < 0) return NULL;
    tree_node *item = map->item[k];
    const size_t after = (size_t)(map->n - k - 1);
    host_tree_free(map->key[k]);
    memmove(&map->key[k], &map->key[k + 1], after * sizeof(tree_node *));
    memmove(&map->item[k], &map->item[k + 1], after * sizeof(tree_node *));
    map->n--;
    return item;
}

/* One key of the changes and its value, both taken over. */
static status merge_key(tree_node *below, tree_node *key, tree_node *item)
{
    const int k = place_of(below, key->text);
    if (k < 0) return node_append(below, key, item);
    if (host_tree_is_empty(item)) {
        host_tree_free(host_tree_take(below, key->text));
        host_tree_free(item);
        host_tree_free(key);
        return status_ok();
    }
    host_tree_free(below->key[k]);
    below->key[k] = key;
    return host_tree_merge(&below->item[k], item);
}

status host_tree_merge(tree_node **below, tree_node *changes)
{
    status s = status_ok();
    if ((*below)->kind != TREE_MAP || changes->kind != TREE_MAP) {
        host_tree_free(*below);
        *below = changes;
        return s;
    }
    for (int k = 0; k < changes->n && s.code == STATUS_OK; k++) {
        tree_node *key = changes->key[k], *item = changes->item[k];
        changes->key[k] = changes->item[k] = NULL;
        s = merge_key(*below, key, item);
    }
    (*below)->file = changes->file;
    (*below)->line = changes->line;
    (*below)->column = changes->column;
    host_tree_free(changes);
    return s;
}

/* ---- --set ---- */

enum { SET_MAX_STEPS = TREE_MAX_DEPTH, SET_NAME_SIZE = 64 };

typedef struct {
    char name[SET_NAME_SIZE];
    int index; /* -1: none */
} set_step;

typedef struct {
    set_step step[SET_MAX_STEPS];
    int n, set;
    const char *value;
} set_path;

static status read_step(const char **cursor, set_step *step)
{
    const char *s = *cursor;
    size_t length = 0;
    while (isalnum((unsigned char)s[length]) || s[length] == '_') length++;
    CHECK(length > 0 && length < SET_NAME_SIZE, STATUS_BAD_INPUT, "wanted path.to.key=value, such as bank.charge=9 kV");
    memcpy(step->name, s, length);
    step->name[length] = '\0';
    step->index = -1;
    s += length;
    if (*s == '[') {
        char *end = NULL;
        CHECK(isdigit((unsigned char)s[1]), STATUS_BAD_INPUT, "wanted a number from 0 in %s[...]", step->name);
        const long index = strtol(s + 1, &end, 10);
        CHECK(*end == ']' && index <= TREE_MAX_NODES, STATUS_BAD_INPUT, "wanted a number from 0 in %s[...]",
              step->name);
        step->index = (int)index;
        s = end + 1;
    }
    *cursor = s;
    return status_ok();
}

static status read_path(const char *assignment, set_path *path)
{
    const char *s = assignment;
    for (;;) {
        CHECK(path->n < SET_MAX_STEPS, STATUS_BAD_INPUT, "a path of more than %d keys", SET_MAX_STEPS);
        TRY(read_step(&s, &path->step[path->n++]));
        if (*s != '.') break;
        s++;
    }
    CHECK(*s == '=', STATUS_BAD_INPUT, "wanted path.to.key=value, such as bank.charge=9 kV");
    path->value = s + 1 + strspn(s + 1, " \t");
    return status_ok();
}

static status make_value(const set_path *path, tree_node **out)
{
    size_t length = strlen(path->value);
    int line, column;
    if (strchr("[{\"'", path->value[0]) && length > 0) {
        const status s = parse(path->value, length, path->set, out, &line, &column);
        CHECK(s.code == STATUS_OK, s.code, "%.300s", s.text);
        return status_ok();
    }
    while (length > 0 && strchr(" \t\r\n", path->value[length - 1])) length--;
    return node_text(path->value, length, 0, 0, path->set, out);
}

static status put(tree_node **slot, const set_path *path)
{
    tree_node *value = NULL;
    TRY(make_value(path, &value));
    host_tree_free(*slot);
    *slot = value;
    return status_ok();
}

static tree_node **slot_of(tree_node *map, const char *key)
{
    const int k = place_of(map, key);
    return k < 0 ? NULL : &map->item[k];
}

static status set_in(tree_node **slot, const set_path *path, int i);

/* Entry path->step[i].index of the list in *slot, or all of them, or *slot itself when it is no list. */
static status set_in_list(tree_node **slot, const set_path *path, int i)
{
    const set_step *step = &path->step[i];
    tree_node *node = *slot;
    const bool last = i + 1 == path->n;
    if (node->kind != TREE_LIST) {
        CHECK(step->index <= 0, STATUS_BAD_INPUT, "%s has one entry: %s[0]", step->name, step->name);
        return last ? put(slot, path) : set_in(slot, path, i + 1);
    }
    if (step->index < 0 && last) return put(slot, path);
    CHECK(node->n > 0, STATUS_BAD_INPUT, "%s has no entries", step->name);
    CHECK(step->index < node->n, STATUS_BAD_INPUT, "%s has %d entries: %s[0] .. %s[%d]", step->name, node->n,
          step->name, step->name, node->n - 1);
    for (int k = 0; k < node->n; k++) {
        if (step->index >= 0 && k != step->index) continue;
        TRY(last ? put(&node->item[k], path) : set_in(&node->item[k], path, i + 1));
    }
    return status_ok();
}

static const char *key_of(const void *map, int k)
{
    const tree_node *m = map;
    return k < m->n ? m->key[k]->text : NULL;
}

static status no_entries(const tree_node *map, const char *name)
{
    const char *near = host_nearest_name(name, key_of, map);
    return base_status_error(STATUS_BAD_INPUT, "%s has no entries%s%s%s", name, near ? "; did you mean `" : "",
                             near ? near : "", near ? "`?" : "");
}

/* path->step[i] inside the section *slot. */
static status set_in(tree_node **slot, const set_path *path, int i)
{
    const set_step *step = &path->step[i];
    if (*slot && host_tree_is_empty(*slot)) (*slot)->kind = TREE_MAP; /* `rails:` with nothing in it */
    tree_node *map = *slot;
    CHECK(map->kind == TREE_MAP, STATUS_BAD_INPUT, "%s is not inside a section: `%s` stands in a %s", step->name,
          i > 0 ? path->step[i - 1].name : "the file", map->kind == TREE_LIST ? "list" : "value");
    tree_node **inner = slot_of(map, step->name);
    if (!inner) {
        if (step->index >= 0) return no_entries(map, step->name);
        CHECK(map->n < 2 * TREE_MAX_KEYS, STATUS_BAD_INPUT, "a section has at most %d keys", 2 * TREE_MAX_KEYS);
        tree_node *key = NULL, *fresh = node_new(TREE_MAP, 0, 0, path->set);
        CHECK(fresh, STATUS_MEMORY, "out of memory while reading --set");
        const status s = node_text(step->name, strlen(step->name), 0, 0, path->set, &key);
        if (s.code != STATUS_OK) {
            host_tree_free(fresh);
            return s;
        }
        TRY(node_append(map, key, fresh));
        inner = &map->item[map->n - 1];
    }
    return set_in_list(inner, path, i);
}

status host_tree_set(tree_node **root, const char *assignment, int set)
{
    set_path path = { .set = set };
    TRY(read_path(assignment, &path));
    return set_in(root, &path, 0);
}
