# SPDX-License-Identifier: BSD-3-Clause
"""A snapshot is a VTKHDF 1.0 UnstructuredGrid as the format's description has it, with the values that the test wrote.

read_snapshot.py FILE.hdf PARTICLES TIME [FIELD ...]    one snapshot; the fields in the order of the particle list
read_snapshot.py FILE.hdf.series                        the index: its files are there, times rise
"""
import json
import os
import sys

import h5py
import numpy as np

WIDTHS = {"position": 3, "velocity": 3, "stress": 6, "size": 3, "start": 3}


def check_snapshot(path, n, time, fields):
    with h5py.File(path, "r") as f:
        root = f["VTKHDF"]
        assert list(root.attrs["Version"]) == [1, 0]
        kind = root.attrs.get_id("Type")
        text = kind.get_type()
        assert not text.is_variable_str() and text.get_cset() == h5py.h5t.CSET_ASCII, "Type: fixed-length ASCII"
        assert root.attrs["Type"] == b"UnstructuredGrid"
        for name in ("NumberOfPoints", "NumberOfCells", "NumberOfConnectivityIds"):
            assert root[name].shape == (1,) and root[name][0] == n, name
        assert root["Points"].shape == (n, 3) and root["Points"].dtype == np.float32
        assert (root["Connectivity"][:] == np.arange(n)).all()
        assert (root["Offsets"][:] == np.arange(n + 1)).all()
        assert root["Types"].dtype == np.uint8 and (root["Types"][:] == 1).all()
        assert root["FieldData/time"][0] == time
        if n >= 1000:
            assert root["Offsets"].compression == "gzip" and root["Offsets"].compression_opts == 1 and root["Offsets"].shuffle
            assert root["Points"].compression is None  # floats would shrink by a third only
        for data in [root["Points"], *root["PointData"].values()]:
            assert data.dtype == np.float32 and len(data) == n
            assert len(data.attrs["units"]) > 0 and len(data.attrs["description"]) > 0, data.name
        for index, name in enumerate(fields):
            data = root["Points"] if name == "position" else root["PointData"][name]
            width = WIDTHS.get(name, 1)
            want = np.arange(n)[:, None] * 128 + index * 8 + np.arange(width)[None, :]
            assert (data[()].reshape(n, width) == want).all(), name
        if fields:
            assert len(root["PointData"]) == len(fields) - 1


def check_series(path):
    with open(path, encoding="ascii") as f:
        index = json.load(f)
    assert index["file-series-version"] == "1.0"
    times = [entry["time"] for entry in index["files"]]
    assert len(times) == 3 and times == sorted(times)
    for entry in index["files"]:
        file = os.path.join(os.path.dirname(path), entry["name"])
        with h5py.File(file, "r") as f:
            assert f["VTKHDF/FieldData/time"][0] == entry["time"]


if sys.argv[1].endswith(".series"):
    check_series(sys.argv[1])
else:
    check_snapshot(sys.argv[1], int(sys.argv[2]), float(sys.argv[3]), sys.argv[4:])
