#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Every external name begins with its library's prefix: base_, circuit_, mpm_; in coupling with its room's (host_, case_,
...).    tests/names.py BUILD_FOLDER    Exit 77: nothing is built, or there is no nm."""
import os
import sys

from objects import symbols


def prefix_of(source):
    folders = source.split("/")
    return folders[1 if folders[0] == "coupling" else 0] + "_"


def main():
    looked, wrong = set(), []
    for source, letter, name in symbols(os.path.abspath(sys.argv[1])):
        looked.add(source)
        if letter != "U" and name != "main" and name[0] not in "._" and not name.startswith(prefix_of(source)):
            wrong.append(f"{source}: {name} has not the prefix {prefix_of(source)}")
    if not looked:
        print("skipped: nothing is built, or there is no nm")
        return 77
    print("\n".join(wrong) if wrong else f"{len(looked)} files keep the prefixes")
    return 1 if wrong else 0


sys.exit(main())
