#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The pages of docs/guide work as they are written:   tests/guide.py BREECH

In the order of the guide's README, in one empty folder: a yaml block whose first line is `# PATH` is written there; of
the sh blocks `new`, `check`, `materials`, `flow`, `shot` are run as they stand.  Of commands that take longer the
options are looked up in their --help and the case is checked with their --set.  `# refused` behind a command: it must
end with exit code 2.  Links must lead somewhere.  Exit 77 = skipped."""
import functools
import os
import re
import shlex
import subprocess
import sys
import tempfile

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
GUIDE = os.path.join(ROOT, "docs", "guide")
AS_WRITTEN = {"new", "check", "materials", "flow", "shot"}
BY_CHECK = {"scene", "onset", "compare", "strike", "sweep", "life"}
NOT_OURS = {"git", "cd", "./demo.sh", "export", "sbatch", "paraview", "python3"}  # shown, not run
LAUNCHERS = {"mpirun", "srun"}


class Rotten(Exception):
    """A page that does not do what it says."""


def blocks(text):
    """Language and text of every fenced block."""
    return re.findall(r"^```(\w*)\n(.*?)^```$", text, flags=re.S | re.M)


def commands(text):
    """Every command of a sh block with what its comment says."""
    for line in text.replace("\\\n", " ").splitlines():
        command, _, comment = line.partition(" #")
        if command.strip() and not command.startswith("#"):
            yield command.strip(), comment.strip()


@functools.cache  # several commands check the same case
def run(words, folder):
    done = subprocess.run(words, cwd=folder, check=False, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, text=True)
    return done.returncode, done.stdout


def to_run(breech, words, folder):
    """The words that stand for a command of breech: itself, or a check of its case where it would compute scenes."""
    command = words[0]
    if command in AS_WRITTEN or command.startswith("-"):
        return [breech, *words]
    if command not in BY_CHECK:
        raise Rotten(f"nobody knows `{command}`")
    known = run((breech, "--help", command), folder)[1]
    kept, rest = [], words[2:]
    while rest:
        option = rest.pop(0)
        found = re.search(rf"^ +{re.escape(option)}(?: ([A-Z=]+))? ", known, flags=re.M)
        if not option.startswith("-") or not found:
            raise Rotten(f"breech {command} has no option {option}")
        value = [rest.pop(0)] if found.group(1) else []
        if option == "--set":
            kept += [option, *value]
    return [breech, "check", words[1], *kept]


def try_command(breech, line, comment, folder):
    words = shlex.split(line)
    if words[0] in NOT_OURS:
        return 0
    if words[0] in LAUNCHERS and "breech" in words:
        words = words[words.index("breech"):]
    if words[0] != "breech":
        raise Rotten(f"not a command of the guide: {line}")
    code, said = run(tuple(to_run(breech, words[1:], folder)), folder)
    expected = 2 if "refused" in comment else 0
    if code != expected:
        raise Rotten(f"{line}\nends with {code}, not {expected}:\n{said}")
    return 1


def try_page(breech, text, folder):
    """Number of the page's commands that were run."""
    tried = 0
    for language, block in blocks(text):
        if language == "yaml":
            place = re.match(r"# (\S+\.yaml)\b", block)
            if not place:
                continue
            path = os.path.join(folder, place.group(1))
            os.makedirs(os.path.dirname(path), exist_ok=True)
            with open(path, "w", encoding="utf-8") as file:
                file.write(block)
        elif language == "sh":
            tried += sum(try_command(breech, line, comment, folder) for line, comment in commands(block))
    return tried


def try_links(name, text):
    for link in re.findall(r"\]\(([^)#]+)[^)]*\)", text):
        if "://" not in link and not os.path.exists(os.path.join(GUIDE, link)):
            raise Rotten(f"{name}: no {link}")


def must_be_noticed(breech, page, word):
    with tempfile.TemporaryDirectory() as folder:
        try:
            try_page(breech, page, folder)
        except Rotten as rotten:
            if word in str(rotten):
                return
            sys.exit(f"a rotten page is noticed for another reason: {rotten}")
    sys.exit(f"a rotten page is not noticed: {word}")


def main():
    if len(sys.argv) != 2 or not os.access(sys.argv[1], os.X_OK):
        print("skipped: no program")
        return 77
    breech = os.path.abspath(sys.argv[1])
    case = "```yaml\n# a/case.yaml\nname: a\nbarel: {length: 1 m}\n```\n"
    must_be_noticed(breech, case + "```sh\nbreech check a\n```\n", "barel")
    must_be_noticed(breech, "```sh\nbreech onset default_shot --fast\n```\n", "--fast")
    must_be_noticed(breech, "```sh\nbreech onset default_shot --set bank.charge=9\n```\n", "bank")
    must_be_noticed(breech, "```sh\nbreech check default_shot # refused\n```\n", "ends with 0")
    with open(os.path.join(GUIDE, "README.md"), encoding="utf-8") as file:
        first = file.read()
    pages = ["README.md", *dict.fromkeys(re.findall(r"\]\(([\w-]+\.md)\)", first))]
    left = {name for name in os.listdir(GUIDE) if name.endswith(".md")} - set(pages)
    if left:
        sys.exit(f"docs/guide/README.md does not name {', '.join(sorted(left))}")
    with tempfile.TemporaryDirectory() as folder:
        for name in pages:
            with open(os.path.join(GUIDE, name), encoding="utf-8") as file:
                text = file.read()
            try:
                try_links(name, text)
                print(f"{name}: {try_page(breech, text, folder)} commands")
            except Rotten as rotten:
                sys.exit(f"{name}: {rotten}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
