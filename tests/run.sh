#!/bin/sh
# Installs what is missing, builds, and runs every test.
#   sh tests/run.sh [BUILD_DIRECTORY [OPTION OF meson setup]...]
set -eu
cd "$(dirname "$0")/.."

sh configs/need.sh test
build=${1:-build}
[ $# -eq 0 ] || shift
[ -f "$build/build.ninja" ] || meson setup "$build" "$@"
ninja -C "$build"

log=$build/test-output.txt
meson test -C "$build" --no-rebuild --timeout-multiplier 4 --print-errorlogs >"$log" 2>&1 || true
cat "$log"

# One line per suite, then the sum; a run without a test counts as a failure.
awk '
    /^Summary of Failures/ { exit }
    $1 ~ /^[0-9]+\/[0-9]+$/ {
        suite = $2
        sub(/^.*:/, "", suite)
        good = bad = 0
        for (i = 3; i <= NF; i++) {
            if ($i == "OK") good = 1
            if ($i ~ /^(FAIL|TIMEOUT|ERROR|INTERRUPT|UNEXPECTEDPASS)$/) bad = 1
        }
        if (!good && !bad) next
        if (!(suite in passed) && !(suite in failed)) order[++suites] = suite
        passed[suite] += good && !bad
        failed[suite] += bad
    }
    END {
        print ""
        for (i = 1; i <= suites; i++) {
            printf "%-12s %3d passed, %d failed\n", order[i], passed[order[i]], failed[order[i]]
            p += passed[order[i]]
            f += failed[order[i]]
        }
        if (p + f == 0) f = 1
        printf "%d passed, %d failed\n", p, f
        exit f > 0
    }' "$log"
