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


def length_unit(largest):
    """(factor, name) in which a length of `largest` metres reads well."""
    return (1000, "mm") if largest < 0.1 else (100, "cm") if largest < 1 else (1, "m")


def force_unit(largest):
    """(factor, name) in which a force of `largest` newtons reads well."""
    return (1, "N") if largest < 1e3 else (1e-3, "kN") if largest < 1e6 else (1e-6, "MN")


def pressure_unit(largest):
    """(factor, name) in which a pressure of `largest` pascals reads well."""
    return (1, "Pa") if largest < 1e3 else (1e-3, "kPa")


def nothing(why):
    """Ends a plot that has nothing to show; the other pictures are not held up by it."""
    print(f"{pathlib.Path(sys.argv[0]).stem}: {why}; no picture")
    sys.exit(0)


def save(figure, path):
    path.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(path)
    plt.close(figure)
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
        # One diameter for a whole shape, or one a sphere.
        self._diameters = [numpy.broadcast_to(geometry[f"/shapes/{i}/diameter"], len(spheres)) for i, spheres in enumerate(self._spheres)]
        self.is_fixed = geometry["/blocks/fixed"] != 0
        #: m, of the largest shape: the farthest that a sphere's surface is from a block's centre
        self.reach = max(float((numpy.linalg.norm(spheres, axis=1) + 0.5 * diameters).max())
                         for spheres, diameters in zip(self._spheres, self._diameters))

    def centres(self, block, position, orientation):
        """Sphere centres of a block at a pose, (n, 3) m."""
        return position + rotate(orientation, self._spheres[self._shape_of[block]])

    def diameters(self, block):
        """Of the spheres of a block, (n,) m."""
        return self._diameters[self._shape_of[block]]

    def all_spheres(self, positions, orientations):
        """Centres, diameters and block numbers of the spheres of all blocks, each (n, ...)."""
        blocks = range(len(positions))
        centres = [self.centres(b, positions[b], orientations[b]) for b in blocks]
        return (numpy.concatenate(centres), numpy.concatenate([self.diameters(b) for b in blocks]),
                numpy.repeat(blocks, [len(c) for c in centres]))
