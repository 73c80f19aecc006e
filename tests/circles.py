#!/usr/bin/env python3
"""Headers that include, and files that call, each other in a circle.    tests/circles.py BUILD_FOLDER

A file calls another where its object asks for a function that the other's defines; so what an object asks for says it,
whatever the headers.  Constants do not count: a table names its rows, and a row may call the table's helpers.
The circles that stay stand below; docs/structure.md says why.    Exit 77: nothing is built, or there is no nm."""
import os
import re
import shutil
import subprocess
import sys

LIBRARIES = ("base", "circuit", "mpm", "coupling")
ARGUED = (
    {"mpm/grid/interface", "mpm/grid/substeps", "mpm/memory/bricks"},
    {"mpm/mpm", "mpm/refine/adapt"},
)


def objects(build, root):
    for library in LIBRARIES:
        for folder, _, files in os.walk(os.path.join(build, library)):
            for name in files:
                source = re.sub(r"CMakeFiles/[^/]*\.dir/", "", os.path.relpath(os.path.join(folder, name), build))
                if name.endswith(".c.o") and os.path.exists(os.path.join(root, source[:-2])):
                    yield source[:-4], os.path.join(folder, name)


def calls(build, root):
    """File -> the files whose functions it calls."""
    home, wanted = {}, {}
    for source, file in objects(build, root):
        for line in subprocess.run(["nm", "-g", file], capture_output=True, text=True, check=True).stdout.splitlines():
            words = line.split()
            if words[-2] == "U":
                wanted.setdefault(source, set()).add(words[-1])
            elif words[-2] == "T":
                home[words[-1]] = source
    return {a: {home[name] for name in names if home.get(name, a) != a} for a, names in wanted.items()}


def includes(root):
    """Header -> the headers that it includes."""
    graph = {}
    for library in LIBRARIES:
        for folder, _, files in os.walk(os.path.join(root, library)):
            for name in files:
                if name.endswith(".h"):
                    path = os.path.join(folder, name)
                    with open(path, encoding="utf-8") as f:
                        graph[os.path.relpath(path, root)] = set(re.findall(r'^\s*#\s*include\s*"([^"]+)"', f.read(), re.M))
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
    build = os.path.abspath(sys.argv[1])
    root = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
    graph = calls(build, root) if shutil.which("nm") else {}
    if not graph:
        print("skipped: nothing is built, or there is no nm")
        return 77
    found = circles(graph)
    bad = [f"these include each other: {', '.join(sorted(c))}" for c in sorted(circles(includes(root)), key=sorted)]
    bad += [f"these call each other: {', '.join(sorted(c))}" for c in sorted(found, key=sorted) if set(c) not in ARGUED]
    bad += [f"no longer a circle: {', '.join(sorted(c))}" for c in ARGUED if frozenset(c) not in found]
    print("\n".join(bad) if bad else f"{len(graph)} files, no circles but the {len(ARGUED)} that are argued")
    return 1 if bad else 0


sys.exit(main())
