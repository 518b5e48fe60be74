/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "film-history.h"

#include "share.h"

#include "../../numerics/interval.h"

#include <math.h>
#include <stdlib.h>

/* Weights of the film thickness as elastic deflection: 1 if p_max is at least `borne` times its
   largest value, 0 if it is below `parted` times this value. The load is proportional to the square
   of p_max. While flanks separate, load and film determine each other without delay. A fixed-point
   loop over h ~ W^-0.13 then converges only if the film is stiffer than the teeth, W/(0.13 h) > k:
   above 0.001 of the largest load, that is 0.03 of the largest pressure. While flanks land, the oil
   delays the film. `landing` and `landed` replace `parted` and `borne` for landings, if the model
   of the motion has a film between separated flanks. */
static const double parted = 0.1, borne = 0.2, landing = 0.01, landed = 0.02;

/* Flanks are in free flight if p_max is below `borne` and the film is thinner than this share of
   its largest thickness. */
static const double flight = 0.1;

/* Phases that differ by less than this (mesh cycles) are equal. */
static const double at_node = 1e-9;

static ff_status read_series(const ff_host *host, const ff_array *in, int input, size_t count,
                             const double **data)
{
    const ff_array *a = &in[input];
    const char *name = dynamics_oil_input_ports[input].name;
    if (!a->data || a->rank != 1 || a->shape[0] != count || count < 2)
        return ff_failf(host, FF_INVALID, name,
                        "the film must give a series of %zu values, at least 2", count);
    for (size_t i = 0; i < count; i++)
        if (!isfinite(a->data[i]))
            return ff_failf(host, FF_INVALID, name, "value %zu is not a finite number", i + 1);
    *data = a->data;
    return FF_OK;
}

/* Returns the largest value, or 0 if all values are negative. */
static double largest(size_t count, const double *x)
{
    double most = 0;
    for (size_t i = 0; i < count; i++)
        most = fmax(most, x[i]);
    return most;
}

/* Sets the weight, 0 to 1, with which the thickness counts as that of loaded flanks. h and p are
   histories over all engagements. */
static void weigh(const dynamics_film_history *y, const double *h, const double *p, double *weight)
{
    double thickest = largest(y->count, h), highest = largest(y->count, p);
    int lands = 0;
    for (size_t i = 0; i < y->count; i++) {
        double share = highest > 0 ? p[i] / highest : 0;
        if (share >= borne || y->engagement[i] != y->engagement[i > 0 ? i - 1 : i])
            lands = 0;
        if (share < borne && y->in_oil && h[i] < flight * thickest)
            lands = 1;
        double from = lands ? landing : parted, to = lands ? landed : borne;
        weight[i] = fmin(fmax((share - from) / (to - from), 0), 1);
    }
}

/* Keeps the thickness h where flanks are loaded (weight 1) and interpolates it where they are not:
   x minimises sum w (x - h)^2 + bend (x_(i+1) - x_i)^2, a tridiagonal system. x depends smoothly on
   the pressure, so that the feedback loop converges. */
static void bridge(size_t count, const double *h, const double *weight, double *x, double *ratio)
{
    static const double bend = 1e-4;
    double sum = 0;
    for (size_t i = 0; i < count; i++) {
        double w = weight[i];
        sum += w;
        double diagonal = w + bend * ((i > 0) + (i + 1 < count)) - (i ? bend * ratio[i - 1] : 0);
        ratio[i] = diagonal > 0 ? bend / diagonal : 0;
        x[i] = diagonal > 0 ? (w * h[i] + (i ? bend * x[i - 1] : 0)) / diagonal : 0;
    }
    for (size_t i = count - 1; i-- > 0;)
        x[i] += ratio[i] * x[i + 1];
    for (size_t i = 0; i < count && !(sum > 0); i++)
        x[i] = 0;
}

