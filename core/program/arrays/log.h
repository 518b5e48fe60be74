/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * A log of arrays, to which one process appends. A log begins with 64 bytes of text; then come
 * records, each of a multiple of 8 bytes, all numbers little-endian: 0  length of the record, 8
 * bytes 8  key of the case, filled with zeros to 24 bytes 32  offset of the array in the record, 8
 * bytes 40  name of the output, which ends with one to eight zeros the array in the format of a
 * .npy file CRC-32 of the record up to here, and four zeros A process that continues a log first
 * cuts off an incomplete record, which a killed process may have left. The file system must support
 * appending by one process and fdatasync. Locks and shared mappings are not needed.
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
   record; what follows is cut off. `fresh`: a log of this name must not exist. Returns false with
   the reason in `why` and errno. */
bool arrays_log_open(arrays_log *log, int directory, const char *name, off_t end, bool fresh,
                     char why[ARRAYS_WHY]);
/* Appends a record and sets `offset` to its start. Returns false with errno. */
bool arrays_log_append(arrays_log *log, const arrays_label *label, const double *data,
                       off_t *offset);
void arrays_log_close(arrays_log *log);
/* Forces written data to the disk. Returns false with errno. File systems that do not support this
   write it by themselves, or never. */
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
    size_t next; /* index of the log to close when another one is opened */
} arrays_reader;

/* does not take ownership of the descriptor */
void arrays_reader_open(arrays_reader *reader, int directory);
void arrays_reader_close(arrays_reader *reader);
/* Returns true if the log is long enough for the record at `offset`, otherwise false with the
   reason. Allocate memory for the numbers only after this check. */
bool arrays_reader_has(arrays_reader *reader, const char *name, off_t offset,
                       const arrays_label *label, char why[ARRAYS_WHY]);
/* Reads the numbers of such a record. Numbers that are not finite become NaN. */
bool arrays_reader_read(arrays_reader *reader, const char *name, off_t offset,
                        const arrays_label *label, double *out, char why[ARRAYS_WHY]);

#endif
