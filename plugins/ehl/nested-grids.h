/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The steady film by nested grids. The end of a film moves by few cells in a step of Newton's
 * method, so that it is found on a coarse grid first; each finer one begins with what the one
 * before has found.
 */
#ifndef EHL_NESTED_GRIDS_H
#define EHL_NESTED_GRIDS_H

#include "solver.h"

/* Fills `film` with the steady film of half the cells. FF_NOCONV: the grid of `s` is coarse itself,
   or none of the coarser ones has a solution. */
ff_status ehl_nested_film(ehl_solver *s, const ehl_step *step, const ehl_instant *at,
                          double modulus, double thinnest, ehl_film *film);

#endif
