"""What auto left out and turns out to be needed is said at once and switched on; what stays calm is left alone; a run that was interrupted
before or after goes on to the same bytes. And what auto expects of a scene before it runs."""
import glob
import json
import os
import re
import shutil
import signal
import subprocess
import sys
import time

import h5py
import numpy as np

from cmps_program import FOLDER, PROGRAM, Run, expect, finish, perturbed
from cmps_waves import write_waves, write_window

PERIOD, DEPTH = 1.65, 0.4


def flume(end, bed, onshore, more="", tables=""):
    return f"""
[time]
end = {end}
window = 0.5
[flume]
bed = {bed}
{tables}
[cmps]
offshore = 25.0
onshore = {onshore}
particle_spacing = 0.025
{more}
"""


def regular(height):
    return f'[waves]\nkind = "regular"\nheight = {height}\nperiod = {PERIOD}'


def notes(run):
    return list(run.record["notes"].get("effect_watch", {}).values()) if run.record.get("notes") else []


def effect(run, name):
    return run.record["effects"][name]


def loud(name, scene, waves):
    """The messages of a run that may speak."""
    path = os.path.join(FOLDER, name + ".toml")
    with open(path, "w") as file:
        file.write(scene)
    return subprocess.run([PROGRAM, "run", path, "--waves", waves, "--out", os.path.join(FOLDER, name), *perturbed()], capture_output=True, text=True).stderr


def same_windows(a, b):
    names = sorted(os.path.basename(path) for path in glob.glob(os.path.join(a, "window_*.h5")))
    return len(names) > 0 and all(open(os.path.join(a, name), "rb").read() == open(os.path.join(b, name), "rb").read() for name in names)


def interrupted(whole, scene, waves, kills):
    """The same run, killed once it has published each of `kills` windows, and gone on with."""
    out = os.path.join(FOLDER, "interrupted_" + os.path.basename(whole.out))
    path = out + ".toml"
    with open(path, "w") as file:
        file.write(scene)
    command = [PROGRAM, "run", path, "--waves", waves, "--out", out, "--quiet", "--resume", *perturbed()]
    for count in kills:
        process = subprocess.Popen(command)
        while process.poll() is None and not os.path.exists(os.path.join(out, f"window_{count - 1:06d}.h5")):
            time.sleep(0.01)
        process.send_signal(signal.SIGKILL)
        process.wait()
    done = subprocess.run(command, capture_output=True, text=True)
    killed = len(whole.windows())
    expect(done.returncode == 0 and killed > max(kills) and same_windows(whole.out, out), f"{os.path.basename(whole.out)}: killed after {kills} of {killed} windows, gone on to the same bytes {done.stderr.strip()}")
    resumed = Run(os.path.basename(out), scene, waves=waves, resume=True)  # nothing to do: reads run.json
    expect(notes(resumed) == notes(whole) and resumed.record["effects"].keys() == whole.record["effects"].keys(), f"{os.path.basename(whole.out)}: run.json says the same after it")


def of_another_version(whole, scene, waves):
    """A state without what the watch remembers, or with fewer figures of the balance, cannot be gone on from."""
    def forget(file):
        del file.attrs["switched_on"]

    def shorten(file):
        values, kept = file["balance"][:4], dict(file["balance"].attrs)
        del file["balance"]
        file["balance"] = values
        for key, value in kept.items():
            file["balance"].attrs[key] = value

    def throw(file):
        file["particles/x"][-1] = 1e30

    for name, change, said in (("thrown", throw, "/particles: particle"), ("another_version", forget, "attribute switched_on is missing"), ("short_balance", shorten, "a dataset has fewer values than are needed")):
        out = os.path.join(FOLDER, name)
        os.makedirs(out)
        for path in whole.windows()[:-1] + [os.path.join(whole.out, file) for file in ("state.h5", "run.json")]:
            shutil.copy(path, out)
        with open(os.path.join(out, "run.json")) as file:
            record = json.load(file)
        with open(os.path.join(out, "run.json"), "w") as file:
            json.dump({**record, "status": "failed"}, file)
        with h5py.File(os.path.join(out, "state.h5"), "r+") as file:
            change(file)
            file.attrs["next_window"] = len(whole.windows()) - 1
        run = Run(name, scene, waves=waves, resume=True)
        expect(run.status == 2 and f"state.h5: {said}" in run.messages and ": it is damaged, or another version of cmps wrote it" in run.messages, f"state {name}: exit {run.status}, {run.messages.strip()}")


BEACH = f"[[0.0, {-DEPTH}], [27.0, {-DEPTH}], [32.0, 0.1]]"


