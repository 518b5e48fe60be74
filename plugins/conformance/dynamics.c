/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Checks of the motion of a gear pair: periodicity, momentum and energy, and exact cases. */
#include "evaluation.h"
#include "offer.h"

#include <math.h>

enum { PHASES = 65, STATIONS = 60 };
static const double backlash = 1e-4; /* m, of the test pair */

static const double pi = 3.14159265358979323846;

/* A pair of 50 teeth each, module 3 mm, 20 deg, with constant stiffness. */
typedef struct test_pair {
    double stiffness, mass, load, frequency; /* mesh frequency, Hz */
    double error;                            /* amplitude of e = error cos(2 pi phase) */
} test_pair;

static const test_pair plain = {.stiffness = 4e8, .mass = 1, .load = 3000, .frequency = 1000};

/* Returns the roll angle of a station. Their spacing implies double contact from SAP over 3/4 of a
   cycle, and over another 3/4 of a cycle up to the tip. */
static double roll_of(int station)
{
    const int part = station / (STATIONS / 3);
    const double at = station % (STATIONS / 3) / (STATIONS / 3 - 1.0);
    return 0.254 + 2 * pi / 50 *
                       (part == 0   ? 0.75 * at
                        : part == 1 ? 0.75 + 0.25 * at
                                    : 1 + 0.75 * at);
}

static void give_pair(const ff_fixture *fixture, const test_pair *s)
{
    double phase[PHASES], k[PHASES], e[PHASES], loaded[PHASES], roll[STATIONS], force[STATIONS],
        share[STATIONS];
    const double teeth[] = {50, 50}, masses[] = {2, 2}, radius[] = {0.0704769, 0.0704769};
    const double inertia = 2 * s->mass * radius[0] * radius[0]; /* of each gear */
    for (int i = 0; i < PHASES; i++) {
        phase[i] = (double)i / (PHASES - 1);
        k[i] = s->stiffness;
        e[i] = s->error * cos(2 * pi * phase[i]);
        loaded[i] = e[i] + s->load / k[i];
    }
    for (int i = 0; i < STATIONS; i++) {
        roll[i] = roll_of(i);
        share[i] = i / (STATIONS / 3) == 1 ? 1 : 0.5;
        force[i] = share[i] * s->load;
    }
    fixture->give(fixture->ctx, NULL, 0, NULL, NULL);
    conformance_give_scalar(fixture, "gear.backlash", backlash);
    conformance_give_scalar(fixture, "gear.equivalent_mass", s->mass);
    conformance_give_series(fixture, "gear.base_radius", 2, radius);
    conformance_give_scalar(fixture, "gear.centre_distance", 0.15);
    conformance_give_series(fixture, "gear.mass", 2, masses);
    conformance_give_series(fixture, "gear.inertia", 2, (const double[]){inertia, inertia});
    conformance_give_series(fixture, "gear.roll_angle", STATIONS, roll);
    conformance_give_scalar(fixture, "gear.roll_sap", roll[0]);
    conformance_give_series(fixture, "gear.teeth", 2, teeth);
    conformance_give_scalar(fixture, "operating.line_force", s->load);
    conformance_give_scalar(fixture, "operating.mesh_frequency", s->frequency);
    conformance_give_series(fixture, "stiffness.phase", PHASES, phase);
    conformance_give_series(fixture, "stiffness.stiffness", PHASES, k);
    conformance_give_scalar(fixture, "stiffness.stiffness_mean", s->stiffness);
    conformance_give_series(fixture, "stiffness.transmission_error", PHASES, e);
    conformance_give_series(fixture, "stiffness.loaded_transmission_error", PHASES, loaded);
    conformance_give_series(fixture, "stiffness.tooth_force", STATIONS, force);
    conformance_give_series(fixture, "stiffness.load_share", STATIONS, share);
    /* the mass of the test pair, even if the user's file has another one */
    fixture->set(fixture->ctx, "equivalent_mass", "1 kg");
}

static const char wanted[] =
    "phase dte dte_velocity mesh_force dte_rms dte_mean dte_peak_to_peak "
    "period natural_frequency multipliers tooth_force dynamic_factor_tooth";

