/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Compares temperature and flow across a film between parallel flanks with closed forms. */
#include "../../../plugins/ehl/heat/thermal.h"
#include "check.h"

#include <math.h>
#include <string.h>

/* An oil with the viscosity eta0 exp(-beta (T - T0)) and Eyring's law of flow. */
static double beta, T0 = 350, eta0 = 0.05, tau0 = 5e6, expansion;

static ff_status viscosity(const void *self, size_t n, const double *p, const double *T,
                           double *ln_eta, double *by_p, double *by_T)
{
    (void)self, (void)p, (void)by_p;
    for (size_t i = 0; i < n; i++) {
        ln_eta[i] = log(eta0) - beta * (T[i] - T0);
        by_T[i] = -beta;
    }
    return FF_OK;
}

static ff_status density(const void *self, size_t n, const double *p, const double *T, double *rho,
                         double *by_p, double *by_T)
{
    (void)self, (void)p, (void)by_p, (void)T;
    for (size_t i = 0; i < n; i++) {
        rho[i] = 860;
        by_T[i] = -860 * expansion;
    }
    return FF_OK;
}

static ff_status rate(const void *self, size_t n, const double *p, const double *T,
                      const double *ln_eta, const double *tau, double *gamma, double *by_tau,
                      double *by_ln_eta)
{
    (void)self, (void)p, (void)T;
    for (size_t i = 0; i < n; i++) {
        double eta = exp(ln_eta[i]);
        gamma[i] = tau0 / eta * sinh(tau[i] / tau0);
        by_tau[i] = cosh(tau[i] / tau0) / eta;
        by_ln_eta[i] = -gamma[i];
    }
    return FF_OK;
}

static const ff_viscosity oil = {sizeof oil, NULL, viscosity};
static const ff_density dense = {sizeof dense, NULL, density};
static const ff_rheology_2 eyring = {sizeof eyring, NULL, rate};

enum { NODES = 3, LINE = 201 };

typedef struct bench {
    ehl_energy e;
    ehl_energy_film film;
    ehl_temperature t;
    double p[LINE], h[LINE], T[LINE * EHL_ACROSS_MOST], modes[2][LINE * EHL_MODES];
    unsigned char full[LINE];
} bench;

/* Sets up flanks with thermal effusivity B and speeds u. The nodes are so far apart that the flow
   carries no heat between them, unless dx is set later. */
static void open_bench(bench *b, size_t nodes, size_t across, double B, double u1, double u2,
                       double h)
{
    memset(b, 0, sizeof *b);
    ehl_energy_create(&b->e, nodes, across);
    b->e.laws = (ehl_laws){.viscosity = &oil, .density = &dense};
    b->e.conductivity = 0.14;
    b->e.heat_capacity = 2000;
    b->e.T_in = T0;
    for (int g = 0; g < 2; g++) {
        ehl_half_space_create(&b->e.flank[g], B, 1e-7, 1e-3);
        b->t.modes[g] = b->modes[g];
    }
    b->t.T = b->T;
    b->film = (ehl_energy_film){
        .count = nodes, .dx = 1e200, .speed = {u1, u2}, .p = b->p, .h = b->h, .full = b->full};
    for (size_t i = 0; i < nodes; i++) {
        b->h[i] = h;
        b->full[i] = 1;
        for (size_t k = 0; k < across; k++)
            b->T[i * across + k] = T0;
    }
}

static int turns_to_settle(bench *b)
{
    int turns = 0;
    do {
        ehl_energy_flow(&b->e, &b->film, b->T);
        ehl_energy_sweep(&b->e, &b->film, &b->t);
    } while (++turns < 60 && b->e.change > 1e-11);
    ehl_energy_flow(&b->e, &b->film, b->T);
    return turns;
}

