/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Judges cases by their records, and counts the verdicts of many cases. */
#include "judgement.h"

#include "../../accuracy/lines.h"
#include "../../memory/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A quality line that is not good, or a warning. */
typedef struct doubt {
    char *words;
    int verdict;
    study_list list;
    double beyond; /* how far it exceeds its limit, on a logarithmic scale */
} doubt;

typedef struct doubts {
    doubt *lines;
    size_t count;
} doubts;

double study_json_number(const json_t *value)
{
    return json_is_number(value) ? json_number_value(value) : (double)NAN;
}

const char study_refused[] = "refused";
static const char *const names_of_lists[STUDY_LISTS] = {"reasons", "range", "accepted"};

const char *study_verdict_name(int verdict)
{
    return verdict == STUDY_CASE_FAILED    ? "failed"
           : verdict == STUDY_CASE_REFUSED ? study_refused
                                           : ff_verdict_name(verdict);
}

/* Writes the name of a quality line in words: inlet_heating becomes "inlet heating". */
static char *words_of(const char *name)
{
    char *words = memory_copy_text(name, strlen(name));
    for (char *c = words; *c; c++)
        *c = *c == '_' ? ' ' : *c;
    return words;
}

static double beyond_limit(double value, double limit)
{
    value = fabs(value);
    limit = fabs(limit);
    return value > 0 && limit > 0 && isfinite(value) ? fabs(log(value / limit)) : HUGE_VAL;
}

/* Adds a reason and takes ownership of its text. Lines with the same name from several stages are
   combined to the worst one. */
static void add_reason(doubts *all, doubt made)
{
    for (size_t i = 0; i < all->count; i++) {
        doubt *known = &all->lines[i];
        if (strcmp(known->words, made.words) != 0 || known->list != made.list)
            continue;
        known->beyond = fmax(known->beyond, made.beyond);
        known->verdict = known->verdict > made.verdict ? known->verdict : made.verdict;
        free(made.words);
        return;
    }
    all->lines = memory_resize(all->lines, (all->count + 1) * sizeof *all->lines);
    all->lines[all->count++] = made;
}

/* Adds a quality line that is not good, or whose doubt is accepted. */
static void add_line(doubts *all, const char *name, double value, double limit, int verdict,
                     study_list list)
{
    if (verdict != FF_GOOD || list == STUDY_ACCEPTED)
        add_reason(all, (doubt){words_of(name), verdict, list, beyond_limit(value, limit)});
}

bool study_warning_of_range(const char *text)
{
    return strstr(text + strcspn(text, ":"), " is outside the calibrated range") != NULL;
}

/* Shortens a warning so that equal warnings of different cases can be counted: "film.z: 3 is
   outside the calibrated range, ..." becomes "film.z outside its calibrated range". Any other
   warning is shortened to its first clause. */
static char *words_of_warning(const char *text)
{
    size_t name = strcspn(text, ":");
    if (study_warning_of_range(text))
        return memory_print_text("%.*s outside its calibrated range", (int)name, text);
    size_t length = strcspn(text, ",;(");
    while (length > 0 && text[length - 1] == ' ')
        length--;
    return memory_copy_text(text, length);
}

/* Adds a reason that does not change the verdict, and takes ownership of its text. */
static void add_words(doubts *all, char *words)
{
    add_reason(all, (doubt){words, FF_GOOD, STUDY_REASONS, 0});
}

/* Adds an output of which only a lower bound is known, so that this is shown wherever its value is
   shown. */
static void add_least(doubts *all, const char *name)
{
    add_words(all, memory_print_text("%s only a lower bound", name));
}

static int by_gravity(const void *a, const void *b)
{
    const doubt *one = a, *other = b;
    if (one->verdict != other->verdict)
        return one->verdict > other->verdict ? -1 : 1;
    if (one->beyond < other->beyond || one->beyond > other->beyond)
        return one->beyond > other->beyond ? -1 : 1;
    return strcmp(one->words, other->words);
}

