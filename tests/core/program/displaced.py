#!/usr/bin/python3
"""What ran is written down: a second file with the id of a plugin that is used is said once by run,
check and explain, and result.json and study.json have path and hash of each plugin.
displaced.py FLANKFILM PLUGINS SOURCE_ROOT"""
import json
import os
import shutil
import subprocess
import sys
import tempfile

flankfilm, plugins, source = map(os.path.realpath, sys.argv[1:4])
lab = os.path.realpath(tempfile.mkdtemp())
home = os.path.join(lab, "home/.local/share/flankfilm/plugins/viscosity")
env = {**os.environ, "HOME": os.path.join(lab, "home"), "FLANKFILM_PLUGIN_PATH": plugins}
env.pop("XDG_DATA_HOME", None)
bad = 0

DISCS = """format: 2
pipeline:
  discs: {use: contact/constant, radius: 12.8 mm, entrainment_speed: 4 m/s, slide_roll_ratio: 0.1, load_per_width: 177 N/mm}
  viscosity: {use: viscosity/isoviscous, eta0: 5 mPa s}
  density: {use: density/dowson-higginson, rho0: 918 kg/m3}
  flow: {use: rheology/newtonian}
  film: {use: ehl/film-formula}
  again: {use: ehl/film-formula}
outputs: [film.h_min, again.h_min]
"""


def holds(what, good):
    global bad
    if not good:
        bad += 1
        print("not so:", what)


def flank(*args):
    done = subprocess.run([flankfilm, *args], cwd=lab, env=env, capture_output=True, text=True)
    return done.returncode, done.stdout, done.stderr


def write(name, text):
    with open(os.path.join(lab, name), "w") as out:
        out.write(text)


def said(text, law):
    """How often it is said that the law's first file takes the place of the user's."""
    return text.count("viscosity/%s: the plugin %s/viscosity/%s.so takes the place of %s/%s.so"
                      % (law, plugins, law, home, law))


def hash_of(path):
    """As the engine hashes a file, in other words: FNV-1a over little-endian words of 8 bytes."""
    data = open(path, "rb").read()
    value, size = 0xcbf29ce484222325, len(data)
    data += b"\0" * (-size % 8)
    for at in range(0, len(data), 8):
        value = (value ^ int.from_bytes(data[at:at + 8], "little")) * 0x9e3779b97f4a7c15 % 2**64
        value ^= value >> 32
    return "%016x" % (value ^ size)


def ran(entry):
    return os.path.realpath(entry["path"]) == entry["path"] and entry["build"] == hash_of(entry["path"])


write("discs.yaml", DISCS)
code, out, err = flank("run", "discs.yaml", "-o", "plain")
holds("no second file, no word", code == 0 and "takes the place" not in out + err)
result = json.load(open(os.path.join(lab, "plain/result.json")))
holds("path and hash of every plugin", len(result["stages"]) == 6 and all(map(ran, result["stages"])))
law = next(s for s in result["stages"] if s["stage"] == "viscosity")
holds("the file of the law", law["path"] == os.path.realpath(plugins + "/viscosity/isoviscous.so"))

os.makedirs(home)
for name in ("isoviscous", "barus", "roelands"):
    shutil.copy(os.path.join(plugins, "viscosity", name + ".so"), os.path.join(home, name + ".so"))
for command in (["run", "discs.yaml", "-o", "shadow"], ["check", "discs.yaml"], ["explain", "discs.yaml"]):
    code, out, err = flank(*command)
    holds("%s says it once: %s%s" % (command[0], out, err), code == 0 and said(out + err, "isoviscous") == 1)
    holds("of no model that is not used", said(out + err, "barus") == 0)
    answer = json.loads(flank(*command, "--json")[1])
    holds("so does --json of " + command[0], len(answer["warnings"]) == 1
          and said(answer["warnings"][0]["message"], "isoviscous") == 1)
code, out, err = flank("run", "discs.yaml", "-o", "broken", "--set", "film.cells=1")
holds("with an error, too", code == 2 and said(out + err, "isoviscous") == 1)

write("study.yaml", DISCS.replace("outputs", "study: {sweep: {viscosity.use: [viscosity/isoviscous, viscosity/barus]}}\noutputs")
      .replace("eta0: 5 mPa s", "eta0: 5 mPa s, with: {viscosity/barus: {alpha: 11 1/GPa}}"))
for command in (["run", "study.yaml", "-o", "study"], ["check", "study.yaml"]):
    code, out, err = flank(*command)
    holds("%s of a study, its other models with it: %s%s" % (command[0], out, err),
          code == 0 and said(out + err, "isoviscous") == said(out + err, "barus") == 1)
    holds("of no other one", said(out + err, "roelands") == 0)
    holds("and no case is doubtful for it", "doubtful" not in out)
study = json.load(open(os.path.join(lab, "study/study.json")))
holds("a study has them", study["stages"] and all(map(ran, study["stages"])))
holds("those of other cases, too", set(study["models"]) == {"viscosity/isoviscous", "viscosity/barus"}
      and all(map(ran, study["models"].values())))

# one file under two names is no second one
os.remove(home + "/isoviscous.so")
os.symlink(plugins + "/viscosity/isoviscous.so", home + "/isoviscous.so")
code, out, err = flank("check", "discs.yaml")
holds("a link to the same file", code == 0 and "takes the place" not in out + err)
shutil.rmtree(lab)
sys.exit(bad > 0)
