/* SPDX-License-Identifier: GPL-3.0-or-later */
/* contact/constant: a line contact whose radius, speeds and load do not change. */
#include "history.h"
#include "line-contact.h"

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
    CONTACT_REDUCED_MODULUS_ROW,
    CONTACT_ELASTIC_MODULUS_ROW,
    CONTACT_POISSON_RATIO_ROW,
    {.name = "duration",
     .unit = "s",
     .doc = "length of the history; 0: a steady contact, one instant",
     .type = FF_REAL,
     .preset = "0 s",
     .min = 0,
     .max = 1e9},
};

typedef struct constant_contact {
    const ff_host *host;
    contact_value param[PARAM_COUNT];
    const ff_viscosity *law;
    double reduced_modulus;
    contact_point point;
} constant_contact;

static ff_status create(const ff_host *host, void **self)
{
    constant_contact *s = calloc(1, sizeof *s);
    if (!s)
        return FF_NOMEM;
    s->host = host;
    *self = s;
    return FF_OK;
}

static ff_status set(void *self, uint32_t param, const ff_value *value)
{
    constant_contact *s = self;
    contact_value_set(&s->param[param], &params[param], value);
    return FF_OK;
}

static ff_status wire(void *self, uint32_t input, const void *service)
{
    constant_contact *s = self;
    (void)input;
    s->law = service;
    return FF_OK;
}

/* Parameters that only mean something together: `mate` needs `with`. */
static ff_status check_company(const constant_contact *s)
{
    static const struct {
        uint32_t with, mate;
        int both; /* `with` needs `mate` too */
    } company[] = {
        {P_RADIUS_1, P_RADIUS_2, 1},
        {P_SPEED_1, P_SPEED_2, 1},
        {P_ENTRAINMENT_SPEED, P_SLIDE_ROLL_RATIO, 0},
    };
    for (size_t i = 0; i < sizeof company / sizeof company[0]; i++) {
        uint32_t with = company[i].with, mate = company[i].mate;
        if (s->param[mate].given && !s->param[with].given)
            return ff_failf(s->host, FF_INVALID, params[mate].name,
                            "%s has no meaning without %s; give both or neither", params[mate].name,
                            params[with].name);
        if (company[i].both && s->param[with].given && !s->param[mate].given)
            return ff_failf(s->host, FF_INVALID, params[with].name, "%s needs %s beside it",
                            params[with].name, params[mate].name);
    }
    return FF_OK;
}

static ff_status ready(void *self)
{
    constant_contact *s = self;
    ff_status status = check_company(s);
    if (status != FF_OK)
        return status;
    contact_point *p = &s->point;
    p->load_per_width = s->param[P_LOAD_PER_WIDTH].value[0];
    p->radius_1 = p->radius_2 = 2 * s->param[P_RADIUS].value[0];
    if (s->param[P_RADIUS_1].given) {
        p->radius_1 = s->param[P_RADIUS_1].value[0];
        p->radius_2 = s->param[P_RADIUS_2].value[0];
    }
    double mean = s->param[P_ENTRAINMENT_SPEED].value[0],
           slide = s->param[P_SLIDE_ROLL_RATIO].value[0];
    p->speed_1 = mean * (1 + slide / 2);
    p->speed_2 = mean * (1 - slide / 2);
    if (s->param[P_SPEED_1].given) {
        p->speed_1 = s->param[P_SPEED_1].value[0];
        p->speed_2 = s->param[P_SPEED_2].value[0];
    }
    if (!(fabs(p->speed_1 + p->speed_2) > 0))
        return ff_failf(s->host, FF_INVALID,
                        s->param[P_SPEED_1].given ? "speed_1" : "entrainment_speed",
                        "surface speeds %g and %g m/s carry no oil into the contact; their sum "
                        "must not be 0",
                        p->speed_1, p->speed_2);
    return contact_reduced_modulus(s->host, &s->param[P_REDUCED_MODULUS], &s->reduced_modulus);
}

static ff_status evaluate(void *self, uint64_t wanted, const ff_array *in)
{
    const constant_contact *s = self;
    contact_point point = s->point;
    contact_history history;
    double duration = s->param[P_DURATION].value[0];
    size_t count = duration > 0 ? 2 : 1;
    (void)in;
    ff_status status =
        contact_history_open(&history, s->host, wanted, count, s->reduced_modulus, s->law);
    for (size_t i = 0; i < count && status == FF_OK; i++) {
        point.time = i == 0 ? 0 : duration;
        status = contact_history_set(&history, i, &point);
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
    .size = sizeof(ff_model),
    .abi_major = FF_ABI_MAJOR,
    .abi_minor = FF_ABI_MINOR,
    .id = "contact/constant",
    .version = "1.0.0",
    .summary = "line contact of constant radius, speeds and load",
    .reference = contact_line_reference,
    .bibtex = contact_line_bibtex,
    .licence = "GPL-3.0-or-later",
    .params = FF_TABLE(params),
    .inputs = FF_TABLE(contact_line_inputs),
    .outputs = contact_outputs,
    .output_count = CONTACT_ROLL_ANGLE,
    .output_stride = sizeof contact_outputs[0],
    .create = create,
    .set = set,
    .wire = wire,
    .ready = ready,
    .evaluate = evaluate,
    .destroy = destroy,
};

const ff_model *flankfilm_model_v1(void)
{
    return &model;
}
