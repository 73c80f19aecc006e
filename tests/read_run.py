# SPDX-License-Identifier: BSD-3-Clause
"""The package of python/ gives what the files hold:   read_run.py PYTHON DIR SCENE

DIR: an output directory with the scene, its snapshots and its store.
"""
import os
import subprocess
import sys

import h5py
import numpy as np

package, directory, name = sys.argv[1:]
sys.path.insert(0, package)
import breech  # noqa: E402

run = breech.Run(directory)
assert run.summary["status"] == "done" and run.summary["kind"] == "scene"
assert name in run.scenes
columns, crater = run.scene(name), run.crater(name)
assert columns.units["time"] == "s" and columns.units["peak_pressure"] == "Pa"
assert (np.diff(columns["time"]) > 0).all() and len(set(map(len, columns.values()))) == 1
assert columns["peak_pressure"][-1] == run.summary["max_pressure"]
assert crater.depth.shape == (len(crater.x), len(crater.z)) and len(crater.profile()) == len(crater.x)
assert crater.texts["class"] == run.summary["class"]
assert crater.numbers["depth_m"] == run.summary["crater_depth"]
with h5py.File(run.directory / "history.h5") as f:
    assert (f[f"/scene/{name}/crater/depth"][()] == crater.depth).all()

times = []
for time, points in run.snapshots(name):
    times.append(time)
    n = len(points["position"])
    assert points["position"].shape == (n, 3) and len(points["damage"]) == len(points["body"]) == n
assert len(times) == 3 and times == sorted(times)
assert n == run.summary["particles"]

stored = breech.store(run.directory / "store")
assert len(stored) == 1
one = stored[0]
assert one.outcome["severity"] == run.summary["severity"] and one.outcome["particle_steps"] == run.summary["particle_steps"]
assert "armature:" in one.case and one.instruction_set == run.summary["instruction_set"]
assert (one.crater.depth == crater.depth).all() and (one.columns["time"] == columns["time"]).all()

text = subprocess.run([sys.executable, "-m", "breech", directory], capture_output=True, text=True, check=True,
                      env={**os.environ, "PYTHONPATH": package}).stdout
assert f"scene {name}: {crater.texts['class']}" in text and "3 snapshots" in text
