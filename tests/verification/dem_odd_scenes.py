"""Small scenes that are odd and legal: they run to their end, and what the run says of itself is true."""
import json
import os
import tempfile

import h5py
import numpy as np

from dem_flow import write_flow
from dem_program import Checks, run

check = Checks()
d, density_ratio, gravity = 0.008, 3.689, 9.81


def scene(end, keys, rest="", window=None, output=0.01):
    return f'[time]\nend = {end}\nwindow = {window or end}\n[dem]\nmound = "none"\noutput_interval = {output}\n{keys}\n{rest}'


def block(shape, position, more=""):
    return f'[[dem.block]]\nshape = "{shape}"\nposition = {[float(v) for v in position]}\n{more}\n'


FLOOR = "planes = [{ point = [0.0, 0.0, 0.0], normal = [0.0, 0.0, 1.0] }]"

# Dropped from rest in the dry: weight is all that changes hands. A flat elastic bounce at this step is off by 0.02 % of it; five
# times that is allowed, and run.json must say the same as the balance of the windows.
for what, damping in (("elastic", 0.0), ("hardly damped", 0.001)):
    r = run(scene(0.6, f"dry = true\ndamping_ratio = {damping}\n{FLOOR}", block("cube27", (0, 0, 0.05))))
    check.true(f"{what} drop from rest runs to its end", r.status == 0, r.message.strip())
    energy = r.series("/energy")
    balance = energy[:, :5].sum(axis=1) - energy[:, 5]
    mass = 27 * density_ratio * 1000 * np.pi / 6 * d**3
    fall = mass * gravity * (0.05 - 0.012)
    check.below(f"{what} drop, error of the balance over the energy of the fall", abs(balance[-1] - balance[0]) / fall, 1e-3)
    # Kinetic energy is looked at every 2 ms: within 5 % of its peak at the end of a fall of 0.09 s.
    check.below(f"{what} drop, closure of run.json against that", abs(r.invariant("energy_closure") * fall / (balance[-1] - balance[0]) - 1), 0.05)

# Fixed spheres are no mound: blocks may leave them, pass them, and start below them.
r = run(scene(0.5, "dry = true\nfixed_spheres = [[0.0, 0.0, 0.0]]", block("sphere", (0.0001, 0, 0.00799))))
check.true("a sphere rolls off a fixed one and falls", r.status == 0 and r.series("/blocks/position")[-1, 0, 2] < -0.3, r.message.strip())
r = run(scene(0.1, "dry = true\ngravity = [0.0, 0.0, 0.0]\nfixed_spheres = [[0.0, 0.0, 0.0]]", block("sphere", (0.02, 0, 0.03), "velocity = [0.0, 0.0, -1.0]")))
check.true("a sphere flies past a fixed one", r.status == 0, r.message.strip())
check.below("and is where it must be", abs(r.series("/blocks/position")[-1, 0, 2] + 0.07), 1e-12, "m")  # rounding
r = run(scene(0.1, "dry = true\ngravity = [0.0, 0.0, 0.0]\nfixed_spheres = [[0.0, 0.0, 0.0]]", block("sphere", (0, 0, -0.02), "velocity = [0.0, 0.0, 0.5]")))
check.true("a sphere is thrown at a fixed one from below", r.status == 0 and r.series("/blocks/velocity")[-1, 0, 2] < 0, r.message.strip())

# At r_max a wire holds; mounted a nanometre beyond it, it is refused: 0.03 + 0.1 d = 0.0308.
for place, intact in ((0.0308, 1), (0.0308 + 1e-9, 0)):
    r = run(scene(1e-4, "dry = true\ngravity = [0.0, 0.0, 0.0]", block("sphere", (0, 0, 1)) + block("sphere", (place, 0, 1)) +
                  "[wires]\npsi = 0.1\n[[wires.link]]\nblocks = [1, 2]\nspheres = [1, 1]\nrest_length = 0.03\nstiffness = 100.0\n"))
    check.true(f"wire of r_max {'holds' if intact else 'and a nanometre is refused'}", r.status == 0 and r.series("/wires/intact")[-1, 0] == 1 if intact else
               r.status == 2 and "0.030800001 m" in r.message, r.message.strip())

