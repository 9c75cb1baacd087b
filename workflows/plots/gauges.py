"""Surface elevation at every gauge: boussinesq (incident wave) and cmps (with the structure's reflection).

usage: gauges.py CHAIN PICTURE
"""
import style
from style import plt

import run_folder

chain, picture = style.arguments("CHAIN", "PICTURE")
records = []  # (gauge, stage, colour, time, elevation)
places = {}
for folder, stage, colour in (("waves", "boussinesq", style.WAVES), ("flow", "cmps", style.FLOW)):
    if not run_folder.window_paths(chain / folder):
        continue
    values = run_folder.read_run(chain / folder).get("scene", {}).get("values", {})
    for name in run_folder.gauge_names(chain / folder):
        records.append((name, stage, colour, *run_folder.gauge(chain / folder, name)))
        place = values.get("gauges", {}).get(name) or values.get(f"gauges.{name}", {}).get("x")
        if place:
            places[name] = place["value"]

names = sorted({record[0] for record in records}, key=lambda name: (places.get(name, 0), name))
figure, axes = plt.subplots(len(names), 1, figsize=(11, 1.9 * len(names) + 0.6), sharex=True, sharey=True, squeeze=False)
for axis, name in zip(axes[:, 0], names):
    for _, stage, colour, time, elevation in (record for record in records if record[0] == name):
        axis.plot(time, 100 * elevation, color=colour, label=stage)
    where = f", x = {places[name]:.1f} m" if name in places else ""
    axis.set_title(f"gauge {name}{where}")
    axis.set_ylabel("elevation, cm")
legend = {line.get_label(): line for axis in axes[:, 0] for line in axis.get_lines()}
figure.legend(legend.values(), legend.keys(), loc="upper right", ncol=len(legend))
axes[-1, 0].set_xlabel("time, s")
style.save(figure, picture)
