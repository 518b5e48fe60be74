/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Writes records without their forms, and restores them from their forms (record-schema.h). */
#include "record-schema.h"

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

/* Members that are stored in each line and not in the form. */
static const char *const beside[] = {"case", "key", "status", "log", "parameters", NULL};

static bool is_beside(const char *name)
{
    return is_one_of(name, beside);
}

/* Returns whether the texts of a member differ from case to case. */
static bool has_own_texts(const char *name)
{
    static const char *const names[] = {"set", "reason", "command", "from", "state", NULL};
    return is_one_of(name, names);
}

static bool is_own(const json_t *value, bool own_texts)
{
    return !json_is_object(value) && !json_is_array(value) && (own_texts || !json_is_string(value));
}

/* Returns the form of a value: the value with null in place of its numbers. */
static json_t *empty(json_t *value, bool own_texts)
{
    const char *name;
    json_t *item, *form;
    size_t i;
    if (is_own(value, own_texts))
        return json_null();
    if (json_is_string(value))
        return json_incref(value);
    form = json_is_object(value) ? json_object() : json_array();
    json_object_foreach(value, name, item) json_object_set_new(form, name, empty(item, own_texts));
    json_array_foreach(value, i, item) json_array_append_new(form, empty(item, own_texts));
    return form;
}

/* Hashes the form of a value without constructing it. */
static uint64_t hash_form(uint64_t hash, json_t *value, bool own_texts)
{
    const char *name;
    json_t *item;
    size_t i;
    if (is_own(value, own_texts))
        return study_hash_text(hash, NULL);
    if (json_is_string(value))
        return study_hash_text(study_hash_text(hash, "text"), json_string_value(value));
    hash = study_hash_text(hash, json_is_object(value) ? "{" : "[");
    json_object_foreach(value, name, item) hash =
        hash_form(study_hash_text(hash, name), item, own_texts);
    json_array_foreach(value, i, item) hash = hash_form(hash, item, own_texts);
    return study_hash_text(hash, "}");
}

/* Writes a number with the fewest digits that read back equal; a point or an exponent
 * distinguishes it from an integer. */
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

/* Writes the values that are not in the form, with a comma before each but the first. */
static void put_values(json_t *value, bool own_texts, bool *any, FILE *out)
{
    const char *name;
    json_t *item;
    size_t i;
    json_object_foreach(value, name, item) put_values(item, own_texts, any, out);
    json_array_foreach(value, i, item) put_values(item, own_texts, any, out);
    if (!is_own(value, own_texts))
        return;
    fputs(*any ? "," : "", out);
    put_value(value, out);
    *any = true;
}

/* The form is repeated after this many lines, so that losing one block of a journal does not
 * make all later lines unreadable. */
enum { LINES_OF_A_FORM = 256 };

/* Writes the name of the form, and also the form itself unless one of the last lines contains
   it. */
static void put_form(json_t *record, json_t *written_forms, FILE *out)
{
    const char *member;
    json_t *value;
    char name[STUDY_FORM_NAME];
    uint64_t hash = STUDY_HASH_START;
    json_object_foreach(record, member, value) if (!is_beside(member)) hash =
        hash_form(study_hash_text(hash, member), value, has_own_texts(member));
    snprintf(name, sizeof name, "%016llx", (unsigned long long)hash);
    fprintf(out, ",\"form\":\"%s\"", name);
    json_int_t since = json_integer_value(json_object_get(written_forms, name));
    json_object_set_new(written_forms, name, json_integer((since + 1) % LINES_OF_A_FORM));
    if (since > 0)
        return;
    json_t *form = json_object();
    json_object_foreach(record, member, value) if (!is_beside(member))
        json_object_set_new(form, member, empty(value, has_own_texts(member)));
    fputs(",\"is\":", out);
    json_dumpf(form, out, JSON_COMPACT);
    json_decref(form);
}

void study_form_write(json_t *record, json_t *written_forms, FILE *out)
{
    const json_t *parameters = json_object_get(record, "parameters");
    const json_t *log = json_object_get(record, "log");
    const char *name;
    json_t *member;
    bool any = false;
    fprintf(out, "{\"case\":%" JSON_INTEGER_FORMAT ",\"key\":\"%s\",\"status\":\"%s\"",
            json_integer_value(json_object_get(record, "case")),
            json_string_value(json_object_get(record, "key")),
            json_string_value(json_object_get(record, "status")));
    if (log) {
        fputs(",\"log\":", out);
        json_dumpf(log, out, JSON_COMPACT);
    }
    put_form(record, written_forms, out);
    fputs(",\"values\":[", out);
    json_object_foreach(record, name, member) if (!is_beside(name))
        put_values(member, has_own_texts(name), &any, out);
    fputc(']', out);
    if (json_object_size(parameters)) {
        fputs(",\"parameters\":", out);
        json_dumpf(parameters, out, JSON_COMPACT);
    }
}

/* Returns a copy of the form, filled with the next values. If there are too few values, *next is
   set beyond their number. */
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
