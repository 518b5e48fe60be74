/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The models that solve for the pressure of the film: one stage (stage.h) with three solvers. */
#include "../contact/surface.h"
#include "../heat/across.h"
#include "references.h"
#include "stage.h"

#include <flankfilm/author.h>

static const ff_param params[] = {
    FF_COUNT("cells", ehl_model, cells, FF_TUNABLE, "512", NULL, 16, 65536, 0, 0,
             "cells of the uniform grid from inlet to outlet; with a second-order wedge the "
             "error of the film is proportional to 1/cells^2"),
    FF_QUANTITY_OR(
        "auto", "inlet", "1", ehl_model, inlet, FF_MIN_OPEN, "auto", NULL, 0, 1e6, 2, 1e6,
        "start of the domain in front of the contact, in largest Hertz half-widths of the "
        "history; auto: a + 10 sqrt(2 R h) of the largest loads, up to 57 where they are light, "
        "and further if the quality line starvation requires it; shorter if the cells would give "
        "the film an error above 2 %: the domain then begins with the pressure of a longer one"),
    FF_QUANTITY_OR("auto", "outlet", "1", ehl_model, outlet, FF_MIN_OPEN, "auto", NULL, 0, 1e6, 1.1,
                   1e6,
                   "end of the domain behind the contact, in largest Hertz half-widths; auto: a "
                   "+ 2 sqrt(2 R h) of every load; with rough flanks both ends are at least a + "
                   "sqrt(8 R Rq); if the entrainment reverses, both ends are at the larger of "
                   "the two distances"),
    FF_COUNT_OR("auto", "steps", ehl_model, steps, FF_TUNABLE, "auto", NULL, 1, 1e7, 0, 0,
                "number of equal time steps from the first to the last time of the contact; "
                "auto: as many as time_tolerance requires, with a step end at each kink of the "
                "history. A history of one time is solved as steady. With rough flanks a step is "
                "divided so that the oil moves at most a sixteenth of roughness_cutoff or one "
                "cell, and less where asperities touch"),
    FF_QUANTITY("time_tolerance", "1", ehl_model, time_tolerance, FF_TUNABLE, "7e-3", NULL, 1e-6, 1,
                0, 0,
                "with steps: auto: relative error of the film to which the time steps of one "
                "passage through the contact may add up"),
    FF_ONE_OF("euler|bdf2", "time_scheme", ehl_model, time_scheme, 0, "bdf2",
              "squeeze term: backward Euler (first order) or two-step backward differentiation "
              "(second order)"),
    FF_ONE_OF("first|second", "wedge", ehl_model, wedge, 0, "second",
              "order of the upwind wedge term"),
    FF_ONE_OF("clip|mass-conserving", "cavitation", ehl_model, cavitation, 0, "clip",
              "clip: p >= 0, and the film is full where p > 0 (Reynolds' condition); mass is not "
              "conserved where p = 0. mass-conserving: where p = 0 a fraction of the gap is "
              "filled, and this oil is transported until the film is full again"),
    FF_QUANTITY_OR(
        "auto", "tolerance", "1", ehl_model, tolerance, FF_TUNABLE, "auto", NULL, 1e-12, 1e-2, 0, 0,
        "the film is as accurate as if its equations were solved exactly, to about this; "
        "auto: to a twentieth of what its cells, and time_tolerance with steps: auto, "
        "make of it; 1e-4 with rough flanks, 1e-5 with other models than ehl/finite-volume"),
    FF_QUANTITY_OR("none", "light_load", "N/m", ehl_model, light_load, FF_MIN_OPEN, "none", NULL, 0,
                   1e9, 0, 0,
                   "least load per width: smaller loads are replaced by it; none: without load "
                   "the film continues without a load balance"),
    FF_ONE_OF("none|inlet|full", "thermal", ehl_model, thermal, 0, "none",
              "heat of shear in the film. none: the film has the temperature of the oil. inlet: "
              "thinner oil in the inlet, as if only conduction removed the heat. full: temperature "
              "across the film, with transport by the oil and conduction into flanks that warm up; "
              "smooth flanks only. inlet and full need an oil with its conductivity, full also its "
              "heat_capacity"),
    FF_COUNT("thermal_nodes", ehl_model, thermal_nodes, 0, "8", NULL, EHL_ACROSS_LEAST,
             EHL_ACROSS_MOST, 0, 0,
             "thermal: full: number of nodes across the film (Gauss-Legendre-Lobatto); the "
             "error, reported as node_error, decreases exponentially with it"),
    NUMERICS_HEAT_PARAMS("thermal: full", ehl_model),
    FF_QUANTITY_OR("auto", "bulk_temperature", "degC", ehl_model, bulk_temperature, 0, "auto", NULL,
                   -150, 1000, 0, 0,
                   "thermal: full: temperature of the flanks before they meet, and of the oil "
                   "that they carry in; auto: that of the oil, which is a lower bound"),
    EHL_HEATING_PARAMS(ehl_model),
    FF_QUANTITY("contact_film", "nm", ehl_model, contact_film, 0, "1 nm", NULL, 1e-3, 1e3, 0.5, 10,
                "rough flanks: smallest film; asperities carry the load that would press the "
                "flanks closer. The preset is two molecular layers of oil of 0.5 nm "
                "(Israelachvili 2011)"),
    FF_QUANTITY("boundary_friction", "1", ehl_model, boundary_friction, 0, EHL_BOUNDARY_FRICTION,
                NULL, 0, 2, 0.05, 0.2, "friction coefficient of the asperities in contact"),
    FF_QUANTITY_UNLESS(
        "gear.hardness", "asperity_hardness", "GPa", ehl_model, asperity_hardness, 0, "7 GPa", NULL,
        0, 1e3, 0, 0,
        "rough flanks: pressure of asperities and film at which the metal yields, if no gear "
        "gives its hardness (else that of the softer gear is used): 7 GPa is case-hardened steel "
        "(700 HV); 0: elastic at every pressure"),
    FF_QUANTITY_OR("auto", "roughness_cutoff", "um", ehl_model, roughness_cutoff, 0, "auto", NULL,
                   0, 1e4, 0, 0,
                   "rough flanks: cut-off wavelength of the Gaussian filter (ISO 16610-21) that "
                   "removes waves too short for the cells; a wave of this length keeps half its "
                   "amplitude; auto: 16 cells; 0: no filter"),
    FF_ONE_OF("sealed|ventilated", "valleys", ehl_model, valleys, 0, "sealed",
              "rough flanks: sealed: oil between asperities in contact can leave only through "
              "their gaps, as between ridges along the tooth; ventilated: it leaks sideways over "
              "valley_length"),
    FF_QUANTITY("valley_length", "mm", ehl_model, valley_length, FF_MIN_OPEN, "0.2 mm", NULL, 0,
                1e3, 0, 0,
                "valleys: ventilated: length of a valley along the tooth; both its ends are open"),
    FF_ONE_OF("resolved|ignored", "roughness", ehl_model, roughness, 0, "resolved",
              "heights of a wired surface: resolved as the flanks move, or ignored, which is "
              "justified if the film is many times the roughness"),
};

