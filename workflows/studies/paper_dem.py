"""The paper's results for the blocks: case 1 and case 2 over several mound seeds, from one stored flow.

    make -C workflows paper                      (SMOKE=1: two seeds, first waves at draft accuracy)

The flow is OUT/flow of `make chain` or `make flow`; without it the chain is run first. Clock: t = 0 when waves reach the blocks.
Case 1 runs to 11.67 s after that; case 2 starts there, in calm water, with row 2 put back and its layout mounted, and meets the same
waves again, as does case 1 gone on with from the same calm ("control").
Writes paper_dem_displacement.csv (a row a case and seed), paper_dem_psi.csv (damage against psi), paper_dem_tension.csv (f_max and f_min at
the paper's instants), paper_dem_arch.csv (tensions along and across, in the middle and at the ends), paper_dem_summary.json (what came out
and what did not) and pictures of each.
"""
import csv
import json
import os
import pathlib
import subprocess
import sys
import tomllib

import numpy

here = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(here.parent))
sys.path.insert(0, str(here.parent / "plots"))
import run_folder  # noqa: E402
import study  # noqa: E402
import style  # noqa: E402
from style import plt  # noqa: E402

END, INSTANT = 11.67, 9.99  # s after waves reach the blocks: last picture and tension map of the paper

arguments = study.command_line(__doc__, here.parent / "scenes" / "gotoh2009.toml")
arguments.add_argument("--flow", type=pathlib.Path, help="stored flow; default: beside OUT")
arguments.add_argument("--seeds", type=int, default=5)
arguments.add_argument("--set", action="append", default=[], help="KEY=VALUE for every run")
options = arguments.parse_args()
options.out.mkdir(parents=True, exist_ok=True)
runs = options.out / "paper_blocks"
seeds = range(1, (2 if options.smoke else options.seeds) + 1)
psis = [0.05, 0.3] if options.smoke else [0.01, 0.02, 0.05, 0.1, 0.2, 0.3, 0.5]
# The short form: the chain as it is, at draft accuracy, until some of the first waves have met the blocks.
SHORT_END, SHORT_STRETCH = 24.5, 3.0  # s on the clock of the scene, s after waves reach the blocks
short = ["--set", "accuracy=draft"] if options.smoke else []
layouts = {name: here.parent / "layouts" / f"{name}.toml" for name in ("case1", "case2")}


def find_flow():
    flow = options.flow or (options.out / "paper_chain" if options.smoke else options.out.parent) / "flow"
    if not (flow / "run.json").exists() or run_folder.read_run(flow)["status"] != "done":
        words = [*short, "--set", f"time.end={SHORT_END}"] if options.smoke else []
        subprocess.run([options.bin / "coupler", "run", options.scene, "--out", flow.parent, *words], check=True)
    return flow


def dem(verb, folder, *more, seed):
    """Runs the program; a finished run is left alone. Wall time is in its run.json."""
    command = [options.bin / "dem", verb, options.scene, "--out", folder, "--quiet", "--set", f"dem.mound.seed={seed}", *more]
    command += short
    for setting in options.set:
        command += ["--set", setting]
    subprocess.run([str(word) for word in command], check=True, env={**os.environ, "OMP_WAIT_POLICY": "passive"})
    return folder


def displacement(folder):
    """Displacement of every free block from the first sample of this run: total and offshore, m."""
    time, position = run_folder.read_series(folder, "/blocks/position")
    free = run_folder.read_geometry(folder)["/blocks/fixed"] == 0
    way = position[-1] - position[0]
    return numpy.linalg.norm(way, axis=1)[free], -way[free, 0]


def lasting(folder):
    """Displacement of every free block without its rocking: mean position over the last wave period against the first sample of
    this run; total and offshore, m."""
    time, position = run_folder.read_series(folder, "/blocks/position")
    free = run_folder.read_geometry(folder)["/blocks/fixed"] == 0
    way = position[time > time[-1] - PERIOD].mean(axis=0) - position[0]
    return numpy.linalg.norm(way, axis=1)[free], -way[free, 0]


