#!/bin/sh
# What `flankfilm new` writes for a kind, or for one that nobody knows, compiles without a warning,
# passes `verify` with nothing untried and runs in its pipeline; its key words are in the schema.
# new-models.sh FLANKFILM PLUGIN_DIRECTORY SOURCE_ROOT
set -eu
flankfilm=$(realpath "$1") plugins=$(realpath "$2") source=$(realpath "$3")
lab=$(mktemp -d)
trap 'rm -rf "$lab"' EXIT
cd "$lab"
export FLANKFILM_PLUGIN_PATH="$plugins"

# to look for leaks takes half of the time of a start: the last kind and all that is refused tell of them
asan=${ASAN_OPTIONS:-}
kinds=$(ls "$plugins" | sed -n 's/\.template\.c$//p')
for kind in $kinds unheard-of; do
    [ "$kind" != unheard-of ] && export ASAN_OPTIONS="$asan:detect_leaks=0" || export ASAN_OPTIONS="$asan"
    "$flankfilm" new "$kind/own-$kind" >said
    cd "own-$kind"
    [ "$(wc -l <meson.build)" -le 5 ]
    if grep '@' "own-$kind.c" "own-$kind.yaml" meson.build README.md; then exit 1; fi
    mkdir -p "build/$kind"
    ${CC:-cc} -std=c11 -O2 -Wall -Wextra -Wpedantic -Werror -fPIC -shared -fvisibility=hidden \
        -I "$source/include" "own-$kind.c" -o "build/$kind/own-$kind.so" -lm
    inputs=$(sed -n "s/.*'--pipeline', files('\(.*\)').*/--pipeline \1/p" meson.build)
    # shellcheck disable=SC2086
    "$flankfilm" verify "build/$kind/own-$kind.so" $inputs >said || { cat said; exit 1; }
    # sanitizers count not
    if grep '^# untried' said | grep -v -e allocator -e 'there is no model conformance/'; then exit 1; fi
    "$flankfilm" run "own-$kind.yaml" --plugin-path build >said || { cat said; exit 1; }
    "$flankfilm" schema schema.json --plugin-path build
    grep -q "\"$kind/own-$kind\": {" schema.json
    cd ..
done

for kind in gear operating stiffness dynamics contact viscosity density rheology ehl surface \
    lubricant discretisation losses rating; do
    [ -f "$plugins/$kind.template.c" ]
done

# nothing that is there is written over, and no file is made for a name that is none
refused() { # ID WORDS
    code=0
    "$flankfilm" new "$1" >said 2>&1 || code=$?
    [ "$code" -ne 0 ] && grep -qF -- "$2" said || { echo "new $1: exit code $code" && cat said && exit 1; }
}
refused viscosity/own-viscosity 'the folder own-viscosity cannot be made: File exists'
refused Viscosity 'is not a valid name of a model'
refused viscosity/auto 'is not a valid name of a model'
[ ! -e Viscosity ]
