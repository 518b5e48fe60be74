#!/bin/sh
# The installed tree is whole without the build: moved elsewhere, read-only, for a user who owns nothing
# and has an empty environment. The examples of docs/library.md compile against it in C and C++ and print what
# the program prints, and so does Python; a third party's law is built, verified and run.
# installed.sh BUILD_DIRECTORY SOURCE_ROOT PREFIX
set -eu
build=$1 source=$2 prefix=$3
for tool in cc c++ pkg-config setpriv; do
    command -v $tool >/dev/null || { echo "needs $tool" && exit 77; }
done
lab=$(mktemp -d)
trap 'chmod -R u+w "$lab"; rm -rf "$lab"' EXIT
chmod 755 "$lab"

meson install -C "$build" --no-rebuild --quiet --destdir "$lab/root" >"$lab/said" 2>&1 || {
    cat "$lab/said"
    exit 1
}
mv "$lab/root$prefix" "$lab/moved"
mkdir "$lab/stranger"
cp -r "$source/tests/third-party/yasutomi" "$lab/stranger/"
awk -v to="$lab/stranger" '
    /^```(c|cpp)$/ { open = 1; next }
    /^```$/ { open = 0 }
    open == 1 { match($0, /[a-z]+\.(c|cpp)/); file = to "/" substr($0, RSTART, RLENGTH); open = 2 }
    open { print >file }' "$source/docs/library.md"
chmod -R a-w "$lab/moved"

# nothing in it knows where it was built
if grep -rl "$(realpath "$build")" "$lab/moved"; then
    echo "names the build tree"
    exit 1
fi

# stranger COMMAND...: in a folder of his own, as a user without rights, with nothing in the environment
stranger() {
    if [ "$(id -u)" = 0 ]; then
        chown -R 65534:65534 "$lab/stranger"
        set -- setpriv --reuid=65534 --regid=65534 --clear-groups "$@"
    fi
    (cd "$lab/stranger" && env -i PATH=/usr/bin:/bin "$@")
}
pc=$(dirname "$(find "$lab/moved" -name libflankfilm.pc)")
flags=$(env -i PATH=/usr/bin:/bin PKG_CONFIG_PATH="$pc" pkg-config --cflags --libs libflankfilm)
rpath=-Wl,-rpath,$(env -i PATH=/usr/bin:/bin PKG_CONFIG_PATH="$pc" pkg-config --variable=libdir libflankfilm)
program=$lab/moved/bin/flankfilm
seed=$lab/moved/share/flankfilm/configs/li-kahraman-2011.yaml
discs=$lab/moved/share/flankfilm/configs/line-contact.yaml
if stranger touch "$lab/moved/x" 2>/dev/null; then
    echo "the tree can be written to"
    exit 1
fi

# shellcheck disable=SC2086
stranger cc -std=c11 -Wall -Wextra -Wpedantic -Werror film.c -o film-c $flags -lm "$rpath"
# shellcheck disable=SC2086
stranger c++ -std=c++17 -Wall -Wextra -Wpedantic -Werror film.cpp -o film-cpp $flags "$rpath"
stranger ./film-c "$discs" "$seed" | tee "$lab/from-c"
stranger ./film-cpp "$discs" "$seed" | diff "$lab/from-c" -
[ "$(wc -l <"$lab/from-c")" = 3 ]
if stranger ./film-c /nowhere.yaml; then exit 1; fi

# the lowest film is that of the program
lowest=$(stranger "$program" run "$seed" --set 'outputs=[film.h_min]' --json | tr -d ' \n' |
    grep -o '"data":\[[^]]*\]' | tr -d '"dat:[]' | tr , '\n' |
    awk 'NR == 1 || $1 < least { least = $1 } END { printf "%.6g", least }')
tail -n 1 "$lab/from-c" | grep -qx "film $lowest m" || { echo "the program says $lowest" && exit 1; }

# Python sees the engine's own memory, and the same film
/usr/bin/python3 -c 'import numpy' 2>/dev/null || { echo "needs NumPy" && exit 77; }
stranger env PYTHONPATH="$lab/moved/share/flankfilm/configs/python" FLANKFILM="$program" /usr/bin/python3 -c '
import sys
import numpy as np
import flankfilm
run = flankfilm.Engine().run(sys.argv[1], {"outputs": ["film.pressure", "film.h_min"]})
film, again = (run["film.pressure"].data for _ in range(2))
assert np.shares_memory(film, again) and film.shape == (1001, 513), film.shape
print("film %.6g m" % run["film.h_min"].data.min())' "$seed" >"$lab/from-python"
tail -n 1 "$lab/from-c" | diff - "$lab/from-python"

# a law of others
flags=$(env -i PATH=/usr/bin:/bin PKG_CONFIG_PATH="$pc" pkg-config --cflags flankfilm)
law=$(ls "$lab/stranger/yasutomi/"*.c*)
mkdir "$lab/stranger/viscosity"
# shellcheck disable=SC2086
stranger c++ -O2 -fPIC -shared -fvisibility=hidden $flags "$law" -o viscosity/yasutomi.so
stranger "$program" verify viscosity/yasutomi.so >"$lab/said" 2>&1 || { cat "$lab/said" && exit 1; }
stranger "$program" run yasutomi/yasutomi.yaml --plugin-path . --json >"$lab/said"
grep -q '"status": *"ok"' "$lab/said"
echo "third party: verified and run"
