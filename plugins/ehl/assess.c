/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "assess.h"

#include "grid.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Points of the history that are looked at, and steps of the ripple: each is a mean of 32 points.
 */
enum { POINTS = 6400, STEPS = 200, EACH = POINTS / STEPS };

/* Share of the largest load below which that share stands in. */
static const double light = 0.01;

typedef struct track {
    double *a, *u; /* half width, entrainment; POINTS + 1 */
    double *y;     /* ln of the film over that of the same contact at rest, of each step */
    double *P;     /* steps in one passage of the contact */
    double *memory;
} track;

static ff_status fill_track(const ff_history *h, track *t)
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
        ff_instant at = ff_history_at(h, i == POINTS ? begin + span : begin + (double)i * dt);
        t->a[i] = ff_hertz_half_width(fmax(at.load, light * h->load_max), at.radius, h->modulus);
        t->u[i] = fmax(at.entrainment, 1e-300);
    }
    return FF_OK;
}

/*
 * The edge x = -a meets the oil at u + 0.85 da/dt, and the film that enters goes with the power 0.7
 * of that (inlet-analysis.c): what the motion of the edge makes of it, over each step.
 */
static void fill_ripples(const ff_history *h, track *t, ff_scene *s)
{
    double dt = (h->time[h->count - 1] - h->time[0]) / POINTS;
    for (size_t k = 0; k < STEPS; k++) {
        double sum = 0, passage = 0;
        for (size_t i = k * EACH + 1; i <= (k + 1) * EACH; i++) {
            double share = 0.85 * (t->a[i] - t->a[i - 1]) / (dt * t->u[i]);
            s->edge = fmax(s->edge, fabs(share));
            sum += 0.7 * log(fmax(1 + share, 0.02));
            passage += 2 * t->a[i] / t->u[i];
        }
        t->y[k] = sum / EACH;
        t->P[k] = passage / EACH / (dt * EACH);
        s->unsteady += fabs(t->y[k]) / STEPS;
        s->dip = fmax(s->dip, -t->y[k]);
        t->y[k] += 0.7 * log(t->u[(2 * k + 1) * EACH / 2]);
    }
}

/*
 * Two-step differences of step dt carry a wave of the film with the truncation dt^3 y'''/3 per step
 * over P/2 steps, until it has left the contact; a tenth of dt^2 y'' is what straight lines between
 * the steps miss.
 */
static double ripple_of(const track *t)
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

static void find_knots(const ff_history *h, ff_scene *s)
{
    for (size_t i = 0; i < h->count; i++) {
        double step = i > 0 ? fabs(h->load[i] - h->load[i - 1]) : 0;
        s->jumps |= i > 0 && !(h->time[i] > h->time[i - 1]) && step > 0.02 * h->load_max;
        s->lost |= ff_is_lost(h, h->load[i]);
    }
}

static const char rigid_isoviscous[] = "rigid, isoviscous";

/* Which of Moes' four asymptotes is the film's (formula.c). */
static const char *regime_of(double M, double L)
{
    double rigid = 3 / M, elastic = 2.621 * pow(M, -0.2);
    double rigid_piezo = 1.287 * pow(L, 2. / 3);
    double elastic_piezo = 1.311 * pow(M, -0.125) * pow(L, 0.75);
    if (fmax(rigid, elastic) > fmin(rigid_piezo, elastic_piezo))
        return rigid > elastic ? rigid_isoviscous : "elastic, isoviscous";
    return rigid_piezo < elastic_piezo ? "rigid, piezoviscous" : "elastic, piezoviscous";
}

/* tau in the middle of the contact, by the Moes film. */
static double shear_at(const ff_laws *laws, const ff_instant *at, double modulus, double h)
{
    double p = ff_hertz_pressure(at->load, at->radius, modulus), ln_eta, tau = 0;
    if (h > 0 && ff_fluid_shear(laws, 1, &p, &h, at->sliding, &ln_eta, &tau) < 0)
        return 0;
    return isfinite(tau) ? fabs(tau) : 0;
}

/* As ff_results finds it when the film is known: where the Hertzian gap has grown by h. */
static double rise_of(const ff_instant *at, double modulus, double h)
{
    double a = ff_hertz_half_width(at->load, at->radius, modulus);
    double sharp = a * pow(3 / (2 * sqrt(2)) * h * at->radius / (a * a), 2. / 3);
    return fmin(sharp, sqrt(2 * at->radius * h));
}

static void look_at(const ff_history *h, const ff_laws *laws, const ff_oil *oil, size_t row,
                    ff_scene *s)
{
    ff_instant at = ff_history_row(h, row);
    double two_u = 2 * oil->viscosity * at.entrainment / (h->modulus * at.radius);
    double M = at.load / (h->modulus * at.radius * sqrt(fmax(two_u, 1e-300)));
    double L = oil->alpha * h->modulus * sqrt(sqrt(two_u)),
           film = ff_moes_film(&at, h->modulus, oil);
    s->light += (M < 1) / (double)h->count;
    s->M_high = fmax(s->M_high, M);
    s->L_high = fmax(s->L_high, L);
    if (at.load < 0.02 * h->load_max)
        return;
    s->M_low = fmin(s->M_low, M);
    if (row == h->count / 2)
        s->regime = regime_of(M, fmax(L, 1e-6));
    if (film > 0)
        s->rise = fmin(s->rise, rise_of(&at, h->modulus, film));
    s->shear = fmax(s->shear, shear_at(laws, &at, h->modulus, film));
}

