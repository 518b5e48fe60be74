# SPDX-License-Identifier: GPL-3.0-or-later
"""What an editor can know from the schema of the program: the examples have no findings, a wrong line
has one there, and the parameters of the chosen model are offered with what they mean. That
yaml-language-server makes that of it is a campaign: tests/editor.sh.

    editor.py FLANKFILM PLUGIN_DIRECTORY SOURCE_ROOT
"""
import json
import os
import pathlib
import subprocess
import sys

try:
    import jsonschema
    import yaml
except ImportError as error:
    print("needs the Python module", error.name)
    sys.exit(77)

program, plugins, source = sys.argv[1:]
os.environ["FLANKFILM_PLUGIN_PATH"] = plugins
SCHEMA = json.loads(subprocess.run([os.path.abspath(program), "schema"], capture_output=True, check=True).stdout)
failed = 0


class Loader(yaml.SafeLoader):
    """YAML 1.2, in which "on" is a word and 1e9 a number."""


Loader.yaml_implicit_resolvers = {}
for tag, pattern, first in (("bool", "^(true|false)$", "tf"), ("null", "^(null|~|)$", ["n", "~", ""]),
                            ("int", r"^[-+]?\d+$", "-+0123456789"),
                            ("float", r"^[-+]?(\.\d+|\d+(\.\d*)?)([eE][-+]?\d+)?$", "-+.0123456789")):
    Loader.add_implicit_resolver("tag:yaml.org,2002:" + tag, yaml.resolver.re.compile(pattern), list(first))


def check(name, good, seen=None):
    global failed
    failed += not good
    print("ok" if good else "not ok", "-", name, "" if good else seen)


def line(text, error):
    """Where an editor underlines: the value that the error is about, or its key that should not be there."""
    node = yaml.compose(text, Loader)
    path = list(error.absolute_path)
    if error.validator == "additionalProperties":
        path.append(next(iter(set(error.instance) - set(error.schema["properties"])), None))
    for part in path:
        if isinstance(node, yaml.SequenceNode):
            node = node.value[part]
            continue
        key, value = next(pair for pair in node.value if pair[0].value == part)
        node = key if part is path[-1] and error.validator == "additionalProperties" else value
    return node.start_mark.line


def findings(text):
    validator = jsonschema.Draft7Validator(SCHEMA)
    return sorted((line(text, error), error.message) for error in validator.iter_errors(yaml.load(text, Loader)))


def parts(schema, value):
    """The schemas that speak of a value."""
    if "$ref" in schema:
        yield from parts(SCHEMA["definitions"][schema["$ref"].split("/")[-1]], value)
        return
    yield schema
    for part in schema.get("allOf", []):
        yield from parts(part, value)
    if "if" in schema:
        chosen = jsonschema.Draft7Validator({**schema["if"], "definitions": SCHEMA["definitions"]}).is_valid(value)
        yield from parts(schema.get("then" if chosen else "else", {}), value)


def offered(value, *path):
    """What can be said at a place below a stage: keys, with what is known of each."""
    schemas = list(parts({"$ref": "#/definitions/stage"}, value))
    for key in path:
        value = value.get(key, {})
        schemas = [part for schema in schemas if isinstance(schema.get("properties", {}).get(key), dict)
                   for part in parts(schema["properties"][key], value)]
    keys = {}
    for schema in schemas:
        for key, known in schema.get("properties", {}).items():
            if isinstance(known, dict) or key not in keys:
                keys[key] = known
    return keys, [word for schema in schemas for word in schema.get("enum", [])]


def examples():
    for path in sorted(pathlib.Path(source, "configs").rglob("*.yaml")):
        seen = findings(path.read_text(encoding="utf-8"))
        check(f"{path.relative_to(source)} has no findings", not seen, seen)


def wrong_lines():
    pipeline = "format: 2\npipeline:\n"
    law = "  viscosity: {use: viscosity/barus, eta0: 5 mPa s, alpha: 11 1/GPa}\n"
    for name, text, lines, word in (
        ("a right file", law + "outputs: [viscosity.*]\n", [], ""),
        ("a wrong key", law + "  rho:\n    use: density/tait\n    rho0: 918 kg/m3\n    K_0: 1 GPa\n", [6], "K_0"),
        ("a number without its unit", "  oil:\n    use: viscosity/barus\n    eta0: 5\n    alpha: 11 1/GPa\n", [4], "5"),
        ("a model that is none", "  viscosity: {use: viscosity/brus}\n", [2], "brus"),
        ("a word that is no choice, and a key of the user's own",
         "  mesh: {use: stiffness/iso-6336, shape: round}\nx-own: {any: thing}\n", [2], "round"),
    ):
        seen = findings(pipeline + text)
        check(f"{name}: found on its line", [at for at, _ in seen] == lines
              and all(word in message for _, message in seen), seen)
    seen = [at for at, _ in findings("format: 1\npipelin:\n")]
    check("the top of a file is looked at", seen == [0, 1], seen)


def completion():
    oil, _ = offered({"use": "viscosity/barus"})
    check("the parameters of the chosen model", {"eta0", "alpha", "with"} <= oil.keys() and not {"z", "cells"} & oil.keys(), oil)
    film, _ = offered({"use": "ehl/finite-volume"})
    check("and its wires", {"cells", "contact", "viscosity"} <= film.keys() and "alpha" not in film, film)
    _, models = offered({}, "use")
    check("the models", {"viscosity/barus", "ehl/finite-volume"} <= set(models), models)
    _, words = offered({"use": "stiffness/iso-6336"}, "shape")
    check("choices", set(words) == {"rectangular", "trapezoidal"}, words)
    other, _ = offered({"use": "viscosity/roelands", "with": {"viscosity/barus": {}}}, "with", "viscosity/barus")
    check('sets under "with"', "alpha" in other and "z" not in other, other)
    said = oil["alpha"]["description"]
    check("what a parameter is, and its unit", "pressure-viscosity coefficient" in said and "1/GPa" in said, said)
    check('what "use" is', "the model" in oil["use"]["description"], oil["use"])


jsonschema.Draft7Validator.check_schema(SCHEMA)
examples()
wrong_lines()
completion()
print(f"{failed} failed" if failed else "all passed")
sys.exit(failed > 0)
