"""What the coupler does when a stage fails, is killed, hangs or is interrupted: shown with stand-in stages.

Each stand-in is a shell script beside a copy of the coupler; it answers `check` and, as `run`, writes a run.json and then
does what the test asks.
"""
import json
import os
import pathlib
import shutil
import signal
import subprocess

from harness import BIN, check, check_below, environment, main, test, wait_for

SCENE = "[time]\nend = 1.0\n[cmps]\n[dem]\n"
RECORD = json.dumps({"stage": "s", "status": "running", "message": "", "scene_digest": "", "input_digest": "",
                     "windows": 0, "wall_time": 0.0, "cpu_time": 0.0, "peak_memory": 0.0, "invariants": {}})
WORKS_ON = "while :; do sleep 0.05; done"


def stand_ins(folder, **bodies):
    """A folder of programs: the real coupler, and stages that run the given shell text (default: end well)."""
    programs = folder / "programs"
    programs.mkdir()
    shutil.copy(BIN / "coupler", programs)
    for name in ("boussinesq", "cmps", "dem"):
        path = programs / name
        path.write_text(f"""#!/bin/bash
if [ "$1" = check ]; then {bodies.get(name + "_check", "exit 0")}; fi
while [ "$1" != --out ]; do shift; done
trap 'echo "{name}: interrupted" >&2; exit 130' INT TERM
mkdir -p "$2" && echo '{RECORD}' > "$2/run.json.tmp" && mv "$2/run.json.tmp" "$2/run.json"
{bodies.get(name, "exit 0")}
""")
        path.chmod(0o755)
    (folder / "scene.toml").write_text(SCENE)
    return programs


def start_chain(folder, programs, **options):
    return subprocess.Popen([programs / "coupler", "run", folder / "scene.toml", "--out", folder / "chain"], text=True,
                            stdout=subprocess.PIPE, stderr=subprocess.PIPE, env=environment(), **options)


def wait_for_stages(folder):
    wait_for(lambda: all((folder / "chain" / part / "run.json").exists() for part in ("waves", "flow", "blocks")), 60, "all stages to stand")


def end_of(chain, timeout=120):
    output, messages = chain.communicate(timeout=timeout)
    return chain.returncode, messages


def record(folder):
    return json.loads((folder / "chain/chain.json").read_text())


def statuses(folder):
    return [stage["status"] for stage in record(folder)["stages"]]


def process_ids(folder):
    """Stages that still run: their command lines name this test's folder."""
    found = []
    for path in pathlib.Path("/proc").glob("[0-9]*/cmdline"):
        try:
            if str(folder / "programs").encode() in path.read_bytes():
                found.append(path.parent.name)
        except OSError:
            pass  # it ended while we looked
    return found


@test
def all_end_well(folder):
    status, messages = end_of(start_chain(folder, stand_ins(folder)))
    check(status == 0, f"status {status}: {messages}")
    check(record(folder)["status"] == "done", record(folder))
    check(statuses(folder) == ["done"] * 3, statuses(folder))


@test
def a_failing_stage_stops_the_others_and_is_named(folder):
    programs = stand_ins(folder, boussinesq=WORKS_ON, cmps="echo 'cmps: step 12: pressure is not finite' >&2; exit 1",
                         dem=WORKS_ON)
    status, messages = end_of(start_chain(folder, programs))
    check(status == 1, f"status {status}")
    lines = [line for line in messages.splitlines() if line.startswith("coupler:")]
    check(len(lines) == 1 and "cmps failed, exit status 1: step 12: pressure is not finite" in lines[0], messages)
    check(statuses(folder)[:2] == ["stopped", "failed"], statuses(folder))
    check(record(folder)["stages"][1]["message"] == "step 12: pressure is not finite", record(folder))
    check(not process_ids(folder), "stages still run")


@test
def bad_input_found_by_a_running_stage_gives_status_2(folder):
    programs = stand_ins(folder, cmps="echo 'cmps: waves do not cover the wall' >&2; exit 2")
    status, messages = end_of(start_chain(folder, programs))
    check(status == 2 and "waves do not cover the wall" in messages, f"status {status}: {messages}")


@test
def a_killed_stage_is_reported_as_killed(folder):
    programs = stand_ins(folder, boussinesq=WORKS_ON, cmps="kill -9 $$")
    status, messages = end_of(start_chain(folder, programs))
    check(status == 1 and "cmps failed, killed by signal 9" in messages, f"status {status}: {messages}")
    check(record(folder)["stages"][1]["signal"] == 9, record(folder))


@test
def the_first_cause_is_named_when_followers_fail_too(folder):
    programs = stand_ins(folder, boussinesq="sleep 0.3; kill -9 $$",
                         cmps="sleep 0.35; echo 'cmps: the boussinesq stage ended' >&2; exit 1", dem=WORKS_ON)
    status, messages = end_of(start_chain(folder, programs))
    check("boussinesq failed, killed by signal 9" in messages, messages)


