/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The model under test and the means to work it. A process lives for one test and frees nothing but
   what is the model's. */
#ifndef VERIFY_SUBJECT_H
#define VERIFY_SUBJECT_H

#include <flankfilm/rows.h>
#include <flankfilm/verifier.h>

#include <stdbool.h>

enum { VERIFY_MOST_OUTPUTS = 64, VERIFY_MAX_RANK = 4 };

/* memory.c */
void *verify_alloc(size_t size); /* zeroed */

typedef struct verify_dims {
    uint32_t rank;       /* with the optional one */
    bool first_optional; /* "engagement? station" */
    char name[VERIFY_MAX_RANK][24];
} verify_dims;

verify_dims verify_dims_of(const ff_port *row);

/* Numbers between guard zones, which tell of a write outside. */
typedef struct verify_guarded {
    double *data;
    size_t count;
} verify_guarded;

verify_guarded verify_guarded_new(size_t count); /* holds NaN */
bool verify_guarded_whole(const verify_guarded *guarded);
void verify_guarded_free(verify_guarded *guarded);

/* Splitmix64: the same numbers in every run. */
typedef struct verify_random {
    uint64_t state;
} verify_random;

double verify_uniform(verify_random *random); /* [0, 1) */
size_t verify_below(verify_random *random, size_t count);

typedef struct verify_subject verify_subject;

/* What an instance is made of and fed with. */
typedef struct verify_feed {
    const verify_subject *subject;
    ff_value *values;      /* of each parameter; size 0: not set */
    ff_array *inputs;      /* of each input row */
    const void **services; /* the table of a service input; NULL: not connected */
    verify_guarded *memory;
    size_t (*shapes)[VERIFY_MAX_RANK];
} verify_feed;

struct verify_subject {
    const ff_exam *exam;
    const ff_model *model;
    verify_dims *input_dims, *output_dims;
    verify_random random;
    verify_feed *given; /* from the user's pipeline, or NULL */
    char doing[128];    /* the call at hand */
};

verify_subject *verify_subject_new(const ff_exam *exam);

/* Parameters inside their calibrated range, or anywhere in their limits and at them; or inside, the
   required ones alone. */
typedef enum verify_reach { VERIFY_INSIDE, VERIFY_LIMITS, VERIFY_NEEDED } verify_reach;

verify_feed *verify_feed_new(const verify_subject *subject);
void verify_feed_draw_values(verify_feed *feed, verify_random *random, verify_reach reach);
void verify_feed_draw_inputs(verify_feed *feed, verify_random *random);
void verify_feed_give(verify_feed *feed, size_t input, const double *data, uint32_t rank,
                      const size_t *shape);

/* One instance and its host. */
typedef struct verify_trial {
    ff_host host;
    const verify_subject *subject;
    void *self;
    bool created;
    bool evaluating;
    verify_guarded outputs[VERIFY_MOST_OUTPUTS];
    size_t shapes[VERIFY_MOST_OUTPUTS][VERIFY_MAX_RANK];
    uint32_t ranks[VERIFY_MOST_OUTPUTS];
    char item[96], text[300];
    void *tables;     /* that it has read */
    char breach[200]; /* of the interface, completes 'it ...' */
    double stop_at;   /* progress asks to stop from then on */
    bool asked_to_stop;
} verify_trial;

/* create, set, wire, ready. Close it whatever the status is. */
ff_status verify_trial_open(verify_trial *trial, const verify_feed *feed);
/* The results stay until the next call. */
ff_status verify_trial_evaluate(verify_trial *trial, uint64_t wanted, const verify_feed *feed);
void verify_trial_close(verify_trial *trial);
uint64_t verify_all_outputs(const ff_model *model); /* data outputs */
bool verify_feed_suffices(const verify_feed *feed); /* no input that must be there is missing */

/* Opens an instance with parameters that the model accepts; NULL when none were found, which is
   said unless `quietly`. */
verify_feed *verify_find_feed(verify_subject *subject, verify_trial *trial, bool quietly);

void verify_doing(verify_subject *subject, const char *format, ...) FF_PRINTF(2, 3);
/* The first word stands. Return false. */
bool verify_faulty(verify_subject *subject, const char *format, ...) FF_PRINTF(2, 3);
bool verify_untried(verify_subject *subject, const char *format, ...) FF_PRINTF(2, 3);

double verify_now(void); /* s */

/* bench.c: what a check of conformance sees of the subject. */
void verify_bench_check(verify_subject *subject, const ff_check *check);

/* stage.c: what feeds it, and whether a call left that alone; frees the copies. */
double **verify_feed_copy(const verify_feed *feed);
bool verify_feed_is_whole(verify_subject *subject, const verify_feed *feed, double **copies,
                          const char *function);
/* The outputs of both are the same to the bit. */
bool verify_trial_same(verify_subject *subject, const verify_trial *a, const verify_trial *b,
                       const char *when);

/* The tests. False after a fault. */
bool verify_test_references(verify_subject *subject);
bool verify_test_presets(verify_subject *subject);
bool verify_test_life(verify_subject *subject);
bool verify_test_leaks(verify_subject *subject);
bool verify_test_allocations(verify_subject *subject);
bool verify_test_limits(verify_subject *subject);
bool verify_test_environment(verify_subject *subject);
bool verify_test_wanted(verify_subject *subject);
bool verify_test_repeat(verify_subject *subject);
bool verify_test_inputs(verify_subject *subject);
bool verify_test_assess(verify_subject *subject);
bool verify_test_judge(verify_subject *subject);

/* Makes the n-th allocation of the plugin itself fail (0: none) and counts them. False when the
   plugin's calls cannot be redirected. */
bool verify_allocations_watch(const ff_model *model);
void verify_allocations_fail(size_t nth);
size_t verify_allocations_made(void);

#endif
