"""Dam breaks against published measurements.

Martin & Moyce (1952), tables 2 and 6: front and height of a column a x 2a, a = 2.25 in.
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
    # inviscid codes lead by 5 to 20 % (gate, wetting); a standard MPS code leads by as much, rms 0.30 at L/20
    lead = np.mean(error / measured[:, 1])
    expect(0 < lead < 0.2, f"Koshizuka: front leads by {100 * lead:.1f} % of x, rms {rms:.3f} L (bound 0 to 20 %)")


def martin_moyce():
    width, gravity, spacing = 0.05715, 9.81, 0.05715 / 20
    gauges = f"back = {{x = {0.5 * spacing}, interval = 0.005}}"
    run = Run("martin_moyce", scene(0.3, [0, 8 * width, 0, 3 * width], [[[0, 0], [width, 0], [width, 2 * width], [0, 2 * width]]], spacing, gauges))
    expect(run.status == 0, f"Martin & Moyce: exit {run.status} {run.messages.strip()}")
    t, position, _ = run.fluid()
    front = (position[:, :, 0].max(axis=1) + 0.5 * spacing) / width
    # table 2: t sqrt(2g/a), x/a
    measured = np.array([[0.41, 1.11], [0.84, 1.22], [1.19, 1.44], [1.43, 1.67], [1.63, 1.89], [1.83, 2.11], [1.98, 2.33], [2.20, 2.56], [2.32, 2.78],
                         [2.51, 3.00], [2.65, 3.22], [2.83, 3.44], [2.98, 3.67], [3.11, 3.89], [3.33, 4.11]])
    scaled = t * np.sqrt(2 * gravity / width)
    error = np.interp(measured[:, 0], scaled, front) - measured[:, 1]
    slope = np.polyfit(measured[4:, 0], np.interp(measured[4:, 0], scaled, front), 1)[0] / np.polyfit(measured[4:, 0], measured[4:, 1], 1)[0]
    # the gate and the wetting of the floor cost the experiment 5 to 20 % (every inviscid code leads); a code that lags is wrong
    expect(0 < np.mean(error / measured[:, 1]) < 0.2, f"Martin & Moyce: front leads by {100 * np.mean(error / measured[:, 1]):.1f} % of x, rms {np.sqrt(np.mean(error**2)):.3f} a (bound 0 to 20 %)")
    expect(abs(slope - 1) < 0.15, f"Martin & Moyce: front speed beyond 1.9 a {slope:.3f} of the measured (bound 15 %: tables to 0.01 in steps of 0.2)")
    tl, level = run.gauge("back")
    # table 6: t sqrt(g/a), height/2a
    height = np.array([[0.56, 0.94], [0.77, 0.89], [0.93, 0.83], [1.08, 0.78], [1.28, 0.72], [1.46, 0.67], [1.66, 0.61], [1.84, 0.56], [2.00, 0.50],
                       [2.21, 0.44], [2.45, 0.39], [2.70, 0.33], [3.06, 0.28], [3.44, 0.22]])
    rms = np.sqrt(np.mean((np.interp(height[:, 0], tl * np.sqrt(gravity / width), level / (2 * width)) - height[:, 1]) ** 2))
    expect(rms < 0.04, f"Martin & Moyce: height of the column, rms {rms:.3f} of its first height (bound 0.04: a particle and a half, and tables in steps of 0.055)")


def lobovsky():
    height, gravity = 0.3, 9.81
    gauges = """
