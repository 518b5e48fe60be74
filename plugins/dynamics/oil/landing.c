/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "landing.h"

#include <math.h>
#include <string.h>

enum { S = DYNAMICS_STAGES, MOST = 2 * S, ITERATIONS = 25 };

/* Bounds on the last coefficients of the series, relative to the film or to the speed. The error at
   the end of a step is about the square of these. */
static const double allowed = 1e-10;

/* A step that ends in a node uses the film just before the node, at this distance (mesh cycles). */
static const double before_node = 1e-12;

static double lagrange(const double *node, int count, int j, double x)
{
    double value = 1;
    for (int k = 0; k < count; k++)
        if (k != j)
            value *= (x - node[k]) / (node[j] - node[k]);
    return value;
}

/* Computes the Radau nodes: the roots of P_s - P_(s-1) with Legendre polynomials on [0, 1]. */
static double radau_function(double x)
{
    double y = 2 * x - 1, p = 1, q = y;
    for (int n = 1; n < S; n++) {
        double next = ((2 * n + 1) * y * q - n * p) / (n + 1);
        p = q;
        q = next;
    }
    return q - p;
}

static void find_nodes(double *node)
{
    int found = 0;
    node[S - 1] = 1;
    for (int i = 0; i < 1000 && found < S - 1; i++) {
        double low = i / 1001., high = (i + 1) / 1001., sign = radau_function(low);
        if (sign * radau_function(high) > 0)
            continue;
        while (high - low > 1e-17 + 2e-16 * low) {
            double middle = 0.5 * (low + high);
            if (middle <= low || middle >= high)
                break;
            *(sign * radau_function(middle) > 0 ? &low : &high) = middle;
        }
        node[found++] = low;
    }
}

/* Computes the Lagrange polynomial of node j, as powers of x: the product of (x - node[k]) over k
   other than j, divided by its value at node[j]. */
static void basis_powers(const double *node, int j, double *power)
{
    memset(power, 0, DYNAMICS_NODES * sizeof *power);
    power[0] = 1;
    for (int k = 0, degree = 0; k < DYNAMICS_NODES; k++) {
        if (k == j)
            continue;
        double share = 1 / (node[j] - node[k]);
        for (int n = ++degree; n >= 0; n--)
            power[n] = ((n ? power[n - 1] : 0) - node[k] * power[n]) * share;
    }
}

void dynamics_radau_init(dynamics_radau *r)
{
    /* Gauss-Legendre with 4 points, exact to degree 7 (Abramowitz & Stegun 1964, table 25.4) */
    static const double point[] = {-0.8611363115940526, -0.3399810435848563, 0.3399810435848563,
                                   0.8611363115940526};
    static const double weight[] = {0.3478548451374538, 0.6521451548625461, 0.6521451548625461,
                                    0.3478548451374538};
    double all[DYNAMICS_NODES] = {0};
    find_nodes(r->node);
    memcpy(all + 1, r->node, sizeof r->node);
    for (int i = 0; i < S; i++)
        for (int j = 0; j < S; j++) {
            r->a[i][j] = 0;
            for (int g = 0; g < 4; g++)
                r->a[i][j] += 0.5 * r->node[i] * weight[g] *
                              lagrange(r->node, S, j, 0.5 * r->node[i] * (1 + point[g]));
        }
    for (int i = 0; i < S; i++)
        for (int j = 0; j < S; j++) {
            r->square[i][j] = 0;
            for (int l = 0; l < S; l++)
                r->square[i][j] += r->a[i][l] * r->a[l][j];
        }
    for (int j = 0; j < DYNAMICS_NODES; j++)
        basis_powers(all, j, r->power[j]);
}

void dynamics_landing_polynomial(const dynamics_radau *r, const double *value, double *power)
{
    for (int n = 0; n < DYNAMICS_NODES; n++)
        power[n] = 0;
    for (int j = 0; j < DYNAMICS_NODES; j++)
        for (int n = 0; n < DYNAMICS_NODES; n++)
            power[n] += value[j] * r->power[j][n];
}

/* Solves n equations with `columns` right-hand sides in place, by Gaussian elimination with
   pivoting. Returns 0 if the matrix is singular. GSL is slower for so few equations:
   light-load.yaml with squeeze: series takes 3.0e9 instructions with this function and 8.8e9 with
   GSL. */
