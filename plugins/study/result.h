/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a study came to as JSON, shared by the studies of this folder. */
#ifndef STUDY_RESULT_H
#define STUDY_RESULT_H

#include "line.h"

#include <jansson.h>
#include <math.h>

FF_UNUSED static json_t *study_real(double value)
{
    return isfinite(value) ? json_real(value) : json_null();
}

FF_UNUSED static const char *study_text_of(const json_t *map, const char *key)
{
    const char *text = json_string_value(json_object_get(map, key));
    return text ? text : "";
}

FF_UNUSED static double study_number_of(const json_t *map, const char *key)
{
    const json_t *value = json_object_get(map, key);
    return json_is_number(value) ? json_number_value(value) : (double)NAN;
}

FF_UNUSED static void study_put_json(const json_t *result, FILE *out)
{
    json_dumpf(result, out, JSON_INDENT(1) | JSON_REAL_PRECISION(6));
    fputc('\n', out);
}

/* A file of it. */
FF_UNUSED static void study_hand_over(const ff_study_desk *desk, const char *name,
                                      const json_t *result, void (*put)(const json_t *, FILE *))
{
    char *text = NULL;
    size_t length = 0;
    FILE *out = open_memstream(&text, &length);
    if (out)
        put(result, out);
    if (out && fclose(out) == 0)
        desk->file(desk->ctx, name, text);
    free(text);
}

/* A member of the program's answer. */
FF_UNUSED static void study_give_facts(const ff_study_desk *desk, const char *name, json_t *result,
                                       size_t digits)
{
    json_t *facts = json_pack("{s:O}", name, result);
    char *text = json_dumps(facts, JSON_COMPACT | JSON_REAL_PRECISION(digits));
    if (text)
        desk->facts(desk->ctx, text);
    free(text);
    json_decref(facts);
}

#endif
