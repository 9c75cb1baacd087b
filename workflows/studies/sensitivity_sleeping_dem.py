"""Do sleeping blocks change the damage? Sleeping on and off against what a change of rounding size does to the same run.

    make -C workflows sensitivity             (SMOKE=1: two seeds, first waves, no wires)

Motion at the threshold is chaotic: two runs that differ in the eighth digit of the friction end with other blocks displaced. So the question
is whether switching sleeping off changes the damage by more than that. For each mound seed one packing is stored, and from it the paper's
scene is run over the same flow of draft accuracy with sleeping on, with sleeping off, and twice with the friction changed by 2e-7 of itself
(up and down), without wires and with those of case 1.
Written are the differences to the run with sleeping on, seed by seed (sensitivity_sleeping_dem.csv), and over seeds (.._summary.csv): mean with
its 95 % interval, spread, and the largest single one; and a picture of them all.
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
arguments.add_argument("--flow", type=pathlib.Path, help="stored flow of draft accuracy; default: computed")
arguments.add_argument("--seeds", type=int, default=20)
options = arguments.parse_args()
work = options.out / "sensitivity_sleeping_dem_runs"
work.mkdir(parents=True, exist_ok=True)

BLOCK_LENGTH = 0.048  # m
END = 23.0 if options.smoke else 40.0  # s
FRICTION = 0.577
VARIANTS = {"on": [], "off": ["effects.sleeping=off"], "friction up": [f"dem.friction={FRICTION * (1 + 2e-7):.10f}"],
            "friction down": [f"dem.friction={FRICTION * (1 - 2e-7):.10f}"]}
LAYOUTS = {"no wires": None, "case 1": here.parent / "layouts" / "case1.toml"}
if options.smoke:
    del LAYOUTS["case 1"]
STATISTICS = {"blocks beyond a quarter length": "blocks", "mean displacement": "mm", "mean offshore displacement": "mm", "largest displacement": "mm"}


def call(program, *words):
    subprocess.run([str(word) for word in (options.bin / program, *words, "--quiet", "--set", "accuracy=draft", "--set", f"time.end={END}")],
                   check=True, env={**os.environ, "OMP_WAIT_POLICY": "passive"})


def done(folder):
    return (folder / "run.json").exists() and run_folder.read_run(folder)["status"] == "done"


flow = options.flow
if flow is None:
    flow = work / "flow"
    if not done(flow):
        call("boussinesq", "run", options.scene, "--out", work / "waves")
        call("cmps", "run", options.scene, "--waves", work / "waves", "--out", flow)


def damage(seed, layout, variant):
    """The statistics of one run; finished runs are left alone."""
    mound = ["--set", f"dem.mound.seed={seed}"]
    packing = work / f"pack_{seed}"
    if not done(packing):
        call("dem", "pack", options.scene, "--out", packing, *mound)
    folder = work / f"{layout}_{variant}_{seed}".replace(" ", "_")
    if not done(folder):
        wires = ["--wires", LAYOUTS[layout]] if LAYOUTS[layout] else []
        settings = [word for setting in VARIANTS[variant] for word in ("--set", setting)]
        call("dem", "run", options.scene, "--flow", flow, "--from", packing / "state.h5", "--out", folder, *wires, *mound, *settings)
    _, position = run_folder.read_series(folder, "/blocks/position")
    way = (position[-1] - position[0])[:100]
    total = numpy.linalg.norm(way, axis=1)
    return numpy.array([(total > 0.25 * BLOCK_LENGTH).sum(), 1e3 * total.mean(), -1e3 * way[:, 0].mean(), 1e3 * total.max()])


seeds = range(1, (2 if options.smoke else options.seeds) + 1)
rows, summary, differences = [], [], {}
for layout in LAYOUTS:
    found = {variant: numpy.array([damage(seed, layout, variant) for seed in seeds]) for variant in VARIANTS}
    for variant, values in found.items():
        for seed, value in zip(seeds, values):
            rows.append({"layout": layout, "seed": seed, "variant": variant, **dict(zip(STATISTICS, value))})
    for k, (statistic, unit) in enumerate(STATISTICS.items()):
        off = found["off"][:, k] - found["on"][:, k]
        rounding = numpy.concatenate([found[name][:, k] - found["on"][:, k] for name in ("friction up", "friction down")])
        differences[layout, statistic] = off, rounding
        # Two equal runs of a seed each, so the half width of the floor is that of as many seeds.
        floor = (found["friction up"][:, k] - found["friction down"][:, k])
        summary.append({"layout": layout, "statistic": statistic, "unit": unit, "seeds": len(seeds), "mean, sleeping on": found["on"][:, k].mean(),
                        "off - on": off.mean(), "off - on, half width": study.half_width(off), "off - on, spread": off.std(ddof=1),
                        "off - on, largest": abs(off).max(), "rounding": floor.mean(), "rounding, half width": study.half_width(floor),
                        "rounding, spread": rounding.std(ddof=1), "rounding, largest": abs(rounding).max()})
        s = summary[-1]
        print(f"{layout:9s} {statistic:32s} {s['mean, sleeping on']:7.2f} {unit}; off - on {s['off - on']:+.2f} +- {s['off - on, half width']:.2f}, spread {s['off - on, spread']:.2f}, "
              f"largest {s['off - on, largest']:.1f}; rounding {s['rounding']:+.2f} +- {s['rounding, half width']:.2f}, spread {s['rounding, spread']:.2f}, largest {s['rounding, largest']:.1f}", flush=True)

for name, table_rows in (("sensitivity_sleeping_dem.csv", rows), ("sensitivity_sleeping_dem_summary.csv", summary)):
    with open(options.out / name, "w", newline="") as file:
        table = csv.DictWriter(file, fieldnames=list(table_rows[0]))
        table.writeheader()
        table.writerows(table_rows)

figure, axes = plt.subplots(1, len(STATISTICS), figsize=(14, 3.6))
for axis, (statistic, unit) in zip(axes, STATISTICS.items()):
    for place, layout in enumerate(LAYOUTS):
        for shift, values in enumerate(differences[layout, statistic]):
            axis.plot(numpy.full(len(values), place + 0.3 * shift - 0.15) + numpy.linspace(-0.08, 0.08, len(values)), values, "o", ms=4, color=f"C{shift}",
                      label=("sleeping off", "rounding")[shift] if place == 0 else None)
    axis.axhline(0, color="grey", lw=0.8)
    axis.set_xticks(range(len(LAYOUTS)), list(LAYOUTS))
    axis.set_title(statistic, fontsize=9), axis.set_ylabel(f"difference ({unit})")
axes[0].legend(fontsize=8)
figure.savefig(options.out / "sensitivity_sleeping_dem.png")
