/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One instant of a line contact, to be solved by a discretisation under test. */
#ifndef FILM_CASES_H
#define FILM_CASES_H

#include <flankfilm/conformance.h>
#include <flankfilm/film.h>

#include <stdbool.h>

enum { FILM_NODES = 193 };

/* The cases: elastic flanks with Barus' oil (FILM_PLAIN), or rigid flanks with constant viscosity
   (FILM_RIGID), which shear makes three times as fluid if FILM_FLUID is set. FILM_EVEN: the nodes
   extend as far behind the contact as in front of it. */
enum { FILM_PLAIN = 0, FILM_RIGID = 1, FILM_FLUID = 2, FILM_EVEN = 4 };

typedef struct film_case {
    const ff_fixture *fixture;
    void *model, *solver;
    const ff_film *film;
    double eta, alpha, rho; /* eta and alpha at p = 0; rho at any p */
    ff_viscosity viscosity;
    ff_density density;
    ff_rheology rheology;
    ff_film_contact contact;
    ff_film_instant instant;
    ff_film_state state;
    double *p, *v, *past, *content; /* arrays of FILM_NODES numbers between guard zones */
    unsigned char full[FILM_NODES];
} film_case;

/* If there is nothing to check, reports why and returns false; otherwise the caller closes the
   case. */
bool film_case_open(film_case *c, const ff_fixture *fixture, unsigned how);
/* If the result is no valid film, reports why and returns false. */
bool film_case_solve(film_case *c);
void film_case_close(film_case *c);

double film_case_gap(const film_case *c, size_t node);
double film_case_load(const film_case *c); /* int p dx */
/* Returns the flow u rho h - f dp/dx between a node and the one before it, kg/(m s). */
double film_case_flow(const film_case *c, size_t node);

bool film_case_near(const film_case *c, const char *what, size_t node, double value,
                    double expected, double scale, double tolerance);

#endif
