# SPDX-License-Identifier: BSD-3-Clause
"""Scratch and gouge velocity of the default shot with a weaker or stronger armature."""
import json
import os

from pages import Column, Table

BASE = {"study.craters": 0, "scene.contact_pressure": "60 MPa", "output.report": "no", "output.snapshots": 0}
STRENGTH = [  # title, settings
    ("as shipped, pressed on with 60 MPa", {}),
    ("armature x 0.7", {"armature.yield_scale": 0.7}),
    ("armature x 1.4", {"armature.yield_scale": 1.4}),
]


def name_of(title):
    return "strength_" + "".join(c if c.isalnum() else "_" for c in title)


def answer(runs, title, settings):
    """Summary of `breech onset` of the default shot with these settings."""
    arguments = ["onset", "cases/default_shot"]
    for key, value in {**BASE, **settings}.items():
        arguments += ["--set", "%s=%s" % (key, value)]
    folder, _ = runs.run(name_of(title), arguments)
    with open(os.path.join(folder, "summary.json"), encoding="utf-8") as file:
        return json.load(file)


def speed(summary, what):
    """A velocity with its interval [m/s]; which ends are open."""
    value, ends = summary["%s_velocity" % what], summary["%s_interval" % what]
    shown = ["none" if v is None else "%.0f" % v for v in (value, *ends)]
    return "%s (%s .. %s)" % tuple(shown)


def row(runs, title, settings):
    summary = answer(runs, title, settings)
    return [title, speed(summary, "scratch"), speed(summary, "threshold"), "%d" % summary["scenes_run"]]


def strength(runs):
    columns = [Column("default shot"), Column("scratches from [m/s]", 0.25, words=False),
               Column("gouges from [m/s]", 0.25, words=False), Column("scenes", words=False)]
    return [Table(columns, [row(runs, *of) for of in STRENGTH])], NOTE


NOTE = ("`breech onset cases/default_shot` without whole craters, one input changed at a time; in brackets each "
        "velocity's interval; \"none\": beyond the velocities of the search")
