/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "report.h"

#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include "memory.h"

/* Nobody reads more, and a file full of mistakes must not cost quadratic time. */
enum { MOST_KEPT = 1000 };

struct fe_report {
    fe_heap *heap; /* of its messages */
    fe_message *messages;
    size_t count;
    size_t errors; /* with those beyond MOST_KEPT */
    int exit_code;
    fe_source **sources; /* copies of temporary ones */
    size_t source_count;
};

fe_report *fe_report_new(void)
{
    fe_report *report = fe_alloc(sizeof *report);
    report->heap = fe_heap_in_use();
    return report;
}

void fe_report_free(fe_report *report)
{
    if (!report)
        return;
    for (size_t i = 0; i < report->count; i++) {
        fe_free(report->messages[i].text);
        fe_free(report->messages[i].hint);
    }
    for (size_t i = 0; i < report->source_count; i++) {
        fe_free(report->sources[i]->name);
        fe_free(report->sources[i]->text);
        fe_free(report->sources[i]->directory);
        fe_free(report->sources[i]);
    }
    fe_free(report->sources);
    fe_free(report->messages);
    fe_free(report);
}

/* The report's own copy of a temporary source. */
static const fe_source *keep_source(fe_report *report, const fe_source *source)
{
    for (size_t i = 0; i < report->source_count; i++) {
        const fe_source *own = report->sources[i];
        if (own == source || (own->length == source->length && !strcmp(own->name, source->name) &&
                              !memcmp(own->text, source->text, own->length)))
            return own;
    }
    report->sources =
        fe_resize(report->sources, (report->source_count + 1) * sizeof *report->sources);
    fe_source *own = fe_alloc(sizeof *own);
    *own = (fe_source){.name = fe_copy_text(source->name, strlen(source->name)),
                       .text = fe_copy_text(source->text, source->length),
                       .length = source->length,
                       .directory = fe_copy_text(source->directory, strlen(source->directory)),
                       .temporary = true};
    return report->sources[report->source_count++] = own;
}

static bool is_known(const fe_report *report, const fe_message *message)
{
    const fe_place *place = &message->place;
    for (size_t i = 0; i < report->count; i++) {
        const fe_message *m = &report->messages[i];
        if (m->place.source == place->source && m->place.line == place->line &&
            m->place.column == place->column && m->severity == message->severity &&
            !strcmp(m->text, message->text))
            return true;
    }
    return false;
}

static int gravity(int exit_code)
{
    static const int order[] = {FE_EXIT_OK, FE_EXIT_CASES, FE_EXIT_FAILED, FE_EXIT_INPUT,
                                FE_EXIT_PLUGIN};
    int rank = 0;
    while (order[rank] != exit_code && order[rank] != FE_EXIT_PLUGIN)
        rank++;
    return rank;
}

/* Takes over the message's texts. */
static void add(fe_report *report, fe_message message)
{
    if (message.place.source && message.place.source->temporary)
        message.place.source = keep_source(report, message.place.source);
    bool known = is_known(report, &message);
    if (!known && message.severity == FE_ERROR) {
        report->errors++;
        if (gravity(message.exit_code) > gravity(report->exit_code))
            report->exit_code = message.exit_code;
    }
    /* warnings leave room for errors */
    size_t room = message.severity == FE_ERROR ? MOST_KEPT : MOST_KEPT / 2;
    if (known || report->count >= room) {
        fe_free(message.text);
        fe_free(message.hint);
        return;
    }
    report->messages = fe_resize(report->messages, (report->count + 1) * sizeof *report->messages);
    report->messages[report->count++] = message;
}

bool fe_error(fe_report *report, int exit_code, fe_place place, const char *hint,
              const char *format, ...)
{
    va_list args;
    fe_heap *before = fe_heap_use(report->heap);
    va_start(args, format);
    add(report, (fe_message){.severity = FE_ERROR,
                             .exit_code = exit_code,
                             .place = place,
                             .text = fe_print_list(format, args),
                             .hint = hint ? fe_copy_text(hint, strlen(hint)) : NULL});
    va_end(args);
    fe_heap_use(before);
    return false;
}

void fe_warn(fe_report *report, fe_place place, const char *format, ...)
{
    va_list args;
    fe_heap *before = fe_heap_use(report->heap);
    va_start(args, format);
    add(report,
        (fe_message){.severity = FE_WARNING, .place = place, .text = fe_print_list(format, args)});
    va_end(args);
    fe_heap_use(before);
}

size_t fe_report_count(const fe_report *report)
{
    return report->count;
}

const fe_message *fe_report_at(const fe_report *report, size_t index)
{
    return &report->messages[index];
}

const fe_message *fe_report_first(const fe_report *report)
{
    for (size_t i = 0; i < report->count; i++)
        if (report->messages[i].severity == FE_ERROR)
            return &report->messages[i];
    return NULL;
}

size_t fe_report_errors(const fe_report *report)
{
    return report->errors;
}

int fe_report_exit_code(const fe_report *report)
{
    return report->exit_code;
}
