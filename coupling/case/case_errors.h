/* All errors of a file at once: collected while reading, sorted by place, one a line.
 *
 *   case.yaml:12:18: bank.capacitance = -5 mF: must be positive (1 pF .. 1 kF)
 *   --set bank.charge=9: bank.charge = 9: needs a unit, such as `9 V` */
#ifndef BREECH_COUPLING_CASE_ERRORS_H
#define BREECH_COUPLING_CASE_ERRORS_H

#include "base/status.h"
#include "coupling/host/words.h"
#include "coupling/host/yaml_tree.h"

enum { CASE_MAX_ERRORS = 200, CASE_ERROR_SIZE = 700 };

typedef struct {
    int set, line, column, order;
    char *text; /* whole line, owned */
} case_error;

typedef struct {
    const char *file;        /* borrowed: as shown before the line number */
    const char *const *sets; /* borrowed */
    case_error item[CASE_MAX_ERRORS];
    int n;
    int more;           /* errors beyond the list */
    bool out_of_memory; /* the list is not whole */
} case_errors;

/* `where` NULL: the file as a whole.  A --set that goes wrong in many places is said once. */
void case_errors_add(case_errors *e, const tree_node *where, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
void case_errors_add_at(case_errors *e, int line, int column, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

/* STATUS_OK when empty; else STATUS_BAD_INPUT with the first line, and all of them in *text (owned by the caller). */
status case_errors_finish(case_errors *e, char **text);
void case_errors_free(case_errors *e);

#endif
