/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Compares losses of all pairs in contact with closed forms. */
#include "check.h"
#include "engagement.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static engagement e;

static void run(stage *s)
{
    check_true("runs", stage_run(s) == FF_OK);
}

/* |sliding| is linear on both sides of the pitch point: its mean is half its largest value. */
static void test_mean_loss(double contact_ratio)
{
    engagement_fill(&e, contact_ratio);
    e.torque = e.load * e.face_width * e.base_radius * contact_ratio;
    stage *s = engagement_open(&e);
    run(s);
    double mean = engagement_sliding(&e) / 2 * e.friction * e.load * e.face_width * contact_ratio;
    check_near("mean loss", stage_scalar(s, "power_loss_mean"), mean, 1e-9);
    check_near("input", stage_scalar(s, "power_input"), e.torque * 150, 1e-12);
    check_near("efficiency", stage_scalar(s, "efficiency"), 1 - mean / (e.torque * 150), 1e-12);
    check_near("friction", stage_scalar(s, "friction_coefficient_mean"), e.friction, 1e-9);
    check_below("cycle", stage_quality(s, "cycle_error"), 1e-3);
    check_below("engagement", stage_quality(s, "engagement"), 1e-9);
    check_below("force times sliding", stage_quality(s, "friction_power_error"), 1e-12);
    /* loss_factor counts two pairs in mesh at most */
    check_true("trusted", stage_verdict(s) == (contact_ratio <= 2 ? FF_GOOD : FF_DOUBTFUL));
    stage_close(s);
}

/* Returns the loss of the mesh at a phase, from the first or second of two rows with this phase. */
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

/* Ohlendorf 1958: for equal gears and half the force on each of two pairs, the loss over the power
   is friction times pi (2/z) (1 - eps + eps^2/2), eps: contact ratio. */
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
    double factor = M_PI * (1. / TEETH + 1. / TEETH_2) * (1 - eps + eps * eps / 2);
    check_near("loss factor", 1 - stage_scalar(s, "efficiency"), e.friction * factor, 1e-3);
    stage_close(s);
}

enum { ROOM = 3 * INSTANTS };

/* Successive engagements, each with its own multiple of the friction. */
typedef struct train {
    size_t n;
    double roll[ROOM], power[ROOM], traction[ROOM], coefficient[ROOM], part[4][ROOM], number[ROOM];
} train;

static stage *train_open(train *t, size_t count, const double *factor)
{
    static const char *const parts[] = {"ehl.sliding_loss", "ehl.rolling_loss", "ehl.squeeze_loss",
                                        "ehl.asperity_loss"};
    static const double share[] = {0.5, 0.3, -0.05, 0.25};
    t->n = count * INSTANTS;
    for (size_t i = 0; i < t->n; i++) {
        size_t k = i % INSTANTS;
        double times = factor[i / INSTANTS];
        t->number[i] = (double)(4 * (i / INSTANTS)); /* sample of every fourth engagement */
        t->roll[i] = e.roll[k];
        t->power[i] = times * e.power[k];
        t->traction[i] = times * e.traction[k];
        t->coefficient[i] = times * e.coefficient[k];
        for (int p = 0; p < 4; p++)
            t->part[p][i] = share[p] * t->power[i];
    }
    stage *s = engagement_open(&e);
    stage_give_series(s, "ehl.roll_angle", t->n, t->roll);
    stage_give_series(s, "ehl.power_loss", t->n, t->power);
    stage_give_series(s, "ehl.traction", t->n, t->traction);
    stage_give_series(s, "ehl.friction_coefficient", t->n, t->coefficient);
    stage_give_series(s, "ehl.engagement", t->n, t->number);
    for (int p = 0; p < 4; p++)
        stage_give_series(s, parts[p], t->n, t->part[p]);
    return s;
}

/* With 1 and 3 times the friction alternately, all means must be twice those of one engagement. */
static void test_all_engagements_count(void)
{
    static train t;
    engagement_fill(&e, 1.61);
    stage *one = engagement_open(&e);
    run(one);
    double mean = stage_scalar(one, "power_loss_mean");
    for (int order = 0; order < 2; order++) {
        stage *s = train_open(&t, 2, (const double[][2]){{1, 3}, {3, 1}}[order]);
        run(s);
        check_near("mean", stage_scalar(s, "power_loss_mean"), 2 * mean, 1e-12);
        check_near("sliding", stage_scalar(s, "sliding_loss_mean"), mean, 1e-12);
        check_near("rolling", stage_scalar(s, "rolling_loss_mean"), 0.6 * mean, 1e-12);
        check_near("squeeze", stage_scalar(s, "squeeze_loss_mean"), -0.1 * mean, 1e-12);
        check_near("asperities", stage_scalar(s, "asperity_loss_mean"), 0.5 * mean, 1e-12);
        check_near("efficiency", stage_scalar(s, "efficiency"), 1 - 2 * mean / (250 * 150), 1e-12);
        check_near("friction", stage_scalar(s, "friction_coefficient_mean"), 2 * e.friction, 1e-9);
        check_near("judged", stage_scalar(s, "engagements_judged"), 2, 0);
        check_near("spread", stage_scalar(s, "power_loss_spread"), sqrt(2) * mean, 1e-9);
        check_near("one of them", stage_get(s, "engagement_power_loss", NULL)[1],
                   (order ? 1 : 3) * mean, 1e-12);
        check_near("at a phase", loss_at(s, 0.3, 0), 2 * loss_at(one, 0.3, 0), 1e-12);
        check_near("as one leaves", loss_at(s, 0.61, 1), 2 * loss_at(one, 0.61, 1), 1e-12);
        check_near("the hottest, by friction alone", stage_scalar(s, "flash_temperature_max"),
                   0.75 * 3 * stage_scalar(one, "flash_temperature_max"), 1e-9);
        stage_close(s);
    }
    stage_close(one);
}

/* A motion with a period of one mesh cycle, given with a period of three. */
static void test_alike_engagements_are_one(void)
{
    static const double alike[] = {1, 1, 1};
    static train t;
    engagement_fill(&e, 1.6);
    stage *one = engagement_open(&e), *s = train_open(&t, 3, alike);
    run(one);
    run(s);
    static const char *const same[] = {"power_loss_mean", "efficiency",
                                       "friction_coefficient_mean"};
    for (int k = 0; k < 3; k++)
        check_near(same[k], stage_scalar(s, same[k]), stage_scalar(one, same[k]), 1e-12);
    check_near("judged", stage_scalar(s, "engagements_judged"), 3, 0);
    check_near("no spread", stage_scalar(s, "power_loss_spread"), 0, 1e-12);
    stage_close(s);
    s = train_open(&t, 2, alike);
    t.part[1][7] *= 1.01;
    stage_give_series(s, "ehl.rolling_loss", t.n, t.part[1]);
    check_true("runs", stage_run(s) == FF_OK);
    check_true("parts that are not the whole", stage_verdict(s) == FF_BAD);
    stage_close(s);
    stage_close(one);
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
    refuse(s, "ehl.power_loss");
    s = engagement_open(&e);
    stage_give_scalar(s, "operating.torque", NAN);
    refuse(s, "operating.torque");
    s = engagement_open(&e);
    stage_give_scalar(s, "gear.face_width", NAN);
    refuse(s, "gear.face_width");
    e.roll[7] = e.roll[9];
    s = engagement_open(&e);
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
    test_all_engagements_count();
    test_alike_engagements_are_one();
    test_other_engagements_are_doubted();
    test_refusals();
    return check_done();
}
