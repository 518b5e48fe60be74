/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "assess.h"

#include "grid.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The history is sampled at POINTS, and averaged over each of STEPS intervals of EACH points. */
enum { POINTS = 6400, STEPS = 200, EACH = POINTS / STEPS };

/* Smaller loads are replaced by this share of the largest one, so that there is always a
   contact. */
static const double LEAST_LOAD = 0.01;

/* Below this share of the largest load the film does not count. */
static const double LIGHT_LOAD = 0.02;

/* A change of the slope of the load by this much of the largest load per passage is a
   breakpoint. */
static const double SHARP_BREAKPOINT = 0.25;

/* The speed of the inlet boundary x = -a that the oil meets is this share of da/dt, and the film
   goes with that power of the speed (inlet-analysis.c). */
static const double BOUNDARY_SHARE = 0.85, SPEED_EXPONENT = 0.7;

typedef struct track {
    double *a, *u; /* m, half width; m/s, entrainment; POINTS + 1 of each */
    double *y;     /* ln of the film over that of the steady contact, of each step */
    double *P;     /* steps in one passage of the contact */
    double *memory;
} track;

static ff_status sample_history(const ehl_history *h, track *t)
{
    double begin = h->time[0], span = h->time[h->count - 1] - begin, dt = span / POINTS;
    t->memory = malloc((2 * (POINTS + 1) + 2 * STEPS) * sizeof *t->memory);
    if (!t->memory)
        return FF_NOMEM;
    t->a = t->memory;
    t->u = t->a + POINTS + 1;
    t->y = t->u + POINTS + 1;
    t->P = t->y + STEPS;
    for (size_t i = 0; i <= POINTS; i++) {
        ehl_instant at = ehl_history_at(h, i == POINTS ? begin + span : begin + (double)i * dt);
        t->a[i] =
            ehl_hertz_half_width(fmax(at.load, LEAST_LOAD * h->load_max), at.radius, h->modulus);
        t->u[i] = fmax(at.entrainment, 1e-300);
    }
    return FF_OK;
}

/*
 * Fills the change of the film by the motion of the inlet boundary, over each step: the boundary
 * x = -a meets the oil at u + 0.85 da/dt, and the film that enters goes with the power 0.7 of that.
 */
static void fill_film_changes(const ehl_history *h, track *t, ehl_conditions *s)
{
    double dt = (h->time[h->count - 1] - h->time[0]) / POINTS;
    for (size_t k = 0; k < STEPS; k++) {
        double sum = 0, passage = 0;
        for (size_t i = k * EACH + 1; i <= (k + 1) * EACH; i++) {
            double share = BOUNDARY_SHARE * (t->a[i] - t->a[i - 1]) / (dt * t->u[i]);
            s->boundary_speed = fmax(s->boundary_speed, fabs(share));
            sum += SPEED_EXPONENT * log(fmax(1 + share, 0.02));
            passage += 2 * t->a[i] / t->u[i];
        }
        t->y[k] = sum / EACH;
        t->P[k] = passage / EACH / (dt * EACH);
        s->unsteady += fabs(t->y[k]) / STEPS;
        s->dip = fmax(s->dip, -t->y[k]);
        t->y[k] += SPEED_EXPONENT * log(t->u[(2 * k + 1) * EACH / 2]);
    }
}

/*
 * Returns the error of two-step differences with steps dt: a wave of the film gathers the
 * truncation dt^3 y'''/3 per step over P/2 steps, until it has left the contact. Straight lines
 * between the steps miss another tenth of dt^2 y''.
 */
static double truncation_constant(const track *t)
{
    double sum = 0;
    for (size_t k = 0; k + 3 < STEPS; k++) {
        const double *y = &t->y[k];
        double third = fabs(y[3] - 3 * y[2] + 3 * y[1] - y[0]),
               second = fabs(y[2] - 2 * y[1] + y[0]);
        sum += fmin(third / 6 * t->P[k] + 0.1 * second, 0.5);
    }
    return sum / (STEPS - 3);
}

