"""`check` says what a run will take: particles exactly, steps and work (particles times steps) closely. Wall time is not judged here: it
is work times a cost that `check` measures on the machine."""
import os
import re
import subprocess

import numpy as np

from cmps_program import FOLDER, PROGRAM, Run, expect, finish
from cmps_waves import write_waves


def tank(end, box, water, spacing):
    return f"[time]\nend = {end}\nwindow = {end}\n[cmps]\ndrive = \"none\"\ntank = {box}\nwater = {water}\nparticle_spacing = {spacing}\n"


def flume(end, height, spacing, more=""):
    return f"""[time]
end = {end}
window = 1.0
[flume]
bed = [[0.0, -0.4], [40.0, -0.4]]
[waves]
kind = "regular"
height = {height}
period = 1.65
[cmps]
offshore = 25.0
onshore = 29.0
particle_spacing = {spacing}
{more}
"""


def still_flume(structure):
    return f"""[time]
end = 2.0
window = 2.0
[flume]
bed = [[0.0, -0.4], [4.0, -0.4]]
[cmps]
drive = "none"
particle_spacing = 0.025
structure = {structure}
"""


def shaken(level, period, strength):
    """A tank 0.6 m long, shaken along x with `strength` m/s2."""
    t = np.arange(0.0, 5.0, 0.02)
    path = os.path.join(FOLDER, f"shaken_{period:.3f}.csv")
    np.savetxt(path, np.column_stack([t, strength * np.sin(2 * np.pi * t / period), np.full(len(t), -9.81)]), delimiter=",")
    return tank(4.0, [0, 0.6, 0, 0.6], [[[0, 0], [0.6, 0], [0.6, level], [0, level]]], level / 16) + f'gravity_file = "{path}"\n'


def chambers(left, right):
    """Two chambers, joined under a wall."""
    return tank(2.0, [0, 1, 0, 0.6], [[[0, 0], [0.45, 0], [0.45, left], [0, left]], [[0.45, 0], [0.55, 0], [0.55, 0.1], [0.45, 0.1]],
                                      [[0.55, 0], [1, 0], [1, right], [0.55, right]]], 0.02) + \
        "structure = [[[0.45, 0.1], [0.55, 0.1], [0.55, 0.6], [0.45, 0.6]]]\n"


def first_mode(length, level):
    k = np.pi / length
    return 2 * np.pi / np.sqrt(9.81 * k * np.tanh(k * level))


CAISSON = "[[3.0, -0.4], [3.0, 0.2], [3.3, 0.2], [3.3, -0.4]]"
STRUCTURE = "structure = [[[28.0, -0.4], [28.0, 0.3], [28.2, 0.3], [28.2, -0.4]]]"
# Bounds: water at rest allows the step that is told. Columns and waves are told the speed that such runs meet in the mean.
SCENES = {
    "still water": (tank(3.0, [0, 0.4, 0, 0.5], [[[0, 0], [0.4, 0], [0.4, 0.3], [0, 0.3]]], 0.02), None, 0.02),
    "dam break, long": (tank(1.2, [0, 1.61, 0, 0.6], [[[0, 0], [0.6, 0], [0.6, 0.3], [0, 0.3]]], 0.02), None, 0.3),
    "dam break, high": (tank(1.0, [0, 1.2, 0, 1.2], [[[0, 0], [0.25, 0], [0.25, 0.5], [0, 0.5]]], 0.02), None, 0.3),
    "sill before a caisson": (still_flume(f"[[[1, -0.4], [1.3, -0.2], [1.6, -0.2], [1.9, -0.4]], {CAISSON}]"), None, 0.02),
    "slotted wall": (still_flume(f"[[[1, -0.35], [1.1, -0.35], [1.1, -0.25], [1, -0.25]], [[1, -0.15], [1.1, -0.15], [1.1, 0.2], [1, 0.2]], {CAISSON}]"), None, 0.02),
    "two chambers": (chambers(0.3, 0.3), None, 0.02),
    "two chambers of two levels": (chambers(0.35, 0.25), None, 0.3),
    "shaken slowly": (shaken(0.3, 2.0, 0.5), None, 0.3),
    "shaken at its own period": (shaken(0.12, first_mode(0.6, 0.12), 0.4), None, 0.3),
    "low waves": (flume(8.0, 0.06, 0.04, "start = 0.0"), 0.06, 0.3),
    "waves at a wall": (flume(8.0, 0.12, 0.04, "start = 0.0\n" + STRUCTURE), 0.12, 0.3),
    "start at arrival": (flume(10.0, 0.08, 0.04), 0.08, 0.3),
}
for name, (scene, height, bound) in SCENES.items():
    waves = None
    if height:
        waves = os.path.join(FOLDER, f"waves_{height}")
        write_waves(waves, height, 1.65, 0.4, 24, 30, 10, window=1.0, arrival=4.0 if name == "start at arrival" else 0.5)
    run = Run(name.replace(" ", "_"), scene, waves=waves)
    expect(run.status == 0, f"{name}: exit {run.status} {run.messages.strip()}")
    command = [PROGRAM, "check", run.path] + (["--waves", waves] if waves else [])
    told = subprocess.run(command, capture_output=True, text=True).stdout
    fluid, boundary = map(int, re.search(r"particles +(\d+) in the water, (\d+) in walls", told).groups())
    steps = float(re.search(r"steps +about (\d+)", told)[1])
    expect(fluid + boundary == run.figure("particles", "all"), f"{name}: {fluid} + {boundary} particles told, {run.figure('particles', 'all'):.0f} used")
    error = steps / run.figure("steps") - 1
    expect(abs(error) < bound, f"{name}: {steps:.0f} steps told, {run.figure('steps'):.0f} taken: {100 * error:+.0f} % (bound {100 * bound:.0f} %: a factor of 2 in time is asked for, the rest is left to the cost of a step)")
finish()
