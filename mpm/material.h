/* SPDX-License-Identifier: BSD-3-Clause */
/* One material's constants, as read from cases/materials/<name>.yaml.  NAN = not known: a feature that needs the
 * constant refuses the material by name (mpm_material_check), it never assumes zero.
 *
 * A material chooses one law of strength, one equation of state and one law of failure.  Each brings its own constants
 * (mpm/law/strength.def, eos.def, failure.def); the list below has those of all materials.
 * To add a constant of all materials: one line of the list. */
#ifndef BREECH_MPM_MATERIAL_H
#define BREECH_MPM_MATERIAL_H

#include "base/param.h"

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef enum {
    MPM_MATERIAL_FOR_SCENE = 1,    /* what its strength and its equation of state need */
    MPM_MATERIAL_FOR_DAMAGE = 2,   /* what its law of failure needs */
    MPM_MATERIAL_FOR_SCREEN = 4,   /* hardness, impedance match */
    MPM_MATERIAL_FOR_MELTING = 8,  /* latent heat, melting temperature */
    MPM_MATERIAL_FOR_CIRCUIT = 16, /* resistivity */
    MPM_MATERIAL_FOR_FATIGUE = 32  /* Young's modulus, Poisson's ratio, constants of fatigue */
} mpm_material_need;

/* ROW(member, unit, needs, least, largest, text); needs: a sum of mpm_material_need, besides what a law asks for.  The
 * ranges hold room to spare: they catch a wrong unit or a slip of the decimal point, not a poor value. */
#define MATERIAL_CONSTANTS(ROW)                                                                                     \
    ROW(density, "kg/m^3", MPM_MATERIAL_FOR_SCENE | MPM_MATERIAL_FOR_SCREEN, 0.01, 3e4,                             \
        "density at the reference temperature")                                                                     \
    ROW(youngs_modulus, "Pa", MPM_MATERIAL_FOR_FATIGUE, 1e6, 2e12, "Young's modulus")                               \
    ROW(poisson, "1", MPM_MATERIAL_FOR_FATIGUE, 0.0, 0.499, "Poisson's ratio")                                      \
    ROW(specific_heat, "J/(kg K)", MPM_MATERIAL_FOR_SCENE, 10.0, 1e4, "specific heat")                              \
    ROW(conductivity, "W/(m K)", 0, 1e-2, 5e3, "thermal conductivity")                                              \
    ROW(reference_temperature, "K", MPM_MATERIAL_FOR_SCENE | MPM_MATERIAL_FOR_MELTING, 1.0, 2e3,                    \
        "temperature at which the constants hold")                                                                  \
    ROW(melting_temperature, "K", MPM_MATERIAL_FOR_MELTING, 200.0, 5e3, "melting temperature (solidus)")            \
    ROW(latent_heat, "J/kg", MPM_MATERIAL_FOR_MELTING, 1e3, 1e7, "latent heat of fusion")                           \
    ROW(sound_speed, "m/s", MPM_MATERIAL_FOR_SCREEN, 100.0, 2e4, "bulk sound speed c0 of us = c0 + s up")           \
    ROW(hugoniot_slope, "1", MPM_MATERIAL_FOR_SCREEN, 0.0, 5.0, "slope s of us = c0 + s up")                        \
    ROW(rate_0, "1/s", 0, 1e-6, 1e6, "reference strain rate of strength and failure; slower ones count as this")    \
    ROW(cold_work, "1", 0, 0.0, 100.0,                                                                              \
        "plastic strain it has had before, from which its law of strength begins; not given: none")                 \
    ROW(molar_mass, "kg/mol", 0, 1e-3, 0.5, "molar mass")                                                           \
    ROW(taylor_quinney, "1", 0, 0.0, 1.0, "fraction of plastic work that becomes heat (heat by plastic work only)") \
    ROW(spall_strength, "Pa", 0, 1e5, 1e11, "tension at which it fails")                                            \
    ROW(hardness, "Pa", MPM_MATERIAL_FOR_SCREEN, 1e6, 1e11, "Vickers hardness as a pressure")                       \
    ROW(resistivity, "ohm m", MPM_MATERIAL_FOR_CIRCUIT, 1e-10, 1e-3, "electrical resistivity at 293.15 K")          \
    ROW(resistivity_slope, "1/K", 0, -0.1, 0.1, "temperature coefficient of the resistivity")                       \
    ROW(fatigue_A, "1", MPM_MATERIAL_FOR_FATIGUE, 1e-30, 1e30, "A of life lost in a cycle, A range^m (L-1)")        \
    ROW(fatigue_m, "1", MPM_MATERIAL_FOR_FATIGUE, 0.5, 30.0, "exponent m of the same")                              \
    ROW(fatigue_limit, "1", 0, 0.0, 0.1, "strain range up to which a cycle takes no life; not given: none")         \
    ROW(fatigue_A_spread, "1", 0, 0.0, 5.0,                                                                         \
        "how well A is known: standard deviation of its natural logarithm, ln 2 = 0.69 for a factor of two")        \
    ROW(expansion, "1/K", 0, 0.0, 1e-3, "thermal expansion of a length, linear")

