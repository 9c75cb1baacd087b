"""How well cmps continues the waves of boussinesq, before the structure's reflection is back: at the gauge farthest offshore
of those that both record, where that takes longest.

usage: link_figures.py CHAIN     prints the figures
"""
import dataclasses
import math
import pathlib
import sys

import numpy

sys.dont_write_bytecode = True
import run_folder  # noqa: E402


class NothingToCompare(Exception):
    """Its text says why."""


@dataclasses.dataclass
class Link:
    """Both records on one time axis; lengths in m, times in s."""
    gauge: str
    x: float
    time: numpy.ndarray
    waves: numpy.ndarray
    flow: numpy.ndarray
    height: float           # mean crest-to-trough height of boussinesq's full waves
    spans: list             # Span: before any reflection, before that of half the height; one of the whole without a structure


@dataclasses.dataclass
class Span:
    """The periods before the reflection of waves of a given share of the full height is back."""
    share: float
    words: str
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
    """Smallest x at which the structure stands in still water's surface; None where it does not."""
    crossings = []
    for polygon in structure:
        for (x0, z0), (x1, z1) in zip(polygon, polygon[1:] + polygon[:1]):
            if (z0 - level) * (z1 - level) < 0:
                crossings.append(x0 + (x1 - x0) * (level - z0) / (z1 - z0))
    return min(crossings, default=None)


def value(values, section, key):
    """A scene key as run.json lists it; None where it stands nowhere."""
    return values.get(section, {}).get(key, {}).get("value")


def compare(chain, gauge=None, periods=4):
    """Compares the last `periods` wave periods before the reflection from the structure is back at the gauge.

    The reflection is back when the front of the waves, seen at the gauge when the surface first moves by 5 % of the full
    height (`spans[0]`; nothing has come back before) or by half of it (`spans[1]`; the weak front of the reflection is
    back, but the waves compared are nearly full), has travelled to the front face and back at the group speed of linear
    theory. The height is that of boussinesq's full waves, which know no reflection.
    """
    chain = pathlib.Path(chain)
    both = set(run_folder.gauge_names(chain / "waves")) & set(run_folder.gauge_names(chain / "flow"))
    places = run_folder.gauge_places(chain / "flow")
    gauge = gauge or min(both, key=places.get, default=None)
    if gauge is None:
        raise NothingToCompare("no gauge of the surface is recorded by both boussinesq and cmps")
    x = float(places[gauge])
    values = run_folder.read_run(chain / "flow")["scene"]["values"]
    waves_record = run_folder.read_run(chain / "waves")
    bed = numpy.array(value(values, "flume", "bed"), dtype=float)
    depth = -float(numpy.interp(x, bed[:, 0], bed[:, 1]))
    face = front_face(value(values, "cmps", "structure") or [])

    time, waves = run_folder.gauge(chain / "waves", gauge)
    flow_time, flow = run_folder.gauge(chain / "flow", gauge)
    inside = (time >= flow_time[0]) & (time <= flow_time[-1])
    time, waves = time[inside], waves[inside]
    flow = numpy.interp(time, flow_time, flow)
    # A record of waves has no period of its own in the scene; boussinesq measures one at every gauge.
    period = value(waves_record["scene"]["values"], "waves", "period") or waves_record["figures"]["gauges"][gauge]["significant_period"]
    if len(time) < 2 or not period or time[-1] - time[0] < 2 * period:
        raise NothingToCompare(f"gauge {gauge} is recorded by both boussinesq and cmps over less than two wave periods")
    full_height = waves[len(waves) // 2:].max() - waves[len(waves) // 2:].min()
    per_period = round(period / (time[1] - time[0]))
    height = mean_height(waves[len(waves) // 2:], per_period)
    spans = []
    for share in (0.05, 0.5) if face is not None else (0.05,):
        arrival = time[numpy.argmax(abs(waves) > share * full_height)]
        returned = arrival + 2 * (face - x) / group_speed(period, depth) if face is not None else numpy.inf
        end = min(returned, time[-1])
        begin = max(end - periods * period, time[0])
        chosen = (time >= begin) & (time <= end)
        if end - begin < 0.5 * period:
            continue  # the record begins when the reflection is back
        rms = float(numpy.sqrt(((flow - waves)[chosen] ** 2).mean()))
        words = f"before {'any reflection' if share == 0.05 else 'that of half the height'} is back" if returned <= time[-1] else "at the end"
        spans.append(Span(share, words, begin, end, (end - begin) / period, rms / height))
    return Link(gauge, x, time, waves, flow, height, spans)


if __name__ == "__main__":
    try:
        link = compare(sys.argv[1])
    except NothingToCompare as why:
        sys.exit(f"link_figures: {why}")
    print(f"gauge {link.gauge}, x = {link.x:g} m, mean wave height {link.height:.3g} m")
    for span in link.spans:
        print(f"t = {span.begin:.2f} to {span.end:.2f} s ({span.periods:.1f} periods {span.words}): "
              f"RMS difference {100 * span.rms_over_height:.1f} % of it")
