/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Compares both branches of the trapezoid with states from another solver: Taylor series between
   located changes of contact, which agreed with the integrators rk8pd and CVODE to 1e-8. Lengths
   over b, times in 1/omega_n. */
#include "check.h"
#include "pair.h"

#include <math.h>
#include <stdio.h>

typedef struct state {
    double frequency;
    const char *branch;
    double x, v, rms, max, min, trace, det;
} state;

static const state states[] = {
    {1250, "lower", 1.198731434212, -0.001317327864, 0.050672794, 1.203284948, 1.056575059,
     -1.467587, 0.721861932},
    {1250, "upper", 0.708143483454, 0.135857534234, 0.279404724, 1.470330295, 0.641744455,
     -0.473438, 0.721861932},
    {2085, "lower", 1.074351380398, 0.000997534206, 0.035480264, 1.184768220, 1.074343172,
     -1.764837, 0.822508456},
    {2085, "upper", 0.708039437535, -0.332093688261, 0.434968749, 1.581491607, 0.328294580,
     0.513675, 0.822508456},
    {2375, "lower", 1.072040675418, -0.000504040113, 0.040979614, 1.187142845, 1.072038629,
     -1.187265, 0.842368617},
    {2375, "upper", 0.954737027532, -0.327082501914, 0.318365320, 1.492383334, 0.586197883,
     0.813724, 0.842368617},
    {3240, "lower", 1.255775179528, -0.127595931649, 0.126595617, 1.305320012, 0.950361622,
     1.526132, 0.881842971},
    {3240, "upper", 1.255775179528, -0.127595931649, 0.126595617, 1.305320012, 0.950361622,
     1.526132, 0.881842971},
};

static void check_value(const state *pin, const char *what, double value, double expected,
                        double tolerance)
{
    char name[64];
    snprintf(name, sizeof name, "%g Hz %s %s", pin->frequency, pin->branch, what);
    check_near(name, value, expected, tolerance / fmax(fabs(expected), 1e-3));
}

/* The tolerance is that of the digits below: 1e-9 in lengths, 1e-6 in the trace. */
static void check_state(const state *pin, const stage *s, double tolerance)
{
    double b = 70e-6, omega = 2 * M_PI * pair_natural_frequency, low = 1e9, high = -1e9;
    size_t count;
    const double *dte = stage_get(s, "dte", &count);
    for (size_t i = 0; i < count; i++) {
        low = fmin(low, dte[i] / b);
        high = fmax(high, dte[i] / b);
    }
    const double *mu = stage_get(s, "multipliers", NULL);
    check_value(pin, "x(0)", dte[0] / b, pin->x, tolerance);
    check_value(pin, "v(0)", stage_get(s, "dte_velocity", NULL)[0] / b / omega, pin->v, tolerance);
    check_value(pin, "rms", stage_scalar(s, "dte_rms") / b, pin->rms, tolerance);
    check_value(pin, "max", high, pin->max, tolerance);
    check_value(pin, "min", low, pin->min, tolerance);
    check_value(pin, "trace", mu[0] + mu[2], pin->trace, fmax(tolerance, 2e-6));
    check_value(pin, "det", mu[0] * mu[2] - mu[1] * mu[3], pin->det, fmax(tolerance, 1e-8));
    check_near("period", stage_scalar(s, "period"), 1, 0);
}

static void check_run(const state *pin, stage *s)
{
    stage_set_text(s, "branch", pin->branch);
    stage_set_text(s, "steps_per_cycle", "2048");
    check_true("runs", stage_run(s) == FF_OK);
    check_true("is trusted", pair_is_trusted(s));
    check_state(pin, s, 1e-7);
    stage_close(s);
}

/* Opens stiffness/table with the trapezoid as lists. */
static stage *open_table(const pair *p)
{
    static const double teeth[2] = {50, 73};
    stage *s = stage_open("stiffness/table");
    stage_give_series(s, "gear.roll_angle", PAIR_STATIONS, p->roll);
    stage_give_scalar(s, "gear.roll_sap", p->roll[0]);
    stage_give_scalar(s, "gear.roll_tip", p->roll[PAIR_STATIONS - 1]);
    stage_give_series(s, "gear.teeth", 2, teeth);
    stage_give_scalar(s, "operating.line_force", p->line_force);
    stage_set_reals(s, "phase", p->phases, p->phase);
    stage_set_reals(s, "stiffness", p->phases, p->stiffness);
    return s;
}

int main(void)
{
    for (size_t i = 0; i < sizeof states / sizeof states[0]; i++) {
        pair p = pair_trapezoid(states[i].frequency);
        check_run(&states[i], pair_open("dynamics/time-integration", &p));
        stage *table = open_table(&p), *s = pair_open("dynamics/time-integration", &p);
        stage_link(s, "stiffness", table);
        check_run(&states[i], s);
        stage_close(table);
    }
    return check_done();
}
