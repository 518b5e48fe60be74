/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "film-wire.h"

#include "../numerics/interval.h"
#include "smooth-piece.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Pieces to a mesh cycle, and samples to a piece. They are the same in every round, so that what
   acts on the motion is linear in what the film gives, and a loop can settle. */
enum { DENSITY = 32, SAMPLES = 32 };

/* The most pairs in mesh: twice what gear/involute-spur allows. */
enum { PAIRS = 8 };

/* Distance of the pieces from the curves, over the largest of these, from which it is doubtful. */
static const double doubtful = 0.02;

/* Shares of the highest pressure, of which the square is a share of the load, below which the film
   is that of flanks which part and its thickness no deflection, and from which it counts in full.
   As flanks part, load and film decide each other at once, and a loop over h ~ W^-0.13 settles only
   where the film is stiffer than the teeth, W/(0.13 h) > k: from a thousandth of the load on, or
   0.03. As flanks land the oil takes its time, and films that the motion knows in flight count from
   a smaller load on. */
static const double parted = 0.1, borne = 0.2, landing = 0.01, landed = 0.02;

/* Share of the largest separation from the film that the motion knows, below which flanks fly. */
static const double flight = 0.1;

static const double at_node = 1e-9;

/* One film history: several engagements behind each other. */
typedef struct history {
    size_t count, engagements, *first; /* first: of each engagement, and the count behind them */
    const double *roll, *engagement, *traction, *rolling, *loss;
    double *thickness;
    double speed[2]; /* of the gears, rad/s */
    double width;
    int in_oil; /* the motion knows the film between parted flanks */
    const ff_array *in;
    const dynamics_inputs *inputs;
} history;

/* Torques of all pairs against the rotation of each gear, the film in series with the mesh, what
   the films dissipate, and of each pair its film and its share of the load. */
typedef struct place {
    double against[2], thickness, loss;
    double film[PAIRS], share[PAIRS];
} place;

int dynamics_film_is_wired(const ff_array *in)
{
    return in[DYNAMICS_IN_FILM_ROLL_ANGLE].data != NULL;
}

static ff_status read_series(const ff_host *host, const ff_array *in, int input, size_t count,
                             const double **data)
{
    const ff_array *a = &in[input];
    const char *name = dynamics_oil_input_ports[input].name;
    if (!a->data || a->rank != 1 || a->shape[0] != count || count < 2)
        return ff_failf(host, FF_INVALID, name,
                        "the film must give a series of %zu values, of at least 2", count);
    for (size_t i = 0; i < count; i++)
        if (!isfinite(a->data[i]))
            return ff_failf(host, FF_INVALID, name, "value %zu is not a finite number", i + 1);
    *data = a->data;
    return FF_OK;
}

/* The largest value; at least 0. */
static double largest(size_t count, const double *x)
{
    double most = 0;
    for (size_t i = 0; i < count; i++)
        most = fmax(most, x[i]);
    return most;
}

/* How far the thickness is that of loaded flanks, given over the whole history. */
static void weigh(const history *y, const double *h, const double *p, double *weight)
{
    double thickest = largest(y->count, h), highest = largest(y->count, p);
    int lands = 0;
    for (size_t i = 0; i < y->count; i++) {
        double share = highest > 0 ? p[i] / highest : 0;
        if (share >= borne)
            lands = 0;
        else if (y->in_oil && h[i] < flight * thickest)
            lands = 1;
        double from = lands ? landing : parted, to = lands ? landed : borne;
        weight[i] = fmin(fmax((share - from) / (to - from), 0), 1);
    }
}

/* The thickness x where it is one of loaded flanks, and the straightest way where it is not: least
   sum w (x - h)^2 + bend (x_(i+1) - x_i)^2, a system of three diagonals. It changes smoothly with
   the pressure, so that a loop can settle. */
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

static ff_status read_thickness(const double *h, const double *p, history *y)
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

static ff_status read_history(const ff_host *host, const ff_array *in,
                              const dynamics_inputs *inputs, history *y)
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
    if (status != FF_OK)
        return status;
    if (y->count > 0 && y->roll[y->count - 1] - inputs->roll_sap > PAIRS * inputs->pitch)
        return ff_failf(host, FF_INVALID, "film.roll_angle",
                        "film.roll_angle must end within %d mesh cycles of the start of active "
                        "profile",
                        PAIRS);
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

/* A place among non-decreasing stations: behind the first of two, by a share of their distance. */
typedef struct between {
    size_t i;
    double share;
} between;

/* Where one station stands twice, it is that `before` the place or that behind it. */
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

/* Adds one engagement's pairs at a phase; at the ends of an engagement `before` the phase or behind
   it. */
