/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Errors of a film by the cells, relative: bounds, from what is known of films like it, and what
 * that of the peak is at an instant, by twins of its film on more cells. Those of h_min and
 * h_central: passage.h.
 */
#ifndef EHL_SPACE_ERROR_H
#define EHL_SPACE_ERROR_H

#include "../equations/solver.h"

#include <math.h>

/* Above them the lines of the quality record are doubtful, and the bounds are measured. */
#define EHL_FILM_LIMIT 0.02
#define EHL_PEAK_LIMIT 0.1

/* An error of a film by the cells above this share of it is not known, and infinite: neither the
   factors of the bounds nor the order by which twice the cells tell it hold so far. */
#define EHL_KNOWN_ERROR 0.5

static inline double ehl_known_error(double error)
{
    return fabs(error) <= EHL_KNOWN_ERROR ? error : (double)INFINITY;
}

/* What the bounds look at of a film. */
typedef struct ehl_crest {
    const double *p;
    double h_central, p_max;
} ehl_crest;

/* The spike at the outlet. */
typedef struct ehl_spike {
    double seen, tip; /* Pa: highest node, 0 where there is none, and what that may stand for */
    double cut;       /* the share of the tip that the cells cut off, by the formula */
    double error;     /* of p_max */
} ehl_spike;

enum { EHL_LEAST, EHL_CENTRAL, EHL_PEAK, EHL_BOUNDS };

/* Of h_min, h_central and p_max. */
typedef struct ehl_space_errors {
    double of[EHL_BOUNDS];
} ehl_space_errors;

ehl_space_errors ehl_space_bounds(const ehl_reynolds *eq, const ehl_instant *at, double modulus,
                                  const ehl_crest *of, ehl_spike *spike);

/* The film of an instant, and how it changes. */
typedef struct ehl_instant_film {
    double h_central, p_max;
    ehl_instant at;
    size_t cells;
    double frame;   /* m/s, speed of a frame in which the film changes slowly */
    double *change; /* of its mass there in time, at the nodes, kg/(m2 s) */
} ehl_instant_film;

/* Whether such a film is much the same. */
int ehl_is_like(const ehl_instant_film *f, double h_central, double p_max);

/*
 * Solves the contact of an instant, whose load is > 0, on the cells of `s`, on twice, four times as
 * many and on more, to 16 times, until it is known whether the error of the peak exceeds `enough`
 * > 0, or there is no such film on 8 or 16 times: then from those before. Gives that error of
 * run->p_max, relative. *finest: over the cells of `s`. On more cells than those of `run` the mass
 * changes in time as it does in `fine`, in the frame that moves with the spike of the outlet: what
 * moves with it is a change in time at one place which the cells have smoothed. FF_OK; FF_NOMEM;
 * FF_NOCONV where there is no such film, or another one than `run`.
 */
ff_status ehl_peak_error(const ehl_solver *s, const ehl_instant_film *run,
                         const ehl_instant_film *fine, double enough, double *error, int *finest);

#endif
