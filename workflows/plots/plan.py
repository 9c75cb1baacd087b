"""Blocks and wires seen from above at three instants: spheres of every block, wires coloured by tension.

The shore (the caisson) is at the top. Beside each panel stand the largest and the smallest tension of that instant.

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
has_wires = len(geometry.get("/wires/blocks", ())) > 0
time, position, orientation, *wires = run_folder.read_series(
    blocks, *names, *(["/wires/tension", "/wires/intact"] if has_wires else []))
tension, intact = wires if has_wires else (numpy.zeros((len(time), 0)), numpy.zeros((len(time), 0)))
begin, end = geometry["/blocks/sphere_begin"], geometry["/blocks/sphere_end"]
arrival = record["figures"].get("clock", {}).get("waves_reach_blocks")
count = position.shape[1]

# The start, the paper's instant of tensions where the run reaches it (else when the wires pull most), and the end.
wanted = [time[0], time[-1]]
if arrival is not None and time[0] < arrival + 9.99 < time[-1]:
    wanted.insert(1, arrival + 9.99)
elif has_wires:
    wanted.insert(1, time[tension.max(axis=1).argmax()])
else:
    wanted.insert(1, 0.5 * (time[0] + time[-1]))
samples = [numpy.abs(time - instant).argmin() for instant in wanted]
most = max(float(tension[samples].max()) if has_wires else 0, 1e-12)

moved = numpy.linalg.norm(position - position[0], axis=2)
most_moved = max(float(moved[samples].max()), 1e-12)
block_colours = matplotlib.colors.LinearSegmentedColormap.from_list("moved", ["#e4e1da", "#8fa8bd"])
x_low = position[samples, :, 0].min() - 0.06
x_high = position[samples, :, 0].max() + 0.06
y_low, y_high = position[samples, :, 1].min() - 0.04, position[samples, :, 1].max() + 0.04
height = 10 * (x_high - x_low) / (y_high - y_low) + 0.75
figure, axes = plt.subplots(len(samples), 1, figsize=(11.5, height * len(samples)), sharex=True)


def sphere_places(sample, block):
    return position[sample, block] + style.rotate(orientation[sample, block],
                                                  geometry["/spheres/position"][begin[block]:end[block]])


for axis, sample in zip(axes, samples):
    for block in range(count):
        places = sphere_places(sample, block)
        diameter = geometry["/spheres/diameter"][begin[block]:end[block]]
        colour = block_colours(moved[sample, block] / most_moved)
        top = numpy.argsort(places[:, 2])
        axis.add_collection(EllipseCollection(diameter, diameter, 0 * diameter, units="xy", offsets=places[top][:, [1, 0]],
                                              transOffset=axis.transData, facecolors=colour, edgecolors="0.55",
                                              linewidths=0.15))
    for block in range(count):
        axis.text(position[sample, block, 1], position[sample, block, 0], f"{block + 1}", ha="center", va="center",
                  fontsize=5.5, color="0.25", zorder=5)
    if has_wires:
        pairs, spheres = geometry["/wires/blocks"], geometry["/wires/spheres"]
        order = numpy.argsort(tension[sample])
        segments = [[sphere_places(sample, pairs[w, end_])[spheres[w, end_]][[1, 0]] for end_ in (0, 1)]
                    for w in order if intact[sample, w]]
        values = [tension[sample, w] for w in order if intact[sample, w]]
        lines = LineCollection(segments, array=numpy.array(values), cmap="plasma_r", linewidths=2.4, zorder=4)
        lines.set_clim(0, most)
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
    figure.colorbar(lines, ax=axes, label="wire tension, N", shrink=0.6, pad=0.01)
style.save(figure, picture)
