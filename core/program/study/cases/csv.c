/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "csv.h"

#include "../../memory/file.h"
#include "../../memory/memory.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { LARGEST_FILE = 1 << 28 };

static bool is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\r';
}

/* Reads the whole file. Returns NULL, or the reason why it cannot be read. */
static const char *read_file(int fd, ff_source *source)
{
    struct stat info;
    if (fstat(fd, &info) != 0)
        return strerror(errno);
    if (info.st_size > LARGEST_FILE)
        return "it has more than 256 MiB";
    free(source->text);
    source->length = (size_t)info.st_size;
    source->text = memory_alloc(source->length + 1);
    if (!file_read(fd, source->text, source->length, -1))
        return strerror(errno);
    return strlen(source->text) == source->length ? NULL
                                                  : "it contains a zero byte, so it is not text";
}

const char *study_csv_open(study_csv *table, const char *path)
{
    const char *slash = strrchr(path, '/');
    const char *why = NULL;
    int fd = file_open(AT_FDCWD, path, &why);
    *table =
        (study_csv){.source = {.name = memory_copy_text(path, strlen(path)),
                               .text = memory_copy_text("", 0),
                               .directory = slash ? memory_copy_text(path, (size_t)(slash - path) +
                                                                               (slash == path))
                                                  : memory_copy_text(".", 1)}};
    if (fd >= 0)
        why = read_file(fd, &table->source);
    table->at = table->source.text;
    if (!strncmp(table->at, "\xef\xbb\xbf", 3))
        table->at += 3;
    if (fd >= 0)
        close(fd);
    return why;
}

bool study_csv_next(study_csv *table)
{
    while (*table->at) {
        const char *line = table->at;
        size_t length = strcspn(line, "\n");
        table->at += length + (line[length] == '\n');
        table->line++;
        if (study_csv_is_silent(line, length))
            continue;
        study_csv_split(table, line, length);
        return true;
    }
    return false;
}

void study_csv_close(study_csv *table)
{
    free(table->source.name);
    free(table->source.text);
    free(table->source.directory);
    free(table->fields);
    free(table->parts);
    free(table->texts);
}

bool study_csv_is_silent(const char *line, size_t length)
{
    size_t i = 0;
    while (i < length && is_blank(line[i]))
        i++;
    return i == length || line[i] == '#';
}

void study_csv_split(study_csv *table, const char *line, size_t length)
{
    const size_t most = STUDY_CSV_FIELDS + 1;
    const char *end = line + length;
    if (!table->headed) {
        table->separator = ff_fields_separator(line, end);
        table->parts = memory_resize(table->parts, most * sizeof *table->parts);
        table->fields = memory_resize(table->fields, most * sizeof *table->fields);
        table->headed = true;
    }
    size_t count = ff_fields_split(line, end, table->separator, most, table->parts);
    table->count = count < most ? count : most;
    table->fault = NULL;
    if (table->room < length + most) {
        table->room = 2 * length + most;
        table->texts = memory_resize(table->texts, table->room);
    }
    char *text = table->texts;
    for (size_t i = 0; i < table->count && !table->fault; i++) {
        const ff_field *part = &table->parts[i];
        table->fields[i] = (study_csv_field){text, part->column, part->width, part->quoted};
        text += ff_field_copy(part, text) + 1;
        if (!part->open)
            continue;
        table->fault = "this field begins with a quote, but does not end with it";
        table->count = i + 1;
    }
}

const char *study_csv_unit(study_csv_field *head)
{
    char *open = strchr(head->text, '['), *close = open ? strrchr(open, ']') : NULL, *end = open;
    if (!open)
        return "";
    if (!close || close[1] || open == head->text)
        return NULL;
    while (end > head->text && is_blank(end[-1]))
        end--;
    *close = '\0';
    *end = '\0';
    return open + 1;
}

void study_csv_write(FILE *out, const char *text, size_t length, bool always)
{
    bool quoted = always || strcspn(text, ",\"\n\r") < length;
    if (quoted)
        fputc('"', out);
    for (size_t i = 0; i < length; i++) {
        if (text[i] == '"')
            fputc('"', out);
        fputc(text[i] == '\n' || text[i] == '\r' ? ' ' : text[i], out);
    }
    if (quoted)
        fputc('"', out);
}
