/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A gear pair with its gears exchanged. If the torque is negative, the back flanks carry the load
   and gear 2 drives. Contact of the back flanks equals contact of driving flanks after gear 1 and
   gear 2 have changed places. A model that only supports driving flanks reads its inputs through
   these functions, which exchange the gears. The functions also convert results by station, by roll
   angle or by gear back to the original gears. */
#ifndef NUMERICS_EXCHANGE_H
#define NUMERICS_EXCHANGE_H

#include <flankfilm/author.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct numerics_exchange {
    const ff_array *in; /* inputs for the model: the original ones if gear 1 drives */
    int back;           /* true: gear 2 drives */
    double ratio;       /* z_1/z_2 */
    double top;         /* roll angle of gear 2 = ratio (top - roll angle of gear 1), rad */
    double sap;         /* roll_sap of the exchanged pair, rad: the roll angle of gear 2 at which
                           gear 1 has passed its SAP by the smallest whole number of mesh cycles
                           that reaches the end of the path */
    ff_array *arrays;
    double *room;
} numerics_exchange;

/* Returns the name of an input without that of its wire. */
static inline const char *numerics_exchange_item(const ff_port *port)
{
    const char *dot = strchr(port->name, '.');
    return dot ? dot + 1 : port->name;
}

/* Returns the wired input with that name, or NULL. */
static inline const ff_array *numerics_exchange_find(const ff_port *ports, size_t count,
                                                     const ff_array *in, const char *name)
{
    for (size_t i = 0; i < count; i++)
        if (in[i].data && !strcmp(ports[i].name, name))
            return &in[i];
    return NULL;
}

/* Returns 1 if the driving flanks carry the load, -1 if the back flanks do, 0 without load. */
static inline int numerics_flank(const ff_port *ports, size_t count, const ff_array *in)
{
    const ff_array *load = numerics_exchange_find(ports, count, in, "operating.line_force");
    if (!load)
        load = numerics_exchange_find(ports, count, in, "operating.torque");
    return load ? (load->data[0] > 0) - (load->data[0] < 0) : 1;
}

static inline size_t numerics_exchange_length(const ff_array *a)
{
    size_t n = a->data ? 1 : 0;
    for (uint32_t k = 0; a->data && k < a->rank; k++)
        n *= a->shape[k];
    return n;
}

/* Reverses the order of n values of `width` numbers each. */
static inline void numerics_reverse(double *x, size_t n, size_t width)
{
    for (size_t i = 0; i < n / 2; i++)
        for (size_t k = 0; k < width; k++) {
            double held = x[i * width + k];
            x[i * width + k] = x[(n - 1 - i) * width + k];
            x[(n - 1 - i) * width + k] = held;
        }
}

/* Returns whether `last` is the last of the dimensions, with or without the name of a wire
   ("gear.station"). */
static inline int numerics_exchange_ends(const char *dims, const char *last)
{
    const size_t n = strlen(dims), m = strlen(last);
    return n >= m && !strcmp(dims + n - m, last) &&
           (n == m || dims[n - m - 1] == ' ' || dims[n - m - 1] == '.');
}

/* Sets ratio, top and sap. Roll angles of gear 2 follow from the radii of curvature; without radii,
   only differences of the roll angle can be used. */
static inline void numerics_exchange_measure(const ff_port *ports, size_t count, const ff_array *in,
                                             numerics_exchange *x)
{
    const ff_array *teeth = numerics_exchange_find(ports, count, in, "gear.teeth"),
                   *roll = numerics_exchange_find(ports, count, in, "gear.roll_angle"),
                   *sap = numerics_exchange_find(ports, count, in, "gear.roll_sap"),
                   *r1 = numerics_exchange_find(ports, count, in, "gear.radius_1"),
                   *r2 = numerics_exchange_find(ports, count, in, "gear.radius_2");
    const size_t n = roll ? numerics_exchange_length(roll) : 0;
    if (teeth && numerics_exchange_length(teeth) > 1)
        x->ratio = teeth->data[0] / teeth->data[1];
    if (n < 2)
        return;
    const double first = roll->data[0], last = roll->data[n - 1];
    x->top = first + last;
    if (r1 && r2 && numerics_exchange_length(r1) == n && numerics_exchange_length(r2) == n)
        x->top = first + r2->data[0] * (last - first) / (r1->data[n - 1] - r1->data[0]);
    if (!sap || !teeth)
        return;
    const double pitch = 2 * M_PI / teeth->data[0];
    x->sap =
        x->ratio * (x->top - sap->data[0] - ceil((last - sap->data[0]) / pitch - 1e-9) * pitch);
}

/* Returns the roll angle of gear 1 for one of gear 2. */
static inline double numerics_exchange_back(const numerics_exchange *x, double roll)
{
    return x->back ? x->top - roll / x->ratio : roll;
}

