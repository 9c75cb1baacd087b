"""Dam breaks against published measurements.

Martin & Moyce (1952), tables 2 and 6: front and height of a column a x 2a, a = 2.25 in.
Koshizuka & Oka (1996; experiment of Koshizuka et al. 1995): front of a column L x 2L in a tank of 4L.
Lobovsky et al. (2014): levels and impact pressure, column 0.6 x 0.3 m in a tank of 1.61 m.
"""
import shutil

import numpy as np

from cmps_program import Run, expect, finish, members
from figures import RECORDING, ensemble_figure, published_interval


def scene(end, box, water, spacing, gauges="", pictures=0.01):
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
particles_interval = {pictures}
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


LOBOVSKY = """
low = {x = 1.61, z = 0.003, kind = "pressure", diameter = 0.0042, interval = 0.001}
high = {x = 1.61, z = 0.030, kind = "pressure", diameter = 0.0042, interval = 0.001}
H1 = {x = 0.300, interval = 0.005}
H2 = {x = 0.865, interval = 0.005}
H4 = {x = 1.3625, interval = 0.005}
"""


def lobovsky_member(spacing, member, end):
    """Figures of one run on a lattice of its own, within 4 % of `spacing`: pressures over rho g H, times over sqrt(H/g)."""
    height, gravity = 0.3, 9.81
    scale = np.sqrt(gravity / height)
    lattice = spacing * (1 + 0.04 * np.random.default_rng(member).uniform(-1, 1))
    run = Run(f"lobovsky_{spacing}_{member}", scene(end, [0, 1.61, 0, 0.6], [[[0, 0], [0.6, 0], [0.6, 0.3], [0, 0.3]]], lattice, LOBOVSKY, pictures=0.25), perturbation=member)
    expect(run.status == 0, f"Lobovsky, l0 = {1000 * lattice:.3f} mm: exit {run.status} {run.messages.strip()}")
    t, low = run.gauge("low", "pressure")
    _, high = run.gauge("high", "pressure")
    t, low, high = t * scale, low / (1000 * gravity * height), high / (1000 * gravity * height)
    arrival = t[np.argmax(low > 0.1)]
    figures = {"peak": low[t < 4].max(), "blow": low[(t >= arrival) & (t < arrival + 0.04 * scale)].mean(), "high": high[t < 4].max()}
    if end >= 1:
        late = (t > 3.5) & (t < 5.5)
        figures["noise"] = np.std((low - np.convolve(low, np.ones(53) / 53, "same"))[late])
        figures["late"] = low[(t > 4) & (t < 5.5)].mean()
        for name in ("H2", "H4"):
            tl, level = run.gauge(name)
            figures[name] = (tl * scale)[np.argmax(level > 0.03 * height)]
        tl, level = run.gauge("H1")
        measured = np.array([[1.0, 0.93], [2.0, 0.785], [3.0, 0.635], [4.0, 0.50], [5.0, 0.405]])
        figures["reservoir"] = np.sqrt(np.mean((np.interp(measured[:, 0], tl * scale, level / height) - measured[:, 1]) ** 2))
    shutil.rmtree(run.out)
    return figures


def lobovsky():
    """Water arrives at the wall particle by particle: each figure is that of an ensemble of lattices and perturbations."""
    ensembles = {mm: [lobovsky_member(mm / 1000, member, end) for member in members(recorded if RECORDING else ordinary)]
                 for mm, end, ordinary, recorded in ((10, 1.0, 5, 40), (5, 0.75, 3, 20))}

    def figure(name, mm, key, unit, reference=0.0, why=""):
        expect(*ensemble_figure("cmps", f"Lobovsky's dam break: {name}; l0 = {mm} mm", [one[key] for one in ensembles[mm]], unit, reference, why))

    # the record's largest value; its largest mean over as long as the readings, l0/sqrt(g H), is 2.63 (10 mm) and 2.80 (5 mm)
    figure("first peak at z = 3 mm", 10, "peak", "rho g H", 3.04)
    figure("first peak at z = 3 mm", 5, "peak", "rho g H", 3.04)
    figure("mean of the first 40 ms at z = 3 mm", 10, "blow", "rho g H", 2.04)
    figure("mean of the first 40 ms at z = 3 mm", 5, "blow", "rho g H", 2.04)
    figure("largest reading at z = 30 mm", 10, "high", "rho g H", 1.54)
    figure("largest reading at z = 30 mm", 5, "high", "rho g H", 1.54)
    figure("noise at z = 3 mm from t sqrt(g/H) = 3.5 to 5.5", 10, "noise", "rho g H", 0.05)
    figure("pressure at z = 3 mm from t sqrt(g/H) = 4 to 5.5", 10, "late", "rho g H", 0.65)  # of the record; its walls have friction
    figure("arrival at H2", 10, "H2", "sqrt(H/g)", 1.03)
    figure("arrival at H4", 10, "H4", "sqrt(H/g)", 2.19)
    figure("level in the reservoir: rms off the record", 10, "reservoir", "H")
    # What is claimed of the method, of the published means with their uncertainty: chance has no part in it.
    for name, mm, low, high, claim in (
            ("first peak at z = 3 mm", 10, 3.04 * 0.8, 2.63 * 1.2, "within 20 % of both the record's largest value (3.04) and its largest mean over as long (2.63)"),
            ("mean of the first 40 ms at z = 3 mm", 10, 2.04 * 0.8, 2.04 * 1.2, "within 20 % of the record"),
            ("mean of the first 40 ms at z = 3 mm", 5, 2.04 * 0.8, 2.04 * 1.2, "within 20 % of the record"),
            ("noise at z = 3 mm from t sqrt(g/H) = 3.5 to 5.5", 10, 0.0, 0.08, "the record has 0.03 to 0.07"),
            ("arrival at H2", 10, 0.8 * 1.03, 1.03, "no later than the record's, and by 20 % earlier at most: inviscid codes lead"),
            ("arrival at H4", 10, 0.8 * 2.19, 2.19, "no later than the record's, and by 20 % earlier at most: inviscid codes lead"),
            ("level in the reservoir: rms off the record", 10, 0.0, 0.04, "a particle of H/30 and the reading error at most")):
        least, most = published_interval("cmps", f"Lobovsky's dam break: {name}; l0 = {mm} mm")
        expect(low <= least and most <= high, f"Lobovsky, l0 = {mm} mm: {name} {least:.4g} to {most:.4g} (mean of the ensemble), {low:.4g} to {high:.4g}: {claim}")


martin_moyce()
koshizuka()
lobovsky()
finish()
