/* SPDX-License-Identifier: BSD-3-Clause */
/* breech new: a case begun from any shipped case is that case under its own name, with its files, and says what its
 * keys mean; what is there stays as it is. */
#include "program_common.h"

#include "coupling/case/case_new.h"
#include "coupling/case/case_plain.h"
#include "coupling/case/material_file.h"

/* used.yaml of a case as text, without the lines that name it. */
static char *used(const char *path)
{
    material_places at;
    OK(case_material_places_find(&at));
    const case_options how = { .material_dirs = at.dir, .n_material_dirs = at.n };
    case_inputs *in = NULL;
    char *errors = NULL, *text = NULL;
    size_t length = 0;
    const status s = case_inputs_read(path, NULL, 0, &how, &in, &errors);
    if (s.code != STATUS_OK) fail_msg("%s: %s", path, errors ? errors : s.text);
    free(errors);
    FILE *f = open_memstream(&text, &length);
    OK(case_inputs_write(in, f));
    fclose(f);
    case_inputs_free(in);
    for (char *line = text; line; line = strchr(line + 1, '\n'))
        if (strncmp(line, "\nname:", 6) == 0 || strncmp(line, "\n# ", 3) == 0)
            for (char *c = line + 1; *c && *c != '\n'; c++) *c = ' ';
    for (char *c = text; *c && *c != '\n'; c++) *c = ' '; /* the first line */
    return text;
}

/* Texts alike but for spaces. */
static bool alike(const char *a, const char *b)
{
    for (;;) {
        while (*a == ' ') a++;
        while (*b == ' ') b++;
        if (*a != *b || *a == '\0') return *a == *b;
        a++;
        b++;
    }
}

/* Every shipped case, those of the verification too. */
static void test_same_values(void **state)
{
    (void)state;
    static const char *const folders[] = { CASES, CASES "/verification" };
    int tried = 0;
    fresh_folder("same");
    for (size_t k = 0; k < sizeof folders / sizeof *folders; k++) {
        DIR *d = opendir(folders[k]);
        assert_non_null(d);
        for (const struct dirent *e; (e = readdir(d));) {
            char from[400], to[400];
            snprintf(from, sizeof from, "%s/%s/case.yaml", folders[k], e->d_name);
            snprintf(to, sizeof to, "same/new-%s", e->d_name);
            if (e->d_name[0] == '.' || !exists(from) || exists(to)) continue;
            OK(case_new_make(to, from));
            char *old = used(from), *made = used(to);
            if (!alike(old, made)) fail_msg("%s is not %s", to, from);
            free(old);
            free(made);
            tried++;
        }
        closedir(d);
    }
    assert_true(tried > 15);
}

/* A key of a block alone on its line has a comment there or above it. */
static void assert_commented(const char *file)
{
    char line[600], before[600] = "";
    int keys = 0;
    FILE *f = fopen(file, "r");
    assert_non_null(f);
    while (fgets(line, sizeof line, f)) {
        const size_t indent = strspn(line, " ");
        const char *colon = strchr(line, ':');
        const bool key = indent == 2 && colon && line[indent] != '#' && line[indent] != '-';
        keys += key;
        if (key && !strchr(line, '#') && !strchr(before, '#')) fail_msg("%s: no comment: %s", file, line);
        memcpy(before, line, sizeof before);
    }
    fclose(f);
    assert_true(keys > 4);
}

