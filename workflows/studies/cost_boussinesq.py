"""What accuracy costs in boussinesq: error over time for cases with a true answer, one factor at a time.

    make -C workflows cost            (SMOKE=1: the coarse ends only, one repeat)

Cases: `dispersion` (waves of kh = 1.35 over 5.4 lengths: complex gain against the exact wave number of the equations),
`solitary` (H/d = 0.2 over 100 depths: largest difference to the exact wave, alpha = 1) and `bar` (Luth et al. 1994, case A:
rms difference of six gauges to the finest run over the range, the finest row being the reference itself).
Factors: cell size, step size (Courant number), and what is left out (dispersion off). Times are of the run itself, from run.json:
median, least and most of the repeats; what `check` told of steps and time over what they came to is listed too. Writes cost_boussinesq.csv and cost_boussinesq.png.
"""
import csv
import math
import pathlib
import re
import statistics
import subprocess
import sys

import numpy

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
import run_folder  # noqa: E402
import study  # noqa: E402

COLUMNS = ["stage", "case", "factor", "setting", "cells_per_length", "error", "against", "compute_s", "compute_least_s", "compute_most_s", "wall_s", "cpu_s",
           "peak_memory_bytes", "steps", "cells", "ns_per_cell_step", "forecast_steps_over_steps", "forecast_time_over_cpu"]

DISPERSION = """
[time]
end = 90.0
window = 90.0
[flume]
bed = [[0.0, -0.8], [80.0, -0.8]]
[waves]
kind = "regular"
height = 0.002
period = 1.65
[boussinesq]
output_interval = 10.0
shoreward_sponge = 30.0
[gauges]
near = {x = 16.0, interval = 0.0165}
far = {x = 36.0, interval = 0.0165}
"""
SOLITARY = """
[time]
end = 29.1457257
window = 29.1457257
[flume]
bed = [[0.0, -1.0], [150.0, -1.0]]
[waves]
kind = "solitary"
height = 0.2
position = 25.0
[boussinesq]
alpha = 1.0
output_interval = 29.1457257
"""
BAR_GAUGES = (10.5, 12.5, 13.5, 14.5, 17.3, 21.0)
BAR = """
[time]
end = 50.0
window = 50.0
[flume]
bed = [[-10.0, -0.4], [6.0, -0.4], [12.0, -0.1], [14.0, -0.1], [17.0, -0.4], [36.0, -0.4]]
[waves]
kind = "regular"
height = 0.02
period = 2.02
[boussinesq]
output_interval = 10.0
[gauges]
""" + "\n".join(f'"g{x}" = {{x = {x}, interval = 0.02}}' for x in BAR_GAUGES) + "\n"


def wave_number(angular_frequency, depth, alpha=1.153):
    """Of the equations solved: (alpha-1)/3 X^2 + (1 - alpha w/3) X - w = 0 with X = (k d)^2."""
    w = angular_frequency ** 2 * depth / 9.81
    b = 1 - alpha * w / 3
    return math.sqrt(2 * w / (b + math.sqrt(b * b + 4 * (alpha - 1) / 3 * w))) / depth


def dispersion_error(folder, _):
    """|gain between the gauges - exact gain|: phase error in radians and decay at once."""
    w = 2 * math.pi / 1.65
    amplitudes = []
    for name in ("near", "far"):
        time, elevation = run_folder.gauge(folder, name)
        last = time > 90.0 - 10 * 1.65
        columns = numpy.column_stack([numpy.cos(w * time[last]), numpy.sin(w * time[last]), numpy.ones(last.sum())])
        a, b, _ = numpy.linalg.lstsq(columns, elevation[last], rcond=None)[0]
        amplitudes.append(complex(a, b))
    gain = amplitudes[1] / amplitudes[0]
    return abs(gain - numpy.exp(1j * wave_number(w, 0.8) * 20.0)), "exact wave number of the equations"


def solitary_error(folder, _):
    """Largest difference to the exact wave after 100 depths, over its height (cell averages)."""
    _, elevation = run_folder.read_series(folder, "/surface_elevation")
    x = run_folder.static(folder, "/x")
    k, half = math.sqrt(0.6 / 4.8), 0.5 * (x[1] - x[0])
    exact = 0.2 * (numpy.tanh(k * (x + half - 125)) - numpy.tanh(k * (x - half - 125))) / (2 * k * half)
    return float(abs(elevation[-1] - exact).max() / 0.2), "exact solitary wave"


def bar_error(folder, reference):
    if reference is None:
        return float("nan"), "reference"
    errors = []
    for x in BAR_GAUGES:
        time, elevation = run_folder.gauge(folder, f"g{x}")
        other_time, other = run_folder.gauge(reference, f"g{x}")
        last = time > 40.0
        true = numpy.interp(time[last], other_time, other)
        errors.append(numpy.sqrt(numpy.mean((elevation[last] - true) ** 2)) / (true.max() - true.min()))
    return float(numpy.mean(errors)), f"run with spacing {BAR_FINEST} m"


BAR_FINEST = 0.0125
# Shortest length that matters: the incident wave; for the solitary wave the width of its crest, 2 / K = 5.7 depths.
CASES = {"dispersion": (DISPERSION, dispersion_error, (0.2, 0.1, 0.05, 0.025), 0.05, 3.70),
         "solitary": (SOLITARY, solitary_error, (0.4, 0.2, 0.1, 0.05), 0.1, 5.7),
         "bar": (BAR, bar_error, (0.1, 0.05, 0.025, BAR_FINEST), 0.05, 3.74)}


SECONDS = {"s": 1.0, "min": 60.0, "h": 3600.0}


