/* SPDX-License-Identifier: BSD-3-Clause */
/* Case files: what is read, with which units; all errors at once and where; --set; used.yaml; the manual's key list. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "coupling/case/case.h"
#include "coupling/case/case_errors.h"
#include "coupling/case/case_plain.h"
#include "coupling/case/case_schema.h"
#include "coupling/host/units.h"

#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "manual_common.h"

#define SMALL_CASE BREECH_TESTS "/data/case_small.yaml"

static const char *const material_dirs[] = { BREECH_TESTS "/../cases/materials" };

static case_options options_for(unsigned needs)
{
    return (case_options){ .material_dirs = material_dirs, .n_material_dirs = 1, .needs = needs };
}

static char *read_file(const char *path)
{
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    char *text = calloc(1, 200000);
    assert_non_null(text);
    assert_true(fread(text, 1, 199999, file) > 0);
    fclose(file);
    return text;
}

/* The small case, which must read, with the sets given. */
static breech_case *small_case(const char *const *sets, int n)
{
    breech_case *c = NULL;
    char *errors = NULL;
    const case_options o = options_for(CASE_FOR_SHOT | CASE_FOR_SCENE | CASE_FOR_ONSET);
    const status s = case_read(SMALL_CASE, sets, n, &o, &c, &errors);
    if (errors) print_error("%s", errors);
    assert_int_equal(s.code, STATUS_OK);
    assert_null(errors);
    return c;
}

/* The errors of a text, which must have some.  Caller frees. */
static char *errors_of(const char *text, const char *const *sets, int n, unsigned needs)
{
    breech_case *c = NULL;
    char *errors = NULL;
    const case_options o = options_for(needs);
    const status s = case_read_memory(&(case_text){ text, strlen(text), "case.yaml", sets, n }, &o, &c, &errors);
    assert_int_equal(s.code, STATUS_BAD_INPUT);
    assert_null(c);
    assert_non_null(errors);
    return errors;
}

static const circuit_shot_module *bank_of(const breech_case *c)
{
    return c->supplies[CIRCUIT_SUPPLY_capacitor].item;
}

static void has_line(const char *errors, const char *line)
{
    const char *at = strstr(errors, line);
    if (!at) print_error("wanted: %s\nin:\n%s", line, errors);
    assert_non_null(at);
    assert_true(at == errors || at[-1] == '\n');
}

static int lines_of(const char *errors)
{
    int n = 0;
    for (; *errors; errors++) n += *errors == '\n';
    return n;
}

/* ---- what is read ---- */

/* "18 mm" must be the very bits of 0.018: scenes are keyed by their inputs. */
static void values_are_si(void **state)
{
    (void)state;
    breech_case *c = small_case(NULL, 0);
    assert_string_equal(c->name, "small");
    assert_int_equal(c->supplies[CIRCUIT_SUPPLY_capacitor].n, 2);
    assert_int_equal(bank_of(c)[0].count, 4);
    assert_true(bank_of(c)[0].capacitance == 3.594e-3);
    assert_true(bank_of(c)[0].inductance == 12.56e-6);
    assert_true(bank_of(c)[1].fire_at == 0.4e-3);
    assert_true(c->rails.initial_temperature == 293.15);
    assert_int_equal(c->rails.level, CIRCUIT_SHOT_RAILS_CONSTANT);
    assert_true(c->armature.friction_melted == 0.05);
    assert_true(c->options.rtol == 1e-7);
    assert_int_equal(c->rail.layers.n, 1);
    assert_true(c->rail.layers.item[0].thickness == 200e-6);
    assert_true(c->rail.layers.item[0].bond_strength == 80e6);
    assert_true(fabs(c->projectile.lead_angle - 0.52359877559829887) < 1e-14); /* 30 deg, to the 15 digits kept */
    assert_true(c->scene.rail_ahead == 0.018);
    assert_false(c->scene.damage);
    assert_true(c->output.history_interval == 5e-6);
    assert_true(c->study.velocity_high == 2000.0); /* the default */
    assert_true(c->given.output && c->given.options);
    case_free(c);
}

static void sites_take_what_they_leave_out(void **state)
{
    (void)state;
    breech_case *c = small_case(NULL, 0);
    const case_site *s = c->sites.item;
    assert_int_equal(c->sites.n, 3);
    assert_true(s[0].radius == 0.5e-3 && s[0].height == 0.5e-3 && s[0].bond_strength == 50e6);
    assert_string_equal(s[0].shape, "hemisphere");
    assert_string_equal(s[0].material, "ofhc_copper"); /* the rail's: the particle names none */
    assert_true(s[1].position == 1.6 && s[1].radius == 0.2e-3 && s[1].height == 0.2e-3);
    assert_string_equal(s[1].shape, "cone");
    assert_true(isnan(s[1].bond_strength)); /* `none` is a choice, not an omission */
    assert_true(s[2].height == 0.3e-3 && s[2].radius == 0.5e-3);
    assert_string_equal(s[2].material, "al7075_t651");
    case_free(c);
}

static void materials_are_loaded(void **state)
{
    (void)state;
    breech_case *c = small_case(NULL, 0);
    assert_int_equal(c->materials.n, 2);
    const mpm_material *copper = case_material(&c->materials, "ofhc_copper");
    assert_non_null(copper);
    assert_true(copper->density == 8960.0 && copper->yield_A == 90e6);
    assert_true(isnan(copper->spall_strength)); /* a blank constant stays unknown */
    assert_null(case_material(&c->materials, "unobtainium"));
    assert_non_null(strstr(c->warnings, "material ofhc_copper: from secondary or unchecked sources"));
    case_free(c);
}

static void missing_sections_hold_defaults(void **state)
{
    (void)state;
    breech_case *c = NULL;
    char *errors = NULL;
    const char text[] = "name: bare\n";
    const case_options o = options_for(0);
    assert_int_equal(case_read_memory(&(case_text){ text, strlen(text), "case.yaml", NULL, 0 }, &o, &c, &errors).code,
                     STATUS_OK);
    assert_int_equal(c->supplies[CIRCUIT_SUPPLY_capacitor].n, 0);
    assert_true(c->scene.courant == 0.4);
    assert_true(isnan(c->rails.height));
    assert_false(c->given.scene);
    case_free(c);
}

/* ---- errors ---- */

