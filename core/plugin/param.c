/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "param.h"

#include "../value/memory.h"

#include <errno.h>
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* What one reading works on. */
typedef struct reading {
    const ff_param *row;
    const ff_unit *unit;
    const char *name;
    ff_report *report;
} reading;

bool ff_word_at(const char *words, size_t rank, char *out, size_t size)
{
    const char *at = words;
    while (at && rank > 0) {
        at = strchr(at, '|');
        at = at ? at + 1 : NULL;
        rank--;
    }
    if (!at)
        return false;
    snprintf(out, size, "%.*s", (int)strcspn(at, "|"), at);
    return true;
}

int ff_word_find(const char *words, const char *word)
{
    int rank = 0;
    for (const char *at = words; at; rank++) {
        size_t length = strcspn(at, "|");
        if (strlen(word) == length && !strncmp(at, word, length))
            return rank;
        at = at[length] ? at + length + 1 : NULL;
    }
    return -1;
}

static void join_words(const char *words, char *out, size_t size)
{
    char word[64];
    size_t used = 0;
    out[0] = 0;
    for (size_t i = 0; used < size && ff_word_at(words, i, word, sizeof word); i++)
        used += (size_t)snprintf(out + used, size - used, "%s\"%s\"", i ? ", " : "", word);
}

void ff_param_expectation(const ff_param *row, char *out, size_t size)
{
    static const char *const plain[] = {[FF_INT] = "a whole number",
                                        [FF_BOOL] = "true or false",
                                        [FF_CHOICE] = "one of ",
                                        [FF_TEXT] = "a text",
                                        [FF_FILE] = "the name of a file"};
    char words[512] = "";
    bool bare = !row->unit[0] || !strcmp(row->unit, "1");
    if (row->choices)
        join_words(row->choices, words, sizeof words);
    const char *join = row->choices && row->type != FF_CHOICE ? " or " : "";
    if (row->type == FF_REALS && bare)
        snprintf(out, size, "a list of %snumbers", row->flags & FF_WHOLE ? "whole " : "");
    else if (row->type == FF_REALS)
        snprintf(out, size, "a list of numbers with units such as [3 %s, 4 %s]", row->unit,
                 row->unit);
    else if (row->type == FF_REAL && bare)
        snprintf(out, size, "a number%s%s", join, words);
    else if (row->type == FF_REAL)
        snprintf(out, size, "a number with a unit such as \"3 %s\"%s%s", row->unit, join, words);
    else
        snprintf(out, size, "%s%s%s", plain[row->type], join, words);
}

static bool refuse(const reading *r, const ff_node *node, const char *text)
{
    return ff_error(r->report, FF_EXIT_INPUT, node->place, NULL, "%s: %s", r->name, text);
}

/* "expected ..., found a list", for a node of the wrong kind and for words that are none. */
static bool refuse_kind(const reading *r, const ff_node *node)
{
    char wanted[640], hint[128] = "";
    ff_param_expectation(r->row, wanted, sizeof wanted);
    if (node->kind != FF_SCALAR)
        return ff_error(r->report, FF_EXIT_INPUT, node->place, NULL, "%s: expected %s, found %s",
                        r->name, wanted, ff_kind_name(node->kind));
    if (!node->text[0])
        return ff_error(r->report, FF_EXIT_INPUT, node->place, NULL,
                        "%s: expected %s, found nothing", r->name, wanted);
    if (r->row->choices) {
        char words[32][64];
        const char *list[32];
        size_t count = 0;
        while (count < 32 && ff_word_at(r->row->choices, count, words[count], sizeof words[0])) {
            list[count] = words[count];
            count++;
        }
        const char *near = ff_nearest(node->text, list, count);
        if (near)
            snprintf(hint, sizeof hint, "did you mean \"%s\"?", near);
    }
    return ff_error(r->report, FF_EXIT_INPUT, node->place, hint[0] ? hint : NULL,
                    "%s: expected %s, found \"%.80s\"", r->name, wanted, node->text);
}

/* A limit in SI and whether the value meets it but for the rounding of its unit. */
static bool meets(const reading *r, double si, double limit, double *limit_si)
{
    *limit_si = ff_unit_to_si(r->unit, limit);
    return si == *limit_si || fabs(si - *limit_si) <= 4 * DBL_EPSILON * fabs(*limit_si);
}

static void print(const reading *r, double si, char out[80])
{
    ff_quantity_print(si, r->unit, r->row->unit, out, 80);
}

