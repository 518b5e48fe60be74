/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Indexes the journals of a study, and reads records from them. */
#include "records.h"

#include "hash.h"
#include "journal.h"
#include "record-schema.h"

#include "../../memory/memory.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* The position of a record in a journal. */
typedef struct entry {
    uint64_t key;
    uint64_t offset;
    uint32_t form; /* index of the form, from 1; 0: the line contains the whole record */
    uint16_t file;
    uint8_t state; /* STUDY_UNKNOWN: the slot is empty */
} entry;

typedef struct journal_file {
    int fd; /* descriptor; -1: opened for each record */
    char name[STUDY_NAME_SIZE];
    bool formless; /* whether a line came before its form, or the line with the form is lost */
} journal_file;

typedef struct form {
    char name[STUDY_FORM_NAME];
    json_t *content;
} form;

struct study_records {
    entry *slots; /* number of slots: a power of two; at least half of them are free */
    size_t room, count;
    struct journal_file *files;
    size_t file_count;
    char *directory;
    form *forms;
    size_t form_count;
    json_t *kept; /* {key: record} */
    json_t *described;
    json_t *logs; /* {log: its length}; NULL: not checked */
};

enum { MOST_FILES = UINT16_MAX };

/* Returns the number that identifies a key. A case that ended before it had a key has another kind
   of key, which is hashed. */
static uint64_t number_of(const char *key)
{
    char *end;
    uint64_t number = strtoull(key, &end, 16);
    return end == key + 16 && !*end ? number : study_hash_text(STUDY_HASH_START, key);
}

/* Returns the slot of a key, or the free one for it. */
static entry *slot_of(const study_records *r, uint64_t key)
{
    size_t at = (size_t)key & (r->room - 1);
    while (r->slots[at].state != STUDY_UNKNOWN && r->slots[at].key != key)
        at = (at + 1) & (r->room - 1);
    return &r->slots[at];
}

static void grow(study_records *r)
{
    entry *old = r->slots;
    size_t room = r->room;
    r->room = room ? 2 * room : 1024;
    r->slots = memory_alloc(r->room * sizeof *r->slots);
    for (size_t i = 0; i < room; i++)
        if (old[i].state != STUDY_UNKNOWN)
            *slot_of(r, old[i].key) = old[i];
    free(old);
}

static void add(study_records *r, const entry *found)
{
    if (2 * (r->count + 1) > r->room)
        grow(r);
    entry *slot = slot_of(r, found->key);
    r->count += slot->state == STUDY_UNKNOWN;
    if (found->state >= slot->state)
        *slot = *found;
}

/* Returns the index of the form, from 1, or 0 if it is not known. */
static uint32_t find_form(const study_records *r, const char *name)
{
    size_t i = r->form_count;
    while (i > 0 && strcmp(r->forms[i - 1].name, name) != 0)
        i--;
    return (uint32_t)i;
}

static uint32_t add_form(study_records *r, const char *name, json_t *content)
{
    uint32_t known = find_form(r, name);
    if (known || !content)
        return known;
    r->forms = memory_resize(r->forms, (r->form_count + 1) * sizeof *r->forms);
    form *made = &r->forms[r->form_count++];
    snprintf(made->name, sizeof made->name, "%s", name);
    made->content = json_incref(content);
    return (uint32_t)r->form_count;
}

/* Makes a record of a parsed line, and releases the line. */
static json_t *restore(study_records *r, json_t *line)
{
    const char *name = json_string_value(json_object_get(line, "form"));
    if (!name)
        return line;
    uint32_t number = add_form(r, name, json_object_get(line, "is"));
    json_t *record = number ? study_form_fill(r->forms[number - 1].content, line) : NULL;
    json_decref(line);
    return record;
}

json_t *study_records_take(study_records *r, const char *line, size_t length)
{
    return restore(r, study_line_parse(line, length));
}

/* Copies the text between `head` and the next quote. Returns what follows it, or NULL. */
static const char *word_after(const char *at, const char *head, char *word, size_t size)
{
    size_t skipped = strlen(head);
    if (!at || strncmp(at, head, skipped) != 0)
        return NULL;
    at += skipped;
    size_t length = strcspn(at, "\"\\");
    if (at[length] != '"' || length >= size)
        return NULL;
    memcpy(word, at, length);
    word[length] = '\0';
    return at + length + 1;
}

/* Stores the parameters that a record describes. */
static void note_described(study_records *r, const json_t *record)
{
    json_t *values;
    const char *input = json_string_value(json_object_get(record, "input")), *stage;
    char name[400];
    input = input ? input : "";
    if (!json_object_get(r->described, input))
        json_object_set_new(r->described, input, json_object());
    json_object_foreach(json_object_get(record, "parameters"), stage, values)
    {
        const char *use = json_string_value(json_object_get(values, "use"));
        snprintf(name, sizeof name, "%.160s %.160s", stage, use ? use : "");
        if (use)
            json_object_set(json_object_get(r->described, input), name, values);
    }
}

