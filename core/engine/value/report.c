/* SPDX-License-Identifier: MIT */
#include "report.h"

#include <assert.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include "memory.h"

/* More messages are of no use to a reader, and a file full of errors must not cost quadratic
   time. */
enum { MOST_KEPT = 1000 };

struct ff_report {
    fe_heap *heap; /* memory of its messages */
    ff_message *messages;
    size_t count;
    size_t errors; /* number of errors, including those beyond MOST_KEPT */
    int fault;
    bool lacked_memory;
    ff_source **sources; /* copies of temporary sources */
    size_t source_count;
};

ff_report *ff_report_new(void)
{
    ff_report *report = fe_alloc(sizeof *report);
    report->heap = fe_heap_in_use();
    return report;
}

void ff_report_free(ff_report *report)
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

/* Whether both sources have the same text. A source may be read twice: for a file, and for a case
   of its study. */
static bool same_source(const ff_source *a, const ff_source *b)
{
    return a == b || (a && b && a->length == b->length && !strcmp(a->name, b->name) &&
                      !memcmp(a->text, b->text, a->length));
}

/* Returns the report's copy of a temporary source. */
static const ff_source *keep_source(ff_report *report, const ff_source *source)
{
    for (size_t i = 0; i < report->source_count; i++) {
        const ff_source *copy = report->sources[i];
        if (same_source(copy, source))
            return copy;
    }
    report->sources =
        fe_resize(report->sources, (report->source_count + 1) * sizeof *report->sources);
    ff_source *copy = fe_alloc(sizeof *copy);
    *copy = (ff_source){.name = fe_copy_text(source->name, strlen(source->name)),
                        .text = fe_copy_text(source->text, source->length),
                        .length = source->length,
                        .directory = fe_copy_text(source->directory, strlen(source->directory)),
                        .temporary = true};
    return report->sources[report->source_count++] = copy;
}

static bool is_known(const ff_report *report, const ff_message *message)
{
    const ff_place *place = &message->place;
    for (size_t i = 0; i < report->count; i++) {
        const ff_message *m = &report->messages[i];
        if (m->place.line == place->line && m->place.column == place->column &&
            m->severity == message->severity && !strcmp(m->text, message->text) &&
            same_source(m->place.source, place->source))
            return true;
    }
    return false;
}

/* Adds a message and takes ownership of its texts. */
static void add(ff_report *report, ff_message message)
{
    if (message.place.source && message.place.source->temporary)
        message.place.source = keep_source(report, message.place.source);
    bool known = is_known(report, &message);
    if (!known && message.severity == FF_ERROR) {
        report->errors++;
        if (message.fault > report->fault)
            report->fault = message.fault;
    }
    /* warnings leave room for errors */
    size_t room = message.severity == FF_ERROR ? MOST_KEPT : MOST_KEPT / 2;
    if (known || report->count >= room) {
        fe_free(message.text);
        fe_free(message.hint);
        return;
    }
    report->messages = fe_resize(report->messages, (report->count + 1) * sizeof *report->messages);
    report->messages[report->count++] = message;
}

bool ff_error(ff_report *report, int fault, ff_place place, const char *hint, const char *format,
              ...)
{
    va_list args;
    fe_heap *before = fe_heap_use(report->heap);
    va_start(args, format);
    add(report, (ff_message){.severity = FF_ERROR,
                             .fault = fault,
                             .place = place,
                             .text = fe_print_list(format, args),
                             .hint = hint ? fe_copy_text(hint, strlen(hint)) : NULL});
    va_end(args);
    fe_heap_use(before);
    return false;
}

bool fe_report_beyond(ff_report *report, ff_place place, const char *text)
{
    fe_heap *before = fe_heap_use(report->heap);
    add(report, (ff_message){.severity = FF_ERROR,
                             .fault = FF_FAULT_INPUT,
                             .place = place,
                             .text = fe_copy_text(text, strlen(text)),
                             .beyond = true});
    fe_heap_use(before);
    return false;
}

void ff_warn(ff_report *report, ff_place place, const char *format, ...)
{
    va_list args;
    fe_heap *before = fe_heap_use(report->heap);
    va_start(args, format);
    add(report,
        (ff_message){.severity = FF_WARNING, .place = place, .text = fe_print_list(format, args)});
    va_end(args);
    fe_heap_use(before);
}

void ff_report_append(ff_report *report, const ff_report *other)
{
    report->lacked_memory = report->lacked_memory || other->lacked_memory;
    for (size_t i = 0; i < other->count; i++) {
        const ff_message *m = &other->messages[i];
        if (m->beyond)
            fe_report_beyond(report, m->place, m->text);
        else if (m->severity == FF_ERROR)
            ff_error(report, m->fault, m->place, m->hint, "%s", m->text);
        else
            ff_warn(report, m->place, "%s", m->text);
    }
}

size_t ff_report_count(const ff_report *report)
{
    return report->count;
}

const ff_message *ff_report_at(const ff_report *report, size_t index)
{
    assert(index < report->count);
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

void fe_report_note_no_memory(ff_report *report)
{
    report->lacked_memory = true;
}

bool fe_report_lacked_memory(const ff_report *report)
{
    return report->lacked_memory;
}

int ff_report_fault(const ff_report *report)
{
    return report->fault;
}
