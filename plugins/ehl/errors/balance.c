/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "balance.h"

#include "../contact/simd-reductions.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double pi = 3.14159265358979323846;

ff_status ehl_balance_create(ehl_balance *b, const ehl_march *m)
{
    enum { OWN = 10, KERNEL = 2 };
    const ehl_grid *g = m->solver->grid;
    size_t n = g->nodes;
    *b = (ehl_balance){.nodes = n};
    double *next = b->memory = calloc((OWN + KERNEL) * n, sizeof *next);
    if (!next)
        return FF_NOMEM;
    double **own[OWN] = {&b->rho,     &b->ln_eta,  &b->psi,    &b->volume, &b->mass[0],
                         &b->mass[1], &b->mass[2], &b->change, &b->face,   &b->left};
    for (size_t k = 0; k < OWN; k++, next += n)
        *own[k] = next;
    b->kernel = next + n;
    /* -4/(pi E') int ln|x/a| dx over a cell: int ln s ds = s ln s - s, and 1/2 from there */
    for (size_t k = 0; k < n; k++) {
        double far = ((double)k + 0.5) * g->dx / g->half_width, near = far - g->dx / g->half_width;
        double whole = far * (log(far) - 1) - near * (log(fabs(near)) - 1);
        b->kernel[k] = -4 * g->half_width / (pi * m->history->modulus) * whole;
        *(b->kernel - k) = b->kernel[k];
    }
    return FF_OK;
}

void ehl_balance_destroy(ehl_balance *b)
{
    free(b->memory);
    b->memory = NULL;
}

/* Returns the position of the time between row b->row and the next row, 0 to 1, or a negative
   number where the history jumps. */
static double share_of_row(ehl_balance *b, const ehl_history *h, double time)
{
    size_t i = b->row >= h->count || time < h->time[b->row] ? 0 : b->row;
    while (i + 1 < h->count && h->time[i + 1] <= time)
        i++;
    b->row = i;
    double span = i + 1 < h->count ? h->time[i + 1] - h->time[i] : 0, since = time - h->time[i];
    if (i > 0 && since <= 1e-9 * span && !(h->time[i] > h->time[i - 1]))
        return -1;
    return span > 0 ? since / span : 0;
}

/* Checks radius, speeds and load of the step against the rows of the history. */
static void check_conditions(ehl_balance *b, const ehl_march *m)
{
    const ehl_history *h = m->history;
    double share = share_of_row(b, h, m->at.time);
    size_t i = b->row, k = i + 1 < h->count ? i + 1 : i;
    if (share < 0)
        return;
    double u1 = h->speed_1[i] + share * (h->speed_1[k] - h->speed_1[i]),
           u2 = h->speed_2[i] + share * (h->speed_2[k] - h->speed_2[i]),
           radius = h->radius[i] + share * (h->radius[k] - h->radius[i]),
           load = fmax(h->load[i] + share * (h->load[k] - h->load[i]), h->load_floor);
    double speed = fmax(fabs(u1) + fabs(u2) + m->at.entrainment, 1e-300);
    double creep = h->at_rest && m->at.time <= h->wakes ? EHL_CREEP * h->speed_max : 0;
    ehl_worse(&b->worst.conditions, fabs(m->step.radius / radius - 1));
    ehl_worse(&b->worst.conditions,
              fabs(m->step.entrainment - fmax(fabs(u1 + u2) / 2, creep)) / speed);
    ehl_worse(&b->worst.conditions, fabs(m->step.sliding - (u1 - u2)) / speed);
    if (m->contact_lost || !m->step.loaded)
        return;
    ehl_worse(&b->worst.conditions, fabs(m->step.load - load) / h->load_max);
    ehl_worse(&b->worst.load, fabs(b->load - load) / h->load_max);
    ehl_worse(&b->worst.rescaling, m->solver->rescaling);
}

static int is_void(const ehl_reynolds *eq, const ehl_film *film, size_t i)
{
    return eq->conserving && !film->full[i] && i > 0 && i + 1 < eq->nodes;
}

/* Return the factors on density and on transported mass of a film with temperatures across it
   (thermal.h). */
static double swelling(const ehl_reynolds *eq, size_t i)
{
    return eq->swell ? eq->swell[i] : 1;
}

static double carrying(const ehl_reynolds *eq, size_t i)
{
    return eq->carry ? eq->carry[i] : 1;
}

/* Computes the masses of state k from its pressure and gap, and for the newest state also
   b->rho. */
