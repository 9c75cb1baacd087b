"""Each optional effect of cmps: a scene that needs it goes wrong without it, one that does not is the same with it; what it costs.

Shares of time are those of run.json. Particle flow is chaotic: two runs whose steps differ agree at gauges to a tenth of a spacing or
so, not in their bits; runs in which an effect never acts agree bit for bit.
"""
import os
import sys

import numpy as np

from cmps_program import FOLDER, Run, expect, finish
from cmps_waves import write_waves

PERIOD, DEPTH, HEIGHT = 1.65, 0.4, 0.06


def flume(end, onshore, more="", gauges="", effects="", over_depth=8):
    return f"""
title = "flume"
[time]
end = {end}
window = 1.0
[flume]
bed = [[0.0, {-DEPTH}], [60.0, {-DEPTH}]]
[gauges]
{gauges}
[cmps]
offshore = 25.0
onshore = {onshore}
particle_spacing = {DEPTH / over_depth}
{more}
[effects]
{effects}
"""


# Particles that jostle less: where a start is compared with a start, their own motion is what blurs the comparison.
calm = "velocity_filter = 0.02"


def share(run, effect):
    phases = run.record["phases"]
    seconds = {name: value["seconds"] if isinstance(value, dict) else value for name, value in phases.items()}
    return seconds.get(effect, 0.0) / sum(seconds.values())


def rms_difference(a, b, name, begin, end):
    (ta, ea), (tb, eb) = a.gauge(name), b.gauge(name)
    t = np.arange(begin, end, 0.02)
    return np.sqrt(np.mean((np.interp(t, ta, ea) - np.interp(t, tb, eb)) ** 2))


def chance(name, scene, waves, run, gauge, begin, end):
    """How far two runs drift apart whose pressure is solved to another tolerance: nothing else is to be asked of a gauge. The larger
    of two, for one may happen to stay near."""
    others = [Run(f"{name}_{tolerance}", scene, waves=waves, sets=[f"cmps.tolerance={tolerance}"]) for tolerance in (5e-4, 2e-3)]
    return max(rms_difference(run, other, gauge, begin, end) for other in others) / HEIGHT


def start_at_arrival():
    """Waves that reach the near field at t = 8 s: the still water before is not simulated, and nothing is lost by it."""
    waves = os.path.join(FOLDER, "late_waves")
    write_waves(waves, HEIGHT, PERIOD, DEPTH, 24, 35, 16, window=1.0, arrival=8.0)
    scene = flume(16.0, 31.0, calm, "near = 26.5\nfar = 28.5", over_depth=12)
    auto = Run("arrival_auto", scene, waves=waves)
    early = Run("arrival_off", scene, waves=waves, sets=['effects.start_at_arrival="off"'])
    begin, steps = auto.figure("start_time"), (auto.figure("steps"), early.figure("steps"))
    expect(begin > 6.0 and early.figure("start_time") == 0.0, f"start_at_arrival: the near field starts at {begin:g} s, without it at 0")
    expect(steps[0] < 0.65 * steps[1], f"start_at_arrival: {steps[0]:.0f} steps instead of {steps[1]:.0f}")
    for name in ("near", "far"):
        by_chance = chance(f"arrival_{name}", scene, waves, auto, name, 12.0, 16.0)
        difference = rms_difference(auto, early, name, 12.0, 16.0) / HEIGHT
        expect(difference < 1.5 * by_chance, f"start_at_arrival: gauge {name} differs by {difference:.3f} H rms from a run that began in still water at t = 0; by chance {by_chance:.3f} (bound: 1.5 times that)")
        height = np.ptp(auto.gauge(name)[1][-200:]) / np.ptp(early.gauge(name)[1][-200:])
        expect(abs(height - 1) < 0.25, f"start_at_arrival: gauge {name}, range {height:.3f} of that run's (bound 25 %: half a spacing)")
    given = Run("arrival_given", scene, waves=waves, sets=["cmps.start=6.0"])
    expect(given.figure("start_time") == 6.0 and not given.record["effects"]["start_at_arrival"]["on"], "start_at_arrival: off where cmps.start gives a time")


