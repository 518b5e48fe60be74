/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What was fitted, as the members of a JSON object. */
#include "laws.h"

#include <jansson.h>
#include <math.h>
#include <string.h>

/* What is no UTF-8, which JSON wants, in ASCII. */
static json_t *json_text(const char *text)
{
    json_t *string = json_string(text);
    char plain[700];
    size_t length = 0;
    for (; !string && text[length] && length + 1 < sizeof plain; length++)
        plain[length] = (char)((unsigned char)text[length] < 0x80 ? text[length] : '?');
    return string ? string : json_stringn(plain, length);
}

static json_t *real(double value)
{
    return isfinite(value) ? json_real(value) : json_null();
}

static json_t *describe_param(const ff_comparison_request *r, const fitted *f, size_t param)
{
    static const char *const hows[] = {"preset", "held", "fitted", "at limit"};
    const ff_fit_value *value = &f->values[param];
    const ff_param *row = f->law->params[param]->row;
    char text[64];
    r->quantity(r->ctx, row, value->value, text, sizeof text);
    json_t *entry = json_pack("{s:s, s:o, s:o, s:s}", "name", row->name, "value",
                              real(value->value), "text", json_text(text), "how",
                              hows[value->how >= 0 && value->how <= 3 ? value->how : 0]);
    if (value->how == FF_FIT_FREE)
        json_object_set_new(entry, "interval",
                            json_pack("[o, o]", real(value->low), real(value->high)));
    return entry;
}

static json_t *describe_correlation(const fitted *f)
{
    json_t *all = json_object();
    size_t count = f->law->param_count;
    for (size_t i = 0; i < count; i++) {
        json_t *row = json_object();
        for (size_t k = 0; k < count; k++)
            if (!isnan(f->correlation[i * count + k]))
                json_object_set_new(row, f->law->params[k]->row->name,
                                    real(f->correlation[i * count + k]));
        if (json_object_size(row))
            json_object_set(all, f->law->params[i]->row->name, row);
        json_decref(row);
    }
    return all;
}

static json_t *describe_law(const ff_comparison_request *r, const fitted *f)
{
    json_t *params = json_array();
    if (!f->told || f->why) {
        json_decref(params);
        return json_pack("{s:s, s:o}", "law", f->law->id, "error",
                         f->why ? json_text(f->why) : json_null());
    }
    for (size_t i = 0; i < f->law->param_count; i++)
        if (!isnan(f->values[i].value))
            json_array_append_new(params, describe_param(r, f, i));
    json_t *entry =
        json_pack("{s:s, s:o, s:I, s:o, s:o, s:I, s:o, s:o, s:o}", "law", f->law->id, "parameters",
                  params, "found", (json_int_t)f->found.free_count, "rms", real(f->found.rms),
                  "largest", real(f->found.largest), "largest_line",
                  (json_int_t)r->lines[f->found.largest_row], "criterion", real(f->found.criterion),
                  "correlation", describe_correlation(f), "note", json_text(f->note));
    if (!isnan(f->found.asked))
        json_object_set_new(entry, "asked", real(f->found.asked));
    return entry;
}

char *fit_facts(const comparison *c, const ff_comparison_request *r)
{
    json_t *laws = json_array(), *range = json_object();
    for (size_t k = 0; k < r->fitter->column_count; k++) {
        double low, high;
        if (!r->fit->columns[k])
            continue;
        fit_range(r, k, &low, &high);
        json_object_set_new(range, fit_column(r, k)->name,
                            json_pack("[o, o]", real(low), real(high)));
    }
    for (size_t i = 0; i < c->count; i++)
        json_array_append_new(laws, describe_law(r, &c->laws[i]));
    json_t *facts =
        json_pack("{s:o, s:I, s:o, s:s, s:s, s:o}", "data", json_text(r->fit->source), "rows",
                  (json_int_t)r->fit->row_count, "range", range, "best", fit_best(c)->law->id,
                  "criterion", r->fitter->criterion, "laws", laws);
    char *text = json_dumps(facts, JSON_COMPACT | JSON_REAL_PRECISION(17));
    json_decref(facts);
    return text;
}
