# Writes the figures of paper.sh in the language of plot.awk.

function out(text) { print text > plot }
function begin(name, size) { plot = in_ "/" name ".plot"; out("size " size) }
function panel(box, x, y, title) {
    out("panel " box); out("x " x); out("y " y)
    if (title != "") out("title " title)
}
# a column over the roll angle, scaled
function curve(style, key, column, scale,  i) {
    out("curve " style)
    for (i = 1; i <= count[key]; i++) out(v[key ".roll_angle", i] * deg " " scale * v[key "." column, i])
}
function marks() { out("mark " lpstc " LPSTC"); out("mark " pitch " pitch"); out("mark " hpstc " HPSTC") }

function figure2(  i, k, style) {
    begin("fig2", "620 400")
    panel("70 20 520 320", "0 1 0.2 pressure p, GPa", "0 4 1 log10(eta/eta0)")
    out("legend 20 24")
    split("doolittle-tait roelands two-slope barus", law, " ")
    split("#0072b2 none 2.2|#009e73 6,3 1.6|#e69f00 2,3 1.6|#999999 8,3,2,3 1.6", style, "|")
    for (k = 1; k <= 4; k++) {
        out("curve " style[k] " y " law[k])
        for (i = 1; i <= count["law"]; i++)
            out(v["law.p", i] / 1e9 " " log(v["law." law[k], i] / v["law." law[k], 1]) / log(10))
    }
}

function figure3(  i, last, stable, n, h) {
    begin("fig3", "900 640")
    panel("70 30 350 220", "0 1 0.2 phase of the mesh cycle", "2 4 0.5 k, 1e8 N/m", "(a)")
    out("curve #0072b2 none 2 y")
    for (i = 1; i <= count["k"]; i++) out(v["k.phase", i] " " v["k.stiffness", i] / 1e8)
    panel("520 30 350 220", "0 8 1 harmonic n of the mesh frequency", "0 0.6 0.2 k_n, 1e8 N/m", "(b)")
    for (n = 1; n <= 7; n++) {
        h = v["kh.stiffness_harmonics", n] / 1e8
        out("curve #0072b2 none 12 y"); out(n " 0"); out(n " " h)
    }
    panel("70 310 800 270", "400 4000 400 mesh frequency f_m, Hz", "0 40 10 rms of s, um", "(c)")
    split("1250 2085 2375", at_f, " ")
    for (i = 1; i <= 3; i++) out("mark " at_f[i] " " points[i])
    split("1 0.5 0.333333", part, " "); split("f_n f_n/2 f_n/3", named, " ")
    for (i = 1; i <= 3; i++) out("mark " 3242 * part[i] " " named[i])
    out("legend 600 24")
    out("curve #0072b2 none 2 y stable"); out("curve #d55e00 4,3 1.3 y unstable")
    for (i = 1; i <= count["a"]; i++) {
        stable = v["a.atlas_stable", i]
        if (int(v["a.atlas_branch", i] / 1000) != 1 || v["a.atlas_rms", i] > 40e-6) { last = ""; out(""); continue }
        if (i == 1 || v["a.atlas_branch", i] != v["a.atlas_branch", i - 1]) last = ""
        if (last == "" || stable != was) {
            out("curve " (stable ? "#0072b2 none 2 y" : "#d55e00 4,3 1.3 y"))
            if (last != "") out(last)
        }
        was = stable
        last = v["a.atlas_frequency", i] " " v["a.atlas_rms", i] * 1e6
        out(last)
    }
}

function figure4() {
    begin("fig4", "900 370")
    panel("70 30 350 270", "14 28 2 roll angle of gear 1, deg", "0 40 10 radius, mm", "(a)")
    out("mark " pitch " pitch"); out("legend 14 222")
    curve("#0072b2 none 2 y r1", "Is", "radius_1", 1e3)
    curve("#d55e00 7,3 2 y r2", "Is", "radius_2", 1e3)
    curve("#009e73 2,3 2 y r_eq", "Is", "equivalent_radius", 1e3)
    panel("520 30 310 270", "14 28 2 roll angle of gear 1, deg", "-4 8 2 velocity, m/s", "(b)")
    out("z -0.75 1.5 0.25 SR")
    out("mark " pitch " pitch"); out("legend 190 198")
    curve("#0072b2 none 2 y u1", "Is", "speed_1", 1)
    curve("#d55e00 7,3 2 y u2", "Is", "speed_2", 1)
    curve("#009e73 2,3 2 y u_r", "Is", "entrainment_speed", 1)
    curve("#444444 9,3,2,3 2 y u_s", "Is", "sliding_speed", 1)
    curve("#cc79a7 4,2 2 z SR (right)", "Is", "slide_roll_ratio", 1)
}

# three points above each other, quasi-static dashed and dynamic solid
function three(name, column, fs, fd, scale, y,  q, P) {
    begin(name, "760 820")
    for (q = 1; q <= 3; q++) {
        P = points[q]
        panel("70 " 40 + 260 * (q - 1) " 660 195", "14 28 2 " (q == 3 ? "roll angle of gear 1, deg" : ""), y[q], \
              "(" substr("abc", q, 1) ") point " P)
        marks(); out("legend 12 18")
        curve("#d55e00 6,3 1.8 y quasi-static, W_s", P fs, column, scale)
        curve("#0072b2 none 1.8 y dynamic, W_d", P fd, column, scale)
    }
}

