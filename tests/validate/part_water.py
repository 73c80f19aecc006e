# SPDX-License-Identifier: BSD-3-Clause
"""A plate behind water that a projectile strikes: rows U1 .. U22 of the published kind of device.

Rows with a closed answer are what the long tests print (test programs beside BREECH, run with BREECH_FULL=1), the
others come out of the shipped case, U14 with coarse cells.  U15, U16, U20: part_water_slow.py."""
import contextlib
import hashlib
import json
import math
import os
import re
import subprocess

import membrane
from pages import Column, Table
from runs import ROOT

CASE, METAL = "cases/underwater_shock", "aa5083_h116"
COARSE = {"scene__cell": "2.4 mm", "scene__window__x__cell": "0.6 mm", "scene__window__x__coarse_cell": "2.4 mm"}
FAR = {**COARSE, "scene__window__x__hi": "110 mm", "scene__window__x__fine_hi": "100 mm"}
# velocity [m/s], end of the scene, does the fracture strain rise with the rate as the plate's constants have it?
TEARS = [(43.18, "200 us", True), (150, "200 us", True), (43.18, "200 us", False), (100, "150 us", False)]
ROW = [Column("row"), Column("what"), Column("paper or closed form", 0.0), Column("comes out", 0.03),
       Column("allowed"), Column("holds"), Column("kind")]
NUMBER = r"([+-]?[\d.]+(?:e[+-]?\d+)?)"


def verdict(holds):
    return "yes" if holds else "no"


class Told:
    """What a long test has printed."""

    def __init__(self, runs, name):
        program = os.path.join(os.path.dirname(runs.breech), name)
        with open(program, "rb") as file:
            made = hashlib.sha256(file.read()).hexdigest()[:16]
        kept = os.path.join(runs.out, "%s-%s.txt" % (name, made))
        if not os.path.exists(kept):
            done = subprocess.run([program], capture_output=True, text=True, check=False, cwd=runs.out,
                                  env={**os.environ, "BREECH_FULL": "1"})
            if done.returncode:
                raise SystemExit("%s fails:\n%s%s" % (program, done.stdout, done.stderr))
            with open(kept, "w", encoding="utf-8") as file:
                file.write(done.stdout + done.stderr)
        with open(kept, encoding="utf-8") as file:
            self.name, self.text = name, file.read()

    def lines(self, words):
        """Numbers of each line that reads so, with # for a number."""
        found = re.findall("^" + re.escape(words).replace(r"\#", NUMBER), self.text, flags=re.M)
        if not found:
            raise SystemExit("%s does not say: %s" % (self.name, words))
        return [[float(x) for x in (line if isinstance(line, tuple) else (line,))] for line in found]

    def passed(self, test):
        return re.search(r"^\[ +OK \] %s$" % test, self.text, flags=re.M) is not None


def worst(pairs):
    """Largest deviation of value over reference [%], with its sign."""
    return 100 * max((value / want - 1 for value, want in pairs), key=abs)


def range_of(deviations):
    return "%+.2f .. %+.2f %%" % (min(deviations), max(deviations))


def row(name, what, reference, found, allowed, holds, kind="V"):
    return [name, what, reference, found, allowed, holds if isinstance(holds, str) else verdict(holds), kind]


def laws(material):
    def of(name, what, reference, test, found, allowed):
        return row(name, what, reference, found if material.passed(test) else "fails", allowed, material.passed(test))
    return [
        of("U1", "damage of one point: none up to D_th, then D_c (e - D_th)/(e_f - D_th)", "closed",
           "test_damage_extended", "`test_damage_extended` passes", "1e-6"),
        of("U2", "flow stress times 1 - D, at failure 1 - D_c", "closed", "test_damage_extended",
           "`test_damage_extended` passes", "1e-9"),
        of("U3", "D_c 1, D_th 0, no softening: (M-1), (M-2)", "the same bits", "test_damage_plain",
           "`test_damage_plain` passes", "0"),
    ]


