# SPDX-License-Identifier: GPL-3.0-or-later
"""The program from Python: runs cases and studies in a separate process, and opens results."""

import csv
import json
import os
import shlex
import shutil
import subprocess
import tempfile
from collections.abc import Mapping

import numpy as np

from .arrays import Array, Error, as_items, as_list, as_path, wrong
from .logs import FORMAT, Logs, records_of


def _map(path, shape):
    """The numbers of a .npy file. They are read when used; writing to them does not change the file."""
    try:
        data = np.lib.format.open_memmap(path, mode="c") if np.prod(shape) else np.empty(shape)
    except (OSError, ValueError) as error:
        raise Error(f"{path} cannot be read: {error}") from None
    if data.dtype != np.dtype("<f8"):
        raise Error(f"{path} cannot be read: its numbers are of the type {data.dtype.str}, not <f8")
    if not data.flags.c_contiguous:
        raise Error(f"{path} cannot be read: its numbers are in Fortran order, not in C order")
    if data.shape != tuple(shape):
        raise Error(f"{path} cannot be read: its shape is {data.shape}, not {tuple(shape)}")
    return data


def _array(entry, directory):
    """Makes an Array from {"unit", "value"} or {"unit", "dims", "shape", "data" or "file"}; null becomes NaN."""
    doc, against = entry.get("doc") or "", entry.get("against") or ()
    if "file" in entry:
        name = entry["file"]
        if not name or name != os.path.basename(name) or name.startswith("."):
            raise Error(f"{directory}: \"{name}\" is not the name of a file beside its results")
        data = _map(os.path.join(directory, name), entry["shape"])
    elif "data" in entry:
        data = np.array(entry["data"], dtype=float).reshape(entry["shape"])
    else:
        value = entry.get("value")
        return Array(np.nan if value is None else float(value), entry["unit"], (), doc)
    return Array(data, entry["unit"], entry["dims"], doc, against)


class Result(Mapping):
    """A run: a mapping of "stage.output" to Array. `asked` has the names of the requested outputs,
    `quality` the quality lines of each stage, `json` the program's whole answer. Fields are mapped from
    their files, so unused ones take neither time nor memory."""

    def __init__(self, answer, path=None, keep=None):
        self.json, self.path = answer, path
        self._keep = keep  # a temporary directory, which goes with the last who uses it
        self.title, self.status = answer.get("title"), answer.get("status")
        self.asked = list(answer.get("outputs") or {})
        self.warnings = [w["message"] for w in answer.get("warnings") or ()]
        self.quality = {s["stage"]: s.get("quality") or {} for s in answer.get("stages") or ()}
        self._entries = {**(answer.get("computed") or {}), **(answer.get("outputs") or {})}
        self._arrays = {}

    def __getitem__(self, name):
        if name not in self._arrays:
            if name not in self._entries:
                raise KeyError(f"{name}: the results have {', '.join(self._entries)}")
            self._arrays[name] = _array(self._entries[name], self._place())
        return self._arrays[name]

    def _place(self):
        return self.path or (self._keep.name if self._keep else ".")

    def __iter__(self):
        return iter(self._entries)

    def __len__(self):
        return len(self._entries)

    def __repr__(self):
        return f"<Result {self.title or ''}: {', '.join(self._entries)}>"

    def against(self, name, dimension=0):
        """The series over which the dimension is plotted, or None."""
        names = self[name].against
        return self[names[dimension]] if dimension < len(names) and names[dimension] in self else None


def _number(text):
    try:
        return float(text)
    except ValueError:
        return np.nan


