/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Estimates error and cost of a film solver before the run, and proposes its settings. */
#include "judge.h"
#include "loss.h"
#include "model-part.h"

#include <flankfilm/author.h>

#include <math.h>
#include <stdio.h>

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

/* Returns why the error cannot be estimated; NULL: it can. */
static const char *why_error_is_unknown(const ehl_model *m, const ehl_history *h, uint64_t wanted,
                                        int rough)
{
    static const uint64_t of_asperities = FF_BIT(EHL_ASPERITY_LOAD_SHARE) |
                                          FF_BIT(EHL_CONTACT_RATIO) | FF_BIT(EHL_TRAPPED_SHARE) |
                                          FF_BIT(EHL_ASPERITY_PRESSURE) | FF_BIT(EHL_YIELD_SHARE) |
                                          FF_BIT(EHL_PLASTIC_DEPTH_MAX) | FF_BIT(EHL_PLASTIC_DEPTH);
    if (rough && ((m->roughness_given && !m->smooth) || wanted & of_asperities))
        return "nothing is known beforehand of the error of a rough film: choose the cells by the "
               "shortest wave";
    if (m->inlet > 0 || m->outlet > 0 || m->scheme == EHL_EULER || m->wedge == 1 ||
        m->light_load > 0)
        return "nothing is known of the error with a domain, a scheme, a wedge or a light load of "
               "one's own";
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
    double work = 0;
    ehl_tune(conditions, accuracy, m->given, targets, t);
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
        ehl_tune(conditions, accuracy, m->given, targets, t);
        double ratio = (double)t->cells / (double)probe->cells;
        if (probe->cells > 0 && ratio < 1 && (ratio > near || k + 1 == MOST_PROBES)) {
            *t = given; /* nothing was measured with fewer cells */
            t->cells = probe->cells;
            ehl_tune(conditions, accuracy, m->given | EHL_TUNE_CELLS, targets, t);
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
    d->tuning = (ehl_tuning){.cells = m->cells, .steps = m->steps, .tolerance = m->time_tolerance};
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
    ff_status status = ehl_read_history(m, in, &history);
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
    ff_status status = ehl_read_history(m, in, &history);
    return status != FF_OK
               ? status
               : ehl_judge_law(m->host, &history, &m->laws,
                               (ehl_law_kind)(input - EHL_IN_VISCOSITY), service,
                               error_targets_of(wanted), m->reason, sizeof m->reason, a);
}
