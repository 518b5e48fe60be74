/* SPDX-License-Identifier: MIT */
/* Suggests a file name in place of a wrong one. */
#ifndef FE_NEAR_FILE_H
#define FE_NEAR_FILE_H

/* Returns 'did you mean "x"?' for a path that does not exist, where x has the nearest name in
 * the same folder. NULL: none is near. The caller frees it. */
char *fe_near_file(const char *path);

#endif
