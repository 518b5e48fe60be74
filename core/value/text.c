/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "text.h"

#include <string.h>

size_t ff_char_read(const char *at, const char *end, uint32_t *code)
{
    static const uint32_t least[] = {0, 0, 0x80, 0x800, 0x10000};
    unsigned char first = (unsigned char)*at;
    size_t length = first < 0x80   ? 1
                    : first < 0xC2 ? 0
                    : first < 0xE0 ? 2
                    : first < 0xF0 ? 3
                    : first < 0xF5 ? 4
                                   : 0;
    uint32_t c = length < 2 ? first : first & (0x7Fu >> length);
    bool good = length > 0 && (size_t)(end - at) >= length;
    for (size_t i = 1; good && i < length; i++) {
        unsigned char next = (unsigned char)at[i];
        good = (next & 0xC0) == 0x80;
        c = c << 6 | (next & 0x3F);
    }
    good = good && c >= least[length] && c <= 0x10FFFF && !(c >= 0xD800 && c <= 0xDFFF);
    *code = good ? c : FF_NO_CHAR;
    return good ? length : 1;
}

size_t ff_break_at(const char *at, const char *end)
{
    size_t left = (size_t)(end - at);
    if (left == 0)
        return 0;
    if (*at == '\r')
        return left > 1 && at[1] == '\n' ? 2 : 1;
    if (*at == '\n')
        return 1;
    if (left > 1 && !memcmp(at, "\xC2\x85", 2))
        return 2;
    bool separator = left > 2 && (!memcmp(at, "\xE2\x80\xA8", 3) || !memcmp(at, "\xE2\x80\xA9", 3));
    return separator ? 3 : 0;
}

const char *ff_line_begin(const ff_source *source, uint32_t line, const char **end)
{
    const char *at = source->text, *stop = at + source->length;
    for (uint32_t i = 1; i < line && at < stop;) {
        size_t n = ff_break_at(at, stop);
        i += n > 0;
        at += n > 0 ? n : 1;
    }
    const char *begin = at;
    while (at < stop && ff_break_at(at, stop) == 0)
        at++;
    *end = at;
    return begin;
}

ff_place ff_place_of(const ff_source *source, size_t offset, uint32_t width)
{
    const char *at = source->text, *stop = at + source->length;
    const char *goal = at + (offset < source->length ? offset : source->length);
    ff_place place = {.source = source, .line = 1, .column = 1, .width = width};
    uint32_t code;
    while (at < goal) {
        size_t n = ff_break_at(at, stop);
        place.line += n > 0;
        place.column = n > 0 ? 1 : place.column + 1;
        at += n > 0 ? n : ff_char_read(at, stop, &code);
    }
    return place;
}

const char *ff_text_at(const ff_place *place, const char **end)
{
    const char *at = ff_line_begin(place->source, place->line, end);
    uint32_t code;
    for (uint32_t i = 1; i < place->column && at < *end; i++)
        at += ff_char_read(at, *end, &code);
    return at;
}
