"""Blocks and wires seen from above at three instants: spheres of every block, links coloured by tension.

The instants are the first, that of the largest tension of a wire (half time without wires) and the last. A link is one line
between two blocks; its tension is the sum over its wires. A link that lost wires is dashed. The shore is at the top. Above
each panel stand the largest and the smallest tension of one wire at that instant.

usage: plan.py BLOCKS PICTURE
"""
import matplotlib
import numpy
import style
from matplotlib.collections import EllipseCollection, LineCollection
from style import plt

import run_folder

blocks, picture = style.arguments("BLOCKS", "PICTURE")
if not run_folder.window_paths(blocks):
    style.nothing(f"{blocks} holds no windows")
geometry = run_folder.read_geometry(blocks)
arrival = run_folder.read_run(blocks)["figures"].get("clock", {}).get("waves_reach_blocks")
shapes = style.BlockShapes(geometry)
ends = geometry.get("/wires/ends", numpy.zeros((0, 4), int))  # block, sphere, block, sphere
has_wires = len(ends) > 0
time, position, orientation, *wires = run_folder.read_series(
    blocks, "/blocks/position", "/blocks/orientation", *(["/wires/tension", "/wires/intact"] if has_wires else []))
tension, intact = wires if has_wires else (numpy.zeros((len(time), 0)), numpy.zeros((len(time), 0)))
count = position.shape[1]

strongest = int(tension.max(axis=1).argmax()) if has_wires else 0
middle = strongest if 0 < strongest < len(time) - 1 else len(time) // 2
samples = sorted({0, middle, len(time) - 1})
pairs, first_wire, link_of_wire = numpy.unique(ends[:, [0, 2]], axis=0, return_index=True, return_inverse=True)
to_image = geometry.get("/wires/image_offset", numpy.zeros(len(ends)))[first_wire]  # across periodic sides


def total(values):
    """Sum over the wires of each link."""
    return numpy.bincount(link_of_wire, values, len(pairs))


most = max(total(tension[sample]).max() for sample in samples) if has_wires else 0
force, force_unit = style.force_unit(most)
largest = tension[samples].max() if has_wires else 0
wire_force, wire_unit = style.force_unit(largest)
decimals = int(numpy.clip(2 - numpy.floor(numpy.log10(max(wire_force * largest, 1e-12))), 0, 9))  # three figures of the largest
moved = numpy.linalg.norm(position - position[0], axis=2)
most_moved = max(float(moved[samples].max()), 1e-12)
block_colours = matplotlib.colors.LinearSegmentedColormap.from_list("moved", ["#e4e1da", "#8fa8bd"])
x_low, x_high = position[samples, :, 0].min() - 1.2 * shapes.reach, position[samples, :, 0].max() + 1.2 * shapes.reach
y_low, y_high = position[samples, :, 1].min() - 1.2 * shapes.reach, position[samples, :, 1].max() + 1.2 * shapes.reach
# One below the other; side by side where the armour is deeper than long.
tall = (x_high - x_low) > 0.8 * (y_high - y_low)
width = 11.5 / len(samples) if tall else 10.0
height = min(width * (x_high - x_low) / (y_high - y_low), 9) + 0.75
figure, axes = plt.subplots(*((1, len(samples)) if tall else (len(samples), 1)), sharex=True, sharey=True, squeeze=False,
                            figsize=(12.5, height) if tall else (11.5, height * len(samples)))
points_per_metre = 72 * width / (y_high - y_low)
number_size = min(7, 0.45 * shapes.reach * points_per_metre)

for axis, sample in zip(axes.flat, samples):
    centres, diameters, block_of = shapes.all_spheres(position[sample], orientation[sample])
    top = numpy.lexsort((centres[:, 2], position[sample, block_of, 2]))  # lower blocks first, each from below
    colours = block_colours(moved[sample] / most_moved)
    colours[shapes.is_fixed] = matplotlib.colors.to_rgba("#c9c4b8")
    axis.add_collection(EllipseCollection(diameters[top], diameters[top], numpy.zeros(len(top)), units="xy", offsets=centres[top][:, [1, 0]],
                                          transOffset=axis.transData, facecolors=colours[block_of[top]], edgecolors="0.55",
                                          linewidths=0.15))
    if number_size >= 3:
        for block in numpy.flatnonzero(~shapes.is_fixed):
            axis.text(position[sample, block, 1], position[sample, block, 0], f"{block + 1}", ha="center", va="center",
                      fontsize=number_size, color="0.25", zorder=5)
    if has_wires:
        link_tension, broken = force * total(tension[sample]), total(intact[sample] == 0) > 0
        places = position[sample][pairs][:, :, [1, 0]]
        places[:, 1, 0] += to_image
        # From edge to edge of the facing halves, so that the numbers stay readable.
        segments = places + 0.28 * (places[:, ::-1] - places)
        order = numpy.argsort(link_tension)
        lines = LineCollection(segments[order], array=link_tension[order], cmap="plasma_r", zorder=4,
                               linewidths=min(4, 0.25 * shapes.reach * points_per_metre), capstyle="round",
                               linestyles=["--" if lost else "-" for lost in broken[order]])
        lines.set_clim(0, max(force * most, 1e-12))
        axis.add_collection(lines)
    title = f"t = {time[sample]:.2f} s"
    if arrival is not None and time[sample] > arrival:
        title += ("\n" if tall else ", ") + f"{time[sample] - arrival:.2f} s after the waves reached the blocks"
    if has_wires:
        title += ("\n" if tall else "   ") + (f"wires pull {wire_force * tension[sample].min():.{decimals}f} to "
                                              f"{wire_force * tension[sample].max():.{decimals}f} {wire_unit}, "
                                              f"{int((intact[sample] == 0).sum())} of {tension.shape[1]} broken")
    axis.set_title(title, fontsize=9 if tall else 10)
    axis.set_xlim(y_low, y_high)
    axis.set_ylim(x_low, x_high)
    axis.set_aspect("equal")
    axis.grid(False)
for axis in axes[:, 0]:
    axis.set_ylabel("x, m (shore is up)")
for axis in axes[-1]:
    axis.set_xlabel("y, m (along the breakwater)")
factor, unit = style.length_unit(most_moved)
figure.supxlabel(f"the bluer a block, the farther it has moved: up to {factor * most_moved:.3g} {unit}", fontsize=9)
if has_wires:
    figure.colorbar(lines, ax=axes, label=f"tension of a link (all its wires), {force_unit}", shrink=0.6, pad=0.01)
style.save(figure, picture)
