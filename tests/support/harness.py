"""What the tests that run the built programs share: start a program, write a scene, judge messages and figures.

A test file defines functions marked with @test and ends with `main()`. Each function gets an empty folder of its own:

    from harness import *

    @test
    def still_water_stays_still(folder):
        scene = write_scene(folder, text)
        run("boussinesq", "run", scene, "--out", folder / "waves").expect_done()
        time, velocity = run_folder.read_series(folder / "waves", "/velocity")
        check_below("largest speed", abs(velocity).max(), 1e-12, "m/s", "round-off of a 0.8 m deep flume")

    main()

The programs are those of the folder named by TSUNAGI_BIN. Words on the command line choose tests by part of their name;
KEEP=1 in the environment keeps the folders.
"""
import hashlib
import math
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time
import traceback

SOURCE = pathlib.Path(__file__).resolve().parents[2]
BIN = pathlib.Path(os.environ.get("TSUNAGI_BIN", SOURCE / "build/release/bin"))
SCENES = SOURCE / "workflows/scenes"
LAYOUTS = SOURCE / "workflows/layouts"
sys.path.insert(0, str(SOURCE / "workflows"))
sys.dont_write_bytecode = True

import run_folder  # noqa: E402  (needs the path above)
from perturbations import perturbed  # noqa: E402


class Failure(Exception):
    """A check that did not hold; its text is the report."""


class Result:
    """A program that has ended."""

    def __init__(self, command, status, stdout, stderr, seconds):
        self.command, self.status = " ".join(map(str, command)), status
        self.stdout, self.stderr, self.seconds = stdout, stderr, seconds

    def expect_status(self, status):
        if self.status != status:
            raise Failure(f"{self.command}\n  ended with status {self.status} instead of {status}; stderr:\n{self.stderr}")
        return self

    def expect_done(self):
        return self.expect_status(0)

    def expect_error(self, status, *fragments):
        """Exactly one line on stderr, with all of `fragments` in it (any case), and the given exit status."""
        self.expect_status(status)
        lines = [line for line in self.stderr.splitlines() if line.strip()]
        if len(lines) != 1:
            raise Failure(f"{self.command}\n  wrote {len(lines)} lines instead of one:\n{self.stderr}")
        for fragment in fragments:
            if str(fragment).lower() not in lines[0].lower():
                raise Failure(f"{self.command}\n  message lacks '{fragment}': {lines[0]}")
        return self


def environment(**changes):
    """Environment of a started program; threads wait without spinning."""
    return {**os.environ, "OMP_WAIT_POLICY": "passive", **changes}


def command_of(program, arguments):
    """The command line; runs that choose no perturbation have that of the first member (perturbations.py)."""
    words = [str(word) for word in arguments]
    chooses = words[:1] != ["run"] or any(word.startswith("perturbation=") for word in words)
    return [str(BIN / program), *words, *([] if chooses else perturbed())]


def start(program, *arguments, **options):
    """Starts a program in a process group of its own and returns the Popen object; stderr and stdout are pipes."""
    return subprocess.Popen(command_of(program, arguments), stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                            text=True, env=environment(), start_new_session=True, **options)


def run(program, *arguments, timeout=600, **options):
    """Runs a program to its end and returns its Result. `options` go to subprocess.run (preexec_fn, cwd, ...)."""
    command = command_of(program, arguments)
    begun = time.monotonic()
    try:
        ended = subprocess.run(command, capture_output=True, text=True, timeout=timeout, env=environment(), **options)
    except subprocess.TimeoutExpired as error:
        raise Failure(f"{' '.join(command)}\n  did not end within {timeout} s") from error
    return Result(command, ended.returncode, ended.stdout, ended.stderr, time.monotonic() - begun)


def write_scene(folder, text, name="scene.toml"):
    """Writes a scene and returns its path."""
    path = pathlib.Path(folder) / name
    path.write_text(text)
    return path


def changed_scene(folder, base, *changes, name="scene.toml"):
    """A copy of the scene `base` (a file, or a name in workflows/scenes) with text replaced: (old, new), ...

    Each `old` must occur, so that a test never runs on a scene other than the one it means.
    """
    path = pathlib.Path(base)
    text = (path if path.suffix else SCENES / f"{base}.toml").read_text()
    for old, new in changes:
        if old not in text:
            raise Failure(f"scene {base} no longer holds '{old}'")
        text = text.replace(old, new, 1)
    return write_scene(folder, text, name)


