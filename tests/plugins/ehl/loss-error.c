/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The estimated errors of a loss due to the time steps, and of a film due to the cells, for
   synthetic series. */
#include "check.h"

#include "../../../plugins/ehl/stage/outputs.h"
#include "../../../plugins/ehl/stage/stage.h"

#include <math.h>
#include <string.h>

enum { ROWS = 20, AT = 9 };

static double series[ROWS * EHL_SERIES], space[ROWS * EHL_SPACE];
static double time_of[ROWS];

static double stated_of(size_t rows, double (*power)(double), int scheme)
{
    static ehl_march m;
    static ehl_results r;
    memset(&m, 0, sizeof m);
    memset(&r, 0, sizeof r);
    m.scheme = scheme;
    r.series.data = series;
    r.space.data = space;
    r.series.count = r.space.count = rows;
    for (size_t k = 0; k < ROWS; k++) {
        time_of[k] = (double)k + 0.3 * sin((double)k);
        series[k * EHL_SERIES + EHL_TIME] = time_of[k];
        series[k * EHL_SERIES + EHL_SQUEEZE_LOSS] = power(time_of[k]);
        space[k * EHL_SPACE + EHL_LEAST] = 1;
    }
    return ehl_results_loss_in_time(&r, &m);
}

static double stated(double (*power)(double), int scheme)
{
    return stated_of(ROWS, power, scheme);
}

static double straight(double t)
{
    return 3 * t - 2;
}

static double bent(double t)
{
    return t * t;
}

static double leaping(double t)
{
    return t < AT + 0.5 ? 1 : 5 + 0.1 * t;
}

static double off_at_one(double t)
{
    return straight(t) + (t > AT - 0.5 && t < AT + 0.5 ? 0.7 : 0);
}

/* Returns the largest dt (dt + dt_1)/3 over the instants, the error of a parabola t^2; on the side
   with the smaller value. */
static double third_of_bend(void)
{
    double most = 0;
    for (size_t k = 3; k + 3 < ROWS; k++) {
        double before = (time_of[k] - time_of[k - 1]) * (time_of[k] - time_of[k - 2]),
               behind = (time_of[k + 1] - time_of[k]) * (time_of[k + 2] - time_of[k]);
        most = fmax(most, fmin(before, behind) / 3);
    }
    return most;
}

static double worst;
static int32_t judged;

static void keep(void *ctx, const char *name, double value, double limit, int32_t verdict,
                 const char *text)
{
    (void)ctx, (void)name, (void)limit, (void)text;
    worst = value;
    judged = verdict;
}

/* Returns the value of the quality line h_min_space_error for one instant with film h_min. */
static double stated_of_film(double h_min, double part)
{
    static ehl_march m;
    static ehl_results r;
    const ff_host host = {.quality = keep};
    r = (ehl_results){.host = &host, .wanted = FF_BIT(EHL_H_MIN), .judged = 1};
    r.series.data = series;
    r.space.data = space;
    r.series.count = r.space.count = 1;
    series[EHL_H_MIN] = h_min;
    space[EHL_LEAST] = part;
    ehl_results_report_cells(&r, &m);
    return worst;
}

int main(void)
{
    check_near("a film that is too thin", stated_of_film(1e-6, -1e-8), 0.01, 1e-10);
    check_true("and is good", judged == FF_GOOD);
    check_true("a film that is no number", isnan(stated_of_film(NAN, 1e-8)));
    check_true("is doubtful", judged == FF_DOUBTFUL);
    judged = FF_GOOD;
    check_true("nor its error", isnan(stated_of_film(1e-6, NAN)));
    check_true("which is doubtful, too", judged == FF_DOUBTFUL);
    check_below("a straight line", stated(straight, EHL_BDF2), 1e-10);
    double bend = stated(bent, EHL_BDF2);
    check_near("a parabola", bend, third_of_bend(), 1e-10);
    check_below("a power that leaps", stated(leaping, EHL_BDF2), 1e-10);
    check_near("one instant off", stated(off_at_one, EHL_BDF2), 0.7, 1e-10);
    check_true("too few instants say nothing", stated_of(6, off_at_one, EHL_BDF2) < 0);
    check_true("seven say something", stated_of(7, bent, EHL_BDF2) > 0);
    double late = 0;
    stated(straight, EHL_EULER);
    for (size_t k = 3; k + 3 < ROWS; k++)
        late = fmax(late, 1.5 * (time_of[k] - time_of[k - 1]));
    check_near("half a step late", stated(straight, EHL_EULER), late, 1e-10);
    return check_done();
}
