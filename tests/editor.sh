#!/bin/sh
# Editors: drives yaml-language-server, fresh from npm, on the schema of the program.
#   editor.sh FLANKFILM PLUGIN_DIRECTORY SOURCE_ROOT
set -eu
flankfilm=$(realpath "$1") source=$(realpath "$3")
export FLANKFILM_PLUGIN_PATH="$2"
lab=$(mktemp -d)
trap 'rm -rf "$lab"' EXIT

untried() { # 77: meson counts the test as neither passed nor failed
    echo "not tried: $1"
    exit 77
}
command -v node >/dev/null && command -v npm >/dev/null || {
    echo "node and npm are missing: sh configs/need.sh test"
    exit 1
}
if ! npm install --prefix "$lab" --prefer-offline --no-audit --no-fund --no-progress --fetch-retries=1 \
    yaml-language-server@1.15.0 >"$lab/npm" 2>&1; then
    cat "$lab/npm"
    ! grep -Eq 'ENOTFOUND|EAI_AGAIN|ETIMEDOUT|ECONNREFUSED|ENETUNREACH|EHOSTUNREACH' "$lab/npm" ||
        untried "the npm registry cannot be reached from here"
    exit 1
fi
"$flankfilm" schema "$lab/flankfilm.schema.json"
node "$source/tests/editor.js" "$lab/node_modules/yaml-language-server/bin/yaml-language-server" \
    "$lab/flankfilm.schema.json"
