/* SPDX-License-Identifier: BSD-3-Clause */
/* Every file of cases/materials: it reads, each constant has a source and lies in its range; and what the reader
 * refuses. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "coupling/case/case.h"
#include "coupling/case/material_role.h"
#include "coupling/host/file_text.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define MATERIALS BREECH_TESTS "/../cases/materials"

static const char *const dirs[] = { MATERIALS };

typedef struct {
    units *u;
    char **names;
    int n;
} shelf;

static int open_shelf(void **state)
{
    static shelf s;
    assert_int_equal(host_units_open(&s.u).code, STATUS_OK);
    assert_int_equal(case_material_names(MATERIALS, &s.names, &s.n).code, STATUS_OK);
    *state = &s;
    return 0;
}

static int close_shelf(void **state)
{
    shelf *s = *state;
    host_units_close(s->u);
    case_material_names_free(s->names, s->n);
    return 0;
}

static void check_sheet(const material_sheet *sheet)
{
    int given = 0;
    assert_int_equal(base_params_check(mpm_material_params, &sheet->material, sheet->material.name).code, STATUS_OK);
    for (int k = 0; k < sheet->n; k++) {
        const material_constant *c = &sheet->constant[k];
        const double value = *(const double *)(const void *)((const char *)&sheet->material + c->constant->offset);
        assert_true(isfinite(value));
        assert_non_null(c->source);
        assert_true(strlen(c->source) >= 20); /* a citation, not a short name */
    }
    for (const base_param *p = mpm_material_params; p->key; p++) {
        const double *value = (const double *)(const void *)((const char *)&sheet->material + p->offset);
        given += p->kind == BASE_PARAM_NUMBER && !isnan(*value);
    }
    assert_int_equal(given, sheet->n); /* nothing comes from anywhere but the file */
}

static void every_file_reads_and_has_sources(void **state)
{
    shelf *s = *state;
    assert_true(s->n >= 16); /* the rows of the reference tables */
    for (int k = 0; k < s->n; k++) {
        material_sheet sheet;
        char *errors = NULL;
        const status result = case_material_sheet_find(s->u, s->names[k], dirs, 1, &sheet, &errors);
        if (result.code != STATUS_OK) print_error("%s: %s\n%s", s->names[k], result.text, errors ? errors : "");
        assert_int_equal(result.code, STATUS_OK);
        assert_string_equal(sheet.material.name, s->names[k]);
        check_sheet(&sheet);
        case_material_sheet_free(&sheet);
    }
}

static bool mentions(const char *text, const char *const *words)
{
    for (int k = 0; words[k]; k++)
        if (strstr(text, words[k])) return true;
    return false;
}

/* A source that says of itself that it is unchecked makes the constant weak, and the warning names it. */
static void unchecked_constants_are_weak(void **state)
{
    static const char *const words[] = { "not yet checked", "uncited", "not verified", "secondary", NULL };
    shelf *s = *state;
    for (int k = 0; k < s->n; k++) {
        material_sheet sheet;
        char *errors = NULL, warning[MATERIAL_WARNING_SIZE];
        int weak = 0;
        assert_int_equal(case_material_sheet_find(s->u, s->names[k], dirs, 1, &sheet, &errors).code, STATUS_OK);
        case_material_sheet_warning(&sheet, warning);
        for (int i = 0; i < sheet.n; i++) {
            const material_constant *c = &sheet.constant[i];
            if (mentions(c->source, words) && !c->weak) print_error("%s.%s\n", s->names[k], c->constant->key);
            assert_false(mentions(c->source, words) && !c->weak);
            if (c->weak) assert_non_null(strstr(warning, c->constant->key));
            weak += c->weak;
        }
        assert_true((weak > 0) == (warning[0] != '\0'));
        case_material_sheet_free(&sheet);
    }
}

