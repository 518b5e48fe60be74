/* SPDX-License-Identifier: GPL-3.0-or-later */
/* contact/tooth-pair: what one pair of teeth goes through from SAP to tip. */
#include "history.h"
#include "load-curve.h"

#include <flankfilm/author.h>

#include <math.h>
#include <stdlib.h>

static const double degree = M_PI / 180;

/* A step of the load is so wide, over the length of the path; zones up to twice that are left out,
   so that steps always fit. */
static const double step_width = 1e-6;

enum { P_LOAD_RAMP, P_POINTS, P_ENGAGEMENT };

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
     .doc = "instants of the history; the ends of the ramps are among them",
     .type = FF_INT,
     .flags = FF_TUNABLE,
     .preset = "1000",
     .min = 16,
     .max = 1e6},
    {.name = "engagement",
     .unit = "1",
     .doc = "which mesh cycle of a motion that lasts several the pair begins in, from 0",
     .type = FF_INT,
     .preset = "0",
     .min = 0,
     .max = 1e6},
};

enum {
    IN_ROLL_ANGLE,
    IN_RADIUS_1,
    IN_RADIUS_2,
    IN_FACE_WIDTH,
    IN_TEETH,
    IN_REDUCED_MODULUS,
    IN_SPEED,
    IN_TOOTH_FORCE,
    IN_GAP,
    IN_VISCOSITY
};

static const ff_port inputs[] = {
    {.name = "gear.roll_angle",
     .unit = "rad",
     .doc = "roll angle of gear 1 from SAP to tip; an angle given twice marks a jump of the load",
     .dims = "station",
     .from = "gear"},
    {.name = "gear.radius_1",
     .unit = "m",
     .doc = "radius of curvature of flank 1",
     .dims = "station",
     .from = "gear"},
    {.name = "gear.radius_2",
     .unit = "m",
     .doc = "radius of curvature of flank 2",
     .dims = "station",
     .from = "gear"},
    {.name = "gear.face_width",
     .unit = "m",
     .doc = "width of the teeth in contact",
     .dims = "",
     .from = "gear"},
    {.name = "gear.teeth", .unit = "1", .doc = "numbers of teeth", .dims = "gear", .from = "gear"},
    {.name = "gear.reduced_modulus",
     .unit = "Pa",
     .doc = "reduced modulus E' of the flanks",
     .dims = "",
     .from = "gear"},
    {.name = "operating.speed", .unit = "rad/s", .doc = "speed of gear 1", .dims = ""},
    {.name = "load.tooth_force",
     .unit = "N",
     .doc = "force on the pair, quasi-static or dynamic",
     .dims = "engagement? station",
     .from = "stiffness|dynamics"},
    {.name = "load.gap",
     .unit = "m",
     .doc = "separation of the flanks where they bear no load",
     .dims = "engagement? station",
     .flags = FF_OPTIONAL,
     .from = "stiffness|dynamics"},
    {.name = "viscosity",
     .unit = "",
     .doc = "viscosity law, for the Moes numbers",
     .dims = "",
     .service = FF_VISCOSITY_ID,
     .flags = FF_OPTIONAL},
};

typedef struct tooth_pair {
    const ff_host *host;
    double load_ramp;
    bool ramp_given;
    size_t points, engagement;
    const ff_viscosity *law;
} tooth_pair;

/* The inputs, once checked. */
typedef struct path {
    size_t n; /* stations */
    const double *angle, *radius_1, *radius_2;
    const double *force, *gap; /* of the engagement; gap NULL: none */
    double face_width, ratio;  /* omega2 / omega1 */
    double speed, reduced_modulus;
} path;

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
    else
        s->engagement = (size_t)value->integer;
    return FF_OK;
}

static ff_status wire(void *self, uint32_t input, const void *service)
{
    tooth_pair *s = self;
    if (input == IN_VISCOSITY)
        s->law = service;
    return FF_OK;
}

/* A scalar or the first two of a series, each finite and above 0. */
static ff_status take_positive(const tooth_pair *s, const ff_array *in, uint32_t row, size_t count,
                               double *value)
{
    size_t length = in[row].rank == 0 ? 1 : in[row].shape[0];
    if (!in[row].data || in[row].rank > 1 || length < count)
        return ff_failf(s->host, FF_INVALID, inputs[row].name, "%s must hold %zu value%s",
                        inputs[row].name, count, count == 1 ? "" : "s");
    for (size_t i = 0; i < count; i++) {
        value[i] = in[row].data[i];
        if (!(value[i] > 0 && isfinite(value[i])))
            return ff_failf(s->host, FF_INVALID, inputs[row].name, "%s is %g; it must be above 0",
                            inputs[row].name, value[i]);
    }
    return FF_OK;
}

