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
    """Scenes by name.  cells: None as shipped."""
    found = {}
    for name in names:
        settings = dict(SCENES[name])
        if cells:
            settings["scene__cells_per_radius"] = "%g" % cells
        folder = "wu2017_%s_%s" % ("shipped" if not cells else "%g" % cells, name.replace(" ", "_").replace("/", ""))
        found[name] = runs.scene(folder, CASE, min(ensemble, 2) if name in TWO_GRIDS else ensemble, **settings)
    return found


def crater_row(name, scene):
    return [name, scene.class_text(), scene["crater_length"].text(1, 1e-3), scene["crater_width"].text(1, 1e-3),
            scene["crater_depth"].text(2, 1e-3), scene["crater_volume"].text(2, 1e-9), scene["rim_height"].text(2, 1e-3),
            scene["widening"].text(1), scene["groove_growth"].text(2, 1e6)]


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


def rows_of_base(base):
    mises = base["peak_mises_armature"].mean / 900e6, base["peak_mises_rail"].mean / 450e6
    hotter = base["peak_temperature"].mean - 293
    return [  # row, paper, here, comes out ("": a calibration, or not asked)
        ("W1", "12 x 8 x 1.2 mm, tear-drop, rim", "%s x %s x %s mm; %s; rim %s mm" % (
            base["crater_length"].text(1, 1e-3), base["crater_width"].text(1, 1e-3), base["crater_depth"].text(2, 1e-3),
            base.class_text(), base["rim_height"].text(2, 1e-3)), "length calibrated"),
        ("W2", "force up to 15 kN", "along %s, off the rail %s kN" % (
            base["peak_force[0]"].text(1, 1e3), base["peak_force[1]"].text(1, 1e3)), "along: yes" if
         base["peak_force[0]"].mean < 15e3 else "no"),
        ("W3", "von Mises 900 MPa in the armature, 450 in the rail", "%s, %s MPa" % (
            base["peak_mises_armature"].text(0, 1e6), base["peak_mises_rail"].text(0, 1e6)),
         answer(max(abs(m - 1) for m in mises) < 0.15)),
        ("W4", "tens of GPa in the grain at first contact", "%s GPa in one point, %s GPa the 99.9th percentile of the rail" % (
            base["max_pressure"].text(0, 1e9), base["peak_pressure_rail_999"].text(2, 1e9)), "not decided"),
        ("W5", "more than 300 K hotter", "%.0f K" % hotter, answer(hotter > 300)),
        ("W6", "two points of the grain fail after 17 us", "", "not followed"),
    ]


def rows_of_others(scenes):
    base, slow, fast = scenes[BASE], scenes["1.0 km/s"], scenes["2.0 km/s"]
    small, smallest, steep = scenes["grain of 0.2 mm"], scenes["grain of 0.08 mm"], scenes["lead face of 30 deg"]
    volume = {name: scene["crater_volume"] for name, scene in scenes.items()}
    pressure = [scene["peak_pressure_rail_999"] for scene in (slow, base, fast)]
    threshold = lowest_gouge(scenes)
    return [
        ("W7", "grain of 0.2 mm: tear-drop, smaller", "%s; %s mm3" % (small.class_text(), volume["grain of 0.2 mm"].text(2, 1e-9)),
         answer(together(small.mostly("gouge"), rises(volume["grain of 0.2 mm"], volume[BASE])))),
        ("W8", "below 0.1 mm: no tear-drop", "grain of 0.08 mm: %s" % smallest.class_text(), answer(opposite(smallest.mostly("gouge")))),
        ("W9", "2.0 km/s: deeper, wider", "%s mm deep, %s mm wide" % (
            fast["crater_depth"].text(2, 1e-3), fast["crater_width"].text(1, 1e-3)),
         answer(together(rises(base["crater_depth"], fast["crater_depth"]), rises(base["crater_width"], fast["crater_width"])))),
        ("W10", "1.0 km/s: shallow scratch of nearly constant width", "%s; widening %s" % (
            slow.class_text(), slow["widening"].text(1)), answer(opposite(slow.mostly("gouge")))),
        ("W11", "threshold about 1.4 km/s (measured 1.30, 1.35)", "most grids gouge from %s on; lower: %s" % (threshold, "; ".join(
            "%s %s" % (name, scenes[name].class_text()) for name in VELOCITIES[2:5])), answer(threshold in ("1.35 km/s", BASE))),
        ("W12", "peak pressure rises with speed", "%s GPa at 1.0, 1.5, 2.0 km/s, 99.9th percentile of the rail" % ", ".join(
            p.text(2, 1e9) for p in pressure), answer(together(*map(rises, pressure, pressure[1:])))),
        ("W13", "larger inclination of the head: smaller, shallower", "%s and %s mm3, %s and %s mm deep at 15 and 30 degrees" % (
            volume[BASE].text(1, 1e-9), volume["lead face of 30 deg"].text(1, 1e-9), base["crater_depth"].text(2, 1e-3),
            steep["crater_depth"].text(2, 1e-3)), answer(together(rises(volume["lead face of 30 deg"], volume[BASE]),
                                                                  rises(steep["crater_depth"], base["crater_depth"])))),
        ("W14", "scratch above 0.8 km/s, growing gradually", "%s mm3 at 0.6, 0.8, 1.0 km/s" % ", ".join(
            volume[name].text(2, 1e-9) for name in VELOCITIES[:3]),
         answer(together(rises(volume["0.6 km/s"], volume["0.8 km/s"]), rises(volume["0.8 km/s"], volume["1.0 km/s"])))),
    ]


def answer(good):
    return {True: "yes", False: "no", None: UNDECIDED}[good]


def two_cells(runs):
    scenes = compute(runs, None, SCENES, 3)
    rows = rows_of_base(scenes[BASE]) + rows_of_others(scenes)
    # what is here stands in the table of craters too, where it is compared
    judged = Table([Column("row"), Column("paper"), Column("here", words=False), Column("comes out")], [list(row) for row in rows])
    error = max(scene.largest("energy_error") for scene in scenes.values())
    return [judged, craters(scenes)], ("mean ± standard deviation over three shifted grids, of the small grains over two; energy "
                                        "error at most %.0e" % error)


def three_cells(runs):
    scenes = compute(runs, 3, VELOCITIES[2:], 0)
    return [craters(scenes)], "three cells a radius, on the case's own grid"


def shipped(runs):
    scene = runs.scene("wu2017_case", "cases/wu2017")
    time = "%.0f, %.0f s, %.0f MB" % (scene.run["wall"], scene.run["processor"], scene.run["memory"] / 1024)
    columns = CRATER + [Column("wall and processor time, memory", words=False), Column("particle-steps [M]", 0.1)]
    row = crater_row("cases/wu2017", scene) + [time, "%.0f" % (scene.summary["particle_steps"] / 1e6)]
    return [Table(columns, [row])], "2.8 cells a radius, one grid"