def breaking():
    """A beach of 1:10 and no word of how high the waves are: auto expects none to break, and they do."""
    high, low = os.path.join(FOLDER, "high"), os.path.join(FOLDER, "low")
    for folder, height in ((high, 0.14), (low, 0.03)):
        write_waves(folder, height, PERIOD, DEPTH, 24, 28, 8, window=0.5)
    scene = flume(8.0, BEACH, 32.0)
    run = Run("breaks", scene, waves=high)
    told = " ".join(notes(run))
    found = re.fullmatch(r"t = ([\d.]+) s: water at a crest at x = ([\d.]+) m moves at ([\d.]+) of its celerity: turbulence switched on", told)
    expect(run.status == 0 and found is not None, f"breaking waves: exit {run.status}, said once: {told}")
    if found:
        depth = DEPTH - (float(found[2]) - 27.0) / 10
        expect(0.14 / depth > 0.5, f"breaking waves: noticed where H over the still water is {0.14 / depth:.2f} (bound 0.5: lower waves break on no slope)")
    expect(effect(run, "turbulence")["on"] and "switched on while running" in effect(run, "turbulence")["reason"], f"breaking waves: run.json: {effect(run, 'turbulence')}")
    expect("turbulence" in run.record["phases"], "breaking waves: turbulence takes its share of the time from then on")
    messages = loud("breaks_loud", scene, high)
    expect(messages.count("turbulence switched on") == 1, f"breaking waves: {messages.strip().splitlines()[0]}")
    switched = int(float(found[1]) / 0.5) - int(run.figure("start_time") / 0.5) if found else 4
    interrupted(run, scene, high, [switched - 1, switched + 1])

    of_another_version(run, scene, high)

    off = Run("breaks_off", scene, waves=high, sets=['effects.turbulence="off"'])
    told = " ".join(notes(off))
    expect('effects.turbulence is "off"' in told and not effect(off, "turbulence")["on"] and "turbulence" not in off.record["phases"], f"the user's off stays off: {told}")
    calm = Run("calm", scene, waves=low)
    expect(calm.status == 0 and not notes(calm) and not effect(calm, "turbulence")["on"], f"waves of 0.03 m that the particles do not show breaking: exit {calm.status}, {notes(calm)}")
    still = os.path.join(FOLDER, "steep")
    write_waves(still, 0.06, PERIOD, DEPTH, 24, 28, 10, window=0.5)
    surging = Run("surging", flume(10.0, f"[[0.0, {-DEPTH}], [27.0, {-DEPTH}], [28.0, 0.1]]", 28.0), waves=still)
    expect(surging.status == 0 and not notes(surging), f"waves that surge up 1:2 and stand twice as high there: {notes(surging)}")


def piston():
    """A piston that pushes a bore before it, one that swings gently, and one where nothing weighs and no wave can be."""
    def driven(name, rows, more="", depth=DEPTH, end=1.6):
        path = os.path.join(FOLDER, name + ".csv")
        with open(path, "w") as file:
            file.write("t, x\n" + "".join(f"{t:.3f}, {x:.5f}\n" for t, x in rows))
        return Run(name, f"""
[time]
end = {end}
window = 0.5
[flume]
bed = [[-2.0, {-depth}], [4.0, {-depth}]]
[cmps]
drive = "piston"
piston_file = "{path}"
offshore = 0.0
onshore = 4.0
particle_spacing = 0.025
{more}
""")

    t = np.arange(0, 2.0, 0.02)
    push = np.column_stack([t, 1.6 * np.clip(t - 0.1, 0, 0.7)])  # 0.8 sqrt(g d): a bore of twice the depth
    bore = driven("bore", push)
    expect(bore.status == 0 and len(notes(bore)) == 1 and effect(bore, "turbulence")["on"], f"piston, bore: exit {bore.status}, {notes(bore)}")
    swing = driven("swing", np.column_stack([t, 0.04 * (1 - np.cos(2 * np.pi * t / 1.6))]))
    expect(swing.status == 0 and not notes(swing), f"piston, gentle: exit {swing.status}, {notes(swing)}")
    # waves of 0.7 s, short for the water: their crests go at half the speed of long waves
    t = np.arange(0, 5.0, 0.01)
    short = [driven(f"short{stroke}", np.column_stack([t, 0.5 * stroke * np.clip(t / 1.4, 0, 1) * np.sin(2 * np.pi * t / 0.7)]), depth=0.5, end=4.0) for stroke in (0.03, 0.09)]
    expect(short[0].status == 0 and not notes(short[0]), f"piston, short waves of a quarter of the limiting steepness: {notes(short[0])}")
    expect(short[1].status == 0 and len(notes(short[1])) == 1 and effect(short[1], "turbulence")["on"], f"piston, short waves that break: {notes(short[1])}")
    weightless = driven("weightless", push, f"gravity = [0, 0]\nwater = [[[0, {-DEPTH}], [3, {-DEPTH}], [3, 0], [0, 0]]]\nwater_velocity = [[1.6, 0]]")
    expect(weightless.status == 0 and not notes(weightless), f"piston, no gravity: exit {weightless.status} {weightless.messages.strip()}, {notes(weightless)}")