def waves(water, wave, tube, match):
    shocks = water.lines("water stopped from # m/s: us # (# %), p # MPa (# %), rms # %")
    speed_and_pressure = all(abs(s[2]) < 0.5 and abs(s[4]) < 0.5 for s in shocks)
    smooth = [s[0] for s in shocks if s[5] <= 1]
    plateau = verdict(speed_and_pressure)
    if len(smooth) < len(shocks):
        plateau += ", rms to %g m/s" % max(smooth)
    copper, aluminium = (wave.lines("1 MPa on %s: # fold (#)" % metal)[0][0] for metal in ("copper", "aluminium"))
    held = wave.lines("1 MPa on held: # fold")[0][0]
    reflection = [(copper, 1.933), (aluminium, 1.845), (held, 2.0)]
    piston = tube.lines("piston at # m/s: # MPa (#), theta # us (#)")
    front = tube.lines("front after # m: # MPa (#), momentum left #, books #")
    decay = worst([(f[1], f[2]) for f in front])
    wall = tube.lines("wall: # MPa for #, # fold")[0][2]
    gauge = tube.lines("gauge: front after # us (#), # MPa (#); back # us later (#), # MPa")[0]
    cavity = water.lines("cavity: least pressure # Pa, widest # of the column (#), # at the end, thin points # Pa; energy #")[0]
    on_water = [line for metal in ("al7075_t651", "steel")
                for line in match.lines("%s on water at # m/s: # MPa (#)" % metal)]
    met = worst([(line[1], line[2]) for line in on_water])
    p0, theta = worst([(p[1], p[2]) for p in piston]), worst([(p[3], p[4]) for p in piston])
    return [
        row("U4", "water's Hugoniot, 10 .. 1000 m/s: Us; p; rms of the plateau", "c0 + s u; rho0 Us u; 0",
            "Us %s; p %s; rms %.2f %% to 500 m/s, %.2f %% above" % (
                range_of([s[2] for s in shocks]), range_of([s[4] for s in shocks]),
                max(s[5] for s in shocks if s[0] <= 500), max(s[5] for s in shocks if s[0] > 500)),
            "0.5 %; 0.5 %; 1 %", plateau, "equation of state C, rest V"),
        row("U5", "wave from water into copper; aluminium; a rigid wall", "1.933; 1.845; 2",
            "%.3f; %.3f; %.3f" % (copper, aluminium, held), "1 %", abs(worst(reflection)) < 1),
        row("U6", "piston at 22.94, 43.18 m/s: p at its face; theta", "35.1, 67.9 MPa; 49.9 us",
            "%.1f, %.1f MPa; %.1f, %.1f us" % (piston[0][1], piston[1][1], piston[0][3], piston[1][3]), "2 %; 3 %",
            abs(p0) < 2 and abs(theta) < 3),
        row("U7", "the piston's momentum goes into the wave: left at the piston; balance of momentum", "0; 0",
            "%.1e; %.0e" % (max(f[3] for f in front), max(abs(f[4]) for f in front)), "1 %; 1e-10",
            all(abs(f[3]) < 0.01 and abs(f[4]) < 1e-10 for f in front)),
        row("U8", "front at 22.94 m/s after 0.5, 1.0, 1.3 m", ", ".join("%.1f" % f[2] for f in front) + " MPa",
            ", ".join("%.1f" % f[1] for f in front) + " MPa", "5 %", abs(decay) < 5),
        row("U9", "rigid wall: peak over that of the incident wave there", "2.03", "%.3f" % wall, "2 %",
            abs(wall / 2.03 - 1) < 0.02),
        row("U12", "cavity in water: least pressure; widest over that of two halves that part; balance of energy",
            "0; 1; 0", "%.0f Pa; %.2f; %.0e" % (cavity[0], cavity[1] / cavity[2], cavity[5]), "-2 kPa; -; 1e-9",
            cavity[0] > -2e3 and abs(cavity[5]) < 1e-9),
        row("U17", "gauge 0.1 m before a rigid target at 1.3 m: front comes; its reflection later",
            "%.0f us; %.0f us" % (gauge[1], gauge[5]), "%.0f us; %.0f us" % (gauge[0], gauge[4]), "1 %; 3 %",
            abs(gauge[0] / gauge[1] - 1) < 0.01 and abs(gauge[4] / gauge[5] - 1) < 0.03),
        row("U22", "7075, steel on water at 100 .. 1933 m/s: pressure", "148 .. 8200 MPa",
            "within %.1f %% of all eight" % abs(met), "1 %", abs(met) < 1),
    ]


