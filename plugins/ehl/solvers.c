/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The models of the film that solve for the pressure: one stage (stage.h) with three solvers. */
#include "stage.h"

#include <flankfilm/author.h>

#define SOLVER_MODEL                                                                               \
    .size = sizeof(ff_model), .abi_major = FF_ABI_MAJOR, .abi_minor = 2, .version = "1.0.0",       \
    .licence = "GPL-3.0-or-later", .params = FF_TABLE(ehl_params), .inputs = ehl_inputs,           \
    .input_stride = sizeof ehl_inputs[0], .outputs = FF_TABLE(ehl_outputs), .set = ehl_set,        \
    .wire = ehl_wire, .evaluate = ehl_evaluate, .judge = ehl_judge, .destroy = ehl_destroy

static ff_status create_finite_volume(const ff_host *host, void **self)
{
    return ehl_create(host, ehl_newton_krylov, self);
}

/* Newton-GMRES with FFTs: as good as proportional, s. */
static double cost_of_finite_volume(double cells)
{
    return 4e-7 * cells;
}

static ff_status assess_finite_volume(void *self, uint64_t wanted, double accuracy,
                                      const ff_array *in, ff_assessment *a)
{
    return ehl_assess(self, wanted, accuracy, in, cost_of_finite_volume, a);
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
    .bibtex =
        "@book{venner2000, author={Venner, C. H. and Lubrecht, A. A.}, title={Multilevel Methods "
        "in Lubrication}, publisher={Elsevier}, year={2000}}\n"
        "@article{saad1986, author={Saad, Y. and Schultz, M. H.}, title={{GMRES}: A generalized "
        "minimal residual algorithm for solving nonsymmetric linear systems}, journal={SIAM J. "
        "Sci. Stat. Comput.}, volume={7}, pages={856--869}, year={1986}}\n"
        "@article{stanley1997, author={Stanley, H. M. and Kato, T.}, title={An {FFT}-based method "
        "for rough surface contact}, journal={J. Tribol.}, volume={119}, pages={481--485}, "
        "year={1997}}\n",
    .input_count = EHL_INPUTS,
    .create = create_finite_volume,
    .assess = assess_finite_volume,
};

static ff_status create_dense_newton(const ff_host *host, void **self)
{
    return ehl_create(host, ehl_dense_newton, self);
}

/* A dense matrix is factorised two or three times, s. */
static double cost_of_dense_newton(double cells)
{
    return 4e-9 * cells * cells * cells;
}

static ff_status assess_dense_newton(void *self, uint64_t wanted, double accuracy,
                                     const ff_array *in, ff_assessment *a)
{
    return ehl_assess(self, wanted, accuracy, in, cost_of_dense_newton, a);
}

/* The reference twin of ehl/finite-volume: the same equations by a dense Jacobian. */
static const ff_model dense_newton = {
    SOLVER_MODEL,
    .id = "ehl/dense-newton",
    .summary = "reference twin of ehl/finite-volume: the same equations by a dense Jacobian and "
               "LAPACK; slow, meant for up to 300 cells or few steps",
    .reference = "Venner & Lubrecht 2000, Multilevel Methods in Lubrication (equations); Anderson "
                 "et al. 1999, LAPACK Users' Guide",
    .bibtex =
        "@book{venner2000, author={Venner, C. H. and Lubrecht, A. A.}, title={Multilevel Methods "
        "in Lubrication}, publisher={Elsevier}, year={2000}}\n"
        "@book{anderson1999, author={Anderson, E. and others}, title={{LAPACK} Users' Guide}, "
        "publisher={SIAM}, year={1999}}\n",
    .input_count = EHL_IN_DISCRETISATION,
    .create = create_dense_newton,
    .assess = assess_dense_newton,
};

static ff_status create_control_volume(const ff_host *host, void **self)
{
    return ehl_create(host, ehl_line_relaxation, self);
}

/*
 * Transient line-contact film in the manner of Li & Kahraman 2009 and 2011: asymmetric integrated
 * control volumes (reynolds.h), line relaxation in semi-system form (relaxation.c).
 *
 * Their text is not at hand but for its title and what Li & Kahraman 2011 say of it: the family is
 * followed, the scheme is not reproduced digit for digit. From the literature: volumes that are
 * integrated and asymmetric, the flow factor of Ree and Eyring, one system of equations for all
 * nodes with the wedge in the matrix. Inferred: where the volumes lie, the second order, the rule
 * for the change in time. Not theirs: the acceleration, the border for the load, the film in
 * flight.
 */
static const ff_model control_volume = {
    SOLVER_MODEL,
    .id = "ehl/control-volume",
    .summary = "transient elastohydrodynamic film of a smooth line contact, in the manner of Li & "
               "Kahraman: asymmetric control volumes, line relaxation in semi-system form; "
               "independent of ehl/finite-volume, and slower",
    .reference =
        "Li & Kahraman 2009, Tribology International 42 (asymmetric integrated control volumes; "
        "the form used here is inferred); Zhu & Hu 2001, Tribol. Trans. 44 (unified system, "
        "semi-system matrix); Walker & Ni 2011, SIAM J. Numer. Anal. 49 (acceleration)",
    .bibtex =
        "@article{li2009, author={Li, S. and Kahraman, A.}, title={A mixed {EHL} model with "
        "asymmetric integrated control volume discretization}, journal={Tribology "
        "International}, volume={42}, year={2009}}\n"
        "@article{zhu2001, author={Zhu, D. and Hu, Y. Z.}, title={A computer program package for "
        "the prediction of {EHL} and mixed lubrication characteristics, friction, subsurface "
        "stresses and flash temperatures based on measured 3-{D} surface roughness}, "
        "journal={Tribol. Trans.}, volume={44}, pages={383--390}, year={2001}}\n"
        "@article{walker2011, author={Walker, H. F. and Ni, P.}, title={Anderson acceleration for "
        "fixed-point iterations}, journal={SIAM J. Numer. Anal.}, volume={49}, pages={1715--1735}, "
        "year={2011}}\n",
    .input_count = EHL_IN_DISCRETISATION,
    .create = create_control_volume,
};

const ff_model *const *flankfilm_models_v1(void)
{
    static const ff_model *const models[] = {&finite_volume, &dense_newton, &control_volume, NULL};
    return models;
}
