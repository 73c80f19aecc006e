/* SPDX-License-Identifier: BSD-3-Clause */
/* Scenes whose bodies stand in the case: every table of the solver is read, what cannot be is refused with its place,
 * what is left out is chosen, any scene written as text gives the same bits, and a run keeps its books body by body. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "coupling/case/case.h"
#include "coupling/gouge/impact_scene.h"
#include "coupling/host/outdir.h"
#include "coupling/scene/scene_bodies.h"
#include "coupling/scene/scene_fill.h"
#include "coupling/study/study.h"
#include "full_common.h"
#include "mpm/law/contact.h"
#include "mpm/read/probe.h"
#include "text_common.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "status_common.h"

static const char *const dirs[] = { BREECH_TESTS "/../cases/materials" };

static status read_text(const char *text, unsigned needs, breech_case **c, char **errors)
{
    const case_options how = { dirs, 1, needs };
    return case_read_memory(&(case_text){ text, strlen(text), "case.yaml", NULL, 0 }, &how, c, errors);
}

static breech_case *read_good_for(const char *text, unsigned needs)
{
    breech_case *c = NULL;
    char *errors = NULL;
    const status s = read_text(text, needs, &c, &errors);
    if (s.code != STATUS_OK) fail_msg("%s\n%s", errors ? errors : s.text, text);
    return c;
}

static breech_case *read_good(const char *text)
{
    return read_good_for(text, CASE_FOR_SCENE);
}

static char *used_text(const breech_case *c)
{
    char *text = NULL;
    size_t bytes;
    FILE *f = open_memstream(&text, &bytes);
    OK(case_write_used(c, f));
    fclose(f);
    return text;
}

#define HEAD "name: a\nscene:\n  end_time: 1 us\n"
#define BOX "{name: wall, material: ofhc_copper, shape: {box: {lo: 0 0 0 mm, hi: 2 4 4 mm}}}"
#define BALL \
    "{name: ball, material: ofhc_copper, shape: {sphere: {center: -1 2 2 mm, radius: 1 mm}}, velocity: 300 0 0 m/s}"
#define TWO HEAD "  bodies:\n    - " BOX "\n    - " BALL "\n"

/* ---- reading ---- */

static void test_minimal(void **state)
{
    (void)state;
    breech_case *c = read_good(TWO);
    mpm_scene *s = &c->bodies.scene;
    assert_true(c->given.bodies && !c->given.scene);
    assert_int_equal(s->bodies, 2);
    assert_true(s->body[0].group == 0 && s->body[1].group == 1);
    assert_true(s->body[1].velocity[0] == 300.0 && s->body[1].temperature == 293.0);
    assert_string_equal(s->body[1].material->name, "ofhc_copper");
    assert_string_equal(s->solid[s->body[1].solid].kind->name, "sphere");
    OK(scene_fill(s));
    for (int k = 0; k < 3; k++) {
        const mpm_axis *a = &s->axis[k];
        assert_true(fabs(a->fine / 0.1e-3 - 1.0) < 1e-12); /* a twentieth of 2 mm */
        assert_true(a->lo < a->fine_lo && a->fine_hi < a->hi && a->coarse == 4.0 * a->fine);
        assert_true(a->fine_lo < -1e-3 + (k > 0) * 2e-3 && a->fine_hi > (k > 0) * 3e-3); /* holds the ball */
    }
    mpm_needs needs;
    OK(mpm_estimate(s, &needs));
    assert_true(needs.particles > 1000);
    case_free(c);
}

/* Cells of an axis: its own, else the scene's, else the smallest that a rule of refinement asks for. */
static void test_cell_of_rules(void **state)
{
    (void)state;
#define RULES "  refine: [{around: ball, within: 1 mm, cell: 0.4 mm}, {shock: all, jump: 20 m/s, cell: 0.5 mm}]\n"
    static const struct {
        const char *lines;
        double x, y;
    } of[] = { { RULES, 0.4e-3, 0.4e-3 },
               { RULES "  cell: 0.1 mm\n", 0.1e-3, 0.1e-3 },
               { RULES "  window: {x: {cell: 1 mm}}\n", 1e-3, 0.4e-3 },
               { RULES "  cell: 0.1 mm\n  window: {x: {cell: 1 mm}}\n", 1e-3, 0.1e-3 } };
#undef RULES
    for (size_t i = 0; i < sizeof of / sizeof *of; i++) {
        char text[1000];
        snprintf(text, sizeof text, TWO "%s", of[i].lines);
        breech_case *c = read_good(text);
        const mpm_axis *axis = c->bodies.scene.axis;
        if (fabs(axis[0].fine / of[i].x - 1.0) > 1e-12 || fabs(axis[1].fine / of[i].y - 1.0) > 1e-12)
            fail_msg("%s%g and %g m", of[i].lines, axis[0].fine, axis[1].fine);
        case_free(c);
    }
}

/* Another value than the default, within the row's range. */
static void change(const base_param *p, void *member)
{
    const double fallback = isfinite(p->fallback) ? p->fallback : 0.0;
    switch (p->kind) {
    case BASE_PARAM_NUMBER:
        *(double *)member = fallback + 1.25 <= p->max ? fallback + 1.25 : 0.5 * (fallback + p->max);
        break;
    case BASE_PARAM_VECTOR:
        for (int k = 0; k < 3; k++) ((double *)member)[k] = fallback + fmin(1.25, 0.25 * p->max) * (k + 1);
        break;
    case BASE_PARAM_INTEGER: *(int *)member = (int)fallback + 1; break;
    case BASE_PARAM_CHOICE: *(int *)member = fallback == 0.0; break;
    case BASE_PARAM_FLAG: *(bool *)member = fallback == 0.0; break;
    case BASE_PARAM_TEXT: strcpy(member, "other"); break;
    case BASE_PARAM_POINTS: fail_msg("no scene has points"); break;
    }
}

static size_t bytes_of(const base_param *p)
{
    return p->kind == BASE_PARAM_NUMBER   ? sizeof(double)
           : p->kind == BASE_PARAM_VECTOR ? 3 * sizeof(double)
           : p->kind == BASE_PARAM_FLAG   ? sizeof(bool)
           : p->kind == BASE_PARAM_TEXT   ? BASE_PARAM_TEXT_SIZE
                                          : sizeof(int);
}