/* Returns the number of steps over c^(-1/2), the integral of 1/dt, when each step dt has the
   truncation c of the film per passage: dt^2 P y'''/3 = c. */
static double step_integral(const track *t)
{
    double sum = 0;
    for (size_t k = 0; k + 3 < STEPS; k++) {
        const double *y = &t->y[k];
        sum += sqrt(fabs(y[3] - 3 * y[2] + 3 * y[1] - y[0]) * t->P[k] / 3);
    }
    return sum;
}

/* Returns the change of the slope of the load at row i, N/(m s). */
static double slope_jump(const ehl_history *h, size_t i)
{
    double before = h->time[i] - h->time[i - 1], after = h->time[i + 1] - h->time[i];
    if (!(before > 0 && after > 0))
        return HUGE_VAL;
    return fabs((h->load[i + 1] - h->load[i]) / after - (h->load[i] - h->load[i - 1]) / before);
}

/* Counts the breakpoints, at which automatic steps start anew, as step-control.c does. */
static void count_breakpoints(const ehl_history *h, double passage, ehl_conditions *s)
{
    for (size_t i = 0; i < h->count; i++) {
        double step = i > 0 ? fabs(h->load[i] - h->load[i - 1]) : 0;
        s->jumps |= i > 0 && !(h->time[i] > h->time[i - 1]) && step > LIGHT_LOAD * h->load_max;
        s->lost |= ehl_is_lost(h, h->load[i]);
        s->breakpoints += i > 0 && i + 1 < h->count &&
                          passage * slope_jump(h, i) > SHARP_BREAKPOINT * h->load_max;
    }
}

static const char rigid_isoviscous[] = "rigid, isoviscous";

/* Names which of Moes' four asymptotes holds for the film (formula.c). */
static const char *regime_of(double M, double L)
{
    double rigid = 3 / M, elastic = 2.621 * pow(M, -0.2);
    double rigid_piezo = 1.287 * pow(L, 2. / 3);
    double elastic_piezo = 1.311 * pow(M, -0.125) * pow(L, 0.75);
    if (fmax(rigid, elastic) > fmin(rigid_piezo, elastic_piezo))
        return rigid > elastic ? rigid_isoviscous : "elastic, isoviscous";
    return rigid_piezo < elastic_piezo ? "rigid, piezoviscous" : "elastic, piezoviscous";
}

/* Returns |tau| in the middle of the contact with the film of Moes, Pa. */
static double shear_at(const ehl_laws *laws, const ehl_instant *at, double modulus, double h)
{
    double p = ehl_hertz_pressure(at->load, at->radius, modulus), ln_eta, tau = 0;
    if (h > 0 && ehl_fluid_shear(laws, 1, &p, &h, at->sliding, &ln_eta, &tau) < 0)
        return 0;
    return isfinite(tau) ? fabs(tau) : 0;
}

static double buildup_length(const ehl_instant *at, double modulus, double h)
{
    return ehl_inlet_buildup(ehl_hertz_half_width(at->load, at->radius, modulus), at->radius, h);
}

static void read_row(const ehl_history *h, const ehl_laws *laws, const ehl_oil *oil, size_t row,
                     ehl_conditions *s)
{
    ehl_instant at = ehl_history_row(h, row);
    double two_u = 2 * oil->viscosity * at.entrainment / (h->modulus * at.radius);
    double M = at.load / (h->modulus * at.radius * sqrt(fmax(two_u, 1e-300)));
    double L = oil->alpha * h->modulus * sqrt(sqrt(two_u)),
           film = ehl_moes_film(&at, h->modulus, oil);
    s->light += (M < 1) / (double)h->count;
    s->M_high = fmax(s->M_high, M);
    s->L_high = fmax(s->L_high, L);
    if (at.load < LIGHT_LOAD * h->load_max)
        return;
    s->M_low = fmin(s->M_low, M);
    if (row == h->count / 2)
        s->regime = regime_of(M, fmax(L, 1e-6));
    if (film > 0)
        s->buildup = fmin(s->buildup, buildup_length(&at, h->modulus, film));
    s->shear = fmax(s->shear, shear_at(laws, &at, h->modulus, film));
}

