/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reads and checks the inputs of losses/tooth-mesh. */
#include "mesh-inputs.h"

#include "../numerics/interval.h"

#include <flankfilm/author.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* Longest engagement, in pitches; a limit keeps the sums over its pairs short. */
static const double most_pitches = 100;

/* Reads a row of `count` numbers between `least` and `most`. */
static ff_status read_row(const ff_host *host, const ff_array *in, uint32_t row, size_t count,
                          double least, double most, const double **data)
{
    size_t length = in[row].rank ? in[row].shape[0] : 1;
    if (!in[row].data || in[row].rank > 1 || length != count)
        return ff_failf(host, FF_INVALID, losses_inputs[row].name,
                        "%s has %zu numbers; %zu are needed", losses_inputs[row].name,
                        in[row].data ? length : 0, count);
    for (size_t i = 0; i < count; i++)
        if (!(in[row].data[i] >= least && in[row].data[i] <= most))
            return ff_failf(host, FF_INVALID, losses_inputs[row].name,
                            "%s is %g at place %zu; it must lie between %g and %g",
                            losses_inputs[row].name, in[row].data[i], i, least, most);
    *data = in[row].data;
    return FF_OK;
}

static ff_status read_scalar(const ff_host *host, const ff_array *in, uint32_t row, double least,
                             double *value)
{
    const double *data = value;
    ff_status status = read_row(host, in, row, 1, least, 1e18, &data);
    *value = *data;
    return status;
}

static ff_status read_scalars(const ff_host *host, const ff_array *in, losses_mesh *m)
{
    const double *teeth = NULL;
    double speed = 0;
    ff_status status = read_scalar(host, in, IN_FACE_WIDTH, 1e-12, &m->face_width);
    if (status == FF_OK)
        status = read_scalar(host, in, IN_REDUCED_MODULUS, 1e-3, &m->modulus);
    if (status == FF_OK)
        status = read_scalar(host, in, IN_CONTACT_RATIO, 1e-6, &m->contact_ratio);
    if (status == FF_OK)
        status = read_scalar(host, in, IN_TORQUE, m->other ? -1e18 : 0, &m->torque);
    if (m->other)
        m->torque = 0;
    if (status == FF_OK)
        status = read_scalar(host, in, IN_SPEED, 1e-12, &speed);
    if (status == FF_OK)
        status = read_scalar(host, in, IN_OIL_TEMPERATURE, 0, &m->oil_temperature);
    if (status == FF_OK)
        status = read_row(host, in, IN_TEETH, 2, 1, 1e9, &teeth);
    if (status != FF_OK)
        return status;
    m->omega[0] = speed;
    m->omega[1] = speed * teeth[0] / teeth[1];
    m->pitch = 2 * M_PI / teeth[0];
    return FF_OK;
}

/* Reads a series that some film models do not give. */
static ff_status read_optional(const ff_host *host, const ff_array *in, uint32_t row, size_t n,
                               const double **data)
{
    return in[row].data ? read_row(host, in, row, n, -1e18, 1e18, data) : FF_OK;
}

static ff_status check_rising(const ff_host *host, uint32_t row, size_t n, const double *x)
{
    for (size_t i = 1; i < n; i++)
        if (x[i] < x[i - 1])
            return ff_failf(host, FF_INVALID, losses_inputs[row].name, "%s decreases at place %zu",
                            losses_inputs[row].name, i);
    if (!(n >= 2 && x[n - 1] > x[0]))
        return ff_failf(host, FF_INVALID, losses_inputs[row].name,
                        "%s must cover an engagement: at least 2 increasing values",
                        losses_inputs[row].name);
    return FF_OK;
}

losses_engagement losses_engagement_at(const losses_mesh *m, size_t k)
{
    size_t first = m->first[k];
    return (losses_engagement){m->first[k + 1] - first, m->roll + first,
                               m->loss ? m->loss + first : NULL, m->pitch};
}

