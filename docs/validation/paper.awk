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
    load(in_ "/atlas", "motion-point", "a")
    load(in_ "/flanks", "flanks", "r")
    scalars(in_ "/flanks", "flanks", "r")
    sap = s["g.roll_sap"] * deg
    lpstc = s["g.roll_lpstc"] * deg
    pitch = s["g.roll_pitch"] * deg
    hpstc = s["g.roll_hpstc"] * deg
    tip = s["g.roll_tip"] * deg
    cycle = 360 / 50
    face = s["g.face_width"]
    line_force = s["duty.line_force"]
    positions_of_I()
    if (fields) read_fields()
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
    positions_of_III()
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
function read_fields() {
    snapshots("7", "I-fields", "film_static", "I")
    snapshots("8", "I-fields", "film", "I")
    snapshots("9", "III-fields", "film", "III")
    if (rough) {
        snapshots("11", "rough", "film", "I")
        load(in_ "/rough", "film", "rough")
    }
}