def start_in_waves():
    """cmps.start amid the waves, from the surface and velocities of the windows, against a run that has been there all along."""
    waves = os.path.join(FOLDER, "long_waves")
    write_waves(waves, HEIGHT, PERIOD, DEPTH, 24, 36, 11, window=1.0, arrival=0.5)
    scene = flume(10.5, 35.0, calm, "near = 27.0\nfar = 29.0", over_depth=20)
    whole = Run("whole", scene, waves=waves)
    late = Run("late", scene, waves=waves, sets=["cmps.start=6.0"])
    expect(late.status == 0, f"start in waves: exit {late.status} {late.messages.strip()}")
    def harmonic(run, name):
        t, eta = run.gauge(name)
        use = (t >= 7.0) & (t < 7.0 + 2 * PERIOD)  # before the wall at 35 m answers: front there at 7.3 s, back at 29 m at 11.5 s
        omega = 2 * np.pi / PERIOD
        a, b, _ = np.linalg.lstsq(np.c_[np.cos(omega * t[use]), np.sin(omega * t[use]), np.ones(use.sum())], eta[use], rcond=None)[0]
        return a + 1j * b

    for name in ("near", "far"):
        ratio = harmonic(late, name) / harmonic(whole, name)
        difference = rms_difference(whole, late, name, 7.0, 10.3) / HEIGHT
        # the windows' waves stand a few per cent higher than those the wall makes
        expect(abs(abs(ratio) - 1) < 0.10, f"start in waves: gauge {name}, {abs(ratio):.3f} of the height of the run that came from still water (bound 10 %); rms difference {difference:.3f} H")
        expect(abs(np.angle(ratio)) < 0.2, f"start in waves: gauge {name}, {np.angle(ratio):+.3f} rad apart (bound 0.2: a thirtieth of a period)")


def open_boundaries():
    """Regular waves against a wall, in a flume where what comes back meets the next wave in phase: antinode range over H."""
    end = 30.0
    waves = os.path.join(FOLDER, "against_wall")
    write_waves(waves, HEIGHT, PERIOD, DEPTH, 24, 30, end, window=1.0)
    onshore = 25.0 + 4.57
    antinode = onshore - 0.5 * 2.95
    gauges = f"antinode = {antinode}"

    def antinode_range(name, boundary, effects):
        run = Run(name, flume(end, onshore, f'boundary = "{boundary}"\ncrest_lowering = 0.075', gauges, effects), waves=waves)
        expect(run.status == 0, f"{name}: exit {run.status} {run.messages.strip()}")
        t, eta = run.gauge("antinode")
        ranges = [np.ptp(eta[(t > end - (k + 1) * PERIOD) & (t <= end - k * PERIOD)]) for k in range(4)]
        return np.mean(ranges) / HEIGHT, run

    closed, _ = antinode_range("piston alone", "relaxation", 'relaxation_zone = "off"\nabsorption = "off"')
    opened, run = antinode_range("relaxation", "relaxation", "")
    paper, over = antinode_range("paper", "paper", "")
    taken, _ = antinode_range("absorption", "relaxation", 'relaxation_zone = "off"')
    expect(closed > 1.5 * opened, f"relaxation_zone: antinode {opened:.2f} H with it, {closed:.2f} H without zone and absorption (a piston alone)")
    expect(opened < 2.3, f"relaxation_zone: antinode {opened:.2f} H, 2.0 when all that comes back leaves (bound 2.3)")
    expect(taken < 2.5, f"absorption alone: antinode {taken:.2f} H (bound 2.5)")
    expect(closed > 1.5 * taken, f"absorption: antinode {taken:.2f} H with it, {closed:.2f} H without (a piston alone)")
    expect(closed > 1.2 * paper, f"wall_overflow: antinode {paper:.2f} H with it, {closed:.2f} H without")
    print(f"      share of time: relaxation_zone {share(run, 'relaxation_zone'):.4f}, absorption {share(run, 'absorption'):.4f}, wall_overflow {share(over, 'wall_overflow'):.4f}")


def nothing_to_do():
    """Waves that are there from the start and whose reflection is not back yet: the start and the boundaries' effects change nothing."""
    waves = os.path.join(FOLDER, "there_already")
    write_waves(waves, HEIGHT, PERIOD, DEPTH, 24, 36, 6, window=1.0, arrival=-1.0)
    for boundary, effects in (("relaxation", ("start_at_arrival", "relaxation_zone", "absorption")), ("paper", ("wall_overflow",))):
        scene = flume(6.0, 35.0, f'boundary = "{boundary}"\ncrest_lowering = 0.075', "near = 27.0\nfar = 29.0", over_depth=12)
        auto = Run(f"idle_{boundary}", scene, waves=waves)
        by_chance = {gauge: chance(f"idle_{boundary}_other", scene, waves, auto, gauge, 2.0, 6.0) for gauge in ("near", "far")}
        for effect in effects:
            expect(auto.record["effects"][effect]["on"], f"{effect}: on by itself")
            off = Run(f"idle_{effect}", scene, waves=waves, sets=[f'effects.{effect}="off"'])
            expect(effect not in off.record["phases"], f"{effect}: off, it is not in the step at all")
            for gauge in ("near", "far"):
                difference = rms_difference(auto, off, gauge, 2.0, 6.0) / HEIGHT
                if effect == "start_at_arrival":  # the waves are there at t = 0: both start then
                    expect(difference == 0, f"{effect}: gauge {gauge}, the same bits with and without")
                else:
                    expect(difference < 2 * by_chance[gauge], f"{effect}: gauge {gauge}, with and without differ by {difference:.3f} H rms, by chance {by_chance[gauge]:.3f} (bound: twice that)")