/* Returns whether rotation is the only degree of freedom; the motion then has two multipliers. With
   other degrees of freedom the pair has other equilibrium positions. */
static bool rotates_only(const conformance_evaluation *e)
{
    size_t numbers = conformance_array_of(e, "multipliers").count;
    return numbers == 0 || numbers == 4;
}

/* With constant stiffness and no error, the pair rests at s = F/k and its force is F. */
static void rest(const ff_fixture *fixture)
{
    conformance_evaluation run;
    give_pair(fixture, &plain);
    if (!conformance_evaluate(&run, fixture, wanted))
        return;
    conformance_array force = conformance_array_of(&run, "mesh_force"),
                      tooth = conformance_array_of(&run, "tooth_force"),
                      given = conformance_array_of(&run, "stiffness.tooth_force");
    double play_half = backlash / 2, deflection = plain.load / plain.stiffness;
    bool good = rotates_only(&run);
    if (!good)
        fixture->skip(fixture->ctx, NULL);
    good = good &&
           conformance_near(&run, "dte_peak_to_peak", 0,
                            conformance_scalar_of(&run, "dte_peak_to_peak"), 0, deflection, 1e-4);
    double mean = conformance_scalar_of(&run, "dte_mean");
    /* s is measured from the middle of the backlash, or from contact if there is no backlash */
    if (good && fabs(mean - deflection) > 1e-4 * deflection)
        good =
            conformance_near(&run, "dte_mean", 0, mean, deflection + play_half, deflection, 1e-4);
    for (size_t i = 0; i < force.count && good; i++)
        good = conformance_near(&run, "mesh_force", i, force.data[i], plain.load, plain.load, 1e-4);
    for (size_t i = 0; i < tooth.count && tooth.count == given.count && good; i++)
        good = conformance_near(&run, "tooth_force", i, tooth.data[i], given.data[i], plain.load,
                                1e-4);
    conformance_close(&run);
}

/* The first harmonic of a series over its period, 2 int y exp(-2 pi i phase) dphase. */
typedef struct harmonic {
    double cosine, sine;
} harmonic;

static harmonic first_harmonic(conformance_array phase, conformance_array y, double period)
{
    harmonic h = {0, 0};
    for (size_t i = 1; i < y.count; i++) {
        double step = (phase.data[i] - phase.data[i - 1]) / period;
        for (size_t k = i - 1; k <= i; k++) {
            h.cosine += step * y.data[k] * cos(2 * pi * phase.data[k]);
            h.sine += step * y.data[k] * sin(2 * pi * phase.data[k]);
        }
    }
    return h;
}

static const double damping = 0.05, ratio = 0.7; /* of a linear pair: zeta, and f over f_n */

/* Evaluates a linear pair with constant stiffness, excited by e = E cos(2 pi phase). If the model
   has no inertia, has other degrees of freedom or lacks the parameters, reports this and returns
   false. */
static bool open_linear(conformance_evaluation *run, const ff_fixture *fixture, test_pair *s)
{
    *s = plain;
    s->frequency = ratio * sqrt(s->stiffness / s->mass) / (2 * pi);
    s->error = 0.05 * s->load / s->stiffness;
    give_pair(fixture, s);
    if (!fixture->set(fixture->ctx, "damping_ratio", "0.05") ||
        !conformance_offers(fixture, "dte_velocity")) {
        fixture->skip(fixture->ctx, NULL);
        return false;
    }
    if (!conformance_evaluate(run, fixture, wanted))
        return false;
    if (rotates_only(run))
        return true;
    fixture->skip(fixture->ctx, NULL);
    conformance_close(run);
    return false;
}

/* The first harmonics of mesh force F, transmission error S and excitation E obey F = (k + i w c)(S
   - E) and F = m w^2 S, with w c = 2 zeta r k and m w^2 = r^2 k. The first equation checks the
   mesh, the second the mass. |S| = E sqrt(1 + d^2)/sqrt((1 - r^2)^2 + d^2), d = 2 zeta r. e is
   linear between 64 phases, so its harmonic is sinc^2(1/64) times that of the cosine. */
