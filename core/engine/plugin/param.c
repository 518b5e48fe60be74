/* SPDX-License-Identifier: MIT */
/* Reads the value of a parameter from the file, according to its row. */
#include "param.h"

#include "../value/limits.h"
#include "../value/memory.h"
#include "../value/report.h"
#include "../value/similar-file.h"
#include "../value/tree.h"
#include "../value/unit.h"

#include <errno.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* The state of reading one parameter. */
typedef struct reading {
    const ff_param *row;
    const ff_unit *unit;
    const char *name;
    ff_report *report;
} reading;

int fe_word_find(const char *words, const char *word)
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

/* Writes quoted words, separated by commas. */
static void print_words(const char *words, char *out, size_t size)
{
    char word[64];
    size_t used = 0;
    out[0] = 0;
    for (size_t i = 0; used < size && ff_word_at(words, i, word, sizeof word); i++)
        used += (size_t)snprintf(out + used, size - used, "%s\"%s\"", i ? ", " : "", word);
}

void ff_param_expectation(const ff_param *row, char *out, size_t size)
{
    static const char *const plain[] = {[FF_REAL] = "a number",
                                        [FF_INT] = "a whole number",
                                        [FF_BOOL] = "true or false",
                                        [FF_CHOICE] = "one of ",
                                        [FF_TEXT] = "a text",
                                        [FF_REALS] = "a list of numbers",
                                        [FF_FILE] = "the name of a file"};
    char words[512], what[128];
    bool bare = !row->unit[0] || !strcmp(row->unit, "1");
    snprintf(what, sizeof what, "%s", plain[row->type]);
    if (row->type == FF_REALS && !bare)
        snprintf(what, sizeof what, "a list of numbers with units such as [3 %s, 4 %s]", row->unit,
                 row->unit);
    else if (row->type == FF_REALS && row->flags & FF_WHOLE)
        snprintf(what, sizeof what, "a list of whole numbers");
    else if (row->type == FF_REAL && !bare)
        snprintf(what, sizeof what, "a number with a unit such as \"3 %s\"", row->unit);
    print_words(row->choices, words, sizeof words);
    const char *before = row->type == FF_TEXT ? ", such as " : row->type == FF_CHOICE ? "" : " or ";
    snprintf(out, size, "%s%s%s", what, row->choices ? before : "", words);
}

/* Reports an error about the parameter at the node; hint may be NULL. */
__attribute__((format(printf, 4, 5))) static bool refuse(const reading *r, const ff_node *node,
                                                         const char *hint, const char *format, ...)
{
    char text[1024];
    va_list args;
    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    return ff_error(r->report, FF_FAULT_INPUT, node->place, hint, "%s: %s", r->name, text);
}

/* Reports "expected ..., found a list" for a node of the wrong kind or an unknown word. */
static bool refuse_kind(const reading *r, const ff_node *node)
{
    enum { MOST = 32 };
    char wanted[640], hint[128], words[MOST][64];
    const char *list[MOST];
    size_t count = 0;
    ff_param_expectation(r->row, wanted, sizeof wanted);
    if (node->kind != FF_SCALAR || !node->text[0])
        return refuse(r, node, NULL, "expected %s, found %s", wanted,
                      node->kind == FF_SCALAR ? "nothing" : fe_kind_name(node->kind));
    while (count < MOST && ff_word_at(r->row->choices, count, words[count], sizeof words[0])) {
        list[count] = words[count];
        count++;
    }
    const char *near = ff_nearest(node->text, list, count);
    snprintf(hint, sizeof hint, "did you mean \"%s\"?", near ? near : "");
    return refuse(r, node, near ? hint : NULL, "expected %s, found \"%.80s\"", wanted, node->text);
}

static void print(const reading *r, double si, char out[80])
{
    ff_quantity_print(si, r->unit, r->row->unit, out, 80);
}

/* Refuses a value outside the physical limits, sets a value within rounding of a closed limit to
   the limit, and warns outside the calibrated range. */
