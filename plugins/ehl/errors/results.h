/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The results of a run that are kept, and which of its outputs are wanted. */
#ifndef EHL_RESULTS_H
#define EHL_RESULTS_H

#include "../contact/history.h"
#include "../contact/ports.h"
#include "balance.h"
#include "space-error.h"

/* Columns of the errors due to the cells, m and Pa: those of EHL_BOUNDS. The errors of h_min and
 * h_central have a sign: they are negative if the film is too thin. EHL_MEASURED, for h_min and
 * h_central: 1 if the error was found on more cells. EHL_NARROW, for p_max: infinite if the cells
 * do not resolve a peak; the remaining error if more cells did; else 0. EHL_TIP, for p_max, Pa: a
 * lower bound of its error if the film is not computed on more cells. EHL_PARTED: 1 if the flanks
 * carry no load. */
enum {
    EHL_MEASURED = EHL_BOUNDS,
    EHL_NARROW = EHL_MEASURED + EHL_PEAK,
    EHL_TIP,
    EHL_PARTED,
    EHL_SPACE
};

/* A bar is this many times the error that is estimated: by a linear equation; or from two grids, if
 * the error falls at second order, while at first order it would be so much larger. */
#define EHL_CAUTION 1.5

/* An output whose error crosses 0 is known no better than this share of the largest error of either
 * film. */
#define EHL_FLOOR (1. / 3)

/* A table of rows of equal width, which grows, since their number is only known at the end. */
typedef struct ehl_rows {
    double *data;
    size_t width, count, room;
} ehl_rows;

/* A row whose p_max was computed on more cells. */
typedef struct ehl_look {
    size_t row, begin; /* begin: first row of the passage before it */
    double tip;        /* Pa, p_max without the error due to the cells */
} ehl_look;

enum { EHL_LOOKS = 4 };

typedef struct ehl_results {
    const ff_host *host;
    ehl_balance balance;
    uint64_t wanted;
    size_t nodes;
    double boundary_friction;
    double roughness; /* m, combined rms of both flanks; 0: unknown */
    double cutoff;    /* m, longest wavelength of a roughness given by statistics; 0: that of
                         the contact */
    ehl_rows series, field[EHL_FIELDS]; /* width 0: not wanted */
    double *row;                        /* row of the series that is being filled in */
    double *tau, *ln_eta, *memory;
    double lowest, lowest_at, highest, least_lambda;
    ehl_lowest engagements;
    ehl_sampling sampling;
    double worst_load, worst_mass, worst_complement, lost_force;
    double least_resolution, least_inlet;
    double starvation, worst_starvation; /* share of the film: mean over a passage, its largest */
    int fed; /* the domain begins with the pressure that a longer one has there */
    double outlet_load, worst_outlet; /* share of the load: mean over a passage, its largest */
    double worst_in_time[2];          /* relative errors of h_min and h_central due to the steps */
    double least_in_time;             /* m, lowest value of h_min minus that error */
    double worst_peak_in_time,
        highest_in_time; /* p_max: relative; Pa, the highest that it may be */
    /* order of magnitude of the error due to the cells: of the last instant (0: none yet); of all
     */
    double by_cells, worst_by_cells;
    double tolerance; /* the largest tolerance that the films were solved to */
    double share;     /* share of the bound of p_max that remains at rows without a look; 1: all */
    ehl_look look[EHL_LOOKS]; /* in the order of their rows */
    size_t looks;
    double known_by_cells;  /* largest error of the last passage, relative */
    int measured[EHL_PEAK]; /* 1: h_min, h_central were measured at some rows */
    int finest;             /* largest number of cells used for that, divided by that of the run */
    size_t narrow;          /* the same for narrow peaks; 0: there are none */
    ehl_rows space;         /* what the cells add to h_min, h_central, p_max */
    double *row_in_space;   /* the row of `space` that is being filled in */
    double worst_gap_excess, widest_gap;                    /* while the contact is lost, m */
    double share_sum, ratio_sum, trapped_sum, worst_supply; /* sums over rough, loaded instants */
    double least_gap;                                       /* of statistical flanks, over sigma */
    double yield_sum, deepest_yield, worst_yield; /* the same; deepest_yield: plastic part, m */
    size_t loaded;
    double worst_squeezed; /* W/m, in the outer half of the inlet */
    double tail_share;     /* share of the pressure flow's loss that lies upstream of the domain */
    size_t starved;        /* instants without such a loss: the domain begins cavitated */
    double undecided;      /* the solver's counter when the mass was recorded last */
    ehl_law_answer laws;
    int rough;
    int judged;                      /* 1: errors that take time are estimated */
    int peaks;                       /* 1: errors of p_max are estimated */
    int lowest_alone, highest_alone; /* 1: no h_min, or no p_max, of another instant is wanted */
} ehl_results;

