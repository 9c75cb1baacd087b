"""What accuracy costs for the blocks: one factor at a time, exact cases and ensemble statistics.

    make -C workflows cost            (SMOKE=1: the ends of each ladder, two seeds, half the time)

Exact cases: `impact` (two spheres, Hertz: error of the rebound speed without damping and of the energy balance with it) and `fall` (a sphere
in still water with quadratic drag: distance against the closed form).
Trajectories of armour are chaotic: a setting is judged by means over mound seeds, each seed against the same seed at the finest step and from
the same stored packing, with the 95 % confidence interval of the mean difference. What a change of rounding size (friction times 1 + 2e-7) does
to the finest run is given beside them: differences as small and as widely spread as that are no error of a setting. What tells settings apart is
the trajectory: how far each block's way is from that of the same block of the finest run (root mean square over blocks) when the current has
pushed them over for the first time and chaos has not grown yet. Of the rest, four statistics: displacement over the first swing and at the end,
energy dissipated (all that the water did to the blocks and they to each other), and blocks beyond a quarter of their length.
Factors: time step, contact law, interval between samples of the water, spheres a block (96, 48, 24 in the same outline), sleeping, and the three
accuracies. Writes cost_dem.csv (a row a setting and statistic) and cost_dem.png.
"""
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
import study  # noqa: E402
from style import BLOCKS, plt  # noqa: E402

arguments = study.command_line(__doc__)
arguments.add_argument("--seeds", type=int, default=20)
options = arguments.parse_args()
options.out.mkdir(parents=True, exist_ok=True)
work = options.out / "cost_dem_runs"
work.mkdir(exist_ok=True)
seeds = range(1, 3 if options.smoke else 1 + options.seeds)

ARMOUR = """
accuracy = "standard"
[time]
end = END
window = 5.0
[dem]
width = 0.3
friction = 0.3
time_step = 1.0e-4
flow_interval = 2.0e-3
output_interval = 0.1
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
ARMOUR = ARMOUR.replace("END", "2.6" if options.smoke else "5.0")
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
COLUMNS = ["stage", "case", "factor", "setting", "error", "error_half_width", "against", "statistic", "mean", "mean_half_width", "spread", "compute_s", "compute_least_s",
           "compute_most_s", "cpu_s", "peak_memory_bytes", "steps", "blocks"]


def dem(name, text, *settings, flow=None, start=None, verb="run"):
    """Runs a scene given as text; returns its folder. A finished run is left alone."""
    scene = work / f"{name}.toml"
    scene.write_text(text)
    folder = work / name
    if (folder / "run.json").exists() and run_folder.read_run(folder)["status"] == "done":
        return folder
    command = [options.bin / "dem", verb, scene, "--out", folder, "--quiet"] + (["--flow", flow] if flow else []) + (["--from", start] if start else [])
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


FIRST_PUSH, FIRST_SWING = 1.5, 2.5  # s: most of the first ways of some millimetres are made, and those of some centimetres
FINEST = ["dem.time_step=1.25e-5", "dem.flow_interval=5.0e-4", "effects.sleeping=off"]
TRAJECTORY = "trajectory (mm)"
STATISTICS = {"first swing (mm)": 1e3, "displacement (mm)": 1e3, "dissipated (mJ)": 1e3, "beyond a quarter length": 1}


STANDARD = {"dem.time_step=0.0001", "dem.flow_interval=0.002", "dem.contact=hertz", "dem.blocks.shape=beehive96", "effects.sleeping=on"}


def ensemble(*settings):
    """The statistics for each seed, and the folders. Settings that are the standard's anyway make no runs of their own."""
    settings = [setting for setting in settings if setting not in STANDARD]
    name = "armour_" + ("_".join(settings).replace("=", "_") or "standard")
    shape = [setting for setting in settings if setting.startswith("dem.blocks.shape")]
    folders = []
    for seed in seeds:
        mound = f"dem.mound.seed={seed}"
        packing = dem("_".join(["pack", *shape, str(seed)]).replace("=", "_"), ARMOUR, mound, *FINEST, *shape, verb="pack")
        folders.append(dem(f"{name}_{seed}", ARMOUR, mound, *settings, flow=flow, start=packing / "state.h5"))
    found = {key: [] for key in (*STATISTICS, TRAJECTORY)}
    for folder in folders:
        time, position = run_folder.read_series(folder, "/blocks/position")
        way = numpy.linalg.norm(position - position[0], axis=2).mean(axis=1)
        figures = run_folder.read_run(folder)["figures"]
        for key, value in zip(STATISTICS, (way[numpy.abs(time - FIRST_SWING).argmin()], way[-1], figures["energy"]["dissipated"],
                                           figures["damage"]["beyond_quarter_length"])):
            found[key].append(STATISTICS[key] * value)
        found[TRAJECTORY].append(1e3 * (position[numpy.abs(time - FIRST_PUSH).argmin()] - position[0]))
    return {key: numpy.array(values) for key, values in found.items()}, folders


reference, folders = ensemble(*FINEST)
ways = reference.pop(TRAJECTORY)  # (seed, block, 3)
reference[TRAJECTORY] = numpy.linalg.norm(ways, axis=2).mean(axis=1)
for statistic, values in reference.items():
    rows.append({"stage": "dem", "case": "armour", "factor": "reference", "setting": "1.25e-5 s", "against": "itself", "statistic": statistic, "error": 0.0,
                 "error_half_width": 0.0, "mean": values.mean(), "mean_half_width": study.half_width(values), **costs(folders)})