/* Constant viscosity: T - T0 = eta (u_s/h)^2 z (h - z)/(2 k), also with k at 1 GPa. */
static void test_couette(void)
{
    static bench b;
    const double h = 1e-6, u = 4, source = eta0 * u * u / (h * h);
    beta = 0;
    for (int pressed = 1; pressed >= 0; pressed--) {
        open_bench(&b, NODES, 8, 1e15, 10 + u / 2, 10 - u / 2, h);
        b.e.conducts = (ehl_conductivity_rise){1.72e-9, 0.54e-9};
        for (size_t i = 0; i < NODES; i++)
            b.p[i] = pressed * 1e9;
        turns_to_settle(&b);
        double worst = 0, conductivity = b.e.conductivity * (pressed ? 1 + 1.72 / 1.54 : 1);
        for (size_t k = 0; k < 8; k++) {
            double z = b.e.across.z[k] * h, exact = source * z * (h - z) / (2 * conductivity);
            worst = fmax(worst, fabs(b.T[8 + k] - T0 - exact));
        }
        check_below("parabola of Couette's heating, K", worst, 1e-9);
        if (pressed)
            ehl_energy_destroy(&b.e);
    }
    check_near("mobility of one viscosity", b.e.mobility[1], 860 * h * h * h / (12 * eta0), 1e-12);
    check_near("carried mass", b.e.carried[1], 860 * h, 1e-12);
    ehl_energy_destroy(&b.e);
    open_bench(&b, NODES, 8, 1e10, 10 + u / 2, 10 - u / 2, h);
    turns_to_settle(&b);
    check_near("half of the heat goes into each flank", b.e.flux[0][1], source * h / 2, 1e-6);
    check_near("the other half", b.e.flux[1][1], source * h / 2, 1e-6);
    ehl_energy_destroy(&b.e);
}

/* A pressure that increases in time heats the oil by expansion T dp/dt per volume, equation
   (4.1). */
static void test_compression_in_time(void)
{
    static bench b;
    const double h = 1e-6, p_t[NODES] = {2e13, 2e13, 2e13};
    beta = 0, expansion = 6e-4;
    open_bench(&b, NODES, 8, 1e15, 10, 10, h);
    b.film.p_t = p_t;
    turns_to_settle(&b);
    double worst = 0, source = expansion * T0 * p_t[1];
    for (size_t k = 0; k < 8; k++) {
        double z = b.e.across.z[k] * h, exact = source * z * (h - z) / (2 * b.e.conductivity);
        worst = fmax(worst, fabs(b.T[8 + k] - T0 - exact) / (source * h * h));
    }
    /* expansion T dp/dt with T, not T0; T is 1 % above T0 where it is highest */
    check_below("parabola of the heat of compression", worst * 8 * b.e.conductivity, 0.012);
    expansion = 0;
    ehl_energy_destroy(&b.e);
}

/* Nahme's problem: returns the shear stress over that of the cold film, with na = beta eta
   u_s^2/k. */
static double stress_of_nahme(double na, size_t across, int *turns)
{
    static bench b;
    const double h = 1e-6;
    beta = 0.03;
    double u = sqrt(na * 0.14 / (beta * eta0));
    open_bench(&b, NODES, across, 1e15, 100 + u / 2, 100 - u / 2, h);
    *turns = turns_to_settle(&b);
    double ratio = -b.e.tau_m[1] / (eta0 * u / h);
    ehl_energy_destroy(&b.e);
    return ratio;
}

static void test_nahme(void)
{
    double off[3];
    int turns;
    for (int k = 0; k < 4; k++) {
        double na = (double[]){0.01, 1, 20, 500}[k], x = na / 8;
        double exact = asinh(sqrt(x)) / sqrt(x * (1 + x));
        check_near("Nahme's stress, 12 nodes", stress_of_nahme(na, 12, &turns), exact,
                   k < 3 ? 1e-7 : 1e-3);
        check_true("in some ten steps", k == 3 || turns <= 12);
    }
    double x = 20. / 8, exact = asinh(sqrt(x)) / sqrt(x * (1 + x));
    for (int k = 0; k < 3; k++)
        off[k] = fabs(stress_of_nahme(20, (size_t)(4 + 2 * k), &turns) / exact - 1);
    check_true("two nodes more are worth a factor of ten",
               off[0] > 10 * off[1] && off[1] > 10 * off[2]);
    check_below("with 8 nodes", off[2], 5e-5);
}

/* A film of uniform temperature must have the pressure flow of an isothermal film, with the factor
   h^3 rho psi/12, psi = sqrt(1/eta^2 + (u_s/(tau0 h))^2), and the flow that both flanks drag. */