static void all_errors_at_once(void **state)
{
    (void)state;
    const char text[] =
        "name: bad\n"
        "bank:\n"
        "  capacitance: -5 mF\n"
        "  charge: 9\n"
        "  inductence: 3 uH\n"
        "rail: {height: 25 mm, thickness: 20 kV, separation: 25 mmm, level: skim, material: ofhc_coper, temperature: "
        "5000 degC}\n"
        "armature: {leadangle: 30 deg, material: al7075_t651, head_thickness: 10 mm}\n"
        "scene: {friction: 0.2 mm, velocity: 20 km/s, damage: maybe, particles_per_axis: 2.5}\n"
        "sites: [{position: 3 m, shape: hemisfere}, text]\n"
        "velocity: 3 m/s\n";
    char *e = errors_of(text, NULL, 0, 0);
    has_line(e, "case.yaml:3:16: bank.capacitance = -5 mF: must be positive (1 pF .. 1 kF)\n");
    has_line(e, "case.yaml:4:11: bank.charge = 9: needs a unit, such as `9 V` (0 V .. 1 MV)\n");
    has_line(e, "case.yaml:5:3: unknown key `inductence` in bank; did you mean `inductance`?\n");
    has_line(e, "case.yaml:6:34: rail.thickness = 20 kV: `kV` is not a unit of m (100 um .. 10 m)\n");
    has_line(e, "case.yaml:6:53: rail.separation = 25 mmm: `mmm` is not a known unit");
    has_line(e, "case.yaml:6:68: rail.level = skim: must be one of constant, skin, diffusing; did you mean `skin`?\n");
    has_line(e, "case.yaml:7:12: unknown key `leadangle` in armature; did you mean `lead_angle`?\n");
    has_line(e, "case.yaml:7:11: armature.leg_thickness is missing [m]");
    has_line(e, "case.yaml:7:11: armature.chamfer_height is missing [m]");
    has_line(e, "case.yaml:8:19: scene.friction = 0.2 mm: is a pure number");
    has_line(e, "case.yaml:8:37: scene.velocity = 20 km/s: must lie within the range (0.001 km/s .. 10 km/s)\n");
    has_line(e, "case.yaml:8:54: scene.damage = maybe: must be yes or no\n");
    has_line(e, "case.yaml:8:81: scene.particles_per_axis = 2.5: must be a whole number (2 .. 3)\n");
    has_line(e, "case.yaml:6:84: rail.material = ofhc_coper: no material of this name in ");
    has_line(
        e, "case.yaml:6:109: rail.temperature = 5000 degC: must lie within the range (-269.15 degC .. 1726.85 degC)\n");
    has_line(e, "case.yaml:9:32: sites[0].shape = hemisfere: must be one of ");
    has_line(e, "case.yaml:9:44: sites[1] must be a section");
    has_line(e, "case.yaml:10:1: unknown key `velocity`; `armature` has one\n");
    assert_null(strstr(e, "lead_angle is missing")); /* a mistyped key is one error, not two */
    free(e);
    e = errors_of("name: cold\nrail: {temperature: -300 degC}\n", NULL, 0, 0); /* not for its sign */
    has_line(e, "case.yaml:2:21: rail.temperature = -300 degC: must lie within the range (-269.15 degC .. ");
    free(e);
}

/* Also keys of a scene whose bodies stand at the wrong place. */
static void a_key_finds_its_home(void **state)
{
    (void)state;
    char *e = errors_of("bodies: []\nscene: {cell: 1 mm, box: 1 mm, body_force: 1 m/s2}\n", NULL, 0, 0);
    has_line(e, "case.yaml:1:1: unknown key `bodies`; `scene` has one\n");
    has_line(e, "case.yaml:2:9: unknown key `cell` in scene; `scene with bodies` has one\n");
    has_line(e, "case.yaml:2:21: unknown key `box` in scene; known are ");
    has_line(e, "case.yaml:2:32: unknown key `body_force` in scene; `scene.bodies` has one\n");
    free(e);
}

/* A limit in another unit is within, whatever the rounding of the conversion; what is really beyond is not. */
static void limits_hold_in_any_unit(void **state)
{
    (void)state;
    char *e = errors_of("name: a\narmature: {lead_angle: 90 deg}\n", NULL, 0, 0);
    assert_null(strstr(e, "within the range"));
    free(e);
    e = errors_of("name: a\narmature: {lead_angle: 90.0001 deg}\n", NULL, 0, 0);
    assert_non_null(strstr(e, "within the range"));
    free(e);
}

static void errors_are_sorted_and_limited(void **state)
{
    (void)state;
    char *text = calloc(1, 100000), *end = text;
    assert_non_null(text);
    end += sprintf(end, "name: many\nsites:\n");
    for (int k = 0; k < 2 * CASE_MAX_ERRORS; k++) end += sprintf(end, "  - {position: 5, radius: 1 mm}\n");
    char *e = errors_of(text, NULL, 0, 0);
    assert_int_equal(lines_of(e), CASE_MAX_ERRORS + 1);
    has_line(e, "case.yaml:3:16: sites[0].position = 5: needs a unit");
    has_line(e, "... and 200 more\n");
    int last = 0;
    for (const char *line = e; strncmp(line, "...", 3) != 0; line = strchr(line, '\n') + 1) {
        const int now = atoi(line + strlen("case.yaml:"));
        assert_true(now >= last);
        last = now;
    }
    free(e);
    free(text);
}

typedef struct {
    const char *text, *error;
} bad_text;

/* Whatever is wrong with the YAML itself has its place too. */
static void yaml_errors_have_a_place(void **state)
{
    (void)state;
    static const bad_text bad[] = {
        { "name: a\nname: b\n", "case.yaml:2:1: key `name` stands twice in one section; first in line 1" },
        { "name: &x a\n", "case.yaml:1:7: anchors (&name) are not used" },
        { "name: *x\n", "case.yaml:1:7: aliases (*name) are not used" },
        { "name: !!str a\n", "case.yaml:1:7: tags (!name) are not used" },
        { "name: a\n---\nname: b\n", "case.yaml:2:1: a second document" },
        { "name: [a\n",
          "case.yaml:2:1: not valid YAML: did not find expected ',' or ']' while parsing a flow sequence: "
          "a bracket is not closed, or a text with brackets or commas in it lacks its quotes" },
        { "rail:\n\theight: 1 mm\n", "case.yaml:2:1: not valid YAML: found character that cannot start any token while "
                                     "scanning for the next token: a tab; lines are indented with blanks alone" },
        { "rail:\n  height: 1 mm\n level: skin\n",
          "case.yaml:3:2: not valid YAML: did not find expected key while parsing a block mapping: this line does not "
          "begin below the others of its section" },
        { "rail:\n  height\n  level: skin\n",
          "case.yaml:3:8: not valid YAML: mapping values are not allowed in this context: it begins further right than "
          "the others of its section, the line above lacks its `:`, or" },
        { "bank:\n  - {count: 1}\n  count: 2\n", "case.yaml:3:3: not valid YAML: did not find expected '-' indicator "
                                                 "while parsing a block collection: entries "
                                                 "of a list begin with `- `, one below the other" },
        { "name: \"a\\0b\"\n", "case.yaml:1:7: a control character" },
        { "- a\n- b\n", "case.yaml:1:1: case.yaml is no case" },
        { "a: [[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[1]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]\n",
          "case.yaml:1:44: sections nested more than" },
        { "\n", "case.yaml:2:1: the file is empty" },
        { "[a]: b\n", "case.yaml:1:1: a key must be a plain word" },
        { "name: \xff\n", "case.yaml:1:7: not valid YAML" },
        { "title: x\n", "case.yaml:1:1: name is missing" },
        { "name:\n", "case.yaml:1:6: name has no value" },
    };
    for (size_t k = 0; k < sizeof bad / sizeof bad[0]; k++) {
        char *e = errors_of(bad[k].text, NULL, 0, 0);
        has_line(e, bad[k].error);
        free(e);
    }
}

