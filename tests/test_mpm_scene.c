/* SPDX-License-Identifier: BSD-3-Clause */
/* A scene as data: its arrays, its tables of members, its key; and what the solver says when memory ends. */
#include "mpm/memory/store.h"
#include "mpm_scenes.h"

/* Two groups, a pair, two solids: something of everything. */
static void some_scene(mpm_scene *s, const mpm_material *m)
{
    scene_bar(s, 0, 12e-3, 0.5e-3, 2);
    scene_box(s, 2e-3, -1, -1, 6e-3, 1, 1, m);
    scene_box(s, 6e-3, -1, -1, 10e-3, 1, 1, m)->group = 1;
    scene_pair(s, 0, 1)[COULOMB_FRICTION] = 0.3;
    for (int i = 0; mpm_refine_kind_at(i); i++) {
        mpm_refine *r;
        assert_ok(mpm_scene_add_refine(s, mpm_refine_kind_at(i)->name, &r));
        r->body = 0;
    }
}

/* ---- the key ---- */

static void change(const base_param *p, char *member)
{
    switch (p->kind) {
    case BASE_PARAM_NUMBER:
    case BASE_PARAM_VECTOR:
    case BASE_PARAM_POINTS: {
        double *x = (double *)(void *)member;
        x += p->kind == BASE_PARAM_VECTOR ? 2 : 0;
        *x = isnan(*x) ? 1 : nextafter(*x, INFINITY);
        break;
    }
    case BASE_PARAM_INTEGER:
    case BASE_PARAM_CHOICE: ++*(int *)(void *)member; break;
    case BASE_PARAM_FLAG: *(bool *)(void *)member = !*(bool *)(void *)member; break;
    case BASE_PARAM_TEXT: member[0] = member[0] == 'x' ? 'y' : 'x'; break;
    }
}

/* Each member of a struct of the scene by itself: the key changes, from row `hashed` on, and is again what it was. */
static int walk_from(int hashed, const mpm_scene *s, const base_param *table, void *object, size_t size)
{
    char *kept = malloc(size);
    const uint64_t key = mpm_scene_hash(s);
    int n = 0;
    assert_non_null(kept);
    memcpy(kept, object, size);
    for (const base_param *p = table; p->key; p++, n++) {
        const bool counts = n >= hashed;
        change(p, (char *)object + p->offset);
        if ((mpm_scene_hash(s) != key) != counts) fail_msg("%s: the key %s", p->key, counts ? "stays" : "changes");
        memcpy(object, kept, size);
        assert_true(mpm_scene_hash(s) == key);
    }
    free(kept);
    return n;
}

static int walk(const mpm_scene *s, const base_param *table, void *object, size_t size)
{
    return walk_from(0, s, table, object, size);
}

static void test_key(void **state)
{
    (void)state;
    mpm_material m = scene_copper();
    SCENE_LOCAL(s);
    some_scene(&s, &m);
    assert_string_equal(mpm_scene_params[MPM_SCENE_HASHED - 1].key, "end_time");
    int n = walk_from(MPM_SCENE_HASHED, &s, mpm_scene_params, &s, sizeof s);
    n += walk(&s, s.contact.law->params, &s.contact, sizeof s.contact);
    n += walk(&s, mpm_material_params, &m, sizeof m);
    for (int k = 0; k < 3; k++) n += walk(&s, mpm_axis_params, &s.axis[k], sizeof s.axis[k]);
    for (int i = 0; i < s.bodies; i++) n += walk(&s, mpm_body_params, &s.body[i], sizeof s.body[i]);
    for (int i = 0; i < s.pairs; i++) {
        n += walk(&s, mpm_pair_params, &s.pair[i], sizeof s.pair[i]);
        n += walk(&s, s.pair[i].contact.law->params, &s.pair[i].contact, sizeof s.pair[i].contact);
    }
    for (int i = 0; i < s.solids; i++)
        n += walk(&s, s.solid[i].kind->params, s.solid[i].value, sizeof s.solid[i].value);
    for (int i = 0; i < s.refines; i++)
        n += walk(&s, s.refine[i].kind->params, s.refine[i].value, sizeof s.refine[i].value);
    const uint64_t key = mpm_scene_hash(&s);
    const mpm_contact stuck = mpm_contact_of(mpm_contact_find("stick")), kept = s.pair[0].contact;
    s.pair[0].contact = stuck;
    assert_true(mpm_scene_hash(&s) != key);
    s.pair[0].contact = kept;
    s.solid[1].part[0] = 1;
    assert_true(mpm_scene_hash(&s) != key);
    print_message("%d members\n", n);
    assert_true(n > 100);
}

