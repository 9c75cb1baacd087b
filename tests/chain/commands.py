"""The set-up script and the rules of workflows/Makefile, with stand-ins for what they start."""
import os
import shutil
import subprocess

from harness import SOURCE, check, environment, main, test

STAGE = """#!/bin/sh
echo "$(basename $0) $*" >> {log}
while [ $# -gt 0 ]; do if [ "$1" = --out ]; then mkdir -p $2; echo '{{}}' > $2/run.json; fi; shift; done
"""


class Workbench:
    """Stand-in stages that note how they were called, a scene and two layouts."""

    def __init__(self, folder):
        self.folder, self.log = folder, folder / "log"
        (folder / "bin").mkdir()
        for name in ("boussinesq", "cmps", "dem", "coupler"):
            path = folder / "bin" / name
            path.write_text(STAGE.format(log=self.log))
            path.chmod(0o755)
        for name in ("scene", "first", "second"):
            (folder / f"{name}.toml").write_text("")

    def call(self, *words):
        """Runs make as typed in the bench's folder; the stages started are in the log."""
        self.log.write_text("")
        return subprocess.run(["make", "-C", SOURCE / "workflows", f"BIN={self.folder}/bin", "SCENE=scene.toml", "OUT=out",
                               *words], capture_output=True, text=True, cwd=self.folder,
                              env=environment(PWD=str(self.folder), MAKEFLAGS=""))

    def make(self, *words):
        """Runs make and returns the stages it started, in order: ["boussinesq run ...", ...]."""
        ended = self.call(*words)
        check(ended.returncode == 0, ended.stderr)
        check("overriding recipe" not in ended.stderr, ended.stderr)
        return self.log.read_text().splitlines()

    def refused(self, *words):
        """Runs make, which must start nothing and say why in one line; returns the line."""
        ended = self.call(*words)
        lines = ended.stderr.splitlines()
        check(ended.returncode != 0 and len(lines) == 1, f"status {ended.returncode}: {ended.stderr}")
        check(self.log.read_text() == "", "something ran")
        return lines[0]

    def touch(self, name):
        later = max(path.stat().st_mtime for path in self.folder.rglob("*")) + 1
        os.utime(self.folder / name, (later, later))


def programs(calls):
    return [call.split()[0] for call in calls]


@test
def only_what_changed_runs_again(folder):
    bench = Workbench(folder)
    check(programs(bench.make("flow")) == ["boussinesq", "cmps"], "flow needs waves first")
    check(bench.make("flow") == [], "nothing changed, yet something ran")
    check(programs(bench.make("blocks")) == ["dem"], "blocks run on the flow that is there")
    check(bench.make("waves", "flow", "blocks") == [], "nothing changed, yet something ran")
    bench.touch("scene.toml")
    check(programs(bench.make("flow")) == ["boussinesq", "cmps"], "the scene changed")
    calls = bench.make("flow", "SET=accuracy=draft waves.height=0.1")
    check(programs(calls) == ["boussinesq", "cmps"], "the settings changed")
    check(all("--set accuracy=draft --set waves.height=0.1" in call for call in calls), calls)


@test
def layouts_have_folders_of_their_own_and_share_one_flow(folder):
    bench = Workbench(folder)
    bench.make("flow")
    calls = bench.make("-j2", "blocks", "WIRES=first.toml second.toml")
    check(programs(calls) == ["dem", "dem"], calls)
    for name in ("first", "second"):
        check(any(f"--wires {folder}/{name}.toml --out {folder}/out/blocks_{name}" in call for call in calls), calls)
    check(all(f"--flow {folder}/out/flow" in call for call in calls), calls)
    bench.touch("second.toml")
    calls = bench.make("-j2", "blocks", "WIRES=first.toml second.toml")
    check(len(calls) == 1 and "second" in calls[0], calls)


