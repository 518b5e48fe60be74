/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lists the density laws of this shared object. */
#include <flankfilm/author.h>

extern const ff_model density_incompressible, density_dowson_higginson, density_tait;

FF_EXPORT_MODELS(&density_incompressible, &density_dowson_higginson, &density_tait);