static void put_words(study_words *list, char *words)
{
    list->words = memory_resize(list->words, (list->count + 1) * sizeof *list->words);
    list->words[list->count++] = words;
}

/* Makes the judgement, and takes ownership of the lines. `failure` is the first reason of a failed
   case, or NULL. */
static study_judgement judge(doubts *all, bool failed, const char *failure)
{
    study_judgement judgement = {.verdict = failed ? STUDY_CASE_FAILED : FF_GOOD};
    if (all->count)
        qsort(all->lines, all->count, sizeof *all->lines, by_gravity);
    size_t worst = 0;
    while (worst < all->count && all->lines[worst].list != STUDY_REASONS)
        worst++;
    if (worst < all->count && (!failed || all->lines[worst].verdict == FF_BAD))
        judgement.verdict = all->lines[worst].verdict;
    if (judgement.verdict == STUDY_CASE_FAILED && failure)
        put_words(&judgement.lists[STUDY_REASONS], memory_copy_text(failure, strlen(failure)));
    for (size_t i = 0; i < all->count; i++)
        put_words(&judgement.lists[all->lines[i].list], all->lines[i].words);
    free(all->lines);
    return judgement;
}

bool study_line_of_range(const json_t *line)
{
    const size_t count = json_array_size(line);
    return count > 3 && json_is_true(json_array_get(line, count - 1));
}

void study_judge_record(json_t *record)
{
    doubts all = {0};
    const char *stage, *name, *status = json_string_value(json_object_get(record, "status"));
    json_t *lines, *line;
    json_object_foreach(json_object_get(record, "quality"), stage, lines)
        json_object_foreach(lines, name, line)
    {
        json_int_t verdict = json_integer_value(json_array_get(line, 2));
        /* this version may not know the verdict */
        bool known = verdict >= FF_GOOD && verdict <= FF_BAD;
        add_line(&all, name, study_json_number(json_array_get(line, 0)),
                 study_json_number(json_array_get(line, 1)), known ? (int)verdict : FF_BAD,
                 json_string_length(json_array_get(line, 4)) ? STUDY_ACCEPTED
                 : study_line_of_range(line)                 ? STUDY_RANGE
                                                             : STUDY_REASONS);
    }
    json_t *warning, *name_of;
    size_t i;
    json_array_foreach(json_object_get(record, "warnings"), i, warning) add_words(
        &all, words_of_warning(json_is_string(warning) ? json_string_value(warning) : "a warning"));
    json_array_foreach(json_object_get(record, "at_least"), i, name_of)
        add_least(&all, json_is_string(name_of) ? json_string_value(name_of) : "an output");
    bool plain = !status || !strcmp(status, "failed") ||
                 /* the word "refused" alone does not tell the cause */
                 !strcmp(status, study_refused);
    study_judgement judgement =
        judge(&all, !status || strcmp(status, "ok") != 0, plain ? NULL : status);
    if (status && !strcmp(status, study_refused))
        judgement.verdict = STUDY_CASE_REFUSED;
    study_judgement_add(&judgement, record);
    study_judgement_free(&judgement);
}

/* Adds the texts of a JSON list. */
static void read_words(study_words *list, const json_t *from)
{
    const json_t *word;
    size_t i;
    json_array_foreach(from, i, word)
    {
        const char *text = json_string_value(word);
        put_words(list, memory_copy_text(text ? text : "", text ? strlen(text) : 0));
    }
}

