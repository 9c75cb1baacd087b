"""What one more digit costs on the user's own scene: draft, standard and fine, with time, memory and error of each.

    make -C workflows cost SCENE=my.toml

Runs every stage that the scene has at each level, on what the stage before it left at that level, and writes
cost_scene.csv and cost_scene.png. Errors are differences at the gauges (boussinesq, cmps) against the Richardson limit
where three levels converge, else against the finest level; the column `against` says which. dem is chaotic: its error is
the 95 % confidence half width (Student's t) of the mean offshore displacement over mound seeds, beside that mean, and its
times are means over the seeds. SMOKE=1: two seeds, and the scene up to 60 % of its time.
"""
import csv
import pathlib
import subprocess
import sys
import tomllib

import numpy

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
import run_folder  # noqa: E402
import study  # noqa: E402

LEVELS = ["draft", "standard", "fine"]
COLUMNS = ["stage", "level", "error", "unit", "against", "wall_time_s", "cpu_time_s", "peak_memory_bytes", "steps",
           "items", "spacing_m"]


def run(program, *words):
    """Runs one stage; ends the study with its message when it fails."""
    command = [str(word) for word in (program, *words, "--quiet")]
    print(" ".join(command), flush=True)
    ended = subprocess.run(command, stderr=subprocess.PIPE, text=True)
    if ended.returncode != 0:
        sys.exit(f"{ended.stderr.strip()} (exit {ended.returncode})")


def gauge_records(folder):
    return {name: run_folder.gauge(folder, name) for name in run_folder.gauge_names(folder)}


def difference(coarse, fine):
    """Root mean square difference of the surface over all gauges both levels record, m."""
    squares = []
    for name in sorted(set(coarse) & set(fine)):
        time, value = fine[name]
        inside = (time >= coarse[name][0][0]) & (time <= coarse[name][0][-1])
        squares.append(numpy.mean((numpy.interp(time[inside], *coarse[name]) - value[inside]) ** 2))
    return float(numpy.sqrt(numpy.mean(squares))) if squares else float("nan")


def observed_order(spacings, differences):
    """p with d = C (h^p - h_finest^p) for the two coarser of three levels; nan where they do not converge."""
    (h0, h1, h2), (d0, d1) = spacings, differences
    if not (h0 > h1 > h2 and d0 > d1 > 0):
        return float("nan")
    low, high = 0.1, 8.0

    def ratio(p):
        return (h0 ** p - h2 ** p) / (h1 ** p - h2 ** p) - d0 / d1

    if ratio(low) * ratio(high) > 0:
        return float("nan")
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if ratio(low) * ratio(middle) > 0 else (low, middle)
    return 0.5 * (low + high)


def add_errors(rows, records, spacings):
    """Fills in the errors of one stage's rows from the gauge records of its levels."""
    if len(set(spacings)) == 1:
        for row in rows:
            row.update(error=float("nan"), unit="m", against="nothing: the scene fixes the spacing, so levels differ in steps alone")
        return
    finest = records[-1]
    differences = [difference(record, finest) for record in records[:-1]]
    order = observed_order(spacings, differences)
    if numpy.isfinite(order):
        constant = differences[1] / (spacings[1] ** order - spacings[2] ** order)
        for row, spacing in zip(rows, spacings):
            row.update(error=constant * spacing ** order, unit="m", against=f"Richardson limit, order {order:.2f}")
    else:
        for row, value in zip(rows, differences + [float("nan")]):
            row.update(error=value, unit="m", against=f"level {LEVELS[-1]}" if row is not rows[-1] else "nothing finer")


def row_of(stage, level, folder):
    record = run_folder.read_run(folder)
    figures = record["figures"]
    items = figures.get("cells") or figures.get("blocks") or figures.get("particles", {}).get("all")
    particle_spacing = record["scene"]["values"].get("cmps", {}).get("particle_spacing", {}).get("value")
    return {"stage": stage, "level": level, "wall_time_s": record["wall_time"], "cpu_time_s": record["cpu_time"],
            "peak_memory_bytes": record["peak_memory"], "steps": figures.get("steps"), "items": items,
            "spacing_m": {"boussinesq": figures.get("spacing"), "cmps": particle_spacing}.get(stage)}


