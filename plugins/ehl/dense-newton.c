/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The reference twin of ehl/finite-volume: the same equations by a dense Jacobian. */
#include "stage.h"

static ff_status create(const ff_host *host, void **self)
{
    return ehl_create(host, ehl_dense_newton, self);
}

/* A dense matrix is factorised two or three times. */
static double step_cost(double cells)
{
    return 4e-9 * cells * cells * cells;
}

static ff_status assess(void *self, uint64_t wanted, double accuracy, const ff_array *in,
                        ff_assessment *a)
{
    return ehl_assess(self, wanted, accuracy, in, step_cost, a);
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
    .assess = assess,
    .judge = ehl_judge,
};

const ff_model *flankfilm_model_v1(void)
{
    return &model;
}
