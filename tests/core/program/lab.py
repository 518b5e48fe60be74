# SPDX-License-Identifier: GPL-3.0-or-later
"""A scratch directory with results of toy models, and the program that exports them.

Arguments of a test: the program, the directory of its plugins, then the modules cli-toy-<name>.so.
"""
import ast
import json
import math
import os
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest

import records

RUN = """
format: 2
title: 'waves <b>&amp;</b> "quotes" é'
pipeline:
  wave: {use: toy/wave, amplitude: 2 mm, count: 9, end: doubtful}
  sum: {use: toy/sum, wave: wave}
outputs: [sum.sum, wave.height, wave.field, wave.x]
"""

ARGUMENTS = [os.path.abspath(path) for path in sys.argv[1:]]

# Lengths differ between cases, one case in three fails, and two paths share an axis.
STUDY = """
format: 2
title: waves of several lengths
pipeline:
  wave: {use: toy/wave, amplitude: 2 mm}
outputs: [wave.total, wave.height, wave.time, wave.field, wave.x]
study:
  sweep:
    wave.end: [good, doubtful, fail]
  zip:
    wave.amplitude: [0.1 mm, 2 mm]
    wave.count: [4, 7]
"""


class Lab(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        program, plugins, *toys = ARGUMENTS
        cls.program = program
        cls.directory = tempfile.mkdtemp(prefix="flankfilm-export-")
        toy = os.path.join(cls.directory, "plugins", "toy")
        os.makedirs(toy)
        for path in toys:
            os.symlink(path, os.path.join(toy, os.path.basename(path).replace("cli-toy-", "")))
        os.environ["FLANKFILM_PLUGIN_PATH"] = os.path.dirname(toy) + ":" + plugins
        os.chdir(cls.directory)
        for name, text in (("run", RUN), ("study", STUDY)):
            with open(name + ".yaml", "w", encoding="utf-8") as file:
                file.write(text)
        cls.call("run", "run.yaml", "-o", "run")
        cls.call("run", "study.yaml", "-o", "study", "-j", "1", code=4)

    @classmethod
    def tearDownClass(cls):
        os.chdir("/")
        shutil.rmtree(cls.directory)

    @classmethod
    def call(cls, *words, code=0, limit=None):
        """Runs the program; limit: largest file that it may write, in blocks of 512 bytes."""
        line = [cls.program, *words]
        if limit is not None:
            line = ["sh", "-c", f"trap '' XFSZ; ulimit -f {limit}; exec \"$@\"", "sh", *line]
        done = subprocess.run(line, capture_output=True, text=True, check=False)
        if done.returncode != code:
            raise AssertionError(f"{words}: code {done.returncode}\n{done.stdout}{done.stderr}")
        return done.stdout + done.stderr

    @staticmethod
    def write(name, text):
        with open(name, "w", encoding="utf-8") as file:
            file.write(text)

    @classmethod
    def answer(cls, text, sets, code=0):
        """What a run of the file with the assignments prints as JSON."""
        cls.write("order.yaml", text)
        words = [word for one in sets for word in ("--set", one)]
        return json.loads(cls.call("run", "order.yaml", "--json", *words, code=code))

    @staticmethod
    def read(name):
        with open(name, encoding="utf-8") as file:
            return json.load(file)

    @staticmethod
    def records():
        """The journal's record of each case, in their order."""
        found = {record["case"]: record for record in records.read("study/journal.jsonl")}
        return [found[number] for number in sorted(found)]

    @classmethod
    def arrays(cls, record):
        """The arrays of a case as entries of a run, from its log."""
        found = {}
        for name, entry in record["arrays"].items():
            unit, dims, shape, offset = entry[:4]
            with open(f"study/{record['log'][0]}", "rb") as file:
                file.seek(offset)
                length, key, start = struct.unpack("<Q24sQ", file.read(40))
                rest = file.read(length - 40)
            output, body = rest[:start - 40], rest[start - 40:-8]
            assert key.rstrip(b"\0").decode() == record["key"] and output.rstrip(b"\0").decode() == name
            found[name] = {"unit": unit, "dims": dims, "shape": shape, "data": cls.body(body, shape)}
        return found

    @classmethod
    def outputs(cls, directory):
        """The entries of all outputs, each array with its numbers as "data"."""
        told = cls.read(f"{directory}/result.json")
        found = {**told["outputs"], **told["computed"]}
        for entry in found.values():
            if "file" in entry:
                entry["data"] = cls.numbers(f"{directory}/{entry['file']}", entry["shape"])
        return found

    @staticmethod
    def numbers(name, shape):
        """What stands in a .npy file, which says so without numpy."""
        with open(name, "rb") as file:
            return Lab.body(file.read(), shape)

    @staticmethod
    def body(text, shape):
        """The numbers of what stands in such a file."""
        magic, length = struct.unpack("<8sH", text[:10])
        header, body = ast.literal_eval(text[10:10 + length].decode("ascii")), text[10 + length:]
        assert magic == b"\x93NUMPY\1\0" and (10 + length) % 64 == 0, text[:10]
        assert header == {"descr": "<f8", "fortran_order": False, "shape": tuple(shape)}, header
        return list(struct.unpack(f"<{math.prod(shape)}d", body))


def main():
    result = unittest.main(argv=[sys.argv[0]], exit=False).result
    sys.exit(not (result.testsRun and result.wasSuccessful()))
