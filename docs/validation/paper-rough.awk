# Rough flanks: what the page says of figures 10 and 11, of the other surfaces and of the other points.

# from the first to the last x with more than 0.1 GPa
function zone(key, letter,  k, from, to) {
    for (k = 1; k <= count[key "x"]; k++) if (f[key "p", letter, k] > 1e8) { if (!from) from = k; to = k }
    return (to - from) * (v[key "x.x", 2] - v[key "x.x", 1])
}
function widest(key, letter, half,  k, m) {
    for (k = 1; k <= count[key "x"]; k++) if (abs(v[key "x.x", k]) < 0.7 * half) m = max(m, f[key "h", letter, k])
    return m
}
# peaks of p that stand out by more than a twentieth of the highest
function peaks(key, letter,  k, p, dead, low, high, up, n) {
    dead = 0.05 * highest_pressure(key, letter)
    for (k = 1; k <= count[key "x"]; k++) {
        p = f[key "p", letter, k]
        if (p > high) high = p
        if (p < low) low = p
        if (!up && p > low + dead) { up = 1; high = p }
        if (up && p < high - dead) { up = 0; low = p; n++ }
    }
    return n + 0
}
# more than 1 GPa where the film is below 10 nm
function thin_spike(key, letter,  k) {
    for (k = 1; k <= count[key "x"]; k++) if (f[key "h", letter, k] < 1e-8 && f[key "p", letter, k] > 1e9) return 1
    return 0
}
function note(set, name, seed, x) { M[set, name, seed] = x }
# mean, lowest and highest over the surfaces
function spread(set, name,  i, x) {
    mean_ = 0; low_ = 1e99; high_ = -1e99
    for (i = 1; i <= seed_count; i++) {
        x = M[set, name, surface[i]]
        mean_ += x / seed_count; low_ = min(low_, x); high_ = max(high_, x)
    }
    return mean_
}
function shown(set, name, digits, scale) {
    spread(set, name)
    return sprintf("%." digits "f (%." digits "f to %." digits "f)", scale * mean_, scale * low_, scale * high_)
}
# the ten positions of one surface, beside the smooth film
function look_at_positions(set, key, smooth_key, load_key, seed,  i, letter, over_1, touch, thin, n, sx, sy, sxx, syy, sxy, a, b, valley, rough_peaks, smooth_peaks, w, sw, sww, swy) {
    for (i = 1; i <= 10; i++) {
        letter = substr("ABCDEFGHIJ", i, 1)
        if (highest_pressure(key, letter) > 1e9) over_1++
        if (over(key, "contact_ratio", at[letter]) > 0) touch++
        thin += thin_spike(key, letter)
        a = zone(smooth_key, letter); b = zone(key, letter); w = over(load_key, "load_per_width", at[letter])
        n++; sx += a; sy += b; sxx += a * a; syy += b * b; sxy += a * b; sw += w; sww += w * w; swy += w * b
        valley = max(valley, widest(key, letter, a / 2) / film_at(smooth_key, letter, 0))
        rough_peaks += peaks(key, letter) / 10; smooth_peaks += peaks(smooth_key, letter) / 10
    }
    note(set, "over_1", seed, over_1); note(set, "touch", seed, touch); note(set, "thin", seed, thin)
    note(set, "valley", seed, valley); note(set, "peaks", seed, rough_peaks); note(set, "smooth_peaks", seed, smooth_peaks)
    note(set, "zone", seed, (n * sxy - sx * sy) / sqrt((n * sxx - sx * sx) * (n * syy - sy * sy)))
    note(set, "by_load", seed, (n * swy - sw * sy) / sqrt((n * sww - sw * sw) * (n * syy - sy * sy)))
    note(set, "width", seed, sy / n); note(set, "smooth_width", seed, sx / n)
}
# correlation over the ten positions of the smooth zone with the mean zone of all surfaces
function mean_zone(set, P,  i, k, letter, a, b, n, sx, sy, sxx, syy, sxy) {
    for (i = 1; i <= 10; i++) {
        letter = substr("ABCDEFGHIJ", i, 1); b = 0
        a = zone(snap[P, substr(set, length(set))], letter)
        for (k = 1; k <= seed_count; k++) b += zone("r" set surface[k], letter) / seed_count
        n++; sx += a; sy += b; sxx += a * a; syy += b * b; sxy += a * b
    }
    return (n * sxy - sx * sy) / sqrt((n * sxx - sx * sx) * (n * syy - sy * sy))
}
# all instants of one surface at which the load is above a twentieth of its highest
function look_at_times(set, key, seed,  i, n, h, p, thin, touch, yield_, share, lambda, friction) {
    h = 1
    for (i = 1; i <= count[key]; i++) {
        if (!loaded[set, i]) continue
        n++
        h = min(h, v[key ".h_min", i]); p = max(p, v[key ".p_max", i])
        thin += v[key ".h_min", i] < 1e-8; touch += v[key ".contact_ratio", i] > 0
        yield_ += v[key ".yield_share", i] > 0
        share += v[key ".asperity_load_share", i]; lambda += v[key ".lambda_ratio", i]
        friction += abs(v[key ".friction_coefficient", i])
    }
    note(set, "h_min", seed, h); note(set, "p_max", seed, p); note(set, "thin_time", seed, thin / n)
    note(set, "touch_time", seed, touch / n); note(set, "yield_time", seed, yield_ / n); note(set, "share", seed, share / n); note(set, "lambda", seed, lambda / n)
    note(set, "friction", seed, friction / n)
}
# which instants are loaded, and the central film of smooth flanks at them
function find_loaded(set, key, smooth_key, load_key,  i, j, x, most, n, sum) {
    most = highest(load_key, "load_per_width"); j = 1
    for (i = 1; i <= count[key]; i++) {
        x = v[key ".roll_angle", i]
        while (j < count[load_key] && v[load_key ".roll_angle", j + 1] < x) j++
        loaded[set, i] = v[load_key ".load_per_width", j] > 0.05 * most
    }
    for (i = 1; i <= count[smooth_key]; i++) if (loaded[set, i]) { sum += v[smooth_key ".h_central", i]; n++ }
    smooth_film[set] = sum / n
}
function look(P, L,  i, set, key) {
    set = P L
    aim(P)
    find_loaded(set, "r" set surface[1], P "f" L, set)
    for (i = 1; i <= seed_count; i++) {
        key = "r" set surface[i]
        look_at_positions(set, key, snap[P, L], set, surface[i])
        look_at_times(set, key, surface[i])
    }
}