static void test_kinds(void **state)
{
    (void)state;
    fresh_folder("kinds");
    for (const case_kind *k = case_kinds; k->name; k++) {
        char arguments[300], file[100], says[100];
        snprintf(arguments, sizeof arguments, "new kinds/%s --from %s", k->name, k->name);
        assert_int_equal(run(k == case_kinds ? "new kinds/shot" : arguments), 0);
        snprintf(says, sizeof says, "breech %s", k->run);
        assert_true(contains("out.txt", says));
        snprintf(file, sizeof file, "kinds/%s/case.yaml", k->name);
        assert_commented(file);
        snprintf(says, sizeof says, "\nname: %s", k->name);
        assert_true(contains(file, says));
        snprintf(arguments, sizeof arguments, "check kinds/%s", k->name);
        assert_int_equal(run(arguments), 0);
        assert_true(strcmp(k->run, "life") == 0 || contains("out.txt", "time, at least")); /* a life has no scene */
    }
    assert_int_equal(run("scene kinds/bodies -o kinds/out --set scene.end_time='0.5 us' --set scene.cell='1 mm' "
                         "--set output.report=no"),
                     0);
    cJSON *s = summary_of("kinds/out");
    assert_text(s, "case", "bodies");
    assert_non_null(cJSON_GetObjectItemCaseSensitive(cJSON_GetObjectItemCaseSensitive(s, "probes"), "gauge"));
    cJSON_Delete(s);
}

/* An own case: its tables and materials come along, from other folders too; so does what it builds on. */
static void test_own(void **state)
{
    (void)state;
    fresh_folder("own");
    fresh_folder("own/deep");
    fresh_folder("own/other");
    assert_int_equal(
        system("cp '" CASES "/current_profile/current.csv' own/other/pulse.csv && "
               "sed s/ofhc_copper/my_copper/ '" CASES "/materials/ofhc_copper.yaml' > own/deep/my_copper.yaml && "
               "sed 's|current.csv|../other/pulse.csv|; s|^name: .*|name: \"mine, of old\"|' '" CASES
               "/current_profile/case.yaml' > own/deep/case.yaml && "
               "printf 'base: ../deep\\nname: top\\nrail: {material: my_copper}\\n' > own/other/case.yaml"),
        0);
    assert_int_equal(run("new own/made --from own/other"), 0);
    assert_true(exists("own/made/deep/pulse.csv") && exists("own/made/deep/my_copper.yaml"));
    assert_true(contains("own/made/deep/case.yaml", "name: \"mine, of old\""));
    assert_true(contains("own/made/case.yaml", "base: deep\n") && contains("own/made/case.yaml", "name: made"));
    char *old = used("own/other");
    assert_int_equal(system("mv own/made own/moved && rm -r own/deep own/other"), 0);
    char *made = used("own/moved");
    assert_true(alike(old, made));
    free(old);
    free(made);
}

/* The new case has the values of the old one, also where that is no longer there. */
static void assert_begun(const char *from, const char *made, const char *moved)
{
    char line[300];
    snprintf(line, sizeof line, "new %s --from '%s'", made, from);
    assert_int_equal(run(line), 0);
    char *old = used(from);
    snprintf(line, sizeof line, "mv %s %s && mv '%s' gone && mkdir '%s'", made, moved, from, from);
    assert_int_equal(system(line), 0);
    char *now = used(moved);
    if (!alike(old, now)) fail_msg("%s is not %s", made, from);
    snprintf(line, sizeof line, "rmdir '%s' && mv gone '%s'", from, from);
    assert_int_equal(system(line), 0);
    free(old);
    free(now);
}

/* Files of one name from two folders: both come. */
static void test_same_names(void **state)
{
    (void)state;
    fresh_folder("names");
    assert_int_equal(
        system("cd names && mkdir a b case && printf '0, 0\n1e-3, 1e5\n' >a/current.csv && "
               "printf '0, 0\n1e-3, 2e5\n' >b/current.csv && printf '0, 0\n1e-3, 3e5\n' >case/current.csv && "
               "cp b/current.csv b/case.yaml && "
               "sed '/^current_profiles:/,/^ *$/d' '" CASES "/current_profile/case.yaml' >case/case.yaml && "
               "printf 'current_profiles: [{file: ../a/current.csv}, {file: ../b/current.csv}, "
               "{file: current.csv}, {file: ../b/case.yaml}, {file: ../a/current.csv}]\n' >>case/case.yaml"),
        0);
    assert_begun("names/case", "names/made", "names/moved");
    assert_true(contains("names/moved/case.yaml", "{file: current.csv}, {file: current-2.csv}, {file: current-3.csv}, "
                                                  "{file: case-2.yaml}, {file: current.csv}"));
}

