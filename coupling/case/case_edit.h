/* SPDX-License-Identifier: BSD-3-Clause */
/* Changes to a text at places that its tree knows: a value replaced, a comment added, all else as it was. */
#ifndef BREECH_COUPLING_CASE_EDIT_H
#define BREECH_COUPLING_CASE_EDIT_H

#include "coupling/host/yaml_tree.h"

typedef struct {
    size_t at, skip; /* bytes from the text's start; bytes that are replaced */
    int order;
    char *put; /* owned */
} case_edit;

typedef struct {
    const char *text; /* borrowed */
    size_t length;
    int n;
    case_edit *item; /* n, owned */
    bool out_of_memory;
} case_edits;

/* The byte at which a line and a column of characters stand, both from 1. */
size_t case_edit_place(const case_edits *e, int line, int column);
/* The byte that ends this line: its newline, or the text's end. */
size_t case_edit_line_end(const case_edits *e, int line);

void case_edit_add(case_edits *e, size_t at, size_t skip, const char *format, ...)
    __attribute__((format(printf, 4, 5)));
/* Another text in place of this value, in quotes where YAML wants them. */
void case_edit_value(case_edits *e, const tree_node *value, const char *text);

/* The changed text, malloc'ed; edits do not overlap, those at one place keep their order. */
status case_edits_apply(case_edits *e, char **out, size_t *length);
void case_edits_free(case_edits *e);

#endif
