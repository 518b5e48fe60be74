/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What any model owes, as `flankfilm verify` tests it. */
#include "subject.h"

/* A row of the verifier's table, and what it stands for. */
static const struct test {
    ff_verifier_test row;
    bool (*run)(verify_subject *subject);
} tests[] = {
    {{"references", "licence, reference and BibTeX can be read", FF_ABOUT_ALL},
     verify_test_references},
    {{"presets", "presets lie in the calibrated range", FF_ABOUT_PARAMS}, verify_test_presets},
    {{"life", "lives and dies in every legal order", FF_ABOUT_ALL}, verify_test_life},
    {{"leaks", "a thousand lives leave no memory behind", FF_ABOUT_ALL}, verify_test_leaks},
    {{"allocations", "survives a failing allocation", FF_ABOUT_ALL}, verify_test_allocations},
    {{"limits", "takes parameters in and at their limits, or says why not", FF_ABOUT_PARAMS},
     verify_test_limits},
    {{"environment", "leaves locale, arithmetic, signals and folder alone", FF_ABOUT_ALL},
     verify_test_environment},
    {{"inputs", "gives finite outputs or a reason for any input", FF_ABOUT_DATA},
     verify_test_inputs},
    {{"wanted", "gives each output that is wanted", FF_ABOUT_DATA}, verify_test_wanted},
    {{"repeat", "gives the same outputs again, and in two threads", FF_ABOUT_DATA},
     verify_test_repeat},
    {{"assess", "promises an error and a cost, or says why not, for any input", FF_ABOUT_ASSESS},
     verify_test_assess},
    {{"judge", "says how far a law moves its results, or why not, for any input", FF_ABOUT_JUDGE},
     verify_test_judge},
};
enum { TESTS = sizeof tests / sizeof tests[0] };

static void run(void *self, const ff_exam *exam, size_t test)
{
    (void)self;
    tests[test].run(verify_subject_new(exam));
}

static void check(void *self, const ff_exam *exam, const ff_check *asked)
{
    (void)self;
    verify_bench_check(verify_subject_new(exam), asked);
}

static const void *service(void *self, uint32_t output)
{
    static const ff_verifier verifier = {.size = sizeof verifier,
                                         .tests = &tests[0].row,
                                         .test_count = TESTS,
                                         .test_stride = sizeof tests[0],
                                         .run = run,
                                         .check = check};
    (void)self, (void)output;
    return &verifier;
}

static ff_status create(const ff_host *host, void **self)
{
    (void)host;
    *self = NULL;
    return FF_OK;
}

static const ff_port outputs[] = {{.name = "verifier",
                                   .unit = "",
                                   .doc = "tests of any model",
                                   .dims = "",
                                   .service = FF_VERIFIER_ID}};

static const ff_model model = {
    .size = sizeof model,
    .abi_major = FF_ABI_MAJOR,
    .abi_minor = 1,
    .id = "verifier/any",
    .version = "1.0.0",
    .summary = "tests what any model owes: a life without leaks, finite outputs, reasons",
    .reference = "",
    .bibtex = "",
    .licence = "GPL-3.0-or-later",
    .params = FF_NO_TABLE,
    .inputs = FF_NO_TABLE,
    .outputs = FF_TABLE(outputs),
    .create = create,
    .service = service,
};

const ff_model *flankfilm_model_v1(void)
{
    return &model;
}
