/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "report.h"
#include "page.h"
#include "sha256.h"

#include "../memory/memory.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/* The files from which a page is made: those installed in share/flankfilm/template, or files of the
 * same names in the user's own folder. */
static const char *const layout[] = {
#include "layout.html.inc"
    NULL};
static const char *const page_style[] = {
#include "page.css.inc"
    NULL};
static const char *const figure_style[] = {
#include "figure.css.inc"
    NULL};
static const char *const figure_script[] = {
#include "figure.js.inc"
    NULL};
static const char *const answer_script[] = {
#include "answers.js.inc"
    NULL};
static const char *const choice_script[] = {
#include "choose.js.inc"
    NULL};
static const char *const page_script[] = {
#include "script.js.inc"
    NULL};
/* the plotting library; only a 0 if the build had none */
static const unsigned char library[] = {
#include "library.js.inc"
    0};

static const struct {
    const char *name;
    const char *const *lines;
} parts[] = {{"layout.html", layout},       {"figure.css", figure_style},
             {"page.css", page_style},      {"figure.js", figure_script},
             {"answers.js", answer_script}, {"choose.js", choice_script},
             {"script.js", page_script}};
enum {
    LAYOUT,
    FIGURE_STYLE,
    PAGE_STYLE,
    FIGURE_SCRIPT,
    ANSWER_SCRIPT,
    CHOICE_SCRIPT,
    PAGE_SCRIPT,
    PARTS
};

typedef struct text {
    char *text;
    size_t length;
} text;

struct report_template {
    text parts[PARTS];
    text style, script; /* contents of the page's elements */
};

static const char names_of_parts[] = "layout.html, figure.css, page.css, figure.js, "
                                     "answers.js, choose.js, script.js";

static text join(const char *const *lines)
{
    text joined;
    FILE *out = memory_require(open_memstream(&joined.text, &joined.length));
    for (; *lines; lines++)
        fprintf(out, "%s\n", *lines);
    fclose(out);
    return joined;
}

/* Reads a file of the folder; if it does not exist, its text stays NULL. */
static text read_part(const char *folder, const char *name)
{
    text read = {NULL, 0};
    char buffer[4096], *path = memory_print_text("%s/%s", folder, name);
    struct stat about;
    FILE *in = stat(path, &about) == 0 && S_ISREG(about.st_mode) ? fopen(path, "re") : NULL;
    free(path);
    if (!in)
        return read;
    FILE *out = memory_require(open_memstream(&read.text, &read.length));
    for (size_t got; (got = fread(buffer, 1, sizeof buffer, in)) > 0;)
        fwrite(buffer, 1, got, out);
    fclose(in);
    fclose(out);
    return read;
}

/* Finds the next "{{name}}" of a layout, and the text after it; NULL if there is none. */
static const char *find_hole(const char *from, char name[16], const char **behind)
{
    const char *hole = strstr(from, "{{"), *end = hole ? strstr(hole, "}}") : NULL;
    if (!end)
        return NULL;
    snprintf(name, 16, "%.*s", (int)(end - hole - 2), hole + 2);
    *behind = end + 2;
    return hole;
}

static bool check_layout(const char *of, const char *folder, ff_report *report)
{
    static const char *const holes[] = {"policy", "title", "style", "page", "script"};
    enum { HOLES = sizeof holes / sizeof *holes };
    bool pages = false;
    char name[16];
    const char *at = of;
    if (strncmp(of, REPORT_BEGINS, strlen(REPORT_BEGINS)) != 0 || !strstr(of, "flankfilm"))
        return ff_error(report, FF_FAULT_INPUT, FF_NOWHERE,
                        "start from a copy of the installed layout",
                        "%s/layout.html does not begin with \"%s\", or does not name flankfilm",
                        folder, REPORT_BEGINS);
    while (find_hole(at, name, &at)) {
        size_t i = 0;
        while (i < HOLES && strcmp(name, holes[i]) != 0)
            i++;
        const char *near = i < HOLES ? NULL : ff_nearest(name, holes, HOLES);
        if (i == HOLES)
            return ff_error(report, FF_FAULT_INPUT, FF_NOWHERE,
                            "the names are policy, title, style, page and script",
                            "%s/layout.html: unknown name {{%s}}%s%s%s", folder, name,
                            near ? "; did you mean {{" : "", near ? near : "", near ? "}}?" : "");
        pages = pages || !strcmp(name, "page");
    }
    return pages || ff_error(report, FF_FAULT_INPUT, FF_NOWHERE, NULL,
                             "%s/layout.html has no {{page}}, where the page would go", folder);
}

/* Assembles the elements of the page. */
static void assemble(report_template *made)
{
    FILE *out = memory_require(open_memstream(&made->style.text, &made->style.length));
    fprintf(out, "\n%s%s", made->parts[FIGURE_STYLE].text, made->parts[PAGE_STYLE].text);
    fclose(out);
    out = memory_require(open_memstream(&made->script.text, &made->script.length));
    fputc('\n', out);
    fwrite(library, 1, sizeof library - 1, out);
    for (size_t i = FIGURE_SCRIPT; i <= PAGE_SCRIPT; i++)
        fputs(made->parts[i].text, out);
    fclose(out);
}

