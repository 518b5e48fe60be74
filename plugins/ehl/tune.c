/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Estimates error and cost of a film solver before the run, and proposes its settings. */
#include "assess.h"
#include "judge.h"
#include "outputs.h"
#include "stage.h"

#include <flankfilm/author.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Numbers n of cells such that Fourier transforms of length 2 n are fast. */
static const size_t CELLS[] = {96,   112,  128,  144,  160,  176,  192,  208,  224,
                               240,  256,  288,  320,  352,  384,  416,  448,  480,
                               512,  576,  640,  704,  768,  832,  896,  960,  1024,
                               1152, 1280, 1536, 1792, 2048, 2560, 3072, 3584, 4096};
enum { CELL_COUNTS = sizeof CELLS / sizeof CELLS[0] };

/* An inlet boundary faster than this, over u, makes waves in the film that travel through the
   contact and that no steady film shows. */
static const double SWIFT = 0.8;
/* A boundary that recedes faster than this, over u, leaves the oil behind: the waves are steep
   then. */
static const double PINCHING = 1.1;

/* Moes' M above which the film behind a receding boundary is off by far more than a steady one. */
static const double HEAVY_M = 90;

/* Below this `unsteady` there are no waves except those from changes of the pairs in contact. */
static const double STEADY = 0.02;

/* Time tolerance of the runs that the errors in time were fitted to. */
static const double REFERENCE_TOLERANCE = 0.16;

/* Part of the tolerance that is proposed, as two printed digits may round it up. */
static const double PRINTED_SHARE = 0.97;

typedef struct errors {
    double mean, lowest;
} errors;

/*
 * Estimates the error by the cells without a probe solve. The lowest film needs a number of cells
 * over the shortest pressure build-up length of the inlet, and more where viscosity rises steeply
 * under a high load or the inlet boundary outruns the oil; the mean film needs a number over the
 * mean build-up length. The formulas are fitted (assess.h) with a scatter of 50 % in the error, of
 * which 1.7 times are added.
 */
static errors space_error_guess(const ehl_conditions *s, double cells)
{
    const double usual = 0.013;
    double excess_speed = fmax(s->boundary_speed - SWIFT, 0),
           steep = s->L_high * log(fmax(s->M_high, 3));
    double lowest = 1.17 * pow(s->domain / s->buildup, 1.18) *
                    exp(0.014 * steep + 0.2 * excess_speed + 0.37 * s->unsteady);
    double mean = 9.8 * pow(s->domain / s->buildup, 0.26) * pow(s->domain / s->mean_buildup, 0.65) *
                  exp(0.023 * s->L_high + 0.08 * excess_speed);
    double a = cells / lowest, b = cells / mean;
    return (errors){.lowest = usual * pow(a, a < 1 ? -3 : -2.2),
                    .mean = usual * pow(b, b < 1 ? -3 : -2.2)};
}

/* Estimates the error of the troughs of waves: the worst of some thirty gear scenes, of which
   others show almost none. Long contacts carry waves far. */
static errors space_error_of_waves(const ehl_conditions *s, double cells, errors guess)
{
    int steep = s->boundary_speed > PINCHING;
    double half = s->half_width / s->domain * cells; /* cells over a */
    double times = s->M_high > HEAVY_M ? 8 : steep ? 5.5 : 3;
    return (errors){.lowest = fmax(times * guess.lowest, (steep ? 150 : 60) / (half * half)),
                    .mean = guess.mean};
}

/*
 * Estimates the error by the cells from a probe solve. It falls fast with the cells on coarse
 * grids, and about with their square on fine ones. The error of h_min may pass through 0, so that
 * the error at x = 0 counts as well, but in part only: the film of nearly rigid flanks alone is
 * flat there. The mean film has about half to two thirds of the error of the lowest films, which
 * are the worst. The factors cover films that the probe has not solved.
 */
static errors space_error(const ehl_conditions *s, double cells)
{
    const double PROBE_RANGE = 0.72; /* below this share of its cells a probe solve says little */
    const ehl_probe *p = &s->probe;
    errors guess = space_error_guess(s, cells);
    if (p->cells == 0)
        return guess;
    double ratio = cells / (double)p->cells, fall = pow(ratio, ratio < 1 ? -3.6 : -2.2);
    double share = s->unsteady < STEADY ? 0.62 : 0.45, flat = s->M_high < 3 ? 1 : 0.45;
    errors e = {.lowest = 1.3 * fmax(p->least, flat * p->central) * fall,
                .mean = share * fmax(p->least, p->central) * fall};
    if (ratio < PROBE_RANGE)
        e = (errors){.lowest = fmax(e.lowest, guess.lowest), .mean = fmax(e.mean, guess.mean)};
    if (s->boundary_speed > SWIFT || (s->M_high > HEAVY_M && s->boundary_speed > 0.3)) {
        errors waves = space_error_of_waves(s, cells, guess);
        e.lowest = fmax(e.lowest, waves.lowest);
        e.mean = fmax(e.mean, waves.mean);
    }
    return e;
}

