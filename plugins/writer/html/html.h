/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Shared by the files of the writer html. */
#ifndef WRITER_HTML_H
#define WRITER_HTML_H

#include "../pick.h"

typedef struct writer_page {
    const ff_view *view;
    const ff_host *host;
    FILE *out;
    ff_status status; /* of the first failure to read */
    size_t figures;   /* so far */
    bool thinned;     /* something is shown with fewer points than it has */
} writer_page;

/* Text with what HTML takes for its own escaped. */
void writer_html(FILE *out, const char *text);

/* A part of the page that is kept only when it has got a figure. */
typedef struct writer_part {
    FILE *page;
    char *text;
    size_t size, figures;
} writer_part;

void writer_part_begin(writer_page *page, writer_part *part);
void writer_part_end(writer_page *page, writer_part *part);

/* shown.c: numbers as engineers read them: shown = si * factor + offset. */
typedef struct writer_shown {
    double factor, offset;
    const char *unit; /* "" for a pure number */
} writer_shown;

writer_shown writer_show(const char *si_unit, double magnitude);
/* The unit of an output, with which writer_show tells a temperature from a rise of it. */
const char *writer_unit_of(const char *si_unit, const char *output);
double writer_show_value(const writer_shown *shown, double si);
enum { WRITER_TEXT_SIZE = 200 };
void writer_number_text(double value, char out[WRITER_TEXT_SIZE]);
/* "22.3 deg" of an SI value. */
void writer_quantity_text(const char *si_unit, double si, char out[WRITER_TEXT_SIZE]);
/* What an output is called in a figure: "least film thickness" for h_min. */
const char *writer_output_words(const char *output, char out[WRITER_TEXT_SIZE]);
/* The value of an axis: as the user wrote it, unless that is long. */
const char *writer_axis_word(const ff_view_axis *axis, size_t point, char out[WRITER_TEXT_SIZE]);
/* "lower, 100 N m": what varies in the case, apart from dimensions a and b (none: SIZE_MAX, -1). */
void writer_name_case(const ff_view *view, size_t index, size_t a, int b,
                      char out[WRITER_TEXT_SIZE]);
void writer_label(const char *words, const writer_shown *shown, char out[WRITER_TEXT_SIZE]);

/* find.c: parts of the results. -1: there is none. */
int writer_find_variable(const ff_view *view, const char *name);
int writer_find_output(const ff_view *view, size_t stage, const char *output);
/* What dimension dim of a variable is plotted against in a case: a series of that length. */
int writer_find_axis(const ff_view *view, size_t variable, uint32_t dim, size_t index);
/* A scalar output of that name of any stage, in SI; NaN without one. */
double writer_any_scalar(writer_page *page, const char *output, size_t index);
/* Loads, and keeps the first failure; data is NULL when there is nothing. */
ff_array writer_load(writer_page *page, int variable, size_t index);
void writer_release(writer_page *page, ff_array *array);
size_t writer_count(const ff_array *array);

/* Points along the path of contact: SAP, LPSTC, pitch, HPSTC, tip. */
enum { WRITER_MARKS = 5 };
typedef struct writer_marks {
    double roll[WRITER_MARKS]; /* rad; NaN: unknown */
} writer_marks;
extern const char *const writer_mark_names[WRITER_MARKS];
writer_marks writer_find_marks(writer_page *page, size_t index);

/* plot.c: a figure of curves. */
typedef struct writer_curve {
    double *x, *y; /* as shown; owned */
    size_t count;
    int colour, dash; /* ranks; any number */
    bool dots;        /* points instead of a line */
    const char *live; /* what a script changes, or NULL */
    char label[WRITER_TEXT_SIZE];
} writer_curve;

enum { WRITER_MOST_CURVES = 16 };
typedef struct writer_plot {
    char title[WRITER_TEXT_SIZE], x_label[WRITER_TEXT_SIZE], y_label[WRITER_TEXT_SIZE];
    writer_curve curves[WRITER_MOST_CURVES];
    size_t count;
    double marks[WRITER_MARKS];
    const char *mark_names[WRITER_MARKS];
    size_t mark_count;
    double top;    /* of the y axis, when above 0 */
    double x0, x1; /* the range shown, when x0 < x1 */
    bool from_zero;
    bool decades;      /* along x, whose values are above 0 */
    const char *class; /* of the figure, or NULL */
} writer_plot;

/* Copies the numbers in the units shown; returns the curve, or NULL when there is no room. */
writer_curve *writer_plot_add(writer_plot *plot, const writer_shown *x_unit, const double *x,
                              const writer_shown *y_unit, const double *y, size_t count);
void writer_plot_write(writer_page *page, const writer_plot *plot);
void writer_plot_free(writer_plot *plot);

/* The name of a vertical axis, in letters that let it fit. */
void writer_side_label(FILE *out, const char *label, double x, double y);
/* Steps of an axis that are easy to read: 1, 2 or 5 times a power of ten. */
double writer_tick_step(double from, double to, int most);
/* <figure> with its head and button, up to the drawing area of that height. */
void writer_figure_begin(writer_page *page, const char *title, const char *class, int height);
void writer_figure_end(writer_page *page);
enum { WRITER_FIGURE_WIDTH = 760 };

/* map.c: values over two axes as colours. */
typedef struct writer_map {
    char title[WRITER_TEXT_SIZE], value_label[WRITER_TEXT_SIZE];
    char x_label[WRITER_TEXT_SIZE], y_label[WRITER_TEXT_SIZE];
    size_t columns, rows;
    const double *x, *y;  /* as shown */
    const double *values; /* rows of columns, as shown; NaN: none */
    double low, high;     /* the range of the colours */
} writer_map;
void writer_map_write(writer_page *page, const writer_map *map);

/* The sections of the page. */
void writer_write_verdict(writer_page *page);
void writer_write_speed(writer_page *page);
void writer_write_path(writer_page *page);
void writer_write_snapshots(writer_page *page);
void writer_write_study(writer_page *page);
void writer_write_quality(writer_page *page);
void writer_write_origin(writer_page *page);

#endif
