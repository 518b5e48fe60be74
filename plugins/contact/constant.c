/* SPDX-License-Identifier: GPL-3.0-or-later */
/* contact/constant: a line contact whose radius, speeds and load do not change. */
#include "history.h"

#include <flankfilm/author.h>

#include <math.h>
#include <stdlib.h>

enum {
    P_RADIUS,
    P_RADIUS_1,
    P_RADIUS_2,
    P_ENTRAINMENT_SPEED,
    P_SLIDE_ROLL_RATIO,
    P_SPEED_1,
    P_SPEED_2,
    P_LOAD_PER_WIDTH,
    P_REDUCED_MODULUS,
    P_ELASTIC_MODULUS,
    P_POISSON_RATIO,
    P_DURATION,
    PARAM_COUNT
};

static const ff_param params[] = {
    {.name = "radius",
     .unit = "mm",
     .doc = "equivalent radius R; both surfaces are then given 2 R",
     .type = FF_REAL,
     .flags = FF_REQUIRED,
     .group = "radius",
     .min = 1e-6,
     .max = 1e9},
    {.name = "radius_1",
     .unit = "mm",
     .doc = "radius of surface 1, together with radius_2, in place of `radius`",
     .type = FF_REAL,
     .flags = FF_REQUIRED,
     .group = "radius",
     .min = 1e-6,
     .max = 1e9},
    {.name = "radius_2",
     .unit = "mm",
     .doc = "radius of surface 2, together with radius_1",
     .type = FF_REAL,
     .min = 1e-6,
     .max = 1e9},
    {.name = "entrainment_speed",
     .unit = "m/s",
     .doc = "mean surface speed u_r = (u1 + u2)/2",
     .type = FF_REAL,
     .flags = FF_REQUIRED,
     .group = "speed",
     .min = 1e-9,
     .max = 1e6},
    {.name = "slide_roll_ratio",
     .unit = "1",
     .doc = "(u1 - u2)/u_r, together with entrainment_speed; left out: 0, pure rolling",
     .type = FF_REAL,
     .min = -1e3,
     .max = 1e3},
    {.name = "speed_1",
     .unit = "m/s",
     .doc = "speed u1 of surface 1, together with speed_2, in place of entrainment_speed",
     .type = FF_REAL,
     .flags = FF_REQUIRED,
     .group = "speed",
     .min = -1e6,
     .max = 1e6},
    {.name = "speed_2",
     .unit = "m/s",
     .doc = "speed u2 of surface 2, together with speed_1",
     .type = FF_REAL,
     .min = -1e6,
     .max = 1e6},
    {.name = "load_per_width",
     .unit = "N/mm",
     .doc = "load per width of the contact",
     .type = FF_REAL,
     .flags = FF_REQUIRED,
     .min = 1e-9,
     .max = 1e9},
    {.name = "reduced_modulus",
     .unit = "GPa",
     .doc = "E' of 2/E' = (1 - nu1^2)/E1 + (1 - nu2^2)/E2",
     .type = FF_REAL,
     .preset = "226.4 GPa",
     .group = "modulus",
     .min = 1e-6,
     .max = 1e6},
    {.name = "elastic_modulus",
     .unit = "GPa",
     .doc = "Young's moduli E1 and E2, in place of reduced_modulus",
     .type = FF_REALS,
     .group = "modulus",
     .min = 1e-6,
     .max = 1e6,
     .min_count = 1,
     .max_count = 2},
    {.name = "poisson_ratio",
     .unit = "1",
     .doc = "Poisson's ratios, together with elastic_modulus; left out: 0.3",
     .type = FF_REALS,
     .min = 0,
     .max = 0.5,
     .min_count = 1,
     .max_count = 2},
    {.name = "duration",
     .unit = "s",
     .doc = "length of the history; 0: a steady contact, one instant",
     .type = FF_REAL,
     .preset = "0 s",
     .min = 0,
     .max = 1e9},
};

static const ff_port inputs[] = {
    {.name = "viscosity",
     .unit = "",
     .doc = "viscosity law, for the Moes numbers",
     .dims = "",
     .service = FF_VISCOSITY_ID,
     .flags = FF_OPTIONAL},
};

typedef struct constant {
    const ff_host *host;
    double value[PARAM_COUNT][2]; /* a single number is in both */
    int given[PARAM_COUNT];
    const ff_viscosity *law;
    double reduced_modulus;
    contact_point point;
} constant;

static ff_status create(const ff_host *host, void **self)
{
    constant *s = calloc(1, sizeof *s);
    if (!s)
        return FF_NOMEM;
    s->host = host;
    s->value[P_POISSON_RATIO][0] = s->value[P_POISSON_RATIO][1] = 0.3;
    *self = s;
    return FF_OK;
}

static ff_status set(void *self, uint32_t param, const ff_value *value)
{
    constant *s = self;
    int list = params[param].type == FF_REALS;
    s->value[param][0] = list ? value->reals[0] : value->real;
    s->value[param][1] = list ? value->reals[value->count - 1] : value->real;
    s->given[param] = 1;
    return FF_OK;
}

