/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The density laws that this shared object exports. */
#include <flankfilm/author.h>

extern const ff_model density_incompressible, density_dowson_higginson, density_tait;

FF_EXPORT_MODELS(&density_incompressible, &density_dowson_higginson, &density_tait);