/* Where the struct of a table lies in a case. */
typedef void *part_of_scene(mpm_scene *s);
static void *whole_scene(mpm_scene *s)
{
    return s;
}
static void *second_axis(mpm_scene *s)
{
    return &s->axis[1];
}
static void *second_body(mpm_scene *s)
{
    return &s->body[1];
}

/* Every row of one of the solver's tables is read, written and read back. */
static int keys_come_back(const base_param *table, part_of_scene *part)
{
    int rows = 0;
    for (const base_param *p = table; p->key; p++, rows++) {
        breech_case *c = read_good(TWO);
        char *want = (char *)part(&c->bodies.scene) + p->offset;
        change(p, want);
        char *text = used_text(c);
        breech_case *back = read_good_for(text, 0); /* not every value makes a scene */
        const char *got = (const char *)part(&back->bodies.scene) + p->offset;
        if (memcmp(got, want, bytes_of(p)) != 0) fail_msg("%s is not what was written:\n%s", p->key, text);
        free(text);
        case_free(back), case_free(c);
    }
    return rows;
}

static void test_keys(void **state)
{
    (void)state;
    assert_string_equal(mpm_body_params[MPM_BODY_KEYED].key, "name");
    assert_string_equal(mpm_axis_params[MPM_AXIS_KEYED].key, "lo");
    assert_string_equal(mpm_scene_params[MPM_SCENE_KEYED].key, "end_time");
    assert_true(keys_come_back(&mpm_body_params[MPM_BODY_KEYED], second_body) > 8);
    assert_true(keys_come_back(&mpm_axis_params[MPM_AXIS_KEYED], second_axis) > 5);
    assert_true(keys_come_back(&mpm_scene_params[MPM_SCENE_KEYED], whole_scene) > 10);
}

static void test_groups(void **state)
{
    (void)state;
    breech_case *c = read_good(
        HEAD "  bodies:\n"
             "    - {name: a, material: nickel, group: left, shape: {box: {lo: 0 0 0 mm, hi: 1 1 1 mm}}}\n"
             "    - {name: b, material: nickel, shape: {box: {lo: 1 0 0 mm, hi: 2 1 1 mm}}}\n"
             "    - {name: c, material: nickel, group: left, shape: {box: {lo: 2 0 0 mm, hi: 3 1 1 mm}}}\n"
             "    - {name: d, material: nickel, shape: {box: {lo: 3 0 0 mm, hi: 4 1 1 mm}}, passes: [-x, +z]}\n"
             "  contacts:\n"
             "    - {between: [b, c], law: coulomb, friction: 0.4, normal_of: b}\n"
             "    - {default: coulomb, friction: 0.2}\n"
             "  boundary: {x: [fixed, {prescribed: 0 5 0 m/s}]}\n");
    const mpm_scene *s = &c->bodies.scene;
    const int group[] = { 0, 1, 0, 2 };
    for (int i = 0; i < 4; i++) assert_int_equal(s->body[i].group, group[i]);
    assert_true(s->body[3].passes[0] && s->body[3].passes[5] && !s->body[3].passes[1]);
    assert_true(mpm_scene_contact(s, 0, 1).contact.value[COULOMB_FRICTION] == 0.4);
    assert_int_equal(mpm_scene_contact(s, 0, 1).normal_of, 1);
    assert_true(mpm_scene_contact(s, 1, 2).contact.value[COULOMB_FRICTION] == 0.2);
    assert_true(s->axis[0].boundary[0] == MPM_BOUNDARY_FIXED && s->axis[0].boundary[1] == MPM_BOUNDARY_PRESCRIBED);
    assert_true(s->axis[0].boundary_velocity[1][1] == 5.0);
    case_free(c);
}

/* Every kind of solid asks for the required values of its own table, and takes its parts. */
static void test_every_shape(void **state)
{
    (void)state;
    for (int i = 0; mpm_solid_kind_at(i); i++) {
        const mpm_solid_kind *k = mpm_solid_kind_at(i);
        char text[800];
        breech_case *c = NULL;
        char *errors = NULL;
        snprintf(text, sizeof text, HEAD "  bodies: [{name: a, material: nickel, shape: {%s: {}}}]\n", k->name);
        const status s = read_text(text, CASE_FOR_SCENE, &c, &errors);
        assert_int_equal(s.code, STATUS_BAD_INPUT); /* none is whole without a value or a part */
        for (const base_param *p = k->params; p->key; p++) {
            char missing[200];
            snprintf(missing, sizeof missing, "scene.bodies[0].shape.%s.%s is missing", k->name, p->key);
            assert_int_equal(strstr(errors, missing) != NULL, isinf(p->fallback));
        }
        free(errors);
    }
}

/* A law's values as a case file gives them, each another one than its default; they are in *of then too. */
static void contact_values(mpm_contact *of, char *text, size_t size)
{
    size_t n = 0;
    text[0] = '\0';
    for (const base_param *p = of->law->params; p->key; p++) {
        double *value = (double *)(void *)((char *)of + p->offset);
        change(p, value);
        n += (size_t)snprintf(text + n, size - n, ", %s: %.17g %s", p->key, *value, p->unit[0] == '1' ? "" : p->unit);
        assert_true(n < size);
    }
}

static void test_every_contact(void **state)
{
    (void)state;
    for (int i = 0; mpm_contact_at(i); i++) {
        char text[2500], values[800];
        mpm_contact want = mpm_contact_of(mpm_contact_at(i));
        contact_values(&want, values, sizeof values);
        snprintf(text, sizeof text, TWO "  contacts: [{default: %s%s}, {between: [wall, ball], law: %s%s}]\n",
                 want.law->name, values, want.law->name, values);
        breech_case *c = read_good(text);
        assert_memory_equal(&c->bodies.scene.contact, &want, sizeof want);
        assert_memory_equal(&c->bodies.scene.pair[0].contact, &want, sizeof want);
        case_free(c);
    }
}