static void add_engagement(const history *y, size_t first, size_t last, double phase, int before,
                           place *sum)
{
    const dynamics_inputs *inputs = y->inputs;
    const double *radius[2] = {y->in[DYNAMICS_IN_RADIUS_1].data, y->in[DYNAMICS_IN_RADIUS_2].data};
    const double *bearing = inputs->line_force > 0 ? inputs->tooth_force : inputs->load_share;
    double slack = at_node * inputs->pitch;
    size_t count = last - first;
    for (int pair = 0; pair < PAIRS; pair++) {
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
        double share = bearing ? value_between(&station, bearing) : 1, arm[2];
        for (int g = 0; g < 2; g++)
            arm[g] = value_between(&station, radius[g]);
        /* rolling resistance is the loss over 2 u_r = r1 w1 + r2 w2 */
        rolling /= arm[0] * y->speed[0] + arm[1] * y->speed[1];
        sum->against[0] += (friction + rolling) * arm[0];
        sum->against[1] += (rolling - friction) * arm[1];
        sum->share[pair] += share;
        sum->film[pair] += share * value_between(&step, y->thickness + first);
        sum->loss += y->width * value_between(&step, y->loss + first);
    }
}

/* The mean over the engagements. */
static place place_at(const history *y, double phase, int before)
{
    place sum = {.loss = 0};
    double share = 1 / (double)y->engagements, all = 0;
    for (size_t i = 0; i < y->engagements; i++)
        if (y->first[i + 1] - y->first[i] > 1)
            add_engagement(y, y->first[i], y->first[i + 1], phase, before, &sum);
    sum.against[0] *= share;
    sum.against[1] *= share;
    sum.loss *= share;
    for (int pair = 0; pair < PAIRS; pair++)
        all += sum.share[pair];
    for (int pair = 0; pair < PAIRS && all > 0; pair++) {
        sum.thickness += sum.film[pair] / all;
        sum.film[pair] = sum.share[pair] > 0 ? sum.film[pair] / sum.share[pair] : 0;
        sum.share[pair] /= all;
    }
    return sum;
}

/* Adds a node at a phase, where the curves of the film may jump. */
static int cut_at(dynamics_excitation *x, double phase)
{
    phase -= floor(phase);
    size_t i = 0;
    while (i + 1 < x->count && x->pieces[i + 1].start <= phase + at_node)
        i++;
    double since = phase - x->pieces[i].start;
    if (since < at_node || x->pieces[i].length - since < at_node)
        return 1;
    dynamics_piece *more = realloc(x->pieces, (x->count + 1) * sizeof *more);
    if (!more)
        return 0;
    memmove(more + i + 1, more + i, (x->count - i) * sizeof *more);
    x->pieces = more;
    x->count++;
    more[i].length = since;
    more[i + 1].start = phase;
    more[i + 1].length -= since;
    more[i + 1].jump = 0;
    dynamics_piece_shift(more[i].k, more[i].degree, since, 1, more[i + 1].k);
    dynamics_piece_shift(more[i].e, more[i].degree, since, 1, more[i + 1].e);
    return 1;
}

/* The samples of all pieces, behind each other. */
typedef struct samples {
    size_t count, *first; /* first sample of each piece, and the number of all */
    double *phase, *drag, *film, *grown;
    place *at;
} samples;

static void free_samples(samples *s)
{
    free(s->first);
    free(s->phase);
    free(s->at);
}

static int take_samples(const history *y, const dynamics_excitation *x, samples *s)
{
    s->first = malloc((x->count + 1) * sizeof *s->first);
    if (!s->first)
        return 0;
    for (size_t i = 0; i < x->count; i++) {
        double length = x->pieces[i].length;
        s->first[i] = s->count;
        s->count += SAMPLES * (size_t)ceil(DENSITY * length) + 1;
    }
    s->first[x->count] = s->count;
    s->phase = malloc(4 * s->count * sizeof *s->phase);
    s->at = malloc(s->count * sizeof *s->at);
    if (!s->phase || !s->at)
        return 0;
    s->drag = s->phase + s->count;
    s->film = s->drag + s->count;
    s->grown = s->film + s->count;
    for (size_t i = 0; i < x->count; i++) {
        size_t n = s->first[i + 1] - s->first[i];
        for (size_t k = 0; k < n; k++) {
            const dynamics_piece *p = &x->pieces[i];
            double phase = k + 1 < n          ? p->start + p->length * (double)k / (double)(n - 1)
                           : i + 1 < x->count ? p[1].start
                                              : 1;
            s->phase[s->first[i] + k] = phase;
            s->at[s->first[i] + k] = place_at(y, phase, k + 1 == n);
        }
    }
    return 1;
}

