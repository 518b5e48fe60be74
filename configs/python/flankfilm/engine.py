# SPDX-License-Identifier: GPL-3.0-or-later
"""The engine in this process, through libflankfilm: runs, single models, and laws.

A model is foreign code in this process: if it crashes, Python crashes, too. flankfilm.run starts
the program in a separate process instead.
"""

import contextlib
import ctypes
import glob
import os
import signal
import threading
from collections.abc import Mapping
from ctypes import POINTER, byref, c_char_p, c_double, c_int32, c_size_t, c_uint32, c_void_p

import numpy as np

from .arrays import Array, Error, as_items, as_list, as_name, as_numbers, as_path, wrong
from .program import _program, as_text, assignments

VERDICTS = ("good", "doubtful", "bad")
STOPPED, INVALID, NOMEM, BUG = 3, -1, -2, -4


# The structs of flankfilm/engine.h, laws.h and plugin.h, as far as they are read here.
class _Options(ctypes.Structure):
    _fields_ = [("size", c_size_t), ("plugin_paths", POINTER(c_char_p)),
                ("plugin_path_count", c_size_t)]


class _Port(ctypes.Structure):
    _fields_ = [("name", c_char_p), ("unit", c_char_p), ("doc", c_char_p)]


class _Result(ctypes.Structure):
    _fields_ = [("row", POINTER(_Port)), ("data", c_void_p), ("rank", c_uint32),
                ("shape", c_size_t * 4), ("dims", c_char_p * 4), ("count", c_size_t)]


class _Quality(ctypes.Structure):
    _fields_ = [("stage", c_char_p), ("name", c_char_p), ("value", c_double), ("limit", c_double),
                ("verdict", c_int32), ("text", c_char_p)]


class _InputArray(ctypes.Structure):
    _fields_ = [("data", c_void_p), ("shape", POINTER(c_size_t)), ("rank", c_uint32)]


_Progress = ctypes.CFUNCTYPE(c_int32, c_void_p, c_void_p, c_double)


class _Observer(ctypes.Structure):
    _fields_ = [("size", c_size_t), ("ctx", c_void_p), ("progress", _Progress), ("log", c_void_p)]


class _Service(ctypes.Structure):  # functions follow
    _fields_ = [("size", c_size_t), ("self", c_void_p)]


_FUNCTIONS = {
    "ff_engine_new": (c_int32, POINTER(_Options), POINTER(c_void_p)),
    "ff_engine_close": (None, c_void_p),
    "ff_engine_message": (c_char_p, c_void_p),
    "ff_run_open": (c_int32, c_void_p, c_char_p, POINTER(c_char_p), POINTER(c_void_p)),
    "ff_run_close": (None, c_void_p),
    "ff_run_start": (c_int32, c_void_p, POINTER(_Observer)),
    "ff_run_result": (c_int32, c_void_p, c_char_p, POINTER(POINTER(_Result))),
    "ff_run_output": (c_int32, c_void_p, c_size_t, POINTER(c_char_p), POINTER(POINTER(_Result))),
    "ff_run_quality": (c_int32, c_void_p, c_size_t, POINTER(POINTER(_Quality))),
    "ff_instance_new": (c_int32, c_void_p, c_char_p, POINTER(c_void_p)),
    "ff_instance_close": (None, c_void_p),
    "ff_instance_set": (c_int32, c_void_p, c_char_p, c_char_p),
    "ff_instance_set_reals": (c_int32, c_void_p, c_char_p, c_void_p, c_size_t),
    "ff_instance_give": (c_int32, c_void_p, c_char_p, POINTER(_InputArray)),
    "ff_instance_use": (c_int32, c_void_p, c_char_p, c_void_p),
    "ff_instance_run": (c_int32, c_void_p, c_char_p),
    "ff_instance_result": (c_int32, c_void_p, c_char_p, POINTER(POINTER(_Result))),
    "ff_instance_quality": (c_int32, c_void_p, c_size_t, POINTER(POINTER(_Quality))),
    "ff_instance_service": (c_int32, c_void_p, c_char_p, POINTER(POINTER(_Service))),
}


