/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "film-wire.h"

#include "film-history.h"
#include "smooth-piece.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Pieces per mesh cycle, and samples per piece. They are the same in every round. The curves of the
   motion therefore depend linearly on the film, and the feedback loop can converge. */
enum { DENSITY = 32, SAMPLES = 32 };

/* The fit is doubtful if the pieces deviate from the curves by more than this share of the largest
   value. */
static const double doubtful = 0.02;

/* Phases that differ by less than this (mesh cycles) are equal. */
static const double at_node = 1e-9;

int dynamics_film_is_wired(const ff_array *in)
{
    return in[DYNAMICS_IN_FILM_ROLL_ANGLE].data != NULL;
}

/* Splits a piece at a phase at which the curves of the film may jump. Returns 0 if out of
   memory. */
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
    dynamics_piece_start_later(&more[i], since, &more[i + 1]);
    return 1;
}

/* The samples of all pieces, one piece after another. */
typedef struct samples {
    size_t count, *first; /* index of the first sample of each piece; first[number of pieces] =
                             count */
    double *phase, *drag, *film, *grown;
    dynamics_film_sum *at;
} samples;

static void free_samples(samples *s)
{
    free(s->first);
    free(s->phase);
    free(s->at);
}

static int take_samples(const dynamics_film_history *y, const dynamics_excitation *x, samples *s)
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
            s->at[s->first[i] + k] = dynamics_film_history_at(y, phase, k + 1 == n);
        }
    }
    return 1;
}

/* Returns the mean over the mesh cycle, by the trapezoidal rule. */
static dynamics_film_sum mean_of(const samples *s)
{
    dynamics_film_sum mean = {.loss = 0};
    for (size_t i = 0; i + 1 < s->count; i++) {
        double half = 0.5 * (s->phase[i + 1] - s->phase[i]);
        for (int g = 0; g < 2; g++)
            mean.against[g] += half * (s->at[i].against[g] + s->at[i + 1].against[g]);
        mean.thickness += half * (s->at[i].thickness + s->at[i + 1].thickness);
        mean.loss += half * (s->at[i].loss + s->at[i + 1].loss);
    }
    return mean;
}

/* Returns the film growth of the pairs between two samples, weighted by their load shares. The mesh
   force does work on this growth. Changes of the film due to changing load shares are excluded:
   their work belongs to the change of k(t), the stiffness of the parallel pairs. */
static double growth(const dynamics_film_sum *a, const dynamics_film_sum *z)
{
    double sum = 0;
    for (int pair = 0; pair < DYNAMICS_FILM_PAIRS; pair++)
        if (a->share[pair] > 0 && z->share[pair] > 0)
            sum += 0.5 * (a->share[pair] + z->share[pair]) * (z->film[pair] - a->film[pair]);
    return sum;
}

/* Computes the curves of drag, film thickness and film growth. The drag acts along the line of
   action. Its mean follows from the friction torque on gear 1 alone, since the torque of gear 1 is
   given. Its alternating part is the sum over both gears, weighted by base_radius^2/inertia. */
static void make_curves(const dynamics_film_history *y, const dynamics_excitation *x, samples *s,
                        const dynamics_film_sum *mean)
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
        const dynamics_film_sum *p = &s->at[i];
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
    double unit[3]; /* largest absolute value of drag, film and film growth */
    double off[3];  /* largest deviation from drag, film and film growth, relative to `unit` */
} builder;

/* Fits one piece to the samples `first` to `last`. */
static void add_piece(builder *b, const dynamics_piece *old, const samples *s, size_t first,
                      size_t last)
{
    double fit[3][DYNAMICS_DEGREE + 1];
    const double *series[3] = {s->drag, s->film, s->grown};
    dynamics_piece *p = &b->pieces[b->count++];
    p->start = s->phase[first];
    p->length = s->phase[last] - s->phase[first];
    p->degree = DYNAMICS_DEGREE;
    dynamics_piece_start_later(old, p->start - old->start, p);
    for (int k = 0; k < 3; k++)
        b->off[k] = fmax(b->off[k], dynamics_smooth_series(s->phase + first, series[k] + first,
                                                           last - first + 1, b->unit[k], fit[k]));
    for (int i = 0; i <= DYNAMICS_DEGREE; i++) {
        p->drag[i] = b->unit[0] * fit[0][i];
        p->e[i] -= b->unit[1] * fit[1][i];
        p->film[i] = b->unit[2] * fit[2][i];
    }
}

