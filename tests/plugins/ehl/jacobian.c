/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Compares the derivatives of the balances with central differences. */
#include "check.h"
#include "stage.h"

#include "../../../plugins/ehl/equations/reynolds.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { NODES = 65 };

static double random_share(void)
{
    return (double)rand() / RAND_MAX;
}

typedef struct scene {
    ehl_grid grid;
    ehl_reynolds r;
    ehl_step step;
    ehl_film film;
    double p[NODES], v[NODES], past[NODES];
    double content[NODES], rough[NODES];
    unsigned char full[NODES];
} scene;

static void make(scene *s, const ehl_laws *laws, int wedge, double rate, int asymmetric)
{
    ehl_oil oil;
    ehl_fluid_oil(laws, &oil);
    s->grid = (ehl_grid){.nodes = NODES, .dx = 8e-6, .first = -40 * 8e-6};
    ehl_reynolds_create(&s->r, &s->grid, laws, &oil, wedge);
    s->r.asymmetric = asymmetric;
    s->step = (ehl_step){.entrainment = 4,
                         .sliding = 1.5,
                         .radius = 0.0128,
                         .loaded = 1,
                         .load = 1e5,
                         .rate = rate,
                         .past = s->past};
    s->film = (ehl_film){.p = s->p, .v = s->v, .h00 = 2e-7, .full = s->full, .content = s->content};
    for (size_t i = 0; i < NODES; i++) {
        double x = ((double)i - 36) / 20;
        s->full[i] = i > 0 && i < 56;
        s->p[i] =
            s->full[i] && fabs(x) < 1 ? 5e8 * sqrt(1 - x * x) * (0.9 + 0.2 * random_share()) : 0;
        s->v[i] = 1e-8 * random_share() - s->r.half_square[i] / 0.0128 * (fabs(x) < 1);
        s->content[i] = 917 * 2e-7 * random_share();
        s->past[i] = -rate * 917 * 2e-7;
    }
}

/* Adds asperities of a quarter of the gap, and nearly equal pressures outside the contact, for the
   formula of the mean of nearly equal values at a face. */
static void roughen(scene *s)
{
    for (size_t i = 0; i < NODES; i++) {
        s->rough[i] = 5e-8 * random_share();
        if (s->full[i] && !(s->p[i] > 0))
            s->p[i] = 2e5 * (1 + random_share());
    }
    s->r.rough = s->rough;
}

/* Returns the largest error of J (dp, dh), over its largest entry. J: the Jacobian matrix. */
static double error(scene *s)
{
    static double dp[NODES], dv[NODES], plus[NODES], product[NODES];
    double worst = 0, most = 0, small = 1e-6;
    for (size_t i = 0; i < NODES; i++) {
        dp[i] = s->full[i] ? s->p[i] * (random_share() - 0.5) : 0;
        if (ehl_is_cavitated(&s->r, &s->film, i))
            dp[i] = s->content[i] / s->r.unit * (random_share() - 0.5);
        dv[i] = 1e-7 * (random_share() - 0.5);
    }
    ehl_reynolds_evaluate(&s->r, &s->step, &s->film);
    size_t before = s->r.asymmetric ? EHL_ASYMMETRIC_BEFORE : 2;
    if (s->r.asymmetric)
        ehl_asymmetric_slopes(&s->r, &s->step, &s->film);
    else
        ehl_reynolds_slopes(&s->r, &s->step, &s->film);
    memset(product, 0, sizeof product);
    for (size_t i = 1; i < s->r.last; i++)
        for (size_t k = 0; k < EHL_STENCIL; k++)
            if (i + k >= before && i + k - before < NODES)
                product[i] +=
                    s->r.by_p[k][i] * dp[i + k - before] + s->r.by_h[k][i] * dv[i + k - before];
    for (int side = 0; side < 2; side++) {
        double move = side ? -2 * small : small;
        for (size_t i = 0; i < NODES; i++) {
            if (ehl_is_cavitated(&s->r, &s->film, i))
                s->content[i] += move * dp[i] * s->r.unit;
            else
                s->p[i] += move * dp[i];
            s->v[i] += move * dv[i];
        }
        ehl_reynolds_evaluate(&s->r, &s->step, &s->film);
        if (!side)
            memcpy(plus, s->r.residual, sizeof plus);
    }
    for (size_t i = 1; i < s->r.last; i++) {
        double expected =
            s->full[i] || s->r.conserving ? (plus[i] - s->r.residual[i]) / (2 * small) : 0;
        worst = fmax(worst, fabs(product[i] - expected));
        most = fmax(most, fabs(expected));
    }
    return worst / most;
}

int main(void)
{
    stage *oil = stage_open("viscosity/roelands"), *rho = stage_open("density/dowson-higginson"),
          *flow = stage_open("rheology/ree-eyring"), *rising = stage_open("rheology/ree-eyring");
    stage_set(oil, "eta0", 0.005);
    stage_set(oil, "alpha", 11e-9);
    stage_set(rho, "rho0", 917.8);
    stage_set(flow, "tau0", 5e6);
    ehl_laws newtonian = {.viscosity = stage_service(oil, FF_VISCOSITY_ID),
                          .density = stage_service(rho, FF_DENSITY_ID)};
    ehl_laws eyring = newtonian;
    eyring.rheology = stage_service(flow, FF_RHEOLOGY_3_ID);
    ehl_laws secant = newtonian; /* an Eyring stress that increases with pressure */
    stage_set_text(rising, "tau0", "auto");
    stage_set(rising, "limiting_stress_coefficient", 0.04);
    stage_link(rising, "viscosity", oil);
    secant.rheology = stage_service(rising, FF_RHEOLOGY_3_ID);
    srand(3);
    for (int wedge = 1; wedge <= 2; wedge++)
        for (int k = 0; k < 8; k++) {
            static scene s;
            make(&s, k & 1 ? wedge == 1 ? &secant : &eyring : &newtonian, wedge, k & 2 ? 1e6 : 0,
                 k >> 2);
            check_below("derivatives against differences", error(&s), 1e-7);
            s.r.conserving = 1;
            s.r.unit = 1e-13;
            for (size_t i = 20; i < 26; i++) { /* a void inside the film */
                s.full[i] = 0;
                s.p[i] = 0;
            }
            check_below("with mass conserved", error(&s), 1e-7);
            ehl_reynolds_destroy(&s.r);
            if (k >> 2)
                continue;
            make(&s, k & 1 ? wedge == 1 ? &secant : &eyring : &newtonian, wedge, k & 2 ? 1e6 : 0,
                 0);
            roughen(&s);
            check_below("of rough flanks", error(&s), 1e-7);
            ehl_reynolds_destroy(&s.r);
        }
    stage_close(oil);
    stage_close(rho);
    stage_close(rising);
    stage_close(flow);
    return check_done();
}
