/* SPDX-License-Identifier: GPL-3.0-or-later */
/* lubricant/grade: a typical oil of an ISO viscosity grade. */
#include "base-oil.h"
#include "liquid.h"

#include <math.h>

typedef struct grade {
    lubricant_oil oil;
    const char *grade;
    double nu_100;
} grade;

static const ff_param params[] = {
    FF_PHRASE("grade", grade, grade, FF_REQUIRED, NULL, NULL, "ISO 3448 grade, as ISO VG 220"),
    FF_ONE_OF(LUBRICANT_BASES, "base", grade, oil.base, 0, "mineral",
              "base oil: viscosity index (95, 150, 150, 200), density at 15 degC (890, 850, 975, "
              "1050 kg/m3), pressure coefficient and thermal data of a typical oil"),
    FF_QUANTITY("nu_100", "cSt", grade, nu_100, 0, NULL, NULL, 0.5, 1e4, 1, 500,
                "kinematic viscosity at 100 degC, in place of that of the base"),
    FF_QUANTITY("density_15", "kg/m3", grade, oil.density_15, 0, NULL, NULL, 500, 2500, 800, 1164,
                "density at 15 degC, in place of that of the base; it falls with temperature by "
                "ASTM D1250"),
    LUBRICANT_ROWS(grade),
};

static ff_status create(const ff_host *host, void **self)
{
    ff_status status = lubricant_create(host, sizeof(grade), self);
    if (status == FF_OK)
        ((grade *)*self)->nu_100 = NAN;
    return status;
}

static ff_status ready(void *self)
{
    grade *g = self;
    lubricant_oil *oil = &g->oil;
    int64_t rank = g->grade ? lubricant_grade_find(g->grade) : -1;
    if (rank < 0)
        return ff_failf(oil->host, FF_INVALID, "grade", "no grade \"%.40s\"; there is %s",
                        g->grade ? g->grade : "", LUBRICANT_GRADES);
    double nu_40 = lubricant_grade_nu_40(rank);
    double nu_100 = isnan(g->nu_100) ? lubricant_grade_nu_100(rank, oil->base) : g->nu_100;
    if (isnan(oil->density_15))
        oil->density_15 = lubricant_base_density_15(oil->base);
    return lubricant_oil_ready_from(oil, nu_40, nu_100);
}

static ff_status set(void *self, uint32_t param, const ff_value *value)
{
    return lubricant_set(self, &params[param], value);
}

static const ff_model model = {
    .size = sizeof(ff_model),
    .abi_major = FF_ABI_MAJOR,
    .abi_minor = FF_ABI_MINOR,
    .id = "lubricant/grade",
    .version = "1.0.0",
    .summary = "a typical oil of an ISO viscosity grade and base, over temperature",
    .reference = lubricant_reference,
    .bibtex = lubricant_bibtex,
    .licence = "GPL-3.0-or-later",
    .params = FF_TABLE(params),
    .inputs = FF_TABLE(lubricant_inputs),
    .outputs = FF_TABLE(lubricant_outputs),
    .create = create,
    .set = set,
    .ready = ready,
    .evaluate = lubricant_evaluate,
    .service = lubricant_service,
    .destroy = lubricant_destroy,
    .self_size = sizeof(grade),
};

const ff_model *flankfilm_model_v1(void)
{
    return &model;
}