static bool check_range(const reading *r, const ff_node *node, double *si)
{
    const ff_param *row = r->row;
    char value[80], limit[80], wanted[100], text[1024];
    int side = fe_limits_check(row, r->unit, si, wanted);
    if (side != 0) {
        print(r, *si, value);
        snprintf(text, sizeof text, "%s: %s is too %s; it must be %s", r->name, value,
                 side < 0 ? "small" : "large", wanted);
        return fe_report_beyond(r->report, node->place, text);
    }
    if (row->low < row->high) {
        bool under = fe_unit_compare(r->unit, *si, row->low) < 0;
        bool over = fe_unit_compare(r->unit, *si, row->high) > 0;
        if (!under && !over)
            return true;
        print(r, *si, value);
        print(r, ff_unit_to_si(r->unit, under ? row->low : row->high), limit);
        ff_warn(r->report, node->place, "%s: %s is outside the calibrated range, which %s at %s",
                r->name, value, under ? "begins" : "ends", limit);
    }
    return true;
}

/* Reads a value with a tolerance, and returns the middle of the tolerance. Both its ends must be
   allowed values. */
static bool read_toleranced(const reading *r, const ff_node *node, const ff_tolerance *t,
                            double *si)
{
    const double numbers[] = {t->low, t->high, t->middle};
    char text[128], why[512];
    for (size_t i = 0; i < 3; i++) {
        snprintf(text, sizeof text, "%.17g %s", numbers[i], t->unit);
        if (!ff_quantity_parse(text, r->unit, r->row->unit, si, why, sizeof why))
            return refuse(r, node, NULL, "%s", why);
        if (i < 2 && !check_range(r, node, si))
            return false;
    }
    return true;
}

/* Whether the text is several numbers with blanks between them, probably a list whose commas are
 * missing. */
static bool is_list_without_commas(const char *text)
{
    double number;
    size_t count = 0;
    for (; ff_number_parse(text, &number, &text); text += strspn(text, " "))
        count++;
    return count > 1 && !*text;
}

static bool read_real(const reading *r, const ff_node *node, double *si)
{
    char why[512];
    ff_tolerance tolerance;
    if (node->kind != FF_SCALAR || !node->text[0])
        return refuse_kind(r, node);
    int toleranced = ff_tolerance_parse(node->text, &tolerance, why, sizeof why);
    if (toleranced != 0)
        return toleranced > 0 ? read_toleranced(r, node, &tolerance, si)
                              : refuse(r, node, NULL, "%s", why);
    if (!ff_quantity_parse(node->text, r->unit, r->row->unit, si, why, sizeof why))
        return refuse(r, node,
                      is_list_without_commas(node->text)
                          ? "separate the numbers of a list by commas: [1, 2]"
                          : NULL,
                      "%s", why);
    return check_range(r, node, si);
}

static bool read_integer(const reading *r, const ff_node *node, int64_t *integer)
{
    char why[512];
    if (!ff_integer_parse(node->text, integer, why, sizeof why))
        return refuse(r, node, NULL, "%s", why);
    double number = (double)*integer;
    return check_range(r, node, &number);
}

static bool read_boolean(const reading *r, const ff_node *node, ff_value *value)
{
    static const char yes[] = "true|True|TRUE", no[] = "false|False|FALSE";
    value->integer = fe_word_find(yes, node->text) >= 0;
    return value->integer || fe_word_find(no, node->text) >= 0 || refuse_kind(r, node);
}

static bool check_length(const reading *r, const ff_node *node, size_t count)
{
    uint32_t least = r->row->min_count, most = r->row->max_count;
    char wanted[64];
    if (count >= least && (count <= most || most == 0))
        return true;
    if (least == most)
        snprintf(wanted, sizeof wanted, "%u", most);
    else if (least > 0 && most > 0)
        snprintf(wanted, sizeof wanted, "%u to %u", least, most);
    else
        snprintf(wanted, sizeof wanted, "at %s %u", most ? "most" : "least", most ? most : least);
    return refuse(r, node, NULL, "expected %s numbers, found %zu", wanted, count);
}

