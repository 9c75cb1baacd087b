"""Runs the block program on a scene given as text, and reads what it wrote."""
import glob
import json
import os
import subprocess
import tempfile

import h5py
import numpy as np

from perturbations import members, perturbed  # noqa: F401  (members: for the tests)

DEM = os.path.join(os.environ.get("TSUNAGI_BIN", "build/release/bin"), "dem")


class Run:
    """A finished call: exit status, message, and the folder it wrote."""

    def __init__(self, folder, status, message):
        self.folder, self.status, self.message = folder, status, message

    @property
    def record(self):
        with open(os.path.join(self.folder, "run.json")) as f:
            return json.load(f)

    def figure(self, dotted):
        value = self.record["figures"]
        for part in dotted.split("."):
            value = value[part]
        return value

    def invariant(self, name):
        return self.record["invariants"][name]["value"]

    def series(self, dataset):
        """A dataset of all windows in a row; samples shared by two windows are taken once."""
        parts = []
        for k, path in enumerate(sorted(glob.glob(os.path.join(self.folder, "window_*.h5")))):
            with h5py.File(path) as f:
                parts.append(f[dataset][(1 if k else 0):])
        if not parts:
            raise SystemExit(f"no windows in {self.folder}: exit {self.status} {self.message}")
        return np.concatenate(parts)

    def windows(self):
        return [open(p, "rb").read() for p in sorted(glob.glob(os.path.join(self.folder, "window_*.h5")))]


def run(scene, *arguments, verb="run", folder=None, name="scene.toml", quiet=True, timeout=900):
    """Writes `scene` (text) beside a fresh folder and runs the program on it."""
    base = folder or tempfile.mkdtemp(prefix="tsunagi_dem_")
    os.makedirs(base, exist_ok=True)
    path = os.path.join(base, name)
    with open(path, "w") as f:
        f.write(scene)
    out = os.path.join(base, "out")
    command = [DEM, verb, path] + ([] if verb == "check" else ["--out", out] + (["--quiet"] if quiet else [])) + list(arguments)
    if verb == "run" and not any(str(word).startswith("perturbation=") for word in arguments):
        command += perturbed()
    done = subprocess.run(command, capture_output=True, text=True, timeout=timeout)
    return Run(out, done.returncode, done.stdout + done.stderr)


class Checks:
    """Prints every figure beside its bound, and fails at the end if one was missed."""

    def __init__(self):
        self.missed = []

    def below(self, what, value, bound, unit=""):
        good = np.isfinite(value) and value <= bound
        print(f"{'ok  ' if good else 'MISS'} {what}: {value:.3g} {unit} (bound {bound:.3g})", flush=True)
        if not good:
            self.missed.append(what)

    def true(self, what, good, detail=""):
        print(f"{'ok  ' if good else 'MISS'} {what} {detail}", flush=True)
        if not good:
            self.missed.append(what)

    def end(self):
        raise SystemExit(f"missed: {', '.join(self.missed)}" if self.missed else 0)
