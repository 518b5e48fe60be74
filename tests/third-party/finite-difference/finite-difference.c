/* SPDX-License-Identifier: MIT */
/*
 * ehl/finite-difference: the transient film of a smooth line contact by finite differences.
 *
 *   d/dx (f dp/dx) = u d(rho h)/dx + d(rho h)/dt,  f = rho h^3/(12 eta),  where p > 0,
 *   h = h0 + x^2/(2 R) - 4/(pi E') int p(s) ln|x - s| ds,   int p dx = w.
 *
 * The pressure term takes central differences, the wedge upwind ones of third order, and time
 * implicit steps of first order. Pressure and film of a step are found together by Newton's method
 * with a dense matrix. A node either has p = 0, or oil that balances: which of both is decided anew
 * in each step of Newton's (primal-dual active set, Hintermueller, Ito & Kunisch 2003).
 *
 * Limits: smooth flanks, a Newtonian oil of one temperature, a contact that is never without load;
 * oil in the cavity is not followed. Friction needs a rheology and is not given.
 */
#include <flankfilm/author.h>
#include <flankfilm/laws.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double PI = 3.14159265358979323846;

enum { NEWTON = 60 };

typedef struct stage {
    const ff_host *host;
    const ff_viscosity *viscosity;
    const ff_density *density;
    int64_t cells, steps;
    double inlet, outlet, tolerance;
} stage;

static const ff_param params[] = {
    FF_COUNT("cells", stage, cells, FF_TUNABLE, "256", NULL, 16, 384, 0, 0,
             "equal cells from inlet to outlet; the time of a step grows with their cube"),
    FF_COUNT("steps", stage, steps, FF_TUNABLE, "100", NULL, 1, 100000, 0, 0,
             "equal time steps from the first instant of the contact to the last"),
    FF_QUANTITY("inlet", "", stage, inlet, 0, "6", NULL, 1.5, 1e12, 0, 0,
                "start of the film before the contact, in largest Hertz half widths"),
    FF_QUANTITY("outlet", "", stage, outlet, 0, "1.5", NULL, 1.1, 1e12, 0, 0,
                "its end behind the contact"),
    FF_QUANTITY("tolerance", "", stage, tolerance, FF_TUNABLE, "1e-7", NULL, 1e-12, 1e-3, 0, 0,
                "last change of the pressure by Newton's method, over the Hertz pressure"),
};

enum { TIME_IN, RADIUS, SPEED_1, SPEED_2, LOAD, MODULUS, VISCOSITY, DENSITY };

static const ff_port inputs[] = {
    [TIME_IN] = {.name = "contact.time", .unit = "s", .dims = "t", .doc = "instants"},
    [RADIUS] = {.name = "contact.equivalent_radius", .unit = "m", .dims = "t", .doc = "R"},
    [SPEED_1] = {.name = "contact.speed_1", .unit = "m/s", .dims = "t", .doc = "surface speed u1"},
    [SPEED_2] = {.name = "contact.speed_2", .unit = "m/s", .dims = "t", .doc = "surface speed u2"},
    [LOAD] = {.name = "contact.load_per_width", .unit = "N/m", .dims = "t", .doc = "w"},
    [MODULUS] = {.name = "contact.reduced_modulus",
                 .unit = "Pa",
                 .dims = "",
                 .doc = "E' of 2/E' = sum (1 - nu^2)/E"},
    [VISCOSITY] = {.name = "viscosity",
                   .unit = "",
                   .dims = "",
                   .doc = "viscosity of the oil",
                   .service = FF_VISCOSITY_ID},
    [DENSITY] = {.name = "density",
                 .unit = "",
                 .dims = "",
                 .doc = "density of the oil",
                 .service = FF_DENSITY_ID},
};

enum { TIME, X, PRESSURE, FILM, H_MIN, H_CENTRAL, P_MAX, CARRIED, LOWEST, MASS_ERROR };