def excursion(folder):
    """Farthest that every free block came from where it stood at the first sample of this run, m."""
    time, position = run_folder.read_series(folder, "/blocks/position")
    free = run_folder.read_geometry(folder)["/blocks/fixed"] == 0
    return numpy.linalg.norm(position[:, free] - position[0, free], axis=2).max(axis=0)


def groups(folder):
    """Which free blocks carry a wire, and which stand at the sea side (rows 4 and 5) without one."""
    geometry = run_folder.read_geometry(folder)
    free = numpy.flatnonzero(geometry["/blocks/fixed"] == 0)
    wired = numpy.isin(free, geometry["/wires/ends"][:, [0, 2]])
    return wired, ~wired & (free >= 60)


COLUMNS, MIDDLE = 20, range(5, 15)  # of a row; those that count as its middle, from 0


def tensions_by_place(folder, first, last, kept_from=None):
    """Largest tension of each link (sum over its wires) at the samples from `first` to `last`, or at the nearest one; its mean over
    links along the breakwater and across it, in the middle of the width and at the ends, N. NaN where there is no such link.
    Without the wires that were there in the run `kept_from`, which come with a tension of their own."""
    time, tension = run_folder.read_series(folder, "/wires/tension")
    ends = run_folder.read_geometry(folder)["/wires/ends"]
    if kept_from is not None:
        earlier = {tuple(wire) for wire in run_folder.read_geometry(kept_from)["/wires/ends"]}
        is_new = numpy.array([tuple(wire) not in earlier for wire in ends])
        ends, tension = ends[is_new], tension[:, is_new]
    links, link_of_wire = numpy.unique(ends[:, [0, 2]], axis=0, return_inverse=True)
    chosen = tension[(time > first) & (time < last)]
    if len(chosen) == 0:
        chosen = tension[[numpy.abs(time - first).argmin()]]
    largest = numpy.array([numpy.bincount(link_of_wire, sample, len(links)) for sample in chosen]).max(axis=0)
    is_along = links[:, 0] // COLUMNS == links[:, 1] // COLUMNS
    in_middle = numpy.isin(links[:, 0] % COLUMNS, MIDDLE)

    def mean_of(which):
        return float(largest[which].mean()) if which.any() else float("nan")
    return {"along_middle_N": mean_of(is_along & in_middle), "along_ends_N": mean_of(is_along & ~in_middle),
            "across_middle_N": mean_of(~is_along & in_middle), "across_ends_N": mean_of(~is_along & ~in_middle)}


def tension_at(folder, instant):
    time, tension = run_folder.read_series(folder, "/wires/tension")
    return tension[numpy.abs(time - instant).argmin()]


def mean_and_spread(values):
    """Mean and half width of its 95 % confidence interval (Student's t)."""
    return float(numpy.mean(values)), study.half_width(values)


def write_csv(name, rows):
    with open(options.out / name, "w", newline="") as file:
        table = csv.DictWriter(file, fieldnames=list(rows[0]))
        table.writeheader()
        table.writerows(rows)


