# SPDX-License-Identifier: GPL-3.0-or-later
"""The journals of a study and the logs with the arrays of its cases; core/program/arrays/log.h
describes the layout of the logs."""

import io
import json
import mmap
import os
import struct
import zlib

import numpy as np

from .arrays import Error

FORMAT = 2  # of the files of a study
TITLE = b"flankfilm arrays, format 1".ljust(63) + b"\n"


def filled(form, values):
    """A record: its form, in which the values of a line replace each None."""
    if isinstance(form, dict):
        return {key: filled(item, values) for key, item in form.items()}
    if isinstance(form, list):
        return [filled(item, values) for item in form]
    return next(values) if form is None else form


def records_of(path):
    """{key: record} of all journals of a study. A truncated line is ignored; if a case has several
    lines, the last one that is ok counts."""
    records, forms = {}, {}
    for name in sorted(os.listdir(path)):
        if not (name.startswith("journal") and name.endswith(".jsonl")):
            continue
        with open(os.path.join(path, name), encoding="utf-8") as file:
            for line in file:
                try:
                    record = json.loads(line)
                except ValueError:
                    continue
                form = record.get("form")
                if "is" in record:
                    forms[form] = record.pop("is")
                if form is not None:
                    if form not in forms:
                        continue
                    record.update(filled(forms[form], iter(record.pop("values"))))
                key = record.get("key")
                if key and (record["status"] == "ok" or records.get(key, record)["status"] != "ok"):
                    records[key] = record
    return records


class Logs:
    """The logs of a study. They are mapped: unused arrays take no memory, and writing to an
    array does not change its log."""

    def __init__(self, path):
        self._path, self._maps = path, {}

    def _map(self, name):
        if name not in self._maps:
            path = os.path.join(self._path, name)
            if not name or name != os.path.basename(name) or name.startswith("."):
                raise Error(f"{self._path}: \"{name}\" is not the name of a file beside its journal")
            try:
                with open(path, "rb") as file:
                    self._maps[name] = mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_COPY)
            except (OSError, ValueError) as error:
                raise Error(f"{path} cannot be read: {error}") from None
            if self._maps[name][:64] != TITLE:
                del self._maps[name]
                raise Error(f"{path} cannot be read: it is not a log of arrays with format 1")
        return self._maps[name]

    def read(self, record, output):
        """The numbers of an output of a case."""
        name, (shape, offset) = record["log"][0], record["arrays"][output][2:4]
        log = self._map(name)
        where = f"{output} of case {record['case']}, in {os.path.join(self._path, name)}, cannot be read: " \
                f"the record at byte {offset}"
        if len(log) < offset + 40:
            raise Error(where + " is cut off")
        length, key, start = struct.unpack_from("<Q24sQ", log, offset)
        if not 40 <= start < length <= len(log) - offset:
            raise Error(where + " is cut off")
        told, = struct.unpack_from("<Q", log, offset + length - 8)
        if zlib.crc32(memoryview(log)[offset:offset + length - 8]) != told:
            raise Error(where + " does not have its checksum")
        head = io.BytesIO(log[offset + start:offset + min(start + 512, length)])
        np.lib.format.read_magic(head)
        found = np.lib.format.read_array_header_1_0(head)
        label = (key.rstrip(b"\0").decode(), log[offset + 40:offset + start].rstrip(b"\0").decode())
        if label != (record["key"], output) or found != (tuple(shape), False, np.dtype("<f8")):
            raise Error(where + " belongs to another array")
        count = int(np.prod(shape, dtype=int))
        return np.frombuffer(log, "<f8", count, offset + start + head.tell()).reshape(shape)
