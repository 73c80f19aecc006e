/* SPDX-License-Identifier: BSD-3-Clause */
/* All errors of a case at once: collected while reading, sorted by place, one a line.  A case may be made of several
 * files, each built on the next: every error names its own.
 *
 *   case.yaml:12:18: bank.capacitance = -5 mF: must be positive (1 pF .. 1 kF)
 *   --set bank.charge=9: bank.charge = 9: needs a unit, such as `9 V` (0 V .. 1 MV) */
#ifndef BREECH_COUPLING_CASE_ERRORS_H
#define BREECH_COUPLING_CASE_ERRORS_H

#include "base/status.h"
#include "coupling/host/words.h"
#include "coupling/host/yaml_tree.h"

enum { CASE_MAX_ERRORS = 200, CASE_ERROR_SIZE = 700, CASE_MAX_FILES = 9 };

typedef struct {
    int set, file, line, column, order;
    char *text; /* whole line, owned */
} case_error;

typedef struct {
    const char *file[CASE_MAX_FILES]; /* by the number that their nodes have, as shown before the line; borrowed */
    const char *const *sets;          /* borrowed */
    case_error item[CASE_MAX_ERRORS];
    int n;
    int more;           /* errors beyond the list */
    bool out_of_memory; /* the list is not whole */
} case_errors;

/* `where` NULL: the case's own file as a whole.  A --set that goes wrong in many places is said once, and
 * so is an error that is found twice. */
void case_errors_add(case_errors *e, const tree_node *where, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
void case_errors_add_at(case_errors *e, int file, int line, int column, const char *format, ...)
    __attribute__((format(printf, 5, 6)));

/* STATUS_OK when empty; else STATUS_BAD_INPUT with the first line, and all of them in *text (owned by the caller). */
status case_errors_finish(case_errors *e, char **text);
void case_errors_free(case_errors *e);

#endif