def _places():
    """Possible paths of the library: FLANKFILM_LIBRARY, beside the program, the linker's folders."""
    if os.environ.get("FLANKFILM_LIBRARY"):
        yield os.environ["FLANKFILM_LIBRARY"]
        return
    try:
        folder = os.path.dirname(os.path.realpath(_program()[0]))
    except Error:
        folder = None
    for pattern in (".", "../lib*", "../lib/*"):
        yield from sorted(glob.glob(os.path.join(folder, pattern, "libflankfilm.so.0")) if folder else [])
    yield "libflankfilm.so.0"


def _load():
    for place in _places():
        try:
            library = ctypes.CDLL(place)
        except OSError as error:
            reason = error
            continue
        for name, (answer, *arguments) in _FUNCTIONS.items():
            function = getattr(library, name)
            function.restype, function.argtypes = answer, arguments
        return library
    raise Error(f"libflankfilm is not found; put its place into FLANKFILM_LIBRARY ({reason})")


def _code(status):
    """The exit code with which the program would end."""
    return 2 if status == INVALID else 3 if status == BUG else 1


def _words(text):
    return text.decode("utf-8", "replace") if text else ""


def _array(result, owner):
    """An Array that shares memory of the engine; `owner` keeps this memory alive."""
    memory = (c_double * max(result.count, 1)).from_address(result.data)
    memory.owner = owner
    # a read-only buffer, so that nobody can make the array writable
    data = np.frombuffer(memoryview(memory).toreadonly(), count=result.count)
    data = data.reshape(tuple(result.shape[:result.rank]))
    dims = [_words(name) for name in result.dims[:result.rank]]
    return Array(data, _words(result.row[0].unit), dims, _words(result.row[0].doc))


def _lines(function, handle):
    line, index = POINTER(_Quality)(), 0
    while function(handle, index, byref(line)) == 0:
        yield line[0]
        index += 1


def _line(q):
    return {"value": q.value, "limit": q.limit, "verdict": VERDICTS[q.verdict], "text": _words(q.text)}


