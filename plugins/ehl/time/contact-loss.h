/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The film while the contact is lost. */
#ifndef EHL_CONTACT_LOSS_H
#define EHL_CONTACT_LOSS_H

#include "../equations/march.h"

/* Solves for the film while the contact is lost. It selects either the prescribed gap or a balance
   of forces. */
ff_status ehl_solve_contact_loss(ehl_march *m, ehl_step *step, const ehl_instant *at);

/* Advances without pressure, with the flanks at the prescribed gap, while the contact is lost. It
   is used if not even the shortest step to `at` converges. Returns FF_OK, or FF_NOCONV with the
   reason in `why`. */
ff_status ehl_march_without_load(ehl_march *m, const ehl_instant *at);

#endif
