/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Draws figures of curves as SVG. Colours are those of Okabe and Ito, which the colour-blind tell
 * apart; dashes tell curves apart in print. Of a curve with more points than the drawing has
 * columns, each column keeps its first, lowest, highest and last one, so that no peak is lost.
 */
#include "page.h"

#include "../memory/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { LEFT = 66, RIGHT = 14, BELOW = 46, PLOT = 250, LINE = 18, LETTER = 7, KEY = 34 };
enum { COLOURS = 6, DASHES = 4 };

typedef struct frame {
    double x0, x1, y0, y1; /* ranges of the axes */
    double left, right, top, bottom;
    bool decades;
} frame;

report_curve *report_plot_add(report_plot *plot, const report_unit *x_unit, const double *x,
                              const report_unit *y_unit, const double *y, size_t count)
{
    if (plot->count == REPORT_MOST_CURVES || count == 0)
        return NULL;
    report_curve *curve = &plot->curves[plot->count];
    *curve = (report_curve){.x = memory_alloc(count * sizeof *curve->x),
                            .y = memory_alloc(count * sizeof *curve->y),
                            .count = count,
                            .colour = (int)plot->count};
    for (size_t i = 0; i < count; i++) {
        curve->x[i] = x ? report_convert(x_unit, x[i]) : (double)i;
        curve->y[i] = report_convert(y_unit, y[i]);
    }
    plot->count++;
    return curve;
}

void report_curve_bar(report_curve *curve, const report_unit *y_unit, const double *bar)
{
    curve->bar = memory_alloc(curve->count * sizeof *curve->bar);
    for (size_t i = 0; i < curve->count; i++)
        curve->bar[i] = fabs(y_unit->factor) * bar[i];
}

void report_plot_free(report_plot *plot)
{
    for (size_t i = 0; i < plot->count; i++) {
        free(plot->curves[i].bar);
        free(plot->curves[i].x);
        free(plot->curves[i].y);
    }
    plot->count = 0;
}

/* Returns a step that is easy to read: 1, 2 or 5 times a power of ten. */
static double tick_step(double from, double to, int most)
{
    double raw = (to - from) / most, power = pow(10, floor(log10(raw)));
    double share = raw / power;
    return power * (share <= 1 ? 1 : share <= 2 ? 2 : share <= 5 ? 5 : 10);
}

static frame find_frame(const report_plot *plot)
{
    frame f = {INFINITY, -INFINITY, INFINITY, -INFINITY, 0, 0, 0, 0, false};
    for (size_t k = 0; k < plot->count; k++)
        for (size_t i = 0; i < plot->curves[k].count; i++) {
            double x = plot->curves[k].x[i], y = plot->curves[k].y[i];
            if (!isfinite(x) || !isfinite(y))
                continue;
            f.x0 = fmin(f.x0, x);
            f.x1 = fmax(f.x1, x);
            f.y0 = fmin(f.y0, y);
            f.y1 = fmax(f.y1, y);
        }
    if (plot->x0 < plot->x1) {
        f.x0 = plot->x0;
        f.x1 = plot->x1;
    }
    if (!(f.x0 < f.x1)) {
        f.x0 = isfinite(f.x0) ? f.x0 - 0.5 : 0;
        f.x1 = f.x0 + 1;
    }
    if (plot->from_zero || (f.y0 > 0 && f.y0 < 0.4 * f.y1))
        f.y0 = fmin(f.y0, 0);
    if (plot->top > 0)
        f.y1 = plot->top;
    double span = f.y1 - f.y0, size = fmax(fabs(f.y0), fabs(f.y1));
    if (!(span > 1e-9 * size)) { /* a constant, or nothing */
        double room = size > 0 ? 0.1 * size : 1;
        f.y0 = isfinite(f.y0) ? f.y0 - room : 0;
        f.y1 = f.y0 + 2 * room;
    } else if (!(plot->top > 0)) {
        double step = tick_step(f.y0, f.y1, 5);
        f.y0 = step * floor(f.y0 / step + 1e-9);
        f.y1 = step * ceil(f.y1 / step - 1e-9);
    }
    return f;
}

