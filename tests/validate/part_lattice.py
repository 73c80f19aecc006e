# SPDX-License-Identifier: BSD-3-Clause
"""A steel ball on a lattice sandwich (Chen et al. 2024): eight speeds on two nets, and the same lattice in a press."""
import glob
import json
import math
import os

import press
from pages import Column, Table

from breech.needs import h5py, numpy as np

CASE = "cases/lattice_target"
TRAVEL = {10: 1.3, 20: 2.6, 50: 6.5, 100: 13, 500: 45, 1000: 36, 1500: 34, 2000: 32}  # velocity [m/s]: travel [mm]
SLOW, FAST = (10, 20, 50, 100), (500, 1000, 1500, 2000)
FULL = "{lattice_full: {lo: 0.5 -30 -30 mm, hi: 15.5 30 30 mm, cell: 5 mm, radius: 0.5 mm}}"
CARD = {"scene__bodies[%d]__material" % i: "ti64_chen2024" for i in range(3)}  # the paper's own law
BALL, BALL_BODY = 5.0, 3  # its radius [mm]; its number among the bodies
BALL_MASS = 7850 * 4 / 3 * math.pi * (1e-3 * BALL) ** 3  # [kg]
DENSITY, PARTS, PANEL = 4430.0, 4, 0.06 ** 2  # of the panel; the whole over the quarter that is computed; its face [m2]
COLUMNS = [Column("arrival"), Column("class"), Column("left [m/s]", 0.03), Column("absorbed [J]", 0.05),
           Column("peak force [kN]", 0.05), Column("deflection [mm]", 0.3), Column("hole [mm]", 0.2),
           Column("failed, front / core / back [mm3]"), Column("debris [g]", 0.3)]
ROWS = [Column("row"), Column("the paper says"), Column("open net"), Column("full net"), Column("holds")]


# ---- one strike ----

def strike(runs, name, velocity, **settings):
    """The summary, with its folder."""
    arguments = ["strike", CASE]
    for key, value in {"output__report": "no", "output__snapshots": 2, "strike__velocity": "%d m/s" % velocity,
                       "strike__travel": "%g mm" % TRAVEL[velocity], **settings}.items():
        arguments += ["--set", "%s=%s" % (key.replace("__", "."), value)]
    folder, record = runs.run(name, arguments)
    with open(os.path.join(folder, "summary.json"), encoding="utf-8") as file:
        return {**json.load(file), "folder": folder, "processor": record["processor"]}


def series(s):
    """The scene of the history; the file stays open."""
    return h5py.File(os.path.join(s["folder"], "history.h5"))["scene/scene"]


def pushed(s, over=1e-6):
    """How deep the ball's tip is below the front sheet's face [mm]; force on the ball, mean over so long [s, kN]."""
    scene = series(s)
    force, bodies = scene["probes/projectile_force"], scene["bodies"]
    time, push = force["time"][:], -1e-3 * PARTS * force["force_x"][:]
    depth = BALL + 1e3 * np.interp(time, bodies["time"][:], bodies["ball/position_x"][:])
    sums = np.concatenate([[0], np.cumsum(push[1:] * np.diff(time))])
    return depth, (sums - np.interp(time - over, time, sums, left=0)) / over


def sheets_and_core(s):
    """Largest force as the tip is at the front sheet and at the back one, mean between them [kN]."""
    depth, force = pushed(s)
    return force[depth < 6].max(), force[(depth > 14) & (depth < 20)].max(), force[(depth > 6) & (depth < 12)].mean()


def blows(s):
    """How often the force, mean over 5 us, rises above half of its largest."""
    _, force = pushed(s, 5e-6)
    above = force > 0.5 * force.max()
    return int(np.sum(above[1:] & ~above[:-1]) + above[0])


def events(s):
    """When front sheet and core first fail, the back sheet first yields, and fails [us]."""
    scene = series(s)
    time = 1e6 * scene["bodies/time"][:]
    failed = [time[np.argmax(scene["bodies/%s/failed_volume" % name][:] > 0)] for name in ("front", "core", "back")]
    flow = scene["probes/back_flow"]
    return failed[0], failed[1], 1e6 * flow["time"][np.argmax(flow["power"][:] > 0)], failed[2]