static void test_eyring(void)
{
    static bench b;
    const double h = 1e-6, u = 0.4, p_x = 8e12;
    beta = 0;
    open_bench(&b, NODES, 10, 1e15, 10 + u / 2, 10 - u / 2, h);
    b.e.flow = &eyring;
    b.film.dx = 1e-6;
    for (size_t i = 0; i < NODES; i++)
        b.p[i] = p_x * b.film.dx * (double)i;
    ehl_energy_flow(&b.e, &b.film, b.T);
    double psi = hypot(1 / eta0, u / (tau0 * h)), f = 860 * h * h * h * psi / 12, flow = 0;
    for (size_t k = 0; k < 10; k++)
        flow += b.e.across.weight[k] * b.e.through[10 + k];
    check_near("mobility of Eyring's oil", b.e.mobility[1], f, 1e-6);
    check_near("its flow", flow, 860 * 10 * h - f * p_x, 1e-6);
    check_near("its stress", b.e.tau_m[1], -tau0 * asinh(eta0 * u / (tau0 * h)), 1e-6);
    ehl_energy_destroy(&b.e);
}

/* Returns the temperature of the middle column at zeta, from the polynomial through its nodes. */
static double temperature_at(const bench *b, double zeta)
{
    const ehl_across *a = &b->e.across;
    double sum = 0;
    for (size_t l = 0; l < a->count; l++) {
        double one = b->T[a->count + l];
        for (size_t k = 0; k < a->count; k++)
            one *= k == l ? 1 : (zeta - a->z[k]) / (a->z[l] - a->z[k]);
        sum += one;
    }
    return sum;
}

/* Returns the mean velocity int u dz/h in the middle column by Eyring's law, not by the law's
   tangent at the stress without a pressure gradient. Finds the mean stress tau_m by Newton's
   method, the integrals by Simpson's rule. *tau_m: first guess, then the result. */
static double exact_flow(const bench *b, double stress, double *tau_m)
{
    enum { STEPS = 200 };
    const double h = b->h[1], target = (b->film.speed[1] - b->film.speed[0]) / h;
    double moment = 0;
    for (int turn = 0; turn < 20; turn++) {
        double mean = 0, slope = 0;
        moment = 0;
        for (int j = 0; j <= STEPS; j++) {
            double zeta = (double)j / STEPS, x = (*tau_m + (zeta - 0.5) * stress) / tau0;
            double part = (j == 0 || j == STEPS ? 1 : 2 + 2 * (j % 2)) / (3. * STEPS);
            double fluidity = part * exp(beta * (temperature_at(b, zeta) - T0)) / eta0;
            mean += fluidity * tau0 * sinh(x);
            slope += fluidity * cosh(x);
            moment += zeta * fluidity * tau0 * sinh(x);
        }
        *tau_m += (target - mean) / slope;
    }
    return b->film.speed[1] - h * moment;
}

/* Returns the relative difference of the pressure flow by Eyring's law from that by the law's
   tangent, at s = h p_x/tau0 and sliding speed u; *stress: the relative difference of the
   stresses. */
static double tangent_error(double s, double u, double *stress)
{
    static bench b;
    const double h = 1e-7, p_x = s * tau0 / h;
    open_bench(&b, NODES, 10, 1e15, 10 + u / 2, 10 - u / 2, h);
    b.e.flow = &eyring;
    for (size_t i = 0; i < NODES; i++)
        b.p[i] = p_x * b.film.dx * (double)i;
    turns_to_settle(&b);
    double flow = 0, tau_m = b.e.tau_m[1];
    for (size_t k = 0; k < 10; k++)
        flow += b.e.across.weight[k] * b.e.through[10 + k];
    double exact = 860 * h * exact_flow(&b, h * p_x, &tau_m);
    double driven = -b.e.mobility[1] * p_x;
    *stress = tau_m / b.e.tau_m[1] - 1;
    ehl_energy_destroy(&b.e);
    return (exact - flow) / driven;
}

/* At uniform temperature, with sinh(m_0) = eta u_s/(tau0 h), the pressure flow over that by the
   tangent is 12 (cosh(s/2) - sinh(s/2)/(s/2))/s^2 cosh(m)/cosh(m_0), sinh(m) = sinh(m_0)
   (s/2)/sinh(s/2), or 1 + s^2 (1/40 - tanh(m_0)^2/24) + O(s^4). In a heated film, which is less
   viscous in the middle, the error of the tangent must also be of second order in s. */
