# SPDX-License-Identifier: BSD-3-Clause
"""A plate behind water: rows U15, U16, U20, which take searches, higher pressures or the whole plate."""
import glob
import json
import math
import os

from pages import Column, Table
from part_water import CASE, FAR, ROW, fracture, row
from tube_wave import wave_at

from breech.needs import h5py, numpy as np

DENSITY, SPEED, SLOPE = 1000.0, 1480.0, 1.92  # of the water
PLATE_BODY, RADIUS = 1, 32.0  # its number among the bodies; the bore's [mm]
NO_RATE = {"with_rate": False}  # the variant of U14 that tears


def strike(runs, name, with_rate=True, **settings):
    """The summary, with its folder."""
    arguments = ["strike", CASE, "--processes", "1"]
    for key, value in {"output__report": "no", **settings}.items():
        arguments += ["--set", "%s=%s" % (key.replace("__", "."), value)]
    with fracture(runs, with_rate):
        folder, _ = runs.run("water_slow_" + name, arguments)
    with open(os.path.join(folder, "summary.json"), encoding="utf-8") as file:
        return {**json.load(file), "folder": folder}


def first_pressure(velocity):
    """At the piston's face [MPa]."""
    return 1e-6 * DENSITY * (SPEED + SLOPE * velocity) * velocity


# ---- U15: the limit over the wave's length ----

TUBE = 1.3  # [m]
RANGE = {50: (30, 90), 100: (20, 80), 200: (10, 50)}  # theta [us]: where the limit is looked for [m/s]
LIMIT = [Column("theta"), Column("bulged up to", 0.03), Column("torn from", 0.03), Column("p0 at the piston", 0.03),
         Column("p0 at the plate", 0.03), Column("falls to 1/e there in", 0.05)]


def search(runs, theta):
    """Interval of the limit [m/s]; first pressures at the piston and at the plate of its ends [MPa]; decay there [us]."""
    piston = DENSITY * SPEED * 1e-6 * theta
    low, high = RANGE[theta]
    s = strike(runs, "limit_%d" % theta, strike__limit="yes", strike__velocity="%g m/s" % (low + 0.25 * (high - low)),
               study__velocity_low="%g m/s" % low, study__velocity_high="%g m/s" % high, study__velocity_interval=0.15,
               study__max_scenes=5, **{"scene__bodies[2]__piston_mass": "%.5g kg/m2" % piston}, **FAR, **NO_RATE)
    if None in s["limit_interval"]:
        raise SystemExit("theta %d us: no limit, %s" % (theta, s["warnings"]))
    ends = s["limit_interval"]
    at_plate = [wave_at(TUBE, piston, v) for v in ends]
    return ends, [first_pressure(v) for v in ends], [p for p, _ in at_plate], at_plate[0][1]


def spread(found, k):
    """Over its mean, of the brackets' middles, and the least and most that their ends leave open [%]."""
    low, high = zip(*(f[k] for f in found.values()))
    middle = [0.5 * (a + b) for a, b in zip(low, high)]
    ends = (min(middle), max(middle)), (min(high), max(low)), (min(low), max(high))
    return [100 * max(0, b - a) / (0.5 * (a + b)) for a, b in ends]


def is_below(percent, spread_of):
    _, least, most = spread_of
    return "yes" if most < percent else "no" if least >= percent else "not decided"


def limits(runs):
    found = {theta: search(runs, theta) for theta in RANGE}
    piston, plate = spread(found, 1), spread(found, 2)
    told = row("U15", "tear threshold in p0 for theta 50, 100, 200 us", "spread below 20 %",
               "at the plate %.0f %% (%.0f .. %.0f %%); at the piston %.0f %% (%.0f .. %.0f %%)" % (*plate, *piston), "20 %",
               "at the plate %s, at the piston %s" % (is_below(20, plate), is_below(20, piston)), "variant")
    table = Table(LIMIT, [["%d us" % theta, "%g m/s" % v[0], "%g m/s" % v[1], "%.0f .. %.0f MPa" % (*p,),
                           "%.0f .. %.0f MPa" % (*q,), "%.0f us" % decay] for theta, (v, p, q, decay) in found.items()])
    return told, table


# ---- where the plate has failed ----

def snapshot(path):
    """Start [mm], volume and whether it has failed, of the plate's points."""
    with h5py.File(path) as file:
        data = file["VTKHDF/PointData"]
        mine = data["body"][:] == PLATE_BODY
        return 1e3 * data["start"][:][mine], (data["mass"][:] / data["density"][:])[mine], data["damage"][:][mine] >= 1


def snapshots(s):
    return sorted(glob.glob(os.path.join(s["folder"], "scenes", "scene", "*.hdf")))


# ---- U16: at the highest pressures ----

# The wave wears off within decimetres at such pressures: the piston starts next to the scene.
HIGH, NEAR = 167.0, 0.01  # velocity of the piston [m/s], its way to the scene [m]
SCENE_WATER, SHIPPED_PISTON = 0.04, 73.98  # [m, kg/m2]
THIRD = RADIUS / 3


