#!@PYTHON@
# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes results of flankfilm as one NetCDF-4 file of the classic data model, by the CF conventions 1.10.

    flankfilm-netcdf DIRECTORY FILE.nc

The dimensions of a study come first, each named by what is varied along it; a stage's own dimensions are called
<stage>.<dimension>. A number that a case does not have is NaN. Where the length of a dimension differs between
cases, arrays are padded with NaN, and <stage>.<dimension>.length has the lengths. `flankfilm export --to netcdf`
starts this program, which reads the directory by the Python module of flankfilm.
"""
import json
import os
import re
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.realpath(__file__)), "@MODULE@"))

try:
    import netCDF4
    import numpy as np

    import flankfilm
except ImportError as error:
    sys.exit(f"flankfilm-netcdf needs the Python module {error.name}, on Debian the package python3-{error.name.lower()}")

TAKEN = {"use", "status", "seconds", "reason", "command", "point", "verdict", "reasons"}  # names of other variables
VERDICTS = ["good", "doubtful", "bad", "failed"]
SMALL = 1 << 13  # arrays with fewer numbers are not compressed


class Run:
    """A single run as a study of one case without axes."""

    def __init__(self, result):
        self.about, self.axes, self.shape, self.dims = result.json, {}, (), []
        self._result, self.count = result, 1
        self.names = []
        for name, entry in result._entries.items():
            self.names += [name]
            if {"value", "data", "file"} & (entry.get("error") or {}).keys():
                self.names += [f"{name}_error_bar"]

    def record(self, _index):
        about = self.about
        stages = [s for s in about["stages"] if s.get("ran")]
        words = {w: i for i, w in enumerate(VERDICTS)}
        lines = {s["stage"]: {k: [q["value"], q["limit"], words[q["verdict"]], q.get("text")]
                              for k, q in (s.get("quality") or {}).items()} for s in stages}
        errors = about.get("errors") or [{"message": ""}]
        return {"status": about["status"], "seconds": sum(s["seconds"] for s in stages), "quality": lines,
                "verdict": about.get("verdict"), "reasons": about.get("reasons") or (),
                "reason": errors[0]["message"]}

    def arrays(self, _index):
        for name in self.names:
            of = name.removesuffix("_error_bar")
            if name in self._result._entries:
                yield name, self._result[name]
            else:
                entry = self._result._entries[of]
                yield name, flankfilm.program._array({**entry, "doc": "", **entry["error"]}, self._result._place())


class Study:
    def __init__(self, study):
        self._study = study
        with open(os.path.join(study.path, "study.json"), encoding="utf-8") as file:
            self.about = json.load(file)
        self.shape, self.count = study.shape, int(np.prod(study.shape, dtype=int))
        self._judged = {j["key"]: j for j in self.about.get("judged") or ()}
        last = [a["path"].rpartition(".")[2] for a in self.about["axes"]]
        self.axes = {}
        for axis, word in zip(self.about["axes"], last):
            clear = re.match(r"[^0-9]", word) and word not in TAKEN and last.count(word) == 1
            self.axes[word if clear else axis["path"]] = axis
        along = [[n for n, a in self.axes.items() if a["dimension"] == d] for d in range(len(self.shape))]
        self.dims = [names[0] if len(names) == 1 else f"point_{d + 1}" if d else "point" for d, names in enumerate(along)]

    def record(self, index):
        key = self._study.table["key"][index]
        record = self._study._records.get(key) or {"status": "not run"}
        judged = self._judged.get(key, {"verdict": "good" if record["status"] == "ok" else None})
        if record["status"] not in ("ok", "not run"):
            judged = {"verdict": "failed"}
        return {**record, "verdict": judged["verdict"], "reasons": judged.get("reasons") or ()}

    def arrays(self, index):
        record = self.record(index)
        for name, (unit, value) in (record.get("outputs") or {}).items():
            yield name, flankfilm.program.Array(np.nan if value is None else value, unit, (),
                                                self._study._docs.get(name) or "")
        yield from self._study.case(index).items()


def point(shape, index):
    return tuple(int(i) for i in np.unravel_index(index, shape)) if shape else ()


def is_coordinate(name, series, other_name, other, dim):
    """Whether dimension `dim` of another variable is plotted against the series."""
    if len(series.dims) != 1 or name == other_name:
        return False
    stage, _, output = name.partition(".")
    same = stage == other_name.partition(".")[0] and series.dims[0] == other.dims[dim]
    return name == (list(other.against) + [""] * 4)[dim] or same and (output == series.dims[0] or series.unit in ("s", "rad"))


class Dimensions:
    """The dimensions of stages. The length of each is its largest length in any case. A dimension that is plotted against a
    series of another stage is the same as that of the series if both have one length in all cases."""

    def __init__(self, variables, shapes):
        self.lengths = {}  # (stage, dimension): all its lengths
        for name, found in shapes.items():
            dims = variables[name].dims
            for shape in found:
                full = (1,) * (len(dims) - len(shape)) + shape
                for d, length in zip(dims, full):
                    self.lengths.setdefault((name.partition(".")[0], d), set()).add(length)
        self.same = {}
        for name, array in variables.items():
            for d, other in zip(array.dims, array.against):
                if other in variables and len(variables[other].dims) == 1:
                    own, its = (name.partition(".")[0], d), (other.partition(".")[0], variables[other].dims[0])
                    if own != its and len(self.lengths[own]) == 1 and self.lengths[own] == self.lengths[its]:
                        self.same[own] = its

    def of(self, name, dim):
        at = (name.partition(".")[0], dim)
        for _ in self.same:
            at = self.same.get(at, at)
        return at


def text_variable(nc, name, dims, texts):
    longest = max([1, *(len(t.encode()) for t in texts)])
    if f"string{longest}" not in nc.dimensions:
        nc.createDimension(f"string{longest}", longest)
    made = nc.createVariable(name, "S1", (*dims, f"string{longest}"))
    made._Encoding = "utf-8"
    return made


def put_text(variable, at, text):
    data = text.encode()
    if data:
        variable[(*at, slice(0, len(data)))] = np.frombuffer(data, "S1")


def say(variable, **attributes):
    for name, text in attributes.items():
        if text or isinstance(text, float):
            variable.setncattr(name, text)


def define_axes(nc, source):
    for name, length in zip(source.dims, source.shape):
        nc.createDimension(name, length)
    for name, axis in source.axes.items():
        dims = (source.dims[axis["dimension"]],)
        if axis.get("values"):
            made = nc.createVariable(name, "f8", dims, fill_value=False)
            made[:] = axis["values"]
        else:
            made = text_variable(nc, name, dims, axis["words"])
            for i, word in enumerate(axis["words"]):
                put_text(made, (i,), word)
        say(made, long_name=axis["path"], units=axis.get("unit") if axis.get("values") else "")


def flags(nc, name, dims, meanings, first=0, **attributes):
    made = nc.createVariable(name, "i1", dims, fill_value=False)
    made.flag_meanings = " ".join(m.replace(" ", "_") for m in meanings)
    made.flag_values = np.arange(first, first + len(meanings), dtype="i1")
    say(made, **attributes)
    return made


def write_status(nc, source, records):
    dims = tuple(source.dims)
    states = list(dict.fromkeys(["ok", *(r["status"] for r in records)]))
    status = flags(nc, "status", dims, states, long_name="how the case ended")
    seconds = nc.createVariable("seconds", "f8", dims)
    say(seconds, long_name="time that the case took")
    verdict = flags(nc, "verdict", dims, ["none", *VERDICTS], -1, long_name="how far the case can be trusted")
    texts = {"reasons": ("the checks that are not good, the worst first", [", ".join(r["reasons"]) for r in records]),
             "reason": ("why the case failed", [r.get("reason") or "" for r in records]),
             "command": ("runs the case again, alone", [r.get("command") or "" for r in records])}
    for name, (doc, said) in texts.items():
        if any(said if name != "command" else texts["reason"][1]):
            made = text_variable(nc, name, dims, said)
            say(made, long_name=doc)
            for i, text in enumerate(said):
                put_text(made, point(source.shape, i), text)
    for i, r in enumerate(records):
        at = point(source.shape, i) or ...
        status[at] = states.index(r["status"])
        seconds[at] = r.get("seconds", np.nan)
        verdict[at] = VERDICTS.index(r["verdict"]) if r["verdict"] in VERDICTS else -1


def write_quality(nc, source, records):
    lines = {}  # (stage, name): the line in the first case that has it
    for r in records:
        for stage, found in (r.get("quality") or {}).items():
            for name, line in found.items():
                lines.setdefault((stage, name), line)
    for (stage, name), first in lines.items():
        called = f"{stage}.quality." + re.sub(r"[ /()\[\]{}\"'\\\x00-\x1f]", "_", name)
        value = nc.createVariable(called, "f8", tuple(source.dims), fill_value=np.nan)
        limit = first[1] if isinstance(first[1], (int, float)) and np.isfinite(first[1]) else None
        say(value, long_name=name, comment=first[3] if len(first) > 3 else "", ancillary_variables=called + ".verdict")
        if limit is not None:
            value.limit = float(limit)
        verdict = flags(nc, called + ".verdict", tuple(source.dims), ["none", *VERDICTS[:3]], -1)
        for i, r in enumerate(records):
            at, line = point(source.shape, i) or ..., ((r.get("quality") or {}).get(stage) or {}).get(name)
            verdict[at] = -1 if line is None else line[2]
            if line is not None and line[0] is not None:
                value[at] = line[0]


def define_dimensions(nc, source, variables, dimensions):
    """{dimension: the variable of its lengths}"""
    ragged = {}
    for (stage, dim), lengths in dimensions.lengths.items():
        if (stage, dim) in dimensions.same:
            continue
        name = f"{stage}.{dim}"
        if name in variables and len(variables[name].dims) + len(source.shape) > 1:
            name += ".index"  # a variable over the study cannot be the coordinate of its own dimension
        nc.createDimension(name, max(lengths) or 1)
        dimensions.lengths[stage, dim] = (name, lengths)
        if len(lengths) > 1:
            ragged[stage, dim] = nc.createVariable(name + ".length", "i4", tuple(source.dims))
            say(ragged[stage, dim], long_name=f"points along {name} that a case has")
    return ragged


def define_variables(nc, source, variables, dimensions, ragged):
    made = {}
    for name, array in variables.items():
        own = [dimensions.of(name, d) for d in array.dims]
        names = tuple(dimensions.lengths[d][0] for d in own)
        sizes = [len(nc.dimensions[n]) for n in names]
        coordinate = not source.shape and array.dims == (name.partition(".")[2],)
        large = names and SMALL <= np.prod(sizes) <= 1 << 28
        v = nc.createVariable(name, "f8", (*source.dims, *names), zlib=bool(large), complevel=1,
                              chunksizes=[1] * len(source.dims) + sizes if large else None,
                              fill_value=False if coordinate else np.nan)
        shared = [a for a in source.axes if a not in source.dims]
        for d, at in enumerate(own):
            shared += [k for k, series in variables.items()
                       if is_coordinate(k, series, name, array, d) and dimensions.of(k, series.dims[0]) == at]
        say(v, units=array.unit, long_name=array.doc or name, coordinates=" ".join(dict.fromkeys(shared)))
        if any(at in ragged for at in own):
            v.ancillary_variables = next(ragged[at].name for at in own if at in ragged)
        made[name] = v
    return made


def define_globals(nc, about):
    facts, models = about.get("facts") or {}, about.get("models") or {}
    for stage in (about["stages"] if isinstance(about["stages"], list) else ()):
        if stage.get("ran") and "reference" in stage:
            models.setdefault(stage["model"], stage)
    parameters = []
    for stage in about["stages"]:
        if stage.get("ran") is False:
            continue
        parameters += [f"{stage['stage']}: {stage['model']} {stage.get('version', '')}, file {stage.get('build', '')}"]
        parameters += [f"{stage['stage']}.{k}: {p['text']} ({p['origin']})" for k, p in (stage.get("parameters") or {}).items()]
    say(nc, Conventions="CF-1.10", title=about.get("title") or "", source=f"flankfilm {facts.get('flankfilm', '')}",
        history=f"{facts.get('date', '')}: computed by flankfilm from {facts.get('file', '')}",
        references="\n".join(f"{k}: {m.get('reference', '')}" for k, m in models.items()),
        parameters="\n".join(parameters), bibtex="\n".join(m.get("bibtex") or "" for m in models.values()))
    for name, text in facts.items():
        if name != "flankfilm":
            say(nc, **{"flankfilm_" + name.replace(" ", "_"): text})


def write(directory, path):
    opened = flankfilm.open(directory)
    source = Study(opened) if isinstance(opened, flankfilm.Study) else Run(opened)
    records = [source.record(i) for i in range(source.count)]
    variables, shapes = {}, {}
    for i in range(source.count):
        for name, array in source.arrays(i):
            shapes.setdefault(name, set()).add(np.shape(array.data))
            if name not in variables or len(array.dims) > len(variables[name].dims):
                variables[name] = flankfilm.program.Array(None, array.unit, tuple(array.dims), array.doc, array.against)
    dimensions = Dimensions(variables, shapes)
    with netCDF4.Dataset(path, "w", format="NETCDF4_CLASSIC") as nc:
        define_axes(nc, source)
        ragged = define_dimensions(nc, source, variables, dimensions)
        made = define_variables(nc, source, variables, dimensions, ragged)
        write_status(nc, source, records)
        write_quality(nc, source, records)
        define_globals(nc, source.about)
        for i in range(source.count):
            at = point(source.shape, i)
            for name, array in source.arrays(i):
                dims = variables[name].dims
                data = np.asarray(array.data, dtype=float)
                full = data.reshape((1,) * (len(dims) - data.ndim) + data.shape)
                made[name][(*at, *(slice(0, n) for n in full.shape)) or ...] = full if full.ndim else float(full)
                for d, n in zip(dims, full.shape):
                    if dimensions.of(name, d) in ragged:
                        ragged[dimensions.of(name, d)][at] = n


def main(argv):
    if len(argv) != 3:
        sys.exit("usage: flankfilm-netcdf DIRECTORY FILE.nc")
    try:
        write(*argv[1:])
    except flankfilm.Error as error:
        sys.exit(str(error))
    except (OSError, RuntimeError) as error:
        print(f"the file could not be written: {error}", file=sys.stderr)
        sys.stderr.flush()
        os._exit(1)  # a regular exit would let HDF5 write again to the full disk, and crash


if __name__ == "__main__":
    main(sys.argv)
