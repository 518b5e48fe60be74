/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Solves the load sharing of Conry & Seireg by an active set method. */
#include "load-sharing.h"

#include <math.h>

enum {
    MAX_STEPS = 200 /* largest number of steps of Newton's method */,
    MAX_SETS = 64 /* largest number of iterations of the active set */
};

/* A pair with a smaller share of F is removed from the contact. */
static const double vanishing = 1e-13;

typedef struct sharing_state {
    const stiffness_contacts *contacts;
    double total;
    double unloaded; /* gaps and approach are measured from this transmission error */
    double force[STIFFNESS_MAX_PAIRS], approach;
    size_t count, member[STIFFNESS_MAX_PAIRS]; /* pairs in contact */
} sharing_state;

/* Returns the approach of a contact under that force, m. */
static double hertz(const stiffness_hertz *h, double force)
{
    return force > 0 ? force * (h->constant - h->slope * log(force)) : 0;
}

/* Returns the distance between the flanks of pair i, m: 0 in contact, negative if they overlap. */
static double separation(const sharing_state *s, size_t i)
{
    const stiffness_contacts *c = s->contacts;
    double sum = hertz(&c->hertz[i], s->force[i]) + (c->gap[i] - s->unloaded) - s->approach;
    for (size_t k = 0; k < c->count; k++)
        sum += c->compliance[i][k] * s->force[k];
    return sum;
}

/* Solves the symmetric system of the pairs in contact for two right-hand sides, in place. */
static bool solve(size_t n, double m[STIFFNESS_MAX_PAIRS][STIFFNESS_MAX_PAIRS],
                  double x[2][STIFFNESS_MAX_PAIRS])
{
    for (size_t k = 0; k < n; k++) {
        if (!(m[k][k] > 0))
            return false;
        for (size_t i = k + 1; i < n; i++) {
            double factor = m[i][k] / m[k][k];
            for (size_t j = k + 1; j < n; j++)
                m[i][j] -= factor * m[k][j];
            for (int side = 0; side < 2; side++)
                x[side][i] -= factor * x[side][k];
        }
    }
    for (size_t k = n; k-- > 0;)
        for (int side = 0; side < 2; side++) {
            for (size_t j = k + 1; j < n; j++)
                x[side][k] -= m[k][j] * x[side][j];
            x[side][k] /= m[k][k];
        }
    return true;
}

/* For the pairs in contact, with the matrix M = C + H'(f) and their separations w, computes x[0] =
   M^-1 w and x[1] = M^-1 1. False if M is not positive definite. */
static bool linearise(const sharing_state *s, double x[2][STIFFNESS_MAX_PAIRS])
{
    const stiffness_contacts *c = s->contacts;
    double m[STIFFNESS_MAX_PAIRS][STIFFNESS_MAX_PAIRS];
    for (size_t a = 0; a < s->count; a++) {
        size_t i = s->member[a];
        for (size_t b = 0; b < s->count; b++)
            m[a][b] = c->compliance[i][s->member[b]];
        m[a][a] += c->hertz[i].constant - c->hertz[i].slope * (1 + log(s->force[i]));
        x[0][a] = separation(s, i);
        x[1][a] = 1;
    }
    return solve(s->count, m, x);
}

static void remove_pair(sharing_state *s, size_t a)
{
    s->force[s->member[a]] = 0;
    s->count--;
    for (; a < s->count; a++)
        s->member[a] = s->member[a + 1];
}

/* Newton's method for the forces of the pairs in contact and for the approach. A pair whose
 * force vanishes is removed. */
