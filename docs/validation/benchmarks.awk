# Writes the page of benchmarks.sh. The references are what is typed here, each with its source.

function row(what, reference, here,  off) {
    off = 100 * (here / reference - 1)
    printf "| %s | %.6g | %.6g | %s |\n", what, reference, here, abs(off) < 1e-5 ? "0" : sprintf("%+.2g %%", off)
}
function table(title, source) {
    print "\n## " title "\n\n" source "\n\n| | reference | here | difference |\n|---|---|---|---|"
}
function geometry(  rb, C, m, t) {
    table("Geometry and motion of the unity pair", "References are closed forms with r_b = 75 mm cos 20 deg and C = 150 mm; r1 + r2 = C sin 20 deg, u_r = omega C sin(20 deg)/2.")
    rb = 75 * cos(20 / deg); C = 150 * sin(20 / deg)
    row("base radius, mm", rb, v["gg.base_radius", 1] * 1e3)
    row("base pitch, mm", 3 * pi * cos(20 / deg), s["g.base_pitch"] * 1e3)
    t = sqrt(78 ^ 2 - rb ^ 2)
    row("roll angle of the tip, deg", t / rb * deg, s["g.roll_tip"] * deg)
    row("of SAP", (C - t) / rb * deg, s["g.roll_sap"] * deg)
    row("of LPSTC", t / rb * deg - 7.2, s["g.roll_lpstc"] * deg)
    row("of HPSTC", (C - t) / rb * deg + 7.2, s["g.roll_hpstc"] * deg)
    row("of the pitch point, 180/pi tan 20 deg", sin(20 / deg) / cos(20 / deg) * deg, s["g.roll_pitch"] * deg)
    row("contact ratio", (2 * t - C) / (3 * pi * cos(20 / deg)), s["g.contact_ratio"])
    row("radius of curvature at SAP, mm", C - t, v["c.radius_1", 1] * 1e3)
    row("slide-to-roll ratio at SAP", 2 * (C - 2 * t) / C, v["c.slide_roll_ratio", 1])
    row("u_r at 1250 Hz, m/s", 157.0796327 * C / 2e3, v["c.entrainment_speed", 1])
    row("F = T/r_b, N", 250e3 / rb, s["duty.line_force"])
    m = 7850 * pi * 0.075 ^ 4 / 2 * 0.02 / (2 * (rb / 1e3) ^ 2)
    row("m_e of two solid discs, kg", m, s["g.equivalent_mass"])
}
function contact(  i, E, R, w, U, W, G, speed, u, a, names, k) {
    table("Contact at the pitch point", "Hertz' half width a and pressure p_H, Moes' numbers M and L, and films by published formulas (Moes 2000; Dowson & Higginson 1977: 2.65 G^0.54 U^0.7 W^-0.13; Pan & Hamrock 1989: 1.714 W^-0.128 U^0.694 G^0.568; Dowson & Toyoda 1978: 3.06 G^0.56 U^0.69 W^-0.10), computed by hand for alpha = 11 1/GPa, eta0 = 5.006 mPa s, no compression, one pair of teeth.")
    E = 206e9 / (1 - 0.09); R = 150e-3 * sin(20 / deg) / 4; w = 250 / (0.075 * cos(20 / deg)) / 0.02
    split("1250 2085 2375", speed, " ")
    a = sqrt(8 * w * R / (pi * E))
    row("a, um", 1e6 * a, 1e6 * over("c", "hertz_half_width", s["g.roll_pitch"] * deg))
    row("p_H, MPa", 2 * w / (pi * a) / 1e6, over("c", "hertz_pressure", s["g.roll_pitch"] * deg) / 1e6)
    G = 11e-9 * E; W = w / (E * R)
    for (i = 1; i <= 3; i++) {
        load(in_ "/moes-" speed[i], "static", "c"); load(in_ "/moes-" speed[i], "film", "moes")
        load(in_ "/dowson-higginson-" speed[i], "film", "dh"); load(in_ "/dowson-toyoda-" speed[i], "film", "dt")
        load(in_ "/pan-hamrock-" speed[i], "film", "ph")
        u = 2 * pi * speed[i] / 50 * 75e-3 * sin(20 / deg)
        U = 5.006e-3 * u / (E * R)
        row("M at " speed[i] " Hz", W / sqrt(2 * U), at_pitch("c", "moes_M"))
        row("L", G * (2 * U) ^ 0.25, at_pitch("c", "moes_L"))
        row("h_central by Moes, um", 1e6 * R * sqrt(2 * U) * moes(W / sqrt(2 * U), G * (2 * U) ^ 0.25), 1e6 * at_pitch("moes", "h_central"))
        row("h_min by Dowson & Higginson", 2.65e6 * R * G ^ 0.54 * U ^ 0.7 * W ^ -0.13, 1e6 * at_pitch("dh", "h_min"))
        row("h_min by Pan & Hamrock", 1.714e6 * R * W ^ -0.128 * U ^ 0.694 * G ^ 0.568, 1e6 * at_pitch("ph", "h_min"))
        row("h_central by Dowson & Toyoda", 3.06e6 * R * G ^ 0.56 * U ^ 0.69 * W ^ -0.10, 1e6 * at_pitch("dt", "h_central"))
    }
}
function at_pitch(key, column) { return over(key, column, s["g.roll_pitch"] * deg) }
function moes(M, L,  ri, ei, rp, ep, q) {
    ri = 3 / M; ei = 2.621 * M ^ -0.2; rp = 1.287 * L ^ (2 / 3); ep = 1.311 * M ^ -0.125 * L ^ 0.75
    q = (7 + 8 * exp(-2 * ei / ri)) / 5
    return ((ri ^ (7 / 3) + ei ^ (7 / 3)) ^ (3 * q / 7) + (rp ^ -3.5 + ep ^ -3.5) ^ (-2 * q / 7)) ^ (1 / q)
}
function laws(  i, k, at, want) {
    table("Doolittle-Tait, eta/eta0", "V = 1 - ln(1 + p (1 + K0')/K0)/(1 + K0'), eta = eta0 exp(B V_occ (1 - V)/((V - V_occ)(1 - V_occ))) computed by hand for B = 3.7303, V_occ = 0.6132, K0 = 1.05 GPa, K0' = 10.076.")
    split("8.416 40.97 170.5 671.5 2626", want, " ")
    for (i = 1; i <= count["law"]; i++) for (k = 1; k <= 5; k++)
        if (abs(v["law.p", i] - k * 2e8) < 1e6) row(F("%.1f GPa", k / 5), want[k], v["law.doolittle-tait", i] / v["law.doolittle-tait", 1])
}
function F(format, a) { return sprintf(format, a) }
function stiffness() {
    scalars(in_ "/iso", "mesh", "iso")
    table("ISO 6336-1, method B", "q' = 0.04723 + 0.15551/50 + 0.25791/50, C_M = 0.8, dedendum of the basic rack 1.2 modules, contact ratio above.")
    row("c_gamma times 20 mm, 1e8 N/m", 0.8 / (0.04723 + 0.15551 / 50 + 0.25791 / 50) * (0.75 * s["g.contact_ratio"] + 0.25) * 20 * 1e6 / 1e8, s["iso.stiffness_mean"] / 1e8)
}
function motions(  i, n, list, part) {
    table("Forced response", "References come from another program (Runge-Kutta, 400 steps per mesh cycle, 64 cycles after 400 to settle) for k(x) = 325.81 - 74.5 cos x - 46.5 cos 2x - 21.9 cos 3x MN/m over the phase angle x, m_e 0.7852 kg, damping ratio 0.01, half backlash 70 um, and have four digits: rms and peak to peak of s in um, largest mesh force over F.")
    n = split("1250-lower 5.067 14.99 1.735|2085-lower 3.634 11.22 1.567|2375-lower 4.367 12.17 1.539|2375-upper 24.74 70.54 3.942|3600-lower 5.297 15 1.847|4000-lower 2.806 7.99 1.509", list, "|")
    for (i = 1; i <= n; i++) {
        split(list[i], part, " ")
        scalars(in_ "/motion-" part[1], "motion", "m")
        row(hertz(part[1]) ", rms", part[2], 1e6 * s["m.dte_rms"])
        row("peak to peak", part[3], 1e6 * s["m.dte_peak_to_peak"])
        row("force", part[4], s["m.dynamic_factor_mesh"])
    }
    print "\nFolds and stability: [dynamics](dynamics.md)."
}
function momentum() {
    table("Load of a motion of two mesh cycles", "The same pair at 6484 Hz, twice the natural frequency, with a damper that acts only in contact: its motion repeats after two mesh cycles and loses contact for 29 % of the time. Since the mean speeds are constant, the force of all pairs, averaged over both engagements, must be torque over base radius.")
    scalars(in_ "/momentum-all", "static", "both"); scalars(in_ "/momentum-all", "duty", "d")
    row("mean load of the mesh, N", s["d.line_force"], s["both.mesh_load_mean"])
    scalars(in_ "/momentum-0", "static", "first"); scalars(in_ "/momentum-1", "static", "second")
    printf "\nThe first engagement alone would give %.0f N, the second %.0f N.\n", s["first.mesh_load_mean"], s["second.mesh_load_mean"]
}
function hertz(name) { sub(/-/, " Hz ", name); return name }
BEGIN {
    load(in_, "laws", "law")
    load(in_ "/moes-1250", "static", "c"); load(in_ "/moes-1250", "gears-gear", "gg")
    scalars(in_ "/moes-1250", "gears", "g"); scalars(in_ "/moes-1250", "duty", "duty")
    if (failed) exit 1
    print "# Numbers known from elsewhere\n"
    print "```sh\nsh docs/validation/benchmarks.sh build\n```\n"
    print "writes this page; `benchmarks.awk` contains the references and their sources. A difference below\n1e-5 % is printed as 0. [Steady films](film-steady.md) compares films with exact and independent solutions."
    geometry(); contact(); laws(); stiffness(); motions(); momentum()
}
