/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Checks of a mesh stiffness: positive, periodic, in balance with the load. */
#include "evaluation.h"
#include "offer.h"

#include <math.h>

static const double pi = 3.14159265358979323846;

/* A pair of 50 teeth each, module 3 mm, 20 deg, standard proportions. */
static void give_gear(const ff_fixture *fixture)
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
    conformance_give_series(fixture, "gear.roll_angle", STATIONS, roll);
    conformance_give_series(fixture, "gear.teeth", 2, teeth);
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        conformance_give_series(fixture, rows[i].name, 2,
                                (const double[]){rows[i].value, rows[i].value});
    conformance_give_scalar(fixture, "gear.roll_sap", sap);
    conformance_give_scalar(fixture, "gear.roll_lpstc", ends[1]);
    conformance_give_scalar(fixture, "gear.roll_hpstc", ends[2]);
    conformance_give_scalar(fixture, "gear.roll_tip", tip);
    conformance_give_scalar(fixture, "gear.working_pressure_angle", 20 * pi / 180);
    conformance_give_scalar(fixture, "gear.face_width", 0.02);
    conformance_give_scalar(fixture, "operating.line_force", 3500);
}

/* Evaluates the stiffness for the gear of the user's file, or for a standard gear, and with the
   secant definition, for which e_l = e + F/k holds. */
static bool open_secant(conformance_evaluation *e, const ff_fixture *fixture)
{
    void *probe = fixture->open(fixture->ctx);
    bool run = probe && fixture->array(fixture->ctx, probe, "gear.roll_angle").data;
    fixture->close(fixture->ctx, probe);
    if (!run)
        give_gear(fixture);
    fixture->set(fixture->ctx, "definition", "secant");
    return conformance_evaluate(e, fixture, NULL);
}

/* Checks that k > 0 from phase 0 to 1, that its values at both ends are equal unless phase 0 is a
   breakpoint, and that the mean output is the mean of the series. */
static void periodic(const ff_fixture *fixture)
{
    conformance_evaluation run;
    if (!open_secant(&run, fixture))
        return;
    conformance_array phase = conformance_array_of(&run, "phase"),
                      k = conformance_array_of(&run, "stiffness"),
                      breaks = conformance_array_of(&run, "breakpoints");
    double mean = 0;
    size_t last = k.count - 1;
    bool good = phase.count >= 2 && k.count == phase.count, jump = false;
    if (!good)
        fixture->skip(fixture->ctx, NULL);
    for (size_t i = 0; i < k.count && good; i++) {
        if (i)
            mean += (phase.data[i] - phase.data[i - 1]) * (k.data[i] + k.data[i - 1]) / 2;
        good = k.data[i] > 0 && (i == 0 || phase.data[i] >= phase.data[i - 1]);
        if (!good)
            ff_check_failf(fixture,
                           "stiffness is %g N/m at phase %g; it must be positive, and phases must "
                           "increase",
                           k.data[i], phase.data[i]);
    }
    for (size_t i = 0; i < breaks.count; i++)
        jump = jump || fabs(breaks.data[i]) < 1e-9;
    good = good &&
           conformance_near(&run, "the first phase of the series", 0, phase.data[0], 0, 1, 1e-9) &&
           conformance_near(&run, "the last phase", last, phase.data[last], 1, 1, 1e-9);
    if (good && !jump)
        good = conformance_near(&run, "stiffness without a breakpoint at phase 0", last,
                                k.data[last], k.data[0], k.data[0], 1e-6);
    if (good)
        conformance_near(&run, "stiffness_mean", 0, conformance_scalar_of(&run, "stiffness_mean"),
                         mean, mean, 1e-3);
    conformance_close(&run);
}

/* Interpolates the force linearly at a roll angle. Sets *beside if the angle is near the ends of
   the path or near a jump, where a station is repeated. */
static double at_roll(conformance_array roll, conformance_array force, double angle, bool *beside)
{
    size_t i = 1;
    while (i + 1 < roll.count && roll.data[i] < angle)
        i++;
    for (size_t k = i > 2 ? i - 2 : 1; k < roll.count && k < i + 3; k++)
        *beside = *beside || roll.data[k] == roll.data[k - 1];
    *beside = *beside || i <= 2 || i + 3 >= roll.count;
    return conformance_at(roll, force, angle);
}

/* Checks at every phase that the forces of the pairs in contact sum to the load, that tooth_force
   is load_share times the load, and that e_l = e + F/k. Phases near which a pair enters or leaves
   are skipped, since interpolation fails there. */
