/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * What a study reads back of its own: the journal, a log of arrays, study.json, table.csv and
 * the kept results of a stage, parted by bytes 30. The lines of the journal and the kept results
 * get their checksums here, since anybody can compute them.
 */
#include "fuzz.h"

#include "../../core/program/results/view.h"
#include "../../core/program/study/store/array-read.h"
#include "../../core/program/study/store/hash.h"
#include "../../core/program/study/store/journal.h"
#include "../../core/program/study/store/reuse.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

enum { PART = 30, PARTS = 5, MOST_STAGES = 8 };

static const char document[] = "format: 2\n"
                               "pipeline:\n"
                               "  s: {use: toy/source, level: 1 mm, weights: [1 kg]}\n"
                               "  c: {use: toy/consumer}\n"
                               "outputs: [s.series, c.sum]\n";

static char folder[] = "/tmp/flankfilm-fuzz-XXXXXX";

static void leave(void)
{
    static const char *const names[] = {"journal.jsonl", "arrays.1.log", "study.json", "table.csv",
                                        ".flankfilm-study"};
    char path[80];
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        snprintf(path, sizeof path, "%s/%s", folder, names[i]);
        unlink(path);
    }
    rmdir(folder);
}

static FILE *open_file(const char *name)
{
    char path[80];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *file = fopen(path, "we");
    must(file != NULL);
    return file;
}

static void put_file(const char *name, const uint8_t *data, size_t size)
{
    FILE *file = open_file(name);
    must(fwrite(data, 1, size, file) == size);
    fclose(file);
}

/* Writes the lines, each with its checksum in place of its last brace. */
static void put_journal(const uint8_t *data, size_t size)
{
    FILE *file = open_file("journal.jsonl");
    for (size_t at = 0, end; at < size; at = end + 1) {
        const uint8_t *found = memchr(data + at, '\n', size - at);
        end = found ? (size_t)(found - data) : size;
        size_t body = end > at && data[end - 1] == '}' ? end - at - 1 : end - at;
        fwrite(data + at, 1, body, file);
        fprintf(file, ",\"sum\":\"%016llx\"}\n",
                (unsigned long long)study_hash(STUDY_HASH_START, data + at, body));
    }
    fclose(file);
}

static void read_arrays(arrays_reader *reader, const json_t *record)
{
    memory_arena arena = {0};
    const char *name;
    json_t *entry;
    size_t rank, count;
    char why[ARRAYS_WHY];
    json_object_foreach(json_object_get(record, "arrays"), name, entry)
    {
        const double *values = study_array_read(reader, record, name, &arena, &rank, &count, why);
        double sum = 0;
        for (size_t i = 0; values && i < count; i++)
            sum += values[i];
        must(!values || sum == sum || sum != sum);
    }
    memory_arena_free(&arena);
}

static void read_records(void)
{
    study_records *records = study_records_open(folder, true);
    arrays_reader reader;
    json_t *record;
    size_t at = 0;
    int directory = open(folder, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    arrays_reader_open(&reader, directory);
    while ((record = study_records_next(records, &at, NULL))) {
        const char *key = json_string_value(json_object_get(record, "key"));
        read_arrays(&reader, record);
        if (key) {
            study_judgement judgement = study_records_judge(records, key);
            must(judgement.verdict >= 0);
        }
        json_decref(record);
    }
    arrays_reader_close(&reader);
    close(directory);
    study_records_close(records);
}

/* What report and export read. */
static void read_view(void)
{
    ff_report *report = ff_report_new();
    const results_view *view =
        study_check_format(folder, report) ? results_view_open(folder, report) : NULL;
    for (size_t v = 0; view && v < view->variable_count; v++)
        for (size_t c = 0; c < view->case_count && c < 4; c++) {
            ff_array array;
            if (results_view_load(view, v, c, &array))
                results_view_release(&array);
        }
    results_view_close(view);
    fuzz_print(report);
    ff_report_free(report);
}

static void read_stage(const uint8_t *data, size_t size, ff_engine *engine)
{
    ff_run *run;
    ff_run_parse(engine, "fuzz.yaml", "/nonexistent", document, &run);
    must(run && ff_run_build(run, true) == FF_OK);
    ff_pipeline *pipeline = ff_run_pipeline(run);
    uint64_t fingerprints[MOST_STAGES], sum = study_hash(STUDY_HASH_START ^ 2, data, size);
    study_reuse_stats stats[MOST_STAGES] = {{0}};
    must(pipeline && pipeline->count <= MOST_STAGES);
    study_fingerprint(pipeline, fingerprints);
    ff_stage *stage = &pipeline->stages[pipeline->order[0]];
    char name[20];
    snprintf(name, sizeof name, "%016llx",
             (unsigned long long)study_hash_evaluation(pipeline, stage, fingerprints));
    FILE *file = open_file(name);
    fwrite(&sum, sizeof sum, 1, file);
    fwrite(data, 1, size, file);
    fclose(file);
    study_reuse reuse = {.directory = open(folder, O_RDONLY | O_DIRECTORY | O_CLOEXEC),
                         .fingerprints = fingerprints,
                         .stats = stats,
                         .held = -1};
    if (!study_reuse_recall(&reuse, pipeline, stage))
        close(reuse.held);
    unlinkat(reuse.directory, name, 0);
    close(reuse.directory);
    ff_run_close(run);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static ff_engine *engine; /* models stay loaded */
    const char *toys = getenv("FLANKFILM_FUZZ_TOYS");
    static const uint8_t none[1];
    const uint8_t *parts[PARTS] = {none, none, none, none, none};
    size_t sizes[PARTS] = {0};
    ff_engine_options options = {
        .size = sizeof options, .plugin_paths = &toys, .plugin_path_count = 1};
    must(toys != NULL);
    if (!engine) {
        must(ff_engine_new(&options, &engine) == FF_OK && mkdtemp(folder));
        atexit(leave);
        put_file(".flankfilm-study", none, 0);
    }
    for (size_t i = 0, at = 0; i < PARTS && at < size; i++) {
        const uint8_t *end = size > at ? memchr(data + at, PART, size - at) : NULL;
        parts[i] = data + at;
        sizes[i] = i + 1 < PARTS && end ? (size_t)(end - parts[i]) : size - at;
        at += sizes[i] + 1;
    }
    put_journal(parts[0], sizes[0]);
    put_file("arrays.1.log", parts[1], sizes[1]);
    put_file("study.json", parts[2], sizes[2]);
    put_file("table.csv", parts[3], sizes[3]);
    read_records();
    read_view();
    read_stage(parts[4], sizes[4], engine);
    return 0;
}