@contextlib.contextmanager
def _interrupts(stopped):
    """Delays Ctrl-C in the main thread until the engine has stopped."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    before = signal.signal(signal.SIGINT, lambda *_: stopped.append(KeyboardInterrupt()))
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)


class Engine:
    """Loads models and runs pipelines in this process. Only one thread at a time may use an engine with its
    runs and models; different engines may run in different threads at the same time.

    plugin_paths  a directory or a list of directories, which are searched first for models"""

    def __init__(self, plugin_paths=()):
        self._engine, self._library = c_void_p(), _load()
        self._open = {}  # the function that closes each run and model, by its handle
        paths = [os.fsencode(as_path("plugin_paths", path))
                 for path in as_list("plugin_paths", plugin_paths)]
        options = _Options(ctypes.sizeof(_Options), (c_char_p * len(paths))(*paths), len(paths))
        if self._library.ff_engine_new(byref(options), byref(self._engine)):
            raise MemoryError

    def __del__(self):  # in a cycle of objects, Python may delete any of them first
        for handle in list(getattr(self, "_open", ())):
            self._close(handle)
        if getattr(self, "_engine", None):
            self._library.ff_engine_close(self._engine)

    def _close(self, handle):
        close = self._open.pop(handle, None)
        if close:
            close(handle)

    def _hold(self, status, result=None):
        """Raises the error of a call, if there is one."""
        if status == NOMEM:
            raise MemoryError
        if status < 0 or status > 1:
            raise Error(self._message(), _code(status), result=result)

    def _message(self):
        return _words(self._library.ff_engine_message(self._engine)).rstrip()

    def run(self, file, sets=None, progress=None):
        """Runs the case of a file, with the values in `sets`, such as {"duty.torque": "300 N m"}, in place of those
        of the file. Values are texts, numbers (for parameters without a unit), lists and numpy arrays.
        `progress` is called with the finished share of the current stage; the run stops if it returns True.
        Files with a study, an accuracy or `use: KIND/auto` are refused; use flankfilm.run."""
        words = [text.encode() for text in assignments(sets)]
        handle = c_void_p()
        if progress is not None and not callable(progress):
            raise wrong("progress", "a function", progress)
        self._hold(self._library.ff_run_open(
            self._engine, os.fsencode(as_path("file", file)), (c_char_p * (len(words) + 1))(*words), byref(handle)))
        run = Run(self, handle)
        run._start(progress)
        return run

    def model(self, name, parameters=None, wires=None):
        """One model without a file: engine.model("viscosity/barus", {"alpha": "20 1/GPa"})."""
        model = Model(self, name)
        model.set(parameters or {})
        model.use(wires or {})
        return model


class Run(Mapping):
    """A finished run: a mapping of "stage.output" to Array. The arrays are read-only and share the memory of the
    engine, which stays allocated as long as they exist. `quality` has the quality lines of each
    stage, `warnings` the warnings of the engine."""

    def __init__(self, engine, handle):
        self._of, self._library, self._run = engine, engine._library, handle
        self.warnings = ""
        engine._open[handle.value] = self._library.ff_run_close

    def __del__(self):
        self._of._close(self._run.value)

    def _start(self, progress):
        stopped = []

        def report(_ctx, _stage, share):
            try:
                return int(bool(stopped) or bool(progress and progress(share)))
            except BaseException as error:  # it must not pass through C
                stopped.append(error)
                return 1

        observer = _Observer(ctypes.sizeof(_Observer), None, _Progress(report), None)
        with _interrupts(stopped):
            status = self._library.ff_run_start(self._run, byref(observer))
        if stopped:
            raise stopped[0]
        self._of._hold(status, self)
        self.warnings = _words(self._library.ff_engine_message(self._of._engine))

    @property
    def quality(self):
        lines = {}
        for q in _lines(self._library.ff_run_quality, self._run):
            lines.setdefault(_words(q.stage), {})[_words(q.name)] = _line(q)
        return lines

    def __getitem__(self, name):
        result = POINTER(_Result)()
        if self._library.ff_run_result(self._run, str(name).encode(), byref(result)):
            raise KeyError(f"{self._of._message()}; the run has {', '.join(self)}")
        return _array(result[0], self)

    def __iter__(self):
        stage, result, index = c_char_p(), POINTER(_Result)(), 0
        while self._library.ff_run_output(self._run, index, byref(stage), byref(result)) == 0:
            yield f"{_words(stage.value)}.{_words(result[0].row[0].name)}"
            index += 1

    def __len__(self):
        return sum(1 for _ in self)

    def __repr__(self):
        return f"<Run: {', '.join(self)}>"


class Model:
    """One model without a file. Texts are parsed as in a file, "3 mm"; numbers and arrays are in SI. `warnings` has
    the warnings of the last call."""

    def __init__(self, engine, name):
        self._of, self._library, self.name = engine, engine._library, name
        self._model, self._used = c_void_p(), {}
        self._hold(self._library.ff_instance_new(engine._engine, as_name("model", name).encode(),
                                                 byref(self._model)))
        engine._open[self._model.value] = self._library.ff_instance_close

    def __del__(self):
        self._of._close(self._model.value)

    def _hold(self, status):
        self._of._hold(status)
        self.warnings = _words(self._library.ff_engine_message(self._of._engine))

    def set(self, parameters):
        for name, value in as_items("parameters", parameters):
            texts = isinstance(value, (list, tuple)) and any(isinstance(v, str) for v in value)
            if texts or isinstance(value, (str, bool, np.bool_, os.PathLike)):
                status = self._library.ff_instance_set(self._model, name.encode(),
                                                       as_text(name, value).encode())
            else:
                numbers = as_numbers(name, value).ravel()
                status = self._library.ff_instance_set_reals(
                    self._model, name.encode(), numbers.ctypes.data, numbers.size)
            self._hold(status)

    def use(self, wires):
        """Connects wires to other models: film.use({"viscosity": barus})."""
        for name, model in as_items("wires", wires):
            if not isinstance(model, Model) or model._of is not self._of:
                raise wrong(name, "a model of the same engine", model)
            self._hold(self._library.ff_instance_use(self._model, name.encode(), model._model))
            self._used[name] = model  # keeps it alive as long as this one

    def give(self, inputs):
        """Sets inputs to numbers in SI: film.give({"contact.load_per_width": load})."""
        for name, value in as_items("inputs", inputs):
            numbers = as_numbers(name, value)
            shape = (c_size_t * max(numbers.ndim, 1))(*numbers.shape)
            array = _InputArray(numbers.ctypes.data, shape, numbers.ndim)
            self._hold(self._library.ff_instance_give(self._model, name.encode(), byref(array)))

    def run(self, *outputs):
        """Runs the models wired to this one, then this one; returns a dictionary of Arrays, which are copies."""
        if not outputs:
            raise Error(f"{self.name}: name the outputs that are wanted", 2)
        for name in outputs:
            as_name(f"{self.name}: an output", name)
        self._hold(self._library.ff_instance_run(self._model, " ".join(outputs).encode()))
        results = {}
        for name in outputs:
            result = POINTER(_Result)()
            self._hold(self._library.ff_instance_result(self._model, name.encode(), byref(result)))
            results[name] = _array(result[0], self)
            results[name].data = results[name].data.copy()
        return results

    @property
    def quality(self):
        return {_words(q.name): _line(q)
                for q in _lines(self._library.ff_instance_quality, self._model)}

    def law(self):
        """The law as functions of numpy arrays; the classes below describe them for each kind."""
        kind = self.name.partition("/")[0]
        if kind not in _LAWS:
            raise Error(f"{self.name} is not a law; laws are of the kinds {', '.join(_LAWS)}", 2)
        return _LAWS[kind](self)


def _like(**arrays):
    """The arrays as doubles of one common shape; None stays None."""
    given = {name: as_numbers(name, a) for name, a in arrays.items() if a is not None}
    try:
        shape = np.broadcast_shapes(*(a.shape for a in given.values()))
    except ValueError:
        shapes = ", ".join(f"{name} {a.shape}" for name, a in given.items())
        raise Error(f"arrays that do not fit each other: {shapes}", 2) from None
    return [np.array(np.broadcast_to(given[name], shape), order="C") if name in given else None
            for name in arrays]


def _one(name, value):
    """A number."""
    number = as_numbers(name, value)
    if number.size != 1:
        raise wrong(name, "one number", value)
    return float(number.reshape(()))


def _at(array):
    return None if array is None else array.ctypes.data


class _Law:
    """The functions of a service; `domain` is True after a call outside the law's range."""

    def __init__(self, model, interface, *functions):
        self._model, self._interface, self.domain = model, interface, False
        self._types = [ctypes.CFUNCTYPE(c_int32, c_void_p, *arguments) for arguments in functions]
        self._table()

    def _table(self):
        """The present table of functions, since the model's parameters may have changed."""
        table = POINTER(_Service)()
        self._model._hold(self._model._library.ff_instance_service(
            self._model._model, self._interface, byref(table)))
        return table

    def _call(self, which, *arguments):
        table = self._table()
        places = ctypes.cast(byref(table[0], ctypes.sizeof(_Service)), POINTER(c_void_p))
        status = self._types[which](places[which])(table[0].self, *arguments)
        if status not in (0, 1):
            raise Error(f"{self._model.name}: the law answered with the status {status}", 3)
        self.domain = status == 1