/* The set of the paper that is to be repeated, digit for digit (table 1 of Wu et al. 2017). */
static void the_papers_sets_are_kept(void **state)
{
    shelf *s = *state;
    material_sheet sheet;
    char *errors = NULL;
    assert_int_equal(case_material_sheet_find(s->u, "w17_al7075", dirs, 1, &sheet, &errors).code, STATUS_OK);
    const mpm_material *m = &sheet.material;
    assert_true(m->density == 2810.0 && m->youngs_modulus == 71e9 && m->poisson == 0.33 && m->specific_heat == 960.0);
    assert_true(m->yield_A == 369e6 && m->hardening_B == 684e6 && m->hardening_n == 0.73);
    assert_true(m->rate_C == 0.0083 && m->softening_m == 1.7 && m->melting_temperature == 933.0);
    assert_true(m->damage_D1 == 0.13 && m->damage_D2 == 0.13 && m->damage_D3 == -1.5 && m->damage_D4 == 0.011);
    assert_true(m->damage_D5 == 0.0 && m->sound_speed == 5350.0 && m->hugoniot_slope == 1.34 && m->gruneisen == 2.0);
    assert_true(isnan(m->hardness) && isnan(m->conductivity)); /* blank in the table */
    case_material_sheet_free(&sheet);
}

static bool chooses(const char *name, const char *line)
{
    char path[300], *text = NULL;
    size_t length = 0;
    snprintf(path, sizeof path, MATERIALS "/%s.yaml", name);
    assert_int_equal(host_file_text(path, 1 << 20, &text, &length).code, STATUS_OK);
    const bool found = strstr(text, line) != NULL;
    free(text);
    return found;
}

/* A file that names no law has those of a metal; one that names any has all the constants that it asks for. */
static void the_laws_are_read(void **state)
{
    shelf *s = *state;
    int metals = 0, fluids = 0, others = 0;
    for (int k = 0; k < s->n; k++) {
        material_sheet sheet;
        char *errors = NULL;
        assert_int_equal(case_material_sheet_find(s->u, s->names[k], dirs, 1, &sheet, &errors).code, STATUS_OK);
        const mpm_material *m = &sheet.material;
        const bool strength = chooses(s->names[k], "\nstrength: "), eos = chooses(s->names[k], "\neos: ");
        assert_int_equal(m->strength != MPM_STRENGTH_johnson_cook, strength);
        assert_int_equal(m->eos != MPM_EOS_mie_gruneisen, eos);
        assert_int_equal(m->failure != MPM_FAILURE_johnson_cook, chooses(s->names[k], "\nfailure: "));
        if (strength || eos) assert_int_equal(mpm_material_check(m, MPM_MATERIAL_FOR_SCENE).code, STATUS_OK);
        const bool fluid = mpm_material_shear(m) == MPM_SHEAR_NONE;
        if (fluid)
            assert_int_equal(mpm_material_check(m, MPM_MATERIAL_FOR_SCENE | MPM_MATERIAL_FOR_DAMAGE).code, STATUS_OK);
        metals += !strength, fluids += fluid, others += strength && !fluid;
        case_material_sheet_free(&sheet);
    }
    assert_true(metals >= 16 && fluids >= 3 && others >= 2);
}

typedef struct {
    const char *text, *error;
} bad_file;

#define HEAD "name: x\nsources: {A: a book of constants}\n"

