/* Case files: what is read, with which units; all errors at once and where; --set; used.yaml; the manual's key list. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "coupling/case/case.h"
#include "coupling/case/case_errors.h"
#include "coupling/case/case_schema.h"
#include "coupling/host/units.h"

#include <stdlib.h>
#include <string.h>

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

static const shot_module *bank_of(const breech_case *c)
{
    return c->supplies[SUPPLY_capacitor].item;
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
    assert_int_equal(c->supplies[SUPPLY_capacitor].n, 2);
    assert_int_equal(bank_of(c)[0].count, 4);
    assert_true(bank_of(c)[0].capacitance == 3.594e-3);
    assert_true(bank_of(c)[0].inductance == 12.56e-6);
    assert_true(bank_of(c)[1].fire_at == 0.4e-3);
    assert_true(c->rails.temperature == 293.15);
    assert_int_equal(c->rails.level, SHOT_RAILS_CONSTANT);
    assert_true(c->armature.friction_melted == 0.05);
    assert_true(c->options.rtol == 1e-7);
    assert_int_equal(c->rail.layers.n, 1);
    assert_true(c->rail.layers.item[0].thickness == 200e-6);
    assert_true(c->rail.layers.item[0].bond_strength == 80e6);
    assert_true(fabs(c->projectile.lead_angle - 0.52359877559829887) < 1e-14); /* 30 deg, to the 15 digits kept */
    assert_true(c->scene.rail_ahead == 0.018);
    assert_false(c->scene.damage);
    assert_true(isnan(c->scene.fine_ahead));
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
    const material *copper = case_material(c, "ofhc_copper");
    assert_non_null(copper);
    assert_true(copper->density == 8960.0 && copper->yield_A == 90e6);
    assert_true(isnan(copper->spall_strength)); /* a blank constant stays unknown */
    assert_null(case_material(c, "unobtainium"));
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
    assert_int_equal(c->supplies[SUPPLY_capacitor].n, 0);
    assert_true(c->scene.courant == 0.4);
    assert_true(isnan(c->rails.height));
    assert_false(c->given.scene);
    case_free(c);
}

/* ---- errors ---- */

static void all_errors_at_once(void **state)
{
    (void)state;
    const char text[] = "name: bad\n"
                        "bank:\n"
                        "  capacitance: -5 mF\n"
                        "  charge: 9\n"
                        "  inductence: 3 uH\n"
                        "rails: {height: 25 mm, thickness: 20 kV, separation: 25 mmm, level: skim}\n"
                        "projectile: {leadangle: 30 deg, material: al7075_t651}\n"
                        "scene: {friction: 0.2 mm, velocity: 20 km/s, damage: maybe, particles_per_axis: 2.5}\n"
                        "rail: {material: ofhc_coper, temperature: 5000 degC}\n"
                        "sites: [{position: 3 m, shape: hemisfere}, text]\n"
                        "velocity: 3 m/s\n";
    char *e = errors_of(text, NULL, 0, 0);
    has_line(e, "case.yaml:3:16: bank.capacitance = -5 mF: must be positive (1 pF .. 1 kF)\n");
    has_line(e, "case.yaml:4:11: bank.charge = 9: needs a unit, such as `9 V`\n");
    has_line(e, "case.yaml:5:3: unknown key `inductence` in bank; did you mean `inductance`?\n");
    has_line(e, "case.yaml:6:35: rails.thickness = 20 kV: `kV` is not a unit of m\n");
    has_line(e, "case.yaml:6:54: rails.separation = 25 mmm: `mmm` is not a known unit");
    has_line(e, "case.yaml:6:69: rails.level = skim: must be one of constant, skin, diffusing; did you mean `skin`?\n");
    has_line(e, "case.yaml:7:14: unknown key `leadangle` in projectile; did you mean `lead_angle`?\n");
    has_line(e, "case.yaml:7:13: projectile.half_bore is missing [m]");
    has_line(e, "case.yaml:8:19: scene.friction = 0.2 mm: is a pure number");
    has_line(e, "case.yaml:8:37: scene.velocity = 20 km/s: must lie within the range (0.001 km/s .. 10 km/s)\n");
    has_line(e, "case.yaml:8:54: scene.damage = maybe: must be yes or no\n");
    has_line(e, "case.yaml:8:81: scene.particles_per_axis = 2.5: must be a whole number\n");
    has_line(e, "case.yaml:9:18: rail.material = ofhc_coper: no material of this name in ");
    has_line(
        e, "case.yaml:9:43: rail.temperature = 5000 degC: must lie within the range (-269.15 degC .. 1726.85 degC)\n");
    has_line(e, "case.yaml:10:32: sites[0].shape = hemisfere: must be one of ");
    has_line(e, "case.yaml:10:44: sites[1] must be a section");
    has_line(e, "case.yaml:11:1: unknown key `velocity`; `armature` has one\n");
    assert_null(strstr(e, "lead_angle is missing")); /* a mistyped key is one error, not two */
    free(e);
}

