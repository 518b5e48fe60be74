/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "orbit-film.h"

#include <math.h>
#include <string.h>

void dynamics_films_start(const dynamics_flow *flow, double T, dynamics_orbit *o)
{
    dynamics_films *films = &o->films;
    const double now[3] = {o->x[0], o->x[1], o->lambda};
    for (int f = 0; f < 2 && films->known; f++) {
        films->film[f] += films->step[f];
        for (int k = 0; k < 3; k++)
            films->film[f] += films->by[f][k] * (now[k] - films->at[k]);
    }
    dynamics_flow_films(flow, T, o->x, films->known, films->film);
    films->known = 1;
    memcpy(films->at, now, sizeof now);
}

void dynamics_films_monodromy(const dynamics_state *y, double m[4][4])
{
    for (int c = 0; c < 4; c++) {
        m[0][c] = c < 2 ? y->m[c] : y->oil.by[c - 2];
        m[1][c] = c < 2 ? y->m[2 + c] : y->oil.by[c];
        m[2][c] = y->oil.m[0][c];
        m[3][c] = y->oil.m[1][c];
    }
}

/* Eliminates the changes dy of both flanks' oil films y (orbit.h) by (1 - M_yy) dy = r_y + M_yx dx
   + slope dlambda. M_yx and M_yy are blocks of the monodromy in x = (delta, rate) and y, r_y is the
   residual of the films, and lambda gives the speed. */
void dynamics_films_eliminate(const dynamics_state *y, double T, dynamics_orbit *o)
{
    dynamics_films *films = &o->films;
    dynamics_films_monodromy(y, films->m);
    double(*m)[4] = films->m, side[4][2]; /* right-hand sides for the films: r_y, and the
                                             derivatives with respect to delta, rate and lambda */
    double a = 1 - m[2][2], b = -m[2][3], c = -m[3][2], d = 1 - m[3][3], det = a * d - b * c;
    films->miss = 0;
    for (int f = 0; f < 2; f++) {
        side[0][f] = y->oil.film[f] - films->film[f];
        side[1][f] = m[2 + f][0];
        side[2][f] = m[2 + f][1];
        side[3][f] = -T * y->oil.change[f];
        films->miss = fmax(films->miss, fabs(side[0][f]));
    }
    for (int k = 0; k < 4; k++) {
        double one = (d * side[k][0] - b * side[k][1]) / det,
               two = (a * side[k][1] - c * side[k][0]) / det;
        side[k][0] = isfinite(one) ? one : 0;
        side[k][1] = isfinite(two) ? two : 0;
    }
    for (int f = 0; f < 2; f++) {
        films->step[f] = side[0][f];
        for (int k = 0; k < 3; k++)
            films->by[f][k] = side[k + 1][f];
    }
    for (int i = 0; i < 2; i++) {
        for (int k = 0; k < 2; k++)
            o->m[2 * i + k] += m[i][2] * side[k + 1][0] + m[i][3] * side[k + 1][1];
        o->end[i] += m[i][2] * side[0][0] + m[i][3] * side[0][1];
        o->slope[i] += m[i][2] * side[3][0] + m[i][3] * side[3][1];
    }
    o->det = o->m[0] * o->m[3] - o->m[1] * o->m[2];
}

double dynamics_films_test(const dynamics_orbit *o, double sign)
{
    double a[4][4], det = 1;
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++)
            a[i][j] = (i == j) - sign * o->films.m[i][j];
    for (int i = 0; i < 4; i++) {
        int best = i;
        for (int k = i + 1; k < 4; k++)
            if (fabs(a[k][i]) > fabs(a[best][i]))
                best = k;
        for (int j = 0; j < 4 && best != i; j++) {
            double t = a[i][j];
            a[i][j] = a[best][j], a[best][j] = t;
        }
        det *= best != i ? -a[i][i] : a[i][i];
        for (int k = i + 1; k < 4 && a[i][i] != 0; k++)
            for (int j = 3; j >= i; j--)
                a[k][j] -= a[k][i] / a[i][i] * a[i][j];
    }
    return det;
}
