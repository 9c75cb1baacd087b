"""A scene with all lengths n times and all times sqrt(n) times as long is the same flow: Froude's law. No length of the program's own may
be in it. With n = 16 every number of the run is a power of two times that of the small one: the same bits, to the last sample. With n = 10
round-off differs, and particles' chaos makes of it what it makes of any other: gauges then agree as two runs of another solver tolerance."""
import os
import sys

import h5py
import numpy as np

from cmps_program import FOLDER, Run, expect, finish
from cmps_waves import write_waves

DEPTH, PERIOD, HEIGHT = 0.4, 1.65, 0.12


def polygon(points, n):
    return [[n * x, n * z] for x, z in points]


def scene(n, end, start, more=""):
    """A flume of mound and caisson with a low crest, n times as large; every default that has a length or a time in it is left to the program."""
    t = np.sqrt(n)
    caisson = polygon([[28.0, -0.4], [28.5, -0.2], [28.8, -0.2], [28.8, 0.06], [29.0, 0.06], [29.0, -0.4]], n)
    return f"""
[time]
end = {end * t!r}
window = {0.5 * t!r}
[flume]
bed = {polygon([[0, -0.4], [60, -0.4]], n)}
[gauges]
near = {{x = {26.5 * n!r}, interval = {0.05 * t!r}}}
front = {{x = {27.9 * n!r}, interval = {0.05 * t!r}}}
wall = {{x = {28.8 * n!r}, z = {-0.1 * n!r}, kind = "pressure", interval = {0.05 * t!r}}}
over = {{x = {29.0 * n!r}, kind = "overtopping", interval = {0.05 * t!r}}}
[cmps]
offshore = {25.0 * n!r}
onshore = {29.5 * n!r}
structure = [{caisson}]
particle_spacing = {0.05 * n!r}
particles_interval = {0.5 * t!r}
{f"start = {start * t!r}" if start is not None else ""}
{more}
"""


def enlarged(source, target, n):
    """Windows of waves, n times as large."""
    os.makedirs(target, exist_ok=True)
    t = np.sqrt(n)
    for name in sorted(os.listdir(source)):
        path = os.path.join(target, name)
        with open(os.path.join(source, name), "rb") as file, open(path, "wb") as copy:
            copy.write(file.read())
        if not name.endswith(".h5"):
            continue
        with h5py.File(path, "r+") as file:
            for key, factor in (("time", t), ("x", n), ("still_water_depth", n), ("surface_elevation", n), ("velocity", t)):
                values, units = file[key][:], file[key].attrs["units"]
                del file[key]
                file.create_dataset(key, data=(values * factor).astype(values.dtype), chunks=values.shape, fletcher32=True).attrs["units"] = units
            for key in ("t_begin", "t_end"):
                file.attrs[key] *= t
    return target


QUANTITIES = (("near", "surface_elevation"), ("front", "surface_elevation"), ("wall", "pressure"), ("over", "overtopped_volume"))
FACTOR = {"surface_elevation": lambda n: n, "pressure": lambda n: n, "overtopped_volume": lambda n: n * n}


def sixteen(waves, large):
    for boundary in ("relaxation", "paper", "both"):
        more = f'boundary = "{boundary}"\n[effects]\nturbulence = "on"'
        small, big = (Run(f"{boundary}_{n}", scene(n, 8.0, 0.0, more), waves=folder) for n, folder in ((1.0, waves), (16.0, large)))
        expect(small.status == 0 and big.status == 0, f"{boundary}: exit {small.status}, {big.status} {small.messages.strip()} {big.messages.strip()}")
        expect(small.figure("steps") == big.figure("steps"), f"{boundary}, n = 16: {small.figure('steps'):.0f} and {big.figure('steps'):.0f} steps")
        for name, quantity in QUANTITIES:
            (_, a), (_, b) = small.gauge(name, quantity), big.gauge(name, quantity)
            a = a * FACTOR[quantity](16.0)
            where = np.argmax(a != b) if len(a) == len(b) and np.any(a != b) else -1
            expect(len(a) == len(b) and np.array_equal(a, b), f"{boundary}, n = 16: gauge {name}, {len(a)} records of the same bits" + (f", not from record {where} on: {a[where]}, {b[where]}" if where >= 0 else ""))
        passed = [run.figure("particles").get("passed_wall", 0) for run in (small, big)]
        over = [run.figure("particles", "overtopped") for run in (small, big)]
        expect(passed[0] == passed[1] and over[0] == over[1] and (boundary == "relaxation" or passed[0] > 0), f"{boundary}, n = 16: {passed} particles passed the moving wall, {over} the crest")


def ten(waves, large):
    """From the arrival of the waves on, as users run it."""
    def run(name, n, folder, sets=()):
        run = Run(name, scene(n, 9.0, None), waves=folder, sets=list(sets))
        expect(run.status == 0, f"{name}: exit {run.status} {run.messages.strip()}")
        return run

    small, other, big = run("small", 1.0, waves), run("other", 1.0, waves, ["cmps.tolerance=5e-4"]), run("big", 10.0, large)
    for name, quantity in QUANTITIES[:3]:
        unit = HEIGHT if quantity == "surface_elevation" else 1000 * 9.81 * HEIGHT
        t = np.arange(3.0, 8.9, 0.05)
        (ta, a), (to, o), (tb, b) = (r.gauge(name, quantity) for r in (small, other, big))
        a, o, b = np.interp(t, ta, a), np.interp(t, to, o), np.interp(t, tb / np.sqrt(10), b / FACTOR[quantity](10.0))
        chance, difference = (np.sqrt(np.mean((a - c) ** 2)) / unit for c in (o, b))
        expect(difference < 2 * chance, f"n = 10: gauge {name} differs by {difference:.3f} H rms; two runs of another solver tolerance by {chance:.3f} (bound: twice that)")


waves = os.path.join(FOLDER, "waves")
write_waves(waves, HEIGHT, PERIOD, DEPTH, 24, 30, 9, window=0.5)
for case, n in ((sixteen, 16.0), (ten, 10.0)):
    if len(sys.argv) < 2 or sys.argv[1] in case.__name__:
        case(waves, enlarged(waves, os.path.join(FOLDER, f"waves_{n:g}"), n))
finish()