def viscosity():
    """A column of 0.2 m^2/s (a thick oil) collapses more slowly than water; water's own viscosity does nothing that a particle sees."""
    def front(name, nu, wish):
        run = Run(name, f"""
title = "column"
[time]
end = 0.35
window = 0.35
[cmps]
drive = "none"
tank = [0.0, 1.2, 0.0, 0.5]
water = [[[0.0, 0.0], [0.2, 0.0], [0.2, 0.3], [0.0, 0.3]]]
particle_spacing = 0.0125
viscosity = {nu}
[effects]
viscosity = "{wish}"
""")
        expect(run.status == 0, f"{name}: exit {run.status} {run.messages.strip()}")
        return np.quantile(run.fluid()[1][-1, :, 0], 0.98), run  # the very first particles are drops of chance

    thick, run = front("thick", 2e-2, "auto")
    without, _ = front("thick without", 2e-2, "off")
    expect(without - 0.2 > 1.3 * (thick - 0.2), f"viscosity: tongue at {thick:.3f} m, without it at {without:.3f} m: more than 30 % too far from its start at 0.2 m")
    auto, plain = front("water auto", 1e-6, "auto")
    on, full = front("water on", 1e-6, "on")
    expect(abs(auto - on) < 0.0125, f"viscosity: with water's own, tongue at {auto:.3f} m (auto: off) and {on:.3f} m (on): the same within a spacing")
    print(f"      share of time: viscosity {share(full, 'viscosity'):.3f} (on), {share(plain, 'viscosity'):.3f} (auto)")


def mixing_layer():
    """Two streams side by side, +-U/2, no gravity: with the mixing length l = C l0 the layer between them is known exactly.

    du/dt = d/dz (l^2 |du/dz| du/dz) from a jump U has the solution u = U (3 s - s^3) / 4, s = z / d, |s| < 1, d^3 = 9 l^2 U t; its
    momentum thickness, the integral of 1/4 - (u/U)^2, is 9/35 d. Without turbulence particles slide past each other and the jump stays.
    """
    length, half_height, velocity, end, spacing = 2.4, 0.2, 1.0, 0.9, 0.01

    def thickness(name, constant, wish):
        run = Run(name, f"""
title = "mixing layer"
[time]
end = {end}
window = {end}
[cmps]
drive = "none"
tank = [0, {3 * length}, 0, {2 * half_height}]
water = [[[{length}, 0], [{2 * length}, 0], [{2 * length}, {half_height}], [{length}, {half_height}]],
         [[{length}, {half_height}], [{2 * length}, {half_height}], [{2 * length}, {2 * half_height}], [{length}, {2 * half_height}]]]
water_velocity = [[{-velocity / 2}, 0], [{velocity / 2}, 0]]
gravity = [0, 0]
particle_spacing = {spacing}
particles_interval = {end}
smagorinsky = {constant}
[effects]
turbulence = "{wish}"
""")
        expect(run.status == 0, f"{name}: exit {run.status} {run.messages.strip()}")
        _, position, moving = run.fluid()
        middle = np.abs(position[-1, :, 0] - 1.5 * length) < 0.2 * length  # the streams' ends have not come here
        edges = np.linspace(0, 2 * half_height, round(2 * half_height / spacing) + 1)
        z, u = position[-1, middle, 1], moving[-1, middle, 0] / velocity
        mean = np.histogram(z, edges, weights=u)[0] / np.maximum(np.histogram(z, edges)[0], 1)
        return np.sum(0.25 - mean**2) * spacing

    for constant in (0.15, 1.0):  # the default; a layer of many particles
        theory = 9 / 35 * (9 * (constant * spacing) ** 2 * velocity * end) ** (1 / 3)
        layer = thickness(f"layer_{constant}", constant, "on")
        # rows of particles a spacing apart, and a layer of 0.7 (default) or 2.4 spacings
        expect(abs(layer / theory - 1) < 0.1, f"turbulence: mixing layer of C = {constant}, momentum thickness {layer / spacing:.3f} l0, theory {theory / spacing:.3f} l0 (bound 10 %)")
        if constant == 0.15:
            without = thickness("layer_without", constant, "off")
            expect(without < 0.3 * layer, f"turbulence: without it {without / spacing:.3f} l0, less than a third (bound 0.3)")


