/* SPDX-License-Identifier: BSD-3-Clause */
/* The same bits on any number of threads and across save and restore; images of anything else are refused.
 *
 * No tolerance anywhere: arrays are compared byte by byte. */
#include "mpm/memory/store.h"
#include "mpm_scenes.h"

static const double H = 0.3e-3, SPEED = 1500;

/* Blocks beyond those that the points of each body need in their cells. */
static int spare_blocks(const mpm *m)
{
    int spare = 0;
    for (int i = 0; i < m->bricks_used; i++)
        for (int c = 0; c < BRICK_CELLS; c++) {
            int points[3] = { 0 };
            for (int q = m->bricks[i].head[c]; q >= 0; q = m->links[q].next) {
                points[m->links[q].body] += __builtin_popcount(m->links[q].mask);
                spare++;
            }
            for (int body = 0; body < m->scene.bodies; body++) spare -= (points[body] + LANES - 1) / LANES;
        }
    return spare;
}

static void test_threads(void **state)
{
    (void)state;
    GOUGE_LOCAL(g);
    scene_gouge(&g, H, SPEED);
    scene_picture one = { 0, NULL };
    for (int threads = 1; threads <= 3; threads++) {
        mpm *m = scene_make(&g.scene, threads);
        scene_steps(m, 120);
        scene_picture p = scene_picture_of(m);
        const mpm_report r = mpm_state(m);
        if (threads == 1) {
            one = p;
            print_message("%zu points, %llu splits, plastic strain %.2f\n", mpm_points(m), (unsigned long long)r.splits,
                          mpm_body_state(m, 0).peak_plastic_strain);
            assert_true(r.splits > 100); /* or the movers were hardly tried */
            assert_true(mpm_body_state(m, 0).peak_plastic_strain > 0.1);
            assert_int_equal(spare_blocks(m), 0);
        } else {
            scene_assert_same(one, p, threads == 2 ? "two threads" : "three threads");
            free(p.data);
        }
        mpm_free(m);
    }
    free(one.data);
}

typedef struct {
    mpm *m;
    bool change;
} thread_changer;

static bool change_threads(void *user, const mpm *m)
{
    static const int numbers[] = { 3, 1, 2, 2, 1, 1, 4, 3 };
    const thread_changer *c = user;
    const int step = (int)mpm_state(m).steps;
    if (c->change) mpm_set_threads(c->m, numbers[step % 8]);
    return step < 120;
}

/* Threads that come and go between two steps. */
static void test_threads_change(void **state)
{
    (void)state;
    GOUGE_LOCAL(g);
    scene_gouge(&g, H, SPEED);
    scene_picture p[2];
    for (int i = 0; i < 2; i++) {
        thread_changer c = { scene_make(&g.scene, 1), i == 1 };
        assert_int_equal(mpm_advance(c.m, 1.0, &(mpm_sink){ change_threads, &c }).code, STATUS_STOPPED);
        assert_int_equal(mpm_state(c.m).steps, 120);
        p[i] = scene_picture_of(c.m);
        mpm_free(c.m);
    }
    scene_assert_same(p[0], p[1], "threads that come and go");
    free(p[0].data), free(p[1].data);
}

/* The threads must have something to disagree about: another scene gives another picture. */
static void test_picture_sees(void **state)
{
    (void)state;
    GOUGE_LOCAL(g);
    scene_gouge(&g, H, SPEED);
    scene_picture p[2];
    for (int i = 0; i < 2; i++) {
        g.scene.body[2].velocity[0] = i ? nextafter(SPEED, 2000) : SPEED;
        mpm *m = scene_make(&g.scene, 1);
        scene_steps(m, 5);
        p[i] = scene_picture_of(m);
        mpm_free(m);
    }
    assert_int_equal(p[0].bytes, p[1].bytes);
    assert_true(memcmp(p[0].data, p[1].data, p[0].bytes) != 0);
    free(p[0].data), free(p[1].data);
}

/* Saved at step k and gone on from there in a fresh solver, with other threads: the bits of the run without a stop.
 * k early, within the percentile samples and on either side of the reordering of memory every 200 steps; the later ones
 * lie amid contact and splits.  The long part adds the start and three drawn at random once. */
static void test_restart(void **state)
{
    (void)state;
    static const int few[] = { 17, 148, 199, 200, 201 }, many[] = { 0, 1, 17, 83, 119, 148, 199, 200, 201 };
    enum { FEW = sizeof few / sizeof few[0], STOPS = sizeof many / sizeof many[0], LAST = 220 };
    const int *const stops = full_tests() ? many : few, count = full_tests() ? STOPS : FEW;
    GOUGE_LOCAL(g);
    scene_gouge(&g, H, SPEED);
    mpm *m = scene_make(&g.scene, 1);
    void *image[STOPS];
    size_t bytes[STOPS];
    int at = 0;
    for (int i = 0; i < count; i++) {
        scene_steps(m, stops[i] - at);
        at = stops[i];
        const mpm_report r = mpm_state(m);
        if (at > 50) assert_true(r.splits > 100 && mpm_contact_force(m, 0)[1] != 0);
        assert_ok(mpm_save(m, &image[i], &bytes[i]));
    }
    scene_steps(m, LAST - at);
    const scene_picture want = scene_picture_of(m);
    mpm_free(m);
    for (int i = 0; i < count; i++) {
        mpm *again = scene_make(&g.scene, 2);
        assert_ok(mpm_restore(again, image[i], bytes[i]));
        assert_int_equal(mpm_state(again).steps, stops[i]);
        scene_steps(again, LAST - stops[i]);
        const scene_picture got = scene_picture_of(again);
        char what[40];
        snprintf(what, sizeof what, "restarted at step %d", stops[i]);
        scene_assert_same(want, got, what);
        free(got.data);
        mpm_free(again);
        free(image[i]);
    }
    free(want.data);
}