bool study_judgement_read(study_judgement *judgement, const json_t *object)
{
    const char *verdict = json_string_value(json_object_get(object, "verdict"));
    const json_t *reasons = json_object_get(object, "reasons");
    const json_t *limits = json_object_get(object, "limits");
    *judgement = (study_judgement){.verdict = FF_GOOD};
    if (json_array_size(limits) > 0)
        judgement->limits = 1 + (size_t)limits_worst(limits);
    while (verdict && judgement->verdict < STUDY_VERDICTS &&
           strcmp(study_verdict_name(judgement->verdict), verdict) != 0)
        judgement->verdict++;
    if (!verdict || !json_is_array(reasons) || judgement->verdict == STUDY_VERDICTS) {
        judgement->verdict = STUDY_CASE_FAILED;
        return false;
    }
    for (size_t l = 0; l < STUDY_LISTS; l++)
        read_words(&judgement->lists[l], json_object_get(object, names_of_lists[l]));
    return true;
}

json_t *study_list_least(const ff_pipeline *pipeline)
{
    json_t *names = json_array();
    for (size_t i = 0; i < pipeline->count; i++) {
        const ff_stage *stage = &pipeline->stages[i];
        for (size_t k = 0; stage->ran && k < stage->loaded->model->output_count; k++) {
            const ff_result *result = &stage->results[k];
            if (result->requested && result->data && accuracy_is_least(stage, result))
                json_array_append_new(names, json_sprintf("%s.%s", stage->name, result->row->name));
        }
    }
    return names;
}

study_judgement study_judge_pipeline(const ff_pipeline *pipeline, bool failed)
{
    doubts all = {0};
    for (size_t i = 0; i < pipeline->count; i++)
        for (size_t k = 0; k < pipeline->stages[i].quality_count; k++) {
            const ff_quality *line = &pipeline->stages[i].quality[k];
            add_line(&all, line->name, line->value, line->limit, line->verdict,
                     line->accepted ? STUDY_ACCEPTED
                     : line->range  ? STUDY_RANGE
                                    : STUDY_REASONS);
        }
    json_t *least = study_list_least(pipeline), *name;
    size_t i;
    json_array_foreach(least, i, name) add_least(&all, json_string_value(name));
    json_decref(least);
    return judge(&all, failed, NULL);
}

void study_judgement_free(study_judgement *judgement)
{
    for (size_t l = 0; l < STUDY_LISTS; l++) {
        for (size_t i = 0; i < judgement->lists[l].count; i++)
            free(judgement->lists[l].words[i]);
        free(judgement->lists[l].words);
    }
    *judgement = (study_judgement){.verdict = FF_GOOD};
}

char *study_judgement_text(const study_judgement *judgement, study_list list)
{
    const study_words *of = &judgement->lists[list];
    char *text = memory_print_text("%s", "");
    for (size_t i = 0; i < of->count; i++) {
        memory_add_text(&text, "%s%s", i ? ", " : "", of->words[i]);
    }
    return text;
}

void study_judgement_add(const study_judgement *judgement, json_t *object)
{
    json_object_set_new(object, "verdict", json_string(study_verdict_name(judgement->verdict)));
    for (size_t l = 0; l < STUDY_LISTS; l++) {
        const study_words *list = &judgement->lists[l];
        json_t *words = json_array();
        for (size_t i = 0; i < list->count; i++)
            json_array_append_new(words, json_string(list->words[i]));
        if (list->count > 0 || l == STUDY_REASONS)
            json_object_set(object, names_of_lists[l], words);
        json_decref(words);
    }
}

static void count_reason(json_t **reasons, const char *reason, json_int_t cases)
{
    *reasons = *reasons ? *reasons : json_object();
    json_object_set_new(
        *reasons, reason,
        json_integer(json_integer_value(json_object_get(*reasons, reason)) + cases));
}

static void list_case(study_tally *tally, const study_judgement *judgement, size_t number,
                      const char *key)
{
    tally->cases = tally->cases ? tally->cases : json_array();
    if (json_array_size(tally->cases) > STUDY_MOST_JUDGED)
        return;
    json_t *entry = json_pack("{s:I, s:s}", "case", (json_int_t)number, "key", key);
    study_judgement_add(judgement, entry);
    json_array_append_new(tally->cases, entry);
}