def displacement_row(stage, level, folders):
    """Means of the times over the seeds' runs, and the mean offshore displacement with its confidence half width."""
    rows = [row_of(stage, level, folder) for folder in folders]
    means = [run_folder.read_run(folder)["figures"]["damage"]["mean_offshore"] for folder in folders]
    row = rows[0] | {name: float(numpy.mean([row[name] for row in rows])) for name in ("wall_time_s", "cpu_time_s", "peak_memory_bytes")}
    row.update(error=study.half_width(means), unit="m", against=f"mean {numpy.mean(means):.3g} m; " + (
        f"95 % half width over {len(means)} seeds" if len(means) > 1 else "no mound, so no seeds to tell a spread"))
    return row


def draw(rows, path):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as pyplot
    stages = [stage for stage in ("boussinesq", "cmps", "dem") if any(row["stage"] == stage for row in rows)]
    figure, axes = pyplot.subplots(1, len(stages), figsize=(4.5 * len(stages), 4), squeeze=False)
    for axis, stage in zip(axes[0], stages):
        shown = [row for row in rows if row["stage"] == stage and numpy.isfinite(row["error"]) and row["error"] > 0]
        axis.loglog([row["wall_time_s"] for row in shown], [row["error"] for row in shown], "o-")
        for row in shown:
            axis.annotate(row["level"], (row["wall_time_s"], row["error"]), textcoords="offset points", xytext=(6, 6))
        axis.set(title=stage, xlabel="wall time, s", ylabel="error, m")
        axis.grid(True, which="both", alpha=0.3)
    figure.tight_layout()
    figure.savefig(path, dpi=130)


def main():
    parser = study.command_line(__doc__)
    parser.add_argument("--scene", type=pathlib.Path, required=True, help="the scene to cost")
    options = parser.parse_args()
    out = options.out / "cost_scene"
    out.mkdir(parents=True, exist_ok=True)
    with open(options.scene, "rb") as file:
        given = tomllib.load(file)
    shorter = ["--set", f"time.end={0.6 * given['time']['end']:.6g}"] if options.smoke else []
    rows = {"boussinesq": [], "cmps": [], "dem": []}
    for level in LEVELS:
        waves, flow, settings = out / f"waves_{level}", out / f"flow_{level}", ["--set", f"accuracy={level}", *shorter]
        if "waves" in given:
            run(options.bin / "boussinesq", "run", options.scene, "--out", waves, *settings)
            rows["boussinesq"].append(row_of("boussinesq", level, waves))
        if "cmps" in given:
            run(options.bin / "cmps", "run", options.scene, *(["--waves", waves] if "waves" in given else []), "--out", flow, *settings)
            rows["cmps"].append(row_of("cmps", level, flow))
        if "dem" in given:
            seeds = ((1, 2) if options.smoke else (1, 2, 3)) if "mound" in given["dem"] else (None,)
            folders = [out / (f"blocks_{level}_{seed}" if seed else f"blocks_{level}") for seed in seeds]
            for seed, folder in zip(seeds, folders):
                run(options.bin / "dem", "run", options.scene, *(["--flow", flow] if "cmps" in given else []), "--out", folder, *settings,
                    *(["--set", f"dem.mound.seed={seed}"] if seed is not None else []))
            rows["dem"].append(displacement_row("dem", level, folders))
    for stage, name in (("boussinesq", "waves"), ("cmps", "flow")):
        if rows[stage]:
            add_errors(rows[stage], [gauge_records(out / f"{name}_{level}") for level in LEVELS], [row["spacing_m"] for row in rows[stage]])
    every = [row for stage in rows.values() for row in stage]
    with open(options.out / "cost_scene.csv", "w", newline="") as file:
        writer = csv.DictWriter(file, COLUMNS)
        writer.writeheader()
        writer.writerows(every)
    draw(every, options.out / "cost_scene.png")
    print(options.out / "cost_scene.csv", options.out / "cost_scene.png", sep="\n")


if __name__ == "__main__":
    main()