static void commands_say_what_they_need(void **state)
{
    (void)state;
    char *e = errors_of("name: a\n", NULL, 0, CASE_FOR_ONSET);
    has_line(e, "case.yaml:1:1: section `bank` is missing: `breech onset` needs it, or another supply\n");
    has_line(e, "case.yaml:1:1: section `sites` is missing: `breech onset` needs it, or `populations`\n");
    assert_null(strstr(e, "study")); /* all of it has defaults */
    free(e);
    e = errors_of("name: a\nscene: {friction: 0.1}\nparticle: {shape: cone}\nrail: {material: cucrzr}\n", NULL, 0,
                  CASE_FOR_SCENE);
    has_line(e, "case.yaml:2:8: scene.velocity is missing [m/s]: `breech scene` needs it\n");
    has_line(e, "case.yaml:3:11: particle.radius is missing [m]: `breech scene` needs it\n");
    has_line(e, "case.yaml:4:18: rail.material = cucrzr: material cucrzr lacks");
    assert_non_null(strstr(e, "yield_A"));
    free(e);
}

static void what_must_fit_is_checked(void **state)
{
    (void)state;
    const char *sets[] = { "sites[1].position=5 m",
                           "armature.leg_thickness=20 mm",
                           "study.velocity_low=3 km/s",
                           "particle.height=20 mm",
                           "scene.coarse_cell=0.1 mm",
                           "armature.contact_length=5 m",
                           "populations=[{density: 3 1/m, sizes: [{radius: 1 mm, share: 1}], radius_spread: 0.5}]" };
    char *text = read_file(SMALL_CASE), *e = errors_of(text, sets, 7, 0);
    has_line(e, "--set sites[1].position=5 m: sites[1].position = 5 m: must lie beyond barrel.start = 0.1 m");
    has_line(e, "--set armature.leg_thickness=20 mm: armature.leg_thickness = 20 mm: must not exceed half_bore\n");
    has_line(e, "--set study.velocity_low=3 km/s: study.velocity_low = 3 km/s: must lie below velocity_high\n");
    has_line(e, "--set armature.contact_length=5 m: armature.contact_length = 5 m: must be shorter than the barrel\n");
    assert_non_null(strstr(e, "populations[0]: either radius_median and radius_spread, or sizes\n"));
    has_line(e, "--set particle.height=20 mm: particle.height = 20 mm: must not exceed armature.half_bore\n");
    has_line(e, "--set scene.coarse_cell=0.1 mm: scene.coarse_cell = 0.1 mm: must not be smaller than the fine cell");
    free(e);
    free(text);
}

static void gases_are_no_rails(void **state)
{
    (void)state;
    const char *sets[] = { "rail.material=air", "armature.material=air", "particle.material=air" };
    char *text = read_file(SMALL_CASE), *e = errors_of(text, sets, 3, CASE_FOR_SCENE);
    has_line(e,
             "--set rail.material=air: rail.material = air: a gas: rail, armature and grain must be solid or liquid");
    has_line(e, "--set armature.material=air: armature.material = air: a gas: ");
    has_line(e, "--set particle.material=air: particle.material = air: a gas: ");
    free(e);
    free(text);
}

/* ---- --set ---- */

static void set_reaches_every_place(void **state)
{
    (void)state;
    const char *sets[] = { "bank.charge=8 kV",       "bank[1].charge=7 kV",          "scene.friction=30 %",
                           "sites[2].radius=0.1 mm", "rail.temperature=400 K",       "output.report=no",
                           "options.max_time=20 ms", "rail.layers.thickness=0.1 mm", "title= a: b # c ",
                           "study.feedback=no" };
    breech_case *c = small_case(sets, 10);
    assert_true(bank_of(c)[0].charge == 8000.0 && bank_of(c)[1].charge == 7000.0);
    assert_true(c->scene.friction == 0.3);
    assert_true(c->sites.item[2].radius == 0.1e-3 && c->sites.item[0].radius == 0.5e-3);
    assert_true(c->rail.temperature == 400.0);
    assert_false(c->output.report);
    assert_true(c->options.max_time == 0.02);
    assert_true(c->rail.layers.item[0].thickness == 1e-4);
    assert_string_equal(c->title, "a: b # c");
    assert_false(c->study.feedback);
    case_free(c);
}

static void set_can_give_a_whole_list(void **state)
{
    (void)state;
    const char *sets[] = { "sites=[{position: 1 m}, {position: 2 m, radius: 1 mm}]", "rail.layers=[]" };
    breech_case *c = small_case(sets, 2);
    assert_int_equal(c->sites.n, 2);
    assert_true(c->sites.item[1].radius == 1e-3 && c->sites.item[0].radius == 0.5e-3);
    assert_int_equal(c->rail.layers.n, 0);
    case_free(c);
}

static void set_errors_name_the_set(void **state)
{
    (void)state;
    const char *sets[] = { "bank.charg=3",     "rail.height=2 kV",   "bank[2].charge=3 V",
                           "name.x=3",         "scene=[1,{",         "=3",
                           "bank[x].charge=3", "study.max_scenes=0", "nothing",
                           "bank.charge=9",    "banc[0].charge=3" };
    char *text = read_file(SMALL_CASE), *e = errors_of(text, sets, sizeof sets / sizeof *sets, 0);
    has_line(e, "--set bank.charg=3: unknown key `charg` in bank[0]; did you mean `charge`?\n");
    has_line(e, "--set rail.height=2 kV: rail.height = 2 kV: `kV` is not a unit of m (100 um .. 10 m)\n");
    has_line(e, "--set bank[2].charge=3 V: bank has 2 entries: bank[0] .. bank[1]\n");
    has_line(e, "--set banc[0].charge=3: banc has no entries; did you mean `bank`?\n");
    has_line(e, "--set name.x=3: x is not inside a section");
    has_line(e, "--set scene=[1,{: not valid YAML");
    has_line(e, "--set =3: wanted path.to.key=value");
    has_line(e, "--set bank[x].charge=3: wanted a number from 0 in bank[...]");
    has_line(e, "--set study.max_scenes=0: study.max_scenes = 0: must be positive (1 .. 100000)\n");
    has_line(e, "--set nothing: wanted path.to.key=value");
    has_line(e, "--set bank.charge=9: bank[0].charge = 9: needs a unit, such as `9 V` (0 V .. 1 MV)\n");
    assert_int_equal(lines_of(e), 11); /* one line a set, however many entries it reaches */
    free(e);
    free(text);
}