static int eliminate(int n, double m[MOST][MOST], int columns,
                     double side[DYNAMICS_FILM_COLUMNS][MOST])
{
    for (int i = 0; i < n; i++) {
        int best = i;
        for (int k = i + 1; k < n; k++)
            if (fabs(m[k][i]) > fabs(m[best][i]))
                best = k;
        if (!(fabs(m[best][i]) > 0))
            return 0;
        for (int j = i; best != i && j < n; j++) {
            double t = m[i][j];
            m[i][j] = m[best][j], m[best][j] = t;
        }
        for (int c = 0; best != i && c < columns; c++) {
            double t = side[c][i];
            side[c][i] = side[c][best], side[c][best] = t;
        }
        for (int k = i + 1; k < n; k++) {
            double f = m[k][i] / m[i][i];
            for (int j = i + 1; j < n; j++)
                m[k][j] -= f * m[i][j];
            for (int c = 0; c < columns; c++)
                side[c][k] -= f * side[c][i];
        }
    }
    for (int c = 0; c < columns; c++)
        for (int i = n; i-- > 0;) {
            for (int j = i + 1; j < n; j++)
                side[c][i] -= m[i][j] * side[c][j];
            side[c][i] /= m[i][i];
        }
    return 1;
}

/* Quantities that are constant while a step is solved. */
typedef struct stages {
    const dynamics_radau *r;
    double h, c, load[S], bend[S], k[S]; /* load: load minus drag minus e'' at each stage; bend:
                                            e'' */
    double thicken[S];                   /* growth rate of the loaded film; the damper acts on
                                            the rate of delta minus this rate */
    int count, flank[2];                 /* number and flanks of the films that carry load */
    dynamics_film_place place[S];
    double (*inverse)[S];
    double yield[S][S]; /* derivatives of delta at the stages with respect to the force at the
                           stages */
} stages;

static double sign_of(int flank)
{
    return flank ? -1 : 1;
}

/* Inverts the system of the stages for the accelerations a: a = load - c v - sum s k (s delta - b +
   y), with v = v0 + h A a and delta = delta0 + h c v0 + h^2 A^2 a. */
static int prepare(const dynamics_radau *r, dynamics_landing *step, stages *g)
{
    const dynamics_excitation *x = step->excitation;
    double m[MOST][MOST], side[DYNAMICS_FILM_COLUMNS][MOST];
    *g = (stages){
        .r = r, .h = (step->end - step->at) * step->T, .c = 2 * x->zeta, .inverse = step->inverse};
    for (int f = 0; f < 2; f++)
        if (step->open[f])
            g->flank[g->count++] = f;
    for (int i = 0; i < S; i++) {
        double phase = step->at + r->node[i] * (step->end - step->at);
        g->k[i] =
            dynamics_piece_value(step->piece->k, step->piece->degree, phase - step->piece->start);
        g->bend[i] =
            dynamics_piece_bend(step->piece->e, step->piece->degree, phase - step->piece->start) /
            (step->T * step->T);
        g->load[i] = x->load - g->bend[i];
        if (x->drags) {
            double since = phase - step->piece->start;
            g->thicken[i] =
                dynamics_piece_slope(step->piece->film, step->piece->degree, since) / step->T;
            g->load[i] += g->c * g->thicken[i] -
                          dynamics_piece_value(step->piece->drag, step->piece->degree, since);
        }
        g->place[i] = dynamics_film_at(x->film, fmin(phase, step->end - before_node), step->T);
    }
    for (int first = 0; first < S; first += DYNAMICS_FILM_COLUMNS) {
        int columns = S - first < DYNAMICS_FILM_COLUMNS ? S - first : DYNAMICS_FILM_COLUMNS;
        for (int i = 0; i < S; i++)
            for (int j = 0; j < S; j++)
                m[i][j] = (i == j) + g->c * g->h * r->a[i][j] +
                          g->count * g->k[i] * g->h * g->h * r->square[i][j];
        for (int c = 0; c < columns; c++)
            for (int i = 0; i < S; i++)
                side[c][i] = i == first + c;
        if (!eliminate(S, m, columns, side))
            return 0;
        for (int c = 0; c < columns; c++)
            for (int i = 0; i < S; i++)
                g->inverse[i][first + c] = side[c][i];
    }
    for (int i = 0; i < S; i++)
        for (int j = 0; j < S; j++) {
            g->yield[i][j] = 0;
            for (int l = 0; l < S; l++)
                g->yield[i][j] += g->h * g->h * r->square[i][l] * g->inverse[l][j];
        }
    return 1;
}

