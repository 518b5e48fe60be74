/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The inputs of a dynamic model from the gear, operating and stiffness stages, checked and made
   dimensionless. */
#ifndef DYNAMICS_INPUTS_H
#define DYNAMICS_INPUTS_H

#include "excitation.h"
#include "fluctuation.h"
#include "spring.h"

#include <flankfilm/author.h>

enum {
    DYNAMICS_IN_ROLL_ANGLE,
    DYNAMICS_IN_ROLL_SAP,
    DYNAMICS_IN_TEETH,
    DYNAMICS_IN_BACKLASH,
    DYNAMICS_IN_EQUIVALENT_MASS,
    DYNAMICS_IN_MESH_FREQUENCY,
    DYNAMICS_IN_LINE_FORCE,
    DYNAMICS_IN_PHASE,
    DYNAMICS_IN_STIFFNESS,
    DYNAMICS_IN_STIFFNESS_MEAN,
    DYNAMICS_IN_TRANSMISSION_ERROR,
    DYNAMICS_IN_LOADED_ERROR,
    DYNAMICS_IN_TOOTH_FORCE,
    DYNAMICS_IN_LOAD_SHARE,
    DYNAMICS_IN_FORCE_LEVEL,
    DYNAMICS_IN_LEVEL_ERROR,
    DYNAMICS_IN_LEVEL_STIFFNESS,
    DYNAMICS_IN_LEVEL_TOOTH_FORCE,
    DYNAMICS_IN_REFERENCE_FORCE,
    DYNAMICS_IN_FLUCTUATION_ORDER,
    DYNAMICS_IN_FLUCTUATION_COSINE,
    DYNAMICS_IN_FLUCTUATION_SINE,
    DYNAMICS_IN_FLUCTUATION_PERIOD,
    DYNAMICS_IN_DRIVEN_MASS,
    DYNAMICS_IN_BACK_PHASE,
    DYNAMICS_IN_BACK_OFFSET,
    DYNAMICS_IN_BACK_STIFFNESS,
    DYNAMICS_IN_BACK_ERROR,
    DYNAMICS_IN_BACK_LOADED_ERROR,
    DYNAMICS_IN_BACK_LEVEL_ERROR,
    DYNAMICS_IN_BACK_LEVEL_STIFFNESS,
    DYNAMICS_IN_BACK_LEVEL_TOOTH_FORCE,
    DYNAMICS_INPUT_COUNT,
    /* read only by a model with flexible bearings */
    DYNAMICS_IN_BASE_RADIUS = DYNAMICS_INPUT_COUNT,
    DYNAMICS_IN_CENTRE_DISTANCE,
    DYNAMICS_IN_MASS,
    DYNAMICS_COUPLED_INPUT_COUNT
};

/* Further inputs after those of all models, for models with feedback between motion and film and
   for models with an oil film between separated flanks. */
enum {
    DYNAMICS_IN_RADIUS_1 = DYNAMICS_INPUT_COUNT,
    DYNAMICS_IN_RADIUS_2,
    DYNAMICS_IN_FACE_WIDTH,
    DYNAMICS_IN_INERTIA,
    DYNAMICS_IN_FILM_ROLL_ANGLE,
    DYNAMICS_IN_FILM_ENGAGEMENT,
    DYNAMICS_IN_FILM_TRACTION,
    DYNAMICS_IN_FILM_ROLLING_LOSS,
    DYNAMICS_IN_FILM_POWER_LOSS,
    DYNAMICS_IN_FILM_H_CENTRAL,
    DYNAMICS_IN_FILM_P_MAX,
    DYNAMICS_IN_FILM_LOAD,
    DYNAMICS_IN_FILM_SEPARATION,
    DYNAMICS_LOOP_INPUT_COUNT,
    DYNAMICS_IN_ETA0 = DYNAMICS_LOOP_INPUT_COUNT,
    DYNAMICS_OIL_INPUT_COUNT
};

extern const ff_port dynamics_oil_input_ports[DYNAMICS_OIL_INPUT_COUNT];
extern const ff_port dynamics_input_ports[DYNAMICS_COUPLED_INPUT_COUNT];

/* Inertia parameters of the user. If both are NaN, the gear's inertia is used. */
typedef struct dynamics_inertia {
    double equivalent_mass, natural_frequency; /* kg, Hz */
} dynamics_inertia;

/* Parameter rows for the members `zeta`, `damping` and `inertia` of the instances of several
   models. `low` is the smallest damping ratio with which the model was checked. */
#define DYNAMICS_DAMPING_RATIO_ROW(type, low)                                                      \
    FF_QUANTITY("damping_ratio", "1", type, zeta, 0, "0.01", NULL, 0, 10, low, 0.2,                \
                "damping over critical damping at the mean stiffness, c/(2 sqrt(k m))")
#define DYNAMICS_DAMPING_ROW(type)                                                                 \
    FF_ONE_OF("always|contact|clipped", "damping", type, damping, 0, "always",                     \
              "when the damper acts. always: also in free flight (Li & Kahraman 2011); contact: "  \
              "only in contact; clipped: only in contact, and the mesh force never pulls")
#define DYNAMICS_FORCE_ROW(type)                                                                   \
    FF_ONE_OF(                                                                                     \
        "frozen|shared", "force", type, force, 0, "frozen",                                        \
        "model of the mesh force. frozen: load sharing and tangent stiffness at the mean load; "   \
        "shared: load sharing at every force, for which the stiffness must give several levels, "  \
        "force_level")
