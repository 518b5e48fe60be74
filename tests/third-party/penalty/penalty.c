/* SPDX-License-Identifier: MIT */
/*
 * A discretisation of the film by somebody outside, from film.h and laws.h alone. Newton's method
 * with a dense Jacobian and Gauss elimination; cavitation by a penalty: where p < 0 oil comes in,
 * -K p for each length and time, so that p stays within a millionth of the Hertz pressure of 0.
 *
 * It differs from ehl/finite-volume in each of its parts: the mobility of a face is that of the
 * mean pressure and the mean gap there, the pressure that deflects the flanks is linear between the
 * nodes, and there is no set of cavitated nodes.
 */
#include <flankfilm/author.h>
#include <flankfilm/film.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double PENALTY = 1e-6; /* suction of a cavity, over the Hertz pressure */
enum { LIMIT = 60 };                /* Newton steps */

typedef struct solver {
    const ff_film_contact *c;
    double *memory, *kernel; /* kernel: deflection k nodes away from a hat of pressure, m/Pa */
    double *h, *rho, *rho_p; /* at the nodes */
    double *fp, *fh, *frho, *frho_p, *ln_eta, *ln_eta_p, *psi, *psi_l, *psi_h; /* at the faces */
    double *f, *f_p, *f_h;     /* mobility of the faces; by the mean p and by the mean h */
    double *by_p[4], *by_h[4]; /* of row i by the nodes i - 2 ... i + 1 */
    double *residual, *matrix; /* of nodes: all p, and h00 in place of the last one */
} solver;

static double twice_integrated_log(double s)
{
    return s * s > 0 ? s * s * (log(fabs(s)) / 2 - 0.75) : 0;
}

static void fill_kernel(solver *s)
{
    const ff_film_contact *c = s->c;
    for (size_t k = 0; k < c->nodes; k++) {
        double at = (double)k;
        double hat = twice_integrated_log(at + 1) - 2 * twice_integrated_log(at) +
                     twice_integrated_log(at - 1);
        s->kernel[k] = -4 / (acos(-1) * c->modulus) * c->dx * (hat + log(c->dx / c->half_width));
    }
}

static double kernel_between(const solver *s, size_t i, size_t j)
{
    return s->kernel[i > j ? i - j : j - i];
}

static void deflect(const solver *s, const double *p, double *v)
{
    for (size_t i = 0; i < s->c->nodes; i++) {
        v[i] = 0;
        for (size_t j = 0; j < s->c->nodes; j++)
            v[i] += kernel_between(s, i, j) * p[j];
    }
}

/* The gap, the laws at nodes and faces, and the mobility of the faces. */
static void evaluate_oil(solver *s, const ff_film_instant *at, const ff_film_state *film)
{
    const ff_film_contact *c = s->c;
    const size_t n = c->nodes;
    for (size_t i = 0; i < n; i++) {
        double x = c->first + (double)i * c->dx;
        s->h[i] = film->h00 + x * x / (2 * at->radius) + film->v[i];
    }
    for (size_t i = 0; i + 1 < n; i++) {
        s->fp[i] = (film->p[i] + film->p[i + 1]) / 2;
        s->fh[i] = (s->h[i] + s->h[i + 1]) / 2;
    }
    c->density->eval(c->density->self, n, film->p, NULL, s->rho, s->rho_p, NULL);
    c->density->eval(c->density->self, n - 1, s->fp, NULL, s->frho, s->frho_p, NULL);
    c->viscosity->eval(c->viscosity->self, n - 1, s->fp, NULL, s->ln_eta, s->ln_eta_p, NULL);
    if (c->rheology)
        c->rheology->flow(c->rheology->self, n - 1, s->ln_eta, s->fh, at->sliding, s->psi, s->psi_l,
                          s->psi_h);
    for (size_t i = 0; i + 1 < n; i++) {
        double cube = s->fh[i] * s->fh[i] * s->fh[i] / 12;
        if (!c->rheology) {
            s->psi[i] = exp(-s->ln_eta[i]);
            s->psi_l[i] = -s->psi[i];
            s->psi_h[i] = 0;
        }
        s->f[i] = s->frho[i] * cube * s->psi[i];
        s->f_p[i] = cube * (s->frho_p[i] * s->psi[i] + s->frho[i] * s->psi_l[i] * s->ln_eta_p[i]);
        s->f_h[i] = s->frho[i] * cube * (3 * s->psi[i] / s->fh[i] + s->psi_h[i]);
    }
}

