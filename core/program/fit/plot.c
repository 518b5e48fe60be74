/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The residuals of all laws over pressure, as SVG. Colours by Okabe & Ito 2008; each law has a
   marker of its own, too. */
#include "fit.h"

#include <math.h>

enum { WIDTH = 640, HEIGHT = 360, LEFT = 64, RIGHT = 12, TOP = 48, BOTTOM = 46, LOOKS = 6 };

static const char *const colours[LOOKS] = {"#0072b2", "#d55e00", "#009e73",
                                           "#cc79a7", "#e69f00", "#56b4e9"};

typedef struct plot {
    FILE *out;
    double low, high; /* GPa */
    double top;       /* percent, either way */
} plot;

/* 1, 2 or 5 times a power of ten, about a fifth of the range. */
static double tick_of(double range)
{
    double rough = range / 5, power = pow(10, floor(log10(rough))), n = rough / power;
    return power * (n < 1.5 ? 1 : n < 3.5 ? 2 : n < 7.5 ? 5 : 10);
}

static double x_of(const plot *g, double p)
{
    return LEFT + (p - g->low) / (g->high - g->low) * (WIDTH - LEFT - RIGHT);
}

static double y_of(const plot *g, double percent)
{
    return TOP + (1 - percent / g->top) / 2 * (HEIGHT - TOP - BOTTOM);
}

static void print_axes(const plot *g)
{
    double dp = tick_of(g->high - g->low), dy = tick_of(2 * g->top);
    for (double p = ceil(g->low / dp) * dp; p <= g->high + 1e-9 * dp; p += dp)
        fprintf(g->out,
                "<path class='g' d='M%.1f %d V%d'/><text x='%.1f' y='%d' "
                "text-anchor='middle'>%.4g</text>\n",
                x_of(g, p), TOP, HEIGHT - BOTTOM, x_of(g, p), HEIGHT - BOTTOM + 16,
                fabs(p) < 1e-9 * dp ? 0 : p);
    for (double y = ceil(-g->top / dy) * dy; y <= g->top * (1 + 1e-9); y += dy)
        fprintf(g->out,
                "<path class='%s' d='M%d %.1f H%d'/><text x='%d' y='%.1f' "
                "text-anchor='end'>%.3g</text>\n",
                fabs(y) < 1e-9 * dy ? "z" : "g", LEFT, y_of(g, y), WIDTH - RIGHT, LEFT - 6,
                y_of(g, y) + 4, fabs(y) < 1e-9 * dy ? 0 : y);
    fprintf(g->out,
            "<text x='%d' y='%d' text-anchor='middle'>pressure [GPa]</text>\n"
            "<text transform='translate(14 %d) rotate(-90)' text-anchor='middle'>"
            "data over law - 1 [%%]</text>\n",
            (WIDTH + LEFT - RIGHT) / 2, HEIGHT - 10, (HEIGHT + TOP - BOTTOM) / 2);
}

/* The marker of a law around (0, 0). */
static const char *const markers[LOOKS] = {"m-4 0a4 4 0 1 0 8 0a4 4 0 1 0 -8 0z",
                                           "m-4 -4h8v8h-8z",
                                           "m0 -5l5 9h-10z",
                                           "m0 -5l5 5l-5 5l-5 -5z",
                                           "m-4 -4l8 8m0 -8l-8 8",
                                           "m-5 0h10m-5 -5v10"};

static void print_marker(const plot *g, size_t look, double x, double y)
{
    fprintf(g->out, "<path fill='none' stroke-width='1.5' stroke='%s' d='M%.1f %.1f%s'/>\n",
            colours[look], x, y, markers[look]);
}

static void scale(plot *g, const fit *f)
{
    g->low = g->high = 1e-9 * f->data.p[0];
    for (size_t i = 0; i < f->data.n; i++) {
        g->low = fmin(g->low, 1e-9 * f->data.p[i]);
        g->high = fmax(g->high, 1e-9 * f->data.p[i]);
        for (size_t k = 0; k < f->law_count; k++)
            if (!*f->laws[k].why)
                g->top = fmax(g->top, fabs(100 * expm1(f->laws[k].residual[i])));
    }
    double margin = 0.03 * (g->high - g->low);
    g->low -= margin;
    g->high += margin;
    g->top = 1.1 * fmax(g->top, 1e-6);
}

void fit_write_plot(const fit *f, FILE *out)
{
    size_t shown = 0;
    plot g = {.out = out};
    scale(&g, f);
    fprintf(g.out,
            "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 %d %d' font-family='sans-serif' "
            "font-size='12'>\n<style>text{fill:#222}.g{stroke:#ddd}.z{stroke:#555}"
            "@media(prefers-color-scheme:dark){text{fill:#ddd}.g{stroke:#444}.z{stroke:#aaa}}"
            "</style>\n",
            WIDTH, HEIGHT);
    print_axes(&g);
    for (size_t k = 0; k < f->law_count; k++) {
        if (*f->laws[k].why)
            continue;
        for (size_t i = 0; i < f->data.n; i++)
            print_marker(&g, shown % LOOKS, x_of(&g, 1e-9 * f->data.p[i]),
                         y_of(&g, 100 * expm1(f->laws[k].residual[i])));
        size_t x = LEFT + 190 * (shown % 3), y = 14 + 16 * (shown / 3);
        print_marker(&g, shown % LOOKS, (double)x, (double)y);
        fprintf(g.out, "<text x='%zu' y='%zu'>%s</text>\n", x + 10, y + 4, f->laws[k].id);
        shown++;
    }
    fputs("</svg>\n", g.out);
}
