# SPDX-License-Identifier: BSD-3-Clause
"""Runs of the program, each computed once: one that is in the folder, of the same program and arguments, is read."""
import hashlib
import json
import math
import os
import shutil
import subprocess
import sys
import time

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.insert(0, os.path.join(ROOT, "python"))  # breech.needs, for those that need numpy or h5py


class Figure:
    """A number, None where the run has none, with its standard deviation over several grids, None of one grid."""

    def __init__(self, mean, deviation=None, n=1):
        self.mean, self.deviation, self.n = mean, deviation, n

    def text(self, digits, unit=1.0):
        if self.mean is None:
            return ""
        mean = "%.*f" % (digits, self.mean / unit)
        return mean if self.deviation is None else "%s ± %.*f" % (mean, digits, self.deviation / unit)

    def error(self):
        """Standard error of the mean; 0 where it is not known."""
        return self.deviation / math.sqrt(self.n) if self.deviation is not None else 0.0


class Scene:
    """The summary of `breech scene`, of one grid or, with --ensemble, of several."""

    def __init__(self, summary, run):
        self.summary, self.run = summary, run
        self.several = summary["kind"] == "ensemble"

    def __getitem__(self, name):
        """Figure of a number of the summary, such as crater_volume or peak_force[0]."""
        if self.several:
            number = self.summary["numbers"][name]
            return Figure(number["mean"], number["deviation"], number["scenes"])
        key, _, entry = name.partition("[")
        value = self.summary[key]
        return Figure(value[int(entry[:-1])] if entry else value)

    def classes(self):
        """How many grids give which class: {"gouge": 3}."""
        return self.summary["classes"] if self.several else {self.summary["class"]: 1}

    def class_text(self):
        """Classes and how many grids give them, most frequent first: "2 gouge, 1 undecided"; of one grid its class."""
        if not self.several:
            return self.summary["class"]
        found = sorted((-n, name) for name, n in self.classes().items() if n)
        return ", ".join("%d %s" % (-n, name) for n, name in found)

    def mostly(self, name):
        """Do more than half of the grids give this class?  None: just half."""
        count = self.classes()
        more = 2 * count.get(name, 0) - sum(count.values())
        return None if more == 0 else more > 0

    def largest(self, name):
        """Largest magnitude of a number over the grids."""
        if self.several:
            number = self.summary["numbers"][name]
            return max(abs(number["least"]), abs(number["largest"]))
        return abs(self.summary[name])


class Runs:
    """breech: the program; out: a folder that keeps the runs; threads: of each."""

    def __init__(self, breech, out, threads):
        self.breech, self.out, self.threads = os.path.realpath(breech), os.path.realpath(out), threads
        os.makedirs(self.out, exist_ok=True)
        with open(self.breech, "rb") as program:
            self.program = hashlib.sha256(program.read()).hexdigest()[:16]

    def run(self, name, arguments):
        """Path of the output directory of `breech ARGUMENTS`, and what it took: times [s], memory [kB]."""
        folder = os.path.join(self.out, name)
        record = folder + ".run.json"
        asked = {"program": self.program, "arguments": arguments}
        if os.path.exists(record):
            with open(record, encoding="utf-8") as file:
                done = json.load(file)
            if {key: done.get(key) for key in asked} == asked and os.path.exists(os.path.join(folder, "summary.json")):
                return folder, done
        shutil.rmtree(folder, ignore_errors=True)
        command = [self.breech, *arguments, "-o", folder, "--force", "--quiet"]
        command += ["--store", os.path.join(self.out, "store")]
        if self.threads:
            command += ["--threads", str(self.threads)]
        done = {**asked, **self.timed(name, command)}
        with open(record, "w", encoding="utf-8") as file:
            json.dump(done, file)
        return folder, done

    def timed(self, name, command):
        begin = time.monotonic()
        with open(os.path.join(self.out, name + ".log"), "w+", encoding="utf-8") as log:
            child = subprocess.Popen(command, cwd=ROOT, stdout=log, stderr=subprocess.STDOUT)
            _, status, used = os.wait4(child.pid, 0)
            child.returncode = os.waitstatus_to_exitcode(status)
            if child.returncode:
                log.seek(0)
                sys.exit("%s\nfails:\n%s" % (" ".join(command), log.read()))
        return {"wall": time.monotonic() - begin, "processor": used.ru_utime + used.ru_stime, "memory": used.ru_maxrss}

    def scene(self, name, case, ensemble=0, **settings):
        """A Scene of the case: settings as scene__velocity="1 km/s"."""
        arguments = ["scene", case]
        if ensemble:
            arguments += ["--ensemble", str(ensemble)]
        for key, value in {"output__report": "no", "output__snapshots": 0, **settings}.items():
            arguments += ["--set", "%s=%s" % (key.replace("__", "."), value)]
        folder, done = self.run(name, arguments)
        with open(os.path.join(folder, "summary.json"), encoding="utf-8") as file:
            return Scene(json.load(file), done)