/* A material's own base, and materials that one file of a case names and that lie beside another of it. */
static void test_own_materials(void **state)
{
    (void)state;
    fresh_folder("metals");
    assert_int_equal(
        system("cd metals && mkdir low top && sed 's/8960 kg/8000 kg/' '" CASES
               "/materials/ofhc_copper.yaml' >low/ofhc_copper.yaml && printf 'name: mine\nbase: ofhc_copper\n"
               "sources: {me: here}\nconstants: {hardness: {value: 1 GPa, source: me}}\n' >low/mine.yaml && "
               "sed s/8000/7000/ low/ofhc_copper.yaml >top/ofhc_copper.yaml && "
               "sed 's/^name: mine/name: other/' low/mine.yaml >top/other.yaml && "
               "printf 'base: default_shot\nname: low\nrail: {material: other}\n' >low/case.yaml && "
               "printf 'base: ../low\nname: top\narmature: {material: mine}\n' >top/case.yaml"),
        0);
    assert_begun("metals/top", "metals/made", "metals/moved");
    assert_true(exists("metals/moved/low/ofhc_copper.yaml") && exists("metals/moved/ofhc_copper.yaml"));
    assert_true(contains("metals/moved/low/case.yaml", "base: default_shot\n"));
}

/* What YAML would read as something else keeps its quotes. */
static void test_quotes(void **state)
{
    (void)state;
    fresh_folder("quotes");
    assert_int_equal(system("cd quotes && mkdir top 'shot #2' && printf 'base: default_shot\nname: low\n' "
                            ">'shot #2/case.yaml' && printf 'base: \"../shot #2\"\nname: top\n' >top/case.yaml"),
                     0);
    assert_begun("quotes/top", "quotes/made", "quotes/moved");
    assert_true(contains("quotes/moved/case.yaml", "base: \"shot #2\"\n"));
}

static void test_refused(void **state)
{
    (void)state;
    fresh_folder("refused");
    assert_int_equal(run("new refused/there"), 0);
    assert_int_equal(
        system("echo changed >> refused/there/case.yaml; ln -s nowhere refused/link; echo x > refused/bad.yaml"), 0);
    static const char *const wrong[][2] = {
        { "new", "new needs a NAME" },
        { "new refused/there", "is there already" },
        { "new refused/there/ --from bodies", "is there already" },
        { "new refused/link", "is there already" },
        { "new refused", "is there already" },
        { "new ..", "no name for a case" },
        { "new 'refused/a b'", "no name for a case" },
        { "new _", "no name for a case" },
        { "new refused/a23456789012345678901234567890123456789012345678901234567890123x", "no name for a case" },
        { "new refused/a --from nothing", "shot, bodies, strike, life" },
        { "new refused/a --from refused/bad.yaml", "has errors" },
        { "new refused/a --from ''", "empty" },
        { "check refused/there --from shot", "check takes no --from" },
    };
    for (size_t k = 0; k < sizeof wrong / sizeof *wrong; k++) {
        if (run(wrong[k][0]) != 2) fail_msg("breech %s: not refused with 2", wrong[k][0]);
        if (!contains("err.txt", wrong[k][1])) fail_msg("breech %s: does not say %s", wrong[k][0], wrong[k][1]);
        assert_false(exists("refused/a"));
    }
    assert_true(contains("refused/there/case.yaml", "changed"));
    /* 2 of 512 bytes: what LLVM writes for OpenMP before main begins has 1024 */
    assert_int_equal(system("ulimit -f 2; " BREECH_PROGRAM " new refused/a >out.txt 2>err.txt; test $? -eq 1"), 0);
    assert_false(exists("refused/a")); /* nothing of it stays in the way of another try */
    assert_int_equal(run("new refused/a23456789012345678901234567890123456789012345678901234567890123"), 0);
    assert_int_equal(run("check refused/a23456789012345678901234567890123456789012345678901234567890123"), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_same_values), cmocka_unit_test(test_kinds),         cmocka_unit_test(test_own),
        cmocka_unit_test(test_same_names),  cmocka_unit_test(test_own_materials), cmocka_unit_test(test_quotes),
        cmocka_unit_test(test_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
