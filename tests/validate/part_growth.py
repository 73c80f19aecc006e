# SPDX-License-Identifier: BSD-3-Clause
"""Growth of the default shot's groove between its two gauges over velocity, and its zero, on several grids."""
import statistics

from pages import Column, Table
from runs import Figure

COMMON = {"scene__stop_when_gauged": "yes", "scene__contact_pressure": "60 MPa"}
GRIDS = 3


def growths(runs, name, velocity, settings):
    """Growth [1/us] on every grid; None: the groove died before its first gauge."""
    scene = runs.scene("growth_%s_%d" % (name, velocity), "cases/default_shot/former.yaml", GRIDS,
                       scene__velocity="%d m/s" % velocity, **{**COMMON, **settings})
    found = [grid["values"].get("groove_growth") for grid in scene.summary["scenes"]]
    return [None if growth is None else growth / 1e6 for growth in found]


def zero(velocities, growth):
    """Where one grid's growth passes zero, linearly, the lowest such place; text: it lies beyond these velocities."""
    pairs = [(v, g) for v, g in zip(velocities, growth) if g is not None]
    if not pairs or max(g for _, g in pairs) < 0:
        return "above %.0f" % velocities[-1]
    if pairs[0][1] >= 0:
        return "below %.0f" % pairs[0][0]
    for (v0, g0), (v1, g1) in zip(pairs, pairs[1:]):
        if g0 < 0 <= g1:
            return "%.0f" % (v0 - g0 * (v1 - v0) / (g1 - g0))


def spread(values):
    return Figure(statistics.mean(values), statistics.stdev(values) if len(values) > 1 else None, len(values))


def growth_cell(growth):
    """Mean ± standard deviation of the grids whose groove lived."""
    lived = [g for g in growth if g is not None]
    died = " (%d died)" % (len(growth) - len(lived)) if len(lived) < len(growth) else ""
    return (spread(lived).text(3) if lived else "") + died


def zero_cell(velocities, grids):
    """Where each grid's growth passes zero."""
    return ", ".join(zero(velocities, growth) for growth in grids)


def growth_row(runs, title, name, velocities, shown, settings):
    """velocities: of this row, those of the table are shown."""
    found = {v: growths(runs, name, v, settings) for v in velocities}
    grids = list(zip(*found.values()))
    return [title] + [growth_cell(found[v]) if v in found else "" for v in shown] + [zero_cell(velocities, grids)]


def columns(first, velocities):
    # growth lies near zero, where a share of it says little: three times the scatter decides
    return [Column(first)] + [Column("%d m/s" % v, 0.1) for v in velocities] + [Column("zero on each grid [m/s]", 0.2)]


def cells(runs):
    three, two = [700, 800, 1000], [1000, 1300, 1600]
    shown = sorted({*three, *two})
    rows = [growth_row(runs, "2", "cells2", two, shown, {"scene__cells_per_radius": 2}),
            growth_row(runs, "3, the case's", "as_it_is", three, shown, {})]
    return [Table(columns("cells a radius", shown), rows)], NOTE


def four_cells(runs):
    shown = [500, 600, 700, 850, 1000]
    rows = [growth_row(runs, "4", "cells4", shown, shown, {"scene__cells_per_radius": 4})]
    return [Table(columns("cells a radius", shown), rows)], NOTE


NOTE = ("cases/default_shot/former.yaml to its second gauge, pressed on with 60 MPa; growth [1/us], mean ± standard deviation over "
        "three shifted grids")
