/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "form.h"

#include "hash.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static bool is_one_of(const char *name, const char *const *names)
{
    while (*names && strcmp(*names, name) != 0)
        names++;
    return *names != NULL;
}

/* Members that stand in each line. */
static bool is_beside(const char *name)
{
    static const char *const names[] = {"case", "key", "status", "log", "parameters", NULL};
    return is_one_of(name, names);
}

/* Members whose texts are of one case. */
static bool has_own_texts(const char *name)
{
    static const char *const names[] = {"set", "reason", "command", "from", "state", NULL};
    return is_one_of(name, names);
}

/* Returns the form of a value; what it lacks is appended to the list. */
static json_t *empty(json_t *value, bool own_texts, json_t *values)
{
    const char *name;
    json_t *item, *form = NULL;
    size_t i;
    if (json_is_object(value)) {
        form = json_object();
        json_object_foreach(value, name, item)
            json_object_set_new(form, name, empty(item, own_texts, values));
    } else if (json_is_array(value)) {
        form = json_array();
        json_array_foreach(value, i, item)
            json_array_append_new(form, empty(item, own_texts, values));
    } else if (json_is_string(value) && !own_texts) {
        form = json_incref(value);
    } else {
        json_array_append(values, value);
        form = json_null();
    }
    return form;
}

/* With the fewest digits that give the same number; a point or an exponent tells it from a whole
   number. */
static void put_real(double value, FILE *out)
{
    char text[40];
    for (int digits = 15; digits <= 17; digits++) {
        snprintf(text, sizeof text, "%.*g", digits, value);
        if (strtod(text, NULL) == value)
            break;
    }
    fputs(text, out);
    if (!strpbrk(text, ".e"))
        fputs(".0", out);
}

static void put_value(const json_t *value, FILE *out)
{
    if (json_is_real(value))
        put_real(json_real_value(value), out);
    else if (json_is_integer(value))
        fprintf(out, "%" JSON_INTEGER_FORMAT, json_integer_value(value));
    else
        json_dumpf(value, out, JSON_COMPACT | JSON_ENCODE_ANY);
}

static void put_values(const json_t *values, FILE *out)
{
    size_t i;
    json_t *value;
    fputs(",\"values\":[", out);
    json_array_foreach(values, i, value)
    {
        fputs(i ? "," : "", out);
        put_value(value, out);
    }
    fputc(']', out);
}

/* Names the form, and says it unless that was done. */
static void put_form(const json_t *form, json_t *said, FILE *out)
{
    char *text = json_dumps(form, JSON_COMPACT), name[STUDY_FORM_NAME];
    snprintf(name, sizeof name, "%016llx",
             (unsigned long long)study_hash_text(STUDY_HASH_START, text));
    fprintf(out, ",\"form\":\"%s\"", name);
    if (text && !json_object_get(said, name)) {
        fprintf(out, ",\"is\":%s", text);
        json_object_set_new(said, name, json_true());
    }
    free(text);
}

void study_form_write(const json_t *record, json_t *said, FILE *out)
{
    json_t *form = json_object(), *values = json_array(), *member;
    const json_t *parameters = json_object_get(record, "parameters");
    const json_t *log = json_object_get(record, "log");
    const char *name;
    fprintf(out, "{\"case\":%" JSON_INTEGER_FORMAT ",\"key\":\"%s\",\"status\":\"%s\"",
            json_integer_value(json_object_get(record, "case")),
            json_string_value(json_object_get(record, "key")),
            json_string_value(json_object_get(record, "status")));
    if (log) {
        fputs(",\"log\":", out);
        json_dumpf(log, out, JSON_COMPACT);
    }
    json_object_foreach((json_t *)(size_t)record, name, member) if (!is_beside(name))
        json_object_set_new(form, name, empty(member, has_own_texts(name), values));
    put_form(form, said, out);
    put_values(values, out);
    if (json_object_size(parameters)) {
        fputs(",\"parameters\":", out);
        json_dumpf(parameters, out, JSON_COMPACT);
    }
    json_decref(form);
    json_decref(values);
}

/* Returns a copy of the form with the next values; *next runs past their number when they are too
   few. */
static json_t *fill(const json_t *form, const json_t *values, size_t *next)
{
    const char *name;
    json_t *item, *whole;
    size_t i;
    if (json_is_object(form)) {
        whole = json_object();
        json_object_foreach((json_t *)(size_t)form, name, item)
            json_object_set_new_nocheck(whole, name, fill(item, values, next));
        return whole;
    }
    if (json_is_array(form)) {
        whole = json_array();
        json_array_foreach(form, i, item) json_array_append_new(whole, fill(item, values, next));
        return whole;
    }
    if (!json_is_null(form))
        return json_incref((json_t *)(size_t)form);
    whole = json_array_get(values, (*next)++);
    return whole ? json_incref(whole) : json_null();
}

json_t *study_form_fill(const json_t *form, const json_t *line)
{
    static const char *const beside[] = {"case", "key", "status", "log", "parameters", NULL};
    const json_t *values = json_object_get(line, "values");
    json_t *record = json_object(), *member;
    const char *name;
    size_t next = 0;
    for (const char *const *own = beside; *own; own++)
        if (json_object_get(line, *own))
            json_object_set(record, *own, json_object_get(line, *own));
    json_object_foreach((json_t *)(size_t)form, name, member)
        json_object_set_new(record, name, fill(member, values, &next));
    if (next == json_array_size(values))
        return record;
    json_decref(record);
    return NULL;
}

static size_t count_places(const json_t *form)
{
    const char *name;
    json_t *item;
    size_t i, count = json_is_null(form);
    json_object_foreach((json_t *)(size_t)form, name, item) count += count_places(item);
    json_array_foreach(form, i, item) count += count_places(item);
    return count;
}

void study_form_find(const json_t *form, const char *wanted, size_t *first, size_t *count)
{
    const char *name;
    json_t *member;
    *first = *count = 0;
    json_object_foreach((json_t *)(size_t)form, name, member)
    {
        size_t places = count_places(member);
        if (!strcmp(name, wanted)) {
            *count = places;
            return;
        }
        *first += places;
    }
}
