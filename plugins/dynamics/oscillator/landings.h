/* SPDX-License-Identifier: GPL-3.0-or-later */
/* When, and how fast, the driving flanks meet again after they have parted. */
#ifndef DYNAMICS_LANDINGS_H
#define DYNAMICS_LANDINGS_H

#include "motion-view.h"

/* Gives the times of the landings of the motion that is shown, since its start, and the speeds of
   approach there, as series of those two outputs; they are empty where no flanks part. */
ff_status dynamics_landings_put(const dynamics_motion_view *view,
                                const dynamics_excitation *excitation, uint32_t time_output,
                                uint32_t speed_output, const ff_host *host);

#endif
