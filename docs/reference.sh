#!/bin/sh
# A page for each model, made from its own tables, and their list.
#   reference.sh FLANKFILM DIRECTORY [PLUGIN_DIRECTORY]
set -eu
flankfilm=$1 directory=$2
[ $# -lt 3 ] || export FLANKFILM_PLUGIN_PATH="$3"
mkdir -p "$directory"
"$flankfilm" models --markdown >"$directory/index.md"
for id in $(sed -n 's/^- \[\([^]]*\)\].*/\1/p' "$directory/index.md"); do
    mkdir -p "$directory/${id%/*}"
    "$flankfilm" models "$id" --markdown >"$directory/$id.md"
done
