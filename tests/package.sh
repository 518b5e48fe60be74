#!/bin/sh
# The Debian packages are whole: installed into an empty tree they run the seed's case, compile and verify a model,
# and serve Python; purged they leave no file.
# package.sh BUILD_DIRECTORY SOURCE_ROOT PREFIX
set -eu
build=$1 source=$2
for tool in dpkg dpkg-deb dpkg-shlibdeps cc pkg-config; do
    command -v $tool >/dev/null || { echo "needs $tool" && exit 77; }
done
lab=$(mktemp -d)
trap 'rm -rf "$lab"' EXIT
tree=$lab/tree

# packed small they would be no other packages
DPKG_DEB_COMPRESSOR_TYPE=none sh "$source/docs/package.sh" "$lab/packages" "$build"
[ "$(find "$lab/packages" -name '*.deb' | wc -l)" = 4 ]
for package in flankfilm libflankfilm0; do
    dpkg-deb -f "$lab/packages/$package"_*.deb Depends | grep -q 'libc6 (>= '
done
mkdir -p "$tree/var/lib/dpkg/info" "$tree/var/lib/dpkg/updates"
: >"$tree/var/lib/dpkg/status"
manage() { # OPTION...: dpkg in the tree, which has no package of Debian's own
    dpkg --root="$tree" --log="$lab/log" --force-not-root --force-bad-path --force-depends --force-script-chrootless "$@" \
        >"$lab/said" 2>&1 || { cat "$lab/said" && exit 1; }
}
manage --install "$lab"/packages/*.deb

# alone COMMAND...: with nothing in the environment that knows another flankfilm.
alone() { env -i PATH="$tree/usr/bin:/usr/bin:/bin" HOME="$lab" "$@"; }
[ "$(alone sh -c 'command -v flankfilm')" = "$tree/usr/bin/flankfilm" ]
seed=$tree/usr/share/flankfilm/configs/li-kahraman-2011.yaml
alone flankfilm run "$seed" --set 'outputs=[film.h_min_lowest]' --json -o "$lab/results" >"$lab/run"
grep -q '"status": *"ok"' "$lab/run"

pc=$(dirname "$(find "$tree" -name flankfilm.pc)")
(cd "$lab" && alone flankfilm new viscosity/mine >/dev/null)
# shellcheck disable=SC2046
(cd "$lab" && alone cc -std=gnu11 -O2 -fPIC -shared -fvisibility=hidden \
    $(alone env PKG_CONFIG_PATH="$pc" pkg-config --cflags flankfilm) "$(find . -name mine.c)" -o mine.so -lm)
mkdir "$lab/viscosity" && mv "$lab/mine.so" "$lab/viscosity/"
alone flankfilm verify "$lab/viscosity/mine.so" >"$lab/said" 2>&1 || { cat "$lab/said" && exit 1; }

module=$tree/usr/lib/python3/dist-packages
alone env PYTHONPATH="$module" /usr/bin/python3 -c '
import sys
import flankfilm
assert flankfilm.__file__.startswith(sys.argv[1]), flankfilm.__file__
try:
    import numpy
except ImportError:
    sys.exit(0)
run = flankfilm.Engine().run(sys.argv[2], {"outputs": ["film.h_min_lowest"]})
print("lowest film", run["film.h_min_lowest"].data)' "$module" "$seed"

manage --purge flankfilm libflankfilm0 libflankfilm-dev python3-flankfilm
left=$(find "$tree" ! -type d ! -path "$tree/var/lib/dpkg/*")
[ -z "$left" ] || { echo "left after the purge: $left" && exit 1; }
[ ! -d "$tree/usr" ] || { find "$tree/usr" && exit 1; }
