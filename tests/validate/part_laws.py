# SPDX-License-Identifier: BSD-3-Clause
"""Laws of strength beside measured curves: `breech flow` at the rate and temperature of each."""
import csv
import glob
import json
import math
import os
import subprocess

from pages import Column, Table
from runs import ROOT

from breech.needs import h5py, numpy

CURVES = "tests/data/strength_copper.csv"
CURVES_6061 = "tests/data/strength_al6061.csv"
CURVES_5083 = "tests/data/strength_al5083.csv"
PLATE, PROFILE = "tests/data/plate_copper.csv", "tests/data/taylor_copper.csv"
LEAST_STRAIN = 0.05  # the bars of the dynamic tests ring below it (note in the file)
ADIABATIC = 1000.0  # [1/s] tests above it keep their heat, those below lose it (note in the file)
HEAT = 0.9  # share of the plastic work

# title: material, what is set; the curves are of annealed copper, so without cold work
COPPER = {
    "Johnson-Cook": ("ofhc_copper", {}),
    "threshold stress": ("ofhc_copper_mts", {}),
    "Preston-Tonks-Wallace": ("ofhc_copper_ptw", {"cold_work": 0}),
    "Steinberg-Guinan": ("ofhc_copper_sg", {}),
}
RAIL = [
    ("`ofhc_copper`", "ofhc_copper", {}),
    ("`ofhc_copper`, `yield_scale` 1.5", "ofhc_copper", {"yield_scale": 1.5}),
    ("`ofhc_copper`, `cold_work` 0.27", "ofhc_copper", {"cold_work": 0.27}),
    ("`ofhc_copper_half_hard`", "ofhc_copper_half_hard", {}),
    ("`ofhc_copper_ptw` (cold work 0.3)", "ofhc_copper_ptw", {}),
    ("`ofhc_copper_sg`, `cold_work` 0.27", "ofhc_copper_sg", {"cold_work": 0.27}),
]
ALUMINIUM = ["al7075_t651", "al7075_t651_limited", "al7075_t6_sg", "w17_al7075"]
MEASURED, SATURATION = 786.0, 810.0  # [MPa]
AL6061 = {
    "Johnson-Cook": ("al6061_t6", {}),
    "the other set": ("al6061_t6_konokman", {}),
    "Steinberg-Guinan": ("al6061_t6_sg", {}),
}


AL5083 = {"Johnson-Cook, H116": ("aa5083_h116", {})}


def flow(runs, material, strain, points, rate, kelvin, **settings):
    """[strain], [MPa] of the curve that `breech flow` prints."""
    given = {"strain": strain, "points": points, "rate": "%g 1/s" % rate, "temperature": "%g K" % kelvin, **settings}
    command = [runs.breech, "flow", material]
    for key, value in given.items():
        command += ["--set", "%s=%s" % (key, value)]
    told = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    if told.returncode:
        raise SystemExit(" ".join(command) + "\n" + told.stderr)
    rows = [[float(word) for word in line.split()] for line in told.stdout.splitlines() if line[0] != "#"]
    return [row[0] for row in rows], [row[1] for row in rows]


def last(runs, *arguments, **settings):
    return flow(runs, *arguments, **settings)[1][-1]


def at(strains, stresses, strain):
    """By straight lines between evenly spaced strains."""
    place = strain / (strains[1] - strains[0])
    left = min(int(place), len(strains) - 2)
    return stresses[left] + (place - left) * (stresses[left + 1] - stresses[left])


def measured_curves(path, least_strain):
    """{name: (kelvin, rate, [(strain, MPa)])} of strains that count."""
    curves = {}
    with open(os.path.join(ROOT, path), encoding="utf-8") as file:
        for row in csv.DictReader(line for line in file if not line.startswith("#")):
            curve = curves.setdefault(row["curve"], (float(row["temperature_K"]), float(row["rate_1_s"]), []))
            strain, stress = list(row.values())[3:5]
            if float(strain) >= least_strain:
                curve[2].append((float(strain), float(stress)))
    return curves


def deviations(runs, material, settings, curve):
    """Of the law from each point of the curve, relative."""
    kelvin, rate, points = curve
    heat = HEAT if rate > ADIABATIC else 0
    strains, stresses = flow(runs, material, max(e for e, _ in points), 200, rate, kelvin, heat=heat, **settings)
    return [at(strains, stresses, e) / stress - 1 for e, stress in points]


def percent(found):
    """rms, and the mean with its sign."""
    rms = math.sqrt(sum(d * d for d in found) / len(found))
    return "%.1f (%+.1f)" % (100 * rms, 100 * sum(found) / len(found))


