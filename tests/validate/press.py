# SPDX-License-Identifier: BSD-3-Clause
"""The lattice of cases/lattice_target between two plates: a specimen, and one cell of it that its neighbours hold."""
import glob
import math
import os

from breech.needs import h5py, numpy as np

CASE = "cases/lattice_target/compression.yaml"
NETS = ("open", "full")
PARTS, AREA, CORE = 4, 900e-6, 15e-3  # of the specimen: the whole over what is computed, its face [m2], its core [m]
CELL = 5e-3
CRUSH, SLOW = "cases/lattice_target/crush.yaml", 20  # a column of one cell; velocity at which inertia is nothing [m/s]
SOLID, DENSITY = {"open": 0.248, "full": 0.318}, 4430.0  # fraction of a net that is metal; of the metal [kg/m3]
CRUSHED = (0.05, 0.4)  # strains over which the stress of a crush is a mean
WINDOW = 9.6e-6  # mean of the force: how long a wave takes to go through the core and back [s]
COLUMN = {"scene__window__y": "{lo: 0 mm, hi: 2.5 mm, fine_lo: 0 mm, fine_hi: 2.5 mm}",
          "scene__window__z": "{lo: 0 mm, hi: 2.5 mm, fine_lo: 0 mm, fine_hi: 2.5 mm}",
          "scene__boundary__y": "[symmetry, symmetry]", "scene__boundary__z": "[symmetry, symmetry]",
          "output__snapshots": 21}
# Periodic frame of the sheet, no, half and full offset at the nodes [GPa, 1, MPa].
FRAME = {"open": {"E": (1.53, 5.41), "nu": (0.32, 0.37), "collapse": (36, 69)},
         "full": {"E": (2.52, 9.38), "nu": (0.35, 0.42), "collapse": (53, 104)}}


def lattice(net, side):
    """side: half of it [mm]"""
    return "{lattice_%s: {lo: 0.5 -%g -%g mm, hi: 15.5 %g %g mm, cell: 5 mm, radius: 0.5 mm}}" % (net, *4 * (side,))


def run(runs, name, case, net, shape, **more):
    """The folder of the run: its history and snapshots."""
    settings = {"output__report": "no", **more}
    if net != "open":
        settings["scene__bodies[1]__shape"] = shape
    arguments = ["scene", case]
    for key, value in settings.items():
        arguments += ["--set", "%s=%s" % (key.replace("__", "."), value)]
    folder, _ = runs.run(name, arguments)
    return folder


def pressed_run(runs, name, net, cell, **more):
    return run(runs, name, CASE, net, lattice(net, 15), scene__cell="%.9g mm" % cell, **more)


def curve(folder, parts):
    """How far the plates have come together [m], and the force, mean over WINDOW [N]."""
    with h5py.File(os.path.join(folder, "history.h5")) as file:
        scene = file["scene/scene"]
        push, plate, clock = scene["probes/push"], scene["bodies/plate/position_x"][:], scene["bodies/time"][:]
        time, force = push["time"][:], -parts * push["force_x"][:]
    sums = np.concatenate([[0], np.cumsum(force[1:] * np.diff(time))])
    at = np.arange(0.5 * WINDOW, time[-1] - 0.5 * WINDOW, 0.5e-6)
    mean = (np.interp(at + 0.5 * WINDOW, time, sums) - np.interp(at - 0.5 * WINDOW, time, sums)) / WINDOW
    return 2 * (np.interp(at, clock, plate) - plate[0]), mean


def points(path, body):
    """Place now and at the start, stress, volume of a body's points."""
    with h5py.File(path) as file:
        root = file["VTKHDF"]
        data, mine = root["PointData"], root["PointData/body"][:] == body
        volume = data["mass"][:] / data["density"][:]
        return (root["Points"][:][mine], data["start"][:][mine], data["stress"][:][mine], volume[mine])


def snapshots(folder):
    return sorted(glob.glob(os.path.join(folder, "scenes", "scene", "*.hdf")))


