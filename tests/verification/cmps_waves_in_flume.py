"""Waves made by the boundaries: a solitary wave from a piston against a wall, regular waves kept along a flume."""
import os

import numpy as np

from cmps_program import FOLDER, Run, expect, finish
from cmps_waves import write_waves


def goring_piston(path, depth, height, end, gravity=9.81):
    """Path of a piston that makes a solitary wave (Goring 1978): dX/dt = c eta/(d + eta), eta at the moving plate."""
    k, c = np.sqrt(3 * height / (4 * depth**3)), np.sqrt(gravity * (depth + height))
    lead = 3.8 / (k * c)  # half the duration: 0.2 % of the crest left outside
    step, x, rows = 0.005, 0.0, []
    for i in range(int(end / step) + 1):
        rows.append((i * step, x))

        def speed(at, t):
            eta = height / np.cosh(k * (c * (t - lead) - at)) ** 2
            return c * eta / (depth + eta)

        a = speed(x, i * step)
        x += step * speed(x + 0.5 * step * a, (i + 0.5) * step)
    with open(path, "w") as file:
        file.write("t,x\n" + "".join(f"{t:.4f},{at:.8f}\n" for t, at in rows))


def crest_height(time, elevation, depth, gravity=9.81):
    """Height over depth of the solitary wave that lies nearest to the record around its crest, by least squares: single
    readings of a surface of particles are off by a quarter of a spacing."""
    at, best = time[np.argmax(elevation)], (np.inf, 0.0)
    for crest in np.arange(at - 0.15, at + 0.15, 0.005):
        use = np.abs(time - crest) < 0.4
        for epsilon in np.arange(0.10, 0.30, 0.001):
            rate = np.sqrt(0.75 * epsilon) / depth * np.sqrt(gravity * depth * (1 + epsilon))
            misfit = np.mean((elevation[use] / depth - epsilon / np.cosh(rate * (time[use] - crest)) ** 2) ** 2)
            best = min(best, (misfit, epsilon))
    return best[1]


def solitary_reflection():
    depth, height = 0.2, 0.04
    path = os.path.join(FOLDER, "goring.csv")
    goring_piston(path, depth, height, 7.0)
    run = Run("solitary", f"""
title = "solitary wave against a wall"
[time]
end = 5.5
window = 0.5
[flume]
bed = [[0.0, {-depth}], [8.0, {-depth}]]
[gauges]
middle = 3.0
wall = 4.98
[cmps]
drive = "piston"
piston_file = "{path}"
offshore = 1.0
onshore = 5.0
particle_spacing = {depth / 20}
""")
    expect(run.status == 0, f"solitary wave: exit {run.status} {run.messages.strip()}")
    t, middle = run.gauge("middle")
    _, wall = run.gauge("wall")
    before = t < 3.2  # the crest passes at about 2.6 s and is back at 5 s
    epsilon = crest_height(t[before], middle[before] - middle[t < 0.3].mean(), depth)
    incident, still = epsilon * depth, wall[t < 0.3].mean()
    runup = (wall.max() - still) / depth
    theory = 2 * epsilon + epsilon**2 / 2 + 0.75 * epsilon**3  # Su & Mirie (1980)
    expect(abs(incident / height - 1) < 0.1, f"solitary wave: height after 10 depths {incident / height:.3f} of the piston's (bound 10 %: l0 is a quarter of it)")
    expect(abs(runup / theory - 1) < 0.1, f"solitary wave: run-up at the wall {runup:.3f} d, theory {theory:.3f} d for the wave as it came (bound 10 %)")
    back = depth * crest_height(t[t > 4.2], middle[t > 4.2] - middle[t < 0.3].mean(), depth)
    expect(back / incident > 0.85, f"solitary wave: reflected crest {back / incident:.3f} of the incident (bound 0.85)")


def regular_waves():
    period, height, depth = 1.65, 0.10, 0.4
    waves = os.path.join(FOLDER, "regular_waves")
    write_waves(waves, height, period, depth, 24, 30, 14, window=1.0)
    run = Run("regular", f"""
title = "regular waves over a level bed"
accuracy = "draft"
[time]
end = 12.0
window = 1.0
[flume]
bed = [[0.0, {-depth}], [60.0, {-depth}]]
[gauges]
near = 26.5
far = 29.45
[cmps]
offshore = 25.0
onshore = 34.0
""", waves=waves)
    expect(run.status == 0, f"regular waves: exit {run.status} {run.messages.strip()}")

    def first_harmonic(name, begin, end):
        t, eta = run.gauge(name)
        use = (t >= begin) & (t < end)
        omega = 2 * np.pi / period
        basis = np.c_[np.cos(omega * t[use]), np.sin(omega * t[use]), np.ones(use.sum())]
        a, b, _ = np.linalg.lstsq(basis, eta[use], rcond=None)[0]
        return 2 * np.hypot(a, b)

    # whole periods after the ramp and before the wall at 34 m answers (group speed 1.46 m/s)
    near, far = first_harmonic("near", 6.5, 6.5 + 2 * period), first_harmonic("far", 8.2, 8.2 + 2 * period)
    expect(abs(near / height - 1) < 0.12, f"regular waves: {near / height:.3f} of the height asked for stands behind the boundary (bound 12 %)")
    expect(far / near > 0.93, f"regular waves: {far / near:.3f} of the height is kept over one wave length at draft accuracy (bound 0.93)")


solitary_reflection()
regular_waves()
finish()
