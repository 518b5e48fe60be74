/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Losses of all pairs in mesh against closed forms. */
#include "engagement.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static engagement e;

static void run(stage *s)
{
    check_true("runs", stage_run(s) == FF_OK);
}

/* |sliding| is linear on both sides of the pitch point: half its greatest value on average. */
static void test_mean_loss(double contact_ratio)
{
    engagement_fill(&e, contact_ratio);
    stage *s = engagement_open(&e);
    run(s);
    double mean = engagement_sliding(&e) / 2 * e.friction * e.load * e.face_width * contact_ratio;
    check_near("mean loss", stage_scalar(s, "power_loss_mean"), mean, 1e-9);
    check_near("input", stage_scalar(s, "power_input"), 250 * 150, 1e-12);
    check_near("efficiency", stage_scalar(s, "efficiency"), 1 - mean / (250 * 150), 1e-12);
    check_near("friction", stage_scalar(s, "friction_coefficient_mean"), e.friction, 1e-9);
    check_below("cycle", stage_quality(s, "cycle_error"), 1e-3);
    check_below("engagement", stage_quality(s, "engagement"), 1e-9);
    check_below("force times sliding", stage_quality(s, "friction_power_error"), 1e-12);
    check_true("trusted", stage_verdict(s) == FF_GOOD);
    stage_close(s);
}

/* The loss of the mesh at a phase, the first or the second of two equal ones. */
static double loss_at(const stage *s, double phase, int second)
{
    size_t n;
    const double *at = stage_get(s, "phase", &n), *loss = stage_get(s, "mesh_power_loss", NULL);
    for (size_t i = 0; i < n; i++)
        if (fabs(at[i] - phase) < 1e-9)
            return loss[i + (second ? 1 : 0)];
    check_true("the phase is there", 0);
    return 0;
}

static void test_pairs_in_mesh_add_up(void)
{
    engagement_fill(&e, 1.61);
    stage *s = engagement_open(&e);
    run(s);
    double two = engagement_loss(&e, 0.3) + engagement_loss(&e, 1.3);
    check_near("two pairs", loss_at(s, 0.3, 0), two, 1e-3);
    check_near("one pair", loss_at(s, 0.75, 0), engagement_loss(&e, 0.75), 1e-3);
    two = engagement_loss(&e, 0.61) + engagement_loss(&e, 1.61);
    check_near("before one leaves", loss_at(s, 0.61, 0), two, 1e-3);
    check_near("after", loss_at(s, 0.61, 1), engagement_loss(&e, 0.61), 1e-3);
    two = engagement_loss(&e, 0) + engagement_loss(&e, 1);
    check_near("one enters", loss_at(s, 0, 0), two, 1e-3);
    check_near("before one enters", loss_at(s, 1, 0), engagement_loss(&e, 1), 1e-3);
    stage_close(s);
}

static void test_points_on_the_leaving_phase(void)
{
    engagement_fill(&e, 1.6);
    stage *s = engagement_open(&e);
    stage_set(s, "points", 5);
    run(s);
    size_t n;
    const double *phase = stage_get(s, "phase", &n);
    int falls = 0, twice = 0;
    for (size_t i = 1; i < n; i++) {
        falls += phase[i] < phase[i - 1];
        twice += !(phase[i] > phase[i - 1]);
    }
    check_true("phases do not fall", falls == 0);
    check_true("one is there twice", twice == 1);
    check_near("from 0", phase[0], 0, 0);
    check_near("to 1", phase[n - 1], 1, 0);
    stage_close(s);
}

static void test_whole_contact_ratio(void)
{
    engagement_fill(&e, 2);
    stage *s = engagement_open(&e);
    run(s);
    check_near("enters as one leaves", loss_at(s, 0, 0),
               engagement_loss(&e, 0) + engagement_loss(&e, 1), 1e-3);
    check_near("before", loss_at(s, 1, 0), engagement_loss(&e, 1) + engagement_loss(&e, 2), 1e-3);
    stage_close(s);
}

/* Ohlendorf 1958: with half the force on each of two pairs the loss is friction times
   pi (2/z) (1 - eps + eps^2/2) of the power, for equal gears. */
static void test_loss_factor(void)
{
    const double eps = 1.6;
    engagement_fill(&e, eps);
    for (int i = 0; i < INSTANTS; i++) {
        double pitches = eps * i / (INSTANTS - 1.0);
        double share = pitches > eps - 1 && pitches < 1 ? 1 : 0.5;
        e.traction[i] *= share;
        e.power[i] *= share;
    }
    e.torque = e.load * e.face_width * e.base_radius;
    stage *s = engagement_open(&e);
    run(s);
    double factor = M_PI * 2 / TEETH * (1 - eps + eps * eps / 2);
    check_near("loss factor", 1 - stage_scalar(s, "efficiency"), e.friction * factor, 1e-3);
    stage_close(s);
}

static void test_other_engagements_are_doubted(void)
{
    engagement_fill(&e, 1.6);
    stage *s = engagement_open(&e);
    stage_give_scalar(s, "gear.contact_ratio", 1.75);
    run(s);
    check_true("not of this gear", stage_verdict(s) == FF_DOUBTFUL);
    stage_close(s);
    for (int i = 0; i < INSTANTS; i++)
        e.power[i] *= 2;
    s = engagement_open(&e);
    run(s);
    check_near("not of this friction", stage_quality(s, "friction_power_error"), 0.5, 1e-9);
    check_true("doubted", stage_verdict(s) == FF_DOUBTFUL);
    stage_close(s);
}

static void refuse(stage *s, const char *item)
{
    ff_status status = stage_run(s);
    printf("%s: %s\n", stage_why_item(s), stage_why(s));
    check_true(item, status == FF_INVALID && !strcmp(stage_why_item(s), item));
    stage_close(s);
}

static void test_refusals(void)
{
    engagement_fill(&e, 1.6);
    stage *s = engagement_open(&e);
    stage_give_series(s, "ehl.roll_angle", 1, e.roll);
    refuse(s, "ehl.sliding_loss");
    s = engagement_open(&e);
    stage_give_scalar(s, "operating.torque", 0);
    refuse(s, "operating.torque");
    s = engagement_open(&e);
    stage_give_scalar(s, "gear.face_width", NAN);
    refuse(s, "gear.face_width");
    s = engagement_open(&e);
    e.roll[7] = e.roll[9];
    refuse(s, "ehl.roll_angle");
}

int main(void)
{
    test_mean_loss(1.6);
    test_mean_loss(2.3);
    test_pairs_in_mesh_add_up();
    test_points_on_the_leaving_phase();
    test_whole_contact_ratio();
    test_loss_factor();
    test_other_engagements_are_doubted();
    test_refusals();
    return check_done();
}