static ff_status read_thickness(const double *h, const double *p, dynamics_film_history *y)
{
    double *weight = malloc(y->count * sizeof *weight), *ratio = malloc(y->count * sizeof *ratio);
    y->thickness = malloc(y->count * sizeof *y->thickness);
    if (weight && ratio && y->thickness) {
        weigh(y, h, p, weight);
        for (size_t i = 0; i < y->engagements; i++) {
            size_t first = y->first[i];
            bridge(y->first[i + 1] - first, h + first, weight + first, y->thickness + first, ratio);
        }
    }
    ff_status status = weight && ratio && y->thickness ? FF_OK : FF_NOMEM;
    free(weight);
    free(ratio);
    return status;
}

/* A position between two non-decreasing stations: the index of the first station and the fraction
   of their distance. */
typedef struct between {
    size_t i;
    double share;
} between;

/* Finds the position of `at`. If two stations are equal, the interval before them is used if
   `before` is set, else the interval after them. */
static between find_between(size_t count, const double *x, double at, int before)
{
    size_t i = numerics_interval(count, x, at);
    while (before && i > 0 && x[i] >= at)
        i--;
    double h = x[i + 1] - x[i];
    return (between){i, h > 0 ? fmin(fmax((at - x[i]) / h, 0), 1) : 0};
}

static double value_between(const between *b, const double *y)
{
    return y[b->i] + b->share * (y[b->i + 1] - y[b->i]);
}

/* Returns the load share of a pair: at the current mesh force if the force is shared, else at the
   mean mesh force. */
static double share_at(const dynamics_film_history *y, const between *station, double force)
{
    const dynamics_inputs *inputs = y->inputs;
    const double *bears = inputs->line_force > 0 ? inputs->tooth_force : inputs->load_share;
    if (!y->load)
        return bears ? value_between(station, bears) : 1;
    double low = dynamics_share(inputs, station->i, force);
    return low + station->share * (dynamics_share(inputs, station->i + 1, force) - low);
}

/* Adds the pairs of one engagement at a phase under a mesh force. At the ends of an engagement the
   limit from the left is used if `before` is set, else the limit from the right. */
static void add_engagement(const dynamics_film_history *y, size_t number, double phase, int before,
                           double force, dynamics_film_sum *sum)
{
    const dynamics_inputs *inputs = y->inputs;
    const double *radius[2] = {y->in[DYNAMICS_IN_RADIUS_1].data, y->in[DYNAMICS_IN_RADIUS_2].data};
    double slack = at_node * inputs->pitch;
    size_t first = y->first[number], last = y->first[number + 1], count = last - first;
    for (int pair = 0; pair < DYNAMICS_FILM_PAIRS && count > 1; pair++) {
        double roll = inputs->roll_sap + (phase + pair) * inputs->pitch;
        double start = y->roll[first], end = y->roll[last - 1];
        if (roll > end + slack || (!before && roll > end - slack))
            break;
        if (roll < start - slack || (before && roll < start + slack))
            continue;
        between step = find_between(count, y->roll + first, roll, before);
        between station = find_between(inputs->stations, inputs->roll_angle, roll, before);
        double friction = y->width * value_between(&step, y->traction + first);
        double rolling = y->width * value_between(&step, y->rolling + first);
        double share = share_at(y, &station, force), arm[2];
        for (int g = 0; g < 2; g++)
            arm[g] = value_between(&station, radius[g]);
        /* rolling resistance = loss / (2 u_r), 2 u_r = r1 w1 + r2 w2 */
        rolling /= arm[0] * y->speed[0] + arm[1] * y->speed[1];
        sum->against[0] += (friction + rolling) * arm[0];
        sum->against[1] += (rolling - friction) * arm[1];
        sum->force += y->load ? y->width * value_between(&step, y->load + first) : 0;
        sum->share[pair] += share;
        sum->film[pair] += share * value_between(&step, y->thickness + first);
        sum->loss += y->width * value_between(&step, y->loss + first);
    }
}

/* Averages over the engagements. The current mesh force is the sum of the loads that the films
   carried in the previous round. */