static void report(const ff_host *host, const dynamics_film_history *y, const builder *b)
{
    char text[200];
    double off = fmax(fmax(b->off[0], b->off[1]), b->off[2]);
    snprintf(text, sizeof text,
             "largest deviation of the %zu polynomial pieces from the friction of the film, %.1g, "
             "its thickness, %.1g, and its growth, %.1g, each relative to its largest value",
             b->count, b->off[0], b->off[1], b->off[2]);
    host->quality(host->ctx, "film_representation", off, doubtful,
                  off <= doubtful ? FF_GOOD : FF_DOUBTFUL, text);
    if (y->engagements > 1)
        host->quality(
            host->ctx, "film_engagements", (double)y->engagements, 1, FF_DOUBTFUL,
            "engagements of the motion have different films; their mean acts on the motion");
}

static ff_status check_gear(const ff_host *host, const ff_array *in, size_t stations)
{
    const int series[] = {DYNAMICS_IN_RADIUS_1, DYNAMICS_IN_RADIUS_2};
    for (int i = 0; i < 2; i++)
        if (!in[series[i]].data || in[series[i]].rank != 1 || in[series[i]].shape[0] != stations ||
            stations < 2)
            return ff_failf(host, FF_INVALID, dynamics_oil_input_ports[series[i]].name,
                            "a film that is wired back needs the radii of curvature at the "
                            "gear's stations");
    if (!in[DYNAMICS_IN_FACE_WIDTH].data || !in[DYNAMICS_IN_INERTIA].data)
        return ff_failf(
            host, FF_INVALID,
            dynamics_oil_input_ports[in[DYNAMICS_IN_FACE_WIDTH].data ? DYNAMICS_IN_INERTIA
                                                                     : DYNAMICS_IN_FACE_WIDTH]
                .name,
            "a film that is wired back to the motion needs a gear that gives this output");
    for (int g = 0; g < 2; g++)
        if (!(in[DYNAMICS_IN_INERTIA].data[g] > 0 && isfinite(in[DYNAMICS_IN_INERTIA].data[g])))
            return ff_failf(host, FF_INVALID, dynamics_oil_input_ports[DYNAMICS_IN_INERTIA].name,
                            "must be above 0, but is %g kg m2", in[DYNAMICS_IN_INERTIA].data[g]);
    return FF_OK;
}

/* Removes the effects that the user has switched off. */
static void switch_off(const dynamics_film_wire *wire, dynamics_film_history *y,
                       const double *nothing)
{
    if (!wire->friction)
        y->traction = nothing;
    if (!wire->rolling)
        y->rolling = nothing;
    if (!wire->compliance)
        memset(y->thickness, 0, y->count * sizeof *y->thickness);
}

static ff_status build(const ff_host *host, const dynamics_film_history *y, dynamics_excitation *x,
                       dynamics_film_powers *powers)
{
    samples s = {0};
    builder b = {0};
    ff_status status = FF_NOMEM;
    double pitch = y->inputs->pitch, first = (y->roll[0] - y->inputs->roll_sap) / pitch;
    double last = (y->roll[y->count - 1] - y->inputs->roll_sap) / pitch;
    if (cut_at(x, first) && cut_at(x, last) && take_samples(y, x, &s)) {
        dynamics_film_sum mean = mean_of(&s);
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
    x->drags = 1;
    dynamics_excitation_mark_jumps(x);
    report(host, y, &b);
    return FF_OK;
}

ff_status dynamics_film_wire_read(const ff_host *host, const ff_array *in,
                                  const dynamics_film_wire *wire, const dynamics_inputs *inputs,
                                  dynamics_excitation *excitation, dynamics_film_powers *powers)
{
    dynamics_film_history y = {.in_oil = excitation->film != NULL};
    double *nothing = NULL;
    *powers = (dynamics_film_powers){0, NAN};
    if (!dynamics_film_is_wired(in))
        return FF_OK;
    ff_status status = dynamics_refuse_fluctuation(host, &in[DYNAMICS_IN_FLUCTUATION_ORDER],
                                                   "a film that is wired back");
    if (status == FF_OK)
        status = check_gear(host, in, inputs->stations);
    if (status == FF_OK)
        status = dynamics_film_history_read(host, in, inputs, &y);
    if (status == FF_OK) {
        nothing = calloc(y.count, sizeof *nothing);
        status = nothing ? FF_OK : FF_NOMEM;
    }
    if (status == FF_OK) {
        switch_off(wire, &y, nothing);
        status = build(host, &y, excitation, powers);
    }
    free(nothing);
    dynamics_film_history_free(&y);
    return status;
}