class Study(Mapping):
    """A study: a mapping of "stage.output" to Array. The first dimensions are the varied parameters. Missing values of a case
    are NaN; arrays of different lengths are padded with NaN.

    axes     the values of each dimension, by its name ("mesh_frequency", "viscosity.use")
    status   of each case, in the shape of the study; reason likewise
    table    the columns of table.csv, unchanged"""

    def __init__(self, path):
        self.path = path
        with _file(path, "study.json") as file:
            about = json.load(file)
        if about.get("format", 1) != FORMAT:
            raise Error(f"{path}: its files have format {about.get('format', 1)}, not {FORMAT}")
        with _file(path, "table.csv") as file:
            rows = list(csv.reader(file))
        self.title, self.shape = about.get("title"), tuple(about["lengths"])
        head, self._rows = rows[0], rows[1:]
        if len(self._rows) != np.prod(self.shape, dtype=int):
            raise Error(f"{path}: the table does not have all cases; run the study again")
        self.table = {h: [row[i] for row in self._rows] for i, h in enumerate(head)}
        self.status = np.array(self.table["status"], dtype=object).reshape(self.shape)
        self.reason = np.array(self.table["reason"], dtype=object).reshape(self.shape)
        self._name_axes(about["axes"])
        self._columns = {}
        for h in head:
            name, _, unit = h.partition(" [")
            if unit and "." in name and name not in {a["path"] for a in about["axes"]}:
                self._columns[name] = (h, unit.rstrip("]"))
        keys = set(self.table["key"])
        self._records, self._logs = {k: r for k, r in records_of(path).items() if k in keys}, Logs(path)
        self._stacked = dict.fromkeys(n for r in self._records.values() for n in r.get("arrays") or ())
        self._docs = about.get("docs") or {}

    def _name_axes(self, axes):
        self.axes, self.dims = {}, []
        for d in range(len(self.shape)):
            mine = [a for a in axes if a["dimension"] == d]
            last = [a["path"].rpartition(".")[2] for a in mine]
            name = "point" if len(mine) != 1 else mine[0]["path"] if last[0] == "use" else last[0]
            if name in self.dims:
                name = mine[0]["path"] if mine else f"{name}_{d + 1}"
            self.dims.append(name)
            for a in mine:
                values, unit = (a["values"], a["unit"]) if a.get("values") else (a["words"], "")
                axis = Array(np.array(values), unit, (name,))
                self.axes[name if len(mine) == 1 else a["path"]] = axis

    def case(self, index):
        """A dictionary of the arrays of one case, given by its number from 0. They are mapped from the logs."""
        record = self._records.get(self.table["key"][index]) or {}
        return {name: Array(self._logs.read(record, name), entry[0], entry[1], self._docs.get(name) or "",
                            entry[4] if len(entry) > 4 else [""] * len(entry[1]))
                for name, entry in (record.get("arrays") or {}).items()}

    def _part(self, index, name):
        """The numbers of one output of a case, or None if the case has none."""
        record = self._records.get(self.table["key"][index]) or {}
        if name in (record.get("arrays") or {}):
            return self._logs.read(record, name)
        scalar = (record.get("outputs") or {}).get(name)  # a series of one number
        return None if scalar is None else np.array(np.nan if scalar[1] is None else scalar[1], dtype=float)

    def _stack(self, name):
        entries = [e for r in self._records.values() for n, e in (r.get("arrays") or {}).items() if n == name]
        model = max(entries, key=lambda e: len(e[1]))
        rank = len(model[1])
        shape = tuple(max([1, *(e[2][k - rank] for e in entries if len(e[1]) >= rank - k)]) for k in range(rank))
        data = np.full((len(self._rows), *shape), np.nan)
        for k in range(len(self._rows)):
            part = self._part(k, name)
            if part is not None:
                full = part.reshape((1,) * (rank - part.ndim) + part.shape)
                data[(k, *(slice(n) for n in full.shape))] = full
        against = model[4] if len(model) > 4 else [""] * rank
        return Array(data.reshape(*self.shape, *shape), model[0], (*self.dims, *model[1]),
                     self._docs.get(name) or "", against)

    def __getitem__(self, name):
        if name in self._columns and name not in self._stacked:
            head, unit = self._columns[name]
            data = np.array([_number(text) for text in self.table[head]]).reshape(self.shape)
            return Array(data, unit, self.dims)
        if name not in self._stacked:
            raise KeyError(f"{name}: the study has {', '.join(self)}")
        return self._stack(name)

    def __iter__(self):
        return iter({**self._columns, **self._stacked})

    def __len__(self):
        return sum(1 for _ in self)

    def __repr__(self):
        axes = ", ".join(f"{d}: {n}" for d, n in zip(self.dims, self.shape))
        return f"<Study {self.title or ''} over {axes}: {', '.join(self)}>"


