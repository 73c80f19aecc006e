# SPDX-License-Identifier: BSD-3-Clause
"""Every dataset of a history carries units and a description; series of one group are equally long."""
import sys

import h5py


def check(path):
    groups = {}
    with h5py.File(path, "r") as f:
        def visit(name, item):
            if not isinstance(item, h5py.Dataset):
                return
            for attribute in ("units", "description"):
                text = item.attrs[attribute]
                assert len(text) > 0, f"{name}: empty {attribute}"
            if "/crater/" not in name:
                groups.setdefault(item.parent.name, set()).add(item.shape)
        f.visititems(visit)
        for group, shapes in groups.items():
            assert len(shapes) == 1, f"{group}: columns of different length {shapes}"
        depth = f["/scene/v1500/crater/depth"]
        assert depth.shape == (len(f["/scene/v1500/crater/x"]), len(f["/scene/v1500/crater/z"]))
        said = f["/scene/v1500/crater"].attrs
        assert said["class"] == b"gouge" and said["reason"] == b"grows"
        assert said["crater_class"] == b"scratch" and said["crater_reason"] == b"ends"
        assert f["/scene/v1500/crater"].attrs["severity"] == 0.5
    assert {"/shot", "/shot/events", "/scene/v1500"} <= set(groups), groups


check(sys.argv[1])
