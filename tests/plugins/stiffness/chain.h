/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Connected stages: a gear pair, its operating point and a stiffness model. */
#ifndef TEST_STIFFNESS_CHAIN_H
#define TEST_STIFFNESS_CHAIN_H

#include "stage.h"

typedef struct chain {
    stage *gear, *duty, *mesh;
} chain;

/* Opens the 50/50 pair of Li & Kahraman 2011 (module 3 mm, width 20 mm, backlash 0.14 mm, standard
   root) at a torque, with a stiffness model. */
chain chain_open(const char *model, const char *torque);
void chain_close(chain *c);

/* Runs the model; ends the program if it fails. */
void chain_run(chain *c);
double chain_mean(chain *c);

/* Returns the first station at the roll angle of an output of the gear, such as "roll_hpstc". */
size_t chain_station(const chain *c, const char *point);

/* Opens, sets one parameter of the gear or the mesh ("mesh.plane", "gear.bore_diameter"), runs. */
chain chain_with(const char *model, const char *torque, const char *param, const char *value);

#endif
