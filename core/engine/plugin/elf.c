/* SPDX-License-Identifier: MIT */
/* Checks a shared object before dlopen. dlopen maps the file, and reading beyond the end of a
   truncated file would end the program with a bus error. The size of the file is therefore compared
   with its header. The file is also hashed, to distinguish builds of a plugin. */
#include "private.h"

#include <errno.h>
#include <fcntl.h>
#include <link.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* Reads until `size` bytes are read or the file ends. The system may interrupt a read or return
   fewer bytes than requested. */
static size_t read_at(int file, void *to, size_t size, off_t at)
{
    size_t done = 0;
    ssize_t got = 1;
    while (done < size && (got > 0 || errno == EINTR)) {
        errno = 0;
        got = pread(file, (char *)to + done, size - done, at + (off_t)done);
        done += got > 0 ? (size_t)got : 0;
    }
    return done;
}

/* Returns NULL, or a description of the fault. The section table is at the end of the file, so any
   truncation damages it first. */
static const char *find_fault(int file, struct stat *status)
{
    static const char cut[] = "is not a complete shared object: it was cut short";
    const unsigned char class = sizeof(void *) == 8 ? ELFCLASS64 : ELFCLASS32;
    ElfW(Ehdr) head = {0};
    if (fstat(file, status) != 0 || !S_ISREG(status->st_mode))
        return "is not a file";
    uint64_t size = (uint64_t)status->st_size;
    if (size == 0)
        return "is empty";
    size_t got = read_at(file, &head, sizeof head, 0);
    if (memcmp(head.e_ident, ELFMAG, SELFMAG) != 0)
        return "is not a shared object";
    if (got != sizeof head)
        return cut;
    if (head.e_ident[EI_CLASS] != class)
        return "is a shared object for another kind of processor";
    uint64_t sections = (uint64_t)head.e_shnum * head.e_shentsize;
    if (head.e_shoff > size || sections > size - head.e_shoff)
        return cut;
    return head.e_type == ET_DYN ? NULL : "is not a shared object";
}

/* FNV-1a over words of eight bytes; the high bits of each word are folded into the low ones. */
static uint64_t hash_file(int file)
{
    uint64_t block[2048], hash = UINT64_C(0xcbf29ce484222325);
    off_t at = 0;
    size_t got;
    while ((got = read_at(file, block, sizeof block, at)) > 0) {
        size_t words = (got + 7) / 8;
        memset((char *)block + got, 0, 8 * words - got);
        for (size_t i = 0; i < words; i++) {
            hash = (hash ^ block[i]) * UINT64_C(0x9e3779b97f4a7c15);
            hash ^= hash >> 32;
        }
        at += (off_t)got;
    }
    return hash ^ (uint64_t)at;
}

bool fe_elf_check(const char *path, fe_object_file *checked, char *why, size_t why_size)
{
    /* O_NONBLOCK: opening a pipe of that name must not block */
    int file = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (file < 0) {
        snprintf(why, why_size, "cannot be opened: %s", fe_errno_text());
        return false;
    }
    const char *fault = find_fault(file, &checked->status);
    checked->hash = fault ? 0 : hash_file(file);
    close(file);
    if (fault)
        snprintf(why, why_size, "%s", fault);
    return !fault;
}

static bool is_same_file(const struct stat *now, const struct stat *then)
{
    return now->st_dev == then->st_dev && now->st_ino == then->st_ino;
}

static bool is_as_written(const struct stat *now, const struct stat *then)
{
    return now->st_size == then->st_size && now->st_mtim.tv_sec == then->st_mtim.tv_sec &&
           now->st_mtim.tv_nsec == then->st_mtim.tv_nsec;
}

bool fe_elf_is_same(int folder, const char *path, const fe_object_file *checked)
{
    const struct stat *then = &checked->status;
    struct stat now;
    return fstatat(folder, path, &now, 0) == 0 && is_same_file(&now, then) &&
           is_as_written(&now, then);
}

bool fe_is_written_over(const ff_loaded *loaded)
{
    if (!loaded->file) /* it is still being loaded */
        return false;
    const struct stat *then = &loaded->file->status;
    struct stat now;
    if (stat(loaded->path, &now) != 0 || !is_same_file(&now, then) || is_as_written(&now, then))
        return false;
    int file = open(loaded->path, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    bool same = file >= 0 && hash_file(file) == loaded->build;
    if (file >= 0)
        close(file);
    return !same;
}
