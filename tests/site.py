#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The site of a small tree, and with BREECH_FULL=1 of the whole: every link of a page leads to a file and a name there,
equations and keys are found.   tests/site.py    Exit 77: no pandoc."""
import html
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import urllib.parse

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
SHARP = "\x23"
SMALL = {
    "README.md": "@ One: `two`\n\n[a page](docs/theory/law.md@the-law), [a case](cases/ball), [text](cases/ball/case.yaml)\n",
    "cases/ball/README.md": "@ Ball\n\n[keys](../../docs/reference/keys.md)\n", "cases/ball/case.yaml": "name: ball\n",
    "docs/theory/law.md": "@ A law\n\n@@ The law\n\n```math\n\\sigma = E\\,e^{2} \\tag{M-1}\n```\n\nwith $e$ a strain.\n<!-- figures: x -->\n",
    "docs/reference/keys.md": "@ Keys\n\n@@ `bank`\n\n| key | unit |\n|---|---|\n| `charge` | V |\n"}


def pages_of(out):
    for folder, folders, files in os.walk(out):
        folders[:] = [name for name in folders if name != "api"]  # Doxygen's own
        yield from (os.path.join(folder, name) for name in files if name.endswith(".html"))


def faults_of(out):
    texts = {page: open(page, encoding="utf-8").read() for page in pages_of(out)}
    names = {page: set(re.findall(r'\bid="([^"]*)"', text)) for page, text in texts.items()}
    faults = []
    for page, text in texts.items():
        for link in re.findall(r'\b(?:href|src)="([^"]*)"', text):
            path, _, anchor = urllib.parse.unquote(html.unescape(link)).partition("#")
            if re.match(r"[a-z]+:", path):
                continue
            target = os.path.normpath(os.path.join(os.path.dirname(page), path)) if path else page
            if not os.path.isfile(target) or anchor and anchor not in names.get(target, {anchor}):
                faults.append(f"{os.path.relpath(page, out)}: {link} leads nowhere")
    return faults, len(texts)


def make(tree, out):
    done = subprocess.run([sys.executable, os.path.join(ROOT, "docs", "site", "site.py"), out, "--tree", tree],
                          capture_output=True, text=True, check=False)
    if done.returncode:
        sys.exit(done.stdout + done.stderr)
    faults, count = faults_of(out)
    if faults:
        sys.exit("links of the site:\n  " + "\n  ".join(faults[:50]))
    print(f"{count} pages of {tree}")


def found(out, words):
    """Places that the search field would offer for the words."""
    with open(os.path.join(out, "find.js"), encoding="utf-8") as file:
        entries = json.loads(file.read().partition("= ")[2].rstrip(";\n"))
    return [place for text, _, place in entries if all(word in text for word in words.split())]


def try_small(folder):
    tree, out = os.path.join(folder, "tree"), os.path.join(folder, "out")
    for name, text in SMALL.items():
        os.makedirs(os.path.dirname(os.path.join(tree, name)), exist_ok=True)
        with open(os.path.join(tree, name), "w", encoding="utf-8") as file:
            file.write(text.replace("@", SHARP))
    make(tree, out)
    with open(os.path.join(out, "docs/theory/law.html"), encoding="utf-8") as file:
        law = file.read()
    assert '<div class="equation" id="M-1">' in law and law.count("<math") == 2 and "figures:" not in law, law
    assert [place.split(SHARP) for place in found(out, "(M-1)") + found(out, "charge bank")] == [
        ["docs/theory/law.html", "M-1"], ["docs/reference/keys.html", "bank"]]
    os.remove(os.path.join(out, "cases/ball/case.yaml.html"))
    assert faults_of(out)[0], "a link that leads nowhere is not noticed"


def main():
    if not shutil.which("pandoc"):
        print("skipped: no pandoc")
        return 77
    with tempfile.TemporaryDirectory() as folder:
        try_small(folder)
        if os.environ.get("BREECH_FULL") == "1":
            make(ROOT, os.path.join(folder, "whole"))
    return 0


if __name__ == "__main__":
    sys.exit(main())