def beside(runs, laws_of, curves):
    """Rows of the deviations of every law from every curve; all deviations {title: [...]}, of fast tests alone and of
    all."""
    rows, fast, every = [], {title: [] for title in laws_of}, {title: [] for title in laws_of}
    for kelvin, rate, points in curves.values():
        row = ["%g K, %g /s, to %.2f" % (kelvin, rate, max(e for e, _ in points))]
        for title, (material, settings) in laws_of.items():
            found = deviations(runs, material, settings, (kelvin, rate, points))
            every[title] += found
            fast[title] += found if rate > ADIABATIC else []
            row.append(percent(found))
        rows.append(row)
    return rows, fast, every


def columns_of(laws_of):
    return [Column("temperature, rate, strain")] + [Column(title + " [%]", 0.05) for title in laws_of]


def copper(runs):
    rows, fast, every = beside(runs, COPPER, measured_curves(CURVES, LEAST_STRAIN))
    rows.append(["the four at 2000 /s"] + [percent(fast[title]) for title in COPPER])
    rows.append(["all"] + [percent(every[title]) for title in COPPER])
    return Table(columns_of(COPPER), rows)


def al6061(runs):
    rows, _, every = beside(runs, AL6061, measured_curves(CURVES_6061, 0.0))
    rows.append(["all"] + [percent(every[title]) for title in AL6061])
    return Table(columns_of(AL6061), rows)


def al5083(runs):
    """From where the bars have stopped ringing; not at 77 K, which no scene has."""
    curves = {name: curve for name, curve in measured_curves(CURVES_5083, LEAST_STRAIN).items() if curve[0] > 200}
    rows, fast, every = beside(runs, AL5083, curves)
    rows.append(["those above 2000 /s"] + [percent(fast[title]) for title in AL5083])
    rows.append(["all"] + [percent(every[title]) for title in AL5083])
    return Table(columns_of(AL5083), rows)


def regime(runs, materials):
    rows = []
    for title, material, settings in materials:
        rows.append([title] + ["%.0f" % last(runs, material, strain, 1, rate, 300, **settings)
                               for strain, rate in ((0, 1), (1, 2e5), (3, 1e6))])
    columns = [Column("material"), Column("at yield, 1/s [MPa]", 0.01), Column("strain 1, 2e5/s [MPa]", 0.01),
               Column("strain 3, 1e6/s [MPa]", 0.01)]
    return Table(columns, rows)


def aluminium(runs):
    rows = []
    for name in ALUMINIUM:
        stresses = flow(runs, name, 0.3, 300, 6e3, 293, heat=HEAT)[1]
        mean, large = sum(stresses) / len(stresses), last(runs, name, 1, 1, 2e5, 300)
        off = (mean / MEASURED - 1, large / SATURATION - 1)
        rows.append(["`%s`" % name] + ["%.0f (%+.1f %%)" % (value, 100 * part)
                                       for value, part in ((mean, off[0]), (large, off[1]))]
                    + ["%.1f" % (100 * math.sqrt(0.5 * (off[0] ** 2 + off[1] ** 2)))])
    columns = [Column("material"), Column("mean over strain 0 - 0.3, 6e3/s [MPa]", 0.01),
               Column("strain 1, 2e5/s [MPa]", 0.01), Column("rms of both [%]", 0.02)]
    return Table(columns, rows)


def laws_6061(runs):
    others = [("`%s`" % name, name, {}) for name in (*(of[0] for of in AL6061.values()), "al1100_o")]
    return [al6061(runs), regime(runs, others)], (
        "`breech flow`: each law of 6061-T6 from each measured curve, rms and in brackets mean, and what each gives at "
        "300 K without heat")


def laws_5083(runs):
    return [al5083(runs)], "`breech flow`: the law of 5083 from each measured curve, rms and in brackets mean"


def laws(runs):
    tables = [copper(runs), aluminium(runs), regime(runs, RAIL + [("`%s`" % name, name, {}) for name in ALUMINIUM])]
    return tables, ("`breech flow`: the first, each law from each measured curve of annealed copper, rms and in brackets mean; "
                    "the second, 7075 beside 786 MPa measured and 810 MPa; the third, at 300 K without heat")


