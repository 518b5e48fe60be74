/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Mean roughness heights in the cells: their sum must not depend on the shift of the flank, they
   must move with the flank, and waves that the cells do not resolve must be filtered out. */
#include "check.h"

#include "../../../plugins/ehl/contact/roughness-check.h"

#include <flankfilm/plugin.h>

#include <math.h>
#include <string.h>

enum { POINTS = 64, NODES = 49 };

static const double pi = 3.14159265358979323846, repeats = 64e-6; /* m */

static double sum_of(const double *y)
{
    double sum = 0;
    for (size_t i = 0; i < NODES; i++)
        sum += y[i];
    return sum;
}

/* Returns the largest difference to heights computed by sums over the samples, m. */
static double off_traces(const ehl_roughness *r, const ehl_grid *g, double time, const double *y)
{
    double most = 0;
    for (size_t i = 0; i < NODES; i++) {
        double x = g->first + (double)i * g->dx;
        most = fmax(most, fabs(ehl_traces_height(r, x, g->dx, time) - y[i]));
    }
    return most;
}

/* Flanks that move towards -x, and roughness that enters the contact with the oil. */
static void test_mirrored(const double *time, const double *u1, const double *u2,
                          const double *position, const double height[2][POINTS], const ehl_grid *g)
{
    const double back_1[] = {-u1[0], -u1[1]}, back_2[] = {-u2[0], -u2[1]};
    static double before[NODES];
    ehl_history h = {.count = 2, .time = time, .speed_1 = back_1, .speed_2 = back_2, .mirrored = 1};
    ehl_roughness s = {
        .count = POINTS, .height = {height[0], height[1]}, .period = repeats, .history = &h};
    if (!check_true("takes it mirrored", ehl_roughness_create(&s, position, &h, NULL) == FF_OK))
        return;
    s.ramp = 40e-6;
    ehl_roughness_heights(&s, g, 0, before);
    check_below("mirrored and run in", off_traces(&s, g, 0, before), 1e-14);
    check_near("smooth where they have not", before[NODES - 1], 0, 1e-20);
    for (int k = 1; k <= 3; k++) { /* the oil goes 20 um in 0.4 ms */
        ehl_roughness_heights(&s, g, 4e-4 * k, before);
        check_below("the front moves on", off_traces(&s, g, 4e-4 * k, before), 1e-14);
    }
    ehl_roughness_heights(&s, g, 0.02, before);
    check_below("rough all over", off_traces(&s, g, 0.02, before), 1e-14);
    check_true("where they were smooth, too", fabs(before[NODES - 1]) > 1e-8);
    ehl_roughness_destroy(&s);
}

/* The filter must reduce the amplitude of each wave to 2^-(cutoff/length)^2, and the variance
   accordingly. The number of points in the record is no power of 2, so that the filter extends
   beyond its ends. */
static void test_cut_of_waves(const ehl_history *h)
{
    enum { COUNT = 60 };
    const double spacing = 0.5e-6, cutoff = 7e-6;
    static double position[COUNT], height[2][COUNT];
    double left = exp2(-pow(7. / 6, 2)), long_left = exp2(-pow(7. / 15, 2)), worst = 0;
    for (size_t i = 0; i < COUNT; i++) {
        double turn = 2 * pi * (double)i / COUNT;
        position[i] = (double)i * spacing;
        height[0][i] = 1e-6 * (0.2 + sin(5 * turn)); /* 6 um */
        height[1][i] = 2e-6 * cos(2 * turn);         /* 15 um */
    }
    ehl_roughness r = {
        .count = COUNT, .height = {height[0], height[1]}, .period = COUNT * spacing, .history = h};
    check_true("a record to be cut", ehl_roughness_create(&r, position, h, NULL) == FF_OK &&
                                         ehl_roughness_cut(&r, cutoff, NULL) == FF_OK);
    for (size_t i = 0; i < COUNT; i++) {
        double turn = 2 * pi * (double)i / COUNT;
        worst = fmax(worst, fabs(r.height[0][i] - 1e-6 * (0.2 + left * sin(5 * turn))));
        worst = fmax(worst, fabs(r.height[1][i] - 2e-6 * long_left * cos(2 * turn)));
    }
    check_below("waves by the closed form", worst, 1e-18);
    check_near("what is left out", r.left_out,
               1e-6 * sqrt((pow(1 - left, 2) + pow(2 * (1 - long_left), 2)) / 2), 1e-9);
    check_near("what was given", r.given, 1e-6 * sqrt(2.5), 1e-9);
    check_below("curvature of what is left",
                fabs(r.curvature /
                         hypot(left * pow(2 * pi / 6e-6, 2) * 1e-6,
                               long_left * pow(2 * pi / 15e-6, 2) * 2e-6) *
                         sqrt(2) -
                     1),
                0.03); /* by second differences, without those at the ends */
    ehl_roughness_destroy(&r);
}

/* A Gaussian bump between flat ends becomes a wider bump of the same area, part of it beyond the
   record: both widths add up in squares, that of the weighting function being cutoff sqrt(ln
   2/2)/pi. */
