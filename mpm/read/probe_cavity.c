/* SPDX-License-Identifier: BSD-3-Clause */
/* Cavity: pressure, volume and gas of one of the scene's cavities (mpm/cavity.h). */
#include "mpm/memory/cavities.h"
#include "mpm/read/probe_kinds.h"

typedef struct {
    double number;
} values;

static const base_param params[] = {
    PARAM_DOUBLE(values, number, "1", 0.0, 0.0, MPM_MAX_CAVITIES - 1, "of the cavity in the scene's list, 0 the first"),
    PARAMS_END,
};

enum { PRESSURE, VOLUME, FOUND, MOLES, LOST, BURST, OPEN, COLUMNS };

static const mpm_column columns[COLUMNS + 1] = {
    { "pressure", "Pa", "of its gas, above the ambient one; 0 once it is part of another" },
    { "volume", "m^3", "by what the nodes about it have swept" },
    { "found_volume", "m^3", "by empty cells and those about them less the points there" },
    { "moles", "mol", "of gas in it" },
    { "lost", "mol", "gas that has left" },
    { "burst", "1", "1 from when it has burst" },
    { "open", "1",
      "1 while its void comes to the window's end: its gas, whose moles are still counted, has no pressure" },
    { NULL, NULL, NULL },
};

static status check(const mpm_probe *p, const char *name)
{
    const double number = PROBE_VALUES(values, p)->number;
    CHECK(number == floor(number), STATUS_BAD_INPUT, "%s.number = %g: a cavity has a whole number", name, number);
    return status_ok();
}

static status read(const mpm *m, const mpm_probe *p, double *out)
{
    const int k = (int)PROBE_VALUES(values, p)->number;
    for (int i = 0; i < COLUMNS; i++) out[i] = NAN;
    if (k >= m->scene.cavities) return status_ok();
    const mpm_cavity_state *s = mpm_cavity_of(m, k);
    out[PRESSURE] = s->pressure, out[VOLUME] = s->volume, out[FOUND] = s->found;
    out[MOLES] = s->moles, out[LOST] = s->lost, out[BURST] = isnan(s->burst_time) ? 0 : 1, out[OPEN] = s->open;
    return status_ok();
}

const mpm_probe_kind mpm_probe_cavity = { .name = "cavity",
                                          .doc = "pressure, volume and gas of a cavity",
                                          .params = params,
                                          .columns = columns,
                                          .mains = 1,
                                          .check = check,
                                          .read = read };
