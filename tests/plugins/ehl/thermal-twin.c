/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Solves the temperatures of a steady film of a Newtonian oil again, from its pressure and gap:
   with equal distances across the film and a tridiagonal system per column, the shear stress by the
   trapezoidal rule, and the flanks' temperature from the heat of all nodes upstream. */
#include "check.h"

#include "line.h"

#include <flankfilm/laws.h>

#include <math.h>
#include <string.h>

static const double pi = 3.14159265358979323846, T_oil = 333.15;

enum { CELLS = 512, NODES = CELLS + 1, ACROSS = 96, TURNS = 25 };

typedef struct twin {
    const double *p, *h, *x;
    double dx, u[2], conductivity, heat, B;
    double T[NODES][ACROSS + 1], speed[NODES][ACROSS + 1], flow[NODES][ACROSS + 1];
    double ln_eta[ACROSS + 1], rho[NODES][ACROSS + 1], rho_T[NODES][ACROSS + 1];
    double source[NODES][ACROSS + 1], tau[NODES], flux[2][NODES];
    const ff_viscosity *viscosity;
    const ff_density *density;
} twin;

static double slope_of(const twin *t, size_t i)
{
    return (t->p[i + 1] - t->p[i - 1]) / (2 * t->dx);
}

/* Computes velocity, mass flow, and heat of shear and compression in column i. */
static void shear_column(twin *t, size_t i)
{
    const double dz = 1. / ACROSS, h = t->h[i], p_x = slope_of(t, i);
    double p[ACROSS + 1], ease = 0, lean = 0, fluidity[ACROSS + 1];
    for (size_t j = 0; j <= ACROSS; j++)
        p[j] = t->p[i];
    t->viscosity->eval(t->viscosity->self, ACROSS + 1, p, t->T[i], t->ln_eta, NULL, NULL);
    t->density->eval(t->density->self, ACROSS + 1, p, t->T[i], t->rho[i], NULL, t->rho_T[i]);
    for (size_t j = 0; j <= ACROSS; j++) {
        double part = j == 0 || j == ACROSS ? dz / 2 : dz;
        fluidity[j] = exp(-t->ln_eta[j]);
        ease += part * fluidity[j];
        lean += part * fluidity[j] * ((double)j * dz - 0.5);
    }
    t->tau[i] = ((t->u[1] - t->u[0]) / h - h * p_x * lean) / ease;
    double before = 0, u = t->u[0];
    for (size_t j = 0; j <= ACROSS; j++) {
        double tau = t->tau[i] + ((double)j * dz - 0.5) * h * p_x, rate = tau * fluidity[j];
        u += j > 0 ? h * dz * (rate + before) / 2 : 0;
        before = rate;
        t->speed[i][j] = u;
        t->flow[i][j] = t->rho[i][j] * u * h;
        t->source[i][j] = tau * rate - t->rho_T[i][j] / t->rho[i][j] * t->T[i][j] * u * p_x;
    }
}

/* Computes the mass flow across the film from the mass balance; 0 at both flanks. */
static void transverse(const twin *t, size_t i, double *w)
{
    const double dz = 1. / ACROSS;
    double before = 0;
    w[0] = 0;
    for (size_t j = 0; j <= ACROSS; j++) {
        double out = (t->flow[i + 1][j] - t->flow[i - 1][j]) / (2 * t->dx);
        if (j > 0)
            w[j] = w[j - 1] - dz * (out + before) / 2;
        before = out;
    }
    double open = w[ACROSS];
    for (size_t j = 0; j <= ACROSS; j++)
        w[j] -= (double)j * dz * open;
}

/* Returns T - T_oil of flank g at node i due to the heat flux upstream, linear between the nodes;
   *own: additional temperature per W/m2 of flux at i. Integrates (x - xi)^(-1/2) exactly in each
   cell. */
static double flank(const twin *t, size_t g, size_t i, double *own)
{
    double sum = 0, scale = sqrt(t->dx / (pi * t->u[g])) / t->B;
    for (size_t k = 0; k < i; k++) {
        double near = (double)(i - k - 1), far = near + 1, whole = 2 * (sqrt(far) - sqrt(near));
        double tilt = far * whole - 2. / 3 * (far * sqrt(far) - near * sqrt(near));
        sum += t->flux[g][k] * (whole - tilt) + (k + 1 < i ? t->flux[g][k + 1] * tilt : 0);
    }
    *own = scale * 4 / 3;
    return scale * sum;
}

