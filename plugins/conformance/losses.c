/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Draft. Checks of the losses of a mesh: energy. */
#include "evaluation.h"
#include "offer.h"

#include <math.h>

static const double pi = 3.14159265358979323846;

/* The input power is either lost or transmitted. The mean loss is the energy that one pair loses,
   int P b d(roll)/omega with the loss per width P and the face width b, over the time of one pitch,
   2 pi/(z omega). */
static void energy(const ff_fixture *fixture)
{
    enum { POINTS = 65 };
    conformance_evaluation run;
    if (!fixture->from_run) {
        const double teeth[] = {25, 40};
        double roll[POINTS], loss[POINTS];
        for (int i = 0; i < POINTS; i++) {
            double at = (double)i / (POINTS - 1);
            roll[i] = 0.2 + at * 1.6 * 2 * pi / teeth[0];
            loss[i] = 2000 * fabs(2 * at - 1); /* W/m: 0 at the pitch point */
        }
        conformance_give_series(fixture, "ehl.roll_angle", POINTS, roll);
        conformance_give_series(fixture, "ehl.power_loss", POINTS, loss);
        conformance_give_series(fixture, "gear.teeth", 2, teeth);
        conformance_give_scalar(fixture, "gear.face_width", 0.018);
        conformance_give_scalar(fixture, "operating.torque", 80);
        conformance_give_scalar(fixture, "operating.speed", 150);
    }
    if (!conformance_evaluate(&run, fixture, NULL))
        return;
    conformance_array roll = conformance_array_of(&run, "ehl.roll_angle"),
                      loss = conformance_array_of(&run, "ehl.power_loss"),
                      teeth = conformance_array_of(&run, "gear.teeth"),
                      pairs = conformance_array_of(&run, "engagements_judged");
    double width = conformance_scalar_of(&run, "gear.face_width"),
           mean = conformance_scalar_of(&run, "power_loss_mean"),
           power = conformance_scalar_of(&run, "operating.torque") *
                   conformance_scalar_of(&run, "operating.speed"),
           sum = 0;
    bool good = conformance_near(&run, "power_input", 0, conformance_scalar_of(&run, "power_input"),
                                 power, power, 1e-9) &&
                conformance_near(&run, "efficiency", 0, conformance_scalar_of(&run, "efficiency"),
                                 1 - mean / power, 1, 1e-9);
    if (good && roll.count > 8 && loss.count == roll.count && teeth.count == 2 &&
        !(pairs.count == 1 && pairs.data[0] > 1)) {
        for (size_t i = 1; i < roll.count; i++)
            sum += (roll.data[i] - roll.data[i - 1]) * (loss.data[i] + loss.data[i - 1]) / 2;
        conformance_near(&run, "power_loss_mean", 0, mean, sum * width * teeth.data[0] / (2 * pi),
                         mean, 0.02);
    }
    conformance_close(&run);
}

static const ff_check checks[] = {
    {"energy", "input power is lost or transmitted; the loss is that of all pairs in mesh", energy},
};

const ff_conformance conformance_offer = {.size = sizeof conformance_offer,
                                          .checks = FF_TABLE(checks)};

CONFORMANCE_MODEL("losses", "checks of the losses of a mesh: energy", "");
