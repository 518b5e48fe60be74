/* SPDX-License-Identifier: MIT */
/* Finds files that came with the engine, relative to the file that contains this code: the library,
   or a program into which it is linked. */
#ifndef FE_HOME_H
#define FE_HOME_H

/* Both functions return the real path, which the caller frees, or NULL if there is no such file. */

/* Looks in the installed tree, which may have been moved: "share/flankfilm/configs/x.yaml". */
char *fe_installed_file(const char *path);
/* Looks in the build tree: "plugins". */
char *fe_built_file(const char *path);

#endif