def comes_over():
    """A wall whose crest auto holds to be out of reach, 1.25 depths up, and a surge of 0.75 depths."""
    def surge(name, share):
        folder = os.path.join(FOLDER, name)
        os.makedirs(folder, exist_ok=True)
        x = np.arange(24, 28.01, 0.05)
        for index in range(8):
            t = np.linspace(0.5 * index, 0.5 * (index + 1), 21)
            eta = share * DEPTH * np.interp(t, [0.6, 0.9, 1.4, 1.7], [0, 1, 1, 0])[:, None] * np.ones_like(x)
            u = eta * np.sqrt(9.81 * (DEPTH + eta)) / (DEPTH + eta)  # continuity of a long bore
            write_window(folder, index, t[0], t[-1], t, x, np.full_like(x, DEPTH), eta, u)
        with open(os.path.join(folder, "run.json"), "w") as file:
            file.write('{"stage": "boussinesq", "status": "done", "windows": 8}')
        return folder

    waves = surge("surge", 0.75)
    structure = f"structure = [[[28.0, {-DEPTH}], [28.0, {1.25 * DEPTH}], [28.2, {1.25 * DEPTH}], [28.2, {-DEPTH}]]]"
    scene = flume(3.5, f"[[0.0, {-DEPTH}], [40.0, {-DEPTH}]]", 29.5, structure, '[gauges]\nover = {x = 28.2, kind = "overtopping"}')
    run = Run("over", scene, waves=waves)
    told = [note for note in notes(run) if "overtopping_basin" in note]
    expect(run.status == 0 and len(told) == 1, f"surge: exit {run.status} {run.messages.strip()}, said once: {told}")
    expect(effect(run, "overtopping_basin")["on"] and "out of reach; switched on while running" in effect(run, "overtopping_basin")["reason"], f"surge: {effect(run, 'overtopping_basin')}")
    expect(run.figure("particles", "overtopped") > 0 and run.invariant("particle_ledger") == 0, f"surge: {run.figure('particles', 'overtopped'):.0f} particles over the crest, ledger exact")
    _, volume = run.gauge("over", "overtopped_volume")
    expect(abs(volume[-1] - run.figure("overtopped_volume")) < 1e-6 and np.all(np.diff(volume) > -1e-9), f"surge: gauge {volume[-1]:.4f} m2, ledger {run.figure('overtopped_volume'):.4f} (same), never falling")
    on = Run("over_on", scene, waves=waves, sets=['effects.overtopping_basin="on"'])
    expect(abs(on.figure("overtopped_volume") / run.figure("overtopped_volume") - 1) < 0.15, f"surge: {on.figure('overtopped_volume'):.4f} m2 with the basin from the start (bound 15 %: what a spacing more or less of a crest makes)")
    off = Run("over_off", scene, waves=waves, sets=['effects.overtopping_basin="off"'])
    expect(off.status == 0 and off.figure("particles", "overtopped") == 0 and not [n for n in notes(off) if "basin" in n], "surge: the user's off leaves the water in the run, without a word")
    interrupted(run, scene, waves, [2, len(run.windows()) - 1])
    low = Run("under", scene, waves=surge("low_surge", 0.3))
    expect(low.status == 0 and not notes(low) and not effect(low, "overtopping_basin")["on"], f"surge of 0.3 depths: nothing comes over, nothing is said: {notes(low)}")


def expected():
    """What auto says beforehand, from the depths over the whole near field."""
    def told(name, scene):
        path = os.path.join(FOLDER, name + ".toml")
        with open(path, "w") as file:
            file.write(scene)
        done = subprocess.run([PROGRAM, "check", path], capture_output=True, text=True)
        line = re.search(r"turbulence +(on|off) +(.*)", done.stdout)
        return (line[1], line[2]) if line else ("", done.stderr)

    level = f"[[0.0, {-DEPTH}], [40.0, {-DEPTH}]]"
    bar = f"[[0.0, {-DEPTH}], [26.0, {-DEPTH}], [27.0, -0.08], [27.5, -0.08], [28.5, {-DEPTH}], [40.0, {-DEPTH}]]"
    mound = f"structure = [[[26.5, {-DEPTH}], [27.0, -0.1], [27.3, -0.1], [27.3, 0.1], [27.5, 0.1], [27.5, {-DEPTH}]]]"
    steep = f"[[0.0, {-DEPTH}], [27.0, {-DEPTH}], [28.0, 0.1]]"
    solitary = '[waves]\nkind = "solitary"\nheight = 0.08'
    for name, bed, onshore, more, waves, wanted in (
            ("level bed", level, 30, "", regular(0.1), "off"), ("level bed, high", level, 30, "", regular(0.33), "on"),
            ("beach", BEACH, 32.0, "", regular(0.06), "on"), ("steep beach", steep, 28.0, "", regular(0.06), "off"),
            ("bar", bar, 30, "", regular(0.06), "on"), ("bar, low", bar, 30, "", regular(0.02), "off"),
            ("mound at a wall", level, 28, mound, regular(0.06), "on"), ("mound at a wall, low", level, 28, mound, regular(0.03), "off"),
            ("solitary, beach", BEACH, 32.0, "", solitary, "on"), ("solitary, steep", steep, 28.0, "", solitary, "off")):
        word, reason = told(name.replace(" ", "_").replace(",", ""), flume(8, bed, onshore, more, waves))
        expect(word == wanted, f"{name}: turbulence {word}: {reason}")


for case in (breaking, piston, comes_over, expected):
    if len(sys.argv) < 2 or sys.argv[1] in case.__name__:
        case()
finish()