def plates(tube):
    taylor = tube.lines("plate of # kg/m2: # m/s (#), parted after # us (#), way # mm")
    driven = tube.lines("# m/s, # kg/m2: # m/s (#), parted after # us, way # mm (#)")
    speed, later = worst([(t[1], t[2]) for t in taylor]), [t[3] - t[4] for t in taylor]
    fast, way = worst([(d[2], d[3]) for d in driven]), worst([(d[5], d[6]) for d in driven])
    return [
        row("U10", "free plates of 2.24, 8.1, 39 kg/m2 at 1 m/s, Taylor (1941): speed; when they part",
            ", ".join("%.2f" % t[2] for t in taylor) + " m/s; " + ", ".join("%.1f" % t[4] for t in taylor) + " us",
            ", ".join("%.2f" % t[1] for t in taylor) + " m/s; " + ", ".join("%.1f" % t[3] for t in taylor) + " us",
            "3 %; 2 us and the front's rise, 3 us", abs(speed) < 3 and max(map(abs, later)) < 5),
        row("U11", "ten free plates at 22.94 .. 100 m/s with cavitation, beside another program: speed; way",
            "the other program", "within %.1f %%; within %.1f %%" % (abs(fast), abs(way)), "3 %; 5 %",
            abs(fast) < 3 and abs(way) < 5),
    ]


def run(runs, name, command, **settings):
    arguments = [command, CASE]
    for key, value in {"output__report": "no", **settings}.items():
        arguments += ["--set", "%s=%s" % (key.replace("__", "."), value)]
    folder, _ = runs.run("water_" + name, arguments)
    with open(os.path.join(folder, "summary.json"), encoding="utf-8") as file:
        return json.load(file)


def strike(runs, name, **settings):
    return run(runs, name, "strike", **settings)


@contextlib.contextmanager
def fracture(runs, with_rate):
    """Runs inside have the plate's metal, its fracture strain rising with the rate as in its file or not at all."""
    if with_rate:
        yield
        return
    folder = os.path.join(runs.out, "without_rate")
    os.makedirs(folder, exist_ok=True)
    with open(os.path.join(ROOT, "cases", "materials", METAL + ".yaml"), encoding="utf-8") as file:
        text, found = re.subn(r"damage_rate_power: {value: [^,}]+", "damage_rate_power: {value: 0", file.read())
    if found != 1:
        raise SystemExit("%s has no damage_rate_power" % METAL)
    with open(os.path.join(folder, METAL + ".yaml"), "w", encoding="utf-8") as file:
        file.write(text)
    os.environ["BREECH_MATERIALS"] = folder
    try:
        yield
    finally:
        del os.environ["BREECH_MATERIALS"]


def tear(runs, velocity, end, with_rate):
    """As text, and whether it tears."""
    with fracture(runs, with_rate):
        s = strike(runs, "at_%g%s" % (velocity, "" if with_rate else "_no_rate"), strike__velocity="%g m/s" % velocity,
                   scene__end_time=end, **FAR)
    return "%s at %g m/s" % (s["class"], velocity), s["class"] == "torn"


