"""How much of a wave that comes back each offshore boundary of cmps reflects again.

    make -C workflows boundaries      (SMOKE=1: one boundary, coarse)

packet: a group of waves enters, is thrown back by a wall at the far end, meets the boundary while nothing more comes in, and what
the boundary sends out again is measured: three gauges separate waves by direction (least squares at every frequency, Mansard &
Funke 1980), and the second arrival of waves that travel shoreward is compared with those that travelled offshore.
steady: regular waves against the wall for many periods, in flumes of several lengths: range of the surface at the antinode over
the incident height (2.0 when the boundary lets everything out), and whether it still grows.

The waves are those of linear theory. Writes boundaries_cmps.csv and boundaries_cmps.png.
"""
import csv
import glob
import json
import os
import subprocess
import sys

import h5py
import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [os.path.join(HERE, ".."), os.path.join(HERE, "../../tests/support")]
import study  # noqa: E402
from cmps_waves import wave_number, write_waves, write_window  # noqa: E402

DEPTH, PERIOD, OFFSHORE = 0.4, 1.65, 25.0
BOUNDARIES = {
    "relaxation": 'boundary = "relaxation"',
    "absorption alone": 'boundary = "relaxation"\n[effects]\nrelaxation_zone = "off"',
    "zone alone": 'boundary = "relaxation"\nrelaxation_strength = 8\n[effects]\nabsorption = "off"',
    "paper": 'boundary = "paper"\ncrest_lowering = 0.075',
    "both": 'boundary = "both"\ncrest_lowering = 0.075',
}
SCENE = """
title = "flume with a wall at the end"
[time]
end = {end}
window = 1.0
[flume]
bed = [[0.0, {bed}], [60.0, {bed}]]
[waves]
kind = "regular"
height = {height}
period = {period}
[gauges]
{gauges}
[cmps]
offshore = {offshore}
onshore = {onshore}
particle_spacing = {spacing}
start = 0.0
particles_interval = 10.0
{more}
"""


def write_packet(folder, height, x0, x1, end, centre=6.0, width=1.2 * PERIOD, spacing=0.05, interval=0.025, period=PERIOD):
    """A group of waves of linear theory that passes OFFSHORE at t = `centre`: a sum of progressive waves, so exact in time."""
    os.makedirs(folder, exist_ok=True)
    omega0 = 2 * np.pi / period
    omegas = np.linspace(0.55, 1.45, 181) * omega0
    weights = np.exp(-0.5 * ((omegas - omega0) * width) ** 2)
    weights /= weights.sum()
    x = np.arange(x0, x1 + 0.5 * spacing, spacing)
    for index in range(int(np.ceil(end - 1e-9))):
        begin, finish = float(index), min(end, index + 1.0)
        t = np.linspace(begin, finish, int(round((finish - begin) / interval)) + 1)
        eta, u = np.zeros((len(t), len(x))), np.zeros((len(t), len(x)))
        for omega, weight in zip(omegas, weights):
            k = wave_number(2 * np.pi / omega, DEPTH)
            wave = 0.5 * height * weight * np.cos(k * (x[None, :] - OFFSHORE) - omega * (t[:, None] - centre))
            eta += wave
            u += omega / k / DEPTH * wave
        write_window(folder, index, begin, finish, t, x, np.full_like(x, DEPTH), eta, u)
    with open(os.path.join(folder, "run.json"), "w") as file:
        json.dump({"stage": "boussinesq", "status": "done", "windows": index + 1}, file)


def run(arguments, name, waves, height, period, end, onshore, gauges, more):
    path, out = os.path.join(arguments.out, name + ".toml"), os.path.join(arguments.out, name)
    with open(path, "w") as file:
        file.write(SCENE.format(end=end, height=height, period=period, bed=-DEPTH, offshore=OFFSHORE, onshore=onshore, spacing=DEPTH / arguments.over_depth, more=more,
                                gauges="\n".join(f'g{i} = {{x = {x:.4f}, interval = 0.025}}' for i, x in enumerate(gauges))))
    done = subprocess.run([os.path.join(arguments.bin, "cmps"), "run", path, "--waves", waves, "--out", out, "--quiet"], capture_output=True, text=True)
    if done.returncode:
        raise SystemExit(f"{name}: {done.stderr.strip()}")
    return out


def gauges_of(out, count):
    columns = []
    for i in range(count):
        t, eta = [], []
        for path in sorted(glob.glob(os.path.join(out, "window_*.h5"))):
            with h5py.File(path) as file:
                t.append(file[f"gauges/g{i}/time"][:]), eta.append(file[f"gauges/g{i}/surface_elevation"][:])
        t, first = np.unique(np.concatenate(t), return_index=True)
        columns.append(np.concatenate(eta)[first])
    return t, np.array(columns)


