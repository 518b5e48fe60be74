/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * What was made of the results in a directory, such as its page: ".flankfilm-made" lists it, so
 * that it goes when the results do. A file that was changed since is somebody's own, and stays.
 */
#ifndef RESULTS_MADE_H
#define RESULTS_MADE_H

/* Notes that `written`, which is there, is about to become `path`, when that is in the directory.
 */
void results_made_note(const char *directory, const char *path, const char *written);
/* Removes what is noted and returns its names, "report.html, results.nc", to be freed. */
char *results_made_remove(const char *directory);

#endif
