/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A film that follows a history by implicit steps, each of which the discretisation of
   tests/third-party solves, which is linked in. */
#define STUB_MORE                                                                                  \
    .evaluate = evaluate, .wire = stub_wire, .params = FF_TABLE(params), .set = stub_set
#include "stub.h"

const ff_model *penalty_model(void);

enum { NODES = 257 };
enum { OIL, DENSITY, T, R, U1, U2, LOAD, MODULUS };
enum { TIME, X, PRESSURE, FILM, H, LOWEST, ERROR, MASS };

static const ff_param params[] = {
    {.name = "inlet", .unit = "1", .doc = "in front", .type = FF_REAL, .preset = "2", .max = 1e9},
    {.name = "outlet", .unit = "1", .doc = "behind", .type = FF_REAL, .preset = "1.2", .max = 1e9}};

static const ff_port inputs[] = {
    {.name = "viscosity", .unit = "", .doc = "oil", .dims = "", .service = FF_VISCOSITY_ID},
    {.name = "density", .unit = "", .doc = "oil", .dims = "", .service = FF_DENSITY_ID},
    {.name = "contact.time", .unit = "s", .doc = "time", .dims = "t"},
    {.name = "contact.equivalent_radius", .unit = "m", .doc = "R", .dims = "t"},
    {.name = "contact.speed_1", .unit = "m/s", .doc = "u1", .dims = "t"},
    {.name = "contact.speed_2", .unit = "m/s", .doc = "u2", .dims = "t"},
    {.name = "contact.load_per_width", .unit = "N/m", .doc = "w", .dims = "t"},
    {.name = "contact.reduced_modulus", .unit = "Pa", .doc = "E'", .dims = ""},
};

static const ff_port outputs[] = {
    {.name = "time", .unit = "s", .doc = "time", .dims = "t"},
    {.name = "x", .unit = "m", .doc = "place", .dims = "x"},
    {.name = "pressure", .unit = "Pa", .doc = "p", .dims = "t x"},
    {.name = "film", .unit = "m", .doc = "h", .dims = "t x"},
    {.name = "h_central", .unit = "m", .doc = "h", .dims = "t"},
    {.name = "h_min", .unit = "m", .doc = "h", .dims = "t"},
    {.name = "h_min_error", .unit = "m", .doc = "error", .dims = "t"},
    {.name = "mass_error", .unit = "1", .doc = "error", .dims = "t"},
};

static bool usable(const ff_array *in)
{
    bool good = in[T].shape[0] > 0 && in[MODULUS].data[0] > 1e6 && in[MODULUS].data[0] < 1e20;
    for (size_t i = 0; i < in[T].shape[0] && good; i++) {
        for (int k = R; k <= LOAD && good; k++)
            good = in[k].data[i] > 1e-6 && in[k].data[i] < 1e9;
        good = good && (!i || in[T].data[i] - in[T].data[i - 1] > 1e-12);
    }
    return good;
}

static double half_width(const ff_array *in, size_t i)
{
    return sqrt(8 * in[LOAD].data[i] * in[R].data[i] / (pi * in[MODULUS].data[0]));
}

/* The films of all instants; p and h have as many numbers for each as there are nodes. */
static ff_status follow(const ff_film *f, const ff_film_contact *c, const ff_array *in, double *p,
                        double *h)
{
    double pressure[NODES], v[NODES] = {0}, content[NODES] = {0}, past[NODES];
    unsigned char full[NODES] = {0};
    ff_film_state state = {
        .size = sizeof state, .p = pressure, .v = v, .full = full, .content = content};
    const ff_density *density = c->density;
    const size_t n = c->nodes;
    void *solver;
    ff_status status = f->open(f->self, c, &solver);
    if (status != FF_OK)
        return status;
    double r = in[R].data[0], u = (in[U1].data[0] + in[U2].data[0]) / 2, zero = 0, ln_eta;
    c->viscosity->eval(c->viscosity->self, 1, &zero, NULL, &ln_eta, NULL, NULL);
    state.h00 = 5 * exp(ln_eta) * u * r / in[LOAD].data[0];
    for (size_t j = 0; j < n; j++) {
        double x = (c->first + (double)j * c->dx) / c->half_width;
        pressure[j] = c->pressure * sqrt(fmax(0, 1 - x * x));
        full[j] = 1;
    }
    for (size_t i = 0; i < in[T].shape[0] && status == FF_OK; i++) {
        double step = i ? in[T].data[i] - in[T].data[i - 1] : INFINITY;
        for (size_t j = 0; j < n && i; j++) {
            density->eval(density->self, 1, &p[(i - 1) * n + j], NULL, &past[j], NULL, NULL);
            past[j] *= -h[(i - 1) * n + j] / step;
        }
        bool moves = i && !is("no-squeeze");
        ff_film_instant at = {.size = sizeof at,
                              .entrainment = (in[U1].data[i] + in[U2].data[i]) / 2 * off("fast", 2),
                              .sliding = in[U1].data[i] - in[U2].data[i],
                              .radius = in[R].data[i],
                              .loaded = 1,
                              .load = in[LOAD].data[i],
                              .rate = moves ? 1 / step : 0,
                              .past = moves ? past : NULL};
        status = f->solve(solver, &at, &state);
        for (size_t j = 0; j < n && status == FF_OK; j++) {
            double x = c->first + (double)j * c->dx;
            p[i * n + j] = pressure[j];
            h[i * n + j] = state.h00 + x * x / (2 * at.radius) + v[j];
        }
    }
    f->close(solver);
    return status;
}

