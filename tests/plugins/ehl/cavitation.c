/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Films with `cavitation: conserve`, in which cavitated oil keeps its mass, during a loss of
   contact. */
#include "check.h"
#include "line.h"

#include <math.h>
#include <string.h>

static const char *model; /* the model that is tested */

enum { CELLS = 128 };

/* Removes the load, opens a gap of 3 um, closes it, and applies the load again. */
static void separate(line *c)
{
    line_open(c, model);
    line_incompressible(c);
    line_last(c, 41, 600e-6);
    for (size_t i = 0; i < c->count; i++) {
        double t = (double)i / 40, down = (0.35 - t) / 0.1, up = (t - 0.6) / 0.1;
        c->load[i] *= fmin(fmax(fmax(down, up), 0), 1);
        c->gap[i] = t > 0.35 && t < 0.6 ? 3e-6 * (t - 0.35) * (0.6 - t) / (0.125 * 0.125) : 0;
    }
    stage_set(c->film, "cells", CELLS);
    stage_set_text(c->film, "steps", "auto"); /* each step is in the results */
    stage_set_text(c->film, "time_tolerance", "0.1");
    stage_set(c->film, "tolerance", 1e-9);
    stage_set_text(c->film, "cavitation", "mass-conserving");
}

/* Returns theta rho h at a node. */
static double content(const line *c, size_t k, size_t i)
{
    size_t at = k * (CELLS + 1) + i;
    return line_value(c, "film", at) * line_value(c, "film_fraction", at) * 917.8;
}

/* Returns the mass that flows in dt through the face downstream of node i, if there is no
   pressure. */
static double passing(const line *c, size_t k, size_t i, double dt)
{
    int around = strcmp(model, "ehl/finite-volume") == 0; /* 1: the face is between two nodes; 0: at
                                                             a node */
    int full = around && line_value(c, "film_fraction", k * (CELLS + 1) + i - 1) >= 1;
    double here = content(c, k, i), before = content(c, k, i - 1);
    return c->u1[0] * dt * (full ? 1.5 * here - 0.5 * before : here);
}

/* The mass of oil between the film with pressure and the outlet must increase in a step of the
   Euler method by what enters minus what leaves. */
static double void_gain(const line *c, size_t k, double *flow)
{
    size_t first = CELLS - 1;
    while (first > 2 && line_value(c, "pressure", k * (CELLS + 1) + first - 2) <= 0)
        first--;
    double dx = line_value(c, "x", 1) - line_value(c, "x", 0);
    double dt = line_value(c, "time", k) - line_value(c, "time", k - 1), gain = 0;
    for (size_t i = first; i < CELLS; i++)
        gain += (content(c, k, i) - content(c, k - 1, i)) * dx;
    *flow = passing(c, k, first - 1, dt);
    for (size_t i = first - 1; i < CELLS; i++)
        if (line_value(c, "pressure", k * (CELLS + 1) + i) > 0)
            return 0; /* the film reaches the outlet */
    return gain - *flow + passing(c, k, CELLS - 1, dt);
}

static void test_conservation(void)
{
    line c;
    separate(&c);
    stage_set_text(c.film, "time_scheme", "euler");
    ff_status status = line_run(&c, "film film_fraction pressure x time mass_error steps_cut");
    check_true(status == FF_OK ? "runs" : stage_why(c.film), status == FF_OK);
    if (status != FF_OK)
        return;
    double worst = 0, whole = 0, least = 1, both = 0;
    size_t count;
    stage_get(c.film, "time", &count);
    for (size_t k = 1; k < count; k++) {
        double flow, gain = void_gain(&c, k, &flow);
        worst = fmax(worst, fabs(gain) / flow);
        whole = fmax(whole, line_value(&c, "mass_error", k));
    }
    for (size_t i = 0; i < count * (CELLS + 1); i++) {
        double theta = line_value(&c, "film_fraction", i);
        least = fmin(least, theta);
        both = fmax(both, line_value(&c, "pressure", i) * (1 - theta));
    }
    check_below("oil of the void", worst, 1e-6);
    check_below("oil of the whole domain", whole, 1e-6);
    check_below("p (1 - theta)", both, 0);
    check_true("the film is torn, and holds no negative share", least < 0.5 && least >= 0);
    line_close(&c);
}

/* In a steady contact, no cavitated oil forms a full film again: the film must be that of
   `cavitation: clip`. */
static void test_steady(void)
{
    line a, b;
    line_open(&a, model);
    line_open(&b, model);
    stage_set_text(b.film, "cavitation", "mass-conserving");
    line_run(&a, "h_min p_max");
    check_true("runs", line_run(&b, "h_min p_max film film_fraction h_central") == FF_OK);
    check_near("h_min", line_value(&b, "h_min", 0), line_value(&a, "h_min", 0), 1e-5);
    check_near("p_max", line_value(&b, "p_max", 0), line_value(&a, "p_max", 0), 1e-5);
    double rho =
        917.8 * (1 + 0.34 * line_value(&b, "p_max", 0) / (0.59e9 + line_value(&b, "p_max", 0)));
    check_near("what flows out is what flows through",
               line_value(&b, "film", 511) * line_value(&b, "film_fraction", 511) * 917.8,
               rho * line_value(&b, "h_central", 0), 0.01);
    line_close(&a);
    line_close(&b);
}

int main(void)
{
    static const char *const models[] = {"ehl/finite-volume", "ehl/control-volume"};
    for (int k = 0; k < 2; k++) {
        model = models[k];
        test_steady();
        test_conservation();
    }
    return check_done();
}
