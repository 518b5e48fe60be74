/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "answer.h"

#include "../../../memory/memory.h"

#include <assert.h>
#include <stdarg.h>
#include <stdlib.h>

void study_answer_say(study_answer *answer, unsigned forms, int indent, const char *format, ...)
{
    char text[4000];
    va_list args;
    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    if (forms & STUDY_ON_TERMINAL)
        study_context_print_line(answer->context, indent, text);
    if (!(forms & STUDY_ON_PAGE))
        return;
    if (!answer->sentences)
        answer->sentences = json_array();
    json_array_append_new(answer->sentences, json_string(text));
}

void study_answer_add(study_answer *answer, const study_table *table)
{
    study_table *kept = memory_arena_alloc(&answer->context->arena, sizeof *kept);
    *kept = *table;
    if (table->forms & STUDY_ON_TERMINAL)
        study_table_print(answer->context, table);
    answer->tables =
        memory_resize(answer->tables, (answer->table_count + 1) * sizeof *answer->tables);
    answer->tables[answer->table_count++] = kept;
}

json_t *study_answer_draw(study_answer *answer, json_t *figure)
{
    if (!answer->figures)
        answer->figures = json_array();
    json_array_append_new(answer->figures, figure);
    return figure;
}

/* Places the page's tables below their drawings. Sentences, and tables without a drawing, come
 * last. */
static json_t *page_of(const study_answer *answer)
{
    json_t *alone = json_array(), *all = json_array();
    for (size_t i = 0; i < answer->table_count; i++) {
        const study_table *table = answer->tables[i];
        json_t *list = table->figure ? json_object_get(table->figure, "tables") : alone;
        if (!(table->forms & STUDY_ON_PAGE))
            continue;
        if (!list) {
            json_object_set_new(table->figure, "tables", json_array());
            list = json_object_get(table->figure, "tables");
        }
        json_array_append_new(list, study_table_page(table));
    }
    json_array_extend(all, answer->figures);
    if (json_array_size(alone) || json_array_size(answer->sentences))
        json_array_append_new(all, json_pack("{s:s, s:s, s:O*, s:O}", "sort", "tables", "title", "",
                                             "words", answer->sentences, "tables", alone));
    json_decref(alone);
    return all;
}

static FILE *open_file(const study_answer *answer, const char *ending)
{
    return study_context_file(answer->context,
                              study_context_format(answer->context, "%s.%s", answer->file, ending));
}

static void put_json(const study_answer *answer, const char *ending, const json_t *value,
                     int digits, size_t indent)
{
    FILE *out = open_file(answer, ending);
    json_dumpf(value, out,
               JSON_INDENT(indent) | JSON_REAL_PRECISION((size_t)(digits ? digits : 6)));
    fputc('\n', out);
    fclose(out);
}

/* Returns the rows of all tables by their titles, for a kind that does not set `value`. */
static json_t *value_of(const study_answer *answer)
{
    json_t *value = json_object();
    for (size_t i = 0; i < answer->table_count; i++) {
        const study_table *table = answer->tables[i];
        json_object_set(value, table->title ? table->title : answer->file, table->rows);
    }
    return value;
}

/* Returns the members for `run --json`, rounded to twelve digits. */
static json_t *facts_of(const study_answer *answer)
{
    char *text = json_dumps(answer->value, JSON_COMPACT | JSON_REAL_PRECISION(12));
    assert(text); /* the texts of a kind are always valid UTF-8 */
    json_t *rounded = json_loads(text, 0, NULL);
    free(text);
    return json_pack("{s:o}", answer->context->name, rounded);
}

void study_answer_close(study_answer *answer)
{
    FILE *out = open_file(answer, "csv");
    if (!answer->value)
        answer->value = value_of(answer);
    for (size_t i = 0; i < answer->table_count; i++)
        if (answer->tables[i]->forms & STUDY_IN_FILE)
            study_table_csv(answer->tables[i], out);
    fclose(out);
    json_t *page = page_of(answer);
    put_json(answer, "json", answer->value, answer->digits, 1);
    put_json(answer, "figure.json", page, 0, 0); /* on one line: thousands of cells are many */
    answer->context->facts = answer->facts ? answer->facts : facts_of(answer);
    for (size_t i = 0; i < answer->table_count; i++)
        json_decref(answer->tables[i]->rows);
    free(answer->tables);
    json_decref(page);
    json_decref(answer->sentences);
    json_decref(answer->figures);
    json_decref(answer->value);
}
