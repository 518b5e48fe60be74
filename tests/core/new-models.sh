#!/bin/sh
# What `flankfilm new` writes compiles without a warning, passes `verify`, runs in its pipeline and is
# of at most 60 lines; its key words are in the schema.
# new-models.sh FLANKFILM PLUGIN_DIRECTORY SOURCE_ROOT
set -eu
flankfilm=$(realpath "$1") plugins=$(realpath "$2") source=$(realpath "$3")
lab=$(mktemp -d)
trap 'rm -rf "$lab"' EXIT
cd "$lab"

for kind in viscosity density rheology surface; do
    "$flankfilm" new "$kind/own-$kind" --plugin-path "$plugins"
    cd "own-$kind"
    [ "$(wc -l <"own-$kind.c")" -le 60 ]
    [ "$(wc -l <meson.build)" -le 5 ]
    mkdir -p "build/$kind"
    ${CC:-cc} -std=c11 -O2 -Wall -Wextra -Werror -fPIC -shared -fvisibility=hidden \
        -I "$source/include" "own-$kind.c" -o "build/$kind/own-$kind.so" -lm
    "$flankfilm" verify "build/$kind/own-$kind.so" >said || { cat said; exit 1; }
    FLANKFILM_PLUGIN_PATH=$plugins "$flankfilm" run "own-$kind.yaml" --plugin-path build >/dev/null
    FLANKFILM_PLUGIN_PATH=build "$flankfilm" schema schema.json
    grep -q "\"$kind/own-$kind\": {" schema.json
    cd ..
done

# nothing that is there is written over, and no file is made for a name that is none
! "$flankfilm" new viscosity/own-viscosity --plugin-path "$plugins" 2>/dev/null
! "$flankfilm" new Viscosity 2>/dev/null
[ ! -e Viscosity ]
