#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Files that comments, docs and scripts name are in the repository: paths (circuit/shot.h), file names alone (onset.md) and
tests (test_case).  <name>, NAME and * stand for any letters.    Exit 77: no git, so no list of files."""
import fnmatch
import os
import re
import subprocess
import sys

root = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
FOLDERS = "base|circuit|mpm|coupling|tests|docs|cases|cmake|python|examples|packaging"
PATH = re.compile(rf"(?<![\w/.$}}-])((?:{FOLDERS})/[\w<>*./-]*[\w*>]\.[a-z]{{1,5}})\b")
ALONE = re.compile(r"(?<![\w/.$}\"'>*-])([a-z][a-z0-9_]*\.(?:c|h|def|md|cmake))\b(?!\()")
TEST = re.compile(r"(?<![\w/])(test_[a-z]\w*)(?![\w(.<*])")
# What a build or a run makes, and other projects' files.
MADE = {"coupling/solver_id.h", "solver_id.h", "version.h", "setjmp.h", "stdarg.h", "cmocka.h", "cmath.h"}


def tracked():
    done = subprocess.run(["git", "ls-files", "--cached", "--others", "--exclude-standard"], cwd=root, check=False,
                          capture_output=True, text=True)
    return [name for name in done.stdout.splitlines() if os.path.isfile(os.path.join(root, name))]


def prose(name, text):
    """The text with everything blanked that is no comment; all of a page."""
    if name.endswith((".md", ".txt")) and not name.endswith("CMakeLists.txt"):
        return text
    if name.endswith((".c", ".h", ".def")):
        blank = re.sub(r"[^\n]", " ", text)
        for comment in re.finditer(r"/\*.*?\*/", text, flags=re.S):
            blank = blank[:comment.start()] + comment.group() + blank[comment.end():]
        return blank
    return "\n".join(line[line.find("#"):] if "#" in line else "" for line in text.splitlines())


def missing(reference, here, files, names):
    if reference in MADE:
        return False
    pattern = re.sub(r"<\w+>|\b[A-Z]{4,}\b", "*", reference)
    if "/" not in reference:
        return not fnmatch.filter(names, pattern)
    return not fnmatch.filter(files, pattern) and os.path.normpath(os.path.join(os.path.dirname(here), pattern)) not in files


files = tracked()
if not files:
    print("skipped: no git")
    sys.exit(77)
names = {os.path.basename(name) for name in files}
tests = {os.path.splitext(name)[0] for name in names}
for name in files:
    if re.match(r"tests/.*\.c$", name):  # functions that a test program runs
        with open(os.path.join(root, name), encoding="utf-8") as source:
            tests |= set(re.findall(r"^static void (test_\w+)\(", source.read(), flags=re.M))
faults = []
for name in files:
    if name.startswith(("tests/fuzz/seeds/", "tests/mutants/", "docs/notes/")) or not re.search(
            r"\.(c|h|def|md|sh|py|cmake|yaml|txt)$", name):
        continue
    with open(os.path.join(root, name), encoding="utf-8") as source:
        for number, line in enumerate(prose(name, source.read()).splitlines(), 1):
            for reference in PATH.findall(line) + ALONE.findall(line):
                if missing(reference, name, files, names):
                    faults.append(f"{name}:{number}: {reference} is not in the repository")
            faults += [f"{name}:{number}: there is no {test}" for test in TEST.findall(line) if test not in tests]
print("\n".join(faults) if faults else "every file that is named is there")
sys.exit(1 if faults else 0)
