/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a fitter found: for people, and as JSON. */
#include "fit.h"
#include "json.h"
#include "text.h"

#include <math.h>
#include <string.h>

enum { NAME = 28, PARAM = 18, VALUE = 20 };

static void print_data(const ff_fitting *f)
{
    const ff_columns *c = &f->columns;
    printf("%s: %zu rows", c->source.name, c->rows);
    for (size_t k = 0; k < c->count; k++) {
        char first[64], last[64];
        double low, high;
        if (!c->values[k])
            continue;
        ff_fit_range(f, k, &low, &high);
        ff_quantity_print(low, &c->units[k], c->asked[k]->unit, first, sizeof first);
        ff_quantity_print(high, &c->units[k], c->asked[k]->unit, last, sizeof last);
        printf(", %s %s", c->asked[k]->name, first);
        if (strcmp(first, last) != 0)
            printf(" to %s", last);
    }
    printf("\n\n");
}

static bool was_asked(const ff_fitting *f)
{
    for (size_t i = 0; i < f->law_count; i++)
        if (!f->laws[i].why && !isnan(f->laws[i].found.asked))
            return true;
    return false;
}

static void print_table(const ff_fitting *f)
{
    const ff_fitted_law *best = ff_fit_best(f);
    const ff_columns *c = &f->columns;
    const ff_param *quantity = c->asked[f->fitter->quantity];
    bool asked = was_asked(f);
    printf("%-*s %5s %9s %22s %9s%s\n", NAME, "law", "found", "rms", "largest",
           f->fitter->criterion, asked ? "  at that point" : "");
    for (size_t i = 0; i < f->law_count; i++) {
        const ff_fitted_law *law = &f->laws[i];
        char largest[64], value[64];
        if (law->why)
            continue;
        ff_place place = ff_columns_place(c, law->found.largest_row, f->fitter->quantity);
        snprintf(largest, sizeof largest, "%+.3g %% in line %u", 100 * law->found.largest,
                 place.line);
        printf("%-*s %5zu %7.3g %% %22s %+9.1f", NAME, law->id, law->found.free_count,
               100 * law->found.rms, largest, law->found.criterion - best->found.criterion);
        ff_quantity_print(law->found.asked, &c->units[f->fitter->quantity], quantity->unit, value,
                          sizeof value);
        if (asked)
            printf("  %s", value);
        putchar('\n');
    }
}

static void print_value(const ff_fitted_law *law, size_t param)
{
    const ff_fit_value *value = &law->values[param];
    const ff_loaded *loaded = ff_candidate_model(law->candidate);
    const ff_param *row = law->params[param].row;
    const ff_unit *unit = &loaded->param_units[param];
    char text[64], low[64], high[64];
    if (isnan(value->value) || value->how == FF_FIT_UNSAID)
        return;
    ff_quantity_print(value->value, unit, row->unit, text, sizeof text);
    printf("  %-*s %-*s", PARAM, row->name, VALUE, text);
    if (value->how == FF_FIT_AT_LIMIT) {
        printf(" at its limit");
    } else if (value->how == FF_FIT_HELD) {
        printf(" held");
    } else {
        ff_quantity_print(value->low, unit, row->unit, low, sizeof low);
        ff_quantity_print(value->high, unit, row->unit, high, sizeof high);
        printf(" %s to %s", low, high);
    }
    putchar('\n');
}

/* The notes of a law, each on lines of its own. */
static void print_notes(const char *note)
{
    while (*note) {
        char line[600];
        size_t length = strcspn(note, "\n");
        snprintf(line, sizeof line, "%.*s", (int)length, note);
        printf("  ");
        ff_print_wrapped(line, 2, 4);
        note += length + (note[length] == '\n');
    }
}

void ff_fit_print(const ff_fitting *f)
{
    print_data(f);
    print_table(f);
    printf("\n95 %% confidence:\n");
    for (size_t i = 0; i < f->law_count; i++) {
        const ff_fitted_law *law = &f->laws[i];
        if (law->why)
            continue;
        printf("\n%s\n", law->id);
        for (size_t k = 0; k < law->view.param_count; k++)
            print_value(law, k);
        print_notes(law->note);
    }
}

