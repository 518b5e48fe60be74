/* SPDX-License-Identifier: GPL-3.0-or-later */
/* losses/tooth-mesh: loss of all tooth pairs in mesh, and flash temperature of their flanks. */
#include "bulk.h"
#include "friction.h"
#include "references.h"

#include <flankfilm/author.h>
#include <flankfilm/needs.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double blok = 1.11;      /* factor for a Hertzian heat source, Blok 1937 */
static const double least_peclet = 5; /* Peclet number of a fast-moving heat source, Jaeger 1942 */
static const double most_loss = 0.1;  /* share of the input power; real gears lose less */
static const double least_half_width = 1e-3; /* relative to the largest half width; the heat of a
                                                narrower contact is ignored */

typedef struct tooth_mesh {
    const ff_host *host;
    ff_reals conductivity, density, specific_heat; /* of both gears */
    double bulk_temperature;                       /* K; NaN: auto */
    double thermal_conductance;                    /* W/K; NaN: unlimited */
    double relief_factor;                          /* X_Ca */
    double rise_factor; /* factor on the temperature rise by the standard */
    double oil_factor;  /* NaN: auto */
    int32_t bulk_rule, supply;
    int32_t formula;
    int64_t points;
    const ff_liquid *oil; /* NULL: not wired */
} tooth_mesh;

static const ff_param params[] = {
    NUMERICS_LIST_UNLESS(
        "gear.thermal_conductivity", "thermal_conductivity", "W/(m K)", tooth_mesh, conductivity,
        NUMERICS_STEEL_CONDUCTIVITY, 1e-3, 1e4,
        "thermal conductivity of gear 1 and gear 2, or one value for both, if the gear stage gives "
        "none; steel: 50"),
    NUMERICS_LIST_UNLESS("gear.density", "density", "kg/m3", tooth_mesh, density,
                         NUMERICS_STEEL_DENSITY, 1, 1e5,
                         "density of gear 1 and gear 2, or one "
                         "value for both, if the gear stage gives "
                         "none; steel: 7850"),
    NUMERICS_LIST_UNLESS("gear.specific_heat", "specific_heat", "J/(kg K)", tooth_mesh,
                         specific_heat, NUMERICS_STEEL_HEAT, 1, 1e5,
                         "specific heat of gear 1 and "
                         "gear 2, or one value for "
                         "both, if the gear stage "
                         "gives none; steel: 484"),
    FF_QUANTITY_OR(
        "auto", "bulk_temperature", "degC", tooth_mesh, bulk_temperature, 0, "auto", NULL, -150,
        1000, 0, 0,
        "bulk temperature: temperature of the teeth before they meet; auto: by bulk_rule or "
        "thermal_conductance, otherwise the oil temperature, which is its lower bound"),
    FF_QUANTITY("thermal_conductance", "W/K", tooth_mesh, thermal_conductance, FF_MIN_OPEN, NULL,
                NULL, 0, 1e9, 0, 0,
                "thermal conductance from the teeth to the oil: bulk_temperature is the oil "
                "temperature plus the mean loss over this conductance"),
    FF_ONE_OF(LOSSES_BULK_RULES, "bulk_rule", tooth_mesh, bulk_rule, 0, NULL,
              "rule for the bulk temperature, instead of a number. standard: ISO/TR 15144-1 with "
              "the loss of this run (accurate to 30 % of the rise); conductance: by "
              "thermal_conductance; oil: the oil temperature. Left out: conductance if "
              "thermal_conductance is given, otherwise oil"),
    FF_ONE_OF(LOSSES_SUPPLIES, "supply", tooth_mesh, supply, 0, "dip",
              "oil supply to the teeth, for bulk_rule: standard; X_S is 1, 1.2 and 0.2"),
    FF_QUANTITY("relief_factor", "1", tooth_mesh, relief_factor, FF_MIN_OPEN, "1", NULL, 0, 10, 1,
                2, "tip relief factor X_Ca, for bulk_rule: standard"),
    FF_QUANTITY(
        "rise_factor", "1", tooth_mesh, rise_factor, 0, "1", NULL, 0, 10, 0.5, 2,
        "factor on the temperature rise by bulk_rule: standard; its uncertainty is 1 +- 0.3"),
    FF_ONE_OF(
        LOSSES_FORMULAS, "formula", tooth_mesh, formula, 0, "schlenk",
        "formula of friction_coefficient_formula: ISO/TR 14179-2 (schlenk) or ISO/TR 15144-1"),
    FF_QUANTITY_OR("auto", "lubricant_factor", "1", tooth_mesh, oil_factor, FF_MIN_OPEN, "auto",
                   NULL, 0, 10, 0.5, 1.5,
                   "oil factor X_L of the friction formula; auto: from the base oil, 1 for mineral "
                   "oil, 0.8 for PAO and ester, 0.7 for PAG"),
    FF_COUNT("points", tooth_mesh, points, FF_TUNABLE, "200", NULL, 2, 1e6, 0, 0,
             "number of equal steps of the mesh cycle in mesh_power_loss"),
};