void study_tally_add(study_tally *tally, size_t number, const char *key,
                     const study_judgement *judgement)
{
    tally->counts[judgement->verdict]++;
    if (judgement->limits > 0)
        tally->limits[judgement->limits - 1]++;
    for (size_t l = 0; l < STUDY_LISTS; l++) {
        const study_words *list = &judgement->lists[l];
        json_t **reasons =
            l == STUDY_REASONS ? &tally->reasons[judgement->verdict] : &tally->words_of[l];
        tally->cases_of[l] += list->count > 0;
        for (size_t i = 0; i < list->count; i++)
            count_reason(reasons, list->words[i], 1);
    }
    list_case(tally, judgement, number, key);
}

static void count_reasons(json_t **reasons, json_t *part)
{
    const char *reason;
    json_t *cases;
    json_object_foreach(part, reason, cases)
        count_reason(reasons, reason, json_integer_value(cases));
}

void study_tally_merge(study_tally *tally, study_tally *part)
{
    for (int v = 0; v < STUDY_VERDICTS; v++) {
        tally->counts[v] += part->counts[v];
        count_reasons(&tally->reasons[v], part->reasons[v]);
    }
    for (size_t l = 0; l < STUDY_LISTS; l++) {
        tally->cases_of[l] += part->cases_of[l];
        count_reasons(&tally->words_of[l], part->words_of[l]);
    }
    for (int s = 0; s < LIMITS_STANDINGS; s++)
        tally->limits[s] += part->limits[s];
    if (part->cases && tally->cases)
        json_array_extend(tally->cases, part->cases);
    else if (part->cases)
        tally->cases = json_incref(part->cases);
    study_tally_free(part);
}

void study_tally_free(study_tally *tally)
{
    for (int v = 0; v < STUDY_VERDICTS; v++)
        json_decref(tally->reasons[v]);
    for (size_t l = 0; l < STUDY_LISTS; l++)
        json_decref(tally->words_of[l]);
    json_decref(tally->cases);
    *tally = (study_tally){.cases = NULL};
}

typedef struct reason_count {
    const char *reason;
    json_int_t cases;
} reason_count;

static int by_frequency(const void *a, const void *b)
{
    const reason_count *one = a, *other = b;
    if (one->cases != other->cases)
        return one->cases > other->cases ? -1 : 1;
    return strcmp(one->reason, other->reason);
}

/* Returns the reasons, the most frequent first; to be freed. */
static reason_count *sort_reasons(json_t *reasons, size_t *count)
{
    const char *reason;
    json_t *cases;
    reason_count *list = memory_alloc((json_object_size(reasons) + 1) * sizeof *list);
    *count = 0;
    json_object_foreach(reasons, reason, cases) list[(*count)++] =
        (reason_count){reason, json_integer_value(cases)};
    qsort(list, *count, sizeof *list, by_frequency);
    return list;
}

static void print_reasons(json_t *reasons, FILE *out)
{
    size_t count;
    reason_count *list = sort_reasons(reasons, &count);
    for (size_t i = 0; i < count; i++)
        fprintf(out, "%s%s %" JSON_INTEGER_FORMAT, i ? ", " : " (", list[i].reason, list[i].cases);
    fputs(count ? ")" : "", out);
    free(list);
}