def scene(runs):
    shipped, coarse = strike(runs, "shipped"), strike(runs, "coarse", **COARSE)
    mm, bulged = 1e3 * shipped["deflection"], shipped["class"] == "bulged"
    cells = 100 * (shipped["deflection"] / coarse["deflection"] - 1)
    whole, blow = (1e3 * membrane.deflection(first_blow_only=only) for only in (False, True))
    told = [tear(runs, *how) for how in TEARS]
    kept, dropped = (", ".join(text for (text, _), how in zip(told, TEARS) if how[2] == rate) for rate in (True, False))
    return [
        row("U13", "clamped aluminium plate, 22.94 m/s: class; its middle by the first blow alone, v R sqrt(rho/sigma)",
            "bulged; 2.7 .. 3.3 mm", "%s; %.1f mm" % (shipped["class"], mm), "class; 25 %",
            "class yes, deflection no" if bulged and not 0.75 * 2.7 < mm < 1.25 * 3.3 else bulged),
        row("U13", "the same by one mode of the plate at the end of a tube of water (`membrane.py`); by its first blow",
            "%.1f mm; %.1f mm" % (whole, blow), "%.1f mm" % mm, "25 %", abs(mm / whole - 1) < 0.25),
        row("U14", "where the plate tears, cells of 0.6 mm across", "between 70 and 150 m/s (order)", kept, "class",
            not told[0][1] and told[1][1]),
        row("U14", "the same, its fracture strain independent of the rate", "between 70 and 150 m/s (order)", dropped,
            "class", not told[2][1] and told[3][1], "variant"),
        row("U18", "deflection, cells of 0.4 mm over those of 0.6 mm", "0", "%+.1f %%" % cells, "2 %", abs(cells) < 2),
    ]


ROUND = "{turn: {axis: 0 0 1, angle: -90 deg, of: {cylinder: {center: 0 %g 0 mm, radius: 32 mm, height: %g mm}}}}"
FREE = {  # the plate of a strip of the bore with nothing that holds it
    "scene__bodies": "[{name: plate, material: aa5083_h116, shape: {box: {lo: 40 0 0 mm, hi: 41.2 4.8 4.8 mm}}}, "
                     "{name: water, material: tap_water, piston_mass: 73.98 kg/m2, piston_velocity: 22.94 m/s, "
                     "tube_length: 1.26 m, shape: {box: {lo: 0 0 0 mm, hi: 40 4.8 4.8 mm}}}]",
    "scene__contacts": "[{default: frictionless}, {between: [water, plate], law: frictionless, normal_of: plate}]",
    "scene__window__y__hi": "4.8 mm", "scene__window__z__hi": "4.8 mm", "scene__probes": "[]",
    "scene__boundary": "{y: [symmetry, symmetry], z: [symmetry, symmetry]}", "scene__end_time": "80 us",
}
ALONE = {  # the plate without water, its part over the bore moving: at 70 us that has come to rest
    "scene__bodies": "[{name: fixture, material: aa5083_h116, held: yes, shape: {minus: [{box: {lo: 36 0 0 mm, hi: 43.6 "
                     "36 36 mm}}, %s, {box: {lo: 40 -1 -1 mm, hi: 41.2 37 37 mm}}]}}, {name: disc, material: "
                     "aa5083_h116, group: plate, velocity: 34.5 0 0 m/s, shape: %s}, {name: ring, material: "
                     "aa5083_h116, group: plate, shape: {minus: [{box: {lo: 40 0 0 mm, hi: 41.2 36 36 mm}}, %s]}}]" % (
                         ROUND % (-10, 70), ROUND % (40, 1.2), ROUND % (-10, 70)),
    "scene__contacts": "[{default: frictionless}, {between: [disc, fixture], law: coulomb, bond_strength: 1 TPa, "
                       "normal_of: fixture}]",
    "scene__probes": "[{name: way, passage: {along: 1 0 0, from: 40 0 0 mm, reach: 2 mm, slower: 1 km/s, body: fixture}}]",
    "strike__projectile": "disc", "strike__plate": "fixture", "scene__end_time": "70 us",
}
CAUSE = [Column("what is asked"), Column("expected", 0.0), Column("comes out", 0.03)]


