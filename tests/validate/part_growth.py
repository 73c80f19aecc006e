# SPDX-License-Identifier: BSD-3-Clause
"""The default shot's groove between its two gauges over velocity and cells a radius, and where it begins to scratch and
to gouge on each grid."""
import math
import statistics

from pages import Column, Table
from part_pairs import AL6061, COPPER, STEEL, TI64
from runs import Figure

COMMON = {"scene__stop_when_gauged": "yes"}
BETWEEN_GAUGES = 12 * 0.5e-3  # [m] way, 12 grain radii
WIDEST_SCRATCH = 4.0  # scene.limit_length_over_width
GRIDS = 3
RESOLUTIONS = (3, 4, 6)  # cells a radius
VELOCITIES, MANY = (700, 900, 1000, 1150), 6  # [m/s]; grids: for the gouge
SLOW = (500, 700, 900)  # [m/s], on GRIDS: for the scratch
FINE, FINE_VELOCITIES, FINE_GRIDS = (4, 8), (1150, 1500), 6
OF_PAIRS = (  # armature on rail, their files, a velocity at which the groove grows [m/s]
    ("copper on copper", COPPER, COPPER, 1100),
    ("6061 on copper", AL6061, COPPER, 1400),
    ("Ti-6Al-4V on copper", TI64, COPPER, 1300),
    ("4340 on 4340", STEEL, STEEL, 1600),
)
CELLS_OF_PAIRS = (3, 4, 6)
SHIPPED = "cases/default_shot/pressed.yaml"
MEASURES = {  # key of the summary: title of the column, unit, digits, what a fresh one may differ by
    "groove_growth": ("growth [1/us]", 1e6, 3, 0.1),
    "growth_per_way": ("growth [1/mm]", 1e3, 3, 0.1),
    "length_over_width": ("length over width", 1.0, 1, 0.25),
    "front_speed_ratio": ("front over armature", 1.0, 2, 0.15),
}


def grids_of(runs, cells, velocity, grids=GRIDS):
    """Values of the summary of each grid."""
    scene = runs.scene("cells%d_%d_%d" % (cells, velocity, grids), SHIPPED, grids,
                       scene__velocity="%d m/s" % velocity, scene__cells_per_radius=cells, **COMMON)
    return [grid["values"] for grid in scene.summary["scenes"]]


def growth(values):
    """e-folds from gauge to gauge; None: the groove died before its first gauge."""
    per_way = values.get("growth_per_way")
    return None if per_way is None else per_way * BETWEEN_GAUGES


def tear_drop(values):
    """Past zero the groove grows and is a gouge (O-4); None as above."""
    grown = growth(values)
    return None if grown is None else min(grown, math.log(WIDEST_SCRATCH / values["length_over_width"]))


def zero(velocities, found):
    """The lowest place where one grid's figure passes zero, linearly; text: it lies beyond these velocities."""
    pairs = [(v, g) for v, g in zip(velocities, found) if g is not None]
    if not pairs or max(g for _, g in pairs) < 0:
        return "above %.0f" % velocities[-1]
    if pairs[0][1] >= 0:
        return "below %.0f" % pairs[0][0]
    for (v0, g0), (v1, g1) in zip(pairs, pairs[1:]):
        if g0 < 0 <= g1:
            return "%.0f" % (v0 - g0 * (v1 - v0) / (g1 - g0))


def cell(found, key, digits, unit):
    """Mean ± standard deviation of the grids whose groove lived to its first gauge."""
    lived = [values[key] for values in found if values.get(key) is not None]
    died = " (%d died)" % (len(found) - len(lived)) if len(lived) < len(found) else ""
    if not lived:
        return died.strip()
    spread = statistics.stdev(lived) if len(lived) > 1 else None
    return Figure(statistics.mean(lived), spread, len(lived)).text(digits, unit) + died


def measures(found):
    """found: of cells a radius and velocity: the values of the grids."""
    columns = [Column("cells a radius, velocity")] + [Column(title, share) for title, _, _, share in MEASURES.values()]
    rows = [["%d, %d m/s" % of] + [cell(grids, key, digits, unit) for key, (_, unit, digits, _) in MEASURES.items()]
            for of, grids in found.items()]
    return Table(columns, rows)


def places(velocities, grids_at, what):
    """On each grid, where its figure passes zero; grids_at: of each velocity the values of the grids."""
    return [zero(velocities, [what(values) for values in grid]) for grid in zip(*grids_at)]


