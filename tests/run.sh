#!/bin/sh
# Installs what is missing, builds, and runs every test; tests/summary.py then says what was skipped
# and why, which campaigns are not part of it, and the sums.
#   sh tests/run.sh [BUILD_DIRECTORY [OPTION OF meson setup]...]
set -eu
cd "$(dirname "$0")/.."

build=${1:-build}
[ $# -eq 0 ] || shift

fail() {
    printf '\n%s\n0 passed, 1 failed\n' "$1"
    exit 1
}

sh configs/need.sh test || fail "a package could not be installed"
# packages that came since the last time are found
[ ! -f "$build/build.ninja" ] || meson configure "$build" --clearcache || fail "$build is no build directory"
if [ -f "$build/build.ninja" ]; then
    meson setup "$build" --reconfigure "$@" || fail "the build could not be configured"
else
    meson setup "$build" "$@" || fail "the build could not be configured"
fi
ninja -C "$build" all meson-test-prereq || fail "the build is broken"

rm -f "$build"/meson-logs/testlog-cpu*
meson test -C "$build" --no-rebuild --timeout-multiplier 10 --print-errorlogs \
    --wrapper "$PWD/tests/cpu.sh" || true
exec python3 tests/summary.py "$build"
