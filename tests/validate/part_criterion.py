# SPDX-License-Identifier: BSD-3-Clause
"""What tells a gouge from a scratch: three measures of a groove over velocity, on steel and on the paper's scene."""
import statistics

from pages import Column, Table
from runs import Figure

GRIDS = 3
GAUGED = {"scene__stop_when_gauged": "yes"}
STEEL = {"rail__material": "steel_4340", "rail__yield_scale": "1", "armature__material": "steel_4340",
         "scene__contact_pressure": "20 MPa"}
PAIRS = {  # name: case, settings, cells a radius, velocities [m/s]
    "steel": ("cases/default_shot/pressed.yaml", STEEL, (2, 3), (800, 1000, 1200, 1400, 1600, 1800, 2000, 2200)),
    "paper": ("cases/wu2017/coarse.yaml", {}, (2, 3), (600, 800, 1000, 1200, 1350, 1500, 1750, 2000)),
}
MEASURES = {  # key of the summary: title of the column, unit, digits, what a fresh one may differ by
    "growth_per_way": ("growth [1/mm]", 1e3, 3, 0.3),
    "front_speed_ratio": ("front over armature", 1.0, 2, 0.15),
    "length_over_width": ("length over width", 1.0, 1, 0.25),
    "crater_length": ("length [mm]", 1e-3, 1, 0.2),
    "crater_width": ("width [mm]", 1e-3, 1, 0.2),
    "crater_depth": ("depth [mm]", 1e-3, 2, 0.2),
}


def scene(runs, pair, cells, velocity):
    case, settings, _, _ = PAIRS[pair]
    return runs.scene("criterion_%s_c%d_%d" % (pair, cells, velocity), case, GRIDS,
                      scene__velocity="%d m/s" % velocity, scene__cells_per_radius=cells, **GAUGED, **settings)


def figure(found, key):
    """Over the grids that have it."""
    values = [grid["values"][key] for grid in found.summary["scenes"] if grid["values"].get(key) is not None]
    if not values:
        return Figure(None)
    return Figure(statistics.mean(values), statistics.stdev(values) if len(values) > 1 else None, len(values))


def row(runs, pair, cells, velocity):
    found = scene(runs, pair, cells, velocity)
    cells_of = [figure(found, key).text(digits, unit) for key, (_, unit, digits, _) in MEASURES.items()]
    return ["%d, %d m/s" % (cells, velocity)] + cells_of


def table(runs, pair):
    _, _, resolutions, velocities = PAIRS[pair]
    columns = [Column("cells a radius, velocity")] + [Column(title, share) for title, _, _, share in MEASURES.values()]
    return Table(columns, [row(runs, pair, c, v) for c in resolutions for v in velocities])


def steel(runs):
    return [table(runs, "steel")], "cases/default_shot/pressed.yaml with steel on steel (Rc 30, both), 20 MPa, " + NOTE


def paper(runs):
    return [table(runs, "paper")], "cases/wu2017/coarse.yaml, " + NOTE


NOTE = "to the second gauge; mean ± standard deviation over three shifted grids, of those that have it"
