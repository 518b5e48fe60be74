/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Samples the profiles of the flanks: reliefs, crown, slope and measured curves. */
#include "flank-deviations.h"

#include "drawing-rounding.h"

#include "../numerics/interval.h"

#include <flankfilm/author.h>

#include <math.h>
#include <stdlib.h>

/* Steps of a curved profile. Straight lines between the points deviate from a parabola of height A
   by at most A/(4 PROFILE_STEPS^2). */
enum {
    PROFILE_STEPS = 2048,
    MORE_POINTS = 8 /* largest number of additional points, for the starts
                       and ends of reliefs */
};

static const double degree = M_PI / 180;

/* rad; closer roll angles are treated as equal */
static const double same_roll = 1e-9;

/* Sets the roll angles between which each flank is in contact. On the path of contact, the tip
 * of gear 2 meets the start of the flank of gear 1. */
static void set_limits(const gear_spur_pair *p, double lpstc[2], double hpstc[2], gear_flanks *f)
{
    double r1 = p->base_radius[0], r2 = p->base_radius[1], length = p->line_length;
    f->low[0] = p->sap / r1;
    f->high[0] = p->tip / r1;
    lpstc[0] = p->lpstc / r1;
    hpstc[0] = p->hpstc / r1;
    f->low[1] = (length - p->tip) / r2;
    f->high[1] = (length - p->sap) / r2;
    lpstc[1] = (length - p->hpstc) / r2;
    hpstc[1] = (length - p->lpstc) / r2;
}

/* One end of a flank, with the parameters that describe its relief. */
typedef struct relief_end {
    bool tip;
    const char *start, *diameter, *length;
} relief_end;

static const relief_end tip_end = {true, "tip_relief_start", "tip_relief_diameter",
                                   "tip_relief_length"};
static const relief_end back_end = {true, "back_relief_start", "back_relief_diameter",
                                    "back_relief_length"};
static const relief_end root_end = {false, "root_relief_start", "root_relief_diameter",
                                    "root_relief_length"};

/* The start of a relief as the drawing gives it (`value`), the two ends of the flank as the same
   quantity (`from`, `to`), and the rounding of the drawing (`open`). For messages all four are
   multiplied by `scale`, which gives the unit `unit`. */
typedef struct stated_start {
    const char *item, *what, *unit;
    double value, from, to, open, scale;
} stated_start;

static double diameter_at(double base, double roll)
{
    return 2 * base * hypot(1, roll);
}

/* Returns the roll angle at which a relief of gear g starts, from any of the three ways to give
   it. */
static double stated_roll(const gear_flanks *f, const gear_relief *r, const relief_end *end, int g,
                          double base, stated_start *s)
{
    const double low = f->low[g], high = f->high[g];
    if (r->diameter.count > 0) {
        const double d = ff_of_both(&r->diameter, g);
        *s = (stated_start){end->diameter,
                            "diameter",
                            "mm",
                            d,
                            diameter_at(base, low),
                            diameter_at(base, high),
                            gear_rounding_diameter,
                            1e3};
        return sqrt(fmax((d / 2 - base) * (d / 2 + base), 0)) / base;
    }
    if (r->length.count > 0) {
        const double from_end = ff_of_both(&r->length, g);
        *s = (stated_start){end->length,
                            "length along the line of action",
                            "mm",
                            from_end,
                            0,
                            (high - low) * base,
                            gear_rounding_diameter,
                            1e3};
        return end->tip ? high - from_end / base : low + from_end / base;
    }
    const double roll = ff_of_both(&r->start, g);
    *s = (stated_start){end->start, "roll angle",       "deg",     roll, low,
                        high,       gear_rounding_roll, 1 / degree};
    return roll;
}