/* Every boundary is read at either end and comes back; what none is called is refused with the names of all. */
static void test_every_boundary(void **state)
{
    (void)state;
    char *errors = NULL;
    breech_case *none = NULL;
    assert_int_equal(read_text(TWO "  boundary: {y: [wall, free]}\n", CASE_FOR_SCENE, &none, &errors).code,
                     STATUS_BAD_INPUT);
    for (int i = 0; i < MPM_BOUNDARIES; i++) {
        const char *name = mpm_boundary_names[i], *ends = i == MPM_BOUNDARY_PRESCRIBED ? ": 1 2 3 m/s}" : "";
        char text[1500];
        snprintf(text, sizeof text, TWO "  boundary: {y: [%s%s%s, free], z: [free, %s%s%s]}\n", ends[0] ? "{" : "",
                 name, ends, ends[0] ? "{" : "", name, ends);
        breech_case *c = read_good(text);
        char *used = used_text(c);
        breech_case *back = read_good(used);
        const mpm_axis *y = &back->bodies.scene.axis[1], *z = &back->bodies.scene.axis[2];
        assert_true((int)y->boundary[0] == i && (int)z->boundary[1] == i);
        assert_true(y->boundary[1] == MPM_BOUNDARY_FREE && z->boundary[0] == MPM_BOUNDARY_FREE);
        if (ends[0]) assert_true(y->boundary_velocity[0][2] == 3.0 && z->boundary_velocity[1][0] == 1.0);
        if (!strstr(errors, name)) fail_msg("%s does not name %s", errors, name);
        free(used);
        case_free(back), case_free(c);
    }
    free(errors);
}

/* The plastic front belongs to the watch over an impact on a rail: what asked for it in a scene of bodies does nothing.
 */
static void test_old_keys(void **state)
{
    (void)state;
    const char *const set = "scene.bodies[1].followed=yes";
    const case_options how = { dirs, 1, CASE_FOR_SCENE };
    const char was[] = HEAD "  follow: {along: y, across: z}\n  bodies:\n    - {name: wall, followed: yes, "
                            "material: ofhc_copper, shape: {box: {lo: 0 0 0 mm, hi: 2 4 4 mm}}}\n    - " BALL "\n";
    breech_case *old = NULL, *now = read_good(TWO);
    char *errors = NULL;
    OK(case_read_memory(&(case_text){ was, strlen(was), "case.yaml", &set, 1 }, &how, &old, &errors));
    assert_non_null(
        strstr(old->warnings, "case.yaml:4:3: `scene.follow` is no longer read by anything: leave it out\n"));
    assert_non_null(strstr(old->warnings, "case.yaml:6:20: `scene.bodies[0].followed` is no longer read"));
    assert_non_null(
        strstr(old->warnings, "--set scene.bodies[1].followed=yes: `scene.bodies[1].followed` is no longer"));
    assert_null(strstr(now->warnings, "no longer"));
    assert_true(mpm_scene_hash(&old->bodies.scene) == mpm_scene_hash(&now->bodies.scene));
    case_free(old), case_free(now);
    OK(read_text("name: a\nscene: {follow: no, friction: 0}\n", 0, &old, &errors)); /* there it is a key */
    assert_false(old->scene.follow);
    assert_null(strstr(old->warnings, "no longer"));
    case_free(old);
}

/* Operations nest, and one on two solids takes more from left to right. */
static void test_tree(void **state)
{
    (void)state;
    breech_case *c = read_good(
        HEAD "  bodies:\n"
             "    - name: a\n"
             "      material: nickel\n"
             "      shape:\n"
             "        minus:\n"
             "          - {box: {lo: 0 0 0 mm, hi: 4 4 4 mm}}\n"
             "          - {sphere: {center: 0 0 0 mm, radius: 1 mm}}\n"
             "          - {move: {offset: [4 mm, 4 mm, 4 mm], of: {sphere: {center: 0 0 0 mm, radius: 1 mm}}}}\n");
    const mpm_scene *s = &c->bodies.scene;
    const mpm_solid *root = &s->solid[s->body[0].solid];
    assert_true(mpm_solid_inside(root, (const double[]){ 2e-3, 2e-3, 2e-3 }) > 0.0);
    assert_true(mpm_solid_inside(root, (const double[]){ 0.3e-3, 0.3e-3, 0.3e-3 }) < 0.0);
    assert_true(mpm_solid_inside(root, (const double[]){ 3.7e-3, 3.7e-3, 3.7e-3 }) < 0.0);
    char *text = used_text(c);
    breech_case *back = read_good(text);
    char *again = used_text(back);
    assert_string_equal(text, again);
    free(text), free(again);
    case_free(back), case_free(c);
}

