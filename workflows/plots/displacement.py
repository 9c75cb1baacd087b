"""How far each block moved: offshore displacement by block number, wired and unwired apart, and their means over time.

usage: displacement.py BLOCKS PICTURE
"""
import numpy
import style
from style import plt

import run_folder

blocks, picture = style.arguments("BLOCKS", "PICTURE")
if not run_folder.window_paths(blocks):
    style.nothing(f"{blocks} holds no windows")
geometry = run_folder.read_geometry(blocks)
time, position = run_folder.read_series(blocks, "/blocks/position")
movable = geometry["/blocks/fixed"] == 0
if not movable.any():
    style.nothing(f"{blocks} has no block that can move")
total = numpy.linalg.norm(position[-1] - position[0], axis=1)
factor, unit = style.length_unit(numpy.linalg.norm(position - position[0], axis=2)[:, movable].max())
offshore = factor * (position[0, :, 0] - position[:, :, 0])  # towards the sea
count = position.shape[1]
wired = numpy.zeros(count, bool)
wired[numpy.unique(geometry.get("/wires/ends", numpy.zeros((0, 4), int))[:, [0, 2]])] = True
groups = [("wired", wired & movable, style.FLOW), ("unwired", ~wired & movable, style.WAVES)]
groups = [group for group in groups if group[1].any()]

figure, (by_block, by_time) = plt.subplots(2, 1, figsize=(11.5, 7))
number = numpy.arange(1, count + 1)
for label, members, colour in groups:
    by_block.bar(number[members], offshore[-1, members], color=colour, width=0.8 if count <= 200 else 1.0,
                 label=f"{label} ({members.sum()} blocks)")
by_block.plot(number[movable], factor * total[movable], ".", color="0.2", ms=4 if count <= 200 else 2, label="distance in all directions")
by_block.axhline(0, color="0.3", lw=0.8)
by_block.set_xlim(number[movable].min() - 1, number[movable].max() + 1)
by_block.xaxis.get_major_locator().set_params(integer=True)
by_block.set_xlabel("block number")
by_block.set_ylabel(f"offshore displacement, {unit}")
by_block.set_title(f"at t = {time[-1]:.2f} s")
by_block.legend(ncol=3)
for label, members, colour in groups:
    low, high = numpy.percentile(offshore[:, members], (10, 90), axis=1)
    by_time.fill_between(time, low, high, color=colour, alpha=0.15, lw=0)
    by_time.plot(time, offshore[:, members].mean(axis=1), color=colour, label=f"{label}: mean, and 10 to 90 % of the blocks")
by_time.set_xlabel("time, s")
by_time.set_ylabel(f"offshore displacement, {unit}")
by_time.legend(loc="upper left")
style.save(figure, picture)
