/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The laws of a lubricant card are the same oil: same eta0, same film-forming coefficient
 *   alpha* = 1/int_0^inf eta0/eta dp.
 * Reads the constants from the card itself, so that card and claim cannot part.
 */
#include "host.h"

#include <flankfilm/viscosity.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static char card[16384];

static void read_card(const char *name)
{
    char path[1024];
    const char *source = getenv("FLANKFILM_TEST_SOURCE");
    snprintf(path, sizeof path, "%s/configs/lubricants/%s", source ? source : ".", name);
    FILE *file = fopen(path, "r");
    size_t length = file ? fread(card, 1, sizeof card - 1, file) : 0;
    card[length] = 0;
    if (file)
        fclose(file);
    printf("%s\n", name);
    check_true("  can be read", length > 0);
}

/* Sets every "key: value" line that stands deeper than the line "id:" of the card. */
static stage *open_law(const char *id)
{
    char line[128], key[64], text[64];
    snprintf(line, sizeof line, "      %s:", id);
    const char *at = strstr(card, line);
    stage *s = stage_open(id);
    check_true("  the card has the law", at != NULL);
    while (at && (at = strchr(at, '\n')) && !strncmp(at + 1, "        ", 8)) {
        at++;
        if (sscanf(at, " %63[^:]: %63[^\n]", key, text) == 2)
            stage_set_text(s, key, text);
    }
    return s;
}

/* Simpson's rule to 4 GPa: the rest is below exp(-17), the rule's error below 1e-8. */
static double film_forming(const ff_viscosity *v, double *ln_eta0)
{
    enum { N = 4000 };
    const double step = 4e9 / N;
    double sum = 0, p = 0, ln_eta;
    v->eval(v->self, 1, &p, NULL, ln_eta0, NULL, NULL);
    for (int i = 0; i <= N; i++) {
        p = i * step;
        v->eval(v->self, 1, &p, NULL, &ln_eta, NULL, NULL);
        sum += (i == 0 || i == N ? 1 : i % 2 ? 4 : 2) * exp(*ln_eta0 - ln_eta);
    }
    return 3 / (sum * step);
}

static void check_card(const char *name, double alpha, double eta0)
{
    static const char *const ids[] = {"viscosity/doolittle-tait", "viscosity/roelands",
                                      "viscosity/barus", "viscosity/isoviscous"};
    read_card(name);
    for (int i = 0; i < 4; i++) {
        double ln_eta0;
        stage *s = open_law(ids[i]);
        double found = film_forming(stage_service(s, FF_VISCOSITY_ID), &ln_eta0);
        printf("  %s\n", ids[i]);
        check_near("  eta0", exp(ln_eta0), eta0, 1e-3);
        if (i < 3)
            check_near("  alpha*", found, alpha, 2e-4);
        stage_close(s);
    }
}

/* alpha* of M100 at 80 degC, the target of the VG 220 card. */
static double m100(void)
{
    enum { N = 4000 };
    const double T = 353.15, A = -2.28e7 + 2.26e5 * T, B = -0.0682 + 2.768e-4 * T;
    const double step = 3e9 / N;
    double sum = 0;
    for (int i = 0; i <= N; i++) {
        double p = i * step;
        sum += (i == 0 || i == N ? 1 : i % 2 ? 4 : 2) * exp(-p / (A + B * p));
    }
    return 3 / (sum * step);
}

int main(void)
{
    check_card("mil-l-23699-100C.yaml", 11.0e-9, 5.006e-3);
    check_near("alpha* of M100", m100(), 16.47e-9, 2e-4);
    check_card("iso-vg-220-80C.yaml", 16.47e-9, 29.893e-3);
    return check_done();
}
