/* SPDX-License-Identifier: GPL-3.0-or-later */
/* contact/tooth-pair: load, radii and speeds of one pair of teeth from SAP to tip. */
#include "../numerics/interval.h"
#include "../numerics/steffen.h"
#include "history.h"
#include "load-curve.h"
#include "references.h"
#include "tooth-path.h"

#include <flankfilm/author.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double degree = M_PI / 180;

/* Width of the ramp of a load step, relative to the length of the path. Zones up to twice this
   length are dropped, so that ramps always fit. */
static const double step_width = 1e-6;

enum { P_LOAD_RAMP };

typedef struct tooth_pair {
    const ff_host *host;
    double load_ramp;
    int64_t points;
    contact_engagement_choice engagements;
    const ff_viscosity *law;
} tooth_pair;

static const ff_param params[] = {
    FF_QUANTITY("load_ramp", "deg", tooth_pair, load_ramp, 0, "0.2 deg", NULL, 0, 90, 0, 0,
                "width in roll angle of the linear load ramp at each change in the number of "
                "pairs, centred on the change; left out: 0.2 deg, or less if changes are closer "
                "than this; 0: a step with a width of 1e-6 of the path"),
    FF_COUNT(
        "points", tooth_pair, points, FF_TUNABLE, "4000", NULL, 16, 1e6, 0, 0,
        "number of instants of each engagement, including the ends of the ramps and of the load"),
    FF_COUNT_OR("all", "engagement", tooth_pair, engagements.one, 0, "all", NULL, 0, 1e6, 0, 0,
                "mesh cycle in which the pair enters contact, from 0, for a motion of several mesh "
                "cycles; all: all of them in sequence, each with its own history"),
    FF_COUNT("max_engagements", tooth_pair, engagements.most, 0, "16", NULL, 1, 1e6, 0, 0,
             "largest number of engagements for `all`; from a longer motion, this many engagements "
             "are taken at even spacing"),
};

static ff_status ready(void *self)
{
    const tooth_pair *s = self;
    const ff_serving rows[] = {
        {s->engagements.one >= 0, "max_engagements", "", NULL, "engagement selects one of them"}};
    ff_serve(s->host, rows, sizeof rows / sizeof rows[0]);
    return FF_OK;
}

/* The only service input is the viscosity law. */
static ff_status wire(void *self, uint32_t input, const void *service)
{
    (void)input;
    if (service)
        ((tooth_pair *)self)->law = service;
    return FF_OK;
}

/* Lists the roll angles at which the history needs an instant: SAP, both ends of each ramp, tip.
 * `breaks` has room for 2 count angles. */
static size_t list_breakpoints(const contact_piece *pieces, size_t count,
                               const contact_tooth_path *p, double *breaks)
{
    size_t n = 0;
    breaks[n++] = p->angle[0];
    for (size_t i = 1; i < count; i++) {
        breaks[n++] = pieces[i - 1].to;
        breaks[n++] = pieces[i].from;
    }
    breaks[n++] = p->angle[p->n - 1];
    return n;
}

static int by_angle(const void *a, const void *b)
{
    const double *one = a, *other = b;
    return (*one > *other) - (*one < *other);
}

/* Adds the roll angles at which the load begins and ends, as long as half of the remaining instants
   stay free for other points. Angles next to another breakpoint are not added. */
static size_t add_load_ends(const contact_load_curve *force, size_t points, double *breaks,
                            size_t count)
{
    const size_t most = (count + points) / 2;
    const double least = step_width * (force->angle[force->n - 1] - force->angle[0]);
    size_t n = count;
    for (size_t i = 0; i + 1 < force->n && n < most; i++) {
        double end = contact_load_end(force, i);
        bool apart = end > breaks[0] + least && end < breaks[count - 1] - least;
        for (size_t k = 0; k < n && apart; k++)
            apart = fabs(end - breaks[k]) > least;
        if (apart)
            breaks[n++] = end;
    }
    qsort(breaks, n, sizeof *breaks, by_angle);
    return n;
}

/* One engagement: the tooth force and the gap over the path of contact. */
typedef struct engagement {
    double number, begin; /* `begin`: time in the history at which the engagement begins, s */
    contact_load_curve force, gap;
} engagement;

