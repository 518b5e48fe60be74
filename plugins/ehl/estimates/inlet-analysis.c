/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Film from an analysis of the inlet alone. Pressure flow is negligible inside the contact, so the
   oil that enters moves through it at the rolling speed: d(rho h)/dt + u d(rho h)/dx = 0, with rho
   h = m at x = -a. m is the mass of a steady inlet (inlet.h) in the frame of the moving boundary x
   = -a, at which the oil arrives with a speed of about u + da/dt. */
#include "estimate.h"
#include "inlet.h"
#include "references.h"

#include <flankfilm/author.h>

#include <math.h>
#include <stdlib.h>

enum { DENSITIES = 65, PIECES = 8, SAMPLES = 16 };

/* Speed of the inlet boundary as a share of da/dt. The share is below 1 because the inlet becomes
   shorter as the load grows. BOUNDARY_SHARE and EXIT_EXPONENT are fitted to transient solutions. */
static const double BOUNDARY_SHARE = 0.85;

/* Exponent of the exit constriction. The constriction depends on the film that would enter at the
   speed of the oil relative to the exit x = a, u - da/dt. */
static const double EXIT_EXPONENT = 0.3;

/* Smallest speed of the oil relative to the boundary, as a share of the first speed. */
static const double LEAST_SPEED = 1e-3;

/* A mark of the oil that is now at x = place + travel, with its rho h. */
typedef struct mark {
    double place, mass;
} mark;

typedef struct inlet_analysis {
    ehl_estimate e;
    ehl_inlet inlet;
    double density[DENSITIES], density_step; /* table over pressure */
    double *speed;  /* speed at which the oil approaches the inlet boundary, m/s; 0: the boundary
                       moves away from the oil */
    double *factor; /* logarithm of rho h of the steady inlet, minus law() */
    mark *mark;     /* marks, from the oil that entered first to the last */
    size_t marks;
    double steady;         /* rho h of the steady inlet at the latest instant */
    double travel;         /* distance moved by the surfaces so far, m */
    double solved, jumped; /* numbers of solved inlets, and of jumps of the boundary */
    double worst_off;      /* largest residual of the solved inlets */
} inlet_analysis;

static double density_at(const inlet_analysis *c, double p)
{
    double rows = p / c->density_step;
    size_t row = rows < DENSITIES - 2 ? (size_t)rows : DENSITIES - 2;
    double share = rows - (double)row;
    return (1 - share) * c->density[row] + share * c->density[row + 1];
}

static ff_status fill_laws(inlet_analysis *c)
{
    ehl_estimate *e = &c->e;
    double p[DENSITIES], highest = 0;
    for (size_t k = 0; k < e->count; k++) {
        const ehl_moment *m = &e->moment[k];
        highest = fmax(highest, ehl_hertz_pressure(m->at.load, m->at.radius, e->history.modulus));
    }
    c->density_step = highest / (DENSITIES - 1);
    for (int i = 0; i < DENSITIES; i++)
        p[i] = i * c->density_step;
    const ff_density *law = e->laws.density;
    ff_status a = law->eval(law->self, DENSITIES, p, NULL, c->density, NULL, NULL);
    ff_status b = ehl_inlet_fill(&c->inlet, &e->laws, &e->oil, e->alpha, e->conductivity, highest);
    ehl_law_note(&e->answered, a);
    ehl_law_note(&e->answered, b);
    return a < 0 ? a : b < 0 ? b : FF_OK;
}

/* Fills the speeds with which the oil upstream of the contact arrives at its inlet: u +
   BOUNDARY_SHARE da/dt. */
static void fill_speeds(inlet_analysis *c)
{
    const ehl_moment *m = c->e.moment;
    for (size_t k = 0; k < c->e.count; k++) {
        c->speed[k] = m[k].at.entrainment;
        if (m[k].begins)
            continue;
        double dt = m[k].at.time - m[k - 1].at.time, grown = m[k].a - m[k - 1].a;
        double mean = (m[k].at.entrainment + m[k - 1].at.entrainment) / 2;
        c->speed[k] = dt > 0 ? fmax(mean + BOUNDARY_SHARE * grown / dt, 0) : mean;
    }
}

/* Returns the logarithm of a power law similar to those of Dowson & Toyoda 1978 and others: h ~
   u^0.7 w^-0.1 R^0.4. */
static const double SPEED_EXPONENT = 0.7;

