# SPDX-License-Identifier: GPL-3.0-or-later
"""What a run and a study do to files, by strace: the calls that docs/guide.md lists and no others, and
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
    def traced(self, *words, code=0):
        """The calls that change a file, in their order."""
        line = ["strace", "-f", "-y", "-s", "400", "-o", "trace", "-e", "trace=" + ",".join("?" + c for c in CHANGES),
                self.program, *words]
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
            row = re.search(r"^ *Files are changed by (.*?) alone", file.read(), re.M | re.S)
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
        self.assertLessEqual({"openat", "write", "renameat", "flock", "fsync"}, used)
        self.assertGreater(self.check_renames([c for c in calls if "/stages" not in str(c)], True), 20)
        journal = [c.name for c in calls if c.paths and c.paths[0].endswith("/journal.jsonl") and
                   c.name in ("write", "fdatasync")]
        self.assertEqual(journal[-1], "fdatasync")

    def test_order(self):
        """A record comes into the journal after all files of its case have their names."""
        calls = self.traced("run", "study.yaml", "-o", "order", "-j", "1", code=4)
        moved = set()
        records = 0
        for call in calls:
            if call.name.startswith("rename") and call.names[-1] == "arrays.json":
                moved.add(os.path.basename(call.paths[0]))
            if call.name == "write" and call.paths[0].endswith("/journal.jsonl"):
                for key in re.findall(r'\\"key\\":\\"(\w+)\\"', call.words):
                    records += 1
                    self.assertTrue(key in moved or '\\"failed\\"' in call.words, (key, call))
        self.assertGreater(records, 1)
        self.assertEqual(len(moved), 4)


lab.main()
