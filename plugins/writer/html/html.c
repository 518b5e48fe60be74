/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The report: one page that holds all it needs and asks no network for anything. */
#include "html.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

static const char *const figure_style[] = {
#include "figure.css.inc"
};
static const char *const page_style[] = {
#include "page.css.inc"
};
static const char *const script[] = {
#include "script.js.inc"
};

#define WRITE(out, lines) write_lines(out, lines, sizeof(lines) / sizeof *(lines))

static void write_lines(FILE *out, const char *const *lines, size_t count)
{
    for (size_t i = 0; i < count; i++)
        fprintf(out, "%s\n", lines[i]);
}

void writer_part_begin(writer_page *page, writer_part *part)
{
    *part = (writer_part){.page = page->out, .figures = page->figures};
    FILE *out = open_memstream(&part->text, &part->size);
    if (out)
        page->out = out;
    else
        page->status = FF_NOMEM;
}

void writer_part_end(writer_page *page, writer_part *part)
{
    if (page->out == part->page)
        return;
    if (fclose(page->out) != 0)
        page->status = FF_NOMEM;
    else if (page->figures > part->figures)
        fwrite(part->text, 1, part->size, part->page);
    free(part->text);
    page->out = part->page;
}

static void write_head(writer_page *page)
{
    FILE *out = page->out;
    const char *title = *page->view->title ? page->view->title : "flankfilm";
    fputs("<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
          "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
          "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src "
          "'unsafe-inline'; script-src 'unsafe-inline'; img-src data: blob:\">\n"
          "<meta name=\"color-scheme\" content=\"light dark\">\n<title>",
          out);
    writer_html(out, title);
    fputs("</title>\n<style id=\"figure-style\">\n", out);
    WRITE(out, figure_style);
    fputs("</style>\n<style>\n", out);
    WRITE(out, page_style);
    fputs("</style>\n</head>\n<body>\n<header><h1>", out);
    writer_html(out, title);
    fputs("</h1></header>\n<main>\n", out);
}

static void write_foot(writer_page *page)
{
    if (page->thinned)
        fputs(
            "<p class=\"note\">Curves are drawn with the first, lowest, highest and last point of "
            "each column of the drawing, maps and fields with fewer points than they have. "
            "<code>flankfilm export</code> gives all numbers.</p>\n",
            page->out);
    fputs("</main>\n<script>\n", page->out);
    WRITE(page->out, script);
    fputs("</script>\n</body>\n</html>\n", page->out);
}

static void write_page(writer_page *page)
{
    static void (*const sections[])(writer_page *) = {
        writer_write_verdict,   writer_write_speed,   writer_write_study,  writer_write_path,
        writer_write_snapshots, writer_write_quality, writer_write_origin,
    };
    const size_t count = sizeof sections / sizeof *sections;
    write_head(page);
    for (size_t i = 0; i < count && page->status == FF_OK; i++) {
        sections[i](page);
        if (page->status == FF_OK &&
            page->host->progress(page->host->ctx, (double)(i + 1) / (double)count))
            page->status = FF_STOPPED;
    }
    write_foot(page);
}

static ff_status write_file(void *self, const ff_view *view, const ff_target *target)
{
    const writer_self *writer = self;
    const char *path = target->path(target->ctx, NULL);
    writer_page page = {.view = view, .host = writer->host, .out = path ? fopen(path, "we") : NULL};
    if (!path)
        return FF_NOCONV;
    if (page.out)
        write_page(&page);
    errno = 0;
    bool lost = !page.out || ferror(page.out) != 0;
    if (page.out)
        lost = fclose(page.out) != 0 || lost;
    if (lost && page.status == FF_OK)
        return ff_failf(writer->host, FF_NOCONV, NULL, "the page could not be written: %s",
                        strerror(errno ? errno : EIO));
    return page.status;
}

static ff_status create(const ff_host *host, void **self)
{
    return writer_create(host, &(ff_writer){.suffix = ".html", .write = write_file}, self);
}

static const ff_model model = {
    .size = sizeof(ff_model),
    .abi_major = FF_ABI_MAJOR,
    .abi_minor = 0,
    .id = "writer/html",
    .version = "1.0.0",
    .summary = "results as one page with figures, for a browser without a network",
    .reference = "Okabe, Ito 2008, Color Universal Design (palette of the curves)",
    .bibtex = "@misc{OkabeIto2008, author={Okabe, M. and Ito, K.}, title={Color Universal Design "
              "({CUD}): how to make figures and presentations that are friendly to colorblind "
              "people}, year={2008}}",
    .licence = "GPL-3.0-or-later",
    .params = FF_NO_TABLE,
    .inputs = FF_NO_TABLE,
    .outputs = FF_TABLE(writer_outputs),
    .create = create,
    .service = writer_service,
    .destroy = writer_destroy,
};

const ff_model *flankfilm_model_v1(void)
{
    return &model;
}