static void balance(const ff_fixture *fixture)
{
    enum { PHASES = 97 };
    conformance_evaluation run;
    if (!open_secant(&run, fixture))
        return;
    conformance_array roll = conformance_array_of(&run, "gear.roll_angle"),
                      teeth = conformance_array_of(&run, "gear.teeth"),
                      force = conformance_array_of(&run, "tooth_force"),
                      share = conformance_array_of(&run, "load_share"),
                      k = conformance_array_of(&run, "stiffness"),
                      e = conformance_array_of(&run, "transmission_error"),
                      loaded = conformance_array_of(&run, "loaded_transmission_error");
    double load = conformance_scalar_of(&run, "operating.line_force");
    bool good = roll.count > 8 && force.count == roll.count && teeth.count == 2 && load > 0;
    if (!good)
        fixture->skip(fixture->ctx, "it needs a gear and a load; --pipeline FILE gives them");
    for (size_t i = 0; i < share.count && good; i++)
        good = conformance_near(&run, "tooth_force", i, force.data[i], share.data[i] * load, load,
                                1e-6);
    for (size_t i = 0; i < e.count && loaded.count == e.count && good; i++)
        good = conformance_near(&run, "loaded_transmission_error", i, loaded.data[i],
                                e.data[i] + load / k.data[i], load / k.data[i], 1e-6);
    for (int i = 0; i < PHASES && good; i++) {
        double cycle = 2 * pi / teeth.data[0], at = (i + 0.5) / PHASES, sum = 0;
        bool beside = false;
        for (double angle = roll.data[0] + at * cycle; angle <= roll.data[roll.count - 1];
             angle += cycle)
            sum += at_roll(roll, force, angle, &beside);
        if (!beside && !(fabs(sum - load) <= 5e-3 * load)) {
            ff_check_failf(fixture,
                           "the tooth forces sum to %.6g N at phase %g, but the load is %.6g N",
                           sum, at, load);
            good = false;
        }
    }
    conformance_close(&run);
}

/* The stiffness of a pair does not change when another pair enters or leaves. Therefore mesh
   stiffness times the load share of the pair is the same on both sides of this phase, except for
   the Hertzian contact, whose load changes. Thus the share must fall where the mesh stiffness
   rises. The load, a gradual engagement and flank deviations change the product by less than a
   factor of 1.75. The phases with one and with two pairs follow from the contact ratio. */
static void pairs(const ff_fixture *fixture)
{
    conformance_evaluation run;
    if (!open_secant(&run, fixture))
        return;
    conformance_array roll = conformance_array_of(&run, "gear.roll_angle"),
                      teeth = conformance_array_of(&run, "gear.teeth"),
                      share = conformance_array_of(&run, "load_share"),
                      phase = conformance_array_of(&run, "phase"),
                      k = conformance_array_of(&run, "stiffness");
    double width = conformance_scalar_of(&run, "gear.face_width");
    bool good = roll.count > 8 && share.count == roll.count && teeth.count == 2 &&
                phase.count > 8 && k.count == phase.count;
    if (!good)
        fixture->skip(fixture->ctx, NULL);
    double cycle = good ? 2 * pi / teeth.data[0] : 1,
           ratio = good ? (roll.data[roll.count - 1] - roll.data[0]) / cycle : 0;
    /* c_gamma of steel gears is 10 to 30 N/(mm um) (ISO 6336-1) */
    for (size_t i = 0; i < k.count && good && width > 0; i++)
        if (!(k.data[i] > 3e9 * width && k.data[i] < 60e9 * width)) {
            ff_check_failf(
                fixture,
                "stiffness is %.4g N/m at phase %g for a face width of %g m, that is %.3g N/(mm "
                "um); steel teeth have 10 to 30",
                k.data[i], phase.data[i], width, 1e-9 * k.data[i] / width);
            good = false;
        }
    double one = (fmod(ratio, 1) + 1) / 2, two = fmod(ratio, 1) / 2, stiff[2] = {0}, part[2] = {0};
    for (int i = -2; i <= 2; i++) { /* five phases in the middle of single and of double contact */
        double at[] = {one + 0.02 * i, two + 0.02 * i};
        for (int n = 0; n < 2 && good; n++) {
            stiff[n] += conformance_at(phase, k, at[n]) / 5;
            double first = 0;
            for (double a = roll.data[0] + at[n] * cycle; a <= roll.data[roll.count - 1];
                 a += cycle)
                first = fmax(first, conformance_at(roll, share, a));
            part[n] += first / 5;
        }
    }
    double apart = good ? fabs(log(stiff[0] * part[0] / (stiff[1] * part[1]))) : 0;
    if (good && ratio > 1.1 && ratio < 1.9 && !(apart < log(1.75)))
        ff_check_failf(fixture,
                       "stiffness times the larger load_share is %.4g N/m with one pair in "
                       "contact, at phase %.3g, but %.4g N/m with two pairs, at phase %.3g: the "
                       "stiffness of a pair must not depend on the other pair",
                       stiff[0] * part[0], one, stiff[1] * part[1], two);
    conformance_close(&run);
}

static const ff_check checks[] = {
    {"periodic", "stiffness is positive and periodic, and stiffness_mean is its mean", periodic},
    {"balance", "the tooth forces sum to the load", balance},
    {"pairs",
     "a pair has the stiffness of steel teeth, the same with one and with two pairs in contact",
     pairs},
};

const ff_conformance conformance_offer = {.size = sizeof conformance_offer,
                                          .checks = FF_TABLE(checks)};

CONFORMANCE_MODEL("stiffness",
                  "checks of a mesh stiffness: positive, periodic, in balance with the load", "");
