# SPDX-License-Identifier: BSD-3-Clause
"""Do craters hang on how cells are chosen?  Scenes as they are, and with one choice changed at a time."""
from pages import Column, Table
from part_growth import cell

COLUMNS = [Column("scene"), Column("class"), Column("volume [mm3]", 0.1), Column("length [mm]", 0.1),
           Column("width [mm]", 0.1), Column("depth [mm]", 0.1)]
GAUGED = COLUMNS + [Column("growth [1/mm]", 0.1), Column("processor time [s]", words=False)]
CHANGES = {  # of both cases; what a window half as large again is, each says of itself
    "nothing": {},
    "half the tolerance": {"scene__refine_tolerance": 0.0175},
    "twice the tolerance": {"scene__refine_tolerance": 0.07},
    "two levels": {"scene__levels": 2},
    "four levels": {"scene__levels": 4, "scene__coarse_cell": "2 mm"},
}
ONE_LEVEL = {"scene__levels": 1, "scene__coarse_cell": "0.25 mm"}
VELOCITIES = (1000, 1300, 1600)
AT_ONE_LEVEL = 1600  # three grids take half an hour
WINDOW = "a window half as large again"
PRESSED = "cases/default_shot/pressed.yaml"
DEFAULT_SHOT = {"scene__stop_when_gauged": "yes", "scene__cells_per_radius": 2}
DEFAULT_SHOT_WINDOW = {"scene__rail_ahead": "21 mm", "scene__rail_behind": "15 mm", "scene__rail_depth": "12 mm"}
PAPER_WINDOW = {"scene__rail_ahead": "21 mm", "scene__rail_behind": "15 mm", "scene__rail_depth": "15 mm"}


GROWING = [  # whole craters with cells that grow with the groove: name, case, settings
    ("cases/wu2017", "cases/wu2017", {}),
    ("cases/wu2017/coarse.yaml", "cases/wu2017/coarse.yaml", {}),
    ("default shot, 1200 m/s", PRESSED, {"scene__velocity": "1.2 km/s"}),
    ("default shot, 1600 m/s", PRESSED, {"scene__velocity": "1.6 km/s"}),
]

SHIPPED = [  # name, case, grids, settings
    ("%d m/s" % velocity, PRESSED, 6, {"scene__velocity": "%d m/s" % velocity, "scene__stop_when_gauged": "yes"})
    for velocity in VELOCITIES] + [("cases/wu2017", "cases/wu2017", 3, {})]


def row(name, scene):
    return [name, scene.class_text(), scene["crater_volume"].text(2, 1e-9), scene["crater_length"].text(2, 1e-3),
            scene["crater_width"].text(2, 1e-3), scene["crater_depth"].text(3, 1e-3)]


def gauged(runs, velocity, name, change):
    """A row of the default shot's scene, to its second gauge."""
    scene = runs.scene("levels_%d_%s" % (velocity, name.replace(" ", "_")), PRESSED, 3,
                       scene__velocity="%d m/s" % velocity, **{**DEFAULT_SHOT, **change})
    found = [grid["values"] for grid in scene.summary["scenes"]]
    return (row("%d m/s, %s" % (velocity, name), scene) +
            [cell(found, "growth_per_way", 3, 1e3), "%.0f" % scene.run["processor"]])


def default_shot(runs):
    rows = [gauged(runs, velocity, name, change) for velocity in VELOCITIES
            for name, change in {**CHANGES, WINDOW: DEFAULT_SHOT_WINDOW}.items()]
    return [Table(GAUGED, rows)], OF_DEFAULT_SHOT


def one_level(runs):
    """Cells of one size everywhere, beside the scene as it is."""
    rows = [gauged(runs, AT_ONE_LEVEL, name, change) for name, change in (("nothing", {}), ("one level", ONE_LEVEL))]
    return [Table(GAUGED, rows)], OF_DEFAULT_SHOT


def paper(runs):
    """The paper's base case, W1, to its end."""
    rows = []
    for name, change in {**CHANGES, WINDOW: PAPER_WINDOW}.items():
        scene = runs.scene("levels_paper_" + name.replace(" ", "_"), "cases/wu2017/coarse.yaml", 3, **change)
        rows.append(row("1500 m/s, " + name, scene))
    return [Table(COLUMNS, rows)], ("cases/wu2017/coarse.yaml, two cells a radius; mean ± standard deviation over three "
                                    "shifted grids")


def shipped(runs):
    """The largest cells that the cases as shipped allow, beside half as large ones."""
    rows = []
    for name, case, grids, settings in SHIPPED:
        for text, change in (("as shipped", {}), ("one level fewer", {"scene__coarse_cell": "0.75 mm"})):
            folder = "shipped_%s_%s" % (name.replace(" ", "_").replace("/", "_"), text.replace(" ", "_"))
            scene = runs.scene(folder, case, grids, **settings, **change)
            found = [grid["values"] for grid in scene.summary["scenes"]]
            rows.append(row("%s, %s" % (name, text), scene) + [cell(found, "growth_per_way", 3, 1e3)])
    return [Table(COLUMNS + [Column("growth [1/mm]", 0.1)], rows)], (
        "cases/default_shot/pressed.yaml with three cells a radius, as its search has them, to the second gauge, six shifted grids, and cases/wu2017, "
        "three; cells of at most 1.33 and 1.43 mm, and with `scene.coarse_cell=0.75 mm` of 0.67 and 0.71; mean ± standard deviation")


def growing(runs):
    """Does a whole crater hang on cells that grow with its groove, and what do they save?"""
    columns = COLUMNS + [Column("processor time [s]", words=False)]
    rows = []
    for name, case, settings in GROWING:
        for grow, text in (("no", "cells of one size"), ("yes", "cells that grow")):
            folder = "growing_%s_%s" % (name.replace(" ", "_").replace("/", "_").replace(",", ""), grow)
            scene = runs.scene(folder, case, 3, scene__cells_grow=grow, **settings)
            rows.append(row("%s, %s" % (name, text), scene) + ["%.0f" % scene.run["processor"]])
    return [Table(columns, rows)], ("`scene.cells_grow`; the default shot's scenes those of cases/default_shot/pressed.yaml; mean ± standard "
                                    "deviation over three shifted grids; times of all three")


OF_DEFAULT_SHOT = ("cases/default_shot/pressed.yaml, two cells a radius, to the second gauge; mean ± standard deviation over "
                   "three shifted grids, growth of those whose groove lived; times of all three")
