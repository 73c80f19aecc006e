/* SPDX-License-Identifier: BSD-3-Clause */
/* The command line as its lists say it: help, manual page and completion name every command and option, an option that
 * a command does not take is refused, every example can be run. */
#include "program_common.h"

#include "coupling/usage/usage.h"

/* The words of a line as a shell would split it; quotes as in the examples.  Points into `line`, which is changed. */
static int split(char *line, char **words, int room)
{
    int n = 0;
    for (char *c = line; *c && n < room;) {
        while (*c == ' ') c++;
        char *to = words[n] = c;
        if (*c) n++;
        for (bool quoted = false; *c && (quoted || *c != ' '); c++) {
            if (*c == '"')
                quoted = !quoted;
            else
                *to++ = *c;
        }
        if (*c) c++;
        *to = '\0';
    }
    return n;
}

/* A line of the help that begins with this option. */
static bool lists(const char *file, const char *option)
{
    char begins[60], ends[60];
    snprintf(begins, sizeof begins, "\n  %s ", option);
    snprintf(ends, sizeof ends, "\n  %s\n", option);
    return contains(file, begins) || contains(file, ends);
}

static void test_help(void **state)
{
    (void)state;
    for (int i = 0; i < USAGE_COMMANDS_MADE; i++) {
        const usage_command c = usage_command_at(i);
        char arguments[60], says[200];
        snprintf(arguments, sizeof arguments, i % 2 ? "%s --help" : "--help %s", c.name);
        assert_int_equal(run(arguments), 0);
        snprintf(says, sizeof says, "usage: breech %s %s", c.name, c.subject);
        assert_true(contains("out.txt", says));
        snprintf(says, sizeof says, "example:\n  %s\n", c.example ? c.example : "");
        assert_true(!c.example || contains("out.txt", says));
        assert_true(contains("out.txt", "breech --keys"));
        for (const usage_option *o = usage_options; o->name; o++)
            if (lists("out.txt", o->name) != usage_takes(&c, o)) fail_msg("--help %s: %s", c.name, o->name);
    }
    assert_int_equal(run("--help"), 0);
    for (int i = 0; i < USAGE_COMMANDS_MADE; i++) {
        char says[60];
        snprintf(says, sizeof says, "\n  breech %s ", usage_command_at(i).name);
        assert_true(contains("out.txt", says));
    }
    for (const usage_option *o = usage_words; o->name; o++) assert_true(lists("out.txt", o->name));
}

/* An example's words are read without an error, and its case is there. */
static void test_examples(void **state)
{
    (void)state;
    int cases = 0;
    for (int i = 0; i < USAGE_COMMANDS_MADE; i++) {
        const usage_command c = usage_command_at(i);
        char line[300], *words[40], path[400];
        usage_line l = { .threads = 1 };
        if (!c.example) continue;
        snprintf(line, sizeof line, "%s", c.example);
        const int n = split(line, words, 40);
        const status s = usage_parse(n, words, &l);
        if (s.code != STATUS_OK) fail_msg("%s: %s", c.example, s.text);
        assert_string_equal(l.command.name, c.name);
        if (strcmp(c.subject, "CASE") != 0) continue;
        snprintf(path, sizeof path, BREECH_TESTS "/../%s/case.yaml", l.subject);
        if (!exists(path)) fail_msg("%s: no %s", c.example, path);
        cases++;
    }
    assert_true(cases >= 7);
}

static void test_not_taken(void **state)
{
    (void)state;
    static const char *const wrong[][2] = {
        { "materials --force", "materials takes no --force" },
        { "check " SHOT " --resume", "check takes no --resume" },
        { "check " SHOT " -o somewhere", "check takes no -o" },
        { "report somewhere --set a=1", "report takes no --set" },
        { "onset " SHOT " --ensemble 3", "study.threshold_ensemble" },
        { "strike " SHOT " --ensemble 3", "vary scene.grid_shift by a sweep of strikes" },
        { "shot " SHOT " --scene", "shot takes no --scene, which is for check" },
        { "new x --threads 2", "new takes no --threads" },
        { "shot " SHOT " --instruction-set sse9", "`sse9` is unknown, or this machine lacks it; here run:" },
        { "--completion fish", "bash or zsh" },
        { "--completion", "bash or zsh" },
    };
    for (size_t k = 0; k < sizeof wrong / sizeof *wrong; k++) {
        if (run(wrong[k][0]) != 2) fail_msg("breech %s: not refused with 2", wrong[k][0]);
        if (!contains("err.txt", wrong[k][1])) fail_msg("breech %s: does not say %s", wrong[k][0], wrong[k][1]);
    }
    assert_false(exists("x"));
}