static void compute_mass(const ehl_balance *b, const ehl_march *m, size_t k)
{
    const ehl_reynolds *eq = m->solver->reynolds;
    const ehl_film *film = &m->state[k].film;
    const double *h = k == 0 ? eq->h : m->state[k].gap;
    double *rho = k == 0 ? b->rho : b->mass[k];
    const double *p = ehl_fluid_of(eq, film, h, b->volume);
    eq->laws.density->eval(eq->laws.density->self, b->nodes, p, NULL, rho, NULL, NULL);
    for (size_t i = 0; i < b->nodes; i++)
        b->mass[k][i] = rho[i] * h[i];
    for (size_t i = 0; eq->conserving && i < b->nodes; i++)
        b->mass[k][i] = is_void(eq, film, i) ? film->content[i] : b->mass[k][i];
    if (eq->swell && k > 0)
        memcpy(b->mass[k], m->state[k].mass, b->nodes * sizeof *b->mass[k]);
    for (size_t i = 0; eq->swell && k == 0 && i < b->nodes; i++)
        b->mass[k][i] *= is_void(eq, film, i) ? 1 : eq->swell[i];
}

/* Checks the masses from which the next step starts. Where asperities are in contact, mass may be
   missing. */
static void check_kept_oil(ehl_balance *b, const ehl_march *m)
{
    const ehl_state *s = &m->state[0];
    for (size_t i = 0; i < b->nodes; i++) {
        double more = s->mass[i] - b->mass[0][i], whole = fabs(b->mass[0][i]) + 1e-300;
        double off = s->film.asperity[i] ? more : fabs(more);
        if (!(off <= b->worst.mass * whole))
            ehl_worse(&b->worst.mass, off / whole);
    }
}

/* Computes the change of the masses in time by (10.1) or (10.2): the slope at the end of a straight
   line, or a parabola, through the newest films. */
static void differentiate(ehl_balance *b, const ehl_march *m)
{
    const ehl_state *s = m->state;
    size_t n = b->nodes;
    if (!m->step.past || m->known < 2) {
        memset(b->change, 0, n * sizeof *b->change);
        return;
    }
    double dt = s[0].time - s[1].time, line = 1 / dt, c[3] = {line, -line, 0};
    if (m->known > 2) {
        double whole = s[0].time - s[2].time, parabola = 1 / dt + 1 / whole;
        if (fabs(parabola - m->step.rate) < fabs(line - m->step.rate)) {
            c[0] = parabola;
            c[1] = -whole / (dt * (whole - dt));
            c[2] = dt / (whole * (whole - dt));
        }
    }
    for (size_t k = 1; k < 3 && fabs(c[k]) > 0; k++)
        compute_mass(b, m, k);
    for (size_t i = 0; i < n; i++)
        b->change[i] = c[0] * b->mass[0][i] + c[1] * b->mass[1][i] + c[2] * b->mass[2][i];
}

/* Returns the mobility of the face between two nodes. */
FF_SIMD_INLINE double between(double f, double next)
{
    double sum = f + next, s = sum > 0 ? 4 * f * next / (sum * sum) : 0;
    return sum / 2 * (1 - s / 2 + s * s / 2);
}

/* f rho h^3/12 for the fluidity in f. */
FF_SIMD
static void fill_mobility(size_t n, const double *restrict rho, const double *restrict h,
                          double *restrict f)
{
    for (size_t i = 0; i < n; i++)
        f[i] *= rho[i] * h[i] * h[i] * h[i] / 12;
}

FF_SIMD
static void fill_faces(size_t n, const double *restrict f, const double *restrict p, double dx,
                       double *restrict face)
{
    for (size_t i = 0; i < n; i++)
        face[i] = between(f[i], f[i + 1]) * (p[i + 1] - p[i]) / dx;
}

/* Computes b->psi = f of (7.1), and the pressure flow between the nodes. */
static void compute_flow(ehl_balance *b, const ehl_march *m)
{
    const ehl_reynolds *eq = m->solver->reynolds;
    const double *p = ehl_fluid(eq, &m->state[0].film), *h = eq->h;
    size_t n = b->nodes;
    eq->laws.viscosity->eval(eq->laws.viscosity->self, n, p, NULL, b->ln_eta, NULL, NULL);
    if (eq->laws.rheology)
        eq->laws.rheology->flow(eq->laws.rheology->self, n, p, NULL, b->ln_eta, h, m->step.sliding,
                                b->psi, NULL, NULL, NULL);
    else
        for (size_t i = 0; i < n; i++)
            b->psi[i] = exp(-b->ln_eta[i]);
    for (size_t i = 0; eq->ease && i < n; i++)
        b->psi[i] *= eq->ease[i];
    for (size_t i = 0; eq->swell && i < n; i++)
        b->psi[i] *= eq->swell[i];
    fill_mobility(n, b->rho, h, b->psi);
    fill_faces(n - 1, b->psi, p, eq->dx, b->face);
    b->face[n - 1] = 0;
}