def held_cell(runs, net, cell, **more):
    """E [GPa], nu, of a cell between mirrors, of the core's mean stresses at strains of 0.3 .. 0.8 %; highest mean
    stress along the press [MPa]."""
    folder = pressed_run(runs, "press_cell_%s_%g" % (net, cell), net, cell, **{**COLUMN, **more})
    gap, force = curve(folder, 1)
    strain = gap / CORE
    area, sums = 0.25 * CELL ** 2, np.zeros(3)
    clock = [0.5 * WINDOW + 0.5e-6 * k for k in range(len(gap))]
    for path in snapshots(folder):
        with h5py.File(path) as file:
            e = np.interp(file["VTKHDF/FieldData/time"][0], clock, strain)
        place, _, stress, volume = points(path, 1)
        inside = place[:, 0] > 0.5e-3 + 0.5 * CORE * e  # of the face of the sheet as it moves
        mean = (stress[inside, :3] * volume[inside, None]).sum(axis=0) / (area * 0.5 * CORE * (1 - e))
        if 0.003 < e < 0.008:
            sums += (-mean[0] * e, -0.5 * (mean[1] + mean[2]) * e, e * e)
    along, across = sums[0] / sums[2], sums[1] / sums[2]
    youngs = (along - across) * (along + 2 * across) / (along + across)
    return 1e-9 * youngs, across / (along + across), 1e-6 * force.max() / area


def specimen(runs, net, cell=0.4, **more):
    """E [GPa], first maximum of the mean stress [MPa] and its strain, where it spreads most [of its height], how far
    [mm], its curve (gap [m], force [N])."""
    settings = {"scene__end_time": "75 us", "output__snapshots": 3, **more}
    folder = pressed_run(runs, "press_%s_%g" % (net, cell), net, cell, **settings)
    gap, force = curve(folder, PARTS)
    strain, stress = gap / CORE, force / AREA
    low = (strain > 0.003) & (strain < 0.008)
    youngs = np.polyfit(strain[low], stress[low], 1)[0]
    top = int(np.argmax(stress))
    place, start, _, _ = points(snapshots(folder)[-1], 1)
    out = np.maximum(place[:, 1] - start[:, 1], place[:, 2] - start[:, 2])
    layers = [(h, out[np.abs(start[:, 0] - h) < 0.5e-3].max()) for h in np.arange(1e-3, 8e-3, 1e-3)]
    where, far = max(layers, key=lambda layer: layer[1])
    return {"E": 1e-9 * youngs, "top": 1e-6 * stress[top], "at": strain[top], "last": strain[-1], "height": where / 16e-3,
            "spread": 1e3 * far, "curve": (gap, force)}


def hammer(curve_of, mass, heights):
    """Peak deceleration [m/s2] of a hammer that falls from these heights [m]: the largest force until the work of the
    slow press is its energy; NAN where the press did not go so far."""
    gap, force = curve_of
    work = np.concatenate([[0], np.cumsum(0.5 * (force[1:] + force[:-1]) * np.diff(gap))])
    highest = np.maximum.accumulate(force)
    found = []
    for height in heights:
        energy = mass * 9.81 * height
        found.append(np.interp(energy, work, highest) / mass if energy < work[-1] else math.nan)
    return found


def crush(runs, net, velocity):
    """Mean stress on a plate that comes with this velocity [m/s], over the strains CRUSHED of the core [MPa]."""
    lasts = (1.4 if velocity == SLOW else 1.12) * CRUSHED[1] * CORE / velocity  # the slow plate is slowed down
    folder = run(runs, "crush_%s_%g" % (net, velocity), CRUSH, net, lattice(net, 5),
                 **{"scene__bodies[2]__velocity": "%g 0 0 m/s" % velocity, "scene__end_time": "%.9g us" % (1e6 * lasts)})
    with h5py.File(os.path.join(folder, "history.h5")) as file:
        scene = file["scene/scene"]
        push, plate, clock = scene["probes/push"], scene["bodies/plate/position_x"][:], scene["bodies/time"][:]
        time, force = push["time"][:], -push["force_x"][:]
    strain, step = (np.interp(time, clock, plate) - plate[0]) / CORE, np.diff(time, prepend=0.0)
    among = (strain > CRUSHED[0]) & (strain < CRUSHED[1])
    assert strain[-1] > 0.99 * CRUSHED[1], "the plate came to a strain of %g" % strain[-1]
    return 1e-6 * np.average(force[among], weights=step[among]) / (0.25 * CELL ** 2)


def shock(net, velocity):
    """What a front of crushed core adds to the stress, one that takes it to its densification strain [MPa]."""
    return 1e-6 * SOLID[net] * DENSITY * velocity ** 2 / (1 - 1.4 * SOLID[net])