/* A value is shown as it is written, and cut where it is long. */
static void long_values_are_cut(void **state)
{
    (void)state;
    char text[400], line[200], tail[201] = "";
    memset(tail, 'x', sizeof tail - 1);
    snprintf(text, sizeof text, "name: a\nrail: {material: ofhc_copper, temperature: 3 %s}\n", tail);
    snprintf(line, sizeof line, "case.yaml:2:44: rail.temperature = 3 %.58s...: its unit", tail);
    char *e = errors_of(text, NULL, 0, 0);
    has_line(e, line);
    free(e);
}

/* ---- a case that builds on another ---- */

static void write_file(const char *path, const char *text)
{
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs(text, file);
    assert_int_equal(fclose(file), 0);
}

/* below/case.yaml <- middle.yaml <- top.yaml, each with its changes. */
static void write_chain(void)
{
    mkdir("below", 0777);
    mkdir("below/far", 0777);
    write_file("below/case.yaml",
               "name: below\ntitle: from below\n"
               "bank: [{capacitance: 3 mF, charge: 10 kV, inductance: 12 uH}]\n"
               "rail: {height: 25 mm, thickness: 20 mm, separation: 30 mm, face_crown: 1 mm}\n"
               "sites: [{position: 1 m}, {position: 2 m}]\nparticle: {radius: 0.5 mm, bond_strength: 50 MPa}\n"
               "output: {snapshots: 3}\n"
               "current_profiles: {file: far/current.csv}\n");
    write_file("below/far/current.csv", "0,0\n1e-3,5e5\n2e-3,0\n");
    write_file("middle.yaml", "base: below\nname: middle\nrail: {thickness: 10 mm, face_crown: ~}\noutput:\n");
    write_file("top.yaml",
               "base: ./middle.yaml\nname: top\nsites: [{position: 3 m}]\nparticle: {bond_strength: none}\n");
}

static breech_case *read_path(const char *path, const char *const *sets, int n, char **errors)
{
    breech_case *c = NULL;
    const case_options o = options_for(0);
    const status s = case_read(path, sets, n, &o, &c, errors);
    assert_true((s.code == STATUS_OK) == (c != NULL));
    return c;
}

/* Maps merge key by key, lists and values replace, ~ takes out, `none` is a value; paths belong to their file. */
static void a_base_is_changed(void **state)
{
    (void)state;
    write_chain();
    char *errors = NULL;
    breech_case *c = read_path("top.yaml", (const char *const[]){ "rail.height=26 mm" }, 1, &errors);
    if (errors) print_error("%s", errors);
    assert_non_null(c);
    assert_string_equal(c->name, "top");
    assert_string_equal(c->title, "from below");
    assert_true(c->rails.height == 0.026 && c->rails.thickness == 0.01 && c->rails.separation == 0.03);
    assert_true(c->rails.face_crown == 0.0); /* taken out: the default */
    assert_false(c->given.output);           /* the whole section too */
    assert_int_equal(c->output.snapshots, 20);
    assert_int_equal(c->sites.n, 1);
    assert_true(c->sites.item[0].position == 3.0 && c->sites.item[0].radius == 0.5e-3);
    assert_true(isnan(c->particle.bond_strength));
    assert_true(bank_of(c)->charge == 10e3);
    assert_int_equal(((const circuit_supply_profile *)c->supplies[CIRCUIT_SUPPLY_profile].item)->points.n, 3);
    case_free(c);
}

/* A base that two materials of the case have: its error once, and each of the two by its key. */
static void errors_of_a_shared_base_are_told_once(void **state)
{
    (void)state;
    write_file("own_base.yaml", "name: own_base\nsources: {a: b}\n"
                                "constants: {density: {value: -1 kg/m^3, source: a}}\n");
    write_file("own_one.yaml", "name: own_one\nbase: own_base\n");
    write_file("own_two.yaml", "name: own_two\nbase: own_base\n");
    char *e =
        errors_of("name: a\nrail: {material: own_one}\nparticle: {radius: 1 mm, material: own_two}\n", NULL, 0, 0);
    has_line(e, "./own_base.yaml:3:30: constants.density.value = -1 kg/m^3: must be positive");
    has_line(e, "case.yaml:2:18: rail.material = own_one: its file has errors\n");
    has_line(e, "case.yaml:3:36: particle.material = own_two: its file has errors\n");
    assert_int_equal(lines_of(e), 3);
    free(e);
}

/* `base` is a key of the case, though no section's; it is the file's alone. */
static void base_is_a_known_key(void **state)
{
    (void)state;
    const char *sets[] = { "base=cases/default_shot" };
    char *e = errors_of("bse: below\nname: a\n", NULL, 0, 0);
    has_line(e, "case.yaml:1:1: unknown key `bse`; did you mean `base`?\n");
    free(e);
    e = errors_of("zzzzzz: below\nname: a\n", NULL, 0, 0);
    has_line(e, "case.yaml:1:1: unknown key `zzzzzz`; known are base, name, title, bank");
    free(e);
    e = errors_of("name: a\n", sets, 1, 0);
    has_line(e, "--set base=cases/default_shot: base is a line of the case's file");
    free(e);
}

/* An error stands where the fault is, in whatever file of the chain. */
static void errors_name_the_file_of_the_chain(void **state)
{
    (void)state;
    write_chain();
    write_file("wrong.yaml", "base: below\nname: wrong\nrail: {heigth: 3 mm, thickness: 20 kV}\n");
    char *errors = NULL;
    assert_null(read_path("wrong.yaml", NULL, 0, &errors));
    has_line(errors, "wrong.yaml:3:8: unknown key `heigth` in rail; did you mean `height`?\n");
    has_line(errors, "wrong.yaml:3:33: rail.thickness = 20 kV: `kV` is not a unit of m (100 um .. 10 m)\n");
    free(errors);
    write_file("below/case.yaml", "name: below\nparticle: {radius: 3 kg}\nrail: {height: 25 mm}\n");
    assert_null(read_path("top.yaml", NULL, 0, &errors));
    has_line(errors, "below/case.yaml:2:20: particle.radius = 3 kg: `kg` is not a unit of m (1 um .. 100 mm)\n");
    has_line(errors, "./middle.yaml:3:7: rail.separation is missing [m]");
    free(errors);
    write_file("below/case.yaml", "name: [below\n");
    assert_null(read_path("top.yaml", NULL, 0, &errors));
    has_line(errors, "below/case.yaml:2:1: not valid YAML");
    assert_int_equal(lines_of(errors), 1); /* nothing else can be said */
    free(errors);
}

