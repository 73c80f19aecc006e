#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""The Python package, its examples and its page.    tests/python.py BREECH [FOLDER]    Exit 77 = skipped."""
import importlib
import os
import shutil
import subprocess
import sys
import tempfile
import traceback
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "python"))
sys.dont_write_bytecode = True
os.environ["BREECH_PROGRAM"] = str(Path(sys.argv[1]).resolve())
os.environ["MPLBACKEND"] = "Agg"
try:
    for module in ("h5py", "matplotlib"):
        importlib.import_module(module)
    import numpy as np
    import yaml
except ImportError as missing:
    print(f"skipped: {missing} (Debian: python3-h5py, python3-matplotlib, python3-yaml)")
    sys.exit(77)

import breech  # noqa: E402
from breech import text  # noqa: E402

SHOT = ROOT / "cases" / "default_shot"
CHEAP = {  # an impact of a second on a stub of a rail, a search of one scene
    "scene": {"cells_per_radius": 1, "rail_ahead": "6 mm", "rail_behind": "1 mm", "rail_depth": "3 mm", "growth": 1.4,
              "coarse_cell": "1.2 mm", "levels": 2},
    "armature": {"length": "8 mm", "half_bore": "3 mm", "width": "5 mm", "head_thickness": "3 mm", "leg_thickness": "3 mm"},
    "study": {"max_scenes": 1, "craters": 0, "feedback": False, "sensitivities": False, "scratch": False,
              "threshold_ensemble": 0, "coarse_cells_per_radius": 1, "fine_cells_per_radius": 1, "sampled": 1000},
    "output": {"snapshots": 0, "report": False}}


def cheap(**more):
    case = breech.Case(SHOT, **more)
    for section, values in CHEAP.items():
        for key, value in values.items():
            case[f"{section}.{key}"] = value
    return case


def raises(kind, call, *words):
    """What it raises, which must say all the words."""
    try:
        call()
    except kind as error:
        for word in words:
            assert word in str(error), f"`{error}` does not say `{word}`"
        return error
    raise AssertionError(f"{kind.__name__} was not raised")


def words(value):
    """As PyYAML's BaseLoader has it: every value a text."""
    if isinstance(value, dict):
        return {k: words(v) for k, v in value.items()}
    return [words(v) for v in value] if isinstance(value, list) else value


# ---- cases ----

NASTY = ["a: 'it''s'\nb: \"x # y\"\nc: don't # stop\n", "a:\n- 1\n- - 2\n  - 3\n-\n  b: 4\n  c: [5,\n   6]\nd:\n", "{a: [1, {b: c}], 'd e': \"f\\n\"}",
         "a: b: c\n", "a: one\n  two\n  three\nb: [x y, a:b, c: d]\n", "---\na: ~\nb: \"1\": 2\n", "# only\n\na: -1e-3 mm\n", "\"a b\": {}\nc: []\n",
         "a: [1, 2\n", "a: 'open\n", "a: [1] 2\n", "a: 1\n b: 2\n", "a:\n  b: 1\n c: 2\n", "- {a: 1}\n- b: 2\n  c: {d:\n     e}\n"]


def test_text_is_yaml():
    """The reader gives what PyYAML gives, and refuses what that refuses."""
    files = [file.read_text() for file in sorted(ROOT.glob("cases/**/*.yaml"))]
    assert len(files) > 40
    for source in files + NASTY:
        try:
            want = yaml.load(source, yaml.BaseLoader)
        except yaml.YAMLError:
            raises(text.CaseError, lambda: text.parse(source))
            continue
        got = text.parse(source, of_word=str)
        assert words(got) == want, f"{source}\n{got}\n{want}"
    for source in ("a: |\n  b\n", "a: &x 1\n", "a: *x\n", "a: !t 1\n", "a: 1\na: 2\n"):
        raises(text.CaseError, lambda: text.parse(source, "f.yaml"), "f.yaml:")