static const ff_port outputs[] = {
    [TIME] = {.name = "time", .unit = "s", .dims = "t", .doc = "of the steps"},
    [X] = {.name = "x", .unit = "m", .dims = "x", .doc = "along the motion, 0 in the middle"},
    [PRESSURE] = {.name = "pressure", .unit = "Pa", .dims = "t x", .doc = "pressure"},
    [FILM] = {.name = "film", .unit = "m", .dims = "t x", .doc = "film thickness"},
    [H_MIN] = {.name = "h_min", .unit = "m", .dims = "t", .doc = "least film thickness"},
    [H_CENTRAL] = {.name = "h_central", .unit = "m", .dims = "t", .doc = "film at x = 0"},
    [P_MAX] = {.name = "p_max", .unit = "Pa", .dims = "t", .doc = "highest pressure"},
    [CARRIED] = {.name = "load_per_width", .unit = "N/m", .dims = "t", .doc = "what p carries"},
    [LOWEST] = {.name = "h_min_lowest", .unit = "m", .dims = "", .doc = "lowest h_min of all"},
    [MASS_ERROR] = {.name = "mass_error",
                    .unit = "1",
                    .dims = "",
                    .doc = "oil that the cells of the full film do not account for, over u rho h "
                           "at the highest pressure; the largest of all steps"},
};

static ff_status wire(void *self, uint32_t input, const void *service)
{
    stage *s = self;
    if (input == VISCOSITY)
        s->viscosity = service;
    if (input == DENSITY)
        s->density = service;
    return FF_OK;
}

/* One instant of the contact. */
typedef struct instant {
    double t, R, u, w;
} instant;

/* Everything on the nodes, n of them; p is 0 at the first and at the last. */
typedef struct solver {
    const stage *s;
    size_t n;
    double modulus, half_width, hertz, dx, first, h0, mass_error;
    double *memory, *kernel; /* kernel: m/Pa, a node's pressure on one k nodes away */
    double *p, *h, *rho, *rho_p, *ln_eta, *ln_eta_p;
    double *oil, *oil_p; /* rho/(12 eta), of which a face has the geometric mean; d(ln oil)/dp */
    double *last, h0_last, *past; /* p, h0 and rho h of the film before */
    double *by_p[4], *by_h[4];    /* of row i by the nodes i - 2 ... i + 1 */
    double *row, *matrix;
} solver;

static double twice_integrated_log(double s)
{
    return s * s > 0 ? s * s * (log(fabs(s)) / 2 - 0.75) : 0;
}

/* The pressure is linear between the nodes; lengths in the logarithm are in half widths, which
   moves h0 alone. */
static void fill_kernel(solver *v)
{
    for (size_t k = 0; k < v->n; k++) {
        double at = (double)k, hat = twice_integrated_log(at + 1) - 2 * twice_integrated_log(at) +
                                     twice_integrated_log(at - 1);
        v->kernel[k] = -4 / (PI * v->modulus) * v->dx * (hat + log(v->dx / v->half_width));
    }
}

static double between(const solver *v, size_t i, size_t j)
{
    return v->kernel[i > j ? i - j : j - i];
}

static ff_status ask_laws(solver *v)
{
    const ff_viscosity *viscosity = v->s->viscosity;
    const ff_density *density = v->s->density;
    ff_status a = viscosity->eval(viscosity->self, v->n, v->p, NULL, v->ln_eta, v->ln_eta_p, NULL),
              b = density->eval(density->self, v->n, v->p, NULL, v->rho, v->rho_p, NULL);
    for (size_t i = 0; i < v->n; i++)
        if (a < 0 || b < 0 || !(v->ln_eta[i] < 200 && v->rho[i] > 0 && v->rho[i] < 1e6))
            return FF_NOCONV; /* no oil under such a pressure: the step was too long */
    return FF_OK;
}

static ff_status measure(solver *v, const instant *at)
{
    for (size_t i = 0; i < v->n; i++) {
        double x = v->first + (double)i * v->dx;
        v->h[i] = v->h0 + x * x / (2 * at->R);
        for (size_t j = 1; j + 1 < v->n; j++)
            v->h[i] += between(v, i, j) * v->p[j];
    }
    ff_status status = ask_laws(v);
    for (size_t i = 0; i < v->n && status == FF_OK; i++) {
        v->oil[i] = v->rho[i] / 12 * exp(-v->ln_eta[i]);
        v->oil_p[i] = v->rho_p[i] / v->rho[i] - v->ln_eta_p[i];
    }
    return status;
}

