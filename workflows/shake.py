"""Repeats the verdicts that could hang on chance with other perturbations of the first state, and says how many flipped.

    ./workflows/test --shake 10 [--build release] [--only WORD]

The build (build/<name>, of a preset of CMakePresets.json) must have been made; --only takes a regular expression of CTest
names. Repetition k moves every seed of every test by 1000 k (tests/support/perturbations.py). Reports are kept under
build/<name>/shake; one of the same programs is not made again, so that a broken-off call goes on. Status 1 where one flipped.
"""
import argparse
import collections
import os
import pathlib
import subprocess
import xml.etree.ElementTree

ROOT = pathlib.Path(__file__).resolve().parents[1]
KINDS = "^(verification|stability|chain)$"

parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("--shake", type=int, required=True, metavar="N", help="number of other perturbations")
parser.add_argument("--build", default="release", help="folder under build/")
parser.add_argument("--only", default="", metavar="WORD", help="tests whose CTest name holds this")
arguments = parser.parse_args()

build = ROOT / "build" / arguments.build
if not (build / "CTestTestfile.cmake").exists():
    raise SystemExit(f"{build}: not built; cmake --preset {arguments.build} && cmake --build --preset {arguments.build}")
newest = max(path.stat().st_mtime for path in (build / "bin").iterdir())
(build / "shake").mkdir(exist_ok=True)
(ROOT / "build/tmp").mkdir(parents=True, exist_ok=True)

ran, flipped = collections.Counter(), collections.Counter()
for k in range(1, arguments.shake + 1):
    report = build / "shake" / f"{k}{'_' + ''.join(filter(str.isalnum, arguments.only)) if arguments.only else ''}.xml"
    if not report.exists() or report.stat().st_mtime < newest:
        part = report.with_suffix(".part")
        part.unlink(missing_ok=True)
        subprocess.run(["ctest", "--test-dir", str(build), "-L", KINDS, "-R", arguments.only or ".", "-j", str(os.cpu_count()),
                        "--output-on-failure", "--no-tests=error", "--output-junit", str(part)],
                       env={**os.environ, "TSUNAGI_PERTURBATION": str(k), "OMP_WAIT_POLICY": "passive", "TMPDIR": str(ROOT / "build/tmp")})
        if not part.exists():
            raise SystemExit("ctest left no report")
        part.rename(report)
    for case in xml.etree.ElementTree.parse(report).getroot().iter("testcase"):
        if case.find("skipped") is not None:
            continue
        ran[case.get("name")] += 1
        flipped[case.get("name")] += case.find("failure") is not None or case.get("status") == "fail"

for name in sorted(ran):
    print(f"{flipped[name]} of {ran[name]} flipped  {name}")
print(f"{sum(flipped.values())} of {sum(ran.values())} verdicts flipped ({len(ran)} verdicts, {arguments.shake} perturbations, build {arguments.build})")
raise SystemExit(1 if sum(flipped.values()) else 0)
