# SPDX-License-Identifier: BSD-3-Clause
"""Both velocities of what a rail has that gouging may begin at: the cases of cases/initiators that have a grain."""
import json
import os

from pages import Column, Table
from part_strength import speed

GRAINS = [  # case, what it is
    ("pit", "pit 50 um deep"),
    ("deposit", "aluminium droplet 36 um high"),
    ("grit", "sand 0.2 mm across, loose"),
    ("rim", "rim of a gouge, 0.3 mm high"),
    ("ridge", "ridge across the rail, 15 um high"),
]


def row(runs, case, title):
    folder, _ = runs.run("initiators_" + case, ["onset", "cases/initiators/%s.yaml" % case])
    with open(os.path.join(folder, "summary.json"), encoding="utf-8") as file:
        summary = json.load(file)
    return ["%s, `%s`" % (title, case), speed(summary, "scratch"), speed(summary, "threshold"), summary["verdict"],
            "%d" % (summary["scenes_run"] + summary["scenes_reused"])]


def initiators(runs):
    columns = [Column("grain"), Column("scratches from [m/s]", 0.3, words=False),
               Column("gouges from [m/s]", 0.3, words=False), Column("verdict"), Column("scenes", words=False)]
    return [Table(columns, [row(runs, *of) for of in GRAINS])], NOTE


NOTE = ("`breech onset cases/initiators/CASE.yaml`, each case as shipped; in brackets each velocity's interval; \"none\": beyond the "
        "velocities of the search")