flow = find_flow()
PERIOD = tomllib.loads(options.scene.read_text())["waves"]["period"]
probe = dem("run", runs / "probe", "--flow", flow, *(["--set", f"time.end={SHORT_END}"] if options.smoke else []), seed=1)
arrival = run_folder.read_run(probe)["figures"]["clock"]["waves_reach_blocks"]
flow_end = run_folder.read_run(probe)["figures"]["clock"]["end"]
end = min(arrival + (SHORT_STRETCH if options.smoke else END), flow_end)
rows, tensions, arches = [], [], []
for seed in seeds:
    pack = dem("pack", runs / f"pack_{seed}", seed=seed)
    case1 = dem("run", runs / f"case1_{seed}", "--flow", flow, "--wires", layouts["case1"], "--from", pack / "state.h5",
                "--set", f"time.end={end}", seed=seed)
    case2 = dem("run", runs / f"case2_{seed}", "--flow", flow, "--wires", layouts["case2"], "--from", case1 / "state.h5",
                "--set", f"time.end={end}", "--set", f"dem.restart.clock={arrival}", seed=seed)
    # The same layout as case 1, from the same calm as case 2: what the added wires are worth.
    control = dem("run", runs / f"control_{seed}", "--flow", flow, "--wires", layouts["case1"], "--from", case1 / "state.h5",
                  "--set", f"time.end={end}", "--set", f"dem.restart.clock={arrival}", "--set", "dem.restart.calm=true", seed=seed)
    unwired = dem("run", runs / f"unwired_{seed}", "--flow", flow, "--from", pack / "state.h5", "--set", f"time.end={end}", seed=seed)
    wired, bare = groups(case1)
    for name, folder in (("case1", case1), ("case2", case2), ("control", control), ("unwired", unwired)):
        total, offshore = displacement(folder)
        figures = run_folder.read_run(folder)["figures"]
        farthest = excursion(folder)
        stays, stays_offshore = lasting(folder)
        rows.append({"case": name, "seed": seed, "wired_mean_m": total[wired].mean(), "wired_offshore_m": offshore[wired].mean(),
                     "unwired_sea_side_mean_m": total[bare].mean(), "unwired_sea_side_offshore_m": offshore[bare].mean(),
                     "all_mean_m": total.mean(), "all_offshore_m": offshore.mean(), "largest_m": total.max(),
                     "largest_offshore_m": offshore.max(), "lasting_mean_m": stays.mean(), "lasting_largest_m": stays.max(), "lasting_largest_offshore_m": stays_offshore.max(),
                     "lasting_wired_offshore_m": stays_offshore[wired].mean(),
                     "lasting_unwired_sea_side_offshore_m": stays_offshore[bare].mean(),
                     "excursion_mean_m": farthest.mean(), "excursion_row_5_m": farthest[80:].mean(),
                     "excursion_largest_m": farthest.max(),
                     "put_back_mean_m": figures.get("put_back", {}).get("mean_distance_settled", ""),
                     "put_back_largest_m": figures.get("put_back", {}).get("largest_distance_settled", ""),
                     "broken_wires": figures["wires"]["broken"], "largest_tension_N": figures["wires"]["largest_tension"],
                     "wall_s": run_folder.read_run(folder)["wall_time"]})
    for name, folder in (("case1", case1), ("case2", case2)):
        links = run_folder.read_geometry(folder)["/wires/ends"]
        cross_78 = (links[:, 0] == 77) & (links[:, 2] == 97)
        for label, instant in (("9.99", arrival + INSTANT), ("11.67", end)):
            tension = tension_at(folder, min(instant, end))
            pulled = tension[tension > 0]
            tensions.append({"case": name, "seed": seed, "t_after_arrival_s": label, "f_max_N": tension.max(initial=0),
                             "f_min_N": pulled.min() if len(pulled) else 0.0, "wires_in_tension": len(pulled),
                             "wires": len(tension), "cross_78_N": tension[cross_78].sum()})
        for label, first, last in (("9.99", arrival + INSTANT, arrival + INSTANT), ("11.67", end, end), ("largest", arrival, end)):
            for wires, kept_from in (("all", None), *((("new", case1),) if name == "case2" else ())):
                if last <= end:
                    arches.append({"case": name, "seed": seed, "wires": wires, "t_after_arrival_s": label,
                                   **tensions_by_place(folder, first, last, kept_from)})
write_csv("paper_dem_displacement.csv", rows)
write_csv("paper_dem_arch.csv", arches)
write_csv("paper_dem_tension.csv", tensions)

