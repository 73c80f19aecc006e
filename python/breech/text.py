# SPDX-License-Identifier: BSD-3-Clause
"""The text of case files: the part of YAML that Breech reads, into dicts and lists and back.

Breech refuses anchors, aliases, tags and several documents.  This reader refuses block texts (| and >) and complex keys too.
"""
import json
import math
import numbers
import re

FLAGS = {"yes": True, "no": False, "true": True, "false": False}
NUMBER = r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?"
QUANTITY = re.compile(rf"({NUMBER}(?:\s+{NUMBER})*)\s*((?:(?:1/)?[A-Za-z%°µ][^\s,\[\]{{}}]*)(?:\s+[A-Za-z][^\s,\[\]{{}}]*)*)")
KEY = re.compile(r"""("(?:[^"\\]|\\.)*"|'(?:[^']|'')*'|[^\s\[\]{},"'#&*!|>%@`?-][^#]*?)\s*:(?:\s+|$)""")
PLAIN = re.compile(r"(?!-(?: |$)|---$|\.\.\.$)[A-Za-z0-9_.+-][\w .+*/^%-]*")


class CaseError(ValueError):
    """The text is no case file that this reader knows."""


class Quantity:
    """A value with its unit, as it stands in a case: Quantity("10.55 kV").value, .unit.  The value of a vector is a tuple.

    Times or divided by a number it is a quantity of the same unit.  Case files hold its text, str(quantity).
    """

    def __init__(self, text, unit=None):
        self._text = None
        if unit is None:
            self._text = str(text).strip()
            found = QUANTITY.fullmatch(self._text)
            if not found:
                raise CaseError(f"{text!r} is no number with a unit")
            values = tuple(float(word) for word in found[1].split())
            text, unit = values[0] if len(values) == 1 else values, found[2]
        self.value, self.unit = text, unit

    def __mul__(self, factor):
        if isinstance(self.value, tuple):
            return Quantity(tuple(v * factor for v in self.value), self.unit)
        return Quantity(self.value * factor, self.unit)

    __rmul__ = __mul__

    def __truediv__(self, divisor):
        return self * (1.0 / divisor)

    def _written(self):
        values = self.value if isinstance(self.value, tuple) else (self.value,)
        return f"{' '.join(number_text(v) for v in values)} {self.unit}"

    def __str__(self):
        return self._text or self._written()

    def __repr__(self):
        return f"Quantity({str(self)!r})"

    def __eq__(self, other):
        if isinstance(other, str):
            other = scalar(other)
        return isinstance(other, Quantity) and self._written() == other._written()

    def __hash__(self):
        return hash(self._written())



def number_text(value):
    if isinstance(value, numbers.Integral):
        return str(int(value))
    if not math.isfinite(value):
        raise CaseError(f"{value} cannot stand in a case")
    return f"{float(value):.15g}"


def scalar(text):
    """What a plain word of a case file means: None, a flag, a number, a quantity, or the text itself."""
    if text in ("", "~", "null"):
        return None
    if text in FLAGS:
        return FLAGS[text]
    if re.fullmatch(r"[-+]?\d+", text):
        return int(text)
    if re.fullmatch(NUMBER, text):
        return float(text)
    return Quantity(text) if QUANTITY.fullmatch(text) else text


# ---- reading ----


def _without_comment(line):
    quote, opens = "", True  # a quote opens a text only where a value may begin
    for i, c in enumerate(line):
        if quote:
            if c == quote and not (quote == '"' and line[i - 1] == "\\"):
                quote = ""
        elif c in "\"'" and opens:
            quote = c
        elif c == "#" and (i == 0 or line[i - 1] in " \t"):
            return line[:i].rstrip()
        if c not in " \t":
            opens = c in "[{,:-"
    return line.rstrip()


class _Flow:
    """Reads [lists], {maps} and quoted texts of one line."""

    def __init__(self, text, of_word, place):
        self.text, self.at, self.of_word, self.place = text, 0, of_word, place

    def fail(self, what):
        raise CaseError(f"{self.place}: {what}")

    def space(self):
        while self.at < len(self.text) and self.text[self.at] in " \t":
            self.at += 1
        return self.text[self.at] if self.at < len(self.text) else ""

    def quoted(self):
        pattern = r'"(?:[^"\\]|\\.)*"' if self.text[self.at] == '"' else r"'(?:[^']|'')*'"
        found = re.compile(pattern).match(self.text, self.at)
        if not found:
            self.fail("a quoted text does not end")
        self.at = found.end()
        if found[0][0] == "'":
            return found[0][1:-1].replace("''", "'")
        try:
            return json.loads(found[0])
        except ValueError:
            self.fail(f"{found[0]}: this escape is not known")

    def word(self, ends):
        start = self.at
        while self.at < len(self.text):
            c = self.text[self.at]
            if c in "[]{}," or (c == ":" and ends and self.text[self.at + 1:self.at + 2] in ("", " ", ",", "]", "}")):
                break
            self.at += 1
        return self.text[start:self.at].strip()

    def value(self):
        c = self.space()
        if c == "[":
            return self.items("]", self.entry)
        if c == "{":
            return dict(self.items("}", self.pair))
        if c and c in "\"'":
            return self.quoted()
        if c and c in "&*!|>`@%":
            self.fail(f"`{c}` is not read here")
        return self.of_word(self.word(False))

    def entry(self):
        start = self.at
        if self.space() not in "[{\"'":
            self.word(True)
            if self.space() == ":":  # a pair in a list is a map of one
                self.at = start
                return dict([self.pair()])
            self.at = start
        return self.value()

    def pair(self):
        c = self.space()
        key = self.quoted() if c and c in "\"'" else self.word(True)
        if self.space() == ":":
            self.at += 1
            return key, self.value()
        return key, self.of_word("")

    def items(self, end, read):
        self.at += 1
        found = []
        while self.space() != end:
            found.append(read())
            c = self.space()
            if c == ",":
                self.at += 1
            elif c != end:
                self.fail(f"`{end}` is missing")
        self.at += 1
        return found

    def whole(self):
        value = self.value()
        if self.space():
            self.fail(f"`{self.text[self.at:]}` is left over")
        return value