STEP, INTERVAL = "dem.time_step={}", "dem.flow_interval={}"
levels = {"draft": (2e-4, 4e-3), "standard": (1e-4, 2e-3), "fine": (5e-5, 1e-3)}
ladders = [("rounding", [(f"friction {sign}", [*FINEST, f"dem.friction={0.3 * (1 + change):.10f}"]) for sign, change in (("up", 2e-7), ("down", -2e-7))]),
           ("time step", [(step, [STEP.format(step)]) for step in ends_of([4e-4, 2e-4, 1e-4, 5e-5, 2.5e-5])]),
           ("flow interval", [(interval, [INTERVAL.format(interval)]) for interval in ends_of([3.2e-2, 8e-3, 4e-3, 2e-3, 5e-4])]),
           ("contact law", [(law, [f"dem.contact={law}"]) for law in ("hertz", "linear")]),
           ("spheres a block", [(shape, [f"dem.blocks.shape={shape}"]) for shape in ("beehive96", "beehive48", "beehive24")]),
           ("sleeping", [(word, [f"effects.sleeping={word}"]) for word in ("on", "off")]),
           ("accuracy", [(level, [STEP.format(step), INTERVAL.format(interval)]) for level, (step, interval) in levels.items()])]
for factor, settings in ladders:
    for setting, words in settings:
        try:
            found, folders = ensemble(*words)
        except subprocess.CalledProcessError:
            print(f"{factor} = {setting}: noticed as unstable", file=sys.stderr)
            continue
        cost = costs(folders)
        off = found[TRAJECTORY] - ways
        found[TRAJECTORY] = numpy.linalg.norm(found[TRAJECTORY], axis=2).mean(axis=1)
        for statistic, values in found.items():
            # The same mounds; of a trajectory what counts is how far it is off, to whichever side.
            paired = numpy.sqrt((off**2).sum(axis=2).mean(axis=1)) if statistic == TRAJECTORY else values - reference[statistic]
            scale = max(reference[statistic].mean(), 1e-12)
            rows.append({"stage": "dem", "case": "armour", "factor": factor, "setting": setting, "error": paired.mean() / scale,
                         "error_half_width": study.half_width(paired) / scale, "against": "finest step, same seeds", "statistic": statistic,
                         "mean": values.mean(), "mean_half_width": study.half_width(values), "spread": paired.std(ddof=1) / scale, **cost})
        print(f"{factor:16s} {str(setting):10s} {cost['compute_s']:7.3f} s steps, {cost['cpu_s']:6.2f} s CPU ", "; ".join(
            f"{row['statistic']} {100 * row['error']:+.2f} +- {100 * row['error_half_width']:.2f} (spread {100 * row['spread']:.2f}) %" for row in rows[-1 - len(STATISTICS):]), flush=True)

with open(options.out / "cost_dem.csv", "w", newline="") as file:
    table = csv.DictWriter(file, fieldnames=COLUMNS)
    table.writeheader()
    table.writerows(rows)

figure, axes = plt.subplots(1, 3, figsize=(16, 4.2))
for case, marker in (("impact", "o"), ("impact, damped", "s"), ("fall", "^")):
    points = sorted((float(row["setting"]), row["error"]) for row in rows if row["case"] == case)
    setting, error = numpy.array(points).T
    order = numpy.polyfit(numpy.log(setting), numpy.log(numpy.maximum(error, 1e-16)), 1)[0]
    axes[0].loglog(setting, error, marker + "-", label=f"{case}: order {order:.1f}")
axes[0].set_xlabel("time step or flow interval (s)"), axes[0].set_ylabel("error"), axes[0].legend(), axes[0].set_title("exact cases")
for axis, statistic in zip(axes[1:], (TRAJECTORY, "dissipated (mJ)")):
    armour = [row for row in rows if row["case"] == "armour" and row["factor"] not in ("reference", "rounding") and row["statistic"] == statistic]
    floor = max(abs(row["error"]) + row["error_half_width"] for row in rows if row["factor"] == "rounding" and row["statistic"] == statistic)
    axis.axhspan(0, 100 * floor, color="0.92", label="rounding (error and half width)")
    for k, factor in enumerate(dict.fromkeys(row["factor"] for row in armour)):
        some = [row for row in armour if row["factor"] == factor]
        axis.errorbar([row["cpu_s"] for row in some], [100 * abs(row["error"]) for row in some], [100 * row["error_half_width"] for row in some], fmt="o",
                      capsize=3, color=f"C{k}", label=factor)
    names = {(row["cpu_s"], 100 * abs(row["error"])): str(row["setting"]) for row in armour}  # one for the standard, which is in every ladder
    for point, name in names.items():
        axis.annotate(name, point, fontsize=7, xytext=(4, 3), textcoords="offset points")
    # Of a statistic only the far end of its interval is known for sure; trajectories are compared seed by seed.
    best, front = math.inf, []
    for row in sorted(armour, key=lambda row: row["cpu_s"]):
        sure = 100 * (abs(row["error"]) + (0 if statistic == TRAJECTORY else row["error_half_width"]))
        if sure < best:
            best = sure
            front.append((row["cpu_s"], sure))
    axis.plot(*zip(*front), "--", color=BLOCKS, lw=1, label="Pareto front" + ("" if statistic == TRAJECTORY else " (error and half width)"))
    axis.set_xscale("log"), axis.set_xlabel("processor time of a run (s)"), axis.set_ylabel(f"error of {statistic.split(' (')[0]} (%)")
    axis.set_title(f"18 blocks, {len(seeds)} seeds, 95 % interval"), axis.legend(fontsize=8)
axes[1].set_yscale("log")
figure.savefig(options.out / "cost_dem.png")