# A broken wire stays broken in a restart whose layout names its ends the other way round.
PAIR = block("sphere", (0, 0, 1), "velocity = [-0.5, 0.0, 0.0]") + block("sphere", (0.02, 0, 1), "velocity = [0.5, 0.0, 0.0]")
LINK = "[wires]\npsi = 0.1\n[[wires.link]]\nblocks = [{}]\nspheres = [1, 1]\nstiffness = 1.0\n"
first = run(scene(0.1, "dry = true\ngravity = [0.0, 0.0, 0.0]", PAIR + LINK.format("1, 2")))
check.true("the wire breaks", first.figure("wires.broken") == 1)
for ends in ("1, 2", "2, 1"):
    r = run(scene(0.2, "dry = true\ngravity = [0.0, 0.0, 0.0]", PAIR + LINK.format(ends)), "--from", os.path.join(first.folder, "state.h5"))
    check.true(f"and stays broken as [{ends}]", r.status == 0 and r.figure("wires.broken") == 1, r.message.strip())

# When it broke is kept as well: exactly from a state, from a window to the sample at which it was first found broken.
with h5py.File(os.path.join(first.folder, "state.h5")) as f:
    broke = f["/wires/broken_at"][0]
    check.true("a state tells when", 0 < broke < 0.1, f"{broke} s")
for name, latest in (("state.h5", broke), ("window_000000.h5", broke + 0.01)):
    r = run(scene(0.2, "dry = true\ngravity = [0.0, 0.0, 0.0]", PAIR + LINK.format("1, 2")), "--from", os.path.join(first.folder, name))
    with h5py.File(os.path.join(r.folder, "state.h5")) as f:
        check.true(f"and a run that goes on from {name} when it broke", broke <= f["/wires/broken_at"][0] <= latest, f"{f['/wires/broken_at'][0]} s")

# Window ends carry the rounding of the clock that wrote them: a start at such an instant is in the window after it.
flow = tempfile.mkdtemp(prefix="tsunagi_flow_")
write_flow(flow, lambda t, X, Z: (0.1, 0.0, 0.0, 0.0, 1.0), [-1.0, 1.0], [-1.0, 1.0], 0.0, 2.4, 1.2, 0.1)
with h5py.File(os.path.join(flow, "window_000000.h5"), "r+") as f:
    f.attrs["t_end"] = np.nextafter(1.2, 2)
still = "gravity = [0.0, 0.0, 0.0]"
halfway = run(scene(1.2, still, block("sphere", (0, 0, 0)), window=1.2), "--flow", flow)
r = run(scene(2.4, still, block("sphere", (0, 0, 0)), window=1.2), "--flow", flow, "--from", os.path.join(halfway.folder, "state.h5"))
check.true("a restart at the rounded end of a window goes on", r.status == 0 and len(r.windows()) == 1 and abs(r.series("/time")[-1] - 2.4) < 1e-9, r.message.strip())

# A flow that is followed and ends early: the run keeps what it has and says so; it is not done.
with open(os.path.join(flow, "run.json"), "w") as f:
    json.dump({"schema": "tsunagi.run/1", "stage": "cmps", "status": "done", "windows": 2}, f)
r = run(scene(3.0, still, block("sphere", (0, 0, 0)), window=1.2), "--flow", flow, "--follow")
check.true("a followed flow that ends before the time asked for", r.status == 1 and "the flow ended at t = 2.4 s" in r.message and len(r.windows()) == 2, r.message.strip())

# A flow with a gap in time, though its windows are numbered without one.
with h5py.File(os.path.join(flow, "window_000001.h5"), "r+") as f:
    f["/flow/time"][...] = f["/flow/time"][:] + 0.1
    f.attrs["t_begin"], f.attrs["t_end"] = 1.3, 2.5
