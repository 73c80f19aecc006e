/* SPDX-License-Identifier: BSD-3-Clause */
#include "mpm/law/flow_curve.h"

#include "mpm/law/law_lanes.h"

const base_param mpm_flow_test_params[] = {
    PARAM_DOUBLE(mpm_flow_test, strain, "1", 1.0, 0.0, 100.0, "plastic strain at which the curve ends"),
    PARAM_INT(mpm_flow_test, points, 20, 1, 10000, "of the curve, behind its first at no strain"),
    PARAM_DOUBLE(mpm_flow_test, rate, "1/s", 1.0, 1e-6, 1e12,
                 "strain rate; slower than the material's rate_0 counts as that"),
    PARAM_DOUBLE(mpm_flow_test, temperature, "K", 293.0, 1.0, 1e4, "at the start"),
    PARAM_DOUBLE(mpm_flow_test, pressure, "Pa", 0.0, -1e10, 1e12, "held"),
    PARAM_DOUBLE(mpm_flow_test, cold_work, "1", OPTIONAL, 0.0, 100.0,
                 "plastic strain before the test; not given: the material's"),
    PARAM_DOUBLE(mpm_flow_test, yield_scale, "1", 1.0, 1e-3, 1e3, "factor on the flow stress"),
    PARAM_DOUBLE(mpm_flow_test, heat, "1", 0.0, 0.0, 1.0,
                 "fraction of the plastic work that warms it: 0.9 of a test at thousands per second; 0: isothermal"),
    PARAMS_END,
};

static double stress_at(const law *k, double strain, double rate, double T, double pressure)
{
    const double log_rate = log(fmax(rate * k->inv_rate0, 1));
    const flow_state at = { .strain = vd_set(strain),
                            .log_rate = vd_set(log_rate),
                            .T = vd_set(T),
                            .T_star = homologous(k, vd_set(T)),
                            .p = vd_set(pressure),
                            .rho = vd_set(k->rho_start) };
    return flow_stress(k, law_form_of(k, k->kernel), &at)[0];
}

/*   rho c dT = heat sigma_y de, by the midpoint rule */
status mpm_flow_curve(const mpm_material *m, const mpm_flow_test *test, mpm_flow_point *curve)
{
    enum { STEPS = 20 }; /* from one point of the curve to the next */
    mpm_scene scene;
    mpm_scene_default(&scene);
    mpm_body body = { .material = m,
                      .temperature = test->temperature,
                      .pressure = test->pressure,
                      .yield_scale = test->yield_scale,
                      .cold_work = test->cold_work };
    law k;
    TRY(mpm_law_make(&body, &scene, &k));
    CHECK(k.shear != MPM_SHEAR_NONE, STATUS_BAD_INPUT, "%.40s is a fluid: it has no flow stress", m->name);
    const double d = test->strain / (test->points * STEPS), warm = test->heat * k.inv_c / k.rho_start;
    double T = test->temperature, strain = 0;
    for (int i = 0; i <= test->points; i++) {
        strain = i * STEPS * d;
        if (T != body.temperature) { /* as dense as it is now under that pressure */
            body.temperature = T;
            TRY(mpm_law_make(&body, &scene, &k));
        }
        curve[i] = (mpm_flow_point){ strain, stress_at(&k, strain, test->rate, T, test->pressure), T };
        for (int j = 0; j < STEPS; j++, strain += d) {
            const double half = T + 0.5 * warm * d * stress_at(&k, strain, test->rate, T, test->pressure);
            T += warm * d * stress_at(&k, strain + 0.5 * d, test->rate, half, test->pressure);
        }
    }
    return status_ok();
}
