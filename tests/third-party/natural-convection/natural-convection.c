/* SPDX-License-Identifier: MIT */
/*
 * housing/natural-convection: how warm the teeth and the housing of a gear pair get by its loss.
 * The kind is of its own. Its output closes a loop: the loss makes the heat, the heat warms the
 * teeth, and warm teeth have a thinner film and another loss.
 *
 * The housing loses h A (T_h - T_air) with h = 0.53 k/d (g beta (T_h - T_air) d^3/nu^2 Pr)^(1/4)
 * of a horizontal cylinder in air (McAdams 1954), which grows as (T_h - T_air)^(1/4):
 * T_h - T_air = (P/(c A))^(4/5), with c = 1.32/d^(1/4) W/(m2 K^(5/4)), d in m. The teeth are warmer
 * by P times the resistance between them and the housing.
 */
#include <flankfilm/author.h>

#include <math.h>
#include <stdlib.h>

typedef struct stage {
    const ff_host *host;
    double air, diameter, area, resistance;
} stage;

static const ff_param params[] = {
    FF_QUANTITY("air", "degC", stage, air, 0, "20 degC", NULL, -60, 60, 0, 0,
                "temperature around the housing"),
    FF_QUANTITY("diameter", "mm", stage, diameter, FF_REQUIRED, NULL, NULL, 10, 3000, 0, 0,
                "of the housing"),
    FF_QUANTITY("area", "m2", stage, area, FF_REQUIRED, NULL, NULL, 1e-4, 100, 0, 0,
                "of its surface"),
    FF_QUANTITY("resistance", "K/W", stage, resistance, 0, "0.05 K/W", NULL, 0, 100, 0, 0,
                "between teeth and housing"),
};

static const ff_port inputs[] = {
    {.name = "losses.power_loss_mean",
     .unit = "W",
     .dims = "",
     .doc = "loss of the mesh; in the first round of a loop there is none",
     .flags = FF_OPTIONAL | FF_FEEDBACK},
};

enum { BULK, HOUSING };

static const ff_port outputs[] = {
    [BULK] = {.name = "bulk_temperature", .unit = "K", .dims = "", .doc = "of the teeth"},
    [HOUSING] = {.name = "housing_temperature", .unit = "K", .dims = "", .doc = "of the housing"},
};

static ff_status evaluate(void *self, uint64_t wanted, const ff_array *in)
{
    const stage *s = self;
    double loss = in[0].data ? in[0].data[0] : 0; /* absent: as if nothing were lost */
    (void)wanted;
    if (!(loss >= 0 && loss < 1e9))
        return ff_failf(s->host, FF_INVALID, "losses.power_loss_mean", "%g W is no loss", loss);
    double c = 1.32 / pow(s->diameter, 0.25), housing = s->air + pow(loss / (c * s->area), 0.8);
    if (ff_put_scalar(s->host, HOUSING, housing) != FF_OK)
        return FF_NOMEM;
    return ff_put_scalar(s->host, BULK, housing + s->resistance * loss);
}

FF_MODEL(model, stage, .id = "housing/natural-convection", .version = "1.0.0",
         .summary = "teeth and housing warmed by the loss of the mesh, in still air",
         .reference = "McAdams 1954, Heat Transmission, 3rd ed., 7", .bibtex = "", .licence = "MIT",
         .params = FF_TABLE(params), .inputs = FF_TABLE(inputs), .outputs = FF_TABLE(outputs),
         .evaluate = evaluate, .destroy = free);
FF_EXPORT_MODELS(&model);
