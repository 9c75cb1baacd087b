"""Sleeping changes nothing that anybody would notice: who moves, from which load on, and where momentum goes, with blocks asleep and with nobody asleep."""
import tempfile

import numpy as np

from dem_flow import write_flow
from dem_program import Checks, run

check = Checks()
d, rho, g = 0.008, 1000.0, 9.81
FLOOR = "planes = [{{ point = [0.0, 0.0, {z}], normal = [0.0, 0.0, 1.0] }}]"
SUBMERGED = 27 * (3.689 - 1) * rho * np.pi / 6 * d**3 * g  # weight of cube27 under water, N


def head(end, keys, output=0.1, window=None):
    return f'[time]\nend = {end}\nwindow = {window or end}\n[dem]\nmound = "none"\noutput_interval = {output}\n{keys}\n'


def both(scene, *arguments):
    """The scene as it is, and with nobody ever asleep."""
    runs = [run(scene, *arguments, "--set", f"effects.sleeping={word}") for word in ("auto", "off")]
    check.true("runs", all(r.status == 0 for r in runs), "".join(r.message for r in runs))
    return runs


def speed_for(force, elements=27):
    """Speed of water past a block at rest whose drag is `force`, eqs. (10) and (12)."""
    a, b = 0.4, 24e-6 / d
    c = force / (elements * 0.5 * rho * np.pi / 4 * d**2)
    return (-b + np.sqrt(b * b + 4 * a * c)) / (2 * a)


def flow_of(load, end, vertical=False):
    """Windows of a flow whose drag on cube27 at rest is load(t)."""
    folder = tempfile.mkdtemp(prefix="tsunagi_flow_")

    def motion(t, X, Z):
        speed = speed_for(load(t))
        return (0.0, speed, 0.0, 0.0, 1.0) if vertical else (speed, 0.0, 0.0, 0.0, 1.0)

    write_flow(folder, motion, np.linspace(-0.5, 1.5, 9), np.linspace(-1.0, 0.5, 7), 0.0, end, 1.0, 0.02)
    return folder


def cube(keys, end, more=""):
    return head(end, keys + "\n" + FLOOR.format(z=-0.5), window=1.0) + f'[[dem.block]]\nshape = "cube27"\nposition = [0.0, 0.0, -0.488004]\n{more}'


def onset(r, way=1e-2 * d):
    """First sample at which the block has gone farther from where it was at 1 s than springs give."""
    x = r.series("/blocks/position")[:, 0]
    t = r.series("/time")
    start = x[np.searchsorted(t, 1.0)]
    gone = np.linalg.norm(x - start, axis=1) > way
    return t[gone & (t > 1.0)].min() if (gone & (t > 1.0)).any() else np.inf


# A load of 0.97 of what friction holds, long enough to fall asleep under it; then 1.05 of it.
held = 0.577 * SUBMERGED
plateau = flow_of(lambda t: held * (0.97 * min(t, 1.0) if t < 4 else 0.97 + 0.08 * min(t - 4, 1.0)), 8.0)
on, off = both(cube("friction = 0.577", 8.0), "--flow", plateau)
check.true("plateau: it slept", on.series("/blocks/asleep").max() == 1)
way = [r.series("/blocks/position")[-1, 0, 0] for r in (on, off)]
check.true("plateau: it slides at 1.05 of the limit", way[1] > 0.01, f"{1e3 * way[1]:.1f} mm")
check.below("plateau: way with sleeping against without", abs(way[0] / way[1] - 1), 1e-3)  # measured 1e-8