low = {x = 1.61, z = 0.003, kind = "pressure", diameter = 0.0042, interval = 0.001}
high = {x = 1.61, z = 0.030, kind = "pressure", diameter = 0.0042, interval = 0.001}
H1 = {x = 0.300, interval = 0.005}
H2 = {x = 0.865, interval = 0.005}
H4 = {x = 1.3625, interval = 0.005}
"""
    scale = np.sqrt(gravity / height)

    def figures(spacing):
        """The run and, over rho g H: largest reading at z = 3 mm, later noise and mean, largest at 30 mm, first peak's mean over 40 ms."""
        run = Run(f"lobovsky{spacing}", scene(1.0, [0, 1.61, 0, 0.6], [[[0, 0], [0.6, 0], [0.6, 0.3], [0, 0.3]]], spacing, gauges))
        expect(run.status == 0, f"Lobovsky, l0 = {spacing}: exit {run.status} {run.messages.strip()}")
        t, low = run.gauge("low", "pressure")
        _, high = run.gauge("high", "pressure")
        t, low, high = t * scale, low / (1000 * gravity * height), high / (1000 * gravity * height)
        arrival = t[np.argmax(low > 0.1)]
        blow = low[(t >= arrival) & (t < arrival + 0.04 * scale)].mean()
        late = (t > 3.5) & (t < 5.5)
        noise = np.std((low - np.convolve(low, np.ones(53) / 53, "same"))[late])
        return run, np.array([low[t < 4].max(), blow, noise, low[(t > 4) & (t < 5.5)].mean(), high[t < 4].max()])

    # the tongue's tip is one particle thick and particles arrive one by one: the median of five lattices
    rows = []
    for spacing in (0.0098, 0.0099, 0.0101, 0.0102, 0.01):
        run, row = figures(spacing)
        rows.append(row)
    peaks, _, noises, _, _ = np.array(rows).T
    peak, blow, noise, late, high = np.median(rows, axis=0)
    spread = lambda values: ", ".join(f"{value:.2f}" for value in values)
    # Readings are means over l0/sqrt(g H), the record's largest value is 3.04, its largest mean over as long 2.63 rho g H
    # (l0 = 10 mm) and 2.80 (5 mm): a run has to lie within 20 % of both.
    expect(abs(peak / 3.04 - 1) < 0.2 and abs(peak / 2.63 - 1) < 0.2,
           f"Lobovsky: first peak at z = 3 mm {peak:.2f} rho g H ({spread(peaks)}), measured 3.04, over as long as the readings 2.63 (bound 20 % of both)")
    expect(abs(blow / 2.04 - 1) < 0.2, f"Lobovsky: mean of the first 40 ms {blow:.2f} rho g H, measured 2.04 (bound 20 %)")
    expect(noise < 0.08, f"Lobovsky: later noise {noise:.3f} rho g H ({', '.join(f'{value:.3f}' for value in noises)}), measured 0.03 to 0.07 (bound 0.08)")
    _, (fine_peak, fine_blow, fine_noise, fine_late, fine_high) = figures(0.005)
    expect(abs(fine_peak / 3.04 - 1) < 0.2 and abs(fine_peak / 2.80 - 1) < 0.2,
           f"Lobovsky, l0 = 5 mm: first peak {fine_peak:.2f} rho g H, measured 3.04, over as long 2.80 (bound 20 % of both); first 40 ms {fine_blow:.2f}")
    expect(fine_noise < noise, f"Lobovsky, l0 = 5 mm: later noise {fine_noise:.3f} rho g H (less than at 10 mm)")
    # No figure to be right about: at 30 mm a run scatters by a third between lattices, the record has 1.54
    print(f"      Lobovsky: largest reading at z = 30 mm {high:.2f} rho g H at 10 mm, {fine_high:.2f} at 5 mm, measured 1.54")
    # The floor has no friction: a volume-of-fluid run of the same water (cmps/README.md) has 0.90 with a smooth floor, 0.64
    # with one that holds the water, the experiment 0.65. A jet's pressure is right to 3 % (cmps_jet.py).
    expect(abs(fine_late / late - 1) < 0.05, f"Lobovsky: pressure between t* = 4 and 5.5 {late:.3f} rho g H at 10 mm, {fine_late:.3f} at 5 mm (within 5 % of each other)")
    expect(abs(fine_late / 0.90 - 1) < 0.05, f"Lobovsky: pressure between t* = 4 and 5.5 {fine_late:.3f}, a volume-of-fluid run without friction 0.90 (bound 5 %); measured, with friction, 0.65")
    for name, arrival in (("H2", 1.03), ("H4", 2.19)):
        tl, level = run.gauge(name)
        here = (tl * scale)[np.argmax(level > 0.03 * height)]
        expect(0.8 * arrival < here < 1.05 * arrival, f"Lobovsky: front at {name} at t* = {here:.2f}, measured {arrival} (inviscid codes lead by 5 to 20 %)")
    tl, level = run.gauge("H1")
    measured = np.array([[1.0, 0.93], [2.0, 0.785], [3.0, 0.635], [4.0, 0.50], [5.0, 0.405]])
    rms = np.sqrt(np.mean((np.interp(measured[:, 0], tl * scale, level / height) - measured[:, 1]) ** 2))
    expect(rms < 0.04, f"Lobovsky: level in the reservoir, rms {rms:.3f} H (bound 0.04: a particle of l0 = H/30 and the reading error)")


martin_moyce()
koshizuka()
lobovsky()
finish()
