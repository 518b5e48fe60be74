/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "pair.h"

#include <math.h>
#include <string.h>

const double pair_natural_frequency = 3242;

static const double mean_stiffness = 3.6e8, half_gap = 70e-6, contact_ratio = 1.755;

/* Adds load fractions of rigid tooth pairs; the phase at which the number of pairs changes has two
   rows. */
static void add_stations(pair *p)
{
    static const double cycles[PAIR_STATIONS] = {0,   0.3, 0.5, 0.755, 0.755, 0.9,
                                                 1.0, 1.0, 1.3, 1.5,   1.755};
    for (int i = 0; i < PAIR_STATIONS; i++) {
        double q = cycles[i];
        p->roll[i] = 0.25 + q * 2 * M_PI / 50;
        int single = i >= 4 && i <= 6;
        p->load_share[i] = single ? 1 : q < 0.9 ? 0.4 + 0.2 * q : 0.6 - 0.2 * (q - 1);
        p->tooth_force[i] = p->load_share[i] * p->line_force;
    }
}

static pair duty(double mesh_frequency)
{
    double omega = 2 * M_PI * pair_natural_frequency;
    pair p = {
        .mesh_frequency = mesh_frequency,
        .line_force = 0.1408 * half_gap * mean_stiffness,
        .backlash = 2 * half_gap,
        .mass = mean_stiffness / (omega * omega),
        .stiffness_mean = mean_stiffness,
    };
    add_stations(&p);
    return p;
}

pair pair_trapezoid(double mesh_frequency)
{
    pair p = duty(mesh_frequency);
    double two = contact_ratio - 1, ramp = 0.04, edge = two / 2;
    double high = mean_stiffness / (two + (1 - two) * 0.65), low = 0.65 * high;
    double phase[] = {0, edge - ramp / 2, edge + ramp / 2, 1 - edge - ramp / 2, 1 - edge + ramp / 2,
                      1};
    double stiffness[] = {high, high, low, low, high, high};
    p.phases = 6;
    memcpy(p.phase, phase, sizeof phase);
    memcpy(p.stiffness, stiffness, sizeof stiffness);
    return p;
}

pair pair_cosine(double mesh_frequency, double stiffness_1, double error_1, size_t points)
{
    pair p = duty(mesh_frequency);
    p.phases = points + 1;
    for (size_t i = 0; i <= points; i++) {
        p.phase[i] = (double)i / (double)points;
        p.stiffness[i] = mean_stiffness * (1 + stiffness_1 * cos(2 * M_PI * p.phase[i]));
        p.error[i] = error_1 * cos(2 * M_PI * p.phase[i]);
    }
    return p;
}

bool pair_is_trusted(stage *s)
{
    return stage_run_wanted(s, "dte dte_rms period") == FF_OK && stage_verdict(s) == FF_GOOD;
}

double pair_mean(const pair *p)
{
    double mean = 0;
    for (size_t i = 1; i < p->phases; i++)
        mean += (p->phase[i] - p->phase[i - 1]) * (p->stiffness[i] + p->stiffness[i - 1]) / 2;
    return mean;
}

stage *pair_open(const char *id, const pair *p)
{
    static const double teeth[2] = {50, 73};
    stage *s = stage_open(id);
    int integrates = strcmp(id, "dynamics/quasi-static") != 0;
    stage_give_scalar(s, "gear.backlash", p->backlash);
    stage_give_scalar(s, "gear.equivalent_mass", p->mass);
    stage_give_scalar(s, "operating.line_force", p->line_force);
    stage_give_series(s, "stiffness.phase", p->phases, p->phase);
    stage_give_scalar(s, "stiffness.stiffness_mean", p->stiffness_mean);
    stage_give_series(s, "stiffness.tooth_force", PAIR_STATIONS, p->tooth_force);
    if (!integrates)
        return s;
    stage_give_series(s, "gear.roll_angle", PAIR_STATIONS, p->roll);
    stage_give_scalar(s, "gear.roll_sap", p->roll[0]);
    stage_give_series(s, "gear.teeth", 2, teeth);
    stage_give_scalar(s, "operating.mesh_frequency", p->mesh_frequency);
    stage_give_series(s, "stiffness.stiffness", p->phases, p->stiffness);
    stage_give_series(s, "stiffness.transmission_error", p->phases, p->error);
    stage_give_series(s, "stiffness.load_share", PAIR_STATIONS, p->load_share);
    return s;
}
