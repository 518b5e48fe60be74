/* SPDX-License-Identifier: GPL-3.0-or-later */
/* An audit as a figure: a row for each output, the errors apart on a logarithmic axis. */
#include "audit.h"

enum { WIDTH = 760, LEFT = 210, RIGHT = 20, TOP = 44, ROW = 26, BOTTOM = 40, KINDS = 4 };

/* Below a millionth of a per cent all is the same. */
static const double least = 1e-8;

/* Told apart by people who are blind to colours, too. */
static const struct kind {
    const char *key, *name, *colour;
} kinds[KINDS] = {
    {"promised", "promised", "#222222"},
    {"numerical", "numerical", "#0072b2"},
    {"model_form", "model form", "#d55e00"},
    {"inputs", "inputs", "#009e73"},
};

static double error_of(const json_t *output, size_t kind)
{
    const json_t *part = json_object_get(output, kinds[kind].key);
    return kind == 0           ? study_number_of(output, "promised")
           : kind == KINDS - 1 ? study_number_of(part, "uncertainty")
                               : study_number_of(part, "mean");
}

static double decade_of(double error)
{
    return log10(fmin(fmax(error, least), 1));
}

static double x_of(double error, double low)
{
    return LEFT + (decade_of(error) - low) / (0 - low) * (WIDTH - LEFT - RIGHT);
}

/* The marks of one output, of all cases in a row. */
static void draw_row(FILE *out, const json_t *cases, const char *name, double y, double low)
{
    json_t *one, *output;
    size_t i, k;
    fprintf(out,
            "<path class=\"grid\" d=\"M%d %.1fH%d\"/><text x=\"%d\" y=\"%.1f\" "
            "text-anchor=\"end\">%s</text>\n",
            LEFT, y, WIDTH - RIGHT, LEFT - 8, y + 4, name); /* names are plain words */
    json_array_foreach(cases, i, one) json_array_foreach(
        json_object_get(one, "outputs"), k, output) for (size_t kind = 0; kind < KINDS; kind++)
    {
        double error = error_of(output, kind), x = x_of(error, low);
        if (!isfinite(error) || strcmp(json_string_value(json_object_get(output, "output")), name))
            continue;
        if (kind == 0)
            fprintf(out, "<path stroke=\"%s\" stroke-width=\"2\" d=\"M%.1f %.1fv14\"/>\n",
                    kinds[kind].colour, x, y - 7);
        else
            fprintf(out,
                    "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"4\" fill=\"%s\" fill-opacity=\"0.7\">"
                    "<title>case %lld, %s %.2g %%</title></circle>\n",
                    x, y + 3.0 * ((double)kind - 2), kinds[kind].colour,
                    (long long)json_integer_value(json_object_get(one, "case")), kinds[kind].name,
                    100 * error);
    }
}

static void draw_frame(FILE *out, double height, double low)
{
    fprintf(out,
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %d %.0f\" width=\"%d\" "
            "height=\"%.0f\">\n<style>text{font:11px sans-serif;fill:#222}.grid{stroke:#ddd}"
            "</style>\n<rect width=\"100%%\" height=\"100%%\" fill=\"#fff\"/>\n",
            WIDTH, height, WIDTH, height);
    for (double d = low; d <= 0; d++)
        fprintf(out,
                "<path class=\"grid\" d=\"M%.1f %dV%.1f\"/><text x=\"%.1f\" y=\"%.1f\" "
                "text-anchor=\"middle\">%g</text>\n",
                x_of(pow(10, d), low), TOP - 10, height - BOTTOM, x_of(pow(10, d), low),
                height - BOTTOM + 15, 100 * pow(10, d));
    fprintf(out, "<text x=\"%d\" y=\"%.1f\" text-anchor=\"middle\">relative error, %%</text>\n",
            (LEFT + WIDTH - RIGHT) / 2, height - 8);
    for (size_t kind = 0; kind < KINDS; kind++)
        fprintf(out,
                "<circle cx=\"%zu\" cy=\"16\" r=\"4\" fill=\"%s\"/><text x=\"%zu\" y=\"20\">%s"
                "</text>\n",
                LEFT + 6 + 110 * kind, kinds[kind].colour, LEFT + 15 + 110 * kind,
                kinds[kind].name);
}

void study_audit_draw(const json_t *result, FILE *out)
{
    const json_t *cases = json_object_get(result, "cases");
    json_t *names = json_object(), *one, *output;
    const char *name;
    size_t i, k;
    double low = -2, y = TOP + ROW / 2.0;
    json_array_foreach(cases, i, one) json_array_foreach(json_object_get(one, "outputs"), k, output)
    {
        json_object_set_new(names, json_string_value(json_object_get(output, "output")),
                            json_null());
        for (size_t kind = 0; kind < KINDS; kind++)
            if (error_of(output, kind) > 0)
                low = fmin(low, floor(decade_of(error_of(output, kind))));
    }
    draw_frame(out, TOP + ROW * (double)json_object_size(names) + BOTTOM, low);
    json_object_foreach(names, name, one)
    {
        draw_row(out, cases, name, y, low);
        y += ROW;
    }
    fputs("</svg>\n", out);
    json_decref(names);
}
