/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "inlet.h"

#include "grid.h"

#include <math.h>

/* c and b of inlet.h, fitted to full solutions with M 5 to 200 and L 0 to 10. */
static const double BOUNDARY_DEPTH = 0.72, BOUNDARY_LN_ETA = 2.75;

/* Pressure counts up to this rise of ln(eta) over ambient pressure. */
static const double MOST_LN_ETA = 20;

/* Returns the pressure at which ln(eta) has risen by `rise`, at most `highest`, Pa. */
static double pressure_at(const ehl_laws *laws, const ehl_oil *oil, double rise, double highest)
{
    double low = 0, high = highest;
    for (int k = 0; k < 60; k++) {
        double p = k == 0 ? high : (low + high) / 2, ln_eta;
        laws->viscosity->eval(laws->viscosity->self, 1, &p, NULL, &ln_eta, NULL, NULL);
        if (ln_eta - oil->ln_viscosity <= rise) {
            low = p;
            if (k == 0)
                break;
        } else {
            high = p;
        }
    }
    return low;
}

/* Returns the part of q = int exp(-ln(eta/eta0)) dp over one step, exact where ln(eta) is
   linear. */
static double integral_of_exponential(double step, double left, double right)
{
    double fall = right - left;
    double mean = fabs(fall) > 1e-6 ? -expm1(-fall) / fall : 1 - fall / 2;
    return step * exp(-left) * mean;
}

ff_status ehl_inlet_fill(ehl_inlet *n, const ehl_laws *laws, const ehl_oil *oil, double alpha,
                         double highest)
{
    n->laws = *laws;
    n->oil = *oil;
    n->alpha = alpha;
    n->step = pressure_at(laws, oil, MOST_LN_ETA, highest) / (EHL_INLET_TABLE - 1);
    for (size_t i = 0; i < EHL_INLET_TABLE; i++)
        n->p[i] = (double)i * n->step;
    ff_status a = laws->viscosity->eval(laws->viscosity->self, EHL_INLET_TABLE, n->p, NULL,
                                        n->ln_eta, NULL, NULL);
    ff_status b =
        laws->density->eval(laws->density->self, EHL_INLET_TABLE, n->p, NULL, n->rho, NULL, NULL);
    n->q[0] = 0;
    for (size_t i = 1; i < EHL_INLET_TABLE; i++)
        n->q[i] =
            n->q[i - 1] + integral_of_exponential(n->step, n->ln_eta[i - 1] - oil->ln_viscosity,
                                                  n->ln_eta[i] - oil->ln_viscosity);
    return a != FF_OK ? a : b;
}

typedef struct place {
    size_t row;
    double share;
} place;

static double interpolate_column(const double *column, place at)
{
    return (1 - at.share) * column[at.row] + at.share * column[at.row + 1];
}

static place at_pressure(const ehl_inlet *n, double p)
{
    double rows = fmin(p / n->step, EHL_INLET_TABLE - 1);
    size_t row = (size_t)fmin(rows, EHL_INLET_TABLE - 2);
    return (place){row, rows - (double)row};
}

/* Finds the row with that q. q grows along the inlet, so the search goes on from the last row. */
static place at_reduced(const ehl_inlet *n, double q, size_t row)
{
    while (row < EHL_INLET_TABLE - 2 && n->q[row + 1] <= q)
        row++;
    double share = (q - n->q[row]) / (n->q[row + 1] - n->q[row]);
    return (place){row, fmin(share, 1)};
}

typedef struct gap {
    double a, film, bend; /* bend: a^2/(2R) */
    double scale;         /* of y = sqrt(s^2 - 1), where the gap has grown by the film */
} gap;

