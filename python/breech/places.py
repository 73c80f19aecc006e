# SPDX-License-Identifier: BSD-3-Clause
"""Where the program and the shipped cases are."""
import os
import shutil
from pathlib import Path

HERE = Path(__file__).resolve()
TREE = HERE.parents[2] if HERE.parents[1].name == "python" else None  # of the sources, if this package lies in one


def program():
    """The program's path: $BREECH_PROGRAM; `breech` beside this installation or of the build tree; `breech` on the path."""
    beside = [HERE.parents[4] / "bin" / "breech"] if HERE.parents[1].name == "dist-packages" else []
    built = [TREE / "build" / "release" / "bin" / "breech"] if TREE else []
    for path in (os.environ.get("BREECH_PROGRAM"), *beside, *built, shutil.which("breech")):
        if path and os.access(path, os.X_OK):
            return str(path)
    raise FileNotFoundError("the program breech was not found: put the folder that holds it on PATH, or set BREECH_PROGRAM to "
                            "its path, as in BREECH_PROGRAM=/home/me/breech/build/release/bin/breech")


def shipped_folders():
    """Folders of the cases that came with the program."""
    folders = [TREE / "cases"] if TREE else []
    try:
        found = Path(program()).resolve()
    except FileNotFoundError:
        return folders
    folders.append(found.parents[1] / "share" / "breech" / "cases")
    if found.parts[-4:-3] == ("build",):
        folders.append(found.parents[3] / "cases")
    return [folder for folder in folders if folder.is_dir()]
