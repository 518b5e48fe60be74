/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Says what its parameters and inputs serve: two outputs that have nothing to do with each other.
 */
#include <flankfilm/author.h>

typedef struct frugal {
    const ff_host *host;
    double form, finish, step, note;
    int32_t fixed, wrong;
    const char *table;
} frugal;

static const ff_param params[] = {
    FF_QUANTITY("form", "1", frugal, form, 0, NULL, NULL, 0, 0, 0, 0, "what shape is made of"),
    FF_QUANTITY("finish", "1", frugal, finish, 0, NULL, NULL, 0, 0, 0, 0, "what shade is made of"),
    FF_QUANTITY("step", "1", frugal, step, 0, "1", NULL, 0, 0, 0, 0, "unless fixed"),
    FF_QUANTITY("note", "kg", frugal, note, 0, NULL, NULL, 0, 0, 0, 0, "a text in toy/source"),
    FF_SWITCH("fixed", frugal, fixed, "false", "then step serves nothing"),
    FF_PATH("table", frugal, table, 0, NULL, "with a column that fixed leaves unread"),
    FF_SWITCH("wrong", frugal, wrong, "false", "then it names a parameter that it does not have"),
};

static const ff_param columns[] = {
    FF_ROW("depth", "m", "of anything", FF_REALS, 0, NULL, NULL, NULL, 0, 0, 0, 0, 0, 0, 0),
};

static const ff_port inputs[] = {
    {.name = "before.shape",
     .unit = "1",
     .doc = "added to form",
     .dims = "",
     .flags = FF_OPTIONAL,
     .from = "nobody"},
    {.name = "before.shade",
     .unit = "1",
     .doc = "where finish is not given",
     .dims = "",
     .flags = FF_OPTIONAL,
     .from = "nobody"},
};

enum { OUT_SHAPE, OUT_SHADE };

static const ff_port outputs[] = {
    {.name = "shape", .unit = "1", .doc = "from form alone", .dims = ""},
    {.name = "shade", .unit = "1", .doc = "from finish alone", .dims = ""},
};

static ff_status ready(void *self)
{
    const frugal *f = self;
    const ff_serving rows[] = {
        {1, "form", "shape", NULL, NULL},
        {1, "finish", "shade", NULL, NULL},
        {f->fixed, "step", "", NULL, "fixed is on"},
        {f->fixed && f->table, "table.depth", "", NULL, "fixed is on"},
        {1, "before.shape", "shape", NULL, NULL},
        {1, "before.shade", "shade", NULL, NULL},
        {!isnan(f->finish), "before.shade", "", "finish", "finish is given"},
        {f->wrong, "finnish", "", NULL, NULL},
    };
    ff_serve(f->host, rows, sizeof rows / sizeof rows[0]);
    return FF_OK;
}

static ff_status evaluate(void *self, uint64_t wanted, const ff_array *in)
{
    const frugal *f = self;
    (void)in;
    ff_status status = wanted & FF_BIT(OUT_SHAPE) ? ff_put_scalar(f->host, OUT_SHAPE, 1) : FF_OK;
    return status == FF_OK && wanted & FF_BIT(OUT_SHADE) ? ff_put_scalar(f->host, OUT_SHADE, 2)
                                                         : status;
}

FF_MODEL(frugal_model, frugal, .id = "toy/frugal", .version = "1.0.0",
         .summary = "a shape and a shade", .reference = "", .bibtex = "",
         .licence = "GPL-3.0-or-later", .params = FF_TABLE(params), .inputs = FF_TABLE(inputs),
         .outputs = FF_TABLE(outputs), .ready = ready, .evaluate = evaluate, .destroy = free,
         .columns = FF_TABLE(columns));
FF_EXPORT_MODELS(&frugal_model);
