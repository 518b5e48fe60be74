/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the tests of core/engine/value share. */
#ifndef VALUE_CHECK_H
#define VALUE_CHECK_H

#include <check.h>
#include <stdlib.h>

/* Runs one suite; the exit code of main. A suite without a test has failed. */
static inline int run_suite(Suite *suite)
{
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_NORMAL);
    int passed = srunner_ntests_run(runner) > 0 && srunner_ntests_failed(runner) == 0;
    srunner_free(runner);
    return passed ? EXIT_SUCCESS : EXIT_FAILURE;
}

static inline void add_test(Suite *suite, const TTest *test)
{
    TCase *group = tcase_create(test->name);
    tcase_add_test(group, test);
    suite_add_tcase(suite, group);
}

static inline void add_loop(Suite *suite, const TTest *test, size_t rows)
{
    TCase *group = tcase_create(test->name);
    tcase_add_loop_test(group, test, 0, (int)rows);
    suite_add_tcase(suite, group);
}

#define ROWS(table) (sizeof(table) / sizeof *(table))

#endif
