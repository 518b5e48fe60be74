/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Transient line-contact film by Newton-Krylov: see reynolds.h for the equations, newton-krylov.c
   for their solution, time-stepper.h for time. */
#include "stage.h"

static ff_status create(const ff_host *host, void **self)
{
    return ehl_create(host, ehl_newton_krylov, self);
}

/* Newton-GMRES with FFTs: as good as proportional. */
static double step_cost(double cells)
{
    return 4e-7 * cells;
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
    .id = "ehl/finite-volume",
    .version = "1.0.0",
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
