/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Checks the outputs of an instant against the same quantities from its fields. */
#include "balance.h"
#include "model.h"

#include <flankfilm/author.h>

#include <math.h>

/* Keeps the worst relative error of all outputs so far. */
static void compare_output(ehl_balance *b, double value, double expected, double scale)
{
    ehl_worse(&b->worst.outputs, fabs(value - expected) / (scale + 1e-300));
}

/* Returns the least value of the parabola through node i and its neighbours. */
static double vertex(const double *y, size_t i)
{
    double left = y[i] - y[i - 1], right = y[i + 1] - y[i], bend = right - left;
    return bend > 0 ? y[i] - (left + right) * (left + right) / (8 * bend) : y[i];
}

/* Interpolates y[0] ... y[3] at 0 ... 3 to `place` by Neville's scheme. */
static double through_four(const double *y, double place)
{
    double q[4] = {y[0], y[1], y[2], y[3]};
    for (int order = 1; order < 4; order++)
        for (int k = 0; k + order < 4; k++)
            q[k] += (place - k) / order * (q[k + 1] - q[k]);
    return q[0];
}

static void compare_film_outputs(ehl_balance *b, const ehl_march *m, const double *row)
{
    const ehl_reynolds *eq = m->solver->reynolds;
    const double *h = eq->h, *p = m->state[0].film.p;
    size_t low = 0, high = 0;
    for (size_t i = 0; i < b->nodes; i++) {
        low = h[i] < h[low] ? i : low;
        high = p[i] > p[high] ? i : high;
    }
    double least = h[low];
    if (low > 0 && low + 1 < b->nodes && !m->rough && vertex(h, low) > least / 2)
        least = vertex(h, low);
    compare_output(b, row[EHL_H_MIN], least, least);
    compare_output(b, row[EHL_P_MAX], p[high], p[high] + 1);
    double place = -eq->first / eq->dx, node = fmin(fmax(floor(place), 1), (double)b->nodes - 3);
    const double *near = h + (size_t)node;
    double central = m->rough ? near[0] + (place - node) * (near[1] - near[0])
                              : through_four(near - 1, place - node + 1);
    compare_output(b, row[EHL_H_CENTRAL], central, fabs(central));
}

typedef struct force {
    double fluid, asperities, all;
} force;

/* b->left = tau */
static force friction(ehl_balance *b, const ehl_march *m, double boundary)
{
    const ehl_reynolds *eq = m->solver->reynolds;
    const ehl_film *film = &m->state[0].film;
    double slide = m->step.sliding, way = slide > 0 ? 1 : slide < 0 ? -1 : 0;
    force f = {0, 0, 0};
    eq->laws.viscosity->eval(eq->laws.viscosity->self, b->nodes, film->p, NULL, b->ln_eta, NULL,
                             NULL);
    if (eq->laws.rheology)
        eq->laws.rheology->shear(eq->laws.rheology->self, b->nodes, film->p, b->ln_eta, eq->h,
                                 slide, b->left);
    for (size_t i = 0; i < b->nodes; i++) {
        double tau =
                   eq->laws.rheology ? b->left[i] : slide / eq->h[i] * exp(fmin(b->ln_eta[i], 230)),
               p = film->p[i];
        if (film->asperity[i])
            f.asperities += way * boundary * p * eq->dx;
        else if (p > 0)
            f.fluid += tau * eq->dx;
        f.all += (fabs(tau) + boundary * p) * eq->dx;
    }
    return f;
}

static void compare_loss_outputs(ehl_balance *b, const ehl_march *m, const double *row, force f)
{
    const ehl_reynolds *eq = m->solver->reynolds;
    const double *p = m->state[0].film.p;
    double D = 0, moment = 0, arm = 0, u = m->step.entrainment;
    for (size_t i = 0; i + 1 < b->nodes; i++) {
        double x = eq->first + (double)i * eq->dx;
        D += b->face[i] * (p[i + 1] - p[i]) * (1 / b->rho[i] + 1 / b->rho[i + 1]) / 2;
        moment += x * p[i];
        arm += fabs(x) * p[i];
    }
    double scale = eq->dx / m->step.radius;
    double tail = p[1] > 0 ? 24 * eq->oil.viscosity * u * m->step.radius / -eq->first : 0;
    double power = (f.fluid + f.asperities) * m->step.sliding + D + u * tail;
    compare_output(b, row[EHL_ROLLING_LOSS], u * (tail - scale * moment), u * (tail + scale * arm));
    compare_output(b, row[EHL_POWER_LOSS], power, fabs(power) + u * tail);
    if (ehl_march_is_loaded(m))
        b->worst.dissipation = fmax(b->worst.dissipation, b->unbalanced / power);
}

void ehl_balance_outputs(ehl_balance *b, const ehl_march *m, const double *row, uint64_t wanted,
                         double boundary)
{
    static const uint64_t of_shear =
        FF_BIT(EHL_TRACTION) | FF_BIT(EHL_FRICTION_COEFFICIENT) | FF_BIT(EHL_POWER_LOSS);
    compare_film_outputs(b, m, row);
    if (!(wanted & of_shear))
        return;
    force f = friction(b, m, boundary);
    double traction = f.fluid + f.asperities, scale = f.all;
    compare_output(b, row[EHL_TRACTION], traction, scale);
    if (!m->contact_lost && m->at.load > 0)
        compare_output(b, row[EHL_FRICTION_COEFFICIENT] * m->step.load, traction, scale);
    if ((wanted & FF_BIT(EHL_POWER_LOSS)) && !m->rough)
        compare_loss_outputs(b, m, row, f);
}
