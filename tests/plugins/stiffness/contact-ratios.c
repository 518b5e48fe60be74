/* SPDX-License-Identifier: GPL-3.0-or-later */
/* With every stiffness model and contact ratios 1 to 2.6, the tooth pairs must carry the line
   force. */
#include "chain.h"
#include "check.h"
#include "pair.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const double module = 3e-3, teeth[2] = {40, 60};

static const char *const models[] = {"stiffness/potential-energy", "stiffness/load-distribution",
                                     "stiffness/iso-6336", "stiffness/table"};

/* Returns the addendum, in modules, for a contact ratio. */
static double addendum_for(double ratio)
{
    double low = 0.1, high = 2;
    for (int i = 0; i < 100; i++) {
        double middle = (low + high) / 2;
        spur_pair p = spur_pair_make(teeth[0], teeth[1], module, middle, 0, 0);
        *(p.contact_ratio < ratio ? &low : &high) = middle;
    }
    return low;
}

static chain open_ratio(const char *model, double ratio)
{
    static const double phase[] = {0, 1}, k[] = {4e8, 3e8};
    double tip[2], root[2], addendum = addendum_for(ratio);
    for (int i = 0; i < 2; i++) {
        tip[i] = module * (teeth[i] + 2 * addendum);
        root[i] = module * (teeth[i] - 2 * (addendum + 0.25));
    }
    chain c = chain_open(model, "250 N m");
    stage_set_reals(c.gear, "teeth", 2, teeth);
    stage_set_reals(c.gear, "tip_diameter", 2, tip);
    stage_set_reals(c.gear, "root_diameter", 2, root);
    if (!strcmp(model, "stiffness/table")) {
        stage_set_reals(c.mesh, "phase", 2, phase);
        stage_set_reals(c.mesh, "stiffness", 2, k);
        stage_set_text(c.mesh, "ends", "jump");
    }
    return c;
}

/* Returns the load fraction of the pair `age` base pitches from SAP, just before or after this
   point; 0 beyond the path of contact. Of two stations at a point, the first is just before it. */
static double share_at(const chain *c, double age, int after)
{
    size_t n;
    const double *roll = stage_get(c->gear, "roll_angle", &n);
    const double *share = stage_get(c->mesh, "load_share", NULL);
    for (size_t k = 0; k < n; k++) {
        size_t i = after ? n - 1 - k : k;
        if ((after ? i + 1 == n : i == 0) ||
            fabs((roll[i] - roll[0]) * teeth[0] / 2 / M_PI - age) > 1e-9)
            continue;
        return share[i];
    }
    return after && age < 1e-9 ? share[0] : 0;
}

static void check_sum(const chain *c, const char *what, double phase, int after, size_t pairs)
{
    double sum = 0;
    size_t loaded = 0;
    for (int place = 0; place < 4; place++) {
        double share = share_at(c, phase + place, after);
        sum += share;
        loaded += share > 0;
    }
    check_near(what, sum, 1, 1e-10);
    check_true("as many pairs as the contact ratio says", loaded == pairs);
}

static void check_ratio(const char *model, double ratio)
{
    chain c = open_ratio(model, ratio);
    printf("%s, contact ratio %.10g\n", model, ratio);
    chain_run(&c);
    size_t fewest = (size_t)floor(ratio + 1e-9);
    double change = ratio - (double)fewest;
    int whole = fabs(change) < 1e-9;
    check_sum(&c, "a pair has come", 0, 1, fewest + !whole);
    check_sum(&c, "a pair will come", 1, 0, fewest);
    if (!whole) {
        check_sum(&c, "a pair will go", change, 0, fewest + 1);
        check_sum(&c, "a pair has gone", change, 1, fewest);
    }
    check_below("equilibrium", stage_quality(c.mesh, "equilibrium"), 1e-10);
    chain_close(&c);
}

int main(void)
{
    static const double ratios[] = {1, 2, 2.3},
                        others[] = {1 + 1e-6, 1.2, 2 - 1e-6, 2 - 1e-10, 2 + 1e-10, 2.6};
    for (size_t m = 0; m < sizeof models / sizeof models[0]; m++)
        for (size_t i = 0; i < sizeof ratios / sizeof ratios[0]; i++)
            check_ratio(models[m], ratios[i]);
    for (size_t i = 0; i < sizeof others / sizeof others[0]; i++)
        check_ratio("stiffness/potential-energy", others[i]);
    return check_done();
}