def separate(t, eta, places, lowest, highest):
    """Shoreward and offshore travelling parts (complex, at places[0]) at each frequency, least squares over the gauges."""
    dt = t[1] - t[0]
    grid = np.arange(t[0], t[-1] + 0.5 * dt, dt)
    eta = np.array([np.interp(grid, t, row) for row in eta])
    eta -= eta[:, :20].mean(axis=1, keepdims=True)
    spectrum, frequency = np.fft.rfft(eta, axis=1), np.fft.rfftfreq(len(grid), dt)
    shoreward, offshore = np.zeros(len(frequency), complex), np.zeros(len(frequency), complex)
    for m in np.flatnonzero((frequency > lowest) & (frequency < highest)):
        k = wave_number(1 / frequency[m], DEPTH)
        phases = k * (np.array(places) - places[0])
        shoreward[m], offshore[m] = np.linalg.lstsq(np.c_[np.exp(-1j * phases), np.exp(1j * phases)], spectrum[:, m], rcond=None)[0]
    return grid, np.fft.irfft(shoreward, len(grid)), np.fft.irfft(offshore, len(grid))


def group_speed(period):
    k, omega = wave_number(period, DEPTH), 2 * np.pi / period
    return 0.5 * omega / k * (1 + 2 * k * DEPTH / np.sinh(2 * k * DEPTH))


def packet(arguments, name, more, height=0.08, period=PERIOD):
    cg = group_speed(period)
    length = 9.0 * max(1.0, period * cg / (PERIOD * group_speed(PERIOD)))  # m: a longer group takes longer to pass the gauges
    onshore, centre = OFFSHORE + length, 6.0 * period / PERIOD
    wave = 2 * np.pi / wave_number(period, DEPTH)
    near = 0.47 * length
    places = [OFFSHORE + near, OFFSHORE + near + 0.11 * wave, OFFSHORE + near + 0.28 * wave]
    arrive = [centre + near / cg, centre + (2 * length - near) / cg, centre + (2 * length + near) / cg, centre + (4 * length - near) / cg]
    end = np.ceil(arrive[2] + 4.0 * period)
    waves = os.path.join(arguments.out, f"packet_{height:g}_{period:g}_{end:g}")
    if not os.path.exists(os.path.join(waves, "run.json")):
        write_packet(waves, height, 24, onshore + 2, end, centre, width=1.2 * period, period=period)
    out = run(arguments, f"packet_{name}", waves, height, period, end, onshore, places, more)
    t, eta = gauges_of(out, 3)
    t, shoreward, offshore = separate(t, eta, places, 0.55 / period, 1.45 / period)

    def strength(signal, at):
        """Of the group that passes at `at`, over 2.5 of its standard deviations to both sides."""
        use = np.abs(t - at) < 2.5 * 1.2 * period
        return np.sqrt(np.sum(signal[use] ** 2))

    came, back, again = strength(shoreward, arrive[0]), strength(offshore, arrive[1]), strength(shoreward, arrive[2])
    quiet = np.abs(t - 0.5 * (arrive[0] + arrive[2])) < period  # nothing travels shoreward: the particles' own motion
    noise = np.sqrt(np.mean(shoreward[quiet] ** 2) * 2 * 2.5 * 1.2 * period / (t[1] - t[0]))
    return {"incident": 2 * np.abs(shoreward[np.abs(t - arrive[0]) < 4 * period]).max() / height, "wall": back / came,
            "boundary": again / back, "noise": noise / back}


def steady(arguments, name, more, height=0.06, periods=24, lengths=(4.2, 4.57, 4.94)):
    """Antinode (the far wall) and separated waves over the last four whole periods."""
    rows = []
    for length in lengths:
        end = np.ceil(2.0 + (periods + 2) * PERIOD)
        waves = os.path.join(arguments.out, f"regular_{height:g}_{end:g}")
        if not os.path.exists(os.path.join(waves, "run.json")):
            write_waves(waves, height, PERIOD, DEPTH, 24, 36, end, window=1.0)
        wave = 2 * np.pi / wave_number(PERIOD, DEPTH)
        antinode = OFFSHORE + length - 0.5 * wave
        places = [antinode, antinode + 0.11 * wave, antinode + 0.28 * wave]
        out = run(arguments, f"steady_{name}_{length:g}", waves, height, PERIOD, end, OFFSHORE + length, places, more)
        t, eta = gauges_of(out, 3)
        ranges = [eta[0][(t > end - (j + 1) * PERIOD) & (t <= end - j * PERIOD)] for j in range(periods)]
        ranges = np.array([r.max() - r.min() for r in ranges])[::-1] / height
        late = t > end - 4 * PERIOD
        omega = 2 * np.pi / PERIOD
        basis = np.c_[np.cos(omega * t[late]), np.sin(omega * t[late]), np.ones(late.sum())]
        coefficients = np.array([np.linalg.lstsq(basis, row[late], rcond=None)[0] for row in eta])
        amplitude = coefficients[:, 0] - 1j * coefficients[:, 1]
        phases = wave_number(PERIOD, DEPTH) * (np.array(places) - places[0])
        # e^{i w t}: shoreward waves carry e^{-ikx}
        incident, reflected = np.linalg.lstsq(np.c_[np.exp(-1j * phases), np.exp(1j * phases)], amplitude, rcond=None)[0]
        with open(os.path.join(out, "run.json")) as file:
            record = json.load(file)
        rows.append({"length": length, "range": ranges[-4:].mean(), "growth": ranges[-4:].mean() / ranges[-8:-4].mean() - 1,
                     "incident": 2 * abs(incident) / height, "reflected": 2 * abs(reflected) / height,
                     "drift": record["invariants"]["largest_mass_drift"]["value"], "cpu": record["cpu_time"]})
    return rows


