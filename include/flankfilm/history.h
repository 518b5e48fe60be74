/* SPDX-License-Identifier: MIT */
/*
 * One history at the instants of another; header only, C99 and C++.
 *
 * A stage that takes a film and its contact has two histories of different lengths, since names of
 * dimensions belong to a wire: "ehl.t" has the steps of the film, "contact.t" the instants of the
 * load. ff_history_at gives the one at the instants of the other.
 */
#ifndef FLANKFILM_HISTORY_H
#define FLANKFILM_HISTORY_H

#include <flankfilm/plugin.h>

#ifdef __cplusplus
extern "C" {
#endif

/*
 * Fills in `out` with the history `y` over the instants `t`, `n` of them, at the `m` instants `at`,
 * linear in between. Neither may decrease. At an instant of both the value is that of `y`, to the
 * last bit. An instant that stands twice is a jump, where a further pair of teeth begins: the first
 * takes what is before it and the last what is after it, on both sides; a single one takes what is
 * after it.
 *
 * FF_OK; FF_DOMAIN: some instants lie outside of `t`, and have the value of the nearer end there;
 * FF_INVALID: nothing was filled in, since n is 0 while m is not, or instants decrease or are NaN.
 */
static inline ff_status ff_history_at(size_t n, const double *t, const double *y, size_t m,
                                      const double *at, double *out)
{
    ff_status status = FF_OK;
    size_t i, k = 0;
    if (m > 0 && n == 0)
        return FF_INVALID;
    for (i = 0; i < n; i++)
        if (!(t[i] - t[i] == 0) || (i > 0 && !(t[i - 1] <= t[i])))
            return FF_INVALID;
    for (i = 0; i < m; i++)
        if (!(at[i] - at[i] == 0) || (i > 0 && !(at[i - 1] <= at[i])))
            return FF_INVALID;
    for (i = 0; i < m; i++) {
        const int before = i + 1 < m && at[i + 1] == at[i]; /* a jump begins here */
        while (k < n && (t[k] < at[i] || (!before && k + 1 < n && t[k + 1] == at[i])))
            k++; /* the first instant that is not before, or the last of equal ones */
        if (k == n || (k == 0 && t[0] > at[i])) {
            out[i] = y[k == n ? n - 1 : 0];
            status = FF_DOMAIN;
        } else if (t[k] == at[i]) {
            out[i] = y[k];
        } else {
            const double share = (at[i] - t[k - 1]) / (t[k] - t[k - 1]);
            out[i] = (1 - share) * y[k - 1] + share * y[k];
        }
    }
    return status;
}

#ifdef __cplusplus
}
#endif
#endif
