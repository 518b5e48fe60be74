/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Plain laws, which the kinds of laws offer, to feed a model that asks for one. */
#include "private.h"

#include "../../engine/plugin/kind.h"
#include "../../engine/plugin/param.h"
#include "../../engine/value/memory.h"

#include <string.h>

/* The plain law of the first kind that may feed the row and has one of its interface. */
static const void *plain_law(fe_library *library, const ff_port *row)
{
    fe_report *report = fe_report_new();
    const void *law = NULL;
    char kind[64];
    for (size_t i = 0; !law && ff_word_at(row->from ? row->from : row->name, i, kind, sizeof kind);
         i++) {
        fe_kindred *its = fe_alloc(sizeof *its); /* until the process ends */
        if (fe_kind_open(its, library, kind, report) && its->asks->service &&
            !strcmp(its->asks->service, row->service))
            law = its->asks->plain;
    }
    fe_report_free(report);
    return law;
}

const void **verify_plain_laws(fe_library *library, const fe_loaded *loaded)
{
    const void **laws = fe_alloc((loaded->model->input_count + 1) * sizeof *laws);
    for (size_t i = 0; i < loaded->model->input_count; i++)
        if (ff_model_input(loaded->model, i)->service)
            laws[i] = plain_law(library, ff_model_input(loaded->model, i));
    return laws;
}
