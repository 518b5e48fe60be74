/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a mesh stiffness owes: positive, periodic, in balance with the load. */
#include "look.h"
#include "offer.h"

#include <math.h>

static const double pi = 3.14159265358979323846;

/* A pair of 50 teeth each, module 3 mm, 20 deg, standard proportions. */
static void play(const ff_bench *bench)
{
    enum { PART = 33, STATIONS = 3 * PART };
    const double teeth[] = {50, 50}, base = 0.075 * cos(20 * pi / 180), cycle = 2 * pi / 50,
                 tip = sqrt(0.078 * 0.078 - base * base) / base, sap = 2 * tan(20 * pi / 180) - tip,
                 ends[] = {sap, tip - cycle, sap + cycle, tip};
    static const struct {
        const char *name;
        double value;
    } rows[] = {{"gear.base_radius", 0.0704769465},
                {"gear.reference_radius", 0.075},
                {"gear.root_radius", 0.07125},
                {"gear.bore_radius", 0},
                {"gear.tooth_thickness", 0.00471238898},
                {"gear.elastic_modulus", 206e9},
                {"gear.poisson_ratio", 0.3}};
    double roll[STATIONS];
    for (int i = 0; i < STATIONS; i++) {
        const double *from = &ends[i / PART];
        roll[i] = from[0] + (from[1] - from[0]) * (i % PART) / (PART - 1);
    }
    give_series(bench, "gear.roll_angle", STATIONS, roll);
    give_series(bench, "gear.teeth", 2, teeth);
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        give_series(bench, rows[i].name, 2, (const double[]){rows[i].value, rows[i].value});
    give_scalar(bench, "gear.roll_sap", sap);
    give_scalar(bench, "gear.roll_lpstc", ends[1]);
    give_scalar(bench, "gear.roll_hpstc", ends[2]);
    give_scalar(bench, "gear.roll_tip", tip);
    give_scalar(bench, "gear.working_pressure_angle", 20 * pi / 180);
    give_scalar(bench, "gear.face_width", 0.02);
    give_scalar(bench, "operating.line_force", 3500);
}

/* The run's gear, or a plain one; outputs at the definition that e_l = e + F/k is written for. */
static bool open_secant(look *l, const ff_bench *bench)
{
    void *probe = bench->open(bench->ctx);
    bool run = probe && bench->array(bench->ctx, probe, "gear.roll_angle").data;
    bench->close(bench->ctx, probe);
    if (!run)
        play(bench);
    bench->set(bench->ctx, "definition", "secant");
    return look_open(l, bench, NULL);
}

/* k > 0 from phase 0 to 1; ends meet unless phase 0 is a breakpoint; the mean is the mean. */
static void periodic(const ff_bench *bench)
{
    look l;
    if (!open_secant(&l, bench))
        return;
    series phase = look_at(&l, "phase"), k = look_at(&l, "stiffness"),
           breaks = look_at(&l, "breakpoints");
    double mean = 0;
    size_t last = k.count - 1;
    bool good = phase.count >= 2 && k.count == phase.count, jump = false;
    if (!good)
        bench->untried(bench->ctx, NULL);
    for (size_t i = 0; i < k.count && good; i++) {
        if (i)
            mean += (phase.data[i] - phase.data[i - 1]) * (k.data[i] + k.data[i - 1]) / 2;
        good = k.data[i] > 0 && (i == 0 || phase.data[i] >= phase.data[i - 1]);
        if (!good)
            ff_faultf(bench, "stiffness is %g N/m at phase %g; it must be positive and phases rise",
                      k.data[i], phase.data[i]);
    }
    for (size_t i = 0; i < breaks.count; i++)
        jump = jump || fabs(breaks.data[i]) < 1e-9;
    good = good && look_near(&l, "the first phase", 0, phase.data[0], 0, 1, 1e-9) &&
           look_near(&l, "the last phase", last, phase.data[last], 1, 1, 1e-9);
    if (good && !jump)
        good = look_near(&l, "stiffness, no breakpoint at phase 0,", last, k.data[last], k.data[0],
                         k.data[0], 1e-6);
    if (good)
        look_near(&l, "stiffness_mean", 0, look_scalar(&l, "stiffness_mean"), mean, mean, 1e-3);
    look_close(&l);
}

