/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One instant of a line contact, which a discretisation under test solves. */
#ifndef FILM_CASES_H
#define FILM_CASES_H

#include <flankfilm/conformance.h>
#include <flankfilm/film.h>

#include <stdbool.h>

enum { FILM_NODES = 193 };

/* Rigid flanks of constant viscosity, of which shear may make an oil thrice as fluid; or elastic
   ones of Barus' oil. FILM_EVEN: the nodes reach as far behind as in front. */
enum { FILM_PLAIN = 0, FILM_RIGID = 1, FILM_FLUID = 2, FILM_EVEN = 4 };

typedef struct film_case {
    const ff_fixture *fixture;
    void *model, *solver;
    const ff_film *film;
    double eta, alpha, rho; /* at p = 0; rho everywhere */
    ff_viscosity viscosity;
    ff_density density;
    ff_rheology rheology;
    ff_film_contact contact;
    ff_film_instant instant;
    ff_film_state state;
    double *p, *v, *past, *content; /* between guard zones, of FILM_NODES numbers */
    unsigned char full[FILM_NODES];
} film_case;

/* False when there is nothing to look at, which has been said; else to be closed. */
bool film_case_open(film_case *c, const ff_fixture *fixture, unsigned how);
/* False when it is no film, which has been said. */
bool film_case_solve(film_case *c);
void film_case_close(film_case *c);

double film_case_gap(const film_case *c, size_t node);
double film_case_load(const film_case *c); /* int p dx */
/* u rho h - f dp/dx between a node and the one before, kg/(m s). */
double film_case_flow(const film_case *c, size_t node);

bool film_case_near(const film_case *c, const char *what, size_t node, double value,
                    double expected, double scale, double tolerance);

#endif
