/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "oil.h"

#include <math.h>
#include <stdlib.h>

ff_status dynamics_oil_check(const ff_host *host, const dynamics_oil *oil, int32_t damping)
{
    int none = oil->squeeze == DYNAMICS_SQUEEZE_NONE;
    const ff_serving rows[] = {
        {none, "squeeze_rolling", "", NULL, "squeeze is none"},
        {none, "handover_film", "", NULL, "squeeze is none"},
        {none, "supply_film", "", NULL, "squeeze is none"},
        {none, "oil.eta0", "", NULL, "squeeze is none"},
    };
    ff_serve(host, rows, sizeof rows / sizeof rows[0]);
    if (none)
        return FF_OK;
    if (damping != DYNAMICS_DAMPING_ALWAYS)
        return ff_failf(host, FF_INVALID, "damping",
                        "must be always if squeeze is series, since the oil between the flanks "
                        "replaces a damper that acts only in contact");
    if (oil->supply <= oil->hand_over)
        return ff_failf(host, FF_INVALID, "supply_film", "must be above handover_film");
    return FF_OK;
}

/* Reads a scalar or series that the oil model needs. All values must be above 0. */
static ff_status check_input(const ff_host *host, const ff_array *in, int input, size_t count)
{
    const char *name = dynamics_oil_input_ports[input].name;
    if (!in[input].data)
        return ff_failf(host, FF_INVALID, "squeeze",
                        "series needs %s: wire a %s that gives it, or set squeeze: none", name,
                        input == DYNAMICS_IN_ETA0 ? "lubricant" : "gear");
    if (count > 0 && (in[input].rank != 1 || in[input].shape[0] != count))
        return ff_failf(host, FF_INVALID, name, "must be a series of %zu values", count);
    for (size_t i = 0; i < (count ? count : 1); i++)
        if (!(in[input].data[i] > 0 && isfinite(in[input].data[i])))
            return ff_failf(host, FF_INVALID, name, "must be above 0, but is %g",
                            in[input].data[i]);
    return FF_OK;
}

/* Sets radii and speeds. The radii of curvature are linear along the line of action, so that the
   equivalent radius r1 r2/(r1 + r2) of a pair is a parabola in the mesh cycles since SAP. The flank
   speeds r1 w1 and r2 w2 are linear too; u is their mean in the middle of the path. */
static void read_path(const ff_array *in, const dynamics_inputs *inputs, double length,
                      dynamics_film *film)
{
    size_t last = inputs->stations - 1;
    const double *teeth = in[DYNAMICS_IN_TEETH].data;
    double r1 = in[DYNAMICS_IN_RADIUS_1].data[0], r2 = in[DYNAMICS_IN_RADIUS_2].data[0];
    double begin = (inputs->roll_angle[0] - inputs->roll_sap) / inputs->pitch;
    double end = (inputs->roll_angle[last] - inputs->roll_sap) / inputs->pitch;
    double slope = end > begin ? (in[DYNAMICS_IN_RADIUS_1].data[last] - r1) / (end - begin) : 0;
    r1 -= slope * begin;
    r2 += slope * begin;
    film->pairs = end;
    film->radius[0] = r1 * r2 / (r1 + r2) / length;
    film->radius[1] = slope * (r2 - r1) / (r1 + r2) / length;
    film->radius[2] = -slope * slope / (r1 + r2) / length;
    double middle = r1 + 0.5 * slope * end, other = r2 - 0.5 * slope * end;
    film->entrainment = 0.5 * inputs->pitch * (middle + other * teeth[0] / teeth[1]) / length;
}

ff_status dynamics_oil_read(const ff_host *host, const ff_array *in, const dynamics_oil *oil,
                            const dynamics_inputs *inputs, dynamics_excitation *excitation,
                            dynamics_film **out)
{
    double length = excitation->length;
    *out = NULL;
    if (oil->squeeze == DYNAMICS_SQUEEZE_NONE)
        return FF_OK;
    if (excitation->shared)
        return ff_failf(host, FF_UNSUPPORTED, "force",
                        "a film between separated flanks (squeeze: series) needs a single mesh "
                        "stiffness; use force: frozen, or squeeze: none");
    if (!(excitation->half_gap > 0))
        return ff_failf(host, FF_INVALID, "squeeze",
                        "series needs a gear with backlash: without backlash the flanks never "
                        "separate");
    ff_status status = check_input(host, in, DYNAMICS_IN_RADIUS_1, inputs->stations);
    if (status == FF_OK)
        status = check_input(host, in, DYNAMICS_IN_RADIUS_2, inputs->stations);
    if (status == FF_OK)
        status = check_input(host, in, DYNAMICS_IN_FACE_WIDTH, 0);
    if (status == FF_OK)
        status = check_input(host, in, DYNAMICS_IN_ETA0, 0);
    if (status != FF_OK)
        return status;
    dynamics_film *film = calloc(1, sizeof *film);
    if (!film)
        return FF_NOMEM;
    film->viscosity = in[DYNAMICS_IN_ETA0].data[0] * in[DYNAMICS_IN_FACE_WIDTH].data[0] *
                      excitation->omega / excitation->stiffness;
    film->hand_over = oil->hand_over / length;
    film->supply = isnan(oil->supply) ? INFINITY : oil->supply / length;
    film->rolling = oil->rolling;
    film->span = excitation->span;
    read_path(in, inputs, length, film);
    if (film->rolling)
        dynamics_squeeze_table_build(&film->table);
    excitation->film = *out = film;
    return FF_OK;
}