/* Returns the build-up length l whose 1/l^2 is the mean of all, weighted by the film: the error of
   the mean film goes with 1/l^2. */
static double mean_buildup_length(const ehl_history *h, const ehl_oil *oil)
{
    enum { SAMPLES = 400 };
    double begin = h->time[0], span = h->time[h->count - 1] - begin, films = 0, sum = 0;
    for (size_t i = 0; i <= SAMPLES; i++) {
        ehl_instant at = ehl_history_at(h, begin + span * (double)i / SAMPLES);
        at.load = fmax(at.load, LEAST_LOAD * h->load_max);
        double film = ehl_moes_film(&at, h->modulus, oil);
        if (!(film > 0))
            continue;
        double rise = buildup_length(&at, h->modulus, film);
        films += film;
        sum += film / (rise * rise);
    }
    return sum > 0 ? sqrt(films / sum) : 0;
}

/* Returns the film parameter, least film over the combined roughness; 0: smooth. */
static double film_parameter(const ehl_history *h, const ehl_oil *oil, const double *rq_1,
                             const double *rq_2)
{
    double rough = hypot(rq_1 ? *rq_1 : 0, rq_2 ? *rq_2 : 0), least = HUGE_VAL;
    for (size_t i = 0; i < h->count; i++) {
        ehl_instant at = ehl_history_row(h, i);
        if (at.load >= LIGHT_LOAD * h->load_max)
            least = fmin(least, 0.75 * ehl_moes_film(&at, h->modulus, oil));
    }
    return rough > 0 ? fmax(least / rough, 1e-300) : 0;
}

/* Returns ln of the film that enters in step k, with its change by the motion of the inlet
   boundary. */
static double log_entering_film(const ehl_history *h, const ehl_oil *oil, const track *t, size_t k)
{
    double begin = h->time[0], dt = (h->time[h->count - 1] - begin) / STEPS;
    ehl_instant at = ehl_history_at(h, begin + ((double)k + 0.5) * dt);
    at.load = fmax(at.load, LEAST_LOAD * h->load_max);
    double motion = t->y[k] - SPEED_EXPONENT * log(t->u[(2 * k + 1) * EACH / 2]);
    return log(fmax(ehl_moes_film(&at, h->modulus, oil), 1e-300)) + motion;
}

/* Returns the least film that enters under load, m. */
static double least_entering(const ehl_history *h, const ehl_oil *oil, const track *t)
{
    double begin = h->time[0], dt = (h->time[h->count - 1] - begin) / STEPS, least = HUGE_VAL;
    for (size_t k = 0; k < STEPS; k++)
        if (ehl_history_at(h, begin + ((double)k + 0.5) * dt).load >= LIGHT_LOAD * h->load_max)
            least = fmin(least, exp(log_entering_film(h, oil, t, k)));
    return least;
}

/* Returns the mean second difference of ln of the film that enters. */
static double mean_curvature(const ehl_history *h, const ehl_oil *oil, const track *t)
{
    double sum = 0, y[3] = {log_entering_film(h, oil, t, 0), log_entering_film(h, oil, t, 1), 0};
    for (size_t k = 2; k < STEPS; k++) {
        y[2] = log_entering_film(h, oil, t, k);
        sum += fabs(y[2] - 2 * y[1] + y[0]) / (STEPS - 2);
        y[0] = y[1];
        y[1] = y[2];
    }
    return sum;
}

/* Finds the instants that may have the lowest film; `later` is the least film that enters, with its
   change by the motion of the inlet boundary. */
