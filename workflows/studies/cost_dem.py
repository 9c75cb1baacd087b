"""What accuracy costs for the blocks: one factor at a time, exact cases and ensemble statistics.

    make -C workflows cost            (SMOKE=1: the ends of each ladder, two seeds)

Exact cases: `impact` (two spheres, Hertz: error of the rebound speed without damping and of the energy balance with it) and `fall` (a sphere
in still water with quadratic drag: distance against the closed form). Trajectories of armour are chaotic: there the error is that of a mean
over mound seeds, the displacement of 18 blocks in a strong oscillating current, against the finest step, with its 95 % confidence interval.
Factors: time step, contact law, interval between samples of the water, spheres a block (96, 48, 24 in the same outline), sleeping.
Writes cost_dem.csv and cost_dem.png.
"""
import argparse
import csv
import math
import pathlib
import statistics
import subprocess
import sys

import numpy

here = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(here.parent), str(here.parent / "plots"), str(here.parents[1] / "tests" / "support")]
import dem_flow  # noqa: E402
import run_folder  # noqa: E402
from style import BLOCKS, plt  # noqa: E402

arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
arguments.add_argument("--bin", type=pathlib.Path, required=True)
arguments.add_argument("--out", type=pathlib.Path, required=True)
arguments.add_argument("--scene", type=pathlib.Path, help="taken by other studies; not used here")
arguments.add_argument("--smoke", action="store_true")
options = arguments.parse_args()
options.out.mkdir(parents=True, exist_ok=True)
work = options.out / "cost_dem_runs"
work.mkdir(exist_ok=True)
seeds = range(1, 3 if options.smoke else 7)

ARMOUR = """
accuracy = "standard"
[time]
end = 5.0
window = 5.0
[dem]
width = 0.3
friction = 0.3
time_step = 1.0e-4
flow_interval = 2.0e-3
output_interval = 0.5
[dem.blocks]
shape = "beehive96"
rows = 3
columns = 6
origin = [0.525, 0.025]
pitch = [0.05, 0.05]
[dem.mound]
profile = [[0.0, -0.3], [1.0, -0.3]]
roughness = 0.004
[dem.packing]
speed = 5.0e-3
"""
IMPACT = """
[time]
end = 0.02
window = 0.02
[dem]
dry = true
gravity = [0.0, 0.0, 0.0]
friction = 0.0
output_interval = 0.02
[[dem.block]]
shape = "sphere"
position = [-0.0041, 0.0, 0.0]
velocity = [0.1, 0.0, 0.0]
[[dem.block]]
shape = "sphere"
position = [0.0041, 0.0, 0.0]
velocity = [-0.1, 0.0, 0.0]
"""
FALL = """
[time]
end = 0.48
window = 0.48
[dem]
viscosity = 0.0
output_interval = 0.48
time_step = 1.0e-4
[[dem.block]]
shape = "sphere"
position = [0.0, 0.0, -1.0]
"""
COLUMNS = ["stage", "case", "factor", "setting", "error", "error_half_width", "against", "statistic", "statistic_half_width", "compute_s", "compute_least_s",
           "compute_most_s", "cpu_s", "peak_memory_bytes", "steps", "blocks"]


def dem(name, text, *settings, flow=None):
    """Runs a scene given as text; returns its folder."""
    scene = work / f"{name}.toml"
    scene.write_text(text)
    folder = work / name
    command = [options.bin / "dem", "run", scene, "--out", folder, "--quiet"] + (["--flow", flow] if flow else [])
    for setting in settings:
        command += ["--set", setting]
    subprocess.run([str(word) for word in command], check=True)
    return folder


def costs(folders):
    """Cost columns of some runs of the same setting: median, least and most."""
    records = [run_folder.read_run(folder) for folder in folders]
    steps_time = [record["phases"]["steps"]["seconds"] for record in records]
    return {"compute_s": statistics.median(steps_time), "compute_least_s": min(steps_time), "compute_most_s": max(steps_time),
            "cpu_s": statistics.median(record["cpu_time"] for record in records),
            "peak_memory_bytes": max(record["peak_memory"] for record in records),
            "steps": int(records[0]["figures"]["steps"]), "blocks": int(records[0]["figures"]["blocks"])}


def ends_of(ladder):
    return [ladder[0], ladder[-1]] if options.smoke else ladder


rows = []
for step in ends_of([4e-5, 2e-5, 1e-5, 5e-6]):
    folder = dem(f"impact_{step}", IMPACT, f"dem.time_step={step}", "dem.damping_ratio=0.0")
    _, velocity = run_folder.read_series(folder, "/blocks/velocity")
    rows.append({"stage": "dem", "case": "impact", "factor": "time step", "setting": step, "error": abs(velocity[-1, 1, 0] / 0.1 - 1),
                 "against": "exact: elastic rebound", **costs([folder])})
    folder = dem(f"impact_damped_{step}", IMPACT, f"dem.time_step={step}")
    rows.append({"stage": "dem", "case": "impact, damped", "factor": "time step", "setting": step,
                 "error": abs(run_folder.read_run(folder)["invariants"]["energy_closure"]["value"]), "against": "energy balance", **costs([folder])})

