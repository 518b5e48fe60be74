/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Files derived from the results in a directory, such as the page. ".flankfilm-made" lists them, so
 * that they are removed together with the results. A file that the user has changed since is kept.
 */
#ifndef RESULTS_DERIVED_FILES_H
#define RESULTS_DERIVED_FILES_H

/* Records that the existing file `written` will be renamed to `path`, if that is in the directory.
 */
void results_made_note(const char *directory, const char *path, const char *written);
/* Removes the recorded files and returns their names, "report.html, results.nc", to be freed. */
char *results_made_remove(const char *directory);

#endif
