/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The model under test and the means to work it. Internal to core/verify. A child process lives for
   one test and frees nothing but what is the model's. */
#ifndef FF_SUBJECT_H
#define FF_SUBJECT_H

#include "verify.h"

#include "../plugin/kind.h"
#include "../value/tables.h"
#include "../value/zoned.h"

enum { FF_MOST_OUTPUTS = 64 };

/* What a child tells its parent; lies in memory that both share. */
typedef struct ff_slate {
    bool told;
    ff_finding finding;
    char doing[128]; /* the call at hand */
    char why[512];
} ff_slate;

/* Numbers between guard zones, which tell of a write outside. */
typedef struct ff_guarded {
    double *data;
    size_t count;
} ff_guarded;

ff_guarded ff_guarded_new(size_t count); /* holds NaN */
void ff_guarded_free(ff_guarded *guarded);

/* Splitmix64: the same numbers in every run. */
typedef struct ff_random {
    uint64_t state;
} ff_random;

double ff_uniform(ff_random *random); /* [0, 1) */
size_t ff_below(ff_random *random, size_t count);

/* What an instance is made of and fed with. */
typedef struct ff_feed {
    const ff_loaded *loaded;
    ff_value *values;      /* of each parameter; size 0: not set */
    ff_array *inputs;      /* of each input row */
    const void **services; /* the table of a service input; NULL: not connected */
    ff_guarded *memory;
    size_t (*shapes)[FF_MAX_RANK];
} ff_feed;

typedef struct ff_subject {
    const ff_loaded *loaded;
    const void **laws; /* a plain law for each service input, or NULL */
    ff_slate *slate;
    ff_random random;
    ff_feed *given; /* from the user's pipeline, or NULL */
} ff_subject;

/* Parameters inside their calibrated range, or anywhere in their limits and at them; or inside, the
   required ones alone. */
typedef enum ff_reach { FF_INSIDE, FF_LIMITS, FF_NEEDED } ff_reach;

ff_feed *ff_feed_new(const ff_subject *subject);
void ff_feed_draw_values(ff_feed *feed, ff_random *random, ff_reach reach);
void ff_feed_draw_inputs(ff_feed *feed, ff_random *random);
void ff_feed_give(ff_feed *feed, size_t input, const double *data, uint32_t rank,
                  const size_t *shape);

/* Takes the stage of the pipeline file that uses the model, with what the other stages feed it;
   NULL with errors in the report. */
ff_feed *ff_feed_from_pipeline(const ff_verify *request, ff_library *library,
                               const ff_subject *subject, bool inputs, ff_report *report);

/* One instance and its host. */
typedef struct ff_trial {
    ff_host host;
    const ff_loaded *loaded;
    void *self;
    bool created;
    bool evaluating;
    ff_guarded outputs[FF_MOST_OUTPUTS];
    size_t shapes[FF_MOST_OUTPUTS][FF_MAX_RANK];
    uint32_t ranks[FF_MOST_OUTPUTS];
    char item[96], text[300];
    ff_tables tables; /* that it has read */
    char breach[200]; /* of the interface, completes 'it ...' */
    double stop_at;   /* progress asks to stop from then on */
    bool asked_to_stop;
} ff_trial;

/* create, set, wire, ready. Close it whatever the status is. */
ff_status ff_trial_open(ff_trial *trial, const ff_feed *feed);
/* The results stay until the next call. */
ff_status ff_trial_evaluate(ff_trial *trial, uint64_t wanted, const ff_feed *feed);
void ff_trial_close(ff_trial *trial);
uint64_t ff_all_outputs(const ff_model *model); /* data outputs */
bool ff_feed_suffices(const ff_feed *feed);     /* no input that must be there is missing */

/* Opens an instance with parameters that the model accepts; NULL when none were found. */
ff_feed *ff_find_feed(ff_subject *subject, ff_trial *trial);

void ff_doing(ff_subject *subject, const char *format, ...) __attribute__((format(printf, 2, 3)));
/* The first fault is kept. Return false. */
bool ff_faulty(ff_subject *subject, const char *format, ...) __attribute__((format(printf, 2, 3)));
bool ff_untried(ff_subject *subject, const char *format, ...) __attribute__((format(printf, 2, 3)));

double ff_now(void); /* s */

/* bench.c: what a check of conformance sees of the subject. */
void ff_bench_check(ff_subject *subject, const ff_check *check);

/* Of each service input a plain law that its kind has; NULL: none. */
const void **ff_plain_laws(ff_library *library, const ff_loaded *loaded);

/* The tests. False after a fault. */
bool ff_test_references(ff_subject *subject);
bool ff_test_presets(ff_subject *subject);
bool ff_test_life(ff_subject *subject);
bool ff_test_leaks(ff_subject *subject);
bool ff_test_allocations(ff_subject *subject);
bool ff_test_limits(ff_subject *subject);
bool ff_test_environment(ff_subject *subject);
bool ff_test_wanted(ff_subject *subject);
bool ff_test_repeat(ff_subject *subject);
bool ff_test_inputs(ff_subject *subject);

/* Makes the n-th allocation of the plugin itself fail (0: none) and counts them. False when the
   plugin's calls cannot be redirected. */
bool ff_allocations_watch(const ff_model *model);
void ff_allocations_fail(size_t nth);
size_t ff_allocations_made(void);

#endif
