"""What file systems and terminals do to a run: no locks, files that cannot be read, a terminal that is closed."""
import errno
import json
import os
import signal
import subprocess

from harness import BIN, check, check_same_bytes, environment, main, run, run_folder, SCENES, start, test, wait_for

SCENE = SCENES / "small.toml"
SHORT = ("--set", "time.end=1.0", "--quiet")

# Stands between the programs and the system: flock fails with LOCK_ERROR, opening a file to be read whose name holds
# "window_000001" with OPEN_ERROR.
SHIM = """
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
int flock(int file, int operation) { (void)file; (void)operation; errno = atoi(getenv("LOCK_ERROR")); return -1; }
static int open_or_fail(const char *call, const char *name, int flags, int mode) {
    int (*real)(const char *, int, ...) = (int (*)(const char *, int, ...))dlsym(RTLD_NEXT, call);
    const char *error = getenv("OPEN_ERROR");
    if (error && (flags & O_ACCMODE) == O_RDONLY && strstr(name, "window_000001")) { errno = atoi(error); return -1; }
    return real(name, flags, mode);
}
#define OPEN(call) int call(const char *name, int flags, ...) { \\
    va_list list; va_start(list, flags); int mode = va_arg(list, int); va_end(list); \\
    return open_or_fail(#call, name, flags, mode); }
OPEN(open)
OPEN(open64)
"""


def run_with(folder, lock_error, *arguments, open_error=None):
    shim = folder / "shim.so"
    if not shim.exists():
        source = folder / "shim.c"
        source.write_text(SHIM)
        subprocess.run(["cc", "-shared", "-fPIC", "-U_FORTIFY_SOURCE", "-o", shim, source, "-ldl"], check=True)
    changes = {"LD_PRELOAD": str(shim), "LOCK_ERROR": str(lock_error)}
    if open_error:
        changes["OPEN_ERROR"] = str(open_error)
    program, *words = map(str, arguments)
    return subprocess.run([str(BIN / program), *words], capture_output=True, text=True, timeout=120,
                          env=environment(**changes))


@test
def a_file_system_without_locks(folder):
    """It is told, and the run goes on to the bytes of any other; what was written can be read there."""
    run("boussinesq", "run", SCENE, *SHORT, "--out", folder / "locks").expect_done()
    for error in (errno.ENOLCK, errno.ENOSYS, errno.EOPNOTSUPP):
        out = folder / f"waves_{error}"
        for again in (False, True):
            ended = run_with(folder, error, "boussinesq", "run", SCENE, *SHORT, "--out", out)
            check(ended.returncode == 0, f"errno {error}: {ended.stderr}")
            check(ended.stderr.count("has no locks") == 1 and len(ended.stderr.splitlines()) == 1, ended.stderr)
        check_same_bytes(out, folder / "locks")
    ended = run_with(folder, errno.EWOULDBLOCK, "boussinesq", "run", SCENE, *SHORT, "--out", folder / "locks")
    check(ended.returncode == 2 and "another run is running here" in ended.stderr, ended.stderr)
    ended = run_with(folder, errno.EIO, "boussinesq", "run", SCENE, *SHORT, "--out", folder / "locks")
    check(ended.returncode == 2 and "cannot lock" in ended.stderr and "another run" not in ended.stderr, ended.stderr)


@test
def a_file_that_cannot_be_read_is_not_damaged(folder):
    run("boussinesq", "run", SCENE, *SHORT, "--out", folder / "chain/waves").expect_done()
    for error in (errno.EACCES, errno.EIO):
        ended = run_with(folder, errno.ENOSYS, "coupler", "verify", folder / "chain", open_error=error)
        check(f"window_000001.h5: cannot be read: {os.strerror(error)}" in ended.stderr, ended.stderr)
        check("truncated" not in ended.stderr and ended.returncode == 1, ended.stderr)


@test
def a_terminal_that_is_closed(folder):
    """SIGHUP ends a run like Ctrl-C, and it can be resumed; a run under nohup goes on."""
    whole, out = folder / "whole", folder / "waves"
    words = ("run", SCENE, "--set", "time.end=30.0", "--quiet", "--out")
    run("boussinesq", *words, whole).expect_done()
    process = start("boussinesq", *words, out)
    wait_for(lambda: run_folder.window_paths(out) if out.is_dir() else False, 60, "the first window")
    process.send_signal(signal.SIGHUP)
    _, messages = process.communicate(timeout=60)
    check(process.returncode == 130 and "interrupted" in messages, f"status {process.returncode}: {messages}")
    check(json.loads((out / "run.json").read_text())["status"] == "interrupted", "run.json")
    run("boussinesq", *words, out, "--resume").expect_done()
    check_same_bytes(out, whole)
    ignoring = start("boussinesq", *words, folder / "ignoring",
                     preexec_fn=lambda: signal.signal(signal.SIGHUP, signal.SIG_IGN))
    wait_for(lambda: (folder / "ignoring/run.json").exists(), 60, "run.json")
    ignoring.send_signal(signal.SIGHUP)
    ignoring.communicate(timeout=120)
    check(ignoring.returncode == 0, f"status {ignoring.returncode}")


@test
def a_folder_that_never_fills(folder):
    """A follower says what it waits for."""
    (folder / "waves").mkdir()
    process = start("cmps", "run", SCENE, "--follow", "--waves", folder / "waves", "--out", folder / "flow")
    message = process.stderr.readline()
    process.send_signal(signal.SIGTERM)
    process.communicate(timeout=60)
    check("waits for window_000000.h5" in message and "has not started" in message, message)
    check(process.returncode == 130, f"status {process.returncode}")


main()