# Bars onto a rigid wall, not used above: source, m/s, K, length and diameter [mm], final over first length.
BARS = [
    ("Johnson and Cook 1983", 130, 295, 25.4, 7.62, 0.770),
    ("Johnson and Cook 1983", 190, 295, 25.4, 7.62, 0.638),
    ("Wilkins and Guinan 1973", 204, 294, 23.47, 7.62, 0.669),
    ("House et al. 1995", 200, 294, 22.785, 7.595, 16.9 / 22.785),
    ("Allen et al. 1997", 214, 295, 39.35, 7.87, 27.19 / 39.35),
    ("Gust 1982", 180, 295, 30, 6, 0.667),
    ("Gust 1982", 185, 733, 30, 6, 0.574),
    ("Gust 1982", 157, 1235, 30, 6, 0.425),
]
BARS_6061 = [
    ("Wilkins and Guinan 1973", 262, 294, 23.47, 7.62, 0.844),
    ("Wilkins and Guinan 1973", 373, 294, 23.47, 7.62, 0.703),
    ("House et al. 1995", 240, 294, 15.19, 7.595, 12.9 / 15.19),
    ("Gust 1982", 257, 295, 25.4, 7.62, 0.841),
    ("Gust 1982", 361, 295, 25.4, 7.62, 0.717),
    ("Gust 1982", 194, 635, 32.2, 6.3, 0.770),
]
BAR_METALS = [("threshold stress, annealed", "ofhc_copper_mts"), ("the same, half hard", "ofhc_copper_half_hard"),
              ("Johnson-Cook, annealed", "ofhc_copper")]
HOT = 1000.0  # [K] bars that stop late


def bar_run(runs, metal, bar):
    """The folder of the bar's run, which ends when it has come to rest."""
    _, speed, kelvin, length, diameter, _ = bar
    end = (1.3 if kelvin > HOT else 0.75) * length / speed  # [ms]
    settings = {
        "scene.bodies[0].material": metal, "scene.bodies[0].velocity": "0 -%g 0 m/s" % speed,
        "scene.bodies[0].temperature": "%g K" % kelvin,
        "scene.bodies[0].shape.cylinder.height": "%g mm" % length,
        "scene.bodies[0].shape.cylinder.radius": "%g mm" % (diameter / 2), "scene.end_time": "%.4g ms" % end,
        "scene.window.x.hi": "14 mm", "scene.window.y.hi": "%g mm" % max(33, length + 3), "scene.window.z.hi": "14 mm",
        "output.report": "no", "output.snapshots": "1",
    }
    arguments = ["scene", "cases/verification/taylor_bar"]
    for key, value in settings.items():
        arguments += ["--set", "%s=%s" % (key, value)]
    return runs.run("bar_%s_%d_%d" % (metal, speed, kelvin), arguments)[0]


def bar_length(runs, metal, bar):
    """Final over first length of the bar, and what is left of its kinetic energy: the wall holds it, so it rings."""
    folder, speed, length = bar_run(runs, metal, bar), bar[1], bar[3]
    with open(os.path.join(folder, "summary.json"), encoding="utf-8") as file:
        last_state = json.load(file)["bodies"]["bar"]
    return (last_state["hi"][1] - last_state["lo"][1]) / (1e-3 * length), last_state["kinetic"] / (
        0.5 * last_state["mass"] * speed**2)


def bars_table(runs, bars, metals):
    rows, off = [], {metal: [] for _, metal in metals}
    for bar in bars:
        row = ["%s, %g m/s, %g K" % bar[:3], "%.3f" % bar[5]]
        for _, metal in metals:
            found, left = bar_length(runs, metal, bar)
            if left > 0.01:
                raise SystemExit("%s, %s: %.3f of its kinetic energy are left" % (row[0], metal, left))
            off[metal].append(found / bar[5] - 1)
            row.append("%.3f (%+.1f %%)" % (found, 100 * off[metal][-1]))
        rows.append(row)
    rows.append(["rms", ""] + ["%.1f %%" % (100 * math.sqrt(sum(d * d for d in off[metal]) / len(off[metal])))
                               for _, metal in metals])
    columns = [Column("bar"), Column("measured", 0.0)] + [Column(title, 0.05) for title, _ in metals]
    return Table(columns, rows)


BARS_NOTE = ("cases/verification/taylor_bar with each bar's length, diameter, velocity and temperature: final over first "
             "length")


PROFILED = next(bar for bar in BARS if bar[0].startswith("Allen"))
WAYS = [0.25, 1.01, 2.02, 3.03, 4.94, 7.47, 9.99, 12.51]  # [mm] from the foot
HALF_SLICE = 0.25  # [mm]


def two_columns(path):
    """Of a file of tests/data."""
    with open(os.path.join(ROOT, path), encoding="utf-8") as file:
        rows = [row for row in csv.reader(file) if row[0][0] != "#"]
    return [[float(row[k]) for row in rows[1:]] for k in range(2)]


