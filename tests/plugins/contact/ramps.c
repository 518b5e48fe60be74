/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Load ramps where the number of tooth pairs changes in quick succession, and where three pairs
   carry the load. */
#include "check.h"
#include "pair.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { MOST = 1000 };

static const double degree = M_PI / 180, line_force = 6000, width = 0.02;

/* Sets equal forces of all pairs in contact; their number alternates between 1 + floor(contact
   ratio) and one less. */
static void share_equally(pair *p, double *load)
{
    size_t n;
    const double *roll = pair_stations(p, &n);
    int few = (int)stage_scalar(p->gear, "contact_ratio"), fewer = 0;
    for (size_t i = 0; i < n; i++) {
        fewer ^= i > 0 && roll[i] == roll[i - 1];
        load[i] = line_force / (fewer ? few : few + 1);
    }
    stage_give_series(p->tooth, "load.tooth_force", n, load);
}

typedef struct shape {
    double low, high, steepest, integral; /* N, N/deg, N deg */
    int ramps;                            /* number of increases and decreases */
} shape;

static shape shape_of(const stage *tooth)
{
    size_t n;
    const double *x = stage_get(tooth, "roll_angle", &n);
    const double *w = stage_get(tooth, "load_per_width", NULL);
    shape s = {w[0] * width, w[0] * width, 0, 0, 0};
    int was = 0;
    for (size_t i = 1; i < n; i++) {
        double rise = (w[i] - w[i - 1]) * width, run = (x[i] - x[i - 1]) / degree;
        int is = (rise > 1e-6) - (rise < -1e-6);
        s.low = fmin(s.low, w[i] * width);
        s.high = fmax(s.high, w[i] * width);
        s.steepest = fmax(s.steepest, fabs(rise) / run);
        s.integral += (w[i] + w[i - 1]) / 2 * width * run;
        s.ramps += is && is != was;
        was = is;
    }
    return s;
}

/* Three pairs in contact from 0 to e, 1 to 1 + e and 2 to 2 + e mesh cycles after the begin of
   contact, e = 0.3, else two; a mesh cycle is 7.2 deg. */
static void check_three_pairs(void)
{
    static double load[MOST];
    pair p = pair_open_long("158.1296303054628 mm");
    share_equally(&p, load);
    check_near("contact ratio", stage_scalar(p.gear, "contact_ratio"), 2.3, 1e-12);
    if (check_true("three pairs run", stage_run_wanted(p.tooth, pair_dry) == FF_OK)) {
        shape s = shape_of(p.tooth);
        check_near("three pairs", s.low, line_force / 3, 1e-12);
        check_near("two pairs", s.high, line_force / 2, 1e-12);
        check_true("four changes", s.ramps == 4);
        check_near("ramps of 0.2 deg", s.steepest, line_force / 6 / 0.2, 1e-8);
        check_near("centred ramps keep the integral", s.integral,
                   line_force * 7.2 * (3 * 0.3 / 3 + 2 * 0.7 / 2), 1e-12);
    }
    pair_close(&p);
}

/* Single contact lasts 0.01 * 7.2 deg. */
static void check_short_zone(void)
{
    static double load[MOST];
    pair p = pair_open_long("156.90431876893427 mm");
    share_equally(&p, load);
    if (check_true("the preset ramp fits itself in",
                   stage_run_wanted(p.tooth, pair_dry) == FF_OK)) {
        shape s = shape_of(p.tooth);
        check_near("to half of the zone", s.steepest, line_force / 2 / 0.036, 1e-7);
        check_near("up to the whole force", s.high, line_force, 1e-12);
        check_near("integral", s.integral, line_force * 7.2 * (0.01 + 2 * 0.99 / 2), 1e-12);
    }
    pair_close(&p);
    p = pair_open_long("156.90431876893427 mm");
    share_equally(&p, load);
    stage_set_text(p.tooth, "load_ramp", "0.2 deg");
    check_true("the same, asked for, is refused",
               stage_run_wanted(p.tooth, pair_dry) == FF_INVALID &&
                   !strcmp(stage_why_item(p.tooth), "load_ramp") &&
                   strstr(stage_why(p.tooth), "less than 0.072 deg"));
    pair_close(&p);
}

/* Three pairs in contact for 1e-8 of a pitch: too short to appear in a history. */
static void check_no_zone(const char *ramp)
{
    static double load[MOST];
    pair p = pair_open_long("156.94324465087146 mm");
    share_equally(&p, load);
    if (ramp)
        stage_set_text(p.tooth, "load_ramp", ramp);
    if (check_true("zones of no account run", stage_run_wanted(p.tooth, pair_dry) == FF_OK)) {
        shape s = shape_of(p.tooth);
        check_near("least load", s.low, line_force / 2, 1e-12);
        check_near("largest load", s.high, line_force / 2, 1e-12);
    }
    pair_close(&p);
}

int main(void)
{
    check_three_pairs();
    check_short_zone();
    check_no_zone(NULL);
    check_no_zone("0 deg");
    check_no_zone("1 deg");
    return check_done();
}
