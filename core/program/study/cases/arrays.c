/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Each worker appends the arrays of its cases to a log of its own. In the journal, the record of a
 * case names this log and its end after the case. For each array it gives [unit, dims, shape,
 * offset of its record, axis].
 */
#include "case.h"

#include "../../memory/file.h"
#include "../store/journal.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const char log_head[] = "\"log\":[\""; /* as in a line of the journal */

/* A series of one number is recorded as a scalar. */
bool study_is_array(const ff_result *result)
{
    return result->rank > 1 || (result->rank == 1 && result->count != 1);
}

/* Returns the largest end of this log that a journal states. The lines are searched, not parsed: an
   invalid line can only raise the end, so that less is cut off. */
static off_t find_end(int directory, const study_run *run, const char *name)
{
    char journal[STUDY_NAME_SIZE], *line = NULL;
    size_t size = 0, length = strlen(name);
    off_t end = 0;
    study_journal_name(run->shard, run->shards, journal);
    FILE *stream = file_stream(directory, journal);
    while (stream && getline(&line, &size, stream) > 0) {
        const char *at = strstr(line, log_head);
        at = at ? at + sizeof log_head - 1 : "";
        if (strncmp(at, name, length) != 0 || strncmp(at + length, "\",", 2) != 0)
            continue;
        off_t named = strtoll(at + length + 2, NULL, 10);
        end = named > end ? named : end;
    }
    free(line);
    if (stream)
        fclose(stream);
    return end;
}

/* Opens a log to which no other process writes. The process that holds the journal's lock numbers
   the logs of its workers. Under an executor, processes do not know about each other, and workers
   of an earlier run may still be running elsewhere. Each process then creates a new log. */
static bool open_log_in(int directory, study_arrays *arrays, char why[ARRAYS_WHY])
{
    const study_run *run = arrays->run;
    study_shared *shared = arrays->shared;
    char *name = shared->name;
    if (!run->executor) {
        int length = snprintf(name, STUDY_NAME_SIZE, "arrays.%zu.log", arrays->slot);
        if (run->shards > 1)
            length = snprintf(name, STUDY_NAME_SIZE, "arrays.%zu-of-%zu.%zu.log", run->shard,
                              run->shards, arrays->slot);
        (void)length;
        off_t end = shared->end ? shared->end : find_end(directory, run, name);
        return arrays_log_open(&arrays->log, directory, name, end, false, why);
    }
    bool fresh = shared->log == 0, good;
    do {
        shared->log += fresh;
        snprintf(name, STUDY_NAME_SIZE, "arrays.farm-%u.log", shared->log);
        good = arrays_log_open(&arrays->log, directory, name, shared->end, fresh, why);
    } while (!good && fresh && errno == EEXIST);
    return good;
}

static bool open_log(study_arrays *arrays, char why[ARRAYS_WHY])
{
    int directory = open(arrays->run->directory, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    snprintf(why, ARRAYS_WHY, "%s", strerror(errno));
    if (directory < 0)
        return false;
    bool good = open_log_in(directory, arrays, why);
    close(directory);
    return good;
}

static json_t *describe(const study_run *run, const ff_pipeline *pipeline, const ff_stage *stage,
                        size_t output, off_t offset)
{
    const ff_result *result = &stage->results[output];
    json_t *dims = json_array(), *shape = json_array();
    for (uint32_t i = 0; i < result->rank; i++) {
        json_array_append_new(dims, json_string(result->dims[i]));
        json_array_append_new(shape, json_integer((json_int_t)result->shape[i]));
    }
    json_t *entry = json_pack("[s, o, o, I]", result->row->unit, dims, shape, (json_int_t)offset);
    json_t *against = run->against ? run->against(pipeline, stage, output) : NULL, *name;
    size_t i;
    bool any = false;
    json_array_foreach(against, i, name) any = any || *json_string_value(name);
    if (any)
        json_array_append(entry, against);
    json_decref(against);
    return entry;
}

/* Appends an array and describes it. Returns false with the reason in `why`. */
static bool keep_one(study_arrays *arrays, const study_case *c, const ff_stage *stage,
                     size_t output, json_t *all, bool *open, char why[ARRAYS_WHY])
{
    const ff_result *result = &stage->results[output];
    char name[ARRAYS_LONGEST_OUTPUT + 1];
    off_t offset;
    snprintf(name, sizeof name, "%s.%s", stage->name, result->row->name);
    arrays_label label = {.key = c->key, .output = name, .rank = result->rank};
    memcpy(label.shape, result->shape, sizeof label.shape);
    if (!*open && !open_log(arrays, why))
        return false;
    *open = true;
    if (!arrays_log_append(&arrays->log, &label, result->data, &offset)) {
        snprintf(why, ARRAYS_WHY, "%s", strerror(errno));
        return false;
    }
    json_object_set_new(all, name, describe(arrays->run, c->pipeline, stage, output, offset));
    return true;
}

static bool keep_all(study_arrays *arrays, const study_case *c, json_t *all, bool *open,
                     char why[ARRAYS_WHY])
{
    for (size_t i = 0; i < c->pipeline->count; i++) {
        const ff_stage *stage = &c->pipeline->stages[i];
        for (size_t k = 0; stage->ran && k < stage->loaded->model->output_count; k++) {
            const ff_result *result = &stage->results[k];
            if (result->requested && result->data && study_is_array(result) &&
                !keep_one(arrays, c, stage, k, all, open, why))
                return false;
        }
    }
    return true;
}

bool study_arrays_keep(study_arrays *arrays, const study_case *c, json_t *record)
{
    char why[ARRAYS_WHY] = "";
    json_t *all = json_object();
    bool open = false, good = keep_all(arrays, c, all, &open, why);
    if (good && json_object_size(all)) {
        arrays->shared->end = arrays->log.end;
        json_object_set(record, "arrays", all);
        json_object_set_new(record, "log",
                            json_pack("[s, I]", arrays->shared->name, (json_int_t)arrays->log.end));
    }
    if (open)
        arrays_log_close(&arrays->log);
    json_decref(all);
    return good ||
           ff_error(c->report, FF_FAULT_RUN, FF_NOWHERE, NULL, "%s/%s could not be written: %s",
                    arrays->run->directory, arrays->shared->name, why);
}