def mean_place(found):
    """Mean ± standard error of the grids that have a place between the velocities; text: how many have none."""
    known = [float(place) for place in found if place[0].isdigit()]
    if len(known) < 2:
        return ""
    more = "" if len(known) == len(found) else " (of %d)" % len(known)
    return "%.0f ± %.0f" % (statistics.mean(known), statistics.stdev(known) / math.sqrt(len(known))) + more


def zeros(runs, found):
    columns = [Column("cells a radius"), Column("scratches from, on each of three grids [m/s]", 0.2),
               Column("gouges from, on each of six [m/s]", 0.2), Column("the same, mean ± standard error", 0.1)]
    rows = []
    for cells in RESOLUTIONS:
        scratches = places(SLOW, [grids_of(runs, cells, v) for v in SLOW], growth)
        gouges = places(VELOCITIES, [found[cells, v] for v in VELOCITIES], tear_drop)
        rows.append(["%d" % cells, ", ".join(scratches), ", ".join(gouges), mean_place(gouges)])
    return Table(columns, rows)


def cells(runs):
    found = {(cells, v): grids_of(runs, cells, v, MANY) for cells in RESOLUTIONS for v in VELOCITIES}
    return [measures(found), zeros(runs, found)], NOTE + "; places linearly between velocities"


def fine(runs):
    """Growth in coarse and fine cells side by side, with the standard error of their difference."""
    columns = [Column("growth [1/mm] at")] + [Column("%d cells" % cells, 0.1) for cells in FINE]
    columns += [Column("difference")]
    rows = []
    for velocity in FINE_VELOCITIES:
        found = [grids_of(runs, cells, velocity, FINE_GRIDS) for cells in FINE]
        lived = [[g["growth_per_way"] for g in grids if g.get("growth_per_way") is not None] for grids in found]
        change = statistics.mean(lived[1]) - statistics.mean(lived[0])
        error = math.sqrt(sum(statistics.variance(of) / len(of) for of in lived))
        rows.append(["%d m/s" % velocity, *(cell(grids, "growth_per_way", 3, 1e3) for grids in found),
                     Figure(change, error).text(3, 1e3)])
    return [Table(columns, rows)], NOTE + ", six of them; of the difference ± is the standard error"


def line(points):
    """Of (x, y) the least-squares line's value at x = 0 and its slope, each with its standard error."""
    n = len(points)
    mean_x, mean_y = (sum(p[k] for p in points) / n for k in (0, 1))
    sxx = sum((x - mean_x) ** 2 for x, _ in points)
    slope = sum((x - mean_x) * (y - mean_y) for x, y in points) / sxx
    at_zero = mean_y - slope * mean_x
    variance = sum((y - at_zero - slope * x) ** 2 for x, y in points) / (n - 2)
    return (Figure(at_zero, math.sqrt(variance * (1.0 / n + mean_x ** 2 / sxx)), n),
            Figure(slope, math.sqrt(variance / sxx), n))


def growths(runs, armature, rail, velocity, cells):
    """e-folds between the gauges, of each grid whose groove lived."""
    scene = runs.scene("pair_%s_%s_%d_%d" % (armature, rail, velocity, cells), "cases/pairs", GRIDS,
                       armature__material=armature, rail__material=rail, scene__velocity="%d m/s" % velocity,
                       scene__cells_per_radius=cells, scene__stop_when_gauged="yes")
    found = (growth(grid["values"]) for grid in scene.summary["scenes"])
    return [folds for folds in found if folds is not None]


def pairs(runs):
    columns = [Column("armature on rail, velocity")] + [Column("%d cells" % cells, 0.1) for cells in CELLS_OF_PAIRS]
    columns += [Column("at zero cell size", 0.3), Column("more, times cells a radius", 0.3)]
    rows = []
    for title, armature, rail, velocity in OF_PAIRS:
        found = {cells: growths(runs, armature, rail, velocity, cells) for cells in CELLS_OF_PAIRS}
        means = [Figure(statistics.mean(of), statistics.stdev(of), len(of)).text(2) for of in found.values()]
        at_zero, slope = line([(1.0 / cells, folds) for cells, of in found.items() for folds in of])
        rows.append(["%s, %d m/s" % (title, velocity), *means, at_zero.text(2), slope.text(1)])
    return [Table(columns, rows)], ("cases/pairs to its second gauge: growth in e-folds between the gauges, mean ± standard "
                                    "deviation over shifted grids of those whose groove lived; of the lines ± is the standard error")


NOTE = ("cases/default_shot/pressed.yaml to its second gauge; mean ± standard deviation over shifted grids of "
        "those whose groove lived")
