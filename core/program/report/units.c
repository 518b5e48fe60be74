/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Units and words that engineers use. */
#include <flankfilm/engine.h>

#include "../results/label.h"
#include "page.h"

#include "../memory/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { ROOM = 44 }; /* largest length of a figure's title */

study_readable report_unit_for(const char *name, const char *si_unit, double magnitude)
{
    static const char *const greek[][2] = {
        {"um", "µm"},       {"us", "µs"},       {"N/um", "N/µm"}, {"mm2/s", "mm²/s"},
        {"kg m2", "kg m²"}, {"kg/m3", "kg/m³"}, {"1/m2", "1/m²"}};
    study_readable unit = study_readable_output(name, si_unit, fabs(magnitude));
    for (size_t i = 0; i < sizeof greek / sizeof *greek; i++)
        if (!strcmp(unit.unit, greek[i][0]))
            unit.unit = greek[i][1];
    return unit;
}

double report_convert(const study_readable *unit, double si)
{
    return si * unit->factor + unit->offset;
}

void report_number_text(double value, char out[REPORT_TEXT_SIZE])
{
    if (isfinite(value))
        study_number_text(value, 4, "\u202f", out);
    else
        strcpy(out, "–");
}

void report_bar_text(const char *si_unit, double bar, char out[REPORT_TEXT_SIZE])
{
    const study_readable unit = report_unit_for("", si_unit, bar);
    study_quantity_text(bar, &unit, 2, "\u202f", out);
}

void report_quantity_text(const char *name, const char *si_unit, double si,
                          char out[REPORT_TEXT_SIZE])
{
    const study_readable unit = report_unit_for(name, si_unit, si);
    if (isfinite(si))
        study_quantity_text(si, &unit, 4, "\u202f", out);
    else
        strcpy(out, "\u2013");
}

const char *report_plain_name(const char *path, char out[REPORT_TEXT_SIZE])
{
    const char *dot = strrchr(path, '.');
    snprintf(out, REPORT_TEXT_SIZE, "%s", dot ? dot + 1 : path);
    for (char *at = out; *at; at++)
        if (*at == '_')
            *at = ' ';
    return out;
}

const char *report_output_words(const results_view_variable *of, char out[REPORT_TEXT_SIZE])
{
    char label[RESULTS_LABEL_SIZE];
    if (!*of->doc)
        return report_plain_name(of->output, out);
    results_label(of->doc, ROOM, label);
    snprintf(out, REPORT_TEXT_SIZE, "%.*s", REPORT_TEXT_SIZE - 1, label);
    return out;
}

const char *report_axis_word(const results_view_axis *axis, size_t point,
                             char out[REPORT_TEXT_SIZE])
{
    enum { LONG = 14 };
    double number;
    const char *word = axis->words[point], *end;
    if (strlen(word) < LONG)
        return word;
    if (axis->values)
        report_quantity_text(axis->path, axis->unit, axis->values[point], out);
    else if (ff_number_parse(word, &number, &end) && (*end == ' ' || !*end))
        snprintf(out, REPORT_TEXT_SIZE, "%.4g%.40s", number, end);
    else
        return word;
    return out;
}

void report_label(const char *words, const study_readable *unit, char out[REPORT_TEXT_SIZE])
{
    snprintf(out, REPORT_TEXT_SIZE, *unit->unit ? "%s (%s)" : "%s", words, unit->unit);
}

double report_axis_number(const results_view_axis *axis, size_t point)
{
    double number;
    const char *end;
    if (axis->values)
        return axis->values[point];
    return ff_number_parse(axis->words[point], &number, &end) ? number : (double)NAN;
}

const char *report_axis_unit(const results_view_axis *axis)
{
    double number;
    const char *end;
    if (axis->values)
        return axis->unit;
    return ff_number_parse(axis->words[0], &number, &end) ? end + strspn(end, " ") : "";
}

const char *report_name_value(const results_view *view, const results_view_axis *axis,
                              const char *value, char out[REPORT_TEXT_SIZE])
{
    double number;
    const char *end;
    size_t varied = 0;
    char words[REPORT_TEXT_SIZE];
    for (size_t k = 0; k < view->axis_count; k++)
        varied += view->lengths[view->axes[k]->dimension] > 1;
    const bool named = varied > 1 && ff_number_parse(value, &number, &end);
    snprintf(out, REPORT_TEXT_SIZE, "%.60s%s%.80s",
             named ? report_plain_name(axis->path, words) : "", named ? " " : "", value);
    return out;
}

void report_name_point(const results_view *view, size_t index, const bool *dims, bool named,
                       char out[REPORT_TEXT_SIZE])
{
    size_t length = 0;
    char word[REPORT_TEXT_SIZE], name[REPORT_TEXT_SIZE];
    out[0] = '\0';
    for (size_t k = 0; k < view->axis_count && length < REPORT_TEXT_SIZE; k++) {
        const results_view_axis *axis = view->axes[k];
        size_t d = axis->dimension;
        const char *value = report_axis_word(axis, results_view_point(view, index, d), word);
        if (dims[d] && view->lengths[d] > 1 && *value)
            length += (size_t)snprintf(out + length, REPORT_TEXT_SIZE - length, "%s%s",
                                       length ? ", " : "",
                                       named ? report_name_value(view, axis, value, name) : value);
    }
}

void report_name_case(const results_view *view, size_t index, char out[REPORT_TEXT_SIZE])
{
    bool *dims = memory_alloc((view->dimension_count + 1) * sizeof *dims);
    for (size_t d = 0; d < view->dimension_count; d++)
        dims[d] = true;
    report_name_point(view, index, dims, true, out);
    free(dims);
}

size_t report_case_of(const results_view *view, const bool *dims, size_t k)
{
    size_t index = 0, stride = 1;
    for (size_t d = view->dimension_count; d-- > 0; stride *= view->lengths[d]) {
        if (!dims[d])
            continue;
        index += k % view->lengths[d] * stride;
        k /= view->lengths[d];
    }
    return index;
}
