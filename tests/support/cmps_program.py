"""Runs cmps on scenes given as text, and reads what it wrote."""
import glob
import json
import os
import subprocess
import tempfile

import h5py
import numpy as np

from perturbations import members, perturbed  # noqa: F401  (members: for the tests)

PROGRAM = os.path.join(os.environ.get("TSUNAGI_BIN", "build/release/bin"), "cmps")
FOLDER = tempfile.mkdtemp(prefix="cmps_")


class Run:
    """One finished run: exit status, messages, run.json and the windows' datasets joined over time."""

    def __init__(self, name, scene, waves=None, sets=(), options=(), resume=False, perturbation=None):
        self.path = os.path.join(FOLDER, name + ".toml")
        self.out = os.path.join(FOLDER, name)
        with open(self.path, "w") as file:
            file.write(scene)
        command = [PROGRAM, "run", self.path, "--out", self.out, "--quiet", *options]
        if waves:
            command += ["--waves", waves]
        for word in sets:
            command += ["--set", word]
        command += perturbed(perturbation)
        if resume:
            command.append("--resume")
        done = subprocess.run(command, capture_output=True, text=True)
        self.status, self.messages = done.returncode, done.stderr
        record = os.path.join(self.out, "run.json")
        self.record = json.load(open(record)) if os.path.exists(record) else {}

    def windows(self):
        return sorted(glob.glob(os.path.join(self.out, "window_*.h5")))

    def invariant(self, name):
        return self.record["invariants"][name]["value"]

    def figure(self, *names):
        value = self.record["figures"]
        for name in names:
            value = value[name]
        return value

    def series(self, time, name):
        """Time and values of a dataset over all windows; the sample that two windows share is taken once."""
        t, values = [], []
        for path in self.windows():
            with h5py.File(path) as file:
                t.append(file[time][:])
                values.append(file[name][:])
        t, values = np.concatenate(t), np.concatenate(values)
        t, first = np.unique(t, return_index=True)
        return t, values[first]

    def gauge(self, name, quantity="surface_elevation"):
        return self.series(f"gauges/{name}/time", f"gauges/{name}/{quantity}")

    def fluid(self):
        """Times, positions and velocities of the fluid particles."""
        with h5py.File(self.windows()[0]) as file:
            is_fluid = file["particles/kind"][:] == 0
        t, position = self.series("particles/time", "particles/position")
        _, velocity = self.series("particles/time", "particles/velocity")
        return t, position[:, is_fluid], velocity[:, is_fluid]


FAILURES = []


def expect(condition, text):
    """Prints the figure; a failed one makes the script end with status 1."""
    print(("ok    " if condition else "FAIL  ") + text)
    if not condition:
        FAILURES.append(text)


def finish():
    raise SystemExit(1 if FAILURES else 0)
