/* SPDX-License-Identifier: BSD-3-Clause */
/* The whole way of a case file - tree, schema, units, materials, checks, used.yaml - on any bytes, from memory.
 *
 * Laws that hold for every input: no crash, no leak, no undefined step; an error has a line of text; a case that is
 * accepted is written as used.yaml, and that reads back and is written the same.
 * An input that holds the byte 0x01 is cut there: what follows is given as --set, one a line.
 * Run by tests/fuzz.sh; tests/test_case_seeds.c replays the seeds in the ordinary tests. */
#include "coupling/case/case.h"
#include "coupling/case/case_reader.h"
#include "coupling/case/material_file.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

enum { MAX_SETS = 8 };

static void fail_unless(bool ok)
{
    if (!ok) abort();
}

static char *written(const breech_case *c)
{
    char *text = NULL;
    size_t size = 0;
    FILE *file = open_memstream(&text, &size);
    fail_unless(file != NULL);
    fail_unless(case_write_used(c, file).code == STATUS_OK);
    fclose(file);
    return text;
}

static void check_round_trip(const units *u, const breech_case *c, const case_options *options)
{
    char *used = written(c), *errors = NULL;
    breech_case *again = NULL;
    const size_t length = strlen(used);
    if (length <= TREE_MAX_BYTES) {
        const status s = case_build(u, &(case_text){ used, length, "used.yaml", NULL, 0 }, options, &again, &errors);
        fail_unless(s.code == STATUS_OK && errors == NULL);
        char *twice = written(again);
        fail_unless(strcmp(used, twice) == 0);
        free(twice);
        case_free(again);
    }
    free(used);
}

static int split_sets(char *text, const char *sets[MAX_SETS])
{
    int n = 0;
    char *rest = NULL;
    for (char *line = strtok_r(text, "\n", &rest); line && n < MAX_SETS; line = strtok_r(NULL, "\n", &rest))
        sets[n++] = line;
    return n;
}

static void read_case(const units *u, const uint8_t *data, size_t size, char *sets_text)
{
    const char *sets[MAX_SETS];
    const int n_sets = sets_text ? split_sets(sets_text, sets) : 0;
    const unsigned needs = size > 0 ? data[size - 1] & 15u : 0u;
    const case_options options = { .needs = needs };
    breech_case *c = NULL;
    char *errors = NULL;
    const case_text text = { (const char *)data, size, "nowhere/case.yaml", sets, n_sets };
    const status s = case_build(u, &text, &options, &c, &errors);
    fail_unless((s.code == STATUS_OK) == (c != NULL));
    fail_unless(s.code == STATUS_OK || (s.text[0] != '\0' && errors != NULL && errors[0] != '\0'));
    if (c) check_round_trip(u, c, &options);
    free(errors);
    case_free(c);
}

static void read_material(const units *u, const uint8_t *data, size_t size)
{
    material_sheet sheet;
    char *errors = NULL;
    const status s = case_material_sheet_parse(u, (const char *)data, size, "nowhere/x.yaml", NULL, 0, &sheet, &errors);
    fail_unless((s.code == STATUS_OK) == (errors == NULL));
    char warning[MATERIAL_WARNING_SIZE];
    if (s.code == STATUS_OK) {
        case_material_sheet_warning(&sheet, warning);
        case_material_sheet_free(&sheet);
    }
    free(errors);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static units *u; /* one unit system for all inputs: it is only read */
    if (!u) fail_unless(host_units_open(&u).code == STATUS_OK);
    const uint8_t *cut = size > 0 ? memchr(data, 1, size) : NULL;
    char *sets = NULL;
    if (cut) {
        const size_t length = (size_t)(data + size - cut) - 1;
        sets = malloc(length + 1);
        fail_unless(sets != NULL);
        memcpy(sets, cut + 1, length);
        sets[length] = '\0';
        size = (size_t)(cut - data);
    }
    read_case(u, data, size, sets);
    read_material(u, data, size);
    free(sets);
    return 0;
}