static inline double numerics_exchange_value(const numerics_exchange *x, const char *item, double v)
{
    if (!strcmp(item, "roll_angle"))
        return x->ratio * (x->top - v);
    if (!strcmp(item, "roll_sap"))
        return x->sap;
    if (!strcmp(item, "phase") || !strcmp(item, "back_phase") || !strcmp(item, "back_offset"))
        return 1 - v;
    if (!strcmp(item, "torque"))
        return -v / x->ratio;
    if (!strcmp(item, "speed"))
        return v * x->ratio;
    if (!strcmp(item, "fluctuation_order"))
        return v / x->ratio;
    if (!strcmp(item, "pinion"))
        return 3 - v;
    /* friction has the sign of u_1 - u_2 */
    return !strcmp(item, "line_force") || !strcmp(item, "traction") ||
                   !strcmp(item, "fluctuation_cosine") || !strcmp(item, "fluctuation_sine") ||
                   !strcmp(item, "friction_coefficient")
               ? -v
               : v;
}

static inline void numerics_exchange_array(const numerics_exchange *x, const ff_port *port,
                                           const ff_array *a, double *to)
{
    const char *item = numerics_exchange_item(port);
    const size_t n = numerics_exchange_length(a), last = a->rank ? a->shape[a->rank - 1] : 1;
    for (size_t i = 0; i < n; i++)
        to[i] = numerics_exchange_value(x, item, a->data[i]);
    if (!strncmp(port->dims, "gear", 4) && port->dims[4] != '.' && a->rank && a->shape[0] == 2)
        numerics_reverse(to, 2, n / 2);
    if (numerics_exchange_ends(port->dims, "station") ||
        numerics_exchange_ends(port->dims, "phase") ||
        numerics_exchange_ends(port->dims, "back_phase"))
        for (size_t row = 0; last && row < n / last; row++)
            numerics_reverse(to + row * last, last, 1);
}

/* Returns the index of the row with the same quantity for the other gear, or for the other flank of
   the gear; `i` itself if there is none. The back flanks of a stiffness are always the unloaded
   flanks, whichever gear drives. */
static inline size_t numerics_exchange_partner(const ff_port *ports, size_t count, size_t i)
{
    const char *name = ports[i].name, *item = numerics_exchange_item(&ports[i]);
    const size_t n = strlen(name), stage = n - strlen(item);
    for (size_t k = 0; k < count; k++) {
        const char *other = ports[k].name;
        if (n > 2 && !strcmp(name + n - 2, "_1") && strlen(other) == n &&
            !strncmp(other, name, n - 1) && other[n - 1] == '2')
            return k;
        if (!strncmp(name, "gear.", 5) && strlen(other) == n + 5 && !strncmp(other, name, stage) &&
            !strncmp(other + stage, "back_", 5) && !strcmp(other + stage + 5, item))
            return k;
    }
    return i;
}

/* Sets x->in from the inputs of a model: as they are for the driving flanks, exchanged if `back` is
   set. May return FF_NOMEM. The caller closes x, also after an error. */
static inline ff_status numerics_exchange_open_flank(const ff_port *ports, size_t count,
                                                     const ff_array *in, int back,
                                                     numerics_exchange *x)
{
    size_t total = 0;
    *x = (numerics_exchange){.in = in, .back = back, .ratio = 1};
    if (!x->back)
        return FF_OK;
    numerics_exchange_measure(ports, count, in, x);
    for (size_t i = 0; i < count; i++)
        total += numerics_exchange_length(&in[i]);
    x->arrays = malloc(count * sizeof *x->arrays);
    x->room = malloc(total * sizeof *x->room);
    if (!x->arrays || !x->room)
        return FF_NOMEM;
    double *to = x->room;
    memcpy(x->arrays, in, count * sizeof *in);
    for (size_t i = 0; i < count; i++) {
        const size_t n = numerics_exchange_length(&in[i]);
        if (!n)
            continue;
        numerics_exchange_array(x, &ports[i], &in[i], to);
        x->arrays[i].data = to;
        to += n;
    }
    for (size_t i = 0; i < count; i++) {
        const size_t k = numerics_exchange_partner(ports, count, i);
        const ff_array held = x->arrays[i];
        if (!x->arrays[k].data)
            continue;
        x->arrays[i] = x->arrays[k];
        x->arrays[k] = held;
    }
    x->in = x->arrays;
    return FF_OK;
}

/* Does this for the flanks that carry the load. */
static inline ff_status numerics_exchange_open(const ff_port *ports, size_t count,
                                               const ff_array *in, numerics_exchange *x)
{
    return numerics_exchange_open_flank(ports, count, in, numerics_flank(ports, count, in) < 0, x);
}

/* Refuses negative tooth forces: their source has treated a negative line force as a force on
   driving flanks. `row` is the row of the tooth forces. */
static inline ff_status numerics_exchange_check(const ff_host *host, const ff_port *ports,
                                                const numerics_exchange *x, size_t row)
{
    double sum = 0;
    for (size_t i = 0; x->back && i < numerics_exchange_length(&x->in[row]); i++)
        sum += x->in[row].data[i];
    return sum >= 0 ? FF_OK
                    : ff_failf(host, FF_UNSUPPORTED, ports[row].name,
                               "the torque is negative, and so are the tooth forces of this "
                               "source, which supports driving flanks only: write gear 2 of the "
                               "file as gear 1, with a positive torque");
}

static inline void numerics_exchange_close(numerics_exchange *x)
{
    free(x->arrays);
    free(x->room);
    x->arrays = NULL;
    x->room = NULL;
}

#endif
