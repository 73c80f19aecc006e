# SPDX-License-Identifier: BSD-3-Clause
"""Scratch and gouge velocity of the default shot over what may move them: a table of the strengths, a map of the rest."""
import json
import os

from pages import Column, Table

BASE = {"study.craters": 0, "output.report": "no", "output.snapshots": 0,
        "study.resolution_error": "10 %", "study.resolution_above": "10 %",  # finer cells would move all rows alike
        "study.interval_parts": "[]"}  # what the table is for
STRENGTH = [  # title, settings
    ("pressed on with 60 MPa", {}),
    ("armature x 0.5", {"armature.yield_scale": 0.5}),
    ("armature x 0.7", {"armature.yield_scale": 0.7}),
    ("armature x 1.4", {"armature.yield_scale": 1.4}),
    ("rail x 0.7", {"rail.yield_scale": 0.7}),
    ("rail x 1.4", {"rail.yield_scale": 1.4}),
]
PTW = {"rail.material": "ofhc_copper_ptw"}  # a law for strain rates of small grains
SMALL = [("%s mm" % radius, {"particle.radius": "%s mm" % radius, **PTW}) for radius in ("0.5", "0.1", "0.05", "0.02")] + [
    ("0.02 mm, " + title, {"particle.radius": "0.02 mm", **PTW, **settings})
    for title, settings in STRENGTH if title not in (STRENGTH[0][0], "armature x 0.5")]
GENTLEST = {"armature.lead_angle": "5 deg", "armature.chamfer_height": "1 mm"}  # 11 mm long
MAP = [
    STRENGTH[0],
    ("not pressed on", {"scene.contact_pressure": "0 Pa"}),
    ("pressed on with 20 MPa", {"scene.contact_pressure": "20 MPa"}),
    ("lead face at 15 degrees", {"armature.lead_angle": "15 deg"}),
    ("lead face at 45 degrees", {"armature.lead_angle": "45 deg"}),
    ("rail of 450 K", {"rail.temperature": "450 K"}),
    ("time steps of Courant number 0.2, for 0.45", {"scene.courant": 0.2}),
    ("time steps of Courant number 0.6", {"scene.courant": 0.6}),
    ("craters measured at 0.05 mm, for 0.083", {"scene.measuring_depth": "0.05 mm"}),
    ("craters measured at 0.125 mm", {"scene.measuring_depth": "0.125 mm"}),
    ("armature of 450 K", {"armature.temperature": "450 K"}),
    ("armature of 600 K", {"armature.temperature": "600 K"}),
    ("armature of 600 K, twice as strong", {"armature.temperature": "600 K", "armature.yield_scale": 2, "study.screen_low": 0}),
    ("friction 0.2", {"scene.friction": 0.2}),
    ("a film of melt: shear of at most 1.2 MPa", {"scene.shear_limit": "1.2 MPa"}),  # 1.3 mPa s at 950 m/s over 1 um
    ("grain of 0.1 mm", {"particle.radius": "0.1 mm"}),
    ("grain of 0.1 mm, not pressed on", {"particle.radius": "0.1 mm", "scene.contact_pressure": "0 Pa"}),
    ("grain of 0.1 mm, lead face at 15 degrees", {"particle.radius": "0.1 mm", "armature.lead_angle": "15 deg"}),
    ("grain of 0.1 mm, rail of 450 K", {"particle.radius": "0.1 mm", "rail.temperature": "450 K"}),
    ("grain of 0.1 mm, lead face at 5 degrees, 1 mm high", {"particle.radius": "0.1 mm", **GENTLEST}),
    ("grain of 0.05 mm", {"particle.radius": "0.05 mm"}),
    ("grain of 0.02 mm", {"particle.radius": "0.02 mm"}),
]

TOGETHER = {  # lead face, armature, pressing: settings
    "%s, %s, %s" % (lead, hot, press): {"armature.lead_angle": lead.replace("degrees", "deg"), "armature.temperature": hot,
                                        "scene.contact_pressure": press}
    for lead in ("30 degrees", "15 degrees") for hot in ("293 K", "450 K") for press in ("60 MPa", "0 MPa")}
GRAINS = ("0.5 mm", "0.1 mm")


def name_of(title):
    return "strength_" + "".join(c if c.isalnum() else "_" for c in title)


def answer(runs, title, settings):
    """Summary of `breech onset` of the default shot with these settings."""
    arguments = ["onset", "cases/default_shot/pressed.yaml"]
    for key, value in {**BASE, **settings}.items():
        arguments += ["--set", "%s=%s" % (key, value)]
    folder, _ = runs.run(name_of(title), arguments)
    with open(os.path.join(folder, "summary.json"), encoding="utf-8") as file:
        return json.load(file)


def speed(summary, what):
    """A velocity with its interval [m/s], "none" where an end, or both, is not known."""
    value, ends = summary["%s_velocity" % what], summary["%s_interval" % what] or (None, None)
    shown = ["none" if v is None else "%.0f" % v for v in (value, *ends)]
    return "%s (%s .. %s)" % tuple(shown)


def row(runs, title, settings):
    summary = answer(runs, title, settings)
    return [title, speed(summary, "scratch"), speed(summary, "threshold"), "%d" % (summary["scenes_run"] + summary["scenes_reused"])]


def table(runs, rows, first="default shot", note=""):
    columns = [Column(first), Column("scratches from [m/s]", 0.25, words=False),
               Column("gouges from [m/s]", 0.25, words=False), Column("scenes", words=False)]
    return [Table(columns, [row(runs, *of) for of in rows])], NOTE + note


def strength(runs):
    return table(runs, STRENGTH)


def strength_small(runs):
    return table(runs, SMALL, "radius of the grain", "; `rail.material=ofhc_copper_ptw`")


def inputs(runs):
    return table(runs, MAP)


def inputs_together(runs):
    """Both velocities of two grains: a row for lead face, armature's temperature and pressing at a time."""
    rows = []
    for title, settings in TOGETHER.items():
        row_of = [title]
        for grain in GRAINS:
            summary = answer(runs, "%s, %s" % (title, grain), {"particle.radius": grain, **settings})
            row_of += [speed(summary, "scratch"), speed(summary, "threshold")]
        rows.append(row_of)
    columns = [Column("lead face, armature, pressing")]
    for grain in GRAINS:
        columns += [Column("%s: %s from [m/s]" % (grain, what), 0.25, words=False) for what in ("scratches", "gouges")]
    return [Table(columns, rows)], NOTE.replace("one input changed", "four inputs changed")


NOTE = ("`breech onset cases/default_shot/pressed.yaml` without whole craters, with `study.resolution_error` and `resolution_above` 10 % and no "
        "`study.interval_parts`, one input changed at a time; in brackets each velocity's interval; \"none\": beyond the velocities of the search")
