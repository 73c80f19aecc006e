# SPDX-License-Identifier: BSD-3-Clause
"""Do two files of history hold the same datasets and attributes, to the bit?    tests/same_history.py FILE FILE"""
import sys

import h5py


def contents(path):
    found = {}

    def see(name, item):
        found[name] = sorted((key, str(value)) for key, value in item.attrs.items())
        if isinstance(item, h5py.Dataset):
            found[name] += [item[()].tobytes() if item.dtype.kind in "fiu" else str(item[()])]

    with h5py.File(path) as file:
        file.visititems(see)
    return found


one, other = (contents(path) for path in sys.argv[1:3])
differ = [name for name in sorted(set(one) | set(other)) if one.get(name) != other.get(name)]
if differ or not one:
    sys.exit("differ: " + ", ".join(differ))