static const struct {
    const char *text, *error;
} wrong[] = {
    { HEAD "  bodies: []\n", "case.yaml:4:11: scene.bodies must be a list of bodies, at least one" },
    { HEAD "  bodies: [5]\n", "case.yaml:4:12: scene.bodies[0] must be a section: key and value, one a line" },
    { HEAD "  bodies: [{name: a, material: nickel}]\n", "scene.bodies[0].shape is missing" },
    { HEAD "  bodies: [{name: a, material: nickel, shape: {bal: {}}}]\n", "case.yaml:4:48: unknown shape `bal`" },
    { HEAD "  bodies: [{name: a, material: nickel, shape: {sphere: {center: 0 0 mm, radius: 1 mm}}}]\n",
      "center = 0 0 mm: must be three numbers and their unit, `0 -50 50 mm`, or [x, y, z]" },
    { HEAD "  bodies: [{name: a, material: nickel, velocity: 5 m/s, shape: {sphere: {radius: 1 mm}}}]\n",
      "velocity = 5 m/s: must be three numbers and their unit, `0 -50 50 m/s`, or [x, y, z]" },
    { TWO "  contacts: [{between: [wall, ball]}]\n", "contacts[0].law must name a law of contact, such as coulomb" },
    { HEAD "  bodies: [{name: a, material: nickel, shape: {sphere: {center: 0.1 0.2 0.3, radius: 1 mm}}}]\n",
      "center = 0.1: needs a unit, such as `0.1 m`" }, /* as it is written, not as it is kept */
    { HEAD "  bodies: [{name: a, material: nickel, shape: {sphere: {center: 0 0 0 mm, radius: -1 mm}}}]\n",
      "scene.bodies[0].shape.sphere.radius = -1 mm: must be positive" },
    { HEAD "  bodies: [{name: a, material: nickel, shape: {box: {lo: 0 0 0 mm, hi: 1 0 1 mm}}}]\n", "hi along y" },
    { HEAD "  bodies: [{name: a, material: nickel, shape: {minus: [{sphere: {center: 0 0 0 mm, radius: 1 mm}}]}}]\n",
      "is made of at least 2 solids" },
    { HEAD "  bodies:\n    - " BOX
           "\n    - {name: a, material: nickel, shape: {repeat: {pitch: 0.1 0.1 0.1 mm, count: 100 "
           "100 100, of: {sphere: {center: -9 0 0 mm, radius: 5 mm}}}}}\n",
      "case.yaml:6:59: scene.bodies[1].shape.repeat.pitch = 0.0001 0.0001 0.0001 m: so many copies overlap" },
    { HEAD "  bodies: [{name: a b, material: nickel, shape: {sphere: {center: 0 0 0 mm, radius: 1 mm}}}]\n",
      "letters, digits" },
    { TWO "  contacts: [{default: glue}]\n", "case.yaml:7:24: unknown law of contact `glue`" },
    { TWO "  contacts: [{between: [wall, bal], law: coulomb}]\n",
      "unknown body `bal` in scene.contacts[0]; did you mean `ball`?" },
    { TWO "  contacts: [{between: [wall, wall], law: coulomb}]\n", "both are of one group" },
    { TWO "  boundary: {x: [free]}\n", "scene.boundary.x must be two boundaries" },
    { TWO "  boundary: {x: [free, absorbin]}\n", "scene.boundary.x[1] = absorbin: must be one of free" },
    { TWO "  window: {w: {lo: 0 mm}}\n", "unknown key `w` in scene.window" },
    { TWO "  probes: [{name: push, force_on: wal}]\n",
      "unknown body `wal` in scene.probes[0].force; did you mean `wall`?" },
    { TWO "  probes: [{name: push, force: {body: wal}}]\n", "did you mean `wall`?" },
    { TWO "  probes: [{name: push, forc: wall}]\n",
      "unknown kind of probe `forc` in scene.probes[0]; did you mean `force`?" },
    { TWO "  probes: [{name: push, force: {}}]\n", "scene.probes[0].force.body must name a body" },
    { TWO "  probes: [{name: push}]\n", "scene.probes[0] must name a kind of probe" },
    { TWO "  probes: [{name: push, force: wall, energy: wall}]\n", "a probe of two kinds, force and energy" },
    { TWO "  probes: [{energy: wall}]\n", "scene.probes[0].name is missing" },
    { TWO "  probes: [{name: a b, energy: wall}]\n", "letters, digits, - _ . only" },
    { TWO "  probes: [{name: p, face: {lo: 0 0 0 mm, hi: 1 0 1 mm}}]\n", "scene.probes[0].face: hi along y" },
    { TWO "  probes: [{name: p, force_on: wall}, {name: p, force_on: ball}]\n",
      "scene.probes[1].name = p: the same as" },
    { TWO "  friction: 0.1\n", "unknown key `friction` in scene" },
    { TWO "  refine: [{around: bal, within: 1 mm, cell: 0.1 mm}]\n", "did you mean `ball`?" },
    { HEAD "  bodies:\n    - " BOX "\n    - " BOX "\n", "case.yaml:6:14: scene.bodies[1].name = wall: the same as" },
    { HEAD "  bodies:\n    - " BOX
           "\n    - {name: b, material: nickel, shape: {box: {lo: 1.9 0 0 mm, hi: 3 4 4 mm}}}\n",
      "case.yaml:6:42: scene.bodies[1].shape: b overlaps wall by 4.9e-05 m" },
    { HEAD "  bodies: [{name: a, material: w_alloy, damage: yes, shape: {sphere: {center: 0 0 0 mm, radius: 1 mm}}}]\n",
      "(or set damage: no)" },
};

/* What is said of a text that is refused; the caller's. */
static char *errors_of(const char *text, unsigned needs)
{
    breech_case *c = NULL;
    char *errors = NULL;
    if (read_text(text, needs, &c, &errors).code != STATUS_BAD_INPUT) fail_msg("accepted:\n%s", text);
    return errors;
}

static void test_refused(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        char *errors = errors_of(wrong[i].text, CASE_FOR_SCENE);
        if (!strstr(errors, wrong[i].error)) fail_msg("case %zu: %s\nnot: %s", i, wrong[i].error, errors);
        free(errors);
    }
    char *errors = errors_of(TWO, CASE_FOR_ONSET);
    assert_non_null(strstr(errors, "scene.bodies: a study makes its scenes"));
    free(errors);
}

/* ---- what the solver refuses: said of the case's keys, before anything is made ---- */

#define BODIES(of_wall, of_ball)                                                                                   \
    HEAD "  bodies:\n    - {name: wall, material: ofhc_copper, shape: {box: {lo: 0 0 0 mm, hi: 2 4 4 mm}}" of_wall \
         "}\n    - {name: ball, material: ofhc_copper, shape: {sphere: {center: -1 2 2 mm, radius: 1 mm}}" of_ball \
         "}\n"

/* What is wrong with a body hides nothing of what comes after it, as long as all have names. */
static void test_all_at_once(void **state)
{
    static const char *const after[] = { "scene.bodies[1].held = perhaps",
                                         "unknown law of contact `stik` in scene.contacts[0]",
                                         "scene.boundary.x[0] = a", "`forse` in scene.probes[0]" };
    (void)state;
    char *errors = errors_of(BODIES("", ", held: perhaps") "  contacts: [{default: stik}]\n  boundary: {x: [a, free]}\n"
                                                           "  probes: [{name: p, forse: ball}]\n",
                             CASE_FOR_SCENE);
    for (size_t i = 0; i < sizeof after / sizeof *after; i++)
        if (!strstr(errors, after[i])) fail_msg("%s is not said in\n%s", after[i], errors);
    free(errors);
}

