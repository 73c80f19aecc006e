#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""What a comparison of a page with fresh figures notices, and that every part of tables.py has its place."""
import os
import re

import pages
import tables
from pages import Column, Table
from runs import ROOT

COLUMNS = [Column("scene"), Column("class"), Column("depth [mm]", 0.1), Column("time [s]", words=False)]


def differences(*fresh):
    written = pages.written_tables(Table(COLUMNS, [["slow", "3 gouge", "0.60 ± 0.02", "12"],
                                                   ["fast", "scratch", "0.300", "9"],
                                                   ["odd", "1 gouge, 1 none", "", ""]]).markdown())
    return Table(COLUMNS, [list(row) for row in fresh]).differences(written[0])


SLOW, FAST = ("slow", "3 gouge", "0.60 ± 0.02", "12"), ("fast", "scratch", "0.300", "9")
ODD = ("odd", "1 gouge, 1 none", "", "")


def stated_parts(case):
    """The parts of study.interval_parts in a case's file."""
    with open(os.path.join(ROOT, case), encoding="utf-8") as file:
        return re.findall(r"- ({part: .*?})", file.read())


def named_parts():
    """Of the last column of the page that gathers what is known of the onset; commands aside."""
    with open(os.path.join(ROOT, "docs/validation/onset.md"), encoding="utf-8") as file:
        last = [line.split("|")[-2] for line in file if line.startswith("| ")]
    return [name for cell in last for name in re.findall("`([^`]*)`", cell) if not name.startswith("breech ")]


def main():
    for what, fresh, faults in [
        ("the same", (SLOW, FAST, ODD), 0),
        ("within a tenth, another ±, another time", (("slow", "3 gouge", "0.65 ± 0.09", "99"), FAST, ODD), 0),
        ("beyond both a tenth and three times the scatter", (("slow", "3 gouge", "0.67 ± 0.02", "12"), FAST, ODD), 1),
        ("beyond a tenth, no scatter known", (SLOW, ("fast", "scratch", "0.331", "9"), ODD), 1),
        ("another class", (SLOW, ("fast", "gouge", "0.300", "9"), ODD), 1),
        ("grids that did not agree and do now", (SLOW, FAST, ("odd", "3 none", "", "")), 0),
        ("fewer grids of a class", (("slow", "2 gouge, 1 none", "0.60 ± 0.02", "12"), FAST, ODD), 0),
        ("a figure less", (SLOW, ("fast", "scratch", "", "9"), ODD), 1),
        ("a row less", (SLOW,), 1),
        ("a row of another name", (SLOW, ("faster", "scratch", "0.300", "9")), 1),
    ]:
        found = differences(*fresh)
        assert len(found) == faults, "%s: %s" % (what, found)
    for name, part in tables.PARTS.items():
        text = pages.part_text(part[0], name)[1]
        assert pages.written_tables(text) or "Not run yet" in text, "%s: part %s is empty" % (part[0], name)
    default, treatments = (stated_parts("cases/%s/case.yaml" % case) for case in ("default_shot", "treatments"))
    assert default and default == treatments[:-1], "cases/treatments repeats the default shot's parts and adds one"
    names = named_parts()
    assert len(names) > 10 and not set(names) - set(tables.PARTS), "docs/validation/onset.md: %s" % (set(names) - set(tables.PARTS))
    print("%d parts in place" % len(tables.PARTS))


if __name__ == "__main__":
    main()