/* Row i gets `factor` times rho h of a node. */
static void add_mass(solver *s, size_t i, size_t node, double factor)
{
    s->residual[i] += factor * s->rho[node] * s->h[node];
    s->by_p[node + 2 - i][i] += factor * s->rho_p[node] * s->h[node];
    s->by_h[node + 2 - i][i] += factor * s->rho[node];
}

/* Row i gets `sign` times what flows in through the face behind a node. */
static void add_face(solver *s, const ff_film_instant *at, const double *p, size_t i, size_t node,
                     double sign)
{
    const ff_film_contact *c = s->c;
    size_t left = node + 2 - i;
    double rise = sign * (p[node + 1] - p[node]) / c->dx, u = sign * at->entrainment;
    s->residual[i] += s->f[node] * rise;
    s->by_p[left][i] += s->f_p[node] * rise / 2 - sign * s->f[node] / c->dx;
    s->by_p[left + 1][i] += s->f_p[node] * rise / 2 + sign * s->f[node] / c->dx;
    s->by_h[left][i] += s->f_h[node] * rise / 2;
    s->by_h[left + 1][i] += s->f_h[node] * rise / 2;
    if (c->order == 1) {
        add_mass(s, i, node, -u);
    } else if (node == 0) {
        add_mass(s, i, 0, -u / 2);
        add_mass(s, i, 1, -u / 2);
    } else {
        add_mass(s, i, node, -1.5 * u);
        add_mass(s, i, node - 1, 0.5 * u);
    }
}

static void balance_cells(solver *s, const ff_film_instant *at, const ff_film_state *film)
{
    const ff_film_contact *c = s->c;
    double rho0, none = 0;
    c->density->eval(c->density->self, 1, &none, NULL, &rho0, NULL, NULL);
    const double flow = rho0 * (at->entrainment + at->rate * c->half_width);
    const double inflow = flow * c->half_width / (at->radius * PENALTY * c->pressure);
    for (size_t i = 1; i + 1 < c->nodes; i++) {
        s->residual[i] = 0;
        for (int k = 0; k < 4; k++)
            s->by_p[k][i] = s->by_h[k][i] = 0;
        add_face(s, at, film->p, i, i, 1);
        add_face(s, at, film->p, i, i - 1, -1);
        add_mass(s, i, i, -c->dx * at->rate);
        s->residual[i] -= at->past ? c->dx * at->past[i] : 0;
        if (film->p[i] < 0) {
            s->residual[i] -= c->dx * inflow * film->p[i];
            s->by_p[2][i] -= c->dx * inflow;
        }
    }
}

/* The linear system of a Newton step: row and column 0 are those of the load and of h00, in units
   in which all numbers are of one size. */
