/* SPDX-License-Identifier: BSD-3-Clause */
/* What the two kinds of random scenes of breech-stress share: chance, the text of a case, what came of it. */
#ifndef BREECH_TESTS_STRESS_H
#define BREECH_TESTS_STRESS_H

#include "coupling/case/case.h"
#include "coupling/case/material_file.h"
#include "coupling/scene/scene_run.h"

#include <math.h>
#include <stdint.h>

enum { TEXT_SIZE = 6000, MAX_STEPS = 700 };

/* ---- chance: splitmix64 ---- */

typedef struct {
    uint64_t state;
} chance;

static inline uint64_t chance_bits(chance *c)
{
    uint64_t z = c->state += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

static inline double uniform(chance *c, double lo, double hi)
{
    return lo + (hi - lo) * ((double)(chance_bits(c) >> 11) * 0x1p-53);
}

static inline double log_uniform(chance *c, double lo, double hi)
{
    return exp(uniform(c, log(lo), log(hi)));
}

static inline bool one_in(chance *c, int n)
{
    return chance_bits(c) % (uint64_t)n == 0;
}

static inline int below(chance *c, int n)
{
    return (int)(chance_bits(c) % (uint64_t)n);
}

/* ---- one random scene ---- */

/* Groups of the materials: those whose constants are enough for a scene with damage, without, and all. */
typedef enum { WITH_DAMAGE, WITHOUT_DAMAGE, ANY, GROUPS } group;

typedef struct {
    char **names;
    int n, *group[GROUPS], count[GROUPS];
    double *melting; /* [K] */
    material_places at;
} stock;

typedef struct {
    char text[TEXT_SIZE];
    size_t length;
    double radius, velocity, courant; /* [m, m/s, 1] */
    int levels;                       /* of nested grids */
    double wider;                     /* what the window needs for them beside what it has for one [m] */
    group group;
    char summary[200];
} recipe;

void stress_add(recipe *r, const char *format, ...) __attribute__((format(printf, 2, 3)));

static inline int any_material(const recipe *r, chance *c, const stock *s)
{
    return s->group[r->group][below(c, s->count[r->group])];
}

typedef enum { ENDED, REFUSED, FAILED } verdict;

typedef struct {
    int index;
    verdict verdict;
    status why;                    /* refused or failed */
    double energy, momentum, mass; /* largest errors seen */
    double driven;                 /* of a piston that is not in the scene: its energy at the start [J] */
    double gain;                   /* of kinetic energy, over what it started with and the work from outside */
    double seconds;
    uint64_t looks, steps;
    char summary[200], class[16];
} outcome;

/* Of a strike (targets.c): the text of the case, and its run through the hand-off to a class.  `host` is told of every
 * step. */
void stress_target_write(recipe *r, chance *c, const stock *s);
status stress_target_run(const breech_case *of, const scene_host *host, outcome *o);

#endif
