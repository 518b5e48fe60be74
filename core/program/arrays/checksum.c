/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sums eight bytes at a time ("slicing by 8"), with one table of remainders for each of the eight
   byte positions. */
#include "checksum.h"

static const uint32_t polynomial = 0xEDB88320; /* polynomial with the bits in the order of
                                                  transmission */

void arrays_checksum_prepare(arrays_checksum *checksum)
{
    for (uint32_t byte = 0; byte < 256; byte++) {
        uint32_t sum = byte;
        for (int bit = 0; bit < 8; bit++)
            sum = sum & 1 ? sum >> 1 ^ polynomial : sum >> 1;
        checksum->table[0][byte] = sum;
    }
    for (int zeros = 1; zeros < 8; zeros++)
        for (uint32_t byte = 0; byte < 256; byte++) {
            uint32_t before = checksum->table[zeros - 1][byte];
            checksum->table[zeros][byte] = before >> 8 ^ checksum->table[0][before & 0xFF];
        }
}

uint32_t arrays_checksum_add(const arrays_checksum *checksum, uint32_t sum, const void *data,
                             size_t size)
{
    const unsigned char *at = data;
    sum = ~sum;
    for (; size >= 8; size -= 8, at += 8) {
        uint32_t next = 0;
        for (int i = 0; i < 4; i++) {
            next ^= checksum->table[7 - i][at[i] ^ (sum >> 8 * i & 0xFF)];
            next ^= checksum->table[3 - i][at[4 + i]];
        }
        sum = next;
    }
    for (; size > 0; size--, at++)
        sum = sum >> 8 ^ checksum->table[0][(sum ^ *at) & 0xFF];
    return ~sum;
}
