/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The times at which the driving flanks meet again after contact loss, and the speeds of
   approach. */
#ifndef DYNAMICS_LANDINGS_H
#define DYNAMICS_LANDINGS_H

#include "motion-view.h"

/* Writes two outputs: the times of the landings since the start of the motion that is shown, and
   the speeds of approach. Both are empty if contact is never lost. */
ff_status dynamics_landings_put(const dynamics_motion_view *view,
                                const dynamics_excitation *excitation, uint32_t time_output,
                                uint32_t speed_output, const ff_host *host);

#endif
