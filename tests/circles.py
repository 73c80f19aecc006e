#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Headers that include, and files that call, each other in a circle.    tests/circles.py BUILD_FOLDER

A file calls another where its object asks for a function that the other's defines; so what an object asks for says it,
whatever the headers.  Constants do not count: a table names its rows, and a row may call the table's helpers.
The circles that stay stand below; docs/reference/structure.md says why.    Exit 77: nothing is built, or there is no nm."""
import os
import re
import sys

from objects import root, sources, symbols

ARGUED = (
    {"mpm/grid/interface", "mpm/grid/substeps", "mpm/memory/bricks"},
    {"mpm/mpm", "mpm/refine/adapt"},
)


def calls(build):
    """File -> the files whose functions it calls."""
    home, wanted = {}, {}
    for source, letter, name in symbols(build):
        if letter == "U":
            wanted.setdefault(source[:-2], set()).add(name)
        elif letter == "T":
            home[name] = source[:-2]
    return {a: {home[name] for name in names if home.get(name, a) != a} for a, names in wanted.items()}


def includes():
    """Header -> the headers that it includes."""
    graph = {}
    for path in sources(".h"):
        with open(os.path.join(root, path), encoding="utf-8") as f:
            graph[path] = set(re.findall(r'^\s*#\s*include\s*"([^"]+)"', f.read(), re.M))
    return graph


def reachable(graph, start):
    seen, left = set(), [start]
    while left:
        for b in graph.get(left.pop(), ()):
            if b not in seen:
                seen.add(b)
                left.append(b)
    return seen


def circles(graph):
    reach = {a: reachable(graph, a) for a in graph}
    return {frozenset(b for b in reach[a] if a in reach.get(b, ())) for a in graph if a in reach[a]}


def main():
    graph = calls(os.path.abspath(sys.argv[1]))
    if not graph:
        print("skipped: nothing is built, or there is no nm")
        return 77
    found = circles(graph)
    bad = [f"these include each other: {', '.join(sorted(c))}" for c in sorted(circles(includes()), key=sorted)]
    bad += [f"these call each other: {', '.join(sorted(c))}" for c in sorted(found, key=sorted) if set(c) not in ARGUED]
    bad += [f"no longer a circle: {', '.join(sorted(c))}" for c in ARGUED if frozenset(c) not in found]
    print("\n".join(bad) if bad else f"{len(graph)} files, no circles but the {len(ARGUED)} that are argued")
    return 1 if bad else 0


sys.exit(main())