/* Estimates the error of equal steps, which miss the breakpoints of an uneven history. */
static errors error_of_equal_steps(const ehl_conditions *s, double steps)
{
    double ratio = 200 / steps, order = ratio < 1 ? 1.5 : 1;
    double error = 2 * s->truncation_constant * pow(ratio, order) + 0.006 * ratio * ratio;
    if (s->jumps || s->lost)
        error = fmax(error, 0.06 * fmin(1, 1600 / steps));
    return (errors){.mean = error, .lowest = error};
}

/*
 * Estimates the mean error of steps that end at the breakpoints and keep their truncation, at
 * REFERENCE_TOLERANCE. It grows with the curvature in time of the film that enters, and falls where
 * the inlet boundary is fast and steps are short for that reason (a scatter of 40 %, doubled). It
 * is no more than a share of the unsteady part of the film; that share is largest under slow waves,
 * which hardly change within a passage. While the contact is lost ten times the truncation is
 * allowed, which shows in films of rigid flanks.
 */
static double mean_time_error(const ehl_conditions *s)
{
    if (s->unsteady < STEADY)
        return 2e-4 + 0.24 * s->unsteady;
    double curved = 0.046 * pow(s->curvature, 0.66) * pow(s->boundary_speed, -1.35);
    double slow = 0.65 * pow(0.025 / s->passage, 1.5);
    double moved = s->unsteady * fmax(0.14, fmin(slow, 0.65));
    double waves = fmin(fmin(curved, moved), s->boundary_speed > 0.4 ? 0.0125 : 0.022);
    return fmax(waves, 5e-4) + (s->lost && s->M_high < 5 ? 0.008 : 0);
}

/* Returns the error of the lowest film per tolerance. That film may be the trough after a single
   change of the load, or lie anywhere in waves; the steady film of the first instant has no error
   in time. */
static double lowest_time_error(const ehl_conditions *s)
{
    return s->unsteady < STEADY ? 0.075 : s->starts_thin ? 0.015 : 0.036;
}

/* The mean error grows with this power of the tolerance. */
static const double MEAN_EXPONENT = 0.85;

static errors error_of_tolerance(const ehl_conditions *s, double tolerance)
{
    return (errors){.mean =
                        mean_time_error(s) * pow(tolerance / REFERENCE_TOLERANCE, MEAN_EXPONENT),
                    .lowest = lowest_time_error(s) * tolerance * (1 + tolerance)};
}

/* Returns the tolerance whose error in time is `left`, what the cells leave of the accuracy. */
static double tolerance_for(const ehl_conditions *s, errors left, ehl_error_targets w)
{
    const double least = 1e-4, most = 0.4;
    double mean = REFERENCE_TOLERANCE * pow(left.mean / mean_time_error(s), 1 / MEAN_EXPONENT);
    double share = left.lowest / lowest_time_error(s);
    double lowest = 0.5 * (sqrt(1 + 4 * share) - 1);
    int all = w.film || !w.lowest;
    return fmin(fmax(all ? fmin(mean, lowest) : lowest, least), most);
}

/* Returns the expected number of steps. The start and each breakpoint take short ones. */
static double expected_steps(const ehl_conditions *s, double tolerance)
{
    return 60 + 9 * (double)s->breakpoints +
           15 * s->step_integral * pow(REFERENCE_TOLERANCE / tolerance, 0.56);
}

/* Returns the error that counts: the larger of both, or that of the lowest film alone. */
static double film_error(const ehl_tuning *t, ehl_error_targets w)
{
    return fmin(w.film || !w.lowest ? fmax(t->mean, t->lowest) : t->lowest, 1);
}

/* Returns what the error `one` leaves for the other. Errors by the cells and by the steps are
   nearly independent, so that their squares add up. */
static double remaining_error(double goal, double one)
{
    return sqrt(fmax(goal * goal - one * one, 0));
}