static void bad_files_say_where(void **state)
{
    shelf *s = *state;
    static const bad_file bad[] = {
        { HEAD, "x.yaml:1:1: `constants` is missing" },
        { "name: y\nsources: {A: a book}\nconstants: {}\n", "x.yaml:1:7: name = y: must be the file's name, x" },
        { HEAD "constants:\n  density: 5 kg/m^3\n",
          "x.yaml:4:12: constants.density: must be {value: ..., source: ...}" },
        { HEAD "constants:\n  density: {value: 5 kg}\n", "x.yaml:4:12: constants.density.source is missing" },
        { HEAD "constants:\n  density: {value: 9e4 kg/m^3, source: A}\n",
          "x.yaml:4:20: constants.density.value = 9e4 kg/m^3: must lie within the range (0.01 kg/m^3 .. 30000 "
          "kg/m^3)" },
        { HEAD "constants:\n  density: {value: 8 g/cm^3, source: B}\n",
          "x.yaml:4:38: constants.density.source = B: not in `sources` of this file" },
        { HEAD "constants:\n  densty: {value: 8 g/cm^3, source: A}\n",
          "x.yaml:4:3: unknown constant `densty`; did you mean `density`?" },
        { HEAD "constants:\n  poisson: {value: 0.3, source: A, waek: yes}\n",
          "x.yaml:4:36: unknown key `waek` in constants.poisson; did you mean `weak`?" },
        { HEAD "constants:\n  poisson: {value: 0.3 Pa, source: A}\n",
          "x.yaml:4:20: constants.poisson.value = 0.3 Pa: is a pure number" },
        { HEAD "strength: wood\nconstants: {}\n", "x.yaml:3:11: strength = wood: must be one of johnson_cook, mts" },
        { HEAD "eos: wood\nconstants: {}\n",
          "x.yaml:3:6: eos = wood: must be one of mie_gruneisen, stiffened_gas, tait" },
        { HEAD "failure: wood\nconstants: {}\n", "x.yaml:3:10: failure = wood: must be one of johnson_cook" },
        { "- a\n", "x.yaml:1:1: a material's file has the keys" },
    };
    for (size_t k = 0; k < sizeof bad / sizeof bad[0]; k++) {
        material_sheet sheet;
        char *errors = NULL;
        const status r =
            case_material_sheet_parse(s->u, bad[k].text, strlen(bad[k].text), "x.yaml", dirs, 1, &sheet, &errors);
        assert_int_equal(r.code, STATUS_BAD_INPUT);
        assert_non_null(errors);
        if (!strstr(errors, bad[k].error)) print_error("wanted %s\nin %s", bad[k].error, errors);
        assert_non_null(strstr(errors, bad[k].error));
        free(errors);
    }
}

static const material_constant *constant_of(const material_sheet *sheet, const char *key)
{
    for (int i = 0; i < sheet->n; i++)
        if (strcmp(sheet->constant[i].constant->key, key) == 0) return &sheet->constant[i];
    return NULL;
}

/* A copper of one's own in six lines: all is the base's but what the file says, which stands with its own source. */
static void a_material_changes_its_base(void **state)
{
    shelf *s = *state;
    static const char own[] = "name: x\nbase: ofhc_copper_half_hard\nsources: {mine: our test}\nconstants:\n"
                              "  hardness: {value: 1.1 GPa, source: mine}\n  resistivity_slope: ~\n";
    material_sheet base, sheet;
    char *errors = NULL;
    assert_int_equal(case_material_sheet_find(s->u, "ofhc_copper_half_hard", dirs, 1, &base, &errors).code, STATUS_OK);
    const status r = case_material_sheet_parse(s->u, own, strlen(own), "x.yaml", dirs, 1, &sheet, &errors);
    if (r.code != STATUS_OK) fail_msg("%s", errors);
    assert_int_equal(sheet.n, base.n - 1);
    assert_non_null(strstr(sheet.base, "/ofhc_copper_half_hard.yaml"));
    assert_true(sheet.material.hardness == 1.1e9 && base.material.hardness == 950e6);
    assert_true(isnan(sheet.material.resistivity_slope) && sheet.material.strength == base.material.strength);
    assert_true(sheet.material.mts_sigma_a == base.material.mts_sigma_a);
    assert_true(base.take_for[0] && !sheet.take_for[0]); /* that is said of the base alone */
    const material_constant *hard = constant_of(&sheet, "hardness");
    assert_string_equal(hard->source, "our test");
    assert_true(!hard->weak && !hard->note); /* those were the old value's */
    assert_string_equal(constant_of(&sheet, "mts_p")->source, constant_of(&base, "mts_p")->source);
    case_material_sheet_free(&sheet);
    case_material_sheet_free(&base);
}

