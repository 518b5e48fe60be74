/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Laws that were fitted to the same data: which could not be, which is the best, and what is said
   of them. */
#include "laws.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

const fitted *fit_best(const comparison *c)
{
    const fitted *best = NULL;
    for (size_t i = 0; i < c->count; i++)
        if (c->laws[i].told && !c->laws[i].why &&
            (!best || c->laws[i].found.criterion < best->found.criterion))
            best = &c->laws[i];
    return best;
}

const ff_param *fit_column(const ff_comparison_request *r, size_t column)
{
    const void *row = (const char *)r->fitter->columns + column * r->fitter->column_stride;
    return (const ff_param *)row;
}

void fit_range(const ff_comparison_request *r, size_t column, double *low, double *high)
{
    const double *values = r->fit->columns[column];
    *low = *high = values[0];
    for (size_t i = 1; i < r->fit->row_count; i++) {
        *low = fmin(*low, values[i]);
        *high = fmax(*high, values[i]);
    }
}

static bool make_room(comparison *c, const ff_comparison_request *r)
{
    if (c->laws)
        return true;
    c->laws = calloc(r->fit->law_count + 1, sizeof *c->laws);
    c->count = c->laws ? r->fit->law_count : 0;
    for (size_t i = 0; i < c->count; i++)
        c->laws[i].law = r->fit->laws[i];
    return c->laws != NULL;
}

/* What there is no memory for stays untold. */
static void take_found(void *self, const ff_comparison_request *r, const ff_fit_found *found)
{
    comparison *c = self;
    if (!make_room(c, r) || found->law >= c->count || c->laws[found->law].told)
        return;
    fitted *f = &c->laws[found->law];
    size_t count = f->law->param_count;
    f->found = *found;
    if (found->why) {
        f->why = strdup(found->why);
        f->told = f->why != NULL;
        return;
    }
    f->values = calloc(count + 1, sizeof *f->values);
    f->correlation = calloc(count * count + 1, sizeof *f->correlation);
    f->note = strdup(found->note ? found->note : "");
    f->told = f->values && f->correlation && f->note && found->largest_row < r->fit->row_count;
    for (size_t i = 0; f->told && i < count; i++)
        f->values[i] = *found->values[i];
    if (f->told && count)
        memcpy(f->correlation, found->correlation, count * count * sizeof(double));
}

static const char *why_not(const fitted *f)
{
    return f->told ? f->why : "the fitter says nothing of it";
}

/* A law that cannot be fitted is an error when it was named, or when no other is left. */
static ff_status judge_laws(const comparison *c, const ff_comparison_request *r)
{
    bool none = !fit_best(c), same = none && c->count > 1;
    ff_status status = FF_OK;
    char text[700];
    for (size_t i = 1; same && i < c->count; i++)
        same = c->laws[0].why && c->laws[i].why && !strcmp(c->laws[0].why, c->laws[i].why);
    if (same) {
        snprintf(text, sizeof text, "none of %zu laws can be fitted: %s", c->count, c->laws[0].why);
        return r->refuse(r->ctx, text);
    }
    for (size_t i = 0; i < c->count; i++) {
        const char *why = why_not(&c->laws[i]);
        bool wrong = none || r->named;
        if (!why)
            continue;
        snprintf(text, sizeof text, "%s %s fitted: %s", c->laws[i].law->id,
                 wrong ? "cannot be" : "is not", why);
        if (wrong)
            status = r->refuse(r->ctx, text);
        else
            r->warn(r->ctx, text);
    }
    return status;
}

static ff_status judge(void *self, const ff_comparison_request *r)
{
    comparison *c = self;
    if (!make_room(c, r))
        return FF_NOMEM;
    ff_status status = judge_laws(c, r);
    if (status != FF_OK)
        return status;
    char *facts = fit_facts(c, r);
    if (!facts)
        return FF_NOMEM;
    r->facts(r->ctx, facts);
    free(facts);
    return FF_OK;
}

static ff_status print(void *self, const ff_comparison_request *r)
{
    fit_print(self, r);
    return FF_OK;
}

static ff_status create(const ff_host *host, void **self)
{
    comparison *c = calloc(1, sizeof *c);
    if (!c)
        return FF_NOMEM;
    (void)host;
    c->service = (ff_comparison){
        .size = sizeof c->service, .self = c, .found = take_found, .judge = judge, .print = print};
    *self = c;
    return FF_OK;
}

static const void *service(void *self, uint32_t output)
{
    (void)output;
    return &((comparison *)self)->service;
}

static void destroy(void *self)
{
    comparison *c = self;
    if (!c)
        return;
    for (size_t i = 0; i < c->count; i++) {
        free(c->laws[i].values);
        free(c->laws[i].correlation);
        free(c->laws[i].why);
        free(c->laws[i].note);
    }
    free(c->laws);
    free(c);
}

static const ff_port outputs[] = {{.name = "comparison",
                                   .unit = "",
                                   .doc = "says which fitted law is the best",
                                   .dims = "",
                                   .service = FF_COMPARISON_ID}};

static const ff_model model = {
    .size = sizeof model,
    .abi_major = FF_ABI_MAJOR,
    .abi_minor = 1,
    .id = "comparison/laws",
    .version = "1.0.0",
    .summary = "what `fit` says of laws: their parameters, deviations and which is the best",
    .reference = "",
    .bibtex = "",
    .licence = "GPL-3.0-or-later",
    .params = FF_NO_TABLE,
    .inputs = FF_NO_TABLE,
    .outputs = FF_TABLE(outputs),
    .create = create,
    .service = service,
    .destroy = destroy,
};

const ff_model *flankfilm_model_v1(void)
{
    return &model;
}
