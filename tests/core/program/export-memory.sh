#!/bin/sh
# Without memory the program leaves no writer that has files open: it is told, closes them, and
# then the program ends.   export-memory.sh FLANKFILM HOARDER TOYS...
set -eu
flankfilm=$(realpath "$1") hoarder=$(realpath "$2")
shift 2
lab=$(mktemp -d)
trap 'rm -rf "$lab"' EXIT
mkdir -p "$lab/plugins/toy" "$lab/plugins/writer"
for toy; do
    cp "$toy" "$lab/plugins/toy/${toy##*/cli-toy-}"
done
cp "$hoarder" "$lab/plugins/writer"
cd "$lab"
export FLANKFILM_PLUGIN_PATH="$lab/plugins"
cat >case.yaml <<YAML
format: 2
pipeline:
  wave: {use: toy/wave, amplitude: 2 mm}
outputs: [wave.total]
YAML
"$flankfilm" run case.yaml -o case >said 2>&1 || { cat said; exit 1; }
got=0
"$flankfilm" export case --to hoarder -o out >said 2>&1 || got=$?
cat said
[ "$got" -eq 1 ] && grep -q '^flankfilm: out of memory$' said && [ -e closed ]