static void linear(const ff_fixture *fixture)
{
    test_pair s;
    conformance_evaluation run;
    if (!open_linear(&run, fixture, &s))
        return;
    conformance_array phase = conformance_array_of(&run, "phase");
    double natural = sqrt(s.stiffness / s.mass) / (2 * pi), d = 2 * damping * ratio,
           amplitude = s.error * sqrt((1 + d * d) / (pow(1 - ratio * ratio, 2) + d * d)),
           period = conformance_scalar_of(&run, "period"), x = pi / (PHASES - 1);
    bool good = conformance_near(&run, "natural_frequency", 0,
                                 conformance_scalar_of(&run, "natural_frequency"), natural, natural,
                                 1e-6) &&
                conformance_near(&run, "dte_rms of a linear oscillator", 0,
                                 conformance_scalar_of(&run, "dte_rms"), amplitude / sqrt(2),
                                 amplitude, 2e-3);
    if (good && phase.count > 16 && fabs(period - 1) < 1e-9) {
        harmonic S = first_harmonic(phase, conformance_array_of(&run, "dte"), period),
                 F = first_harmonic(phase, conformance_array_of(&run, "mesh_force"), period),
                 W = {S.cosine - s.error * pow(sin(x) / x, 2), S.sine};
        double size = W.cosine * W.cosine + W.sine * W.sine, k = s.stiffness,
               elastic = (F.cosine * W.cosine + F.sine * W.sine) / size,
               viscous = (F.cosine * W.sine - F.sine * W.cosine) / size,
               inertia = (F.cosine * S.cosine + F.sine * S.sine) /
                         (S.cosine * S.cosine + S.sine * S.sine);
        /* -viscous: the harmonic is (cosine, sine) = (real part, -imaginary part) */
        if (conformance_near(&run, "mesh_force over the deflection, N/m,", 0, elastic, k, k,
                             0.02) &&
            conformance_near(&run, "the part of it in phase with the speed, 2 zeta r k,", 0,
                             viscous, d * k, d * k, 0.1))
            conformance_near(&run, "mesh_force over the motion, m w^2,", 0, inertia,
                             ratio * ratio * k, ratio * ratio * k, 0.02);
    }
    conformance_close(&run);
}

/* Checks that the tooth forces of the pairs in mesh sum to the mesh force, except near phases at
   which a pair enters or leaves. */
static void teeth(const ff_fixture *fixture)
{
    static const double phases[] = {0.1, 0.3, 0.5, 0.6, 0.85, 0.9};
    test_pair s = plain;
    double stations[STATIONS];
    conformance_evaluation run;
    s.frequency = ratio * sqrt(s.stiffness / s.mass) / (2 * pi);
    s.error = 0.4 * s.load / s.stiffness;
    give_pair(fixture, &s);
    fixture->set(fixture->ctx, "damping_ratio", "0.05");
    if (!conformance_evaluate(&run, fixture, wanted))
        return;
    for (int i = 0; i < STATIONS; i++)
        stations[i] = roll_of(i);
    /* a model without a gear input uses the stations of the stiffness */
    const conformance_array roll = {stations, STATIONS},
                            tooth = conformance_array_of(&run, "tooth_force"),
                            phase = conformance_array_of(&run, "phase"),
                            force = conformance_array_of(&run, "mesh_force");
    bool good = tooth.count == roll.count && force.count > 16 && force.count == phase.count &&
                rotates_only(&run) && fabs(conformance_scalar_of(&run, "period") - 1) < 1e-9;
    if (!good)
        fixture->skip(fixture->ctx, NULL);
    for (size_t i = 0; i < sizeof phases / sizeof *phases && good; i++) {
        double sum = 0, cycle = 2 * pi / 50;
        for (double at = roll.data[0] + phases[i] * cycle; at < roll.data[roll.count - 1];
             at += cycle)
            sum += conformance_at(roll, tooth, at);
        good = conformance_near(&run, "the sum of the tooth forces, at the phases 0.1 to 0.9,", i,
                                sum, conformance_at(phase, force, phases[i]), s.load, 0.01);
    }
    conformance_close(&run);
}