static void find_thinnest_instants(const ehl_history *h, const ehl_oil *oil, double later,
                                   ehl_conditions *s)
{
    const double alike = 1.2, sooner = 1.08, loaded = LIGHT_LOAD * h->load_max;
    ehl_instant first = ehl_history_row(h, 0), thinnest = first;
    double least = HUGE_VAL,
           start = first.load >= loaded ? ehl_moes_film(&first, h->modulus, oil) : 0;
    for (size_t i = 0; i < h->count; i++) {
        ehl_instant at = ehl_history_row(h, i);
        double film = ehl_moes_film(&at, h->modulus, oil);
        if (at.load >= loaded && film > 0 && film < least) {
            least = film;
            thinnest = at;
        }
    }
    if (!(least < HUGE_VAL))
        return;
    s->starts_thin = start > 0 && start < sooner * later;
    s->thin[s->thin_count++] = thinnest;
    if (start > 0 && thinnest.time > first.time && start < alike * least)
        s->thin[s->thin_count++] = first;
}

ff_status ehl_conditions_read(const ehl_history *h, const ehl_laws *laws, const ehl_oil *oil,
                              const double *rq_1, const double *rq_2, ehl_conditions *s)
{
    ehl_grid grid;
    track t = {.memory = NULL};
    *s = (ehl_conditions){.M_low = HUGE_VAL,
                          .buildup = HUGE_VAL,
                          .regime = "unloaded in the middle",
                          .newtonian = laws->rheology == NULL,
                          .steady = h->count == 1};
    ehl_grid_fit(&grid, 1, 0, 0, h, oil, hypot(rq_1 ? *rq_1 : 0, rq_2 ? *rq_2 : 0));
    s->domain = grid.dx;
    s->half_width = grid.half_width;
    for (size_t i = 0; i < h->count; i++)
        read_row(h, laws, oil, i, s);
    s->M_low = fmin(s->M_low, s->M_high);
    s->lambda = film_parameter(h, oil, rq_1, rq_2);
    s->mean_buildup = fmax(mean_buildup_length(h, oil), s->buildup);
    if (!(s->domain > 0 && isfinite(s->domain) && s->buildup > 0 && isfinite(s->buildup)))
        return FF_INVALID;
    if (s->steady)
        return FF_OK;
    ff_status status = sample_history(h, &t);
    if (status == FF_OK) {
        fill_film_changes(h, &t, s);
        s->truncation_constant = truncation_constant(&t);
        s->step_integral = step_integral(&t);
        double passage = 2 * grid.half_width / t.u[0];
        s->passage = passage / (h->time[h->count - 1] - h->time[0]);
        count_breakpoints(h, passage, s);
        s->curvature = mean_curvature(h, oil, &t);
        find_thinnest_instants(h, oil, least_entering(h, oil, &t), s);
    }
    free(t.memory);
    return status;
}

/* Under light loads, and where viscosity rises very steeply, the pressure has a spike. */
int ehl_has_spike(const ehl_conditions *s)
{
    return s->L_high > 12 || (s->M_high < 16 && s->L_high > 8);
}

/* Estimates the error of Hertz's pressure as the highest one: it lacks the spike, and what the flow
   adds where the load is light or the contact outruns the oil. */
static double hertz_error(const ehl_conditions *s)
{
    double light_load = 0.45 * fmax(0, 1 - s->M_high / 20) + fmax(0, 1 - s->M_high / 2);
    return 0.03 + light_load + 0.03 * fmax(s->boundary_speed - 0.8, 0) +
           (ehl_has_spike(s) ? 0.2 : 0);
}

/* Estimates the error of the friction. That of a Newtonian oil depends on the highest pressure,
   which no formula gives. */
static double traction_error(const ehl_conditions *s)
{
    double light_load = fmax(0, 1 - s->M_high / 10);
    return s->newtonian && ehl_has_spike(s) ? 1 : 0.3 + 3 * light_load * light_load;
}

/*
 * Estimates the error of neglecting the roughness, which is small for a film many times as thick.
 * The numbers come from rough solutions of mesh cycles with synthetic flanks, lambda 3 to 40
 * (tests/plugins/ehl/smooth.py draws some): peaks take up to two Rq from the lowest film.
 */
