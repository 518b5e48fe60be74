/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Writes HTML from the JSON description of a study or a comparison: its figures, sentences and
 * tables. Only figures need scripts. */
#include "page.h"

#include "../study/kinds/answer/text.h"

#include <jansson.h>
#include <stdlib.h>
#include <string.h>

void report_put_json(FILE *out, json_t *value)
{
    char *text = json_dumps(value, JSON_COMPACT | JSON_ENCODE_ANY | JSON_REAL_PRECISION(9));
    for (const char *at = text; at && *at; at++)
        if (*at == '<')
            fputs("\\u003c", out);
        else
            fputc(*at, out);
    free(text);
    json_decref(value);
}

static void put_figure(FILE *out, json_t *figure)
{
    json_t *words = json_incref(json_object_get(figure, "words")),
           *tables = json_incref(json_object_get(figure, "tables")), *one;
    const bool drawn = strcmp(study_text_of(figure, "sort"), "tables") != 0;
    size_t i;
    json_object_del(figure, "words");
    json_object_del(figure, "tables");
    if (drawn) {
        report_print(out,
                     "<figure class=\"%s\"><figcaption><span>%s</span></figcaption><script "
                     "type=\"application/json\">",
                     study_text_of(figure, "class"), study_text_of(figure, "title"));
        report_put_json(out, json_incref(figure));
        fputs("</script>\n", out);
    } else {
        fputs("<div>\n", out);
    }
    json_array_foreach(words, i, one)
        report_print(out, "<p>%s</p>\n", json_is_string(one) ? json_string_value(one) : "");
    json_array_foreach(tables, i, one) if (json_array_size(json_object_get(one, "rows")))
        report_put_table(out, json_incref(one));
    fputs(drawn ? "</figure>\n" : "</div>\n", out);
    json_decref(words);
    json_decref(tables);
}

void report_put_figures(FILE *out, const char *json)
{
    json_t *figures = json_loads(json, 0, NULL), *figure;
    size_t i;
    fputs("<div class=\"figures drawn\">\n", out);
    json_array_foreach(figures, i, figure) if (json_is_object(figure)) put_figure(out, figure);
    fputs("</div>\n", out);
    json_decref(figures);
}