#define DYNAMICS_INERTIA_ROWS(type)                                                                \
    FF_QUANTITY("equivalent_mass", "kg", type, inertia.equivalent_mass, FF_MIN_OPEN, NULL,         \
                "inertia", 0, 1e9, 0, 0,                                                           \
                "equivalent mass at the mesh spring; default: that of the gear"),                  \
        FF_QUANTITY(                                                                               \
            "natural_frequency", "Hz", type, inertia.natural_frequency, FF_MIN_OPEN, NULL,         \
            "inertia", 0, 1e9, 0, 0,                                                               \
            "natural frequency of small vibrations at the mean of the wired stiffness (tangent "   \
            "or secant), instead of equivalent_mass")

typedef struct dynamics_inputs {
    double line_force, mesh_frequency, natural_frequency; /* N, Hz, Hz */
    double reference; /* N; force at which the curves and load shares of the mesh were
                         computed */
    dynamics_fluctuation fluctuation;
    size_t span;           /* mesh cycles after which the excitation repeats; these form one
                              cycle with phases 0 to 1 */
    double unit_frequency; /* mesh frequency (Hz) at which `span` mesh cycles take as long as one
                              period of the natural frequency */
    size_t stations;
    const double *roll_angle, *tooth_force, *load_share; /* load_share may be NULL */
    dynamics_mesh_curves curves;
    const double *loaded_error; /* m, at the phases of the curves; NULL: not known */
    dynamics_force_levels levels;
    dynamics_force_levels back_levels; /* levels of the back flanks, which the mean load does not
                                        * press */
    double back_offset;                /* phase shift of the back flanks, mesh cycles; NaN: their
                                        * curves are not known */
    int constant;           /* whether neither stiffness nor error depends on the phase */
    int shared;             /* whether the motion uses the levels, and load shares depend on the
                               mesh force */
    double roll_sap, pitch; /* rad; pitch: roll angle of one mesh cycle */
    int back;               /* whether gear 2 drives; all members then belong to the pair with
                               exchanged gears */
    uint64_t wanted;        /* bit mask of the requested outputs; set by the model */
} dynamics_inputs;

/* Evaluates a model that supports both driving directions. If gear 2 drives (`back`),
   the inputs are those of the pair with exchanged gears. `force` is the row of the
   tooth forces. */
typedef ff_status dynamics_evaluation(void *self, uint64_t wanted, const ff_array *in, int back);
ff_status dynamics_evaluate(const ff_host *host, const ff_port *ports, size_t count, size_t force,
                            const ff_array *in, dynamics_evaluation *evaluation, void *self,
                            uint64_t wanted);

/* Reorders rows over the stations of the exchanged gears (`total` values) to the order
   of gear 1. */
void dynamics_put_stations(double *x, size_t stations, size_t total, int back);

/* Checks and reads all inputs. zeta and damping of `excitation` are already set. The caller frees
   `excitation` with dynamics_excitation_free. */
ff_status dynamics_inputs_read(const ff_host *host, const ff_array *in,
                               const dynamics_inertia *inertia, dynamics_inputs *inputs,
                               dynamics_excitation *excitation);

/* Returns whether nothing presses the flanks together, so that every position in the backlash is an
   equilibrium. */
int dynamics_floats(const dynamics_inputs *inputs, const dynamics_excitation *excitation);
void dynamics_floating_line(const ff_host *host);

/* Returns FF_UNSUPPORTED if torque or speed fluctuate; `order` is the input row of their orders.
   `what` names the part of the model that needs a motion with the period of the mesh. */
ff_status dynamics_refuse_fluctuation(const ff_host *host, const ff_array *order, const char *what);

/* Converts a parameter that is a number or `auto` (-1) to a count; `auto` becomes 0. */
static inline size_t dynamics_count_or_auto(int64_t value)
{
    return value < 0 ? 0 : (size_t)value;
}

/* Returns the number of mesh cycles in one cycle of the excitation. */
static inline size_t dynamics_span(const dynamics_inputs *inputs)
{
    return inputs->span > 1 ? inputs->span : 1;
}

/* Converts a count of mesh cycles to cycles of the excitation, rounded up. */
static inline size_t dynamics_cycles(const dynamics_inputs *inputs, int64_t mesh_cycles)
{
    return ((size_t)mesh_cycles + dynamics_span(inputs) - 1) / dynamics_span(inputs);
}

/* Sets the ends of an atlas (Hz) that are not given (0) from the natural frequency. */
ff_status dynamics_atlas_bounds(const ff_host *host, double natural, double *from, double *to);

/* Declares parameters and inputs without effect, when called in `ready`: the inertia of the gear if
   the user gives an inertia, and `damping` if the damping ratio is 0. `zeta` is NaN if the model
   has no parameter `damping`. */
void dynamics_tell_servings(const ff_host *host, const dynamics_inertia *inertia, double zeta);

/* dynamics_tell_atlas declares, when called in `ready`, that the ends of the atlas affect only
   these outputs. */
#define DYNAMICS_ATLAS_OUTPUTS                                                                     \
    "stable_motions|atlas_frequency|atlas_rms|atlas_stable|atlas_branch|atlas_floquet_max|"        \
    "fold_frequency|fold_branch|doubling_frequency|doubling_branch"
void dynamics_tell_atlas(const ff_host *host, const char *outputs);

/* Returns the natural frequency of the linear system at the mean stiffness,
   sqrt(k/m)/(2 pi), Hz, or 0 if the mass is not known. */
ff_status dynamics_natural_frequency(const ff_host *host, const dynamics_inertia *inertia,
                                     const ff_array *gear_mass, double stiffness,
                                     double *frequency);

#endif
