# SPDX-License-Identifier: GPL-3.0-or-later
"""What a run and a study do to files, by strace: the calls that docs/guide/studies.md lists and no others, and
in the order that a kill at any moment needs.

durable.py FLANKFILM PLUGIN_DIRECTORY GUIDE MODULE...
"""
import os
import re
import shutil
import subprocess
import sys

if not shutil.which("strace"):
    print("needs strace")
    sys.exit(77)
guide = os.path.realpath(sys.argv.pop(3))
sys.path.append(os.path.dirname(__file__))
import lab  # noqa: E402

# All calls of Linux that change a file, a directory or what is known of one.
CHANGES = """write pwrite64 writev pwritev pwritev2 sendfile splice tee copy_file_range open openat openat2 creat
    rename renameat renameat2 link linkat symlink symlinkat unlink unlinkat rmdir mkdir mkdirat mknod mknodat
    truncate ftruncate fallocate fsync fdatasync sync syncfs sync_file_range msync mmap flock lockf
    chmod fchmod fchmodat chown fchown lchown fchownat utime utimes utimensat futimesat
    setxattr lsetxattr fsetxattr removexattr lremovexattr fremovexattr io_uring_enter io_submit""".split()
WRITES = re.compile(r"O_(WRONLY|RDWR|CREAT|TRUNC|APPEND|TMPFILE)")


class Call:
    def __init__(self, line):
        pid, rest = line.split(None, 1)
        found = re.match(r"(\w+)\((.*)\)\s+= (-?\w+)(?:<([^>]*)>)?", rest)
        self.pid, self.name, self.words, self.code, self.made = pid, *found.groups()
        self.paths = re.findall(r"<([^<>]*)>", self.words)
        self.names = re.findall(r'"((?:[^"\\]|\\.)*)"', self.words)

    def changes(self, place):
        """Whether it is of a file below the place; reading is not."""
        if self.name in ("open", "openat") and not WRITES.search(self.words):
            return False
        if self.name == "mmap":  # that of a file is private, or of memory
            return "MAP_SHARED" in self.words and any(p.startswith(place) for p in self.paths)
        named = [os.path.join(self.paths[0] if self.paths else "", n) for n in self.names]
        return any(os.path.join(os.getcwd(), n).startswith(place) for n in (*named, *self.paths))

    def __repr__(self):
        return f"{self.name}({self.words})"


def finished(lines):
    """Lines of calls that another process came between, put together."""
    begun = {}
    for line in lines:
        pid = line.split(None, 1)[0]
        if line.endswith(" <unfinished ...>\n"):
            begun[pid] = line[:-len(" <unfinished ...>\n")]
        elif "resumed>" in line:
            yield begun.pop(pid) + line.split("resumed>", 1)[1]
        elif "---" not in line and "+++" not in line:
            yield line


