#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The tables of docs/validation, from runs of the program.

  tables.py BREECH OUT [PART ...]          writes these parts anew (no PART: all) into their pages
  tables.py BREECH OUT --check [PART ...]  compares them with the pages instead (no PART: the quick ones); exit 1 if any
                                           differs
  tables.py --list                         the parts, their pages and what they take

OUT keeps the runs: one that is there, of the same program and arguments, is not computed again, so a stopped command
goes on.
--threads N: of each run (default: all of the machine).

To add a part: a function of `Runs` that returns tables and a line that says what was run, a line in PARTS, in a page
  <!-- table: NAME -->
  <!-- end -->"""
import sys

import pages
import part_closed
import part_criterion
import part_droplet
import part_fatigue
import part_gel
import part_growth
import part_initiators
import part_lattice
import part_laws
import part_layer
import part_levels
import part_pairs
import part_slide
import part_strength
import part_stripes
import part_struts
import part_water
import part_water_slow
import part_wu2017
from runs import Runs

from breech.needs import demand

PARTS = {  # name: page, function, minutes of processor time, quick: compared by ctest with BREECH_FULL=1
    "wu2017-rows": ("docs/validation/wu2017.md", part_wu2017.all_rows, 140, False),
    "wu2017": ("docs/validation/wu2017.md", part_wu2017.two_cells, 15, True),
    "wu2017-three-cells": ("docs/validation/wu2017.md", part_wu2017.three_cells, 75, False),
    "wu2017-five-cells": ("docs/validation/wu2017.md", part_wu2017.five_cells, 50, False),
    "wu2017-shipped": ("docs/validation/wu2017.md", part_wu2017.shipped, 2, False),
    "levels": ("docs/validation/levels.md", part_levels.default_shot, 12, True),
    "stripes": ("docs/validation/levels.md", part_stripes.stripes, 8, False),
    "levels-one": ("docs/validation/levels.md", part_levels.one_level, 30, False),
    "levels-paper": ("docs/validation/levels.md", part_levels.paper, 12, False),
    "levels-shipped": ("docs/validation/levels.md", part_levels.shipped, 20, False),
    "cells-grow": ("docs/validation/levels.md", part_levels.growing, 25, False),
    "cells": ("docs/validation/growth.md", part_growth.cells, 90, False),
    "cells-fine": ("docs/validation/growth.md", part_growth.fine, 55, False),
    "cells-pairs": ("docs/validation/growth.md", part_growth.pairs, 35, False),
    "layer": ("docs/validation/layers.md", part_layer.layer, 65, False),
    "film": ("docs/validation/layers.md", part_layer.film, 110, False),
    "droplet": ("docs/validation/initiators.md", part_droplet.droplet, 12, False),
    "criterion-steel": ("docs/validation/criterion.md", part_criterion.steel, 13, False),
    "criterion-paper": ("docs/validation/criterion.md", part_criterion.paper, 15, False),
    "struts": ("docs/validation/lattice.md", part_struts.struts, 4, False),
    "lattice-press": ("docs/validation/lattice.md", part_lattice.pressing, 10, False),
    "lattice-rows": ("docs/validation/lattice.md", part_lattice.nets, 36, False),
    "water": ("docs/validation/water.md", part_water.water, 12, False),
    "water-slow": ("docs/validation/water.md", part_water_slow.slow, 12, False),
    "water-inverse": ("docs/validation/water.md", part_water.inverse, 1, True),
    "fatigue": ("docs/validation/fatigue.md", part_fatigue.wheel, 3, True),
    "rail-surfaces": ("docs/validation/fatigue.md", part_fatigue.surfaces, 1, True),
    "slide": ("docs/validation/fatigue.md", part_slide.slide, 3, True),
    "gel": ("docs/validation/gel.md", part_gel.droplet, 3, False),
    "gel-cells": ("docs/validation/gel.md", part_gel.cells, 12, False),
    "laws": ("docs/validation/laws.md", part_laws.laws, 1, True),
    "laws-6061": ("docs/validation/laws.md", part_laws.laws_6061, 1, True),
    "laws-5083": ("docs/validation/laws.md", part_laws.laws_5083, 1, True),
    "taylor": ("docs/validation/laws.md", part_laws.taylor, 6, False),
    "plate": ("docs/validation/laws.md", part_laws.plate, 1, True),
    "taylor-6061": ("docs/validation/laws.md", part_laws.taylor_6061, 6, False),
    "strength": ("docs/validation/strength.md", part_strength.strength, 30, False),
    "strength-small": ("docs/validation/strength.md", part_strength.strength_small, 25, False),
    "pairs": ("docs/validation/pairs.md", part_pairs.pairs, 60, False),
    "pairs-null": ("docs/validation/pairs.md", part_pairs.nulls, 1, True),
    "inputs": ("docs/validation/inputs.md", part_strength.inputs, 70, False),
    "inputs-together": ("docs/validation/inputs.md", part_strength.inputs_together, 50, False),
    "initiators": ("docs/validation/initiators.md", part_initiators.initiators, 80, False),
    "closed": ("docs/validation/closed.md", part_closed.closed, 3, True),
}


def options(words):
    """breech, out, parts, check, threads"""
    check = "--check" in words
    threads = 0
    if "--threads" in words:
        at = words.index("--threads")
        threads = int(words[at + 1])
        del words[at:at + 2]
    words = [word for word in words if word != "--check"]
    if len(words) < 2 or any(part not in PARTS for part in words[2:]):
        sys.exit(__doc__ + "\nparts: " + ", ".join(PARTS))
    parts = words[2:] or [name for name, part in PARTS.items() if part[3] or not check]
    return words[0], words[1], parts, check, threads


def main():
    if sys.argv[1:] == ["--list"]:
        for name, (page, _, minutes, quick) in PARTS.items():
            print("%-20s %-28s %3d min%s" % (name, page, minutes, ", in --full" if quick else ""))
        return
    demand("numpy", "h5py")
    breech, out, parts, check, threads = options(sys.argv[1:])
    runs = Runs(breech, out, threads)
    faults = []
    for name in parts:
        page, tables_of, _, _ = PARTS[name]
        tables, note = tables_of(runs)
        if check:
            faults += pages.check_part(page, name, tables)
        else:
            pages.write_part(page, name, tables, note)
        print("%s: %s" % (name, "compared" if check else "written into " + page), flush=True)
    if faults:
        sys.exit("pages of docs/validation do not say what comes out now:\n  " + "\n  ".join(faults))


if __name__ == "__main__":
    main()