static bool solve_contacts(sharing_state *s)
{
    for (int k = 0; k < MAX_STEPS; k++) {
        double x[2][STIFFNESS_MAX_PAIRS], sums[2] = {0}, missing = s->total, change = 0;
        if (!linearise(s, x))
            return false;
        for (size_t a = 0; a < s->count; a++) {
            missing -= s->force[s->member[a]];
            sums[0] += x[0][a];
            sums[1] += x[1][a];
        }
        double step = (missing + sums[0]) / sums[1]; /* Newton step of the approach */
        bool held = true; /* becomes false if a force had to be kept positive or a pair was
                             removed */
        s->approach += step;
        for (size_t a = 0; a < s->count; a++) {
            double *force = &s->force[s->member[a]], next = *force + x[1][a] * step - x[0][a];
            held = held && next > 0;
            next = next > 0 ? next : *force / 100; /* flanks cannot pull */
            change = fmax(change, fabs(next - *force));
            *force = next;
        }
        for (size_t a = s->count; a-- > 0;)
            if (s->count > 1 && s->force[s->member[a]] < vanishing * s->total) {
                remove_pair(s, a);
                held = false;
            }
        if (held && change <= 1e-12 * s->total)
            return true;
    }
    return false;
}

/* Adds the pair with the largest overlap among the pairs not in contact, with a small initial
   force. Returns false if none overlaps. */
static bool add_overlapping(sharing_state *s, double tolerance)
{
    size_t worst = s->contacts->count;
    double least = -tolerance;
    for (size_t i = 0; i < s->contacts->count; i++)
        if (!(s->force[i] > 0) && separation(s, i) < least) {
            least = separation(s, i);
            worst = i;
        }
    if (worst == s->contacts->count)
        return false;
    s->member[s->count++] = worst;
    s->force[worst] = 1e-9 * s->total;
    return true;
}

/* Corrects the largest force, so that the sum of forces is exact. */
static void balance_sum(sharing_state *s)
{
    size_t largest = s->member[0];
    double sum = 0;
    for (size_t a = 0; a < s->count; a++) {
        sum += s->force[s->member[a]];
        if (s->force[s->member[a]] > s->force[largest])
            largest = s->member[a];
    }
    s->force[largest] += s->total - sum;
}

static void report(const sharing_state *s, stiffness_sharing *r)
{
    *r = (stiffness_sharing){.unloaded = s->unloaded, .deflection = s->approach};
    for (size_t i = 0; i < s->contacts->count; i++) {
        double w = separation(s, i);
        r->force[i] = s->force[i];
        r->residual = fmax(r->residual, s->force[i] > 0 ? fabs(w) : -w);
    }
    r->residual /= s->approach;
}

/* Starts from equal forces on all pairs. */
static sharing_state start_anew(const stiffness_contacts *c, double force)
{
    sharing_state s = {.contacts = c, .total = force, .count = c->count, .unloaded = INFINITY};
    for (size_t i = 0; i < c->count; i++) {
        s.member[i] = i;
        s.force[i] = force / (double)c->count;
        s.unloaded = fmin(s.unloaded, c->gap[i]);
    }
    return s;
}

/* Starts from the pairs that are in contact under another force, with forces in the same
 * proportions. */
static sharing_state start_from(const stiffness_contacts *c, double force,
                                const stiffness_sharing *near)
{
    sharing_state s = {.contacts = c, .total = force, .unloaded = near->unloaded};
    double sum = 0;
    for (size_t i = 0; i < c->count; i++)
        sum += near->force[i];
    for (size_t i = 0; i < c->count; i++) {
        s.force[i] = near->force[i] * force / sum;
        if (s.force[i] > 0)
            s.member[s.count++] = i;
    }
    s.approach = separation(&s, s.member[0]);
    return s;
}

bool stiffness_share(const stiffness_contacts *c, double force, stiffness_sharing *r)
{
    return stiffness_share_near(c, force, NULL, r);
}

bool stiffness_share_near(const stiffness_contacts *c, double force, const stiffness_sharing *near,
                          stiffness_sharing *r)
{
    double x[2][STIFFNESS_MAX_PAIRS];
    if (c->count == 0)
        return false;
    sharing_state s = near ? start_from(c, force, near) : start_anew(c, force);
    for (int set = 0;; set++) {
        if (set == MAX_SETS || !solve_contacts(&s))
            return false;
        if (!add_overlapping(&s, 1e-12 * s.approach))
            break;
    }
    balance_sum(&s);
    report(&s, r);
    if (!linearise(&s, x))
        return false;
    for (size_t a = 0; a < s.count; a++)
        r->tangent += x[1][a];
    return s.approach > 0 && isfinite(s.approach);
}