/* Returns the relative error of a film due to the position of the film's end within its cell, which
 * moves from node to node, so that the linear equation of the errors does not show it. (12.16)
 * changes all pressures by c dx^2/24 in the mean over the positions, and the load with them. The
 * film of a rigid cylinder is inversely proportional to the load; stiff oil makes the film of an
 * elastic contact nearly independent of it. */
double ehl_error_of_end(const ehl_march *m);

/* Fills in the losses of the film. */
void ehl_results_loss(ehl_results *r, const ehl_march *m);

/* Estimates the error, W/m, that the time steps cause in the rolling and squeeze parts of
 * power_loss: the largest of all instants; negative if there is no estimate. */
double ehl_results_loss_in_time(const ehl_results *r, const ehl_march *m);

/* Estimates the errors of the row that is being filled in; h_min is at `node`. */
void ehl_results_errors(ehl_results *r, const ehl_march *m, size_t node, double h_central,
                        double p_max);

/* Fills in the bars of h_min and h_central of the newest film due to the cells, from the transport
 * of its errors: relative, negative if the film is too thin. */
void ehl_results_transported(ehl_results *r, const ehl_march *m, double *error);

/* Returns a bound of the error of p_max due to the cells in the newest film of the march, Pa;
 * infinite if the cells do not resolve its peak. The reynolds must have the gap of that film. */
double ehl_peak_bound(const ehl_march *m);

/* Keeps the newest film of the march; f->change has room for its nodes. */
void ehl_space_keep(const ehl_march *m, ehl_instant_film *f);

/* Measures the errors whose bounds are above their limits. Errors of h_min and h_central are
   measured only if the run has several films. `whole` has all engagements; equal: the lengths of
   the steps were given. */
ff_status ehl_results_measure(ehl_results *r, const ehl_march *m, const ehl_history *whole,
                              int equal);

/* Returns the error of h_min, h_central or p_max of a row due to the cells, m or Pa. */
double ehl_space_part(const ehl_results *r, size_t row, int kind);

/* 1: only the extreme of h_min, or of p_max, over all instants is wanted. */
int ehl_wants_lowest_alone(uint64_t wanted);
int ehl_wants_highest_alone(uint64_t wanted);

/* Whether an output is wanted that depends on h_min, h_central or p_max. Friction depends on the
 * central film. */
int ehl_wants_h_min(uint64_t wanted);
int ehl_wants_h_central(uint64_t wanted);
int ehl_wants_p_max(uint64_t wanted);

/* The first function returns the least film of the gap of r, by a parabola, and sets *at to its
 * node. The second function returns the film at x = 0. */
double ehl_least_film(const ehl_reynolds *r, size_t *at);
double ehl_central_film(const ehl_grid *g, const ehl_reynolds *r);

/* Returns 1 if an error of a film due to the cells is estimated. */
int ehl_results_estimate_cells(const ehl_results *r);
/* Writes the quality lines of these errors. */
void ehl_results_report_cells(const ehl_results *r, const ehl_march *m);

/* 1: an output is wanted that needs the shear stress, or one that needs the pressure flow. */
int ehl_loss_of_shear(uint64_t wanted);
int ehl_loss_of_flow(uint64_t wanted);

#endif
