/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Equilibrium of the loaded teeth at one mesh position. */
#include "equilibrium.h"

#include "contact-point.h"
#include "cycle.h"

#include <math.h>

/* The force under which the stiffness is evaluated without load, N. */
static const double least_force = 1e-6;

double stiffness_source_force(const stiffness_source *s)
{
    return fmax(s->conditions->path.line_force, least_force);
}

/* Finds the gap of a pair along the line of action, m. Returns false if the tip corner does not
   meet a flank. */
static bool find_gap(const stiffness_source *s, double age, long number, double roll[2],
                     double *gap)
{
    if (s->corner || (age >= 0 && age <= s->conditions->gears.contact_ratio)) {
        if (!stiffness_gears_contact(&s->conditions->gears, age, roll, gap))
            return false;
    } else { /* beyond the path of contact, the roll angles are those of its end */
        double end = age < 0 ? 0 : s->conditions->gears.contact_ratio;
        stiffness_gears_contact(&s->conditions->gears, end, roll, gap);
    }
    for (int g = 0; g < 2; g++)
        *gap -= stiffness_profile_deviation(&s->conditions->deviations, g, roll[g]);
    *gap -= stiffness_index_deviation(&s->conditions->deviations, number);
    return isfinite(*gap);
}

static void find_pairs(const stiffness_source *s, size_t cycle, double phase, int side,
                       stiffness_position *at, stiffness_contacts *c)
{
    double length = s->before + s->conditions->path.contact_ratio + s->after;
    at->count = 0;
    for (int place = -(int)ceil(s->before); at->count < STIFFNESS_MAX_PAIRS; place++) {
        double age = phase + place;
        if (age + s->before > length + 1)
            break;
        if (!stiffness_touches(length, age + s->before, side))
            continue;
        if (!s->corner && s->sharp)
            age = fmin(fmax(age, 0), s->conditions->path.contact_ratio);
        long number = (long)cycle - place;
        if (find_gap(s, age, number, at->roll[at->count], &c->gap[at->count]))
            at->age[at->count++] = age;
    }
    c->count = at->count;
}

static stiffness_loaded share_force(const stiffness_source *s, const stiffness_position *at,
                                    const stiffness_contacts *c, double phase, double force,
                                    const stiffness_sharing *near)
{
    stiffness_loaded r = {.at = *at};
    r.solved = stiffness_share_near(c, force, near, &r.sharing);
    r.stiffness = s->tangent ? r.sharing.tangent : force / r.sharing.deflection;
    r.solved = r.solved && r.stiffness > 0 && isfinite(r.stiffness);
    const double same_gap = 1e-15; /* m */
    const int offset = 8; /* more than the whole mesh cycles before SAP in which a pair may touch */
    double least = INFINITY;
    for (size_t i = 0; i < r.at.count; i++) {
        int place = (int)lround(r.at.age[i] - phase);
        if (r.sharing.force[i] > 0)
            r.loaded |= UINT64_C(1) << (place + offset);
        if (c->gap[i] < least - same_gap) {
            least = c->gap[i];
            r.first = place;
        }
    }
    return r;
}

void stiffness_source_solve_all(const stiffness_source *s, size_t cycle, double phase, int side,
                                size_t count, const double *force, stiffness_loaded *loaded)
{
    stiffness_position at;
    stiffness_contacts c;
    find_pairs(s, cycle, phase, side, &at, &c);
    s->compliance(s->self, &at, &c);
    for (size_t i = 0; i < count; i++)
        loaded[i] = share_force(s, &at, &c, phase, fmax(force[i], least_force),
                                i > 0 && loaded[i - 1].solved ? &loaded[i - 1].sharing : NULL);
}

stiffness_loaded stiffness_source_solve(const stiffness_source *s, size_t cycle, double phase,
                                        int side)
{
    stiffness_loaded r;
    stiffness_source_solve_all(s, cycle, phase, side, 1, &s->conditions->path.line_force, &r);
    return r;
}

/* Returns the number of whole mesh cycles by which this pair is older than the pair that entered
   last. */
static int place_of(double age, double phase)
{
    return (int)lround(age - phase);
}

double stiffness_loaded_force(const stiffness_loaded *r, double age, double phase)
{
    for (size_t i = 0; i < r->at.count; i++)
        if (place_of(r->at.age[i], phase) == place_of(age, phase))
            return r->sharing.force[i];
    return 0;
}

double stiffness_source_unloaded(const stiffness_source *s, size_t cycle, double phase)
{
    stiffness_position at;
    stiffness_contacts c;
    double least = INFINITY;
    find_pairs(s, cycle, phase, STIFFNESS_ABOVE, &at, &c);
    for (size_t i = 0; i < c.count; i++)
        least = fmin(least, c.gap[i]);
    return least;
}