/* Returns q at the inlet boundary x = -a, where the oil arrives in the state `boundary`. */
static double reduced_pressure_at_inlet(const ehl_inlet *n, const gap *g, place boundary,
                                        double speed, double sliding)
{
    enum { NODES = 24 };
    const ff_rheology *flow = n->laws.rheology;
    double mass = interpolate_column(n->rho, boundary) * g->film,
           push = 12 * n->oil.viscosity * speed;
    double q = 0, before = 0, ds = 1. / NODES;
    place at = {0, 0};
    size_t most = boundary.row;
    for (int k = NODES - 1; k > 0; k--) { /* y = scale s/(1 - s), from far upstream to x = -a */
        double s = k * ds, y = g->scale * s / (1 - s), root = sqrt(1 + y * y);
        double h = g->film + g->bend * (y * root - asinh(y));
        double dx = g->a * y / root * g->scale / ((1 - s) * (1 - s)) * ds;
        at = at_reduced(n, q + before, at.row);
        if (at.row > most || (at.row == most && at.share > boundary.share))
            at = boundary;
        double ease = 1;
        if (flow && sliding != 0) {
            double ln_eta = interpolate_column(n->ln_eta, at), psi;
            flow->flow(flow->self, 1, &ln_eta, &h, sliding, &psi, NULL, NULL);
            ease = exp(-ln_eta) / psi;
        }
        double rise =
            push * fmax(h - mass / interpolate_column(n->rho, at), 0) / (h * h * h) * ease * dx;
        q += (before + rise) / 2;
        before = rise;
    }
    return q + before / 2;
}

static double mismatch(const ehl_inlet *n, const ehl_instant *at, double speed, double modulus,
                       double film, place *boundary)
{
    double a = ehl_hertz_half_width(at->load, at->radius, modulus);
    double p_hertz = ehl_hertz_pressure(at->load, at->radius, modulus);
    double rise = film * at->radius / (a * a);
    double y = BOUNDARY_DEPTH * BOUNDARY_DEPTH * pow(3 / (2 * sqrt(2)) * rise, 2. / 3);
    gap g = {a, film, a * a / (2 * at->radius), fmax(cbrt(3 * rise), sqrt(2 * rise))};
    double elastic = p_hertz * sqrt(2 * y / (1 + 2 * y));
    *boundary = at_pressure(n, elastic / (1 + n->alpha * elastic / BOUNDARY_LN_ETA));
    return log(reduced_pressure_at_inlet(n, &g, *boundary, speed, at->sliding) /
               interpolate_column(n->q, *boundary));
}

double ehl_inlet_mass(const ehl_inlet *n, const ehl_instant *at, double speed, double modulus,
                      double guess, double *off)
{
    enum { LIMIT = 40 };
    const double within = 1e-5; /* relative error of q at x = -a, about that of the film */
    place boundary;
    /* q at x = -a falls about as h^-11/8, and the q that it must reach grows as h^1/3 at most:
       there is one root, which the secant method seeks within the bracket of known films */
    double low = -HUGE_VAL, high = HUGE_VAL, x = log(guess), slope = -1.7;
    double now = mismatch(n, at, speed, modulus, exp(x), &boundary);
    for (int k = 0; k < LIMIT && fabs(now) > within; k++) {
        double last = now, from = x;
        low = now > 0 ? x : low;
        high = now > 0 ? high : x;
        x -= fmin(fmax(now / slope, -2), 2);
        if (x <= low || x >= high)
            x = (low + high) / 2;
        now = mismatch(n, at, speed, modulus, exp(x), &boundary);
        slope = fmin(fmax((now - last) / (x - from), -4), -0.2);
    }
    *off = now;
    /* Where a vanishes the film is that of a rigid cylinder, H = 3/M (Martin 1916), joined as by
       Moes. */
    double rigid = 6 * n->oil.viscosity * speed * at->radius / at->load;
    return n->oil.density *
           pow(pow(interpolate_column(n->rho, boundary) / n->oil.density * exp(x), 7. / 3) +
                   pow(rigid, 7. / 3),
               3. / 7);
}

double ehl_exit_ratio(double alpha, double p_hertz)
{
    return 0.725 + 0.07 / (1 + alpha * p_hertz);
}

/* Rows of a tenth in ln(eta) up to a rise of 40; from there on the tangent. */
double ehl_oil_alpha(const ehl_laws *laws, const ehl_oil *oil)
{
    const ff_viscosity *v = laws->viscosity;
    const double highest = 1e11;
    double p = 0, ln_eta = oil->ln_viscosity, slope = oil->alpha, sum = 0;
    while (p < highest && ln_eta - oil->ln_viscosity < 40) {
        double dp = fmin(fmin(0.05 / fmax(slope, 1e-12), 2e7 + p / 20), highest - p);
        double next = p + dp, ln_next;
        v->eval(v->self, 1, &next, NULL, &ln_next, &slope, NULL);
        sum += integral_of_exponential(dp, ln_eta - oil->ln_viscosity, ln_next - oil->ln_viscosity);
        p = next;
        ln_eta = ln_next;
    }
    return p < highest ? 1 / sum : 0;
}
