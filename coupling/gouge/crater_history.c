/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/gouge/crater_history.h"

status gouge_crater_record(const crater *c, const scene_result *r, history *h, const char *scene)
{
    const history_number numbers[] = {
        { "severity", c->severity },     { "widening", c->widening },
        { "length_m", c->length },       { "width_m", c->width },
        { "depth_m", c->depth },         { "volume_m3", c->volume },
        { "rim_x_m", c->rim_x },         { "rim_height_m", c->rim_height },
        { "deepest_x_m", c->deepest_x }, { "measuring_depth_m", c->measuring_depth },
    };
    const history_text texts[] = { { "class", run_damage_names[r->class] },
                                   { "reason", r->reason },
                                   { "crater_class", run_damage_names[r->crater_class] },
                                   { "crater_reason", r->crater_reason } };
    const history_map map = { .name = "crater",
                              .across = { { "x", "m", "along the rail, middle of a map cell" },
                                          { "z", "m", "across the rail, middle of a map cell" } },
                              .value = { "depth", "m", "depth below the undamaged surface over (x, z), rim negative" },
                              .n = { c->nx, c->nz },
                              .first = { c->x0, c->z0 },
                              .step = { c->dx, c->dz },
                              .values = c->depth_map,
                              .numbers = sizeof numbers / sizeof *numbers,
                              .number = numbers,
                              .texts = sizeof texts / sizeof *texts,
                              .text = texts };
    return output_history_map(h, scene, &map);
}