#define SOLVER_MODEL                                                                               \
    .size = sizeof(ff_model), .abi_major = FF_ABI_MAJOR, .abi_minor = 3,                           \
    .self_size = sizeof(ehl_model), .version = "1.0.0", .licence = "GPL-3.0-or-later",             \
    .params = FF_TABLE(params), .inputs = ehl_inputs, .input_stride = sizeof ehl_inputs[0],        \
    .outputs = FF_TABLE(ehl_outputs), .wire = ehl_wire, .ready = ehl_ready,                        \
    .evaluate = ehl_evaluate, .destroy = ehl_destroy

static const ff_model finite_volume;

static ff_status create_finite_volume(const ff_host *host, void **self)
{
    return ehl_create(host, &finite_volume, ehl_newton_krylov, self);
}

static const ff_model finite_volume = {
    SOLVER_MODEL,
    .id = "ehl/finite-volume",
    .summary = "transient elastohydrodynamic film of a line contact, smooth or rough and mixed: "
               "conservative finite "
               "volumes, Newton-GMRES, deflection by FFT",
    .reference =
        "Venner & Lubrecht 2000, Multilevel Methods in Lubrication (equations); Saad & Schultz "
        "1986, SIAM J. Sci. Stat. Comput. 7 (GMRES); Stanley & Kato 1997, J. Tribol. 119 "
        "(deflection by FFT)",
    .bibtex = BIB_venner2000 "\n" BIB_saad1986 "\n" BIB_stanley1997 "\n",
    .input_count = EHL_INPUTS,
    .create = create_finite_volume,
    .cost = 0.1,
};

static const ff_model dense_newton;

static ff_status create_dense_newton(const ff_host *host, void **self)
{
    return ehl_create(host, &dense_newton, ehl_dense_newton, self);
}

/* The slow reference implementation for ehl/finite-volume: the same equations with a dense
   Jacobian. */
static const ff_model dense_newton = {
    SOLVER_MODEL,
    .id = "ehl/dense-newton",
    .summary = "reference implementation for ehl/finite-volume: the same equations with a dense "
               "Jacobian and LAPACK; slow, meant for up to 300 cells or few steps",
    .reference = "Venner & Lubrecht 2000, Multilevel Methods in Lubrication (equations); Anderson "
                 "et al. 1999, LAPACK Users' Guide",
    .bibtex = BIB_venner2000 "\n" BIB_anderson1999 "\n",
    .input_count = EHL_IN_DISCRETISATION,
    .create = create_dense_newton,
};

static const ff_model control_volume;

static ff_status create_control_volume(const ff_host *host, void **self)
{
    return ehl_create(host, &control_volume, ehl_line_relaxation, self);
}

/*
 * Transient line-contact film following Li & Kahraman 2009 and 2011: asymmetric integrated control
 * volumes (reynolds.h), line relaxation in semi-system form (relaxation.c).
 * Only the title of the 2009 paper and its description in Li & Kahraman 2011 were available. The
 * method is of the same family, but not an exact reproduction. From the literature: asymmetric
 * integrated volumes, the flow factor of Ree and Eyring, one system of equations for all nodes with
 * the wedge in the matrix. Inferred: the position of the volumes, the second order, the rule for
 * the change in time. Not from these papers: the acceleration, the border for the load, the film
 * without contact.
 */
static const ff_model control_volume = {
    SOLVER_MODEL,
    .id = "ehl/control-volume",
    .summary = "transient elastohydrodynamic film of a smooth line contact, following Li & "
               "Kahraman: asymmetric control volumes, line relaxation in semi-system form; "
               "independent of ehl/finite-volume, and slower",
    .reference =
        "Li & Kahraman 2009, Tribology International 42 (asymmetric integrated control volumes; "
        "the form used here is inferred); Zhu & Hu 2001, Tribol. Trans. 44 (unified system, "
        "semi-system matrix); Walker & Ni 2011, SIAM J. Numer. Anal. 49 (acceleration)",
    .bibtex = BIB_li2009 "\n" BIB_zhu2001 "\n" BIB_walker2011 "\n",
    .input_count = EHL_IN_DISCRETISATION,
    .create = create_control_volume,
};

const ff_model *const *flankfilm_models_v1(void)
{
    static const ff_model *const models[] = {&finite_volume, &dense_newton, &control_volume, NULL};
    return models;
}
