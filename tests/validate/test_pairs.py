#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Order of pairs: ranks, Kendall's tau and the null models, by closed values."""
import math

import null_models
import part_pairs


def close(a, b, share=1e-6):
    return abs(a - b) <= share * abs(b)


def test_ranks():
    apart = [(1.0, 2.0), (3.0, 4.0), (5.0, 6.0)]
    assert [part_pairs.rank_range(apart, i) for i in range(3)] == [(1, 1), (2, 2), (3, 3)]
    over = [(1.0, 3.5), (3.0, 4.0), (5.0, math.inf)]
    assert [part_pairs.rank_range(over, i) for i in range(3)] == [(1, 2), (1, 2), (3, 3)]
    assert part_pairs.order([700.0, 500.0, 900.0]) == [2, 1, 3]


def test_tau():
    tau = part_pairs.kendall_tau
    assert tau([1, 2, 3, 4], [10, 20, 30, 40]) == 1.0 and tau([1, 2, 3, 4], [4, 3, 2, 1]) == -1.0
    assert close(tau([1, 2, 3, 4], [2, 1, 3, 4]), 4 / 6)  # one of six pairs the wrong way round
    assert tau([1, 2, 2], [1, 2, 3]) == 2 / 3  # an equal pair counts for neither
    sure = part_pairs.tau_within([(1, 2), (3, 4), (5, 6)], [1, 2, 3])
    assert sure == (1.0, 1.0, 1.0)
    middle, low, high = part_pairs.tau_within([(0, 10), (0.1, 10.1)], [1, 2])
    assert middle == 1.0 and (low, high) == (-1.0, 1.0)  # the two may stand either way round


def test_null_models():
    a, b = null_models.CALIBRATION
    assert all(close(v, null_models.MEASURED) for v in null_models.velocities(a, b))
    harder = [{**m, "hardness": 2 * m["hardness"]} for m in (a, b)]
    n1, n2, n3 = null_models.velocities(*harder)
    assert close(n2, math.sqrt(2) * null_models.MEASURED) and close(n3, math.sqrt(2) * null_models.MEASURED)
    assert close(null_models.planar_pressure(a, b, n1), 2 * null_models.planar_pressure(a, b, null_models.MEASURED))
    # two equal metals: each takes half of the velocity, so p = rho (c + s v/2) v/2
    half = 500.0
    assert close(null_models.planar_pressure(b, b, 2 * half),
                 b["density"] * (b["sound_speed"] + b["slope"] * half) * half)


def main():
    test_ranks()
    test_tau()
    test_null_models()
    print("ranks, tau and null models as they should be")


if __name__ == "__main__":
    main()
