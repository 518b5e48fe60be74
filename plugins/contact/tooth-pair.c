/* SPDX-License-Identifier: GPL-3.0-or-later */
/* contact/tooth-pair: what one pair of teeth goes through from SAP to tip. */
#include "history.h"
#include "load-curve.h"
#include "tooth-path.h"

#include <flankfilm/author.h>

#include <math.h>
#include <stdlib.h>

static const double degree = M_PI / 180;

/* A step of the load is so wide, over the length of the path; zones up to twice that are left out,
   so that steps always fit. */
static const double step_width = 1e-6;

enum { P_LOAD_RAMP, P_POINTS, P_ENGAGEMENT, P_MAX_ENGAGEMENTS };

static const ff_param params[] = {
    {.name = "load_ramp",
     .unit = "deg",
     .doc = "roll angle over which the load passes linearly from before to after a change in the "
            "number of pairs, centred on it; left out: less where changes are nearer than that; "
            "0: a step, 1e-6 of the path wide",
     .type = FF_REAL,
     .preset = "0.2 deg",
     .min = 0,
     .max = 90},
    {.name = "points",
     .unit = "1",
     .doc = "instants of each engagement; the ends of the ramps are among them",
     .type = FF_INT,
     .flags = FF_TUNABLE,
     .preset = "1000",
     .min = 16,
     .max = 1e6},
    {.name = "engagement",
     .unit = "1",
     .doc = "which mesh cycle of a motion that lasts several the pair begins in, from 0; all: one "
            "after the other, each a history of its own",
     .type = FF_INT,
     .preset = "all",
     .choices = "all",
     .min = 0,
     .max = 1e6},
    {.name = "max_engagements",
     .unit = "1",
     .doc = "most of them that `all` takes; of a longer motion so many, spread over all of it",
     .type = FF_INT,
     .preset = "16",
     .min = 1,
     .max = 1e6},
};

typedef struct tooth_pair {
    const ff_host *host;
    double load_ramp;
    bool ramp_given;
    size_t points;
    contact_engagements engagements;
    const ff_viscosity *law;
} tooth_pair;

static ff_status create(const ff_host *host, void **self)
{
    tooth_pair *s = calloc(1, sizeof *s);
    if (!s)
        return FF_NOMEM;
    s->host = host;
    *self = s;
    return FF_OK;
}

static ff_status set(void *self, uint32_t param, const ff_value *value)
{
    tooth_pair *s = self;
    if (param == P_LOAD_RAMP) {
        s->load_ramp = value->real;
        s->ramp_given = value->given != 0;
    } else if (param == P_POINTS)
        s->points = (size_t)value->integer;
    else if (param == P_MAX_ENGAGEMENTS)
        s->engagements.most = (size_t)value->integer;
    else
        s->engagements.one = value->text ? CONTACT_ENGAGEMENTS_ALL : (long)value->integer;
    return FF_OK;
}

static ff_status wire(void *self, uint32_t input, const void *service)
{
    tooth_pair *s = self;
    if (input == CONTACT_TOOTH_VISCOSITY)
        s->law = service;
    return FF_OK;
}

/* Where the history has to stop by: SAP, both ends of each ramp, tip. knots holds 2 count. */
static size_t list_knots(const contact_piece *pieces, size_t count, const contact_tooth_path *p,
                         double *knots)
{
    size_t n = 0;
    knots[n++] = p->angle[0];
    for (size_t i = 1; i < count; i++) {
        knots[n++] = pieces[i - 1].to;
        knots[n++] = pieces[i].from;
    }
    knots[n++] = p->angle[p->n - 1];
    return n;
}

/* One engagement of the load. */
typedef struct engagement {
    double number, begin; /* s; of the history, when it begins */
    contact_load_curve force, gap;
} engagement;

static contact_point point_at(const contact_tooth_path *p, const engagement *e, double angle)
{
    /* the radii of involute flanks are linear in the roll angle, so this is exact */
    size_t i = contact_interval(p->n, p->angle, angle);
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
    /* along the flank a surface moves at the speed of its gear times its radius of curvature */
    point.speed_1 = p->speed * point.radius_1;
    point.speed_2 = p->speed * p->ratio * point.radius_2;
    if (e->gap.value && !(point.load_per_width > 0))
        point.gap = contact_load_at(&e->gap, angle);
    return point;
}

/* The history, and the integrals of the load over the roll angle. */
typedef struct record {
    contact_history history;
    size_t instants;   /* that it holds */
    double angle;      /* of the last of them */
    double load;       /* per width, there */
    double load_sum;   /* N rad, what the pair bears */
    double negative;   /* N rad, of the force below 0, which it does not */
    double top, error; /* largest force, largest error between stations, N */
} record;