def test_text_there_and_back():
    tree = {"name": "007 bond", "title": 'a "b": c # d', "flag": True, "no": "none", "n": 3, "x": 1e-7, "third": 1 / 3,
            "q": breech.Quantity("1.5 0 -2e-3 km/s"), "empty": None, "dash": "- a", "only": "-", "end": "...", "list": [1, "2 mm", {"a": [True, {"b": 2.5}]}], "é": "µ",
            "array": np.array([1.0, 2.5]), "bank": {"count": [3, 1], "charge": breech.Quantity(9, "kV")}}
    written = text.dump(tree)
    back, plain = text.parse(written), yaml.load(written, yaml.BaseLoader)
    for key in ("flag", "no", "n", "q", "empty", "bank", "é", "title", "dash", "only", "end"):
        assert back[key] == tree[key], key
    assert abs(back["third"] - 1 / 3) < 1e-15 and back["x"] == 1e-7 and back["array"] == [1, 2.5]
    assert str(back["name"]) == "007 bond" and plain["title"] == tree["title"] and plain["array"] == ["1", "2.5"]
    assert back["list"][1].value == 2 and back["list"][2]["a"][1]["b"] == 2.5
    for wrong in (float("nan"), float("inf"), object()):
        raises(text.CaseError, lambda: text.dump({"a": wrong}))


def test_quantity():
    q = breech.Quantity("10.55 kV")
    assert (q.value, q.unit, str(q)) == (10.55, "kV", "10.55 kV") and str(q * 2) == str(2 * q) == "21.1 kV"
    assert q / 2 == "5.275 kV" and q != "10.55 V" and breech.Quantity("4 1/m").unit == "1/m"
    assert str(0.5 * breech.Quantity("1 0 -3 km/s")) == "0.5 0 -1.5 km/s"
    assert text.scalar("8.9 g / cm3") == "8.9 g / cm3" and text.scalar("yes") is True and text.scalar("1e3") == 1000.0
    raises(text.CaseError, lambda: breech.Quantity("many"))


def test_case_by_paths():
    case = breech.Case(SHOT)
    assert case["bank.charge"] is case["bank"]["charge"] and case["sites[2].position"] == "0.40 m"
    assert "rail.level" in case and "rail.nothing" not in case and "sites[99]" not in case and case.get("x.y", 7) == 7
    raises(KeyError, lambda: case["sites.position"])
    raises(KeyError, lambda: case.__setitem__("name.inner", 1))
    other = case.copy()
    other["sites[2].position"] = "0.6 m"
    other["strike.velocity"] = "1 km/s"
    del other["scene.friction"]
    assert case["sites[2].position"] == "0.40 m" and "strike" not in case and "scene.friction" in case
    assert other["strike"] == {"velocity": "1 km/s"} and "friction" not in other["scene"]


def used(directory):
    return [line for line in (directory / "used.yaml").read_text().splitlines() if not line.startswith("#")]


def test_case_is_the_programs(folder):
    """A case changed here is the one that the program makes of the same changes."""
    case = breech.Case(ROOT / "cases" / "treatments")  # itself on a base, a section of which it takes out
    assert "sites" not in case and len(case["treatments"]) == 5 and case["bank.charge"] == "10.55 kV"
    case["bank.charge"] *= 0.9
    case["output.report"] = False
    breech.run("shot", ROOT / "cases" / "treatments", folder / "c", progress=False,
               sets={"bank.charge": breech.Quantity("9.495 kV"), "output.report": False})
    case.run("shot", folder / "d", progress=False)
    assert used(folder / "c") == used(folder / "d")
    del case["rail.specific_heat"]
    saved = case.save(folder / "saved")
    assert saved.read_text().startswith("base: ") and len(saved.read_text().splitlines()) == 7, saved.read_text()
    whole = folder / "whole.yaml"
    whole.write_text(text.dump(case))
    for path in (saved, whole):
        breech.run("shot", path, folder / f"as-{path.name}", progress=False)
    assert used(folder / "as-case.yaml") == used(folder / "as-whole.yaml") != used(folder / "c")
    assert breech.Case(saved) == case
    assert str(ROOT / "cases" / "pulse_unit_200kJ") in breech.check(ROOT / "cases" / "pulse_unit_200kJ")
    assert "one unit" in breech.Case(ROOT / "cases" / "pulse_unit_200kJ", title="one unit").check()


