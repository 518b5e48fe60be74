/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Fits each law to the same data, finds the best one and prints the answer as JSON. */
#include "search.h"

#include "../results/json.h"
#include "../study/store/journal.h"

#include <math.h>
#include <string.h>

const fit_law *fit_best(const fit *f)
{
    const fit_law *best = NULL;
    for (size_t i = 0; i < f->law_count; i++)
        if (!*f->laws[i].why && (!best || f->laws[i].criterion < best->criterion))
            best = &f->laws[i];
    return best;
}

/* Reports a law that could not be fitted: as an error if the user named the law, or if no law could
   be fitted; otherwise as a warning. */
static bool report_unfitted(const fit *f)
{
    bool none = !fit_best(f), same = none && f->law_count > 1, good = true;
    for (size_t i = 1; same && i < f->law_count; i++)
        same = !strcmp(f->laws[0].why, f->laws[i].why);
    if (same)
        return ff_error(f->report, FF_FAULT_INPUT, FF_NOWHERE, NULL,
                        "none of %zu laws can be fitted: %s", f->law_count, f->laws[0].why);
    for (size_t i = 0; i < f->law_count; i++) {
        const fit_law *law = &f->laws[i];
        if (*law->why && (none || f->named))
            good = ff_error(f->report, FF_FAULT_INPUT, FF_NOWHERE, NULL, "%s cannot be fitted: %s",
                            law->id, law->why);
        else if (*law->why)
            ff_warn(f->report, FF_NOWHERE, "%s is not fitted: %s", law->id, law->why);
    }
    return good;
}

bool fit_run(fit *f)
{
    for (size_t i = 0; i < f->law_count; i++)
        fit_regress(f, &f->laws[i]);
    return ff_report_errors(f->report) == 0 && report_unfitted(f);
}

static json_t *describe_param(const fit_param *param)
{
    static const char *const names[] = {"preset", "held", "fitted", "at limit"};
    char text[64];
    ff_quantity_print(param->value, param->unit, param->row->unit, text, sizeof text);
    json_t *entry =
        json_pack("{s:s, s:o, s:s, s:s}", "name", param->row->name, "value",
                  study_json_real(param->value), "text", text, "how", names[param->found]);
    if (param->found == FIT_FREE)
        json_object_set_new(
            entry, "interval",
            json_pack("[o, o]", study_json_real(param->low), study_json_real(param->high)));
    return entry;
}

static json_t *describe_correlation(const fit_law *law)
{
    json_t *all = json_object();
    size_t count = law->param_count;
    for (size_t i = 0; i < count; i++) {
        json_t *row = json_object();
        for (size_t k = 0; k < count; k++)
            if (!isnan(law->correlation[i * count + k]))
                json_object_set_new(row, law->params[k].row->name,
                                    study_json_real(law->correlation[i * count + k]));
        if (json_object_size(row))
            json_object_set(all, law->params[i].row->name, row);
        json_decref(row);
    }
    return all;
}

static json_t *describe_law(const fit *f, const fit_law *law)
{
    if (*law->why)
        return json_pack("{s:s, s:o}", "law", law->id, "error", results_json_text(law->why));
    json_t *params = json_array();
    for (size_t i = 0; i < law->param_count; i++)
        if (!isnan(law->params[i].value))
            json_array_append_new(params, describe_param(&law->params[i]));
    json_t *entry = json_pack("{s:s, s:o, s:I, s:o, s:o, s:I, s:o, s:o, s:o}", "law", law->id,
                              "parameters", params, "found", (json_int_t)law->free_count, "rms",
                              study_json_real(law->rms), "largest", study_json_real(law->largest),
                              "largest_line", (json_int_t)f->table->lines[law->largest_row],
                              "criterion", study_json_real(law->criterion), "correlation",
                              describe_correlation(law), "note", results_json_text(law->note));
    if (!isnan(law->asked))
        json_object_set_new(entry, "asked", study_json_real(law->asked));
    return entry;
}

json_t *fit_facts(const fit *f)
{
    json_t *laws = json_array(), *range = json_object();
    for (size_t k = 0; k < FIT_COLUMNS; k++) {
        double low, high;
        if (!f->table->columns[k])
            continue;
        fit_range(f, k, &low, &high);
        json_object_set_new(range, f->rows[k].name,
                            json_pack("[o, o]", study_json_real(low), study_json_real(high)));
    }
    for (size_t i = 0; i < f->law_count; i++)
        json_array_append_new(laws, describe_law(f, &f->laws[i]));
    return json_pack("{s:o, s:I, s:o, s:s, s:s, s:o}", "data", results_json_text(f->path), "rows",
                     (json_int_t)f->table->row_count, "range", range, "best", fit_best(f)->id,
                     "criterion", "AICc", "laws", laws);
}
