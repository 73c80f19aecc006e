#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""What nobody uses: external functions, members of structs, enumerators, rows of tables.    tests/unused.py BUILD_FOLDER

1. Every external name of the libraries is used by another of their files, or by the program.
2. Every member of every struct is read somewhere.  The row of a table (.offset = ...) is no reading, nor is an
   assignment; an offset that stands elsewhere is one.  So a key of a case file or a constant of a material that
   nothing reads is found, whatever other structs have a member of that name.  A member that only a table of the
   summary reads (SUMMARY_*) must be given a value somewhere.
3. Every enumerator is named somewhere besides its declaration, and code moves energy to every place of the ledger.
How 2 knows: in a copy of the sources every member is marked as deprecated, with the struct's name in the text; clang
then says where each is used, resolved by struct.  Tests do not count as users.

What stays although nothing uses it stands in tests/unused.txt with the reason; a line there that is not needed, or has
no reason, is a fault.    Exit 77: nothing is built, or there is no nm or clang."""
import json
import os
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor

from objects import LIBRARIES, root, sources, symbols

TOGETHER = 16  # sources of one process

build = os.path.abspath(sys.argv[1])


# ---- external names ----

def functions():
    """Name -> what is wrong, of external names that no other file of the libraries or the program uses; None: nothing is
    built."""
    defined, wanted = {}, set()
    for source, letter, name in symbols(build):
        if letter == "U":
            wanted.add(name)
        elif letter in "TDRB" and "." not in name:
            defined[name] = source
    if not defined:
        return None
    defined.pop("main", None)
    return {name: f"{file}: {name} has no caller outside its file" for name, file in defined.items() if name not in wanted}


# ---- marking members ----

def blank(text):
    """The text without comments, literals and directives; every character stays where it is."""
    def spaces(match):
        return re.sub(r"[^\n]", " ", match.group())
    text = re.sub(r"/\*.*?\*/|//[^\n]*|\"(?:\\.|[^\"\\\n])*\"|'(?:\\.|[^'\\\n])*'", spaces, text, flags=re.S)
    return text, re.sub(r"^[ \t]*#(?:[^\n]*\\\n)*[^\n]*", spaces, text, flags=re.M)


def closing(code, start):
    """Place of the brace that closes the one at `start`."""
    depth = 0
    for at in range(start, len(code)):
        depth += (code[at] in "{[(") - (code[at] in "}])")
        if depth == 0:
            return at
    raise ValueError("a brace that nothing closes")


def pieces(code, start, end, separator):
    """(start, end) of the parts between separators that no bracket holds; what follows the last counts for `,`."""
    depth, begin = 0, start
    for at in range(start, end):
        depth += (code[at] in "{[(") - (code[at] in "}])")
        if depth == 0 and code[at] == separator:
            yield begin, at
            begin = at + 1
    if separator == ",":
        yield begin, end


def declared(text):
    """Name that a declarator declares; None: none."""
    pointer = re.search(r"\(\s*\*+\s*(?:const\s+)?(\w+)", text)
    if pointer:
        return pointer.group(1)
    text = re.sub(r"\[[^\]]*\]|:\s*\w+\s*$", " ", text)
    name = re.search(r"([A-Za-z_]\w*)\s*$", text)
    return name.group(1) if name else None


def mark(name):
    return f' __attribute__((deprecated("@{name}")))'


def struct_name(code, start, end, fallback):
    before = code[max(0, start - 40):start]
    tag = re.match(r"(?:struct|union)\s+(\w+)", code[start:])
    after = re.match(r"\s*(\w+)", code[end + 1:])
    if re.search(r"typedef\s*$", before) and after:
        return after.group(1)
    return tag.group(1) if tag else after.group(1) if after else fallback


def mark_members(code, start, end, struct, marks):
    for a, b in pieces(code, start, end, ";"):
        if "_Static_assert" in code[a:b]:
            continue
        brace = code.find("{", a, b)
        if brace >= 0:  # a struct inside: its members are found by themselves
            a = closing(code, brace) + 1
        for c, d in pieces(code, a, b, ","):
            name = declared(code[c:d])
            if name:
                marks.append((d, mark(f"{struct}.{name}"), f"{struct}.{name}"))


def mark_lists(text, start, end, struct, marks):
    """Members that a list makes: #define ROW(member, ...) double member;"""
    for row in re.finditer(r"^[ \t]*#define[ \t]+\w+\(([^)]*)\)[ \t]+([^\n;]*);[ \t]*$", text[start:end], flags=re.M):
        body = row.group(2).rstrip()
        name = declared(body)
        if name in [p.strip() for p in row.group(1).split(",")]:
            marks.append((start + row.start(2) + len(body), f' __attribute__((deprecated("@{struct}." #{name})))', None))


