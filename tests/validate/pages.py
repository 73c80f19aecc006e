# SPDX-License-Identifier: BSD-3-Clause
"""Tables of docs/validation that a command writes, and how a written one is compared with fresh figures.

A page is prose with parts between `<!-- table: NAME -->` and `<!-- end -->`; only such parts are replaced."""
import os
import re

from runs import ROOT

NUMBER = re.compile(r"(?<![\w.])-?\d+(?:\.\d+)?(?:e[+-]?\d+)?")


UNDECIDED = "within the scatter"


class Column:
    """One column.  share: a fresh number may differ from the written one by this share of it, with a ± by three times
    that, too; None: its numbers are not compared.  words: what stands beside them is compared as well, unless the
    grids did not agree (more than one class, or UNDECIDED)."""

    def __init__(self, title, share=None, words=True):
        self.title, self.share, self.words = title, share, words

    def difference(self, written, fresh):
        """What differs between two cells, "" if nothing."""
        if self.share is None and not self.words:
            return ""
        decided = written != UNDECIDED and "," not in written
        if self.words and decided and beside_numbers(written) != beside_numbers(fresh):
            return "%s: now %s, written %s" % (self.title, fresh, written)
        if self.share is None:
            return ""
        old, new = NUMBER.findall(written), NUMBER.findall(fresh)
        scatter = float(old[1]) if "±" in written and len(old) > 1 else 0.0
        compared = list(zip(old, new))[:1] if scatter else list(zip(old, new))
        for a, b in compared:
            band = max(self.share * abs(float(a)), 3 * scatter, 1.01 * last_digit(a))
            if abs(float(b) - float(a)) > band:
                return "%s: now %s, written %s, which allows %.3g" % (self.title, fresh, written, band)
        return "" if len(old) == len(new) else "%s: now %s, written %s" % (self.title, fresh, written)


def beside_numbers(cell):
    return NUMBER.sub("", cell.partition(",")[0]).strip()


def last_digit(text):
    return 10.0 ** -len(text.partition(".")[2]) if "e" not in text else 0.0


class Table:
    """columns: of Column; rows: lists of cells, the first names the row."""

    def __init__(self, columns, rows):
        self.columns, self.rows = columns, rows

    def markdown(self):
        lines = ["| " + " | ".join(column.title for column in self.columns) + " |", "|" + "---|" * len(self.columns)]
        return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in self.rows]) + "\n"

    def allowed(self):
        """One line that says what the comparison allows."""
        shares = {}
        for column in self.columns[1:]:
            if column.share:
                shares.setdefault(column.share, []).append(re.sub(r" \[.*", "", column.title))
        return "; ".join("%s within %g %%" % (", ".join(titles), 100 * share) for share, titles in shares.items())

    def differences(self, written):
        """written: rows as they stand in the page."""
        faults = []
        if [row[0] for row in written] != [row[0] for row in self.rows]:
            return ["rows: now %s, written %s" % ([r[0] for r in self.rows], [r[0] for r in written])]
        for old, new in zip(written, self.rows):
            if len(old) != len(new):
                faults.append("%s: now %d columns, written %d" % (new[0], len(new), len(old)))
                continue
            for column, a, b in zip(self.columns[1:], old[1:], new[1:]):
                fault = column.difference(a, b)
                if fault:
                    faults.append("%s, %s" % (new[0], fault))
        return faults


def part_text(page, name):
    """Text of a marked part, and the page before and after it."""
    with open(os.path.join(ROOT, page), encoding="utf-8") as file:
        text = file.read()
    found = re.search(r"(<!-- table: %s -->\n)(.*?)(<!-- end -->)" % re.escape(name), text, flags=re.S)
    if not found:
        raise SystemExit("%s: no part <!-- table: %s -->" % (page, name))
    return text[:found.end(1)], found.group(2), text[found.start(3):]


def write_part(page, name, tables, note):
    before, _, after = part_text(page, name)
    allowed = "; ".join(dict.fromkeys(filter(None, (table.allowed() for table in tables))))
    made = "\n" + "\n".join(table.markdown() for table in tables)
    made += "\n`tests/validate/tables.py build/release/bin/breech OUT %s`: %s.%s\n\n" % (
        name, note, "\n`--check` allows %s, and three times what stands after ±." % allowed if allowed else "")
    with open(os.path.join(ROOT, page), "w", encoding="utf-8") as file:
        file.write(before + made + after)


def written_tables(text):
    """Rows of every table of a text, without heads."""
    tables, inside = [], False
    for line in text.splitlines():
        if not line.startswith("|"):
            inside = False
        elif re.match(r"^\|(-+\|)+$", line):
            tables.append([])
            inside = True
        elif inside:
            tables[-1].append([cell.strip() for cell in line.strip().strip("|").split("|")])
    return tables


def check_part(page, name, tables):
    """What differs between the written part and fresh tables."""
    written = written_tables(part_text(page, name)[1])
    if len(written) != len(tables):
        return ["%s, %s: now %d tables, written %d" % (page, name, len(tables), len(written))]
    faults = [fault for table, rows in zip(tables, written) for fault in table.differences(rows)]
    return ["%s, %s: %s" % (page, name, fault) for fault in faults]
