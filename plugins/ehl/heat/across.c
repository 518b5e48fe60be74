/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "across.h"

#include <math.h>
#include <string.h>

static const double pi = 3.14159265358979323846;

/* Returns Legendre's P_n(x), with P_(n-1)(x) in *before. */
static double legendre(size_t n, double x, double *before)
{
    double last = 1, now = x;
    for (size_t k = 2; k <= n; k++) {
        double next = ((2 * (double)k - 1) * x * now - ((double)k - 1) * last) / (double)k;
        last = now;
        now = next;
    }
    *before = last;
    return now;
}

/* Returns the polynomial that is 1 at node l and 0 at the other nodes, evaluated at z. */
static double one_at(const ehl_across *a, size_t l, double z)
{
    double product = 1;
    for (size_t k = 0; k < a->count; k++)
        if (k != l)
            product *= (z - a->z[k]) / (a->z[l] - a->z[k]);
    return product;
}

/* Computes the roots of (1 - x^2) P'_n(x) by Newton's method, starting from the Chebyshev points.
   It uses (1 - x^2) P'_n = n (P_(n-1) - x P_n), whose derivative is -n (n + 1) P_n. */
static void place(ehl_across *a)
{
    size_t n = a->count - 1;
    for (size_t k = 0; k <= n; k++) {
        double x = -cos(pi * (double)k / (double)n), before;
        for (int turn = 0; turn < 50 && k > 0 && k < n; turn++)
            x -= (x * legendre(n, x, &before) - before) /
                 ((double)(n + 1) * legendre(n, x, &before));
        double value = legendre(n, x, &before);
        a->z[k] = (1 + x) / 2;
        a->weight[k] = 1 / ((double)(n * (n + 1)) * value * value);
    }
    a->z[0] = 0;
    a->z[n] = 1;
}

/* Sets the stiffness of a spectral vanishing viscosity (Tadmor 1989; Maday, Ould Kaber & Tadmor
   1993). This artificial conduction acts only on modes above sqrt(count), which a resolved
   temperature does not contain. */
static void damp_highest(ehl_across *a)
{
    size_t n = a->count, last = n - 2, first = (size_t)sqrt((double)n);
    for (size_t j = first + 1; j <= last; j++) {
        double away = (double)(last - j) / (double)(j - first), part[EHL_ACROSS_MOST] = {0}, before;
        for (size_t m = 0; m < n; m++)
            for (size_t l = 0; l < n; l++)
                part[l] += a->weight[m] * legendre(j, 2 * a->z[m] - 1, &before) * a->slope[l][m];
        for (size_t l = 0; l < n; l++)
            for (size_t k = 0; k < n; k++)
                a->damping[l][k] += (2 * (double)j + 1) * exp(-away * away) * part[l] * part[k];
    }
}

void ehl_across_create(ehl_across *a, size_t count)
{
    memset(a, 0, sizeof *a);
    a->count = count;
    place(a);
    for (size_t l = 0; l < count; l++) {
        double sum = 0;
        for (size_t k = 0; k < count; k++) {
            double product = 1;
            for (size_t j = 0; j < count && k != l; j++)
                if (j != l)
                    product *= j == k ? 1 : (a->z[k] - a->z[j]);
            for (size_t j = 0; j < count && k != l; j++)
                if (j != l)
                    product /= a->z[l] - a->z[j];
            if (k != l) {
                a->slope[l][k] = product;
                sum += 1 / (a->z[l] - a->z[k]);
            }
            for (size_t m = 0; m < count; m++)
                a->integral[l][k] += a->z[k] * a->weight[m] * one_at(a, l, a->z[k] * a->z[m]);
        }
        a->slope[l][l] = sum;
    }
    for (size_t k = 0; k < EHL_ACROSS_FINE; k++) {
        double sum = 0;
        for (size_t l = 0; l < count; l++)
            sum += fabs(a->fine[k][l] = one_at(a, l, (double)k / (EHL_ACROSS_FINE - 1)));
        a->swing = fmax(a->swing, sum);
    }
    for (size_t k = 0; k < count; k++)
        for (size_t l = 0; l < count; l++)
            for (size_t m = 0; m < count; m++)
                a->stiffness[k][l] += a->weight[m] * a->slope[k][m] * a->slope[l][m];
    damp_highest(a);
}

double ehl_across_highest(const ehl_across *a, const double *values, double most)
{
    double low = values[0], high = values[0];
    for (size_t l = 1; l < a->count; l++) {
        low = values[l] < low ? values[l] : low;
        high = values[l] > high ? values[l] : high;
    }
    if ((high + low) / 2 + a->swing * (high - low) / 2 < most)
        return most;
    for (size_t k = 0; k < EHL_ACROSS_FINE; k++) {
        double here = 0;
        for (size_t l = 0; l < a->count; l++)
            here += a->fine[k][l] * values[l];
        most = fmax(most, here);
    }
    return most;
}

void ehl_across_move(const ehl_across *a, const ehl_across *other, size_t columns,
                     const double *values, double *to)
{
    const size_t n = a->count, m = other->count;
    double one[EHL_ACROSS_MOST];
    memset(to, 0, columns * m * sizeof *to);
    for (size_t k = 0; k < m; k++) {
        for (size_t l = 0; l < n; l++)
            one[l] = one_at(a, l, other->z[k]);
        for (size_t i = 0; i < columns; i++)
            for (size_t l = 0; l < n; l++)
                to[i * m + k] += one[l] * values[i * n + l];
    }
}
