/* SPDX-License-Identifier: MIT */
/* Suggests a file name to replace a wrong one. */
#ifndef FE_SIMILAR_FILE_H
#define FE_SIMILAR_FILE_H

/* For a path that does not exist, returns 'did you mean "x"?', where x has the nearest name in the
   same directory. NULL: none is near. The caller frees it. */
char *fe_near_file(const char *path);

#endif
