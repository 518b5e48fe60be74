/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "excitation.h"

#include "smooth-piece.h"
#include "spring.h"
#include "tracks.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>

/* A jump or a kink of the excitation below this relative size is round-off. */
static const double round_off = 1e-12;

static double end_value(const dynamics_piece *p, const double *c)
{
    return dynamics_piece_value(c, p->degree, p->length);
}

static int meets(const dynamics_piece *a, const double *end, const double *start)
{
    return fabs(end_value(a, end) - start[0]) <= round_off;
}

static int has_slope_of(const double *a, const double *b, double length)
{
    return fabs(a[1] - b[1]) * length <= round_off;
}

static int jumps(const dynamics_piece *a, const dynamics_piece *b)
{
    if (!meets(a, a->k, b->k) || !meets(a, a->e, b->e))
        return 1;
    for (int i = 0; i < a->lines; i++)
        if (!meets(a, a->line[i].slope, b->line[i].slope) ||
            !meets(a, a->line[i].offset, b->line[i].offset))
            return 1;
    return 0;
}

/* Returns whether piece b continues the straight lines of piece a without a kink. */
static int continues(const dynamics_piece *a, const dynamics_piece *b)
{
    double length = a->length + b->length;
    if (a->degree != 1 || b->degree != 1 || jumps(a, b) || !has_slope_of(a->k, b->k, length) ||
        !has_slope_of(a->e, b->e, length))
        return 0;
    for (int i = 0; i < a->lines; i++)
        if (!has_slope_of(a->line[i].slope, b->line[i].slope, length) ||
            !has_slope_of(a->line[i].offset, b->line[i].offset, length))
            return 0;
    return 1;
}

static void set_line(double *c, const double *value, size_t i, double unit, double length)
{
    c[0] = value[i] / unit;
    c[1] = (value[i + 1] - value[i]) / unit / length;
}

static dynamics_piece piece_between(const dynamics_excitation *excitation,
                                    const dynamics_mesh_curves *x,
                                    const dynamics_spring_nodes *spring, size_t i)
{
    dynamics_piece p = {.start = x->phase[i], .length = x->phase[i + 1] - x->phase[i], .degree = 1};
    double unit = excitation->stiffness;
    set_line(p.k, x->stiffness, i, unit, p.length);
    if (x->error)
        set_line(p.e, x->error, i, excitation->length, p.length);
    p.lines = spring ? (int)spring->lines : 0;
    for (int k = 0; k < p.lines; k++) {
        const dynamics_spring_row row = dynamics_spring_row_of(spring, (size_t)k);
        set_line(p.line[k].slope, row.slope, i, unit, p.length);
        set_line(p.line[k].offset, row.offset, i, unit * excitation->length, p.length);
    }
    return p;
}

/* Two phases that differ only by round-off also mark a jump. */
static int is_jump(const dynamics_mesh_curves *x, size_t i)
{
    return x->phase[i + 1] - x->phase[i] <= round_off;
}

/* Adds the straight lines between the nodes `first` and `last`. No curve jumps between these
   nodes. */
static void add_stretch(dynamics_excitation *excitation, const dynamics_mesh_curves *x,
                        const dynamics_spring_nodes *spring, size_t first, size_t last)
{
    for (size_t i = first; i < last;) {
        dynamics_piece next;
        size_t to =
            dynamics_smooth_piece(excitation, x, spring, i, last, &next, &excitation->represented);
        if (!to) {
            next = piece_between(excitation, x, spring, i);
            to = i + 1;
        }
        dynamics_piece *before =
            excitation->count ? &excitation->pieces[excitation->count - 1] : NULL;
        excitation->represented.lines += to - i;
        if (before && continues(before, &next))
            before->length = x->phase[to] - before->start;
        else
            excitation->pieces[excitation->count++] = next;
        i = to;
    }
}

void dynamics_excitation_mark_jumps(dynamics_excitation *excitation)
{
    for (size_t i = 0; i < excitation->count; i++)
        excitation->pieces[i].jump =
            jumps(&excitation->pieces[i ? i - 1 : excitation->count - 1], &excitation->pieces[i]);
}

static double steepest(const dynamics_mesh_curves *x, const dynamics_spring_nodes *spring, size_t i)
{
    return spring
               ? fmax(x->stiffness[i], dynamics_spring_row_of(spring, spring->lines - 1).slope[i])
               : x->stiffness[i];
}

