"""Bad input to cmps: one clear line, exit 2, before anything is written."""
import os
import subprocess

from cmps_program import FOLDER, PROGRAM, expect, finish
from cmps_waves import write_waves

GOOD = {
    "time": "end = 4.0\nwindow = 1.0",
    "flume": "bed = [[0.0, -0.4], [40.0, -0.4]]",
    "cmps": "offshore = 25.0\nonshore = 31.0\nparticle_spacing = 0.05",
    "cmps.flow": "x = [29.0, 30.0]\nz = [-0.4, 0.1]",
}


def attempt(name, waves, **changes):
    sections = {key.replace("__", "."): value for key, value in changes.items()}
    text = "".join(f"[{key}]\n{sections.get(key, value)}\n" for key, value in GOOD.items())
    path, out = os.path.join(FOLDER, name + ".toml"), os.path.join(FOLDER, name + "_out")
    with open(path, "w") as file:
        file.write(text)
    done = subprocess.run([PROGRAM, "run", path, "--waves", waves, "--out", out, "--quiet"], capture_output=True, text=True)
    written = os.path.exists(out) and any(name.startswith("window") for name in os.listdir(out))
    return done.returncode, done.stderr.strip(), written


waves = os.path.join(FOLDER, "waves")
write_waves(waves, 0.06, 1.65, 0.4, 24, 30, 4.0, window=1.0)
elsewhere = os.path.join(FOLDER, "elsewhere")
write_waves(elsewhere, 0.06, 1.65, 0.4, 2, 8, 4.0, window=1.0)
short = os.path.join(FOLDER, "short")
write_waves(short, 0.06, 1.65, 0.4, 24, 30, 2.0, window=1.0)

wall = "offshore = 25.0\nonshore = 31.0\nparticle_spacing = 0.05\n"
cases = [
    ("crossing", waves, {"cmps": wall + "structure = [[[29.0, -0.4], [30.0, 0.2], [30.0, -0.4], [29.0, 0.2]]]"}, "crosses itself"),
    ("open", waves, {"cmps": wall + "structure = [[[29.0, -0.4], [30.0, 0.2]]]"}, "at least 3"),
    ("inside", waves, {"cmps": wall + "structure = [[[24.5, -0.4], [30.0, -0.4], [30.0, 0.2]]]"}, "stands in the structure"),
    ("coarse", waves, {"cmps": "offshore = 25.0\nonshore = 31.0\nparticle_spacing = 0.5"}, "too coarse"),
    ("ends", waves, {"cmps": "offshore = 31.0\nonshore = 25.0\nparticle_spacing = 0.05"}, "shoreward of cmps.offshore"),
    ("grid", waves, {"cmps__flow": "x = [20.0, 30.0]\nz = [-0.4, 0.1]"}, "leaves the near field"),
    ("unknown", waves, {"cmps": wall + "particel_spacing = 0.05"}, "particel_spacing"),
    ("word", waves, {"cmps": wall + 'gradient = "best"'}, "corrected"),
    ("elsewhere", elsewhere, {}, "cover x"),
    ("short", short, {}, "end at t = 2"),
    ("nowhere", os.path.join(FOLDER, "nothing"), {}, "no such folder"),
]
for name, folder, changes, phrase in cases:
    status, message, written = attempt(name, folder, **changes)
    expect(status == 2 and phrase in message and not written and len(message.splitlines()) == 1, f"{name}: exit {status}: {message}")
finish()
