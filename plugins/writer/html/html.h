/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Shared by the files of the writer html. */
#ifndef FF_HTML_H
#define FF_HTML_H

#include "../pick.h"

typedef struct ff_page {
    const ff_view *view;
    const ff_host *host;
    FILE *out;
    ff_status status; /* of the first failure to read */
    size_t figures;   /* so far */
    bool thinned;     /* something is shown with fewer points than it has */
} ff_page;

/* Text with what HTML takes for its own escaped. */
void ff_html(FILE *out, const char *text);

/* A part of the page that is kept only when it has got a figure. */
typedef struct ff_part {
    FILE *page;
    char *text;
    size_t size, figures;
} ff_part;

void ff_part_begin(ff_page *page, ff_part *part);
void ff_part_end(ff_page *page, ff_part *part);

/* shown.c: numbers as engineers read them: shown = si * factor + offset. */
typedef struct ff_shown {
    double factor, offset;
    const char *unit; /* "" for a pure number */
} ff_shown;

ff_shown ff_show(const char *si_unit, double magnitude);
/* The unit of an output, with which ff_show tells a temperature from a rise of it. */
const char *ff_unit_of(const char *si_unit, const char *output);
double ff_show_value(const ff_shown *shown, double si);
enum { FF_TEXT_SIZE = 200 };
void ff_number_text(double value, char out[FF_TEXT_SIZE]);
/* "22.3 deg" of an SI value. */
void ff_quantity_text(const char *si_unit, double si, char out[FF_TEXT_SIZE]);
/* What an output is called in a figure: "least film thickness" for h_min. */
const char *ff_output_words(const char *output, char out[FF_TEXT_SIZE]);
/* The value of an axis: as the user wrote it, unless that is long. */
const char *ff_axis_word(const ff_view_axis *axis, size_t point, char out[FF_TEXT_SIZE]);
/* "lower, 100 N m": what varies in the case, apart from dimensions a and b (none: SIZE_MAX, -1). */
void ff_name_case(const ff_view *view, size_t index, size_t a, int b, char out[FF_TEXT_SIZE]);
void ff_label(const char *words, const ff_shown *shown, char out[FF_TEXT_SIZE]);

/* find.c: parts of the results. -1: there is none. */
int ff_find_variable(const ff_view *view, const char *name);
int ff_find_output(const ff_view *view, size_t stage, const char *output);
/* What dimension dim of a variable is plotted against in a case: a series of that length. */
int ff_find_axis(const ff_view *view, size_t variable, uint32_t dim, size_t index);
/* A scalar output of that name of any stage, in SI; NaN without one. */
double ff_any_scalar(ff_page *page, const char *output, size_t index);
/* Loads, and keeps the first failure; data is NULL when there is nothing. */
ff_array ff_load(ff_page *page, int variable, size_t index);
void ff_release(ff_page *page, ff_array *array);
size_t ff_count(const ff_array *array);

/* Points along the path of contact: SAP, LPSTC, pitch, HPSTC, tip. */
enum { FF_MARKS = 5 };
typedef struct ff_marks {
    double roll[FF_MARKS]; /* rad; NaN: unknown */
} ff_marks;
extern const char *const ff_mark_names[FF_MARKS];
ff_marks ff_find_marks(ff_page *page, size_t index);

/* plot.c: a figure of curves. */
typedef struct ff_curve {
    double *x, *y; /* as shown; owned */
    size_t count;
    int colour, dash; /* ranks; any number */
    bool dots;        /* points instead of a line */
    const char *live; /* what a script changes, or NULL */
    char label[FF_TEXT_SIZE];
} ff_curve;

enum { FF_MOST_CURVES = 16 };
typedef struct ff_plot {
    char title[FF_TEXT_SIZE], x_label[FF_TEXT_SIZE], y_label[FF_TEXT_SIZE];
    ff_curve curves[FF_MOST_CURVES];
    size_t count;
    double marks[FF_MARKS];
    const char *mark_names[FF_MARKS];
    size_t mark_count;
    double top;    /* of the y axis, when above 0 */
    double x0, x1; /* the range shown, when x0 < x1 */
    bool from_zero;
    bool decades;      /* along x, whose values are above 0 */
    const char *class; /* of the figure, or NULL */
} ff_plot;

/* Copies the numbers in the units shown; returns the curve, or NULL when there is no room. */
ff_curve *ff_plot_add(ff_plot *plot, const ff_shown *x_unit, const double *x,
                      const ff_shown *y_unit, const double *y, size_t count);
void ff_plot_write(ff_page *page, const ff_plot *plot);
void ff_plot_free(ff_plot *plot);

/* The name of a vertical axis, in letters that let it fit. */
void ff_side_label(FILE *out, const char *label, double x, double y);
/* Steps of an axis that are easy to read: 1, 2 or 5 times a power of ten. */
double ff_tick_step(double from, double to, int most);
/* <figure> with its head and button, up to the drawing area of that height. */
void ff_figure_begin(ff_page *page, const char *title, const char *class, int height);
void ff_figure_end(ff_page *page);
enum { FF_FIGURE_WIDTH = 760 };

/* map.c: values over two axes as colours. */
typedef struct ff_map {
    char title[FF_TEXT_SIZE], value_label[FF_TEXT_SIZE];
    char x_label[FF_TEXT_SIZE], y_label[FF_TEXT_SIZE];
    size_t columns, rows;
    const double *x, *y;  /* as shown */
    const double *values; /* rows of columns, as shown; NaN: none */
    double low, high;     /* the range of the colours */
} ff_map;
void ff_map_write(ff_page *page, const ff_map *map);

/* The sections of the page. */
void ff_write_verdict(ff_page *page);
void ff_write_speed(ff_page *page);
void ff_write_path(ff_page *page);
void ff_write_snapshots(ff_page *page);
void ff_write_study(ff_page *page);
void ff_write_quality(ff_page *page);
void ff_write_origin(ff_page *page);

#endif
