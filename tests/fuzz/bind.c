/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Binding: a document becomes a pipeline of the toy models of tests/bad, and runs if it is legal.
 */
#include "fuzz.h"

#include "../../core/engine/pipeline/pipeline.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static ff_engine *engine; /* models stay loaded */
    const char *toys = getenv("FLANKFILM_FUZZ_TOYS");
    must(toys != NULL);
    ff_engine_options options = {
        .size = sizeof options, .plugin_paths = &toys, .plugin_path_count = 1};
    must(engine || ff_engine_new(&options, &engine) == FF_OK);
    char *text = fuzz_text(data, size);
    ff_report *report = ff_report_new();
    fe_tree *tree = fe_tree_parse("fuzz.yaml", "/nonexistent", text, report);
    ff_pipeline *pipeline = fe_pipeline_build(tree, engine, size % 2, report);
    if (pipeline && ff_report_errors(report) == 0)
        must(fe_pipeline_run(pipeline, NULL, report) == (ff_report_errors(report) == 0));
    else
        must(ff_report_errors(report) > 0);
    fuzz_print(report);
    fe_pipeline_free(pipeline);
    ff_report_free(report);
    fe_tree_free(tree);
    free(text);
    return 0;
}