def cause(runs):
    """Why the plate goes farther than its first blow would have it."""
    psi, front, area = membrane.PISTON / 3.24, 24.77e6, math.pi * membrane.RADIUS ** 2
    taylor = 2 * front / (membrane.DENSITY * membrane.SPEED) * psi ** (1 / (1 - psi))
    free, shipped = strike(runs, "free", **FREE), strike(runs, "shipped")
    alone = run(runs, "alone", "scene", **ALONE)
    speed, first = free["bodies"]["plate"]["velocity"][0], 3.24 * taylor * area
    softer, harder = (1e3 * membrane.deflection(strength=factor) for factor in (0.8, 1.2))
    rows = [
        ["speed of the plate if nothing held it; Taylor's with the 24.8 MPa of U8", "%.1f m/s" % taylor,
         "%.1f m/s" % speed],
        ["the plate alone, without water, its part over the bore at 34.5 m/s: its middle", "2.7 .. 3.3 mm",
         "%.1f mm" % (1e3 * alone["probes"]["way"]["last"]["deflection"])],
        ["impulse of the water on plate and rim until the end; mass of the plate over the bore times Taylor's speed",
         "%.2f N s" % first, "%.2f N s" % shipped["impulse"]],
        ["`membrane.py` with flow stress 20 % higher .. 20 % lower: its middle", "", "%.1f .. %.1f mm" % (harder, softer)],
    ]
    return Table(CAUSE, rows)


NOT_RUN = [
    ("U19", "grid-core target", "order of events", "three cells across each of its sheets: hours"),
]


def water(runs):
    material, column, wave, tube, match = (Told(runs, "test_" + name) for name in (
        "mpm_material", "mpm_water", "mpm_wave", "mpm_tube", "impedance"))
    rows = laws(material) + waves(column, wave, tube, match) + plates(tube) + scene(runs)
    rows += [row(name, what, reference, why, "", "not run") for name, what, reference, why in NOT_RUN]
    rows.sort(key=lambda r: int(r[0][1:]))
    return [Table(ROW, rows), cause(runs)], "long tests and cases/underwater_shock; kind C: an input, V: computed"


INVERSE = [Column("row"), Column("wanted"), Column("gives", 0.005), Column("comes out", 0.005), Column("allowed"),
           Column("holds")]
BANK = ("[{count: 1, capacitance: 3.594 mF, charge: 3 kV, inductance: 12.56 uH, resistance: 4.1 mohm, crowbar_drop: 1.48 V, "
        "crowbar_resistance: 0.43 mohm, cable_inductance: 1 uH, cable_resistance: 1 mohm}]")


def inverse(runs):
    """A wanted wave: piston's velocity and mass in closed form, and the charge that gives them."""
    pressure, theta, rho, c, slope, bore = 35e6, 50e-6, 1000.0, 1480.0, 1.92, 64e-3
    velocity = (math.sqrt(c * c + 4 * slope * pressure / rho) - c) / (2 * slope)
    mass = rho * c * theta * math.pi / 4 * bore ** 2
    settings = {"armature.mass": "%.6g kg" % mass, "armature.preload": "0 N", "barrel.length": "1 m", "sites": "[]",
                "options.max_time": "1 s", "bank": BANK, "optimise.goal": "velocity",
                "optimise.muzzle_velocity": "%.6g m/s" % velocity, "output.report": "no"}
    arguments = ["shot", "cases/default_shot"]
    for key, value in settings.items():
        arguments += ["--set", "%s=%s" % (key, value)]
    folder, _ = runs.run("water_inverse", arguments)
    with open(os.path.join(folder, "summary.json"), encoding="utf-8") as file:
        s = json.load(file)
    found = s["muzzle_velocity"]
    rows = [["U21", "p0 %.0f MPa, theta %.0f us on %.0f mm" % (1e-6 * pressure, 1e6 * theta, 1e3 * bore),
             "%.2f m/s, %.4f kg" % (velocity, mass),
             "%.2f m/s with %.2f kV" % (found, 3 * s["charge_scale"]), "1 %", verdict(abs(found / velocity - 1) < 0.01)]]
    return [Table(INVERSE, rows)], "one unit of 3.6 mF on the default rails, 1 m of them, without friction at rest"