static void test_tangent(void)
{
    double stress, unwanted;
    beta = 0;
    for (int k = 0; k < 6; k++) {
        double s = 0.5 * (1 << k % 3), u = k < 3 ? 1 : 30, m_0 = asinh(eta0 * u / (tau0 * 1e-7));
        double flat = sinh(s / 2) / (s / 2), m = asinh(sinh(m_0) / flat);
        double ratio = 12 * (cosh(s / 2) - flat) / (s * s) * cosh(m) / cosh(m_0);
        double series = s * s * (1. / 40 - tanh(m_0) * tanh(m_0) / 24);
        double found = tangent_error(s, u, &stress);
        check_near("flow of the law over its tangent", 1 + found, ratio, 1e-5);
        check_near("its stress", 1 + stress, m / m_0, 1e-5);
        check_below("beyond the second order", fabs(found - series), s * s * s * s / 300);
    }
    beta = 0.03;
    double coarse = tangent_error(0.5, 10, &stress), fine = tangent_error(0.25, 10, &unwanted);
    check_near("of a heated film, of second order", coarse / fine, 4, 0.05);
    check_below("and no larger", fabs(coarse), 0.25 / 40);
    check_below("nor is the stress", fabs(stress), 0.25 / 24);
}

/* Heats a film of thickness h for some steps; part of the oil flows backwards. */
static void heat_up(bench *b, size_t count, double h)
{
    const double p_x = 16 * eta0 * 8 / (h * h);
    b->film.count = count;
    for (size_t i = 0; i < LINE; i++) {
        b->h[i] = h * (1 + 1e-3 * (double)i);
        b->p[i] = p_x * b->film.dx * (double)i;
    }
    for (int turn = 0; turn < 3; turn++) {
        ehl_energy_flow(&b->e, &b->film, b->T);
        ehl_energy_sweep(&b->e, &b->film, &b->t);
    }
}

/* Data stored for a film must not affect the next film. */
static void test_restart(void)
{
    enum { ACROSS = 10 };
    static bench one, two;
    static double past[LINE * ACROSS];
    beta = 0.03;
    for (size_t i = 0; i < LINE * ACROSS; i++)
        past[i] = -1e5 * T0;
    for (int k = 0; k < 2; k++) {
        bench *b = k ? &two : &one;
        open_bench(b, LINE, ACROSS, 1.3e4, 9, 6, 1e-6);
        b->film.dx = 1e-6;
        b->film.rate = 1e5;
        b->film.past = past;
        b->e.reach = 0.02;
        b->e.flow = &eyring;
    }
    heat_up(&two, LINE, 3e-6);
    check_true("oil flows back", two.e.reverse[LINE / 2] == 1);
    ehl_energy_restart(&two.e);
    memcpy(two.T, one.T, sizeof two.T);
    memset(two.modes, 0, sizeof two.modes);
    for (int k = 0; k < 2; k++) {
        heat_up(k ? &two : &one, LINE / 2, 1e-6);
        heat_up(k ? &two : &one, LINE, 1e-6);
    }
    check_true("it is heated", one.T[LINE / 2 * ACROSS + ACROSS / 2] > T0 + 1);
    check_true("temperatures, to the bit", !memcmp(one.T, two.T, sizeof one.T));
    check_true("flanks, to the bit", !memcmp(one.modes, two.modes, sizeof one.modes));
    ehl_energy_destroy(&one.e);
    ehl_energy_destroy(&two.e);
}

/* The heat that leaves with the oil and into the flanks must be the dissipated heat, with an error
   of second order in dx, since the heat in the oil is computed here from temperatures at both
   ends. */
