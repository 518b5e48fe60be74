/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Libraries that ask for memory until they get it: under a limit of the address space OpenBLAS
 * never returns. The program defines mmap() itself, which does what libc's does and counts
 * failures.
 */
#ifndef CRASH_HUNGER_H
#define CRASH_HUNGER_H

#include <stddef.h>

/* `starve` is called with the size when the same size was refused a thousand times in a row; when
   it returns, the library goes on asking. */
void crash_hunger_watch(void (*starve)(size_t bytes));

#endif