/* Returns the tuning with that many cells, and the errors that it leads to. */
static ehl_tuning tuning_with_cells(const ehl_conditions *s, double accuracy, int given,
                                    ehl_error_targets w, const ehl_tuning *from, size_t cells)
{
    const double rounding = 1e-6;
    ehl_tuning t = *from;
    errors space = space_error(s, (double)cells), time = {0, 0};
    t.cells = cells;
    t.steps = given & EHL_TUNE_STEPS ? t.steps : 0;
    if (!(given & EHL_TUNE_TOLERANCE)) { /* a little less, as it is printed with two digits */
        double goal = (1 - rounding) * accuracy;
        errors left = {.mean = remaining_error(goal, space.mean),
                       .lowest = remaining_error(goal, space.lowest)};
        t.tolerance = PRINTED_SHARE * tolerance_for(s, left, w);
    }
    if (!s->steady)
        time = t.steps > 0 ? error_of_equal_steps(s, (double)t.steps)
                           : error_of_tolerance(s, t.tolerance / PRINTED_SHARE);
    t.mean = hypot(space.mean, time.mean);
    t.lowest = hypot(space.lowest, time.lowest);
    t.count = s->steady ? 1 : t.steps > 0 ? (double)t.steps : expected_steps(s, t.tolerance);
    return t;
}

/* Returns 1 when `a` keeps the accuracy with less work than `b`, or comes closer to it. */
static int is_better(const ehl_tuning *a, const ehl_tuning *b, ehl_error_targets w, double accuracy)
{
    double ea = film_error(a, w), eb = film_error(b, w);
    if (ea > accuracy || eb > accuracy)
        return ea < eb;
    return a->count * (double)a->cells * log((double)a->cells) <
           b->count * (double)b->cells * log((double)b->cells);
}

/* Estimates the errors of pressure and friction. A pressure spike is as high as the grid
   resolves. */
static void estimate_pressure_error(const ehl_conditions *s, ehl_tuning *t)
{
    double film = fmin(fmax(t->mean, t->lowest), 1);
    int light_load = s->M_high < 16, spike = ehl_has_spike(s);
    t->pressure = spike ? 0.3 : light_load ? 0.1 : film;
    t->friction = !spike && !light_load ? film : s->newtonian ? 1 : spike ? 0.2 : 0.1;
}

void ehl_tune(const ehl_conditions *s, double accuracy, int given, ehl_error_targets w,
              ehl_tuning *t)
{
    size_t first = given & EHL_TUNE_CELLS ? t->cells : CELLS[0];
    ehl_tuning best = tuning_with_cells(s, accuracy, given, w, t, first);
    for (size_t k = 1; k < CELL_COUNTS && !(given & EHL_TUNE_CELLS); k++) {
        ehl_tuning other = tuning_with_cells(s, accuracy, given, w, t, CELLS[k]);
        if (is_better(&other, &best, w, accuracy))
            best = other;
    }
    estimate_pressure_error(s, &best);
    *t = best;
}

double ehl_tuned_error(const ehl_tuning *t, ehl_error_targets w)
{
    return ehl_worst_error(w, fmin(t->mean, 1), fmin(t->lowest, 1), t->pressure, t->friction);
}

static ehl_error_targets error_targets_of(uint64_t wanted)
{
    static const uint64_t film = FF_BIT(EHL_H_MIN) | FF_BIT(EHL_H_CENTRAL) | FF_BIT(EHL_FILM) |
                                 FF_BIT(EHL_H_MIN_LOWEST_AT) | FF_BIT(EHL_LAMBDA_RATIO) |
                                 FF_BIT(EHL_LAMBDA_RATIO_LOWEST),
                          lowest = FF_BIT(EHL_H_MIN_LOWEST) | FF_BIT(EHL_H_MIN_LOWEST_MEAN) |
                                   FF_BIT(EHL_H_MIN_LOWEST_SPREAD),
                          pressure =
                              FF_BIT(EHL_P_MAX) | FF_BIT(EHL_PRESSURE) | FF_BIT(EHL_P_MAX_HIGHEST);
    return (ehl_error_targets){(wanted & film) != 0, (wanted & lowest) != 0,
                               (wanted & pressure) != 0,
                               ehl_loss_of_shear(wanted) || ehl_loss_of_flow(wanted)};
}

