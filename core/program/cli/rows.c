/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Answers rows from standard input with one line of JSON each, in the order in which they end. */
#include "../study/cases/rows.h"
#include "../memory/file.h"
#include "../memory/memory.h"
#include "../results/json.h"
#include "../terminal/answer.h"
#include "command.h"

#include <stdlib.h>
#include <string.h>

/* Returns {name: value in SI}; null for a number that is not finite, as in the record. */
static json_t *values_of(const json_t *outputs)
{
    const char *name;
    json_t *pair, *values = json_object();
    json_object_foreach((json_t *)(size_t)outputs, name, pair)
        json_object_set(values, name, json_array_get(pair, 1));
    return values;
}

static void take_over(json_t *line, const json_t *record, const char *name)
{
    json_t *value = json_object_get(record, name);
    if (value)
        json_object_set(line, name, value);
}

bool cli_answer_row(size_t index, const json_t *set, const json_t *record, bool known)
{
    static const char *const members[] = {"key",   "status", "verdict", "reasons",
                                          "range", "reason", "warnings"};
    json_t *line =
        json_pack("{s:I, s:b, s:O}", "case", (json_int_t)index + 1, "before", known, "set", set);
    for (size_t i = 0; i < sizeof members / sizeof *members; i++)
        take_over(line, record, members[i]);
    json_object_set_new(line, "outputs", values_of(json_object_get(record, "outputs")));
    char *text = json_dumps(line, JSON_COMPACT | JSON_REAL_PRECISION(RESULTS_JSON_DIGITS));
    char *whole = memory_print_text("%s\n", text);
    bool good = file_write(terminal_answer_file(), whole, strlen(whole), -1);
    free(whole);
    free(text);
    json_decref(line);
    return good;
}
