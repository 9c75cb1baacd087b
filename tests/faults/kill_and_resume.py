"""A run that is killed, interrupted or out of disk goes on with --resume and ends with the same bytes."""
import os
import resource
import shutil
import signal

from harness import (SCENES, check, check_below, check_same_bytes, digests, main, run, run_folder, start, test, wait_for)
import time

SCENE = SCENES / "small.toml"
# Short windows, so that there are many instants to be killed at; the waves have just reached the blocks at the end.
SHORT = ("--set", "time.end=4.5", "--set", "time.window=0.25")
_whole = None


def whole_chain(folder):
    """The uninterrupted run, computed once."""
    global _whole
    if _whole is None:
        _whole = folder.parent / (folder.name + "_whole")
        run("coupler", "run", SCENE, "--out", _whole, *SHORT).expect_done()
    return _whole


def stages(whole, folder):
    """(program, arguments, folder of the uninterrupted run): each stage alone on finished input."""
    yield "boussinesq", ("run", SCENE, *SHORT, "--out", folder / "boussinesq"), whole / "waves"
    yield "cmps", ("run", SCENE, *SHORT, "--waves", whole / "waves", "--out", folder / "cmps"), whole / "flow"
    yield "dem", ("run", SCENE, *SHORT, "--flow", whole / "flow", "--out", folder / "dem"), whole / "blocks"


def stop_after(windows, program, arguments, out, number):
    """Starts a stage and sends it a signal once it has published `windows` windows. False: it was faster."""
    process = start(program, *arguments)
    path = out / f"window_{windows - 1:06d}.h5"
    wait_for(lambda: path.exists() or process.poll() is not None, 300, path)
    process.send_signal(number)
    _, messages = process.communicate(timeout=60)
    return process.returncode, messages


def count(folder):
    return len(run_folder.window_paths(folder))


@test
def a_damaged_finished_run_is_computed_again(folder):
    whole = whole_chain(folder)
    out = folder / "boussinesq"
    shutil.copytree(whole / "waves", out)
    path = run_folder.window_paths(out)[2]
    path.write_bytes(path.read_bytes()[:1000])
    run("boussinesq", "run", SCENE, *SHORT, "--out", out, "--resume").expect_done()
    check_same_bytes(out, whole / "waves")