r = run(scene(2.4, still, block("sphere", (0, 0, 0)), window=1.2), "--flow", flow)
check.true("a flow with a gap in time", r.status == 2 and "window_000001.h5: begins at t = 1.3 s" in r.message and "ends at t = 1.2 s" in r.message and len(r.windows()) == 1, r.message.strip())
with h5py.File(os.path.join(flow, "window_000001.h5"), "r+") as f:
    f["/flow/time"][...] = f["/flow/time"][:] - 0.1
    f.attrs["t_begin"], f.attrs["t_end"] = 1.2, 2.4

# Uniform water that accelerates moves with u = a t: a block as heavy as water goes with it (drag is nought, the force is that
# of the water it displaces), and a heavy one follows the closed form of (8), (10) and (12) without viscosity.
# Between two samples of the water, 2 ms apart, the block is up to a 1 ms ahead of it or behind: a drag of 6e-6 m/s2, over 2 s 1.2e-5 m/s.
r = run(scene(2.0, "density_ratio = 1.0\ncurrent_acceleration = [0.5, 0.0, 0.0]", block("sphere", (0, 0, -1)), output=0.1))
check.below("block of the water's density in accelerating water, place after 2 s", abs(r.series("/blocks/position")[-1, 0, 0] - 1.0), 1.2e-5, "m")
check.below("and its speed", abs(r.series("/blocks/velocity")[-1, 0, 0] - 1.0), 1.2e-5, "m/s")
s, cm, cd, a, end = 3.689, 0.5, 0.4, 2.0, 0.4
# w = u - v: dw/dt = a (s - 1) / (s + C_M) - c w^2, c = 3/4 C_D / ((s + C_M) d): w = w_e tanh(t sqrt(c g')).
lag, c = a * (s - 1) / (s + cm), 0.75 * cd / ((s + cm) * d)
speed = a * end - np.sqrt(lag / c) * np.tanh(np.sqrt(lag * c) * end)
errors = []
for step in (1e-4, 5e-5):
    r = run(scene(end, f"gravity = [0.0, 0.0, 0.0]\nviscosity = 0.0\ntime_step = {step}\ncurrent_acceleration = [{a}, 0.0, 0.0]", block("sphere", (0, 0, -1)), output=0.1))
    errors.append(abs(r.series("/blocks/velocity")[-1, 0, 0] / speed - 1))
# Drag follows the speed of half a step before: half a step over the time scale 1 / sqrt(c g') = 0.3 s.
check.below("heavy block in accelerating water, speed against the closed form", errors[0], 0.5e-4 * np.sqrt(c * lag))
check.below("and how far its order in the step is from the first", abs(np.log2(errors[0] / errors[1]) - 1), 0.3)
# A sleeper is pushed by water that accelerates past what its friction holds.
moved = {state: run(scene(6.0, f"current_acceleration = [0.3, 0.0, 0.0]\n{FLOOR.replace('0.0], normal', '-1.0], normal')}",
                          block("cube27", (0, 0, -0.988), f'[effects]\nsleeping = "{state}"'), output=0.1)).series("/blocks/displacement")[-1, 0, 0] for state in ("auto", "off")}
check.true("water that accelerates wakes a sleeper", moved["auto"] > 0.01 and moved["off"] > 0.01, f"{moved['auto']:.3f} m, without sleeping {moved['off']:.3f} m")

# Every kind of block displaces its own volume: a sphere beside armour of another volume sinks as it does alone.
ALONE = block("sphere", (0.2, 0, -0.5))
armour = 'packing = { method = "none" }\nblocks = { shape = "beehive96", rows = 1, columns = 1, origin = [0.0, 0.0], level = -0.5, displaced_volume = 2.5735927018207586e-05 }'
alone = run(scene(0.2, "", ALONE))
r = run(scene(0.2, armour, ALONE))
check.true("a sphere beside armour that displaces a volume of its own", r.status == 0 and np.array_equal(r.series("/blocks/position")[:, 1], alone.series("/blocks/position")[:, 0]), r.message.strip())
first = (r.series("/blocks/velocity")[1, 0, 2] - 0) / 0.01
mass, volume = 96 * s * 1000 * np.pi / 6 * d**3, 2.5735927018207586e-05
expected = -9.81 * (mass - 1000 * volume) / (mass + 0.5 * 1000 * volume)
check.below("and the armour starts to sink as its own volume says", abs(first / expected - 1), 0.01)  # drag takes a little within 0.01 s
r = run(scene(0.2, "", block("sphere", (0, 0, -0.5), "displaced_volume = 9.889e-7")))
check.true("a block by itself may have one too", r.status == 0 and abs(r.series("/blocks/position")[-1, 0, 2] + 0.5) < 1e-4, f"{r.series('/blocks/position')[-1, 0, 2] + 0.5:.2g} m off its place at its own weight of water")

