/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Studies: a document with `study:`, and some of its cases laid over the toy models of tests/bad.
 */
#include "fuzz.h"

#include "../../core/program/study/kinds/kinds.h"

#include <sys/mman.h>
#include <unistd.h>

static ff_run *parse(ff_engine *engine, const char *text)
{
    ff_run *run;
    ff_run_parse(engine, "fuzz.yaml", "/nonexistent", text, &run);
    must(run != NULL);
    return run;
}

static void lay(const study_definition *study, size_t index, const char *text, ff_engine *engine)
{
    ff_run *run = parse(engine, text);
    study_overlay(study, index, NULL, 0, run);
    ff_run_build(run, true);
    fuzz_print(ff_run_report(run));
    ff_run_close(run);
}

/* The same bytes as a table of cases. */
static void read_table(ff_engine *engine, const uint8_t *data, size_t size)
{
    char document[80];
    int file = memfd_create("table", MFD_CLOEXEC);
    must(file >= 0 && write(file, data, size) == (ssize_t)size);
    snprintf(document, sizeof document, "study: {cases: /proc/self/fd/%d}", file);
    ff_run *run = parse(engine, document);
    ff_report *report = ff_run_report(run);
    study_definition *study = study_read(ff_node_get(ff_run_root(run), "study"), report);
    bool good = study && ff_report_errors(report) == 0;
    must(!good || study->count > 0);
    for (size_t i = 0; good && i < study->count; i++)
        for (size_t k = 0; k < study->varied_count; k++)
            must(study_value(study, k, i) != NULL);
    if (good)
        study_overlay(study, study->count - 1, NULL, 0, run);
    fuzz_print(report);
    study_free(study);
    ff_run_close(run);
    close(file);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static ff_engine *engine; /* models stay loaded */
    const char *toys = getenv("FLANKFILM_FUZZ_TOYS");
    must(toys != NULL);
    ff_engine_options options = {
        .size = sizeof options, .plugin_paths = &toys, .plugin_path_count = 1};
    must(engine || ff_engine_new(&options, &engine) == FF_OK);
    char *text = fuzz_text(data, size);
    ff_run *run = parse(engine, text);
    ff_report *report = ff_run_report(run);
    const ff_node *node = ff_node_get(ff_run_root(run), "study");
    study_definition *study = node ? study_read(node, report) : NULL;
    bool good = study && ff_report_errors(report) == 0;
    must(!node || good || ff_report_errors(report) > 0);
    size_t chains = good ? study_chains(study) : 0;
    must(!good || chains * study_chain_length(study) == study->count);
    for (size_t i = 0; i < chains && i < 3; i++) {
        lay(study, study_chain_case(study, i * (chains - 1) / 2, 0), text, engine);
        for (size_t k = 0; k < study->varied_count; k++)
            must(study_value(study, k, i * (chains - 1) / 2) != NULL);
    }
    fuzz_print(report);
    read_table(engine, data, size);
    study_free(study);
    ff_run_close(run);
    free(text);
    return 0;
}
