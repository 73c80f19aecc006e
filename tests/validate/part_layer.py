# SPDX-License-Identifier: BSD-3-Clause
"""A groove in a rail under a layer thinner than the grain's cells, over velocity and the cells across the layer."""
from pages import Column, Table
from part_growth import cell

CASE = "cases/thin_layer"
COMMON = {"scene__stop_when_gauged": "yes", "scene__contact_pressure": "60 MPa"}
THICKNESS = 0.1  # [mm]
RADIUS = 0.5
MEASURES = {  # key of the summary: title of the column, unit, digits, what a fresh one may differ by
    "groove_growth": ("growth [1/us]", 1e6, 3, 0.1),
    "length_over_width": ("length over width", 1.0, 1, 0.25),
    "crater_depth": ("depth [mm]", 1e-3, 2, 0.15),
}
ROWS = [  # cells a radius, cells of the layer's own across it (0: none), velocities [m/s]
    (3, 0, (1200, 1400, 1700)),
    (3, 2, (1200, 1400, 1700)),
    (3, 4, (1400, 1700)),
    (6, 0, (1200, 1400)),
    (6, 2, (1200, 1400)),
]


def across(cells, own):
    """Cells across the layer: the grain's are halved until so many are, or almost."""
    size = RADIUS / cells
    while own and 1.1 * THICKNESS / own < size:
        size /= 2
    return THICKNESS / size


def layer(runs):
    columns = [Column("cells a radius; across the layer", words=False), Column("velocity [m/s]"), Column("class", words=False)]
    columns += [Column(title, share) for title, _, _, share in MEASURES.values()] + [Column("processor time [s]", words=False)]
    rows = []
    for cells, own, velocities in ROWS:
        for velocity in velocities:
            scene = runs.scene("layer%d_%d_%d" % (cells, own, velocity), CASE, 3, scene__velocity="%d m/s" % velocity,
                               scene__cells_per_radius=cells, scene__cells_per_layer=own, **COMMON)
            found = [grid["values"] for grid in scene.summary["scenes"]]
            rows.append(["%d; %.1f" % (cells, across(cells, own)), "%d" % velocity, scene.class_text()] +
                        [cell(found, key, digits, unit) for key, (_, unit, digits, _) in MEASURES.items()] +
                        ["%.0f" % scene.run["processor"]])
    return [Table(columns, rows)], NOTE


NOTE = ("`breech scene cases/thin_layer` with `scene.cells_per_radius` and `scene.cells_per_layer`, to its second gauge, pressed on with 60 MPa; "
        "mean ± standard deviation over three shifted grids of those whose groove lived; times of all three")
