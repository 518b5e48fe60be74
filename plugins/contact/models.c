/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lists the contact models of this shared object. */
#include <flankfilm/author.h>

extern const ff_model contact_back_tooth_pair, contact_constant, contact_table, contact_tooth_pair;

FF_EXPORT_MODELS(&contact_constant, &contact_table, &contact_tooth_pair, &contact_back_tooth_pair);
