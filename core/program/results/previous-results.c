/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "previous-results.h"
#include "json.h"

#include "../accuracy/models.h"
#include "../memory/file.h"
#include "../memory/memory.h"
#include "../study/kinds/kinds.h"
#include "../study/store/hash.h"

#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { MOST_TOLD = 4 };

uint64_t results_input_key(const ff_pipeline *pipeline, const char *accuracy)
{
    uint64_t *fingerprints = memory_alloc((pipeline->count + 1) * sizeof *fingerprints);
    uint64_t key = study_fingerprint(pipeline, fingerprints);
    free(fingerprints);
    return *accuracy ? study_hash_text(key, accuracy) : key;
}

/* Whether the two paths lead to different files. If the recorded file cannot be found, for example
 * because it was renamed, it counts as the same file. */
static bool is_other_file(const char *recorded, const char *file)
{
    struct stat then, now;
    return recorded && stat(recorded, &then) == 0 && stat(file, &now) == 0 &&
           (then.st_dev != now.st_dev || then.st_ino != now.st_ino);
}

/* Differences; only the first ones are printed. */
typedef struct differences {
    char *text;
    size_t count;
} differences;

static void add_difference(differences *all, const char *name, const char *param,
                           const char *before, const char *now)
{
    all->count++;
    if (all->count > MOST_TOLD)
        return;
    memory_add_text(&all->text, "%s%s%s%s: %s -> %s", *all->text ? ", " : "", name,
                    *param ? "." : "", param, before, now);
}

static const char *text_of(const json_t *object, const char *key, const char *otherwise)
{
    const char *text = json_string_value(json_object_get(object, key));
    return text ? text : otherwise;
}

/* Whether the program chose the parameter to reach the accuracy, because the file does not give it.
 */
static bool was_chosen(const json_t *chosen, const char *stage, const char *param)
{
    char *path = memory_print_text("%s.%s", stage, param);
    bool found = json_object_get(chosen, path) != NULL;
    free(path);
    return found;
}

static void compare_params(differences *all, const char *stage, const json_t *before,
                           const json_t *now, const json_t *chosen)
{
    static const char none[] = "not given";
    const char *name;
    json_t *param;
    json_object_foreach((json_t *)(size_t)now, name, param)
    {
        const char *was = text_of(json_object_get(before, name), "text", none);
        if (strcmp(was, text_of(param, "text", none)) != 0 && !was_chosen(chosen, stage, name))
            add_difference(all, stage, name, was, text_of(param, "text", none));
    }
    json_object_foreach((json_t *)(size_t)before, name, param) if (!json_object_get(now, name))
        add_difference(all, stage, name, text_of(param, "text", none), none);
}

static const json_t *find_stage(const json_t *stages, const char *name)
{
    size_t i;
    const json_t *stage;
    json_array_foreach(stages, i,
                       stage) if (!strcmp(text_of(stage, "stage", ""), name)) return stage;
    return NULL;
}

static void compare_stage(differences *all, const ff_pipeline *pipeline, const ff_stage *stage,
                          const json_t *before, const json_t *chosen)
{
    const char *model = before ? text_of(before, "model", "") : "absent";
    json_t *origin = results_json_origin(pipeline, stage);
    if (!accuracy_open_use(stage) && strcmp(model, stage->use) != 0)
        add_difference(all, stage->name, "use", model, stage->use);
    else if (!accuracy_open_use(stage))
        compare_params(all, stage->name, json_object_get(before, "parameters"),
                       json_object_get(origin, "parameters"), chosen);
    const char *build = text_of(origin, "build", "");
    if (!strcmp(model, stage->use) && strcmp(text_of(before, "build", build), build) != 0)
        add_difference(all, stage->name, "", "another build of its plugin", "the present one");
    json_decref(origin);
}

/* Returns how the inputs of the stages differ from those of the earlier run, to be freed. */
static char *compare(const json_t *root, const results_input *input)
{
    differences all = {.text = memory_print_text("%s", "")};
    const json_t *stages = json_object_get(root, "stages");
    const json_t *accuracy = json_object_get(root, "accuracy");
    const char *asked = text_of(accuracy, "asked", "");
    if (strcmp(asked, input->accuracy) != 0)
        add_difference(&all, "accuracy", "", *asked ? asked : "none",
                       *input->accuracy ? input->accuracy : "none");
    for (size_t i = 0; i < input->pipeline->count; i++) {
        const ff_stage *stage = &input->pipeline->stages[i];
        if (stage->needed && stage->loaded)
            compare_stage(&all, input->pipeline, stage, find_stage(stages, stage->name),
                          json_object_get(accuracy, "settings"));
    }
    if (all.count == 0) {
        free(all.text);
        return memory_print_text("other outputs, or other contents of a file that a stage reads");
    }
    if (all.count <= MOST_TOLD)
        return all.text;
    char *text = memory_print_text("%s and %zu more", all.text, all.count - MOST_TOLD);
    free(all.text);
    return text;
}

static bool check(const char *directory, const char *name, const results_input *input, bool *same,
                  char **replaced, ff_report *report)
{
    char key[20], *path = memory_print_text("%s/%s", directory, name);
    json_error_t error;
    json_t *root = study_read_json(AT_FDCWD, path, &error);
    free(path);
    *replaced = NULL;
    if (!json_is_object(root)) {
        json_decref(root);
        return true;
    }
    snprintf(key, sizeof key, "%016llx", (unsigned long long)input->key);
    const char *recorded =
        json_string_value(json_object_get(json_object_get(root, "facts"), "file"));
    *same = !strcmp(text_of(root, "key", ""), key);
    bool other = !*same && is_other_file(recorded, input->file);
    if (other && !input->replace)
        ff_error(report, FF_FAULT_INPUT, FF_NOWHERE,
                 "name another directory with -o, or give --replace",
                 "\"%s\" holds the results of another file, %s", directory, recorded);
    else
        *replaced = *same ? memory_print_text("%s", "") : compare(root, input);
    if (other && input->replace) {
        char *text = memory_print_text("the results belong to %s", recorded);
        free(*replaced);
        *replaced = text;
    }
    json_decref(root);
    return !other || input->replace;
}

/* Whether result.json has the same inputs. The first members of result.json contain the hash of its
 * inputs. */
static bool begins_alike(const char *directory, const results_input *input)
{
    char words[64], found[64] = "", *path = memory_print_text("%s/result.json", directory);
    int file = file_open(AT_FDCWD, path, NULL), length;
    free(path);
    length = snprintf(words, sizeof words, "{\"format\":%d,\"key\":\"%016llx\"", RESULTS_FORMAT,
                      (unsigned long long)input->key);
    bool alike = file >= 0 && read(file, found, (size_t)length) == length && !strcmp(words, found);
    if (file >= 0)
        close(file);
    return alike;
}

bool results_earlier_check(const char *directory, const results_input *input, char **replaced,
                           ff_report *report)
{
    bool same;
    if (begins_alike(directory, input)) {
        *replaced = memory_print_text("%s", "");
        return true;
    }
    return check(directory, "result.json", input, &same, replaced, report);
}

bool results_earlier_check_study(const char *directory, const results_input *input, char **replaced,
                                 ff_report *report)
{
    bool same = false;
    bool good = check(directory, "study.json", input, &same, replaced, report);
    if (same) {
        free(*replaced);
        *replaced = NULL;
    }
    return good;
}
