# SPDX-License-Identifier: BSD-3-Clause
"""python3 -m breech DIR: what is in an output directory, in a few lines."""
import os
import sys

from .results import describe

if len(sys.argv) != 2:
    sys.exit("usage: python3 -m breech DIR")
try:
    describe(sys.argv[1])
    sys.stdout.flush()
except (FileNotFoundError, ImportError) as error:
    sys.exit(str(error))
except BrokenPipeError:  # who reads has seen enough, as `| head`
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
