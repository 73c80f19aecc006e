/* SPDX-License-Identifier: BSD-3-Clause */
/* A shell of an incompressible elastic-plastic metal or gel that swells: layers of equal volume, each with one strain
 * (vessel.h, G-3).  Internal to the room. */
#ifndef BREECH_COUPLING_VESSEL_FILM_H
#define BREECH_COUPLING_VESSEL_FILM_H

#include "mpm/law/law_point.h"

typedef struct {
    double before;  /* volume inside its inner face at the start [m3] */
    double strain;  /* equivalent strain [1] */
    double plastic; /* that part of it that stays, with its sign [1] */
    double flowed;  /* equivalent plastic strain, never falling [1] */
    double damage;  /* [1] */
    double stress;  /* equivalent stress, with the strain's sign [Pa] */
} film_layer;

typedef struct {
    const mpm_point_law *law; /* borrowed */
    int dimension, layers;
    double inner, outer; /* volumes inside its faces at the start [m3], or of a metre [m2 m] */
    double time;         /* of the layers' state [s] */
    film_layer *layer;   /* [layers], owned */
} film;

status vessel_film_make(const mpm_point_law *law, int dimension, int layers, double inner, double outer, film *f);
void vessel_film_free(film *f);

double vessel_volume(int dimension, double radius); /* [m3]; of a metre of a cylinder [m2 m] */
double vessel_radius(int dimension, double volume); /* [m] */

/* With so much inside the inner face: the pressure that the film holds [Pa], and the largest damage of a layer
 * (damage: may be NULL).  next: the layers as they are then, or NULL. */
double vessel_film_at(const film *f, double time, double inside, double *damage, film_layer *next);

#endif
