/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "record.h"

#include <stdlib.h>
#include <string.h>

_Static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__,
               "the numbers are written as they stand in memory");

static const char title_start[] = "flankfilm arrays, format ";

void arrays_head_make(arrays_head *head, const arrays_label *label)
{
    char header[ARRAYS_NPY_HEADER];
    size_t key = strnlen(label->key, ARRAYS_LONGEST_KEY),
           output = strnlen(label->output, ARRAYS_LONGEST_OUTPUT);
    size_t start = (ARRAYS_OUTPUT_AT + output + 8) / 8 * 8;
    size_t size = arrays_npy_header(label->shape, label->rank, header);
    double count = 1;
    for (uint32_t i = 0; i < label->rank; i++)
        count *= (double)label->shape[i];
    memset(head, 0, sizeof *head);
    head->size = start + size;
    head->length = (double)head->size + count * sizeof(double) + ARRAYS_SUM;
    uint64_t length = head->length < 0x1p62 ? (uint64_t)head->length : 0, at = start;
    head->count = length ? (size_t)((length - head->size - ARRAYS_SUM) / sizeof(double)) : 0;
    memcpy(head->bytes, &length, sizeof length);
    memcpy(head->bytes + ARRAYS_KEY_AT, label->key, key);
    memcpy(head->bytes + ARRAYS_START_AT, &at, sizeof at);
    memcpy(head->bytes + ARRAYS_OUTPUT_AT, label->output, output);
    memcpy(head->bytes + start, header, size);
}

void arrays_log_title(char title[ARRAYS_LOG_HEAD])
{
    memset(title, ' ', ARRAYS_LOG_HEAD);
    title[ARRAYS_LOG_HEAD - 1] = '\n';
    char text[ARRAYS_LOG_HEAD];
    int length = snprintf(text, sizeof text, "%s%d", title_start, ARRAYS_LOG_FORMAT);
    memcpy(title, text, (size_t)length);
}

bool arrays_log_check_title(const char title[ARRAYS_LOG_HEAD], char why[ARRAYS_WHY])
{
    enum { START = sizeof title_start - 1 };
    char expected[ARRAYS_LOG_HEAD], format[ARRAYS_LOG_HEAD - START + 1];
    arrays_log_title(expected);
    if (memcmp(title, expected, ARRAYS_LOG_HEAD) == 0)
        return true;
    /* the text may lack a terminating zero */
    memcpy(format, title + START, ARRAYS_LOG_HEAD - START);
    format[ARRAYS_LOG_HEAD - START] = '\0';
    format[strcspn(format, " \n")] = '\0';
    if (memcmp(title, title_start, START) != 0)
        snprintf(why, ARRAYS_WHY, "it is not a log of arrays");
    else
        snprintf(why, ARRAYS_WHY, "it has format %s; this flankfilm reads format %d", format,
                 ARRAYS_LOG_FORMAT);
    return false;
}