/* Film parameter, least film over the combined roughness; 0: smooth. */
static double film_parameter(const ff_history *h, const ff_oil *oil, const double *rq_1,
                             const double *rq_2)
{
    double rough = hypot(rq_1 ? *rq_1 : 0, rq_2 ? *rq_2 : 0), least = HUGE_VAL;
    for (size_t i = 0; i < h->count; i++) {
        ff_instant at = ff_history_row(h, i);
        if (at.load >= 0.02 * h->load_max)
            least = fmin(least, 0.75 * ff_moes_film(&at, h->modulus, oil));
    }
    return rough > 0 ? fmax(least / rough, 1e-300) : 0;
}

ff_status ff_scene_read(const ff_history *h, const ff_laws *laws, const ff_oil *oil,
                        const double *rq_1, const double *rq_2, ff_scene *s)
{
    ff_grid grid;
    track t = {.memory = NULL};
    *s = (ff_scene){.M_low = HUGE_VAL,
                    .rise = HUGE_VAL,
                    .regime = "unloaded in the middle",
                    .steady = h->count == 1};
    ff_grid_fit(&grid, 1, 0, 0, h, oil, hypot(rq_1 ? *rq_1 : 0, rq_2 ? *rq_2 : 0));
    s->domain = grid.dx;
    for (size_t i = 0; i < h->count; i++)
        look_at(h, laws, oil, i, s);
    s->M_low = fmin(s->M_low, s->M_high);
    s->lambda = film_parameter(h, oil, rq_1, rq_2);
    if (!(s->domain > 0 && isfinite(s->domain) && s->rise > 0 && isfinite(s->rise)))
        return FF_INVALID;
    if (s->steady)
        return FF_OK;
    ff_status status = fill_track(h, &t);
    if (status == FF_OK) {
        fill_ripples(h, &t, s);
        s->ripple = ripple_of(&t);
        find_knots(h, s);
    }
    free(t.memory);
    return status;
}

/* Highest pressure as Hertz's: without a spike and without hydrodynamic spreading. */
static double hertz_error(const ff_scene *s)
{
    return 0.02 + 0.4 * fmax(0, 1 - s->M_high / 20);
}

static double traction_error(const ff_scene *s)
{
    double light_load = fmax(0, 1 - s->M_high / 10);
    return 0.2 + 3 * light_load * light_load;
}

/*
 * A film many times the roughness hardly knows of it. Against rough solutions of gears' mesh cycles
 * with synthetic flanks, lambda 3 to 40 (tests/plugins/ehl/smooth.py draws some): valleys and peaks
 * take up to two Rq from the lowest film.
 */
double ff_rough_error(const ff_scene *s, ff_wishes w)
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

static double worst(ff_wishes w, double film, double lowest, double pressure, double friction)
{
    double error = w.film ? fmax(film, lowest) : w.lowest ? lowest : 0;
    error = w.pressure ? fmax(error, pressure) : error;
    return w.friction ? fmax(error, friction) : error;
}

/* 7 to 11 % under steady loads; more by what it does not know, the motion of the edge. A rigid
   cylinder under an isoviscous film is Martin's: 2.5 % off the least film, and the film at x = 0,
   which is the least there, is not told from that of the flow. */
double ff_formula_error(const ff_scene *s, ff_wishes w)
{
    const int martin = s->steady && s->M_high < 1 && !strcmp(s->regime, rigid_isoviscous);
    if (martin && s->L_high < 0.5)
        return worst(w, 0.25, 0.04, 1, 1);
    double none = s->light > 0.1 ? 0.8 : 0;
    double film = 0.1 + 0.9 * s->unsteady + none;
    double lowest = 0.1 + fmin(0.25 * fmax(s->dip - 0.35, 0), 0.8) + none;
    return worst(w, film, lowest, hertz_error(s), traction_error(s));
}

/* 3 to 6 %, and 12 % where it is thinnest; more where the edge outruns the inlet. */
double ff_inlet_error(const ff_scene *s, ff_wishes w)
{
    double none = s->light * s->light * 0.4;
    double film = 0.06 + 0.4 * s->unsteady + none;
    double lowest = 0.11 + 0.35 * fmax(s->edge - 0.4, 0) + none;
    return worst(w, film, lowest, hertz_error(s), traction_error(s));
}

static size_t round_up(double cells)
{
    static const size_t sizes[] = {96,  128, 160,  192,  224,  256,  320,  384,  448,  512, 640,
                                   768, 896, 1024, 1280, 1536, 1792, 2048, 2560, 3072, 4096};
    size_t k = 0, last = sizeof sizes / sizeof sizes[0] - 1;
    while (k < last && (double)sizes[k] < cells)
        k++;
    return sizes[k];
}

