/* SPDX-License-Identifier: MIT */
#include "text.h"

#include <string.h>

size_t fe_char_read(const char *at, const char *end, uint32_t *code)
{
    static const uint32_t least[] = {0, 0, 0x80, 0x800, 0x10000};
    unsigned char first = (unsigned char)*at;
    size_t length = 0;
    if (first < 0x80)
        length = 1;
    else if (first >= 0xC0 && first < 0xF8)
        length = first < 0xE0 ? 2 : first < 0xF0 ? 3 : 4;
    uint32_t c = length < 2 ? first : first & (0x7Fu >> length);
    bool good = length > 0 && (size_t)(end - at) >= length;
    for (size_t i = 1; good && i < length; i++) {
        good = ((unsigned char)at[i] & 0xC0) == 0x80;
        c = c << 6 | ((unsigned char)at[i] & 0x3F);
    }
    good = good && c >= least[length] && c <= 0x10FFFF && !(c >= 0xD800 && c <= 0xDFFF);
    *code = good ? c : FE_NO_CHAR;
    return good ? length : 1;
}

static const char *line_end(const char *at, const char *stop)
{
    const char *end = memchr(at, '\n', (size_t)(stop - at));
    return end ? end : stop;
}

const char *fe_line_begin(const ff_source *source, uint32_t line, const char **end)
{
    const char *at = source->text, *stop = at + source->length;
    for (; line > 1 && at < stop; line--) {
        const char *break_at = line_end(at, stop);
        at = break_at < stop ? break_at + 1 : stop;
    }
    *end = line_end(at, stop);
    return at;
}

ff_place fe_place_of(const ff_source *source, size_t offset, uint32_t width)
{
    const char *at = source->text, *stop = at + source->length, *goal = at + offset;
    ff_place place = {.source = source, .line = 1, .column = 1, .width = width};
    uint32_t code;
    while (at < goal && at < stop) {
        place.column = *at == '\n' ? 1 : place.column + 1;
        place.line += *at == '\n';
        at += fe_char_read(at, stop, &code);
    }
    return place;
}

const char *fe_text_at(const ff_place *place, const char **end)
{
    const char *at = fe_line_begin(place->source, place->line, end);
    uint32_t code;
    for (uint32_t i = 1; i < place->column && at < *end; i++)
        at += fe_char_read(at, *end, &code);
    return at;
}
