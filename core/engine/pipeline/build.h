/* SPDX-License-Identifier: MIT */
/* Internal interface of core/engine/pipeline, also used by instances. The sections are in the order
   of use: each file calls only functions of the sections above its own. */
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

/* The outputs that a parameter or an input affects, from host->serves. */
typedef struct fe_serving {
    char *item, *outputs, *by, *text; /* `by` and `text` are "" if absent */
} fe_serving;

/* What outputs need, from the extension flankfilm.needs/1. */
typedef struct fe_need {
    char *items, *outputs, *text;
} fe_need;

/* The model object of a stage, and what the build has found out about the stage. */
typedef struct fe_instance {
    ff_host host; /* host table of the model; outlives `self` */
    void *self;
    bool created; /* `self` must be destroyed */
    bool alive;   /* created, set, wired and ready */
    bool broken;  /* the report says why the object cannot run */
    ff_stage *stage;
    ff_guard_mark mark; /* marks of its own code and of the services on its wires */
    fe_serial alone;    /* lock of its shared object */

    enum { FE_NEW, FE_ENTERED, FE_SORTED } sorting;
    const ff_stage *entering; /* while sorting: the feeding stage that is being visited */

    const ff_observer *watch;
    const ff_hooks *hooks;        /* or NULL */
    struct fe_loop_stage *member; /* its entry in the running loop; NULL: none */
    fe_heap *heap;                /* memory that host functions allocate */
    fe_resource open;             /* registers `self` from create to destroy */
    /* an allocation in a host function failed; the call ends when the model returns */
    bool no_memory;
    bool no_room;     /* like no_memory, for the output whose name is in `text` */
    fe_tables tables; /* tables read by the model; their errors are reported before `text` */
    fe_serving *servings;
    size_t serving_count;
    fe_need *needs;
    size_t need_count;
    bool *read; /* by output row: a requested output depends on it; NULL until unread.c fills it
                   in */
    bool evaluating;
    bool left;        /* the observer skipped this stage but not the others */
    ff_status status; /* status of the last call; FF_DOMAIN is kept until a call fails */
    char item[96];    /* `item` of the last host->fail */
    char text[512];   /* `text` of the last host->fail */
    char fault[256];  /* how the plugin violated the interface: completes 'the plugin x.so ...' */
} fe_instance;

struct fe_pipeline_memory {
    fe_folder folder; /* working directory */
    fe_arena arena;
    ff_engine *engine;
};

typedef struct fe_build {
    ff_pipeline *pipeline;
    ff_engine *engine;
    ff_report *report;
    bool everything;
    uint32_t requested; /* number of requested outputs so far */
    uint32_t file_rank; /* layer of the file; assignments are in higher layers */
} fe_build;

