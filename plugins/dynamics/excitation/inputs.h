/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a dynamic model reads from gear, duty and mesh, checked and made dimensionless. */
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
    DYNAMICS_INPUT_COUNT,
    /* read only by a model whose gears move on their bearings */
    DYNAMICS_IN_BASE_RADIUS = DYNAMICS_INPUT_COUNT,
    DYNAMICS_IN_CENTRE_DISTANCE,
    DYNAMICS_IN_MASS,
    DYNAMICS_COUPLED_INPUT_COUNT
};

/* Behind those of all models: read by models of the loop of motion and film, and by one that knows
   the oil between parted flanks. */
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

/* The inertia that the user gives; both NaN: that of the gear. */
typedef struct dynamics_inertia {
    double equivalent_mass, natural_frequency; /* kg, Hz */
} dynamics_inertia;

/* Parameters that several models have: members `zeta`, `damping` and `inertia` of their instances.
   `low` is the least damping ratio that the model was checked with. */
#define DYNAMICS_DAMPING_RATIO_ROW(type, low)                                                      \
    FF_QUANTITY("damping_ratio", "1", type, zeta, 0, "0.01", NULL, 0, 10, low, 0.2,                \
                "damping over critical damping at the mean stiffness, c/(2 sqrt(k m))")
#define DYNAMICS_DAMPING_ROW(type)                                                                 \
    FF_ONE_OF("always|contact|clipped", "damping", type, damping, 0, "always",                     \
              "when the damper acts: always (also in free flight, as Li & Kahraman 2011), in "     \
              "contact only, or in contact and clipped so that the flanks never pull")
#define DYNAMICS_FORCE_ROW(type)                                                                   \
    FF_ONE_OF(                                                                                     \
        "frozen|shared", "force", type, force, 0, "frozen",                                        \
        "mesh force: frozen at the sharing and the slope of the mean load, or shared anew at "     \
        "every force, of a stiffness that knows it at several (force_level)")
#define DYNAMICS_INERTIA_ROWS(type)                                                                \
    FF_QUANTITY("equivalent_mass", "kg", type, inertia.equivalent_mass, FF_MIN_OPEN, NULL,         \
                "inertia", 0, 1e9, 0, 0, "mass that the mesh spring sees; default: the gear's"),   \
        FF_QUANTITY(                                                                               \
            "natural_frequency", "Hz", type, inertia.natural_frequency, FF_MIN_OPEN, NULL,         \
            "inertia", 0, 1e9, 0, 0,                                                               \
            "linear natural frequency at the mean of the stiffness that is wired (tangent or "     \
            "secant), in place of the mass")

typedef struct dynamics_inputs {
    double line_force, mesh_frequency, natural_frequency; /* N, Hz, Hz */
    double reference; /* N, at which curves and shares of the mesh are taken */
    dynamics_fluctuation fluctuation;
    size_t span;           /* mesh cycles that the excitation repeats itself after; as one of its
                              cycles they have the phases 0 to 1 */
    double unit_frequency; /* Hz: mesh frequency at which that takes 2 pi rad of the natural one */
    size_t stations;
    const double *roll_angle, *tooth_force, *load_share; /* load_share may be NULL */
    dynamics_mesh_curves curves;
    const double *loaded_error; /* m, at the phases of the curves; NULL: not known */
    dynamics_force_levels levels;
    int shared; /* whether the motion follows these, and a pair's share the mesh force */
    double roll_sap, pitch; /* rad; pitch: roll angle of one mesh cycle */
    int back;               /* gear 2 drives: all this is of the pair with exchanged gears */
    uint64_t wanted;        /* outputs that are asked for; set by the model */
} dynamics_inputs;

/* Evaluates a model that knows driving flanks, where gear 2 drives (`back`) with the inputs of the
   pair with exchanged gears; `force`: the row of the tooth forces. */
typedef ff_status dynamics_evaluation(void *self, uint64_t wanted, const ff_array *in, int back);
ff_status dynamics_evaluate(const ff_host *host, const ff_port *ports, size_t count, size_t force,
                            const ff_array *in, dynamics_evaluation *evaluation, void *self,
                            uint64_t wanted);

/* Turns rows over the stations of exchanged gears, `total` values, into the order of gear 1. */
void dynamics_put_stations(double *x, size_t stations, size_t total, int back);

/* Checks and reads all inputs. `excitation` has its zeta and damping set, and is freed by
   dynamics_excitation_free. */
ff_status dynamics_inputs_read(const ff_host *host, const ff_array *in,
                               const dynamics_inertia *inertia, dynamics_inputs *inputs,
                               dynamics_excitation *excitation);

/* Whether nothing presses the flanks together: every place in the backlash is an equilibrium. */
int dynamics_floats(const dynamics_inputs *inputs, const dynamics_excitation *excitation);
void dynamics_floating_line(const ff_host *host);

/* FF_UNSUPPORTED where torque or speed fluctuate; `what` follows a mesh cycle that repeats itself.
 */
ff_status dynamics_refuse_fluctuation(const ff_host *host, const dynamics_inputs *inputs,
                                      const char *what);

/* A parameter that is a number or `auto`: -1, which becomes 0. */
static inline size_t dynamics_count_or_auto(int64_t value)
{
    return value < 0 ? 0 : (size_t)value;
}

/* Mesh cycles in one cycle of the excitation. */
static inline size_t dynamics_span(const dynamics_inputs *inputs)
{
    return inputs->span > 1 ? inputs->span : 1;
}

/* At least so many mesh cycles, in cycles of the excitation. */
static inline size_t dynamics_cycles(const dynamics_inputs *inputs, int64_t mesh_cycles)
{
    return ((size_t)mesh_cycles + dynamics_span(inputs) - 1) / dynamics_span(inputs);
}

/* Fills in the ends of an atlas that are not given (0), Hz, by the natural frequency. */
ff_status dynamics_atlas_bounds(const ff_host *host, double natural, double *from, double *to);

/* Says that an inertia of the user's stands in place of the gear's, and that without damping it is
   all one when the damper acts; `zeta` NaN: the model has no such choice. In ready. */
void dynamics_tell_servings(const ff_host *host, const dynamics_inertia *inertia, double zeta);

/* Says that the ends of the atlas serve these outputs alone. In ready. */
#define DYNAMICS_ATLAS_OUTPUTS                                                                     \
    "stable_motions|atlas_frequency|atlas_rms|atlas_stable|atlas_branch|atlas_floquet_max|"        \
    "fold_frequency|fold_branch|doubling_frequency|doubling_branch"
void dynamics_tell_atlas(const ff_host *host, const char *outputs);

/* The natural frequency of the linear system at the mean stiffness, sqrt(k/m)/(2 pi), Hz; 0: no
   mass is known. */
ff_status dynamics_natural_frequency(const ff_host *host, const dynamics_inertia *inertia,
                                     const ff_array *gear_mass, double stiffness,
                                     double *frequency);

#endif