/* Computes b->left: the flow into volume i through its ends, minus the storage there. */
static void balance_cells(ehl_balance *b, const ehl_march *m)
{
    const ehl_reynolds *eq = m->solver->reynolds;
    const ehl_film *film = &m->state[0].film;
    const double *mass = b->mass[0];
    double u = m->step.entrainment;
    double last = mass[0] * carrying(eq, 0), first = mass[1] * carrying(eq, 1);
    double before = b->face[0] - u * (eq->wedge == 2 ? (last + first) / 2 : last);
    for (size_t i = 1; i + 1 < b->nodes; i++) {
        double sharp = eq->wedge < 2 || is_void(eq, film, i - 1) ? 0 : 0.5;
        double here = mass[i] * carrying(eq, i);
        double flux = b->face[i] - u * (here + sharp * (here - last));
        last = here;
        b->left[i] = flux - before - eq->dx * b->change[i];
        before = flux;
    }
}

/* Returns the flow through the face of volumes that lie from node i - 1 to node i (reynolds.h). */
static double asymmetric_gain(const ehl_balance *b, const ehl_march *m, size_t i)
{
    const ehl_reynolds *eq = m->solver->reynolds;
    int sharp =
        eq->wedge < 2 || i + 2 >= b->nodes || (i > 0 && is_void(eq, &m->state[0].film, i - 1));
    double q = b->face[i] + (sharp ? 0 : 0.5 * (b->face[i] - b->face[i + 1]));
    return q - m->step.entrainment * b->mass[0][i] * carrying(eq, i);
}

static void balance_intervals(ehl_balance *b, const ehl_march *m)
{
    const ehl_reynolds *eq = m->solver->reynolds;
    int halves = eq->wedge == 2 && !eq->conserving;
    double before = asymmetric_gain(b, m, 0);
    for (size_t i = 1; i + 1 < b->nodes; i++) {
        double flux = asymmetric_gain(b, m, i),
               change = halves ? (b->change[i] + b->change[i - 1]) / 2 : b->change[i];
        b->left[i] = flux - before - eq->dx * change;
        before = flux;
    }
}

/* Returns the largest sum of the imbalances of the volumes from `first` to another node, downstream
   with way = 1 and upstream with -1. The sum is relative to the flow at that node: the entrained
   oil, plus the pressure flow of `per_cell`, a pressure over a cell. */
static double largest_left(const ehl_balance *b, const ehl_march *m, double flow_scale,
                           double per_cell, size_t first, int way)
{
    const ehl_reynolds *eq = m->solver->reynolds;
    const ehl_film *film = &m->state[0].film;
    double most = 0, sum = 0;
    for (size_t i = first; i > 0 && i + 1 < b->nodes && (film->full[i] || eq->conserving);
         i = way > 0 ? i + 1 : i - 1) {
        sum += b->left[i];
        double off = fabs(sum) / (flow_scale + b->psi[i] * per_cell);
        most = off > most ? off : most;
    }
    return isfinite(sum) ? most : NAN;
}

/* Returns the largest imbalance of mass of the volumes between the highest pressure and any other
   node. The pressure is accurate only to a share of p_max. */
static double check_mass(ehl_balance *b, const ehl_march *m, double flow_scale, size_t peak)
{
    const ehl_reynolds *eq = m->solver->reynolds;
    double most = 0, per_cell = ehl_fluid(eq, &m->state[0].film)[peak] / eq->dx;
    ehl_worse(&most, largest_left(b, m, flow_scale, per_cell, peak + 1, 1));
    ehl_worse(&most, largest_left(b, m, flow_scale, per_cell, peak, -1));
    ehl_worse(&b->worst.mass, most);
    return most;
}

/* Checks cells without pressure. A cell that gains oil should have a pressure: about the pressure
   that moves this oil by one cell. A cavitated cell must not contain more oil than its gap. */
