"""Under which conditions blocks are carried off the mound, and which wires hold them: one factor at a time, and some together.

    make -C workflows sensitivity             (SMOKE=1: two conditions, one seed, no waves of their own)

What the paper's scene leaves open (or gives, for comparison) is varied about the scene as it stands, on flows of draft accuracy, over mound
seeds: wave height, how rough the mound is and over which length its heights are one, friction, drag and added mass of an element, and of the
wires their number a side, their law and their stiffness. Every condition is run without wires and with the layout of case 1.
What wires are worth is the difference of the two, seed by seed, with its 95 % interval. Then half of the width is wired and compared with its
mirror image.
Writes sensitivity_dem.csv (a row a run), sensitivity_dem_summary.csv (a row a condition: mean over seeds), sensitivity_dem_worth.csv (a row a
condition: unwired less wired), sensitivity_dem_half.csv and sensitivity_dem.png.
Finished runs are left alone, so that a study that was stopped goes on.
"""
import csv
import os
import pathlib
import subprocess
import sys

import numpy

here = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(here.parent), str(here.parent / "plots")]
import run_folder  # noqa: E402
import study  # noqa: E402
from style import plt  # noqa: E402

arguments = study.command_line(__doc__, here.parent / "scenes" / "gotoh2009.toml")
arguments.add_argument("--seeds", type=int, default=3)
arguments.add_argument("--half-seeds", type=int, default=8, help="of the comparison of a wired half with its mirror image")
arguments.add_argument("--conditions", default="", help="run only these, separated by ';'")
options = arguments.parse_args()
options.out.mkdir(parents=True, exist_ok=True)
work = options.out / "sensitivity_dem_runs"
work.mkdir(exist_ok=True)

HEIGHT, BLOCK_LENGTH = 0.168, 0.048  # m: waves in 0.80 m of water, and the block
END = 40.0  # s: about 18 s after the first waves reach the blocks, ten wave periods of them fully grown

MOUND = "[39.34, -0.40], [39.70, -0.22], [40.00, -0.22]"
FLOWS = {f"height x {factor}": [f"waves.height={round(HEIGHT * factor, 6)}"] for factor in (1.0, 0.8, 1.2, 1.4, 1.5)}
FLOWS["no overtopping"] = [f"cmps.structure=[[{MOUND}, [40.00, 0.40], [40.35, 0.40], [40.35, -0.40]]]", "cmps.flow.z=[-0.42, 0.30]"]
FLOWS["mound at -0.16 m"] = ["cmps.structure=[[[39.22, -0.40], [39.70, -0.16], [40.00, -0.16], [40.00, 0.12], [40.35, 0.12], [40.35, -0.40]]]"]
HIGH_MOUND = {"dem.mound.profile": "[[38.80, -0.40], [39.22, -0.40], [39.70, -0.16], [40.00, -0.16]]"}

# name: (flow, settings of dem, wires a side alongshore; 0: all)
CONDITIONS = {
    "scene as it is": ("height x 1.0", {}, 0),
    "height x 0.8": ("height x 0.8", {}, 0),
    "height x 1.2": ("height x 1.2", {}, 0),
    "height x 1.4": ("height x 1.4", {}, 0),
    "height x 1.5": ("height x 1.5", {}, 0),
    "roughness H_B/6": ("height x 1.0", {"dem.mound.roughness": 0.004}, 0),
    "roughness H_B/12": ("height x 1.0", {"dem.mound.roughness": 0.002}, 0),
    "heights one over 2 d": ("height x 1.0", {"dem.mound.patch": 0.016}, 0),
    "heights one over 3 d": ("height x 1.0", {"dem.mound.patch": 0.024}, 0),
    "heights one over 6 d": ("height x 1.0", {"dem.mound.patch": 0.048}, 0),
    "friction 0.4": ("height x 1.0", {"dem.friction": 0.4}, 0),
    "friction 0.3": ("height x 1.0", {"dem.friction": 0.3}, 0),
    "drag x 0.5": ("height x 1.0", {"dem.drag_coefficient": 0.2}, 0),
    "drag x 2": ("height x 1.0", {"dem.drag_coefficient": 0.8}, 0),
    "1.2, drag x 0.5": ("height x 1.2", {"dem.drag_coefficient": 0.2}, 0),
    "no added mass": ("height x 1.0", {"dem.added_mass": 0.0}, 0),
    "added mass 1": ("height x 1.0", {"dem.added_mass": 1.0}, 0),
    "2 wires a side": ("height x 1.0", {}, 2),
    "1 wire a side": ("height x 1.0", {}, 1),
    "progressive wires": ("height x 1.0", {"wires.law": "progressive"}, 0),
    "1 progressive wire a side": ("height x 1.0", {"wires.law": "progressive"}, 1),
    # Together: what loosens the blocks, and weaker wires on them.
    "1.2, 3 d": ("height x 1.2", {"dem.mound.patch": 0.024}, 0),
    "1.5, 3 d": ("height x 1.5", {"dem.mound.patch": 0.024}, 0),
    "1.2, 3 d, 1 wire": ("height x 1.2", {"dem.mound.patch": 0.024}, 1),
    "1.5, 3 d, 1 wire": ("height x 1.5", {"dem.mound.patch": 0.024}, 1),
    "1.5, 1 wire": ("height x 1.5", {}, 1),
    "1.5, 1 progressive wire": ("height x 1.5", {"wires.law": "progressive"}, 1),
    "1.5, 1 progressive wire, 3 d": ("height x 1.5", {"wires.law": "progressive", "dem.mound.patch": 0.024}, 1),
    # Do sleepers change who moves, beyond what any small change does to motion that is chaotic?
    "sleeping off": ("height x 1.0", {"effects.sleeping": "off"}, 0),
    "friction + 1e-7": ("height x 1.0", {"dem.friction": 0.5770001}, 0),
    # The near field itself: a caisson that nothing goes over, and a mound nearer to the surface.
    "no overtopping": ("no overtopping", {}, 0),
    "mound at -0.16 m": ("mound at -0.16 m", HIGH_MOUND, 0),
    "mound at -0.16 m, 1 wire": ("mound at -0.16 m", HIGH_MOUND, 1),
}
if options.smoke:
    CONDITIONS = {name: CONDITIONS[name] for name in ("scene as it is", "heights one over 3 d")}