a = (3.689 - 1) / (3.689 + 0.5) * 9.81
terminal = math.sqrt((3.689 - 1) * 9.81 * 0.008 * 4 / 3 / 0.4)
fall = terminal**2 / a * math.log(math.cosh(a * 0.48 / terminal))
for interval in ends_of([0.04, 0.02, 0.01, 0.005, 0.0025]):
    folder = dem(f"fall_{interval}", FALL, f"dem.flow_interval={interval}")
    _, position = run_folder.read_series(folder, "/blocks/position")
    rows.append({"stage": "dem", "case": "fall", "factor": "flow interval", "setting": interval,
                 "error": abs((-1 - position[-1, 0, 2]) / fall - 1), "against": "exact: ln cosh", **costs([folder])})


def current(t, X, Z):
    """0.95 m/s and 1.65 s, coming on over the first period."""
    omega, speed = 2 * math.pi / 1.65, 0.95 * min(1.0, t / 1.65)
    return speed * numpy.sin(omega * t), 0.0, speed * omega * numpy.cos(omega * t), 0.0, 1.0


flow = work / "flow"
if not (flow / "window_000000.h5").exists():
    dem_flow.write_flow(str(flow), current, numpy.linspace(-1, 2, 31), numpy.linspace(-1, 1, 21), 0.0, 5.0, 5.0, 0.02)


def ensemble(name, *settings):
    """Mean displacement (m) over blocks for each seed."""
    folders = [dem(f"{name}_{seed}", ARMOUR, f"dem.mound.seed={seed}", *settings, flow=flow) for seed in seeds]
    return numpy.array([run_folder.read_run(folder)["figures"]["damage"]["mean_displacement"] for folder in folders]), folders


def half_width(values):
    """Of the 95 % confidence interval of the mean (Student's t)."""
    t = {2: 12.71, 6: 2.57}.get(len(values), 2.0)
    return t * values.std(ddof=1) / math.sqrt(len(values))


reference, folders = ensemble("reference", "dem.time_step=1.25e-5", "dem.flow_interval=5.0e-4", "effects.sleeping=off")
rows.append({"stage": "dem", "case": "armour", "factor": "reference", "setting": "1.25e-5 s", "error": 0.0, "error_half_width": 0.0, "against": "itself",
             "statistic": reference.mean(), "statistic_half_width": half_width(reference), **costs(folders)})
ladders = [("time step", "dem.time_step={}", ends_of([4e-4, 2e-4, 1e-4, 5e-5, 2.5e-5])), ("flow interval", "dem.flow_interval={}", ends_of([3.2e-2, 8e-3, 2e-3, 5e-4])),
           ("contact law", "dem.contact={}", ["hertz", "linear"]), ("spheres a block", "dem.blocks.shape={}", ["beehive96", "beehive48", "beehive24"]),
           ("sleeping", "effects.sleeping={}", ["on", "off"])]
for factor, key, settings in ladders:
    for setting in settings:
        try:
            values, folders = ensemble(f"{factor.replace(' ', '_')}_{setting}", key.format(setting))
        except subprocess.CalledProcessError:
            print(f"{factor} = {setting}: noticed as unstable", file=sys.stderr)
            continue
        paired = values - reference  # the same mounds
        rows.append({"stage": "dem", "case": "armour", "factor": factor, "setting": setting, "error": abs(paired.mean()) / reference.mean(),
                     "error_half_width": half_width(paired) / reference.mean(), "against": "finest step, same seeds", "statistic": values.mean(),
                     "statistic_half_width": half_width(values), **costs(folders)})

with open(options.out / "cost_dem.csv", "w", newline="") as file:
    table = csv.DictWriter(file, fieldnames=COLUMNS)
    table.writeheader()
    table.writerows(rows)

figure, axes = plt.subplots(1, 2, figsize=(12, 4.2))
for case, marker in (("impact", "o"), ("impact, damped", "s"), ("fall", "^")):
    points = sorted((float(row["setting"]), row["error"]) for row in rows if row["case"] == case)
    setting, error = numpy.array(points).T
    order = numpy.polyfit(numpy.log(setting), numpy.log(numpy.maximum(error, 1e-16)), 1)[0]
    axes[0].loglog(setting, error, marker + "-", label=f"{case}: order {order:.1f}")
axes[0].set_xlabel("time step or flow interval (s)"), axes[0].set_ylabel("error"), axes[0].legend(), axes[0].set_title("exact cases")
armour = [row for row in rows if row["case"] == "armour" and row["factor"] != "reference"]
for k, factor in enumerate(dict.fromkeys(row["factor"] for row in armour)):
    some = [row for row in armour if row["factor"] == factor]
    axes[1].errorbar([row["compute_s"] for row in some], [row["error"] for row in some], [row["error_half_width"] for row in some], fmt="o", capsize=3,
                     color=f"C{k}", label=factor)
    for row in some:
        axes[1].annotate(str(row["setting"]), (row["compute_s"], row["error"]), fontsize=7, xytext=(4, 3), textcoords="offset points")
best, front = math.inf, []
for row in sorted(armour, key=lambda row: row["compute_s"]):
    if row["error"] < best:
        best = row["error"]
        front.append(row)
axes[1].plot([row["compute_s"] for row in front], [row["error"] for row in front], "--", color=BLOCKS, lw=1, label="Pareto front")
axes[1].set_xscale("log"), axes[1].set_xlabel("time of the steps (s)"), axes[1].set_ylabel("error of the mean displacement")
axes[1].set_title(f"18 blocks, {len(seeds)} seeds, 95 % interval"), axes[1].legend(fontsize=8)
figure.savefig(options.out / "cost_dem.png")
