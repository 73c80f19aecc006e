# SPDX-License-Identifier: BSD-3-Clause
"""A steel ball on a lattice sandwich (Chen et al. 2024), at the speeds at which it goes through."""
import json
import os

from pages import Column, Table

from breech.needs import h5py, numpy as np

CASE = "cases/lattice_target"
TRAVEL = {500: 45, 1000: 36, 1500: 34, 2000: 32}  # velocity [m/s]: travel [mm]
COLUMNS = [Column("arrival"), Column("class"), Column("residual [m/s]", 0.03),
           Column("absorbed [J]", 0.05), Column("peak force [kN]", 0.05), Column("deflection [mm]", 0.3),
           Column("hole [mm]", 0.2), Column("failed, front / core / back [mm3]"), Column("debris [g]", 0.3)]
ROWS = [Column("row"), Column("the paper says"), Column("comes out"), Column("holds")]


BALL = 5.0  # its radius [mm]
CARD = {"scene__bodies[%d]__material" % i: "ti64_chen2024" for i in range(3)}


def strike(runs, name, **settings):
    """The summary, with where its history lies."""
    arguments = ["strike", CASE]
    for key, value in {"output__report": "no", "output__snapshots": 0, **settings}.items():
        arguments += ["--set", "%s=%s" % (key.replace("__", "."), value)]
    folder, _ = runs.run(name, arguments)
    with open(os.path.join(folder, "summary.json"), encoding="utf-8") as file:
        return {**json.load(file), "history": os.path.join(folder, "history.h5")}


def pushed(s):
    """Force on the ball, mean over the last us [kN], over how deep its tip is below the front sheet's face [mm]."""
    with h5py.File(s["history"]) as file:
        scene = file["scene/scene"]
        force, bodies = scene["probes/projectile_force"], scene["bodies"]
        time, push = force["time"][:], -4e-3 * force["force_x"][:]
        depth = BALL + 1e3 * np.interp(time, bodies["time"][:], bodies["ball/position_x"][:])
    sums = np.concatenate([[0], np.cumsum(0.5 * (push[1:] + push[:-1]) * np.diff(time))])
    return depth, (sums - np.interp(time - 1e-6, time, sums, left=0)) / 1e-6


def sheets_and_core(s):
    """Largest force as the tip is at the front sheet and at the back one, mean between them [kN]."""
    depth, force = pushed(s)
    return force[depth < 6].max(), force[(depth > 14) & (depth < 20)].max(), force[(depth > 6) & (depth < 12)].mean()


def first_failed(s):
    """When the first metal of front sheet, core, back sheet has failed [us]."""
    with h5py.File(s["history"]) as file:
        bodies = file["scene/scene/bodies"]
        time = 1e6 * bodies["time"][:]
        return [time[np.argmax(bodies[name + "/failed_volume"][:] > 0)] for name in ("front", "core", "back")]


def failed(summary, body):
    return 4 * summary["bodies"][body]["failed_volume"]  # of the quarter


def row(velocity, net, s):
    parts = " / ".join("%.1f" % (1e9 * failed(s, body)) for body in ("front", "core", "back"))
    hole = s["hole_diameter"]
    return ["%d m/s, %s" % (velocity, net), s["class"], "%.1f" % s["residual_velocity"], "%.4g" % s["energy_absorbed"],
            "%.1f" % (1e-3 * s["peak_force"]), "%.2f" % (1e3 * s["deflection"]),
            "" if hole is None else "%.1f" % (1e3 * hole), parts, "%.3f" % (1e3 * s["debris_mass"])]


def verdict(holds):
    return "yes" if holds else "no"


def recht_ipson(s):
    """v_r = k sqrt(v0^2 - v50^2) through 1000 and 2000 m/s: k, v50 [m/s], what it says of 1500 m/s over what comes out."""
    slow, fast = s[1000]["residual_velocity"] ** 2, s[2000]["residual_velocity"] ** 2
    k2 = (fast - slow) / (2000.0 ** 2 - 1000.0 ** 2)
    rest = 1000.0 ** 2 - slow / k2
    between = (k2 * (1500.0 ** 2 - rest)) ** 0.5
    return k2 ** 0.5, max(rest, 0.0) ** 0.5, between / s[1500]["residual_velocity"]