function snapshot(name, key, points, load_key, high, label, xs, ps, hs,  i, letter, x0, y0, k, title) {
    begin(name, "900 1130")
    panel("70 30 770 120", "14 28 2 roll angle of gear 1, deg", high " " label, "")
    for (i = 1; i <= 10; i++) {
        letter = substr("ABCDEFGHIJ", i, 1)
        out("mark " where[points, letter] " " letter)
    }
    out("legend 690 18")
    out("curve #0072b2 none 1.6 y p"); out("curve #d55e00 5,3 1.4 y h")
    curve("#444444 none 1.6 y", load_key, "load_per_width", face / 1e3)
    for (i = 1; i <= 10; i++) {
        letter = substr("ABCDEFGHIJ", i, 1)
        x0 = i % 2 ? 70 : 510; y0 = 225 + 180 * int((i - 1) / 2)
        title = sprintf("%s  %.2f deg", letter, where[points, letter])
        out("panel " x0 " " y0 " 320 115")
        out("x " xs " " (i > 8 ? "x, um" : "")); out("y " ps " p, GPa"); out("z " hs " h, um")
        out("title " title)
        out("curve #0072b2 none 1.6 y")
        for (k = 1; k <= count[key "x"]; k++) out(v[key "x.x", k] * 1e6 " " f[key "p", letter, k] / 1e9)
        out("curve #d55e00 5,3 1.4 z")
        for (k = 1; k <= count[key "x"]; k++) out(v[key "x.x", k] * 1e6 " " f[key "h", letter, k] * 1e6)
    }
}

function figure10(  i) {
    begin("fig10", "900 420")
    panel("70 30 790 140", "0 4 0.5", "-2 2 1 R1, um", "driving flank")
    out("curve #0072b2 none 1.2 y")
    for (i = 1; i <= count["r"]; i++) out(v["r.position", i] * 1e3 " " v["r.height_1", i] * 1e6)
    panel("70 220 790 140", "0 4 0.5 position in the direction of rolling, mm", "-2 2 1 R2, um", "driven flank")
    out("curve #d55e00 none 1.2 y")
    for (i = 1; i <= count["r"]; i++) out(v["r.position", i] * 1e3 " " v["r.height_2", i] * 1e6)
}

# the same ten positions with smooth and with rough flanks
function pair(P, load_, label,  key, high, xs, drawn) {
    high = P load_ == "IIId" ? "0 8 2" : "0 4 1"
    xs = P == "III" ? "-600 360 240" : "-400 240 160"
    key = snap[P, load_]
    snapshot(name_of(P, load_, 0), key, P, P load_, high, label, xs, P == "III" ? "0 1.2 0.3" : "0 0.8 0.2", \
             P == "III" ? "0 1.6 0.4" : "0 0.8 0.2")
    drawn = "r" P load_ surface[1]
    if (count[drawn] > 0) snapshot(name_of(P, load_, 1), drawn, P, P load_, high, label, xs, "0 4 1", "0 4 1")
}

# least and mean films of rough flanks beside the smooth one, all surfaces, in powers of ten
function films(  q, P, l, L, i, k, key, n, sum) {
    begin("rough-films", "900 900")
    for (q = 1; q <= 3; q++) for (l = 1; l <= 2; l++) {
        P = points[q]; L = substr("sd", l, 1)
        panel((l == 1 ? 70 : 520) " " 40 + 285 * (q - 1) " 360 215", "14 28 2 " (q == 3 ? "roll angle of gear 1, deg" : ""), \
              "-3 3 1 " (l == 1 ? "log10(h/um)" : ""), "point " P ", " (l == 1 ? "W_s" : "W_d"))
        out("mark " lpstc " LPSTC"); out("mark " pitch); out("mark " hpstc " HPSTC"); out("legend 12 18")
        key = "r" P L surface[1]
        out("curve #999999 none 0.8 y h_min, rough, one surface")
        for (k = 1; k <= count[key]; k++) out(v[key ".roll_angle", k] * deg " " log10(v[key ".h_min", k] * 1e6))
        out("curve #d55e00 none 1.6 y mean film, rough, " seed_count " surfaces")
        for (k = 1; k <= count[key]; k++) {
            sum = 0
            for (i = 1; i <= seed_count; i++) sum += v["r" P L surface[i] ".lambda_ratio", k]
            out(v[key ".roll_angle", k] * deg " " log10(sum / seed_count * both_rq * 1e6))
        }
        out("curve #0072b2 none 1.6 y h_min, smooth")
        key = P "f" L
        for (k = 1; k <= count[key]; k++) out(v[key ".roll_angle", k] * deg " " log10(v[key ".h_min", k] * 1e6))
    }
}
function log10(x) { return log(x) / log(10) }

BEGIN {
    if (failed) exit 1
    figure2(); figure3(); figure4()
    split("0 4 1 force, kN|0 4 1 force, kN|0 8 2 force, kN", force, "|")
    three("fig5", "load_per_width", "s", "d", face / 1e3, force)
    split("0.1 0.18 0.02 h_min, um|0.15 0.25 0.02 h_min, um|0 1 0.2 h_min, um", film, "|")
    three("fig6", "h_min", "fs", "fd", 1e6, film)
    figure10()
    for (q = 1; q <= 3; q++) {
        pair(points[q], "s", "W_s, kN")
        pair(points[q], "d", "W_d, kN")
    }
    if (!quick) films()
}