/* Blok 1937: 1.11 (friction power per width)/((B1 sqrt u1 + B2 sqrt u2) sqrt(2 a)), B = sqrt(k
 * rho c), for a band of half width a that moves fast over both flanks. Powers in W/m, result in
 * K. */
static double flash_at(const losses_mesh *m, double power, const double speed[2], double half_width)
{
    double conducted = 0; /* B1 sqrt u1 + B2 sqrt u2 */
    for (int g = 0; g < 2; g++)
        conducted += numerics_heat_contact(&m->heat[g]) * sqrt(speed[g]);
    return blok * power / (conducted * sqrt(2 * half_width));
}

/* Returns the power per width that heats the contact itself. The rolling loss heats the oil in the
   inlet instead. */
static double friction_power(const losses_mesh *m, size_t i)
{
    enum { SLIDING = 0, ASPERITIES = PARTS - 1 };
    if (!m->part[SLIDING])
        return m->power[i];
    return m->part[SLIDING][i] + (m->part[ASPERITIES] ? m->part[ASPERITIES][i] : 0);
}

static ff_status set_series(const tooth_mesh *s, losses_mesh *m)
{
    double radius[2], speed[2], widest = 0;
    for (size_t i = 0; i < m->n; i++) {
        losses_motion_at(m, m->roll[i], radius, speed);
        double R = radius[0] * radius[1] / (radius[0] + radius[1]);
        m->loss[i] = m->power[i] * m->face_width;
        /* in pure rolling the load cannot be computed from the friction coefficient; it is not
           needed, since there is no heat */
        m->load[i] = fabs(m->friction[i]) > 0 ? m->traction[i] / m->friction[i] : 0;
        m->half_width[i] = sqrt(8 * fmax(m->load[i], 0) * R / (M_PI * m->modulus));
        widest = fmax(widest, m->half_width[i]);
        if (!(fabs(m->load[i]) < 1e18))
            return ff_failf(s->host, FF_INVALID, "ehl.friction_coefficient",
                            "traction over friction coefficient gives no valid load at roll angle "
                            "%g rad",
                            m->shown[i]);
    }
    for (size_t i = 0; i < m->n; i++) {
        losses_motion_at(m, m->roll[i], radius, speed);
        bool bears = m->heats && m->half_width[i] > least_half_width * widest;
        m->flash[i] = bears ? flash_at(m, friction_power(m, i), speed, m->half_width[i]) : 0;
        if (m->flash[i] > m->flash[m->hottest])
            m->hottest = i;
    }
    return FF_OK;
}

/* Returns the loss of all pairs at a phase, averaged over the engagements. */
static double loss_at(const losses_mesh *m, double phase, bool before)
{
    double sum = 0;
    for (size_t k = 0; k < m->count; k++) {
        const losses_engagement e = losses_engagement_at(m, k);
        sum += losses_mesh_loss(&e, phase, before);
    }
    return sum / (double)m->count;
}

/* Returns the mean over the mesh cycle and the engagements of a quantity given at the steps. */
static double mean_of(const losses_mesh *m, const double *value)
{
    double sum = 0;
    for (size_t k = 0; k < m->count; k++) {
        const losses_engagement e = losses_engagement_at(m, k);
        sum += losses_mesh_mean(&e, value + m->first[k]);
    }
    return sum / (double)m->count;
}