char *study_tally_text(const study_tally *tally)
{
    char *text = NULL;
    size_t length = 0;
    FILE *out = memory_require(open_memstream(&text, &length));
    const char *gap = "";
    for (int v = 0; v < STUDY_VERDICTS; v++) {
        if (!tally->counts[v])
            continue;
        fprintf(out, "%s%zu %s", gap, tally->counts[v], study_verdict_name(v));
        gap = ", ";
        print_reasons(tally->reasons[v], out);
    }
    for (size_t l = STUDY_RANGE; l < STUDY_LISTS; l++) {
        if (!tally->cases_of[l])
            continue;
        fprintf(out, "; %s %zu", l == STUDY_RANGE ? "outside the range of a model" : "accepted",
                tally->cases_of[l]);
        print_reasons(tally->words_of[l], out);
    }
    gap = "; limits: ";
    for (int s = 0; s < LIMITS_STANDINGS; s++) {
        if (!tally->limits[s])
            continue;
        fprintf(out, "%s%zu %s", gap, tally->limits[s], limits_word((limits_standing)s));
        gap = ", ";
    }
    fclose(out);
    return text;
}

static int by_number(const void *a, const void *b)
{
    const json_t *const *one = a, *const *other = b;
    json_int_t first = json_integer_value(json_object_get(*one, "case"));
    json_int_t second = json_integer_value(json_object_get(*other, "case"));
    return first < second ? -1 : first > second;
}

/* Returns the cases in their order, or null if there are too many. */
static json_t *list_cases(const study_tally *tally)
{
    size_t count = json_array_size(tally->cases);
    if (count > STUDY_MOST_JUDGED)
        return json_null();
    json_t **sorted = memory_alloc((count + 1) * sizeof *sorted), *list = json_array();
    for (size_t i = 0; i < count; i++)
        sorted[i] = json_array_get(tally->cases, i);
    qsort(sorted, count, sizeof *sorted, by_number);
    for (size_t i = 0; i < count; i++)
        json_array_append(list, sorted[i]);
    free(sorted);
    return list;
}

/* Returns {met, met within its bar, missed}: the number of cases of each. */
static json_t *count_limits(const study_tally *tally)
{
    json_t *counts = json_object();
    for (int s = 0; s < LIMITS_STANDINGS; s++)
        json_object_set_new(counts, limits_word((limits_standing)s),
                            json_integer((json_int_t)tally->limits[s]));
    return counts;
}

/* Returns {cases, reasons [{reason, cases}]}. */
static json_t *describe_list(const study_tally *tally, size_t of)
{
    json_t *list = json_array();
    size_t count;
    reason_count *sorted = sort_reasons(tally->words_of[of], &count);
    for (size_t i = 0; i < count; i++)
        json_array_append_new(
            list, json_pack("{s:s, s:I}", "reason", sorted[i].reason, "cases", sorted[i].cases));
    free(sorted);
    return json_pack("{s:I, s:o}", "cases", (json_int_t)tally->cases_of[of], "reasons", list);
}

void study_tally_describe(const study_tally *tally, json_t *object)
{
    json_t *counts = json_object(), *reasons = json_array();
    int worst = FF_GOOD;
    for (int v = 0; v < STUDY_VERDICTS; v++) {
        size_t count;
        json_object_set_new(counts, study_verdict_name(v),
                            json_integer((json_int_t)tally->counts[v]));
        worst = tally->counts[v] ? v : worst;
        reason_count *list = sort_reasons(tally->reasons[v], &count);
        for (size_t i = 0; i < count; i++)
            json_array_append_new(reasons,
                                  json_pack("{s:s, s:s, s:I}", "reason", list[i].reason, "verdict",
                                            study_verdict_name(v), "cases", list[i].cases));
        free(list);
    }
    json_object_set_new(object, "verdict", json_string(study_verdict_name(worst)));
    json_object_set_new(object, "counts", counts);
    if (tally->limits[LIMITS_MET] + tally->limits[LIMITS_WITHIN] + tally->limits[LIMITS_MISSED] > 0)
        json_object_set_new(object, "limits", count_limits(tally));
    json_object_set_new(object, "reasons", reasons);
    for (size_t l = STUDY_RANGE; l < STUDY_LISTS; l++)
        if (tally->cases_of[l] > 0)
            json_object_set_new(object, names_of_lists[l], describe_list(tally, l));
    json_object_set_new(object, "judged", list_cases(tally));
}
