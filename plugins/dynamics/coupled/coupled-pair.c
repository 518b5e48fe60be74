/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "coupled-pair.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Returns atan(t), for small t by its Taylor series. t is about 1e-4 unless the bearings are
   soft. */
static double small_atan(double t)
{
    double squared = t * t;
    if (squared > 1e-6)
        return atan(t);
    return t - t * squared * (1.0 / 3 - squared * (1.0 / 5 - squared / 7));
}

/* Locates the contact from the position of the centres. With the centre distance C: L = sqrt(C^2 -
   (rb1 + rb2)^2) and tan alpha = L/(rb1 + rb2). Changes are computed without cancellation. The half
   gap grows by (rb1 + rb2) times the change of inv alpha = tan alpha - alpha. The contact point on
   a flank of gear 1 moves by the change of alpha, the start of contact by the change of L. */
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
    double wider = small_atan(longer * base / (base * base + line * pair->line));
    double along = pair->centre + rx;
    place->centre = sqrt(base * base + line * line);
    place->turn = along > 0 ? small_atan(ry / along) : atan2(ry, along);
    place->sin_turn = ry / place->centre;
    place->cos_turn = along / place->centre;
    place->sin_angle = line / place->centre;
    place->cos_angle = base / place->centre;
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

/* Returns the stiffness of a tooth pair; it is constant beyond both ends. `near` is the piece used
   last; it is used again if the position is well inside it. */
static double pair_stiffness_at(const dynamics_coupled *pair, double cycle,
                                const dynamics_piece **near)
{
    size_t last = pair->nodes - 1;
    const double *at = pair->cycle, *k = pair->pair_stiffness;
    if (cycle <= at[0])
        return k[0];
    if (cycle >= at[last])
        return k[last];
    double phase = (cycle - at[0]) / (at[last] - at[0]), room = 1e-9;
    if (!*near || phase < (*near)->start + room || phase > (*near)->start + (*near)->length - room)
        *near = dynamics_excitation_piece(&pair->table, phase, 0);
    return dynamics_piece_value((*near)->k, (*near)->degree, phase - (*near)->start);
}

/* Returns the derivative of that stiffness with respect to the mesh cycle. */
static double pair_slope_at(const dynamics_coupled *pair, double cycle)
{
    double from = pair->cycle[0], way = pair->cycle[pair->nodes - 1] - from;
    double phase = (cycle - from) / way;
    if (!(phase > 0 && phase < 1))
        return 0;
    const dynamics_piece *piece = dynamics_excitation_piece(&pair->table, phase, 0);
    return dynamics_piece_slope(piece->k, piece->degree, phase - piece->start) / way;
}

double dynamics_coupled_stiffness_change(const dynamics_coupled *pair, const dynamics_place *place,
                                         double phase, dynamics_pairs now, dynamics_pairs mounted)
{
    double change = 0;
    int from = now.youngest < mounted.youngest ? now.youngest : mounted.youngest,
        to = now.oldest > mounted.oldest ? now.oldest : mounted.oldest;
    for (int j = from; j <= to; j++) {
        const dynamics_piece *near = NULL;
        if (j >= now.youngest && j <= now.oldest)
            change += pair_stiffness_at(pair, phase + j + place->shift, &near);
        if (j >= mounted.youngest && j <= mounted.oldest)
            change -= pair_stiffness_at(pair, phase + j, &near);
    }
    return change;
}

double dynamics_coupled_stiffness_slope(const dynamics_coupled *pair, const dynamics_place *place,
                                        double phase, dynamics_pairs now)
{
    double by_shift = 0;
    for (int j = now.youngest; j <= now.oldest; j++)
        by_shift += pair_slope_at(pair, phase + j + place->shift);
    return by_shift;
}

/* With R = rb1 + rb2 and cos alpha = R/C: d alpha/dC = cos alpha/(C sin alpha), dL/dC = 1/sin
   alpha. */
void dynamics_coupled_shift_slope(const dynamics_coupled *pair, const dynamics_place *place,
                                  double *shift, double *entry)
{
    double wider = place->cos_angle / (place->centre * place->sin_angle);
    double along[DYNAMICS_COORDINATES] = {[DYNAMICS_X1] = -place->cos_turn,
                                          [DYNAMICS_Y1] = -place->sin_turn,
                                          [DYNAMICS_X2] = place->cos_turn,
                                          [DYNAMICS_Y2] = place->sin_turn};
    for (int i = 0; i < DYNAMICS_COORDINATES; i++) {
        shift[i] = wider * pair->base_1 / pair->base_pitch * along[i];
        if (entry)
            entry[i] = along[i] / (place->sin_angle * pair->base_pitch);
    }
}

/* Returns the second derivatives of the overlap. With u along the line of centres and n across it,
   the second derivative of C is n n/C, that of psi is -(u n + n u)/C^2, and d^2b/dC^2 = cos^2
   alpha/(C sin alpha). */
dynamics_bend dynamics_coupled_bend(const dynamics_place *place, int side)
{
    double ux = place->cos_turn, uy = place->sin_turn, sign = side < 0 ? -1 : 1;
    double turn = sign * place->cos_angle / place->centre;
    double opens = side ? 1 / place->centre : 0;
    double along = opens * place->cos_angle * place->cos_angle / place->sin_angle;
    double across = opens * place->sin_angle;
    return (dynamics_bend){.xx = -2 * turn * ux * uy - along * ux * ux - across * uy * uy,
                           .xy = turn * (ux * ux - uy * uy) - (along - across) * ux * uy,
                           .yy = 2 * turn * ux * uy - along * uy * uy - across * ux * ux};
}

