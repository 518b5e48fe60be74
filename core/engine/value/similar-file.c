/* SPDX-License-Identifier: MIT */
#include "similar-file.h"

#include "memory.h"

#include <flankfilm/engine.h>

#include <dirent.h>
#include <stdlib.h>
#include <string.h>

char *fe_near_file(const char *path)
{
    const char *slash = strrchr(path, '/'), *word = slash ? slash + 1 : path;
    char *folder = slash ? fe_copy_text(path, (size_t)(slash + 1 - path)) : fe_copy_text(".", 1);
    struct dirent **entries;
    int count = scandir(folder, &entries, NULL, alphasort);
    fe_free(folder);
    if (count < 0)
        return NULL;
    const char *pair[2] = {NULL, NULL};
    for (int i = 0; i < count; i++) {
        pair[pair[0] != NULL] = entries[i]->d_name;
        pair[0] = ff_nearest(word, pair, pair[1] ? 2 : 1);
        pair[1] = NULL;
    }
    char *hint = pair[0] ? fe_print_text("did you mean \"%s\"?", pair[0]) : NULL;
    for (int i = 0; i < count; i++)
        free(entries[i]);
    free(entries);
    return hint;
}