def forecast(options, scene, words):
    """(steps, seconds) that `check` tells."""
    told = subprocess.run([str(options.bin / "boussinesq"), "check", str(scene)] + [w for word in words for w in ("--set", word)], capture_output=True, text=True, check=True).stdout
    steps = float(re.search(r"steps\s+about ([\d.e+]+)", told)[1])
    number, unit = re.search(r"run time\s+about ([\d.e+-]+) (s|min|h)\b", told).groups()
    return steps, float(number) * SECONDS[unit]


def run_case(options, case, factor, setting, words, reference=None):
    text, error_of, _, _, length = CASES[case]
    out = options.out / "cost_boussinesq"
    out.mkdir(parents=True, exist_ok=True)
    scene = out / f"{case}.toml"
    scene.write_text(text)
    folder = out / f"{case}_{factor}_{setting}"
    compute, wall, cpu = [], [], []
    for _ in range(1 if options.smoke else 3):
        for old in folder.glob("run.json"):
            old.unlink()
        command = [str(options.bin / "boussinesq"), "run", str(scene), "--out", str(folder), "--quiet"] + [w for word in words for w in ("--set", word)]
        ended = subprocess.run(command, stderr=subprocess.PIPE, text=True)
        if ended.returncode != 0:
            sys.exit(f"{' '.join(command)}\n{ended.stderr.strip()} (exit {ended.returncode})")
        record = run_folder.read_run(folder)
        compute.append(record["figures"]["compute_seconds"])
        wall.append(record["wall_time"])
        cpu.append(record["cpu_time"])
    error, against = error_of(folder, reference)
    told_steps, told_seconds = forecast(options, scene, words)
    figures, row_cpu = record["figures"], statistics.median(cpu)
    row = {"stage": "boussinesq", "case": case, "factor": factor, "setting": setting, "cells_per_length": length / figures["spacing"],
           "error": error, "against": against, "compute_s": statistics.median(compute), "compute_least_s": min(compute), "compute_most_s": max(compute),
           "wall_s": statistics.median(wall), "cpu_s": row_cpu, "peak_memory_bytes": record["peak_memory"],
           "steps": figures["steps"], "cells": figures["cells"], "ns_per_cell_step": figures["nanoseconds_per_cell_step"], "forecast_steps_over_steps": told_steps / figures["steps"],
           "forecast_time_over_cpu": told_seconds / row_cpu}
    print(f"{case:11} {factor:10} {setting!s:6} error {error:.2e}   {row['compute_s']:.3f} s   {figures['cells']:.0f} cells   "
          f"forecast over real: steps {row['forecast_steps_over_steps']:.2f}, time {row['forecast_time_over_cpu']:.2f}", flush=True)
    return row, folder


def draw(rows, path):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as pyplot
    figure, axes = pyplot.subplots(1, len(CASES), figsize=(4.6 * len(CASES), 4.2))
    for axis, case in zip(axes, CASES):
        shown = [row for row in rows if row["case"] == case and numpy.isfinite(row["error"]) and row["error"] > 0]
        for factor, marker in (("spacing", "o-"), ("courant", "s--"), ("left out", "x")):
            points = [row for row in shown if row["factor"] == factor]
            axis.loglog([row["compute_s"] for row in points], [row["error"] for row in points], marker, label=factor, markersize=5)
            for row in points:
                axis.annotate(row["setting"], (row["compute_s"], row["error"]), textcoords="offset points", xytext=(5, 4), fontsize=7)
        front = [row for row in shown if not any(o["error"] < row["error"] and o["compute_s"] <= row["compute_s"] for o in shown)]
        axis.loglog([row["compute_s"] for row in front], [row["error"] for row in front], "o", markersize=12, markerfacecolor="none",
                    markeredgecolor="k", linestyle="none", label="Pareto front")
        ladder = [row for row in shown if row["factor"] == "spacing"]
        orders = [math.log(a["error"] / b["error"]) / math.log(b["cells"] / a["cells"]) for a, b in zip(ladder, ladder[1:])]
        axis.set(title=f"{case}: order " + ", ".join(f"{order:.1f}" for order in orders), xlabel="computing time, s", ylabel="relative error")
        axis.grid(True, which="both", alpha=0.25)
        axis.legend(fontsize=7)
    figure.tight_layout()
    figure.savefig(path, dpi=130)


def main():
    parser = study.command_line(__doc__)
    options = parser.parse_args()
    rows = []
    for case, (_, _, spacings, usual, _) in CASES.items():
        spacings = spacings[:2] if options.smoke else spacings
        reference = None
        if case == "bar":  # the finest run is the truth of the others
            row, reference = run_case(options, case, "spacing", spacings[-1], [f"boussinesq.spacing={spacings[-1]}"])
            rows.append(row)
            spacings = spacings[:-1]
        for spacing in spacings:
            rows.append(run_case(options, case, "spacing", spacing, [f"boussinesq.spacing={spacing}"], reference)[0])
        usual = spacings[-1] if options.smoke else usual
        for courant in (0.5,) if options.smoke else (0.25, 0.5, 0.65, 1.0):
            rows.append(run_case(options, case, "courant", courant, [f"boussinesq.spacing={usual}", f"boussinesq.courant={courant}"], reference)[0])
        rows.append(run_case(options, case, "left out", "dispersion", [f"boussinesq.spacing={usual}", "effects.dispersion=off"], reference)[0])
    path = options.out / "cost_boussinesq.csv"
    with open(path, "w", newline="") as file:
        writer = csv.DictWriter(file, COLUMNS)
        writer.writeheader()
        writer.writerows(rows)
    draw(rows, options.out / "cost_boussinesq.png")
    print(path)
    print(options.out / "cost_boussinesq.png")


if __name__ == "__main__":
    main()
