/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The discretisation of tests/third-party, which is linked in, right but for the one fault. */
#define STUB_MORE .service = stub_service, .ready = ready
#include "stub.h"

const ff_model *penalty_model(void);

static const ff_port inputs[] = {
    {.name = "any.level", .unit = "m", .doc = "nothing", .dims = "", .flags = FF_OPTIONAL}};
static const ff_port outputs[] = {
    {.name = "discretisation", .unit = "", .doc = "the film", .dims = "", .service = FF_FILM_ID}};

typedef struct solver {
    const ff_film *right;
    const ff_film_contact *given;
    ff_film_contact contact;
    ff_viscosity viscosity;
    void *inner, *instance;
} solver;

static ff_status thick(const void *self, size_t n, const double *p, const double *T, double *ln_eta,
                       double *dln_dp, double *dln_dT)
{
    const ff_viscosity *law = ((const solver *)self)->given->viscosity;
    ff_status status = law->eval(law->self, n, p, T, ln_eta, dln_dp, dln_dT);
    for (size_t i = 0; i < n; i++)
        ln_eta[i] += log(1.2);
    return status;
}

static ff_status solve(void *self, const ff_film_instant *instant, ff_film_state *film)
{
    solver *s = self;
    ff_film_instant at = *instant;
    at.entrainment *= off("wedge", 2);
    if (is("no-squeeze")) {
        at.rate = 0;
        at.past = NULL;
    }
    return s->right->solve(s->inner, &at, film);
}

static void close_solver(void *self)
{
    solver *s = self;
    if (!s)
        return;
    s->right->close(s->inner);
    penalty_model()->destroy(s->instance);
    free(s);
}

static ff_status open_solver(const void *self, const ff_film_contact *contact, void **made)
{
    const stub *m = self;
    solver *s = calloc(1, sizeof *s);
    if (!s)
        return FF_NOMEM;
    if (penalty_model()->create(m->host, &s->instance) != FF_OK) {
        free(s);
        return FF_NOMEM;
    }
    s->right = penalty_model()->service(s->instance, 0);
    s->given = contact;
    s->contact = *contact;
    s->viscosity = (ff_viscosity){sizeof s->viscosity, s, thick};
    s->contact.modulus *= off("soft", 0.8);
    if (is("thick"))
        s->contact.viscosity = &s->viscosity;
    if (is("newtonian"))
        s->contact.rheology = NULL;
    ff_status status = s->right->open(s->right->self, &s->contact, &s->inner);
    if (status != FF_OK) {
        s->inner = NULL;
        close_solver(s);
        return status;
    }
    *made = s;
    return FF_OK;
}

static ff_status ready(void *self)
{
    stub *s = self;
    s->service.film = (ff_film){sizeof s->service.film, s, open_solver, solve, close_solver};
    return FF_OK;
}

STUB_MODEL
