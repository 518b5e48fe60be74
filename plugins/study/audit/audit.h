/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The audit of a study whose models are chosen by the program: some of its cases are computed once
 * more, one level finer, to see whether what was promised of their error holds.
 */
#ifndef STUDY_AUDIT_H
#define STUDY_AUDIT_H

#include "../compare.h"
#include "../result.h"

enum { STUDY_EVERY, STUDY_SEED, STUDY_OUTPUTS, STUDY_INPUTS, STUDY_SETTINGS };

/* An output that is compared, and the series of the same stage that it is plotted against. */
typedef struct study_item {
    const char *output; /* "stage.output" */
    const char *stage;
    const char *axis; /* "stage.output"; NULL: none */
} study_item;

typedef enum study_probe_kind {
    STUDY_PROBE_BASE,  /* the case as it stands */
    STUDY_PROBE_FINER, /* one stage one level finer, by the same model */
    STUDY_PROBE_EXACT, /* one stage as exact as that, by any model of its kind */
    STUDY_PROBE_UP,    /* an input larger by its uncertainty */
    STUDY_PROBE_DOWN,
    STUDY_PROBE_HELD /* as it stands, with its choices held */
} study_probe_kind;

/* A case beside those of the study. */
typedef struct study_probe {
    size_t subject;
    study_probe_kind kind;
    const char *of;    /* the stage, or the input's path */
    const char **sets; /* laid over the study's case */
    size_t set_count;
    size_t number;                 /* of the case */
    const ff_study_answer *answer; /* NULL: it has not run */
    json_t *record;                /* of the answer; or NULL */
} study_probe;

/* A case of the study that is audited. */
typedef struct audit_subject {
    size_t index;
    study_item *items;
    size_t item_count;
    const char **request; /* those with what they are plotted against */
    size_t request_count;
    const char **whole; /* those and all others that the study asks for */
    size_t whole_count;
    size_t base;         /* the probe of it as it stands, when there is no trouble */
    size_t begin, end;   /* those of its others */
    bool chooses;        /* some stage of it */
    const char *trouble; /* why it cannot be audited; NULL: it can */
} audit_subject;

typedef struct study_audit {
    const ff_host *host;
    ff_study_model service;
    const ff_written *settings[STUDY_SETTINGS];
    int64_t every, seed; /* one case in so many; draws which */
    const char **outputs;
    size_t output_count;
    const ff_written *inputs; /* a map from paths to standard uncertainties; NULL: none */

    const ff_study_desk *desk;
    ff_study_plan *plan;
    size_t cases; /* of the study */
    audit_subject *subjects;
    size_t subject_count;
    study_probe *probes;
    size_t probe_count;
} study_audit;

/* read.c */
ff_status study_audit_plan(void *self, const ff_study_desk *desk, ff_study_plan *plan);
ff_status study_audit_check(void *self, const ff_study_desk *desk, size_t cases);
const ff_study_stage *study_find_stage(const ff_study_look *look, const char *path);
const ff_param *study_param_row(const ff_model *model, size_t param);
const ff_port *study_output_row(const ff_model *model, size_t output);
size_t study_find_output(const ff_study_stage *stage,
                         const char *name);         /* SIZE_MAX: there is none */
bool study_is_field(const ff_port *row);            /* or a service */
const char *study_dimension_of(const ff_port *row); /* of a series; NULL: it is none */

/* audit.c: how many cases are audited. */
size_t study_audit_count(const study_audit *a);

/* items.c: finds what is compared, of a case that was looked at. */
void study_find_items(const study_audit *a, audit_subject *s, const ff_study_look *look);

/* probe.c: asks for the case of a subject as it stands; for the others, when that has run. */
void study_ask_base(study_audit *a, size_t subject);
void study_ask_others(study_audit *a, size_t subject, const json_t *choices);
/* Probe number i of the subject; NULL: it has no more. */
const study_probe *study_probe_at(const study_audit *a, size_t subject, size_t i);
/* NULL: there is none, or it failed. */
const study_probe *study_find_probe(const study_audit *a, size_t subject, study_probe_kind kind,
                                    const char *of);
bool study_is_good(const ff_study_answer *answer);

/* judge.c: what it comes to. */
json_t *study_audit_result(const study_audit *a);

/* print.c, figure.c */
void study_audit_print(const ff_study_desk *desk, const json_t *result);
void study_audit_table(const json_t *result, FILE *out);
void study_audit_draw(const json_t *result, FILE *out);

#endif