/* Opens the motion of the user's file, or that of a simple pair. */
static bool open_motion(conformance_evaluation *e, const ff_fixture *fixture)
{
    void *probe = fixture->open(fixture->ctx);
    bool run = probe && fixture->array(fixture->ctx, probe, "stiffness.phase").data;
    test_pair s = plain;
    s.error = 0.05 * s.load / s.stiffness;
    fixture->close(fixture->ctx, probe);
    if (!run)
        give_pair(fixture, &s);
    return conformance_evaluate(e, fixture, wanted);
}

/* Position and velocity must return after the given period; a decaying drift up to 1e-3 of the
   motion is allowed. Without inertia, the position may jump with the stiffness. */
static void periodicity(const ff_fixture *fixture)
{
    conformance_evaluation run;
    if (!conformance_offers(fixture, "dte_velocity")) {
        fixture->skip(fixture->ctx, NULL);
        return;
    }
    if (!open_motion(&run, fixture))
        return;
    conformance_array phase = conformance_array_of(&run, "phase"),
                      s = conformance_array_of(&run, "dte"),
                      v = conformance_array_of(&run, "dte_velocity");
    double period = conformance_scalar_of(&run, "period");
    size_t last = s.count - 1;
    bool good = s.count > 2 && phase.count == s.count && period > 0;
    if (!good) {
        fixture->skip(fixture->ctx, NULL);
    } else {
        double size = conformance_scalar_of(&run, "dte_peak_to_peak"), fastest = 0;
        for (size_t i = 0; i < v.count; i++)
            fastest = fmax(fastest, fabs(v.data[i]));
        size = fmax(size, 1e-9 * fabs(s.data[0]));
        if (conformance_near(&run, "phase", last, phase.data[last], phase.data[0] + period, 1,
                             1e-9) &&
            conformance_near(&run, "dte after a period", last, s.data[last], s.data[0], size,
                             1e-3) &&
            v.data)
            conformance_near(&run, "dte_velocity after a period", last, v.data[last], v.data[0],
                             fastest, 1e-3);
    }
    conformance_close(&run);
}

/* m s'' = F - F_mesh. Therefore, over a period the mean mesh force equals the load (momentum), and
   int (F_mesh - F) s' dt = 0: damping dissipates the work of stiffness and error (energy). */
static void energy(const ff_fixture *fixture)
{
    conformance_evaluation run;
    if (!conformance_offers(fixture, "dte_velocity")) {
        fixture->skip(fixture->ctx, NULL); /* the model has no inertia */
        return;
    }
    if (!open_motion(&run, fixture))
        return;
    conformance_array phase = conformance_array_of(&run, "phase"),
                      v = conformance_array_of(&run, "dte_velocity"),
                      f = conformance_array_of(&run, "mesh_force");
    double load = conformance_scalar_of(&run, "operating.line_force"), impulse = 0, work = 0,
           size = 0, sway = 0;
    bool good =
        v.count > 2 && f.count == v.count && conformance_scalar_of(&run, "period") > 0 && load > 0;
    if (!good)
        fixture->skip(fixture->ctx, NULL);
    for (size_t i = 1; i < v.count && good; i++) {
        double step = phase.data[i] - phase.data[i - 1], a = f.data[i - 1] - load,
               b = f.data[i] - load, va = v.data[i - 1], vb = v.data[i];
        impulse += step * (a + b) / 2;
        sway += step * (fabs(a) + fabs(b)) / 2;
        /* the exact integral of the product of two lines */
        work += step * (2 * a * va + a * vb + b * va + 2 * b * vb) / 6;
        size += step * (fabs(a * va) + fabs(b * vb)) / 2;
    }
    if (good &&
        conformance_near(&run, "mean mesh_force minus the load", 0, impulse, 0, sway + 1e-6 * load,
                         1e-2) &&
        sway > 1e-3 * load)
        conformance_near(&run, "work of mesh_force and load over a period", 0, work, 0, size, 2e-2);
    conformance_close(&run);
}

