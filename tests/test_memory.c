/* SPDX-License-Identifier: BSD-3-Clause */
/* Memory that runs out: the n-th allocation of our own fails, for n = 1, 2, ... until all that is needed is had; in a
 * scene one of every four, all with BREECH_FULL=1.  Every failure ends in STATUS_MEMORY: no crash, no silent result,
 * and nothing left behind.
 *
 * The linker sends our allocations here (tests/CMakeLists.txt); those of other libraries stay as they are. */
#include "circuit_common.h"
#include "full_common.h"
#include "mpm_scenes.h"
#include "rail_common.h"

#include <sys/wait.h>
#include <unistd.h>

void *__real_malloc(size_t bytes);
void *__real_calloc(size_t n, size_t bytes);
void *__real_realloc(void *old, size_t bytes);
void *__real_aligned_alloc(size_t alignment, size_t bytes);
void __real_free(void *p);
void *__wrap_malloc(size_t bytes);
void *__wrap_calloc(size_t n, size_t bytes);
void *__wrap_realloc(void *old, size_t bytes);
void *__wrap_aligned_alloc(size_t alignment, size_t bytes);
void __wrap_free(void *p);

static long left = -1; /* allocations until one fails; < 0: none does */

static long held;      /* allocations not freed */
static bool forks;     /* a child of the process has each allocation fail; the parent goes on */
static bool is_child;  /* the one whose allocation has failed */
static int reached;    /* allocations so far */
static int every = 1;  /* one of so many has a child */
static int tried, bad; /* children; those that ended badly */

/* In the child: this allocation fails.  The parent waits to see how that ends. */
static bool fails_in_child(void)
{
    fflush(NULL);
    const pid_t child = fork();
    if (child == 0) {
        forks = false, is_child = true;
        return true;
    }
    int state = 1;
    waitpid(child, &state, 0);
    if (state != 0) {
        print_message("allocation %d fails: the program ends with %s %d\n", reached,
                      WIFSIGNALED(state) ? "signal" : "code",
                      WIFSIGNALED(state) ? WTERMSIG(state) : WEXITSTATUS(state));
        bad++;
    }
    tried++;
    return false;
}

static bool fails(void)
{
    bool now = false;
#pragma omp critical(allocations)
    {
        now = forks ? reached++ % every == 0 && fails_in_child() : left == 0;
        if (left >= 0) left--;
    }
    return now;
}

static void *had(void *p)
{
    if (p) {
#pragma omp atomic
        held++;
    }
    return p;
}

void *__wrap_malloc(size_t bytes)
{
    return fails() ? NULL : had(__real_malloc(bytes));
}

void *__wrap_calloc(size_t n, size_t bytes)
{
    return fails() ? NULL : had(__real_calloc(n, bytes));
}

void *__wrap_realloc(void *old, size_t bytes)
{
    if (fails()) return NULL;
    void *p = __real_realloc(old, bytes);
    return old ? p : had(p);
}

void *__wrap_aligned_alloc(size_t alignment, size_t bytes)
{
    return fails() ? NULL : had(__real_aligned_alloc(alignment, bytes));
}

void __wrap_free(void *p)
{
    if (p) {
#pragma omp atomic
        held--;
    }
    __real_free(p);
}

/* What `work` has come to, is it what a lack of memory must come to? */
static bool is_refusal(const char *what, long n, status s, long held_before)
{
    const bool right = s.code == STATUS_MEMORY && strstr(s.text, "memory") && held == held_before;
    if (!right)
        print_message("%s: allocation %ld fails, the status is %d: %s; %ld allocations are left\n", what, n, s.code,
                      s.text, held - held_before);
    return right;
}

/* Tries `work`, which takes one thread, once; a child of the process sees each allocation fail and ends as soon as that
 * is reported. */
static void every_failure_once(status (*work)(void), const char *what)
{
    const long before = held;
    tried = bad = reached = 0;
    every = full_tests() ? 1 : 4;
    forks = true;
    const status s = work();
    forks = false;
    if (is_child) {
        const bool right = is_refusal(what, reached, s, before);
        fflush(NULL);
        _exit(right ? 0 : 1);
    }
    print_message("%s: %d of %d allocations fail, %d end badly\n", what, tried, reached, bad);
    if (s.code != STATUS_OK) fail_msg("%s, with all its memory: %s", what, s.text);
    assert_true(tried > 30 && bad == 0);
    assert_int_equal(held, before);
}

/* Tries `work` with its n-th allocation failing, for every n. */
static void every_failure(status (*work)(void), const char *what)
{
    enum { MANY = 100000 };
    int wrong = 0;
    for (long n = 0; n < MANY; n++) {
        const long before = held;
        left = n;
        const status s = work();
        const bool failed = left < 0;
        left = -1;
        if (!failed) {
            if (s.code != STATUS_OK) fail_msg("%s, with all its memory: %s", what, s.text);
            print_message("%s: %ld allocations\n", what, n);
            assert_true(n > 3 && wrong == 0);
            return;
        }
        wrong += !is_refusal(what, n, s, before);
    }
    fail_msg("%s: more than %d allocations", what, MANY);
}

static status make_shot(void)
{
    circuit_shot_module modules[DEFAULT_SHOT_GROUPS];
    const circuit_shot_config c = default_shot(modules);
    circuit_shot *s = NULL;
    status done = circuit_shot_create(&c, &s);
    if (done.code == STATUS_OK) done = circuit_shot_advance(s, 1e-4, NULL);
    circuit_shot_free(s);
    return done;
}