/* Finds the engagements; each covers one tooth pair from SAP to tip. */
static ff_status find_engagements(const ff_host *host, losses_mesh *m)
{
    m->first = calloc(m->n + 2, sizeof *m->first);
    if (!m->first)
        return FF_NOMEM;
    for (size_t i = 1; i < m->n && m->engagement; i++)
        if (m->engagement[i] != m->engagement[i - 1])
            m->first[++m->count] = i;
    m->first[++m->count] = m->n;
    for (size_t k = 0; k < m->count; k++) {
        const losses_engagement e = losses_engagement_at(m, k);
        ff_status status = check_rising(host, IN_ROLL_ANGLE, e.n, e.roll);
        if (status != FF_OK)
            return status;
        double pitches = (e.roll[e.n - 1] - e.roll[0]) / m->pitch;
        if (pitches > most_pitches)
            return ff_failf(host, FF_INVALID, "ehl.roll_angle",
                            "the engagement covers %g pitches; it must be the engagement of one "
                            "tooth pair",
                            pitches);
    }
    return FF_OK;
}

void losses_motion_at(const losses_mesh *m, double roll, double radius[2], double speed[2])
{
    size_t k = numerics_interval(m->stations, m->station, roll);
    for (int g = 0; g < 2; g++) {
        radius[g] = losses_interpolate(m->station, m->radius[g], k, roll);
        speed[g] = m->omega[g] * radius[g];
    }
}

double losses_base_radius(const losses_mesh *m)
{
    const size_t last = m->stations - 1;
    return (m->radius[0][last] - m->radius[0][0]) / (m->station[last] - m->station[0]);
}

/* Reads the roughness: from the surface if it gives an Rq for a flank, otherwise from the gear. Ra
   is Rq sqrt(2/pi), for Gaussian heights. */
static ff_status read_roughness(const ff_host *host, const ff_array *in, losses_mesh *m)
{
    const double *gear = NULL, *surface[2] = {NULL, NULL}, most = 1;
    ff_status status = FF_OK;
    for (uint32_t i = 0; i < 2 && status == FF_OK; i++)
        if (in[IN_RQ_1 + i].data)
            status = read_row(host, in, IN_RQ_1 + i, 1, 0, most, &surface[i]);
    if (status == FF_OK && in[IN_ROUGHNESS].data)
        status = read_row(host, in, IN_ROUGHNESS, 2, 0, most, &gear);
    for (int i = 0; i < 2; i++)
        m->roughness += surface[i] && *surface[i] > 0 ? *surface[i] : gear ? gear[i] : 0;
    m->roughness *= sqrt(2 / M_PI) / 2;
    return status;
}

static ff_status read_oil(const ff_host *host, const ff_liquid *oil, losses_mesh *m)
{
    const struct {
        int32_t property;
        double *to;
    } rows[] = {{FF_LIQUID_LN_ETA0, &m->viscosity}, {FF_LIQUID_BASE, &m->oil_base}};
    m->viscosity = m->oil_base = NAN;
    for (size_t i = 0; i < 2 && oil; i++) {
        double value = NAN;
        ff_status status =
            oil->eval(oil->self, rows[i].property, 1, &m->oil_temperature, &value, NULL);
        if (status < 0 && status != FF_UNSUPPORTED)
            return ff_failf(host, status, "oil", "the oil gives no viscosity at %g degC",
                            m->oil_temperature - 273.15);
        *rows[i].to = status < 0 ? NAN : value;
    }
    m->viscosity = exp(m->viscosity);
    return FF_OK;
}

/* Returns whether a pair comes into contact at the root of gear 1 (1) or at its tip (-1); 0:
   unknown. */
static int direction_of(const ff_array *roll)
{
    const size_t n = roll->data && roll->rank == 1 ? roll->shape[0] : 0;
    size_t i = 1;
    while (i < n && roll->data[i] == roll->data[0])
        i++;
    return i < n ? (roll->data[i] > roll->data[0]) - (roll->data[i] < roll->data[0]) : 0;
}

/* Reads the losses of the opposite flanks. */
static ff_status read_back(const ff_host *host, const ff_array *in, losses_mesh *m)
{
    const ff_array *roll = &in[IN_BACK_ROLL_ANGLE], *mean = &in[IN_BACK_LOSS_MEAN];
    ff_status status = FF_OK;
    if (!roll->data && !mean->data)
        return FF_OK;
    if (m->other)
        return ff_failf(host, FF_INVALID, "back",
                        "these flanks are opposite to those that carry the mean load: wire their "
                        "losses to the losses stage of the flanks that carry it");
    const int way = direction_of(roll);
    if (!mean->data || way == 0)
        return ff_failf(host, FF_INVALID, "back",
                        "needs the losses of the other flanks: name a losses stage");
    if (way > 0) /* the roll angles are those of the exchanged pair */
        return ff_failf(
            host, FF_INVALID, "back",
            "is the loss of the same flanks: wire the losses of a film whose contact is "
            "contact/back-tooth-pair");
    for (uint32_t k = 0; k <= PARTS && status == FF_OK; k++)
        status = read_optional(host, in, IN_BACK_LOSS_MEAN + k, 1, &m->back[k]);
    return status;
}

