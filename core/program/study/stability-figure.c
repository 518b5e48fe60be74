/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Draws a map. Cells have colours that the colour-blind tell apart (Okabe & Ito 2008), and a letter
   and a hatching for print without colour. Slices stand side by side. */
#include "stability.h"

#include <math.h>
#include <string.h>

enum { SIDE = 26, LEFT = 92, TOP = 40, GAP = 24, BELOW = 64, LINE = 16 };

/* The colours are light enough for a black letter. */
static const char *const colours[STUDY_CLASSES] = {"#009e73", "#56b4e9", "#cc79a7", "#f0f0f0",
                                                   "#f0e442", "#ffffff", "#d55e00", "#999999"};
/* The angle of the hatching in degrees; below 0 there is none. */
static const int hatching[STUDY_CLASSES] = {-1, -1, 90, -1, 45, 0, 135, 0};

static void put_text(FILE *out, const char *text)
{
    study_write_xml(out, text, SIZE_MAX);
}

/* Writes "1.77827941004 m/s" with four digits and without its unit. */
static void put_value(FILE *out, const char *text)
{
    double number;
    const char *end;
    if (study_read_number(text, &number, &end))
        fprintf(out, "%.4g", number);
    else
        put_text(out, text);
}

static const char *unit_of(const char *text)
{
    double number;
    const char *end;
    return study_read_number(text, &number, &end) ? end + strspn(end, " ") : "";
}

static void put_axis_name(FILE *out, const study_map *map, size_t axis)
{
    const char *unit = unit_of(study_map_value(map, axis, 0));
    put_text(out, map->grid->varied[axis].path);
    if (*unit) {
        fputs(", ", out);
        put_text(out, unit);
    }
}

static void put_patterns(FILE *out)
{
    fputs("<defs>\n", out);
    for (size_t k = 0; k < STUDY_CLASSES; k++)
        if (hatching[k] >= 0)
            fprintf(out,
                    "<pattern id=\"h%zu\" width=\"6\" height=\"6\" patternUnits=\"userSpaceOnUse\" "
                    "patternTransform=\"rotate(%d)\"><rect width=\"6\" height=\"6\" fill=\"%s\"/>"
                    "<path d=\"M0 0V6\" stroke=\"#000\" stroke-opacity=\"0.35\"/></pattern>\n",
                    k, hatching[k], colours[k]);
    fputs("</defs>\n", out);
}

static void put_box(FILE *out, double x, double y, enum study_class class)
{
    char fill[32];
    snprintf(fill, sizeof fill, hatching[class] < 0 ? "%s" : "url(#h%s)",
             hatching[class] < 0 ? colours[class] : (char[]){(char)('0' + class), '\0'});
    fprintf(out,
            "<rect x=\"%g\" y=\"%g\" width=\"%d\" height=\"%d\" fill=\"%s\" stroke=\"#fff\"/>"
            "<text x=\"%g\" y=\"%g\" text-anchor=\"middle\">",
            x, y, SIDE, SIDE, fill, x + SIDE / 2.0, y + SIDE / 2.0 + 4);
    put_text(out, (char[]){study_class_letters[class], '\0'});
    fputs("</text>", out);
}

/* Marks a corner of a cell that has a note. */
static void put_mark(FILE *out, double x, double y, const char *note)
{
    fprintf(out, "<path d=\"M%g %gh-8l8 8z\"><title>", x + SIDE - 1, y + 1);
    put_text(out, note);
    fputs("</title></path>", out);
}

/* Returns where a cell between two points lies, in steps of the axis from its first point. */
static double position(const study_map *map, size_t axis, const study_cell *cell)
{
    size_t points = map->grid->points[axis];
    double first, last, at = cell->at[axis];
    const char *end;
    study_read_number(study_map_value(map, axis, 0), &first, &end);
    study_read_number(study_map_value(map, axis, points - 1), &last, &end);
    double share =
        map->log[axis] ? log10(at / first) / log10(last / first) : (at - first) / (last - first);
    return share * (double)(points - 1);
}

static double width_of(const study_map *map)
{
    return (double)study_map_columns(map) * SIDE + GAP;
}

/* Draws a thick line between two cells, at the place that the halvings found. */
static void put_boundary(FILE *out, const study_map *map, const study_boundary *b)
{
    double place = (position(map, b->axis, &map->cells[b->low]) +
                    position(map, b->axis, &map->cells[b->high])) /
                   2;
    double left = LEFT + (double)b->slice * width_of(map);
    double rows = (double)study_map_rows(map);
    if (b->axis > 1)
        return;
    if (b->axis == 0)
        fprintf(out, "<path d=\"M%.1f %.1fv%d\"/>\n", left + (place + 0.5) * SIDE,
                TOP + (rows - 1 - (double)b->row) * SIDE, SIDE);
    else
        fprintf(out, "<path d=\"M%.1f %.1fh%d\"/>\n", left + (double)b->column * SIDE,
                TOP + (rows - 0.5 - place) * SIDE, SIDE);
}

