/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Writes table.csv: one row per case, with the varied values and the scalar results. */
#include "table.h"

#include "csv.h"
#include "spectrum.h"

#include "../../limits/accept.h"
#include "../../limits/limits.h"

#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <unistd.h>

/* Returns the unit after a number, and sets the length of the number. Returns NULL if there is no
   number. */
static const char *unit_of(const char *value, size_t *digits)
{
    double number;
    const char *end;
    if (!ff_number_parse(value, &number, &end))
        return NULL;
    *digits = (size_t)(end - value);
    return end + strspn(end, " ");
}

/* Returns the unit common to all values, or NULL if their units differ or one of them is not a
   number. */
static const char *common_unit(const study_definition *study, const study_varied *varied)
{
    size_t digits;
    if (varied->names || study->points[varied->axis] == 0)
        return NULL;
    const char *unit = unit_of(study_varied_value(varied, 0), &digits);
    for (size_t i = 1; unit && i < study->points[varied->axis]; i++) {
        const char *other = unit_of(study_varied_value(varied, i), &digits);
        unit = other && !strcmp(unit, other) ? unit : NULL;
    }
    return unit;
}

/* Writes the next cell; NULL leaves it empty. */
static void put_text(FILE *out, const char *text)
{
    fputc(',', out);
    study_csv_write(out, text ? text : "", text ? strlen(text) : 0, false);
}

/* Writes the name of a column; the name of an axis may be any text. */
static void put_name(FILE *out, const char *name, const char *unit)
{
    char *head =
        unit && *unit ? memory_print_text("%s [%s]", name, unit) : memory_print_text("%s", name);
    put_text(out, head);
    free(head);
}

/* What at least one case contains, which decides the columns of the table. */
typedef struct table_has {
    json_t *columns;    /* {name: unit} of the outputs, in the order in which they first appear */
    bool limits, range; /* whether some case is judged by limits; whether some case uses a model
                           outside its range */
    json_t *lines;      /* {"STAGE.LINE": true} for the quality lines */
} table_has;

static void put_head(FILE *out, const study_definition *study, const char *const *units,
                     const table_has *found)
{
    const char *name;
    json_t *unit;
    fputs("case,key,status", out);
    for (size_t k = 0; k < study->varied_count; k++)
        put_name(out, study->varied[k].path, units[k]);
    if (study->spectrum)
        fprintf(out, ",%s [%s]", study_time_name, study->spectrum->shares ? "1" : "s");
    json_object_foreach(found->columns, name, unit)
        fprintf(out, ",%s [%s]", name, json_string_value(unit));
    fprintf(out, "%s,verdict,reasons%s,reason\n", found->limits ? ",limits" : "",
            found->range ? ",range" : "");
}

/* Writes the next cell and frees the text. */
static void put_made(FILE *out, char *text)
{
    put_text(out, text);
    free(text);
}

/* Writes two or three cells; they are empty for a case that has not run. */
static void put_judgement(FILE *out, const study_judgement *judgement, bool range)
{
    fprintf(out, ",%s", judgement ? study_verdict_name(judgement->verdict) : "");
    put_made(out, judgement ? study_judgement_text(judgement, STUDY_REASONS) : NULL);
    if (range)
        put_made(out, judgement ? study_judgement_text(judgement, STUDY_RANGE) : NULL);
}

static void put_row(FILE *out, const study_definition *study, const char *const *units,
                    size_t index, const char *key, const json_t *record,
                    const study_judgement *judgement, const table_has *found)
{
    const char *status = json_string_value(json_object_get(record, "status"));
    const char *reason = json_string_value(json_object_get(record, "reason")), *name;
    json_t *unit;
    fprintf(out, "%zu,%s,%s", index + 1, key, status ? status : "not run");
    for (size_t k = 0; k < study->varied_count; k++) {
        const char *value = study_value(study, k, index);
        size_t length = strlen(value);
        if (units[k])
            unit_of(value, &length);
        fputc(',', out);
        study_csv_write(out, value, length, false);
    }
    if (study->spectrum)
        fprintf(out, ",%.12g", study->spectrum->times[index]);
    json_object_foreach(found->columns, name, unit)
    {
        const json_t *pair = json_object_get(json_object_get(record, "outputs"), name);
        fputc(',', out);
        if (json_is_number(json_array_get(pair, 1)))
            fprintf(out, "%.12g", json_number_value(json_array_get(pair, 1)));
    }
    if (found->limits)
        put_made(out, limits_text(json_object_get(record, "limits")));
    put_judgement(out, record ? judgement : NULL, found->range);
    put_text(out, reason);
    fputc('\n', out);
}

