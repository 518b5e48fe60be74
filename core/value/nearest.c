/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "report.h"

/* Costs are in half edits: a letter in the wrong case is half a mistake. */
enum { LONGEST = 63, EDIT = 2, CASE = 1, NEVER = 1000 };

static char lower(char c)
{
    return c >= 'A' && c <= 'Z' ? (char)(c - 'A' + 'a') : c;
}

static bool is_joint(char c)
{
    return c == '-' || c == '_' || c == ' ' || c == '.';
}

static int replace_cost(char a, char b)
{
    if (a == b)
        return 0;
    return lower(a) == lower(b) || (is_joint(a) && is_joint(b)) ? CASE : EDIT;
}

static int min(int a, int b)
{
    return a < b ? a : b;
}

/* Optimal string alignment distance (Damerau 1964): insert, delete, replace, swap neighbours. */
static int distance(const char *a, const char *b)
{
    size_t n = strlen(a), m = strlen(b);
    int row[3][LONGEST + 1];
    int *older = row[0], *old = row[1], *now = row[2];
    if (n > LONGEST || m > LONGEST)
        return NEVER;
    for (size_t j = 0; j <= m; j++)
        old[j] = EDIT * (int)j;
    for (size_t i = 1; i <= n; i++) {
        now[0] = EDIT * (int)i;
        for (size_t j = 1; j <= m; j++) {
            now[j] =
                min(old[j - 1] + replace_cost(a[i - 1], b[j - 1]), min(old[j], now[j - 1]) + EDIT);
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                now[j] = min(now[j], older[j - 2] + EDIT);
        }
        int *spare = older;
        older = old;
        old = now;
        now = spare;
    }
    return old[m];
}

static bool same_but_case(const char *a, const char *b)
{
    while (*a && *b && (lower(*a) == lower(*b) || (is_joint(*a) && is_joint(*b))))
        a++, b++;
    return *a == *b;
}

/* One mistake in three letters is near; in words of two letters, one mistake is another word. */
static int limit(const char *word)
{
    size_t n = strlen(word);
    return n < 3 ? CASE : EDIT * (int)((n + 1) / 3 < 4 ? (n + 1) / 3 : 4);
}

const char *ff_nearest(const char *word, const char *const *candidates, size_t count)
{
    const char *best = NULL;
    int best_cost = NEVER;
    for (size_t i = 0; i < count; i++) {
        int cost = distance(word, candidates[i]);
        bool near = cost <= limit(word) || same_but_case(word, candidates[i]);
        if (near && cost < best_cost) {
            best = candidates[i];
            best_cost = cost;
        }
    }
    return best;
}
