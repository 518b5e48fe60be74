/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Evaluates the deviations of flanks. */
#include "deviations.h"

#include "../numerics/interval.h"
#include "inputs.h"

#include <flankfilm/author.h>

#include <math.h>

static bool increasing(size_t n, const double *x)
{
    for (size_t i = 0; i < n; i++)
        if (!isfinite(x[i]) || (i > 0 && !(x[i] > x[i - 1])))
            return false;
    return true;
}

static bool all_finite(size_t n, const double *x)
{
    for (size_t i = 0; i < n; i++)
        if (!isfinite(x[i]))
            return false;
    return true;
}

/* Reads the profiles of the driving flanks, or of the back flanks if `back` is set. If no back
   profiles are wired, they equal those of the driving flanks. */
static ff_status read_profiles(const ff_host *host, const ff_array *in, bool back,
                               stiffness_deviations *d)
{
    back = back && in[STIFFNESS_IN_BACK_PROFILE_ROLL].data &&
           in[STIFFNESS_IN_BACK_PROFILE_DEVIATION].data;
    const ff_array *roll = &in[back ? STIFFNESS_IN_BACK_PROFILE_ROLL : STIFFNESS_IN_PROFILE_ROLL];
    const ff_array *profile =
        &in[back ? STIFFNESS_IN_BACK_PROFILE_DEVIATION : STIFFNESS_IN_PROFILE_DEVIATION];
    if (!roll->data || !profile->data)
        return FF_OK;
    if (roll->rank != 2 || profile->rank != 2 || roll->shape[0] != 2 || profile->shape[0] != 2 ||
        roll->shape[1] != profile->shape[1] || roll->shape[1] < 2)
        return ff_failf(host, FF_INVALID, "gear.profile_deviation",
                        "two profiles are needed, each with its roll angles");
    d->points = roll->shape[1];
    for (int g = 0; g < 2; g++) {
        d->roll[g] = roll->data + (size_t)g * d->points;
        d->profile[g] = profile->data + (size_t)g * d->points;
        if (!increasing(d->points, d->roll[g]))
            return ff_failf(host, FF_INVALID, "gear.profile_roll",
                            "gear %d: the roll angles of the profile must increase", g + 1);
        if (!all_finite(d->points, d->profile[g]))
            return ff_failf(host, FF_INVALID, "gear.profile_deviation",
                            "gear %d: a deviation is not finite", g + 1);
    }
    return FF_OK;
}

ff_status stiffness_deviations_read(const ff_host *host, const ff_array *in,
                                    stiffness_deviations *d)
{
    static const char *const names[] = {"gear.pitch_deviation_1", "gear.pitch_deviation_2"};
    *d = (stiffness_deviations){0};
    for (int g = 0; g < 2; g++) {
        const ff_array *index = &in[STIFFNESS_IN_INDEX_1 + g];
        if (!index->data)
            continue;
        double teeth = 0;
        ff_status status = stiffness_input_read(host, in, STIFFNESS_IN_TEETH, (size_t)g, &teeth);
        if (status != FF_OK)
            return status;
        if (index->rank != 1 || index->shape[0] != (size_t)lround(teeth) ||
            !all_finite(index->shape[0], index->data))
            return ff_failf(host, FF_INVALID, names[g],
                            "one finite deviation is needed for each of the %g teeth", teeth);
        d->teeth[g] = index->shape[0];
        for (size_t i = 0; i < d->teeth[g]; i++)
            if (fabs(index->data[i]) > 0)
                d->index[g] = index->data;
        if (d->index[g] && in[STIFFNESS_IN_FORCE].data[0] < 0)
            return ff_failf(host, FF_UNSUPPORTED, names[g],
                            "index deviations are supported on driving flanks only, but the torque "
                            "is below 0: write gear 2 of the file as gear 1, with a torque above "
                            "0, or leave pitch_error out");
    }
    return read_profiles(host, in, in[STIFFNESS_IN_FORCE].data[0] < 0, d);
}

static bool same_profiles(const stiffness_deviations *a, const stiffness_deviations *z)
{
    if (a->points != z->points)
        return false;
    for (int g = 0; g < 2; g++)
        for (size_t i = 0; i < a->points; i++)
            if (a->roll[g][i] != z->roll[g][i] || a->profile[g][i] != z->profile[g][i])
                return false;
    return true;
}

ff_status stiffness_deviations_read_back(const ff_host *host, const ff_array *in,
                                         const stiffness_deviations *d, stiffness_deviations *back,
                                         bool *same)
{
    *back = (stiffness_deviations){0};
    ff_status status = read_profiles(host, in, !(in[STIFFNESS_IN_FORCE].data[0] < 0), back);
    *same = status == FF_OK && same_profiles(d, back);
    return status;
}

double stiffness_profile_deviation(const stiffness_deviations *d, int gear, double roll)
{
    if (d->points == 0)
        return 0;
    const double *x = d->roll[gear], *y = d->profile[gear];
    if (roll <= x[0])
        return y[0];
    if (roll >= x[d->points - 1])
        return y[d->points - 1];
    size_t low = numerics_interval(d->points, x, roll), high = low + 1;
    return y[low] + (y[high] - y[low]) * (roll - x[low]) / (x[high] - x[low]);
}

double stiffness_index_deviation(const stiffness_deviations *d, long number)
{
    double sum = 0;
    for (int g = 0; g < 2; g++) {
        if (!d->index[g])
            continue;
        long teeth = (long)d->teeth[g], tooth = number % teeth;
        sum += d->index[g][tooth < 0 ? tooth + teeth : tooth];
    }
    return sum;
}

/* The hunting period is the least common multiple of the numbers of teeth if both gears have
 * index deviations. */
size_t stiffness_hunting_period(const stiffness_deviations *d)
{
    if (!d->index[0] || !d->index[1])
        return d->index[0] ? d->teeth[0] : d->index[1] ? d->teeth[1] : 1;
    size_t a = d->teeth[0], b = d->teeth[1];
    while (b) {
        size_t rest = a % b;
        a = b;
        b = rest;
    }
    return d->teeth[0] / a * d->teeth[1];
}

size_t stiffness_profile_corners(const stiffness_deviations *d, int gear, double *roll, size_t room)
{
    /* minimum change of slope at a corner, relative to the range of slopes */
    const double share = 0.05;
    double least = INFINITY, most = -INFINITY;
    size_t found = 0;
    const double *x = d->roll[gear], *y = d->profile[gear];
    for (size_t i = 1; i < d->points; i++) {
        double slope = (y[i] - y[i - 1]) / (x[i] - x[i - 1]);
        least = fmin(least, slope);
        most = fmax(most, slope);
    }
    for (size_t i = 1; i + 1 < d->points && found < room; i++) {
        double before = (y[i] - y[i - 1]) / (x[i] - x[i - 1]);
        double after = (y[i + 1] - y[i]) / (x[i + 1] - x[i]);
        if (most > least && fabs(after - before) > share * (most - least))
            roll[found++] = x[i];
    }
    return found;
}
