/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Compares motions by dynamics/shooting and dynamics/time-integration at a tolerance of 1e-10. They
   share the equation, but not time steps, detection of contact changes, or the search for the
   periodic motion. */
#include "check.h"
#include "pair.h"

#include <math.h>
#include <stdio.h>

static stage *run(const char *model, const pair *p, const char *branch, const char *damping)
{
    stage *s = pair_open(model, p);
    stage_set_text(s, "branch", branch);
    stage_set_text(s, "damping", damping);
    stage_set(s, "damping_ratio", 0.02);
    stage_set_text(s, "steps_per_cycle", "256");
    if (model[9] == 't') {
        stage_set_text(s, "tolerance", "1e-10");
        stage_set_text(s, "settle_tolerance", "1e-9");
    }
    check_true("runs", stage_run_wanted(s, "dte mesh_force dte_rms multipliers period contact_loss "
                                           "back_contact tooth_force") == FF_OK);
    return s;
}

static void check_series(const stage *a, const stage *z, const char *output, double unit,
                         double limit)
{
    size_t n, m;
    const double *x = stage_get(a, output, &n), *y = stage_get(z, output, &m);
    double worst = n == m ? 0 : INFINITY;
    for (size_t i = 0; i < n && n == m; i++)
        worst = fmax(worst, fabs(x[i] - y[i]) / unit);
    check_below(output, worst, limit);
}

static void compare(const pair *p, const char *branch, const char *damping)
{
    printf("%g Hz, %s, damping %s\n", p->mesh_frequency, branch, damping);
    stage *a = run("dynamics/shooting", p, branch, damping);
    stage *z = run("dynamics/time-integration", p, branch, damping);
    double b = p->backlash / 2;
    check_near("period", stage_scalar(a, "period"), stage_scalar(z, "period"), 0);
    check_series(a, z, "dte", b, 1e-6);
    check_series(a, z, "tooth_force", p->line_force, 1e-5);
    check_series(a, z, "multipliers", 1, 1e-5);
    check_near("rms", stage_scalar(a, "dte_rms"), stage_scalar(z, "dte_rms"), 1e-6);
    check_below("contact loss",
                fabs(stage_scalar(a, "contact_loss") - stage_scalar(z, "contact_loss")), 1e-6);
    check_below("back contact",
                fabs(stage_scalar(a, "back_contact") - stage_scalar(z, "back_contact")), 1e-6);
    check_below("energy balance", stage_quality(a, "energy_balance"), 1e-9);
    check_below("determinant", stage_quality(a, "determinant"), 1e-12);
    stage_close(a);
    stage_close(z);
}

int main(void)
{
    static const char *const dampings[] = {"always", "contact", "clipped"};
    pair p = pair_trapezoid(2375);
    compare(&p, "lower", "always");
    for (size_t i = 0; i < p.phases; i++)
        p.error[i] = 1e-6 * sin(2 * M_PI * p.phase[i] + 0.5);
    p.error[p.phases - 1] = p.error[0];
    for (int i = 0; i < 3; i++)
        compare(&p, "upper", dampings[i]);
    /* light load: the back flanks touch as well */
    pair light = pair_trapezoid(1400);
    light.line_force *= 0.3;
    for (int i = 0; i < PAIR_STATIONS; i++)
        light.tooth_force[i] *= 0.3;
    for (int i = 0; i < 3; i++)
        compare(&light, "upper", dampings[i]);
    /* a transmission error that jumps: a pitch error of the next tooth pair */
    pair step = pair_trapezoid(1800);
    step.error[1] = step.error[2] = 2e-6;
    step.error[3] = -1e-6;
    step.phase[2] = step.phase[1];
    compare(&step, "upper", "always");
    compare(&step, "lower", "contact");
    return check_done();
}
