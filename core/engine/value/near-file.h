/* SPDX-License-Identifier: MIT */
#ifndef FE_NEAR_FILE_H
#define FE_NEAR_FILE_H

/* 'did you mean "x"?' of a path where no file is: x lies in the same folder and has the nearest
   name. The caller frees it; NULL: none is near. */
char *fe_near_file(const char *path);

#endif