static void assemble(solver *s, const ff_film_instant *at, const ff_film_state *film)
{
    const ff_film_contact *c = s->c;
    const size_t n = c->nodes, size = n - 1;
    const double gap = c->half_width * c->half_width / at->radius;
    double load = 0;
    memset(s->matrix, 0, size * size * sizeof *s->matrix);
    s->matrix[0] = at->loaded ? 0 : 1;
    for (size_t j = 1; j < size; j++) {
        load += film->p[j] * c->dx;
        s->matrix[j] = at->loaded ? c->dx / c->half_width : 0;
    }
    s->residual[0] = at->loaded ? (load - at->load) / (c->half_width * c->pressure) : 0;
    for (size_t i = 1; i < size; i++) {
        double *row = s->matrix + i * size, most = 0;
        for (size_t k = 0; k < 4; k++)
            row[0] += s->by_h[k][i] * gap;
        for (size_t j = 1; j < size; j++) {
            for (size_t k = i > 1 ? 0 : 1; k < 4; k++)
                row[j] += s->by_h[k][i] * kernel_between(s, i + k - 2, j) * c->pressure;
            if (j + 2 >= i && j <= i + 1)
                row[j] += s->by_p[j + 2 - i][i] * c->pressure;
            most = fmax(most, fabs(row[j]));
        }
        for (size_t j = 0; j < size; j++)
            row[j] /= most;
        s->residual[i] /= most;
    }
}

/* Gauss with partial pivoting; the solution of matrix x = -residual takes the place of residual. */
static int eliminate(double *matrix, double *x, size_t size)
{
    for (size_t k = 0; k < size; k++) {
        size_t best = k;
        for (size_t i = k + 1; i < size; i++)
            best = fabs(matrix[i * size + k]) > fabs(matrix[best * size + k]) ? i : best;
        double pivot = matrix[best * size + k], kept = x[best];
        if (!(fabs(pivot) > 0))
            return 0;
        for (size_t j = 0; j < size && best != k; j++) {
            double other = matrix[k * size + j];
            matrix[k * size + j] = matrix[best * size + j];
            matrix[best * size + j] = other;
        }
        x[best] = x[k];
        x[k] = kept;
        for (size_t i = k + 1; i < size; i++) {
            double factor = matrix[i * size + k] / pivot;
            for (size_t j = k + 1; j < size; j++)
                matrix[i * size + j] -= factor * matrix[k * size + j];
            x[i] -= factor * x[k];
        }
    }
    for (size_t k = size; k-- > 0;) {
        for (size_t j = k + 1; j < size; j++)
            x[k] -= matrix[k * size + j] * x[j];
        x[k] /= matrix[k * size + k];
    }
    for (size_t k = 0; k < size; k++)
        x[k] = -x[k];
    return 1;
}

/* Takes as much of the step as leaves a gap everywhere; returns the largest change of p, over the
   Hertz pressure, or 1 where it was cut. */
static double take_step(solver *s, const ff_film_instant *at, ff_film_state *film)
{
    const ff_film_contact *c = s->c;
    const size_t n = c->nodes;
    double *step = s->residual, *v = s->psi, share = 1, most = 0;
    const double dh00 = step[0] * c->half_width * c->half_width / at->radius;
    step[0] = 0;
    step[n - 1] = 0;
    for (size_t i = 1; i + 1 < n; i++) {
        most = fmax(most, fabs(step[i]));
        step[i] *= c->pressure;
    }
    deflect(s, step, v);
    share = fmin(1, 0.3 / most);
    for (size_t i = 0; i < n; i++)
        share = fmin(share, v[i] + dh00 < 0 ? -0.9 * s->h[i] / (v[i] + dh00) : 1);
    for (size_t i = 0; i < n; i++) {
        film->p[i] += share * step[i];
        film->v[i] += share * v[i];
    }
    film->h00 += share * dh00;
    return share < 1 ? 1 : most;
}

/* Leaves out the suction of the cavity, and gives the load to the others. */
static void finish(const solver *s, const ff_film_instant *at, ff_film_state *film)
{
    const ff_film_contact *c = s->c;
    double load = 0;
    for (size_t i = 0; i < c->nodes; i++) {
        film->full[i] = film->p[i] > 0;
        film->p[i] = fmax(film->p[i], 0);
        load += film->p[i] * c->dx;
    }
    for (size_t i = 0; at->loaded && i < c->nodes; i++)
        film->p[i] *= at->load / load;
    deflect(s, film->p, film->v);
}

