/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "report.h"

#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include "memory.h"

/* Nobody reads more; a file made of mistakes must not cost quadratic time. */
enum { MOST_KEPT = 1000 };

struct ff_report {
    ff_message *messages;
    size_t count;
    size_t errors; /* with those beyond MOST_KEPT */
    int exit_code;
    ff_source **sources; /* copies of brief ones */
    size_t source_count;
};

ff_report *ff_report_new(void)
{
    return ff_alloc(sizeof(ff_report));
}

void ff_report_free(ff_report *report)
{
    if (!report)
        return;
    for (size_t i = 0; i < report->count; i++) {
        free(report->messages[i].text);
        free(report->messages[i].hint);
    }
    for (size_t i = 0; i < report->source_count; i++) {
        free(report->sources[i]->name);
        free(report->sources[i]->text);
        free(report->sources[i]->directory);
        free(report->sources[i]);
    }
    free(report->sources);
    free(report->messages);
    free(report);
}

/* The report's own copy of a brief source. */
static const ff_source *keep_source(ff_report *report, const ff_source *source)
{
    for (size_t i = 0; i < report->source_count; i++) {
        const ff_source *own = report->sources[i];
        if (own == source || (own->length == source->length && !strcmp(own->name, source->name) &&
                              !memcmp(own->text, source->text, own->length)))
            return own;
    }
    ff_source *own = ff_alloc(sizeof *own);
    *own = (ff_source){.name = ff_copy_text(source->name, strlen(source->name)),
                       .text = ff_copy_text(source->text, source->length),
                       .length = source->length,
                       .directory = ff_copy_text(source->directory, strlen(source->directory)),
                       .brief = true};
    report->sources = ff_resize(report->sources, (report->source_count + 1) * sizeof own);
    return report->sources[report->source_count++] = own;
}

static bool is_known(const ff_report *report, const ff_message *message)
{
    const ff_place *place = &message->place;
    for (size_t i = 0; i < report->count; i++) {
        const ff_message *m = &report->messages[i];
        if (m->place.source == place->source && m->place.line == place->line &&
            m->place.column == place->column && m->severity == message->severity &&
            !strcmp(m->text, message->text))
            return true;
    }
    return false;
}

static int gravity(int exit_code)
{
    static const int order[] = {FF_EXIT_OK, FF_EXIT_CASES, FF_EXIT_FAILED, FF_EXIT_INPUT,
                                FF_EXIT_PLUGIN};
    int rank = 0;
    while (order[rank] != exit_code && order[rank] != FF_EXIT_PLUGIN)
        rank++;
    return rank;
}

/* Takes over the message's texts. */
static void add(ff_report *report, ff_message message)
{
    if (message.place.source && message.place.source->brief)
        message.place.source = keep_source(report, message.place.source);
    bool known = is_known(report, &message);
    if (!known && message.severity == FF_ERROR) {
        report->errors++;
        if (gravity(message.exit_code) > gravity(report->exit_code))
            report->exit_code = message.exit_code;
    }
    /* warnings leave room for errors */
    size_t room = message.severity == FF_ERROR ? MOST_KEPT : MOST_KEPT / 2;
    if (known || report->count >= room) {
        free(message.text);
        free(message.hint);
        return;
    }
    report->messages = ff_resize(report->messages, (report->count + 1) * sizeof *report->messages);
    report->messages[report->count++] = message;
}

static char *print(const char *format, va_list args)
{
    char *text = NULL;
    return vasprintf(&text, format, args) < 0 ? ff_copy_text("", 0) : text;
}

bool ff_error(ff_report *report, int exit_code, ff_place place, const char *hint,
              const char *format, ...)
{
    va_list args;
    va_start(args, format);
    add(report, (ff_message){.severity = FF_ERROR,
                             .exit_code = exit_code,
                             .place = place,
                             .text = print(format, args),
                             .hint = hint ? ff_copy_text(hint, strlen(hint)) : NULL});
    va_end(args);
    return false;
}

void ff_warn(ff_report *report, ff_place place, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    add(report, (ff_message){.severity = FF_WARNING, .place = place, .text = print(format, args)});
    va_end(args);
}

size_t ff_report_count(const ff_report *report)
{
    return report->count;
}

const ff_message *ff_report_at(const ff_report *report, size_t index)
{
    return &report->messages[index];
}

const ff_message *ff_report_first(const ff_report *report)
{
    for (size_t i = 0; i < report->count; i++)
        if (report->messages[i].severity == FF_ERROR)
            return &report->messages[i];
    return NULL;
}

size_t ff_report_errors(const ff_report *report)
{
    return report->errors;
}

int ff_report_exit_code(const ff_report *report)
{
    return report->exit_code;
}
