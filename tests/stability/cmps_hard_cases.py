"""Hard cases of cmps through the program: each with an invariant and its bound, each prints its figure.

By default in short form; TSUNAGI_LONG=1 runs the full durations (about an hour).
"""
import os

import numpy as np

from cmps_program import FOLDER, Run, expect, finish
from cmps_waves import wave_number, write_waves

LONG = os.environ.get("TSUNAGI_LONG") == "1"


def tank(end, box, water, spacing, more="", head=""):
    return f"""
title = "tank"
[time]
end = {end}
window = {min(end, 1.0)}
{head}
[cmps]
drive = "none"
tank = {box}
water = {water}
particle_spacing = {spacing}
{more}
"""


def rectangle(x0, x1, z0, z1):
    return f"[[[{x0}, {z0}], [{x1}, {z0}], [{x1}, {z1}], [{x0}, {z1}]]]"


def sound(run, name, is_resolved=True):
    """What every run must hold: done, no particle lost or in the solid, pressure that steps resolve."""
    expect(run.status == 0, f"{name}: exit {run.status} {run.messages.strip()}")
    if run.status != 0:
        return False
    expect(run.invariant("particle_ledger") == 0, f"{name}: particle ledger {run.invariant('particle_ledger'):.0f} (exact)")
    expect(run.invariant("particles_in_solid") == 0, f"{name}: particles in the solid {run.invariant('particles_in_solid'):.0f}")
    if is_resolved:
        change = run.invariant("pressure_change_per_step")
        expect(change < 0.145, f"{name}: pressure changes by {change:.4f} of itself a step (bound 0.145: above it floor pressures of dam breaks are wrong)")
    return True