static ff_status wire(void *self, uint32_t input, const void *service)
{
    constant *s = self;
    (void)input;
    s->law = service;
    return FF_OK;
}

/* Parameters that only mean something together: `mate` is given without `with`. */
static ff_status check_company(const constant *s)
{
    static const struct {
        uint32_t with, mate;
        int both; /* `with` needs `mate` too */
    } company[] = {
        {P_RADIUS_1, P_RADIUS_2, 1},
        {P_SPEED_1, P_SPEED_2, 1},
        {P_ENTRAINMENT_SPEED, P_SLIDE_ROLL_RATIO, 0},
        {P_ELASTIC_MODULUS, P_POISSON_RATIO, 0},
    };
    for (size_t i = 0; i < sizeof company / sizeof company[0]; i++) {
        uint32_t with = company[i].with, mate = company[i].mate;
        if (s->given[mate] && !s->given[with])
            return ff_failf(s->host, FF_INVALID, params[mate].name,
                            "%s has no meaning without %s; give both or neither", params[mate].name,
                            params[with].name);
        if (company[i].both && s->given[with] && !s->given[mate])
            return ff_failf(s->host, FF_INVALID, params[with].name, "%s needs %s beside it",
                            params[with].name, params[mate].name);
    }
    return FF_OK;
}

static ff_status ready(void *self)
{
    constant *s = self;
    ff_status status = check_company(s);
    if (status != FF_OK)
        return status;
    contact_point *p = &s->point;
    p->load_per_width = s->value[P_LOAD_PER_WIDTH][0];
    p->radius_1 = p->radius_2 = 2 * s->value[P_RADIUS][0];
    if (s->given[P_RADIUS_1]) {
        p->radius_1 = s->value[P_RADIUS_1][0];
        p->radius_2 = s->value[P_RADIUS_2][0];
    }
    double mean = s->value[P_ENTRAINMENT_SPEED][0], slide = s->value[P_SLIDE_ROLL_RATIO][0];
    p->speed_1 = mean * (1 + slide / 2);
    p->speed_2 = mean * (1 - slide / 2);
    if (s->given[P_SPEED_1]) {
        p->speed_1 = s->value[P_SPEED_1][0];
        p->speed_2 = s->value[P_SPEED_2][0];
    }
    if (!(fabs(p->speed_1 + p->speed_2) > 0))
        return ff_failf(s->host, FF_INVALID, s->given[P_SPEED_1] ? "speed_1" : "entrainment_speed",
                        "surface speeds %g and %g m/s carry no oil into the contact; their sum "
                        "must not be 0",
                        p->speed_1, p->speed_2);
    const double *E = s->value[P_ELASTIC_MODULUS], *nu = s->value[P_POISSON_RATIO];
    s->reduced_modulus = s->given[P_ELASTIC_MODULUS]
                             ? 2 / ((1 - nu[0] * nu[0]) / E[0] + (1 - nu[1] * nu[1]) / E[1])
                             : s->value[P_REDUCED_MODULUS][0];
    return FF_OK;
}

static ff_status evaluate(void *self, uint64_t wanted, const ff_array *in)
{
    const constant *s = self;
    contact_point point = s->point;
    contact_history history;
    double duration = s->value[P_DURATION][0];
    size_t count = duration > 0 ? 2 : 1;
    (void)in;
    ff_status status =
        contact_history_open(&history, s->host, wanted, count, s->reduced_modulus, s->law);
    for (size_t i = 0; i < count && status == FF_OK; i++) {
        point.time = i == 0 ? 0 : duration;
        status = contact_history_put(&history, i, &point);
    }
    if (status == FF_OK)
        contact_history_report(&history);
    return status;
}

static void destroy(void *self)
{
    free(self);
}

static const ff_model model = {
    sizeof(ff_model),
    FF_ABI_MAJOR,
    FF_ABI_MINOR,
    "contact/constant",
    "1.0.0",
    "line contact of constant radius, speeds and load",
    "Johnson 1985, Contact Mechanics (Hertz line contact); Moes 2000, Lubrication and Beyond",
    "@book{johnson1985, author = {Johnson, K. L.}, title = {Contact Mechanics}, publisher = "
    "{Cambridge University Press}, year = {1985}}\n"
    "@book{moes2000, author = {Moes, H.}, title = {Lubrication and Beyond}, publisher = "
    "{University of Twente}, year = {2000}}",
    "GPL-3.0-or-later",
    0,
    FF_TABLE(params),
    FF_TABLE(inputs),
    contact_outputs,
    CONTACT_ROLL_ANGLE,
    sizeof contact_outputs[0],
    create,
    set,
    wire,
    ready,
    evaluate,
    NULL,
    destroy,
    NULL,
    NULL,
    NULL,
    FF_NO_TABLE,
};

const ff_model *flankfilm_model_v1(void)
{
    return &model;
}
