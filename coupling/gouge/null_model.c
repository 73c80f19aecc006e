/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/gouge/null_model.h"

#include <math.h>

static const double MEASURED = 1325.0, MEASURED_LOW = 1300.0, MEASURED_HIGH = 1350.0; /* [m/s] */

/* The pair they are calibrated on, as cases/materials has it (tests/test_handoff.c compares). */
static const mpm_material al7075 = { .name = "al7075_t651",
                                     .density = 2804.0,
                                     .sound_speed = 5200.0,
                                     .hugoniot_slope = 1.36,
                                     .hardness = 1.7e9 },
                          copper = { .name = "ofhc_copper",
                                     .density = 8960.0,
                                     .sound_speed = 3940.0,
                                     .hugoniot_slope = 1.489,
                                     .hardness = 0.725e9 };

/* A pair's numbers, a the armature, b the rail [kg/m3, Pa]. */
typedef struct {
    double density_a, density_b, hardness_a, hardness_b;
} pair;

/* N1's: of the pair at that velocity [1]. */
static status pressure_ratio(double velocity, double *ratio)
{
    double p, u;
    TRY(mpm_impedance_match(&al7075, &copper, velocity, &p, &u));
    *ratio = p / fmax(al7075.hardness, copper.hardness);
    return status_ok();
}

static status planar(const case_surface *s, double height, double calibration, double *velocity)
{
    double ratio;
    TRY(pressure_ratio(calibration, &ratio));
    return gouge_screen_velocity(s, height, ratio, velocity);
}

/* N2's velocity but for its constant: v = (1 + sqrt(rho_b / rho_a)) sqrt(H_max / rho_b) [m/s] */
static double bernoulli(const pair *m)
{
    return (1.0 + sqrt(m->density_b / m->density_a)) * sqrt(fmax(m->hardness_a, m->hardness_b) / m->density_b);
}

/* N3's: v = sqrt((H_a + H_b) / (rho_a + rho_b)) [m/s] */
static double hardness_over_density(const pair *m)
{
    return sqrt((m->hardness_a + m->hardness_b) / (m->density_a + m->density_b));
}

/* One whose velocity is a constant times its function of the pair. */
static void scaled(double (*of)(const pair *), const pair *m, null_model *out)
{
    const pair calibrated = { al7075.density, copper.density, al7075.hardness, copper.hardness };
    const double by = of(m) / of(&calibrated);
    out->threshold_velocity = MEASURED * by;
    out->threshold_interval[0] = MEASURED_LOW * by;
    out->threshold_interval[1] = MEASURED_HIGH * by;
}

status gouge_null_models(const case_surface *s, double height, null_model out[NULL_MODELS])
{
    screen under;
    out[0] = (null_model){ .name = "N1", .says = "planar impact pressure over the hardness of the harder partner" };
    out[1] =
        (null_model){ .name = "N2", .says = "pressure of two fluids meeting over the hardness of the harder partner" };
    out[2] = (null_model){ .name = "N3", .says = "hardness of both over density of both" };
    TRY(gouge_screen_impact(s, height, MEASURED, &under));
    const pair m = { s->armature->density, under.density, s->armature_hardness, under.hardness };
    TRY(planar(s, height, MEASURED, &out[0].threshold_velocity));
    TRY(planar(s, height, MEASURED_LOW, &out[0].threshold_interval[0]));
    TRY(planar(s, height, MEASURED_HIGH, &out[0].threshold_interval[1]));
    scaled(bernoulli, &m, &out[1]);
    scaled(hardness_over_density, &m, &out[2]);
    return status_ok();
}
