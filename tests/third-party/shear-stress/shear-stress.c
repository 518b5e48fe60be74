/* SPDX-License-Identifier: MIT */
/*
 * rating/shear-stress: how far the largest shear stress below a line contact stays from yield.
 *
 * Hertz's pressure p makes a shear stress of 0.300 p at a depth of 0.786 half widths (Johnson 1985,
 * section 4.2). Steel yields in shear at k = HV/6, from HV = 3 Y and Tresca's Y = 2 k. The pressure
 * is that of the film, with its spike; the depth is that of Hertz at the same instant.
 */
#include <flankfilm/author.h>
#include <flankfilm/history.h>

#include <math.h>
#include <stdlib.h>

typedef struct stage {
    const ff_host *host;
    double hardness;
} stage;

static const ff_param params[] = {
    FF_QUANTITY("hardness", "GPa", stage, hardness, FF_REQUIRED, NULL, NULL, 0.5, 20, 1, 10,
                "hardness of the softer flank: HV 700 is 6.9 GPa"),
};

enum { FILM_TIME, PRESSURE, CONTACT_TIME, HALF_WIDTH };

static const ff_port inputs[] = {
    [FILM_TIME] = {.name = "ehl.time", .unit = "s", .dims = "t", .doc = "steps of the film"},
    [PRESSURE] = {.name = "ehl.p_max", .unit = "Pa", .dims = "t", .doc = "highest pressure"},
    [CONTACT_TIME] = {.name = "contact.time", .unit = "s", .dims = "t", .doc = "instants there"},
    [HALF_WIDTH] = {.name = "contact.hertz_half_width",
                    .unit = "m",
                    .dims = "t",
                    .doc = "dry half width"},
};

enum { STRESS, DEPTH, SAFETY };

static const ff_port outputs[] = {
    [STRESS] = {.name = "shear_stress", .unit = "Pa", .dims = "", .doc = "the largest of all"},
    [DEPTH] = {.name = "depth", .unit = "m", .dims = "", .doc = "where it is"},
    [SAFETY] = {.name = "safety", .unit = "1", .dims = "", .doc = "k over the largest stress"},
};

static ff_status evaluate(void *self, uint64_t wanted, const ff_array *in)
{
    const stage *s = self;
    const double *pressure = in[PRESSURE].data;
    size_t worst = 0;
    double half_width;
    (void)wanted;
    for (size_t i = 0; i < in[PRESSURE].shape[0]; i++)
        worst = pressure[i] > pressure[worst] ? i : worst;
    if (!in[PRESSURE].shape[0] || !(pressure[worst] > 0 && pressure[worst] < 1e12))
        return ff_failf(s->host, FF_INVALID, "ehl.p_max", "no pressure loads the flanks");
    if (ff_history_at(in[CONTACT_TIME].shape[0], in[CONTACT_TIME].data, in[HALF_WIDTH].data, 1,
                      &in[FILM_TIME].data[worst], &half_width) == FF_INVALID)
        return ff_failf(s->host, FF_INVALID, "contact.time", "the instants must rise");
    if (!(half_width >= 0 && half_width < 1e3))
        return ff_failf(s->host, FF_INVALID, "contact.hertz_half_width", "%g m is no half width",
                        half_width);
    const double stress = 0.300 * pressure[worst],
                 values[] = {stress, 0.786 * half_width, s->hardness / 6 / stress};
    for (uint32_t i = STRESS; i <= SAFETY; i++)
        if (ff_put_scalar(s->host, i, values[i]) != FF_OK)
            return FF_NOMEM;
    return FF_OK;
}

FF_MODEL(model, stage, .id = "rating/shear-stress", .version = "1.0.0",
         .summary = "yield in shear below the surface, by the pressure of the film",
         .reference = "Johnson 1985, Contact Mechanics, 4.2 and 6.3", .bibtex = "",
         .licence = "MIT", .params = FF_TABLE(params), .inputs = FF_TABLE(inputs),
         .outputs = FF_TABLE(outputs), .evaluate = evaluate, .destroy = free);
FF_EXPORT_MODELS(&model);
