/* SPDX-License-Identifier: MIT */
/* Reads the header of a table: names and units of its columns. Checks that the required columns
   exist. */
#include "columns-read.h"

#include "memory.h"

#include <stdio.h>
#include <string.h>

static int find(const fe_columns *c, fe_field name)
{
    size_t length = (size_t)(name.end - name.at);
    for (size_t k = 0; k < c->count; k++)
        if (strlen(c->requested[k]->name) == length &&
            !memcmp(c->requested[k]->name, name.at, length))
            return (int)k;
    return FE_NO_COLUMN;
}

/* Prints a column as a header names it: "time [s]". */
static void print_head(const fe_columns *c, size_t k, char *out, size_t size)
{
    bool bare = ff_unit_is_dimensionless(&c->units[k]) && strcmp(c->requested[k]->unit, "%") != 0;
    snprintf(out, size, "%s%s%s%s", c->requested[k]->name, bare ? "" : " [",
             bare ? "" : c->requested[k]->unit, bare ? "" : "]");
}

static bool refuse_name(const fe_column_reader *r, fe_field head, const char *word)
{
    const fe_columns *c = r->c;
    const char *names[FE_MOST_FIELDS];
    char list[800] = "", name[160], hint[1000];
    size_t count = c->count < FE_MOST_FIELDS ? c->count : FE_MOST_FIELDS, used = 0;
    for (size_t k = 0; k < count; k++) {
        names[k] = c->requested[k]->name;
        print_head(c, k, name, sizeof name);
        if (used < sizeof list)
            used += (size_t)snprintf(list + used, sizeof list - used, "%s%s", k ? ", " : "", name);
    }
    const char *near = ff_nearest(word, names, count);
    if (near)
        snprintf(hint, sizeof hint,
                 "did you mean \"%s\"? The name of a column of your own begins with x-", near);
    else
        snprintf(hint, sizeof hint,
                 "the columns are %s; the name of a column of your own begins with x-", list);
    return fe_column_refuse(r, head, hint, "no column is called \"%s\"", word);
}

/* Reads the unit "[GPa]" behind a name, which may be absent; `head` is the whole field. */
static bool read_unit(fe_column_reader *r, size_t index, fe_field head, const char *open,
                      const char *word)
{
    fe_columns *c = r->c;
    size_t k = (size_t)r->column_of[index];
    char unit[80] = "", why[200], example[160], hint[200];
    print_head(c, k, example, sizeof example);
    snprintf(hint, sizeof hint, "write for example \"%s\"", example);
    if (open && head.end[-1] != ']')
        return fe_column_refuse(r, head, NULL,
                                "the unit belongs in brackets at the end, as in \"%s\"", example);
    if (open) {
        fe_field inside = fe_field_trim(open + 1, head.end - 1);
        snprintf(unit, sizeof unit, "%.*s", (int)(inside.end - inside.at), inside.at);
    }
    if (!strcmp(unit, "-"))
        unit[0] = 0;
    if (!*unit && !ff_unit_is_dimensionless(&c->units[k]))
        return fe_column_refuse(r, head, NULL,
                                "the column \"%s\" needs its unit in brackets, such as \"%s\"",
                                word, example);
    if (!ff_unit_parse(unit, &r->unit_of[index], why, sizeof why))
        return fe_column_refuse(r, head, hint, "the unit \"%s\" %s", unit, why);
    return ff_unit_same_dimension(&r->unit_of[index], &c->units[k]) ||
           fe_column_refuse(r, head, NULL,
                            "the column \"%s\" is in \"%s\", but should be in a unit such as %s",
                            word, unit, c->requested[k]->unit);
}

/* Reads one field of the header: "pressure [GPa]". */
static bool read_head(fe_column_reader *r, size_t index, fe_field head)
{
    fe_columns *c = r->c;
    const char *open = memchr(head.at, '[', (size_t)(head.end - head.at));
    fe_field name = fe_field_trim(head.at, open ? open : head.end);
    char word[80];
    int k = r->column_of[index] = find(c, name);
    snprintf(word, sizeof word, "%.*s", (int)(name.end - name.at), name.at);
    if (k == FE_NO_COLUMN)
        return !strncmp(word, "x-", 2) || refuse_name(r, head, word);
    if (c->values[k])
        return fe_column_refuse(r, head, NULL, "the column \"%s\" occurs twice", word);
    c->values[k] = fe_alloc(sizeof(double));
    c->fields[k] = index;
    c->heads[k] = fe_column_place(r, head);
    return read_unit(r, index, head, open, word);
}

static bool same_group(const fe_columns *c, size_t i, size_t k)
{
    const char *a = c->requested[i]->group, *b = c->requested[k]->group;
    return i == k || (a && b && !strcmp(a, b));
}

/* Counts the columns of the file in the group of row k; *first: k is the first row of the group. */
static size_t count_group(const fe_columns *c, size_t k, bool *first)
{
    size_t given = 0;
    *first = true;
    for (size_t i = 0; i < c->count; i++) {
        *first = *first && (i >= k || !same_group(c, i, k));
        given += same_group(c, i, k) && c->values[i];
    }
    return given;
}

static bool refuse_missing(const fe_column_reader *r, size_t k, fe_field line)
{
    const fe_columns *c = r->c;
    char names[500], name[160];
    size_t used = 0;
    for (size_t i = k; i < c->count && used < sizeof names; i++) {
        print_head(c, i, name, sizeof name);
        if (same_group(c, i, k))
            used += (size_t)snprintf(names + used, sizeof names - used, "%s\"%s\"",
                                     i > k ? " or " : "", name);
    }
    return fe_column_refuse(r, (fe_field){line.at, line.at}, NULL, "the column %s is missing: %s",
                            names, c->requested[k]->doc);
}

/* Checks that the required columns exist, and at most one column of each group. */
static bool check_heads(const fe_column_reader *r, fe_field line)
{
    const fe_columns *c = r->c;
    bool good = true, first;
    for (size_t k = 0; k < c->count; k++) {
        if (count_group(c, k, &first) == 0 && first && c->requested[k]->flags & FF_REQUIRED)
            good = refuse_missing(r, k, line);
        for (size_t i = 0; i < k; i++)
            if (c->values[i] && c->values[k] && same_group(c, i, k))
                good = ff_error(r->report, FF_FAULT_INPUT, c->heads[k], NULL,
                                "the columns \"%s\" and \"%s\" exclude each other",
                                c->requested[i]->name, c->requested[k]->name);
    }
    return good;
}

bool fe_column_heads_read(fe_column_reader *r, fe_field line)
{
    fe_columns *c = r->c;
    fe_field fields[FE_MOST_FIELDS];
    c->separator = fe_line_separator(line);
    c->width = fe_line_split(line, c->separator, fields);
    if (c->width > FE_MOST_FIELDS)
        return fe_column_refuse(r, line, NULL, "the header names more than %d columns",
                                FE_MOST_FIELDS);
    if (!fe_line_is_closed(r, c->width, fields))
        return false;
    bool good = true;
    for (size_t i = 0; i < c->width; i++)
        good = read_head(r, i, fields[i]) && good;
    return good && check_heads(r, line);
}
