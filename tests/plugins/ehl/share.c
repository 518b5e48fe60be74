/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The load of asperities and of the oil enclosed by them must depend on the flanks and the oil, and
   not on cells and steps. */
#include "check.h"
#include "flank.h"

#include <math.h>
#include <stdio.h>

typedef struct shares {
    double asperities, trapped;
} shares;

static double mean(const line *c, const char *output)
{
    size_t n;
    const double *x = stage_get(c->film, output, &n);
    double sum = 0;
    for (size_t i = 0; i < n; i++)
        sum += x[i];
    return sum / (double)n;
}

/* Runs 0.6 mm of motion at the pitch point, at a hundredth of the nominal speed. */
static shares run(const flank *f, size_t cells, size_t steps)
{
    const double speed = 0.01, slide = 0.1;
    shares s = {0};
    line c;
    line_open(&c, "ehl/finite-volume");
    line_eyring(&c, 5e6);
    c.u1[0] *= speed * (1 + slide / 2);
    c.u2[0] *= speed * (1 - slide / 2);
    line_last(&c, 2, 600e-6 / (4.03 * speed));
    stage_set(c.film, "cells", (double)cells);
    stage_set(c.film, "steps", (double)steps);
    flank_give(f, c.film);
    ff_status status = line_run(&c, "asperity_load_share trapped_share");
    if (check_true(status == FF_OK ? "runs" : stage_why(c.film), status == FF_OK)) {
        s = (shares){mean(&c, "asperity_load_share"), mean(&c, "trapped_share")};
        printf("%zu cells, %zu steps: asperities %.4f, trapped oil %.4f; oil made up %.2g, cells "
               "over an inlet %.2g\n",
               cells, steps, s.asperities, s.trapped, stage_quality(c.film, "contact_supply"),
               stage_quality(c.film, "asperity_resolution"));
        check_below("oil made up in contact", stage_quality(c.film, "contact_supply"), 0.01);
    }
    line_close(&c);
    return s;
}

int main(void)
{
    static flank f;
    flank_random(&f, 1, 0.5e-6, 60e-6, 400e-6);
    shares base = run(&f, 256, 400), quick = run(&f, 256, 1600), fine = run(&f, 512, 800);
    check_true("asperities carry a part of the load", base.asperities > 0.05);
    check_near("asperities, a quarter of the steps", base.asperities, quick.asperities, 0.05);
    check_near("asperities, half the cells", base.asperities, fine.asperities, 0.05);
    check_near("trapped oil, a quarter of the steps", base.trapped, quick.trapped, 0.05);
    check_near("trapped oil, half the cells", base.trapped, fine.trapped, 0.05);
    return check_done();
}
