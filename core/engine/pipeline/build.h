/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Shared by the files of core/engine/pipeline alone; each file uses those above it alone. */
#ifndef FE_BUILD_H
#define FE_BUILD_H

#include "pipeline.h"

#include "../plugin/environment.h"
#include "../plugin/guard.h"
#include "../value/memory.h"
#include "../value/tables.h"

/* The object of the model of a stage, and what building has found out about it. */
typedef struct fe_instance {
    ff_host host; /* given to the model; outlives `self` */
    void *self;
    bool created;   /* `self` must be destroyed */
    bool alive;     /* created, set, wired and ready */
    bool broken;    /* the report says why it cannot run */
    bool candidate; /* `stage` is that of a candidate */
    fe_stage *stage;

    enum { FE_NEW, FE_ENTERED, FE_SORTED } sorting;
    const fe_stage *entering; /* the feeding stage that is being sorted */

    const fe_watch *watch;
    fe_heap *heap;    /* of what the functions of the host allocate */
    fe_resource open; /* `self`, from create to destroy */
    bool no_memory;   /* a function of the host had none: the call is left when it returns */
    fe_tables tables; /* what it has read; their errors are reported before `text` */
    bool evaluating;
    char item[96];   /* of the last host->fail */
    char text[512];  /* the same */
    char fault[256]; /* how the plugin broke the interface: completes 'the plugin x.so ...' */
} fe_instance;

struct fe_pipeline_memory {
    fe_arena arena;
    fe_library *library;
};

typedef struct fe_build {
    fe_pipeline *pipeline;
    fe_library *library;
    fe_report *report;
    bool everything;
    const fe_node *accuracy; /* of the file, for all stages that choose; NULL: none */
} fe_build;