def own_material(folder):
    """A folder with a metal that is a harder copper."""
    folder.mkdir()
    (folder / "my_metal.yaml").write_text("name: my_metal\nbase: ofhc_copper_half_hard\nsources: {mine: our test}\nconstants:\n"
                                          "  hardness: {value: 1.05 GPa, source: mine}\n")
    return folder


def test_save_moves_the_case(folder):
    """Saved, it finds materials beside its file, and may be changed, run and saved there again; it never is its own base."""
    case = breech.Case(SHOT)
    case["rail.material"] = "my_metal"
    raises(breech.BadInput, case.check, "my_metal")
    home = own_material(folder / "home")
    saved = case.save(home)
    assert case.path == saved.resolve() and case.check()
    case["bank.charge"] = "9 kV"  # on top of what was saved
    case.run("shot", folder / "home-shot", progress=False)
    assert any(line.strip() == "charge: 9000 V" for line in used(folder / "home-shot"))
    first = saved.read_text()
    case.save(home)
    assert saved.read_text().startswith(first.splitlines()[0]) and "9 kV" in saved.read_text() and breech.Case(home) == case
    again = breech.Case(home)
    again["bank.charge"] = "8 kV"
    again.save(home)  # over the file that it was read from
    assert saved.read_text().startswith(first.splitlines()[0]) and breech.Case(home)["bank.charge"] == "8 kV"
    for k in range(breech.case.MAX_BASES + 2):  # no chain of bases grows
        again["bank.charge"] = f"{k + 1} kV"
        again.save(folder / f"chain{k}")
    assert breech.Case(folder / f"chain{k}") == again
    raises(breech.BadInput, again.check, "my_metal")  # it lives there now
    begun = breech.Case(name="begun")
    begun.save(folder / "begun")
    begun.save(folder / "begun")
    assert (folder / "begun" / "case.yaml").read_text() == "name: begun\n"


def test_tables_of_current(folder):
    """A profile's file is found when the list it stands in changes, in a case that is saved, and beside one that is."""
    shipped = ROOT / "cases" / "current_profile"
    case = breech.Case(shipped)
    case["current_profiles[0].scale"] = 0.5
    case.run("shot", folder / "table-half", progress=False)
    deep = folder / ("a-long-name-of-a-folder-" * 5)
    saved = case.save(deep / "table")
    breech.run("shot", saved, folder / "table-saved", progress=False)
    assert used(folder / "table-half") == used(folder / "table-saved") and breech.Case(saved) == case
    assert breech.Case(shipped).copy().text().count("\n") == 1  # nothing is changed
    shutil.copy(shipped / "current.csv", saved.parent / "mine.csv")
    case["current_profiles"] = {"file": "mine.csv", "scale": 0.5}
    case.run("shot", folder / "table-mine", progress=False)
    case.save(saved)
    assert "file: mine.csv" in saved.read_text()
    breech.run("shot", saved, folder / "table-own", progress=False)
    assert used(folder / "table-mine") == used(folder / "table-own") == used(folder / "table-half")


def test_own_materials(folder):
    home = own_material(folder / "metals")
    case = breech.Case("default_shot", material_folder=home)  # a shipped case goes by its name
    case["rail.material"] = "my_metal"
    assert case.check() and case.copy().check()
    raises(breech.BadInput, lambda: breech.check(case.save(folder / "without")), "my_metal")
    raises(FileNotFoundError, lambda: breech.Case(SHOT, material_folder=folder / "none"), "folder of materials")
    assert breech.Case("cases/default_shot") == breech.Case(SHOT)
    raises(FileNotFoundError, lambda: breech.Case("defualt_shot"), "defualt_shot", "there is no such case", "default_shot, ")


# ---- runs ----


def test_errors(folder):
    case = cheap()
    case["bank.charge"] = "9 kg"
    wrong = raises(breech.BadInput, lambda: case.run("shot", folder / "x", progress=False), "case.yaml:", "bank.charge = 9 kg")
    assert wrong.code == 2 and not (folder / "x").exists() and "/tmp" not in str(wrong)
    raises(breech.BadInput, lambda: case.check(), "bank.charge = 9 kg")
    raises(breech.BadInput, lambda: breech.check(folder / "nowhere"), "nowhere")
    failed = raises(breech.Failed, lambda: cheap().run("shot", "/proc/nowhere/x", progress=False), "/proc/nowhere")
    assert failed.code == 1
    cheap().run("shot", folder / "done", progress=False)
    raises(breech.BadInput, lambda: cheap().run("shot", folder / "done", progress=False), "--force")
    cheap().run("shot", folder / "done", progress=False, force=True)


