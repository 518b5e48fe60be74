/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The Pareto front of error and cost. */
#include "front.h"

#include <math.h>

/* A more expensive point is on the front only if its error is smaller by this factor. */
static const double least_gain = 0.95;

static bool precedes(const double *cost, const double *error, size_t a, size_t b)
{
    return cost[a] < cost[b] || (cost[a] == cost[b] && error[a] < error[b]);
}

size_t study_front(const double *cost, const double *error, size_t count, size_t *front)
{
    size_t length = 0;
    for (;;) {
        size_t next = count;
        for (size_t i = 0; i < count; i++) {
            bool usable = isfinite(cost[i]) && isfinite(error[i]) && cost[i] > 0;
            usable = usable && (length == 0 || error[i] < least_gain * error[front[length - 1]]);
            if (usable && (next == count || precedes(cost, error, i, next)))
                next = i;
        }
        if (next == count)
            return length;
        front[length++] = next;
    }
}

size_t study_front_knee(const double *cost, const double *error, const size_t *front, size_t length)
{
    size_t knee = length;
    /* relative to the diagonal; a front that bends less counts as straight */
    double farthest = 0.02;
    if (length < 3 || !(error[front[length - 1]] > 0))
        return length;
    size_t first = front[0], last = front[length - 1];
    double width = log(cost[last] / cost[first]), height = log(error[first] / error[last]);
    for (size_t i = 1; i + 1 < length; i++) {
        double x = log(cost[front[i]] / cost[first]) / width;
        double y = log(error[front[i]] / error[last]) / height;
        double below = 1 - x - y;
        if (below > farthest) {
            farthest = below;
            knee = i;
        }
    }
    return knee;
}

double study_front_excess(const double *cost, const double *error, size_t count, size_t point)
{
    double least = cost[point];
    for (size_t i = 0; i < count; i++)
        if (isfinite(cost[i]) && cost[i] > 0 && error[i] <= error[point])
            least = fmin(least, cost[i]);
    return cost[point] / least;
}
