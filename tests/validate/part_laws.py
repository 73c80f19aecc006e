# SPDX-License-Identifier: BSD-3-Clause
"""Laws of strength beside measured curves: `breech flow` at the rate and temperature of each."""
import csv
import json
import math
import os
import subprocess

from pages import Column, Table
from runs import ROOT

CURVES = "tests/data/strength_copper.csv"
CURVES_6061 = "tests/data/strength_al6061.csv"
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


def bar_length(runs, metal, bar):
    """Final over first length of the bar, and what is left of its kinetic energy: the wall holds it, so it rings."""
    _, speed, kelvin, length, diameter, _ = bar
    end = (1.3 if kelvin > HOT else 0.75) * length / speed  # [ms]
    settings = {
        "scene.bodies[0].material": metal, "scene.bodies[0].velocity": "0 -%g 0 m/s" % speed,
        "scene.bodies[0].temperature": "%g K" % kelvin,
        "scene.bodies[0].shape.cylinder.height": "%g mm" % length,
        "scene.bodies[0].shape.cylinder.radius": "%g mm" % (diameter / 2), "scene.end_time": "%.4g ms" % end,
        "scene.window.x.hi": "14 mm", "scene.window.y.hi": "33 mm", "scene.window.z.hi": "14 mm",
        "output.report": "no", "output.snapshots": "0",
    }
    arguments = ["scene", "cases/verification/taylor_bar"]
    for key, value in settings.items():
        arguments += ["--set", "%s=%s" % (key, value)]
    folder = runs.run("bar_%s_%d_%d" % (metal, speed, kelvin), arguments)[0]
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


def taylor(runs):
    return [bars_table(runs, BARS, BAR_METALS)], BARS_NOTE


def taylor_6061(runs):
    return [bars_table(runs, BARS_6061, [(title, metal) for title, (metal, _) in AL6061.items()])], BARS_NOTE
