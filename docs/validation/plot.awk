# Draws an SVG figure from lines of text; all numbers of a panel are in the units of its axes.
#   size W H                         of the figure
#   panel LEFT TOP WIDTH HEIGHT      what follows belongs to it
#   x|y|z LOW HIGH STEP LABEL        axes; z: a second one, on the right
#   title TEXT
#   mark X TEXT                      a dotted line at X, named on top
#   legend LEFT TOP                  where the names of the curves go
#   curve COLOUR DASHES WIDTH AXIS NAME   then its points, one a line; an empty line lifts the pen
# DASHES: none, or as in SVG with commas. AXIS: y or z. NAME may be left out.

function escape(text) { gsub(/&/, "\\&amp;", text); gsub(/</, "\\&lt;", text); return text }
function rest(n,  i, text) { for (i = n; i <= NF; i++) text = text (i > n ? " " : "") $i; return escape(text) }
function px(x) { return left + width * (x - low["x"]) / (high["x"] - low["x"]) }
function py(y, a) { return top + height * (1 - (y - low[a]) / (high[a] - low[a])) }
function ticks(a,  n, i, v, text) {
    n = int((high[a] - low[a]) / step[a] + 1.0001)
    for (i = 0; i < n; i++) {
        v = low[a] + i * step[a]
        text = sprintf("%.6g", v < step[a] * 1e-6 && v > -step[a] * 1e-6 ? 0 : v)
        if (a == "x") {
            printf "<path d=\"M%.1f %.1fv%.1f\" stroke=\"#e2e2e2\"/>", px(v), top, height
            printf "<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"middle\">%s</text>\n", px(v), top + height + 15, text
        } else if (a == "y") {
            printf "<path d=\"M%.1f %.1fh%.1f\" stroke=\"#e2e2e2\"/>", left, py(v, a), width
            printf "<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"end\">%s</text>\n", left - 6, py(v, a) + 4, text
        } else
            printf "<path d=\"M%.1f %.1fh-4\" stroke=\"#666\"/><text x=\"%.1f\" y=\"%.1f\">%s</text>\n", \
                   left + width, py(v, a), left + width + 6, py(v, a) + 4, text
    }
}
# axes are drawn below the curves, once all of them are known
function frame() {
    if (framed) return
    framed = 1
    ticks("x"); ticks("y")
    if ("z" in low) ticks("z")
    printf "<path d=\"M%.1f %.1fh%.1fv%.1fh-%.1fz\" fill=\"none\" stroke=\"#666\"/>\n", left, top, width, height, width
    if (label["x"] != "")
        printf "<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"middle\">%s</text>\n", left + width / 2, top + height + 32, label["x"]
    if (label["y"] != "")
        printf "<text transform=\"translate(%.1f %.1f) rotate(-90)\" text-anchor=\"middle\">%s</text>\n", \
               left - 44, top + height / 2, label["y"]
    if ("z" in low && label["z"] != "")
        printf "<text transform=\"translate(%.1f %.1f) rotate(90)\" text-anchor=\"middle\">%s</text>\n", \
               left + width + 42, top + height / 2, label["z"]
}
# keeps of points i..j those that a straight line misses by more than 0.2 (Douglas & Peucker 1973)
function thin(i, j,  k, d, far, worst, len, dx, dy) {
    dx = X[j] - X[i]; dy = Y[j] - Y[i]; len = sqrt(dx * dx + dy * dy) + 1e-9
    worst = 0.2
    for (k = i + 1; k < j; k++) {
        d = (dy * (X[k] - X[i]) - dx * (Y[k] - Y[i])) / len
        if (d < 0) d = -d
        if (d > worst) { worst = d; far = k }
    }
    if (far) { thin(i, far); thin(far, j) } else line = line sprintf(" %.1f,%.1f", X[j], Y[j])
}
function draw() {
    if (n > 1) {
        line = sprintf("%.1f,%.1f", X[1], Y[1])
        thin(1, n)
        printf "<polyline points=\"%s\" fill=\"none\" stroke=\"%s\" stroke-width=\"%s\"%s stroke-linejoin=\"round\"/>\n", \
               line, colour, wide, dash
    }
    n = 0
}
function clamp(v) { return v < top ? top : v > top + height ? top + height : v }

$1 == "size" {
    printf "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %s %s\" font-family=\"sans-serif\" font-size=\"12\">\n", $2, $3
    printf "<rect width=\"%s\" height=\"%s\" fill=\"white\"/>\n", $2, $3
    next
}
$1 == "panel" {
    draw(); left = $2; top = $3; width = $4; height = $5; framed = 0
    delete low; delete high; delete step; delete label
    next
}
$1 == "x" || $1 == "y" || $1 == "z" { low[$1] = $2; high[$1] = $3; step[$1] = $4; label[$1] = rest(5); next }
$1 == "title" {
    printf "<text x=\"%.1f\" y=\"%.1f\" font-weight=\"bold\">%s</text>\n", left, top - 8, rest(2)
    next
}
$1 == "legend" { draw(); frame(); lx = left + $2; ly = top + $3; next }
$1 == "mark" {
    draw(); frame()
    printf "<path d=\"M%.1f %.1fv%.1f\" stroke=\"#777\" stroke-dasharray=\"1 3\"/>", px($2), top, height
    printf "<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"middle\" fill=\"#444\">%s</text>\n", px($2), top - 4, rest(3)
    next
}
$1 == "curve" {
    draw(); frame(); going = 0
    colour = $2; wide = $4; axis = $5
    dash = $3 == "none" ? "" : " stroke-dasharray=\"" $3 "\""
    if (NF > 5) {
        printf "<path d=\"M%.1f %.1fh26\" stroke=\"%s\" stroke-width=\"%s\"%s/><text x=\"%.1f\" y=\"%.1f\">%s</text>\n", \
               lx, ly - 4, colour, wide, dash, lx + 32, ly, rest(6)
        ly += 16
    }
    next
}
NF == 0 { draw(); going = 0; next }
{
    if ($1 < low["x"] || $1 > high["x"]) next
    # a curve that leaves the panel upwards ends at its edge; a hair outside is the edge
    out = $2 > high[axis] * 1.0001
    if (going && out != was_out) {
        n++; X[n] = px(was_x + ($1 - was_x) * (high[axis] - was_y) / ($2 - was_y)); Y[n] = top
    }
    if (out) draw()
    else { n++; X[n] = px($1); Y[n] = clamp(py($2, axis)) }
    going = 1; was_out = out; was_x = $1; was_y = $2
}
END { draw(); frame(); print "</svg>" }
