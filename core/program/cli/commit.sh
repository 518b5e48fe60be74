#!/bin/sh
# Prints the commit of the sources: the one recorded in a source archive, or that of the working copy, with "-dirty" if
# files differ from it. Prints nothing if there is neither. Run by `meson dist`, it writes the commit into the archive.
# commit.sh SOURCE_ROOT
set -eu
kept=core/program/cli/commit
print_commit() {
    if [ -f "$1/$kept" ]; then
        cat "$1/$kept"
    elif [ -e "$1/.git" ]; then
        git -C "$1" describe --always --dirty --abbrev=12 --exclude '*'
    fi
}
if [ -n "${MESON_DIST_ROOT:-}" ]; then
    print_commit "$1" >"$MESON_DIST_ROOT/$kept"
else
    print_commit "$1"
fi
