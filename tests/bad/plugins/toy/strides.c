/* SPDX-License-Identifier: GPL-3.0-or-later */
/* toy/strides has longer rows and a longer descriptor than this version knows; toy/short the rows
   and the descriptor of version 1.0. */
#include <flankfilm/author.h>

#include <string.h>

typedef struct strides {
    const ff_host *host;
    double first, second;
} strides;

enum { SHORT = offsetof(ff_param, place), ROWS = 2 };

typedef struct long_row {
    ff_param row;
    const void *future[3];
} long_row;

static const void *const unknown = "what a later version has there";
static const long_row long_rows[ROWS] = {
    {FF_QUANTITY("first", "m", strides, first, 0, "1 m", NULL, 0, 0, 0, 0, "a length"),
     {"x", "x", "x"}},
    {FF_QUANTITY("second", "m", strides, second, 0, "2 m", NULL, 0, 0, 0, 0, "a length"),
     {"x", "x", "x"}},
};

static const ff_port outputs[] = {{.name = "sum", .unit = "m", .doc = "of both", .dims = ""}};

static ff_status evaluate(void *self, uint64_t wanted, const ff_array *in)
{
    const strides *s = self;
    (void)wanted, (void)in;
    return ff_put_scalar(s->host, 0, s->first + s->second);
}

static ff_status set(void *self, uint32_t param, const ff_value *value)
{
    *(param ? &((strides *)self)->second : &((strides *)self)->first) = value->real;
    return FF_OK;
}

FF_MODEL(long_model, strides, .id = "toy/strides", .version = "1.0.0",
         .summary = "Rows of a later version", .reference = "", .bibtex = "",
         .licence = "GPL-3.0-or-later", .params = &long_rows[0].row, .param_count = ROWS,
         .param_stride = sizeof long_rows[0], .outputs = FF_TABLE(outputs), .evaluate = evaluate,
         .destroy = free);

static const ff_model *longer(void)
{
    static struct {
        ff_model model;
        const void *future[4];
    } whole;
    whole.model = long_model;
    whole.model.size = sizeof whole;
    whole.future[0] = unknown;
    return &whole.model;
}

/* Memory of the exact sizes of version 1.0. */
static const ff_model *shorter(void)
{
    enum { SIZE = offsetof(ff_model, carry) };
    static char *rows, *model;
    if (model)
        return (const void *)model;
    rows = malloc((size_t)ROWS * SHORT);
    model = malloc(SIZE);
    if (!rows || !model)
        return NULL;
    for (size_t i = 0; i < ROWS; i++)
        memcpy(rows + i * SHORT, &long_rows[i].row, SHORT);
    ff_model whole = long_model;
    whole.size = SIZE;
    whole.abi_minor = 0;
    whole.id = "toy/short";
    whole.params = (const void *)rows;
    whole.param_stride = SHORT;
    whole.set = set;
    memcpy(model, &whole, SIZE);
    return (const void *)model;
}

FF_EXPORT const ff_model *const *flankfilm_models_v1(void)
{
    static const ff_model *list[3];
    list[0] = longer();
    list[1] = shorter();
    return list;
}
