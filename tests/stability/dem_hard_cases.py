"""Hard cases of the block stage, through the program. Each prints its figure and holds it against a stated bound."""
import numpy as np

from dem_flow import write_flow
from dem_program import Checks, run

check = Checks()
d = 0.008
HEAD = """
[time]
end = {end}
window = {window}
[dem]
output_interval = {output}
{keys}
planes = [{{ point = [0.0, 0.0, 0.0], normal = [0.0, 0.0, 1.0] }}]
{rest}
"""


def scene(end=1.0, window=None, keys="", rest="", output=0.05):
    return HEAD.format(end=end, window=window or end, keys=keys, rest=rest, output=output)


def block(x, y, z, shape="beehive96", more=""):
    return f'[[dem.block]]\nshape = "{shape}"\nposition = [{x}, {y}, {z}]\n{more}\n'


def stack(count, gap=0.0):
    return "".join(block(0, 0, 0.012 + k * (0.024 + gap)) for k in range(count))


# Stack at rest for 60 s, without the help of sleeping: creep of the resting spheres.
for name, effects in (("without sleeping", '[effects]\nsleeping = "off"'), ("with sleeping", "")):
    r = run(scene(end=61.0, window=61.0, keys="dry = true", output=1.0, rest=stack(4) + effects))
    x = r.series("/blocks/position")
    check.true(f"stack {name} runs", r.status == 0, r.message)
    check.below(f"creep of a stack of 4 over 60 s, {name}", np.abs(x[-1] - x[1]).max() / d, 1e-3, "d")

# A block slides into one that sleeps: the same motion, to the last digits, as with nobody asleep. Contacts last milliseconds.
def hit(speed, accuracy, sleeping, friction=0.01):
    begin = -(0.05 + 0.4 * speed)  # time to fall asleep
    head = f'accuracy = "{accuracy}"\n'
    return run(head + scene(end=0.7, window=0.1, keys=f"dry = true\nfriction = {friction}", output=0.02,
                            rest=block(0, 0, 0.0119995) + block(begin, 0, 0.014, more=f"velocity = [{speed}, 0.0, 0.0]") + f'[dem.packing]\nmethod = "none"\n[effects]\nsleeping = "{sleeping}"'))


for accuracy in ("draft", "standard"):
    for speed in (0.2, 1.0):
        on, off = hit(speed, accuracy, "on"), hit(speed, accuracy, "off")
        check.true(f"{accuracy}: a sleeper is hit at {speed} m/s: both run", on.status == 0 and off.status == 0, on.message + off.message)
        check.true(f"{accuracy}: it slept before", on.series("/blocks/asleep").max() >= 1)
        check.below(f"{accuracy}, {speed} m/s: velocities after the hit, against nobody asleep", np.abs(on.series("/blocks/velocity")[-1] - off.series("/blocks/velocity")[-1]).max() / speed, 1e-6)
        smooth = hit(speed, accuracy, "on", friction=0.0)
        check.below(f"{accuracy}, {speed} m/s, no friction: momentum lost", abs(smooth.series("/blocks/velocity")[-1][:, 0].sum() / speed - 1), 1e-6)


# Wires jerk at a sleeper: it comes along, and as many break.
def jerk(speed, psi, sleeping):
    wires = f"[wires]\npsi = {psi}\n[[wires.link]]\nblocks = [1, 2]\nslack = 0.4\n"
    return run(scene(end=0.6, window=0.1, keys="dry = true\nfriction = 0.1", output=0.02,
                     rest=block(0, 0, 0.0119995) + block(0.06, 0, 0.0119995, more=f"velocity = [{speed}, 0.0, 0.0]") + wires + f'[dem.packing]\nmethod = "none"\n[effects]\nsleeping = "{sleeping}"'))


for speed, psi in ((3.0, 0.3), (1.5, 0.1)):
    on, off = jerk(speed, psi, "on"), jerk(speed, psi, "off")
    check.true(f"wires jerk at {speed} m/s: both run", on.status == 0 and off.status == 0, on.message + off.message)
    check.true(f"{speed} m/s: as many wires break", (on.series("/wires/intact")[-1] == off.series("/wires/intact")[-1]).all())
    way = [r.series("/blocks/position")[-1][0, 0] for r in (on, off)]
    check.below(f"{speed} m/s: the sleeper's way ({1e3 * way[0]:.1f} mm) against nobody asleep ({1e3 * way[1]:.1f} mm)", abs(way[0] / way[1] - 1), 0.05)

