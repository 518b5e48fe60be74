/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef FAULTY_H
#define FAULTY_H

#include <flankfilm/author.h>

extern const char faulty_fault[];

const ff_model *faulty_model(void);
const ff_model *const *faulty_models(void);

#endif