/* Linear between stations; *beside: the jump at a station twice is near. */
static double at_roll(series roll, series force, double angle, bool *beside)
{
    if (angle < roll.data[0] || angle > roll.data[roll.count - 1])
        return 0;
    size_t i = 1;
    while (i + 1 < roll.count && roll.data[i] < angle)
        i++;
    double step = roll.data[i] - roll.data[i - 1];
    for (size_t k = i > 2 ? i - 2 : 1; k < roll.count && k < i + 3; k++)
        *beside = *beside || roll.data[k] == roll.data[k - 1];
    *beside = *beside || i <= 2 || i + 3 >= roll.count;
    if (step <= 0)
        return force.data[i];
    double share = (angle - roll.data[i - 1]) / step;
    return (1 - share) * force.data[i - 1] + share * force.data[i];
}

/* At every phase the forces of the pairs in contact add up to the load; tooth_force = load_share
   times the load; e_l = e + F/k. Where a pair comes or goes, interpolation says nothing. */
static void balance(const ff_bench *bench)
{
    enum { PHASES = 97 };
    look l;
    if (!open_secant(&l, bench))
        return;
    series roll = look_at(&l, "gear.roll_angle"), teeth = look_at(&l, "gear.teeth"),
           force = look_at(&l, "tooth_force"), share = look_at(&l, "load_share"),
           phase = look_at(&l, "phase"), k = look_at(&l, "stiffness"),
           e = look_at(&l, "transmission_error"), loaded = look_at(&l, "loaded_transmission_error");
    double load = look_scalar(&l, "operating.line_force");
    bool good = roll.count > 8 && force.count == roll.count && teeth.count == 2 && load > 0;
    if (!good)
        bench->untried(bench->ctx, "it needs a gear and a load; --pipeline FILE gives them");
    for (size_t i = 0; i < share.count && good; i++)
        good = look_near(&l, "tooth_force", i, force.data[i], share.data[i] * load, load, 1e-6);
    for (size_t i = 0; i < e.count && loaded.count == e.count && good; i++)
        good = look_near(&l, "loaded_transmission_error", i, loaded.data[i],
                         e.data[i] + load / k.data[i], load / k.data[i], 1e-6);
    for (int i = 0; i < PHASES && good; i++) {
        double cycle = 2 * pi / teeth.data[0], at = (i + 0.5) / PHASES, sum = 0;
        bool beside = false;
        for (double angle = roll.data[0] + at * cycle; angle <= roll.data[roll.count - 1];
             angle += cycle)
            sum += at_roll(roll, force, angle, &beside);
        if (!beside && !(fabs(sum - load) <= 5e-3 * load)) {
            ff_faultf(bench,
                      "the tooth forces add up to %.6g N at phase %g, where the load is %.6g N",
                      sum, at, load);
            good = false;
        }
    }
    (void)phase;
    look_close(&l);
}

static const ff_check checks[] = {
    {"periodic", "stiffness is positive and periodic, with the mean it states", periodic},
    {"balance", "the tooth forces sum to the load", balance},
};

static const ff_conformance asks = {.size = sizeof asks, .checks = FF_TABLE(checks)};

static const void *service(void *self, uint32_t output)
{
    (void)self, (void)output;
    return &asks;
}

static const ff_model model = {
    .size = sizeof model,
    .abi_major = FF_ABI_MAJOR,
    .id = "conformance/stiffness",
    .version = "1.0.0",
    .summary = "what a mesh stiffness keeps: positive, periodic, in balance with the load",
    .reference = "",
    .bibtex = "",
    .licence = "GPL-3.0-or-later",
    .outputs = FF_TABLE(offer_outputs),
    .create = offer_create,
    .service = service,
};

FF_EXPORT const ff_model *flankfilm_model_v1(void)
{
    return &model;
}
