/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Estimates the film that is missing because the domain ends upstream of the contact. */
#ifndef EHL_STARVATION_H
#define EHL_STARVATION_H

#include "history.h"
#include "reynolds.h"

/*
 * Share of the film that a domain from x = -end on leaves out of that of an inlet without end, by
 * the Reynolds equation in front of the domain; h is the central film. 1 where the domain begins in
 * the contact. The load and the radius of `at` are > 0.
 */
double ehl_starvation(const ehl_reynolds *eq, const ehl_instant *at, double modulus, double h,
                      double end);

#endif