/* Row i gets `factor` times rho h of a node. */
static void add_mass(solver *v, size_t i, size_t node, double factor)
{
    v->row[i] += factor * v->rho[node] * v->h[node];
    v->by_p[node + 2 - i][i] += factor * v->rho_p[node] * v->h[node];
    v->by_h[node + 2 - i][i] += factor * v->rho[node];
}

/* Row i gets `sign` times f dp/dx between a node and the next, per dx. */
static void add_rise(solver *v, size_t i, size_t node, double sign)
{
    double oil = sign * sqrt(v->oil[node] * v->oil[node + 1]) / (v->dx * v->dx),
           f = oil * (pow(v->h[node], 3) + pow(v->h[node + 1], 3)) / 2,
           flow = f * (v->p[node + 1] - v->p[node]);
    size_t k = node + 2 - i;
    v->row[i] += flow;
    for (size_t side = 0; side < 2; side++) {
        v->by_p[k + side][i] += flow * v->oil_p[node + side] / 2 + (side ? f : -f);
        v->by_h[k + side][i] +=
            oil * 1.5 * v->h[node + side] * v->h[node + side] * (v->p[node + 1] - v->p[node]);
    }
}

/* Row i: what comes in less what leaves and what stays, kg/(m2 s). `step` 0: steady. */
static void balance(solver *v, const instant *at, double step)
{
    /* third order; second order behind the first node */
    static const double upwind[] = {1 / 6.0, -1, 0.5, 1 / 3.0}, plain[] = {0, -0.5, 0, 0.5};
    const double u = at->u / v->dx;
    for (size_t i = 1; i + 1 < v->n; i++) {
        v->row[i] = 0;
        for (int k = 0; k < 4; k++)
            v->by_p[k][i] = v->by_h[k][i] = 0;
        add_rise(v, i, i, 1);
        add_rise(v, i, i - 1, -1);
        for (size_t k = i > 1 ? 0 : 1; k < 4; k++)
            add_mass(v, i, i + k - 2, -u * (i > 1 ? upwind[k] : plain[k]));
        if (step > 0) {
            add_mass(v, i, i, -1 / step);
            v->row[i] += v->past[i] / step;
        }
    }
}

/* The system of a Newton step in units of the Hertz pressure and of half_width^2/R; row and column
   0 are those of the load and of h0. A node with p = 0 stays where more oil would leave. */
static void assemble(solver *v, const instant *at)
{
    const size_t n = v->n, size = n - 1;
    const double gap = v->half_width * v->half_width / at->R;
    memset(v->matrix, 0, size * size * sizeof *v->matrix);
    v->row[0] = -at->w / (v->half_width * v->hertz);
    for (size_t j = 1; j < size; j++) {
        v->row[0] += v->p[j] / v->hertz * v->dx / v->half_width;
        v->matrix[j] = v->dx / v->half_width;
    }
    for (size_t i = 1; i < size; i++) {
        double *row = v->matrix + i * size, most = 0;
        /* of the oil at p = 0: under high pressure hardly any flows, and the imbalance of a film
           that is not found yet would empty nodes in the middle of the contact */
        double scale = 2 * v->oil[0] * pow(v->h[i], 3) / (v->dx * v->dx);
        if (!(v->p[i] + v->row[i] / scale > 0)) {
            row[i] = 1;
            v->row[i] = v->p[i] / v->hertz;
            continue;
        }
        for (size_t k = 0; k < 4; k++)
            row[0] += v->by_h[k][i] * gap;
        for (size_t j = 1; j < size; j++) {
            for (size_t k = i > 1 ? 0 : 1; k < 4; k++)
                row[j] += v->by_h[k][i] * between(v, i + k - 2, j) * v->hertz;
            if (j + 2 >= i && j <= i + 1)
                row[j] += v->by_p[j + 2 - i][i] * v->hertz;
            most = fmax(most, fabs(row[j]));
        }
        for (size_t j = 0; j < size; j++)
            row[j] /= most;
        v->row[i] /= most;
    }
}

