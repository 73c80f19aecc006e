# SPDX-License-Identifier: BSD-3-Clause
"""A clamped plate in one mode at the end of a tube of water: a program of its own beside cases/underwater_shock.

Water in one dimension, cells that move with it, Tait's law, no tension; a piston drives it.  The plate is a membrane of
a rigid, plastic metal that takes the shape W (1 - r^2/R^2): its area grows by pi W^2, so its strain is W^2/R^2 and its
work sigma t pi W^2; its mean displacement U = W/2 has 4/3 of its mass and meets the pressure 8 sigma t U/R^2.  It does
not come back."""
import math

PISTON, VELOCITY, LENGTH = 73.98, 22.94, 1.3  # [kg/m2, m/s, m]
DENSITY, SPEED, EXPONENT = 1000.0, 1480.0, 4 * 1.92 - 1  # Tait's with the slope of us = c0 + 1.92 u
LINEAR, QUADRATIC = 0.06, 2.0  # viscosity
RADIUS, THICK, METAL = 32e-3, 1.2e-3, 2700.0
YIELD, HARDENING, POWER = 167e6, 596e6, 0.551  # aa5083_h116, slow and cold


def flow(strain):
    return YIELD + HARDENING * strain ** POWER


def resistance(mean):
    """Pressure that the membrane holds at this mean displacement [Pa]."""
    return 8 * flow((2 * mean / RADIUS) ** 2) * THICK * mean / RADIUS ** 2


def deflection(first_blow_only=False, strength=1.0, cells=1300, until=300e-6):
    """Largest of the plate's middle [m].  first_blow_only: water acts until the pressure on the plate is first gone.
    strength: factor on the flow stress."""
    stiff, dx = DENSITY * SPEED ** 2 / EXPONENT, LENGTH / cells
    x, v, push = [i * dx for i in range(cells + 1)], [0.0] * (cells + 1), [0.0] * cells
    mass = [DENSITY * dx] * (cells + 1)
    mass[0] = 0.5 * DENSITY * dx + PISTON
    mass[-1] = 0.5 * DENSITY * dx + 4 / 3 * METAL * THICK
    v[0], dt, t, arrival, front, parted, most = VELOCITY, 0.25 * dx / SPEED, 0.0, math.inf, 2, False, 0.0
    while t < arrival + until:
        for i in range(front):
            v[i] += dt * ((push[i - 1] if i else 0.0) - push[i]) / mass[i]
        if front == cells:
            parted = parted or (first_blow_only and most > 0 and push[-1] <= 0)
            net = (0.0 if parted else push[-1]) - strength * resistance(max(x[-1] - LENGTH, 0.0))
            v[-1] = max(v[-1] + dt * net / mass[-1], 0.0)
        for i in range(front + 1):
            x[i] += dt * v[i]
        for i in range(front):
            squeeze, ratio = v[i] - v[i + 1], dx / (x[i + 1] - x[i])
            p = stiff * (ratio ** EXPONENT - 1)
            if p > 0 and squeeze > 0:
                p += DENSITY * ratio * squeeze * (LINEAR * SPEED * ratio ** (0.5 * EXPONENT - 0.5) + QUADRATIC * squeeze)
            push[i] = max(p, 0.0)
        t += dt
        most = max(most, x[-1] - LENGTH)
        if front < cells and push[front - 1] > 1.0:
            front += 1
        if arrival == math.inf and push[-1] > 1e6:
            arrival = t
    return 2 * most


if __name__ == "__main__":
    for only in (False, True):
        print("%-18s %.2f mm" % ("first blow only" if only else "with all water", 1e3 * deflection(only)))
