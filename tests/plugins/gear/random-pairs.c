/* SPDX-License-Identifier: GPL-3.0-or-later */
/* 10^4 random pairs that the model accepts: conditions that each must satisfy. */
#include <check.h>
#include <stage.h>

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { WANTED = 10000 };

static uint64_t state = 20110740;

/* xorshift64*, uniform in [low, high). */
static double uniform(double low, double high)
{
    state ^= state >> 12;
    state ^= state << 25;
    state ^= state >> 27;
    double unit = (double)((state * UINT64_C(2685821657736338717)) >> 11) / 9007199254740992.0;
    return low + (high - low) * unit;
}

typedef struct worst {
    double sum, base_pitch, ratio, sliding, order, fill;
    int twice, positive;
} worst;

static stage *draw(void)
{
    stage *gear = stage_open("gear/involute-spur");
    double z1 = floor(uniform(9, 120)), z2 = floor(uniform(9, 200)), m = exp(uniform(-9, -3));
    double x1 = uniform(-0.6, 0.9), x2 = uniform(-0.6, 0.9);
    stage_set_reals(gear, "teeth", 2, (double[]){z1, z2});
    stage_set_reals(gear, "profile_shift", 2, (double[]){x1, x2});
    stage_set(gear, "module", m);
    stage_set(gear, "face_width", m * uniform(1, 20));
    stage_set(gear, "pressure_angle", uniform(14.5, 30) * M_PI / 180);
    if (uniform(0, 1) < 0.3)
        stage_set(gear, "centre_distance", m * (z1 + z2) / 2 + m * (x1 + x2 + uniform(0, 0.2)));
    if (uniform(0, 1) < 0.5)
        stage_set(gear, "backlash", m * uniform(0, 0.1));
    if (uniform(0, 1) < 0.3)
        stage_set_reals(
            gear, "tip_diameter", 2,
            (double[]){m * (z1 + 2 * x1 + uniform(1, 2.5)), m * (z2 + 2 * x2 + uniform(1, 2.5))});
    stage_set(gear, "stations", floor(uniform(8, 400)));
    return gear;
}

static void inspect(const stage *gear, worst *w)
{
    size_t n;
    const double *roll = stage_get(gear, "roll_angle", &n);
    const double *r1 = stage_get(gear, "radius_1", NULL), *r2 = stage_get(gear, "radius_2", NULL);
    const double *rb = stage_get(gear, "base_radius", NULL);
    const double *z = stage_get(gear, "teeth", NULL);
    double pb = stage_scalar(gear, "base_pitch"), path = stage_scalar(gear, "path_length");
    double pitch = stage_scalar(gear, "roll_pitch"), ratio = stage_scalar(gear, "contact_ratio");
    double sap = stage_scalar(gear, "roll_sap"), tip = stage_scalar(gear, "roll_tip");
    int repeated = 0;
    for (size_t i = 0; i < n; i++) {
        w->sum = fmax(w->sum, fabs((r1[i] + r2[i]) / (r1[0] + r2[0]) - 1));
        w->positive = w->positive && r1[i] > 0 && r2[i] > 0;
        if (i > 0)
            w->order = fmax(w->order, roll[i - 1] - roll[i]);
        repeated += i > 0 && roll[i] == roll[i - 1];
        if (roll[i] == pitch) /* u1 = omega1 R1 and u2 = omega1 R2 z1/z2 are equal here */
            w->sliding = fmax(w->sliding, fabs(r2[i] * z[0] / (z[1] * r1[i]) - 1));
    }
    w->twice = w->twice && repeated == 2 * (int)floor(ratio);
    w->base_pitch = fmax(w->base_pitch, fabs(2 * M_PI * rb[0] / z[0] / pb - 1));
    w->base_pitch = fmax(w->base_pitch, fabs(2 * M_PI * rb[1] / z[1] / pb - 1));
    w->ratio = fmax(w->ratio, fabs((tip - sap) * rb[0] / (ratio * pb) - 1));
    w->ratio = fmax(w->ratio, fabs((r1[n - 1] - r1[0]) / path - 1));
    w->fill = fmax(w->fill, stage_quality(gear, "pitch_error"));
}

int main(void)
{
    int accepted = 0, refused = 0, wordless = 0;
    worst w = {.twice = 1, .positive = 1};
    while (accepted < WANTED && refused < 100 * WANTED) {
        stage *gear = draw();
        ff_status status = stage_run(gear); /* ends the program when an output is not finite */
        if (status == FF_OK) {
            accepted++;
            inspect(gear, &w);
        } else {
            refused++;
            wordless += strlen(stage_why(gear)) < 30 || !*stage_why_item(gear);
        }
        stage_close(gear);
    }
    printf("%d accepted, %d refused\n", accepted, refused);
    check_true("enough pairs are accepted", accepted == WANTED);
    check_below("refusals without a reason", wordless, 0);
    check_below("R1 + R2 is constant on the path", w.sum, 1e-13);
    check_below("base pitch is that of both gears", w.base_pitch, 1e-14);
    check_below("contact ratio is path over base pitch", w.ratio, 1e-11);
    check_below("no sliding at the pitch point", w.sliding, 1e-12);
    check_below("stations never go back", w.order, 0);
    check_below("thicknesses and backlash fill the pitch", w.fill, 1e-9);
    check_true("stations where a pair comes or goes stand twice", w.twice);
    check_true("radii of curvature are above 0", w.positive);
    return check_done();
}