/* Every command and option is in the page, and what reads such pages finds nothing wrong. */
static void test_man(void **state)
{
    (void)state;
    assert_int_equal(run("--man"), 0);
    assert_int_equal(system("cp out.txt breech.1"), 0);
    for (int i = 0; i < USAGE_COMMANDS_MADE; i++) {
        char says[80];
        snprintf(says, sizeof says, ".SS \"breech %s ", usage_command_at(i).name);
        assert_true(contains("breech.1", says));
    }
    for (const usage_option *o = usage_options; o->name; o++) {
        char says[80] = ".TP\n\\fB";
        for (const char *c = o->name; *c; c++) snprintf(says + strlen(says), 4, *c == '-' ? "\\-" : "%c", *c);
        if (!contains("breech.1", says)) fail_msg("breech --man: no %s", o->name);
    }
    if (system("command -v mandoc > /dev/null") == 0) assert_int_equal(system("mandoc -T lint -W error breech.1"), 0);
    if (system("command -v groff > /dev/null") == 0)
        assert_int_equal(system("groff -ww -man -T utf8 -z breech.1 2> wrong.txt && [ ! -s wrong.txt ]"), 0);
}

/* What bash offers for the last of these words. */
static void complete(const char *words, int last, char *out, size_t size)
{
    char command[900];
    snprintf(command, sizeof command,
             "PATH=\"$(dirname '" BREECH_PROGRAM "'):$PATH\" BREECH_MATERIALS= bash -c 'source ./breech.bash && "
             "COMP_WORDS=(%s) COMP_CWORD=%d ; _breech; echo \"${COMPREPLY[*]}\"'",
             words, last);
    FILE *f = popen(command, "r");
    assert_non_null(f);
    if (!fgets(out, (int)size, f)) out[0] = '\0';
    pclose(f);
    out[strcspn(out, "\n")] = '\0';
}

static void test_bash(void **state)
{
    (void)state;
    static const struct {
        const char *words;
        int last;
        const char *offers;
    } tries[] = {
        { "breech o", 1, "onset" },
        { "breech --comp", 1, "--completion" },
        { "breech --completion z", 2, "zsh" },
        { "breech --help ma", 2, "materials" },
        { "breech check --", 2, "--help --set --threads --processes --expect --scene" },
        { "breech scene folder --en", 3, "--ensemble" },
        { "breech onset folder --en", 3, "" },
        { "breech new x --from bod", 4, "bodies" },
        { "breech onset folder --store inn", 4, "inner" },
        { "breech onset fol", 2, "folder" },
        { "breech shot folder --max-walltime f", 4, "" },
        { "breech materials quart", 2, "quartz" },
        { "breech flow quart", 2, "quartz" },
    };
    assert_int_equal(run("--completion bash"), 0);
    assert_int_equal(system("cp out.txt breech.bash && mkdir -p folder inner && touch innocent"), 0);
    for (size_t k = 0; k < sizeof tries / sizeof *tries; k++) {
        char found[400];
        complete(tries[k].words, tries[k].last, found, sizeof found);
        if (strcmp(found, tries[k].offers) != 0)
            fail_msg("%s: offers `%s`, not `%s`", tries[k].words, found, tries[k].offers);
    }
}

static void test_zsh(void **state)
{
    (void)state;
    assert_int_equal(run("--completion zsh"), 0);
    assert_true(contains("out.txt", "#compdef breech\n") && contains("out.txt", "'--max-walltime[stop with"));
    assert_int_equal(system("cp out.txt _breech"), 0);
    if (system("command -v zsh > /dev/null") != 0) skip();
    assert_int_equal(system("zsh -n _breech"), 0);
    assert_int_equal(system("zsh -f -c 'autoload -U compinit && compinit -u -D && source ./_breech && "
                            "[ \"$_comps[breech]\" = _breech ]'"),
                     0);
}

/* Pages that list commands by hand have all of them, and the text of sweep.of those that a sweep can run. */
static void test_lists_by_hand(void **state)
{
    (void)state;
    static const char readme[] = BREECH_TESTS "/../README.md", keys[] = BREECH_TESTS "/../docs/reference/case-files.md";
    static const char begins[] = "the study to run: ";
    char *page = NULL, text[80], line[300] = "";
    OK(host_file_read(keys, &page, NULL));
    const char *of = strstr(page, begins);
    assert_non_null(of);
    snprintf(line, sizeof line, " %.*s,", (int)strcspn(of + strlen(begins), "|\n"), of + strlen(begins));
    for (char *c = line; *c; c++)
        if (*c == ' ' && c[1] == ',') memmove(c, c + 1, strlen(c));
    for (int i = 0; i < STUDIES; i++) {
        const char *name = study_list[i]->name;
        snprintf(text, sizeof text, "`breech %s CASE`", name);
        if (!contains(readme, text)) fail_msg("README.md has no line for %s in its table of commands", text);
        snprintf(text, sizeof text, "\n| `breech %s` |", name);
        if (!strstr(page, text)) fail_msg("docs/reference/case-files.md does not say what `breech %s` needs", name);
        snprintf(text, sizeof text, " %s,", name);
        if (study_list[i]->can_vary != (strstr(line, text) != NULL))
            fail_msg("sweep.of, coupling/case/case_schema.c: `%s` %s in its text:%s", name,
                     study_list[i]->can_vary ? "is not" : "is", line);
    }
    free(page);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_help),          cmocka_unit_test(test_examples), cmocka_unit_test(test_not_taken),
        cmocka_unit_test(test_man),           cmocka_unit_test(test_bash),     cmocka_unit_test(test_zsh),
        cmocka_unit_test(test_lists_by_hand),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
