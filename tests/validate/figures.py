#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Figures about a case in README.md, docs/ and cases/, against runs of the commands that stand beside them.

  figures.py BREECH OUT [PAGE ...]   runs each command once and compares; exit 1 with a list of what differs
  figures.py --text [PAGE ...]       runs nothing: is every figure of a list in the prose before it?
  figures.py BREECH --try [PAGE ...] begins each command and stops it at once: is it still taken?
  --threads N                        of each run; --only TEXT: commands that contain it; --part K/N: every Nth of
                                     them, from the Kth on (K = 0 .. N - 1)

Behind the paragraph or table that states figures stands a comment: the command, then a list as in expected.yaml
(docs/reference/output.md, "What a case expects").  PAGE: README.md, docs/theory/onset.md ..; default all.

  <!-- figures: breech onset cases/default_shot
  - {key: threshold_velocity, value: 697 m/s, within: 5 %}
  - {key: verdict, is: gouges}
  -->

The number of every `value` must stand in the text between the heading, or the comment, before and this one.  OUT keeps
the runs, as for tables.py."""
import glob
import hashlib
import os
import re
import shlex
import subprocess
import sys
import tempfile

from runs import ROOT, Runs

COMMENT = re.compile(r"<!-- figures: (?P<command>breech [^\n]*(?:\\\n[^\n]*)*)\n(?P<list>.*?)-->", flags=re.S)
VALUE = re.compile(r"\bvalue: *['\"]?(-?[\d.]+)")  # without its power of ten: 216e6 is 216 M in a text
LONGEST = 200  # name of a run: a file system takes 255, its files have endings
ENTRY = re.compile(r"^- \{.*\}$")


class Claim:
    """One comment: page, line, the words of its command, the list, and the text before it."""

    def __init__(self, page, line, command, entries, before):
        self.page, self.line, self.entries, self.before = page, line, entries, before
        self.words = shlex.split(command.replace("\\\n", " "))[1:]

    def command(self):
        return "breech " + " ".join(self.words)

    def where(self):
        return "%s:%d" % (self.page, self.line)

    def unsaid(self):
        """Values of the list that the text before does not state, and lines that are no entries."""
        faults = ["%s: no entry of a list: %s" % (self.where(), entry)
                  for entry in self.entries if not ENTRY.match(entry)]
        for entry in self.entries:
            for number in VALUE.findall(entry):
                if not re.search(r"(?<![\d.])%s(?!\d|\.\d)" % re.escape(number), self.before):
                    faults.append("%s: %s of the list is not in the text before it" % (self.where(), number))
        return faults


def claims_of(page):
    with open(os.path.join(ROOT, page), encoding="utf-8") as file:
        text = file.read()
    found, begin, end = [], 0, 0
    for comment in COMMENT.finditer(text):
        if text[end:comment.start()].strip():  # else two comments belong to one text
            headings = [h.start() for h in re.finditer(r"^#+ ", text[:comment.start()], flags=re.M)]
            begin = max([end, *headings])
        entries = [line for line in comment["list"].splitlines() if line.strip()]
        found.append(Claim(page, text.count("\n", 0, comment.start()) + 1, comment["command"], entries,
                           text[begin:comment.start()]))
        end = comment.end()
    if text.count("<!-- figures:") != len(found):
        sys.exit("%s: a comment `figures:` that is none: give a command `breech ..` and a list" % page)
    return found


def all_pages():
    pages = [page for folder in ("docs", "cases")
             for page in glob.glob(folder + "/**/*.md", root_dir=ROOT, recursive=True)]
    return sorted(["README.md"] + pages)


def folder_of(words):
    """Name of a command's run: its words without what a file name cannot hold; of a long one the first, and a number."""
    name = "figures_" + re.sub(r"[^\w.=-]+", "_", "_".join(words))
    return name if len(name) <= LONGEST else name[:LONGEST - 9] + "-" + hashlib.sha256(name.encode()).hexdigest()[:8]


def case_of(words):
    return next(word for word in words[1:] if not word.startswith("-"))


def compare(runs, claim):
    """What of a claim does not hold, as `breech check --expect` says it of the run."""
    name = folder_of(claim.words)
    try:
        run, _ = runs.run(name, claim.words)
    except SystemExit as failed: # the others are compared all the same
        return ["%s: %s" % (claim.where(), failed)]
    case = os.path.join(ROOT, case_of(claim.words))
    lists = os.path.join(runs.out, name + ".claim")
    os.makedirs(lists, exist_ok=True)
    with open(os.path.join(lists, "case.yaml"), "w", encoding="utf-8") as file:
        file.write("base: %s\n" % case)
    with open(os.path.join(lists, "expected.yaml"), "w", encoding="utf-8") as file:
        file.write("\n".join(claim.entries) + "\n")
    told = subprocess.run([runs.breech, "check", lists, "--expect", run], capture_output=True, text=True, check=False)
    if told.returncode == 0:
        return []
    lines = [line for line in told.stdout.splitlines() if line.endswith("FAILS")] or [told.stdout + told.stderr]
    return ["%s: %s: %s" % (claim.where(), claim.command(), line) for line in lines]


STOPPED = 75  # exit code of a run that --max-walltime has stopped


def refused(breech, claim):
    """What the program says against a claim's command, as it stands."""
    with tempfile.TemporaryDirectory() as out:
        command = [breech, *claim.words, "-o", os.path.join(out, "run"), "--max-walltime", "0.01", "--no-store", "--quiet"]
        told = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    if told.returncode in (0, STOPPED):
        return []
    return ["%s: %s: %s" % (claim.where(), claim.command(), told.stderr.strip())]


def once(claims):
    """The first claim of each command."""
    return list({claim.command(): claim for claim in reversed(claims)}.values())


def part_of(claims, part):
    """Those of every Nth command, from the Kth on, for the text K/N."""
    k, n = (int(number) for number in part.split("/"))
    commands = sorted({claim.command() for claim in claims})[k::n]
    return [claim for claim in claims if claim.command() in commands]


def taken(words, option):
    """Value of an option, taken out of the words; None: not given."""
    if option not in words:
        return None
    at = words.index(option)
    value = words[at + 1]
    del words[at:at + 2]
    return value


def main():
    words = sys.argv[1:]
    threads, only = int(taken(words, "--threads") or 0), taken(words, "--only") or ""
    part = taken(words, "--part") or "0/1"
    text_alone, tries = "--text" in words, "--try" in words
    words = [word for word in words if word not in ("--text", "--try")]
    others = 0 if text_alone else 1 if tries else 2  # words before the pages
    if len(words) < others:
        sys.exit(__doc__)
    claims = [claim for page in (words[others:] or all_pages()) for claim in claims_of(page) if only in claim.command()]
    claims = part_of(claims, part)
    faults = [fault for claim in claims for fault in claim.unsaid()]
    if tries:
        faults += [fault for claim in once(claims) for fault in refused(os.path.realpath(words[0]), claim)]
    elif not text_alone:
        runs = Runs(words[0], words[1], threads)
        faults += [fault for claim in claims for fault in compare(runs, claim)]
    print("%d figures of %d commands" % (sum(len(claim.entries) for claim in claims),
                                         len({claim.command() for claim in claims})))
    if faults:
        sys.exit("figures that do not hold:\n  " + "\n  ".join(faults))


if __name__ == "__main__":
    main()