/* A limit in another unit is within, whatever the rounding of the conversion; what is really beyond is not. */
static void limits_hold_in_any_unit(void **state)
{
    (void)state;
    char *e = errors_of("name: a\nprojectile: {lead_angle: 90 deg}\n", NULL, 0, 0);
    assert_null(strstr(e, "within the range"));
    free(e);
    e = errors_of("name: a\nprojectile: {lead_angle: 90.0001 deg}\n", NULL, 0, 0);
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
        { "name: [a\n", "case.yaml:2:1: not valid YAML" },
        { "name: \"a\\0b\"\n", "case.yaml:1:7: a control character" },
        { "- a\n- b\n", "case.yaml:1:1: case.yaml is no case" },
        { "a: {b: {c: {d: {e: {f: {g: {h: {i: {j: {k: {l: 1}}}}}}}}}}}\n",
          "case.yaml:1:44: sections nested more than" },
        { "\n", "case.yaml:2:1: the file is empty" },
        { "[a]: b\n", "case.yaml:1:1: a key must be a plain word" },
        { "name: \xff\n", "case.yaml:1:1: not valid YAML" },
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
    const char *sets[] = { "sites[1].position=5 m", "projectile.leg_thickness=20 mm", "study.velocity_low=3 km/s",
                           "particle.height=20 mm", "scene.coarse_cell=0.1 mm" };
    char *text = read_file(SMALL_CASE), *e = errors_of(text, sets, 5, 0);
    has_line(e, "--set sites[1].position=5 m: sites[1].position = 5 m: must lie between barrel.start = 0.1 m");
    has_line(e, "--set projectile.leg_thickness=20 mm: projectile.leg_thickness = 20 mm: must not exceed half_bore\n");
    has_line(e, "--set study.velocity_low=3 km/s: study.velocity_low = 3 km/s: must lie below velocity_high\n");
    has_line(e, "--set particle.height=20 mm: particle.height = 20 mm: must not exceed projectile.half_bore\n");
    has_line(e, "--set scene.coarse_cell=0.1 mm: scene.coarse_cell = 0.1 mm: must not be smaller than the fine cell");
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
    const char *sets[] = { "bank.charg=3", "rails.height=2 kV", "bank[2].charge=3 V", "name.x=3", "scene=[1,{",
                           "=3",           "bank[x].charge=3",  "study.max_scenes=0", "nothing",  "bank.charge=9" };
    char *text = read_file(SMALL_CASE), *e = errors_of(text, sets, 10, 0);
    has_line(e, "--set bank.charg=3: unknown key `charg` in bank[0]; did you mean `charge`?\n");
    has_line(e, "--set rails.height=2 kV: rails.height = 2 kV: `kV` is not a unit of m\n");
    has_line(e, "--set bank[2].charge=3 V: bank has 2 entries: bank[0] .. bank[1]\n");
    has_line(e, "--set name.x=3: x is not inside a section");
    has_line(e, "--set scene=[1,{: not valid YAML");
    has_line(e, "--set =3: wanted path.to.key=value");
    has_line(e, "--set bank[x].charge=3: wanted a number from 0 in bank[...]");
    has_line(e, "--set study.max_scenes=0: study.max_scenes = 0: must be positive (1 .. 100000)\n");
    has_line(e, "--set nothing: wanted path.to.key=value");
    has_line(e, "--set bank.charge=9: bank[0].charge = 9: needs a unit, such as `9 V`\n");
    assert_int_equal(lines_of(e), 10); /* one line a set, however many entries it reaches */
    free(e);
    free(text);
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

/* Every member of every table, by the tables: equal bits, NAN equal to NAN. */
static void same_objects(const case_section *section, const void *a, const void *b)
{
    for (const param *p = section->table; p->key; p++) {
        const char *x = (const char *)a + p->offset, *y = (const char *)b + p->offset;
        if (p->kind == PARAM_TEXT) assert_string_equal(x, y);
        if (p->kind == PARAM_INTEGER || p->kind == PARAM_CHOICE) assert_memory_equal(x, y, sizeof(int));
        if (p->kind == PARAM_FLAG) assert_memory_equal(x, y, sizeof(bool));
        if (p->kind != PARAM_NUMBER) continue;
        const double u = *(const double *)(const void *)x, v = *(const double *)(const void *)y;
        if (!(u == v || (isnan(u) && isnan(v)))) print_error("%s.%s: %.17g, %.17g\n", section->key, p->key, u, v);
        assert_true(u == v || (isnan(u) && isnan(v)));
    }
    for (const case_section *s = section->children; s && s->key; s++) {
        if (!s->list) {
            same_objects(s, (const char *)a + s->offset, (const char *)b + s->offset);
            continue;
        }
        const case_list l = case_list_get(a, s), m = case_list_get(b, s);
        assert_int_equal(l.n, m.n);
        for (int k = 0; k < l.n; k++)
            same_objects(s, (const char *)l.item + (size_t)k * s->size, (const char *)m.item + (size_t)k * s->size);
    }
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

/* docs/case-files.md holds what case_print_keys prints, after the line below. */
static void manual_is_up_to_date(void **state)
{
    (void)state;
    static const char start[] = "<!-- keys: written by case_print_keys; do not edit below -->\n";
    char *keys = NULL;
    size_t size = 0;
    FILE *file = open_memstream(&keys, &size);
    assert_non_null(file);
    case_print_keys(file);
    fclose(file);
    FILE *copy = fopen("case-keys.md", "w"); /* to paste from */
    if (copy) {
        fputs(keys, copy);
        fclose(copy);
    }
    char *manual = read_file(BREECH_TESTS "/../docs/case-files.md");
    const char *at = strstr(manual, start);
    assert_non_null(at);
    assert_string_equal(at + strlen(start), keys);
    free(manual);
    free(keys);
}

/* ---- laws over every table of the schema ---- */

static void check_param(const case_section *section, const param *p)
{
    const bool number = p->kind == PARAM_NUMBER || p->kind == PARAM_VECTOR || p->kind == PARAM_INTEGER;
    assert_true(strlen(p->doc) > 0 && !strchr(p->doc, '\n'));
    if (number && !isnan(p->fallback) && !isinf(p->fallback))
        assert_true(p->fallback >= p->min && p->fallback <= p->max);
    if (p->kind == PARAM_INTEGER || p->kind == PARAM_CHOICE) assert_true(isfinite(p->fallback));
    for (const param *q = p + 1; q->key; q++)
        if (strcmp(p->key, q->key) == 0) fail_msg("%s.%s stands twice in its table", section->key, p->key);
}

/* Defaults lie in range, keys are unique, and every unit is one that udunits2 knows. */
static void check_section(const units *u, const case_section *section)
{
    for (const param *p = section->table; p->key; p++) {
        char text[100], user_unit[UNIT_SIZE];
        double value;
        check_param(section, p);
        if (p->kind != PARAM_NUMBER && p->kind != PARAM_VECTOR) continue;
        snprintf(text, sizeof text, "2 %s", strcmp(p->unit, "1") == 0 ? "" : p->unit);
        assert_int_equal(host_quantity_read(u, text, p->unit, &value, user_unit).code, STATUS_OK);
        assert_true(value == 2.0);
    }
    for (const case_section *s = section->children; s && s->key; s++) check_section(u, s);
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

static void quantities(void **state)
{
    (void)state;
    static const quantity all[] = {
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
        { "0.5 \xc2\xb5m", "m", 0.5e-6 },
        { "2 in", "m", 0.0508 },
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
    units *u = NULL;
    assert_int_equal(host_units_open(&u).code, STATUS_OK);
    for (size_t k = 0; k < sizeof all / sizeof all[0]; k++) {
        double value = 0.0;
        char user_unit[UNIT_SIZE];
        const status s = host_quantity_read(u, all[k].text, all[k].unit, &value, user_unit);
        if (isnan(all[k].value) != (s.code != STATUS_OK)) print_error("%s: %s\n", all[k].text, s.text);
        assert_int_equal(s.code, isnan(all[k].value) ? STATUS_BAD_INPUT : STATUS_OK);
        /* fifteen digits are kept, so most of these are exact */
        if (s.code == STATUS_OK) assert_true(fabs(value - all[k].value) <= 1e-14 * fabs(all[k].value));
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
        cmocka_unit_test(limits_hold_in_any_unit),
        cmocka_unit_test(yaml_errors_have_a_place),
        cmocka_unit_test(commands_say_what_they_need),
        cmocka_unit_test(what_must_fit_is_checked),
        cmocka_unit_test(set_reaches_every_place),
        cmocka_unit_test(set_can_give_a_whole_list),
        cmocka_unit_test(set_errors_name_the_set),
        cmocka_unit_test(used_reads_back),
        cmocka_unit_test(texts_survive_quoting),
        cmocka_unit_test(manual_is_up_to_date),
        cmocka_unit_test(tables_are_sound),
        cmocka_unit_test(quantities),
        cmocka_unit_test(words),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