static double law(const ehl_instant *at, double speed)
{
    return SPEED_EXPONENT * log(speed) - 0.1 * log(at->load) + 0.4 * log(at->radius);
}

static double entry_speed(const inlet_analysis *c, size_t k)
{
    return fmax(c->speed[k], LEAST_SPEED * c->speed[0]);
}

/* Solves the inlet for the factor of one instant. `guess` is the factor of another instant, or
   0. */
static double solve(inlet_analysis *c, size_t k, double guess)
{
    ehl_instant at = c->e.moment[k].at;
    at.entrainment = entry_speed(c, k);
    double power = law(&at, at.entrainment);
    double film =
        guess != 0 ? exp(guess + power) / c->e.oil.density : ehl_estimate_moes(&c->e, &at);
    double off;
    double mass = ehl_inlet_mass(&c->inlet, &at, at.entrainment, c->e.history.modulus, film, &off);
    c->solved++;
    c->worst_off = fmax(c->worst_off, fabs(off));
    return log(mass) - power;
}

/* Fills the factors of the instants between two instants. The factor varies slowly, so it is solved
   at some instants and interpolated linearly between them. An interval is halved until the
   interpolation agrees with the solution in its middle. */
static void fill_between(inlet_analysis *c, size_t first, size_t last)
{
    const double close = 2e-3;
    double *f = c->factor;
    if (last - first < 2)
        return;
    size_t middle = first + (last - first) / 2;
    double share = (double)(middle - first) / (double)(last - first);
    double linear = f[first] + share * (f[last] - f[first]);
    f[middle] = solve(c, middle, linear);
    if (fabs(f[middle] - linear) > close) {
        fill_between(c, first, middle);
        fill_between(c, middle, last);
        return;
    }
    double rise = (f[middle] - f[first]) / (double)(middle - first);
    for (size_t k = first + 1; k < middle; k++)
        f[k] = f[first] + rise * (double)(k - first);
    rise = (f[last] - f[middle]) / (double)(last - middle);
    for (size_t k = middle + 1; k < last; k++)
        f[k] = f[middle] + rise * (double)(k - middle);
}

/* Fills the factors of one engagement. */
static void fill_factors(inlet_analysis *c, size_t first, size_t last)
{
    size_t before = first;
    c->factor[first] = solve(c, first, 0);
    for (size_t i = 1; i <= PIECES; i++) {
        size_t k = first + (last - first) * i / PIECES;
        if (k == before)
            continue;
        c->factor[k] = solve(c, k, c->factor[before]);
        fill_between(c, before, k);
        before = k;
    }
}

static ff_status begin(ehl_estimate *e)
{
    inlet_analysis *c = (inlet_analysis *)e;
    c->speed = malloc(2 * e->count * sizeof *c->speed);
    c->mark = malloc((e->count + 2) * sizeof *c->mark);
    if (!c->speed || !c->mark)
        return FF_NOMEM;
    c->factor = c->speed + e->count;
    c->marks = 0;
    c->travel = c->solved = c->jumped = c->worst_off = 0;
    ff_status status = fill_laws(c);
    if (status != FF_OK)
        return ff_failf(e->host, FF_INVALID, NULL, "an oil law fails under pressure");
    fill_speeds(c);
    for (size_t k = 0, first = 0; k < e->count; k++)
        if (k + 1 == e->count || e->moment[k + 1].begins) {
            fill_factors(c, first, k);
            first = k + 1;
        }
    return FF_OK;
}

/* Returns rho h at x; outside the range of the marks, rho h of the nearest mark. */
static double mass_at(const inlet_analysis *c, double x)
{
    double place = x - c->travel;
    size_t low = 0, high = c->marks; /* mark[low].place > place >= mark[high].place */
    while (high - low > 1) {
        size_t middle = low + (high - low) / 2;
        if (c->mark[middle].place > place)
            low = middle;
        else
            high = middle;
    }
    const mark *front = &c->mark[low], *back = &c->mark[high];
    if (high == c->marks || place >= front->place)
        return front->mass;
    double share = (front->place - place) / (front->place - back->place);
    return front->mass + share * (back->mass - front->mass);
}

static void push(inlet_analysis *c, double x, double mass)
{
    c->mark[c->marks++] = (mark){x - c->travel, mass};
}

/* Returns the film that enters. It changes gradually from the film that entered last to the film of
   the steady inlet, while the oil stored in the inlet is replaced. If the boundary jumps by more
   than the length of the inlet, it traps at most the oil that was in the gap. */