static double place_x(const frame *f, double x)
{
    double share = f->decades ? log(x / f->x0) / log(f->x1 / f->x0) : (x - f->x0) / (f->x1 - f->x0);
    return f->left + share * (f->right - f->left);
}

static double place_y(const frame *f, double y)
{
    double place = f->bottom - (y - f->y0) / (f->y1 - f->y0) * (f->bottom - f->top);
    return fmin(fmax(place, -1e4), 1e4);
}

/* Counts the rows of the legend, and draws it when `out` is not NULL. */
static int write_legend(const report_plot *plot, FILE *out)
{
    double x = LEFT;
    int row = 0;
    for (size_t k = 0; k < plot->count; k++) {
        const report_curve *curve = &plot->curves[k];
        double width = KEY + LETTER * (double)strlen(curve->label) + 16;
        if (!*curve->label)
            continue;
        if (x > LEFT && x + width > REPORT_FIGURE_WIDTH - RIGHT) {
            x = LEFT;
            row++;
        }
        double y = 14 + row * LINE;
        if (out && curve->dots)
            fprintf(out, "<circle class=\"dot c%d\" cx=\"%.1f\" cy=\"%.1f\" r=\"3\"/>",
                    curve->colour % COLOURS, x + 14, y - 4);
        else if (out)
            fprintf(out, "<path class=\"curve c%d d%d\" d=\"M%.1f %.1fh28\"/>",
                    curve->colour % COLOURS, curve->dash % DASHES, x, y - 4);
        if (out) {
            fprintf(out, "<text class=\"key\" x=\"%.1f\" y=\"%.1f\">", x + KEY, y);
            report_put_text(out, curve->label);
            fputs("</text>\n", out);
        }
        x += width;
    }
    return plot->count && *plot->curves[0].label ? row + 1 : 0;
}

static void put_tick(FILE *out, double value, double step)
{
    char text[REPORT_TEXT_SIZE];
    report_number_text(fabs(value) < 1e-9 * step ? 0 : value, text);
    fputs(text, out);
}

void report_side_label(FILE *out, const char *label, double x, double y)
{
    enum { FITTING = 38 };
    double length = (double)strlen(label), size = 12.5;
    fprintf(out,
            "<text class=\"axis\" style=\"font-size:%.1fpx\" text-anchor=\"middle\" "
            "transform=\"translate(%.1f %.1f) rotate(-90)\">",
            length > FITTING ? size * FITTING / length : size, x, y);
    report_put_text(out, label);
    fputs("</text>\n", out);
}

static void put_x_tick(const frame *f, FILE *out, double x, double step)
{
    double at = place_x(f, x);
    fprintf(out,
            "<path class=\"grid\" d=\"M%.1f %.1fV%.1f\"/><text class=\"tick\" "
            "text-anchor=\"middle\" x=\"%.1f\" y=\"%.1f\">",
            at, f->top, f->bottom, at, f->bottom + 16);
    put_tick(out, x, step);
    fputs("</text>\n", out);
}

/* Puts ticks at 1, 2 and 5 of each decade, or at 1 alone where there are many decades. */
static void put_decades(const frame *f, FILE *out)
{
    static const double parts[] = {1, 2, 5};
    double low = floor(log10(f->x0)), high = log10(f->x1);
    for (double decade = low; decade <= high + 1e-9; decade++)
        for (size_t i = 0; i < (high - low > 4 ? 1 : 3); i++) {
            double x = parts[i] * pow(10, decade);
            if (x >= f->x0 * (1 - 1e-9) && x <= f->x1 * (1 + 1e-9))
                put_x_tick(f, out, x, 0);
        }
}

