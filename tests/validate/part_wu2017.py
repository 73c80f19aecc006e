# SPDX-License-Identifier: BSD-3-Clause
"""Wu et al. 2017 (doi 10.11883/1001-1455(2017)02-0307-08): its rows W1-W14 with cases/wu2017 as shipped."""
from pages import UNDECIDED, Column, Table

CASE = "cases/wu2017/coarse.yaml"
BASE = "1.5 km/s"
SCENES = {  # name: what differs from the base case
    BASE: {},
    "0.6 km/s": {"scene__velocity": "0.6 km/s"},
    "0.8 km/s": {"scene__velocity": "0.8 km/s"},
    "1.0 km/s": {"scene__velocity": "1.0 km/s"},
    "1.2 km/s": {"scene__velocity": "1.2 km/s"},
    "1.35 km/s": {"scene__velocity": "1.35 km/s"},
    "2.0 km/s": {"scene__velocity": "2.0 km/s"},
    "grain of 0.2 mm": {"particle__radius": "0.2 mm", "scene__end_time": "20 us"},
    "grain of 0.08 mm": {"particle__radius": "0.08 mm", "scene__end_time": "8 us", "scene__cells_per_radius": 1.4},
    # the contact face keeps the length that W1 was calibrated with
    "lead face of 30 deg": {"armature__lead_angle": "30 deg", "armature__length": "22 mm"},
}
TWO_GRIDS = {"grain of 0.2 mm", "grain of 0.08 mm"}  # of many steps
VELOCITIES = ["0.6 km/s", "0.8 km/s", "1.0 km/s", "1.2 km/s", "1.35 km/s", BASE]  # rising
CRATER = [Column("scene"), Column("class"), Column("length [mm]", 0.1), Column("width [mm]", 0.15),
          Column("depth [mm]", 0.15), Column("volume [mm3]", 0.2), Column("rim [mm]", 0.3), Column("widening", 0.2),
          Column("growth [1/us]", 0.3)]


def compute(runs, cells, names, ensemble):
    """Scenes by name, each on so many shifted grids.  cells: a radius, None as shipped."""
    found = {}
    for name in names:
        settings = dict(SCENES[name])
        if cells:
            settings["scene__cells_per_radius"] = "%g" % cells
        folder = "wu2017_%s_%s" % ("shipped" if not cells else "%g" % cells, name.replace(" ", "_").replace("/", ""))
        found[name] = runs.scene(folder, CASE, min(ensemble, 2) if name in TWO_GRIDS else ensemble, **settings)
    return found


def crater_row(name, scene):
    sizes = [size(scene, which) for which in ("length", "width", "depth", "volume")]
    return [name, scene.class_text(), *sizes, scene["rim_height"].text(2, 1e-3), scene["widening"].text(1),
            scene["groove_growth"].text(2, 1e6)]


def craters(scenes):
    return Table(CRATER, [crater_row(name, scene) for name, scene in scenes.items()])


def rises(small, large):
    """Is one figure above the other?  None: two standard errors of the means do not part them."""
    apart, error = large.mean - small.mean, (small.error() ** 2 + large.error() ** 2) ** 0.5
    return None if abs(apart) <= 2 * error else apart > 0


def opposite(good):
    return None if good is None else not good


def together(*answers):
    """no before not decided before yes"""
    return False if False in answers else None if None in answers else True


def lowest_gouge(scenes):
    """The lowest velocity from which on most grids gouge; "none"."""
    found = "none"
    for name in reversed(VELOCITIES):
        if not scenes[name].mostly("gouge"):
            break
        found = name
    return found


def size(scene, name):
    """Text of a number of a crater [mm, mm3]."""
    digits, unit = {"length": (1, 1e-3), "width": (1, 1e-3), "depth": (2, 1e-3), "volume": (2, 1e-9)}[name]
    return scene["crater_" + name].text(digits, unit)


def answer(good):
    return {True: "yes", False: "no", None: UNDECIDED}[good]


def rows_of_base(base):
    """Rows as lists: name, paper, here, comes out."""
    mises = base["peak_mises_armature"].mean / 900e6, base["peak_mises_rail"].mean / 450e6
    hotter = base["peak_temperature"].mean - 293
    along, off = base["peak_force[0]"], base["peak_force[1]"]
    return [
        ["W1", "12 x 8 x 1.2 mm, tear-drop, rim",
         "%s x %s x %s mm; %s; rim %s mm" % (size(base, "length"), size(base, "width"), size(base, "depth"),
                                             base.class_text(), base["rim_height"].text(2, 1e-3)),
         "length calibrated"],
        ["W2", "force up to 15 kN", "along %s, off the rail %s kN" % (along.text(1, 1e3), off.text(1, 1e3)),
         "along: " + answer(along.mean < 15e3)],
        ["W3", "von Mises 900 MPa in the armature, 450 in the rail",
         "%s, %s MPa" % (base["peak_mises_armature"].text(0, 1e6), base["peak_mises_rail"].text(0, 1e6)),
         answer(max(abs(m - 1) for m in mises) < 0.15)],
        ["W4", "tens of GPa in the grain at first contact",
         "%s GPa in one point, %s GPa the 99.9th percentile of the rail" % (
             base["max_pressure"].text(0, 1e9), base["peak_pressure_rail_999"].text(2, 1e9)), "not decided"],
        ["W5", "more than 300 K hotter", "%.0f K" % hotter, answer(hotter > 300)],
        ["W6", "two points of the grain fail after 17 us", "", "not followed"],
    ]


