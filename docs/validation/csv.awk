# Reads the program's results: series of stages and rows of fields.

# columns of DIR/FILE.csv as v["KEY.column", i], i = 1 .. count["KEY"]; units are left off
function load(dir, file, key,  path, line, name, cell, m, i, k) {
    path = dir "/" file ".csv"
    if ((getline line < path) <= 0) { print "no " path > "/dev/stderr"; failed = 1; exit 1 }
    m = split(line, name, ",")
    for (k = 1; k <= m; k++) sub(/ \[.*/, "", name[k])
    i = 0
    while ((getline line < path) > 0) {
        split(line, cell, ","); i++
        for (k = 1; k <= m; k++) v[key "." name[k], i] = cell[k] + 0
    }
    close(path)
    count[key] = i
}
# scalars of a stage: s["KEY.name"]
function scalars(dir, file, key,  path, line, cell) {
    path = dir "/" file "-scalars.csv"
    while ((getline line < path) > 0) if (split(line, cell, ",") > 1) s[key "." cell[1]] = cell[2] + 0
    close(path)
}
# rows of a field nearest to the angles at["A"] .. at["J"], degrees, as f["KEY", letter, i]
function field(dir, file, key,  path, line, i, k, best, d, letter, cell, kept) {
    path = dir "/" file ".csv"
    getline line < path
    for (k = 1; k <= 10; k++) best[k] = 1e9
    while ((getline line < path) > 0) {
        i = substr(line, 1, index(line, ",") - 1) * deg
        for (k = 1; k <= 10; k++) {
            d = i - at[substr("ABCDEFGHIJ", k, 1)]
            if (d < 0) d = -d
            if (d < best[k]) { best[k] = d; kept[k] = line }
        }
    }
    close(path)
    for (k = 1; k <= 10; k++) {
        letter = substr("ABCDEFGHIJ", k, 1)
        width = split(kept[k], cell, ",") - 1
        for (i = 1; i <= width; i++) f[key, letter, i] = cell[i + 1] + 0
    }
}
# value of a column over roll angle, degrees; KEY has a column roll_angle that does not fall
function over(key, column, angle,  i, a, b, x) {
    x = angle / deg
    for (i = 1; i < count[key] && v[key ".roll_angle", i + 1] < x; i++);
    if (i >= count[key]) return v[key "." column, count[key]]
    a = v[key ".roll_angle", i]; b = v[key ".roll_angle", i + 1]
    if (b <= a) return v[key "." column, i]
    return v[key "." column, i] + (v[key "." column, i + 1] - v[key "." column, i]) * (x - a) / (b - a)
}
# where a column is highest (sign 1) or lowest (sign -1) between two roll angles, degrees
function peak(key, column, from, to, sign,  i, x, best, place) {
    best = -1e99
    for (i = 1; i <= count[key]; i++) {
        x = v[key ".roll_angle", i] * deg
        if (x >= from && x <= to && sign * v[key "." column, i] > best) { best = sign * v[key "." column, i]; place = x }
    }
    extreme = sign * best
    return place
}
function lowest(key, column,  i, m) {
    m = v[key "." column, 1]
    for (i = 2; i <= count[key]; i++) if (v[key "." column, i] < m) m = v[key "." column, i]
    return m
}
function highest(key, column,  i, m) {
    m = v[key "." column, 1]
    for (i = 2; i <= count[key]; i++) if (v[key "." column, i] > m) m = v[key "." column, i]
    return m
}
function abs(x) { return x < 0 ? -x : x }
function min(a, b) { return a < b ? a : b }
function max(a, b) { return a > b ? a : b }
BEGIN { pi = atan2(0, -1); deg = 180 / pi }
