/* SPDX-License-Identifier: BSD-3-Clause */
/* The material law of one body, constants derived once (mpm_law_make) for the kernels: one law of strength, one
 * equation of state and one law of failure of the three tables strength.def, eos.def, failure.def, temperature from
 * energy (M-4) and viscosity (M-5).  law_lanes.h puts them together to a step.  See docs/theory/scene-solver.md. */
#ifndef BREECH_MPM_LAW_H
#define BREECH_MPM_LAW_H

#include "mpm/scene.h"

#define LAW_STRUCT
#include "mpm/law/eos.def"
#include "mpm/law/failure.def"
#include "mpm/law/strength.def"
#undef LAW_STRUCT

/* What a law keeps of one body: the member of its own name. */
typedef struct {
    int kind; /* mpm_material_strength */
    union {
#define STRENGTH(name, shear, text) strength_##name name;
#include "mpm/law/strength.def"
    };
} law_strength;

typedef struct {
    int kind; /* mpm_material_eos */
    union {
#define EOS(name, text) eos_##name name;
#include "mpm/law/eos.def"
    };
} law_eos;

typedef struct {
    int kind; /* mpm_material_failure; MPM_FAILURE_none of a body without damage */
    union {
#define FAILURE(name, text) failure_##name name;
#include "mpm/law/failure.def"
    };
} law_failure;

/* Kernels of the material law: a fluid; a metal with a fixed shear modulus and (M-3), the fastest; any other solid. */
enum { LAW_FLUID, LAW_METAL, LAW_SOLID, LAW_KERNELS };

typedef struct law {
    law_strength strength;
    law_eos eos;
    law_failure failure;
    int shear;                     /* mpm_shear_kind, by the law of strength */
    int kernel;                    /* LAW_FLUID .. */
    double rho0, volume0;          /* [kg/m3, m3/kg] */
    double volume_min, volume_max; /* guards of the specific volume [m3/kg] */
    double mu_least, mu_most;      /* range in which the equation of state holds [1] */
    double K0, G;                  /* bulk and shear modulus at rest [Pa] */
    double sound;                  /* longitudinal, without pressure, at the reference temperature [m/s] */
    double vacuum;       /* least pressure of a fluid without a cavitation pressure, counted from that at rest [Pa] */
    double surroundings; /* absolute pressure from which pressures count; NAN: that at rest [Pa] */
    double p_rest;       /* pressure at rest above the surroundings'; 0 but for a gas [Pa] */
    double inv_rate0;    /* [s] */
    double least_flow;   /* flow stress >= least_flow (1 - T*); 0: no bound is known [Pa] */
    double cold_work;    /* plastic strain before the scene, added to that of the points [1] */
    double flow_start;   /* first flow stress [Pa] */
    double softening;    /* fraction of the flow stress lost to damage when a point fails [1] */
    double spall;        /* tension at which a point fails [Pa], HUGE_VAL: none */
    double T_r, T_m, inv_T_range; /* [K, K, 1/K] */
    double inv_c, c_v;            /* specific heat [kg K/J, J/(kg K)] */
    double latent;                /* [J/kg] */
    double chi;                   /* heat_by_plastic_work: fraction of plastic work */
    double q1, q2;                /* viscosity, linear and quadratic */
    bool plastic_heat;
    double e_hottest;                   /* what a point holds beyond goes to the points around it [J/kg] */
    double rho_dust;                    /* failed or molten points of less density are eroded [kg/m3] */
    double e_start, rho_start, p_start; /* of a body at rest at its temperature and its pressure */
} law;

/* Refuses a material that lacks a constant the scene needs. */
status mpm_law_make(const mpm_body *body, const mpm_scene *scene, law *out);

/* Its equation of state: p(mu, e) with mu = rho/rho0 - 1, from the surroundings' pressure [Pa]. */
double mpm_law_pressure(const law *k, double mu, double e);

/* Shear modulus without pressure, at the reference temperature; 0 of a fluid [Pa] */
double mpm_law_shear(const law *k);

/* Velocity of sound of a body as it begins, hot or under pressure, where it is above that at rest by more than a tenth,
 * for which the Courant number leaves room; else that at rest [m/s] */
double mpm_law_start_sound(const law *k);

/* s of us = c0 + s up for weak shocks, c0 = sqrt(K0/rho0), from the curvature of that equation at rest. */
double mpm_law_slope(const law *k);

#endif