static void accelerate(const stages *g, const double *force, double *a)
{
    for (int i = 0; i < S; i++) {
        a[i] = 0;
        for (int j = 0; j < S; j++)
            a[i] += g->inverse[i][j] * force[j];
    }
}

/* Computes the motion at the stages for given films y. */
static void move_stages(const stages *g, dynamics_landing *step, double y[2][S])
{
    double force[S], a[S], v0 = step->rate[0], half_gap = step->excitation->half_gap;
    for (int i = 0; i < S; i++) {
        force[i] = g->load[i] - g->c * v0;
        for (int n = 0; n < g->count; n++) {
            double s = sign_of(g->flank[n]);
            double q = s * (step->delta[0] + g->h * g->r->node[i] * v0) - half_gap;
            force[i] -= s * g->k[i] * (q + y[g->flank[n]][i]);
        }
    }
    accelerate(g, force, a);
    for (int i = 0; i < S; i++) {
        double v = v0, d = step->delta[0] + g->h * g->r->node[i] * v0;
        for (int j = 0; j < S; j++) {
            v += g->h * g->r->a[i][j] * a[j];
            d += g->h * g->h * g->r->square[i][j] * a[j];
        }
        step->rate[i + 1] = v;
        step->delta[i + 1] = d;
        step->force[i + 1] = 0;
        for (int f = 0; f < 2; f++) {
            double s = sign_of(f), q = s * d - half_gap;
            step->film[f][i + 1] = step->open[f] ? y[f][i] : -q;
            step->bend[f][i + 1] = step->open[f] ? q + y[f][i] : 0;
            step->force[i + 1] += s * g->k[i] * step->bend[f][i + 1];
        }
    }
}

static void find_approach(const stages *g, dynamics_landing *step)
{
    const dynamics_film *film = step->excitation->film;
    for (int n = 0; n < g->count; n++)
        for (int i = 0; i < S; i++) {
            int f = g->flank[n];
            double h = film->hand_over + step->film[f][i + 1];
            step->approach[f][i] =
                dynamics_film_approach(film, &g->place[i], g->k[i] * step->bend[f][i + 1],
                                       fmax(h, 0.01 * film->hand_over));
        }
}

/* Computes the derivative of the residual y - y0 + h A V with respect to the films at the
   stages. */
static void build_matrix(const stages *g, const dynamics_landing *step, double m[MOST][MOST])
{
    for (int n = 0; n < g->count; n++)
        for (int o = 0; o < g->count; o++) {
            double share = sign_of(g->flank[n]) * sign_of(g->flank[o]), v[S][S];
            const dynamics_approach *approach = step->approach[g->flank[n]];
            for (int l = 0; l < S; l++)
                for (int j = 0; j < S; j++) {
                    v[l][j] = -approach[l].by_load * g->k[l] * share * g->yield[l][j] * g->k[j];
                    if (l == j && n == o)
                        v[l][j] += approach[l].by_load * g->k[l] + approach[l].by_film;
                }
            for (int i = 0; i < S; i++)
                for (int j = 0; j < S; j++) {
                    double sum = i == j && n == o;
                    for (int l = 0; l < S; l++)
                        sum += g->h * g->r->a[i][l] * v[l][j];
                    m[n * S + i][o * S + j] = sum;
                }
        }
}

/* Computes the last two coefficients of a Legendre series on [0, 1], of degrees 7 and 6. The
   leading coefficients of these polynomials are 3432 and 924. */
static double last_coefficients(const dynamics_radau *r, const double *value)
{
    double p[DYNAMICS_NODES];
    dynamics_landing_polynomial(r, value, p);
    return fabs(p[7]) / 3432 + fabs(p[6] + 3.5 * p[7]) / 924;
}

static double find_doubt(const stages *g, const dynamics_landing *step)
{
    /* without a mean load the unit of force is the amplitude of the fluctuation */
    double unit = step->excitation->load > 0 ? step->excitation->load : 1;
    double least = INFINITY, doubt = 0;
    for (int i = 0; i < DYNAMICS_NODES; i++)
        unit = fmax(unit, fabs(step->rate[i]));
    doubt = last_coefficients(g->r, step->rate) / unit;
    for (int n = 0; n < g->count; n++) {
        const double *y = step->film[g->flank[n]];
        for (int i = 0; i < DYNAMICS_NODES; i++)
            least = fmin(least, step->excitation->film->hand_over + y[i]);
        least = fmax(least, 0.5 * step->excitation->film->hand_over);
        doubt = fmax(doubt, last_coefficients(g->r, y) / fmin(least, unit));
    }
    return doubt / allowed;
}