report_template *report_template_open(const char *folder, ff_report *report)
{
    report_template *made = memory_alloc(sizeof *made);
    size_t own = 0;
    for (size_t i = 0; i < PARTS; i++) {
        made->parts[i] = folder ? read_part(folder, parts[i].name) : (text){NULL, 0};
        own += made->parts[i].text != NULL;
        if (!made->parts[i].text)
            made->parts[i] = join(parts[i].lines);
    }
    assemble(made);
    if (!folder || (own > 0 && check_layout(made->parts[LAYOUT].text, folder, report)))
        return made;
    if (own == 0)
        ff_error(report, FF_FAULT_INPUT, FF_NOWHERE, "copy files from share/flankfilm/template",
                 "--template %s: the folder has none of %s", folder, names_of_parts);
    report_template_close(made);
    return NULL;
}

void report_template_close(report_template *of)
{
    for (size_t i = 0; of && i < PARTS; i++)
        free(of->parts[i].text);
    if (of) {
        free(of->style.text);
        free(of->script.text);
    }
    free(of);
}

/* A content security policy: the browser runs only the page's own scripts and styles, whatever its
 * texts contain. The plotting library sets the attribute `style` of its elements. */
static void put_policy(const report_template *with, FILE *out)
{
    char style[SHA256_BASE64], script[SHA256_BASE64];
    sha256_base64(with->style.text, with->style.length, style);
    sha256_base64(with->script.text, with->script.length, script);
    fprintf(out,
            "default-src 'none'; style-src-elem 'sha256-%s'; style-src-attr 'unsafe-inline'; "
            "script-src 'sha256-%s'; img-src data: blob:",
            style, script);
}

/* Writes the layout with the elements in their places. */
static void write_layout(const report_template *with, FILE *out, const char *title,
                         const text *page)
{
    const char *from = with->parts[LAYOUT].text, *hole, *behind;
    char name[16];
    while ((hole = find_hole(from, name, &behind))) {
        fwrite(from, 1, (size_t)(hole - from), out);
        if (!strcmp(name, "title"))
            report_put_text(out, title);
        else if (!strcmp(name, "policy"))
            put_policy(with, out);
        else if (!strcmp(name, "style"))
            fwrite(with->style.text, 1, with->style.length, out);
        else if (!strcmp(name, "script"))
            fwrite(with->script.text, 1, with->script.length, out);
        else
            fwrite(page->text, 1, page->length, out);
        from = behind;
    }
    fputs(from, out);
}

void report_write_figures(FILE *out, const report_template *with, const char *title,
                          const char *json)
{
    text page;
    FILE *stream = memory_require(open_memstream(&page.text, &page.length));
    report_put_figures(stream, json);
    fclose(stream);
    write_layout(with, out, title, &page);
    free(page.text);
}

/* Where the template draws series and fields. */
static void write_along(report_page *page)
{
    fputs("<div class=\"chosen\" id=\"along\"></div>\n", page->out);
}

static void write_sections(report_page *page)
{
    static void (*const sections[])(report_page *) = {
        report_write_verdict, report_write_study,  write_along,
        report_write_quality, report_write_origin, report_write_data,
    };
    for (size_t i = 0; i < sizeof sections / sizeof *sections && !page->failed; i++)
        sections[i](page);
    if (page->thinned)
        fputs("<p class=\"note\">Long curves show the first, lowest, highest and last of each "
              "group of points; large maps and fields show fewer points than the results have. "
              "<code>flankfilm export</code> writes all numbers.</p>\n",
              page->out);
}

bool report_write(const results_view *view, const report_template *with, const char *const *best,
                  size_t best_count, const char *path, ff_report *report)
{
    text sections;
    report_sought *goals = memory_alloc((best_count + 1) * sizeof *goals);
    if (!report_read_sought(view, best, best_count, goals, report)) {
        free(goals);
        return false;
    }
    report_page page = {.view = view,
                        .goals = goals,
                        .goal_count = best_count,
                        .out = memory_require(open_memstream(&sections.text, &sections.length))};
    write_sections(&page);
    free(goals);
    fclose(page.out);
    FILE *out = fopen(path, "we");
    bool lost = !out;
    if (out) {
        write_layout(with, out, *view->title ? view->title : "flankfilm", &sections);
        errno = 0;
        lost = ferror(out) != 0;
        lost = fclose(out) != 0 || lost;
    }
    free(sections.text);
    if (lost && !page.failed)
        ff_error(report, FF_FAULT_RUN, FF_NOWHERE, NULL, "the page could not be written: %s",
                 strerror(errno ? errno : EIO));
    return !lost && !page.failed;
}
