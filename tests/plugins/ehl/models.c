/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "models.h"

#include <math.h>
#include <string.h>

const film_model film_models[FILM_MODELS] = {
    {"ehl/film-formula", "film-formula", 0, 64, 100, 0.10, 0.16},
    {"ehl/inlet-analysis", "inlet-analysis", 0, 64, 200, 0.10, 0.10},
    {"ehl/finite-volume", "finite-volume", 1, 256, 100, 0, 0},
    {"ehl/control-volume", "control-volume", 1, 256, 100, 0, 0},
    {"ehl/dense-newton", "dense-newton", 1, 96, 60, 0, 0},
};

void model_open(const film_model *m, line *c)
{
    line_open(c, m->id);
    stage_set(c->film, "cells", (double)m->cells);
}

static const char shared[] = "time h_min h_central p_max friction_coefficient traction power_loss "
                             "sliding_loss rolling_loss squeeze_loss asperity_loss "
                             "h_min_error x film pressure h_min_lowest p_max_highest";
static const char solved[] =
    "time h_min h_central p_max friction_coefficient traction power_loss "
    "sliding_loss rolling_loss squeeze_loss asperity_loss "
    "h_min_error x film pressure h_min_lowest p_max_highest load_error load_ahead "
    "mass_error one_way_gap_error film_fraction newton_steps "
    "convolutions steps_cut";

const char *model_outputs(const film_model *m)
{
    return m->solves ? solved : shared;
}

int model_is_finite(const film_model *m, const line *c)
{
    char names[sizeof solved];
    strcpy(names, model_outputs(m));
    for (char *name = strtok(names, " "); name; name = strtok(NULL, " ")) {
        size_t n;
        const double *y = stage_get(c->film, name, &n);
        int may_be_unknown = strcmp(name, "h_min_error") == 0;
        int length = name[0] == 'h' || strcmp(name, "film") == 0;
        for (size_t i = 0; i < n; i++)
            if (!(isfinite(y[i]) || (may_be_unknown && y[i] > 0)) || (length && y[i] < 0))
                return 0;
    }
    return 1;
}
