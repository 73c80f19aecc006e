/* SPDX-License-Identifier: BSD-3-Clause */
/* Treatments: what can be done to a rail's surface, as a change of what the case gives (case_onset).
 *
 * A case lists surfaces to compare, each a name and the kinds of treatment on it.  To add a kind: treatment_<kind>.c
 * with
 *   const base_param case_treatment_<kind>_params[]: the keys of the case file, members of treatment_settings; the
 *     first is REQUIRED (a kind is given if its first key is);
 *   status case_treatment_<kind>_apply(settings, inputs): changes them; STATUS_BAD_INPUT names what cannot be;
 * and one line in treatment.def.  tests/test_compare.c checks every kind: applied, the case differs and its scenes can
 * be built. */
#ifndef BREECH_COUPLING_TREATMENT_H
#define BREECH_COUPLING_TREATMENT_H

#include "coupling/case/case_plain.h"

typedef struct {
    const char *name, *doc;
    const base_param *params; /* NULL: a list of layers */
    status (*apply)(const treatment_settings *t, case_onset *c);
} treatment_kind;
extern const treatment_kind case_treatment_kinds[TREATMENT_KINDS];

#define TREATMENT_LAYERS(name, doc) status case_treatment_##name##_apply(const treatment_settings *t, case_onset *c);
#define TREATMENT(name, doc)                                  \
    extern const base_param case_treatment_##name##_params[]; \
    status case_treatment_##name##_apply(const treatment_settings *t, case_onset *c);
#include "coupling/case/treatment.def"
#undef TREATMENT

/* Rows of a kind's table. */
#define TREATMENT_VALUE(i, key_, unit_, fallback_, min_, max_, doc_)                                     \
    {                                                                                                    \
        .key = (key_), .unit = (unit_), .doc = (doc_), .offset = offsetof(treatment_settings, value[i]), \
        .fallback = (fallback_), .min = (min_), .max = (max_), .kind = BASE_PARAM_NUMBER                 \
    }

/* Is this kind part of the treatment? */
bool case_treatment_given(const case_treatment *t, int kind);

/* After all of a treatment: grains of the given case's rail's or armature's metal are of the treated one's; those of
 * the list, of populations and of a scene alone. */
void case_treatment_exchange(const case_onset *given, case_onset *out);

/* The case under a treatment (NULL: as it is): a copy that borrows what it does not change.  It owns its layers, sites
 * and populations; case_treated_free, even on error. */
status case_treat(const case_onset *c, const case_treatment *t, case_onset *out);
void case_treated_free(case_onset *c);
/* Is it the case as it is, so that comparing the two is comparing nothing? */
bool case_treated_alike(const case_onset *c, const case_onset *treated);

#endif