static void chains_end(void **state)
{
    (void)state;
    char *errors = NULL, name[20], text[60];
    write_file("one.yaml", "name: one\nbase: two.yaml\n");
    write_file("two.yaml", "base: ./one.yaml\nname: two\n");
    assert_null(read_path("one.yaml", NULL, 0, &errors));
    has_line(errors, "two.yaml:1:7: base = ./one.yaml: leads back to one.yaml, which builds on this file\n");
    free(errors);
    for (int k = 0; k < CASE_MAX_FILES; k++) {
        snprintf(name, sizeof name, "chain%d.yaml", k);
        snprintf(text, sizeof text, "name: n%d\nbase: chain%d.yaml\n", k, k + 1);
        write_file(name, text);
    }
    write_file("chain9.yaml", "title: the end\n");
    breech_case *c = read_path("chain1.yaml", NULL, 0, &errors);
    assert_non_null(c);
    assert_string_equal(c->title, "the end");
    case_free(c);
    assert_null(read_path("chain0.yaml", NULL, 0, &errors));
    has_line(errors, "chain8.yaml:2:7: base = chain9.yaml: a chain of more than 8 bases\n");
    free(errors);
    write_file("none.yaml", "name: none\nbase: nowhere\n");
    assert_null(read_path("none.yaml", NULL, 0, &errors));
    has_line(errors, "none.yaml:2:7: base = nowhere: there is no such case; those that came with the program are in ");
    free(errors);
}

/* ---- one entry for several groups ---- */

static void lists_of_values_are_groups(void **state)
{
    (void)state;
    const char *sets[] = { "bank=[{capacitance: 3 mF, charge: 10 kV, inductance: 12 uH, count: [3, 1, 1],"
                           " fire_at: [0 ms, 0.5 ms, never]}, {capacitance: 1 mF, charge: 9 kV, inductance: 1 uH}]",
                           "bank[1].charge=8 kV" };
    breech_case *c = small_case(sets, 2);
    const circuit_shot_module *m = bank_of(c);
    assert_int_equal(c->supplies[CIRCUIT_SUPPLY_capacitor].n, 4);
    for (int k = 0; k < 3; k++) assert_true(m[k].capacitance == 3e-3 && m[k].count == (k == 0 ? 3 : 1));
    assert_true(m[0].fire_at == 0.0 && m[1].fire_at == 0.5e-3 && isinf(m[2].fire_at));
    assert_true(m[3].charge == 8e3 && m[3].fire_at == 0.0); /* --set counts the entries of the file */
    case_free(c);
    char *e = errors_of(
        "name: a\nbank: {capacitance: -3 mF, charge: [], inductance: [1 uH, 2 kV], fire_at: [1 s, 2 s, 3 s]}\n"
        "sites: {position: [1 m, 2 m], radius: 1 mm}\n",
        NULL, 0, 0);
    has_line(e, "case.yaml:2:36: bank.charge: 0 values where 1 are wanted");
    free(e);
    e = errors_of(
        "name: a\nbank: {capacitance: -3 mF, charge: 1 kV, inductance: [1 uH, 2 kV], fire_at: [1 s, 2 s, 3 s]}\n"
        "sites: {position: [1 m, 2 m], radius: 1 mm}\n",
        NULL, 0, 0);
    has_line(e, "case.yaml:2:21: bank.capacitance = -3 mF: must be positive");
    has_line(e, "case.yaml:2:61: bank.inductance[1] = 2 kV: `kV` is not a unit of H (0 H .. 1 H)\n");
    has_line(e, "case.yaml:2:77: bank.fire_at: 3 values where 2 are wanted");
    has_line(e, "case.yaml:3:19: sites.position: must be one value, not a list (0 m .. 1 km)\n");
    assert_int_equal(lines_of(e), 4); /* what two groups share is said once */
    free(e);
}

/* ---- one section for circuit and scene ---- */

#define BOTH                                                                                                          \
    "name: a\nrail: {height: 20 mm, thickness: 10 mm, separation: 18 mm, material: steel_4340, temperature: 400 K}\n" \
    "armature: {mass: 1 kg, material: al6061_t6, lead_angle: 45 deg, length: 20 mm, leg_thickness: 5 mm,\n"           \
    "  head_thickness: 10 mm, chamfer_height: 2 mm"

static breech_case *read_text(const char *text)
{
    breech_case *c = NULL;
    char *errors = NULL;
    const case_options o = options_for(0);
    const status s = case_read_memory(&(case_text){ text, strlen(text), "case.yaml", NULL, 0 }, &o, &c, &errors);
    if (errors) print_error("%s", errors);
    assert_int_equal(s.code, STATUS_OK);
    return c;
}

/* What the geometry and the metals say need not be said again, and may be. */
static void what_follows_is_not_asked_for(void **state)
{
    (void)state;
    breech_case *c = read_text(BOTH "}\n");
    const mpm_material *steel = case_material(&c->materials, "steel_4340");
    const mpm_material *alloy = case_material(&c->materials, "al6061_t6");
    assert_true(c->projectile.half_bore == 0.009 && c->projectile.width == 0.02);
    assert_true(fabs(c->armature.contact_length - 0.018) < 1e-15); /* 20 mm less a face of 2 mm at 45 deg */
    assert_true(c->armature.contact_width == 0.02);
    assert_true(isnan(c->armature.wear_thickness)); /* nothing wears */
    assert_true(c->rails.resistivity == steel->resistivity && c->rails.density == steel->density);
    assert_true(c->rails.resistivity_coefficient == 3.93e-3); /* the metal's is not known */
    assert_true(c->rails.heat_capacity == c->rails.density * c->rails.specific_heat && c->rails.density < 8000.0);
    assert_true(c->armature.melting_temperature == alloy->melting_temperature);
    assert_true(c->rails.initial_temperature == 400.0 && c->armature.initial_temperature == 293.15);
    case_free(c);
    c = read_text(BOTH
                  ", half_bore: 8 mm, width: 19 mm, contact_length: 7 mm, contact_width: 6 mm, wear_fraction: 0.1,\n"
                  "  density: 3000 kg/m^3}\n");
    assert_true(c->projectile.half_bore == 0.008 && c->projectile.width == 0.019);
    assert_true(c->armature.contact_length == 0.007 && c->armature.contact_width == 0.006);
    assert_true(c->armature.wear_thickness == 0.005 && c->armature.density == 3000.0);
    case_free(c);
}

