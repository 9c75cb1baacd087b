"""The near field over one wave: water coloured by pressure, structure and blocks, at four instants.

The instants are spread over one wave period about the highest crest at the gauge next to the structure; without waves or
without a gauge over the whole run.

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
if not run_folder.window_paths(flow):
    style.nothing(f"{flow} holds no windows")
record = run_folder.read_run(flow)
structure = [numpy.array(polygon, dtype=float) for polygon in style.scene_value(record, "cmps", "structure") or []]
left, right, low, high = style.scene_value(record, "cmps", "tank") or [None] * 4
tank = [] if left is None else [numpy.array([[left, high], [left, low], [right, low], [right, high]], dtype=float)]
spacing = float(style.scene_value(record, "cmps", "particle_spacing"))
# Of several layouts on one flow the first is drawn.
blocks = next((folder for folder in sorted(chain.glob("blocks*")) if run_folder.window_paths(folder)), None)


def instants():
    """Instants to show: one wave period, its second at the highest crest of the last surface gauge; else the whole run."""
    sampled, = run_folder.read_series(flow, "/particles/time")[1:]
    names = sorted(run_folder.gauge_names(flow), key=run_folder.gauge_places(flow).get)
    period = style.scene_value(record, "waves", "period")
    if not names or not period or sampled[-1] - sampled[0] < 1.5 * period:
        chosen = numpy.linspace(0, len(sampled) - 1, PANELS)
        return sampled[numpy.unique(chosen.round().astype(int))]
    time, elevation = run_folder.gauge(flow, names[-1])
    inside = (time > sampled[0] + period / 4) & (time < sampled[-1] - 3 * period / 4)
    crest = time[inside][numpy.argmax(elevation[inside])]
    wanted = crest + period * (numpy.arange(PANELS) - 1) / PANELS
    return sampled[numpy.unique([numpy.abs(sampled - instant).argmin() for instant in wanted])]


def water_at(instant):
    """Position and pressure of the water's particles."""
    _, position, pressure = run_folder.read_series(flow, "/particles/position", "/particles/pressure",
                                                   begin=instant - 1e-6, end=instant + 1e-6)
    water = run_folder.static(flow, "/particles/kind", instant) == 0
    return position[0, water], pressure[0, water]


def draw_solids(axis, bottom):
    for polygon in structure:
        axis.fill(*polygon.T, color=style.CONCRETE, ec="0.35", lw=0.8, zorder=3)
    bed = style.scene_value(record, "flume", "bed")
    if bed:
        x, z = numpy.array(bed, dtype=float).T
        axis.fill_between(x, z, min(z.min(), bottom) - 1, color=style.SEABED, zorder=2)
    for walls in tank:
        axis.plot(*walls.T, color="0.35", lw=1.5, zorder=3)


def draw_blocks(axis, instant):
    """Spheres of all blocks, seen from the side, at the stored sample nearest to the instant."""
    times, _ = run_folder.read_series(blocks, "/time")
    nearest = times[numpy.abs(times - instant).argmin()]
    _, position, orientation = run_folder.read_series(blocks, "/blocks/position", "/blocks/orientation",
                                                      begin=nearest - 1e-9, end=nearest + 1e-9)
    centres, diameters, _ = style.BlockShapes(run_folder.read_geometry(blocks)).all_spheres(position[0], orientation[0])
    axis.add_collection(EllipseCollection(diameters, diameters, numpy.zeros(len(diameters)), units="xy", facecolors="#4a4a4a",
                                          offsets=centres[:, [0, 2]], transOffset=axis.transData, zorder=4))


shown = instants()
waters = [water_at(instant) for instant in shown]
water = numpy.concatenate([position for position, _ in waters])
if structure:
    # A few drops in the basin behind the structure do not widen the picture.
    behind = water[:, 0] > max(polygon[:, 0].max() for polygon in structure)
    water = water[~behind] if behind.mean() < 0.01 else water
everywhere = numpy.concatenate([water] + structure + tank)
(x_low, z_low), (x_high, z_high) = everywhere.min(axis=0), everywhere.max(axis=0)
highest = numpy.percentile(numpy.concatenate([pressure for _, pressure in waters]), 99.5)
factor, unit = style.pressure_unit(highest)
margin = 0.06 * (z_high - z_low)
x_low, x_high, z_low, z_high = x_low - margin, x_high + margin, z_low - margin, z_high + margin
# One below the other; in two columns where the water is not much longer than high.
columns = 1 if x_high - x_low > 3 * (z_high - z_low) else 2
rows = -(-len(shown) // columns)
height = 11.3 / columns * (z_high - z_low) / (x_high - x_low) + 0.45
figure, axes = plt.subplots(rows, columns, figsize=(13, max(height, 1.2) * rows + 0.5), sharex=True, sharey=True, squeeze=False)
for axis in list(axes.flat)[len(shown):]:
    axis.set_visible(False)
for axis, instant, (position, pressure) in zip(axes.flat, shown, waters):
    axis.set_xlim(x_low, x_high)
    axis.set_ylim(z_low, z_high)
    axis.set_aspect("equal")
    drops = EllipseCollection(1.2 * spacing, 1.2 * spacing, 0, units="xy", offsets=position, transOffset=axis.transData,
                              array=factor * pressure, cmap="viridis", zorder=1)
    drops.set_clim(0, factor * max(highest, 1e-12))
    axis.add_collection(drops)
    draw_solids(axis, z_low)
    if blocks is not None:
        draw_blocks(axis, instant)
    axis.axhline(0, color="0.5", lw=0.6, ls=":", zorder=0)
    axis.set_title(f"t = {instant:.2f} s")
    axis.grid(False)
for axis in axes[:, 0]:
    axis.set_ylabel("z, m")
for axis in axes[-1]:
    axis.set_xlabel("x, m (offshore to shore)")
figure.colorbar(drops, ax=axes, label=f"pressure, {unit}", shrink=0.7, pad=0.01, extend="both")
style.save(figure, picture)
