/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "coupled-pair.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* With the centre distance C, L = sqrt(C^2 - (rb1 + rb2)^2) and tan alpha = L/(rb1 + rb2); the
   changes are written free of cancellation. The half gap opens by (rb1 + rb2) times the change of
   inv alpha = tan alpha - alpha. A flank of gear 1 is met later by the change of alpha, and contact
   begins later by that of L. */
void dynamics_coupled_locate(const dynamics_coupled *pair, const double *x, dynamics_place *place)
{
    *place = (dynamics_place){.centre = pair->centre,
                              .angle = pair->angle,
                              .half_gap = pair->excitation->half_gap,
                              .exit = pair->cycle[pair->nodes - 1]};
    double rx = x[DYNAMICS_X2] - x[DYNAMICS_X1], ry = x[DYNAMICS_Y2] - x[DYNAMICS_Y1];
    double base = pair->base, squares = (2 * pair->centre + rx) * rx + ry * ry;
    double line = sqrt(fmax(pair->line * pair->line + squares, 0));
    double longer = squares / (line + pair->line);
    double wider = atan(longer * base / (base * base + line * pair->line));
    place->centre = sqrt(base * base + line * line);
    place->turn = atan2(ry, pair->centre + rx);
    place->angle = pair->angle + wider;
    place->half_gap += longer - base * wider;
    place->shift = wider * pair->base_1 / pair->base_pitch;
    place->entry = longer / pair->base_pitch;
}

dynamics_pairs dynamics_coupled_pairs(const dynamics_place *place, double phase)
{
    double x = phase + place->shift;
    return (dynamics_pairs){(int)ceil(place->entry - x), (int)floor(place->exit - x)};
}

dynamics_pairs dynamics_coupled_mounted_pairs(const dynamics_coupled *pair, double phase)
{
    return (dynamics_pairs){(int)ceil(-phase), (int)floor(pair->cycle[pair->nodes - 1] - phase)};
}

/* The stiffness of a tooth pair, straight between nodes and constant beyond the ends. */
static double pair_stiffness_at(const dynamics_coupled *pair, double cycle)
{
    size_t low = 0, high = pair->nodes - 1;
    const double *at = pair->cycle, *k = pair->pair_stiffness;
    if (cycle <= at[0])
        return k[0];
    if (cycle >= at[high])
        return k[high];
    while (high - low > 1) {
        size_t middle = low + (high - low) / 2;
        if (at[middle] <= cycle)
            low = middle;
        else
            high = middle;
    }
    return k[low] + (k[high] - k[low]) * (cycle - at[low]) / (at[high] - at[low]);
}

double dynamics_coupled_stiffness_change(const dynamics_coupled *pair, const dynamics_place *place,
                                         double phase, dynamics_pairs now, dynamics_pairs mounted)
{
    double change = 0;
    for (int j = now.youngest; j <= now.oldest; j++)
        change += pair_stiffness_at(pair, phase + j + place->shift);
    for (int j = mounted.youngest; j <= mounted.oldest; j++)
        change -= pair_stiffness_at(pair, phase + j);
    return change;
}

/* With R = rb1 + rb2, the overlaps are q - R psi - e - b, R psi + e - q - b and q - R psi - e.
   Their gradients follow from db/dC = sin alpha and R/C = cos alpha. */
dynamics_overlap dynamics_coupled_overlap(const dynamics_coupled *pair, const dynamics_place *place,
                                          int side, const double *x, const double *v, double e,
                                          double e_rate)
{
    double s = x[DYNAMICS_Q] - pair->base * place->turn, alpha = place->angle, psi = place->turn;
    double sign = side < 0 ? -1 : 1;
    double along = sign * cos(alpha) * sin(psi) - (side ? sin(alpha) * cos(psi) : 0);
    double across = -sign * cos(alpha) * cos(psi) - (side ? sin(alpha) * sin(psi) : 0);
    dynamics_overlap o = {.value = sign * (s - e) - (side ? place->half_gap : 0),
                          .rate = -sign * e_rate,
                          .gradient = {[DYNAMICS_Q] = sign,
                                       [DYNAMICS_X1] = -along,
                                       [DYNAMICS_Y1] = -across,
                                       [DYNAMICS_X2] = along,
                                       [DYNAMICS_Y2] = across}};
    for (int i = 0; i < DYNAMICS_COORDINATES; i++)
        o.rate += o.gradient[i] * v[i];
    return o;
}