class _PressureLaw(_Law):
    """law(p, T): viscosity laws return ln(eta / 1 Pa s), density laws rho, kg/m3, at the pressure p, Pa,
    and the temperature T, K; if T is None, at the law's own temperature. With `slopes=True` they
    return three arrays: the value, and its derivatives with respect to p and T."""

    def __init__(self, model, interface):
        super().__init__(model, interface, (c_size_t, *[c_void_p] * 5))

    def __call__(self, p, T=None, slopes=False):
        if p is None:
            raise wrong("p", "numbers", p)
        p, T = _like(p=p, T=T)
        value, over_p, over_T = (np.empty_like(p) for _ in range(3))
        self._call(0, p.size, _at(p), _at(T), _at(value), _at(over_p), _at(over_T))
        return (value, over_p, over_T) if slopes else value


class _FlowLaw(_Law):
    """The effect of shear on the flow in a film. The arguments of both functions, except u_s, may be arrays of one shape:

    ln_eta  ln(eta / 1 Pa s) of the unsheared liquid, from a viscosity law
    h       the film thickness at that point, m, above 0
    u_s     the sliding speed u_1 - u_2 of the surfaces, m/s, one number; the stress has its sign
    p       the pressure, Pa"""

    def __init__(self, model):
        super().__init__(model, b"flankfilm.rheology/1",
                         (c_size_t, c_void_p, c_void_p, c_double, *[c_void_p] * 3),
                         (c_size_t, c_void_p, c_void_p, c_void_p, c_double, c_void_p))

    def flow(self, ln_eta, h, u_s, slopes=False):
        """The effective fluidity psi for pressure flow, 1/(Pa s), which is 1/eta for a Newtonian liquid. With
        `slopes=True` three arrays: psi, and its derivatives with respect to ln_eta and h."""
        ln_eta, h = _like(ln_eta=ln_eta, h=h)
        u_s = _one("u_s", u_s)
        psi, over_ln_eta, over_h = (np.empty_like(h) for _ in range(3))
        self._call(0, h.size, _at(ln_eta), _at(h), u_s, _at(psi), _at(over_ln_eta), _at(over_h))
        return (psi, over_ln_eta, over_h) if slopes else psi

    def shear(self, p, ln_eta, h, u_s):
        """The mean shear stress of the film, Pa."""
        p, ln_eta, h = _like(p=p, ln_eta=ln_eta, h=h)
        u_s = _one("u_s", u_s)
        tau = np.empty_like(h)
        self._call(1, h.size, _at(p), _at(ln_eta), _at(h), u_s, _at(tau))
        return tau