/* Writes mesh_power_loss at equal steps of the mesh cycle, and twice at phases where a pair leaves.
   The difference between its mean and the exact mean is the discretisation error. */
static ff_status write_cycle(const tooth_mesh *s, const losses_mesh *m, uint64_t wanted)
{
    const losses_engagement e = losses_engagement_at(m, 0);
    const double leave = losses_leaving_phase(&e);
    const size_t points = (size_t)s->points, count = points + 1 + (leave > 0 ? 2 : 0);
    double *phase = malloc(2 * count * sizeof *phase), *loss = phase ? phase + count : NULL;
    if (!phase)
        return FF_NOMEM;
    size_t n = 0;
    bool left = !(leave > 0);
    for (size_t i = 0; i <= points; i++) {
        double at = (double)i / (double)points;
        if (!left && at > leave - 1e-9) {
            left = true;
            phase[n] = phase[n + 1] = leave;
            loss[n++] = loss_at(m, leave, true);
            loss[n++] = loss_at(m, leave, false);
            if (at < leave + 1e-9)
                continue;
        }
        phase[n] = at;
        loss[n++] = loss_at(m, at, i > 0);
    }
    double mean = 0, exact = mean_of(m, m->loss);
    for (size_t i = 0; i + 1 < n; i++)
        mean += (phase[i + 1] - phase[i]) * (loss[i] + loss[i + 1]) / 2;
    double error = fabs(exact) > 0 ? fabs(mean / exact - 1) : 0;
    s->host->quality(s->host->ctx, "cycle_error", error, 0.01,
                     error <= 0.01 ? FF_GOOD : FF_DOUBTFUL,
                     "relative difference between the mean of mesh_power_loss over its phases and "
                     "the exact mean");
    double *to = wanted & FF_BIT(OUT_PHASE) ? ff_put_series(s->host, OUT_PHASE, n) : phase;
    double *power = wanted & FF_BIT(OUT_MESH_POWER_LOSS)
                        ? ff_put_series(s->host, OUT_MESH_POWER_LOSS, n)
                        : loss;
    if (to && to != phase)
        memcpy(to, phase, n * sizeof *to);
    if (power && power != loss)
        memcpy(power, loss, n * sizeof *power);
    free(phase);
    return to && power ? FF_OK : FF_NOMEM;
}

static ff_status write_series(const tooth_mesh *s, const losses_mesh *m, uint64_t wanted,
                              double bulk)
{
    const double *from[LOSSES_OUTPUTS] = {[OUT_ROLL_ANGLE] = m->shown,
                                          [OUT_ENGAGEMENT] = m->engagement,
                                          [OUT_POWER_LOSS] = m->loss,
                                          [OUT_FLASH] = m->flash,
                                          [OUT_CONTACT_TEMPERATURE] = m->flash};
    if (wanted & FF_BIT(OUT_ENGAGEMENT) && !m->engagement)
        return ff_failf(s->host, FF_UNSUPPORTED, losses_outputs[OUT_ENGAGEMENT].name,
                        "this output needs a film model that gives engagement");
    for (uint32_t row = 0; row < LOSSES_OUTPUTS; row++) {
        if (!from[row] || !(wanted & FF_BIT(row)))
            continue;
        double *to = ff_put_series(s->host, row, m->n);
        if (!to)
            return FF_NOMEM;
        for (size_t i = 0; i < m->n; i++)
            to[i] = from[row][i] + (row == OUT_CONTACT_TEMPERATURE ? bulk : 0);
    }
    return FF_OK;
}

/* Mean and standard deviation over the engagements. */
typedef struct scatter {
    double mean, deviation, least, most;
} scatter;

