#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Links of all pages lead somewhere:   tests/links.py [ROOT]

Every relative link and picture of a markdown file names a file or folder under ROOT (default: the tree), and what
stands behind `#` is a heading of that page, as GitHub and the site name it.  A page under docs or cases that nothing links to is a fault too."""
import os
import re
import sys
import tempfile

TREE = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
LINK = re.compile(r"\]\(<?([^)\s>]+)>?(?: \"[^\"]*\")?\)")
SKIPPED = {".git", "build", "out", "third_party"}


def pages_of(root):
    """Every markdown file under the root; of folders that a link has brought in only once."""
    for folder, folders, files in os.walk(root):
        folders[:] = [name for name in folders if name not in SKIPPED]
        yield from (os.path.join(folder, name) for name in files if name.endswith(".md"))


def without_code(text):
    """The text with fenced blocks and code in a line blanked, so that only prose is read."""
    text = re.sub(r"^( *)(```+|~~~+).*?^ *\2 *$", "", text, flags=re.S | re.M)
    text = re.sub(r"<!--.*?-->", "", text, flags=re.S)
    return re.sub(r"(`+)(?!`).*?(?<!`)\1(?!`)", lambda code: re.sub(r"[\[\](]", " ", code.group()), text)


def slug(heading):
    """Name of a heading as GitHub makes it: lower case, no punctuation, hyphens for blanks."""
    heading = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).replace("`", "").replace("*", "")
    return re.sub(r"[^\w\- ]", "", heading.strip().lower()).replace(" ", "-")


def anchors(text):
    """Names that a link to the page may end with."""
    found, count = set(), {}
    for heading in re.findall(r"^#{1,6} +(.*?)(?: #+)? *$", re.sub(r"^( *)```.*?^ *```", "", text, flags=re.S | re.M), flags=re.M):
        name = slug(heading)
        found.add(name if name not in count else f"{name}-{count[name]}")
        count[name] = count.get(name, 0) + 1
    return found | set(re.findall(r"<a (?:id|name)=\"([^\"]+)\"", text))


def faults_of(root):
    texts = {}
    for page in pages_of(root):
        with open(page, encoding="utf-8") as file:
            texts[os.path.realpath(page)] = file.read()
    names = {page: anchors(text) for page, text in texts.items()}
    faults, reached = [], {os.path.realpath(os.path.join(root, "README.md"))}
    for page, text in sorted(texts.items()):
        for link in LINK.findall(without_code(text)):
            if re.match(r"[a-z]+:", link):
                continue
            path, _, anchor = link.partition("#")
            target = os.path.realpath(os.path.join(os.path.dirname(page), path)) if path else page
            where = os.path.relpath(page, root)
            if not os.path.exists(target):
                faults.append(f"{where}: no {link}")
            elif anchor and anchor not in names.get(target, set()):
                faults.append(f"{where}: {link}: no such heading there")
            if target != page:
                reached.add(target)
    known = tuple(os.path.join(os.path.realpath(root), folder) + os.sep for folder in ("docs", "cases"))
    faults += [f"{os.path.relpath(page, root)}: no page links to it" for page in sorted(texts)
               if page.startswith(known) and page not in reached]
    return faults, len(texts)


def try_itself():
    """What is wrong is noticed, what is right is not."""
    text = "# A b: `c`\n## A b c\n## A b: c\n```\n# no\n[x](y)\n```\n`[x](y)` <!-- [x](z) -->\n"
    assert anchors(text) == {"a-b-c", "a-b-c-1", "a-b-c-2"}, anchors(text)
    assert not LINK.findall(without_code(text))
    with tempfile.TemporaryDirectory() as root:
        os.makedirs(os.path.join(root, "docs"))
        os.makedirs(os.path.join(root, "cases", "e"))
        for name, page in (("README.md", "@ One\n[a](docs/b.md@two) [a](docs/b.md@three) [c](docs/c.md)\n"),
                           ("docs/b.md", "@ Two\n[one](../README.md@one)\n"), ("docs/d.md", "@ Four\n"), ("cases/e/README.md", "@ Five\n")):
            with open(os.path.join(root, name), "w", encoding="utf-8") as file:
                file.write(page.replace("@", "\x23"))
        said = " ".join(faults_of(root)[0])
        assert all(word in said for word in ("b.md\x23three", "no docs/c.md", "d.md: no page", "e/README.md: no page")) and "two" not in said, said
    assert LINK.findall("[a](b.md) ![p](f/g.svg) [`d`](e.md)") == ["b.md", "f/g.svg", "e.md"]


def main():
    try_itself()
    root = os.path.realpath(sys.argv[1]) if len(sys.argv) > 1 else TREE
    faults, count = faults_of(root)
    print(f"{count} pages")
    if faults:
        sys.exit("links that lead nowhere:\n  " + "\n  ".join(faults))


if __name__ == "__main__":
    main()
