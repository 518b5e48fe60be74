# What figures and page of paper.sh share: the runs, and the ten positions of the flank.

BEGIN {
    load(in_, "laws", "law")
    split("I II III", points, " ")
    for (q = 1; q <= 3; q++) {
        P = points[q]
        load(in_ "/" P, "static", P "s")
        load(in_ "/" P, "tooth", P "d")
        load(in_ "/" P, "film_static", P "fs")
        load(in_ "/" P, "film", P "fd")
        load(in_ "/" P, "motion", P "m")
        load(in_ "/" P, "motion-harmonic", P "h")
        scalars(in_ "/" P, "motion", P "m")
        scalars(in_ "/" P "-slope", "motion", P "slope")
        load(in_ "/" P, "gears", P "w")
        load(in_ "/" P, "motion-station", P "w")
        for (i = 1; i <= count[P "w"]; i++) v[P "w.dynamic", i] = v[P "w.tooth_force", i]
        load(in_ "/" P, "mesh-station", P "w")
    }
    load(in_ "/I", "mesh", "k")
    load(in_ "/I", "mesh-harmonic", "kh")
    scalars(in_ "/I", "mesh", "k")
    scalars(in_ "/I", "gears", "g")
    scalars(in_ "/I", "duty", "duty")
    load(in_ "/fine", "film", "fine")
    load(in_ "/coarse", "film_static", "coarse")
    load(in_ "/atlas", "motion-point", "a")
    load(in_ "/atlas-slope", "motion-point", "aslope")
    scalars(in_ "/I-slope", "mesh", "kslope")
    size_count = split(parts_of_k, size, " ")
    for (i = 1; i <= size_count; i++) load(in_ "/k-" size[i], "motion-point", "a" size[i])
    load(in_ "/flanks", "flanks", "r")
    scalars(in_ "/flanks", "flanks", "r")
    soon = 0.05 # deg, after LPSTC
    both_rq = sqrt(s["r.rq_1"]^2 + s["r.rq_2"]^2)
    sap = s["g.roll_sap"] * deg
    lpstc = s["g.roll_lpstc"] * deg
    pitch = s["g.roll_pitch"] * deg
    hpstc = s["g.roll_hpstc"] * deg
    tip = s["g.roll_tip"] * deg
    cycle = 360 / 50
    face = s["g.face_width"]
    line_force = s["duty.line_force"]
    positions_of_I()
    if (stage == "all") read_fields()
}

function keep(key, letter, angle) { where[key, letter] = angle }

# Fig. 7, 8 and 11: A SAP, B and D the first low and high of W_d, E the next low, G after LPSTC, H
# pitch point, I after HPSTC; the rest lies between
function positions_of_I(  b, d) {
    b = peak("Id", "load_per_width", sap, sap + 3, -1)
    d = peak("Id", "load_per_width", b, b + 2.5, 1)
    keep("I", "A", sap); keep("I", "B", b); keep("I", "C", (b + d) / 2); keep("I", "D", d)
    keep("I", "E", peak("Id", "load_per_width", d, lpstc - 0.3, -1))
    keep("I", "F", (where["I", "E"] + lpstc) / 2)
    keep("I", "G", lpstc + 0.25); keep("I", "H", pitch); keep("I", "I", hpstc + 0.5)
    keep("I", "J", (hpstc + tip) / 2)
    positions_of_II()
    positions_of_III()
}
# as those of I: B, D and F are turning points of W_d, J the last low
function positions_of_II(  b, d, f) {
    b = peak("IId", "load_per_width", sap, sap + 2, 1)
    d = peak("IId", "load_per_width", b, lpstc - 0.3, -1)
    f = peak("IId", "load_per_width", d, lpstc - 0.3, 1)
    keep("II", "A", sap); keep("II", "B", b); keep("II", "C", (b + d) / 2); keep("II", "D", d)
    keep("II", "E", (d + f) / 2); keep("II", "F", f)
    keep("II", "G", lpstc + 0.25); keep("II", "H", pitch); keep("II", "I", hpstc + 0.5)
    keep("II", "J", peak("IId", "load_per_width", hpstc + 1, tip, -1))
}
# Fig. 9: A to E the first loaded part, F to J the next; loaded: above 5 % of the largest force
function positions_of_III(  i, x, w, least, on, part, first, last) {
    least = 0.05 * highest("IIId", "load_per_width")
    for (i = 1; i <= count["IIId"]; i++) {
        w = v["IIId.load_per_width", i]; x = v["IIId.roll_angle", i] * deg
        if (w > least && !on) { on = 1; first[++part] = x }
        if (w <= least && on) { on = 0; last[part] = x }
    }
    if (on) last[part] = tip
    parts = part
    for (i = 0; i < 5; i++) {
        keep("III", substr("ABCDE", i + 1, 1), first[1] + (last[1] - first[1]) * i / 4)
        keep("III", substr("FGHIJ", i + 1, 1), first[2] + (last[2] - first[2]) * i / 4)
    }
}
function aim(key,  i, letter) {
    for (i = 1; i <= 10; i++) { letter = substr("ABCDEFGHIJ", i, 1); at[letter] = where[key, letter] }
}
# one snapshot figure: KEY.p, KEY.h and the abscissa KEY.x
function snapshots(key, dir, stage, points) {
    aim(points)
    load(in_ "/" dir, stage "-x", key "x")
    field(in_ "/" dir, stage "-film", key "h")
    field(in_ "/" dir, stage "-pressure", key "p")
}
# smooth flanks: snap["I", "d"] is the key under W_d at I, by the paper's figure where it has one;
# rough ones: "r" point load seed
function read_fields(  q, P, i, load_, stage) {
    seed_count = split(seeds, surface, " ")
    if (!quick) load(in_ "/finer", "film", "finer")
    snap["I", "s"] = "7"; snap["I", "d"] = "8"; snap["III", "d"] = "9"
    snap["II", "s"] = "IIfields"; snap["II", "d"] = "IIfieldd"; snap["III", "s"] = "IIIfields"
    aim("I")
    at["G"] = lpstc + soon # p alone, of loads that jump at once
    load(in_ "/step", "film_static-x", "7stepx"); field(in_ "/step", "film_static-pressure", "7stepp")
    load(in_ "/step", "film-x", "8stepx"); field(in_ "/step", "film-pressure", "8stepp")
    for (q = 1; q <= 3; q++) {
        P = points[q]
        snapshots(snap[P, "s"], P "-fields", "film_static", P)
        snapshots(snap[P, "d"], P "-fields", "film", P)
        if (quick && q > 1) continue
        for (i = 1; i <= seed_count; i++) {
            read_rough(P, "d", surface[i], "film")
            if (!quick) read_rough(P, "s", surface[i], "film_static")
        }
    }
}
function read_rough(P, load_, seed, stage,  key) {
    key = "r" P load_ seed
    load(in_ "/rough-" P "-" seed, stage, key)
    snapshots(key, "rough-" P "-" seed, stage, P)
}
# names of the figures of ten positions
function name_of(P, load_, rough) {
    if (rough) return P load_ == "Id" ? "fig11" : "rough-" P "-" (load_ == "s" ? "static" : "dynamic")
    return snap[P, load_] ~ /^[0-9]/ ? "fig" snap[P, load_] : "smooth-" P "-" (load_ == "s" ? "static" : "dynamic")
}