/* Finds where the relief at one end of the flank of gear g begins. */
static ff_status set_start(const ff_host *host, gear_flanks *f, const gear_relief *relief,
                           const relief_end *end, int g, double base, double preset, double *start)
{
    const double last = end->tip ? f->high[g] : f->low[g];
    stated_start s = {.item = end->start};
    *start = preset;
    if (relief->start.count + relief->diameter.count + relief->length.count > 0) {
        const double roll = stated_roll(f, relief, end, g, base, &s);
        if (!(s.value >= s.from - s.open && s.value <= s.to + s.open))
            return ff_failf(host, FF_INVALID, s.item,
                            "gear %d: the relief starts at the %s %.4f %s, but its flank is in "
                            "contact from %.4f to %.4f %s; the relief must start there",
                            g + 1, s.what, s.value * s.scale, s.unit, s.from * s.scale,
                            s.to * s.scale, s.unit);
        *start = fmin(fmax(roll, f->low[g]), f->high[g]);
        f->moved_start = fmax(f->moved_start, fabs(*start - roll));
    }
    if (ff_of_both(&relief->amount, g) > 0 && fabs(last - *start) <= same_roll)
        return ff_failf(host, FF_INVALID, s.item,
                        "gear %d: the relief starts where it ends, at the roll angle %.4f deg; set "
                        "%s to a point on the flank, between %.4f and %.4f deg",
                        g + 1, *start / degree, s.item, f->low[g] / degree, f->high[g] / degree);
    return FF_OK;
}

static ff_status set_reliefs(const ff_host *host, const gear_flank_spec *s, const gear_spur_pair *p,
                             gear_flanks *f)
{
    double lpstc[2], hpstc[2];
    set_limits(p, lpstc, hpstc, f);
    for (int g = 0; g < 2; g++) {
        const double base = p->base_radius[g];
        ff_status status = set_start(host, f, &s->tip, s->back ? &back_end : &tip_end, g, base,
                                     hpstc[g], &f->tip_start[g]);
        if (status == FF_OK)
            status = set_start(host, f, &s->root, &root_end, g, base, lpstc[g], &f->root_start[g]);
        if (status != FF_OK)
            return status;
    }
    return FF_OK;
}

/* Returns the metal that a relief removes at the roll angle `beyond` from its start; `length` is
   the roll angle from its start to the end of the flank. */
static double relieve(const gear_relief *relief, int g, double beyond, double length)
{
    double u = length > 0 ? fmin(beyond / length, 1) : 0;
    return u > 0 ? ff_of_both(&relief->amount, g) * (relief->shape == 1 ? u * u : u) : 0;
}

/* Returns the deviation of a measured curve. Beyond its ends, the first or the last value
   applies. */
static double curve_at(const gear_curve *c, double roll)
{
    if (c->count == 0)
        return 0;
    if (roll <= c->roll[0])
        return c->deviation[0];
    if (roll >= c->roll[c->count - 1])
        return c->deviation[c->count - 1];
    size_t low = numerics_interval(c->count, c->roll, roll), high = low + 1;
    double t = (roll - c->roll[low]) / (c->roll[high] - c->roll[low]);
    return c->deviation[low] + t * (c->deviation[high] - c->deviation[low]);
}

/* Returns the deviation of the profile at a roll angle. u is 0 at the lowest contact and 1 at the
   tip. */
static double deviation_at(const gear_flank_spec *s, const gear_flanks *f, int g, double roll)
{
    double u = (roll - f->low[g]) / (f->high[g] - f->low[g]);
    double off = relieve(&s->tip, g, roll - f->tip_start[g], f->high[g] - f->tip_start[g]) +
                 relieve(&s->root, g, f->root_start[g] - roll, f->root_start[g] - f->low[g]) +
                 ff_of_both(&s->crown, g) * (2 * u - 1) * (2 * u - 1);
    return ff_of_both(&s->slope, g) * (u - 0.5) - off + curve_at(&f->measured[g], roll);
}

