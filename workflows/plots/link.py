"""Where the stages meet: surface elevation of boussinesq and cmps at the gauge nearest to the offshore boundary of cmps.

usage: link.py CHAIN PICTURE
"""
import style
from style import plt

import link_figures

chain, picture = style.arguments("CHAIN", "PICTURE")
try:
    link = link_figures.compare(chain)
except link_figures.NothingToCompare as why:
    style.nothing(why)
factor, unit = style.length_unit(max(abs(link.waves).max(), abs(link.flow).max()))
figure, (above, below) = plt.subplots(2, 1, figsize=(11, 5.2), sharex=True, height_ratios=(2, 1))
above.plot(link.time, factor * link.waves, color=style.WAVES, label="boussinesq (incident wave)")
above.plot(link.time, factor * link.flow, color=style.FLOW, label="cmps")
shades = ("0.86", "0.94")
for span, shade in zip(link.spans, shades):
    for axis in (above, below):
        axis.axvspan(span.begin, span.end, color=shade, zorder=-span.share, lw=0)
figures = [f"gauge {link.gauge}, x = {link.x:.4g} m, mean wave height {factor * link.height:.3g} {unit}"]
figures += [f"t = {span.begin:.2f} to {span.end:.2f} s, {span.words}: RMS difference {100 * span.rms_over_height:.1f} % of the height"
            for span in link.spans]
above.set_title("\n".join(figures))
above.set_ylabel(f"elevation, {unit}")
above.legend(loc="lower left", ncol=2)
below.plot(link.time, factor * (link.flow - link.waves), color="0.3")
below.set_ylabel(f"difference, {unit}")
below.set_xlabel("time, s")
style.save(figure, picture)
