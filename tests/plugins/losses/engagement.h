/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A pair of 50 and 80 teeth under constant load and friction, with losses in closed form. */
#ifndef TEST_ENGAGEMENT_H
#define TEST_ENGAGEMENT_H

#include <stage.h>

#include <stddef.h>

enum { INSTANTS = 2001, TEETH = 50, TEETH_2 = 80 };

typedef struct engagement {
    double contact_ratio, base_radius, omega, load, friction, face_width, modulus, torque;
    double roll[INSTANTS], power[INSTANTS], traction[INSTANTS], coefficient[INSTANTS];
    double radius_1[INSTANTS], radius_2[INSTANTS]; /* the instants are the stations of the gear */
    double none[INSTANTS];
} engagement;

void engagement_fill(engagement *e, double contact_ratio);
/* Opens losses/tooth-mesh with these inputs. */
stage *engagement_open(const engagement *e);

/* Returns the sliding speed at SAP and tip. */
double engagement_sliding(const engagement *e);
/* Returns the loss of one pair, W, `pitches` base pitches after SAP. */
double engagement_loss(const engagement *e, double pitches);

#endif
