"""Reads what a stage left in its folder: windows, geometry and run.json.

The layout of the files is described in common/README.md. Used by plots, studies and tests.
"""
import json
import pathlib

import h5py
import numpy


def window_paths(folder):
    """The windows of a folder, in order."""
    return sorted(pathlib.Path(folder).glob("window_[0-9]*.h5"))


def read_file(path):
    """Attributes and datasets of one HDF5 file: ({name: value}, {"/group/name": array})."""
    datasets = {}
    with h5py.File(path, "r") as file:
        attributes = {name: value.decode() if isinstance(value, bytes) else value
                      for name, value in file.attrs.items()}
        file.visititems(lambda name, item: datasets.__setitem__("/" + name, item[()])
                        if isinstance(item, h5py.Dataset) else None)
    return attributes, datasets


def read_geometry(folder):
    """Datasets of geometry.h5."""
    return read_file(pathlib.Path(folder) / "geometry.h5")[1]


def read_run(folder):
    """run.json as a dictionary."""
    return json.loads((pathlib.Path(folder) / "run.json").read_text())


def time_axis(name, file):
    """The time dataset that belongs to a dataset: the nearest `time` on the way up to the root."""
    group = name.rpartition("/")[0]
    while True:
        if f"{group}/time" in file:
            return f"{group}/time"
        if not group:
            raise KeyError(f"{file.filename}: {name} has no time dataset")
        group = group.rpartition("/")[0]


def read_series(folder, *names, begin=-numpy.inf, end=numpy.inf):
    """Time and the named datasets joined over all windows that meet [begin, end]: (time, array, ...).

    The sample that two neighbouring windows share is kept once.
    """
    times, parts = [], [[] for _ in names]
    last = -numpy.inf
    for path in window_paths(folder):
        with h5py.File(path, "r") as file:
            if file.attrs["t_end"] < begin or file.attrs["t_begin"] > end or names[0] not in file:
                continue
            time = file[time_axis(names[0], file)][()]
            keep = (time > last + 1e-9) & (time >= begin) & (time <= end)
            if not keep.any():
                continue
            last = time[keep][-1]
            times.append(time[keep])
            for part, name in zip(parts, names):
                part.append(file[name][()][keep])
    if not times:
        raise KeyError(f"{folder}: no window holds {names[0]}")
    return numpy.concatenate(times), *(numpy.concatenate(part) for part in parts)


def gauge(folder, name, quantity="surface_elevation"):
    """Record of a gauge over all windows: (time s, values)."""
    return read_series(folder, f"/gauges/{name}/{quantity}")


def gauge_names(folder, quantity="surface_elevation"):
    """Names of the gauges that record `quantity` in a folder."""
    for path in window_paths(folder):
        with h5py.File(path, "r") as file:
            return [name for name in file.get("gauges", {}) if quantity in file["gauges"][name]]
    return []


def gauge_places(folder):
    """{gauge: x in m} as the scene in run.json has them."""
    values = read_run(folder)["scene"]["values"]
    places = {name: entry["value"] for name, entry in values.get("gauges", {}).items()}  # "toe" = 650
    places |= {section.removeprefix("gauges."): entries["x"]["value"]  # "wall" = { x = 700, z = -2 }
               for section, entries in values.items() if section.startswith("gauges.") and "x" in entries}
    return places


def static(folder, name, instant=-numpy.inf):
    """A dataset without a time of its own, from the first window that ends at `instant` or later."""
    for path in window_paths(folder):
        with h5py.File(path, "r") as file:
            if name in file and file.attrs["t_end"] >= instant - 1e-9:
                return file[name][()]
    raise KeyError(f"{folder}: no window holds {name}")
