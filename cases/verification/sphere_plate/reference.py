#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""An elastic ball on a thin elastic plate without ends (Zener, Physical Review 59 (1941) 669).

Hertz's force drives the ball, and flexural waves carry energy off in the plate, which moves under a force F with
w' = F / (8 sqrt(D rho h)):   m x'' = -F,   F = K s^1.5,   s' = x' - w'.  Prints a quarter of the force and its impulse.
"""
from math import pi, sqrt

E, NU, RHO = 1e9, 0.33, 1000.0  # [Pa, 1, kg/m3]
R, H, V = 10e-3, 8e-3, 8.0

plane = E / (1 - NU**2)
m = 4 / 3 * pi * R**3 * RHO
K = 4 / 3 * (plane / 2) * sqrt(R)
mobility = 1 / (8 * sqrt(plane * H**3 / 12 * RHO * H))


def change(s, v):
    force = K * max(s, 0.0)**1.5
    return v - mobility * force, -force / m


s, v, t, dt, peak = 0.0, V, 0.0, 1e-8, 0.0
while s >= 0 or t == 0:
    s1, v1 = change(s, v)
    s2, v2 = change(s + dt / 2 * s1, v + dt / 2 * v1)
    s, v, t = s + dt * s2, v + dt * v2, t + dt
    peak = max(peak, K * max(s, 0.0)**1.5)
print(f"peak force / 4 {peak / 4:.2f} N, impulse / 4 {m * (V - v) / 4:.6f} N s, ball leaves at {-v:.4f} m/s "
      f"(restitution {-v / V:.4f}) after {1e6 * t:.1f} us")