static void check_cavitated(ehl_balance *b, const ehl_march *m, double p_max)
{
    const ehl_reynolds *eq = m->solver->reynolds;
    const ehl_film *film = &m->state[0].film;
    const double *p = ehl_fluid(eq, film), least = fmax(p_max, 1e-2 * m->solver->grid->pressure);
    for (size_t i = 1; i + 1 < b->nodes; i++) {
        if (film->full[i] && p[i] >= 0)
            continue;
        if (film->full[i])
            ehl_worse(&b->worst.cavitated, -p[i] / least);
        else if (eq->conserving)
            ehl_worse(&b->worst.cavitated, film->content[i] / (eq->oil.density * eq->h[i]) - 1);
        else
            ehl_worse(&b->worst.cavitated, b->left[i] * eq->dx / (b->psi[i] * least));
    }
}

/* Computes b->volume = int dp/rho by Simpson's rule. */
static void integrate_volume(ehl_balance *b, const ehl_march *m)
{
    const ehl_reynolds *eq = m->solver->reynolds;
    const double *p = ehl_fluid(eq, &m->state[0].film);
    /* the array is free, since the change of the masses is already known */
    double *half = b->mass[1], *volume = b->volume;
    for (size_t i = 0; i < b->nodes; i++)
        half[i] = p[i] / 2;
    eq->laws.density->eval(eq->laws.density->self, b->nodes, half, NULL, volume, NULL, NULL);
    for (size_t i = 0; i < b->nodes; i++)
        volume[i] = p[i] / 6 * (1 / eq->oil.density + 4 / volume[i] + 1 / b->rho[i]);
}

/*
 * Checks (7.14): the balances of the volumes, weighted by P, add up to the energy balance of the
 * pressure flow. There the entrainment does work on the upstream rho h. Its work on h differs from
 * that by an error due to the cells. Steps much shorter than a passage change the film by less than
 * the tolerance of its solution.
 */
static void check_energy(ehl_balance *b, const ehl_march *m)
{
    const double shortest = 100;
    const ehl_reynolds *eq = m->solver->reynolds;
    const double *p = ehl_fluid(eq, &m->state[0].film), *h = eq->h;
    double D = 0, work = 0;
    integrate_volume(b, m);
    for (size_t i = 1; i + 1 < b->nodes; i++) {
        D += b->face[i] * (b->volume[i + 1] - b->volume[i]);
        work += h[i] * swelling(eq, i) * carrying(eq, i) * (p[i + 1] - p[i - 1]) / 2;
    }
    double off = ehl_dot(b->nodes - 2, b->volume + 1, b->left + 1),
           stored = ehl_dot(b->nodes - 2, b->volume + 1, b->change + 1) * eq->dx;
    work *= m->step.entrainment;
    /* contribution of p and the flow at the first node, if the oil there has a pressure */
    double enters = eq->wedge == 2 ? (b->mass[0][0] + b->mass[0][1]) / 2 : b->mass[0][0];
    double brought = b->volume[0] * (m->step.entrainment * enters - b->face[0]);
    b->unbalanced = fabs(D - work + stored - brought);
    double scale = D + fabs(work) + fabs(stored);
    if (scale <= 0)
        return;
    if (m->step.rate * 2 * m->solver->grid->half_width < shortest * m->step.entrainment)
        ehl_worse(&b->worst.energy, fabs(off) / scale);
}

/* Two faces, and the largest number of nodes whose mobility the flow through a face depends on. */
enum { FACES = 2, MOST_OF_FACE = 3 };

/* Computes f of (7.1) at n nodes, with rho h from the masses. */
static void fill_mobilities(const ehl_march *m, size_t n, const size_t *node, double *f)
{
    const ehl_reynolds *eq = m->solver->reynolds;
    enum { MOST = FACES * MOST_OF_FACE };
    double p[MOST], h[MOST], ln_eta[MOST];
    for (size_t k = 0; k < n; k++) {
        p[k] = ehl_fluid(eq, &m->state[0].film)[node[k]];
        h[k] = eq->h[node[k]];
    }
    eq->laws.viscosity->eval(eq->laws.viscosity->self, n, p, NULL, ln_eta, NULL, NULL);
    if (eq->laws.rheology)
        eq->laws.rheology->flow(eq->laws.rheology->self, n, p, NULL, ln_eta, h, m->step.sliding, f,
                                NULL, NULL, NULL);
    for (size_t k = 0; k < n; k++) {
        double psi = eq->laws.rheology ? f[k] : exp(-ln_eta[k]);
        f[k] =
            m->state[0].mass[node[k]] * h[k] * h[k] * psi / 12 * (eq->ease ? eq->ease[node[k]] : 1);
    }
}

