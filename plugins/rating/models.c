/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The ratings that this shared object exports. */
#include <flankfilm/author.h>

extern const ff_model rating_scuffing, rating_micropitting;
FF_EXPORT_MODELS(&rating_scuffing, &rating_micropitting);
