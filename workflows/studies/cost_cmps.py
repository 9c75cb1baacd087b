#!/usr/bin/python3
"""What accuracy costs in cmps: error against wall time, as CSV and picture.

    cost_cmps.py --bin BIN --out DIR [--smoke] [--repeats N]

Cases with a true answer:
    still    still water: floor pressure against rho g h, noise
    dam      Lobovsky et al. (2014): level in the reservoir and impact pressure
    solitary solitary wave against a wall: run-up against Su & Mirie (1980)
    wave     standing wave, ka = 0.16, kh = 1.6, six periods: height lost in a period (exact: none)
    flume    regular waves of H/h = 0.25 along a flume: height lost over three wave lengths (exact: none)
The ladder (particles over the depth) for each, and one factor at a time around the defaults at 20 over the depth: gradient, source,
Laplacian, surface condition, kernel, time stepping, shifting, velocity filter, density term, solver tolerance, time step; then sets
that a level may be made of, on the flume as well: waves are what a cheaper set must not spoil. Errors are the rms
over lattices (the spacing times 0.96 to 1.04), for what waves lose the mean: one lattice's figure for a wave is off by itself by chance.

Runs that are there already are read, not run again. --part K/N runs every N-th of them and writes no table, so that parts can run
side by side or one after the other; the call without it then writes table and picture.
"""
import csv
import json
import os
import subprocess
import sys

import h5py
import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [os.path.join(HERE, ".."), os.path.join(HERE, "../../tests/support")]
import study  # noqa: E402
from cmps_waves import wave_number, write_waves  # noqa: E402

HEAD = "stage,case,factor,setting,error,error_least,error_most,error_is,wall_s,wall_min_s,wall_max_s,cpu_s,peak_memory_MB,steps,particles,status".split(",")

STILL = """
title = "still water"
[time]
end = {end}
window = 1.0
[gauges]
floor = {{x = 0.2, z = 0.0, kind = "pressure", interval = 0.04}}
[cmps]
drive = "none"
tank = [0, 0.4, 0, 0.5]
water = [[[0, 0], [0.4, 0], [0.4, 0.3], [0, 0.3]]]
particle_spacing = {spacing}
particles_interval = 1.0
"""

DAM = """
title = "dam break"
[time]
end = {end}
window = 0.5
[gauges]
H1 = {{x = 0.3, interval = 0.005}}
H2 = {{x = 0.865, interval = 0.005}}
[cmps]
drive = "none"
tank = [0, 1.61, 0, 0.6]
water = [[[0, 0], [0.6, 0], [0.6, 0.3], [0, 0.3]]]
particle_spacing = {spacing}
"""

SOLITARY = """
title = "solitary wave"
[time]
end = {end}
window = 0.5
[flume]
bed = [[0.0, -0.2], [8.0, -0.2]]
[gauges]
middle = 3.0
wall = 4.98
[cmps]
drive = "piston"
piston_file = "{piston}"
offshore = 1.0
onshore = 5.0
particle_spacing = {spacing}
"""


WAVE = """
title = "standing wave"
[time]
end = {end}
window = 1.0
[cmps]
drive = "none"
tank = [0, 0.6, 0, 0.5]
water = [[[0, 0], [0.6, 0], {surface}]]
particle_spacing = {spacing}
particles_interval = 0.04
"""
FLUME = """
title = "regular waves along a flume"
[time]
end = {end}
window = 1.0
[flume]
bed = [[0.0, -0.4], [60.0, -0.4]]
[waves]
kind = "regular"
height = 0.1
period = 1.65
[gauges]
near = {{x = 26.5, interval = 0.02}}
far = {{x = {far}, interval = 0.02}}
[cmps]
offshore = 25.0
onshore = 41.0
particle_spacing = {spacing}
particles_interval = 5.0
"""
FLUME_PERIOD, FLUME_DEPTH, FLUME_HEIGHT = 1.65, 0.4, 0.1
FLUME_LENGTH = 2 * np.pi / wave_number(FLUME_PERIOD, FLUME_DEPTH)
WAVE_PERIOD = 2 * np.pi / np.sqrt(9.81 * np.pi / 0.6 * np.tanh(np.pi / 0.6 * 0.3))


def wave_surface(depth=0.3, length=0.6, amplitude=0.03, points=40):
    x = np.linspace(length, 0, points)
    return ", ".join(f"[{a:.5f}, {depth + amplitude * np.cos(np.pi * a / length):.5f}]" for a in x)


