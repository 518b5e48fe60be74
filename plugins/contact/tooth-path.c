/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reads the path of contact and the forces of a tooth pair. */
#include "tooth-path.h"

#include "../numerics/isothermal.h"

#include <flankfilm/author.h>
#include <flankfilm/laws.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

const ff_port contact_tooth_inputs[CONTACT_TOOTH_INPUTS] = {
    {.name = "load.back_tooth_force",
     .unit = "N",
     .doc = "tooth force on a pair of flanks opposite to those that carry the mean load",
     .dims = "engagement? gear.station",
     .from = "stiffness|dynamics"},
    {.name = "load.back_gap",
     .unit = "m",
     .doc = "separation of the flanks of load.back_tooth_force; 0 in contact",
     .dims = "engagement? gear.station",
     .from = "stiffness|dynamics"},
    {.name = "gear.roll_angle",
     .unit = "rad",
     .doc = "roll angle of gear 1 from SAP to tip; an angle given twice marks a jump of the load",
     .dims = "station",
     .from = "gear"},
    {.name = "gear.radius_1",
     .unit = "m",
     .doc = "radius of curvature of flank 1",
     .dims = "station",
     .from = "gear"},
    {.name = "gear.radius_2",
     .unit = "m",
     .doc = "radius of curvature of flank 2",
     .dims = "station",
     .from = "gear"},
    {.name = "gear.face_width",
     .unit = "m",
     .doc = "width of the teeth in contact",
     .dims = "",
     .from = "gear"},
    {.name = "gear.teeth", .unit = "1", .doc = "numbers of teeth", .dims = "gear", .from = "gear"},
    {.name = "gear.reduced_modulus",
     .unit = "Pa",
     .doc = "reduced modulus E' of the flanks",
     .dims = "",
     .from = "gear"},
    {.name = "operating.speed", .unit = "rad/s", .doc = "speed of gear 1", .dims = ""},
    {.name = "operating.line_force",
     .unit = "N",
     .doc = "static force along the line of action: the mean total force of all pairs",
     .dims = "",
     .flags = FF_OPTIONAL},
    {.name = "viscosity",
     .unit = "",
     .doc = "viscosity law, for the Moes numbers",
     .dims = "",
     .service = FF_VISCOSITY_ID,
     .flags = FF_OPTIONAL},
    NUMERICS_OIL_ROWS,
    {.name = "load.back_force_mean",
     .unit = "N",
     .doc = "mean force on the flanks opposite to those that carry the mean load, if "
            "load.tooth_force does not include it",
     .dims = "",
     .flags = FF_OPTIONAL,
     .from = "stiffness|dynamics"},
    {.name = "load.tooth_force",
     .unit = "N",
     .doc = "tooth force on the pair, quasi-static or dynamic",
     .dims = "engagement? gear.station",
     .from = "stiffness|dynamics"},
    {.name = "load.gap",
     .unit = "m",
     .doc = "separation of the flanks; 0 in contact",
     .dims = "engagement? gear.station",
     .flags = FF_OPTIONAL,
     .from = "stiffness|dynamics"},
};

/* Reads a scalar, or the first two numbers of a series; each must be finite and positive. */
static ff_status read_positive(const ff_host *host, const ff_array *in, uint32_t row, size_t count,
                               double *value)
{
    size_t length = in[row].rank == 0 ? 1 : in[row].shape[0];
    if (!in[row].data || in[row].rank > 1 || length < count)
        return ff_failf(host, FF_INVALID, contact_tooth_inputs[row].name,
                        "%s must hold %zu value%s", contact_tooth_inputs[row].name, count,
                        count == 1 ? "" : "s");
    for (size_t i = 0; i < count; i++) {
        value[i] = in[row].data[i];
        if (!(value[i] > 0 && isfinite(value[i])))
            return ff_failf(host, FF_INVALID, contact_tooth_inputs[row].name,
                            "%s is %g; it must be above 0", contact_tooth_inputs[row].name,
                            value[i]);
    }
    return FF_OK;
}

/* Reads a series over the stations, or one such series for each engagement. Sets the number of
   engagements. */
static ff_status read_series(const ff_host *host, const ff_array *in, uint32_t row, size_t n,
                             double least, const double **series, size_t *engagements)
{
    const ff_array *a = &in[row];
    if (!a->data || a->rank < 1 || a->rank > 2 || a->shape[a->rank - 1] != n ||
        (a->rank == 2 && (!engagements || a->shape[0] == 0)))
        return ff_failf(host, FF_INVALID, contact_tooth_inputs[row].name,
                        "%s must have one value for each of the %zu stations of the gear",
                        contact_tooth_inputs[row].name, n);
    const size_t count = a->rank == 2 ? a->shape[0] : 1;
    if (engagements)
        *engagements = count;
    *series = a->data;
    const double most = 1e100; /* keeps the slopes between stations finite */
    for (size_t i = 0; i < count * n; i++) {
        double value = (*series)[i];
        if (!(value >= least && value <= most))
            return ff_failf(host, FF_INVALID, contact_tooth_inputs[row].name,
                            "%s is %g at station %zu; it must lie between %g and %g",
                            contact_tooth_inputs[row].name, value, i % n, least, most);
    }
    return FF_OK;
}

