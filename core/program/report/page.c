/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "page.h"

#include "../memory/memory.h"

#include <stdlib.h>
#include <string.h>

void report_put_text(FILE *out, const char *text)
{
    for (; *text; text++)
        switch (*text) {
        case '<':
            fputs("&lt;", out);
            break;
        case '>':
            fputs("&gt;", out);
            break;
        case '&':
            fputs("&amp;", out);
            break;
        case '"':
            fputs("&quot;", out);
            break;
        case '\'':
            fputs("&#39;", out);
            break;
        default:
            fputc((unsigned char)*text < 32 && *text != '\n' ? ' ' : *text, out);
        }
}

void report_put_cell(FILE *out, const char *text)
{
    fputs("<td>", out);
    report_put_text(out, text);
    fputs("</td>", out);
}

void report_put_badge(FILE *out, const char *verdict)
{
    const char *colour = strcmp(verdict, "failed") != 0 ? verdict : "bad";
    if (*verdict)
        fprintf(out, "<span class=\"badge %s\">%s</span>", colour, verdict);
}

void report_part_begin(report_page *page, report_part *part)
{
    *part = (report_part){.page = page->out, .figures = page->figures};
    page->out = memory_require(open_memstream(&part->text, &part->size));
}

void report_part_end(report_page *page, report_part *part)
{
    fclose(page->out);
    if (page->figures > part->figures)
        fwrite(part->text, 1, part->size, part->page);
    free(part->text);
    page->out = part->page;
}
