/* The schema of a case file: which sections there are, which table each is made of, where it lies in breech_case.
 * Read by the reader, the writer of used.yaml and the manual's key list. */
#ifndef BREECH_COUPLING_CASE_SCHEMA_H
#define BREECH_COUPLING_CASE_SCHEMA_H

#include "coupling/case/case.h"

#define NO_FLAG ((size_t)-1)

typedef struct case_section {
    const char *key, *doc;
    const param *table;                  /* ends with a NULL key */
    const struct case_section *children; /* sections inside this one, ends with a NULL key; NULL if none */
    size_t offset;                       /* of the struct, or of the list, in the parent's struct */
    size_t size;                         /* of the struct, or of one entry of the list */
    size_t given;                        /* offset of the `bool` in breech_case that says it was there; NO_FLAG */
    unsigned needed_for;                 /* sum of CASE_FOR_... that cannot do without */
    bool list;                           /* the member is a struct { int n; T *item; }; a lone mapping is one entry */
} case_section;

/* What every list of a case looks like. */
typedef struct {
    int n;
    void *item;
} case_list;

extern const case_section case_root;

case_list case_list_get(const void *parent, const case_section *section);
void case_list_put(void *parent, const case_section *section, case_list list);

#endif