int dynamics_landing_solve(const dynamics_radau *r, dynamics_landing *step)
{
    stages g;
    double y[2][S], m[MOST][MOST], side[DYNAMICS_FILM_COLUMNS][MOST], last = INFINITY;
    double hand_over = step->excitation->film->hand_over;
    if (!prepare(r, step, &g))
        return 0;
    for (int n = 0; n < g.count; n++)
        for (int i = 0; i < S; i++) {
            int f = g.flank[n];
            double way = sign_of(f) * step->rate[0] * g.h * r->node[i];
            y[f][i] = fmax(step->film[f][0] - way, fmin(step->film[f][0], -0.5 * hand_over));
        }
    for (int i = 0;; i++) {
        move_stages(&g, step, y);
        if (g.count == 0)
            break;
        find_approach(&g, step);
        build_matrix(&g, step, m);
        double size = 0, moved = 0;
        for (int n = 0; n < g.count; n++)
            for (int k = 0; k < S; k++) {
                int f = g.flank[n];
                double sum = y[f][k] - step->film[f][0];
                for (int l = 0; l < S; l++)
                    sum += g.h * r->a[k][l] * step->approach[f][l].speed;
                side[0][n * S + k] = -sum;
                size = fmax(size, fabs(y[f][k]) + hand_over);
            }
        if (!eliminate(g.count * S, m, 1, side))
            return 0;
        for (int n = 0; n < g.count; n++)
            for (int k = 0; k < S; k++) {
                double *at = &y[g.flank[n]][k], to = *at + side[0][n * S + k];
                to = fmax(to, -hand_over + 0.2 * (*at + hand_over));
                moved = fmax(moved, fabs(to - *at));
                *at = to;
            }
        if (!isfinite(moved) || i == ITERATIONS)
            return 0;
        if (moved <= 1e-14 * size || (moved <= 1e-11 * size && moved >= 0.5 * last)) {
            move_stages(&g, step, y);
            find_approach(&g, step);
            break;
        }
        last = moved;
    }
    step->doubt = find_doubt(&g, step);
    return isfinite(step->delta[S]);
}

/* Derivatives at the stages with respect to a start value or to T. `stretch` is the derivative of
   the step's duration: with respect to T it is not 0, with respect to a start value it is 0. */
typedef struct variation {
    double stretch;
    double rate[S], delta[S]; /* at fixed films */
} variation;

/* Computes the derivatives of rate, delta and force with respect to T, at fixed acceleration. */
static void stretch_stages(const stages *g, const dynamics_landing *step, variation *v, double *f)
{
    double a[S];
    for (int i = 0; i < S; i++)
        a[i] = g->load[i] - g->c * step->rate[i + 1] - step->force[i + 1];
    for (int i = 0; i < S; i++) {
        double rate = 0, delta = g->r->node[i] * step->rate[0];
        for (int j = 0; j < S; j++) {
            rate += g->r->a[i][j] * a[j];
            delta += 2 * g->h * g->r->square[i][j] * a[j];
        }
        v->rate[i] += v->stretch * rate;
        v->delta[i] += v->stretch * delta;
        f[i] = (2 * g->bend[i] - g->c * g->thicken[i]) /
               step->T; /* at a fixed phase e'' is proportional to 1/T^2, and rates to 1/T */
    }
}

/* Computes the derivatives of the motion at the stages. `start` contains the derivatives of delta,
   its rate and the films at the start of the step. */
static void vary_motion(const stages *g, const dynamics_landing *step, const double *start,
                        variation *v)
{
    double f[S] = {0}, a[S];
    for (int i = 0; i < S; i++) {
        v->rate[i] = start[1];
        v->delta[i] = start[0] + g->h * g->r->node[i] * start[1];
    }
    if (v->stretch != 0)
        stretch_stages(g, step, v, f);
    for (int i = 0; i < S; i++)
        f[i] += -g->c * v->rate[i] - g->count * g->k[i] * v->delta[i];
    accelerate(g, f, a);
    for (int i = 0; i < S; i++)
        for (int j = 0; j < S; j++) {
            v->rate[i] += g->h * g->r->a[i][j] * a[j];
            v->delta[i] += g->h * g->h * g->r->square[i][j] * a[j];
        }
}