static void propose_settings(ehl_model *m, const ehl_tuning *t, int rough, ff_assessment *a)
{
    snprintf(m->text[0], sizeof m->text[0], "%zu", t->cells);
    snprintf(m->text[1], sizeof m->text[1], t->steps > 0 ? "%zu" : "auto", t->steps);
    snprintf(m->text[2], sizeof m->text[2], "%.2g", t->tolerance);
    m->proposals[0] = (ff_proposal){"cells", m->text[0]};
    m->proposals[1] = (ff_proposal){"steps", m->text[1]};
    m->proposals[2] = (ff_proposal){"time_tolerance", m->text[2]};
    m->proposals[3] = (ff_proposal){"roughness", "ignored"};
    a->proposals = m->proposals;
    a->proposal_count = rough ? 4 : 3;
}

static int is_given(const ehl_model *m, const char *param)
{
    uint32_t row = 0;
    while (strcmp(m->model->params[row].name, param) != 0)
        row++;
    return FF_HAS(m->host, given) && m->host->given(m->host->ctx, row);
}

/* EHL_TUNE_... of what the user wrote. */
static int given_settings(const ehl_model *m)
{
    return (is_given(m, "cells") ? EHL_TUNE_CELLS : 0) |
           (is_given(m, "steps") ? EHL_TUNE_STEPS : 0) |
           (is_given(m, "time_tolerance") ? EHL_TUNE_TOLERANCE : 0);
}

/* Returns why the error cannot be estimated; NULL: it can. */
static const char *why_error_is_unknown(const ehl_model *m, const ehl_history *h, uint64_t wanted,
                                        int rough)
{
    static const uint64_t of_asperities = FF_BIT(EHL_ASPERITY_LOAD_SHARE) |
                                          FF_BIT(EHL_CONTACT_RATIO) | FF_BIT(EHL_TRAPPED_SHARE) |
                                          FF_BIT(EHL_ASPERITY_PRESSURE) | FF_BIT(EHL_YIELD_SHARE) |
                                          FF_BIT(EHL_PLASTIC_DEPTH_MAX) | FF_BIT(EHL_PLASTIC_DEPTH);
    if (rough &&
        ((is_given(m, "roughness") && m->roughness != EHL_IGNORED) || wanted & of_asperities))
        return "nothing is known beforehand of the error of a rough film: choose the cells by the "
               "shortest wave";
    if (m->inlet > 0 || m->outlet > 0 || m->time_scheme == EHL_EULER || m->wedge == 0 ||
        m->light_load > 0)
        return "nothing is known of the error with a domain, a scheme, a wedge or a light load of "
               "one's own";
    if (m->outside)
        return "nothing is known beforehand of the error of another discretisation";
    if (h->turns || h->at_rest)
        return "nothing is known beforehand of the error where the contact is at rest or turns "
               "round";
    return NULL;
}

/* Chooses cells and steps by the fitted formulas, then improves them by probe solves of films of
   this history. The slow twins take the first choice. */
static ff_status tune_by_probes(const ehl_model *m, const ehl_history *h, const ehl_oil *oil,
                                double accuracy, ehl_error_targets targets,
                                ehl_conditions *conditions, ehl_tuning *t)
{
    enum { MOST_PROBES = 4 };
    const double near = 0.85;
    const ehl_tuning given = *t;
    const int fixed = given_settings(m);
    double work = 0;
    ehl_tune(conditions, accuracy, fixed, targets, t);
    if (m->maker != ehl_newton_krylov || conditions->steady || conditions->thin_count == 0)
        return FF_OK;
    for (int k = 0; k < MOST_PROBES; k++) {
        ehl_probe *probe = &conditions->probe;
        ff_status status = ehl_probe_solve(h, &m->laws, oil, conditions->thin,
                                           conditions->thin_count, t->cells, probe);
        if (status != FF_OK)
            return status;
        work += probe->work;
        conditions->thin[0] =
            conditions->thin[probe->worst]; /* the other instant need not be solved again */
        conditions->thin_count = 1;
        *t = given;
        ehl_tune(conditions, accuracy, fixed, targets, t);
        double ratio = (double)t->cells / (double)probe->cells;
        if (probe->cells > 0 && ratio < 1 && (ratio > near || k + 1 == MOST_PROBES)) {
            *t = given; /* nothing was measured with fewer cells */
            t->cells = probe->cells;
            ehl_tune(conditions, accuracy, fixed | EHL_TUNE_CELLS, targets, t);
        }
        if (probe->cells == 0 || (ratio > near && ratio * near < 1))
            break;
    }
    conditions->probe.work = work;
    return FF_OK;
}

/* Settings, error and cost of one engagement. */
typedef struct demand {
    ehl_conditions conditions;
    ehl_tuning tuning;
    double error, cost;
    int mixed;
} demand;