# Blocks that start inside each other, as deep as the scene reader allows: pushed apart without an explosion.
r = run(scene(end=1.0, keys="dry = true", rest=block(0, 0, 0.0119) + block(0.0, 0.0, 0.0345)))
v = r.series("/blocks/velocity")
check.true("overlapping start runs", r.status == 0, r.message)
# All the elastic energy at the start turned into motion of the two would be the worst; dashpots take most of it.
e = r.series("/energy")
check.below("overlapping start: kinetic energy over the elastic energy at the start", e[:, 0].max() / e[0, 2], 1.0)

# All wires taut at once: the blocks of a ring are mounted with rest lengths much shorter than their distance.
links = "".join(f"[[wires.link]]\nblocks = [{a}, {b}]\nrest_length = 0.0085\n" for a, b in ((1, 2), (2, 3), (3, 4)))
r = run(scene(end=1.0, keys="dry = true", rest="".join(block(0, 0.05 * k, 0.0121) for k in range(4)) + "[wires]\n" + links))
check.true("all wires taut runs", r.status == 0, r.message)
check.below("all wires taut: error of the energy balance", abs(r.invariant("energy_closure")), 0.02)
t = r.series("/wires/tension")
check.true("all wires taut at the start", bool((t[0] > 0).all()), f"{(t[0] > 0).sum()} of {t.shape[1]}")

# A cascade of breaks: the same with wires that just hold, and the blocks thrown apart; and a chain whose load passes from wire to wire.
r = run(scene(end=1.0, keys="dry = true", rest="".join(block(0, 0.05 * k, 0.0121, more=f"velocity = [0.0, {way}, 0.0]" if way else "") for k, way in enumerate((-3.0, -1.0, 1.0, 3.0))) +
              "[wires]\npsi = 0.2\n" + links))
check.true("cascade runs", r.status == 0, r.message)
broken = r.figure("wires.broken")
check.true("cascade of breaks runs", r.status == 0, r.message)
check.true("cascade: all wires broken for good", broken == r.figure("wires.count"), f"{broken:.0f} of {r.figure('wires.count'):.0f}")
check.below("cascade: error of the energy balance (broken wires dissipate)", abs(r.invariant("energy_closure")), 0.02)

# r0 at its smallest: the linked spheres touch (r0 = d), and r0 = 0.
for r0 in (d, 0.0):
    r = run(scene(end=1.0, keys="dry = true", rest=block(0, 0, 0.0121) + block(0, 0.0485, 0.0121) +
                  f'[wires]\nlaw = "progressive"\npsi = 10.0\n[[wires.link]]\nblocks = [1, 2]\nrest_length = {r0}\n'))
    check.true(f"r0 = {r0 / d:.0f} d runs", r.status == 0, r.message)
    check.below(f"r0 = {r0 / d:.0f} d: error of the energy balance", abs(r.invariant("energy_closure")), 0.02)

# A block thrown at a rough mound at 10 m/s.
mound = '[dem.mound]\nprofile = [[0.0, 0.0], [0.4, 0.0]]\ny = [0.0, 0.4]\nroughness = 0.008\nleast_depth = 0.024\n'
FLOOR = "planes = [{ point = [0.0, 0.0, -0.1], normal = [0.0, 0.0, 1.0] }]\n"  # for where it bounces to
THROWN = block(0.2, 0.2, 0.1, more="velocity = [1.0, 0.0, -10.0]\nangular_velocity = [10.0, 5.0, 0.0]")
# 4.7 J on a corner press a sphere of E = 1e7 Pa deeper than its radius: no step makes sense of that, and the run must say so.
r = run("[time]\nend = 1.0\nwindow = 1.0\n[dem]\ndry = true\n" + FLOOR + mound + THROWN)
check.true("thrown at 10 m/s, E = 1e7: noticed", r.status == 1 and "deep in the fixed spheres" in r.message, r.message.strip())
for modulus in (1e9, 1e10):
    r = run(f"[time]\nend = 1.0\nwindow = 1.0\n[dem]\ndry = true\nyoung_modulus = {modulus}\n" + FLOOR + mound + THROWN)
    check.true(f"thrown at 10 m/s, E = {modulus:.0e}: runs", r.status == 0, r.message)
    check.below(f"thrown at 10 m/s, E = {modulus:.0e}: error of the energy balance", abs(r.invariant("energy_closure")), 0.05)
    e = r.series("/energy")
    check.below(f"thrown at 10 m/s, E = {modulus:.0e}: kinetic energy never above the first but for the fall",
                e[:, 0].max() / e[0, 0], 1.02)

# Zero relative velocity: water that moves with the block; eq. (12) divides by zero if written as it stands.
r = run("[time]\nend = 0.5\nwindow = 0.5\n[dem]\ngravity = [0.0, 0.0, 0.0]\ncurrent = [0.3, 0.0, 0.0]\n" +
        block(0, 0, -1, more="velocity = [0.3, 0.0, 0.0]"))
