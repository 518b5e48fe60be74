# SPDX-License-Identifier: GPL-3.0-or-later
"""A study of many cheap cases is killed three times, goes on, and is planned, tabled, exported and
shown in a page, within 2 GB and in a handful of files.

    python3 study-large.py THOUSANDS FLANKFILM PLUGINS [DIRECTORY]

A directory that is named is kept, and the same command goes on where an earlier one was broken off.
"""
import os
import signal
import subprocess
import sys
import tempfile
import time

STUDY = """
format: 2
pipeline:
  oil: {{use: lubricant/grade, grade: ISO VG 220}}
outputs: [oil.eta0, oil.alpha, oil.rho0]
study:
  sweep:
    oil.base: [mineral, PAO, ester, PAG]
    oil.grade: [ISO VG 32, ISO VG 68, ISO VG 100, ISO VG 220, ISO VG 320]
    oil.density_15: {{from: 850 kg/m3, to: 1000 kg/m3, points: {}}}
    oil.temperature: {{from: 40 degC, to: 120 degC, points: 25}}
"""
JOBS = 2
MOST_MEMORY = 2e9  # bytes of all processes


def lines_of(path):
    count = 0
    if os.path.exists(path):
        with open(path, "rb") as file:
            while block := file.read(1 << 20):
                count += block.count(b"\n")
    return count


def memory(words, used):
    """Of all processes of a command: a run has one that leads and its workers, and the largest is told."""
    return (JOBS + 1 if words[0] == "run" else 1) * 1024 * used.ru_maxrss


def main(thousands, program, plugins, directory):
    count = 1000 * int(thousands)
    env = {**os.environ, "FLANKFILM_PLUGIN_PATH": os.path.abspath(plugins)}
    program = os.path.abspath(program)
    os.makedirs(directory, exist_ok=True)
    os.chdir(directory)
    with open("large.yaml", "w", encoding="utf-8") as file:
        file.write(STUDY.format(2 * int(thousands)))

    most = []

    def call(*words):
        begin = time.monotonic()
        with tempfile.TemporaryFile("w+") as out:
            child = subprocess.Popen([program, *words], env=env, stdout=out)
            _, child.returncode, used = os.wait4(child.pid, 0)
            out.seek(0)
            said = out.read()
        assert child.returncode == 0, f"{words} ended with {child.returncode}: {said}"
        most.append(memory(words, used))
        print(f"{words[0]}: {used.ru_utime + used.ru_stime:.1f} s of CPU, {time.monotonic() - begin:.1f} s, "
              f"{most[-1] / 1e6:.0f} MB", flush=True)
        return said

    run = ["run", "large.yaml", "-o", "large", "-j", str(JOBS)]
    for part in range(1, 4):
        if lines_of("large/journal.jsonl") > part * count / 4 or os.path.exists("large/table.csv"):
            continue
        child = subprocess.Popen([program, *run], env=env, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        while child.poll() is None and lines_of("large/journal.jsonl") <= part * count / 4:
            time.sleep(0.02 + count / 1e6)
        child.send_signal(signal.SIGKILL)
        assert child.wait() == -signal.SIGKILL, "it ended before it was killed"
    before = lines_of("large/journal.jsonl")
    said = call(*run)
    assert f"{count} of {count} cases done" in said, said
    assert before < count // 4 or "of them earlier" in said, said
    assert f"{count} done, 0 failed, 0 to run" in call("plan", *run[1:])
    assert f"{count} of them earlier" in call(*run)
    assert lines_of("large/journal.jsonl") <= count + JOBS, "cases ran twice"
    with open("large/table.csv", encoding="utf-8") as file:
        assert sum(",ok," in line for line in file) == count
    call("report", "large")
    call("export", "large", "--to", "csv", "-o", "large-csv")
    with open("large-csv/scalars.csv", encoding="utf-8") as file:
        assert sum(1 for line in file) == count + 1
    page = os.path.getsize("large/report.html")
    kept = len(os.listdir("large/stages"))  # by stages that took long, as all do on a slow machine
    files = sum(len(found) for _, _, found in os.walk("large")) - kept
    journal = os.path.getsize("large/journal.jsonl")
    print(f"page {page / 1e6:.1f} MB, journal {journal / count:.0f} bytes a case, {files} files and {kept} kept")
    assert page < 5e6 and files < 20 and journal < 500 * count and max(most) < MOST_MEMORY


if __name__ == "__main__":
    if len(sys.argv) > 4:
        main(*sys.argv[1:5])
    else:
        with tempfile.TemporaryDirectory() as scratch:
            main(*sys.argv[1:4], scratch)
