#!/bin/sh
# A shipped model passes `flankfilm verify`, with nothing untried; verify-models.txt names the run that
# it takes its parameters and inputs from. Without a model: so do those modules that the list lacks,
# which are no stages, studies or adapters.
# verify-models.sh FLANKFILM PLUGIN_DIRECTORY SOURCE_ROOT [MODEL]
set -eu
flankfilm=$1 plugins=$2 source=$3
# a busy machine is slow, and two threads of BLAS wait for each other
export FLANKFILM_VERIFY_LIMIT=300 OPENBLAS_NUM_THREADS=1

verify() { # MODEL ARGUMENTS
    file=$plugins/$1.so
    shift
    [ -e "$file" ] || { echo "needs $file" && exit 77; }
    said=$("$flankfilm" verify "$file" "$@") || { echo "$said" && exit 1; }
    if echo "$said" | grep '^# untried' | grep -v -e 'allocator' -e 'there is no model conformance/'; then
        exit 1
    fi
}

if [ $# -eq 3 ]; then
    seen=0
    for file in "$plugins"/*/*.so; do
        id=${file#"$plugins/"}
        id=${id%.so}
        if ! grep -q "^$id " "$source/tests/core/program/verify-models.txt"; then
            verify "$id"
            seen=$((seen + 1))
        fi
    done
    echo "$seen modules"
    [ $seen -gt 0 ]
    exit
fi

set -f
# shellcheck disable=SC2046
set -- $(grep "^$4 " "$source/tests/core/program/verify-models.txt")
id=$1 config=$2
if [ "$config" = - ]; then
    verify "$id"
else
    stage=$3
    shift 3
    for word; do
        shift
        set -- "$@" --set "$(printf %s "$word" | tr + ' ')"
    done
    verify "$id" --pipeline "$source/configs/$config.yaml" --set "$stage.use=$id" "$@"
fi