static const struct {
    const char *text, *error; /* all of it */
} unmakable[] = {
    { BODIES(", held: yes, velocity: 0 0 1 m/s", ""),
      "case.yaml:5:108: scene.bodies[0].velocity = 0 0 1 m/s: body `wall` is held: it can have no velocity, spin, "
      "body_force, traction, wave_pressure or piston\n" },
    { BODIES("", ", held: yes, body_force: [0 m/s2, 9.81 m/s2, 0 m/s2]"),
      "case.yaml:6:118: scene.bodies[1].body_force = [0 m/s2, 9.81 m/s2, 0 m/s2]: body `ball` is held: it can have no "
      "velocity, spin, body_force, traction, wave_pressure or piston\n" },
    { BODIES(", pressure: 3 MPa, held: yes", ""),
      "case.yaml:5:97: scene.bodies[0].pressure = 3 MPa: body `wall` is held: it can have no pressure at the start, "
      "and has 3e+06 Pa\n" },
    { BODIES(", pressure: -900 GPa", ""),
      "case.yaml:5:97: scene.bodies[0].pressure = -900 GPa: body `wall`: at 293 K" },
    { BODIES(", wave_pressure: 3 MPa", ""),
      "case.yaml:5:102: scene.bodies[0].wave_pressure = 3 MPa: body `wall` of ofhc_copper: a wave enters fluids only "
      "(strength: none)\n" },
    { BODIES(", wave_decay: 3 us", ""),
      "case.yaml:5:99: scene.bodies[0].wave_decay = 3 us: body `wall`: wave_decay = 3e-06 s, but no wave_pressure\n" },
    { BODIES(", tube_length: 1 m", ""),
      "case.yaml:5:100: scene.bodies[0].tube_length = 1 m: body `wall`: a piston wants all of piston_mass, "
      "piston_velocity and tube_length\n" },
    { BODIES(", group: a, held: yes", ", group: a"),
      "case.yaml:6:102: scene.bodies[1].group = a: bodies `wall` and `ball` are one group, but one of them is held: "
      "give it a group of its own and a contact\n" },
    { BODIES(", group: a, passes: [-x]", ", group: a"), "case.yaml:6:102: scene.bodies[1].group = a: bodies `wall` and "
                                                        "`ball` are one group, but different boundaries act "
                                                        "on them\n" },
    { TWO "  contacts: [{default: stick}, {between: [wall, ball], law: stick}, {between: [ball, wall], law: stick}]\n",
      "case.yaml:7:79: scene.contacts[2].between = [ball, wall]: pairs 0 and 1 name the same two groups, 0 and 1: one "
      "contact is enough for two\n" },
    { TWO "  transfer: pic\n  courant: 0.55\n",
      "case.yaml:8:12: scene.courant = 0.55: must be in (0, 0.5], beyond which pic is not stable\n" },
    { TWO "  levels: 2\n  cavities: [{name: gas, place: -1 0 0 mm}]\n",
      "case.yaml:7:11: scene.levels = 2: a scene with cavities has cells of one size: `levels: 1`, and no `refine`\n" },
    { TWO "  cavities: [{name: gas, place: -1 0 0 mm, pressure: -1 MPa}]\n",
      "case.yaml:7:54: scene.cavities[0].pressure = -1 MPa: cavity `gas`: its gas has no pressure of -898675 Pa at "
      "293.15 K\n" },
};

static void test_unmakable(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof unmakable / sizeof *unmakable; i++) {
        char *errors = errors_of(unmakable[i].text, CASE_FOR_SCENE);
        if (strncmp(errors, unmakable[i].error, strlen(unmakable[i].error)) != 0)
            fail_msg("case %zu: %s\nnot: %s", i, errors, unmakable[i].error);
        free(errors);
    }
    /* both, and each at its place */
    char *errors = errors_of(BODIES(", held: yes, spin: 1 0 0 rad/s", ", wave_decay: 1 us"), CASE_FOR_SCENE);
    assert_non_null(strstr(errors, "case.yaml:5:104: scene.bodies[0].spin = "));
    assert_non_null(strstr(errors, "case.yaml:6:107: scene.bodies[1].wave_decay = "));
    free(errors);
}

/* `breech strike` says how fast the piston is; of a scene's own the velocity is wanted. */
static void test_driven(void **state)
{
    (void)state;
    static const char strike[] = "strike: {projectile: water, velocity: 20 m/s}\n";
    static const char scene[] = HEAD
        "  bodies:\n    - " BOX "\n    - {name: water, material: water, shape: {box: {lo: -9 0 0 mm, hi: 0 4 4 mm}},"
        " piston_mass: 70 kg/m2, tube_length: 1 m}\n";
    char text[1000], *errors = errors_of(scene, CASE_FOR_SCENE);
    assert_non_null(strstr(errors, "scene.bodies[1].piston_mass = 70 kg/m2: body `water`: a piston wants all"));
    free(errors);
    snprintf(text, sizeof text, "%s%s", scene, strike);
    breech_case *c = read_good(text);
    assert_true(isnan(c->bodies.scene.body[1].piston_velocity));
    case_free(c);
}

/* ---- probes: one of every kind, by its table ---- */

/* A value that any kind should take: corners in the lower and the upper half of the scene, an axis, a length, a
 * velocity. */
static const char *any_value(const base_param *p)
{
    if (p->kind != BASE_PARAM_VECTOR) return strcmp(p->unit, "m/s") == 0 ? "500 m/s" : "0.5 mm";
    if (p->unit[0] == '1') return "0 1 0";
    return strcmp(p->key, "lo") == 0 ? "-3 -1 -1 mm" : strcmp(p->key, "hi") == 0 ? "3 5 5 mm" : "0.1 2 2 mm";
}

static void add_probe(char *text, size_t size, const mpm_probe_kind *k)
{
    size_t at = strlen(text);
    at += (size_t)snprintf(text + at, size - at, "    - {name: a_%s, %s: {body: wall", k->name, k->name);
    for (const base_param *p = k->params; p->key; p++)
        if (isinf(p->fallback)) at += (size_t)snprintf(text + at, size - at, ", %s: %s", p->key, any_value(p));
    snprintf(text + at, size - at, "}}\n");
}

/* The scene has no cavity that a probe could read. */
static bool fits(const mpm_probe_kind *k)
{
    return strcmp(k->name, "cavity") != 0;
}

#define EVERY_PROBE_SIZE 6000
static void every_probe(char text[EVERY_PROBE_SIZE])
{
    snprintf(text, EVERY_PROBE_SIZE, "%s",
             TWO "  cell: 0.4 mm\n  contacts: [{default: coulomb, friction: 0.1}]\n  probes:\n");
    for (int i = 0; mpm_probe_kind_at(i); i++) /* the scene has no cavity */
        if (strcmp(mpm_probe_kind_at(i)->name, "cavity") != 0) add_probe(text, EVERY_PROBE_SIZE, mpm_probe_kind_at(i));
}