/* Gauss with partial pivoting: b becomes the solution of matrix x = b; 0: there is none. */
static int eliminate(double *matrix, double *b, size_t size)
{
    for (size_t k = 0; k < size; k++) {
        size_t best = k;
        for (size_t i = k + 1; i < size; i++)
            best = fabs(matrix[i * size + k]) > fabs(matrix[best * size + k]) ? i : best;
        double pivot = matrix[best * size + k], kept = b[best];
        if (!(fabs(pivot) > 0))
            return 0;
        for (size_t j = k; j < size && best != k; j++) {
            double other = matrix[k * size + j];
            matrix[k * size + j] = matrix[best * size + j];
            matrix[best * size + j] = other;
        }
        b[best] = b[k];
        b[k] = kept;
        for (size_t i = k + 1; i < size; i++) {
            double factor = matrix[i * size + k] / pivot;
            for (size_t j = k + 1; j < size && factor != 0; j++)
                matrix[i * size + j] -= factor * matrix[k * size + j];
            b[i] -= factor * b[k];
        }
    }
    for (size_t k = size; k-- > 0;) {
        for (size_t j = k + 1; j < size; j++)
            b[k] -= matrix[k * size + j] * b[j];
        b[k] /= matrix[k * size + k];
    }
    return 1;
}

/* Takes as much of the step as changes no pressure by more than 0.3 of Hertz's and leaves a gap
   everywhere. The largest change of p over the Hertz pressure; 1 where the step was cut. */
static double take_step(solver *v, const instant *at)
{
    const size_t n = v->n;
    const double *step = v->row, dh0 = step[0] * v->half_width * v->half_width / at->R;
    double most = 0, share = 1;
    for (size_t i = 1; i + 1 < n; i++)
        most = fmax(most, fabs(step[i]));
    share = fmin(1, 0.3 / most);
    for (size_t i = 0; i < n; i++) {
        double dh = dh0;
        for (size_t j = 1; j + 1 < n; j++)
            dh += between(v, i, j) * step[j] * v->hertz;
        share = dh > 0 ? fmin(share, 0.9 * v->h[i] / dh) : share;
    }
    for (size_t i = 1; i + 1 < n; i++)
        v->p[i] -= share * step[i] * v->hertz;
    v->h0 -= share * dh0;
    return share < 1 ? 1 : most;
}

/* The film of an instant, from the one that stands there. */
static ff_status solve(solver *v, const instant *at, double step)
{
    for (int k = 0; k < NEWTON; k++) {
        ff_status status = measure(v, at);
        if (status != FF_OK)
            return status;
        balance(v, at, step);
        assemble(v, at);
        double change = eliminate(v->matrix, v->row, v->n - 1) ? take_step(v, at) : NAN;
        if (!isfinite(change))
            break;
        if (change <= v->s->tolerance)
            return measure(v, at);
    }
    return FF_NOCONV;
}

/* Linear between the instants of the contact. */
static instant at_time(const ff_array *in, double t)
{
    const size_t count = in[TIME_IN].shape[0];
    size_t i = 0;
    while (i + 2 < count && in[TIME_IN].data[i + 1] <= t)
        i++;
    size_t next = count > 1 ? i + 1 : i;
    double span = in[TIME_IN].data[next] - in[TIME_IN].data[i],
           share = span > 0 ? fmin(1, (t - in[TIME_IN].data[i]) / span) : 0;
    double value[4];
    for (uint32_t k = 0; k < 4; k++)
        value[k] = (1 - share) * in[RADIUS + k].data[i] + share * in[RADIUS + k].data[next];
    return (instant){t, value[0], fabs(value[1] + value[2]) / 2, value[3]};
}

