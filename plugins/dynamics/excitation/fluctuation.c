/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "fluctuation.h"

#include "inputs.h"
#include "smooth-piece.h"
#include "tracks.h"

#include <flankfilm/author.h>

#include <math.h>
#include <stdlib.h>

/* Largest angle (rad) through which an order may turn within one piece. A polynomial of degree 7
   then approximates its cosine within 0.25^8/(2^7 8!) = 3e-12. */
static const double longest_part = 0.5;

/* MOST_TURNS: largest number of turns of an order per mesh cycle */
enum { SAMPLES = 32, MOST_CYCLES = 4096, MOST_TURNS = 64 };

static const char *name_of(int input)
{
    return dynamics_input_ports[input].name;
}

static size_t orders_of(const ff_array *order)
{
    return order->rank == 1 ? order->shape[0] : 0;
}

ff_status dynamics_fluctuation_read(const ff_host *host, const ff_array *in, double teeth,
                                    dynamics_fluctuation *f, size_t *span)
{
    const ff_array *order = &in[DYNAMICS_IN_FLUCTUATION_ORDER];
    *f = (dynamics_fluctuation){.teeth = teeth, .count = orders_of(order)};
    *span = 1;
    if (f->count == 0)
        return FF_OK;
    for (int i = DYNAMICS_IN_FLUCTUATION_COSINE; i <= DYNAMICS_IN_FLUCTUATION_SINE; i++)
        if (!in[i].data || in[i].rank != 1 || in[i].shape[0] != f->count)
            return ff_failf(host, FF_INVALID, name_of(i),
                            "must have one value for each of the %zu orders", f->count);
    f->order = order->data;
    f->cosine = in[DYNAMICS_IN_FLUCTUATION_COSINE].data;
    f->sine = in[DYNAMICS_IN_FLUCTUATION_SINE].data;
    const double *period = in[DYNAMICS_IN_FLUCTUATION_PERIOD].data;
    if (!period || !(*period >= 1 && *period <= MOST_CYCLES && *period == floor(*period)))
        return ff_failf(host, FF_INVALID, name_of(DYNAMICS_IN_FLUCTUATION_PERIOD),
                        "must be a whole number of mesh cycles, at most %d", MOST_CYCLES);
    *span = (size_t)*period;
    for (size_t i = 0; i < f->count; i++) {
        double turns = f->order[i] / teeth * *period;
        if (!isfinite(f->cosine[i]) || !isfinite(f->sine[i]) || f->order[i] > MOST_TURNS * teeth)
            return ff_failf(host, FF_INVALID, name_of(DYNAMICS_IN_FLUCTUATION_ORDER),
                            "order %g must have finite amplitudes and at most %d turns per mesh "
                            "cycle",
                            f->order[i], MOST_TURNS);
        if (!(f->order[i] > 0 && fabs(turns - round(turns)) <= 1e-9 * turns))
            return ff_failf(host, FF_INVALID, name_of(DYNAMICS_IN_FLUCTUATION_ORDER),
                            "order %g of a gear of %g teeth does not repeat after %g mesh cycles",
                            f->order[i], teeth, *period);
    }
    return FF_OK;
}

ff_status dynamics_refuse_fluctuation(const ff_host *host, const ff_array *order, const char *what)
{
    return orders_of(order) == 0
               ? FF_OK
               : ff_failf(
                     host, FF_UNSUPPORTED, name_of(DYNAMICS_IN_FLUCTUATION_ORDER),
                     "torque or speed fluctuate, but %s needs a motion that repeats every mesh "
                     "cycle: use dynamics/shooting or dynamics/time-integration, without a film "
                     "wired back",
                     what);
}

double dynamics_fluctuation_size(const dynamics_fluctuation *f)
{
    double size = 0;
    for (size_t i = 0; i < f->count; i++)
        size += hypot(f->cosine[i], f->sine[i]);
    return size;
}