/* The last step before `until` is cut short to end on it. */
static void test_stops_between(void **state)
{
    (void)state;
    GOUGE_LOCAL(g);
    scene_gouge(&g, H, SPEED);
    mpm *m = scene_make(&g.scene, 1);
    assert_ok(mpm_advance(m, 0.5e-6, NULL));
    assert_near(mpm_state(m).time, 0.5e-6, 1e-12 * 0.5e-6); /* the loop's own limit */
    mpm_free(m);
}

/* ---- refusals ---- */

static void refused(mpm *m, const void *image, size_t bytes, const char *what, const char *word)
{
    const status s = mpm_restore(m, image, bytes);
    if (s.code == STATUS_OK) fail_msg("%s was taken", what);
    if (!strstr(s.text, word)) fail_msg("%s: `%s` does not say `%s`", what, s.text, word);
}

static void test_refusals(void **state)
{
    (void)state;
    GOUGE_LOCAL(g);
    GOUGE_LOCAL(other);
    scene_gouge(&g, 2 * H, SPEED);
    mpm *m = scene_make(&g.scene, 1);
    scene_steps(m, 10);
    void *image;
    size_t bytes;
    assert_ok(mpm_save(m, &image, &bytes));
    mpm_free(m);

    for (int change = 0; change < 7; change++) {
        scene_gouge(&other, 2 * H, change == 0 ? 1501 : SPEED);
        switch (change) {
        case 1: other.copper.yield_A *= 1.01; break;
        case 2: other.scene.contact.value[COULOMB_FRICTION] = 0.21; break;
        case 3: other.scene.courant = 0.39; break;
        case 4: other.scene.axis[2].hi += 1e-6; break;
        case 5: scene_values(&other.scene, 1)[3] *= 1.001; break;
        case 6: other.scene.axis[0].boundary[1] = MPM_BOUNDARY_FREE; break;
        default: break;
        }
        m = scene_make(&other.scene, 1);
        refused(m, image, bytes, "an image of another scene", "scene");
        mpm_free(m);
    }

    /* cut anywhere: in the head, in the books, at every kilobyte or so of the bricks; each in a buffer of its own, so
     * that a sanitizer sees a read past its end */
    m = scene_make(&g.scene, 1);
    for (size_t cut = 0; cut < bytes; cut += cut < 4096 ? 97 : bytes / 37 + 1) {
        char *part = malloc(cut + 1);
        assert_non_null(part);
        memcpy(part, image, cut);
        assert_true(mpm_restore(m, part, cut).code != STATUS_OK);
        free(part);
    }
    char *longer = calloc(1, bytes + 64);
    assert_non_null(longer);
    memcpy(longer, image, bytes);
    refused(m, longer, bytes + 64, "an image with something behind it", "bytes");
    free(longer);
    ((char *)image)[0] ^= 1;
    refused(m, image, bytes, "an image of something else", "");
    mpm_free(m);
    free(image);
}

/* One binary and one instruction set: an image of the other set is refused, it could not go on with the same bits. */
static void test_instruction_sets(void **state)
{
    (void)state;
    GOUGE_LOCAL(g);
    scene_gouge(&g, 2 * H, SPEED);
    mpm *m = scene_make(&g.scene, 1);
    void *image;
    size_t bytes;
    assert_ok(mpm_save(m, &image, &bytes));
    mpm_free(m);
    strcpy(g.scene.instruction_set, "portable");
    m = scene_make(&g.scene, 1);
    if (strcmp(mpm_instruction_set(), "portable") != 0)
        refused(m, image, bytes, "an image of another instruction set", "portable");
    mpm_free(m);
    free(image);

    /* and the sets agree with each other to rounding that the flow has had 60 steps to spread: 1e-6 of the energy */
    static const char *const sets[] = { "x86-64-v4", "x86-64-v3", "portable" };
    double kinetic[3];
    int runs = 0;
    for (int i = 0; i < 3; i++) {
        strcpy(g.scene.instruction_set, sets[i]);
        if (mpm_create(&g.scene, 1, &m).code != STATUS_OK) continue;
        scene_steps(m, 60);
        kinetic[runs++] = mpm_balance(m).kinetic;
        mpm_free(m);
    }
    assert_true(runs >= 1);
    for (int i = 1; i < runs; i++) assert_near(kinetic[i] / kinetic[0], 1, 1e-6);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_threads),          cmocka_unit_test(test_threads_change),
        cmocka_unit_test(test_picture_sees),     cmocka_unit_test(test_restart),
        cmocka_unit_test(test_stops_between),    cmocka_unit_test(test_refusals),
        cmocka_unit_test(test_instruction_sets),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
