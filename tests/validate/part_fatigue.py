# SPDX-License-Identifier: BSD-3-Clause
"""The rail under a wheel (Ma et al. 2020) beside closed fields: first cuts, cracks, grids, steps."""
import json
import math
import os

from pages import Column, Table

CASE = "cases/rail_fatigue"
A, UNIT = 6e-3, 1e9 / 210e9  # half length of the patch [m]; strain of the peak pressure, p0 / E
# state, friction, traction_share; pulse: range, x / a, z / a, direction; passage: range, z / a, direction
STATES = [("frictionless", 0.0, 0.5, (0.737, 0.0, 0.39, 90), (0.790, 0.35, 75)),
          ("full_slip", 0.1, 0.5, (0.753, 0.10, 0.0, 42), (0.881, 0.0, 20)),
          ("full_slip", 0.2, 0.5, (0.887, 0.20, 0.0, 39), (1.166, 0.0, 15)),
          ("full_slip", 0.3, 0.5, (1.028, 0.29, 0.0, 37), (1.473, 0.0, 15)),
          ("full_slip", 0.4, 0.5, (1.173, 0.38, 0.0, 34), (1.793, 0.0, 10)),
          ("full_slip", 0.5, 0.5, (1.324, 0.45, 0.0, 32), (2.130, 0.0, 10)),
          ("stick_slip", 0.3, 0.5, (0.882, 0.45, 0.0, 47), (0.966, 0.0, 30)),
          ("stick_slip", 0.3, 0.9, (1.012, 0.29, 0.0, 38), (1.292, 0.0, 20)),
          ("stick_slip", 0.5, 0.5, (1.106, 0.54, 0.0, 40), (1.287, 0.0, 25))]
# measure, cycle, Poisson's ratio: friction at which the first cut comes to the face
CROSSINGS = [("bond", "pulse", 0.25, 0.095), ("bond", "pulse", 0.3, 0.133), ("bond", "passage", 0.25, 0.07),
             ("bond", "passage", 0.3, 0.10), ("tension", "pulse", 0.25, 0.07), ("shear", "pulse", 0.3, 0.375)]
STEEL = ("[{name: steel, density: 7850 kg/m3, youngs_modulus: 210 GPa, poisson: %g, fatigue_A: 426, fatigue_m: 2.77}]")
ROW = [Column("row"), Column("what"), Column("comes out"), Column("holds")]


def life(runs, name, **settings):
    arguments = ["life", CASE]
    for key, value in {"output__report": "no", **settings}.items():
        arguments += ["--set", "%s=%s" % (key.replace("__", "."), value)]
    folder, _ = runs.run("fatigue_" + name, arguments)
    with open(os.path.join(folder, "summary.json"), encoding="utf-8") as file:
        return json.load(file)


def state_name(state, friction, share):
    if state == "frictionless":
        return state
    return "%s, %g" % (state.replace("_", " "), friction) + (", Q/(mu P') %g" % share if state == "stick_slip" else "")


def state_settings(state, friction, share):
    return {"life__state": state, "life__friction": friction, "life__traction_share": share}


def verdict(holds):
    return "yes" if holds else "no"


def degrees(angle, mirror):
    return math.degrees(min(angle, math.pi - angle) if mirror else angle)


def first_cuts(runs):
    """On a grid with a / cell = 40: range, place, direction of the closed field, cycles of the grid over those."""
    rows = []
    for k, (state, friction, share, pulse, passage) in enumerate(STATES):
        both = {}
        for cycle in ("pulse", "passage"):
            both[cycle] = life(runs, "first_%d_%s" % (k, cycle), life__cycle=cycle, life__max_cuts=0,
                               life__cells_per_half_length=40, **state_settings(state, friction, share))
        s, p = both["pulse"], both["passage"]
        mirror = state == "frictionless"
        found = [s["first_range"] / UNIT, s["first_position"] / A, s["first_depth"] / A,
                 degrees(s["first_angle"], mirror)]
        passed = [p["first_range"] / UNIT, p["first_depth"] / A, degrees(p["first_angle"], mirror)]
        grid = [s["grid_first"] / s["life_first"], p["grid_first"] / p["life_first"]]
        holds = (abs(found[0] / pulse[0] - 1) < 0.03 and abs(found[1] - pulse[1]) < 0.1 and
                 abs(found[2] - pulse[2]) < 0.1 and abs(found[3] - pulse[3]) < 10 and
                 abs(passed[0] / passage[0] - 1) < 0.03 and abs(passed[1] - passage[1]) < 0.1 and
                 abs(passed[2] - passage[2]) < 10 and all(abs(g - 1) < 0.09 for g in grid))
        rows.append([state_name(state, friction, share),
                     "%.3f; %.2f, %.2f; %.0f" % pulse, "%.3f; %.2f, %.2f; %.0f" % tuple(abs(x) for x in found),
                     "%.3f; %.2f; %.0f" % passage, "%.3f; %.2f; %.0f" % tuple(passed),
                     "%.3f, %.3f" % tuple(grid), verdict(holds)])
    columns = [Column("state"), Column("pulse, reference"), Column("pulse"), Column("passage, reference"),
               Column("passage"), Column("grid, N over N of the field", 0.005), Column("holds")]
    return Table(columns, rows)