@test
def killed_stages_go_on_to_the_same_bytes(folder):
    whole = whole_chain(folder)
    for program, arguments, reference in stages(whole, folder):
        out = folder / program
        killed_at = []
        for windows in range(1, count(reference), max(1, count(reference) // 4)):
            stop_after(windows, program, arguments + ("--resume",), out, signal.SIGKILL)
            killed_at.append(count(out))
        run(program, *arguments, "--resume").expect_done()
        check_same_bytes(out, reference)
        check(min(killed_at) < count(reference), f"{program} was never killed before its end")
        check(not list(out.glob(".*.tmp")), "temporary files were left")
        print(f"    {program}: killed after {killed_at} of {count(reference)} windows, same bytes")


@test
def resume_from_any_window_gives_the_same_bytes(folder):
    """The state after each window is enough: every stage is interrupted once in each of its windows."""
    whole = whole_chain(folder)
    for program, arguments, reference in stages(whole, folder):
        out, interruptions = folder / program, 0
        for windows in range(1, count(reference)):
            status, _ = stop_after(windows, program, arguments + ("--resume",), out, signal.SIGINT)
            interruptions += status == 130
        run(program, *arguments, "--resume").expect_done()
        check_same_bytes(out, reference)
        check(interruptions > 0, f"{program} was never interrupted")
        print(f"    {program}: {interruptions} interruptions, same bytes")


@test
def a_killed_stage_fails_the_chain_which_then_goes_on(folder):
    whole, chain = whole_chain(folder), folder / "chain"
    process = start("coupler", "run", SCENE, *SHORT, "--out", chain)
    wait_for(lambda: (chain / "flow/window_000001.h5").exists() or process.poll() is not None, 300, "flow")
    os.kill(run_folder.read_run(chain / "flow")["pid"], signal.SIGKILL)
    _, messages = process.communicate(timeout=120)
    check(process.returncode == 1 and "cmps failed, killed by signal 9" in messages, messages)
    run("coupler", "run", SCENE, *SHORT, "--out", chain, "--resume").expect_done()
    for part in ("waves", "flow", "blocks"):
        check_same_bytes(chain / part, whole / part)
    run("coupler", "verify", chain).expect_done()


@test
def control_c_keeps_what_was_finished(folder):
    whole = whole_chain(folder)
    for program, arguments, reference in stages(whole, folder):
        status, messages = stop_after(1, program, arguments, folder / program, signal.SIGINT)
        check(status in (130, 0), f"{program} ended with {status}: {messages}")
        check(status == 0 or messages.count("\n") >= 1 and "interrupted" in messages, messages)
        first = digests(folder / program)
        same = digests(reference)
        check(first and all(same[name] == first[name] for name in first), f"{program}: a window differs")
        if status == 130:
            check(run_folder.read_run(folder / program)["status"] == "interrupted", "run.json does not say so")


@test
def control_c_on_the_chain_then_resume(folder):
    whole, chain = whole_chain(folder), folder / "chain"
    process = start("coupler", "run", SCENE, *SHORT, "--out", chain)
    wait_for(lambda: (chain / "flow/window_000000.h5").exists() or process.poll() is not None, 300, "flow")
    begun = time.monotonic()
    process.send_signal(signal.SIGINT)
    _, messages = process.communicate(timeout=120)
    check(process.returncode == 130, f"status {process.returncode}: {messages}")
    check_below("time to stop", time.monotonic() - begun, 20, "s", "a step of each stage, on a loaded machine")
    run("coupler", "run", SCENE, *SHORT, "--out", chain, "--resume").expect_done()
    for part in ("waves", "flow", "blocks"):
        check_same_bytes(chain / part, whole / part)


@test
def a_full_disk_loses_nothing_published(folder):
    """A file-size limit below a window's size makes writing fail as a full disk does, without root."""
    whole = whole_chain(folder)
    for program, arguments, reference in stages(whole, folder):
        out = folder / program
        stop_after(1, program, arguments, out, signal.SIGINT)
        before = digests(out)
        if count(out) == count(reference):
            shutil.rmtree(out)
            before = {}
        limit = min(path.stat().st_size for path in run_folder.window_paths(reference)) // 2

        def limit_files():
            resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit))

        ended = run(program, *arguments, "--resume", preexec_fn=limit_files)
        ended.expect_error(1, str(out), "File too large")
        print(f"    {ended.stderr.strip().replace(str(folder) + '/', '')}")
        check(digests(out) == before, f"{program}: published windows changed")
        check(not list(out.glob(".*.tmp")), f"{program} left temporary files")
        run(program, *arguments, "--resume").expect_done()
        check_same_bytes(out, reference)


@test
def two_runs_in_one_folder(folder):
    whole = whole_chain(folder)
    for program, arguments, reference in stages(whole, folder):
        out = folder / program
        first = start(program, *arguments)
        wait_for(lambda: (out / ".lock").exists() or first.poll() is not None, 60, "the first run")
        second = run(program, *arguments)
        if first.poll() is None:
            second.expect_error(2, str(out), "another run")
        first.communicate(timeout=300)
        check(first.returncode == 0, f"the first {program} was disturbed")
        check_same_bytes(out, reference)


@test
def a_finished_run_is_not_run_again_and_another_scene_is_not_reused(folder):
    chain = folder / "chain"
    shutil.copytree(whole_chain(folder), chain)
    before = {path: path.stat().st_mtime_ns for part in ("waves", "flow", "blocks")
              for path in run_folder.window_paths(chain / part)}
    run("coupler", "run", SCENE, *SHORT, "--out", chain).expect_done()
    check(all(path.stat().st_mtime_ns == before[path] for path in before), "windows were written again")
    run("coupler", "run", SCENE, *SHORT, "--set", "dem.friction=0.4", "--out", chain).expect_done()
    changed = {path.parent.name for path in before if path.stat().st_mtime_ns != before[path]}
    check(changed == {"blocks"}, f"a change of dem's friction ran {changed} again")
    check(digests(chain / "blocks") != digests(_whole / "blocks"), "blocks did not change with friction")
    run("coupler", "verify", chain).expect_done()


try:
    main()
finally:
    if _whole is not None:
        shutil.rmtree(_whole, ignore_errors=True)
