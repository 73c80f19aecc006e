/* SPDX-License-Identifier: BSD-3-Clause */
#include "mpm/material.h"

#include <stdbool.h>
#include <stdio.h>
#include <string.h>

/* ---- the tables ---- */

static const char *const strength_names[] = {
#define STRENGTH(name, shear, text) #name,
#include "mpm/law/strength.def"
    NULL
};

static const char *const eos_names[] = {
#define EOS(name, text) #name,
#include "mpm/law/eos.def"
    NULL
};

static const char *const failure_names[] = {
#define FAILURE(name, text) #name,
#include "mpm/law/failure.def"
    NULL
};

#define NUMBER(member, unit, least, largest, text) \
    PARAM_DOUBLE(mpm_material, member, unit, OPTIONAL, least, largest, text),

const base_param mpm_material_params[] = {
    PARAM_STRING(mpm_material, name, NULL, "name of the material, the same as its file's"),
    PARAM_ENUM(mpm_material, strength, strength_names, MPM_STRENGTH_johnson_cook, "law of the flow stress"),
    PARAM_ENUM(mpm_material, eos, eos_names, MPM_EOS_mie_gruneisen, "equation of state"),
    PARAM_ENUM(mpm_material, failure, failure_names, MPM_FAILURE_johnson_cook, "law of failure, where damage is on"),
#define ROW(member, unit, needs, least, largest, text) NUMBER(member, unit, least, largest, text)
    MATERIAL_CONSTANTS(ROW)
#undef ROW
#define CONSTANT(member, unit, fallback, least, largest, text) NUMBER(member, unit, least, largest, text)
#include "mpm/law/strength.def"
#define CONSTANT(member, unit, fallback, least, largest, text) NUMBER(member, unit, least, largest, text)
#include "mpm/law/eos.def"
#define CONSTANT(member, unit, fallback, least, largest, text) NUMBER(member, unit, least, largest, text)
#include "mpm/law/failure.def"
        PARAMS_END
};

/* What the laws ask for: the name of a law, then its constants, and so on.  fallback: REQUIRED, OPTIONAL or a number */
typedef struct {
    const char *law, *key; /* one of the two */
    size_t offset;
    double fallback;
} law_row;

