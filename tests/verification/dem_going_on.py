"""Same bytes for one and two threads, with and without an interruption, and for any window length; restarts with changes."""
import glob
import os
import signal
import subprocess
import tempfile
import time

import h5py
import numpy as np

from dem_armour import small_armour
from dem_flow import standing_wave, write_flow
from dem_program import DEM, Checks, perturbed, run

check = Checks()
SCENE = small_armour(2.0, linked_row=3)
flow = tempfile.mkdtemp(prefix="tsunagi_flow_")
wave = standing_wave(0.25, 1.2, 0.3, 1.0)
write_flow(flow, wave, np.linspace(0.5, 1.0, 26), np.linspace(-0.3, 0.2, 26), 0.0, 2.0, 0.25, 0.025)

whole = run(SCENE, "--flow", flow)
check.true("runs", whole.status == 0, whole.message)
moved = whole.series("/blocks/displacement")[-1, :12, 0].max()
check.true("blocks move in this test", moved > 0.001, f"{moved * 1e3:.2f} mm")

two = run(SCENE, "--flow", flow, "--threads", "2")
check.true("two threads write the same bytes as one", two.windows() == whole.windows())

# Killed without warning in the middle, then resumed.
base = tempfile.mkdtemp(prefix="tsunagi_dem_")
with open(os.path.join(base, "scene.toml"), "w") as f:
    f.write(SCENE)
out = os.path.join(base, "out")
process = subprocess.Popen([DEM, "run", os.path.join(base, "scene.toml"), "--out", out, "--flow", flow, "--quiet", *perturbed()])
while not os.path.exists(os.path.join(out, "window_000002.h5")) and process.poll() is None:
    time.sleep(0.002)
process.send_signal(signal.SIGKILL)
process.wait()
before = len([n for n in os.listdir(out) if n.startswith("window_")])
# The same mound and grid under waves of another height: not what the first windows were computed from.
higher = tempfile.mkdtemp(prefix="tsunagi_flow_")
write_flow(higher, standing_wave(0.3, 1.2, 0.3, 1.0), np.linspace(0.5, 1.0, 26), np.linspace(-0.3, 0.2, 26), 0.0, 2.0, 0.25, 0.025, digest="higher-waves")
wrong = run(SCENE, "--flow", higher, "--resume", folder=base)
lines = wrong.message.strip().splitlines()
check.true("resumed in the flow of other waves: refused with one line", wrong.status == 2 and len(lines) == 1 and "state.h5: belongs to another input" in lines[0], wrong.message.strip())
wrong = run(SCENE.replace("psi = 0.3", "psi = 0.2"), "--flow", flow, "--resume", folder=base)
check.true("resumed with another scene: refused, and nothing lost", wrong.status == 2 and "belongs to another scene" in wrong.message and
           len([n for n in os.listdir(out) if n.startswith("window_")]) == before, wrong.message.strip())
resumed = run(SCENE, "--flow", flow, "--resume", folder=base)
check.true("killed run had windows left to do", before < 8, f"{before} of 8")
check.true("killed and resumed: same bytes", resumed.windows() == whole.windows(), resumed.message)

# The exchange window is only how the result is cut up.
long_flow = tempfile.mkdtemp(prefix="tsunagi_flow_")
write_flow(long_flow, wave, np.linspace(0.5, 1.0, 26), np.linspace(-0.3, 0.2, 26), 0.0, 2.0, 2.0, 0.025)
one = run(SCENE, "--flow", long_flow)
# Not to the bit: the two flows' own time axes differ by rounding.
check.below("one window of 2 s and eight of 0.25 s: difference of positions",
            np.abs(one.series("/blocks/position") - whole.series("/blocks/position")).max(), 1e-10, "m")

# A finished run is not run again; another scene in the same folder is.
again = run(SCENE, "--flow", flow, folder=base)
check.true("a finished run is left alone", again.status == 0 and again.windows() == whole.windows())

# Packing stored and used again.
packed = run(SCENE, verb="pack")
check.true("packs", packed.status == 0, packed.message)
from_packing = run(SCENE, "--flow", flow, "--from", os.path.join(packed.folder, "state.h5"))
check.true("a run from the stored packing equals one that packs itself",
           np.array_equal(from_packing.series("/blocks/position"), whole.series("/blocks/position")), from_packing.message)

