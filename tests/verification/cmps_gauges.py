"""What gauges read, against what is known: still water, a hung block (Archimedes), a solid rotation of the water, a weir."""
import numpy as np

from cmps_program import Run, expect, finish

RHO, G = 1000.0, 9.81


def still_water():
    """Tank 0.8 m long, water 0.3 m deep, a block of 0.20 x 0.10 m hung in it and a wall standing at its right end."""
    depth, spacing = 0.3, 0.0125
    run = Run("still_gauges", f"""
title = "gauges in still water"
[time]
end = 4.0
window = 1.0
[gauges]
level = 0.2
over_block = 0.45
shallow = {{x = 0.0, z = 0.25, kind = "pressure"}}
deep = {{x = 0.0, z = 0.05, kind = "pressure"}}
water = {{x = 0.2, z = 0.15, kind = "pressure"}}
under_block = {{x = 0.45, z = 0.10, kind = "pressure"}}
current = {{x = 0.2, z = 0.15, kind = "velocity"}}
[cmps]
drive = "none"
tank = [0.0, 0.8, 0.0, 0.5]
water = [[[0.0, 0.0], [0.7, 0.0], [0.7, {depth}], [0.0, {depth}]]]
structure = [[[0.35, 0.10], [0.55, 0.10], [0.55, 0.20], [0.35, 0.20]], [[0.7, 0.0], [0.8, 0.0], [0.8, 0.5], [0.7, 0.5]]]
particle_spacing = {spacing}
""")
    expect(run.status == 0, f"still water: exit {run.status} {run.messages.strip()}")

    def late(values, times):
        return values[times > 2.0].mean(axis=0)

    for name in ("level", "over_block"):
        t, level = run.gauge(name)
        # a fifth of a spacing: the free surface is found where the kernel is half full
        expect(abs(late(level, t) - depth) < 0.2 * spacing, f"still water: surface at gauge {name} {late(level, t):.4f} m, truth {depth} m (bound {0.2 * spacing:.4f} m)")
    for name, z in (("shallow", 0.25), ("deep", 0.05), ("water", 0.15), ("under_block", 0.10)):
        t, pressure = run.gauge(name, "pressure")
        # a fifth of a spacing of water: the level is known no better
        error = late(pressure, t) / (RHO * G) - (depth - z)
        expect(abs(error) < 0.2 * spacing, f"still water: pressure at gauge {name} (z = {z} m) off by {error * 1000:+.1f} mm of water (bound {200 * spacing:.1f} mm)")
    t, velocity = run.gauge("current", "velocity")
    # the mean of the particles' own motion of a few cm/s over 100 readings
    expect(np.abs(late(velocity, t)).max() < 0.01, f"still water: mean velocity {np.abs(late(velocity, t)).max():.4f} m/s (bound 0.01)")
    t, force = run.series("structure/time", "structure/force")
    block, wall = late(force, t)
    lift = RHO * G * 0.20 * 0.10
    expect(abs(block[1] / lift - 1) < 0.02, f"still water: lift on the block {block[1]:.1f} N/m, weight of the water displaced {lift:.1f} (bound 2 %: the pressure of still water is right to 1 %)")
    expect(abs(block[0]) < 0.02 * lift, f"still water: horizontal force on the block {block[0]:+.1f} N/m, truth 0 (bound 2 % of the lift)")
    thrust = 0.5 * RHO * G * depth**2
    expect(abs(wall[0] / thrust - 1) < 0.02, f"still water: force on the wall {wall[0]:.1f} N/m, rho g h^2 / 2 = {thrust:.1f} (bound 2 %)")


def dry_ground():
    """Gauges where water may come but none has: the ground's level, on the bed and on a step behind the structure."""
    run = Run("dry_gauges", """
[time]
end = 0.1
window = 0.1
[flume]
bed = [[0.0, -0.4], [3.0, -0.4]]
[gauges]
lee = 2.4
step = 2.8
crest = 2.1
current = {x = 2.4, z = -0.2, kind = "velocity"}
load = {x = 2.2, z = -0.2, kind = "pressure"}
[effects]
overtopping_basin = "off"
[cmps]
drive = "none"
offshore = 1.0
particle_spacing = 0.05
structure = [[[2.0, -0.4], [2.0, 0.1], [2.2, 0.1], [2.2, -0.4]], [[2.6, -0.4], [2.6, -0.1], [3.0, -0.1], [3.0, -0.4]]]
""")
    expect(run.status == 0, f"dry ground: exit {run.status} {run.messages.strip()}")
    for name, ground in (("lee", -0.4), ("step", -0.1), ("crest", 0.1)):
        _, level = run.gauge(name)
        expect(np.abs(level - ground).max() < 1e-6, f"dry ground: gauge {name} reads {level[0]:.4f} m, the ground {ground} m (single precision)")
    for name, quantity in (("current", "velocity"), ("load", "pressure")):
        _, value = run.gauge(name, quantity)
        expect(np.all(value == 0), f"dry ground: no {quantity} at gauge {name}")


