/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Shared by the files of the audit alone. */
#ifndef FF_AUDIT_PRIVATE_H
#define FF_AUDIT_PRIVATE_H

#include "audit.h"
#include "private.h"

/* An output that is compared, and the series of the same stage that it is plotted against. */
typedef struct ff_audited {
    const char *output; /* "stage.output" */
    const char *stage;
    const char *axis; /* "stage.output"; NULL: none */
} ff_audited;

enum ff_probe_kind {
    FF_PROBE_BASE,  /* the case as it stands */
    FF_PROBE_FINER, /* one stage one level finer, by the same model */
    FF_PROBE_EXACT, /* one stage as exact as that, by any model of its kind */
    FF_PROBE_UP,    /* an input larger by its uncertainty */
    FF_PROBE_DOWN
};

/* A case beside those of the study. */
typedef struct ff_probe {
    size_t subject;
    enum ff_probe_kind kind;
    const char *of; /* the stage, or the input's path */
    json_t *set;    /* {path: value}, laid over the study's case */
    char key[FF_KEY_SIZE];
    const json_t *record; /* NULL: it did not run */
    json_t *arrays;       /* series, {output: {data}}; NULL: none */
} ff_probe;

/* A case of the study that is audited. */
typedef struct ff_subject {
    size_t index;
    char key[FF_KEY_SIZE]; /* in the study */
    ff_audited *items;
    size_t item_count;
    bool chooses;        /* some stage of it */
    const char *trouble; /* why it cannot be audited; NULL: it can */
} ff_subject;

typedef struct ff_auditing {
    const ff_campaign *campaign;
    const ff_audit *audit;
    ff_subject *subjects;
    size_t subject_count;
    ff_probe *probes;
    size_t probe_count;
    json_t *records;
    ff_arena arena;
} ff_auditing;

/* NULL: there is none, or it failed. */
const ff_probe *ff_find_probe(const ff_auditing *a, size_t subject, enum ff_probe_kind kind,
                              const char *of);

/* audit-judge.c: what it comes to. */
json_t *ff_audit_result(const ff_auditing *a);

#endif
