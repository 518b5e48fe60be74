/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The stated error due to the time steps, after a sudden change of the load, against a film with
   ten times as many steps: it must be as large as the true error where the front of the new film
   passes, and vanish after it. (It was once 4 % long after the front, with a true error of 0.02
   %.) */
#include "check.h"
#include "line.h"

#include <math.h>
#include <stdio.h>

enum { WINDOWS = 12, FINER = 10 };

static const double span = 300e-6, jump = 100e-6, window = 16e-6; /* s; the oil passes the contact
                                                                     in 78 us */

static void solve(line *c, double ratio, double steps)
{
    line_open(c, "ehl/finite-volume");
    line_last(c, 4, span);
    c->time[1] = c->time[2] = jump;
    double load = c->load[0];
    for (int k = 0; k < 4; k++)
        c->load[k] = (k < 2) == (ratio > 1) ? load / fmax(ratio, 1 / ratio) : load;
    stage_set(c->film, "steps", steps);
    stage_set(c->film, "cells", 512); /* the discretisation error is a tenth of the errors
                                         compared */
    check_true("runs", line_run(c, "h_min h_central h_min_error h_central_error time") == FF_OK);
}

/* The largest true error, and the largest stated error due to the steps, in each window after the
   jump. */
typedef struct errors {
    double off[WINDOWS], stated[WINDOWS], most, most_stated;
} errors;

static errors compare(const line *coarse, const line *fine, const char *film, const char *error)
{
    errors e = {{0}, {0}, 0, 0};
    size_t n, m, at = 0;
    const double *t = stage_get(coarse->film, "time", &n), *s = stage_get(fine->film, "time", &m);
    const double *h = stage_get(coarse->film, film, NULL), *g = stage_get(fine->film, film, NULL);
    const double *stated = stage_get(coarse->film, error, NULL),
                 *by_cells = stage_get(fine->film, error, NULL); /* with ten times the steps */
    for (size_t i = 0; i < n; i++) {
        while (at + 1 < m && s[at] < t[i] - 1e-12)
            at++;
        int k = (int)floor((t[i] - jump) / window);
        if (t[i] <= jump || k >= WINDOWS || fabs(s[at] - t[i]) > 1e-11)
            continue;
        e.off[k] = fmax(e.off[k], fabs(h[i] / g[at] - 1));
        e.stated[k] = fmax(e.stated[k], stated[i] / h[i] - by_cells[at] / g[at]);
        e.most = fmax(e.most, e.off[k]);
        e.most_stated = fmax(e.most_stated, e.stated[k]);
    }
    return e;
}

static void judge(const char *what, const errors *e)
{
    printf("%s, errors of 16 us each and what is stated:", what);
    for (int k = 0; k < WINDOWS; k++)
        printf(" %.4f (%.4f)", e->off[k], e->stated[k]);
    printf("\n");
    check_below("largest error", e->most, 3 * e->most_stated);
    check_below("largest stated", e->most_stated, 3 * e->most);
    for (int k = 7; k < WINDOWS; k++) /* after the front has left */
        check_below("long after", e->stated[k], 0.1 * e->most);
}

int main(void)
{
    static const double ratios[] = {2, 0.5, 6};
    for (int k = 0; k < 3; k++) {
        line coarse, fine;
        solve(&coarse, ratios[k], 300);
        solve(&fine, ratios[k], 300 * FINER);
        errors least = compare(&coarse, &fine, "h_min", "h_min_error"),
               central = compare(&coarse, &fine, "h_central", "h_central_error");
        judge("h_min", &least);
        judge("h_central", &central);
        line_close(&coarse);
        line_close(&fine);
    }
    return check_done();
}
