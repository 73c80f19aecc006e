/* One material's constants, as read from cases/materials/<name>.yaml.  NAN = not known: a feature that needs the
 * constant refuses the material by name (mpm_material_check), it never assumes zero.
 * To add a constant: a member here, one line in material.c's table. */
#ifndef BREECH_MPM_MATERIAL_H
#define BREECH_MPM_MATERIAL_H

#include "base/param.h"

typedef enum { STRENGTH_JOHNSON_COOK, STRENGTH_PTW } material_strength;

typedef struct {
    char name[PARAM_TEXT_SIZE];
    int strength;                 /* material_strength: which flow stress; the other's constants are not used */
    double density;               /* rho0 [kg/m3] at the reference temperature */
    double youngs_modulus;        /* E [Pa] */
    double poisson;               /* nu [1] */
    double specific_heat;         /* c [J/(kg K)] */
    double conductivity;          /* k [W/(m K)] */
    double reference_temperature; /* T_r [K] */
    double melting_temperature;   /* T_m, solidus [K] */
    double latent_heat;           /* of fusion [J/kg] */
    double yield_A, hardening_B, hardening_n, rate_C, softening_m,
        rate_0; /* Johnson-Cook (M-1) [Pa, Pa, 1, 1, 1, 1/s] */
    double ptw_theta, ptw_p, ptw_s0, ptw_s_inf, ptw_kappa, ptw_gamma, ptw_y0, ptw_y_inf, ptw_y1, ptw_y2,
        ptw_beta;             /* Preston-Tonks-Wallace (M-23) [1] */
    double ptw_G0, ptw_alpha; /* shear modulus in (M-23): G0 (1 - alpha T/T_m) [Pa, 1] */
    double ptw_cold_work;     /* plastic strain the metal has had before (M-23) [1] */
    double molar_mass;        /* [kg/mol] */
    double taylor_quinney;    /* chi [1], option `plastic` of (M-4) only */
    double damage_D1, damage_D2, damage_D3, damage_D4, damage_D5; /* Johnson-Cook failure (M-2) [1] */
    double spall_strength;                                        /* tension at which it fails [Pa] */
    double sound_speed;                                           /* c0, bulk, at zero pressure [m/s] */
    double hugoniot_slope;                                        /* s of us = c0 + s up [1] */
    double gruneisen;                                             /* g0 [1] */
    double hardness;                                              /* Vickers hardness as pressure [Pa] */
    double resistivity;                                           /* [ohm m] at the reference temperature */
    double resistivity_slope;                                     /* its temperature coefficient [1/K] */
} material;

extern const param mpm_material_params[];

typedef enum {
    MATERIAL_FOR_SCENE = 1,   /* density, elastic, equation of state, its own law of strength, specific heat */
    MATERIAL_FOR_DAMAGE = 2,  /* D1..D5 */
    MATERIAL_FOR_SCREEN = 4,  /* hardness, equation of state */
    MATERIAL_FOR_MELTING = 8, /* latent heat, melting temperature */
    MATERIAL_FOR_CIRCUIT = 16 /* resistivity */
} material_need;

/* STATUS_BAD_INPUT naming the material and every missing constant, unless it has all that `needs` (a sum) asks for. */
status mpm_material_check(const material *m, unsigned needs);

/* Elastic constants of the solid.  Bulk modulus K = rho0 c0^2 from the equation of state (what the pressure law (M-3)
 * uses), shear modulus G = E / (2 (1 + nu)) from E and nu; so E / (3 (1 - 2 nu)) is not used anywhere and differs from
 * K by some per cent.  Speeds: longitudinal sqrt((K + 4/3 G) / rho0), shear sqrt(G / rho0).  NAN where a constant is.
 */
double mpm_material_bulk_modulus(const material *m);       /* [Pa] */
double mpm_material_shear_modulus(const material *m);      /* [Pa] */
double mpm_material_longitudinal_speed(const material *m); /* [m/s] */
double mpm_material_shear_speed(const material *m);        /* [m/s] */

/* Hydrodynamic impedance match of a planar impact at `velocity` [m/s]; p [Pa], u_target = the target's particle
 * velocity [m/s].  Hugoniot p = rho0 (c0 + s u) u of each. */
status mpm_impedance_match(const material *flyer, const material *target, double velocity, double *p, double *u_target);

#endif
