"""Damaged, missing and foreign windows: the stage that reads them names file and fault, and nothing published is lost."""
import math
import json
import random
import resource
import shutil

import h5py

from harness import check, check_same_bytes, digests, main, run, run_folder, SCENES, test

SCENE = SCENES / "small.toml"
SHORT = ("--set", "time.end=4.5")  # the waves have just arrived: a few windows of every stage
_chain = None


def whole_chain(folder):
    """A finished chain, computed once; each test damages a copy."""
    global _chain
    if _chain is None:
        _chain = folder.parent / (folder.name + "_whole")
        run("coupler", "run", SCENE, "--out", _chain, *SHORT).expect_done()
        check(len(run_folder.window_paths(_chain / "flow")) >= 2, "the scene has fewer than two windows of flow")
    copy = folder / "chain"
    shutil.copytree(_chain, copy)
    return copy


def truncate(path):
    path.write_bytes(path.read_bytes()[:-1])


def halve(path):
    content = path.read_bytes()
    path.write_bytes(content[:len(content) // 2])


def flip_bit_of(dataset):
    def flip(path):
        with h5py.File(path, "r") as file:
            chunk = file[dataset].id.get_chunk_info(0)
        content = bytearray(path.read_bytes())
        content[chunk.byte_offset + chunk.size // 3] ^= 1
        path.write_bytes(content)
    return flip


def change(edit):
    def apply(path):
        with h5py.File(path, "r+") as file:
            edit(file)
    return apply


def other_schema(file):
    file.attrs["schema"] = "tsunagi.boussinesq.window/99"


def without(dataset):
    return change(lambda file: file.__delitem__(dataset))


def with_nan(dataset):
    def edit(file):
        values = file[dataset][()]
        values.flat[values.size // 2] = float("nan")
        file[dataset][...] = values
    return change(edit)


def time_runs_back(dataset):
    def edit(file):
        file[dataset][...] = file[dataset][()][::-1].copy()
    return change(edit)


def other_digest(file):
    file.attrs["scene_digest"] = "0" * 32


def readers(chain):
    """(command that reads waves or flow, its folder, fields of the input)."""
    yield (("cmps", "run", SCENE, *SHORT, "--waves", chain / "waves", "--out", chain / "again_flow"), chain / "waves",
           "/time", "/velocity")
    yield (("dem", "run", SCENE, *SHORT, "--flow", chain / "flow", "--out", chain / "again_blocks"), chain / "flow",
           "/flow/time", "/flow/velocity")


def damaged(folder, number, damage, *fragments):
    """Damages window `number` (counted from the end when negative) of each input; its reader must name it."""
    for which in (0, 1):
        chain = whole_chain(folder)
        command, source, time, field = list(readers(chain))[which]
        path = run_folder.window_paths(source)[number]
        damage(time, field)(path)
        ended = run(*command).expect_error(2, path.name, *(part.format(time=time, field=field) for part in fragments))
        print(f"    {ended.stderr.strip().replace(str(chain) + '/', '')}")
        # The coupler finds the same fault without running anything.
        verify = run("coupler", "verify", chain).expect_status(1)
        check(path.name in verify.stderr, verify.stderr)
        shutil.rmtree(chain)


@test
def a_truncated_window(folder):
    damaged(folder, -1, lambda time, field: truncate)


@test
def half_a_window(folder):
    damaged(folder, -1, lambda time, field: halve)


@test
def a_flipped_bit(folder):
    damaged(folder, -1, lambda time, field: flip_bit_of(field), "{field}")


@test
def another_schema(folder):
    damaged(folder, -1, lambda time, field: change(other_schema), "schema")


@test
def a_dataset_that_is_missing(folder):
    damaged(folder, -1, lambda time, field: without(field), "{field}", "missing")


@test
def a_value_that_is_not_a_number(folder):
    damaged(folder, -1, lambda time, field: with_nan(field), "{field}", "finite")


@test
def time_that_runs_back(folder):
    damaged(folder, -1, lambda time, field: time_runs_back(time), "{time}")


@test
def a_window_of_another_scene(folder):
    damaged(folder, -1, lambda time, field: change(other_digest), "digest")


@test
def a_missing_window(folder):
    for which in (0, 1):
        chain = whole_chain(folder)
        command, source, *_ = list(readers(chain))[which]
        path = run_folder.window_paths(source)[-2]
        path.unlink()
        run(*command).expect_error(2, path.name, "missing")
        check(path.name in run("coupler", "verify", chain).expect_status(1).stderr, "verify did not see it")
        shutil.rmtree(chain)


@test
def no_windows_at_all(folder):
    chain = whole_chain(folder)
    for command, source, *_ in readers(chain):
        shutil.rmtree(source)
        run(*command).expect_error(2, str(source))
        source.mkdir()
        run(*command).expect_error(2, str(source), "no windows")


@test
def windows_of_the_wrong_stage(folder):
    chain = whole_chain(folder)
    run("cmps", "run", SCENE, *SHORT, "--waves", chain / "flow", "--out", chain / "again").expect_error(2, "schema")
    run("dem", "run", SCENE, *SHORT, "--flow", chain / "waves", "--out", chain / "again").expect_error(2, "schema")


def replaced_by_claim(dataset, shape):
    """The dataset declares `shape`, but only a first chunk of it is in the file."""
    def edit(file):
        unit = file[dataset].attrs["units"]
        del file[dataset]
        claim = file.create_dataset(dataset, shape=shape, dtype="f4", chunks=(1000,) + (1,) * (len(shape) - 1))
        if math.prod(shape) < 2**62:  # HDF5 itself writes no chunk of a larger one
            claim[(0,) * len(shape)] = 1.0
        claim.attrs["units"] = unit
    return change(edit)


@test
def a_dataset_that_claims_gigabytes(folder):
    """Refused before memory is asked for, by what the file holds."""
    def with_little_memory():
        resource.setrlimit(resource.RLIMIT_AS, (2_000_000_000, 2_000_000_000))
    for which, shapes in ((0, ((400_000_000, 3),)), (1, ((400_000_000, 3, 3, 2),))):
        for dataset, shape, message in ([(list(readers(folder))[which][3], shapes[0], "claims more values"),
                                         ("/gauges/far/velocity", (400_000_000,), "claims more values"),
                                         ("/gauges/far/velocity", (2**40, 2**40), "claims more values")]):
            chain = whole_chain(folder)
            command, source, *_ = list(readers(chain))[which]
            path = run_folder.window_paths(source)[0]
            with h5py.File(path, "r+") as file:
                if dataset not in file:
                    file.create_dataset(dataset, data=[0.0]).attrs["units"] = "m/s"
            replaced_by_claim(dataset, shape)(path)
            run(*command, preexec_fn=with_little_memory).expect_error(2, path.name, dataset, message)
            shutil.rmtree(chain)


@test
def bytes_changed_at_random(folder):
    """Sixty seeded mutations of a window, most in its headers: no signal and no gigabytes, whatever HDF5 makes of them."""
    def with_little_memory():
        resource.setrlimit(resource.RLIMIT_AS, (2_000_000_000, 2_000_000_000))
    run("boussinesq", "run", SCENE, "--set", "time.end=0.2", "--set", "time.window=0.1", "--out", folder / "waves",
        "--quiet").expect_done()
    path = folder / "waves/window_000001.h5"
    whole = path.read_bytes()
    refused = 0
    for seed in range(60):
        chance = random.Random(seed)
        content = bytearray(whole)
        for _ in range(chance.choice((1, 1, 2, 4))):
            place = chance.choice((chance.randrange(len(content)), chance.randrange(min(4000, len(content)))))
            content[place] = chance.choice((0, 255, chance.randrange(256), content[place] ^ 1 << chance.randrange(8)))
        path.write_bytes(content)
        ended = run("coupler", "verify", folder, preexec_fn=with_little_memory)
        check(ended.status in (0, 1), f"seed {seed}: status {ended.status}: {ended.stderr}")
        check(ended.status == 0 or path.name in ended.stderr, f"seed {seed}: the file is not named: {ended.stderr}")
        refused += ended.status == 1
    check(refused > 30, f"only {refused} of 60 mutations were noticed")


@test
def input_of_another_scene(folder):
    """Keys that the windows were computed with differ from those given: refused, each named with both values."""
    chain = whole_chain(folder)
    (_, *waves), (_, *flow) = (command for command, *_ in readers(chain))
    for program, words in (("cmps", waves), ("dem", flow)):
        for setting, *parts in (("waves.height=0.08", "waves.height (0.06 there, 0.08 here)"),
                                ("boussinesq.cells=700", "boussinesq.cells", "here"),
                                ("accuracy=fine", 'accuracy ("draft" there, "fine" here)')):
            run(program, *words, "--set", setting).expect_error(2, "another scene", *parts)
    run("dem", *flow, "--set", "cmps.crest_lowering=0.03").expect_error(2, "cmps.crest_lowering (0.04 there, 0.03 here)")
    check(not (chain / "again_blocks").exists(), "a refused run has written")
    # What belongs to the blocks alone may change on a stored flow, and so may titles and gauges.
    run("dem", *flow, "--set", "dem.friction=0.5", "--set", "title=again", "--set", "gauges.more=5.7").expect_done()
    record = json.loads((chain / "again_blocks/run.json").read_text())
    check(record["input"]["scene"]["values"]["cmps"]["crest_lowering"]["value"] == 0.04, record["input"])
    check(record["input"]["input"]["scene"]["values"]["waves"]["height"]["value"] == 0.06, record["input"])


@test
def input_without_a_scene_record(folder):
    """Windows made by hand say nothing of a scene: told once, and kept in run.json."""
    chain = whole_chain(folder)
    command, *_ = list(readers(chain))[1]
    record = json.loads((chain / "flow/run.json").read_text())
    (chain / "flow/run.json").write_text(json.dumps({key: record[key] for key in ("stage", "status", "windows")}))
    ended = run(*command).expect_done()
    check(ended.stderr.count("windows without a scene record") == 1, ended.stderr)
    notes = json.loads((chain / "again_blocks/run.json").read_text())["notes"]
    check("without a scene record" in notes["input"], notes)
    record["scene_digest"] = "0" * 32
    (chain / "flow/run.json").write_text(json.dumps(record))
    run(*command).expect_error(2, "run.json", "another run", "digests differ")


@test
def input_that_ends_too_early(folder):
    chain = whole_chain(folder)
    for program, option, source in (("cmps", "--waves", "waves"), ("dem", "--flow", "flow")):
        run(program, "run", SCENE, option, chain / source, "--out", chain / "again").expect_error(2, source)


@test
def what_was_published_stays(folder):
    chain = whole_chain(folder)
    before = digests(chain / "flow")
    truncate(run_folder.window_paths(chain / "waves")[-1])
    # The flow is finished, but its waves are damaged: asking for it again must not cost what is there.
    ended = run("cmps", "run", SCENE, *SHORT, "--waves", chain / "waves", "--out", chain / "flow")
    after = digests(chain / "flow")
    check(after == before, f"windows changed; status {ended.status}: {ended.stderr}")


@test
def a_sound_chain_is_found_sound(folder):
    chain = whole_chain(folder)
    verify = run("coupler", "verify", chain).expect_done()
    check(verify.stdout.count("sound") == 3, verify.stdout)
    check_same_bytes(chain / "flow", _chain / "flow")


try:
    main()
finally:
    if _chain is not None:
        shutil.rmtree(_chain, ignore_errors=True)
