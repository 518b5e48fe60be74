/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Which of several plugins overran memory. A law that writes past the arrays it was given ends the
 * stage that gave them, and in the sentence both are named.
 */
#ifndef CRASH_SUSPECT_H
#define CRASH_SUSPECT_H

#include <stddef.h>

/* Where the sentence names plugins that serve a stage, has `flankfilm verify` test in processes of
   their own whether each keeps to its arrays, and adds what came of it. Called in the leading
   process, after the working one has ended; takes 2 s for each plugin at most. */
void crash_add_suspect(char *sentence, size_t size);

#endif