def marked(path):
    """The file's text with marks, and the members that were marked, struct.member."""
    with open(path, encoding="utf-8") as file:
        text = file.read()
    plain, code = blank(text)
    marks = []
    for match in re.finditer(r"\b(?:struct|union)\b\s*\w*\s*\{", code):
        end = closing(code, match.end() - 1)
        struct = struct_name(code, match.start(), end, os.path.basename(path))
        mark_members(code, match.end(), end, struct, marks)
        mark_lists(plain, match.end(), end, struct, marks)
    for match in re.finditer(r"^#define (\w+)[ \t]*\\\n((?:[^\n]*\\\n)*[^\n]*)", plain, flags=re.M):  # members many structs have
        if re.fullmatch(r"[\s\\]*(?:\w+\s+\w+;[\s\\]*)+", match.group(2)):
            mark_members(plain, match.start(2), match.end(), match.group(1), marks)
    names = {name for _, _, name in marks if name}
    for at, insertion, _ in sorted(marks, key=lambda m: -m[0]):
        text = text[:at] + insertion + text[at:]
    return text, names


# ---- where they are used ----

def copy_marked(scratch):
    names = set()
    for path in sources((".c", ".h", ".def")):
        to = os.path.join(scratch, path)
        os.makedirs(os.path.dirname(to), exist_ok=True)
        text, found = marked(os.path.join(root, path))
        names |= found
        with open(to, "w", encoding="utf-8") as file:
            file.write(text)
    return names


def front_end(flags, source):
    """The command of clang's own front end, which takes many sources at once, without them: starting a process for each
    would take twice as long as reading it."""
    told = subprocess.run(["clang", "-###", "-fsyntax-only", *flags, source], capture_output=True, text=True, check=True)
    words = next(shlex.split(line) for line in told.stderr.splitlines() if "-cc1" in line)
    return [word for word in words if word != source]


def commands(scratch):
    """Commands for the copy, each for sources of the same flags."""
    with open(os.path.join(build, "compile_commands.json"), encoding="utf-8") as file:
        entries = json.load(file)
    done, alike = set(), {}
    for entry in entries:
        source = os.path.relpath(entry["file"], root)
        if source.split(os.sep)[0] in LIBRARIES and source not in done:
            done.add(source)
            words = entry["command"].split()
            keep = [w.replace("-I" + root, "-I" + scratch) if w == "-I" + root else w for w in words
                    if re.match(r"-[ID]|-fopenmp|-std=|-march=", w)]
            keep += [w for i, name in enumerate(words) if name == "-isystem" for w in ("-isystem", words[i + 1])]
            flags = tuple(w.replace('\\"', '"') for w in keep)
            alike.setdefault(flags, []).append(os.path.join(scratch, source))
    warnings = ("-Wno-everything", "-Wdeprecated-declarations", "-fno-caret-diagnostics")
    for flags, files in alike.items():
        command = front_end((*warnings, *flags), files[0])
        for first in range(0, len(files), TOGETHER):
            yield command + files[first:first + TOGETHER]


LINE = re.compile(r"^(.*?):(\d+):(\d+): (?:warning: '.*' is deprecated: @(\S+)|(?:fatal )?error: (.*))")


def is_assignment(line, column, name):
    """Is the member at this column only given a value?  x->a = 1, x->a[i].b += 2, x->a++"""
    rest = line[column - 1:]
    if not rest.startswith(name):
        return False
    rest = rest[len(name):]
    while True:
        step = re.match(r"\s*\.\w+", rest)
        if step:
            rest = rest[step.end():]
        elif re.match(r"\s*\[", rest):
            try:
                rest = rest[closing(rest, rest.index("[")) + 1:]
            except ValueError:
                return False
        else:
            break
    return bool(re.match(r"\s*(?:[-+*/|&]|<<|>>)?=(?!=)|\s*(?:\+\+|--)\s*[,;)]", rest))


def uses(scratch):
    """Names that are read, names that are given values, faults of the compiler."""
    read, written, faults, lines = set(), set(), [], {}
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        results = pool.map(lambda c: subprocess.run(c, capture_output=True, text=True, check=False), commands(scratch))
    for result in results:
        for line in result.stderr.splitlines():
            at = LINE.match(line)
            if not at:
                continue
            file, row, column, name, error = at.groups()
            if error:
                faults.append(f"{file}:{row}: {error}")
                continue
            if file not in lines:
                with open(file, encoding="utf-8") as source:
                    lines[file] = source.read().split("\n")
            text = lines[file][int(row) - 1]
            assigned = is_assignment(text, int(column), name.split(".")[-1])
            (written if assigned else read).add(name)
    return read, written, faults