static bool read_reals(const reading *r, const ff_node *node, ff_value *value)
{
    bool list = node->kind == FF_SEQUENCE, good = true;
    size_t count = list ? node->count : 1;
    if (!list && (node->kind == FF_MAP || !node->text[0]))
        return refuse_kind(r, node);
    if (!check_length(r, node, count))
        return false;
    double *reals = fe_alloc(count * sizeof *reals);
    value->reals = reals;
    value->count = count;
    for (size_t i = 0; i < count; i++) {
        const ff_node *item = list ? node->items[i] : node;
        if (!read_real(r, item, &reals[i]))
            good = false;
        else if ((r->row->flags & FF_WHOLE) && reals[i] != floor(reals[i]))
            good = refuse(r, item, NULL, "\"%.80s\" is not a whole number", item->text);
        else if (good && i > 0 && (r->row->flags & FF_INCREASING) && reals[i] < reals[i - 1])
            good = refuse(r, item, NULL,
                          "the numbers must not decrease, but \"%.80s\" follows a larger one",
                          item->text);
    }
    return good;
}

/* Reads the path of a file. A relative path starts at the directory of the source that gives it. */
static bool read_file(const reading *r, const ff_node *node, ff_value *value)
{
    const ff_source *source = node->place.source;
    bool beside = node->text[0] != '/' && source && source->directory;
    struct stat status;
    char *path =
        fe_print_text("%s%s%s", beside ? source->directory : "", beside ? "/" : "", node->text);
    value->text = path;
    if (stat(path, &status) == 0 && !S_ISREG(status.st_mode))
        return refuse(r, node, NULL, "the file \"%s\" cannot be read: it is not a regular file",
                      path);
    if (access(path, R_OK) == 0)
        return true;
    const char *why = fe_errno_text();
    char *hint = fe_near_file(path);
    refuse(r, node, hint, "the file \"%s\" cannot be read: %s", path, why);
    fe_free(hint);
    return false;
}