# A block thrown beside [dem.blocks] is held while those settle and starts with its velocity: in the run, and from a stored packing.
thrown = "dry = true\nfriction = 0.5\n" + FLOOR + '\nblocks = { shape = "beehive96", rows = 1, columns = 4, origin = [0.0, 0.1], level = 0.0122 }'
THROWN = block("cube27", (0.5, 0, 0.2), "velocity = [0.0, 1.5, 0.0]\nangular_velocity = [0.0, 0.0, 3.0]")
packed = run(scene(0.1, thrown, THROWN), verb="pack")
with h5py.File(os.path.join(packed.folder, "geometry.h5")) as f:
    check.true("a packing leaves it where the scene places it, and free", packed.status == 0 and np.array_equal(f["/packed/position"][4], [0.5, 0, 0.2]) and f["/blocks/fixed"][4] == 0, packed.message.strip())
for what, r in (("packed anew", run(scene(0.1, thrown, THROWN))), ("from a stored packing", run(scene(0.1, thrown, THROWN), "--from", os.path.join(packed.folder, "state.h5")))):
    good = r.status == 0 and np.array_equal(r.series("/blocks/position")[0, 4], [0.5, 0, 0.2]) and np.array_equal(r.series("/blocks/velocity")[0, 4], [0, 1.5, 0])
    check.true(f"thrown block, {what}: starts where and as the scene says", good, r.message.strip())
    check.below("and flies", abs(r.series("/blocks/position")[-1, 4] - [0.5, 0.15, 0.2 - 0.5 * 9.81 * 0.01]).max(), 1e-12, "m")  # rounding: Verlet is exact in free fall

# A wire that is too long where it is mounted would break before anything moves: refused with all that helps to mend it.
r = run(scene(0.01, "dry = true\ngravity = [0.0, 0.0, 0.0]", PAIR + LINK.format("1, 2") + "rest_length = 0.01\n"))
check.true("a wire that would break at once is refused: link, distance at mounting, breaking length", r.status == 2 and "would break at once" in r.message and "blocks 1 and 2" in r.message and
           "rest_length of 0.01 m" in r.message and "0.0108 m" in r.message and "distance of 0.0" in r.message, r.message.strip())

# Blocks of a scene with a near field, run without its flow: told, on the terminal and in run.json.
NEAR_FIELD = block("sphere", (0, 0, -0.5)) + "[cmps]\nl0 = 0.01\n"
for keys, water in (("", "still water"), ("current = [0.1, 0.0, 0.0]", "uniform water")):
    r = run(scene(0.02, keys, NEAR_FIELD))
    check.true(f"no --flow beside a near field, {water}: told", r.status == 0 and "no --flow" in r.message and water in r.message and water in str(r.record["notes"]), r.message.strip())
r = run(scene(0.02, "dry = true\ngravity = [0.0, 0.0, 0.0]", NEAR_FIELD))
check.true("nothing to tell where blocks are dry", r.status == 0 and "no --flow" not in r.message, r.message.strip())

# What a block weighs is told by check: kilograms, and newtons under water.
r = run(scene(0.02, "", block("sphere", (0, 0, -0.5))), verb="check")
volume = np.pi / 6 * d**3
check.true("check prints mass and submerged weight", f"sphere: {density_ratio * 1000 * volume:.4g} kg, {(density_ratio - 1) * 1000 * volume * gravity:.4g} N under water" in r.message, r.message)

