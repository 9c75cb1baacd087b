"""The default build gives the same bytes on other processors, and one clear line on those that lack its instructions.

The other machines are qemu's: an Intel Haswell and an AMD EPYC, for which the libraries choose other code (memcpy, libm,
libcrypto), and an Intel Nehalem, which has no AVX2. They are some 200 times slower, so what runs on them is short.
"""
import os
import platform
import shutil
import subprocess

from harness import BIN, Failure, check, check_same_bytes, main, test, write_scene

SCENE = """
title = "A second of everything: waves that break on a slope, a column that falls, blocks that drop on a mound"
accuracy = "draft"
[time]
end = 1.0
window = 0.05
[flume]
bed = [[0.0, -0.30], [6.0, -0.30], [9.0, 0.10]]
[waves]
kind = "jonswap"
period = 1.2
height = 0.08
seed = 1
[boussinesq]
spacing = 0.1
[cmps]
drive = "none"
tank = [0.0, 1.0, 0.0, 1.0]
water = [[[0.0, 0.0], [0.4, 0.0], [0.4, 0.5], [0.0, 0.5]]]
particle_spacing = 0.05
[dem]
width = 0.2
young_modulus = 1e7
poisson_ratio = 0.3
friction = 0.577
[dem.blocks]
shape = "beehive24"
rows = 2
columns = 2
origin = [0.5, 0.025]
pitch = [0.05, 0.05]
[dem.mound]
profile = [[0.0, -0.3], [1.0, -0.3]]
roughness = 0.004
seed = 1
"""
# Every stage, and the near field also with enough particles for the multigrid: a few steps of those.
RUNS = {
    "waves": ["boussinesq", "run"],
    "column": ["cmps", "run", "--set", "time.end=0.2"],
    "fine_column": ["cmps", "run", "--set", "time.end=0.004", "--set", "time.window=0.002", "--set", "cmps.particle_spacing=0.01"],
    "blocks": ["dem", "pack"],
}


def run_all(folder, emulator):
    folder.mkdir()
    scene = write_scene(folder, SCENE)
    for name, (program, verb, *words) in RUNS.items():
        command = [*emulator, BIN / program, verb, scene, "--out", folder / name, "--quiet", *words]
        ended = subprocess.run(list(map(str, command)), capture_output=True, text=True, env={**os.environ, "OMP_WAIT_POLICY": "passive"})
        if ended.returncode != 0:
            raise Failure(f"{command}: exit {ended.returncode}: {ended.stderr}")


def is_x86_64_build():
    version = subprocess.run([BIN / "cmps", "--version"], capture_output=True, text=True).stdout
    return platform.machine() == "x86_64" and "-march=x86-64-v3" in version and shutil.which("qemu-x86_64") is not None


@test
def same_bytes_on_two_other_processors(folder):
    run_all(folder / "here", [])
    for processor in ("Haswell", "EPYC"):
        run_all(folder / processor, ["qemu-x86_64", "-cpu", processor])
        for name in RUNS:
            check_same_bytes(folder / "here" / name, folder / processor / name)
        print(f"    {processor}: the same bytes")


@test
def a_processor_without_the_instructions_is_told_in_one_line(folder):
    for program in ("boussinesq", "cmps", "dem", "coupler"):
        ended = subprocess.run(["qemu-x86_64", "-cpu", "Nehalem", str(BIN / program), "--version"], capture_output=True, text=True)
        lines = ended.stderr.splitlines()
        check(ended.returncode == 1 and len(lines) == 1 and "x86-64-v3" in lines[0], f"{program}: exit {ended.returncode}: {ended.stderr}")


if __name__ == "__main__":
    if not is_x86_64_build():
        print("not the default build on an x86-64 machine with qemu-user: nothing to compare")
        raise SystemExit(77)
    main()
