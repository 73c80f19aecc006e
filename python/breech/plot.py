# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of results; each function returns a matplotlib figure, which pyplot knows nothing of.  Debian: python3-matplotlib."""
from .needs import load, numpy as np

Figure = load("matplotlib.figure").Figure

COLOURS = {"not_reached": "0.8", "skipped": "0.6", "none": "tab:blue", "scratch": "tab:olive", "undecided": "tab:orange",
           "gouge": "tab:red"}


def shot(run):
    """Current and velocity over time, velocity and energies along the barrel."""
    s = run.shot
    inside = s["position"] < s["position"].max() - 1e-9  # what happens after the exit is another story
    ms = 1e3 * s["time"]
    end = min(np.count_nonzero(inside) + 1, len(ms))
    figure = Figure(figsize=(10, 4), layout="constrained")
    over_time, along = figure.subplots(1, 2)
    over_time.plot(ms[:end], 1e-3 * s["current"][:end], color="tab:blue")
    over_time.set(xlabel="time [ms]", ylabel="current [kA]")
    speed = over_time.twinx()
    speed.plot(ms[:end], s["velocity"][:end], color="tab:red")
    speed.set_ylabel("velocity [m/s]")
    over_time.yaxis.label.set_color("tab:blue")
    speed.yaxis.label.set_color("tab:red")
    for name, label in (("energy_kinetic", "motion"), ("heat_rails", "heat of rails"), ("heat_contact", "heat of contact"),
                        ("work_friction", "friction")):
        along.plot(s["position"][:end], 1e-3 * s[name][:end], label=label)
    along.set(xlabel="along the barrel [m]", ylabel="energy [kJ]")
    along.legend()
    return figure


def _line(axes, value, interval, colour, label):
    """A speed that a study found, with its interval; either end may be open."""
    if interval is None or value is None and interval == [None, None]:
        return
    low, high = axes.get_ylim()
    ends = [low if interval[0] is None else interval[0], high if interval[1] is None else interval[1]]
    axes.axhspan(*ends, color=colour, alpha=0.12, linewidth=0)
    if value is not None:
        axes.axhline(value, color=colour, label=f"{label}: {value:.0f} m/s")
    axes.set_ylim(low, high)


def threshold(run):
    """Of a run of onset: v(x) of the shot, the sites by outcome, and the speeds from which grooves grow and gouge.
    Of a run of compare: the threshold of each surface with its interval, the best on top."""
    return _thresholds_of_surfaces(run) if run.summary["kind"] == "compare" else _threshold_along(run)


def _threshold_along(run):
    s, found = run.shot, run.summary
    figure = Figure(figsize=(7, 4.5), layout="constrained")
    axes = figure.subplots()
    last = int(np.argmax(s["position"])) + 1
    axes.plot(s["position"][:last], s["velocity"][:last], color="0.3", label="the shot")
    axes.set_ylim(bottom=0)
    for outcome, colour in COLOURS.items():
        sites = [site for site in found["sites"] if site["outcome"] == outcome and site["velocity"] is not None]
        if sites:
            axes.plot([site["position"] for site in sites], [site["velocity"] for site in sites], "o", color=colour,
                      label=outcome)
    _line(axes, found["threshold_velocity"], found["threshold_interval"], "tab:red", "gouges from")
    _line(axes, found.get("scratch_velocity"), found.get("scratch_interval"), "tab:olive", "grooves grow from")
    axes.set(xlabel="along the barrel [m]", ylabel="velocity [m/s]")
    axes.legend(loc="lower right")
    return figure


def _thresholds_of_surfaces(run):
    ranking = run.summary["ranking"]
    figure = Figure(figsize=(7, 1 + 0.45 * len(ranking)), layout="constrained")
    axes = figure.subplots()
    speeds = [s["velocity"] for s in run.summary["scenes"]] + [run.summary["shot"]["muzzle_velocity"] or 0]
    ends = [one["threshold_interval"] or (None, None) for one in ranking]
    speeds += [v for one, interval in zip(ranking, ends) for v in (one["threshold_velocity"], *interval) if v is not None]
    known = [v for v in speeds if v > 0]  # the axis covers every interval and begins near the least of them
    bottom, top = 0.95 * min(known, default=0), 1.02 * max(known, default=1)
    for place, one in enumerate(ranking):
        low, high = ends[place]
        axes.barh(place, (top if high is None else high) - (low or bottom), left=low or bottom, color="tab:red", alpha=0.3)
        if one["threshold_velocity"] is not None:
            axes.plot(one["threshold_velocity"], place, "o", color="tab:red")
    axes.set_yticks(range(len(ranking)), [one["surface"] for one in ranking])
    axes.invert_yaxis()
    axes.set(xlabel="threshold velocity [m/s], with its interval", xlim=(bottom, top))
    return figure


def crater(found):
    """Map of a Crater in mm, deep red and raised blue, and its profile along the middle."""
    height = -1e3 * found.depth
    reach = max(np.abs(height).max(), 1e-9)
    tall = 6.4 * np.ptp(found.z) / np.ptp(found.x)  # [in] that gives both directions one scale
    figure = Figure(figsize=(8, tall + 2.6), layout="constrained")
    seen, cut = figure.subplots(2, 1, sharex=True, height_ratios=[tall, 1.8])
    image = seen.pcolormesh(1e3 * found.x, 1e3 * found.z, height.T, cmap="RdBu", vmin=-reach, vmax=reach, shading="nearest")
    seen.set(aspect="equal", ylabel="z [mm]", title=found.texts.get("class", ""))
    figure.colorbar(image, ax=[seen, cut], label="height [mm]")
    cut.plot(1e3 * found.x, 1e3 * found.profile(), color="0.2")
    cut.axhline(0, color="0.7", linewidth=0.8)
    cut.set(xlabel="x [mm], the armature's way", ylabel="height [mm]")
    return figure
