#!/usr/bin/env python3
"""What nobody uses: external functions, members of structs, rows of tables.    tests/unused.py BUILD_FOLDER

1. Every external name of the libraries is used by another of their files, or by the program.  What only tests or users
   of a library call is listed in tests/unused.txt with the reason.
2. Every member of every struct is named somewhere outside its declaration, as .member or ->member.
3. Every key of a case file (docs/case-files.md lists them, a test keeps it so) is read outside its table.
Exit 77: nothing is built, or no nm."""
import os
import re
import shutil
import subprocess
import sys

LIBRARIES = ("base", "circuit", "mpm", "coupling")
build = sys.argv[1]
root = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))


def sources():
    for library in LIBRARIES:
        for folder, _, files in os.walk(os.path.join(root, library)):
            for name in files:
                if name.endswith((".c", ".h", ".def")):
                    yield os.path.join(folder, name)


def without_comments(text):
    return re.sub(r"/\*.*?\*/", lambda m: "\n" * m.group().count("\n"), text, flags=re.S)


def objects():
    for library in LIBRARIES:
        for folder, _, files in os.walk(os.path.join(build, library)):
            for name in files:
                source = re.sub(r"CMakeFiles/[^/]*\.dir/", "", os.path.relpath(os.path.join(folder, name), build))
                if name.endswith(".c.o") and os.path.exists(os.path.join(root, source[:-2])):
                    yield source[:-2], os.path.join(folder, name)


def symbols():
    """Names defined and names wanted, over the files of the libraries and the program."""
    defined, wanted = {}, set()
    for source, file in objects():
        for line in subprocess.run(["nm", "-g", file], capture_output=True, text=True, check=True).stdout.splitlines():
            words = line.split()
            if words[-2] == "U":
                wanted.add(words[-1])
            elif words[-2] in "TDRB" and "." not in words[-1]:
                defined[words[-1]] = source
    defined.pop("main", None)
    return defined, wanted


def allowed():
    """Name -> reason, of tests/unused.txt: `name  reason`."""
    with open(os.path.join(root, "tests", "unused.txt")) as text:
        lines = [line.split(None, 1) for line in text if line.strip() and not line.startswith("#")]
    return {name: reason for name, reason in (line if len(line) == 2 else (line[0], "") for line in lines)}


def functions():
    defined, wanted = symbols()
    reasons = allowed()
    idle = {name for name in defined if name not in wanted}
    wrong = [f"{defined[name]}: {name} has no caller outside its file" for name in sorted(idle - reasons.keys())]
    return wrong + [f"tests/unused.txt: {name} has no reason" for name in reasons if not reasons[name].strip()]


def members(texts):
    """Members declared in structs: (file, name)."""
    for file, text in texts.items():
        depth = 0
        for line in text.splitlines():
            code = line.split("//")[0]
            if depth == 0 and not re.match(r"\s*(typedef\s+)?(struct|union)\b[^;()]*\{", code):
                continue
            if depth > 0:
                at = re.match(r"\s*(?:const\s+|unsigned\s+|struct\s+|volatile\s+)*[A-Za-z_]\w*(?:\s*\*(?:const)?)*\s+(.*);", code)
                for one in at.group(1).split(",") if at and "(" not in code and "\\" not in code else []:
                    name = re.match(r"\s*(?:\*\s*(?:const\s+)?)*([A-Za-z_]\w*)", one)
                    if name:
                        yield os.path.relpath(file, root), name.group(1)
            depth += code.count("{") - code.count("}")


def unnamed(texts):
    named = set(re.findall(r"(?:\.|->)\s*([A-Za-z_]\w*)", "\n".join(texts.values())))
    named |= set(re.findall(r"\b([A-Za-z_]\w*)\b", "\n".join(re.findall(r"offsetof\(([^;]*?)\)", "\n".join(texts.values())))))
    return [f"{file}: member {name} is never used" for file, name in members(texts) if name not in named]


def keys(texts):
    """Keys of the manual that no file names as a member, a text, an offset or a value of a treatment: the row of the
    table, MACRO(type, key, ...), is no such use."""
    with open(os.path.join(root, "docs", "case-files.md")) as manual:
        known = set(re.findall(r"^\| `(\w+)` \|", manual.read(), flags=re.M))
    text = "\n".join(texts.values())
    used = set(re.findall(r"(?:\.|->)\s*([A-Za-z_]\w*)", text)) | set(re.findall(r"\"(\w+)\"", text))
    used |= set(re.findall(r"offsetof\(\w+, (\w+)\)", text))
    used |= {name.lower() for name in re.findall(r"value\[([A-Z_]+)\]", text)}
    return [f"docs/case-files.md: nothing reads the key {key}" for key in sorted(known - used - allowed().keys())]


if not shutil.which("nm") or not any(True for _ in objects()):
    print("skipped: nothing is built, or there is no nm")
    sys.exit(77)
code = {}
for path in sources():
    with open(path, encoding="utf-8") as source_text:
        code[path] = without_comments(source_text.read())
faults = functions() + unnamed(code) + keys(code)
print("\n".join(faults) if faults else "everything is used")
sys.exit(1 if faults else 0)