static void test_cut_of_bump(const ehl_history *h)
{
    enum { COUNT = 41 };
    const double spacing = 0.25e-6, cutoff = 8e-6, own = 1e-6;
    const double wide = hypot(own, cutoff * sqrt(log(2) / 2) / pi);
    static double position[COUNT], height[2][COUNT], cells[NODES];
    for (size_t i = 0; i < COUNT; i++) {
        double x = ((double)i - 20) * spacing;
        position[i] = (double)i * spacing;
        height[0][i] = 1e-6 * exp(-x * x / (2 * own * own));
    }
    ehl_roughness r = {
        .count = COUNT, .height = {height[0], height[1]}, .origin = 20 * spacing, .history = h};
    check_true("a bump to be cut", ehl_roughness_create(&r, position, h, NULL) == FF_OK &&
                                       ehl_roughness_cut(&r, cutoff, NULL) == FF_OK);
    ehl_grid g = {.nodes = NODES, .dx = 0.5e-6, .first = -12e-6};
    double worst = 0;
    ehl_roughness_heights(&r, &g, 0, cells);
    for (size_t i = 0; i < NODES; i++) {
        double x = g.first + (double)i * g.dx, half = g.dx / 2, in = sqrt(2) * wide;
        double mean = sqrt(pi / 2) * wide / g.dx * (erf((x + half) / in) - erf((x - half) / in));
        worst = fmax(worst, fabs(cells[i] - 1e-6 * own / wide * mean));
    }
    check_below("a wider bump, straight lines between its points", worst, 2e-3 * 1e-6);
    check_true("beyond the record", cells[12] > 1e-9);
    ehl_roughness_destroy(&r);
}

static ff_status keep(void *ctx, ff_status status, const char *item, const char *text)
{
    *(int *)ctx = !strcmp(item, "surface.position") && strstr(text, "roughness_cutoff") != NULL;
    return status;
}

static void test_refused_cut(const ehl_history *h)
{
    const double position[] = {0, 1e-12, 2e-12}, flat[3] = {0};
    int told = 0;
    const ff_host host = {.ctx = &told, .fail = keep};
    ehl_roughness r = {.count = 3, .height = {flat, flat}, .history = h};
    check_true("points too close for the filter",
               ehl_roughness_create(&r, position, h, NULL) == FF_OK &&
                   ehl_roughness_cut(&r, 1e-3, &host) == FF_INVALID && told);
    ehl_roughness_destroy(&r);
}

int main(void)
{
    /* flank 1 stands, then gains speed evenly: 0.5 m/s2 makes 1 mm in 63.2 ms; flank 2 is flat */
    double time[] = {0, 0.0632455532}, u1[] = {0, 0.0316227766}, u2[] = {0.1, 0.1};
    ehl_history h = {.count = 2, .time = time, .speed_1 = u1, .speed_2 = u2};
    static double position[POINTS], height[2][POINTS], before[NODES], after[NODES];
    const double period = repeats;
    for (size_t i = 0; i < POINTS; i++) {
        position[i] = period * (double)i / POINTS;
        height[0][i] = 1e-6 * (0.3 + sin(2 * pi * (double)i / POINTS));
    }
    ehl_roughness r = {
        .count = POINTS, .height = {height[0], height[1]}, .period = period, .history = &h};
    /* the cells cover two periods and a part that is no multiple of the points' distance */
    ehl_grid g = {.nodes = NODES, .dx = 2 * period / NODES, .first = -1.3 * period};
    if (!check_true("takes the record", ehl_roughness_create(&r, position, &h, NULL) == FF_OK))
        return check_done();
    ehl_roughness_heights(&r, &g, 0, before);
    check_near("mean height", sum_of(before) / NODES, 0.3e-6, 1e-12);
    for (int k = 1; k < 8; k++) {
        ehl_roughness_heights(&r, &g, time[1] * k / 7.3, after);
        check_near("no metal is lost", sum_of(after), sum_of(before), 1e-12);
        check_below("the same by samples", off_traces(&r, &g, time[1] * k / 7.3, after), 1e-14);
    }
    double cell = 1e-3 / period; /* 15.625 periods of way */
    check_near("way of a flank that gains speed", ehl_roughness_travel(&r, time[1]),
               (1e-3 + 0.1 * time[1]) / 2, 1e-8);
    ehl_roughness_heights(&r, &g, time[1], after);
    check_true("flanks that stand still", off_traces(&r, &g, 0, after) > 1e-7);
    test_mirrored(time, u1, u2, position, (const double(*)[POINTS])height, &g);
    test_cut_of_waves(&h);
    test_cut_of_bump(&h);
    test_refused_cut(&h);
    r.period = 0;
    ehl_roughness_heights(&r, &g, 1e-4, before);
    check_below("a trace that ends", off_traces(&r, &g, 1e-4, before), 1e-14);
    r.period = period;
    r.origin = -1e-3;
    ehl_roughness_heights(&r, &g, 0, before);
    check_true("a way that is no number of periods", fabs(cell - floor(cell)) > 0.1);
    for (size_t i = 0; i < NODES; i += 7)
        check_below("moved as the flank moved", fabs(after[i] - before[i]), 1e-12);
    ehl_roughness_destroy(&r);
    return check_done();
}