class _Liquid(_Law):
    """liquid("rho0", T): a property of the oil at ambient pressure and the temperature T, K; NaN if
    the oil's data lack it. With `slopes=True` two arrays: the property, and its derivative with respect to T.

    "ln_eta0"                ln(eta / 1 Pa s)
    "rho0"                   density, kg/m3
    "conductivity"           thermal, W/(m K)
    "heat_capacity"          J/(kg K)
    "pressure_coefficient"   dln(eta)/dp, 1/Pa
    "reference_temperature"  temperature at which the oil's data were given, K (independent of T)"""

    PROPERTIES = ("ln_eta0", "rho0", "conductivity", "heat_capacity", "pressure_coefficient",
                  "reference_temperature")

    def __init__(self, model):
        super().__init__(model, b"flankfilm.liquid/1",
                         (c_int32, c_size_t, c_void_p, c_void_p, c_void_p))

    def __call__(self, name, T, slopes=False):
        if name not in self.PROPERTIES:
            raise Error(f"an oil has {', '.join(self.PROPERTIES)}; it has no \"{name}\"", 2)
        (T,) = _like(T=T)
        value, slope = np.empty_like(T), np.empty_like(T)
        self._call(0, self.PROPERTIES.index(name), T.size, _at(T), _at(value), _at(slope))
        return (value, slope) if slopes else value


_LAWS = {
    "viscosity": lambda model: _PressureLaw(model, b"flankfilm.viscosity/1"),
    "density": lambda model: _PressureLaw(model, b"flankfilm.density/1"),
    "rheology": _FlowLaw,
    "lubricant": _Liquid,
}
