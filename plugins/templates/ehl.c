/* @ID@: the minimum film thickness of a line contact, h_min/R = 2.65 U^0.7 G^0.54 W^-0.13 (Dowson
   1968). Write your film into `evaluate`. */
#include <flankfilm/author.h>
#include <flankfilm/laws.h>

#include <math.h>
#include <stdlib.h>

typedef struct {
    const ff_host *host;
    const ff_viscosity *oil;
    double least_load;
} stage;

static const ff_param params[] = {
    FF_QUANTITY("least_load", "N/m", stage, least_load, 0, "100 N/m", NULL, 1e-3, 1e6, 0, 0,
                "load per width used instead of the load if the contact is lost"),
};

enum { TIME_IN, RADIUS, SPEED_1, SPEED_2, LOAD, MODULUS, VISCOSITY };

static const ff_port inputs[] = {
    [TIME_IN] = {.name = "contact.time", .unit = "s", .dims = "t", .doc = "time"},
    [RADIUS] = {.name = "contact.equivalent_radius", .unit = "m", .dims = "t", .doc = "R"},
    [SPEED_1] = {.name = "contact.speed_1", .unit = "m/s", .dims = "t", .doc = "surface speed u1"},
    [SPEED_2] = {.name = "contact.speed_2", .unit = "m/s", .dims = "t", .doc = "surface speed u2"},
    [LOAD] = {.name = "contact.load_per_width",
              .unit = "N/m",
              .dims = "t",
              .doc = "load per width"},
    [MODULUS] = {.name = "contact.reduced_modulus",
                 .unit = "Pa",
                 .dims = "",
                 .doc = "reduced modulus E': 2/E' = sum (1 - nu^2)/E"},
    [VISCOSITY] = {.name = "viscosity",
                   .unit = "",
                   .dims = "",
                   .doc = "viscosity of the oil",
                   .service = FF_VISCOSITY_ID},
};

enum { TIME, H_MIN, P_MAX, LOWEST };

static const ff_port outputs[] = {
    [TIME] = {.name = "time", .unit = "s", .dims = "t", .doc = "time"},
    [H_MIN] = {.name = "h_min", .unit = "m", .dims = "t", .doc = "minimum film thickness"},
    [P_MAX] = {.name = "p_max", .unit = "Pa", .dims = "t", .doc = "Hertz pressure"},
    [LOWEST] = {.name = "h_min_lowest",
                .unit = "m",
                .dims = "",
                .doc = "minimum of h_min over time"},
};

static ff_status wire(void *self, uint32_t input, const void *service)
{
    if (input == VISCOSITY)
        ((stage *)self)->oil = service;
    return FF_OK;
}

/* `wanted` has one bit per output; outputs that are not wanted may be left out. */
static ff_status evaluate(void *self, uint64_t wanted, const ff_array *in)
{
    const stage *s = self;
    const double ambient = 0, E = in[MODULUS].data[0];
    size_t count = in[TIME_IN].shape[0];
    double *time = ff_put_series(s->host, TIME, count);
    double *h = ff_put_series(s->host, H_MIN, count);
    double *p = ff_put_series(s->host, P_MAX, count);
    double ln_eta, alpha, lowest = 1;
    (void)wanted;
    if (!time || !h || !p)
        return FF_NOMEM;
    if (s->oil->eval(s->oil->self, 1, &ambient, NULL, &ln_eta, &alpha, NULL) < 0)
        return ff_failf(s->host, FF_INVALID, "viscosity",
                        "there is no viscosity at ambient pressure");
    alpha = fmax(alpha, 1e-10); /* 1/Pa; the formula is for oils whose viscosity rises with
                                   pressure */
    if (!(E > 1 && E < 1e15))
        return ff_failf(s->host, FF_INVALID, "contact.reduced_modulus",
                        "%g Pa is not a valid modulus", E);
    for (size_t i = 0; i < count; i++) {
        double R = in[RADIUS].data[i], w = fmax(in[LOAD].data[i], s->least_load);
        double u = fabs(in[SPEED_1].data[i] + in[SPEED_2].data[i]) / 2;
        if (!(R > 1e-9 && R < 1e9))
            return ff_failf(s->host, FF_INVALID, "contact.equivalent_radius",
                            "%g m is not a valid radius", R);
        if (!(u < 1e9 && w < 1e15))
            return ff_failf(s->host, FF_INVALID, "contact.speed_1",
                            "speed %g m/s or load per width %g N/m is out of range", u, w);
        time[i] = in[TIME_IN].data[i];
        h[i] = 2.65 * R * pow(exp(fmin(ln_eta, 100)) * u / (E * R), 0.7) * pow(alpha * E, 0.54) *
               pow(w / (E * R), -0.13);
        p[i] = sqrt(w * E / (2 * 3.141592653589793 * R));
        lowest = i ? fmin(lowest, h[i]) : h[i];
    }
    return ff_put_scalar(s->host, LOWEST, lowest);
}

FF_MODEL(model, stage, .id = "@ID@", .version = "0.1.0",
         .summary = "one line that says what the model is for",
         .reference = "Dowson 1968, Proc. IMechE 182", .bibtex = "", .licence = "MIT",
         .params = FF_TABLE(params), .inputs = FF_TABLE(inputs), .outputs = FF_TABLE(outputs),
         .wire = wire, .evaluate = evaluate, .destroy = free);
FF_EXPORT_MODELS(&model);
