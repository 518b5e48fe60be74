/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "multipliers.h"

#include <gsl/gsl_eigen.h>
#include <gsl/gsl_errno.h>

#include <math.h>
#include <string.h>

double dynamics_films_multipliers(const double m[4][4], double multipliers[8])
{
    gsl_set_error_handler_off(); /* GSL's default handler would end the process */
    gsl_eigen_nonsymm_workspace *work = gsl_eigen_nonsymm_alloc(4);
    gsl_vector_complex *value = gsl_vector_complex_alloc(4);
    double copy[16], size[4];
    memcpy(copy, m, sizeof copy);
    gsl_matrix_view view = gsl_matrix_view_array(copy, 4, 4);
    int good = work && value && gsl_eigen_nonsymm(&view.matrix, value, work) == GSL_SUCCESS;
    for (size_t i = 0; i < 4; i++) {
        gsl_complex z = {{NAN, 0}};
        if (good)
            z = gsl_vector_complex_get(value, i);
        double modulus = hypot(GSL_REAL(z), GSL_IMAG(z));
        size_t k = i;
        for (; k > 0 && size[k - 1] < modulus; k--) {
            size[k] = size[k - 1];
            memcpy(&multipliers[2 * k], &multipliers[2 * k - 2], 2 * sizeof *multipliers);
        }
        size[k] = modulus;
        multipliers[2 * k] = GSL_REAL(z);
        multipliers[2 * k + 1] = GSL_IMAG(z);
    }
    gsl_vector_complex_free(value);
    gsl_eigen_nonsymm_free(work);
    return size[0];
}
