#include "mpm/material.h"

#include <stdio.h>

/* Everything is OPTIONAL but the name: a file may leave out what its author does not know, and mpm_material_check
 * refuses the study that needs it.  The ranges are those of metals with room to spare: they catch a wrong unit or a
 * slip of the decimal point, not a poor value. */
#define NUMBER(member, unit, min, max, doc) PARAM_DOUBLE(material, member, unit, OPTIONAL, min, max, doc)

static const char *const strength_names[] = { "johnson_cook", "ptw", NULL };

const param mpm_material_params[] = {
    PARAM_STRING(material, name, NULL, "name of the material, the same as its file's"),
    PARAM_ENUM(material, strength, strength_names, STRENGTH_JOHNSON_COOK,
               "flow stress: Johnson-Cook (M-1) or Preston-Tonks-Wallace (M-23)"),
    NUMBER(density, "kg/m^3", 100.0, 3e4, "density at the reference temperature"),
    NUMBER(youngs_modulus, "Pa", 1e6, 2e12, "Young's modulus"),
    NUMBER(poisson, "1", 0.0, 0.499, "Poisson's ratio"),
    NUMBER(specific_heat, "J/(kg K)", 10.0, 1e4, "specific heat"),
    NUMBER(conductivity, "W/(m K)", 1e-2, 5e3, "thermal conductivity"),
    NUMBER(reference_temperature, "K", 1.0, 2e3, "temperature at which the strength constants hold"),
    NUMBER(melting_temperature, "K", 200.0, 5e3, "melting temperature (solidus)"),
    NUMBER(latent_heat, "J/kg", 1e3, 1e7, "latent heat of fusion"),
    NUMBER(yield_A, "Pa", 0.0, 1e10, "Johnson-Cook A: yield stress"),
    NUMBER(hardening_B, "Pa", 0.0, 1e10, "Johnson-Cook B: hardening"),
    NUMBER(hardening_n, "1", 0.0, 2.0, "Johnson-Cook n: hardening exponent"),
    NUMBER(rate_C, "1", 0.0, 1.0, "Johnson-Cook C: rate sensitivity"),
    NUMBER(softening_m, "1", 0.0, 10.0, "Johnson-Cook m: thermal softening exponent"),
    NUMBER(rate_0, "1/s", 1e-6, 1e6, "Johnson-Cook reference strain rate; slower ones count as this, in (M-23) too"),
    NUMBER(ptw_theta, "1", 0.0, 10.0, "Preston-Tonks-Wallace theta: first rate of hardening"),
    NUMBER(ptw_p, "1", 0.0, 20.0, "Preston-Tonks-Wallace p: hardening"),
    NUMBER(ptw_s0, "1", 1e-6, 1.0, "Preston-Tonks-Wallace s0: saturation stress at T = 0"),
    NUMBER(ptw_s_inf, "1", 0.0, 1.0, "Preston-Tonks-Wallace s_inf: saturation stress when hot"),
    NUMBER(ptw_kappa, "1", 0.0, 10.0, "Preston-Tonks-Wallace kappa: dependence on temperature"),
    NUMBER(ptw_gamma, "1", 1e-9, 1.0, "Preston-Tonks-Wallace gamma: dependence on strain rate"),
    NUMBER(ptw_y0, "1", 0.0, 1.0, "Preston-Tonks-Wallace y0: yield stress at T = 0"),
    NUMBER(ptw_y_inf, "1", 0.0, 1.0, "Preston-Tonks-Wallace y_inf: yield stress when hot"),
    NUMBER(ptw_y1, "1", 0.0, 10.0, "Preston-Tonks-Wallace y1: yield stress at middling rates"),
    NUMBER(ptw_y2, "1", 0.0, 2.0, "Preston-Tonks-Wallace y2: its exponent"),
    NUMBER(ptw_beta, "1", 0.0, 1.0, "Preston-Tonks-Wallace beta: exponent of the overdriven regime"),
    NUMBER(ptw_G0, "Pa", 1e6, 1e12, "Preston-Tonks-Wallace shear modulus at T = 0"),
    NUMBER(ptw_alpha, "1", 0.0, 0.95, "Preston-Tonks-Wallace alpha: share of that modulus lost at melting"),
    NUMBER(ptw_cold_work, "1", 0.0, 100.0,
           "Preston-Tonks-Wallace: plastic strain the metal has had before; not given: none"),
    NUMBER(molar_mass, "kg/mol", 1e-3, 0.5, "molar mass"),
    NUMBER(taylor_quinney, "1", 0.0, 1.0, "share of plastic work that becomes heat (heat by plastic work only)"),
    NUMBER(damage_D1, "1", -10.0, 100.0, "Johnson-Cook failure D1"),
    NUMBER(damage_D2, "1", -10.0, 100.0, "Johnson-Cook failure D2"),
    NUMBER(damage_D3, "1", -20.0, 20.0,
           "Johnson-Cook failure D3, times mean stress / von Mises stress, tension positive"),
    NUMBER(damage_D4, "1", -1.0, 10.0, "Johnson-Cook failure D4: strain rate"),
    NUMBER(damage_D5, "1", -10.0, 100.0, "Johnson-Cook failure D5: temperature"),
    NUMBER(spall_strength, "Pa", 0.0, 1e11, "tension at which it fails"),
    NUMBER(sound_speed, "m/s", 100.0, 2e4, "bulk sound speed c0 of us = c0 + s up"),
    NUMBER(hugoniot_slope, "1", 0.0, 5.0, "slope s of us = c0 + s up"),
    NUMBER(gruneisen, "1", 0.0, 10.0, "Grueneisen coefficient at the reference density"),
    NUMBER(hardness, "Pa", 1e6, 1e11, "Vickers hardness as a pressure"),
    NUMBER(resistivity, "ohm m", 1e-10, 1e-3, "electrical resistivity at the reference temperature"),
    NUMBER(resistivity_slope, "1/K", -0.1, 0.1, "temperature coefficient of the resistivity"),
    PARAMS_END
};