/* Returns the oil that leaves the volume of node i; `f` contains the mobilities from there on. */
static double outflow(const ehl_march *m, size_t i, const double *f)
{
    const ehl_reynolds *eq = m->solver->reynolds;
    const double *mass = m->state[0].mass, *p = ehl_fluid(eq, &m->state[0].film) + i;
    double half = eq->wedge == 2 ? 0.5 : 0, carried = mass[i] * carrying(eq, i);
    double q = between(f[0], f[1]) * (p[1] - p[0]) / eq->dx;
    if (!eq->asymmetric)
        carried += half * (carried - mass[i - 1] * carrying(eq, i - 1));
    else if (half > 0)
        q += half * (q - between(f[1], f[2]) * (p[2] - p[1]) / eq->dx);
    return m->step.entrainment * carried - q;
}

/* Returns the oil that stays between the volumes of two nodes. */
static double gain_between(const ehl_march *m, size_t first, size_t last)
{
    const ehl_reynolds *eq = m->solver->reynolds;
    size_t each = eq->asymmetric && eq->wedge == 2 ? 3 : 2, node[FACES * MOST_OF_FACE];
    double f[FACES * MOST_OF_FACE];
    for (size_t k = 0; k < each; k++) {
        node[k] = first + k;
        node[each + k] = last + k;
    }
    fill_mobilities(m, FACES * each, node, f);
    return outflow(m, first, f) - outflow(m, last, f + each);
}

/*
 * Checks the oil between x = -a and x = 0: inflow and outflow since the last instant, by the
 * trapezoidal rule, against the change of the stored oil. An error leaves with the oil within one
 * passage.
 */
static void check_content(ehl_balance *b, const ehl_march *m)
{
    const ehl_reynolds *eq = m->solver->reynolds;
    const ehl_state *s = &m->state[0];
    ehl_content *c = &b->content, before = *c;
    size_t last = (size_t)(-eq->first / eq->dx),
           first = (size_t)fmax(2, (-m->solver->grid->half_width - eq->first) / eq->dx);
    *c = (ehl_content){.time = s->time};
    if (!ehl_march_is_loaded(m) || last + 3 >= b->nodes || last < first + 4 ||
        memchr(s->film.full + first - 1, 0, last - first + 3))
        return;
    double lag = eq->asymmetric && eq->wedge == 2 && !eq->conserving ? 0.5 : 0;
    c->mass = lag * (s->mass[first] - s->mass[last]) + ehl_sum(last - first, s->mass + first + 1);
    c->mass *= eq->dx;
    c->gain = gain_between(m, first, last);
    c->known = 1;
    c->mirrored = m->mirrored;
    if (!before.known || before.mirrored != m->mirrored || m->known < 2 ||
        fabs(m->state[1].time - before.time) > 0)
        return;
    double dt = c->time - before.time,
           way = m->step.entrainment * dt / ((double)(last - first) * eq->dx);
    double rest =
        way > 0 ? -expm1(-way) / way : 1; /* share of the oil of this step that is still there */
    double missing = dt * (c->gain + before.gain) / 2 - (c->mass - before.mass);
    c->off = before.off * exp(-way) + rest * missing;
    ehl_worse(&b->worst.history, fabs(c->off) / c->mass);
}

double ehl_balance_hold(ehl_balance *b, const ehl_march *m, int wholly)
{
    const ehl_reynolds *eq = m->solver->reynolds;
    const double *p = ehl_fluid(eq, &m->state[0].film);
    ehl_balance_moment(b, m);
    check_conditions(b, m);
    b->unbalanced = 0;
    if (!m->rough)
        check_content(b, m);
    if (!wholly)
        return 0;
    ehl_balance_gap(b, m);
    compute_mass(b, m, 0);
    check_kept_oil(b, m);
    if (m->rough)
        return 0;
    double p_max = ehl_greatest(b->nodes, p, 0);
    size_t peak = b->nodes - 1;
    while (peak > 0 && !(p[peak] >= p_max))
        peak--;
    differentiate(b, m);
    compute_flow(b, m);
    if (eq->asymmetric)
        balance_intervals(b, m);
    else
        balance_cells(b, m);
    size_t centre = (size_t)(-eq->first / eq->dx + 0.5);
    double speed = m->step.entrainment + m->step.rate * m->solver->grid->half_width;
    double h = eq->h[centre < b->nodes ? centre : b->nodes - 1];
    check_cavitated(b, m, p[peak]);
    if (!(p[peak] > 0))
        return 0;
    check_energy(b, m);
    return check_mass(b, m, eq->oil.density * h * speed, peak);
}
