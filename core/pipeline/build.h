/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Shared by the files of core/pipeline alone. */
#ifndef FF_BUILD_H
#define FF_BUILD_H

#include "pipeline.h"

#include "../plugin/environment.h"
#include "../plugin/guard.h"
#include "../value/memory.h"
#include "../value/tables.h"

/* The live object of a stage, and what its building has found out. */
typedef struct ff_instance {
    ff_host host; /* given to the model; outlives `self` */
    void *self;
    bool created;   /* `self` must be destroyed */
    bool alive;     /* created, set, wired and ready */
    bool broken;    /* the report says why it cannot run */
    bool candidate; /* `stage` is that of a candidate */
    ff_stage *stage;
    uint64_t demanded; /* outputs that must be given: asked for by name, or a required input's */

    enum { FF_NEW, FF_ENTERED, FF_SORTED } sorting;
    const ff_stage *entering; /* the feeding stage that the sorting is looking at */

    const ff_watch *watch;
    ff_tables tables;             /* what it has read, and what was wrong: said before `text` */
    struct ff_paranoia *paranoia; /* NULL: calls are not guarded */
    bool evaluating;
    char item[96];   /* of the last host->fail */
    char text[512];  /* the same */
    char fault[256]; /* how the plugin broke the interface: completes 'the plugin x.so ...' */
} ff_instance;

struct ff_pipeline_memory {
    ff_arena arena;
    ff_library *library;
};

typedef struct ff_build {
    ff_pipeline *pipeline;
    ff_library *library;
    ff_report *report;
    bool everything, paranoid;
    const ff_node *accuracy; /* of the file, for all stages that choose; NULL: none */
} ff_build;

