/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "output-text.h"

#include "../accuracy/axis.h"
#include "../accuracy/lines.h"
#include "../results/extremes.h"
#include "../study/kinds/answer/number.h"

#include <math.h>
#include <string.h>

static const double noise =
    1e-9; /* numbers below this share of the greatest are noise; at most 5 digits are printed */

static study_readable unit_of(const ff_port *row, double most)
{
    return study_readable_output(row->name, row->unit, most);
}

/* Prints the range from a to b. A number that is only noise relative to the greatest one of the
 * result is printed as 0. */
static void print_range(const ff_result *result, double a, double b, char *out, size_t size)
{
    const double most = fmax(fabs(a), fabs(b)), least = fmin(fabs(a), fabs(b));
    const study_readable unit = unit_of(result->row, most);
    /* a number much smaller than the other is easier to read in its own unit */
    const study_readable first =
        least >= noise * most && least < 1e-3 * most ? unit_of(result->row, fabs(a)) : unit;
    const char *between = strcmp(first.unit, unit.unit) ? " " : "";
    char low[STUDY_NUMBER_SIZE], high[STUDY_NUMBER_SIZE];
    const bool constant = b - a <= noise * most;
    a = fabs(a) < noise * most ? first.offset : a * first.factor + first.offset;
    b = fabs(b) < noise * most ? unit.offset : b * unit.factor + unit.offset;
    study_number_text(a, 4, " ", low);
    study_number_text(b, constant ? 5 : 4, " ", high);
    snprintf(out, size, "%s%s%s%s%s%s%s", constant ? "" : low, constant ? "" : between,
             constant || !*between ? "" : first.unit, constant ? "" : " to ", high,
             *unit.unit ? " " : "", unit.unit);
}

/* Prints where the extremes of a series lie; if `briefly`, "at 22.3 and 16.6 deg". "" if no series
 * gives the place. */
static void print_where(const ff_pipeline *pipeline, const ff_stage *stage, size_t output,
                        size_t least, size_t greatest, bool briefly, char *out, size_t size)
{
    const ff_result *result = &stage->results[output];
    const char *dim = result->dims[0];
    const ff_result *axis = accuracy_axis(pipeline, stage, dim, result->count, result, NULL);
    if (!axis) {
        if (!briefly)
            snprintf(out, size, "min at %s %zu, max at %zu of %zu", dim, least + 1, greatest + 1,
                     result->count);
        return;
    }
    double a = axis->data[least], b = axis->data[greatest];
    study_readable unit = study_readable_unit(axis->row->unit, fmax(fabs(a), fabs(b)));
    const char *gap = *unit.unit ? " " : "";
    if (briefly)
        snprintf(out, size, "at %.3g and %.3g%s%s", a * unit.factor, b * unit.factor, gap,
                 unit.unit);
    else
        snprintf(out, size, "min at %.4g, max at %.4g%s%s (%s)", a * unit.factor, b * unit.factor,
                 gap, unit.unit, axis->row->name);
}

static void print_shape(const ff_stage *stage, size_t output, char *out, size_t size)
{
    const ff_result *result = &stage->results[output];
    size_t at = 0;
    for (uint32_t i = 0; i < result->rank && at < size; i++)
        at += (size_t)snprintf(out + at, size - at, "%s%zu %s", i ? " by " : "", result->shape[i],
                               result->dims[i]);
}

/* Prints the values of both gears, which are not a series, as "[0.35, -0.1]". */
static bool print_pair(const ff_result *result, char *out, size_t size)
{
    if (result->rank != 1 || result->count != 2)
        return false;
    double a = result->data[0], b = result->data[1];
    study_readable unit = unit_of(result->row, fmax(fabs(a), fabs(b)));
    char one[STUDY_NUMBER_SIZE], other[STUDY_NUMBER_SIZE];
    study_number_text(a * unit.factor + unit.offset, 5, " ", one);
    study_number_text(b * unit.factor + unit.offset, 5, " ", other);
    snprintf(out, size, "[%s, %s]%s%s", one, other, *unit.unit ? " " : "", unit.unit);
    return true;
}

/* Appends the measured relative error; for a series, the largest. */
static void print_error(const accuracy_record *errors, const ff_result *result, char *out,
                        size_t size)
{
    const accuracy_error *error = accuracy_find(errors, result);
    size_t length = strlen(out);
    if (error && error->relative == 0) /* no setting changes the value */
        return;
    if (error && error->bar)
        snprintf(out + length, size - length, " +- %.2g %%", 100 * error->relative);
    else if (error)
        snprintf(out + length, size - length, " +- ?");
}

/* False if the result is the error estimate of an output whose error is not known. */
static bool known_error(const ff_stage *stage, const ff_result *result)
{
    for (size_t i = 0; i < stage->loaded->model->output_count; i++) {
        const ff_result *of = &stage->results[i];
        if (accuracy_may_estimate(result->row, of->row) && accuracy_is_unknown(stage, of))
            return false;
    }
    return true;
}

cli_output_text cli_output_text_of(const accuracy_record *errors, const ff_pipeline *pipeline,
                                   const ff_stage *stage, size_t output, bool briefly)
{
    const ff_result *result = &stage->results[output];
    cli_output_text text = {.value = "(none)"};
    results_extremes found = {.partial = false};
    bool pair = print_pair(result, text.value, sizeof text.value);
    if (result->count > 0 && !pair) {
        const bool known = results_find_extremes(pipeline, stage, result, &found);
        size_t at = accuracy_is_least(stage, result) ? strlen(strcpy(text.value, ">= ")) : 0;
        if (known)
            print_range(result, result->data[found.least], result->data[found.greatest],
                        text.value + at, sizeof text.value - at);
        else
            strcpy(text.value, "not known");
    }
    bool from_end_to_end = found.least == 0 && found.greatest + 1 == result->count;
    if (result->rank > 1)
        print_shape(stage, output, text.place, sizeof text.place);
    else if (result->rank == 1 && !pair && strstr(text.value, " to ") && !from_end_to_end)
        print_where(pipeline, stage, output, found.least, found.greatest, briefly, text.place,
                    sizeof text.place);
    if (!known_error(stage, result))
        strcpy(text.value, "not known");
    print_error(errors, result, text.value, sizeof text.value);
    return text;
}