/* ---- what a study needs ---- */

typedef struct {
    unsigned needs; /* sum of material_need */
    size_t offset;
} needed;

#define NEED(member, needs_)                 \
    {                                        \
        (needs_), offsetof(material, member) \
    }

/* What a scene needs besides, by the material's law of strength; not of material_need. */
enum { FOR_JOHNSON_COOK = 1 << 16, FOR_PTW = 1 << 17 };

/* (M-1) and (M-2) divide by melting - reference temperature, so these come with strength as with failure. */
static const needed needed_constants[] = {
    NEED(density, MATERIAL_FOR_SCENE | MATERIAL_FOR_SCREEN),
    NEED(youngs_modulus, MATERIAL_FOR_SCENE),
    NEED(poisson, MATERIAL_FOR_SCENE),
    NEED(specific_heat, MATERIAL_FOR_SCENE),
    NEED(reference_temperature, MATERIAL_FOR_SCENE | MATERIAL_FOR_DAMAGE | MATERIAL_FOR_MELTING),
    NEED(melting_temperature, MATERIAL_FOR_SCENE | MATERIAL_FOR_DAMAGE | MATERIAL_FOR_MELTING),
    NEED(latent_heat, MATERIAL_FOR_MELTING),
    NEED(yield_A, FOR_JOHNSON_COOK),
    NEED(hardening_B, FOR_JOHNSON_COOK),
    NEED(hardening_n, FOR_JOHNSON_COOK),
    NEED(rate_C, FOR_JOHNSON_COOK),
    NEED(softening_m, FOR_JOHNSON_COOK),
    NEED(rate_0, MATERIAL_FOR_SCENE | MATERIAL_FOR_DAMAGE),
    NEED(ptw_theta, FOR_PTW),
    NEED(ptw_p, FOR_PTW),
    NEED(ptw_s0, FOR_PTW),
    NEED(ptw_s_inf, FOR_PTW),
    NEED(ptw_kappa, FOR_PTW),
    NEED(ptw_gamma, FOR_PTW),
    NEED(ptw_y0, FOR_PTW),
    NEED(ptw_y_inf, FOR_PTW),
    NEED(ptw_y1, FOR_PTW),
    NEED(ptw_y2, FOR_PTW),
    NEED(ptw_beta, FOR_PTW),
    NEED(ptw_G0, FOR_PTW),
    NEED(ptw_alpha, FOR_PTW),
    NEED(molar_mass, FOR_PTW),
    NEED(damage_D1, MATERIAL_FOR_DAMAGE),
    NEED(damage_D2, MATERIAL_FOR_DAMAGE),
    NEED(damage_D3, MATERIAL_FOR_DAMAGE),
    NEED(damage_D4, MATERIAL_FOR_DAMAGE),
    NEED(damage_D5, MATERIAL_FOR_DAMAGE),
    NEED(sound_speed, MATERIAL_FOR_SCENE | MATERIAL_FOR_SCREEN),
    NEED(hugoniot_slope, MATERIAL_FOR_SCENE | MATERIAL_FOR_SCREEN),
    NEED(gruneisen, MATERIAL_FOR_SCENE),
    NEED(hardness, MATERIAL_FOR_SCREEN),
    NEED(resistivity, MATERIAL_FOR_CIRCUIT),
};

