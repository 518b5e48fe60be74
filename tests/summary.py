# SPDX-License-Identifier: GPL-3.0-or-later
"""What a run of tests/run.sh comes to: tests that are missing, tests that were skipped and why, the
campaigns that are not part of it, then each suite with its CPU time, and the sum in the last line.

    summary.py BUILD_DIRECTORY
"""
import collections
import json
import os
import pathlib
import re
import subprocess
import sys

build = pathlib.Path(sys.argv[1])
root = pathlib.Path(__file__).resolve().parent.parent
campaigns = (root / "docs" / "campaigns.md").read_text(encoding="utf-8")


def orphans():
    """Files of tests/ in no target, test or campaign, that no script of such names, and in no project of its own."""
    known = campaigns + "".join((build / "meson-info" / f"intro-{kind}.json").read_text(encoding="utf-8")
                                for kind in ("tests", "benchmarks", "targets"))
    known = {os.path.normpath(root / path) for path in re.findall(r"[^\"` ]*\.(?:c|sh|py)\b", known)}
    known |= {str(root / "tests" / name) for name in ("run.sh", "cpu.sh", "summary.py")}
    files = {path for end in ("c", "sh", "py") for path in (root / "tests").rglob("*." + end)}
    scripts = {path: path.read_text(encoding="utf-8") for path in files
               if str(path) in known and path.suffix != ".c"}

    def named(path):
        meson = path.parent / "meson.build"
        if meson.exists() and meson.read_text(encoding="utf-8").startswith("project("):
            return True
        return any(re.search(rf"\b{re.escape(path.stem)}\b", text) for script, text in scripts.items()
                   if script.is_relative_to(path.parent))
    return sorted(str(path.relative_to(root)) for path in files if str(path) not in known and not named(path))


def expected():
    """Names of the tests that this configuration runs, as meson prints them."""
    done = subprocess.run(["meson", "test", "-C", str(build), "--no-rebuild", "--list"],
                          capture_output=True, text=True, check=True)
    return [line for line in done.stdout.splitlines() if " / " in line]


def results():
    log = build / "meson-logs" / "testlog-cpu.sh.json"
    return [json.loads(line) for line in log.read_text().splitlines()] if log.exists() else []


def outcome(test):
    return {"OK": "passed", "EXPECTEDFAIL": "passed", "SKIP": "skipped"}.get(test["result"], "failed")


def reason(test):
    """The last thing that a skipped test says."""
    said = [line for line in test["stdout"].splitlines() if line and not line.startswith("cpu ")]
    return said[-1] if said else "no reason given"


def cpu(test):
    found = re.findall(r"^cpu ([\d.]+) ([\d.]+)$", test["stdout"] + test.get("stderr", ""), re.M)
    return sum(map(float, found[-1])) if found else 0.0


def main():
    ran = results()
    count = collections.defaultdict(collections.Counter)
    seconds = collections.Counter()
    for test in ran:
        suite = test["name"].split(" / ")[0].split(":")[-1].split("+")[0]
        count[suite][outcome(test)] += 1
        seconds[suite] += cpu(test)

    missing = collections.Counter(expected()) - collections.Counter(test["name"] for test in ran)
    lost = [f"{name}: has no result" for name in missing.elements()]
    lost += [f"{path}: belongs to no test of this configuration" for path in orphans()]
    count["missing"]["failed"] += len(lost)
    for title, lines in (
        ("Missing:", lost),
        ("Skipped:", [f"{test['name']}: {reason(test)}" for test in ran if outcome(test) == "skipped"]),
        ("Not part of it, campaigns of docs/campaigns.md:",
         re.findall(r"^\|[^|`]*\| `([^`]*)`", campaigns, re.M)),
        ("Most CPU time:", [f"{cpu(test):6.1f} s  {test['name']}"
                            for test in sorted(ran, key=cpu, reverse=True)[:10]]),
    ):
        if lines:
            print(title, *lines, sep="\n  ")
            print()

    kinds = "passed", "failed", "skipped"
    print(f"{'suite':12}" + "".join(f"{kind:>9}" for kind in kinds) + "     CPU")
    total = sum(count.values(), collections.Counter())
    for suite, numbers in (*((suite, count[suite]) for suite in sorted(count)), ("all", total)):
        if sum(numbers.values()):
            spent = seconds.total() if suite == "all" else seconds[suite]
            print(f"{suite:12}" + "".join(f"{numbers[kind]:9}" for kind in kinds) + f"{spent:6.0f} s")
    if not ran:
        total["failed"] += 1
    print()
    failures = [test for test in ran if outcome(test) == "failed"]
    for test in failures:
        print(f"Failed: {test['name']}", *(test["stdout"] + test.get("stderr", "")).splitlines()[-20:], sep="\n  | ")
    print(", ".join(f"{total[kind]} {kind}" for kind in kinds[:2 + (total["skipped"] > 0)]))
    return total["failed"] > 0


sys.exit(main())
