# SPDX-License-Identifier: BSD-3-Clause
"""Cases: what a run is given, as dicts and lists with the units of the file."""
import copy
import os
import re
from pathlib import Path

from .places import shipped_folders
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


def _in_folder(path):
    """The file of a case: itself, or case.yaml in a folder."""
    return path / "case.yaml" if path.is_dir() else path


def case_file(path, name=None):
    """The file of a case that is there: path, or, as on the command line, a shipped case of that name."""
    file = _in_folder(Path(path))
    if file.exists():
        return file
    name = str(path if name is None else name)
    folders = shipped_folders()
    if not name.startswith(("/", ".")) and ".." not in name:
        for folder in folders:
            shipped = _in_folder(folder / name.removeprefix("cases/"))
            if shipped.is_file():
                return shipped
    names = sorted({file.parent.name for folder in folders for file in folder.glob("*/case.yaml")})
    raise FileNotFoundError(f"{file}: there is no such case; shipped cases: {', '.join(names) or 'none found'}")


def _with_tables(tree, rewrite):
    """The tree with rewrite(path) for the path of every table of current, in current_profiles."""
    profiles = tree.get("current_profiles")
    if not isinstance(profiles, (dict, list)):
        return tree
    entries = []
    for entry in profiles if isinstance(profiles, list) else [profiles]:
        file = entry.get("file") if isinstance(entry, dict) else None
        if isinstance(file, str):
            entry = {**entry, "file": rewrite(file)}
        elif isinstance(file, list):
            entry = {**entry, "file": [rewrite(name) if isinstance(name, str) else name for name in file]}
        entries.append(entry)
    return {**tree, "current_profiles": entries if isinstance(profiles, list) else entries[0]}


def _read_with_files(path, name=None, bases=0):
    """A case's tree with all that it builds on, and the files that it stands in, itself first."""
    path = case_file(path, name).resolve()
    if bases > MAX_BASES:
        raise CaseError(f"{path}: a case builds on {MAX_BASES} others at most")
    tree = parse(path.read_text(encoding="utf-8"), str(path))
    if not isinstance(tree, dict):
        raise CaseError(f"{path} is no case: it must hold sections")
    tree = _with_tables(tree, lambda file: str((path.parent / file).resolve()))
    base = tree.pop("base", None)
    if not base:
        return tree, [path]
    below, files = _read_with_files(path.parent / str(base), str(base), bases + 1)
    return _merged(below, tree), [path, *files]


class Case(dict):
    """A case as nested dicts and lists.  Quantities keep their unit: case["bank"]["charge"] is Quantity("10.55 kV").

    Case("default_shot") reads a case with all that it builds on: a path, or the name of a shipped case.  Case(name="mine")
    begins with nothing.  Keys may be paths as for --set: case["bank.charge"], case["treatments[0].name"].  A text given as a
    value is what would stand in the file.  Saved, a case that was read is that case as its base, and what was changed.

    path: the file where the case lives, which read or saved it last; materials lie beside it.  None: nowhere yet.
    The file of a current profile that was read is an absolute path; one that is given, without /, lies beside the case.
    material_folder: a further folder with materials, looked into first; no part of what is saved.
    """

    def __init__(self, path=None, *, material_folder=None, **sections):
        tree, self._files = _read_with_files(path) if path is not None else ({}, [])
        self.path = self._files[0] if self._files else None
        self.material_folder = Path(material_folder).resolve() if material_folder is not None else None
        if self.material_folder and not self.material_folder.is_dir():
            raise FileNotFoundError(f"{material_folder}: there is no such folder of materials")
        super().__init__(tree)
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
        other.path, other.material_folder, other._files = self.path, self.material_folder, self._files
        for key, value in self.items():
            other[key] = copy.deepcopy(value)
        return other

    def _text_over(self, base, folder, home):
        """Tables of current are looked for from home where their path is not absolute, and named as seen from the folder."""
        folder = Path(folder).resolve()
        tree = _with_tables(dict(self), lambda file: str((home / file).resolve()))
        if base is not None:
            tree = {"base": os.path.relpath(base, folder), **_changes(_read_with_files(base)[0], tree)}
        return dump(_with_tables(tree, lambda file: os.path.relpath(file, folder)))

    def text(self, folder="."):
        """The text of a case file on top of the file where the case lives, which it names as seen from the folder."""
        return self._text_over(self.path, folder, self.path.parent if self.path else Path.cwd())

    def save(self, path):
        """Writes the case file and returns its path: a file ending in .yaml, or case.yaml in a folder.

        The case lives there from now on: its runs find the materials that lie beside the file.
        """
        path = Path(path)
        if path.suffix not in (".yaml", ".yml"):
            path = path / "case.yaml"
        file = path.resolve()
        # What was read is the base; a file in that chain which is now written over cannot be its own.
        below = self._files[self._files.index(file) + 1:] if file in self._files else self._files
        text = self._text_over(below[0] if below else None, file.parent, file.parent)
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
        self.path, self._files = file, below
        return path

    def check(self, **how):
        """What `breech check` says of it; raises BadInput with the program's words if it is wrong."""
        from .program import check
        return check(self, **how)

    def run(self, command, directory, **how):
        """Runs `breech command` and returns the Run.

        command: "shot", "scene", "strike", "life", "onset", "compare", "inductance" or "sweep".  how: sets, threads, progress,
        resume, force, store, max_walltime, options; see breech.run.  Raises BadInput, Failed or Stopped.
        """
        from .program import run
        return run(command, self, directory, **how)
