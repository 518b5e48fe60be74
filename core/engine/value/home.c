/* SPDX-License-Identifier: MIT */
#include "home.h"

#include "memory.h"

#include <dlfcn.h>
#include <link.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* The longest path that realpath writes on Linux. */
enum { LONGEST_PATH = 4096 };

/* Writes the directory of the file that contains this code; false: unknown. */
static bool find_folder(char folder[LONGEST_PATH])
{
    static const char here = 0;
    Dl_info about;
    struct link_map *object = NULL;
    dladdr1(&here, &about, (void **)&object, RTLD_DL_LINKMAP);
    /* the program itself has no name in the list of loaded objects */
    const char *file = object && object->l_name[0] ? object->l_name : "/proc/self/exe";
    char *slash = realpath(file, folder) ? strrchr(folder, '/') : NULL;
    if (slash)
        *slash = 0;
    return slash;
}

static char *find(const char *folder, const char *up, const char *path)
{
    char whole[LONGEST_PATH];
    char *name = fe_print_text("%s/%s%s", folder, up, path);
    bool there = realpath(name, whole);
    fe_free(name);
    return there ? fe_copy_text(whole, strlen(whole)) : NULL;
}

char *fe_installed_file(const char *path)
{
    char folder[LONGEST_PATH];
    if (!find_folder(folder))
        return NULL;
    char *file = find(folder, "../", path); /* starting from the program's directory, bin */
    return file ? file : find(folder, FE_UP_FROM_LIBRARY, path);
}

static bool is_there(const char *folder, const char *name)
{
    char *path = fe_print_text("%s/%s", folder, name);
    bool there = access(path, F_OK) == 0;
    fe_free(path);
    return there;
}

/* Looks in the build tree: the folder of this code, or a parent directory with a build file. */
char *fe_built_file(const char *path)
{
    char folder[LONGEST_PATH];
    bool known = find_folder(folder);
    for (int up = 0; known && up < 4; up++) {
        if (is_there(folder, "plugins/.") && (up == 0 || is_there(folder, "build.ninja")))
            return find(folder, "", path);
        char *slash = strrchr(folder, '/');
        if (!slash)
            return NULL;
        known = slash != folder;
        *slash = 0;
    }
    return NULL;
}
