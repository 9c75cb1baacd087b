"""Blocks that turn and float: order of the spin's decay in the flow interval, bobbing that dies out, drag too stiff for the step, springs that turn along."""
import numpy as np

from dem_program import Checks, run

check = Checks()
d = 0.008


def head(end, keys, output=0.01):
    return f'[time]\nend = {end}\nwindow = {end}\n[dem]\nmound = "none"\noutput_interval = {output}\n{keys}\n'


# Spin decays in still water by the drag of 96 spheres (an ODE); against the finest interval, halving it must leave a quarter of the error.
SPIN = head(0.3, "gravity = [0.0, 0.0, 0.0]\ntime_step = 5e-5", 0.3) + '[[dem.block]]\nshape = "beehive96"\nposition = [0.0, 0.0, -0.3]\nangular_velocity = [0.0, 0.0, 60.0]\n'
spin = {interval: run(SPIN, "--set", f"dem.flow_interval={interval}").series("/blocks/angular_velocity")[-1, 0, 2] for interval in (1.6e-2, 8e-3, 4e-3, 5e-4)}
errors = [abs(spin[k] / spin[5e-4] - 1) for k in (1.6e-2, 8e-3, 4e-3)]
orders = np.log2(np.array(errors[:-1]) / errors[1:])
print("spin: errors", errors, "orders", orders)
check.below("spin: order in the flow interval below 2 by", 2 - orders.min(), 0.2)
check.below("spin at the usual interval (2 ms) against the finest", abs(run(SPIN).series("/blocks/angular_velocity")[-1, 0, 2] / spin[5e-4] - 1), 1e-4)
# The drag acts on velocities half a step old: first order in the step, 2e-4 at 5e-5 s.
check.below("spin against the ODE, 13.1018 rad/s", abs(spin[5e-4] / 13.1018 - 1), 5e-4)

# A sphere of half the water's density, 1 mm off its rest: bobbing dies out by drag, slowly (the drag is of second order in a small speed).
r = run(head(20.0, "density_ratio = 0.5") + '[[dem.block]]\nshape = "sphere"\nposition = [0.0, 0.0, 0.001]\n')
t, z = r.series("/time"), r.series("/blocks/position")[:, 0, 2]
swing = [np.ptp(z[(t >= a) & (t <= a + 1)]) for a in (0, 1, 5, 19)]
print("bobbing, swing in the seconds from 0, 1, 5, 19 s on:", swing)
check.true("bobbing dies out", all(a > b for a, b in zip(swing, swing[1:])))
check.below("bobbing: swing in the 20th second over the first", swing[-1] / swing[0], 0.1)
check.below("bobbing: about z = 0, half immersed", abs(z[t >= 19].mean()) / d, 0.01, "d")

# A cube that floats upright is unstable: it tips, but gains no energy. Kinetic and potential energy less the work of buoyancy only fall.
r = run(head(20.0, "density_ratio = 0.5") + '[[dem.block]]\nshape = "cube27"\nposition = [0.0, 0.0, 0.002]\nangular_velocity = [0.1, 0.05, 0.0]\n')
w = np.linalg.norm(r.series("/blocks/angular_velocity")[:, 0], axis=1)
print(f"floating cube: spin at most {w.max():.2f} rad/s, in the last second {w[-100:].max():.2f}")
check.below("floating cube: spin in the last second over the largest", w[-100:].max() / max(w.max(), 1e-3), 0.5)
# All it can fall is 2 mm of its own weight; a kinetic energy above that would come from nowhere.
fall = 27 * 0.5 * 1000 * np.pi / 6 * d**3 * 9.81 * 0.002
check.below("floating cube: kinetic energy over what 2 mm can give", r.series("/energy")[:, 0].max() / fall, 1.0)

# Blocks that plunge in at 1.4 m/s: the surface passes a sphere in 6 ms, and what a sample holds depends on when it is taken. Eight
# heights, 0.7 mm apart, take it at eight places of the passage; place after 0.4 s, root mean square against samples every 0.25 ms.
HEIGHTS = [0.1 + 0.0007 * k for k in range(8)]