/* What a law of strength has for a shear modulus: none, one from E and nu, its own for every point. */
typedef enum { MPM_SHEAR_NONE, MPM_SHEAR_FIXED, MPM_SHEAR_VARIES } mpm_shear_kind;

typedef enum {
#define STRENGTH(name, shear, text) MPM_STRENGTH_##name,
#include "mpm/law/strength.def"
} mpm_material_strength;

typedef enum {
#define EOS(name, text) MPM_EOS_##name,
#include "mpm/law/eos.def"
} mpm_material_eos;

typedef enum {
#define FAILURE(name, text) MPM_FAILURE_##name,
#include "mpm/law/failure.def"
} mpm_material_failure;

/* What a law of strength is asked: one point. */
typedef struct {
    double strain;    /* equivalent plastic strain, with the cold work before the scene [1] */
    double log_rate;  /* ln(rate / rate_0), at least 0 */
    double T, T_star; /* [K]; (T - reference) / (melting - reference), 0 .. 1 */
} mpm_strength_point;

/* strength MPM_STRENGTH_own: the flow stress in the solid [Pa], above zero; the same for the same point, and callable
 * from several threads at once.  No hash, key or checkpoint knows which function it was. */
typedef struct {
    double (*flow)(const void *user, const mpm_strength_point *at);
    const void *user; /* borrowed as long as a solver that has the material */
} mpm_own_strength;

typedef struct {
    char name[BASE_PARAM_TEXT_SIZE];
    int strength; /* mpm_material_strength */
    int eos;      /* mpm_material_eos */
    int failure;  /* mpm_material_failure, of a body with damage */
#define ROW(member, unit, needs, least, largest, text) double member;
    MATERIAL_CONSTANTS(ROW)
#undef ROW
#define CONSTANT(member, unit, fallback, least, largest, text) double member;
#include "mpm/law/strength.def"
#define CONSTANT(member, unit, fallback, least, largest, text) double member;
#include "mpm/law/eos.def"
#define CONSTANT(member, unit, fallback, least, largest, text) double member;
#include "mpm/law/failure.def"
    mpm_own_strength own_strength; /* MPM_STRENGTH_own alone */
} mpm_material;

/* Every constant OPTIONAL: a file may leave out what its author does not know. */
extern const base_param mpm_material_params[];

/* BASE_STATUS_BAD_INPUT naming the material and every missing constant, unless it has all that `needs` (a sum) asks
 * for. */
base_status mpm_material_check(const mpm_material *m, unsigned needs);

/* With the constants that its laws supply where they are not given. */
mpm_material mpm_material_complete(const mpm_material *m);

/* Of its law of strength; MPM_SHEAR_NONE: it is a fluid, which does not fail. */
mpm_shear_kind mpm_material_shear(const mpm_material *m);

/* Has it a pressure at rest that drives it into a void? */
bool mpm_material_is_gas(const mpm_material *m);

/* Text of the law that has this number in `strength`, `eos` or `failure`. */
const char *mpm_material_strength_text(int kind);
const char *mpm_material_eos_text(int kind);
const char *mpm_material_failure_text(int kind);

/* Elastic constants of the solid.  Bulk modulus K = rho0 c0^2 from the equation of state (what the pressure law (M-3)
 * uses), shear modulus G = E / (2 (1 + nu)) from E and nu; so E / (3 (1 - 2 nu)) is not used anywhere and differs from
 * K by some per cent.  Speeds: longitudinal sqrt((K + 4/3 G) / rho0), shear sqrt(G / rho0).  NAN where a constant is.
 */
double mpm_material_bulk_modulus(const mpm_material *m);       /* [Pa] */
double mpm_material_shear_modulus(const mpm_material *m);      /* [Pa] */
double mpm_material_longitudinal_speed(const mpm_material *m); /* [m/s] */
double mpm_material_shear_speed(const mpm_material *m);        /* [m/s] */

/* Hydrodynamic impedance match of a planar impact at `velocity` [m/s]; p [Pa], u_target = the target's particle
 * velocity [m/s].  Hugoniot p = rho0 (c0 + s u) u of each. */
base_status mpm_impedance_match(const mpm_material *flyer, const mpm_material *target, double velocity, double *p,
                                double *u_target);

#ifndef BREECH_INSIDE
#undef MATERIAL_CONSTANTS
#endif

#ifdef __cplusplus
}
#endif

#endif
