/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A simple and slow reference: integrates eq. 3 of Li & Kahraman 2011 by the classical Runge-Kutta
   method with 20000 fixed steps per mesh cycle, regardless of kinks. */
#include "check.h"
#include "pair.h"

#include <math.h>
#include <stdio.h>

enum { STEPS = 20000 };

typedef struct twin {
    const pair *pair;
    int damping; /* 0 always, 1 in contact, 2 clipped */
    double zeta, omega;
} twin;

static double interpolate(const pair *p, const double *y, double phase, double *slope)
{
    phase -= floor(phase);
    size_t i = 1;
    while (i + 1 < p->phases && p->phase[i] <= phase)
        i++;
    double h = p->phase[i] - p->phase[i - 1];
    *slope = (y[i] - y[i - 1]) / h;
    return y[i - 1] + *slope * (phase - p->phase[i - 1]);
}

static double mesh_force(const twin *w, double t, double s, double v)
{
    const pair *p = w->pair;
    double phase = t * p->mesh_frequency, slope, b = p->backlash / 2;
    double k = interpolate(p, p->stiffness, phase, &slope);
    double e = interpolate(p, p->error, phase, &slope), delta = s - e;
    double damper = 2 * w->zeta * w->omega * p->mass * (v - slope * p->mesh_frequency);
    double bend = delta > b ? delta - b : delta < -b ? delta + b : 0;
    if (bend == 0 && w->damping)
        return 0;
    double force = k * bend + damper;
    return w->damping == 2 && force * bend < 0 ? 0 : force;
}

static double acceleration(const twin *w, double t, double s, double v)
{
    return (w->pair->line_force - mesh_force(w, t, s, v)) / w->pair->mass;
}

static void step(const twin *w, double t, double h, double *s, double *v)
{
    double v1 = *v, a1 = acceleration(w, t, *s, v1);
    double v2 = *v + h / 2 * a1, a2 = acceleration(w, t + h / 2, *s + h / 2 * v1, v2);
    double v3 = *v + h / 2 * a2, a3 = acceleration(w, t + h / 2, *s + h / 2 * v2, v3);
    double v4 = *v + h * a3, a4 = acceleration(w, t + h, *s + h * v3, v4);
    *s += h / 6 * (v1 + 2 * v2 + 2 * v3 + v4);
    *v += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
}

static void cycle(const twin *w, int steps, double *s, double *v)
{
    double h = 1 / w->pair->mesh_frequency / steps;
    for (int i = 0; i < steps; i++)
        step(w, i * h, h, s, v);
}

/* Compares motion and force over a mesh cycle from the model's start, and the return to the start.
   At a jump of the damping, the reference has the error of a step times the jump, 4e-4 * 2 zeta v.
   The samples do not lie at the nodes, where the force of the damper jumps with e'. */
static void check_cycle(const twin *w, const stage *model)
{
    const pair *p = w->pair;
    const double *dte = stage_get(model, "dte", NULL),
                 *force = stage_get(model, "mesh_force", NULL);
    const double *rate = stage_get(model, "dte_velocity", NULL);
    double s = dte[0], v = rate[0], h = 1 / p->mesh_frequency / STEPS, unit = p->backlash / 2;
    double worst = 0, worst_force = 0;
    for (int i = 0; i < STEPS; i++) {
        if (i % (STEPS / 500) == 0) {
            int at = i / (STEPS / 500);
            worst = fmax(worst, fabs(dte[at] - s) / unit);
            worst_force = fmax(worst_force, fabs(force[at] - mesh_force(w, i * h, s, v)));
        }
        step(w, i * h, h, &s, &v);
    }
    double limit = w->damping ? 1e-5 : 1e-6;
    check_below("difference of the motion over b", worst, limit);
    check_below("difference of the force over F", worst_force / p->line_force, 1e-4);
    check_below("twin returns: s over b", fabs(s - dte[0]) / unit, limit);
    check_below("twin returns: v", fabs(v - rate[0]) / unit / w->omega, limit);
}

/* Compares the monodromy matrix with central differences of the reference, with steps so short that
   the error at jumps of the damping is negligible. */
static void check_multipliers(const twin *w, const stage *model)
{
    double s = stage_get(model, "dte", NULL)[0], v = stage_get(model, "dte_velocity", NULL)[0];
    double d = (w->damping ? 1e-3 : 1e-4) * w->pair->backlash, m[2][2];
    int steps = w->damping ? 10 * STEPS : STEPS;
    for (int k = 0; k < 2; k++) {
        double s1 = s + (k ? 0 : d), v1 = v + (k ? d * w->omega : 0);
        double s2 = s - (k ? 0 : d), v2 = v - (k ? d * w->omega : 0);
        cycle(w, steps, &s1, &v1);
        cycle(w, steps, &s2, &v2);
        m[0][k] = (s1 - s2) / (2 * d);
        m[1][k] = (v1 - v2) / (2 * d * w->omega);
    }
    const double *mu = stage_get(model, "multipliers", NULL);
    check_near("trace", mu[0] + mu[2], m[0][0] + m[1][1], 2e-3);
    check_near("determinant", mu[0] * mu[2] - mu[1] * mu[3], m[0][0] * m[1][1] - m[0][1] * m[1][0],
               2e-3);
}

static void compare(pair *p, int damping, const char *branch)
{
    static const char *const dampings[] = {"always", "contact", "clipped"};
    printf("%g Hz, %s, damping %s\n", p->mesh_frequency, branch, dampings[damping]);
    stage *s = pair_open("dynamics/time-integration", p);
    stage_set_text(s, "branch", branch);
    stage_set_text(s, "damping", dampings[damping]);
    stage_set(s, "damping_ratio", 0.02);
    stage_set_text(s, "steps_per_cycle", "500");
    stage_set_text(s, "settle_tolerance", "1e-9");
    check_true("runs", stage_run(s) == FF_OK);
    check_near("period", stage_scalar(s, "period"), 1, 0);
    twin w = {p, damping, 0.02, 2 * M_PI * pair_natural_frequency};
    check_cycle(&w, s);
    check_multipliers(&w, s);
    stage_close(s);
}

/* The reference, started at the static deflection, must settle on the same motion. */
static void compare_settled(pair *p)
{
    stage *model = pair_open("dynamics/time-integration", p);
    stage_set(model, "damping_ratio", 0.02);
    check_true("runs", stage_run(model) == FF_OK);
    twin w = {p, 0, 0.02, 2 * M_PI * pair_natural_frequency};
    double s = p->backlash / 2 + p->line_force / p->stiffness[0], v = 0;
    for (int i = 0; i < 120; i++)
        cycle(&w, 2000, &s, &v);
    check_near("settled state", s, stage_get(model, "dte", NULL)[0], 1e-5);
    stage_close(model);
}

int main(void)
{
    pair p = pair_trapezoid(2375);
    for (size_t i = 0; i < p.phases; i++)
        p.error[i] = 1e-6 * sin(2 * M_PI * p.phase[i] + 0.5);
    p.error[p.phases - 1] = p.error[0];
    for (int damping = 0; damping < 3; damping++)
        compare(&p, damping, "upper");
    compare(&p, 0, "lower");
    compare_settled(&p);
    /* light load: the back flanks touch as well */
    pair light = pair_trapezoid(1400);
    light.line_force *= 0.3;
    for (int i = 0; i < PAIR_STATIONS; i++)
        light.tooth_force[i] *= 0.3;
    compare(&light, 0, "upper");
    return check_done();
}