static ff_status put(record *r, const contact_tooth_path *p, const engagement *e, double angle)
{
    contact_point point = point_at(p, e, angle);
    if (angle > p->angle[0])
        r->load_sum += (angle - r->angle) * (point.load_per_width + r->load) / 2 * p->face_width;
    r->angle = angle;
    r->load = point.load_per_width;
    return contact_history_put(&r->history, r->instants++, &point);
}

/* Instants spread evenly between the knots, in proportion to the angle between them. */
static ff_status fill(const tooth_pair *s, const contact_tooth_path *p, const engagement *e,
                      const double *knots, size_t knot_count, record *r)
{
    double per_angle = (double)(s->points - 1) / (knots[knot_count - 1] - knots[0]);
    size_t done = 0;
    ff_status status = put(r, p, e, knots[0]);
    for (size_t k = 1; k < knot_count && status == FF_OK; k++) {
        size_t most = s->points - (knot_count - k); /* leaves one for each knot to come */
        double wish = round((knots[k] - knots[0]) * per_angle);
        size_t end = (size_t)fmin(fmax(wish, (double)(done + 1)), (double)most);
        double step = (knots[k] - knots[k - 1]) / (double)(end - done);
        for (size_t i = done + 1; i <= end && status == FF_OK; i++)
            status = put(r, p, e, i == end ? knots[k] : knots[k - 1] + step * (double)(i - done));
        done = end;
    }
    return status;
}

/* Half of the zone that limits the ramps is left free of them. */
static void shrink_ramps(const tooth_pair *s, contact_piece *pieces, size_t count, double most)
{
    char text[200];
    contact_pieces_cut(count, pieces, most / 2);
    snprintf(
        text, sizeof text,
        "load_ramp is %.4g deg instead of %.4g deg: half of what fits between the changes in the "
        "number of pairs",
        most / 2 / degree, s->load_ramp / degree);
    s->host->log(s->host->ctx, FF_LOG_INFO, text);
}

static ff_status cut_ramps(const tooth_pair *s, const contact_tooth_path *p, contact_piece *pieces,
                           size_t count)
{
    double width = fmax(s->load_ramp, step_width * (p->angle[p->n - 1] - p->angle[0]));
    if (count == 0)
        return ff_failf(s->host, FF_INVALID, "gear.roll_angle",
                        "gear.roll_angle repeats nearly every station");
    double most = contact_pieces_cut(count, pieces, width);
    if (width < most)
        return FF_OK;
    if (!s->ramp_given) {
        shrink_ramps(s, pieces, count, most);
        return FF_OK;
    }
    return ff_failf(s->host, FF_INVALID, "load_ramp",
                    "load_ramp %g deg does not fit between the changes in the number of pairs; it "
                    "must be less than %.4g deg for this gear",
                    s->load_ramp / degree, most / degree);
}

/* The largest force and error of one engagement, and what lies below 0. */
static void add_force(record *r, const contact_tooth_path *p, const contact_load_curve *force)
{
    const double *f = force->value;
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
    if (p->had == 1)
        return;
    if (p->count == p->had)
        snprintf(text, sizeof text, "all %zu engagements of the motion are taken", p->had);
    else
        snprintf(text, sizeof text,
                 s->engagements.one == CONTACT_ENGAGEMENTS_ALL
                     ? "%zu of the %zu engagements of the motion stand for all, spread over them; "
                       "max_engagements takes more"
                     : "%zu of the %zu engagements of the motion alone, as asked for",
                 p->count, p->had);
    if (p->count < p->had)
        s->host->log(s->host->ctx, FF_LOG_INFO, text);
    s->host->quality(s->host->ctx, "engagements", (double)p->count, (double)p->had, FF_GOOD, text);
}

/* Over whole periods the mesh force is F on the mean, as the gears gain no speed; what is below 0
   bears on the other flank and is no load of this one. */
static void report_load(const tooth_pair *s, const contact_tooth_path *p, const record *r)
{
    const double limit = 0.01, turns = p->pitch * (double)p->count;
    if (!(p->line_force > 0))
        return;
    double off = fabs((r->load_sum - r->negative) / turns / p->line_force - 1);
    s->host->quality(s->host->ctx, "mesh_load", off, limit, off <= limit ? FF_GOOD : FF_DOUBTFUL,
                     "mean force of all pairs in mesh against torque over base radius, over that; "
                     "over whole periods of the motion both are equal, and engagements that stand "
                     "for others, or forces beyond the path, make them differ");
}

