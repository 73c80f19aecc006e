/* report.html: one page for people, from the files of an output directory alone. */
#ifndef BREECH_COUPLING_REPORT_H
#define BREECH_COUPLING_REPORT_H

#include "base/status.h"

/* Reads DIR/summary.json, history.h5 and used.yaml; writes DIR/report.html, self-contained, with the plots inline and
 * beside it as .svg.  Only summary.json must be there; what is missing is named in the page.  Without gnuplot the page
 * says so in place of the plots. */
status report_write(const char *dir);

#endif
