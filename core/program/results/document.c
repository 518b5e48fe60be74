/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * A film's fields are millions of numbers: as nodes of JSON they would take ten times their size.
 * So the lists under "data" are cut out before the rest is parsed, and read from the text later.
 */
#include "document.h"

#include "../memory/memory.h"

#include <errno.h>
#include <fcntl.h>
#include <locale.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static char *read_all(int fd, size_t *length)
{
    struct stat info;
    if (fstat(fd, &info) != 0)
        return NULL;
    char *text = memory_alloc((size_t)info.st_size + 1);
    ssize_t got;
    *length = 0;
    while (*length < (size_t)info.st_size &&
           (got = read(fd, text + *length, (size_t)info.st_size - *length)) > 0)
        *length += (size_t)got;
    return text;
}

/* Returns the end of the string whose opening quote `at` points to. */
static const char *pass_string(const char *at, const char *end)
{
    for (at++; at < end && *at != '"'; at++)
        at += *at == '\\';
    return at < end ? at + 1 : end;
}

/* Returns the text with each list under "data" replaced by its offset in the text. */
static char *cut_lists(const char *text, size_t length, size_t *left)
{
    static const char key[] = "\"data\":[";
    const char *end = text + length, *from = text;
    char *skeleton = NULL;
    FILE *out = open_memstream(&skeleton, left);
    if (!out)
        abort();
    for (const char *at = text; at < end;) {
        if (*at != '"') {
            const char *quote = memchr(at, '"', (size_t)(end - at));
            at = quote ? quote : end;
            continue;
        }
        const char *after = pass_string(at, end);
        if ((size_t)(end - at) > sizeof key && !memcmp(at, key, sizeof key - 1)) {
            const char *list = after + 1, *bracket = memchr(list, ']', (size_t)(end - list));
            fwrite(from, 1, (size_t)(list - from), out);
            fprintf(out, "%zu", (size_t)(list - text));
            after = from = bracket ? bracket + 1 : end;
        }
        at = after;
    }
    fwrite(from, 1, (size_t)(end - from), out);
    fclose(out);
    return skeleton;
}

bool results_document_open(results_document *document, int directory, const char *name)
{
    *document = (results_document){.text = NULL};
    int fd = openat(directory, name, O_RDONLY | O_CLOEXEC);
    if (fd < 0)
        return false;
    document->text = read_all(fd, &document->length);
    close(fd);
    size_t left = 0;
    char *skeleton = document->text ? cut_lists(document->text, document->length, &left) : NULL;
    document->root = skeleton ? json_loadb(skeleton, left, 0, NULL) : NULL;
    free(skeleton);
    if (json_is_object(document->root))
        return true;
    results_document_close(document);
    errno = 0;
    return false;
}

void results_document_close(results_document *document)
{
    json_decref(document->root);
    free(document->text);
    *document = (results_document){.text = NULL};
}

/* Reads numbers separated by commas, up to the closing bracket. */
static bool read_list(const char *at, size_t count, locale_t plain, double *out)
{
    for (size_t i = 0; i < count; i++) {
        char *end = NULL;
        if (i > 0 && *at++ != ',')
            return false;
        bool none = !strncmp(at, "null", 4);
        out[i] = none ? (double)NAN : strtod_l(at, &end, plain);
        if (!none && (!isfinite(out[i]) || end == at))
            return false;
        at = none ? at + 4 : end;
    }
    return *at == ']';
}

bool results_document_read_numbers(const results_document *document, const json_t *data,
                                   size_t count, double *out)
{
    size_t offset = (size_t)json_integer_value(data);
    if (!json_is_integer(data) || offset >= document->length || document->text[offset] != '[')
        return false;
    locale_t plain = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    bool good = plain && read_list(document->text + offset + 1, count, plain, out);
    if (plain)
        freelocale(plain);
    return good;
}
