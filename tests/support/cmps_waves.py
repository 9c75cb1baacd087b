"""Writes windows like those of boussinesq from linear wave theory, so that cmps can be tested by itself."""
import json
import os

import h5py
import numpy as np


def wave_number(period, depth, gravity=9.81):
    """Airy dispersion, 1/m, by Newton's method."""
    omega2 = (2 * np.pi / period) ** 2
    k = omega2 / gravity / np.sqrt(np.tanh(omega2 * depth / gravity))
    for _ in range(50):
        f = gravity * k * np.tanh(k * depth) - omega2
        k -= f / (gravity * np.tanh(k * depth) + gravity * k * depth / np.cosh(k * depth) ** 2)
    return k


def write_waves(folder, height, period, depth, x0, x1, end, window=0.5, spacing=0.05, interval=0.025, ramp=2.0,
                arrival=0.5, celerity_front=None, on_one_clock=False):
    """Progressive regular wave over a level bed; the front starts at x0 at t = `arrival` and ramps over `ramp` periods.
    `on_one_clock`: times are multiples of `interval`, to the last bit the same in windows of any length."""
    os.makedirs(folder, exist_ok=True)
    k = wave_number(period, depth)
    omega = 2 * np.pi / period
    front = celerity_front or 0.5 * omega / k * (1 + 2 * k * depth / np.sinh(2 * k * depth))
    x = np.arange(x0, x1 + 0.5 * spacing, spacing)
    count = int(np.ceil(end / window - 1e-9))
    for index in range(count):
        begin, finish = index * window, min(end, (index + 1) * window)
        t = np.linspace(begin, finish, int(round((finish - begin) / interval)) + 1)
        if on_one_clock:
            t = interval * np.arange(round(begin / interval), round(finish / interval) + 1)
            begin, finish = t[0], t[-1]
        since = t[:, None] - arrival - (x[None, :] - x0) / front
        envelope = np.clip(since / (ramp * period), 0, 1)
        envelope = envelope * envelope * (3 - 2 * envelope)
        phase = k * (x[None, :] - x0) - omega * (t[:, None] - arrival)
        eta = 0.5 * height * envelope * np.cos(phase)
        # depth-averaged velocity that carries the linear volume flux
        u = omega / k * eta / depth
        write_window(folder, index, begin, finish, t, x, np.full_like(x, depth), eta, u)
    with open(os.path.join(folder, "run.json"), "w") as file:
        json.dump({"stage": "boussinesq", "status": "done", "windows": count}, file)


def write_window(folder, index, begin, finish, t, x, depth, eta, u):
    path = os.path.join(folder, f"window_{index:06d}.h5")
    with h5py.File(path, "w") as file:
        file.attrs["schema"] = "tsunagi.boussinesq.window/1"
        file.attrs["stage"] = "boussinesq"
        file.attrs["index"] = np.int64(index)
        file.attrs["t_begin"], file.attrs["t_end"] = float(begin), float(finish)
        file.attrs["scene_digest"], file.attrs["input_digest"] = "linear", ""
        for name, unit, values in (("time", "s", t), ("x", "m", x), ("still_water_depth", "m", depth),
                                   ("surface_elevation", "m", eta), ("velocity", "m/s", u)):
            values = np.asarray(values, dtype="f8" if name in ("time", "x") else "f4")
            data = file.create_dataset(name, data=values, chunks=values.shape, fletcher32=True)
            data.attrs["units"] = unit
