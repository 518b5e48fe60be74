/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A stage of interface 1.0 that takes all outputs of another one and appends their bits to a file.
   It is compiled once for each model: ROWS is a file with an input row for each output, ID its id.
 */
#include <flankfilm/author.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct sink {
    const ff_host *host;
    char path[4096];
} sink;

static const ff_param params[] = {{.name = "file",
                                   .unit = "",
                                   .doc = "where the bits go",
                                   .type = FF_TEXT,
                                   .flags = FF_REQUIRED}};
static const ff_port inputs[] = {
#include ROWS
};
static const ff_port outputs[] = {
    {.name = "taken", .unit = "1", .doc = "number of arrays", .dims = ""}};

static ff_status create(const ff_host *host, void **self)
{
    sink *s = calloc(1, sizeof *s);
    *self = s;
    if (s)
        s->host = host;
    return s ? FF_OK : FF_NOMEM;
}

static ff_status set(void *self, uint32_t param, const ff_value *value)
{
    sink *s = self;
    (void)param;
    snprintf(s->path, sizeof s->path, "%s", value->text);
    return FF_OK;
}

static ff_status evaluate(void *self, uint64_t wanted, const ff_array *in)
{
    const sink *s = self;
    double taken = 0;
    FILE *file = fopen(s->path, "ab");
    (void)wanted;
    for (size_t i = 0; file && i < sizeof inputs / sizeof inputs[0]; i++) {
        size_t count = 1;
        if (!in[i].data)
            continue;
        fputs(strchr(inputs[i].name, '.') + 1, file);
        for (uint32_t k = 0; k < in[i].rank; count *= in[i].shape[k++])
            fprintf(file, " %zu", in[i].shape[k]);
        fputc('\n', file);
        fwrite(in[i].data, sizeof *in[i].data, count, file);
        taken++;
    }
    if (!file || fclose(file) != 0)
        return ff_failf(s->host, FF_INVALID, "file", "it cannot be written");
    return ff_put_scalar(s->host, 0, taken);
}

static const ff_model model = {
    .size = sizeof model,
    .abi_major = FF_ABI_MAJOR,
    .abi_minor = FF_ABI_MINOR,
    .id = ID,
    .version = "1.0.0",
    .summary = "keeps the bits of another stage",
    .reference = "",
    .bibtex = "",
    .licence = "GPL-3.0-or-later",
    .params = FF_TABLE(params),
    .inputs = FF_TABLE(inputs),
    .outputs = FF_TABLE(outputs),
    .create = create,
    .set = set,
    .evaluate = evaluate,
    .destroy = free,
};

FF_EXPORT const ff_model *flankfilm_model_v1(void)
{
    return &model;
}