/* Each error names the file, line and column where it stands, be it the base's. */
static void errors_of_bases_have_their_place(void **state)
{
    shelf *s = *state;
    static const struct {
        const char *text, *error;
    } bad[] = {
        { "name: x\nbase: ofhc_coper\n", "x.yaml:2:7: base = ofhc_coper: no material of this name in " },
        { "name: x\nbase: ofhc_coper\n", "did you mean `ofhc_copper" },
        { "name: x\nbase: steel\n", "did you mean `rail_steel_ma2020`, `steel_1080`, `steel_4340`?" },
        { "name: x\nbase: ../ofhc_copper\n", "x.yaml:2:7: base = ../ofhc_copper: a material's name has letters" },
        { "name: x\nbase: [1]\n", "x.yaml:2:7: base = : must be the name of a material" },
        { "name: x\nbase: ofhc_copper\nsources: {book: mine}\n",
          "x.yaml:3:11: sources.book: the base has a source of this name" },
        { "name: x\nbase: ofhc_copper\nconstants:\n  hardness: {value: 1 GPa}\n", "x.yaml:4:13: constants.hardness" },
        { "name: x\nbase: ofhc_copper\nconstants:\n  hardnes: {value: 1 GPa, source: JC}\n",
          "x.yaml:4:3: unknown constant `hardnes`; did you mean `hardness`" },
        { "base: ofhc_copper\n", "name = ofhc_copper: must be the file's name, x" },
        { "name: x\nbase: round\n", "round.yaml:2:7: base = round: leads back to ./round.yaml" },
        { "name: x\nbase: broken\n", "broken.yaml:3:48: constants.density.source = c: not in" },
    };
    FILE *round = fopen("round.yaml", "w"), *broken = fopen("broken.yaml", "w");
    fputs("name: round\nbase: round\n", round);
    fputs("name: broken\nsources: {a: b}\nconstants: {density: {value: 1 kg/m^3, source: c}}\n", broken);
    fclose(round);
    fclose(broken);
    for (size_t k = 0; k < sizeof bad / sizeof bad[0]; k++) {
        material_sheet sheet;
        char *errors = NULL;
        const status r =
            case_material_sheet_parse(s->u, bad[k].text, strlen(bad[k].text), "x.yaml", dirs, 1, &sheet, &errors);
        assert_int_equal(r.code, STATUS_BAD_INPUT);
        assert_non_null(errors);
        if (!strstr(errors, bad[k].error)) fail_msg("wanted %s\nin %s", bad[k].error, errors);
        free(errors);
    }
}

static void names_cannot_leave_the_folder(void **state)
{
    shelf *s = *state;
    static const char *const bad[] = { "../materials/ofhc_copper", "/etc/passwd", ".hidden", "", "a b" };
    for (size_t k = 0; k < sizeof bad / sizeof bad[0]; k++) {
        material_sheet sheet;
        char *errors = NULL;
        assert_false(case_material_name_valid(bad[k]));
        assert_int_equal(case_material_sheet_find(s->u, bad[k], dirs, 1, &sheet, &errors).code, STATUS_BAD_INPUT);
    }
}

/* The environment's folder comes first; one that is not there is refused. */
static void folders_are_found(void **state)
{
    (void)state;
    material_places found, without;
    setenv("BREECH_MATERIALS", MATERIALS, 1);
    assert_int_equal(case_material_places_find(&found).code, STATUS_OK);
    assert_true(found.n >= 1 && found.n <= MATERIAL_MAX_DIRS);
    assert_string_equal(found.dir[0], MATERIALS);
    setenv("BREECH_MATERIALS", MATERIALS "/nowhere", 1);
    const status none = case_material_places_find(&without);
    assert_int_equal(none.code, STATUS_BAD_INPUT);
    assert_non_null(strstr(none.text, MATERIALS "/nowhere"));
    setenv("BREECH_MATERIALS", "", 1); /* as not given */
    assert_int_equal(case_material_places_find(&without).code, STATUS_OK);
    assert_int_equal(without.n, found.n - 1);
    unsetenv("BREECH_MATERIALS");
}

