/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Words of a file that have another name now: paths, wires, cards. */
#include "private.h"

#include <string.h>

static bool is_word(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '-';
}

static bool is_path(char c)
{
    return is_word(c) || c == '.' || c == '/';
}

static bool is(const char *text, size_t length, const char *name)
{
    return name && strlen(name) == length && !memcmp(text, name, length);
}

/* Whether it is the name of one of several viscosity laws. */
static bool is_one_of(const rewrite_world *world, const char *text, size_t length)
{
    bool found = is(text, length, world->viscosity);
    for (size_t i = 0; i < world->others; i++)
        found = found || is(text, length, world->other[i]);
    return found;
}

/* "oil.temperature", "oil.z", "rho.a". */
void rewrite_print_path(const rewrite_world *world, const char *path, size_t length, FILE *out)
{
    const char *dot = memchr(path, '.', length);
    size_t head = dot ? (size_t)(dot - path) : length, rest = length - head;
    char key[32] = "";
    if (dot && rest - 1 < sizeof key)
        memcpy(key, dot + 1, rest - 1);
    if (world->mode == REWRITE_EACH && is_one_of(world, path, head) && rewrite_is_of_oil(key) &&
        strcmp(key, "eta0") != 0) {
        fprintf(out, "%.*s_oil%.*s", (int)head, path, (int)rest, dot);
    } else if (world->mode == REWRITE_NONE || world->mode == REWRITE_EACH || !dot) {
        fwrite(path, 1, length, out);
    } else if (is(path, head, world->viscosity)) {
        bool oil = world->mode == REWRITE_OIL && rewrite_is_of_oil(key);
        if (oil && !strcmp(key, "temperature") && world->operating)
            fprintf(out, "%s.oil_temperature", world->operating);
        else
            fprintf(out, "%s%.*s", oil ? "oil" : "viscosity", (int)rest, dot);
    } else if (is(path, head, world->density)) {
        if (world->mode == REWRITE_OIL && !strcmp(key, "rho0"))
            fputs("oil.density", out);
        else
            fprintf(out, "density%.*s", (int)rest, dot);
    } else {
        fwrite(path, 1, length, out);
    }
}

/* Whether the word is the value of the key: "viscosity: oil". */
static bool stands_after(const char *text, const char *word, const char *key)
{
    size_t length = strlen(key);
    while (word > text && (word[-1] == ' ' || word[-1] == '"'))
        word--;
    if (word == text || word[-1] != ':')
        return false;
    word--;
    return (size_t)(word - text) >= length && !memcmp(word - length, key, length) &&
           (word - length == text || !is_path(word[-(ptrdiff_t)length - 1]));
}

/* The card whose old name ends the path; NULL: none. */
static const rewrite_card *card_of(const char *path, size_t length)
{
    const rewrite_card *card;
    for (size_t i = 0; (card = rewrite_card_at(i)); i++) {
        size_t name = strlen(card->old);
        if (name <= length && !memcmp(path + length - name, card->old, name) &&
            (name == length || path[length - name - 1] == '/'))
            return card;
    }
    return NULL;
}

static void print_word(const rewrite_world *world, const char *text, const char *word,
                       size_t length, FILE *out)
{
    const rewrite_card *card = card_of(word, length);
    bool moves = world->mode == REWRITE_OIL || world->mode == REWRITE_BARE;
    if (card)
        fprintf(out, "%.*s%s", (int)(length - strlen(card->old)), word, card->now);
    else if (moves && is(word, length, world->viscosity) && stands_after(text, word, "viscosity"))
        fputs("viscosity", out);
    else if (moves && is(word, length, world->density) && stands_after(text, word, "density"))
        fputs("density", out);
    else
        rewrite_print_path(world, word, length, out);
}

void rewrite_print_words(const rewrite_world *world, const char *text, size_t length, FILE *out)
{
    const char *end = text + length;
    bool comment = false;
    for (const char *at = text; at < end;) {
        size_t word = 0;
        comment = *at != '\n' && (comment || (*at == '#' && (at == text || at[-1] <= ' ')));
        while (!comment && at + word < end && is_path(at[word]))
            word++;
        if (word)
            print_word(world, text, at, word, out);
        else
            fputc(*at, out);
        at += word ? word : 1;
    }
}