def front_hole(s):
    """Diameter of a circle with the area in which the front sheet has no intact metal left [mm]."""
    last = series(s)["probes/front_map/x"][-1]
    return 2 * np.sqrt(PARTS * np.isnan(last).sum() / last.size * 15.0 ** 2 / np.pi)


def plastic_zone(s):
    """Radius about the axis and depth that hold 99 % of the panel's volume whose plastic strain is above 0.2 % [mm]."""
    path = sorted(glob.glob(os.path.join(s["folder"], "scenes", "scene", "*.hdf")))[-1]
    with h5py.File(path) as file:
        data = file["VTKHDF/PointData"]
        flowed = (data["body"][:] != BALL_BODY) & (data["plastic_strain"][:] > 2e-3)
        volume = (data["mass"][:] / data["density"][:])[flowed]
        start = 1e3 * data["start"][:][flowed]
    return [within(np.hypot(start[:, 1], start[:, 2]), volume), within(start[:, 0], volume)]


def within(x, volume):
    order = np.argsort(x)
    return x[order][np.searchsorted(np.cumsum(volume[order]), 0.99 * volume.sum())]


def failed(s, body):
    return 1e9 * PARTS * s["bodies"][body]["failed_volume"]  # [mm3]


def row(name, s):
    hole = s["hole_diameter"]
    return [name, s["class"], "%.1f" % s["residual_velocity"], "%.4g" % s["energy_absorbed"],
            "%.3g" % (1e-3 * s["peak_force"]), "%.2f" % (1e3 * s["deflection"]),
            "" if hole is None else "%.1f" % (1e3 * hole),
            " / ".join("%.1f" % failed(s, body) for body in ("front", "core", "back")), "%.3f" % (1e3 * s["debris_mass"])]


# ---- rows: what comes out of one net's strikes by velocity, and whether that is what the paper says ----

def rises(values):
    return all(a < b for a, b in zip(values, values[1:]))


def listed(values, form):
    return ", ".join(form % v for v in values)


def undamaged(s):
    volume = 1e9 * s[50]["target_mass"] / DENSITY
    share, dent = failed(s[50], "front") + failed(s[50], "core") + failed(s[50], "back"), [1e3 * s[v]["deflection"]
                                                                                           for v in (10, 20, 50)]
    return "%.1e failed at 50 m/s; dents %s mm" % (share / volume, listed(dent, "%.2f")), \
        share < 1e-4 * volume and rises(dent)


def first_break(s):
    hole = front_hole(s[100])
    return "core %.0f mm3 failed, front sheet's hole %.1f mm" % (failed(s[100], "core"), hole), \
        failed(s[100], "core") > 0 and hole == 0


def inside(s):
    half = s[500]
    return "%s, %.0f m/s left, back sheet bulges by %.1f mm" % (
        half["class"], half["residual_velocity"], 1e3 * half["deflection"]), \
        half["class"] in ("bulged", "stopped", "rebound") and half["deflection"] > 5e-4


def back_torn(s):
    one = s[1000]
    return "back sheet %.0f mm3 failed; %.1f m/s in the last tenth" % (failed(one, "back"), one["speed_change"]), \
        failed(one, "back") > 0 and one["speed_change"] < 0.01 * 1000


def pierced(s):
    three = s[1500]
    back, front = 1e3 * three["hole_diameter"], front_hole(three)
    return "%.0f m/s left; holes %.1f in front, %.1f mm behind; debris %.2f g" % (
        three["residual_velocity"], front, back, 1e3 * three["debris_mass"]), \
        three["class"] == "pierced" and back > front and three["debris_mass"] > 0


def larger(s):
    hole, debris = ([1e3 * s[v][key] for v in (1500, 2000)] for key in ("hole_diameter", "debris_mass"))
    return "holes %s mm; debris %s g" % (listed(hole, "%.1f"), listed(debris, "%.2f")), rises(hole) and rises(debris)


def zone_grows(s):
    zones = [plastic_zone(s[v]) for v in SLOW]
    radius, depth = zip(*zones)
    return "radius %s, depth %s mm" % (listed(radius, "%.1f"), listed(depth, "%.1f")), rises(radius)


def zone_shrinks(s):
    radius = [plastic_zone(s[v])[0] for v in FAST]
    return "radius %s mm" % listed(radius, "%.1f"), rises(radius[::-1])


