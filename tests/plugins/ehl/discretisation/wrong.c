/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A discretisation with deliberate errors, which the checks of ehl/finite-volume must find. */
#include <flankfilm/author.h>
#include <flankfilm/film.h>

#include <math.h>
#include <stdlib.h>

enum { SLOW, NO_SQUEEZE, THICK, SOFT, LIGHT, LAZY, SUCTION, NAN_PRESSURE, STUBBORN, TALKING };

typedef struct wrong {
    const ff_host *host;
    int fault;
    const ff_film *of;
    ff_film service;
} wrong;

typedef struct solver {
    const wrong *w;
    const ff_film_contact *right;
    ff_film_contact contact;
    ff_viscosity viscosity;
    void *solver;
    size_t calls;
} solver;

static ff_status thick(const void *self, size_t n, const double *p, const double *T, double *ln_eta,
                       double *dln_dp, double *dln_dT)
{
    const solver *s = self;
    const ff_viscosity *law = s->right->viscosity;
    ff_status status = law->eval(law->self, n, p, T, ln_eta, dln_dp, dln_dT);
    for (size_t i = 0; i < n; i++)
        ln_eta[i] += log(1.2);
    return status;
}

static ff_status open_solver(const void *self, const ff_film_contact *contact, void **made)
{
    const wrong *w = self;
    solver *s = calloc(1, sizeof *s);
    if (!s)
        return FF_NOMEM;
    *s = (solver){.w = w, .right = contact, .contact = *contact};
    s->viscosity = (ff_viscosity){sizeof s->viscosity, s, thick};
    if (w->fault == THICK)
        s->contact.viscosity = &s->viscosity;
    if (w->fault == SOFT)
        s->contact.modulus *= 0.9;
    ff_status status = w->of->open(w->of->self, &s->contact, &s->solver);
    if (status != FF_OK) {
        free(s);
        return status;
    }
    *made = s;
    return FF_OK;
}

static ff_status solve(void *self, const ff_film_instant *instant, ff_film_state *film)
{
    solver *s = self;
    const wrong *w = s->w;
    const size_t n = s->contact.nodes;
    ff_film_instant at = *instant;
    if (w->fault == LAZY)
        return FF_OK;
    if (w->fault == TALKING && instant->past)
        return ff_failf(w->host, FF_NOCONV, NULL, "the sweep %d diverges", 7);
    if (w->fault == STUBBORN && instant->past && s->calls++ % 3)
        return FF_NOCONV;
    if (w->fault == SLOW)
        at.entrainment *= 0.9;
    if (w->fault == NO_SQUEEZE) {
        at.rate = 0;
        at.past = NULL;
    }
    if (w->fault == LIGHT)
        at.load *= 0.999;
    ff_status status = w->of->solve(s->solver, &at, film);
    for (size_t i = 1; i + 1 < n && w->fault == SUCTION; i++) {
        film->p[i] -= film->full[i] ? 0 : 0.02 * s->contact.pressure;
        film->full[i] = 1;
    }
    if (w->fault == NAN_PRESSURE)
        film->p[n / 2] = NAN;
    return status;
}

static void close_solver(void *self)
{
    solver *s = self;
    if (s)
        s->w->of->close(s->solver);
    free(s);
}

static ff_status create(const ff_host *host, void **self)
{
    wrong *w = calloc(1, sizeof *w);
    if (!w)
        return FF_NOMEM;
    w->host = host;
    w->service = (ff_film){sizeof w->service, w, open_solver, solve, close_solver};
    *self = w;
    return FF_OK;
}

static ff_status set(void *self, uint32_t param, const ff_value *value)
{
    wrong *w = self;
    (void)param;
    w->fault = (int)value->integer;
    return FF_OK;
}

static ff_status wire(void *self, uint32_t input, const void *service)
{
    wrong *w = self;
    (void)input;
    w->of = service;
    return FF_OK;
}

static const void *service(void *self, uint32_t output)
{
    return output == 0 ? &((wrong *)self)->service : NULL;
}

static const ff_param params[] = {
    {.name = "fault",
     .unit = "",
     .doc = "what is wrong",
     .type = FF_CHOICE,
     .flags = FF_REQUIRED,
     .choices = "slow|no-squeeze|thick|soft|light|lazy|suction|nan|stubborn|talking"},
};

static const ff_port inputs[] = {
    {.name = "of",
     .unit = "",
     .doc = "what is spoiled",
     .dims = "",
     .service = FF_FILM_ID,
     .from = "discretisation"},
};

static const ff_port outputs[] = {
    {.name = "discretisation",
     .unit = "",
     .doc = "the spoiled film",
     .dims = "",
     .service = FF_FILM_ID},
};

static const ff_model model = {
    .size = sizeof model,
    .abi_major = FF_ABI_MAJOR,
    .abi_minor = 0,
    .id = "discretisation/wrong",
    .version = "1.0.0",
    .summary = "wrong films, for tests",
    .reference = "none",
    .bibtex = "@misc{none, title={none}}",
    .licence = "GPL-3.0-or-later",
    .params = FF_TABLE(params),
    .inputs = FF_TABLE(inputs),
    .outputs = FF_TABLE(outputs),
    .create = create,
    .set = set,
    .wire = wire,
    .service = service,
    .destroy = free,
};

const ff_model *flankfilm_model_v1(void)
{
    return &model;
}
