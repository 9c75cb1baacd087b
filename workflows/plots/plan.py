"""Blocks and wires seen from above at three instants: spheres of every block, links coloured by tension.

The instants are the start and, where the run is long enough, the paper's 9.99 and 11.67 s on its own clock. A link
is one line between two blocks; its tension is the sum over its wires. A link that lost wires is dashed. The shore (the
caisson) is at the top. Above each panel stand the largest and the smallest tension of one wire at that instant.

usage: plan.py BLOCKS PICTURE
"""
import matplotlib
import numpy
import style
from matplotlib.collections import EllipseCollection, LineCollection
from style import plt

import run_folder

blocks, picture = style.arguments("BLOCKS", "PICTURE")
geometry = run_folder.read_geometry(blocks)
record = run_folder.read_run(blocks)
names = ["/blocks/position", "/blocks/orientation"]
shapes = style.BlockShapes(geometry)
ends = geometry.get("/wires/ends", numpy.zeros((0, 4), int))  # block, sphere, block, sphere
has_wires = len(ends) > 0
time, position, orientation, *wires = run_folder.read_series(
    blocks, *names, *(["/wires/tension", "/wires/intact"] if has_wires else []))
tension, intact = wires if has_wires else (numpy.zeros((len(time), 0)), numpy.zeros((len(time), 0)))
arrival = record["figures"].get("clock", {}).get("waves_reach_blocks")
count = position.shape[1]

# The start and the paper's two instants, on its clock; a shorter run shows its strongest tension (or half time) and end.
if arrival is not None and arrival + 11.67 <= time[-1]:
    wanted = [time[0], arrival + 9.99, arrival + 11.67]
else:
    strongest = time[tension.max(axis=1).argmax()] if has_wires else time[-1]
    wanted = [time[0], strongest if time[0] < strongest < time[-1] else 0.5 * (time[0] + time[-1]), time[-1]]
samples = [numpy.abs(time - instant).argmin() for instant in wanted]
pairs, first_wire, link_of_wire = numpy.unique(ends[:, [0, 2]], axis=0, return_index=True, return_inverse=True)
to_image = geometry.get("/wires/image_offset", numpy.zeros(len(ends)))[first_wire]  # across periodic sides


def total(values):
    """Sum over the wires of each link."""
    return numpy.bincount(link_of_wire, values, len(pairs))


most = max((total(tension[sample]).max() for sample in samples), default=0) if has_wires else 0

moved = numpy.linalg.norm(position - position[0], axis=2)
most_moved = max(float(moved[samples].max()), 1e-12)
block_colours = matplotlib.colors.LinearSegmentedColormap.from_list("moved", ["#e4e1da", "#8fa8bd"])
x_low = position[samples, :, 0].min() - 0.06
x_high = position[samples, :, 0].max() + 0.06
y_low, y_high = position[samples, :, 1].min() - 0.04, position[samples, :, 1].max() + 0.04
height = 10 * (x_high - x_low) / (y_high - y_low) + 0.75
figure, axes = plt.subplots(len(samples), 1, figsize=(11.5, height * len(samples)), sharex=True)


def centres(sample, block):
    return shapes.centres(block, position[sample, block], orientation[sample, block])


for axis, sample in zip(axes, samples):
    for block in range(count):
        places = centres(sample, block)
        colour = "#c9c4b8" if shapes.is_fixed[block] else block_colours(moved[sample, block] / most_moved)
        diameter = numpy.full(len(places), shapes.diameter(block))
        top = numpy.argsort(places[:, 2])
        axis.add_collection(EllipseCollection(diameter, diameter, 0 * diameter, units="xy", offsets=places[top][:, [1, 0]],
                                              transOffset=axis.transData, facecolors=colour, edgecolors="0.55",
                                              linewidths=0.15))
        if not shapes.is_fixed[block]:
            axis.text(position[sample, block, 1], position[sample, block, 0], f"{block + 1}", ha="center", va="center",
                      fontsize=5.5, color="0.25", zorder=5)
    if has_wires:
        link_tension, broken = total(tension[sample]), total(intact[sample] == 0) > 0
        places = position[sample][pairs][:, :, [1, 0]]
        places[:, 1, 0] += to_image
        # From edge to edge of the facing halves, so that the numbers stay readable.
        segments = places + 0.28 * (places[:, ::-1] - places)
        order = numpy.argsort(link_tension)
        lines = LineCollection(segments[order], array=link_tension[order], cmap="plasma_r", linewidths=4, zorder=4,
                               capstyle="round", linestyles=["--" if lost else "-" for lost in broken[order]])
        lines.set_clim(0, max(most, 1e-12))
        axis.add_collection(lines)
    paper_clock = f" (paper's clock {time[sample] - arrival:.2f} s)" if arrival is not None and time[sample] > arrival else ""
    state = ""
    if has_wires:
        state = (f"   f_max = {tension[sample].max():.3f} N, f_min = {tension[sample].min():.3f} N, "
                 f"{int((intact[sample] == 0).sum())} of {tension.shape[1]} wires broken")
    axis.set_title(f"t = {time[sample]:.2f} s{paper_clock}{state}")
    axis.set_xlim(y_low, y_high)
    axis.set_ylim(x_low, x_high)
    axis.set_aspect("equal")
    axis.set_ylabel("x, m (shore is up)")
    axis.grid(False)
axes[-1].set_xlabel("y, m (along the breakwater)")
if has_wires:
    figure.colorbar(lines, ax=axes, label="tension of a link (all its wires), N", shrink=0.6, pad=0.01)
style.save(figure, picture)
