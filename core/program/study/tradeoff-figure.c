/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Draws error against cost: a panel for each output, on logarithmic axes. */
#include "tradeoff.h"

#include <math.h>
#include <string.h>

enum {
    WIDTH = 430,
    HEIGHT = 320,
    LEFT = 62,
    RIGHT = 14,
    TOP = 30,
    BOTTOM = 46,
    MOST_GROUPS = 8,
    LINE = 14, /* px, of the list of names */
};

/* The colour-blind can tell these apart, too. */
static const char *const colours[MOST_GROUPS] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                                 "#56b4e9", "#e69f00", "#555555", "#000000"};

typedef struct panel {
    FILE *out;
    const json_t *result, *output;
    const char *name;
    double left;                     /* px */
    double cost[2], error[2];        /* decades at the ends of the axes */
    const char *groups[MOST_GROUPS]; /* labels that begin with the same words up to a comma share a
                                        colour */
    size_t group_count;
} panel;

static double x_of(const panel *p, double cost)
{
    double share = (log10(cost) - p->cost[0]) / (p->cost[1] - p->cost[0]);
    return p->left + LEFT + share * (WIDTH - LEFT - RIGHT);
}

static double y_of(const panel *p, double error)
{
    double share = (log10(error) - p->error[0]) / (p->error[1] - p->error[0]);
    return HEIGHT - BOTTOM - share * (HEIGHT - TOP - BOTTOM);
}

/* Finds cost and error of a candidate; false when a logarithmic axis cannot show them. */
static bool find_point(const panel *p, const json_t *candidate, double *cost, double *error)
{
    const json_t *errors = json_object_get(json_object_get(candidate, "errors"), p->name);
    *cost = study_number_of(json_object_get(candidate, "seconds"), "median");
    *error = fmax(study_number_of(errors, "judged"), study_number_of(p->output, "reference_error"));
    return json_is_object(errors) && *cost > 0 && *error > 0;
}

static size_t group_of(panel *p, const char *label)
{
    size_t length = strcspn(label, ","), i = 0;
    while (i < p->group_count &&
           (strncmp(p->groups[i], label, length) != 0 || strcspn(p->groups[i], ",") != length))
        i++;
    if (i == p->group_count && i < MOST_GROUPS)
        p->groups[p->group_count++] = label;
    return i < MOST_GROUPS ? i : MOST_GROUPS - 1;
}

static void find_ends(panel *p)
{
    size_t i;
    json_t *one;
    double cost, error, low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
    json_array_foreach(json_object_get(p->result, "candidates"), i, one)
    {
        if (!find_point(p, one, &cost, &error))
            continue;
        low[0] = fmin(low[0], log10(cost));
        high[0] = fmax(high[0], log10(cost));
        low[1] = fmin(low[1], log10(error));
        high[1] = fmax(high[1], log10(error));
    }
    if (!(low[0] <= high[0]))
        low[0] = low[1] = -1, high[0] = high[1] = 0;
    p->cost[0] = floor(low[0] - 0.05);
    p->cost[1] = ceil(high[0] + 0.05);
    p->error[0] = floor(low[1] - 0.05);
    p->error[1] = ceil(high[1] + 0.05);
}

static void draw_axes(const panel *p)
{
    double bottom = HEIGHT - BOTTOM, right = p->left + WIDTH - RIGHT;
    for (double d = p->cost[0]; d <= p->cost[1]; d++) {
        double x = x_of(p, pow(10, d));
        fprintf(p->out,
                "<path class=\"grid\" d=\"M%.1f %dV%.1f\"/><text x=\"%.1f\" y=\"%.1f\" "
                "text-anchor=\"middle\">%g</text>\n",
                x, TOP, bottom, x, bottom + 15, pow(10, d));
    }
    for (double d = p->error[0]; d <= p->error[1]; d++) {
        double y = y_of(p, pow(10, d));
        fprintf(p->out,
                "<path class=\"grid\" d=\"M%.1f %.1fH%.1f\"/><text x=\"%.1f\" y=\"%.1f\" "
                "text-anchor=\"end\">%g</text>\n",
                p->left + LEFT, y, right, p->left + LEFT - 5, y + 4, 100 * pow(10, d));
    }
    fprintf(p->out,
            "<text x=\"%.1f\" y=\"%d\" text-anchor=\"middle\">cost, s on one core</text>\n"
            "<text transform=\"translate(%.1f %.1f) rotate(-90)\" text-anchor=\"middle\">%s "
            "error, %%</text>\n<text class=\"head\" x=\"%.1f\" y=\"18\">",
            (p->left + LEFT + right) / 2, HEIGHT - 12, p->left + 14, (TOP + bottom) / 2,
            study_text_of(p->output, "judge"), p->left + LEFT);
    study_write_xml(p->out, p->name, SIZE_MAX);
    fputs("</text>\n", p->out);
}

