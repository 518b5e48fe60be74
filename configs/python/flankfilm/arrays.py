# SPDX-License-Identifier: GPL-3.0-or-later
"""Numbers with their unit and dimensions, and what is raised."""

import numpy as np


class Error(Exception):
    """What the program or the engine said. `errors`: its messages with file, line and column;
    `code`: its exit code; `result`: what a run that failed has left, or None."""

    def __init__(self, text, code=None, errors=(), result=None):
        super().__init__(text)
        self.code, self.errors, self.result = code, list(errors), result


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