/* Refuses what is outside the physical limits; what meets a closed limit is set onto it. */
static bool check_limits(const reading *r, const ff_node *node, double *si)
{
    const ff_param *row = r->row;
    char value[80], limit[80];
    double min = 0, max = 0;
    if (!(row->min < row->max))
        return true;
    bool at_min = isfinite(row->min) && meets(r, *si, row->min, &min);
    bool at_max = isfinite(row->max) && meets(r, *si, row->max, &max);
    if (at_min && !(row->flags & FF_MIN_OPEN))
        *si = min;
    else if (at_max && !(row->flags & FF_MAX_OPEN))
        *si = max;
    else if (isfinite(row->min) && (at_min || *si < min)) {
        print(r, *si, value);
        print(r, min, limit);
        return ff_error(r->report, FF_EXIT_INPUT, node->place, NULL,
                        "%s: %s is too small; it must be %s %s", r->name, value,
                        row->flags & FF_MIN_OPEN ? "above" : "at least", limit);
    } else if (isfinite(row->max) && (at_max || *si > max)) {
        print(r, *si, value);
        print(r, max, limit);
        return ff_error(r->report, FF_EXIT_INPUT, node->place, NULL,
                        "%s: %s is too large; it must be %s %s", r->name, value,
                        row->flags & FF_MAX_OPEN ? "below" : "at most", limit);
    }
    return true;
}

static void check_calibration(const reading *r, const ff_node *node, double si)
{
    const ff_param *row = r->row;
    char value[80], limit[80];
    double end = 0;
    if (!(row->low < row->high))
        return;
    bool under = isfinite(row->low) && !meets(r, si, row->low, &end) && si < end;
    bool over = !under && isfinite(row->high) && !meets(r, si, row->high, &end) && si > end;
    if (!under && !over)
        return;
    print(r, si, value);
    print(r, end, limit);
    ff_warn(r->report, node->place, "%s: %s is outside the calibrated range, which %s at %s",
            r->name, value, under ? "begins" : "ends", limit);
}

static bool read_real(const reading *r, const ff_node *node, double *si)
{
    char why[512];
    if (node->kind != FF_SCALAR || !node->text[0])
        return refuse_kind(r, node);
    if (!ff_quantity_parse(node->text, r->unit, r->row->unit, si, why, sizeof why))
        return refuse(r, node, why);
    if (!check_limits(r, node, si))
        return false;
    check_calibration(r, node, *si);
    return true;
}

static bool read_integer(const reading *r, const ff_node *node, int64_t *integer)
{
    char why[512];
    if (!ff_integer_parse(node->text, integer, why, sizeof why))
        return refuse(r, node, why);
    double number = (double)*integer;
    if (!check_limits(r, node, &number))
        return false;
    check_calibration(r, node, number);
    return true;
}

/* A word that the row accepts; for a choice there is nothing else. */
static bool read_word(const reading *r, const ff_node *node, ff_value *value)
{
    int rank = ff_word_find(r->row->choices, node->text);
    if (rank < 0)
        return false;
    value->integer = rank;
    value->text = ff_print_text("%s", node->text);
    return true;
}

static bool read_boolean(const reading *r, const ff_node *node, ff_value *value)
{
    static const char yes[] = "true|True|TRUE", no[] = "false|False|FALSE";
    value->integer = ff_word_find(yes, node->text) >= 0;
    return value->integer || ff_word_find(no, node->text) >= 0 || refuse_kind(r, node);
}

static bool check_length(const reading *r, const ff_node *node, size_t count)
{
    const ff_param *row = r->row;
    uint32_t most = row->max_count ? row->max_count : UINT32_MAX;
    char wanted[64];
    if (count >= row->min_count && count <= most)
        return true;
    if (row->min_count == most)
        snprintf(wanted, sizeof wanted, "%u", most);
    else if (row->max_count && row->min_count)
        snprintf(wanted, sizeof wanted, "%u to %u", row->min_count, most);
    else
        snprintf(wanted, sizeof wanted, "at %s %u", row->max_count ? "most" : "least",
                 row->max_count ? most : row->min_count);
    return ff_error(r->report, FF_EXIT_INPUT, node->place, NULL,
                    "%s: expected %s numbers, found %zu", r->name, wanted, count);
}

