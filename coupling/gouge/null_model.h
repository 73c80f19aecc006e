/* SPDX-License-Identifier: BSD-3-Clause */
/* Null models: where gouging would begin if one number of the two metals decided it.
 *
 * Each has one constant, and that is what makes 7075 on copper begin at 1325 m/s, the middle of the two onsets that are
 * reported for it, 1.30 and 1.35 km/s (quoted by Wu et al. 2017); the interval is what the two would give.  So they say
 * nothing of 7075 on copper.  What a prediction for another pair must do is to lie nearer than they do.
 *   N1  p / H_max = const           p the planar impact pressure (M-22), H_max the hardness of the harder partner
 *   N2  rho_b u^2 / 2 H_max = const  u = v / (1 + sqrt(rho_b / rho_a)): two fluids that meet head on, b the rail
 *   N3  v = const sqrt((H_a + H_b) / (rho_a + rho_b))
 * The rail's hardness, density and pressure are those of the screen: means over as much depth as the grain is high. */
#ifndef BREECH_COUPLING_GOUGE_NULL_MODEL_H
#define BREECH_COUPLING_GOUGE_NULL_MODEL_H

#include "coupling/gouge/screen.h"

enum { NULL_MODELS = 3 };

typedef struct {
    const char *name;             /* "N1", ... */
    const char *says;             /* what it takes for the cause, in words */
    double threshold_velocity;    /* [m/s]; INFINITY: N1 not below 20 km/s */
    double threshold_interval[2]; /* what the two reported onsets would give [m/s] */
} null_model;

/* For a grain of that height on a surface.  STATUS_BAD_INPUT names a material that lacks what they need. */
status gouge_null_models(const case_surface *s, double height, null_model out[NULL_MODELS]);

#endif
