/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The laws of a lubricant card are the same oil: with its eta0, the same film-forming coefficient
 *   alpha* = 1/int_0^inf eta0/eta dp
 * as the data that the card names, and eta within 20 % of them as far as the card says. Reads the
 * constants from the cards themselves, so that card and claim cannot part.
 */
#include "check.h"
#include "stage.h"

#include <flankfilm/rheology.h>
#include <flankfilm/viscosity.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { LAWS = 4 };
static const char *const ids[LAWS] = {"viscosity/roelands", "viscosity/doolittle-tait",
                                      "viscosity/two-slope", "viscosity/barus"};

/* Returns ln(eta/eta0) at p, Pa; c: constants of the oil. NULL instead: the card's Doolittle-Tait
   law, if the data have only alpha. */
typedef double shape(const double *c, double p);

typedef struct card {
    const char *file;
    double eta0, alpha; /* Pa s, 1/Pa, of the data */
    shape *data;
    double constant[5];
    double range;       /* GPa, up to which the laws are compared */
    double reach[LAWS]; /* GPa, stated by the card */
} card;

/* p/(A + B p), A = c0 + c1 T, B = c2 + c3 T */
static double paluch(const double *c, double p)
{
    const double T = 353.15;
    return p / (c[0] + c[1] * T + (c[2] + c[3] * T) * p);
}

static double roelands(const double *c, double p)
{
    return (log(c[0]) + 9.67) * (pow(1 + 5.1e-9 * p, c[1]) - 1);
}

/* 5P4E at 100 degC; constant above 0.75 GPa, where it is a glass. */
static double yasutomi(const double *c, double p)
{
    double part[2];
    (void)c;
    for (int i = 0; i < 2; i++) {
        double g = i * fmin(1e-9 * p, 0.75);
        double t = 100 + 28.2 - 134.2 * log(1 + 1.929 * g), F = 1 - 4.815 * log(1 + 0.160 * g);
        part[i] = -16.01 * t * F / (20.69 + t * F) * log(10);
    }
    return part[1] - part[0];
}

static const card cards[] = {
    {"mil-l-23699.yaml", 5.006e-3, 11.0e-9, NULL, {0}, 1, {0.39, 1, 1, 0.24}},
    {"mil-l-27502.yaml", 4.692e-3, 10.918e-9, NULL, {0}, 1, {0.39, 1, 1, 0.24}},
    {"santotrac-50.yaml", 7.656e-3, 20.921e-9, NULL, {0}, 1, {0.15, 1, 0.13, 0.14}},
    {"sae-30.yaml", 14.90e-3, 19e-9, NULL, {0}, 1, {0.18, 1, 0.14, 0.15}},
    {"gear-oil-mineral.yaml",
     29.893e-3,
     16.469e-9,
     paluch,
     {-2.28e7, 2.26e5, -0.0682, 2.768e-4},
     1,
     {0.45, 0.22, 0.21, 0.22}},
    {"vg-100-naphthenic.yaml",
     13.39e-3,
     19.822e-9,
     paluch,
     {-7.23e7, 3.48e5, 5.00e-3, -1.83e-5},
     1,
     {0.22, 0.18, 1, 0.67}},
    {"vg-100-paraffinic.yaml",
     15.75e-3,
     16.469e-9,
     paluch,
     {-2.28e7, 2.26e5, -0.0682, 2.768e-4},
     1,
     {0.78, 0.24, 0.21, 0.22}},
    {"vg-100-pao.yaml",
     18.83e-3,
     11.290e-9,
     paluch,
     {-5.73e7, 3.90e5, -0.0395, 2.354e-4},
     1,
     {0.42, 0.37, 0.27, 0.3}},
    {"pao-b.yaml", 22.61e-3, 12.326e-9, roelands, {22.61e-3, 0.485674}, 1, {1, 1, 0.21, 0.24}},
    {"cardiff-reference.yaml",
     9.6e-3,
     15.552e-9,
     roelands,
     {9.6e-3, 0.663524},
     1,
     {1, 0.3, 0.21, 0.22}},
    {"5p4e.yaml", 16.40e-3, 14.337e-9, yasutomi, {0}, 0.5, {0.17, 0.19, 0.17, 0.18}},
};
enum { CARDS = sizeof cards / sizeof cards[0] };

static char text[16384];

static void folder(char *path, size_t size, const char *name)
{
    const char *source = getenv("FLANKFILM_TEST_SOURCE");
    snprintf(path, size, "%s/configs/lubricants/%s", source ? source : ".", name);
}

static void read_card(const char *name)
{
    char path[1024];
    folder(path, sizeof path, name);
    FILE *file = fopen(path, "r");
    size_t length = file ? fread(text, 1, sizeof text - 1, file) : 0;
    text[length] = 0;
    if (file)
        fclose(file);
    printf("%s\n", name);
    check_true("  can be read", length > 0);
}

