#!/bin/sh
# Every shipped model passes `flankfilm verify`, with nothing untried; verify-models.txt names the run
# that a model takes its parameters and inputs from.
# verify-models.sh FLANKFILM PLUGIN_DIRECTORY SOURCE_ROOT
set -u
flankfilm=$1 plugins=$2 source=$3
# a busy machine is slow, and two threads of BLAS wait for each other
export FLANKFILM_VERIFY_LIMIT=300 OPENBLAS_NUM_THREADS=1
failed=0 seen=0
for file in "$plugins"/*/*.so; do
    id=${file#"$plugins/"}
    id=${id%.so}
    row=$(grep "^$id " "$source/tests/core/verify-models.txt") || row="$id -"
    set -f
    # shellcheck disable=SC2086
    set -- $row
    config=$2 stage=${3:-}
    [ "$config" = - ] && shift 2 || shift 3
    if [ "$config" = - ]; then
        set --
    else
        for word; do
            shift
            set -- "$@" --set "$(printf %s "$word" | tr + ' ')"
        done
        set -- --pipeline "$source/configs/$config.yaml" --set "$stage.use=$id" "$@"
    fi
    set +f
    if ! said=$("$flankfilm" verify "$file" "$@") ||
        printf '%s' "$said" | grep '^# untried' | grep -qv -e 'allocator' -e 'there is no model conformance/'; then
        printf '%s\n%s\n' "$id" "$said" | grep -v '^ok'
        failed=$((failed + 1))
    fi
    seen=$((seen + 1))
done
echo "$seen models, $failed failed"
[ $failed -eq 0 ] && [ $seen -gt 0 ]