static ff_status read_engagements(const ff_host *host, contact_engagement_choice wanted,
                                  contact_tooth_path *p)
{
    if (wanted.one != CONTACT_ENGAGEMENTS_ALL && (size_t)wanted.one >= p->available)
        return ff_failf(host, FF_INVALID, "engagement",
                        "engagement %ld does not exist: the load has %zu, counted from 0",
                        (long)wanted.one, p->available);
    if (p->gap && p->gaps != 1 && p->gaps != p->available)
        return ff_failf(host, FF_INVALID, contact_tooth_inputs[p->force_row + 1].name,
                        "%s has %zu engagements, %s %zu",
                        contact_tooth_inputs[p->force_row + 1].name, p->gaps,
                        contact_tooth_inputs[p->force_row].name, p->available);
    p->engagement = malloc(p->available * sizeof *p->engagement);
    if (!p->engagement)
        return FF_NOMEM;
    p->count = 1;
    p->engagement[0] = (size_t)wanted.one;
    if (wanted.one == CONTACT_ENGAGEMENTS_ALL)
        p->count = contact_engagements_pick(p->available, (size_t)wanted.most, p->engagement);
    return FF_OK;
}

static ff_status read_stations(const ff_host *host, const ff_array *in,
                               contact_engagement_choice wanted, contact_tooth_path *p)
{
    p->n = in[CONTACT_TOOTH_ROLL_ANGLE].data && in[CONTACT_TOOTH_ROLL_ANGLE].rank == 1
               ? in[CONTACT_TOOTH_ROLL_ANGLE].shape[0]
               : 0;
    if (p->n < 2)
        return ff_failf(host, FF_INVALID, "gear.roll_angle",
                        "gear.roll_angle must hold at least 2 stations");
    ff_status status = read_series(host, in, CONTACT_TOOTH_ROLL_ANGLE, p->n, 0, &p->angle, NULL);
    for (size_t i = 1; i < p->n && status == FF_OK; i++)
        if (p->angle[i] < p->angle[i - 1])
            return ff_failf(host, FF_INVALID, "gear.roll_angle",
                            "gear.roll_angle decreases at station %zu", i);
    if (status == FF_OK && !(p->angle[p->n - 1] > p->angle[0]))
        return ff_failf(host, FF_INVALID, "gear.roll_angle",
                        "gear.roll_angle must increase from SAP to tip");
    if (status == FF_OK)
        status = read_series(host, in, CONTACT_TOOTH_RADIUS_1, p->n, 1e-100, &p->radius_1, NULL);
    if (status == FF_OK)
        status = read_series(host, in, CONTACT_TOOTH_RADIUS_2, p->n, 1e-100, &p->radius_2, NULL);
    if (status == FF_OK)
        status = read_series(host, in, p->force_row, p->n, -1e100, &p->force, &p->available);
    if (status == FF_OK && in[p->force_row + 1].data)
        status = read_series(host, in, p->force_row + 1, p->n, -1e100, &p->gap, &p->gaps);
    return status == FF_OK ? read_engagements(host, wanted, p) : status;
}

/* Sets the mean force of all pairs on these flanks. The flanks that carry the mean load also
   balance the mean force on the opposite flanks. */
static void read_mean_force(const ff_array *in, int back, contact_tooth_path *p)
{
    const double *force = in[CONTACT_TOOTH_LINE_FORCE].data,
                 *behind = in[CONTACT_TOOTH_BACK_FORCE_MEAN].data;
    const double others = behind ? *behind : 0;
    p->both_bear = others > 0;
    p->mean_force = back ? others : force && *force >= 0 ? *force + others : 0;
}

ff_status contact_tooth_path_read(const ff_host *host, const ff_array *in, int back,
                                  contact_engagement_choice wanted, contact_tooth_path *p)
{
    double teeth[2] = {1, 1};
    *p = (contact_tooth_path){.force_row = back ? CONTACT_TOOTH_BACK_TOOTH_FORCE
                                                : CONTACT_TOOTH_TOOTH_FORCE};
    memcpy(&p->in[contact_tooth_first(back)], in,
           (CONTACT_TOOTH_INPUTS - CONTACT_TOOTH_FIRST) * sizeof *in);
    p->oil = &p->in[CONTACT_TOOTH_OIL];
    const int loaded = numerics_flank(contact_tooth_inputs, CONTACT_TOOTH_INPUTS, p->in);
    ff_status status = numerics_exchange_open_flank(contact_tooth_inputs, CONTACT_TOOTH_INPUTS,
                                                    p->in, (loaded < 0) != back, &p->exchange);
    in = p->exchange.in;
    if (status == FF_OK)
        status = numerics_exchange_check(host, contact_tooth_inputs, &p->exchange, p->force_row);
    if (status == FF_OK)
        status = read_positive(host, in, CONTACT_TOOTH_FACE_WIDTH, 1, &p->face_width);
    if (status == FF_OK)
        status = read_positive(host, in, CONTACT_TOOTH_TEETH, 2, teeth);
    if (status == FF_OK)
        status = read_positive(host, in, CONTACT_TOOTH_REDUCED_MODULUS, 1, &p->reduced_modulus);
    if (status == FF_OK)
        status = read_positive(host, in, CONTACT_TOOTH_SPEED, 1, &p->speed);
    read_mean_force(in, back, p);
    p->ratio = teeth[0] / teeth[1];
    p->pitch = 2 * M_PI / teeth[0];
    return status == FF_OK ? read_stations(host, in, wanted, p) : status;
}

void contact_tooth_path_close(contact_tooth_path *p)
{
    free(p->engagement);
    numerics_exchange_close(&p->exchange);
}