def weir():
    """A basin drains over a wall. Head over the crest by Poleni's law, q = 2/3 Cd sqrt(2g) H^1.5 with Cd = 0.62, so that
    1/sqrt(H) grows by q/(2 L H^1.5) in time. What passed, what the gauge counted and what is missing in the basin are one."""
    length, crest, head, end, spacing = 1.0, 0.2, 0.1, 2.5, 0.0125
    top = crest + head
    run = Run("weir", f"""
title = "a basin drains over a wall"
[time]
end = {end}
window = 0.5
[flume]
bed = [[-1.0, {-top}], [3.0, {-top}]]
[gauges]
basin1 = 0.1
basin2 = 0.3
basin3 = 0.5
basin4 = 0.7
basin5 = 0.9
passed = {{x = 1.06, kind = "overtopping"}}
[cmps]
drive = "none"
offshore = 0.0
onshore = 2.0
structure = [[[1.0, {-top}], [1.05, {-top}], [1.05, {-head + 0.0001}], [1.0, {-head + 0.0001}]], [[1.5, {-top}], [1.6, {-top}], [1.6, 0.01], [1.5, 0.01]]]
water = [[[0.0, {-top}], [1.0, {-top}], [1.0, 0.0], [0.0, 0.0]]]
particle_spacing = {spacing}
particles_interval = 0.5
""")
    expect(run.status == 0, f"weir: exit {run.status} {run.messages.strip()}")
    t, volume = run.gauge("passed", "overtopped_volume")
    level = np.mean([run.gauge(f"basin{i}")[1] for i in (1, 2, 3, 4, 5)], axis=0)
    position = run.fluid()[1][-1]
    counted = np.sum(position[:, 0] > 1.06) * spacing**2
    # a sample lies between two steps: a particle that passes within the last one counts in part
    expect(abs(volume[-1] - counted) < spacing**2, f"weir: the gauge says {volume[-1]:.5f} m2, {counted:.5f} m2 of particles lie behind the wall (bound one particle)")
    missing = (level[0] - level[-1]) * length
    expect(abs(missing - volume[-1]) < 0.06 * volume[-1] + spacing * length * 0.2, f"weir: {missing:.4f} m2 missing in the basin by its level, {volume[-1]:.4f} m2 counted (bound 6 % and a fifth of a spacing)")
    rate = 2 / 3 * 0.62 * np.sqrt(2 * G)
    law = length * (head - (head**-0.5 + 0.5 * rate * end / length) ** -2)
    # the jet takes half a second to form, the crest is half a head wide
    expect(abs(volume[-1] / law - 1) < 0.15, f"weir: {volume[-1]:.4f} m2 in {end} s, Poleni {law:.4f} (bound 15 %)")
    expect(np.all(np.diff(volume) > -3 * spacing**2), f"weir: what has passed stays passed (largest step back {-np.diff(volume).min() / spacing**2:.0f} particles)")


def gauges_on_faces():
    """A gauge on a face reads the water before it, not the wall; one on a block's top reads the block."""
    spacing = 0.02
    run = Run("faces", f"""
[time]
end = 1.0
window = 1.0
[flume]
bed = [[0, -0.4], [4, -0.4]]
[gauges]
end = 0.0
near_end = 0.005
face = 3.0
before = 2.995
top = 3.1
behind = {{x = 3.3, kind = "overtopping"}}
[cmps]
drive = "none"
offshore = 0
onshore = 4
particle_spacing = {spacing}
structure = [[[3, -0.4], [3, 0.3], [3.2, 0.3], [3.2, -0.4]]]
""")
    expect(run.status == 0, f"gauges on faces: exit {run.status} {run.messages.strip()}")
    for name in ("end", "near_end", "face", "before"):
        level = run.gauge(name)[1].mean()
        # the first column of particles stands half a spacing from the face and rounds the surface off by as much
        expect(abs(level) < 0.6 * spacing, f"gauge on a face: {name} {level:+.4f} m in still water (bound {0.6 * spacing:.3f}: six tenths of a spacing)")
    expect(np.allclose(run.gauge("top")[1], 0.3), "gauge on a dry block: its top")
    volume = run.gauge("behind", "overtopped_volume")[1]
    expect(np.all(volume == 0), "overtopping gauge behind the crest: recorded, nothing has come over")


still_water()
dry_ground()
weir()
gauges_on_faces()
finish()
