# SPDX-License-Identifier: BSD-3-Clause
"""What a build's objects define and ask for, by nm; shared by circles.py, names.py and unused.py."""
import os
import re
import shutil
import subprocess

LIBRARIES = ("base", "circuit", "mpm", "coupling")
root = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))


def objects(build):
    """Source, from the root, and object of every file of the libraries and the program whose source is still there."""
    for library in LIBRARIES:
        for folder, _, files in os.walk(os.path.join(build, library)):
            for name in files:
                source = re.sub(r"CMakeFiles/[^/]*\.dir/", "", os.path.relpath(os.path.join(folder, name), build))
                if name.endswith(".c.o") and os.path.exists(os.path.join(root, source[:-2])):
                    yield source[:-2], os.path.join(folder, name)


def symbols(build):
    """(source, letter of nm, name) of every external name: U where it is asked for, T a function, D R B data.
    Nothing where nothing is built, or there is no nm."""
    source_of = {file: source for source, file in objects(build)} if shutil.which("nm") else {}
    if not source_of:
        return
    for line in subprocess.run(["nm", "-g", "-A", *source_of], capture_output=True, text=True, check=True).stdout.splitlines():
        file, words = line[:line.index(".c.o:") + 4], line.split()
        yield source_of[file], words[-2], words[-1]


def sources(endings):
    """Paths, from the root, of the libraries' and the program's sources with these endings."""
    for library in LIBRARIES:
        for folder, _, files in os.walk(os.path.join(root, library)):
            for name in files:
                if name.endswith(endings):
                    yield os.path.relpath(os.path.join(folder, name), root)