/* Every kind is read with what its own table asks for, and printed so that the same comes back. */
static void test_every_probe(void **state)
{
    (void)state;
    char text[EVERY_PROBE_SIZE];
    every_probe(text);
    breech_case *c = read_good(text);
    OK(scene_fill(&c->bodies.scene));
    char *used = used_text(c);
    breech_case *back = read_good(used);
    char *again = used_text(back);
    assert_string_equal(used, again);
    int n = 0;
    for (int i = 0; mpm_probe_kind_at(i); i++) {
        const mpm_probe_kind *k = mpm_probe_kind_at(i);
        if (!fits(k)) continue;
        const mpm_probe *a = &c->bodies.scene.probe[n], *b = &back->bodies.scene.probe[n];
        n++;
        assert_true(a->kind == k && b->kind == k && a->body == 0 && b->body == 0);
        assert_string_equal(a->name, b->name);
        assert_memory_equal(a->value, b->value, sizeof a->value);
        for (const base_param *p = k->params; p->key; p++)
            if (isinf(p->fallback)) {
                char missing[200], *errors = NULL;
                breech_case *bad = NULL;
                snprintf(text, sizeof text, TWO "  probes: [{name: a, %s: {body: wall}}]\n", k->name);
                assert_int_equal(read_text(text, CASE_FOR_SCENE, &bad, &errors).code, STATUS_BAD_INPUT);
                snprintf(missing, sizeof missing, "scene.probes[0].%s.%s is missing", k->name, p->key);
                assert_non_null(strstr(errors, missing));
                free(errors);
            }
    }
    assert_int_equal(c->bodies.scene.probes, n);
    free(used), free(again);
    case_free(back), case_free(c);
}

/* The other ways to say it. */
static void test_probe_forms(void **state)
{
    (void)state;
    breech_case *c = read_good(TWO "  probes: [{name: a, force_on: ball}, {name: b, force: ball}, {name: c, energy: }, "
                                   "{name: d, energy: {}}]\n");
    const mpm_probe *p = c->bodies.scene.probe;
    for (int i = 0; i < 2; i++) assert_true(strcmp(p[i].kind->name, "force") == 0 && p[i].body == 1);
    for (int i = 2; i < 4; i++) assert_true(strcmp(p[i].kind->name, "energy") == 0 && p[i].body == -1);
    case_free(c);
}

/* ---- any scene as text ---- */

static mpm *made(const mpm_scene *s)
{
    mpm *m = NULL;
    OK(mpm_create(s, 2, &m));
    OK(mpm_advance(m, s->end_time, NULL));
    return m;
}

static void assert_same_state(const mpm *a, const mpm *b)
{
    const size_t n = mpm_points(a);
    assert_int_equal(n, mpm_points(b));
    double *x = malloc(2 * 6 * n * sizeof *x), *y = x + 6 * n;
    assert_non_null(x);
    static const mpm_field fields[] = { MPM_position, MPM_velocity, MPM_stress, MPM_energy, MPM_body };
    for (size_t f = 0; f < sizeof fields / sizeof *fields; f++) {
        mpm_read(a, fields[f], x);
        mpm_read(b, fields[f], y);
        assert_memory_equal(x, y, n * (size_t)mpm_field_table[fields[f]].width * sizeof *x);
    }
    free(x);
}

/* The armature over its grain, written as bodies and read back, computes the same bits; so do a pit and a layer. */
static void test_gouging_as_text(void **state)
{
    (void)state;
    if (!heavy_tests()) skip();
    static const char *const variants[][2] = {
        { "scene.levels=2", "particle.shape=hemisphere" },
        { "scene.levels=1", "particle.shape=sphere" },
        { "rail.layers=[{material: steel_4340, thickness: 0.4 mm, bond_strength: 1 GPa}]", "particle.shape=pit" }
    };
    for (int k = 0; k < 3; k++) {
        const char *const sets[] = { variants[k][0],
                                     variants[k][1],
                                     "scene.velocity=1.6 km/s",
                                     "scene.end_time=0.3 us",
                                     "scene.contact_pressure=50 MPa",
                                     "scene.cells_per_radius=1.5" };
        const case_options how = { dirs, 1, CASE_FOR_SCENE };
        breech_case *c = NULL;
        char *errors = NULL, *text = NULL;
        size_t bytes;
        gouge_scene g;
        const status s = case_read(BREECH_TESTS "/../cases/default_shot", sets, 6, &how, &c, &errors);
        if (s.code != STATUS_OK) fail_msg("%s", errors ? errors : s.text);
        const case_impact one = case_inputs_of(c).onset.impact;
        OK(gouge_scene_bodies(&one, &g));
        FILE *f = open_memstream(&text, &bytes);
        OK(case_write_scene(c, &g.scene, f));
        fclose(f);
        breech_case *back = read_good(text);
        OK(scene_fill(&back->bodies.scene));
        mpm *a = made(&g.scene), *b = made(&back->bodies.scene);
        assert_same_state(a, b);
        mpm_free(a), mpm_free(b);
        free(text);
        mpm_scene_free(&g.scene);
        case_free(back), case_free(c);
    }
}

/* ---- running ---- */

typedef struct {
    int left; /* steps until it is asked to stop; below 0: never */
    void *image;
    size_t bytes;
    double time;
} stopping;

static bool stop_soon(void *user)
{
    stopping *s = user;
    return s->left >= 0 && s->left-- == 0;
}

static status keep(void *user, const char *scene, const scene_now *now)
{
    (void)scene;
    stopping *s = user;
    s->time = mpm_glance(now->m).time;
    return scene_image(now, &s->image, &s->bytes);
}

static status run(const mpm_scene *s, history *h, stopping *stop, const scene_resume *from, scene_bodies_result *out)
{
    const scene_job job = { .name = "scene",
                            .task = "test",
                            .scene = s,
                            .checkpoint_interval = 1e6,
                            .last_time = s->end_time,
                            .resume = from ? *from : (scene_resume){ .image = NULL } };
    const scene_host host = { .history = h, .threads = 2, .stop = stop_soon, .save = keep, .user = stop };
    return scene_bodies_run(&job, &host, out);
}

static double *column(history *h, const char *name, size_t *n)
{
    h5_file *file;
    double *data;
    size_t dims[H5_MAX_RANK];
    char path[100];
    snprintf(path, sizeof path, "/scene/%s", name);
    OK(host_h5_create(&file));
    OK(output_history_export(h, "scene", file));
    OK(host_h5_read(file, path, &data, dims));
    host_h5_close(file);
    *n = dims[0];
    return data;
}