/* A series over the stations; of several engagements the one that is asked for. */
static ff_status take_series(const tooth_pair *s, const ff_array *in, uint32_t row, size_t n,
                             double least, const double **series)
{
    const ff_array *a = &in[row];
    size_t engagements = a->rank == 2 ? a->shape[0] : 1;
    if (!a->data || a->rank < 1 || a->rank > 2 || a->shape[a->rank - 1] != n)
        return ff_failf(s->host, FF_INVALID, inputs[row].name,
                        "%s must have one value for each of the %zu stations of the gear",
                        inputs[row].name, n);
    if (row >= IN_TOOTH_FORCE && s->engagement >= engagements &&
        (a->rank == 2 || row == IN_TOOTH_FORCE))
        return ff_failf(s->host, FF_INVALID, "engagement",
                        "engagement %zu does not exist: the load has %zu, counted from 0",
                        s->engagement, engagements);
    *series = a->data + (a->rank == 2 ? s->engagement * n : 0);
    const double most = 1e100; /* slopes between stations stay finite too */
    for (size_t i = 0; i < n; i++) {
        double value = (*series)[i];
        if (!(value >= least && value <= most))
            return ff_failf(s->host, FF_INVALID, inputs[row].name,
                            "%s is %g at station %zu; it must lie between %g and %g",
                            inputs[row].name, value, i, least, most);
    }
    return FF_OK;
}

static ff_status take_stations(const tooth_pair *s, const ff_array *in, path *p)
{
    p->n = in[IN_ROLL_ANGLE].data && in[IN_ROLL_ANGLE].rank == 1 ? in[IN_ROLL_ANGLE].shape[0] : 0;
    if (p->n < 2)
        return ff_failf(s->host, FF_INVALID, "gear.roll_angle",
                        "gear.roll_angle must hold at least 2 stations");
    ff_status status = take_series(s, in, IN_ROLL_ANGLE, p->n, 0, &p->angle);
    for (size_t i = 1; i < p->n && status == FF_OK; i++)
        if (p->angle[i] < p->angle[i - 1])
            return ff_failf(s->host, FF_INVALID, "gear.roll_angle",
                            "gear.roll_angle decreases at station %zu", i);
    if (status == FF_OK && !(p->angle[p->n - 1] > p->angle[0]))
        return ff_failf(s->host, FF_INVALID, "gear.roll_angle",
                        "gear.roll_angle must increase from SAP to tip");
    if (status == FF_OK)
        status = take_series(s, in, IN_RADIUS_1, p->n, 1e-100, &p->radius_1);
    if (status == FF_OK)
        status = take_series(s, in, IN_RADIUS_2, p->n, 1e-100, &p->radius_2);
    if (status == FF_OK)
        status = take_series(s, in, IN_TOOTH_FORCE, p->n, -1e100, &p->force);
    if (status == FF_OK && in[IN_GAP].data)
        status = take_series(s, in, IN_GAP, p->n, -1e100, &p->gap);
    return status;
}

static ff_status take_inputs(const tooth_pair *s, const ff_array *in, path *p)
{
    double teeth[2] = {1, 1};
    *p = (path){0};
    ff_status status = take_positive(s, in, IN_FACE_WIDTH, 1, &p->face_width);
    if (status == FF_OK)
        status = take_positive(s, in, IN_TEETH, 2, teeth);
    if (status == FF_OK)
        status = take_positive(s, in, IN_REDUCED_MODULUS, 1, &p->reduced_modulus);
    if (status == FF_OK)
        status = take_positive(s, in, IN_SPEED, 1, &p->speed);
    p->ratio = teeth[0] / teeth[1];
    return status == FF_OK ? take_stations(s, in, p) : status;
}

/* Where the history has to stop by: SAP, both ends of each ramp, tip. knots holds 2 count. */
static size_t list_knots(const ff_piece *pieces, size_t count, const path *p, double *knots)
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

static ff_contact_point point_at(const path *p, const ff_load_curve *force,
                                 const ff_load_curve *gap, double angle)
{
    /* the radii of involute flanks are linear in the roll angle, so this is exact */
    size_t i = ff_interval(p->n, p->angle, angle);
    double width = p->angle[i + 1] - p->angle[i];
    double t = width > 0 ? (angle - p->angle[i]) / width : 0;
    ff_contact_point point = {
        .time = (angle - p->angle[0]) / p->speed,
        .roll_angle = angle,
        .radius_1 = p->radius_1[i] + t * (p->radius_1[i + 1] - p->radius_1[i]),
        .radius_2 = p->radius_2[i] + t * (p->radius_2[i + 1] - p->radius_2[i]),
        .load_per_width = ff_load_at(force, angle) / p->face_width,
    };
    /* along the flank a surface moves at the speed of its gear times its radius of curvature */
    point.speed_1 = p->speed * point.radius_1;
    point.speed_2 = p->speed * p->ratio * point.radius_2;
    if (gap->value && !(point.load_per_width > 0))
        point.gap = ff_load_at(gap, angle);
    return point;
}