def test_no_program(folder):
    """Without a program it says what to set."""
    (folder / "lone").mkdir()
    shutil.copytree(ROOT / "python" / "breech", folder / "lone" / "breech", ignore=shutil.ignore_patterns("__pycache__"))
    bare = {key: value for key, value in os.environ.items() if key != "BREECH_PROGRAM"}
    done = subprocess.run([sys.executable, "-c", "import breech; breech.program()"], text=True, capture_output=True,
                          env={**bare, "PYTHONPATH": str(folder / "lone"), "PATH": "/nowhere"})
    assert done.returncode != 0 and "on PATH" in done.stderr and "BREECH_PROGRAM=" in done.stderr, done.stderr


def numbers(run):
    return {k: v for k, v in run.summary.items() if k not in ("wall_seconds", "threads")}


def test_progress_stop_and_resume(folder):
    """A run says how far it is; stopped by its time or by Ctrl-C, it goes on to the same numbers."""
    os.environ["BREECH_PROGRESS"] = "0"  # a line a look
    heard = []
    try:
        case = cheap()
        case["scene.cells_per_radius"] = 2  # a second or two, for several looks at the solver on a fast machine
        whole = case.run("scene", folder / "whole", store=False, threads=1, progress=heard.append)
        share = [line.fraction for line in heard if line.fraction is not None]
        assert share and share == sorted(share) and 0 <= share[0] and 0 < share[-1] < 1, share
        task = [line for line in heard if line.task and line.left][-1]
        assert "scene 1, 1500 m/s" in task.task and task.left.endswith(" s"), str(task)
        how = {"store": False, "threads": 1}
        stopped = raises(breech.Stopped, lambda: case.run("scene", folder / "part", progress=False, max_walltime="0.1s", **how))
        assert stopped.code == 75 and stopped.directory == folder / "part"
        assert numbers(case.run("scene", folder / "part", resume=True, progress=False, **how)) == numbers(whole)

        def interrupt(line):
            if line.fraction is not None:
                raise KeyboardInterrupt
        raises(KeyboardInterrupt, lambda: case.run("scene", folder / "keys", progress=interrupt, **how))
        assert (folder / "keys" / "checkpoint.bin").exists()
        assert numbers(case.run("scene", folder / "keys", resume=True, progress=False, **how)) == numbers(whole)
    finally:
        del os.environ["BREECH_PROGRESS"]
    crater = whole.crater("scene")
    assert crater.depth.max() == whole.summary["crater_depth"] and crater.texts["class"] == whole.summary["class"]
    figure = breech.plot.crater(crater)
    drawn = figure.axes[0].collections[0].get_array().reshape(crater.depth.T.shape)
    assert np.allclose(drawn, -1e3 * crater.depth.T)


def test_bodies(folder):
    case = breech.Case(ROOT / "cases" / "sphere_plate")
    case.update({"scene.cell": "1.5 mm", "scene.end_time": "2 us", "output": {"snapshots": 0, "report": False}})
    case["scene.probes"].append({"name": "front", "surface": {"lo": "-1 -6 0 mm", "hi": "3 6 6 mm", "along": "-1 0 0",
                                                              "cell": "1 mm", "body": "plate"}})
    run = case.run("scene", folder / "bodies", progress=False)
    assert run.bodies("scene") == ["ball", "plate"] and "push" in run.probes("scene")
    ball, push = run.body("scene", "ball"), run.probe("scene", "push")
    assert abs(ball["velocity_x"][0] - 1500) < 1 and ball["velocity_x"][-1] < 1500 and ball.units["time"] == "s"
    assert len(push["time"]) == len(push["force_x"]) > 10 and push["force_x"].max() > 0
    front = run.probe("scene", "front")
    assert front["x"].shape[0] == len(front["time"]) and front["x"].ndim > 1
    assert "result" not in run.scene("scene")
    stored, = breech.store(folder / "bodies" / "store")
    assert "bodies:" in stored.case and stored.key == stored.path.stem
    assert stored.outcome is stored.impulse is stored.mass_loss is None


