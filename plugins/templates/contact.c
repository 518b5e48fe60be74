/* @ID@: a steady line contact. Write the history of your contact into `evaluate`. */
#include <flankfilm/author.h>

#include <math.h>
#include <stdlib.h>

typedef struct {
    const ff_host *host;
    double radius, speed, slide, load, modulus;
} stage;

static const ff_param params[] = {
    FF_QUANTITY("radius", "mm", stage, radius, FF_REQUIRED, NULL, NULL, 1e-3, 1e6, 0, 0,
                "equivalent radius R, 1/R = 1/R1 + 1/R2"),
    FF_QUANTITY("entrainment_speed", "m/s", stage, speed, FF_REQUIRED, NULL, NULL, 0, 1e4, 0, 0,
                "entrainment speed u_r = (u1 + u2)/2"),
    FF_QUANTITY("slide_roll_ratio", "", stage, slide, 0, "0", NULL, -2, 2, 0, 0, "(u1 - u2)/u_r"),
    FF_QUANTITY("load_per_width", "N/mm", stage, load, FF_REQUIRED, NULL, NULL, 0, 1e6, 0, 0,
                "load per width of the contact"),
    FF_QUANTITY("reduced_modulus", "GPa", stage, modulus, 0, "226.4 GPa", NULL, 1e-3, 1e5, 0, 0,
                "reduced modulus E': 2/E' = sum (1 - nu^2)/E"),
};

enum { TIME, EQUIVALENT, SPEED_1, SPEED_2, LOAD, WIDTH, PRESSURE, REDUCED };

static const ff_port outputs[] = {
    [TIME] = {.name = "time",
              .unit = "s",
              .dims = "t",
              .doc = "time; one instant: a steady contact"},
    [EQUIVALENT] = {.name = "equivalent_radius",
                    .unit = "m",
                    .dims = "t",
                    .doc = "equivalent radius R"},
    [SPEED_1] = {.name = "speed_1", .unit = "m/s", .dims = "t", .doc = "surface speed u1"},
    [SPEED_2] = {.name = "speed_2", .unit = "m/s", .dims = "t", .doc = "surface speed u2"},
    [LOAD] = {.name = "load_per_width", .unit = "N/m", .dims = "t", .doc = "load per width"},
    [WIDTH] = {.name = "hertz_half_width",
               .unit = "m",
               .dims = "t",
               .doc = "half width of the dry contact"},
    [PRESSURE] = {.name = "hertz_pressure",
                  .unit = "Pa",
                  .dims = "t",
                  .doc = "maximum pressure of the dry contact"},
    [REDUCED] = {.name = "reduced_modulus", .unit = "Pa", .dims = "", .doc = "E'"},
};

/* `wanted` has one bit per output; outputs that are not wanted may be left out. */
static ff_status evaluate(void *self, uint64_t wanted, const ff_array *in)
{
    const stage *s = self;
    const double pi = 3.141592653589793;
    const double width = sqrt(8 * s->load * s->radius / (pi * s->modulus));
    const double value[] = {0,
                            s->radius,
                            s->speed * (1 + s->slide / 2),
                            s->speed * (1 - s->slide / 2),
                            s->load,
                            width,
                            width > 0 ? 2 * s->load / (pi * width) : 0};
    (void)wanted, (void)in;
    for (uint32_t i = TIME; i <= PRESSURE; i++) {
        double *series = ff_put_series(s->host, i, 1);
        if (!series)
            return FF_NOMEM;
        series[0] = value[i];
    }
    return ff_put_scalar(s->host, REDUCED, s->modulus);
}

FF_MODEL(model, stage, .id = "@ID@", .version = "0.1.0",
         .summary = "one line that says what the model is for", .reference = "", .bibtex = "",
         .licence = "MIT", .params = FF_TABLE(params), .outputs = FF_TABLE(outputs),
         .evaluate = evaluate, .destroy = free);
FF_EXPORT_MODELS(&model);
