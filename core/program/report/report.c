/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "report.h"
#include "page.h"

#include <errno.h>
#include <string.h>

static const char *const figure_style[] = {
#include "figure.css.inc"
};
static const char *const page_style[] = {
#include "page.css.inc"
};
static const char *const figure_script[] = {
#include "figure.js.inc"
};
/* the plotting library; 0 alone when the build had none */
static const unsigned char library[] = {
#include "library.js.inc"
    0};
static const char *const script[] = {
#include "script.js.inc"
};

#define WRITE(out, lines) write_lines(out, lines, sizeof(lines) / sizeof *(lines))

static void write_lines(FILE *out, const char *const *lines, size_t count)
{
    for (size_t i = 0; i < count; i++)
        fprintf(out, "%s\n", lines[i]);
}

static void write_head(FILE *out, const char *title)
{
    fputs("<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
          "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
          "<meta name=\"generator\" content=\"flankfilm\">\n"
          "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src "
          "'unsafe-inline'; script-src 'unsafe-inline'; img-src data: blob:\">\n"
          "<meta name=\"color-scheme\" content=\"light dark\">\n<title>",
          out);
    report_put_text(out, title);
    fputs("</title>\n<style>\n", out);
    WRITE(out, figure_style);
    fputs("</style>\n<style>\n", out);
    WRITE(out, page_style);
    fputs("</style>\n</head>\n<body>\n<i id=\"light\" class=\"figure\" hidden></i>\n<header><h1>",
          out);
    report_put_text(out, title);
    fputs("</h1></header>\n<main>\n"
          "<noscript><p class=\"alarm\">The figures are drawn by a script, which is switched off "
          "here.</p></noscript>\n<p class=\"alarm without\" hidden>This build has no plotting "
          "library (libjs-vega): tables stand in place of the figures.</p>\n",
          out);
}

static void write_foot(FILE *out, bool thinned)
{
    if (thinned)
        fputs("<p class=\"note\">Long curves are drawn with the first, lowest, highest and last "
              "point "
              "of each column of the drawing, maps and fields with fewer points than they have. "
              "<code>flankfilm export</code> gives all numbers.</p>\n",
              out);
    fputs("</main>\n<script>\n", out);
    fwrite(library, 1, sizeof library - 1, out);
    WRITE(out, figure_script);
    WRITE(out, script);
    fputs("</script>\n</body>\n</html>\n", out);
}

void report_write_figures(FILE *out, const char *title, const char *json)
{
    write_head(out, title);
    report_put_figures(out, json);
    write_foot(out, false);
}

static void write_page(report_page *page)
{
    static void (*const sections[])(report_page *) = {
        report_write_verdict,   report_write_speed,   report_write_study,  report_write_series,
        report_write_snapshots, report_write_quality, report_write_origin,
    };
    write_head(page->out, *page->view->title ? page->view->title : "flankfilm");
    for (size_t i = 0; i < sizeof sections / sizeof *sections && !page->failed; i++)
        sections[i](page);
    write_foot(page->out, page->thinned);
}

bool report_write(const results_view *view, const char *path, ff_report *report)
{
    report_page page = {.view = view, .out = fopen(path, "we")};
    bool lost = !page.out;
    if (page.out) {
        write_page(&page);
        errno = 0;
        lost = ferror(page.out) != 0;
        lost = fclose(page.out) != 0 || lost;
    }
    if (lost && !page.failed)
        ff_error(report, FF_FAULT_RUN, FF_NOWHERE, NULL, "the page could not be written: %s",
                 strerror(errno ? errno : EIO));
    return !lost && !page.failed;
}
