/* SPDX-License-Identifier: MIT */
/* Prints messages for people: place, sentence, the line with a caret, and a hint. */
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "memory.h"
#include "text.h"

enum { MOST_PRINTED = 20, WINDOW = 90, LEAD = 40 };

/* The text being written. */
typedef struct printer {
    char *text;
    size_t length, room;
    bool colour;
} printer;

static const char BOLD[] = "\033[1m", RED[] = "\033[1;31m", YELLOW[] = "\033[1;33m",
                  PLAIN[] = "\033[0m";

static void add_bytes(printer *p, const char *bytes, size_t count)
{
    if (p->room - p->length <= count) {
        p->room = 2 * p->room + count + 1;
        p->text = fe_resize(p->text, p->room);
    }
    memcpy(p->text + p->length, bytes, count);
    p->length += count;
    p->text[p->length] = 0;
}

static void add(printer *p, const char *text)
{
    add_bytes(p, text, strlen(text));
}

__attribute__((format(printf, 2, 3))) static void add_formatted(printer *p, const char *format, ...)
{
    char text[64];
    va_list args;
    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    add(p, text);
}

static void paint(printer *p, const char *style)
{
    if (p->colour)
        add(p, style);
}

/* False for control characters and for marks that change the direction of writing. */
static bool is_printable(uint32_t c)
{
    bool control = c < 0x20 || (c >= 0x7F && c < 0xA0) || c == FE_NO_CHAR;
    bool turning = c == 0x200E || c == 0x200F || (c >= 0x2028 && c <= 0x202E) ||
                   (c >= 0x2066 && c <= 0x2069) || c == 0xFEFF;
    return !control && !turning;
}

/* Returns the terminal columns of a character: none for combining marks, two for East Asian
   characters. */
static int width_of(uint32_t c)
{
    if ((c >= 0x300 && c <= 0x36F) || (c >= 0x200B && c <= 0x200D))
        return 0;
    bool wide = (c >= 0x1100 && c <= 0x115F) || (c >= 0x2E80 && c <= 0xA4CF) ||
                (c >= 0xAC00 && c <= 0xD7A3) || (c >= 0xF900 && c <= 0xFAFF) ||
                (c >= 0xFF01 && c <= 0xFF60) || (c >= 0x1F300 && c <= 0x3FFFD);
    return wide ? 2 : 1;
}

/* Writes one character and returns its columns. A tab becomes one blank. */
static int print_char(printer *p, const char *at, size_t length, uint32_t code)
{
    if (is_printable(code)) {
        add_bytes(p, at, length);
        return width_of(code);
    }
    add(p, code == '\t' || code == '\n' ? " " : "?");
    return 1;
}

static void print_text(printer *p, const char *text)
{
    const char *end = text + strlen(text);
    uint32_t code;
    for (size_t n; text < end; text += n) {
        n = fe_char_read(text, end, &code);
        print_char(p, text, n, code);
    }
}

/* Prints the line, or the part of a long line near the place, and underlines the place. */
static void print_line(printer *p, const ff_place *place)
{
    const char *end, *at = fe_line_begin(place->source, place->line, &end);
    uint32_t first = place->column > LEAD + WINDOW / 2 ? place->column - LEAD : 1;
    uint32_t last = place->column + (place->width ? place->width - 1 : 0);
    int before = first > 1 ? 4 : 0, under = 0;
    uint32_t code;

    add_formatted(p, "%5u | %s", place->line, first > 1 ? "... " : "");
    for (uint32_t i = 1; i < first + WINDOW && at < end; i++) {
        size_t n = fe_char_read(at, end, &code);
        if (i >= first) {
            int columns = print_char(p, at, n, code);
            before += i < place->column ? columns : 0;
            under += i >= place->column && i <= last ? columns : 0;
        }
        at += n;
    }
    add(p, at < end ? " ...\n      | " : "\n      | ");
    for (int i = 0; i < before; i++)
        add(p, " ");
    paint(p, RED);
    for (int i = 0; i < under || i == 0; i++)
        add(p, "^");
    paint(p, PLAIN);
    add(p, "\n");
}

/* Prints a hint. A hint that begins with a line break has several lines, such as a text to be
   written instead. */
static void print_hint(printer *p, const char *hint)
{
    const char *end = hint + strlen(hint);
    bool lines = *hint == '\n';
    uint32_t code;
    add(p, lines ? "hint:" : "hint: ");
    for (size_t n; hint < end; hint += n) {
        n = fe_char_read(hint, end, &code);
        if (lines && code == '\n')
            add(p, "\n");
        else
            print_char(p, hint, n, code);
    }
    add(p, "\n");
}

static void print_message(printer *p, const ff_message *m)
{
    static const char *const names[] = {"error: ", "warning: "};
    const char *styles[] = {RED, YELLOW};
    const ff_place *place = &m->place;
    paint(p, BOLD);
    if (place->source) {
        print_text(p, place->source->name);
        if (place->line > 0)
            add_formatted(p, ":%u:%u", place->line, place->column);
        add(p, ": ");
    }
    paint(p, styles[m->severity]);
    add(p, names[m->severity]);
    paint(p, PLAIN);
    print_text(p, m->text);
    add(p, "\n");
    if (place->source && place->line > 0)
        print_line(p, place);
    if (m->hint)
        print_hint(p, m->hint);
}

typedef struct entry {
    const ff_message *message;
    size_t file; /* index of the first message about the same file; messages without a file come
                    last */
} entry;

static int compare(const void *a, const void *b)
{
    const entry *x = a, *y = b;
    const ff_place *p = &x->message->place, *q = &y->message->place;
    if (x->file != y->file)
        return x->file < y->file ? -1 : 1;
    if (p->line != q->line)
        return p->line < q->line ? -1 : 1;
    if (p->column != q->column)
        return p->column < q->column ? -1 : 1;
    /* messages at one place keep the order in which they were added */
    return x->message < y->message ? -1 : x->message > y->message;
}

static size_t file_of(const ff_report *report, const ff_source *source)
{
    size_t first = 0;
    while (source && ff_report_at(report, first)->place.source != source)
        first++;
    return source ? first : SIZE_MAX;
}

char *ff_report_text(const ff_report *report, bool colour)
{
    printer p = {.text = fe_copy_text("", 0), .room = 1, .colour = colour};
    size_t count = ff_report_count(report), printed = 0, errors = ff_report_errors(report);
    entry *entries = fe_alloc(count * sizeof *entries);
    for (size_t i = 0; i < count; i++) {
        const ff_message *m = ff_report_at(report, i);
        entries[i] = (entry){m, file_of(report, m->place.source)};
    }
    qsort(entries, count, sizeof *entries, compare);
    for (size_t i = 0; i < count; i++) {
        const ff_message *m = entries[i].message;
        if (m->severity != FF_ERROR || printed++ < MOST_PRINTED)
            print_message(&p, m);
    }
    fe_free(entries);
    if (errors > MOST_PRINTED)
        add_formatted(&p, "... and %zu more errors\n", errors - MOST_PRINTED);
    return p.text;
}

void ff_message_print(const ff_message *m, char *out, size_t size)
{
    const ff_place *place = &m->place;
    const char *name = place->source ? place->source->name : "";
    if (place->line > 0)
        snprintf(out, size, "%s:%u:%u: %s", name, place->line, place->column, m->text);
    else
        snprintf(out, size, "%s%s%s", name, *name ? ": " : "", m->text);
}
