# SPDX-License-Identifier: BSD-3-Clause
"""Has a whole crater stripes?  Its profile behind the plough, against its own running mean."""
import os

from pages import Column, Table

from breech.needs import h5py, numpy as np

CASE = "cases/default_shot"
VELOCITY, GRIDS = 1625, 3  # [m/s]
CELLS = (2, 3)  # a radius: of the search's whole craters, of its other scenes
BEHIND = (1e-3, 10e-3)  # of the grain [m]
RUNNING = 1e-3  # [m]
MOST = 0.03  # [mm] rms, without stripes


def roughness(crater):
    """rms of the depth along the middle off its running mean [mm]"""
    x, z, depth = (crater[name][...] for name in ("x", "z", "depth"))
    line = depth[:, np.argmin(abs(z))]
    n = int(round(RUNNING / np.median(np.diff(x)))) | 1
    off = (line - np.convolve(line, np.ones(n) / n, "same"))[(x > BEHIND[0]) & (x < BEHIND[1])]
    return 1e3 * float(np.sqrt(np.mean(off ** 2)))


def stripes(runs):
    columns = [Column("cells a radius"), Column("rms off the running mean, on each grid [mm]", 0.3), Column("all below %g mm" % MOST, words=False)]
    rows = []
    for cells in CELLS:
        name = "stripes_%d" % cells
        runs.scene(name, CASE, GRIDS, scene__velocity="%d m/s" % VELOCITY, scene__cells_per_radius=cells)
        with h5py.File(os.path.join(runs.out, name, "history.h5"), "r") as file:
            found = [roughness(scene["crater"]) for scene in file["scene"].values()]
        rows.append(["%d" % cells, ", ".join("%.3f" % r for r in found), "yes" if max(found) < MOST else "no"])
    return [Table(columns, rows)], NOTE


NOTE = ("`breech scene cases/default_shot --ensemble 3` at 1625 m/s, the whole crater; `crater/depth` of `history.h5` along the middle, 1 to 10 mm "
        "behind the grain, against its own mean over 1 mm")