/* The bearings carry the mesh force, and the driving flank the load at the stiffness of the mounted
   pair. The iteration finds the line of action, which turns little. */
void dynamics_coupled_rest(const dynamics_coupled *pair, double *state)
{
    const dynamics_excitation *excitation = pair->excitation;
    double k = dynamics_rest_stiffness(excitation);
    dynamics_place place;
    memset(state, 0, 2 * DYNAMICS_COORDINATES * sizeof *state);
    for (int i = 0; i < 20; i++) {
        dynamics_coupled_locate(pair, state, &place);
        double along = sin(place.angle - place.turn), across = cos(place.angle - place.turn);
        for (int gear = 0; gear < 2; gear++) {
            double moved = (gear ? 1 : -1) * excitation->load / pair->bearing[gear];
            state[gear ? DYNAMICS_X2 : DYNAMICS_X1] = moved * along;
            state[gear ? DYNAMICS_Y2 : DYNAMICS_Y1] = moved * across;
        }
    }
    dynamics_coupled_locate(pair, state, &place);
    state[DYNAMICS_Q] = excitation->load / k + place.half_gap + excitation->pieces[0].e[0] +
                        pair->base * place.turn;
}

/* The mesh stiffness at a place of contact: the mean of the values before and behind it, or one of
 * them. */
static double mesh_stiffness_at(const dynamics_excitation *excitation, double cycle, int first,
                                int last)
{
    double phase = cycle - floor(cycle + 1e-12), sum = 0;
    for (int left = first; left <= last; left++) {
        double at = left && phase < 1e-9 ? phase + 1 : phase;
        const dynamics_piece *piece = dynamics_excitation_piece(excitation, at, left);
        sum += dynamics_piece_value(piece->k, piece->degree, at - piece->start);
    }
    return sum / (last - first + 1);
}

static int by_size(const void *a, const void *z)
{
    double x = *(const double *)a, y = *(const double *)z;
    return (x > y) - (x < y);
}

/* Collects the stations and the nodes of the mesh between the ends of contact, in order and each
 * once. */
static size_t collect_nodes(const dynamics_excitation *excitation, size_t stations,
                            const double *cycle, double *node)
{
    double end = cycle[stations - 1];
    size_t count = 0, kept = 0;
    for (size_t i = 0; i < stations; i++)
        node[count++] = cycle[i];
    for (size_t i = 0; i < excitation->count; i++)
        for (double at = excitation->pieces[i].start; at < end; at += 1)
            node[count++] = at;
    qsort(node, count, sizeof *node, by_size);
    for (size_t i = 0; i < count; i++)
        if (i == 0 || node[i] - node[kept - 1] > 1e-9)
            node[kept++] = node[i];
    return kept;
}

/* The share between stations; where it jumps, the mean of both values. */
static double share_at(size_t stations, const double *cycle, const double *share, double at)
{
    size_t low = 0, high = stations - 1;
    while (low + 1 < stations && cycle[low + 1] < at - 1e-9)
        low++;
    while (high > low + 1 && cycle[high - 1] > at + 1e-9)
        high--;
    double length = cycle[high] - cycle[low];
    if (high - low > 1) /* stations at this place */
        return 0.5 * (share[low + 1] + share[high - 1]);
    return length > 0 ? share[low] + (share[high] - share[low]) * (at - cycle[low]) / length
                      : share[low];
}

int dynamics_coupled_pair_stiffness(dynamics_coupled *pair, size_t stations, const double *cycle,
                                    const double *share)
{
    const dynamics_excitation *excitation = pair->excitation;
    size_t most = stations + excitation->count * (size_t)(ceil(cycle[stations - 1]) + 1);
    pair->cycle = calloc(most, sizeof *pair->cycle);
    pair->pair_stiffness = calloc(most, sizeof *pair->pair_stiffness);
    if (!pair->cycle || !pair->pair_stiffness)
        return 0;
    pair->nodes = collect_nodes(excitation, stations, cycle, pair->cycle);
    for (size_t i = 0; i < pair->nodes; i++) {
        double at = pair->cycle[i], part = share ? share_at(stations, cycle, share, at) : 0;
        int first = i + 1 == pair->nodes, last = i > 0; /* from inside at the ends of contact */
        pair->pair_stiffness[i] = part * mesh_stiffness_at(excitation, at, first, last);
    }
    return 1;
}

void dynamics_coupled_free(dynamics_coupled *pair)
{
    free(pair->cycle);
    free(pair->pair_stiffness);
}
