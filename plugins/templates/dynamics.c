/* @ID@: the slow motion s = e + F/k, without inertia. Write your motion into `evaluate`. */
#include <flankfilm/author.h>

#include <math.h>
#include <stdlib.h>

typedef struct {
    const ff_host *host;
    double scale;
} stage;

static const ff_param params[] = {
    FF_QUANTITY("scale", "", stage, scale, 0, "1", NULL, 0, 10, 0, 0,
                "factor on the transmission error; replace it by your own parameters"),
};

enum { PHASE_IN, LTE, WS, FORCE };

static const ff_port inputs[] = {
    [PHASE_IN] = {.name = "stiffness.phase",
                  .unit = "1",
                  .dims = "phase",
                  .doc = "phase of the mesh cycle, 0 to 1; a repeated phase is a jump"},
    [LTE] = {.name = "stiffness.loaded_transmission_error",
             .unit = "m",
             .dims = "phase",
             .doc = "loaded transmission error e + F/k"},
    [WS] = {.name = "stiffness.tooth_force",
            .unit = "N",
            .dims = "station",
            .doc = "quasi-static force on one pair"},
    [FORCE] = {.name = "operating.line_force",
               .unit = "N",
               .dims = "",
               .doc = "force along the line of action"},
};

enum { PHASE, DTE, DMF, WD, RMS, PERIOD };

static const ff_port outputs[] = {
    [PHASE] = {.name = "phase",
               .unit = "1",
               .dims = "cycle",
               .doc = "phase in mesh cycles, from 0 to the period"},
    [DTE] = {.name = "dte", .unit = "m", .dims = "cycle", .doc = "transmission error s"},
    [DMF] = {.name = "mesh_force", .unit = "N", .dims = "cycle", .doc = "mesh force"},
    [WD] = {.name = "tooth_force",
            .unit = "N",
            .dims = "stiffness.station",
            .doc = "force on one pair"},
    [RMS] = {.name = "dte_rms", .unit = "m", .dims = "", .doc = "rms of the alternating part of s"},
    [PERIOD] = {.name = "period",
                .unit = "1",
                .dims = "",
                .doc = "period of the motion in mesh cycles"},
};

/* `wanted` has one bit per output; outputs that are not wanted may be left out. */
static ff_status evaluate(void *self, uint64_t wanted, const ff_array *in)
{
    const stage *s = self;
    size_t count = in[PHASE_IN].shape[0], stations = in[WS].shape[0];
    double *phase = ff_put_series(s->host, PHASE, count);
    double *dte = ff_put_series(s->host, DTE, count);
    double *dmf = ff_put_series(s->host, DMF, count);
    double *wd = ff_put_series(s->host, WD, stations);
    double mean = 0, square = 0, least = 0;
    (void)wanted;
    if (!phase || !dte || !dmf || !wd)
        return FF_NOMEM;
    for (size_t i = 0; i < count; i++) {
        phase[i] = in[PHASE_IN].data[i];
        dte[i] = s->scale * in[LTE].data[i];
        dmf[i] = in[FORCE].data[0];
        if (!(fabs(dte[i]) < 1))
            return ff_failf(s->host, FF_INVALID, "stiffness.loaded_transmission_error",
                            "%g m is not a valid transmission error", dte[i]);
    }
    for (size_t i = 1; i < count; i++)
        mean += (phase[i] - phase[i - 1]) * (dte[i] + dte[i - 1]) / 2; /* linear between phases */
    for (size_t i = 1; i < count; i++) {
        double a = dte[i - 1] - mean, b = dte[i] - mean;
        square += (phase[i] - phase[i - 1]) * (a * a + a * b + b * b) / 3;
    }
    for (size_t i = 0; i < stations; i++) {
        wd[i] = in[WS].data[i];
        least = fmin(least, wd[i]);
    }
    s->host->quality(s->host->ctx, "pull", -least, 0, least < 0 ? FF_BAD : FF_GOOD,
                     "largest tensile force on a tooth");
    if (ff_put_scalar(s->host, RMS, sqrt(fmax(0, square))) != FF_OK)
        return FF_NOMEM;
    return ff_put_scalar(s->host, PERIOD, 1);
}

FF_MODEL(model, stage, .id = "@ID@", .version = "0.1.0",
         .summary = "one line that says what the model is for", .reference = "", .bibtex = "",
         .licence = "MIT", .params = FF_TABLE(params), .inputs = FF_TABLE(inputs),
         .outputs = FF_TABLE(outputs), .evaluate = evaluate, .destroy = free);
FF_EXPORT_MODELS(&model);