static void draw_front(const panel *p)
{
    size_t i;
    json_t *one;
    fputs("<path class=\"front\" d=\"", p->out);
    json_array_foreach(json_object_get(p->output, "front"), i, one)
        fprintf(p->out, "%c%.1f %.1f", i ? 'L' : 'M', x_of(p, study_number_of(one, "seconds")),
                y_of(p, study_number_of(one, "error")));
    fputs("\"/>\n", p->out);
    json_array_foreach(json_object_get(p->output, "front"), i, one)
    {
        double x = x_of(p, study_number_of(one, "seconds")),
               y = y_of(p, study_number_of(one, "error"));
        if (json_is_true(json_object_get(one, "knee")))
            fprintf(p->out,
                    "<circle class=\"knee\" cx=\"%.1f\" cy=\"%.1f\" r=\"8\"/>"
                    "<text x=\"%.1f\" y=\"%.1f\">knee</text>\n",
                    x, y, x + 10, y - 8);
    }
}

/* Names the points of the front, by numbers beside them and a list below. */
static void draw_names(const panel *p)
{
    const json_t *candidates = json_object_get(p->result, "candidates");
    size_t i;
    json_t *one;
    json_array_foreach(json_object_get(p->output, "front"), i, one)
    {
        const json_t *at = json_array_get(
            candidates, (size_t)json_integer_value(json_object_get(one, "candidate")));
        double seconds = study_number_of(one, "seconds"), error = study_number_of(one, "error");
        fprintf(p->out, "<text x=\"%.1f\" y=\"%.1f\">%zu</text>\n<text x=\"%.1f\" y=\"%zu\">%zu  ",
                x_of(p, seconds) - 9, y_of(p, error) + 12, i + 1, p->left + 14, HEIGHT + LINE * i,
                i + 1);
        study_write_xml(p->out, study_text_of(at, "label"), SIZE_MAX);
        fprintf(p->out, ": %.2g s, %.2g %%</text>\n", seconds, 100 * error);
    }
}

/* Bars: the least and the greatest cost of the repeats, and what the reference is known to. */
static void draw_bars(const panel *p, const json_t *candidate, double cost, double error)
{
    const json_t *seconds = json_object_get(candidate, "seconds");
    double floor = study_number_of(p->output, "reference_error");
    double low = fmax(error - floor, pow(10, p->error[0]));
    fprintf(p->out, "<path class=\"bar\" d=\"M%.1f %.1fH%.1fM%.1f %.1fV%.1f\"/>",
            x_of(p, study_number_of(seconds, "min")), y_of(p, error),
            x_of(p, study_number_of(seconds, "max")), x_of(p, cost), y_of(p, low),
            y_of(p, error + floor));
}

static void draw_points(panel *p)
{
    size_t i;
    json_t *one;
    double cost, error;
    json_array_foreach(json_object_get(p->result, "candidates"), i, one)
    {
        const char *label = json_string_value(json_object_get(one, "label"));
        if (!label || !find_point(p, one, &cost, &error))
            continue;
        draw_bars(p, one, cost, error);
        fprintf(p->out, "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"3.5\" fill=\"%s\"><title>",
                x_of(p, cost), y_of(p, error), colours[group_of(p, label)]);
        study_write_xml(p->out, label, SIZE_MAX);
        fprintf(p->out, ": %.3g s, %.3g %%</title></circle>\n", cost, 100 * error);
    }
    for (i = 0; i < p->group_count; i++) {
        double y = TOP + 14 + 14.0 * (double)i, x = p->left + WIDTH - RIGHT - 8;
        fprintf(p->out,
                "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"3.5\" fill=\"%s\"/><text x=\"%.1f\" "
                "y=\"%.1f\" text-anchor=\"end\">",
                x, y - 4, colours[i], x - 7, y);
        study_write_xml(p->out, p->groups[i], strcspn(p->groups[i], ","));
        fputs("</text>\n", p->out);
    }
}

void study_tradeoff_draw(const json_t *result, FILE *out)
{
    const json_t *outputs = json_object_get(result, "outputs");
    size_t panels = json_object_size(outputs), i = 0, longest = 0, height;
    const char *name;
    json_t *output;
    json_object_foreach((json_t *)(size_t)outputs, name, output)
    {
        size_t points = json_array_size(json_object_get(output, "front"));
        longest = points > longest ? points : longest;
    }
    height = HEIGHT + LINE * longest;
    fprintf(out,
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %zu %zu\" width=\"%zu\" "
            "height=\"%zu\">\n<style>text{font:11px sans-serif;fill:#222}.head{font-weight:bold}"
            ".grid{stroke:#ddd}.front{stroke:#222;fill:none}.knee{stroke:#222;fill:none}"
            ".bar{stroke:#999}</style>\n"
            "<rect width=\"100%%\" height=\"100%%\" fill=\"#fff\"/>\n",
            panels * WIDTH, height, panels * WIDTH, height);
    json_object_foreach((json_t *)(size_t)outputs, name, output)
    {
        panel p = {.out = out, .result = result, .output = output, .name = name};
        p.left = (double)(WIDTH * i++);
        find_ends(&p);
        draw_axes(&p);
        draw_front(&p);
        draw_points(&p);
        draw_names(&p);
    }
    fputs("</svg>\n", out);
}