function figure10() {
    head("Fig. 10: roughness of the flanks", 10)
    table()
    row("R_q of 0.54 and 0.53 um", F("%.4f and %.4f um", 1e6 * s["r.rq_1"], 1e6 * s["r.rq_2"]), "`rq` is given", -2)
    row("the traces measured on ground flanks", "made by `surface/synthetic`: waves from 20 to 400 um, power falling with the square of the wave number", "(the traces are not known)", -1)
    say("The paper's measured surfaces are not published. The following results are for " seed_count " surfaces with the same Rq (`seed` " surface[1] \
        " to " surface[seed_count] "); the first one is drawn.")
}
function of_ten(set, name) { return shown(set, name, 1, 1) }
function figure11(  set, first, i, fine_touch, cells, why) {
    look("I", "d")
    set = "Id"; first = surface[1]
    head("Fig. 11: rough flanks under W_d at I", 11)
    text = text "At the positions of Fig. 8; pressures beyond the scale are cut off. The numbers are means over the surfaces, with the lowest and the highest in brackets.\n\n"
    table()
    spread(set, "over_1")
    row("local pressures easily exceed 1 GPa", F("at %s of 10 positions; %s GPa at the most", of_ten(set, "over_1"), shown(set, "p_max", 1, 1e-9)), "at 5 or more", spread(set, "over_1") >= 5 ? 1 : mean_ > 0 ? 0.5 : 0)
    row("contacts of asperities with h = 0 and spikes of p", F("p above 1 GPa where h is below 10 nm (which looks like 0 in a drawing) at %s of 10 positions; contact (h = 1 nm) at %s of them, and for %s %% of the time", \
        of_ten(set, "thin"), of_ten(set, "touch"), shown(set, "touch_time", 1, 100)), "contact at 5 or more; partly: such spikes at 5 or more", spread(set, "touch") >= 5 ? 1 : spread(set, "thin") >= 5 ? 0.5 : 0)
    row("valleys with much larger films", F("up to %s times the smooth film at the same place", shown(set, "valley", 1, 1)), "over 3", spread(set, "valley") > 3)
    row("the contact zone varies as with smooth flanks", F("the width of the zone above 0.1 GPa has a correlation of %s with that of smooth flanks; the mean width over the surfaces has %.2f; the width is %s um on average, smooth %.0f um", shown(set, "zone", 2, 1), mean_zone(set, "I"), shown(set, "width", 0, 1e6), 1e6 * M[set, "smooth_width", first]), \
        "above 0.8; partly above 0.5", spread(set, "zone") > 0.8 ? 1 : mean_ > 0.5 ? 0.5 : 0)
    row("neither p nor h is smooth", F("%s peaks of p at a position, smooth %.1f; film over the roughness of both flanks %s on average", shown(set, "peaks", 1, 1), M[set, "smooth_peaks", first], shown(set, "lambda", 2, 1)), \
        "over twice the peaks", spread(set, "peaks") > 2 * M[set, "smooth_peaks", first])
    row("W_d clearly influences p and h", F("correlation of the zone with W_d %s", shown(set, "by_load", 2, 1)), "above 0.5", spread(set, "by_load") > 0.5)
    for (i = 1; i <= count["finer"]; i++) fine_touch += v["finer.contact_ratio", i] > 0
    why = "Why partly: other traces touch at other places, so single spikes cannot agree, and the zone at ten positions depends on single asperities. "
    if (spread(set, "touch") < 5)
        why = why "Under the pressure peaks of asperities the oil is almost solid and can hardly escape: the film falls to some nanometres there, and for part of the time to 1 nm, which counts as contact. For waves of 20 um the share of time with contact has not converged with the cells of these runs ([mixed lubrication](mixed.md)). "
    cells = over("Is", "entrainment_speed", pitch) * (tip - sap) / deg / s["duty.speed"] / 1000 / (4 * highest("Is", "hertz_half_width") / 512)
    why = why F("In one of the paper's 1000 steps the oil moves %.1f of its cells, which smears waves of 20 um; here it moves at most one. ", cells)
    if (!quick)
        why = why F("Waves down to 5 um (first surface, 1024 cells) touch over %.1f %% of the time, with up to %.0f GPa; the traces of the paper may reach down to its cells of 1.3 um. ", \
            100 * fine_touch / count["finer"], highest("finer", "p_max") / 1e9)
    say(why F("Here the metal yields at its hardness of 7 GPa, which is reached during %s %% of the time. In the paper the flanks only deform elastically.", shown(set, "yield_time", 1, 100)))
}

