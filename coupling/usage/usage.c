/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/usage/usage.h"

#include "coupling/host/words.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- the lists ---- */

#define BIT(number) ((uint64_t)1 << (number))
#define FOR(command) BIT(STUDIES + USAGE_##command)
#define STUDY(study) BIT(STUDY_##study)
#define RUNS (BIT(STUDIES) - 1)
#define OPTION(member, name_, value_, kind_, from, to, commands, names, text) \
    { .name = (name_),                                                        \
      .value = (value_),                                                      \
      .kind = (kind_),                                                        \
      .low = (from),                                                          \
      .high = (to),                                                           \
      .taken_by = (commands),                                                 \
      .completes = (names),                                                   \
      .offset = offsetof(usage_line, member),                                 \
      .doc = (text) },
const usage_option usage_options[] = {
#include "coupling/usage/options.def"
    { .name = NULL },
};
#undef OPTION
#undef STUDY

#define WORD(name_, value_, names, text) { .name = (name_), .value = (value_), .completes = (names), .doc = (text) },
const usage_option usage_words[] = {
#include "coupling/usage/words.def"
    { .name = NULL },
};
#undef WORD

#define COMMAND(name_, subject_, required, text, more_, example_) \
    { .name = #name_,                                             \
      .subject = (subject_),                                      \
      .doc = (text),                                              \
      .more = (more_),                                            \
      .example = (example_),                                      \
      .subject_required = (required),                             \
      .number = STUDIES + USAGE_##name_ },
static const usage_command others[] = {
#include "coupling/usage/commands.def"
};
#undef COMMAND

const usage_exit usage_exits[] = {
    { 0, "done" },
    { 1, "failed while running" },
    { 2, "bad input or usage" },
    { 75, "stopped early with a checkpoint" },
    { 0, NULL },
};

usage_command usage_command_at(int i)
{
    if (i >= STUDIES) return others[i - STUDIES];
    const study *y = study_list[i];
    return (usage_command){ y->name, "CASE", y->doc, y->more, y->example, true, y, i };
}

static const char *command_name(const void *user, int i)
{
    (void)user;
    return i < USAGE_COMMANDS_MADE ? usage_command_at(i).name : NULL;
}

static const char *option_name(const void *list, int i)
{
    return ((const usage_option *)list)[i].name;
}

status usage_no_command(const char *name)
{
    const char *near = host_nearest_name(name, command_name, NULL);
    return base_status_error(STATUS_BAD_INPUT, "no command `%.80s`; %s%s%sbreech --help lists them", name,
                             near ? "did you mean `" : "", near ? near : "", near ? "`? " : "");
}

/* Of an option that is not in the list; near ones may be words in place of a command. */
static status no_option(const char *name)
{
    const char *near = host_nearest_name(name, option_name, usage_options);
    if (!near) near = host_nearest_name(name, option_name, usage_words);
    return base_status_error(STATUS_BAD_INPUT, "no option %.80s; %s%s%sbreech --help lists them", name,
                             near ? "did you mean " : "", near ? near : "", near ? "? " : "");
}

usage_command usage_command_find(const char *name)
{
    for (int i = 0; i < USAGE_COMMANDS_MADE; i++)
        if (strcmp(usage_command_at(i).name, name) == 0) return usage_command_at(i);
    return (usage_command){ .name = NULL };
}

bool usage_takes(const usage_command *c, const usage_option *o)
{
    return (o->taken_by & BIT(c->number)) != 0;
}

/* ---- values ---- */

/* "90", "45s", "30m", "2h", "1:30", "1:30:00" in seconds; NAN if it is none of these. */
static double wall_time(const char *text)
{
    double total = 0.0;
    bool behind_colon = false;
    for (;;) {
        char *end;
        const double part = strtod(text, &end);
        if (end == text || !(part >= 0.0) || !isfinite(part)) return NAN;
        if (behind_colon && part >= 60.0) return NAN;
        total = 60.0 * total + part;
        if (*end == '\0') return total;
        if (*end != ':') {
            const char *unit = strchr("s m h ", *end);
            if (!unit || end[1] != '\0' || *end == ' ') return NAN;
            return total * (*end == 's' ? 1.0 : *end == 'm' ? 60.0 : 3600.0);
        }
        text = end + 1;
        behind_colon = true;
    }
}

static status read_count(const usage_option *o, const char *text, int *out)
{
    char *end;
    errno = 0;
    const long n = strtol(text, &end, 10);
    CHECK(end != text && *end == '\0' && !errno && n >= o->low && n <= o->high, STATUS_BAD_INPUT,
          "%s %.40s: must be %d .. %d", o->name, text, o->low, o->high);
    *out = (int)n;
    return status_ok();
}

static status take_set(usage_line *l, const char *set)
{
    CHECK(l->n_sets < USAGE_MAX_SETS, STATUS_BAD_INPUT, "--set: more than %d", USAGE_MAX_SETS);
    l->sets[l->n_sets++] = set;
    return status_ok();
}

static status take_value(const usage_option *o, const char *value, usage_line *l)
{
    char *member = (char *)l + o->offset;
    CHECK(value, STATUS_BAD_INPUT, "%s needs a value: %s %s", o->name, o->name, o->value);
    switch (o->kind) {
    case USAGE_TEXT:
        CHECK(value[0], STATUS_BAD_INPUT, "%s: the %s is empty", o->name,
              o->completes == USAGE_FOLDERS ? "directory's name" : "case's name");
        *(const char **)(void *)member = value;
        break;
    case USAGE_SET: return take_set(l, value);
    case USAGE_COUNT: return read_count(o, value, (int *)(void *)member);
    case USAGE_TIME:
        *(double *)(void *)member = wall_time(value);
        CHECK(wall_time(value) > 0.0, STATUS_BAD_INPUT, "%s %.40s: must be a time such as 90, 45s, 30m, 2h or 1:30:00",
              o->name, value);
        break;
    case USAGE_FLAG: break;
    }
    return status_ok();
}

/* ---- words ---- */

static const usage_option *option_find(const char *name)
{
    for (const usage_option *o = usage_options; o->name; o++)
        if (strcmp(o->name, name) == 0) return o;
    return NULL;
}

bool usage_given(const usage_line *l, const char *option)
{
    const usage_option *o = option_find(option);
    return o && (l->given & BIT(o - usage_options)) != 0;
}

/* One word of the command line; *i moves on where the next one is its value.  --name=value is understood too. */
static status take_word(usage_line *l, int argc, char **argv, int *i)
{
    const char *whole = argv[*i], *equals = strncmp(whole, "--", 2) == 0 ? strchr(whole, '=') : NULL;
    char word[200];
    snprintf(word, sizeof word, "%.*s", equals ? (int)(equals - whole) : (int)sizeof word, whole);
    const usage_option *o = option_find(word);
    if (o) {
        const uint64_t bit = BIT(o - usage_options);
        CHECK(!(l->given & bit) || o->kind == USAGE_FLAG || o->kind == USAGE_SET, STATUS_BAD_INPUT, "%s is given twice",
              word);
        CHECK(!equals || o->kind != USAGE_FLAG, STATUS_BAD_INPUT, "%s takes no value", word);
        l->given |= bit;
        if (o->kind != USAGE_FLAG) return take_value(o, equals ? equals + 1 : *i + 1 < argc ? argv[++*i] : NULL, l);
        *(bool *)(void *)((char *)l + o->offset) = true;
        return status_ok();
    }
    if (word[0] == '-' && word[1] != '\0') return no_option(word);
    if (!l->command.name) {
        l->command = usage_command_find(word);
        return l->command.name ? status_ok() : usage_no_command(word);
    }
    CHECK(!l->subject, STATUS_BAD_INPUT, "%s takes one %s: `%.80s` is one too many", l->command.name,
          l->command.subject, whole);
    l->subject = whole;
    return status_ok();
}

/* "scene", or "check, new": who takes it. */
static void takers(const usage_option *o, char *out, size_t size)
{
    size_t n = 0;
    out[0] = '\0';
    for (int i = 0; i < USAGE_COMMANDS_MADE && n < size; i++) {
        const usage_command c = usage_command_at(i);
        if (usage_takes(&c, o)) n += (size_t)snprintf(out + n, size - n, "%s%s", n ? ", " : "", c.name);
    }
}

static status options_are_taken(const usage_line *l)
{
    char who[200];
    for (const usage_option *o = usage_options; o->name; o++) {
        if (!(l->given & BIT(o - usage_options)) || usage_takes(&l->command, o)) continue;
        takers(o, who, sizeof who);
        CHECK(o->offset != offsetof(usage_line, ensemble) || strcmp(l->command.name, "strike") != 0, STATUS_BAD_INPUT,
              "strike takes no --ensemble: vary scene.grid_shift by a sweep of strikes, or `breech scene CASE "
              "--ensemble N`");
        CHECK(o->offset != offsetof(usage_line, ensemble), STATUS_BAD_INPUT,
              "%s takes no --ensemble; for a threshold it is --set study.threshold_ensemble=N", l->command.name);
        return base_status_error(STATUS_BAD_INPUT,
                                 "%s takes no %s, which is for %s; breech --help %s lists its options", l->command.name,
                                 o->name, who, l->command.name);
    }
    return status_ok();
}

status usage_parse(int argc, char **argv, usage_line *out)
{
    const int threads = out->threads;
    *out = (usage_line){ .threads = threads, .max_walltime = INFINITY };
    for (int i = 1; i < argc; i++) TRY(take_word(out, argc, argv, &i));
    CHECK(out->command.name, STATUS_BAD_INPUT, "no command given; breech --help lists them");
    TRY(options_are_taken(out));
    CHECK(!out->store || !out->no_store, STATUS_BAD_INPUT, "--store and --no-store exclude each other");
    if (out->no_store) out->store = "";
    CHECK(out->subject || !out->command.subject_required, STATUS_BAD_INPUT, "%s needs a %s: breech %s %s",
          out->command.name, out->command.subject, out->command.name, out->command.subject);
    if (!out->ensemble) return status_ok();
    snprintf(out->ensemble_set, sizeof out->ensemble_set, "study.ensemble=%d", out->ensemble);
    return take_set(out, out->ensemble_set);
}