/* Texts that live as long as the pipeline. */
char *ff_pipeline_print(ff_pipeline *pipeline, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
const char *ff_join(ff_pipeline *pipeline, const char *list, const char *word); /* "a, b" */
/* '; did you mean "x"?' or "". */
const char *ff_did_you_mean(ff_build *b, const char *word, const char *const *words, size_t count);

const char *ff_found(const ff_node *node); /* "a map", ..., "nothing" */
/* The error '<where>: expected <what>, found a list' at the node. Returns false. */
bool ff_expected(ff_build *b, const ff_node *node, const char *where, const char *what);

/* read.c: format, title and the stages with their `use`. False when there are no stages. */
bool ff_read_stages(ff_build *b, const ff_node *root);
/* The stage of that name; NULL after an error that begins with `where`. */
ff_stage *ff_find_stage(ff_build *b, const char *name, ff_place place, const char *where);

/* Loads the stage's model when it is not; false after an error. */
bool ff_load_stage(ff_build *b, ff_stage *stage);

/* contenders.c: the stages that could stand for one that chooses, through all steps of building. */
bool ff_is_choosing(ff_build *b, const ff_stage *stage);
bool ff_load_contenders(ff_build *b, ff_stage *stage);
void ff_link_contenders(ff_build *b, ff_stage *stage);
void ff_bind_contenders(ff_build *b, ff_stage *stage);
void ff_open_contenders(ff_build *b, ff_stage *stage);
void ff_free_contenders(ff_stage *stage);
void ff_leave_out(ff_pipeline *pipeline, ff_contender *c, const char *reason);

/* choose.c: makes the choice; the feeding stages have run. False after an error. */
bool ff_choose(ff_pipeline *pipeline, ff_stage *stage, ff_report *report);
/* The same for all laws, when the first stage that judges one is about to run. */
bool ff_choose_laws(ff_pipeline *pipeline, ff_report *report);
/* Adds what was promised to the quality of the stage. */
void ff_note_choice(ff_stage *stage);

/* What is wanted of the stage is wanted of the candidate. NULL, or a needed output it lacks. */
const char *ff_pass_requests(const ff_stage *from, ff_stage *to);
uint64_t ff_wanted_of(const ff_stage *stage);
/* Another instance, which knows the parameters and the wires as they are now. */
bool ff_reopen(ff_pipeline *pipeline, ff_stage *stage, ff_report *report);

/* judge.c: laws that are chosen. */
void ff_find_reference(ff_build *b, ff_stage *stage);
/* The stage that serves until the choice is made. */
ff_stage *ff_serving(ff_stage *stage);
/* Whether the stage judges a law that is to be chosen. */
bool ff_is_judge(const ff_pipeline *pipeline, const ff_stage *stage);
/* Adds what the judges say to the assessments of the candidates. False after an error. */
bool ff_ask_judges(ff_pipeline *pipeline, ff_stage *law, ff_report *report);
/* Gives the chosen laws to their judges. */
bool ff_rewire_judges(ff_pipeline *pipeline, ff_report *report);

/* evaluate.c: what feeds the stage, one array per input row. False when a feeding stage has not
   run, which is known already, or with an error. */
bool ff_gather_inputs(const ff_pipeline *pipeline, const ff_stage *stage, ff_array *in,
                      ff_report *report);

/* wire.c: one wire for each word before the dot in the names of the input rows, and what feeds
   each. */
void ff_link_stage(ff_build *b, ff_stage *stage);

/* wire.c: finds what feeds each wire of the stage, and of the stages behind them. */
void ff_link_from(ff_build *b, ff_stage *stage);
bool ff_is_on_wire(const char *input, const char *wire); /* "gear.teeth" is on "gear" */
const ff_wire *ff_input_wire(const ff_stage *stage, size_t input);
/* The output or service of `from` that an input row takes, or -1. */
int ff_find_offer(const ff_loaded *from, const ff_port *input);

/* request.c: marks the requested outputs; links what they need. */
void ff_request_outputs(ff_build *b, const ff_node *outputs);

/* order.c: which stages run, why, and in which order. */
void ff_mark_needed(ff_pipeline *pipeline);
void ff_sort_stages(ff_build *b);

/* bind.c: reads the parameters of a linked stage. */
void ff_bind_stage(ff_build *b, ff_stage *stage);

/* What the file says for a parameter or wire of `model`: written on the stage, or in the set that
   stands for the model under `with`. */
typedef struct ff_setting {
    const ff_node *node; /* NULL: nothing */
    uint64_t priority;   /* the later layer wins; in one layer the stage's own key */
    bool displaced;      /* a parameter whose preset gives way to another of its group */
} ff_setting;

ff_setting ff_find_setting(const ff_stage *stage, const char *model, const char *path);

/* instance.c: create, set, wire, ready; destroy. */
void ff_open_instance(ff_build *b, ff_stage *stage);
void ff_close_instance(ff_stage *stage);

/* call.c: a call into a model, from before to after. `action` is "evaluate" and the like. */
typedef struct ff_call {
    const ff_stage *stage;
    const char *action;
    ff_environment environment;
    ff_guard_mark mark;
} ff_call;

ff_call ff_call_begin(const ff_stage *stage, const char *action);
/* Sets back what the model must leave alone, and turns the status of the call, and what the model
   said or did in it, into messages. True when the call was good. */
bool ff_call_end(const ff_call *call, ff_status status, ff_report *report);
/* 'the plugin x.so <what>' at the stage's model. Returns false. */
bool ff_blame(const ff_stage *stage, ff_report *report, const char *what);

/* carry.c: the state of a chain, before and after evaluate; nothing outside of one. False after an
   error. */
bool ff_carry_in(const ff_pipeline *pipeline, ff_stage *stage, ff_report *report);
bool ff_carry_out(const ff_pipeline *pipeline, ff_stage *stage, ff_report *report);

/* paranoid.c: guards around the calls of an instance. */
void ff_paranoia_begin(ff_instance *instance);
void ff_paranoia_end(ff_instance *instance);
/* Around any call; `changed` is what the environment said. False after an error. */
void ff_paranoia_enter(ff_instance *instance);
bool ff_paranoia_leave(const ff_stage *stage, const char *changed, const char *action,
                       ff_report *report);
/* The table of a law with its calls watched, or as it is. */
const void *ff_paranoia_watch(ff_build *b, ff_stage *stage, const ff_stage *law,
                              const char *service, const void *table);
/* Around evaluate: breaches go to instance->fault. */
void ff_paranoia_before(ff_stage *stage, const ff_array *in);
void ff_paranoia_after(ff_stage *stage, const ff_array *in);

/* host.c: what a model may call. */
void ff_add_quality(ff_stage *stage, const char *name, double value, double limit, int verdict,
                    const char *text);
void ff_host_init(ff_instance *instance);
void ff_forget_results(ff_stage *stage);

#endif