def _file(*parts):
    try:
        return _open(os.path.join(*parts), encoding="utf-8", newline="")
    except OSError as error:
        raise Error(f"{os.path.join(*parts)}: {error.strerror}") from None


_open = open


def open(path):  # as in xarray or gzip
    """The Result or Study of a directory that `flankfilm run` has written."""
    path = as_path("path", path)
    if os.path.exists(os.path.join(path, "study.json")):
        return Study(path)
    if not os.path.exists(os.path.join(path, "result.json")):
        raise Error(f"{path}: no results of flankfilm in this directory")
    with _file(path, "result.json") as file:
        return Result(json.load(file), path)


def _program():
    named = os.environ.get("FLANKFILM")
    found = shlex.split(named) if named else [shutil.which("flankfilm")]
    if not found[0]:
        raise Error("flankfilm is not on the path; put its place into the variable FLANKFILM")
    return found


def as_text(name, value):
    """The value as YAML."""

    def plain(value):  # of numpy, whose numbers are none to json
        if isinstance(value, (np.ndarray, np.generic, Array)):
            return np.asarray(value).tolist()
        if isinstance(value, os.PathLike):
            return os.fspath(value)
        raise wrong(name, "a text, a number, a list or a dictionary", value)

    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(as_text(name, v) for v in value) + "]"
    if isinstance(value, (np.ndarray, np.generic, Array, os.PathLike)):
        return as_text(name, plain(value))
    return value if isinstance(value, str) else json.dumps(value, default=plain)


def assignments(sets):
    """The assignments in `sets`, in the form of --set: "film.cells=512"."""
    return [f"{key}={as_text(key, value)}" for key, value in as_items("sets", sets)]


def _sets(sets):
    return [word for text in assignments(sets) for word in ("--set", text)]


def _call(*words):
    """The program's JSON answer. If it has errors, raises Error, with the results of a failed run."""
    line = [*_program(), *map(str, words), "--json"]
    try:
        done = subprocess.run(line, capture_output=True, text=True, check=False)
    except OSError as error:
        raise Error(f"{line[0]}: {error.strerror}") from None
    try:
        answer = json.loads(done.stdout)
    except ValueError:
        raise Error(done.stderr.strip() or f"{line[0]} ended with code {done.returncode}",
                    done.returncode) from None
    errors = answer.get("errors") or []
    if errors:
        text = "\n".join(
            (f"{e['file']}:{e['line']}:{e['column']}: " if e.get("line") else "") + e["message"]
            for e in errors)
        left = Result(answer) if answer.get("outputs") else None
        raise Error(text, answer["exit"], errors, left)
    return answer


def run(file, sets=None, directory=None, jobs=None):
    """Runs a case or a study, with the values in `sets`, such as {"duty.torque": "300 N m"}, in place of those of the file;
    returns a Result or a Study. With `directory` the results are also written there; a study always
    writes them. Failed cases of a study raise no error: see Study.status."""
    line = ["run", as_path("file", file), *_sets(sets)]
    line += ["-j", jobs] if jobs else []
    keep = None
    if directory is None and not check(file, sets):
        keep = tempfile.TemporaryDirectory(prefix="flankfilm-")
    place = as_path("directory", directory) if directory else keep.name if keep else None
    try:
        answer = _call(*line, *(["-o", place] if place else []))
    except Error as error:
        if error.result:  # what it has left
            error.result.path, error.result._keep = directory, keep
        raise
    if "cases" in answer:
        return Study(answer["directory"])
    return Result(answer, directory, keep)


def check(file, sets=None):
    """Raises the errors of the file, and does not run it. Returns whether it is a study."""
    return _call("check", as_path("file", file), *_sets(sets))["study"]


def fit(kind, data, laws=(), at=(), sets=None, directory=None):
    """Fits parameters of laws to measured data; returns the dictionary that `flankfilm fit --json` prints."""
    line = ["fit", kind, as_path("data", data), *_sets(sets)]
    line += [word for law in as_list("laws", laws) for word in ("--law", law)]
    line += [word for value in as_list("at", at) for word in ("--at", value)]
    line += ["-o", as_path("directory", directory)] if directory else []
    return _call(*line)