static void solve_column(twin *t, size_t i)
{
    const double dz = 1. / ACROSS, h = t->h[i], conducted = t->conductivity / (h * dz);
    double low[ACROSS + 1], main[ACROSS + 1], high[ACROSS + 1], right[ACROSS + 1], w[ACROSS + 1];
    double base[2], own[2];
    transverse(t, i, w);
    for (size_t j = 0; j <= ACROSS; j++) {
        int ahead = t->speed[i][j] >= 0, two = ahead ? i > 1 : i + 2 < NODES;
        double part = (j == 0 || j == ACROSS ? dz / 2 : dz) * h, u = fabs(t->speed[i][j]) / t->dx;
        double held = part * t->rho[i][j] * t->heat;
        double one = t->T[ahead ? i - 1 : i + 1][j],
               other = two ? t->T[ahead ? i - 2 : i + 2][j] : 0;
        double up = t->heat * w[j] / 2;
        low[j] = j > 0 ? -conducted - (j < ACROSS ? up : 0) : 0;
        high[j] = j < ACROSS ? -conducted + (j > 0 ? up : 0) : 0;
        main[j] =
            (j > 0 ? conducted : 0) + (j < ACROSS ? conducted : 0) + held * u * (two ? 1.5 : 1);
        right[j] = held * u * (two ? 2 * one - 0.5 * other : one) + part * t->source[i][j];
    }
    for (size_t g = 0; g < 2; g++) {
        size_t j = g > 0 ? ACROSS : 0;
        base[g] = T_oil + flank(t, g, i, &own[g]);
        main[j] += 1 / own[g];
        right[j] += base[g] / own[g];
    }
    for (size_t j = 1; j <= ACROSS; j++) {
        double share = low[j] / main[j - 1];
        main[j] -= share * high[j - 1];
        right[j] -= share * right[j - 1];
    }
    for (size_t j = ACROSS + 1; j-- > 0;)
        t->T[i][j] = (right[j] - (j < ACROSS ? high[j] * t->T[i][j + 1] : 0)) / main[j];
    for (size_t g = 0; g < 2; g++)
        t->flux[g][i] = (t->T[i][g > 0 ? ACROSS : 0] - base[g]) / own[g];
}

static double mean_of(const twin *t, size_t i)
{
    double sum = 0;
    for (size_t j = 0; j <= ACROSS; j++)
        sum += (j == 0 || j == ACROSS ? 0.5 : 1) * t->T[i][j] / ACROSS;
    return sum;
}

/* Returns the mass flow through column i, kg/(m s). */
static double passing(const twin *t, size_t i)
{
    double sum = 0;
    for (size_t j = 0; j <= ACROSS; j++)
        sum += (j == 0 || j == ACROSS ? 0.5 : 1) * t->flow[i][j] / ACROSS;
    return sum;
}

static void solve(twin *t, size_t end)
{
    for (size_t i = 0; i < NODES; i++)
        for (size_t j = 0; j <= ACROSS; j++)
            t->T[i][j] = T_oil;
    for (int turn = 0; turn < TURNS; turn++) {
        for (size_t i = 1; i < end; i++)
            shear_column(t, i);
        memcpy(t->flow[0], t->flow[1], sizeof t->flow[0]);
        memcpy(t->flow[end], t->flow[end - 1], sizeof t->flow[0]);
        for (size_t i = 1; i < end; i++)
            solve_column(t, i);
    }
}

int main(void)
{
    static twin t;
    line c;
    line_open(&c, "ehl/finite-volume");
    line_grade(&c, "ISO VG 46", T_oil);
    stage_set_text(c.film, "thermal", "full");
    stage_set(c.film, "cells", CELLS);
    stage_set(c.film, "inlet", 3);
    stage_set(c.film, "outlet", 1.5);
    c.load[0] = 40e3;
    c.u1[0] = t.u[0] = 7;
    c.u2[0] = t.u[1] = 3;
    check_true("runs", line_run(&c, "film pressure temperature x traction flash_temperature "
                                    "temperature_max") == FF_OK);
    const double T_there = T_oil;
    const ff_liquid *oil = stage_service(c.liquid, FF_LIQUID_ID);
    oil->eval(oil->self, FF_LIQUID_CONDUCTIVITY, 1, &T_there, &t.conductivity, NULL);
    oil->eval(oil->self, FF_LIQUID_HEAT_CAPACITY, 1, &T_there, &t.heat, NULL);
    t.p = stage_get(c.film, "pressure", NULL);
    t.h = stage_get(c.film, "film", NULL);
    t.x = stage_get(c.film, "x", NULL);
    t.dx = t.x[1] - t.x[0];
    t.B = sqrt(50. * 7850 * 484);
    t.viscosity = stage_service(c.oil, FF_VISCOSITY_ID);
    t.density = stage_service(c.rho, FF_DENSITY_ID);
    const double *T = stage_get(c.film, "temperature", NULL);
    size_t end = NODES - 2;
    while (end > 1 && !(t.p[end] > 0))
        end--;
    solve(&t, end);
    double most = 0, worst = 0, traction = 0, flash = 0, p_max = 0, least = 1e9, highest = 0;
    for (size_t i = 1; i < end; i++)
        p_max = fmax(p_max, t.p[i]);
    for (size_t i = 1; i < end; i++) {
        most = fmax(most, mean_of(&t, i) - T_oil);
        worst = fmax(worst, fabs(mean_of(&t, i) - T[i]));
        if (t.p[i] > 0.1 * p_max) {
            least = fmin(least, passing(&t, i));
            highest = fmax(highest, passing(&t, i));
        }
        traction -= t.tau[i] * t.dx;
        flash = fmax(flash, fmax(t.T[i][0], t.T[i][ACROSS]) - T_oil);
    }
    check_true("it warms up", most > 3);
    check_below("mean temperatures, over the highest rise", worst / most, 5e-3);
    check_near("traction", line_value(&c, "traction", 0), traction, 5e-3);
    check_near("flash of the flanks", line_value(&c, "flash_temperature", 0), flash, 5e-3);
    check_near("mass that passes the contact, first and last place", highest, least, 2e-3);
    line_close(&c);
    return check_done();
}