# The load rises slowly enough for short naps; the instant of sliding is that of the load. 0.05 s between samples are 0.1 % of the limit. The
# same for tipping (rough floor: the water tips it before it slides) and, with hardly any weight, for lifting off.
for name, keys, load, vertical in (("sliding", "friction = 0.577", held, False), ("sliding on ice", "friction = 0.05", 0.05 * SUBMERGED, False),
                                   ("tipping", "friction = 3.0", SUBMERGED * 8 / 12, False),
                                   ("lifting", "density_ratio = 1.02", SUBMERGED * 0.02 / 2.689, True)):
    end, rate = 12.0, 0.02
    first = 0.86
    ramp = flow_of(lambda t: load * (first * min(t, 1.0) + rate * max(t - 2.0, 0.0)), end, vertical)
    scene = cube(keys, end).replace("output_interval = 0.1", "output_interval = 0.05")
    on, off = both(scene, "--flow", ramp)
    at = [first + rate * (onset(r) - 2.0) for r in (on, off)]
    print(f"{name}: asleep at {on.series('/blocks/asleep').sum()} samples; moves at {at[0]:.4f} of the load it should, with nobody asleep at {at[1]:.4f}")
    check.true(f"{name}: it slept on the way", on.series("/blocks/asleep").sum() > 5)
    check.below(f"{name}: load at which it moves, against nobody asleep", abs(at[0] - at[1]), 0.01)
    check.below(f"{name}: against the load at which it should", abs(at[0] - 1), 0.05)

# Nothing holds blocks on a floor without friction: a tow, a slow hit, a slow current move them as if nobody ever slept.
TOW = head(3.0, "dry = true\nfriction = 0.0\ndamping_ratio = 0.5\ntime_step = 2e-5\n" + FLOOR.format(z=0.0)) + \
    '[[dem.block]]\nshape = "cube27"\nposition = [0.0, 0.0, 0.0119992]\n[[dem.block]]\nshape = "sphere"\nposition = [0.05, 0.0, 0.00399905]\nvelocity = [0.02, 0.0, 0.0]\n' + \
    "[wires]\npsi = 5.0\n[[wires.link]]\nblocks = [1, 2]\nspheres = [14, 1]\nrest_length = 0.056\nstiffness = 1.0\n"
for r, name in zip(both(TOW), ("sleeping", "nobody asleep")):
    v = r.series("/blocks/velocity")[-1, :, 0]
    check.below(f"towed block, {name}: momentum lost", abs((27 * v[0] + v[1]) / 0.02 - 1), 1e-9)

height = 0.003992403166622349  # at which a sphere's weight is carried
CRADLE = head(20.3, "dry = true\nfriction = 0.0\ndamping_ratio = 0.0\ntime_step = 2e-5\n" + FLOOR.format(z=0.0)) + \
    f'[[dem.block]]\nshape = "sphere"\nposition = [0.0, 0.0, {height}]\n[[dem.block]]\nshape = "sphere"\nposition = [-0.008125, 0.0, {height}]\nvelocity = [0.0005, 0.0, 0.0]\n'
for r, name in zip(both(CRADLE), ("sleeping", "nobody asleep")):
    v = r.series("/blocks/velocity")[-1, :, 0]
    check.below(f"equal spheres, 0.5 mm/s, {name}: velocities not exchanged", np.abs(v / 0.0005 - [1, 0]).max(), 1e-5)

on, off = both(cube("friction = 0.0\ncurrent = [0.001, 0.0, 0.0]", 20.0))
way = [r.series("/blocks/position")[-1, 0, 0] for r in (on, off)]
check.true("drift in 1 mm/s: it goes along", way[1] > 1e-3, f"{1e3 * way[1]:.2f} mm")
check.true("drift in 1 mm/s: sleeping makes no difference to the bit", way[0] == way[1])

# Where nobody sleeps the run is the same to the bit, with sleeping allowed and without.
waves = tempfile.mkdtemp(prefix="tsunagi_flow_")
write_flow(waves, lambda t, X, Z: (0.3 * np.sin(6 * t), 0.0, 1.8 * np.cos(6 * t), 0.0, 1.0), np.linspace(-0.5, 0.5, 5), np.linspace(-1.0, 0.5, 7), 0.0, 1.0, 0.5, 0.02)
on, off = both(head(1.0, "gravity = [0.0, 0.0, 0.0]", window=0.5) + '[[dem.block]]\nshape = "sphere"\nposition = [0.0, 0.0, -0.3]\n', "--flow", waves)
for name in ("/blocks/position", "/blocks/orientation", "/blocks/velocity", "/energy"):
    check.true(f"nobody asleep: {name} to the bit with sleeping allowed and without", np.array_equal(on.series(name), off.series(name)))

check.end()