int dynamics_excitation_build_bent(dynamics_excitation *excitation,
                                   const dynamics_mesh_curves *curves,
                                   const dynamics_spring_nodes *spring)
{
    dynamics_mesh_curves with_slope = *curves, *x = &with_slope;
    if (spring && spring->stiffness)
        x->stiffness = spring->stiffness;
    if (spring && !spring->lines)
        spring = NULL;
    excitation->count = 0;
    excitation->k_max = 0;
    excitation->represented = (dynamics_representation){0};
    excitation->pieces = calloc(x->count, sizeof *excitation->pieces);
    if (!excitation->pieces)
        return 0;
    for (size_t i = 0; i < x->count; i++)
        excitation->k_max = fmax(excitation->k_max, steepest(x, spring, i) / excitation->stiffness);
    for (size_t first = 0, i = 0; i + 1 < x->count; i++) {
        int ends = i + 2 == x->count || is_jump(x, i + 1);
        if (is_jump(x, i)) {
            first = i + 1;
        } else if (ends) {
            add_stretch(excitation, x, spring, first, i + 1);
            first = i + 1;
        }
    }
    dynamics_excitation_mark_jumps(excitation);
    excitation->represented.pieces = excitation->count;
    return 1;
}

int dynamics_excitation_build(dynamics_excitation *excitation, const dynamics_mesh_curves *curves)
{
    return dynamics_excitation_build_bent(excitation, curves, NULL);
}

void dynamics_excitation_free(dynamics_excitation *excitation)
{
    free(excitation->pieces);
    free(excitation->back.pieces);
    free(excitation->flight.pieces);
    excitation->pieces = NULL;
    excitation->back = excitation->flight = (dynamics_track){NULL, 0};
}

const dynamics_piece *dynamics_track_piece(dynamics_track track, double phase, int left)
{
    assert(track.count > 0);
    size_t low = 0, high = track.count;
    while (high - low > 1) {
        size_t middle = low + (high - low) / 2;
        double start = track.pieces[middle].start;
        if (left ? start < phase - round_off : start <= phase + round_off)
            low = middle;
        else
            high = middle;
    }
    return &track.pieces[low];
}

const dynamics_piece *dynamics_excitation_piece(const dynamics_excitation *excitation, double phase,
                                                int left)
{
    return dynamics_track_piece(dynamics_track_of(excitation, 1), phase, left);
}

const dynamics_piece *dynamics_excitation_piece_at(const dynamics_excitation *x, double phase,
                                                   int left, double s)
{
    const dynamics_piece *driving = dynamics_excitation_piece(x, phase, left), *piece;
    if (!dynamics_tracks_differ(x))
        return driving;
    piece = dynamics_track_piece(x->back, phase, left);
    if (s - dynamics_piece_value(piece->e, piece->degree, phase - piece->start) < -x->half_gap)
        return piece;
    if (!x->flight.count ||
        s - dynamics_piece_value(driving->e, driving->degree, phase - driving->start) > x->half_gap)
        return driving;
    return dynamics_track_piece(x->flight, phase, left);
}

/* Returns the flank that touches at delta: 1 or -1; 0 if no flank touches, or if it belongs to
   another track. */
static int side_at(const dynamics_excitation *x, const dynamics_piece *piece, double delta)
{
    int side = (delta > x->half_gap) - (delta < -x->half_gap);
    if (side == 0 || !dynamics_tracks_differ(x))
        return side;
    return dynamics_track_holds(dynamics_track_of(x, side), piece) ? side : 0;
}

double dynamics_mesh_force(const dynamics_excitation *excitation, const dynamics_piece *piece,
                           double since, double delta, double rate)
{
    double damper = 2 * excitation->zeta * rate, b = excitation->half_gap;
    if (b == 0)
        /* no gap: the flanks never separate */
        return dynamics_spring_force(piece, since, delta) + damper;
    int side = side_at(excitation, piece, delta);
    if (side == 0)
        return excitation->damping == DYNAMICS_DAMPING_ALWAYS ? damper : 0;
    double force = dynamics_spring_force(piece, since, delta - side * b) + damper;
    return excitation->damping == DYNAMICS_DAMPING_CLIPPED && side * force < 0 ? 0 : force;
}

double dynamics_rest_bend(const dynamics_excitation *excitation)
{
    const dynamics_piece *first = excitation->pieces;
    double k = first->k[0] > 0 ? first->k[0] : 1, bend = excitation->load / k;
    for (int i = 0; i < first->lines; i++) {
        double there = (excitation->load + first->line[i].offset[0]) / first->line[i].slope[0];
        bend = i ? fmin(bend, there) : there;
    }
    return bend;
}

double dynamics_rest_deflection(const dynamics_excitation *excitation)
{
    return excitation->half_gap + dynamics_rest_bend(excitation);
}

double dynamics_amplitude_cap(const dynamics_excitation *excitation)
{
    static const double amplitude_cap = 1000;
    return amplitude_cap * (excitation->half_gap + excitation->load + 1);
}

int dynamics_is_unbounded(const dynamics_excitation *excitation, double delta, double rate)
{
    double cap = dynamics_amplitude_cap(excitation);
    return !(fabs(delta) < cap && fabs(rate) < cap);
}