seeds = range(1, (1 if options.smoke else options.seeds) + 1)
environment = {**os.environ, "OMP_WAIT_POLICY": "passive"}


def call(program, *words):
    subprocess.run([str(word) for word in (options.bin / program, *words)], check=True, env=environment)


def done(folder):
    return (folder / "run.json").exists() and run_folder.read_run(folder)["status"] == "done"


def flow_of(name):
    """A near field at draft accuracy; computed once."""
    folder = work / f"flow_{name_of(name)}"
    if not done(folder / "flow"):
        settings = ["--set", "accuracy=draft", "--quiet"]
        for setting in FLOWS[name]:
            settings += ["--set", setting]
        if options.smoke:
            settings += ["--set", "time.end=26.0"]
        call("boussinesq", "run", options.scene, "--out", folder / "waves", *settings)
        call("cmps", "run", options.scene, "--waves", folder / "waves", "--out", folder / "flow", *settings)
    return folder / "flow"


def layout_of(wires):
    """Case 1 with so many wires a side alongshore."""
    path = work / f"case1_{wires}_wires.toml"
    path.write_text(f"[[wires.along]]\nrows = [4, 5]\ncolumns = [5, 18]\nwires = {wires}\n"
                    f"[[wires.link]]\nblocks = [78, 98]\nwires = {min(3, wires) if wires else 3}\n")
    return path


def name_of(words):
    return "".join(letter if letter.isalnum() or letter in ".-" else "_" for letter in words)


def run(condition, seed, wired, end):
    flow, settings, wires = CONDITIONS[condition]
    if not wired:  # one run serves all conditions that differ in their wires only
        key = (flow, [pair for pair in settings.items() if not pair[0].startswith("wires.")])
        condition = next(name for name, (f, s, _) in CONDITIONS.items() if (f, list(s.items())) == key)
    folder = work / f"{name_of(condition)}_{seed}_{'wired' if wired else 'bare'}"
    if not done(folder):
        words = ["run", options.scene, "--flow", flow_of(flow), "--out", folder, "--quiet", "--set", "accuracy=draft", "--set", f"dem.mound.seed={seed}",
                 "--set", f"time.end={end}", "--set", "dem.output_interval=0.25"]
        for setting in [*FLOWS[flow], *(f"{key}={value}" for key, value in settings.items())]:
            words += ["--set", setting]
        if wired:
            words += ["--wires", layout_of(wires)]
        call("dem", *words)
    return folder


