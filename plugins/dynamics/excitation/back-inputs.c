/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "back-inputs.h"

#include "tracks.h"

#include <math.h>
#include <stdio.h>

static const char *name_of(int input)
{
    return dynamics_input_ports[input].name;
}

static size_t length_of(const ff_array *a)
{
    return a->data && a->rank == 1 ? a->shape[0] : 0;
}

static ff_status check_rows(const ff_host *host, const ff_array *in, int input, size_t rows,
                            size_t columns)
{
    const ff_array *a = &in[input];
    if (!a->data || (a->rank == 2 && a->shape[0] == rows && a->shape[1] == columns))
        return FF_OK;
    return ff_failf(host, FF_INVALID, name_of(input), "must be %zu rows of %zu values", rows,
                    columns);
}

static ff_status check_phases(const ff_host *host, const ff_array *in, size_t count)
{
    const double *phase = in[DYNAMICS_IN_BACK_PHASE].data, *k = in[DYNAMICS_IN_BACK_STIFFNESS].data;
    for (int input = DYNAMICS_IN_BACK_STIFFNESS; input <= DYNAMICS_IN_BACK_LOADED_ERROR; input++)
        if (in[input].data ? length_of(&in[input]) != count : input == DYNAMICS_IN_BACK_STIFFNESS)
            return ff_failf(host, FF_INVALID, name_of(input), "must be a series of %zu values",
                            count);
    if (fabs(phase[0]) > 1e-9 || fabs(phase[count - 1] - 1) > 1e-9)
        return ff_failf(host, FF_INVALID, name_of(DYNAMICS_IN_BACK_PHASE),
                        "must run from 0 to 1, not from %g to %g", phase[0], phase[count - 1]);
    for (size_t i = 0; i < count; i++) {
        if (i > 0 && phase[i] < phase[i - 1])
            return ff_failf(host, FF_INVALID, name_of(DYNAMICS_IN_BACK_PHASE),
                            "must not decrease, but %g follows %g", phase[i], phase[i - 1]);
        if (!(k[i] >= 0))
            return ff_failf(host, FF_INVALID, name_of(DYNAMICS_IN_BACK_STIFFNESS),
                            "must not be negative, but is %g N/m at phase %g", k[i], phase[i]);
    }
    return FF_OK;
}

static ff_status check_levels(const ff_host *host, const dynamics_force_levels *l)
{
    if (!l->error || l->count < 2)
        return ff_failf(host, FF_INVALID, name_of(DYNAMICS_IN_BACK_LEVEL_ERROR),
                        "force: shared needs the transmission error of both flanks under several "
                        "forces; use force: frozen");
    for (size_t i = l->phases; i < l->count * l->phases; i++)
        if (!(l->error[i] > l->error[i - l->phases]) || (l->stiffness && !(l->stiffness[i] > 0)))
            return ff_failf(host, FF_INVALID, name_of(DYNAMICS_IN_BACK_LEVEL_ERROR),
                            "must increase with the force, with slopes above 0");
    return FF_OK;
}

static ff_status read_levels(const ff_host *host, const ff_array *in, dynamics_inputs *inputs)
{
    const dynamics_force_levels *driving = &inputs->levels;
    dynamics_force_levels *l = &inputs->back_levels;
    const size_t count = length_of(&in[DYNAMICS_IN_BACK_PHASE]);
    *l = (dynamics_force_levels){.count = driving->count,
                                 .phases = count,
                                 .stations = driving->stations,
                                 .force = driving->force,
                                 .error = in[DYNAMICS_IN_BACK_LEVEL_ERROR].data,
                                 .stiffness = in[DYNAMICS_IN_BACK_LEVEL_STIFFNESS].data,
                                 .tooth_force = in[DYNAMICS_IN_BACK_LEVEL_TOOTH_FORCE].data};
    ff_status status = check_rows(host, in, DYNAMICS_IN_BACK_LEVEL_ERROR, l->count, count);
    if (status == FF_OK)
        status = check_rows(host, in, DYNAMICS_IN_BACK_LEVEL_STIFFNESS, l->count, count);
    if (status == FF_OK)
        status = check_rows(host, in, DYNAMICS_IN_BACK_LEVEL_TOOTH_FORCE, l->count, l->stations);
    return status;
}