static bool read_scalar(const reading *r, const ff_node *node, ff_value *value)
{
    const ff_param *row = r->row;
    double ignored;
    const char *end;
    if (node->kind != FF_SCALAR || (!node->text[0] && !(row->type == FF_TEXT && node->quoted)))
        return refuse_kind(r, node);
    int rank = fe_word_find(row->choices, node->text);
    if (rank >= 0 || row->type == FF_TEXT) {
        value->integer = rank >= 0 ? rank : 0;
        value->text = fe_copy_text(node->text, strlen(node->text));
        return true;
    }
    if (row->choices && !ff_number_parse(node->text, &ignored, &end))
        return refuse_kind(r, node); /* also lists the allowed words */
    switch (row->type) {
    case FF_REAL:
        return read_real(r, node, &value->real);
    case FF_INT:
        return read_integer(r, node, &value->integer);
    case FF_BOOL:
        return read_boolean(r, node, value);
    case FF_FILE:
        return read_file(r, node, value);
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

/* Cuts the text "[20 mm, 21 mm]" into items. */
static void split_list(char *text, ff_node *list, ff_node *items, ff_node **pointers)
{
    char *rest = NULL;
    list->kind = FF_SEQUENCE;
    list->items = pointers;
    for (char *item = strtok_r(text, "[],", &rest); item; item = strtok_r(NULL, "[],", &rest)) {
        item += strspn(item, " \t\n");
        if (!*item)
            continue;
        items[list->count] = (ff_node){.kind = FF_SCALAR, .text = item};
        pointers[list->count] = &items[list->count];
        list->count++;
    }
}

bool fe_param_read_text(const ff_param *row, const ff_unit *unit, const char *name,
                        const char *text, ff_value *value, ff_report *report)
{
    char *copy = fe_print_text("%s", text);
    ff_node node = {.kind = FF_SCALAR, .quoted = true, .text = copy}, *items = NULL;
    ff_node **pointers = NULL;
    if (row->type == FF_REALS && copy[0] == '[') {
        size_t most = strlen(copy);
        items = fe_alloc(most * sizeof *items);
        pointers = fe_alloc(most * sizeof *pointers);
        split_list(copy, &node, items, pointers);
    }
    bool good = ff_param_read(row, unit, name, &node, value, report);
    fe_free(pointers);
    fe_free(items);
    fe_free(copy);
    return good;
}

bool ff_param_read_preset(const ff_param *row, const ff_unit *unit, const char *name,
                          ff_value *value, ff_report *report)
{
    bool good = fe_param_read_text(row, unit, name, row->preset, value, report);
    value->given = 0;
    return good;
}

/* The node of a number from memory, which has no place in a file. */
static const ff_node nowhere = {.kind = FF_SCALAR};

static bool refuse_number(const reading *r, double number)
{
    char wanted[640];
    ff_param_expectation(r->row, wanted, sizeof wanted);
    return refuse(r, &nowhere, NULL, "expected %s, found %g", wanted, number);
}

static const double LARGEST_WHOLE = 9007199254740992; /* 2^53 */

/* Takes one number: a scalar, or an item of a list. */
static bool take_number(const reading *r, double *si)
{
    bool whole = r->row->type == FF_INT || r->row->flags & FF_WHOLE;
    if (!isfinite(*si))
        return refuse(r, &nowhere, NULL, "%g is not a possible value", *si);
    if (whole && *si != floor(*si))
        return refuse(r, &nowhere, NULL, "%g is not a whole number", *si);
    if (whole && fabs(*si) > LARGEST_WHOLE)
        return refuse(r, &nowhere, NULL, "%g is beyond 2^53, up to which whole numbers are exact",
                      *si);
    return check_range(r, &nowhere, si);
}

static bool take_list(const reading *r, const double *si, size_t count, ff_value *value)
{
    if (!check_length(r, &nowhere, count))
        return false;
    double *reals = fe_alloc(count * sizeof *reals);
    bool good = true;
    value->reals = reals;
    value->count = count;
    for (size_t i = 0; i < count && good; i++) {
        reals[i] = si[i];
        good = take_number(r, &reals[i]);
        if (good && i > 0 && (r->row->flags & FF_INCREASING) && reals[i] < reals[i - 1])
            good = refuse(r, &nowhere, NULL,
                          "the numbers must not decrease, but %g follows a larger one", reals[i]);
    }
    return good;
}

/* Takes a switch (0 or 1), or the rank of a word. */
static bool take_rank(const reading *r, double number, ff_value *value)
{
    const ff_param *row = r->row;
    char word[64];
    bool known = number >= 0 && number < 1000 && number == floor(number);
    if (row->type == FF_BOOL)
        known = number == 0 || number == 1;
    else
        known = known && ff_word_at(row->choices, (size_t)number, word, sizeof word);
    if (!known)
        return refuse_number(r, number);
    value->integer = (int64_t)number;
    if (row->type == FF_CHOICE)
        value->text = fe_copy_text(word, strlen(word));
    return true;
}

bool fe_param_take(const ff_param *row, const ff_unit *unit, const char *name, const double *si,
                   size_t count, ff_value *value, ff_report *report)
{
    reading r = {.row = row, .unit = unit, .name = name, .report = report};
    double number = count ? si[0] : 0;
    bool good = false;
    *value = (ff_value){.size = sizeof *value, .given = 1};
    if (row->type == FF_REALS)
        good = take_list(&r, si, count, value);
    else if (count != 1)
        good = refuse(&r, &nowhere, NULL, "expected one number, found %zu", count);
    else if (row->type == FF_BOOL || row->type == FF_CHOICE)
        good = take_rank(&r, number, value);
    else if (row->type == FF_REAL || row->type == FF_INT)
        good = take_number(&r, &number);
    else
        good = refuse_number(&r, number);
    if (good && row->type == FF_REAL)
        value->real = number;
    else if (good && row->type == FF_INT)
        value->integer = (int64_t)number;
    if (!good)
        ff_value_clear(value);
    return good;
}

void ff_value_clear(ff_value *value)
{
    fe_free((void *)(uintptr_t)value->text);
    fe_free((void *)(uintptr_t)value->reals);
    *value = (ff_value){.size = sizeof *value};
}