def measure(folder):
    """Displacement of the 100 blocks since packing; rows are numbered from the shore, offshore is positive."""
    time, position = run_folder.read_series(folder, "/blocks/position")
    figures = run_folder.read_run(folder)["figures"]
    way = (position[-1] - position[0])[:100]
    total, offshore = numpy.linalg.norm(way, axis=1), -way[:, 0]
    block = numpy.arange(100)
    row, column = block // 20 + 1, block % 20 + 1
    sea_side = row >= 4
    linked = sea_side & (column >= 5) & (column <= 18)  # carry wires in case 1
    middle, ends = (row == 5) & (column >= 10) & (column <= 13), (row == 5) & linked & ((column <= 6) | (column >= 17))  # of the mat
    moved = total > 0.25 * BLOCK_LENGTH
    # A block is carried little by little when no single wave period does the most of its way.
    period = max(1, int(round(1.65 / numpy.median(numpy.diff(time)))))
    farthest = int(numpy.argmax(offshore))
    x = -(position[:, farthest, 0] - position[0, farthest, 0])
    jump = numpy.max(x[period:] - x[:-period]) / max(x[-1], 1e-9) if len(x) > period else 1.0
    return {"beyond_quarter": int(moved.sum()), "beyond_half": int((total > 0.5 * BLOCK_LENGTH).sum()), "beyond_one": int((total > BLOCK_LENGTH).sum()),
            "of_them_seaward": int((moved & (offshore > 0)).sum()), "mean_mm": 1e3 * total.mean(), "offshore_mm": 1e3 * offshore.mean(),
            "row_5_offshore_mm": 1e3 * offshore[row == 5].mean(), "row_1_offshore_mm": 1e3 * offshore[row == 1].mean(),
            "linked_offshore_mm": 1e3 * offshore[linked].mean(), "unlinked_sea_side_offshore_mm": 1e3 * offshore[sea_side & ~linked].mean(),
            "bulge_mm": 1e3 * (offshore[middle].mean() - offshore[ends].mean()), "farthest_offshore_mm": 1e3 * offshore.max(),
            "largest_share_in_a_period": float(jump), "down_the_slope": int(((position[-1, :100, 0] < 39.70) & (way[:, 2] < -0.01)).sum()),
            "largest_tension_N": figures["wires"]["largest_tension"], "broken_wires": figures["wires"]["broken"], "wires": figures["wires"]["count"]}


rows = []
for condition in CONDITIONS:
    if options.conditions and condition not in options.conditions.split(";"):
        continue
    end = 26.0 if options.smoke else END
    for seed in seeds:
        for wired in (False, True):
            rows.append({"condition": condition, "seed": seed, "layout": "case 1" if wired else "no wires", **measure(run(condition, seed, wired, end))})
    last = rows[-2 * len(seeds):]
    print(f"{condition:32s}", "; ".join(
        f"{name}: >1/4 {numpy.mean([r['beyond_quarter'] for r in last if r['layout'] == name]):5.1f} >1/2 {numpy.mean([r['beyond_half'] for r in last if r['layout'] == name]):5.1f}"
        f" >1 {numpy.mean([r['beyond_one'] for r in last if r['layout'] == name]):5.1f} linked {numpy.mean([r['linked_offshore_mm'] for r in last if r['layout'] == name]):6.2f} mm"
        f" others {numpy.mean([r['unlinked_sea_side_offshore_mm'] for r in last if r['layout'] == name]):6.2f} row 1 {numpy.mean([r['row_1_offshore_mm'] for r in last if r['layout'] == name]):6.2f}"
        f" bulge {numpy.mean([r['bulge_mm'] for r in last if r['layout'] == name]):5.1f} T {max(r['largest_tension_N'] for r in last if r['layout'] == name):5.2f} N"
        f" broken {sum(r['broken_wires'] for r in last if r['layout'] == name)}" for name in ("no wires", "case 1")), flush=True)

worth = []
for condition in dict.fromkeys(row["condition"] for row in rows):
    bare, wired = ([row for row in rows if row["condition"] == condition and row["layout"] == layout] for layout in ("no wires", "case 1"))
    for key in ("linked_offshore_mm", "beyond_quarter", "mean_mm", "farthest_offshore_mm"):
        less = numpy.array([a[key] - b[key] for a, b in zip(bare, wired)], float)
        worth.append({"condition": condition, "figure": key, "seeds": len(less), "unwired": numpy.mean([row[key] for row in bare]),
                      "wired": numpy.mean([row[key] for row in wired]), "unwired - wired": less.mean(), "half_width": study.half_width(less),
                      "median": numpy.median(less), "seeds_in_which_more": int((less > 0).sum())})
    print(f"{condition:32s} unwired less wired:", "; ".join(
        f"{row['figure']} {row['unwired - wired']:.2f} +- {row['half_width']:.2f} (median {row['median']:.2f}, {row['seeds_in_which_more']} of {row['seeds']})" for row in worth[-4:]), flush=True)
if worth:
    with open(options.out / "sensitivity_dem_worth.csv", "w", newline="") as file:
        table = csv.DictWriter(file, fieldnames=list(worth[0]))
        table.writeheader()
        table.writerows(worth)

