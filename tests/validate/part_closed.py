# SPDX-License-Identifier: BSD-3-Clause
"""The closed answers of cases/verification: what a run of each gives beside what its list expects."""
import os
import subprocess

from pages import Column, Table
from runs import ROOT

CASES = "cases/verification"


def closed(runs):
    rows = []
    for name in sorted(os.listdir(os.path.join(ROOT, CASES))):
        case = os.path.join(CASES, name)
        if not os.path.exists(os.path.join(ROOT, case, "expected.yaml")):
            continue
        options = ["--set", "output.report=no", "--set", "output.snapshots=0"]
        scene = runs.run("closed_" + name, ["scene", case, *options])[0]
        told = subprocess.run([runs.breech, "check", case, "--expect", scene], cwd=ROOT, capture_output=True, text=True,
                              check=False)
        if told.returncode not in (0, 1):
            raise SystemExit(told.stdout + told.stderr)
        rows += [row(name, line) for line in told.stdout.splitlines()[1:-1]]
    # a deviation near zero differs by much of itself: what decides is whether it holds
    columns = [Column("case, key"), Column("expected", 0.0), Column("found", words=False),
               Column("deviation", words=False), Column("holds")]
    return [Table(columns, rows)], "`breech scene` and `breech check --expect` of every case; in SI units"


def row(name, line):
    """One line of what `breech check --expect` prints: key, expected, found, deviation or nothing, holds or FAILS."""
    cells = [cell for cell in line.replace(" %", "%").split("  ") if cell.strip()]
    key, expected, found = (cell.strip() for cell in cells[:3])
    deviation = cells[3].strip().replace("%", " %") if len(cells) == 5 else ""
    holds = "yes" if cells[-1].strip() == "holds" else "NO"
    return ["%s, `%s`" % (name, key), expected.replace("+-", "within"), found, deviation, holds]
