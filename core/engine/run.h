/* SPDX-License-Identifier: MIT */
/* A run, and the bracket around each of its calls that collects messages. */
#ifndef FE_RUN_H
#define FE_RUN_H

#include "pipeline/pipeline.h"
#include "plugin/engine.h"

struct ff_run {
    ff_engine *engine;
    fe_heap heap;
    fe_tree *tree;
    ff_report *report;      /* messages of all steps so far */
    ff_report *call_report; /* messages of the call in progress */
    ff_pipeline *pipeline;
    bool ready;  /* the pipeline is built and can be started */
    bool broken; /* an allocation failed once; the run can only be closed */
    bool started, failed;
};

/* The arguments of a call. */
typedef struct fe_run_request {
    ff_run *run;
    void (*work)(struct fe_run_request *call);
    bool step;        /* the messages of this call belong to the run */
    const char *text; /* a file, a text, an assignment, a key, or the path of a result */
    const char *name, *directory; /* for a text in memory */
    const ff_place *path, *value; /* places of the assignment in a file */
    const ff_node *node;          /* node to be stored under a key */
    const ff_run *from;           /* the run to be copied */
    const char *const *changes;   /* assignments */
    size_t count;                 /* number of assignments */
    const ff_observer *observer;
    bool all;  /* ff_run_build: also load stages that no output needs; ff_run_change: create the
                  objects */
    bool done; /* result of the call */
} fe_run_request;

/* Makes the call, which starts with no messages. */
ff_status fe_run_call(fe_run_request *call);

#endif
