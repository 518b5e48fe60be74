/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * How far a run, or a case of a study, can be trusted, in two verdicts. That of the numbers is the
 * worst of the quality lines that judge them, or that it failed, with the lines that are not good
 * and the warnings as its reasons. That of the range says which models are used outside of it.
 */
#ifndef STUDY_JUDGEMENT_H
#define STUDY_JUDGEMENT_H

#include "../../limits/limits.h"

/* FF_GOOD, FF_DOUBTFUL and FF_BAD; a row of a spectrum whose input is beyond the limits of what can
   be computed; and a case without numbers that no line calls bad. */
enum { STUDY_CASE_REFUSED = FF_BAD + 1, STUDY_CASE_FAILED, STUDY_VERDICTS };

/* What is said of it in words, "inlet heating", the worst first: of the numbers, of models outside
   of their range, and doubts that the file accepts. */
typedef enum { STUDY_REASONS, STUDY_RANGE, STUDY_ACCEPTED, STUDY_LISTS } study_list;
typedef struct study_words {
    char **words;
    size_t count;
} study_words;

typedef struct study_judgement {
    int verdict;
    study_words lists[STUDY_LISTS];
    size_t limits; /* how the case stands to those of the file: 1 + limits_standing; 0: none are
                      known */
} study_judgement;

double study_json_number(const json_t *value); /* NaN where it is none */
extern const char study_refused[]; /* "refused": the status of such a row, and its verdict */
const char *study_verdict_name(int verdict); /* "good", "doubtful", "bad", "refused", "failed" */

/* Judges the record of a case by its status, lines, warnings and what is known from below alone,
   and adds the judgement to it. */
void study_judge_record(json_t *record);
/* Whether a warning says that a parameter is outside of the range that a model was made for. */
bool study_warning_of_range(const char *text);
/* Whether a line [value, limit, verdict, ..., true] of a record is of the range of a model. */
bool study_line_of_range(const json_t *line);
/* Takes what study_judgement_add added, and how the case stands to limits. False when there is no
   verdict: a case that failed. */
bool study_judgement_read(study_judgement *judgement, const json_t *object);
/* Names of the requested outputs that are known from below alone: ["film.p_max_highest"]. */
json_t *study_list_least(const ff_pipeline *pipeline);
/* Judges what a pipeline has computed; `failed` says that the run ended with an error. */
study_judgement study_judge_pipeline(const ff_pipeline *pipeline, bool failed);
void study_judgement_free(study_judgement *judgement);
/* One of the lists, "a, b", to be freed. */
char *study_judgement_text(const study_judgement *judgement, study_list list);
/* Adds "verdict", "reasons" and, unless they are empty, "range" and "accepted" to an object. */
void study_judgement_add(const study_judgement *judgement, json_t *object);

/* The judgements of many cases. */
enum { STUDY_MOST_JUDGED = 10000 }; /* cases that are listed one by one */
typedef struct study_tally {
    size_t counts[STUDY_VERDICTS];
    size_t limits[LIMITS_STANDINGS]; /* cases that are judged by limits, by the worst of them */
    json_t *reasons[STUDY_VERDICTS]; /* {reason: number of cases}; NULL while there are none */
    size_t cases_of[STUDY_LISTS];    /* cases with something in that list */
    json_t *words_of[STUDY_LISTS];   /* {line: number of cases} but for the reasons; or NULL */
    json_t *cases; /* [{case, key, verdict, reasons}]; NULL while there are none */
} study_tally;

/* Adds a case by its number, from 1 on, and its key. */
void study_tally_add(study_tally *tally, size_t number, const char *key,
                     const study_judgement *judgement);
/* Adds the cases of `part`, which is emptied. */
void study_tally_merge(study_tally *tally, study_tally *part);
void study_tally_free(study_tally *tally);
/* Returns "12 good, 4 doubtful (periodicity 4); outside the range of a model 16 (lambda 16);
   accepted 3 (draft 3); limits: 10 met, 6 missed", to be freed; the most frequent reasons come
   first. */
char *study_tally_text(const study_tally *tally);
/* Adds "verdict", the worst one, "counts" {good, doubtful, bad, refused,
   failed}, "reasons" [{reason, verdict, cases}], the most frequent first, "range" and "accepted"
   {cases, reasons [{reason, cases}]}, and "judged", a list of the cases in their order; that is
   null when there are more than STUDY_MOST_JUDGED. */
void study_tally_describe(const study_tally *tally, json_t *object);

#endif