def _open_brackets(text):
    depth, quote, opens = 0, "", True
    for i, c in enumerate(text):
        if quote:
            if c == quote and not (quote == '"' and text[i - 1] == "\\"):
                quote = ""
        elif c in "\"'" and opens:
            quote = c
        else:
            depth += (c in "[{") - (c in "]}")
        if c not in " \t":
            opens = c in "[{,:-"
    return depth > 0 or quote != ""


class _Blocks:
    def __init__(self, text, of_word, name):
        self.of_word, self.name, self.at = of_word, name, 0
        self.lines = []  # indent, text, number
        for number, line in enumerate(text.lstrip("\ufeff").splitlines(), 1):
            line = _without_comment(line)
            body = line.lstrip(" ")
            if body in ("", "---") or body == "...":
                continue
            self.lines.append((len(line) - len(body), body, number))

    def next(self):
        return self.lines[self.at] if self.at < len(self.lines) else (-1, "", 0)

    def value(self, rest, indent):
        """What stands behind `key:` or `-`, and on deeper lines below."""
        number = self.lines[self.at - 1][2]
        if not rest:
            below, text, _ = self.next()
            return self.block(below) if below > indent else self.of_word("")
        while self.next()[0] > indent and (rest[0] not in "[{\"'" or _open_brackets(rest)):
            rest += " " + self.next()[1]
            self.at += 1
        place = f"{self.name}:{number}"
        if rest[0] in "[{\"'&*!|>`@%":
            return _Flow(rest, self.of_word, place).whole()
        if KEY.match(rest):
            raise CaseError(f"{place}: `{rest}` holds a second key")
        return self.of_word(rest)

    def list(self, indent):
        found = []
        while self.next()[0] == indent and (self.next()[1] + " ").startswith("- "):
            _, text, number = self.next()
            rest = text[1:].lstrip(" ")
            if KEY.match(rest) or (rest + " ").startswith("- "):  # a map or a list that begins on this line
                inner = indent + len(text) - len(rest)
                self.lines[self.at] = (inner, rest, number)
                found.append(self.block(inner))
            else:
                self.at += 1
                found.append(self.value(rest, indent))
        return found

    def map(self, indent):
        found = {}
        while self.next()[0] == indent:
            _, text, number = self.next()
            key = KEY.match(text)
            if not key:
                raise CaseError(f"{self.name}:{number}: `{text}` is no key with its value")
            name = _Flow(key[1], str, f"{self.name}:{number}").quoted() if key[1][0] in "\"'" else key[1]
            if name in found:
                raise CaseError(f"{self.name}:{number}: `{name}` stands twice")
            rest = text[key.end():]
            self.at += 1
            if not rest and self.next()[0] == indent and (self.next()[1] + " ").startswith("- "):
                found[name] = self.list(indent)
            else:
                found[name] = self.value(rest, indent)
        return found

    def block(self, indent):
        _, text, number = self.next()
        if (text + " ").startswith("- "):
            value = self.list(indent)
        elif KEY.match(text):
            value = self.map(indent)
        else:
            self.at += 1
            value = self.value(text, indent - 1)
        if self.next()[0] > indent:
            raise CaseError(f"{self.name}:{self.next()[2]}: `{self.next()[1]}` stands too far to the right")
        return value


def parse(text, name="case", of_word=scalar):
    """Dicts, lists and values of a case file's text; of_word makes a value of a word without quotes."""
    blocks = _Blocks(text, of_word, name)
    if not blocks.lines:
        return {}
    value = blocks.block(blocks.lines[0][0])
    if blocks.at < len(blocks.lines):
        raise CaseError(f"{name}:{blocks.next()[2]}: `{blocks.next()[1]}` stands too far to the left")
    return value


# ---- writing ----


def _value_text(value):
    if value is None:
        return "~"
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, Quantity):
        return str(value)
    if isinstance(value, numbers.Real):
        return number_text(value)
    if isinstance(value, dict):
        return "{" + ", ".join(f"{_key_text(k)}: {_value_text(v)}" for k, v in value.items()) + "}"
    if isinstance(value, (list, tuple)) or hasattr(value, "tolist"):
        return "[" + ", ".join(_value_text(v) for v in list(value)) + "]"
    if isinstance(value, str):
        return value if PLAIN.fullmatch(value) and value == value.strip() else json.dumps(value, ensure_ascii=False)
    raise CaseError(f"{value!r} cannot stand in a case")


def _key_text(key):
    if not isinstance(key, str):
        raise CaseError(f"{key!r} is no name of a key")
    return key if re.fullmatch(r"\w[\w.+-]*", key) else json.dumps(key, ensure_ascii=False)


def dump(tree):
    """The text of a case file: a line a key, a section below its name."""
    lines = []
    for key, value in tree.items():
        if isinstance(value, dict) and value:
            lines.append(f"{_key_text(key)}:")
            lines += [f"  {_key_text(k)}: {_value_text(v)}" for k, v in value.items()]
        elif isinstance(value, (list, tuple)) and value and all(isinstance(v, dict) for v in value):
            lines.append(f"{_key_text(key)}:")
            lines += [f"  - {_value_text(v)}" for v in value]
        else:
            lines.append(f"{_key_text(key)}: {_value_text(value)}")
    return "\n".join(lines) + "\n"
