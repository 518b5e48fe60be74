/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Exact harmonics of the pieces of the mesh cycle, and samples computed from these harmonics. */
#include "harmonics-samples.h"

#include "../excitation/spring.h"

#include <math.h>
#include <string.h>

/* Adds the contribution of one node to the exact harmonics n > 0 of a piecewise polynomial.
   `jump` contains the jumps of the value and of its derivatives with respect to theta at the
   node. Repeated integration by parts gives c_n = sum exp(-i n theta) sum_j jump_j/(2 pi (i
   n)^(j + 1)). The phase factor follows a recurrence, which is restarted every 64 harmonics to
   limit round-off. */
static void add_jump(double complex *c, size_t count, double theta,
                     const double jump[DYNAMICS_DEGREE + 1], int degree)
{
    double turn_x = cos(theta), turn_y = -sin(theta), x = 1, y = 0;
    for (size_t n = 1; n < count; n++) {
        double m = (double)n, keep = x;
        x = n % 64 ? keep * turn_x - y * turn_y : cos(m * theta);
        y = n % 64 ? keep * turn_y + y * turn_x : -sin(m * theta);
        /* 1/i^(j + 1) is -i, -1, i, 1, ...: the sum is -u - i v */
        double power = 1 / (2 * M_PI), u = 0, v = 0;
        for (int j = 0; j <= degree; j++) {
            power /= m;
            *(j % 2 ? &u : &v) += (j / 2 % 2 ? -1 : 1) * power * jump[j];
        }
        c[n] += y * v - x * u - I * (x * v + y * u);
    }
}

/* A curve given by the pieces: e, or slope or offset of one line of the spring. */
enum { CURVE_E, CURVE_SLOPE, CURVE_OFFSET };
typedef struct curve {
    int which;
    size_t line;
} curve;

static const double *coefficients_of(const dynamics_piece *p, curve c)
{
    if (c.which == CURVE_E)
        return p->e;
    if (c.which == CURVE_OFFSET)
        return p->line[c.line].offset;
    return dynamics_spring_slope(p, (int)c.line);
}

/* Returns the integral of a curve over a piece. */
static double integral_of(const dynamics_piece *p, curve which)
{
    const double *c = coefficients_of(p, which);
    double sum = 0;
    for (int i = p->degree; i >= 0; i--)
        sum = (c[i] / (i + 1) + sum) * p->length;
    return sum;
}

/* Computes the harmonics 0 to count - 1 of a curve. */
static void exact_harmonics(const dynamics_excitation *excitation, curve which, double complex *c,
                            size_t count)
{
    memset(c, 0, count * sizeof *c);
    for (size_t i = 0; i < excitation->count; i++) {
        const dynamics_piece *p = &excitation->pieces[i],
                             *before = &excitation->pieces[i ? i - 1 : excitation->count - 1];
        const double *a = coefficients_of(before, which), *z = coefficients_of(p, which);
        double end[DYNAMICS_DEGREE + 1] = {0}, jump[DYNAMICS_DEGREE + 1], derivative = 1;
        int degree = before->degree > p->degree ? before->degree : p->degree, jumps = 0;
        dynamics_piece_shift(a, before->degree, before->length, 1, end);
        for (int j = 0; j <= degree; j++) {
            jump[j] = derivative * ((j <= p->degree ? z[j] : 0) - end[j]);
            jumps |= jump[j] != 0;
            derivative *= (j + 1) / (2 * M_PI);
        }
        c[0] += integral_of(p, which);
        if (jumps)
            add_jump(c, count, 2 * M_PI * p->start, jump, degree);
    }
}

static void sample_curve(dynamics_harmonics *b, int which, size_t line, double *samples)
{
    size_t half = b->samples / 2;
    b->spectrum[half] = 0;
    exact_harmonics(b->excitation, (curve){which, line}, b->spectrum, half);
    fftw_execute_dft_c2r(b->to_time, b->spectrum, samples);
}

void dynamics_harmonics_sample(dynamics_harmonics *b)
{
    size_t half = b->samples / 2;
    for (size_t i = 0; i < b->lines; i++) {
        sample_curve(b, CURVE_SLOPE, i, b->slope + i * b->samples);
        if (i > 0)
            sample_curve(b, CURVE_OFFSET, i, b->offset + i * b->samples);
    }
    b->spectrum[half] = 0;
    exact_harmonics(b->excitation, (curve){CURVE_E, 0}, b->spectrum, half);
    b->e_series[0] = creal(b->spectrum[0]);
    for (size_t n = 1; n <= b->harmonics; n++) {
        b->e_series[2 * n - 1] = 2 * creal(b->spectrum[n]);
        b->e_series[2 * n] = -2 * cimag(b->spectrum[n]);
    }
    fftw_execute_dft_c2r(b->to_time, b->spectrum, b->e);
}
