/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Curves of the back flanks over the phase of the driving flanks. */
#include "back-flank.h"

#include "outputs.h"

#include <flankfilm/author.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Returns the tooth thickness on the working pitch circle over the pitch. */
static double thickness(const stiffness_gear *g, double working)
{
    double reference = acos(g->base_radius / g->reference_radius);
    double involutes = tan(reference) - reference - tan(working) + working;
    double angle = g->full_thickness / g->reference_radius + 2 * involutes;
    return angle * g->teeth / (2 * M_PI);
}

double stiffness_back_offset(const stiffness_gears *g)
{
    double tangent = g->tangent_length / (g->gear[0].base_radius + g->gear[1].base_radius);
    double pitch_point = (tangent - g->roll_sap) / g->pitch, working = atan(tangent);
    double share = 0.5 * (1 + thickness(&g->gear[0], working) - thickness(&g->gear[1], working));
    double offset = 2 * pitch_point + share;
    return offset - floor(offset);
}

/* A node of a mirrored curve, at `phase` of the driving flanks. Its value lies between the nodes
   `low` and `low` + 1 of the flank, at the fraction `part` of the interval. */
typedef struct node {
    double phase;
    size_t low;
    double part;
} node;

/* Adds the nodes of the flank from phase `to` down to phase `from`; the phase of each new node is
   `shift` minus the phase of the flank. */
static size_t add_falling(const stiffness_cycle *c, double from, double to, double shift,
                          node *nodes)
{
    size_t n = 0;
    for (size_t i = c->count; i-- > 0;)
        if (c->phase[i] > from + STIFFNESS_PHASE_TOLERANCE &&
            c->phase[i] < to - STIFFNESS_PHASE_TOLERANCE)
            nodes[n++] = (node){shift - c->phase[i], i, 0};
    return n;
}

/* Returns the node at a phase of the flank, as the limit from below or from above. */
static node node_at(const stiffness_cycle *c, double phase, int side)
{
    size_t i = 0;
    if (side == STIFFNESS_BELOW)
        while (i + 1 < c->count && c->phase[i] < phase - STIFFNESS_PHASE_TOLERANCE)
            i++;
    else {
        i = c->count - 1;
        while (i > 0 && c->phase[i] > phase + STIFFNESS_PHASE_TOLERANCE)
            i--;
    }
    if (fabs(c->phase[i] - phase) <= STIFFNESS_PHASE_TOLERANCE)
        return (node){0, i, 0};
    if (side == STIFFNESS_BELOW)
        i--;
    return (node){0, i, (phase - c->phase[i]) / (c->phase[i + 1] - c->phase[i])};
}

/* Lists the nodes over the phase of the driving flanks, from 0 to 1. At the phase `offset` there
   are two nodes: phase 0 and phase 1 of the flank. */
static size_t list_nodes(const stiffness_cycle *c, double offset, node *nodes)
{
    const int whole =
        offset <= STIFFNESS_PHASE_TOLERANCE || offset >= 1 - STIFFNESS_PHASE_TOLERANCE;
    size_t n = 0;
    if (whole) {
        nodes[n++] = (node){0, c->count - 1, 0};
        n += add_falling(c, 0, 1, 1, nodes + n);
        nodes[n++] = (node){1, 0, 0};
        return n;
    }
    nodes[n++] = node_at(c, offset, STIFFNESS_BELOW);
    n += add_falling(c, 0, offset, offset, nodes + n);
    nodes[n++] = (node){offset, 0, 0};
    nodes[n++] = (node){offset, c->count - 1, 0};
    n += add_falling(c, offset, 1, offset + 1, nodes + n);
    nodes[n] = node_at(c, offset, STIFFNESS_ABOVE);
    nodes[n++].phase = 1;
    return n;
}

static void put_values(const node *nodes, size_t count, const double *value, double *to)
{
    for (size_t i = 0; i < count; i++) {
        const double *low = value + nodes[i].low;
        to[i] = nodes[i].part > 0 ? low[0] + nodes[i].part * (low[1] - low[0]) : low[0];
    }
}

static ff_status put_flank(const ff_host *host, const stiffness_flank *f, const node *nodes,
                           size_t count, size_t stations)
{
    const stiffness_level_rows *l = &f->levels;
    const size_t phases[] = {l->count, count}, teeth[] = {l->count, stations};
    double *phase = ff_put_series(host, STIFFNESS_OUT_BACK_PHASE, count);
    double *curves[] = {ff_put_series(host, STIFFNESS_OUT_BACK_STIFFNESS, count),
                        ff_put_series(host, STIFFNESS_OUT_BACK_ERROR, count),
                        ff_put_series(host, STIFFNESS_OUT_BACK_LOADED_ERROR, count)};
    double *levels[] = {host->output(host->ctx, STIFFNESS_OUT_BACK_LEVEL_ERROR, 2, phases),
                        host->output(host->ctx, STIFFNESS_OUT_BACK_LEVEL_STIFFNESS, 2, phases)};
    double *force = host->output(host->ctx, STIFFNESS_OUT_BACK_LEVEL_TOOTH_FORCE, 2, teeth);
    const double *const values[] = {f->stiffness, f->error, f->loaded};
    const double *const rows[] = {l->error, l->stiffness};
    if (count == 0)
        return FF_OK;
    if (!phase || !curves[0] || !curves[1] || !curves[2] || !levels[0] || !levels[1] || !force)
        return FF_NOMEM;
    for (size_t i = 0; i < count; i++)
        phase[i] = nodes[i].phase;
    for (int k = 0; k < 3; k++)
        put_values(nodes, count, values[k], curves[k]);
    for (size_t k = 0; k < 2 * l->count; k++)
        put_values(nodes, count, rows[k % 2] + k / 2 * f->cycle->count,
                   levels[k % 2] + k / 2 * count);
    memcpy(force, l->teeth, l->count * stations * sizeof *force);
    return FF_OK;
}

ff_status stiffness_back_publish(const ff_host *host, const stiffness_gears *gears,
                                 const stiffness_flank *flank, size_t stations)
{
    static const stiffness_flank none = {0};
    double offset = stiffness_back_offset(gears);
    ff_status status = ff_put_scalar(host, STIFFNESS_OUT_BACK_OFFSET, offset);
    if (status != FF_OK || !flank)
        return status == FF_OK ? put_flank(host, &none, NULL, 0, stations) : status;
    node *nodes = malloc((flank->cycle->count + 4) * sizeof *nodes);
    if (!nodes)
        return FF_NOMEM;
    size_t count = list_nodes(flank->cycle, offset, nodes);
    status = put_flank(host, flank, nodes, count, stations);
    free(nodes);
    return status;
}
