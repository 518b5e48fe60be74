/* SPDX-License-Identifier: GPL-3.0-or-later */
/* CRC-32 of IEEE 802.3, as in zlib, gzip and PNG. */
#ifndef ARRAYS_CHECKSUM_H
#define ARRAYS_CHECKSUM_H

#include <stddef.h>
#include <stdint.h>

/* Sums of each byte value, followed by zero to seven zero bytes. */
typedef struct arrays_checksum {
    uint32_t table[8][256];
} arrays_checksum;

void arrays_checksum_prepare(arrays_checksum *checksum);
/* Continues a sum; the sum of no bytes is 0. */
uint32_t arrays_checksum_add(const arrays_checksum *checksum, uint32_t sum, const void *data,
                             size_t size);

#endif