static double entering(inlet_analysis *c, size_t k, double mass)
{
    const ehl_moment *m = &c->e.moment[k], *b = m - 1;
    double rho = c->e.oil.density, last = mass_at(c, -b->a);
    double bend = b->a * b->a / (2 * b->at.radius);
    double length = b->a * pow(3 / (4 * sqrt(2)) * last / (rho * bend), 2. / 3);
    double dt = m->at.time - b->at.time, grown = m->a - b->a;
    if (grown > length || (grown > 0 && dt <= 0)) {
        c->jumped++;
        return fmin(mass, last + rho * bend * ehl_hertz_gap(m->a / b->a));
    }
    return last - (mass - last) * expm1(-c->speed[k] * dt / length);
}

static void enter(inlet_analysis *c, size_t k)
{
    const ehl_moment *m = &c->e.moment[k];
    double mass = c->steady = exp(c->factor[k] + law(&m->at, entry_speed(c, k)));
    if (m->begins) {
        c->marks = 0;
        c->travel = 0;
        push(c, m->a, mass);
        push(c, -m->a, mass);
        return;
    }
    const ehl_moment *b = m - 1;
    mass = entering(c, k, mass);
    c->travel += (m->at.entrainment + b->at.entrainment) / 2 * (m->at.time - b->at.time);
    if (-m->a - c->travel >= c->mark[c->marks - 1].place)
        mass = mass_at(c, -m->a);
    while (c->marks > 1 && c->mark[c->marks - 1].place <= -m->a - c->travel)
        c->marks--;
    push(c, -m->a, mass);
}

/* Returns the smallest film of the marks within the contact. */
static double thinnest(const inlet_analysis *c, const ehl_moment *m)
{
    double least = HUGE_VAL, last = c->mark[c->marks - 1].place;
    size_t stride = 1;
    while (c->marks > SAMPLES * stride &&
           c->mark[c->marks - 1 - SAMPLES * stride].place < last + 2 * m->a)
        stride *= 2;
    for (size_t i = c->marks - 1;; i -= stride) {
        double s = fmax((c->mark[i].place + c->travel) / m->a, -1);
        if (s > 1)
            break;
        double film = c->mark[i].mass / density_at(c, m->p_max * sqrt(1 - s * s));
        least = film < least ? film : least;
        if (i < stride)
            break;
    }
    return least;
}

static int inside(const ehl_moment *m)
{
    return m->moes_M >= 2 && m->moes_M <= 200 && m->moes_L <= 15;
}

static void film(ehl_estimate *e, size_t k, ehl_estimate_film *out)
{
    inlet_analysis *c = (inlet_analysis *)e;
    const ehl_moment *m = &e->moment[k];
    enter(c, k);
    double through = mass_at(c, m->a);
    double leaving = fmax(2 * m->at.entrainment - c->speed[k], 0.01 * m->at.entrainment);
    leaving = fmax(leaving, LEAST_SPEED * c->speed[0]);
    double ease = c->steady / through * pow(leaving / entry_speed(c, k), SPEED_EXPONENT);
    double exit =
        ehl_exit_ratio(e->alpha, m->p_max) * through * pow(ease, EXIT_EXPONENT) / e->oil.density;
    out->h_central = mass_at(c, 0) / density_at(c, m->p_max) + m->at.gap;
    out->h_min = fmin(fmin(exit, thinnest(c, m)) + m->at.gap, out->h_central);
    out->error = (inside(m) ? 0.15 : 1) * out->h_min;
}

static void profile(const ehl_estimate *e, size_t k, size_t n, const double *x, double *h)
{
    const inlet_analysis *c = (const inlet_analysis *)e;
    const ehl_moment *m = &e->moment[k];
    for (size_t i = 0; i < n; i++) {
        double s = x[i] / m->a, p = m->p_max * sqrt(fmax(1 - s * s, 0));
        h[i] = mass_at(c, x[i]) / density_at(c, p) + m->at.gap;
    }
}

