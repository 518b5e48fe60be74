/* SPDX-License-Identifier: GPL-3.0-or-later */
/* contact/constant: a line contact with constant radius, speeds and load. */
#include "history.h"
#include "line-contact.h"
#include "references.h"

#include <flankfilm/author.h>

#include <math.h>
#include <stdlib.h>

typedef struct constant_contact {
    const ff_host *host;
    /* NaN: not given */
    double radius, radius_1, radius_2, entrainment_speed, slide_roll_ratio, speed_1, speed_2;
    double load_per_width, duration;
    contact_moduli moduli;
    const ff_viscosity *law;
    double reduced_modulus;
    contact_point point;
} constant_contact;

static const ff_param params[] = {
    FF_QUANTITY("radius", "mm", constant_contact, radius, FF_REQUIRED, NULL, "radius", 1e-6, 1e9, 0,
                0, "equivalent radius R; both surfaces then get the radius 2 R"),
    FF_QUANTITY("radius_1", "mm", constant_contact, radius_1, FF_REQUIRED, NULL, "radius", 1e-6,
                1e9, 0, 0, "radius of surface 1; with radius_2, instead of `radius`"),
    FF_QUANTITY("radius_2", "mm", constant_contact, radius_2, 0, NULL, NULL, 1e-6, 1e9, 0, 0,
                "radius of surface 2; with radius_1"),
    FF_QUANTITY("entrainment_speed", "m/s", constant_contact, entrainment_speed, FF_REQUIRED, NULL,
                "speed", 1e-9, 1e6, 0, 0,
                "entrainment speed: mean surface speed u_r = (u1 + "
                "u2)/2"),
    FF_QUANTITY(
        "slide_roll_ratio", "1", constant_contact, slide_roll_ratio, 0, NULL, NULL, -1e3, 1e3, 0, 0,
        "slide-roll ratio (u1 - u2)/u_r; with entrainment_speed; left out: 0, pure rolling"),
    FF_QUANTITY("speed_1", "m/s", constant_contact, speed_1, FF_REQUIRED, NULL, "speed", -1e6, 1e6,
                0, 0, "speed u1 of surface 1; with speed_2, instead of entrainment_speed"),
    FF_QUANTITY("speed_2", "m/s", constant_contact, speed_2, 0, NULL, NULL, -1e6, 1e6, 0, 0,
                "speed u2 of surface 2; with speed_1"),
    FF_QUANTITY("load_per_width", "N/mm", constant_contact, load_per_width, FF_REQUIRED, NULL, NULL,
                1e-9, 1e9, 0, 0, "load per width of the contact"),
    CONTACT_MODULI_ROWS(constant_contact),
    FF_QUANTITY("duration", "s", constant_contact, duration, 0, "0 s", NULL, 0, 1e9, 0, 0,
                "duration of the history; 0: a steady contact with one instant"),
};

static ff_status wire(void *self, uint32_t input, const void *service)
{
    constant_contact *s = self;
    if (input == CONTACT_LINE_VISCOSITY)
        s->law = service;
    return FF_OK;
}

/* Refuses `mate` if `with` is missing; both are parameters. */
static ff_status check_company(const constant_contact *s)
{
    const struct {
        const char *with, *mate;
        double with_value, mate_value;
        bool both; /* `with` also needs `mate` */
    } company[] = {
        {"radius_1", "radius_2", s->radius_1, s->radius_2, true},
        {"speed_1", "speed_2", s->speed_1, s->speed_2, true},
        {"entrainment_speed", "slide_roll_ratio", s->entrainment_speed, s->slide_roll_ratio, false},
    };
    for (size_t i = 0; i < sizeof company / sizeof company[0]; i++) {
        const char *with = company[i].with, *mate = company[i].mate;
        bool has_with = !isnan(company[i].with_value), has_mate = !isnan(company[i].mate_value);
        if (has_mate && !has_with)
            return ff_failf(s->host, FF_INVALID, mate,
                            "%s has no meaning without %s; give both or neither", mate, with);
        if (company[i].both && has_with && !has_mate)
            return ff_failf(s->host, FF_INVALID, with, "%s needs %s", with, mate);
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
    p->load_per_width = s->load_per_width;
    p->radius_1 = isnan(s->radius_1) ? 2 * s->radius : s->radius_1;
    p->radius_2 = isnan(s->radius_1) ? 2 * s->radius : s->radius_2;
    double mean = s->entrainment_speed,
           slide = isnan(s->slide_roll_ratio) ? 0 : s->slide_roll_ratio;
    p->speed_1 = isnan(s->speed_1) ? mean * (1 + slide / 2) : s->speed_1;
    p->speed_2 = isnan(s->speed_1) ? mean * (1 - slide / 2) : s->speed_2;
    if (!(fabs(p->speed_1 + p->speed_2) > 0))
        return ff_failf(s->host, FF_INVALID, isnan(s->speed_1) ? "entrainment_speed" : "speed_1",
                        "the surface speeds %g and %g m/s carry no oil into the contact: their sum "
                        "must not be 0",
                        p->speed_1, p->speed_2);
    return contact_reduced_modulus(s->host, &s->moduli, &s->reduced_modulus);
}

static ff_status evaluate(void *self, uint64_t wanted, const ff_array *in)
{
    const constant_contact *s = self;
    contact_point point = s->point;
    contact_history history;
    double duration = s->duration;
    size_t count = duration > 0 ? 2 : 1;
    ff_status status = contact_history_open(&history, s->host, wanted, count, s->reduced_modulus,
                                            s->law, &in[CONTACT_LINE_OIL]);
    for (size_t i = 0; i < count && status == FF_OK; i++) {
        point.time = i == 0 ? 0 : duration;
        status = contact_history_set(&history, i, &point);
    }
    if (status == FF_OK)
        contact_history_report(&history);
    return status;
}

FF_MODEL(contact_constant, constant_contact, .id = "contact/constant", .version = "1.0.0",
         .summary = "line contact of constant radius, speeds and load",
         .reference = contact_line_reference, .bibtex = BIB_johnson1985 "\n" BIB_moes2000,
         .licence = "GPL-3.0-or-later", .params = FF_TABLE(params),
         .inputs = FF_TABLE(contact_line_inputs), .outputs = contact_outputs,
         .output_count = CONTACT_ROLL_ANGLE, .output_stride = sizeof contact_outputs[0],
         .wire = wire, .ready = ready, .evaluate = evaluate, .destroy = free);
