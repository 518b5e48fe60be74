#!/bin/sh
# Draws figures from their descriptions, by the script of the report's pages in one browser without a window.
#   sh docs/draw.sh PROGRAM (DESCRIPTION.json OUT.svg)...
set -eu
program=$(realpath "$1")
shift
command -v chromium >/dev/null || {
    echo "$2 and those after it stay as they are: there is no Chromium" >&2
    exit 0
}
lab=$(mktemp -d)
trap 'rm -rf "$lab"' EXIT
# a frame for each; their drawings are gathered when all are there
count=0
while [ $# -gt 0 ]; do
    count=$((count + 1))
    "$program" report "$1" -o "$lab/$count.html" >/dev/null
    echo "<iframe src=\"$count.html#figures\" width=1200 height=900></iframe>" >>"$lab/all.html"
    echo "$2" >>"$lab/places"
    shift 2
done
cat >>"$lab/all.html" <<'HTML'
<script>
onload = function gather() {
  var drawn = Array.from(frames, function (frame) { return frame.document.querySelector('.saved'); });
  if (!drawn.every(Boolean)) setTimeout(gather, 20);
  else drawn.forEach(function (text) { document.body.appendChild(document.importNode(text, true)); });
};
</script>
HTML
chromium --headless --no-sandbox --disable-gpu --disable-dev-shm-usage --user-data-dir="$lab/profile" --virtual-time-budget=20000 \
    --allow-file-access-from-files --window-size=1200,900 --dump-dom "file://$lab/all.html" >"$lab/dom" 2>"$lab/said"
awk -v count="$count" -v lab="$lab" '{ text = text $0 "\n" }
    END {
        for (i = 1; i <= count; i++) {
            if (!match(text, /<pre class="saved">/)) exit 1
            text = substr(text, RSTART + RLENGTH)
            end = index(text, "</pre>")
            figure = substr(text, 1, end - 1)
            gsub(/&lt;/, "<", figure); gsub(/&gt;/, ">", figure); gsub(/&nbsp;/, " ", figure); gsub(/&amp;/, "\\&", figure)
            printf "%s", figure > (lab "/" i ".svg")
            text = substr(text, end)
        }
    }' "$lab/dom" || {
    cat "$lab/said" >&2
    exit 1
}
count=0
while read -r place; do
    count=$((count + 1))
    mv "$lab/$count.svg" "$place"
done <"$lab/places"