static void report(const ehl_estimate *e)
{
    const inlet_analysis *c = (const inlet_analysis *)e;
    const ff_host *host = e->host;
    char text[128];
    double outside = 0, longest = 0, hastiest = 0;
    for (size_t k = 0; k < e->count; k++) {
        const ehl_moment *m = &e->moment[k];
        outside += !inside(m);
        hastiest = fmax(hastiest, fabs(c->speed[k] - m->at.entrainment) /
                                      fmax(m->at.entrainment, LEAST_SPEED * c->speed[0]));
        if (!m->begins)
            longest = fmax(longest, (m->at.time - m[-1].at.time) * m->at.entrainment / (2 * m->a));
    }
    outside /= (double)e->count;
    host->quality(host->ctx, "outside_range", outside, 0, outside > 0 ? FF_RANGE : FF_GOOD,
                  "share of the instants outside M 2 to 200, L 0 to 15, where h_central agrees "
                  "with full solutions within 10 %");
    host->quality(host->ctx, "inlet_residual", c->worst_off, 1e-4,
                  c->worst_off > 1e-4 ? FF_DOUBTFUL : FF_GOOD,
                  "relative difference of the reduced pressure at the inlet boundary from its "
                  "required value");
    host->quality(
        host->ctx, "edge_speed", hastiest, 0.4, hastiest > 0.4 ? FF_RANGE : FF_GOOD,
        "largest speed of the inlet boundary, 0.85 da/dt, over u; above 0.4 the error of the film "
        "exceeds 10 % during one passage of the contact, at 0.7 it is 20 %");
    if (e->count > 1)
        host->quality(host->ctx, "step_per_passage", longest, 0.1,
                      longest > 0.1 ? FF_DOUBTFUL : FF_GOOD,
                      "longest time step over the passage 2 a/u; above 0.1 use more steps");
    if (c->jumped > 0)
        host->quality(host->ctx, "edge_jumps", c->jumped, 0, FF_DOUBTFUL,
                      "number of steps in which the inlet boundary moves by more than the length "
                      "of the inlet, as under a sudden load: the film trapped then is a rough "
                      "estimate");
    snprintf(text, sizeof text,
             "the inlet was solved at %.0f of %zu instants and interpolated "
             "at the others",
             c->solved, e->count);
    host->quality(host->ctx, "status", 0, 0, FF_GOOD, text);
}

static void end(ehl_estimate *e)
{
    inlet_analysis *c = (inlet_analysis *)e;
    free(c->speed);
    free(c->mark);
    c->speed = NULL;
    c->mark = NULL;
}

static ff_status create(const ff_host *host, void **self)
{
    inlet_analysis *c = calloc(1, sizeof *c);
    if (!c)
        return FF_NOMEM;
    c->e.host = host;
    c->e.begin = begin;
    c->e.film = film;
    c->e.profile = profile;
    c->e.report = report;
    c->e.end = end;
    *self = c;
    return FF_OK;
}

static const ff_param params[] = {EHL_ESTIMATE_PARAMS};

static const ff_model inlet_analysis_model = {
    .size = sizeof inlet_analysis_model,
    .abi_major = FF_ABI_MAJOR,
    .abi_minor = 3,
    .id = "ehl/inlet-analysis",
    .version = "1.0.0",
    .summary = "film of a smooth line contact from its inlet, with the laws of the oil, "
               "transported through the contact in time; hundreds of times faster than "
               "ehl/finite-volume",
    .reference = "Ertel 1939, Akad. Nauk SSSR, Prikladnaya Matematika i Mekhanika 3; Grubin & "
                 "Vinogradova 1949, TsNIITMASh Book 30; Greenwood 1972, Wear 19, 109-119 (an "
                 "extension of the Grubin theory)",
    .bibtex = BIB_ertel1939 "\n" BIB_grubin1949 "\n" BIB_greenwood1972 "\n",
    .licence = "GPL-3.0-or-later",
    .params = FF_TABLE(params),
    .self_size = sizeof(inlet_analysis),
    .inputs = ehl_estimate_inputs,
    .input_count = EHL_ESTIMATE_INPUTS,
    .input_stride = sizeof ehl_estimate_inputs[0],
    .outputs = ehl_estimate_outputs,
    .output_count = EHL_ESTIMATE_OUTPUTS,
    .output_stride = sizeof ehl_estimate_outputs[0],
    .create = create,
    .wire = ehl_estimate_wire,
    .ready = ehl_estimate_ready,
    .evaluate = ehl_estimate_evaluate,
    .destroy = free,
    .cost = 7e-4,
};

const ff_model *const *flankfilm_models_v1(void)
{
    static const ff_model *const models[] = {&ehl_film_formula_model, &inlet_analysis_model, NULL};
    return models;
}
