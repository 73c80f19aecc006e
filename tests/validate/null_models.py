# SPDX-License-Identifier: BSD-3-Clause
"""Null models N1 - N3 of docs/theory/onset.md, written a second time, from constants of `breech materials`.

They check what the program says, and serve for a pair that it refuses because a scene would need more."""
import math
import subprocess

from runs import ROOT

MEASURED = 1325.0  # [m/s] 7075 on copper
CALIBRATION = (dict(density=2804.0, sound_speed=5200.0, slope=1.36, hardness=1.7e9),
               dict(density=8960.0, sound_speed=3940.0, slope=1.489, hardness=0.725e9))
UNITS = {"kg/m^3": 1.0, "m/s": 1.0, "km/s": 1e3, "Pa": 1.0, "MPa": 1e6, "GPa": 1e9}
KEYS = {"density": "density", "sound_speed": "sound_speed", "hugoniot_slope": "slope", "hardness": "hardness"}


def constants(breech, material):
    """Those of KEYS, in SI, as `breech materials NAME` prints them."""
    told = subprocess.run([breech, "materials", material], cwd=ROOT, capture_output=True, text=True, check=True).stdout
    found = {}
    for line in told.splitlines():
        words = line.split()
        if words and words[0] in KEYS and line.startswith("  ") and len(words) > 2:
            found[KEYS[words[0]]] = float(words[1]) * UNITS.get(words[2], 1.0)
    return found


def planar_pressure(a, b, velocity):
    """Of a on b at rest: the pressure at which both shocks have it [Pa]."""
    def shock(m, u):
        return m["density"] * (m["sound_speed"] + m["slope"] * u) * u
    low, high = 0.0, velocity
    for _ in range(200):
        u = 0.5 * (low + high)
        low, high = (u, high) if shock(b, u) < shock(a, velocity - u) else (low, u)
    return shock(b, u)


def velocity_at_ratio(a, b, ratio):
    """Where the planar pressure is so many times the hardness of the harder one [m/s]."""
    hardness = max(a["hardness"], b["hardness"])
    low, high = 0.0, 2e4
    while high - low > 1e-3:
        v = 0.5 * (low + high)
        low, high = (v, high) if planar_pressure(a, b, v) < ratio * hardness else (low, v)
    return high


def n1(a, b):
    x, y = CALIBRATION
    return velocity_at_ratio(a, b, planar_pressure(x, y, MEASURED) / max(x["hardness"], y["hardness"]))


def bernoulli(a, b):
    return (1 + math.sqrt(b["density"] / a["density"])) * math.sqrt(max(a["hardness"], b["hardness"]) / b["density"])


def hardness_over_density(a, b):
    return math.sqrt((a["hardness"] + b["hardness"]) / (a["density"] + b["density"]))


def velocities(a, b):
    """N1, N2, N3 [m/s] of armature a on rail b."""
    return [n1(a, b)] + [MEASURED * of(a, b) / of(*CALIBRATION) for of in (bernoulli, hardness_over_density)]