v = r.series("/blocks/velocity")
check.true("zero relative velocity runs", r.status == 0, r.message)
check.below("zero relative velocity: change of speed", np.abs(v - v[0]).max(), 1e-12, "m/s")

# Time step at the limit and past it: stable, or noticed.
r = run(scene(end=2.0, keys="dry = true", rest=stack(3)))
limit = r.figure("time_step_limit")
for share, stable in ((0.9, True), (4.0, False), (20.0, False)):
    r = run(scene(end=2.0, keys=f"dry = true\ntime_step = {share * limit}", rest=stack(3) + '[effects]\nsleeping = "off"'))
    x, v = (r.series("/blocks/position"), r.series("/blocks/velocity")) if r.status == 0 else (None, None)
    if stable:
        check.true(f"step of {share} x limit ({limit:.2e} s) runs", r.status == 0, r.message)
        check.below(f"step of {share} x limit: speed left after 2 s", np.abs(v[-1]).max(), 1e-3, "m/s")
    else:
        check.true(f"step of {share} x limit: refused or noticed", r.status in (1, 2), f"exit {r.status} {r.message.strip()}")

# One block balanced on one sphere: falls off, does not fall through.
r = run("[time]\nend = 1.0\nwindow = 1.0\n[dem]\ndry = true\nfixed_spheres = [[0.0, 0.0, 0.0]]\n"
        "planes = [{ point = [0.0, 0.0, -0.1], normal = [0.0, 0.0, 1.0] }]\n" + block(0.012, 0.004, 0.0202, shape="cube27") +
        block(0.3, 0, 0.0, shape="sphere"))
z = r.series("/blocks/position")[:, 0, 2]
check.true("block on one sphere runs", r.status == 0, r.message)
check.below("block on one sphere: lowest point under the floor", max(0.0, -0.1 + 0.012 - z.min()) / d, 0.01, "d")

# 500 blocks dropped in a heap.
r = run("[time]\nend = 1.0\nwindow = 1.0\n[dem]\ndry = true\nwidth = 0.3\n"
        "planes = [{ point = [0.0, 0.0, 0.0], normal = [1.0, 0.0, 0.0] }, { point = [0.3, 0.0, 0.0], normal = [-1.0, 0.0, 0.0] }, "
        "{ point = [0.0, 0.0, 0.0], normal = [0.0, 0.0, 1.0] }]\noutput_interval = 0.1\n"
        '[dem.blocks]\nshape = "cube27"\nrows = 10\ncolumns = 10\nlayers = 5\norigin = [0.285, 0.015]\npitch = [0.03, 0.03]\nlevel = 0.06\n'
        '[dem.packing]\nmethod = "none"\n')
x = r.series("/blocks/position")
check.true("500 blocks dropped runs", r.status == 0, r.message)
check.below("500 blocks: deepest overlap", r.invariant("largest_overlap"), 0.1, "d")
check.below("500 blocks: error of the energy balance", abs(r.invariant("energy_closure")), 0.05)
inside = (x[-1, :, :2] > 0).all() and (x[-1, :, :2] < 0.3).all() and (x[-1, :, 2] > 0.011).all()
check.true("500 blocks: all within the walls", bool(inside))

# Stiffness x 100: the chosen step follows.
r = run(scene(end=0.5, keys="dry = true\nyoung_modulus = 1.0e9", rest=block(0, 0, 0.03) + block(0.01, 0, 0.06)))
check.true("stiffness x 100 runs", r.status == 0, r.message)
check.below("stiffness x 100: error of the energy balance", abs(r.invariant("energy_closure")), 0.05)
check.below("stiffness x 100: chosen step over the one at 1e7 Pa", r.figure("time_step") / 1e-4, 0.12)


# Flow with jumps: the water's velocity changes sign from one sample to the next.
def jumps(t, X, Z):
    sign = 1.0 if int(round(t / 0.02)) % 2 else -1.0
    return sign * 1.0, 0.0, sign * 50.0, 0.0, 1.0


import tempfile

flow = tempfile.mkdtemp(prefix="tsunagi_flow_")
write_flow(flow, jumps, np.linspace(-1, 1, 21), np.linspace(-0.5, 0.5, 11), 0.0, 1.0, 0.25, 0.02)
r = run(scene(end=1.0, window=0.25, rest=block(0, 0, 0.0121) + block(0.06, 0, 0.0121)), "--flow", flow)
check.true("flow with jumps runs", r.status == 0, r.message)
check.below("flow with jumps: error of the energy balance", abs(r.invariant("energy_closure")), 0.05)

check.end()