/* A member that no table has: a run of its struct that no row covers, longer than what lies between two members.  What
 * is said elsewhere (pointers, nested structs) is named. */
static void covered(const char *what, const base_param *const *tables, size_t size, const size_t (*known)[2])
{
    char *seen = calloc(size, 1);
    assert_non_null(seen);
    for (; *tables; tables++)
        for (const base_param *p = *tables; p->key; p++) {
            const size_t bytes = p->kind == BASE_PARAM_NUMBER   ? sizeof(double)
                                 : p->kind == BASE_PARAM_VECTOR ? 3 * sizeof(double)
                                 : p->kind == BASE_PARAM_FLAG   ? sizeof(bool)
                                 : p->kind == BASE_PARAM_TEXT   ? BASE_PARAM_TEXT_SIZE
                                                                : sizeof(int);
            memset(seen + p->offset, 1, bytes);
        }
    for (; (*known)[1]; known++) memset(seen + (*known)[0], 1, (*known)[1]);
    size_t run = 0;
    for (size_t i = 0; i < size; i++) {
        run = seen[i] ? 0 : run + 1;
        if (run >= sizeof(double)) fail_msg("%s: no row has what lies at byte %zu", what, i - run + 1);
    }
    free(seen);
}

#define PLACE(type, member)                                 \
    {                                                       \
        offsetof(type, member), sizeof(((type *)0)->member) \
    }

static void test_tables(void **state)
{
    (void)state;
    static const size_t of_body[][2] = { PLACE(mpm_body, material), { 0, 0 } };
    static const size_t of_axis[][2] = { { 0, 0 } };
    static const size_t of_pair[][2] = { PLACE(mpm_pair, contact), { 0, 0 } };
    static const size_t of_scene[][2] = {
        PLACE(mpm_scene, bodies),   PLACE(mpm_scene, solids),  PLACE(mpm_scene, pairs),
        PLACE(mpm_scene, body),     PLACE(mpm_scene, solid),   PLACE(mpm_scene, pair),
        PLACE(mpm_scene, axis),     PLACE(mpm_scene, contact), PLACE(mpm_scene, probes),
        PLACE(mpm_scene, probe),    PLACE(mpm_scene, refines), PLACE(mpm_scene, refine),
        PLACE(mpm_scene, cavities), PLACE(mpm_scene, cavity),  { 0, 0 }
    };
    covered("mpm_body", (const base_param *const[]){ mpm_body_params, NULL }, sizeof(mpm_body), of_body);
    covered("mpm_axis", (const base_param *const[]){ mpm_axis_params, NULL }, sizeof(mpm_axis), of_axis);
    covered("mpm_pair", (const base_param *const[]){ mpm_pair_params, NULL }, sizeof(mpm_pair), of_pair);
    static const size_t of_cavity[][2] = { { 0, 0 } };
    covered("mpm_cavity", (const base_param *const[]){ mpm_cavity_params, NULL }, sizeof(mpm_cavity), of_cavity);
    covered("mpm_scene", (const base_param *const[]){ mpm_scene_params, NULL }, sizeof(mpm_scene), of_scene);
}

/* ---- levels that the scene leaves open ---- */

