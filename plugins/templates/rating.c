/* @ID@: the film thickness divided by the roughness of the flanks, compared with a required value.
   Write your rating into `evaluate`. */
#include <flankfilm/author.h>

#include <math.h>
#include <stdlib.h>

typedef struct {
    const ff_host *host;
    double least;
} stage;

static const ff_param params[] = {
    FF_QUANTITY("least_lambda", "", stage, least, FF_MIN_OPEN, "1", NULL, 0, 100, 0, 0,
                "required film over roughness"),
};

enum { FILM, ROUGHNESS };

static const ff_port inputs[] = {
    [FILM] = {.name = "ehl.h_min", .unit = "m", .dims = "t", .doc = "least film"},
    [ROUGHNESS] = {.name = "gear.roughness",
                   .unit = "m",
                   .dims = "gear",
                   .doc = "root mean square roughness of both flanks"},
};

enum { LAMBDA, SAFETY };

static const ff_port outputs[] = {
    [LAMBDA] = {.name = "lambda", .unit = "1", .dims = "", .doc = "minimum film over roughness"},
    [SAFETY] = {.name = "safety", .unit = "1", .dims = "", .doc = "lambda over least_lambda"},
};

/* `wanted` has one bit per output; outputs that are not wanted may be left out. */
static ff_status evaluate(void *self, uint64_t wanted, const ff_array *in)
{
    const stage *s = self;
    double square = 0, film = INFINITY;
    (void)wanted;
    for (size_t i = 0; i < in[ROUGHNESS].shape[0]; i++)
        square += in[ROUGHNESS].data[i] * in[ROUGHNESS].data[i];
    for (size_t i = 0; i < in[FILM].shape[0]; i++)
        film = fmin(film, in[FILM].data[i]);
    if (!(square > 1e-24 && square < 1e6))
        return ff_failf(s->host, FF_INVALID, "gear.roughness",
                        "the rating needs the roughness of "
                        "the flanks");
    if (!(film > 0 && film < 1e3))
        return ff_failf(s->host, FF_INVALID, "ehl.h_min", "the film thickness is not finite");
    double lambda = film / sqrt(square);
    if (ff_put_scalar(s->host, LAMBDA, lambda) != FF_OK)
        return FF_NOMEM;
    return ff_put_scalar(s->host, SAFETY, lambda / s->least);
}

FF_MODEL(model, stage, .id = "@ID@", .version = "0.1.0",
         .summary = "one line that says what the model is for", .reference = "", .bibtex = "",
         .licence = "MIT", .params = FF_TABLE(params), .inputs = FF_TABLE(inputs),
         .outputs = FF_TABLE(outputs), .evaluate = evaluate, .destroy = free);
FF_EXPORT_MODELS(&model);
