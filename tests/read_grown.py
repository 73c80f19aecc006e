# SPDX-License-Identifier: BSD-3-Clause
"""Run by test_gauged: the crater's map of a scene whose cells have grown is twice as wide as with cells of one size, its
own cells are the same.   read_grown.py PYTHON DIR_ONE_SIZE DIR_GROWN"""
import sys

sys.path.insert(0, sys.argv[1])
import breech

one, grown = (breech.Run(directory).crater("scene") for directory in sys.argv[2:])
assert abs((grown.z[-1] / one.z[-1]) / 2 - 1) < 0.02, (one.z[-1], grown.z[-1])
for axis in ("x", "z"):
    step = [getattr(crater, axis)[1] - getattr(crater, axis)[0] for crater in (one, grown)]
    assert abs(step[1] / step[0] - 1) < 0.01, (axis, step)
# the rail is there to its sides: where no point was looked at the depth is 0
assert (grown.depth[:, -1] != 0).any() and abs(grown.depth[:, -1]).max() < 0.05e-3