def first_and_last(s):
    """When the plate first fails [us] and how far off the axis [mm]; at the end, share of the bore's outer third of the
    radius that has failed and of its inner third.  None: nothing fails."""
    paths = snapshots(s)
    for k, path in enumerate(paths):
        start, volume, failed = snapshot(path)
        if failed.any():
            break
    else:
        return None
    off = np.average(np.hypot(start[:, 1], start[:, 2])[failed], weights=volume[failed])
    start, volume, failed = snapshot(paths[-1])
    r = np.hypot(start[:, 1], start[:, 2])
    shares = [volume[failed & ring].sum() / volume[ring].sum() for ring in ((r > 2 * THIRD) & (r < RADIUS), r < THIRD)]
    return 1e6 * s["end_time"] * k / (len(paths) - 1), off, *shares


def highest(runs):
    pressures = "%.0f MPa at the piston, %.0f at the plate" % (
        first_pressure(HIGH), wave_at(NEAR + SCENE_WATER, SHIPPED_PISTON, HIGH)[0])
    told = []
    for name, kind, more in (("own", "V", {}), ("no_rate", "variant", NO_RATE)):
        s = strike(runs, "high_" + name, strike__velocity="%g m/s" % HIGH, scene__end_time="120 us", output__snapshots=13,
                   **{"scene__bodies[2]__tube_length": "%g m" % NEAR}, **FAR, **more)
        found = first_and_last(s)
        what = "failure along the rim at 200 .. 300 MPa; here %s" % pressures if name == "own" else \
            "the same, its fracture strain independent of the rate"
        says = "first at %.0f us, %.0f mm off the axis; at the end %.0f %% of the outer third, %.0f %% of the inner" % (
            found[0], found[1], 100 * found[2], 100 * found[3]) if found else "nothing fails"
        told.append(row("U16", what, "the rim fails before the middle", "%s; %s" % (s["class"], says), "class",
                        bool(found) and found[1] > 2 * THIRD and found[2] > found[3], kind))
    return told


# ---- U20: petals ----

BORE = "{turn: {axis: 0 0 1, angle: -90 deg, of: {cylinder: {center: 0 -10 0 mm, radius: 32 mm, height: 70 mm}}}}"
WHOLE = {  # no mirror, and a grid that none of the plate's own symmetries has
    "scene__bodies[0]__shape": "{minus: [{box: {lo: -2 -36 -36 mm, hi: 43.6 36 36 mm}}, %s, {box: {lo: 40 -37 -37 mm, hi: "
                               "41.2 37 37 mm}}]}" % BORE,
    "scene__bodies[1]__shape": "{box: {lo: 40 -36 -36 mm, hi: 41.2 36 36 mm}}",
    "scene__window__y": "{lo: -36.8 mm, hi: 36.8 mm}", "scene__window__z": "{lo: -36.8 mm, hi: 36.8 mm}",
    "scene__boundary": "{y: [free, free], z: [free, free]}", "scene__grid_shift": "0 0.37 0.21",
}
STEP = 2.4  # width of a ring and of a sector on it: a cell [mm]
PETALS = [Column("off the axis"), Column("failed", 0.1), Column("cracks around")]


def cracks(inner, start, volume, failed):
    """Of a ring: the share that has failed, and how many gaps all around are."""
    r, angle = np.hypot(start[:, 1], start[:, 2]), np.arctan2(start[:, 2], start[:, 1])
    ring = (r >= inner) & (r < inner + STEP)
    sectors = max(4, round(2 * math.pi * (inner + 0.5 * STEP) / STEP))
    sector = np.floor((angle[ring] / (2 * math.pi) + 0.5) * sectors).astype(int) % sectors
    whole = np.bincount(sector, volume[ring], sectors)
    gone = np.bincount(sector, (volume * failed)[ring], sectors) >= 0.5 * whole
    return (volume * failed)[ring].sum() / whole.sum(), int(np.sum(gone & ~np.roll(gone, 1)))


def petals(runs):
    s = strike(runs, "whole", strike__velocity="100 m/s", scene__end_time="150 us", output__snapshots=6,
               **FAR, **NO_RATE, **WHOLE)
    last = snapshot(snapshots(s)[-1])
    rings = [(inner, *cracks(inner, *last)) for inner in np.arange(0, RADIUS, STEP)]
    found = max(n for inner, share, n in rings if share < 0.5)
    told = row("U20", "petals: 3 .. 6 of them; the whole plate", "class", "%s; %d cracks from the hole outwards" % (
        s["class"], found), "class", 3 <= found <= 6, "variant")
    table = Table(PETALS, [["%.1f .. %.1f mm" % (inner, inner + STEP), "%.0f %%" % (100 * share), "%d" % n]
                           for inner, share, n in rings])
    return told, table


# ---- all of them ----

def slow(runs):
    threshold, limit = limits(runs)
    high, (petal, rings) = highest(runs), petals(runs)
    return [Table(ROW, [threshold, *high, petal]), limit, rings], (
        "cases/underwater_shock with cells of 0.6 mm across the plate and 2.4 mm along it")