static contact_point point_at(const contact_tooth_path *p, const engagement *e, double angle)
{
    /* exact, since the radii of involute flanks are linear in the roll angle */
    size_t i = numerics_interval(p->n, p->angle, angle);
    double width = p->angle[i + 1] - p->angle[i];
    double t = width > 0 ? (angle - p->angle[i]) / width : 0;
    contact_point point = {
        .time = e->begin + (angle - p->angle[0]) / p->speed,
        .roll_angle = angle,
        .engagement = e->number,
        .radius_1 = p->radius_1[i] + t * (p->radius_1[i + 1] - p->radius_1[i]),
        .radius_2 = p->radius_2[i] + t * (p->radius_2[i + 1] - p->radius_2[i]),
        .load_per_width = contact_load_at(&e->force, angle) / p->face_width,
    };
    /* a flank's surface speed is its gear's angular speed times its radius of curvature */
    point.speed_1 = p->speed * point.radius_1;
    point.speed_2 = p->speed * p->ratio * point.radius_2;
    if (e->gap.value)
        point.gap = contact_load_at(&e->gap, angle);
    return point;
}

/* Converts a point of the pair with exchanged gears back to gear 1 and gear 2 of the user. */
static contact_point of_gears(const contact_tooth_path *p, contact_point point)
{
    const contact_point as = point;
    if (!p->exchange.back)
        return point;
    point.roll_angle = numerics_exchange_back(&p->exchange, as.roll_angle);
    point.radius_1 = as.radius_2;
    point.radius_2 = as.radius_1;
    point.speed_1 = as.speed_2;
    point.speed_2 = as.speed_1;
    return point;
}

/* The history being written, and integrals of the load over the roll angle. */
typedef struct load_record {
    contact_history history;
    size_t instants;   /* number of instants written so far */
    double angle;      /* roll angle of the last instant, rad */
    double load;       /* load per width at that angle, N/m */
    double load_sum;   /* integral of the load on the pair, N rad */
    double negative;   /* integral of negative forces, which the pair cannot carry, N rad */
    double top, error; /* largest force, and largest error between stations, N */
} load_record;

static ff_status add_instant(load_record *r, const contact_tooth_path *p, const engagement *e,
                             double angle)
{
    const contact_point point = of_gears(p, point_at(p, e, angle));
    if (angle > p->angle[0])
        r->load_sum += (angle - r->angle) * (point.load_per_width + r->load) / 2 * p->face_width;
    r->angle = angle;
    r->load = point.load_per_width;
    return contact_history_set(&r->history, r->instants++, &point);
}

/* Distributes the instants of an engagement evenly between its breakpoints, in proportion to the
 * angle between them. */
static ff_status add_instants(const tooth_pair *s, const contact_tooth_path *p, const engagement *e,
                              const double *breaks, size_t break_count, load_record *r)
{
    const size_t points = (size_t)s->points;
    double per_angle = (double)(points - 1) / (breaks[break_count - 1] - breaks[0]);
    size_t done = 0;
    ff_status status = add_instant(r, p, e, breaks[0]);
    for (size_t k = 1; k < break_count && status == FF_OK; k++) {
        size_t most = points - (break_count - k); /* leaves one for each remaining breakpoint */
        double share = round((breaks[k] - breaks[0]) * per_angle);
        size_t end = (size_t)fmin(fmax(share, (double)(done + 1)), (double)most);
        double step = (breaks[k] - breaks[k - 1]) / (double)(end - done);
        for (size_t i = done + 1; i <= end && status == FF_OK; i++)
            status = add_instant(r, p, e,
                                 i == end ? breaks[k] : breaks[k - 1] + step * (double)(i - done));
        done = end;
    }
    return status;
}

/* Sets the ramps to half the width that fits, so that half of the shortest zone has no ramp. */
static void shrink_ramps(const tooth_pair *s, contact_piece *pieces, size_t count, double most)
{
    char text[200];
    contact_pieces_make_ramps(count, pieces, most / 2);
    snprintf(
        text, sizeof text,
        "load_ramp is %.4g deg instead of %.4g deg: half of what fits between the changes in the "
        "number of pairs",
        most / 2 / degree, s->load_ramp / degree);
    s->host->log(s->host->ctx, FF_LOG_INFO, text);
}

static ff_status make_ramps(const tooth_pair *s, const contact_tooth_path *p, contact_piece *pieces,
                            size_t count)
{
    double width = fmax(s->load_ramp, step_width * (p->angle[p->n - 1] - p->angle[0]));
    if (count == 0)
        return ff_failf(s->host, FF_INVALID, "gear.roll_angle",
                        "gear.roll_angle repeats nearly every station");
    double most = contact_pieces_make_ramps(count, pieces, width);
    if (width < most)
        return FF_OK;
    if (!s->host->given(s->host->ctx, P_LOAD_RAMP)) {
        shrink_ramps(s, pieces, count, most);
        return FF_OK;
    }
    return ff_failf(s->host, FF_INVALID, "load_ramp",
                    "load_ramp %g deg does not fit between the changes in the number of pairs; it "
                    "must be less than %.4g deg for this gear",
                    s->load_ramp / degree, most / degree);
}

