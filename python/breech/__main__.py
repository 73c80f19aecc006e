# SPDX-License-Identifier: BSD-3-Clause
"""python3 -m breech DIR: what is in an output directory, in a few lines."""
import sys

from .results import describe

if len(sys.argv) != 2:
    sys.exit("usage: python3 -m breech DIR")
describe(sys.argv[1])