# Orientations of geometry.h5 are those of the windows, for a shape whose axes are not its principal ones too.
base = tempfile.mkdtemp(prefix="tsunagi_dem_")
again = os.path.join(base, "again")
os.makedirs(again)
for folder in (base, again):
    with open(os.path.join(folder, "corner.toml"), "w") as f:
        f.write("[dem.shape]\nspheres = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]\n")
r = run(scene(0.02, "dry = true\ngravity = [0.0, 0.0, 0.0]", block("corner.toml", (0, 0, 1), "orientation = [0.5, 0.5, 0.5, 0.5]")), folder=base)
with h5py.File(os.path.join(r.folder, "geometry.h5")) as f:
    packed = f["/packed/orientation"][0]
check.below("orientation in geometry.h5 against the scene's", np.abs(packed - 0.5).max(), 1e-12)
check.below("orientation in the windows against it", np.abs(np.abs(r.series("/blocks/orientation")[0, 0]) - 0.5).max(), 1e-12)
r = run(scene(0.03, "dry = true\ngravity = [0.0, 0.0, 0.0]", block("corner.toml", (0, 0, 1), "orientation = [0.5, 0.5, 0.5, 0.5]")), "--from", os.path.join(r.folder, "window_000000.h5"), folder=again)
check.true("a restart from that window", r.status == 0, r.message.strip())
check.below("and the turn since packing", np.abs(r.series("/blocks/displacement")[:, 0, 2]).max(), 1e-7, "rad")  # the angle of two equal turns is a root of rounding

# Two blocks at rest with wires at their rest lengths, nothing else: what rounding moves is no fault of the energy balance.
r = run(scene(0.05, "dry = true\ngravity = [0.0, 0.0, 0.0]", block("beehive96", (0, 0, 1)) + block("corner.toml", (0.05, 0.01, 1.003)) + "[wires]\n[[wires.link]]\nblocks = [2, 1]\n"), folder=again)
check.true("blocks that nothing moves run to their end", r.status == 0, r.message.strip())
check.below("and their energy balance", abs(r.invariant("energy_closure")), 1e-6)

# A small sphere that fits between those of a larger shape meets the ones inside: in a lattice of spheres of 2 d, that in the middle of
# a cell, which no sphere of 2 d could touch.
with open(os.path.join(again, "pebble.toml"), "w") as f:
    f.write("[dem.shape]\nspheres = [[0.0, 0.0, 0.0]]\ndiameter = 0.5\n")
places = [[2.0 * i, 2.0 * j, 2.0 * k] for i in (-1, 0, 1) for j in (-1, 0, 1) for k in (-1, 0, 1)] + [[1.0, 1.0, -1.0]]
with open(os.path.join(again, "boulder.toml"), "w") as f:
    f.write(f"[dem.shape]\nspheres = {places}\ndiameter = 2.0\n")
inside = (np.array(places[-1]) - np.mean(places, axis=0)) * d
r = run(scene(0.3, "dry = true", block("boulder.toml", (0, 0, 0), "fixed = true") + block("pebble.toml", (inside[0], inside[1], 0.03))), folder=again)
check.true("a pebble falls down a hole of a boulder", r.status == 0, r.message.strip())
# Pressed in by some thousandths of d.
check.below("and lies on the sphere inside", abs(r.series("/blocks/position")[-1, 1, 2] - (inside[2] + 1.25 * d)) / d, 0.01, "d")

# Two pebbles of a quarter of an element, too soft for their speed, would pass through each other: no overlap of theirs is half an element.
with open(os.path.join(again, "pebble.toml"), "w") as f:
    f.write("[dem.shape]\nspheres = [[0.0, 0.0, 0.0]]\ndiameter = 0.25\nelements = 1\n")
r = run(scene(0.1, "dry = true\nyoung_modulus = 1e5\ntime_step = 1e-5\ngravity = [0.0, 0.0, 0.0]",
              block("pebble.toml", (0, 0, 0), "fixed = true") + block("pebble.toml", (0.0, 0.0, 0.02), "velocity = [0.0, 0.0, -3.0]")), folder=again)
check.true("small spheres that pass through each other stop the run", r.status == 1 and "past the limit of 0.001 m" in r.message, r.message.strip())

