#!/bin/sh
# Builds a fuzz target with clang's libFuzzer and sanitizers, and runs it on its corpus.
#   tests/fuzz/fuzz.sh yaml|bind|study|store|units|table|descriptor WORK_DIRECTORY [OPTION OF libFuzzer]...
#   tests/fuzz/fuzz.sh units /tmp/fuzz -max_total_time=20
# New inputs gather in WORK_DIRECTORY/TARGET; one that crashes goes to tests/fuzz/found/TARGET, where
# the tests read it from then on.
set -eu
cd "$(dirname "$0")/../.."
target=$1 work=$2
shift 2

mkdir -p "$work/$target" "$work/toys/toy" "tests/fuzz/found/$target"
case $target in
store | study) more='core/engine/*.c core/program/results/*.c core/program/terminal/*.c core/program/study/*/*.c core/program/study/kinds/*/*.c core/program/study/kinds/*/*/*.c core/program/accuracy/*.c core/program/limits/*.c core/program/arrays/*.c core/program/memory/*.c core/program/crash/*.c core/program/run/*.c' libraries='-ljansson -lgsl -lgslcblas' ;;
*) more='' libraries='' ;;
esac
flags="-g -O1 -std=c11 -D_GNU_SOURCE -Iinclude"
watched="-fsanitize=address,undefined -fno-sanitize-recover=undefined"
places='-DRESULTS_VERSION="0" -DFE_PLUGIN_DIR="/nonexistent" -DFE_PLUGIN_FOLDER="plugins" -DFE_UP_FROM_LIBRARY="../"'

# what all targets share is compiled once, by the first of those that are built at a time
build_shared() {
    rm -rf "$work/objects" "$work/engine.a" && mkdir "$work/objects"
    for source in core/engine/value/*.c core/engine/plugin/*.c core/engine/pipeline/*.c; do
        # shellcheck disable=SC2086
        clang $flags $watched -fsanitize=fuzzer-no-link $places -c "$source" -o "$work/objects/$(basename "$source" .c).o"
    done
    for toy in tests/bad/plugins/toy/*.c; do
        # shellcheck disable=SC2086
        clang $flags -DSIDE='"mutual"' -fPIC -shared -fvisibility=hidden "$toy" \
            -o "$work/toys/toy/$(basename "$toy" .c).so"
    done
    ar rcs "$work/engine.a" "$work"/objects/*.o
}
(
    flock 9
    if ! [ -e "$work/engine.a" ] ||
        [ -n "$(find core/engine include tests/bad/plugins/toy -newer "$work/engine.a" -print -quit)" ]; then
        build_shared
    fi
) 9>"$work/lock"
# shellcheck disable=SC2086
clang $flags $watched -fsanitize=fuzzer $places "tests/fuzz/$target.c" $more "$work/engine.a" -o "$work/fuzz-$target" \
    -lyaml $libraries -lm -ldl

set -- "$@" -artifact_prefix="tests/fuzz/found/$target/" "$work/$target" "tests/fuzz/corpus/$target" \
    "tests/fuzz/found/$target"
case $target in
yaml) set -- "$@" tests/bad/yaml configs ;;
bind | study) set -- -dict="tests/fuzz/$target.dict" "$@" ;;
esac
HOME=/nonexistent XDG_DATA_HOME='' FLANKFILM_FUZZ_TOYS="$work/toys" \
    exec "$work/fuzz-$target" -max_len=4096 -timeout=10 -rss_limit_mb=2048 -print_final_stats=1 "$@"
