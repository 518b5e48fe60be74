/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "status.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef const char *(*text_of)(const ff_view_case *c);

static const char *reason_of(const ff_view_case *c)
{
    return c->reason;
}

static const char *command_of(const ff_view_case *c)
{
    return c->command;
}

static const char *reasons_of(const ff_view_case *c)
{
    return FF_HAS(c, reasons) && c->reasons ? c->reasons : "";
}

static size_t longest_text(const ff_view *view, text_of text)
{
    size_t longest = 0;
    for (size_t c = 0; c < view->case_count; c++) {
        size_t length = strlen(text(view->cases[c]));
        longest = length > longest ? length : longest;
    }
    return longest;
}

static const char *const verdicts[] = {"good", "doubtful", "bad", "failed"};
enum { VERDICTS = sizeof verdicts / sizeof *verdicts };

/* The number of a verdict; -1 for a case that has not run. */
static signed char verdict_of(const ff_view_case *c)
{
    for (signed char i = 0; FF_HAS(c, verdict) && c->verdict && i < VERDICTS; i++)
        if (!strcmp(verdicts[i], c->verdict))
            return i;
    return -1;
}

static void define_verdict(writer_nc_file *f, int rank)
{
    static const signed char values[] = {-1, 0, 1, 2, 3};
    f->case_verdict = writer_nc_define_numbers(f, "verdict", NC_BYTE, f->study, rank);
    writer_nc_text(f, f->case_verdict, "long_name", "how far the case can be trusted");
    writer_nc_text(f, f->case_verdict, "flag_meanings", "none good doubtful bad failed");
    if (f->status == FF_OK)
        writer_nc_good(f, nc_put_att_schar(f->nc, f->case_verdict, "flag_values", NC_BYTE,
                                           VERDICTS + 1, values));
    f->reasons = -1;
    size_t longest = longest_text(f->view, reasons_of);
    if (!longest)
        return;
    f->reasons = writer_nc_define_texts(f, "reasons", f->study, rank, longest);
    writer_nc_text(f, f->reasons, "long_name", "the checks that are not good, the worst first");
}

static size_t find_state(const writer_nc_file *f, const char *status)
{
    size_t i = 0;
    while (i < f->state_count && strcmp(f->states[i], status) != 0)
        i++;
    return i;
}

/* Lists how the cases end; ways for which there is no room count as the last one. */
void writer_nc_find_states(writer_nc_file *f)
{
    f->states[f->state_count++] = "ok";
    for (size_t c = 0; c < f->view->case_count; c++)
        if (find_state(f, f->view->cases[c]->status) == f->state_count &&
            f->state_count < WRITER_NC_STATES)
            f->states[f->state_count++] = f->view->cases[c]->status;
}

void writer_nc_define_status(writer_nc_file *f)
{
    signed char values[WRITER_NC_STATES];
    char meanings[1000] = "";
    size_t count = f->state_count, length = 0;
    int rank = (int)f->view->dimension_count;
    for (size_t i = 0; i < count && length < sizeof meanings; i++) {
        values[i] = (signed char)i;
        size_t from = length;
        length += (size_t)snprintf(meanings + length, sizeof meanings - length, "%s%s",
                                   i ? " " : "", f->states[i]);
        for (size_t k = from + (i > 0); k < length && k < sizeof meanings; k++)
            if (meanings[k] == ' ')
                meanings[k] = '_';
    }
    f->case_status = writer_nc_define_numbers(f, "status", NC_BYTE, f->study, rank);
    writer_nc_text(f, f->case_status, "long_name", "how the case ended");
    writer_nc_text(f, f->case_status, "flag_meanings", meanings);
    if (f->status == FF_OK)
        writer_nc_good(
            f, nc_put_att_schar(f->nc, f->case_status, "flag_values", NC_BYTE, count, values));
    f->seconds = writer_nc_define_numbers(f, "seconds", NC_DOUBLE, f->study, rank);
    writer_nc_text(f, f->seconds, "long_name", "time that the case took");
    define_verdict(f, rank);
    f->reason = f->command = -1;
    if (!longest_text(f->view, reason_of))
        return;
    f->reason =
        writer_nc_define_texts(f, "reason", f->study, rank, longest_text(f->view, reason_of));
    writer_nc_text(f, f->reason, "long_name", "why the case failed");
    f->command =
        writer_nc_define_texts(f, "command", f->study, rank, longest_text(f->view, command_of));
    writer_nc_text(f, f->command, "long_name", "runs the case again, alone");
}

static bool same_line(const ff_view_quality *a, const ff_view_quality *b)
{
    return a->stage == b->stage && !strcmp(a->name, b->name);
}

