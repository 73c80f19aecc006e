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
FILM = {"rail__layers[0]__material": "nickel", "rail__layers[0]__thickness": "20 um", "particle__radius": "0.1 mm",
        "scene__damage": "no",  # nickel has no constants of failure
        "scene__coarse_cell": "1 mm"}  # leaves levels for four cells across
CELLS_OF_FILM = 2.5  # halved twice and three times: two and four across it
ROWS_OF_FILM = [(2, 1150), (2, 1450), (4, 1450)]  # cells of its own across it, velocity [m/s]


def across(cells, own):
    """Cells across the layer: the grain's are halved until so many are, or almost."""
    size = RADIUS / cells
    while own and 1.1 * THICKNESS / own < size:
        size /= 2
    return THICKNESS / size


COLUMNS = [Column("cells a radius; across the layer", words=False), Column("velocity [m/s]"), Column("class", words=False)]
COLUMNS += [Column(title, share) for title, _, _, share in MEASURES.values()] + [Column("processor time [s]", words=False)]


def row(runs, name, label, velocity, **settings):
    scene = runs.scene(name, CASE, 3, scene__velocity="%d m/s" % velocity, **settings, **COMMON)
    found = [grid["values"] for grid in scene.summary["scenes"]]
    return ([label, "%d" % velocity, scene.class_text()] +
            [cell(found, key, digits, unit) for key, (_, unit, digits, _) in MEASURES.items()] +
            ["%.0f" % scene.run["processor"]])


def layer(runs):
    rows = [row(runs, "layer%d_%d_%d" % (cells, own, velocity), "%d; %.1f" % (cells, across(cells, own)), velocity,
                scene__cells_per_radius=cells, scene__cells_per_layer=own)
            for cells, own, velocities in ROWS for velocity in velocities]
    return [Table(COLUMNS, rows)], NOTE


def film(runs):
    """20 um of nickel under a grain of 0.1 mm: is what two cells across say what four do?"""
    rows = [row(runs, "film%d_%d" % (own, velocity), "%g; %.1f" % (CELLS_OF_FILM, across(CELLS_OF_FILM, own)), velocity,
                scene__cells_per_radius=CELLS_OF_FILM, scene__cells_per_layer=own, **FILM)
            for own, velocity in ROWS_OF_FILM]
    return [Table(COLUMNS, rows)], NOTE_OF_FILM


NOTE = ("`breech scene cases/thin_layer` with `scene.cells_per_radius` and `scene.cells_per_layer`, to its second gauge, pressed on with 60 MPa; "
        "mean ± standard deviation over three shifted grids of those whose groove lived; times of all three")

NOTE_OF_FILM = ("the same with `rail.layers[0].material=nickel`, `rail.layers[0].thickness=20 um`, `particle.radius=0.1 mm`, "
                "`scene.damage=no`, `scene.coarse_cell=1 mm`")
