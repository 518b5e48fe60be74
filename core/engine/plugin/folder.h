/* SPDX-License-Identifier: MIT */
/* The working directory, which a plugin must not change. */
#ifndef FE_FOLDER_H
#define FE_FOLDER_H

#include <limits.h>
#include <stdbool.h>

typedef struct fe_folder {
    char path[PATH_MAX]; /* "" if unknown */
} fe_folder;

void fe_folder_keep(fe_folder *folder);
/* Returns to the saved working directory; true if it had been left. */
bool fe_folder_restore(const fe_folder *folder);

#endif
