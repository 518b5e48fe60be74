/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Finds out which of several plugins wrote outside its memory. If a law writes past the arrays that
 * a stage passes to it, the stage crashes, and the sentence that reports the crash names both
 * plugins.
 */
#ifndef CRASH_SUSPECT_H
#define CRASH_SUSPECT_H

#include <stddef.h>

/* If the sentence names plugins that serve a stage, runs `flankfilm verify` for each of them in a
   separate process to test whether it writes outside its arrays, and adds the result to the
   sentence. Called in the leading process after the working process has ended. Takes at most 2 s
   per plugin. */
void crash_add_suspect(char *sentence, size_t size);

#endif