static ff_status check_contact(const stage *s, const ff_array *in)
{
    static const struct {
        double low, high;
    } limits[] = {[RADIUS] = {1e-6, 1e3},
                  [SPEED_1] = {-1e3, 1e3},
                  [SPEED_2] = {-1e3, 1e3},
                  [LOAD] = {1e-3, 1e9}};
    const size_t count = in[TIME_IN].shape[0];
    if (!(in[MODULUS].data[0] > 1e3 && in[MODULUS].data[0] < 1e21))
        return ff_failf(s->host, FF_INVALID, "contact.reduced_modulus", "%g Pa is no modulus",
                        in[MODULUS].data[0]);
    for (size_t i = 0; i < count; i++) {
        double t = in[TIME_IN].data[i];
        if (!(t - t == 0) || (i && !(in[TIME_IN].data[i - 1] <= t)))
            return ff_failf(s->host, FF_INVALID, "contact.time", "the instants must rise");
        for (uint32_t k = RADIUS; k <= LOAD; k++)
            if (!(in[k].data[i] >= limits[k].low && in[k].data[i] <= limits[k].high))
                return ff_failf(s->host, FF_INVALID, inputs[k].name,
                                "it is %g at %g s, but must be from %g to %g: a contact without "
                                "load, too, has no film by this model",
                                in[k].data[i], t, limits[k].low, limits[k].high);
        if (!(at_time(in, t).u > 1e-6))
            return ff_failf(s->host, FF_INVALID, "contact.speed_1", "no oil comes in at %g s", t);
    }
    return count ? FF_OK : ff_failf(s->host, FF_INVALID, "contact.time", "there is none");
}

static ff_status open_solver(solver *v, const stage *s, const ff_array *in)
{
    enum { ARRAYS = 20 };
    const size_t n = (size_t)s->cells + 1;
    *v = (solver){.s = s, .n = n, .modulus = in[MODULUS].data[0]};
    for (size_t i = 0; i < in[TIME_IN].shape[0]; i++) {
        double width = sqrt(8 * in[LOAD].data[i] * in[RADIUS].data[i] / (PI * v->modulus));
        v->half_width = fmax(v->half_width, width);
        v->hertz = fmax(v->hertz, 2 * in[LOAD].data[i] / (PI * width));
    }
    v->dx = (s->inlet + s->outlet) * v->half_width / (double)s->cells;
    v->first = -s->inlet * v->half_width;
    double *next = v->memory = calloc((ARRAYS + n) * n, sizeof *next);
    if (!next)
        return FF_NOMEM;
    double **arrays[ARRAYS] = {&v->kernel,  &v->p,        &v->h,       &v->rho,     &v->rho_p,
                               &v->ln_eta,  &v->ln_eta_p, &v->oil,     &v->oil_p,   &v->past,
                               &v->last,    &v->by_p[0],  &v->by_p[1], &v->by_p[2], &v->by_p[3],
                               &v->by_h[0], &v->by_h[1],  &v->by_h[2], &v->by_h[3], &v->row};
    for (size_t k = 0; k < ARRAYS; k++, next += n)
        *arrays[k] = next;
    v->matrix = next;
    fill_kernel(v);
    return FF_OK;
}

/* Hertz's pressure, wider where the flanks are all but rigid, and the thickest of three films: that
   of rigid flanks (Martin), and h/R = 3.1 M^-0.2 S and 1.25 M^-0.125 L^0.75 S of elastic ones with
   an oil of constant viscosity and with one that thickens; S = sqrt(2U), M = W/S, L = alpha E'
   sqrt(S) (Moes 2000). */
