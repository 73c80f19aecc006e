/* SPDX-License-Identifier: BSD-3-Clause */
/* The fuzzer's seeds, and every cut and some broken bytes of them, through the fuzzer's own function: its laws abort.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "tests/fuzz/fuzz_case.c"

#include <dirent.h>

#define SEEDS BREECH_TESTS "/fuzz/seeds/fuzz_case"

enum { SEED_SIZE = 32768 };

static size_t read_seed(const char *name, uint8_t *bytes)
{
    char path[1000];
    snprintf(path, sizeof path, SEEDS "/%.200s", name);
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    const size_t size = fread(bytes, 1, SEED_SIZE, file);
    fclose(file);
    assert_true(size > 0 && size < SEED_SIZE);
    return size;
}

/* Exact copies on the heap, so that a sanitizer sees a read past the end. */
static void try_bytes(const uint8_t *bytes, size_t size)
{
    uint8_t *copy = malloc(size > 0 ? size : 1);
    assert_non_null(copy);
    memcpy(copy, bytes, size);
    assert_int_equal(LLVMFuzzerTestOneInput(copy, size), 0);
    free(copy);
}

static void try_seed(const char *name)
{
    static uint8_t bytes[SEED_SIZE];
    const size_t size = read_seed(name, bytes);
    try_bytes(bytes, size);
    const size_t step = size / 40 + 1; /* some forty cuts and forty broken bytes a seed: seconds, not minutes */
    for (size_t cut = 0; cut < size; cut += step) try_bytes(bytes, cut);
    for (size_t k = step / 2; k < size; k += step) {
        const uint8_t old = bytes[k];
        bytes[k] = (uint8_t)(old ^ (1u << (k % 8)));
        try_bytes(bytes, size);
        bytes[k] = old;
    }
}

static void seeds_hold_the_laws(void **state)
{
    (void)state;
    DIR *folder = opendir(SEEDS);
    int n = 0;
    assert_non_null(folder);
    for (struct dirent *entry; (entry = readdir(folder));) {
        if (entry->d_name[0] == '.') continue;
        try_seed(entry->d_name);
        n++;
    }
    closedir(folder);
    assert_true(n >= 9); /* those that came with the reader */
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(seeds_hold_the_laws) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