psi_rows = []
for psi in psis:
    for seed in seeds:
        folder = dem("run", runs / f"psi_{psi}_{seed}", "--flow", flow, "--wires", layouts["case1"], "--from", runs / f"pack_{seed}" / "state.h5",
                     "--set", f"time.end={end}", "--set", f"wires.psi={psi}", seed=seed)
        wired, bare = groups(folder)
        total, offshore = displacement(folder)
        figures = run_folder.read_run(folder)["figures"]
        psi_rows.append({"psi": psi, "seed": seed, "broken_wires": figures["wires"]["broken"], "wires": figures["wires"]["count"],
                         "damage_number": figures["damage"]["number"], "beyond_quarter_length": figures["damage"]["beyond_quarter_length"],
                         "wired_mean_m": total[wired].mean(), "wired_offshore_m": offshore[wired].mean()})
write_csv("paper_dem_psi.csv", psi_rows)


def column(case, key):
    return [row[key] for row in rows if row["case"] == case]


summary = {"waves_reach_blocks_s": arrival, "end_s": end, "seeds": len(seeds), "mean and half width of 95 % interval": {}}
for case in ("case1", "case2", "control", "unwired"):
    summary["mean and half width of 95 % interval"][case] = {key: mean_and_spread(column(case, key)) for key in (
        "wired_mean_m", "wired_offshore_m", "unwired_sea_side_mean_m", "unwired_sea_side_offshore_m", "all_mean_m", "all_offshore_m", "largest_m",
        "lasting_mean_m", "lasting_largest_m", "excursion_mean_m", "excursion_row_5_m", "excursion_largest_m")}
# Blocks rock with every wave: what lasts is told from where they stand on average over the last one.
for when, prefix in (("at the last instant", ""), ("lasting", "lasting_")):
    for title, one, one_key, other, other_key in (
            ("2a unwired of rows 4-5 farther offshore than wired in case 1", "case1", "unwired_sea_side_offshore_m", "case1", "wired_offshore_m"),
            ("2b the wired blocks of case 1, were they not wired, farther offshore", "unwired", "wired_offshore_m", "case1", "wired_offshore_m"),
            ("2c farthest block of all farther offshore without any wire than in case 1", "unwired", "largest_offshore_m", "case1", "largest_offshore_m")):
        more = numpy.array(column(one, prefix + one_key)) - numpy.array(column(other, prefix + other_key))
        summary[f"{title}, {when}"] = {"difference_m": mean_and_spread(more), "each_m": [float(value) for value in more], "seeds_in_which_so": int((more > 0).sum())}
for title, key in (("3 case 2 moves less than case 1 over the same waves, lasting", "lasting_mean_m"), ("3a the same, at the last instant", "all_mean_m"),
                   ("3b the same, farthest from its start during the waves", "excursion_mean_m"),
                   ("3c the same, row 5", "excursion_row_5_m"), ("3d the same, farthest block", "excursion_largest_m"),
                   ("3e the same, farthest block at the last instant", "largest_m"),
                   ("3f the same, farthest block, lasting", "lasting_largest_m")):
    less = numpy.array(column("control", key)) - numpy.array(column("case2", key))
    summary[title] = {"difference_m": mean_and_spread(less), "of_m": mean_and_spread(column("control", key)), "seeds_in_which_so": int((less > 0).sum())}
for wires in ("all", "new"):
    for label in ("9.99", "11.67", "largest"):
        chosen = [row for row in arches if (row["case"], row["wires"], row["t_after_arrival_s"]) == ("case2", wires, label)]
        if not chosen:
            continue
        summary[f"4b arch: {wires} wires of case2, {'largest of the run' if label == 'largest' else 't = ' + label + ' s'}"] = {
            **{key: mean_and_spread([row[key] for row in chosen]) for key in ("along_middle_N", "along_ends_N", "across_middle_N", "across_ends_N")},
            "seeds_in_which_more_along_in_the_middle": sum(row["along_middle_N"] > row["along_ends_N"] for row in chosen),
            "seeds_in_which_more_across_at_the_ends": sum(row["across_ends_N"] > row["across_middle_N"] for row in chosen)}
