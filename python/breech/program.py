# SPDX-License-Identifier: BSD-3-Clause
"""Running the program: its progress, its exit codes, its words."""
import os
import re
import signal
import subprocess
import sys
import tempfile
from pathlib import Path

from .case import Case
from .places import program
from .results import Run

LIVE = re.compile(r"(?P<task>.*?)  (?P<percent>\d+) %(?:  (?P<left>.+?) left)?(?:  (?P<rate>\S+) M point-steps/s)?")


class BreechError(Exception):
    """The program ended with another exit code than 0: .code, and .text, what it said."""

    def __init__(self, code, text, directory=None):
        super().__init__(text)
        self.code, self.text, self.directory = code, text, directory


class Failed(BreechError):
    """Exit code 1: it failed while it ran."""


class BadInput(BreechError):
    """Exit code 2: the case, a value or an option is wrong; nothing was written."""


class Stopped(BreechError):
    """Exit code 75: stopped early with a checkpoint; run(..., resume=True) goes on."""


class Progress:
    """A line that the program said: .text; of a task under way also .task, .fraction (0 .. 1) and .left, the time still needed."""

    def __init__(self, text):
        found = LIVE.fullmatch(text)
        self.text = text
        self.task = found["task"] if found else None
        self.fraction = int(found["percent"]) / 100 if found else None
        self.left = found["left"] if found else None

    def __str__(self):
        return self.text


def _set_text(value):
    from .text import _value_text
    return value if isinstance(value, str) else _value_text(value)


def _what_was_said(lines):
    """The program's own error among its lines: those with its name, else all that are no progress."""
    named = [line.removeprefix("breech: ") for line in lines if line.startswith("breech: ")]
    return "\n".join(named or [line for line in lines if not LIVE.fullmatch(line)])


def _error(code, text, directory):
    if code < 0:
        return BreechError(code, f"ended by {signal.Signals(-code).name}\n{text}".rstrip(), directory)
    return {1: Failed, 2: BadInput, 75: Stopped}.get(code, BreechError)(code, text, directory)


def _call(arguments, hear, hide, materials=None, often=False):
    """Exit code, standard output, lines of standard error; each line is heard as it comes.

    often: a line of progress every second, not as seldom as the program writes into a file.
    """
    with tempfile.TemporaryFile("w+", encoding="utf-8") as out:
        # A group of its own: Ctrl-C reaches Python alone, which then stops the program once, with a checkpoint.
        environment = {**({"BREECH_PROGRESS": "1"} if often else {}), **os.environ}  # [s] between two lines
        if materials:
            environment["BREECH_MATERIALS"] = str(materials)
        child = subprocess.Popen([program(), *arguments], stdin=subprocess.DEVNULL, stdout=out, stderr=subprocess.PIPE,
                                 encoding="utf-8", errors="replace", start_new_session=True, env=environment)
        lines = []
        try:
            for line in child.stderr:
                lines.append(line.rstrip("\n").replace(hide, "") if hide else line.rstrip("\n"))
                hear(Progress(lines[-1]))
            child.wait()
        except BaseException:
            if child.poll() is None:
                child.terminate()
                child.stderr.close()
                child.wait()
            raise
        finally:
            child.stderr.close()
        out.seek(0)
        return child.returncode, out.read(), lines


def _with_case(case, call):
    """What call(path, hide) returns; a Case gets a file as long as that lasts, and hide is its folder."""
    if not isinstance(case, Case):
        return call(str(case), "")
    with tempfile.TemporaryDirectory(prefix="breech-") as folder:
        path = Path(folder) / "case.yaml"
        path.write_text(case.text(folder), encoding="utf-8")
        return call(str(path), folder + os.sep)


def run(command, case, directory, *, sets=None, threads=None, progress=True, resume=False, force=False, store=None,
        max_walltime=None, options=()):
    """Runs `breech command` on a case (a Case, or the path of one) and returns the Run that reads the directory.

    sets: {"bank.charge": "9 kV", ...} on top of the case.  store: a folder of scenes, False: none.  max_walltime: "30m".
    options: any other words of the command line.  progress: True prints what the program says while it runs, every second at a
    terminal, now and then into a file or a pipe; a function is called with each Progress, every second; False is silent.
    Raises BadInput, Failed or Stopped with the program's own words.
    """
    def hear(line):
        if callable(progress):
            progress(line)
        elif progress:
            print(line, file=sys.stderr, flush=True)

    def call(path, hide):
        words = [command, path, "-o", str(directory)]
        for key, value in (sets or {}).items():
            words += ["--set", f"{key}={_set_text(value)}"]
        words += ["--threads", str(threads)] if threads else []
        words += ["--max-walltime", str(max_walltime)] if max_walltime else []
        words += ["--no-store"] if store is False else ["--store", str(store)] if store else []
        words += ["--resume"] * bool(resume) + ["--force"] * bool(force)
        return _call([*words, *options], hear, hide, getattr(case, "material_folder", None),
                     callable(progress) or bool(progress) and sys.stderr.isatty())

    code, _, lines = _with_case(case, call)
    if code != 0:
        raise _error(code, _what_was_said(lines), Path(directory))
    return Run(directory)


def check(case, sets=None):
    """What `breech check` prints of a case; raises BadInput if it is wrong."""
    def call(path, hide):
        words = [word for key, value in (sets or {}).items() for word in ("--set", f"{key}={_set_text(value)}")]
        return _call(["check", path, *words], lambda line: None, hide, getattr(case, "material_folder", None))

    code, out, lines = _with_case(case, call)
    if code != 0:
        raise _error(code, _what_was_said(lines), None)
    return out