static ff_status solve(void *self, const ff_film_instant *at, ff_film_state *film)
{
    solver *s = self;
    const ff_film_contact *c = s->c;
    deflect(s, film->p, film->v);
    for (int k = 1; k <= LIMIT; k++) {
        film->iterations = k;
        evaluate_oil(s, at, film);
        balance_cells(s, at, film);
        assemble(s, at, film);
        if (!eliminate(s->matrix, s->residual, c->nodes - 1))
            return FF_NOCONV;
        double change = take_step(s, at, film);
        if (!isfinite(change))
            return FF_NOCONV;
        if (change <= c->tolerance) {
            finish(s, at, film);
            return FF_OK;
        }
    }
    return FF_NOCONV;
}

static void close_solver(void *self)
{
    solver *s = self;
    if (s)
        free(s->memory);
    free(s);
}

typedef struct penalty {
    const ff_host *host;
    ff_film service;
} penalty;

static ff_status open_solver(const void *self, const ff_film_contact *c, void **made)
{
    const penalty *m = self;
    enum { ARRAYS = 25 };
    if (c->conserving)
        return ff_failf(m->host, FF_UNSUPPORTED, NULL,
                        "oil in a cavity is not followed: cavitation must be clip");
    solver *s = calloc(1, sizeof *s);
    double *next = calloc((ARRAYS + c->nodes) * c->nodes, sizeof *next);
    if (!s || !next) {
        free(s);
        free(next);
        return FF_NOMEM;
    }
    s->c = c;
    s->memory = next;
    double **arrays[ARRAYS] = {&s->kernel,  &s->h,       &s->rho,     &s->rho_p,   &s->fp,
                               &s->fh,      &s->frho,    &s->frho_p,  &s->ln_eta,  &s->ln_eta_p,
                               &s->psi,     &s->psi_l,   &s->psi_h,   &s->f,       &s->f_p,
                               &s->f_h,     &s->by_p[0], &s->by_p[1], &s->by_p[2], &s->by_p[3],
                               &s->by_h[0], &s->by_h[1], &s->by_h[2], &s->by_h[3], &s->residual};
    for (size_t k = 0; k < ARRAYS; k++, next += c->nodes)
        *arrays[k] = next;
    s->matrix = next;
    fill_kernel(s);
    *made = s;
    return FF_OK;
}

static ff_status create(const ff_host *host, void **self)
{
    penalty *m = calloc(1, sizeof *m);
    if (!m)
        return FF_NOMEM;
    m->host = host;
    m->service = (ff_film){sizeof m->service, m, open_solver, solve, close_solver};
    *self = m;
    return FF_OK;
}

static const void *service(void *self, uint32_t output)
{
    return output == 0 ? &((penalty *)self)->service : NULL;
}

static const ff_port outputs[] = {
    {.name = "discretisation",
     .unit = "",
     .doc = "the film of one instant",
     .dims = "",
     .service = FF_FILM_ID},
};

static const ff_model model = {
    .size = sizeof model,
    .abi_major = FF_ABI_MAJOR,
    .abi_minor = 2,
    .id = "discretisation/penalty",
    .version = "1.0.0",
    .summary =
        "film of a smooth line contact by a dense Newton method, with cavitation by a penalty",
    .reference = "Wu 1986, Int. J. Eng. Sci. 24, 1001-1013 (penalty for the free boundary)",
    .bibtex = "@article{wu1986, author={Wu, S. R.}, title={A penalty formulation and numerical "
              "approximation of the {Reynolds-Hertz} problem of elastohydrodynamic lubrication}, "
              "journal={Int. J. Eng. Sci.}, volume={24}, pages={1001--1013}, year={1986}}",
    .licence = "MIT",
    .outputs = FF_TABLE(outputs),
    .create = create,
    .service = service,
    .destroy = free,
};

const ff_model *flankfilm_model_v1(void)
{
    return &model;
}
