/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "private.h"

#include <stdio.h>
#include <string.h>

static bool is_letter(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

bool ff_dims_parse(const char *text, ff_dims *dims, char *why, size_t why_size)
{
    *dims = (ff_dims){.rank = 0};
    for (const char *at = text; *at;) {
        size_t length = strcspn(at, " ");
        size_t word = length;
        if (dims->rank == FF_MAX_RANK) {
            snprintf(why, why_size, "names more than %d dimensions", (int)FF_MAX_RANK);
            return false;
        }
        if (word > 1 && at[word - 1] == '?') {
            if (dims->rank > 0) {
                snprintf(why, why_size, "marks a dimension as optional that is not the first");
                return false;
            }
            dims->first_optional = true;
            word--;
        }
        if (word == 0 || word >= sizeof dims->name[0] || !is_letter(at[0]) ||
            strspn(at, "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_") < word) {
            snprintf(why, why_size, "is no list of names, each parted from the next by one blank");
            return false;
        }
        memcpy(dims->name[dims->rank++], at, word);
        at += length;
        if (*at == ' ' && *++at == 0) {
            snprintf(why, why_size, "ends in a blank");
            return false;
        }
    }
    return true;
}
