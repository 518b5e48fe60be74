# Are two pages the same but for numbers that differ by less than 2 %, or by 2 of the last digit?
#   awk -f compare.awk KEPT NEW
function digit(text,  point, e) {
    e = match(text, /e/) ? substr(text, RSTART + 1) + 0 : 0
    sub(/e.*/, "", text)
    point = index(text, ".")
    return 10 ^ (e - (point ? length(text) - point : 0))
}
function same(a, b,  d) {
    d = a - b
    if (d < 0) d = -d
    return d <= 2.01 * digit(a) || d <= 0.02 * (a < 0 ? -a : a)
}
# cuts a line into numbers and what is between them
function cut(line, number, between,  n) {
    n = 0
    while (match(line, /-?[0-9]+(\.[0-9]+)?(e[-+]?[0-9]+)?/)) {
        between[++n] = substr(line, 1, RSTART - 1); number[n] = substr(line, RSTART, RLENGTH)
        line = substr(line, RSTART + RLENGTH)
    }
    between[n + 1] = line
    return n
}
function complain(why) { printf "line %d: %s\n  kept: %s\n  now:  %s\n", FNR, why, kept[FNR], $0; bad = 1 }
NR == FNR { kept[NR] = $0; lines = NR; next }
{
    n = cut(kept[FNR], a, p); m = cut($0, b, q)
    if (n != m) { complain("other words"); next }
    for (i = 1; i <= n + 1; i++) if (p[i] != q[i]) { complain("other words"); next }
    # what rounding leaves of zero is not compared
    for (i = 1; i <= n; i++) if (!(a[i] ^ 2 < 1e-20 && b[i] ^ 2 < 1e-20) && !same(a[i], b[i])) { complain(a[i] " or " b[i]); next }
}
END {
    if (FNR != lines) { print "kept " lines " lines, now " FNR; bad = 1 }
    exit bad
}