/* Barus' coefficient is forgotten. */
static ff_status flat(const void *self, size_t n, const double *p, const double *T_given,
                      double *ln_eta, double *by_p, double *by_T)
{
    const ff_viscosity *law = self;
    (void)p;
    for (size_t i = 0; i < n; i++) {
        double zero = 0;
        law->eval(law->self, 1, &zero, T_given ? &T_given[i] : NULL, &ln_eta[i], NULL, NULL);
        if (by_p)
            by_p[i] = 0;
        if (by_T)
            by_T[i] = 0;
    }
    return FF_OK;
}

static ff_status evaluate(void *self, uint64_t wanted, const ff_array *in)
{
    const stub *s = self;
    const size_t times = usable(in) ? in[T].shape[0] : 0, n = times > 1 ? 97 : NODES,
                 shape[] = {times, n};
    (void)wanted;
    if (!times || !(s->value[0] > 0 && s->value[1] > 0))
        return ff_failf(s->host, FF_INVALID, "contact.time", "no contact has such a history");
    double *p = s->host->output(s->host->ctx, PRESSURE, 2, shape),
           *h = s->host->output(s->host->ctx, FILM, 2, shape),
           *central = ff_put_series(s->host, H, times),
           *low = ff_put_series(s->host, LOWEST, times),
           *error = ff_put_series(s->host, ERROR, times), x[NODES], widest = 0;
    if (!p || !h || !central || !low || !error)
        return FF_NOMEM;
    for (size_t i = 0; i < times; i++)
        widest = fmax(widest, half_width(in, i));
    const ff_viscosity dull = {sizeof dull, s->table[OIL], flat};
    ff_film_contact c = {.size = sizeof c,
                         .nodes = n,
                         .dx = widest * (s->value[0] + s->value[1]) / (double)(n - 1),
                         .first = -widest * s->value[0],
                         .half_width = widest,
                         .modulus = in[MODULUS].data[0],
                         .tolerance = 1e-8,
                         .order = 2,
                         .viscosity = is("dull") ? &dull : s->table[OIL],
                         .density = s->table[DENSITY]};
    /* rigid flanks: the scale of their wedge */
    const double zero = 0, r = in[R].data[0], w = in[LOAD].data[0];
    double ln_eta;
    dull.eval(dull.self, 1, &zero, NULL, &ln_eta, NULL, NULL);
    double inlet = sqrt(10 * exp(ln_eta) * (in[U1].data[0] + in[U2].data[0]) / 2 / w) * r;
    c.half_width = fmax(widest, inlet);
    c.pressure = fmin(widest * c.modulus / (4 * r), w / inlet);
    void *instance;
    ff_status status = penalty_model()->create(s->host, &instance);
    if (status == FF_OK) {
        status = follow(penalty_model()->service(instance, 0), &c, in, p, h);
        penalty_model()->destroy(instance);
    }
    if (status != FF_OK)
        return ff_failf(s->host, FF_NOCONV, NULL, "no film was found");
    for (size_t j = 0; j < n; j++)
        x[j] = c.first + (double)j * c.dx;
    for (size_t i = 0; i < times; i++) {
        low[i] = central[i] = INFINITY;
        for (size_t j = 0; j < n; j++) {
            low[i] = fmin(low[i], h[i * n + j]);
            central[i] = fabs(x[j]) < c.dx ? fmin(central[i], h[i * n + j]) : central[i];
        }
        error[i] = 0.02 * central[i];
    }
    put(s, TIME, times, in[T].data);
    put(s, X, n, x);
    ff_put_series(s->host, MASS, times);
    return FF_OK;
}

STUB_MODEL