/* Updates the largest force, the largest error and the integral of negative forces with one
   engagement. */
static void add_force_extremes(load_record *r, const contact_tooth_path *p, const double *f,
                               const contact_load_curve *force)
{
    for (size_t i = 0; i < force->n; i++) {
        r->top = fmax(r->top, f[i]);
        if (i > 0)
            r->negative -=
                (p->angle[i] - p->angle[i - 1]) * (fmin(f[i], 0) + fmin(f[i - 1], 0)) / 2;
    }
    r->error = fmax(r->error, contact_load_error(force));
}

static void report_engagements(const tooth_pair *s, const contact_tooth_path *p)
{
    char text[160];
    if (p->available == 1)
        return;
    if (p->count == p->available)
        snprintf(text, sizeof text, "all %zu engagements of the motion are included", p->available);
    else
        snprintf(text, sizeof text,
                 s->engagements.one == CONTACT_ENGAGEMENTS_ALL
                     ? "%zu of the %zu engagements of the motion, evenly spaced, represent all of "
                       "them; a higher max_engagements includes more"
                     : "%zu of the %zu engagements of the motion is included, as requested",
                 p->count, p->available);
    if (p->count < p->available)
        s->host->log(s->host->ctx, FF_LOG_INFO, text);
    s->host->quality(s->host->ctx, "engagements", (double)p->count, (double)p->available, FF_GOOD,
                     text);
}

/* Reports the mean load in a quality line. Over whole periods the mean mesh force equals the static
   force, since the gears do not accelerate on average. A negative tooth force acts on the opposite
   flank, so it is not counted as load. */
static void report_load(const tooth_pair *s, const contact_tooth_path *p, const load_record *r)
{
    const double limit = 0.01, turns = p->pitch * (double)p->count;
    const char *by =
        p->both_bear ? "the mean force of the motion on these flanks" : "torque over base radius";
    char text[240];
    if (!(p->mean_force > 0))
        return;
    double off = fabs((r->load_sum - r->negative) / turns / p->mean_force - 1);
    if (p->count < p->available)
        snprintf(text, sizeof text,
                 "relative difference between the mean mesh force and %s; only %zu of %zu "
                 "engagements are included; %s includes more",
                 by, p->count, p->available,
                 s->engagements.one == CONTACT_ENGAGEMENTS_ALL ? "max_engagements"
                                                               : "engagement: all");
    else
        snprintf(text, sizeof text,
                 "relative difference between the mean mesh force and %s; "
                 "over whole periods both are equal, unless teeth carry load beyond the path",
                 by);
    s->host->quality(s->host->ctx, "mesh_load", off, limit, off <= limit ? FF_GOOD : FF_DOUBTFUL,
                     text);
}

static ff_status report(const tooth_pair *s, const contact_tooth_path *p, const load_record *r,
                        uint64_t wanted)
{
    /* the relative error of the Hertz pressure is half of this */
    const double limit = 0.02;
    double error = r->top > 0 ? r->error / r->top : 0;
    s->host->quality(s->host->ctx, "load_interpolation", error, limit,
                     error <= limit ? FF_GOOD : FF_DOUBTFUL,
                     "estimated interpolation error of the tooth force between stations, relative "
                     "to its maximum; more stations of the gear and more points reduce it");
    contact_history_report(&r->history);
    report_engagements(s, p);
    report_load(s, p, r);
    if (wanted & FF_BIT(CONTACT_ENGAGEMENTS_JUDGED) &&
        ff_put_scalar(s->host, CONTACT_ENGAGEMENTS_JUDGED, (double)p->count) != FF_OK)
        return FF_NOMEM;
    if (wanted & FF_BIT(CONTACT_MESH_LOAD_MEAN))
        return ff_put_scalar(s->host, CONTACT_MESH_LOAD_MEAN,
                             r->load_sum / (p->pitch * (double)p->count));
    return FF_OK;
}

static void set_slopes(const contact_load_curve *curve, double *slope)
{
    for (size_t i = 0; i < curve->piece_count; i++) {
        size_t k = curve->pieces[i].first, n = curve->pieces[i].last - k + 1;
        numerics_steffen_slopes(n, curve->angle + k, curve->value + k, slope + k);
    }
}

/* Writes the history for n stations; `curves` has room for 3 n numbers, `breaks` for 3 n, and
   `pieces` for n/2 pieces. */