def stages(s):
    force = [sheets_and_core(s[v]) for v in FAST[1:]]
    core, settled = [f[2] / min(f[0], f[1]) for f in force], [s[v]["speed_change"] / v for v in FAST[1:]]
    return "%s of the lower peak; %.2f %% in the last tenth" % (listed(core, "%.2f"), 100 * max(settled)), \
        max(core) < 0.5 and max(settled) < 0.01


def second_peak(s):
    second = [f[1] / f[0] for f in (sheets_and_core(s[v]) for v in FAST[1:])]
    return "%s of the first" % listed(second, "%.2f"), max(second) < 0.5


def order(s):
    when = events(s[2000])
    return "after %s us" % listed(when, "%.1f"), list(when) == sorted(when)


def one_blow(s):
    force = [1e-3 * s[v]["peak_force"] for v in SLOW]
    times = [blows(s[v]) for v in SLOW]
    return "%s kN; blows %s" % (listed(force, "%.3g"), listed(times, "%d")), rises(force) and max(times) == 1


def rebound(s):
    back = [-s[v]["residual_velocity"] / v for v in SLOW]
    return "%s %%" % listed([100 * b for b in back], "%.0f"), all(0 < b < 0.3 for b in back)


def limit(s):
    core = [failed(s[v], "core") for v in (50, 100)]
    return "core %s mm3 failed; at 100 m/s the back sheet is %s" % (
        listed(core, "%.1f"), "torn" if s[100]["class"] == "torn" else "whole"), \
        core[0] == 0 and core[1] > 0 and s[100]["class"] not in ("torn", "pierced")


def recht_ipson(s):
    """v_r = k sqrt(v0^2 - v50^2) through 1000 and 2000 m/s, and what it says of 1500 m/s."""
    slow, fast = s[1000]["residual_velocity"] ** 2, s[2000]["residual_velocity"] ** 2
    k2 = (fast - slow) / (2000.0 ** 2 - 1000.0 ** 2)
    rest = 1000.0 ** 2 - slow / k2
    off = (k2 * (1500.0 ** 2 - rest)) ** 0.5 / s[1500]["residual_velocity"] - 1
    return "k %.3f, limit %.0f m/s, 1.5 km/s %+.1f %%" % (k2 ** 0.5, max(rest, 0.0) ** 0.5, 100 * off), \
        0.65 <= k2 ** 0.5 <= 0.95 and abs(off) < 0.05


def swept(s):
    """Left over arrival at 1 .. 2 km/s, and what would be left if all that the ball sweeps went on with it."""
    plug = math.pi * (1e-3 * BALL) ** 2 * s[1000]["target_mass"] / PANEL
    least = BALL_MASS / (BALL_MASS + plug)
    left = [s[v]["residual_velocity"] / v for v in FAST[1:]]
    return "%s; %.3f with all that it sweeps" % (listed(left, "%.3f"), least), least < min(left) and max(left) < 1


OF_STRIKES = [  # row, the paper's words with what is asked, what answers
    ("L3", "up to 50 m/s no visible damage (below 1e-4 of the panel), a dent that grows from 10 over 20 to 50 m/s", undamaged),
    ("L4", "0.1 km/s: struts below the dent break, the front sheet is whole", first_break),
    ("L5", "0.5 km/s: the ball stays inside, the back sheet bulges and is whole", inside),
    ("L6", "1 km/s: the back sheet is torn, the ball's velocity settles", back_torn),
    ("L7", "1.5 km/s: pierced, the hole behind is larger than that in front, debris", pierced),
    ("L8", "2 km/s: a larger hole and more debris than 1.5 km/s", larger),
    ("L9", "10 .. 100 m/s: the plastic zone grows (radius about the axis)", zone_grows),
    ("L10", "0.5 .. 2 km/s: the plastic zone shrinks with the velocity", zone_shrinks),
    ("L11", "from 1 km/s on the velocity falls fast, slowly, fast, then stays: mean force in mid core below half of both "
     "sheets' peaks", stages),
    ("L12", "from 1 km/s on two peaks of force, the second below half of the first", second_peak),
    ("L13", "2 km/s: front sheet fails, struts fail, back sheet yields, back sheet fails, in this order", order),
    ("L14", "10 .. 100 m/s: one deceleration, whose peak grows with the velocity", one_blow),
    ("L15", "10 .. 100 m/s: rebound, slower than 30 %", rebound),
    ("L16", "first strut breaks between 50 and 100 m/s; the limit lies above", limit),
    ("5.3", "1 .. 2 km/s: more of the velocity is left than if all that the ball sweeps went on with it", swept),
    ("5.4", "Recht and Ipson: k 0.65 .. 0.95, a speed left out within 5 %", recht_ipson),
]