static const char *key_of(size_t offset)
{
    for (const param *p = mpm_material_params; p->key; p++)
        if (p->offset == offset) return p->key;
    return "?";
}

status mpm_material_check(const material *m, unsigned needs)
{
    char missing[400] = "";
    size_t length = 0;
    const unsigned law = m->strength == STRENGTH_PTW ? FOR_PTW : FOR_JOHNSON_COOK;
    const unsigned all = needs & MATERIAL_FOR_SCENE ? needs | law : needs;
    for (size_t i = 0; i < sizeof needed_constants / sizeof needed_constants[0]; i++) {
        const needed *c = &needed_constants[i];
        const double value = *(const double *)(const void *)((const char *)m + c->offset);
        if (!(c->needs & all) || !isnan(value) || length >= sizeof missing) continue;
        length +=
            (size_t)snprintf(missing + length, sizeof missing - length, "%s%s", length ? ", " : "", key_of(c->offset));
    }
    CHECK(length == 0, STATUS_BAD_INPUT, "material %.40s lacks what this study needs: %s", m->name, missing);
    TRY(base_params_check(mpm_material_params, m, m->name));
    const unsigned hot = MATERIAL_FOR_SCENE | MATERIAL_FOR_DAMAGE | MATERIAL_FOR_MELTING;
    CHECK(!(needs & hot) || m->melting_temperature > m->reference_temperature, STATUS_BAD_INPUT,
          "material %.40s: melting_temperature = %g K must lie above reference_temperature = %g K", m->name,
          m->melting_temperature, m->reference_temperature);
    return status_ok();
}

/* ---- derived ---- */

double mpm_material_shear_modulus(const material *m)
{
    return m->youngs_modulus / (2.0 * (1.0 + m->poisson));
}

double mpm_material_bulk_modulus(const material *m)
{
    return m->density * m->sound_speed * m->sound_speed;
}

double mpm_material_longitudinal_speed(const material *m)
{
    return sqrt((mpm_material_bulk_modulus(m) + 4.0 / 3.0 * mpm_material_shear_modulus(m)) / m->density);
}

double mpm_material_shear_speed(const material *m)
{
    return sqrt(mpm_material_shear_modulus(m) / m->density);
}

/* With the flyer's rho_f, c_f, s_f, the target's rho_t, c_t, s_t and the target's particle velocity u,
 *   p = rho_t (c_t + s_t u) u = rho_f (c_f + s_f (v - u)) (v - u)                         (M-22) [Pa]
 * is a u^2 + b u - d = 0; at u = 0 its left side is -d < 0 and at u = v it is the target's p > 0, so one root lies
 * between; the form below finds it without cancellation for either sign of a. */
status mpm_impedance_match(const material *flyer, const material *target, double velocity, double *p, double *u_target)
{
    CHECK(velocity >= 0.0 && velocity <= 1e5, STATUS_BAD_INPUT, "impact velocity = %g m/s: must be 0 .. 1e5 m/s",
          velocity);
    const material *pair[2] = { flyer, target };
    for (int i = 0; i < 2; i++)
        CHECK(pair[i]->density > 0.0 && pair[i]->sound_speed > 0.0 && pair[i]->hugoniot_slope >= 0.0, STATUS_BAD_INPUT,
              "material %.40s lacks density, sound_speed or hugoniot_slope: no impedance match", pair[i]->name);
    const double z_f = flyer->density * flyer->sound_speed, q_f = flyer->density * flyer->hugoniot_slope;
    const double z_t = target->density * target->sound_speed, q_t = target->density * target->hugoniot_slope;
    const double a = q_t - q_f, b = z_t + z_f + 2.0 * q_f * velocity, d = (z_f + q_f * velocity) * velocity;
    const double u = 2.0 * d / (b + sqrt(b * b + 4.0 * a * d));
    *u_target = u;
    *p = (z_t + q_t * u) * u;
    return status_ok();
}