void dynamics_bend_apply(const dynamics_bend *bend, const double *change, double *product)
{
    double x = change[DYNAMICS_X2] - change[DYNAMICS_X1],
           y = change[DYNAMICS_Y2] - change[DYNAMICS_Y1];
    product[DYNAMICS_Q] = 0;
    product[DYNAMICS_X2] = bend->xx * x + bend->xy * y;
    product[DYNAMICS_Y2] = bend->xy * x + bend->yy * y;
    product[DYNAMICS_X1] = -product[DYNAMICS_X2];
    product[DYNAMICS_Y1] = -product[DYNAMICS_Y2];
}

/* Returns an overlap with its rate and gradient. With R = rb1 + rb2 the overlaps are q - R psi - e
 * - b, R psi + e - q - b and q - R psi - e. The gradients follow from db/dC = sin alpha and R/C =
 * cos alpha. */
dynamics_overlap dynamics_coupled_overlap(const dynamics_coupled *pair, const dynamics_place *place,
                                          int side, const double *x, const double *v, double e,
                                          double e_rate)
{
    double s = x[DYNAMICS_Q] - pair->base * place->turn, sign = side < 0 ? -1 : 1;
    double opens = side ? place->sin_angle : 0;
    double along = sign * place->cos_angle * place->sin_turn - opens * place->cos_turn;
    double across = -sign * place->cos_angle * place->cos_turn - opens * place->sin_turn;
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

/* Computes the static state: the bearings carry the mesh force, and the driving flank carries the
   load at the stiffness of the mounted pair. The iteration finds the direction of the line of
   action, which turns only slightly. */
void dynamics_coupled_rest(const dynamics_coupled *pair, double *state)
{
    const dynamics_excitation *excitation = pair->excitation;
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
    state[DYNAMICS_Q] = dynamics_rest_bend(excitation) + place.half_gap +
                        excitation->pieces[0].e[0] + pair->base * place.turn;
}

/* Returns the mesh stiffness before (`left`) or after a position of contact. */
static double mesh_stiffness_at(const dynamics_excitation *excitation, double cycle, int left)
{
    double phase = cycle - floor(cycle + 1e-12);
    double at = left && phase < 1e-9 ? phase + 1 : phase;
    const dynamics_piece *piece = dynamics_excitation_piece(excitation, at, left);
    return dynamics_piece_value(piece->k, piece->degree, at - piece->start);
}

static int by_size(const void *a, const void *z)
{
    double x = *(const double *)a, y = *(const double *)z;
    return (x > y) - (x < y);
}

/* Returns whether k jumps or has a corner at the start of a piece. Smooth pieces join without a
   corner. */
static int has_corner(const dynamics_excitation *excitation, size_t i)
{
    const dynamics_piece *p = &excitation->pieces[i];
    const dynamics_piece *before = &excitation->pieces[(i ? i : excitation->count) - 1];
    return p->jump || p->degree == 1 || before->degree == 1;
}

/* Collects the stations and the corners of the mesh stiffness between the ends of contact, in order
   and without duplicates. */
static size_t collect_nodes(const dynamics_excitation *excitation, size_t stations,
                            const double *cycle, double *node)
{
    double end = cycle[stations - 1];
    size_t count = 0, kept = 0;
    for (size_t i = 0; i < stations; i++)
        node[count++] = cycle[i];
    for (size_t i = 0; i < excitation->count; i++)
        for (double at = excitation->pieces[i].start; has_corner(excitation, i) && at < end;
             at += 1)
            node[count++] = at;
    qsort(node, count, sizeof *node, by_size);
    for (size_t i = 0; i < count; i++)
        if (i == 0 || node[i] - node[kept - 1] > 1e-9)
            node[kept++] = node[i];
    return kept;
}

/* Returns the load share at a position between stations. Where it jumps, returns the value before
   (`left`) or after the jump. */
static double share_at(size_t stations, const double *cycle, const double *share, double at,
                       int left)
{
    size_t low = 0, high = stations - 1;
    while (low + 1 < stations && cycle[low + 1] < at - 1e-9)
        low++;
    while (high > low + 1 && cycle[high - 1] > at + 1e-9)
        high--;
    double length = cycle[high] - cycle[low];
    if (high - low > 1) /* several stations are at this position */
        return left ? share[low + 1] : share[high - 1];
    return length > 0 ? share[low] + (share[high] - share[low]) * (at - cycle[low]) / length
                      : share[low];
}

/* Makes the pieces of the stiffness of a tooth pair, from its first to its last contact point. */
static int build_table(dynamics_coupled *pair)
{
    double from = pair->cycle[0], way = pair->cycle[pair->nodes - 1] - from;
    double *phase = malloc(pair->nodes * sizeof *phase);
    dynamics_mesh_curves curves = {pair->nodes, phase, pair->pair_stiffness, NULL};
    pair->table = (dynamics_excitation){.stiffness = 1, .length = 1};
    for (size_t i = 0; phase && i < pair->nodes; i++)
        phase[i] = way > 0 ? (pair->cycle[i] - from) / way : 0;
    int built = phase && dynamics_excitation_build(&pair->table, &curves);
    free(phase);
    return built;
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
        double at = pair->cycle[i], sum = 0;
        /* at both ends of contact the value on the inner side is used */
        int first = i + 1 == pair->nodes, last = i > 0;
        for (int left = first; share && left <= last; left++)
            sum += share_at(stations, cycle, share, at, left) *
                   mesh_stiffness_at(excitation, at, left);
        pair->pair_stiffness[i] = sum / (last - first + 1);
    }
    return build_table(pair);
}

void dynamics_coupled_free(dynamics_coupled *pair)
{
    free(pair->cycle);
    free(pair->pair_stiffness);
    dynamics_excitation_free(&pair->table);
}
