"""The near field over one wave: water coloured by pressure, structure and blocks, at four instants.

usage: near_field.py CHAIN PICTURE
"""
import numpy
import style
from matplotlib.collections import EllipseCollection
from style import plt

import run_folder

PANELS = 4
chain, picture = style.arguments("CHAIN", "PICTURE")
flow = chain / "flow"
record = run_folder.read_run(flow)


def instants():
    """Four instants over one wave period, the second at the highest crest of the last gauge before the structure."""
    names = run_folder.gauge_names(flow)
    period = float(style.scene_value(record, "waves", "period", 1.65))
    sampled, _ = run_folder.read_series(flow, "/particles/time")
    if not names:
        return sampled[:: max(1, len(sampled) // PANELS)][:PANELS]
    time, elevation = run_folder.gauge(flow, names[-1])
    inside = (time > sampled[0] + period / 4) & (time < sampled[-1] - period)
    crest = time[inside][numpy.argmax(elevation[inside])] if inside.any() else time[numpy.argmax(elevation)]
    wanted = crest + period * (numpy.arange(PANELS) - 1) / PANELS
    return sampled[[numpy.abs(sampled - instant).argmin() for instant in wanted]]


def draw_solids(axis):
    for polygon in style.scene_value(record, "cmps", "structure", []):
        axis.fill(*numpy.array(polygon, dtype=float).T, color=style.CONCRETE, ec="0.35", lw=0.8, zorder=3)
    bed = style.scene_value(record, "flume", "bed")
    if bed:
        x, z = numpy.array(bed, dtype=float).T
        axis.fill_between(x, z, z.min() - 1, color=style.SEABED, zorder=2)


def draw_blocks(axis, instant):
    """Outline of the spheres of all blocks, seen from the side."""
    if not run_folder.window_paths(chain / "blocks"):
        return
    time, position, orientation = run_folder.read_series(chain / "blocks", "/blocks/position", "/blocks/orientation",
                                                         begin=instant - 1, end=instant + 1)
    sample = numpy.abs(time - instant).argmin()
    shapes = style.BlockShapes(run_folder.read_geometry(chain / "blocks"))
    centres = [shapes.centres(b, position[sample, b], orientation[sample, b]) for b in range(position.shape[1])]
    diameter = numpy.concatenate([numpy.full(len(c), shapes.diameter(b)) for b, c in enumerate(centres)])
    centres = numpy.concatenate(centres)
    axis.add_collection(EllipseCollection(diameter, diameter, 0 * diameter, units="xy", facecolors="#4a4a4a",
                                          offsets=centres[:, [0, 2]], transOffset=axis.transData, zorder=4))


shown = instants()
figure, axes = plt.subplots(len(shown), 1, figsize=(13, 1.5 * len(shown) + 0.6), sharex=True, sharey=True)
spacing = float(style.scene_value(record, "cmps", "particle_spacing"))
offshore = float(style.scene_value(record, "cmps", "offshore"))
onshore = float(style.scene_value(record, "cmps", "onshore"))
corners = [corner for polygon in style.scene_value(record, "cmps", "structure", []) for corner in polygon]
if corners:
    onshore = min(onshore, max(x for x, _ in corners) + 0.3)
pressures = []
for axis, instant in zip(numpy.atleast_1d(axes), shown):
    _, position, pressure = run_folder.read_series(flow, "/particles/position", "/particles/pressure",
                                                   begin=instant - 1e-6, end=instant + 1e-6)
    water = run_folder.static(flow, "/particles/kind") == 0
    low = position[0, water, 1].min()
    axis.set_xlim(offshore - 0.1, onshore + 0.1)
    axis.set_ylim(low - 0.06, 0.32)
    axis.set_aspect("equal")
    drops = EllipseCollection(1.2 * spacing, 1.2 * spacing, 0, units="xy", offsets=position[0, water], transOffset=axis.transData,
                              array=pressure[0, water] / 1000, cmap="viridis", zorder=1)
    drops.set_clim(0, -9.81 * low)
    axis.add_collection(drops)
    draw_solids(axis)
    draw_blocks(axis, instant)
    axis.axhline(0, color="0.5", lw=0.6, ls=":", zorder=0)
    axis.set_title(f"t = {instant:.2f} s")
    axis.set_ylabel("z, m")
    axis.grid(False)
axes[-1].set_xlabel("x, m (offshore to shore)")
figure.colorbar(drops, ax=axes, label="pressure, kPa", shrink=0.7, pad=0.01)
style.save(figure, picture)