static json_t *json_param(const ff_fitted_law *law, size_t param)
{
    static const char *const hows[] = {"preset", "held", "fitted", "at limit"};
    const ff_fit_value *value = &law->values[param];
    const ff_loaded *loaded = ff_candidate_model(law->candidate);
    const ff_param *row = law->params[param].row;
    char text[64];
    ff_quantity_print(value->value, &loaded->param_units[param], row->unit, text, sizeof text);
    json_t *entry =
        json_pack("{s:s, s:o, s:s, s:s}", "name", row->name, "value", ff_json_real(value->value),
                  "text", text, "how", hows[value->how >= 0 && value->how <= 3 ? value->how : 0]);
    if (value->how == FF_FIT_FREE)
        json_object_set_new(
            entry, "interval",
            json_pack("[o, o]", ff_json_real(value->low), ff_json_real(value->high)));
    return entry;
}

static json_t *json_correlation(const ff_fitted_law *law)
{
    json_t *all = json_object();
    size_t count = law->view.param_count;
    for (size_t i = 0; i < count; i++) {
        json_t *row = json_object();
        for (size_t k = 0; k < count; k++)
            if (!isnan(law->correlation[i * count + k]))
                json_object_set_new(row, law->params[k].row->name,
                                    ff_json_real(law->correlation[i * count + k]));
        if (json_object_size(row))
            json_object_set(all, law->params[i].row->name, row);
        json_decref(row);
    }
    return all;
}

static json_t *json_law(const ff_fitting *f, const ff_fitted_law *law)
{
    json_t *entry = json_pack("{s:s}", "law", law->id), *params = json_array();
    if (law->why) {
        json_object_set_new(entry, "error", ff_json_text(law->why));
        json_decref(params);
        return entry;
    }
    for (size_t i = 0; i < law->view.param_count; i++)
        if (!isnan(law->values[i].value))
            json_array_append_new(params, json_param(law, i));
    ff_place place = ff_columns_place(&f->columns, law->found.largest_row, f->fitter->quantity);
    json_object_set_new(entry, "parameters", params);
    json_object_set_new(entry, "found", json_integer((json_int_t)law->found.free_count));
    json_object_set_new(entry, "rms", ff_json_real(law->found.rms));
    json_object_set_new(entry, "largest", ff_json_real(law->found.largest));
    json_object_set_new(entry, "largest_line", json_integer(place.line));
    json_object_set_new(entry, "criterion", ff_json_real(law->found.criterion));
    json_object_set_new(entry, "correlation", json_correlation(law));
    json_object_set_new(entry, "note", ff_json_text(law->note));
    if (!isnan(law->found.asked))
        json_object_set_new(entry, "asked", ff_json_real(law->found.asked));
    return entry;
}

json_t *ff_fit_json(const ff_fitting *f)
{
    const ff_columns *c = &f->columns;
    json_t *answer = ff_json_answer("ok", FF_EXIT_OK, f->report);
    json_t *laws = json_array(), *range = json_object();
    for (size_t k = 0; k < c->count; k++) {
        double low, high;
        if (!c->values[k])
            continue;
        ff_fit_range(f, k, &low, &high);
        json_object_set_new(range, c->asked[k]->name,
                            json_pack("[o, o]", ff_json_real(low), ff_json_real(high)));
    }
    for (size_t i = 0; i < f->law_count; i++)
        json_array_append_new(laws, json_law(f, &f->laws[i]));
    json_object_set_new(answer, "data", ff_json_text(c->source.name));
    json_object_set_new(answer, "rows", json_integer((json_int_t)c->rows));
    json_object_set_new(answer, "range", range);
    json_object_set_new(answer, "best", ff_json_text(ff_fit_best(f)->id));
    json_object_set_new(answer, "criterion", ff_json_text(f->fitter->criterion));
    json_object_set_new(answer, "laws", laws);
    return answer;
}