/* messages.c: texts that live as long as the pipeline. */
char *fe_pipeline_print(fe_pipeline *pipeline, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
const char *fe_join(fe_pipeline *pipeline, const char *list, const char *word); /* "a, b" */
/* '; did you mean "x"?' or "". */
const char *fe_did_you_mean(fe_build *b, const char *word, const char *const *words, size_t count);
const char *fe_found(const fe_node *node); /* "a map", ..., "nothing" */
/* Reports '<where>: expected <what>, found a list' at the node. Returns false. */
bool fe_expected(fe_build *b, const fe_node *node, const char *where, const char *what);

/* setting.c: the node at "a.b" behind maps within maps; NULL: there is none. */
const fe_node *fe_find_node(const fe_node *map, const char *path);
/* The map that stands for the model under `with`; NULL: there is none. */
const fe_node *fe_model_set(const fe_stage *stage, const char *model);

/* What the file says for a parameter or wire of `model`: written on the stage, or in the set that
   stands for the model under `with`. */
typedef struct fe_setting {
    const fe_node *node; /* NULL: nothing */
    uint64_t priority;   /* the later layer wins; in one layer the stage's own key */
    bool displaced;      /* a parameter whose preset gives way to another of its group */
} fe_setting;

fe_setting fe_find_setting(const fe_stage *stage, const char *model, const char *path);

/* ports.c */
bool fe_is_on_wire(const char *input, const char *wire); /* "gear.teeth" is on "gear" */
const char *fe_output_name(const ff_port *input);        /* what it takes: "teeth" */
const fe_wire *fe_input_wire(const fe_stage *stage, size_t input);
/* The output or service of `from` that an input row takes, or -1. */
int fe_find_offer(const fe_loaded *from, const ff_port *input);
uint64_t fe_wanted_of(const fe_stage *stage); /* bits of the first 64 outputs */
bool fe_wants_any(const fe_stage *stage);
/* Makes the outputs wanted from the stage wanted from the candidate. Returns a needed output that
   it lacks; NULL: none. */
const char *fe_pass_requests(const fe_stage *from, fe_stage *to);

/* call.c: brackets a call into a model; `action` is "evaluate" and the like. */
typedef struct fe_call {
    const fe_stage *stage;
    const char *action;
    fe_environment environment;
    fe_guard_mark mark;
} fe_call;

fe_call fe_call_begin(const fe_stage *stage, const char *action);
/* Restores the environment that a model must not change, and reports the status of the call and the
   faults of the model. True when the call was good. */
bool fe_call_end(const fe_call *call, ff_status status, fe_report *report);
/* Reports 'the plugin x.so <what>' at the stage's model. Returns false. */
bool fe_plugin_fault(const fe_stage *stage, fe_report *report, const char *what);

/* host.c: the functions that a model may call. */
void fe_host_init(fe_instance *instance);
void fe_forget_results(fe_stage *stage);

/* read.c: format, title and the stages with their `use`. False when there are no stages. */
bool fe_read_stages(fe_build *b, const fe_node *root);
/* The stage of that name; NULL after an error that begins with `where`. */
fe_stage *fe_find_stage(fe_build *b, const char *name, fe_place place, const char *where);

/* load.c: loads the stage's model, or all that it could choose; false after an error. */
bool fe_load_stage(fe_build *b, fe_stage *stage);
/* The first parameters of a stage that chooses. */
enum { FE_ACCURACY, FE_ONLY, FE_REFINE, FE_OWN_ROWS };
void fe_leave_out(fe_pipeline *pipeline, fe_candidate *c, const char *reason);

/* wire.c: one wire for each word before the dot in the names of the input rows, and what feeds
   each. */
void fe_link_stage(fe_build *b, fe_stage *stage);

/* bind.c: reads the parameters of a linked stage. */
void fe_bind_stage(fe_build *b, fe_stage *stage);

/* instance.c: create, set, wire, ready; destroy. */
void fe_open_instance(fe_build *b, fe_stage *stage);
void fe_close_instance(fe_stage *stage);
/* The table behind a service of a live instance. NULL: it gives none, and the report says why. */
const void *fe_fetch_service(fe_stage *stage, uint32_t output, fe_report *report);
/* Another instance, which knows the parameters and the wires as they are now. */
bool fe_reopen(fe_pipeline *pipeline, fe_stage *stage, fe_report *report);

/* arrays.c: what feeds the stage, one array per input row. False when a feeding stage has not run,
   which is known already, or with an error. */
bool fe_gather_inputs(const fe_pipeline *pipeline, const fe_stage *stage, ff_array *in,
                      fe_report *report);
/* False, with an error, when the stage's results cannot be used. */
bool fe_check_results(const fe_stage *stage, fe_report *report);

/* state.c: the state of a chain, before and after evaluate; nothing outside of one. False after an
   error. */
bool fe_restore_state(const fe_pipeline *pipeline, fe_stage *stage, fe_report *report);
bool fe_save_state(const fe_pipeline *pipeline, fe_stage *stage, fe_report *report);

/* judge.c: laws that are chosen. */
void fe_find_reference(fe_build *b, fe_stage *stage);
/* Whether the stage judges a law that is to be chosen. */
bool fe_is_judge(const fe_pipeline *pipeline, const fe_stage *stage);
/* Adds what the judges say to the assessments of the candidates. False after an error. */
bool fe_ask_judges(fe_pipeline *pipeline, fe_stage *law, fe_report *report);
/* Gives the chosen laws to their judges. */
bool fe_rewire_judges(fe_pipeline *pipeline, fe_report *report);

/* candidates.c: finds what feeds each wire of the stage, and of the stages behind them. */
void fe_link_from(fe_build *b, fe_stage *stage);
/* The same steps of building for the stages that could stand for one that chooses. */
void fe_bind_candidates(fe_build *b, fe_stage *stage);
void fe_open_candidates(fe_build *b, fe_stage *stage);
void fe_free_candidates(fe_stage *stage);

/* choose.c: makes the choice; the feeding stages have run. False after an error. */
bool fe_choose(fe_pipeline *pipeline, fe_stage *stage, fe_report *report);
/* The same for all laws, when the first stage that judges one is about to run. */
bool fe_choose_laws(fe_pipeline *pipeline, fe_report *report);
/* Adds what was promised to the quality of the stage. */
void fe_note_choice(fe_stage *stage);

/* request.c: marks the requested outputs; links what they need. */
void fe_request_outputs(fe_build *b, const fe_node *outputs);

/* order.c: which stages run, why, and in which order. */
void fe_mark_needed(fe_pipeline *pipeline);
void fe_sort_stages(fe_build *b);

#endif
