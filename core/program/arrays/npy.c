/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "npy.h"

#include "../memory/file.h"

#include <assert.h>
#include <math.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

_Static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__,
               "the numbers are written as they stand in memory");

static const char magic[] = "\x93NUMPY";
enum {
    MAGIC = sizeof magic - 1,
    PREAMBLE = MAGIC + 4, /* includes the version and the length of the header */
    ALIGNMENT = 64,       /* alignment of the first number in the file */
    LONGEST_HEADER = 1024
};

/* Prints a shape as Python does: (), (5,), (5, 3). */
static size_t print_shape(const size_t *shape, uint32_t rank, char *out, size_t size)
{
    size_t length = (size_t)snprintf(out, size, "(");
    for (uint32_t i = 0; i < rank; i++)
        length += (size_t)snprintf(out + length, size - length, "%zu%s", shape[i],
                                   rank == 1      ? ","
                                   : i + 1 < rank ? ", "
                                                  : "");
    return length + (size_t)snprintf(out + length, size - length, ")");
}

size_t arrays_npy_header(const size_t *shape, uint32_t rank, char header[ARRAYS_NPY_HEADER])
{
    assert(rank == 0 || shape);
    char *text = header + PREAMBLE;
    size_t room = ARRAYS_NPY_HEADER - PREAMBLE;
    size_t length =
        (size_t)snprintf(text, room, "{'descr': '<f8', 'fortran_order': False, 'shape': ");
    length += print_shape(shape, rank, text + length, room - length);
    length += (size_t)snprintf(text + length, room - length, ", }");
    /* includes a line break */
    size_t total = (PREAMBLE + length + ALIGNMENT) / ALIGNMENT * ALIGNMENT;
    memset(text + length, ' ', total - PREAMBLE - length);
    header[total - 1] = '\n';
    memcpy(header, magic, MAGIC);
    header[MAGIC] = 1;
    header[MAGIC + 1] = 0;
    header[MAGIC + 2] = (char)((total - PREAMBLE) % 256);
    header[MAGIC + 3] = (char)((total - PREAMBLE) / 256);
    return total;
}

void arrays_npy_write(FILE *stream, const double *data, const size_t *shape, uint32_t rank)
{
    char header[ARRAYS_NPY_HEADER];
    size_t total = arrays_npy_header(shape, rank, header), count = 1;
    for (uint32_t i = 0; i < rank; i++)
        count *= shape[i];
    setvbuf(stream, NULL, _IONBF, 0);
    if (fwrite(header, 1, total, stream) == total && count)
        fwrite(data, sizeof *data, count, stream);
}

/* Returns the text after 'key': in the header; "" if the key is missing. */
static const char *value_of(const char *header, const char *key)
{
    char quoted[32];
    snprintf(quoted, sizeof quoted, "'%s':", key);
    const char *at = strstr(header, quoted);
    return at ? at + strlen(quoted) + strspn(at + strlen(quoted), " ") : "";
}

/* Returns whether the header's shape is this one; blanks are ignored. */
static bool is_shape(const char *found, const char *expected)
{
    while (*expected && *found) {
        found += strspn(found, " ");
        expected += strspn(expected, " ");
        if (*found++ != *expected)
            return false;
        if (*expected++ == ')')
            return true;
    }
    return false;
}

/* Checks a header. Returns false with the reason in `why`. */
static bool check_header(const char *header, const char *shape, char why[ARRAYS_WHY])
{
    const char *type = value_of(header, "descr"), *order = value_of(header, "fortran_order"),
               *found = value_of(header, "shape");
    if (strncmp(type, "'<f8'", 5) == 0 && strncmp(order, "False", 5) == 0 && is_shape(found, shape))
        return true;
    if (strncmp(type, "'|O", 3) == 0)
        snprintf(why, ARRAYS_WHY, "it holds pickled objects, which are never read");
    else if (strncmp(type, "'>f8'", 5) == 0)
        snprintf(why, ARRAYS_WHY, "its numbers are big-endian ('>f8'), not '<f8'");
    else if (strncmp(type, "'<f8'", 5) != 0)
        snprintf(why, ARRAYS_WHY, "its numbers are of the type %.*s, not '<f8'",
                 (int)strcspn(type, ",}\n"), type);
    else if (strncmp(order, "False", 5) != 0)
        snprintf(why, ARRAYS_WHY, "its numbers are in Fortran order, not in C order");
    else
        snprintf(why, ARRAYS_WHY, "its shape is %.*s), not %s", (int)strcspn(found, ")}\n"), found,
                 shape);
    return false;
}

/* Reads the header; false if the file has none. */
static bool read_header(int fd, char header[LONGEST_HEADER], size_t *length, char why[ARRAYS_WHY])
{
    unsigned char start[PREAMBLE];
    if (!file_read(fd, start, sizeof start, -1) || memcmp(start, magic, MAGIC) != 0)
        snprintf(why, ARRAYS_WHY, "it is not a .npy file");
    else if (start[MAGIC] != 1 || start[MAGIC + 1] != 0)
        snprintf(why, ARRAYS_WHY, "its format has version %d.%d, not 1.0", start[MAGIC],
                 start[MAGIC + 1]);
    else if ((*length = start[MAGIC + 2] + 256U * start[MAGIC + 3]) >= LONGEST_HEADER)
        snprintf(why, ARRAYS_WHY, "its header is longer than %d bytes", LONGEST_HEADER);
    else if (!file_read(fd, header, *length, -1))
        snprintf(why, ARRAYS_WHY, "it ends within its header");
    else
        return true;
    return false;
}

/* Returns whether the size of the file agrees with its shape. */
static bool check_size(const struct stat *info, size_t before, const size_t *shape, uint32_t rank,
                       char why[ARRAYS_WHY])
{
    double expected = sizeof(double);
    for (uint32_t i = 0; i < rank; i++)
        expected *= (double)shape[i];
    expected += (double)before;
    if ((double)info->st_size == expected)
        return true;
    snprintf(why, ARRAYS_WHY, "it has %.0f bytes, but its shape needs %.0f", (double)info->st_size,
             expected);
    return false;
}

static bool check_file(int fd, const size_t *shape, uint32_t rank, char why[ARRAYS_WHY])
{
    char header[LONGEST_HEADER] = "", expected[4 * 24];
    size_t length = 0;
    struct stat info;
    print_shape(shape, rank, expected, sizeof expected);
    return fstat(fd, &info) == 0 && read_header(fd, header, &length, why) &&
           check_header(header, expected, why) &&
           check_size(&info, PREAMBLE + length, shape, rank, why);
}

int arrays_npy_open(int directory, const char *name, const size_t *shape, uint32_t rank,
                    char why[ARRAYS_WHY])
{
    const char *unopened;
    int fd = file_open(directory, name, &unopened);
    if (fd < 0)
        snprintf(why, ARRAYS_WHY, "%s", unopened);
    if (fd < 0 || check_file(fd, shape, rank, why))
        return fd;
    close(fd);
    return -1;
}

void arrays_npy_clean(double *numbers, size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (!isfinite(numbers[i]))
            numbers[i] = (double)NAN;
}

bool arrays_npy_read(int fd, double *out, size_t count)
{
    bool good = file_read(fd, out, count * sizeof *out, -1);
    if (good)
        arrays_npy_clean(out, count);
    close(fd);
    return good;
}
