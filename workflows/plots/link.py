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
above.axvspan(link.begin, link.end, color="0.9", zorder=0)
above.text(link.begin, above.get_ylim()[1], f" {link.periods:g} periods before the reflection returns", va="top", fontsize=9)
above.set_ylabel("elevation, cm")
above.legend(loc="lower left", ncol=2)
above.set_title(f"gauge link, x = {link.x:.1f} m: RMS difference {100 * link.rms_over_height:.1f} % of the wave height "
                f"({100 * link.height:.1f} cm)")
below.plot(link.time, 100 * (link.flow - link.waves), color="0.3")
below.axvspan(link.begin, link.end, color="0.9", zorder=0)
below.set_ylabel("cmps - boussinesq, cm")
below.set_xlabel("time, s")
style.save(figure, picture)
