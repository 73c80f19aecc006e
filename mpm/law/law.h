/* The material law of one body, constants derived once (mpm_law_make) for the kernels: strength by Johnson-Cook (M-1)
 * or Preston-Tonks-Wallace (M-23), damage (M-2), Mie-Grueneisen pressure (M-3), temperature from energy (M-4),
 * viscosity (M-5).  See docs/scene-solver.md. */
#ifndef BREECH_MPM_LAW_H
#define BREECH_MPM_LAW_H

#include "mpm/scene.h"

enum { LAW_COLD = 6 };

/* Preston-Tonks-Wallace (M-23) */
typedef struct {
    double theta, inv_p, s0, s_fall, kappa, y0, y_fall, y1, y2, beta; /* s_fall = s0 - s_inf, y_fall = y0 - y_inf */
    double G2, alpha, inv_T_m;                                        /* 2 G0 x the body's yield_scale [Pa]; [1, 1/K] */
    double log_rate; /* ln(rate_0/(gamma xi)), xi the rate at T = 0 at which a shear wave crosses an atom */
    double cold_work;
} ptw;

typedef struct {
    bool is_ptw;
    ptw ptw;                         /* of a body with is_ptw, else zero */
    double rho0, c0;                 /* [kg/m3, m/s] */
    double K0, K_slope;              /* rho0 c0^2 [Pa]; dK/dp = 4 s - 1 [1] */
    double g, s1;                    /* Grueneisen, s - 1 [1] */
    double G;                        /* shear modulus [Pa] */
    double volume0;                  /* 1/rho0 [m3/kg] */
    double volume_min, volume_max;   /* guards of the specific volume [m3/kg] */
    double A, B, n, C, m, inv_rate0; /* Johnson-Cook */
    double least_flow;               /* [Pa] flow stress >= least_flow (1 - T*) */
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
status mpm_law_make(const mpm_body *body, const mpm_scene *scene, law *out);

#endif