/* Checks that the log named in the line is at least as long as the line states. Returns what
   follows the name, or NULL if the log is shorter or the line is damaged. */
static const char *pass_log(study_records *r, int directory, const char *at)
{
    static const char head[] = ",\"log\":[\"";
    char name[STUDY_NAME_SIZE];
    struct stat info;
    if (!at || strncmp(at, head, sizeof head - 1) != 0)
        return at;
    at = word_after(at, head, name, sizeof name);
    if (!at || *at != ',' || strchr(name, '/'))
        return NULL;
    char *end;
    long long needed = strtoll(at + 1, &end, 10);
    const json_t *size = json_object_get(r->logs, name);
    if (r->logs && !size) {
        bool there = fstatat(directory, name, &info, 0) == 0;
        json_object_set_new(r->logs, name, json_integer(there ? (json_int_t)info.st_size : 0));
        size = json_object_get(r->logs, name);
    }
    return *end != ']' || (size && json_integer_value(size) < needed) ? NULL : end + 1;
}

/* Reads the key and the state of a complete line. Returns what follows them, or NULL. */
static const char *read_head(const char *line, uint64_t *key, uint8_t *state)
{
    char text[64], status[64];
    const char *at = line + strcspn(line, ",");
    at = word_after(at, ",\"key\":\"", text, sizeof text);
    at = word_after(at, ",\"status\":\"", status, sizeof status);
    if (at)
        *key = number_of(text);
    *state = at && !strcmp(status, "ok") ? STUDY_OK : STUDY_NOT_OK;
    return at;
}

enum study_state study_line_state(const char *line)
{
    uint64_t key;
    uint8_t state;
    read_head(line, &key, &state);
    return state;
}

/* Adds the position of a complete line to the index. Returns false if its form is not known yet. */
static bool add_line(study_records *r, int directory, const char *line, size_t length,
                     uint16_t file, uint64_t offset)
{
    char name[STUDY_FORM_NAME];
    entry found = {.offset = offset, .file = file};
    const char *at = pass_log(r, directory, read_head(line, &found.key, &found.state));
    if (!at)
        return true;
    at = word_after(at, ",\"form\":\"", name, sizeof name);
    if ((at && !strncmp(at, ",\"is\":", 6)) || strstr(line, ",\"parameters\":{\"")) {
        json_t *record = study_records_take(r, line, length);
        note_described(r, record);
        json_decref(record);
    }
    found.form = at ? find_form(r, name) : 0;
    bool known = !at || found.form;
    if (known)
        add(r, &found);
    return known;
}

/* If a block of the file is lost, several lines may be joined to one. Returns the start of the last
   of them, or the length if there is none. */
static size_t find_last(const char *line, size_t length)
{
    static const char head[] = "{\"case\":";
    size_t at = length;
    for (size_t i = 1; i + sizeof head <= length; i++)
        if (!memcmp(line + i, head, sizeof head - 1))
            at = i;
    return at;
}

/* Opens a journal. A link, a pipe or a device with its name counts as a journal without records. */
static int open_journal(int directory, const char *name)
{
    struct stat info;
    int fd = openat(directory, name, O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOFOLLOW);
    if (fd < 0 || (fstat(fd, &info) == 0 && S_ISREG(info.st_mode)))
        return fd;
    close(fd);
    return -1;
}

/* Reads the lines of a journal, except those of an unknown form. */
static void read_lines(study_records *r, int directory, uint16_t number)
{
    journal_file *file = &r->files[number];
    int copy = fcntl(file->fd, F_DUPFD_CLOEXEC, 0);
    FILE *stream = copy < 0 ? NULL : fdopen(copy, "r");
    char *line = NULL;
    size_t size = 0;
    ssize_t length;
    uint64_t offset = 0;
    file->formless = false;
    if (stream)
        rewind(stream); /* the stream shares its position with the descriptor */
    for (; stream && (length = getline(&line, &size, stream)) > 0; offset += (uint64_t)length) {
        size_t whole = (size_t)length;
        bool good = study_line_is_whole(line, whole);
        size_t at = good ? 0 : find_last(line, whole);
        good = good || study_line_is_whole(line + at, whole - at);
        if (good && !add_line(r, directory, line + at, whole - at, number, offset + at))
            file->formless = true;
    }
    free(line);
    if (stream)
        fclose(stream);
}

static void read_journal(study_records *r, int directory, const char *name)
{
    int fd = r->file_count == MOST_FILES ? -1 : open_journal(directory, name);
    if (fd < 0)
        return;
    r->files = memory_resize(r->files, (r->file_count + 1) * sizeof *r->files);
    journal_file *file = &r->files[r->file_count++];
    file->fd = fd;
    snprintf(file->name, sizeof file->name, "%s", name);
    read_lines(r, directory, (uint16_t)(r->file_count - 1));
}