for case in ("case1", "case2"):
    pulls = [row["cross_78_N"] for row in tensions if row["case"] == case and row["t_after_arrival_s"] == "11.67"]
    summary[f"4 cross-shore wire at block 78 in tension at the end of {case}"] = {"seeds_in_which_so": sum(pull > 0 for pull in pulls), "newtons": pulls}
(options.out / "paper_dem_summary.json").write_text(json.dumps(summary, indent=1, default=float))

figure, axes = plt.subplots(1, 3, figsize=(13, 3.6))
for place, (key, label) in enumerate((("wired_offshore_m", "wired"), ("unwired_sea_side_offshore_m", "unwired, rows 4-5"), ("all_offshore_m", "all"))):
    for shift, case in enumerate(("unwired", "case1", "control", "case2")):
        mean, half = mean_and_spread(column(case, key))
        axes[0].errorbar(place + 0.18 * shift - 0.27, 1e3 * mean, 1e3 * half, fmt="o", capsize=3, color=f"C{shift}", label=case if place == 0 else None)
axes[0].set_xticks(range(3), ["wired in case 1", "not wired, rows 4-5", "all"])
axes[0].set_ylabel("offshore displacement (mm)")
axes[0].legend()
axes[0].set_title(f"mean over {len(seeds)} seeds, 95 % interval")
for key, marker in (("broken_wires", "o"),):
    share = [mean_and_spread([row[key] / max(row["wires"], 1) for row in psi_rows if row["psi"] == psi]) for psi in psis]
    axes[1].errorbar(psis, [s[0] for s in share], [s[1] for s in share], fmt=marker + "-", capsize=3)
axes[1].set_xlabel("psi"), axes[1].set_ylabel("share of broken wires"), axes[1].set_title("case 1")
moved = [mean_and_spread([1e3 * row["wired_mean_m"] for row in psi_rows if row["psi"] == psi]) for psi in psis]
axes[2].errorbar(psis, [m[0] for m in moved], [m[1] for m in moved], fmt="o-", capsize=3)
axes[2].set_xlabel("psi"), axes[2].set_ylabel("displacement of wired blocks (mm)"), axes[2].set_title("case 1")
figure.savefig(options.out / "paper_dem_displacement.png")

for case in ("case1", "case2"):
    folder = runs / f"{case}_1"
    time, position, tension = run_folder.read_series(folder, "/blocks/position", "/wires/tension")
    geometry = run_folder.read_geometry(folder)
    ends = geometry["/wires/ends"]
    links, link_of_wire = numpy.unique(ends[:, [0, 2]], axis=0, return_inverse=True)
    figure, axes = plt.subplots(2, 1, figsize=(11, 6.4), sharex=True)
    for axis, instant in zip(axes, (min(arrival + INSTANT, end), end)):
        sample = numpy.abs(time - instant).argmin()
        total = numpy.bincount(link_of_wire, tension[sample], len(links))
        pulled = tension[sample][tension[sample] > 0]
        axis.scatter(position[sample, :, 1], position[sample, :, 0], s=60, marker="s", color=style.CONCRETE)
        top = max(total.max(initial=0), 1e-12)
        for (a, b), value in zip(links, total):
            axis.plot(position[sample, [a, b], 1], position[sample, [a, b], 0], lw=0.5 + 5 * value / top, color=plt.cm.inferno_r(0.15 + 0.8 * value / top))
        axis.set_title(f"{case}, t = {time[sample] - arrival:.2f} s after waves reach the blocks: f_max {pulled.max(initial=0):.3g} N, "
                       f"f_min {pulled.min() if len(pulled) else 0:.3g} N a wire")
        axis.set_ylabel("x (m)")
        axis.set_aspect("equal")
    axes[1].set_xlabel("y along the breakwater (m)")
    figure.savefig(options.out / f"paper_dem_tension_{case}.png")
print(json.dumps(summary, indent=1, default=float))
