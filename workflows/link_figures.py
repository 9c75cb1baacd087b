"""How well cmps continues the waves of boussinesq at the gauge `link`, before the structure's reflection is back there.

usage: link_figures.py CHAIN     prints the figures
"""
import dataclasses
import math
import pathlib
import sys

import numpy

sys.dont_write_bytecode = True
import run_folder  # noqa: E402


@dataclasses.dataclass
class Link:
    """Both records on one time axis; lengths in m, times in s."""
    x: float
    time: numpy.ndarray
    waves: numpy.ndarray
    flow: numpy.ndarray
    height: float           # mean crest-to-trough height of boussinesq's full waves
    spans: list             # Span: "any" reflection back, "half" of the wave height back


@dataclasses.dataclass
class Span:
    """The periods before the reflection of waves of a given share of the full height is back."""
    share: float
    begin: float
    end: float
    periods: float
    rms_over_height: float


def wave_number(period, depth, gravity=9.81):
    """Linear dispersion, by Newton's method."""
    omega = 2 * math.pi / period
    k = omega * omega / gravity / math.sqrt(math.tanh(omega * omega * depth / gravity))
    for _ in range(50):
        tanh = math.tanh(k * depth)
        k -= (gravity * k * tanh - omega * omega) / (gravity * tanh + gravity * k * depth * (1 - tanh * tanh))
    return k


def phase_speed(period, depth):
    return 2 * math.pi / period / wave_number(period, depth)


def group_speed(period, depth):
    k = wave_number(period, depth)
    return phase_speed(period, depth) * (0.5 + k * depth / math.sinh(2 * k * depth))


def mean_height(elevation, per_period):
    """Mean over whole periods of highest minus lowest."""
    count = len(elevation) // per_period
    rows = elevation[:count * per_period].reshape(count, per_period)
    return float((rows.max(axis=1) - rows.min(axis=1)).mean())


def front_face(structure, level=0.0):
    """Smallest x at which the structure stands in still water's surface."""
    crossings = []
    for polygon in structure:
        for (x0, z0), (x1, z1) in zip(polygon, polygon[1:] + polygon[:1]):
            if (z0 - level) * (z1 - level) < 0:
                crossings.append(x0 + (x1 - x0) * (level - z0) / (z1 - z0))
    return min(crossings)


def compare(chain, gauge="link", periods=4):
    """Compares the last `periods` wave periods before the reflection from the structure is back at the gauge.

    The reflection is back when the front of the waves, seen at the gauge when the surface first moves by 5 % of the full
    height (`spans[0]`; nothing has come back before) or by half of it (`spans[1]`; the weak front of the reflection is
    back, but the waves compared are nearly full), has travelled to the front face and back at the group speed of linear
    theory. The height is that of boussinesq's full waves, which know no reflection.
    """
    chain = pathlib.Path(chain)
    values = run_folder.read_run(chain / "flow")["scene"]["values"]
    wave_values = run_folder.read_run(chain / "waves")["scene"]["values"]
    entry = values["gauges"].get(gauge) or values[f"gauges.{gauge}"]["x"]
    x, period = float(entry["value"]), float(wave_values["waves"]["period"]["value"])
    structure = values["cmps"]["structure"]["value"]
    bed = numpy.array(values["flume"]["bed"]["value"], dtype=float)
    depth = -float(numpy.interp(x, bed[:, 0], bed[:, 1]))
    distance = front_face(structure) - x

    time, waves = run_folder.gauge(chain / "waves", gauge)
    flow_time, flow = run_folder.gauge(chain / "flow", gauge)
    inside = (time >= flow_time[0]) & (time <= flow_time[-1])
    time, waves = time[inside], waves[inside]
    flow = numpy.interp(time, flow_time, flow)
    full_height = waves[len(waves) // 2:].max() - waves[len(waves) // 2:].min()
    per_period = round(period / (time[1] - time[0]))
    height = mean_height(waves[len(waves) // 2:], per_period)
    spans = []
    for share in (0.05, 0.5):
        arrival = time[numpy.argmax(abs(waves) > share * full_height)]
        end = min(arrival + 2 * distance / group_speed(period, depth), time[-1])
        begin = max(end - periods * period, time[0])
        chosen = (time >= begin) & (time <= end)
        rms = float(numpy.sqrt(((flow - waves)[chosen] ** 2).mean()))
        spans.append(Span(share, begin, end, (end - begin) / period, rms / height))
    return Link(x, time, waves, flow, height, spans)


if __name__ == "__main__":
    link = compare(sys.argv[1])
    print(f"gauge link, x = {link.x:g} m, wave height {link.height:.4f} m")
    for span in link.spans:
        print(f"{span.periods:.1f} periods before the reflection of waves above {span.share:g} of it is back, "
              f"t = {span.begin:.2f} to {span.end:.2f} s: RMS difference {100 * span.rms_over_height:.1f} % of it")
