/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The fault FAULT, and the entry of a plugin. No header is read: there are many of these. */
struct ff_model;
extern const char false_fault[];
const char false_fault[] = FAULT;

const struct ff_model *false_law(void);
__attribute__((visibility("default"))) const struct ff_model *flankfilm_model_v1(void);

const struct ff_model *flankfilm_model_v1(void)
{
    return false_law();
}
