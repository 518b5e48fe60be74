/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Judges how reliable the results of a run, or of a case of a study, are. There are two verdicts.
   The verdict of the numbers is the worst one of the quality lines about numbers; its reasons are
   the lines that are not good, and the warnings. A failed case has the verdict "failed", or "bad"
   if one of its lines is bad. The verdict of the range says which models are used outside their
   range. */
#ifndef STUDY_JUDGEMENT_H
#define STUDY_JUDGEMENT_H

#include "../../limits/limits.h"

/* The verdicts after FF_GOOD, FF_DOUBTFUL and FF_BAD: a row of a spectrum that cannot be
 * computed because its input is beyond limits, and a case without numbers although no line is
 * bad. */
enum { STUDY_CASE_REFUSED = FF_BAD + 1, STUDY_CASE_FAILED, STUDY_VERDICTS };

/* Lists of reasons in words, "inlet heating", the worst first: about the numbers, about models
 * outside their range, and doubts that the file accepts. */
typedef enum { STUDY_REASONS, STUDY_RANGE, STUDY_ACCEPTED, STUDY_LISTS } study_list;
typedef struct study_words {
    char **words;
    size_t count;
} study_words;

typedef struct study_judgement {
    int verdict;
    study_words lists[STUDY_LISTS];
    size_t limits; /* how the case meets the limits of the file: 1 + limits_standing; 0: unknown */
} study_judgement;

double study_json_number(const json_t *value); /* returns NaN if it is not a number */
/* "refused": status and verdict of a row that cannot be computed */
extern const char study_refused[];
const char *study_verdict_name(int verdict); /* "good", "doubtful", "bad", "refused", "failed" */

/* Judges the record of a case by its status, quality lines, warnings, and outputs of which only a
   lower bound is known. Adds the judgement to the record. */
void study_judge_record(json_t *record);
/* Returns whether a warning is about a parameter outside the range for which a model is made. */
bool study_warning_of_range(const char *text);
/* Returns whether a quality line [value, limit, verdict, ..., true] of a record is about the range
   of a model. */
bool study_line_of_range(const json_t *line);
/* Reads what study_judgement_add has added, and whether limits are met. Returns false if there is
   no verdict, as for a failed case. */
bool study_judgement_read(study_judgement *judgement, const json_t *object);
/* Returns the names of the requested outputs of which only a lower bound is known:
 * ["film.p_max_highest"]. */
json_t *study_list_least(const ff_pipeline *pipeline);
/* Judges the results of a pipeline. `failed`: the run ended with an error. */
study_judgement study_judge_pipeline(const ff_pipeline *pipeline, bool failed);
void study_judgement_free(study_judgement *judgement);
/* Returns one of the lists as "a, b", to be freed. */
char *study_judgement_text(const study_judgement *judgement, study_list list);
/* Adds "verdict", "reasons" and, unless empty, "range" and "accepted" to an object. */
void study_judgement_add(const study_judgement *judgement, json_t *object);

/* Counts the judgements of many cases. */
enum { STUDY_MOST_JUDGED = 10000 }; /* at most this many cases are listed one by one */
typedef struct study_tally {
    size_t counts[STUDY_VERDICTS];
    size_t limits[LIMITS_STANDINGS]; /* number of cases for each standing; the worst limit of a
                                        case counts */
    json_t *reasons[STUDY_VERDICTS]; /* {reason: number of cases}; NULL if there are none */
    size_t cases_of[STUDY_LISTS];    /* number of cases with an entry in that list */
    json_t *words_of[STUDY_LISTS];   /* {entry: number of cases}, for the other lists; or NULL */
    json_t *cases;                   /* [{case, key, verdict, reasons}]; NULL if there are none */
} study_tally;

/* Adds a case with its number, from 1, and its key. */
void study_tally_add(study_tally *tally, size_t number, const char *key,
                     const study_judgement *judgement);
/* Adds the cases of `part`, and empties `part`. */
void study_tally_merge(study_tally *tally, study_tally *part);
void study_tally_free(study_tally *tally);
/* Returns the counts as a text, to be freed, with the most frequent reasons first: "12 good, 4
 * doubtful (periodicity 4); outside the range of a model 16 (lambda 16); accepted 3 (draft 3);
 * limits: 10 met, 6 missed". */
char *study_tally_text(const study_tally *tally);
/* Adds "verdict", the worst one; "counts" {good, doubtful, bad, refused, failed}; "reasons"
 * [{reason, verdict, cases}], the most frequent first; "range" and "accepted" {cases, reasons
 * [{reason, cases}]}; and "judged", the list of cases in their order, or null if there are more
 * than STUDY_MOST_JUDGED. */
void study_tally_describe(const study_tally *tally, json_t *object);

#endif