# ---- examples and page ----


def test_examples(folder):
    """All scripts, in a folder whose default shot is a cheap one."""
    (folder / "cases").mkdir()
    cheap().save(folder / "cases" / "default_shot")
    said = {}
    for script in ("first_shot.py", "coated_crater.py", "rank_coatings.py"):
        done = subprocess.run([sys.executable, ROOT / "python" / "examples" / script], cwd=folder, text=True, capture_output=True,
                              env={**os.environ, "PYTHONPATH": str(ROOT / "python")})
        assert done.returncode == 0, done.stderr
        said[script] = done.stdout
    assert said["first_shot.py"].startswith("10.55 kV 3 m 0.25\n1943 m/s after 3.23 ms\n"), said["first_shot.py"]
    assert "9.495 kV: " in said["first_shot.py"] and "scene.velocity = 1.2 kg" in said["first_shot.py"]
    craters = {line.split()[0]: line.split()[1:] for line in said["coated_crater.py"].splitlines()}
    assert list(craters) == ["bare", "nickel"] and craters["bare"][1:] != craters["nickel"][1:]
    coated = breech.Run(folder / "out" / "coated" / "nickel")
    numbers_of = coated.crater("scene").numbers
    assert f"{1e3 * numbers_of['depth_m']:.3f}" in craters["nickel"] and abs(coated.summary["crater_depth"] - numbers_of["depth_m"]) < 1e-9
    page = (ROOT / "docs" / "guide" / "python.md").read_text()
    assert all(f"`{key}`" in page for key in numbers_of), numbers_of
    ranks = said["rank_coatings.py"].splitlines()
    ranking = breech.Run(folder / "out" / "coatings").summary["ranking"]
    assert [line.split()[0] for line in ranks[:-1]] == [one["surface"] for one in ranking]
    assert [line.endswith("cannot be told from it") for line in ranks[:-1]] == [one["tied"] == 1 for one in ranking]
    assert ranks[-1] == breech.Run(folder / "out" / "coatings").summary["verdict"] != ""
    assert sorted(one["surface"] for one in ranking) == ["nickel", "steel_4340", "tantalum", "ti6al4v", "untreated", "w_alloy"]
    for picture in ("coatings/ranking.png", "python/shot.png", "python/crater.png", "coated/bare.png", "coated/nickel.png"):
        assert (folder / "out" / picture).stat().st_size > 10000, picture
    shot = breech.Run(folder / "out" / "python" / "shot")
    line = breech.plot.shot(shot).axes[2].lines[0].get_ydata()
    assert abs(line.max() - shot.summary["muzzle_velocity"]) < 1e-3 * line.max()
    said_of = subprocess.run([sys.executable, "-m", "breech", folder / "out" / "python" / "impact"], text=True, capture_output=True,
                             env={**os.environ, "PYTHONPATH": str(ROOT / "python")}, check=True).stdout
    assert "scene scene: " in said_of and "mm" in said_of
    assert len((ROOT / "python" / "examples" / "rank_coatings.py").read_text().splitlines()) <= 20


def described(directory):
    return subprocess.run([sys.executable, "-m", "breech", directory], text=True, capture_output=True,
                          env={**os.environ, "PYTHONPATH": str(ROOT / "python")})


