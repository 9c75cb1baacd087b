"""Where the stages meet: surface elevation of boussinesq and cmps at the gauge `link`, before the reflection returns.

usage: link.py CHAIN PICTURE
"""
import style
from style import plt

import link_figures

chain, picture = style.arguments("CHAIN", "PICTURE")
link = link_figures.compare(chain)
figure, (above, below) = plt.subplots(2, 1, figsize=(11, 5.2), sharex=True, height_ratios=(2, 1))
above.plot(link.time, 100 * link.waves, color=style.WAVES, label="boussinesq (incident wave)")
above.plot(link.time, 100 * link.flow, color=style.FLOW, label="cmps")
strict, late = link.spans
for axis in (above, below):
    axis.axvspan(strict.begin, strict.end, color="0.86", zorder=0, lw=0)
    axis.axvspan(max(late.begin, strict.end), late.end, color="0.94", zorder=0, lw=0)
top = above.get_ylim()[1]
above.text(strict.begin, top, f" {strict.periods:.1f} periods before any reflection:\n RMS difference "
           f"{100 * strict.rms_over_height:.1f} % of the height", va="top", fontsize=9)
above.text(late.end, top, f"{late.periods:.1f} periods before that of half the height:\n"
           f"{100 * late.rms_over_height:.1f} % ", va="top", ha="left", fontsize=9)
above.set_ylabel("elevation, cm")
above.legend(loc="lower left", ncol=2)
above.set_title(f"gauge link, x = {link.x:.1f} m, wave height {100 * link.height:.1f} cm")
below.plot(link.time, 100 * (link.flow - link.waves), color="0.3")
below.set_ylabel("cmps - boussinesq, cm")
below.set_xlabel("time, s")
style.save(figure, picture)
