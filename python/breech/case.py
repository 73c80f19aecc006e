# SPDX-License-Identifier: BSD-3-Clause
"""Cases: what a run is given, as dicts and lists with the units of the file."""
import copy
import os
import re
from pathlib import Path

from .text import CaseError, dump, parse

MAX_BASES = 8


def _merged(below, changes):
    """Changes over a tree, as a case over its base: maps key by key, ~ takes out, all else replaces."""
    if not isinstance(below, dict) or not isinstance(changes, dict):
        return changes
    tree = dict(below)
    for key, value in changes.items():
        if key in tree and value is None:
            del tree[key]
        elif key in tree:
            tree[key] = _merged(tree[key], value)
        else:
            tree[key] = value
    return tree


def _changes(below, tree):
    """What makes tree of below."""
    changed = {key: None for key in below if key not in tree}
    for key, value in tree.items():
        if key not in below:
            changed[key] = value
        elif isinstance(value, dict) and isinstance(below[key], dict):
            inner = _changes(below[key], value)
            if inner:
                changed[key] = inner
        elif value != below[key]:
            changed[key] = value
    return changed


def case_file(path):
    """The file of a case: itself, or case.yaml in a folder."""
    path = Path(path)
    return path / "case.yaml" if path.is_dir() else path


def _read(path, bases=0):
    path = case_file(path)
    if bases > MAX_BASES:
        raise CaseError(f"{path}: a case builds on {MAX_BASES} others at most")
    tree = parse(path.read_text(encoding="utf-8"), str(path))
    if not isinstance(tree, dict):
        raise CaseError(f"{path} is no case: it must hold sections")
    base = tree.pop("base", None)
    return _merged(_read(path.parent / str(base), bases + 1), tree) if base else tree


class Case(dict):
    """A case as nested dicts and lists.  Quantities keep their unit: case["bank"]["charge"] is Quantity("10.55 kV").

    Case("cases/default_shot") reads a case with all that it builds on, Case(name="mine") begins with nothing.  Keys may be
    paths as for --set: case["bank.charge"], case["treatments[0].name"].  A text given as a value is what would stand in the
    file.  Saved, a case that was read is that case as its base, and what was changed.
    """

    def __init__(self, path=None, **sections):
        self.path = case_file(path).resolve() if path is not None else None
        super().__init__(_read(self.path) if path is not None else {})
        self._below = copy.deepcopy(dict(self))
        for key, value in sections.items():
            self[key] = value

    @staticmethod
    def _steps(path):
        """Names and places of a path: "a.b[2]" is a, b, 2."""
        if not re.fullmatch(r"\w+(\[\d+\])*(\.\w+(\[\d+\])*)*", path):
            raise KeyError(path)
        return [int(s) if s.isdigit() else s for s in re.findall(r"\w+", path)]

    def _walk(self, steps):
        at = dict(self)
        for step in steps:
            if not isinstance(at, list if isinstance(step, int) else dict):
                raise KeyError(step)
            try:
                at = at[step]
            except IndexError:
                raise KeyError(step) from None
        return at

    def __getitem__(self, path):
        return super().__getitem__(path) if super().__contains__(path) else self._walk(self._steps(path))

    def __contains__(self, path):
        try:
            self[path]
        except KeyError:
            return False
        return True

    def get(self, path, default=None):
        return self[path] if path in self else default

    def __setitem__(self, path, value):
        steps = self._steps(path)
        if len(steps) == 1:
            super().__setitem__(steps[0], value)
            return
        if steps[0] not in self:
            super().__setitem__(steps[0], {})
        at = super().__getitem__(steps[0])
        for step in steps[1:-1]:
            if isinstance(at, dict) and isinstance(step, str):
                at = at.setdefault(step, {})
            elif isinstance(at, list) and isinstance(step, int) and step < len(at):
                at = at[step]
            else:
                raise KeyError(path)
        if not isinstance(at, list if isinstance(steps[-1], int) else dict):
            raise KeyError(path)
        at[steps[-1]] = value

    def __delitem__(self, path):
        steps = self._steps(path)
        if len(steps) == 1:
            super().__delitem__(steps[0])
        else:
            del self._walk(steps[:-1])[steps[-1]]

    def update(self, *others, **sections):
        for other in (*others, sections):
            for key, value in dict(other).items():
                self[key] = value

    def copy(self):
        """Another case that starts as this one."""
        other = Case()
        other.path, other._below = self.path, self._below
        for key, value in self.items():
            other[key] = copy.deepcopy(value)
        return other

    def text(self, folder="."):
        """The case file's text, its base named as seen from the folder."""
        if self.path is None:
            return dump(self)
        return dump({"base": os.path.relpath(self.path, Path(folder).resolve()), **_changes(self._below, dict(self))})

    def save(self, path):
        """Writes the case file and returns its path: a file ending in .yaml, or case.yaml in a folder."""
        path = Path(path)
        if path.suffix not in (".yaml", ".yml"):
            path = path / "case.yaml"
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(self.text(path.parent), encoding="utf-8")
        return path

    def check(self, **how):
        """What `breech check` says of it; raises BadInput with the program's words if it is wrong."""
        from .program import check
        return check(self, **how)

    def run(self, command, directory, **how):
        """Runs `breech command` and returns the Run; see breech.run."""
        from .program import run
        return run(command, self, directory, **how)
