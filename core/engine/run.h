/* SPDX-License-Identifier: MIT */
/* A run, and the bracket around each call of it that collects its messages. */
#ifndef FE_RUN_H
#define FE_RUN_H

#include "pipeline/pipeline.h"
#include "plugin/engine.h"

struct ff_run {
    ff_engine *engine;
    fe_heap heap;
    fe_tree *tree;
    ff_report *report; /* of all steps so far */
    ff_report *said;   /* of the call in progress */
    ff_pipeline *pipeline;
    bool ready;  /* the pipeline can be started */
    bool broken; /* an allocation failed once; the run can only be closed */
    bool started, failed;
};

/* The arguments of a call. */
typedef struct fe_run_request {
    ff_run *run;
    void (*work)(struct fe_run_request *call);
    bool step;                    /* the messages of this call belong to the run */
    const char *text;             /* a file, a text, an assignment, a key, the path of a result */
    const char *name, *directory; /* of a text from memory */
    const ff_place *path, *value; /* where a file says an assignment */
    const ff_node *node;          /* to be put under a key */
    const ff_run *from;           /* the run to be copied */
    const char *const *changes;   /* assignments */
    size_t count;                 /* of them */
    const ff_observer *observer;
    bool all;  /* ff_run_build: load stages that no output needs, too; ff_run_change: make the
                  objects */
    bool done; /* the answer of the call */
} fe_run_request;

/* Makes the call. It starts with no messages. */
ff_status fe_run_call(fe_run_request *call);

#endif
