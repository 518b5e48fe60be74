/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The solver computes heights as differences of the integral of the height, and the travel of a
   flank from sums over the rows of the history (surface.c). In this file the samples in a cell are
   added one by one, and the travel is summed from the first row. */
#include "roughness-check.h"

#include <math.h>

/* Returns the travel of a flank since the first row. Its speed is constant before the first row and
   after the last. */
static double way_of(const ehl_history *h, const double *speed, double time)
{
    size_t last = h->count - 1;
    double way = (fmin(time, h->time[0]) - h->time[0]) * speed[0] +
                 (fmax(time, h->time[last]) - h->time[last]) * speed[last];
    for (size_t i = 0; i < last && h->time[i] < time; i++) {
        double span = h->time[i + 1] - h->time[i], part = fmin(time - h->time[i], span);
        double end = span > 0 ? speed[i] + part / span * (speed[i + 1] - speed[i]) : speed[i];
        way += part * (speed[i] + end) / 2;
    }
    return way;
}

/* Returns a height of a record; 0 beyond the ends of a record that does not repeat. */
static double sample(const ehl_roughness *r, const double *z, double number)
{
    double count = (double)r->count;
    if (r->period > 0)
        number -= count * floor(number / count);
    return number >= 0 && number < count ? z[(size_t)number] : 0;
}

/* Returns the mean of the straight lines between the samples. */
static double mean_height(const ehl_roughness *r, const double *z, double from, double to)
{
    double sum = 0, d = r->spacing, last = (double)r->count - 1;
    for (double k = floor(from / d); k * d < to; k += 1) {
        double a = fmax(from / d - k, 0), e = fmin(to / d - k, 1), middle = (a + e) / 2;
        if (r->period > 0 || (k >= 0 && k < last))
            sum += (e - a) * (sample(r, z, k) * (1 - middle) + sample(r, z, k + 1) * middle);
    }
    return sum * d / (to - from);
}

double ehl_traces_height(const ehl_roughness *r, double x, double width, double time)
{
    const ehl_history *h = r->history;
    int mirrored =
        h->speed_1[0] + h->speed_2[0] < 0; /* a rough film never reverses or begins at rest */
    double height = 0, place = mirrored ? -x : x, carried = 0;
    for (int g = 0; g < 2; g++) {
        double way = way_of(h, g ? h->speed_2 : h->speed_1, time), s = r->origin - way + place;
        height += mean_height(r, r->height[g], s - width / 2, s + width / 2);
        carried += way / 2;
    }
    double in = r->ramp > 0 ? (x - r->front - (mirrored ? -carried : carried)) / r->ramp : 0;
    return in <= 0 ? height : in < 1 ? height * (1 - in) * (1 - in) * (1 + 2 * in) : 0;
}
