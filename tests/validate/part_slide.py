# SPDX-License-Identifier: BSD-3-Clause
"""A pressed slide that runs over an elastic rail, beside the closed field of a load that runs (L-7)."""
import cmath
import glob
import math
import os

from pages import Column, Table

from breech.needs import h5py, numpy as np

CASE = "cases/verification/moving_load"
YOUNGS, POISSON, DENSITY = 124e9, 0.34, 8960.0
SHEAR = 0.5 * YOUNGS / (1 + POISSON)
LAME = YOUNGS * POISSON / ((1 + POISSON) * (1 - 2 * POISSON))
RAYLEIGH = 2121.0  # speed of these waves [m/s]
PRESSURE, LENGTH = 50e6, 12e-3
SLOW = 1.0  # [m/s]: as at rest
PASSAGES = ((0, 1), (0.25, 1), (0.5, 1), (0.8, 1), (0.8, 0.5))  # speed, share of Rayleigh waves'; cells [mm]
COLUMNS = [Column("speed over Rayleigh waves'; cells"), Column("K"), Column("stress along the face, closed [p]", 0.01),
           Column("scene [p]", 0.03), Column("strain along the face over that at rest, closed", 0.01),
           Column("scene", 0.03), Column("strain off by [%]", words=False),
           Column("off by of the pressure found [%]", words=False), Column("holds")]


def waves(speed):
    """a_1, a_2, R of (L-7)."""
    c2 = SHEAR / DENSITY
    c1 = (LAME + 2 * SHEAR) / DENSITY
    a1, a2 = math.sqrt(1 - speed ** 2 / c1), math.sqrt(1 - speed ** 2 / c2)
    return a1, a2, (1 + a2 * a2) ** 2 - 4 * a1 * a2


def factor(speed):
    a1, a2, rayleigh = waves(speed)
    return ((1 + 2 * a1 * a1 - a2 * a2) * (1 + a2 * a2) - 4 * a1 * a2) / -rayleigh


def closed(edges, pressures, speed, x, z):
    """Strain and stress along the face at depth z, under pressures that are even between edges."""
    a1, a2, rayleigh = waves(speed)

    def potential(w):
        return sum(p * (cmath.log(b - w) - cmath.log(a - w))
                   for a, b, p in zip(edges, edges[1:], pressures)) / (2j * math.pi)
    A = 2 * (1 + a2 * a2) * potential(x + 1j * a1 * z) / (SHEAR * rayleigh)
    B = -4 * a1 * potential(x + 1j * a2 * z) / (SHEAR * rayleigh)
    xx, zz = A.real + a2 * B.real, -a1 * a1 * A.real - a2 * B.real
    return xx, LAME * (xx + zz) + 2 * SHEAR * xx


class Face:
    """A snapshot: stress along the face and across it in the first cells below the slide and three on either side."""

    def __init__(self, file, cell):
        with h5py.File(file) as h:
            data = h["VTKHDF/PointData"]
            x, stress = h["VTKHDF/Points"][:, 0].astype(float), data["stress"][:].astype(float)
            body, start = data["body"][:], data["start"][:]
        slide = x[body == 1]
        middle = 0.5 * (slide.min() + slide.max())
        n, around, self.cell = round(LENGTH / cell), 3, cell
        self.edges = [middle + cell * (k - 0.5 * n - around) for k in range(n + 2 * around + 1)]
        first = (body == 0) & (start[:, 2] > -cell)
        place = np.digitize(x[first], self.edges) - 1
        self.along, self.across = (np.array([stress[first, q][place == k].mean() for k in range(n + 2 * around)])
                                   for q in (0, 2))
        self.flat = range(around + n // 4, around + n - n // 4)  # the middle half of the slide

    def mean(self):
        """Stress and strain along the face over the middle half."""
        along, across = self.along[self.flat].mean(), self.across[self.flat].mean()
        return along, (1 + POISSON) / YOUNGS * ((1 - POISSON) * along - POISSON * across)

    def closed_mean(self, speed):
        """The strain there by (L-7) of the pressure that was found."""
        strains = [closed(self.edges, -self.across, speed, 0.5 * (self.edges[k] + self.edges[k + 1]),
                          0.5 * self.cell)[0] for k in self.flat]
        return sum(strains) / len(strains)


def passage(runs, share, cell):
    """Mean over the last three snapshots: stress, strain, strain by the pressure found."""
    arguments = ["scene", CASE, "--set", "output.report=no", "--set",
                 "scene.bodies[1].velocity=[%.1f m/s, 0 m/s, 0 m/s]" % (share * RAYLEIGH)]
    for key in ("scene.cell", "scene.window.y.hi"):
        arguments += ["--set", "%s=%g mm" % (key, cell)]
    folder, _ = runs.run("slide_%g_%g" % (share, cell), arguments)
    files = sorted(glob.glob(os.path.join(folder, "scenes/scene/scene-*.hdf")))[-3:]
    faces = [Face(file, 1e-3 * cell) for file in files]
    means = [face.mean() + (face.closed_mean(max(share * RAYLEIGH, SLOW)),) for face in faces]
    return [sum(column) / len(means) for column in zip(*means)]


def row(share, cell, found, rest):
    """found, rest: of `passage`, at this speed and at rest on cells of 1 mm."""
    half, speed = [-0.5 * LENGTH, 0.5 * LENGTH], max(share * RAYLEIGH, SLOW)
    strain, stress = closed(half, [PRESSURE], speed, 0.0, 0.5e-3 * cell)
    at_rest = closed(half, [PRESSURE], SLOW, 0.0, 0.5e-3)[0]
    off = found[1] / strain - 1
    ratio, wanted = ("%.2f" % (a / b) if cell == 1 else "" for a, b in ((found[1], rest[1]), (strain, at_rest)))
    return ["%g; %g mm" % (share, cell), "%.2f" % factor(speed), "%.2f" % (stress / PRESSURE),
            "%.2f" % (found[0] / PRESSURE), wanted, ratio, "%+.1f" % (100 * off),
            "%+.1f" % (100 * (found[1] / found[2] - 1)), "yes" if abs(off) < 0.1 else "no"]


def slide(runs):
    found = {of: passage(runs, *of) for of in PASSAGES}
    rows = [row(*of, found[of], found[PASSAGES[0]]) for of in PASSAGES]
    return [Table(COLUMNS, rows)], "cases/verification/moving_load, velocity of the slide varied"
