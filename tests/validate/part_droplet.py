# SPDX-License-Identifier: BSD-3-Clause
"""A droplet of 36 um between its two gauges over velocity and cells a radius."""
from pages import Column, Table
from part_growth import cell

CASE = "cases/initiators/deposit.yaml"
MEASURES = {  # key of the summary: title of the column, unit, digits, what a fresh one may differ by
    "growth_per_way": ("growth [1/mm]", 1e3, 1, 0.25),
    "length_over_width": ("length over width", 1.0, 1, 0.25),
    "crater_length": ("length [um]", 1e-6, 0, 0.25),
    "crater_depth": ("depth [um]", 1e-6, 0, 0.25),
}
RESOLUTIONS = {  # cells a radius: velocities [m/s], grids of each
    3: ((1000, 1300, 1600, 1900), 3),
    6: ((1000, 1300, 1600, 1900), 3),
    8: ((1600,), 3),
}


def droplet(runs):
    columns = [Column("cells a radius, velocity"), Column("class", words=False)]
    columns += [Column(title, share) for title, _, _, share in MEASURES.values()]
    rows = []
    for cells, (velocities, grids) in RESOLUTIONS.items():
        for velocity in velocities:
            scene = runs.scene("droplet%d_%d" % (cells, velocity), CASE, grids, scene__velocity="%d m/s" % velocity,
                               scene__cells_per_radius=cells)
            found = [grid["values"] for grid in scene.summary["scenes"]]
            rows.append(["%d, %d m/s" % (cells, velocity), scene.class_text()] +
                        [cell(found, key, digits, unit) for key, (_, unit, digits, _) in MEASURES.items()])
    return [Table(columns, rows)], NOTE


NOTE = ("`breech scene cases/initiators/deposit.yaml` with `scene.velocity` and `scene.cells_per_radius`, to its second gauge; mean ± "
        "standard deviation over three shifted grids, of those whose groove lived to where a figure is taken")
