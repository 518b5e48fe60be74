#!/bin/sh
# A campaign: drives yaml-language-server, fresh from npm, on the schema of the program. It needs node,
# npm and a registry; what the schema says without them is held by tests/editor.py.
#   editor.sh FLANKFILM PLUGIN_DIRECTORY
set -eu
flankfilm=$(realpath "$1") tests=$(realpath "$(dirname "$0")")
FLANKFILM_PLUGIN_PATH=$(realpath "$2")
export FLANKFILM_PLUGIN_PATH
lab=$(mktemp -d)
trap 'rm -rf "$lab"' EXIT

npm install --prefix "$lab" --no-audit --no-fund --no-progress yaml-language-server@1.15.0 >&2
"$flankfilm" schema "$lab/flankfilm.schema.json"
node "$tests/editor.js" "$lab/node_modules/yaml-language-server/bin/yaml-language-server" \
    "$lab/flankfilm.schema.json"
