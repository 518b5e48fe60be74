# Writes the page of paper.sh: for each statement of the paper what comes out here, when that counts
# as agreement, and the verdict.

# ok: 1 agrees, 0.5 partly, 0 differs, -1 nothing to compare with, -2 true by construction
function row(says, here, when, ok,  word) {
    word = ok < -1 ? "set" : ok < 0 ? "not to be compared" : ok == 1 ? "agrees" : ok > 0 ? "partly" : "differs"
    verdict[word]++
    text = text "| " says " | " here " | " when " | **" word "** |\n"
}
function head(title, figure) {
    text = text "\n## " title "\n\n"
    if (figure != "") text = text "![" title "](paper-fig" figure ".svg)\n\n"
}
function table() { text = text "| the paper says | here | agrees when | |\n|---|---|---|---|\n" }
# a blank line stands before a paragraph, unless a heading has put one there
function words_follow() { return substr(text, length(text) - 1) != "\n\n" }
function say(words) { text = text (words_follow() ? "\n" : "") words "\n" }
function F(format, a, b, c, d, e, f, g, h, i) { return sprintf(format, a, b, c, d, e, f, g, h, i) }

# turning points of a column between two roll angles whose height over the last one exceeds DEAD
function maxima(key, column, from, to, dead,  i, x, y, low, high, up, n) {
    up = -1
    for (i = 1; i <= count[key]; i++) {
        x = v[key ".roll_angle", i] * deg; y = v[key "." column, i]
        if (x < from || x > to) continue
        if (up < 0) { low = high = y; up = 0 }
        if (y > high) high = y
        if (y < low) low = y
        if (up != 1 && y > low + dead) { up = 1; high = y }
        if (up == 1 && y < high - dead) { up = 0; low = y; n++ }
    }
    return n + 0
}
# waves of the mesh force in one mesh cycle, in closed form of its turning points
function waves(key,  i, j, n, y, m, low, high, up, start, c) {
    m = count[key] - 1
    start = 1
    for (i = 1; i <= m; i++) if (v[key ".mesh_force", i] < v[key ".mesh_force", start]) start = i
    low = high = v[key ".mesh_force", start]
    for (j = 1; j <= m + 1; j++) {
        y = v[key ".mesh_force", (start + j - 1) % m + 1]
        if (y > high) high = y
        if (y < low) low = y
        if (!up && y > low + 0.05 * line_force) { up = 1; high = y }
        if (up && y < high - 0.05 * line_force) { up = 0; low = y; n++ }
    }
    return n + 0
}
function dominant(key,  n, best) {
    best = 1
    for (n = 2; n <= 8; n++) if (v[key ".dte_harmonics", n] > v[key ".dte_harmonics", best]) best = n
    return best
}
# rms of the difference of two histories over the rms of the first
function apart(a, b, column,  i, x, d, sum, ref) {
    for (i = 1; i <= count[a]; i++) {
        x = v[a "." column, i]
        d = over(b, column, v[a ".roll_angle", i] * deg) - x
        sum += d * d; ref += x * x
    }
    return sqrt(sum / ref)
}
function correlation(a, ca, b, cb, from, to, behind,  x, p, q, n, sp, sq, spp, sqq, spq) {
    for (x = from; x <= to; x += 0.02) {
        p = over(a, ca, x - behind); q = over(b, cb, x)
        n++; sp += p; sq += q; spp += p * p; sqq += q * q; spq += p * q
    }
    return (n * spq - sp * sq) / sqrt((n * spp - sp * sp) * (n * sqq - sq * sq))
}
# The motion that loses contact from f_n/n down: where the linear motion ends (`begins`), where that
# other motion does (`ends`), and its rms there (`reaches`). False: there is none. Along a branch the
# unstable motions between the two ends are the folds' own.
function softening(key, n,  i, from, best) {
    best = 0
    for (i = 2; i < count[key]; i++) {
        if (!v[key ".atlas_stable", i] && v[key ".atlas_stable", i - 1]) from = i - 1
        if (!from || v[key ".atlas_stable", i] || !v[key ".atlas_stable", i + 1]) continue
        if (int(3242 / v[key ".atlas_frequency", from] + 0.5) == n && v[key ".atlas_frequency", i + 1] < v[key ".atlas_frequency", from] && \
            v[key ".atlas_rms", from] < 10e-6 && v[key ".atlas_rms", i + 1] > v[key ".atlas_rms", from] && v[key ".atlas_frequency", from] > best) {
            best = begins = v[key ".atlas_frequency", from]; ends = v[key ".atlas_frequency", i + 1]; reaches = v[key ".atlas_rms", i + 1]
        }
        from = 0
    }
    return best > 0
}
# stable motions of period 1 at f, without those that hit the back flank as well, above 40 um
function motions_at(key, f,  i, a, b, n) {
    for (i = 2; i <= count[key]; i++) {
        a = v[key ".atlas_frequency", i - 1]; b = v[key ".atlas_frequency", i]
        n += v[key ".atlas_branch", i] == v[key ".atlas_branch", i - 1] && v[key ".atlas_stable", i] && v[key ".atlas_stable", i - 1] && \
            a != b && (a - f) * (b - f) <= 0 && v[key ".atlas_rms", i] < 40e-6
    }
    return n + 0
}
function width_above(key, letter, share,  k, n, top, peak_) {
    for (k = 1; k <= count[key "x"]; k++) peak_ = max(peak_, f[key "p", letter, k])
    for (k = 1; k < count[key "x"]; k++)
        if (f[key "p", letter, k] > share * peak_) n++
    return n * (v[key "x.x", 2] - v[key "x.x", 1])
}
function highest_pressure(key, letter,  k, m) {
    for (k = 1; k <= count[key "x"]; k++) m = max(m, f[key "p", letter, k])
    return m
}
function film_at(key, letter, x,  k) {
    for (k = 1; k < count[key "x"] && v[key "x.x", k] < x; k++);
    return f[key "h", letter, k]
}
function least_film(key, letter,  k, m) {
    m = 1
    for (k = 1; k <= count[key "x"]; k++) m = min(m, f[key "h", letter, k])
    return m
}
# p over p_H at x over a, by straight lines between the nodes
function shape(key, letter, X, a, p,  x, k) {
    x = X * a
    k = int((x - v[key "x.x", 1]) / (v[key "x.x", 2] - v[key "x.x", 1])) + 1
    return (f[key "p", letter, k] + (f[key "p", letter, k + 1] - f[key "p", letter, k]) * \
            (x - v[key "x.x", k]) / (v[key "x.x", k + 1] - v[key "x.x", k])) / p
}
# rms difference of two pressures, each over its own Hertz scales, from FROM a to TO a
function ripple(key, one, two, load_key, from, to,  X, d, n, sum, a1, p1, a2, p2) {
    a1 = over(load_key, "hertz_half_width", at[one]); p1 = over(load_key, "hertz_pressure", at[one])
    a2 = over(load_key, "hertz_half_width", at[two]); p2 = over(load_key, "hertz_pressure", at[two])
    for (X = from; X <= to; X += 0.01) {
        d = shape(key, one, X, a1, p1) - shape(key, two, X, a2, p2)
        sum += d * d; n++
    }
    return sqrt(sum / n)
}
# p of a load that jumps at once, soon after LPSTC, against that at H; rms over p_H, each over its own
# Hertz scales
function after_step(key, load_key, from, to,  X, d, n, sum, a1, p1, a2, p2) {
    a1 = over(load_key, "hertz_half_width", at["G"]); p1 = over(load_key, "hertz_pressure", at["G"])
    a2 = over(load_key, "hertz_half_width", at["H"]); p2 = over(load_key, "hertz_pressure", at["H"])
    for (X = from; X <= to; X += 0.01) {
        d = shape(key "step", "G", X, a1, p1) - shape(key, "H", X, a2, p2)
        sum += d * d; n++
    }
    return sqrt(sum / n)
}
# highest over lowest film within 0.7 a
function unevenness(key, letter, load_key,  a, k, low, high) {
    a = 0.7 * over(load_key, "hertz_half_width", at[letter]); low = 1
    for (k = 1; k <= count[key "x"]; k++) if (abs(v[key "x.x", k]) < a) {
        low = min(low, f[key "h", letter, k]); high = max(high, f[key "h", letter, k])
    }
    return high / low
}
# where the film follows the load: most negative correlation of W_d(roll - lag) and h_min(roll); lag
function lagging(d, fd, from, to,  try, c, best) {
    best = 2
    for (try = 0; try <= 1.5; try += 0.05) {
        c = correlation(d, "load_per_width", fd, "h_min", from + try, to, try)
        if (c < best) { best = c; lag = try }
    }
    return best
}