static scatter scatter_of(const losses_mesh *m, double *each)
{
    scatter of = {.least = HUGE_VAL, .most = -HUGE_VAL};
    double square = 0;
    of.mean = mean_of(m, m->loss);
    for (size_t k = 0; k < m->count; k++) {
        const losses_engagement e = losses_engagement_at(m, k);
        double loss = losses_mesh_mean(&e, e.loss), off = loss - of.mean;
        if (each)
            each[k] = loss;
        square += off * off;
        of.least = fmin(of.least, loss);
        of.most = fmax(of.most, loss);
    }
    of.deviation = m->count > 1 ? sqrt(square / ((double)m->count - 1)) : 0;
    return of;
}

static void report_engagements(const tooth_mesh *s, const losses_mesh *m, const scatter *of)
{
    char text[240];
    if (m->count < 2)
        return;
    snprintf(
        text, sizeof text,
        "standard deviation of the loss of an engagement, relative to the mean; %zu engagements "
        "range from %.3g to %.3g W, so the mean of a longer motion is known to %.2g W",
        m->count, of->least, of->most, of->deviation / sqrt((double)m->count));
    s->host->quality(s->host->ctx, "engagement_scatter",
                     fabs(of->mean) > 0 ? of->deviation / fabs(of->mean) : 0, 0, FF_GOOD, text);
}

/* Reports whether the parts of the loss add up to the total; if the film gives no parts, reports
   that. */
static void report_parts(const tooth_mesh *s, const losses_mesh *m)
{
    double off = 0, most = 0, lacking = 0;
    for (uint32_t k = 0; k < PARTS; k++)
        lacking += !m->part[k];
    if (lacking > 0) {
        s->host->quality(s->host->ctx, "loss_parts", lacking, 0, FF_DOUBTFUL,
                         "number of loss parts (sliding, rolling, squeeze, asperities) that the "
                         "film model does not give; the total is its power_loss");
        return;
    }
    for (size_t i = 0; i < m->n; i++) {
        double sum = 0;
        for (uint32_t k = 0; k < PARTS; k++)
            sum += m->part[k][i];
        off = fmax(off, fabs(sum - m->power[i]));
        most = fmax(most, fabs(m->power[i]));
    }
    off = most > 0 ? off / most : 0;
    s->host->quality(s->host->ctx, "loss_parts", off, 1e-9, off <= 1e-9 ? FF_GOOD : FF_BAD,
                     "difference between the sum of the four loss parts and power_loss, relative "
                     "to its maximum");
}

/* Reports whether engagement, friction power and heat source satisfy the assumptions of the
   formulas. */
static void report(const tooth_mesh *s, const losses_mesh *m, const scatter *of, double efficiency)
{
    const ff_host *host = s->host;
    double radius[2], speed[2], peclet = HUGE_VAL, error = 0, most = 0;
    double share = 0;
    for (size_t k = 0; k < m->count; k++) {
        const losses_engagement e = losses_engagement_at(m, k);
        double pitches = (e.roll[e.n - 1] - e.roll[0]) / m->pitch;
        share = fmax(share, fabs(pitches / m->contact_ratio - 1));
    }
    host->quality(host->ctx, "engagement", share, 1e-3, share <= 1e-3 ? FF_GOOD : FF_DOUBTFUL,
                  "difference between the roll angle covered by the steps, in pitches, and the "
                  "contact ratio of the gear");
    for (size_t i = 0; i < m->n; i++) {
        losses_motion_at(m, m->roll[i], radius, speed);
        most = fmax(most, fabs(friction_power(m, i)));
        error = fmax(error, fabs(friction_power(m, i) - m->traction[i] * (speed[0] - speed[1])));
    }
    error = most > 0 ? error / most : 0;
    host->quality(host->ctx, "friction_power_error", error, 1e-3,
                  error <= 1e-3 ? FF_GOOD : FF_DOUBTFUL,
                  "difference between the friction power and traction times sliding speed, "
                  "relative to its maximum");
    losses_motion_at(m, m->roll[m->hottest], radius, speed);
    for (int g = 0; g < 2; g++)
        peclet = fmin(peclet, speed[g] * m->half_width[m->hottest] * m->heat[g].density *
                                  m->heat[g].specific_heat / (2 * m->heat[g].conductivity));
    if (m->flash[m->hottest] > 0)
        host->quality(host->ctx, "peclet", peclet, least_peclet,
                      peclet >= least_peclet ? FF_GOOD : FF_RANGE,
                      "Peclet number u a rho c/(2 k) of the slower flank at the hottest place; "
                      "below 5 Blok's formula gives too high a temperature");
    if (m->torque > 0)
        host->quality(host->ctx, "loss_share", 1 - efficiency, most_loss,
                      fabs(1 - efficiency) <= most_loss ? FF_GOOD : FF_RANGE,
                      "power loss over input power");
    losses_report_flanks(host, m, m->face_width * mean_of(m, m->load),
                         !(s->bulk_temperature > 0) &&
                             (s->bulk_rule == LOSSES_STANDARD || s->thermal_conductance > 0));
    report_parts(s, m);
    report_engagements(s, m, of);
}