static bool is_journal(const char *name)
{
    size_t length = strlen(name);
    return !strncmp(name, "journal", 7) && length > 6 && length < STUDY_NAME_SIZE &&
           !strcmp(name + length - 6, ".jsonl");
}

study_records *study_records_open(const char *directory, bool whole)
{
    study_records *r = memory_alloc(sizeof *r);
    DIR *list = opendir(directory);
    const struct dirent *item;
    grow(r);
    r->directory = memory_copy_text(directory, strlen(directory));
    r->kept = json_object();
    r->described = json_object();
    r->logs = whole ? json_object() : NULL;
    while (list && (item = readdir(list)))
        if (is_journal(item->d_name))
            read_journal(r, dirfd(list), item->d_name);
    for (size_t i = 0; i < r->file_count; i++) /* read once more with the forms found further on */
        if (r->files[i].formless)
            read_lines(r, dirfd(list), (uint16_t)i);
    if (list)
        closedir(list);
    return r;
}

void study_records_close(study_records *r)
{
    if (!r)
        return;
    study_records_close_files(r);
    for (size_t i = 0; i < r->form_count; i++)
        json_decref(r->forms[i].content);
    json_decref(r->kept);
    json_decref(r->described);
    json_decref(r->logs);
    free(r->directory);
    free(r->files);
    free(r->forms);
    free(r->slots);
    free(r);
}

void study_records_close_files(study_records *r)
{
    for (size_t i = 0; i < r->file_count; i++)
        if (r->files[i].fd >= 0)
            close(r->files[i].fd);
    for (size_t i = 0; i < r->file_count; i++)
        r->files[i].fd = -1;
}

size_t study_records_count(const study_records *r)
{
    return r->count;
}

enum study_state study_records_state(const study_records *r, const char *key)
{
    const json_t *kept = json_object_get(r->kept, key);
    if (kept)
        return study_record_is_ok(kept) ? STUDY_OK : STUDY_NOT_OK;
    return slot_of(r, number_of(key))->state;
}

/* Opens the journal of an entry if it was closed. The caller closes it again. */
static int reopen(const study_records *r, const entry *e)
{
    int directory = open(r->directory, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    int fd = directory < 0 ? -1 : open_journal(directory, r->files[e->file].name);
    if (directory >= 0)
        close(directory);
    return fd;
}

/* Reads the line of an entry again. */
static json_t *read_entry(study_records *r, const entry *e)
{
    bool held = r->files[e->file].fd >= 0;
    int fd = held ? r->files[e->file].fd : reopen(r, e);
    size_t room = 4096, length = 0;
    char *line = memory_alloc(room);
    ssize_t got;
    const char *end = NULL;
    do {
        got = pread(fd, line + length, room - length, (off_t)(e->offset + length));
        end = got > 0 ? memchr(line + length, '\n', (size_t)got) : NULL;
        length += got > 0 ? (size_t)got : 0;
        if (!end && length == room)
            line = memory_resize(line, room *= 2);
    } while (!end && (got > 0 || (got < 0 && errno == EINTR)));
    json_t *record = end ? restore(r, study_line_parse(line, (size_t)(end - line) + 1)) : NULL;
    free(line);
    if (!held && fd >= 0)
        close(fd);
    return record;
}

json_t *study_records_get(study_records *r, const char *key)
{
    json_t *kept = json_object_get(r->kept, key);
    const entry *e = slot_of(r, number_of(key));
    return kept ? json_incref(kept) : e->state != STUDY_UNKNOWN ? read_entry(r, e) : NULL;
}

const json_t *study_records_described(const study_records *r)
{
    return r->described;
}

json_t *study_records_next(study_records *r, size_t *at, uint64_t *rank)
{
    json_t *record = NULL;
    while (*at < r->room && !record) {
        const entry *e = &r->slots[(*at)++];
        if (e->state != STUDY_UNKNOWN)
            record = read_entry(r, e);
        if (rank)
            *rank = (uint64_t)e->file << 48 | e->offset;
    }
    return record;
}

void study_records_keep(study_records *r, const char *key, json_t *record)
{
    json_object_set(r->kept, key, record);
}

study_judgement study_records_judge(study_records *r, const char *key)
{
    const entry *e = slot_of(r, number_of(key));
    study_judgement judgement;
    if (e->form && !json_object_get(r->kept, key) &&
        study_judgement_read(&judgement, r->forms[e->form - 1].content))
        return judgement;
    json_t *record = study_records_get(r, key);
    study_judgement_read(&judgement, record);
    json_decref(record);
    return judgement;
}

const char *study_records_form(const study_records *r, const char *key)
{
    const entry *e = slot_of(r, number_of(key));
    return e->form ? r->forms[e->form - 1].name : "";
}
