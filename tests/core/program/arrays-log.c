/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A log of arrays that is broken off or changed at any byte: what is read is right or a sentence,
   and who goes on with it leaves the same bytes as if nothing had happened. */
#include "../../../core/program/arrays/log.h"
#include "../../../core/program/arrays/record.h"

#include <check.h>
#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { RECORDS = 3, MOST = 4096 };

static const double numbers[] = {1, -2.5, 3e300, 5e-324, (double)INFINITY, (double)NAN};
static const arrays_label labels[RECORDS] = {
    {.key = "0123456789abcdef", .output = "film.h", .shape = {2, 3}, .rank = 2},
    {.key = "0123456789abcdef", .output = "film.none", .shape = {0}, .rank = 1},
    {.key = "fedcba9876543210", .output = "film.h_min", .shape = {6}, .rank = 1},
};

typedef struct lab {
    int directory;
    off_t at[RECORDS + 1]; /* where the records begin and the last one ends */
    char bytes[MOST];      /* of the log */
} lab;

static bool has(const char *why, const char *words)
{
    return strstr(why, words) != NULL;
}

static bool put(const lab *l, const char *bytes, size_t size)
{
    int fd = openat(l->directory, "log", O_WRONLY | O_CREAT | O_TRUNC, 0666);
    bool good = fd >= 0 && write(fd, bytes, size) == (ssize_t)size;
    close(fd);
    return good;
}

static size_t get(const lab *l, char bytes[MOST])
{
    int fd = openat(l->directory, "log", O_RDONLY);
    ssize_t size = fd < 0 ? 0 : read(fd, bytes, MOST);
    close(fd);
    return size > 0 ? (size_t)size : 0;
}

/* Reads a record as those do who read results; `why` is "" when it can be read. */
static void read_record(const lab *l, const arrays_label *label, off_t at, char why[ARRAYS_WHY],
                        double out[6])
{
    arrays_reader reader;
    arrays_reader_open(&reader, l->directory);
    *why = '\0';
    if (arrays_reader_has(&reader, "log", at, label, why) &&
        arrays_reader_read(&reader, "log", at, label, out, why))
        *why = '\0';
    arrays_reader_close(&reader);
}

static bool append(const lab *l, size_t first, off_t end, off_t at[RECORDS + 1])
{
    arrays_log log;
    char why[ARRAYS_WHY];
    bool good = arrays_log_open(&log, l->directory, "log", end, false, why);
    for (size_t i = first; good && i < RECORDS; i++)
        good = arrays_log_append(&log, &labels[i], numbers, &at[i]);
    at[RECORDS] = log.end;
    arrays_log_close(&log);
    return good;
}

/* Cuts the log to a size and appends what is missing: whether it has the same bytes again. */
static bool mends(const lab *l, off_t size, size_t first, off_t end)
{
    char left[MOST];
    off_t at[RECORDS + 1];
    return put(l, l->bytes, (size_t)size) && append(l, first, end, at) &&
           get(l, left) == (size_t)l->at[RECORDS] &&
           !memcmp(left, l->bytes, (size_t)l->at[RECORDS]);
}

static void test_sums(void)
{
    arrays_checksum sums;
    static const char text[] = "123456789, and some more of it";
    arrays_checksum_prepare(&sums);
    check_true("the check value", arrays_checksum_add(&sums, 0, text, 9) == 0xCBF43926);
    bool same = true;
    for (size_t i = 0; i < sizeof text; i++) {
        uint32_t sum = arrays_checksum_add(&sums, 0, text, i);
        same = same && arrays_checksum_add(&sums, sum, text + i, sizeof text - i) ==
                           arrays_checksum_add(&sums, 0, text, sizeof text);
    }
    check_true("in two parts", same);
}

static void test_reading(const lab *l)
{
    double out[6];
    char why[ARRAYS_WHY];
    for (size_t i = 0; i < RECORDS; i++) {
        read_record(l, &labels[i], l->at[i], why, out);
        check_true(*why ? why : "a record", !*why);
    }
    check_true("the numbers", memcmp(out, numbers, 4 * sizeof *out) == 0);
    check_true("what is not finite is NaN", isnan(out[4]) && isnan(out[5]));
    arrays_label other = labels[2];
    other.output = "film.h_max";
    read_record(l, &other, l->at[2], why, out);
    check_true("of another output", has(why, "belongs to another array"));
    other = labels[2];
    other.shape[0] = 5;
    read_record(l, &other, l->at[2], why, out);
    check_true("of another shape", *why);
    other.shape[0] = SIZE_MAX / 2;
    read_record(l, &other, l->at[2], why, out);
    check_true("of a shape that no log has", has(why, "is cut off"));
    read_record(l, &labels[2], l->at[2] + 4, why, out);
    check_true("between records", has(why, "is cut off"));
}

