/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What an instance has in its members stays until it is destroyed, whatever is set in between. */
#include <flankfilm/engine.h>

#include <check.h>

#include <stdio.h>
#include <stdlib.h>

static double run(ff_instance *instance, const char *output)
{
    const ff_result *result;
    if (ff_instance_run(instance, NULL) != FF_OK ||
        ff_instance_result(instance, output, &result) != FF_OK)
        return -1;
    return result->data[0];
}

/* toy/placed aborts in destroy when its text or its list is not what it was in ready. */
int main(void)
{
    const char *directory = getenv("FLANKFILM_TEST_BAD");
    const ff_engine_options options = {sizeof options, &directory, 1};
    const double list[] = {1, 2, 3};
    ff_engine *engine;
    ff_instance *instance;
    if (ff_engine_new(&options, &engine) != FF_OK ||
        ff_instance_new(engine, "toy/placed", &instance) != FF_OK)
        return 2;
    ff_instance_set(instance, "text", "a text that is longer than others");
    ff_instance_set(instance, "list", "[1 kg, 2 kg, 4 kg, 8 kg]");
    check_true("a text", run(instance, "text") == 33);
    check_true("a list", run(instance, "sum") == 15);
    ff_instance_set(instance, "text", "one");
    ff_instance_set(instance, "text", "four");
    ff_instance_set_reals(instance, "list", list, 3);
    check_true("another text", run(instance, "text") == 4);
    check_true("another list", run(instance, "sum") == 6);
    ff_instance_set(instance, "text", NULL);
    ff_instance_set(instance, "list", NULL);
    check_true("no text", run(instance, "text") == -1);
    check_true("no list", run(instance, "list") == 0);
    ff_instance_set(instance, "real", "3 mm");
    ff_instance_set(instance, "integer", "many");
    check_true("a number", run(instance, "real") == 3e-3);
    check_true("a word", run(instance, "integer") == -1);
    ff_instance_close(instance);
    ff_engine_close(engine);
    return check_done();
}