/* The heat capacity of a volume follows density and specific heat, however they are known; copper's keeps its own. */
static void heat_capacity_follows(void **state)
{
    (void)state;
    const struct {
        const char *rail;
        double want;
    } cases[] = { { "", 3.45e6 },
                  { ", material: ofhc_copper, specific_heat: 385 J/kg/K", 3.45e6 },
                  { ", density: 19300 kg/m^3, specific_heat: 134 J/kg/K", 19300.0 * 134.0 },
                  { ", density: 8000 kg/m^3", 8000.0 * 385.0 },
                  { ", density: 19300 kg/m^3, heat_capacity: 3 MJ/m^3/K", 3e6 } };
    for (int k = 0; k < 5; k++) {
        char text[300];
        snprintf(text, sizeof text, "name: a\nrail: {height: 20 mm, thickness: 10 mm, separation: 18 mm%s}\n",
                 cases[k].rail);
        breech_case *c = read_text(text);
        assert_true(c->rails.heat_capacity == cases[k].want);
        case_free(c);
    }
}

/* Neither half of a section, the circuit's and the scene's, needs the other; a command says what is missing. */
static void halves_of_a_section(void **state)
{
    (void)state;
    breech_case *c =
        read_text("name: a\nrail: {height: 20 mm, thickness: 10 mm, separation: 18 mm}\narmature: {mass: 1 kg}\n");
    assert_true(c->given.rails && !c->given.rail && c->given.armature && !c->given.projectile);
    case_free(c);
    c = read_text("name: a\nrail: {material: ofhc_copper}\n");
    assert_true(!c->given.rails && c->given.rail);
    case_free(c);
    char *e = errors_of("name: a\nrail: {material: ofhc_copper}\n", NULL, 0, CASE_FOR_INDUCTANCE);
    has_line(e, "case.yaml:2:7: rail.height is missing [m]");
    free(e);
    /* an armature's metal, which the circuit takes too, asks for no body; one of its lengths does, and a scene */
    c = read_text("name: a\narmature: {mass: 1 kg, material: ofhc_copper}\n");
    assert_true(c->given.armature && !case_has_body(c) && c->armature.density == 8960.0);
    case_free(c);
    e = errors_of("name: a\narmature: {mass: 1 kg, material: ofhc_copper, length: 20 mm}\n", NULL, 0, 0);
    has_line(e, "case.yaml:2:11: armature.lead_angle is missing [rad]");
    free(e);
    e = errors_of("name: a\narmature: {mass: 1 kg, material: ofhc_copper}\n", NULL, 0, CASE_FOR_SCENE);
    has_line(e, "case.yaml:2:11: armature.length is missing [m]");
    free(e);
}

/* Every member of every table, by the tables: equal bits, NAN equal to NAN. */
static void same_objects(const case_section *section, const void *a, const void *b)
{
    for (const base_param *p = section->table; p->key; p++) {
        const char *x = (const char *)a + p->offset, *y = (const char *)b + p->offset;
        if (p->kind == BASE_PARAM_TEXT) assert_string_equal(x, y);
        if (p->kind == BASE_PARAM_INTEGER || p->kind == BASE_PARAM_CHOICE) assert_memory_equal(x, y, sizeof(int));
        if (p->kind == BASE_PARAM_FLAG) assert_memory_equal(x, y, sizeof(bool));
        if (p->kind != BASE_PARAM_NUMBER) continue;
        const double u = *(const double *)(const void *)x, v = *(const double *)(const void *)y;
        if (!(u == v || (isnan(u) && isnan(v)))) print_error("%s.%s: %.17g, %.17g\n", section->key, p->key, u, v);
        assert_true(u == v || (isnan(u) && isnan(v)));
    }
    for (const case_section *s = section->children; s && s->key; s++) {
        for (const case_section *part = s; part && !s->list; part = part->also)
            same_objects(part, (const char *)a + part->offset, (const char *)b + part->offset);
        if (!s->list) continue;
        const case_list l = case_list_get(a, s), m = case_list_get(b, s);
        assert_int_equal(l.n, m.n);
        for (int k = 0; k < l.n; k++)
            same_objects(s, (const char *)l.item + (size_t)k * s->size, (const char *)m.item + (size_t)k * s->size);
    }
}

/* One version reads the old names: the same case, and a warning for each. */
static void old_names_are_read(void **state)
{
    (void)state;
    const char was[] = "name: a\nrails: {height: 20 mm, thickness: 10 mm, separation: 18 mm, temperature: 300 K}\n"
                       "rail: {material: ofhc_copper, temperature: 310 K}\n"
                       "armature: {mass: 1 kg, temperature: 320 K, leg_thickness: 1 mm}\n"
                       "projectile: {material: al6061_t6, lead_angle: 45 deg, length: 20 mm, leg_thickness: 5 mm,\n"
                       "  head_thickness: 10 mm, chamfer_height: 2 mm, half_bore: 9 mm, width: 20 mm}\n"
                       "study: {screen_high: 4}\n";
    const char now[] =
        "name: a\nrail: {height: 20 mm, thickness: 10 mm, separation: 18 mm, initial_temperature: 300 K,\n"
        "  material: ofhc_copper, temperature: 310 K}\n"
        "armature: {mass: 1 kg, initial_temperature: 320 K, wear_thickness: 1 mm,\n"
        "  material: al6061_t6, lead_angle: 45 deg, length: 20 mm, leg_thickness: 5 mm,\n"
        "  head_thickness: 10 mm, chamfer_height: 2 mm, half_bore: 9 mm, width: 20 mm}\nstudy: {}\n";
    static const char *const warnings[] = {
        "case.yaml:2:1: `rails` is now `rail`;",
        "case.yaml:2:61: `rails.temperature` is now `rail.initial_temperature`;",
        "case.yaml:4:24: `armature.temperature` is now `armature.initial_temperature`;",
        "case.yaml:5:1: `projectile` is now `armature`;",
        "case.yaml:7:9: `study.screen_high` is no longer read by anything: leave it out\n",
    };
    breech_case *a = read_text(was), *b = read_text(now);
    same_objects(&case_root, a, b);
    assert_memory_equal(&a->given, &b->given, sizeof a->given);

    for (size_t k = 0; k < sizeof warnings / sizeof *warnings; k++) assert_non_null(strstr(a->warnings, warnings[k]));
    assert_null(strstr(b->warnings, "is now"));
    case_free(a);
    case_free(b);
    const char *sets[] = { "rails.temperature=350 K", "projectile.width=21 mm", "study.screen_high=5" };
    a = small_case(sets, 3);
    assert_true(a->rails.initial_temperature == 350.0 && a->projectile.width == 0.021);
    assert_non_null(strstr(a->warnings, "--set projectile.width=21 mm: `projectile` is now `armature`;"));
    case_free(a);
}