ff_status losses_read(const ff_host *host, const ff_array *in, const ff_liquid *oil, losses_mesh *m)
{
    const double most = 1e18;
    *m = (losses_mesh){.shown = in[IN_ROLL_ANGLE].data};
    const int loaded = numerics_flank(losses_inputs, LOSSES_INPUTS, in),
              way = direction_of(&in[IN_ROLL_ANGLE]), back = way ? way < 0 : loaded < 0;
    m->other = back != (loaded < 0);
    if (numerics_exchange_open_flank(losses_inputs, LOSSES_INPUTS, in, back, &m->exchange) != FF_OK)
        return FF_NOMEM;
    in = m->exchange.in;
    m->n = in[IN_ROLL_ANGLE].rank == 1 ? in[IN_ROLL_ANGLE].shape[0] : 0;
    m->stations = in[IN_STATION].rank == 1 ? in[IN_STATION].shape[0] : 0;
    ff_status status = read_scalars(host, in, m);
    if (status == FF_OK)
        status = read_row(host, in, IN_ROLL_ANGLE, m->n, -1e6, 1e6, &m->roll);
    if (status == FF_OK)
        status = read_row(host, in, IN_POWER_LOSS, m->n, -most, most, &m->power);
    if (status == FF_OK)
        status = read_row(host, in, IN_TRACTION, m->n, -most, most, &m->traction);
    if (status == FF_OK)
        status = read_row(host, in, IN_FRICTION_COEFFICIENT, m->n, -most, most, &m->friction);
    if (status == FF_OK)
        status = read_row(host, in, IN_STATION, m->stations, -1e6, 1e6, &m->station);
    if (status == FF_OK)
        status = read_row(host, in, IN_RADIUS_1, m->stations, 1e-12, 1e9, &m->radius[0]);
    if (status == FF_OK)
        status = read_row(host, in, IN_RADIUS_2, m->stations, 1e-12, 1e9, &m->radius[1]);
    for (uint32_t k = 0; k < PARTS && status == FF_OK; k++)
        status = read_optional(host, in, IN_SLIDING_LOSS + k, m->n, &m->part[k]);
    if (status == FF_OK)
        status = read_optional(host, in, IN_ENGAGEMENT, m->n, &m->engagement);
    if (status == FF_OK)
        status = read_roughness(host, in, m);
    if (status == FF_OK)
        status = read_oil(host, oil, m);
    if (status == FF_OK)
        status = find_engagements(host, m);
    if (status == FF_OK)
        status = read_back(host, m->exchange.in, m);
    return status == FF_OK ? check_rising(host, IN_STATION, m->stations, m->station) : status;
}

void losses_report_flanks(const ff_host *host, const losses_mesh *m, double force, bool heated)
{
    const double share = 1 - m->torque / losses_base_radius(m) / force, limit = 0.01;
    char text[240];
    if (m->other) {
        snprintf(text, sizeof text,
                 "roll_angle of the film %s: these losses arise on the flanks opposite to those "
                 "that carry the mean load%s",
                 m->exchange.back ? "falls" : "rises",
                 heated ? ", and their bulk temperature lacks the heat of the other flanks: set "
                          "bulk_temperature to the value found there"
                        : "");
        host->quality(host->ctx, "other_flank", 1, 0, heated ? FF_DOUBTFUL : FF_GOOD, text);
    } else if (!m->back[0] && force > 0 && share > limit) {
        host->quality(
            host->ctx, "other_flank", share, limit, FF_RANGE,
            "share of the mean force of these flanks that the torque does not explain: either the "
            "opposite flanks also carry load, and means and efficiency lack their losses (wire "
            "these as \"back\"), or the damper of the motion pulls separated flanks (set damping: "
            "clipped)");
    }
}

void losses_close(losses_mesh *m)
{
    free(m->first);
    free(m->loss);
    numerics_exchange_close(&m->exchange);
}