/* Lists each quality line that some case has once. */
bool writer_nc_find_lines(writer_nc_file *f)
{
    const ff_view *view = f->view;
    size_t most = 0;
    for (size_t c = 0; c < view->case_count; c++)
        for (size_t i = 0; i < view->cases[c]->quality_count; i++) {
            size_t k = 0;
            while (k < f->line_count && !same_line(f->lines[k], view->cases[c]->quality[i]))
                k++;
            if (k < f->line_count)
                continue;
            if (k == most) {
                most = 2 * most + 16;
                const ff_view_quality **grown = realloc(f->lines, most * sizeof *f->lines);
                if (!grown)
                    return false;
                f->lines = grown;
            }
            f->lines[f->line_count++] = view->cases[c]->quality[i];
        }
    f->quality = calloc(f->line_count + 1, sizeof *f->quality);
    f->verdicts = calloc(f->line_count + 1, sizeof *f->verdicts);
    return f->quality && f->verdicts;
}

void writer_nc_define_quality(writer_nc_file *f)
{
    static const signed char values[] = {-1, FF_GOOD, FF_DOUBTFUL, FF_BAD};
    const double none = NAN;
    int rank = (int)f->view->dimension_count;
    for (size_t k = 0; k < f->line_count && f->status == FF_OK; k++) {
        const ff_view_quality *line = f->lines[k];
        char name[WRITER_NC_LONGEST];
        snprintf(name, 200, "%s.quality.%s", f->view->stages[line->stage]->name, line->name);
        for (char *at = name; *at; at++)
            if (strchr(" /()[]{}\"'\\", *at) || (unsigned char)*at < 32)
                *at = '_';
        f->quality[k] = writer_nc_define_numbers(f, name, NC_DOUBLE, f->study, rank);
        writer_nc_good(f, nc_def_var_fill(f->nc, f->quality[k], NC_FILL, &none));
        writer_nc_text(f, f->quality[k], "long_name", line->name);
        writer_nc_text(f, f->quality[k], "comment", line->text);
        if (isfinite(line->limit))
            writer_nc_good(
                f, nc_put_att_double(f->nc, f->quality[k], "limit", NC_DOUBLE, 1, &line->limit));
        strcat(name, ".verdict");
        writer_nc_text(f, f->quality[k], "ancillary_variables", name);
        f->verdicts[k] = writer_nc_define_numbers(f, name, NC_BYTE, f->study, rank);
        writer_nc_text(f, f->verdicts[k], "flag_meanings", "none good doubtful bad");
        if (f->status == FF_OK)
            writer_nc_good(
                f, nc_put_att_schar(f->nc, f->verdicts[k], "flag_values", NC_BYTE, 4, values));
    }
}

static void write_text(writer_nc_file *f, size_t index, int id, const char *text)
{
    const size_t length = strlen(text);
    writer_nc_slab s;
    if (id < 0 || !length || f->status != FF_OK)
        return;
    writer_nc_place(f, index, 1, &length, &s);
    writer_nc_good(f, nc_put_vara_text(f->nc, id, s.start, s.count, text));
}

void writer_nc_write_status(writer_nc_file *f, size_t index, const writer_nc_slab *at)
{
    const ff_view_case *c = f->view->cases[index];
    const size_t state = find_state(f, c->status);
    const signed char byte = (signed char)(state < f->state_count ? state : f->state_count - 1);
    writer_nc_good(f, nc_put_vara_schar(f->nc, f->case_status, at->start, at->count, &byte));
    writer_nc_good(f, nc_put_vara_double(f->nc, f->seconds, at->start, at->count, &c->seconds));
    const signed char verdict = verdict_of(c);
    writer_nc_good(f, nc_put_vara_schar(f->nc, f->case_verdict, at->start, at->count, &verdict));
    write_text(f, index, f->reasons, reasons_of(c));
    write_text(f, index, f->reason, c->reason);
    write_text(f, index, f->command, c->command);
}

void writer_nc_write_quality(writer_nc_file *f, size_t index, const writer_nc_slab *at)
{
    const ff_view_case *c = f->view->cases[index];
    for (size_t k = 0; k < f->line_count && f->status == FF_OK; k++) {
        signed char verdict = -1;
        double value = NAN;
        for (size_t i = 0; i < c->quality_count; i++)
            if (same_line(f->lines[k], c->quality[i])) {
                verdict = (signed char)c->quality[i]->verdict;
                value = c->quality[i]->value;
            }
        writer_nc_good(f, nc_put_vara_double(f->nc, f->quality[k], at->start, at->count, &value));
        writer_nc_good(f, nc_put_vara_schar(f->nc, f->verdicts[k], at->start, at->count, &verdict));
    }
}