/* Instants spread evenly between the knots, in proportion to the angle between them. */
static ff_status fill(const tooth_pair *s, const path *p, const ff_load_curve *force,
                      const ff_load_curve *gap, const double *knots, size_t knot_count,
                      ff_history *h)
{
    double per_angle = (double)(s->points - 1) / (knots[knot_count - 1] - knots[0]);
    size_t done = 0;
    ff_contact_point point = point_at(p, force, gap, knots[0]);
    ff_status status = ff_history_put(h, 0, &point);
    for (size_t k = 1; k < knot_count && status == FF_OK; k++) {
        size_t most = s->points - (knot_count - k); /* leaves one for each knot to come */
        double wish = round((knots[k] - knots[0]) * per_angle);
        size_t end = (size_t)fmin(fmax(wish, (double)(done + 1)), (double)most);
        double step = (knots[k] - knots[k - 1]) / (double)(end - done);
        for (size_t i = done + 1; i <= end && status == FF_OK; i++) {
            double angle = i == end ? knots[k] : knots[k - 1] + step * (double)(i - done);
            point = point_at(p, force, gap, angle);
            status = ff_history_put(h, i, &point);
        }
        done = end;
    }
    return status;
}

/* Half of the zone that limits the ramps is left free of them. */
static void shrink_ramps(const tooth_pair *s, ff_piece *pieces, size_t count, double most)
{
    char text[200];
    ff_pieces_cut(count, pieces, most / 2);
    snprintf(
        text, sizeof text,
        "load_ramp is %.4g deg instead of %.4g deg: half of what fits between the changes in the "
        "number of pairs",
        most / 2 / degree, s->load_ramp / degree);
    s->host->log(s->host->ctx, FF_LOG_INFO, text);
}

static ff_status cut_ramps(const tooth_pair *s, const path *p, ff_piece *pieces, size_t count)
{
    double width = fmax(s->load_ramp, step_width * (p->angle[p->n - 1] - p->angle[0]));
    if (count == 0)
        return ff_failf(s->host, FF_INVALID, "gear.roll_angle",
                        "gear.roll_angle repeats nearly every station");
    double most = ff_pieces_cut(count, pieces, width);
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

static void report(const tooth_pair *s, const ff_load_curve *force)
{
    double top = 0;
    for (size_t i = 0; i < force->n; i++)
        top = fmax(top, force->value[i]);
    double error = top > 0 ? ff_load_error(force) / top : 0;
    s->host->quality(s->host->ctx, "load_interpolation", error, 0.01,
                     error <= 0.01 ? FF_GOOD : FF_DOUBTFUL,
                     "estimated error of the tooth force between stations, over its maximum");
}

static void set_slopes(const ff_load_curve *curve, double *slope)
{
    for (size_t i = 0; i < curve->piece_count; i++) {
        size_t k = curve->pieces[i].first, n = curve->pieces[i].last - k + 1;
        ff_monotone_slopes(n, curve->angle + k, curve->value + k, slope + k);
    }
}

/* `slopes` and `knots` hold 2 n and n numbers, `pieces` n/2 pieces. */
static ff_status make_history(const tooth_pair *s, const path *p, uint64_t wanted, ff_piece *pieces,
                              double *slopes, double *knots)
{
    ff_history history;
    double path_length = p->angle[p->n - 1] - p->angle[0];
    size_t count = ff_pieces_find(p->n, p->angle, 2 * step_width * path_length, pieces);
    ff_status status = cut_ramps(s, p, pieces, count);
    if (status != FF_OK)
        return status;
    size_t knot_count = list_knots(pieces, count, p, knots);
    if (knot_count > s->points)
        return ff_failf(s->host, FF_INVALID, "points",
                        "points is %zu; the history needs at least %zu for the ramps of its load",
                        s->points, knot_count);
    ff_load_curve force = {p->n, count, p->angle, p->force, slopes, pieces};
    ff_load_curve gap = {p->n, count, p->angle, p->gap, slopes + p->n, pieces};
    set_slopes(&force, slopes);
    if (p->gap)
        set_slopes(&gap, slopes + p->n);
    status = ff_history_open(&history, s->host, wanted, s->points, p->reduced_modulus, s->law);
    if (status == FF_OK)
        status = fill(s, p, &force, &gap, knots, knot_count, &history);
    if (status == FF_OK) {
        report(s, &force);
        ff_history_report(&history);
    }
    return status;
}

static ff_status evaluate(void *self, uint64_t wanted, const ff_array *in)
{
    const tooth_pair *s = self;
    path p;
    ff_status status = take_inputs(s, in, &p);
    if (status != FF_OK)
        return status;
    ff_piece *pieces = malloc((p.n / 2) * sizeof *pieces);
    double *slopes = malloc(2 * p.n * sizeof *slopes), *knots = malloc(p.n * sizeof *knots);
    status =
        pieces && slopes && knots ? make_history(s, &p, wanted, pieces, slopes, knots) : FF_NOMEM;
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
    FF_TABLE(inputs),
    FF_TABLE(ff_contact_outputs),
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
