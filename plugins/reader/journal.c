/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The journals of a study: a line of JSON for each finished case, whose last member is the FNV-1a
   hash of the line before it. */
#include "results.h"

#include <dirent.h>
#include <fcntl.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

const char results_study_marker[] = ".flankfilm-study";

static uint64_t hash(const char *text, size_t length)
{
    uint64_t sum = UINT64_C(0xcbf29ce484222325);
    for (size_t i = 0; i < length; i++)
        sum = (sum ^ (unsigned char)text[i]) * UINT64_C(0x100000001b3);
    return sum;
}

/* NULL for a line that is torn or was changed. */
static json_t *parse(const char *line, size_t length)
{
    char sum[40];
    int tail = snprintf(sum, sizeof sum, ",\"sum\":\"%016llx\"}\n", 0ULL);
    if (length <= (size_t)tail || line[length - 1] != '\n')
        return NULL;
    size_t body = length - (size_t)tail;
    snprintf(sum, sizeof sum, ",\"sum\":\"%016llx\"}\n", (unsigned long long)hash(line, body));
    return strcmp(line + body, sum) ? NULL : json_loadb(line, length - 1, 0, NULL);
}

static bool is_ok(const json_t *record)
{
    const char *status = json_string_value(json_object_get(record, "status"));
    return status && !strcmp(status, "ok");
}

static void read_one(int directory, const char *name, json_t *records)
{
    int fd = openat(directory, name, O_RDONLY | O_CLOEXEC);
    FILE *stream = fd < 0 ? NULL : fdopen(fd, "r");
    char *line = NULL;
    size_t size = 0;
    ssize_t length;
    while (stream && (length = getline(&line, &size, stream)) > 0) {
        json_t *record = parse(line, (size_t)length);
        const char *key = json_string_value(json_object_get(record, "key"));
        if (key && (is_ok(record) || !is_ok(json_object_get(records, key))))
            json_object_set(records, key, record);
        json_decref(record);
    }
    free(line);
    if (stream)
        fclose(stream);
}

static bool is_journal(const char *name)
{
    size_t length = strlen(name);
    return !strncmp(name, "journal", 7) && length > 6 && !strcmp(name + length - 6, ".jsonl");
}

json_t *results_journal_read(int directory)
{
    json_t *records = json_object();
    int fd = openat(directory, ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    DIR *list = fd < 0 ? NULL : fdopendir(fd);
    const struct dirent *item;
    while (list && (item = readdir(list)))
        if (is_journal(item->d_name))
            read_one(directory, item->d_name, records);
    if (list)
        closedir(list);
    return records;
}
