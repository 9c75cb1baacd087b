"""Windows of waves that are sampled too coarsely are refused, by `check` and `run`; what is lost below that is told and kept in run.json."""
import os
import shutil
import subprocess

from cmps_program import FOLDER, PROGRAM, Run, expect, finish
from cmps_waves import write_waves

SCENE = """[time]
end = 3.0
window = 1.0
[flume]
bed = [[0.0, -0.4], [40.0, -0.4]]
[waves]
kind = "regular"
height = 0.1
period = 1.65
[cmps]
offshore = 25.0
onshore = 28.0
particle_spacing = 0.08
"""


def waves_of(interval):
    folder = os.path.join(FOLDER, f"waves_{interval}")
    write_waves(folder, 0.1, 1.65, 0.4, 24, 30, 3, window=1.0, interval=interval)
    return folder


def check(run, waves):
    done = subprocess.run([PROGRAM, "check", run.path, "--waves", waves], capture_output=True, text=True)
    return done.returncode, done.stdout + done.stderr


coarse = Run("coarse", SCENE, waves=waves_of(0.5))
expect(coarse.status == 2 and "3.3 samples a wave" in coarse.messages and "expected at most" in coarse.messages,
       f"3.3 samples a wave: exit {coarse.status}, {coarse.messages.strip()}")
expect(check(coarse, waves_of(0.5))[0] == 2, "check refuses them too")
told = Run("told", SCENE, waves=waves_of(0.2))
note = told.record.get("notes", {}).get("waves", {}).get("sampling", "")
expect(told.status == 0 and "8.25 samples a wave" in note, f"8.25 samples a wave: exit {told.status}, in run.json: {note}")
loud = subprocess.run([PROGRAM, "run", told.path, "--waves", waves_of(0.2), "--out", told.out + "_loud"], capture_output=True, text=True)
expect(loud.stderr.count("8.25 samples a wave") == 1, "told once")
status, text = check(told, waves_of(0.2))
expect(status == 0 and "8.25 samples a wave" in text, "check tells it too")
quiet = Run("quiet", SCENE, waves=waves_of(0.025))
expect(quiet.status == 0 and "samples a wave" not in quiet.messages, "66 samples a wave: not a word")
mixed = os.path.join(FOLDER, "waves_mixed")
shutil.copytree(waves_of(0.025), mixed)
shutil.copy(os.path.join(waves_of(0.5), "window_000002.h5"), mixed)
run = Run("mixed", SCENE, waves=mixed)
expect(run.status == 2 and "window_000002.h5" in run.messages and "between two samples" in run.messages,
       f"a later window that is coarser: exit {run.status}, {run.messages.strip()}")
finish()
