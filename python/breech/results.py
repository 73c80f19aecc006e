# SPDX-License-Identifier: BSD-3-Clause
"""What Breech wrote: an output directory, a scene store.

    run = breech.Run("out/default_shot")
    run.summary["muzzle_velocity"]             # summary.json as it is
    run.shot["velocity"], run.shot.units["velocity"]
    for name in run.scenes:                    # time series of every scene, crater of those that ran to their end
        print(name, run.scene(name)["peak_pressure"].max(), run.crater(name) and run.crater(name).depth.max())
    run.body("scene", "ball"), run.probe("scene", "push")  # of a scene of bodies
    for time, points in run.snapshots(name):   # material points: points["position"], points["damage"], ...
        ...
    for scene in breech.store("out/default_shot/store"):
        print(scene.key, scene.outcome["class"], scene.case.splitlines()[1])

All numbers are in SI units.  Whoever reads while a run goes on gets the last complete state.
"""
import functools
import json
from pathlib import Path

from .needs import h5py, numpy as np


def _text(value):
    return value.decode() if isinstance(value, bytes) else str(value)


class Columns(dict):
    """The series of a group as arrays, time along the first axis, with .units and .descriptions by name."""

    def __init__(self, group, dimensions=(1,)):
        sets = {name: item for name, item in group.items()
                if isinstance(item, h5py.Dataset) and item.ndim in dimensions and item.dtype.kind in "fi"}
        super().__init__({name: item[()] for name, item in sets.items()})
        self.units = {name: _text(item.attrs.get("units", "")) for name, item in sets.items()}
        self.descriptions = {name: _text(item.attrs.get("description", "")) for name, item in sets.items()}


