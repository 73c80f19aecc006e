#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The pages of the tree as a site:   site.py OUT [--tree DIR] [--pandoc PROGRAM]

Every page (README.md, docs/, the cases' README.md) becomes a page of HTML in OUT, at its own place; start at
OUT/index.html.  Links between pages go to the pages of HTML; a file of the tree that a page names is shown as a page
too.  Mathematics becomes MathML, so that nothing is fetched from anywhere.  OUT/find.js lists headings, equations and
keys for the search field.  Needs pandoc (Debian: pandoc, and fonts-dejavu-extra for the looks of mathematics)."""
import argparse
import html
import json
import os
import re
import shutil
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor

HERE = os.path.dirname(os.path.abspath(__file__))
FOLDERS = (("guide", "Guide"), ("theory", "Theory"), ("reference", "Reference"), ("validation", "Validation"), ("notes", "Notes"))
# Fonts with a table for mathematics, without which subscripts are not lowered (Debian: fonts-dejavu-extra has the first).
MATH_FONTS = ("DejaVuMathTeXGyre.ttf", "STIXTwoMath-Regular.otf", "latinmodern-math.otf")
SOURCES = {".c": "c", ".h": "c", ".def": "c", ".py": "python", ".sh": "bash", ".yaml": "yaml", ".csv": "text", ".cff": "yaml"}
TEMPLATE = """<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>{title} · Breech</title>
<link rel="stylesheet" href="{up}style.css">
</head>
<body>
<header>
<a class="name" href="{up}index.html">Breech</a>
<input id="find" type="search" placeholder="equation, key, case, word" aria-label="find" data-up="{up}">
<ol id="found"></ol>
</header>
<div class="columns">
<nav><details open><summary>Pages</summary>
{nav}
</details></nav>
<main>
{toc}{body}
</main>
</div>
<script>if (innerWidth < 900) document.querySelector("nav details").open = false;</script>
<script src="{up}find.js"></script>
<script src="{up}site.js"></script>
</body>
</html>
"""


def read(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


def write(path, text):
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)


def all_pages(tree):
    """Paths of the pages under the tree."""
    found = [name for name in ("README.md", "CONTRIBUTING.md", "CHANGELOG.md") if os.path.exists(os.path.join(tree, name))]
    for top in ("docs", "cases"):
        for folder, folders, files in os.walk(os.path.join(tree, top)):
            folders.sort()
            found += [os.path.relpath(os.path.join(folder, name), tree) for name in sorted(files) if name.endswith(".md")]
    return found


def title_of(text):
    heading = re.search(r"^# +(.*)$", text, flags=re.M)
    return re.sub(r"[`*]", "", heading.group(1)) if heading else "Breech"


def in_order(tree, folder, pages):
    """The folder's pages as its README names them."""
    here = [page for page in pages if os.path.dirname(page) == folder]
    first = os.path.join(folder, "README.md")
    named = re.findall(r"\]\(([\w-]+\.md)\)", read(os.path.join(tree, first))) if first in here else []
    order = {os.path.join(folder, name): number for number, name in reversed(list(enumerate(named)))}
    return sorted(here, key=lambda page: (page != first, order.get(page, 999), page))


def html_name(page):
    return re.sub(r"\.md$", ".html", page)


# ---- markdown that pandoc does not know ----

def equation(found):
    """A block ```math with its tag becomes a display with the tag at its side and an anchor."""
    text, tag = found.group(1), re.search(r"\\tag\{([^}]*)\}", found.group(1))
    text = re.sub(r"\\tag\{[^}]*\}", "", text).strip()
    name = f' id="{tag.group(1)}"' if tag else ""
    side = f'<a class="tag" href="#{tag.group(1)}">({tag.group(1)})</a>' if tag else ""
    return f'<div class="equation"{name}>\n\n$${text}$$\n\n{side}\n</div>\n'


def prepared(text):
    text = re.sub(r"<!--.*?-->\n?", "", text, flags=re.S)
    return re.sub(r"^```math\n(.*?)^```$", equation, text, flags=re.S | re.M)


# ---- a page ----

class Site:
    def __init__(self, tree, out, pandoc):
        self.tree, self.out, self.pandoc = tree, out, pandoc
        self.pages = all_pages(tree)
        self.titles = {page: title_of(read(os.path.join(tree, page))) for page in self.pages}
        self.named = set()  # files of the tree that a page names

    def as_html(self, text, *options):
        done = subprocess.run([self.pandoc, "-f", "gfm+tex_math_dollars", "-t", "html5", "--mathml", "--wrap=none", *options],
                              input=text, capture_output=True, text=True, check=True)
        if done.stderr.strip():
            sys.exit(f"{done.stderr}\nof a page that begins:\n{text[:200]}")
        return done.stdout

    def nav(self, page):
        up = "../" * page.count("/")
        lines = []
        for folder, name in FOLDERS:
            pages = in_order(self.tree, os.path.join("docs", folder), self.pages)
            if not pages:
                continue
            here = os.path.dirname(page) == os.path.join("docs", folder)
            lines.append(f'<details{" open" if here else ""}><summary>{name}</summary><ul>')
            for other in pages:
                mark = ' class="here"' if other == page else ""
                lines.append(f'<li><a{mark} href="{up}{html_name(other)}">{html.escape(self.titles[other])}</a></li>')
            lines.append("</ul></details>")
        cases = [other for other in self.pages if other.startswith("cases/")]
        lines.append(f'<details{" open" if page in cases else ""}><summary>Cases</summary><ul>')
        lines += [f'<li><a{" class=here" if other == page else ""} href="{up}{html_name(other)}">'
                  f'{os.path.basename(os.path.dirname(other))}</a></li>' for other in cases]
        lines.append("</ul></details>")
        if os.path.exists(os.path.join(self.out, "api", "index.html")):
            lines.append(f'<p><a href="{up}api/index.html">Functions in C</a></p>')
        return "\n".join(lines)

    def link(self, page, target):
        """Where a link of a page leads on the site."""
        if re.match(r"[a-z]+:", target) or target.startswith("#"):
            return target
        path, mark, anchor = target.partition("#")
        full = os.path.normpath(os.path.join(os.path.dirname(page), path))
        if os.path.isdir(os.path.join(self.tree, full)):
            inside = [name for name in ("README.md", "case.yaml") if os.path.exists(os.path.join(self.tree, full, name))]
            full = os.path.join(full, inside[0]) if inside else full
        if full in self.titles:
            full = html_name(full)
        elif os.path.isfile(os.path.join(self.tree, full)):
            self.named.add(full)
            if os.path.splitext(full)[1] in SOURCES or os.path.basename(full) == "LICENSE":
                full += ".html"
        return os.path.relpath(full, os.path.dirname(page) or ".") + mark + anchor

    def write_page(self, page, body, title, toc=""):
        text = TEMPLATE.format(title=html.escape(title), up="../" * page.count("/"), nav=self.nav(page), toc=toc, body=body)
        write(os.path.join(self.out, html_name(page)), text)

    def make_page(self, page):
        text = read(os.path.join(self.tree, page))
        body = self.as_html(prepared(text))
        body = re.sub(r'<math display="inline".*?</math>', lambda m: m.group().replace('stretchy="true"', 'stretchy="false"'), body,
                      flags=re.S)  # else brackets in a line grow with every subscript
        body = re.sub(r'(href|src)="([^"]*)"', lambda m: f'{m.group(1)}="{html.escape(self.link(page, html.unescape(m.group(2))))}"', body)
        body = re.sub(r"<table>.*?</table>", lambda m: f'<div class="table">{m.group()}</div>', body, flags=re.S)
        heads = re.findall(r'<h2 id="([^"]*)">(.*?)</h2>', body)
        toc = ""
        if len(heads) > 3:
            toc = '<details class="toc"><summary>On this page</summary><ul>' + "".join(
                f'<li><a href="#{name}">{re.sub("<[^>]*>", "", text)}</a></li>' for name, text in heads) + "</ul></details>\n"
        self.write_page(page, re.sub(r"(</h1>)", lambda m: m.group(1) + toc, body, count=1), self.titles[page])
        return page, body

    def make_source(self, path):
        """A file of the tree that a page names: shown as a page, or copied."""
        kind = SOURCES.get(os.path.splitext(path)[1])
        if kind or os.path.basename(path) == "LICENSE":
            text = read(os.path.join(self.tree, path))
            self.write_page(path + ".html", f"<h1>{html.escape(path)}</h1>\n<pre><code>{html.escape(text)}</code></pre>", path)
        else:
            os.makedirs(os.path.dirname(os.path.join(self.out, path)), exist_ok=True)
            shutil.copyfile(os.path.join(self.tree, path), os.path.join(self.out, path))

    def findings(self, page, body):
        """What the search field knows of a page: text, kind, place."""
        found = [[self.titles[page], "page", html_name(page)]]
        section = anchor = ""
        for level, name, head, tag, row in re.findall(
                r'<h([1-6]) id="([^"]*)">(.*?)</h[1-6]>|<div class="equation" id="([^"]*)">|<tr[^>]*>\s*<td><code>([^<]*)</code></td>', body):
            if tag:
                found.append([f"({tag}) {section}", "equation", f"{html_name(page)}#{tag}"])
            elif row and page.startswith("docs/reference/"):
                found.append([f"{html.unescape(row)} — {section}", "key", f"{html_name(page)}#{anchor}"])
            elif head and level != "1":
                section, anchor = html.unescape(re.sub("<[^>]*>", "", head)), name
                found.append([f"{section} — {self.titles[page]}", "section", f"{html_name(page)}#{name}"])
            elif head:
                anchor = name
        return found

    def take_font(self):
        """One of the fonts for mathematics goes along with the site, if the machine has one."""
        for folder, _, files in os.walk("/usr/share/fonts"):
            for name in set(files) & set(MATH_FONTS):
                shutil.copyfile(os.path.join(folder, name), os.path.join(self.out, name))
                with open(os.path.join(self.out, "style.css"), "a", encoding="utf-8") as file:
                    file.write(f'@font-face {{ font-family: "site math"; src: url("{name}"); }}\n')
                return

    def make(self):
        with ThreadPoolExecutor(os.cpu_count()) as pool:
            bodies = list(pool.map(self.make_page, self.pages))
        for path in sorted(self.named):
            self.make_source(path)
        found = [one for page, body in bodies for one in self.findings(page, body)]
        write(os.path.join(self.out, "find.js"), "const FIND = " + json.dumps(found, ensure_ascii=False) + ";\n")
        for name in ("style.css", "site.js"):
            shutil.copyfile(os.path.join(HERE, name), os.path.join(self.out, name))
        self.take_font()
        shutil.copyfile(os.path.join(self.out, "README.html"), os.path.join(self.out, "index.html"))


def main():
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("out")
    words.add_argument("--tree", default=os.path.dirname(os.path.dirname(HERE)))
    words.add_argument("--pandoc", default="pandoc")
    given = words.parse_args()
    if not shutil.which(given.pandoc):
        sys.exit("no pandoc: the site needs it (Debian: apt-get install pandoc doxygen fonts-dejavu-extra)")
    site = Site(os.path.abspath(given.tree), os.path.abspath(given.out), given.pandoc)
    site.make()
    print(f"{len(site.pages)} pages: {os.path.join(site.out, 'index.html')}")


if __name__ == "__main__":
    main()