# where each figure of ten positions is
function link(P, L, rough) { return "[" (rough ? "rough" : "smooth") "](paper-" name_of(P, L, rough) ".svg)" }
function overview(  q, P) {
    if (quick) { text = text "\n"; return } # as before the heading
    head("Beyond the paper: all points and loads", "")
    say("Figures of p and h at ten positions, for smooth flanks and for the first surface. For point II, the positions B, D and F are turning points of W_d, and J is its last minimum.\n")
    text = text "| point | W_s | W_d |\n|---|---|---|\n"
    for (q = 1; q <= 3; q++) {
        P = points[q]
        text = text "| " P " | " link(P, "s", 0) ", " link(P, "s", 1) " | " link(P, "d", 0) ", " link(P, "d", 1) " |\n"
    }
}
function all_points(  q, l, P, L, set) {
    if (quick) return
    text = text "\n![least and mean films of rough flanks](paper-rough-films.svg)\n\n"
    text = text "Rough flanks, while the load is above a twentieth of its highest: mean over " seed_count " surfaces, with the lowest and the highest:\n\n"
    text = text "| point, load | mean film, um | smooth film, um | lowest h_min, nm | h_min below 10 nm, % of the time | largest p, GPa | contact, % of the time | share of asperities, % | mean friction | correlation of the zone with the smooth one |\n"
    text = text "|---|---|---|---|---|---|---|---|---|---|\n"
    for (q = 1; q <= 3; q++) for (l = 1; l <= 2; l++) {
        P = points[q]; L = substr("sd", l, 1); set = P L
        look(P, L)
        text = text "| " P ", W_" L " | " shown(set, "lambda", 2, both_rq * 1e6) " | " F("%.3f", 1e6 * smooth_film[set]) " | " shown(set, "h_min", 1, 1e9) " | " shown(set, "thin_time", 0, 100) " | " \
            shown(set, "p_max", 1, 1e-9) " | " shown(set, "touch_time", 1, 100) " | " shown(set, "share", 2, 100) " | " shown(set, "friction", 4, 1) " | " shown(set, "zone", 2, 1) " |\n"
    }
    say("The mean film is taken over the middle half of the Hertz width. This film is thicker than the smooth one, since pressure peaks at asperities keep the flanks apart.")
}
