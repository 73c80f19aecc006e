# SPDX-License-Identifier: BSD-3-Clause
"""Do craters hang on how cells are chosen?  Scenes as they are, and with one choice changed at a time."""
from pages import Column, Table

COLUMNS = [Column("scene"), Column("class"), Column("volume [mm3]", 0.1), Column("length [mm]", 0.1),
           Column("width [mm]", 0.1), Column("depth [mm]", 0.1)]
CHANGES = {  # of both cases; what a window half as large again is, each says of itself
    "nothing": {},
    "half the tolerance": {"scene__refine_tolerance": 0.025},
    "twice the tolerance": {"scene__refine_tolerance": 0.1},
    "two levels": {"scene__levels": 2},
}
WINDOW = "a window half as large again"
DEFAULT_SHOT = {"scene__contact_pressure": "60 MPa", "scene__end_time": "8 us", "scene__cells_per_radius": 2}
DEFAULT_SHOT_WINDOW = {"scene__rail_ahead": "21 mm", "scene__rail_behind": "15 mm", "scene__rail_depth": "12 mm"}
PAPER_WINDOW = {"scene__rail_ahead": "21 mm", "scene__rail_behind": "15 mm", "scene__rail_depth": "15 mm"}


def row(name, scene):
    return [name, scene.class_text(), scene["crater_volume"].text(2, 1e-9), scene["crater_length"].text(2, 1e-3),
            scene["crater_width"].text(2, 1e-3), scene["crater_depth"].text(3, 1e-3)]


def default_shot(runs):
    rows = []
    for velocity in (1000, 1300, 1600):
        for name, change in {**CHANGES, WINDOW: DEFAULT_SHOT_WINDOW}.items():
            scene = runs.scene("levels_%d_%s" % (velocity, name.replace(" ", "_")), "cases/default_shot/former.yaml", 3,
                               scene__velocity="%d m/s" % velocity, **{**DEFAULT_SHOT, **change})
            rows.append(row("%d m/s, %s" % (velocity, name), scene))
    return [Table(COLUMNS, rows)], ("cases/default_shot/former.yaml pressed on with 60 MPa, two cells a radius, the first "
                                    "8 us; mean ± standard deviation over three shifted grids")


def paper(runs):
    """The paper's base case, W1, to its end."""
    rows = []
    for name, change in {**CHANGES, WINDOW: PAPER_WINDOW}.items():
        scene = runs.scene("levels_paper_" + name.replace(" ", "_"), "cases/wu2017/coarse.yaml", 3, **change)
        rows.append(row("1500 m/s, " + name, scene))
    return [Table(COLUMNS, rows)], ("cases/wu2017/coarse.yaml, two cells a radius; mean ± standard deviation over three "
                                    "shifted grids")
