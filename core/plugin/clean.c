/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "clean.h"

#include <string.h>

/* Bytes of the well-formed, printable character at `at`; 0 when there is none. */
static size_t character_length(const unsigned char *at)
{
    size_t length = at[0] < 0x80 ? 1 : at[0] < 0xc2 ? 0 : at[0] < 0xe0 ? 2 : at[0] < 0xf0 ? 3 : 4;
    if (at[0] < 0x20 || at[0] == 0x7f || at[0] > 0xf4)
        return 0;
    for (size_t i = 1; i < length; i++)
        if ((at[i] & 0xc0) != 0x80)
            return 0;
    bool overlong = (at[0] == 0xe0 && at[1] < 0xa0) || (at[0] == 0xf0 && at[1] < 0x90);
    bool surrogate = at[0] == 0xed && at[1] > 0x9f;
    bool beyond = at[0] == 0xf4 && at[1] > 0x8f;
    return overlong || surrogate || beyond ? 0 : length;
}

void ff_clean_text(char *out, size_t size, const char *text)
{
    size_t used = 0;
    for (const unsigned char *at = (const unsigned char *)text; *at;) {
        size_t length = character_length(at);
        if (used + (length ? length : 1) >= size)
            break;
        if (length)
            memcpy(out + used, at, length);
        else
            out[used] = *at == '\n' || *at == '\t' ? ' ' : '?';
        used += length ? length : 1;
        at += length ? length : 1;
    }
    out[used] = 0;
}

bool ff_text_is_clean(const char *text)
{
    const unsigned char *at = (const unsigned char *)text;
    for (size_t length; *at; at += length)
        if (!(length = character_length(at)))
            return false;
    return true;
}