/* Boxes of fine cells are gone: their settings change nothing, and each is named in a warning. */
static void settings_of_boxes_are_read(void **state)
{
    (void)state;
    static const char *const gone[] = { "fine_ahead", "fine_behind", "fine_above",
                                        "fine_depth", "fine_width",  "follow_lead" };
    enum { GONE = sizeof gone / sizeof *gone };
    char set[GONE][40], warning[100];
    const char *sets[GONE];
    for (int k = 0; k < GONE; k++) {
        snprintf(set[k], sizeof set[k], "scene.%s=3 mm", gone[k]);
        sets[k] = set[k];
    }
    breech_case *a = small_case(sets, GONE), *b = small_case(NULL, 0);
    same_objects(&case_root, a, b);
    for (int k = 0; k < GONE; k++) {
        snprintf(warning, sizeof warning, "`scene.%s` is no longer read by anything: leave it out", gone[k]);
        assert_non_null(strstr(a->warnings, warning));
    }
    case_free(a);
    case_free(b);
}

/* ---- writing ---- */

static char *used_text(const breech_case *c)
{
    char *text = NULL;
    size_t size = 0;
    FILE *file = open_memstream(&text, &size);
    assert_non_null(file);
    assert_int_equal(case_write_used(c, file).code, STATUS_OK);
    fclose(file);
    return text;
}

static void used_reads_back(void **state)
{
    (void)state;
    const char *sets[] = { "scene.friction=0.12345678901234567",
                           "scene.velocity=1234.5678901234567 m/s" }; /* 17 digits */
    breech_case *c = small_case(sets, 2), *again = NULL;
    char *used = used_text(c), *errors = NULL;
    const case_options o = { .needs = CASE_FOR_SHOT | CASE_FOR_SCENE | CASE_FOR_ONSET }; /* no folder: it is whole */
    assert_int_equal(
        case_read_memory(&(case_text){ used, strlen(used), "used.yaml", NULL, 0 }, &o, &again, &errors).code,
        STATUS_OK);
    same_objects(&case_root, c, again);
    assert_memory_equal(&c->given, &again->given, sizeof c->given);
    char *twice = used_text(again);
    assert_string_equal(used, twice);
    free(used);
    free(twice);
    case_free(c);
    case_free(again);
}

static void texts_survive_quoting(void **state)
{
    (void)state;
    const char *sets[] = { "title='a \"b\" \\ c: #d'" };
    breech_case *c = small_case(sets, 1), *again = NULL;
    char *used = used_text(c), *errors = NULL;
    const case_options o = options_for(0);
    assert_string_equal(c->title, "a \"b\" \\ c: #d");
    assert_int_equal(
        case_read_memory(&(case_text){ used, strlen(used), "used.yaml", NULL, 0 }, &o, &again, &errors).code,
        STATUS_OK);
    assert_string_equal(c->title, again->title);
    free(used);
    case_free(c);
    case_free(again);
}

/* docs/reference/case-files.md holds what case_print_keys prints, after the line below. */
static void manual_is_up_to_date(void **state)
{
    (void)state;
    char *keys = NULL;
    size_t size = 0;
    FILE *file = open_memstream(&keys, &size);
    assert_non_null(file);
    case_print_keys(file);
    fclose(file);
    manual_holds(BREECH_TESTS "/../docs/reference/case-files.md",
                 "<!-- keys: written by case_print_keys; do not edit below -->", NULL, keys);
    free(keys);
}

/* ---- laws over every table of the schema ---- */

static void check_param(const case_section *section, const base_param *p)
{
    const bool number = p->kind == BASE_PARAM_NUMBER || p->kind == BASE_PARAM_VECTOR || p->kind == BASE_PARAM_INTEGER;
    assert_true(strlen(p->doc) > 0 && !strchr(p->doc, '\n'));
    if (number && !isnan(p->fallback) && !isinf(p->fallback))
        assert_true(p->fallback >= p->min && p->fallback <= p->max);
    if (p->kind == BASE_PARAM_INTEGER || p->kind == BASE_PARAM_CHOICE) assert_true(isfinite(p->fallback));
    for (const base_param *q = p + 1; q->key; q++)
        if (strcmp(p->key, q->key) == 0) fail_msg("%s.%s stands twice in its table", section->key, p->key);
}

/* Defaults lie in range, keys are unique, and every unit is one that udunits2 knows. */
static void check_section(const units *u, const case_section *section)
{
    for (const base_param *p = section->table; p->key; p++) {
        char text[100], user_unit[UNIT_SIZE];
        double value;
        check_param(section, p);
        if (p->kind != BASE_PARAM_NUMBER && p->kind != BASE_PARAM_VECTOR) continue;
        snprintf(text, sizeof text, "2 %s", strcmp(p->unit, "1") == 0 ? "" : p->unit);
        assert_int_equal(host_quantity_read(u, text, p->unit, &value, user_unit).code, STATUS_OK);
        assert_true(value == 2.0);
    }
    for (const case_section *s = section->children; s && s->key; s++)
        for (const case_section *part = s; part; part = part->also) check_section(u, part);
    for (const case_section *part = section->also; part; part = part->also) /* one section of the file: no key twice */
        for (const base_param *p = section->table; p->key; p++)
            for (const base_param *q = part->table; q->key; q++) assert_string_not_equal(p->key, q->key);
}

static void tables_are_sound(void **state)
{
    (void)state;
    units *u = NULL;
    assert_int_equal(host_units_open(&u).code, STATUS_OK);
    check_section(u, &case_root);
    host_units_close(u);
}

/* ---- units ---- */

typedef struct {
    const char *text, *unit;
    double value; /* NAN: refused */
} quantity;

