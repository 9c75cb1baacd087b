"""Look of all pictures, and what several of them draw."""
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402  (after the backend is chosen)
import numpy  # noqa: E402

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))

plt.rcParams.update({
    "figure.dpi": 110, "savefig.dpi": 150, "figure.constrained_layout.use": True,
    "font.size": 10, "axes.titlesize": 10, "axes.titlelocation": "left", "axes.grid": True, "grid.alpha": 0.25,
    "axes.spines.top": False, "axes.spines.right": False, "legend.frameon": False, "lines.linewidth": 1.2,
})

WAVES, FLOW, BLOCKS = "#2060a0", "#d0602a", "#3a7d44"
CONCRETE, SEABED = "#b8b4ac", "#8c8678"


def arguments(*names):
    """The command line of a plot: input folder(s), then the picture to write."""
    if len(sys.argv) != len(names) + 1:
        sys.exit(f"usage: {pathlib.Path(sys.argv[0]).name} {' '.join(names)}")
    return [pathlib.Path(word) for word in sys.argv[1:]]


def save(figure, path):
    path.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(path)
    print(path)


def scene_value(record, section, key, otherwise=None):
    """A scene key as run.json lists it."""
    entry = record.get("scene", {}).get("values", {}).get(section, {}).get(key)
    return otherwise if entry is None else entry["value"]


def rotate(orientation, vectors):
    """Turns body-frame vectors (n, 3) by one quaternion (w, x, y, z)."""
    w, axis = orientation[0], orientation[1:]
    cross = numpy.cross(axis, vectors)
    return vectors + 2 * (w * cross + numpy.cross(axis, cross))


class BlockShapes:
    """Spheres of every block, from dem's geometry.h5."""

    def __init__(self, geometry):
        self._shape_of = geometry["/blocks/shape"]
        self._spheres = [geometry[f"/shapes/{i}/spheres"] for i in range(self._shape_of.max() + 1)]
        self._diameter = [float(geometry[f"/shapes/{i}/diameter"][0]) for i in range(self._shape_of.max() + 1)]
        self.is_fixed = geometry["/blocks/fixed"] != 0

    def centres(self, block, position, orientation):
        """Sphere centres of a block at a pose, (n, 3) m."""
        return position + rotate(orientation, self._spheres[self._shape_of[block]])

    def diameter(self, block):
        return self._diameter[self._shape_of[block]]