static void test_levels(void **state)
{
    (void)state;
    const mpm_material m = scene_copper();
    SCENE_LOCAL(s);
    mpm *solver;
    scene_bar(&s, 0, 12e-3, 0.5e-3, 2);
    scene_box(&s, 2e-3, -1, -1, 6e-3, 1, 1, &m);
    for (int k = 0; k < 3; k++) s.axis[k].coarse = 4.1 * s.axis[k].fine;
    const mpm_scene open = s; /* borrows its arrays */
    assert_true(open.levels == 0 && isnan(open.zone_until));
    mpm_scene_levels_fill(&s);
    assert_true(s.levels == 1 && s.zone_until > 1e3); /* no rules: one grid */
    assert_ok(mpm_create(&open, 1, &solver));
    assert_true(mpm_scene_of(solver)->levels == 1);
    mpm_free(solver);
    s.levels = open.levels, s.zone_until = open.zone_until;
    mpm_refine *rule;
    assert_ok(mpm_scene_add_refine(&s, "plastic", &rule));
    mpm_scene filled = s;
    mpm_scene_levels_fill(&filled);
    assert_true(filled.levels == 3 && filled.zone_until == 0); /* fine, 2 and 4 times as large */
    filled = s, filled.axis[1].fine *= 2; /* of 0.5 mm along x and z, 1 mm along y, and 2.05 mm at most */
    mpm_scene_levels_fill(&filled);
    assert_int_equal(filled.levels, 2);
    filled = s, filled.basis = MPM_BASIS_BSPLINE;
    mpm_scene_levels_fill(&filled);
    assert_int_equal(filled.levels, 1); /* which has no levels */
    filled = s, filled.levels = 2, filled.zone_until = 1e-6;
    mpm_scene_levels_fill(&filled);
    assert_true(filled.levels == 2 && filled.zone_until == 1e-6);
}

/* ---- arrays ---- */

/* A copy has arrays of its own, which grow by themselves. */
static void test_copy(void **state)
{
    (void)state;
    const mpm_material m = scene_copper();
    SCENE_LOCAL(a);
    SCENE_LOCAL(b);
    some_scene(&a, &m);
    assert_ok(mpm_scene_copy(&a, &b));
    assert_true(mpm_scene_hash(&a) == mpm_scene_hash(&b));
    for (int i = 0; i < 40; i++) scene_box(&b, 0, 0, 0, 1, 1, 1, &m)->group = i;
    assert_int_equal(mpm_scene_groups(&b), 40);
    b.body[0].velocity[0] = 7;
    assert_int_equal(a.bodies, 2);
    assert_true(a.body[0].velocity[0] == 0 && a.solids == 2 && b.solids == 42);
    assert_true(b.body[41].material == &m && b.body[41].temperature == 293 && b.body[41].yield_scale == 1);
    const mpm_pair other = mpm_scene_contact(&b, 5, 3), own = mpm_scene_contact(&b, 1, 0);
    assert_true(other.normal_of == 3 && other.contact.value[COULOMB_FRICTION] == 0);
    assert_true(own.normal_of == 0 && own.contact.value[COULOMB_FRICTION] == 0.3);
}

/* ---- memory ---- */

/* A list of movers that cannot grow: the step fails, no point stays in a cell that it has left. */
static void test_no_memory(void **state)
{
    (void)state;
    const mpm_material m = scene_copper();
    SCENE_LOCAL(s);
    some_scene(&s, &m);
    s.body[0].velocity[0] = 100;
    mpm *solver = scene_make(&s, 1);
    assert_ok(mpm_advance(solver, 1e-6, NULL));
    solver->movers[0].capacity = -5000;
    const status no = mpm_advance(solver, 20e-6, NULL);
    assert_int_equal(no.code, STATUS_MEMORY);
    assert_non_null(strstr(no.text, "memory"));
    mpm_free(solver);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_key),  cmocka_unit_test(test_tables),    cmocka_unit_test(test_levels),
        cmocka_unit_test(test_copy), cmocka_unit_test(test_no_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
