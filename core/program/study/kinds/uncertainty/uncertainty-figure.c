/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Describes what an uncertainty study found: a histogram of each output with its percentiles, the
   three error bars, and the share of each input. */
#include "uncertainty.h"

#include <math.h>
#include <string.h>

static json_t *percentile_marks(const json_t *of, study_readable unit)
{
    json_t *marks = json_array(), *one;
    size_t i;
    json_array_foreach(json_object_get(of, "percentiles"), i, one)
    {
        char name[24];
        double value = study_number_of(one, "value");
        snprintf(name, sizeof name, "%.3g %%", 100 * study_number_of(one, "share"));
        if (isfinite(value))
            json_array_append_new(marks,
                                  json_pack("[f, s]", value * unit.factor + unit.offset, name));
    }
    return marks;
}

static json_t *bars_of(const json_t *histogram, study_readable unit)
{
    json_t *from = json_array(), *to = json_array(), *x = json_array(), *y = json_array();
    const json_t *shares = json_object_get(histogram, "shares");
    double low = study_number_of(histogram, "from") * unit.factor + unit.offset;
    double high = study_number_of(histogram, "to") * unit.factor + unit.offset;
    double width = (high - low) / (double)json_array_size(shares);
    for (size_t i = 0; isfinite(width) && i < json_array_size(shares); i++) {
        json_array_append_new(from, json_real(low + width * (double)i));
        json_array_append_new(to, json_real(low + width * (double)(i + 1)));
        json_array_append_new(x, json_real(low + width * ((double)i + 0.5)));
        json_array_append_new(y, json_real(100 * json_number_value(json_array_get(shares, i))));
    }
    return json_pack("{s:s, s:i, s:i, s:s, s:o, s:o, s:o, s:o}", "name", "", "colour", 0, "dash", 0,
                     "style", "bars", "x", x, "y", y, "from", from, "to", to);
}

static json_t *histogram_figure(const char *name, const json_t *of)
{
    const char *dot = strrchr(name, '.');
    study_readable unit = study_uncertainty_unit(name, of);
    char label[160];
    snprintf(label, sizeof label, *unit.unit ? "%.100s (%.30s)" : "%.100s", dot ? dot + 1 : name,
             unit.unit);
    return json_pack("{s:s, s:s+, s:i, s:{s:s}, s:{s:s, s:i}, s:o, s:[o]}", "sort", "curves",
                     "title", name, ": what the inputs make of it", "height", 280, "x", "label",
                     label, "y", "label", "samples (%)", "low", 0, "marks",
                     percentile_marks(of, unit), "curves",
                     bars_of(json_object_get(of, "histogram"), unit));
}

/* Points with bars, one for each name. */
typedef struct points {
    json_t *x, *y, *bar, *names;
} points;

static void add_point(points *p, double shift, const json_t *e)
{
    double value = study_number_of(e, "value"), low = study_number_of(e, "low"),
           high = study_number_of(e, "high");
    json_array_append_new(p->x, json_real((double)json_array_size(p->x) + shift));
    json_array_append_new(p->y, study_json_real(100 * value));
    json_array_append_new(p->bar, json_real(isfinite(high - low) ? 50 * (high - low) : 0));
}

static json_t *curve_of(const points *p, const char *name, int colour)
{
    json_t *tags = json_array();
    for (size_t i = 0; i < json_array_size(p->x); i++)
        json_array_append_new(tags, json_string(""));
    return json_pack("{s:s, s:i, s:i, s:s, s:i, s:o, s:o, s:o, s:o}", "name", name, "colour",
                     colour, "dash", 0, "style", "dots", "size", 60, "x", p->x, "y", p->y, "bar",
                     p->bar, "tags", tags);
}

static json_t *shares_figure(const char *name, const json_t *of, const char *by)
{
    points first = {json_array(), json_array(), json_array(), json_array()};
    points total = {json_array(), json_array(), json_array(), NULL};
    json_t *one;
    const char *input, *why = NULL;
    size_t untold = 0;
    json_object_foreach(json_object_get(of, "shares"), input, one)
    {
        const char *said = json_string_value(json_object_get(one, "untold"));
        why = said ? said : why;
        untold += said != NULL;
        add_point(&first, -0.08, json_object_get(one, "first"));
        add_point(&total, 0.08, json_object_get(one, "total"));
        json_array_append_new(first.names, json_string(input));
    }
    char title[300];
    int end = snprintf(title, sizeof title, "%.80s: share of its variance, by %.80s", name, by);
    if (why)
        snprintf(title + end, sizeof title - (size_t)end, "; %.40s %zu of %zu alone", why, untold,
                 json_array_size(first.names));
    json_t *figure =
        json_pack("{s:s, s:s, s:i, s:{s:s, s:f, s:f}, s:{s:s}, s:[], s:O, s:[o, o]}", "sort",
                  "curves", "title", title, "height", 260, "x", "label", "", "low", -0.5, "high",
                  (double)json_array_size(first.names) - 0.5, "y", "label",
                  "share of the variance (%)", "marks", "names", first.names, "curves",
                  curve_of(&first, "alone", 0), curve_of(&total, "with others", 1));
    json_decref(first.names);
    return figure;
}

/* The three error bars of all outputs. */
static json_t *limits_figure(const json_t *outputs)
{
    static const char *const kinds[] = {"numerical", "model", "input"};
    json_t *curves = json_array(), *names = json_array(), *of;
    const char *name;
    for (int k = 0; k < 3; k++) {
        points p = {json_array(), json_array(), json_array(), NULL};
        json_object_foreach((json_t *)(size_t)outputs, name, of)
        {
            json_t *value = json_pack("{s:O?}", "value",
                                      json_object_get(json_object_get(of, "limits"), kinds[k]));
            add_point(&p, 0.12 * (k - 1), value);
            json_decref(value);
            if (k == 0)
                json_array_append_new(names, json_string(name));
        }
        json_array_append_new(curves, curve_of(&p, kinds[k], k));
    }
    double high = (double)json_array_size(names) - 0.5;
    return json_pack("{s:s, s:s, s:i, s:{s:s, s:f, s:f}, s:{s:s, s:i}, s:[], s:o, s:o}", "sort",
                     "curves", "title", "What limits each output", "height", 260, "x", "label", "",
                     "low", -0.5, "high", high, "y", "label", "of the value (%)", "log", 1, "marks",
                     "names", names, "curves", curves);
}

void study_uncertainty_draw_limits(study_answer *answer, const json_t *outputs)
{
    study_answer_draw(answer, limits_figure(outputs));
}

json_t *study_uncertainty_draw(study_answer *answer, const char *name, const json_t *of)
{
    const json_t *result = answer->value;
    json_t *figure = study_answer_draw(answer, histogram_figure(name, of));
    if (json_object_size(json_object_get(of, "shares")))
        study_answer_draw(answer, shares_figure(name, of, study_text_of(result, "shares_by")));
    return figure;
}
