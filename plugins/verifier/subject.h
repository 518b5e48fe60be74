/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The model under test and the means to work it. A process lives for one test and frees nothing but
   what is the model's. */
#ifndef FF_SUBJECT_H
#define FF_SUBJECT_H

#include <flankfilm/rows.h>
#include <flankfilm/verifier.h>

#include <stdbool.h>

enum { FF_MOST_OUTPUTS = 64, FF_MAX_RANK = 4 };

/* memory.c */
void *ff_alloc(size_t size); /* zeroed */

typedef struct ff_dims {
    uint32_t rank;       /* with the optional one */
    bool first_optional; /* "engagement? station" */
    char name[FF_MAX_RANK][24];
} ff_dims;

ff_dims ff_dims_of(const ff_port *row);

/* Numbers between guard zones, which tell of a write outside. */
typedef struct ff_guarded {
    double *data;
    size_t count;
} ff_guarded;

ff_guarded ff_guarded_new(size_t count); /* holds NaN */
bool ff_guarded_whole(const ff_guarded *guarded);
void ff_guarded_free(ff_guarded *guarded);

/* Splitmix64: the same numbers in every run. */
typedef struct ff_random {
    uint64_t state;
} ff_random;

double ff_uniform(ff_random *random); /* [0, 1) */
size_t ff_below(ff_random *random, size_t count);

typedef struct ff_subject ff_subject;

/* What an instance is made of and fed with. */
typedef struct ff_feed {
    const ff_subject *subject;
    ff_value *values;      /* of each parameter; size 0: not set */
    ff_array *inputs;      /* of each input row */
    const void **services; /* the table of a service input; NULL: not connected */
    ff_guarded *memory;
    size_t (*shapes)[FF_MAX_RANK];
} ff_feed;

struct ff_subject {
    const ff_exam *exam;
    const ff_model *model;
    ff_dims *input_dims, *output_dims;
    ff_random random;
    ff_feed *given;  /* from the user's pipeline, or NULL */
    char doing[128]; /* the call at hand */
};

ff_subject *ff_subject_new(const ff_exam *exam);

/* Parameters inside their calibrated range, or anywhere in their limits and at them; or inside, the
   required ones alone. */
typedef enum ff_reach { FF_INSIDE, FF_LIMITS, FF_NEEDED } ff_reach;

ff_feed *ff_feed_new(const ff_subject *subject);
void ff_feed_draw_values(ff_feed *feed, ff_random *random, ff_reach reach);
void ff_feed_draw_inputs(ff_feed *feed, ff_random *random);
void ff_feed_give(ff_feed *feed, size_t input, const double *data, uint32_t rank,
                  const size_t *shape);

/* One instance and its host. */
typedef struct ff_trial {
    ff_host host;
    const ff_subject *subject;
    void *self;
    bool created;
    bool evaluating;
    ff_guarded outputs[FF_MOST_OUTPUTS];
    size_t shapes[FF_MOST_OUTPUTS][FF_MAX_RANK];
    uint32_t ranks[FF_MOST_OUTPUTS];
    char item[96], text[300];
    void *tables;     /* that it has read */
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

/* Opens an instance with parameters that the model accepts; NULL when none were found, which is
   said unless `quietly`. */
ff_feed *ff_find_feed(ff_subject *subject, ff_trial *trial, bool quietly);

void ff_doing(ff_subject *subject, const char *format, ...) FF_PRINTF(2, 3);
/* The first word stands. Return false. */
bool ff_faulty(ff_subject *subject, const char *format, ...) FF_PRINTF(2, 3);
bool ff_untried(ff_subject *subject, const char *format, ...) FF_PRINTF(2, 3);

double ff_now(void); /* s */

/* bench.c: what a check of conformance sees of the subject. */
void ff_bench_check(ff_subject *subject, const ff_check *check);

/* stage.c: what feeds it, and whether a call left that alone; frees the copies. */
double **ff_feed_copy(const ff_feed *feed);
bool ff_feed_is_whole(ff_subject *subject, const ff_feed *feed, double **copies,
                      const char *function);
/* The outputs of both are the same to the bit. */
bool ff_trial_same(ff_subject *subject, const ff_trial *a, const ff_trial *b, const char *when);

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
bool ff_test_assess(ff_subject *subject);
bool ff_test_judge(ff_subject *subject);

/* Makes the n-th allocation of the plugin itself fail (0: none) and counts them. False when the
   plugin's calls cannot be redirected. */
bool ff_allocations_watch(const ff_model *model);
void ff_allocations_fail(size_t nth);
size_t ff_allocations_made(void);

#endif
