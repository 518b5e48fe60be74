/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Studies: a document with `study:`, and some of its cases laid over the toy models of tests/bad.
 */
#include "fuzz.h"

#include "../../core/program/study/study.h"

static void lay(const study_definition *study, size_t index, const char *text, ff_engine *engine)
{
    ff_report *report = ff_report_new();
    ff_tree *tree = ff_tree_parse("fuzz.yaml", "/nonexistent", text, report);
    study_overlay(study, index, NULL, 0, tree, report);
    ff_pipeline_free(ff_pipeline_build(tree, engine, true, report));
    fuzz_print(report);
    ff_report_free(report);
    ff_tree_free(tree);
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
    ff_report *report = ff_report_new();
    ff_tree *tree = ff_tree_parse("fuzz.yaml", "/nonexistent", text, report);
    const ff_node *node = ff_node_get(ff_tree_root(tree), "study");
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
    study_free(study);
    ff_report_free(report);
    ff_tree_free(tree);
    free(text);
    return 0;
}
