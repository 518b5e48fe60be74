/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "page.h"

#include <stdarg.h>
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

void report_print(FILE *out, const char *html, ...)
{
    va_list texts;
    va_start(texts, html);
    for (const char *hole; (hole = strstr(html, "%s")); html = hole + 2) {
        fwrite(html, 1, (size_t)(hole - html), out);
        report_put_text(out, va_arg(texts, const char *));
    }
    va_end(texts);
    fputs(html, out);
}
