"""Blocks put back, a calm start, and restarts from windows: what a run that goes on from an earlier one begins with."""
import os
import shutil
import signal
import subprocess
import tempfile
import time

import h5py
import numpy as np

from dem_armour import COLUMNS, ROWS, small_armour
from dem_flow import standing_wave, write_flow
from dem_program import DEM, Checks, perturbed, run

check = Checks()
D = 0.008
SCENE, LATER = small_armour(1.0, linked_row=1), small_armour(2.0, linked_row=1)
LAYOUT = "[wires.put_back]\nrows = [2]\n[[wires.along]]\nrows = [1, 2, 3]\n[[wires.across]]\ncolumns = [1, 2, 3, 4]\nwires = 3\n"
base = tempfile.mkdtemp(prefix="tsunagi_dem_")


def written(name, text):
    path = os.path.join(base, name)
    with open(path, "w") as f:
        f.write(text)
    return path


def turn(q):
    w, x, y, z = np.moveaxis(q, -1, 0)
    return np.stack([np.stack([1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)], -1),
                     np.stack([2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)], -1),
                     np.stack([2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)], -1)], -2)


def centres(position, orientation, spheres):
    """Of all spheres of all blocks; orientation and spheres as the shape's file has them."""
    return position[:, None] + np.einsum("bij,kj->bki", turn(orientation), spheres)


def first_sample(r):
    """Poses, sphere centres, wire lengths, rest lengths and tensions at the first sample of a run."""
    with h5py.File(os.path.join(r.folder, "window_000000.h5")) as f, h5py.File(os.path.join(r.folder, "geometry.h5")) as g:
        position, orientation = f["/blocks/position"][0], f["/blocks/orientation"][0]
        c = centres(position, orientation, g["/shapes/0/spheres"][:])
        ends = g["/wires/ends"][:]
        length = np.linalg.norm(c[ends[:, 0], ends[:, 1]] - c[ends[:, 2], ends[:, 3]], axis=1)
        return position, c, ends, length, g["/wires/rest_length"][:], f["/wires/tension"][0]


def tensions_of_start(r):
    position, c, ends, length, rest, tension = first_sample(r)
    row = lambda block: block // COLUMNS
    fresh = (row(ends[:, 0]) != 0) | (row(ends[:, 2]) != 0)
    return fresh, ends, length, rest, tension


still = run(SCENE)
check.true("a run in still water", still.status == 0, still.message)
with h5py.File(os.path.join(still.folder, "geometry.h5")) as g:
    home, home_orientation = g["/packed/position"][:], g["/packed/orientation"][:]
layout = written("layout.toml", LAYOUT)
row_2 = slice(COLUMNS, 2 * COLUMNS)

# Nothing disturbed: blocks stay where they are, to the bit after a packing, else as still as water leaves them.
packed = run(SCENE, verb="pack")
from_packing = ["--from", os.path.join(packed.folder, "state.h5")]
back = run(SCENE, *from_packing, "--wires", layout)
plain = run(SCENE, *from_packing, "--wires", written("plain.toml", LAYOUT[LAYOUT.index("[[wires.along"):]))
check.true("put back right after packing: the packed pose to the bit", np.array_equal(first_sample(back)[0], home), back.message)
check.true("and the same run as without", np.array_equal(back.series("/blocks/position"), plain.series("/blocks/position")))
undisturbed = run(LATER, "--from", os.path.join(still.folder, "state.h5"), "--wires", layout)
# What blocks creep in a second of still water and in settling once more; a sleeper's rest is 1e-4 d.
check.below("put back after a second of still water: off the packed pose", np.abs(first_sample(undisturbed)[0] - home).max() / D, 1e-4, "d")
check.true("no block was put back there", undisturbed.figure("put_back.blocks") == 0)

# A neighbour in the gap: block 6 (row 2) lies 40 mm up, and was packed 4 mm offshore of where it stood, with 2 mm between rows.
moved = os.path.join(base, "moved")
shutil.copytree(still.folder, moved)
state = os.path.join(moved, "state.h5")
home_as_packed = home.copy()
home[5, 0] -= 0.004
with h5py.File(state, "r+") as f:
    position, packed_position = f["/blocks/position"][:], f["/packed/position"][:]
    position[5, 2] += 0.04
    packed_position[5, 0] -= 0.004
    f["/blocks/position"][...], f["/packed/position"][...] = position, packed_position
    f["/wires/largest_tension"][...] = 99.0
gap = run(LATER, "--from", state, "--wires", layout)
check.true("a restart with a neighbour in the gap runs", gap.status == 0, gap.message)
at, c, *_ = first_sample(gap)
found = np.linalg.norm(at[5] - home[5])
check.true("run.json: the block was put back, and where it stands", 1 <= gap.figure("put_back.blocks") <= 4
           and gap.figure("put_back.largest_distance_settled") >= found >= gap.figure("put_back.mean_distance_settled"), str(gap.record["figures"]["put_back"]))
