#!/bin/sh
# Draws figures from their description, by the script of the report's pages in a browser without a window.
#   sh docs/draw.sh PROGRAM DESCRIPTION.json OUT.svg
set -eu
program=$(realpath "$1")
command -v chromium >/dev/null || {
    echo "$3 stays as it is: there is no Chromium" >&2
    exit 0
}
lab=$(mktemp -d)
trap 'rm -rf "$lab"' EXIT
"$program" report "$2" -o "$lab/page.html" >/dev/null
chromium --headless --no-sandbox --disable-gpu --disable-dev-shm-usage --user-data-dir="$lab/profile" --virtual-time-budget=20000 \
    --window-size=1200,900 --dump-dom "file://$lab/page.html#figures" >"$lab/dom" 2>"$lab/said"
awk '{ text = text $0 "\n" }
    END {
        if (!match(text, /<pre class="saved">/)) exit 1
        text = substr(text, RSTART + RLENGTH)
        text = substr(text, 1, index(text, "</pre>") - 1)
        gsub(/&lt;/, "<", text); gsub(/&gt;/, ">", text); gsub(/&nbsp;/, " ", text); gsub(/&amp;/, "\\&", text)
        printf "%s", text
    }' "$lab/dom" >"$lab/figure.svg" || {
    cat "$lab/said" >&2
    exit 1
}
mv "$lab/figure.svg" "$3"