/* messages.c: texts that are valid as long as the pipeline. */
char *fe_pipeline_print(ff_pipeline *pipeline, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
/* joins words: "a, b" */
const char *fe_join(ff_pipeline *pipeline, const char *list, const char *word);
/* '; did you mean "x"?' or "". */
const char *fe_did_you_mean(fe_build *b, const char *word, const char *const *words, size_t count);
const char *fe_found(const ff_node *node);                        /* "a map", ..., "nothing" */
const char *fe_place_text(ff_pipeline *pipeline, ff_place place); /* "pair.yaml:12:5", "--set" */
/* Reports '<where>: expected <what>, found a list' at the node. Returns false. */
bool fe_expected(fe_build *b, const ff_node *node, const char *where, const char *what);

/* Returns a copy without terminal control characters, cut at 511 bytes; to be freed. */
char *fe_copy_clean(const char *text);
void fe_hand_on(const ff_message *m, ff_report *report); /* adds the message to another report */

/* setting.c: returns the node at the path "a.b" in nested maps; NULL: there is none. */
const ff_node *fe_find_node(const ff_node *map, const char *path);
/* Returns the parameter set of the model under `with`; NULL: there is none. */
const ff_node *fe_model_set(const ff_stage *stage, const char *model);

/* The value of a parameter or wire of `model` in the file: a key of the stage, or a key in the
   model's set under `with`. */
typedef struct fe_setting {
    const ff_node *node; /* NULL: no value */
    uint64_t priority;   /* higher for a later layer; within a layer, the stage's own key is higher
                            than one under `with` */
    bool displaced; /* another parameter of its group is given, so that its preset does not apply */
    const ff_wire *wire; /* connected wire that replaces the parameter; NULL: none */
} fe_setting;

uint32_t fe_latest_rank(const ff_node *node); /* the latest layer that sets anything in it */
/* Whether the value is empty, which removes the value of an earlier layer. */
bool fe_is_removed(const ff_node *node);
fe_setting fe_find_setting(const ff_stage *stage, const char *model, const char *path);

/* ports.c */
const char *fe_output_name(const ff_port *input); /* name of the output it takes: "teeth" */
const ff_wire *fe_input_wire(const ff_stage *stage, size_t input);
/* whether a wire that closes a loop feeds the input */
bool fe_is_fed_back(const ff_stage *stage, size_t input);
/* Returns the output or service of `from` that an input row takes, or -1. */
int fe_find_offer(const ff_loaded *from, const ff_port *input);
uint64_t fe_wanted_of(const ff_stage *stage); /* bits of the first 64 outputs */
bool fe_wants_any(const ff_stage *stage);

/* call.c: a bracket around each call into a model; `action` names the call, such as "evaluate". */
typedef struct fe_call {
    const ff_stage *stage;
    const char *action;
    fe_serial alone; /* all locks that the call needs */
    ff_environment environment;
    ff_guard_mark previous;
} fe_call;

/* Returns the position of the NULL that ends the list of services; a caller with room may add one
   more there. */
const ff_guard_mark **fe_end_of_services(const ff_guard_mark *mark);
/* Sets the mark of ff_guard_current to the model's code, and returns the mark from before. */
ff_guard_mark fe_enter_model(const ff_stage *stage, const char *action);
fe_call fe_call_begin(const ff_stage *stage, const char *action);
/* Restores the environment that a model must not change, and reports the status of the call and the
   faults of the model. True if the call succeeded. */
bool fe_call_end(const fe_call *call, ff_status status, ff_report *report);
/* Returns to the working directory if a model has left it, with a warning. */
void fe_check_folder(const ff_pipeline *pipeline, const ff_stage *stage, const char *action,
                     ff_report *report);
/* Reports 'the plugin x.so <what>' at the place of the stage's model. Returns false. */
bool fe_plugin_fault(const ff_stage *stage, ff_report *report, const char *what);
/* Reports '<plugins> <what>', where the plugins are the stage's own and those of its services.
   Returns false. */
bool fe_shared_fault(const ff_stage *stage, ff_report *report, const char *what);

/* A log line of a stage in a loop, to be passed to the observer after the last round. */
typedef struct fe_log_line {
    int level;
    char text[512];
} fe_log_line;

/* A stage of a running loop. */
typedef struct fe_loop_stage {
    ff_stage *stage;
    bool first;         /* it is the first round, which has no feedback values */
    ff_result *initial; /* by output row: copy of its wanted, requested and refused flags */
    ff_result *fed;     /* by input row: value of a feedback wire from the round before */
    bool *fed_anew;     /* by input row: the value has changed since the round before */
    bool *gave_anew;    /* by output row: the value has changed since the round before */
    ff_report *report;  /* messages of its last evaluation */
    fe_log_line *lines; /* log lines of its last evaluation */
    size_t line_count;
} fe_loop_stage;

/* host.c: the host functions that a model may call. */
void fe_host_init(fe_instance *instance);
void fe_forget_results(ff_stage *stage);
void fe_forget_servings(fe_instance *instance); /* also drops what it gave through
                                                   flankfilm.needs/1 */
/* Returns the FF_FILE parameter of a table column such as "file.time"; -1: there is none. */
int fe_find_table(const ff_model *model, const char *item);

/* read.c: reads the format, the title and the stages with their `use`. False if there are no
   stages. */
bool fe_read_stages(fe_build *b, const ff_node *root);
/* Returns the stage with that name; NULL after an error, whose text begins with `where`. */
ff_stage *fe_find_stage(fe_build *b, const char *name, ff_place place, const char *where);

/* load.c: loads the stage's model; false after an error. */
bool fe_load_stage(fe_build *b, ff_stage *stage);

/* wire.c: explains why `from` cannot feed the wire; the text completes 'the stage ...'. NULL:
   `from` offers all that the wire requires, and at least one output. */
const char *fe_wire_misfit(fe_build *b, const ff_stage *stage, const char *wire,
                           const ff_loaded *from);
/* Loads and links the stage, and then the stages that feed it. */
void fe_link_from(fe_build *b, ff_stage *stage);
/* Checks each input of a needed stage whose dimension belongs to another wire ("gear.station").
   Reports it if it is fed along a different dimension. */
void fe_check_dims(fe_build *b);

/* hint.c: suggests the meaning of a key that the model does not have; NULL: no suggestion. */
const char *fe_hint_of_key(fe_build *b, const ff_stage *stage, const ff_model *model,
                           const char *key);

/* bind.c: reads the parameters of a linked stage. */
void fe_bind_stage(fe_build *b, ff_stage *stage);

/* instance.c: calls create, set, wire and ready; later destroy. */
void fe_open_instance(fe_build *b, ff_stage *stage);
/* The single steps of fe_open_instance; false after an error. */
bool fe_create_object(ff_stage *stage, ff_report *report);
void fe_place_params(const ff_stage *stage); /* writes parameters with a `place` */
bool fe_set_param(ff_stage *stage, size_t param,
                  ff_report *report); /* calls set for given parameters without a `place` */
bool fe_wire_object(ff_stage *stage, size_t input, const void *service, ff_report *report);
bool fe_ready_object(ff_stage *stage, ff_report *report);
void fe_close_object(ff_stage *stage); /* keeps its tables for the next object */
void fe_close_instance(ff_stage *stage);
/* Returns the table of a service of a live instance; `wired`: a wire uses it, so that it is
   checked. NULL: the instance gives no usable table; the report has the reason. */
const void *fe_fetch_service(ff_stage *stage, uint32_t output, bool wired, ff_report *report);

/* arrays.c: the length of each named dimension of each wire, as first seen. Must start zeroed; the
   caller frees `seen`. */
typedef struct fe_lengths {
    struct {
        const char *wire, *dim, *row; /* `wire` as returned by fe_dim_wire */
        size_t wire_length, length;
    } * seen;
    size_t count;
} fe_lengths;

/* Whether an array with these dimensions may have this rank. */
bool fe_rank_fits(const ff_dims *dims, uint32_t rank);
/* Records the lengths of one array, whose rank must fit. False, with a clause in `why`, if a
   dimension has two lengths. */
bool fe_enter_lengths(fe_lengths *all, const ff_model *model, const ff_port *row,
                      const ff_dims *dims, uint32_t rank, const size_t *shape, char *why,
                      size_t why_size);

size_t fe_count(const ff_array *array); /* number of elements; 0 without data */
/* Returns a checksum of each array of `in`. */
uint64_t *fe_sum_inputs(const ff_stage *stage, const ff_array *in);
/* Reports inputs whose checksums have changed because the model wrote into them. Returns false if
   there are any. */
bool fe_check_inputs(const ff_stage *stage, const ff_array *in, const uint64_t *sums,
                     ff_report *report);

/* Collects the arrays that feed the stage, one per input row. False after an error, or if a feeding
   stage has not run. */
bool fe_gather_inputs(const ff_pipeline *pipeline, const ff_stage *stage, ff_array *in,
                      ff_report *report);
/* Drops outputs that are not wanted and still have the NaN with which their memory was filled. */
void fe_drop_untouched(ff_stage *stage);
/* False, with an error, if the results of the stage are unusable. `in` has the arrays of the
   evaluation; NULL: unknown here. */
bool fe_check_results(const ff_stage *stage, const ff_array *in, ff_report *report);

/* quality.c: adds a quality line with FF_BAD for each result outside the natural bounds of its
 * row. */
void fe_judge_bounds(ff_stage *stage);
void fe_forget_quality(ff_stage *stage); /* all lines */
/* Marks outputs as wanted if two needed stages give the same quantity, so that they can be
   compared. */
void fe_want_quantities(ff_pipeline *pipeline);
/* After a run: compares stages that give the same quantity. The later stage gets a quality line,
   with FF_RANGE if they differ by more than their rows allow. */
void fe_compare_quantities(ff_pipeline *pipeline);

/* evaluate.c: evaluates a stage once. Outputs that the model refuses are left out if nothing
   requires them. False after an error. */
bool fe_evaluate(const ff_pipeline *pipeline, ff_stage *stage, const ff_array *in,
                 ff_report *report);
/* Reports the quality lines that the model gave as bad. Returns false if there are any. */
bool fe_check_quality(const ff_stage *stage, ff_report *report);

/* rounds.c: evaluates the stages of a loop until the values on its feedback wires have converged.
   False after an error. If the observer stops the loop, all its stages get FF_STOPPED. */
bool fe_run_loop(ff_pipeline *pipeline, const ff_loop *loop, const ff_observer *watch,
                 ff_report *report);

/* state.c: restores the chain state before evaluate, and saves it after. Outside a chain both do
   nothing. False after an error. */
bool fe_restore_state(const ff_pipeline *pipeline, ff_stage *stage, ff_report *report);
bool fe_save_state(const ff_pipeline *pipeline, ff_stage *stage, ff_report *report);

/* request.c: marks the outputs that the file requests or limits, and links what they need. */
void fe_request_outputs(fe_build *b, const ff_node *outputs);
void fe_request_limits(fe_build *b, const ff_node *limits);
/* Stores in each stage which of its doubts the file accepts. */
void fe_read_accept(fe_build *b, const ff_node *accept);

/* feedback.c: reads the key `feedback` of the file. */
void fe_read_feedback(fe_build *b, const ff_node *feedback);
/* Finds the loops, and puts the stages of each loop next to each other in the order. The stages
   must be sorted by the other wires. */
void fe_find_loops(fe_build *b);
ff_loop *fe_loop_of(const ff_pipeline *pipeline, const ff_stage *stage); /* NULL: in no loop */

/* needs.c: leaves out outputs that lack what they need (flankfilm.needs/1), and refuses those that
   are required. */
void fe_check_needs(fe_build *b);

/* unread.c: warns of settings that have no effect, and refuses values that are given twice. */
void fe_check_unread(fe_build *b, const ff_node *outputs);

/* order.c: finds which stages run, why, and in what order. */
void fe_mark_needed(ff_pipeline *pipeline);
void fe_sort_stages(fe_build *b);

#endif
