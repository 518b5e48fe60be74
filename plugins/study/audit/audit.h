/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The audit of a study whose models are chosen by the program: some of its cases are computed once
 * more, one level finer, to see whether what was promised of their error holds.
 */
#ifndef FF_AUDIT_H
#define FF_AUDIT_H

#include "../compare.h"
#include "../result.h"

enum { FF_EVERY, FF_SEED, FF_OUTPUTS, FF_INPUTS, FF_SETTINGS };

/* An output that is compared, and the series of the same stage that it is plotted against. */
typedef struct ff_item {
    const char *output; /* "stage.output" */
    const char *stage;
    const char *axis; /* "stage.output"; NULL: none */
} ff_item;

typedef enum ff_probe_kind {
    FF_PROBE_BASE,  /* the case as it stands */
    FF_PROBE_FINER, /* one stage one level finer, by the same model */
    FF_PROBE_EXACT, /* one stage as exact as that, by any model of its kind */
    FF_PROBE_UP,    /* an input larger by its uncertainty */
    FF_PROBE_DOWN,
    FF_PROBE_HELD /* as it stands, with its choices held */
} ff_probe_kind;

/* A case beside those of the study. */
typedef struct ff_probe {
    size_t subject;
    ff_probe_kind kind;
    const char *of;    /* the stage, or the input's path */
    const char **sets; /* laid over the study's case */
    size_t set_count;
    size_t number;                 /* of the case */
    const ff_study_answer *answer; /* NULL: it has not run */
    json_t *record;                /* of the answer; or NULL */
} ff_probe;

/* A case of the study that is audited. */
typedef struct ff_subject {
    size_t index;
    ff_item *items;
    size_t item_count;
    const char **request; /* those with what they are plotted against */
    size_t request_count;
    const char **whole; /* those and all others that the study asks for */
    size_t whole_count;
    size_t base;         /* the probe of it as it stands, when there is no trouble */
    size_t begin, end;   /* those of its others */
    bool chooses;        /* some stage of it */
    const char *trouble; /* why it cannot be audited; NULL: it can */
} ff_subject;

typedef struct ff_audit {
    const ff_host *host;
    ff_study_model service;
    const ff_written *settings[FF_SETTINGS];
    int64_t every, seed; /* one case in so many; draws which */
    const char **outputs;
    size_t output_count;
    const ff_written *inputs; /* a map from paths to standard uncertainties; NULL: none */

    const ff_study_desk *desk;
    ff_study_plan *plan;
    size_t cases; /* of the study */
    ff_subject *subjects;
    size_t subject_count;
    ff_probe *probes;
    size_t probe_count;
} ff_audit;

/* read.c */
ff_status ff_audit_plan(void *self, const ff_study_desk *desk, ff_study_plan *plan);
ff_status ff_audit_check(void *self, const ff_study_desk *desk, size_t cases);
const ff_study_stage *ff_find_stage(const ff_study_look *look, const char *path);
const ff_param *ff_param_row(const ff_model *model, size_t param);
const ff_port *ff_output_row(const ff_model *model, size_t output);
size_t ff_find_output(const ff_study_stage *stage, const char *name); /* SIZE_MAX: there is none */
bool ff_is_field(const ff_port *row);                                 /* or a service */
const char *ff_dimension_of(const ff_port *row); /* of a series; NULL: it is none */

/* audit.c: how many cases are audited. */
size_t ff_audit_count(const ff_audit *a);

/* items.c: finds what is compared, of a case that was looked at. */
void ff_find_items(const ff_audit *a, ff_subject *s, const ff_study_look *look);

/* probe.c: asks for the case of a subject as it stands; for the others, when that has run. */
void ff_ask_base(ff_audit *a, size_t subject);
void ff_ask_others(ff_audit *a, size_t subject, const json_t *choices);
/* Probe number i of the subject; NULL: it has no more. */
const ff_probe *ff_probe_at(const ff_audit *a, size_t subject, size_t i);
/* NULL: there is none, or it failed. */
const ff_probe *ff_find_probe(const ff_audit *a, size_t subject, ff_probe_kind kind,
                              const char *of);
bool ff_is_good(const ff_study_answer *answer);

/* judge.c: what it comes to. */
json_t *ff_audit_result(const ff_audit *a);

/* print.c, figure.c */
void ff_audit_print(const ff_study_desk *desk, const json_t *result);
void ff_audit_table(const json_t *result, FILE *out);
void ff_audit_draw(const json_t *result, FILE *out);

#endif
