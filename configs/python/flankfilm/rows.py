# SPDX-License-Identifier: GPL-3.0-or-later
"""A study whose cases a script chooses one after the other."""

import csv
import json
import subprocess
import tempfile

from .arrays import Error, as_list, as_path
from .program import _program, _sets, as_text


class Rows:
    """Runs a study with `study: {cases: "-"}`. Cases that the directory already contains are answered
    from there. Columns are paths, with a unit in brackets for bare numbers.

        with flankfilm.Rows("pair.yaml", ["duty.torque [N m]"], "results/least") as rows:
            film = rows.ask(250)["outputs"]["film.h_min_lowest"]
    """

    def __init__(self, file, columns, directory, sets=None):
        self.columns = [as_text("columns", name) for name in as_list("columns", columns)]
        words = [*_program(), "run", as_path("file", file), "-o", as_path("directory", directory),
                 *_sets({**(sets or {}), "study": '{cases: "-"}'})]
        self._said = tempfile.TemporaryFile("w+")
        self._process = subprocess.Popen(words, stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                         stderr=self._said, text=True)
        self._write(self.columns)

    def _write(self, fields):
        try:
            csv.writer(self._process.stdin, lineterminator="\n").writerow(fields)
            self._process.stdin.flush()
        except (BrokenPipeError, ValueError):
            raise self._end() from None

    def _end(self):
        """The error if the program has ended."""
        self._process.wait()
        self._said.seek(0)
        return Error(self._said.read().strip() or "the rows are closed", self._process.returncode)

    def ask(self, *values):
        """Runs the case with these values; returns its line of JSON as a dictionary. If "status" is not "ok",
        "reason" says why."""
        self._write([as_text("a value", value) for value in values])
        line = self._process.stdout.readline()
        if not line:
            raise self._end()
        return json.loads(line)

    def close(self):
        """Ends the study; the program then writes the table of the cases."""
        if not self._process.stdin.closed:
            self._process.communicate()
        self._process.stdin.close()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()