def radius_at(folder, way):
    """Radius of the disk [mm] that as much metal of a quarter of the bar makes, half a cell to either side."""
    last_one = sorted(glob.glob(os.path.join(folder, "scenes", "scene", "scene-*.hdf")))[-1]
    with h5py.File(last_one) as file:
        points = file["VTKHDF/PointData"]
        y, size = 1e3 * file["VTKHDF/Points"][:, 1], 1e3 * points["size"][:, 1]
        volume = 1e9 * points["mass"][:] / points["density"][:]
    bottom, top = way - HALF_SLICE, way + HALF_SLICE
    inside = (numpy.minimum(y + size / 2, top) - numpy.maximum(y - size / 2, bottom)).clip(0) / size
    return math.sqrt(4 * float((inside * volume).sum()) / (math.pi * (top - bottom)))


def profile_table(runs):
    """Radius of the one bar whose profile is known."""
    folders = [bar_run(runs, metal, PROFILED) for _, metal in BAR_METALS]
    rows = []
    for way in WAYS:
        wanted = numpy.interp(way, *two_columns(PROFILE))
        found = [radius_at(folder, way) for folder in folders]
        rows.append(["%.2f" % way, "%.2f" % wanted, *["%.2f (%+.1f %%)" % (r, 100 * (r / wanted - 1)) for r in found]])
    columns = [Column("way from the foot [mm]"), Column("radius measured [mm]", 0.0)]
    return Table(columns + [Column(title, 0.03) for title, _ in BAR_METALS], rows)


def taylor(runs):
    return [bars_table(runs, BARS, BAR_METALS), profile_table(runs)], BARS_NOTE + "; radius of the bar of 214 m/s"


# A plate onto a plate: title, material, cold work (None: the material's), cell [um]
PLATES = [("threshold stress, annealed", "ofhc_copper_mts", None, 10), ("the same, cells of 5 um", "ofhc_copper_mts", None, 5),
          ("threshold stress, half hard", "ofhc_copper_half_hard", None, 10), ("Johnson-Cook, annealed", "ofhc_copper", None, 10),
          ("Preston-Tonks-Wallace, annealed", "ofhc_copper_ptw", 0, 10), ("Steinberg-Guinan", "ofhc_copper_sg", None, 10)]
SHOCK = 150.0  # [m/s] half of what the shock makes
AHEAD = [60, 30, 15]  # [ns] before the shock
LATE = 600  # [ns] after it the first release is there
PLATEAU = (150, 450)  # [ns] after it


def passes(times, speeds, level):
    """When the speed first passes the level, by straight lines."""
    k = next(i for i, v in enumerate(speeds) if v >= level)
    return times[k - 1] + (level - speeds[k - 1]) / (speeds[k] - speeds[k - 1]) * (times[k] - times[k - 1])


def plate_row(title, times, speeds):
    """[us], [m/s]"""
    shock = passes(times, speeds, SHOCK)
    plateau = numpy.mean([numpy.interp(shock + 1e-3 * after, times, speeds) for after in range(*PLATEAU)])
    return [title, *["%.1f" % numpy.interp(shock - 1e-3 * ahead, times, speeds) for ahead in AHEAD], "%.3f" % shock,
            "%.1f" % plateau, "%+.1f" % (numpy.interp(shock + 1e-3 * LATE, times, speeds) - plateau)]


def plate(runs):
    rows = [plate_row("measured", *two_columns(PLATE))]
    for title, metal, cold_work, cell in PLATES:
        settings = {"scene.cell": "%g um" % cell, "scene.coarse_cell": "%g um" % cell, "scene.end_time": "1.62 us",
                    "scene.window.y.hi": "%g um" % cell, "scene.window.z.hi": "%g um" % cell, "output.report": "no"}
        for body in range(3):
            settings["scene.bodies[%d].material" % body] = metal
            if cold_work is not None:
                settings["scene.bodies[%d].cold_work" % body] = "%g" % cold_work
        arguments = ["scene", "cases/verification/plate_impact"]
        for key, value in settings.items():
            arguments += ["--set", "%s=%s" % (key, value)]
        folder = runs.run("plate_%s_%g" % (metal, cell), arguments)[0]
        with h5py.File(os.path.join(folder, "history.h5")) as file:
            face = file["scene/scene/probes/face"]
            rows.append(plate_row(title, 1e6 * face["time"][:], face["velocity_x"][:]))
    columns = [Column("metal")] + [Column("%d ns before the shock [m/s]" % ahead, 0.2) for ahead in AHEAD]
    columns += [Column("shock [us]", 0.01), Column("plateau [m/s]", 0.01),
                Column("%d ns after the shock, less the plateau [m/s]" % LATE, 0.3)]
    return [Table(columns, rows)], (
        "cases/verification/plate_impact to 1.62 us, of each metal: velocity of the free face; the shock where it "
        "passes %g m/s, its plateau the mean from %d to %d ns later" % (SHOCK, *PLATEAU))


def taylor_6061(runs):
    return [bars_table(runs, BARS_6061, [(title, metal) for title, (metal, _) in AL6061.items()])], BARS_NOTE