def test_described(folder):
    """A comparison is described by its ranking; a reader that closes the pipe and a folder that is not there are no bugs."""
    done = described(folder / "out" / "coatings")
    ranking = breech.Run(folder / "out" / "coatings").summary["ranking"]
    lines = done.stdout.splitlines()
    head = next(k for k, line in enumerate(lines) if line.startswith("surface"))
    assert done.returncode == 0 and [line.split()[0] for line in lines[head + 1:head + 7]] == [e["surface"] for e in ranking]
    short = folder / "short"  # of a run without series
    short.mkdir()
    shutil.copy(folder / "out" / "coatings" / "summary.json", short)
    assert described(short).returncode == 0 and described(short).stdout.splitlines() == lines[:head + 7]
    none = described(folder / "none")
    assert none.returncode == 1 and "no such directory" in none.stderr and "Traceback" not in none.stderr
    piped = subprocess.Popen([sys.executable, "-m", "breech", folder / "out" / "coatings"], stdout=subprocess.PIPE,
                             stderr=subprocess.PIPE, env={**os.environ, "PYTHONPATH": str(ROOT / "python")})
    piped.stdout.close()
    assert piped.stderr.read() == b"" and piped.wait() == 0
    piped.stderr.close()


def test_progress_of_pipes(folder):
    """A line a second where a person or a function hears it; into a pipe the program's own way."""
    fake = folder / "fake"
    fake.write_text('#!/bin/sh\necho "every ${BREECH_PROGRESS-long}" >&2\nexit 1\n')
    fake.chmod(0o755)
    kept, os.environ["BREECH_PROGRAM"] = os.environ["BREECH_PROGRAM"], str(fake)
    try:
        heard = []
        raises(breech.Failed, lambda: cheap().run("shot", folder / "x", progress=lambda line: heard.append(str(line))))
        assert heard == ["every 1"], heard
        raises(breech.Failed, lambda: cheap().run("shot", folder / "x", progress=True),
               "every 1" if sys.stderr.isatty() else "every long")
        raises(breech.Failed, lambda: cheap().run("shot", folder / "x", progress=False), "every long")
    finally:
        os.environ["BREECH_PROGRAM"] = kept


def test_threshold_picture(folder):
    """Sites by outcome, the speeds and their intervals, of an answer that is written down here."""
    shot = breech.Run(folder / "out" / "python" / "shot")
    shot.summary = {"kind": "onset", "threshold_velocity": 1000.0, "threshold_interval": [900.0, None], "scratch_velocity": None,
                    "scratch_interval": [None, None],
                    "sites": [{"position": 0.5, "velocity": 757.0, "outcome": "scratch"},
                              {"position": 1.5, "velocity": 1477.0, "outcome": "gouge"},
                              {"position": 9.0, "velocity": None, "outcome": "not_reached"}]}
    axes = breech.plot.threshold(shot).axes[0]
    labels = [text.get_text() for text in axes.get_legend().get_texts()]
    assert labels == ["the shot", "scratch", "gouge", "gouges from: 1000 m/s"], labels
    assert axes.lines[1].get_ydata()[0] == 757.0 and axes.patches[0].get_xy()[0][1] == 900.0


def test_surfaces_picture(folder):
    """The axis covers every interval; the figures are not pyplot's."""
    import types
    import matplotlib.pyplot as plt
    ranking = [{"surface": "a", "threshold_velocity": 1800.0, "threshold_interval": [1470.0, 2130.0]},
               {"surface": "b", "threshold_velocity": None, "threshold_interval": [1500.0, None]},
               {"surface": "c", "threshold_velocity": 1100.0, "threshold_interval": [None, 1300.0]}]
    run = types.SimpleNamespace(summary={"kind": "compare", "ranking": ranking, "scenes": [{"velocity": 875.0}],
                                         "shot": {"muzzle_velocity": 1950.0}})
    axes = breech.plot.threshold(run).axes[0]
    low, high = axes.get_xlim()
    bars = [(bar.get_x(), bar.get_x() + bar.get_width()) for bar in axes.patches]
    assert bars == [(1470.0, 2130.0), (1500.0, high), (low, 1300.0)] and 800 < low < 875 and 2130 < high < 2200, bars
    assert not plt.get_fignums()


def test_what_is_not_there(folder):
    raises(FileNotFoundError, lambda: breech.Run(folder / "none"), "no such directory")
    (folder / "empty").mkdir()
    raises(FileNotFoundError, lambda: breech.Run(folder / "empty"), "holds no run")
    run = breech.Run(folder / "whole")
    raises(KeyError, lambda: run.scene("nosuch"), "nosuch", "it has: scene")
    raises(KeyError, lambda: run.crater("nosuch"), "nosuch", "it has: scene")
    (folder / "going").mkdir()
    shutil.copy(folder / "whole" / "history.h5", folder / "going")
    going = breech.Run(folder / "going")  # what a run has written so far
    assert going.scenes == ["scene"]
    raises(FileNotFoundError, lambda: going.summary, "summary.json is not there: the run goes on")