def main():
    parser = study.command_line(__doc__)
    parser.add_argument("--over-depth", type=int, default=16, help="particles over the depth")
    parser.add_argument("--try", dest="trial", nargs=2, action="append", metavar=("NAME", "KEYS"), help="a boundary of your own: cmps keys, \\n between")
    parser.add_argument("--lengths", type=float, nargs="+", default=[4.2, 4.57, 4.94], help="of the steady test's flumes, m")
    parser.add_argument("--only", choices=["packet", "steady"])
    parser.add_argument("--periods", type=float, nargs="+", default=[1.2, PERIOD, 2.4], help="of the groups, s")
    arguments = parser.parse_args()
    os.makedirs(arguments.out, exist_ok=True)
    boundaries = {name: keys.replace("\\n", "\n") for name, keys in arguments.trial} if arguments.trial else BOUNDARIES
    if arguments.smoke:
        arguments.over_depth = 8
        boundaries = dict(list(boundaries.items())[:1])
    rows = []
    for name, more in boundaries.items():
        if arguments.only != "steady":
            for period in (PERIOD,) if arguments.smoke or arguments.trial else arguments.periods:
                found = packet(arguments, f"{name}_{period:g}", more, period=period)
                rows.append([name, "packet", period, f"{found['boundary']:.3f}", f"{found['wall']:.3f}", f"{found['incident']:.3f}", "", "", ""])
                print(f"{name}: packet of T = {period:g} s: boundary reflects {found['boundary']:.3f}, wall {found['wall']:.3f}, incident {found['incident']:.3f} of what was asked for, noise {found['noise']:.3f}", flush=True)
        if arguments.only != "packet":
            for found in steady(arguments, name, more, periods=8 if arguments.smoke else 24, lengths=(4.57,) if arguments.smoke else arguments.lengths):
                rows.append([name, f"steady {found['length']:g} m", PERIOD, "", f"{found['reflected'] / found['incident']:.3f}", f"{found['incident']:.3f}",
                             f"{found['range']:.3f}", f"{found['growth']:+.3f}", f"{found['drift']:.4f}"])
                print(f"{name}: steady, {found['length']:g} m: antinode range {found['range']:.3f} H (growth {found['growth']:+.3f} in four periods), incident {found['incident']:.3f} H, "
                      f"reflected {found['reflected']:.3f} H, volume drift {found['drift']:.4f}, cpu {found['cpu']:.0f} s", flush=True)
    with open(os.path.join(arguments.out, "boundaries_cmps.csv"), "w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(["boundary", "test", "period s", "reflection of the boundary", "reflection of the wall", "incident over asked",
                         "antinode range over H", "growth in four periods", "largest volume drift"])
        writer.writerows(rows)
    draw(rows, os.path.join(arguments.out, "boundaries_cmps.png"))


def draw(rows, path):
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    names = list(dict.fromkeys(row[0] for row in rows))
    figure, (left, right) = plt.subplots(1, 2, figsize=(9, 3.6))
    for name in names:
        packets = sorted((row[2], float(row[3])) for row in rows if row[0] == name and row[3])
        left.plot([period for period, _ in packets], [value for _, value in packets], "o-", label=name)
        ranges = [float(row[6]) for row in rows if row[0] == name and row[6]]
        right.plot([name] * len(ranges), ranges, "o")
    left.set(xlabel="period of the group (s)", ylabel="reflection coefficient", ylim=(0, 1))
    left.legend(fontsize=7)
    right.axhline(2.0, color="0.6", lw=0.8)
    right.set(ylabel="antinode range over H, flumes of several lengths")
    right.tick_params(axis="x", labelsize=7)
    figure.tight_layout()
    figure.savefig(path, dpi=120)
    plt.close(figure)


if __name__ == "__main__":
    main()