class Crater:
    """depth[i, k] [m] below the undamaged surface at x[i], z[k] [m], the rim negative; numbers: length_m, severity, ..."""

    def __init__(self, group):
        self.x, self.z, self.depth = (group[name][()] for name in ("x", "z", "depth"))
        self.numbers = {name: float(value) for name, value in group.attrs.items() if not isinstance(value, bytes)}
        self.texts = {name: _text(value) for name, value in group.attrs.items() if isinstance(value, bytes)}

    def profile(self):
        """Height along the middle, the two rows beside z = 0 averaged [m]."""
        n = self.depth.shape[1]
        return -0.5 * (self.depth[:, (n - 1) // 2] + self.depth[:, n // 2])


class Run:
    """An output directory.  summary: summary.json, read when it is first asked for; a run writes it at its end."""

    def __init__(self, directory):
        self.directory = Path(directory)
        if not self.directory.is_dir():
            raise FileNotFoundError(f"{directory}: there is no such directory")
        if not any((self.directory / name).exists() for name in ("summary.json", "history.h5", "used.yaml")):
            raise FileNotFoundError(f"{directory} holds no run: neither summary.json nor history.h5 nor used.yaml")

    @functools.cached_property
    def summary(self):
        """summary.json as dicts and lists.

        Of compare, ["verdict"] says which surface is best and which cannot be told from it.  ["ranking"] lists the surfaces by
        "gouges", the expected number a shot, fewest first; of equals the one first that reaches its threshold later along the
        barrel.  None: it has grains that no scene was run for; where they may gouge it comes last.
        "tied" is 1 for every surface that cannot be told from the best; of any other it is the rank of the best of its group.  "worse_than_best": share of what may be true in which the best has fewer gouges.  "onset_position": place of
        the first grain that gouges [m], with populations the median; None: no gouging.  It does not rank.
        """
        return json.loads(self._file("summary.json").read_text())

    def _file(self, name):
        path = self.directory / name
        if not path.exists():
            raise FileNotFoundError(f"{path} is not there: the run goes on, or ended before it wrote that")
        return path

    def _scene_known(self, name):
        if name not in self.scenes:
            raise KeyError(f"{self.directory} has no scene `{name}`; it has: {', '.join(self.scenes) or 'none'}")

    def _columns(self, group, dimensions=(1,)):
        with h5py.File(self._file("history.h5"), "r") as f:
            return Columns(f[group], dimensions)

    def _names(self, group):
        with h5py.File(self._file("history.h5"), "r") as f:
            return [name for name, item in f.get(group, {}).items() if isinstance(item, h5py.Group)]

    @property
    def shot(self):
        return self._columns("/shot")

    @property
    def events(self):
        return self._columns("/shot/events")

    @property
    def modules(self):
        """Current and voltage of one module of each group of the supply: current_000, voltage_000, ..."""
        return self._columns("/shot/modules")

    @property
    def scenes(self):
        return self._names("scene")

    def scene(self, name):
        """Time series of a scene, Columns: arrays by name, with .units and .descriptions; .scenes lists the names."""
        self._scene_known(name)
        return self._columns(f"/scene/{name}")

    def bodies(self, name):
        return self._names(f"scene/{name}/bodies")

    def body(self, name, body):
        """Mass, place, velocity and energy of a body of a scene, with the time."""
        columns = self._columns(f"/scene/{name}/bodies/{body}")
        time = self._columns(f"/scene/{name}/bodies")
        for mine, its in zip((columns, columns.units, columns.descriptions), (time, time.units, time.descriptions)):
            mine["time"] = its["time"]
        return columns

    def probes(self, name):
        return self._names(f"scene/{name}/probes")

    def probe(self, name, probe):
        """What a probe noted; of a map of a surface (x, y, z) arrays of times and places."""
        return self._columns(f"/scene/{name}/probes/{probe}", (1, 2, 3))

    def crater(self, name):
        """The Crater of a scene (x, z, depth, numbers, texts, profile()); None of one that ended once its groove's growth was
        known, as every scene of a study with study.craters = 0."""
        self._scene_known(name)
        with h5py.File(self._file("history.h5"), "r") as f:
            return Crater(f[f"/scene/{name}/crater"]) if f"/scene/{name}/crater" in f else None

    def snapshots(self, name):
        """(time, points) of every snapshot, one after the other: points is a dict of arrays by name."""
        folder = self.directory / "scenes" / name
        index = folder / "scene.hdf.series"
        for entry in json.loads(index.read_text())["files"] if index.exists() else []:
            yield entry["time"], snapshot(folder / entry["name"])


def snapshot(path):
    """The material points of one snapshot file."""
    with h5py.File(path, "r") as f:
        root = f["VTKHDF"]
        return {"position": root["Points"][()], **{name: item[()] for name, item in root["PointData"].items()}}


class StoredScene:
    """A file of a scene store: key, case (a case file of this scene), outcome (as in summary.json), columns, crater.

    A scene of bodies has None for outcome, impulse and mass_loss, which are a grain's on the rail.
    """

    def __init__(self, path):
        self.path, self.key = Path(path), Path(path).stem
        with h5py.File(path, "r") as f:
            self.version, self.instruction_set = (_text(f.attrs[name]) for name in ("version", "instruction_set"))
            self.case = _text(f.attrs["case"] if "case" in f.attrs else bytes(f["case"][()]))
            self.outcome = json.loads(_text(f.attrs["outcome"])) if "outcome" in f.attrs else None
            self.impulse, self.mass_loss = (float(f.attrs[name]) if name in f.attrs else None
                                            for name in ("impulse_N_s", "mass_loss_kg"))
            self.columns = Columns(f["scene"]) if "scene" in f else None
            self.crater = Crater(f["scene/crater"]) if "scene/crater" in f else None


def store(directory):
    """Every scene of a store, by key."""
    return [StoredScene(path) for path in sorted(Path(directory).glob("*.h5"))]


def _cell(value):
    return "-" if value is None else f"{value:.4g}" if isinstance(value, float) else str(value)


def _print_ranking(ranking):
    """The surfaces of compare, best first: gouges or life with their intervals."""
    columns = [name for name in ("surface", "tied", "gouges", "gouges_interval", "threshold_velocity", "threshold_interval",
                                 "onset_position", "life", "life_quantiles", "worse_than_best")
               if any(one.get(name) not in (None, [None, None, None]) for one in ranking)]
    rows = [columns] + [[" .. ".join(map(_cell, one[name])) if isinstance(one[name], list) else _cell(one[name])
                         for name in columns] for one in ranking]
    widths = [max(map(len, column)) for column in zip(*rows)]
    for row in rows:
        print("  ".join(f"{cell:{width}}" for cell, width in zip(row, widths)).rstrip())


def describe(directory):
    """Prints what is in an output directory."""
    run = Run(directory)
    shown = {name: value for name, value in run.summary.items() if not isinstance(value, (list, dict))}
    width = max(map(len, shown), default=0)
    for name, value in shown.items():
        print(f"{name:{width}}  {value}")
    if run.summary.get("ranking"):
        _print_ranking(run.summary["ranking"])
    if not (run.directory / "history.h5").exists():
        return
    for name in run.scenes:
        crater = run.crater(name)
        bodies = run.bodies(name)
        shape = (f"{crater.texts['class']}, depth {1e3 * np.max(crater.depth):.3f} mm" if crater
                 else f"bodies {', '.join(bodies)}" if bodies else "until its second gauge")
        print(f"scene {name}: {shape}, "
              f"{len(run.scene(name)['time'])} rows, {sum(1 for _ in run.snapshots(name))} snapshots")