def plunge(shape, step, interval):
    return np.array([run(head(0.4, f"time_step = {step}\nflow_interval = {interval}", 0.4) +
                         f'[[dem.block]]\nshape = "{shape}"\nposition = [0.0, 0.0, {z}]\n').series("/blocks/position")[-1, 0, 2] for z in HEIGHTS])


for shape in ("sphere", "cube27"):
    finest = plunge(shape, 5e-5, 2.5e-4)
    errors = [np.sqrt(np.mean((plunge(shape, 5e-5, interval) - finest) ** 2)) for interval in (8e-3, 4e-3, 2e-3, 1e-3)]
    order = np.log2(errors[0] / errors[-1]) / 3
    print(f"plunging {shape}: errors {errors} m, order {order:.2f}")
    if shape == "sphere":
        # Second order but for the kinks of the wet fraction, which a sample meets or misses.
        check.below("plunging sphere: order in the flow interval below 2 by", 2 - order, 0.3)
    check.below(f"plunging {shape}: place at the usual interval (2 ms)", errors[2] / d, 0.01, "d")
    ends = [plunge(shape, step, 2e-3) for step in (2e-4, 1e-4, 5e-5)]
    order = np.log2(np.abs(ends[0] - ends[1]).mean() / np.abs(ends[1] - ends[2]).mean())
    # Drag acts on velocities half a step old.
    check.below(f"plunging {shape}: order in the step, off the first by", abs(order - 1), 0.15)

# Drag stiffer than the step can bear is refused or stops the run by name; what the step bears decays.
for key, value, bears in (("viscosity", 0.02, True), ("viscosity", 1.0, False), ("drag_coefficient", 40.0, True), ("drag_coefficient", 10000.0, False)):
    r = run(SPIN.replace("time_step = 5e-5", "time_step = 1e-4"), "--set", f"dem.{key}={value}")
    if bears:
        check.true(f"{key} = {value}: runs", r.status == 0, r.message)
        check.below(f"{key} = {value}: spin left of 60 rad/s", abs(r.series("/blocks/angular_velocity")[-1, 0, 2]), 1.0)
    else:
        check.true(f"{key} = {value}: stopped by name", r.status in (1, 2) and "past the limit" in r.message and "time_step" in r.message and
                   "that the water's drag sets" in r.message, r.message.strip())

# Two cubes pressed together by wires and sheared by one, turning about their common axis: springs turn along, so nothing slips any more once
# they are settled, and nothing slows the turning.
links = "".join(f"[[wires.link]]\nblocks = [1, 2]\nspheres = [{a}, {b}]\nrest_length = {r0}\nstiffness = 1000.0\n"
                for a, b, r0 in ((1, 3, 0.039488), (19, 21, 0.039488), (7, 9, 0.039488), (25, 27, 0.039488), (22, 6, 0.04257017696736339)))
r = run(head(2.0, "dry = true\ntime_step = 2e-5\ngravity = [0.0, 0.0, 0.0]") + '[effects]\nsleeping = "off"\n' +
        "".join(f'[[dem.block]]\nshape = "cube27"\nposition = [0.0, 0.0, {z}]\nangular_velocity = [0.0, 0.0, 20.0]\n' for z in (1.0, 1.023988)) + "[wires]\npsi = 10.0\n" + links)
energy, spin = r.series("/energy"), r.series("/blocks/angular_velocity")[:, :, 2]
# Before springs turned along, 8.5e-7 J went, a thousandth of the motion.
check.below("cubes turning together: dissipated from 0.05 to 2 s over their kinetic energy", abs(energy[-1, 4] - energy[5, 4]) / energy[0, 0], 1e-9)
check.below("cubes turning together: change of the spin", np.abs(spin[5:] / 20 - 1).max(), 1e-7)  # wires settle in the first 0.05 s
check.end()
