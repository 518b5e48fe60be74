/* SPDX-License-Identifier: MIT */
#include "clean.h"

#include "../value/text.h"

#include <string.h>

/* Whether the character lies outside the two ranges of control characters. */
static bool is_clean(uint32_t c)
{
    return c >= 0x20 && (c < 0x7f || c > 0x9f) && c != FE_NO_CHAR;
}

void ff_clean_text(char *out, size_t size, const char *text)
{
    const char *end = text + strlen(text);
    uint32_t c;
    for (size_t n; text < end; text += n) {
        bool plain = *text >= ' ' && *text < 0x7f; /* nearly all characters are plain */
        n = plain ? 1 : fe_char_read(text, end, &c);
        if (n >= size)
            break;
        bool clean = plain || is_clean(c);
        size_t made = clean ? n : 1;
        if (clean)
            memcpy(out, text, n);
        else
            *out = *text == '\n' || *text == '\t' ? ' ' : '?';
        out += made;
        size -= made;
    }
    *out = 0;
}

bool fe_text_is_clean(const char *text)
{
    const char *end = text + strlen(text);
    uint32_t c = ' ';
    while (text < end && is_clean(c))
        text += fe_char_read(text, end, &c);
    return is_clean(c);
}