def turbulence_and_basin():
    """Mild waves at a high structure: no breaking, nothing over the crest; both effects off by themselves, and the same when on."""
    waves = os.path.join(FOLDER, "mild")
    write_waves(waves, HEIGHT, PERIOD, DEPTH, 24, 30, 9, window=1.0)
    structure = "structure = [[[28.0, -0.4], [28.0, 0.35], [28.2, 0.35], [28.2, -0.4]]]"
    scene = flume(9.0, 29.0, structure, "front = 27.5", over_depth=12)
    auto = Run("mild_auto", scene, waves=waves)
    basin = Run("mild_basin", scene, waves=waves, sets=['effects.overtopping_basin="on"'])
    mixed = Run("mild_turbulence", scene, waves=waves, sets=['effects.turbulence="on"'])
    same = all(np.array_equal(a, b) for a, b in zip(auto.gauge("front"), basin.gauge("front")))
    expect(same, "overtopping_basin: a wall that nothing passes: the same bits with auto (on, the crest can be reached) as with on" if same else "overtopping_basin: auto and on differ")
    by_chance = chance("mild_other", scene, waves, auto, "front", 6.0, 9.0)
    difference = rms_difference(auto, mixed, "front", 6.0, 9.0) / HEIGHT
    expect(difference < 2 * by_chance, f"turbulence: waves that do not break: auto (off) and on differ by {difference:.3f} H rms, by chance {by_chance:.3f} (bound: twice that)")
    print(f"      share of time: overtopping_basin {share(basin, 'overtopping_basin'):.4f}, turbulence {share(mixed, 'turbulence'):.3f}")


def overtopping():
    """High waves over a low crest, basin behind: without the effect what went over is simulated on, and shoots into the end wall."""
    waves = os.path.join(FOLDER, "high")
    write_waves(waves, 0.14, PERIOD, DEPTH, 24, 30, 10, window=1.0)
    structure = "structure = [[[27.5, -0.4], [27.5, 0.04], [27.7, 0.04], [27.7, -0.4]]]"
    gauges = 'over = {x = 27.7, kind = "overtopping"}'
    scene = flume(10.0, 29.0, structure, gauges, over_depth=12)
    on = Run("over_on", scene, waves=waves)
    t, volume = on.gauge("over", "overtopped_volume")
    ledger = on.figure("overtopped_volume")
    expect(ledger > 0.005 and abs(volume[-1] - ledger) < 1e-6, f"overtopping_basin: gauge {volume[-1]:.4f} m2, ledger {ledger:.4f} m2 over the crest (same)")
    expect(on.invariant("particle_ledger") == 0, "overtopping_basin: particle ledger exact")
    lost = on.figure("particles", "overtopped") * (DEPTH / 12) ** 2
    expect(abs(lost - ledger) < 1e-9, f"overtopping_basin: {on.figure('particles', 'overtopped'):.0f} particles taken out, l0^2 each")
    off = Run("over_off", scene, waves=waves, sets=['effects.overtopping_basin="off"'])
    _, kept = off.gauge("over", "overtopped_volume")
    expect(off.figure("particles", "overtopped") == 0 and kept.max() > 0, f"overtopping_basin: without it the water stays in the run, {kept[-1]:.4f} m2 behind the crest at the end")
    # a trough behind the crest that fills: what went over flows back unless it is taken out
    narrow = flume(10.0, 27.751, structure, gauges, over_depth=12)
    with_basin, without = (Run(f"trough_{wish}", narrow, waves=waves, sets=[f'effects.overtopping_basin="{wish}"']).gauge("over", "overtopped_volume")[1][-1]
                           for wish in ("on", "off"))
    expect(abs(with_basin - ledger) < 0.15 * ledger, f"overtopping_basin: with a trough of 0.05 m behind the crest {with_basin:.4f} m2, as with 1.3 m")
    expect(without < 0.85 * with_basin, f"overtopping_basin: without it the trough fills and gives back, {without:.4f} m2: more than 15 % too little")
    print(f"      particles at the end: {on.figure('particles', 'fluid'):.0f} with it, {off.figure('particles', 'fluid'):.0f} without")


for case in (start_at_arrival, start_in_waves, open_boundaries, nothing_to_do, viscosity, mixing_layer, turbulence_and_basin, overtopping):
    if len(sys.argv) < 2 or sys.argv[1] in case.__name__:
        case()
finish()