/* Adds the names of the quality lines in {stage: {name: line}}. */
static void add_lines(json_t *names, json_t *quality)
{
    const char *stage, *name;
    json_t *lines, *line;
    json_object_foreach(quality, stage, lines)
    {
        json_object_foreach(lines, name, line)
        {
            char *whole = memory_print_text("%s.%s", stage, name);
            json_object_set_new(names, whole, json_true());
            free(whole);
        }
    }
}

static table_has find_columns(const study_definition *study, study_records *records,
                              char (*keys)[STUDY_KEY_SIZE])
{
    table_has found = {.columns = json_object(), .lines = json_object()};
    json_t *pair, *known = json_object();
    const char *name;
    for (size_t i = 0; i < study->count; i++) {
        const char *form = study_records_form(records, keys[i]);
        if (json_object_get(known,
                            form)) /* records of the same form have the same outputs and units */
            continue;
        if (*form)
            json_object_set_new(known, form, json_true());
        json_t *record = study_records_get(records, keys[i]);
        found.limits = found.limits || json_object_get(record, "limits");
        found.range = found.range || json_object_get(record, "range");
        add_lines(found.lines, json_object_get(record, "quality"));
        json_object_foreach(json_object_get(record, "outputs"), name, pair)
        {
            if (!json_object_get(found.columns, name))
                json_object_set(found.columns, name, json_array_get(pair, 0));
        }
        json_decref(record);
    }
    json_decref(known);
    return found;
}

/* Writes the head and one row per case, and counts the verdicts. Returns what the cases contain. */
static table_has put_table(FILE *out, const study_definition *study, study_records *records,
                           char (*keys)[STUDY_KEY_SIZE], study_tally *tally)
{
    const table_has found = find_columns(study, records, keys);
    const char **units = memory_alloc(study->varied_count * sizeof *units);
    for (size_t k = 0; k < study->varied_count; k++)
        units[k] = common_unit(study, &study->varied[k]);
    put_head(out, study, units, &found);
    for (size_t i = 0; i < study->count; i++) {
        json_t *record = study_records_get(records, keys[i]);
        study_judgement judgement;
        study_judgement_read(&judgement, record);
        put_row(out, study, units, i, keys[i], record, &judgement, &found);
        if (record)
            study_tally_add(tally, i + 1, keys[i], &judgement);
        study_judgement_free(&judgement);
        json_decref(record);
    }
    free(units);
    return found;
}

bool study_describe(const study_run *run, const study_tally *tally, ff_report *report)
{
    if (!run->describe)
        return true;
    study_file file = study_file_begin(run->directory, study_description);
    if (file.out)
        run->describe(run->ctx, run->described, tally, file.out);
    return study_file_end(&file, NULL, report);
}

static bool write_files(const study_run *run, study_records *records, char (*keys)[STUDY_KEY_SIZE],
                        study_tally *tally, ff_report *report)
{
    study_file table = study_file_begin(run->directory, "table.csv");
    if (table.out) {
        const table_has found = put_table(table.out, run->study, records, keys, tally);
        const ff_node *accept = run->pipeline->count ? run->pipeline->stages[0].accept : NULL;
        accept_check_lines(accept, found.lines, report);
        json_decref(found.columns);
        json_decref(found.lines);
    }
    return study_file_end(&table, "the journal has all cases; the same command writes the table",
                          report) &&
           study_describe(run, tally, report);
}

bool study_table_write(const study_run *run, char (*keys)[STUDY_KEY_SIZE], study_records *records,
                       ff_report *report)
{
    char *marker = memory_print_text("%s/%s", run->directory, study_marker);
    int lock = open(marker, O_RDONLY | O_CLOEXEC);
    if (lock >= 0)
        /* If several shards end at the same time, the last one writes the table with all cases. */
        flock(lock, LOCK_EX);
    study_records *own = records ? NULL : study_records_open(run->directory, false);
    study_tally tally = {.cases = NULL};
    bool good = write_files(run, records ? records : own, keys, &tally, report);
    study_tally_free(&tally);
    study_records_close(own);
    free(marker);
    if (lock >= 0)
        close(lock);
    return good;
}
