/* SPDX-License-Identifier: MIT */
/*
 * rating/shear-stress: how far the largest shear stress below a line contact stays from yield.
 *
 * The pressure of the film, with its spike, loads a half-space (Johnson 1985, 2.5):
 *
 *   sigma_x = -2 z/pi int p(s) (x - s)^2/r^4 ds,   sigma_z = -2 z^3/pi int p(s)/r^4 ds,
 *   tau_xz = -2 z^2/pi int p(s) (x - s)/r^4 ds,   r^2 = (x - s)^2 + z^2,
 *
 * and the largest shear stress of a place is sqrt((sigma_x - sigma_z)^2/4 + tau_xz^2). Under
 * Hertz's pressure its largest value is 0.300 p_H, 0.786 half widths deep. Steel yields in shear at
 * k = H/6, from a hardness H = 3 Y and Tresca's Y = 2 k. Friction on the flanks is left out. The
 * step of the film in question is that of the largest load over half width, to which the half width
 * is taken from the contact at the same instant.
 */
#include <flankfilm/author.h>
#include <flankfilm/history.h>

#include <math.h>
#include <stdlib.h>

typedef struct stage {
    const ff_host *host;
    double hardness;
    int64_t points;
} stage;

static const ff_param params[] = {
    FF_QUANTITY("hardness", "GPa", stage, hardness, FF_REQUIRED, NULL, NULL, 0.5, 20, 1, 10,
                "hardness of the softer flank: HV 700 is 6.9 GPa"),
    FF_COUNT("points", stage, points, FF_TUNABLE, "40", NULL, 4, 1000, 0, 0,
             "places along the half width and down to two of them where the stress is looked at"),
};

enum { TIME, X, PRESSURE, CONTACT_TIME, HALF_WIDTH };

static const ff_port inputs[] = {
    [TIME] = {.name = "ehl.time", .unit = "s", .dims = "t", .doc = "steps of the film"},
    [X] = {.name = "ehl.x", .unit = "m", .dims = "x", .doc = "along the motion"},
    [PRESSURE] = {.name = "ehl.pressure", .unit = "Pa", .dims = "t x", .doc = "of the film"},
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

static double load_of(const ff_array *x, const double *p)
{
    double load = 0;
    for (size_t i = 1; i < x->shape[0]; i++)
        load += (x->data[i] - x->data[i - 1]) * (p[i] + p[i - 1]) / 2;
    return load;
}

/* The pressure is constant around each node, which the depth smooths out. */
static double shear_at(const ff_array *grid, const double *p, double x, double z)
{
    double along = 0, down = 0, across = 0;
    for (size_t i = 1; i + 1 < grid->shape[0]; i++) {
        double far = x - grid->data[i], r2 = far * far + z * z,
               share =
                   p[i] * (grid->data[i + 1] - grid->data[i - 1]) / (3.141592653589793 * r2 * r2);
        along -= share * z * far * far;
        down -= share * z * z * z;
        across -= share * z * z * far;
    }
    return hypot((along - down) / 2, across);
}

static ff_status evaluate(void *self, uint64_t wanted, const ff_array *in)
{
    const stage *s = self;
    const size_t steps = in[TIME].shape[0], nodes = in[X].shape[0];
    double *half_width = malloc((steps + 1) * sizeof *half_width), most = 0, stress = 0, depth = 0;
    (void)wanted;
    if (!half_width)
        return FF_NOMEM;
    size_t worst = steps;
    if (ff_history_at(in[CONTACT_TIME].shape[0], in[CONTACT_TIME].data, in[HALF_WIDTH].data, steps,
                      in[TIME].data, half_width) != FF_INVALID)
        for (size_t i = 0; i < steps; i++) {
            double load = load_of(&in[X], in[PRESSURE].data + i * nodes);
            if (half_width[i] > 1e-9 && half_width[i] < 1 && load / half_width[i] > most &&
                load < 1e12) {
                most = load / half_width[i];
                worst = i;
            }
        }
    double width = worst < steps ? half_width[worst] : 0;
    free(half_width);
    if (worst == steps)
        return ff_failf(s->host, FF_INVALID, "ehl.pressure", "no pressure loads the flanks");
    for (int64_t i = -s->points; i <= s->points; i++)
        for (int64_t k = 1; k <= s->points; k++) {
            double z = 2 * width * (double)k / (double)s->points,
                   found = shear_at(&in[X], in[PRESSURE].data + worst * nodes,
                                    width * (double)i / (double)s->points, z);
            if (found > stress) {
                stress = found;
                depth = z;
            }
        }
    if (!(stress > 1 && stress < 1e13))
        return ff_failf(s->host, FF_INVALID, "ehl.x", "the pressure is not that of a contact");
    const double values[] = {stress, depth, s->hardness / 6 / stress};
    for (uint32_t i = STRESS; i <= SAFETY; i++)
        if (ff_put_scalar(s->host, i, values[i]) != FF_OK)
            return FF_NOMEM;
    return FF_OK;
}

FF_MODEL(model, stage, .id = "rating/shear-stress", .version = "1.0.0",
         .summary = "yield in shear below the flanks, by the pressure of the film",
         .reference = "Johnson 1985, Contact Mechanics, 2.5, 4.2 and 6.3", .bibtex = "",
         .licence = "MIT", .params = FF_TABLE(params), .inputs = FF_TABLE(inputs),
         .outputs = FF_TABLE(outputs), .evaluate = evaluate, .destroy = free);
FF_EXPORT_MODELS(&model);
