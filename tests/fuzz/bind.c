/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Binding: a document becomes a pipeline of the toy models of tests/bad, and runs if it is legal.
 */
#include "fuzz.h"

#include "../../core/engine/pipeline/pipeline.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static fe_library *library; /* models stay loaded */
    const char *toys = getenv("FLANKFILM_FUZZ_TOYS");
    must(toys != NULL);
    if (!library)
        library = fe_library_new(&toys, 1);
    char *text = fuzz_text(data, size);
    fe_report *report = fe_report_new();
    fe_tree *tree = fe_tree_parse("fuzz.yaml", "/nonexistent", text, report);
    fe_pipeline *pipeline = fe_pipeline_build(tree, library, size % 2, report);
    if (pipeline && fe_report_errors(report) == 0)
        must(fe_pipeline_run(pipeline, NULL, report) == (fe_report_errors(report) == 0));
    else
        must(fe_report_errors(report) > 0);
    fuzz_print(report);
    fe_pipeline_free(pipeline);
    fe_report_free(report);
    fe_tree_free(tree);
    free(text);
    return 0;
}