double ehl_rough_error(const ehl_conditions *s, ehl_error_targets w)
{
    double error = 0;
    if (!(s->lambda > 0))
        return 0;
    if (w.film || w.lowest)
        error = 2 / fmax(s->lambda - 2, 0.02);
    if (w.pressure)
        error = fmax(error, 1.5 / s->lambda);
    return w.friction ? fmax(error, 0.6 / s->lambda) : error;
}

double ehl_worst_error(ehl_error_targets w, double film, double lowest, double pressure,
                       double friction)
{
    double error = w.film ? fmax(film, lowest) : w.lowest ? lowest : 0;
    error = w.pressure ? fmax(error, pressure) : error;
    return w.friction ? fmax(error, friction) : error;
}

/* Estimates the error of Moes' formula: 7 to 11 % under steady loads, more where the inlet boundary
   moves, which it neglects. For a rigid cylinder with an isoviscous film it becomes Martin's
   formula, 2.5 % off the least film; it does not tell the least film from the film at x = 0. */
double ehl_formula_error(const ehl_conditions *s, ehl_error_targets w)
{
    const int martin = s->steady && s->M_high < 1 && !strcmp(s->regime, rigid_isoviscous);
    if (martin && s->L_high < 0.5)
        return ehl_worst_error(w, 0.25, 0.04, 1, 1);
    double none = s->light > 0.1 ? 0.8 : 0;
    double film = 0.1 + 0.9 * s->unsteady + none;
    double lowest = 0.1 + fmin(0.25 * fmax(s->dip - 0.35, 0), 0.8) + none;
    return ehl_worst_error(w, film, lowest, hertz_error(s), traction_error(s));
}

/* Estimates the error of the inlet analysis: 3 to 6 %, 12 % of the least film, and more where the
   inlet boundary is fast. */
double ehl_inlet_error(const ehl_conditions *s, ehl_error_targets w)
{
    double none = s->light * s->light * 0.4;
    double film = 0.06 + 0.4 * s->unsteady + none;
    double lowest = 0.11 + 0.35 * fmax(s->boundary_speed - 0.4, 0) + none;
    return ehl_worst_error(w, film, lowest, hertz_error(s), traction_error(s));
}

void ehl_conditions_print(const ehl_conditions *s, char *out, size_t size)
{
    size_t at = (size_t)snprintf(out, size, "Moes M %.2g to %.2g, L %.2g: %s; ", s->M_low,
                                 s->M_high, s->L_high, s->regime);
    if (at < size && s->steady)
        at += (size_t)snprintf(out + at, size - at, "steady");
    else if (at < size)
        at += (size_t)snprintf(out + at, size - at,
                               "squeeze number (speed of the contact's edge over u) up to %.2g: a "
                               "film that is steady at every instant misses %.2g %% on the mean%s",
                               s->boundary_speed, 100 * s->unsteady,
                               s->lost    ? "; contact is lost"
                               : s->jumps ? "; the load jumps"
                                          : "");
    if (at < size && s->shear > 1e9)
        at += (size_t)snprintf(out + at, size - at,
                               "; shear stress beyond 1 GPa, where no oil flows like this");
    else if (at < size && s->shear > 0)
        at +=
            (size_t)snprintf(out + at, size - at, "; shear stress up to %.2g MPa", 1e-6 * s->shear);
    if (at < size && s->probe.cells > 0)
        at += (size_t)snprintf(out + at, size - at,
                               "; %zu cells are %.2g %% off on steady films, as tried (work %.2g)",
                               s->probe.cells, 100 * fmax(s->probe.least, s->probe.central),
                               s->probe.work);
    if (at < size && s->lambda > 0)
        snprintf(out + at, size - at, "; film parameter lambda %.2g: %s", s->lambda,
                 s->lambda < EHL_MIXED_BELOW
                     ? "mixed: only a rough film will do, whose error is not known "
                       "beforehand"
                     : "smooth enough but for the roughness that rides on it");
}