@test
def control_c_is_passed_on(folder):
    chain = start_chain(folder, stand_ins(folder, boussinesq=WORKS_ON, cmps=WORKS_ON, dem=WORKS_ON))
    wait_for_stages(folder)
    chain.send_signal(signal.SIGINT)
    status, messages = end_of(chain)
    check(status == 130, f"status {status}: {messages}")
    check(statuses(folder) == ["interrupted"] * 3, statuses(folder))
    check(record(folder)["status"] == "interrupted", record(folder))
    check(not process_ids(folder), "stages still run")


@test
def control_c_on_a_terminal_reaches_all_at_once(folder):
    programs = stand_ins(folder, boussinesq=WORKS_ON, cmps=WORKS_ON, dem=WORKS_ON)
    chain = start_chain(folder, programs, start_new_session=True)
    wait_for_stages(folder)
    os.killpg(chain.pid, signal.SIGINT)
    status, messages = end_of(chain)
    check(status == 130, f"status {status}: {messages}")
    check(statuses(folder) == ["interrupted"] * 3, statuses(folder))


@test
def stages_do_not_outlive_a_killed_coupler(folder):
    chain = start_chain(folder, stand_ins(folder, boussinesq=WORKS_ON, cmps=WORKS_ON, dem=WORKS_ON))
    wait_for_stages(folder)
    chain.kill()
    end_of(chain)
    wait_for(lambda: not process_ids(folder), 60, "the stages to end")
    (folder / "scene.toml").unlink()
    status = subprocess.run([folder / "programs/coupler", "status", folder / "chain"], text=True, capture_output=True)
    check(status.returncode == 0 and status.stdout.splitlines()[0].count("died") == 1, status.stdout + status.stderr)
    check(status.stdout.count("died") == 4, f"not all stages are called dead: {status.stdout}")


@test
def an_unchanged_stage_keeps_the_cost_of_the_run_that_made_its_windows(folder):
    programs = stand_ins(folder, boussinesq="sleep 0.3; exit 0")
    end_of(start_chain(folder, programs))
    cost = record(folder)["stages"][0]["wall_time"]
    (programs / "boussinesq").write_text("#!/bin/sh\nexit 0\n")  # finished before: leaves run.json as it is
    end_of(start_chain(folder, programs))
    check(statuses(folder)[0] == "unchanged", statuses(folder))
    check(record(folder)["stages"][0]["wall_time"] == cost, record(folder)["stages"][0])


@test
def mistakes_seen_by_several_stages_are_told_once_and_nothing_starts(folder):
    complaint = "echo 'NAME: scene.toml:2: time.end: expected a number' >&2; exit 2"
    programs = stand_ins(folder, boussinesq_check=complaint.replace("NAME", "boussinesq"),
                         cmps_check=complaint.replace("NAME", "cmps"),
                         dem_check="echo 'dem: scene.toml:4: dem.rows: expected a whole number' >&2; exit 2")
    status, messages = end_of(start_chain(folder, programs))
    check(status == 2, f"status {status}")
    check(len(messages.splitlines()) == 2 and "time.end" in messages and "dem.rows" in messages, messages)
    check(not (folder / "chain").exists(), "the output folder was made")


@test
def a_follower_starts_after_the_stage_before_has_shown_itself(folder):
    old = folder / "chain/waves"
    old.mkdir(parents=True)
    (old / "run.json").write_text(RECORD.replace("running", "failed"))
    programs = stand_ins(folder, cmps=f"grep -q running {old}/run.json || exit 1")
    script = (programs / "boussinesq").read_text().replace("mkdir -p", "sleep 0.5; mkdir -p")
    (programs / "boussinesq").write_text(script)
    status, messages = end_of(start_chain(folder, programs))
    check(status == 0, f"cmps saw the run.json of an earlier run: {messages}")


@test
def one_chain_a_folder(folder):
    programs = stand_ins(folder, boussinesq=WORKS_ON, cmps=WORKS_ON, dem=WORKS_ON)
    first = start_chain(folder, programs)
    wait_for((folder / "chain/blocks/run.json").exists, 10, "the first chain")
    status, messages = end_of(start_chain(folder, programs))
    check(status == 2 and "another chain is running here" in messages, f"status {status}: {messages}")
    check(statuses(folder) == ["running"] * 3, "the first chain was disturbed")
    first.send_signal(signal.SIGINT)
    end_of(first)


@test
def a_missing_program_is_named(folder):
    programs = stand_ins(folder)
    os.remove(programs / "dem")
    status, messages = end_of(start_chain(folder, programs))
    check(status == 1 and f"cannot start {programs}/dem: No such file" in messages, f"status {status}: {messages}")


main()