static const quantity written[] = {
    { "1.5 km/s", "m/s", 1500.0 },
    { "12.56uH", "H", 12.56e-6 },
    { "4.10 mohm", "ohm", 4.1e-3 },
    { "20 degC", "K", 293.15 },
    { "8.96 g/cm^3", "kg/m^3", 8960.0 },
    { "0.48 uH/m", "H/m", 0.48e-6 },
    { "5 %", "1", 0.05 },
    { "3", "1", 3.0 },
    { "200 ppm", "1", 2e-4 },
    { "1e3 mm", "m", 1.0 },
    { "-2 us", "s", -2e-6 },
    { "+.5 m", "m", 0.5 },
    { "180 deg", "rad", 3.14159265358979 },
    { "386 W/(m K)", "W/m/K", 386.0 },
    { "1 1/s", "1/s", 1.0 },
    { "3000 rpm", "rad/s", 314.159265358979 },
    { "50 revolution/s", "rad/s", 314.159265358979 },
    { "50 Hz", "rad/s", NAN },
    { "50 kBq", "rad/s", NAN },
    { "50 1/s", "rad/s", NAN },
    { "0.2 V/(rad/s)", "V s/rad", 0.2 },
    { "0.2 V/Hz", "V s/rad", NAN },
    { "0.2 V s", "V s/rad", NAN },
    { "0.2 V s rad", "V s/rad", NAN },
    { "50 rad/s", "Hz", NAN },
    { "60 rpm", "1/s", NAN },
    { "0.5 \xc2\xb5m", "m", 0.5e-6 },
    { "2 in", "m", 0.0508 },
    { "0.2 1/us", "1/s", 2e5 },
    { "5 kHz", "1/s", 5e3 },
    { "5 kHz", "s", NAN },
    { "1/us", "s", NAN },
    { "2 us", "1/s", NAN },
    { "5", "m", NAN },
    { "m", "m", NAN },
    { "", "m", NAN },
    { "5 m m", "m", NAN },
    { "5 100 m", "m", NAN },
    { "nan m", "m", NAN },
    { "0x10 m", "m", NAN },
    { "5 m since 2000-01-01", "m", NAN },
    { "5 %", "m", NAN },
    { "5 %", "rad", NAN },
    { "5 deg", "1", NAN },
    { "5 lg(re 1 m)", "m", NAN },
    { "1e999 km", "m", NAN },
    { "5 m^999", "m", NAN },
    { "2 W.m-1.K^-1", "W/(m K)", 2.0 },
    { "3 (V s)/A", "H", 3.0 },
    { "4 m**2", "m^2", 4.0 },
    { "4 mm\xc2\xb2", "m^2", 4e-6 },
    { "1 A 0s", "F", NAN },
    { "1 m^", "m", NAN },
    { "1 m*", "m", NAN },
    { "1 (m", "m", NAN },
    { "1 m)", "m", NAN },
    { "1 km per s", "m/s", NAN },
    { "1 m^100/m^99", "m", NAN },
    { "5 @", "m", NAN },
    { "1e308 km", "m", NAN },
};

static void quantities(void **state)
{
    (void)state;
    units *u = NULL;
    assert_int_equal(host_units_open(&u).code, STATUS_OK);
    for (size_t k = 0; k < sizeof written / sizeof written[0]; k++) {
        double value = 0.0;
        char user_unit[UNIT_SIZE];
        const status s = host_quantity_read(u, written[k].text, written[k].unit, &value, user_unit);
        if (isnan(written[k].value) != (s.code != STATUS_OK)) print_error("%s: %s\n", written[k].text, s.text);
        assert_int_equal(s.code, isnan(written[k].value) ? STATUS_BAD_INPUT : STATUS_OK);
        /* fifteen digits are kept, so most of these are exact */
        if (s.code == STATUS_OK) assert_true(fabs(value - written[k].value) <= 1e-14 * fabs(written[k].value));
    }
    host_units_close(u);
}

/* Whatever was asked before, and whoever else has the units open: more conversions than are remembered, twice. */
static void conversions_do_not_mix(void **state)
{
    (void)state;
    static const char *const names[] = { "m", "s", "V", "A", "J", "Pa", "N", "W", "Hz", "F", "H", "ohm" };
    static const struct {
        const char *name;
        double value;
    } prefix[] = { { "p", 1e-12 }, { "n", 1e-9 }, { "u", 1e-6 }, { "m", 1e-3 }, { "", 1.0 },
                   { "k", 1e3 },   { "M", 1e6 },  { "G", 1e9 },  { "T", 1e12 } };
    enum { NAMES = sizeof names / sizeof names[0], PREFIXES = sizeof prefix / sizeof prefix[0] };
    units *u, *other;
    assert_int_equal(host_units_open(&u).code, STATUS_OK);
    for (int k = 0; k < 2 * NAMES * NAMES * PREFIXES; k++) {
        const int from = k % NAMES, to = k / NAMES % NAMES, p = k / NAMES / NAMES % PREFIXES;
        char text[20], unit[UNIT_SIZE];
        double value = NAN;
        snprintf(text, sizeof text, "2 %s%s", prefix[p].name, names[from]);
        assert_int_equal(host_units_open(&other).code, STATUS_OK);
        const status s = host_quantity_read(other, text, names[to], &value, unit);
        if ((s.code == STATUS_OK) != (from == to)) fail_msg("%s in %s: %s", text, names[to], s.text);
        if (from == to && fabs(value - 2.0 * prefix[p].value) > 1e-14 * value) fail_msg("%s is %g", text, value);
        host_units_close(other);
    }
    host_units_close(u);
}

static void words(void **state)
{
    (void)state;
    assert_int_equal(host_word_distance("leadangle", "lead_angle"), 0);
    assert_int_equal(host_word_distance("chrage", "charge"), 1); /* neighbours swapped */
    assert_int_equal(host_word_distance("kitten", "sitting"), 3);
    assert_int_equal(host_word_distance("", "abc"), 3);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(values_are_si),
        cmocka_unit_test(sites_take_what_they_leave_out),
        cmocka_unit_test(materials_are_loaded),
        cmocka_unit_test(missing_sections_hold_defaults),
        cmocka_unit_test(all_errors_at_once),
        cmocka_unit_test(errors_are_sorted_and_limited),
        cmocka_unit_test(a_key_finds_its_home),
        cmocka_unit_test(limits_hold_in_any_unit),
        cmocka_unit_test(yaml_errors_have_a_place),
        cmocka_unit_test(commands_say_what_they_need),
        cmocka_unit_test(what_must_fit_is_checked),
        cmocka_unit_test(gases_are_no_rails),
        cmocka_unit_test(set_reaches_every_place),
        cmocka_unit_test(set_can_give_a_whole_list),
        cmocka_unit_test(set_errors_name_the_set),
        cmocka_unit_test(long_values_are_cut),
        cmocka_unit_test(errors_of_a_shared_base_are_told_once),
        cmocka_unit_test(base_is_a_known_key),
        cmocka_unit_test(a_base_is_changed),
        cmocka_unit_test(errors_name_the_file_of_the_chain),
        cmocka_unit_test(chains_end),
        cmocka_unit_test(lists_of_values_are_groups),
        cmocka_unit_test(what_follows_is_not_asked_for),
        cmocka_unit_test(heat_capacity_follows),
        cmocka_unit_test(halves_of_a_section),
        cmocka_unit_test(old_names_are_read),
        cmocka_unit_test(settings_of_boxes_are_read),
        cmocka_unit_test(used_reads_back),
        cmocka_unit_test(texts_survive_quoting),
        cmocka_unit_test(manual_is_up_to_date),
        cmocka_unit_test(tables_are_sound),
        cmocka_unit_test(quantities),
        cmocka_unit_test(conversions_do_not_mix),
        cmocka_unit_test(words),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