/* Opens a law with the parameters in the card's line "id: {key: value, ...}". */
static stage *open_law(const char *id)
{
    char line[128], key[64], value[64];
    snprintf(line, sizeof line, "      %s: {", id);
    const char *at = strstr(text, line);
    stage *s = stage_open(id);
    check_true(id, at != NULL);
    for (at = at ? at + strlen(line) : NULL; at && *at != '}'; at += strspn(at, ", ")) {
        if (sscanf(at, "%63[^:}]: %63[^,}]", key, value) == 2)
            stage_set_text(s, key, value);
        at += strcspn(at, ",}");
    }
    return s;
}

/* Opens a viscosity law with the values that it would get from the oil. */
static stage *open_viscosity(const char *id, double eta0)
{
    stage *s = open_law(id);
    stage_set(s, "eta0", eta0);
    return s;
}

static double ln_eta(const ff_viscosity *v, double p)
{
    double value;
    v->eval(v->self, 1, &p, NULL, &value, NULL, NULL);
    return value;
}

static double rise(const card *c, const ff_viscosity *shape_of_card, double p)
{
    return c->data ? c->data(c->constant, p) : ln_eta(shape_of_card, p) - ln_eta(shape_of_card, 0);
}

/* Returns the integral of eta0/eta to 4 GPa, of a law, or of the data if v is NULL, by Simpson's
   rule: the rest is below exp(-17), the error of the rule below 1e-8. */
static double film_forming(const card *c, const ff_viscosity *v, const ff_viscosity *own)
{
    enum { N = 4000 };
    const double step = 4e9 / N;
    double sum = 0;
    for (int i = 0; i <= N; i++) {
        double up = v ? ln_eta(v, i * step) - ln_eta(v, 0) : rise(c, own, i * step);
        sum += (i == 0 || i == N ? 1 : i % 2 ? 4 : 2) * exp(-up);
    }
    return 3 / (sum * step);
}

/* Returns the pressure, GPa, up to which eta is within 20 % of the data. */
static double reach(const card *c, const ff_viscosity *v, const ff_viscosity *own)
{
    enum { N = 400 };
    for (int i = 1; i <= N; i++) {
        double p = 1e9 * c->range * i / N;
        if (fabs(exp(ln_eta(v, p) - ln_eta(v, 0) - rise(c, own, p)) - 1) > 0.2)
            return c->range * (i - 1) / N;
    }
    return c->range;
}

static void check_viscosity(const card *c)
{
    stage *shape_stage = open_viscosity("viscosity/doolittle-tait", c->eta0);
    const ff_viscosity *own = stage_service(shape_stage, FF_VISCOSITY_ID);
    check_near("  alpha* of the data", film_forming(c, NULL, own), c->alpha, 2e-4);
    for (int i = 0; i < LAWS; i++) {
        stage *s = open_viscosity(ids[i], c->eta0);
        const ff_viscosity *v = stage_service(s, FF_VISCOSITY_ID);
        check_near("  alpha*", film_forming(c, v, own), c->alpha, 2e-4);
        double far = reach(c, v, own);
        check_true("  within 20 % as far as stated, and no farther",
                   far > c->reach[i] - 1e-9 && far < c->reach[i] + 0.011);
        stage_close(s);
    }
    stage *iso = open_viscosity("viscosity/isoviscous", c->eta0);
    check_true("  isoviscous", stage_ready(iso) == FF_OK);
    stage_close(iso);
    stage_close(shape_stage);
}

static double stress(const ff_rheology *law, double ln_tau)
{
    /* a film of 1 m at 1 m/s, whose Newtonian stress is eta; p is so high that the limiting stress
       has no effect */
    const double p = 1e12, h = 1;
    double tau;
    law->shear(law->self, 1, &p, &ln_tau, &h, 1, &tau);
    return tau;
}

/* viscosity/modulus, which uses the measured data directly, must agree with the data of the
   card. */
static void check_modulus(const card *c)
{
    if (!strstr(text, "      viscosity/modulus: {base"))
        return;
    stage *s = open_viscosity("viscosity/modulus", c->eta0);
    const ff_viscosity *v = stage_service(s, FF_VISCOSITY_ID);
    const double T = 353.15;
    double off = 0;
    for (double p = 1e8; p < 3e9; p += 1e8) {
        double ln;
        v->eval(v->self, 1, &p, &T, &ln, NULL, NULL);
        off = fmax(off, fabs((ln - log(c->eta0)) / c->data(c->constant, p) - 1));
    }
    check_below("  the data themselves", off, 1e-12);
    stage_close(s);
}

