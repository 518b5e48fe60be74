/* SPDX-License-Identifier: GPL-3.0-or-later */
/* An oil with given properties, with which a law is compared. */
#ifndef LAW_DATA_H
#define LAW_DATA_H

#include <flankfilm/conformance.h>
#include <flankfilm/laws.h>

#include <stdbool.h>

/* ln eta0 = ln 0.08 - 0.03 (T - 313.15 K), rho0 = 870 (1 - 7e-4 (T - 313.15 K)) kg/m3, pressure
   coefficient 20 (1 - 0.002 (T - 313.15 K)) 1/GPa. */
extern const ff_liquid conformance_oil;

/* Returns a property of that oil. */
double conformance_oil_at(int32_t property, double T);

/* Opens an instance, and returns the table of the first output with the interface id `service`. If
   there is none, reports this and returns NULL. */
const void *conformance_open_law(const ff_fixture *fixture, const char *service, void **instance);

/* The function `eval` of a law of p and T. */
typedef ff_status conformance_pT(const void *self, size_t n, const double *p, const double *T,
                                 double *value, double *by_p, double *by_T);
double conformance_law_at(conformance_pT *eval, const void *self, double p, const double *T,
                          double *by_p);

/* Checks a law to which an oil is wired: at ambient pressure it must equal the oil at each
   temperature, with the relative tolerance `within`, and from 0 to 1 GPa it must decrease with
   temperature. conformance_is_as_set checks a law without an oil: its value must be `value`, in SI,
   after the parameter `param` was set to `text`, such as "0.05 Pa s". */
bool conformance_is_oil(const ff_fixture *fixture, const char *service, int32_t property,
                        double within);
bool conformance_is_as_set(const ff_fixture *fixture, const char *service, const char *param,
                           const char *text, double value, double within);

#endif
