"""Dam breaks against published measurements.

Koshizuka & Oka (1996; experiment of Koshizuka et al. 1995): front of a column L x 2L in a tank of 4L.
Lobovsky et al. (2014): levels and impact pressure, column 0.6 x 0.3 m in a tank of 1.61 m.
"""
import numpy as np

from cmps_program import Run, expect, finish


def scene(end, box, water, spacing, gauges=""):
    return f"""
title = "dam break"
[time]
end = {end}
window = 0.25
[gauges]
{gauges}
[cmps]
drive = "none"
tank = {box}
water = {water}
particle_spacing = {spacing}
particles_interval = 0.01
"""


def koshizuka():
    column, gravity = 0.146, 9.81
    run = Run("koshizuka", scene(0.3, [0, 4 * column, 0, 3 * column], [[[0, 0], [column, 0], [column, 2 * column], [0, 2 * column]]], column / 24))
    expect(run.status == 0, f"Koshizuka: exit {run.status} {run.messages.strip()}")
    t, position, _ = run.fluid()
    front = (position[:, :, 0].max(axis=1) + 0.5 * column / 24) / column
    # t sqrt(2g/L), x/L as measured
    measured = np.array([[0.777, 1.247], [1.157, 1.507], [1.530, 1.897], [1.934, 2.246], [2.318, 2.607], [2.701, 3.000]])
    error = np.interp(measured[:, 0], t * np.sqrt(2 * gravity / column), front) - measured[:, 1]
    rms = np.sqrt(np.mean(error**2))
    # inviscid codes lead by 5 to 20 % (gate, wetting); the peer's rms at L/20 is 0.30
    expect(rms < 0.30, f"Koshizuka: front leads by {np.mean(error):+.3f} x/L, rms {rms:.3f} (bound 0.30)")


def lobovsky():
    height, gravity = 0.3, 9.81
    gauges = """
low = {x = 1.61, z = 0.003, kind = "pressure", diameter = 0.0042, interval = 0.001}
H1 = {x = 0.300, interval = 0.005}
H2 = {x = 0.865, interval = 0.005}
H4 = {x = 1.3625, interval = 0.005}
"""
    scale = np.sqrt(gravity / height)
    peaks = []
    for spacing in (0.0099, 0.0101, 0.01):  # the peak is one particle's arrival: the median of three lattices
        run = Run(f"lobovsky{spacing}", scene(1.0, [0, 1.61, 0, 0.6], [[[0, 0], [0.6, 0], [0.6, 0.3], [0, 0.3]]], spacing, gauges))
        expect(run.status == 0, f"Lobovsky, l0 = {spacing}: exit {run.status} {run.messages.strip()}")
        t, pressure = run.gauge("low", "pressure")
        t, pressure = t * scale, pressure / (1000 * gravity * height)
        peaks.append(pressure[t < 4].max())
    peak = np.median(peaks)
    expect(abs(peak / 3.04 - 1) < 0.2, f"Lobovsky: first peak at z = 3 mm {peak:.2f} rho g H ({', '.join(f'{p:.2f}' for p in peaks)}), measured 3.04 (bound 20 %)")
    late = (t > 3.5) & (t < 5.5)
    smooth = np.convolve(pressure, np.ones(53) / 53, "same")
    noise = np.std((pressure - smooth)[late])
    expect(noise < 0.08, f"Lobovsky: later noise {noise:.3f} rho g H, measured 0.03 to 0.07 (bound 0.08)")
    mean = pressure[(t > 4) & (t < 5.5)].mean()
    expect(abs(mean - 0.69) < 0.14, f"Lobovsky: pressure between t* = 4 and 5.5 is {mean:.3f} rho g H, measured 0.69 (bound 20 %)")
    for name, arrival in (("H2", 1.03), ("H4", 2.19)):
        tl, level = run.gauge(name)
        here = (tl * scale)[np.argmax(level > 0.03 * height)]
        expect(0.8 * arrival < here < 1.05 * arrival, f"Lobovsky: front at {name} at t* = {here:.2f}, measured {arrival} (inviscid codes lead by 5 to 20 %)")
    tl, level = run.gauge("H1")
    measured = np.array([[1.0, 0.93], [2.0, 0.785], [3.0, 0.635], [4.0, 0.50], [5.0, 0.405]])
    rms = np.sqrt(np.mean((np.interp(measured[:, 0], tl * scale, level / height) - measured[:, 1]) ** 2))
    expect(rms < 0.04, f"Lobovsky: level in the reservoir, rms {rms:.3f} H (bound 0.04: a particle of l0 = H/30 and the reading error)")


koshizuka()
lobovsky()
finish()
