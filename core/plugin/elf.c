/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * dlopen maps a file and reads behind its end when it was cut short, which ends the program with a
 * bus error. So the extents that the file states are compared with its size before.
 */
#include "private.h"

#include <errno.h>
#include <fcntl.h>
#include <link.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* More than any plugin takes; a larger number is damage. */
static const uint64_t most_bytes = UINT64_C(1) << 36;

static bool read_at(int file, void *into, size_t size, off_t offset)
{
    return pread(file, into, size, offset) == (ssize_t)size;
}

/* NULL, or what is wrong. */
static const char *header_fault(int file, ElfW(Ehdr) * head, uint64_t size)
{
    static const char whole[] = "is no shared object";
    static const char cut[] = "is no complete shared object: it was cut short";
    const unsigned char class = sizeof(void *) == 8 ? ELFCLASS64 : ELFCLASS32;
    if (size == 0)
        return "is empty";
    if (size < SELFMAG || !read_at(file, head, size < sizeof *head ? SELFMAG : sizeof *head, 0) ||
        memcmp(head->e_ident, ELFMAG, SELFMAG) != 0)
        return whole;
    if (size < sizeof *head)
        return cut;
    if (head->e_ident[EI_CLASS] != class)
        return "is a shared object for another kind of processor";
    if (head->e_type != ET_DYN || head->e_phentsize != sizeof(ElfW(Phdr)))
        return whole;
    uint64_t sections = (uint64_t)head->e_shnum * head->e_shentsize;
    if (head->e_shoff > size || sections > size - head->e_shoff)
        return cut;
    return NULL;
}

/* The loader maps what lies between the first and the last address and trusts that the segments
   ascend; one that does not would be laid over the program's own memory. */
static const char *segment_fault(int file, const ElfW(Ehdr) * head, uint64_t size)
{
    uint64_t end = 0;
    for (unsigned i = 0; i < head->e_phnum; i++) {
        ElfW(Phdr) segment;
        uint64_t at = (uint64_t)head->e_phoff + (uint64_t)i * sizeof segment;
        if (at > size || size - at < sizeof segment ||
            !read_at(file, &segment, sizeof segment, (off_t)at) || segment.p_offset > size ||
            segment.p_filesz > size - segment.p_offset)
            return "is no complete shared object: it was cut short";
        if (segment.p_type != PT_LOAD)
            continue;
        if (segment.p_vaddr < end || segment.p_memsz < segment.p_filesz ||
            segment.p_memsz > most_bytes || segment.p_vaddr > most_bytes)
            return "is a damaged shared object";
        end = segment.p_vaddr + segment.p_memsz;
    }
    return NULL;
}

bool ff_elf_check(const char *path, char *why, size_t why_size)
{
    struct stat status;
    ElfW(Ehdr) head = {0};
    const char *fault = NULL;
    /* O_NONBLOCK: a pipe of that name must not hold the program up */
    int file = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (file < 0) {
        snprintf(why, why_size, "cannot be opened: %s", strerror(errno));
        return false;
    }
    if (fstat(file, &status) != 0 || !S_ISREG(status.st_mode))
        fault = "is no file";
    else if (!(fault = header_fault(file, &head, (uint64_t)status.st_size)))
        fault = segment_fault(file, &head, (uint64_t)status.st_size);
    close(file);
    if (fault)
        snprintf(why, why_size, "%s", fault);
    return !fault;
}