def stages(fast):
    """Rows of the course of the force, at 1, 1.5, 2 km/s."""
    force = [sheets_and_core(s) for s in fast]
    core, second = [f[2] / min(f[0], f[1]) for f in force], [f[1] / f[0] for f in force]
    settled = [s["speed_change"] / s["impact_velocity"] for s in fast]
    order = first_failed(fast[-1])
    return [
        ["L11", "from 1 km/s on the velocity falls fast, slowly, fast, then stays: mean force in mid core below half of "
         "both sheets' peaks", "%s of the lower peak; %.2f %% in the last tenth" % (
             ", ".join("%.2f" % c for c in core), 100 * max(settled)),
         verdict(max(core) < 0.5 and max(settled) < 0.01)],
        ["L12", "from 1 km/s on two peaks of force, the second below half of the first",
         "%s of the first" % ", ".join("%.2f" % c for c in second), verdict(max(second) < 0.5)],
        ["L13", "2 km/s: front sheet, struts, back sheet fail in this order",
         "after %.1f, %.1f, %.1f us" % tuple(order), verdict(order == sorted(order))],
    ]


def rows_of_paper(s):
    k, limit, share = recht_ipson(s)
    half, one, three, two = s[500], s[1000], s[1500], s[2000]
    return [
        ["L5", "0.5 km/s: the ball stays inside, the back sheet bulges", "%s, %.0f m/s left, back sheet %.1f mm3 failed" % (
            half["class"], half["residual_velocity"], 1e9 * failed(half, "back")),
         verdict(half["class"] != "pierced" and half["deflection"] > 5e-4)],
        ["L6", "1 km/s: the back sheet is torn, the ball's velocity settles",
         "back sheet %.1f mm3 failed; %.1f m/s in the last tenth" % (1e9 * failed(one, "back"), one["speed_change"]),
         verdict(failed(one, "back") > 0 and one["speed_change"] < 0.01 * 1000)],
        ["L7", "1.5 km/s: pierced, debris behind", "%s, %.0f m/s left, debris %.2f g" % (
            three["class"], three["residual_velocity"], 1e3 * three["debris_mass"]),
         verdict(three["class"] == "pierced" and three["debris_mass"] > 0)],
        ["L8", "2 km/s: a larger hole and more debris than 1.5 km/s", "holes %.1f, %.1f mm; debris %.2f, %.2f g" % (
            1e3 * three["hole_diameter"], 1e3 * two["hole_diameter"], 1e3 * three["debris_mass"],
            1e3 * two["debris_mass"]),
         verdict(two["hole_diameter"] > three["hole_diameter"] and two["debris_mass"] > three["debris_mass"])],
        *stages([one, three, two]),
        ["5.4", "Recht and Ipson: k 0.65 .. 0.95, a speed left out within 5 %",
         "k %.3f, limit %.0f m/s, 1.5 km/s %+.1f %%" % (k, limit, 100 * (share - 1)),
         verdict(0.65 <= k <= 0.95 and abs(share - 1) < 0.05)],
    ]


def through(runs):
    s = {v: strike(runs, "lattice_open_%d" % v, strike__velocity="%d m/s" % v, strike__travel="%d mm" % travel)
         for v, travel in TRAVEL.items()}
    full = "{lattice_full: {lo: 0.5 -30 -30 mm, hi: 15.5 30 30 mm, cell: 5 mm, radius: 0.5 mm}}"
    t = strike(runs, "lattice_full_2000", **{"scene__bodies[1]__shape": full})
    own = {v: strike(runs, "lattice_chen_%d" % v, strike__velocity="%d m/s" % v, strike__travel="%d mm" % TRAVEL[v], **CARD)
           for v in (500, 2000)}
    rows = [row(v, "open", s[v]) for v in TRAVEL] + [row(2000, "full", t)]
    rows += [row(v, "open, paper's law", own[v]) for v in own]
    return [Table(COLUMNS, rows), Table(ROWS, rows_of_paper(s))], "cases/lattice_target, cells of 0.4 mm"


SLOW = {100: "130 us"}  # velocity [m/s]: end of the scene


def slow(runs):
    """Below the limit: the ball comes back."""
    s = strike(runs, "lattice_slow_100", strike__velocity="100 m/s", strike__travel="none", scene__end_time=SLOW[100])
    back, core, front = -s["residual_velocity"] / 100, 1e9 * failed(s, "core"), 1e9 * failed(s, "front")
    hole = s["class"] == "torn"
    rows = [
        ["L4", "0.1 km/s: deeper dent, struts below it break, sheet whole",
         "dent %.2f mm, core %.1f mm3 failed, front sheet %.1f mm3" % (1e3 * s["deflection"], core, front),
         "struts yes, sheet not decided" if core > 0 and front > 0 else verdict(core > 0)],
        ["L15", "0.1 km/s: rebound, slower than 30 %", "%.0f %% back, peak force %.1f kN" % (
            100 * back, 1e-3 * s["peak_force"]), verdict(0 < back < 0.3)],
        ["L16", "the limit lies above 0.1 km/s", "back sheet %s" % ("torn" if hole else "whole"), verdict(not hole)],
    ]
    return [Table(ROWS, rows)], "cases/lattice_target at 100 m/s, cells of 0.4 mm"
