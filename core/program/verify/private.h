/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Declarations shared by the files of core/program/verify only. A child process lives for one test,
   and frees little more than what belongs to the model. */
#ifndef VERIFY_PRIVATE_H
#define VERIFY_PRIVATE_H

#include "verify.h"

#include "../study/store/journal.h"

#include <flankfilm/conformance.h>

#include <limits.h>
#include <signal.h>
#include <stdio.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/time.h>
#include <sys/types.h>

/* kind-checks.c: the model conformance/KIND, which defines what models of that kind must do. */
typedef struct verify_kind_checks {
    const ff_conformance *offer;
    ff_instance *instance;
} verify_kind_checks;

/* Returns false if there is no such model, or with an error. `offer` is valid until it is
   closed. */
bool verify_kind_checks_open(verify_kind_checks *checks, ff_engine *engine, const char *kind,
                             ff_report *report);
void verify_kind_checks_close(verify_kind_checks *checks);
/* Returns, for each service input of the model, a simple law from the kind of the law; NULL:
   none. */
const void **verify_plain_laws(ff_engine *engine, const ff_loaded *loaded);

/* random.c: Splitmix64, which gives the same numbers in every run. */
typedef struct verify_random {
    uint64_t state;
} verify_random;

double verify_uniform(verify_random *random); /* in [0, 1) */
size_t verify_below(verify_random *random, size_t count);

/* What a child reports to its parent, in shared memory. */
typedef struct verify_outcome {
    bool finished;
    verify_finding finding;
    char step[128];          /* the call in progress */
    ff_guard_mirror running; /* plugin whose code is running */
    char why[512];
} verify_outcome;

/* Records a finding. Only the first one is kept. */
void verify_outcome_set(verify_outcome *outcome, verify_finding finding, const char *why);

enum { VERIFY_SIGNALS = 32, VERIFY_LIMITS = RLIM_NLIMITS };

/* context.c: opens an engine that searches the folder for plugins before all other places. */
ff_engine *verify_open_engine(const char *root);

/* process.c: state of the process that a model must not change, besides arithmetic and locale. */
typedef struct verify_process {
    struct sigaction signals[VERIFY_SIGNALS];
    sigset_t blocked;
    stack_t stack; /* stack on which signal handlers run */
    struct itimerval timers[3];
    struct stat streams[3];
    char folder[PATH_MAX];
    mode_t mask;
    struct rlimit limits[VERIFY_LIMITS];
    uint64_t variables; /* a hash of the environment */
    long children;      /* changes if a child process was made */
    size_t threads;
    int priority;
    bool has_timers; /* made by timer_create */
} verify_process;

void verify_process_look(verify_process *process);
/* Returns what has changed since, to complete 'the plugin ...', or NULL if nothing has. */
const char *verify_process_changed(const verify_process *was);

/* context.c: one test of one model. */
typedef struct verify_context {
    const char *root; /* the folder of the plugins */
    ff_engine *engine;
    const ff_loaded *loaded;
    const ff_model *model; /* model under test */
    const void **laws;     /* a simple law for each service input; NULL: none */
    verify_random random;
    FILE *table;                /* table in memory, for a model that reads one; NULL: none yet */
    ff_run *user;               /* the user's pipeline; `given` comes from it */
    struct verify_setup *given; /* NULL: there is none */
    verify_outcome *outcome;
    ff_report *messages; /* messages about the parameter that was read last */
    bool redirected;     /* whether its calls of malloc are redirected */
    bool watching;       /* whether changes of the process by the model are an error */
    pid_t pid;
    ff_environment *environment; /* environment that must not change; NULL: nothing is watched
                                    yet */
    verify_process process;
} verify_context;

/* Begins a test. `loaded` and `outcome` are already set. */
void verify_context_begin(verify_context *context, ff_engine *engine);
void verify_watch(verify_context *context);
/* Fails if the process has changed or the model has written past its memory. The finding names the
   current step. */
void verify_check_process(verify_context *context);

/* Sets the name of the next call, for findings such as a crash, a hang or a change of the
   process. */
void verify_step(verify_context *context, const char *format, ...) FF_PRINTF(2, 3);
/* Record a finding; only the first one is kept. Both return false. */
bool verify_fail(verify_context *context, const char *format, ...) FF_PRINTF(2, 3);
bool verify_skip(verify_context *context, const char *format, ...) FF_PRINTF(2, 3);

/* Reads a parameter from text in the user's notation; NULL: from its preset. Returns false if it is
   refused. *message is the first error or warning, valid until the next call, or NULL. */
bool verify_read_param(verify_context *context, size_t param, const char *text, ff_value *value,
                       const char **message);

uint64_t verify_data_outputs(const ff_model *model); /* one bit for each of the first 64 */

/* setup.c: the parameters and inputs with which an instance is made and evaluated. */
typedef struct verify_setup {
    verify_context *context;
    ff_value *values;      /* one per parameter; size 0: not set */
    ff_array *inputs;      /* one per input row */
    const void **services; /* tables of the service inputs; NULL: not connected */
    size_t (*shapes)[FF_MAX_RANK];
    const char *lacks; /* a required file for which no contents could be generated; NULL: none */
} verify_setup;

/* Which parameters are drawn: those within the calibrated range; those within and at the physical
   limits; or only the required parameters, within the calibrated range. */
typedef enum verify_range { VERIFY_CALIBRATED, VERIFY_PHYSICAL, VERIFY_REQUIRED } verify_range;

