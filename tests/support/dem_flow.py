"""Writes windows in the format of the near-field stage, from a formula: flow for tests of blocks without running waves."""
import os

import h5py
import numpy as np


def write_flow(folder, motion, x, z, t_begin, t_end, window, interval, digest="flow-of-a-formula"):
    """motion(t, X, Z) -> (u, w, du/dt, dw/dt, wet) on arrays X, Z (nz, nx); windows share their end samples."""
    os.makedirs(folder, exist_ok=True)
    x, z = np.asarray(x, float), np.asarray(z, float)
    X, Z = np.meshgrid(x, z)
    count = int(np.ceil((t_end - t_begin) / window - 1e-9))
    for k in range(count):
        begin, end = t_begin + k * window, min(t_end, t_begin + (k + 1) * window)
        n = max(1, int(round((end - begin) / interval)))
        times = np.linspace(begin, end, n + 1)
        fields = [np.broadcast_arrays(*(np.asarray(f, float) for f in motion(t, X, Z)), X)[:5] for t in times]
        velocity = np.array([np.stack([f[0], f[1]], axis=-1) for f in fields], dtype=np.float32)
        acceleration = np.array([np.stack([f[2], f[3]], axis=-1) for f in fields], dtype=np.float32)
        wet = np.array([f[4] for f in fields], dtype=np.float32)
        path = os.path.join(folder, f"window_{k:06d}.h5")
        with h5py.File(path + ".tmp", "w") as f:
            for name, value in {"schema": "tsunagi.cmps.window/1", "stage": "cmps", "scene_digest": digest,
                                "input_digest": ""}.items():
                f.attrs.create(name, value.encode(), dtype=f"S{max(1, len(value))}")
            f.attrs["index"] = np.int64(k)
            f.attrs["t_begin"], f.attrs["t_end"] = float(begin), float(end)
            for name, data, unit in (("/flow/time", times, "s"), ("/flow/x", x, "m"), ("/flow/z", z, "m"),
                                     ("/flow/velocity", velocity, "m/s"), ("/flow/acceleration", acceleration, "m/s2"),
                                     ("/flow/wet", wet, "-")):
                dataset = f.create_dataset(name, data=data, chunks=data.shape, fletcher32=True)
                dataset.attrs.create("units", unit.encode(), dtype=f"S{len(unit)}")
        os.rename(path + ".tmp", path)


def standing_wave(height, period, depth, x_wall, still_water_ahead_of=None):
    """Linear standing wave in front of a wall at x_wall: what a caisson makes of regular waves of that height."""
    g, omega = 9.81, 2 * np.pi / period
    k = omega**2 / g
    for _ in range(200):
        k = omega**2 / (g * np.tanh(k * depth))

    def motion(t, X, Z):
        ramp = min(1.0, max(t, 0.0) / period)
        level = height * np.cos(k * (X - x_wall)) * np.cos(omega * t) * ramp
        z = np.minimum(Z, 0.0)
        scale = height * omega * ramp * np.cosh(k * (z + depth)) / np.sinh(k * depth)
        rise = height * omega * ramp * np.sinh(k * (z + depth)) / np.sinh(k * depth)
        shape_u, shape_w = np.sin(k * (X - x_wall)), np.cos(k * (X - x_wall))
        u, w = -scale * shape_u * np.sin(omega * t), -rise * shape_w * np.sin(omega * t)
        du, dw = -scale * omega * shape_u * np.cos(omega * t), -rise * omega * shape_w * np.cos(omega * t)
        wet = np.clip(0.5 - (Z - level) / 0.02, 0.0, 1.0)
        return u, w, du, dw, wet

    return motion
