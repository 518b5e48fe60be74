/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The loader against plugins whose descriptor or file is wrong. */
#include "pipeline-try.h"

#include <float.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static attempt load_from(const char *directory, const char *id, const ff_loaded **loaded)
{
    attempt a = {.report = ff_report_new(), .engine = try_engine(&directory, 1)};
    *loaded = ff_engine_model(a.engine, id, FF_NOWHERE, a.report);
    return a;
}

static void refuses(const char *id, int exit_code, const char *phrase)
{
    const ff_loaded *loaded;
    attempt a = load_from(try_plugins(), id, &loaded);
    check_error(id, &a, 0, 0, phrase);
    check_true("it is not loaded", !loaded);
    check_true("its exit code", ff_report_fault(a.report) == exit_code);
    if (exit_code == FF_FAULT_PLUGIN)
        check_error("the sentence names the file", &a, 0, 0, id);
    try_close(&a);
}

static void descriptors(void)
{
    static const struct {
        const char *fault, *phrase;
    } cases[] = {
        {"null", "gives no model"},
        {"major", "made for version 2 of the plugin interface, but this program has 1"},
        {"minor", "needs version 1.4 of the plugin interface"},
        {"small", "less than version 1.0 of the interface has"},
        {"id", "calls itself \"faulty/another\", but its place says \"faulty/id\""},
        {"no-licence", "states no licence"},
        {"no-evaluate", "lacks the function \"evaluate\""},
        {"no-create", "lacks the function \"create\""},
        {"no-table", "states that it has 2 parameters, but gives no table"},
        {"stride", "table of outputs in rows of 8 bytes"},
        {"many", "has 1001 outputs; at most 1000 are possible"},
        {"many-old", "has 65 outputs; for more than 64 it must ask for version 1.2"},
        {"list-both", "has both functions flankfilm_model_v1 and flankfilm_models_v1"},
        {"list-empty", "gives an empty list of models"},
        {"list-id", "gives a list with a model that has no id"},
        {"list-null", "gives no list of models"},
        {"list-twice", "gives a list that has one id twice"},
        {"no-output", "offers no output"},
        {"param-twice", "has the parameter \"size\" twice"},
        {"map", "has the parameter \"size\" twice"},
        {"param-name", "gives its parameter 1 the invalid name"},
        {"param-use", "calls a parameter \"use\""},
        {"param-unit", "has a bad unit for the parameter \"size\": the unit \"mmm\""},
        {"param-type", "the unknown type 99"},
        {"param-doc", "no line of explanation for the parameter \"size\""},
        {"cost", "states an impossible cost"},
        {"feedback-old", "does not ask for version 1.2, which feedback needs"},
        {"feedback-one",
         "feedback for only one of the inputs \"source.level\" and \"source.series\""},
        {"feedback-output", "has unknown flags for the output \"level\""},
        {"feedback-required", "has feedback that is not optional for the input \"source.level\""},
        {"feedback-service", "has feedback of a service for the input \"law\""},
        {"bounds", "has impossible bounds for the output \"level\""},
        {"difference", "has a difference that is not in K for the output \"level\""},
        {"apart", "has a negative allowed difference for the output \"level\""},
        {"headline", "has an unknown headline for the output \"level\""},
        {"origin", "is counted from an input that the model does not have for the output"},
        {"shown", "shows the output \"level\" in \"kg\", a unit of another dimension"},
        {"instead", "lets \"nothing\" replace the parameter \"size\", but it is not an optional"},
        {"instead-old", "replace the parameter \"size\", but it is a data input, which needs"},
        {"instead-needed",
         "lets \"law\" replace the parameter \"size\", but it is not an optional"},
        {"place-behind", "places the parameter \"size\" behind the 16 bytes of its instance"},
        {"place-crooked", "places the parameter \"size\" at byte 4, where its type cannot stand"},
        {"place-old", "place for the parameter \"size\", but does not ask for version 1.2"},
        {"place-over", "places the parameters \"size\" and \"words\" over each other"},
        {"place-size", "place for the parameter \"size\", but does not state the size of its"},
        {"preset", "has an impossible preset \"1 kg\""},
        {"preset-limit", "it must be at least 2 mm"},
        {"limits", "has impossible limits 3 to 2"},
        {"choices", "the choice \"\""},
        {"no-choices", "nothing to choose from"},
        {"wire-param", "calls both a wire and a parameter \"source\""},
        {"output-twice", "has the output \"level\" twice"},
        {"output-unit", "has a bad unit for the output \"level\": the unit \"furlong\""},
        {"output-si", "the unit \"mm\" for the output \"level\", which is not coherent SI"},
        {"dims", "has bad dimensions for the output \"series\""},
        {"deep", "names more than 4 dimensions"},
        {"optional-dim", "optional that is not the first"},
        {"input-name", "gives its input 1 the name \"level\""},
        {"input-from", "from different kinds"},
        {"no-entry", "has no function flankfilm_model_v1"},
        {"no-function", "cannot be loaded: undefined symbol: a_function_that_nobody_has"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char id[64];
        snprintf(id, sizeof id, "faulty/%s", cases[i].fault);
        refuses(id, FF_FAULT_PLUGIN, cases[i].phrase);
    }
}

static void names(void)
{
    refuses("toy/surce", FF_FAULT_INPUT, "did you mean \"toy/source\"?");
    refuses("toy/surce", FF_FAULT_INPUT, "/toy/surce.so");
    refuses("toy/nothing-near", FF_FAULT_INPUT, "the models of this kind are toy/");
    refuses("toys/nothing-near", FF_FAULT_INPUT, "there is no model \"toys/nothing-near\"");
    refuses("../toy/source", FF_FAULT_INPUT, "does not name a model");
    refuses("toy/source.so", FF_FAULT_INPUT, "does not name a model");
    refuses("toy/../toy/source", FF_FAULT_INPUT, "does not name a model");
    refuses("toy", FF_FAULT_INPUT, "does not name a model");
    refuses("Toy/Source", FF_FAULT_INPUT, "did you mean \"toy/source\"?");
    refuses("source", FF_FAULT_INPUT, "did you mean \"toy/source\"?");
    refuses("", FF_FAULT_INPUT, "does not name a model");
    refuses("toy/", FF_FAULT_INPUT, "does not name a model");
    refuses("/tmp/x", FF_FAULT_INPUT, "does not name a model");
}

static void loads_once(void)
{
    const ff_loaded *first;
    attempt a = load_from(try_plugins(), "toy/source", &first);
    check_true("a healthy model loads", first && ff_report_count(a.report) == 0);
    check_true("the second time gives the same",
               ff_engine_model(a.engine, "toy/source", FF_NOWHERE, a.report) == first);
    check_true("rows are found by name", first && ff_model_find_param(first->model, "share") == 2 &&
                                             ff_model_find_param(first->model, "shar") == -1);
    check_true("optional leading dimension",
               first && first->output_dims[6].first_optional && first->output_dims[6].rank == 2);
    size_t count;
    const char *const *ids = ff_engine_ids(a.engine, &count);
    bool sorted = true, found = false;
    for (size_t i = 0; i < count; i++) {
        sorted = sorted && (i == 0 || strcmp(ids[i - 1], ids[i]) < 0);
        found = found || !strcmp(ids[i], "toy/source");
    }
    check_true("the list of ids is sorted and whole", sorted && found && count > 60);
    try_close(&a);
}

static void several_models(void)
{
    const ff_loaded *first;
    attempt a = load_from(try_plugins(), "toy/several", &first);
    const ff_loaded *wide = ff_engine_model(a.engine, "toy/wide", FF_NOWHERE, a.report);
    check_true("both models of an object load", ff_report_count(a.report) == 0);
    check_true("each by its own id", first && wide && !strcmp(first->model->id, "toy/several") &&
                                         !strcmp(wide->model->id, "toy/wide"));
    check_true("and its own path", wide && strstr(wide->path, "/toy/wide.so"));
    check_true("of one object", first && wide && first->model->create == wide->model->create);
    refuses("toy/absent", FF_FAULT_PLUGIN,
            "has the models toy/several, toy/wide, but its place says \"toy/absent\"");
    try_close(&a);
}

static void keeps_arithmetic(void)
{
    const ff_loaded *loaded;
    volatile double smallest = DBL_MIN;
    attempt a = load_from(try_plugins(), "faulty/fast-math", &loaded);
    check_true("a model linked with -ffast-math loads", loaded != NULL);
    check_true("with a warning", try_says(&a, FF_WARNING, 0, 0, "flush small numbers to zero"));
    check_true("and subnormal numbers are still there", smallest / 2 > 0);
    try_close(&a);
}

/* A directory of our own with the kind "own". */
static char home[64];

static void own_path(char *path, size_t size, const char *name)
{
    snprintf(path, size, "%s/own/%s.so", home, name);
}

static void write_own(const char *name, const char *bytes, size_t count)
{
    char path[256];
    own_path(path, sizeof path, name);
    FILE *file = fopen(path, "wb");
    if (!file || fwrite(bytes, 1, count, file) != count || fclose(file) != 0)
        exit(2);
}

static size_t read_model(const char *id, char *bytes, size_t most)
{
    char path[4096];
    snprintf(path, sizeof path, "%s/%s.so", try_plugins(), id);
    FILE *file = fopen(path, "rb");
    size_t count = file ? fread(bytes, 1, most, file) : 0;
    if (!file || count == most || fclose(file) != 0)
        exit(2);
    return count;
}

static void refuses_own(const char *name, const char *phrase)
{
    const ff_loaded *loaded;
    char id[64];
    snprintf(id, sizeof id, "own/%s", name);
    attempt a = load_from(home, id, &loaded);
    check_error(name, &a, 0, 0, phrase);
    check_true("a plugin's fault", ff_report_fault(a.report) == FF_FAULT_PLUGIN && !loaded);
    try_close(&a);
}

static void broken_files(void)
{
    enum { MOST = 1 << 20 };
    char path[256];
    char *bytes = malloc(MOST);
    size_t count = read_model("toy/law", bytes, MOST);
    static const char text[] = "#!/bin/sh\nexit 0\n";
    write_own("empty", "", 0);
    write_own("text", text, sizeof text - 1);
    write_own("law", bytes, count);
    bytes[4] = 1; /* EI_CLASS: 32 bits */
    write_own("narrow", bytes, count);
    bytes[4] = 2;
    own_path(path, sizeof path, "folder");
    mkdir(path, 0700);
    own_path(path, sizeof path, "link");
    check_true("a link that leads nowhere", symlink("/nowhere/at/all", path) == 0);
    own_path(path, sizeof path, "pipe");
    check_true("a pipe", mkfifo(path, 0600) == 0);
    refuses_own("empty", "is empty");
    refuses_own("text", "is not a shared object");
    refuses_own("folder", "is not a file");
    refuses_own("pipe", "is not a file");
    refuses_own("link", "cannot be opened");
    if (sizeof(void *) == 8)
        refuses_own("narrow", "for another kind of processor");
    refuses_own("law", "calls itself \"toy/law\", but its place says \"own/law\"");
    for (size_t cut = 1; cut < count; cut += count / 24) {
        write_own("cut", bytes, cut);
        refuses_own("cut", cut < 4 ? "is not a shared object" : "was cut short");
    }
    free(bytes);
}

/* The first of two directories wins, even when what stands there is broken. */
static void order_of_search(void)
{
    const ff_loaded *loaded;
    const char *const both[] = {home, try_plugins()};
    char path[256];
    snprintf(path, sizeof path, "%s/toy", home);
    mkdir(path, 0700);
    snprintf(path, sizeof path, "%s/toy/law.so", home);
    FILE *file = fopen(path, "w");
    if (!file || fclose(file) != 0)
        exit(2);
    attempt a = {.report = ff_report_new(), .engine = try_engine(both, 2)};
    loaded = ff_engine_model(a.engine, "toy/law", FF_NOWHERE, a.report);
    check_error("the first file found is the one used", &a, 0, 0, "is empty");
    check_true("what stands behind it is not looked at", !loaded);
    loaded = ff_engine_model(a.engine, "toy/source", FF_NOWHERE, a.report);
    check_true("the second directory is searched", loaded != NULL);
    try_close(&a);
    ff_instance *law;
    const char *const reversed[] = {try_plugins(), home};
    a = (attempt){.report = ff_report_new(), .engine = try_engine(reversed, 2)};
    check_true("a file behind the one used changes nothing",
               ff_instance_new(a.engine, "toy/law", &law) == FF_OK);
    check_true("but is named", strstr(ff_engine_message(a.engine), " takes the place of ") &&
                                   strstr(ff_engine_message(a.engine), path));
    ff_instance_close(law);
    try_close(&a);
    setenv("FLANKFILM_PLUGIN_PATH", try_plugins(), 1);
    a = (attempt){.report = ff_report_new(), .engine = try_engine(NULL, 0)};
    check_true("FLANKFILM_PLUGIN_PATH is searched",
               ff_engine_model(a.engine, "toy/law", FF_NOWHERE, a.report) != NULL);
    try_close(&a);
    unsetenv("FLANKFILM_PLUGIN_PATH");
    char link[300], target[4096];
    snprintf(path, sizeof path, "%s/flankfilm", home);
    mkdir(path, 0700);
    snprintf(link, sizeof link, "%s/plugins", path);
    bool linked = realpath(try_plugins(), target) && symlink(target, link) == 0;
    setenv("XDG_DATA_HOME", home, 1);
    a = (attempt){.report = ff_report_new(), .engine = try_engine(NULL, 0)};
    check_true("the user's data directory is searched",
               linked && ff_engine_model(a.engine, "toy/law", FF_NOWHERE, a.report) != NULL);
    try_close(&a);
}

int main(void)
{
    snprintf(home, sizeof home, "/tmp/flankfilm-load-%d", (int)getpid());
    if (mkdir(home, 0700) != 0)
        return 2;
    char path[256], command[256];
    snprintf(path, sizeof path, "%s/own", home);
    mkdir(path, 0700);
    descriptors();
    names();
    loads_once();
    several_models();
    keeps_arithmetic();
    broken_files();
    order_of_search();
    snprintf(command, sizeof command, "rm -r %s", home);
    return system(command) != 0 || check_done();
}
