/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "check.h"
#include "pair.h"

#include <math.h>
#include <string.h>

/* For e_l = a + c phase, the mean must be a + c/2, and the rms c/sqrt(12). */
static void test_statistics(void)
{
    pair p = pair_trapezoid(2000);
    double loaded[PAIR_MAX_PHASES];
    for (size_t i = 0; i < p.phases; i++)
        loaded[i] = 1e-5 + 4e-6 * p.phase[i];
    stage *s = pair_open("dynamics/quasi-static", &p);
    stage_give_series(s, "stiffness.loaded_transmission_error", p.phases, loaded);
    check_true("runs", stage_run(s) == FF_OK);
    check_near("mean", stage_scalar(s, "dte_mean"), p.backlash / 2 + 1.2e-5, 1e-12);
    check_near("rms", stage_scalar(s, "dte_rms"), 4e-6 / sqrt(12), 1e-9);
    check_near("peak to peak", stage_scalar(s, "dte_peak_to_peak"), 4e-6, 1e-9);
    check_near("natural frequency", stage_scalar(s, "natural_frequency"), pair_natural_frequency,
               1e-12);
    const char *ones[] = {"dynamic_factor_tooth", "dynamic_factor_mesh", "period"};
    for (int i = 0; i < 3; i++)
        check_near(ones[i], stage_scalar(s, ones[i]), 1, 0);
    check_near("contact loss", stage_scalar(s, "contact_loss"), 0, 0);
    size_t count;
    const double *w = stage_get(s, "tooth_force", &count);
    check_true("tooth force is the static one",
               count == PAIR_STATIONS && !memcmp(w, p.tooth_force, sizeof p.tooth_force));
    check_near("mesh force", stage_get(s, "mesh_force", NULL)[3], p.line_force, 0);
    stage_close(s);
}

static void test_refused(void)
{
    pair p = pair_trapezoid(2000);
    double loaded[] = {1, 1, 1, NAN, 1, 1};
    stage *s = pair_open("dynamics/quasi-static", &p);
    stage_give_series(s, "stiffness.loaded_transmission_error", 6, loaded);
    check_true("not a number", stage_run(s) == FF_INVALID);
    check_true("is named", !strcmp(stage_why_item(s), "stiffness.loaded_transmission_error"));
    stage_give_series(s, "stiffness.loaded_transmission_error", 3, loaded);
    check_true("too short", stage_run(s) == FF_INVALID);
    stage_close(s);
}

int main(void)
{
    test_statistics();
    test_refused();
    return check_done();
}