def test_missing_modules():
    """An interpreter without numpy and h5py runs cases, and says what to do where it must read arrays; a script ends without a
    traceback."""
    def bare(code):
        return subprocess.run([sys.executable, "-S", "-c", "import sys; sys.path.insert(0, 'python'); import breech\n" + code], cwd=ROOT,
                              text=True, capture_output=True)
    other = "sys.executable = '/opt/python3'\n"
    done = bare("print(breech.Case('cases/default_shot')['bank.charge'])")
    assert done.returncode == 0 and done.stdout == "10.55 kV\n", done.stderr
    said = bare("breech.needs.load('h5py')").stderr.splitlines()[-1]
    assert said.startswith("ImportError: ") and said.endswith("install h5py") and "apt-get install python3-h5py" in said, said
    said = bare(other + "breech.results.np.max").stderr.splitlines()[-1]
    assert "/opt/python3 has no numpy: Debian's /usr/bin/python3 has" in said or "apt-get install python3-numpy" in said, said
    done = bare("sys.argv = ['/x/tables.py']; breech.needs.demand('json', 'numpy', 'h5py')")
    assert done.returncode == 2 and done.stderr.startswith("tables.py: ") and "no numpy, h5py: " in done.stderr, done.stderr
    done = subprocess.run([sys.executable, "-S", ROOT / "tests/validate/tables.py", "breech", "out"], text=True, capture_output=True)
    assert done.returncode == 2 and "Traceback" not in done.stderr, done.stderr
    for name in ("numpy", "h5py", "matplotlib.figure"):
        assert breech.needs.load(name).__name__ == name


def test_page():
    page = (ROOT / "docs" / "guide" / "python.md").read_text()
    for script in sorted((ROOT / "python" / "examples").glob("*.py")):
        code = script.read_text().split("\n", 1)[1]
        assert f"```python\n{code}```" in page, f"docs/guide/python.md does not show {script.name} as it is"
    page += (ROOT / "docs" / "reference" / "python.md").read_text()
    public = [name for name in breech.__all__ if name not in ("Columns", "CaseError", "Crater", "Progress", "StoredScene")]
    for name in public:
        assert f"breech.{name}" in page or name in ("describe", "program", "snapshot", "check"), name


def test_pip(folder):
    """pip installs it from the tree; the version is the program's."""
    shutil.copytree(ROOT / "python", folder / "python", ignore=shutil.ignore_patterns("__pycache__"))
    done = subprocess.run([sys.executable, "-m", "pip", "install", "--quiet", "--no-index", "--no-build-isolation", "--no-deps",
                           "--root-user-action=ignore", "--target", folder / "site", folder / "python"], text=True, capture_output=True)
    assert done.returncode == 0, done.stderr
    said = subprocess.run([sys.executable, "-c", "import breech, importlib.metadata as m; print(breech.__file__, m.version('breech'));"
                           "print(breech.Quantity('2 mm') * 2)"], cwd=folder, text=True, capture_output=True, check=True,
                          env={**os.environ, "PYTHONPATH": str(folder / "site")}).stdout
    version = subprocess.run([breech.program(), "--version"], text=True, capture_output=True, check=True).stdout
    assert said.split()[0] == str(folder / "site" / "breech" / "__init__.py") and f"breech {said.split()[1]}," in version
    assert said.endswith("4 mm\n")


def main():
    failed = 0
    with tempfile.TemporaryDirectory() as folder:
        for name, test in list(globals().items()):
            if not name.startswith("test_"):
                continue
            if len(sys.argv) > 2 and sys.argv[2] not in name:
                continue
            try:
                test(*([Path(folder)] if test.__code__.co_argcount else []))
                print(f"passed  {name}")
            except Exception:
                traceback.print_exc()
                print(f"FAILED  {name}")
                failed += 1
    return 1 if failed else 0


sys.exit(main())