static double force_at(const dynamics_fluctuation *f, double cycles)
{
    double force = 0;
    for (size_t i = 0; i < f->count; i++) {
        double a = 2 * M_PI * f->order[i] / f->teeth * cycles;
        force += f->cosine[i] * cos(a) + f->sine[i] * sin(a);
    }
    return force;
}

static size_t parts_of(const dynamics_fluctuation *f, const dynamics_piece *p)
{
    double fastest = 0;
    for (size_t i = 0; i < f->count; i++)
        fastest = fmax(fastest, 2 * M_PI * f->order[i] / f->teeth);
    return (size_t)fmax(ceil(fastest * p->length / longest_part), 1);
}

/* Sets the drag of a piece that starts `begin` mesh cycles after the start of the period and is
   `length` mesh cycles long. */
static void set_drag(const dynamics_excitation *x, const dynamics_fluctuation *f, double begin,
                     double length, dynamics_piece *p)
{
    double phase[SAMPLES + 1], value[SAMPLES + 1], newton = x->stiffness * x->length;
    double unit = dynamics_fluctuation_size(f) / newton;
    for (int i = 0; i <= SAMPLES; i++) {
        double part = (double)i / SAMPLES;
        phase[i] = part * p->length;
        value[i] = -force_at(f, begin + part * length) / newton;
    }
    if (!(unit > 0))
        return;
    dynamics_smooth_series(phase, value, SAMPLES + 1, unit, p->drag);
    for (int i = 0; i <= DYNAMICS_DEGREE; i++)
        p->drag[i] *= unit;
}

/* Copies a part of a piece of the mesh cycle. The phases of `to` are relative to the period of
   `span` mesh cycles. */
static void set_part(const dynamics_piece *from, double since, double span, dynamics_piece *to)
{
    to->degree = DYNAMICS_DEGREE;
    dynamics_piece_shift(from->k, from->degree, since, span, to->k);
    dynamics_piece_shift(from->e, from->degree, since, span, to->e);
    to->lines = from->lines;
    for (int i = 0; i < from->lines; i++) {
        dynamics_piece_shift(from->line[i].slope, from->degree, since, span, to->line[i].slope);
        dynamics_piece_shift(from->line[i].offset, from->degree, since, span, to->line[i].offset);
    }
}

/* Repeats the pieces of a track for `span` mesh cycles, with the drag of the fluctuation. Returns 0
   if out of memory. */
static int repeat_track(const dynamics_excitation *x, const dynamics_fluctuation *f, size_t span,
                        dynamics_track *track)
{
    size_t count = 0, n = 0;
    for (size_t i = 0; i < track->count; i++)
        count += span * parts_of(f, &track->pieces[i]);
    dynamics_piece *pieces = calloc(count + 1, sizeof *pieces);
    if (!pieces)
        return 0;
    for (size_t cycle = 0; cycle < span; cycle++)
        for (size_t i = 0; i < track->count; i++) {
            const dynamics_piece *from = &track->pieces[i];
            const size_t parts = parts_of(f, from);
            const double length = from->length / (double)parts;
            for (size_t k = 0; k < parts; k++, n++) {
                const double since = length * (double)k,
                             begin = (double)cycle + from->start + since;
                pieces[n].start = begin / (double)span;
                pieces[n].length = length / (double)span;
                pieces[n].jump = k == 0 && from->jump;
                set_part(from, since, (double)span, &pieces[n]);
                set_drag(x, f, begin, length, &pieces[n]);
            }
        }
    free(track->pieces);
    *track = (dynamics_track){pieces, count};
    return 1;
}

int dynamics_excitation_fluctuate(dynamics_excitation *x, const dynamics_fluctuation *f,
                                  size_t span)
{
    dynamics_track driving = {x->pieces, x->count};
    const int made = repeat_track(x, f, span, &driving);
    x->pieces = driving.pieces;
    x->count = driving.count;
    if (!made || (x->back.count && !repeat_track(x, f, span, &x->back)) ||
        (x->flight.count && !repeat_track(x, f, span, &x->flight)))
        return 0;
    x->span = (double)span;
    x->drags = 1;
    dynamics_excitation_mark_jumps(x);
    return 1;
}
