# A table of the mean of the k(t) of point I and `part` times each of its first three harmonics.
BEGIN {
    load(in_ "/I", "mesh", "k")
    m = 2000
    for (i = 0; i < m; i++) {
        x = (i + 0.5) / m
        y = at_phase(x)
        mean += y / m
        for (n = 1; n <= 3; n++) {
            c[n] += 2 / m * y * cos(2 * pi * n * x)
            d[n] += 2 / m * y * sin(2 * pi * n * x)
        }
    }
    print "phase [1],stiffness [N/m]"
    for (i = 0; i <= 200; i++) {
        x = i / 200
        y = mean
        for (n = 1; n <= 3; n++) y += part * (c[n] * cos(2 * pi * n * x) + d[n] * sin(2 * pi * n * x))
        printf "%.9f,%.9g\n", x, y
    }
}
# by straight lines between the phases
function at_phase(x,  i, a, b) {
    for (i = 1; i < count["k"] - 1 && v["k.phase", i + 1] < x; i++);
    a = v["k.phase", i]; b = v["k.phase", i + 1]
    return v["k.stiffness", i] + (b > a ? (v["k.stiffness", i + 1] - v["k.stiffness", i]) * (x - a) / (b - a) : 0)
}
