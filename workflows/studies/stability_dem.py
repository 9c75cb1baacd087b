"""Stability map of the blocks: time step over stiffness, a stack of three dropped on a plane and a pair thrown together.

    make -C workflows stability       (SMOKE=1: the ends)

Each run is stable (at rest after 2 s, energy balance within 5 %), noticed (the run stopped by itself and said why) or unstable (neither):
the last must not occur. Writes stability_dem.csv and stability_dem.png.
"""
import csv
import math
import pathlib
import subprocess
import sys

import numpy

here = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(here.parent), str(here.parent / "plots")]
import run_folder  # noqa: E402
import study  # noqa: E402
from style import plt  # noqa: E402

arguments = study.command_line(__doc__)
options = arguments.parse_args()
work = options.out / "stability_dem_runs"
work.mkdir(parents=True, exist_ok=True)

SCENE = """
[time]
end = 2.0
window = 2.0
[dem]
dry = true
young_modulus = {modulus}
time_step = {step}
output_interval = 0.5
planes = [{{ point = [0.0, 0.0, 0.0], normal = [0.0, 0.0, 1.0] }}]
""" + "".join(f'[[dem.block]]\nposition = [{0.004 * k}, 0.0, {0.016 + 0.028 * k}]\n' for k in range(3)) + """
[[dem.block]]
position = [0.3, 0.0, 0.012]
velocity = [-1.0, 0.0, 0.0]
[effects]
sleeping = "off"
"""


def rayleigh_time(modulus):
    shear = modulus / 2.6
    return math.pi * 0.004 * math.sqrt(3689 / shear) / (0.1631 * 0.3 + 0.8766)


def outcome(modulus, share):
    name = f"E{modulus:.0e}_{share}"
    scene = work / f"{name}.toml"
    scene.write_text(SCENE.format(modulus=modulus, step=share * rayleigh_time(modulus)))
    done = subprocess.run([str(options.bin / "dem"), "run", str(scene), "--out", str(work / name), "--quiet"], capture_output=True, text=True)
    if done.returncode in (1, 2):
        return "noticed"
    _, velocity = run_folder.read_series(work / name, "/blocks/velocity")
    closure = abs(run_folder.read_run(work / name)["invariants"]["energy_closure"]["value"])
    return "stable" if numpy.abs(velocity[-1]).max() < 1e-3 and closure < 0.05 else "unstable"


moduli = [1e6, 1e7, 1e8, 1e9]
shares = [0.06, 0.12, 0.24, 0.48, 0.7, 1.0, 2.0, 4.0]
if options.smoke:
    moduli, shares = moduli[1:2], [0.24, 4.0]
rows = [{"young_modulus": modulus, "step_over_rayleigh_time": share, "outcome": outcome(modulus, share)} for modulus in moduli for share in shares]
with open(options.out / "stability_dem.csv", "w", newline="") as file:
    table = csv.DictWriter(file, fieldnames=list(rows[0]))
    table.writeheader()
    table.writerows(rows)
figure, axis = plt.subplots(figsize=(6, 4))
for name, colour, marker in (("stable", "#3a7d44", "o"), ("noticed", "#d0902a", "^"), ("unstable", "#b02020", "x")):
    some = [row for row in rows if row["outcome"] == name]
    axis.loglog([row["young_modulus"] for row in some], [row["step_over_rayleigh_time"] for row in some], marker, ls="", color=colour, label=name)
axis.axhline(0.24, color="0.6", lw=0.8)
axis.set_xlabel("Young's modulus (Pa)"), axis.set_ylabel("time step / Rayleigh time"), axis.legend()
axis.set_title("default (standard) at the line")
figure.savefig(options.out / "stability_dem.png")
for row in rows:
    print(row)