static ff_status report(const tooth_pair *s, const contact_tooth_path *p, const record *r,
                        uint64_t wanted)
{
    double error = r->top > 0 ? r->error / r->top : 0;
    s->host->quality(s->host->ctx, "load_interpolation", error, 0.01,
                     error <= 0.01 ? FF_GOOD : FF_DOUBTFUL,
                     "estimated error of the tooth force between stations, over its maximum");
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
        contact_monotone_slopes(n, curve->angle + k, curve->value + k, slope + k);
    }
}

/* `slopes` and `knots` hold 2 n and n numbers, `pieces` n/2 pieces. */
static ff_status make_history(const tooth_pair *s, const contact_tooth_path *p, uint64_t wanted,
                              contact_piece *pieces, double *slopes, double *knots)
{
    double path_length = p->angle[p->n - 1] - p->angle[0];
    size_t count = contact_pieces_find(p->n, p->angle, 2 * step_width * path_length, pieces);
    ff_status status = cut_ramps(s, p, pieces, count);
    if (status != FF_OK)
        return status;
    size_t knot_count = list_knots(pieces, count, p, knots);
    if (knot_count > s->points)
        return ff_failf(s->host, FF_INVALID, "points",
                        "points is %zu; the history needs at least %zu for the ramps of its load",
                        s->points, knot_count);
    record r = {0};
    engagement e = {.force = {p->n, count, p->angle, NULL, slopes, pieces},
                    .gap = {p->n, count, p->angle, NULL, slopes + p->n, pieces}};
    status = contact_history_open(&r.history, s->host, wanted, p->count * s->points,
                                  p->reduced_modulus, s->law);
    for (size_t k = 0; k < p->count && status == FF_OK; k++) {
        size_t number = p->engagement[k];
        e.number = (double)number;
        e.force.value = p->force + number * p->n;
        set_slopes(&e.force, slopes);
        if (p->gap) {
            e.gap.value = p->gap + (p->gaps > 1 ? number * p->n : 0);
            set_slopes(&e.gap, slopes + p->n);
        }
        status = fill(s, p, &e, knots, knot_count, &r);
        add_force(&r, p, &e.force);
        e.begin += path_length / p->speed;
    }
    return status == FF_OK ? report(s, p, &r, wanted) : status;
}

static ff_status evaluate(void *self, uint64_t wanted, const ff_array *in)
{
    const tooth_pair *s = self;
    contact_tooth_path p;
    ff_status status = contact_tooth_path_read(s->host, in, s->engagements, &p);
    contact_piece *pieces = NULL;
    double *slopes = NULL, *knots = NULL;
    if (status != FF_OK)
        goto out;
    pieces = malloc((p.n / 2) * sizeof *pieces);
    slopes = malloc(2 * p.n * sizeof *slopes);
    knots = malloc(p.n * sizeof *knots);
    status =
        pieces && slopes && knots ? make_history(s, &p, wanted, pieces, slopes, knots) : FF_NOMEM;
out:
    free(p.engagement);
    free(pieces);
    free(slopes);
    free(knots);
    return status;
}

static void destroy(void *self)
{
    free(self);
}

static const ff_model model = {
    sizeof(ff_model),
    FF_ABI_MAJOR,
    FF_ABI_MINOR,
    "contact/tooth-pair",
    "1.0.0",
    "load, radii and speeds of one tooth pair from SAP to tip",
    "Li and Kahraman 2011, Proc. IMechE Part J, Influence of dynamic behaviour on "
    "elastohydrodynamic lubrication of spur gears; Steffen 1990, Astron. Astrophys. 239, 443 "
    "(interpolation)",
    "@article{likahraman2011, author = {Li, S. and Kahraman, A.}, title = {Influence of dynamic "
    "behaviour on elastohydrodynamic lubrication of spur gears}, journal = {Proceedings of the "
    "Institution of Mechanical Engineers, Part J}, pages = {740--753}, year = {2011}}\n"
    "@article{steffen1990, author = {Steffen, M.}, title = {A simple method for monotonic "
    "interpolation in one dimension}, journal = {Astronomy and Astrophysics}, volume = {239}, "
    "pages = {443--450}, year = {1990}}",
    "GPL-3.0-or-later",
    0,
    FF_TABLE(params),
    FF_TABLE(contact_tooth_inputs),
    FF_TABLE(contact_outputs),
    create,
    set,
    wire,
    NULL,
    evaluate,
    NULL,
    destroy,
    NULL,
    NULL,
    NULL,
    FF_NO_TABLE,
};

const ff_model *flankfilm_model_v1(void)
{
    return &model;
}
