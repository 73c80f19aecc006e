# SPDX-License-Identifier: BSD-3-Clause
"""Modules that Python does not bring along.  Each is loaded where it is first used, so that cases and runs need none of them; where
one is missing, ImportError says which interpreter runs and what to do.

    from breech.needs import h5py, numpy as np
    from breech.needs import demand
    demand("numpy", "h5py")     # in a script: ends with the text in place of a traceback
"""
import importlib
import importlib.util
import os
import subprocess
import sys

DEBIAN = "/usr/bin/python3"
PACKAGES = {"numpy": "python3-numpy", "h5py": "python3-h5py", "matplotlib": "python3-matplotlib"}  # of Debian


def _has(python, names):
    try:
        done = subprocess.run([python, "-c", "import " + ", ".join(names)], capture_output=True, check=False, timeout=60)
    except (OSError, subprocess.TimeoutExpired):
        return False
    return done.returncode == 0


def cure(names):
    """What to do about modules that this interpreter has not."""
    text = f"{sys.executable} has no {', '.join(names)}: "
    if os.path.realpath(sys.executable) != os.path.realpath(DEBIAN) and _has(DEBIAN, names):
        return text + f"Debian's {DEBIAN} has; run this with that one, or put it first in PATH"
    packages = " ".join(PACKAGES.get(name, name) for name in names)
    return text + f"apt-get install {packages}, or {sys.executable} -m pip install {' '.join(names)}"


def load(name):
    """The module; ImportError with the cure where it is not installed."""
    try:
        return importlib.import_module(name)
    except ModuleNotFoundError as missing:
        if missing.name != name.partition(".")[0]:
            raise
        raise ImportError(cure([missing.name]), name=missing.name) from None


def demand(*names):
    """For scripts: ends with the cure and exit code 2 where one of these modules is missing."""
    missing = [name for name in names if importlib.util.find_spec(name) is None]
    if missing:
        print(f"{os.path.basename(sys.argv[0])}: {cure(missing)}", file=sys.stderr)
        sys.exit(2)


class _Later:
    """Stands for a module until it is asked for something."""

    def __init__(self, name):
        self._name = name

    def __getattr__(self, name):
        return getattr(load(self._name), name)


h5py, numpy = _Later("h5py"), _Later("numpy")
