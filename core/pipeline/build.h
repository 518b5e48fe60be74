/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Shared by the files of core/pipeline alone. */
#ifndef FF_BUILD_H
#define FF_BUILD_H

#include "pipeline.h"

#include "../value/memory.h"

/* The live object of a stage, and what its building has found out. */
typedef struct ff_instance {
    ff_host host; /* given to the model; outlives `self` */
    void *self;
    bool alive;   /* created, set, wired and ready */
    bool created; /* `self` must be destroyed */
    bool sought;  /* the model was asked for */
    bool linked;  /* its wires were looked at */
    bool broken;  /* the report says why it cannot run */
    ff_stage *stage;
    uint64_t demanded; /* outputs that must be given: asked for by name, or a required input's */

    const ff_watch *watch;
    bool evaluating;
    char item[96];   /* of the last host->fail */
    char text[512];  /* the same */
    char fault[256]; /* how the plugin broke the interface: completes 'the plugin x.so ...' */
    size_t quality_room;
} ff_instance;

struct ff_pipeline_memory {
    ff_arena arena;
    ff_place study; /* where the file asks for a study; source NULL: it does not */
};

typedef struct ff_build {
    ff_pipeline *pipeline;
    ff_library *library;
    ff_report *report;
    bool everything;
} ff_build;

char *ff_pipeline_print(ff_pipeline *pipeline, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/* read.c: format, title and the stages with their `use`. False when there are no stages. */
bool ff_read_stages(ff_build *b, const ff_node *root);
int ff_find_stage(const ff_pipeline *pipeline, const char *name, size_t length); /* -1: none */
const char *ff_nearest_stage(const ff_pipeline *pipeline, const char *name);

/* Loads the stage's model when it is not; false after an error. */
bool ff_load_stage(ff_build *b, ff_stage *stage);

/* wire.c: finds what feeds each wire of a loaded stage. */
void ff_link_stage(ff_build *b, ff_stage *stage);
/* The result that feeds input row `input`; NULL: not connected, or a service. */
ff_result *ff_feeding_result(const ff_pipeline *pipeline, const ff_stage *stage, size_t input);
/* The wire of input row `input`. */
const ff_wire *ff_input_wire(const ff_stage *stage, size_t input);
/* The service output of `from` with that interface id, or -1. */
int ff_find_service(const ff_loaded *from, const char *service);

/* request.c: marks the requested outputs; links what they need. */
void ff_request_outputs(ff_build *b, const ff_node *outputs);
bool ff_is_field(const ff_loaded *loaded, size_t output);

/* order.c: links all that the linked stages need, and says what is needed, why and in which order.
 */
void ff_link_from(ff_build *b, size_t stage);
void ff_mark_needed(ff_build *b);
void ff_sort_stages(ff_build *b);

/* bind.c: reads the parameters of a linked stage. */
void ff_bind_stage(ff_build *b, ff_stage *stage);

/* What the file says for a parameter or wire of `model`: written on the stage, or in the set that
   stands for the model under `with`. */
typedef struct ff_setting {
    const ff_node *node; /* NULL: nothing */
    uint64_t priority;   /* the later layer wins; in one layer the stage's own key */
} ff_setting;

ff_setting ff_find_setting(const ff_stage *stage, const char *model, const char *path);

/* instance.c: create, set, wire, ready; destroy. */
void ff_open_instance(ff_build *b, ff_stage *stage);
void ff_close_instance(ff_stage *stage);

/* host.c: what a model may call. */
void ff_host_init(ff_instance *instance);
void ff_forget_results(ff_stage *stage);

/* Clears what earlier calls said. */
void ff_instance_hush(ff_instance *instance);
/* Turns the status of a call, and what the model said or did in it, into messages. True when the
   call was good. `action` is "evaluate" and the like. */
bool ff_judge(const ff_stage *stage, const char *action, ff_status status, ff_report *report);
/* The place of a parameter, input or output of the stage; else that of the stage. */
ff_place ff_item_place(const ff_stage *stage, const char *item, const char **name);

#endif