# 4 mm back it stood free: no shift need be longer. Settling adds some tenths of a millimetre.
check.below("block put back, from its packed place as set down", gap.figure("put_back.largest_distance_placed") * 1e3, 4.0, "mm")
check.true("which was not free", gap.figure("put_back.largest_distance_placed") > 0.5e-3, f"{1e3 * gap.figure('put_back.largest_distance_placed'):.2f} mm")
check.below("and when the run starts", found * 1e3, 4.5, "mm")
check.below("displacement counts from the packed pose", abs(gap.series("/blocks/displacement")[0, 5, 0] - found), 1e-15, "m")
overlap = 0.0
for i in range(ROWS * COLUMNS):
    for j in range(i):
        overlap = max(overlap, D - np.linalg.norm(c[i][:, None] - c[j][None], axis=-1).min())
# Blocks rest on each other with some hundredths of d: 0.025 d bears a block's weight.
check.below("deepest overlap of blocks when the run starts", overlap / D, 0.03, "d")
check.true("settling took time outside the run", gap.figure("restart.settling_time") >= 0.1 and gap.series("/time")[0] == 1.0)
check.below("the run's books begin with it", abs(gap.series("/energy")[0, 4]), 0.0, "J")
check.below("so does the largest tension", gap.figure("wires.largest_tension"), 98.0, "N")
check.below("energy balance of the run", abs(gap.invariant("energy_closure")), 0.02)

# Wires: new ones and those of blocks put back are mounted at rest, to rounding; kept ones keep their rest length, and are slack
# or taut by no more than their two blocks moved while all settled.
fresh, ends, length, rest, tension = tensions_of_start(gap)
check.below("new wires: length less rest length", np.abs(length - rest)[fresh].max(), 1e-15, "m")
check.below("new wires: tension", tension[fresh].max(), 1e-9, "N")
old = {tuple(e): (l, r) for e, l, r in zip(*(first_sample(still)[k] for k in (2, 3, 4)))}
_, c_old, *_ = first_sample(still)
with h5py.File(state) as f, h5py.File(os.path.join(still.folder, "window_000003.h5")) as w:
    before = centres(f["/blocks/position"][:], w["/blocks/orientation"][-1], h5py.File(os.path.join(still.folder, "geometry.h5"))["/shapes/0/spheres"][:])
kept = [k for k in range(len(ends)) if not fresh[k]]
check.true("all wires of row 1 are kept", len(kept) == 3 * 18 and all(old[tuple(ends[k])][1] == rest[k] for k in kept))
worst = 0.0
for k in kept:
    a, i, b, j = ends[k]
    then = np.linalg.norm(before[a, i] - before[b, j])
    went = np.linalg.norm(c[a, i] - before[a, i]) + np.linalg.norm(c[b, j] - before[b, j])
    worst = max(worst, abs(length[k] - then) - went)
check.below("kept wires: change of length beyond what their blocks moved in settling", worst, 1e-15, "m")
check.below("kept wires: slack", (rest - length)[kept].max() / D, 0.3, "d (the breaking stretch)")
# Settled means settled: nothing goes on in the still water that follows.
later = gap.series("/blocks/position")
check.below("motion in the second after", np.linalg.norm(later[-1] - later[0], axis=-1).max() / D, 0.01, "d")

# Same bytes for two threads, and with an interruption at any time: before the first window nothing is on disk but the
# folder, and the settling is done again.
two = run(LATER, "--from", state, "--wires", layout, "--threads", "2")
check.true("two threads write the same bytes", two.windows() == gap.windows() and len(gap.windows()) == 4)


def killed_when(ready):
    folder = tempfile.mkdtemp(prefix="tsunagi_dem_", dir=base)
    with open(os.path.join(folder, "scene.toml"), "w") as f:
        f.write(LATER)
    out = os.path.join(folder, "out")
    process = subprocess.Popen([DEM, "run", os.path.join(folder, "scene.toml"), "--out", out, "--from", state, "--wires", layout, "--quiet", *perturbed()])
    while not ready(out) and process.poll() is None:
        time.sleep(0.001)
    process.send_signal(signal.SIGKILL)
    process.wait()
    left = len([n for n in os.listdir(out) if n.startswith("window_")])
    return left, run(LATER, "--from", state, "--wires", layout, "--resume", folder=folder)


for what, ready in (("while settling", lambda out: os.path.exists(os.path.join(out, "run.json"))),
                    ("after the first window", lambda out: os.path.exists(os.path.join(out, "window_000000.h5")))):
    left, resumed = killed_when(ready)
    check.true(f"killed {what} and resumed: same bytes", resumed.windows() == gap.windows(), f"{left} windows were there {resumed.message}")
    check.true(f"killed {what} and resumed: the same figures",
               all(resumed.figure(name) == gap.figure(name) for name in ("put_back.blocks", "put_back.mean_distance_settled", "restart.settling_time")))

