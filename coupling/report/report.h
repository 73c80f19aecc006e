/* SPDX-License-Identifier: BSD-3-Clause */
/* report.html: one page for people, from the files of an output directory alone. */
#ifndef BREECH_COUPLING_REPORT_H
#define BREECH_COUPLING_REPORT_H

#include "base/status.h"

struct page;

/* What a kind of run adds to its page, in report_page.h's words; NULL: nothing. */
typedef struct {
    void (*head)(const struct page *p);    /* what its user reads first */
    void (*section)(const struct page *p); /* tables and drawings that it rests on */
} report_part;

/* Of what a summary is. */
typedef struct {
    report_part part;
    const char *command; /* that made it: `scene` for an ensemble; NULL: none is known */
} report_kind;

/* Reads DIR/summary.json, history.h5 and used.yaml; writes DIR/report.html, self-contained, with the drawings inline
 * and beside it as .svg.  Only summary.json must be there; what is missing is named in the page.  kind_of: by the kind
 * that the summary names. */
status report_write(const char *dir, report_kind (*kind_of)(const char *kind));

#endif
