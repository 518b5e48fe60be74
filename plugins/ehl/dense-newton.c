/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The reference twin of ehl/finite-volume: the same equations by a dense Jacobian. */
#include "model.h"

static ff_status create(const ff_host *host, void **self)
{
    return ff_ehl_create(host, ff_dense_newton, self);
}

/* A dense matrix is factorised two or three times. */
static double step_cost(double cells)
{
    return 4e-9 * cells * cells * cells;
}

static ff_status assess(void *self, uint64_t wanted, double accuracy, const ff_array *in,
                        ff_assessment *a)
{
    return ff_ehl_assess(self, wanted, accuracy, in, step_cost, a);
}

static const ff_model model = {
    .size = sizeof model,
    .abi_major = FF_ABI_MAJOR,
    .abi_minor = 0,
    .id = "ehl/dense-newton",
    .version = "1.0.0",
    .summary = "reference twin of ehl/finite-volume: the same equations by a dense Jacobian and "
               "LAPACK; slow, meant for up to 300 cells or few steps",
    .reference = "Venner & Lubrecht 2000, Multilevel Methods in Lubrication (equations); Anderson "
                 "et al. 1999, LAPACK Users' Guide",
    .bibtex =
        "@book{venner2000, author={Venner, C. H. and Lubrecht, A. A.}, title={Multilevel Methods "
        "in Lubrication}, publisher={Elsevier}, year={2000}}\n"
        "@book{anderson1999, author={Anderson, E. and others}, title={{LAPACK} Users' Guide}, "
        "publisher={SIAM}, year={1999}}\n",
    .licence = "GPL-3.0-or-later",
    .params = ff_ehl_params,
    .param_count = FF_EHL_PARAMS,
    .param_stride = sizeof ff_ehl_params[0],
    .inputs = ff_ehl_inputs,
    .input_count = FF_EHL_INPUTS,
    .input_stride = sizeof ff_ehl_inputs[0],
    .outputs = ff_ehl_outputs,
    .output_count = FF_EHL_OUTPUTS,
    .output_stride = sizeof ff_ehl_outputs[0],
    .create = create,
    .set = ff_ehl_set,
    .wire = ff_ehl_wire,
    .evaluate = ff_ehl_evaluate,
    .destroy = ff_ehl_destroy,
    .assess = assess,
    .judge = ff_ehl_judge,
};

const ff_model *flankfilm_model_v1(void)
{
    return &model;
}
