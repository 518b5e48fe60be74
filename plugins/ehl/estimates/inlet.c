/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "inlet.h"

#include "../contact/grid.h"
#include "inlet-heat.h"

#include <flankfilm/simd.h>

#include <math.h>
#include <stdio.h>

/* The constants c and b of inlet.h, fitted to full solutions with M 5 to 200 and L 0 to 10. */
static const double BOUNDARY_DEPTH = 0.72, BOUNDARY_LN_ETA = 2.75;

/* The integral over pressure ends at this rise of ln(eta) over its value at ambient pressure. */
static const double MOST_LN_ETA = 20;

/* Returns the pressure at which ln(eta) has increased by `rise`, but at most `highest`, Pa. */
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

ff_status ehl_inlet_fill(ehl_inlet *n, const ehl_laws *laws, const ehl_oil *oil, double alpha,
                         double conductivity, double highest)
{
    n->laws = *laws;
    n->oil = *oil;
    n->alpha = alpha;
    n->conductivity = conductivity;
    n->step = pressure_at(laws, oil, MOST_LN_ETA, highest) / (EHL_INLET_TABLE - 1);
    for (size_t i = 0; i < EHL_INLET_TABLE; i++)
        n->p[i] = (double)i * n->step;
    ff_status a = laws->viscosity->eval(laws->viscosity->self, EHL_INLET_TABLE, n->p, NULL,
                                        n->ln_eta, NULL, conductivity > 0 ? n->slope : NULL);
    ff_status b =
        laws->density->eval(laws->density->self, EHL_INLET_TABLE, n->p, NULL, n->rho, NULL, NULL);
    n->q[0] = 0;
    for (size_t i = 1; i < EHL_INLET_TABLE; i++)
        n->q[i] = n->q[i - 1] + ehl_fluidity_integral(n->step, n->ln_eta[i - 1] - oil->ln_viscosity,
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

/* Finds the position of q in the table. q increases along the inlet, so the search continues from
   the last row. */
static place at_reduced(const ehl_inlet *n, double q, size_t row)
{
    while (row < EHL_INLET_TABLE - 2 && n->q[row + 1] <= q)
        row++;
    double share = (q - n->q[row]) / (n->q[row + 1] - n->q[row]);
    return (place){row, fmin(share, 1)};
}

/* Returns R of the heated channel at that place (inlet-heat.h). */
static double heated_share(const ehl_inlet *n, place at, double h, double mass, double speed,
                           double sliding)
{
    const ff_rheology_3 *flow = n->laws.rheology;
    double ln_eta = interpolate_column(n->ln_eta, at), p = interpolate_column(n->p, at), psi, tau;
    double per = fmax(-interpolate_column(n->slope, at), 0) / n->conductivity;
    double past = speed * fmax(1 - mass / (interpolate_column(n->rho, at) * h), 0);
    psi = exp(-ln_eta);
    tau = sliding / (psi * h);
    if (flow) {
        flow->flow(flow->self, 1, &p, NULL, &ln_eta, &h, sliding, &psi, NULL, NULL, NULL);
        flow->shear(flow->self, 1, &p, NULL, &ln_eta, &h, sliding, &tau);
    }
    return ehl_heat_ratio(per * past * past / psi, per * tau * sliding * h);
}

typedef struct opening {
    double a, film, bend; /* bend: a^2/(2R) */
    double scale;         /* value of y = sqrt(s^2 - 1) at which the gap has grown by the film
                             thickness */
} opening;

/* Returns q at the inlet boundary x = -a, where the oil has the state `boundary`. */
static double reduced_pressure_at_inlet(const ehl_inlet *n, const opening *g, place boundary,
                                        double speed, double sliding)
{
    enum { NODES = 24 };
    const ff_rheology_3 *flow = n->laws.rheology;
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
            double ln_eta = interpolate_column(n->ln_eta, at), p = interpolate_column(n->p, at),
                   psi;
            flow->flow(flow->self, 1, &p, NULL, &ln_eta, &h, sliding, &psi, NULL, NULL, NULL);
            ease = exp(-ln_eta) / psi;
        }
        double rise =
            push * fmax(h - mass / interpolate_column(n->rho, at), 0) / (h * h * h) * ease * dx;
        if (n->conductivity > 0)
            rise *= heated_share(n, at, h, mass, speed, sliding);
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
    opening g = {a, film, a * a / (2 * at->radius), fmax(cbrt(3 * rise), sqrt(2 * rise))};
    double elastic = p_hertz * sqrt(2 * y / (1 + 2 * y));
    *boundary = at_pressure(n, elastic / (1 + n->alpha * elastic / BOUNDARY_LN_ETA));
    return log(reduced_pressure_at_inlet(n, &g, *boundary, speed, at->sliding) /
               interpolate_column(n->q, *boundary));
}

double ehl_inlet_mass(const ehl_inlet *n, const ehl_instant *at, double speed, double modulus,
                      double guess, double *off)
{
    enum { LIMIT = 40 };
    const double within = 1e-5; /* relative error of q at x = -a; that of the film is about the
                                   same */
    place boundary;
    /* q at x = -a is roughly proportional to h^-11/8, and its required value rises with at most
       h^1/3, so there is one root. The secant method finds it within a bracket of known films. */
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
    /* As a tends to 0, the film becomes that of a rigid cylinder, H = 3/M (Martin 1916). Both films
       are combined as in Moes' formula. */
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

static const double usual_slope = 0.03; /* -d ln eta/dT of gear oils, 1/K: 0.045 at 40 degC, 0.02 at
                                           100 degC */
static const double most_lost = 0.1;

/* Returns the factor of Gupta, Cheng, Zhu, Forster and Schrand 1992, a fit to thermal solutions. */
double ehl_gupta_factor(double p_hertz, double modulus, double Q, double S)
{
    double q = fmin(Q, 1e30), s = fmin(S, 1e30);
    double factor = (1 - 13.2 * p_hertz / modulus * pow(q, 0.42)) /
                    (1 + 0.213 * (1 + 2.23 * pow(s, 0.83)) * pow(q, 0.64));
    return fmax(factor, 0);
}

/* Returns -d ln eta/dT at p = 0. */
static double slope_of(const ehl_inlet_heating *heating, const ehl_laws *laws)
{
    double p = 0, ln_eta = 0, ln_eta_T = 0;
    if (heating->slope > 0)
        return heating->slope;
    if (laws->viscosity->eval(laws->viscosity->self, 1, &p, NULL, &ln_eta, NULL, &ln_eta_T) < 0 ||
        !(ln_eta_T < 0))
        return usual_slope;
    return -ln_eta_T;
}

void ehl_inlet_heating_report(const ff_host *host, const ehl_inlet_heating *heating, int heated,
                              const ehl_history *h, const ehl_laws *laws, const ehl_oil *oil)
{
    const double slope = slope_of(heating, laws);
    double lost = 0, p_worst = -1, Q_worst = 0, S_worst = 0;
    char text[256];
    for (size_t i = 0; i < h->count; i++) {
        ehl_instant at = ehl_history_row(h, i);
        if (ehl_is_lost(h, at.load) || !(at.entrainment > 0))
            continue;
        double p_hertz = sqrt(at.load * h->modulus / (2 * M_PI * at.radius));
        double Q = oil->viscosity * slope * at.entrainment * at.entrainment / heating->conductivity;
        double S = fabs(at.sliding) / at.entrainment;
        if (p_hertz <= p_worst && Q <= Q_worst && S <= S_worst)
            continue; /* the share increases with each of these numbers, so it is smaller here than
                         at another instant */
        double here = 1 - ehl_gupta_factor(p_hertz, h->modulus, Q, S);
        if (here > lost) {
            lost = here;
            p_worst = p_hertz;
            Q_worst = Q;
            S_worst = S;
        }
    }
    snprintf(text, sizeof text,
             "largest share of the film that shear heating in the inlet would remove by Gupta's "
             "formula, %s (-d ln eta/dT %.3g 1/K, oil %.3g W/(m K))",
             heated ? "for comparison with the effect computed here"
                    : "not included in the results",
             slope, heating->conductivity);
    host->quality(host->ctx, "inlet_heating", lost, most_lost,
                  heated || lost <= most_lost ? FF_GOOD : FF_DOUBTFUL, text);
}

/* Returns the share of the film that is lost because a part of the reduced pressure q = int
   eta0/eta dp is missing at the edge of the contact (inlet.h), without the effect of the load
   carried upstream; q is about proportional to film^-1.7. In thickened oil the whole missing q is
   missing at the edge, since q is a sum along the inlet. In oil that has not thickened, the elastic
   flanks deflect over `length`, and the loss at the edge is proportional to the square root of
   `length` over the distance. */
static double share_by_pressure(const ehl_oil *oil, double p_hertz, double a, double length,
                                double distance, double lost_pressure, double *thickened)
{
    const double depth = 0.72, most = 2.75; /* depth and ln(eta) of the edge, as for
                                               ehl_inlet_mass */
    double y = depth * depth * length / a, alpha = oil->alpha;
    double p = p_hertz * sqrt(2 * y / (1 + 2 * y));
    p /= 1 + alpha * p / most;
    *thickened = -expm1(-alpha * p);
    double q = alpha * p > 1e-6 ? *thickened / alpha : p;
    double through = 0.75 * fmin(1, sqrt(length / distance));
    return (*thickened + (1 - *thickened) * through) * lost_pressure / (1.7 * q);
}

/* The contact carries the load that the oil upstream of the domain does not carry. The film of a
   rigid cylinder is proportional to 1/w, that of an elastic cylinder to w^-1/5, and to w^-1/10 if
   the oil thickens (Moes 2000). The rigid part of the film is 4.9 eta u R/w (Martin 1916), combined
   as in Moes' formula. */
double ehl_starvation(const ehl_oil *oil, const ehl_instant *at, double modulus, double h,
                      double end)
{
    double a = ehl_hertz_half_width(at->load, at->radius, modulus), thickened;
    if (!(end > a) || !(h > 0))
        return 1;
    ehl_lost l = ehl_pressure_upstream(oil, at, a, h, end);
    double p_hertz = ehl_hertz_pressure(at->load, at->radius, modulus);
    double length = ehl_hertz_gap_distance(a, at->radius, h);
    double pressed = share_by_pressure(oil, p_hertz, a, length, end - a, l.pressure, &thickened);
    double unloaded = (l.load + l.pressure * end) / at->load;
    double rigid = 4.9 * oil->viscosity * fabs(at->entrainment) * at->radius / (at->load * h);
    double share = fmin(1, pow(rigid, 7. / 3));
    double elastic = pressed + (0.2 - 0.1 * thickened) * unloaded;
    double missing = share * unloaded + (1 - share) * elastic;
    return missing / (1 + missing); /* `missing` is relative to the remaining film, the result to
                                       the film of the infinite inlet */
}

/* Returns the share of the starvation that remains for a domain with the pressure `fed` at its
   inlet end. Squeezing drives the flow int dh/dt dx through the inlet, in addition to the flow u (h
   - h_e) of a steady film. A closing speed proportional to x^2 (`spreading`) has a third of the
   effect of a uniform one. */
double ehl_unfed(const ehl_oil *oil, const ehl_instant *at, double modulus, double h, double end,
                 double fed, double closing, double spreading)
{
    double a = ehl_hertz_half_width(at->load, at->radius, modulus);
    if (!(end > a) || !(h > 0))
        return 1;
    ehl_lost l = ehl_pressure_upstream(oil, at, a, h, end);
    double opened = (end * end - a * a) / (2 * at->radius);
    double squeezed = (fabs(closing) + fabs(spreading) / 3) * end;
    return fmin(1, fabs(1 - fed / l.pressure) + squeezed / (fabs(at->entrainment) * opened));
}

/* Returns the largest share of the film that is lost if the domain begins at x = -end, averaged
   over a passage of the contact. The steady films of every `stride`-th loaded instant are used. */
static double most_starved(const ehl_history *h, const ehl_oil *oil, double end, size_t stride)
{
    double worst = 0, mean = 0;
    for (size_t i = 0; i < h->count; i += stride) {
        ehl_instant at = ehl_history_row(h, i);
        double film = ehl_row_film(h, i, oil);
        if (at.load < EHL_LIGHT_LOAD * h->load_max || !(film > 0))
            continue;
        double a = ehl_hertz_half_width(at.load, at.radius, h->modulus);
        double way = i > 0 ? at.entrainment * (h->time[i] - h->time[i - stride]) : HUGE_VAL;
        double share = fmin(1, way / (2 * fmax(a, sqrt(2 * at.radius * film))));
        mean += share * (ehl_starvation(oil, &at, h->modulus, film, end) - mean);
        worst = fmax(worst, mean);
    }
    return worst;
}

double ehl_inlet_supplied(const ehl_history *h, const ehl_oil *oil)
{
    enum { LIMIT = 30 };
    const double most = EHL_STARVED_LIMIT / 1.5; /* the estimate is accurate within this factor */
    double widest = 0, end = 0, missing;
    for (size_t i = 0; i < h->count; i++) {
        ehl_instant at = ehl_history_row(h, i);
        double a = ehl_hertz_half_width(at.load, at.radius, h->modulus),
               s = sqrt(2 * at.radius * ehl_row_film(h, i, oil));
        widest = fmax(widest, a);
        if (at.load >= EHL_LIGHT_LOAD * h->load_max)
            end = fmax(end, a + 4 * s);
    }
    /* the share is inversely proportional to the square of the distance from the contact, except
       near the contact, where it decreases more slowly */
    for (int k = 0; k < LIMIT && (missing = most_starved(h, oil, end, 1)) > most; k++)
        end = widest + (end - widest) * fmin(2, fmax(1.02, sqrt(missing / most)));
    return end;
}

/* Returns the largest relative error of h_central due to the cells at a loaded instant, over the
   square of their width, 1/m2. With cells of width dx the error is (0.2 + 0.05 L (1 + (l/a)^2))
   (dx/l)^2, where l is the build-up length of the pressure in the inlet. It was fitted to steady
   films of L 0 to 15 with more than three cells over l. */
static double most_by_cells(const ehl_history *h, const ehl_oil *oil, size_t stride)
{
    double worst = 0;
    for (size_t i = 0; i < h->count; i += stride) {
        ehl_instant at = ehl_history_row(h, i);
        double film = ehl_row_film(h, i, oil);
        int creeps = h->at_rest && at.time <= h->wakes;
        if (creeps || at.load < EHL_LIGHT_LOAD * h->load_max || !(film > 0))
            continue;
        double a = ehl_hertz_half_width(at.load, at.radius, h->modulus);
        double l = ehl_inlet_buildup(a, at.radius, film), wide = fmin(1, l / a);
        double U = oil->viscosity * at.entrainment / (h->modulus * at.radius);
        double L = oil->alpha * h->modulus * sqrt(sqrt(2 * U));
        worst = fmax(worst, (0.2 + 0.05 * L * (1 + wide * wide)) / (l * l));
    }
    return worst;
}

/* Returns the smallest length of an inlet, m. Smaller loads are replaced by EHL_LIGHT_LOAD times
   the largest load. */
static double shortest_inlet(const ehl_history *h, const ehl_oil *oil)
{
    double end = 0;
    for (size_t i = 0; i < h->count; i++) {
        ehl_instant at = ehl_history_row(h, i);
        at.load = fmax(at.load, EHL_LIGHT_LOAD * h->load_max);
        double s = sqrt(2 * at.radius * ehl_moes_film(&at, h->modulus, oil));
        end = fmax(end, ehl_hertz_half_width(at.load, at.radius, h->modulus) + EHL_FED_LENGTHS * s);
    }
    return end;
}

/* The longest inlet is used if the error due to its cells is below this share of the film, so that
   the domain does not depend on the number of cells and the error is proportional to the square of
   their width. */
static const double ENOUGH = 0.02;

double ehl_inlet_balanced(const ehl_history *h, const ehl_oil *oil, size_t cells, double outlet,
                          double longest)
{
    enum { ROWS = 256, ROUNDS = 20 };
    const double close = 0.01; /* relative tolerance of the length; it hardly affects the film */
    const double most = 0.05;  /* largest loss accepted if there are too few cells for any length */
    size_t stride = h->count > ROWS ? h->count / ROWS : 1;
    double one = most_by_cells(h, oil, stride), end = longest, change = 1;
    double widest = (longest + outlet) / (double)cells;
    if (one * widest * widest <= ENOUGH)
        return longest;
    for (int k = 0; k < ROUNDS && fabs(change) > close; k++) {
        double dx = (end + outlet) / (double)cells, off = fmin(one * dx * dx, most);
        double ratio = off > 0 ? most_starved(h, oil, end, stride) / off : 1;
        if (!(ratio > 0)) /* no inlet length causes starvation: the shortest is used */
            return fmin(longest, shortest_inlet(h, oil));
        /* the starvation decreases at least with the square of the length, and the error due to the
           cells increases with its square */
        double next = fmin(longest, end * sqrt(sqrt(ratio)));
        change = next / end - 1;
        end = next;
    }
    return fmin(longest, fmax(end, shortest_inlet(h, oil)));
}
