#!/bin/sh
# Installs what is missing, builds flankfilm and runs the gear pair of Li & Kahraman 2011 under
# quasi-static and dynamic load.
set -eu
cd "$(dirname "$0")/.."

sh configs/need.sh
[ -f build/build.ninja ] || meson setup build
ninja -C build
build/flankfilm run configs/li-kahraman-2011.yaml -o results/li-kahraman-2011 "$@"