@test
def a_sweep_shares_the_flow_where_it_can(folder):
    bench = Workbench(folder)
    sweep = "SWEEP=waves.height=0.1 waves.height=0.2 dem.friction=0.4"
    calls = bench.make("-j2", "sweep", sweep, "SET=accuracy=draft")
    check(sorted(programs(calls)) == ["boussinesq"] * 3 + ["cmps"] * 3 + ["dem"] * 3, calls)
    friction = [call for call in calls if "dem.friction=0.4" in call]
    check(len(friction) == 1 and f"--flow {folder}/out/flow --out {folder}/out/dem.friction=0.4/blocks" in friction[0], calls)
    high = [call for call in calls if "waves.height=0.2" in call]
    check(len(high) == 3 and f"--flow {folder}/out/waves.height=0.2/flow" in high[2], calls)
    check(all("--set accuracy=draft" in call for call in calls), calls)
    check(bench.make("-j2", "sweep", sweep, "SET=accuracy=draft") == [], "nothing changed, yet something ran")


@test
def a_sweep_runs_every_layout_on_every_setting(folder):
    bench = Workbench(folder)
    calls = bench.make("-j2", "sweep", "SWEEP=waves.height=0.1 dem.friction=0.4", "WIRES=first.toml second.toml")
    blocks = [call for call in calls if call.startswith("dem")]
    for setting in ("waves.height=0.1", "dem.friction=0.4"):
        for layout in ("first", "second"):
            words = f"--wires {folder}/{layout}.toml --out {folder}/out/{setting}/blocks_{layout} --set {setting}"
            check(sum(words in call for call in blocks) == 1, calls)
    check(len(blocks) == 4, calls)


@test
def a_folder_may_have_an_equals_sign(folder):
    bench = Workbench(folder)
    calls = bench.make("flow", "blocks", "OUT=a=b", "WIRES=first.toml")
    check(programs(calls) == ["boussinesq", "cmps", "dem"], calls)
    check(f"--wires {folder}/first.toml --out {folder}/a=b/blocks_first" in calls[2], calls)
    check(bench.make("flow", "blocks", "OUT=a=b", "WIRES=first.toml") == [], "nothing changed, yet something ran")


@test
def layouts_of_one_name_are_refused(folder):
    """Both would be run into blocks_case, or only one of them without a word."""
    bench = Workbench(folder)
    for name in ("a", "b"):
        (folder / name).mkdir()
        (folder / name / "case.toml").write_text("")
    line = bench.refused("blocks", "WIRES=a/case.toml b/case.toml")
    check(f"{folder}/a/case.toml {folder}/b/case.toml" in line and "blocks_case" in line, line)
    calls = bench.make("blocks", f"WIRES=a/case.toml {folder}/a/case.toml ./a/case.toml")
    check(len(calls) == 1, f"one layout named in three ways is one run: {calls}")
    line = bench.refused("blocks", "WIRES=b/case.toml")
    check(f"holds the run of {folder}/a/case.toml" in line and f"{folder}/out/.blocks_case" in line, line)
    (folder / "out/.blocks_case").unlink()
    check(len(bench.make("blocks", "WIRES=b/case.toml")) == 1, "not run after its remedy")
    line = bench.refused("chain", "WIRES=first.toml second.toml")
    check("one layout" in line and "blocks" in line, line)


@test
def paths_that_make_cannot_hold_are_refused_by_name(folder):
    bench = Workbench(folder)
    spaced = folder / "my runs"
    spaced.mkdir()
    (spaced / "scene.toml").write_text("")
    for goal in ("flow", "blocks", "chain", "plots", "cost"):
        line = bench.refused(goal, f"SCENE={spaced}/scene.toml")
        check(f'SCENE is "{spaced}/scene.toml"' in line and "spaces" in line and "link" in line, line)
    line = bench.refused("flow", f"OUT={spaced}/out")
    check(f'OUT is "{spaced}/out"' in line and "spaces" in line, line)
    line = bench.refused("blocks", f"WIRES={spaced}/scene.toml")
    check("WIRES" in line and str(folder / "my") in line, line)
    for mark in (":", "#", "%", "*", "'", "("):
        line = bench.refused("flow", f"OUT={folder}/a{mark}b")
        check(f'OUT is "{folder}/a{mark}b"' in line and f'"{mark}"' in line, line)
    line = bench.refused("sweep", "SWEEP=dem.blocks.origin=[1,2]")
    check("SWEEP" in line and "SET" in line, line)