# ---- rows of the press ----

HAMMER, HEIGHTS = 10.0, (0.05, 0.10, 0.15, 0.20)  # mass [kg], drops [m]


def pressed(p, net):
    frame = press.FRAME[net]
    return "E %.1f GPa; %.0f MPa at %.1f %%; at %.2f of its height %.2f mm to the side" % (
        p["E"], p["top"], 100 * p["at"], p["height"], p["spread"]), \
        frame["E"][0] <= p["E"] <= frame["E"][1] and frame["collapse"][0] <= p["top"] <= frame["collapse"][1] \
        and p["height"] > 0.4


def hammered(p):
    peak = press.hammer(p["curve"], HAMMER, HEIGHTS)
    known = [a for a in peak if a == a]
    return "%s m/s2" % ", ".join("%.0f" % a if a == a else "beyond the press" for a in peak), \
        len(known) == len(peak) and rises(known) and known[-1] / known[0] < 2


def driven(runs, net):
    """A plate into the core: stress beside the slow one's and what a shock adds to it."""
    slow = press.crush(runs, net, press.SLOW)
    told, off = [], []
    for v in (50, 100, 200):
        wanted, found = slow + press.shock(net, v), press.crush(runs, net, v)
        told.append("%.0f (%.0f)" % (found, wanted))
        off.append(abs(found / wanted - 1))
    return "%s MPa; %.0f at %g m/s" % (", ".join(told), slow, press.SLOW), max(off) < 0.15


def verdict(holds):
    """Of the open net and of the full one."""
    if all(holds) or not any(holds):
        return "yes" if holds[0] else "no"
    return "open" if holds[0] else "full"


def paired(name, says, told):
    return [name, says, *(text for text, _ in told), verdict([holds for _, holds in told])]


def pressing(runs):
    slab = [press.specimen(runs, net) for net in press.NETS]
    rows = [paired("L1", "press: E and first maximum between a frame's without and with its nodes' size; it spreads most at "
                   "half its height", [pressed(p, net) for p, net in zip(slab, press.NETS)]),
            paired("L2", "drop hammer, 50 .. 200 mm: the peak grows, from first to last less than twofold (%.0f kg, by the "
                   "work of the press)" % HAMMER, [hammered(p) for p in slab]),
            paired("5.2", "a plate at 50, 100, 200 m/s, mean stress over strains of 5 .. 40 %: within 15 % of (that at 20 m/s "
                   "and rho v2/(1 - 1.4 rho_r) of a shock)", [driven(runs, net) for net in press.NETS])]
    return [Table(ROWS, rows)], ("cases/lattice_target/compression.yaml until 75 us, cells of 0.4 mm; crush.yaml, cells of "
                                 "0.25 mm")


def nets(runs):
    s = {net: {v: strike(runs, "lattice_%s_%d" % (net, v), v, **more) for v in TRAVEL}
         for net, more in (("open", {}), ("full", {"scene__bodies[1]__shape": FULL}))}
    own = {v: strike(runs, "lattice_chen_%d" % v, v, **CARD) for v in (500, 2000)}
    rows = [row("%d m/s, %s" % (v, net), s[net][v]) for net in s for v in TRAVEL]
    rows += [row("%d m/s, open, paper's law" % v, own[v]) for v in own]
    told = [paired(name, says, [of(s[net]) for net in press.NETS]) for name, says, of in OF_STRIKES]
    cost = [sum(s[net][v]["processor"] for v in TRAVEL) / 60 for net in s]
    return [Table(COLUMNS, rows), Table(ROWS, told)], (
        "cases/lattice_target, cells of 0.4 mm; eight speeds took %.0f minutes of a core on the open net, %.0f on the full "
        "one" % tuple(cost))
