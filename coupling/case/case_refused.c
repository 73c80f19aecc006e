/* SPDX-License-Identifier: BSD-3-Clause */
/* What the solver refuses of a scene of bodies, said of the case's own keys, each at its place in the file. */
#include "coupling/case/case_bodies.h"
#include "coupling/case/case_plain.h"

#include <math.h>
#include <string.h>

static const char *const lists[MPM_PARTS] = {
    [MPM_PART_SCENE] = "",        [MPM_PART_BODY] = "bodies",  [MPM_PART_PAIR] = "contacts",
    [MPM_PART_REFINE] = "refine", [MPM_PART_PROBE] = "probes", [MPM_PART_CAVITY] = "cavities"
};

static void path_of(const mpm_refused *at, char path[CASE_KEY_SIZE])
{
    const char *key = at->key ? at->key : "", *dot = at->key ? "." : "";
    if (at->part == MPM_PART_SCENE)
        snprintf(path, CASE_KEY_SIZE, "scene%s%s", dot, key);
    else
        snprintf(path, CASE_KEY_SIZE, "scene.%s[%d]%s%s", lists[at->part], at->entry, dot, key);
}

void case_refused_text(const mpm_refused *at, const char *why, char *out, size_t size)
{
    char path[CASE_KEY_SIZE];
    path_of(at, path);
    snprintf(out, size, "%s: %s", path, why);
}

/* The entry of `contacts` that is pair number k: the default is none. */
static int entry_of_pair(const tree_node *contacts, int k)
{
    int entry = 0;
    while (case_entry_node(contacts, entry) &&
           (!host_tree_find(case_entry_node(contacts, entry), "between") || k-- > 0))
        entry++;
    return entry;
}

/* A value as it is written: a text, or a list of them; "": a section, or nothing. */
static void echo_of(const tree_node *node, char *out, size_t size)
{
    size_t used = 0;
    out[0] = '\0';
    if (node && node->kind == TREE_TEXT) snprintf(out, size, " = " CASE_ECHO, CASE_ECHO_OF(node->text));
    for (int i = 0; node && node->kind == TREE_LIST && i < node->n && used < size; i++) {
        if (node->item[i]->kind != TREE_TEXT) return;
        used += (size_t)snprintf(out + used, size - used, "%s%.40s%s", i ? ", " : " = [", node->item[i]->text,
                                 i + 1 < node->n ? "" : "]");
    }
}

/* What the solver says, without a key and its value at the start: they stand before it. */
static const char *without_key(const char *why, const char *key)
{
    const size_t n = key ? strlen(key) : 0;
    const char *rest = strstr(why, ": ");
    return n > 0 && rest && strncmp(why, key, n) == 0 && strncmp(why + n, " = ", 3) == 0 ? rest + 2 : why;
}

/* At the key, else at its entry, else at the section. */
static void refuse(case_reader *r, mpm_refused at, const char *why)
{
    const tree_node *scene = host_tree_find(r->root, "scene"), *list = host_tree_find(scene, lists[at.part]);
    char path[CASE_KEY_SIZE], echo[CASE_KEY_SIZE];
    if (at.part == MPM_PART_PAIR) at.entry = entry_of_pair(list, at.entry);
    const tree_node *entry = at.part == MPM_PART_SCENE ? scene : case_entry_node(list, at.entry);
    const tree_node *node = at.key ? host_tree_find(entry, at.key) : NULL;
    path_of(&at, path);
    echo_of(node, echo, sizeof echo);
    case_errors_add(r->errors,
                    node    ? node
                    : entry ? entry
                            : scene,
                    "%s%s: %.400s", path, echo, node ? without_key(why, at.key) : why);
}

/* `breech strike` says how fast its piston is. */
static bool is_driven(const case_reader *r, const mpm_body *b)
{
    return r->out->given.strike && strcmp(b->name, r->out->strike.projectile) == 0 && !isnan(b->piston_mass) &&
           isnan(b->piston_velocity);
}

void case_refused_check(case_reader *r)
{
    static const double ANY = 1.0; /* [m/s] */
    mpm_scene *s = &r->out->bodies.scene;
    mpm_body *driven = NULL;
    for (int i = 0; i < s->bodies; i++)
        if (is_driven(r, &s->body[i])) driven = &s->body[i];
    if (driven) driven->piston_velocity = ANY;
    for (mpm_part part = MPM_PART_SCENE; part < MPM_PARTS; part++)
        for (int i = 0; i < mpm_part_entries(s, part); i++) {
            mpm_refused at = { part, i, NULL };
            const status fits = mpm_check_entry(s, part, i, &at.key);
            if (fits.code != STATUS_OK) refuse(r, at, fits.text);
        }
    if (driven) driven->piston_velocity = NAN;
}