static bool read_reals(const reading *r, const ff_node *node, ff_value *value)
{
    if (node->kind == FF_MAP || (node->kind == FF_SCALAR && !node->text[0]))
        return refuse_kind(r, node);
    size_t count = node->kind == FF_SEQUENCE ? node->count : 1;
    if (!check_length(r, node, count))
        return false;
    double *reals = ff_alloc(count * sizeof *reals);
    bool good = true;
    value->reals = reals;
    value->count = count;
    for (size_t i = 0; i < count; i++) {
        const ff_node *item = node->kind == FF_SEQUENCE ? node->items[i] : node;
        if (!read_real(r, item, &reals[i]))
            good = false;
        else if ((r->row->flags & FF_WHOLE) && reals[i] != floor(reals[i]))
            good = ff_error(r->report, FF_EXIT_INPUT, item->place, NULL,
                            "%s: \"%.80s\" is not a whole number", r->name, item->text);
        else if (good && i > 0 && (r->row->flags & FF_INCREASING) && reals[i] < reals[i - 1])
            good = ff_error(r->report, FF_EXIT_INPUT, item->place, NULL,
                            "%s: the numbers must not decrease, but \"%.80s\" follows a larger one",
                            r->name, item->text);
    }
    return good;
}

/* A relative name is looked for beside the text that named it. */
static bool read_file(const reading *r, const ff_node *node, ff_value *value)
{
    const ff_source *source = node->place.source;
    const char *beside = source && source->directory ? source->directory : ".";
    struct stat status;
    char *path = node->text[0] == '/' ? ff_print_text("%s", node->text)
                                      : ff_print_text("%s/%s", beside, node->text);
    const char *why = NULL;
    value->text = path;
    if (stat(path, &status) != 0)
        why = strerror(errno);
    else if (!S_ISREG(status.st_mode))
        why = "it is no regular file";
    else if (access(path, R_OK) != 0)
        why = strerror(errno);
    return !why || ff_error(r->report, FF_EXIT_INPUT, node->place, NULL,
                            "%s: the file \"%s\" cannot be read: %s", r->name, path, why);
}

static bool read_scalar(const reading *r, const ff_node *node, ff_value *value)
{
    bool numeric = r->row->type == FF_REAL || r->row->type == FF_INT;
    double ignored;
    const char *end;
    if (node->kind != FF_SCALAR || (!node->text[0] && !(r->row->type == FF_TEXT && node->quoted)))
        return refuse_kind(r, node);
    if (r->row->choices && read_word(r, node, value))
        return true;
    if (numeric && r->row->choices && !ff_number_parse(node->text, &ignored, &end))
        return refuse_kind(r, node); /* names the words, too */
    switch (r->row->type) {
    case FF_REAL:
        return read_real(r, node, &value->real);
    case FF_INT:
        return read_integer(r, node, &value->integer);
    case FF_BOOL:
        return read_boolean(r, node, value);
    case FF_FILE:
        return read_file(r, node, value);
    case FF_TEXT:
        value->text = ff_print_text("%s", node->text);
        return true;
    default:
        return refuse_kind(r, node);
    }
}

bool ff_param_read(const ff_param *row, const ff_unit *unit, const char *name, const ff_node *node,
                   ff_value *value, ff_report *report)
{
    reading r = {.row = row, .unit = unit, .name = name, .report = report};
    *value = (ff_value){.size = sizeof *value, .given = 1};
    if (row->type == FF_REALS ? read_reals(&r, node, value) : read_scalar(&r, node, value))
        return true;
    ff_value_clear(value);
    return false;
}

/* "[20 mm, 21 mm]" as a list of scalars, each of which the caller frees; else one scalar. */
static size_t split_list(const char *text, ff_node *items, size_t most)
{
    size_t count = 0;
    const char *at = text + 1;
    while (count < most && *at && *at != ']') {
        at += strspn(at, " ");
        size_t length = strcspn(at, ",]");
        items[count++] =
            (ff_node){.kind = FF_SCALAR, .text = ff_print_text("%.*s", (int)length, at)};
        at += length + (at[length] == ',');
    }
    return count;
}

bool ff_param_read_preset(const ff_param *row, const ff_unit *unit, const char *name,
                          ff_value *value, ff_report *report)
{
    enum { MOST = 64 };
    ff_node items[MOST], *list[MOST], node = {.kind = FF_SCALAR, .quoted = true};
    node.text = ff_print_text("%s", row->preset);
    if (row->type == FF_REALS && row->preset[0] == '[') {
        node.kind = FF_SEQUENCE;
        node.count = split_list(row->preset, items, MOST);
        node.items = list;
        for (size_t i = 0; i < node.count; i++)
            list[i] = &items[i];
    }
    bool good = ff_param_read(row, unit, name, &node, value, report);
    value->given = 0;
    for (size_t i = 0; i < node.count; i++)
        free(items[i].text);
    free(node.text);
    return good;
}

void ff_value_clear(ff_value *value)
{
    free((void *)(uintptr_t)value->text);
    free((void *)(uintptr_t)value->reals);
    *value = (ff_value){.size = sizeof *value};
}