def line_of(scene, text):
    """Number of the first line of a scene that holds `text`, for messages that must name it."""
    for number, line in enumerate(pathlib.Path(scene).read_text().splitlines(), 1):
        if text in line:
            return number
    raise Failure(f"{scene} does not hold '{text}'")


def check(condition, message):
    if not condition:
        raise Failure(message)


def check_below(name, value, bound, unit="", why=""):
    """|value| <= bound; prints the figure. `why` is the one-line reason of the bound."""
    print(f"    {name}: {value:.6g} {unit} (bound {bound:.6g}{'; ' + why if why else ''})")
    if not math.isfinite(value) or abs(value) > bound:
        raise Failure(f"{name} is {value:.6g} {unit}, bound {bound:.6g}")


def check_between(name, value, lowest, highest, unit="", why=""):
    """lowest <= value <= highest; prints the figure."""
    print(f"    {name}: {value:.6g} {unit} (between {lowest:.6g} and {highest:.6g}{'; ' + why if why else ''})")
    if not math.isfinite(value) or not lowest <= value <= highest:
        raise Failure(f"{name} is {value:.6g} {unit}, not between {lowest:.6g} and {highest:.6g}")


def check_figure(verdict):
    """A published figure as figures.py judges it: `check_figure(error_figure("cmps", ...))`."""
    holds, text = verdict
    print(f"    {text}")
    if not holds:
        raise Failure(text)


def check_invariants(folder):
    """Every invariant of run.json is within its bound, and the run says that it is done."""
    record = run_folder.read_run(folder)
    check(record["status"] == "done", f"{folder}: status {record['status']}: {record.get('message', '')}")
    for invariant in invariants(record):
        bound = invariant.get("bound")
        if bound is not None:
            check_below(f"{pathlib.Path(folder).name} {invariant['name']}", invariant["value"], bound, invariant["unit"])


def invariants(record):
    """The invariants of a run.json as a list of {name, value, unit, bound}."""
    entries = record.get("invariants", [])
    if isinstance(entries, dict):
        return [{"name": name, **entry} for name, entry in entries.items()]
    return entries


def digests(folder):
    """{window name: SHA-256 of its bytes}: two folders with equal digests hold the same bytes."""
    return {path.name: hashlib.sha256(path.read_bytes()).hexdigest() for path in run_folder.window_paths(folder)}


def check_same_bytes(folder, other):
    """Both folders hold the same windows, byte for byte, and at least one."""
    first, second = digests(folder), digests(other)
    check(first, f"{folder} holds no windows")
    check(first.keys() == second.keys(), f"{folder} holds {len(first)} windows, {other} holds {len(second)}")
    different = [name for name in first if first[name] != second[name]]
    check(not different, f"{folder} and {other} differ in {', '.join(different[:5])}")


def wait_for(condition, timeout, what):
    """Waits until condition() is true."""
    end = time.monotonic() + timeout
    while not condition():
        if time.monotonic() > end:
            raise Failure(f"waited {timeout} s for {what}")
        time.sleep(0.01)


_tests = []


def test(function):
    """Marks a function of one argument, an empty folder, as a test."""
    _tests.append(function)
    return function


def main():
    """Runs the file's tests, prints a line each, and ends with status 1 when one failed."""
    failed = 0
    for function in _tests:
        name = function.__name__
        if len(sys.argv) > 1 and not any(word in name for word in sys.argv[1:]):
            continue
        folder = pathlib.Path(tempfile.mkdtemp(prefix=f"tsunagi_{name}_"))
        print(f"{name}", flush=True)
        begun = time.monotonic()
        try:
            function(folder)
            print(f"    passed in {time.monotonic() - begun:.1f} s", flush=True)
        except Failure as failure:
            failed += 1
            print(f"    FAILED: {failure}", flush=True)
        except Exception:
            failed += 1
            print(f"    FAILED:\n{traceback.format_exc()}", flush=True)
        if os.environ.get("KEEP"):
            print(f"    kept {folder}")
        else:
            shutil.rmtree(folder, ignore_errors=True)
    sys.exit(1 if failed else 0)
