/* SPDX-License-Identifier: BSD-3-Clause */
/* A shot: fifteen 200 kJ units, one after the other, drive 0.25 kg along 3 m of copper rails. */
#include "circuit/shot.h"

#include <stdio.h>

int main(void)
{
    circuit_shot_module unit[13];
    circuit_shot_config c = { .supplies[CIRCUIT_SUPPLY_capacitor] = { 13, unit } };
    for (int k = 0; k < 13; k++) {
        base_params_default(circuit_supply_capacitor_params, &unit[k]);
        unit[k].count = k == 0 ? 3 : 1, unit[k].fire_at = 0.22e-3 * k;
        unit[k].capacitance = 3.594e-3, unit[k].charge = 10.55e3, unit[k].inductance = 12.56e-6,
        unit[k].resistance = 4.10e-3;
        unit[k].crowbar_drop = 1.48, unit[k].crowbar_resistance = 0.43e-3;
        unit[k].cable_inductance = 1e-6, unit[k].cable_resistance = 1e-3;
    }
    base_params_default(circuit_shot_rails_params, &c.rails);
    base_params_default(circuit_shot_barrel_params, &c.barrel);
    base_params_default(circuit_shot_armature_params, &c.armature);
    base_params_default(circuit_shot_options_params, &c.options);
    c.rails.height = c.rails.separation = 25e-3, c.rails.thickness = 20e-3;
    c.barrel.start = 0.1, c.barrel.length = 3.0;
    c.armature.mass = 0.25, c.armature.resistance = 20e-6, c.armature.contact_voltage = 30;
    c.armature.preload = 3.1e3, c.armature.spreading = 8e-9, c.armature.friction_dry = 0.3,
    c.armature.friction_melted = 0.05;
    c.armature.contact_length = 16.5e-3, c.armature.contact_width = 25e-3;

    circuit_shot *s = NULL;
    base_status done = circuit_shot_create(&c, &s);
    if (done.code == BASE_STATUS_OK) done = circuit_shot_advance(s, 20e-3, NULL);
    if (done.code == BASE_STATUS_OK) printf("%.1f m/s\n", circuit_shot_result(s).muzzle_velocity);
    if (done.code != BASE_STATUS_OK) fprintf(stderr, "%s\n", done.text);
    circuit_shot_free(s);
    return done.code == BASE_STATUS_OK ? 0 : 1;
}
