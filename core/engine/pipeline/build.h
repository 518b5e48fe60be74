/* SPDX-License-Identifier: MIT */
/* Shared by the files of core/engine/pipeline and by instances. The sections below are in the
 * order of use: each file calls only those above it. */
#ifndef FE_BUILD_H
#define FE_BUILD_H

#include "../plugin/environment.h"
#include "../plugin/folder.h"
#include "../plugin/guard.h"
#include "../plugin/rows.h"
#include "../plugin/serial.h"
#include "../value/memory.h"
#include "../value/report.h"
#include "../value/tables.h"

/* Which outputs a parameter or an input serves, as the model says by host->serves. */
typedef struct fe_serving {
    char *item, *outputs, *by, *text; /* `by` and `text` are "" where there is none */
} fe_serving;

/* What outputs need, as the model says by host->needs. */
typedef struct fe_need {
    char *items, *outputs, *text;
} fe_need;

/* The object of the model of a stage, and what building has found out about it. */
typedef struct fe_instance {
    ff_host host; /* given to the model; outlives `self` */
    void *self;
    bool created; /* `self` must be destroyed */
    bool alive;   /* created, set, wired and ready */
    bool broken;  /* the report says why it cannot run */
    ff_stage *stage;
    ff_guard_mark mark; /* its own code, and the services that it is wired to */
    fe_serial alone;    /* the lock of its object */

    enum { FE_NEW, FE_ENTERED, FE_SORTED } sorting;
    const ff_stage *entering; /* the feeding stage that is being sorted at the moment */

    const ff_observer *watch;
    const ff_hooks *hooks;        /* or NULL */
    struct fe_loop_stage *member; /* its entry in the loop that is running; NULL: none */
    fe_heap *heap;                /* allocations by the functions of the host */
    fe_resource open;             /* `self`, from create to destroy */
    bool no_memory; /* an allocation in a host function failed; the call ends when the model returns
                     */
    bool no_room;   /* the same for an output, whose name is in `text` */
    fe_tables tables; /* tables that it has read; their errors are reported before `text` */
    fe_serving *servings;
    size_t serving_count;
    fe_need *needs;
    size_t need_count;
    bool *read; /* by output row: a requested output depends on it; NULL before unread.c */
    bool evaluating;
    bool left;        /* the observer chose to skip this stage and to go on with the others */
    ff_status status; /* of the last call; FF_DOMAIN is kept until one fails */
    char item[96];    /* of the last host->fail */
    char text[512];   /* of the last host->fail */
    char fault[256];  /* how the plugin broke the interface: completes 'the plugin x.so ...' */
} fe_instance;

struct fe_pipeline_memory {
    fe_folder folder; /* the working directory */
    fe_arena arena;
    ff_engine *engine;
};

typedef struct fe_build {
    ff_pipeline *pipeline;
    ff_engine *engine;
    ff_report *report;
    bool everything;
    uint32_t requested; /* number of outputs so far */
    uint32_t file_rank; /* the layer of the file; assignments have higher ones */
} fe_build;

