/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Describes the residuals of all laws over pressure as a figure for the report page. */
#include "fit.h"

#include <math.h>

json_t *fit_figure(const fit *f)
{
    json_t *curves = json_array();
    for (size_t k = 0; k < f->law_count; k++) {
        if (*f->laws[k].why)
            continue;
        json_t *x = json_array(), *y = json_array();
        for (size_t i = 0; i < f->data.n; i++) {
            json_array_append_new(x, json_real(1e-9 * f->data.p[i]));
            json_array_append_new(y, json_real(100 * expm1(f->laws[k].residual[i])));
        }
        json_array_append_new(curves,
                              json_pack("{s:s, s:i, s:i, s:s, s:o, s:o}", "name", f->laws[k].id,
                                        "colour", (int)json_array_size(curves), "dash", 0, "style",
                                        "dots", "x", x, "y", y));
    }
    return json_pack("[{s:s, s:s, s:i, s:i, s:{s:s}, s:{s:s}, s:[], s:o}]", "sort", "curves",
                     "title", "Residuals of the laws", "height", 360, "room", 1, "x", "label",
                     "pressure (GPa)", "y", "label", "data over law - 1 (%)", "marks", "curves",
                     curves);
}