/* Each byte of the title and of the last record at which a process can be killed. */
static void test_torn(const lab *l)
{
    char why[ARRAYS_WHY];
    double out[6];
    bool told = true, same = true;
    for (off_t size = l->at[2]; size < l->at[3]; size++) {
        same = mends(l, size, 2, l->at[2]) && same;
        told = put(l, l->bytes, (size_t)size) && told;
        read_record(l, &labels[2], l->at[2], why, out);
        told = told && has(why, "is cut off");
    }
    for (off_t size = 0; size < ARRAYS_LOG_HEAD; size++)
        same = mends(l, size, 0, 0) && same;
    check_true("a record that is cut off is a sentence", told);
    check_true("who goes on leaves the same bytes", same);
}

static void test_changed(const lab *l)
{
    char why[ARRAYS_WHY], bytes[MOST];
    double out[6];
    bool told = true, others = true;
    for (off_t i = l->at[2]; i < l->at[3]; i++) {
        memcpy(bytes, l->bytes, sizeof bytes);
        bytes[i] = (char)(bytes[i] ^ 1 << i % 8);
        told = put(l, bytes, (size_t)l->at[3]) && told;
        read_record(l, &labels[2], l->at[2], why, out);
        told = told && has(why, "does not have its checksum");
        read_record(l, &labels[0], l->at[0], why, out);
        others = others && !*why;
    }
    check_true("a byte that was changed is a sentence", told);
    check_true("and leaves the others", others);
}

/* A title may be spoiled up to its last byte: nothing behind it is read. */
static void test_endless_title(void)
{
    char why[ARRAYS_WHY], title[ARRAYS_LOG_HEAD + 8];
    arrays_log_title(title);
    size_t start = (size_t)(strchr(title, '1') - title);
    memset(title + start, '7', ARRAYS_LOG_HEAD - start);
    strcpy(title + ARRAYS_LOG_HEAD, "beyond");
    check_true("a title without an end", !arrays_log_check_title(title, why) &&
                                             has(why, "777; this flankfilm reads") &&
                                             !has(why, "beyond"));
}

static void test_formats(const lab *l)
{
    char why[ARRAYS_WHY], bytes[MOST];
    double out[6];
    arrays_log log;
    memcpy(bytes, l->bytes, sizeof bytes);
    *strchr(bytes, '1') = '2';
    put(l, bytes, (size_t)l->at[3]);
    read_record(l, &labels[0], l->at[0], why, out);
    check_true("a newer log", has(why, "format 2; this flankfilm reads format 1"));
    check_true("is not gone on with", !arrays_log_open(&log, l->directory, "log", 0, false, why) &&
                                          has(why, "format 2") &&
                                          get(l, bytes) == (size_t)l->at[3]);
    put(l, "something else that is as long as the title of a log has to be, and longer", 74);
    read_record(l, &labels[0], l->at[0], why, out);
    check_true("no log", has(why, "it is not a log of arrays"));
    check_true("of its own",
               !arrays_log_open(&log, l->directory, "log", 0, true, why) && errno == EEXIST);
}

int main(void)
{
    char path[] = "/tmp/flankfilm-log-XXXXXX";
    lab l = {.directory = mkdtemp(path) ? open(path, O_RDONLY | O_DIRECTORY) : -1};
    check_true("there is a place", l.directory >= 0);
    check_true("the log", append(&l, 0, 0, l.at) && get(&l, l.bytes) == (size_t)l.at[RECORDS]);
    test_sums();
    test_reading(&l);
    test_torn(&l);
    test_changed(&l);
    test_formats(&l);
    test_endless_title();
    unlinkat(l.directory, "log", 0);
    close(l.directory);
    check_true("nothing is left", rmdir(path) == 0);
    return check_done();
}
