"""A dam break gives the same bits with one thread and with two, lists that are rebuilt and a solve by multigrid included."""
import h5py
import numpy as np

from cmps_program import Run, expect, finish

# 16,000 particles in the water: every parallel loop of a step is past the size up to which it runs on one thread
SCENE = """
[time]
end = 0.1
window = 0.05
[cmps]
drive = "none"
tank = [0.0, 4.0, 0.0, 3.0]
water = [[[0.0, 0.0], [1.0, 0.0], [1.0, 2.0], [0.0, 2.0]]]
particle_spacing = 0.011
"""


def contents(run):
    """Every dataset of every window, by name."""
    found = {}
    for path in run.windows():
        with h5py.File(path) as file:
            file.visititems(lambda name, item: found.__setitem__((path[-12:], name), item[()]) if isinstance(item, h5py.Dataset) else None)
    return found


runs = [contents(Run(f"threads{n}", SCENE, options=("--threads", str(n)))) for n in (1, 2)]
expect(runs[0] and runs[0].keys() == runs[1].keys(), f"threads: {len(runs[0])} datasets in both runs")
differing = [name for name, values in runs[0].items() if np.asarray(values).tobytes() != np.asarray(runs[1][name]).tobytes()]
expect(not differing, f"threads: datasets that differ: {differing or 'none'}")
finish()