function figure2(  i, e) {
    head("Fig. 2: viscosity over pressure", 2)
    table()
    for (i = 1; i <= count["law"]; i++) for (e = 2; e <= 10; e += 2)
        if (abs(v["law.p", i] - e * 1e8) < 1e6) ratio[e] = v["law.doolittle-tait", i] / v["law.doolittle-tait", 1]
    row("eq. (11) with V_occ = 0.6132 and K0' = 10.076 agrees with the points measured by Bair et al.", \
        F("eta/eta0 = %.3g, %.3g, %.3g, %.3g at 0.2, 0.4, 0.6, 1 GPa", ratio[2], ratio[4], ratio[6], ratio[10]), \
        "(the points are not known)", -1)
    say("In the available copy of the paper, eta0, B, K0 and the points are not legible. `configs/lubricants/mil-l-23699.yaml` " \
        "says where its values come from. The other laws of the card share eta0 and the film-forming coefficient.")
}
# one row for the motion from f_n/n down
function resonance(n, says,  found) {
    found = softening("a", n)
    row(says, found ? F("the motion that loses contact starts at %.0f Hz and grows down to %.0f Hz, with an rms of %.0f um", begins, ends, 1e6 * reaches) : "no motion loses contact there", \
        F("this motion ends above %.0f Hz, half-way to the next resonance", 3242 / (n + 0.5)), !found ? 0 : ends > 3242 / (n + 0.5) ? 1 : 0)
    two[n] = found ? begins : 0
}
function over_sizes(  i, n, line) {
    text = text "\n| harmonics 1 to 3 of k | at f_n | at f_n/2 | at f_n/3 |\n|---|---|---|---|\n"
    for (i = 1; i <= size_count; i++) {
        line = F("| times %s: %.3f, %.3f, %.3f 1e8 N/m", size[i], size[i] * v["kh.stiffness_harmonics", 1] / 1e8, size[i] * v["kh.stiffness_harmonics", 2] / 1e8, size[i] * v["kh.stiffness_harmonics", 3] / 1e8)
        for (n = 1; n <= 3; n++) line = line (softening("a" size[i], n) ? F(" | %.0f to %.0f Hz, %.0f um", begins, ends, 1e6 * reaches) : " | no loss of contact")
        text = text line " |\n"
    }
}
function figure3(  k0, n, low, i, h, fmass, a, b, least) {
    head("Fig. 3: mesh stiffness and forced response", 3)
    table()
    k0 = s["k.stiffness_mean"]
    for (n = 1; n <= 8; n++) h[n] = v["kh.stiffness_harmonics", n]
    row("mean of k: 3 (further digits are lost) 1e8 N/m", F("%.3f 1e8 N/m; other stiffness models of this program give 3.1 to 4.4", k0 / 1e8), "(only one digit is known)", -1)
    row("no profile deviations, hence e(t) = 0", F("largest |e| %.2g um", 1e6 * max(highest("k", "transmission_error"), 0 - lowest("k", "transmission_error")) + 0), "no deviations are given", -2)
    row("the first three harmonics of k excite the pair (digits lost)", F("k1, k2, k3, k4 = %.3f, %.3f, %.3f, %.3f 1e8 N/m", h[1] / 1e8, h[2] / 1e8, h[3] / 1e8, h[4] / 1e8), "(the digits are not known)", -1)
    fmass = sqrt(k0 / s["g.equivalent_mass"]) / (2 * pi)
    row("f_n = 3242 Hz", F("given; with this k and solid steel discs it would be %.0f Hz", fmass), "`natural_frequency` is given", -2)
    resonance(1, "a primary resonance peak at f_n, 3240 Hz")
    resonance(2, "a super-harmonic peak at f_n/2, 1620 Hz")
    resonance(3, "a super-harmonic peak at f_n/3, 1080 Hz")
    row("two stable motions coexist near these peaks", F("a second motion exists from %.0f, %.0f and %.0f Hz downwards", two[1], two[2], two[3]), "a second motion at each", ((two[1] > 0) + (two[2] > 0) + (two[3] > 0)) / 3)
    a = motions_at("a", 1250); b = motions_at("a", 2085)
    row("I and II are off resonance", F("%d and %d stable motions of period 1 there; the upper ones belong to resonances at higher speeds", a, b), "one motion at each", 0.5 * (a == 1) + 0.5 * (b == 1))
    row("the lower motion is linear, without separation (I, II)", F("share of time with separated flanks: %.3g and %.3g", s["Im.contact_loss"], s["IIm.contact_loss"]), \
        "0", s["Im.contact_loss"] == 0 && s["IIm.contact_loss"] == 0)
    softening("a", 1)
    row("the upper motion loses contact (III) and softens", F("%.3g of the time separated; rms %.1f um; from %.0f Hz to lower speeds", s["IIIm.contact_loss"], 1e6 * s["IIIm.dte_rms"], begins), \
        "> 0; ends below f_n", s["IIIm.contact_loss"] > 0 && ends < 3242)
    row("agrees well with the measured response of the same pair (their refs. 7 to 9)", "-", "(the measured curves are not available as numbers)", -1)
    h["begins"] = begins
    least = face * over("Is", "load_per_width", lpstc - 1) / (0.13 * over("Ifs", "h_central", lpstc - 1))
    row("the lubricant is several orders stiffer than the mesh, by the Hamrock-Dowson formula", F("its stiffness is W/(0.13 h_central), since h varies as W^-0.13 (Dowson & Higginson): %.0f times the mean of k", least / k0), "over 100 times", least > 100 * k0)
    softening("aslope", 1)
    say("In this section k is the chord F/(e_l - e), as in the paper (`definition: secant`). For a small vibration, k is the slope dF/d(e_l), the preset of the model, " \
        F("whose mean is %.1f %% higher. f_n is given, so the mass changes in proportion; with the slope the rms of s at I, II and III is %.3f, %.3f and %.2f um (%.3f, %.3f and %.2f um with the chord), and the upper motion starts at %.0f Hz (%.0f Hz with the chord).", \
          100 * (s["kslope.stiffness_mean"] / k0 - 1), 1e6 * s["Islope.dte_rms"], 1e6 * s["IIslope.dte_rms"], 1e6 * s["IIIslope.dte_rms"], 1e6 * s["Im.dte_rms"], 1e6 * s["IIm.dte_rms"], 1e6 * s["IIIm.dte_rms"], begins, h["begins"]))
    say("The linear amplitudes are proportional to the harmonics of k and cannot be confirmed until those of the paper are known; " \
        "the upper branch hardly depends on k. Below the speeds of the figure there are resonances at f_n/4 and lower, due to harmonics 5 to 7 " \
        "of a k(t) with jumps, and from about 2100 to 2200 Hz the lower motion is unstable. All branches: [dynamics](dynamics.md); k by other models: [stiffness](stiffness.md).")
    say("Which k(t) would give the figure? At f_n/n the linear motion swings by k_n/(2 zeta k) times the static deflection, so contact is lost if k_n exceeds 2 zeta k: " \
        F("%.3f 1e8 N/m. The table is for a k with only the first three of these harmonics, each multiplied by the same factor. The columns give the range of mesh frequency with a second motion, and its rms at the lower end:", 2 * 0.01 * k0 / 1e8))
    over_sizes()
    say("Separate peaks with III on the upper branch would require a third of this k1, and k2 and k3 slightly above that threshold. Only the measured response of the pair could decide.")
}
function figure4(  i, u, rmax, rmin, sr0) {
    head("Fig. 4: radii and speeds", 4)
    table()
    row("SAP at 14.5, LPSTC 20.0, HPSTC 21.7, tip 27.2 deg", F("%.2f, %.2f, %.2f, %.2f deg", sap, lpstc, hpstc, tip), "the printed digits", \
        F("%.1f %.1f %.1f %.1f", sap, lpstc, hpstc, tip) == "14.5 20.0 21.7 27.2")
    rmax = highest("Is", "entrainment_speed"); rmin = lowest("Is", "entrainment_speed")
    row("u_r is constant, since the gears are alike", F("%.4f m/s, varies by %.0e of it", rmax, (rmax - rmin) / rmax), "the gears are alike", -2)
    row("u_s < 0 from SAP to the pitch point, 0 there, > 0 beyond", F("%.3f, %.0e, %.3f m/s at SAP, pitch point, tip", over("Is", "sliding_speed", sap), \
        over("Is", "sliding_speed", pitch), over("Is", "sliding_speed", tip)), "the gears are alike", -2)
    row("SR from a negative limit to a positive one", F("%.4f to %.4f", v["Is.slide_roll_ratio", 1], v["Is.slide_roll_ratio", count["Is"]]), \
        "the gears are alike", -2)
    row("1250 Hz is 1500 rpm", F("%.1f rpm", s["duty.speed"] * 30 / pi), "50 teeth", -2)
}
function figure5(  i, w, n, sx, sy, sxx, sxy, b, a, worst, x, y, rise, jump, flat, m, q, loss, zero) {
    head("Fig. 5: tooth forces", 5)
    table()
    for (i = 1; v["Iw.roll_angle", i] * deg < lpstc - 1e-6; i++) {
        x = v["Iw.roll_angle", i]; y = v["Iw.tooth_force", i]; n++
        sx += x; sy += y; sxx += x * x; sxy += x * y
    }
    w = v["Iw.tooth_force", n + 1] # LPSTC, before the jump
    b = (n * sxy - sx * sy) / (n * sxx - sx * sx); a = (sy - b * sx) / n
    for (i = 1; i <= n; i++) worst = max(worst, abs(a + b * v["Iw.roll_angle", i] - v["Iw.tooth_force", i]))
    rise = w - v["Iw.tooth_force", 1]
    row("W_s rises linearly from SAP to LPSTC", F("from %.0f to %.0f N; largest deviation from a straight line %.1f %% of the rise", v["Iw.tooth_force", 1], w, 100 * worst / rise), "below 5 %", worst < 0.05 * rise)
    jump = v["Iw.tooth_force", n + 2] / w
    row("W_s almost doubles at LPSTC", F("by a factor of %.3f", jump), "1.8 to 2; partly from 1.6", jump > 2 || jump < 1.6 ? 0 : jump >= 1.8 ? 1 : 0.5)
    flat = over("Is", "load_per_width", (lpstc + hpstc) / 2) / over("Is", "load_per_width", hpstc - 0.3) - 1
    row("W_s stays about relative change HPSTC, then drops", F("relative change %.0e; drops to %.3f of that", abs(flat), 1 / jump), "5 %; drop", abs(flat) < 0.05 && jump > 1.2)
    row("W_d at I differs much from W_s", F("rms difference %.0f %% of W_s", 100 * apart("Is", "Id", "load_per_width")), "above 10 %", apart("Is", "Id", "load_per_width") > 0.1)
    m = waves("Im")
    row("nearly three cycles of W_d in a base pitch at I, from harmonic 3 at f_n/3", F("%d waves of the mesh force; harmonics 1, 2, 3 of s: %.2f, %.2f, %.2f um", m, \
        1e6 * v["Ih.dte_harmonics", 1], 1e6 * v["Ih.dte_harmonics", 2], 1e6 * v["Ih.dte_harmonics", 3]), "3 waves", m == 3)
    m = dominant("IIh")
    row("W_d at II shows the second harmonic", F("strongest harmonic of s: %d; %d waves of the mesh force", m, waves("IIm")), "2; 2 waves", (m == 2) * 0.5 + (waves("IIm") == 2) * 0.5)
    q = highest("IIId", "load_per_width") / highest("IIIs", "load_per_width")
    row("III: largest W_d more than twice the largest W_s", F("%.3f times", q), "> 2", q > 2)
    for (i = 2; i <= count["IIId"]; i++) if (v["IIId.load_per_width", i] < 0.01 * highest("IIIs", "load_per_width"))
        zero += v["IIId.roll_angle", i] - v["IIId.roll_angle", i - 1]
    zero /= v["IIId.roll_angle", count["IIId"]] - v["IIId.roll_angle", 1]
    row("III: no load for large parts of the cycle", F("%.0f %% of the path below 1 %% of the largest W_s; flanks separated %.0f %% of the time", 100 * zero, 100 * s["IIIm.contact_loss"]), "above 20 %", zero > 0.2)
    say(F("At LPSTC W_s jumps up while k(t), and with it the mesh force, jumps down. W_d is proportional to their product and jumps only by a factor of %.3f at I. ", v["Iw.dynamic", n + 2] / v["Iw.dynamic", n + 1]) \
        F("II lies at %.2f f_n: the mesh force has the two waves of the second harmonic, but the first harmonic dominates s, since resonance amplifies it, too. ", 2085 / 3242) \
        "Before the landing at III the damper, which also acts in free flight (their eq. 2a), leaves a small force.")
}
function figure6(  P, q, x, y, up, down, c, places, level, m, d) {
    head("Fig. 6: least film", 6)
    table()
    up = ""; c = 1
    for (q = 1; q <= 3; q++) {
        P = points[q]
        x = peak(P "fs", "h_min", sap, tip, 1); up = up F("%s%.2f", q > 1 ? ", " : "", x); level = level F("%s%.3f", q > 1 ? ", " : "", extreme * 1e6)
        if (x < lpstc || x > hpstc) c = 0
    }
    row("W_s: thicker film by squeeze after the jump up at LPSTC", F("highest h_min, %s um, at %s deg (I, II, III)", level, up), "highest between LPSTC and HPSTC", c)
    up = ""; level = ""; c = 1
    for (q = 1; q <= 3; q++) {
        P = points[q]
        x = peak(P "fs", "h_min", sap, tip, -1); up = up F("%s%.2f", q > 1 ? ", " : "", x); level = level F("%s%.3f", q > 1 ? ", " : "", extreme * 1e6)
        if (x < hpstc || x > hpstc + 1.5) c = 0
    }
    row("W_s: thinner film by pumping after the drop at HPSTC", F("lowest h_min, %s um, at %s deg", level, up), "lowest within 1.5 deg after HPSTC", c)
    y = over("Ifs", "h_min", sap + 1.5); d = over("Ifs", "h_min", lpstc - 0.4)
    row("W_s: elsewhere smooth", F("I: h_min changes by %.1f %% from 16 deg to LPSTC", 100 * abs(d / y - 1)), "below 5 %", abs(d / y - 1) < 0.05)
    x = high_of("Ifs", lpstc - 0.3, lpstc + 1.2) - low_of("Ifs", lpstc - 0.3, lpstc + 1.2)
    y = high_of("coarse", lpstc - 0.3, lpstc + 1.2) - low_of("coarse", lpstc - 0.3, lpstc + 1.2)
    row("W_s: the spikes of other authors differ in size, perhaps because of coarser time steps", F("I: h_min swings by %.1f nm at LPSTC with 1000 steps, by %.1f nm with 125", 1e9 * x, 1e9 * y), \
        "difference over 10 %", abs(y / x - 1) > 0.1)
    m = maxima("Ifd", "h_min", sap, sap + cycle, 0.002e-6)
    row("I: the three waves of W_d appear in h_min", F("%d waves of h_min over the base pitch from SAP; h_min falls as W_d rises (correlation %.2f), %.2f deg later", m, lagging("Id", "Ifd", sap, lpstc - 0.3), lag), \
        "3 waves", m == 3 ? 1 : m == 2 ? 0.5 : 0)
    peak("IIfd", "h_min", sap, lpstc - 0.3, 1); y = extreme; peak("IIfd", "h_min", sap, lpstc - 0.3, -1); x = extreme
    m = maxima("IIfd", "h_min", sap, sap + cycle, 0.002e-6)
    row("II: h_min shows the second harmonic", F("%d waves over the base pitch; h_min from %.3f to %.3f um before LPSTC, under W_s from %.3f to %.3f um", m, 1e6 * x, 1e6 * y, \
        1e6 * low_of("IIfs", sap, lpstc - 0.3), 1e6 * high_of("IIfs", sap, lpstc - 0.3)), "2 waves", m == 2 ? 1 : m > 0 ? 0.5 : 0)
    x = high_of("Ifd", lpstc - 0.3, lpstc + 1.2) - low_of("Ifd", lpstc - 0.3, lpstc + 1.2)
    y = high_of("Ifs", lpstc - 0.3, lpstc + 1.2) - low_of("Ifs", lpstc - 0.3, lpstc + 1.2)
    row("I: the spikes of W_s do not matter under W_d", F("h_min swings by %.1f nm at LPSTC under W_d, by %.1f nm under W_s", 1e9 * x, 1e9 * y), "at most 2/3", x < 2 / 3 * y)
    level = ""; c = 0
    for (q = 1; q <= 3; q++) {
        P = points[q]
        d = apart(P "fs", P "fd", "h_min"); level = level F("%s%.3g", q > 1 ? ", " : "", 100 * d)
        c += d > 0.1
    }
    row("h_min under W_d is drastically different at all three points", F("rms difference %s %% (I, II, III)", level), "over 10 % at each", c == 3 ? 1 : c > 0 ? 0.5 : 0)
    x = highest("IIIfd", "h_min")
    row("III: no lasting film, flanks separated for much of the cycle", F("flanks separated %.0f %% of the time; h_min up to %.1f um; lowest %.3f um at %.2f deg, under W_s %.3f um", 100 * s["IIIm.contact_loss"], 1e6 * x, 1e6 * lowest("IIIfd", "h_min"), \
        peak("IIIfd", "h_min", sap, tip, -1), 1e6 * lowest("IIIfs", "h_min")), "over 20 %; over 1 um", 0.5 * (s["IIIm.contact_loss"] > 0.2) + 0.5 * (x > 1e-6))
    say("The tooth force jumps over 0.2 deg of roll (`load_ramp`), since a step has no converged p_max. The paper does not print the size of its spikes. " \
        "Before a landing, the damper's small force and the approach of the flanks keep the film below a micrometre. The curve of III is cut off above 1 um. During contact loss the paper applies 5 N to the flanks; here the film continues without " \
        "a load balance, so its h is then that of the gap.")
}
# adds the doubtful lines of a run's quality record
function doubtful(run, name, stage_,  path, line, part) {
    path = in_ "/" run ".said"
    while ((getline line < path) > 0) if (line ~ /, limit .*: (doubtful|bad)/) {
        split(line, part, ","); sub(/^ */, "", part[1])
        if (index(part[1], stage_ ".") != 1) continue
        sub(/.*, limit /, "", line); sub(/:.*/, "", line)
        doubts = doubts (doubts == "" ? "" : "; ") name ": `" part[1] "` (limit " line ")"
    }
    close(path)
}
# how far refinement by two moves h_min, and what the estimate says, both at their worst
function refined(  i, x, d, worst, estimate, beyond) {
    head("How sure the films are", "")
    for (i = 1; i <= count["Ifd"]; i++) {
        x = v["Ifd.roll_angle", i] * deg
        d = abs(over("fine", "h_min", x) - v["Ifd.h_min", i])
        if (d > worst) worst = d
        if (v["Ifd.h_min_error", i] > estimate) estimate = v["Ifd.h_min_error", i]
        if (d > v["Ifd.h_min_error", i]) beyond++
    }
    say(F("With twice the cells and twice the steps, h_min under W_d at I changes by %.2f nm at most. The estimate `h_min_error` is at most %.2f nm; the change exceeds it at %d of %d instants.", 1e9 * worst, 1e9 * estimate, beyond, count["Ifd"]))
    doubts = ""
    doubtful("I", "I", "film"); doubtful("II", "II", "film"); doubtful("III", "III", "film")
    doubtful("I", "I, W_s", "film_static"); doubtful("II", "II, W_s", "film_static"); doubtful("III", "III, W_s", "film_static")
    doubtful("rough-I-" surface[1], "rough flanks at I", "film")
    say("Doubtful quality lines of these runs: " (doubts == "" ? "nothing" : doubts) ".")
    say("[Steady films](film-steady.md) and [dynamics](dynamics.md) compare films and motions with exact and independent solutions.")
}
function high_of(key, from, to) { peak(key, "h_min", from, to, 1); return extreme }
function low_of(key, from, to) { peak(key, "h_min", from, to, -1); return extreme }
function figure7(  pA, hA, r, rA) { # in7 and out7 are for figure 8, too
    aim("I")
    head("Fig. 7: pressure and film under W_s at I", 7)
    text = text ("Solid: p. Dashed: h. The angles of the paper's A to J are not printed; here they follow from W_d by the rules in `paper.awk`. A is SAP and G is just after LPSTC, as in the paper.\n\n")
    table()
    pA = highest_pressure("7", "A") / over("Is", "hertz_pressure", sap)
    row("typical film of smooth flanks away from the jumps", F("A: largest p %.3f p_H, h_min %.3f um at the exit, h_central %.3f um", pA, 1e6 * least_film("7", "A"), 1e6 * film_at("7", "A", 0)), \
        "0.9 to 1.1 p_H, h_min < h_central", pA > 0.9 && pA < 1.1 && least_film("7", "A") < film_at("7", "A", 0))
    rG = ripple("7", "G", "H", "Is", -1.2, 0.8); rA = ripple("7", "E", "F", "Is", -1.2, 0.8)
    row("the jump of W_s at LPSTC is evident", F("p at G differs from that at H, where the film has settled under the same load, by %.1f %% of p_H (rms), p at E from that at F by %.1f %%; at G, h varies by %.0f %% within the contact, by %.1f %% at F", \
        100 * rG, 100 * rA, 100 * (unevenness("7", "G", "Is") - 1), 100 * (unevenness("7", "F", "Is") - 1)), "over twice as much at G", rG > 2 * rA)
    in7 = after_step("7", "Is", -1.2, -0.6); out7 = after_step("7", "Is", 0.6, 1.2); r = after_step("7", "Is", -0.3, 0.3)
    row("with ripples of p at the inlet and at the outlet (the paper says so of G with Fig. 8)", F("if the load jumps instantly, p %.2f deg after LPSTC differs from that at H by %.0f %% of p_H from -1.2 a to -0.6 a, %.0f %% from 0.6 a to 1.2 a, %.1f %% from -0.3 a to 0.3 a", soon, 100 * in7, 100 * out7, 100 * r), \
        "both above the middle", 0.5 * (in7 > r) + 0.5 * (out7 > r))
    pA = over("Ifs", "p_max", pitch) / over("Ifs", "p_max", sap) / sqrt(over("Is", "load_per_width", pitch) / over("Is", "load_per_width", sap))
    r = over("Is", "equivalent_radius", pitch) / over("Is", "equivalent_radius", sap)
    rA = over("Ifs", "friction_coefficient", sap + 0.5); hA = over("Ifs", "friction_coefficient", tip - 0.5)
    row("the changes of radii and sliding are evident", F("largest p over the root of the load falls to %.3f from SAP to the pitch point, as r_eq grows to %.3f; the friction coefficient goes from %.4f at 15 deg to %.4f at 26.7 deg", pA, r, rA, hA), \
        "over 2 %; change of sign", 0.5 * (abs(pA - 1) > 0.02) + 0.5 * (rA * hA < 0))
}
# positions at which two figures' pressures differ by over a tenth of p_H, rms over the first one's contact
function unlike(one, two, load_key,  i, k, letter, a, d, n, m, sum) {
    unlike_mean = unlike_film = 0
    for (i = 1; i <= 10; i++) {
        letter = substr("ABCDEFGHIJ", i, 1); sum = n = 0
        a = over(load_key, "hertz_half_width", at[letter])
        for (k = 1; k <= count[one "x"]; k++) if (abs(v[one "x.x", k]) <= a) {
            d = value_at(two, "p", letter, v[one "x.x", k]) - f[one "p", letter, k]; sum += d * d; n++
        }
        d = sqrt(sum / n) / over(load_key, "hertz_pressure", at[letter])
        unlike_mean += d / 10
        unlike_film = max(unlike_film, abs(film_at(two, letter, 0) / film_at(one, letter, 0) - 1))
        if (d > 0.1) m++
    }
    return m + 0
}
# by straight lines between the nodes, within the domain
function value_at(key, what, letter, x,  k, t) {
    t = (x - v[key "x.x", 1]) / (v[key "x.x", 2] - v[key "x.x", 1])
    k = max(1, min(count[key "x"] - 1, int(t) + 1)); t = max(0, min(1, t - (k - 1)))
    return f[key what, letter, k] * (1 - t) + f[key what, letter, k + 1] * t
}
# the station before the jump at LPSTC
function count_to_lpstc(  i) {
    for (i = 1; v["Iw.roll_angle", i] * deg < lpstc - 1e-6; i++);
    return i
}
function figure8(  wA, wB, wC, hA, hB, hC, pA, pB, r, d) {
    aim("I")
    head("Fig. 8: pressure and film under W_d at I", 8)
    table()
    d = peak("Id", "load_per_width", sap, sap + 0.6, 1)
    row("W_d peaks at SAP", F("a local peak at %.2f deg, %.0f N; the largest is %.0f N", d, face * extreme, face * highest("Id", "load_per_width")), \
        "local peak within 0.3 deg of SAP, and the largest", d - sap < 0.3 ? (extreme > 0.99 * highest("Id", "load_per_width") ? 1 : 0.5) : 0)
    pA = highest_pressure("8", "A") / over("Id", "hertz_pressure", sap)
    row("A: typical film and pressure of smooth flanks", F("largest p %.3f p_H, h_min %.3f um at the exit, h_central %.3f um", pA, 1e6 * least_film("8", "A"), 1e6 * film_at("8", "A", 0)), \
        "0.9 to 1.1 p_H, h_min < h_central", pA > 0.9 && pA < 1.1 && least_film("8", "A") < film_at("8", "A", 0))
    row("p and h completely different from those under W_s", F("p differs by more than a tenth of p_H (rms over the contact under W_s) at %d of 10 positions, by %.0f %% on average; h_central by up to %.0f %%", unlike("7", "8", "Is"), 100 * unlike_mean, 100 * unlike_film), \
        "at 5 or more", unlike("7", "8", "Is") >= 5 ? 1 : unlike("7", "8", "Is") > 0 ? 0.5 : 0)
    pA = highest_pressure("8", "A"); pB = highest_pressure("8", "B"); hA = film_at("8", "A", 0); hB = film_at("8", "B", 0); hC = film_at("8", "C", 0)
    row("A to B, as W_d falls: less pressure, thicker film", F("p_max %.0f to %.0f MPa, h_central %.3f to %.3f um", pA / 1e6, pB / 1e6, 1e6 * hA, 1e6 * hB), "both", 0.5 * (pB < pA) + 0.5 * (hB > hA))
    wB = width_above("8", "B", 0.1); wC = width_above("8", "C", 0.1)
    row("B to C, as W_d rises: wider and thicker", F("width (p above a tenth of its largest) %.0f to %.0f um, h_central %.3f to %.3f um", 1e6 * wB, 1e6 * wC, 1e6 * hB, 1e6 * hC), "both", 0.5 * (wC > wB) + 0.5 * (hC > hB))
    r = ripple("8", "G", "H", "Id", -1.2, 0.8)
    hA = after_step("8", "Id", -1.2, -0.6); hB = after_step("8", "Id", 0.6, 1.2)
    row("the ripples of p at G under W_s are absent", F("p at G differs from that at H by %.1f %% of p_H, under W_s by %.1f %%; if the loads jump instantly, the difference is %.0f %% at the inlet and %.0f %% at the outlet, under W_s %.0f and", 100 * r, 100 * rG, 100 * hA, 100 * hB, 100 * in7) F(" %.0f %%", 100 * out7), \
        "at most half", 0.5 * (r < 0.5 * rG) + 0.5 * (hA < 0.5 * in7 && hB < 0.5 * out7))
    say(F("Why partly: A is a peak of W_d, but the phases of the harmonics of k decide which of the four peaks is the highest. At LPSTC the remaining jump of W_d, %.3f times, has a smaller effect on G.", v["Iw.dynamic", count_to_lpstc() + 1] / v["Iw.dynamic", count_to_lpstc()]))
}
function figure9(  i, m, x, share) {
    aim("III")
    head("Fig. 9: pressure and film under W_d at III", 9)
    table()
    row("A to E: a first loaded part", F("%.2f to %.2f deg; p_max up to %.0f MPa", at["A"], at["E"], 1e3 * peak_of("IIIfd", "p_max", at["A"], at["E"]) / 1e9), "starts at SAP and ends before LPSTC", at["E"] < lpstc)
    m = 1
    for (i = 2; i <= 4; i++) {
        x = substr("ABCDE", i, 1); share = share F("%s%.3f", i > 2 ? ", " : "", 1e6 * film_at("9", x, 0))
        if (highest_pressure("9", x) < 0.9 * over("IIId", "hertz_pressure", at[x]) || film_at("9", x, 0) > 1e-6) m = 0
    }
    row("A to E: a film is formed to a certain extent", F("h_central %s um at B, C, D, with p_max of %.2f p_H at C", share, highest_pressure("9", "C") / over("IIId", "hertz_pressure", at["C"])), "p_max over 0.9 p_H, h below 1 um", m)
    m = least_of("IIIfd", "p_max", at["E"], at["F"]) / highest("IIIfd", "p_max")
    row("E to F: no load, the film dissolves", F("p_max down to %.1e of its largest; h_min up to %.1f um", m, 1e6 * high_of("IIIfd", at["E"], at["F"])), "1e-3; above 1 um", m < 1e-3 && high_of("IIIfd", at["E"], at["F"]) > 1e-6)
    row("F: contact again", F("at %.2f deg with %.3f um between the flanks; p_max %.0f MPa at G", at["F"], 1e6 * least_film("9", "F"), highest_pressure("9", "G") / 1e6), "force again above 5 % of its largest", at["F"] > at["E"])
    m = (film_at("9", "G", 100e-6) - film_at("9", "G", -100e-6)) / film_at("9", "G", 0)
    row("F to J: rapid changes", F("G: the film rises by %.0f %% from x = -100 to 100 um; largest p_max %.0f MPa at %.2f deg", 100 * m, peak_of("IIIfd", "p_max", at["F"], at["J"]) / 1e6, extreme_at), "film uneven by over 10 %", m > 0.1)
    row("no resemblance to results under W_s", F("rms difference of p_max %.0f %% of that under W_s", 100 * apart("IIIfs", "IIIfd", "p_max")), "over 30 %", apart("IIIfs", "IIIfd", "p_max") > 0.3)
    if (parts > 1) say(F("After J the flanks separate again, until %.2f deg, the tip.", tip))
}
function peak_of(key, column, from, to) { extreme_at = peak(key, column, from, to, 1); return extreme }
function least_of(key, column, from, to) { extreme_at = peak(key, column, from, to, -1); return extreme }
BEGIN {
    if (failed) exit 1
    figure2(); figure3(); figure4(); figure5(); figure6(); figure7(); figure8(); figure9(); figure10(); figure11(); refined(); overview(); all_points()
    print "# Figures 2 to 11 of Li & Kahraman 2011\n"
    print "S. Li, A. Kahraman, *Influence of dynamic behaviour on elastohydrodynamic lubrication of spur"
    print "gears*, Proc. IMechE Part J (2011). Figures and page are written by\n"
    print "```sh\nsh docs/validation/paper.sh build\n```\n"
    print "from `configs/li-kahraman-2011.yaml` (512 cells, 1000 steps), without manual entries. The curves of"
    print "the paper are not available as numbers, and many digits of its text are lost, so only its statements"
    print "can be compared with results. A row gives a statement, the result of the program (\"here\"), the"
    print "condition under which they agree, and the verdict.\n"
    print "I, II and III are the paper's operating points: mesh frequencies of 1250, 2085 and 2375 Hz, III on"
    print "the upper branch. W_s is the quasi-static, W_d the dynamic tooth force; other symbols: [theory](../theory.md#1-conventions).\n"
    printf "Of %d statements ", verdict["agrees"] + verdict["partly"] + verdict["differs"]
    printf "%d agree, %d agree in part and %d differ. ", verdict["agrees"], verdict["partly"], verdict["differs"]
    printf "%d more cannot be compared, since numbers of\nthe paper are lost or were never printed. %d more are true by construction (\"set\") and are not counted.\n", verdict["not to be compared"], verdict["set"]
    printf "%s", text
}
