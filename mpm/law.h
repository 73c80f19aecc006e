/* The material law of one body, constants derived once (law_make) for the kernels: Johnson-Cook strength (M-1) and
 * damage (M-2), Mie-Grueneisen pressure (M-3), temperature from energy (M-4), viscosity (M-5).  See docs/scene-solver.md. */
#ifndef BREECH_MPM_LAW_H
#define BREECH_MPM_LAW_H

#include "mpm/scene.h"

enum { LAW_COLD = 6 };

typedef struct {
    double rho0, c0;                 /* [kg/m3, m/s] */
    double K0, K_slope;              /* rho0 c0^2 [Pa]; dK/dp = 4 s - 1 [1] */
    double g, s1;                    /* Grueneisen, s - 1 [1] */
    double G;                        /* shear modulus [Pa] */
    double volume0;                  /* 1/rho0 [m3/kg] */
    double volume_min, volume_max;   /* guards of the specific volume [m3/kg] */
    double A, B, n, C, m, inv_rate0; /* Johnson-Cook */
    double least_flow;               /* [Pa] flow stress >= least_flow (1 - T*): A where m >= 1, else 0 */
    double T_r, T_m, inv_T_range;    /* [K, K, 1/K] */
    double D1, D2, D3, D4, D5;       /* failure strain; D1 < 0: no damage */
    double inv_c, c_v;               /* specific heat [kg K/J, J/(kg K)] */
    double latent;                   /* [J/kg] */
    double squeezed[LAW_COLD];       /* e_r = mu (c0 + c1 mu + ..), the energy at T_r, in compression [J/kg] */
    double stretched[LAW_COLD];      /* the same in expansion */
    double mu_least, mu_most;        /* range of the two; held at its ends beyond [1] */
    double chi;                      /* heat_by_plastic_work: share of plastic work, else 0 */
    double q1, q2;                   /* viscosity, linear and quadratic */
    bool plastic_heat;
    double flow_start;         /* first flow stress [Pa] */
    double e_vapour, rho_dust; /* a point with more energy, or a failed or molten one that is thinner, is eroded */
    double e_start, rho_start; /* of a body at rest at its temperature, without pressure */
} law;

/* Refuses a material that lacks a constant the scene needs. */
status law_make(const mpm_body *body, const mpm_scene *scene, law *out);

#endif
