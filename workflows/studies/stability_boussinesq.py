"""Stability map of boussinesq: step size (Courant number) over cell size, for waves breaking on a 1:10 beach.

    make -C workflows stability        (SMOKE=1: the corners only)

Each run is judged: stable (done, invariants hold, no wave above twice the incident one offshore), noticed (the run
stopped itself with a message), refused (before anything ran) or unstable (neither). Writes stability_boussinesq.csv and
stability_boussinesq.png.
"""
import pathlib
import subprocess
import sys

import numpy

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
import run_folder  # noqa: E402
import stability_map  # noqa: E402
import study  # noqa: E402

DEPTH, HEIGHT = 0.6, 0.15
SCENE = f"""
[time]
end = 40.0
window = 40.0
[flume]
bed = [[0.0, {-DEPTH}], [14.0, {-DEPTH}], [24.0, 0.4]]
[waves]
kind = "regular"
height = {HEIGHT}
period = 2.0
[boussinesq]
output_interval = 0.1
"""
VERDICTS = {"stable": "#3a7d44", "noticed": "#e0b030", "refused": "#b8b4ac", "unstable": "#c03020"}


def judge(options, scene, folder, spacing, courant):
    command = [str(options.bin / "boussinesq"), "run", str(scene), "--out", str(folder), "--quiet", "--set", f"boussinesq.spacing={spacing}", "--set", f"boussinesq.courant={courant}"]
    ended = subprocess.run(command, capture_output=True, text=True)
    if ended.returncode == 2:
        return "refused", float("nan")
    if ended.returncode == 1:
        return "noticed", float("nan")
    record = run_folder.read_run(folder)
    _, elevation = run_folder.read_series(folder, "/surface_elevation")
    x = run_folder.static(folder, "/x")
    offshore = elevation[:, (x > 6) & (x < 13)]
    height = float((offshore.max(0) - offshore.min(0)).max() / HEIGHT)
    holds = all(entry["holds"] for entry in record["invariants"].values())
    return ("stable" if holds and numpy.isfinite(elevation).all() and height < 2.0 else "unstable"), height


def main():
    parser = study.command_line(__doc__)
    options = parser.parse_args()
    out = options.out / "stability_boussinesq"
    out.mkdir(parents=True, exist_ok=True)
    scene = out / "beach.toml"
    scene.write_text(SCENE)
    spacings = (0.2, 0.05) if options.smoke else (0.4, 0.2, 0.1, 0.05, 0.025, 0.0125)
    courants = (0.5, 1.0) if options.smoke else (0.1, 0.25, 0.5, 0.7, 0.8, 0.9, 1.0, 1.1)
    rows = []
    for spacing in spacings:
        for courant in courants:
            verdict, height = judge(options, scene, out / "run", spacing, courant)
            rows.append({"spacing_over_depth": spacing / DEPTH, "courant": courant, "verdict": verdict, "largest_height_over_incident": height})
            print(f"dx/h {spacing / DEPTH:.3f}  Courant {courant:.2f}  {verdict}  {height:.2f}", flush=True)
    stability_map.write(rows, options.out / "stability_boussinesq", "spacing_over_depth", "courant", VERDICTS,
                        "cell size over depth", "Courant number", "boussinesq: waves breaking on 1:10")


if __name__ == "__main__":
    main()