static void shots(void **state)
{
    (void)state;
    every_failure(make_shot, "shot");
}

/* ---- random shots ---- */

static rail rail_of_test;

/* Two shots on each of two rails, with more rims than a list has room for at first. */
static status make_random_shots(void)
{
    mc_result out;
    const mc_surface two[] = { as_new(&rail_of_test, 0, 1.0), as_new(&rail_of_test, 1, 1.0) };
    const mc_plan plan = { .histories = 1000, .shots = 2, .seed = 7, .length = LENGTH, .n = 2, .surface = two };
    const status s = study_mc_run(&plan, &out);
    study_mc_free(&out);
    return s;
}

static void random_shots(void **state)
{
    (void)state;
    make_rail(&rail_of_test, 100.0, 3e-4, 0.1, 1400.0, 0.0, 0.0);
    every_failure(make_random_shots, "random shots");
    free(rail_of_test.family);
}

/* ---- a scene of the solver ---- */

/* A grain on a rail that a slab runs over: two levels, points that split, merge and change cells, cells that become
 * small where metal flows, a probe that needs memory of its own.  One thread: one order of allocations. */
static gouge_scene scene_of_test = { .scene = { 0 } };
static const double HALF = 0.8e-6, END = 1.6e-6; /* [s] */

static void prepare_scene(void)
{
    gouge_scene *g = &scene_of_test;
    mpm_scene *s = &g->scene;
    const double h = 0.25e-3, speed = 2500;
    scene_gouge(g, h, speed);
    scene_values(s, 0)[3] = 40e-3; /* the rail goes on */
    s->axis[0].lo = -5e-3, s->axis[0].hi = 5e-3;
    s->axis[0] = scene_graded(s->axis[0], -1e-3, 1.5e-3, 6 * h, 1.6);
    s->axis[1] = scene_graded(s->axis[1], -1e-3, 1e-3, 6 * h, 1.6);
    s->axis[2] = scene_graded(s->axis[2], 0, 1e-3, 6 * h, 1.6);
    s->levels = 2;
    mpm_refine *plastic;
    assert_ok(mpm_scene_add_refine(s, "plastic", &plastic));
    s->zone_until = 0.3 * END;
    mpm_probe *p;
    assert_ok(mpm_scene_add_probe(s, "surface", "map", &p));
    p->body = 0;
    static const char *const names[] = { "lo", "hi", "along", "cell" };
    static const double values[][3] = { { -1e-3, -2e-3, 0 }, { 2e-3, 0.5e-3, 1e-3 }, { 0, 1, 0 }, { 0.25e-3 } };
    for (int i = 0; i < 4; i++) memcpy(mpm_probe_value(p, names[i]), values[i], (i < 3 ? 3 : 1) * sizeof(double));
}

static struct {
    uint64_t splits, merges, steps;
} seen;

/* A solver to the end of the scene, then what is read. */
static status run_on(mpm *m, double *map)
{
    static const bool counts[] = { true, true, false };
    const mpm_slices slices = {
        .along = 0, .across = 2, .n = 4, .lo = -1e-3, .width = 1e-3, .half = 2e-3, .sides = 0.75
    };
    mpm_plastic_sum sums[2 * 4];
    TRY(mpm_advance(m, END, NULL));
    TRY(mpm_plastic_profile(m, counts, &slices, sums));
    return mpm_probe_read(m, &mpm_scene_of(m)->probe[0], map);
}

static status save_half(mpm *m, void **image, size_t *bytes)
{
    TRY(mpm_advance(m, HALF, NULL));
    return mpm_save(m, image, bytes);
}

/* Half a scene, its checkpoint, then the whole from there in another solver. */
static status run_scene(void)
{
    static double map[3 * 4096];
    void *image = NULL;
    size_t bytes = 0;
    mpm *m = NULL, *on = NULL;
    mpm_scene copy = { 0 };
    status s = mpm_scene_copy(&scene_of_test.scene, &copy);
    if (s.code == STATUS_OK) s = mpm_create(&copy, 1, &m);
    if (s.code == STATUS_OK) s = save_half(m, &image, &bytes);
    mpm_free(m);
    if (s.code == STATUS_OK) s = mpm_create(&copy, 1, &on);
    if (s.code == STATUS_OK) s = mpm_restore(on, image, bytes);
    if (s.code == STATUS_OK) s = run_on(on, map);
    if (s.code == STATUS_OK) {
        const mpm_report r = mpm_state(on);
        seen.splits = r.splits, seen.merges = r.merges, seen.steps = r.steps;
    }
    mpm_free(on);
    free(image);
    mpm_scene_free(&copy);
    return s;
}

static void scenes(void **state)
{
    (void)state;
#ifdef __clang__
    skip(); /* LLVM's OpenMP does not go on in a child of the process; gcc's does */
#endif
    prepare_scene();
    every_failure_once(run_scene, "scene");
    print_message("%llu steps, %llu splits, %llu merges\n", (unsigned long long)seen.steps,
                  (unsigned long long)seen.splits, (unsigned long long)seen.merges);
    assert_true(seen.splits > 0 && seen.merges > 0); /* all that may ask for memory */
    mpm_scene_free(&scene_of_test.scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(shots),
        cmocka_unit_test(random_shots),
        cmocka_unit_test(scenes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
