/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Describes error against cost: a figure for each output, on logarithmic axes. The points of the
   front have numbers, which the table below names. */
#include "tradeoff.h"

#include <math.h>
#include <string.h>

enum { MOST_GROUPS = 8 };

/* Labels that begin with the same words up to a comma share a curve of points. */
typedef struct groups {
    const char *labels[MOST_GROUPS];
    json_t *curves[MOST_GROUPS];
    size_t count;
} groups;

static json_t *new_curve(const char *name, size_t length, size_t colour, const char *style)
{
    json_t *curve = json_pack("{s:s%, s:i, s:i, s:s, s:i}", "name", name, length, "colour",
                              (int)colour, "dash", (int)(colour / 6), "style", style, "size", 46);
    static const char *const lists[] = {"x", "y", "bar", "from", "to", "names", "tags"};
    for (size_t i = 0; i < sizeof lists / sizeof *lists; i++)
        json_object_set_new(curve, lists[i], json_array());
    return curve;
}

static json_t *curve_of(groups *g, const char *label)
{
    size_t length = strcspn(label, ","), i = 0;
    while (i < g->count &&
           (strncmp(g->labels[i], label, length) != 0 || strcspn(g->labels[i], ",") != length))
        i++;
    if (i == MOST_GROUPS)
        return g->curves[MOST_GROUPS - 1];
    if (i == g->count) {
        g->labels[g->count] = label;
        g->curves[g->count++] = new_curve(label, length, i, "dots");
    }
    return g->curves[i];
}

static void append(json_t *curve, const char *list, json_t *value)
{
    json_array_append_new(json_object_get(curve, list), value ? value : json_null());
}

/* Returns the place of a candidate in the front, from 1; 0 when it is not part of it. */
static size_t rank_in_front(const json_t *output, size_t candidate)
{
    size_t i;
    json_t *one;
    json_array_foreach(json_object_get(output, "front"), i, one)
    {
        if ((size_t)json_integer_value(json_object_get(one, "candidate")) == candidate)
            return i + 1;
    }
    return 0;
}

/* Errors are percentages; those of an output that is 0 in the reference are in SI. */
static double factor_of(const json_t *output)
{
    return json_is_true(json_object_get(output, "absolute")) ? 1 : 100;
}

/* Adds the point of a candidate. An error below the uncertainty of the reference is drawn at that
 * uncertainty. */
static void add_candidate(groups *g, const json_t *candidate, const json_t *error,
                          const json_t *output, size_t rank)
{
    const json_t *seconds = json_object_get(candidate, "seconds");
    const char *label = study_text_of(candidate, "label");
    double cost = study_number_of(seconds, "median"),
           known = study_number_of(output, "reference_error");
    const double factor = factor_of(output);
    double judged = fmax(study_number_of(error, "error"), known);
    char tag[24] = "";
    if (!(cost > 0 && judged > 0))
        return;
    if (rank > 0)
        snprintf(tag, sizeof tag, "%zu", rank);
    json_t *curve = curve_of(g, label);
    append(curve, "x", json_real(cost));
    append(curve, "y", json_real(factor * judged));
    append(curve, "bar", json_real(factor * known));
    append(curve, "from", json_real(study_number_of(seconds, "min")));
    append(curve, "to", json_real(study_number_of(seconds, "max")));
    append(curve, "names", json_string(label));
    append(curve, "tags", json_string(tag));
}

static json_t *front_of(const json_t *output)
{
    json_t *curve = json_pack("{s:s, s:s, s:i, s:s, s:[], s:[]}", "name", "front", "colour",
                              "var(--soft)", "dash", 2, "style", "line", "x", "y");
    size_t i;
    json_t *one;
    json_array_foreach(json_object_get(output, "front"), i, one)
    {
        append(curve, "x", json_real(study_number_of(one, "seconds")));
        append(curve, "y", json_real(factor_of(output) * study_number_of(one, "error")));
    }
    return curve;
}

json_t *study_tradeoff_figure(const json_t *result, const char *name, const json_t *output)
{
    groups g = {.count = 0};
    json_t *curves = json_array(), *one;
    size_t i;
    char label[160];
    json_array_foreach(json_object_get(result, "candidates"), i, one)
    {
        const json_t *error = json_object_get(json_object_get(one, "errors"), name);
        if (json_is_object(error))
            add_candidate(&g, one, error, output, rank_in_front(output, i));
    }
    for (i = 0; i < g.count; i++)
        json_array_append_new(curves, g.curves[i]);
    json_array_append_new(curves, front_of(output));
    const bool share = factor_of(output) > 1;
    snprintf(label, sizeof label, "error%s, known to %.2g%s", share ? " (%)" : " (SI)",
             factor_of(output) * study_number_of(output, "reference_error"), share ? " %" : "");
    return json_pack("{s:s, s:s+, s:i, s:i, s:{s:s, s:i}, s:{s:s, s:i}, s:[], s:o}", "sort",
                     "curves", "title", name, ": error against cost", "height", 340, "room", 1, "x",
                     "label", "cost (s on one core)", "log", 1, "y", "label", label, "log", 1,
                     "marks", "curves", curves);
}
