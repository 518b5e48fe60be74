/* SPDX-License-Identifier: GPL-3.0-or-later */
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
#include "stage.h"

static ff_status create(const ff_host *host, void **self)
{
    return ehl_create(host, ehl_line_relaxation, self);
}

static const ff_model model = {
    .size = sizeof model,
    .abi_major = FF_ABI_MAJOR,
    .abi_minor = 0,
    .id = "ehl/control-volume",
    .version = "1.0.0",
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
    .licence = "GPL-3.0-or-later",
    .params = ehl_params,
    .param_count = EHL_PARAMS,
    .param_stride = sizeof ehl_params[0],
    .inputs = ehl_inputs,
    .input_count = EHL_INPUTS,
    .input_stride = sizeof ehl_inputs[0],
    .outputs = ehl_outputs,
    .output_count = EHL_OUTPUTS,
    .output_stride = sizeof ehl_outputs[0],
    .create = create,
    .set = ehl_set,
    .wire = ehl_wire,
    .evaluate = ehl_evaluate,
    .destroy = ehl_destroy,
    .judge = ehl_judge,
};

const ff_model *flankfilm_model_v1(void)
{
    return &model;
}
