/* SPDX-License-Identifier: BSD-3-Clause */
/* Constants of nature and of geometry.  No macros: the header is a public one. */
#ifndef BREECH_BASE_CONSTANTS_H
#define BREECH_BASE_CONSTANTS_H

static const double PI = 3.14159265358979323846;
static const double MU0 = 1.25663706212e-6;          /* permeability of the vacuum, CODATA 2018 [H/m] */
static const double GAS_CONSTANT = 8.31446261815324; /* exact in the SI of 2019 [J/(mol K)] */

#endif
