"""Every gauge: surface elevation by boussinesq (incident wave) and cmps (with the structure's reflection), and pressures.

usage: gauges.py CHAIN PICTURE
"""
import style
from style import plt

import run_folder

chain, picture = style.arguments("CHAIN", "PICTURE")
records = {"surface_elevation": [], "pressure": []}  # quantity: [(gauge, stage, colour, time, values)]
places = {}
for folder, stage, colour in (("waves", "boussinesq", style.WAVES), ("flow", "cmps", style.FLOW)):
    if not run_folder.window_paths(chain / folder):
        continue
    places |= run_folder.gauge_places(chain / folder)
    for quantity, found in records.items():
        for name in run_folder.gauge_names(chain / folder, quantity):
            found.append((name, stage, colour, *run_folder.gauge(chain / folder, name, quantity)))
panels = []  # (quantity, gauge), by place
for quantity, found in records.items():
    panels += [(quantity, name) for name in sorted({record[0] for record in found}, key=lambda name: (places.get(name, 0), name))]
if not panels:
    style.nothing(f"{chain} has no gauge")

largest = {quantity: max((abs(record[4]).max() for record in found), default=0) for quantity, found in records.items()}
units = {"surface_elevation": style.length_unit(largest["surface_elevation"]), "pressure": style.pressure_unit(largest["pressure"])}
words = {"surface_elevation": "elevation", "pressure": "pressure"}
figure, axes = plt.subplots(len(panels), 1, figsize=(11, 1.9 * len(panels) + 0.6), sharex=True, squeeze=False)
first = {}
for axis, (quantity, name) in zip(axes[:, 0], panels):
    factor, unit = units[quantity]
    for _, stage, colour, time, values in (record for record in records[quantity] if record[0] == name):
        axis.plot(time, factor * values, color=colour, label=stage)
    axis.sharey(first.setdefault(quantity, axis)) if axis is not first.get(quantity, axis) else None
    axis.set_title(f"gauge {name}" + (f", x = {places[name]:.4g} m" if name in places else ""))
    axis.set_ylabel(f"{words[quantity]}, {unit}")
legend = {line.get_label(): line for axis in axes[:, 0] for line in axis.get_lines()}
figure.legend(legend.values(), legend.keys(), loc="upper right", ncol=len(legend))
axes[-1, 0].set_xlabel("time, s")
style.save(figure, picture)
