/* Memory that runs out: the n-th allocation of our own fails, for n = 1, 2, ... until all that is needed is had.  Every
 * failure ends in STATUS_MEMORY: no crash, no silent result, and (sanitizer builds) nothing left behind.
 *
 * The linker sends our allocations here (tests/CMakeLists.txt); those of other libraries stay as they are. */
#include "circuit_common.h"
#include "mpm_scenes.h"

void *__real_malloc(size_t bytes);
void *__real_calloc(size_t n, size_t bytes);
void *__real_realloc(void *old, size_t bytes);
void *__real_aligned_alloc(size_t alignment, size_t bytes);
void *__wrap_malloc(size_t bytes);
void *__wrap_calloc(size_t n, size_t bytes);
void *__wrap_realloc(void *old, size_t bytes);
void *__wrap_aligned_alloc(size_t alignment, size_t bytes);

static long left = -1; /* allocations until one fails; < 0: none does */

static bool fails(void)
{
    bool now = false;
#pragma omp critical(allocations)
    {
        now = left == 0;
        if (left >= 0) left--;
    }
    return now;
}

void *__wrap_malloc(size_t bytes)
{
    return fails() ? NULL : __real_malloc(bytes);
}

void *__wrap_calloc(size_t n, size_t bytes)
{
    return fails() ? NULL : __real_calloc(n, bytes);
}

void *__wrap_realloc(void *old, size_t bytes)
{
    return fails() ? NULL : __real_realloc(old, bytes);
}

void *__wrap_aligned_alloc(size_t alignment, size_t bytes)
{
    return fails() ? NULL : __real_aligned_alloc(alignment, bytes);
}

/* Tries `work` with its n-th allocation failing, for every n. */
static void every_failure(status (*work)(void), const char *what)
{
    enum { MANY = 100000 };
    int bad = 0;
    for (long n = 0; n < MANY; n++) {
        left = n;
        const status s = work();
        const bool failed = left < 0;
        left = -1;
        if (!failed) {
            if (s.code != STATUS_OK) fail_msg("%s, with all its memory: %s", what, s.text);
            print_message("%s: %ld allocations\n", what, n);
            assert_true(n > 3 && bad == 0);
            return;
        }
        if (s.code != STATUS_MEMORY) {
            print_message("%s: allocation %ld fails and the status is %d: %s\n", what, n, s.code, s.text);
            bad++;
        }
    }
    fail_msg("%s: more than %d allocations", what, MANY);
}

static status make_shot(void)
{
    shot_module modules[DEFAULT_SHOT_GROUPS];
    const shot_config c = default_shot(modules);
    shot *s = NULL;
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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(shots),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
