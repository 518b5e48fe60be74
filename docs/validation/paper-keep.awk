# Keeps the rows of a field nearest to the ten positions of a point.
#   awk -v point=I -f paper-keep.awk POSITIONS FIELD
NR == FNR { if ($1 == point) { angle[++n] = $3; best[n] = 1e9 } next }
FNR == 1 { print; next }
{
    x = substr($0, 1, index($0, ",") - 1)
    for (k = 1; k <= n; k++) {
        d = x < angle[k] ? angle[k] - x : x - angle[k]
        if (d < best[k]) { best[k] = d; kept[k] = $0 }
    }
}
END { for (k = 1; k <= n; k++) print kept[k] }