dynamics_film_sum dynamics_film_history_at(const dynamics_film_history *y, double phase, int before)
{
    dynamics_film_sum sum = {.loss = 0};
    double share = 1 / (double)y->engagements, all = 0;
    for (size_t i = 0; i < y->engagements; i++) {
        dynamics_film_sum one = {.loss = 0};
        if (y->load)
            add_engagement(y, i, phase, before, y->inputs->line_force, &one);
        add_engagement(y, i, phase, before, one.force, &sum);
    }
    sum.against[0] *= share;
    sum.against[1] *= share;
    sum.loss *= share;
    sum.force *= share;
    for (int pair = 0; pair < DYNAMICS_FILM_PAIRS; pair++)
        all += sum.share[pair];
    for (int pair = 0; pair < DYNAMICS_FILM_PAIRS && all > 0; pair++) {
        sum.thickness += sum.film[pair] / all;
        sum.film[pair] = sum.share[pair] > 0 ? sum.film[pair] / sum.share[pair] : 0;
        sum.share[pair] /= all;
    }
    return sum;
}

ff_status dynamics_film_history_read(const ff_host *host, const ff_array *in,
                                     const dynamics_inputs *inputs, dynamics_film_history *y)
{
    const double *h = NULL, *p = NULL, *teeth = in[DYNAMICS_IN_TEETH].data;
    y->count =
        in[DYNAMICS_IN_FILM_ROLL_ANGLE].rank == 1 ? in[DYNAMICS_IN_FILM_ROLL_ANGLE].shape[0] : 0;
    y->in = in;
    y->inputs = inputs;
    ff_status status = read_series(host, in, DYNAMICS_IN_FILM_ROLL_ANGLE, y->count, &y->roll);
    if (status == FF_OK)
        status = read_series(host, in, DYNAMICS_IN_FILM_ENGAGEMENT, y->count, &y->engagement);
    if (status == FF_OK)
        status = read_series(host, in, DYNAMICS_IN_FILM_TRACTION, y->count, &y->traction);
    if (status == FF_OK)
        status = read_series(host, in, DYNAMICS_IN_FILM_ROLLING_LOSS, y->count, &y->rolling);
    if (status == FF_OK)
        status = read_series(host, in, DYNAMICS_IN_FILM_POWER_LOSS, y->count, &y->loss);
    if (status == FF_OK)
        status = read_series(host, in,
                             in[DYNAMICS_IN_FILM_SEPARATION].data ? DYNAMICS_IN_FILM_SEPARATION
                                                                  : DYNAMICS_IN_FILM_H_CENTRAL,
                             y->count, &h);
    if (status == FF_OK)
        status = read_series(host, in, DYNAMICS_IN_FILM_P_MAX, y->count, &p);
    if (status == FF_OK && inputs->shared && inputs->levels.tooth_force)
        status = read_series(host, in, DYNAMICS_IN_FILM_LOAD, y->count, &y->load);
    if (status != FF_OK)
        return status;
    if (y->count > 0 &&
        y->roll[y->count - 1] - inputs->roll_sap > DYNAMICS_FILM_PAIRS * inputs->pitch)
        return ff_failf(host, FF_INVALID, "film.roll_angle",
                        "film.roll_angle must end within %d mesh cycles of the start of active "
                        "profile",
                        DYNAMICS_FILM_PAIRS);
    y->first = calloc(y->count + 1, sizeof *y->first);
    if (!y->first)
        return FF_NOMEM;
    for (size_t i = 1; i <= y->count; i++)
        if (i == y->count || y->engagement[i] != y->engagement[i - 1])
            y->first[++y->engagements] = i;
    y->width = in[DYNAMICS_IN_FACE_WIDTH].data[0];
    y->speed[0] = inputs->mesh_frequency * inputs->pitch;
    y->speed[1] = y->speed[0] * teeth[0] / teeth[1];
    return read_thickness(h, p, y);
}

void dynamics_film_history_free(dynamics_film_history *y)
{
    free(y->thickness);
    free(y->first);
}
