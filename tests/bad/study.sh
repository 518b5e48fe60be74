#!/bin/sh
# A case of a study whose model complains about a table says where in the table.
#   study.sh FLANKFILM BAD_PLUGINS
set -eu
flankfilm=$(realpath "$1")
FLANKFILM_PLUGIN_PATH=$(realpath "$2")
export FLANKFILM_PLUGIN_PATH
lab=$(mktemp -d)
trap 'rm -rf "$lab"' EXIT
cd "$lab"
printf 'level [mm]\n1\n2\n' >good.csv
printf 'level [mm]\n1\n-2\n' >below.csv
cat >tables.yaml <<YAML
format: 2
pipeline: {reader: {use: toy/reader, file: good.csv}}
outputs: [reader.sum]
study:
  sweep:
    reader.file: [good.csv, below.csv]
    reader.how: [used, cell]
YAML
code=0
"$flankfilm" run tables.yaml -o tables >said 2>&1 || code=$?
cat said
[ "$code" -eq 4 ]
grep -qF '3 failed' said
grep -q 'below.csv:3:1: reader.file .*level' tables/table.csv
grep -q 'good.csv:3:1: reader.file (toy/reader): the level of row 2 is wrong' tables/table.csv