def rows_of_small_grain(base, small):
    smaller = rises(small["crater_volume"], base["crater_volume"])
    return [["W7", "grain of 0.2 mm: tear-drop, smaller", "%s; %s mm3" % (small.class_text(), size(small, "volume")),
             answer(together(small.mostly("gouge"), smaller))]]


def rows_of_smallest_grain(smallest):
    return [["W8", "below 0.1 mm: no tear-drop", "grain of 0.08 mm: " + smallest.class_text(),
             answer(opposite(smallest.mostly("gouge")))]]


def rows_of_velocities(scenes):
    base, slow, fast = scenes[BASE], scenes["1.0 km/s"], scenes["2.0 km/s"]
    pressure = [scene["peak_pressure_rail_999"] for scene in (slow, base, fast)]
    threshold = lowest_gouge(scenes)
    below = "; ".join("%s %s" % (name, scenes[name].class_text()) for name in VELOCITIES[2:5])
    return [
        ["W9", "2.0 km/s: deeper, wider", "%s mm deep, %s mm wide" % (size(fast, "depth"), size(fast, "width")),
         answer(together(*(rises(base[name], fast[name]) for name in ("crater_depth", "crater_width"))))],
        ["W10", "1.0 km/s: shallow scratch of nearly constant width",
         "%s; widening %s" % (slow.class_text(), slow["widening"].text(1)), answer(opposite(slow.mostly("gouge")))],
        ["W11", "threshold about 1.4 km/s (measured 1.30, 1.35)",
         "most grids gouge from %s on; lower: %s" % (threshold, below), answer(threshold in ("1.35 km/s", BASE))],
        ["W12", "peak pressure rises with speed",
         "%s GPa at 1.0, 1.5, 2.0 km/s, 99.9th percentile of the rail" % ", ".join(p.text(2, 1e9) for p in pressure),
         answer(together(*map(rises, pressure, pressure[1:])))],
    ]


def rows_of_angle_and_scratches(scenes):
    base, steep = scenes[BASE], scenes["lead face of 30 deg"]
    slow = [scenes[name] for name in VELOCITIES[:3]]
    volume = [scene["crater_volume"] for scene in slow]
    return [
        ["W13", "larger inclination of the head: smaller, shallower",
         "%s and %s mm3, %s and %s mm deep at 15 and 30 degrees" % (
             size(base, "volume"), size(steep, "volume"), size(base, "depth"), size(steep, "depth")),
         answer(together(*(rises(steep[name], base[name]) for name in ("crater_volume", "crater_depth"))))],
        ["W14", "scratch above 0.8 km/s, growing gradually",
         "%s mm3 at 0.6, 0.8, 1.0 km/s" % ", ".join(size(scene, "volume") for scene in slow),
         answer(together(*map(rises, volume, volume[1:])))],
    ]


def two_cells_of(runs):
    return compute(runs, None, SCENES, 3)


def three_cells_of(runs):
    return compute(runs, 3, [name for name in SCENES if name != "grain of 0.08 mm"], 3)


def five_cells_of(runs):
    return compute(runs, 5, [name for name in SCENES if name not in TWO_GRIDS], 2)


def rows_of(scenes):
    """Rows as lists: name, paper, here, comes out; those of small grains where these were run."""
    rows = rows_of_base(scenes[BASE])
    if "grain of 0.2 mm" in scenes:
        rows += rows_of_small_grain(scenes[BASE], scenes["grain of 0.2 mm"])
    if "grain of 0.08 mm" in scenes:
        rows += rows_of_smallest_grain(scenes["grain of 0.08 mm"])
    return rows + rows_of_velocities(scenes) + rows_of_angle_and_scratches(scenes)


def judged(scenes, grids):
    """The rows, and the craters that they were judged by."""
    # what is here stands in the table of craters too, where it is compared
    rows = Table([Column("row"), Column("paper"), Column("here", words=False), Column("comes out")], rows_of(scenes))
    error = max(scene.largest("energy_error") for scene in scenes.values())
    return [rows, craters(scenes)], "mean ± standard deviation over %s; energy error at most %.0e" % (grids, error)


def two_cells(runs):
    return judged(two_cells_of(runs), "three shifted grids, of the small grains over two")


def three_cells(runs):
    return judged(three_cells_of(runs), "three shifted grids, of the small grain over two")


def five_cells(runs):
    return judged(five_cells_of(runs), "two shifted grids")


def all_rows(runs):
    """What comes out with two, three and five cells a radius."""
    resolutions = [scenes_of(runs) for scenes_of in (two_cells_of, three_cells_of, five_cells_of)]
    answers = [{row[0]: row[3] for row in rows_of(scenes)} for scenes in resolutions]
    rows = [[name, paper] + [those.get(name, "not run") for those in answers]
            for name, paper, _, _ in rows_of(resolutions[0])]
    columns = [Column("row"), Column("paper"), Column("two cells"), Column("three cells"), Column("five cells")]
    return [Table(columns, rows)], "the last columns of the tables below"


def shipped(runs):
    scene = runs.scene("wu2017_case", "cases/wu2017")
    time = "%.0f, %.0f s, %.0f MB" % (scene.run["wall"], scene.run["processor"], scene.run["memory"] / 1024)
    columns = CRATER + [Column("wall and processor time, memory", words=False), Column("point-steps [M]", 0.1)]
    row = crater_row("cases/wu2017", scene) + [time, "%.0f" % (scene.summary["particle_steps"] / 1e6)]
    return [Table(columns, [row])], "2.8 cells a radius, one grid"
