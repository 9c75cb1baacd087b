"""The default build gives the same bytes on other processors, and one clear line on those that lack its instructions.

The other machines are qemu's: an Intel Haswell and an AMD EPYC, whose libraries choose their code by what these have
(GNU libm, libcrypto, memcpy), and an Intel Nehalem, which has no AVX2.
"""
import os
import platform
import shutil
import subprocess

from harness import BIN, SCENES, Failure, check, check_same_bytes, main, test

CHAIN = [("boussinesq", "waves", []), ("cmps", "flow", ["--waves", "waves"]), ("dem", "blocks", ["--flow", "flow"])]


def emulated(processor, *command):
    return subprocess.run(["qemu-x86_64", "-cpu", processor, *map(str, command)], capture_output=True, text=True,
                          env={**os.environ, "OMP_WAIT_POLICY": "passive"})


def run_chain(folder, start):
    """The small scene until its blocks feel the waves' first push, by programs that `start` runs."""
    for program, out, upstream in CHAIN:
        words = [folder / word if word in ("waves", "flow") else word for word in upstream]
        ended = start(BIN / program, "run", SCENES / "small.toml", "--set", "time.end=4.0", "--out", folder / out, "--quiet", *words)
        if ended.returncode != 0:
            raise Failure(f"{program}: exit {ended.returncode}: {ended.stderr}")


def is_x86_64_build():
    flags = subprocess.run([BIN / "cmps", "--version"], capture_output=True, text=True).stdout
    return platform.machine() == "x86_64" and "-march=x86-64-v3" in flags and shutil.which("qemu-x86_64") is not None


@test
def same_bytes_on_two_other_processors(folder):
    run_chain(folder / "here", lambda *command: subprocess.run(list(map(str, command)), capture_output=True, text=True))
    for processor in ("Haswell", "EPYC"):
        run_chain(folder / processor, lambda *command: emulated(processor, *command))
        for _, out, _ in CHAIN:
            check_same_bytes(folder / "here" / out, folder / processor / out)
        print(f"    {processor}: the same bytes in waves, flow and blocks")


@test
def a_processor_without_the_instructions_is_told_in_one_line(folder):
    for program in ("boussinesq", "cmps", "dem", "coupler"):
        ended = emulated("Nehalem", BIN / program, "--version")
        lines = ended.stderr.splitlines()
        check(ended.returncode == 1 and len(lines) == 1 and "x86-64-v3" in lines[0], f"{program}: exit {ended.returncode}: {ended.stderr}")


if __name__ == "__main__":
    if not is_x86_64_build():
        print("not the default build on an x86-64 machine with qemu-user: nothing to compare")
        raise SystemExit(77)
    main()
