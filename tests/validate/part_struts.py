# SPDX-License-Identifier: BSD-3-Clause
"""Bending of a strut at angles to the grid, against Timoshenko; stiffness of a lattice's cell, by cells a strut."""
import math
import os

import press
from pages import Column, Table

from breech.needs import h5py, numpy as np

CASE = "cases/verification/bending_strut"
YOUNGS, POISSON, DENSITY, THICK, LENGTH = 113e9, 0.34, 4430.0, 1e-3, 8e-3
TURN = math.radians(35.26439)
LINES = {  # along the strut, and sideways as it swings
    "0": ((1, 0, 0), (0, 0, 1)),
    "35.26": ((math.cos(TURN), math.sin(TURN), 0), (-math.sin(TURN), math.cos(TURN), 0)),
    "54.74": ((3 ** -0.5,) * 3, (2 ** -0.5, -2 ** -0.5, 0)),
}
CELLS = (2, 3, 4, 6)  # across the strut
STRUT = [Column("angle to the grid"), *(Column("%d cells" % n, 0.3) for n in CELLS)]
ELASTIC = {"scene__end_time": "30 us", "output__snapshots": 5}  # for its stiffness alone
CELL = [Column("net"), Column("cells a strut"), Column("E [GPa]", 0.03), Column("nu", 0.03),
        Column("highest stress, sides held [MPa]", 0.05)]


def symmetric_mode(omega):
    """Zero at the angular frequencies of a free Timoshenko strut's symmetric modes."""
    shear, area, inertia = YOUNGS / (2 * (1 + POISSON)), np.pi * THICK ** 2 / 4, np.pi * THICK ** 4 / 64
    k = 6 * (1 + POISSON) / (7 + 6 * POISSON)
    drag = DENSITY * omega ** 2 / (k * shear)
    squares = np.roots([YOUNGS * inertia, DENSITY * inertia * omega ** 2 + YOUNGS * inertia * drag,
                        DENSITY * inertia * omega ** 2 * drag - DENSITY * area * omega ** 2]).astype(complex)
    (m1, v1), (m2, v2) = ((turn * s * np.cosh(s * LENGTH / 2), (s - turn) * np.sinh(s * LENGTH / 2))
                          for s in np.sqrt(squares) for turn in [(drag + s * s) / s])
    product = m1 * v2 - m2 * v1
    return product.real if abs(product.real) > abs(product.imag) else product.imag


def timoshenko():
    """Its lowest frequency [Hz]."""
    low, high = 2 * np.pi * 50e3, 2 * np.pi * 80e3
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (low, middle) if symmetric_mode(low) * symmetric_mode(middle) < 0 else (middle, high)
    return low / (2 * np.pi)


def bodies(along, sideways):
    of = []
    for name, start, end, sign in (("left", -4, -2, -1), ("middle", -2, 2, 1), ("right", 2, 4, -1)):
        vector = [" ".join("%.9f" % (a * x) for x in way) for a, way in (
            (sign, sideways), (start, along), (end, along))]
        of.append("{name: %s, group: strut, material: elastic, velocity: %s m/s, shape: {strut: {from: %s mm, to: %s mm, "
                  "radius: 0.5 mm}}}" % (name, *vector))
    return "[%s]" % ", ".join(of)


def frequency(path, sideways):
    """Of the swing, by least squares of a decaying sine [Hz]."""
    with h5py.File(path) as file:
        probe = file["scene/scene/probes/swing"]
        time = probe["time"][:]
        swing = sum(s * probe["velocity_" + axis][:] for s, axis in zip(sideways, "xyz"))

    def misfit(f, decay):
        waves = np.exp(-decay * time)[:, None] * np.stack([np.cos(2 * np.pi * f * time), np.sin(2 * np.pi * f * time)], 1)
        return np.sum((swing - waves @ np.linalg.lstsq(waves, swing, rcond=None)[0]) ** 2)

    f, decay = min(np.linspace(50e3, 80e3, 301), key=lambda f: misfit(f, 0)), 0
    for _ in range(4):
        decay = min(np.linspace(0, 2e4, 41), key=lambda d: misfit(f, d))
        f = min(np.linspace(f - 200, f + 200, 81), key=lambda x: misfit(x, decay))
    return f


def stiffness_error(runs, angle, n):
    """Bending stiffness over Timoshenko's less 1 [%]: twice that of the frequency."""
    along, sideways = LINES[angle]
    half = [LENGTH / 2 * 1e3 * abs(a) + 1 for a in along]
    window = ", ".join("%s: {lo: %.6f mm, hi: %.6f mm}" % (axis, -h, h) for axis, h in zip("xyz", half))
    arguments = ["scene", CASE]
    for key, value in {"output.report": "no", "scene.cell": "%.9g mm" % (1 / n), "scene.coarse_cell": "%.9g mm" % (1 / n),
                       "scene.bodies": bodies(along, sideways), "scene.window": "{%s}" % window}.items():
        arguments += ["--set", "%s=%s" % (key, value)]
    folder, _ = runs.run("strut_%s_%d" % (angle, n), arguments)
    f = frequency(os.path.join(folder, "history.h5"), sideways)
    return 100 * ((f / timoshenko()) ** 2 - 1)


def struts(runs):
    rows = [[angle, *("%+.1f %%" % stiffness_error(runs, angle, n) for n in CELLS)] for angle in LINES]
    cells = []
    for net, n, more in (("open", 2.5, {}), ("open", 3, {}), ("open", 4, {}), ("open", 6, ELASTIC), ("full", 2.5, {}),
                         ("full", 4, {})):
        e, nu, top = press.held_cell(runs, net, 1 / n, **more)
        cells.append([net, "%g" % n, "%.2f" % e, "%.3f" % nu, "" if more else "%.0f" % top])
    return [Table(STRUT, rows), Table(CELL, cells)], "cases/verification/bending_strut, cases/lattice_target/compression.yaml"
