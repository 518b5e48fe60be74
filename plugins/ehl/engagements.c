/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "engagements.h"

#include <math.h>

void ehl_lowest_add(ehl_lowest *l, double engagement, double h_min)
{
    if (l->count > 0 && engagement == l->number) {
        l->here = fmin(l->here, h_min);
        return;
    }
    l->sum += l->here;
    l->least = l->count > 1 ? fmin(l->least, l->here) : l->here;
    l->most = l->count > 1 ? fmax(l->most, l->here) : l->here;
    l->number = engagement;
    l->here = h_min;
    l->count++;
}

double ehl_lowest_mean(const ehl_lowest *l)
{
    return l->count > 0 ? (l->sum + l->here) / l->count : 0;
}

double ehl_lowest_spread(const ehl_lowest *l)
{
    return l->count > 1 ? fmax(l->most, l->here) - fmin(l->least, l->here) : 0;
}