def still_water():
    duration, depth = 60.0, 0.3
    gauges = '[gauges]\nlevel = 0.2\nfloor = {x = 0.2, z = 0.0, kind = "pressure", interval = 0.01}'
    run = Run("still", tank(duration, [0, 0.4, 0, 0.5], rectangle(0, 0.4, 0, depth), 0.015, more="particles_interval = 0.5", head=gauges))
    if not sound(run, f"still water {duration:g} s"):
        return
    t, level = run.gauge("level")
    _, pressure = run.gauge("floor", "pressure")
    _, position, velocity = run.fluid()
    late = pressure[len(pressure) // 4:] / (1000 * 9.81 * depth)
    drift = (np.mean(level[-50:]) - np.mean(level[:50])) / depth
    centre = position[:, :, 1].mean(axis=1)
    swelling = (np.mean(centre[-20:]) - centre[0]) / (0.5 * depth)
    speed = np.sqrt(np.mean(np.sum(velocity[len(velocity) // 4:] ** 2, axis=2))) / np.sqrt(9.81 * depth)
    expect(abs(swelling) < 0.005, f"still water: volume by the water's centre {swelling:+.4f} in {duration:g} s (bound 0.005)")
    expect(abs(drift) < 0.01, f"still water: level at a gauge {drift:+.4f} (bound 0.01: a fifth of a spacing, which is what a gauge that few particles pass can tell)")
    expect(abs(np.mean(late) - 1) < 0.01, f"still water: floor pressure {np.mean(late):.4f} rho g h (bound 1 %)")
    expect(np.std(late) < 0.005, f"still water: noise {np.std(late):.4f} rho g h (bound 0.005: a tenth of what the standard method leaves)")
    expect(speed < 0.03, f"still water: particles move at {speed:.4f} sqrt(g d) rms (bound 0.03: shifting keeps them going, it must not grow)")
    expect(run.invariant("largest_energy_gain") < 0.005, f"still water: energy gain {run.invariant('largest_energy_gain'):.5f} (bound 0.005)")


def dam_break():
    run = Run("dam", tank(3.0 if LONG else 1.6, [0, 1.0, 0, 0.8], rectangle(0, 0.25, 0, 0.5), 0.0125))
    if sound(run, "dam break, impact and return"):
        gain = run.invariant("largest_energy_gain")
        expect(gain < 0.02, f"dam break: largest energy gain {gain:.4f} (bound 0.02)")


def high_above_the_sea():
    """Levels count from wherever the user's zero is: a tank at 1200 m has walls and a lid as any other."""
    for level in (0, 1200):
        box = [0, 1.0, level, level + 0.6]
        run = Run("high", tank(0.8, box, rectangle(0, 0.3, level, level + 0.3), 0.02))
        if sound(run, f"tank at {level} m"):
            energy = run.invariant("energy_gain")
            expect(-0.3 < energy < 0, f"tank at {level} m: energy {energy:.3f} of rho g h / 2 after the impact (bounds -0.3, 0: lattices of it have -0.20 to -0.22)")


def isolated_drops():
    drops = "[[[0.10, 0.50], [0.13, 0.50], [0.13, 0.53], [0.10, 0.53]], [[0.30, 0.60], [0.31, 0.60], [0.31, 0.70], [0.30, 0.70]]]"
    run = Run("drops", tank(0.25, [0, 0.5, 0, 1.0], drops, 0.01, more="particles_interval = 0.05"))
    if not sound(run, "drop and thin jet"):
        return
    t, position, _ = run.fluid()
    fall = position[:, :, 1].mean(axis=1) - position[0, :, 1].mean()
    error = np.max(np.abs(fall + 0.5 * 9.81 * t * t))
    expect(error < 1e-4, f"drop and thin jet: centre of mass leaves free fall by {error:.1e} m (bound 1e-4)")


def sloshing():
    path = os.path.join(FOLDER, "gravity.csv")
    t = np.arange(0, 20, 0.01)
    with open(path, "w") as file:
        file.write("t, gx, gz\n")
        for time in t:
            file.write(f"{time}, {3.0 * np.sin(2 * np.pi * time / 1.1)}, -9.81\n")
    run = Run("sloshing", tank(10.0 if LONG else 3.0, [0, 0.6, 0, 0.6], rectangle(0, 0.6, 0, 0.2), 0.0133, more=f'gravity_file = "{path}"'))
    if sound(run, "violent sloshing"):
        _, _, velocity = run.fluid()
        fastest = np.max(np.hypot(velocity[..., 0], velocity[..., 1]))
        # the lid returns what hits it: twice the energy of a fall over the tank's height plus the tank's own motion
        expect(fastest < 8.0, f"violent sloshing: fastest particle {fastest:.2f} m/s (bound 8)")


def full_box():
    run = Run("full", tank(1.0, [0, 0.3, 0, 0.3], rectangle(0, 0.3, 0, 0.3), 0.015))
    if sound(run, "closed full box"):
        t, position, velocity = run.fluid()
        speed = np.sqrt(np.mean(velocity[-1] ** 2))
        expect(speed < 0.1, f"closed full box: rms speed {speed:.4f} m/s (bound 0.1)")


def fleeing_wall():
    path = os.path.join(FOLDER, "piston.csv")
    with open(path, "w") as file:
        file.write("t,x\n0,0\n0.1,0\n0.3,-0.4\n2.0,-0.4\n")
    scene = f"""
title = "wall that flees at 2 m/s"
[time]
end = 1.5
window = 0.5
[flume]
bed = [[0.0, -0.3], [4.0, -0.3]]
[cmps]
drive = "piston"
piston_file = "{path}"
offshore = 1.0
onshore = 2.0
particle_spacing = 0.02
"""
    run = Run("fleeing", scene)
    if sound(run, "wall moving away at 2 m/s"):
        drift = run.invariant("mass_drift")
        expect(abs(drift) < 0.05, f"wall moving away: volume {drift:+.4f} (bound 0.05)")


def driven_by_piston():
    """A bed at z = 0, a wall of a tank: the piston holds the water back wherever zero is."""
    path = os.path.join(FOLDER, "stroke.csv")
    t = np.arange(0, 4.0, 0.02)
    with open(path, "w") as file:
        file.write("t,x\n")
        for time in t:
            file.write(f"{time},{0.04 * (1 - np.cos(2 * np.pi * time / 1.6))}\n")
    rest = f"""
drive = "piston"
piston_file = "{path}"
particle_spacing = 0.025
"""
    head = "title = 'piston'\n[time]\nend = 3.0\nwindow = 1.0\n[gauges]\ng = 1.0\n"
    flat = "[flume]\nbed = [[-2.0, {0}], [4.0, {0}]]\n[cmps]\noffshore = 0.0\nonshore = 4.0\nwater = [[[0, {0}], [4, {0}], [4, {1}], [0, {1}]]]\n"
    heights = {}
    for name, text in {"bed at -0.4 m": flat.format(-0.4, 0.0), "bed at 0": flat.format(0.0, 0.4),
                       "tank": "[cmps]\ntank = [0, 4, -0.4, 1]\nwater = [[[0, -0.4], [4, -0.4], [4, 0], [0, 0]]]\n"}.items():
        run = Run("stroke", head + text + rest)
        if sound(run, f"piston, {name}"):
            t, level = run.gauge("g")
            heights[name] = 2 * np.sqrt(2) * np.std(level[t > 0.8])  # of a sine; single readings scatter by half a spacing
    k = wave_number(1.6, 0.4)
    theory = 0.08 * 2 * (np.cosh(2 * k * 0.4) - 1) / (np.sinh(2 * k * 0.4) + 2 * k * 0.4)  # wavemaker theory, Dean & Dalrymple (1984)
    for name, height in heights.items():
        expect(abs(height - theory) < 0.0125, f"piston, {name}: wave {height:.4f} m high, {theory:.4f} m by linear theory (bound half a spacing)")


def wall_on_a_slope():
    """Pistons that come off ground which falls below them: the wall stands on it, and no water gets under."""
    t = np.arange(0, 3.2, 0.02)
    for slope, way in ((0.3, -0.3), (-0.3, 0.3), (0.3, 0.3)):
        path = os.path.join(FOLDER, "slope.csv")
        with open(path, "w") as file:
            file.write("t, x\n" + "".join(f"{at:.2f}, {0.5 * way * (1 - np.cos(np.pi * np.clip(at / 1.5, 0, 1))):.6f}\n" for at in t))
        run = Run("slope", f"""
title = "slope"
[time]
end = 3.0
window = 1.0
[flume]
bed = [[-2.0, {-0.4 - 2 * slope}], [0.7, {-0.4 + 0.7 * slope}], [6.0, {-0.4 + 0.7 * slope}]]
[cmps]
drive = "piston"
piston_file = "{path}"
offshore = 0.0
onshore = 3.0
particle_spacing = 0.02
""")
        name = f"piston by {way:+g} m on a slope of {slope:+g}"
        if sound(run, name):
            drift = run.invariant("largest_mass_drift")
            expect(drift < 0.01, f"{name}: largest drift of volume {drift:.4f} (bound 0.01: a spacing of water is 0.05; 0.16 and 0.22 were lost under a wall that kept its level)")


def acute_corner():
    scene = """
title = "water column on a wedge of 30 degrees"
[time]
end = 1.0
window = 0.5
[flume]
bed = [[0.0, -0.5], [3.0, -0.5]]
[cmps]
drive = "none"
offshore = 0.0
onshore = 2.0
particle_spacing = 0.02
structure = [[[0.8, -0.5], [1.9, 0.135], [1.9, -0.5]], [[1.2, 0.3], [1.5, -0.05], [1.6, 0.3]]]
water = [[[0.0, -0.5], [0.3, -0.5], [0.3, 0.2], [0.0, 0.2]]]
"""
    run = Run("acute", scene)
    if sound(run, "acute corners"):
        gain = run.invariant("largest_energy_gain")
        expect(gain < 0.02, f"acute corners: largest energy gain {gain:.4f} (bound 0.02)")


def sharp_edges():
    """Still water 0.4 m high beside edges of any angle stays still, and the force is that of its pressure."""
    from math import radians, tan
    cases = {}
    for angle in (14, 20, 28, 37, 45, 60, 90):
        half = 0.2 * tan(radians(angle / 2))
        cases[f"tooth of {angle} degrees"] = ([[0.506 - half, 0], [0.506 + half, 0], [0.506, 0.2]], -9810 * (0.4 * 2 * half - 0.2 * half))
    cases["hung wedge of 14 degrees"] = ([[0.3, 0.3], [0.7, 0.25], [0.7, 0.35]], 9810 * 0.5 * 0.4 * 0.1)
    cases["hung diamond of 28 degrees"] = ([[0.3, 0.2], [0.5, 0.15], [0.7, 0.2], [0.5, 0.25]], 9810 * 0.5 * 0.4 * 0.1)
    for name, (polygon, lift) in cases.items():
        run = Run("edge", tank(2.0, [0, 1, 0, 0.8], rectangle(0, 1, 0, 0.4), 0.0125, more=f"structure = [{polygon}]"))
        if not sound(run, name):
            continue
        _, _, velocity = run.fluid()
        speed = np.hypot(velocity[..., 0], velocity[..., 1])
        t, force = run.series("structure/time", "structure/force")
        force = force[t > 0.5, 0]
        rms, fastest, returned = np.sqrt(np.mean(speed ** 2)), np.max(speed), run.figure("particles", "returned_from_solid")
        expect(rms < 0.03, f"{name}: particles move at {rms:.4f} m/s rms (bound 0.03: 0.015 sqrt(g d), what still water has anywhere)")
        expect(fastest < np.sqrt(2 * 9.81 * 0.0125), f"{name}: fastest {fastest:.3f} m/s (bound {np.sqrt(2 * 9.81 * 0.0125):.2f}: a fall over one spacing; what a tip throws out is ten times as fast)")
        expect(returned < 5, f"{name}: {returned:.0f} particles put back out of the solid (bound 5 in 2 s)")
        error = np.abs(np.mean(force, axis=0) - [0, lift]) / abs(lift)
        expect(np.max(error) < 0.03, f"{name}: force {np.mean(force[:, 0]):.1f}, {np.mean(force[:, 1]):.1f} N/m, {lift:.1f} displaced (bound 3 %: a third of a spacing over the body's height)")
        expect(np.max(np.std(force, axis=0)) < 0.03 * abs(lift), f"{name}: force scatters by {np.max(np.std(force, axis=0)):.1f} N/m (bound 3 %)")


def time_steps():
    for courant in (0.5, 0.02):
        run = Run(f"courant{courant}", tank(0.6, [0, 1.0, 0, 0.8], rectangle(0, 0.25, 0, 0.5), 0.02), sets=[f"cmps.courant={courant}"])
        if sound(run, f"courant {courant}"):
            gain = run.invariant("largest_energy_gain")
            expect(gain < 0.05, f"courant {courant}: largest energy gain {gain:.4f} (bound 0.05)")


def almost_nothing():
    run = Run("one", tank(0.2, [0, 0.2, 0, 0.2], rectangle(0.10, 0.11, 0.10, 0.13), 0.01, more=""))
    sound(run, "three particles", is_resolved=False)
    run = Run("drop", tank(0.13, [0, 0.2, 0, 0.2], rectangle(0.10, 0.11, 0.10, 0.11), 0.01, more="particles_interval = 0.05"))
    if sound(run, "one particle"):
        t, position, _ = run.fluid()
        fall = position[:, 0, 1] - position[0, 0, 1] + 0.5 * 9.81 * t ** 2
        expect(position.shape[1] == 1, f"one particle: {position.shape[1]} in the water")
        expect(np.max(np.abs(fall)) < 1e-4, f"one particle: leaves free fall by {np.max(np.abs(fall)):.1e} m (bound 1e-4: single precision and the step)")
    run = Run("empty", tank(0.2, [0, 0.2, 0, 0.2], rectangle(0.10, 0.104, 0.10, 0.13), 0.01))
    expect(run.status in (0, 2), f"empty domain: exit {run.status} {run.messages.strip()}")


def flume(end, boundary, spacing, more=""):
    return f"""
title = "flume"
[time]
end = {end}
window = 1.0
[flume]
bed = [[0.0, -0.4], [40.0, -0.4]]
[cmps]
offshore = 25.0
onshore = 28.0
boundary = "{boundary}"
particle_spacing = {spacing}
{more}
"""


def overflow():
    period, count = 1.65, 100 if LONG else 8
    end = round((count + 3) * period)
    waves = os.path.join(FOLDER, "waves")
    write_waves(waves, 0.06, period, 0.4, 24, 30, end, window=1.0)
    run = Run("overflow", flume(end, "paper", 0.4 / 20, "crest_lowering = 0.05\nrelaxation_length = 1.2"), waves=waves)
    if sound(run, f"overflow of the wall, {count} periods"):
        passed = run.figure("particles", "passed_wall")
        expect(passed > 0, f"overflow: {passed:.0f} particles passed the wall and were put back")
        drift = run.invariant("largest_mass_drift")
        expect(drift < 0.01, f"overflow: largest drift of volume {drift:.4f} (bound 0.01: a fifth of a spacing at the surface, which is what the profile can tell)")


def overturning():
    waves = os.path.join(FOLDER, "high_waves")
    write_waves(waves, 0.20, 1.65, 0.4, 24, 30, 14, window=1.0)
    structure = "structure = [[[26.6, -0.4], [27.0, -0.2], [27.4, -0.2], [27.4, 0.1], [27.7, 0.1], [27.7, -0.4]]]"
    end = 14 if LONG else 8
    run = Run("overturning", flume(end, "relaxation", 0.025, structure), waves=waves)
    if sound(run, "overturning and overtopping"):
        over = run.figure("overtopped_volume")
        expect(over > 0, f"overturning: {over:.4f} m2 over the crest")
        drift = run.invariant("largest_mass_drift")
        expect(drift < 0.02, f"overturning: largest drift of volume {drift:.4f} (bound 0.02)")


def notices():
    run = Run("wrong", tank(2.0, [0, 1.0, 0, 0.8], rectangle(0, 0.25, 0, 0.5), 0.0125),
              sets=["cmps.gradient=antisymmetric_local", "cmps.stabilisation=0", "cmps.shifting=0", "cmps.negative_pressure=true"])
    expect(run.status == 1 and "unstable" in run.messages, f"a run that goes wrong: exit {run.status}, says: {run.messages.strip()[:110]}")
    expect(run.record.get("status") == "failed", "a run that goes wrong: run.json says failed")
    # four particles over the column and steps twice as long: levels look right, the floor's pressure is off by 0.1 rho g H and more
    hasty = Run("hasty", tank(1.2, [0, 1.61, 0, 0.6], rectangle(0, 0.6, 0, 0.3), 0.075, more="particles_interval = 1.0"), sets=["cmps.time_step_factor=2"])
    change = hasty.invariant("pressure_change_per_step")
    expect(hasty.status == 0 and change > 0.145 and "pressure_change_per_step" in hasty.messages, f"steps too long for what they resolve: pressure changes by {change:.3f} of itself a step, says: {hasty.messages.strip()[:110]}")


for case in (still_water, dam_break, high_above_the_sea, isolated_drops, sloshing, full_box, fleeing_wall, driven_by_piston, wall_on_a_slope, acute_corner, sharp_edges, time_steps, almost_nothing,
             overflow, overturning, notices):
    case()
finish()
