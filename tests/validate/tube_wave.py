# SPDX-License-Identifier: BSD-3-Clause
"""The wave of a piston down a tube of water that goes on, in one dimension: the tube of membrane.py without its plate."""
import math

from membrane import DENSITY, EXPONENT, LINEAR, QUADRATIC, SPEED

from breech.needs import numpy as np


def wave_at(distance, piston, velocity, cell=0.5e-3, after=350e-6):
    """First pressure of the piston's wave so far down a tube that goes on [MPa]; time in which it falls to 1/e of that
    there [us]; NaN: longer than `after` [s].  Behind the front it rings by some %: the first pressure is that of an
    exponential through 5 .. 25 us later, carried back to when half of the largest has come."""
    stiff, end = DENSITY * SPEED ** 2 / EXPONENT, distance / SPEED + after
    cells = round((distance + 1.1 * SPEED * after) / cell)
    x, v, mass = cell * np.arange(cells + 1.0), np.zeros(cells + 1), np.full(cells + 1, DENSITY * cell)
    v[0], mass[0] = velocity, 0.5 * DENSITY * cell + piston
    dt, seen, push = 0.25 * cell / SPEED, [], np.zeros(cells)
    for _ in range(round(end / dt)):
        v[0] -= dt * push[0] / mass[0]
        v[1:-1] += dt * (push[:-1] - push[1:]) / mass[1:-1]
        x += dt * v
        ratio, squeeze = cell / np.diff(x), np.maximum(v[:-1] - v[1:], 0)
        push = stiff * (ratio ** EXPONENT - 1)
        push += DENSITY * ratio * squeeze * (LINEAR * SPEED * ratio ** (0.5 * EXPONENT - 0.5) + QUADRATIC * squeeze)
        push = np.maximum(push, 0)
        seen.append(push[round(distance / cell)])
    p, t = np.array(seen), dt * np.arange(len(seen))
    front = np.argmax(p > 0.5 * p.max())
    later = (t > t[front] + 5e-6) & (t < t[front] + 25e-6)
    _, start = np.polyfit(t[later] - t[front], np.log(p[later]), 1)
    fallen = np.flatnonzero(p[front:] > math.exp(start - 1))[-1] + 1
    return 1e-6 * math.exp(start), 1e6 * dt * fallen if front + fallen < len(p) else math.nan