static void assert_same_column(history *a, history *b, const char *name, size_t rows)
{
    size_t n, m;
    double *x = column(a, name, &n), *y = column(b, name, &m);
    assert_int_equal(n, rows);
    assert_int_equal(m, rows);
    assert_memory_equal(x, y, n * sizeof *x);
    free(x), free(y);
}

/* All that the probes wrote is there, as often as it should be, and the same of both runs. */
static void check_probes(const mpm_scene *s, history *const h[2], const scene_bodies_result r[2], size_t pieces)
{
    for (int i = 0; i < s->probes; i++) {
        const mpm_probe *p = &s->probe[i];
        const bool map = mpm_probe_rows(p) > 1;
        const size_t rows = map ? pieces : r[0].steps + 1; /* a step is longer than a thousandth of this scene's time */
        char name[200];
        snprintf(name, sizeof name, "probes/%s/time", p->name);
        assert_same_column(h[0], h[1], name, rows);
        for (const mpm_column *k = p->kind->columns; k->name; k++) {
            snprintf(name, sizeof name, "probes/%s/%s", p->name, k->name);
            assert_same_column(h[0], h[1], name, rows);
        }
        const bool none = strcmp(p->kind->name, "cavity") == 0; /* the scene has none */
        const scene_probe_result *is = &r[0].probe[i];
        assert_string_equal(is->name, p->name);
        assert_string_equal(is->kind, p->kind->name);
        assert_int_equal(is->columns, map ? 0 : mpm_probe_columns(p));
        assert_int_equal(isnan(is->peak), p->kind->mains == 0 || none);
        for (int c = 0; c < is->columns && !none; c++) assert_false(isnan(is->last[c]) || isnan(is->mean[c]));
        assert_memory_equal(is, &r[1].probe[i], sizeof *is);
    }
}

static const scene_probe_result *result_named(const scene_bodies_result *r, const char *name)
{
    for (int i = 0; i < r->probes; i++)
        if (strcmp(r->probe[i].name, name) == 0) return &r->probe[i];
    fail_msg("no probe %s", name);
    return NULL;
}

/* Each kind's summary against what the bodies' own sums say at the end. */
static void check_sums(const scene_bodies_result *r)
{
    const scene_body *wall = &r->body[0];
    const scene_probe_result *force = result_named(r, "a_force"), *motion = result_named(r, "a_motion");
    const scene_probe_result *energy = result_named(r, "a_energy"), *plastic = result_named(r, "a_plastic");
    assert_true(force->arrival > 0.0 && force->arrival <= force->peak_time && force->peak > 0.0);
    assert_string_equal(force->quantity, "force");
    assert_string_equal(force->unit, "N");
    /* what the wall got by contact is its momentum: no other force acts on it, nothing of it has left */
    assert_true(fabs(force->impulse[0] / (wall->mass * wall->velocity[0]) - 1.0) < 1e-6);
    assert_string_equal(motion->quantity, "velocity");
    assert_true(fabs(motion->last[4] / wall->velocity[0] - 1.0) < 1e-9);
    assert_true(motion->peak >= motion->last[4]);
    assert_true(fabs(energy->last[1] / wall->internal - 1.0) < 1e-9);
    assert_true(fabs(force->mean[0] * r->end_time / force->impulse[0] - 1.0) < 1e-9);
    assert_true(r->peak_pressure > 0.0 && r->peak_pressure <= 1.01 * r->max_pressure); /* 1 %: the histogram's bins */
    assert_true(r->peak_pressure == fmax(wall->peak_pressure, r->body[1].peak_pressure));
    assert_true(plastic->peak > 0.0 && plastic->impulse[0] > 0.0 && isnan(plastic->impulse[1]));
    assert_true(plastic->impulse[0] < 1.2 * wall->internal); /* plastic work is part of it */
}

/* In a scene of more than a thousand steps only what is about a step has a row for each: force; the others are read at
 * most a thousand times and at the ends of pieces. */
static void test_samples(void **state)
{
    (void)state;
    breech_case *c =
        read_good(TWO "  cell: 0.4 mm\n  probes: [{name: push, force: wall}, {name: heat, energy: wall}]\n");
    mpm_scene *s = &c->bodies.scene;
    s->end_time = 1.5e-6, s->courant = 0.01;
    OK(scene_fill(s));
    history *h, *resumed;
    scene_bodies_result r, again;
    stopping never = { .left = -1 }, soon = { .left = 702 };
    size_t n, m;
    OK(output_history_open(NULL, false, &h));
    OK(run(s, h, &never, NULL, &r));
    double *time = column(h, "probes/heat/time", &n);
    free(column(h, "probes/push/time", &m));
    assert_true(r.steps > 1500);
    assert_int_equal(m, r.steps + 1);
    assert_true(n > 500 && n <= 1061);
    assert_true(time[0] == 0.0 && time[n - 1] == r.end_time);
    free(time);
    OK(output_history_open(NULL, false, &resumed)); /* stopped between two readings, it goes on with the same ones */
    assert_int_equal(run(s, resumed, &soon, NULL, &again).code, STATUS_STOPPED);
    scene_bodies_free(&again);
    OK(run(s, resumed, &never, &(scene_resume){ soon.image, soon.bytes, soon.time, 0.0 }, &again));
    assert_same_column(h, resumed, "probes/heat/time", n);
    assert_same_column(h, resumed, "probes/push/time", m);
    scene_bodies_free(&r), scene_bodies_free(&again);
    free(soon.image);
    OK(output_history_close(h));
    OK(output_history_close(resumed));
    case_free(c);
}

/* Motion of the bodies adds up to the model's, in every row; a run that was stopped and resumed has the same rows and
 * the same result. */