/* Writes the means of the parts, and the loss of each engagement. */
static ff_status write_parts(const tooth_mesh *s, const losses_mesh *m, uint64_t wanted)
{
    for (uint32_t k = 0; k < PARTS; k++) {
        const uint32_t row = OUT_SLIDING_LOSS_MEAN + k;
        if (!(wanted & FF_BIT(row)))
            continue;
        if (!m->part[k] || (m->back[0] && !m->back[1 + k]))
            return ff_failf(s->host, FF_UNSUPPORTED, losses_outputs[row].name,
                            "this output needs a film model that gives %s, on both flanks if both "
                            "are wired",
                            strchr(losses_inputs[IN_SLIDING_LOSS + k].name, '.') + 1);
        double mean =
            m->face_width * mean_of(m, m->part[k]) + (m->back[1 + k] ? *m->back[1 + k] : 0);
        if (ff_put_scalar(s->host, row, mean) != FF_OK)
            return FF_NOMEM;
    }
    if (!(wanted & FF_BIT(OUT_ENGAGEMENT_LOSS)))
        return FF_OK;
    double *each = ff_put_series(s->host, OUT_ENGAGEMENT_LOSS, m->count);
    if (each)
        scatter_of(m, each);
    return each ? FF_OK : FF_NOMEM;
}

/* Returns the bulk temperature of the teeth from the loss that heats them. */
static double bulk_of(const tooth_mesh *s, const losses_mesh *m, double loss)
{
    if (s->bulk_temperature > 0)
        return s->bulk_temperature;
    if (s->bulk_rule == LOSSES_STANDARD)
        return m->oil_temperature +
               s->rise_factor * losses_standard_rise(m, loss, s->supply, s->relief_factor);
    return m->oil_temperature + (s->thermal_conductance > 0 ? loss / s->thermal_conductance : 0);
}

/* Outputs that are undefined if no power is transmitted. */
static const uint64_t of_transmission =
    FF_BIT(OUT_EFFICIENCY) | FF_BIT(OUT_FRICTION_FORMULA) | FF_BIT(OUT_FRICTION_AGREEMENT);