@test
def cost_of_a_scene_is_the_study_of_that_scene_alone(folder):
    bench = Workbench(folder)
    ended = bench.call("-n", "cost")
    studies = [word.rpartition("/")[2] for word in ended.stdout.split() if "/studies/" in word and word.endswith(".py")]
    check(ended.returncode == 0 and studies == ["cost_scene.py"], ended.stdout + ended.stderr)
    check(f"--scene {folder}/scene.toml" in ended.stdout, ended.stdout)
    line = bench.refused("stability")
    check("stability" in line and "SCENE" in line, line)
    for word in ("SET=waves.height=0.2", "WIRES=first.toml"):
        line = bench.refused("cost", word)
        check("SET" in line and "WIRES" in line, line)
    line = bench.refused("cost", "RECORD=1")
    check("RECORD" in line, line)


@test
def studies_of_built_in_cases_need_no_scene(folder):
    ended = subprocess.run(["make", "-n", "-C", SOURCE / "workflows", f"BIN={folder}", "cost", "RECORD=1"], capture_output=True,
                           text=True, env=environment(MAKEFLAGS=""))
    studies = [word.rpartition("/")[2] for word in ended.stdout.split() if "/studies/" in word and word.endswith(".py")]
    check(studies == ["cost_boussinesq.py", "cost_cmps.py", "cost_dem.py"], ended.stdout + ended.stderr)
    check("--scene" not in ended.stdout, ended.stdout)
    check("cost_cmps*.csv" in ended.stdout and "results/studies" in ended.stdout, "RECORD=1 does not keep the tables")


@test
def launch_stands_before_every_stage(folder):
    bench = Workbench(folder)
    launcher = folder / "launcher"
    launcher.write_text(f"#!/bin/sh\necho launched >> {bench.log}\nexec \"$@\"\n")
    launcher.chmod(0o755)
    calls = bench.make("-j2", "flow", f"LAUNCH={launcher}")
    check(programs(calls) == ["launched", "boussinesq", "launched", "cmps"], calls)


@test
def a_file_that_is_not_there_is_named(folder):
    ended = subprocess.run(["make", "-C", SOURCE / "workflows", "waves", "SCENE=absent.toml"], capture_output=True, text=True,
                           env=environment(MAKEFLAGS=""))
    check(ended.returncode != 0 and "no such file: absent.toml" in ended.stderr, ended.stderr)


def set_up(folder, packages, user):
    """Runs workflows/set_up on a list of packages as if called by `user` (numeric id)."""
    shutil.copy(SOURCE / "workflows/set_up", folder)
    (folder / "packages").write_text(packages)
    stand_ins = folder / "stand_ins"
    stand_ins.mkdir(exist_ok=True)
    for name, text in (("id", f"echo {user}"), ("apt-get", f"echo apt-get $* >> {folder}/log")):
        (stand_ins / name).write_text(f"#!/bin/sh\n{text}\n")
        (stand_ins / name).chmod(0o755)
    return subprocess.run([folder / "set_up"], capture_output=True, text=True,
                          env=environment(PATH=f"{stand_ins}:{os.environ['PATH']}"))


@test
def set_up_does_nothing_when_nothing_is_missing(folder):
    ended = set_up(folder, (SOURCE / "workflows/packages").read_text(), 1000)
    check(ended.returncode == 0 and not ended.stdout + ended.stderr, ended.stdout + ended.stderr)


@test
def set_up_asks_an_administrator_without_root(folder):
    ended = set_up(folder, "# comment\nmake\nno-such-package\n", 1000)
    check(ended.returncode == 1 and "apt-get install --no-install-recommends no-such-package" in ended.stderr, ended.stderr)
    check(not (folder / "log").exists(), "apt-get was called without root")


@test
def set_up_takes_either_of_two_packages(folder):
    ended = set_up(folder, "no-such-package | make\nmake | no-such-package\n", 1000)
    check(ended.returncode == 0 and not ended.stdout + ended.stderr, ended.stdout + ended.stderr)
    ended = set_up(folder, "no-such-package | nor-this-one\n", 1000)
    check(ended.stderr.rstrip().endswith("--no-install-recommends no-such-package"), ended.stderr)


@test
def set_up_installs_what_is_missing_as_root(folder):
    ended = set_up(folder, "make\nno-such-package\n", 0)
    check(ended.returncode == 0, ended.stderr)
    check((folder / "log").read_text().splitlines()[-1].endswith(" no-such-package"), (folder / "log").read_text())


main()
