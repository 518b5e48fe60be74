/* SPDX-License-Identifier: MIT */
/* Finds the word that a misspelt one may mean. */
#include <flankfilm/engine.h>

#include <string.h>

enum { LONGEST = 63, NEVER = 1000 };

/* Maps upper case to lower case and word separators to one character, since these differences are
   no mistakes. */
static char fold(char c)
{
    if (c >= 'A' && c <= 'Z')
        return (char)(c - 'A' + 'a');
    return c == '-' || c == ' ' || c == '.' ? '_' : c;
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
    if (n > LONGEST || m > LONGEST)
        return NEVER;
    for (size_t j = 0; j <= m; j++)
        row[0][j] = (int)j;
    for (size_t i = 1; i <= n; i++) {
        int *now = row[i % 3], *old = row[(i + 2) % 3], *older = row[(i + 1) % 3];
        now[0] = (int)i;
        for (size_t j = 1; j <= m; j++) {
            int replaced = old[j - 1] + (fold(a[i - 1]) != fold(b[j - 1]));
            now[j] = min(replaced, min(old[j], now[j - 1]) + 1);
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                now[j] = min(now[j], older[j - 2] + 1);
        }
    }
    return row[n % 3][m];
}

/* Counts the letters with which both words begin. */
static int beginning(const char *a, const char *b)
{
    int n = 0;
    while (a[n] && fold(a[n]) == fold(b[n]))
        n++;
    return n;
}

const char *ff_nearest(const char *word, const char *const *candidates, size_t count)
{
    const char *best = NULL;
    /* up to one mistake per three letters is near; a two-letter word with a mistake is another
       word */
    size_t n = strlen(word);
    int near = n < 3 ? 0 : min((int)((n + 1) / 3), 4), shared = -1, least = NEVER;
    for (size_t i = 0; i < count; i++) {
        int mistakes = distance(word, candidates[i]), cost = mistakes;
        int same = beginning(word, candidates[i]);
        if (n >= 3 && (size_t)same == n)
            cost = min(cost, 1); /* the word is an abbreviation */
        if (same >= 3 && !candidates[i][same] && fold(word[same]) == '_')
            cost = min(cost, 2); /* a part such as "_mean" is added to the candidate */
        if (cost > near || (cost == near && same < shared))
            continue;
        if (cost < near || same > shared || mistakes < least) {
            best = candidates[i];
            near = cost;
            shared = same;
            least = mistakes;
        }
    }
    return best;
}
