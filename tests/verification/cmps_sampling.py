"""What is recorded, how often and in windows of which length changes nothing of what a run finds: same steps, same bits at shared instants."""
import os

import numpy as np

from cmps_program import FOLDER, Run, expect, finish
from cmps_waves import write_waves

SERIES = {"gauges/level/surface_elevation": "gauges/level/time", "gauges/floor/pressure": "gauges/floor/time", "gauges/current/velocity": "gauges/current/time",
          "gauges/passed/overtopped_volume": "gauges/passed/time", "structure/force": "structure/time", "flow/velocity": "flow/time", "flow/acceleration": "flow/time",
          "flow/wet": "flow/time", "particles/position": "particles/time", "particles/velocity": "particles/time", "particles/pressure": "particles/time"}


def scene(window, more_gauges=""):
    return f"""
title = "a column collapses onto a block"
[time]
end = 1.4
window = {window}
[gauges]
level = 0.1
floor = {{x = 0.1, z = 0.0, kind = "pressure", interval = 0.02}}
current = {{x = 0.1, z = 0.1, kind = "velocity"}}
passed = {{x = 0.6, kind = "overtopping"}}
{more_gauges}
[cmps]
drive = "none"
tank = [0.0, 1.0, 0.0, 0.6]
water = [[[0.0, 0.0], [0.25, 0.0], [0.25, 0.4], [0.0, 0.4]]]
structure = [[[0.6, 0.0], [0.7, 0.0], [0.7, 0.08], [0.6, 0.08]]]
particle_spacing = 0.025
[cmps.flow]
x = [0.0, 0.9]
z = [0.0, 0.4]
spacing = 0.05
interval = 0.02
"""


def compare(name, run, reference):
    expect(run.status == 0, f"{name}: exit {run.status} {run.messages.strip()}")
    steps = run.figure("steps")
    expect(steps == reference.figure("steps"), f"{name}: {steps:.0f} steps, as many as before")
    shared, other = 0, []
    for values, times in SERIES.items():
        t0, a = reference.series(times, values)
        t1, b = run.series(times, values)
        _, i, j = np.intersect1d(t0, t1, return_indices=True)
        shared += len(i)
        if len(i) < 4 or a[i].tobytes() != b[j].tobytes():
            other.append(values)
    expect(not other, f"{name}: same bits at {shared} shared instants of {len(SERIES)} series {other or ''}")


reference = Run("one_window", scene(5.0))
expect(reference.status == 0, f"one window: exit {reference.status} {reference.messages.strip()}")
for window in (0.05, 0.07, 0.333, 1.0, 2.0):
    compare(f"windows of {window} s", Run(f"windows{window}", scene(window)), reference)
# half a millisecond: several windows end within one step
often = ["time.end=0.3", "cmps.flow.interval=0.0005"]
compare("windows of 0.5 ms", Run("short_windows", scene(0.0005), sets=often), Run("short", scene(5.0), sets=often))
for intervals in ((0.0173, 0.0071), (0.0199999, 0.1), (0.0005, 0.02)):
    gauges = "".join(f'more{k} = {{x = 0.2, z = 0.0, kind = "pressure", interval = {interval}}}\n' for k, interval in enumerate(intervals))
    compare(f"gauges every {intervals[0]} and {intervals[1]} s", Run(f"gauges{intervals[0]}", scene(1.0, gauges)), reference)


# driven by waves, which come in windows of their own
flume = """
title = "waves at a wall"
[time]
end = 4.0
window = {window}
[flume]
bed = [[0.0, -0.4], [40.0, -0.4]]
[gauges]
level = 26.0
floor = {{x = 26.5, z = -0.4, kind = "pressure"}}
current = {{x = 26.0, z = -0.1, kind = "velocity"}}
passed = {{x = 27.0, kind = "overtopping"}}
[cmps]
offshore = 25.0
onshore = 28.0
start = 1.0
particle_spacing = 0.05
structure = [[[27.0, -0.4], [27.0, 0.02], [27.2, 0.02], [27.2, -0.4]]]
[cmps.flow]
x = [25.5, 27.0]
z = [-0.4, 0.1]
spacing = 0.1
interval = 0.02
"""
for window in (0.25, 1.0):
    write_waves(os.path.join(FOLDER, f"waves{window}"), 0.1, 1.65, 0.4, 24, 30, 4.0, window=window, on_one_clock=True)
driven = Run("driven", flume.format(window=5.0), waves=os.path.join(FOLDER, "waves1.0"))
expect(driven.status == 0, f"waves: exit {driven.status} {driven.messages.strip()}")
for waves, window in ((0.25, 0.05), (1.0, 0.333), (0.25, 1.0)):
    compare(f"waves in windows of {waves} s, near field in windows of {window} s",
            Run(f"driven{waves}_{window}", flume.format(window=window), waves=os.path.join(FOLDER, f"waves{waves}")), driven)

# fluid is sampled by its number, whatever its place in memory at either end of a step
t, position, velocity = reference.fluid()
speed = np.abs(np.diff(position[t < 1.35], axis=0)).max() / 0.1
expect(np.isfinite(position).all() and speed < 6.0, f"pictures: no particle is displaced by more than {speed:.2f} m/s times the time between them (bound 6: twice a fall over the column)")
finish()