static int by_value(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Sets the roll angles at which the profile is sampled: equal steps, starts of reliefs, points
 * of the measured curve. Returns their number. */
static size_t place_points(const gear_flank_spec *s, const gear_flanks *f, int g, double *roll)
{
    const gear_curve *c = &f->measured[g];
    double low = f->low[g], high = f->high[g], apart = 1e-9 * (high - low);
    size_t count = 0, kept = 0;
    for (int i = 0; i <= PROFILE_STEPS; i++)
        roll[count++] = i == PROFILE_STEPS ? high : low + (high - low) * i / PROFILE_STEPS;
    if (ff_of_both(&s->tip.amount, g) > 0)
        roll[count++] = f->tip_start[g];
    if (ff_of_both(&s->root.amount, g) > 0)
        roll[count++] = f->root_start[g];
    for (size_t i = 0; i < c->count; i++)
        if (c->roll[i] > low && c->roll[i] < high)
            roll[count++] = c->roll[i];
    qsort(roll, count, sizeof *roll, by_value);
    for (size_t i = 0; i < count; i++)
        if (kept == 0 || roll[i] - roll[kept - 1] > apart)
            roll[kept++] = roll[i];
    return kept;
}

/* Extends a list of roll angles to the length of the other profile's list by halving its widest
   gaps. */
static void fill_points(double *roll, size_t count, size_t wanted)
{
    for (; count < wanted; count++) {
        size_t widest = 1;
        for (size_t i = 2; i < count; i++)
            if (roll[i] - roll[i - 1] > roll[widest] - roll[widest - 1])
                widest = i;
        for (size_t i = count; i > widest; i--)
            roll[i] = roll[i - 1];
        roll[widest] = (roll[widest - 1] + roll[widest + 1]) / 2;
    }
}

static bool is_perfect(const gear_flank_spec *s, const gear_flanks *f)
{
    for (int g = 0; g < 2; g++)
        if (ff_of_both(&s->tip.amount, g) > 0 || ff_of_both(&s->root.amount, g) > 0 ||
            ff_of_both(&s->crown, g) > 0 || fabs(ff_of_both(&s->slope, g)) > 0 ||
            f->measured[g].count > 0)
            return false;
    return true;
}

static ff_status sample(const gear_flank_spec *s, gear_flanks *f)
{
    size_t room = PROFILE_STEPS + MORE_POINTS, count[2];
    for (int g = 0; g < 2; g++)
        room = room < PROFILE_STEPS + MORE_POINTS + f->measured[g].count
                   ? PROFILE_STEPS + MORE_POINTS + f->measured[g].count
                   : room;
    for (int g = 0; g < 2; g++) {
        f->roll[g] = malloc(room * sizeof *f->roll[g]);
        f->deviation[g] = malloc(room * sizeof *f->deviation[g]);
        if (!f->roll[g] || !f->deviation[g])
            return FF_NOMEM;
        count[g] = 2;
        f->roll[g][0] = f->low[g];
        f->roll[g][1] = f->high[g];
        if (!is_perfect(s, f))
            count[g] = place_points(s, f, g, f->roll[g]);
    }
    f->points = count[0] > count[1] ? count[0] : count[1];
    for (int g = 0; g < 2; g++) {
        fill_points(f->roll[g], count[g], f->points);
        for (size_t i = 0; i < f->points; i++)
            f->deviation[g][i] = deviation_at(s, f, g, f->roll[g][i]);
    }
    return FF_OK;
}

static ff_status check_index(const ff_host *host, const gear_flank_spec *s,
                             const gear_spur_spec *gears)
{
    static const char *const items[] = {"pitch_error", "pitch_error_2"};
    for (int g = 0; g < 2; g++)
        if ((double)s->index[g].count > ff_of_both(&gears->teeth, g))
            return ff_failf(host, FF_INVALID, items[g],
                            "%zu index deviations for the %g teeth of gear %d: give at most one "
                            "per tooth",
                            s->index[g].count, ff_of_both(&gears->teeth, g), g + 1);
    return FF_OK;
}

bool gear_flanks_have_back(const gear_relief *back)
{
    return back->amount.count + back->start.count + back->diameter.count + back->length.count > 0 ||
           back->shape >= 0;
}

gear_flank_spec gear_flanks_back(const gear_flank_spec *driving, const gear_relief *back)
{
    gear_flank_spec s = *driving;
    s.back = true;
    if (back->amount.count > 0)
        s.tip.amount = back->amount;
    if (back->shape >= 0)
        s.tip.shape = back->shape;
    if (back->start.count + back->diameter.count + back->length.count > 0) {
        s.tip.start = back->start;
        s.tip.diameter = back->diameter;
        s.tip.length = back->length;
    }
    return s;
}

ff_status gear_flanks_make(const ff_host *host, const gear_flank_spec *spec,
                           const gear_spur_spec *gears, const gear_spur_pair *pair,
                           gear_flanks *flanks)
{
    *flanks = (gear_flanks){0};
    ff_status status = set_reliefs(host, spec, pair, flanks);
    if (status == FF_OK)
        status = check_index(host, spec, gears);
    if (status == FF_OK && spec->file)
        status = gear_curves_read(host, "profile_file", spec->file, flanks->measured);
    return status == FF_OK ? sample(spec, flanks) : status;
}

void gear_flanks_free(gear_flanks *f)
{
    for (int g = 0; g < 2; g++) {
        free(f->measured[g].roll);
        free(f->measured[g].deviation);
        free(f->roll[g]);
        free(f->deviation[g]);
    }
    *f = (gear_flanks){0};
}