static ff_status make_spring(const ff_host *host, const ff_array *in, const dynamics_inputs *inputs,
                             const dynamics_excitation *excitation,
                             const dynamics_mesh_curves *curves, dynamics_spring_nodes *spring)
{
    double convex;
    if (!excitation->shared)
        return dynamics_spring_nodes_make(curves, in[DYNAMICS_IN_BACK_LOADED_ERROR].data,
                                          inputs->reference, excitation->on_chord, spring)
                   ? FF_OK
                   : FF_NOMEM;
    ff_status status = check_levels(host, &inputs->back_levels);
    if (status != FF_OK)
        return status;
    return dynamics_spring_nodes_share(&inputs->back_levels, inputs->reference, 1, spring, &convex)
               ? FF_OK
               : FF_NOMEM;
}

static int is_constant(const dynamics_mesh_curves *c)
{
    for (size_t i = 0; i < c->count; i++)
        if (c->stiffness[i] != c->stiffness[0] || (c->error && c->error[i] != 0))
            return 0;
    return 1;
}

ff_status dynamics_back_inputs_read(const ff_host *host, const ff_array *in,
                                    dynamics_inputs *inputs, dynamics_excitation *excitation)
{
    const size_t count = length_of(&in[DYNAMICS_IN_BACK_PHASE]);
    const dynamics_mesh_curves curves = {
        .count = count,
        .phase = in[DYNAMICS_IN_BACK_PHASE].data,
        .stiffness = in[DYNAMICS_IN_BACK_STIFFNESS].data,
        .error = in[DYNAMICS_IN_BACK_ERROR].data,
    };
    dynamics_spring_nodes spring = {0};
    inputs->back_offset = NAN;
    inputs->constant = is_constant(&inputs->curves);
    if (count < 2 || !in[DYNAMICS_IN_BACK_OFFSET].data)
        return FF_OK;
    inputs->back_offset = in[DYNAMICS_IN_BACK_OFFSET].data[0];
    if (!excitation->both_flanks || excitation->half_gap == 0)
        return FF_OK;
    ff_status status = check_phases(host, in, count);
    if (status == FF_OK)
        status = read_levels(host, in, inputs);
    if (status == FF_OK)
        status = make_spring(host, in, inputs, excitation, &curves, &spring);
    if (status != FF_OK)
        return status;
    int made = dynamics_tracks_add_back(excitation, &curves,
                                        spring.stiffness || spring.rows ? &spring : NULL);
    dynamics_spring_nodes_free(&spring);
    const double swing = dynamics_fluctuation_size(&inputs->fluctuation);
    if (made && inputs->line_force < swing)
        made = dynamics_tracks_add_flight(excitation, 0.5 * (1 - inputs->line_force / swing));
    return made ? FF_OK : FF_NOMEM;
}

void dynamics_back_flank_line(const ff_host *host, const dynamics_inputs *inputs,
                              const dynamics_excitation *excitation, double share)
{
    char text[320];
    const int own = dynamics_tracks_differ(excitation);
    if (!(share > 0) || inputs->constant)
        return;
    snprintf(text, sizeof text,
             "share of the time in which the back flanks, opposite to those that carry the mean "
             "load, carry load: %s",
             own ? "they have their own stiffness, transmission error and relief; tooth_force, and "
                   "the films, losses and ratings that use it, refer to the other flanks; "
                   "contact/back-tooth-pair gives the contact of the back flanks"
             : isnan(inputs->back_offset)
                 ? "the stiffness gives no curves for them, so the mirrored curves of the other "
                   "flanks are used"
                 : "this model uses the mirrored curves of the other flanks; dynamics/shooting and "
                   "dynamics/time-integration without oil in the gap use their own curves");
    host->quality(host->ctx, "back_flank", share, 0, own ? FF_GOOD : FF_RANGE, text);
}
