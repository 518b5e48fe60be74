/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Compares solutions of the contact problem of a mesh position with closed forms, and with a search
   over all sets of pairs. */
#include "../../../plugins/stiffness/load-sharing.h"

#include "check.h"

#include <math.h>
#include <stdint.h>

static double uniform(uint64_t *state)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (double)(*state >> 11) / 9007199254740992.0;
}

static void test_two_springs(void)
{
    stiffness_contacts c = {.count = 2, .gap = {0, 2e-6}, .compliance = {{5e-9, 0}, {0, 2.5e-9}}};
    stiffness_sharing r;
    check_true("solved", stiffness_share(&c, 3000, &r));
    /* 5e-9 f1 = 2.5e-9 f2 + 2e-6, f1 + f2 = 3000 */
    check_near("force 1", r.force[0], (2e-6 + 2.5e-9 * 3000) / 7.5e-9, 1e-14);
    check_near("force 2", r.force[1], 3000 - (2e-6 + 2.5e-9 * 3000) / 7.5e-9, 1e-14);
    check_near("deflection", r.deflection, 5e-9 * r.force[0], 1e-14);
    check_near("tangent", r.tangent, 1 / 5e-9 + 1 / 2.5e-9, 1e-14);
    check_near("unloaded", r.unloaded, 0, 0);
}

static void test_wide_gap_carries_nothing(void)
{
    stiffness_contacts c = {
        .count = 2, .gap = {15.1e-6, 0}, .compliance = {{5e-9, 1e-9}, {1e-9, 5e-9}}};
    stiffness_sharing r;
    check_true("solved", stiffness_share(&c, 3000, &r));
    check_true("open", !(r.force[0] > 0) && !(r.force[1] < 3000));
    check_near("alone", r.deflection, 15e-6, 1e-14);
    /* its neighbour moves it away by 3 um, so that a gap of 12 um is enough */
    c.gap[0] = 12.001e-6;
    check_true("solved", stiffness_share(&c, 3000, &r));
    check_true("still open", !(r.force[0] > 0));
    c.gap[0] = 11.99e-6;
    check_true("solved", stiffness_share(&c, 3000, &r));
    check_near("just closed", r.force[0], 0.01e-6 / 8e-9, 1e-9);
}

static void test_hertz(void)
{
    stiffness_contacts c = {.count = 1, .compliance = {{2e-9}}, .hertz = {{1.2e-9, 4e-11}}};
    stiffness_sharing r, more;
    check_true("solved", stiffness_share(&c, 3000, &r) && stiffness_share(&c, 3000.003, &more));
    check_near("approach", r.deflection, 3000 * (2e-9 + 1.2e-9 - 4e-11 * log(3000)), 1e-14);
    check_near("tangent", r.tangent, 0.003 / (more.deflection - r.deflection), 1e-6);
    c.hertz[0].constant = 4e-11 * log(3000) - 3e-9;
    check_true("no contact is pressed through its tooth", !stiffness_share(&c, 3000, &r));
}

/* Whether a set of pairs solves the linear problem with coupling. */
static int fits(const stiffness_contacts *c, double total, unsigned set, double force[4],
                double *approach)
{
    double m[5][6] = {{0}};
    size_t n = c->count;
    for (size_t i = 0; i < n; i++) {
        int in = set >> i & 1;
        for (size_t k = 0; k < n; k++)
            m[i][k] = in && set >> k & 1 ? c->compliance[i][k] * 1e9 : i == k;
        m[i][n] = in ? -1 : 0;
        m[i][n + 1] = in ? -c->gap[i] * 1e9 : 0;
        m[n][i] = in;
    }
    m[n][n + 1] = total;
    for (size_t k = 0; k <= n; k++) {
        size_t pivot = k;
        for (size_t i = k; i <= n; i++)
            pivot = fabs(m[i][k]) > fabs(m[pivot][k]) ? i : pivot;
        for (size_t j = 0; j <= n + 1; j++) {
            double kept = m[k][j];
            m[k][j] = m[pivot][j];
            m[pivot][j] = kept;
        }
        for (size_t i = 0; i <= n; i++)
            for (size_t j = n + 2; i != k && j-- > k;)
                m[i][j] -= m[i][k] / m[k][k] * m[k][j];
    }
    *approach = m[n][n + 1] / m[n][n] * 1e-9;
    for (size_t i = 0; i < n; i++)
        force[i] = m[i][n + 1] / m[i][i];
    for (size_t i = 0; i < n; i++) {
        double w = c->gap[i] - *approach;
        for (size_t k = 0; k < n; k++)
            w += c->compliance[i][k] * force[k];
        if (force[i] < -1e-9 || w < -1e-18)
            return 0;
    }
    return 1;
}

static void test_all_sets(void)
{
    uint64_t random = 7;
    double worst = 0, imbalance = 0;
    for (int trial = 0; trial < 2000; trial++) {
        stiffness_contacts c = {.count = 4};
        double expected[4] = {0}, approach = 0, sum = 0;
        for (size_t i = 0; i < 4; i++) {
            c.gap[i] = 2e-5 * uniform(&random);
            for (size_t k = 0; k < i; k++)
                c.compliance[i][k] = c.compliance[k][i] = 1e-9 * uniform(&random);
            c.compliance[i][i] = 1e-9 * (3.1 + uniform(&random));
        }
        unsigned set = 1;
        while (set < 16 && !fits(&c, 5000, set, expected, &approach))
            set++;
        stiffness_sharing r;
        if (!stiffness_share(&c, 5000, &r) || set == 16) {
            check_true("solved", 0);
            return;
        }
        for (size_t i = 0; i < 4; i++) {
            worst = fmax(worst, fabs(r.force[i] - expected[i]) / 5000);
            sum += r.force[i];
        }
        imbalance = fmax(imbalance, fabs(sum / 5000 - 1));
    }
    check_below("forces", worst, 1e-12);
    check_below("equilibrium", imbalance, 1e-15);
}

/* Forces of all sizes must be complementary to the gaps, also if the solution starts from that of a
   smaller or larger force. */
static void test_extremes(void)
{
    uint64_t random = 3;
    uint64_t others = 7;
    double worst = 0, apart = 0;
    for (int trial = 0; trial < 3000; trial++) {
        stiffness_contacts c = {.count = 3};
        for (size_t i = 0; i < 3; i++) {
            c.gap[i] = trial % 3 ? pow(10, -12 + 8 * uniform(&random)) : 0;
            for (size_t k = 0; k < i; k++)
                c.compliance[i][k] = c.compliance[k][i] = 5e-10;
            c.compliance[i][i] = 3e-9;
            c.hertz[i] = (stiffness_hertz){1.7e-9, 1.4e-10 * (trial % 2)};
        }
        stiffness_sharing r = {0}, other, again = {0};
        double force = pow(10, -6 + 10 * uniform(&random));
        int solved = stiffness_share(&c, force, &r);
        double first = fmin(force * pow(10, 2 - 4 * uniform(&others)), 1e4);
        if (!solved || !stiffness_share(&c, first, &other) ||
            !stiffness_share_near(&c, force, &other, &again))
            check_true("solved", 0);
        worst = fmax(worst, fmax(r.residual, again.residual));
        for (size_t i = 0; i < 3; i++)
            apart = fmax(apart, fabs(again.force[i] - r.force[i]) / force);
    }
    check_below("from another force", apart, 1e-10);
    check_below("complementarity", worst, 1e-12);
}

int main(void)
{
    test_two_springs();
    test_wide_gap_carries_nothing();
    test_hertz();
    test_all_sets();
    test_extremes();
    return check_done();
}