static void write_axes(const report_plot *plot, const frame *f, FILE *out)
{
    double step = tick_step(f->x0, f->x1, 10);
    if (f->decades)
        put_decades(f, out);
    else
        for (double x = step * ceil(f->x0 / step - 1e-9); x <= f->x1 + 1e-9 * step; x += step)
            put_x_tick(f, out, x, step);
    step = tick_step(f->y0, f->y1, 6);
    for (double y = step * ceil(f->y0 / step - 1e-9); y <= f->y1 + 1e-9 * step; y += step) {
        double at = place_y(f, y);
        fprintf(out,
                "<path class=\"grid\" d=\"M%.1f %.1fH%.1f\"/><text class=\"tick\" "
                "text-anchor=\"end\" x=\"%.1f\" y=\"%.1f\">",
                f->left, at, f->right, f->left - 6, at + 4);
        put_tick(out, y, step);
        fputs("</text>\n", out);
    }
    fprintf(out, "<rect class=\"box\" x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\"/>\n",
            f->left, f->top, f->right - f->left, f->bottom - f->top);
    fprintf(out, "<text class=\"axis\" text-anchor=\"middle\" x=\"%.1f\" y=\"%.1f\">",
            (f->left + f->right) / 2, f->bottom + 36);
    report_put_text(out, plot->x_label);
    fputs("</text>\n", out);
    report_side_label(out, plot->y_label, 14, (f->top + f->bottom) / 2);
}

static void write_marks(const report_plot *plot, const frame *f, FILE *out)
{
    for (size_t i = 0; i < plot->mark_count; i++) {
        double at = place_x(f, plot->marks[i]);
        if (!(at >= f->left - 0.5 && at <= f->right + 0.5))
            continue;
        const char *anchor = at < f->left + 20 ? "start" : at > f->right - 20 ? "end" : "middle";
        fprintf(out,
                "<path class=\"mark\" d=\"M%.1f %.1fV%.1f\"/><text class=\"name\" "
                "text-anchor=\"%s\" x=\"%.1f\" y=\"%.1f\">%s</text>\n",
                at, f->top, f->bottom, anchor, at, f->top - 4, plot->mark_names[i]);
    }
}

/* Consecutive points that fall on the same place are written once. */
typedef struct pen {
    FILE *out;
    long x, y; /* tenths of a pixel */
    bool down;
} pen;

static void put_point(pen *p, const frame *f, double x, double y)
{
    long px = lround(10 * place_x(f, x)), py = lround(10 * place_y(f, y));
    if (p->down && px == p->x && py == p->y)
        return;
    fprintf(p->out, "%s%.1f %.1f", p->down ? "L" : "M", (double)px / 10, (double)py / 10);
    *p = (pen){p->out, px, py, true};
}

static bool is_rising(const report_curve *curve)
{
    for (size_t i = 1; i < curve->count; i++)
        if (!(curve->x[i] >= curve->x[i - 1]))
            return false;
    return true;
}

/* Draws the first, lowest, highest and last of the points from..to, in their order. */
static void put_column(pen *p, const frame *f, const report_curve *curve, size_t from, size_t to)
{
    size_t low = from, high = from, kept[4];
    for (size_t i = from; i < to; i++) {
        low = curve->y[i] < curve->y[low] ? i : low;
        high = curve->y[i] > curve->y[high] ? i : high;
    }
    kept[0] = from;
    kept[1] = low < high ? low : high;
    kept[2] = low < high ? high : low;
    kept[3] = to - 1;
    for (size_t i = 0; i < 4; i++)
        put_point(p, f, curve->x[kept[i]], curve->y[kept[i]]);
}

static void write_line(report_page *page, const frame *f, const report_curve *curve)
{
    pen p = {.out = page->out};
    bool thin = curve->count > 4 * (size_t)(f->right - f->left) && is_rising(curve);
    page->thinned = page->thinned || thin;
    fprintf(page->out, "<path class=\"curve c%d d%d\"", curve->colour % COLOURS,
            curve->dash % DASHES);
    if (curve->live)
        fprintf(page->out, " data-live=\"%s\"", curve->live);
    fputs(" data-label=\"", page->out);
    report_put_text(page->out, curve->label);
    fputs("\" d=\"", page->out);
    for (size_t i = 0; i < curve->count;) {
        size_t end = i + 1;
        if (!isfinite(curve->x[i]) || !isfinite(curve->y[i])) {
            p.down = false;
        } else if (thin) {
            double column = floor(place_x(f, curve->x[i]));
            while (end < curve->count && isfinite(curve->y[end]) &&
                   floor(place_x(f, curve->x[end])) == column)
                end++;
            put_column(&p, f, curve, i, end);
        } else {
            put_point(&p, f, curve->x[i], curve->y[i]);
        }
        i = end;
    }
    fputs("\"/>\n", page->out);
}

