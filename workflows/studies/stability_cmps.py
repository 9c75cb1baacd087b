#!/usr/bin/python3
"""Stability map of cmps: time step over resolution, for a dam break with impact and return.

    make -C workflows stability        (SMOKE=1: the corners only)

The column of Lobovsky et al. (2014), 0.6 x 0.3 m in a tank of 1.61 m, 1.2 s: front, impact at the far wall, return. The step is
a multiple of the default one (cmps.time_step_factor). Each run is judged: stable (done, its invariants hold, level in the
reservoir within two spacings of the experiment, pressure on the reservoir's floor within 0.1 rho g H rms of a fine run with short
steps), noticed (the run stopped itself with a message, or says in run.json that an
invariant does not hold), refused (before anything ran) or unstable (none of these). Writes stability_cmps.csv and stability_cmps.png.
"""
import pathlib
import subprocess
import sys

import numpy

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
import run_folder  # noqa: E402
import stability_map  # noqa: E402
import study  # noqa: E402

HEIGHT = 0.3
SCENE = """
[time]
end = 1.2
window = 1.2
[gauges]
reservoir = {x = 0.3, interval = 0.06}
floor = {x = 0.1, z = 0.0, kind = "pressure", interval = 0.06}
[cmps]
drive = "none"
tank = [0, 1.61, 0, 0.6]
water = [[[0, 0], [0.6, 0], [0.6, 0.3], [0, 0.3]]]
particles_interval = 0.5
"""
# Lobovsky et al. (2014), gauge H1: t sqrt(g/H), level over H
MEASURED = numpy.array([[1, 0.93], [2, 0.785], [3, 0.635], [4, 0.50], [5, 0.405]])
VERDICTS = {"stable": "#3a7d44", "noticed": "#e0b030", "refused": "#b8b4ac", "unstable": "#c03020"}


LARGEST_PRESSURE_ERROR = 0.1  # rho g H: a standard MPS code scatters by more, 0.15 to 0.18, on this case


def run(options, scene, folder, over_height, factor):
    """Exit status, and time and floor pressure over rho g H of a run that was done."""
    spacing = HEIGHT / over_height
    command = [str(options.bin / "cmps"), "run", str(scene), "--out", str(folder), "--quiet", "--set", f"cmps.particle_spacing={spacing}", "--set", f"cmps.time_step_factor={factor}"]
    status = subprocess.run(command, capture_output=True, text=True).returncode
    if status != 0:
        return status, None, None
    t, pressure = run_folder.gauge(folder, "floor", "pressure")
    return status, t, pressure / (1000 * 9.81 * HEIGHT)


def judge(options, scene, folder, over_height, factor, fine):
    """Verdict, largest energy gained over rho g h / 2, rms error of the level over H and of the pressure over rho g H, change of the pressure a step over the pressure."""
    nothing = float("nan")
    status, t, pressure = run(options, scene, folder, over_height, factor)
    if status == 2:
        return "refused", nothing, nothing, nothing, nothing
    if status == 1:
        return "noticed", nothing, nothing, nothing, nothing
    record = run_folder.read_run(folder)
    gained, change = (record["invariants"][name]["value"] for name in ("largest_energy_gain", "pressure_change_per_step"))
    # the first samples are those of the release, a jump that every step smears in its own way
    use = t > 0.1
    pressure_rms = float(numpy.sqrt(numpy.mean((pressure - numpy.interp(t, *fine))[use] ** 2)))
    t, level = run_folder.gauge(folder, "reservoir")
    wrong = numpy.interp(MEASURED[:, 0], t * numpy.sqrt(9.81 / HEIGHT), level / HEIGHT) - MEASURED[:, 1]
    rms = float(numpy.sqrt(numpy.mean(wrong**2)))
    if not all(invariant["holds"] for invariant in record["invariants"].values()):
        return "noticed", gained, rms, pressure_rms, change
    return ("stable" if rms * over_height < 2.0 and pressure_rms < LARGEST_PRESSURE_ERROR else "unstable"), gained, rms, pressure_rms, change


def main():
    parser = study.command_line(__doc__)
    options = parser.parse_args()
    out = options.out / "stability_cmps"
    out.mkdir(parents=True, exist_ok=True)
    scene = out / "dam_break.toml"
    scene.write_text(SCENE)
    resolutions = (6, 12) if options.smoke else (4, 5, 6, 8, 10, 15, 20, 30)
    factors = (1.0, 4.0) if options.smoke else (0.25, 0.5, 1.0, 2.0, 3.0, 4.0)
    rows = []
    status, *fine = run(options, scene, out / "run", 15 if options.smoke else 40, 0.5)
    if status != 0:
        raise SystemExit("the fine run, which pressures are compared with, failed")
    for over_height in resolutions:
        for factor in factors:
            verdict, gained, rms, pressure, change = judge(options, scene, out / "run", over_height, factor, fine)
            rows.append({"particles_over_height": over_height, "step_over_default": factor, "verdict": verdict, "energy_gained": gained, "level_rms_over_H": rms, "pressure_rms_over_rho_g_H": pressure, "pressure_change_per_step": change})
            print(f"H/l0 {over_height:3d}  step x {factor:.2f}  {verdict:9s} energy gained {gained:.3f}  level rms {rms:.3f} H  pressure rms {pressure:.3f} rho g H  change a step {change:.3f}", flush=True)
    stability_map.write(rows, options.out / "stability_cmps", "particles_over_height", "step_over_default", VERDICTS,
                        "particles over the column's height", "time step over the default one", "cmps: dam break with impact")


if __name__ == "__main__":
    main()