/* ---- what each is good for ---- */

/* Does a case with these values read, for this command? */
static bool reads(const char *path, unsigned needs, const char *material_set, const char *other_set)
{
    const case_options how = { .material_dirs = dirs, .n_material_dirs = 1, .needs = needs };
    const char *const sets[] = { material_set, other_set };
    breech_case *c = NULL;
    char *errors = NULL;
    const bool done = case_read(path, sets, 2, &how, &c, &errors).code == STATUS_OK;
    free(errors);
    case_free(c);
    return done;
}

/* The cells of a line of the table, by the columns that its head gives. */
static void cells_of(const char *head, const char *line, char cell[3][8])
{
    static const char *const titles[] = { "onset", "fails", "body" };
    for (int k = 0; k < 3; k++) {
        const char *at = strstr(head, titles[k]);
        assert_non_null(at);
        sscanf(line + (at - head), "%7s", cell[k]);
    }
}

/* The table says of every material what a case that names it says; no line is longer than 100 columns. */
static void the_table_says_what_cases_say(void **state)
{
    (void)state;
    const material_places at = { .n = 1, .dir = { MATERIALS } };
    char *text = NULL, *rest = NULL, cell[3][8], set[3][100];
    size_t length = 0;
    FILE *f = open_memstream(&text, &length);
    assert_int_equal(case_materials_print(&at, at.n, f).code, STATUS_OK);
    fclose(f);
    const char *head = strtok_r(text, "\n", &rest);
    int tried = 0, refused = 0;
    /* until the table's second part, where a long name of a law makes two of it, or the text behind it */
    for (char *line;
         (line = strtok_r(NULL, "\n", &rest)) && strncmp(line, "shot ", 5) != 0 && strncmp(line, "material ", 9) != 0;
         tried++) {
        char name[40];
        sscanf(line, "%39s", name);
        cells_of(head, line, cell);
        snprintf(set[0], sizeof set[0], "armature.material=%s", name);
        snprintf(set[1], sizeof set[1], "scene.bodies[0].material=%s", name);
        const char *launch = BREECH_TESTS "/../cases/default_shot", *bodies = BREECH_TESTS "/../cases/ball_gauge";
        const bool onset = reads(launch, CASE_FOR_ONSET, set[0], "scene.damage=yes"),
                   lasting = reads(launch, CASE_FOR_ONSET, set[0], "scene.damage=no"),
                   fails = reads(bodies, CASE_FOR_SCENE, set[1], "scene.bodies[0].damage=yes"),
                   body = reads(bodies, CASE_FOR_SCENE, set[1], "scene.bodies[0].damage=no");
        if (strcmp(cell[0], onset ? "yes" : lasting ? "(yes)" : "-") != 0) fail_msg("%s: onset %s", name, cell[0]);
        if (strcmp(cell[1], fails ? "yes" : "-") != 0) fail_msg("%s: fails %s", name, cell[1]);
        if (strcmp(cell[2], body ? "yes" : "-") != 0) fail_msg("%s: body %s", name, cell[2]);
        refused += !onset;
        assert_true(strlen(line) <= 100);
    }
    assert_true(tried > 20 && refused > 5);
    free(text);
}

/* The listing of a material says where its law of strength is from before it says what it is good for; the table names
 * the law, and none where no constant of it is known. */
