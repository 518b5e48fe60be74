/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The fault FAULT, and the function ENTRY that a plugin exports. No header is read: there are many
   of these. */
#define EXPORT __attribute__((visibility("default")))

struct ff_model;
extern const char faulty_fault[];
const char faulty_fault[] = FAULT;

const struct ff_model *faulty_model(void);

#ifdef MISSING_FUNCTION
int a_function_that_nobody_has(void);
#endif

EXPORT const struct ff_model *ENTRY(void);

const struct ff_model *ENTRY(void)
{
#ifdef MISSING_FUNCTION
    a_function_that_nobody_has();
#endif
    return faulty_model();
}

#ifdef LIST
const struct ff_model *const *faulty_models(void);
EXPORT const struct ff_model *const *flankfilm_models_v1(void);

const struct ff_model *const *flankfilm_models_v1(void)
{
    return faulty_models();
}
#endif
