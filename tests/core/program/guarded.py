# SPDX-License-Identifier: GPL-3.0-or-later
"""Files of users are not written over, pipes are not waited for, and no name reaches the terminal as an escape sequence."""
import os
import shutil
import subprocess

import lab


class Files(lab.Lab):
    def test_only_their_own_are_replaced(self):
        """A page, a schema or an export takes the place of one, and of nothing else."""
        own = {("report", "run"): "page.html", ("schema",): "schema.json", ("report", "some.figure.json"): "figures.html"}
        self.write("some.figure.json", "[]")
        for words, name in own.items():
            line = [*words, name] if words[0] == "schema" else [*words, "-o", name]
            for holds in ("format: 2\n", "<!DOCTYPE html>\n<p>mine</p>\n", "{\n \"type\": \"object\"}\n"):
                self.write(name, holds)
                said = self.call(*line, code=2)
                self.assertIn(f'"{name}" exists and was not written by this command', said)
                with open(name, encoding="utf-8") as file:
                    self.assertEqual(file.read(), holds)
            os.remove(name)
            for _ in range(2):
                self.call(*line)
            os.remove(name)
            os.mkfifo(name)
            self.assertIn("is not a regular file", self.call(*line, code=2))
            self.assertFalse([n for n in os.listdir(".") if n.endswith(".part")])

    def test_pipes_are_no_results(self):
        for of, name in (("run", "result.json"), ("study", "study.json"), ("study", "journal.jsonl"), ("study", "table.csv")):
            shutil.rmtree("piped", ignore_errors=True)
            shutil.copytree(of, "piped")
            os.remove("piped/" + name)
            os.mkfifo("piped/" + name)
            for words in (["report", "piped"], ["export", "piped", "--to", "csv", "-o", "piped-csv"]):
                done = subprocess.run([self.program, *words], capture_output=True, text=True, timeout=60, check=False)
                self.assertIn(done.returncode, (0, 2), done.stderr)
        os.mkfifo("pipe.json")
        self.assertIn("it is not a regular file", self.call("report", "pipe.json", code=2))
        os.mkfifo("pipe.yaml")
        self.assertIn("it is not a regular file", self.call("check", "pipe.yaml", code=2))
        self.assertIn("it is not a regular file", self.call("check", "run.yaml", "--set", "include=pipe.yaml", code=2))

    def test_no_escape_sequence(self):
        for words in (["run", "a\x1b[31m.yaml"], ["run", "run.yaml", "-o", "b\x1b[31m"], ["a\x1b[31m"], ["check", "--a\x1b[31m"],
                      ["run", "run.yaml", "-o", "c\x9b31m"], ["models", "\x7f"]):
            said = self.call(*words, code=2)
            self.assertIn("a control character", said)
            self.assertNotRegex(said, "[\x00-\x09\x0b-\x1f\x7f\x80-\x9f]")
            if "c\x9b31m" in words:
                self.assertIn('"c?31m"', said)


lab.main()
