/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lists the rheology laws of this shared object. */
#include <flankfilm/author.h>

extern const ff_model rheology_newtonian, rheology_ree_eyring, rheology_carreau;

FF_EXPORT_MODELS(&rheology_newtonian, &rheology_ree_eyring, &rheology_carreau);