/* Mean over the mesh cycle, by trapezia. */
static place mean_of(const samples *s)
{
    place mean = {.loss = 0};
    for (size_t i = 0; i + 1 < s->count; i++) {
        double half = 0.5 * (s->phase[i + 1] - s->phase[i]);
        for (int g = 0; g < 2; g++)
            mean.against[g] += half * (s->at[i].against[g] + s->at[i + 1].against[g]);
        mean.thickness += half * (s->at[i].thickness + s->at[i + 1].thickness);
        mean.loss += half * (s->at[i].loss + s->at[i + 1].loss);
    }
    return mean;
}

/* How much the films of the pairs grow between two samples, each by its share of the load: what
   the mesh force does work on. The film in series also changes as the shares do, which is the work
   of k(t) on springs side by side. */
static double growth(const place *a, const place *z)
{
    double sum = 0;
    for (int pair = 0; pair < PAIRS; pair++)
        if (a->share[pair] > 0 && z->share[pair] > 0)
            sum += 0.5 * (a->share[pair] + z->share[pair]) * (z->film[pair] - a->film[pair]);
    return sum;
}

/* The drag along the line of action. What torques keep the gears turning sees the mean of gear 1's
   alone, since its torque is given; the vibration sees what is left, weighted by the gears'
   compliance to it. */
static void make_curves(const history *y, const dynamics_excitation *x, samples *s,
                        const place *mean)
{
    const ff_array *in = y->in;
    const double *inertia = in[DYNAMICS_IN_INERTIA].data, *teeth = in[DYNAMICS_IN_TEETH].data;
    size_t last = y->inputs->stations - 1;
    double base[2], give[2], unit = x->stiffness * x->length;
    base[0] = (in[DYNAMICS_IN_RADIUS_1].data[last] - in[DYNAMICS_IN_RADIUS_1].data[0]) /
              (y->inputs->roll_angle[last] - y->inputs->roll_angle[0]);
    base[1] = base[0] * teeth[1] / teeth[0];
    for (int g = 0; g < 2; g++)
        give[g] = base[g] * base[g] / inertia[g];
    for (size_t i = 0; i < s->count; i++) {
        const place *p = &s->at[i];
        double drag = mean->against[0] / base[0];
        for (int g = 0; g < 2; g++)
            drag += (g ? -1 : 1) * give[g] / (give[0] + give[1]) *
                    (p->against[g] - mean->against[g]) / base[g];
        s->drag[i] = drag / unit;
        s->film[i] = (p->thickness - mean->thickness) / x->length;
        s->grown[i] = i ? s->grown[i - 1] + growth(p - 1, p) / x->length : 0;
    }
}

/* The pieces under construction. */
typedef struct builder {
    dynamics_piece *pieces;
    size_t count;
    double unit[3]; /* largest of drag, film and its growth */
    double off[3];  /* largest distance from them, over it */
} builder;

/* Fits what lies between two samples. */
static void add_piece(builder *b, const dynamics_piece *old, const samples *s, size_t first,
                      size_t last)
{
    double fit[3][DYNAMICS_DEGREE + 1];
    const double *series[3] = {s->drag, s->film, s->grown};
    dynamics_piece *p = &b->pieces[b->count++];
    p->start = s->phase[first];
    p->length = s->phase[last] - s->phase[first];
    p->degree = DYNAMICS_DEGREE;
    dynamics_piece_shift(old->k, old->degree, p->start - old->start, 1, p->k);
    dynamics_piece_shift(old->e, old->degree, p->start - old->start, 1, p->e);
    for (int k = 0; k < 3; k++)
        b->off[k] = fmax(b->off[k], dynamics_smooth_series(s->phase + first, series[k] + first,
                                                           last - first + 1, b->unit[k], fit[k]));
    for (int i = 0; i <= DYNAMICS_DEGREE; i++) {
        p->drag[i] = b->unit[0] * fit[0][i];
        p->e[i] -= b->unit[1] * fit[1][i];
        p->film[i] = b->unit[2] * fit[2][i];
    }
}

static void report(const ff_host *host, const history *y, const builder *b)
{
    char text[200];
    double off = fmax(fmax(b->off[0], b->off[1]), b->off[2]);
    snprintf(text, sizeof text,
             "largest distance of %zu pieces from the friction of the film, %.1g, its thickness, "
             "%.1g, and its growth, %.1g, over the largest of each",
             b->count, b->off[0], b->off[1], b->off[2]);
    host->quality(host->ctx, "film_representation", off, doubtful,
                  off <= doubtful ? FF_GOOD : FF_DOUBTFUL, text);
    if (y->engagements > 1)
        host->quality(
            host->ctx, "film_engagements", (double)y->engagements, 1, FF_DOUBTFUL,
            "engagements of the motion whose films differ; the mean of them acts on each");
}

