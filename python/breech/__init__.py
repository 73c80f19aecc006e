# SPDX-License-Identifier: BSD-3-Clause
"""Breech from Python: cases, runs, results and plots.

    import breech
    case = breech.Case("cases/default_shot")
    case["bank.charge"] *= 0.9                             # Quantity("10.55 kV") -> 9.495 kV
    run = case.run("shot", "out/weaker")
    print(run.summary["muzzle_velocity"])                  # summary.json as it is, SI units
    run.shot["velocity"], run.shot.units["velocity"]       # series of history.h5 as numpy arrays
    breech.plot.shot(run).savefig("weaker.png")            # needs matplotlib
"""
from .case import Case
from .program import BadInput, BreechError, Failed, Progress, Stopped, check, program, run
from .results import Columns, Crater, Run, StoredScene, describe, snapshot, store
from .text import CaseError, Quantity

__all__ = ["BadInput", "BreechError", "Case", "CaseError", "Columns", "Crater", "Failed", "Progress", "Quantity", "Run",
           "Stopped", "StoredScene", "check", "describe", "plot", "program", "run", "snapshot", "store"]


def __getattr__(name):
    if name == "plot":  # matplotlib is loaded where it is used
        import importlib
        return importlib.import_module(".plot", __name__)
    raise AttributeError(name)