static ff_status make_history(const tooth_pair *s, const contact_tooth_path *p, uint64_t wanted,
                              contact_piece *pieces, double *curves, double *breaks)
{
    double path_length = p->angle[p->n - 1] - p->angle[0];
    size_t count = contact_pieces_find(p->n, p->angle, 2 * step_width * path_length, pieces);
    ff_status status = make_ramps(s, p, pieces, count);
    if (status != FF_OK)
        return status;
    const size_t points = (size_t)s->points,
                 break_count = list_breakpoints(pieces, count, p, breaks);
    double *ends = breaks + break_count, *load = curves + 2 * p->n;
    if (break_count > points)
        return ff_failf(s->host, FF_INVALID, "points",
                        "points is %zu; the history needs at least %zu for its load ramps", points,
                        break_count);
    load_record r = {0};
    engagement e = {.force = {p->n, count, p->angle, load, curves, pieces},
                    .gap = {p->n, count, p->angle, NULL, curves + p->n, pieces}};
    status = contact_history_open(&r.history, s->host, wanted, p->count * points,
                                  p->reduced_modulus, s->law, p->oil);
    for (size_t k = 0; k < p->count && status == FF_OK; k++) {
        size_t number = p->engagement[k];
        e.number = (double)number;
        const double *force = p->force + number * p->n;
        memcpy(load, force, p->n * sizeof *load);
        contact_load_continue(count, pieces, p->angle, force, load);
        set_slopes(&e.force, curves);
        if (p->gap) {
            e.gap.value = p->gap + (p->gaps > 1 ? number * p->n : 0);
            set_slopes(&e.gap, curves + p->n);
        }
        memcpy(ends, breaks, break_count * sizeof *ends);
        status =
            add_instants(s, p, &e, ends, add_load_ends(&e.force, points, ends, break_count), &r);
        add_force_extremes(&r, p, force, &e.force);
        e.begin += path_length / p->speed;
    }
    return status == FF_OK ? report(s, p, &r, wanted) : status;
}

static ff_status evaluate_flanks(const tooth_pair *s, uint64_t wanted, const ff_array *in, int back)
{
    contact_tooth_path p;
    ff_status status = contact_tooth_path_read(s->host, in, back, s->engagements, &p);
    contact_piece *pieces = NULL;
    double *curves = NULL, *breaks = NULL;
    if (status != FF_OK)
        goto out;
    pieces = malloc((p.n / 2) * sizeof *pieces);
    curves = malloc(3 * p.n * sizeof *curves);
    breaks = malloc(3 * p.n * sizeof *breaks); /* including those of an engagement */
    status =
        pieces && curves && breaks ? make_history(s, &p, wanted, pieces, curves, breaks) : FF_NOMEM;
out:
    contact_tooth_path_close(&p);
    free(pieces);
    free(curves);
    free(breaks);
    return status;
}

static ff_status evaluate(void *self, uint64_t wanted, const ff_array *in)
{
    return evaluate_flanks(self, wanted, in, 0);
}

static ff_status evaluate_back(void *self, uint64_t wanted, const ff_array *in)
{
    return evaluate_flanks(self, wanted, in, 1);
}

FF_MODEL(contact_tooth_pair, tooth_pair, .id = "contact/tooth-pair", .version = "1.0.0",
         .summary = "load, radii and speeds of one tooth pair from SAP to tip",
         .reference = "Li and Kahraman 2011, Proc. IMechE Part J, Influence of dynamic behaviour "
                      "on elastohydrodynamic lubrication of spur gears; Steffen 1990, Astron. "
                      "Astrophys. 239, 443 (interpolation)",
         .bibtex = BIB_likahraman2011 "\n" BIB_steffen1990, .licence = "GPL-3.0-or-later",
         .params = FF_TABLE(params), .inputs = &contact_tooth_inputs[CONTACT_TOOTH_FIRST],
         .input_count = CONTACT_TOOTH_INPUTS - CONTACT_TOOTH_FIRST,
         .input_stride = sizeof contact_tooth_inputs[0], .outputs = FF_TABLE(contact_outputs),
         .wire = wire, .ready = ready, .evaluate = evaluate, .destroy = free);
FF_MODEL(contact_back_tooth_pair, tooth_pair, .id = "contact/back-tooth-pair", .version = "1.0.0",
         .summary = "load, radii and speeds of one tooth pair on the flanks opposite to those that "
                    "carry the mean load",
         .reference = "Steffen 1990, Astron. Astrophys. 239, 443 (interpolation)",
         .bibtex = BIB_steffen1990, .licence = "GPL-3.0-or-later", .params = FF_TABLE(params),
         .inputs = contact_tooth_inputs, .input_count = CONTACT_TOOTH_INPUTS - CONTACT_TOOTH_FIRST,
         .input_stride = sizeof contact_tooth_inputs[0], .outputs = FF_TABLE(contact_outputs),
         .wire = wire, .ready = ready, .evaluate = evaluate_back, .destroy = free);