static ff_status guess(solver *v, const instant *at)
{
    const ff_viscosity *law = v->s->viscosity;
    double half = sqrt(8 * at->w * at->R / (PI * v->modulus)), sum = 0, none = 0, ln_eta, alpha,
           least = INFINITY;
    if (law->eval(law->self, 1, &none, NULL, &ln_eta, &alpha, NULL) < 0 ||
        !(fabs(ln_eta) < 50 && alpha >= 0 && alpha < 1e-6))
        return ff_failf(v->s->host, FF_INVALID, "viscosity",
                        "no oil has ln eta = %g and a slope of %g 1/Pa at p = 0", ln_eta, alpha);
    double scale = sqrt(2 * exp(ln_eta) * at->u / (v->modulus * at->R)),
           M = at->w / (v->modulus * at->R) / scale, L = alpha * v->modulus * sqrt(scale),
           martin = 2.45 * at->R * scale / M, soft = 3.1 * at->R * scale * pow(M, -0.2),
           thick = 1.25 * at->R * scale * pow(M, -0.125) * pow(L, 0.75),
           film = fmax(martin, fmax(soft, thick));
    half = fmax(half, sqrt(2 * at->R * martin));
    for (size_t i = 1; i + 1 < v->n; i++) {
        double x = (v->first + (double)i * v->dx) / half;
        v->p[i] = sqrt(fmax(0, 1 - x * x));
        sum += v->p[i] * v->dx;
    }
    if (!(sum > 0))
        return ff_failf(v->s->host, FF_INVALID, "inlet", "no node lies within the contact");
    for (size_t i = 1; i + 1 < v->n; i++)
        v->p[i] *= at->w / sum;
    v->h0 = 0;
    ff_status status = measure(v, at);
    for (size_t i = 0; i < v->n; i++)
        least = fmin(least, v->h[i]);
    v->h0 = film - least;
    return status;
}

/* The steady film of the first instant. Where the oil stiffens much, by more than e^4 under Hertz's
   pressure, Newton's method finds it by way of lighter loads. */
static ff_status find_first(solver *v, const instant *first)
{
    enum { STEPS = 16 };
    double none = 0, ln_eta, alpha = 0,
           hertz = sqrt(first->w * v->modulus / (2 * PI * first->R)); /* Pa */
    v->s->viscosity->eval(v->s->viscosity->self, 1, &none, NULL, &ln_eta, &alpha, NULL);
    double stiffness = alpha * hertz, lightest = stiffness > 4 ? pow(4 / stiffness, 2) : 1;
    instant at = *first;
    at.w *= lightest;
    ff_status status = guess(v, &at);
    for (int k = lightest < 1 ? 0 : STEPS; k <= STEPS && status == FF_OK; k++) {
        at.w = first->w * pow(lightest, 1 - (double)k / STEPS);
        status = solve(v, &at, 0);
    }
    return status;
}

/* Of the nodes under pressure, what balance() leaves over, and the flow that it is held to. */
static double mass_error(solver *v, const instant *at, double step)
{
    size_t top = 0;
    double left_over = 0;
    balance(v, at, step);
    for (size_t i = 1; i + 1 < v->n; i++) {
        top = v->p[i] > v->p[top] ? i : top;
        left_over += v->p[i] > 0 ? fabs(v->row[i]) * v->dx : 0;
    }
    return left_over / (at->u * v->rho[top] * v->h[top]);
}

/* The film has been found, with a time step of that length. */
static void accept(solver *v, const instant *at, double step)
{
    v->mass_error = fmax(v->mass_error, mass_error(v, at, step));
    v->h0_last = v->h0;
    for (size_t i = 0; i < v->n; i++) {
        v->p[i] = fmax(v->p[i], 0);
        v->last[i] = v->p[i];
        v->past[i] = v->rho[i] * v->h[i];
    }
}

/* From one instant to the next, in shorter steps where Newton's method finds nothing, as where the
   load jumps. */
static ff_status advance(solver *v, const ff_array *in, double t, double end)
{
    const double shortest = (end - t) / 128;
    double step = end - t;
    while (t < end) {
        instant at = at_time(in, end - t < 1.001 * step ? end : t + step);
        ff_status status = solve(v, &at, at.t - t);
        if (status == FF_OK) {
            accept(v, &at, at.t - t);
            t = at.t;
        } else if (status == FF_NOCONV && step > shortest) {
            memcpy(v->p, v->last, v->n * sizeof *v->p);
            v->h0 = v->h0_last;
            step /= 2;
        } else {
            return status;
        }
    }
    return FF_OK;
}

typedef struct results {
    double *out[LOWEST], lowest;
} results;