static ff_status assess_engagement(const ehl_model *m, const ff_array *in, const ehl_history *one,
                                   const ehl_oil *oil, double accuracy, ehl_error_targets targets,
                                   double (*step_cost)(double cells), demand *d)
{
    d->tuning = (ehl_tuning){.cells = (size_t)m->cells,
                             .steps = m->steps > 0 ? (size_t)m->steps : 0,
                             .tolerance = m->time_tolerance};
    ff_status status = ehl_conditions_read(one, &m->laws, oil, in[EHL_IN_RQ_1].data,
                                           in[EHL_IN_RQ_2].data, &d->conditions);
    if (status != FF_OK)
        return status;
    double uneven = ehl_rough_error(&d->conditions, targets);
    status = tune_by_probes(m, one, oil, fmax(accuracy - uneven, accuracy / 4), targets,
                            &d->conditions, &d->tuning);
    d->error = fmax(ehl_tuned_error(&d->tuning, targets), m->tolerance) + uneven;
    d->cost = d->tuning.count * step_cost((double)d->tuning.cells);
    d->mixed = d->conditions.lambda > 0 && d->conditions.lambda < EHL_MIXED_BELOW;
    return status;
}

/* Assesses all engagements: the most costly one sets cells and steps for all. A cost below 0: the
   error of none is known. */
static ff_status assess_engagements(const ehl_model *m, const ff_array *in, const ehl_history *all,
                                    const ehl_oil *oil, double accuracy, ehl_error_targets targets,
                                    double (*step_cost)(double cells), demand *most)
{
    ehl_history one;
    demand d;
    double error = 0, engagements = 0;
    int mixed = 0;
    *most = (demand){.cost = -1};
    for (size_t row = 0; row < all->count; engagements++) {
        row = ehl_history_engagement(all, row, &one);
        ff_status status = assess_engagement(m, in, &one, oil, accuracy, targets, step_cost, &d);
        if (status == FF_INVALID)
            continue; /* too light a load beside that of others */
        if (status != FF_OK)
            return status;
        error = fmax(error, d.error);
        mixed |= d.mixed;
        if (d.cost > most->cost)
            *most = d;
    }
    most->error = error;
    most->mixed = mixed;
    most->cost *= engagements;
    return FF_OK;
}

ff_status ehl_assess(void *self, uint64_t wanted, double accuracy, const ff_array *in,
                     double (*step_cost)(double cells), ff_assessment *a)
{
    ehl_model *m = self;
    ehl_history history;
    ehl_oil oil;
    demand most;
    const int rough = in[EHL_IN_POSITION].data != NULL;
    ff_status status = ehl_laws_at(&m->isothermal, m->host, &in[EHL_IN_OIL], &m->laws);
    if (status == FF_OK)
        status = ehl_read_history(m->host, in, m->light_load, &history);
    if (status != FF_OK)
        return status;
    const char *why = why_error_is_unknown(m, &history, wanted, rough);
    if (why)
        return ff_failf(m->host, FF_UNSUPPORTED, NULL, "%s", why);
    if (ehl_fluid_oil(&m->laws, &oil) < 0)
        return ff_failf(m->host, FF_INVALID, NULL, "an oil law fails at ambient pressure");
    status = assess_engagements(m, in, &history, &oil, accuracy, error_targets_of(wanted),
                                step_cost, &most);
    if (status != FF_OK)
        return status;
    if (most.cost < 0)
        return ff_failf(m->host, FF_INVALID, "contact.load_per_width",
                        "nothing is known of the error of such a contact");
    propose_settings(m, &most.tuning, rough, a);
    ehl_conditions_print(&most.conditions, m->reason, sizeof m->reason);
    a->applies = most.mixed ? FF_APPLIES_NOT : FF_APPLIES;
    a->error = most.error;
    a->cost = most.cost;
    a->reason = m->reason;
    return FF_OK;
}

ff_status ehl_judge(void *self, uint64_t wanted, uint32_t input, const void *service,
                    const ff_array *in, ff_assessment *a)
{
    ehl_model *m = self;
    ehl_history history;
    if (in[EHL_IN_POSITION].data)
        return ehl_judge_rough(m->host);
    ff_status status = ehl_laws_at(&m->isothermal, m->host, &in[EHL_IN_OIL], &m->laws);
    if (status == FF_OK)
        status = ehl_read_history(m->host, in, m->light_load, &history);
    return status != FF_OK
               ? status
               : ehl_judge_law(m->host, &history, &m->laws,
                               (ehl_law_kind)(input - EHL_IN_VISCOSITY), service,
                               error_targets_of(wanted), m->reason, sizeof m->reason, a);
}