static double open_balance(size_t nodes)
{
    static bench b;
    const double h = 2e-6, length = 4e-4;
    beta = 0.03;
    open_bench(&b, nodes, 8, 1.3e4, 9, 6, h);
    b.film.dx = length / (double)(nodes - 1);
    for (int g = 0; g < 2; g++)
        ehl_half_space_create(&b.e.flank[g], 1.3e4, b.film.dx / 9, length / 6);
    turns_to_settle(&b);
    double out = 0, heat = 0, flanks = 0;
    for (size_t i = 0; i < nodes; i++) {
        double part = (i == 0 || i + 1 == nodes ? 0.5 : 1) * b.film.dx;
        flanks += part * (b.e.flux[0][i] + b.e.flux[1][i]);
        for (size_t k = 0; k < 8; k++)
            heat += part * h * b.e.across.weight[k] * b.e.tau[i * 8 + k] * b.e.gamma[i * 8 + k];
    }
    for (size_t k = 0; k < 8; k++)
        out += b.e.across.weight[k] * b.e.through[(nodes - 1) * 8 + k] * 2000 *
               (b.T[(nodes - 1) * 8 + k] - T0);
    ehl_energy_destroy(&b.e);
    return fabs(out + flanks - heat) / heat;
}

static void test_balance(void)
{
    double coarse = open_balance(51), fine = open_balance(201);
    check_below("heat that is not accounted for", fine, 5e-3);
    check_true("falls with the cells", coarse > 3 * fine);
}

/* Oil in a void comes from the film at the mean speed of the flanks: in a time step far shorter
   than its travel from node to node, its temperature must stay; in a long step, it must become that
   of the film. */
static void test_void(void)
{
    static bench b;
    static double past[NODES * 8];
    const double cold = 330;
    for (double rate = 1e14; rate > 1e-8; rate *= 1e-21) {
        open_bench(&b, NODES, 8, 1e4, 10, 6, 1e-6);
        b.film.count = NODES - 1;
        b.film.dx = 1e-6;
        b.film.rate = rate;
        b.film.past = past;
        b.full[NODES - 1] = 0;
        for (size_t j = 0; j < NODES * 8; j++)
            past[j] = -rate * (j < (NODES - 1) * 8 ? T0 : cold);
        ehl_energy_flow(&b.e, &b.film, b.T);
        ehl_energy_sweep(&b.e, &b.film, &b.t);
        double want = rate > 1 ? cold : b.T[8 + 3];
        check_near("oil in a void", b.T[2 * 8 + 3], want, 1e-4);
        ehl_energy_destroy(&b.e);
    }
}

/* A film ends at node 0, and heating in a step lowers its density by 1 %. The mass in the void
   downstream must not change, in a time step or a steady one: as much oil flows in as the flanks
   carry off. */
static void test_void_behind(void)
{
    static bench b;
    static ehl_thermal t;
    static ehl_reynolds r;
    static double past[LINE], now[3 * NODES], next[3 * NODES], rho[NODES], f[NODES];
    static unsigned char full[NODES] = {1};
    const double cooled = 0.99, u = 8, dx = 1e-6;
    for (double rate = 1e12; rate > 1e3; rate *= 1e-3) {
        open_bench(&b, NODES, 4, 1e4, u, u, 1e-6);
        b.film.count = 1;
        b.film.dx = dx;
        b.film.rate = rate;
        b.film.past = past;
        ehl_energy_flow(&b.e, &b.film, b.T);
        t = (ehl_thermal){.energy = b.e, .width = LINE, .past = past, .damping = 1};
        r = (ehl_reynolds){.nodes = NODES, .thick = b.h, .f = f};
        r.liquid.rho = rho;
        t.ease = now, t.swell = now + NODES, t.carry = now + 2 * NODES;
        for (size_t i = 0; i < NODES; i++) {
            rho[i] = 860 / cooled;
            past[LINE - 2 * NODES + i] = -rate;
            now[i] = now[NODES + i] = now[2 * NODES + i] = 1;
        }
        ehl_thermal_find_factors(&t, &r, &b.film, &(ehl_film){.full = full, .p = b.p}, next);
        const double *swell = next + NODES;
        check_near("the film's density", swell[0], cooled, 1e-12);
        for (size_t i = 1; i < NODES; i++)
            check_below("mass that a void makes, of what passes",
                        fabs(rate * (swell[i] - 1) + u / dx * (swell[i] - swell[i - 1])),
                        1e-12 * (rate + u / dx));
        ehl_energy_destroy(&b.e);
    }
}

int main(void)
{
    test_couette();
    test_void();
    test_void_behind();
    test_compression_in_time();
    test_nahme();
    test_eyring();
    test_tangent();
    test_restart();
    test_balance();
    return check_done();
}