/* Checks that the scalars which summarise a series follow from the series. */
static void means(const ff_fixture *fixture)
{
    conformance_evaluation run;
    if (!open_motion(&run, fixture))
        return;
    conformance_array phase = conformance_array_of(&run, "phase"),
                      s = conformance_array_of(&run, "dte");
    bool good = s.count > 16 && phase.count == s.count && phase.data[s.count - 1] > phase.data[0];
    double mean = 0, square = 0, low = INFINITY, high = -INFINITY;
    if (!good)
        fixture->skip(fixture->ctx, NULL);
    for (size_t i = 1; i < s.count && good; i++)
        mean += (phase.data[i] - phase.data[i - 1]) * (s.data[i] + s.data[i - 1]) / 2 /
                (phase.data[s.count - 1] - phase.data[0]);
    for (size_t i = 0; i < s.count && good; i++) {
        low = fmin(low, s.data[i]);
        high = fmax(high, s.data[i]);
        double a = s.data[i] - mean, b = i ? s.data[i - 1] - mean : 0;
        square += i ? (phase.data[i] - phase.data[i - 1]) * (a * a + a * b + b * b) / 3 /
                          (phase.data[s.count - 1] - phase.data[0])
                    : 0;
    }
    double size = fmax(high - low, 1e-6 * fabs(mean));
    if (good &&
        conformance_near(&run, "dte_peak_to_peak", 0,
                         conformance_scalar_of(&run, "dte_peak_to_peak"), high - low, size, 0.02) &&
        conformance_near(&run, "dte_rms", 0, conformance_scalar_of(&run, "dte_rms"), sqrt(square),
                         size, 0.02))
        conformance_near(&run, "dte_mean", 0, conformance_scalar_of(&run, "dte_mean"), mean, size,
                         0.02);
    conformance_close(&run);
}

/* A large transmission error unloads the mesh, so the flanks separate. They must not pull while
   they cross the backlash; only a damper may pull, by up to 2 zeta r of the amplitude. */
static void parting(const ff_fixture *fixture)
{
    test_pair s = plain;
    conformance_evaluation run;
    s.frequency = ratio * sqrt(s.stiffness / s.mass) / (2 * pi);
    s.error = 1.5 * s.load / s.stiffness;
    give_pair(fixture, &s);
    fixture->set(fixture->ctx, "damping_ratio", "0.03");
    if (!conformance_offers(fixture, "dte_velocity")) {
        fixture->skip(fixture->ctx, NULL); /* the model has no inertia */
        return;
    }
    if (!conformance_evaluate(&run, fixture, wanted))
        return;
    conformance_array phase = conformance_array_of(&run, "phase"),
                      x = conformance_array_of(&run, "dte"),
                      force = conformance_array_of(&run, "mesh_force");
    double driving = INFINITY, pulling = -INFINITY, worst = 0;
    bool good = x.count > 16 && force.count == x.count && phase.count == x.count;
    if (!good)
        fixture->skip(fixture->ctx, NULL);
    for (size_t i = 0; i < x.count && good; i++) {
        double apart = x.data[i] - s.error * cos(2 * pi * phase.data[i]);
        if (force.data[i] > 0.25 * s.load)
            driving = fmin(driving, apart);
        if (force.data[i] < -0.25 * s.load)
            pulling = fmax(pulling, apart);
        worst = fmin(worst, force.data[i]);
    }
    if (good && pulling > driving - 0.9 * backlash)
        ff_check_failf(
            fixture,
            "mesh_force is %.4g N where the flanks are %.3g m away from driving contact, within "
            "the backlash of %g m: separated flanks pull; the load is %g N, and e = %.3g m cos(2 "
            "pi phase)",
            worst, driving - pulling, backlash, s.load, s.error);
    conformance_close(&run);
}

static const ff_check checks[] = {
    {"rest", "a pair of constant stiffness rests at F/k", rest},
    {"linear", "a linear pair responds as an oscillator of one degree of freedom", linear},
    {"teeth", "the tooth forces of the pairs in mesh sum to the mesh force", teeth},
    {"means", "mean, rms and range follow from the series", means},
    {"parting", "flanks separate, and do not pull within the backlash", parting},
    {"periodicity", "position and velocity return after the period", periodicity},
    {"energy", "the mean mesh force is the load, and its net work over a period is 0", energy},
};

const ff_conformance conformance_offer = {.size = sizeof conformance_offer,
                                          .checks = FF_TABLE(checks)};

CONFORMANCE_MODEL("dynamics",
                  "checks of the motion of a gear pair: periodicity, momentum, energy, exact cases",
                  "");
