/* SPDX-License-Identifier: MIT */
/*
 * Interpolates a history at the instants of another one; header only, C99 and C++.
 *
 * A stage that takes a film and its contact has two histories of different lengths, since dimension
 * names belong to a wire: "ehl.t" has the steps of the film, "contact.t" the instants of the load.
 * ff_history_at interpolates one history at the instants of the other.
 */
#ifndef FLANKFILM_HISTORY_H
#define FLANKFILM_HISTORY_H

#include <flankfilm/plugin.h>

#ifdef __cplusplus
extern "C" {
#endif

/*
 * Interpolates the history `y` at n instants `t` linearly at the m instants `at`, and writes the
 * result to `out`. Neither `t` nor `at` may decrease. At an instant that is in both, `out` equals
 * `y` bitwise. A repeated instant is a jump, where another pair of teeth enters contact. For an
 * instant that is repeated in `t` and in `at`, the first `out` is the value before the jump and the
 * last `out` the value after it. For an instant that is repeated in `t` only, `out` is the value
 * after the jump.
 *
 * FF_OK; FF_DOMAIN: some instants lie outside of `t` and have the value of the nearer end;
 * FF_INVALID: nothing was written, because n is 0 but m is not, or because instants decrease or are
 * NaN.
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
        /* `at` has a jump here, and i is its first instant */
        const int before = i + 1 < m && at[i + 1] == at[i];
        while (k < n && (t[k] < at[i] || (!before && k + 1 < n && t[k + 1] == at[i])))
            k++; /* now k is the first instant >= at[i], or the last of several equal ones */
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
