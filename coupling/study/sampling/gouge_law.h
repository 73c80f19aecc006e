/* SPDX-License-Identifier: BSD-3-Clause */
/* What a family's search says of any grain of it, tabulated for drawing by the million. */
#ifndef BREECH_COUPLING_GOUGE_LAW_H
#define BREECH_COUPLING_GOUGE_LAW_H

#include "coupling/study/search/family.h"

enum { LAW_SIZES = 128, LAW_VELOCITIES = 64 };

/* What a gouge leaves and takes, by the radius of its grain; linear in velocity between the scenes that gouge, constant
 * beyond. */
typedef struct {
    double volume;         /* over r^3 [1] */
    double rim, along;     /* height of the rim, its way downstream, over r [1] */
    double depth;          /* over r [1] */
    double layers_gone;    /* share of the rail's layers over the crater (layer_wear.h) [1] */
    double impulse, metal; /* of the armature, over r^3 [N s/m3, kg/m3] */
} gouge_mark;

typedef struct {
    double ln_first, per_ln; /* place of ln r in the tables below */
    /* band of the threshold, infinite where it is open; low INFINITY: it never gouges [m/s] */
    double low[LAW_SIZES + 1], high[LAW_SIZES + 1];
    double alike[2]; /* what may move the threshold of every surface alike, below and above [m/s] */
    double own;      /* what may move that of this one, either way (threshold.h) [m/s] */
    double v_first, per_v;
    bool marked; /* some scene gouges; else a mark's volume is NaN, all else of it 0 */
    gouge_mark mark[LAW_VELOCITIES + 1];
} gouge_law;

/* Of a family that no scene was run for: it never gouges. */
void study_gouge_law_none(gouge_law *out);
/* of: what the family's scenes were made of, here and below. */
void study_gouge_law_make(const grain_family *f, const case_impact *of, gouge_law *out);

/* By the scenes themselves, for one grain; false: none of them gouges. */
bool study_gouge_mark_at(const grain_family *f, const case_impact *of, double velocity, gouge_mark *out);

/* Where in what is not known of it a threshold lies. */
typedef struct {
    double in_band;    /* 0 .. 1 */
    double alike, own; /* shares of the law's, -1 .. 1 */
} gouge_law_draw;

extern const gouge_law_draw study_gouge_law_middle;

/* low + in_band (high - low) + the shares of what may move it [m/s].  Of an open band its known end in half of the
 * draws, 0 or INFINITY in the others: what was seen from one side alone is as likely as not. */
double study_gouge_law_threshold(const gouge_law *l, double ln_radius, gouge_law_draw draw);
gouge_mark study_gouge_law_mark(const gouge_law *l, double velocity);
/* `is` and a share of what `to` has more than `from`. */
gouge_mark study_gouge_mark_towards(const gouge_mark *is, const gouge_mark *from, const gouge_mark *to, double share);
/* Of the deepest crater that counts; 0: nothing gouges [m] */
double study_gouge_law_depth(const grain_family *f, const case_impact *of);
bool study_gouge_law_bares(const grain_family *f, const case_impact *of); /* one of them wears the layers through */

/* The lowest any size can have [m/s]. */
double study_gouge_law_lowest(const gouge_law *l);

#endif
