/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * What the models share that estimate the film without solving for the pressure: parameters,
 * ports, times, and results on the Hertzian contact. A model adds the film alone.
 */
#ifndef FF_EHL_ESTIMATE_H
#define FF_EHL_ESTIMATE_H

#include "assess.h"
#include "engagements.h"
#include "grid.h"
#include "inlet-heating.h"

#include <flankfilm/plugin.h>

enum {
    FF_ESTIMATE_CELLS,
    FF_ESTIMATE_INLET,
    FF_ESTIMATE_OUTLET,
    FF_ESTIMATE_STEPS,
    FF_ESTIMATE_LIGHT_LOAD,
    FF_ESTIMATE_OIL_CONDUCTIVITY,
    FF_ESTIMATE_TEMPERATURE_SLOPE,
    FF_ESTIMATE_SHARED, /* parameters of every such model; film-formula has those below, too */
    FF_ESTIMATE_FORMULA = FF_ESTIMATE_SHARED,
    FF_ESTIMATE_COEFFICIENT,
    FF_ESTIMATE_PARAMS
};

enum {
    FF_ESTIMATE_IN_TIME,
    FF_ESTIMATE_IN_RADIUS,
    FF_ESTIMATE_IN_SPEED_1,
    FF_ESTIMATE_IN_SPEED_2,
    FF_ESTIMATE_IN_LOAD,
    FF_ESTIMATE_IN_MODULUS,
    FF_ESTIMATE_IN_ROLL,
    FF_ESTIMATE_IN_GAP,
    FF_ESTIMATE_IN_ENGAGEMENT,
    FF_ESTIMATE_IN_VISCOSITY,
    FF_ESTIMATE_IN_DENSITY,
    FF_ESTIMATE_IN_RHEOLOGY,
    FF_ESTIMATE_IN_RQ_1,
    FF_ESTIMATE_IN_RQ_2,
    FF_ESTIMATE_IN_ROUGHNESS,
    FF_ESTIMATE_INPUTS
};

/* The series over time come first. */
enum {
    FF_ESTIMATE_TIME,
    FF_ESTIMATE_ROLL_ANGLE,
    FF_ESTIMATE_ENGAGEMENT,
    FF_ESTIMATE_H_MIN,
    FF_ESTIMATE_H_CENTRAL,
    FF_ESTIMATE_P_MAX,
    FF_ESTIMATE_FRICTION_COEFFICIENT,
    FF_ESTIMATE_TRACTION,
    FF_ESTIMATE_POWER_LOSS,
    FF_ESTIMATE_SLIDING_LOSS,
    FF_ESTIMATE_ROLLING_LOSS,
    FF_ESTIMATE_SQUEEZE_LOSS,
    FF_ESTIMATE_ASPERITY_LOSS,
    FF_ESTIMATE_H_MIN_ERROR,
    FF_ESTIMATE_LAMBDA_RATIO,
    FF_ESTIMATE_SERIES,
    FF_ESTIMATE_X = FF_ESTIMATE_SERIES,
    FF_ESTIMATE_FILM,
    FF_ESTIMATE_PRESSURE,
    FF_ESTIMATE_H_MIN_LOWEST,
    FF_ESTIMATE_H_MIN_LOWEST_AT,
    FF_ESTIMATE_P_MAX_HIGHEST,
    FF_ESTIMATE_LAMBDA_RATIO_LOWEST,
    FF_ESTIMATE_H_MIN_LOWEST_MEAN,
    FF_ESTIMATE_H_MIN_LOWEST_SPREAD,
    FF_ESTIMATE_ENGAGEMENTS_JUDGED,
    FF_ESTIMATE_OUTPUTS
};

extern const ff_param ff_estimate_params[FF_ESTIMATE_PARAMS];
extern const ff_port ff_estimate_inputs[FF_ESTIMATE_INPUTS];
extern const ff_port ff_estimate_outputs[FF_ESTIMATE_OUTPUTS];

/* One instant of the results. Loads below 1 % of the largest count as that for the film, which
   would grow beyond all bounds, and as they are for the pressure. */
typedef struct ff_moment {
    ff_instant at;   /* load: for the film */
    double load;     /* as it is */
    double a, p_max; /* Hertz, of at.load and of the load as it is */
    double moes_M, moes_L;
    double engagement; /* its number */
    int begins;        /* the first of an engagement */
} ff_moment;

/* A film at one instant. */
typedef struct ff_estimate_film {
    double h_min, h_central, error;
} ff_estimate_film;

typedef struct ff_estimate ff_estimate;

/* First member of a model's instance. */
struct ff_estimate {
    const ff_host *host;
    /* Films of the moments in their order, after one call of `begin`. */
    ff_status (*begin)(ff_estimate *e);
    void (*film)(ff_estimate *e, size_t k, ff_estimate_film *film);
    /* h at n places with |x| <= a of the moment whose film was asked for last. */
    void (*profile)(const ff_estimate *e, size_t k, size_t n, const double *x, double *h);
    void (*report)(const ff_estimate *e); /* its lines of the quality record */
    void (*end)(ff_estimate *e);

    size_t cells, steps; /* steps 0: the times of the history */
    double inlet, outlet, light_load;
    ff_inlet_heating heating;
    ff_laws laws;

    /* of one run */
    ff_history history;
    ff_oil oil;
    double alpha; /* film-forming, ff_oil_alpha, 1/Pa */
    ff_grid grid;
    size_t count;
    ff_moment *moment;
    double roughness; /* of both flanks, 0: unknown */
    int out_of_law;
    char reason[400]; /* of the last assessment */
};

/* With what the model's own errors come to, and its seconds for each time of the results. */
ff_status ff_estimate_assess(ff_estimate *e, uint64_t wanted, const ff_array *in,
                             double (*error)(const ff_scene *scene, ff_wishes wishes), double cost,
                             ff_assessment *a);

ff_status ff_estimate_judge(void *self, uint64_t wanted, uint32_t input, const void *service,
                            const ff_array *in, ff_assessment *a);

ff_status ff_estimate_set(void *self, uint32_t param, const ff_value *value);
ff_status ff_estimate_wire(void *self, uint32_t input, const void *service);
ff_status ff_estimate_evaluate(void *self, uint64_t wanted, const ff_array *in);

/* Gap of the dry Hertzian contact at |x|/a = s >= 1, over a^2/(2 R) (Johnson 1985, ch. 4.2). */
double ff_hertz_gap(double s);

/* Central film of Moes 2000 with any coefficient alpha, incompressible. */
double ff_estimate_moes(const ff_estimate *e, const ff_instant *at);

#endif
