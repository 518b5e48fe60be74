#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Compares films with the models and laws chosen for an accuracy with finer films of reference models: choices.py FLANKFILM SOURCE"""
import json
import os
import subprocess
import sys
import tempfile

PROGRAM, SOURCE = sys.argv[1], os.path.abspath(sys.argv[2])
DISCS = f"""format: 2
accuracy: 5 %
include: [{SOURCE}/configs/lubricants/mil-l-23699.yaml]
pipeline:
  oil: {{temperature: 100 degC}}
  discs: {{use: contact/constant, radius: 20 mm, entrainment_speed: 4 m/s, slide_roll_ratio: 0.01, load_per_width: 100 N/mm}}
  viscosity: {{use: viscosity/auto}}
  density: {{use: density/auto}}
  flow: {{use: rheology/auto, reference: rheology/ree-eyring}}
  film: {{use: ehl/auto, reference: ehl/finite-volume}}
outputs: [film.h_min_lowest]
"""
LAWS = ("viscosity", "density", "flow")
REFERENCES = ["viscosity.use=viscosity/doolittle-tait", "density.use=density/dowson-higginson", "flow.use=rheology/ree-eyring",
              "film.use=ehl/finite-volume", "film.cells=2048", "film.tolerance=1e-8", "accuracy="]
SOFT = ["discs.reduced_modulus=0.05 GPa", "discs.load_per_width=0.5 N/mm"]
LIGHT = ["discs.load_per_width=0.5 N/mm", "viscosity.use=viscosity/isoviscous"]
SHEARED = ["discs.slide_roll_ratio=0.3", "discs.load_per_width=400 N/mm", "outputs=[film.friction_coefficient]"]


def run(file, sets):
    words = [word for one in sets for word in ("--set", one)]
    done = subprocess.run([PROGRAM, "run", file, "--json", *words], stdout=subprocess.PIPE, text=True, check=False)
    answer = json.loads(done.stdout)
    assert answer["status"] == "ok", answer["errors"]
    return answer


def value_of(output):
    return output["value"] if "value" in output else max(output["data"], key=abs)


def check(file, sets, expected):
    """Checks the chosen models, and that the error bar covers the difference to the reference models."""
    answer, truth = run(file, sets), run(file, [*sets, *REFERENCES])
    models = {stage["stage"]: stage["model"] for stage in answer["stages"]}
    for name, output in answer["outputs"].items():
        exact, bar = value_of(truth["outputs"][name]), output["error"]["relative"]
        error = abs(value_of(output) / exact - 1)
        print(f"{name} {' '.join(sets)}: {100 * error:.3g} % of {100 * bar:.3g} %;",
              ", ".join(models[s] for s in (*LAWS, "film")))
        for tried in answer["accuracy"]["models"]:
            print(f"    {tried['model']}: {tried['reason'] or 'taken'}")
        assert error <= bar <= output["error"]["goal"], (error, output["error"])
    for stage, model in expected.items():
        taken = models[stage] == model.lstrip("!")
        assert taken != model.startswith("!"), (stage, models[stage], model)


def main():
    with tempfile.TemporaryDirectory() as place:
        file = place + "/discs.yaml"
        with open(file, "w", encoding="utf-8") as to:
            to.write(DISCS)
        # a hard contact needs the increase of viscosity with pressure; its film depends little on density and shear thinning
        check(file, [], {"viscosity": "!viscosity/isoviscous", "flow": "rheology/newtonian"})
        # a soft contact needs none of these laws
        check(file, SOFT, {"viscosity": "viscosity/isoviscous", "density": "density/incompressible"})
        # friction depends on laws that hardly change the film
        check(file, SHEARED, {"flow": "rheology/ree-eyring", "viscosity": "!viscosity/isoviscous"})
        # low accuracy: a formula is chosen
        check(file, ["accuracy=30 %"], {"film": "!ehl/finite-volume"})


if __name__ == "__main__":
    main()
