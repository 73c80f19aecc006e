# SPDX-License-Identifier: BSD-3-Clause
"""Eight pairs of metals in one order: cases/pairs with nothing changed but the metals, beside the null models."""
import json
import os
import random
import re
import subprocess

import null_models
from pages import Column, Table
from part_strength import speed
from runs import ROOT

COPPER, AL7075, STEEL = "ofhc_copper_half_hard", "al7075_t651_limited", "steel_4340"
AL6061, TI64 = "al6061_t6_konokman", "ti6al4v"
PAIRS = [  # armature on rail, their files
    ("copper on copper", COPPER, COPPER),
    ("1100 on copper", "al1100_o", COPPER),
    ("6061 on copper", AL6061, COPPER),
    ("7075 on copper", AL7075, COPPER),
    ("Ti-6Al-4V on copper", TI64, COPPER),
    ("7075 on molybdenum", AL7075, "molybdenum"),
    ("7075 on 4340", AL7075, STEEL),
    ("4340 on 4340", STEEL, STEEL),
]
NULL = ("N1", "N2", "N3")
WORLDS = 2000  # thresholds drawn from their intervals, for how far Kendall's tau may be off
NO_SCENES = {"study__screen_low": 10000}


def metals(armature, rail):
    return ["--set", "armature.material=" + armature, "--set", "rail.material=" + rail]


def refusal(runs, armature, rail):
    """What a pair is refused for, "" if it runs."""
    command = [runs.breech, "check", "cases/pairs", *metals(armature, rail)]
    told = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    if told.returncode == 0:
        return ""
    lacks = re.search(r"material (\S+) lacks what this study needs: (.*)", told.stderr + told.stdout)
    if not lacks:
        raise SystemExit(" ".join(command) + "\n" + told.stderr)
    return "refused: %s lacks %s" % lacks.groups()


def answer(runs, pair, **settings):
    """Summary of `breech onset`, None where the pair is refused."""
    title, armature, rail = pair
    if refusal(runs, armature, rail):
        return None
    arguments = ["onset", "cases/pairs", *metals(armature, rail)]
    for key, value in settings.items():
        arguments += ["--set", "%s=%s" % (key.replace("__", "."), value)]
    folder, _ = runs.run(("nulls_" if settings else "pairs_") + re.sub(r"\W", "_", title), arguments)
    with open(os.path.join(folder, "summary.json"), encoding="utf-8") as file:
        return json.load(file)


def null_velocities(runs, summary, armature, rail):
    """N1, N2, N3 [m/s]; the program's must be those of the second writing."""
    second = null_models.velocities(*(null_models.constants(runs.breech, name) for name in (armature, rail)))
    if summary is None:
        return second
    first = [of["threshold_velocity"] for of in summary["null_models"]]
    if max(abs(a - b) for a, b in zip(first, second)) > 1.0:
        raise SystemExit("null models of %s on %s: %s, by the formulas %s" % (armature, rail, first, second))
    return first


def interval(summary):
    """Of the gouge's velocity [m/s]; an end that is not known lies beyond the search."""
    low, high = summary["threshold_interval"]
    return (0.0 if low is None else low, float("inf") if high is None else high)


def rank_range(intervals, at):
    """Ranks, 1 for the lowest velocity, that intervals allow one of them."""
    low, high = intervals[at]
    below = sum(other[1] < low for other in intervals)
    above = sum(other[0] > high for other in intervals)
    return below + 1, len(intervals) - above


def kendall_tau(a, b):
    """Of two lists: agreeing less disagreeing pairs over all of them; a pair that is equal in one counts for neither."""
    n, score = len(a), 0
    for i in range(n):
        for k in range(i):
            product = (a[i] - a[k]) * (b[i] - b[k])
            score += (product > 0) - (product < 0)
    return score / (n * (n - 1) / 2)


def tau_within(intervals, other):
    """Kendall's tau of the middles with the other list, and 5 and 95 % where each lies anywhere in its interval."""
    draw = random.Random(1)
    found = sorted(kendall_tau([draw.uniform(*ends) for ends in intervals], other) for _ in range(WORLDS))
    return (kendall_tau([0.5 * (low + high) for low, high in intervals], other),
            found[int(0.05 * WORLDS)], found[int(0.95 * WORLDS) - 1])


def closed(ends, top):
    """An interval without an open end, for draws."""
    return ends[0], min(ends[1], top)


def pair_rows(answers, nulls):
    """Rows of the table; answers: summaries or what a pair is refused for."""
    run = [i for i, found in enumerate(answers) if not isinstance(found, str)]
    intervals = [interval(answers[i]) for i in run]
    rows = []
    for i, (title, _, _) in enumerate(PAIRS):
        null = ["%.0f" % v for v in nulls[i]]
        if i in run:
            ranks = rank_range(intervals, run.index(i))
            rank = "%d" % ranks[0] if ranks[0] == ranks[1] else "%d to %d" % ranks
            rows.append([title, speed(answers[i], "scratch"), speed(answers[i], "threshold"), rank, *null])
        else:
            rows.append([title, "", answers[i], "", *null])
    return rows


def tau_rows(answers, nulls):
    run = [i for i, found in enumerate(answers) if not isinstance(found, str)]
    intervals = [closed(interval(answers[i]), 4000.0) for i in run]
    rows = []
    for k, name in enumerate(NULL):
        rows.append([name, "%.2f (%.2f .. %.2f)" % tau_within(intervals, [nulls[i][k] for i in run])])
    return rows


def order(values):
    """Ranks, 1 for the lowest."""
    return [1 + sum(other < value for other in values) for value in values]


def nulls(runs):
    found = [null_velocities(runs, answer(runs, pair, **NO_SCENES), *pair[1:]) for pair in PAIRS]
    ranks = [order([of[k] for of in found]) for k in range(len(NULL))]
    rows = [[pair[0]] + ["%.0f (%d)" % (v, ranks[k][i]) for k, v in enumerate(found[i])]
            for i, pair in enumerate(PAIRS)]
    columns = [Column("armature on rail")] + [Column(name + " [m/s] (rank)", 0.01) for name in NULL]
    return [Table(columns, rows)], NULL_NOTE


def pairs(runs):
    summaries = [answer(runs, pair) for pair in PAIRS]
    null = [null_velocities(runs, found, *pair[1:]) for found, pair in zip(summaries, PAIRS)]
    answers = [found or refusal(runs, *pair[1:]) for found, pair in zip(summaries, PAIRS)]
    columns = [Column("armature on rail"), Column("scratches from [m/s]", 0.25, words=False),
               Column("gouges from [m/s]", 0.25, words=False), Column("ranks it may have", words=False)]
    columns += [Column(name + " [m/s]", 0.01) for name in NULL]
    taus = [Column("null model"), Column("Kendall's tau with the scenes' order", words=False)]
    return [Table(columns, pair_rows(answers, null)), Table(taus, tau_rows(answers, null))], NOTE


NOTE = ("`breech onset cases/pairs` with `armature.material` and `rail.material` of each pair; in brackets each velocity's "
        "interval, \"none\": beyond the velocities of the search; ranks from the lowest velocity of gouging up; tau of the middles of the "
        "intervals, in brackets 5 and 95 % where each lies anywhere in its own")
NULL_NOTE = ("`null_models` of `breech onset cases/pairs`, no scene run, each compared with the formulas written a second "
             "time (tests/validate/null_models.py), which alone serve for molybdenum")