class Durable(lab.Lab):
    def traced(self, *words, code=0, options=()):
        """The calls that change a file, in their order."""
        line = ["strace", "-f", "-y", "-s", "4000", "-o", "trace", "-e", "trace=" + ",".join("?" + c for c in CHANGES),
                *options, self.program, *words]
        done = subprocess.run(line, capture_output=True, text=True, check=False)
        if "ptrace" in done.stderr:
            self.skipTest("strace may not trace here")
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        with open("trace", encoding="utf-8", errors="replace") as file:
            calls = [Call(line) for line in finished(file) if ") " in line]
        place = os.path.realpath(self.directory)
        return [c for c in calls if c.changes(place)]

    def listed(self):
        with open(guide, encoding="utf-8") as file:
            row = re.search(r"files are changed only by (.*?), and each log", file.read(), re.S)
        return set(re.findall(r"`(\w+)`", row.group(1)))

    def check_names(self, calls):
        """rename of the C library is renameat on some machines."""
        plain = {"open": "openat", "rename": "renameat", "mkdir": "mkdirat", "unlink": "unlinkat"}
        used = {plain.get(c.name, c.name) for c in calls}
        self.assertLessEqual(used, self.listed())
        return used

    def check_renames(self, calls, synced):
        """Each result gets its name after its last write, and, in a study, after it was synced."""
        moved = 0
        for at, call in enumerate(calls):
            if not call.name.startswith("rename") or call.code != "0":
                continue
            part = os.path.join(call.paths[0] if call.paths else os.getcwd(), call.names[0])
            self.assertTrue(part.endswith(".part"), part)
            touched = [c.name for c in calls[:at] if c.pid == call.pid and c.made != part and
                       c.name in ("write", "fsync") and c.paths[0] == part]
            wanted = synced and call.names[-1] != ".flankfilm"  # what folder it is, not what is in it
            self.assertTrue(not wanted or touched[-1:] == ["fsync"], (part, touched[-3:]))
            moved += 1
        return moved

    def test_run(self):
        calls = self.traced("run", "run.yaml", "-o", "traced")
        used = self.check_names(calls)
        self.assertLessEqual({"openat", "write", "renameat", "flock"}, used)
        self.assertGreater(self.check_renames(calls, False), 4)
        field = [c for c in calls if c.name == "write" and "wave.field.npy" in c.paths[0]]
        self.assertEqual([int(c.code) for c in field], [128, 9 * 10 * 8])

    def test_complete(self):
        """A second run takes result.json away before the first new file comes, and it comes last."""
        self.traced("run", "run.yaml", "-o", "twice")
        calls = self.traced("run", "run.yaml", "-o", "twice", "--set", "wave.count=8")
        names = [(c.name, c.names[-1]) for c in calls
                 if c.name.startswith(("rename", "unlink")) and ".flankfilm" not in c.names[-1]]
        self.assertEqual(names[0][1], "result.json")
        self.assertTrue(names[0][0].startswith("unlink"))
        self.assertEqual([n for n, name in enumerate(names) if name[1] == "result.json"],
                         [0, len([n for n in names if n[0].startswith("rename")])])

    def test_study(self):
        calls = self.traced("run", "study.yaml", "-o", "traced-study", "-j", "2", code=4)
        used = self.check_names(calls)
        self.assertLessEqual({"openat", "write", "pwritev", "renameat", "flock", "fsync", "fdatasync"}, used)
        self.assertGreater(self.check_renames([c for c in calls if "/stages" not in str(c)], True), 1)
        journal = [c.name for c in calls if c.paths and c.paths[0].endswith("/journal.jsonl") and
                   c.name in ("write", "fdatasync")]
        self.assertEqual(journal[-1], "fdatasync")

    def check_order(self, calls, folder):
        """A line comes into the journal after the log that it names was forced to the disk up to there,
        and the name of that log, too; nothing in a log is written twice. Counts lines, and calls."""
        place, end, synced, named = os.path.realpath(folder), {}, {}, set()
        lines = syncs = 0
        for call in calls:
            path = call.paths[0] if call.paths else ""
            if call.name in ("pwrite64", "pwritev") and path.endswith(".log"):
                offset = int(call.words.rsplit(",", 1)[1])
                self.assertEqual(offset, end.get(path, 0), call)
                end[path] = offset + int(call.code)
            elif call.name == "ftruncate" and path.endswith(".log"):
                self.assertNotIn(path, end)
            elif call.name == "fdatasync" and path in end:
                synced[path], syncs = end[path], syncs + 1
            elif call.name == "fsync" and path == place:
                named.update(end)
            elif call.name == "write" and path.endswith("/journal.jsonl"):
                for log, until in re.findall(r'\\"log\\":\[\\"([\w.]+)\\",(\d+)\]', call.words):
                    log, lines = os.path.join(place, log), lines + 1
                    self.assertGreaterEqual(synced.get(log, 0), int(until), call)
                    self.assertIn(log, named)
        return lines, syncs

    def test_order(self):
        calls = self.traced("run", "study.yaml", "-o", "order", "-j", "2", code=4)
        self.assertEqual(self.check_order(calls, "order")[0], 4)

    def test_shared(self):
        """On a slow disk cases share a call."""
        with open("many.yaml", "w", encoding="utf-8") as file:
            file.write("format: 2\npipeline: {wave: {use: toy/wave}}\noutputs: [wave.height]\n"
                       "study: {sweep: {wave.amplitude: {from: 1 mm, to: 2 mm, points: 60}}}\n")
        slow = ("-e", "inject=fdatasync:delay_exit=100000")
        calls = self.traced("run", "many.yaml", "-o", "slow", "-j", "2", options=slow)
        lines, syncs = self.check_order(calls, "slow")
        self.assertEqual(lines, 60)
        self.assertLess(syncs, 30)

    def test_resumed(self):
        """What no line of the journal names is cut off, once, before anything is appended."""
        self.traced("run", "study.yaml", "-o", "cut", "-j", "1", code=4)
        with open("cut/arrays.1.log", "ab") as file:
            file.write(bytes(1000))
        whole = os.path.getsize("cut/arrays.1.log") - 1000
        calls = self.traced("run", "study.yaml", "-o", "cut", "-j", "1", "--set", "wave.shape=b", code=4)
        log = [c for c in calls if c.paths and c.paths[0].endswith("/arrays.1.log")]
        self.assertEqual([c.words.rsplit(",", 1)[1].strip() for c in log if c.name == "ftruncate"], [str(whole)])
        first = [c for c in log if c.name in ("ftruncate", "pwritev")][:2]
        self.assertEqual([c.name for c in first], ["ftruncate", "pwritev"])


lab.main()