static void test_run(void **state)
{
    (void)state;
    char text[EVERY_PROBE_SIZE];
    every_probe(text);
    breech_case *c = read_good(text);
    mpm_scene *s = &c->bodies.scene;
    s->end_time = 3e-6;
    OK(scene_fill(s));
    history *h[2];
    scene_bodies_result r[2], none;
    for (int i = 0; i < 2; i++) OK(output_history_open(NULL, false, &h[i]));
    stopping never = { .left = -1 }, soon = { .left = 7 };
    OK(run(s, h[0], &never, NULL, &r[0]));
    assert_int_equal(run(s, h[1], &soon, NULL, &none).code, STATUS_STOPPED);
    scene_bodies_free(&none);
    const scene_resume from = { soon.image, soon.bytes, soon.time, 0.0 };
    OK(run(s, h[1], &never, &from, &r[1]));
    assert_int_equal(r[0].bodies, 2);
    assert_string_equal(r[0].body[1].name, "ball");
    assert_true(r[0].body[0].velocity[0] > 0.0 && r[0].body[1].velocity[0] < 300.0); /* it pushed the wall */
    assert_true(fabs(r[0].energy_error) < 0.01 && r[0].momentum_error < 1e-9);
    assert_memory_equal(r[0].body, r[1].body, 2 * sizeof *r[0].body);
    check_sums(&r[0]);
    size_t n, m;
    double *total = column(h[0], "momentum_x", &n), *sum = calloc(n, sizeof *sum);
    check_probes(s, h, r, n);
    static const char *const names[] = { "wall", "ball" };
    for (int b = 0; b < 2; b++) {
        char path[60];
        snprintf(path, sizeof path, "bodies/%s/mass", names[b]);
        double *mass = column(h[0], path, &m);
        snprintf(path, sizeof path, "bodies/%s/velocity_x", names[b]);
        double *v = column(h[0], path, &m), *again = column(h[1], path, &m);
        assert_int_equal(m, n);
        assert_memory_equal(v, again, n * sizeof *v);
        for (size_t i = 0; i < n; i++) sum[i] += mass[i] * v[i];
        free(mass), free(v), free(again);
    }
    assert_true(n > 30);
    for (size_t i = 0; i < n; i++) assert_true(fabs(sum[i] / total[i] - 1.0) < 1e-9);
    free(total), free(sum), free(soon.image);
    for (int i = 0; i < 2; i++) {
        scene_bodies_free(&r[i]);
        OK(output_history_close(h[i]));
    }
    case_free(c);
}

extern const study study_bodies;

/* The page of a scene with every kind of probe: its bodies in a table, the curves of each quantity, the map. */
static void test_report(void **state)
{
    (void)state;
    char text[EVERY_PROBE_SIZE], *page, row[160];
    every_probe(text);
    breech_case *c = read_good(text);
    mpm_scene *s = &c->bodies.scene;
    OK(scene_fill(s));
    history *h;
    scene_bodies_result r;
    stopping never = { .left = -1 };
    assert_int_equal(system("rm -rf page && mkdir page"), 0);
    OK(output_history_open("page/history.h5", false, &h));
    OK(run(s, h, &never, NULL, &r));
    OK(output_history_close(h));
    run_summary summary = study_summary(&study_bodies, &(study_answer){ .result = &r });
    summary.case_name = "page";
    OK(output_summary_write("page", &summary));
    char *used = used_text(c);
    OK(host_file_write("page/used.yaml", used, strlen(used)));
    OK(report_write("page", study_report_kind));
    OK(host_file_read("page/report.html", &page, NULL));
    assert_int_equal(text_count(page, "breech scene &middot;"), 1); /* the command, not the kind `bodies` */
    assert_int_equal(text_count(page, "<h2>Bodies at the end</h2>"), 1);
    assert_int_equal(text_count(page, "<h2>Probes</h2>"), 1);
    for (int i = 0; i < s->bodies; i++) {
        snprintf(row, sizeof row, "<td class=\"text\" data-title=\"body\">%s</td>", s->body[i].name);
        assert_int_equal(text_count(page, row), 1);
    }
    int quantities = 0, maps = 0;
    for (int i = 0; i < r.probes; i++) {
        snprintf(row, sizeof row, "<td class=\"text\" data-title=\"probe\">%s</td>", r.probe[i].name);
        assert_int_equal(text_count(page, row), 1);
        bool met = false;
        for (int k = 0; k < i; k++)
            met = met || (strcmp(r.probe[k].quantity, r.probe[i].quantity) == 0 &&
                          strcmp(r.probe[k].unit, r.probe[i].unit) == 0);
        maps += r.probe[i].columns == 0;
        quantities += r.probe[i].columns > 0 && !met;
    }
    assert_int_equal(text_count(page, "<svg"), 2 + quantities + maps); /* 2: speeds and energies */
    assert_int_equal(text_count(page, "class=\"missing\""), 0);
    /* integrals over time: of a force an impulse, of a velocity a way, of an energy none */
    assert_true(text_count(page, "N s</td>") > 0);
    assert_true(text_count(page, "m</td>") > 0);
    assert_int_equal(text_count(page, "m/s s") + text_count(page, "J s"), 0);
    assert_int_equal(text_count(page, ">a map</td>"), maps);
    assert_string_equal(output_unit_over_time("m/s"), "m");
    assert_null(output_unit_over_time("J"));
    char *table = NULL;
    size_t size;
    FILE *out = open_memstream(&table, &size);
    study_bodies.print(&r, out);
    fclose(out);
    assert_int_equal(text_count(table, "beside one mirror half of the whole"), 1);
    free(table);
    free(page), free(used);
    scene_bodies_free(&r);
    case_free(c);
}

/* The case that the manual shows. */
static void test_example(void **state)
{
    (void)state;
    const case_options how = { dirs, 1, CASE_FOR_SCENE };
    breech_case *c = NULL;
    char *errors = NULL;
    const status s = case_read(BREECH_TESTS "/../cases/sphere_plate", NULL, 0, &how, &c, &errors);
    if (s.code != STATUS_OK) fail_msg("%s", errors ? errors : s.text);
    mpm_needs needs;
    OK(scene_fill(&c->bodies.scene));
    OK(mpm_estimate(&c->bodies.scene, &needs));
    assert_true(needs.particles > 1e4 && needs.particles < 5e5);
    case_free(c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_minimal),
        cmocka_unit_test(test_cell_of_rules),
        cmocka_unit_test(test_keys),
        cmocka_unit_test(test_groups),
        cmocka_unit_test(test_every_shape),
        cmocka_unit_test(test_every_contact),
        cmocka_unit_test(test_every_boundary),
        cmocka_unit_test(test_old_keys),
        cmocka_unit_test(test_tree),
        cmocka_unit_test(test_refused),
        cmocka_unit_test(test_all_at_once),
        cmocka_unit_test(test_unmakable),
        cmocka_unit_test(test_driven),
        cmocka_unit_test(test_every_probe),
        cmocka_unit_test(test_probe_forms),
        cmocka_unit_test(test_gouging_as_text),
        cmocka_unit_test(test_run),
        cmocka_unit_test(test_samples),
        cmocka_unit_test(test_report),
        cmocka_unit_test(test_example),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