static ff_status write_outputs(const tooth_mesh *s, const losses_mesh *m, uint64_t wanted)
{
    const scatter of = scatter_of(m, NULL);
    const double mean = of.mean + (m->back[0] ? *m->back[0] : 0), input = m->torque * m->omega[0];
    const double bulk = bulk_of(s, m, mean);
    const double hottest = m->flash[m->hottest];
    const losses_formula f = losses_formula_of(m, s->formula, s->oil_factor);
    const double efficiency = input > 0 ? 1 - mean / input : 0;
    for (uint32_t row = 0; row < LOSSES_OUTPUTS; row++)
        if (wanted & FF_BIT(row) & of_transmission && !(input > 0))
            return ff_failf(s->host, FF_UNSUPPORTED, losses_outputs[row].name,
                            m->other
                                ? "these flanks do not carry the mean load: request this output "
                                  "from the losses stage of the opposite flanks, with \"back\" "
                                  "wired to this stage"
                                : "the torque is 0: the gears transmit no power, so this output "
                                  "has no value");
    for (uint32_t row = OUT_FRICTION_FORMULA; row <= OUT_FRICTION_AGREEMENT; row++)
        if (wanted & FF_BIT(row) && !(f.coefficient > 0))
            return ff_failf(s->host, FF_UNSUPPORTED, losses_outputs[row].name,
                            "this output needs %s",
                            m->roughness > 0 ? "an oil: a stage of the kind lubricant"
                                             : "the roughness of the flanks: give roughness_ra to "
                                               "the gear stage, or wire a surface that is not "
                                               "flat");
    const struct {
        uint32_t row;
        double value;
    } scalars[] = {
        {OUT_POWER_LOSS_MEAN, mean},
        {OUT_POWER_INPUT, input},
        {OUT_EFFICIENCY, efficiency},
        {OUT_FRICTION_MEAN, f.film},
        {OUT_FRICTION_FORMULA, f.coefficient > 0 ? f.coefficient : 0},
        {OUT_FRICTION_AGREEMENT, f.coefficient > 0 ? f.film / f.coefficient : 0},
        {OUT_LOSS_FACTOR, f.loss_factor},
        {OUT_FLASH_MAX, hottest},
        {OUT_FLASH_MAX_AT, m->shown[m->hottest]},
        {OUT_BULK_TEMPERATURE, bulk},
        {OUT_CONTACT_TEMPERATURE_MAX, bulk + hottest},
        {OUT_POWER_LOSS_SPREAD, of.deviation},
        {OUT_ENGAGEMENTS_JUDGED, (double)m->count},
    };
    ff_status status = write_cycle(s, m, wanted);
    if (status == FF_OK)
        status = write_parts(s, m, wanted);
    if (status == FF_OK)
        status = write_series(s, m, wanted, bulk);
    for (size_t i = 0; i < sizeof scalars / sizeof scalars[0] && status == FF_OK; i++) {
        if (!isfinite(scalars[i].value))
            return ff_failf(s->host, FF_INVALID, losses_outputs[scalars[i].row].name,
                            "%s overflows: the inputs do not describe a gear",
                            losses_outputs[scalars[i].row].name);
        if (wanted & FF_BIT(scalars[i].row))
            status = ff_put_scalar(s->host, scalars[i].row, scalars[i].value);
    }
    if (status == FF_OK)
        report(s, m, &of, efficiency);
    if (status == FF_OK)
        losses_report_friction(
            s->host, m, &f,
            (wanted & (FF_BIT(OUT_FRICTION_FORMULA) | FF_BIT(OUT_FRICTION_AGREEMENT))) != 0);
    if (status == FF_OK && wanted & FF_BIT(OUT_LOSS_FACTOR))
        losses_report_factor(s->host, m);
    return status;
}

/* Reads the thermal data of the gears. If a flank temperature is wanted, refuses gears without
   these data. */
static ff_status read_heat(const tooth_mesh *s, uint64_t wanted, losses_mesh *m)
{
    const uint64_t hot = FF_BIT(OUT_FLASH) | FF_BIT(OUT_CONTACT_TEMPERATURE) |
                         FF_BIT(OUT_FLASH_MAX) | FF_BIT(OUT_FLASH_MAX_AT) |
                         FF_BIT(OUT_CONTACT_TEMPERATURE_MAX);
    ff_status status = FF_OK;
    m->heats = true;
    for (int g = 0; g < 2 && status == FF_OK; g++) {
        const int gear = m->exchange.back ? 1 - g : g;
        const double said[] = {ff_of_both(&s->conductivity, gear), ff_of_both(&s->density, gear),
                               ff_of_both(&s->specific_heat, gear)};
        m->heats = m->heats && numerics_heat_known(&m->exchange.in[IN_HEAT], said, g);
        if (m->heats || wanted & hot)
            status = numerics_heat_of(s->host, &m->exchange.in[IN_HEAT], said, g, &m->heat[g]);
    }
    return status;
}

