/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * A log of arrays, to which one process appends. It begins with 64 bytes of text; then come
 * records, each of a multiple of 8 bytes, all numbers little-endian:
 *
 *      0  length of the record, 8 bytes
 *      8  key of the case, 24 bytes, the rest of which are zeros
 *     32  where in the record the array begins, 8 bytes
 *     40  name of the output, which ends with one to eight zeros
 *         the array as in a file .npy
 *         CRC-32 of all before it in the record, 8 bytes of which the last four are zeros
 *
 * Nothing is written twice: who goes on with a log first cuts off what a process that was killed
 * had begun. It needs of a file system that one process can write to the end of a file and have it
 * kept by fdatasync: no lock, no shared mapping.
 */
#ifndef ARRAYS_LOG_H
#define ARRAYS_LOG_H

#include "checksum.h"
#include "npy.h"

#include <sys/types.h>

enum {
    ARRAYS_LOG_FORMAT = 1,
    ARRAYS_LOG_HEAD = 64, /* bytes before the first record */
    ARRAYS_LONGEST_KEY = 23,
    ARRAYS_LONGEST_OUTPUT = 199
};

typedef struct arrays_log {
    int fd;
    off_t end; /* end of the last record */
    arrays_checksum checksum;
} arrays_log;

/* Identifies the array of a record. */
typedef struct arrays_label {
    const char *key, *output;
    size_t shape[4];
    uint32_t rank;
} arrays_label;

/* Opens a log in a directory for appending, or creates it. `end` is the end of the last known
   record; what follows is cut off. `fresh`: a log of this name must not exist. False with what is
   wrong, and errno. */
bool arrays_log_open(arrays_log *log, int directory, const char *name, off_t end, bool fresh,
                     char why[ARRAYS_WHY]);
/* Appends a record and sets `offset` to where it begins; false with errno. */
bool arrays_log_append(arrays_log *log, const arrays_label *label, const double *data,
                       off_t *offset);
void arrays_log_close(arrays_log *log);
/* Forces written data to the disk; false with errno. File systems that do not support this write it
   on their own, or never. */
bool arrays_force(int file);

/* log-read.c: reads the logs of a directory. */
enum { ARRAYS_MOST_OPEN = 16 };

typedef struct arrays_reader {
    int directory;
    arrays_checksum checksum;
    struct {
        char *name;
        int fd;
        off_t size;
    } logs[ARRAYS_MOST_OPEN];
    size_t next; /* the one to close when another log is opened */
} arrays_reader;

void arrays_reader_open(arrays_reader *reader, int directory); /* the descriptor is borrowed */
void arrays_reader_close(arrays_reader *reader);
/* True if the log is long enough for the record at `offset`, else what is wrong. Memory for the
   numbers may be allocated only after this check. */
bool arrays_reader_has(arrays_reader *reader, const char *name, off_t offset,
                       const arrays_label *label, char why[ARRAYS_WHY]);
/* Reads the numbers of such a record; numbers that are not finite become NaN. */
bool arrays_reader_read(arrays_reader *reader, const char *name, off_t offset,
                        const arrays_label *label, double *out, char why[ARRAYS_WHY]);

#endif
