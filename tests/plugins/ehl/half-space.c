/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Compares the temperature of a flank, a moving half-space, with closed forms for constant and
   moving heat sources. */
#include "../../../plugins/ehl/heat/half-space.h"
#include "check.h"

#include <math.h>
#include <string.h>

static const double pi = 3.14159265358979323846;

enum { MOST_NODES = 4097 };

typedef struct strip {
    double T[MOST_NODES]; /* T - T_bulk */
} strip;

/* Computes the steady temperature under `flux` at n nodes over `length`, from x = 0, at speed u. */
static void heat(strip *s, double B, double u, double length, size_t n, const double *flux)
{
    ehl_half_space f;
    ehl_passage p;
    double dx = length / (double)(n - 1), before[EHL_MODES] = {0}, modes[EHL_MODES];
    ehl_half_space_create(&f, B, dx / u, length / u);
    ehl_half_space_pass(&f, u, dx, 0, &p);
    s->T[0] = 0;
    for (size_t i = 1; i < n; i++) {
        double known = ehl_half_space_reach(&f, &p, before, flux[i - 1], NULL, NULL, modes);
        s->T[i] = known + p.own * flux[i];
        ehl_half_space_add(&f, &p, flux[i], modes);
        memcpy(before, modes, sizeof modes);
    }
}

/* A band of width 2 a with constant flux q: T = 2 q sqrt(x/u)/(sqrt(pi) B), highest at its end,
   1.1284 q sqrt(2 a/u)/B; downstream of the end, minus the temperature from a band that begins
   there. The flux falls to 0 over a cell. */
static void test_uniform_band(void)
{
    enum { N = 1024 };
    static strip s;
    static double flux[N + 1];
    const double B = 12000, u = 7, length = 4e-4, q = 3e8;
    for (size_t i = 0; i <= N; i++)
        flux[i] = i <= N / 2 ? q : 0;
    heat(&s, B, u, length, N + 1, flux);
    double worst = 0, most = 1.1284 * q * sqrt(length / 2 / u) / B;
    for (size_t i = 16; i <= N; i++) {
        double x = length * (double)i / N, behind = fmax(x - length / 2 - length / N / 2, 0);
        double exact = 2 * q / (sqrt(pi) * B) * (sqrt(x / u) - sqrt(behind / u));
        if (i + 8 < N / 2 || i > N / 2 + 8)
            worst = fmax(worst, fabs(s.T[i] - exact) / most);
    }
    check_near("highest at the end of the band", s.T[N / 2], most, 1e-3);
    check_below("along a band of constant flux", worst, 1e-3);
}

/* Returns Blok's flash temperature under the heat flux q sqrt(1 - x^2/a^2) from -a to a, by
   quadrature after the substitution x - xi = y^2. */
static double hertz_exact(double x, double B, double u)
{
    enum { STEPS = 20000 };
    double end = sqrt(x), sum = 0;
    for (int k = 0; k < STEPS; k++) {
        double y = end * (k + 0.5) / STEPS, xi = x - y * y - 1;
        sum += 2 * sqrt(fmax(1 - xi * xi, 0)) * end / STEPS;
    }
    return sum / (sqrt(pi * u) * B);
}

static double error_hertz(size_t n)
{
    static strip s;
    static double flux[MOST_NODES];
    double worst = 0;
    for (size_t i = 0; i <= n; i++) {
        double x = 2.0 * (double)i / (double)n - 1;
        flux[i] = sqrt(fmax(1 - x * x, 0));
    }
    heat(&s, 1, 1, 2, n + 1, flux);
    for (size_t i = n / 8; i <= n; i += n / 16)
        worst = fmax(worst, fabs(s.T[i] - hertz_exact(2.0 * (double)i / (double)n, 1, 1)));
    return worst;
}

static void test_hertz(void)
{
    static strip s;
    static double flux[1025];
    double coarse = error_hertz(64), middle = error_hertz(256), fine = error_hertz(1024), most = 0;
    for (size_t i = 0; i <= 1024; i++) {
        double x = (double)i / 512 - 1;
        flux[i] = sqrt(fmax(1 - x * x, 0));
    }
    heat(&s, 1, 1, 2, 1025, flux);
    for (size_t i = 0; i <= 1024; i++)
        most = fmax(most, s.T[i]);
    /* Blok 1937: 1.11 of the mean flux pi/4, times sqrt(2 a/u)/B */
    check_near("Blok's Hertzian flash", most, 1.11 * pi / 4 * sqrt(2), 5e-3);
    check_below("flash along the contact", fine, 1e-3);
    check_true("falls with the cells, order 1.5 at the root of the edge", coarse > 4 * middle);
}

/* Constant flux on a flank at rest, T = 2 q sqrt(t/pi)/B. The backward Euler method is of first
   order. */
static double error_rest(int steps, double u)
{
    ehl_half_space f;
    ehl_passage p;
    const double end = 1e-3, B = 1.2e4, q = 1e6, dt = end / steps, dx = 1e-6;
    double modes[EHL_MODES] = {0}, past[EHL_MODES], T = 0;
    ehl_half_space_create(&f, B, end / 4000, end);
    ehl_half_space_pass(&f, u, dx, 1 / dt, &p);
    for (int k = 0; k < steps; k++) {
        double next[EHL_MODES];
        for (size_t j = 0; j < f.count; j++)
            past[j] = -modes[j] / dt;
        /* the temperature is uniform along the flank: the node upstream has the same modes */
        double ahead[EHL_MODES];
        for (size_t j = 0; j < f.count; j++)
            ahead[j] = (modes[j] / dt + q) / (f.lambda[j] + 1 / dt);
        T = ehl_half_space_reach(&f, &p, ahead, q, past, past, next) + p.own * q;
        ehl_half_space_add(&f, &p, q, next);
        memcpy(modes, next, sizeof modes);
    }
    return T / (2 * q * sqrt(end / pi) / B) - 1;
}

static void test_constant_flux(void)
{
    for (int k = 0; k < 3; k++) {
        double u = (double[]){0, 1e-3, 10}[k];
        double e1 = error_rest(50, u), e2 = error_rest(400, u);
        check_below("constant flux", fabs(e2), 2e-3);
        check_true("falls with the steps", fabs(e1) > 4 * fabs(e2));
    }
}

/* Checks the kernel itself, since a step response would average its errors. */
static void test_kernel(void)
{
    ehl_half_space f;
    double worst = 0;
    ehl_half_space_create(&f, 1, 1e-7, 1e-3);
    for (double t = 1e-7; t <= 1e-3; t *= 1.07) {
        double sum = 0;
        for (size_t k = 0; k < f.count; k++)
            sum += f.weight[k] * exp(-f.lambda[k] * t);
        worst = fmax(worst, fabs(sum * sqrt(t) - 1));
    }
    check_below("s^(-1/2) by modes", worst, 1e-3);
    check_true("few of them", f.count <= 20);
}

int main(void)
{
    test_kernel();
    test_uniform_band();
    test_hertz();
    test_constant_flux();
    return check_done();
}
