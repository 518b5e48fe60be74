# SPDX-License-Identifier: GPL-3.0-or-later
"""Arrays with unit and dimensions, and the exception Error."""

import os
from collections.abc import Mapping

import numpy as np


class Error(Exception):
    """An error of the program or the engine. `errors`: its messages with file, line and column;
    `code`: its exit code; `result`: the results of a failed run, or None."""

    def __init__(self, text, code=None, errors=(), result=None):
        super().__init__(text)
        self.code, self.errors, self.result = code, list(errors), result


def wrong(name, wanted, found):
    """The Error for an argument: 'sets: expected a dictionary, found a list'."""
    kind = type(found).__name__
    return Error(f"{name}: expected {wanted}, found {'an' if kind[0] in 'aeiou' else 'a'} {kind}", 2)


def as_items(name, mapping):
    """The items of a dictionary whose keys are names; none if the dictionary is None."""
    mapping = {} if mapping is None else mapping
    if not isinstance(mapping, Mapping):
        raise wrong(name, "a dictionary", mapping)
    for key in mapping:
        as_name(name, key)
    return mapping.items()


def as_name(name, value):
    if not isinstance(value, str):
        raise wrong(name, "a name", value)
    return value


def as_list(name, value):
    """A list of texts; a single text counts as a list of one."""
    if isinstance(value, (str, os.PathLike)):
        return [value]
    try:
        return list(value)
    except TypeError:
        raise wrong(name, "a text or a list of texts", value) from None


def as_path(name, value):
    try:
        return os.fspath(value)
    except TypeError:
        raise wrong(name, "a path", value) from None


def as_numbers(name, value):
    """The value as an array of doubles."""
    try:
        array = np.asarray(value)
    except ValueError:  # lists of different lengths
        array = None
    if array is None or array.dtype.kind not in "biuf":
        raise wrong(name, "numbers", value)
    return np.ascontiguousarray(array, dtype=float).reshape(array.shape)


class Array:
    """Numbers with their unit and the names of their dimensions; a scalar has none."""

    def __init__(self, data, unit, dims=(), doc="", against=()):
        self.data, self.unit, self.dims = np.asarray(data), unit, tuple(dims)
        self.doc, self.against = doc, tuple(against)

    def __array__(self, dtype=None):
        return self.data if dtype is None else self.data.astype(dtype)

    def __float__(self):
        return float(self.data)

    def __len__(self):
        return len(self.data)

    def __getitem__(self, index):
        return self.data[index]

    def __repr__(self):
        if not self.dims:
            return f"{self.data[()]} {self.unit}"
        shape = ", ".join(f"{d}: {n}" for d, n in zip(self.dims, self.data.shape))
        return f"<Array in {self.unit}, {shape}>"
