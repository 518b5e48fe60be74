/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "slope.h"

#include <float.h>
#include <math.h>
#include <string.h>

double conformance_value_at(const conformance_line *l, double x, double out[CONFORMANCE_RESULTS])
{
    double point[CONFORMANCE_AXES];
    const double *in[CONFORMANCE_AXES];
    double *results[CONFORMANCE_RESULTS];
    memcpy(point, l->point, sizeof point);
    point[l->axis] = x;
    for (size_t i = 0; i < CONFORMANCE_AXES; i++)
        in[i] = &point[i];
    for (size_t i = 0; i < CONFORMANCE_RESULTS; i++)
        results[i] = &out[i];
    l->function->call(l->table, 1, in, l->speed, results);
    return out[0];
}

/* Ridders 1982, Adv. Eng. Software 4, 75-76: central differences extrapolated to h = 0; *error
   bounds the remaining truncation and rounding error. */
static double difference(const conformance_line *l, double x, double h, double *error)
{
    enum { ROWS = 8 };
    double table[ROWS][ROWS], best = 0, out[CONFORMANCE_RESULTS];
    *error = INFINITY;
    for (int row = 0; row < ROWS; row++, h /= 1.6) {
        double above = conformance_value_at(l, x + h, out),
               below = conformance_value_at(l, x - h, out), factor = 1;
        double rounding = 64 * DBL_EPSILON * fmax(fabs(above), fabs(below)) / h;
        table[row][0] = (above - below) / (2 * h);
        for (int i = 1; i <= row; i++) {
            factor *= 1.6 * 1.6;
            table[row][i] = (table[row][i - 1] * factor - table[row - 1][i - 1]) / (factor - 1);
            double gap = fmax(fabs(table[row][i] - table[row][i - 1]),
                              fabs(table[row][i] - table[row - 1][i - 1]));
            if (gap + rounding < *error) {
                *error = gap + rounding;
                best = table[row][i];
            }
        }
    }
    return best;
}

int conformance_compare_slope(const conformance_line *l, double claimed, double h, double *found)
{
    double error;
    *found = difference(l, l->point[l->axis], h, &error);
    double size = fmax(fabs(claimed), fabs(*found));
    if (!(4 * error < 3e-4 * size))
        return fabs(claimed - *found) <= 4 * error ? 0 : 2;
    return fabs(claimed - *found) <= 1e-4 * size + 4 * error ? 0 : 1;
}
