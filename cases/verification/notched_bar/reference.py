#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The notched bar by finite elements, for expected.yaml: a quarter of it, plane strain, elements of nine nodes.
Needs numpy; half a minute.  In-plane stresses of a bar without holes do not depend on its constants (Michell).

Prints, for each mesh, the stress at the root over the net stress and the mean over the probe's box over the far stress."""
import numpy as np

R, H, L = 1.0, 5.0, 16.0  # notch, half width, length [mm]; the far stress is 1
NU = 0.29
BOX = (0.0625, 3.8, 4.0)  # x from 0 to the first, y between the others


def patch(corner, elements):
    """The elements of a grid of nodes, nine each."""
    for i in range(0, corner.shape[0] - 1, 2):
        for j in range(0, corner.shape[1] - 1, 2):
            elements.append(corner[i:i + 3, j:j + 3].ravel())


def mesh(n, grade=3.0):
    """4 n elements along the notch, 2 n from it to the sides of the square; 3 n along the rest."""
    along, out, points, elements = 4 * n + 1, 4 * n + 1, [], []
    graded = (np.exp(grade * np.linspace(0, 1, out)) - 1) / (np.exp(grade) - 1)
    square = np.zeros((along, out), int)
    for i, s in enumerate(np.linspace(0, 1, along)):
        root = np.array([R * np.sin(s * np.pi / 2), H - R * np.cos(s * np.pi / 2)])
        side = np.array([2 * s * H, 0.0]) if s <= 0.5 else np.array([H, (2 * s - 1) * H])
        for j, t in enumerate(graded):
            square[i, j] = len(points)
            points.append(root * (1 - t) + side * t)
    rest = np.zeros((6 * n + 1, along // 2 + 1), int)
    rest[0] = square[along // 2:, -1]
    for i, t in enumerate(np.linspace(0, 1, rest.shape[0])[1:], 1):
        for j in range(rest.shape[1]):
            rest[i, j] = len(points)
            points.append([H + t * (L - H), H * j / (rest.shape[1] - 1)])
    patch(square, elements)
    patch(rest, elements)
    return np.array(points), np.array(elements)


def lagrange(x):
    return np.array([x * (x - 1) / 2, 1 - x * x, x * (x + 1) / 2]), np.array([x - 0.5, -2 * x, x + 0.5])


def shapes(a, b):
    (p, dp), (q, dq) = lagrange(a), lagrange(b)
    return np.outer(p, q).ravel(), np.stack([np.outer(dp, q).ravel(), np.outer(p, dq).ravel()])


def elasticity():
    lam, mu = NU / ((1 + NU) * (1 - 2 * NU)), 0.5 / (1 + NU)
    return np.array([[lam + 2 * mu, lam, 0], [lam, lam + 2 * mu, 0], [0, 0, mu]])


def stiffness(x):
    """Of every element, 18 x 18, by 3 x 3 points of Gauss."""
    at, weight = np.array([-np.sqrt(0.6), 0, np.sqrt(0.6)]), np.array([5, 8, 5]) / 9
    k = np.zeros((len(x), 18, 18))
    for i in range(3):
        for j in range(3):
            d = shapes(at[i], at[j])[1]
            jacobian = np.einsum("ik,ekd->eid", d, x)
            grad = np.einsum("eij,jk->eik", np.linalg.inv(jacobian), d)
            b = np.zeros((len(x), 3, 18))
            b[:, 0, 0::2], b[:, 1, 1::2], b[:, 2, 0::2], b[:, 2, 1::2] = grad[:, 0], grad[:, 1], grad[:, 1], grad[:, 0]
            area = np.abs(np.linalg.det(jacobian)) * weight[i] * weight[j]
            k += np.einsum("eia,ij,ejb->eab", b, elasticity(), b) * area[:, None, None]
    return k


def solve(points, elements):
    """Displacements, by conjugate gradients: x = 0 and y = 0 are mirrors, the far end is pulled by 1."""
    k, n = stiffness(points[elements]), 2 * len(points)
    dof = np.stack([2 * elements, 2 * elements + 1], 2).reshape(len(elements), 18)
    load, free = np.zeros(n), np.ones(n)
    end = np.where(abs(points[:, 0] - L) < 1e-9)[0]
    end = end[np.argsort(points[end, 1])]
    for i in range(0, len(end) - 1, 2):
        load[2 * end[i:i + 3]] += (points[end[i + 2], 1] - points[end[i], 1]) * np.array([1, 4, 1]) / 6
    free[2 * np.where(abs(points[:, 0]) < 1e-9)[0]] = 0
    free[2 * np.where(abs(points[:, 1]) < 1e-9)[0] + 1] = 0
    diagonal = np.bincount(dof.ravel(), k[:, range(18), range(18)].ravel(), n)

    def times(v):
        return free * np.bincount(dof.ravel(), np.matmul(k, v[dof][:, :, None])[:, :, 0].ravel(), n)

    u, r = np.zeros(n), free * load
    z = p = r / diagonal
    rz, first = r @ z, r @ r
    while r @ r > 1e-22 * first:
        q = times(p)
        step = rz / (p @ q)
        u, r = u + step * p, r - step * q
        z = r / diagonal
        p, rz = z + (r @ z) / rz * p, r @ z
    return u


def stress_xx(x, u, a, b):
    """In an element with nodes x, displacements u, at a, b; and the area there."""
    d = shapes(a, b)[1]
    jacobian = d @ x
    g = np.linalg.solve(jacobian, d) @ u
    return (elasticity() @ np.array([g[0, 0], g[1, 1], g[0, 1] + g[1, 0]]))[0], abs(np.linalg.det(jacobian))


def box_mean(points, elements, u, order=9):
    """Of stress_xx over the metal in the probe's box, by points in the elements that lie there."""
    at, weight = np.polynomial.legendre.leggauss(order)
    force = area = 0.0
    for e in elements:
        x, ue = points[e], u.reshape(-1, 2)[e]
        if x[:, 0].min() > BOX[0] or x[:, 1].max() < BOX[1] or x[:, 1].min() > BOX[2]:
            continue
        for i in range(order):
            for j in range(order):
                place = shapes(at[i], at[j])[0] @ x
                if place[0] <= BOX[0] and BOX[1] <= place[1] <= BOX[2]:
                    s, a = stress_xx(x, ue, at[i], at[j])
                    force, area = force + s * a * weight[i] * weight[j], area + a * weight[i] * weight[j]
    return force / area


for n in (8, 16, 32):
    points, elements = mesh(n)
    u = solve(points, elements)
    root = stress_xx(points[elements[0]], u.reshape(-1, 2)[elements[0]], -1, -1)[0]
    print(f"{len(points)} nodes: Kt = {root * (H - R) / H:.4f}, box {box_mean(points, elements, u):.4f}", flush=True)
