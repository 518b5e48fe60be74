/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The film while the contact is lost. */
#ifndef EHL_CONTACT_LOSS_H
#define EHL_CONTACT_LOSS_H

#include "../equations/march.h"

/* Solves it while the contact is lost: chooses between the prescribed gap and a balance of
   forces. */
ff_status ehl_solve_contact_loss(ehl_march *m, ehl_step *step, const ehl_instant *at);

/* Used if not even the shortest step to `at` converges: while the contact is lost the film then
 * follows the prescribed gap without pressure. FF_OK, or FF_NOCONV with `why`. */
ff_status ehl_march_without_load(ehl_march *m, const ehl_instant *at);

#endif
