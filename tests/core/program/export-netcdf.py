# SPDX-License-Identifier: GPL-3.0-or-later
"""xarray opens what flankfilm-netcdf makes, and finds names, units and values to the last bit."""
import os
import shutil
import subprocess
import sys

import lab

try:
    import netCDF4  # noqa: F401: what xarray reads with
    import numpy as np
    import xarray as xr
except ImportError as error:
    print("needs the Python module", error.name)
    sys.exit(77)


class Run(lab.Lab):
    def setUp(self):
        self.call("export", "run", "--to", "netcdf")
        self.data = xr.open_dataset("run/results.nc")
        self.addCleanup(self.data.close)
        self.json = self.read("run/result.json")

    def test_values(self):
        outputs = self.outputs("run")
        self.assertIn("wave.time", outputs)
        for name, entry in outputs.items():
            values = self.data[name].values
            expected = np.array(entry.get("data", entry.get("value")), dtype=float)
            self.assertEqual(values.shape, tuple(entry.get("shape", ())), name)
            self.assertEqual(values.tobytes(), expected.reshape(values.shape).tobytes(), name)

    def test_attributes(self):
        height = self.data["wave.height"]
        self.assertEqual(height.attrs["units"], "m")
        self.assertEqual(height.attrs["long_name"], "height of the wave")
        self.assertEqual(height.dims, ("wave.t",))
        self.assertIn("wave.time", height.coords)
        self.assertEqual(self.data["wave.field"].dims, ("wave.t", "wave.x"))
        np.testing.assert_allclose(self.data["wave.field"]["wave.x"], np.arange(10) * 1e-5)

    def test_title_and_origin(self):
        self.assertEqual(self.data.attrs["Conventions"], "CF-1.10")
        self.assertEqual(self.data.attrs["title"], 'waves <b>&amp;</b> "quotes" é')
        self.assertRegex(self.data.attrs["source"], r"^flankfilm \d")
        self.assertIn("run.yaml", self.data.attrs["history"])
        self.assertIn("wave.amplitude: 2 mm (run.yaml:5)", self.data.attrs["parameters"])

    def test_quality(self):
        line = self.json["stages"][0]["quality"]["residual"]
        quality = self.data["wave.quality.residual"]
        self.assertEqual(float(quality), line["value"])
        self.assertEqual(quality.attrs["limit"], line["limit"])
        verdict = self.data["wave.quality.residual.verdict"]
        meanings = dict(zip(verdict.attrs["flag_values"], verdict.attrs["flag_meanings"].split()))
        self.assertEqual(meanings[int(verdict)], line["verdict"])


class Study(lab.Lab):
    def setUp(self):
        self.call("export", "study", "--to", "netcdf", "-o", "deep/er/study.nc")
        self.data = xr.open_dataset("deep/er/study.nc")
        self.addCleanup(self.data.close)
        self.cases = self.records()

    def at(self, record):
        """The case in the order of the axes."""
        ends = ["good", "doubtful", "fail"]
        return {
            "end": ends.index(record["set"]["wave.end"]),
            "point_2": int(record["set"]["wave.count"] == "7"),
        }

    def test_axes(self):
        self.assertEqual(dict(self.data.sizes)["end"], 3)
        self.assertEqual(list(self.data["end"].values), ["good", "doubtful", "fail"])
        np.testing.assert_array_equal(self.data["amplitude"], [1e-4, 2e-3])
        self.assertEqual(self.data["amplitude"].attrs["units"], "m")
        self.assertEqual(self.data["amplitude"].attrs["long_name"], "wave.amplitude")
        np.testing.assert_array_equal(self.data["count"], [4, 7])
        self.assertIn("amplitude", self.data["wave.total"].coords)
        self.assertEqual(self.data["wave.total"].dims, ("end", "point_2"))

    def test_scalars(self):
        good = 0
        for record in self.cases:
            value = float(self.data["wave.total"].isel(self.at(record)))
            if "outputs" in record:
                self.assertEqual(value, record["outputs"]["wave.total"][1])
                good += 1
            else:
                self.assertTrue(np.isnan(value))
        self.assertEqual(good, 4)

    def test_ragged(self):
        lengths = self.data["wave.t.length"]
        self.assertEqual(self.data["wave.height"].attrs["ancillary_variables"], "wave.t.length")
        for record in self.cases:
            at = self.at(record)
            values = self.data["wave.height"].isel(at).values
            count = int(lengths.isel(at)) if record["status"] == "ok" else 0
            self.assertTrue(np.isnan(values[count:]).all())
            if record["status"] == "ok":
                self.assertEqual(count, int(record["set"]["wave.count"]))
                self.assertEqual(values[:count].tolist(), self.arrays(record)["wave.height"]["data"])

    def test_fields(self):
        self.assertEqual([record["status"] for record in self.cases].count("ok"), 4)
        for record in self.cases:
            if record["status"] != "ok":
                continue
            entry = self.arrays(record)["wave.field"]
            rows, columns = entry["shape"]
            values = self.data["wave.field"].isel(self.at(record)).values[:rows, :columns]
            self.assertEqual(values.ravel().tolist(), entry["data"])

    def test_failures(self):
        status = self.data["status"]
        meanings = dict(zip(status.attrs["flag_values"], status.attrs["flag_meanings"].split()))
        for record in self.cases:
            at = self.at(record)
            self.assertEqual(meanings[int(status.isel(at))], record["status"].replace(" ", "_"))
            self.assertEqual(str(self.data["reason"].isel(at).values), record.get("reason", ""))
            self.assertEqual(str(self.data["command"].isel(at).values), record.get("command", ""))


class Errors(lab.Lab):
    def test_no_program(self):
        """A program without its companion says so, and leaves what stood there."""
        alone = os.path.join(self.directory, "alone")
        os.makedirs(alone, exist_ok=True)
        shutil.copy(self.program, alone)
        environment = {**os.environ, "LD_LIBRARY_PATH": os.path.dirname(self.program)}
        done = subprocess.run([alone + "/flankfilm", "export", "run", "--to", "netcdf", "-o", "none.nc"],
                              capture_output=True, text=True, env=environment, check=False)
        self.assertEqual(done.returncode, 2)
        self.assertIn("the program flankfilm-netcdf is not in the folder of flankfilm", done.stderr)
        self.assertIn("netCDF4", done.stderr)
        self.assertFalse([name for name in os.listdir(".") if name.startswith("none.nc")])

    def test_no_results(self):
        os.makedirs("bare-nc", exist_ok=True)
        said = self.call("export", "bare-nc", "--to", "netcdf", "-o", "bare.nc", code=1)
        self.assertIn("bare-nc: no results of flankfilm in this directory", said)

    def test_disk_full(self):
        self.call("export", "run", "--to", "netcdf", "-o", "full.nc")
        with open("full.nc", "rb") as file:
            before = file.read()
        said = self.call("export", "study", "--to", "netcdf", "-o", "full.nc", code=1, limit=8)
        self.assertIn("could not be written", said)
        with open("full.nc", "rb") as file:
            self.assertEqual(file.read(), before)
        self.assertFalse([name for name in os.listdir(".") if name.endswith(".part")])


lab.main()
