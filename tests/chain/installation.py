"""What `cmake --install` and `cpack` leave works from where it stands: programs, scenes, layouts, Makefile and Python reader."""
import os
import shutil
import subprocess
import sys

from harness import BIN, SOURCE, Failure, check, main, test

BUILD = BIN.parent


def finish(*command, **options):
    ended = subprocess.run(list(map(str, command)), capture_output=True, text=True, **options)
    if ended.returncode != 0:
        raise Failure(f"{' '.join(map(str, command))}: exit {ended.returncode}\n{ended.stdout}{ended.stderr}")
    return ended.stdout


def expect_working(prefix, folder):
    """The small scene's waves by the installed Makefile, and their gauge by the installed reader."""
    share = prefix / "share/tsunagi"
    out = folder / "out"
    environment = {key: value for key, value in os.environ.items() if key != "BIN"}
    finish("make", "-C", share, "waves", f"OUT={out}", "SCENE=scenes/small.toml", "SET=time.end=2.0", env={**environment, "PWD": str(folder)})
    script = (f"import sys; sys.path.insert(0, {str(share)!r}); import run_folder; "
              f"time, elevation = run_folder.gauge({str(out / 'waves')!r}, 'link'); print(len(time), abs(elevation).max())")
    samples, largest = finish(sys.executable, "-B", "-c", script, cwd=folder).split()
    check(int(samples) > 50 and float(largest) > 0, f"gauge read by the installed reader: {samples} samples, largest {largest}")
    finish(prefix / "bin/coupler", "--version")
    for installed, source in (("layouts", SOURCE / "workflows/layouts"), ("scenes", SOURCE / "workflows/scenes"), ("shapes", SOURCE / "dem/shapes")):
        there, here = ({path.name: path.read_bytes() for path in folder_.iterdir()} for folder_ in (share / installed, source))
        check(there == here, f"{installed}: {len(there)} files, {len(here)} in the sources")


@test
def installed_by_cmake(folder):
    finish("cmake", "--install", BUILD, "--prefix", folder / "prefix")
    expect_working(folder / "prefix", folder)


@test
def packed_for_debian(folder):
    if shutil.which("dpkg-shlibdeps") is None:
        raise Failure("dpkg-shlibdeps is missing: package dpkg-dev")
    finish("cpack", "-G", "DEB", "-B", folder, "--config", BUILD / "CPackConfig.cmake", cwd=folder)
    package = next(folder.glob("tsunagi_*.deb"))
    needs = finish("dpkg-deb", "-f", package, "Depends")
    check("libhdf5" in needs and "libgsl" in needs, f"the package depends on the libraries it uses: {needs}")
    # What a system's apt says to it, without installing: every dependency can be had here.
    finish("apt-get", "install", "--simulate", package)
    finish("dpkg-deb", "-x", package, folder / "root")
    expect_working(folder / "root/usr", folder)


main()