def crossing(runs, measure, cycle, poisson):
    low, high = 0.0, 0.6
    while high - low > 0.004:
        friction = 0.5 * (low + high)
        s = life(runs, "cross_%s_%s_%g_%.6f" % (measure, cycle, poisson, friction), life__until="first",
                 life__measure=measure, life__cycle=cycle, life__friction=friction,
                 life__material="steel", materials=STEEL % poisson)
        if s["first_depth"] < 0.02 * A:
            high = friction
        else:
            low = friction
    return 0.5 * (low + high)


def crossings(runs):
    rows = []
    for measure, cycle, poisson, want in CROSSINGS:
        found = crossing(runs, measure, cycle, poisson)
        rows.append(["%s, %s, nu %g" % (measure, cycle, poisson), "%.3f" % want, "%.3f" % found,
                     verdict(abs(found - want) < 0.03)])
    return Table([Column("measure"), Column("reference"), Column("friction", 0.05), Column("holds")], rows)


def crack_row(name, s):
    # of a crack that pulses make on either side at once, the side is rounding's choice
    place = "" if s["life_position"] is None else "%.2f" % (s["life_position"] / A)
    return [name, "%.0f" % s["life_first"], "%.0f" % s["life"], "%.0f" % s["life_alone"],
            "%.3f" % (s["life_depth"] / A), place, "%d" % s["cuts"], "%d" % s["solves"]]


CRACK = [Column("state, cycle, measure"), Column("first cut", 0.01), Column("life", 0.02),
         Column("without redistribution", 0.02), Column("depth [a]", 0.15), Column("place [a]", words=False),
         Column("cuts", words=False), Column("solutions", words=False)]


def cracks(runs):
    found = {}
    for state, friction in (("frictionless", 0.0), ("full_slip", 0.1), ("full_slip", 0.3), ("full_slip", 0.5),
                            ("stick_slip", 0.3), ("stick_slip", 0.5)):
        for cycle in ("pulse", "passage"):
            found[state_name(state, friction, 0.5) + ", " + cycle] = life(
                runs, "crack_%s_%g_%s" % (state, friction, cycle), life__cycle=cycle,
                **state_settings(state, friction, 0.5))
    for measure in ("tension", "shear"):
        for cycle in ("pulse", "passage"):
            found["full slip, 0.3, %s, %s" % (cycle, measure)] = life(
                runs, "crack_%s_%s" % (measure, cycle), life__cycle=cycle, life__measure=measure)
    return Table(CRACK, [crack_row(name, s) for name, s in found.items()]), found


def grids(runs):
    rows = []
    for cycle, state in (("pulse", "full_slip"), ("passage", "frictionless")):
        for cells in (10, 20, 40):
            s = life(runs, "grid_%s_%d" % (cycle, cells), life__cells_per_half_length=cells, life__cycle=cycle,
                     life__state=state)
            rows.append(["%s, %s, %d cells" % (state.replace("_", " "), cycle, cells),
                         "%.3f" % (100 * s["field_error"]), "%.1f" % (100 * s["face_error"]),
                         "%.0f" % s["grid_first"], "%.0f" % s["life"],
                         "%.3f" % (s["life_depth"] / A), "%.1f" % s["wall_seconds"]])
    return Table([Column("state, cycle, cells in a"), Column("stress, rms [% of p0]", 0.1),
                  Column("strain along the face [%]", 0.1), Column("first cut", 0.01), Column("life", 0.02),
                  Column("depth [a]", 0.15), Column("time [s]", words=False)], rows)


BATCHED = (("full_slip", 0.3, "pulse"), ("full_slip", 0.5, "pulse"), ("frictionless", 0.0, "passage"),
           ("full_slip", 0.1, "passage"), ("full_slip", 0.3, "passage"), ("full_slip", 0.5, "passage"))


def batches(runs):
    """Cut by cut, in steps of 1 % and of 5 %, the default."""
    rows = []
    for state, friction, cycle in BATCHED:
        of = [life(runs, "batch_%s_%g_%s_%g" % (state, friction, cycle, batch), life__batch=batch, life__cycle=cycle,
                   **state_settings(state, friction, 0.5)) for batch in (0, 0.01, 0.05)]
        rows.append(["%s, %s" % (state_name(state, friction, 0.5), cycle)] + ["%.0f" % s["life"] for s in of] +
                    [", ".join("%d" % s[key] for s in of) for key in ("cuts", "solves")] +
                    ["%.1f" % (of[0]["solves"] / of[2]["solves"])])
    return Table([Column("state, cycle"), Column("cut by cut", 0.02), Column("steps of 1 %", 0.02),
                  Column("steps of 5 %", 0.02), Column("cuts", words=False), Column("solutions", words=False),
                  Column("first over last", words=False)], rows)