/* messages.c: texts that live as long as the pipeline. */
char *fe_pipeline_print(ff_pipeline *pipeline, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
const char *fe_join(ff_pipeline *pipeline, const char *list, const char *word); /* "a, b" */
/* '; did you mean "x"?' or "". */
const char *fe_did_you_mean(fe_build *b, const char *word, const char *const *words, size_t count);
const char *fe_found(const ff_node *node);                        /* "a map", ..., "nothing" */
const char *fe_place_text(ff_pipeline *pipeline, ff_place place); /* "pair.yaml:12:5", "--set" */
/* Reports '<where>: expected <what>, found a list' at the node. Returns false. */
bool fe_expected(fe_build *b, const ff_node *node, const char *where, const char *what);

/* Returns a copy without what a terminal would act on, cut at 511 bytes; to be freed. */
char *fe_copy_clean(const char *text);
void fe_hand_on(const ff_message *m, ff_report *report); /* adds the message to another report */

/* setting.c: returns the node at "a.b" in maps within maps; NULL: there is none. */
const ff_node *fe_find_node(const ff_node *map, const char *path);
/* Returns the parameter set of the model under `with`; NULL: there is none. */
const ff_node *fe_model_set(const ff_stage *stage, const char *model);

/* What the file says for a parameter or wire of `model`: written on the stage, or in the set that
   stands for the model under `with`. */
typedef struct fe_setting {
    const ff_node *node; /* NULL: nothing */
    uint64_t priority; /* higher for a later layer; within one layer, higher for the stage's own key
                          than under `with` */
    bool displaced;    /* its preset gives way to another parameter of its group */
    const ff_wire *wire; /* connected, and replaces the parameter; NULL: none */
} fe_setting;

uint32_t fe_latest_rank(const ff_node *node); /* of the latest layer that sets anything in it */
/* An empty value takes away what an earlier layer says. */
bool fe_is_taken_away(const ff_node *node);
fe_setting fe_find_setting(const ff_stage *stage, const char *model, const char *path);

/* ports.c */
const char *fe_output_name(const ff_port *input); /* the output that it takes: "teeth" */
const ff_wire *fe_input_wire(const ff_stage *stage, size_t input);
bool fe_is_fed_back(const ff_stage *stage, size_t input); /* by a wire that closes a loop */
/* Returns the output or service of `from` that an input row takes, or -1. */
int fe_find_offer(const ff_loaded *from, const ff_port *input);
uint64_t fe_wanted_of(const ff_stage *stage); /* bits of the first 64 outputs */
bool fe_wants_any(const ff_stage *stage);

/* call.c: brackets a call into a model; `action` is "evaluate" and the like. */
typedef struct fe_call {
    const ff_stage *stage;
    const char *action;
    fe_serial alone; /* all locks of the call */
    ff_environment environment;
    ff_guard_mark previous;
} fe_call;

/* Returns the place of the NULL that ends the list of services; one more may be put there if
 * there is room. */
const ff_guard_mark **fe_end_of_services(const ff_guard_mark *mark);
/* Enters the model's code in ff_guard_current, and returns the mark that stood there before. */
ff_guard_mark fe_enter_model(const ff_stage *stage, const char *action);
fe_call fe_call_begin(const ff_stage *stage, const char *action);
/* Restores the environment that a model must not change, and reports the status of the call and
 * the faults of the model. True if the call was good. */
bool fe_call_end(const fe_call *call, ff_status status, ff_report *report);
/* Returns to the working directory that the calls so far had to keep, and warns if a model has
 * left it. */
void fe_check_folder(const ff_pipeline *pipeline, const ff_stage *stage, const char *action,
                     ff_report *report);
/* Reports 'the plugin x.so <what>' at the stage's model. Returns false. */
bool fe_plugin_fault(const ff_stage *stage, ff_report *report, const char *what);
/* Reports '<plugins> <what>', where the plugins are the stage's own and those of its services.
 * Returns false. */
bool fe_shared_fault(const ff_stage *stage, ff_report *report, const char *what);

/* A line that a stage of a loop has logged. It is handed on after the last round. */
typedef struct fe_log_line {
    int level;
    char text[512];
} fe_log_line;

/* A stage of a running loop. */
typedef struct fe_loop_stage {
    ff_stage *stage;
    bool first;         /* this is the first round, in which nothing is fed back */
    ff_result *asked;   /* by output row: whether it is wanted, requested or refused */
    ff_result *fed;     /* by input row: what a feedback wire carries from the round before */
    bool *fed_anew;     /* by input row: the value differs from that of the round before */
    bool *gave_anew;    /* by output row: the output differs from that of the round before */
    ff_report *report;  /* of its last evaluation */
    fe_log_line *lines; /* of its last evaluation */
    size_t line_count;
} fe_loop_stage;

/* host.c: the functions that a model may call. */
void fe_host_init(fe_instance *instance);
void fe_forget_results(ff_stage *stage);
void fe_forget_servings(fe_instance *instance); /* and what it said by host->needs */
/* Returns the parameter that names the table of a column such as "file.time"; -1: there is none. */
int fe_find_table(const ff_model *model, const char *item);

/* read.c: format, title and the stages with their `use`. False when there are no stages. */
bool fe_read_stages(fe_build *b, const ff_node *root);
/* Returns the stage of that name; NULL after an error that begins with `where`. */
ff_stage *fe_find_stage(fe_build *b, const char *name, ff_place place, const char *where);

/* load.c: loads the stage's model; false after an error. */
bool fe_load_stage(fe_build *b, ff_stage *stage);

/* wire.c: explains why `from` cannot feed the wire of that name, to complete 'the stage ...'.
 * NULL: it offers all that the wire requires, and at least one output. */
const char *fe_wire_misfit(fe_build *b, const ff_stage *stage, const char *wire,
                           const ff_loaded *from);
/* Links the stage, after loading it, and then the stages that feed it. */
void fe_link_from(fe_build *b, ff_stage *stage);
/* Reports each input of a needed stage whose length is tied to an input of another wire, but
 * which is fed along a different dimension. */
void fe_check_dims(fe_build *b);

/* hint.c: says what a key that the model does not have may mean; NULL: nothing is near. */
const char *fe_hint_of_key(fe_build *b, const ff_stage *stage, const ff_model *model,
                           const char *key);

/* bind.c: reads the parameters of a linked stage. */
void fe_bind_stage(fe_build *b, ff_stage *stage);

/* instance.c: create, set, wire, ready; destroy. */
void fe_open_instance(fe_build *b, ff_stage *stage);
/* The steps of fe_open_instance; false after an error. */
bool fe_create_object(ff_stage *stage, ff_report *report);
void fe_place_params(const ff_stage *stage); /* parameters whose rows have a place */
bool fe_set_param(ff_stage *stage, size_t param,
                  ff_report *report); /* for parameters that are given and have no place */
bool fe_wire_object(ff_stage *stage, size_t input, const void *service, ff_report *report);
bool fe_ready_object(ff_stage *stage, ff_report *report);
void fe_close_object(ff_stage *stage); /* its tables are kept for the next object */
void fe_close_instance(ff_stage *stage);
/* Returns the table behind a service of a live instance, after checking it if a wire carries it.
 * NULL: the instance gives no usable table, and the report says why. */
const void *fe_fetch_service(ff_stage *stage, uint32_t output, bool wired, ff_report *report);

/* arrays.c: the length that each named dimension of each wire had when it was first seen. Starts
 * zeroed; `seen` is to be freed. */
typedef struct fe_lengths {
    struct {
        const char *wire, *dim, *row; /* `wire` as fe_dim_wire gives it */
        size_t wire_length, length;
    } * seen;
    size_t count;
} fe_lengths;

/* Whether an array with these dimensions may have that rank. */
bool fe_rank_fits(const ff_dims *dims, uint32_t rank);
/* Records the lengths of one array whose rank fits. False, with a clause in `why`, if a
 * dimension has two lengths. */
bool fe_enter_lengths(fe_lengths *all, const ff_model *model, const ff_port *row,
                      const ff_dims *dims, uint32_t rank, const size_t *shape, char *why,
                      size_t why_size);

size_t fe_count(const ff_array *array); /* numbers in the array; 0 without data */
/* Returns a checksum for each array of `in`. */
uint64_t *fe_sum_inputs(const ff_stage *stage, const ff_array *in);
/* Reports inputs whose checksums have changed: the model wrote into them. Returns false then. */
bool fe_check_inputs(const ff_stage *stage, const ff_array *in, const uint64_t *sums,
                     ff_report *report);

/* Collects what feeds the stage, one array per input row. False if a feeding stage has not run,
 * or after an error. */
bool fe_gather_inputs(const ff_pipeline *pipeline, const ff_stage *stage, ff_array *in,
                      ff_report *report);
/* Drops outputs that nobody wants and that still hold the NaN with which their memory was
 * filled. */
void fe_drop_untouched(ff_stage *stage);
/* False, with an error, if the results of the stage cannot be used. `in` holds the arrays that
 * it was evaluated with; NULL: not known here. */
bool fe_check_results(const ff_stage *stage, const ff_array *in, ff_report *report);

/* quality.c: adds a quality line with FF_BAD for each result outside the natural bounds of its
 * row. */
void fe_judge_bounds(ff_stage *stage);
void fe_forget_quality(ff_stage *stage); /* all lines */
/* Marks outputs as wanted if two needed stages give the same quantity, so that they can be
 * compared. */
void fe_want_quantities(ff_pipeline *pipeline);
/* After a run: compares stages that give the same quantity. The later one gets a quality line,
 * with FF_RANGE if they differ by more than their rows allow. */
void fe_compare_quantities(ff_pipeline *pipeline);

/* evaluate.c: evaluates a stage once. An output that it refuses is left out if nothing requires
 * it. False after an error. */
bool fe_evaluate(const ff_pipeline *pipeline, ff_stage *stage, const ff_array *in,
                 ff_report *report);
/* Reports the quality lines that the stage itself calls bad. Returns false if there are any. */
bool fe_check_quality(const ff_stage *stage, ff_report *report);

/* rounds.c: evaluates the stages of a loop until the values on its feedback wires have settled.
 * False after an error. If the observer stops it, all its stages get that status. */
bool fe_run_loop(ff_pipeline *pipeline, const ff_loop *loop, const ff_observer *watch,
                 ff_report *report);

/* state.c: restores and saves the state of a chain, before and after evaluate; without a chain
 * it does nothing. False after an error. */
bool fe_restore_state(const ff_pipeline *pipeline, ff_stage *stage, ff_report *report);
bool fe_save_state(const ff_pipeline *pipeline, ff_stage *stage, ff_report *report);

/* request.c: marks the outputs that the file requests or sets limits for, and links what they
 * need. */
void fe_request_outputs(fe_build *b, const ff_node *outputs);
void fe_request_limits(fe_build *b, const ff_node *limits);
/* Notes on each stage which of its doubts the file accepts. */
void fe_read_accept(fe_build *b, const ff_node *accept);

/* feedback.c: reads what the file says under `feedback`. */
void fe_read_feedback(fe_build *b, const ff_node *feedback);
/* Finds the loops, once the stages are sorted by the wires that are no feedback, and makes the
 * stages of each loop neighbours in the order. */
void fe_find_loops(fe_build *b);
ff_loop *fe_loop_of(const ff_pipeline *pipeline, const ff_stage *stage); /* NULL: in none */

/* needs.c: leaves out outputs that lack what they need, as host->needs has told, and refuses
 * those that somebody requires. */
void fe_check_needs(fe_build *b);

/* unread.c: warns of settings that have no effect, and refuses what is said in two places. */
void fe_check_unread(fe_build *b, const ff_node *outputs);

/* order.c: finds which stages run, why, and in which order. */
void fe_mark_needed(ff_pipeline *pipeline);
void fe_sort_stages(fe_build *b);

#endif