/* Film over n cells in the inlet's rise: 0.3/n^2 (results.c), more where viscosity rises steeply,
   where the edge outruns the oil, so that the film dips to almost nothing, and where it carries
   waves through a long contact. */
static double space_factor(const ff_scene *s)
{
    double waves = fmin(s->edge, 1) * fmax(s->M_high - 30, 0);
    return 0.3 * (1 + 0.12 * fmax(s->L_high - 6, 0) + 1.2 * fmax(s->edge - 0.8, 0) + 0.025 * waves);
}

static void tune_space(const ff_scene *s, double accuracy, int given, ff_tuning *t)
{
    double factor = space_factor(s), per_cell = s->rise / s->domain;
    if (!(given & FF_TUNE_CELLS))
        t->cells = round_up(sqrt(factor / accuracy) / per_cell);
    double n = (double)t->cells * per_cell;
    t->space = fmin(factor / (n * n), 1);
}

/* Equal steps; those of an uneven history, whose kinks they miss, are not to be trusted. */
static double equal_error(const ff_scene *s, double steps)
{
    double ratio = STEPS / steps, order = ratio < 1 ? 1.5 : 1;
    double error = 2 * s->ripple * pow(ratio, order) + 0.006 * ratio * ratio;
    return s->jumps || s->lost ? fmax(error, 0.06 * fmin(1, 1600 / steps)) : error;
}

/* Steps that land on the kinks and keep their truncation: a tenth of the tolerance comes through,
   more in flight, where ten times as much is allowed. */
static double own_error(const ff_scene *s, double tolerance)
{
    return (s->lost ? 0.6 : 0.12) * tolerance;
}

static double own_count(const ff_scene *s, double tolerance)
{
    return (200 + 15000 * s->ripple) * pow(0.08 / tolerance, 0.6);
}

static void tune_time(const ff_scene *s, double accuracy, int given, ff_tuning *t)
{
    static const size_t few[] = {100, 200, 400};
    if (!(given & FF_TUNE_TOLERANCE))
        t->tolerance = fmax(fmin(accuracy / own_error(s, 1), 0.08), 1e-4);
    if (!(given & FF_TUNE_STEPS)) {
        t->steps = 0;
        for (size_t k = 0; k < sizeof few / sizeof few[0] && t->steps == 0; k++)
            if (equal_error(s, (double)few[k]) <= accuracy)
                t->steps = few[k];
        if (t->steps > 0 && (double)t->steps > own_count(s, t->tolerance))
            t->steps = 0;
    }
    t->count = t->steps > 0 ? (double)t->steps : own_count(s, t->tolerance);
    t->time = t->steps > 0 ? equal_error(s, t->count) : own_error(s, t->tolerance);
}

void ff_tune(const ff_scene *s, double accuracy, int given, ff_tuning *t)
{
    const double in_space = 0.5;
    tune_space(s, s->steady ? accuracy : in_space * accuracy, given, t);
    t->count = 1;
    t->time = 0;
    if (!s->steady)
        tune_time(s, (1 - in_space) * accuracy, given, t);
    /* a spike of the pressure under light loads is as high as the grid lets it be */
    t->pressure = s->M_high < 12 || s->L_high > 12 ? 0.3 : t->space + t->time;
    t->friction = 2 * (t->space + t->time);
}

double ff_tuned_error(const ff_tuning *t, ff_wishes w)
{
    double film = t->space + t->time;
    return worst(w, film, film, t->pressure, t->friction);
}

void ff_scene_print(const ff_scene *s, char *out, size_t size)
{
    size_t at = (size_t)snprintf(out, size, "Moes M %.2g to %.2g, L %.2g: %s; ", s->M_low,
                                 s->M_high, s->L_high, s->regime);
    if (at < size && s->steady)
        at += (size_t)snprintf(out + at, size - at, "steady");
    else if (at < size)
        at += (size_t)snprintf(out + at, size - at,
                               "squeeze number (speed of the contact's edge over u) up to %.2g: a "
                               "film that is steady at every instant misses %.2g %% on the mean%s",
                               s->edge, 100 * s->unsteady,
                               s->lost    ? "; contact is lost"
                               : s->jumps ? "; the load jumps"
                                          : "");
    if (at < size && s->shear > 1e9)
        at += (size_t)snprintf(out + at, size - at,
                               "; shear stress beyond 1 GPa, where no oil flows like this");
    else if (at < size && s->shear > 0)
        at +=
            (size_t)snprintf(out + at, size - at, "; shear stress up to %.2g MPa", 1e-6 * s->shear);
    if (at < size && s->lambda > 0)
        snprintf(out + at, size - at, "; film parameter lambda %.2g: %s", s->lambda,
                 s->lambda < FF_MIXED_BELOW
                     ? "mixed: only a rough film will do, whose error is not known "
                       "beforehand"
                     : "smooth enough but for the roughness that rides on it");
}
