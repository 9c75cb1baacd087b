"""The flow that dem is given: calm where the water is still, and the velocities and accelerations of linear theory under a wave."""
import os

import h5py
import numpy as np

from cmps_program import FOLDER, Run, expect, finish
from cmps_waves import wave_number, write_waves

G, DEPTH = 9.81, 0.4


def grid(run):
    with h5py.File(run.windows()[0]) as file:
        x, z = file["flow/x"][:], file["flow/z"][:]
    t, velocity = run.series("flow/time", "flow/velocity")
    return x, z, t, velocity, run.series("flow/time", "flow/acceleration")[1]


def still_water():
    run = Run("still_flow", f"""
[time]
end = 4.0
window = 1.0
[cmps]
drive = "none"
tank = [0.0, 0.6, {-DEPTH}, 0.2]
water = [[[0.0, {-DEPTH}], [0.6, {-DEPTH}], [0.6, 0.0], [0.0, 0.0]]]
particle_spacing = {DEPTH / 24}
[cmps.flow]
x = [0.0, 0.6]
z = [-0.45, 0.0]
spacing = 0.025
interval = 0.02
""")
    expect(run.status == 0, f"still water: exit {run.status} {run.messages.strip()}")
    x, z, t, velocity, acceleration = grid(run)
    # the first second, in which the lattice finds its arrangement, and the ends' columns are left out
    middle, late = slice(4, -4), t > 1.0
    drift = np.abs(velocity[late][:, :, middle, 1].mean(axis=(0, 2))).max() / np.sqrt(G * DEPTH)
    expect(drift < 1e-3, f"still water: mean vertical velocity at most {drift:.5f} sqrt(g d) at any level (bound 0.001: what shifting alone moves is a hundredth)")
    rate = np.abs(acceleration[late][:, :, middle, 1].mean(axis=(0, 2))).max()
    expect(rate < 0.01 * G, f"still water: mean vertical acceleration at most {rate:.4f} m/s2 at any level (bound 1 % of g)")
    beneath = z < -DEPTH + 1e-9
    expect(np.all(velocity[:, beneath][:, :, middle, 1] == 0) and np.all(acceleration[:, beneath][:, :, middle, 1] == 0), "still water: nothing moves across the bed, on it and beneath")
    inside = (z > -DEPTH + 0.03) & (z < -0.04)
    noise = acceleration[late][:, inside][:, :, middle].std()
    expect(noise < 0.15, f"still water: acceleration's noise inside the water {noise:.3f} m/s2 rms (bound 0.15: a fifth of that of waves of a tenth of the depth)")


def wave():
    height, period, x0 = 0.06, 1.65, 26.5  # lower waves stand less clear of the particles' own noise
    waves = os.path.join(FOLDER, "gentle")
    end = 11.6
    write_waves(waves, height, period, DEPTH, 24, 37, end, window=end, arrival=0.5)
    k, omega = wave_number(period, DEPTH), 2 * np.pi / period
    length = 2 * np.pi / k
    gauges = "\n".join(f"g{i} = {x0 + i * length / 8:.4f}" for i in range(8))
    run = Run("wave_flow", f"""
[time]
end = {end}
window = {end}
[flume]
bed = [[0.0, {-DEPTH}], [40.0, {-DEPTH}]]
[gauges]
{gauges}
[cmps]
offshore = 25.0
onshore = 36.0
particle_spacing = 0.025
start = 0.0
[cmps.flow]
x = [{x0}, {x0 + length:.4f}]
z = [-0.45, 0.0]
spacing = 0.05
interval = 0.02
""", waves=waves)
    expect(run.status == 0, f"wave: exit {run.status} {run.messages.strip()}")
    x, z, t, velocity, acceleration = grid(run)
    late = t > end - 2 * period  # the last two periods; what the far end returns is not back yet

    def amplitude(times, values, at):
        """Complex amplitude of cos(k x - omega t), the mean over places."""
        use = times > end - 2 * period
        turned = np.exp(1j * omega * times[use])[:, None] * np.exp(-1j * k * (at - x0))[None, :]
        return 2 * np.mean(values[use] * turned)

    levels = [run.gauge(f"g{i}") for i in range(8)]
    surface = amplitude(levels[0][0], np.stack([v for _, v in levels], axis=1), x0 + np.arange(8) * length / 8)
    worst = {"u": 0, "w": 0, "Du/Dt": 0, "Dw/Dt": 0}
    phase = dict(worst)
    for level in np.flatnonzero((z > -0.31) & (z < -0.09)):
        deep = k * (z[level] + DEPTH)
        u = omega * surface * np.cosh(deep) / np.sinh(k * DEPTH)
        w = -1j * omega * surface * np.sinh(deep) / np.sinh(k * DEPTH)
        for name, field, component, truth in (("u", velocity, 0, u), ("w", velocity, 1, w), ("Du/Dt", acceleration, 0, -1j * omega * u), ("Dw/Dt", acceleration, 1, -1j * omega * w)):
            found = amplitude(t, field[:, level, :-1, component], x[:-1]) / truth
            worst[name] = max(worst[name], abs(abs(found) - 1))
            phase[name] = max(phase[name], abs(np.angle(found)))
    for name in worst:
        # the wave itself is known to the noise of eight gauges of 0.02 H each
        expect(worst[name] < 0.05, f"wave: {name} off by {100 * worst[name]:.1f} % of linear theory at most, z = -0.30 to -0.10 m (bound 5 %)")
        expect(phase[name] < 0.05, f"wave: {name} out of phase by {phase[name]:.3f} rad at most (bound 0.05; the averaging time alone, 0.02 s, would be 0.08)")


still_water()
wave()
finish()