static void put_slice(FILE *out, const study_map *map, size_t slice)
{
    size_t columns = study_map_columns(map), rows = study_map_rows(map);
    double left = LEFT + (double)slice * width_of(map), bottom = TOP + (double)rows * SIDE;
    fprintf(out, "<text x=\"%g\" y=\"%d\">", left, TOP - 8);
    for (size_t a = 2; a < map->axis_count; a++) {
        if (a > 2)
            fputs(", ", out);
        put_text(out, map->cells[study_map_cell(map, slice, 0, 0)].settings[a].name);
    }
    fputs("</text>\n", out);
    for (size_t c = 0; c < columns; c++) {
        for (size_t row = 0; row < rows; row++) {
            const study_cell *cell = &map->cells[study_map_cell(map, slice, c, row)];
            double x = left + (double)c * SIDE, y = bottom - (double)(row + 1) * SIDE;
            put_box(out, x, y, cell->class);
            if (cell->note)
                put_mark(out, x, y, cell->note);
        }
        fputc('\n', out);
    }
    for (size_t c = 0; c<columns; c += columns> 1 ? columns - 1 : 1) {
        fprintf(out, "<text x=\"%g\" y=\"%g\" text-anchor=\"middle\">",
                left + ((double)c + 0.5) * SIDE, bottom + LINE);
        put_value(out, study_map_value(map, 0, c));
        fputs("</text>\n", out);
    }
    fprintf(out, "<text x=\"%g\" y=\"%g\">", left, bottom + 2 * LINE);
    put_axis_name(out, map, 0);
    fputs("</text>\n", out);
}

static void put_rows(FILE *out, const study_map *map)
{
    if (map->axis_count < 2)
        return;
    size_t rows = study_map_rows(map);
    for (size_t row = 0; row < rows; row++) {
        fprintf(out, "<text x=\"%d\" y=\"%g\" text-anchor=\"end\">", LEFT - 6,
                TOP + ((double)(rows - 1 - row) + 0.5) * SIDE + 4);
        put_value(out, study_map_value(map, 1, row));
        fputs("</text>\n", out);
    }
    fprintf(out, "<text x=\"4\" y=\"%d\">", TOP - 24);
    put_axis_name(out, map, 1);
    fputs("</text>\n", out);
}

static void put_note_legend(FILE *out, const study_map *map, double y)
{
    put_mark(out, 4, y, study_note_text);
    fprintf(out, "<text x=\"%d\" y=\"%g\">", SIDE + 14, y + SIDE / 2.0 + 4);
    for (size_t n = 0; n < map->note_count; n++) {
        fputs(n ? ", or " : "with a note: ", out);
        put_text(out, map->notes[n].words);
    }
    fputs("</text>\n", out);
}

void study_map_svg(const study_map *map, FILE *out)
{
    double bottom = TOP + (double)study_map_rows(map) * SIDE + BELOW;
    double width = fmax(LEFT + (double)study_map_slices(map) * width_of(map), 480);
    size_t shown = map->noted[0] > 0;
    for (size_t k = 0; k < STUDY_CLASSES; k++)
        shown += map->counts[k] + map->more[k] > 0;
    fprintf(out,
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%g\" height=\"%g\" "
            "font-family=\"sans-serif\" font-size=\"12\">\n"
            "<rect width=\"100%%\" height=\"100%%\" fill=\"#fff\"/>\n",
            width, bottom + (double)shown * (SIDE + 4));
    put_patterns(out);
    put_rows(out, map);
    for (size_t i = 0; i < study_map_slices(map); i++)
        put_slice(out, map, i);
    fputs("<g stroke=\"#000\" stroke-width=\"3\">\n", out);
    for (size_t i = 0; i < map->boundary_count; i++)
        put_boundary(out, map, &map->boundaries[i]);
    fputs("</g>\n", out);
    double y = bottom;
    for (size_t k = 0; k < STUDY_CLASSES; k++) {
        if (map->counts[k] + map->more[k] == 0)
            continue;
        put_box(out, 4, y, (enum study_class)k);
        fprintf(out, "<text x=\"%d\" y=\"%g\">%s: %s</text>\n", SIDE + 14, y + SIDE / 2.0 + 4,
                study_class_names[k], study_class_texts[k]);
        y += SIDE + 4;
    }
    if (map->noted[0] > 0)
        put_note_legend(out, map, y);
    fputs("</svg>\n", out);
}
