/* SPDX-License-Identifier: MIT */
#include "folder.h"

#include <string.h>
#include <unistd.h>

void fe_folder_keep(fe_folder *folder)
{
    if (!getcwd(folder->path, sizeof folder->path))
        folder->path[0] = 0;
}

bool fe_folder_restore(const fe_folder *folder)
{
    fe_folder now;
    fe_folder_keep(&now);
    return folder->path[0] && strcmp(now.path, folder->path) != 0 && chdir(folder->path) == 0;
}