def write_piston(path, depth=0.2, height=0.04, end=7.0, gravity=9.81):
    """Goring (1978): dX/dt = c eta / (d + eta) with eta at the plate."""
    k, c = np.sqrt(3 * height / (4 * depth**3)), np.sqrt(gravity * (depth + height))
    lead, step, x = 3.8 / (k * c), 0.005, 0.0
    with open(path, "w") as file:
        file.write("t,x\n")
        for i in range(int(end / step) + 1):
            file.write(f"{i * step:.4f},{x:.8f}\n")
            for _ in range(2):
                eta = height / np.cosh(k * (c * ((i + 0.25) * step - lead) - x)) ** 2
                x += 0.5 * step * c * eta / (depth + eta)


def series(folder, gauge, quantity):
    t, values = [], []
    for name in sorted(n for n in os.listdir(folder) if n.startswith("window_")):
        with h5py.File(os.path.join(folder, name)) as file:
            t.append(file[f"gauges/{gauge}/time"][:])
            values.append(file[f"gauges/{gauge}/{quantity}"][:])
    t, values = np.concatenate(t), np.concatenate(values)
    t, first = np.unique(t, return_index=True)
    return t, values[first]


def still_error(folder, spacing):
    _, p = series(folder, "floor", "pressure")
    p = p[len(p) // 2:] / (1000 * 9.81 * 0.3)
    return float(np.sqrt(np.mean((p - 1) ** 2)))


def dam_error(folder, _):
    # levels h/H of the experiment at t sqrt(g/H)
    measured = {"H1": [[1, 0.93], [2, 0.785], [3, 0.635], [4, 0.50], [5, 0.405]], "H2": [[2, 0.215], [3, 0.26], [4, 0.295], [5, 0.29]]}
    squares = []
    for gauge, points in measured.items():
        t, level = series(folder, gauge, "surface_elevation")
        for at, value in points:
            if at <= t[-1] * np.sqrt(9.81 / 0.3):
                squares.append((np.interp(at, t * np.sqrt(9.81 / 0.3), level / 0.3) - value) ** 2)
    return float(np.sqrt(np.mean(squares)))


def solitary_error(folder, _):
    t, middle = series(folder, "middle", "surface_elevation")
    _, wall = series(folder, "wall", "surface_elevation")
    epsilon = (middle[t < 3.2].max() - middle[t < 0.3].mean()) / 0.2
    return float(abs((wall.max() - wall[t < 0.3].mean()) / 0.2 / (2 * epsilon + epsilon**2 / 2 + 0.75 * epsilon**3) - 1))


def wave_error(folder, _):
    """Loss in a period: slope of the logarithm of the amplitude in windows of one period. The amplitude is that of the water's
    distribution over the tank, sum of cos(pi x / L) over particles: a gauge sees single particles and scatters by more than is lost."""
    t, shape = [], []
    for name in sorted(n for n in os.listdir(folder) if n.startswith("window_")):
        with h5py.File(os.path.join(folder, name)) as file:
            is_fluid = file["particles/kind"][:] == 0
            t.append(file["particles/time"][:])
            shape.append(np.cos(np.pi * file["particles/position"][:][:, is_fluid, 0] / 0.6).sum(axis=1))
    t, shape = np.concatenate(t), np.concatenate(shape)
    logarithm, centre = [], []
    for begin in np.arange(0.5, t[-1] / WAVE_PERIOD - 1, 0.25):
        use = (t >= begin * WAVE_PERIOD) & (t < (begin + 1) * WAVE_PERIOD)
        phase = 2 * np.pi * t[use] / WAVE_PERIOD
        basis = np.c_[np.cos(phase), np.sin(phase), np.cos(2 * phase), np.sin(2 * phase), np.ones(use.sum())]
        fit = np.linalg.lstsq(basis, shape[use], rcond=None)[0]
        logarithm.append(np.log(np.hypot(fit[0], fit[1])))
        centre.append(begin)
    if len(centre) < 2:
        return float("nan")  # the short form
    return float(1 - np.exp(np.polyfit(centre, logarithm, 1)[0]))


def flume_error(folder, _):
    """Height lost over three wave lengths: first harmonic over two periods, behind the ramp and before the end wall answers."""
    def harmonic(gauge, begin):
        t, eta = series(folder, gauge, "surface_elevation")
        use = (t >= begin) & (t < begin + 2 * FLUME_PERIOD)
        phase = 2 * np.pi * t[use] / FLUME_PERIOD
        return np.hypot(*np.linalg.lstsq(np.c_[np.cos(phase), np.sin(phase), np.ones(use.sum())], eta[use], rcond=None)[0][:2])
    return float(1 - harmonic("far", 12.4) / harmonic("near", 6.5))  # 8.8 m at the group's speed of 1.46 m/s


FEW, MANY = (0.97, 1.0, 1.03), (0.96, 0.98, 1.0, 1.02, 1.04)
CASES = {  # scene, depth, end, error, what it is, lattices
    "still": (STILL, 0.3, 4.0, still_error, "rms of p/(rho g h) - 1", MANY),
    "dam": (DAM, 0.3, 0.9, dam_error, "rms of levels over H, against the experiment", MANY),
    "wave": (WAVE, 0.3, 6.5 * WAVE_PERIOD, wave_error, "height of a standing wave lost in a period", MANY),
    "solitary": (SOLITARY, 0.2, 4.5, solitary_error, "run-up at the wall, relative", FEW),
    "flume": (FLUME, 0.4, 15.8, flume_error, "height lost over three wave lengths", (1.0,)),
}
LADDER = [8, 12, 16, 20, 24, 30, 40]
# Sets that a level may be made of: particles over the depth with other settings than the defaults.
SETS = [(16, "tolerance=1e-2"), (16, "tolerance=1e-2 time_step_factor=1.5"), (24, "tolerance=1e-2"), (24, "time_step_factor=1.5"), (24, "kernel_radius=3.1"), (30, "kernel_radius=3.1"), (40, "kernel_radius=3.1")]
LOSSES = ("wave", "flume")
SLOW = {"solitary": 40, "flume": 30}  # cases, and the particles over the depth from which sets are not run for them
FACTORS = [
    ("gradient", ["gradient=standard", "gradient=modified", "gradient=antisymmetric", "gradient=antisymmetric_local", "gradient=antisymmetric_corrected"]),
    ("source", ["source=density", "source=corrected", "source=error_compensating"]),
    ("laplacian", ["laplacian=higher_order"]),
    ("surface", ["surface=detected"]),
    ("kernel", ["kernel_radius=2.1", "kernel_radius=3.1", "kernel=rational"]),
    ("time_stepping", ["time_stepping=predicted"]),
    ("shifting", ["shifting=0", "shifting=0.1"]),
    ("velocity_filter", ["velocity_filter=0.02", "velocity_filter=0.3"]),
    ("density_weight", ["density_weight=0", "density_weight=0.005", "density_weight=0.1"]),
    ("stabilisation", ["stabilisation=0", "stabilisation=0.8"]),
    ("tolerance", ["tolerance=1e-2", "tolerance=1e-5"]),
    ("courant", ["courant=0.1", "courant=0.4"]),
    ("time_step", ["time_step_factor=0.5", "time_step_factor=1.5", "time_step_factor=2"]),
    ("both", ["tolerance=1e-2 time_step_factor=1.5", "tolerance=1e-2 time_step_factor=2"]),
]


def measure(arguments, case, particles_over_depth, factor, setting):
    template, depth, end, error_of, error_is, lattices = CASES[case]
    if arguments.smoke:
        end, lattices = min(end, 3.4 if case == "solitary" else 0.4), (1.0,)
    piston, waves = (os.path.abspath(os.path.join(arguments.out, name)) for name in ("piston.csv", "regular_waves"))
    walls, errors, cpu, record = [], [], [], {}
    for stretch in lattices:
        spacing = stretch * depth / particles_over_depth
        name = f"{case}_{particles_over_depth}_{setting.replace('=', '_').replace('.', '').replace(' ', '_')}_{100 * stretch:.0f}"
        scene = os.path.join(arguments.out, name + ".toml")
        with open(scene, "w") as file:
            file.write(template.format(spacing=spacing, end=end, piston=piston, surface=wave_surface(), far=26.5 + 3 * FLUME_LENGTH))
        for repeat in range(arguments.repeats):
            folder = os.path.join(arguments.out, f"{name}_{repeat}")
            command = [os.path.join(arguments.bin, "cmps"), "run", scene, "--out", folder, "--quiet"]
            if case == "flume":
                command += ["--waves", waves]
            for word in setting.split() if setting != "-" else []:
                command += ["--set", "cmps." + word]
            subprocess.run(command, capture_output=True)
            with open(os.path.join(folder, "run.json")) as file:
                record = json.load(file)
            walls.append(record["wall_time"]), cpu.append(record["cpu_time"])
        if record["status"] == "done":
            errors.append(error_of(folder, spacing))
    is_done = len(errors) == len(lattices)
    # a loss is a mean with a sign: by chance one lattice's wave grows, another's loses three times as much
    error = (abs(np.mean(errors)) if case in LOSSES else np.sqrt(np.mean(np.square(errors)))) if is_done else np.nan
    figures = record.get("figures", {})
    return ["cmps", case, factor, str(particles_over_depth) if factor == "resolution" else f"{particles_over_depth} {setting}" if factor == "set" else setting,
            f"{error:.5f}" if is_done else "", f"{min(errors):.5f}" if is_done else "", f"{max(errors):.5f}" if is_done else "", error_is,
            f"{np.median(walls):.3f}", f"{min(walls):.3f}", f"{max(walls):.3f}", f"{np.median(cpu):.3f}", f"{record['peak_memory'] / 1e6:.1f}", int(figures.get("steps", 0)),
            int(figures.get("particles", {}).get("all", 0)), record["status"] if is_done else record.get("message", "failed")[:60]]


def draw(rows, path):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    figure, axes = plt.subplots(1, len(CASES), figsize=(5 * len(CASES), 4.2))
    for axis, case in zip(axes, CASES):
        good = [(float(r[11]), abs(float(r[4])), r) for r in rows if r[1] == case and r[4]]
        ladder = sorted((t, e) for t, e, r in good if r[2] == "resolution")
        others = [(t, e, r[3]) for t, e, r in good if r[2] != "resolution"]
        axis.loglog([t for t, _ in ladder], [e for _, e in ladder], "o-", label="resolution")
        for t, e, label in others:
            axis.loglog(t, e, ".", color="0.5")
            axis.annotate(label, (t, e), fontsize=6, color="0.3")
        front, least = [], np.inf
        for t, e in sorted((t, e) for t, e, _ in good):
            if e < least:
                front.append((t, e))
                least = e
        axis.loglog([t for t, _ in front], [e for _, e in front], "k--", lw=0.8, label="Pareto front")
        if len(ladder) > 1:
            order = np.polyfit(np.log([float(r[3]) for _, _, r in good if r[2] == "resolution"]), np.log([e for _, e, r in good if r[2] == "resolution"]), 1)[0]
            axis.set_title(f"{case}: order {-order:.1f} in l0")
        axis.set_xlabel("CPU time (s)")
        axis.set_ylabel(CASES[case][4])
        axis.legend(fontsize=7)
    figure.tight_layout()
    figure.savefig(path, dpi=120)


def main():
    parser = study.command_line(__doc__)
    parser.add_argument("--repeats", type=int, default=1)
    parser.add_argument("--factor", action="append", help="this factor alone (resolution, set, or one of the factors); may be given again")
    parser.add_argument("--case", choices=list(CASES), help="this case alone")
    parser.add_argument("--part", help="K/N: every N-th run from the K-th (from 0), no table")
    arguments = parser.parse_args()
    os.makedirs(arguments.out, exist_ok=True)
    write_piston(os.path.join(arguments.out, "piston.csv"))
    plan = []
    for case, (_, _, end, *_) in CASES.items():
        if case == "flume":
            if arguments.smoke:
                continue  # it takes 16 s of waves before there is anything to see
            write_waves(os.path.join(arguments.out, "regular_waves"), FLUME_HEIGHT, FLUME_PERIOD, FLUME_DEPTH, 24, 30, end + 0.2, window=1.0)
        plan += [(case, level, "resolution", "-") for level in (LADDER[:2] if arguments.smoke else [16, 24] if case == "flume" else LADDER)]
        for factor, settings in FACTORS[:1] if arguments.smoke else [] if case == "flume" else FACTORS:
            plan += [(case, 8 if arguments.smoke else 20, factor, setting) for setting in settings]
        plan += [(case, level, "set", setting) for level, setting in ([] if arguments.smoke else SETS) if level < SLOW.get(case, 1000)]
    if arguments.case:
        plan = [entry for entry in plan if entry[0] == arguments.case]
    if arguments.factor:
        plan = [entry for entry in plan if entry[2] in arguments.factor]
    if arguments.part:
        part, parts = map(int, arguments.part.split("/"))
        plan = plan[part::parts]
    rows = []
    for entry in plan:
        rows.append(measure(arguments, *entry))
        print(",".join(map(str, rows[-1])), flush=True)
    if arguments.part:
        return
    with open(os.path.join(arguments.out, "cost_cmps.csv"), "w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(HEAD)
        writer.writerows(rows)
    draw(rows, os.path.join(arguments.out, "cost_cmps.png"))


if __name__ == "__main__":
    main()