#define OWN_ROW(member, unit, fallback, least, largest, text) \
    { NULL, #member, offsetof(mpm_material, member), fallback },
#define NEEDED_ROW(member) { NULL, #member, offsetof(mpm_material, member), REQUIRED },

static const law_row strength_rows[] = {
#define STRENGTH(name, shear, text) { .law = text },
#define CONSTANT OWN_ROW
#define NEEDS NEEDED_ROW
#include "mpm/law/strength.def"
    { .law = "" }
};

static const law_row eos_rows[] = {
#define EOS(name, text) { .law = text },
#define CONSTANT OWN_ROW
#define NEEDS NEEDED_ROW
#include "mpm/law/eos.def"
    { .law = "" }
};

static const law_row failure_rows[] = {
#define FAILURE(name, text) { .law = text },
#define CONSTANT OWN_ROW
#define NEEDS NEEDED_ROW
#include "mpm/law/failure.def"
    { .law = "" }
};

/* The row that names the law of this number; its constants follow. */
static const law_row *law_find(const law_row *row, int kind)
{
    for (; row->law == NULL || (row->law[0] && kind-- > 0); row++) continue;
    return row;
}

mpm_shear_kind mpm_material_shear(const mpm_material *m)
{
    static const mpm_shear_kind of[] = {
#define STRENGTH(name, shear, text) MPM_SHEAR_##shear,
#include "mpm/law/strength.def"
    };
    return of[m->strength];
}

bool mpm_material_is_gas(const mpm_material *m)
{
    return m->eos == MPM_EOS_stiffened_gas && m->gas_stiffness == 0;
}

const char *mpm_material_strength_text(int kind)
{
    return law_find(strength_rows, kind)->law;
}

const char *mpm_material_eos_text(int kind)
{
    return law_find(eos_rows, kind)->law;
}

const char *mpm_material_failure_text(int kind)
{
    return law_find(failure_rows, kind)->law;
}

/* ---- what a study needs ---- */

typedef struct {
    unsigned needs; /* sum of mpm_material_need */
    size_t offset;
    const char *key;
} common_row;

static const common_row common_rows[] = {
#define ROW(member, unit, needs, least, largest, text) { needs, offsetof(mpm_material, member), #member },
    MATERIAL_CONSTANTS(ROW)
#undef ROW
};

typedef struct {
    char text[400];
    size_t length;
} key_list;

static void list_add(key_list *list, const char *key)
{
    char last[80], all[sizeof list->text + 4];
    snprintf(last, sizeof last, ", %s,", key);
    snprintf(all, sizeof all, ", %s,", list->text);
    if (list->length >= sizeof list->text || strstr(all, last)) return;
    list->length += (size_t)snprintf(list->text + list->length, sizeof list->text - list->length, "%s%s",
                                     list->length ? ", " : "", key);
}

static double *constant_at(const mpm_material *m, size_t offset)
{
    return (double *)(void *)((char *)m + offset);
}

static void list_missing(key_list *list, const mpm_material *m, const law_row *rows, int kind)
{
    for (const law_row *row = law_find(rows, kind) + 1; !row->law; row++)
        if (isinf(row->fallback) && isnan(*constant_at(m, row->offset))) list_add(list, row->key);
}

status mpm_material_check(const mpm_material *m, unsigned needs)
{
    key_list missing = { .length = 0 };
    for (size_t i = 0; i < sizeof common_rows / sizeof common_rows[0]; i++)
        if (common_rows[i].needs & needs && isnan(*constant_at(m, common_rows[i].offset)))
            list_add(&missing, common_rows[i].key);
    if (needs & MPM_MATERIAL_FOR_SCENE) list_missing(&missing, m, strength_rows, m->strength);
    if (needs & MPM_MATERIAL_FOR_SCENE) list_missing(&missing, m, eos_rows, m->eos);
    const bool fluid = mpm_material_shear(m) == MPM_SHEAR_NONE;
    if (needs & MPM_MATERIAL_FOR_DAMAGE && !fluid) list_missing(&missing, m, failure_rows, m->failure);
    CHECK(missing.length == 0, STATUS_BAD_INPUT, "material %.40s lacks what this study needs: %s", m->name,
          missing.text);
    TRY(base_params_check(mpm_material_params, m, m->name));
    CHECK(!(needs & MPM_MATERIAL_FOR_SCENE) || fluid || m->density >= 100, STATUS_BAD_INPUT,
          "material %.40s: density = %g kg/m^3: a solid has at least 100 kg/m^3", m->name, m->density);
    CHECK(!(m->melting_temperature <= m->reference_temperature), STATUS_BAD_INPUT,
          "material %.40s: melting_temperature = %g K must lie above reference_temperature = %g K", m->name,
          m->melting_temperature, m->reference_temperature);
    return status_ok();
}

static void supply(mpm_material *m, const law_row *rows, int kind)
{
    for (const law_row *row = law_find(rows, kind) + 1; !row->law; row++)
        if (isfinite(row->fallback) && isnan(*constant_at(m, row->offset)))
            *constant_at(m, row->offset) = row->fallback;
}

mpm_material mpm_material_complete(const mpm_material *m)
{
    mpm_material full = *m;
    supply(&full, strength_rows, m->strength);
    supply(&full, eos_rows, m->eos);
    supply(&full, failure_rows, m->failure);
    return full;
}

/* ---- derived ---- */

double mpm_material_shear_modulus(const mpm_material *m)
{
    return m->youngs_modulus / (2.0 * (1.0 + m->poisson));
}

double mpm_material_bulk_modulus(const mpm_material *m)
{
    return m->density * m->sound_speed * m->sound_speed;
}

double mpm_material_longitudinal_speed(const mpm_material *m)
{
    return sqrt((mpm_material_bulk_modulus(m) + 4.0 / 3.0 * mpm_material_shear_modulus(m)) / m->density);
}

double mpm_material_shear_speed(const mpm_material *m)
{
    return sqrt(mpm_material_shear_modulus(m) / m->density);
}

/* With the flyer's rho_f, c_f, s_f, the target's rho_t, c_t, s_t and the target's particle velocity u,
 *   p = rho_t (c_t + s_t u) u = rho_f (c_f + s_f (v - u)) (v - u)                         (M-22) [Pa]
 * is a u^2 + b u - d = 0; at u = 0 its left side is -d < 0 and at u = v it is the target's p > 0, so one root lies
 * between; the form below finds it without cancellation for either sign of a. */
status mpm_impedance_match(const mpm_material *flyer, const mpm_material *target, double velocity, double *p,
                           double *u_target)
{
    CHECK(velocity >= 0.0 && velocity <= 1e5, STATUS_BAD_INPUT, "impact velocity = %g m/s: must be 0 .. 1e5 m/s",
          velocity);
    const mpm_material *pair[2] = { flyer, target };
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
