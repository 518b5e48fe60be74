#!/bin/sh
# Draws figures from their descriptions, by the script of the report's pages in one browser without a window, and gives
# them a second set of colours for pages that are dark.
#   sh docs/draw.sh PROGRAM (DESCRIPTION.json OUT.svg)...
set -eu
program=$(realpath "$1")
shift
command -v chromium >/dev/null || {
    echo "$2 and those after it stay as they are: there is no Chromium" >&2
    exit 0
}
# the colours of figure.css as page.css has them in the dark, and greys and blues of the drawings' own
dark='<style>@media (prefers-color-scheme:dark){
svg>rect[fill="#fff"]{fill:#1f2226}
[fill="#1a1a1a"],text[font-weight="bold"],text[fill="#000"][font-weight]{fill:#e8eaed}[fill="#5f6368"]{fill:#a2a8b0}[stroke="#5f6368"]{stroke:#a2a8b0}[stroke="#d9dce0"]{stroke:#353a41}
[stroke="#444444"]{stroke:#c4c8ce}[stroke="#56b4e9"]{stroke:#c3e3f8}[stroke="#666666"]{stroke:#a2a8b0}
[fill="#0072b2"]{fill:#5ab4e8}[fill="#d55e00"]{fill:#ff9154}[fill="#009e73"]{fill:#2fcb9c}[fill="#cc79a7"]{fill:#e5a3c9}
[stroke="#0072b2"]{stroke:#5ab4e8}[stroke="#d55e00"]{stroke:#ff9154}[stroke="#009e73"]{stroke:#2fcb9c}[stroke="#cc79a7"]{stroke:#e5a3c9}
}</style>'
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
awk -v count="$count" -v lab="$lab" -v dark="$dark" '{ text = text $0 "\n" }
    END {
        for (i = 1; i <= count; i++) {
            if (!match(text, /<pre class="saved">/)) exit 1
            text = substr(text, RSTART + RLENGTH)
            end = index(text, "</pre>")
            figure = substr(text, 1, end - 1)
            gsub(/&lt;/, "<", figure); gsub(/&gt;/, ">", figure); gsub(/&nbsp;/, " ", figure); gsub(/&amp;/, "\\&", figure)
            sub(/\n/, "\n" dark "\n", figure)
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