# Like with like: half of the width is wired, the other half, its mirror image, is not.
WIRED = (3, 10)  # columns; mirrored: 18 to 11
half_rows = []
for flow in () if options.conditions and "half" not in options.conditions else ("height x 1.0", "height x 1.2"):
    layout = work / "half.toml"
    layout.write_text(f"[[wires.along]]\nrows = [4, 5]\ncolumns = [{WIRED[0]}, {WIRED[1]}]\n")
    for seed in range(1, (1 if options.smoke else options.half_seeds) + 1):
        folder = work / f"half_{name_of(flow)}_{seed}"
        if not done(folder):
            call("dem", "run", options.scene, "--flow", flow_of(flow), "--wires", layout, "--out", folder, "--quiet", "--set", "accuracy=draft",
                 "--set", f"dem.mound.seed={seed}", "--set", f"time.end={26.0 if options.smoke else END}", "--set", "dem.output_interval=0.25",
                 *(word for setting in FLOWS[flow] for word in ("--set", setting)))
        _, position = run_folder.read_series(folder, "/blocks/position")
        offshore = (position[0] - position[-1])[60:100, 0].reshape(2, 20)
        wired, bare = offshore[:, WIRED[0] - 1:WIRED[1]], offshore[:, 20 - WIRED[1]:21 - WIRED[0]]
        half_rows.append({"flow": flow, "seed": seed, "wired_offshore_mm": 1e3 * wired.mean(), "mirrored_unwired_offshore_mm": 1e3 * bare.mean(),
                          "wired_beyond_quarter": int((numpy.abs(wired) > 0.25 * BLOCK_LENGTH).sum()), "unwired_beyond_quarter": int((numpy.abs(bare) > 0.25 * BLOCK_LENGTH).sum())})
    last = [row for row in half_rows if row["flow"] == flow]
    print(f"half wired, {flow}: wired {numpy.mean([r['wired_offshore_mm'] for r in last]):.2f} mm, its mirror image unwired "
          f"{numpy.mean([r['mirrored_unwired_offshore_mm'] for r in last]):.2f} mm; farther unwired in "
          f"{sum(r['mirrored_unwired_offshore_mm'] > r['wired_offshore_mm'] for r in last)} of {len(last)} seeds; blocks beyond a quarter: "
          f"{sum(r['wired_beyond_quarter'] for r in last)} wired, {sum(r['unwired_beyond_quarter'] for r in last)} unwired", flush=True)
if half_rows:
    with open(options.out / "sensitivity_dem_half.csv", "w", newline="") as file:
        table = csv.DictWriter(file, fieldnames=list(half_rows[0]))
        table.writeheader()
        table.writerows(half_rows)

if not rows:
    sys.exit()
with open(options.out / "sensitivity_dem.csv", "w", newline="") as file:
    table = csv.DictWriter(file, fieldnames=list(rows[0]))
    table.writeheader()
    table.writerows(rows)
summary = []
figures = [key for key in rows[0] if key not in ("condition", "seed", "layout")]
for condition in dict.fromkeys(row["condition"] for row in rows):
    for layout in ("no wires", "case 1"):
        some = [row for row in rows if row["condition"] == condition and row["layout"] == layout]
        summary.append({"condition": condition, "layout": layout, "seeds": len(some), **{key: float(numpy.mean([row[key] for row in some])) for key in figures}})
with open(options.out / "sensitivity_dem_summary.csv", "w", newline="") as file:
    table = csv.DictWriter(file, fieldnames=list(summary[0]))
    table.writeheader()
    table.writerows(summary)

names = list(dict.fromkeys(row["condition"] for row in rows))
figure, axes = plt.subplots(1, 2, figsize=(12, 0.32 * len(names) + 1.6), sharey=True)
for shift, (layout, colour) in enumerate((("no wires", "C0"), ("case 1", "C1"))):
    for k, condition in enumerate(names):
        some = [row for row in rows if row["condition"] == condition and row["layout"] == layout]
        axes[0].plot([row["beyond_quarter"] for row in some], [k + 0.2 * shift] * len(some), "o", ms=4, color=colour, label=layout if k == 0 else None)
        axes[1].plot([row["linked_offshore_mm"] for row in some], [k + 0.2 * shift] * len(some), "o", ms=4, color=colour)
axes[0].set_yticks(range(len(names)), names)
axes[0].invert_yaxis()
axes[0].set_xlabel("blocks of 100 beyond a quarter of their length"), axes[0].legend(fontsize=8)
axes[1].set_xlabel("mean offshore displacement of the blocks that case 1 links (mm)")
figure.savefig(options.out / "sensitivity_dem.png")