/* Draws y - bar to y + bar; a long series by every so many points, each with the widest bar of
   those that it stands for. */
static void write_band(report_page *page, const frame *f, const report_curve *curve)
{
    enum { MOST_POINTS = 1000 };
    size_t step = curve->count / MOST_POINTS + 1, count = (curve->count + step - 1) / step;
    bool down = false;
    fprintf(page->out, "<path class=\"band c%d\" d=\"", curve->colour % COLOURS);
    for (size_t k = 0; k < 2 * count; k++) { /* along the upper edge, and back along the lower */
        size_t at = (k < count ? k : 2 * count - 1 - k) * step;
        double widest = 0;
        for (size_t i = at; i < curve->count && i < at + step; i++)
            widest = fmax(widest, curve->bar[i]);
        double y = curve->y[at] + (k < count ? widest : -widest);
        if (!isfinite(curve->x[at]) || !isfinite(y))
            continue;
        fprintf(page->out, "%s%.1f %.1f", down ? "L" : "M", place_x(f, curve->x[at]),
                place_y(f, y));
        down = true;
    }
    fputs("\"/>\n", page->out);
}

static void write_dots(report_page *page, const frame *f, const report_curve *curve)
{
    enum { MOST_DOTS = 2000 };
    size_t step = curve->count / MOST_DOTS + 1;
    page->thinned = page->thinned || step > 1;
    fprintf(page->out, "<g class=\"dot c%d\">", curve->colour % COLOURS);
    for (size_t i = 0; i < curve->count; i += step)
        if (isfinite(curve->x[i]) && isfinite(curve->y[i]))
            fprintf(page->out, "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"2.5\"/>",
                    place_x(f, curve->x[i]), place_y(f, curve->y[i]));
    fputs("</g>\n", page->out);
}

void report_figure_begin(report_page *page, const char *title, const char *class, int height)
{
    page->figures++;
    fprintf(page->out, "<figure%s%s%s><figcaption>", class ? " class=\"" : "", class ? class : "",
            class ? "\"" : "");
    report_put_text(page->out, title);
    fprintf(page->out,
            "<button type=\"button\" class=\"save\" data-name=\"figure-%zu\">save .svg</button>"
            "</figcaption>\n<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"figure\" "
            "viewBox=\"0 0 %d %d\" role=\"img\" aria-label=\"",
            page->figures, REPORT_FIGURE_WIDTH, height);
    report_put_text(page->out, title);
    fputs("\">\n", page->out);
}

void report_figure_end(report_page *page)
{
    fputs("</svg></figure>\n", page->out);
}

void report_plot_write(report_page *page, const report_plot *plot)
{
    FILE *out = page->out;
    if (plot->count == 0)
        return;
    frame f = find_frame(plot);
    int head = 10 + write_legend(plot, NULL) * LINE + (plot->mark_count ? 14 : 0);
    f.left = LEFT;
    f.right = REPORT_FIGURE_WIDTH - RIGHT;
    f.top = head;
    f.bottom = head + PLOT;
    f.decades = plot->decades && f.x0 > 0;
    report_figure_begin(page, plot->title, plot->class, head + PLOT + BELOW);
    write_legend(plot, out);
    write_axes(plot, &f, out);
    write_marks(plot, &f, out);
    fprintf(out,
            "<clipPath id=\"clip%zu\"><rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\"/>"
            "</clipPath>\n<g class=\"plot\" clip-path=\"url(#clip%zu)\" data-x=\"%.9g %.9g %.1f "
            "%.1f%s\" data-y=\"%.9g %.9g %.1f %.1f\">\n",
            page->figures, f.left, f.top - 1, f.right - f.left, f.bottom - f.top + 2, page->figures,
            f.x0, f.x1, f.left, f.right, f.decades ? " 1" : "", f.y0, f.y1, f.bottom, f.top);
    for (size_t k = 0; k < plot->count; k++)
        if (plot->curves[k].bar)
            write_band(page, &f, &plot->curves[k]);
    for (size_t k = 0; k < plot->count; k++)
        (plot->curves[k].dots ? write_dots : write_line)(page, &f, &plot->curves[k]);
    fputs("</g>\n", out);
    report_figure_end(page);
}
