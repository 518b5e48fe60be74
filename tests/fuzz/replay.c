/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Gives the files of the directories in argv to a fuzz target, without libFuzzer. */
#include "fuzz.h"

#include <glob.h>

static size_t replay(const char *path)
{
    static uint8_t data[1 << 20];
    FILE *file = fopen(path, "rb");
    if (!file)
        return 0;
    size_t size = fread(data, 1, sizeof data, file);
    fclose(file);
    fprintf(stderr, "%s\n", path); /* the last one named is the one that crashed */
    LLVMFuzzerTestOneInput(data, size);
    return 1;
}

int main(int argc, char **argv)
{
    size_t count = 0;
    for (int i = 1; i < argc; i++) {
        char pattern[4096];
        glob_t files;
        snprintf(pattern, sizeof pattern, "%s/*", argv[i]);
        if (glob(pattern, 0, NULL, &files) == 0) {
            for (size_t k = 0; k < files.gl_pathc; k++)
                count += replay(files.gl_pathv[k]);
            globfree(&files);
        }
    }
    LLVMFuzzerTestOneInput(NULL, 0);
    printf("%zu inputs\n", count);
    return count == 0;
}
