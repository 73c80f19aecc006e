/* SPDX-License-Identifier: BSD-3-Clause */
/* The schema of a case file: which sections there are, which table each is made of, where it lies in breech_case.
 * Read by the reader, the writer of used.yaml and the manual's key list.
 *
 * A section may have several parts (`also`), each a table and a struct of its own: `rail` is one section of the file
 * and two structs for the program, the circuit's and the scene's.  Keys of one section are unique over its parts.  A
 * part counts as given, and its required keys must be there, once a key of its own is. */
#ifndef BREECH_COUPLING_CASE_SCHEMA_H
#define BREECH_COUPLING_CASE_SCHEMA_H

#include "coupling/case/case.h"

#define NO_FLAG ((size_t)-1)

typedef struct case_section {
    const char *key, *doc;
    const base_param *table;             /* ends with a NULL key */
    const struct case_section *children; /* sections inside this one, ends with a NULL key; NULL if none */
    const struct case_section *also;     /* another part of this section, with the same key; NULL if none */
    size_t offset;                       /* of the struct, or of the list, in the parent's struct */
    size_t size;                         /* of the struct, or of one entry of the list */
    size_t given;                        /* offset of the `bool` in breech_case that says it was there; NO_FLAG */
    unsigned needed_for;                 /* sum of CASE_FOR_... that cannot do without */
    const char *unless; /* a mapping with this key is read elsewhere and is not this section; NULL: none */
    bool (*has)(const void *object,
                const char *key); /* a key that it has no use for is not written; NULL: it has all */
    bool list;                    /* the member is a struct { int n; T *item; }; a lone mapping is one entry */
    bool spread;                  /* a key of the list may have several values: an entry each */
} case_section;

/* What every list of a case looks like. */
typedef struct {
    int n;
    void *item;
} case_list;

extern const case_section case_root;

/* Of a case_life: an armature's load has no use for the keys of a wheel's. */
bool case_life_has(const void *life, const char *key);

/* The struct of a part, where the section's first part lies at `object`. */
void *case_part_object(const case_section *section, const case_section *part, void *object);

case_list case_list_get(const void *parent, const case_section *section);
void case_list_put(void *parent, const case_section *section, case_list list);

#endif