# A state with nothing changed: to the bit as if the run had not ended, with and without a flow, and with blocks asleep.
def goes_on(what, text, end, *arguments):
    """`text` to `end` in one go, and to half of it and on from the state: windows of the second half, and the last state."""
    full = run(text.replace("END", repr(end)), *arguments)
    first = run(text.replace("END", repr(end / 2)), *arguments)
    second = run(text.replace("END", repr(end)), *arguments, "--from", os.path.join(first.folder, "state.h5"))
    check.true(f"{what}: runs on", second.status == 0, second.message)
    halves = len(glob.glob(os.path.join(first.folder, "window_*.h5")))
    different = []
    for k, path in enumerate(sorted(glob.glob(os.path.join(second.folder, "window_*.h5")))):
        different += differing(path, os.path.join(full.folder, f"window_{halves + k:06d}.h5"))
    different += differing(os.path.join(second.folder, "state.h5"), os.path.join(full.folder, "state.h5"))
    check.true(f"{what}: every dataset of {k + 1} windows and of the state is the same to the bit", not different, f"{different}")
    return full


def differing(path, other):
    names = []
    with h5py.File(path) as a, h5py.File(other) as b:
        a.visititems(lambda name, item: names.append(name) if isinstance(item, h5py.Dataset) and not np.array_equal(item[()], b[name][()], equal_nan=True) else None)
    return names


goes_on("armour in waves", small_armour("END", linked_row=3), 2.0, "--flow", flow)
PLATES = """
[time]
end = END
window = 0.3
[dem]
width = 0.4
sides = "walls"
current = [0.25, 0.0, 0.0]
[dem.blocks]
shape = "beehive24"
rows = 3
columns = 6
origin = [0.3, 0.05]
pitch = [0.055, 0.055]
[dem.mound]
profile = [[0.0, -0.2], [0.4, -0.2]]
roughness = 0.002
[[wires.along]]
rows = [1, 2, 3]
"""
plates = goes_on("18 plates in a current, wired", PLATES, 1.2)
check.true("some of them sleep at the turn", plates.series("/blocks/asleep").max() > 0, f"{plates.series('/blocks/asleep')[::4]}")

# Restart with changes: row 3 put back, links along row 2 added, from a stored instant inside a window.
LAYOUT = "[wires.put_back]\nrows = [3]\n[[wires.along]]\nrows = [2, 3]\n"
layout = os.path.join(base, "layout.toml")
with open(layout, "w") as f:
    f.write(LAYOUT)
window = os.path.join(whole.folder, "window_000003.h5")
changed = run(SCENE + "\n[dem.restart]\ntime = 0.9\n", "--flow", flow, "--wires", layout, "--from", window)
check.true("restart with changes runs", changed.status == 0, changed.message)
times, x = changed.series("/time"), changed.series("/blocks/position")
check.below("restart begins at the stored instant", abs(times[0] - 0.9), 1e-9, "s")
with h5py.File(os.path.join(whole.folder, "geometry.h5")) as f:
    home = f["/packed/position"][:]
at = np.argmin(np.abs(whole.series("/time") - 0.9))
before = np.linalg.norm(whole.series("/blocks/position")[at, 8:12] - home[8:12], axis=1).mean()
after = np.linalg.norm(x[0, 8:12] - home[8:12], axis=1).mean()
check.true("blocks put back stand nearer to their packed places", after < 0.5 * before, f"{1e3 * before:.2f} mm before, {1e3 * after:.2f} after")
unchanged = run(SCENE + "\n[dem.restart]\ntime = 0.9\n", "--flow", flow, "--from", window)
check.true("without changes blocks stay where they were", np.array_equal(unchanged.series("/blocks/position")[0], whole.series("/blocks/position")[at]))
check.true("links were added", changed.figure("wires.count") == 2 * whole.figure("wires.count"))

# Other waves in a restart are legal, and said; in the same waves there is nothing to say.
other = run(SCENE, "--flow", higher, "--from", os.path.join(whole.folder, "window_000003.h5"))
check.true("a restart in other waves runs and says so", other.status == 0 and "another flow" in other.message and "another flow" in str(other.record["notes"]["restart"]["flow"]), other.message.strip())
for start, name in ((whole, "window_000003.h5"), (packed, "state.h5")):
    same = run(SCENE, "--flow", flow, "--from", os.path.join(start.folder, name))
    check.true(f"a start from {name} in the same waves says nothing of it", same.status == 0 and "another flow" not in same.message, same.message.strip())

# Slack: wires longer than the packed distance carry nothing until the slack is used up.
slack = run(SCENE.replace("rows = [3]", "rows = [3]\nslack = 0.05"), "--flow", flow)
check.true("slack wires never pull here", slack.status == 0 and slack.figure("wires.largest_tension") == 0.0, slack.message)

# A run must not replace the one it starts from.
before = whole.windows()
own = subprocess.run([DEM, "run", os.path.join(os.path.dirname(whole.folder), "scene.toml"), "--from", os.path.join(whole.folder, "window_000003.h5"), "--flow", flow, "--out", whole.folder, *perturbed()],
                     capture_output=True, text=True)
check.true("--from inside --out is refused", own.returncode == 2 and "would be replaced" in own.stderr, own.stderr)
check.true("and nothing is lost", whole.windows() == before)
check.end()
