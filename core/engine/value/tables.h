/* SPDX-License-Identifier: MIT */
#ifndef FE_TABLES_H
#define FE_TABLES_H

#include <flankfilm/engine.h>

void fe_tables_forget(ff_tables *tables); /* the errors */

#endif
