#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Equations and sources of docs/theory hold together:   tests/theory.py [--write]

  - a tag stands once, and behind its equation a line `**C-1** · `function` in `file` · source`; the file is there and
    holds the function; a source that is a link stands in the bibliography
  - a tag that code, tests or pages name, as (C-1), has an equation
  - a law of mpm/law with constants of its own has an equation, or names that which they stand in
  - an entry of the bibliography has its own name as anchor and is cited by a page
  - the table of equations in docs/theory/README.md is the one that --write writes, and drawings are as
    docs/site/figures.py draws them"""
import os
import re
import subprocess
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
THEORY = os.path.join(ROOT, "docs", "theory")
TAG = re.compile(r"\\tag\{([A-Z]-\d+)\}")
NAMED = re.compile(r"\(([A-Z]-\d+)\)")
BEGIN, END = "<!-- equations -->\n", "<!-- end -->\n"


def read(*parts):
    with open(os.path.join(ROOT, *parts), encoding="utf-8") as file:
        return file.read()


def slug(heading):
    return re.sub(r"[^\w\- ]", "", heading.strip().lower()).replace(" ", "-")


def equations_of(page, text):
    """Tag, section and the line behind it, of every equation of a page."""
    found, section, waiting = [], "", []
    for line in text.splitlines():
        heading = re.match(r"##+ +(.*)", line)
        section = heading.group(1) if heading else section
        waiting += [(tag, page, section) for tag in TAG.findall(line)]
        behind = re.match(r"\*\*([A-Z]-\d+)\*\* · (.*)", line)
        if behind:
            found += [(*one, behind.group(2)) for one in waiting if one[0] == behind.group(1)]
            waiting = [one for one in waiting if one[0] != behind.group(1)]
    return found, [f"{page}: no line **{one[0]}** · .. behind its equation" for one in waiting]


def faults_of_line(tag, page, line):
    """What is wrong with the line that says what computes an equation and where it is from."""
    faults, parts = [], line.split(" · ")
    files = re.findall(r"`([\w/]+\.(?:c|h|def))`", line)
    if not files or len(parts) != 2 or not parts[1].strip():
        faults.append(f"{page}: {tag}: say `function` in `file` · source")
    for file in files:
        if not os.path.isfile(os.path.join(ROOT, file)):
            faults.append(f"{page}: {tag}: no {file}")
            continue
        text = read(file)
        named = re.search(r"((?:`\w+`(?:, )?)+) in `" + re.escape(file) + "`", line)
        faults += [f"{page}: {tag}: no {name} in {file}" for name in re.findall(r"`(\w+)`", named.group(1) if named else "")
                   if not re.search(rf"\b{name}\b", text)]
    return faults


def faults_of_sources(pages):
    bibliography = pages["bibliography.md"]
    entries = re.findall(r'<a id="([^"]*)"></a>\*\*([^*]*)\*\*', bibliography)
    cited = {key for name, text in pages.items() for key in re.findall(r"\]\((?:\.\./theory/)?bibliography\.md#(\w+)\)", text)}
    faults = [f"bibliography.md: {anchor} is not {name}" for anchor, name in entries if anchor != name]
    names = {name for _, name in entries}
    faults += [f"no {key} in the bibliography" for key in sorted(cited - names)]
    return faults + [f"no page cites {key}" for key in sorted(names - cited)]


def faults_of_laws(laws, lines):
    """laws: of each file its text; lines: all those behind equations."""
    constants = re.compile(r"^(?:CONSTANT|CONTACT_VALUE)\(", flags=re.M)
    return [f"{name}: its constants have no equation in docs/theory" for name, text in sorted(laws.items())
            if constants.search(text) and not NAMED.search(text) and not any(f"`{name}`" in line for line in lines)]


def law_files():
    folder = os.path.join(ROOT, "mpm", "law")
    kinds = [name[:-4] + "_" for name in os.listdir(folder) if name.endswith(".def")]
    return {f"mpm/law/{name}": read("mpm", "law", name) for name in os.listdir(folder) if name.startswith(tuple(kinds))}


def table(equations):
    lines = ["| tag | equation | computed by |", "|---|---|---|"]
    for tag, page, section, line in sorted(equations, key=lambda one: (one[0][0], int(one[0][2:]))):
        section = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", section)
        lines.append(f"| {tag} | [{section}]({page}#{slug(section)}) | {line.split(' · ')[0]} |")
    return "\n".join(lines) + "\n"


def named_in_code():
    listed = subprocess.run(["git", "ls-files", "*.c", "*.h", "*.def", "*.md"], cwd=ROOT, check=False, capture_output=True, text=True)
    for name in listed.stdout.split():
        if os.path.isfile(os.path.join(ROOT, name)):
            yield from ((name, tag) for tag in NAMED.findall(read(name)))


def faults_of_drawings():
    sys.path.insert(0, os.path.join(ROOT, "docs", "site"))
    sys.dont_write_bytecode = True
    import figures
    return [f"docs/figures/{name}.svg is not as docs/site/figures.py draws it" for name, draw in figures.FIGURES.items()
            if draw() != read("docs", "figures", name + ".svg")]


def try_itself():
    text = "\x23\x23 Law\n\n```math\na = b \\tag{X-1}\n```\n\n**X-1** · `law_step` in `mpm/law/nothing.h` · own\n```math\nc \\tag{X-2}\n```\n"
    found, faults = equations_of("p.md", text)
    assert [one[0] for one in found] == ["X-1"] and len(faults) == 1 and "X-2" in faults[0]
    assert "nothing.h" in faults_of_line("X-1", "p.md", found[0][3])[0]
    assert "nothing_of" in faults_of_line("X-1", "p.md", "`nothing_of` in `mpm/law/law.h` · own")[0]
    assert faults_of_line("X-1", "p.md", "`mpm/law/law.h`")
    with_constants = {"mpm/law/eos_x.h": 'CONSTANT(x, "1")\n'}
    assert faults_of_laws(with_constants, ["`f` in `mpm/law/eos_y.h` · own"])
    assert not faults_of_laws(with_constants, ["`f` in `mpm/law/eos_x.h` · own"])
    assert faults_of_sources({"bibliography.md": '<a id="a1"></a>**a1**: A', "p.md": "[b2](bibliography.md#b2)"}) == [
        "no b2 in the bibliography", "no page cites a1"]


def main():
    try_itself()
    pages = {name: read("docs", "theory", name) for name in sorted(os.listdir(THEORY)) if name.endswith(".md")}
    pages.update({os.path.join(folder, name): read("docs", folder, name) for folder in ("validation", "notes")
                  for name in sorted(os.listdir(os.path.join(ROOT, "docs", folder))) if name.endswith(".md")})
    equations, faults = [], []
    for page, text in pages.items():
        found, missing = equations_of(page, text)
        equations += found
        faults += missing
    tags = [one[0] for one in equations]
    faults += [f"{tag} stands twice" for tag in sorted({tag for tag in tags if tags.count(tag) > 1})]
    for tag, page, _, line in equations:
        faults += faults_of_line(tag, page, line)
    faults += sorted({f"{name}: ({tag}) has no equation in docs/theory" for name, tag in named_in_code() if tag not in tags})
    laws = law_files()
    assert len(laws) > 15, laws
    faults += faults_of_laws(laws, [one[3] for one in equations])
    faults += faults_of_sources(pages) + faults_of_drawings()
    before, begin, rest = pages["README.md"].partition(BEGIN)
    wanted = before + begin + "\n" + table(equations) + "\n" + END + rest.partition(END)[2]
    if "--write" in sys.argv:
        with open(os.path.join(THEORY, "README.md"), "w", encoding="utf-8") as file:
            file.write(wanted)
    elif wanted != pages["README.md"]:
        faults.append("docs/theory/README.md: its table of equations is not that of the pages: tests/theory.py --write")
    print(f"{len(tags)} equations")
    if faults:
        sys.exit("\n".join(faults))


if __name__ == "__main__":
    main()