/* makes a setup with the simple laws and nothing else */
verify_setup *verify_setup_new(verify_context *context);
/* random.c: draws a value of a parameter, in the row's unit. */
double verify_draw_number(const ff_param *row, verify_random *random, verify_range range);
/* table.c: returns the path of a file with the columns of the model. Its numbers differ at each
   call. The file exists as long as the process. Returns NULL if the model declares no columns. */
const char *verify_make_table(verify_context *context);
/* Returns whether everything required could be drawn. If not, the test is skipped, unless
   `quietly`. */
bool verify_setup_can_be_used(const verify_setup *setup, bool quietly);
/* Returns whether a connected service replaces the parameter. */
bool verify_setup_is_replaced(const verify_setup *setup, const ff_param *row);
void verify_setup_draw_params(verify_setup *setup, verify_random *random, verify_range range);
void verify_setup_draw_inputs(verify_setup *setup, verify_random *random);
void verify_setup_give(verify_setup *setup, size_t input, const double *data, uint32_t rank,
                       const size_t *shape);
/* returns whether every required input is set */
bool verify_setup_is_complete(const verify_setup *setup);

/* user-run.c: takes the parameters of the stage of the user's pipeline that uses the model and, if
   `runs`, the arrays from other stages. Returns false with errors in the report. */
bool verify_take_user_run(verify_context *context, const verify_request *request, ff_engine *engine,
                          bool runs);

/* instance.c: one instance of the model. The engine makes and runs it while the process is
   watched. */
typedef struct verify_instance {
    verify_context *context;
    ff_instance *made;
    const ff_model *model; /* descriptor as stored in the engine of the instance */
    ff_hooks hooks;
    bool create_only, created;
    void *self;
    size_t room;      /* bytes allocated for `self`; 0: not known */
    char text[700];   /* why the last call failed, or "" */
    char breach[400]; /* how the model broke the interface, to complete 'it ...' */
    double stop_at;   /* time from which progress asks the model to stop */
    bool asked_to_stop;
} verify_instance;

/* Makes an instance with the parameters, laws and inputs of the setup, without calling the model
   yet. The instance must be closed whatever the status. The same holds for the next two
   functions. */
ff_status verify_instance_new(verify_instance *instance, const verify_setup *setup);
/* Calls only create, for an instance without parameters. Returns false after a failure. */
bool verify_instance_create(verify_instance *instance, verify_context *context);
/* Calls create, set, wire and ready. */
ff_status verify_instance_open(verify_instance *instance, const verify_setup *setup);
/* Evaluates the named outputs with the inputs of the setup; NULL: all outputs that the model
 * does not refuse. */
ff_status verify_instance_run(verify_instance *instance, const char *outputs,
                              const verify_setup *setup);
/* Calls work(ctx), which calls the model's function named `function`. */
ff_status verify_instance_call(verify_instance *instance, const char *function,
                               ff_status (*work)(void *ctx), void *ctx);
/* Fails if the call that returned this status broke the interface, reported a fault of the plugin,
   or wrote outside its memory. */
bool verify_instance_is_sound(const verify_instance *instance, ff_status status);
void verify_instance_close(verify_instance *instance);

/* search.c: finds parameters and inputs with which the model works. */

static inline bool verify_is_good(ff_status status)
{
    return status == FF_OK || status == FF_DOMAIN;
}

/* Opens an instance with inputs and with parameters that the model accepts: the user's, or random
   ones. Returns NULL if none were found; the test is then skipped, unless `quietly`. */
verify_setup *verify_open_accepted(verify_context *context, verify_instance *instance,
                                   bool quietly);
/* Opens an instance and finds inputs with which it works. *served: the names of the outputs that it
   gives with them. Returns NULL if there are none. */
verify_setup *verify_find_work(verify_context *context, verify_instance *instance, char **served);
/* Finds such inputs by trying the outputs one by one until the time `end`. Returns false after a
 * failure. */
bool verify_find_served(verify_context *context, verify_instance *instance,
                        const verify_setup *setup, char **served, double end);
/* Fails unless the outputs of both instances are bitwise equal. */
bool verify_outputs_agree(verify_context *context, const verify_instance *a,
                          const verify_instance *b, const char *when);

/* fixture.c: runs a check of the model's kind. */
void verify_run_check(verify_context *context, const ff_check *check);

/* allocation.c: redirects the plugin's own calls of malloc. Returns false if that is not
   possible. */
bool verify_allocations_redirect(const ff_model *model);
/* Makes the n-th allocation from now on fail (0: none), and starts to count allocations. */
void verify_allocations_fail(size_t nth);
size_t verify_allocations_made(void);
/* Returns the number of bytes from the address to the end of its block in the plugin's memory, or 0
   if no such block exists. */
size_t verify_allocation_room(const void *memory);
/* Returns the size of a block past whose end the plugin wrote since the last call, or 0. */
size_t verify_allocation_breached(void);

/* test-life.c, test-outputs.c: requirements on any model. Return false after a failure. */
bool verify_test_references(verify_context *context);
bool verify_test_presets(verify_context *context);
bool verify_test_places(verify_context *context);
bool verify_test_life(verify_context *context);
bool verify_test_leaks(verify_context *context);
bool verify_test_allocations(verify_context *context);
bool verify_test_limits(verify_context *context);
bool verify_test_environment(verify_context *context);
bool verify_test_inputs(verify_context *context);
bool verify_test_wanted(verify_context *context);
bool verify_test_repeat(verify_context *context);

#endif
