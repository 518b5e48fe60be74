#!/bin/sh
# Ends a page of measurements with the commit at which it was made and the sources that its numbers rest on, which
# tests/stale.py reads.
#   sh docs/made.sh PAGE.md PATH...
set -eu
page=$1
shift
commit=$(git -C "$(dirname "$0")" rev-parse --short=8 HEAD)
text=$(sed '/^<!-- made at .* -->$/d' "$page")
printf '%s\n\n<!-- made at %s from %s -->\n' "$text" "$commit" "$*" >"$page"