endless = run(LATER + "[dem.packing]\nlongest = 0.06\n", "--from", state, "--wires", layout)
lines = [line for line in endless.message.splitlines() if line]
check.true("settling that does not end: one line, exit 1", endless.status == 1 and len(lines) == 1 and "settling before the run" in lines[0]
           and "still move after 0.06 s" in lines[0] and endless.record["status"] == "failed", endless.message)

# A calm start without putting back: in the middle of waves, all begins at rest.
flow = tempfile.mkdtemp(prefix="tsunagi_flow_")
write_flow(flow, standing_wave(0.25, 1.2, 0.3, 1.0), np.linspace(0.5, 1.0, 26), np.linspace(-0.3, 0.2, 26), 0.0, 2.0, 0.25, 0.025)
wet = run(LATER, "--flow", flow)
window = os.path.join(wet.folder, "window_000003.h5")
calm = run(LATER + "[dem.restart]\ncalm = true\n", "--flow", flow, "--from", window)
check.true("a calm start", calm.status == 0 and calm.figure("restart.settling_time") >= 0.1 and "put_back" not in calm.record["figures"], calm.message)
check.true("begins at rest", not calm.series("/blocks/velocity")[0].any() and wet.series("/blocks/velocity").any())

# All blocks put back after waves: the packing again, but for the springs of its contacts, which are worth some thousandths of d.
everything = run(LATER.replace("end = 2.0", "end = 2.1"), "--from", os.path.join(wet.folder, "state.h5"), "--wires", written("all.toml", "[wires.put_back]\nrows = [1, 2, 3]\n"))
went = np.linalg.norm(wet.series("/blocks/position")[-1] - home_as_packed, axis=-1).max() / D
check.true("waves moved them", everything.status == 0 and went > 0.3, f"{went:.2g} d {everything.message}")
check.below("all blocks put back: off the packing", np.linalg.norm(first_sample(everything)[0] - home_as_packed, axis=-1).max() / D, 0.02, "d")

# From a window: its end has the springs of contacts, instants inside it have not, and the program says so.
end = run(LATER, "--flow", flow, "--from", window)
check.true("from the end of a window: no warning", end.status == 0 and "warning" not in end.message and "restart" not in end.record["notes"], end.message)
position = wet.series("/blocks/position")
times = wet.series("/time")
at_end = np.argmin(np.abs(times - 1.0))


def jump(r, k):
    """Of the first output interval, beside the run it goes on from."""
    return np.linalg.norm(r.series("/blocks/position")[1] - position[k + 1], axis=-1).max() / D


# Rounding of orientations, speeds through their files, and everybody awake: nothing else is new.
check.below("from the end of a window: off the run it goes on from, 0.05 s later", jump(end, at_end), 1e-6, "d")
inside = run(LATER + "[dem.restart]\ntime = 0.9\n", "--flow", flow, "--from", window)
lines = [line for line in inside.message.splitlines() if "warning" in line]  # that the flow is of no scene is told beside it
check.true("from inside a window: one warning line", inside.status == 0 and len(lines) == 1 and "warning" in lines[0] and "t = 0.9 s" in lines[0] and "t = 1 s" in lines[0],
           inside.message)
check.true("and in run.json", "tangential springs" in inside.record["notes"]["restart"]["springs"], str(inside.record["notes"]))
check.true("which is true", jump(inside, np.argmin(np.abs(times - 0.9))) > 1e-4, f"{jump(inside, np.argmin(np.abs(times - 0.9))):.2g} d")

# A finished run whose state is damaged is no start for others: it is noticed and computed again.
with open(os.path.join(wet.folder, "state.h5"), "rb") as f:
    whole = f.read()
for what, content in (("truncated", whole[: len(whole) // 2]), ("emptied", b""), ("with a flipped bit", whole[:20000] + bytes([whole[20000] ^ 16]) + whole[20001:])):
    for more in ([], ["--resume"]):
        with open(os.path.join(wet.folder, "state.h5"), "wb") as f:
            f.write(content)
        started = run(LATER, "--flow", flow, "--from", os.path.join(wet.folder, "state.h5"))
        lines = [line for line in started.message.splitlines() if line]
        check.true(f"--from a state {what}: one line, exit 2", started.status == 2 and len(lines) == 1 and "state.h5" in lines[0], started.message.strip())
        before = wet.windows()
        again = run(LATER, "--flow", flow, *more, folder=os.path.dirname(wet.folder))
        lines = [line for line in again.message.splitlines() if "damaged" in line]
        check.true(f"a finished run with a state {what} is computed again{' with --resume' if more else ''}",
                   again.status == 0 and len(lines) == 1 and "state.h5" in lines[0] and again.windows() == before, again.message.strip())
        with open(os.path.join(wet.folder, "state.h5"), "rb") as f:
            check.true("and its state is whole again", f.read() == whole)
os.remove(os.path.join(wet.folder, "state.h5"))
again = run(LATER, "--flow", flow, "--resume", folder=os.path.dirname(wet.folder))
check.true("a finished run without its state is computed again", again.status == 0 and "damaged" in again.message and os.path.exists(os.path.join(wet.folder, "state.h5")),
           again.message.strip())
check.end()