def lattice(runs):
    """Of the 28 bonds: cycles to half of them over those to the first, without redistribution."""
    want = {0.0: 1.58, 0.1: 1.48, 0.2: 1.73, 0.3: 1.89, 0.4: 2.08, 0.5: 2.30}
    found = {}
    for friction in want:
        s = life(runs, "lattice_%g" % friction, life__fan="lattice", life__friction=friction, life__max_cuts=0,
                 life__cells_per_half_length=40)
        found[friction] = s["life_alone"] / s["grid_first"]
    return want, found


def paper_rows(runs, found):
    want, ratio = lattice(runs)
    off = max(abs(ratio[f] / want[f] - 1) for f in want)
    first = {name: s["life_first"] for name, s in found.items()}
    inside = all(s["grid_first"] <= s["life"] <= 1.01 * s["life_alone"]
                 for name, s in found.items() if "shear" not in name)
    deep, pulse = found["frictionless, passage"], found["frictionless, pulse"]
    three = [first["%s, %s" % (state, cycle)] for cycle in ("pulse", "passage")
             for state in ("full slip, 0.3", "stick slip, 0.3, Q/(mu P') 0.5", "frictionless")]
    ordered = three[0] < three[1] < three[2] and three[3] < three[4] < three[5]
    share = {c: [first["full slip, %g, %s" % (mu, c)] / first["frictionless, " + c] for mu in (0.3, 0.5)]
             for c in ("pulse", "passage")}
    ratios = [abs(a / b - 1) < 0.1 for c, r in (("pulse", (0.40, 0.20)), ("passage", (0.18, 0.064)))
              for a, b in zip(share[c], r)]
    heavy = life(runs, "heavy", life__until="first", life__wheel_load="82.94 kN")
    load = heavy["life_first"] / first["full slip, 0.3, pulse"]
    force = found["full slip, 0.3, pulse"]["normal_force"] / (3 * 75.4e3 / (4 * A))
    return Table(ROW, [
        ["F1 - F3, F20", "the law, its sums, jumps against counting", "tests/test_life.c", "yes"],
        ["F4, F5", "3P/(4b) on a metre of the slice; Carter's force", "%.6f of it; tests/test_life.c" % force,
         verdict(abs(force - 1) < 1e-3)],
        ["F8, F9", "nine first cuts, pulse and passage", "the first table", "as it says"],
        ["F10", "friction at which the first cut comes to the face", "the second table", "as it says"],
        ["F11", "frictionless > stick-slip > full slip in life", "cycles to the first cut, both cycles",
         verdict(ordered)],
        ["F12", "N(0.3)/N(0), N(0.5)/N(0): pulse 0.40, 0.20, passage 0.18, 0.064",
         "%.3f, %.3f; %.3f, %.4f" % tuple(share["pulse"] + share["passage"]), verdict(all(ratios))],
        ["F13", "10 % more load on the same patch: 0.768", "%.4f" % load, verdict(abs(load - 0.768) < 2e-3)],
        ["F15", "28 bonds, without redistribution: half over first, 1.58, 1.48, 1.73, 1.89, 2.08, 2.30",
         ", ".join("%.2f" % ratio[f] for f in want), verdict(off < 0.03)],
        ["F15", "life between the first cut and that without redistribution", "bond and tension of the third table",
         verdict(inside)],
        ["F17", "without friction a crack below the face: passage", "%.3f a deep" % (deep["life_depth"] / A),
         verdict(deep["life_depth"] > 0)],
        ["F17", "the same: pulse", "at the face: cuts in compression close, nothing is redistributed"
         if pulse["life_depth"] == 0 else "%.3f a deep" % (pulse["life_depth"] / A), verdict(pulse["life_depth"] > 0)],
        ["F19", "28 bonds in 8 directions", "tests/test_life.c", "yes"],
    ])


def wheel(runs):
    table, found = cracks(runs)
    return ([first_cuts(runs), crossings(runs), table, grids(runs), batches(runs), paper_rows(runs, found)],
            "cases/rail_fatigue")


SURFACE = [Column("surface"), Column("fatigue of"), Column("shots to a crack", 0.03), Column("5 %, 95 %", 0.03),
           Column("where [m]", 0.1), Column("by"), Column("tied with place"), Column("lasts longer than the next [%]", 0.02)]


def surfaces(runs):
    """Treatments of the default shot's rail, ranked by life."""
    case = "cases/rail_life/treatments.yaml"
    folder, _ = runs.run("rail_life_treatments", ["compare", case, "--set", "output.report=no"])
    with open(os.path.join(folder, "summary.json"), encoding="utf-8") as file:
        ranking = json.load(file)["ranking"]
    rows = [[e["surface"], e["metal"].replace("_", " "), "%.3g" % e["life"],
             "%.3g, %.3g" % (e["life_quantiles"][0], e["life_quantiles"][2]), "%.2f" % e["life_position"],
             e["life_cause"], "%d" % e["tied"],
             "" if e["better_than_next"] is None else "%.0f" % (100 * e["better_than_next"])] for e in ranking]
    return [Table(SURFACE, rows)], "`breech compare %s`" % case
