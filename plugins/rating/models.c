/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lists the ratings of this shared object. */
#include <flankfilm/author.h>

extern const ff_model rating_scuffing, rating_micropitting;
FF_EXPORT_MODELS(&rating_scuffing, &rating_micropitting);
