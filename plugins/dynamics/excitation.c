/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "excitation.h"

#include <math.h>
#include <stdlib.h>

/* The relative size below which a jump or a kink of the excitation is round-off. */
static const double round_off = 1e-12;

static double end_value(double value, double rate, double length)
{
    return value + rate * length;
}

/* Whether b carries on the straight lines of a. */
static int continues(const dynamics_piece *a, const dynamics_piece *b)
{
    double length = a->length + b->length;
    return fabs(end_value(a->k, a->k_rate, a->length) - b->k) <= round_off &&
           fabs(end_value(a->e, a->e_rate, a->length) - b->e) <= round_off &&
           fabs(a->k_rate - b->k_rate) * length <= round_off &&
           fabs(a->e_rate - b->e_rate) * length <= round_off;
}

static int jumps(const dynamics_piece *a, const dynamics_piece *b)
{
    return fabs(end_value(a->k, a->k_rate, a->length) - b->k) > round_off ||
           fabs(end_value(a->e, a->e_rate, a->length) - b->e) > round_off;
}

static dynamics_piece piece_between(const dynamics_excitation *excitation,
                                    const dynamics_mesh_curves *x, size_t i)
{
    dynamics_piece p = {.start = x->phase[i], .length = x->phase[i + 1] - x->phase[i]};
    p.k = x->stiffness[i] / excitation->stiffness;
    p.k_rate = (x->stiffness[i + 1] - x->stiffness[i]) / excitation->stiffness / p.length;
    if (x->error) {
        p.e = x->error[i] / excitation->length;
        p.e_rate = (x->error[i + 1] - x->error[i]) / excitation->length / p.length;
    }
    return p;
}

int dynamics_excitation_build(dynamics_excitation *excitation, const dynamics_mesh_curves *x)
{
    excitation->count = 0;
    excitation->k_max = 0;
    excitation->pieces = calloc(x->count, sizeof *excitation->pieces);
    if (!excitation->pieces)
        return 0;
    for (size_t i = 0; i < x->count; i++)
        excitation->k_max = fmax(excitation->k_max, x->stiffness[i] / excitation->stiffness);
    for (size_t i = 0; i + 1 < x->count; i++) {
        /* two phases that differ by round-off mark a jump, too */
        if (x->phase[i + 1] - x->phase[i] <= round_off)
            continue;
        dynamics_piece next = piece_between(excitation, x, i);
        dynamics_piece *last =
            excitation->count ? &excitation->pieces[excitation->count - 1] : NULL;
        if (last && continues(last, &next))
            last->length = x->phase[i + 1] - last->start;
        else
            excitation->pieces[excitation->count++] = next;
    }
    for (size_t i = 0; i < excitation->count; i++)
        excitation->pieces[i].jump =
            jumps(&excitation->pieces[i ? i - 1 : excitation->count - 1], &excitation->pieces[i]);
    return 1;
}

void dynamics_excitation_free(dynamics_excitation *excitation)
{
    free(excitation->pieces);
    excitation->pieces = NULL;
}

const dynamics_piece *dynamics_excitation_piece(const dynamics_excitation *excitation, double phase,
                                                int left)
{
    size_t low = 0, high = excitation->count;
    while (high - low > 1) {
        size_t middle = low + (high - low) / 2;
        double start = excitation->pieces[middle].start;
        if (left ? start < phase - round_off : start <= phase + round_off)
            low = middle;
        else
            high = middle;
    }
    return &excitation->pieces[low];
}

double dynamics_mesh_force(const dynamics_excitation *excitation, double k, double delta,
                           double rate)
{
    double damper = 2 * excitation->zeta * rate, b = excitation->half_gap;
    if (b == 0)
        return k * delta + damper; /* the flanks never part */
    int side = (delta > b) - (delta < -b);
    if (side == 0)
        return excitation->damping == DYNAMICS_DAMPING_ALWAYS ? damper : 0;
    double force = k * (delta - side * b) + damper;
    return excitation->damping == DYNAMICS_DAMPING_CLIPPED && side * force < 0 ? 0 : force;
}

double dynamics_rest_stiffness(const dynamics_excitation *excitation)
{
    return excitation->pieces[0].k > 0 ? excitation->pieces[0].k : 1;
}

double dynamics_rest_deflection(const dynamics_excitation *excitation)
{
    return excitation->half_gap + excitation->load / dynamics_rest_stiffness(excitation);
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
