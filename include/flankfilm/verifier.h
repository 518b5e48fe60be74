/* SPDX-License-Identifier: MIT */
/*
 * Service "flankfilm.verifier/1": tests what every model owes, whatever its kind.
 *
 * `flankfilm verify FILE.so` runs each test of the model verifier/any in a process of its own with
 * a time limit: a crash, a hang or a call of exit() is a finding like any other, and a test may
 * leave memory behind. What the models of one kind owe beyond that, conformance.h says; the
 * verifier offers those checks the bench that they work the subject on.
 */
#ifndef FLANKFILM_VERIFIER_H
#define FLANKFILM_VERIFIER_H

#include "conformance.h"
#include "table.h"

#define FF_VERIFIER_ID "flankfilm.verifier/1"

/* Reads the tables of one instance for a host that offers FF_TABLE_ID. */
typedef struct ff_table_keeper {
    size_t size;
    void *(*open)(void);
    void (*close)(void *kept); /* with all tables that it has read */
    /* As those of ff_table_reader. FF_BUG: the rows or the table cannot be. */
    ff_status (*read)(void *kept, const char *item, const char *path, const ff_param *rows,
                      size_t count, size_t stride, const ff_table **table);
    ff_status (*fail)(void *kept, const ff_table *table, size_t row, size_t column,
                      const char *text);
    /* What was said of the last call, and of which parameter; NULL: it was well. */
    const char *(*why)(void *kept, const char **item);
} ff_table_keeper;

/* The subject of a test; lives as long as the process. */
typedef struct ff_exam {
    size_t size;
    void *ctx;             /* first argument of every function below */
    const ff_model *model; /* was loaded and keeps the rules for tables */
    const double *factors; /* of each parameter's unit: SI = factor number + offset */
    const double *offsets;
    const void *const *laws; /* a plain law for each service input; NULL: none */

    /* Parameters and inputs of the user's run (--pipeline), of each row; values of size 0 are not
       set. `values` NULL: there is none. Data are there for tests that need them. */
    const ff_value *values;
    const ff_array *inputs;

    /* What is tried next: names the call in which a crash or a hang is found. */
    void (*doing)(void *ctx, const char *text);
    /* A test that says nothing has passed; the first word stands. */
    void (*fault)(void *ctx, const char *text);
    void (*untried)(void *ctx, const char *text);

    /* A parameter from text as a user writes it; NULL: its preset. 0: it is refused. `said`: the
       first error or warning, until the next call, or NULL. */
    int32_t (*read)(void *ctx, uint32_t param, const char *text, ff_value *value,
                    const char **said);
    /* What of the process is not as it was before the test: a clause that completes 'the plugin
       ...'; NULL: nothing. */
    const char *(*disturbed)(void *ctx);
    const ff_table_keeper *tables;
} ff_exam;

/* Which models a test is about. */
enum {
    FF_ABOUT_ALL = 0,
    FF_ABOUT_PARAMS = 1, /* those with parameters */
    FF_ABOUT_DATA = 2,   /* those with data outputs; they get inputs */
    FF_ABOUT_ASSESS = 3, /* those that assess themselves; the same */
    FF_ABOUT_JUDGE = 4   /* those that judge laws; the same */
};

typedef struct ff_verifier_test {
    const char *name;  /* "leaks" */
    const char *claim; /* one line: what holds */
    int32_t about;
} ff_verifier_test;

typedef struct ff_verifier {
    size_t size;
    void *self;
    const ff_verifier_test *tests;
    size_t test_count, test_stride;
    void (*run)(void *self, const ff_exam *exam, size_t test);
    /* A check of the subject's kind. */
    void (*check)(void *self, const ff_exam *exam, const ff_check *check);
} ff_verifier;

#endif
