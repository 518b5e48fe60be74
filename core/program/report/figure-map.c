/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Draws values over two axes in the colours of viridis, which the colour-blind can read and which
   print in grey. */
#include "page.h"

#include <math.h>

enum { LEFT = 78, RIGHT = 120, TOP = 10, BELOW = 46, PLOT = 280, STOPS = 9 };

/* Rows and columns of a map; on a page that has grown to 2 MB, fewer. */
enum { MOST = 64, MOST_THEN = 24, LONG_PAGE = 2000000 };

static void colour_of(double share, int rgb[3])
{
    static const int stops[STOPS][3] = {{68, 1, 84},    {71, 44, 122},  {59, 81, 139},
                                        {44, 113, 142}, {33, 144, 141}, {39, 173, 129},
                                        {92, 200, 99},  {170, 220, 50}, {253, 231, 37}};
    double at = fmin(fmax(share, 0), 1) * (STOPS - 1);
    int low = at >= STOPS - 1 ? STOPS - 2 : (int)at;
    for (int i = 0; i < 3; i++)
        rgb[i] = (int)lround(stops[low][i] + (at - low) * (stops[low + 1][i] - stops[low][i]));
}

/* Over more than two decades the colour follows the logarithm. */
static bool is_wide(double low, double high)
{
    return low > 0 && high > 100 * low;
}

static double share_of(double value, double low, double high)
{
    if (is_wide(low, high))
        return log(value / low) / log(high / low);
    return high > low ? (value - low) / (high - low) : 0.5;
}

static void write_scale(FILE *out, double low, double high, const char *label)
{
    double x = REPORT_FIGURE_WIDTH - RIGHT + 16;
    char text[REPORT_TEXT_SIZE];
    for (int i = 0; i < 32; i++) {
        int rgb[3];
        colour_of((i + 0.5) / 32, rgb);
        fprintf(out,
                "<rect x=\"%.1f\" y=\"%.2f\" width=\"14\" height=\"%.2f\" "
                "fill=\"rgb(%d,%d,%d)\"/>",
                x, TOP + PLOT * (31 - i) / 32.0, PLOT / 32.0 + 0.3, rgb[0], rgb[1], rgb[2]);
    }
    for (int i = 0; i <= 4; i++) {
        report_number_text(
            is_wide(low, high) ? low * pow(high / low, i / 4.0) : low + (high - low) * i / 4, text);
        fprintf(out, "<text class=\"tick\" x=\"%.1f\" y=\"%.1f\">%s</text>", x + 19,
                TOP + PLOT * (4 - i) / 4.0 +
                    (i == 4 ? 10
                     : i    ? 4
                            : 0),
                text);
    }
    report_side_label(out, label, REPORT_FIGURE_WIDTH - 8, TOP + PLOT / 2);
}

static void write_ticks(FILE *out, const report_map *map, double cell_x, double cell_y)
{
    char text[REPORT_TEXT_SIZE];
    size_t every = map->columns / 9 + 1;
    for (size_t i = 0; i < map->columns; i += every) {
        report_number_text(map->x[i], text);
        fprintf(out, "<text class=\"tick\" text-anchor=\"middle\" x=\"%.1f\" y=\"%d\">%s</text>",
                LEFT + cell_x * ((double)i + 0.5), TOP + PLOT + 16, text);
    }
    every = map->rows / 12 + 1;
    for (size_t i = 0; i < map->rows; i += every) {
        report_number_text(map->y[i], text);
        fprintf(out, "<text class=\"tick\" text-anchor=\"end\" x=\"%d\" y=\"%.1f\">%s</text>",
                LEFT - 6, TOP + PLOT - cell_y * ((double)i + 0.5) + 4, text);
    }
    fprintf(out, "<text class=\"axis\" text-anchor=\"middle\" x=\"%d\" y=\"%d\">",
            (LEFT + REPORT_FIGURE_WIDTH - RIGHT) / 2, TOP + PLOT + 36);
    report_put_text(out, map->x_label);
    fputs("</text>\n", out);
    report_side_label(out, map->y_label, 14, TOP + PLOT / 2);
}

void report_map_write(report_page *page, const report_map *map)
{
    FILE *out = page->out;
    const double low = map->low, high = map->high;
    size_t most = ftell(out) > LONG_PAGE ? MOST_THEN : MOST;
    size_t step_x = map->columns / most + 1, step_y = map->rows / most + 1;
    double cell_x = (double)(REPORT_FIGURE_WIDTH - RIGHT - LEFT) / (double)map->columns;
    double cell_y = (double)PLOT / (double)map->rows;
    if (!(low <= high))
        return;
    page->thinned = page->thinned || step_x > 1 || step_y > 1;
    report_figure_begin(page, map->title, NULL, TOP + PLOT + BELOW);
    fprintf(out, "<rect class=\"none\" x=\"%d\" y=\"%d\" width=\"%d\" height=\"%d\"/>\n", LEFT, TOP,
            REPORT_FIGURE_WIDTH - RIGHT - LEFT, PLOT);
    for (size_t r = 0; r < map->rows; r += step_y)
        for (size_t c = 0; c < map->columns; c += step_x) {
            double value = map->values[r * map->columns + c];
            int rgb[3];
            if (!isfinite(value))
                continue;
            colour_of(share_of(value, low, high), rgb);
            fprintf(out,
                    "<rect x=\"%.2f\" y=\"%.2f\" width=\"%.2f\" height=\"%.2f\" "
                    "fill=\"rgb(%d,%d,%d)\"><title>%.4g, %.4g: %.4g</title></rect>\n",
                    LEFT + cell_x * (double)c, TOP + PLOT - cell_y * (double)(r + step_y),
                    cell_x * (double)step_x + 0.3, cell_y * (double)step_y + 0.3, rgb[0], rgb[1],
                    rgb[2], map->x[c], map->y[r], value);
        }
    write_ticks(out, map, cell_x, cell_y);
    write_scale(out, low, high, map->value_label);
    report_figure_end(page);
}