static ff_status ready(void *self)
{
    const tooth_mesh *s = self;
    static const ff_need needs[] = {
        {1, "ehl.engagement", "engagement", "this output needs a film model that gives engagement"},
        {1, "ehl.sliding_loss", "sliding_loss_mean",
         "this output needs a film model that gives sliding_loss"},
        {1, "ehl.rolling_loss", "rolling_loss_mean",
         "this output needs a film model that gives rolling_loss"},
        {1, "ehl.squeeze_loss", "squeeze_loss_mean",
         "this output needs a film model that gives squeeze_loss"},
        {1, "ehl.asperity_loss", "asperity_loss_mean",
         "this output needs a film model that gives asperity_loss"},
        {1, "oil", "friction_coefficient_formula|friction_agreement",
         "this output needs an oil: a stage of the kind lubricant"},
        {1, "gear.roughness|surface.rq_1|surface.rq_2",
         "friction_coefficient_formula|friction_agreement",
         "this output needs the roughness of the flanks: give roughness_ra to the gear stage, or "
         "wire a surface"},
    };
    static const char other[] = "bulk_rule is not standard";
    const int by_standard = s->bulk_rule == LOSSES_STANDARD;
    const ff_serving rows[] = {{!by_standard, "supply", "", NULL, other},
                               {!by_standard, "relief_factor", "", NULL, other},
                               {!by_standard, "rise_factor", "", NULL, other}};
    ff_tell_needs(s->host, needs, sizeof needs / sizeof needs[0]);
    ff_serve(s->host, rows, sizeof rows / sizeof rows[0]);
    const char *beside = s->thermal_conductance > 0 ? "thermal_conductance"
                         : s->bulk_rule >= 0        ? "bulk_rule"
                                                    : NULL;
    if (s->bulk_temperature > 0 && beside)
        return ff_failf(
            s->host, FF_INVALID, beside,
            "bulk_temperature is given, but %s determines it too: leave one of them out", beside);
    if (s->bulk_rule == LOSSES_CONDUCTANCE && !(s->thermal_conductance > 0))
        return ff_failf(s->host, FF_INVALID, "thermal_conductance",
                        "bulk_rule: conductance needs thermal_conductance");
    if (s->thermal_conductance > 0 && s->bulk_rule >= 0 && s->bulk_rule != LOSSES_CONDUCTANCE)
        return ff_failf(s->host, FF_INVALID, "bulk_rule",
                        "thermal_conductance is given, but bulk_rule is not conductance: leave one "
                        "of them out");
    return FF_OK;
}

static ff_status wire(void *self, uint32_t input, const void *service)
{
    tooth_mesh *s = self;
    if (input == IN_OIL)
        s->oil = service;
    return FF_OK;
}

static ff_status evaluate(void *self, uint64_t wanted, const ff_array *in)
{
    const tooth_mesh *s = self;
    losses_mesh m;
    ff_status status = losses_read(s->host, in, s->oil, &m);
    if (status == FF_OK)
        status = read_heat(s, wanted, &m);
    if (status == FF_OK && !(m.loss = calloc(4 * m.n, sizeof *m.loss)))
        status = FF_NOMEM;
    if (status != FF_OK)
        goto out;
    m.load = m.loss + m.n;
    m.flash = m.load + m.n;
    m.half_width = m.flash + m.n;
    status = set_series(s, &m);
    if (status == FF_OK)
        status = write_outputs(s, &m, wanted);
out:
    losses_close(&m);
    return status;
}

FF_MODEL(losses_tooth_mesh, tooth_mesh, .id = "losses/tooth-mesh", .version = "1.0.0",
         .summary = "power loss, efficiency and flash temperature of a tooth mesh",
         .reference = "Blok 1937, Theoretical study of temperature rise at surfaces of actual "
                      "contact under oiliness lubricating conditions, Proc. General Discussion on "
                      "Lubrication, IMechE 2, 222; Jaeger 1942, Moving sources of heat and the "
                      "temperature at sliding contacts, Proc. R. Soc. NSW 76, 203",
         .bibtex = BIB_blok1937 "\n" BIB_jaeger1942, .licence = "GPL-3.0-or-later",
         .params = FF_TABLE(params), .inputs = FF_TABLE(losses_inputs),
         .outputs = FF_TABLE(losses_outputs), .wire = wire, .ready = ready, .evaluate = evaluate,
         .destroy = free);
FF_EXPORT_MODELS(&losses_tooth_mesh);