static ff_status check_gear(const ff_host *host, const ff_array *in, size_t stations)
{
    const int series[] = {DYNAMICS_IN_RADIUS_1, DYNAMICS_IN_RADIUS_2};
    for (int i = 0; i < 2; i++)
        if (!in[series[i]].data || in[series[i]].rank != 1 || in[series[i]].shape[0] != stations ||
            stations < 2)
            return ff_failf(host, FF_INVALID, dynamics_oil_input_ports[series[i]].name,
                            "a film that is wired back needs the radii at the gear's stations");
    if (!in[DYNAMICS_IN_FACE_WIDTH].data || !in[DYNAMICS_IN_INERTIA].data)
        return ff_failf(
            host, FF_INVALID,
            dynamics_oil_input_ports[in[DYNAMICS_IN_FACE_WIDTH].data ? DYNAMICS_IN_INERTIA
                                                                     : DYNAMICS_IN_FACE_WIDTH]
                .name,
            "a film that is wired back needs a gear that offers it");
    for (int g = 0; g < 2; g++)
        if (!(in[DYNAMICS_IN_INERTIA].data[g] > 0 && isfinite(in[DYNAMICS_IN_INERTIA].data[g])))
            return ff_failf(host, FF_INVALID, dynamics_oil_input_ports[DYNAMICS_IN_INERTIA].name,
                            "must be above 0, but is %g kg m2", in[DYNAMICS_IN_INERTIA].data[g]);
    return FF_OK;
}

/* Takes out what the user has switched off. */
static void switch_off(const dynamics_film_wire *wire, history *y, const double *nothing)
{
    if (!wire->friction)
        y->traction = nothing;
    if (!wire->rolling)
        y->rolling = nothing;
    if (!wire->compliance)
        memset(y->thickness, 0, y->count * sizeof *y->thickness);
}

static ff_status build(const ff_host *host, const history *y, dynamics_excitation *x,
                       dynamics_film_powers *powers)
{
    samples s = {0};
    builder b = {0};
    ff_status status = FF_NOMEM;
    double pitch = y->inputs->pitch, first = (y->roll[0] - y->inputs->roll_sap) / pitch;
    double last = (y->roll[y->count - 1] - y->inputs->roll_sap) / pitch;
    if (cut_at(x, first) && cut_at(x, last) && take_samples(y, x, &s)) {
        place mean = mean_of(&s);
        make_curves(y, x, &s, &mean);
        powers->torques = y->speed[0] * mean.against[0] + y->speed[1] * mean.against[1];
        powers->loss = mean.loss;
        for (size_t i = 0; i < s.count; i++) {
            b.unit[0] = fmax(b.unit[0], fabs(s.drag[i]));
            b.unit[1] = fmax(b.unit[1], fabs(s.film[i]));
            b.unit[2] = fmax(b.unit[2], fabs(s.grown[i]));
        }
        for (int i = 0; i < 3; i++)
            b.unit[i] = b.unit[i] > 0 ? b.unit[i] : 1;
        b.pieces = calloc(s.count / SAMPLES, sizeof *b.pieces);
        for (size_t i = 0; b.pieces && i < x->count; i++)
            for (size_t from = s.first[i]; from + 1 < s.first[i + 1]; from += SAMPLES)
                add_piece(&b, &x->pieces[i], &s, from, from + SAMPLES);
        status = b.pieces ? FF_OK : FF_NOMEM;
    }
    free_samples(&s);
    if (status != FF_OK) {
        free(b.pieces);
        return status;
    }
    free(x->pieces);
    x->pieces = b.pieces;
    x->count = b.count;
    x->fed_back = 1;
    dynamics_excitation_mark_jumps(x);
    report(host, y, &b);
    return FF_OK;
}

ff_status dynamics_film_wire_read(const ff_host *host, const ff_array *in,
                                  const dynamics_film_wire *wire, const dynamics_inputs *inputs,
                                  dynamics_excitation *excitation, dynamics_film_powers *powers)
{
    history y = {.in_oil = excitation->film != NULL};
    double *nothing = NULL;
    *powers = (dynamics_film_powers){0, NAN};
    if (!dynamics_film_is_wired(in))
        return FF_OK;
    ff_status status = check_gear(host, in, inputs->stations);
    if (status == FF_OK)
        status = read_history(host, in, inputs, &y);
    if (status == FF_OK) {
        nothing = calloc(y.count, sizeof *nothing);
        status = nothing ? FF_OK : FF_NOMEM;
    }
    if (status == FF_OK) {
        switch_off(wire, &y, nothing);
        status = build(host, &y, excitation, powers);
    }
    free(nothing);
    free(y.thickness);
    free(y.first);
    return status;
}