# Size and stiffness of everything 64 times as large, times by the root of that: the trial of the step and the packing see the same.
def scaled(size, more=""):
    root = np.sqrt(size)
    return f'''[time]\nend = {0.4 * root}\nwindow = {0.4 * root}
[dem]\nelement_diameter = {0.008 * size}\nyoung_modulus = {1e7 * size}\nviscosity = {1e-6 * size * root}\noutput_interval = {0.1 * root}\nflow_interval = {2e-3 * root}\n{more}
[dem.sleeping]\nrest_time = {0.1 * root}
[dem.blocks]\nshape = "beehive96"\nrows = 2\ncolumns = 2\norigin = [{0.15 * size}, {0.05 * size}]\npitch = [{0.05 * size}, {0.05 * size}]
[dem.mound]\nprofile = [[0.0, {-0.2 * size}], [{0.2 * size}, {-0.2 * size}]]\nroughness = {0.004 * size}\ny = [0.0, {0.15 * size}]\n'''


size = 64.0
small, large = (run(scaled(s, f"time_step = {1e-4 * np.sqrt(s)}")) for s in (1.0, size))
check.true("packing at 64 times the size", large.status == 0, large.message.strip())
place = [r.series("/blocks/position")[0] / s for r, s in ((small, 1.0), (large, size))]
# Hertz contacts with E as the size: overlaps scale too, so all is similar and only rounding grows.
check.below("comes to the same places", np.abs(place[1] - place[0]).max() / d, 1e-3, "d")
limits = [r.figure("time_step_limit") / np.sqrt(s) for r, s in ((small, 1.0), (large, size))]
check.below("and to the same limit of the step, times by the root", abs(limits[1] / limits[0] - 1), 1e-2)
r = run(scaled(size, "time_step = 0.02"))
check.true("a step past the limit of large blocks is refused before anything runs", r.status == 2 and "that the contacts set" in r.message, r.message.strip())
r = run(scaled(size, f"time_step = {1e-4 * np.sqrt(size)}"), verb="check")
check.true("and check tells of contacts and of an error as at the paper's size", "0 contacts" not in r.message and "the contacts set" in r.message and "balance about 0.01 " in r.message, r.message.strip()[-600:])

# What `check --all` prints is the scene: dry, or to be run in a flow, where the key of a current stands printed at nought.
for what, text, arguments in (("dry", scene(0.05, "dry = true\n" + FLOOR, block("cube27", (0, 0, 0.02))), ()),
                              ("in a flow", scene(2.4, still, block("sphere", (0, 0, 0)), window=1.2), ("--flow", flow))):
    printed = run(text, "--all", verb="check").message
    r, again_run = run(text, *arguments), run(printed, *arguments)
    check.true(f"check --all of a scene {what} is that scene", again_run.status == 0 and np.array_equal(again_run.series("/blocks/position"), r.series("/blocks/position")), again_run.message.strip())

# The forecast counts the steps of the run: from where the flow begins.
r = run(scene(2.4, still, block("sphere", (0, 0, 0)), window=1.2), "--flow", flow, verb="check")
begun = run(scene(2.4, still, block("sphere", (0, 0, 0)), window=1.2) + "[dem.restart]\nclock = 1.2\n", "--flow", flow, "--from", os.path.join(halfway.folder, "state.h5"), verb="check")
check.true("steps of a run through all of a flow, and from the middle of it", "at most 24000 of" in r.message and "at most 12000 of" in begun.message, begun.message.strip()[-300:])

# `check` of legal scenes: shorter than its calibration, one whose blocks leave what holds them, and one that packs.
r = run(scene(0.03, "dry = true\n" + FLOOR, block("sphere", (0, 0, 0.5), "velocity = [0.0, 0.0, -9.0]")), verb="check")
check.true("check of a run that is over before anything hits", r.status == 0 and "run time" in r.message, r.message.strip())
r = run(scene(0.1, thrown, THROWN), verb="check")
check.true("the forecast tells of the packing", r.status == 0 and "blocks settle in" in r.message, r.message.strip())
check.end()