def texts():
    """File -> its code without comments, literals and directives, and its text without comments alone."""
    for path in sources((".c", ".h", ".def")):
        with open(os.path.join(root, path), encoding="utf-8") as file:
            text = file.read()
        yield re.sub(r"/\*.*?\*/", "", text, flags=re.S), blank(text)[1]


def summary_rows(text):
    """Members that tables of the summary show, and their counts.  A part of a part counts whatever its struct."""
    found = set()
    for row in re.finditer(r"\bSUMMARY_\w+\(\s*(\w+), (?:KEY_\w+, )?\"[^\"]*\",\s*([\w.\[\]]+)((?:,\s*\w+\b(?!\())*)", text):
        path = re.sub(r"\[.*?\]", "", row.group(2)).split(".")
        found |= {f"{row.group(1)}.{path[0]}"} | {f"*.{part}" for part in path[1:]}
        found |= {f"{row.group(1)}.{word}" for word in re.findall(r"\w+", row.group(3))}
    return found


def members():
    """Name -> what is wrong, faults of the compiler, how many members there are."""
    with tempfile.TemporaryDirectory() as scratch:
        names = copy_marked(scratch)
        read, written, faults = uses(scratch)
    shown, initialised = set(), set()
    for text, _ in texts():
        shown |= summary_rows(text)
        read |= set(".".join(row) for row in re.findall(r"(?<!= )\boffsetof\((\w+), (\w+)", text))
        initialised |= set(re.findall(r"[{,]\s*\.(\w+)(?:\[\w+\])?\s*=", text))
    wrong = {}
    for name in names:
        member = name.split(".")[1]
        if name in shown or "*." + member in shown:
            if name not in read | written and member not in initialised:
                wrong[name] = f"{name}: the summary shows it, nothing gives it a value"
        elif name not in read:
            wrong[name] = f"{name}: nothing reads this member"
    return wrong, faults, len(names)


# ---- enumerators and places of energy, by their names, which are unique ----

def enumerators():
    plain, declared_once = "", set()
    for _, code in texts():
        plain += code
        for match in re.finditer(r"\benum\b\s*\w*\s*\{", code):
            end = closing(code, match.end() - 1)
            for a, b in pieces(code, match.end(), end, ","):
                name = re.match(r"\s*([A-Z]\w*)\s*(=|$)", code[a:b])
                if name:
                    declared_once.add(name.group(1))
    macros = " ".join(line for text, _ in texts() for line in re.findall(r"^[ \t]*#(?:[^\n]*\\\n)*[^\n]*", text, flags=re.M))
    words = re.findall(r"\w+", plain) + re.findall(r"\w+", macros)
    count = {}
    for word in words:
        count[word] = count.get(word, 0) + 1
    wrong = {name: f"{name}: nothing names this enumerator" for name in declared_once if count[name] < 2}
    with open(os.path.join(root, "circuit", "ledger.def"), encoding="utf-8") as file:
        ledger = re.sub(r"/\*.*?\*/", "", file.read(), flags=re.S)
    prefix = {"SUPPLY_STORED": "STORE_", "SUPPLY_HEAT": "HEAT_", "INTEGRAL": "Y_", "GIVEN": "Y_"}
    for kind, place in re.findall(r"^(\w+)\((\w+), \w+, \w+, \"", ledger, flags=re.M):
        if prefix[kind] + place not in count:
            wrong[prefix[kind] + place] = f"circuit/ledger.def: no code moves energy to {prefix[kind]}{place}"
    return wrong


# ---- the verdict ----

def allowed():
    """Name -> reason, of tests/unused.txt: `name  reason`."""
    with open(os.path.join(root, "tests", "unused.txt"), encoding="utf-8") as text:
        lines = [line.split(None, 1) for line in text if line.strip() and not line.startswith("#")]
    return {line[0]: line[1].strip() if len(line) == 2 else "" for line in lines}


external = functions()
if external is None or not shutil.which("clang"):
    print("skipped: nothing is built, or there is no nm or clang")
    sys.exit(77)
unread, broken, count = members()
idle = {**external, **unread, **enumerators()}
reasons = allowed()
faults = sorted(text for name, text in idle.items() if name not in reasons) + broken
faults += [f"tests/unused.txt: {name} has no reason" for name, reason in reasons.items() if not reason]
faults += [f"tests/unused.txt: {name} is used, or is no longer there" for name in reasons if name not in idle]
print("\n".join(faults) if faults else f"everything is used: external names, {count} members, enumerators")
sys.exit(1 if faults else 0)