static void the_source_of_strength_is_told(void **state)
{
    shelf *s = *state;
    static const char *const of_law[] = { "yield_A", "mts_a0", "ptw_theta", "sg_Y0" };
    const material_places at = { .n = 1, .dir = { MATERIALS } };
    char *table = NULL;
    size_t length = 0;
    int told = 0, advised = 0;
    FILE *f = open_memstream(&table, &length);
    assert_int_equal(case_materials_print(&at, at.n, f).code, STATUS_OK);
    fclose(f);
    assert_non_null(strstr(table, "ofhc_copper_half_hard  mts "));
    assert_non_null(strstr(table, "al7075_t651_limited    johnson_cook "));
    assert_non_null(strstr(table, "cucrzr                 - "));
    assert_non_null(strstr(table, "water                  - (fluid) "));
    for (int k = 0; k < s->n; k++) {
        material_sheet sheet;
        char *errors = NULL, *text = NULL;
        assert_int_equal(case_material_sheet_find(s->u, s->names[k], dirs, 1, &sheet, &errors).code, STATUS_OK);
        if (sheet.take_for[0] && !strstr(table, sheet.take_for)) fail_msg("%s: no advice", s->names[k]);
        advised += sheet.take_for[0] != '\0';
        f = open_memstream(&text, &length);
        case_material_print(&sheet, f);
        fclose(f);
        for (int i = 0; i < sheet.n; i++)
            for (size_t j = 0; j < sizeof of_law / sizeof of_law[0]; j++) {
                if (strcmp(sheet.constant[i].constant->key, of_law[j]) != 0) continue;
                char line[1200];
                snprintf(line, sizeof line, "    source: %s\n", sheet.constant[i].source);
                const char *found = strstr(text, line), *behind = strstr(text, "\ngood for:");
                if (!found || found > behind) fail_msg("%s: %s", s->names[k], line);
                if (strstr(found + 1, line)) fail_msg("%s: told twice: %s", s->names[k], line);
                told++;
            }
        free(text);
        case_material_sheet_free(&sheet);
    }
    assert_true(told > 15 && advised > 2);
    free(table);
}

/* What no source gives is not assumed: the refusal names the material and the constants. */
static void strength_without_a_source_is_refused(void **state)
{
    (void)state;
    static const char *const without[] = { "brass_c26000", "cucrzr",     "glidcop_al25",
                                           "molybdenum",   "steel_1080", "vascomax_300" };
    for (size_t k = 0; k < sizeof without / sizeof without[0]; k++) {
        const case_options how = { .material_dirs = dirs, .n_material_dirs = 1, .needs = CASE_FOR_ONSET };
        char set[100], says[160];
        breech_case *c = NULL;
        char *errors = NULL;
        snprintf(set, sizeof set, "armature.material=%s", without[k]);
        snprintf(says, sizeof says, "material %s lacks what this study needs: ", without[k]);
        const char *const sets[] = { set, "scene.damage=no" };
        assert_int_equal(case_read(BREECH_TESTS "/../cases/default_shot", sets, 2, &how, &c, &errors).code,
                         STATUS_BAD_INPUT);
        assert_non_null(errors);
        if (!strstr(errors, says)) print_error("wanted %s\nin %s", says, errors);
        assert_non_null(strstr(errors, says));
        assert_non_null(strstr(errors, "yield_A"));
        free(errors);
        case_free(c);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_file_reads_and_has_sources),
        cmocka_unit_test(unchecked_constants_are_weak),
        cmocka_unit_test(the_papers_sets_are_kept),
        cmocka_unit_test(bad_files_say_where),
        cmocka_unit_test(a_material_changes_its_base),
        cmocka_unit_test(errors_of_bases_have_their_place),
        cmocka_unit_test(names_cannot_leave_the_folder),
        cmocka_unit_test(folders_are_found),
        cmocka_unit_test(the_laws_are_read),
        cmocka_unit_test(the_table_says_what_cases_say),
        cmocka_unit_test(the_source_of_strength_is_told),
        cmocka_unit_test(strength_without_a_source_is_refused),
    };
    return cmocka_run_group_tests(tests, open_shelf, close_shelf);
}