/* Computes the right-hand side of the linear equations for the films. */
static void vary_films(const stages *g, const dynamics_landing *step, const double *start,
                       const variation *v, double *side)
{
    for (int n = 0; n < g->count; n++)
        for (int i = 0; i < S; i++) {
            const dynamics_approach *u = step->approach[g->flank[n]];
            double s = sign_of(g->flank[n]), sum = start[2 + g->flank[n]];
            for (int l = 0; l < S; l++) {
                sum -= g->h * g->r->a[i][l] * (u[l].by_load * g->k[l] * s * v->delta[l]);
                if (v->stretch != 0)
                    sum -= g->r->a[i][l] *
                           (v->stretch * u[l].speed - g->h * u[l].by_entrainment / step->T);
            }
            side[n * S + i] = sum;
        }
}

/* Computes the derivatives at the end of the step from those of the films at the stages. */
static void vary_end(const stages *g, const variation *v, const double *film, double *end)
{
    double force[S] = {0}, a[S], delta = v->delta[S - 1], rate = v->rate[S - 1];
    for (int n = 0; n < g->count; n++)
        for (int i = 0; i < S; i++)
            force[i] -= sign_of(g->flank[n]) * g->k[i] * film[n * S + i];
    accelerate(g, force, a);
    for (int j = 0; j < S; j++) {
        rate += g->h * g->r->a[S - 1][j] * a[j];
        delta += g->h * g->h * g->r->square[S - 1][j] * a[j];
    }
    end[0] = delta;
    end[1] = rate;
    for (int f = 0; f < 2; f++)
        end[2 + f] = -sign_of(f) * delta;
    for (int n = 0; n < g->count; n++)
        end[2 + g->flank[n]] = film[n * S + S - 1];
}

/* Differentiates the equations of the step with respect to the start values and, at fixed phases,
   to T. T changes the duration of the step and the entrainment speed. */
void dynamics_landing_vary(const dynamics_radau *r, const dynamics_landing *step,
                           double column[DYNAMICS_FILM_COLUMNS][DYNAMICS_FILM_ROWS])
{
    dynamics_landing copy = *step;
    stages g;
    double m[MOST][MOST], side[DYNAMICS_FILM_COLUMNS][MOST] = {{0}};
    variation v[DYNAMICS_FILM_COLUMNS];
    if (!prepare(r, &copy, &g))
        return;
    for (int c = 0; c < DYNAMICS_FILM_COLUMNS; c++) {
        v[c].stretch = c + 1 == DYNAMICS_FILM_COLUMNS ? g.h / step->T : 0;
        vary_motion(&g, step, column[c], &v[c]);
        vary_films(&g, step, column[c], &v[c], side[c]);
    }
    if (g.count > 0) {
        build_matrix(&g, step, m);
        if (!eliminate(g.count * S, m, DYNAMICS_FILM_COLUMNS, side))
            return;
    }
    for (int c = 0; c < DYNAMICS_FILM_COLUMNS; c++)
        vary_end(&g, &v[c], side[c], column[c]);
}

dynamics_landing_energy dynamics_landing_energies(const dynamics_radau *r,
                                                  const dynamics_landing *step)
{
    double h = (step->end - step->at) * step->T, c = 2 * step->excitation->zeta;
    dynamics_landing_energy sum = {0};
    for (int j = 0; j < S; j++) {
        double weight = h * r->a[S - 1][j], rate = step->rate[j + 1];
        double phase = step->at + r->node[j] * (step->end - step->at);
        const dynamics_piece *p = step->piece;
        double k = dynamics_piece_value(p->k, p->degree, phase - p->start);
        double k_rate = dynamics_piece_slope(p->k, p->degree, phase - p->start) / step->T;
        double e_rate = dynamics_piece_slope(p->e, p->degree, phase - p->start) / step->T;
        double thicken = 0;
        if (step->excitation->drags) {
            thicken = dynamics_piece_slope(p->film, p->degree, phase - p->start) / step->T;
            sum.drag += weight * dynamics_piece_value(p->drag, p->degree, phase - p->start) *
                        (rate + e_rate);
            sum.thickness += weight * step->force[j + 1] * thicken;
        }
        double damped = rate - thicken;
        sum.damper += weight * c * damped * damped;
        sum.work -= weight * (c * damped * (e_rate + thicken) + step->force[j + 1] * e_rate);
        for (int f = 0; f < 2; f++) {
            double bend = step->bend[f][j + 1];
            sum.work += weight * 0.5 * k_rate * bend * bend;
            if (step->open[f])
                sum.films += weight * k * bend * step->approach[f][j].speed;
        }
    }
    return sum;
}