static void keep(const solver *v, double t, size_t k, results *r)
{
    double central = -v->first / v->dx, share = central - floor(central), least = INFINITY,
           most = 0, load = 0;
    size_t left = (size_t)central;
    for (size_t i = 0; i < v->n; i++) {
        least = fmin(least, v->h[i]);
        most = fmax(most, v->p[i]);
        load += v->p[i] * v->dx;
        r->out[PRESSURE][k * v->n + i] = v->p[i];
        r->out[FILM][k * v->n + i] = v->h[i];
    }
    r->out[TIME][k] = t;
    r->out[H_MIN][k] = least;
    r->out[H_CENTRAL][k] = (1 - share) * v->h[left] + share * v->h[left + 1];
    r->out[P_MAX][k] = most;
    r->out[CARRIED][k] = load;
    r->lowest = fmin(r->lowest, least);
}

static ff_status run(solver *v, const ff_array *in, results *r)
{
    const stage *s = v->s;
    const size_t count = in[TIME_IN].shape[0],
                 steps = in[TIME_IN].data[count - 1] > in[TIME_IN].data[0] ? (size_t)s->steps : 0,
                 field[] = {steps + 1, v->n};
    for (uint32_t k = TIME; k < LOWEST; k++) {
        int wide = k == PRESSURE || k == FILM;
        r->out[k] = wide ? s->host->output(s->host->ctx, k, 2, field)
                         : ff_put_series(s->host, k, k == X ? v->n : steps + 1);
        if (!r->out[k])
            return FF_NOMEM;
    }
    for (size_t i = 0; i < v->n; i++)
        r->out[X][i] = v->first + (double)i * v->dx;
    const double begin = in[TIME_IN].data[0],
                 step = steps ? (in[TIME_IN].data[count - 1] - begin) / (double)steps : 0;
    instant first = at_time(in, begin);
    ff_status status = find_first(v, &first);
    if (status == FF_OK)
        accept(v, &first, 0);
    for (size_t k = 0; k <= steps && status == FF_OK; k++) {
        double t = begin + step * (double)k;
        if (k > 0)
            status = advance(v, in, t - step, t);
        if (status == FF_NOCONV)
            break;
        keep(v, t, k, r);
        if (s->host->progress(s->host->ctx, (double)(k + 1) / (double)(steps + 1)))
            status = FF_STOPPED;
    }
    return status == FF_NOCONV ? ff_failf(s->host, FF_NOCONV, NULL,
                                          "Newton's method found no film within %d steps", NEWTON)
                               : status;
}

static ff_status evaluate(void *self, uint64_t wanted, const ff_array *in)
{
    const stage *s = self;
    results r = {.lowest = INFINITY};
    solver v = {.memory = NULL};
    (void)wanted;
    ff_status status = check_contact(s, in);
    if (status == FF_OK)
        status = open_solver(&v, s, in);
    if (status == FF_OK)
        status = run(&v, in, &r);
    free(v.memory);
    if (status != FF_OK)
        return status;
    s->host->quality(s->host->ctx, "mass", v.mass_error, 1e-3,
                     v.mass_error <= 1e-3 ? FF_GOOD : FF_DOUBTFUL,
                     "oil that the full film does not account for, over what flows");
    if (ff_put_scalar(s->host, LOWEST, r.lowest) != FF_OK)
        return FF_NOMEM;
    return ff_put_scalar(s->host, MASS_ERROR, v.mass_error);
}

FF_MODEL(model, stage, .id = "ehl/finite-difference", .version = "1.0.0",
         .summary = "transient film of a smooth line contact by finite differences",
         .reference = "Venner & Lubrecht 2000, Multilevel Methods in Lubrication; Hintermueller, "
                      "Ito & Kunisch 2003, SIAM J. Optim. 13, 865-888 (active set)",
         .bibtex = "", .licence = "MIT", .params = FF_TABLE(params), .inputs = FF_TABLE(inputs),
         .outputs = FF_TABLE(outputs), .wire = wire, .evaluate = evaluate, .destroy = free);
FF_EXPORT_MODELS(&model);
