# Describes a figure, as docs/draw.sh draws it, from lines of text; all numbers of a panel are in the units of its axes.
#   size W H                         of the figure
#   panel LEFT TOP WIDTH HEIGHT      what follows belongs to it: the drawing between its axes
#   x|y|z LOW HIGH STEP LABEL        axes; z: a second one, on the right
#   title TEXT
#   mark X TEXT                      a dotted line at X, named on top
#   curve COLOUR DASHES WIDTH AXIS NAME   then its points, one a line; an empty line lifts the pen
# DASHES: none, or as in SVG with commas. AXIS: y or z. NAME may be left out.

function quote(text) { gsub(/\\/, "\\\\", text); gsub(/"/, "\\\"", text); return "\"" text "\"" }
function rest(n,  i, text) { for (i = n; i <= NF; i++) text = text (i > n ? " " : "") $i; return quote(text) }
# keeps of points i..j those that a straight line misses by more than 0.2 (Douglas & Peucker 1973)
function thin(i, j,  k, d, far, worst, len, dx, dy) {
    dx = px[j] - px[i]; dy = py[j] - py[i]; len = sqrt(dx * dx + dy * dy) + 1e-9
    worst = 0.2
    for (k = i + 1; k < j; k++) {
        d = (dy * (px[k] - px[i]) - dx * (py[k] - py[i])) / len
        if (d < 0) d = -d
        if (d > worst) { worst = d; far = k }
    }
    if (far) { thin(i, far); thin(far, j) } else keep(j)
}
function keep(i) {
    xs = xs (xs == "" ? "" : ",") sprintf("%.6g", x[i])
    ys = ys (ys == "" ? "" : ",") sprintf("%.6g", y[i])
}
function lift() {
    if (n > 0) keep(1)
    if (n > 1) thin(1, n)
    n = 0
}
function end_curve() {
    if (!going) return
    lift()
    curves = curves (curves == "" ? "" : ",\n") "{" head ",\"x\":[" xs "],\"y\":[" ys "]}"
    going = 0
}
function end_panel() {
    end_curve()
    if (place == "") return
    panels = panels (panels == "" ? "" : ",\n") "{\"sort\":\"curves\",\"heading\":" (heading == "" ? "\"\"" : heading) ",\"title\":\"\"," place axes ",\"marks\":[" marks "],\"curves\":[\n" curves "]}"
    place = axes = marks = curves = heading = ""
}
$1 == "size" { next }
$1 == "panel" {
    end_panel()
    wide = $4; tall = $5
    place = sprintf("\"place\":[%g,%g],\"width\":%g,\"height\":%g", $2, $3, $4, $5)
    next
}
$1 == "x" || $1 == "y" || $1 == "z" {
    axes = axes sprintf(",\"%s\":{\"log\":0,\"low\":%g,\"high\":%g,\"step\":%g,\"label\":%s}", $1, $2, $3, $4, rest(5))
    low[$1] = $2; high[$1] = $3
    next
}
$1 == "title" { heading = rest(2); next }
$1 == "legend" { next }
$1 == "mark" { marks = marks (marks == "" ? "" : ",") "[" $2 "," rest(3) "]"; next }
$1 == "curve" {
    end_curve()
    going = 1; xs = ys = ""; n = 0
    dash = $3 == "none" ? "" : $3
    side = $5
    head = sprintf("\"name\":%s,\"colour\":\"%s\",\"dash\":[%s],\"wide\":%s,\"axis\":\"%s\",\"style\":\"line\"", rest(6), $2, dash, $4, $5)
    next
}
NF == 0 { lift(); if (going && xs != "") { xs = xs ",null"; ys = ys ",null" } next }
going {
    if ($1 < low["x"] || $1 > high["x"]) next
    n++
    x[n] = $1; px[n] = wide * ($1 - low["x"]) / (high["x"] - low["x"])
    y[n] = $2; py[n] = tall * ($2 - low[side]) / (high[side] - low[side])
}
END { end_panel(); print "[" panels "]" }
