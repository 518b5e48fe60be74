/* SPDX-License-Identifier: MIT */
/* Finds what came with the engine, from the file that holds this code: the library, or a program
   that it was linked into. */
#ifndef FE_HOME_H
#define FE_HOME_H

/* Both return the real path, which the caller frees, or NULL when there is no such file. */

/* In the installed tree, also after that was moved: "share/flankfilm/configs/x.yaml". */
char *fe_installed_file(const char *path);
/* In the build tree: "plugins". */
char *fe_built_file(const char *path);

#endif