/* Carreau's law must agree with Ree-Eyring's up to S = 100, tau = 5.3 tau0; for stresses `auto`,
   tests/plugins/rheology/at-pressure.c checks this. */
static void check_rheology(void)
{
    if (strstr(text, "      rheology/ree-eyring: {tau0: auto")) {
        check_true("  both are auto", strstr(text, "      rheology/carreau: {G: auto") != NULL);
        return;
    }
    stage *a = open_law("rheology/ree-eyring"), *b = open_law("rheology/carreau");
    stage *newton = open_law("rheology/newtonian");
    const ff_rheology *eyring = stage_service(a, FF_RHEOLOGY_ID);
    const ff_rheology *carreau = stage_service(b, FF_RHEOLOGY_ID);
    double worst = 0, tau0 = 0;
    for (int i = 0; i < 40; i++) /* tau = tau0 asinh(1e9 Pa/tau0) */
        tau0 = stress(eyring, log(1e9)) / asinh(1e9 / fmax(tau0, 1e6));
    for (double S = 0.1; S <= 100; S *= 1.2) {
        double ln_tau = log(S * tau0);
        worst = fmax(worst, fabs(stress(carreau, ln_tau) / stress(eyring, ln_tau) - 1));
    }
    check_below("  Carreau against Ree-Eyring", worst, 0.05);
    check_true("  Newtonian", stage_ready(newton) == FF_OK);
    stage_close(a);
    stage_close(b);
    stage_close(newton);
}

static void check_density(void)
{
    static const char *const density[] = {"density/dowson-higginson", "density/tait",
                                          "density/incompressible"};
    stage *oil = stage_open("lubricant/grade");
    stage_set_text(oil, "grade", "ISO VG 100");
    for (int i = 0; i < 3; i++) {
        stage *s = open_law(density[i]);
        stage_link(s, "oil", oil);
        check_true("  is complete", stage_ready(s) == FF_OK);
        stage_close(s);
    }
    stage_close(oil);
}

/* eta0 and alpha of oils with correlations for only these: ADORE, T in K. */
static void check_correlations(void)
{
    double d = (311.1111 - 373.15) / (311.1111 * 373.15);
    double mil = 0.0276 * exp(3710.8 * d + 7.3904e5 * d * d), T = 353.15;
    double power = pow(10, 9.5363 - 3.7452 * log10(T)), dn = 0.82 + 6.21e-4 * (422.222 - T);
    check_near("eta0 of MIL-L-27502", mil, 4.692e-3, 1e-3);
    check_near("alpha of MIL-L-27502", exp(1.15607 * log(mil) - 17.496) / mil, 10.918e-9, 2e-4);
    check_near("eta0 of Santotrac 50", 1e-3 * dn * (pow(10, power) - 0.8), 7.656e-3, 1e-3);
    check_near("alpha of Santotrac 50", 3.916e-8 * exp(-0.0083178 * (T - 277.78)), 20.921e-9, 2e-4);
    d = (311.1111 - T) / (311.1111 * T);
    check_near("eta0 of SAE 30", 0.07166 * exp(4104.3 * d), 14.90e-3, 1e-3);
    check_near("eta0 of PAO-B", pow(10, -4.2 + 4.57 * pow(1 + 80 / 135., -1.25)), 22.61e-3, 1e-3);
}

/* Prints the laws of a card over pressure, for docs/validation. */
static int print_card(const char *name)
{
    const card *c = cards;
    while (c < cards + CARDS && strcmp(c->file, name) != 0)
        c++;
    if (c == cards + CARDS)
        return 1;
    read_card(name);
    const ff_viscosity *law[LAWS];
    stage *open[LAWS];
    for (int i = 0; i < LAWS; i++) {
        open[i] = open_viscosity(ids[i], c->eta0);
        law[i] = stage_service(open[i], FF_VISCOSITY_ID);
    }
    printf("p [Pa]");
    for (int i = 0; i < LAWS; i++)
        printf(",%s [Pa s]", strchr(ids[i], '/') + 1);
    for (int k = 0; k <= 100; k++) {
        printf("\n%.6g", 1e7 * k);
        for (int i = 0; i < LAWS; i++)
            printf(",%.6g", exp(ln_eta(law[i], 1e7 * k)));
    }
    printf("\n");
    for (int i = 0; i < LAWS; i++)
        stage_close(open[i]);
    return 0;
}

int main(int argc, char **argv)
{
    if (argc == 3 && !strcmp(argv[1], "print"))
        return print_card(argv[2]);
    check_correlations();
    for (size_t k = 0; k < CARDS; k++) {
        read_card(cards[k].file);
        check_viscosity(&cards[k]);
        check_modulus(&cards[k]);
        check_rheology();
        check_density();
    }
    return check_done();
}
