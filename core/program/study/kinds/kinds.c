/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The list of the kinds of studies whose later cases depend on results of earlier ones. */
#include "answer/kind.h"

extern const study_kind study_stability_kind, study_tradeoff_kind, study_uncertainty_kind;

const study_kind *const study_kinds[] = {&study_stability_kind, &study_tradeoff_kind,
                                         &study_uncertainty_kind, NULL};
